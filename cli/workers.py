"""Processes to compute in, as an ordinary Executor: they end with this process, whatever ends it."""

from __future__ import annotations

import os
import signal
import sys
import threading
import time
from collections.abc import Iterator
from concurrent.futures import Executor, ProcessPoolExecutor
from contextlib import contextmanager
from multiprocessing import active_children, get_context, parent_process

from gearlink.cli.files import leave_nothing_behind

_GRACE_SECONDS = 1.0


@contextmanager
def workers(count: int) -> Iterator[Executor]:
    """An executor of `count` processes; what raises out of the block ends them at once.

    Notes
        A forked process has every module loaded already; other systems than Linux start theirs anew.
    """
    context = get_context("fork" if sys.platform == "linux" else None)
    pool = ProcessPoolExecutor(count, mp_context=context, initializer=_begin)
    results = pool._result_queue
    try:
        yield pool
    except BaseException:
        # What they are at is lost; waiting for it would make the user wait.
        pool.shutdown(wait=False, cancel_futures=True)
        for child in active_children():
            child.terminate()
        # The thread that reads results would wait for ever for the rest of one that a worker was writing: its end comes
        # when nobody can write any more, this process included.
        results._writer.close()  # type: ignore[attr-defined]
        raise
    finally:
        pool.shutdown()


def _begin() -> None:
    """The parent alone answers Ctrl-C, so that no worker prints of it; and its end is a worker's."""
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
