"""Running the files of a batch, in this process or in several, with a progress bar on a terminal."""

from __future__ import annotations

import os
import sys
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Future, ProcessPoolExecutor, wait
from contextlib import contextmanager
from multiprocessing import active_children, get_all_start_methods, get_context
from pathlib import Path
from time import perf_counter

from gearlink.cli.batch.one_file import outcomes
from gearlink.cli.batch.options import BatchOptions
from gearlink.cli.batch.outcome import Outcome
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.reading.diagnostics import Diagnostic

# Several processes pay when the rest would take this long in one; starting them costs some hundredths of a second.
_WORTH_SECONDS = 0.15
_TRIED_FIRST = 16
_CHUNKS_PER_JOB = 32
_CHUNK_SECONDS = 0.25


def run_files(files: Sequence[Path], options: BatchOptions) -> tuple[list[Outcome], bool]:
    """Outcomes of the files that were finished, and whether the user interrupted.

    Notes
        A sample from the whole list runs here; how long it takes decides whether more processes pay for the rest.
    """
    results: list[Outcome] = []
    with _progress(len(files), options) as advance:
        try:
            start = perf_counter()
            stride = 1 if options.jobs == 1 else max(1, len(files) // _TRIED_FIRST)
            first = files[::stride]
            for path in first:
                results += outcomes(path, options)
                advance(1)
            rest = [path for i, path in enumerate(files) if i % stride]
            seconds_each = (perf_counter() - start) / max(1, len(first))
            jobs = _jobs(options, rest, seconds_each)
            if jobs > 1:
                _run_parallel(_chunks(rest, jobs, seconds_each), options, jobs, results, advance)
            else:
                for path in rest:
                    results += outcomes(path, options)
                    advance(1)
        except KeyboardInterrupt:
            return results, True
    return results, False


def _jobs(options: BatchOptions, rest: Sequence[Path], seconds_each: float) -> int:
    if options.jobs:
        return min(options.jobs, max(1, len(rest)))
    if seconds_each * len(rest) < _WORTH_SECONDS:
        return 1
    affinity = getattr(os, "sched_getaffinity", None)
    return len(affinity(0)) if affinity else os.cpu_count() or 1


def _chunks(files: Sequence[Path], jobs: int, seconds_each: float) -> list[Sequence[Path]]:
    """Interleaved shares: large enough to pay, small enough that an interrupt need not wait for them."""
    by_time = len(files) * seconds_each / _CHUNK_SECONDS
    count = min(len(files), max(jobs * _CHUNKS_PER_JOB, int(by_time)))
    return [files[i::count] for i in range(count)]


def _run_parallel(
    chunks: Sequence[Sequence[Path]],
    options: BatchOptions,
    jobs: int,
    results: list[Outcome],
    advance: Callable[[int], None],
) -> None:
    """Chunks in processes; this one takes them from the end while the others take them from the beginning.

    Notes
        A forked child has every module loaded already. Results come in as they are finished, so that an interrupt
        leaves what there is. A process that dies (memory, a signal) costs the chunks it was given; this one does the
        rest alone.
    """
    method = "fork" if "fork" in get_all_start_methods() and sys.platform == "linux" else None
    pool = ProcessPoolExecutor(jobs - 1, mp_context=get_context(method), initializer=_ignore_interrupt)
    waiting, given = deque(chunks), dict[Future[list[Outcome]], Sequence[Path]]()

    def collect() -> bool:
        """Take what is finished and give out more; False where a process has died."""
        alive = True
        for future in [future for future in given if future.done()]:
            try:
                results.extend(future.result())
            except BrokenExecutor:
                alive = False
                results.extend(map(_lost, given[future]))
            advance(len(given.pop(future)))
        while alive and waiting and len(given) < 2 * (jobs - 1):
            try:
                given[pool.submit(_chunk, waiting[0], options)] = waiting[0]
                waiting.popleft()
            except BrokenExecutor:
                alive = False
        return alive

    try:
        alive = collect()
        while waiting:
            for path in waiting.pop():
                results += outcomes(path, options)
                advance(1)
                alive = alive and collect()
        while given:
            wait(given, return_when=FIRST_COMPLETED)
            collect()
        pool.shutdown()
    except BaseException:
        # What they are at is lost; waiting for it would make the user wait.
        for future in given:
            if future.done() and future.exception() is None:
                results += future.result()
        for child in active_children():
            child.terminate()
        pool.shutdown()
        raise


def _lost(path: Path) -> Outcome:
    message = "fault: the process that had this file died; run it alone with -j 1"
    return Outcome(str(path), "", path.stem, "", ExitCode.FAULT, None, (Diagnostic("GL199", message, file=str(path)),))


def _ignore_interrupt() -> None:
    """The parent alone answers Ctrl-C, so that no worker prints of it."""
    import signal

    signal.signal(signal.SIGINT, signal.SIG_IGN)


def _chunk(files: Sequence[Path], options: BatchOptions) -> list[Outcome]:
    return [outcome for path in files for outcome in outcomes(path, options)]


@contextmanager
def _progress(total: int, options: BatchOptions) -> Iterator[Callable[[int], None]]:
    """A bar on standard error where that is a terminal and the user wants talk."""
    if options.design.quiet or total < 2 or not sys.stderr.isatty():
        yield lambda _: None
        return
    from rich.console import Console
    from rich.progress import Progress

    with Progress(console=Console(stderr=True), transient=True) as bar:
        task = bar.add_task("designs", total=total)
        yield lambda count: bar.advance(task, count)
