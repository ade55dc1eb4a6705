"""What libraries say for themselves when they are loaded, kept from this program's standard error."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager


@contextmanager
def without_notes(library: str) -> Iterator[None]:
    """Keep a library's warnings back while it is loaded: that a home without room for its cache makes it slower.

    Notes
        Its level of logging is put back, for in a notebook it is the user's.
    """
    import logging

    logger = logging.getLogger(library)
    before = logger.level
    logger.setLevel(logging.ERROR)
    try:
        yield
    finally:
        logger.setLevel(before)
