"""Shares of a command's work: here, in processes, or on a cluster; the result is the same everywhere."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, wait
from contextlib import contextmanager
from time import perf_counter
from typing import Any

from gearlink.cli.parallel.processors import processors
from gearlink.cli.process import WhileMuchIsComputed
from gearlink.cli.progress import progress

_WORTH_SECONDS = 1.0
Advance = Callable[[int], None]


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
    from gearlink.core.tolerance.shares import COMPUTED_BY

    def compute(function: Callable[[int], Any], numbers: Sequence[int]) -> list[Any]:
        with progress(len(numbers), words, quiet=quiet) as advance:
            if dask:
                return _on_cluster(function, numbers, dask, advance)
            return _in_processes(function, numbers, jobs, advance)

    token = COMPUTED_BY.set(compute)
    try:
        yield
    finally:
        COMPUTED_BY.reset(token)


def _in_processes(function: Callable[[int], Any], numbers: Sequence[int], jobs: int, advance: Advance) -> list[Any]:
    from gearlink.cli.parallel.workers import workers

    found: list[Any] = []
    if jobs == 0:
        start = perf_counter()
        found = _here(function, numbers[:1], advance)
        jobs = processors() if (perf_counter() - start) * (len(numbers) - 1) > _WORTH_SECONDS else 1
    rest = numbers[len(found) :]
    if jobs == 1:
        return found + _here(function, rest, advance)
    with workers(min(jobs, len(rest))) as pool:
        return found + _given(pool, function, rest, advance)


def _on_cluster(function: Callable[[int], Any], numbers: Sequence[int], dask: str, advance: Advance) -> list[Any]:
    from gearlink.cli.parallel.cluster import client

    with client(dask) as cluster, cluster.get_executor() as pool:
        return _given(pool, function, numbers, advance)


def _here(function: Callable[[int], Any], numbers: Sequence[int], advance: Advance) -> list[Any]:
    found = []
    with WhileMuchIsComputed():
        for number in numbers:
            found.append(function(number))
            advance(1)
    return found


def _given(pool: Executor, function: Callable[[int], Any], numbers: Sequence[int], advance: Advance) -> list[Any]:
    """Shares by an executor, in order; where its workers die, what is missing is computed here."""
    found: dict[int, Any] = {}
    try:
        asked = {pool.submit(function, number): number for number in numbers}
        left = set(asked)
        while left:
            ended, left = wait(left, timeout=0.5)
            for future in ended:
                found[asked[future]] = future.result()
                advance(1)
    except BrokenExecutor as error:
        print(f"a worker ended ({error}); the shares that are missing are computed here", file=sys.stderr)
    missing = [number for number in numbers if number not in found]
    found.update(zip(missing, _here(function, missing, advance), strict=True))
    return [found[number] for number in numbers]
