"""The blocking contour: which profile shifts a pair of gears may have, and how far a design is from each limit.

Every line is traced along diagonals x_1 + x_2 = const, on which the mesh does not change, by bracketed roots; a line
may cross a diagonal more than once, and does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, fields, replace
from functools import cache
from itertools import compress, pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.remedies.ways import at_least, at_most
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.roots import bracketed_root, sign_changes
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.checks import FILLET_NOISE
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.pair_sweep import (
    GearPairs,
    InternalInterferences,
    PathsOfContact,
    RingPairs,
    TipCorners,
)
from gearlink.core.parts.gears.mesh.pitch_pair import Pair
from gearlink.core.parts.gears.rating.root_stress import RootSection, RootStress
from gearlink.core.parts.gears.shifts.candidates import strengths
from gearlink.core.parts.gears.shifts.contour_lines import Line, lines_of, value_of
from gearlink.core.parts.gears.shifts.shift_split import Diagonal

if TYPE_CHECKING:
    from gearlink.core.base.report import Column


_DIAGONALS, _UPRIGHTS, _POINTS = 81, 41, 33
_NEAR = 0.05
"""Points that are nearer, in both shifts, tell nothing new."""
_ROOM, _LEAST, _MOST = 0.5, -0.8, 1.6
_STEP = 0.15
"""Points of a line farther apart than this, in both shifts, belong to different branches."""


def _has_mesh(data: GearData) -> bool:
    try:
        return data.pair.contact_ratio > 0.0
    except NoSolution:
        return False


@dataclass(frozen=True)
class BlockingContour:
    """The lines about a design, and its margins.

    Example
        >>> contour = BlockingContour(GearData(pair=GearPair.from_shift(1.0, (17, 40), (0.3, 0.2))))
        >>> contour.crossings(contour.line("undercut 1"), 0.5)[0] == contour.data.pair.min_shift_no_undercut[0]
        True
    """

    data: GearData

    @cached_property
    def pair(self) -> GearPair:
        """The pair by its shifts, without backlash."""
        x = self.data.pair.profile_shift
        return replace(self.data.pair, given_shift=x, given_distance=None, given_first_shift=None)

    @cached_property
    def placed(self) -> GearData:
        """The data of that pair."""
        return replace(self.data, pair=self.pair)

    @cached_property
    def lines(self) -> tuple[Line, ...]:
        """Every line."""
        return lines_of(self.data)

    def line(self, name: str) -> Line:
        """A line by its name."""
        return next(line for line in self.lines if line.name == name)

    @cached_property
    def window(self) -> tuple[Pair, Pair]:
        """Between which x_1, and x_2, the lines are traced [module]."""
        one, other = self.data.pair.profile_shift
        first = min(_LEAST, one - _ROOM), max(_MOST, one + _ROOM)
        if self.data.pair.internal:
            return first, (min(-_MOST, other - _ROOM), max(-_LEAST, other + _ROOM))
        return first, (min(_LEAST, other - _ROOM), max(_MOST, other + _ROOM))

    def reach(self, shift_sum: float) -> Pair:
        """x_1 between which a diagonal lies in the window."""
        (low1, high1), (low2, high2) = self.window
        return max(low1, shift_sum - high2), min(high1, shift_sum - low2)

    def _on(self, shift_sum: float) -> list[float]:
        """x_1 along a diagonal, inside the window."""
        low, high = self.reach(shift_sum)
        return [low + (high - low) * k / (_POINTS - 1) for k in range(_POINTS)] if low < high else []

    def _data_on(self, shift_sum: float) -> Callable[[float], GearData]:
        diagonal = Diagonal(replace(self.pair, given_shift=(shift_sum / 2.0, shift_sum / 2.0)))
        return lambda first: replace(self.data, pair=diagonal.at(first))

    def crossings(self, line: Line, shift_sum: float) -> list[float]:
        """x_1 at which a line crosses a diagonal.

        Raises
            NoSolution - where the shift sum leaves no mesh
        """
        return [first for _, first in self.crossed((line,), shift_sum)]

    def crossed(self, lines: Sequence[Line], shift_sum: float) -> list[tuple[Line, float]]:
        """Lines that cross a diagonal, with the x_1 there.

        Raises
            NoSolution - where the shift sum leaves no mesh
        """
        at, grid = self._data_on(shift_sum), self._on(shift_sum)
        designs = [at(first) for first in grid]

        def roots(line: Line) -> list[float]:
            values = [value_of(line, each) for each in designs]
            return _roots_of(lambda first: value_of(line, at(first)), grid, values)

        return [(line, root) for line in lines for root in roots(line)]

    def ways(self, shift_sum: float, first: float) -> Callable[[Line, float], float]:
        """Of a line the way from x_1 to where it crosses a diagonal nearest, searched as far as is said, else inf.

        Raises
            NoSolution - where the shift sum leaves no mesh
        """
        at, grid = self._data_on(shift_sum), self._on(shift_sum)
        designs = cache(lambda k: at(grid[k]))
        steps = sorted((max(low - first, first - high, 0.0), k) for k, (low, high) in enumerate(pairwise(grid)))

        def way(line: Line, most: float) -> float:
            value, found = cache(lambda k: value_of(line, designs(k))), math.inf
            for far, k in steps:
                if far >= min(most, found):
                    break
                roots = _roots_of(lambda x: value_of(line, at(x)), grid[k : k + 2], [value(k), value(k + 1)])
                found = min((abs(root - first) for root in roots), default=found)
            return found

        return way

    @cached_property
    def _diagonals(self) -> list[tuple[float, list[tuple[Line, float]], list[Pair]]]:
        """For shift sums across the window: the sum, where lines cross it, and between which x_1 it is free."""
        (low1, high1), (low2, high2) = self.window
        step = (high1 + high2 - low1 - low2) / (_DIAGONALS - 1)
        sums = [low1 + low2 + step * k for k in range(_DIAGONALS)]
        inside = [total for total in sums if self._on(total)]
        crossed, free = self._across(inside)
        return list(zip(inside, crossed, free, strict=True))

    @cached_property
    def points(self) -> dict[str, list[Pair]]:
        """Points (x_1, x_2) of every line along rising shift sums, then, where it runs along them, along rising x_1."""
        found: dict[str, list[Pair]] = {line.name: [] for line in self.lines}
        for total, crossed, _ in self._diagonals:
            for line, first in crossed:
                found[line.name].append((first, total - first))
        for line in self.lines:
            known = list(found[line.name])
            found[line.name] += [point for point in self._upright(line) if not _near(point, known)]
        return found

    @property
    def branches(self) -> dict[str, list[list[Pair]]]:
        """The points of each line in the order of its branches: each goes on at both ends to what is next, and near."""
        return {name: _branches(points) for name, points in self.points.items()}

    def _upright(self, line: Line) -> list[Pair]:
        """Where a limit crosses lines of constant x_1."""
        if not line.limits or line.name.startswith("undercut"):
            return []
        firsts, uprights = self._uprights
        rows, seconds = uprights.crossings(line)
        return list(zip(firsts[rows].tolist(), seconds.tolist(), strict=True))

    @cached_property
    def _uprights(self) -> tuple[Reals, Rows]:
        """x_1 across the window, and x_2 along each."""
        (low1, high1), (low2, high2) = self.window
        seconds = low2 + (high2 - low2) * np.arange(_POINTS) / (_POINTS - 1)
        firsts = low1 + (high1 - low1) * np.arange(_UPRIGHTS) / (_UPRIGHTS - 1)
        along = np.broadcast_to(seconds, (_UPRIGHTS, _POINTS))
        return firsts, Rows(self.placed, along, lambda rows, second: (firsts[rows], second))

    @property
    def free(self) -> Iterator[list[Pair]]:
        """The shifts that no limit blocks, as strips between two shift sums: corners (x_1, x_2) of quadrilaterals.

        Notes
            Tip thicknesses and contact ratios above the least, and radial assembly, are preferences and block nothing.
        """
        for (one, _, before), (two, _, behind) in pairwise(self._diagonals):
            for low, high in before:
                for start, end in behind:
                    if max(low, start - (two - one)) <= min(high, end):
                        yield [(low, one - low), (high, one - high), (end, two - end), (start, two - start)]

    def _across(self, sums: list[float]) -> tuple[list[list[tuple[Line, float]]], list[list[Pair]]]:
        """For some shift sums where lines cross them, and between which x_1 they are free."""
        grids, totals = [self._on(total) for total in sums], np.array(sums)
        along = np.array(grids).reshape(len(sums), _POINTS)
        diagonals = Rows(self.placed, along, lambda rows, first: (first, totals[rows] - first))
        crossed: list[list[tuple[Line, float]]] = [[] for _ in sums]
        for line in self.lines:
            for row, first in zip(*(found.tolist() for found in diagonals.crossings(line)), strict=True):
                crossed[row].append((line, first))
        stretches = [(row, ends) for row, grid in enumerate(grids) for ends in _stretches(grid, crossed[row])]
        rows, middles = [row for row, _ in stretches], [0.5 * (low + high) for _, (low, high) in stretches]
        are_free = diagonals.are_free(self.lines, rows, np.array(middles)).tolist()
        free: list[list[Pair]] = [[] for _ in sums]
        for row, ends in compress(stretches, are_free):
            free[row].append(ends)
        return crossed, [_joined(each) for each in free]

    @cached_property
    def _own_crossed(self) -> list[tuple[Line, float]]:
        """Where lines cross the diagonal of the design."""
        return self.crossed(self.lines, sum(self.pair.profile_shift))

    @cached_property
    def _own_free(self) -> list[Pair]:
        """x_1 between which that diagonal is free."""
        total = sum(self.pair.profile_shift)
        at = self._data_on(total)
        found = _stretches(self._on(total), self._own_crossed)
        return _joined([(low, high) for low, high in found if self.is_free(at(0.5 * (low + high)))])

    def shares(self, wanted: str = "") -> list[float]:
        """x_1 at the same shift sum that lie within the limits, whole hundredths, the nearest first.

        Parameters
            wanted : str - name of a line to lie on as well as can be; "": the nearest x_1 inside
        Notes
            With each stretch that is free also what is left of it where the preferences (tips, contact ratio) are kept.
        """
        now = self.pair.profile_shift[0]
        if wanted:
            found = [first for line, first in self._own_crossed if line.name == wanted]
            return sorted((round(first, 2) for first in found), key=lambda first: abs(first - now))
        places = [first for line, first in self._own_crossed if line.blocks]
        inside: set[float] = set()
        for low, high in self._own_free:
            ends = [low, *sorted(first for first in places if low < first < high), high]
            for start, end in pairwise(ends):
                inside |= {first for first in (at_least(start, 0.01), at_most(end, 0.01)) if start <= first <= end}
        return sorted(inside, key=lambda first: abs(first - now))

    def is_free(self, data: GearData) -> bool:
        """Whether nothing that limits a pair is violated."""
        found = [value_of(line, data) for line in self.lines if line.limits]
        return all(value >= 0.0 or value != value for value in found) and _has_mesh(data)

    @cached_property
    def margins(self) -> dict[str, tuple[float | None, float | None]]:
        """For each line how far x_1 may fall and rise, at the same shift sum, until the line is met [module]."""
        one = self.pair.profile_shift[0]
        found: dict[str, tuple[float | None, float | None]] = {}
        for line in self.lines:
            roots = [first for each, first in self._own_crossed if each.name == line.name]
            below, above = [x - one for x in roots if x <= one], [x - one for x in roots if x > one]
            found[line.name] = max(below, default=None), min(above, default=None)
        return found

    @property
    def nearest_limits(self) -> tuple[tuple[str, float] | None, tuple[str, float] | None]:
        """The limits that x_1 meets first when it falls, and when it rises, at the same shift sum, with the way."""
        limits = [(line.name, self.margins[line.name]) for line in self.lines if line.limits]
        below = [(name, ways[0]) for name, ways in limits if ways[0] is not None]
        above = [(name, ways[1]) for name, ways in limits if ways[1] is not None]
        return max(below, key=lambda end: end[1], default=None), min(above, key=lambda end: end[1], default=None)

    def table(self) -> Table:
        """The table `contour`: a row per point of a line."""
        rows = [(name, x1, x2) for name, points in self.points.items() for x1, x2 in points]
        columns: dict[str, tuple[Column, str]] = {
            "line": ([row[0] for row in rows], "1"),
            "x1": ([row[1] for row in rows], "1"),
            "x2": ([row[2] for row in rows], "1"),
        }
        return Table.of("contour", columns)

    def margin_table(self) -> Table:
        """The table `margins`: each line with the value of the design and the way to it along the diagonal."""
        values = [value_of(line, self.placed) for line in self.lines]
        states = [_state(line, value) for line, value in zip(self.lines, values, strict=True)]
        columns: dict[str, tuple[Column, str]] = {
            "line": ([line.name for line in self.lines], "1"),
            "state": (states, "1"),
            "less_x1": ([self.margins[line.name][0] for line in self.lines], "1"),
            "more_x1": ([self.margins[line.name][1] for line in self.lines], "1"),
        }
        return Table.of("margins", columns)


def _state(line: Line, value: float) -> str:
    return "" if not line.blocks or value != value else "good" if value >= 0.0 else "blocked"


def _branches(points: list[Pair]) -> list[list[Pair]]:
    left, branches = list(points), []
    while left:
        branch = [left.pop(0)]
        for _ in range(2):
            while near := [point for point in left if max(_apart(branch[-1], point)) < _STEP]:
                following = min(near, key=lambda point: sum(d * d for d in _apart(branch[-1], point)))
                left.remove(following)
                branch.append(following)
            branch.reverse()
        branches.append(branch)
    return branches


def _apart(one: Pair, other: Pair) -> Pair:
    return abs(one[0] - other[0]), abs(one[1] - other[1])


def _near(point: Pair, known: list[Pair]) -> bool:
    return any(abs(point[0] - one) < _NEAR and abs(point[1] - other) < _NEAR for one, other in known)


def _stretches(grid: list[float], crossed: list[tuple[Line, float]]) -> Iterator[Pair]:
    """The pieces of a diagonal between its ends and the limits that cross it."""
    return pairwise(sorted({grid[0], grid[-1], *(root for line, root in crossed if line.limits)}))


def _joined(stretches: list[Pair]) -> list[Pair]:
    """Stretches with those as one that touch, at a line that is met from inside on both sides."""
    found: list[Pair] = []
    for low, high in stretches:
        touches = bool(found) and found[-1][1] == low
        found.append((found.pop()[0] if touches else low, high))
    return found


def _roots_of(value: Callable[[float], float], grid: list[float], values: list[float]) -> list[float]:
    found = []
    for k in sign_changes(values):
        try:
            found.append(bracketed_root(value, grid[k], grid[k + 1], ends=(values[k], values[k + 1])))
        except NoSolution:  # the value ends within the step
            continue
    return found


@dataclass(frozen=True, kw_only=True)
class GearDatas(GearData):
    """Pairs that differ in their shifts alone.

    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> one = GearData(pair=GearPair(module=2.0, teeth=(20, 40), given_shift=(0.1, 0.0)))
        >>> many = shifted(one, np.array([0.1, 0.3]), np.zeros(2))
        >>> many.pair.contact_ratio.round(6).tolist(), many.root.sections[0].form_factor.round(6).tolist()
        ([1.601225, 1.532794], [1.494699, 1.349281])
    """

    @cached_property
    def path(self) -> PathsOfContact:
        """Their paths of contact, with the lesser width."""
        return PathsOfContact(self.pair, self._common_width)

    @cached_property
    def internal(self) -> InternalInterferences | None:
        """Their interferences; None for external pairs."""
        return InternalInterferences(self.pair) if self.pair.internal else None

    @cached_property
    def root(self) -> RootStresses:
        return RootStresses(**self._of_roots)


@dataclass(frozen=True, kw_only=True)
class RootSections(RootSection):
    """The root sections of one gear of many pairs."""

    @cached_property
    def theta(self) -> Any:
        """Direction of the tool's normal at the tangent; NaN where no tangent of this direction touches the fillet."""
        alpha, fn = self.pair.pressure_angle, self.pair.fn
        slope, h, center = np.broadcast_arrays(*self._tangent_line, self.tool.rounding_center(alpha, fn))
        low = np.where(center < 0.0, np.nan, 0.0)
        high = np.full(low.shape, np.pi / 2.0 - alpha)
        return bracketed_roots(lambda b: b - slope * np.tan(b) + h, low, high)

    @cached_property
    def stress_correction_factor(self) -> Any:
        """Y_S; NaN where fillet radius, section, lever or form factor is not positive."""
        least = np.minimum(np.minimum(self.fillet_radius, self.chord), self.moment_arm)
        return np.where((least > 0.0) & (self.form_factor > 0.0), self._stress_correction, np.nan)


@dataclass(frozen=True, kw_only=True)
class RootStresses(RootStress):
    """Root stresses of many pairs."""

    section_of = RootSections

    def _section(self, gear: int) -> RootSection | None:
        return self._made(gear)


def shifted(data: GearData, first: Reals, second: Reals) -> GearDatas:
    """The data of a pair with other shifts (x_1, x_2) [module], (N,) arrays each."""
    made = RingPairs if data.pair.internal else GearPairs
    of_pair = {each.name: getattr(data.pair, each.name) for each in fields(data.pair)}
    of_pair |= {"given_shift": (first, second), "given_distance": None, "given_first_shift": None}
    rest = {each.name: getattr(data, each.name) for each in fields(data) if each.name != "pair"}
    return GearDatas(pair=made(**of_pair), **rest)


def _fillet(data: GearDatas, gear: int) -> Any:
    form: Any = data.pair.form_radius_of(gear)
    found: Any = data.path.used_root_radius[gear] - form
    if data.pair.shaped is not None:  # a ring that its cutter cannot shape leaves no fillet to either gear
        shaped: Any = data.pair.form_radius_of(1)
        found = np.where(np.isnan(shaped), np.nan, found)
    found = np.where(data.pair.interference_margin[1 - gear] < 0.0, np.nan, found)
    corner = TipCorners(data.pair, gear).least_gaps(found >= 0.0)
    return np.where(corner < -FILLET_NOISE * data.pair.module, corner, found)


def _root_stress(data: GearDatas) -> Any:
    found = strengths(data)
    assert found is not None
    return np.log(found[0] / found[1])


_AT_ONCE: dict[str, Callable[[GearDatas], Any]] = {
    "fillet 1": lambda data: _fillet(data, 0),
    "fillet 2": lambda data: _fillet(data, 1),
    "equal root stress": _root_stress,
}
"""Of the lines whose value asks first whether a pair has it."""


def values_of(line: Line, data: GearDatas) -> Reals:
    """The values of a line, not a number where a pair has none."""
    pair: Any = data.pair
    try:
        found = _AT_ONCE.get(line.name, line.value)(data)
    except NoSolution:  # a cutter that no ring can be shaped with
        found = np.nan
    there = pair.exist & pair.have_flanks if line.needs_flanks else pair.exist
    return np.where(there, found, np.nan)


@dataclass(frozen=True)
class Rows:
    """Points in rows through the plane of both shifts.

    Parameters
        data : GearData - of one pair
        along : (N, M) array [module] - places along each row
        place : function of (row numbers, places along them) that gives x_1 and x_2
    """

    data: GearData
    along: Reals
    place: Callable[[Any, Reals], tuple[Reals, Reals]]

    def at(self, rows: Any, along: Reals) -> GearDatas:
        """The pairs at places along some rows."""
        return shifted(self.data, *self.place(rows, along))

    @cached_property
    def _grid(self) -> GearDatas:
        count, points = self.along.shape
        return self.at(np.repeat(np.arange(count), points), self.along.ravel())

    def crossings(self, line: Line) -> tuple[Any, Reals]:
        """Where a line crosses the rows: their numbers, rising, and the places along them.

        Notes
            As the crossings of one row by scalars: between neighbours of different sign, to the last bits.
        """
        with np.errstate(all="ignore"):
            values = values_of(line, self._grid).reshape(self.along.shape)
            one, other = values[:, :-1], values[:, 1:]
            rows, steps = np.nonzero((one == 0.0) | ((one < 0.0) & (other > 0.0)) | ((one > 0.0) & (other < 0.0)))
            ends = one[rows, steps], other[rows, steps]
            low, high = self.along[rows, steps], self.along[rows, steps + 1]
            roots = bracketed_roots(lambda at: values_of(line, self.at(rows, at)), low, high, ends=ends)
        found = ~np.isnan(roots)  # the value may end within the step
        return rows[found], roots[found]

    def are_free(self, lines: Sequence[Line], rows: Any, along: Reals) -> Mask:
        """Whether no line that limits is violated at places along some rows, and the teeth mesh."""
        with np.errstate(all="ignore"):
            data = self.at(rows, along)
            free: Mask = np.asarray(data.pair.contact_ratio) > 0.0
            for line in lines:
                if line.limits:
                    free &= ~(values_of(line, data) < 0.0)
        return free
