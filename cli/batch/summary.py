"""What became of the files of a batch, each and all: in a terminal, as JSON, CSV or Markdown."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, replace
from pathlib import Path, PurePath
from typing import IO, TYPE_CHECKING, Any
from xml.sax.saxutils import escape, quoteattr

from gearlink.cli.batch.options import BatchFormat, BatchOptions
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.printable import json_text, visible, visible_lines
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.render.json_report import FORMAT, as_plain
from gearlink.cli.texts.codes import explanations
from gearlink.core.base.report import Check, Report
from gearlink.core.base.wording import amount
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from rich.console import Console


@dataclass(frozen=True, slots=True)
class Fix:
    """A value of a design file to be replaced: its line, first column, the column after it, and the new text."""

    line: int
    column: int
    end: int
    text: str


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one command on one design file.

    `places` holds line and column of each check that did not pass, where the output of the batch shows them, `fixes`
    what its remedy replaces together; nothing where the file does not have all of its values.
    `wrote` names the files of its results; of a design that was not computed `unchanged` is the report in them, where
    the output of the batch shows reports. `shown` is the whole result as JSON, where the output shows that.
    """

    file: str
    kind: str
    name: str
    command: str
    status: int
    report: Report | None = None
    errors: tuple[Diagnostic, ...] = ()
    places: tuple[tuple[int, int], ...] = ()
    fixes: tuple[tuple[Fix, ...], ...] = ()
    seconds: float = 0.0
    wrote: tuple[str, ...] = ()
    unchanged: dict[str, Any] | None = None
    shown: str = ""

    def for_output(self, form: BatchFormat) -> Outcome:
        """No more than what the output needs of it: a report may take 30 kB of memory, and a batch has many."""
        shown = json_text(_entry(self)) if form in (BatchFormat.JSON, BatchFormat.JSONL) else ""
        unchanged: dict[str, Any] | None = None if self.unchanged is None else {}
        report = self.report and replace(self.report, quantities=(), checks=tuple(self.to_repair), tables=(), key=())
        return replace(self, shown=shown, unchanged=unchanged, report=report)

    @property
    def has_report(self) -> bool:
        """Whether the command gave a report, now or when its results were written."""
        return self.report is not None or self.unchanged is not None

    @property
    def verdict(self) -> str:
        """One word: pass, warn, fail, error or fault."""
        if self.unchanged is not None:
            return "pass"
        if self.report is None:
            return "error" if self.status == ExitCode.WRONG_INPUT else "fault"
        found = {check.status for check in self.to_repair}
        return "fail" if "fail" in found else "warn" if "warn" in found else "pass"

    @property
    def findings(self) -> list[str]:
        """Every error, or everything to repair, the worst first."""
        errors = [f"{error.line}:{error.column} {error.code}: " + "\n".join(error.lines) for error in self.errors]
        worst_first = sorted(self.to_repair, key=lambda check: check.status != "fail")
        return errors + ["\n".join((f"{c.code} {c.name}: {c.lines[0]}", *c.lines[1:])) for c in worst_first]

    @property
    def to_repair(self) -> list[Check]:
        """The checks that did not pass."""
        return [] if self.report is None else [c for c in self.report.checks if c.status != "pass"]


def summary(results: Sequence[Outcome]) -> dict[str, int]:
    """How many designs came out how."""
    counts = dict.fromkeys(("pass", "warn", "fail", "error", "fault"), 0)
    for outcome in results:
        counts[outcome.verdict] += 1
    return counts


_STYLE = {"pass": "green", "warn": "yellow", "fail": "bold red", "error": "bold red", "fault": "bold red"}
_HEADS = ("design", "command", "result", "finding")


def write_batch(results: Sequence[Outcome], options: BatchOptions, stream: IO[str]) -> None:
    """Write the summary in the format of the options."""
    if options.format is BatchFormat.TABLE:
        _show(results, options)
        return
    if options.format is BatchFormat.JSON:
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
        yield (", " if i else "") + outcome.shown
    yield "]}\n"


class JsonLines:
    """JSON lines in the order of the files: each is written as soon as those of all files before it are there."""

    def __init__(self, files: Sequence[Path], stream: IO[str]) -> None:
        self._left = deque(sorted(map(str, files)))
        self._stream = stream
        self._waiting: dict[str, list[str]] = {}

    def add(self, found: Sequence[Outcome]) -> None:
        """All outcomes of some files."""
        for outcome in found:
            self._waiting.setdefault(outcome.file, []).append(outcome.shown + "\n")
        while self._left and self._left[0] in self._waiting:
            self._stream.writelines(self._waiting.pop(self._left.popleft()))

    def end(self) -> None:
        """Write what waits for files that were not finished."""
        for file in sorted(self._waiting):
            self._stream.writelines(self._waiting.pop(file))


def _rows(results: Sequence[Outcome]) -> list[tuple[str, str, str, str]]:
    """A row per finding, one without it where there is none."""
    return [(o.file, o.command, o.verdict, finding) for o in results for finding in o.findings or [""]]


def _csv(results: Sequence[Outcome]) -> str:
    import io

    from gearlink.cli.render.csv_report import write_rows

    text = io.StringIO()
    write_rows([_HEADS, *_rows(results)], text)
    return text.getvalue()


def counts(results: Sequence[Outcome]) -> str:
    """How many results there are, and of each sort."""
    sorts = ", ".join(f"{n} {verdict}" for verdict, n in summary(results).items() if n) or "nothing done"
    return f"{amount(len(results), 'result')}: {sorts}"


def _markdown(results: Sequence[Outcome]) -> str:
    from gearlink.cli.render.markdown_report import markdown_table

    return markdown_table(_HEADS, _rows(results)) + f"\n\n{counts(results)}\n"


def _junit(results: Sequence[Outcome]) -> str:
    return as_junit(results)


def _sarif(results: Sequence[Outcome]) -> str:
    return as_sarif(results)


def _github(results: Sequence[Outcome]) -> str:
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
            console.print(Text(visible_lines(finding.split("\n"))))
    style = max((outcome.verdict for outcome in results), key=list(_STYLE).index, default="pass")
    console.print(Text(f"\n{counts(results)}", style=_STYLE[style]))


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


_SARIF_LEVEL = {"fail": "error", "warn": "warning"}


def _findings(outcome: Outcome) -> Iterator[tuple[str, str, str, str, int, int]]:
    """Status, code, name, message, line, column of everything to repair."""
    for error in outcome.errors:
        yield "fail", error.code, "input", "\n".join(error.lines), error.line, error.column
    for check, (line, column) in zip(outcome.to_repair, outcome.places, strict=True):
        yield check.status, check.code, check.name, "\n".join(check.lines), line, column


def as_junit(results: Sequence[Outcome]) -> str:
    """JUnit XML: a suite per design file, a case per command; a wrong file is an error, a failed check a failure."""
    by_file: dict[str, list[Outcome]] = {}
    for outcome in results:
        by_file.setdefault(outcome.file, []).append(outcome)
    lines = ['<?xml version="1.0" encoding="UTF-8"?>', '<testsuites name="gearlink">']
    for file, group in by_file.items():
        failures = sum(_is_failure(o) for o in group)
        errors = sum(not o.has_report for o in group)
        seconds = sum(o.seconds for o in group)
        lines.append(
            f'  <testsuite name={_attribute(file)} tests="{len(group)}" failures="{failures}" errors="{errors}" '
            f'time="{seconds:.6f}">'
        )
        for outcome in group:
            lines += _junit_case(outcome)
        lines.append("  </testsuite>")
    return "\n".join([*lines, "</testsuites>"]) + "\n"


def _is_failure(outcome: Outcome) -> bool:
    return outcome.has_report and outcome.status != 0


def _junit_case(outcome: Outcome) -> Iterator[str]:
    kind, name = outcome.kind or "unreadable", f"{outcome.name}: {outcome.command or 'read'}"
    case = f'<testcase classname={_attribute(kind)} name={_attribute(name)} time="{outcome.seconds:.6f}"'
    found = list(_findings(outcome))
    if outcome.has_report and not found:
        yield f"    {case} />"
        return
    tag = head = "system-out"
    if not outcome.has_report or _is_failure(outcome):
        tag = "failure" if outcome.has_report else "error"
        _, code, _, message, _, _ = found[0]
        head = f"{tag} message={_attribute(message)} type={_attribute(code)}"
    text = "\n".join(
        f"{outcome.file}:{line}:{column}: {code} {name}: {words}" for _, code, name, words, line, column in found
    )
    yield f"    {case}>"
    yield f"      <{head}>{escape(_xml_text(text))}</{tag}>"
    yield "    </testcase>"


def _attribute(text: str) -> str:
    return quoteattr(_xml_text(text))


_NOT_XML = re.compile("[\x00-\x08\x0b-\x1f\ud800-\udfff\ufffe\uffff]")


def _xml_text(text: str) -> str:
    """Without the control characters that XML 1.0 does not know."""
    return _NOT_XML.sub("?", text)


def as_sarif(results: Sequence[Outcome]) -> str:
    """SARIF 2.1.0: a result per finding, at the line of the design file."""
    entries: list[dict[str, Any]] = []
    rules: dict[str, dict[str, Any]] = {}
    for outcome in results:
        found = list(_findings(outcome))
        fixes: list[tuple[Fix, ...]] = [()] * len(outcome.errors) + list(outcome.fixes)
        fixes += [()] * (len(found) - len(fixes))
        for fix, (status, code, name, message, line, column) in zip(fixes, found, strict=True):
            rules.setdefault(code, _rule(code, name))
            region = {"startLine": line, "startColumn": column}
            place = {"artifactLocation": {"uri": _uri(outcome.file)}, "region": region}
            entry = {
                "ruleId": code,
                "level": _SARIF_LEVEL[status],
                "message": {"text": f"{outcome.name} ({outcome.command or 'read'}): {message}"},
                "locations": [{"physicalLocation": place}],
            }
            entries.append(entry | {"fixes": [_sarif_fix(outcome.file, fix)]} if fix else entry)
    driver = {"name": "gearlink", "version": VERSION, "rules": [rules[code] for code in sorted(rules)]}
    run = {"tool": {"driver": driver}, "columnKind": "unicodeCodePoints", "results": entries}
    schema = "https://json.schemastore.org/sarif-2.1.0.json"
    return json_text({"$schema": schema, "version": "2.1.0", "runs": [run]}, indent=1) + "\n"


def _sarif_fix(file: str, fix: Sequence[Fix]) -> dict[str, Any]:
    """The replacement of values, as SARIF writes it."""
    replacements = [
        {
            "deletedRegion": {"startLine": f.line, "startColumn": f.column, "endLine": f.line, "endColumn": f.end},
            "insertedContent": {"text": f.text},
        }
        for f in fix
    ]
    words = " and ".join(f"line {f.line}, column {f.column} by {f.text}" for f in fix)
    return {
        "description": {"text": f"replace {words}"},
        "artifactChanges": [{"artifactLocation": {"uri": _uri(file)}, "replacements": replacements}],
    }


def _rule(code: str, name: str) -> dict[str, Any]:
    known = explanations()[code]
    return {
        "id": code,
        "name": name,
        "shortDescription": {"text": known.title},
        "fullDescription": {"text": f"{known.what} {known.why}"},
        "help": {"text": known.remedy},
    }


def _uri(file: str) -> str:
    from urllib.parse import quote

    return quote(PurePath(file).as_posix().encode("utf-8", "surrogateescape"))


def as_github(results: Sequence[Outcome]) -> str:
    """Workflow commands, which GitHub shows at the line of the file.

    GitHub shows ten of a step: what several commands find is told once, with all of them.
    """
    commands: dict[tuple[Any, ...], list[str]] = {}
    for outcome in results:
        file = PurePath(outcome.file).as_posix()  # of Windows too: GitHub knows files by their path in the repository
        for finding in _findings(outcome):
            commands.setdefault((file, outcome.name, *finding), []).append(outcome.command or "read")
    lines = []
    for (file, design, status, code, name, message, line, column), found_by in commands.items():
        place = f"file={_property(file)},line={line},col={column},title={_property(f'{code} {name}')}"
        words = _data(f"{design} ({', '.join(dict.fromkeys(found_by))}): {message}")
        lines.append(f"::{_SARIF_LEVEL[status]} {place}::{words}")
    return "".join(line + "\n" for line in lines)


def _data(text: str) -> str:
    return "%0A".join(visible(line).replace("%", "%25") for line in text.split("\n"))


def _property(text: str) -> str:
    return _data(text).replace(":", "%3A").replace(",", "%2C")
