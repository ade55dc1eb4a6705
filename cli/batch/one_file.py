"""Every command that one design file of a batch asks for; nothing that it does can end the batch."""

from __future__ import annotations

import gc
import itertools
import json
from collections.abc import Iterator, Sequence
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any

from gearlink.cli.batch.options import BatchOptions, Unchanged
from gearlink.cli.batch.outcome import Fix, Outcome
from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, refused_sections
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, stem_of
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile, parse_path
from gearlink.core.kind import FileDesigns
from gearlink.core.report import Remedy, Report

if TYPE_CHECKING:
    from gearlink.core.design import Design
    from gearlink.core.kind import Kind


_AT_A_TIME = 100
"""Files after which a process frees what they left: at most 0.3 MB each, but that of a million files is much."""
_files = itertools.count(1)


def outcomes(path: Path, options: BatchOptions) -> list[Outcome]:
    """What became of each command that a file asks for; nothing raised here ends a batch."""
    if next(_files) % _AT_A_TIME == 0:
        gc.collect()
    if options.unchanged is not Unchanged.SKIP:
        return list(_Computing(path, options).outcomes())
    from gearlink.cli.batch.unchanged import taken_or_computed

    return taken_or_computed(path, options, lambda: list(_Computing(path, options).outcomes()))


class _Computing:
    """The results of one file, one after the other; what is raised becomes the outcome of its command."""

    def __init__(self, path: Path, options: BatchOptions) -> None:
        self._path, self._options, self._file = path, options, str(path)
        self._kind, self._name, self._command = "", stem_of(path), ""
        self._start = perf_counter()

    def outcomes(self) -> Iterator[Outcome]:
        """Every command of the file, then what its sections name and the design does not have."""
        try:
            yield from self._commands()
        except DesignFileError as error:
            yield self._ended(ExitCode.WRONG_INPUT, errors=error.diagnostics)
        except Exception as fault:
            message = f"fault of the program: {type(fault).__name__}: {fault}"
            yield self._ended(ExitCode.FAULT, errors=[Diagnostic("GL199", message, file=self._file)])

    def _ended(
        self,
        status: int,
        report: Report | None = None,
        errors: Sequence[Diagnostic] = (),
        places: tuple[tuple[int, int], ...] = (),
        fixes: tuple[tuple[Fix, ...], ...] = (),
        wrote: tuple[str, ...] = (),
    ) -> Outcome:
        seconds, named = perf_counter() - self._start, (self._file, self._kind, self._name, self._command)
        return Outcome(*named, status, report, tuple(errors), places, fixes, seconds, wrote)

    def _commands(self) -> Iterator[Outcome]:
        loaded, kind = open_design(self._file, self._options.design)
        self._kind = kind.name
        spec = read_spec(loaded, kind, self._file)
        self._name = spec.name
        designs = FileDesigns(kind, spec)
        kept: list[Design] = []
        refused = False
        added = tuple(_added(kind, spec, self._options))
        for self._command in (*spec.commands(), *added):
            try:
                yield self._result(loaded, kind, spec, designs, kept)
            except DesignFileError as error:
                refused = True
                yield self._ended(ExitCode.WRONG_INPUT, errors=error.diagnostics)
            except CannotWrite as error:
                yield self._ended(ExitCode.WRONG_INPUT, errors=[Diagnostic("GL116", str(error), file=self._file)])
            self._start = perf_counter()
        if not refused:
            for self._command, wrong in refused_sections(loaded, kind, spec, added):
                yield self._ended(ExitCode.WRONG_INPUT, errors=wrong)

    def _result(self, loaded: LoadedFile, kind: Kind, spec: Any, designs: FileDesigns, kept: list[Design]) -> Outcome:
        """The outcome of the command, its files written; its design joins those that are kept for other commands."""
        command, options = self._command, self._options
        only = options.findings_only
        design, report = build(loaded, kind, command, spec, options.design, findings_only=only, designs=designs)
        kept.append(design)
        wrote: tuple[str, ...] = ()
        if options.out is not None:
            from gearlink.cli.batch.out import write_results

            wrote = write_results(self._path, design, report, options)
        status = exit_status(report, strict=options.design.strict)
        if not options.with_places:
            return self._ended(status, report, wrote=wrote)
        return self._ended(status, report, (), _places(loaded, report), _fixes(loaded, report), wrote)


def _added(kind: Kind, spec: Any, options: BatchOptions) -> Iterator[str]:
    """What the user asked for besides, of a file that says how its sizes scatter."""
    scatters = getattr(spec, "tolerance", None) is not None
    yield from (command for command in options.added if scatters and command in kind.commands)


def _places(loaded: LoadedFile, report: Report) -> tuple[tuple[int, int], ...]:
    from gearlink.cli.texts.finding_keys import key_of

    bad = (check for check in report.checks if check.status != "pass")
    return tuple(loaded.place_in_file(parse_path(key_of(loaded.data, check)) or ("kind",)) for check in bad)


def _fixes(loaded: LoadedFile, report: Report) -> tuple[tuple[Fix, ...], ...]:
    return tuple(_fix(loaded, check.remedy) for check in report.checks if check.status != "pass")


def _fix(loaded: LoadedFile, remedy: Remedy) -> tuple[Fix, ...]:
    """The replacements that a remedy makes in the file; none where one of its keys has no plain value there."""
    places = [(loaded.value_in_file(parse_path(key) or ()), value) for key, value in remedy]
    found = [Fix(*place, _written(value)) for place, value in places if place is not None and value is not None]
    return tuple(found) if len(found) == len(remedy) else ()


def _written(value: float | str) -> str:
    return value if isinstance(value, str) else json.dumps(value)
