"""A study as a design: its results are counts, the front, and why it is no larger."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import Any

from gearlink.core.base.design import Design, Outline, placed
from gearlink.core.base.report import Check, Shown, Status, Table
from gearlink.core.base.results import cached_property, keep
from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import amount
from gearlink.core.studies.codes import FEASIBLE, RANGE_END
from gearlink.core.studies.explore.chunks import Miss, chunk_of, together
from gearlink.core.studies.explore.front import SHOWN, Found
from gearlink.core.studies.explore.order import Variable
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.explore.problem import Problem
from gearlink.core.studies.study.spec import StudySpec

_FEW = 0.01
_EDGE = 1e-9
_FARTHER = 0.01  # of a range: beyond its end


class Exploration(Design):
    """A study; its chunks are computed here one after the other, unless `found` brings them."""

    kind = "study"
    spec: StudySpec
    checks_need_search = True
    repairable = False
    outlines = {
        "explore": Outline(
            ("designs", "refused", "feasible", "front_size", "kept", "shown", "exhaustive", "knee"),
            ("feasible-designs", "range-end"),
            ("front", "why"),
        )
    }

    def __init__(self, spec: StudySpec, found: Found | None = None) -> None:
        super().__init__(spec)
        if found is not None:
            keep(self, problem=found.problem, found=found)

    @cached_property
    def problem(self) -> Problem:
        """The study made ready.

        Raises
            WrongStudy
        """
        return problem(self.spec)

    @cached_property
    def found(self) -> Found:
        """What was found."""
        made = self.problem
        return Found.of(made, together(made, (chunk_of(made, number) for number in range(made.chunks))))

    def require(self, _command: str) -> None:
        """Make the study ready: what is wrong with its file, and whether there are designs to compute.

        Raises
            WrongStudy
        """
        _ = self.problem.order

    designs: int = placed("found.total.designs")

    @property
    def refused(self) -> int:
        """Designs without a mechanism, or without one of the objectives."""
        misses = self.found.total.misses
        return sum(miss.fails for name, miss in misses.items() if name.startswith("refused "))

    feasible: int = placed("found.total.feasible")
    front_size: int = placed("found.front_size")

    @property
    def kept(self) -> int:
        """Boxes of the front."""
        return len(self.found.rows)

    @property
    def shown(self) -> int:
        """Rows that a terminal shows."""
        return min(self.kept, SHOWN)

    exhaustive: bool = placed("problem.exhaustive")
    knee: int | None = placed("found.knee")

    def table_front(self, _samples: int | None = None) -> Table:
        """The kept designs, sorted by the first objective."""
        rows, made = self.found.rows, self.problem
        columns: dict[str, tuple[Any, str]] = {"index": ([row.index for row in rows], "1")}
        units = made.base.units
        for i, variable in enumerate(made.variables):
            columns[variable.path] = ([row.variables[i][1] for row in rows], units.get(variable.path) or "1")
        for i, (name, _, unit) in enumerate(made.shown):
            columns[name] = ([row.figures[i] for row in rows], unit)
        return Table.of("front", columns)

    def table_why(self, _samples: int | None = None) -> Table:
        """Of each check, condition and refusal: designs that fail it, that fail it alone, and the nearest miss."""
        rows = self.found.why
        columns: dict[str, Sequence[Any]] = {
            "name": [name for name, _, _ in rows],
            "code": [code for _, code, _ in rows],
            "fails": [miss.fails for _, _, miss in rows],
            "alone_removes": [miss.alone for _, _, miss in rows],
            "nearest": [miss.value for _, _, miss in rows],
            "limit": [miss.limit for _, _, miss in rows],
            "unit": [miss.unit for _, _, miss in rows],
            "index": [miss.index for _, _, miss in rows],
        }
        return Table("why", tuple(columns), ("1",) * len(columns), tuple(columns.values()))

    def check_feasible_designs(self) -> Check:
        """GL161."""
        share = self.feasible / self.designs
        what = f"share of designs that satisfy {self.problem.asked}"
        note = "checks.must_pass: all requires them too" if self.problem.waived else ""
        name, _, worst = max(self.found.why, key=lambda row: row[2].alone, default=("", None, Miss()))
        aside = f"{self.feasible} of {self.designs}"
        aside += f"; {name} alone excludes {worst.alone}" if worst.alone and share < _FEW else ""
        status: Status = "pass" if share >= _FEW else "warn" if self.feasible else "fail"
        fix = f"relax {name}, or widen the ranges (table why)" if name else "widen the ranges"
        return FEASIBLE.check(status, what, share, _FEW, side=">=", aside=aside, fix=fix, note=note)

    def check_range_end(self) -> Iterator[Check]:
        """GL162 of each variable that kept designs have at an end of its range, where its key takes values beyond."""
        rows = self.found.rows
        for i, variable in enumerate(self.problem.variables):
            if variable.values or variable.times or variable.low == variable.high or not rows:
                continue
            values = [row.variables[i][1] for row in rows]
            for end, limit, way in zip(("lower", "upper"), _ends(variable), (-1.0, 1.0), strict=True):
                count = sum(abs(value - limit) <= _EDGE * max(1.0, abs(limit)) for value in values)
                if count and self._goes_on(variable, limit, way):
                    share_of_rows = f"{count} of {amount(len(rows), 'row')}"
                    what = f"{variable.path} at the {end} end of its range"
                    shown, fix = Shown(float(limit)), f"extend the range of {variable.path} beyond {limit:g}"
                    yield RANGE_END.check(
                        "warn", what, float(limit), float(limit), shown=shown, aside=share_of_rows, fix=fix
                    )

    def _goes_on(self, variable: Variable, limit: float, way: float) -> bool:
        """Whether the key of a variable takes a value beyond an end of its range, a whole one beside whole ends."""
        low, high = _ends(variable)
        whole = low.is_integer() and high.is_integer()
        step = variable.step or (1.0 if whole else _FARTHER * (high - low))
        farther = limit + way * step
        value = int(farther) if farther.is_integer() else farther
        return changed(self.problem.base.spec(), [(variable.path, value)]) is not None


def _ends(variable: Variable) -> tuple[float, float]:
    low, high = variable.ends()
    if variable.step is not None:
        high = low + variable.step * int((high - low) / variable.step + _EDGE)
    return float(low), float(high)
