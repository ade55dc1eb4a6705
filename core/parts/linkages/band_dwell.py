"""The longest dwell of any output within a band, which stays within +- tol of a position that is free to choose.

Linkages that step back with every value of one unknown length have a back-step, a longest dwell and a flattest window.

Without a momentary dwell in the range the back-step has a minimum value above 0 there. A wider band is filled by the
back-step of a linkage to either side of that place, as everywhere; a narrower one by none, and the output dwells about
one of its two standstills. The window as a function of the length has several humps then and jumps where the back-step
fills the band, so it is looked at over the whole range.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import unlike
from gearlink.core.numerics.roots import bracketed_root, maximum, roots_on

_TURN = 2.0 * math.pi
_FIT = 1e-13
_ROUGH = 1e-9


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


class Valley(NamedTuple):
    """Part of the turn around the least speed: output angle, its rate, and the crank angles [rad] that bound the parts.

    first, second : phi(1), phi(2), or the minimum speed's place twice; low, high : the maximum speed's before and after
    mean : output revolutions per crank revolution, positive
    """

    angle: Callable[[float], float]
    speed: Callable[[float], float]
    first: float
    second: float
    low: float
    high: float
    mean: float

    def reach(self, level: float, left: float, right: float, rough: float = 0.0) -> float:
        """Crank angle between two others where the output passes a level, to the last bit or `rough` [rad]."""
        f_left, f_right = self.angle(left) - level, self.angle(right) - level
        if f_left * f_right >= 0.0:
            return left if abs(f_left) < abs(f_right) else right
        ends = f_left, f_right
        return bracketed_root(lambda phi: self.angle(phi) - level, left, right, tolerance=rough, ends=ends)

    def before(self, level: float, rough: float = 0.0) -> float:
        """Crank angle where the output last passes a level before its standstills."""
        beyond = level < self.angle(self.low)
        return self.reach(level, *((self.second - _TURN, self.low) if beyond else (self.low, self.first)), rough)

    def after(self, level: float, rough: float = 0.0) -> float:
        """Crank angle where the output first passes a level after its standstills."""
        beyond = level > self.angle(self.high)
        return self.reach(level, *((self.high, self.first + _TURN) if beyond else (self.second, self.high)), rough)


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
        return valley.speed(left + window) - valley.speed(left)

    if first >= last or (most := gain(last)) <= 0.0:
        left = last
    elif (least := gain(first)) >= 0.0:
        left = first
    else:
        left = bracketed_root(gain, first, last, ends=(least, most))
    return 0.5 * max(valley.angle(left + window) - valley.angle(left), top - bottom)


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
        return valley.angle(left + window) - valley.angle(left)

    ends = gain(first), gain(last)
    if valley.first == valley.second or ends[0] * ends[1] > 0.0:
        return None
    return bracketed_root(gain, first, last, ends=ends)


def longest_in_band(valley: Valley, tolerance: float, *, placed: bool = True) -> ToleranceDwell:
    """Longest crank interval over which the output stays within +- tol of a place that is free to choose.

    phi5(R) - phi5(L) = 2 tol  and  W(L) = W(R) >= 0,   both standstills between L and R;
    with a back-step D > 2 tol instead  phi5(L) = phi5(R) = phi5(1) - 2 tol  or  phi5(2) + 2 tol, the longer

    Parameters
        valley : Valley - of an output with at most one back-step a revolution
        tolerance : float [rad] - 0 < tol < pi times the mean ratio
        placed : bool - False where its length alone is wanted: it is at its maximum, so that a place to 1e-9 gives it
            to 1e-18
    Returns
        dwell : ToleranceDwell [rad]
    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole revolution lies within it
    Notes
        Bracketed roots inside a bracketed root; the angle rises outside of the standstills, and what the window leaves
        of the turn has one maximum speed. Where W(L) = W(R) cannot hold with both standstills inside, the end that
        binds is taken: of long windows with both ends beyond the maximum speed, too. At
        tol = D/2 and small back-steps the dwell is one third longer than phi13, which uses one side of the band.
    Example
        >>> eased = Valley(lambda x: x - math.sin(x), lambda x: 1.0 - math.cos(x), 0.0, 0.0, -math.pi, math.pi, 1.0)
        >>> round(longest_in_band(eased, math.pi / 2.0 - 1.0).crank_angle, 12)
        3.14159265359

    Source
        own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
    """
    limit = math.pi * valley.mean
    if not 0.0 < tolerance < limit:
        raise NoSolution(
            f"dwell tolerance: {unlike(math.degrees(tolerance), math.degrees(limit))} deg (above 0, below "
            f"{unlike(math.degrees(limit), math.degrees(tolerance))} deg, half of the output angle per revolution)"
        )
    drop = max(0.0, valley.angle(valley.first) - valley.angle(valley.second))
    # The longest interval jumps where the back-step just fits: a tolerance meant to fit it must not miss it by an ulp.
    if drop > 2.0 * tolerance * (1.0 + _FIT) + _FIT * limit:
        left, right, middle = _around_one_extreme(valley, tolerance)
    else:
        left, right, middle = _around_both(valley, tolerance, drop, 0.0 if placed else _ROUGH)
    start = left % _TURN % _TURN  # twice: a tiny negative angle is rounded up to a whole revolution by the first
    return ToleranceDwell(start, right - left, middle - valley.mean * (left - start))


def _around_both(valley: Valley, tolerance: float, drop: float, rough: float) -> tuple[float, float, float]:
    """Interval that holds both standstills; p is what the output rises from L to its place at phi(2)."""
    bottom = valley.angle(valley.second)
    spare = max(0.0, 2.0 * tolerance - drop)
    top, near = bottom + drop, rough * math.sqrt(spare)  # beside a standstill places go with the root of the angle

    def ends(p: float, near: float = 0.0) -> tuple[float, float]:
        return valley.before(bottom - p, near), valley.after(top + spare - p, near)

    def gain(p: float) -> float:
        left, right = ends(p, near)
        return valley.speed(right) - valley.speed(left)

    if (first := gain(0.0)) <= 0.0:
        p = 0.0
    elif (last := gain(spare)) >= 0.0:
        p = spare
    else:
        p = bracketed_root(gain, 0.0, spare, tolerance=rough * spare, ends=(first, last))
    left, right = ends(p)
    return left, right, bottom - p + tolerance


def _around_one_extreme(valley: Valley, tolerance: float) -> tuple[float, float, float]:
    """The longer of the intervals around the place of phi(1) and that of phi(2), for a back-step above 2 tol."""
    top, bottom = valley.angle(valley.first), valley.angle(valley.second)
    floor, ceiling = top - 2.0 * tolerance, bottom + 2.0 * tolerance
    before = (
        valley.reach(floor, valley.second - _TURN, valley.first),
        valley.reach(floor, valley.first, valley.second),
    )
    after = (
        valley.reach(ceiling, valley.first, valley.second),
        valley.reach(ceiling, valley.second, valley.first + _TURN),
    )
    if before[1] - before[0] >= after[1] - after[0]:
        return *before, floor + tolerance
    return *after, ceiling - tolerance


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
        return valley.angle(valley.first) - valley.angle(valley.second)

    def window(self, length: float, tolerance: float) -> float:
        """The longest crank angle [rad] within +- a tolerance [rad] at a length."""
        return longest_in_band(self.valley(length), tolerance, placed=False).crank_angle

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
