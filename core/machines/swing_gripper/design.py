"""The swing gripper as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass
from functools import cache
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import GearlinkError, MissingSection, NoSolution, at_key
from gearlink.core.base.remedies.ways import REFUSAL, Way, at_least, at_most, down, either, refusal_ways, shared, up
from gearlink.core.base.report import NO_NUMBER, Check, Remedy, Rule, Shown, Status, Table, safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short, unlike, within
from gearlink.core.machines.swing_gripper.codes import (
    CONDITIONING,
    FARTHER,
    FINGER_RELEASE,
    HANDOVER,
    PHASE_ALLOTMENT,
    STOP_SETTLING,
)
from gearlink.core.machines.swing_gripper.fingers import FingerCam
from gearlink.core.machines.swing_gripper.law import PHASES, SixPhaseLaw, balanced
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage, clear_turn, closed_form_error, turn_remedy
from gearlink.core.machines.swing_gripper.motion import Motion, require
from gearlink.core.numerics.arrays import Reals, product, turn_degrees
from gearlink.core.numerics.extremes import Extreme
from gearlink.core.numerics.motion_extremes import WithExtremes, names
from gearlink.core.numerics.roots_sweep import root_between
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
from gearlink.core.parts.cams.codes import ACCELERATION_STEP, JERK_STEP, LARGER, LIFT_OFF, PRESSURE_ANGLE, VELOCITY_STEP
from gearlink.core.parts.cams.disc_cam import DiscCam, largest_pressure_angles
from gearlink.core.parts.cams.disc_cams import DiscCams, OnDiscCams
from gearlink.core.parts.cams.laws import Law
from gearlink.core.parts.cams.profile import RollerPath, oscillating
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE, WithShapedLaws
from gearlink.core.parts.linkages.checks import transmission_check
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE
from gearlink.core.studies.clearance import beside_line, beside_turning_arm, beside_turning_pin

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.forces import LeverSpring, RockerInertia, Stop
    from gearlink.core.machines.swing_gripper.spec import (
        ClosingSpring,
        GripperCam,
        Phases,
        Release,
        Roller,
        SwingGripperSpec,
    )
    from gearlink.core.parts.cams.shaped import Phase
    from gearlink.core.parts.cams.size import RockingRoller


# What its checks of law, linkage, shafts, handover, cams and force closure are made of
#
# GL302 says how near links and rollers come to the axes of the frame that they do not turn about. All positions of the
# linkage are those of the swing from 0 to its total, run through forth and back in a turn. The cam rocker turns one way
# meanwhile, since it may not come to a dead centre.


ONE_SHAFT = 0.1
"""Axes that stand no farther apart [mm] are those of one shaft: two shafts never do."""


class Axis(NamedTuple):
    """An axis of the frame.

    Parameters
        letter : str - A, E, O of the cam, T of the cylinder that takes the sheet
        name : str - "the cam shaft"
        place : complex [mm]
        radius : float [mm] - of its shaft, 0 where the file does not name it
    """

    letter: str
    name: str
    place: complex
    radius: float


class Pass(NamedTuple):
    """A link or a roller at its nearest to an axis.

    Parameters
        body : str - "coupler CD"
        radius : float [mm] - of a roller, 0 of a link
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
        Axis("O", named, design.cams.center, shaft),
        Axis("A", "the cam rocker's axis", complex(*spec.pivots.input), 0.0),
        Axis("E", "the gripper's axis", complex(*spec.pivots.output), 0.0),
    )
    if cam_turns_drum(design):
        return axes
    return (*axes, Axis("T", "the axis of the cylinder that takes the sheet", drum_axis(design), 0.0))


class Passes:
    """What passes the axes of a gripper with cams."""

    def __init__(self, design: SwingGripper) -> None:
        self.axes, self.section, self.linkage = design.axes, design.cams.section, design.motion.linkage
        self.beside_coupler = design.beside_coupler

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
        for axis, least in zip(self.axes, self.beside_coupler, strict=True):
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
        return root_between(lambda swing: np.abs(_input_angle(self.linkage, swing) - self._ends[0]) - turned, low, high)


def _input_angle(linkage: GripperLinkage, swing: Reals) -> Reals:
    return linkage.at((swing,)).input.value


# Share of the surface speed that the two may differ by: rounding only.
_SPEED_SHARE = 1e-9
# Share of the near dwell in which the arm should rest on its stop.
_SETTLED_SHARE = 0.25
# A tip farther off [mm] misses the sheet's edge by more than a gripper's pad holds, whatever the file allows.
_MOST_OFF_PLACE = 1.0
# Closed form and Newton-Raphson each lose 8 eps times the condition number.
_AGREEMENT = 64.0 * 2.0**-52


def _away_from_dead_centre(design: SwingGripper) -> str:
    aim = math.radians(design.spec.limits.transmission_angle)
    return turn_remedy(design.motion.linkage, aim, tells=False)


def _loss_near_dead_centre(design: SwingGripper) -> str:
    """What clearance of 0.01 mm turns the links by."""
    linkage, (at_d, at_c) = design.motion.linkage, design.motion.min_transmission_angle
    loose, length = ("cam rocker", linkage.input) if at_c < at_d else ("gripper", linkage.output)
    turned = math.degrees(0.01 * design.motion.condition_number / length)
    return f"0.01 mm of clearance turns the {loose} by {short(turned, 2)} deg"


def _steps(design: SwingGripper, rule: Rule, order: int, bad: Status) -> Check:
    peak = design.motion.law.peaks[order - 1]
    unit = "rad/rad" if order == 1 else "rad/rad^2"
    return step_check(
        rule, _jumps(design, order), peak, unit, bad, "in `laws` use laws with zero acceleration at the ends"
    )


def _jumps(design: SwingGripper, order: int) -> list[tuple[str, float]]:
    jumps = design.motion.law.joints[:, order]
    return [(f"start of {phase}", float(jump)) for phase, jump in zip(PHASES, jumps, strict=True)]


def runs_backwards(design: SwingGripper) -> bool:
    """Whether the cam stands on the shaft of the cylinder that takes the sheet and turns it as the gripper swings."""
    cam = design.spec.cam
    if cam is None or cam.center is None or cam.sense != design.spec.swing_sense:
        return False

    return cam_turns_drum(design)


def _speed_check(design: SwingGripper) -> Check:
    """GL503; a cylinder that turns with the gripper runs against it on the line of centres."""
    backwards, speed = runs_backwards(design), design.spec.cylinder.radius * design.motion.shaft_speed
    apart = abs(design.handover.speed + speed) if backwards else abs(design.handover.mismatch)
    status: Status = "fail" if backwards or apart / speed > _SPEED_SHARE else "pass"
    start, end = design.motion.law.starts[1:3]
    aside = f"cylinder {short(speed)} mm/s"
    fix = f"set handover to {0.5 * (start + end):g}, the middle of the constant phase"
    if backwards:
        aside = "the cam turns the cylinder on its shaft in the sense of the gripper's swing"
        fix = "reverse cam.sense"
    what = "speed difference of gripper and cylinder at the handover"
    shown = Shown(apart, _SPEED_SHARE * speed, "mm/s", "<=")
    return HANDOVER.check(status, what, apart / speed, _SPEED_SHARE, shown=shown, aside=aside, fix=fix)


def _place_check(design: SwingGripper, center: complex) -> Check:
    limit = design.spec.limits.handover_place
    off = misplacement(complex(*design.spec.pivots.output), design.handover.tip, center, design.spec.cylinder.radius)
    status: Status = "fail" if off.place > limit else "warn" if off.place > _MOST_OFF_PLACE else "pass"
    fits, fix = design.handover.center, f"turn arm.direction by {math.degrees(off.turn):+.4g} deg"
    if abs(off.distance) > min(limit, _MOST_OFF_PLACE):
        fix = f"set cylinder.center to [{short(fits.real)}, {short(fits.imag)}]"
    note = "a reliable handover needs a smaller distance" if status == "warn" else ""
    what, most = "distance of the gripper tip from the handover point", _MOST_OFF_PLACE if status == "warn" else limit
    return HANDOVER.check(status, what, off.place, most, "mm", fix=fix, note=note)


def _inside_check(design: SwingGripper, release: Release) -> Check:
    start, end = design.motion.law.starts[1:3]
    room = min(design.motion.handover - start, end - design.motion.handover)
    status: Status = "warn" if release.window > room else "pass"
    what = "release window on either side of the handover"
    aside = f"{short(release.window / 360.0 * 3.6e6 / design.spec.speed)} ms, at equal speed"
    first, last = start + release.window, end - release.window
    if first < last:
        fix = f"set handover from {within(first, last, 'deg')}"
    else:
        fix = f"set phases.constant to at least {safely_above(2.0 * release.window)} deg, the handover in its middle"
    return HANDOVER.check(status, what, release.window, room, "deg", aside=aside, fix=fix)


def _gap_check(design: SwingGripper, release: Release) -> Check:
    degrees = design.motion.handover + release.window * np.array([-1.0, 0.0, 1.0])
    _, _, path = design.handover.path(degrees)
    gap, slip = float(np.abs(path.gap).max()), float(np.abs(path.slip).max())
    status: Status = "warn" if gap > release.gap else "pass"
    fix = ""
    if status == "warn":
        widest = widest_window(design.spec.arm.length, design.spec.cylinder.radius, release.gap)
        fix = f"set release.window to at most {safely_below(math.degrees(widest))} deg"
    what, aside = "gap of the gripper tip from the pitch circle in the release window", f"slip {short(slip)} mm"
    return HANDOVER.check(status, what, gap, release.gap, "mm", aside=aside, fix=fix)


def _accelerating(design: SwingGripper, limit: float) -> Iterator[Check]:
    for cam, worst in zip(design.cams.discs, design.cams.steepest_accelerating, strict=True):
        value = math.degrees(abs(worst.value))
        status: Status = "warn" if is_steep(value, limit) else "pass"
        what = f"pressure angle of the {cam.name} while it accelerates the gripper"
        at = f"cam angle {short(math.degrees(worst.place))} deg"
        fix = design.cams.center_remedy(limit) if status == "warn" and design.advises else ""
        yield PRESSURE_ANGLE.check(status, what, value, limit, "deg", at=at, fix=fix)


_RESERVE = 1.1
"""Speed at which a roller may lift off, over the speed of the machine."""
_FINE = 3
"""Digits behind the point of what places the handover."""
_LINKAGE = (*either("output_direction", step=0.5), *either("links.coupler", "links.output", "links.input"))
_ROLLERS = either("cam.roller.angle", "cam.return_roller.angle", step=1.0)
_AXES = either(
    "cam.center[0]", "cam.center[1]", "cam.roller.arm", "cam.return_roller.arm", "arm.direction", "pivots.input[0]",
    "pivots.input[1]",
)  # fmt: skip
_WAYS = {
    "transmission-angle": _LINKAGE,
    "conditioning": _LINKAGE,
    "handover": (down("release.window"),),
    "pressure-angle": (*_ROLLERS, *_LINKAGE),
    "shaft-clearance": (*_ROLLERS, down("cam.return_roller.radius"), down("cam.roller.radius"), *_AXES),
    "lift-off": either("cam.return_roller.angle", step=1.0),
    "finger-release": (down("fingers.open.from", step=0.5), down("fingers.open.over", step=0.5)),
    "stop-settling": (down("stop.restitution", step=0.05), down("stop.clearance", step=0.01)),
}
_QUIET = {"accelerate": "velocity-345", "decelerate": "velocity-345", "return": "modified-sine"}
_QUIETER = {"accelerate": "velocity-4567", "decelerate": "velocity-4567", "return": "polynomial-4567"}


def _handover(design: SwingGripper) -> Iterator[Remedy]:
    """The middle of the constant phase; the arm or the cylinder's axis where the tip meets the line of centres.

    First the sense of a cam on the cylinder's own shaft, which must turn that against the gripper's swing.
    """
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
    section, least = design.cams.section, min(design.min_radius)
    rollers = {"cam.roller.radius": section.roller, "cam.return_roller.radius": section.return_roller}
    smaller: list[tuple[str, float]] = []
    for (key, roller), radius in zip(rollers.items(), design.min_radius, strict=False):
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
        for axis in design.axes[1:]:
            room = abs(axis.place - design.cams.center) - cam.max_radius
            advice = f"end that shaft before the plane of the {cam.name} (overhung)"
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
    for axis in design.axes[:2]:
        within, thick = axis.radius, 0.0 if axis.radius > 0.0 else needed
        advice = "end that shaft before the {} (overhung)"
        if not (axis.letter == "O" and cam_turns_drum(design)):
            room = abs(drum - axis.place) - radius - within
            words = "cylinder that takes the sheet"
            said = advice.format("cylinder")
            yield from over_axis_check(SHAFT_CLEARANCE, words, room, thick, axis.name, said, takes=takes)
        room, said = room_beside_arm(design, axis.place) - within, advice.format("gripper arm")
        yield from over_axis_check(SHAFT_CLEARANCE, "gripper arm", room, thick, axis.name, said, takes=takes)


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
        place : complex [mm] - in the machine's frame
    Returns
        room : float [mm] - negative where the line passes over the point, by as much as the tip reaches beyond it
    """
    arm, linkage = design.spec.arm, design.motion.linkage
    seen, at_bite = place - linkage.output_pivot, cmath.rect(arm.length, math.radians(arm.direction))
    near = beside_turning_arm(seen, at_bite, linkage.swing_sense * linkage.law.total_swing)
    return near.distance or abs(seen) - arm.length


_WINDOW = 6.0
_ROWS = 41


@dataclass(frozen=True)
class RollerCourse:
    """The course of a roller on the cam rocker, over the angle of its cam.

    Parameters
        pivot : complex [mm] - of the cam rocker, seen from the cam axis
        arm : float [mm]
        ahead : float [rad] - of the arm on AC
    """

    linkage: GripperLinkage
    pivot: complex
    arm: float
    ahead: float

    def __call__(self, theta: Reals, order: int) -> RollerPath:
        """The path of a disc cam at cam angles [rad]."""
        motion = self.linkage.kept_motion(theta, order)
        second = motion.input.second if order > 1 else 0.0
        return oscillating(self.pivot, self.arm, motion.input.value + self.ahead, motion.input.first, second)


class GripperCams(DiscCams):
    """The cams that drive the gripper and bring it back; those that advise say where else they could be."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion, *, advise: bool) -> None:
        self.spec, self.motion, self.advise = spec, motion, advise

    @cached_property
    def section(self) -> GripperCam:
        """The section `cam` of the design file."""
        cam: GripperCam = require(self.spec, "cam", "center, sense, roller")
        return cam

    @cached_property
    def center(self) -> complex:
        """The cam axis in the machine's frame [mm], given or chosen by `size`."""
        if self.section.center is not None:
            return complex(*self.section.center)
        if self.spec.size is None:
            raise MissingSection(
                "give cam.center, or size: {pressure_angle: 25} at the level of cam to have it chosen", key="size"
            )
        return self.center_for(self.spec.size.pressure_angle)

    def center_for(self, degrees: float, *, refined: bool = True) -> complex:
        """Cam centre of the smallest cams that keep a pressure angle [deg]."""
        from gearlink.core.parts.cams.size import smallest_cam_of_rollers

        with at_key("size.pressure_angle"):
            return smallest_cam_of_rollers(
                self._rollers,
                math.radians(degrees),
                sense=self.section.sense,
                joints=tuple(math.radians(start) for start in self.motion.law.starts[1:-1]),
                refined=refined,
            )

    @property
    def _rollers(self) -> list[RockingRoller]:
        """The rollers on their arms, with the side on which the cam lies."""
        cam, back = self.section, self.section.return_roller
        side = self.spec.size.side if self.spec.size is not None else None
        if side is None and cam.center is not None:
            side = 1 if (self.from_pivot / self.main_arm).imag > 0.0 else -1
        if side is None and back is not None:
            side = 1 if math.remainder(back.angle, 360.0) > 0.0 else -1
        if side is None:
            raise NoSolution(
                "one roller alone does not determine the side of the cam", key="size", fix="give size.side, 1 or -1"
            )
        rollers = [self._rocking(cam.roller, cam.roller.angle, side)]
        if back is not None:
            rollers.append(self._rocking(back, cam.roller.angle + back.angle, -side))
        return rollers

    def _rocking(self, roller: Roller, from_input: float, side: int) -> RockingRoller:
        from gearlink.core.parts.cams.size import RockingRoller

        linkage, ahead = self.motion.linkage, math.radians(from_input)

        def law(cam_angle: Reals) -> tuple[Reals, Reals]:
            motion = linkage.motion(np.degrees(cam_angle), 1)
            return motion.input.value + ahead, motion.input.first

        return RockingRoller(law, linkage.input_pivot, roller.arm, side)

    @property
    def from_pivot(self) -> complex:
        """Cam axis from the pivot of the cam rocker [mm]."""
        return self.center - self.motion.linkage.input_pivot

    @property
    def main_arm(self) -> complex:
        """Direction of the main roller's arm at the pick-up position."""
        angle = float(self.motion.linkage.motion(np.array([0.0]), 0).input.value[0])
        return cmath.rect(1.0, angle + math.radians(self.section.roller.angle))

    @cached_property
    def main_cam(self) -> DiscCam:
        """The cam of the main roller."""
        return self._disc_cam("main cam", self.section.roller, self.section.roller.angle)

    @cached_property
    def return_cam(self) -> DiscCam | None:
        """The cam of the return roller, at a fixed angle from the main roller's arm; None without one."""
        roller = self.section.return_roller
        return (
            None if roller is None else self._disc_cam("return cam", roller, self.section.roller.angle + roller.angle)
        )

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        return (self.main_cam,) if self.return_cam is None else (self.main_cam, self.return_cam)

    def _disc_cam(self, name: str, roller: Roller, from_input: float) -> DiscCam:
        path = RollerCourse(self.motion.linkage, -self.from_pivot, roller.arm, math.radians(from_input))
        joints = tuple(math.radians(start) for start in self.motion.law.starts[:-1])
        return DiscCam(name, path, self.section.sense, roller.radius, joints)

    @cached_property
    def steepest_accelerating(self) -> tuple[Extreme, ...]:
        """Pressure angle of largest magnitude of each cam in the phase accelerate [rad]."""
        return tuple(largest_pressure_angles(self.discs, 0.0, math.radians(self.motion.law.starts[1])))

    @cached_property
    def center_remedy(self) -> Callable[[float], str]:
        """In words, whether cams can stand anywhere that keep a pressure angle [deg] over the revolution.

        Sought once for each limit, however many checks tell of it.
        """
        return cache(self._center_remedy)

    def _center_remedy(self, limit: float) -> str:
        longer = "lengthen the phase in which it occurs"
        try:
            self.center_for(0.99 * limit, refined=False)
        except NoSolution:
            return f"{longer} (no cam centre meets the limit, best {short(self._least_limit, 3)} deg)"
        return f"move cam.center, or {longer}"

    @cached_property
    def _least_limit(self) -> float:
        """Minimum pressure angle [deg] that some cam centre keeps for every roller, to a tenth."""
        low, high = 0.0, 89.9
        while high - low > 0.1:
            middle = 0.5 * (low + high)
            try:
                self.center_for(middle, refined=False)
            except NoSolution:
                low = middle
            else:
                high = middle
        return high

    def require_motion(self) -> None:
        """Compute law and linkage."""
        _ = self.motion.linkage

    @property
    def stand(self) -> bool:
        """Whether the file has cams and they can be."""
        return self.spec.cam is not None and not self.is_refused

    def explained(self, refusal: NoSolution) -> NoSolution:
        """The refusal of a cam in the keys of this kind, with the centre at which there is one."""
        if refusal.key:
            return refusal
        message, fix = (text.replace(LARGER, FARTHER) for text in (refusal.message, refusal.fix))
        if self.advise:
            fix = self.center_remedy(self.spec.limits.pressure_angle)
        return NoSolution(message, key="cam.center", fix=fix)


# The force closure of a swing gripper's cam pair: spring, inertia torques, lift-off

_SPRING = "torque, or arms, angle and preload"


class Closure:
    """What keeps the rollers on their cams."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion, cams: GripperCams) -> None:
        self.spec, self.motion, self.cams = spec, motion, cams

    @cached_property
    def refusal(self) -> NoSolution | None:
        """Why nothing keeps both rollers on their cams at any speed; None where something may. The cams must stand."""
        try:
            _ = self.lift_sense
            if self.spec.spring is not None:
                _ = self.closing_torque
        except NoSolution as error:
            return error
        return None

    @property
    def stands(self) -> bool:
        """Whether the file gives masses and spring of cams that can be, and the spring presses both rollers."""
        given = None not in (self.spec.inertia, self.spec.spring)
        return given and self.cams.stand and self.refusal is None

    @cached_property
    def spring(self) -> ClosingSpring:
        """The section `spring` of the design file."""
        spring: ClosingSpring = require(self.spec, "spring", _SPRING)
        return spring

    @cached_property
    def closing_torque(self) -> float:
        """Torque of the spring on each rocker [N m]: as given, or that of its levers, the same at every cam angle."""
        spring = self.spring
        if spring.torque is not None:
            return spring.torque
        with at_key("spring.length" if spring.rate else "spring.preload"):
            return self._levers.torque

    @cached_property
    def _levers(self) -> LeverSpring:
        from gearlink.core.machines.swing_gripper.forces import LeverSpring

        spring = self.spring
        (p, q), angle = spring.arms or (0.0, 0.0), math.radians(spring.angle or 0.0)
        return LeverSpring(p, q, angle, spring.preload or 0.0, spring.rate or 0.0, spring.length or 0.0)

    def preload_for(self, torque: float) -> float:
        """Preload that gives the spring a torque [N]."""
        return (self.spring.preload or 0.0) + (torque - self.closing_torque) / self._levers.lever

    def spring_remedy(self, torque: float, *, tells: bool) -> str:
        """What gives the spring a torque [N m], rounded up; where it `tells`, by its value."""
        if self.spring.torque is not None:
            return f"increase spring.torque{f' to {safely_above(torque, 4)} N m' if tells else ''}"
        return f"increase spring.preload{f' to {safely_above(self.preload_for(torque), 4)} N' if tells else ''}"

    @cached_property
    def lift_sense(self) -> int:
        """Sign of the cam rocker's turn by which the main cam lifts its roller."""
        sense, *back = (1 if each > 0.0 else -1 for each in self.outward)
        if sense in back:
            arm = math.degrees(math.remainder(cmath.phase(self.cams.from_pivot / self.cams.main_arm), 2.0 * math.pi))
            bound = f"above {safely_above(arm)}" if arm > 0.0 else f"below {safely_below(arm)}"
            raise NoSolution(
                "both rollers lie on the same side of the cam: a spring that presses one lifts the other",
                key="cam.return_roller.angle",
                fix=f"set cam.return_roller.angle {bound} deg",
            )
        return sense

    @cached_property
    def outward(self) -> tuple[float, ...]:
        """At the pick-up position, how far each roller moves away from its cam as the cam rocker turns."""
        from gearlink.core.machines.swing_gripper.forces import outward_of

        return tuple(outward_of(cam) for cam in self.cams.discs)

    @cached_property
    def inertia(self) -> RockerInertia:
        """What the motion takes of torque."""
        from gearlink.core.machines.swing_gripper.forces import Masses, RockerInertia

        masses = Masses.of(require(self.spec, "inertia", "input, output, coupler, coupler_mass, return_rocker"))
        return RockerInertia(self.motion.linkage, masses, self.motion.shaft_speed)

    @cached_property
    def worst_unloading(self) -> tuple[Extreme, ...]:
        """Largest torque that lifts each roller [N m], and the cylinder angle [deg] of it."""
        sense = self.lift_sense
        return self.inertia.greatest([-sense, sense][: len(self.cams.discs)])

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam [sheets/h]; None where nothing ever lifts one."""
        from gearlink.core.machines.swing_gripper.forces import lift_off_speed

        worst = max(extreme.value for extreme in self.worst_unloading)
        speed = lift_off_speed(self.spec.speed, self.closing_torque, worst)
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Minimum spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(0.0, *(extreme.value for extreme in self.worst_unloading)) + reserve


_STOP = {
    "stop_force": "force",
    "stop_force_max": "force_max",
    "stop_angle": "angle",
    "stop_tip_offset": "tip_offset",
    "stop_impact_angle": "impact_angle",
    "stop_impact_speed": "impact_speed",
    "take_off_angle": "take_off_angle",
    "take_off_speed": "take_off_speed",
    "stop_mass": "mass",
    "settling_time": "settling_time",
    "settling_angle": "settling_angle",
}
"""Quantities of the stop, and what they are called there."""


class Handover:
    """Speed and place of the tip at the handover."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

    @cached_property
    def speed(self) -> float:
        """Speed of the gripper tip at the handover [mm/s]."""
        return self.spec.arm.length * self.state[1] * self.motion.shaft_speed

    @cached_property
    def mismatch(self) -> float:
        """Speed of the tip less that of the cylinder's surface [mm/s]."""
        return self.speed - self.spec.cylinder.radius * self.motion.shaft_speed

    @cached_property
    def state(self) -> tuple[float, float]:
        """Swing angle [rad] and its rate by the cylinder angle at the handover."""
        beta, rate = self.motion.law.evaluate(np.array([self.motion.handover]), 1)
        return float(beta[0]), float(rate[0])

    @cached_property
    def tip(self) -> complex:
        """The gripper tip at the handover [mm]."""
        arm = self.spec.arm
        direction = math.radians(arm.direction) + self.spec.swing_sense * self.state[0]
        return complex(*self.spec.pivots.output) + cmath.rect(arm.length, direction)

    @cached_property
    def center(self) -> complex:
        """Axis of a cylinder whose pitch circle the tip meets on the line of centres at the handover [mm]."""
        return drum_center(complex(*self.spec.pivots.output), self.tip, self.spec.cylinder.radius)

    def path(self, degrees: Any) -> tuple[Any, Any, TipPath]:
        """Lead of the arm on the line of centres [rad], tip speed [mm/s] and path of the tip at cylinder angles."""
        arm, radius = self.spec.arm.length, self.spec.cylinder.radius
        distance, lead_0 = arm + radius, 0.0
        if self.spec.cylinder.center is not None:
            pivot = complex(*self.spec.pivots.output)
            line = complex(*self.spec.cylinder.center) - pivot
            distance = abs(line)
            lead_0 = self.spec.swing_sense * cmath.phase((self.tip - pivot) / line)
        beta, rate = self.motion.law.evaluate(np.fmod(degrees + 360.0, 360.0), 1)
        lead = lead_0 + beta - self.state[0]
        turned = np.radians(degrees - self.motion.handover)
        return lead, arm * rate * self.motion.shaft_speed, tip_path(arm, radius, distance, lead, turned, lead_0)


_CAM_PLACES = ("max_pressure_angle_at", "min_curvature_radius_at")
_CAM = ("max_pressure_angle", "min_curvature_radius", *_CAM_PLACES, "max_radius", "min_radius")
_LAW = ("handover_speed", "handover_mismatch", "handover_center", "total_swing", "min_transmission_angle")
_PHASES = (
    "accelerate_angle",
    "constant_angle",
    "decelerate_angle",
    "far_dwell_angle",
    "return_angle",
    "near_dwell_angle",
    "handover_angle",
)
_LOOP = ("newton_agreement", "newton_iterations", "condition_number")
_CLOSURE = ("closing_torque", "lift_off_speed")
_LAW_CHECKS = (
    "transmission-angle",
    "conditioning",
    "handover",
    "velocity-step",
    "acceleration-step",
    "jerk-step",
    *LAW_CHECKS,
)
_CAM_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance")


_EXTREMES = (
    "min_transmission_angle_at",
    *names("input_velocity", "input_acceleration", "output_velocity", "output_acceleration"),
)


_OF_CAMS = {"max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius", *_CAM_CHECKS}
_OF_LAW = {"handover_speed", "handover_mismatch", "handover_center", "total_swing", *_PHASES}


_KEYS_OF_MOTION = (
    "handover_speed",
    "handover_mismatch",
    ("total_swing", "total_swing"),
    ("min_transmission_angle", ">limits.transmission_angle"),
)
_KEYS_OF_CAMS = (
    ("max_pressure_angle", "<limits.pressure_angle"),
    "min_curvature_radius",
    ("lift_off_speed", ">speed"),
    "closing_torque",
)
_OF_FINGERS = ("finger-release", "pressure-angle", "cam-undercut")
_OF_FINGER_CAM = ("fingers", "release", "swing_sense")


class SwingGripper(WithExtremes, WithShapedLaws, OnDiscCams):
    """A swing gripper, from its design file to every quantity that is asked for."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    keys = {
        "gripper": (*_KEYS_OF_MOTION, "cam_center", *_KEYS_OF_CAMS, "handover_center"),
        "analyze": (
            *_KEYS_OF_MOTION, "output_velocity_max", "output_acceleration_max", *_KEYS_OF_CAMS, "max_radius",
        ),
        "cam": ("cam_center", *_KEYS_OF_CAMS[:2], "max_radius", "min_radius"),
    }  # fmt: skip
    outlines = {
        "gripper": Outline((*_LAW, *_PHASES, *_LOOP), _LAW_CHECKS, ("motion",)),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*_LAW, *_PHASES, *_LOOP, *_EXTREMES), _LAW_CHECKS, ("motion",)),
    }
    extra_tables = ("finger_cam", "forces", "newton", "handover_window", "tip", LAW_TABLE)

    extreme_names = _EXTREMES
    motion_extremes: dict[str, Any] = placed("motion.extremes")
    cost = 7.0
    repaired_where_they_warn = frozenset(("shaft-clearance",))

    def candidates(self, check: str) -> Iterator[Remedy]:
        """Remedies of a check from closed forms, the first to be tried first."""
        return _CLOSED[check](self) if check in _CLOSED else iter(())

    def ways_of(self, check: str) -> tuple[Way, ...]:
        """Ways in which a check that fails may be repaired; for cams that cannot be, those of their refusal."""
        if check == "pressure-angle" and self.cams.refusal is not None:
            return tuple(refusal_ways(self.spec, self.cams.refusal.key))
        if check in ("pressure-angle", "phase-allotment"):
            given = self.spec.phases
            longer = _longer("return", "near_dwell", given)
            if check == "phase-allotment":
                return (*longer, down("phases.balance")) if given.balance is not None else longer
            return (*longer, *_longer("decelerate", "far_dwell", given), *_WAYS[check])
        return _WAYS.get(check, ())

    # Parts

    @cached_property
    def motion(self) -> Motion:
        """Law and linkage."""
        return Motion(self.spec)

    @cached_property
    def handover(self) -> Handover:
        """Where the tip meets the cylinder."""
        return Handover(self.spec, self.motion)

    @cached_property
    def cams(self) -> GripperCams:
        """Main and return cam."""
        return GripperCams(self.spec, self.motion, advise=self.advises)

    @cached_property
    def closure(self) -> Closure:
        """What keeps the rollers on their cams."""
        return Closure(self.spec, self.motion, self.cams)

    @cached_property
    def fingers(self) -> FingerCam:
        """What opens the fingers."""
        return FingerCam(self.spec, self.motion.timing)

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        """The cams that the file gives, that of the fingers the last."""
        cams = () if self.spec.cam is None else tuple(self.cams.discs)
        return cams if self.spec.fingers is None else (*cams, self.fingers.cam)

    @property
    def finger_lift(self) -> float | None:
        """Way of the finger tips at the end of the release window [mm]; None without fingers."""
        return None if self.spec.fingers is None else self.fingers.lift

    @cached_property
    def axes(self) -> tuple[Axis, ...]:
        """The axes of the frame."""
        return axes_of(self)

    @cached_property
    def beside_coupler(self) -> tuple[Extreme, ...]:
        """Minimum distance of each of the axes of the frame from the coupler [mm], and the swing [rad] there."""
        return self.motion.linkage.beside_coupler([axis.place for axis in self.axes])

    @cached_property
    def stop(self) -> Stop:
        """Where the arm rests in the near dwell."""
        from gearlink.core.machines.swing_gripper.forces import Stop

        return Stop(self.spec, self.motion, self.cams, self.closure)

    law: SixPhaseLaw = placed("motion.law")
    linkage: GripperLinkage = placed("motion.linkage")
    shaft_speed: float = placed("motion.shaft_speed")
    angular_speed: float = placed("motion.shaft_speed")
    turn_time: float = placed("motion.turn_time")
    main_cam: DiscCam = placed("cams.main_cam")
    return_cam: DiscCam | None = placed("cams.return_cam")

    def completion(self) -> Iterator[Found]:
        """The cam's axis instead of the rule that chose it; one that no rule finds stays asked for."""
        if self.spec.size is not None and self.spec.cam is not None and self.spec.cam.center is None:
            with suppress(NoSolution):
                center = self.cam_center
                yield Found("cam.center", [center.real, center.imag], "found for size")
                yield Found("size", None)
        yield from self.solved_laws()

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The laws of the three moving phases."""
        laws = self.spec.laws
        return {"laws.accelerate": laws.accelerate, "laws.decelerate": laws.decelerate, "laws.return": laws.return_}

    def law_at(self, path: str, /) -> Law:
        """The law of a phase."""
        found: Law = getattr(self.motion.law, {"return": "return_"}.get(phase := path.removeprefix("laws."), phase))
        return found

    def law_phase(self, path: str, /) -> Phase:
        return self.motion.timing.phase(path.removeprefix("laws."))

    # Quantities

    total_swing: float = placed("motion.law.total_swing")
    accelerate_angle: float = placed("motion.phase_angles.accelerate")
    constant_angle: float = placed("motion.phase_angles.constant")
    decelerate_angle: float = placed("motion.phase_angles.decelerate")
    far_dwell_angle: float = placed("motion.phase_angles.far_dwell")
    return_angle: float = placed("motion.phase_angles.return_")
    near_dwell_angle: float = placed("motion.phase_angles.near_dwell")
    handover_angle: float = placed("motion.handover_angle")
    min_transmission_angle: tuple[float, float] = placed("motion.min_transmission_angle")
    newton_agreement: float = placed("motion.newton_agreement")
    newton_iterations: int = placed("motion.newton_iterations")
    condition_number: float = placed("motion.condition_number")
    handover_speed: float = placed("handover.speed")
    handover_mismatch: float = placed("handover.mismatch")
    handover_center: complex = placed("handover.center")
    cam_center: complex = placed("cams.center")
    max_pressure_angle: list[float] = placed("cams.discs.*.max_pressure_angle.value")
    min_curvature_radius: list[float] = placed("cams.discs.*.min_curvature_radius.value")
    max_pressure_angle_at: list[float] = placed("cams.discs.*.max_pressure_angle.place")
    min_curvature_radius_at: list[float] = placed("cams.discs.*.min_curvature_radius.place")
    max_radius: list[float] = placed("cams.discs.*.max_radius")
    min_radius: list[float] = placed("cams.discs.*.min_radius")
    closing_torque: float = placed("closure.closing_torque")
    lift_off_speed: float | None = placed("closure.lift_off_speed")
    spring_torque: float = placed("closure.spring_torque")

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those that need an optional section included: asking for one says what is missing."""
        return (
            *_LAW,
            *_PHASES,
            *_LOOP,
            *_EXTREMES,
            "cam_center",
            *_CAM,
            *_CLOSURE,
            "spring_torque",
            *_STOP,
            "finger_lift",
        )

    at_once = 64
    alone = frozenset(("handover", "velocity-step", "acceleration-step", "jerk-step", "phase-allotment", *LAW_CHECKS))

    @classmethod
    def find_together(cls, designs: Sequence[SwingGripper], names: Sequence[str]) -> None:
        """Linkages, cams and torques are sought together."""
        from gearlink.core.machines.swing_gripper.together import find_together

        asked = frozenset(name.partition("[")[0] for name in names)
        if not asked <= _OF_LAW:
            find_together(designs, asked)

    def varied(self, spec: SwingGripperSpec) -> SwingGripper:
        """The design of another file, with the same law or motion where the file gives that."""
        made = type(self)(spec)
        made.motion = self.motion.varied(spec)
        same_law = made.motion.timing is self.motion.timing
        if same_law and all(getattr(spec, key) == getattr(self.spec, key) for key in _OF_FINGER_CAM):
            made.fingers = self.fingers
        return made

    def prepare(self, quantities: Iterable[str]) -> None:
        """Seek the extremes of the cams together, where several quantities or checks ask for them."""
        asked = {*quantities}
        if len(asked & _OF_CAMS) > 1:
            with suppress(GearlinkError):  # it is said where the quantity is asked for
                self.cams.seek()

    def raw(self, name: str) -> Any:
        """The value of a quantity; a point as its two coordinates; None of a stop that the file has not."""
        if name in _STOP:
            return None if self.spec.stop is None else getattr(self.stop, _STOP[name])
        value = super().raw(name)
        return (value.real, value.imag) if isinstance(value, complex) else value

    # Tables and checks

    def table_motion(self, samples: int | None = None) -> Table:
        """Angles, velocities and accelerations of both rockers over the revolution."""
        from gearlink.core.machines.swing_gripper.mechanism import swing, without_cams
        from gearlink.core.mechanism.courses import Shown, columns_of, turned

        degrees, links = turn_degrees(samples), {name: turned(name) for name in ("input", "coupler", "output")}
        shown = [Shown("beta", swing(self)), *(Shown(f"{name}_angle", course) for name, course in links.items())]
        rates = [("input", 1), ("output", 1), ("input", 2), ("output", 2), ("coupler", 1), ("coupler", 2), ("input", 3)]
        names = ("angle", "velocity", "acceleration", "jerk")
        shown += [Shown(f"{link}_{names[order]}", links[link], order) for link, order in rates]
        found = columns_of(without_cams(self), np.radians(degrees), shown, self.motion.shaft_speed)
        return Table.of("motion", {"theta": (degrees, "deg"), **found})

    def table_newton(self, samples: int | None = None) -> Table:
        """Both ways side by side: deviation of the angles, steps, opening of the loop, error of the closed form."""
        degrees, loop = self.motion.loop_at(samples)
        motion = self.linkage.motion(degrees)
        columns = {
            "theta": (degrees, "deg"),
            "deviation": (np.degrees(loop.deviation), "deg"),
            "iterations": (loop.iterations, "1"),
            "residual": (loop.residual, "mm"),
            "error": (np.degrees(closed_form_error(self.linkage, motion)), "deg"),
        }
        return Table.of("newton", columns)

    def table_forces(self, samples: int | None = None) -> Table:
        """Inertia and contact torques and normal forces over the revolution."""
        from gearlink.core.machines.swing_gripper.forces import contact_torques

        degrees, spring = turn_degrees(samples), self.closure.closing_torque
        main, back = self.closure.inertia.torques(degrees)
        torques = contact_torques(spring, main, back, self.closure.lift_sense)
        columns: dict[str, tuple[Any, str]] = {"theta": (degrees, "deg"), "inertia_torque": (main, "N m")}
        rollers = (self.cams.section.roller, self.cams.section.return_roller)
        contacts = list(zip(("main", "return"), torques, self.cams.discs, rollers, strict=False))
        for name, torque, _, _ in contacts:
            columns[f"contact_torque_{name}"] = (torque, "N m")
        for name, torque, cam, roller in contacts:
            lever = roller.arm * 1e-3 * np.cos(cam.pressure_angle(np.radians(degrees)))  # type: ignore[union-attr]
            columns[f"normal_force_{name}"] = (torque / lever, "N")
        return Table.of("forces", columns)

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The main cam, point for point."""
        return self.cams.main_cam.table("main_cam", samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The return cam, point for point."""
        if self.cams.return_cam is None:
            raise MissingSection("the table needs cam.return_roller: arm, angle, radius", key="cam.return_roller")
        return self.cams.return_cam.table("return_cam", samples)

    def table_finger_cam(self, samples: int | None = None) -> Table:
        """The cam of the fingers, point for point, over its turn seen from the arm."""
        if self.spec.fingers is None:
            raise MissingSection("the table needs the section fingers", key="fingers")
        return self.fingers.cam.table("finger_cam", samples)

    def table_handover_window(self, _samples: int | None = None) -> Table:
        """Gap of the tip to the pitch circle, slip and speed difference round the handover."""
        half = self.spec.release.window if self.spec.release is not None else _WINDOW
        degrees = self.motion.handover + half * np.linspace(-1.0, 1.0, _ROWS)
        lead, speed, path = self.handover.path(degrees)
        difference = speed_difference(path, lead, speed, self.motion.shaft_speed, self.spec.cylinder.radius)
        columns = {
            "theta": (degrees, "deg"),
            "arm_lead": (np.degrees(lead), "deg"),
            "gap": (path.gap, "mm"),
            "slip": (path.slip, "mm"),
            "speed_difference": (difference, "mm/s"),
        }
        return Table.of("handover_window", columns)

    def table_tip(self, samples: int | None = None) -> Table:
        """Path of the gripper's tip in the machine's frame, its speed and acceleration, and the jerk of the arm."""
        degrees, spec, speed = turn_degrees(samples), self.spec, self.motion.shaft_speed
        beta = self.motion.law.evaluate(degrees, 3)
        arm = np.exp(1j * spec.swing_sense * beta[0])
        arm = product(spec.arm.length * cmath.exp(1j * math.radians(spec.arm.direction)), arm)
        velocity, acceleration = beta[1] * speed, beta[2] * speed**2
        place = complex(*spec.pivots.output) + arm
        columns = {
            "theta": (degrees, "deg"),
            "time": (degrees / 360.0 * 3.6e6 / spec.speed, "ms"),
            "tip_x": (place.real, "mm"),
            "tip_y": (place.imag, "mm"),
            "tip_speed": (spec.arm.length * np.abs(velocity), "mm/s"),
            "tip_acceleration": (spec.arm.length * np.hypot(acceleration, velocity**2), "mm/s^2"),
            "output_jerk": (spec.swing_sense * beta[3] * speed**3 + 0.0, "rad/s^3"),
        }
        return Table.of("tip", columns)

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303 at D and at C."""
        limit = self.spec.limits.transmission_angle
        for place, angle in zip(
            ("D (coupler, output)", "C (input, coupler)"), self.motion.min_transmission_angle, strict=True
        ):
            aim = limit if math.degrees(angle) < limit else limit + 5.0
            near = self.advises and math.degrees(angle) < limit + 5.0
            remedy = turn_remedy(self.motion.linkage, math.radians(aim), tells=False) if near else ""
            subject = f"minimum transmission angle at {place}"
            yield transmission_check(angle, limit, remedy, subject)

    def check_conditioning(self) -> Check:
        """GL312: digits that the loop keeps near a dead centre, and the agreement of the two ways."""
        number, limit = self.motion.condition_number, self.spec.limits.condition_number
        agreement = self.motion.newton_agreement if self.advises else self.motion.rough_agreement
        status: Status = "warn" if number > limit else "pass"
        what, aside = "condition number of the loop", f"solutions agree within {agreement:.2g} rad"
        if agreement > _AGREEMENT * number:
            what, shown = (
                "difference of closed form and Newton-Raphson",
                Shown(agreement, _AGREEMENT * number, "rad", "<="),
            )
            fix = "report the design file"
            return CONDITIONING.check("fail", what, number, limit, shown=shown, fix=fix)
        if status == "pass" and self.motion.linkage.four_bar.kind() == "change-point":
            margin = math.degrees(min(self.motion.min_transmission_angle))
            what, shown = "distance of the swing from the change point of the linkage", Shown(margin, None, "deg")
            fix = "change a link so that shortest and longest link do not add up to the other two"
            return CONDITIONING.check("warn", what, number, limit, shown=shown, fix=fix)
        fix = note = ""
        if status == "warn" and self.advises:
            fix, note = _away_from_dead_centre(self), _loss_near_dead_centre(self)
        return CONDITIONING.check(status, what, number, limit, aside=aside, fix=fix, note=note)

    def check_velocity_step(self) -> Check:
        """GL403 at the six joints of the law."""
        return _steps(self, VELOCITY_STEP, 1, "fail")

    def check_acceleration_step(self) -> Iterator[Check]:
        """GL404 at the six joints of the law, and within a law."""
        yield _steps(self, ACCELERATION_STEP, 2, "warn")
        for phase in self.motion.law.inner_steps:
            what, fix = f"the acceleration steps within phase {phase}", f"set laws.{phase} to modified-sine"
            yield ACCELERATION_STEP.check("warn", what, fix=fix)

    def check_finger_release(self) -> Iterator[Check]:
        """GL423: the fingers are half open where the release window ends."""
        if self.spec.fingers is None:
            return
        opened, half = math.degrees(self.fingers.opened), 0.5 * self.spec.fingers.open_angle
        status: Status = "fail" if opened < half else "pass"
        what, at = (
            "opening of the fingers at the end of the release window",
            f"{short(self.fingers.release_degrees)} deg",
        )
        fix = "reduce fingers.open.from or fingers.open.over" if status == "fail" else ""
        yield FINGER_RELEASE.check(status, what, opened, half, "deg", at=at, fix=fix)

    def check_stop_settling(self) -> Iterator[Check]:
        """GL421: what is left of the near dwell when the arm rests on its stop."""
        if self.spec.stop is None:
            return
        margin, least = self.stop.margin, _SETTLED_SHARE * self.motion.phases.near_dwell
        status: Status = "fail" if margin < 0.0 else "warn" if margin < least else "pass"
        what, overlap = "rest on the stop before the pick-up", "settling on the stop beyond the pick-up"
        at = f"{short(self.stop.impact_degrees)} deg"
        limit = 0.0 if status == "fail" else least
        fix = "reduce stop.restitution or stop.clearance" if status != "pass" else ""
        aside = f"settled in {short(self.stop.settling_time)} ms"
        yield STOP_SETTLING.check(status, what, margin, limit, "deg", at=at, fix=fix, aside=aside, overlap=overlap)

    def check_phase_allotment(self) -> Check:
        """GL420: the peak acceleration of the return over that of the phase accelerate; a limit only where given."""
        law, limit = self.motion.law, self.spec.limits.return_acceleration
        first, _, _, _, back, _ = self.motion.phase_angles
        ratio = law.total_swing * law.return_.peak_acceleration * first / (back * back)
        ratio /= law.speed * law.accelerate.peak_acceleration
        status: Status = "fail" if limit is not None and ratio > limit else "pass"
        what, fix = "peak acceleration of the return over that of the phase accelerate", "lengthen phases.return"
        return PHASE_ALLOTMENT.check(status, what, ratio, limit, fix=fix)

    def check_jerk_step(self) -> Check:
        """GL407: the largest jump of the third derivative at a joint; a limit only where the file gives one."""
        limit = self.spec.limits.jerk_step
        where, jump = max(_jumps(self, 3), key=lambda item: abs(item[1]))
        status: Status = "warn" if limit is not None and abs(jump) > limit else "pass"
        what, fix = "step of the swing's jerk (rad/rad^3)", "use the laws polynomial-4567 or velocity-4567"
        return JERK_STEP.check(status, what, abs(jump), limit, at=f"the {where}", fix=fix)

    def check_handover(self) -> Iterator[Check]:
        """GL503: speed, place and release window."""
        yield _speed_check(self)
        if self.spec.cylinder.center is not None:
            yield _place_check(self, complex(*self.spec.cylinder.center))
        if self.spec.release is not None:
            yield _inside_check(self, self.spec.release)
            yield _gap_check(self, self.spec.release)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 for all cams over a revolution; a warning for the phase accelerate; it fails where no cam can be."""
        limit = self.spec.limits.pressure_angle
        if self.spec.fingers is not None:
            fix = "lengthen fingers.open.over and fingers.close.over, or fingers.lever"
            yield from pressure_angle_checks((self.fingers.cam,), limit, fix)
        if self.spec.cam is None:
            return
        if self.cams.refusal is not None:
            yield impossible("no cam can make this motion", self.cams.refusal, limit)
            return
        over = self.advises and limit > 0.0 and is_steep(max(self.max_pressure_angle), math.radians(limit))
        yield from pressure_angle_checks(self.cams.discs, limit, self.cams.center_remedy(limit) if over else "")
        if self.warnings:
            yield from _accelerating(self, self.spec.limits.accelerate_pressure_angle)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 for both cams, and for that of the fingers."""
        if self.spec.cam is not None:
            yield from undercut_checks(self.cams.discs, plainly=FARTHER)
        if self.spec.fingers is not None:
            yield from undercut_checks((self.fingers.cam,), plainly="set a smaller fingers.roller_radius")

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the profiles against the cam shaft; cams, links, rollers, arm, drum against the axes of the frame."""
        if self.warnings:
            yield from beside_axes(self)
        yield from hub_checks(
            SHAFT_CLEARANCE,
            self.cams.discs,
            self.cams.section.shaft_radius,
            lambda missing: f"set cam.center {safely_above(missing)} mm farther from the roller",
        )

    def check_lift_off(self) -> Check:
        """GL406: contact at the design speed, with a tenth of speed in reserve; it fails where nothing closes both.

        Notes
            The two rollers sit on rockers of their own, which the spring pulls together: without it neither is pressed
            on its cam. That is a warning, since the file may leave out the spring that the machine has.
        """
        if self.closure.refusal is not None:
            what, fix = self.closure.refusal.message, self.closure.refusal.fix
            return LIFT_OFF.check("fail", what, None, self.spec.speed, "sheets/h", fix=fix)
        if self.spec.spring is None:
            rollers = "either roller on its cam" if len(self.cams.discs) > 1 else "the roller on its cam"
            pull = max(extreme.value for extreme in self.closure.worst_unloading)
            what, least = f"nothing presses {rollers}", f" of at least {safely_above(_RESERVE**2 * pull, 4)} N m"
            fix = f"give spring.torque{least if pull > 0.0 else ''}, or the levers of the spring"
            return LIFT_OFF.check("warn", what, None, self.spec.speed, "sheets/h", fix=fix)
        torque, speed, reserve = self.closure.closing_torque, self.closure.lift_off_speed, self.closure.spring.reserve
        names = [cam.name.removesuffix(" cam") for cam in self.cams.discs]
        roller, worst = max(zip(names, self.closure.worst_unloading, strict=True), key=lambda item: item[1].value)
        if speed is None:
            return LIFT_OFF.check("pass", "no roller lifts off its cam at any speed", None, None, "sheets/h")
        status: Status = (
            "fail" if torque - worst.value <= reserve else "warn" if speed < 1.1 * self.spec.speed else "pass"
        )
        needed = worst.value + reserve
        fix = ""
        if status != "pass":
            # of a check that fails the value is tried
            fix = (
                self.closure.spring_remedy(1.21 * worst.value + reserve, tells=status == "warn")
                + " (10 % speed margin)"
            )
        return LIFT_OFF.check(
            status,
            f"lift-off speed of the {roller} roller",
            speed,
            self.spec.speed,
            "sheets/h",
            recommended=1.1 * self.spec.speed,
            aside=f"required {short(needed)} N m, spring {short(torque)} N m",
            at=f"cylinder angle {short(worst.place)} deg",
            fix=fix,
        )

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """Those of the optional sections too: cams with their spring, fingers, a balanced law, a stop."""
        of_cams = () if spec.cam is None else (*cls.outlines["cam"].checks, "lift-off")
        if command == "cam":
            return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams)))
        of_fingers = () if spec.fingers is None else _OF_FINGERS
        of_law = () if spec.limits.return_acceleration is None else ("phase-allotment",)
        of_stop = () if spec.cam is None or spec.stop is None else ("stop-settling",)
        return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams, *of_fingers, *of_law, *of_stop)))

    def outline(self, command: str) -> Outline:
        """`gripper` and `analyze` add what the optional sections of the file make possible."""
        outline, spec = self.outlines[command], self.spec
        if command == "cam":
            return self._of_cams(outline)
        if spec.fingers is not None:
            outline = outline._replace(
                quantities=(*outline.quantities, "finger_lift"), checks=(*outline.checks, *_OF_FINGERS)
            )
        if spec.limits.return_acceleration is not None:
            outline = outline._replace(checks=(*outline.checks, "phase-allotment"))
        if spec.cam is None:
            return outline
        if self.cams.is_refused:
            checks = dict.fromkeys((*outline.checks, "pressure-angle"))
            return Outline(outline.quantities, tuple(checks), outline.tables)
        cams = self._of_cams(self.outlines["cam"])
        quantities, tables = [*outline.quantities, *cams.quantities[:-2]], outline.tables
        if command == "analyze":
            quantities, tables = [*outline.quantities, *cams.quantities], (*outline.tables, *cams.tables)
        checks = dict.fromkeys((*outline.checks, *cams.checks))
        if self.closure.stands:
            quantities += _CLOSURE if spec.spring is not None and spec.spring.torque is None else ("lift_off_speed",)
            checks |= {"lift-off": None}
        if self.closure.stands and spec.stop is not None:
            quantities += (name for name in _STOP if name != "stop_force_max" or spec.stop.stiffness is not None)
            checks |= {"stop-settling": None}
        return Outline(tuple(quantities), tuple(checks), tables)

    def _of_cams(self, outline: Outline) -> Outline:
        """`cam`, with the centre where it is chosen, and what is wrong where nothing presses the rollers on them."""
        cam = self.spec.cam
        if cam is None or self.cams.is_refused:
            return outline
        chosen = ("cam_center",) if cam.center is None else ()
        closing = ("lift-off",) if self.spec.spring is None or self.closure.refusal is not None else ()
        tables = outline.tables if cam.return_roller is not None else outline.tables[:1]
        return Outline((*chosen, *outline.quantities), (*outline.checks, *closing), tables)


# A gripper's tip beside the drum that takes the sheet over: gap to the pitch circle, slip, speed difference.
#
# The arm l turns about E, the drum R about O at the distance D; d is the arm's lead on the line of centres E-O.
# Arm and drum turn in opposite senses; d and the drum's turn count positive in the sense of the working stroke.


@dataclass(frozen=True, slots=True)
class TipPath:
    """The tip seen from the drum, over the leads asked for.

    Attributes
        gap : (N,) array [mm] - |OF| - R, positive outside the pitch circle
        drum_angle : (N,) array [rad] - psi_F, angle of F about O from the line of centres
        slip : (N,) array [mm] - R (psi_F - turned): how far the tip is ahead of the sheet since the handover
    """

    gap: Reals
    drum_angle: Reals
    slip: Reals


def tip_path(arm: float, radius: float, distance: float, lead: Reals, turned: Reals, lead_0: float = 0.0) -> TipPath:
    """Path of the gripper tip relative to the drum.

    |OF|^2 = (D - l)^2 + 4 l D sin^2(d/2),   gap = [(D - l - R)(D - l + R) + 4 l D sin^2(d/2)]/(|OF| + R)
    psi_F = atan2(l sin d, D - l cos d)

    Parameters
        arm, radius, distance : float [mm] - l, R, D
        lead : (N,) array [rad] - d of the arm on the line of centres
        turned : (N,) array [rad] - turn of the drum since the handover
        lead_0 : float [rad] - d at the handover; not 0 where the drum stands off the line of the arm
    Notes
        No difference of nearly equal lengths where D = l + R. The gap opens as l D/(2R) d^2, the slip as d^3.
    Example
        >>> turned = np.radians([0.0, 1.0, 6.0])
        >>> tip_path(300.0, 135.0, 435.0, 0.45 * turned, turned).gap.round(6).tolist()
        [0.0, 0.029811, 1.068889]
    """
    offset = distance - arm
    swell = 4.0 * arm * distance * np.sin(0.5 * lead) ** 2
    from_drum = np.sqrt(offset * offset + swell)
    gap: Reals = ((offset - radius) * (offset + radius) + swell) / (from_drum + radius)
    angle: Reals = _drum_angle(arm, distance, lead)
    slip: Reals = radius * (angle - _drum_angle(arm, distance, np.float64(lead_0)) - turned)
    return TipPath(gap, angle, slip)


def _drum_angle(arm: float, distance: float, lead: Reals | np.float64) -> Reals:
    # D - l cos d = (D - l) + 2 l sin^2(d/2)
    angle: Reals = np.arctan2(arm * np.sin(lead), distance - arm + 2.0 * arm * np.sin(0.5 * lead) ** 2)
    return angle


def speed_difference(path: TipPath, lead: Reals, tip_speed: Reals, drum_speed: float, radius: float) -> Reals:
    """Tangential speed of the tip less that of the drum turning below it.

    v cos(d + psi_F) - (R + gap) Omega

    Parameters
        lead : (N,) array [rad] - d
        tip_speed : (N,) array [mm/s] - v along the arm's circle
        drum_speed : float [rad/s] - Omega
        radius : float [mm] - R
    Returns
        difference : (N,) array [mm/s]
    """
    turn = np.sin(0.5 * (lead + path.drum_angle)) ** 2
    difference: Reals = (tip_speed - radius * drum_speed) - 2.0 * tip_speed * turn - path.gap * drum_speed
    return difference


def widest_window(arm: float, radius: float, gap: float) -> float:
    """Largest turn of the drum to either side of the handover within which the tip keeps to the pitch circle.

    sin^2(d/2) = gap (2 R + gap)/(4 l (l + R)),   turn = d l/R

    Parameters
        arm, radius : float [mm] - l, R; the tip stands on the line of centres at the handover
        gap : float [mm] - allowed distance from the pitch circle
    Returns
        turn : float [rad]
    Raises
        NoSolution - for a gap of 2 l or more, which no turn reaches
    Example
        >>> round(math.degrees(widest_window(300.0, 135.0, 0.03)), 4)
        1.0032
    """
    if gap >= 2.0 * arm:
        raise NoSolution(
            f"gap of the tip from the pitch circle: {unlike(gap, 2.0 * arm)} mm (limit < {unlike(2.0 * arm, gap)} mm)",
            fix=f"specify less than {safely_below(2.0 * arm)} mm",
        )
    square = gap * (2.0 * radius + gap) / (4.0 * arm * (arm + radius))
    return 2.0 * math.asin(math.sqrt(square)) * arm / radius


@dataclass(frozen=True, slots=True)
class Misplacement:
    """How far the drum stands off the gripper at the handover.

    Attributes
        place : float [mm] - from the tip to the point of the pitch circle on the line of centres
        turn : float [rad] - what to add to the arm's direction so that it lies on the line of centres
        distance : float [mm] - what the centre distance exceeds l + R by
    """

    place: float
    turn: float
    distance: float


def misplacement(pivot: complex, tip: complex, center: complex, radius: float) -> Misplacement:
    """Where the tip stands at the handover against the line of centres.

    Parameters
        pivot, tip, center : complex [mm] - E, F at the handover, O
        radius : float [mm] - R
    Example
        >>> off = misplacement(0j, 300.0 + 0j, 436.0 + 0j, 135.0)
        >>> off.place, off.turn, off.distance
        (1.0, 0.0, 1.0)
    """
    line = center - pivot
    contact = center - radius * line / abs(line)
    turn = cmath.phase(line / (tip - pivot))
    return Misplacement(abs(tip - contact), turn, abs(line) - abs(tip - pivot) - radius)


def drum_center(pivot: complex, tip: complex, radius: float) -> complex:
    """Centre of the drum whose rim the gripper tip touches on the line of centres.

    O_t = E + (l + R) (F - E)/l

    Parameters
        pivot, tip : complex [mm] - E, and F at the handover
        radius : float [mm] - R of the drum
    Example
        >>> drum_center(0j, 30.0 + 40.0j, 10.0)
        (36+48j)

    Source
        swing-gripper paper 2 (handover on the line of centres)
    """
    arm = tip - pivot
    return pivot + arm * (1.0 + radius / abs(arm))
