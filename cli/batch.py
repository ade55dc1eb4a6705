"""Every design file below some folders: each does what it asks for, one summary, the worst exit status."""

from __future__ import annotations

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from gearlink.cli.design_file import DesignFileError
from gearlink.cli.diagnostics import Diagnostic
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.options import Format, Options
from gearlink.cli.run import build, exit_status, open_design, read_spec
from gearlink.core.report import Report

_ENDINGS = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one command on one design file."""

    file: str
    kind: str
    name: str
    command: str
    status: int
    report: Report | None = None
    errors: tuple[Diagnostic, ...] = ()

    @property
    def verdict(self) -> str:
        """One word: pass, warn, fail, error or fault."""
        if self.report is None:
            return "error" if self.status == ExitCode.WRONG_INPUT else "fault"
        found = {check.status for check in self.report.checks}
        return "fail" if self.status != ExitCode.OK or "fail" in found else "warn" if "warn" in found else "pass"

    @property
    def finding(self) -> str:
        """The first thing to mend, or nothing."""
        if self.errors:
            return f"{self.errors[0].line}:{self.errors[0].column} {self.errors[0].code}: {self.errors[0].message}"
        if self.report is None:
            return ""
        worst = [c for wanted in ("fail", "warn") for c in self.report.checks if c.status == wanted]
        return f"{worst[0].code} {worst[0].name}: {worst[0].message}" if worst else ""


def design_files(places: Sequence[str]) -> list[Path]:
    """Design files named, or found below the folders named; sorted, each once.

    Raises
        DesignFileError - for a place that does not exist, or folders without a design file
    """
    found: dict[Path, None] = {}
    for place in places:
        path = Path(place)
        if path.is_dir():
            below = sorted(p for p in path.rglob("*") if p.suffix in _ENDINGS and p.is_file() and not _hidden(p, path))
            found.update(dict.fromkeys(below))
        elif path.exists():
            found[path] = None
        else:
            raise DesignFileError([Diagnostic("GL101", "no such file or folder", file=place, line=1, column=1, key="")])
    if not found:
        message = f"no design file ({', '.join(_ENDINGS)}) below"
        raise DesignFileError([Diagnostic("GL101", message, file=", ".join(places), line=1, column=1, key="")])
    return list(found)


def _hidden(path: Path, root: Path) -> bool:
    return any(part.startswith(".") for part in path.relative_to(root).parts)


def outcomes(path: Path, options: Options) -> Iterator[Outcome]:
    """What became of each command that a file asks for; nothing raised here ends a batch."""
    file, kind_name, name, command = str(path), "", path.stem, ""
    try:
        loaded, kind = open_design(file, options)
        kind_name = kind.name
        spec = read_spec(loaded, kind, file)
        name = spec.name
        for command in spec.commands():
            try:
                design, report = build(loaded, kind, command, spec, options)
                if options.plot:
                    from gearlink.cli.plots.write import write_plot

                    write_plot(command, design, options)
                yield Outcome(file, kind_name, name, command, exit_status(report, strict=options.strict), report)
            except DesignFileError as error:
                yield _error(file, kind_name, name, command, error.diagnostics)
            except CannotWrite as error:
                yield _error(file, kind_name, name, command, [_plain("GL116", str(error), file)])
    except DesignFileError as error:
        yield _error(file, kind_name, name, command, error.diagnostics)
    except Exception as fault:
        message = f"fault of the program: {type(fault).__name__}: {fault}"
        yield Outcome(file, kind_name, name, command, ExitCode.FAULT, None, (_plain("GL199", message, file),))


def _plain(code: str, message: str, file: str) -> Diagnostic:
    return Diagnostic(code, message, file=file, line=1, column=1, key="")


def _error(file: str, kind: str, name: str, command: str, errors: Sequence[Diagnostic]) -> Outcome:
    return Outcome(file, kind, name, command, ExitCode.WRONG_INPUT, None, tuple(errors))


def run_batch(places: Sequence[str], options: Options) -> int:
    """Run every design below the places, print the summary, give the worst exit status."""
    try:
        files = design_files(places)
    except DesignFileError as error:
        from gearlink.cli.render.errors import show_errors

        show_errors(error.diagnostics, options)
        return ExitCode.WRONG_INPUT
    results = [outcome for path in files for outcome in outcomes(path, options)]
    if options.format is Format.JSON:
        from gearlink.cli.render.batch_report import batch_as_json

        sys.stdout.write(batch_as_json(results) + "\n")
    else:
        from gearlink.cli.render.batch_report import show_batch

        show_batch(results, options)
    return max(outcome.status for outcome in results)


def summary(results: Sequence[Outcome]) -> dict[str, Any]:
    """How many designs came out how."""
    counts = dict.fromkeys(("pass", "warn", "fail", "error", "fault"), 0)
    for outcome in results:
        counts[outcome.verdict] += 1
    return counts
