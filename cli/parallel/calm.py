"""Ctrl-C where what is finished is worth keeping: the first asks for the end, a second one ends the process."""

from __future__ import annotations

import signal
import threading
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from types import FrameType


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
