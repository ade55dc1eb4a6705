"""`gearlink check`: reads design files and runs their checks; every finding with its place in the file."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import partial
from itertools import repeat
from time import perf_counter
from typing import Any

from gearlink.cli.evaluate import open_design, read_spec, refusals_located, refused_sections
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.cli.printable import json_text
from gearlink.cli.process import processors
from gearlink.cli.progress import counted
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile, parse_path
from gearlink.cli.reading.places import by_kind, design_files
from gearlink.cli.render.errors import fitted, show_refusal
from gearlink.cli.render.json_report import FORMAT, plain_check
from gearlink.cli.texts.codes import key_of
from gearlink.core.base.design import Design, Outline
from gearlink.core.base.kind import FileDesigns, Kind
from gearlink.core.base.kinds import STUDY
from gearlink.core.base.report import Check
from gearlink.core.base.wording import amount

_STATUS = {"pass": ExitCode.OK, "warn": ExitCode.OK, "fail": ExitCode.FINDING, "error": ExitCode.WRONG_INPUT}


@dataclass(frozen=True, slots=True)
class Finding:
    """A check's outcome, or an error of the file, at a place in the design file.

    `status` is pass, warn, fail, error or fault; `check` is None for errors and faults.
    """

    status: str
    place: Diagnostic
    command: str = ""
    check: Check | None = None

    def exit_status(self, *, strict: bool) -> int:
        """What this finding alone would end the run with."""
        if strict and self.status == "warn":
            return ExitCode.FINDING
        return _STATUS.get(self.status, ExitCode.FAULT)


# Starting processes costs some hundredths of a second.
_WORTH_SECONDS = 0.15


def run_check(places: Sequence[str], options: Options, *, verbose: bool = False) -> int:
    """Check every design file of the places, print the findings, give the worst exit status."""
    try:
        files = ["-"] if "-" in places else []
        if named := [place for place in places if place != "-"]:
            files += map(str, design_files(named))
    except DesignFileError as error:
        return show_refusal(error, "", options)
    found, of_files = [], _of_all(files, options)
    words = f"checking {files[0]}" if len(files) == 1 else "checking"
    for _ in counted(range(len(files)), words, quiet=options.quiet):
        found += next(of_files)
    worst = max((finding.exit_status(strict=options.strict) for finding in found), default=ExitCode.OK)
    show_findings(found, len(files), options, ok=worst == ExitCode.OK, verbose=verbose)
    return worst


def _of_all(files: Sequence[str], options: Options) -> Iterator[list[Finding]]:
    """The findings of each file, in their order; by several processes as soon as the files take their time."""
    start = perf_counter()
    for k, file in enumerate(files):
        yield findings(file, options)
        left = files[k + 1 :]
        if len(left) > 1 and perf_counter() - start > _WORTH_SECONDS and (jobs := processors()) > 1:
            yield from _in_processes(left, options, jobs)
            return


def _in_processes(files: Sequence[str], options: Options, jobs: int) -> Iterator[list[Finding]]:
    """What no process gives, for the system has none or one died, is found here."""
    from concurrent.futures import BrokenExecutor

    from gearlink.cli.parallel.workers import workers

    parts = by_kind(files, -(-len(files) // (4 * jobs)))
    found: dict[int, list[Finding]] = {}
    done = 0
    try:
        with workers(min(jobs, len(parts))) as pool:
            for part, of_part in zip(parts, pool.map(_of_some, _named(parts, files), repeat(options)), strict=True):
                found.update(zip(part, of_part, strict=True))
                while done in found:
                    done += 1
                    yield found[done - 1]
    except (BrokenExecutor, OSError):
        yield from (found[k] if k in found else findings(files[k], options) for k in range(done, len(files)))


def _named(parts: Sequence[Sequence[int]], files: Sequence[str]) -> list[list[str]]:
    return [[files[k] for k in part] for part in parts]


def _of_some(files: Sequence[str], options: Options) -> list[list[Finding]]:
    """The findings of each of some files."""
    return [findings(file, options) for file in files]


def findings(file: str, options: Options) -> list[Finding]:
    """Every finding of a file, in the order of its lines; nothing raised here ends the run."""
    try:
        loaded, kind = open_design(file, options)
        spec = read_spec(loaded, kind, file)
        # Two commands may say the same of one place.
        found = {(finding.status, finding.place): finding for finding in _findings(loaded, kind, spec)}.values()
    except DesignFileError as error:
        return [Finding("error", diagnostic) for diagnostic in error.diagnostics]
    except Exception as fault:
        message = f"fault of the program: {type(fault).__name__}: {fault}"
        return [Finding("fault", Diagnostic("GL199", message, file=file, severity="fault"))]
    return sorted(found, key=lambda finding: (finding.place.line, finding.place.column))


def _findings(loaded: LoadedFile, kind: Kind, spec: Any) -> Iterator[Finding]:
    """Findings of every command that the file asks for; commands of one design class share its results.

    Notes
        A study is made ready, which refuses what is wrong with it; its search is the matter of `explore` and `batch`.
    """
    designs = FileDesigns(kind, spec)
    kept: list[Design] = []
    done: set[tuple[Any, str]] = set()
    refused = False
    for command in spec.commands():
        cls = kind.class_for(command, spec)
        try:
            with refusals_located(loaded, None if kind is STUDY else partial(designs.of, command), command):
                kept.append(design := designs.of(command))
                outline = Outline() if design.checks_need_search else design.outline(command)
                names = [name for name in outline.checks if (cls, name) not in done]
                design.prepare([*design.decisive(command), *names])
                done |= {(cls, name) for name in names}
                for check in (check for name in names for check in design.findings(command, name)):
                    yield Finding(check.status, _place(loaded, check), command, check)
                design.require(command)  # not every check would notice that there is no mechanism
        except DesignFileError as error:
            refused = True
            yield from (Finding("error", diagnostic, command) for diagnostic in error.diagnostics)
    if not refused:
        for command, wrong in refused_sections(loaded, kind, spec, designs=designs):
            yield from (Finding("error", diagnostic, command) for diagnostic in wrong)


def _place(loaded: LoadedFile, check: Check) -> Diagnostic:
    """The check as a diagnostic at the key that it is about."""
    diagnostic = loaded.report(check.code, check.message, parse_path(key_of(loaded.data, check)) or ("kind",))
    return replace(diagnostic, severity=check.status, fix=check.fix or "", note=check.note)


_STATUSES = ("pass", "warn", "fail", "error", "fault")
_HEADS = (
    "file", "line", "column", "key", "status", "code", "check", "command", "value", "limit", "unit", "message", "fix",
    "note",
)  # fmt: skip


def show_findings(found: Sequence[Finding], designs: int, options: Options, *, ok: bool, verbose: bool) -> None:
    """Print the findings and their count; passes only with `verbose`."""
    shown = [finding for finding in found if verbose or finding.status != "pass"]
    counts = {status: sum(finding.status == status for finding in found) for status in _STATUSES}
    if options.format is Format.JSON:
        plain = [_plain(each) | ({"help": each.place.help} if each.place.help else {}) for each in shown]
        whole = {"gearlink": FORMAT, "command": "check", "ok": ok, "summary": {"designs": designs, **counts}}
        print(json_text({**whole, "findings": plain, **_as_results(found)}))
        return
    if options.format is Format.CSV:
        from gearlink.cli.render.csv_report import write_rows

        rows = [
            [*list(_plain(each).values())[:-2], each.place.fix or each.place.help, "; ".join(each.place.note)]
            for each in shown
        ]
        write_rows([_HEADS, *rows], sys.stdout)
        return
    words = ", ".join(_counted(count, status) for status, count in counts.items() if count) or "no checks"
    verdict = f"{amount(designs, 'design')}: {words}"
    print(_as_markdown(shown, verdict) if options.format is Format.MARKDOWN else _as_text(shown, verdict))
    if shown and not options.quiet:
        print("`gearlink explain CODE` explains a code and how to repair the design", file=sys.stderr)


def _counted(count: int, status: str) -> str:
    """Errors and faults are things, the others verdicts."""
    return amount(count, status) if status in ("error", "fault") else f"{count} {status}"


def _as_results(found: Sequence[Finding]) -> dict[str, Any]:
    """All checks, and the errors if there are any, each in the form that the results of the other commands have."""
    checks = [{"file": item.place.as_json()["file"], **plain_check(item.check)} for item in found if item.check]
    errors = [finding.place.as_json() for finding in found if finding.status in ("error", "fault")]
    return {"checks": checks} | ({"errors": errors} if errors else {})


def _plain(finding: Finding) -> dict[str, Any]:
    """The finding as a flat record, in the order of `_HEADS`."""
    place, check = finding.place.as_json(), finding.check
    measured = (check.name, check.value, check.limit, check.unit) if check else ("", None, None, "")
    name, value, limit, unit = measured
    values = (place["file"], place["line"], place["column"], place["key"], finding.status, place["code"], name)
    fix, note = finding.place.fix or None, list(finding.place.note)
    return dict(zip(_HEADS, (*values, finding.command, value, limit, unit, place["message"], fix, note), strict=True))


def _as_text(shown: Sequence[Finding], verdict: str) -> str:
    encoding = sys.stdout.encoding or "utf-8"
    lines = []
    for finding in shown:
        name = f" {finding.check.name}" if finding.check else ""
        # A pass needs no line of the source: nothing is to be changed there.
        source = "" if finding.status == "pass" else finding.place.source
        text = replace(finding.place, code=finding.place.code + name, source=source).as_text(encoding)
        lines.append(fitted(text, sys.stdout))
    return "\n".join([*lines, verdict])


def _as_markdown(shown: Sequence[Finding], verdict: str) -> str:
    from gearlink.cli.render.markdown_report import markdown_table

    heads = ("place", "status", "code", "check", "finding")
    rows = []
    for finding in shown:
        plain = _plain(finding)
        place = f"{plain['file']}:{plain['line']}:{plain['column']}"
        rows.append((place, finding.status, plain["code"], plain["check"], "\n".join(finding.place.lines)))
    return (markdown_table(heads, rows) + "\n\n" if rows else "") + verdict
