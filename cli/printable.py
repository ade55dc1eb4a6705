"""Text of strangers (file names, names of designs, lines of a file) as it can be printed without doing anything.

One rule for every output that people or a CI's log read: a character that does not show is escaped, and of two colons
or two number signs in a row the first, since runners of CI take `::error::`, `##[error]` and `##vso[...]` in a log
for commands.
"""

from __future__ import annotations

import re
import sys
from collections.abc import Iterable
from typing import Any

_COMMAND = r":(?=:)|#(?=#)"


def visible(text: str, encoding: str = "utf-8") -> str:
    """The text on one line with every character escaped that does not show, cannot be encoded or opens a command.

    Example
        >>> print(visible("a" + chr(0xA0) + "b" + chr(27)), visible("20\u00b0", "ascii"), visible("::error::##[x]"))
        a\\xa0b\\x1b 20\\xb0 \\x3a:error\\x3a:\\x23#[x]
    """
    if text.isascii() and text.isprintable() and "::" not in text and "##" not in text:
        return text
    return "".join(glyphs(text, encoding))


def for_shell(word: str) -> str:
    """A word of a command line in quotes where it needs them: those of a Unix shell, or those that all of Windows take.

    Example
        >>> print(for_shell("links.crank=16.4"), for_shell("a design.yaml"))
        links.crank=16.4 'a design.yaml'
    """
    if sys.platform == "win32":
        from subprocess import list2cmdline

        return list2cmdline([word])
    from shlex import quote

    return quote(word)


def visible_lines(lines: Iterable[str]) -> str:
    """Lines made visible, each on its own."""
    return "\n".join(map(visible, lines))


def glyphs(text: str, encoding: str = "utf-8") -> list[str]:
    """What `visible` shows, character by character."""
    opens = {match.start() for match in re.finditer(_COMMAND, text)}
    return [f"\\x{ord(char):x}" if i in opens else _glyph(char, encoding) for i, char in enumerate(text)]


def _glyph(char: str, encoding: str) -> str:
    try:
        char.encode(encoding)
    except UnicodeEncodeError:
        return char.encode("unicode_escape").decode()
    return char if char.isprintable() else char.encode("unicode_escape").decode()


_NOT_ASCII = "[^\x00-\x7e]|#(?=#)"


def json_text(value: Any, indent: int | None = None) -> str:
    """Plain data as JSON that can be printed: the same values, what does not show or opens a command as \\u....

    Example
        >>> print(json_text({"name": "##[x]" + chr(155)}))
        {"name": "\\u0023#[x]\\u009b"}
    """
    import json

    text = json.dumps(value, ensure_ascii=False, allow_nan=False, indent=indent)
    if text.isascii() and "##" not in text and "\x7f" not in text:
        return text
    return re.sub(_NOT_ASCII, lambda match: _in_json(match[0]), text)


def _in_json(char: str) -> str:
    """A character as a string of JSON shows it; above the first 65,536 in two halves."""
    if char != "#" and char.isprintable():
        return char
    units = char.encode("utf-16-be", "surrogatepass").hex()
    return "".join(f"\\u{units[i : i + 4]}" for i in range(0, len(units), 4))


_FORMULA = ("=", "+", "-", "@", "\uff1d", "\uff0b", "\uff0d", "\uff20")


def cell(text: str) -> str:
    """The text as a cell of CSV: visible, and no spreadsheet takes it for a formula; a number stays one.

    Notes
        Where the decimal sign is a comma, spreadsheets part the cells of a CSV file at semicolons.

    Example
        >>> cell("=cmd|calc!A1"), cell("-2.5"), cell("-x")
        ("'=cmd|calc!A1", '-2.5', "'-x")
    """
    return ";".join(f"'{part}" if _is_formula(part) else part for part in visible(text).split(";"))


def _is_formula(text: str) -> bool:
    return text.startswith(_FORMULA) and not _is_number(text)


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True
