"""Where results go: `-`, an empty name, folders, files that are there, devices, names that are too long or do not show.

No tolerances: exit statuses, words, and what is left behind.
"""

from __future__ import annotations

import os
from pathlib import Path
from typing import Any

import pytest
from systems import UNIX

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"
FAILING = (
    "kind: three-gear-four-bar\ngears: {module: 2.5, crank: 20, idler: 20, output: 60}\n"
    "links: {crank: 18, frame: 121.4}\n"
)
FILES = {"save": ("crank", "crank.yaml", "--save"), "new": ("new", "gear-pair", "--out")}
FOLDERS = {
    "plot": ("crank", "crank.yaml", "--plot", "--out"),
    "report": ("report", "crank.yaml", "--out"),
    "animate": ("animate", "crank.yaml", "--out"),
    "export": ("export", "crank.yaml", "--out"),
    "sheet": ("sheet", "crank.yaml", "mechanism", "--out"),
    "chart": ("chart", "speed-swing", "--plot", "--out"),
    "batch": ("batch", "crank.yaml", "--out"),
    "schema": ("schema", "--write"),
    "write": ("explore", "study.yaml", "--write"),
    "store": ("explore", "study.yaml", "--store"),
}


@pytest.fixture
def box(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """The current folder, with a design."""
    (tmp_path / "crank.yaml").write_text(CRANK)
    monkeypatch.chdir(tmp_path)
    return tmp_path


def names(folder: Path) -> set[str]:
    return {path.name for path in folder.iterdir()}


@pytest.mark.quick(12)
@pytest.mark.parametrize("place", ["-", ""])
@pytest.mark.parametrize("line", FOLDERS.values(), ids=FOLDERS)
def test_what_is_no_folder_is_refused_before_anything_is_written(
    gearlink: Any, box: Path, line: tuple[str, ...], place: str
) -> None:
    ended = gearlink(*line, place)
    assert ended.status == 2
    words = " ".join(ended.err.split())
    assert f"Invalid value for '{line[-1]}': " in words
    assert ("standard output is not a " if place else "the name is empty") in words
    assert names(box) == {"crank.yaml"}


@pytest.mark.quick(5)
@pytest.mark.parametrize("line", FILES.values(), ids=FILES)
@pytest.mark.parametrize(
    ("place", "words"),
    [
        ("", "the name is empty help: give a file"),
        ("crank.yaml", "crank.yaml exists already"),
        (".", ". is a folder"),
        pytest.param("/dev/null", "/dev/null is not a regular file", marks=UNIX),
        pytest.param("crank.yaml/x", "crank.yaml is not a folder", marks=UNIX),
        pytest.param("x" * 300, "File name too long", marks=UNIX),
        pytest.param("a/" + "x" * 300, "File name too long", marks=UNIX),
    ],
)
def test_files_that_cannot_be_written(gearlink: Any, box: Path, line: tuple[str, ...], place: str, words: str) -> None:
    ended = gearlink(*line, place)
    assert (ended.status, ended.out) == (2, "")
    assert words in " ".join(ended.err.split())
    assert place == "" or "error GL116: " in ended.err
    assert names(box) - {"a"} == {"crank.yaml"}


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="this system has no named pipes")
@pytest.mark.parametrize("line", FILES.values(), ids=FILES)
def test_no_force_replaces_what_is_no_plain_file(gearlink: Any, box: Path, line: tuple[str, ...]) -> None:
    os.mkfifo(box / "pipe")
    for place, words in (("pipe", "pipe is not a regular file"), (".", ". is a folder")):
        ended = gearlink(*line, place, "--force")
        assert (ended.status, words in ended.err) == (2, True)
    assert (box / "pipe").is_fifo()


@pytest.mark.skipif(os.name == "nt", reason="no such names")
@pytest.mark.parametrize("line", [*FILES.values(), FOLDERS["plot"]], ids=[*FILES, "plot"])
def test_a_name_that_does_not_show_is_said_escaped(
    gearlink: Any, box: Path, small_pictures: None, line: tuple[str, ...]
) -> None:
    name = "red\x1b[31m\n::error::"
    ended = gearlink(*line, name)
    assert ended.status == 0
    assert "wrote red\\x1b[31m\\n\\x3a:error\\x3a:" in ended.err
    assert name in names(box)


def test_a_saved_design_can_be_standard_output(gearlink: Any, box: Path, standard_input: Any, designs: Path) -> None:
    """The design alone stands there, named after its file, and is read again."""
    source = designs / "thesis_example_1.yaml"
    ended = gearlink("synth", "back-step", source, "--save", "-", "--quantity", "frame_length")
    assert (ended.status, ended.err) == (0, "")
    assert "found by synth back-step" in ended.out
    assert "\nname: thesis-example-1" in ended.out
    standard_input(ended.out.encode())
    assert gearlink("check", "-").status == 0
    assert "\nname: crank" in gearlink("crank", "crank.yaml", "--save", "-").out
    assert names(box) == {"crank.yaml"}


def test_a_repaired_design_can_be_standard_output(gearlink: Any, box: Path, standard_input: Any) -> None:
    (box / "failing.yaml").write_text(FAILING)
    ended = gearlink("analyze", "failing.yaml", "--suggest", "--save", "-")
    assert ended.status == 0
    assert "suggestions" in ended.err
    assert ended.out.startswith("# failing: `gearlink analyze failing.yaml`")
    standard_input(ended.out.encode())
    assert gearlink("check", "-").status == 0


def test_a_template_can_be_standard_output(gearlink: Any, box: Path) -> None:
    assert gearlink("new", "gear-pair", "--out", "-").out == gearlink("new", "gear-pair").out
    assert names(box) == {"crank.yaml"}


def test_a_file_of_that_name_is_a_path(gearlink: Any, box: Path) -> None:
    assert gearlink("crank", "crank.yaml", "--save", "./-").status == 0
    assert "kind: slider-crank" in (box / "-").read_text()


@pytest.mark.quick(1)
@pytest.mark.parametrize("line", [("export", "--as", "csv"), ("crank", "--plot", "--plot-format", "svg")])
def test_a_file_that_takes_the_place_of_another_design_is_told(
    gearlink: Any, box: Path, line: tuple[str, ...], monkeypatch: pytest.MonkeyPatch
) -> None:
    """The same design again gives the same bytes, and no word; `--quiet` says neither."""

    def small(_: str, design: Any, *__: Any) -> Any:
        from matplotlib.figure import Figure

        figure = Figure(figsize=(1, 1))
        figure.text(0.0, 0.0, str(design.spec.stroke))
        return figure

    monkeypatch.setattr("gearlink.cli.views.figures.write.draw", small)
    pair = "kind: gear-pair\nname: same\nmodule: 4\nteeth: [30, 40]\nprofile_shift: [0, 0]\n"
    text = pair if line[0] == "export" else f"name: same\n{CRANK}"
    (box / "a.yaml").write_text(text)
    (box / "b.yaml").write_text(text.replace("40", "41").replace("310", "311"))
    command, *rest = line
    for file, told in (("a.yaml", False), ("a.yaml", False), ("b.yaml", True), ("b.yaml", False)):
        ended = gearlink(command, file, *rest)
        assert ended.status == 0
        assert (", instead of an earlier one that differs" in ended.out + ended.err) == told, file
    assert "in place" not in gearlink(command, "a.yaml", *rest, "--quiet").err
