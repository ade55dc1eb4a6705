"""Refined extremes of a function over a turn or a stroke, with joints where its derivatives may jump."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.together import Function, Search, together

TURN = 2.0 * math.pi

_POINTS = 17
_UNIT = np.linspace(0.0, 1.0, _POINTS)
# Where a function maps its argument through a phase table, one ulp may not be enough to stay inside.
_INSIDE_ULPS = 16.0
_MOST_CANDIDATES = 16
# Samples of a bracket that differ by no more are rounding: another round gains 1/16 of it at a kink, less elsewhere.
_FLAT_ULPS = 16.0
_TURNS_OF_NOISE = 4
_END_SHARE = 2.0**-7  # of a step: where the samples fall from an end, little else than that end is left to see


@dataclass(frozen=True, slots=True)
class Extreme:
    """The value of an extreme and its place."""

    value: float
    place: float


def maximum_over(
    f: Function,
    start: float = 0.0,
    end: float = TURN,
    *,
    joints: Sequence[float] = (),
    samples: int = 2048,
    fewest: int = 33,
) -> Extreme:
    """Largest value of a function of arrays over an interval.

    Parameters
        f : function of a float64 array, returning one like it
        start, end : float - the interval, one turn by default
        joints : floats - places where the function or a derivative may jump; both one-sided values count
        samples : int - points over the interval; two humps closer than four steps may be taken for one
        fewest : int - points between two joints at least
    Returns
        extreme : Extreme - value and place
    Notes
        All segments between joints are sampled in one call of f, and all local maxima that could still be the
        largest are enlarged together, round the vertex of a parabola (64-fold) or, where that misses, between
        the neighbours (8-fold): exact to rounding at a smooth maximum (its place to about sqrt(eps)) and at a
        kink.
    Example
        >>> top = maximum_over(lambda x: np.cos(x - 1.0))
        >>> top.value, round(top.place, 6)
        (1.0, 1.0)
    """
    return together([f], [_maximum(start, end, joints, samples, fewest)])[0]


def extremes_over(
    wanted: Sequence[tuple[Function, bool]],
    start: float = 0.0,
    end: float = TURN,
    *,
    joints: Sequence[float] = (),
    samples: int = 2048,
    fewest: int = 33,
) -> list[Extreme]:
    """Extremes of several functions over the same interval, searched together.

    Parameters
        wanted : functions as of maximum_over, and whether the largest value of each is wanted or the smallest
        start, end, joints, samples, fewest : as of maximum_over
    Returns
        extremes : those that maximum_over and minimum_over give
    Notes
        Each function is asked where any search looks: what they share is computed once a round.
    Example
        >>> [round(each.value, 12) for each in extremes_over([(np.sin, True), (np.cos, False)])]
        [1.0, -1.0]
    """
    shared = {f: _once(f) for f, _ in wanted}
    functions = [shared[f] if greatest else _negative(shared[f]) for f, greatest in wanted]
    tops = together(functions, [_maximum(start, end, joints, samples, fewest) for _ in wanted])
    return [
        top if greatest else Extreme(0.0 - top.value, top.place)
        for top, (_, greatest) in zip(tops, wanted, strict=True)
    ]


def _once(f: Function) -> Function:
    """The function, its values kept as long as it is asked for the same array."""
    places: Reals | None = None
    values: Any = None

    def kept(x: Reals) -> Reals:
        nonlocal places, values
        if x is not places:
            places, values = x, f(x)
        found: Reals = values
        return found

    return kept


def _negative(f: Function) -> Function:
    return lambda x: -f(x)


def _maximum(start: float, end: float, joints: Sequence[float], samples: int, fewest: int) -> Search[Extreme]:
    """The search of maximum_over."""
    bounds = [start, *sorted(j for j in joints if start < j < end), end]
    grids = [
        _grid(left, right, max(fewest, math.ceil(samples * (right - left) / (end - start)) + 1))
        for left, right in pairwise(bounds)
    ]
    x = np.concatenate(grids)
    v = yield x
    ends = dict(_ends(grids, bounds))
    top = int(np.argmax(v))
    best = Extreme(float(v[top]), ends.get(top, float(x[top])))
    lefts, rights, offset = [], [], 0
    for grid in grids:
        part = v[offset : offset + grid.size]
        for i in _promising(part, best.value):
            lefts.append(float(grid[max(i - 1, 0)]))
            rights.append(float(grid[min(i + 1, grid.size - 1)]))
        offset += grid.size
    finest = 8.0 * math.ulp(max(abs(start), abs(end)))
    return (yield from _enlarged(np.array(lefts), np.array(rights), best, finest))


def minimum_over(
    f: Function,
    start: float = 0.0,
    end: float = TURN,
    *,
    joints: Sequence[float] = (),
    samples: int = 2048,
    fewest: int = 33,
) -> Extreme:
    """Smallest value of a function of arrays over an interval; see maximum_over.

    Example
        >>> minimum_over(lambda x: np.abs(x - 0.3), 0.0, 1.0)
        Extreme(value=0.0, place=0.3)
    """
    top = maximum_over(_negative(f), start, end, joints=joints, samples=samples, fewest=fewest)
    return Extreme(0.0 - top.value, top.place)


def largest_magnitude(
    f: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Largest |f| over an interval, with the sign of f kept: the largest pressure angle of a cam.

    Example
        >>> largest_magnitude(lambda x: np.sin(x) - 0.5).value
        -1.5
    """
    top, bottom = extremes_over([(f, True), (f, False)], start, end, joints=joints, samples=samples)
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
    return convex_radius(maximum_over(curvature, start, end, joints=joints, samples=samples))


def convex_radius(curvature: Extreme) -> Extreme:
    """The radius of a greatest curvature, inf where it is convex nowhere.

    Example
        >>> convex_radius(Extreme(0.025, 1.0))
        Extreme(value=40.0, place=1.0)
    """
    return Extreme(1.0 / curvature.value if curvature.value > 0.0 else math.inf, curvature.place)


def _grid(left: float, right: float, samples: int) -> Reals:
    inside = _INSIDE_ULPS * math.ulp(max(abs(left), abs(right)))
    return np.linspace(left + inside, right - inside, samples)


def _ends(grids: Sequence[Reals], bounds: Sequence[float]) -> Iterator[tuple[int, float]]:
    """Index of each segment's first and last sample in the whole, with the joint that it stands for."""
    offset = 0
    for grid, (left, right) in zip(grids, pairwise(bounds), strict=True):
        yield offset, left
        offset += grid.size
        yield offset - 1, right


def _promising(v: Reals, top: float) -> list[int]:
    """Samples of a segment that top their neighbours and whose parabola may reach above the best sample of all."""
    before, after = np.concatenate(([v[1]], v[:-1])), np.concatenate((v[1:], [v[-2]]))
    bend = np.abs(before - 2.0 * v + after)
    rounding = 8.0 * np.spacing(np.abs(v).max())
    chosen = (v >= before) & (v >= after) & (bend > rounding) & (v + bend >= top)
    order = np.flatnonzero(chosen)
    return [int(i) for i in order[np.argsort(-v[order])][:_MOST_CANDIDATES]]


def _enlarged(left: Reals, right: Reals, best: Extreme, finest: float) -> Search[Extreme]:
    """The largest value within any of the brackets, or `best` where none is larger; `finest` ends a bracket."""
    safe_left, safe_right = left, right
    while left.size:
        x = left[:, None] + (right - left)[:, None] * _UNIT
        v = (yield x.ravel()).reshape(x.shape)
        rows, i = np.arange(left.size), np.argmax(v, axis=1)
        peak, place = v[rows, i], x[rows, i]
        row = int(np.argmax(peak))
        if peak[row] > best.value:
            best = Extreme(float(peak[row]), float(place[row]))
        flat = peak - v.min(axis=1) <= _FLAT_ULPS * np.spacing(np.abs(peak))
        narrow = right - left <= finest
        missed = ((i == 0) & (left > safe_left)) | ((i == _POINTS - 1) & (right < safe_right))
        near = x[rows, np.maximum(i - 1, 0)], x[rows, np.minimum(i + 1, _POINTS - 1)]
        vertex, half = _vertex(x, v, i)
        next_left, next_right = np.maximum(vertex - half, near[0]), np.minimum(vertex + half, near[1])
        # A miss puts the true maximum between the bracket and the safe one: step back and take that whole.
        safe_left, safe_right = np.where(missed, safe_left, near[0]), np.where(missed, safe_right, near[1])
        left = np.where(missed, safe_left, next_left)
        right = np.where(missed, safe_right, next_right)
        going = ~(narrow | (flat & ~missed) | _is_noise(v))
        left, right, safe_left, safe_right = (a[going] for a in (left, right, safe_left, safe_right))
    return best


def _falls_from_its_end(v: Reals, i: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether the samples fall from the end of the bracket, without a vertex between the first two."""
    last = _POINTS - 1
    first_step = np.where(i == 0, v[:, 0] - v[:, 1], v[:, last] - v[:, last - 1])
    next_step = np.where(i == 0, v[:, 1] - v[:, 2], v[:, last - 1] - v[:, last - 2])
    falls: NDArray[np.bool_] = ((i == 0) | (i == last)) & (next_step > 0.0) & (2.0 * first_step > next_step)
    return falls


def _is_noise(v: Reals) -> NDArray[np.bool_]:
    """Whether the samples of a bracket go up and down too often for a function that the first samples resolved."""
    signs = np.sign(np.diff(v, axis=1))
    noise: NDArray[np.bool_] = np.count_nonzero(signs[:, :-1] * signs[:, 1:] < 0.0, axis=1) >= _TURNS_OF_NOISE
    return noise


def _vertex(x: Reals, v: Reals, i: NDArray[np.intp]) -> tuple[Reals, Reals]:
    """Vertex of the parabola through the largest sample and its neighbours, and half of the next bracket."""
    rows = np.arange(i.size)
    middle = np.clip(i, 1, _POINTS - 2)
    low, mid, high = v[rows, middle - 1], v[rows, middle], v[rows, middle + 1]
    bend = low - 2.0 * mid + high
    step = x[:, 1] - x[:, 0]
    interior = (i == middle) & (bend < 0.0)
    shift = np.divide(0.5 * (low - high), bend, out=np.zeros_like(bend), where=interior)
    half = np.where(interior, 0.125, np.where(_falls_from_its_end(v, i), _END_SHARE, 1.0)) * step
    return x[rows, i] + shift * step, half
