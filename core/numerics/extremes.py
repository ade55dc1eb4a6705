"""Refined extremes of a function over a revolution or a stroke, with joints where its derivatives may jump."""

from __future__ import annotations

import math
from collections.abc import Generator, Iterable, Sequence
from functools import lru_cache
from itertools import pairwise
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals, distinct
from gearlink.core.numerics.together import Function, values_of

POINTS = 17
"""Samples of a bracket."""
_AROUND = np.arange(-3, 4)
_NEWTON = 3
_WIDE, _NARROW = 0.125, 2.0**-10  # of a step: half of the next bracket round a vertex, at most and at least
_END_SHARE = 2.0**-7  # of a step: where the samples fall from an end, little else than that end is left to see
_SURE_ULPS = 32.0
_JUMPS = 16.0
_TURNS_OF_NOISE = 4


def vertex_of(x: Reals, v: Reals, i: NDArray[np.intp]) -> tuple[Reals, Reals]:
    """Where the maximum of a bracket lies by its largest samples, and half of the next bracket.

    Parameters
        x, v : (N, POINTS) arrays - places of the samples, evenly spaced, and values
        i : (N,) array of int - the largest sample of each
    Returns
        vertex, half : (N,) arrays - place, and half the width of the next bracket
    Notes
        The vertex of the parabola through three samples, and that of the quartic through five where these are at hand:
        the latter's error is far below the way between both, a quarter of which serves as the next bracket, or what
        rounding moves it by. At a kink, where the lines from both sides meet; at a jump, between the samples beside it.
    """
    rows = np.arange(i.size)
    middle = np.minimum(np.maximum(i, 1), POINTS - 2)
    low, mid, high = v[rows, middle - 1], v[rows, middle], v[rows, middle + 1]
    step = x[:, 1] - x[:, 0]
    with np.errstate(all="ignore"):  # what is infinite is enlarged as a parabola, what is none told by its distance
        bend = low - 2.0 * mid + high
        interior = (i == middle) & (bend < 0.0)
        shift = np.divide(0.5 * (low - high), bend, out=np.zeros_like(bend), where=interior)
        if interior.all():
            half = np.full(i.size, _WIDE)
        else:
            half = np.where(interior, _WIDE, np.where(_falls_from_its_end(v, i), _END_SHARE, 1.0))
        inside = (interior & (i >= 3) & (i <= POINTS - 4)).nonzero()[0]
        if inside.size:
            _sharpen(v[inside], i[inside], -bend[inside], inside, shift, half)
        jump, at = _jump(v)
    if jump.any():
        beside = jump & ((at == i) | (at == i - 1))
        shift, half = np.where(beside, at - i + 0.5, shift), np.where(beside, 0.5, half)
    return x[rows, i] + shift * step, half * step


def _sharpen(v: Reals, i: NDArray[np.intp], bend: Reals, inside: NDArray[np.intp], shift: Reals, half: Reals) -> None:
    """Put the vertex of the quartic, or the crossing of lines, with its reach, where that is less than `half`."""
    samples = v[np.arange(i.size)[:, None], i[:, None] + _AROUND]
    before = shift[inside]
    better, crossing = _quartic_shift(samples[:, 1:-1], before), _crossing(samples)
    noise = v
    for _ in range(6):
        noise = noise[:, 1:] - noise[:, :-1]
    left = np.maximum.reduce(np.abs(noise), axis=1) / bend  # of what no smooth curve leaves
    least = np.fmax(_SURE_ULPS * np.spacing(np.abs(samples[:, 3])) / bend, _NARROW)
    for place, reach in ((better, np.fmax(0.25 * np.abs(better - before), left)), crossing):
        reach = np.fmax(reach, least)
        close = reach < half[inside]
        shift[inside[close]], half[inside[close]] = place[close], reach[close]


def _quartic_shift(v: Reals, shift: Reals) -> Reals:
    """Vertex of the quartic through five samples a row, in steps from the middle one, from that of the parabola on."""
    far, near = v[:, 4] - v[:, 0], v[:, 3] - v[:, 1]
    far_sum, near_sum = v[:, 4] + v[:, 0] - 2.0 * v[:, 2], v[:, 3] + v[:, 1] - 2.0 * v[:, 2]
    a, b = (8.0 * near - far) / 12.0, (16.0 * near_sum - far_sum) / 12.0
    c, d = (far - 2.0 * near) / 4.0, (far_sum - 4.0 * near_sum) / 6.0
    c2, d3 = 2.0 * c, 3.0 * d
    for _ in range(_NEWTON):
        shift = shift - (a + shift * (b + shift * (c + shift * d))) / (b + shift * (c2 + shift * d3))
    return shift


def _crossing(v: Reals) -> tuple[Reals, Reals]:
    """Where the lines from both sides meet, by seven samples a row, in steps from the middle one, and its error."""
    before, after = v[:, 2] - v[:, 1], v[:, 5] - v[:, 4]
    bends = np.abs(before - v[:, 1] + v[:, 0]) + np.abs(v[:, 6] - v[:, 5] - after)
    apart = before - after  # 0 of lines that are one and do not meet
    place = (v[:, 4] - v[:, 2] - before - after) / apart
    return place, np.where(np.abs(place) <= 1.0, 4.0 * bends / np.abs(apart), 1.0)


def _jump(v: Reals) -> tuple[NDArray[np.bool_], NDArray[np.intp]]:
    """Whether a function jumps within a bracket, and after which sample: there it moves far more than anywhere else."""
    steps = np.abs(v[:, 1:] - v[:, :-1])
    two = np.partition(steps, -2, axis=1)
    jumps: NDArray[np.bool_] = two[:, -1] > _JUMPS * two[:, -2]
    return jumps, steps.argmax(axis=1)


def _falls_from_its_end(v: Reals, i: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether the samples fall from the end of the bracket, without a vertex between the first two."""
    last = POINTS - 1
    first_step = np.where(i == 0, v[:, 0] - v[:, 1], v[:, last] - v[:, last - 1])
    next_step = np.where(i == 0, v[:, 1] - v[:, 2], v[:, last - 1] - v[:, last - 2])
    falls: NDArray[np.bool_] = ((i == 0) | (i == last)) & (next_step > 0.0) & (2.0 * first_step > next_step)
    return falls


def is_level(v: Reals, i: NDArray[np.intp]) -> NDArray[np.bool_]:
    """Whether the largest sample is the first of three or more alike: the edge of what is cut off at a level."""
    rows, first = np.arange(i.size), np.minimum(i, POINTS - 3)
    level: NDArray[np.bool_] = (v[rows, first + 1] == v[rows, first]) & (v[rows, first + 2] == v[rows, first])
    level &= first == i
    return level


def is_noise(v: Reals) -> NDArray[np.bool_]:
    """Whether the samples of a bracket go up and down too often for a function that the first samples resolved."""
    with np.errstate(invalid="ignore"):  # between infinite samples
        signs = np.sign(v[:, 1:] - v[:, :-1])
    noise: NDArray[np.bool_] = np.add.reduce(signs[:, :-1] * signs[:, 1:] < 0.0, axis=1) >= _TURNS_OF_NOISE
    return noise


TURN = 2.0 * math.pi

_UNIT = np.linspace(0.0, 1.0, POINTS)
# Where a function maps its argument through a phase table, one ulp may not be enough to stay inside.
_INSIDE_ULPS = 16.0
_MOST_CANDIDATES = 16
# Samples of a bracket that differ by no more are rounding: another round gains 1/16 of it at a kink, less elsewhere.
_FLAT_ULPS = 16.0
_NOTHING = 1e-22  # of the maximum magnitude, by which samples may differ that touch 0


class Extreme(NamedTuple):
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
        f : function of a float64 array, returning one like it; or a row for each of N functions that are sought
            together, of (M,) places for all of them, and of (N, M) places, a row for each
        start, end : float - the interval, one revolution by default; (N, 1) array of N functions that have their own
        joints : floats - places where the function or a derivative may jump; both one-sided values count; (N, 1)
            arrays where each of N functions has its own, all of them within the interval
        samples : int - points over the interval; two humps closer than four steps may be taken for one
        fewest : int - points between two joints at least
    Returns
        extreme : Extreme - value and place; of N functions (N, 1) arrays
    Notes
        All segments between joints are sampled in one call of f, and all local maxima that could still be the
        largest are enlarged together, round the vertex of a quartic (up to 8192-fold) or a parabola (64-fold) or, where
        that misses, between the neighbours (8-fold): exact to rounding at a smooth maximum (its place to about
        sqrt(eps)) and at a kink. An end or joint that is as good as a place beside it, within 16 ulp, is the place.
    Example
        >>> top = maximum_over(lambda x: np.cos(x - 1.0))
        >>> top.value, round(top.place, 6)
        (1.0, 1.0)
    """
    return extremes_over([(f, True)], start, end, joints=joints, samples=samples, fewest=fewest)[0]


def _extremes_of_rows(wanted: Sequence[tuple[Function, bool]], values: Sequence[Reals], grid: _Grid) -> list[Extreme]:
    """The searches of extremes_over for each row of what functions give; values and places are columns.

    Parameters
        values : of the functions on the grid, a row for each of N or one for all
    Notes
        In every round all functions are asked at the very same array, which has as many places in each row.
    """
    rows, count = max(len(v) for v in values if v.ndim > 1), len(wanted)
    signs = np.array([1.0 if greatest else -1.0 for _, greatest in wanted])
    v = np.stack([np.broadcast_to(each, (rows, each.shape[-1])) for each in values], axis=1) * signs[:, None]
    search = _maxima(rows * count, grid, np.repeat(np.arange(rows), count))
    next(search)
    try:
        asked = search.send(v.reshape(rows * count, -1))
        while True:
            row, number = np.divmod(asked.of, count)
            within = np.arange(row.size) - np.searchsorted(row, row)
            places = np.empty((rows, int(within.max()) + 1, POINTS))
            places[:] = grid.x[..., :1, None]  # where a row has fewer
            places[row, within] = asked.places
            found = _values_of_rows([f for f, _ in wanted], places, number, row, within)
            asked = search.send(found * signs[number, None])
    except StopIteration as end:
        tops = np.array(end.value).reshape(rows, count, 2)
    least = signs < 0.0
    tops[:, least, 0] = 0.0 - tops[:, least, 0]
    return [Extreme(tops[:, i, :1], tops[:, i, 1:]) for i in range(count)]  # type: ignore[arg-type]


def _values_of_rows(
    functions: Sequence[Function], places: Reals, number: NDArray[np.intp], *at: NDArray[np.intp]
) -> Reals:
    """Values in brackets, of the function with the number of each."""
    flat, found = places.reshape(len(places), -1), np.empty((number.size, POINTS))
    values: dict[Function, Reals] = {}
    for k in distinct(number).tolist():
        f, own = functions[k], number == k
        if f not in values:
            values[f] = np.broadcast_to(f(flat), flat.shape).reshape(places.shape)
        found[own] = values[f][tuple(each[own] for each in at)]
    return found


def larger(one: Extreme, other: Extreme) -> Extreme:
    """The one of larger magnitude, of equal ones the first; of many, row by row.

    Example
        >>> larger(Extreme(2.0, 0.5), Extreme(-3.0, 1.0))
        Extreme(value=-3.0, place=1.0)
    """
    if not isinstance(one.value, np.ndarray):
        return max(one, other, key=lambda each: abs(each.value))
    first = np.abs(one.value) >= np.abs(other.value)
    return Extreme(*(np.where(first, *both) for both in zip(one, other, strict=True)))


def least_of(found: Extreme, values: Reals, places: Reals) -> Extreme:
    """The least of an extreme and values at some places, of equal ones that at the lower place; of many, row by row.

    Parameters
        found : Extreme - of N functions with columns
        values, places : arrays with a row for each, or one row for all
    Example
        >>> least_of(Extreme(2.0, 0.5), np.array([[1.0, 2.0]]), np.array([[0.0, 1.0]]))
        Extreme(value=1.0, place=0.0)
    """
    rows = max(np.size(found.value), len(values))
    every, seats = (
        np.hstack([np.broadcast_to(np.reshape(one, (-1, 1)), (rows, 1)), np.broadcast_to(more, (rows, more.shape[1]))])
        for one, more in zip(found, (values, places), strict=True)
    )
    least: Any = every.min(axis=1, keepdims=True)
    place: Any = np.where(every == least, seats, np.inf).min(axis=1, keepdims=True)
    return Extreme(least, place) if rows > 1 else Extreme(float(least[0, 0]), float(place[0, 0]))


def greatest(values: Sequence[float]) -> float:
    """The greatest of some extremes' values, of those of N functions row by row."""
    if all(isinstance(value, float) for value in values):
        return max(values)
    return np.maximum.reduce(np.broadcast_arrays(*values))  # type: ignore[no-any-return]


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
        extremes : those that maximum_over and minimum_over give, of functions with rows as well
    Notes
        Each function is asked where any search looks: what they share is computed once a round.
    Example
        >>> [round(each.value, 12) for each in extremes_over([(np.sin, True), (np.cos, False)])]
        [1.0, -1.0]
    """
    return extremes_of_parts(wanted, [(start, end)], joints=joints, samples=samples, fewest=fewest)[0]


def places_over(
    start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048, fewest: int = 33
) -> Reals:
    """The places at which the searches of extremes_over begin.

    Example
        >>> [round(float(place), 6) for place in places_over(0.0, 1.0, samples=2, fewest=3)]
        [0.0, 0.5, 1.0]
    """
    return _grid_of(start, end, joints, samples, fewest).x


def extremes_of_parts(
    wanted: Sequence[tuple[Function, bool]],
    parts: Sequence[tuple[float, float]],
    *,
    joints: Sequence[float] = (),
    samples: int = 2048,
    fewest: int = 33,
    sought: Sequence[Sequence[int]] = (),
) -> list[list[Extreme]]:
    """Extremes of several functions over each of several intervals, searched together.

    Parameters
        wanted, joints, samples, fewest : as of extremes_over; samples are those of each interval
        parts : (start, end) of the intervals
        sought : of each interval the numbers of those that are wanted there; all where it is left out
    Returns
        extremes : those of extremes_over for each interval
    Example
        >>> found = extremes_of_parts([(np.sin, True)], [(0.0, 2.0), (4.0, 7.0)])
        >>> [round(each.value, 6) for (each,) in found]
        [1.0, 0.656987]
    """
    if not wanted:
        return [[] for _ in parts]
    signs = [1.0 if greatest else -1.0 for _, greatest in wanted]
    functions = list(dict.fromkeys(f for f, _ in wanted))
    of = [functions.index(f) for f, _ in wanted]
    some = sought or [range(len(wanted))] * len(parts)

    def answer(number: int, asked: _Asked, values: dict[int, Reals], rows: slice) -> Reals:
        if asked.places.ndim == 1:
            return np.array([values[of[k]][rows] * signs[k] for k in some[number]])
        found = np.empty(asked.places.shape)
        for search, part in _parts(asked.of):
            k = some[number][search]
            np.multiply(values[of[k]][rows].reshape(found.shape)[part], signs[k], out=found[part])
        return found

    grids = [_grid_of(start, end, joints, samples, fewest) for start, end in parts]
    searches = [_maxima(len(numbers), grid) for numbers, grid in zip(some, grids, strict=True)]
    asked = dict(enumerate(map(next, searches)))
    tops: list[list[Extreme]] = [[]] * len(parts)
    while asked:
        rounds = list(asked.items())
        wanted_now = list(dict.fromkeys(of[some[k][i]] for k, each in rounds for i in distinct(each.of).tolist()))
        values = dict(zip(wanted_now, _at_once([functions[k] for k in wanted_now], asked.values()), strict=True))
        if any(v.ndim > 1 for v in values.values()):  # a row for each of many, on the grids
            ends = np.cumsum([grid.x.shape[-1] for grid in grids]).tolist()
            spans = [slice(end - grid.x.shape[-1], end) for grid, end in zip(grids, ends, strict=True)]
            return [
                _extremes_of_rows([wanted[k] for k in numbers], [values[of[k]][..., span] for k in numbers], grid)
                for numbers, grid, span in zip(some, grids, spans, strict=True)
            ]
        first = 0
        for number, each in rounds:
            rows = slice(first, first := first + each.places.size)
            try:
                asked[number] = searches[number].send(answer(number, each, values, rows))
            except StopIteration as found:
                tops[number] = found.value
                del asked[number]
    return [
        [top if signs[k] > 0.0 else Extreme(0.0 - top.value, top.place) for top, k in zip(found, numbers, strict=True)]
        for found, numbers in zip(tops, some, strict=True)
    ]


def _at_once(functions: Sequence[Function], asked: Iterable[_Asked]) -> list[Reals]:
    """Values of functions at all places that are asked; a grid is handed on as it is, since what is shared is kept."""
    places = [each.places if each.is_grid else each.places.ravel() for each in asked]
    flat = places[0] if len(places) == 1 else np.concatenate(places, axis=-1)
    return values_of(functions, flat) if flat.ndim == 1 else [f(flat) for f in functions]


def share_of(place: Reals, width: float | Reals) -> Reals:
    """Fractions of an interval that begins at 0 and has a width; those beside an end, as the searches keep within it,
    and beyond it by rounding are the end.

    For what is known at the ends themselves: a search would give 1e-14 where it is 0 there.

    Example
        >>> share_of(np.array([7e-15, 1.0, 2.0 - 7e-15, 2.0 + 7e-15]), 2.0).tolist()
        [0.0, 0.5, 1.0, 1.0]
    """
    share = np.clip(place / width, 0.0, 1.0)
    inside = _INSIDE_ULPS * math.ulp(1.0)
    share[share <= inside] = 0.0
    share[share >= 1.0 - inside] = 1.0
    return share


class _Asked(NamedTuple):
    """Places of a round: those of the grid, for every search, or (brackets, points), and the search of each bracket."""

    places: Reals
    of: NDArray[np.intp]
    is_grid: bool = False


def _maxima(count: int, grid: _Grid, rows: NDArray[np.intp] | None = None) -> Generator[_Asked, Reals, list[Extreme]]:
    """Searches of maximum_over over one interval, all in the same arrays; their values are sent as rows.

    Parameters
        rows : (count,) array - row of the grid of each search, if it has rows
    """
    v = yield _Asked(grid.x, np.arange(count), is_grid=True)
    tops = np.argmax(v, axis=1)
    best = list(map(Extreme, v[np.arange(count), tops].tolist(), grid.at(grid.bounded, rows, tops).tolist()))
    of, places = _promising(v, np.array([[top.value] for top in best]), grid)
    row = None if rows is None else rows[of]
    nothing = _NOTHING * np.max(np.abs(v), axis=1, where=np.isfinite(v), initial=0.0)
    left, right = grid.at(grid.left, row, places), grid.at(grid.right, row, places)
    yield from _enlarged(of, left, right, best, grid.finest, nothing)
    return _at_ends(best, v, grid, rows, nothing)


def minimum_over(
    f: Function, start: float = 0.0, end: float = TURN, *, joints: Sequence[float] = (), samples: int = 2048
) -> Extreme:
    """Smallest value of a function of arrays over an interval; see maximum_over.

    Example
        >>> minimum_over(lambda x: np.abs(x - 0.3), 0.0, 1.0)
        Extreme(value=0.0, place=0.3)
    """
    return extremes_over([(f, False)], start, end, joints=joints, samples=samples)[0]


def least_convex_radius(curvature: Function, *, joints: Sequence[float] = (), samples: int = 2048) -> Extreme:
    """Minimum convex radius of curvature of a closed curve, 1/max(kappa); inf where it is convex nowhere.

    Parameters
        curvature : function of cam angle - kappa [1/mm], convex positive (its negative for a groove's far flank)
        joints, samples : as of maximum_over
    Returns
        extreme : Extreme - radius [mm] and place: the profile is regular for every smaller roller
    Example
        >>> least_convex_radius(lambda phi: 0.02 + 0.005 * np.cos(phi)).value
        40.0

    Source
        own derivation: the profile's radius is rho - r_g
    """
    return convex_radius(maximum_over(curvature, joints=joints, samples=samples))


def convex_radius(curvature: Extreme) -> Extreme:
    """The radius of a maximum curvature, inf where it is convex nowhere.

    Example
        >>> convex_radius(Extreme(0.025, 1.0))
        Extreme(value=40.0, place=1.0)
    """
    bend = curvature.value
    if isinstance(bend, np.ndarray):
        radius = np.divide(1.0, bend, out=np.full_like(bend, math.inf), where=bend > 0.0)
        return Extreme(radius, curvature.place)
    return Extreme(1.0 / bend if bend > 0.0 else math.inf, curvature.place)


class _Grid(NamedTuple):
    """The samples between all joints.

    Fields
        x : (N,) array, or rows of such where joints are not the same for all
        bounded : as x, with the joints themselves instead of the first and last sample of each segment
        segment : (N,) array - of each sample; `first` holds the index of each segment's first
        before, after : (N,) arrays - index of the neighbours; at an end of a segment the one within it twice
        left, right : as x - places of the neighbours; at an end of a segment that end
        is_end : (N + 2,) array - whether a sample stands for a joint; for none before the first and after the last
        finest : float - width of a bracket that is not divided again
    """

    x: Reals
    bounded: Reals
    segment: NDArray[np.intp]
    first: NDArray[np.intp]
    before: NDArray[np.intp]
    after: NDArray[np.intp]
    left: Reals
    right: Reals
    is_end: NDArray[np.bool_]
    finest: float

    def at(self, values: Reals, rows: NDArray[np.intp] | None, index: NDArray[np.intp]) -> Reals:
        """Values of samples, in the rows where the grid has rows."""
        return values[index] if values.ndim == 1 else values[rows, index]

    def after_of(self, places: Reals, rows: NDArray[np.intp] | None) -> NDArray[np.intp]:
        """Index of the first sample that is not before a place."""
        if self.x.ndim == 1:
            found: NDArray[np.intp] = self.x.searchsorted(places)
            return found
        return np.asarray(np.add.reduce(self.x[rows] < places[:, None], axis=1, dtype=np.intp))


def _grid_of(
    start: float | Reals, end: float | Reals, joints: Sequence[float | Reals], samples: int, fewest: int
) -> _Grid:
    """The grid of an interval; one with rows where something is a column."""
    if not any(isinstance(bound, np.ndarray) for bound in (start, end, *joints)):
        return _grid(start, end, tuple(joints), samples, fewest)  # type: ignore[arg-type]
    inside = [joint for joint in joints if np.all((joint > start) & (joint < end))]
    bounds = np.hstack(np.broadcast_arrays(*(np.reshape(bound, (-1, 1)) for bound in (start, *inside, end))))
    bounds.sort(axis=1)
    shares = (bounds[:, 1:] - bounds[:, :-1]) / (bounds[:, -1:] - bounds[:, :1])
    counts = np.maximum(fewest, np.ceil(samples * shares.max(axis=0)).astype(int) + 1).tolist()
    parts = [_samples(*ends, count) for ends, count in zip(pairwise(bounds.T), counts, strict=True)]
    return _grid_from(bounds, parts)


@lru_cache(maxsize=32)
def _grid(start: float, end: float, joints: tuple[float, ...], samples: int, fewest: int) -> _Grid:
    """Kept, since designs of a study share it; that nobody writes to it is made sure of."""
    bounds = [start, *sorted(j for j in joints if start < j < end), end]
    parts = [
        _samples(left, right, max(fewest, math.ceil(samples * (right - left) / (end - start)) + 1))
        for left, right in pairwise(bounds)
    ]
    return _grid_from(np.array(bounds), parts)


def _grid_from(bounds: Reals, parts: Sequence[Reals]) -> _Grid:
    """The grid of samples between bounds, (K,) and (K - 1) arrays, or rows of such."""
    sizes = [part.shape[-1] for part in parts]
    last = np.cumsum(sizes) - 1
    first = last + 1 - np.array(sizes)
    x, index = np.concatenate(parts, axis=-1), np.arange(sum(sizes))
    bounded = x.copy()
    bounded[..., first], bounded[..., last] = bounds[..., :-1], bounds[..., 1:]
    x.flags.writeable = False
    before, after = index - 1, index + 1
    left, right = before.copy(), after.copy()
    before[first], after[last], left[first], right[last] = first + 1, last - 1, first, last
    is_end = np.zeros(index.size + 2, dtype=bool)
    is_end[first + 1] = is_end[last + 1] = True
    finest = 8.0 * float(np.spacing(np.abs(bounds).max()))
    segment = np.repeat(np.arange(len(parts)), sizes)
    return _Grid(x, bounded, segment, first, before, after, x[..., left], x[..., right], is_end, finest)


def _samples(left: float | Reals, right: float | Reals, samples: int) -> Reals:
    inside = _INSIDE_ULPS * np.spacing(np.maximum(np.abs(left), np.abs(right)))
    return np.linspace(left + inside, right - inside, samples, axis=-1)


def _promising(v: Reals, tops: Reals, grid: _Grid) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Samples of a segment that top their neighbours and whose parabola may reach above the best sample of all.

    Returns
        of, places : arrays - the search and the sample, those of a segment from the highest down
    """
    before, after = v[:, grid.before], v[:, grid.after]
    bend = np.abs(before - 2.0 * v + after)
    rounding = 8.0 * np.spacing(np.maximum.reduceat(np.abs(v), grid.first, axis=1))
    chosen = (v >= before) & (v >= after) & (bend > rounding[:, grid.segment]) & (v + bend >= tops)
    of, places = np.nonzero(chosen)
    group = of * grid.first.size + grid.segment[places]
    if not (group[1:] == group[:-1]).any():
        return of, places
    edges = [0, *(np.flatnonzero(np.diff(group)) + 1).tolist(), group.size]
    kept = [low + np.argsort(-v[of[low:high], places[low:high]])[:_MOST_CANDIDATES] for low, high in pairwise(edges)]
    order = np.concatenate(kept)
    return of[order], places[order]


def _enlarged(
    of: NDArray[np.intp], left: Reals, right: Reals, best: list[Extreme], finest: float, nothing: Reals
) -> Generator[_Asked, Reals, None]:
    """Put the largest values within any of the brackets instead of `best` of their searches, where they are larger.

    Parameters
        of : the search of each bracket, ascending
        left, right : the brackets
        best : by search
        finest : ends a bracket
        nothing : by search - what its samples may differ by and count as alike
    """
    safe_left, safe_right = left, right
    while left.size:
        x = left[:, None] + (right - left)[:, None] * _UNIT
        v = yield _Asked(x, of)
        rows, i = np.arange(left.size), v.argmax(axis=1)
        peak, place = v[rows, i], x[rows, i]
        for search, value, where in zip(of.tolist(), peak.tolist(), place.tolist(), strict=True):
            if value > best[search].value:
                best[search] = Extreme(value, where)
        spread = peak - v.min(axis=1)
        flat = (spread <= np.fmax(_FLAT_ULPS * np.spacing(np.abs(peak)), nothing[of])) | is_level(v, i)
        low = peak + spread < np.array([top.value for top in best])[of]
        narrow = right - left <= finest
        missed = ((i == 0) & (left > safe_left)) | ((i == POINTS - 1) & (right < safe_right))
        going = (missed | ~(narrow | flat | low | is_noise(v))) & np.isfinite(peak)  # nothing is above inf
        if not going.all():
            if not going.any():
                return
            of, left, right, safe_left, safe_right = (a[going] for a in (of, left, right, safe_left, safe_right))
            x, v, i, missed, rows = x[going], v[going], i[going], missed[going], rows[: left.size]
        near = x[rows, np.maximum(i - 1, 0)], x[rows, np.minimum(i + 1, POINTS - 1)]
        vertex, half = vertex_of(x, v, i)
        next_left, next_right = np.maximum(vertex - half, near[0]), np.minimum(vertex + half, near[1])
        if missed.any():
            # A miss puts the true maximum between the bracket and the safe one: step back and take that whole.
            safe_left, safe_right = np.where(missed, safe_left, near[0]), np.where(missed, safe_right, near[1])
            left = np.where(missed, safe_left, next_left)
            right = np.where(missed, safe_right, next_right)
        else:
            (safe_left, safe_right), left, right = near, next_left, next_right


def _at_ends(
    best: Sequence[Extreme], v: Reals, grid: _Grid, rows: NDArray[np.intp] | None, nothing: Reals
) -> list[Extreme]:
    """The extremes at the end of their segment, where they lie beside it and the end is as good but for rounding.

    Where a function rises towards the end, the value some ulps before it may be rounded up and that at the end down.
    Such a place is off by rounding over the slope; the drive angle of a stroke that comes to rest at its end is then
    off by the square root of that, or more.
    """
    found = list(best)
    after = grid.after_of(np.array([top.place for top in best]), rows)
    beside = grid.is_end[after] | grid.is_end[after + 1]
    for search in np.flatnonzero(beside).tolist():
        top, k = best[search], int(after[search])
        least = top.value - max(_FLAT_ULPS * math.ulp(top.value), float(nothing[search]))
        ends = [i for i in (k - 1, k) if grid.is_end[i + 1] and v[search, i] >= least]
        if ends:
            at = np.array(max(ends, key=v[search].__getitem__))
            row = None if rows is None else rows[search]
            found[search] = Extreme(top.value, float(grid.at(grid.bounded, row, at)))
    return found


def _parts(of: NDArray[np.intp]) -> list[tuple[int, slice]]:
    """Each search with the slice of its brackets."""
    edges = [0, *(np.flatnonzero(of[1:] != of[:-1]) + 1).tolist(), of.size]
    return [(int(of[low]), slice(low, high)) for low, high in pairwise(edges)]
