"""Local refinement of a sampled front: from every kept design a pattern search over its real variables.

Each search lowers the greatest distance to the best values of all, in units of the resolution. Whole numbers and listed
values stay. All searches go in step, so that a kind's array form serves; none depends on the others.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from gearlink.core.explore.chunks import evaluated, judged, multiples_of
from gearlink.core.explore.order import Variable
from gearlink.core.explore.pareto import front
from gearlink.core.explore.problem import Problem
from gearlink.core.numerics.arrays import Mask, Reals

_FIRST, _LAST = 1.0 / 8.0, 1.0 / 4096.0


@dataclass(frozen=True)
class Extra:
    """Designs found beside the sample, numbered on from it.

    Fields
        values : (M, V) array - of the variables, as `order.columns` has them
        rows : (M, 1 + columns) array - as of a chunk, the index first
    """

    values: Reals
    rows: Reals


def no_extra(problem: Problem) -> Extra:
    """None of them."""
    return Extra(np.empty((0, len(problem.variables))), np.empty((0, 1 + len(problem.shown))))


def refined(problem: Problem, kept: Reals) -> Extra:
    """Designs that local search finds from the kept ones.

    Parameters
        problem : Problem
        kept : (N, 1 + columns) array - of a sample, from `Found.kept_rows`
    Returns
        extra : Extra - of all designs that were tried and satisfy everything, those that no other of them dominates
    """
    free = [i for i, variable in enumerate(problem.variables) if variable.continuous]
    if problem.exhaustive or not free or not problem.spec.refine.steps or not len(kept):
        return no_extra(problem)
    search = _Search(problem, kept)
    for _ in range(problem.spec.refine.steps):
        moved = np.zeros(len(kept), dtype=bool)
        for i in free:
            moved |= search.try_variable(i)
        search.step = np.where(moved, search.step, 0.5 * search.step)
        if (search.step < _LAST).all():
            break
    return search.extra()


class _Search:
    """The searches from all kept designs, in step."""

    def __init__(self, problem: Problem, kept: Reals) -> None:
        self.problem = problem
        count = len(problem.objectives)
        self._signs = np.array([requirement.sign for requirement in problem.objectives])
        self._resolution = np.array([requirement.resolution for requirement in problem.objectives])
        self.at = np.array([problem.order.columns(np.array([int(row[0])]))[:, 0] for row in kept])
        objectives = kept[:, 1 : 1 + count] * self._signs
        self._best = objectives.min(axis=0)
        self._distance = self._away(objectives)
        self.step = np.full(len(kept), _FIRST)
        self._values: list[Reals] = []
        self._rows: list[Reals] = []

    def _away(self, objectives: Reals) -> Reals:
        with np.errstate(invalid="ignore"):
            away: Reals = ((objectives - self._best) / self._resolution).max(axis=1)
        return away

    def try_variable(self, i: int) -> Mask:
        """Step a variable up; where that is no improvement, down. Where one was."""
        moved = self._try(i, 1.0, self.step >= _LAST)
        return moved | self._try(i, -1.0, ~moved & (self.step >= _LAST))

    def _try(self, i: int, sign: float, wanted: Mask) -> Mask:
        variable = self.problem.variables[i]
        low, high = self._ends(variable)
        new = self.at.copy()
        new[:, i] = _stepped(variable, new[:, i], sign * self.step, low, high)
        tried = np.flatnonzero(wanted & (new[:, i] >= low) & (new[:, i] <= high))
        better = np.zeros(len(new), dtype=bool)
        if not tried.size:
            return better
        found = judged(self.problem, evaluated(self.problem, new[tried].T), len(tried))
        good = found.total == 0
        away = np.where(good, self._away(found.objectives), np.inf)
        self._values.append(new[tried][good])
        self._rows.append(found.columns.T[good])
        nearer = away < self._distance[tried]
        better[tried[nearer]] = True
        self._distance[tried[nearer]] = away[nearer]
        self.at[better] = new[better]
        return better

    def _ends(self, variable: Variable) -> tuple[Any, Any]:
        if not variable.times:
            return variable.ends()
        parent = next(i for i, other in enumerate(self.problem.variables) if other.path == variable.times)
        listed = self.problem.variables[parent].values
        values = self.at[:, parent]
        return variable.ends(np.array(listed, dtype=float)[values.astype(int)] if listed else values)

    def extra(self) -> Extra:
        """What was found."""
        values = np.concatenate([no_extra(self.problem).values, *self._values])
        index = self.problem.order.count + np.arange(len(values), dtype=float)
        rows = np.concatenate([np.empty((0, len(self.problem.shown))), *self._rows])
        rows = np.column_stack([index, rows])
        best = front(multiples_of(self.problem, rows))
        index = self.problem.order.count + np.arange(len(best), dtype=float)
        return Extra(values[best], np.column_stack([index, rows[best, 1:]]))


def _stepped(variable: Variable, value: Reals, share: Reals, low: Any, high: Any) -> Reals:
    """A value a share of its range on, of its ratio where it is sampled by equal ratios."""
    if variable.log:
        return np.asarray(value * (high / low) ** share, dtype=float)
    return np.asarray(value + share * (high - low), dtype=float)
