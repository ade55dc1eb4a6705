"""Checks of a swing gripper: law, linkage, shafts, handover, cams, force closure; each is a function of the design.

GL302 says how near links and rollers come to the axes of the frame that they do not turn about. All positions of the
linkage are those of the swing from 0 to its total, run through forth and back in a turn. The cam rocker turns one way
meanwhile, since it may not come to a dead centre.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterator
from functools import partial
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import REFUSAL, Way, at_least, at_most, down, either, refusal_ways, shared, up
from gearlink.core.base.report import NO_NUMBER, Check, Rule, Shown, Status, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.swing_gripper import codes
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.cams import codes as cam_codes
from gearlink.core.parts.cams.checks import (
    AS_THICK_AS_ROLLER,
    HUB,
    ROLLER_SHARE,
    hub_checks,
    impossible,
    is_steep,
    over_axis_check,
    pressure_angle_checks,
    step_check,
    undercut_checks,
)
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance import beside_line, beside_turning_arm, beside_turning_pin

if TYPE_CHECKING:
    from gearlink.core.base.report import Remedy
    from gearlink.core.machines.swing_gripper.design import SwingGripper
    from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
    from gearlink.core.machines.swing_gripper.spec import Phases, Release


_SAMPLES = 256
_ROUNDS, _PARTS = 5, 64
_DRUM_REMEDY = "turn arm.direction"


ONE_SHAFT = 0.1
"""Axes that stand no farther apart [mm] are those of one shaft: two shafts never do."""


class Axis(NamedTuple):
    """An axis of the frame.

    Parameters
        letter : str - A, E, O of the cam, T of the cylinder that takes the sheet
        name : str - "the cam shaft"
        place : complex [mm]
        radius : float [mm] - of its shaft, 0 where the file does not name it
        remedy : str - what moves it
    """

    letter: str
    name: str
    place: complex
    radius: float
    remedy: str


class Pass(NamedTuple):
    """A link or a roller at its nearest to an axis.

    Parameters
        body : str - "coupler CD"
        radius : float [mm] - of a roller, 0 of a link
        axis : Axis
        distance : float [mm] - of the axis from the line of the link or the roller's centre
        turned : float [rad] - how far the gripper has swung then, or the cam rocker turned where it is `by_rocker`
    """

    body: str
    radius: float
    axis: Axis
    distance: float
    turned: float
    by_rocker: bool = False


def drum_axis(design: SwingGripper) -> complex:
    """Axis of the cylinder that takes the sheet [mm]: the file's, or the one that fits."""
    given = design.spec.cylinder.center
    return complex(*given) if given is not None else design.handover.center


def cam_turns_drum(design: SwingGripper) -> bool:
    """Whether the cam stands on the shaft of the cylinder that takes the sheet."""
    return abs(drum_axis(design) - design.cams.center) <= ONE_SHAFT


def axes_of(design: SwingGripper) -> tuple[Axis, ...]:
    """The axes of the frame; that of the cylinder unless the cam stands on it."""
    spec, shaft = design.spec, design.cams.section.shaft_radius
    named = f"the cam shaft (radius {shaft:g} mm)" if shaft > 0.0 else "the cam axis"
    axes = (
        Axis("O", named, design.cams.center, shaft, "move cam.center"),
        Axis("A", "the cam rocker's axis", complex(*spec.pivots.input), 0.0, "move pivots.input"),
        Axis("E", "the gripper's axis", complex(*spec.pivots.output), 0.0, "move pivots.output"),
    )
    if cam_turns_drum(design):
        return axes
    return (*axes, Axis("T", "the axis of the cylinder that takes the sheet", drum_axis(design), 0.0, _DRUM_REMEDY))


class Passes:
    """What passes the axes of a gripper with cams."""

    def __init__(self, design: SwingGripper) -> None:
        self.axes, self.section, self.linkage = axes_of(design), design.cams.section, design.motion.linkage

    def __iter__(self) -> Iterator[Pass]:
        """Every link and roller against every axis that is not its own."""
        linkage, section = self.linkage, self.section
        rocker, ahead = self._rocker, cmath.exp(1j * math.radians(section.roller.angle))
        yield from self._coupler()
        yield from self._turning("cam rocker AC", "A", linkage.input * rocker)
        sense = linkage.swing_sense * linkage.law.total_swing
        for axis in self.axes:
            if axis.letter != "E":
                arm = cmath.rect(linkage.output, linkage.output_direction)
                near = beside_turning_arm(axis.place - linkage.output_pivot, arm, sense)
                yield Pass("output link ED", 0.0, axis, near.distance, near.turned)
        yield from self._roller("main", section.roller.arm * rocker * ahead, section.roller.radius)
        back = section.return_roller
        if back is not None:
            arm = back.arm * rocker * ahead * cmath.exp(1j * math.radians(back.angle))
            yield from self._roller("return", arm, back.radius)

    def _roller(self, name: str, arm: complex, radius: float) -> Iterator[Pass]:
        yield from self._turning(f"{name} roller's arm", "A", arm)
        yield from self._turning(f"{name} roller", "AO", arm, radius)

    def _turning(self, body: str, own: str, arm: complex, radius: float = 0.0) -> Iterator[Pass]:
        """What turns with the cam rocker; a roller where there is a radius. It rides on its cam beside O."""
        beside = beside_turning_pin if radius else beside_turning_arm
        for axis in self.axes:
            if axis.letter not in own:
                near = beside(axis.place - self.linkage.input_pivot, arm, self._sweep)
                yield Pass(body, radius, axis, near.distance, near.turned, by_rocker=True)

    def _coupler(self) -> Iterator[Pass]:
        from gearlink.core.numerics.extremes import extremes_over

        total, ends = self.linkage.law.total_swing, kept_last(partial(_coupler_ends, self.linkage))
        wanted = [(lambda swing, place=axis.place: beside_line(place, *ends(swing)), False) for axis in self.axes]
        found = extremes_over(wanted, 0.0, total, samples=_SAMPLES)
        for axis, least in zip(self.axes, found, strict=True):
            yield Pass("coupler CD", 0.0, axis, least.value, least.place)

    # The turn of the cam rocker over the swing

    @cached_property
    def _ends(self) -> Reals:
        """Angles of the cam rocker at both ends of the swing [rad]."""
        return _input_angle(self.linkage, np.array([0.0, self.linkage.law.total_swing]))

    @property
    def _rocker(self) -> complex:
        """Direction of AC at the pick-up position."""
        return cmath.rect(1.0, float(self._ends[0]))

    @property
    def _sweep(self) -> float:
        return float(self._ends[1] - self._ends[0])

    def cylinder_angle(self, found: Pass) -> float:
        """Cylinder angle of a pass in the working stroke [deg]."""
        swing = self._swing_at(found.turned) if found.by_rocker else found.turned
        return self.linkage.law.reaches(min(max(swing, 0.0), self.linkage.law.total_swing))

    def _swing_at(self, turned: float) -> float:
        """The swing [rad] at which the cam rocker has turned so far."""
        low, high = 0.0, self.linkage.law.total_swing
        if turned in (0.0, abs(self._sweep)):
            return high if turned else low
        for _ in range(_ROUNDS):
            swing = np.linspace(low, high, _PARTS + 1)
            part = int(np.searchsorted(np.abs(_input_angle(self.linkage, swing) - self._ends[0]), turned))
            part = min(max(part, 1), _PARTS)
            low, high = float(swing[part - 1]), float(swing[part])
        return 0.5 * (low + high)


def _coupler_ends(linkage: GripperLinkage, swing: Reals) -> tuple[Points, Points]:
    """C and D [mm] at swing angles [rad]."""
    motion = linkage.at(swing, (swing,))
    c = linkage.input_pivot + linkage.input * np.exp(1j * motion.input_angle)
    d = linkage.output_pivot + linkage.output * np.exp(1j * motion.output_angle)
    return c, d


def _input_angle(linkage: GripperLinkage, swing: Reals) -> Reals:
    return linkage.at(swing, (swing,)).input_angle


# Share of the surface speed that the two may differ by: rounding only.
_SPEED_SHARE = 1e-9
# Share of the near dwell in which the arm should rest on its stop.
_SETTLED_SHARE = 0.25
# A tip farther off [mm] misses the sheet's edge by more than a gripper's pad holds, whatever the file allows.
_MOST_OFF_PLACE = 1.0
# Closed form and Newton-Raphson each lose 8 eps times the condition number.
_AGREEMENT = 64.0 * 2.0**-52


def transmission_angle(design: SwingGripper) -> Iterator[Check]:
    """GL303 at D and at C."""
    from gearlink.core.machines.swing_gripper.linkage import turn_remedy

    limit = design.spec.limits.transmission_angle
    for place, angle in zip(
        ("D (coupler, output)", "C (input, coupler)"), design.motion.min_transmission_angle, strict=True
    ):
        aim = limit if math.degrees(angle) < limit else limit + 5.0
        near = design.advises and math.degrees(angle) < limit + 5.0
        remedy = turn_remedy(design.motion.linkage, math.radians(aim), tells=False) if near else ""
        subject = f"minimum transmission angle at {place}"
        yield transmission_check(angle, limit, remedy, subject)


def conditioning(design: SwingGripper) -> Check:
    """GL312: digits that the loop keeps near a dead centre, and the agreement of the two ways."""
    number, limit = design.motion.condition_number, design.spec.limits.condition_number
    agreement = design.motion.newton_agreement
    status: Status = "warn" if number > limit else "pass"
    what, aside = "condition number near a dead centre", f"solutions agree within {agreement:.2g} rad"
    if agreement > _AGREEMENT * number:
        what, shown = "difference of closed form and Newton-Raphson", Shown(agreement, _AGREEMENT * number, "rad", "<=")
        fix = "report the design file"
        return codes.CONDITIONING.check("fail", what, number, limit, shown=shown, fix=fix)
    if status == "pass" and design.motion.linkage.four_bar.kind() == "change-point":
        margin = math.degrees(min(design.motion.min_transmission_angle))
        what, shown = "distance of the swing from the change point of the linkage", Shown(margin, None, "deg")
        fix = "change a link so that shortest and longest link do not add up to the other two"
        return codes.CONDITIONING.check("warn", what, number, limit, shown=shown, fix=fix)
    fix = note = ""
    if status == "warn" and design.advises:
        fix, note = _away_from_dead_centre(design), _loss_near_dead_centre(design)
    return codes.CONDITIONING.check(status, what, number, limit, aside=aside, fix=fix, note=note)


def _away_from_dead_centre(design: SwingGripper) -> str:
    from gearlink.core.machines.swing_gripper.linkage import turn_remedy

    aim = math.radians(design.spec.limits.transmission_angle)
    return turn_remedy(design.motion.linkage, aim, tells=False)


def _loss_near_dead_centre(design: SwingGripper) -> str:
    """What clearance of 0.01 mm turns the links by."""
    linkage, (at_d, at_c) = design.motion.linkage, design.motion.min_transmission_angle
    loose, length = ("cam rocker", linkage.input) if at_c < at_d else ("gripper", linkage.output)
    turned = math.degrees(0.01 * design.motion.condition_number / length)
    return f"0.01 mm of clearance turns the {loose} by {short(turned, 2)} deg"


def velocity_step(design: SwingGripper) -> Check:
    """GL403 at the six joints of the law."""
    return _steps(design, cam_codes.VELOCITY_STEP, 1, "fail")


def acceleration_step(design: SwingGripper) -> Iterator[Check]:
    """GL404 at the six joints of the law, and within a law."""
    yield _steps(design, cam_codes.ACCELERATION_STEP, 2, "warn")
    for phase in design.motion.law.inner_steps:
        what, fix = f"the acceleration steps within phase {phase}", f"set laws.{phase} to modified-sine"
        yield cam_codes.ACCELERATION_STEP.check("warn", what, fix=fix)


def _steps(design: SwingGripper, rule: Rule, order: int, bad: Status) -> Check:
    peak = design.motion.law.peak(order)
    unit = "rad/rad" if order == 1 else "rad/rad^2"
    return step_check(rule, _jumps(design, order), peak, unit, bad, "take laws without end acceleration in laws")


def _jumps(design: SwingGripper, order: int) -> list[tuple[str, float]]:
    from gearlink.core.machines.swing_gripper.law import PHASES

    jumps = design.motion.law.joints[:, order]
    return [(f"start of {phase}", float(jump)) for phase, jump in zip(PHASES, jumps, strict=True)]


def jerk_step(design: SwingGripper) -> Check:
    """GL407: the largest jump of the third derivative at a joint; a limit only where the file gives one."""
    limit = design.spec.limits.jerk_step
    where, jump = max(_jumps(design, 3), key=lambda item: abs(item[1]))
    status: Status = "warn" if limit is not None and abs(jump) > limit else "pass"
    what, fix = "step of the swing's jerk (rad/rad^3)", "take the laws polynomial-4567 or velocity-4567"
    return cam_codes.JERK_STEP.check(status, what, abs(jump), limit, at=f"the {where}", fix=fix)


def phase_allotment(design: SwingGripper) -> Check:
    """GL420: the peak acceleration of the return over that of the phase accelerate; a limit only where given."""
    law, limit = design.motion.law, design.spec.limits.return_acceleration
    first, _, _, _, back, _ = design.motion.phase_angles
    ratio = law.total_swing * law.return_.peak_acceleration * first / (back * back)
    ratio /= law.speed * law.accelerate.peak_acceleration
    status: Status = "fail" if limit is not None and ratio > limit else "pass"
    what, fix = "peak acceleration of the return over that of the phase accelerate", "lengthen phases.return"
    return codes.PHASE_ALLOTMENT.check(status, what, ratio, limit, fix=fix)


def stop_settling(design: SwingGripper) -> Iterator[Check]:
    """GL421: what is left of the near dwell when the arm rests on its stop."""
    if design.spec.stop is None:
        return
    margin, least = design.stop.margin, _SETTLED_SHARE * design.motion.phases.near_dwell
    status: Status = "fail" if margin < 0.0 else "warn" if margin < least else "pass"
    what, overlap = "rest on the stop before the pick-up", "settling on the stop beyond the pick-up"
    at = f"{short(design.stop.impact_degrees)} deg"
    limit = 0.0 if status == "fail" else least
    fix = "lower stop.restitution or stop.clearance" if status != "pass" else ""
    aside = f"settled in {short(design.stop.settling_time)} ms"
    yield codes.STOP_SETTLING.check(status, what, margin, limit, "deg", at=at, fix=fix, aside=aside, overlap=overlap)


def finger_release(design: SwingGripper) -> Iterator[Check]:
    """GL423: the fingers are half open where the release window ends."""
    if design.spec.fingers is None:
        return
    opened, half = math.degrees(design.fingers.opened), 0.5 * design.spec.fingers.open_angle
    status: Status = "fail" if opened < half else "pass"
    what, at = "opening of the fingers where the release ends", f"{short(design.fingers.release_degrees)} deg"
    fix = "lower fingers.open.from or fingers.open.over" if status == "fail" else ""
    yield codes.FINGER_RELEASE.check(status, what, opened, half, "deg", at=at, fix=fix)


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
    start, end = design.motion.law.starts[1:3]
    return codes.HANDOVER.check(
        status,
        "speed difference of gripper and cylinder at the handover",
        share,
        _SPEED_SHARE,
        shown=Shown(abs(mismatch), _SPEED_SHARE * speed, "mm/s", "<="),
        aside=f"cylinder {short(speed)} mm/s",
        fix=f"set handover to {0.5 * (start + end):g}, the middle of the constant phase",
    )


def runs_backwards(design: SwingGripper) -> bool:
    """Whether the cam stands on the shaft of the cylinder that takes the sheet and turns it as the gripper swings."""
    cam = design.spec.cam
    if cam is None or cam.center is None or cam.sense != design.spec.swing_sense:
        return False

    return cam_turns_drum(design)


def _backward_check(design: SwingGripper) -> Check:
    """GL503 of a cylinder that turns with the gripper: on the line of centres the two then run against each other."""
    speed = design.spec.cylinder.radius * design.motion.shaft_speed
    apart = abs(design.handover.speed + speed)
    return codes.HANDOVER.check(
        "fail",
        "speed difference of gripper and cylinder at the handover",
        apart / speed,
        _SPEED_SHARE,
        shown=Shown(apart, _SPEED_SHARE * speed, "mm/s", "<="),
        aside="the cam turns the cylinder on its shaft in the sense of the gripper's swing",
        fix="reverse cam.sense",
    )


def _place_check(design: SwingGripper, center: complex) -> Check:
    from gearlink.core.machines.swing_gripper.handover_geometry import misplacement

    limit = design.spec.limits.handover_place
    off = misplacement(complex(*design.spec.pivots.output), design.handover.tip, center, design.spec.cylinder.radius)
    status: Status = "fail" if off.place > limit else "warn" if off.place > _MOST_OFF_PLACE else "pass"
    fits, fix = design.handover.center, f"turn arm.direction by {math.degrees(off.turn):+.4g} deg"
    if abs(off.distance) > min(limit, _MOST_OFF_PLACE):
        fix = f"set cylinder.center to [{short(fits.real)}, {short(fits.imag)}]"
    note = "no sheet is handed over well so far off" if status == "warn" else ""
    what, most = "distance of the gripper tip from the handover point", _MOST_OFF_PLACE if status == "warn" else limit
    return codes.HANDOVER.check(status, what, off.place, most, "mm", fix=fix, note=note)


def _inside_check(design: SwingGripper, release: Release) -> Check:
    start, end = design.motion.law.starts[1:3]
    room = min(design.motion.handover - start, end - design.motion.handover)
    status: Status = "warn" if release.window > room else "pass"
    what = "release window on either side of the handover"
    aside = f"{short(release.window / 360.0 * 3.6e6 / design.spec.speed)} ms, at equal speed"
    fix = f"set phases.constant to at least {safely_above(2.0 * release.window)} deg, the handover in its middle"
    return codes.HANDOVER.check(status, what, release.window, room, "deg", aside=aside, fix=fix)


def _gap_check(design: SwingGripper, release: Release) -> Check:
    from gearlink.core.machines.swing_gripper.handover_geometry import widest_window

    degrees = design.motion.handover + release.window * np.array([-1.0, 0.0, 1.0])
    _, _, path = design.handover.path(degrees)
    gap, slip = float(np.abs(path.gap).max()), float(np.abs(path.slip).max())
    status: Status = "warn" if gap > release.gap else "pass"
    fix = ""
    if status == "warn":
        widest = widest_window(design.spec.arm.length, design.spec.cylinder.radius, release.gap)
        fix = f"set release.window to at most {safely_below(math.degrees(widest))} deg"
    what, aside = "gap of the gripper tip from the pitch circle in the release window", f"slip {short(slip)} mm"
    return codes.HANDOVER.check(status, what, gap, release.gap, "mm", aside=aside, fix=fix)


def pressure_angle(design: SwingGripper) -> Iterator[Check]:
    """GL401 for all cams over the turn, and a warning for the phase accelerate; it fails where no cam can be."""
    limit = design.spec.limits.pressure_angle
    if design.spec.fingers is not None:
        fix = "lengthen fingers.open.over and fingers.close.over, or fingers.lever"
        yield from pressure_angle_checks((design.fingers.cam,), limit, fix)
    if design.spec.cam is None:
        return
    if design.cams.refusal is not None:
        yield impossible("no cam can make this motion", design.cams.refusal, limit)
        return
    over = design.advises and limit > 0.0 and is_steep(max(design.cams.max_pressure_angle), math.radians(limit))
    yield from pressure_angle_checks(design.cams.discs, limit, design.cams.center_remedy(limit) if over else "")
    if design.warnings:
        yield from _accelerating(design, design.spec.limits.accelerate_pressure_angle)


def _accelerating(design: SwingGripper, limit: float) -> Iterator[Check]:
    from gearlink.core.parts.cams.disc_cam import largest_pressure_angles

    cams, end = design.cams.discs, math.radians(design.motion.law.starts[1])
    for cam, worst in zip(cams, largest_pressure_angles(cams, 0.0, end, 128), strict=True):
        value = math.degrees(abs(worst.value))
        status: Status = "warn" if is_steep(value, limit) else "pass"
        what = f"pressure angle of the {cam.name} while it accelerates the gripper"
        at = f"cam angle {short(math.degrees(worst.place))} deg"
        fix = design.cams.center_remedy(limit) if status == "warn" and design.advises else ""
        yield cam_codes.PRESSURE_ANGLE.check(status, what, value, limit, "deg", at=at, fix=fix)


def cam_undercut(design: SwingGripper) -> Iterator[Check]:
    """GL402 for both cams, and for that of the fingers."""
    if design.spec.cam is not None:
        yield from undercut_checks(design.cams.discs, plainly=codes.FARTHER)
    if design.spec.fingers is not None:
        yield from undercut_checks((design.fingers.cam,), plainly="set a smaller fingers.roller_radius")


def shaft_clearance(design: SwingGripper) -> Iterator[Check]:
    """GL302: the profiles against the cam shaft; cams, links, rollers, arm and drum against the axes of the frame."""
    if design.warnings:
        yield from beside_axes(design)
    yield from hub_checks(
        SHAFT_CLEARANCE,
        design.cams.discs,
        design.cams.section.shaft_radius,
        lambda missing: f"set cam.center {safely_above(missing)} mm farther from the roller",
    )


def lift_off(design: SwingGripper) -> Check:
    """GL406: contact at the design speed, with a tenth of speed in reserve; it fails where nothing closes both.

    Notes
        The two rollers sit on rockers of their own, which the spring pulls together: without it neither is pressed on
        its cam. That is a warning, since the file may leave out the spring that the machine has.
    """
    if design.closure.refusal is not None:
        what, fix = design.closure.refusal.message, design.closure.refusal.fix
        return cam_codes.LIFT_OFF.check("fail", what, None, design.spec.speed, "sheets/h", fix=fix)
    if design.spec.spring is None:
        rollers = "either roller on its cam" if len(design.cams.discs) > 1 else "the roller on its cam"
        what, fix = f"nothing presses {rollers}", "give spring.torque, or the levers of the spring"
        return cam_codes.LIFT_OFF.check("warn", what, None, design.spec.speed, "sheets/h", fix=fix)
    torque, speed, reserve = design.closure.closing_torque, design.closure.lift_off_speed, design.closure.spring.reserve
    names = [cam.name.removesuffix(" cam") for cam in design.cams.discs]
    roller, worst = max(zip(names, design.closure.worst_unloading, strict=True), key=lambda item: item[1].value)
    if speed is None:
        return cam_codes.LIFT_OFF.check("pass", "no speed lifts a roller off its cam", None, None, "sheets/h")
    status: Status = (
        "fail" if torque - worst.value <= reserve else "warn" if speed < 1.1 * design.spec.speed else "pass"
    )
    needed = worst.value + reserve
    fix = ""
    if status != "pass":
        # of a check that fails the value is tried
        fix = (
            design.closure.spring_remedy(1.21 * worst.value + reserve, tells=status == "warn") + " (10 % speed margin)"
        )
    return cam_codes.LIFT_OFF.check(
        status,
        f"lift-off speed of the {roller} roller",
        speed,
        design.spec.speed,
        "sheets/h",
        recommended=1.1 * design.spec.speed,
        aside=f"required {short(needed)} N m, spring {short(torque)} N m",
        at=f"cylinder angle {short(worst.place)} deg",
        fix=fix,
    )


_RESERVE = 1.1
"""Speed at which a roller may lift off, over the speed of the machine."""
_FINE = 3
"""Digits behind the point of what places the handover."""
_LINKAGE = (*either("output_direction", step=0.5), *either("links.coupler", "links.output", "links.input"))
_ROLLERS = either("cam.roller.angle", "cam.return_roller.angle", step=1.0)
_WAYS = {
    "transmission-angle": _LINKAGE,
    "conditioning": _LINKAGE,
    "handover": (down("release.window"),),
    "pressure-angle": (*_ROLLERS, *_LINKAGE),
    "shaft-clearance": (*_ROLLERS, down("cam.return_roller.radius"), down("cam.roller.radius")),
    "lift-off": either("cam.return_roller.angle", step=1.0),
    "finger-release": (down("fingers.open.from", step=0.5), down("fingers.open.over", step=0.5)),
    "stop-settling": (down("stop.restitution", step=0.05), down("stop.clearance", step=0.01)),
}
_QUIET = {"accelerate": "velocity-345", "decelerate": "velocity-345", "return": "modified-sine"}
_QUIETER = {"accelerate": "velocity-4567", "decelerate": "velocity-4567", "return": "polynomial-4567"}


def ways_of(design: SwingGripper, check: str) -> tuple[Way, ...]:
    """Ways in which a check that fails may be repaired; for cams that cannot be, those of their refusal."""
    if check == "pressure-angle" and design.cams.refusal is not None:
        return tuple(refusal_ways(design.spec, design.cams.refusal.key))
    if check in ("pressure-angle", "phase-allotment"):
        given = design.spec.phases
        longer = _longer("return", "near_dwell", given)
        if check == "phase-allotment":
            return (*longer, down("phases.balance")) if given.balance is not None else longer
        return (*longer, *_longer("decelerate", "far_dwell", given), *_WAYS[check])
    return _WAYS.get(check, ())


def candidates(design: SwingGripper, check: str) -> Iterator[Remedy]:
    """Remedies of a check from closed forms, the first to be tried first."""
    return _CLOSED[check](design) if check in _CLOSED else iter(())


def _handover(design: SwingGripper) -> Iterator[Remedy]:
    """The middle of the constant phase; the arm or the cylinder's axis where the tip meets the line of centres.

    First the sense of a cam on the cylinder's own shaft, which must turn that against the gripper's swing.
    """
    from gearlink.core.machines.swing_gripper.handover_geometry import misplacement, widest_window

    spec, (start, end) = design.spec, design.motion.law.starts[1:3]
    if spec.cam is not None and runs_backwards(design):
        yield (("cam.sense", -spec.swing_sense),)
        yield (("swing_sense", -spec.cam.sense),)
    if spec.cylinder.center is not None:
        center = complex(*spec.cylinder.center)
        off = misplacement(complex(*spec.pivots.output), design.handover.tip, center, spec.cylinder.radius)
        fits = design.handover.center
        yield (("arm.direction", round(spec.arm.direction + math.degrees(off.turn), _FINE)),)
        yield _point("cylinder.center", fits, _FINE)
    if spec.handover is not None:
        yield (("handover", 0.5 * (start + end)),)
    if spec.release is not None:
        widest = math.degrees(widest_window(spec.arm.length, spec.cylinder.radius, spec.release.gap))
        room = min(design.motion.handover - start, end - design.motion.handover)
        yield (("release.window", at_most(min(widest, room) if room > 0.0 else widest)),)


def _turn(design: SwingGripper) -> Iterator[Remedy]:
    """ED turned as far as the whole swing needs, in half degrees."""
    from gearlink.core.machines.swing_gripper.linkage import clear_turn

    spec = design.spec
    for more in (0.0, 2.0, 5.0):
        turn, _ = clear_turn(design.motion.linkage, math.radians(spec.limits.transmission_angle + more))
        if turn is not None:
            wanted = spec.output_direction + math.degrees(turn)
            yield (("output_direction", (at_least if turn > 0.0 else at_most)(wanted, 0.5)),)


def _point(path: str, place: complex, digits: int) -> Remedy:
    return (f"{path}[0]", round(place.real, digits)), (f"{path}[1]", round(place.imag, digits))


def _pressure(design: SwingGripper) -> Iterator[Remedy]:
    """The centre of the smallest cams that keep the limits, or the angle that the centre is chosen for."""
    limits, cam = design.spec.limits, design.cams.section
    for limit in (limits.pressure_angle, min(limits.pressure_angle, limits.accelerate_pressure_angle)):
        if cam.center is None:
            yield (("size.pressure_angle", at_most(0.99 * limit, 0.5)),)
            continue
        try:
            yield _point("cam.center", design.cams.center_for(0.99 * limit, refined=False), 1)
        except NoSolution:
            continue
    yield from _longer_acceleration(design)


def _longer_acceleration(design: SwingGripper) -> Iterator[Remedy]:
    """More of the dwell before it, with the handover as far behind; what the file leaves out follows by itself."""
    spec, phases = design.spec, design.motion.phases
    if spec.phases.accelerate is None:
        return
    for more in (5.0, 10.0, 20.0, 30.0):
        if more < phases.near_dwell:
            near = () if spec.phases.near_dwell is None else (("phases.near_dwell", phases.near_dwell - more),)
            behind = () if spec.handover is None else (("handover", spec.handover + more),)
            yield (("phases.accelerate", phases.accelerate + more), *near, *behind)


def _longer(phase: str, dwell: str, given: Phases) -> tuple[Way, ...]:
    """The way to more of a phase, taken from a dwell, which follows by itself where the file leaves it out."""
    if given.given(phase) is None:
        return ()
    key = f"phases.{phase}"
    return (up(key, step=1.0) if given.given(dwell) is None else shared(key, f"phases.{dwell}", step=1.0)[0],)


def _balanced(design: SwingGripper) -> Iterator[Remedy]:
    """The three moving phases with equal accelerations round the constant speed, and the return within its limit."""
    from gearlink.core.machines.swing_gripper.law import balanced

    spec, phases, law = design.spec, design.motion.phases, design.motion.law
    limit = spec.limits.return_acceleration
    if limit is None or spec.phases.balance is not None:
        return
    rest = (phases.constant, phases.far_dwell, phases.near_dwell)
    for share in (0.98, 0.9):
        found = balanced(rest, share * limit, (law.accelerate, law.decelerate, law.return_))
        first, second = at_most(found.accelerate, 0.5), at_most(found.decelerate, 0.5)
        sized = {"accelerate": first, "decelerate": second, "return": 360.0 - sum(rest) - first - second}
        behind = () if spec.handover is None else (("handover", first + 0.5 * phases.constant),)
        keys = ((f"phases.{key}", value) for key, value in sized.items() if spec.phases.given(key) is not None)
        yield (*keys, *behind)


def _rollers(design: SwingGripper) -> Iterator[Remedy]:
    """Rollers well below the minimum curvature radius of their cams."""
    most = [at_most(ROLLER_SHARE * cam.min_curvature_radius.value) for cam in design.cams.discs]
    for key, radius in zip(("cam.roller.radius", "cam.return_roller.radius"), most, strict=False):
        yield ((key, radius),)


def _shaft(design: SwingGripper) -> Iterator[Remedy]:
    """Rollers that leave a hub round the shaft, where no more than half is to be taken off them; or a thinner shaft."""
    section, least = design.cams.section, min(design.cams.min_radius)
    rollers = {"cam.roller.radius": section.roller, "cam.return_roller.radius": section.return_roller}
    smaller: list[tuple[str, float]] = []
    for (key, roller), radius in zip(rollers.items(), design.cams.min_radius, strict=False):
        missing = HUB * section.shaft_radius - radius
        if roller is not None and missing > 0.0:
            smaller.append((key, at_most(roller.radius - missing)))
            if smaller[-1][1] < 0.5 * roller.radius:
                smaller.clear()
                break
    if smaller:
        yield tuple(smaller)
    if least > 0.0:
        yield (("cam.shaft_radius", at_most(least / HUB)),)


def _laws(design: SwingGripper, quiet: dict[str, str]) -> Iterator[Remedy]:
    """Laws without the step, one after the other and all of them."""
    given = design.spec.laws
    better = [
        (f"laws.{key}", law) for key, law in quiet.items() if getattr(given, key.replace("return", "return_")) != law
    ]
    yield from ((change,) for change in better)
    if len(better) > 1:
        yield tuple(better)


def _closing(design: SwingGripper) -> Iterator[Remedy]:
    """The spring that leaves a tenth of speed in reserve: what the inertia takes grows with the square of the speed."""
    spring, closure = design.spec.spring, design.closure
    if spring is None or not closure.stands:
        return
    worst = max(extreme.value for extreme in closure.worst_unloading)
    if spring.torque is not None:
        yield (("spring.torque", at_least(_RESERVE**2 * worst + spring.reserve, 1.0)),)
        return
    yield (("spring.preload", at_least(closure.preload_for(_RESERVE**2 * worst + spring.reserve), 1.0)),)


_CLOSED: dict[str, Callable[[SwingGripper], Iterator[Remedy]]] = {
    REFUSAL: lambda design: _laws(design, _QUIET),
    "transmission-angle": _turn,
    "handover": _handover,
    "pressure-angle": _pressure,
    "cam-undercut": _rollers,
    "shaft-clearance": _shaft,
    "acceleration-step": lambda design: _laws(design, _QUIET),
    "velocity-step": lambda design: _laws(design, _QUIET),
    "jerk-step": lambda design: _laws(design, _QUIETER),
    "lift-off": _closing,
    "phase-allotment": _balanced,
}


_THINNEST = "minimum shaft radius, limits.least_shaft"
_OVER = 1e-6
"""A link no farther from an axis [mm] sweeps over it, where no shaft is thin enough."""


class Room(NamedTuple):
    """The radius of the thinnest shaft that would be built beside a body [mm], and what it is."""

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
            advice = axis.remedy
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
        advice = axis.remedy
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
            advice = f"lengthen cam.{key}.arm"
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
            at = f"cylinder angle {short(passes.cylinder_angle(found))} deg"
            advice = f"end that shaft before the plane of the {found.body} (overhung)"
            if found.radius:
                room, axis = found.distance - found.radius, found.axis.name
                yield from over_axis_check(SHAFT_CLEARANCE, found.body, room, needed, axis, advice, takes=takes, at=at)
            else:
                yield _line_check(found, at, Room(needed, takes), advice)


def _line_check(found: Pass, at: str, needed: Room, fix: str) -> Check:
    """GL302 of a link that passes through the place of a shaft."""
    aside = "shaft radius" if found.axis.radius else needed.takes
    what, shown = f"{found.body} to {'the middle of ' if found.axis.radius else ''}{found.axis.name}", None
    if found.distance < _OVER:
        what, shown, aside = f"the {found.body} sweeps over {found.axis.name}", NO_NUMBER, ""
    return SHAFT_CLEARANCE.check(
        "warn", what, found.distance, needed.radius, "mm", shown=shown, aside=aside, at=at, fix=fix
    )


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
        fix = "reduce spring.angle" if min(p, q) >= needed else "lengthen spring.arms"
        what = "line of the spring to the cam rocker's axis"
        yield SHAFT_CLEARANCE.check("warn", what, distance, needed, "mm", aside=takes, fix=fix)


def room_beside_arm(design: SwingGripper, place: complex) -> float:
    """Minimum distance of a point from the line E-F over the swing; of one that it passes over, the tip's lead on it.

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
