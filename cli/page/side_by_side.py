"""Pieces of a page made side by side: every process takes the next that none has taken yet."""

from __future__ import annotations

import os
import sys
from collections.abc import Callable
from contextlib import suppress
from typing import Any, TypeAlias

from gearlink.core.errors import GearlinkError

Make: TypeAlias = Callable[[int], Any]

_TASKS: list[tuple[Make, int]] = []
"""What forked processes make, and where they read which is next: they need no way to it."""


class _Refused(GearlinkError):
    """Some piece cannot be made; the other processes need not go on."""


def side_by_side(make: Make, count: int) -> list[Any] | None:
    """`make` of 0 to count - 1, the first in this process, the others where one is free, the last of them first.

    Parameters
        make : gives what can be sent from a process to another
        count : int - below 256
    Returns
        what was made, in order; None on a machine with a single processor, and where a piece was refused or a
        process died
    """
    spare = len(os.sched_getaffinity(0)) - 1 if sys.platform == "linux" else 0
    if min(spare, count - 1) < 1:
        return None
    from concurrent.futures import BrokenExecutor

    from gearlink.cli.parallel.workers import workers

    following, write = os.pipe()  # a byte is read by one process alone
    os.write(write, bytes(range(count - 1, 0, -1)))
    os.close(write)
    _TASKS[:] = [(make, following)]
    try:
        with workers(min(spare, count - 1)) as pool:
            others = [pool.submit(_taken) for _ in range(min(spare, count - 1))]
            found = {0: make(0)} | _taken()
            for other in others:
                found |= other.result()
            if len(found) < count:
                raise _Refused("a piece cannot be made")
    except (GearlinkError, BrokenExecutor):
        return None
    finally:
        os.close(following)
        _TASKS.clear()
    return [found[i] for i in range(count)]


def _taken() -> dict[int, Any]:
    """Make what nobody has taken until nothing is left; what was refused is missing."""
    ((make, following),) = _TASKS
    found: dict[int, Any] = {}
    while number := os.read(following, 1):
        with suppress(GearlinkError):
            found[number[0]] = make(number[0])
    return found
