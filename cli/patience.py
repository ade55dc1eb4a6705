"""A word on a terminal where something takes longer than a second."""

from __future__ import annotations

import sys
from collections.abc import Iterator
from contextlib import contextmanager

_AFTER = 1.0


@contextmanager
def patience(words: str, *, quiet: bool = False) -> Iterator[None]:
    """Say what is going on once it takes more than a second, and take the words back when it is done.

    Parameters
        words : str - "drawing ty460", shown with dots behind it
        quiet : bool - say nothing; nothing is said either where standard error is no terminal
    """
    if quiet or not sys.stderr.isatty():
        yield
        return
    from threading import Timer

    said = False

    def say() -> None:
        nonlocal said
        said = True
        print(f"{words} ...", end="", file=sys.stderr, flush=True)

    timer = Timer(_AFTER, say)
    timer.daemon = True
    timer.start()
    try:
        yield
    finally:
        timer.cancel()
        timer.join()
        if said:
            print("\r\033[K", end="", file=sys.stderr, flush=True)
