"""GL302 of drum, gripper arm, links and rollers: what turns beside the axes of the frame."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.report import Check
from gearlink.core.machines.swing_gripper.passes import Pass, Passes, axes_of, cam_turns_drum, drum_axis
from gearlink.core.parts.cams.checks import AS_THICK_AS_ROLLER, over_axis_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance.links import beside_line, beside_turning_arm

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import SwingGripper

_THINNEST = "the thinnest shaft (limits.least_shaft) takes"
_OVER = 1e-6
"""A link no farther from an axis [mm] sweeps over it, where no shaft is thin enough."""


class Room(NamedTuple):
    """The thinnest shaft that would be built beside a body [mm], and the words for it."""

    radius: float
    takes: str


def room_for_shaft(design: SwingGripper, roller: float) -> Room:
    """That of limits.least_shaft, or one as thick as the roller."""
    least = design.spec.limits.least_shaft
    return Room(roller, AS_THICK_AS_ROLLER) if least is None else Room(least, _THINNEST)


def beside_axes(design: SwingGripper) -> Iterator[Check]:
    """All of them; warnings alone."""
    yield from cams(design)
    yield from rollers(design)
    yield from drum_and_arm(design)
    yield from links(design)
    yield from spring(design)


def cams(design: SwingGripper) -> Iterator[Check]:
    """The cams against the axes of rocker and gripper, and that of the drum unless they stand on its shaft."""
    for cam in design.cams.discs:
        for axis in axes_of(design)[1:]:
            room = abs(axis.place - design.cams.center) - cam.max_radius
            advice = f"overhang the shaft beside the cam, move cam.center away from it, or {axis.remedy}"
            shaft, takes = room_for_shaft(design, cam.roller_radius)
            yield from over_axis_check(SHAFT_CLEARANCE, cam.name, room, shaft, axis.name, advice, takes=takes)


def drum_and_arm(design: SwingGripper) -> Iterator[Check]:
    """The drum that takes the sheet over, and the gripper arm over its swing, against the two axes of the frame.

    Notes
        Both reach across the machine, as the shafts there do. A cam may stand on the drum's own shaft. Where the file
        names the radius of the cam shaft that is kept clear, else room for a shaft as thick as the roller.
    """
    drum, radius = drum_axis(design), design.spec.cylinder.radius
    needed, takes = room_for_shaft(design, design.cams.section.roller.radius)
    for axis in axes_of(design)[:2]:
        within, thick = axis.radius, 0.0 if axis.radius > 0.0 else needed
        advice = f"overhang the shaft beside it, turn arm.direction, or {axis.remedy}"
        if not (axis.letter == "O" and cam_turns_drum(design)):
            room = abs(drum - axis.place) - radius - within
            words = "cylinder that takes the sheet"
            yield from over_axis_check(SHAFT_CLEARANCE, words, room, thick, axis.name, advice, takes=takes)
        room = room_beside_arm(design, axis.place) - within
        yield from over_axis_check(SHAFT_CLEARANCE, "gripper arm", room, thick, axis.name, advice, takes=takes)


def rollers(design: SwingGripper) -> Iterator[Check]:
    """The rollers against the axis of their own rockers, about which no shaft fits where the arm is short."""
    section = design.cams.section
    for words, key, roller in (("main", "roller", section.roller), ("return", "return_roller", section.return_roller)):
        if roller is not None:
            room = roller.arm - roller.radius
            advice = f"lengthen cam.{key}.arm, or take a smaller roller"
            name, axis = f"{words} roller", "the cam rocker's axis"
            shaft, takes = room_for_shaft(design, roller.radius)
            yield from over_axis_check(SHAFT_CLEARANCE, name, room, shaft, axis, advice, takes=takes)


def links(design: SwingGripper) -> Iterator[Check]:
    """Links and rollers over their whole motion against the axes of the frame that they do not turn about.

    Notes
        Links are lines of no width; a shaft of the file is kept clear by its radius, beside other axes there must be
        room for the thinnest that would be built. A warning, since a shaft may end before the plane of the link.
    """
    passes, main = Passes(design), design.cams.section.roller.radius
    for found in passes:
        least, takes = room_for_shaft(design, found.radius or main)
        needed = found.axis.radius or least
        if found.distance - found.radius < max(needed, _OVER):
            where = f"{found.axis.name} at cylinder angle {passes.cylinder_angle(found):.5g} deg"
            advice = f"that shaft must end before the plane of the {found.body} (be overhung), or {found.axis.remedy}"
            if found.radius:
                room = found.distance - found.radius
                yield from over_axis_check(SHAFT_CLEARANCE, found.body, room, needed, where, advice, takes=takes)
            else:
                yield _line_check(found, where, Room(needed, takes), advice)


def _line_check(found: Pass, where: str, needed: Room, advice: str) -> Check:
    """GL302 of a link that passes through the place of a shaft."""
    takes = "" if found.axis.radius else f", {needed.takes} {needed.radius:g} mm"
    how = f"passes {found.distance:.4g} mm beside {'the middle of ' if found.axis.radius else ''}"
    if found.distance < _OVER:
        how, takes = "sweeps over ", ""
    text = f"the {found.body} {how}{where}{takes}: {advice}"
    return SHAFT_CLEARANCE.check("warn", text, found.distance, needed.radius, "mm")


def spring(design: SwingGripper) -> Iterator[Check]:
    """The line of a spring given by its levers against the axis of the two rockers, which it passes alike all the turn.

    Notes
        At right angles to the line that is the lever of its torque.
    """
    given, (needed, takes) = design.spec.spring, room_for_shaft(design, design.cams.section.roller.radius)
    if given is None or given.arms is None or given.angle is None:
        return
    (p, q), turned = given.arms, cmath.exp(1j * math.radians(given.angle))
    distance = float(beside_line(0j, np.array([p + 0j]), np.array([q * turned]))[0])
    if distance < needed:
        text = (
            f"the line of the spring passes {distance:.4g} mm beside the cam rocker's axis, {takes} "
            f"{needed:g} mm: {'lessen spring.angle or ' if min(p, q) >= needed else ''}lengthen "
            "spring.arms, or let that shaft end before the plane of the spring"
        )
        yield SHAFT_CLEARANCE.check("warn", text, distance, needed, "mm")


def room_beside_arm(design: SwingGripper, place: complex) -> float:
    """Least distance of a point from the line E-F over the swing; of one that it passes over, the tip's lead on it.

    Parameters
        design : SwingGripper
        place : complex [mm] - in the machine's frame
    Returns
        room : float [mm] - negative where the line passes over the point, by as much as the tip reaches beyond it
    """
    arm, linkage = design.spec.arm, design.motion.linkage
    seen, at_bite = place - linkage.output_pivot, cmath.rect(arm.length, math.radians(arm.direction))
    near = beside_turning_arm(seen, at_bite, linkage.swing_sense * linkage.law.total_swing)
    return near.distance or abs(seen) - arm.length
