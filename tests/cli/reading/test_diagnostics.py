"""Diagnostics as text and as JSON. Nothing here is a matter of tolerance: texts and columns are compared exactly."""

from __future__ import annotations

import json
import pickle
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.cli.reading.diagnostics import MAX_SHOWN, DesignFileError, Diagnostic, Source, visible
from gearlink.core.base.errors import GearlinkError


def test_text_form() -> None:
    wrong = Diagnostic("GL105", "unknown key 'modul'", "a.yaml", 3, 1, "modul", "modul: 4", "did you mean 'module'?")
    assert wrong.as_text() == (
        "a.yaml:3:1: error GL105: unknown key 'modul'\n  modul: 4\n  ^\n  help: did you mean 'module'?"
    )


def test_json_form() -> None:
    wrong = Diagnostic("GL105", "unknown key", "a.yaml", 3, 1, "modul", "modul: 4", "help")
    assert wrong.as_json() == {
        "code": "GL105",
        "message": "unknown key",
        "file": "a.yaml",
        "line": 3,
        "column": 1,
        "key": "modul",
        "help": "help",
    }
    assert "help" not in Diagnostic("GL110", "too large", "a.yaml").as_json()


def test_file_name_that_is_no_text_survives_json() -> None:
    wrong = Diagnostic("GL101", "no such file", b"\xff.yaml".decode("utf-8", "surrogateescape"))
    assert json.dumps(wrong.as_json(), ensure_ascii=False).encode("utf-8")
    assert wrong.as_text().encode("utf-8")


def test_no_source_line_no_caret() -> None:
    assert Diagnostic("GL101", "no such file", "x.yaml").as_text() == "x.yaml:1:1: error GL101: no such file"


def test_errors_are_sorted_once_each_and_those_of_the_command_line_last() -> None:
    late, early = Diagnostic("GL105", "b", "f", 4, 1), Diagnostic("GL105", "a", "f", 2, 7)
    given_at = Diagnostic("GL114", "c", "<--set>", 1, 1)
    assert DesignFileError([given_at, late, early, late]).diagnostics == [early, late, given_at]


def test_a_flood_of_errors_is_cut_and_says_so() -> None:
    error = DesignFileError([Diagnostic("GL105", "a", "f", line) for line in range(1, 251)], omitted=50)
    assert len(error.diagnostics) == MAX_SHOWN + 1
    assert error.diagnostics[-1].message == "200 more errors are not shown"


def test_error_survives_pickling() -> None:
    """A pool hands the error of a worker back by pickle."""
    error = DesignFileError([Diagnostic("GL105", "a", "f", 2)])
    assert pickle.loads(pickle.dumps(error)).diagnostics == error.diagnostics
    assert isinstance(error, GearlinkError)


@pytest.mark.parametrize("column", [1, 2, 60, 500, 9_999, 10_000])
def test_caret_stands_under_its_character_in_long_lines(column: int) -> None:
    line = "".join(chr(ord("a") + i % 26) for i in range(9_999)) + "z"
    _, shown, caret = Diagnostic("GL103", "m", "f", 1, column, source=line).as_text().split("\n")
    assert len(shown) <= 110
    assert shown[caret.index("^")] == line[column - 1]


def test_caret_counts_wide_characters_twice_and_escapes_at_their_length() -> None:
    rows = Diagnostic("GL103", "m", "f", 1, 6, source="齿数\u00a0: 4").as_text().split("\n")
    assert rows[1] == "  齿数\\xa0: 4"
    assert rows[2] == "  " + " " * (2 + 2 + 4 + 1 + 1) + "^"


def test_ascii_terminal_gets_ascii_with_the_caret_in_place() -> None:
    text = Diagnostic("GL112", "α must be ≤ 20°", "f", 1, 4, source="αβ 4").as_text("ascii")
    assert text.isascii()
    shown, caret = text.split("\n")[1:]
    assert shown[caret.index("^")] == "4"


@examples(200)
@given(st.text(), st.sampled_from(["ascii", "latin-1", "utf-8", "cp1252"]))
def test_shown_text_is_one_line_that_the_encoding_can_write(text: str, encoding: str) -> None:
    shown = visible(text, encoding)
    shown.encode(encoding)
    assert shown.isprintable()


@examples(200)
@given(st.lists(st.sampled_from(["a", "ä", "\n", "\r", "\r\n", "\t"])).map("".join), st.data())
def test_place_and_line_agree_with_counting(text: str, data: st.DataObject) -> None:
    source = Source("f", text)
    at = data.draw(st.integers(0, len(text)))
    before = text[:at].replace("\r\n", "\n")
    if text[at - 1 : at + 1] == "\r\n":
        before = before[:-1] + " "  # between the two halves of a break: still on the line
    before = before.replace("\r", "\n")
    line, column = source.place(at)
    assert line == before.count("\n") + 1
    assert column == len(before) - (before.rfind("\n") + 1) + 1
    assert source.line(line) == text.replace("\r\n", "\n").replace("\r", "\n").split("\n")[line - 1]


def test_keys_of_an_unknown_section_are_known_a_level_higher(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "pair.yaml"
    path.write_text("kind: gear-pair\ngears:\n  module: 3\n  teeth: [23, 61]\n", encoding="utf-8")
    err = gearlink("gear", path).err
    assert "unknown key 'gears'" in err
    assert "help: its keys belong to the top level of this kind: module, teeth" in err
