"""`gearlink explore` from the study file, or from a store, to the page."""

from __future__ import annotations

import glob
import re
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from time import perf_counter
from typing import IO, Any

import yaml

from gearlink.cli.evaluate import exit_status, open_design, read_spec, require_command
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.exploring.options import Exploring
from gearlink.cli.exploring.store import (
    CannotStore,
    Kept,
    Memory,
    Result,
    chunks_of,
    is_store,
    of_another_program,
    opened,
    others,
    problem_in,
    ready,
)
from gearlink.cli.files import CannotWrite, require_folder, safe_stem, write_atomically
from gearlink.cli.options import Format, Options
from gearlink.cli.parallel.workers import calm, workers
from gearlink.cli.printable import visible
from gearlink.cli.process import WhileMuchIsComputed, processors
from gearlink.cli.progress import patience, progress
from gearlink.cli.reading.base_design import located
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.render.errors import show_errors, show_refusal
from gearlink.cli.render.numbers import number as written
from gearlink.core.base.report import Report, Table
from gearlink.core.base.wording import amount
from gearlink.core.studies.explore.chunks import computed, designs_of, together
from gearlink.core.studies.explore.exploration import Exploration
from gearlink.core.studies.explore.front import SHOWN, Found
from gearlink.core.studies.explore.preparing import problem
from gearlink.core.studies.explore.problem import Problem
from gearlink.core.studies.study.faults import BrokenPromise, WrongStudy

# Computing the chunks of a study: here, in processes, or on a cluster; what is finished is kept at once

_IN_FLIGHT = 4
_WORTH_SECONDS = 1.0
_LOST_TWICE = 2

Opened = Callable[[], AbstractContextManager[Kept]]
"""Opens where chunks are kept; opened anew for each set of workers, which must not inherit it."""
Advance = Callable[[int], None]


@dataclass(frozen=True)
class Means:
    """By what chunks are computed.

    Parameters
        jobs : int - processes; 0: chosen by the work to be done
        executor : makes the executor of a cluster, instead of processes; None: none
        workers : int - of that executor
    """

    jobs: int = 0
    executor: Callable[[], Executor] | None = None
    workers: int = 8


def compute(problem: Problem, todo: Sequence[int], keep: Opened, means: Means, advance: Advance) -> bool:
    """Compute some chunks and keep them; False where the user interrupted, and then what was begun is kept too.

    Raises
        BrokenPromise - where a design ends the process that computes it
    """
    left = list(todo)
    with calm() as asked:
        if means.executor is None and means.jobs != 1:
            left, seconds = _first(problem, left, keep, advance)
            jobs = means.jobs or (processors() if seconds * len(left) > _WORTH_SECONDS else 1)
        else:
            jobs = 1
        jobs = min(jobs, max(1, len(left)))
        if means.executor is None and jobs == 1:
            _here(problem, left, keep, advance, asked)
        else:
            _elsewhere(problem, left, keep, means, jobs, advance, asked)
    return not asked()


def _first(problem: Problem, left: list[int], keep: Opened, advance: Advance) -> tuple[list[int], float]:
    """Compute the first chunk here; what is left, and how long one takes."""
    if not left:
        return left, 0.0
    start = perf_counter()
    _here(problem, left[:1], keep, advance, lambda: False)
    return left[1:], perf_counter() - start


def _here(problem: Problem, todo: Sequence[int], keep: Opened, advance: Advance, asked: Callable[[], bool]) -> None:
    with keep() as kept, WhileMuchIsComputed():
        for number in todo:
            if asked():
                return
            kept.add([(number, *computed(problem.canonical_text, number))])
            advance(1)


def _elsewhere(
    problem: Problem,
    left: list[int],
    keep: Opened,
    means: Means,
    jobs: int,
    advance: Advance,
    asked: Callable[[], bool],
) -> None:
    """Chunks by an executor. One whose workers die is replaced; a chunk that was lost twice is computed alone."""
    lost: dict[int, int] = {}
    count = jobs if means.executor is None else means.workers
    while left and not asked():
        suspects = [number for number in left if lost.get(number, 0) >= _LOST_TWICE]
        for number in suspects:
            with keep() as kept:
                kept.add([_alone(problem, number)])
            advance(1)
        left = [number for number in left if number not in suspects]
        with _executor(means, jobs) as pool, keep() as kept:
            done, begun = _given(problem, left, pool, kept, count * _IN_FLIGHT, advance, asked)
        left = [number for number in left if number not in done]
        for number in begun:
            lost[number] = lost.get(number, 0) + 1


@contextmanager
def _executor(means: Means, jobs: int) -> Iterator[Executor]:
    """An executor whose processes have started."""
    with workers(jobs) if means.executor is None else means.executor() as pool:
        pool.submit(int).result()
        yield pool


def _given(
    problem: Problem,
    todo: Sequence[int],
    pool: Executor,
    kept: Kept,
    most: int,
    advance: Advance,
    asked: Callable[[], bool],
) -> tuple[set[int], list[int]]:
    """Give chunks to an executor, in order, a few at a time: which were finished, and which were lost with it."""
    waiting: dict[Future[tuple[str, bytes]], int] = {}
    done: set[int] = set()
    rest = iter(todo)
    broken = False
    while True:
        try:
            while len(waiting) < most and not broken and not asked() and (number := next(rest, None)) is not None:
                waiting[pool.submit(computed, problem.canonical_text, number)] = number
        except BrokenExecutor:
            return done, [number for number in (*waiting.values(), number) if number is not None]
        if not waiting:
            return done, []
        finished, _ = wait(waiting, return_when=FIRST_COMPLETED, timeout=0.5)
        good = [future for future in finished if not _lost(future)]
        results: list[Result] = [(waiting[future], *future.result()) for future in good]
        if results:
            kept.add(results)
            done |= {number for number, _, _ in results}
            advance(len(results))
        broken = broken or len(good) < len(finished)
        for future in good:
            del waiting[future]
        if broken:
            return done, list(waiting.values())


def _lost(future: Future[Any]) -> bool:
    """Whether a worker died over a chunk; what the chunk itself raised is no loss, and is raised by its result."""
    error = future.exception()
    return isinstance(error, BrokenExecutor) or type(error).__name__ == "KilledWorker"


def _alone(problem: Problem, number: int) -> Result:
    """A chunk in a process of its own.

    Raises
        BrokenPromise - naming the design that ends it
    """
    try:
        with workers(1) as pool:
            return (number, *pool.submit(computed, problem.canonical_text, number).result())
    except BrokenExecutor:
        index = _culprit(problem, number)
    raise BrokenPromise(f"design {index} ends the process that computes it: {dict(problem.changes_of(index))}")


def _culprit(problem: Problem, number: int) -> int:
    """The design of a chunk that ends its process, by halves."""
    first = number * problem.chunk_size
    last = min(first + problem.chunk_size, problem.order.count)
    while last - first > 1:
        middle = (first + last) // 2
        first, last = (middle, last) if _survives(problem, first, middle) else (first, middle)
    return first


def _survives(problem: Problem, first: int, last: int) -> bool:
    try:
        with workers(1) as pool:
            pool.submit(designs_of, problem.canonical_text, first, last).result()
    except BrokenExecutor:
        return False
    return True


def kept_in(memory: Kept) -> Opened:
    """Chunks kept in memory, "opened" as a store is."""
    return lambda: nullcontext(memory)


# Designs of a study as complete files, which every command takes

_NAME = 180
"""Letters of the study's name in the names of its designs, followed by their number."""
_MISS = re.compile(r"m([0-9]{1,6})")


def show(made: Problem, found: Found | None, asked: str) -> int:
    """Print a design's file: by its index, or mK for the nearest miss of row K of the table why."""
    print(text_of(made, found, _index(made, found, asked)), end="")
    return ExitCode.OK


def _index(made: Problem, found: Found | None, asked: str) -> int:
    if asked.isascii() and asked.isdecimal() and len(asked) < 18:
        last = made.order.count - 1 + (len(found.extra.rows) if found is not None else 0)
        if int(asked) <= last:
            return int(asked)
        raise _wrong(f"design {asked}: the last one is {last}", asked)
    row = _MISS.fullmatch(asked)
    if row is None or found is None:
        raise _wrong(f"{asked!r} is neither the index of a design nor mK for row K of the table why", asked)
    rows = found.why
    number = int(row[1])
    if not 1 <= number <= len(rows):
        raise _wrong(f"the table why has {amount(len(rows), 'row')}, not {number}", asked)
    name, _, miss = rows[number - 1]
    if miss.index is None:
        raise _wrong(f"no design fails row {number} ({name})", asked)
    return miss.index


def _wrong(message: str, asked: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<--show>", key=asked)])


def text_of(made: Problem, found: Found | None, index: int) -> str:
    """The file of a design."""
    changes = found.changes(index) if found is not None else made.changes_of(index)
    data: dict[str, Any] = made.base.changed(changes)
    data["name"] = f"{made.spec.name[:_NAME]}-{index}"
    head = f"# Design {index} of the study {visible(made.spec.name)}; try: gearlink {made.base.command} FILE\n"
    return head + yaml.dump(
        data, Dumper=_Dumper, sort_keys=False, allow_unicode=True, default_flow_style=None, width=120
    )


class _Dumper(yaml.SafeDumper):
    """Words whose lines could open commands in the log of a CI stand in quotes."""


def _quoted(dumper: yaml.SafeDumper, text: str) -> yaml.ScalarNode:
    style = '"' if "\n" in text or "::" in text else None
    return dumper.represent_scalar("tag:yaml.org,2002:str", text, style=style)


_Dumper.add_representer(str, _quoted)


def _put(text: str, stream: IO[bytes]) -> None:
    stream.write(text.encode())


def write(found: Found, folder: Path) -> tuple[int, int]:
    """Write the kept designs as NAME-INDEX.yaml: each is called by its index in the table, as it is for --show.

    Returns
        count, others : int - how many were written; how many files of such names stand there besides

    Raises
        CannotWrite
    """
    stem, written = safe_stem(found.problem.spec.name), set()
    for row in found.rows:
        path = folder / f"{stem}-{row.index}.yaml"
        write_atomically(path, partial(_put, text_of(found.problem, found, row.index)))
        written.add(path.name)
    there = (path for path in folder.glob(f"{glob.escape(stem)}-*.yaml") if path.name not in written)
    others = sum(path.stem.removeprefix(f"{stem}-").isdecimal() for path in there)
    return len(found.rows), others


def run_explore(asked: Exploring) -> int:
    """Do what the command line asks for, and give the exit status."""
    try:
        return _run(asked)
    except CannotStore as error:
        place = str(asked.store or asked.source)
        show_errors([Diagnostic(error.code, str(error), file=place, help=error.help)], asked.options)
        return ExitCode.WRONG_INPUT
    except (DesignFileError, CannotWrite) as error:
        return show_refusal(error, asked.source, asked.options)


def _run(asked: Exploring) -> int:
    if asked.show and (asked.write is not None or asked.options.plot):
        other = "--plot" if asked.write is None else "--write"
        raise _usage(f"--show prints one design and writes no file\nomit {other}, or --show", "--show")
    for folder in (asked.write, asked.options.out if asked.options.plot else None):
        if folder is not None:
            require_folder(folder)
    source = asked.source
    if is_store(source):
        return _shown(Path(source), asked)
    made = _read(source, asked)
    if asked.show and not asked.show.startswith("m"):
        return show(made, None, asked.show)
    return _computed(made, asked)


def _shown(path: Path, asked: Exploring) -> int:
    """Print what a store holds; where another program computed it, that is said.

    Raises
        CannotStore - GL158 where this program computes one of its designs otherwise
    """
    with opened(path) as store:
        made = problem_in(store)
        meta = store.meta()
        for name, was, now in others(meta):
            _tell(f"note: {visible(str(path))} was computed with {name} {visible(was)}; this is {now}", asked)
        try:
            return _answer(made, store, asked)
        except BrokenPromise as error:
            if not others(meta):
                raise
            raise of_another_program(path, meta, f"here, {str(error).removeprefix('GL160: ')}") from None


def _read(source: str, asked: Exploring) -> Problem:
    """The study of a file, ready to be computed."""
    loaded, kind = open_design(source, asked.options)
    require_command(loaded, kind, "explore")
    spec = read_spec(loaded, kind, source)
    if asked.options.strict:  # of the designs as well, not of the study alone
        spec = spec.model_copy(update={"checks": spec.checks.model_copy(update={"warn_counts": True})})
    try:
        made = problem(spec)
        made.order  # noqa: B018 - refused here, where its places in the file are known
    except WrongStudy as error:
        raise DesignFileError(located(loaded, error.faults)) from None
    return made


def _computed(made: Problem, asked: Exploring) -> int:
    keep = _keep(made, asked)
    with keep() as kept:
        done = kept.finished()
    todo = [number for number in range(made.chunks) if number not in done]
    shown = progress(len(todo), "exploring", quiet=asked.options.quiet, each=made.chunk_size)
    with _means(asked) as means, shown as advance:
        whole = compute(made, todo, keep, means, advance)
    with keep() as kept:
        if not whole:
            return _interrupted(made, kept, asked)
        return _answer(made, kept, asked)


def _keep(made: Problem, asked: Exploring) -> Opened:
    """Where chunks are kept: in the store, which is made ready, or in memory."""
    if asked.store is None:
        if asked.resume:
            raise _usage("--resume needs --store FILE", "--store")
        return kept_in(Memory())
    path = asked.store
    with opened(path) as store:
        ready(store, made, resume=asked.resume)
        store.log("begun" if not store.finished() else "continued")
    return lambda: opened(path)


@contextmanager
def _means(asked: Exploring) -> Iterator[Means]:
    if asked.dask:
        from gearlink.cli.parallel.shares import client

        with client(asked.dask) as cluster:
            yield Means(executor=cluster.get_executor, workers=max(1, len(cluster.ncores())))
    else:
        yield Means(asked.jobs)


def _interrupted(made: Problem, kept: Kept, asked: Exploring) -> int:
    done = len(kept.finished())
    text = f"interrupted: {done} of {made.chunks} chunks are finished"
    if asked.store is not None:
        text += f"; continue by: gearlink explore {asked.source} --store {asked.store} --resume"
    print(text, file=sys.stderr)
    return ExitCode.INTERRUPTED


def _answer(made: Problem, kept: Kept, asked: Exploring) -> int:
    """Print what was found, or that something is missing."""
    missing = made.chunks - len(kept.finished())
    if missing:
        text = f"{missing} of {made.chunks} chunks are missing: continue with the study file, --store and --resume"
        raise CannotStore("GL159", text)
    with patience("combining the designs", quiet=asked.options.quiet):
        found = Found.of(made, together(made, chunks_of(kept, made)))
    if asked.show:
        return show(made, found, asked.show)
    return _print(Exploration(made.spec, found), asked)


def _print(study: Exploration, asked: Exploring) -> int:
    from gearlink.cli.commands.design import print_report, written_beside

    with patience("computing the results of the study", quiet=asked.options.quiet):
        report = study.report("explore")
    if asked.options.format is Format.TABLE:
        show_page(study, report, asked.options)
    else:
        print_report(report, asked.options)
    beside = written_beside(lambda: _write(study, report, asked), asked.source, asked.options)
    return max(beside, exit_status(report, strict=asked.options.strict))


def _write(study: Exploration, report: Report, asked: Exploring) -> None:
    """Write the files that are asked for besides."""
    if asked.write is not None:
        count, others = write(study.found, asked.write)
        earlier = f", next to {others} of an earlier run" if others else ""
        _tell(f"wrote {amount(count, 'design')} to {visible(str(asked.write))}{earlier}", asked)
    if asked.options.plot:
        from gearlink.cli.commands.design import plot

        plot("explore", study, asked.options, report)


def _tell(text: str, asked: Exploring) -> None:
    if not asked.options.quiet:
        print(text, file=sys.stderr)


def _usage(message: str, key: str) -> DesignFileError:
    return DesignFileError([Diagnostic("GL115", message, file="<command line>", key=key)])


def show_page(study: Exploration, report: Report, options: Options) -> None:
    """Print a study."""
    from rich.text import Text

    from gearlink.cli.render.terminal import console_for, show_findings, show_table

    console = console_for(options)
    console.print(
        Text(f"{visible(' '.join(report.name.split()))}: explore {study.problem.base.kind.name}", style="bold")
    )
    console.print(Text(_counts(study)))
    front = next(table for table in report.tables if table.name == "front")
    if study.kept:
        show_table(_shown_front(study, front), console, most=SHOWN, digits=options.digits)
        for line in _below(study):
            console.print(Text(line))
    _why(study, console)
    show_findings(report, console)


def _counts(study: Exploration) -> str:
    how = "all evaluated" if study.exhaustive else "sampled, not exhaustive"
    objectives = study.problem.objectives
    resolution = ", ".join(f"{w.resolution:g}{'' if w.unit == '1' else ' ' + w.unit}" for w in objectives)
    front = f"front {study.front_size:,}, kept {study.kept:,} (resolution {resolution})"
    if len(objectives) == 1:
        front = f"best {study.kept:,} (resolution {resolution})"
    return (
        f"{amount(study.designs, 'design', spec=',')}, {how}; {study.refused:,} without a mechanism; "
        f"{study.feasible:,} {'satisfies' if study.feasible == 1 else 'satisfy'} {study.problem.asked}; {front}"
    )


def _shown_front(study: Exploration, front: Table) -> Table:
    """The rows that are shown, the knee marked."""
    places = study.found.chosen
    data = [[column[i] for i in places] for column in front.data]
    data[0] = [f"{index} *" if index == study.knee else f"{index}" for index in data[0]]
    heads = tuple(name.replace(".", "_") for name in front.columns)  # a heading is folded there
    return Table(front.name, heads, front.units, tuple(data))


def _below(study: Exploration) -> list[str]:
    lines = []
    if study.kept > study.shown:
        lines.append(
            f"{study.shown} of {amount(study.kept, 'row')}, chosen far from each other; use coarser resolutions, or csv"
        )
    if study.knee is not None:
        lines.append("* knee: design with the minimum sum of the objectives, scaled over the front")
    lines.append("--show INDEX prints a design's file, --write DIR writes all kept ones")
    return lines


def _why(study: Exploration, console: object) -> None:
    """Rows that fail some design; the others have removed nothing."""
    rows = [(i, *row) for i, row in enumerate(study.found.why, 1) if row[2].fails]
    if not rows:
        return
    from gearlink.cli.render.terminal import grid_for, show_grid

    grid = grid_for(console)  # type: ignore[arg-type]
    for head in ("why", "code", "designs", "alone", "nearest miss", "file of it"):
        grid.add_column(head, justify="right" if head in ("designs", "alone") else "left", overflow="fold")
    for place, name, code, miss in rows:
        unit = "" if miss.unit == "1" else f" {miss.unit}"
        near = "" if miss.value is None else f"{_beside(miss.value, miss.limit)}{unit}"
        grid.add_row(name, code or "", f"{miss.fails:,}", f"{miss.alone:,}", near, f"--show m{place}")
    console.print()  # type: ignore[attr-defined]
    show_grid(grid, console)  # type: ignore[arg-type]


def _beside(value: float, limit: float | None) -> str:
    """A value and its limit to five digits, or to as many as it takes to tell them apart.

    Example
        >>> _beside(44.7, 45.0), _beside(44.9999987, 45.0), _beside(45.0, 45.0)
        ('44.7 (limit 45)', '44.999999 (limit 45)', '45 (limit 45)')
    """
    apart = (digits for digits in range(5, 18) if written(value, digits) != written(limit, digits))
    digits = next(apart, 5)
    return f"{written(value, digits)} (limit {written(limit, digits)})"
