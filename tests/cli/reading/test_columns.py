"""Points of a design file that stand in a file of numbers."""

from __future__ import annotations

import math
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.reading.design_file import load, rows_of, validate
from gearlink.cli.reading.diagnostics import DesignFileError, Source
from gearlink.core.base.kinds import KINDS
from gearlink.core.machines.motion_law import MotionLawSpec

ROWS = [[0.0, 0.0], [0.25, 0.1], [1.0, 1.0]]


@pytest.mark.parametrize(
    "text",
    [
        "0,0\n0.25,0.1\n1,1\n",
        "x;s\n0;0\n0,25;0,1\n1;1",
        "# measured\nangle\tlift\n0\t0\n0,25\t0,1\n\n1\t1\n",
        "\ufeffx, s\r\n0, 0\r\n2.5e-1, .1\r\n1, 1\r\n",
    ],
)
def test_delimiter_and_decimal_sign_are_found(text: str) -> None:
    assert rows_of(Source("f.csv", text.removeprefix("\ufeff"))) == ROWS


@pytest.mark.parametrize(
    ("text", "line", "column", "words"),
    [
        ("x;s\n0;0\n0,5;0,x5\n", 3, 5, "'0,x5' is not a number"),
        ("0,0\n1,1,1\n", 2, 5, "3 numbers in a row"),
        ("words\nalone\n", 1, 1, "no row of numbers"),
    ],
)
def test_a_bad_cell_is_told_at_its_place(text: str, line: int, column: int, words: str) -> None:
    with pytest.raises(DesignFileError) as refused:
        rows_of(Source("f.csv", text))
    (found,) = refused.value.diagnostics
    assert (found.code, found.line, found.column) == ("GL182", line, column)
    assert words in found.message


def test_blanks_are_no_delimiter() -> None:
    """The help asked for two numbers a row, which each row has."""
    with pytest.raises(DesignFileError) as refused:
        rows_of(Source("f.csv", "0 0\n1 1\n"))
    assert "a comma, a semicolon or a tab" in refused.value.diagnostics[0].help


@pytest.mark.parametrize(
    ("rows", "words", "fix"),
    [
        ("0,0\n90,10\n80,12\n360,0\n", "80 deg follows 90 deg", "sort its rows, each angle once"),
        ("0,1\n90,10\n180,5\n355,1.5\n", "not from 0 to 355 deg", "add the row 360, 1"),
        ("5,1\n90,10\n180,5\n360,1\n", "not from 5 to 360 deg", "give it the rows 0 and 360"),
        ("0,0\n90,10\n180,5\n360,0.004\n", "starts with: 0, not 0.004", "set the lift at 360 to 0"),
    ],
)
def test_measured_points_that_close_no_turn_are_told_which(tmp_path: Path, rows: str, words: str, fix: str) -> None:
    (tmp_path / "lift.csv").write_text(rows, encoding="utf-8")
    path = tmp_path / "cam.yaml"
    head = "kind: disc-cam\nfollower: {type: translating-roller, roller_radius: 9}\ncam: {prime_radius: 50}\n"
    path.write_text(head + "motion: {file: lift.csv}\n", encoding="utf-8")
    with pytest.raises(DesignFileError) as refused:
        validate(load(str(path)), KINDS["disc-cam"].spec_model())
    (found,) = refused.value.diagnostics
    assert (words in found.message, found.help) == (True, fix)


def design_file(folder: Path, law: str) -> Path:
    path = folder / "law.yaml"
    path.write_text(f"kind: motion-law\nname: measured\nlaw: {law}\n", encoding="utf-8")
    return path


def test_the_points_take_the_place_of_the_name(tmp_path: Path) -> None:
    rows = [[0.0, 0.0], [0.2, 0.06], [0.4, 0.3], [0.6, 0.7], [0.8, 0.94], [1.0, 1.0]]
    (tmp_path / "lift.csv").write_text("".join(f"{x},{s}\n" for x, s in rows), encoding="utf-8")
    spec = validate(load(str(design_file(tmp_path, "{type: table, file: lift.csv}"))), MotionLawSpec)
    assert spec.law.points == rows  # type: ignore[union-attr]


@pytest.mark.parametrize(
    ("name", "code", "help"),
    [("lft.csv", "GL101", "did you mean"), ("lift.xlsx", "GL182", "save it as CSV")],
)
def test_a_file_that_cannot_be_read_is_the_only_error(tmp_path: Path, name: str, code: str, help: str) -> None:
    (tmp_path / "lift.csv").write_text("0,0\n", encoding="utf-8")
    path = design_file(tmp_path, f"{{type: table, file: {name}}}")
    with pytest.raises(DesignFileError) as refused:
        validate(load(str(path)), MotionLawSpec)
    (found,) = refused.value.diagnostics
    assert (found.code, found.line) == (code, 3)
    assert help in found.help


CAM = """
kind: disc-cam
name: c
motion: {}
follower: {{type: translating-roller, roller_radius: 9}}
cam: {{prime_radius: 60}}
"""
LIFTS = [[0.0, 0.0], [90.0, 16.0], [150.0, 20.0], [220.0, 14.5], [360.0, 0.0]]


def cam(folder: Path, motion: str) -> Any:
    path = folder / "cam.yaml"
    path.write_text(CAM.format(motion), encoding="utf-8")
    return validate(load(str(path)), KINDS["disc-cam"].spec_model())


def test_a_motion_is_read_from_two_columns_of_a_file(tmp_path: Path) -> None:
    rows = "".join(f"{k};{math.radians(angle)!r};{lift}\n" for k, (angle, lift) in enumerate(LIFTS)).replace(".", ",")
    (tmp_path / "lift.csv").write_text("row;angle;lift\n" + rows, encoding="utf-8")
    made = cam(tmp_path, "{file: lift.csv, columns: [2, 3], degrees: false}")
    assert [value for row in made.motion.rows for value in row] == pytest.approx(
        [value for row in LIFTS for value in row], rel=1e-15
    )
    (tmp_path / "plain.csv").write_text("".join(f"{angle},{lift}\n" for angle, lift in LIFTS), encoding="utf-8")
    assert cam(tmp_path, "{file: plain.csv}").motion.rows == LIFTS


@pytest.mark.parametrize(
    ("motion", "code", "words"),
    [
        ("{file: lift.csv, columns: [1, 5]}", "GL182", "no column 5 in a row"),
        ("{file: lift.csv, columns: [a, 2]}", "GL107", "numbers of two columns"),
        ("{file: lift.csv, table: [[0, 0], [9, 1], [10, 1], [360, 0]]}", "GL111", "table and file exclude each other"),
        ("{file: none.csv}", "GL101", "cannot read"),
        ("{degrees: true}", "GL111", "give table, or file"),
    ],
)
def test_what_a_motion_cannot_be_read_from(tmp_path: Path, motion: str, code: str, words: str) -> None:
    (tmp_path / "lift.csv").write_text("0,0,1\n", encoding="utf-8")
    with pytest.raises(DesignFileError) as refused:
        cam(tmp_path, motion)
    assert refused.value.diagnostics[0].code == code
    assert words in refused.value.diagnostics[0].message
