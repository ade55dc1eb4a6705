"""Which files a result was made of: every reader of a design's files tells them here."""

from __future__ import annotations

import os
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

_NOTED: ContextVar[dict[str, bytes] | None] = ContextVar("noted", default=None)


@contextmanager
def files_read() -> Iterator[dict[str, bytes]]:
    """The content of the files that are read within, by their paths."""
    found: dict[str, bytes] = {}
    token = _NOTED.set(found)
    try:
        yield found
    finally:
        _NOTED.reset(token)


def note(path: str | os.PathLike[str], content: bytes) -> None:
    """Tell what a file held when it was read."""
    noted = _NOTED.get()
    if noted is not None:
        noted[os.fspath(path)] = content
