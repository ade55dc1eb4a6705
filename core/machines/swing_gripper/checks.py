"""Checks of a swing gripper: law, linkage, handover, cams and force closure; each is a function of the design."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.report import Check, Rule, Status, safely_above, safely_below
from gearlink.core.machines.swing_gripper import codes
from gearlink.core.parts.cams import codes as cam_codes
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import SwingGripper
    from gearlink.core.machines.swing_gripper.spec import Release

# Share of the surface speed that the two may differ by: rounding only.
_SPEED_SHARE = 1e-9
# A tip farther off [mm] misses the sheet's edge by more than a gripper's pad holds, whatever the file allows.
_MOST_OFF_PLACE = 1.0
# Closed form and Newton-Raphson each lose 8 eps times the condition number.
_AGREEMENT = 64.0 * 2.0**-52


def transmission_angle(design: SwingGripper) -> Iterator[Check]:
    """GL303 at D and at C."""
    from gearlink.core.machines.swing_gripper.swing import turn_remedy

    limit = design.spec.limits.transmission_angle
    for place, angle in zip(
        ("D (coupler, output)", "C (input, coupler)"), design.motion.min_transmission_angle, strict=True
    ):
        aim = limit if math.degrees(angle) < limit else limit + 5.0
        near = design.advises and math.degrees(angle) < limit + 5.0
        remedy = turn_remedy(design.motion.linkage, math.radians(aim), tells=False) if near else ""
        subject = f"the least transmission angle at {place}"
        yield transmission_check(angle, limit, remedy, subject)


def conditioning(design: SwingGripper) -> Check:
    """GL312: digits that the loop keeps near a dead point, and the agreement of the two ways."""
    number, limit = design.motion.condition_number, design.spec.limits.condition_number
    agreement = design.motion.newton_agreement
    status: Status = "warn" if number > limit else "pass"
    text = f"closed form and Newton-Raphson agree within {agreement:.2g} rad at condition number {number:.4g}"
    if status == "warn":
        text += f", above the limit {limit:g}" + (_loss_near_dead_point(design) if design.advises else "")
    elif design.motion.linkage.four_bar.kind() == "change-point":
        status = "warn"
        text += (
            "; shortest and longest link add up to the other two, so in line with the frame the assembly is not "
            f"determined: the swing keeps {math.degrees(min(design.motion.min_transmission_angle)):.4g} deg from there"
        )
    if agreement > _AGREEMENT * number:
        status = "fail"
        text += ": they should agree better; report the design file"
    return codes.CONDITIONING.check(status, text, number, limit)


def _loss_near_dead_point(design: SwingGripper) -> str:
    """Words for what the linkage loses, and how it would keep it."""
    from gearlink.core.machines.swing_gripper.swing import turn_remedy

    linkage, (at_d, at_c) = design.motion.linkage, design.motion.min_transmission_angle
    loss = 8.0 * 2.0**-52 / math.sin(at_c)
    loose, length = ("cam rocker", linkage.input) if at_c < at_d else ("gripper", linkage.output)
    play = math.degrees(0.01 * design.motion.condition_number / length)
    return (
        f": computed angles keep {loss:.1g} rad, accelerations {4.0 * loss / math.sin(at_c):.1g} of their size, and "
        f"0.01 mm of play turns the {loose} by {play:.2g} deg; "
        f"{turn_remedy(linkage, math.radians(design.spec.limits.transmission_angle), tells=False)}"
    )


def velocity_step(design: SwingGripper) -> Check:
    """GL403 at the six joints of the law."""
    return _steps(design, cam_codes.VELOCITY_STEP, 1, "fail")


def acceleration_step(design: SwingGripper) -> Iterator[Check]:
    """GL404 at the six joints of the law, and within a law."""
    yield _steps(design, cam_codes.ACCELERATION_STEP, 2, "warn")
    for phase in design.motion.law.inner_steps:
        text = f"the acceleration jumps within phase {phase}: take a law like modified-sine in laws.{phase}"
        yield cam_codes.ACCELERATION_STEP.check("warn", text)


def _steps(design: SwingGripper, rule: Rule, order: int, bad: Status) -> Check:
    import numpy as np

    from gearlink.core.parts.cams.checks import step_check

    peak = float(np.abs(design.motion.law.evaluate(np.arange(0.0, 360.0, 0.5), order)[order]).max())
    unit = "rad/rad" if order == 1 else "rad/rad^2"
    return step_check(rule, _jumps(design, order), peak, unit, bad, "take laws without end acceleration in laws")


def _jumps(design: SwingGripper, order: int) -> list[tuple[str, float]]:
    from gearlink.core.machines.swing_gripper.law import PHASES

    jumps = design.motion.law.joints()[:, order]
    return [(f"start of {phase}", float(jump)) for phase, jump in zip(PHASES, jumps, strict=True)]


def jerk_step(design: SwingGripper) -> Check:
    """GL407: the largest jump of the third derivative at a joint; a limit only where the file gives one."""
    limit = design.spec.limits.jerk_step
    where, jump = max(_jumps(design, 3), key=lambda item: abs(item[1]))
    text = f"the swing's jerk jumps by {jump:+.4g} rad/rad^3 at the {where}"
    status: Status = "warn" if limit is not None and abs(jump) > limit else "pass"
    if status == "warn":
        text += f", above limits.jerk_step {limit:g}: polynomial-4567, velocity-4567 and {{septic: 0.5}} end without"
    return cam_codes.JERK_STEP.check(status, text, abs(jump), limit)


def handover(design: SwingGripper) -> Iterator[Check]:
    """GL503: speed, place and release window."""
    yield _backward_check(design) if runs_backwards(design) else _speed_check(design)
    if design.spec.cylinder.center is not None:
        yield _place_check(design, complex(*design.spec.cylinder.center))
    if design.spec.release is not None:
        yield _inside_check(design, design.spec.release)
        yield _gap_check(design, design.spec.release)


def _speed_check(design: SwingGripper) -> Check:
    mismatch, speed = design.handover.mismatch, design.spec.cylinder.radius * design.motion.shaft_speed
    share = abs(mismatch) / speed
    status: Status = "fail" if share > _SPEED_SHARE else "pass"
    text = f"gripper and cylinder run at {speed:.6g} mm/s at the handover, mismatch {mismatch:.2g} mm/s"
    if status == "fail":
        start, end = design.motion.law.starts[1:3]
        text += f": set handover to {0.5 * (start + end):g}, the middle of the constant phase"
    return codes.HANDOVER.check(status, text, share, _SPEED_SHARE)


def runs_backwards(design: SwingGripper) -> bool:
    """Whether the cam stands on the shaft of the cylinder that takes the sheet and turns it as the gripper swings."""
    cam = design.spec.cam
    if cam is None or cam.center is None or cam.sense != design.spec.swing_sense:
        return False
    from gearlink.core.machines.swing_gripper.passes import cam_turns_drum

    return cam_turns_drum(design)


def _backward_check(design: SwingGripper) -> Check:
    """GL503 of a cylinder that turns with the gripper: on the line of centres the two then run against each other."""
    speed = design.spec.cylinder.radius * design.motion.shaft_speed
    apart = abs(design.handover.speed + speed)
    text = (
        f"the cam turns the cylinder on its shaft in the sense of the gripper's swing, so that tip and surface meet "
        f"at {apart:.6g} mm/s against each other at the handover: reverse cam.sense or swing_sense, or move cam.center "
        "to a shaft of its own"
    )
    return codes.HANDOVER.check("fail", text, apart / speed, _SPEED_SHARE)


def _place_check(design: SwingGripper, center: complex) -> Check:
    from gearlink.core.machines.swing_gripper.handover_geometry import misplacement

    limit = design.spec.limits.handover_place
    off = misplacement(complex(*design.spec.pivots.output), design.handover.tip, center, design.spec.cylinder.radius)
    status: Status = "fail" if off.place > limit else "warn" if off.place > _MOST_OFF_PLACE else "pass"
    text = f"the gripper tip stands {off.place:.4g} mm off its place on the line of centres at the handover"
    if status != "pass":
        fits = design.handover.center
        changes = [f"turn arm.direction by {math.degrees(off.turn):+.6g} deg"]
        if abs(off.distance) > min(limit, _MOST_OFF_PLACE):
            changes.append(f"change arm.length by {off.distance:+.6g} mm (the speeds then differ)")
        above = f"above the limit {limit:g} mm"
        if status == "warn":
            above = f"as limits.handover_place allows, though above {_MOST_OFF_PLACE:g} mm no sheet is handed over well"
        text += f", {above}: {' and '.join(changes)}, or set cylinder.center to [{fits.real:.6g}, {fits.imag:.6g}]"
    return codes.HANDOVER.check(status, text, off.place, _MOST_OFF_PLACE if status == "warn" else limit, "mm")


def _inside_check(design: SwingGripper, release: Release) -> Check:
    start, end = design.motion.law.starts[1:3]
    room = min(design.spec.handover - start, end - design.spec.handover)
    status: Status = "warn" if release.window > room else "pass"
    text = (
        f"gripper and cylinder run at one speed for {room:g} deg to either side of the handover; the sheet changes "
        f"over within {release.window:g} deg, {release.window / 360.0 * 3.6e6 / design.spec.speed:.4g} ms"
    )
    if status == "warn":
        text += (
            f": set phases.constant to at least {2.0 * release.window:g} deg with the handover in its middle, or "
            f"release.window to at most {safely_below(room) if room else 'its'} deg"
        )
    return codes.HANDOVER.check(status, text, release.window, room, "deg")


def _gap_check(design: SwingGripper, release: Release) -> Check:
    import numpy as np

    from gearlink.core.machines.swing_gripper.handover_geometry import widest_window

    degrees = design.spec.handover + release.window * np.array([-1.0, 0.0, 1.0])
    _, _, path = design.handover.path(degrees)
    gap, slip = float(np.abs(path.gap).max()), float(np.abs(path.slip).max())
    status: Status = "warn" if gap > release.gap else "pass"
    text = (
        f"the tip leaves the pitch circle by {gap:.4g} mm and slips by {slip:.2g} mm within {release.window:g} deg "
        "of the handover"
    )
    if status == "warn":
        widest = widest_window(design.spec.arm.length, design.spec.cylinder.radius, release.gap)
        text += (
            f", above release.gap {release.gap:g} mm: set release.window to at most "
            f"{safely_below(math.degrees(widest), 4)} deg, or allow a gap of {safely_above(gap, 3)} mm"
        )
    return codes.HANDOVER.check(status, text, gap, release.gap, "mm")


def pressure_angle(design: SwingGripper) -> Iterator[Check]:
    """GL401 for both cams over the turn, and a warning for the phase accelerate; it fails where no cam can be."""
    from gearlink.core.parts.cams.checks import impossible, is_steep, pressure_angle_checks

    limit = design.spec.limits.pressure_angle
    if design.cams.refusal is not None:
        yield impossible("no cam can make this motion", design.cams.refusal, limit)
        return
    over = design.advises and limit > 0.0 and is_steep(max(design.cams.max_pressure_angle), math.radians(limit))
    yield from pressure_angle_checks(design.cams.discs, limit, design.cams.center_remedy(limit) if over else "")
    if design.warnings:
        yield from _accelerating(design, design.spec.limits.accelerate_pressure_angle)


def _accelerating(design: SwingGripper, limit: float) -> Iterator[Check]:
    from gearlink.core.parts.cams.checks import is_steep
    from gearlink.core.parts.cams.disc_cam import largest_pressure_angles

    cams, end = design.cams.discs, math.radians(design.motion.law.starts[1])
    for cam, worst in zip(cams, largest_pressure_angles(cams, 0.0, end, 128), strict=True):
        value = math.degrees(abs(worst.value))
        status: Status = "warn" if is_steep(value, limit) else "pass"
        text = (
            f"the pressure angle of the {cam.name} reaches {value:.6g} deg while it accelerates the gripper, at "
            f"cam angle {math.degrees(worst.place):.5g} deg"
        )
        if status == "warn":
            text += f", above {limit:g} deg"
            text += f": {design.cams.center_remedy(limit)}" if design.advises else ""
        yield cam_codes.PRESSURE_ANGLE.check(status, text, value, limit, "deg")


def cam_undercut(design: SwingGripper) -> Iterator[Check]:
    """GL402 for both cams."""
    from gearlink.core.parts.cams.checks import undercut_checks

    yield from undercut_checks(design.cams.discs, plainly=codes.FARTHER)


def shaft_clearance(design: SwingGripper) -> Iterator[Check]:
    """GL302: the profiles against the cam shaft; cams, links, rollers, arm and drum against the axes of the frame."""
    from gearlink.core.parts.cams.checks import hub_checks

    if design.warnings:
        from gearlink.core.machines.swing_gripper.axes import beside_axes

        yield from beside_axes(design)
    yield from hub_checks(
        SHAFT_CLEARANCE,
        design.cams.discs,
        design.cams.section.shaft_radius,
        lambda missing: f"set cam.center {missing:.4g} mm farther from the roller",
    )


def lift_off(design: SwingGripper) -> Check:
    """GL406: contact at the design speed, with a tenth of speed in reserve; it fails where nothing closes both.

    Notes
        The two rollers sit on rockers of their own, which the spring pulls together: without it neither is pressed on
        its cam. That is a warning, since the file may leave out the spring that the machine has.
    """
    if design.closure.refusal is not None:
        text = design.closure.refusal.message
        return cam_codes.LIFT_OFF.check("fail", text, None, design.spec.speed, "sheets/h")
    if design.spec.spring is None:
        rollers = "either roller on its cam" if len(design.cams.discs) > 1 else "the roller on its cam"
        text = f"nothing presses {rollers}: give the spring between the rockers, spring.torque or its levers"
        return cam_codes.LIFT_OFF.check("warn", text, None, design.spec.speed, "sheets/h")
    torque, speed, reserve = design.closure.closing_torque, design.closure.lift_off_speed, design.closure.spring.reserve
    names = [cam.name.removesuffix(" cam") for cam in design.cams.discs]
    roller, worst = max(zip(names, design.closure.worst_unloading, strict=True), key=lambda item: item[1].value)
    if speed is None:
        return cam_codes.LIFT_OFF.check("pass", "no inertia ever unloads a roller", None, None, "sheets/h")
    left = torque - worst.value
    status: Status = "fail" if left <= reserve else "warn" if speed < 1.1 * design.spec.speed else "pass"
    text = (
        f"the {roller} roller keeps {left:.4g} N m of the spring's {torque:.6g} N m at cylinder angle "
        f"{worst.place:.4g} deg; it lifts off at {speed:.6g} sheets/h"
    )
    if left <= reserve and reserve > 0.0:
        text += f", and {reserve:g} N m are to remain"
    if status != "pass":
        # of a check that fails the value is tried, and said behind
        remedy = design.closure.spring_remedy(1.21 * worst.value + reserve, tells=status == "warn")
        text += f": {remedy} for a tenth of speed in reserve, or lower the speed"
    return cam_codes.LIFT_OFF.check(status, text, speed, design.spec.speed, "sheets/h")
