"""A report as PDF: pages of text and tables on A4, the sheet of each command as a page of its own."""

from __future__ import annotations

import io
from collections.abc import Iterable, Iterator, Sequence
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from gearlink.cli.render.numbers import drawn, number, quiet, readable_rows, scales, thinning
from gearlink.cli.views.page.sections import headings, shown_rows
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Report, Table

_A4 = (8.27, 11.69)
_ROWS, _LETTERS, _SIZE = 84, 108, 7.6
"""Lines of a page, letters of a line, and the size of the letters [pt]."""
_RED = "#C00000"
Line = tuple[str, str]
"""Words and their look: "" plain, "bold", "head", "fail"."""


def document(parts: Sequence[tuple[Design, Report]], text: str, changes: Sequence[str]) -> bytes:
    """The whole document; the same design gives the same bytes.

    Parameters
        parts : the designs and their reports, in the order of the file's commands
        text : the design file, which stands at the end
        changes : lines that say what differs from another design
    """
    from matplotlib.backends.backend_pdf import PdfPages

    from gearlink.cli.views.figures import write

    stream, name = io.BytesIO(), parts[0][0].spec.name
    with write.fonts_of(name), PdfPages(stream, metadata={"CreationDate": None, "Creator": "gearlink"}) as pages:
        heads = (("", ""), ("Changes", "head")) * bool(changes)
        for page in _pages([*_summary(parts), *heads, *_plain(changes)], name):
            pages.savefig(page)
        for design, report in parts:
            pages.savefig(write.draw(report.command, design, report.checks))
            for page in _pages(_results(report), f"{name}: {report.command}"):
                pages.savefig(page)
        for page in _pages([("Input", "head"), *_plain(text.rstrip().splitlines())], name):
            pages.savefig(page)
    return stream.getvalue()


def _plain(lines: Iterable[str]) -> Iterator[Line]:
    for line in lines:
        for part in wrap(line, _LETTERS, subsequent_indent="    ", drop_whitespace=False) or [""]:
            yield part, ""


def _summary(parts: Sequence[tuple[Design, Report]]) -> Iterator[Line]:
    """Name, kind, counts of checks, findings in words, key results."""
    design = parts[0][0]
    yield design.spec.name, "head"
    yield f"{design.spec.kind}, computed with gearlink {VERSION}", ""
    checks = [check for _, report in parts for check in report.checks]
    counts = {status: sum(check.status == status for check in checks) for status in ("fail", "warn", "pass")}
    yield "checks: " + (", ".join(f"{n} {status}" for status, n in counts.items() if n) or "none"), "bold"
    yield "", ""
    for status in ("fail", "warn"):
        for check in checks:
            if check.status == status:
                first = f"{status}  {check.code} {check.name}: "
                for k, words in enumerate(check.lines):
                    for part in wrap(first + words if k == 0 else words, _LETTERS, subsequent_indent="      "):
                        yield part, status if k == 0 else ""
    for _, report in parts:
        if report.key:
            yield "", ""
            yield f"{report.command}: key results", "head"
            for each in report.key:
                unit = "" if each.quantity.unit == "1" else each.quantity.unit
                asked = "" if each.asked is None else f"  ({each.how} {number(each.asked, 6)})"
                value = drawn(each.quantity.value, each.quantity.unit)
                yield f"{each.title.replace('_', ' '):<40}{value:>24} {unit}{asked}", ""


def _results(report: Report) -> Iterator[Line]:
    """Quantities, checks and tables of a command."""
    scale = scales(report)
    yield f"{report.command}: results", "head"
    for each in report.quantities:
        value = number(quiet(each.value, scale.get(each.unit, 0.0)), 9).replace("\n", "  ")
        unit = "" if each.unit == "1" else each.unit
        for part in wrap(f"{each.name.replace('_', ' '):<44} {value} {unit}", _LETTERS, subsequent_indent=" " * 45):
            yield part, ""
    if report.checks:
        yield "", ""
        yield f"{report.command}: checks", "head"
    for check in sorted(report.checks, key=lambda each: ("fail", "warn", "pass").index(each.status)):
        for part in wrap(f"{check.status}  {check.code} {check.name}: {check.message}", _LETTERS,
                         subsequent_indent="      "):  # fmt: skip
            yield part, check.status if check.status == "fail" else ""
    for table in report.tables:
        yield from _table(table, report)


def _table(table: Table, report: Report) -> Iterator[Line]:
    """A table in strips that are as wide as the page, its first column in each."""
    step, heads = shown_rows(table), headings(table)
    cells = [[cell.replace("\n", " ") for cell in row] for row in readable_rows(table, step, scales(report))]
    lines = [head.split(" ") for head in heads]
    widths = [
        min(max(*(len(word) for word in lines[i]), *(len(row[i]) for row in cells), 1) + 2, _LETTERS // 2)
        for i in range(len(heads) * bool(cells))
    ]
    for strip in _strips(widths):
        yield "", ""
        yield table.name.replace("_", " ") + (f", {thinning(step, table)}" if step > 1 else ""), "head"
        high = max(len(lines[i]) for i in strip)
        for level in range(high):
            above = [["", *lines[i]][max(0, level - high + len(lines[i]) + 1)] for i in strip]
            yield "".join(f"{words:>{widths[i]}}" for words, i in zip(above, strip, strict=True)), "bold"
        for row in cells:
            yield "".join(f"{row[i][: widths[i] - 2]:>{widths[i]}}" for i in strip), ""


def _strips(widths: Sequence[int]) -> list[list[int]]:
    """Columns that fit beside each other, each time after the first.

    Example
        >>> _strips([10, 60, 60])
        [[0, 1], [0, 2]]
    """
    strips: list[list[int]] = []
    for i in range(1, len(widths)):
        if not strips or widths[0] + sum(widths[k] for k in strips[-1][1:]) + widths[i] > _LETTERS:
            strips.append([0])
        strips[-1].append(i)
    return strips or [[0]] * bool(widths)


def _pages(lines: Iterable[Line], foot: str) -> Iterator[Figure]:
    """The lines on pages of A4; a heading is not the last line of its page."""
    every = list(lines)
    while every:
        count = min(_ROWS, len(every))
        while 1 < count < len(every) and every[count - 1][1] in ("head", "bold"):
            count -= 1
        yield _page(every[:count], foot)
        every = every[count:]


def _page(lines: Sequence[Line], foot: str) -> Figure:
    from matplotlib.figure import Figure

    made = Figure(figsize=_A4, facecolor="white")
    top, step = 1.0 - 0.6 / _A4[1], 1.24 * _SIZE / 72.0 / _A4[1]
    for row, (words, look) in enumerate(lines):
        style: dict[str, Any] = {"fontsize": _SIZE, "family": "monospace", "va": "top"}
        if look == "head":
            style |= {"fontsize": 1.25 * _SIZE, "family": "sans-serif", "fontweight": "bold"}
        elif look in ("bold", "fail", "warn"):
            style |= {"fontweight": "bold", "color": _RED if look == "fail" else "#222222"}
        raised = 0.25 * step if look == "head" else 0.0  # its letters are larger than the line
        if words:
            made.text(0.07, top - row * step + raised, words.replace("$", r"\$"), **style)
    made.text(0.93, 0.35 / _A4[1], foot.replace("$", r"\$"), fontsize=6.5, ha="right", color="#777777")
    return made
