"""The order of a study's designs: an index leads to a design's values and is found without a list of all designs.

Mixed radix, the first variable slowest. A variable may span multiples of one listed before it; then only those
combinations are counted that exist.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from decimal import Decimal
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.errors import GearlinkError
from gearlink.core.numerics.arrays import Mask, Reals, distinct
from gearlink.core.numerics.quasi_random import Sobol

_EDGE = 1e-9
_MOST = 2.0**53
_MOST_CELLS = 10_000_000
_MOST_DECIMALS = 22
"""Powers of ten up to this one are floats."""


@dataclass(frozen=True, slots=True)
class Variable:
    """A variable of a study.

    Parameters
        path : str - dotted key of the design file
        also : keys that always take the same value
        values : tuple - a list of values; empty for a range
        low, high : float - ends of a range, in multiples of `times` where that names a variable
        step : float or None - of a range; None: a continuum
        times : str - path of an earlier variable
        whole : bool - whole numbers alone
        log : bool - a continuum sampled in its logarithm
        times_decimals : int - decimals of the values of `times`
    """

    path: str
    also: tuple[str, ...] = ()
    values: tuple[Any, ...] = ()
    low: float = 0.0
    high: float = 0.0
    step: float | None = None
    times: str = ""
    whole: bool = False
    log: bool = False
    times_decimals: int = 0

    @property
    def continuous(self) -> bool:
        """Whether it has no grid."""
        return not self.values and self.step is None

    def ends(self, parent: Any = 1.0) -> tuple[Any, Any]:
        """First and last value of a range, at a value of the variable that it is a multiple of."""
        low, high = self.low * parent, self.high * parent
        if self.whole:
            return np.ceil(low - _EDGE), np.floor(high + _EDGE)
        return low, high

    def count(self, parent: Any = 1.0) -> Any:
        """How many values there are, at a value of the parent; of a continuum one."""
        if self.values:
            return np.full(np.shape(parent), len(self.values)) if np.ndim(parent) else len(self.values)
        if self.step is None:
            return np.ones(np.shape(parent)) if np.ndim(parent) else 1
        low, high = self.ends(parent)
        edge = 0.0 if self.whole else _EDGE
        return np.maximum(0.0, np.floor((high - low) / self.step + edge) + 1.0)

    @property
    def decimals(self) -> int:
        """Decimals of its values as the file writes them: of a range those of its first value and its step."""
        if self.values:
            return max((_decimals(value) for value in self.values if isinstance(value, float)), default=0)
        assert self.step is not None, "a continuum has no decimals"
        return 0 if self.whole else max(_decimals(self.low) + self.times_decimals, _decimals(self.step))

    def at(self, digit: Any, parent: Any = 1.0) -> Any:
        """The values at places of the range, as floats; places in the list where it has one.

        Example
            >>> Variable("share", low=0.0, high=1.0, step=0.1).at(6).item(), 0.0 + 6 * 0.1
            (0.6, 0.6000000000000001)
        """
        if self.values:
            return digit
        assert self.step is not None, "a continuum has no grid"
        return _rounded(self.ends(parent)[0] + digit * self.step, self.decimals)

    def written(self, value: float) -> Any:
        """The value as a file has it."""
        if self.values:
            return self.values[int(value)]
        return int(value) if self.whole else float(value)


def _decimals(value: float) -> int:
    """Decimals of the shortest text that is read as the number."""
    exponent = Decimal(repr(float(value))).normalize().as_tuple().exponent
    assert isinstance(exponent, int), "a finite number"
    return max(0, -exponent)


def _rounded(values: Any, decimals: int) -> Any:
    """Values to some decimals, as a file that writes so many is read; those with too many digits as they are."""
    if decimals > _MOST_DECIMALS:
        return values
    scaled = np.rint(values * 10.0**decimals)
    return np.where(np.abs(scaled) < _MOST, scaled / 10.0**decimals, values)


class TooManyDesigns(GearlinkError):
    """More combinations than can be counted or looked up; `count` is their number, as near as it is known."""

    def __init__(self, count: float) -> None:
        super().__init__(f"{count:.3g} designs")
        self.count = count


class Grid:
    """All combinations of variables that have a grid.

    Parameters
        variables : of which none is continuous
    Raises
        TooManyDesigns - beyond 2^53
    Example
        >>> crank = Variable("crank", low=2.0, high=3.0, step=1.0, whole=True)
        >>> idler = Variable("idler", low=1.0, high=1.5, step=1.0, whole=True, times="crank")
        >>> grid = Grid([crank, idler])
        >>> grid.count, grid.columns(np.arange(4)).T.tolist()
        (4, [[2.0, 2.0], [2.0, 3.0], [3.0, 3.0], [3.0, 4.0]])
    """

    def __init__(self, variables: Sequence[Variable]) -> None:
        self.variables = tuple(variables)
        self._place = {variable.path: i for i, variable in enumerate(variables)}
        self._parents = [self._place.get(variable.times, -1) for variable in variables]
        self._kept: dict[int, tuple[tuple[int, ...], Any, Any, Any]] = {}
        self._domains = [self._domain(i) for i in range(len(variables))]
        self._below: list[tuple[list[int], Reals]] = [([], np.ones(()))]
        for j in reversed(range(len(variables))):
            self._below.insert(0, self._total(j))
        total = float(self._below[0][1])
        if total > _MOST:
            raise TooManyDesigns(total)
        self.count = int(total)

    def _live(self, j: int) -> list[int]:
        """Variables before j that one from j on is a multiple of."""
        return sorted({parent for parent in self._parents[j:] if 0 <= parent < j})

    def _domain(self, i: int) -> Reals:
        """Every value that a variable can have, ascending; needed where others are multiples of it."""
        if i not in self._parents:
            return np.empty(0)
        variable = self.variables[i]
        if variable.values:
            return np.arange(len(variable.values), dtype=float)
        parent = self._parents[i]
        parents = self._numbers(parent) if parent >= 0 else np.ones(1)
        counts = variable.count(parents)
        if counts.sum() > _MOST_CELLS:
            raise TooManyDesigns(float(counts.sum()))
        found = [variable.at(np.arange(int(n)), p) for p, n in zip(parents, counts, strict=True)]
        return distinct(np.concatenate(found)) if found else np.empty(0)

    def _numbers(self, i: int) -> Reals:
        """The numbers of a domain, where the variable has a list of values too."""
        variable = self.variables[i]
        return np.array(variable.values, dtype=float) if variable.values else self._domains_of(i)

    def _domains_of(self, i: int) -> Reals:
        return self._domains[i] if i < len(getattr(self, "_domains", ())) else self._domain(i)

    def _total(self, j: int) -> tuple[list[int], Reals]:
        """How many combinations the variables from j on have, over the domains of those that they depend on."""
        live, (below_live, below) = self._live(j), self._below[0]
        table, axes = self._table(j, live, below_live, below)
        return live, table.sum(axis=-1) if axes else table

    def _table(self, j: int, live: list[int], below_live: list[int], below: Reals) -> tuple[Reals, bool]:
        """Totals below each place of variable j, places on the last axis; where they do not depend on the place, times
        the number of places, and False."""
        variable, parent = self.variables[j], self._parents[j]
        shape = [self._domains[i].size for i in live]
        grids = np.meshgrid(*(np.arange(n) for n in shape), indexing="ij") if shape else []
        at = dict(zip(live, grids, strict=True))
        parents = self._numbers(parent)[at[parent]] if parent >= 0 else np.ones(shape)
        counts = np.asarray(variable.count(parents), dtype=float) * np.ones(shape)
        if j not in below_live:
            rest = below[tuple(at[i] for i in below_live)] if below_live else below
            return counts * rest, False
        most = int(counts.max(initial=0.0))
        if math.prod(shape) * max(most, 1) > _MOST_CELLS:
            raise TooManyDesigns(math.prod(shape) * float(most))
        digits = np.arange(most)
        values = np.asarray(variable.at(digits, parents[..., None]), dtype=float) * np.ones([*shape, most])
        inside = digits < counts[..., None]
        index = np.searchsorted(self._domains[j], np.where(inside, values, self._domains[j][0] if most else 0.0))
        places = tuple(index if i == j else at[i][..., None] for i in below_live)
        return np.where(inside, below[places], 0.0), True

    def columns(self, index: Any) -> Reals:
        """Values of the designs at some indices.

        Parameters
            index : (N,) array - 0 to count - 1
        Returns
            values : (V, N) array - a row a variable; where it has a list, places in that list
        """
        rest = np.asarray(index, dtype=np.int64)
        values = np.empty((len(self.variables), rest.size))
        where: dict[int, Any] = {}
        for j, variable in enumerate(self.variables):
            live, (below_live, below) = self._below[j][0], self._below[j + 1]
            parent = self._parents[j]
            multiple = self._numbers(parent)[where[parent]] if parent >= 0 else 1.0
            if j in below_live:
                digit, rest = self._looked_up(j, live, where, rest)
            else:
                each = below[tuple(where[i] for i in below_live)] if below_live else below
                digit, rest = np.divmod(rest, np.asarray(each, dtype=np.int64))
            values[j] = variable.at(digit, multiple)
            if j in self._parents:
                where[j] = np.searchsorted(self._domains[j], values[j])
        return values

    def _looked_up(self, j: int, live: list[int], where: dict[int, Any], rest: Any) -> tuple[Any, Any]:
        """Place of variable j, and what is left of the index, by the designs before each place."""
        shape, before, offset, everywhere = self._sums(j)
        row = np.ravel_multi_index(tuple(where[i] for i in live), shape) if live else np.zeros(rest.size, dtype=int)
        digit = np.searchsorted(everywhere, rest + offset[row], side="right") - row * before.shape[1]
        return digit, rest - np.where(digit > 0, before[row, np.maximum(digit - 1, 0)], 0)

    def _sums(self, j: int) -> tuple[tuple[int, ...], Any, Any, Any]:
        if j not in self._kept:
            table, _ = self._table(j, self._below[j][0], *self._below[j + 1])
            before = np.cumsum(table.reshape(-1, table.shape[-1]), axis=1).astype(np.int64)
            offset = np.concatenate([[0], np.cumsum(before[:, -1])])
            self._kept[j] = table.shape[:-1], before, offset, (before + offset[:-1, None]).ravel()
        return self._kept[j]


class Sample:
    """Points of a scrambled Sobol' sequence over all variables, 2^k of them.

    Parameters
        variables : any
        count : int - a power of two
    """

    def __init__(self, variables: Sequence[Variable], count: int, seed: int) -> None:
        self.variables = tuple(variables)
        self.count = count
        self._seed = seed
        self._place = {variable.path: i for i, variable in enumerate(variables)}

    def columns(self, index: Any) -> Reals:
        """As `Grid.columns`, for consecutive indices; NaN where a range of multiples is empty."""
        first, size = int(index[0]), len(index)
        values = np.empty((len(self.variables), size))
        for j, (variable, u) in enumerate(zip(self.variables, self._points(first, size).T, strict=True)):
            multiple: Any = 1.0
            if variable.times:
                parent = self._place[variable.times]
                listed = self.variables[parent].values
                multiple = np.array(listed, dtype=float)[values[parent].astype(int)] if listed else values[parent]
            values[j] = _spread(variable, u, multiple)
        return values

    def _points(self, first: int, size: int) -> Reals:
        return self._sequence.points(first, size)

    @cached_property
    def _sequence(self) -> Sobol:
        return Sobol(len(self.variables), np.random.default_rng(self._seed))


def _spread(variable: Variable, u: Reals, multiple: Any) -> Reals:
    """Values of a variable from numbers in [0, 1)."""
    if not variable.continuous:
        count = variable.count(multiple)
        digit = np.minimum(np.floor(u * count), count - 1)
        values = np.asarray(variable.at(digit, multiple), dtype=float)
        exists: Mask = np.broadcast_to(np.asarray(count) > 0, u.shape)
        return np.where(exists, values, np.nan)
    low, high = variable.ends(multiple)
    if variable.log:
        return np.asarray(np.exp(np.log(low) + u * (np.log(high) - np.log(low))))
    return np.asarray(low + u * (high - low))
