"""The result of `gearlink verify` on a terminal: a line for each case, under its source."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import groupby

from gearlink.cli.render.lists import hanging, width
from gearlink.cli.verification import digits
from gearlink.cli.verification.cases import Case
from gearlink.cli.verification.computing import Outcome

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
    line = f"  {case.id:<{column}}  {count:>8}  {digits.share(worst):>5} of the limit"
    named = f"{line}: {worst.number.name}"
    return named if len(named) <= width() else line


def _numbers(outcomes: Sequence[Outcome]) -> Iterator[str]:
    """A line for each number; names that do not fit stand on a line of their own."""
    rows = [
        (
            each.number.name + (f" [{each.unit}]" if each.unit not in ("", "1") else ""),
            (each.number.published, digits.computed(each), digits.difference(each), digits.limit(each)),
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
