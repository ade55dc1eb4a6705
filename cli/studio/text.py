"""The text of a design file that changes value by value: comments, order and the way it is written stay."""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable
from pathlib import Path
from typing import Any

import yaml

from gearlink.cli.files import write_atomically
from gearlink.cli.reading.design_file import read_at_most
from gearlink.cli.reading.loaded_file import KeyPath, parse_path
from gearlink.cli.reading.yaml_reader import MAX_BYTES, EventParser, decode, format_path
from gearlink.cli.texts.written_design import flow, scalar
from gearlink.core.base.errors import GearlinkError

_NUMBER = re.compile(r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?")
_MOST_STEPS = 500


class CannotPlace(GearlinkError):
    """A value has no place in the text: it must be typed."""


# A value instead


def with_value(text: str, path: KeyPath, value: Any, *, as_written: bool = False) -> str:
    """The text with another value at a key path.

    Parameters
        value : None leaves the key out; a key that is missing is added behind the last one of its section
        as_written : bool - a number is in the unit that stands behind it, not in the unit of its key
    Returns
        text : str - read again it gives the data with that value put in, and nothing else has changed
    Raises
        CannotPlace - where the path leads through what is no section, or beyond a list; yaml.YAMLError - no YAML
    Example
        >>> with_value("kind: x\\nrod: 520   # EF\\n", ("rod",), 530.0)
        'kind: x\\nrod: 530   # EF\\n'
        >>> with_value("size: {a: 1, b: 2}   # mm\\n", ("size", "c"), 0.5)
        'size: {a: 1, b: 2, c: 0.5}   # mm\\n'
    """
    root = yaml.compose(text, Loader=EventParser)
    node, depth = _deepest(root, path)
    if depth == len(path):
        return _left_out(text, root, path) if value is None else _exchanged(text, node, value, as_written)
    rest = path[depth:]
    if value is None:
        return text
    if not isinstance(node, yaml.MappingNode) or not all(isinstance(step, str) for step in rest):
        raise CannotPlace(f"{format_path(path)} is not in the file\ntype it")
    for step in reversed(rest[1:]):
        value = {step: value}
    return _added(text, node, str(rest[0]), value, root is node)


def with_values(text: str, values: Iterable[tuple[str, Any]]) -> str:
    """The text with other values at dotted paths; as `with_value`."""
    for name, value in values:
        path = parse_path(name)
        if path is None:
            raise CannotPlace(f"{name} is not the path of a key")
        text = with_value(text, path, value)
    return text


def _deepest(node: Any, path: KeyPath) -> tuple[Any, int]:
    """The node at the longest part of a path that the text has, and how many steps that are."""
    for depth, step in enumerate(path):
        inner = None
        if isinstance(node, yaml.MappingNode):
            inner = next((value for key, value in node.value if key.value == step), None)
        elif isinstance(node, yaml.SequenceNode) and isinstance(step, int) and step < len(node.value):
            inner = node.value[step]
        if inner is None:
            return node, depth
        node = inner
    return node, len(path)


def _end(node: Any) -> int:
    """Where the last character of a value stands; the marks of a block section reach to what follows it."""
    if isinstance(node, yaml.ScalarNode) or node.flow_style or not node.value:
        return int(node.end_mark.index)
    last = node.value[-1]
    return max(_end(each) for each in (last if isinstance(last, tuple) else (last,)))


def _exchanged(text: str, node: Any, value: Any, as_written: bool) -> str:
    start, end = node.start_mark.index, _end(node)
    if as_written and (number := _NUMBER.search(text, start, end)):
        start, end = number.span()
    lead = " " if end == start and text[start - 1 : start] == ":" else ""  # a key without a value
    return f"{text[:start]}{lead}{flow(value)}{text[end:]}"


def _added(text: str, node: Any, key: str, value: Any, at_root: bool) -> str:
    entry = f"{scalar(key)}: {flow(value)}"
    if node.flow_style:
        end = _end(node.value[-1][1]) if node.value else node.start_mark.index + 1
        return f"{text[:end]}{', ' if node.value else ''}{entry}{text[end:]}"
    first, last = node.value[0][0], _end(node.value[-1][1])
    indent = " " * (0 if at_root else first.start_mark.column)
    stop = text.find("\n", last)
    if stop < 0:
        return f"{text}\n{indent}{entry}\n"
    return f"{text[:stop]}\n{indent}{entry}{text[stop:]}"


def _left_out(text: str, root: Any, path: KeyPath) -> str:
    parent, _ = _deepest(root, path[:-1])
    if not isinstance(parent, yaml.MappingNode):
        raise CannotPlace(f"{format_path(path)} is an entry of a list: delete it in the text")
    place = next(i for i, (key, _) in enumerate(parent.value) if key.value == path[-1])
    if len(parent.value) == 1:  # a section without keys would be another thing than none
        if len(path) > 1:
            return _left_out(text, root, path[:-1])
        raise CannotPlace("the file would be empty")
    key, value = parent.value[place]
    if parent.flow_style:
        start = key.start_mark.index if place == 0 else _end(parent.value[place - 1][1])
        end = parent.value[1][0].start_mark.index if place == 0 else _end(value)
        return text[:start] + text[end:]
    start, stop = text.rfind("\n", 0, key.start_mark.index) + 1, text.find("\n", _end(value))
    if text[start : key.start_mark.index].strip():  # behind the dash of an entry
        return text[: key.start_mark.index] + text[parent.value[place + 1][0].start_mark.index :]
    return text[:start] + ("" if stop < 0 else text[stop + 1 :])


# The file


class Changed(GearlinkError):
    """Another program has written the file since it was read."""


class Document:
    """A file that is open: its text, and what that was before.

    Notes
        The text has \\n at the end of its lines, as an editor in the browser has; `save` writes the ends that the file
        had, and its byte order mark.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        self._before: list[str] = []
        self._after: list[str] = []
        self._hand = ""
        self._read()

    def _read(self) -> None:
        data = read_at_most(self.path, MAX_BYTES + 1)
        text = decode(data, str(self.path)).text
        self._mark = b"\xef\xbb\xbf" if data.startswith(b"\xef\xbb\xbf") else b""
        self._break = "\r\n" if "\r\n" in text and "\n" not in text.replace("\r\n", "") else "\n"
        self.text = text.replace("\r\n", "\n") if self._break == "\r\n" else text
        self.saved, self._seen = self.text, hashlib.sha256(data).digest()

    def change(self, text: str, hand: str = "") -> bool:
        """Put another text in; changes of one hand, a slider that is held, are one step of `undo`.

        Returns
            whether it is another
        """
        if text == self.text:
            return False
        if not hand or hand != self._hand:
            self._before = [*self._before[-_MOST_STEPS:], self.text]
        self._hand, self.text = hand, text
        self._after.clear()
        return True

    def rest(self) -> None:
        """The hand is taken off: what it changes next is a step of its own."""
        self._hand = ""

    @property
    def can(self) -> dict[str, bool]:
        """Which of undo, redo, save and revert would do something."""
        unsaved = self.text != self.saved
        return {"undo": bool(self._before), "redo": bool(self._after), "save": unsaved, "revert": unsaved}

    def undo(self) -> bool:
        """Take a step back; whether there was one."""
        return self._step(self._before, self._after)

    def redo(self) -> bool:
        """Take back what was undone; whether there was anything."""
        return self._step(self._after, self._before)

    def _step(self, taken: list[str], kept: list[str]) -> bool:
        if not taken:
            return False
        kept.append(self.text)
        self.text = taken.pop()
        self._hand = ""
        return True

    def save(self) -> None:
        """Write the file, and nothing else ever does.

        Raises
            Changed - where another program has written it since; CannotWrite
        """
        now = self.path.read_bytes() if self.path.exists() else None
        if now is not None and hashlib.sha256(now).digest() != self._seen:
            raise Changed(
                f"{self.path.name} was changed by another program: Revert reads it, then Undo brings yours back"
            )
        data = self._mark + self.text.replace("\n", self._break).encode()
        write_atomically(self.path, lambda stream: stream.write(data))
        self.saved, self._seen = self.text, hashlib.sha256(data).digest()

    def revert(self) -> None:
        """The file as it stands on the disk; `undo` brings back what was changed.

        Raises
            DesignFileError - where it cannot be read
        """
        was = self.text
        self._read()
        now, self.text = self.text, was
        self.change(now)
        self._hand = ""
