"""Shares of a command's work: here, in processes, or on a cluster; the result is the same everywhere."""

from __future__ import annotations

import math
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, wait
from contextlib import contextmanager
from typing import Any

from gearlink.cli.parallel.processors import processors
from gearlink.cli.parallel.watch import TooLong, Watch
from gearlink.cli.process import WhileMuchIsComputed
from gearlink.cli.progress import progress

_WORTH_SECONDS = 1.0
_LOOKED_SECONDS = 0.25


@contextmanager
def shares_by(jobs: int, dask: str, *, words: str, quiet: bool) -> Iterator[None]:
    """Compute the replications of `tolerance` and `register` by what a command line names.

    Parameters
        jobs : int - processes, 0: chosen by the work to be done
        dask : str - address of a scheduler, empty for none
        words : str - what is going on, beside the bar on a terminal
    Raises
        DesignFileError - GL115 where no cluster can be had, GL158 for a worker with another program
    """
    from gearlink.core.tolerance.shares import COMPUTED_BY, SEEN

    def compute(function: Callable[[int], Any], numbers: Sequence[int], work: int) -> list[Any]:
        with progress(len(numbers) * work, words, quiet=quiet) as advance:
            watch = Watch(len(numbers), work, advance, quiet=quiet)
            seen = SEEN.set(watch)
            try:
                if dask:
                    return _on_cluster(function, numbers, dask, watch)
                return _in_processes(function, numbers, jobs, watch)
            finally:
                SEEN.reset(seen)

    token = COMPUTED_BY.set(compute)
    try:
        yield
    finally:
        COMPUTED_BY.reset(token)


def _in_processes(function: Callable[[int], Any], numbers: Sequence[int], jobs: int, watch: Watch) -> list[Any]:
    from gearlink.cli.parallel.workers import workers

    found: list[Any] = []
    if jobs == 0:
        found, jobs = _first(function, numbers, watch)
    rest = numbers[len(found) :]
    if jobs == 1:
        return found + _here(function, rest, watch)
    watch.for_workers()
    with workers(min(jobs, len(rest))) as pool:
        return found + _given(pool, function, rest, watch)


def _first(function: Callable[[int], Any], numbers: Sequence[int], watch: Watch) -> tuple[list[Any], int]:
    """The first share, and how many processes are worth it for the others; none where it is worth them itself."""
    others = processors()
    watch.most_seconds = _WORTH_SECONDS if others > 1 else math.inf
    try:
        found = _here(function, numbers[:1], watch)
    except TooLong:
        return [], others
    finally:
        watch.most_seconds = math.inf
    return found, others if watch.elapsed * (len(numbers) - 1) > _WORTH_SECONDS else 1


def _on_cluster(function: Callable[[int], Any], numbers: Sequence[int], dask: str, watch: Watch) -> list[Any]:
    from gearlink.cli.parallel.cluster import client

    with client(dask) as cluster, cluster.get_executor() as pool:
        return _given(pool, function, numbers, watch)


def _here(function: Callable[[int], Any], numbers: Sequence[int], watch: Watch) -> list[Any]:
    found = []
    with WhileMuchIsComputed():
        for number in numbers:
            found.append(function(number))
            watch.share()
    return found


def _given(pool: Executor, function: Callable[[int], Any], numbers: Sequence[int], watch: Watch) -> list[Any]:
    """Shares by an executor, in order; where its workers die, what is missing is computed here."""
    found: dict[int, Any] = {}
    try:
        asked = {pool.submit(function, number): number for number in numbers}
        left = set(asked)
        while left:
            ended, left = wait(left, timeout=_LOOKED_SECONDS, return_when=FIRST_COMPLETED)
            for future in ended:
                found[asked[future]] = future.result()
                watch.share()
            watch.show()
    except BrokenExecutor as error:
        print(f"a worker ended ({error}); the shares that are missing are computed here", file=sys.stderr)
    missing = [number for number in numbers if number not in found]
    found.update(zip(missing, _here(function, missing, watch), strict=True))
    return [found[number] for number in numbers]
