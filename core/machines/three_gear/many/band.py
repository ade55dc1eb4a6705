"""The longest dwell within a tolerance for arrays of three-gear four-bars, as `linkages.band_dwell` has it for one.

Inside the band both ends are found together, by Newton's method in two unknowns; where one end binds, and where the
back-step is wider than the band, by roots inside brackets. Each design rests by itself. The one has brackets inside a
bracket, whose steps multiply; the search therefore stands here again.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.machines.three_gear.many.general import Drives, output_angle, speed, wrapped
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.roots_sweep import bracketed_roots, newton_roots

_TURN = 2.0 * math.pi
_FIT = 1e-13
_LONGEST_STEP, _RESTS, _MOST_STEPS = 0.4, 1e-8, 40
_NEAR, _SLOW = 1e-9, 1e-5


class Valleys(NamedTuple):
    """Where outputs are slow, (N,) arrays [rad]: `Valley` of `linkages.band_dwell`, and where the speed is least."""

    drives: Drives
    first: Reals
    second: Reals
    least: Reals
    greatest: Reals
    tolerance: Reals

    def part(self, places: Any) -> Valleys:
        """Some of the designs."""
        return Valleys(self.drives.part(places), *(row[places] for row in self[1:]))


class Dwells(NamedTuple):
    """Start and length of the dwells [rad], whether the start is one of two as good, and whether a root is doubtful."""

    start: Reals
    crank_angle: Reals
    tied: Mask
    doubtful: Mask


def longest_in_band(valleys: Valleys) -> Dwells:
    """The longest crank interval over which each output stays within +- tol of a place that is free to choose.

    Parameters
        valleys : Valleys - tolerances below half of what the output gains in a turn
    """
    band = 2.0 * valleys.tolerance
    drop = _drop(valleys)
    wide = drop > band * (1.0 + _FIT)
    doubtful = np.asarray((drop > 0.0) & (np.abs(drop - band) <= _NEAR))
    left, right = np.full(drop.shape, np.nan), np.full(drop.shape, np.nan)
    tied = np.zeros(drop.shape, dtype=bool)
    for places, ends in ((np.flatnonzero(~wide), _around_both), (np.flatnonzero(wide), _around_one_extreme)):
        if places.size:
            left[places], right[places], mark = ends(valleys.part(places))
            (doubtful if ends is _around_both else tied)[places] |= mark
    slowest = np.minimum(np.abs(speed(left, valleys.drives)[0]), np.abs(speed(right, valleys.drives)[0]))
    return Dwells(wrapped(left), right - left, tied, doubtful | ~(slowest > _SLOW))


def _drop(valleys: Valleys) -> Reals:
    fall = output_angle(valleys.first, valleys.drives) - output_angle(valleys.second, valleys.drives)
    return np.where(valleys.second > valleys.first, fall, 0.0)


def _around_both(valleys: Valleys) -> tuple[Reals, Reals, Mask]:
    """Intervals that hold both standstills: ends of one speed, or one end that binds; and what did not settle."""
    drives, first, second = valleys.drives, valleys.first, valleys.second
    high = first + np.mod(valleys.greatest - first, _TURN)
    low = high - _TURN
    bottom, top = output_angle(second, drives), output_angle(first, drives)
    left, right, rests = _of_one_speed(valleys)
    inside = rests & (low <= left) & (left <= first) & (second <= right) & (right <= high)
    inside &= (output_angle(left, drives) <= bottom) & (output_angle(right, drives) >= top)
    places = np.flatnonzero(~inside)
    if places.size:
        part = valleys.part(places)
        left[places], right[places], inside[places] = _with_one_end(part, low[places], high[places])
    return left, right, ~inside


def _of_one_speed(valleys: Valleys) -> tuple[Reals, Reals, Mask]:
    """phi5(R) - phi5(L) = 2 tol, W(L) = W(R), from the cubic about the least speed."""
    drives, tolerance = valleys.drives, valleys.tolerance
    least, _, bend = speed(valleys.least, drives)
    reach = np.sqrt(np.maximum(-6.0 * least / bend, 0.0)) + np.cbrt(6.0 * tolerance / bend)
    for _ in range(4):
        reach = reach - (least * reach + bend * reach**3 / 6.0 - tolerance) / (least + 0.5 * bend * reach * reach)
    reach = np.where(reach > 0.0, np.minimum(reach, 0.5 * math.pi), 0.5 * math.pi)
    left, right = valleys.least - reach, valleys.least + reach
    rests = np.zeros(left.shape, dtype=bool)
    live: Any = np.arange(left.size)
    for _ in range(_MOST_STEPS):
        some, band = drives.part(live), 2.0 * tolerance[live]
        one, other = left[live], right[live]
        (w1, s1, _), (w2, s2, _) = speed(one, some), speed(other, some)
        missing, faster = output_angle(other, some) - output_angle(one, some) - band, w2 - w1
        whole = w2 * s1 - w1 * s2
        back, on = (w2 * faster - s2 * missing) / whole, (w1 * faster - s1 * missing) / whole
        # The steps of the search are held, no result.
        back, on = np.clip(back, -_LONGEST_STEP, _LONGEST_STEP), np.clip(on, -_LONGEST_STEP, _LONGEST_STEP)
        left[live], right[live] = one + back, other + on
        rest = (np.abs(back) <= _RESTS) & (np.abs(on) <= _RESTS)
        rests[live[rest]] = True
        live = live[~rest & np.isfinite(back) & np.isfinite(on)]
        if not live.size:
            break
    return left, right, rests


def _with_one_end(valleys: Valleys, low: Reals, high: Reals) -> tuple[Reals, Reals, Mask]:
    """One end as far as it may be where the speeds at both cannot be equal; else a root inside brackets of how far the
    output rises to its place at phi(2). And where that was found.
    """
    drives, second = valleys.drives, valleys.second
    bottom, top = output_angle(second, drives), output_angle(valleys.first, drives)
    spare = np.maximum(2.0 * valleys.tolerance - _drop(valleys), 0.0)
    least = np.maximum(spare - (output_angle(high, drives) - top), 0.0)
    most = np.minimum(spare, bottom - output_angle(low, drives))
    one, other = _ends(least, valleys, low, high), _ends(most, valleys, low, high)
    early, late = one[2] <= 0.0, other[2] >= 0.0
    rise = np.where(early, least, most)
    between = np.flatnonzero(~early & ~late)
    if between.size:
        some = valleys.part(between), low[between], high[between]
        rise[between] = bracketed_roots(lambda x: _ends(x, *some)[2], least[between], most[between])
    left, right, _ = _ends(rise, valleys, low, high)
    return left, right, np.isfinite(rise)


def _ends(rise: Reals, valleys: Valleys, low: Reals, high: Reals) -> tuple[Reals, Reals, Reals]:
    """Both ends of the interval that begins so far below the output's place at phi(2), and the gain of speed in it."""
    drives, first, second = valleys.drives, valleys.first, valleys.second
    start = output_angle(second, drives) - rise
    left = _reach(drives, start, low, first)
    right = _reach(drives, start + 2.0 * valleys.tolerance, second, high)
    return left, right, speed(right, drives)[0] - speed(left, drives)[0]


def _around_one_extreme(valleys: Valleys) -> tuple[Reals, Reals, Mask]:
    """The longer of the intervals around phi(1) and phi(2), of back-steps above 2 tol; and where both are as long."""
    drives, first, second = valleys.drives, valleys.first, valleys.second
    floor = output_angle(first, drives) - 2.0 * valleys.tolerance
    ceiling = output_angle(second, drives) + 2.0 * valleys.tolerance
    before = _reach(drives, floor, second - _TURN, first), _reach(drives, floor, first, second, -1.0)
    after = _reach(drives, ceiling, first, second, -1.0), _reach(drives, ceiling, second, first + _TURN)
    gained = (before[1] - before[0]) - (after[1] - after[0])
    earlier = gained >= 0.0
    left, right = np.where(earlier, before[0], after[0]), np.where(earlier, before[1], after[1])
    return left, right, np.abs(gained) <= _NEAR


def _reach(drives: Drives, level: Reals, left: Reals, right: Reals, sign: float = 1.0) -> Reals:
    """Crank angles between two others at which rising (sign 1) or falling outputs pass a level; else the nearer end."""

    def above(x: Reals, level: Reals, *rows: Reals) -> tuple[Reals, Reals]:
        some = Drives(*rows)
        return sign * (output_angle(x, some) - level), sign * speed(x, some)[0]

    at_left, at_right = above(left, level, *drives)[0], above(right, level, *drives)[0]
    found = newton_roots(above, left, right, 0.5 * (left + right), level, *drives)
    return np.where(at_left >= 0.0, left, np.where(at_right <= 0.0, right, found))
