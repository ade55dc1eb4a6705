"""The key results of a command on the terminal: what was asked for beside what was reached, and failed checks.

Written without rich where all checks pass: its import takes longer than most designs.
"""

from __future__ import annotations

import os
import sys
from collections.abc import Sequence
from shutil import get_terminal_size

from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.render.numbers import drawn, number, quiet, scales
from gearlink.core.base.key_results import KeyResult
from gearlink.core.base.report import Report
from gearlink.core.base.wording import amount

_BOLD, _GREEN, _PLAIN = "\x1b[1m", "\x1b[32m", "\x1b[0m"
_WIDE = 110
"""Columns of a terminal that show the meaning of each quantity."""
_LONGEST = (18, 12)
"""Characters of a value in the column of values, where there is room for them and where there is not."""


def show_key_results(report: Report, options: Options) -> None:
    """Print the key results of a report, the tables that stand beside them, and the checks that do not pass."""
    coloured = _coloured(options)
    heading = f"{visible(' '.join(report.name.split()))}: {report.command} ({report.kind})"
    print(f"{_BOLD}{heading}{_PLAIN}" if coloured else heading)
    print("\n".join(_lines(report, options)))
    if more := _more(report):
        print(f"{more}: --all")
    passed = all(check.status == "pass" for check in report.checks)
    if report.tables or not passed:
        _show_rest(report, options)
    elif report.checks:
        verdict = f"{report.counted}: {len(report.checks)} pass"
        print(f"{_GREEN}{verdict}{_PLAIN}" if coloured else verdict)


def _show_rest(report: Report, options: Options) -> None:
    from gearlink.cli.render.terminal import console_for, show_findings, show_table

    console = console_for(options)
    for table in report.tables:
        if table.data and not len(table.data[0]):
            continue
        show_table(table, console, scale=scales(report), digits=options.digits)
    show_findings(report, console, passed=False)


def _coloured(options: Options) -> bool:
    return options.color and sys.stdout.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"


def _lines(report: Report, options: Options) -> list[str]:
    """A line for each key result: title, value, unit and what was asked for; its name where the title is another.

    In a narrow terminal lists run on in further lines, and names that do not fit are left out.
    """
    scale = scales(report)
    values = [visible(drawn(quiet(q.value, scale.get(q.unit, 0.0)), q.unit, options.digits)) for q, *_ in report.key]
    columns = get_terminal_size((80, 24)).columns
    laid = [_laid(report.key, values, longest, columns >= _WIDE) for longest in _LONGEST]
    lines = next((lines for lines in laid if all(len(named) <= columns for _, named, _ in lines)), laid[-1])
    best = [next((form for form in forms if len(form) <= columns), forms[-1]) for forms in lines]
    indent = " " * (2 + max(len(each.title) for each in report.key))
    return [part for line in best for part in _folded(line, columns, indent)]


def _folded(line: str, columns: int, indent: str) -> list[str]:
    """A line, or a long list in lines below each other: texts one by one, numbers as many as there is space for."""
    if len(line) <= columns or " " not in line[len(indent) :]:
        return [line]
    if "; " in line:
        first, *others = line.split("; ")
        return [f"{first};", *(f"{indent}{each};" for each in others[:-1]), f"{indent}{others[-1]}"]
    from textwrap import wrap

    return wrap(line, columns, subsequent_indent=indent, break_long_words=False, break_on_hyphens=False)


def _laid(key: Sequence[KeyResult], values: Sequence[str], longest: int, wide: bool) -> list[tuple[str, str, str]]:
    """Each line with meaning and name, with the name, and without; values below each other but for longer ones."""
    tails = [_tail(each) for each in key]
    names = [each.quantity.name if each.title != each.quantity.name else "" for each in key]
    titles = max(len(each.title) for each in key)
    width = max((len(value) for value in values if len(value) <= longest), default=0)
    behind = max((len(tail) for tail, name in zip(tails, names, strict=True) if name or wide), default=0)
    lines = []
    for each, value, tail, name in zip(key, values, tails, names, strict=True):
        plain = f"{visible(each.title):<{titles}}  {value:>{width}} {tail:<{behind}}"
        meaning = ": ".join(filter(None, (name, each.quantity.words))) if wide else name
        lines.append((f"{plain}  {meaning}".rstrip(), f"{plain}  {name}".rstrip(), plain.rstrip()))
    return lines


def _tail(each: KeyResult) -> str:
    """Unit, and what was asked for."""
    unit = "" if each.quantity.unit == "1" else each.quantity.unit
    return f"{unit} ({each.how} {number(each.asked, 6)})".lstrip() if each.asked is not None else unit


def _more(report: Report) -> str:
    """What --all would show besides."""
    quantities = sum(q.value != [] for q in report.quantities) - len(report.key)
    parts = [
        *([amount(quantities, "more quantity", "more quantities")] if quantities > 0 else []),
        *([amount(len(report.left_out), "table" if quantities > 0 else "more table")] if report.left_out else []),
    ]
    return ", ".join(parts)
