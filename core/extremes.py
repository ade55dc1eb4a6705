"""Refined extremes of a function over a turn or a stroke, with joints where its derivatives may jump."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

Reals: TypeAlias = NDArray[np.float64]
Function: TypeAlias = Callable[[Reals], Reals]

TURN = 2.0 * math.pi

_POINTS = 17
# Where a function maps its argument through a phase table, one ulp may not be enough to stay inside.
_INSIDE_ULPS = 16.0


@dataclass(frozen=True, slots=True)
class Extreme:
    """The value of an extreme and its place."""

    value: float
    place: float


def maximum_over(
    f: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Largest value of a function of arrays over an interval.

    Parameters
        f : function of a float64 array, returning one like it
        start, end : float - the interval, one turn by default
        joints : floats - places where the function or a derivative may jump; both one-sided values count
        samples : int - points over the interval (at least 33 between joints); two humps closer than four
            steps may be taken for one
    Returns
        extreme : Extreme - value and place
    Notes
        Each segment between joints is sampled, and every local maximum that could still be the largest is
        enlarged eightfold again and again: exact to rounding at a smooth maximum (its place to about
        sqrt(eps)) and at a kink.
    Example
        >>> top = maximum_over(lambda x: np.cos(x - 1.0))
        >>> top.value, round(top.place, 6)
        (1.0, 1.0)
    """
    bounds = [start, *sorted(j for j in joints if start < j < end), end]
    found = [
        _of_segment(f, left, right, max(33, math.ceil(samples * (right - left) / (end - start)) + 1))
        for left, right in pairwise(bounds)
    ]
    return max(found, key=lambda extreme: extreme.value)


def minimum_over(
    f: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Smallest value of a function of arrays over an interval; see maximum_over.

    Example
        >>> minimum_over(lambda x: np.abs(x - 0.3), 0.0, 1.0)
        Extreme(value=0.0, place=0.3)
    """
    top = maximum_over(lambda x: -f(x), start, end, joints=joints, samples=samples)
    return Extreme(0.0 - top.value, top.place)


def largest_magnitude(
    f: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Largest |f| over an interval, with the sign of f kept: the largest pressure angle of a cam.

    Example
        >>> largest_magnitude(lambda x: np.sin(x) - 0.5).value
        -1.5
    """
    top = maximum_over(f, start, end, joints=joints, samples=samples)
    bottom = minimum_over(f, start, end, joints=joints, samples=samples)
    return top if abs(top.value) >= abs(bottom.value) else bottom


def least_convex_radius(
    curvature: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Least convex radius of curvature, 1/max(kappa); inf where the curve is convex nowhere.

    Parameters
        curvature : function of cam angle - kappa [1/mm], convex positive (its negative for a groove's far flank)
        start, end, joints, samples : as of maximum_over
    Returns
        extreme : Extreme - radius [mm] and place: the profile is regular for every smaller roller
    Example
        >>> least_convex_radius(lambda phi: 0.02 + 0.005 * np.cos(phi)).value
        40.0

    Source
        own derivation: the profile's radius is rho - r_g
    """
    top = maximum_over(curvature, start, end, joints=joints, samples=samples)
    return Extreme(1.0 / top.value if top.value > 0.0 else math.inf, top.place)


def _of_segment(f: Function, left: float, right: float, samples: int) -> Extreme:
    inside = _INSIDE_ULPS * math.ulp(max(abs(left), abs(right)))
    x = np.linspace(left + inside, right - inside, samples)
    v = f(x)
    first = int(np.argmax(v))
    best = Extreme(float(v[first]), {0: left, samples - 1: right}.get(first, float(x[first])))
    candidates = [best, *(_enlarged(f, x, i) for i in _promising(v))]
    return max(candidates, key=lambda extreme: extreme.value)


def _promising(v: Reals) -> list[int]:
    """Samples that top their neighbours and whose parabola may reach above the best sample."""
    before, after = np.concatenate(([v[1]], v[:-1])), np.concatenate((v[1:], [v[-2]]))
    bend = np.abs(before - 2.0 * v + after)
    top = float(v.max())
    rounding = 8.0 * np.spacing(np.abs(v).max())
    chosen = (v >= before) & (v >= after) & (bend > rounding) & (v + bend >= top)
    order = np.flatnonzero(chosen)
    return [int(i) for i in order[np.argsort(-v[order])][:8]]


def _enlarged(f: Function, x: Reals, index: int) -> Extreme:
    left, right = float(x[max(index - 1, 0)]), float(x[min(index + 1, x.size - 1)])
    finest = 8.0 * math.ulp(max(abs(float(x[0])), abs(float(x[-1]))))
    best = Extreme(-math.inf, left)
    while True:
        fine = np.linspace(left, right, _POINTS)
        v = f(fine)
        i = int(np.argmax(v))
        if v[i] > best.value:
            best = Extreme(float(v[i]), float(fine[i]))
        flat = float(v[i] - v.min()) <= 2.0 * math.ulp(float(v[i]))
        if flat or right - left <= finest:
            return best
        left, right = float(fine[max(i - 1, 0)]), float(fine[min(i + 1, _POINTS - 1)])
