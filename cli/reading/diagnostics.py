"""What is said of a wrong design file: one record per error, shown as text with its source line, or as JSON."""

from __future__ import annotations

import re
from bisect import bisect_right
from collections.abc import Iterable
from dataclasses import dataclass, replace
from functools import cached_property

from gearlink.cli.printable import glyphs, visible
from gearlink.core.base.errors import GearlinkError

MAX_SHOWN = 100
_WINDOW = 100
_BREAK = re.compile(r"\r\n?|\n")


@dataclass(frozen=True, slots=True)
class Diagnostic:
    """One error of a design file; line and column count from 1, `source` is the whole line they lie in.

    An error has `help` where it is known, the finding of a check its fix and its notes. A message of two lines is
    what is wrong and its help.
    """

    code: str
    message: str
    file: str
    line: int = 1
    column: int = 1
    key: str = ""
    source: str = ""
    help: str = ""
    severity: str = "error"
    fix: str = ""
    note: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        what, _, below = self.message.partition("\n")
        if below and not self.help:
            object.__setattr__(self, "message", what)
            object.__setattr__(self, "help", below)

    @property
    def lines(self) -> tuple[str, ...]:
        """Message, help or fix, and notes, each to stand on a line of its own."""
        after = (("help", self.help), ("fix", self.fix), *(("note", each) for each in self.note))
        return (self.message, *(f"{word}: {text}" for word, text in after if text))

    def as_json(self) -> dict[str, str | int]:
        """The record as it stands in the `errors` of a JSON result; with `help` where a remedy is known."""
        record: dict[str, str | int] = {
            "code": self.code,
            "message": self.message,
            "file": self.file.encode("utf-8", "backslashreplace").decode(),
            "line": self.line,
            "column": self.column,
            "key": self.key,
        }
        return record | ({"help": self.help} if self.help else {})

    def as_text(self, encoding: str = "utf-8") -> str:
        """Headline, source line with a caret, help; holds only characters that the encoding can write."""
        headline = (
            f"{self.file or repr(self.file)}:{self.line}:{self.column}: {self.severity} {self.code}: {self.message}"
        )
        rows = [visible(headline, encoding)]
        if self.source.strip():
            rows += _excerpt(self.source, self.column - 1, encoding)
        rows += [f"  {visible(line, encoding)}" for line in self.lines[1:]]
        return "\n".join(rows)


class DesignFileError(GearlinkError):
    """A design file that cannot be used: all that is wrong with it, in the order of the file."""

    def __init__(self, diagnostics: Iterable[Diagnostic], omitted: int = 0) -> None:
        unique = list(dict.fromkeys(diagnostics))
        unique.sort(key=lambda d: (d.file.startswith("<--"), d.line, d.column))
        self.diagnostics = unique[:MAX_SHOWN]
        omitted += len(unique) - len(self.diagnostics)
        if omitted:
            message = f"{omitted} more errors are not shown"
            self.diagnostics.append(replace(self.diagnostics[-1], code="GL110", message=message, key="", help=""))
        super().__init__(self.diagnostics)
        first = self.diagnostics[0]
        self.file, self.line, self.column, self.key = first.file, first.line, first.column, first.key

    def __str__(self) -> str:
        return "\n".join(diagnostic.as_text() for diagnostic in self.diagnostics)


class Source:
    """A named text whose character positions can be given as line and column."""

    def __init__(self, file: str, text: str) -> None:
        self.file = file
        self.text = text
        self._lines: dict[int, str] = {}

    @cached_property
    def _starts(self) -> list[int]:
        return [0, *(match.end() for match in _BREAK.finditer(self.text))]

    def place(self, index: int) -> tuple[int, int]:
        """Line and column, counted from 1, of a character position; the end of the text is a position too."""
        line = bisect_right(self._starts, index)
        return line, index - self._starts[line - 1] + 1

    def line(self, number: int) -> str:
        """A line without its break; kept, so that the errors of one long line share one string."""
        if number not in self._lines:
            start, *rest = self._starts[number - 1 : number + 1]
            self._lines[number] = self.text[start : rest[0] if rest else None].rstrip("\r\n")
        return self._lines[number]

    def line_start(self, number: int) -> int:
        """Position of a line's first character."""
        return self._starts[number - 1]

    def report(self, code: str, message: str, index: int, *, key: str = "", help: str = "") -> Diagnostic:
        """A diagnostic that points at a character position."""
        line, column = self.place(index)
        return Diagnostic(code, message, self.file, line, column, key, self.line(line), help)


def _excerpt(source: str, at: int, encoding: str) -> list[str]:
    """The part of a source line around a column, and under it the caret."""
    first = 0 if len(source) <= _WINDOW else max(0, min(at, len(source)) - 2 * _WINDOW // 3)
    shown = glyphs(source[first : first + _WINDOW], encoding)
    lead = "..." if first else ""
    tail = "..." if first + _WINDOW < len(source) else ""
    before = lead + "".join(shown[: max(0, at - first)])
    return [f"  {lead}{''.join(shown)}{tail}", "  " + " " * _width(before) + "^"]


def _width(text: str) -> int:
    """Columns that a text takes on a terminal, where Chinese characters are two wide."""
    if text.isascii():
        return len(text)
    from unicodedata import combining, east_asian_width

    return sum(0 if combining(char) else 2 if east_asian_width(char) in "WF" else 1 for char in text)
