"""The follower of a press's compensation cam: lead-in, synchronous zone, transition, return, dwell.

The lift of the follower is a function of the cam angle theta, in mm and radians. In the zone it makes good the
difference of bed and cylinder travel; before and after the zone the printing is done and the lift is free, so
that it can be joined smoothly. Derivatives by the cam angle come from the chain rule.

Where it cannot make its lift, the nearest cause is said first, and the key that would let it.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.flatbed_press.chains import BedChain, CylinderChain, Travel, difference
from gearlink.core.machines.flatbed_press.zone import turning_within
from gearlink.core.numerics.roots import bracketed_root, maximum
from gearlink.core.parts.cams.laws import Law

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals


_TURN = 2.0 * math.pi


def transition_too_early(follower: Compensation) -> NoSolution:
    """The transition ends before the zone does."""
    end = math.degrees(follower.cam_sync_end)
    text = (
        f"the transition ends at cam angle {short(math.degrees(follower.transition_end))} deg, the synchronous zone at "
        f"{short(end)} deg"
    )
    fix = f"set cam.transition_end above {safely_above(end)} deg, the farther the flatter the cam"
    return turns_back(follower) or NoSolution(text, key="cam.transition_end", fix=fix)


def return_too_late(follower: Compensation) -> NoSolution:
    """The return runs into the next sheet: shorten it, or the lead-in where that leaves no room at all."""
    next_sheet = follower.cam_sync_start - follower.lead_in + _TURN
    text = (
        f"the return ends at cam angle {short(math.degrees(follower.return_end))} deg, after the next sheet begins at "
        f"{short(math.degrees(next_sheet))} deg"
    )
    turned = turns_back(follower)
    if turned is not None:
        return turned
    most = math.degrees(next_sheet - follower.transition_end)
    if most > 0.0:
        return NoSolution(text, key="cam.return_angle", fix=f"set cam.return_angle to at most {safely_below(most)} deg")
    room = safely_below(math.degrees(follower.cam_sync_start + _TURN - follower.transition_end))
    fix = f"shorten cam.lead_in and cam.return_angle to {room} deg together"
    return NoSolution(text, key="cam.lead_in", fix=fix)


def turns_back(follower: Compensation) -> NoSolution | None:
    """The bed turns back within the zone, so that the zone is to end before; None where it does not.

    A zone that ends where the bed turns back at the end of the turn leaves no transition before it.
    """
    turning = turning_within(follower.bed, follower.sync_start, follower.sync_end)
    if turning is None and follower.cam_sync_end >= _TURN:
        turning = _TURN
    if turning is None:
        return None
    key, unit = ("sync.end", "deg") if follower.end_given else ("sync.length", "mm")
    text = (
        f"the bed reverses at input angle {short(math.degrees(turning))} deg, before the synchronous zone ends "
        f"({short(math.degrees(follower.sync_end))} deg)"
    )
    fix = f"set {key} to at most {_most(follower, turning)} {unit}"
    begin, there = (float(follower.bed.cam_angle(angle).value) for angle in (follower.sync_start, turning))
    if begin < follower.transition_end <= there:
        most = _most(follower, float(follower.bed.input_angle(follower.transition_end)))
        fix = f"set {key} to at most {most} {unit}, where cam.transition_end ends the zone"
    elif follower.transition_end <= there:
        fix += ", and cam.transition_end behind the end of the zone"
    return NoSolution(text, key=key, fix=fix)


def _most(follower: Compensation, end: float) -> str:
    """The key of a zone that ends at an input angle: its length [mm], or the angle [deg]; to the safe side."""
    if follower.end_given:
        return safely_below(math.degrees(end))
    travel = follower.cylinder.travel
    return safely_below(float(travel(end).value - travel(follower.sync_start).value))


# Sums of powers, of which lead-in and transition of a follower are made, with their derivatives

Terms: TypeAlias = tuple[tuple[int, float], ...]
"""Powers with their coefficients."""


def third(u: Any, terms: Terms) -> Any:
    """Third derivative of the sum of c u^n."""
    return sum((n * (n - 1) * (n - 2) * c * u ** (n - 3) for n, c in terms if n > 2), 0.0 * u)


def powers(u: Any, order: int, terms: Terms) -> Travel:
    """Sum of c u^n and its derivatives."""
    value = sum(c * u**n for n, c in terms)
    if order == 0:
        return Travel(value)
    first = sum(n * c * u ** (n - 1) for n, c in terms if n)
    if order == 1:
        return Travel(value, first)
    return Travel(value, first, sum(n * (n - 1) * c * u ** (n - 2) for n, c in terms if n > 1))


class Segment(NamedTuple):
    """A stretch of cam angle over which the lift is one smooth function.

    `lift(theta, order)` takes a float or an array within [start, end] and gives lift and derivatives.
    """

    phase: str
    start: float
    end: float
    lift: Callable[[Any, int], Travel]


class Joint(NamedTuple):
    """Where two segments meet: how far slope [mm/rad] and second derivative [mm/rad^2] jump."""

    before: str
    after: str
    cam_angle: float
    velocity_step: float
    acceleration_step: float


@dataclass(frozen=True)
class Compensation:
    """Lift of the compensation follower over a revolution of the cam.

    Parameters
        bed, cylinder : the two chains
        sync_start, sync_end : float [rad] - input angles of the zone
        transition : 'arc', 'parabola' or 'quartic'
        lead_in : float [rad] - cam angle before the zone; 0 for none
        transition_end : float [rad] - cam angle at which the rack stands
        return_angle : float [rad] - cam angle of the return
        return_law : Law - rest-to-rest law of the return
        end_given : bool - whether the file gives the end of the zone itself, not its length
    Raises
        NoSolution - when the stretches do not follow each other within one revolution
    Source
        TY-460 report 3.3, with the end slope taken per cam angle, not per input angle
    """

    bed: BedChain
    cylinder: CylinderChain
    sync_start: float
    sync_end: float
    transition: str
    lead_in: float
    transition_end: float
    return_angle: float
    return_law: Law
    end_given: bool = False

    @cached_property
    def cam_sync_start(self) -> float:
        """Cam angle at the start of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_start).value)

    @cached_property
    def cam_sync_end(self) -> float:
        """Cam angle at the end of the zone [rad]."""
        return float(self.bed.cam_angle(self.sync_end).value)

    @cached_property
    def return_end(self) -> float:
        """Cam angle at which the lift is zero again [rad]."""
        return self.transition_end + self.return_angle

    @cached_property
    def _zone_start(self) -> Travel:
        return self._zone_lift(self.sync_start, 2)

    @cached_property
    def _zone_end(self) -> Travel:
        return self._zone_lift(self.sync_end, 2)

    @cached_property
    def _difference_at_start(self) -> float:
        return float(difference(self.bed, self.cylinder, self.sync_start).value)

    @cached_property
    def compensation(self) -> float:
        """Difference of the two travels gathered over the zone [mm]."""
        return float(difference(self.bed, self.cylinder, self.sync_end).value - self._difference_at_start)

    @cached_property
    def end_slope(self) -> float:
        """Slope of the lift at the end of the zone [mm/rad]."""
        return float(self._zone_end.first)

    @cached_property
    def lead_in_lift(self) -> float:
        """Lift at the start of the zone [mm]: what the lead-in leaves behind; 0 without one.

        k_0 L/2 - a_0 L^2/12, with slope k_0 and second derivative a_0 of the zone at its start

        Source
            own derivation: the quartic from rest that meets slope and second derivative
        """
        if self.lead_in == 0.0:
            return 0.0
        start = self._zone_start
        return float(start.first) * self.lead_in / 2.0 - float(start.second) * self.lead_in**2 / 12.0

    @cached_property
    def transition_rise(self) -> float:
        """Rise over the transition [mm].

        arc (in the plot of mm over deg): T tan(atan(k_1)/2); parabola: k_1 T/2; quartic: k_1 T/2 + a_1 T^2/12

        Source
            TY-460 report 3.3 (arc); own derivation (parabola, quartic)
        """
        span = self.transition_end - self.cam_sync_end
        if self.transition == "arc":
            return math.degrees(span) * math.tan(math.atan(math.radians(self.end_slope)) / 2.0)
        rise = self.end_slope * span / 2.0
        return rise if self.transition == "parabola" else rise + float(self._zone_end.second) * span * span / 12.0

    @cached_property
    def top(self) -> float:
        """Lift at the end of the transition [mm]."""
        return self.lead_in_lift + self.compensation + self.transition_rise

    def _zone_lift(self, phi: Any, order: int, cam: Travel | None = None) -> Travel:
        """Lift in the zone above its start, by the cam angle, at an input angle; `cam` where the caller has it."""
        cam = self.bed.cam_angle(phi, order) if cam is None else cam
        p, q = self.bed.travel(phi, order, cam), self.cylinder.travel(phi, order)
        value = (p.value - q.value) - self._difference_at_start
        if order == 0:
            return Travel(value)
        first = (p.first - q.first) / cam.first
        if order == 1:
            return Travel(value, first)
        return Travel(value, first, ((p.second - q.second) - first * cam.second) / (cam.first * cam.first))

    def _sync(self, theta: Any, order: int) -> Travel:
        return self._sync_at(self.bed.input_angle(theta), order)

    def _sync_at(self, phi: Any, order: int, cam: Travel | None = None) -> Travel:
        lift = self._zone_lift(phi, order, cam)
        return Travel(lift.value + self.lead_in_lift, lift.first, lift.second)

    @cached_property
    def _lead_in_terms(self) -> Terms:
        """Acceleration a linear-quadratic ramp from 0, so that slope and acceleration meet the zone's."""
        length, k, a = self.lead_in, self._zone_start.first, self._zone_start.second
        return (3, (k / length - a / 3.0) / length), (4, (a / 4.0 - k / (2.0 * length)) / (length * length))

    def _lead_in(self, theta: Any, order: int) -> Travel:
        return powers(theta - (self.cam_sync_start - self.lead_in), order, self._lead_in_terms)

    @cached_property
    def _transition_terms(self) -> Terms:
        """Of the parabola and of the quartic."""
        span, k, a = self.transition_end - self.cam_sync_end, self.end_slope, float(self._zone_end.second)
        base = self.lead_in_lift + self.compensation
        if self.transition == "parabola":
            return (0, base), (1, k), (2, -k / (2.0 * span))
        c3 = -(k + 2.0 * a * span / 3.0) / span**2
        c4 = (k + a * span / 2.0) / (2.0 * span**3)
        return (0, base), (1, k), (2, a / 2.0), (3, c3), (4, c4)

    def _transition(self, theta: Any, order: int) -> Travel:
        if self.transition == "arc":
            return self._arc(theta)[0]
        return powers(theta - self.cam_sync_end, order, self._transition_terms)

    @cached_property
    def arc_radius(self) -> float | None:
        """Radius of the arc in the plot of lift [mm] over cam angle [deg]; None where it is level."""
        per_degree = math.radians(self.end_slope)
        span = math.degrees(self.transition_end - self.cam_sync_end)
        return span / math.sin(math.atan(per_degree)) if per_degree else None

    def _arc(self, theta: Any) -> tuple[Travel, Any]:
        """Arc in the plot of lift [mm] over cam angle [deg], tangent to the zone's end slope and to the level.

        Lift with two derivatives, and the third.
        """
        radius = self.arc_radius
        if radius is None:
            return Travel(self.top + 0.0 * theta, 0.0 * theta, 0.0 * theta), 0.0 * theta
        scale = 180.0 / math.pi
        x = (self.transition_end - theta) * scale / radius
        root = (1.0 - x * x) ** 0.5
        drop = radius * x * x / (1.0 + root)
        arc = Travel(self.top - drop, scale * x / root, -scale * scale / (radius * root**3))
        return arc, 3.0 * scale**3 * x / (radius**2 * root**5)

    def _return(self, theta: Any, order: int) -> Travel:
        """The rest-to-rest law, run downwards."""
        x = (theta - self.transition_end) / self.return_angle
        shape = self.return_law.evaluate(x, order)
        rates = [-self.top * s / self.return_angle**n for n, s in enumerate(shape) if n]
        return Travel(self.top * (1.0 - shape[0]), *rates)

    @cached_property
    def segments(self) -> tuple[Segment, ...]:
        """The stretches of one revolution in their order; the dwell closes the turn.

        Raises
            NoSolution - where the transition ends before the zone or the return runs into the next zone
        """
        begin, start, end = self.cam_sync_start - self.lead_in, self.cam_sync_start, self.cam_sync_end
        if not self.transition_end > end:
            raise transition_too_early(self)
        if self.return_end > begin + _TURN:
            raise return_too_late(self)
        stretches = [
            Segment("sync", start, end, self._sync),
            Segment("transition", end, self.transition_end, self._transition),
            Segment("return", self.transition_end, self.return_end, self._return),
            Segment("dwell", self.return_end, begin + _TURN, _at_rest),
        ]
        if self.lead_in > 0.0:
            stretches.insert(0, Segment("lead-in", begin, start, self._lead_in))
        return tuple(stretches)

    def evaluate(self, theta: Any, order: int = 2) -> tuple[Travel, list[str]]:
        """Lift at an array of cam angles, with `order` derivatives, and the phase of each.

        Parameters
            theta : (N,) array [rad] - any angles; a joint belongs to the stretch that starts there
            order : 0, 1 or 2
        Returns
            lift : Travel of (N,) arrays [mm, mm/rad, mm/rad^2]
            phases : N names
        """
        lift, index = self._placed(theta, order)
        return lift, [self.segments[i].phase for i in index]

    def lift(self, theta: Any, order: int = 2) -> Travel:
        """Lift at an array of cam angles, as `evaluate` gives it, without the names of the phases."""
        return self._placed(theta, order)[0]

    def lift_at(self, phi: Reals, cam: Travel, order: int = 2) -> Travel:
        """Lift and derivatives by the cam angle at input angles whose cam angles are known: no angle is solved for.

        Parameters
            phi : (N,) array [rad] - input angles
            cam : Travel of (N,) arrays - `BedChain.cam_angle` there, or whole revolutions more
            order : 0, 1 or 2
        """
        return self._placed(cam.value, order, (phi, cam))[0]

    def jerk(self, theta: Any) -> Any:
        """Third derivative of the lift by the cam angle at an array of cam angles [mm/rad^3]; NaN in the zone.

        Source
            own derivation
        """
        import numpy as np

        turned, index = self._stretches(theta)
        found = np.zeros_like(turned)
        for number, segment in enumerate(self.segments[:-1]):
            here = index == number
            found[here] = self._jerk_of(segment.phase, turned[here])
        return found

    def _jerk_of(self, phase: str, theta: Any) -> Any:
        if phase == "return":
            x = (theta - self.transition_end) / self.return_angle
            return -self.top * self.return_law.evaluate(x, 3)[3] / self.return_angle**3
        if phase == "lead-in":
            return third(theta - (self.cam_sync_start - self.lead_in), self._lead_in_terms)
        if phase == "transition":
            by_powers = self.transition != "arc"
            return third(theta - self.cam_sync_end, self._transition_terms) if by_powers else self._arc(theta)[1]
        return math.nan

    def _stretches(self, theta: Any) -> tuple[Any, Any]:
        """Cam angles within the turn of the stretches, and the number of the stretch of each."""
        import numpy as np

        begin = self.segments[0].start
        turned = begin + np.mod(np.asarray(theta, dtype=float) - begin, _TURN)
        return turned, np.searchsorted([segment.start for segment in self.segments], turned, side="right") - 1

    def _placed(self, theta: Any, order: int, known: tuple[Reals, Travel] | None = None) -> tuple[Travel, Any]:
        """Lift at an array of cam angles and the number of the stretch of each; `known`: as of `lift_at`."""
        import numpy as np

        turned, index = self._stretches(theta)
        lift = Travel(*(np.zeros_like(turned) for _ in range(order + 1)))
        for number, segment in enumerate(self.segments[:-1]):  # the last one stands
            inside = np.flatnonzero(index == number)
            if inside.size:
                if known is not None and segment.phase == "sync":
                    part = self._sync_known(known, inside, order)
                else:
                    part = segment.lift(turned[inside], order)
                for name in ("value", "first", "second")[: order + 1]:
                    getattr(lift, name)[inside] = getattr(part, name)
        return lift, index

    def _sync_known(self, known: tuple[Reals, Travel], rows: Any, order: int) -> Travel:
        """The zone's lift at some of the known input angles, less the turns that they are beyond the zone."""
        import numpy as np

        phi, cam = known[0][rows], Travel(*(part[rows] for part in known[1][: order + 1]))
        middle = 0.5 * (self.sync_start + self.sync_end)
        return self._sync_at(phi - _TURN * np.round((phi - middle) / _TURN), order, cam)

    @cached_property
    def joints(self) -> tuple[Joint, ...]:
        """Every place where two stretches meet, with the jumps there."""
        return tuple(self.joint(segment.phase) for segment in self.segments)

    def joint(self, phase: str) -> Joint:
        """Where a phase begins, with the jumps there."""
        before, after = self._beside(phase)
        left, right = before.lift(before.end, 2), after.lift(after.start, 2)
        steps = (right.first - left.first, right.second - left.second)
        return Joint(before.phase, after.phase, after.start, *(float(step) for step in steps))

    def velocity_step(self, phase: str) -> float:
        """Jump of the slope where a phase begins [mm/rad]: that of `joint`, and nothing else."""
        before, after = self._beside(phase)
        return float(after.lift(after.start, 1).first - before.lift(before.end, 1).first)

    def _beside(self, phase: str) -> tuple[Segment, Segment]:
        """The stretch before a phase, and its own."""
        number = next(i for i, segment in enumerate(self.segments) if segment.phase == phase)
        return self.segments[number - 1], self.segments[number]

    @cached_property
    def lift_range(self) -> tuple[float, float]:
        """Minimum and maximum lift of the turn [mm], refined inside each stretch."""
        return peaks(self.segments, map(_scan, self.segments[:-1]))


STEPS = 24


def _scan(segment: Segment) -> tuple[list[float], list[float]]:
    """Evenly spaced places on a stretch, and the lift there."""
    grid = [segment.start + (segment.end - segment.start) * i / STEPS for i in range(STEPS)] + [segment.end]
    return grid, [float(segment.lift(theta, 0).value) for theta in grid]


def peaks(segments: Sequence[Segment], scanned: Iterable[tuple[list[float], list[float]]]) -> tuple[float, float]:
    """Minimum and maximum lift of the turn: round those of each scan, the root of the slope or golden section.

    Parameters
        scanned : of all stretches but the dwell, as `_scan` gives them
    """
    low = high = 0.0
    for segment, (grid, values) in zip(segments[:-1], scanned, strict=True):
        low = min(low, -_peak(segment, -1.0, grid, [-value for value in values]))
        high = max(high, _peak(segment, 1.0, grid, values))
    return low, high


def _peak(segment: Segment, sign: float, grid: list[float], values: list[float]) -> float:
    """Largest sign * lift on a stretch, refined from its values on a grid."""
    last = len(grid) - 1
    i = max(range(len(values)), key=values.__getitem__)
    if i in (0, last):
        # An end is the peak unless the lift still rises inwards within the first interval.
        slope = sign * float(segment.lift(grid[i], 1).first) * (1.0 if i == 0 else -1.0)
        if slope <= 0.0:
            return values[i]
    low, high = grid[max(i - 1, 0)], grid[min(i + 1, last)]

    def slope_at(theta: float) -> float:
        return float(segment.lift(theta, 1).first)

    if slope_at(low) * slope_at(high) < 0.0:
        return max(values[i], sign * float(segment.lift(bracketed_root(slope_at, low, high), 0).value))
    return max(values[i], maximum(lambda theta: sign * float(segment.lift(theta, 0).value), low, high)[1])


def _at_rest(theta: Any, _order: int) -> Travel:
    zero = 0.0 * theta
    return Travel(zero, zero, zero)
