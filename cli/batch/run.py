"""`gearlink batch`: every design file below some folders, one summary, the worst exit status.

A file's outcomes do not depend on the others: nothing that one design does can end the batch or change another.

Per design and command it writes a JSON report, its tables as CSV, and the plot where one is wanted.
"""

from __future__ import annotations

import gc
import hashlib
import io
import itertools
import json
import math
import os
import stat
import sys
from collections.abc import Callable, Generator, Iterable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Future, as_completed
from contextlib import closing, suppress
from dataclasses import replace
from functools import cache
from pathlib import Path
from time import perf_counter
from typing import TYPE_CHECKING, Any, TypeVar

from gearlink.cli.batch.options import BatchFormat, BatchOptions, Unchanged
from gearlink.cli.batch.summary import Fix, JsonLines, Outcome, counts, write_batch
from gearlink.cli.evaluate import build, exit_status, open_design, read_spec, refused_sections
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.files import CannotWrite, read_plain_file, safe_stem, stem_of, write_atomically
from gearlink.cli.options import Format
from gearlink.cli.parallel.workers import calm, workers
from gearlink.cli.process import processors
from gearlink.cli.program import program
from gearlink.cli.progress import progress
from gearlink.cli.reading.design_file import read_at_most
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.reading.loaded_file import LoadedFile, parse_path
from gearlink.cli.reading.places import by_kind, design_files, files_read
from gearlink.cli.render.csv_report import table_rows, write_rows
from gearlink.cli.render.json_report import as_json
from gearlink.core.base.kind import FileDesigns, Kind
from gearlink.core.base.report import Remedy, Report
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from gearlink.core.base.design import Design


def write_results(source: Path, design: Design, report: Report, options: BatchOptions) -> tuple[str, ...]:
    """Write STEM-COMMAND.json, STEM-COMMAND-TABLE.csv and the plot into the design's place below `out`; their names.

    Raises
        CannotWrite - where the folder or the disk does not take a file, or a link stands in the way
    """
    assert options.out is not None
    *folders, stem = place_of(source)
    folder = _folder(options.out, folders)
    results = folder / f"{stem}-{report.command.replace(' ', '-')}"
    written = [Path(f"{results}.json")]
    write_atomically(written[0], lambda stream: stream.write(as_json(report).encode()))
    for table in report.tables:
        text = io.StringIO()
        write_rows(table_rows(table), text)
        data = text.getvalue().encode()
        written.append(Path(f"{results}-{table.name}.csv"))
        write_atomically(written[-1], lambda stream, data=data: stream.write(data))  # type: ignore[misc]
    if options.design.plot:
        from gearlink.cli.views.figures.write import write_plot

        drawn = options.design._replace(out=folder)
        written.append(write_plot(report.command, design, drawn, stem=stem, checks=report.checks))
    return tuple(path.name for path in written)


def note_of(source: Path, options: BatchOptions) -> Path:
    """Where it is noted what a design's results were made of: beside them, by a name that none of them has.

    Raises
        CannotWrite - as `write_results`
    """
    assert options.out is not None
    *folders, stem = place_of(source)
    return _folder(options.out, folders) / f"{stem}~made-of.json"


def place_of(source: Path) -> tuple[str, ...]:
    """Folders below `out` and the stem of a design's result files; other files, other places.

    Notes
        They repeat the design file's own path. A part that is no safe name as it stands is followed by a hash of
        it, after a sign that safe names do not have; so the place depends on nothing but the path.

    Example
        >>> place_of(Path("designs/ty460.yaml"))
        ('designs', 'ty460')
        >>> place_of(Path("../a b/x.yml"))
        ('~up', 'a-b~c8687a08aa5d6ed2', 'x~5d2677742fcfe69b')
    """
    *folders, name = source.relative_to(source.anchor).parts
    stem = source.stem if source.suffix == ".yaml" else ""
    return (*(_safe(part, part) for part in folders), _safe(stem, name))


def _safe(wanted: str, whole: str) -> str:
    """`wanted` where that is a safe name, else one made of the whole part of the path."""
    if whole == "..":
        return "~up"
    if wanted and safe_stem(wanted) == wanted:
        return wanted
    return f"{safe_stem(Path(whole).stem)}~{hashlib.sha256(os.fsencode(whole)).hexdigest()[:16]}"


def require_places(files: Sequence[Path]) -> None:
    """Refuse files whose results would meet: `/a/b.yaml` and `a/b.yaml`.

    Raises
        DesignFileError - naming both
    """
    taken: dict[tuple[str, ...], Path] = {}
    for file in files:
        other = taken.setdefault(place_of(file), file)
        if other != file:
            message = f"{other} and this file would write their results into one folder"
            help_ = "name the files of one run either all from the current folder or all from the root"
            raise DesignFileError([Diagnostic("GL116", message, file=str(file), help=help_)])


def _folder(out: Path, parts: Sequence[str]) -> Path:
    """The folder of these parts below `out`, made where it is missing.

    Raises
        CannotWrite - where something else than a folder stands there, or a link, which could lead anywhere
    """
    folder = out
    try:
        out.mkdir(parents=True, exist_ok=True)
        for part in parts:
            folder /= part
            with suppress(FileExistsError):
                folder.mkdir()
            if not stat.S_ISDIR(folder.lstat().st_mode):
                what = "a symbolic link, which results do not follow" if folder.is_symlink() else "no folder"
                raise CannotWrite(f"cannot write below {folder}: it is {what}\nremove it, or give another --out")
    except OSError as error:
        raise CannotWrite(f"cannot write {folder}: {error.strerror or error}") from error
    return folder


def run_batch(places: Sequence[str], options: BatchOptions) -> int:
    """Run every design below the places, print the summary, give the worst exit status.

    Notes
        Interrupted, it shows what is finished and gives 130.
    """
    try:
        files = design_files(places)
        if options.out is not None:
            require_places(files)
        files = options.share_of(files)
    except DesignFileError as error:
        return _refused(error, options)
    try:
        lines = JsonLines(files, sys.stdout) if options.format is BatchFormat.JSONL else None
        results, interrupted = run_files(files, options, lines)
    except DesignFileError as error:  # of the cluster; those of files stand among the results
        return _refused(error, options)
    results.sort(key=lambda outcome: outcome.file)
    if lines is None:
        write_batch(results, options, sys.stdout)
    if options.format is BatchFormat.GITHUB and not options.design.quiet:
        print(counts(results), file=sys.stderr)  # else the log of a job that passes is empty
    if interrupted:
        print(f"interrupted after {len({r.file for r in results})} of {amount(len(files), 'file')}", file=sys.stderr)
        return ExitCode.INTERRUPTED
    return max((outcome.status for outcome in results), default=ExitCode.OK)


def _refused(error: DesignFileError, options: BatchOptions) -> int:
    """Say what is wrong before any file was run, in the form that the summary would have."""
    from gearlink.cli.render.errors import show_errors

    in_json = options.format in (BatchFormat.JSON, BatchFormat.JSONL)
    show_errors(error.diagnostics, options.design._replace(format=Format.JSON if in_json else options.design.format))
    return ExitCode.WRONG_INPUT


# Every command that one design file of a batch asks for; nothing that it does can end the batch

_AT_A_TIME, _ALL = 100, 1000
"""Files after which a process frees what the last ones left, and what all left: at most 0.3 MB each, but that of a
million files is much. Looking at all takes the longer the more results there are."""
_files = itertools.count(1)


def outcomes(path: Path, options: BatchOptions) -> list[Outcome]:
    """What became of each command that a file asks for; nothing raised here ends a batch."""
    number = next(_files)
    if number % _AT_A_TIME == 0:
        gc.collect(1 if number % _ALL else 2)
    if options.unchanged is not Unchanged.SKIP:
        return list(_Computing(path, options).outcomes())

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
            for self._command, wrong in refused_sections(loaded, kind, spec, added, designs):
                yield self._ended(ExitCode.WRONG_INPUT, errors=wrong)

    def _result(self, loaded: LoadedFile, kind: Kind, spec: Any, designs: FileDesigns, kept: list[Design]) -> Outcome:
        """The outcome of the command, its files written; its design joins those that are kept for other commands."""
        command, options = self._command, self._options
        only = options.findings_only
        design, report = build(loaded, kind, command, spec, options.design, findings_only=only, designs=designs)
        kept.append(design)
        wrote: tuple[str, ...] = ()
        if options.out is not None:
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
    from gearlink.cli.texts.codes import key_of

    bad = (check for check in report.checks if check.status != "pass")
    return tuple(loaded.place_in_file(parse_path(key_of(loaded.data, check)) or ("kind",)) for check in bad)


def _fixes(loaded: LoadedFile, report: Report) -> tuple[tuple[Fix, ...], ...]:
    return tuple(_fix(loaded, check.remedy) for check in report.checks if check.status != "pass")


def _fix(loaded: LoadedFile, remedy: Remedy) -> tuple[Fix, ...]:
    """The replacements that a remedy makes in the file; none where one of its keys has no plain value there."""
    places = [(loaded.value_in_file(parse_path(key) or ()), value) for key, value in remedy]
    found = [Fix(*place, _written(value)) for place, value in places if place is not None and value is not None]
    return tuple(found) if len(found) == len(remedy) else ()


def _written(value: float | str | tuple[float, ...]) -> str:
    return value if isinstance(value, str) else json.dumps(value)


# Several processes pay when the rest would take this long in one; starting them costs some hundredths of a second.
_WORTH_SECONDS = 0.15
_TRIED_FIRST, _FEWEST_TRIED = 16, 4
_CHUNKS_PER_JOB = 4
_CHUNK_SECONDS = 0.25
_LOOK_SECONDS = 0.2
T = TypeVar("T")


def run_files(
    files: Sequence[Path], options: BatchOptions, lines: JsonLines | None = None
) -> tuple[list[Outcome], bool]:
    """Outcomes of the files that were finished, and whether the user interrupted; `lines` are written meanwhile.

    Notes
        A sample from the whole list runs here, until it has taken as long as several processes take to pay, or the
        rest would, were each file as quick as the quickest; how long it takes decides whether they do for the rest.
    """
    results: list[Outcome] = []
    shown = progress(len(files), "designs", quiet=options.design.quiet)
    interrupted = False
    with shown as advance, calm() as asked, closing(_each(files, options)) as each:
        for done, found in each:
            kept = [outcome if outcome.shown else outcome.for_output(options.format) for outcome in found]
            if lines is not None:
                lines.add(kept)
                kept = [replace(outcome, shown="") for outcome in kept]
            results += kept
            advance(done)
            if asked():  # processes are ended at once, this one ends the file that it is at
                interrupted = True
                break
    if lines is not None:
        lines.end()
    return results, interrupted


def _each(files: Sequence[Path], options: BatchOptions) -> Generator[tuple[int, list[Outcome]]]:
    """How many files are finished, and their outcomes, as they come; none now and then where that takes long."""
    if options.dask:
        yield from _on_cluster(files, options)
        return
    start, tried, quickest = perf_counter(), 0, math.inf
    stride = 1 if options.jobs == 1 else max(1, len(files) // _TRIED_FIRST)
    for path in files[::stride]:
        begun = perf_counter()
        yield 1, outcomes(path, options)
        tried, now = tried + 1, perf_counter()
        quickest = min(quickest, now - begun)
        # a folder of searches takes them all; the first of each kind imports what the others find
        rest_takes = 0.5 * quickest * (len(files) - tried) if tried >= _FEWEST_TRIED else 0.0
        if options.jobs != 1 and max(now - start, rest_takes) > _WORTH_SECONDS:
            break
    rest = [path for i, path in enumerate(files) if i % stride or i >= tried * stride]
    seconds_each = (perf_counter() - start) / max(1, tried)
    jobs = _jobs(options, rest, seconds_each)
    if jobs > 1:
        yield from _in_processes(_chunks(rest, jobs, seconds_each), options, jobs)
    else:
        yield from ((1, outcomes(path, options)) for path in rest)


def _jobs(options: BatchOptions, rest: Sequence[Path], seconds_each: float) -> int:
    if options.jobs:
        return min(options.jobs, max(1, len(rest)))
    if seconds_each * len(rest) < _WORTH_SECONDS:
        return 1
    return processors()


def _chunks(files: Sequence[Path], jobs: int, seconds_each: float) -> list[Sequence[Path]]:
    """Shares of one kind each: large enough to pay, small enough that an interrupt need not wait for them."""
    by_time = len(files) * seconds_each / _CHUNK_SECONDS
    count = max(jobs * _CHUNKS_PER_JOB, int(by_time))
    return [[files[k] for k in part] for part in by_kind(files, -(-len(files) // count))]


def _in_processes(left: list[Sequence[Path]], options: BatchOptions, jobs: int) -> Iterator[tuple[int, list[Outcome]]]:
    """Chunks in processes, as they are finished.

    Notes
        A process that dies (memory, a signal) takes the executor with it. Chunks are begun in the order in which
        they are given, so the dead process was at one of the first `jobs` unfinished ones: their files are tried
        again one by one, each in a process of its own, and the other chunks in a new executor. Where the system
        gives no more processes or descriptors, this process does the rest.
    """
    while left:
        given: dict[Future[list[Outcome]], Sequence[Path]] = {}
        finished: set[int] = set()
        refused = False
        try:
            with workers(min(jobs, len(left))) as pool:
                with suppress(BrokenExecutor):
                    for files in left:
                        given[pool.submit(_chunk, files, options)] = files
                for future in _as_they_end(given):
                    if future is None:
                        yield 0, []
                    elif not isinstance(future.exception(), BrokenExecutor):
                        files = given.pop(future)  # with what it found
                        finished.add(id(files))
                        yield len(files), future.result()
        except OSError:  # at the first submission, which starts the processes
            refused = True
        left = [files for files in left if id(files) not in finished]
        if refused:  # what the error held of the pool, descriptors among it, is free here
            yield from ((1, outcomes(path, options)) for files in left for path in files)
            return
        for path in (path for files in left[:jobs] for path in files):
            yield 1, _alone(path, options)
        left = left[jobs:]


def _as_they_end(given: Iterable[Future[T]]) -> Iterator[Future[T] | None]:
    """Futures as they end, and None where none has for a while."""
    left = set(given)
    while left:
        try:
            for future in as_completed(left, _LOOK_SECONDS):
                left.discard(future)
                yield future
        except TimeoutError:
            yield None


def _on_cluster(files: Sequence[Path], options: BatchOptions) -> Iterator[tuple[int, list[Outcome]]]:
    """Every file by a worker of a Dask cluster, which must see it under the same path; what it loses, this process
    computes."""
    from gearlink.cli.parallel.shares import client

    with client(options.dask) as cluster:
        pool = cluster.get_executor()
        there = replace(options, out=options.out and options.out.absolute())
        given = {pool.submit(_chunk, [path.absolute()], there): path for path in files}
        for future in _as_they_end(given):
            if future is None:
                yield 0, []
                continue
            path = given[future]
            lost = future.exception() is not None
            found = _chunk([path], options) if lost else future.result()
            yield 1, [replace(outcome, file=str(path)) for outcome in found]


def _chunk(files: Sequence[Path], options: BatchOptions) -> list[Outcome]:
    found = [outcome for path in files for outcome in outcomes(path, options)]
    # A worker of a cluster has another path of the file, which is put right before the outcome is shown.
    return found if options.dask else [outcome.for_output(options.format) for outcome in found]


def _alone(path: Path, options: BatchOptions) -> list[Outcome]:
    """The outcomes of a file in a process of its own; if that dies too, the file is to blame."""
    try:
        with workers(1) as pool:
            return pool.submit(_chunk, [path], options).result()
    except (BrokenExecutor, OSError):
        message = "fault: the process that computed this file ended; `gearlink check` on this file may show why"
        wrong = Diagnostic("GL199", message, file=str(path))
        return [Outcome(str(path), "", stem_of(path), "", ExitCode.FAULT, None, (wrong,))]


_LARGEST = 1 << 26
_WRONG = (OSError, ValueError, LookupError, TypeError, AttributeError, RecursionError, DesignFileError)
"""What a note raises that is none, or of results that have changed."""


def taken_or_computed(path: Path, options: BatchOptions, compute: Callable[[], list[Outcome]]) -> list[Outcome]:
    """The outcomes of a file: taken from its results where the same would be made again, else computed and noted."""
    try:
        note = note_of(path, options)
    except CannotWrite:  # nor can a result be written
        return compute()
    with suppress(*_WRONG):
        return _taken(json.loads(read_plain_file(note, _LARGEST)), note.parent, path, options)
    with files_read() as read:
        outcomes = compute()
    if all(outcome.verdict == "pass" for outcome in outcomes):
        with suppress(CannotWrite, OSError):  # without a note it is computed again the next time
            data = _noted(read, outcomes, note.parent, options)
            write_atomically(note, lambda stream: stream.write(data))
    return outcomes


def _taken(noted: Any, folder: Path, path: Path, options: BatchOptions) -> list[Outcome]:
    """The outcomes that a note stands for.

    Raises
        one of _WRONG
    """
    wrote = {name: read_plain_file(folder / Path(name).name, _LARGEST) for name in noted["wrote"]}
    read = {name: read_at_most(name, _LARGEST) for name in noted["read"] if os.path.isfile(name)}
    if noted != {"made_by": _made_by(options), "read": _sums(read), "wrote": _sums(wrote)} or str(path) not in read:
        raise ValueError("something has changed")
    shown = options.format in (BatchFormat.JSON, BatchFormat.JSONL)
    reports = [json.loads(data) for name, data in wrote.items() if name.endswith(".json")]
    return [
        Outcome(str(path), r["kind"], r["name"], r["command"], ExitCode.OK, unchanged=r if shown else {})
        for r in reports
    ]


def _noted(read: dict[str, bytes], outcomes: Sequence[Outcome], folder: Path, options: BatchOptions) -> bytes:
    """The note of results that have just been written."""
    names = [name for outcome in outcomes for name in outcome.wrote]
    wrote = {name: read_plain_file(folder / name, _LARGEST) for name in names}
    noted = {"made_by": _made_by(options), "read": _sums(read), "wrote": _sums(wrote)}
    return json.dumps(noted, indent=1).encode()


def _sums(files: dict[str, bytes]) -> dict[str, str]:
    return {name: hashlib.sha256(data).hexdigest() for name, data in files.items()}


def _made_by(options: BatchOptions) -> str:
    """Of the program, and of every option that decides a result."""
    design = options.design
    decides = (
        options.added,
        design.strict,
        design.overrides,
        design.samples,
        design.plot,
        design.plot_format,
        design.dpi,
    )
    return hashlib.sha256(ascii((_program(), decides)).encode()).hexdigest()


@cache
def _program() -> tuple[tuple[str, str], ...]:
    return tuple(program().items())
