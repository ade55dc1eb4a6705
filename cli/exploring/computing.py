"""Computing the chunks of a study: here, in processes, or on a cluster; what is finished is kept at once."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import FIRST_COMPLETED, BrokenExecutor, Executor, Future, wait
from contextlib import AbstractContextManager, contextmanager, nullcontext
from dataclasses import dataclass
from time import perf_counter
from typing import Any

from gearlink.cli.exploring.store import Kept, Result
from gearlink.cli.parallel.calm import calm
from gearlink.cli.parallel.processors import processors
from gearlink.cli.parallel.workers import workers
from gearlink.cli.process import WhileMuchIsComputed
from gearlink.core.explore.chunks import computed, designs_of
from gearlink.core.explore.problem import Problem
from gearlink.core.study.faults import BrokenPromise

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
        executor : makes the executor of a cluster, in place of processes; None: none
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
