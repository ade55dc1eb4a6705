"""Names with a few words each, as plain text that fits the terminal."""

from __future__ import annotations

import textwrap
from collections.abc import Iterable
from shutil import get_terminal_size

_WIDEST, _NARROWEST = 100, 40


def width() -> int:
    """Columns of running text: those of the terminal, 80 where there is none, so many that lines can be read."""
    return max(_NARROWEST, min(_WIDEST, get_terminal_size((80, 24)).columns))


def hanging(words: str, indent: str = "  ", first: str = "") -> str:
    """Words on as many lines as the terminal needs, all but the first behind an indent."""
    return "\n".join(
        textwrap.wrap(
            words,
            width(),
            initial_indent=first,
            subsequent_indent=indent,
            break_long_words=False,
            break_on_hyphens=False,
        )
    )


def listed(rows: Iterable[tuple[str, str]]) -> str:
    """A line for each name, its words below each other."""
    known = list(rows)
    column = max((len(name) for name, _ in known), default=0) + 2
    return "\n".join(hanging(f"{name:<{column}}{words}", " " * column) for name, words in known)
