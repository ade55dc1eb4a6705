"""Checks of a flatbed press: chains, zone and cams; each is a function of the design."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import can_be_built, greatest_length
from gearlink.core.base.report import Check, Rule, safely_above
from gearlink.core.base.wording import amount
from gearlink.core.machines.flatbed_press import codes
from gearlink.core.machines.flatbed_press.bodies import return_overlap
from gearlink.core.parts.cams.codes import ACCELERATION_STEP, CONSTANT_SUM, LARGER, VELOCITY_STEP
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.machines.flatbed_press.compensation import Joint
    from gearlink.core.machines.flatbed_press.design import FlatbedPress

# A share of the speed that is nothing but the rounding of the chains.
_ROUNDING = 1e-12

# Chains and zone


def transmission_angle(design: FlatbedPress) -> Iterator[Check]:
    """GL303 for both chains, and for the rod of the bed's slider-crank."""
    limit, motion = design.spec.limits.transmission_angle, design.motion
    angles = {"bed": motion.min_transmission_angle_bed, "cylinder": motion.min_transmission_angle_cylinder}
    for chain, angle in angles.items():
        yield transmission_check(
            angle,
            limit,
            f"bring coupler and rocker of {chain}.double_crank nearer to a right angle (shorter frame, longer coupler)",
            f"the least transmission angle of the {chain} chain",
        )
    subject = "the least angle between the rod EF and the normal of its slide line"
    yield transmission_check(motion.min_rod_angle, limit, "lengthen bed.rod, or bring the slide line nearer", subject)


def sync_speed(design: FlatbedPress) -> Iterator[Check]:
    """GL501: bed and cylinder at the start of the zone, and without a cam what their travels gather over it."""
    yield _start_speed(design)
    ahead = design.motion.compensation
    if design.spec.cam is None and abs(ahead) > _ROUNDING * design.motion.zone_length:
        side = "ahead of" if ahead > 0.0 else "behind"
        text = f"over the zone the bed runs {side} the cylinder by {abs(ahead):.6g} mm, and no cam makes that good"
        yield codes.SYNC_SPEED.check("warn", f"{text}: give the section cam", abs(ahead), 0.0, "mm")


def _start_speed(design: FlatbedPress) -> Check:
    """What the speeds differ by at the start of the zone, where a jump would be a blow."""
    gap, cylinder = _speed_gap(design)
    share, limit = abs(gap / cylinder), 1e-3
    text = f"at the start of the zone bed and cylinder differ by {gap * design.motion.input_speed:.3g} mm/s"
    if share < _ROUNDING:
        text = "at the start of the zone bed and cylinder run equally fast"
    elif share > limit:
        text += f", {100 * share:.3g} % of the speed: start the zone where the speeds are equal (leave sync.start out)"
        if design.spec.cam is not None:
            text += ", or take the difference up before the zone (cam.lead_in)"
    return codes.SYNC_SPEED.check("fail" if share > limit else "pass", text, share, limit)


def _speed_gap(design: FlatbedPress) -> tuple[float, float]:
    """What is left of the difference of the speeds, and the cylinder's speed, by the input angle [mm/rad].

    Without a lead-in the rack stands before the zone, p' - q'; with one it moves already, and what is left is the
    jump of its own velocity.
    """
    motion, cam = design.motion, design.spec.cam
    cylinder = motion.cylinder.speed(motion.sync_start)
    if cam is not None and cam.lead_in > 0.0 and design.cams.follows:
        step = design.cams.follower.velocity_step("sync")
        return step * float(motion.bed.cam_angle(motion.sync_start, 1).first), cylinder
    return motion.bed.speed(motion.sync_start) - cylinder, cylinder


def sync_length(design: FlatbedPress) -> Iterator[Check]:
    """GL502: the zone covers the print, ends before the bed turns back, and the print finds room on the cylinder."""
    yield _zone_length(design)
    yield from _turning_back(design)
    asked, room = design.spec.sync.print_length, math.tau * design.spec.cylinder.radius
    if asked > room:
        text = f"the print of {asked:g} mm is longer than the cylinder's circumference, {room:.6g} mm: print less"
        yield codes.SYNC_LENGTH.check("fail", f"{text}, or enlarge cylinder.radius", room, asked, "mm")


def _turning_back(design: FlatbedPress) -> Iterator[Check]:
    motion = design.motion
    turning = motion.bed_turns_back
    if turning is not None:
        at, end = (math.degrees(angle) for angle in (turning, motion.sync_end))
        text = f"the bed turns back at input angle {at:.6g} deg, within the zone, which ends at {end:.6g} deg: end it"
        yield codes.SYNC_LENGTH.check("fail", f"{text} before (sync.length, or sync.end)", at, end, "deg")


def _zone_length(design: FlatbedPress) -> Check:
    length, asked = design.motion.zone_length, design.spec.sync.print_length
    if asked == 0.0:
        text = f"the zone is {length:.6g} mm long; no print_length is given"
        return codes.SYNC_LENGTH.check("pass", text, length, 0.0, "mm")
    if design.spec.sync.end is None:
        remedy = "raise sync.length"
    else:
        remedy = "raise sync.end, or leave it out and give sync.length"
    return codes.SYNC_LENGTH.below(length, asked, asked, "mm", "the cylinder's travel in the zone", remedy)


def register(design: FlatbedPress) -> Iterator[Check]:
    """GL506: the cylinder makes whole turns per sheet, and of several prints in one alone."""
    ratio = design.spec.cylinder.gear_ratio
    off = abs(ratio - max(1, round(ratio)))
    text = f"the cylinder makes {amount(ratio, 'turn', spec='g')} per sheet"
    if off > 1e-9:
        text += ", so it does not come home: make cylinder.gear_ratio a whole number"
    yield codes.REGISTER.check("fail" if off > 1e-9 else "pass", text, off, 1e-9)
    yield from return_overlap(design)


# Cams


def pressure_angle(design: FlatbedPress) -> Iterator[Check]:
    """GL401 for both cams; it fails as well where no cam can make the motion at all."""
    from gearlink.core.parts.cams.checks import impossible, pressure_angle_checks

    limit = design.spec.limits.pressure_angle
    if design.cams.refusal is not None:
        yield impossible("no cam pair can bear this compensation", design.cams.refusal, limit)
        return
    over = design.advises and max(cam.max_pressure_angle.value for cam in design.cams.discs) > math.radians(limit) > 0.0
    remedy = f"{_larger(design, limit)}, or raise cam.return_angle" if over else ""
    yield from pressure_angle_checks(design.cams.discs, limit, remedy)


def _larger(design: FlatbedPress, limit: float) -> str:
    """The base radius that keeps a pressure angle [deg], with room for roller and shaft where there is such a one."""
    cams, angle = design.cams, math.radians(limit)
    try:
        radius = cams.base_radius_for(angle)
    except NoSolution:
        radius = cams.base_radius_for_pressure(angle)
    return _with_base_radius(design, radius)


def _with_base_radius(design: FlatbedPress, radius: float) -> str:
    """In words, the least base radius [mm], where a press with such a cam can be built."""
    if can_be_built(design.spec, (("cam.base_radius", radius),), greatest_length(design.spec)):
        return f"set cam.base_radius to at least {safely_above(radius)} mm"
    return f"a cam.base_radius of {safely_above(radius)} mm would do, more than can be built: allow more"


def cam_undercut(design: FlatbedPress) -> Iterator[Check]:
    """GL402 for both cams."""
    from gearlink.core.parts.cams.checks import undercut_checks

    larger = partial(_base_radius_for_roller, design) if design.advises else str
    if design.cams.refusal is None:
        yield from undercut_checks(design.cams.discs, larger)


def _base_radius_for_roller(design: FlatbedPress) -> str:
    try:
        radius = design.cams.base_radius_for_roller(design.cams.base_radius)
    except NoSolution:
        return LARGER
    return _with_base_radius(design, radius)


def shaft_clearance(design: FlatbedPress) -> Iterator[Check]:
    """GL302: the profiles against the cam shaft."""
    from gearlink.core.parts.cams.checks import hub_checks

    if design.cams.refusal is not None:
        return
    base = design.cams.base_radius
    yield from hub_checks(
        SHAFT_CLEARANCE,
        design.cams.discs,
        design.cams.section.shaft_radius,
        lambda missing: f"set cam.base_radius to at least {safely_above(base + missing)} mm",
    )


def velocity_step(design: FlatbedPress) -> Check:
    """GL403 at every joint of the lift."""
    remedy = "let the zone start where bed and cylinder have the same speed (leave sync.start out)"
    return _steps(design, VELOCITY_STEP, "first", "mm/rad", "fail", remedy)


def acceleration_step(design: FlatbedPress) -> Check:
    """GL404 at every joint of the lift."""
    remedy = "a lead_in before the zone, transition quartic and return_law cycloidal take the jumps away"
    return _steps(design, ACCELERATION_STEP, "second", "mm/rad^2", "warn", remedy)


def _steps(design: FlatbedPress, rule: Rule, derivative: str, unit: str, bad: Any, remedy: str) -> Check:
    from gearlink.core.parts.cams.checks import step_check

    follower = design.cams.follower
    peak = max(
        abs(float(getattr(segment.lift(angle, 2), derivative)))
        for segment in follower.segments
        for angle in (segment.start, 0.5 * (segment.start + segment.end), segment.end)
    )
    steps = [(_joint(joint), float(getattr(joint, rule.name.replace("-", "_")))) for joint in follower.joints]
    return step_check(rule, steps, peak, unit, bad, remedy)


def _joint(joint: Joint) -> str:
    return f"{joint.before}/{joint.after} at {math.degrees(joint.cam_angle):.5g} deg"


def constant_sum(design: FlatbedPress) -> Check:
    """GL405: the two pitch radii in contact add up to the roller distance at every cam angle."""
    import numpy as np

    theta, distance = np.radians(np.arange(0.0, 360.0, 1.0)), design.cams.roller_center_distance
    radii = [np.abs(cam.points(theta)[0]) for cam in design.cams.discs]
    off = float(np.abs(radii[0] + radii[1] - distance).max())
    limit = 1e-9 * distance
    text = f"the two pitch radii in contact add up to {distance:.6g} mm within {off:.2g} mm"
    if off > limit:
        text += ": the return cam's roller would pass the cam axis; raise cam.base_radius"
    return CONSTANT_SUM.check("fail" if off > limit else "pass", text, off, limit, "mm")
