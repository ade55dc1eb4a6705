"""A word on a terminal where something takes longer than a second."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager

from gearlink.cli.progress import progress


@contextmanager
def patience(words: str, *, quiet: bool = False) -> Iterator[None]:
    """Say what is going on, and for how long, once it takes more than a second; take the words back when it is done.

    Parameters
        words : str - "drawing ty460", shown with dots and the time that has passed behind it
        quiet : bool - say nothing; nothing is said either where standard error is no terminal
    """
    with progress(1, words, quiet=quiet):
        yield
