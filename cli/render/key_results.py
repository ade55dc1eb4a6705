"""The key results of a command on the terminal: what was asked for beside what was reached, and checks that do not pass.

Written without rich where all checks pass: its import takes longer than most designs.
"""

from __future__ import annotations

import os
import sys
from shutil import get_terminal_size

from gearlink.cli.options import Options
from gearlink.cli.printable import visible
from gearlink.cli.render.numbers import drawn, quiet, scales
from gearlink.core.base.key_results import KeyResult
from gearlink.core.base.report import Report
from gearlink.core.base.wording import amount

_BOLD, _GREEN, _PLAIN = "\x1b[1m", "\x1b[32m", "\x1b[0m"
_WIDE = 110
"""Columns of a terminal that show the meaning of each quantity."""


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
        verdict = f"checks: {len(report.checks)} pass"
        print(f"{_GREEN}{verdict}{_PLAIN}" if coloured else verdict)


def _show_rest(report: Report, options: Options) -> None:
    from gearlink.cli.render.terminal import console_for, show_findings, show_table

    console = console_for(options)
    for table in report.tables:
        show_table(table, console, scale=scales(report), digits=options.digits)
    show_findings(report, console, passed=False)


def _coloured(options: Options) -> bool:
    return options.color and sys.stdout.isatty() and "NO_COLOR" not in os.environ and os.environ.get("TERM") != "dumb"


def _lines(report: Report, options: Options) -> list[str]:
    """A line for each key result: title, value, unit and what was asked for; its name where the title is another."""
    scale = scales(report)
    values = [drawn(quiet(q.value, scale.get(q.unit, 0.0)), q.unit, options.digits) for q, *_ in report.key]
    tails = [_tail(each) for each in report.key]
    names = max(len(each.title) for each in report.key)
    width = max(map(len, values))
    behind = max(map(len, tails))
    lines = []
    for each, value, tail in zip(report.key, values, tails, strict=True):
        line = f"{visible(each.title):<{names}}  {visible(value):>{width}}"
        rest = f"{tail:<{behind}}  {_aside(each)}" if _aside(each) else tail
        lines.append(f"{line} {rest}".rstrip())
    return lines


def _tail(each: KeyResult) -> str:
    """Unit, and what was asked for."""
    unit = "" if each.quantity.unit == "1" else each.quantity.unit
    return f"{unit} ({each.how} {each.asked:.12g})".lstrip() if each.asked is not None else unit


def _aside(each: KeyResult) -> str:
    """The name of a result that is called otherwise, in a wide terminal the meaning as well."""
    name = each.quantity.name if each.title != each.quantity.name else ""
    if get_terminal_size((80, 24)).columns < _WIDE:
        return name
    return f"{name}: {each.quantity.words}" if name else each.quantity.words


def _more(report: Report) -> str:
    """What --all would show besides."""
    quantities = sum(q.value != [] for q in report.quantities) - len(report.key)
    parts = [
        *([amount(quantities, "more quantity", "more quantities")] if quantities > 0 else []),
        *([amount(len(report.left_out), "table" if quantities > 0 else "more table")] if report.left_out else []),
    ]
    return ", ".join(parts)
