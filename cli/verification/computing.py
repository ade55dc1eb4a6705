"""Published cases computed: each number beside what its source prints."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from typing import TYPE_CHECKING, Any, NamedTuple

from gearlink.cli.verification.cases import Case, Number

if TYPE_CHECKING:
    from gearlink.core.design import Design

_ROUNDING = 1e-9
"""Of the limit, and of the place of a row: what a difference of doubles carries."""


class Outcome(NamedTuple):
    """One number computed.

    Fields
        computed : float, or None where the program has none
        unit : str
        refusal : str - why there is none
    """

    case: Case
    number: Number
    computed: float | None
    unit: str
    refusal: str = ""

    @property
    def difference(self) -> float | None:
        """Computed less published."""
        return None if self.computed is None else self.computed - self.number.value

    @property
    def share(self) -> float:
        """The difference as a share of its limit; infinite where nothing is computed."""
        return math.inf if self.difference is None else abs(self.difference) / self.number.limit

    @property
    def met(self) -> bool:
        """Whether the difference is within its limit."""
        return self.share <= 1.0 + _ROUNDING


def computed(cases: Iterable[Case]) -> Iterator[Outcome]:
    """The numbers of some cases, each case computed once.

    Example
        >>> from gearlink.cli.verification.cases import read
        >>> case = next(case for case in read("khurmi").cases if case.id == "khurmi-12.7-internal")
        >>> [(round(each.computed, 3), each.met) for each in computed([case])]
        [(28.035, True)]
    """
    from gearlink.core.errors import GearlinkError

    for case in cases:
        try:
            ask = _Kernel(case) if case.kernel else _Designed(case)
        except GearlinkError as error:
            yield from (Outcome(case, number, None, number.unit, str(error)) for number in case.numbers)
            continue
        for number in case.numbers:
            try:
                value, unit = ask.value(number)
            except GearlinkError as error:
                yield Outcome(case, number, None, number.unit, str(error))
                continue
            scaled = None if value is None else float(value) * number.scale
            yield Outcome(case, number, scaled, number.unit or unit)


class _Kernel:
    """Results of a case that a function computes."""

    def __init__(self, case: Case) -> None:
        from gearlink.cli.verification.kernels import KERNELS

        self._results = KERNELS[case.kernel](case.given)

    def value(self, number: Number) -> tuple[Any, str]:
        return _at(self._results[number.quantity], number.places), ""


class _Designed:
    """Results of a case that is a design."""

    def __init__(self, case: Case) -> None:
        from gearlink.cli.opening import design

        self._design: Design = design(case.command, **case.design)
        self._samples = case.samples
        self._tables: dict[str, tuple[tuple[str, ...], list[list[Any]], tuple[str, ...]]] = {}

    def value(self, number: Number) -> tuple[Any, str]:
        if number.table:
            return self._cell(number)
        found = self._design.quantity(number.quantity)
        return (None, "") if found is None else (_at(found.value, number.places), found.unit)

    def _cell(self, number: Number) -> tuple[Any, str]:
        if number.table not in self._tables:
            table = self._design.table(number.table, samples=self._samples)
            self._tables[number.table] = (table.columns, table.rows(), table.units)
        columns, rows, units = self._tables[number.table]
        at = columns.index(number.column)
        found = [row[at] for row in rows if _stands(dict(zip(columns, row, strict=True)), number.where)]
        return _at(found[0], number.places) if len(found) == 1 else None, units[at]


def _stands(row: Mapping[str, Any], where: Mapping[str, float | str]) -> bool:
    """Whether a row of a table is the one that is meant."""
    return all(
        row[column] == value
        if isinstance(value, str)
        else row[column] is not None and math.isclose(row[column], value, rel_tol=_ROUNDING, abs_tol=_ROUNDING)
        for column, value in where.items()
    )


def _at(value: Any, places: tuple[int, ...]) -> Any:
    for place in places:
        value = None if value is None else value[place]
    return value
