"""Shares of a study: what is kept of each, and how they are put together.

Of a chunk only its counts, its own non-dominated designs and the nearest miss of each check are kept: the front of all
designs is the front of the chunks' fronts. A chunk depends on the study and its number alone.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from functools import lru_cache
from typing import Any

import numpy as np

from gearlink.core.base.design_axis import Evaluated, as_arrays, put_in
from gearlink.core.numerics.arrays import Mask, Reals, distinct
from gearlink.core.studies.explore.base import singles
from gearlink.core.studies.explore.pareto import Indices, best_boxes, counted, front
from gearlink.core.studies.explore.preparing import problem_of
from gearlink.core.studies.explore.problem import Problem

RANKED = 50


@dataclass
class Miss:
    """Of a check, condition or refusal: designs that fail it, that fail it alone, and the one nearest to its limit."""

    fails: int = 0
    alone: int = 0
    value: float | None = None
    limit: float | None = None
    index: int | None = None
    unit: str = "1"

    def add(self, other: Miss) -> None:
        """Take in what another chunk found; of equal distances the lower index stays."""
        self.fails += other.fails
        self.alone += other.alone
        if other.index is not None and (self.index is None or other.rank() < self.rank()):
            self.value, self.limit, self.index = other.value, other.limit, other.index
            self.unit = other.unit

    def rank(self) -> tuple[float, int]:
        """The nearer the smaller; then the lower index."""
        distance = abs(self.value - self.limit) if self.value is not None and self.limit is not None else np.inf
        return distance, -1 if self.index is None else self.index


@dataclass
class Chunk:
    """What is kept of a share of the designs.

    Fields
        misses : by the name of the row: a code, the text of a condition, or "refused KEY"
        rows : (M, 1 + columns) array - index of the design and the columns of `Problem.shown`, of the designs that are
            not dominated within the chunk
    """

    designs: int = 0
    feasible: int = 0
    misses: dict[str, Miss] = field(default_factory=dict)
    rows: Reals = field(default_factory=lambda: np.empty((0, 0)))

    def counts(self) -> str:
        """All but the rows as JSON."""
        plain = {name: [m.fails, m.alone, m.value, m.limit, m.index, m.unit] for name, m in self.misses.items()}
        return json.dumps([self.designs, self.feasible, plain], separators=(",", ":"))

    def data(self) -> bytes:
        """The rows as bytes, little-endian doubles."""
        return np.ascontiguousarray(self.rows, dtype="<f8").tobytes()

    @classmethod
    def of(cls, counts: str, data: bytes, columns: int) -> Chunk:
        """From what `counts` and `data` gave."""
        designs, feasible, plain = json.loads(counts)
        rows = np.frombuffer(data, dtype="<f8").reshape(-1, 1 + columns).astype(float)
        return cls(designs, feasible, {name: Miss(*given) for name, given in plain.items()}, rows)


def computed(canonical: str, number: int) -> tuple[str, bytes]:
    """A chunk by the study's canonical text and its number: a function of plain data, which any executor serves."""
    chunk = chunk_of(_problem(canonical), number)
    return chunk.counts(), chunk.data()


def designs_of(canonical: str, first: int, last: int) -> None:
    """Compute some designs of a study and keep nothing: where one of them ends its process, this tells."""
    made = _problem(canonical)
    evaluated(made, made.order.columns(np.arange(first, last)))


@lru_cache(maxsize=2)
def _problem(canonical: str) -> Problem:
    return problem_of(canonical)


def chunk_of(problem: Problem, number: int) -> Chunk:
    """The chunk of a number."""
    size = problem.chunk_size
    index = np.arange(number * size, min((number + 1) * size, problem.order.count))
    columns = problem.order.columns(index)
    return kept(problem, index, evaluated(problem, columns))


def evaluated(problem: Problem, columns: Reals) -> Evaluated:
    """Designs by a column of values each, all at once where the kind can."""
    if problem.axis is None:
        return one_by_one(problem, columns)
    by_path: dict[str, Reals] = {}
    for variable, row in zip(problem.variables, columns, strict=True):
        values = np.array(variable.values, dtype=float)[row.astype(int)] if variable.values else row
        by_path |= dict.fromkeys((variable.path, *variable.also), values)
    found: Evaluated = problem.axis.evaluate(by_path)
    if found.unsure is None or not found.unsure.any():
        return found
    places = np.flatnonzero(found.unsure)
    return put_in(found, places, one_by_one(problem, columns[:, places]))


def one_by_one(problem: Problem, columns: Reals) -> Evaluated:
    """Designs by their class; what that seeks for many of them at once is sought first."""
    changes = map(problem.changes, columns.T)
    return as_arrays(singles(problem.base, changes, problem.names, problem.must_pass), problem.names, problem.must_pass)


@dataclass(frozen=True)
class Judged:
    """Evaluated designs against what is sought.

    Fields
        columns : (C, N) array - of `Problem.shown`; words have no number
        objectives : (N, k) array - to be minimised
        failing : by row of the table why, which designs fail it, and (value, limit, unit) where it has them
        total : (N,) array - how many rows each design fails
    """

    columns: Reals
    objectives: Reals
    failing: dict[str, tuple[Mask, Any]]
    total: Any


def judged(problem: Problem, found: Evaluated, count: int) -> Judged:
    """Judge evaluated designs."""
    columns = np.array([_numbers(_column(expression, found, count)) for _, expression, _ in problem.shown])
    signs = np.array([requirement.sign for requirement in problem.objectives])
    objectives = (columns[: len(signs)] * signs[:, None]).T
    failing = _failing(problem, found, objectives, count)
    total = np.zeros(count, dtype=np.intp)
    for fails, _ in failing.values():
        total += fails
    return Judged(columns, objectives, failing, total)


def kept(problem: Problem, index: Any, found: Evaluated) -> Chunk:
    """What is kept of evaluated designs."""
    what = judged(problem, found, len(index))
    misses = {name: _miss(fails, what.total, values, index) for name, (fails, values) in what.failing.items()}
    places = np.flatnonzero(what.total == 0)
    best = _best(problem, counted(what.objectives[places], _resolution(problem)))
    rows = np.column_stack([index[places[best]].astype(float), what.columns[:, places[best]].T])
    return Chunk(len(index), len(places), misses, rows)


def _resolution(problem: Problem) -> Reals:
    return np.array([requirement.resolution for requirement in problem.objectives])


def _column(expression: Any, found: Evaluated, count: int) -> Any:
    value = expression.value(found.quantities)
    return np.full(count, value) if np.ndim(value) == 0 else value


def _numbers(values: Any) -> Reals:
    """Values as numbers; words have none."""
    return values if values.dtype.kind == "f" else np.full(len(values), np.nan)


def _failing(problem: Problem, found: Evaluated, objectives: Reals, count: int) -> dict[str, tuple[Mask, Any]]:
    """Which designs fail each row of the table `why`, and the (value, limit, unit) of the nearest of each."""
    exists = found.refused == 0
    rows: dict[str, tuple[Mask, Any]] = {}
    for code in problem.must_pass:
        rows[code] = _of_code(code, found, warn_counts=problem.spec.checks.warn_counts, count=count)
    for requirement in problem.conditions:
        value = _column(requirement.expression, found, count)
        numbers = (
            None
            if isinstance(requirement.limit, str)
            else (_numbers(value), np.full(count, requirement.limit), requirement.unit)
        )
        rows[requirement.text] = (~requirement.holds(value) & exists, numbers)
    for place, key in enumerate(found.reasons, 1):
        there = found.refused == place
        if there.any():
            rows[f"refused {key}"] = (there, None)
    left = exists.copy()
    for sought, values in zip(problem.objectives, objectives.T, strict=True):
        absent = left & ~np.isfinite(values)
        if absent.any():
            rows[f"refused no {sought.name}"] = (absent, None)
            left &= ~absent
    refused = ~left
    return {
        name: (fails if name.startswith("refused ") else fails & ~refused, values)
        for name, (fails, values) in rows.items()
    }


def _of_code(code: str, found: Evaluated, *, warn_counts: bool, count: int) -> tuple[Mask, Any]:
    """Where some finding of a code fails, with value and limit of the failing one that is nearest to its limit."""
    fails, value, limit = np.zeros(count, dtype=bool), np.full(count, np.nan), np.full(count, np.nan)
    unit = "1"
    for each in found.findings:
        if each.code != code:
            continue
        bad = each.fails | each.warns if warn_counts else each.fails
        if not bad.any():
            continue
        unit = each.unit
        with np.errstate(invalid="ignore"):
            nearer = bad & ~(np.abs(value - limit) <= np.abs(each.value - each.limit))
        value, limit = np.where(nearer, each.value, value), np.where(nearer, each.limit, limit)
        fails |= bad
    return fails, (value, limit, unit)


def _miss(fails: Mask, total: Any, numbers: Any, index: Any) -> Miss:
    places = np.flatnonzero(fails)
    if not places.size:
        return Miss(unit="1" if numbers is None else numbers[2])
    alone = int((total[places] == 1).sum())
    if numbers is None:
        return Miss(len(places), alone, index=int(index[places[0]]))
    value, limit, unit = numbers
    away = np.abs(value[places] - limit[places])
    nearest = places[0] if np.isnan(away).all() else places[np.nanargmin(away)]
    plain = [None if np.isnan(x[nearest]) else float(x[nearest]) for x in (value, limit)]
    return Miss(len(places), alone, plain[0], plain[1], int(index[nearest]), unit)


def together(problem: Problem, chunks: Iterable[Chunk]) -> Chunk:
    """What is kept of all chunks together; their order does not matter.

    Notes
        Fronts are folded a few at a time, so that memory is that of the front.
    """
    total = Chunk(misses={name: Miss() for name in rows_of_why(problem)})
    waiting: list[Reals] = []
    size = 0
    for chunk in chunks:
        total.designs += chunk.designs
        total.feasible += chunk.feasible
        for name, miss in chunk.misses.items():
            total.misses.setdefault(name, Miss()).add(miss)
        waiting.append(chunk.rows)
        size += len(chunk.rows)
        if size > 50_000:
            waiting = [fold(problem, waiting)]
            size = -len(waiting[0])
    total.rows = fold(problem, waiting)
    return total


def rows_of_why(problem: Problem) -> Sequence[str]:
    """Rows that the table `why` always has."""
    return (*problem.must_pass, *(requirement.text for requirement in problem.conditions))


def fold(problem: Problem, parts: Sequence[Reals]) -> Reals:
    """The rows of some parts that no row of the others dominates, in the order of their indices."""
    width = 1 + len(problem.shown)
    rows = np.concatenate([np.empty((0, width)), *(part for part in parts if len(part))])
    rows = rows[np.argsort(rows[:, 0], kind="stable")]
    return rows[_best(problem, multiples_of(problem, rows))]


def _best(problem: Problem, multiples: Reals) -> Indices:
    """Numbers of the designs on the front, of one objective also of the next ones."""
    best = front(multiples)
    return distinct(np.concatenate((best, best_boxes(multiples, RANKED)))) if len(problem.objectives) == 1 else best


def multiples_of(problem: Problem, rows: Reals) -> Reals:
    """The objectives of kept rows, to be minimised, in whole multiples of a millionth of their resolution."""
    signs = np.array([requirement.sign for requirement in problem.objectives])
    return counted(rows[:, 1 : 1 + len(signs)] * signs, _resolution(problem))
