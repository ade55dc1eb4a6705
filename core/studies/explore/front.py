"""What a study found: the rows to be shown, each computed again by the design's own class."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Single
from gearlink.core.numerics.arrays import Mask, Reals
from gearlink.core.studies.explore.base import single
from gearlink.core.studies.explore.chunks import RANKED, Chunk, Miss, evaluated, fold, judged, multiples_of
from gearlink.core.studies.explore.order import Sample, Variable
from gearlink.core.studies.explore.pareto import best_boxes, boxes, front, knee, spread
from gearlink.core.studies.explore.problem import Problem
from gearlink.core.studies.study.faults import BrokenPromise

# Local refinement of a sampled front: from every kept design a pattern search over its real variables

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


SHOWN = 50
AGREE = 1e-9


@dataclass(frozen=True)
class Row:
    """A kept design: its index, its variables as (path, value), and its own figures in the order of `Problem.shown`."""

    index: int
    variables: tuple[tuple[str, Any], ...]
    figures: tuple[Any, ...]


@dataclass(frozen=True)
class Found:
    """The result of a study.

    Parameters
        total : Chunk - of all designs together
        extra : Extra - what local refinement found
    """

    problem: Problem
    total: Chunk
    extra: Extra

    @classmethod
    def of(cls, problem: Problem, total: Chunk) -> Found:
        """The result of all chunks together; a sample is refined."""
        sampled = cls(problem, total, no_extra(problem))
        return sampled if problem.exhaustive else cls(problem, total, refined(problem, sampled.kept_rows))

    @cached_property
    def _front(self) -> Reals:
        return fold(self.problem, [self.total.rows, self.extra.rows]) if len(self.extra.rows) else self.total.rows

    @cached_property
    def front_size(self) -> int:
        """Designs of the front, equal points all counted."""
        if len(self.problem.objectives) > 1:
            return len(self._front)
        return len(front(multiples_of(self.problem, self._front)))

    @cached_property
    def kept_rows(self) -> Reals:
        """Index and columns of one design of each box, sorted by the objectives, the best of the first one first."""
        rows = self._front
        multiples = multiples_of(self.problem, rows)
        places = best_boxes(multiples, RANKED) if multiples.shape[1] == 1 else boxes(multiples)
        order = np.lexsort((rows[places, 0], *reversed(list(multiples[places].T))))
        return rows[places[order]]

    @cached_property
    def rows(self) -> tuple[Row, ...]:
        """The kept designs by their own class.

        Raises
            BrokenPromise - GL160 where that gives other figures than the search had
        """
        return tuple(self._row(kept) for kept in self.kept_rows)

    def _row(self, kept: Reals) -> Row:
        problem, index = self.problem, int(kept[0])
        changes = self.changes(index)
        again = single(problem.base, changes, problem.names, problem.must_pass)
        figures = tuple(figure(expression, again) for _, expression, _ in problem.shown)
        self._agree(index, kept[1:], figures, again)
        keys = dict(changes)
        return Row(index, tuple((v.path, keys[v.path]) for v in problem.variables), figures)

    def changes(self, index: int) -> list[tuple[str, Any]]:
        """Paths and values of a design by its index."""
        beside = index - self.problem.order.count
        return self.problem.changes_of(index) if beside < 0 else self.problem.changes(self.extra.values[beside])

    @cached_property
    def why(self) -> tuple[tuple[str, str | None, Miss], ...]:
        """Name, code and misses of each row of the table why."""
        made, misses = self.problem, self.total.misses
        refusals = sorted(name for name in misses if name.startswith("refused "))
        return (
            *((" ".join(made.base.codes[code]), code, misses[code]) for code in made.must_pass),
            *((requirement.text, None, misses[requirement.text]) for requirement in made.conditions),
            *((name, None, misses[name]) for name in refusals),
        )

    def _agree(self, index: int, kept: Reals, figures: tuple[Any, ...], again: Single) -> None:
        for (name, _, _), had, has in zip(self.problem.shown, kept, figures, strict=True):
            number = isinstance(has, (int, float))
            if again.refused or (number and not math.isclose(had, has, rel_tol=AGREE, abs_tol=AGREE)):
                what = f"is refused ({again.what})" if again.refused else f"has {name} {has!r}"
                raise BrokenPromise(
                    f"GL160: design {index} {what} by its own class, the search had {name} {float(had)!r}: "
                    f"{dict(self.changes(index))}"
                )
        bad = {check.code for check in again.findings if check.status == "fail"} & set(self.problem.must_pass)
        if bad:
            raise BrokenPromise(f"GL160: design {index} fails {', '.join(sorted(bad))} by its own class alone")

    def sample(self, most: int) -> Reals:
        """Columns of `Problem.shown` of designs that satisfy everything, of at most so many at even steps of the index.

        Returns
            columns : (M, columns) array
        """
        made = self.problem
        step = max(1, -(-made.order.count // most))
        if isinstance(made.order, Sample):
            index = np.arange(min(most, made.order.count))  # a share of the sequence is a sample as well
        else:
            index = np.arange(0, made.order.count, step)
        parts = np.array_split(index, max(1, len(index) // made.chunk_size))
        rows = [judged(made, evaluated(made, made.order.columns(part)), len(part)) for part in parts]
        columns: Reals = np.concatenate([row.columns.T[row.total == 0] for row in rows])
        return columns

    @cached_property
    def _objectives(self) -> Reals:
        """Objectives of the kept rows, to be minimised."""
        signs = np.array([requirement.sign for requirement in self.problem.objectives])
        values: Reals = self.kept_rows[:, 1 : 1 + len(signs)] * signs
        return values

    @cached_property
    def knee(self) -> int | None:
        """Index of the design at the knee."""
        place = None if self._objectives.shape[1] == 1 else knee(self._objectives)
        return None if place is None else int(self.kept_rows[place, 0])

    @cached_property
    def chosen(self) -> tuple[int, ...]:
        """Places of the kept rows that a terminal shows: all, or 50 far from each other."""
        place = knee(self._objectives) if self._objectives.shape[1] > 1 else 0
        return tuple(map(int, spread(self._objectives, SHOWN, place or 0)))


def figure(expression: Any, found: Single) -> Any:
    """The value of an expression of a single design; None where it does not apply."""
    if found.refused or any(found.values.get(name) is None for name in expression.names):
        return None
    values = found.values
    if isinstance(expression.tree, str):
        return values[expression.tree]
    value = float(expression.value({name: float(values[name]) for name in expression.names}))
    return value if math.isfinite(value) else None
