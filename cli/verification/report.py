"""The result of `gearlink verify` as plain data."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from gearlink.cli.verification.computing import Outcome
from gearlink.core.base.report import Quantity, Report, Table

_NO_UNIT = "1"


@dataclass(frozen=True, slots=True)
class Verification(Report):
    """A report that is in order where every number is met."""

    @property
    def ok(self) -> bool:
        """False where a number is not met."""
        return all(self.tables[0].data[-2])


def report_of(outcomes: Sequence[Outcome]) -> Verification:
    """Counts, and a row for each number."""
    counts = {
        "cases": (len({each.case.id for each in outcomes}), "cases that were computed"),
        "numbers": (len(outcomes), "published numbers in them"),
        "met": (sum(each.met for each in outcomes), "numbers within their limit"),
    }
    columns: dict[str, Sequence[object]] = {
        "case": [each.case.id for each in outcomes],
        "source": [", ".join(filter(None, (each.case.source, each.case.place))) for each in outcomes],
        "name": [each.number.name for each in outcomes],
        "published": [each.number.value for each in outcomes],
        "computed": [each.computed for each in outcomes],
        "difference": [each.difference for each in outcomes],
        "limit": [each.number.limit for each in outcomes],
        "ok": [each.met for each in outcomes],
        "unit": [each.unit for each in outcomes],
    }
    return Verification(
        kind="verification",
        name="published-cases",
        command="verify",
        quantities=tuple(Quantity(name, count, _NO_UNIT, "", words) for name, (count, words) in counts.items()),
        tables=(Table.of("cases", {name: (data, _NO_UNIT) for name, data in columns.items()}),),
    )
