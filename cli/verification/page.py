"""The page "Validation": every published case with its numbers, and what is not met, with the reason."""

from __future__ import annotations

from collections.abc import Iterator
from itertools import groupby

from gearlink.cli.render.markdown_report import inline, markdown_table
from gearlink.cli.verification import digits
from gearlink.cli.verification.cases import Case, Source, sources
from gearlink.cli.verification.computing import Outcome, computed

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
                digits.computed(each),
                digits.difference(each),
                digits.limit(each),
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
