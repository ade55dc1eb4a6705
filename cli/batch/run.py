"""Every design file below some folders: each does what it asks for, one summary, the worst exit status.

A file's outcomes do not depend on the others: nothing that one design does can end the batch or change another.
"""

from __future__ import annotations

import glob
import os
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from time import perf_counter

from gearlink.cli.batch.options import BatchOptions
from gearlink.cli.commands.design import build, exit_status, open_design, read_spec
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite
from gearlink.cli.reading.design_file import DesignFileError, LoadedFile, parse_path
from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.core.report import Check, Report

_ENDINGS = (".yaml", ".yml")


@dataclass(frozen=True, slots=True)
class Outcome:
    """What became of one command on one design file.

    `places` holds line and column of each check that did not pass, where the output of the batch shows them.
    """

    file: str
    kind: str
    name: str
    command: str
    status: int
    report: Report | None = None
    errors: tuple[Diagnostic, ...] = ()
    places: tuple[tuple[int, int], ...] = ()
    seconds: float = 0.0
    cached: bool = False

    @property
    def verdict(self) -> str:
        """One word: pass, warn, fail, error or fault."""
        if self.report is None:
            return "error" if self.status == ExitCode.WRONG_INPUT else "fault"
        found = {check.status for check in self.to_mend}
        return "fail" if "fail" in found else "warn" if "warn" in found else "pass"

    @property
    def finding(self) -> str:
        """The first thing to mend, or nothing."""
        if self.errors:
            return f"{self.errors[0].line}:{self.errors[0].column} {self.errors[0].code}: {self.errors[0].message}"
        if self.report is None:
            return ""
        worst = [c for wanted in ("fail", "warn") for c in self.to_mend if c.status == wanted]
        return f"{worst[0].code} {worst[0].name}: {worst[0].message}" if worst else ""

    @property
    def to_mend(self) -> list[Check]:
        """The checks that did not pass."""
        return [] if self.report is None else [c for c in self.report.checks if c.status != "pass"]


def design_files(places: Sequence[str]) -> list[Path]:
    """Design files named, matched by a pattern, or found below the folders named; each once, in a fixed order.

    Raises
        DesignFileError - for a place that does not exist, or folders without a design file
    """
    found: dict[Path, None] = {}
    for place in places:
        path = Path(place)
        matched = [path] if path.exists() else sorted(Path(name) for name in glob.glob(place, recursive=True))
        if not matched:
            raise DesignFileError([Diagnostic("GL101", "no such file or folder", file=place)])
        for match in matched:
            found.update(dict.fromkeys(_below(match) if match.is_dir() else [match]))
    if not found:
        message = f"no design file ({', '.join(_ENDINGS)}) below"
        raise DesignFileError([Diagnostic("GL101", message, file=", ".join(places))])
    return list(found)


def _below(folder: Path) -> list[Path]:
    found: list[Path] = []
    for root, folders, names in os.walk(folder):
        folders[:] = [name for name in folders if not name.startswith(".")]
        place = Path(root)
        wanted = (place / name for name in names if name.endswith(_ENDINGS) and not name.startswith("."))
        found += [path for path in wanted if path.is_file()]
    return sorted(found, key=lambda path: path.parts)


def outcomes(path: Path, options: BatchOptions) -> list[Outcome]:
    """What became of each command that a file asks for; nothing raised here ends a batch."""
    if options.cache is None:
        return list(_computed(path, options))
    from gearlink.cli.batch.cache import cached_outcomes

    return cached_outcomes(path, options, lambda: list(_computed(path, options)))


def _computed(path: Path, options: BatchOptions) -> Iterator[Outcome]:
    file, kind_name, name, command = str(path), "", path.stem, ""
    start = perf_counter()

    def ended(
        status: int,
        report: Report | None = None,
        errors: Sequence[Diagnostic] = (),
        places: tuple[tuple[int, int], ...] = (),
    ) -> Outcome:
        seconds = perf_counter() - start
        return Outcome(file, kind_name, name, command, status, report, tuple(errors), places, seconds)

    try:
        loaded, kind = open_design(file, options.design)
        kind_name = kind.name
        spec = read_spec(loaded, kind, file)
        name = spec.name
        for command in spec.commands():
            try:
                design, report = build(loaded, kind, command, spec, options.design, findings_only=options.findings_only)
                if options.out is not None:
                    from gearlink.cli.batch.out import write_results

                    write_results(path, design, report, options)
                places = _places(loaded, report) if options.with_places else ()
                yield ended(exit_status(report, strict=options.design.strict), report, places=places)
            except DesignFileError as error:
                yield ended(ExitCode.WRONG_INPUT, errors=error.diagnostics)
            except CannotWrite as error:
                yield ended(ExitCode.WRONG_INPUT, errors=[Diagnostic("GL116", str(error), file=file)])
            start = perf_counter()
    except DesignFileError as error:
        yield ended(ExitCode.WRONG_INPUT, errors=error.diagnostics)
    except Exception as fault:
        message = f"fault of the program: {type(fault).__name__}: {fault}"
        yield ended(ExitCode.FAULT, errors=[Diagnostic("GL199", message, file=file)])


def _places(loaded: LoadedFile, report: Report) -> tuple[tuple[int, int], ...]:
    from gearlink.cli.texts.finding_keys import key_of

    bad = (check for check in report.checks if check.status != "pass")
    return tuple(loaded.place_in_file(parse_path(key_of(loaded.data, check)) or ("kind",)) for check in bad)


def run_batch(places: Sequence[str], options: BatchOptions) -> int:
    """Run every design below the places, print the summary, give the worst exit status.

    Notes
        Interrupted, it shows what is finished and gives 130.
    """
    from gearlink.cli.batch.pool import run_files

    try:
        files = options.share_of(design_files(places))
    except DesignFileError as error:
        from gearlink.cli.render.errors import show_errors

        show_errors(error.diagnostics, options.design)
        return ExitCode.WRONG_INPUT
    results, interrupted = run_files(files, options)
    results.sort(key=lambda outcome: outcome.file)
    from gearlink.cli.batch.summary import write_batch

    write_batch(results, options, sys.stdout)
    if interrupted:
        print(f"interrupted after {len({r.file for r in results})} of {len(files)} files", file=sys.stderr)
        return ExitCode.INTERRUPTED
    return max((outcome.status for outcome in results), default=ExitCode.OK)


def summary(results: Sequence[Outcome]) -> dict[str, int]:
    """How many designs came out how."""
    counts = dict.fromkeys(("pass", "warn", "fail", "error", "fault"), 0)
    for outcome in results:
        counts[outcome.verdict] += 1
    return counts
