"""Values changed where they stand: read again, the text has the new value and all others, and every comment."""

from __future__ import annotations

from collections.abc import Iterator
from copy import deepcopy
from functools import reduce
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.reading.design_file import parse
from gearlink.cli.studio.text import CannotPlace, Changed, Document, with_value, with_values

DESIGNS = sorted((Path(__file__).parents[3] / "designs").glob("*.yaml"))


def _leaves(node: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[tuple[Any, ...], Any]]:
    for step, value in node.items() if isinstance(node, dict) else enumerate(node):
        if isinstance(value, (dict, list)):
            yield from _leaves(value, (*path, step))
        else:
            yield (*path, step), value


def _sections(node: Any, path: tuple[str, ...] = ()) -> Iterator[tuple[str, ...]]:
    yield path
    for step, value in node.items():
        if isinstance(value, dict):
            yield from _sections(value, (*path, step))


def _put(data: Any, path: tuple[Any, ...], value: Any) -> Any:
    changed = deepcopy(data)
    section = reduce(lambda node, step: node[step], path[:-1], changed)
    if value is None:
        del section[path[-1]]
        return _put(changed, path[:-1], None) if section == {} and len(path) > 1 else changed
    section[path[-1]] = value
    return changed


def _comments(text: str) -> list[str]:
    return [line.partition("#")[2] for line in text.splitlines() if "#" in line]


@pytest.mark.quick(3)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_one_value_changes_and_nothing_else(path: Path) -> None:
    text = path.read_text(encoding="utf-8")
    data = parse(text.encode(), path.name).data

    def read(changed: str) -> Any:
        return parse(changed.encode(), path.name).data

    for place, value in _leaves(data):
        if isinstance(value, (int, float)) and not isinstance(value, bool):
            changed = with_value(text, place, 7.25)
            assert read(changed) == _put(data, place, 7.25)
            assert _comments(changed) == _comments(text)
        if isinstance(place[-1], str) and not any(isinstance(step, int) for step in place):
            assert read(with_value(text, place, None)) == _put(data, place, None)
    for section in _sections(data):
        changed = with_value(text, (*section, "new", "deep"), 1.5)
        assert read(changed) == _put(data, (*section, "new"), {"deep": 1.5})
        assert _comments(changed) == _comments(text)


@pytest.mark.parametrize(
    ("text", "path", "value", "as_written", "wanted"),
    [
        ("stroke: 4.4 in  # as bought\n", ("stroke",), 5, True, "stroke: 5 in  # as bought\n"),
        ("stroke: '4.4 in'\n", ("stroke",), 5.5, True, "stroke: '5.5 in'\n"),
        ("stroke: 4.4 in\n", ("stroke",), 120.0, False, "stroke: 120\n"),
        ("a: {b: [1, 2.50, 3]}\n", ("a", "b", 1), 2.6, True, "a: {b: [1, 2.6, 3]}\n"),
        ("a:   # empty\nb: 1\n", ("a",), 2, False, "a: 2   # empty\nb: 1\n"),
        ("x: &n 4\ny: 1\n", ("x",), 5, True, "x: &n 5\ny: 1\n"),
        ("a: 1", ("b",), 2, False, "a: 1\nb: 2\n"),
        ("a: {b: 1, c: 2}\n", ("a", "b"), None, False, "a: {c: 2}\n"),
    ],
)
def test_values_stand_as_they_are_written(text: str, path: Any, value: Any, as_written: bool, wanted: str) -> None:
    assert with_value(text, path, value, as_written=as_written) == wanted


def test_what_has_no_place_is_refused() -> None:
    with pytest.raises(CannotPlace, match="is not in the file"):
        with_value("a: [1, 2]\n", ("a", 5), 3)
    with pytest.raises(CannotPlace, match="is not in the file"):
        with_values("a: 1\n", [("a.b", 3)])


@pytest.mark.parametrize(("mark", "ends"), [(b"", b"\n"), (b"\xef\xbb\xbf", b"\r\n")])
def test_a_file_is_written_by_save_alone_and_as_it_was(tmp_path: Path, mark: bytes, ends: bytes) -> None:
    path = tmp_path / "design.yaml"
    data = mark + ends.join([b"kind: gear-pair  # two", b"module: 2", b"teeth: [25, 40]", b""])
    path.write_bytes(data)
    document = Document(path)
    assert document.change(with_value(document.text, ("module",), 2.5))
    assert path.read_bytes() == data
    document.save()
    assert path.read_bytes() == data.replace(b"module: 2", b"module: 2.5")
    assert not document.can["save"]


def test_steps_back_and_on(tmp_path: Path) -> None:
    path = tmp_path / "design.yaml"
    path.write_text("a: 0\n")
    document = Document(path)
    for value in (1, 2, 3):  # a slider that is held
        document.change(f"a: {value}\n", "a")
    document.rest()
    document.change("a: 4\n", "a")
    assert not document.change("a: 4\n")
    for wanted in ("a: 3\n", "a: 0\n"):
        assert document.undo()
        assert document.text == wanted
    assert not document.undo()
    assert document.redo()
    document.change("a: 9\n")
    assert document.can == {"undo": True, "redo": False, "save": True, "revert": True}
    document.revert()
    assert document.text == "a: 0\n"
    document.undo()
    assert document.text == "a: 9\n"


def test_what_another_program_wrote_is_not_lost(tmp_path: Path) -> None:
    path = tmp_path / "design.yaml"
    path.write_text("a: 0\n")
    document = Document(path)
    document.change("a: 1\n")
    path.write_text("a: 5\n")
    with pytest.raises(Changed, match="another program"):
        document.save()
    assert path.read_text() == "a: 5\n"
    document.revert()
    assert document.text == "a: 5\n"
    document.undo()
    document.save()
    assert path.read_text() == "a: 1\n"
