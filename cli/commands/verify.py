"""`gearlink verify`: the program computes published cases where it is installed."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from itertools import groupby
from typing import TYPE_CHECKING

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.cli.render.lists import hanging, width
from gearlink.cli.verification.cases import Case, decimals, names, sources
from gearlink.cli.verification.computing import Outcome, computed
from gearlink.core.base.errors import named
from gearlink.core.base.report import Quantity, Report, Table

if TYPE_CHECKING:
    from gearlink.cli.reading.diagnostics import Diagnostic


_FILE = "<command line>"


def run_verify(prefixes: Sequence[str], options: Options, *, everything: bool = False) -> int:
    """Compute the cases that begin with one of some prefixes, without a prefix all, and give the exit status.

    Parameters
        everything : bool - in the table form every number, as where prefixes are given
    """
    from gearlink.cli.progress import patience
    from gearlink.cli.render.errors import show_errors

    cases = [case for source in sources(prefixes) for case in source.cases]
    if unknown := _unknown(prefixes, [case.id for case in cases]):
        show_errors(unknown, options)
        return ExitCode.WRONG_INPUT
    with patience(f"computing {len(cases)} published cases", quiet=options.quiet):
        outcomes = list(computed(cases))
    report = report_of(outcomes)
    if options.format is Format.TABLE:
        print(as_text(outcomes, everything=everything or bool(prefixes)))
    else:
        from gearlink.cli.commands.design import print_report

        print_report(report, options)
    return ExitCode.OK if report.ok else ExitCode.FINDING


def _unknown(prefixes: Sequence[str], ids: Sequence[str]) -> list[Diagnostic]:
    from gearlink.cli.reading.diagnostics import Diagnostic

    return [
        Diagnostic(
            "GL115",
            f"no case begins with {named(prefix)}",
            _FILE,
            key=prefix,
            help=f"cases begin with: {', '.join(names())}",
        )
        for prefix in dict.fromkeys(prefixes)
        if not any(each.startswith(prefix.lower()) for each in ids)
    ]


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


_DOUBLE = 15
"""Digits of a double; the last is rounding."""


def computed_digits(outcome: Outcome) -> str:
    """The computed number with a digit more than is published, but none far below its limit, where rounding begins."""
    value = outcome.computed
    if value is None:
        return "-"
    size = 0 if value == 0.0 else math.floor(math.log10(abs(value))) + 1
    below = 1 - math.floor(math.log10(outcome.number.limit))
    places = min(1 - decimals(outcome.number.published), below, _DOUBLE - size - 1)
    return f"{value:.{max(places, 0)}f}"


def difference(outcome: Outcome) -> str:
    """The difference to two digits of its limit.

    A tenth of the limit is its last digit but one, so that what another processor rounds otherwise does not show.
    """
    found = outcome.difference
    if found is None:
        return "-"
    places = 1 - math.floor(math.log10(outcome.number.limit))
    shown = round(found, places)
    return _plain(shown + 0.0, places)


def limit(outcome: Outcome) -> str:
    """The limit."""
    return f"{outcome.number.limit:.3g}"


def share(outcome: Outcome) -> str:
    """The difference in percent of its limit."""
    return "-" if outcome.computed is None else f"{100.0 * outcome.share:.0f} %"


def _plain(value: float, places: int) -> str:
    if value == 0.0:
        return "0"
    return f"{value:.{max(places, 0)}f}" if places <= 7 else f"{value:.1e}"


_NAME_AT_LEAST = 8
_HEADS = ("published", "computed", "difference", "limit")


def as_text(outcomes: Sequence[Outcome], *, everything: bool = False) -> str:
    """Cases under their sources, and how many numbers are met.

    Parameters
        everything : bool - every number; else a line for each case, and the numbers that are off
    """
    lines: list[str] = []
    column = max(len(each.case.id) for each in outcomes)
    for source, group in groupby(outcomes, key=lambda each: each.case.source):
        lines += [hanging(source), *_cases(list(group), column, everything), ""]
    met = sum(each.met for each in outcomes)
    return "\n".join([*lines, f"{met} of {len(outcomes)} numbers met"])


def _cases(outcomes: Sequence[Outcome], column: int, everything: bool) -> Iterator[str]:
    for _, group in groupby(outcomes, key=lambda each: each.case.id):
        own = list(group)
        yield _case(own[0].case, own, column)
        shown = own if everything else [each for each in own if not each.met]
        if shown:
            yield from _numbers(shown)
            reasons = {each.number.because: None for each in shown if each.number.because}
            yield from (hanging(f"limit: {reason}", "    ", "    ") for reason in reasons if everything)
            refusals = {each.refusal: None for each in shown if each.refusal}
            yield from (hanging(f"refused: {refusal}", "    ", "    ") for refusal in refusals)


def _case(case: Case, outcomes: Sequence[Outcome], column: int) -> str:
    met = sum(each.met for each in outcomes)
    worst = max(outcomes, key=lambda each: each.share)
    count = f"{met} of {len(outcomes)}"
    line = f"  {case.id:<{column}}  {count:>8}  {share(worst):>5} of the limit"
    named = f"{line}: {worst.number.name}"
    return named if len(named) <= width() else line


def _numbers(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """A line for each number; names that do not fit stand on a line of their own."""
    rows = [
        (
            each.number.name + (f" [{each.unit}]" if each.unit not in ("", "1") else ""),
            (each.number.published, computed_digits(each), difference(each), limit(each)),
            "" if each.met else "  OFF",
        )
        for each in outcomes
    ]
    wide = [max(len(head), *(len(cells[i]) for _, cells, _ in rows)) for i, head in enumerate(_HEADS)]
    room = max(_NAME_AT_LEAST, width() - 4 - sum(wide) - 2 * len(wide) - 5)
    name_column = min(room, max(len(name) for name, _, _ in rows))
    yield _line("", _HEADS, wide, name_column, "")
    for name, cells, mark in rows:
        if len(name) > name_column:
            yield hanging(name, "      ", "    ")
            name = ""
        yield _line(name, cells, wide, name_column, mark)


def _line(name: str, cells: Sequence[str], wide: Sequence[int], column: int, mark: str) -> str:
    shown = "".join(f"  {cell:>{size}}" for cell, size in zip(cells, wide, strict=True))
    return f"    {name:<{column}}{shown}{mark}".rstrip()
