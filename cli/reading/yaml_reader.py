"""Bytes of a design file to plain data, with the place of every key: YAML 1.2 scalars on PyYAML's event parser.

PyYAML's own loading is left aside: it reads `1e-6` as text, `40:20` as 2420 and `no` as False, keeps the last of
two equal keys, and its C loader falls over at deep nesting. The events of its C parser are safe and fast; they are
put together here on a stack of our own, with caps on size, depth and, for aliases, on what they expand to.
"""

from __future__ import annotations

import math
import re
from dataclasses import dataclass, field
from typing import Any

import yaml
from yaml import events as ev

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic, Source

EventParser: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)
"""Only its events are used; the pure Python one serves where PyYAML was built without libyaml."""

MAX_BYTES = 1 << 20
MAX_DEPTH = 32
MAX_NODES = 20_000

Marks = dict[str | int, tuple[int, int, "Marks | None"]]
"""Of each key or list index: position of the key (for a list: the element), of the value, marks inside the value."""

_BOMS = (
    (b"\xff\xfe\x00\x00", "UTF-32"),
    (b"\x00\x00\xfe\xff", "UTF-32"),
    (b"\xff\xfe", "UTF-16"),
    (b"\xfe\xff", "UTF-16"),
)
CONTROL = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\x7f-\x9f\u2028\u2029\ud800-\udfff\ufffe\uffff]")
"""What is no text; stated by what is left out it would take 20 times as long to compile."""
_DIRECTIVE = re.compile(r"(?:[ \t]*(?:#[^\r\n]*)?[\r\n]+)*+%")
_NOTHING = re.compile(r"(?:\s++|#[^\r\n]*+)*+")
_INTEGER = re.compile(r"[-+]?[0-9]+|0o[0-7]+|0x[0-9a-fA-F]+")
_FLOAT = re.compile(r"[-+]?(?:\.[0-9]+|[0-9]+(?:\.[0-9]*)?)(?:[eE][-+]?[0-9]+)?")
_WORDS: dict[str, Any] = {
    **dict.fromkeys(("", "~", "null", "Null", "NULL")),
    **dict.fromkeys(("true", "True", "TRUE"), True),
    **dict.fromkeys(("false", "False", "FALSE"), False),
    **dict.fromkeys((".nan", ".NaN", ".NAN"), math.nan),
    **{sign + word: math.inf for sign in ("", "+") for word in (".inf", ".Inf", ".INF")},
    **dict.fromkeys(("-.inf", "-.Inf", "-.INF"), -math.inf),
}
_BASES = {"0o": 8, "0x": 16}
_EXACT_LENGTH = 15
_TOO_DEEP = f"nested deeper than {MAX_DEPTH} levels"


@dataclass(frozen=True, slots=True)
class Tree:
    """What a text holds: data, the places of its keys, and errors that did not hinder the reading."""

    source: Source
    data: Any
    marks: Marks | None
    at: int
    problems: list[Diagnostic] = field(default_factory=list)


def read(data: bytes, file: str) -> Tree:
    """The mapping that a design file holds.

    Raises
        DesignFileError - GL102 encoding, GL103 not YAML or not a mapping, GL110 too large or too deep
    """
    if len(data) > MAX_BYTES:
        message = f"larger than {MAX_BYTES >> 20} MiB: this is not a design file"
        raise DesignFileError([Diagnostic("GL110", message, file)])
    source = decode(data, file)
    if directive := _DIRECTIVE.match(source.text):
        at = directive.end() - 1
        raise _fatal(source, "GL103", "directives are not supported", at, help="delete the line with '%'")
    tree = compose(source)
    if not isinstance(tree.data, dict):
        raise DesignFileError([_no_mapping(tree)])
    return tree


def decode(data: bytes, file: str) -> Source:
    """The text of a file in UTF-8, with or without a byte order mark.

    Raises
        DesignFileError - GL102 for another encoding or a control character
    """
    for mark, name in _BOMS:
        if data.startswith(mark):
            raise DesignFileError([Diagnostic("GL102", f"in {name}, not UTF-8", file, help="save it as UTF-8")])
    data = data.removeprefix(b"\xef\xbb\xbf")
    try:
        source = Source(file, data.decode("utf-8"))
    except UnicodeDecodeError as error:
        source = Source(file, data.decode("utf-8", "replace"))
        at = len(data[: error.start].decode("utf-8"))
        message = f"not UTF-8: byte 0x{data[error.start]:02x}"
        raise _fatal(source, "GL102", message, at, help="save the file as UTF-8") from None
    if control := CONTROL.search(source.text):
        char = control[0]
        what = "a NUL byte" if char == "\0" else f"control character U+{ord(char):04X}"
        remedy = "save the file as UTF-8" if char == "\0" else "delete it"
        raise _fatal(source, "GL102", f"{what}: this is not plain text", control.start(), help=remedy)
    return source


def plain_value(text: str) -> Any:
    """The value of an unquoted scalar in the core schema of YAML 1.2.

    Notes
        Integers of more than 15 characters become floats: no design counts so far, and int() is quadratic.
    Example
        >>> [plain_value(text) for text in ("1e-6", "-.5", "010", "0o10", "40:20", "no", "~", "True")]
        [1e-06, -0.5, 10, 8, '40:20', 'no', None, True]
    """
    if text in _WORDS:
        return _WORDS[text]
    if text[0] not in "+-.0123456789":
        return text
    if _INTEGER.fullmatch(text):
        base = _BASES.get(text[:2], 10)
        if len(text) <= _EXACT_LENGTH:
            return int(text, base) if base == 10 else int(text[2:], base)
        return float(text) if base == 10 else _large(text[2:], base)
    return _fraction(text) if _FLOAT.fullmatch(text) else text


def _fraction(text: str) -> float:
    """A number that is not 0 does not become 0 however small it is: its check refuses it then."""
    value = float(text)
    if value == 0.0 and re.search("[1-9]", re.split("[eE]", text)[0]):
        return math.copysign(math.ulp(0.0), value)
    return value


def _large(digits: str, base: int) -> float:
    try:
        return float(int(digits, base))
    except OverflowError:
        return math.inf


def compose(source: Source, start: int = 0) -> Tree:
    """The one value that a text holds from a position on.

    Raises
        DesignFileError - GL103 for a syntax error, GL110 beyond the caps
    """
    composer = _Composer(source, start)
    try:
        return composer.run()
    except yaml.YAMLError as error:
        from gearlink.cli.reading.yaml_remedies import nested_too_deep, syntax_error

        if (at := nested_too_deep(error)) is not None:
            raise _fatal(source, "GL110", _TOO_DEEP, start + at) from None
        wrong = syntax_error(source, start, error)
        raise DesignFileError([*composer.duplicates, wrong]) from None


class _Frame:
    """A mapping or list that is still being filled."""

    __slots__ = ("anchor", "at", "data", "height", "key", "key_at", "marks", "nodes_before", "repeated")

    def __init__(self, data: dict[str, Any] | list[Any], at: int, anchor: str | None, nodes: int) -> None:
        self.data: Any = data
        self.marks: Marks = {}
        self.at = at
        self.anchor = anchor
        self.nodes_before = nodes
        self.height = 1
        self.key: str | None = None
        self.key_at = 0
        self.repeated = False

    def add(self, value: Any, at: int, marks: Marks | None) -> None:
        """Take the value of the waiting key, or the next element."""
        if self.key is None:
            self.marks[len(self.data)] = (at, at, marks)
            self.data.append(value)
            return
        if not self.repeated:
            self.marks[self.key] = (self.key_at, at, marks)
            self.data[self.key] = value
        self.key = None


class _Composer:
    """Puts parser events together; iterative, because a design file may not overflow a stack."""

    def __init__(self, source: Source, start: int) -> None:
        self.source = source
        self.start = start
        self.duplicates: list[Diagnostic] = []
        self._wrong: list[Diagnostic] = []
        self._frames: list[_Frame] = []
        self._anchors: dict[str, tuple[Any, Marks | None, int, int] | None] = {}
        self._nodes = 0
        self._root: tuple[Any, int, Marks | None] | None = None

    def run(self) -> Tree:
        text = self.source.text[self.start :] if self.start else self.source.text
        parser = EventParser(text)
        handlers = {
            ev.ScalarEvent: self._scalar,
            ev.AliasEvent: self._alias,
            ev.MappingStartEvent: self._open_mapping,
            ev.SequenceStartEvent: self._open_list,
            ev.MappingEndEvent: self._close,
            ev.SequenceEndEvent: self._close,
        }
        while True:
            event: Any = parser.get_event()
            at = self.start + event.start_mark.index
            handler = handlers.get(type(event))
            if handler is not None:
                handler(event, at)
            elif type(event) is ev.DocumentEndEvent:
                self._nothing_after(at)
                break
            elif type(event) is ev.StreamEndEvent:
                break
        if self._wrong:
            raise DesignFileError([*self.duplicates, *self._wrong])
        data, at, marks = self._root or (None, self.start, None)
        return Tree(self.source, data, marks, at, self.duplicates)

    def _scalar(self, event: Any, at: int) -> None:
        text = event.value
        if event.anchor is not None or event.tag is not None:
            self._no_tag(event, at)
        if self._awaits_key():
            self._take_key(event, text, at)
            if event.anchor is not None:
                self._anchors[event.anchor] = (text, None, 1, 0)
            return
        if event.implicit[0]:
            value = plain_value(text)
        else:
            value = text
            if not text.isprintable() and (control := CONTROL.search(text)):
                self._note(f"an escape for the control character U+{ord(control[0]):04X}", at, "omit it")
        self._place(value, at, None, event.anchor, 1, 0)

    def _alias(self, event: Any, at: int) -> None:
        known = self._anchors.get(event.anchor)
        if known is None:
            inside = event.anchor in self._anchors
            message = "an alias inside its own value" if inside else f"no anchor '&{event.anchor}' above"
            raise _fatal(self.source, "GL103", message, at, help="put text that begins with '*' in quotes")
        value, marks, nodes, height = known
        if self._awaits_key():
            raise _fatal(self.source, "GL103", "an alias cannot be a key", at)
        self._place(value, at, marks, None, nodes, height)

    def _open_mapping(self, event: Any, at: int) -> None:
        self._open({}, event, at)

    def _open_list(self, event: Any, at: int) -> None:
        self._open([], event, at)

    def _open(self, data: Any, event: Any, at: int) -> None:
        if self._awaits_key():
            help = "take the braces or brackets away, or put text with them in quotes"
            raise _fatal(self.source, "GL103", "a key must be one word, not a list or a section", at, help=help)
        if event.anchor is not None or event.tag is not None:
            self._no_tag(event, at)
            if event.anchor is not None:
                self._anchors[event.anchor] = None
        self._frames.append(_Frame(data, at, event.anchor, self._nodes))
        self._check_size(at, 0, 0)

    def _close(self, _event: Any, _at: int) -> None:
        frame = self._frames.pop()
        nodes = self._nodes - frame.nodes_before + 1
        self._place(frame.data, frame.at, frame.marks, frame.anchor, nodes, frame.height, counted=nodes - 1)

    def _place(
        self, value: Any, at: int, marks: Marks | None, anchor: str | None, nodes: int, height: int, counted: int = 0
    ) -> None:
        """Hand a finished value to the mapping or list that it stands in."""
        self._check_size(at, nodes - counted, height)
        if anchor is not None:
            self._anchors[anchor] = (value, marks, nodes, height)
        if not self._frames:
            self._root = (value, at, marks)
            return
        parent = self._frames[-1]
        parent.add(value, at, marks)
        if height >= parent.height:
            parent.height = height + 1

    def _check_size(self, at: int, nodes: int, height: int) -> None:
        self._nodes += nodes
        if len(self._frames) + height > MAX_DEPTH:
            raise _fatal(self.source, "GL110", _TOO_DEEP, at)
        if self._nodes > MAX_NODES:
            raise _fatal(self.source, "GL110", f"more than {MAX_NODES} values (aliases written out)", at)

    def _awaits_key(self) -> bool:
        return bool(self._frames) and self._frames[-1].key is None and type(self._frames[-1].data) is dict

    def _take_key(self, event: Any, key: str, at: int) -> None:
        frame = self._frames[-1]
        frame.key, frame.key_at = key, at
        frame.repeated = key in frame.data
        if frame.repeated:
            line = self.source.place(frame.marks[key][0])[0]
            message = f"the key {_short(key)} is already given in line {line}"
            path = format_path(self._path())
            remedy = "keep one of the two"
            self.duplicates.append(self.source.report("GL104", message, at, key=path, help=remedy))
        elif not (key.isascii() and key.isprintable()):
            self._look_for_odd(key, at)
        elif key == "<<" and event.implicit[0]:
            self._note("merge keys ('<<') are not part of YAML 1.2", at, "write the keys out")
        elif not key:
            self._note("a key is missing before the colon", at, "write the key, a colon, a space, the value")

    def _look_for_odd(self, key: str, at: int) -> None:
        from gearlink.cli.reading.yaml_remedies import ODD, odd_character, odd_remedy

        if odd := ODD.search(key) or CONTROL.search(key):
            plain = self.source.text.startswith(key, at)
            message = f"{odd_character(odd[0])} in a key"
            self._note(message, at + odd.start() if plain else at, odd_remedy(odd[0]))

    def _no_tag(self, event: Any, at: int) -> None:
        if event.tag is not None:
            remedy = "write 2 for a number, true or false, '2' in quotes for text"
            self._note(f"tags such as {_short(event.tag)} are not supported", at, remedy)

    def _note(self, message: str, at: int, remedy: str) -> None:
        self._wrong.append(self.source.report("GL103", message, at, help=remedy))

    def _path(self) -> tuple[str | int, ...]:
        return tuple(len(frame.data) if frame.key is None else frame.key for frame in self._frames)

    def _nothing_after(self, at: int) -> None:
        text = self.source.text
        end = at + 3 if text.startswith("...", at) else at
        blank = _NOTHING.match(text, end)
        rest = blank.end() if blank else end
        if rest == len(text):
            return
        if self._root and type(self._root[0]) not in (dict, list):
            from gearlink.cli.reading.yaml_remedies import hidden_culprit

            if odd := hidden_culprit(self.source, rest, 0):
                raise DesignFileError([odd])
        second = text.startswith("---", rest) or end != at
        message = "a second document begins: a design file has only one" if second else "text after the end of the data"
        raise _fatal(self.source, "GL103", message, rest, help="delete it, or make it a file of its own")


def format_path(path: tuple[str | int, ...]) -> str:
    """A key path as it is written in messages.

    Example
        >>> format_path(("gears", "teeth", 1))
        'gears.teeth[1]'
        >>> format_path(("tolerance", "sources", "links.crank", "cpk"))
        'tolerance.sources."links.crank".cpk'
    """
    return "".join(f"[{step}]" if isinstance(step, int) else f".{_quoted(step)}" for step in path).removeprefix(".")


def _quoted(step: str) -> str:
    """A key in quotes where it has a dot or a bracket of its own."""
    return f'"{step}"' if {".", "["} & set(step) else step


def _no_mapping(tree: Tree) -> Diagnostic:
    source, data = tree.source, tree.data
    if data is None:
        remedy = "`gearlink new KIND` prints a template"
        return source.report("GL103", "the file is empty: it contains no design", tree.at, help=remedy)
    if isinstance(data, str):
        from gearlink.cli.reading.yaml_remedies import hidden_culprit

        if culprit := hidden_culprit(source, len(source.text), tree.at):
            return culprit
    what = "a list" if isinstance(data, list) else "a single value"
    message = f"a design file is made of 'key: value' lines, not of {what}"
    return source.report("GL103", message, tree.at, help="begin with a line such as 'kind: gear-pair'")


def _fatal(source: Source, code: str, message: str, at: int, *, help: str = "") -> DesignFileError:
    return DesignFileError([source.report(code, message, at, help=help)])


def _short(text: str) -> str:
    return repr(text if len(text) <= 40 else text[:37] + "...")
