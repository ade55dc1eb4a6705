"""The summary of a batch: a line per design and command on the terminal, or a machine's format."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from typing import IO, TYPE_CHECKING, Any

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.batch.outcome import Outcome, summary
from gearlink.cli.printable import json_text, visible
from gearlink.cli.render.json_report import FORMAT, as_plain
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from rich.console import Console

_STYLE = {"pass": "green", "warn": "yellow", "fail": "bold red", "error": "bold red", "fault": "bold red"}
_HEADS = ("design", "command", "result", "finding")


def write_batch(results: Sequence[Outcome], options: BatchOptions, stream: IO[str]) -> None:
    """Write the summary in the format of the options."""
    if options.format is BatchFormat.TABLE:
        _show(results, options)
        return
    if options.format is BatchFormat.JSONL:
        stream.writelines(json_text(_entry(outcome)) + "\n" for outcome in results)
    elif options.format is BatchFormat.JSON:
        stream.writelines(_json(results))
    else:
        stream.write(_WRITERS[options.format](results))


def _entry(outcome: Outcome) -> dict[str, Any]:
    """An outcome with its whole report or its errors."""
    entry: dict[str, Any] = {"file": outcome.file, "exit": int(outcome.status), "result": outcome.verdict}
    entry |= {"seconds": round(outcome.seconds, 6), "unchanged": outcome.unchanged is not None}
    if outcome.unchanged is not None:
        return entry | outcome.unchanged
    if outcome.report is not None:
        return entry | as_plain(outcome.report)
    entry |= {"kind": outcome.kind, "name": outcome.name, "command": outcome.command, "ok": False}
    return entry | {"errors": [error.as_json() for error in outcome.errors]}


def _json(results: Sequence[Outcome]) -> Iterator[str]:
    """The whole in pieces: as one text it would stand in memory several times."""
    worst = max((outcome.status for outcome in results), default=0)
    whole = {"gearlink": FORMAT, "command": "batch", "ok": worst == 0, "summary": summary(results)}
    yield json_text(whole).removesuffix("}") + ', "designs": ['
    for i, outcome in enumerate(results):
        yield (", " if i else "") + json_text(_entry(outcome))
    yield "]}\n"


def _rows(results: Sequence[Outcome]) -> list[tuple[str, str, str, str]]:
    """A row per finding, one without it where there is none."""
    return [(o.file, o.command, o.verdict, finding) for o in results for finding in o.findings or [""]]


def _csv(results: Sequence[Outcome]) -> str:
    import io

    from gearlink.cli.render.csv_report import write_rows

    text = io.StringIO()
    write_rows([_HEADS, *_rows(results)], text)
    return text.getvalue()


def _counts(results: Sequence[Outcome]) -> str:
    counts = ", ".join(f"{n} {verdict}" for verdict, n in summary(results).items() if n) or "nothing done"
    return f"{amount(len(results), 'result')}: {counts}"


def _markdown(results: Sequence[Outcome]) -> str:
    from gearlink.cli.render.markdown_report import markdown_table

    return markdown_table(_HEADS, _rows(results)) + f"\n\n{_counts(results)}\n"


def _junit(results: Sequence[Outcome]) -> str:
    from gearlink.cli.batch.ci_reports import as_junit

    return as_junit(results)


def _sarif(results: Sequence[Outcome]) -> str:
    from gearlink.cli.batch.ci_reports import as_sarif

    return as_sarif(results)


def _github(results: Sequence[Outcome]) -> str:
    from gearlink.cli.batch.ci_reports import as_github

    return as_github(results)


_WRITERS: dict[BatchFormat, Callable[[Sequence[Outcome]], str]] = {
    BatchFormat.CSV: _csv,
    BatchFormat.MARKDOWN: _markdown,
    BatchFormat.JUNIT: _junit,
    BatchFormat.SARIF: _sarif,
    BatchFormat.GITHUB: _github,
}


def _show(results: Sequence[Outcome], options: BatchOptions) -> None:
    from gearlink.cli.render.terminal import console_for

    console = console_for(options.design)
    _show_table(results, console)
    from rich.text import Text

    for outcome in results:
        if outcome.findings:
            command = outcome.command or "not read"
            console.print(Text(f"\n{visible(outcome.file)} ({command}), {outcome.verdict}:", style="bold"))
        for finding in outcome.findings:
            console.print(Text(visible(finding)))
    style = max((outcome.verdict for outcome in results), key=list(_STYLE).index, default="pass")
    console.print(Text(f"\n{_counts(results)}", style=_STYLE[style]))


def _show_table(results: Sequence[Outcome], console: Console) -> None:
    from rich.text import Text

    from gearlink.cli.render.terminal import grid_for, show_grid

    grid = grid_for(console)
    grid.add_column("design", overflow="fold")
    for head in ("command", "result"):
        grid.add_column(head, no_wrap=True)
    grid.add_column("ms", justify="right", no_wrap=True)
    for o in results:
        time = "unchanged" if o.unchanged is not None else f"{1e3 * o.seconds:.0f}"
        grid.add_row(o.file, o.command, Text(o.verdict, style=_STYLE[o.verdict]), time)
    show_grid(grid, console)
