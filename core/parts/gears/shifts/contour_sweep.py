"""The lines of the blocking contour along many rows of shifts at once."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass, fields
from typing import Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.gears.checks import FILLET_NOISE
from gearlink.core.parts.gears.data import GearData
from gearlink.core.parts.gears.mesh.pair_sweep import (
    GearPairs,
    InternalInterferences,
    PathsOfContact,
    RingPairs,
    TipCorners,
)
from gearlink.core.parts.gears.rating.root_stress import RootSection, RootStress
from gearlink.core.parts.gears.shifts.candidates import strengths
from gearlink.core.parts.gears.shifts.contour_lines import Line


@dataclass(frozen=True, kw_only=True)
class GearDatas(GearData):
    """Pairs that differ in their shifts alone.

    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> one = GearData(pair=GearPair(module=2.0, teeth=(20, 40), given_shift=(0.1, 0.0)))
        >>> many = shifted(one, np.array([0.1, 0.3]), np.zeros(2))
        >>> many.pair.contact_ratio.round(6).tolist(), many.root.form_factor[0].round(6).tolist()
        ([1.601225, 1.532794], [1.494699, 1.349281])
    """

    pairs: GearPairs
    """The pair, known to be many."""

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
        """Root strength, at the upper allowances."""
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
    pairs = made(**of_pair)
    return GearDatas(pair=pairs, pairs=pairs, **rest)


def _fillet(data: GearDatas, gear: int) -> Any:
    form: Any = data.pair.form_radius_of(gear)
    found: Any = data.path.used_root_radius[gear] - form
    if data.pair.shaped is not None:  # a ring that its cutter cannot shape leaves no fillet to either gear
        shaped: Any = data.pair.form_radius_of(1)
        found = np.where(np.isnan(shaped), np.nan, found)
    found = np.where(data.pair.interference_margin[1 - gear] < 0.0, np.nan, found)
    corner = TipCorners(data.pair, gear).least_gaps(found >= 0.0)
    return np.where(corner < -FILLET_NOISE * data.pair.module, corner, found)


def _sliding(data: GearDatas) -> Any:
    one, other = data.pair.specific_sliding
    return one - other


def _root_stress(data: GearDatas) -> Any:
    found = strengths(data)
    assert found is not None
    return np.log(found[0] / found[1])


_AT_ONCE: dict[str, Callable[[GearDatas], Any]] = {
    "fillet 1": lambda data: _fillet(data, 0),
    "fillet 2": lambda data: _fillet(data, 1),
    "equal sliding": _sliding,
    "equal root stress": _root_stress,
}
"""Of the lines whose value asks first whether a pair has it."""


def values_of(line: Line, data: GearDatas) -> Reals:
    """The values of a line, not a number where a pair has none."""
    pair = data.pairs
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
