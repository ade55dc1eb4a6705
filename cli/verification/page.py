"""The page "Validation": every published case with its numbers, and what is not met, with the reason.

Numbers have the digits that a limit leaves them.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from itertools import groupby

from gearlink.cli.render.markdown_report import inline, markdown_table
from gearlink.cli.verification.cases import Case, Source, decimals, sources
from gearlink.cli.verification.computing import Outcome, computed

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


_HEAD = """# Validation

Published numbers, and what gearlink computes for them. `gearlink verify` computes all of them again where it is
installed: {cases} cases with {numbers} numbers, of which {met} are met. This page is written by `make docs` from the
files in cli/verification/cases, which go with the program.

A number is met where the difference is at most half a unit of the last digit that its source prints. Where another
limit is taken, the reason is given below the table. Computed values have a digit more than the published ones.

| source | cases | numbers | met |
| --- | --- | --- | --- |
{sources}

What is not published but was computed a second time, to 30 and 50 digits, is the subject of [accuracy.md](accuracy.md).
"""
_DIFFERS = """## Not met, and why

These numbers are known to differ and are no cases of `gearlink verify`. What is wrong in the four source documents, and
in other published material, is listed in [errata.md](errata.md).
"""
_COLUMNS = ("number", "unit", "published", "computed", "difference", "limit")


def text() -> str:
    """The page."""
    known = list(sources())
    found = {source.name: list(computed(source.cases)) for source in known}
    every = [outcome for outcomes in found.values() for outcome in outcomes]
    rows = [
        f"| {inline(source.source)} | {len(source.cases)} | {len(found[source.name])} | {_met(found[source.name])} |"
        for source in known
    ]
    head = _HEAD.format(
        cases=sum(len(source.cases) for source in known), numbers=len(every), met=_met(every), sources="\n".join(rows)
    )
    parts = [head, *(part for source in known for part in _source(source, found[source.name]))]
    parts.append(_DIFFERS)
    parts += [part for source in known for part in _cases(list(computed(source.differs)), source.source)]
    return "\n".join(parts).rstrip() + "\n"


def _met(outcomes: list[Outcome]) -> int:
    return sum(each.met for each in outcomes)


def _source(source: Source, outcomes: list[Outcome]) -> Iterator[str]:
    yield f"## {inline(source.source)}\n\nRead at: {inline(source.read_at)}.\n"
    yield from _cases(outcomes)


def _cases(outcomes: list[Outcome], source: str = "") -> Iterator[str]:
    for _, group in groupby(outcomes, key=lambda each: each.case.id):
        own = list(group)
        yield f"### {own[0].case.id}\n\n{_where(own[0].case, source)}\n"
        rows = [
            (
                each.number.name,
                "" if each.unit == "1" else each.unit,
                each.number.published,
                computed_digits(each),
                difference(each),
                limit(each),
            )
            for each in own
        ]
        yield markdown_table(_COLUMNS, rows) + "\n"
        yield from _reasons(own)


def _where(case: Case, source: str) -> str:
    words = ". ".join(
        part.strip().rstrip(".") for part in (source, case.place[:1].upper() + case.place[1:], case.note) if part
    )
    return inline(f"{words}.")


def _reasons(outcomes: list[Outcome]) -> Iterator[str]:
    """Why limits are wider, and why numbers are not met."""
    reasons: dict[str, list[str]] = {}
    for each in outcomes:
        if each.number.because:
            names = reasons.setdefault(each.number.because, [])
            name = each.number.name.partition(" (")[0]
            names += [name] if name not in names else []
    whole = len({each.number.because for each in outcomes}) == 1
    for reason, names in reasons.items():
        of = "" if whole else f" of {inline(', '.join(names))}"
        yield f"Limit{of}: {inline(reason)}.\n"
    if why := outcomes[0].case.why:
        yield f"Why: {inline(why.rstrip('.'))}.\n"
