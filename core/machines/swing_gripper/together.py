"""What many swing grippers seek at once: their linkages, cams and torques, each as one whose numbers are columns."""

from __future__ import annotations

from collections.abc import Hashable, Sequence
from contextlib import suppress
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.many_designs import Unlike, column, hand_in, hand_on, hand_out, in_groups, sought, stacked
from gearlink.core.base.results import keep
from gearlink.core.machines.swing_gripper.fingers import FOUND, FingerCam
from gearlink.core.machines.swing_gripper.forces import outward_of
from gearlink.core.machines.swing_gripper.law import LawOfEach, SixPhaseLaw
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
from gearlink.core.machines.swing_gripper.motion import Motion, Timing
from gearlink.core.numerics.arrays import Mask
from gearlink.core.parts.cams import profile
from gearlink.core.parts.cams.disc_cam import DiscCam, largest_pressure_angles, seek_together

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import Closure, SwingGripper

Part = TypeVar("Part")
_MOST_LAWS = 8
_RADIAN = np.pi / 180.0
_ANGLES = np.linspace(0.0, 2.0 * np.pi, 361)
_OF_PEAKS = ("velocity-step", "acceleration-step")
_OF_FINGERS = ("pressure-angle", "cam-undercut")
_OF_MOTION = ("newton_agreement", "newton_iterations", "rates")
_LIFTING = {"lift-off", "lift_off_speed", "spring_torque", "settling_time"}


def find_together(designs: Sequence[SwingGripper], asked: frozenset[str]) -> None:
    """Let designs keep what is found for all of them.

    Parameters
        asked : names of the quantities and checks that will be asked for
    """
    if not asked.isdisjoint(type(designs[0]).extreme_names):
        asked |= {"rates"}
    for group in in_groups([design for design in designs if _closes(design)], _alike):
        sought(lambda some: _find_motions(some, asked), _distinct([design.motion for design in group]))
        if not asked.isdisjoint(_OF_FINGERS):
            sought(_find_fingers, _distinct([design.fingers for design in group if _has_fingers(design)]))
        if group[0].spec.cam is not None:
            sought(lambda some: _find_cams(some, asked), [design for design in group if _has_cams(design)])


def _closes(design: SwingGripper) -> bool:
    """Whether there is a linkage that closes all over its swing; what is wrong with another it says itself."""
    with suppress(GearlinkError):
        return design.motion.unchecked.surely_reaches
    return False


def _has_cams(design: SwingGripper) -> bool:
    """Whether its linkage makes its swing, and there is a place for its cams."""
    with suppress(GearlinkError):
        return bool(design.motion.linkage and design.cams.discs)
    return False


def _has_fingers(design: SwingGripper) -> bool:
    with suppress(GearlinkError):
        return design.spec.fingers is not None and bool(design.fingers.cam)
    return False


def _distinct(parts: Sequence[Part]) -> list[Part]:
    """Parts that designs may share, each once."""
    return list({id(part): part for part in parts}.values())


def _alike(design: SwingGripper) -> Hashable:
    """What no column stands for."""
    linkage, cam = design.motion.unchecked, design.spec.cam
    reading = linkage.swing_sense, linkage.assembly, linkage.output > linkage.four_bar.frame
    return reading, cam and (cam.sense, cam.return_roller is None), design.spec.inertia is None


def _as_one(linkages: Sequence[GripperLinkage]) -> GripperLinkage:
    if all(each is linkages[0] for each in linkages):
        return linkages[0]
    many = stacked(linkages, law=_law_of([linkage.law for linkage in linkages]))
    hand_in(many, linkages, "frame_direction", "output_shift", "inverse", "reading", "_shifts")
    return many


def _law_of(laws: Sequence[SixPhaseLaw]) -> SixPhaseLaw:
    """All of them as one, unless nearly each has laws of its own."""
    if all(law is laws[0] for law in laws):
        return laws[0]
    known: dict[str, Any] = {}
    for name in ("accelerate", "decelerate", "return_"):
        of_phase = [getattr(law, name) for law in laws]
        if len(_distinct(of_phase)) > _MOST_LAWS:
            raise Unlike
        known[name] = of_phase[0] if all(law is of_phase[0] for law in of_phase) else LawOfEach(of_phase)
    return stacked(laws, **known)


def _find_fingers(fingers: Sequence[FingerCam]) -> None:
    """Extremes of the cams of the fingers."""
    cams = [each.cylinder_cam for each in fingers]
    law = _law_of([each.timing.law for each in fingers])
    many = stacked(cams, path=stacked([each.course for each in fingers], law=law))
    seek_together([many], FOUND)
    hand_out(many, cams, *FOUND)


def _find_motions(motions: Sequence[Motion], asked: frozenset[str]) -> None:
    """Transmission angles, and of linkages that make their swing what is asked for besides."""
    linkages = [motion.unchecked for motion in motions]
    many, laws = _as_one(linkages), [linkage.law for linkage in linkages]
    hand_out(many, linkages, "least_transmission")
    if not asked.isdisjoint(_OF_PEAKS) and many.law is not laws[0]:
        hand_out(many.law, laws, "peaks")
    sought(lambda some: _find_rates(some, asked), [motion for motion in motions if _makes_its_swing(motion)])


def _makes_its_swing(motion: Motion) -> bool:
    with suppress(NoSolution):
        return motion.linkage is not None
    return False


def _find_rates(motions: Sequence[Motion], asked: frozenset[str]) -> None:
    """Agreement of both ways, and extremes of speed and acceleration."""
    names = [name for name in _OF_MOTION if name in asked]
    if "conditioning" in asked:
        names.append("rough_agreement")
    if names:
        linkage, timing = _as_one([motion.linkage for motion in motions]), Timing(motions[0].spec)
        keep(timing, law=linkage.law, shaft_speed=column([motion.shaft_speed for motion in motions]))
        many = Motion(motions[0].spec, timing)
        keep(many, linkage=linkage)
        hand_out(many, motions, *names)


def _find_cams(designs: Sequence[SwingGripper], asked: frozenset[str]) -> None:
    """Extremes of the cams, and what lifts their rollers."""
    of_cam = list(zip(*(design.cams.discs for design in designs), strict=True))
    linkage, names = _as_one([design.motion.linkage for design in designs]), _names(designs[0], asked)
    many = [stacked(cams, path=stacked([cam.path for cam in cams], linkage=linkage)) for cams in of_cam]
    try:
        seek_together(many, names)
    except NoSolution:
        stand = np.all([np.broadcast_to(_stands(cam), len(designs)) for cam in many], axis=0)
        if stand.all():
            raise
        standing = [design for design, stands in zip(designs, stand.tolist(), strict=True) if stands]
        sought(lambda some: _find_cams(some, asked), standing)
        return
    for cam, own in zip(many, of_cam, strict=True):
        hand_out(cam, own, *names)
    closures = [design.closure for design in designs]
    hand_on(closures, outward=tuple(outward_of(cam) for cam in many))
    if not _LIFTING.isdisjoint(asked) and designs[0].spec.inertia is not None:
        sought(_find_torques, [closure for closure in closures if closure.refusal is None])
    if designs[0].warnings and "pressure-angle" in asked:
        steepest = largest_pressure_angles(many, 0.0, linkage.law.starts[1] * _RADIAN)
        hand_on([design.cams for design in designs], steepest_accelerating=tuple(steepest))
    if designs[0].warnings and "shaft-clearance" in asked:
        for group in in_groups(designs, lambda design: len(design.axes)):
            sought(_find_beside_coupler, group)


def _find_beside_coupler(designs: Sequence[SwingGripper]) -> None:
    """Axes of the frame beside the coupler."""
    linkage = _as_one([design.motion.linkage for design in designs])
    axes = zip(*([axis.place for axis in design.axes] for design in designs), strict=True)
    hand_on(designs, beside_coupler=linkage.beside_coupler([column(places) for places in axes]))


def _names(first: SwingGripper, asked: frozenset[str]) -> list[str]:
    """The extremes of a cam that are asked for."""
    names = ["max_pressure_angle", "most_convex"]  # with them it is known whether there is a cam
    if "max_radius" in asked or (first.warnings and "shaft-clearance" in asked):
        names.append("max_radius")
    if not {"min_radius", "shaft-clearance"}.isdisjoint(asked):
        names.append("min_radius")
    return [*names, "least_support"] if "cam-undercut" in asked else names


def _stands(cam: DiscCam) -> Mask:
    """Whether rollers keep off the relative pole, at a number of cam angles."""
    return profile.stands(cam.path(_ANGLES, 1), sense=cam.sense)


def _find_torques(closures: Sequence[Closure]) -> None:
    """The maximum torque that lifts each roller."""
    first, sense = closures[0], column([closure.lift_sense for closure in closures])
    linkage = _as_one([closure.motion.linkage for closure in closures])
    inertia = stacked([closure.inertia for closure in closures], linkage=linkage)
    hand_on(closures, worst_unloading=inertia.greatest([-sense, sense][: len(first.cams.discs)]))
