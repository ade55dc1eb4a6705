"""Shares of a command's work: here, in processes, or on a cluster; the result is the same everywhere."""

from __future__ import annotations

import math
import os
import sys
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, wait
from contextlib import contextmanager
from importlib import import_module
from time import monotonic
from typing import Any

from gearlink.cli.process import WhileMuchIsComputed, processors
from gearlink.cli.program import program
from gearlink.cli.progress import progress
from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic

# How far shares of a work are, counted by the processes that compute them

_FIRST_LOOK = 0.25
_TIMED = 1.0
_LONG = 60.0


class TooLong(Exception):
    """A share takes longer than it may here."""


class Watch:
    """Counts designs, shows how far the work is, and says once that it is long.

    Parameters
        shares : int - parts of the work
        work : int - designs of a share
        advance : Callable - shows that so many more are done
        quiet : bool - say nothing

    Notes
        A share that would go on for more than `most_seconds` in this process is given up as soon as that is known.
        Forked workers count in memory that they share with this process; of others only ended shares are known.
    """

    def __init__(self, shares: int, work: int, advance: Callable[[int], None], *, quiet: bool) -> None:
        self.work, self.whole = work, shares * work
        self._advance, self._told, self._process = advance, quiet, os.getpid()
        self._shown = self._ended = self._here = 0
        self._start = monotonic()
        self._timed_from: tuple[float, int] | None = None
        self._count: Any = None
        self.most_seconds = math.inf

    def __call__(self, count: int) -> None:
        """So many more designs are computed, here or in a worker."""
        if self._count is not None:
            with self._count.get_lock():
                self._count.value += count
        if os.getpid() == self._process:
            self._here += count
            self.show()
            if self.elapsed > _FIRST_LOOK and self.elapsed * (self.work / self._here - 1.0) > self.most_seconds:
                raise TooLong

    def share(self) -> None:
        """One more share has ended."""
        self._ended += 1
        self.show()

    def for_workers(self) -> None:
        """From now on workers count too, which are about to be made; the time of the work begins again."""
        if sys.platform == "linux":  # elsewhere they are started anew
            from multiprocessing import get_context

            self._count = get_context("fork").Value("Q", 0)
        self._here, self._start = self._ended * self.work, monotonic()
        self._timed_from = None

    @property
    def done(self) -> int:
        """Designs that are computed, as far as is known."""
        of_workers = 0 if self._count is None else int(self._count.value)
        return min(self.whole, max(self._here + of_workers, self._ended * self.work))

    @property
    def elapsed(self) -> float:
        """Seconds since it began."""
        return monotonic() - self._start

    def show(self) -> None:
        """Show how far the work is."""
        done = self.done
        if done > self._shown:
            self._advance(done - self._shown)
            self._shown = done
        if not self._told:
            self._tell(done)

    def _tell(self, done: int) -> None:
        """Say how long it takes, once a second of it is timed: from the first designs on, not from the preparations."""
        now = monotonic()
        if self._timed_from is None or done <= self._timed_from[1]:
            self._timed_from = (now, done) if done else None
            return
        seconds, counted = now - self._timed_from[0], done - self._timed_from[1]
        if seconds < _TIMED:
            return
        self._told = True
        left = seconds / counted * (self.whole - done)
        if left > _LONG:
            words = f"this takes about {_duration(left)}: {self.whole:,} designs as manufactured are computed"
            print(f"{words}, fewer with --samples", file=sys.stderr)


def _duration(seconds: float) -> str:
    """A time in words, as exact as an estimate is.

    Example
        >>> _duration(95.0), _duration(1020.0), _duration(9000.0)
        ('2 min', '17 min', '2.5 h')
    """
    return f"{seconds / 60.0:.0f} min" if seconds < 5400.0 else f"{seconds / 3600.0:.1f} h"


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
    from gearlink.core.studies.tolerance.sampling import COMPUTED_BY, SEEN

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
        print(f"a worker ended ({error}); the missing shares are computed here", file=sys.stderr)
    missing = [number for number in numbers if number not in found]
    found.update(zip(missing, _here(function, missing, watch), strict=True))
    return [found[number] for number in numbers]


_SECONDS = 20


@contextmanager
def client(address: str) -> Iterator[Any]:
    """A client of a Dask scheduler, all of whose workers have this program.

    Raises
        DesignFileError - GL115 where none can be had, GL158 for a worker with another program
    """
    try:
        make: Any = import_module("distributed").Client
    except ImportError:
        message = "--dask needs the package distributed: pip install distributed"
        raise _refused("GL115", message, "--dask") from None
    try:
        made = make(address, timeout=_SECONDS)
    except (OSError, ValueError) as error:
        raise _refused("GL115", f"no Dask scheduler answers at {address}: {error}", address) from None
    except Exception as error:  # what another server says is no message of Dask: MemoryError for its size, and others
        message = f"the server at {address} is not a Dask scheduler ({type(error).__name__})"
        remedy = "`dask scheduler` prints the address; the address of its dashboard is a different one"
        raise _refused("GL115", message, address, remedy) from None
    with made:
        own = program()
        for worker, theirs in made.run(program).items():
            for name, version in own.items():
                if theirs.get(name) != version:
                    message = f"the worker {worker} has {name} {theirs.get(name)}; this is {version}"
                    raise _refused("GL158", message, address, "install the same versions on every worker")
        yield made


def _refused(code: str, message: str, key: str, help: str = "") -> DesignFileError:
    return DesignFileError([Diagnostic(code, message, file="<--dask>", key=key, help=help)])
