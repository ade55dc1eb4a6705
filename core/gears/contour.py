"""The blocking contour: which profile shifts a pair of gears may have, and how far a design is from each limit.

Every line is traced along diagonals x_1 + x_2 = const, on which the mesh does not change, by bracketed roots; a line
may cross a diagonal more than once, and does.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from itertools import pairwise
from typing import TYPE_CHECKING, NamedTuple

from gearlink.core.errors import NoSolution
from gearlink.core.gears.candidates import strength_of
from gearlink.core.gears.data import GearData
from gearlink.core.gears.pair import GearPair, Pair
from gearlink.core.gears.shift_split import Diagonal
from gearlink.core.numerics.roots import bracketed_root, sign_changes
from gearlink.core.remedies import at_least, at_most
from gearlink.core.report import Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.report import Column

Value = Callable[[GearData], float | None]
_DIAGONALS, _UPRIGHTS, _POINTS = 81, 41, 33
_NEAR = 0.05
"""Points that are nearer, in both shifts, tell nothing new."""
_TIPS, _RATIOS = (0.0, 0.2, 0.4), (1.0, 1.1, 1.2)
_ROOM, _LEAST, _MOST = 0.5, -0.8, 1.6


class Line(NamedTuple):
    """A line of the contour: its value is positive where a pair is good, or changes sign where gears are equal."""

    name: str
    value: Value
    blocks: bool = True
    limits: bool = True


def lines_of(data: GearData) -> tuple[Line, ...]:
    """The lines that a pair can have: undercut, tips, contact ratio, root fillets, base circles, ring tips."""
    found: list[Line] = []
    for gear in (0, 1):
        if data.pair.teeth[gear] > 0:
            found.append(Line(f"undercut {gear + 1}", lambda d, g=gear: _undercut(d, g)))  # type: ignore[misc]
        for level in _TIPS:
            name = f"tip {gear + 1} {level:g} m" if level else f"pointed tip {gear + 1}"
            value = lambda d, g=gear, t=level: d.pair.tip_thickness[g] / d.pair.module - t  # noqa: E731
            found.append(Line(name, value, limits=not level))
        found.append(Line(f"fillet {gear + 1}", lambda d, g=gear: _fillet(d, g)))  # type: ignore[misc]
        found.append(Line(f"base circle {gear + 1}", lambda d, g=gear: d.pair.interference_margin[1 - g]))  # type: ignore[misc]
    for ratio in _RATIOS:
        found.append(Line(f"contact ratio {ratio:g}", lambda d, r=ratio: d.pair.contact_ratio - r, limits=ratio == 1.0))  # type: ignore[misc]
    found.append(Line("equal sliding", _sliding, blocks=False, limits=False))
    found.append(Line("equal root stress", _roots, blocks=False, limits=False))
    if data.pair.internal:
        found.append(Line("tip fouling", lambda d: d.internal.tip_fouling_margin if d.internal else None))
        found.append(
            Line("radial assembly", lambda d: d.internal.radial_assembly_margin if d.internal else None, limits=False)
        )
    return tuple(found)


def _has_mesh(data: GearData) -> bool:
    try:
        return data.pair.contact_ratio > 0.0
    except NoSolution:
        return False


def _undercut(data: GearData, gear: int) -> float | None:
    least = data.pair.min_shift_no_undercut[gear]
    return None if least is None else data.pair.profile_shift[gear] - least


def _fillet(data: GearData, gear: int) -> float | None:
    form, used = data.pair.form_radius[gear], data.path.used_root_radius[gear]
    if form is None or data.pair.interference_margin[1 - gear] < 0.0:
        return None
    return used - form


def _sliding(data: GearData) -> float | None:
    if not data.pair.slides:
        return None
    one, other = data.pair.specific_sliding
    return one - other


def _roots(data: GearData) -> float | None:
    found = strength_of(data)(data.pair)
    return None if found is None else math.log(found[0] / found[1])


@dataclass(frozen=True)
class BlockingContour:
    """The lines about a design, and its margins.

    Parameters
        data : GearData
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
        at, grid = self._data_on(shift_sum), self._on(shift_sum)
        return _roots_of(lambda first: _value(line, at(first)), grid, [_value(line, at(first)) for first in grid])

    @cached_property
    def _diagonals(self) -> list[tuple[float, list[tuple[Line, float]], list[Pair]]]:
        """For shift sums across the window: the sum, where lines cross it, and between which x_1 it is free."""
        (low1, high1), (low2, high2) = self.window
        step = (high1 + high2 - low1 - low2) / (_DIAGONALS - 1)
        sums = [low1 + low2 + step * k for k in range(_DIAGONALS)]
        return [(total, *self._across(total)) for total in sums]

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

    def _upright(self, line: Line) -> Iterator[Pair]:
        """Where a limit crosses lines of constant x_1."""
        if not line.limits or line.name.startswith("undercut"):
            return
        for first, grid, designs in self._uprights:

            def value(second: float, first: float = first) -> float:
                data = self._at(first, second)
                return math.nan if data is None else _value(line, data)

            values = [math.nan if data is None else _value(line, data) for data in designs]
            for root in _roots_of(value, grid, values):
                yield first, root

    @cached_property
    def _uprights(self) -> list[tuple[float, list[float], list[GearData | None]]]:
        """For each x_1 the x_2 along it and the pairs there, which the limits share; None where there is none."""
        (low1, high1), (low2, high2) = self.window
        grid = [low2 + (high2 - low2) * k / (_POINTS - 1) for k in range(_POINTS)]
        firsts = [low1 + (high1 - low1) * k / (_UPRIGHTS - 1) for k in range(_UPRIGHTS)]
        return [(first, grid, [self._at(first, second) for second in grid]) for first in firsts]

    def _at(self, first: float, second: float) -> GearData | None:
        try:
            return replace(self.data, pair=replace(self.pair, given_shift=(first, second)))
        except NoSolution:
            return None

    @property
    def free(self) -> Iterator[list[Pair]]:
        """The shifts that no limit blocks, as strips between two shift sums: corners (x_1, x_2) of quadrilaterals.

        Notes
            Tip thicknesses and contact ratios above the least, and radial assembly, are wishes and block nothing.
        """
        for (one, _, before), (two, _, behind) in pairwise(self._diagonals):
            for low, high in before:
                for start, end in behind:
                    if max(low, start - (two - one)) <= min(high, end):
                        yield [(low, one - low), (high, one - high), (end, two - end), (start, two - start)]

    def _across(self, total: float) -> tuple[list[tuple[Line, float]], list[Pair]]:
        try:
            at = self._data_on(total)
        except NoSolution:
            return [], []
        grid = self._on(total)
        designs = [at(first) for first in grid]
        crossed = []
        for line in self.lines:
            values = [_value(line, each) for each in designs]
            roots = _roots_of(lambda first, line=line: _value(line, at(first)), grid, values)  # type: ignore[misc]
            crossed += [(line, root) for root in roots]
        if not grid:
            return crossed, []
        ends = sorted({grid[0], grid[-1], *(root for line, root in crossed if line.limits)})
        free: list[Pair] = []
        for low, high in pairwise(ends):
            if self.is_free(at(0.5 * (low + high))):
                touches = bool(free) and free[-1][1] == low  # a line that is met from inside on both sides
                free.append((free.pop()[0] if touches else low, high))
        return crossed, free

    def shares(self, wish: str = "") -> list[float]:
        """x_1 at the same shift sum that lie within the limits, whole hundredths, the nearest first.

        Parameters
            wish : str - name of a line to lie on as well as can be; "": the nearest x_1 inside
        Notes
            With each stretch that is free also what is left of it where the wishes (tips, contact ratio) are kept.
        """
        now, other = self.pair.profile_shift
        crossed, free = self._across(now + other)
        if wish:
            found = [first for line, first in crossed if line.name == wish]
            return sorted((round(first, 2) for first in found), key=lambda first: abs(first - now))
        places = [first for line, first in crossed if line.blocks]
        inside: set[float] = set()
        for low, high in free:
            ends = [low, *sorted(first for first in places if low < first < high), high]
            for start, end in pairwise(ends):
                inside |= {first for first in (at_least(start, 0.01), at_most(end, 0.01)) if start <= first <= end}
        return sorted(inside, key=lambda first: abs(first - now))

    def is_free(self, data: GearData) -> bool:
        """Whether nothing that limits a pair is violated."""
        found = [_value(line, data) for line in self.lines if line.limits]
        return all(value >= 0.0 or value != value for value in found) and _has_mesh(data)

    @cached_property
    def margins(self) -> dict[str, tuple[float | None, float | None]]:
        """For each line how far x_1 may fall and rise, at the same shift sum, until the line is met [module]."""
        one, other = self.pair.profile_shift
        found: dict[str, tuple[float | None, float | None]] = {}
        for line in self.lines:
            roots = self.crossings(line, one + other)
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
        at = replace(self.data, pair=self.pair)
        values = [_value(line, at) for line in self.lines]
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


def _near(point: Pair, known: list[Pair]) -> bool:
    return any(abs(point[0] - one) < _NEAR and abs(point[1] - other) < _NEAR for one, other in known)


def _value(line: Line, data: GearData) -> float:
    """The value of a line, not a number where a pair has none."""
    try:
        found = line.value(data)
    except NoSolution:
        return math.nan
    return math.nan if found is None else found


def _roots_of(value: Callable[[float], float], grid: list[float], values: list[float]) -> list[float]:
    found = []
    for k in sign_changes(values):
        try:
            found.append(bracketed_root(value, grid[k], grid[k + 1], ends=(values[k], values[k + 1])))
        except NoSolution:  # the value ends within the step
            continue
    return found
