"""A design file as plain data whose keys can be located in its text."""

from __future__ import annotations

import re
from dataclasses import dataclass, field
from typing import Any, NamedTuple

from gearlink.cli.reading.diagnostics import Diagnostic, Source
from gearlink.cli.reading.yaml_reader import Marks, Tree, format_path

KeyPath = tuple[str | int, ...]
"""A key path: `("teeth", 1)` for `teeth[1]`."""

_PLAIN = r"(?:[-+]?[.0-9][-+.0-9eE]*|[a-z][-a-z0-9]*)(?=[\s,\]}]|$)"
_STEP = r"""(?:(?:^|(?<=.)\.)(?:(["'])([^"'=]+)\1|([^.\[\]=\s"']+))|\[([0-9]{1,6})\])"""


_SET = "<--set>"


class Override(NamedTuple):
    """A value that `--set` put in, or an option of its own; its marks are positions in the argument.

    It is settled once a design was made with it: what is put in later goes over it under any name of the key.
    """

    path: KeyPath
    value: Any
    marks: Marks | None
    source: Source
    settled: bool = False


@dataclass(slots=True)
class LoadedFile:
    """A design file as plain data whose keys can be located."""

    file: str
    data: dict[str, Any]
    tree: Tree
    overrides: list[Override] = field(default_factory=list)
    as_written: dict[KeyPath, tuple[str, float]] = field(default_factory=dict)
    """Values with units: the text of the file, and the number instead."""
    problems: list[Diagnostic] = field(default_factory=list)
    """Errors found in reading that did not hinder it (duplicate keys); `validate` reports them with its own."""

    @property
    def text(self) -> str:
        """The decoded text of the file."""
        return self.tree.source.text

    def locate(self, path: KeyPath) -> tuple[int, int, str]:
        """Line, column and file of a key; of the nearest parent where the key is missing."""
        source, at = self._spot(path)
        return *source.place(at), source.file

    def place_in_file(self, path: KeyPath) -> tuple[int, int]:
        """Line and column of a key, or of its nearest parent, in the file itself, whatever `--set` put over it."""
        at, _ = _find(self.tree.marks, path, self.tree.at, False)
        return self.tree.source.place(at)

    def value_in_file(self, path: KeyPath) -> tuple[int, int, int] | None:
        """Line, first column and the column after the number or word that a key has in the file itself; None where
        the file has no plain one there, or `--set` put another value over it."""
        at, found = _find(self.tree.marks, path, self.tree.at, True)
        plain = re.compile(_PLAIN).match(self.text, at)
        if not path or found < len(path) or plain is None or any(path[: len(o.path)] == o.path for o in self.overrides):
            return None
        line, column = self.tree.source.place(at)
        return line, column, column + len(plain[0])

    def part(self, path: KeyPath) -> LoadedFile:
        """The design that stands at a path, as a file of its own whose keys lie in the text of this one."""
        marks, at, data = self.tree.marks, self.tree.at, self.data
        for step in path:
            found = (marks or {}).get(step)
            at, marks = (found[0], found[2]) if found else (at, None)
            data = data[step]  # type: ignore[index]  # a path of sections
        deep = len(path)
        inside = [each for each in self.overrides if each.path[:deep] == path and len(each.path) > deep]
        overrides = [each._replace(path=each.path[deep:]) for each in inside]
        return LoadedFile(self.file, data, Tree(self.tree.source, data, marks, at), overrides)

    def rank(self, path: KeyPath) -> int:
        """How late the value of a key came: 0 with the file, 1 by a settled `--set`, 2 by a new one."""
        return max((2 - each.settled for each in self.overrides if each.path[: len(path)] == path), default=0)

    def settle(self) -> None:
        """Take what `--set` put in for given."""
        self.overrides = [each._replace(settled=True) for each in self.overrides]

    def rename(self, section: KeyPath, old: str, new: str) -> None:
        """Give a key of a section another name, at its place; what stood under that name is dropped."""
        self.data = _renamed(self.data, section, old, new)
        _mark_as(self.tree.marks, section, old, new)
        for override in self.overrides:
            if override.path == section[: len(override.path)]:
                _mark_as(override.marks, section[len(override.path) :], old, new)
        depth, path = len(section) + 1, (*section, old)
        self.overrides = [
            each._replace(path=(*section, new, *each.path[depth:])) if each.path[:depth] == path else each
            for each in self.overrides
        ]

    def drop(self, section: KeyPath, key: str) -> None:
        """Leave a key out, as if the file did not have it."""
        self.data = _renamed(self.data, section, key, None)

    def report(
        self,
        code: str,
        message: str,
        path: KeyPath,
        *,
        key: str | None = None,
        help: str = "",
        of_several: bool = False,
    ) -> Diagnostic:
        """A diagnostic that points at a key, or at the nearest parent of a missing one.

        `of_several` tells of what keys say together: it points at the `--set` that changed one of them, where the line
        of the file would show what stands there no longer.
        """
        source, at = (of_several and self._changed(path, message)) or self._spot(path)
        return source.report(code, message, at, key=format_path(path) if key is None else key, help=help)

    def _changed(self, path: KeyPath, message: str) -> tuple[Source, int] | None:
        """The last `--set` below a section, or beside a key where the message names the value that it put in."""
        if any(path[: len(override.path)] == override.path for override in self.overrides):
            return None
        for override in reversed(self.overrides):
            if override.source.file != _SET:
                continue
            if override.path[: len(path)] == path and path:
                return override.source, 0
            if override.path[:-1] == path[:-1] and len(path) > 1 and _names(message, override.value):
                return override.source, 0
        return None

    def _spot(self, path: KeyPath) -> tuple[Source, int]:
        for override in reversed(self.overrides):
            depth = len(override.path)
            if path[:depth] == override.path:
                at, _ = _find(override.marks, path[depth:], 0, False)
                return override.source, at
        at, found = _find(self.tree.marks, path, self.tree.at, False)
        if found < len(path):
            for override in reversed(self.overrides):
                common = _common(override.path, path)
                if common > found and override.source.file == _SET:
                    return override.source, 0
        return self.tree.source, at


def parse_path(text: str) -> KeyPath | None:
    """The steps of a dotted key path, or None where it is none.

    Example
        >>> parse_path("pivots.input[1]"), parse_path("a..b")
        (('pivots', 'input', 1), None)
        >>> parse_path('tolerance.sources."links.crank".cpk')
        ('tolerance', 'sources', 'links.crank', 'cpk')
    """
    steps: list[str | int] = []
    at = 0
    step = re.compile(_STEP)
    while match := step.match(text, at):
        steps.append(int(match[4]) if match[4] is not None else match[2] or match[3])
        at = match.end()
    return tuple(steps) if at == len(text) and steps and isinstance(steps[0], str) else None


def _find(marks: Marks | None, path: KeyPath, root: int, value: bool = False) -> tuple[int, int]:
    """Position of the deepest step of a path that is there, and how many steps that are."""
    at, found = root, 0
    for step in path:
        if marks is None or step not in marks:
            break
        key_at, value_at, marks = marks[step]
        found += 1
        at = value_at if value and found == len(path) else key_at
    return at, found


def _renamed(node: Any, section: KeyPath, old: str, new: str | None) -> Any:
    """A copy of data with a key of a section renamed, or without it; what is beside the section is shared."""
    if section:
        step, inner = section[0], _renamed(node[section[0]], section[1:], old, new)
        if isinstance(step, int):
            return [*node[:step], inner, *node[step + 1 :]]
        return {**node, step: inner}
    kept = {key: value for key, value in node.items() if key != new}
    return {(new if key == old else key): value for key, value in kept.items() if key != old or new is not None}


def _mark_as(marks: Marks | None, section: KeyPath, old: str, new: str) -> None:
    """Let a key be found under another name as well."""
    for step in section:
        if marks is None or step not in marks:
            return
        marks = marks[step][2]
    if marks is not None and old in marks:
        marks[new] = marks[old]


def _names(message: str, value: Any) -> bool:
    """Whether a message holds a number as a word of its own."""
    if isinstance(value, bool) or not isinstance(value, (int, float)):
        return False
    return re.search(rf"(?<![\w.]){re.escape(f'{value:g}')}(?![\w]|\.\d)", message) is not None


def _common(one: KeyPath, other: KeyPath) -> int:
    return next((i for i, (a, b) in enumerate(zip(one, other, strict=False)) if a != b), min(len(one), len(other)))
