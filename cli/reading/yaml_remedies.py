"""What is behind a YAML syntax error, in a designer's words: tabs, odd spaces, a colon without its space, ..."""

from __future__ import annotations

import re
from unicodedata import name as character_name

from yaml.error import MarkedYAMLError, YAMLError

from gearlink.cli.reading.diagnostics import Diagnostic, Source

ODD = re.compile("[\u00a0\u1680\u2000-\u200f\u2028-\u202f\u205f\u2060\u3000\ufeff\uff01-\uff5e\u2018-\u201f]")
_GLUED = re.compile(r"\s*(?:- +)?[\"']?([A-Za-z_][\w-]*)[\"']?(:)(?=[^\s:/])")
_QUOTED = re.compile(r"\"(?:[^\"\\]|\\.)*+\"|'[^']*'|(?:^|(?<=\s))#.*")
_COLON = re.compile(r":(?=\s|$)")
_SEARCHED_LINES = 3
_SHOWN = 40
_LONGEST_KEY = 1024  # of a key without '? ', by the YAML specification (7.4.3, 8.2.2)

_ALIKE = "indent all keys of one section by the same number of spaces; put text that contains ': ' in quotes"
_TAB = "indent with spaces"
_WORDING = (
    (
        r"mapping values are not allowed",
        "a colon that is not allowed here: a wrong indentation or two keys on a line",
        _ALIKE,
    ),
    (
        r"could not find expected ':'",
        "no 'key: value': the colon is missing",
        "write the key, a colon, a space, the value",
    ),
    (r"expected key|expected <block end>|expected '-' indicator", "the indentation matches no section above", _ALIKE),
    (
        r"escape",
        "an escape in double quotes that YAML does not know",
        "use single quotes, or \\\\ for a backslash and \\UXXXXXXXX for a character beyond \\uFFFF",
    ),
    (
        r"expected node content|expected the node content",
        "a value was expected here",
        "put text that begins with a sign in quotes",
    ),
    (
        r"alphabetic or numeric",
        "'&' and '*' mark anchors and aliases",
        "put text that begins with such a sign in quotes",
    ),
)


def odd_character(char: str) -> str:
    """Name and code of a character that looks like another one."""
    return f"U+{ord(char):04X} ({character_name(char, 'unnamed').lower()})"


def odd_remedy(char: str) -> str:
    """What to type instead of an odd space, full-width sign or curly quotation mark."""
    plain = chr(ord(char) - 0xFEE0) if "\uff01" <= char <= "\uff5e" else {"\u2018": "'", "\u2019": "'"}.get(char)
    if plain is None:
        plain = '"' if "\u201a" <= char <= "\u201f" else "an ordinary space or nothing"
    return f"type {plain} instead"


def nested_too_deep(error: YAMLError) -> int | None:
    """Where the YAML parser came to its own limit of nesting, in the text that it was given; None for another error.

    PyYAML has one (1000 levels) from 6.0.4 on. It may be met before the parser gives any event, so that the levels
    cannot be counted: it looks ahead for the ends of keys.
    """
    if not isinstance(error, MarkedYAMLError) or error.problem_mark is None:
        return None
    return error.problem_mark.index if "nesting" in (error.problem or "") else None


def syntax_error(source: Source, base: int, error: YAMLError) -> Diagnostic:
    """The diagnostic of an exception of the YAML parser; `base` is where the parsed text begins."""
    if not isinstance(error, MarkedYAMLError) or error.problem_mark is None:
        return source.report("GL103", f"not YAML: {error}", base)
    problem = error.problem or ""
    at = min(base + error.problem_mark.index, len(source.text))
    opened = at if error.context_mark is None else base + error.context_mark.index
    if tab := _tab(source, at, problem):
        return tab
    if culprit := hidden_culprit(source, at, min(opened, at)):
        return culprit
    if long := _long_key(source, at, opened):
        return long
    if "could not find expected ':'" in problem:
        at = opened
        if entry := re.match(r"-([^\s-]\S*)", source.text[at : at + _SHOWN]):
            message = "no space after the hyphen of a list entry"
            negative = f", or '- -{entry[1]}' for a negative number" if entry[1][0].isdigit() else ""
            return source.report("GL103", message, at, help=f"write '- {entry[1]}'{negative}")
    if "end of stream" in problem:
        return source.report(
            "GL103", "a quotation mark is not closed", opened, help="write it at the end of the text as well"
        )
    if re.search(r"expected ',' or|expected ',', '", problem):
        return _unclosed(source, at, opened)
    if "cannot start any token" in problem:
        sign = source.text[at : at + 1]
        return source.report("GL103", f"a value cannot begin with {sign!r}", at, help="put the text in quotes")
    if "node content" in problem and at >= len(source.text.rstrip()):
        return source.report("GL103", "the text ends where a value was expected", at, help="close the bracket")
    for pattern, message, remedy in _WORDING:
        if re.search(pattern, problem):
            return source.report("GL103", message, at, help=remedy)
    return source.report("GL103", f"not YAML: {problem}", at)


def _tab(source: Source, at: int, problem: str) -> Diagnostic | None:
    line, column = source.place(at)
    start = source.line_start(line)
    indent = source.text[start:at]
    if "tab character" not in problem and source.text[at : at + 1] != "\t":
        if "\t" not in indent or indent.strip():
            return None
        column = indent.index("\t") + 1
    return source.report("GL103", "a tab in the indentation", start + column - 1, help=_TAB)


def _long_key(source: Source, at: int, opened: int) -> Diagnostic | None:
    """The key that is longer than the parser looks for its colon; it stops at the colon, or names the key's begin."""
    at_colon = source.text[at : at + 1] == ":"
    number = source.place(at if at_colon else opened)[0]
    start = source.line_start(number)
    line = source.line(number)
    bare = _QUOTED.sub(lambda match: "x" * len(match[0]), line)
    colon = _COLON.search(bare, (at if at_colon else opened) - start)
    if colon is None:
        return None
    key = line[: colon.start()].rstrip()
    mark = key[-1:]
    first = key.rfind(mark, 0, -1) if mark in ("'", '"') else max(key.rfind("{"), key.rfind(",")) + 1
    first += len(key[first:]) - len(key[first:].lstrip(" -"))
    if len(key) - first <= _LONGEST_KEY:
        return None
    message = f"a key of {len(key) - first} characters: YAML takes {_LONGEST_KEY}"
    return source.report("GL103", message, start + first, help="shorten it; put text that contains ': ' in quotes")


def _unclosed(source: Source, at: int, opened: int) -> Diagnostic:
    bracket = source.text[opened : opened + 1]
    if at >= len(source.text.rstrip()):
        closing = {"[": "]", "{": "}"}.get(bracket, "")
        remedy = f"write {closing!r} behind its last entry" if closing else ""
        return source.report("GL103", f"{bracket!r} is never closed", opened, help=remedy)
    line = source.place(opened)[0]
    message = f"neither a comma nor the end of the {bracket!r} of line {line}"
    return source.report("GL103", message, at, help="separate the entries with commas and close the bracket")


def hidden_culprit(source: Source, at: int, since: int) -> Diagnostic | None:
    """The odd space, full-width sign or glued colon near a place where YAML came to grief."""
    last = source.place(at)[0]
    first = max(1, min(source.place(since)[0], last - _SEARCHED_LINES), last - 10 * _SEARCHED_LINES)
    for number in range(first, last + 1):
        line = _QUOTED.sub(lambda match: "x" * len(match[0]), source.line(number))
        start = source.line_start(number)
        if (column := _odd_column(line)) is not None:
            char = line[column]
            message = f"{odd_character(char)} where YAML needs a plain sign"
            return source.report("GL103", message, start + column, help=odd_remedy(char))
        if glued := _GLUED.match(line):
            key = glued[1] if len(glued[1]) <= _SHOWN else glued[1][: _SHOWN - 3] + "..."
            message = f"no space after the colon of {key!r}"
            return source.report("GL103", message, start + glued.start(2), help=f"write '{key}: ...'")
    return None


def _odd_column(line: str) -> int | None:
    """Column of the first odd character; full-width signs in the text after a key are a writer's own."""
    for match in ODD.finditer(line):
        before = line[: match.start()]
        if not re.search(r":(\s|$)", before) or re.search(r"[{\[]", before) or not match[0].isprintable():
            return match.start()
    return None
