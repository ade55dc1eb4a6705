"""GL302 of drum, gripper arm and rollers: what turns beside the axes of cam and cam rocker."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.cams.checks import over_axis_check
from gearlink.core.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.report import Check

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.design import SwingGripper


def drum_and_arm(design: SwingGripper) -> Iterator[Check]:
    """The drum that takes the sheet over, and the gripper arm over its swing, against the two axes of the frame.

    Notes
        Both reach across the machine, as the shafts there do. A cam may stand on the drum's own shaft. Where the file
        names the radius of the cam shaft that is kept clear, else room for a shaft as thick as the roller.
    """
    spec, section = design.spec, design.cams.section
    drum = complex(*spec.cylinder.center) if spec.cylinder.center is not None else design.handover.center
    roller, shaft = section.roller.radius, section.shaft_radius
    named = f"the cam shaft (radius {shaft:g} mm)" if shaft > 0.0 else "the cam axis"
    axes = (
        (named, design.cams.center, shaft, 0.0 if shaft > 0.0 else roller, "cam.center"),
        ("the cam rocker's axis", design.motion.linkage.input_pivot, 0.0, roller, "pivots.input"),
    )
    for axis, place, within, needed, key in axes:
        advice = f"overhang the shaft beside it, turn arm.direction, or move {key}"
        away = abs(drum - place)
        if away > spec.limits.handover_place:
            room = away - spec.cylinder.radius - within
            yield from over_axis_check(SHAFT_CLEARANCE, "cylinder that takes the sheet", room, needed, axis, advice)
        room = room_beside_arm(design, place) - within
        yield from over_axis_check(SHAFT_CLEARANCE, "gripper arm", room, needed, axis, advice)


def rollers(design: SwingGripper) -> Iterator[Check]:
    """The rollers against the axis of their own rockers, about which no shaft fits where the arm is short."""
    section = design.cams.section
    for words, key, roller in (("main", "roller", section.roller), ("return", "return_roller", section.return_roller)):
        if roller is not None:
            room = roller.arm - roller.radius
            advice = f"lengthen cam.{key}.arm, or take a smaller roller"
            name, axis = f"{words} roller", "the cam rocker's axis"
            yield from over_axis_check(SHAFT_CLEARANCE, name, room, roller.radius, axis, advice)


def room_beside_arm(design: SwingGripper, place: complex) -> float:
    """Least distance of a point from the line E-F over the swing; of one that it passes over, the tip's lead on it.

    Parameters
        design : SwingGripper
        place : complex [mm] - in the machine's frame
    Returns
        room : float [mm] - negative where the line passes over the point, by as much as the tip reaches beyond it
    """
    arm, swing = design.spec.arm, design.motion.law.total_swing
    seen = (place - design.motion.linkage.output_pivot) * cmath.exp(-1j * math.radians(arm.direction))
    turned = seen if design.spec.swing_sense > 0 else seen.conjugate()
    if cmath.phase(turned) % math.tau <= swing:
        return abs(turned) - arm.length
    ends = (turned, turned * cmath.exp(-1j * swing))
    return min(abs(end - min(max(end.real, 0.0), arm.length)) for end in ends)
