"""The summary of a batch: a line per design and command, or JSON."""

from __future__ import annotations

import csv
import json
import sys
from collections.abc import Sequence

from rich.text import Text

from gearlink.cli.batch import Outcome, summary
from gearlink.cli.options import Format, Options
from gearlink.cli.render.json_report import FORMAT, as_plain
from gearlink.cli.render.markdown_report import markdown_table
from gearlink.cli.render.terminal import console_for, grid_for

_STYLE = {"pass": "green", "warn": "yellow", "fail": "bold red", "error": "bold red", "fault": "bold red"}
_HEADS = ("design", "command", "result", "finding")


def batch_as_json(results: Sequence[Outcome]) -> str:
    """Every outcome with its whole report or its errors."""
    designs = []
    for outcome in results:
        entry = {"file": outcome.file, "exit": outcome.status, "result": outcome.verdict}
        if outcome.report is not None:
            entry |= as_plain(outcome.report)
        else:
            entry |= {"kind": outcome.kind, "name": outcome.name, "command": outcome.command, "ok": False}
            entry["errors"] = [error.as_json() for error in outcome.errors]
        designs.append(entry)
    worst = max(outcome.status for outcome in results)
    whole = {"gearlink": FORMAT, "command": "batch", "ok": worst == 0, "summary": summary(results), "designs": designs}
    return json.dumps(whole, ensure_ascii=False, allow_nan=False)


def show_batch(results: Sequence[Outcome], options: Options) -> None:
    """The summary as a table on the terminal, as CSV or as Markdown."""
    rows = [(outcome.file, outcome.command, outcome.verdict, outcome.finding) for outcome in results]
    if options.format is Format.CSV:
        csv.writer(sys.stdout, lineterminator="\n").writerows([_HEADS, *rows])
        return
    counts = ", ".join(f"{n} {verdict}" for verdict, n in summary(results).items() if n)
    if options.format is Format.MARKDOWN:
        sys.stdout.write(markdown_table(_HEADS, rows) + f"\n\n{counts}\n")
        return
    console = console_for(options)
    grid = grid_for(console)
    for head in _HEADS[:3]:
        grid.add_column(head, no_wrap=head != "design", overflow="fold")
    for file, command, verdict, _ in rows:
        grid.add_row(file, command, Text(verdict, style=_STYLE[verdict]))
    console.print(grid)
    for file, command, verdict, finding in rows:
        if finding:
            console.print(Text(f"\n{file} ({command or 'not read'}), {verdict}:", style="bold"))
            console.print(Text(finding))
    console.print(Text(f"\n{len(results)} results: {counts}", style=_STYLE[_worst(results)]))


def _worst(results: Sequence[Outcome]) -> str:
    order = list(_STYLE)
    return order[max(order.index(outcome.verdict) for outcome in results)]
