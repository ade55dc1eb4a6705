"""Files of plots: one for each figure, the same every time, whole or not there."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import pytest
from matplotlib.figure import Figure
from sweeps import mostly_slow

from gearlink.cli.files import CannotWrite
from gearlink.cli.views.figures import write

MAGIC = {"png": b"\x89PNG\r\n", "svg": b"<?xml", "pdf": b"%PDF-"}
FIGURES = [
    ("crank", "ty460_slider_crank", "png"),
    ("press", "ty460", "png"),
    ("swing", "wide_swing_twin_cam", "svg"),
    ("gear", "ty460_input_gears", "pdf"),
    ("cam", "ty460", "svg"),
    ("gripper", "swing_gripper", "pdf"),
    ("cam", "swing_gripper", "png"),
    ("cam", "wide_swing_twin_rocker", "pdf"),
    ("synth dwell", "candy_feed", "svg"),
    ("analyze", "thesis_example_3_as_printed", "pdf"),
    ("analyze", "two_gear_ring", "png"),
    ("analyze", "five_bar_path", "svg"),
    ("analyze", "wide_lever", "pdf"),
    ("analyze", "hypocycloid_slider", "png"),
    ("analyze", "mutilated_gear_press", "svg"),
    ("analyze", "six_bar_two_trains", "pdf"),
]


@pytest.mark.slow
@pytest.mark.parametrize(("command", "name", "ending"), mostly_slow(FIGURES, 1))
def test_one_file_the_same_every_time(
    gearlink: Any, designs: Path, tmp_path: Path, command: str, name: str, ending: str
) -> None:
    made = []
    for folder in (tmp_path / "a", tmp_path / "b"):
        arguments = [*command.split(), designs / f"{name}.yaml", "--quiet", "--plot", "--plot-format", ending]
        assert gearlink(*arguments, "--out", folder).status in (0, 1)
        (file,) = folder.iterdir()
        assert file.suffix == f".{ending}"
        made.append(file.read_bytes())
    assert made[0] == made[1]
    assert made[0].startswith(MAGIC[ending])
    assert len(made[0]) > 5000


@pytest.mark.parametrize("dpi", [40, *(pytest.param(dpi, marks=pytest.mark.slow) for dpi in (130, 260))])
def test_a_picture_has_the_pixels_that_it_is_asked_for(gearlink: Any, designs: Path, tmp_path: Path, dpi: int) -> None:
    """--dpi counts, not the resolution of the figure's first canvas."""
    arguments = ["crank", designs / "ty460_slider_crank.yaml", "--quiet", "--plot", "--out", tmp_path]
    assert gearlink(*arguments, "--dpi", str(dpi)).status == 0
    (file,) = tmp_path.iterdir()
    width = int.from_bytes(file.read_bytes()[16:20])
    assert width == int(8.27 * dpi)


def test_nothing_half_written_remains(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(*_: Any, **__: Any) -> None:
        raise OSError(28, "No space left on device")

    monkeypatch.setattr(Figure, "savefig", full)
    ended = gearlink("crank", designs / "ty460_slider_crank.yaml", "--plot", "--out", tmp_path)
    assert ended.status == 2
    assert "No space left" in ended.err
    assert not list(tmp_path.iterdir())


@pytest.mark.slow
@pytest.mark.parametrize("ending", mostly_slow(["svg", "png", "pdf"], 1))
def test_every_panel_is_drawn_once(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, ending: str
) -> None:
    """With an engine of layout, if only in name, savefig draws all panels once more before it draws them."""
    drawn: list[Figure] = []
    draw = Figure.draw
    monkeypatch.setattr(Figure, "draw", lambda self, renderer: drawn.append(self) or draw(self, renderer))
    plot = ("--plot", "--plot-format", ending, "--out", tmp_path)
    assert gearlink("crank", designs / "ty460_slider_crank.yaml", *plot).status == 0
    assert len(drawn) == 1


LINES = [
    ["crank", "ty460_slider_crank.yaml"],
    ["crank", "ty460_slider_crank.yaml", "--suggest"],
    ["explore", "studies/gear_pair.yaml"],
    ["laws", "--law", "velocity-345"],
    ["chart", "back-step"],
]


@pytest.mark.quick(3)
@pytest.mark.parametrize(("error", "status"), [(ValueError("min() arg"), 3), (CannotWrite("cannot write: no room"), 2)])
@pytest.mark.parametrize("line", LINES, ids=lambda line: "-".join(line[::2]))
def test_a_picture_that_cannot_be_made_takes_no_result_with_it(
    gearlink: Any,
    designs: Path,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    line: list[str],
    error: Any,
    status: int,
) -> None:
    def fails(*_: Any, **__: Any) -> None:
        raise error

    words = [designs / word if word.endswith(".yaml") else word for word in line]
    alone = gearlink(*words, "--format", "json")
    monkeypatch.setattr(write, "save", fails)
    ended = gearlink(*words, "--format", "json", "--plot", "--out", tmp_path)
    assert (alone.status, ended.status) == (0, status)
    assert ended.out == alone.out
    assert str(error) in ended.err
