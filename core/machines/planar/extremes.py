"""Maximum and minimum values of what a planar mechanism moves, and of its derivatives, over its period or range.

Rows of a grid bracket the zeros of the next derivative; Newton's steps with that and the one after it find them, all
places of all courses together.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from typing import Any, NamedTuple, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.machines.planar.course import Course
from gearlink.core.machines.planar.system import Jets
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.roots_sweep import newton_roots
from gearlink.core.numerics.together import kept_last

Coefficient: TypeAlias = Callable[[Jets, int], Reals]
_NOISE = 1e-11  # of the size of a course and its lower derivatives: what is below stands still
_EQUAL = 1e-10
_AT_END = 1e-9  # of the period


class Pair(NamedTuple):
    """The maximum and the minimum value, by the input to its power, each where it first occurs [rad or mm]."""

    max: Extreme
    min: Extreme


class Wanted(NamedTuple):
    """A number, the derivatives of it whose extremes are wanted, and its unit, rad or mm."""

    of: Coefficient
    orders: Sequence[int]
    unit: str


class _Sought(NamedTuple):
    course: str
    order: int
    low: float
    high: float
    sign: float


def extremes(course: Course, wanted: Mapping[str, Wanted]) -> dict[tuple[str, int], Pair]:
    """Extremes of courses and their derivatives.

    Parameters
        wanted : by name
    Returns
        found : (name, order) -> Pair
    """
    highest = max((max(each.orders) for each in wanted.values()), default=0)
    if course.structure.spec.cams:
        return _sought(course, wanted, highest)
    rows, noise = _on_grid(course, wanted, highest)
    brackets = [each for key in noise for each in _brackets(*key, course.grid, rows[key[0]], noise[key])]
    places, values = _refined(course, {name: each.of for name, each in wanted.items()}, brackets, highest)
    found = {}
    for key in noise:
        mine = [i for i, each in enumerate(brackets) if (each.course, each.order) == key]
        found[key] = _pair(course, course.grid, rows[key[0]], key[1], noise[key], places[mine], values[mine])
    return found


def _on_grid(
    course: Course, wanted: Mapping[str, Wanted], highest: int
) -> tuple[dict[str, list[Reals]], dict[tuple[str, int], float]]:
    """Courses on the grid with one derivative more, and by (name, order) the range below which one stands still."""
    jets = course.jets(course.grid, highest + 1)
    rows = {name: course.derivatives(each.of, jets, max(each.orders) + 1) for name, each in wanted.items()}
    noise = {
        (name, order): _NOISE * max(_size(rows[name], order), course.floor(each.unit, order))
        for name, each in wanted.items()
        for order in each.orders
    }
    return rows, noise


def _sought(course: Course, wanted: Mapping[str, Wanted], highest: int) -> dict[tuple[str, int], Pair]:
    """The same where laws of cams have no derivative that would find extremes, and their derivatives jump at joints."""
    jets = kept_last(lambda q: course.jets(q, highest))
    keys = [(name, order) for name, each in wanted.items() for order in each.orders]

    def values(name: str, order: int) -> Callable[[Reals], Reals]:
        return lambda q: course.derivatives(wanted[name].of, jets(q), order)[order]

    period = None if course.turns is None else course.end
    curves = [values(*key) for key in keys]
    both = [(curve, greatest) for curve in curves for greatest in (True, False)]
    tops = extremes_over(both, course.start, course.end, joints=course.joints, samples=course.samples)
    found = {}
    for i, key in enumerate(keys):
        high, low = (_inside(each, period) for each in tops[2 * i : 2 * i + 2])
        noise = _NOISE * course.floor(wanted[key[0]].unit, key[1])
        if high.value - low.value <= noise:
            high, low = (each._replace(place=course.start) for each in (high, low))
        found[key] = Pair(high, low)
    return found


def humps(
    course: Course, wanted: Mapping[str, Wanted], share: float
) -> dict[tuple[str, int], list[tuple[float, float]]]:
    """Places of the local extremes of courses and their derivatives, with 1 for a maximum and -1 for a minimum.

    Parameters
        share : float - of the range of a course: what is farther from the extreme is left out
    Returns
        found : (name, order) -> places; what stands still is left out
    """
    highest = max((max(each.orders) for each in wanted.values()), default=0)
    rows, noise = _on_grid(course, wanted, highest)
    moving = {key: least for key, least in noise.items() if float(np.ptp(rows[key[0]][key[1]])) > least}
    brackets = [each for key in moving for each in _brackets(*key, course.grid, rows[key[0]], noise[key], share)]
    found: dict[tuple[str, int], list[tuple[float, float]]] = {key: [] for key in moving}
    places, _ = _refined(course, {name: each.of for name, each in wanted.items()}, brackets, highest)
    for each_one, place in zip(brackets, places.tolist(), strict=True):
        found[each_one.course, each_one.order].append((place, each_one.sign))
    return found


def quick_return_ratio(course: Course, wanted: Wanted) -> float | None:
    """Time of the slower stroke over that of the faster one; None unless a period has one stroke of each direction.

    Source
        own derivation: both strokes share the period at the two places where the number returns
    """
    if course.turns is None or course.structure.spec.cams:
        return None
    places = [place for place, _ in humps(course, {"": wanted}, 1.0).get(("", 0), ())]
    if len(places) != 2:
        return None
    stroke = abs(places[1] - places[0])
    return max(stroke, course.end - stroke) / min(stroke, course.end - stroke)


def turning_points(course: Course, of: Coefficient, *, ahead: int) -> Reals:
    """Where a number is smallest next to its neighbours.

    Parameters
        of : its Taylor coefficients; coefficient k needs those of the motion up to k + ahead
    """
    grid = course.grid
    slope = course.derivatives(of, course.jets(grid, 1 + ahead), 1)[1]
    steps = np.flatnonzero((slope[:-1] < 0.0) & (slope[1:] >= 0.0))
    sought = [_Sought("", 0, float(grid[i]), float(grid[i + 1]), -1.0) for i in steps]
    return _refined(course, {"": of}, sought, ahead)[0]


def _size(rows: Sequence[Reals], order: int) -> float:
    return max(float(np.abs(each).max()) for each in rows[1 if order else 0 : order + 1])


def _brackets(
    name: str, order: int, grid: Reals, rows: Sequence[Reals], noise: float, share: float = 0.0
) -> list[_Sought]:
    """Steps of the grid in which the next derivative changes its sign next to the maximum and the minimum values."""
    value, slope = rows[order], rows[order + 1]
    size = _size(rows, order)
    if float(np.ptp(value)) <= noise:
        return []
    width = np.diff(grid)
    changes = ((slope[:-1] > 0.0) != (slope[1:] > 0.0)) & (np.abs(slope[:-1]) + np.abs(slope[1:]) > 0.0)
    room = width * np.maximum(np.abs(slope[:-1]), np.abs(slope[1:]))
    found: list[_Sought] = []
    for sign in (1.0, -1.0):
        top = np.maximum(sign * value[:-1], sign * value[1:])
        turns = (slope[:-1] > 0.0) if sign > 0.0 else (slope[:-1] <= 0.0)
        near = top + room >= float(top.max()) - _EQUAL * size - share * float(np.ptp(value))
        found += (
            _Sought(name, order, float(grid[i]), float(grid[i + 1]), sign)
            for i in np.flatnonzero(changes & turns & near)
        )
    return found


def _refined(
    course: Course, of: Mapping[str, Coefficient], sought: Sequence[_Sought], highest: int
) -> tuple[Reals, Reals]:
    """Places of the extremes and values there, by Newton's steps kept inside their brackets."""
    if not sought:
        return np.zeros(0), np.zeros(0)
    low, high = np.array([each.low for each in sought]), np.array([each.high for each in sought])

    def falling(q: Reals, rows: Any) -> tuple[Reals, Reals]:
        here = [sought[i] for i in rows]
        first, second = _pick(course, of, here, q, highest)
        sign = np.array([each.sign for each in here])
        return -sign * first, -sign * second

    place = newton_roots(falling, low, high, 0.5 * (low + high), np.arange(low.size), rest=1e-13)
    return place, _pick(course, of, sought, place, highest, values=True)[0]


def _pick(
    course: Course,
    of: Mapping[str, Coefficient],
    sought: Sequence[_Sought],
    q: Reals,
    highest: int,
    *,
    values: bool = False,
) -> tuple[Reals, Reals]:
    """Of each course at its own place the next two derivatives, or the value."""
    jets = course.jets(q, highest if values else highest + 2)
    found = np.empty((2, q.size))
    groups: dict[tuple[str, int], list[int]] = {}
    for i, each in enumerate(sought):
        groups.setdefault((each.course, each.order), []).append(i)
    for (name, order), mine in groups.items():
        derivatives = course.derivatives(of[name], jets, order if values else order + 2)
        found[0, mine] = derivatives[order if values else order + 1][mine]
        found[1, mine] = derivatives[-1][mine]
    return found[0], found[1]


def _pair(
    course: Course, grid: Reals, rows: Sequence[Reals], order: int, noise: float, places: Reals, values: Reals
) -> Pair:
    size, value = _size(rows, order), rows[order]
    period = None if course.turns is None else course.end
    if float(np.ptp(value)) <= noise:
        still = 0.0 if float(np.abs(value).max()) <= noise else float(value[0])
        return Pair(Extreme(still, float(grid[0])), Extreme(still, float(grid[0])))
    if period is None:
        ends = np.array([grid[0], grid[-1]])
        places, values = np.append(places, ends), np.append(values, value[[0, -1]])
    best: list[Extreme] = []
    for sign in (1.0, -1.0):
        i = int(np.argmax(sign * value))
        seen = Extreme(float(value[i]), float(grid[i]))
        equal = _EQUAL * size
        top = max(float(np.max(sign * values, initial=-np.inf)), -np.inf)
        if not places.size or sign * seen.value > top + equal:  # of a row that no bracket holds
            best.append(_inside(seen, period))
            continue
        first: NDArray[np.intp] = np.flatnonzero(sign * values >= top - equal)
        candidates = [_inside(Extreme(float(values[k]), float(places[k])), period) for k in first]
        best.append(min(candidates, key=lambda each: each.place))
    return Pair(*best)


def _inside(found: Extreme, period: float | None) -> Extreme:
    """A place in [0, period), what rounding took below 0 at 0."""
    if period is None:
        return found
    place = found.place % period
    return found._replace(place=0.0 if period - place < _AT_END * period else place)
