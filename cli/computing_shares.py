"""Shares of a command's work: here, in processes, on an executor or on a cluster; the result is the same everywhere."""

from __future__ import annotations

import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import BrokenExecutor, Executor, wait
from contextlib import contextmanager
from time import perf_counter
from typing import Any

from gearlink.cli.processors import processors

_WORTH_SECONDS = 1.0


@contextmanager
def shares_by(jobs: int, factory: str, dask: str, *, words: str, quiet: bool) -> Iterator[None]:
    """Compute the replications of `tolerance` and `register` by what a command line names.

    Parameters
        jobs : int - processes, 0: chosen by the work to be done
        factory : str - "module:factory" of an executor, empty for processes
        dask : str - address of a scheduler, empty for none
        words : str - what is going on, said on a terminal once it takes more than a second
    Raises
        DesignFileError - GL115 where an executor cannot be had, GL158 for a worker with another program
    """
    from gearlink.core.tolerance.shares import COMPUTED_BY

    def compute(function: Callable[[int], Any], numbers: Sequence[int]) -> list[Any]:
        progress = _Progress(words, len(numbers), quiet=quiet)
        try:
            if factory or dask:
                return _on_executor(function, numbers, factory, dask, progress)
            return _in_processes(function, numbers, jobs, progress)
        finally:
            progress.end()

    token = COMPUTED_BY.set(compute)
    try:
        yield
    finally:
        COMPUTED_BY.reset(token)


def _in_processes(function: Callable[[int], Any], numbers: Sequence[int], jobs: int, progress: _Progress) -> list[Any]:
    from gearlink.cli.workers import workers

    found: list[Any] = []
    if jobs == 0:
        start = perf_counter()
        found = _here(function, numbers[:1], progress)
        jobs = processors() if (perf_counter() - start) * (len(numbers) - 1) > _WORTH_SECONDS else 1
    rest = numbers[len(found) :]
    if jobs == 1:
        return found + _here(function, rest, progress)
    with workers(min(jobs, len(rest))) as pool:
        return found + _given(pool, function, rest, progress)


def _on_executor(
    function: Callable[[int], Any], numbers: Sequence[int], factory: str, dask: str, progress: _Progress
) -> list[Any]:
    from gearlink.cli.executors import executor_of

    with executor_of(factory, dask) as (made, _), made() as pool:
        return _given(pool, function, numbers, progress)


def _here(function: Callable[[int], Any], numbers: Sequence[int], progress: _Progress) -> list[Any]:
    found = []
    for number in numbers:
        found.append(function(number))
        progress.done(1)
    return found


def _given(pool: Executor, function: Callable[[int], Any], numbers: Sequence[int], progress: _Progress) -> list[Any]:
    """Shares by an executor, in order; where its workers die, what is missing is computed here."""
    found: dict[int, Any] = {}
    try:
        asked = {pool.submit(function, number): number for number in numbers}
        left = set(asked)
        while left:
            ended, left = wait(left, timeout=0.5)
            for future in ended:
                found[asked[future]] = future.result()
            progress.done(len(ended))
    except BrokenExecutor as error:
        print(f"a worker ended ({error}); the shares that are missing are computed here", file=sys.stderr)
    missing = [number for number in numbers if number not in found]
    found.update(zip(missing, _here(function, missing, progress), strict=True))
    return [found[number] for number in numbers]


class _Progress:
    """A line on standard error, where that is a terminal, from the first second on."""

    def __init__(self, words: str, total: int, *, quiet: bool) -> None:
        self._words, self._total, self._count = words, total, 0
        self._start, self._said = perf_counter(), False
        self._silent = quiet or not sys.stderr.isatty()

    def done(self, count: int) -> None:
        """Some more shares are done."""
        self._count += count
        passed = perf_counter() - self._start
        if self._silent or passed < _WORTH_SECONDS or not self._count:
            return
        left = passed / self._count * (self._total - self._count)
        text = f"\r\033[K{self._words}: {100 * self._count // self._total} %, {left:.0f} s left"
        print(text, end="", file=sys.stderr, flush=True)
        self._said = True

    def end(self) -> None:
        """Take the line back."""
        if self._said:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
