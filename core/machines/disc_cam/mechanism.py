"""The mechanism of a disc cam: cam, follower, the contacts between them, and what their errors move."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Pin
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn, fixed, standing, steady
from gearlink.core.studies.loads.contact import roller_on
from gearlink.core.studies.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE

if TYPE_CHECKING:
    from gearlink.core.machines.disc_cam.cams import FollowerCams
    from gearlink.core.machines.disc_cam.design import DiscCamDesign
    from gearlink.core.numerics.arrays import Points, Reals


_SENSES = {1: "rise", -1: "return", 0: "dwell"}


def motion(design: DiscCamDesign) -> Motion:
    """Links and joints over the cam angle, the cam axis at 0."""
    cams, sense = design.cams, float(design.spec.cam.sense)
    _ = cams.place

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        axis = fixed(0j, phi, order=order)
        follower = follower_link(cams, phi, order, side)
        links = {"cam": Link(axis, steady(phi, sense, order=order)), "follower": follower}

        def joints() -> list[Connection]:
            at = follower.origin.value
            held = Guide("guide", FRAME, "follower", at, cams.direction) if travel else Pin("A", FRAME, "follower", at)
            return [Pin("O", FRAME, "cam", axis.value), held, *_contacts(cams, phi, made)]

        travel = {} if design.spec.oscillates else {"follower": cams.direction}
        made = Mechanism(links, Later(joints), "cam", sense, travel=travel)
        return made

    return Motion(
        make,
        Input("cam_angle", joints=tuple(joint for joint in cams.motion.joints if joint > 0.0)),
        (Output("Follower", lift(design), _phases(cams)),),
        cams.motion.highest,
    )


def lift(design: DiscCamDesign) -> Course:
    """The lift of the follower [mm or rad]."""
    cams = design.cams
    if design.spec.oscillates:
        zero, sense = np.zeros(1), -float(cams.follower.side)
        start = float(cams.arm_angle(cams.place, zero, 0)[0][0]) - sense * float(cams.motion.evaluate(zero, 0)[0][0])
        return turned("follower", sense=sense).less(sense * start)
    start = cams.place.radius if design.spec.is_flat else cams.start_height
    return coordinate("follower", along=cams.direction).less(start)


def follower_link(cams: FollowerCams, phi: Reals, order: int = 2, side: int = 1) -> Link:
    """The follower at cam angles [rad]."""
    return (_rocker if cams.spec.oscillates else _slide)(cams, phi, order, side)


def _slide(cams: FollowerCams, phi: Reals, order: int, side: int) -> Link:
    """Origin at the roller's centre or the edge, or where the line of travel meets the face."""
    u, flat = cams.direction, cams.spec.is_flat
    start = cams.place.radius if flat else cams.start_height
    across = 0.0 if flat else -1j * cams.place.offset
    value, *rates = cams.motion.evaluate(phi, order, side=side)
    place = [np.asarray(u * each, dtype=np.complex128) for each in (start + value + across, *rates)]
    return Link(Point(*place), standing(0.0, phi, order=order))


def _rocker(cams: FollowerCams, phi: Reals, order: int, side: int) -> Link:
    """Origin at the pivot, x to the roller or the edge, or along the face."""
    turn = Turn(*cams.arm_angle(cams.place, phi, order, side))
    points = {"A": 0.0} if cams.spec.is_flat else {"A": 0.0, "B": float(cams.follower.arm)}
    return Link(fixed(cams.pivot, phi, order=order), turn, points)


def _contacts(cams: FollowerCams, phi: Reals, made: Mechanism) -> list[Contact]:
    """The contact that carries; of a conjugate pair one that pushes either way, of a groove one of both walls."""
    if cams.spec.is_flat:
        touch = cams.flat.touch(phi)
        return [Contact("main", "cam", "follower", touch.point, touch.normal, slides=True)]
    name = "roller main" if cams.spec.rolls else "edge"  # the loads know a roller by the first
    roller = made.once(name, lambda: roller_on(cams.main, phi))
    back: tuple[Points, Points] | None = None
    if cams.back is not None:
        other = made.once("roller return", lambda: roller_on(cams.back, phi))  # type: ignore[arg-type]
        back = other.position, -other.normal
    slides = not cams.spec.rolls
    return [Contact("main", "cam", "follower", roller.position, roller.normal, back, roller.curvature, slides=slides)]


def _phases(cams: FollowerCams) -> tuple[tuple[str, float, float], ...]:
    """Rises, returns and dwells; strokes of one sense that follow each other are one."""
    found: list[tuple[str, float, float]] = []
    for stroke in cams.motion.strokes:
        name = _SENSES[stroke.sense]
        start = found.pop()[1] if found and found[-1][0] == name else stroke.start
        found.append((name, start, stroke.end))
    return tuple(found)


def errors(design: DiscCamDesign, _mechanism: Mechanism) -> Movable:
    """The cam's profile; of a roller its radius and the play of its pin; of a slide the offset, of a rocker arm and
    centre distance, but of a face.

    The error of a follower that rocks is measured at its roller, or at register.radius under a face.
    """
    cams, outwards = design.cams, (Shift("cam", ("main",), 1.0, "normal"),)
    sizes: dict[str, tuple[Shift, ...]] = {CAM_PROFILE: outwards}
    if design.spec.is_flat:
        return Movable(sizes, others={CAM_PROFILE: 0.0})
    measured = design.kind == "measured-cam"
    rolls = design.spec.rolls
    if rolls:
        sizes["roller_radius" if measured else "follower.roller_radius"] = outwards
    radius = 0.0
    if design.spec.oscillates:
        radius, away = float(cams.follower.arm), cmath.phase(cams.pivot)
        sizes["follower.arm"] = (Shift("follower", ("main",)),)
        if measured:
            sizes |= {f"follower.pivot[{i}]": (Shift(FRAME, ("A",), way),) for i, way in enumerate((1.0 + 0j, 1j))}
        else:
            sizes["follower.center_distance"] = (Shift(FRAME, ("A",), cmath.rect(1.0, away)),)
    else:
        sizes["follower.offset"] = (Shift(FRAME, ("guide",), -1j * cams.direction),)
    return Movable(
        sizes,
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("follower", ("main",), 1.0, "frame"),)} if rolls else {},
        rollers=("roller",) if rolls else (),
        radius=radius,
    )
