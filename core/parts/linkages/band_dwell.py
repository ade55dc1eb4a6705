"""The longest dwell of any output within a band, which stays within +- tol of a position that is free to choose.

The search stands once for one output and for many. Inside the band both ends are found together, by Newton's method in
two unknowns; where one end binds, and where the back-step is wider than the band, by roots inside brackets.

Linkages that step back with every value of one unknown length have a back-step, a longest dwell and a flattest window.

Without a momentary dwell in the range the back-step has a minimum value above 0 there. A wider band is filled by the
back-step of a linkage to either side of that place, as everywhere; a narrower one by none, and the output dwells about
one of its two standstills. The window as a function of the length has several humps then and jumps where the back-step
fills the band, so it is looked at over the whole range.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from contextlib import suppress
from dataclasses import dataclass, field
from functools import cached_property
from typing import Any, ClassVar, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.numerics.roots import bracketed_root, maximum, newton_root, roots_on

_TURN = 2.0 * math.pi
_FIT = 1e-13
_NEAR = 1e-9
_LONGEST_OF_ENDS = 0.4  # step of both ends of a band [rad]
REST, MOST_STEPS = 1e-8, 40  # of the ends [rad]: what the last step leaves is its square


class ToleranceDwell(NamedTuple):
    """A dwell within a tolerance.

    start : float [rad] - crank angle of its start, in [0, 2 pi)
    crank_angle : float [rad] - its length
    output_angle : float [rad] - the middle of the output's range there, counted from the crank angle 0 with
        the start as it stands
    """

    start: float
    crank_angle: float
    output_angle: float


@dataclass(frozen=True)
class Valley:
    """Part of the turn around the least speed of one output; `Valleys` of the three-gear drive is that of many.

    Fields
        course : the output, with angle(phi), speed(phi), and rates(phi, order): both and more derivatives
        first, second : float [rad] - phi(1), phi(2), or the minimum speed's place twice
        least, low, high : float [rad] - places of the minimum speed, and of the maximum speed before and after it
        mean : float - output revolutions per crank revolution, positive
    """

    course: Any
    first: Any
    second: Any
    least: Any
    low: Any
    high: Any
    mean: Any
    fn: ClassVar[Elementary] = SCALARS

    def angle(self, phi: Any) -> Any:
        """Angle of the output [rad]."""
        return self.course.angle(phi)

    def speed(self, phi: Any) -> Any:
        """Its speed ratio."""
        return self.course.speed(phi)

    @cached_property
    def drop(self) -> Any:
        """The back-step [rad], 0 without one."""
        return self.fn.greatest(0.0, self.angle(self.first) - self.angle(self.second))

    def before(self, level: Any) -> Any:
        """Crank angle where the output last passes a level before its standstills."""
        beyond, where = level < self.angle(self.low), self.fn.where
        return self.reach(level, where(beyond, self.second - _TURN, self.low), where(beyond, self.low, self.first))

    def after(self, level: Any) -> Any:
        """Crank angle where the output first passes a level after its standstills."""
        beyond, where = level > self.angle(self.high), self.fn.where
        return self.reach(level, where(beyond, self.high, self.second), where(beyond, self.first + _TURN, self.high))

    # What one output does otherwise than many

    def reach(self, level: Any, left: Any, right: Any, sign: float = 1.0, start: Any = None) -> Any:
        """Crank angle between two others where the output, rising (sign 1) or falling, passes a level, else an end."""
        if sign * (self.angle(left) - level) >= 0.0:
            return left
        if sign * (self.angle(right) - level) <= 0.0:
            return right

        def above(phi: float) -> tuple[float, float]:
            angle, speed = self.course.rates(phi, 1)
            return sign * (angle - level), sign * speed

        inside = start is not None and left < start < right
        return newton_root(above, left, right, start if inside else 0.5 * (left + right))

    def either(self, holds: Any, one: Callable[..., Any], other: Callable[..., Any], *given: Any) -> Any:
        """What one function of a valley and the given finds where something holds, elsewhere the other."""
        return (one if holds else other)(self, *given)

    def settled(self, tolerance: Any) -> tuple[Any, Any, Any]:
        """Both ends where the speed there is the same, and whether the steps to them rest."""
        left = right = self.least
        with suppress(ZeroDivisionError):
            half = half_of_parabola(self, tolerance)
            left, right = left - half, right + half
            for _ in range(MOST_STEPS):
                back, on = to_one_speed(self.course, left, right, tolerance, self.fn)
                left, right = left + back, right + on
                if abs(back) <= REST and abs(on) <= REST:
                    return left, right, True
        return left, right, False

    def held(self, f: Callable[..., Any], most: Any, *given: Any) -> Any:
        """Root between 0 and an end of a rising function of a valley, the place and the given; or the nearer end."""
        ends = f(self, 0.0, *given), f(self, most, *given)
        if ends[0] >= 0.0 or ends[1] <= 0.0:
            return 0.0 if ends[0] >= 0.0 else most
        return bracketed_root(lambda x: f(self, x, *given), 0.0, most, ends=ends)


def least_band(valley: Valley, window: float) -> float:
    """Minimum tolerance of a window that holds both standstills.

    tau = (phi5(L + window) - phi5(L))/2,   phi5(L) <= phi5(2),   phi5(L + window) >= phi5(1)

    Parameters
        valley : Valley - of an output with at most one back-step a revolution
        window : float [rad] - at least that of equal ripple, which has no room to either side; see `band_of_window`
    Returns
        tolerance : float [rad]
    Notes
        The inverse of `longest_in_band` where the band is at least as wide as the back-step.

    Source
        own derivation
    """
    top, bottom = valley.angle(valley.first), valley.angle(valley.second)
    first, last = valley.after(top) - window, valley.before(bottom)

    def gain(left: float) -> float:
        return float(valley.speed(left + window) - valley.speed(left))

    if first >= last or (most := gain(last)) <= 0.0:
        left = last
    elif (least := gain(first)) >= 0.0:
        left = first
    else:
        left = bracketed_root(gain, first, last, ends=(least, most))
    return float(0.5 * max(valley.angle(left + window) - valley.angle(left), top - bottom))


def band_of_window(valley: Valley, window: float) -> float:
    """Minimum tolerance of a window that holds both standstills, or one where the back-step is wider than its band.

    Parameters
        valley : Valley - of an output with at most one back-step a revolution
        window : float [rad] - positive
    Returns
        tolerance : float [rad]
    Notes
        The inverse of `longest_in_band`, whose window jumps where the back-step fills the band: windows inside of the
        jump have its tolerance, by `least_band`.

    Source
        own derivation
    """
    found = [each for each in (_about_top(valley, window), _about_bottom(valley, window)) if each is not None]
    return min(found) if found else least_band(valley, window)


def _about_top(valley: Valley, window: float) -> float | None:
    """Minimum tolerance of a window about phi(1) that ends before phi(2); None where it is too long for that."""
    first, last = valley.first - window, min(valley.first, valley.second - window)
    left = _of_one_level(valley, window, first, last)
    return None if left is None else 0.5 * (valley.angle(valley.first) - valley.angle(left))


def _about_bottom(valley: Valley, window: float) -> float | None:
    """The same about phi(2), begun after phi(1)."""
    first, last = max(valley.second - window, valley.first), valley.second
    left = _of_one_level(valley, window, first, last)
    return None if left is None else 0.5 * (valley.angle(left) - valley.angle(valley.second))


def _of_one_level(valley: Valley, window: float, first: float, last: float) -> float | None:
    """Start of a window, between two places, at whose ends the output stands alike."""

    def gain(left: float) -> float:
        return float(valley.angle(left + window) - valley.angle(left))

    ends = gain(first), gain(last)
    if valley.first == valley.second or ends[0] * ends[1] > 0.0:
        return None
    return bracketed_root(gain, first, last, ends=ends)


def longest_in_band(valley: Valley, tolerance: float) -> ToleranceDwell:
    """Longest crank interval over which the output stays within +- tol of a place that is free to choose.

    Parameters
        valley : Valley - of an output with at most one back-step a revolution
        tolerance : float [rad] - 0 < tol < pi times the mean ratio
    Returns
        dwell : ToleranceDwell [rad]
    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole revolution lies within it
    Notes
        At tol = D/2 and small back-steps the dwell is one third longer than phi13, which uses one side of the band.
    """
    limit = math.pi * valley.mean
    if not 0.0 < tolerance < limit:
        raise NoSolution(
            f"dwell tolerance: {unlike(math.degrees(tolerance), math.degrees(limit))} deg (above 0, below "
            f"{unlike(math.degrees(limit), math.degrees(tolerance))} deg, half of the output angle per revolution)"
        )
    left, right, middle, *_ = ends_in_band(valley, tolerance)
    start = left % _TURN % _TURN  # twice: a tiny negative angle is rounded up to a whole revolution by the first
    return ToleranceDwell(start, right - left, middle - valley.mean * (left - start))


def ends_in_band(valley: Valley, tolerance: Any) -> tuple[Any, ...]:
    """The longest interval within +- tol of one output, or of each of many: its ends, and the output's middle there.

    Then whether another is as long, or roots do not settle; and whether the back-step is wider than the band.

    phi5(R) - phi5(L) = 2 tol  and  W(L) = W(R) >= 0,   both standstills between L and R;
    with a back-step D > 2 tol instead  phi5(L) = phi5(R) = phi5(1) - 2 tol  or  phi5(2) + 2 tol, the longer

    Notes
        The angle rises outside of the standstills, and what the window leaves of the turn has one maximum speed. Where
        W(L) = W(R) cannot hold with both standstills inside, the end that binds is taken: of long windows with both
        ends beyond the maximum speed, too.

    Source
        own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
    """
    # The longest interval jumps where the back-step just fits: a tolerance meant to fit it must not miss it by an ulp.
    wide = valley.drop > 2.0 * tolerance * (1.0 + _FIT) + _FIT * math.pi * valley.mean
    return *valley.either(wide, _around_one_extreme, _around_both, tolerance), wide


def _around_both(valley: Valley, tolerance: Any) -> tuple[Any, ...]:
    """Intervals that hold both standstills: ends of one speed, or one end that binds."""
    (left, right, inside), bottom = valley.settled(tolerance), valley.angle(valley.second)
    inside = inside & (valley.low <= left) & (left <= valley.first) & (valley.second <= right) & (right <= valley.high)
    inside = inside & (valley.angle(left) <= bottom) & (valley.angle(right) >= bottom + valley.drop)
    return tuple(valley.either(inside, _as_found, _with_one_end, tolerance, left, right))


def _as_found(valley: Valley, tolerance: Any, left: Any, right: Any) -> tuple[Any, ...]:
    return left, right, valley.angle(left) + tolerance, left > right


def half_of_parabola(valley: Valley, tolerance: Any) -> Any:
    """Half of the interval whose speed is the parabola about its minimum: of a cubic, by Newton's method."""
    fn = valley.fn
    _, least, _, bend = valley.course.rates(valley.least, 3)
    half = fn.sqrt(fn.greatest(-6.0 * least / bend, 0.0)) + fn.cbrt(6.0 * tolerance / bend)
    for _ in range(4):
        half = half - (least * half + bend * half**3 / 6.0 - tolerance) / (least + 0.5 * bend * half * half)
    return fn.where(half > 0.0, fn.least(half, 0.5 * math.pi), 0.5 * math.pi)


def to_one_speed(course: Any, left: Any, right: Any, tolerance: Any, fn: Elementary) -> tuple[Any, Any]:
    """Newton's step to phi5(R) - phi5(L) = 2 tol, W(L) = W(R)."""
    (a1, w1, s1), (a2, w2, s2) = course.rates(left, 2), course.rates(right, 2)
    missing, faster, whole = a2 - a1 - 2.0 * tolerance, w2 - w1, w2 * s1 - w1 * s2
    steps = (w2 * faster - s2 * missing) / whole, (w1 * faster - s1 * missing) / whole
    back, on = (fn.least(fn.greatest(step, -_LONGEST_OF_ENDS), _LONGEST_OF_ENDS) for step in steps)
    return back, on


def _with_one_end(valley: Valley, tolerance: Any, *_: Any) -> tuple[Any, ...]:
    """One end as far as it may be where the speeds at both cannot be equal; else a root inside brackets of how far the
    output rises from L to its place at phi(2)."""
    rise = valley.held(_slower, valley.fn.greatest(2.0 * tolerance - valley.drop, 0.0), tolerance)
    left, right = _of_rise(valley, rise, tolerance)
    return left, right, valley.angle(valley.second) - rise + tolerance, rise != rise


def _slower(valley: Valley, rise: Any, tolerance: Any) -> Any:
    left, right = _of_rise(valley, rise, tolerance)
    return valley.speed(left) - valley.speed(right)


def _of_rise(valley: Valley, rise: Any, tolerance: Any) -> tuple[Any, Any]:
    level = valley.angle(valley.second) - rise
    return valley.before(level), valley.after(level + 2.0 * tolerance)


def _around_one_extreme(valley: Valley, tolerance: Any) -> tuple[Any, ...]:
    """The longer of the intervals around phi(1) and phi(2), of back-steps above 2 tol."""
    first, second, fn = valley.first, valley.second, valley.fn
    found = []
    for place, away, outside in ((first, -1.0, (second - _TURN, first)), (second, 1.0, (second, first + _TURN))):
        angle, _, slope = valley.course.rates(place, 2)
        level, spread = angle + away * 2.0 * tolerance, away * fn.sqrt(4.0 * tolerance / abs(slope))  # of the parabola
        inner = valley.reach(level, first, second, -1.0, place - spread)
        outer = valley.reach(level, *outside, 1.0, place + spread)
        found.append((*((outer, inner) if away < 0.0 else (inner, outer)), level - away * tolerance))
    gained = (found[0][1] - found[0][0]) - (found[1][1] - found[1][0])
    return *(fn.where(gained >= 0.0, one, other) for one, other in zip(*found, strict=True)), abs(gained) <= _NEAR


_NODES = 24
_INSIDE = math.radians(1e-3)  # beside a limit of the transmission angle, for the digits of a printed frame


@dataclass(frozen=True)
class AlwaysStepping:
    """A range of a length within which every output steps back once a revolution.

    Fields
        valley_of : the valley of the output's speed at a length
        low, high : float [mm] - the range, of linkages that turn
    """

    valley_of: Callable[[float], Valley]
    low: float
    high: float
    kept: dict[float, Valley] = field(default_factory=dict, repr=False)

    def within(self, low: float, high: float) -> AlwaysStepping | None:
        """The part of it between two lengths [mm]; None where there is none."""
        low, high = max(low, self.low), min(high, self.high)
        return AlwaysStepping(self.valley_of, low, high, self.kept) if low < high else None

    def valley(self, length: float) -> Valley:
        """The valley at a length, found once."""
        if length not in self.kept:
            self.kept[length] = self.valley_of(length)
        return self.kept[length]

    def step(self, length: float) -> float:
        """The back-step D [rad] of a length."""
        valley = self.valley(length)
        return float(valley.angle(valley.first) - valley.angle(valley.second))

    def window(self, length: float, tolerance: float) -> float:
        """The longest crank angle [rad] within +- a tolerance [rad] at a length."""
        return longest_in_band(self.valley(length), tolerance).crank_angle

    def ripple(self, length: float) -> float:
        """The window [rad] within the band that the back-step fills: all of a revolution that gains no more than it."""
        half, mean = 0.5 * self.step(length), self.valley(length).mean
        return self.window(length, half) if half < math.pi * mean else 2.0 * math.pi

    @cached_property
    def _even(self) -> list[float]:
        return [self.low + k / _NODES * (self.high - self.low) for k in range(_NODES + 1)]

    @cached_property
    def least_step(self) -> tuple[float, float]:
        """Length and back-step [rad] of the smallest one."""
        place, value = self._best(lambda length: -self.step(length), self._even)
        return place, -value

    @cached_property
    def _nodes(self) -> list[float]:
        """Lengths between which the back-step runs one way."""
        return sorted({*self._even, self.least_step[0]})

    def with_step(self, angle: float) -> list[float]:
        """Lengths whose back-step is an angle [rad]; to either side of the smallest one, or none."""
        return roots_on(lambda length: self.step(length) - angle, self._nodes)

    def longest(self, tolerance: float) -> tuple[float, float]:
        """Length with the longest window within a tolerance [rad], and that window [rad]."""
        filled = [(length, self.ripple(length)) for length in self.with_step(2.0 * tolerance)]
        return max(
            [*filled, self._best(lambda length: self.window(length, tolerance), self._nodes)], key=lambda at: at[1]
        )

    def flattest(self, window: float) -> tuple[float, float]:
        """Length with which the output keeps nearest to its place over a window [rad], and how near [rad]."""
        even = [(x, -0.5 * self.step(x)) for x in roots_on(lambda x: self.ripple(x) - window, self._nodes)]
        least = self._best(lambda length: -band_of_window(self.valley(length), window), self._nodes)
        place, value = max([*even, least], key=lambda at: at[1])
        return place, -value

    def interval(self, length: float, window: float, tolerance: float) -> list[float]:
        """Lengths about one that meets a request between which all meet it, [low, high] [mm]."""

        def spare(other: float) -> float:
            return self.window(other, tolerance) - window

        def end(ahead: list[float]) -> float:
            near, room = length, spare(length)
            for other in ahead:
                if (lack := spare(other)) < 0.0:
                    return bracketed_root(spare, near, other, ends=(room, lack)) if room > 0.0 else near
                near, room = other, lack
            return near

        before = [x for x in reversed(self._nodes) if x < length]
        return [end(before), end([x for x in self._nodes if x > length])]

    def _best(self, measure: Callable[[float], float], nodes: list[float]) -> tuple[float, float]:
        """Length and value of the maximum value of a measure, between the neighbours of the best node."""
        values = [measure(node) for node in nodes]
        at = max(range(len(nodes)), key=values.__getitem__)
        return maximum(measure, nodes[max(0, at - 1)], nodes[min(len(nodes) - 1, at + 1)])


def keeping(always: AlwaysStepping, crank: float, coupler: float, rocker: float, angle: float) -> list[AlwaysStepping]:
    """The frames of crank-rockers whose transmission angle is nowhere less than an angle, if any, and then all frames.

    d - a >= sqrt(b^2 + c^2 - 2 b c cos mu),   d + a <= sqrt(b^2 + c^2 + 2 b c cos mu)

    Parameters
        always : AlwaysStepping - of the frames
        crank, coupler, rocker : float [mm] - a, b, c
        angle : float [rad] - mu
    """
    squares, both = coupler**2 + rocker**2, 2.0 * coupler * rocker * math.cos(angle + _INSIDE)
    kept = always.within(math.sqrt(squares - both) + crank, math.sqrt(squares + both) - crank)
    return [always] if kept is None else [kept, always]


def flattest_of(parts: list[AlwaysStepping], window: float, band: float | None) -> tuple[float, float]:
    """Length and tolerance [rad] of a window [rad] in the first part that holds it within a band [rad], or the last."""
    for part in parts:
        length, least = part.flattest(window)
        if band is None or least <= band:
            break
    return length, least
