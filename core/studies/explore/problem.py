"""A study made ready to be computed: its base, its variables in order, what is sought; or all that is wrong with it."""

from __future__ import annotations

import hashlib
import json
import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.studies.explore.base import Base
from gearlink.core.studies.explore.order import Grid, Sample, TooManyDesigns, Variable
from gearlink.core.studies.explore.requirements import Condition, Objective
from gearlink.core.studies.study.expressions import Expression
from gearlink.core.studies.study.faults import Fault, WrongStudy
from gearlink.core.studies.study.spec import StudySpec

SCHEMA = 1
CHUNK, SCALAR_CHUNK = 8192, 64
GRID_BUDGET, SAMPLE_BUDGET = 1e8, 2.0**17
SCALAR_GRID_BUDGET, SCALAR_SAMPLE_BUDGET = 2e4, 2.0**12
_ORDERED = ("variables", "minimize", "maximize")


@dataclass(frozen=True)
class Problem:
    """A study that can be computed.

    Parameters
        spec : StudySpec - with its base in `design`
        variables : tuple of Variable
        objectives, conditions : what is sought
        must_pass : tuple of str - codes that a design must pass, ascending
    """

    spec: StudySpec
    base: Base
    variables: tuple[Variable, ...]
    objectives: tuple[Objective, ...]
    conditions: tuple[Condition, ...]
    must_pass: tuple[str, ...]

    @cached_property
    def names(self) -> tuple[str, ...]:
        """Quantities that have to be computed of each design, with their indices."""
        wanted = [requirement.expression for requirement in self.objectives] + [
            requirement.expression for requirement in self.conditions
        ]
        return tuple(dict.fromkeys(name for expression in wanted for name in expression.names))

    @cached_property
    def waived(self) -> tuple[str, ...]:
        """Codes that are not asked because the base fails them."""
        by_base = self.spec.checks.must_pass == "default"
        return tuple(sorted(set(self.base.codes) - set(self.must_pass))) if by_base else ()

    @property
    def asked(self) -> str:
        """In words, what a design of the front satisfies."""
        waived = ", ".join(self.waived)
        return f"everything but {waived}, which the base fails" if waived else "everything"

    @cached_property
    def shown(self) -> tuple[tuple[str, Expression, str], ...]:
        """Name, expression and unit of each column besides the variables: objectives, then what is named by where."""
        found = {requirement.name: (requirement.expression, requirement.unit) for requirement in self.objectives}
        for requirement in self.conditions:
            found.setdefault(requirement.expression.text, (requirement.expression, requirement.unit))
        return tuple((name, *rest) for name, rest in found.items())

    @cached_property
    def axis(self) -> Any:
        """The kind's array form for this study; None where each design is computed by its class."""
        make = self.base.kind.axis_maker()
        if make is None:
            return None
        paths = [path for variable in self.variables for path in (variable.path, *variable.also)]
        served = all(numeric(variable) for variable in self.variables)
        checks = [name for code in self.must_pass for name in self.base.codes[code]]
        return make(self.base.spec(), self.base.command, paths, self.names, checks) if served else None

    @property
    def chunk_size(self) -> int:
        """Designs of a chunk, the share that is computed and stored as one."""
        return SCALAR_CHUNK if self.axis is None else CHUNK

    @cached_property
    def order(self) -> Grid | Sample:
        """The designs in their order.

        Raises
            WrongStudy - GL155, GL111 where there is no design
        """
        sampling = self.spec.sampling
        asked, scalar = sampling.budget, self.axis is None
        budget = asked or (SCALAR_GRID_BUDGET if scalar else GRID_BUDGET)
        gridded = not any(variable.continuous for variable in self.variables)
        if gridded and sampling.method != "sobol":
            count, grid = self._grid()
            if count <= budget and grid is not None:
                if grid.count == 0:
                    raise WrongStudy([Fault("GL111", "no combination of the variables exists", ("variables",))])
                return grid
            if sampling.method == "grid":
                raise WrongStudy([self._too_many(count, budget)])
        elif sampling.method == "grid":
            real = next(variable for variable in self.variables if variable.continuous)
            message = f"{real.path} is a real number without step and has no grid"
            raise WrongStudy([Fault("GL155", message, ("variables", real.path), "give it a step, points or values")])
        most = asked or (SCALAR_SAMPLE_BUDGET if scalar else SAMPLE_BUDGET)
        return Sample(self.variables, 2 ** int(math.log2(most)), sampling.seed)

    def _grid(self) -> tuple[float, Grid | None]:
        try:
            grid = Grid(self.variables)
        except TooManyDesigns as error:
            return error.count, None
        return grid.count, grid

    def _too_many(self, count: float, budget: float) -> Fault:
        sizes = {v.path: len(v.values) or _most_values(v) for v in self.variables}
        widest = max(sizes, key=lambda path: sizes[path])
        message = f"designs of the grid: {count:.10g} (limit <= {budget:.10g}; sampling.budget)"
        helps = f"use fewer values of {widest} ({sizes[widest]:.0f} values) or increase sampling.budget (--budget)"
        return Fault("GL155", message, ("sampling", "budget"), helps)

    @cached_property
    def exhaustive(self) -> bool:
        """Whether all designs are computed."""
        return isinstance(self.order, Grid)

    @property
    def chunks(self) -> int:
        """How many chunks there are."""
        return -(-self.order.count // self.chunk_size)

    @cached_property
    def canonical(self) -> dict[str, Any]:
        """All that the result depends on, as plain data."""
        study = self.spec.model_dump(by_alias=True, mode="json", exclude={"name", "of"})
        study["sampling"]["budget"] = self.order.count
        return {"schema": SCHEMA, "chunk": self.chunk_size, **study, "command": self.base.command}

    @cached_property
    def canonical_text(self) -> str:
        """The canonical data as JSON with shortest doubles, from which `problem_of` makes the problem again."""
        return json.dumps(self.canonical, ensure_ascii=False, separators=(",", ":"))

    def named(self, name: str) -> Problem:
        """The same under a name, which no result depends on."""
        return replace(self, spec=self.spec.model_copy(update={"name": name}))

    @property
    def hash(self) -> str:
        """SHA-256 of the canonical data with sorted keys, but for sections whose order decides the result."""
        plain = {key: list(value.items()) if key in _ORDERED else value for key, value in self.canonical.items()}
        return hashlib.sha256(json.dumps(plain, sort_keys=True, ensure_ascii=False).encode()).hexdigest()

    def changes_of(self, index: int) -> list[tuple[str, Any]]:
        """Paths and values of a design by its index."""
        return self.changes(self.order.columns(np.array([index]))[:, 0])

    def changes(self, values: Any) -> list[tuple[str, Any]]:
        """Paths and values of a design as its file has them, from a column of `order.columns`."""
        found: list[tuple[str, Any]] = []
        for variable, value in zip(self.variables, values, strict=True):
            written = variable.written(float(value))
            found += [(path, written) for path in (variable.path, *variable.also)]
        return found


def numeric(variable: Variable) -> bool:
    return all(isinstance(value, (int, float)) and not isinstance(value, bool) for value in variable.values)


def _most_values(variable: Variable) -> float:
    return float(variable.count(1.0)) if not variable.times else math.inf
