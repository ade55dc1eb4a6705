"""Processes to compute in, as an ordinary Executor: they end with this process, whatever ends it.

Where what is finished is worth keeping, the first Ctrl-C asks for the end and a second one ends the process.
"""

from __future__ import annotations

import gc
import os
import signal
import sys
import threading
import time
from collections.abc import Callable, Iterable, Iterator
from concurrent.futures import Executor, Future, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process
from multiprocessing.connection import Connection, wait
from multiprocessing.process import BaseProcess
from types import FrameType
from typing import Any, ParamSpec, TypeVar

from gearlink.cli.files import leave_nothing_behind
from gearlink.cli.process import collect_as_python_does

_GRACE_SECONDS = 1.0
_AGAIN_SECONDS = 0.05
# Forked processes are all there from the first call on; others are started as they are needed, and looked for.
_SPAWNED_SECONDS = None if sys.platform == "linux" else 1.0
_MOST_OF_WINDOWS = 61
"""Processes that one process can wait for there."""
P = ParamSpec("P")
T = TypeVar("T")


@contextmanager
def workers(count: int) -> Iterator[Executor]:
    """An executor of `count` processes; what raises out of the block ends them at once.

    Notes
        A forked process has every module loaded already; other systems than Linux start theirs anew, Windows 61 at
        most.
    """
    context = get_context("fork" if sys.platform == "linux" else None)
    count = min(count, _MOST_OF_WINDOWS) if sys.platform == "win32" else count
    pool = _Workers(count, mp_context=context, initializer=_begin)
    results = pool._result_queue
    _close_by_one(results._writer)  # type: ignore[attr-defined]
    try:
        yield pool
    except BaseException:
        manager: Any = pool._executor_manager_thread
        # What they are at is lost; waiting for it would make the user wait.
        pool.shutdown(wait=False, cancel_futures=True)
        _end(active_children())
        # The thread that reads results would wait for ever for the rest of one that a worker was writing: its end comes
        # when nobody can write any more, this process included.
        results._writer.close()  # type: ignore[attr-defined]
        if manager is not None:
            manager.join()
        raise
    finally:
        pool.shutdown()
        # No thread is left: a process that is forked while one runs may wait for ever for a lock that it held.
        if pool.watch is not None:
            pool.watch.join()


def _close_by_one(connection: Connection) -> None:
    """Let a connection be closed by one thread alone.

    The thread that watches, the one that leaves the block and the executor's own shutdown may close it at the same
    moment; the second would close whatever has the same number of a descriptor by then.
    """
    lock, close = threading.Lock(), connection.close

    def locked() -> None:
        with lock:
            close()

    connection.close = locked  # type: ignore[method-assign]


class _Workers(ProcessPoolExecutor):
    """Processes of which the first to die breaks the executor, also one that was writing its result."""

    watch: threading.Thread | None = None

    def submit(self, fn: Callable[P, T], /, *args: P.args, **kwargs: P.kwargs) -> Future[T]:
        """Schedule a call, as any executor does; the first starts the processes, which are watched from then on."""
        future = super().submit(fn, *args, **kwargs)
        if self.watch is None:
            results: Any = self._result_queue
            watched = (self._processes, results._writer)
            self.watch = threading.Thread(target=_end_with_first_dead, args=watched, daemon=True)
            self.watch.start()
        return future


def _end_with_first_dead(processes: dict[int, BaseProcess], writer: Connection) -> None:
    """End all processes as soon as one has died, and the pipe of their results with them.

    The thread of the executor that reads results learns of a death where it waits for the next result. In the middle of
    one it would wait for ever for the rest, which nobody writes, unless nobody can write any more.
    """
    ended: set[BaseProcess] = set()
    while left := set(processes.values()) - ended:
        gone = wait([process.sentinel for process in left], _SPAWNED_SECONDS)
        now = {process for process in left if process.sentinel in gone}
        if any(_status(process) for process in now):
            _end(left)
            writer.close()
            return
        ended |= now


def _end(processes: Iterable[BaseProcess]) -> None:
    """End processes as by a signal; those that do not heed it, by force.

    Notes
        A process that has just been forked may lose a signal: Python forgets those that come before it has begun.
    """
    left, latest = list(processes), time.monotonic() + _GRACE_SECONDS
    while left and time.monotonic() < latest:
        for process in left:
            process.terminate()
        gone = wait([process.sentinel for process in left], _AGAIN_SECONDS)
        left = [process for process in left if process.sentinel not in gone]
    for process in left:
        process.kill()


def _status(process: BaseProcess) -> int:
    """Exit status of a process that has ended; another thread that asks at the same moment may hear of it first."""
    while process.exitcode is None:
        time.sleep(0.01)
    return process.exitcode


def _begin() -> None:
    """The parent alone answers Ctrl-C, so that no worker prints of it; and its end is a worker's.

    What the parent has loaded is no garbage: the collector, which shall look often, need not walk it.
    """
    gc.freeze()
    collect_as_python_does()
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    leave_nothing_behind()
    threading.Thread(target=_end_with_parent, daemon=True).start()


def _end_with_parent() -> None:
    """Wait for the end of the parent, then end as by a signal; by force where the work does not hear one."""
    parent = parent_process()
    assert parent is not None, "a worker has one"
    parent.join()
    os.kill(os.getpid(), signal.SIGTERM)
    time.sleep(_GRACE_SECONDS)
    os._exit(128 + signal.SIGTERM)


@contextmanager
def calm() -> Iterator[Callable[[], bool]]:
    """Gives what tells whether the user has asked for the end; nothing is broken off by the asking.

    Notes
        A second Ctrl-C does what it did before. What the parent of the process chose to ignore stays ignored.
    """
    before = signal.getsignal(signal.SIGINT)
    if threading.current_thread() is not threading.main_thread() or not callable(before):
        yield lambda: False
        return
    heard: list[int] = []

    def hear(number: int, frame: FrameType | None) -> None:
        heard.append(number)
        if len(heard) > 1:
            before(number, frame)

    signal.signal(signal.SIGINT, hear)
    try:
        yield lambda: bool(heard)
    finally:
        signal.signal(signal.SIGINT, before)
