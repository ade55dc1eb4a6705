"""The blocking contour as a file. No tolerances: the numbers are those of the tables, to the last bit."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import pytest
from factory import design
from sweeps import ALL


def test_csv_has_every_point_and_every_margin(
    gearlink: Any, designs: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    if not ALL:  # fewer lines across the window
        monkeypatch.setattr("gearlink.core.parts.gears.shifts.contour._DIAGONALS", 21)
        monkeypatch.setattr("gearlink.core.parts.gears.shifts.contour._UPRIGHTS", 11)
    ended = gearlink(
        "export", designs / "ring_pair.yaml", "--part", "blocking_contour", "--as", "csv", "--out", tmp_path
    )
    assert ended.status == 0
    (path,) = tmp_path.iterdir()
    assert path.name == "pinion-in-ring-blocking_contour.csv" or path.name.endswith("-blocking_contour.csv")
    lines = path.read_text().splitlines()
    contour = design("ring_pair", command="gear").contour
    rows = list(csv.reader(line for line in lines if not line.startswith("#")))
    assert rows[0] == ["line", "x1", "x2"]
    wanted = [[name, *map(repr, point)] for name, points in contour.points.items() for point in points]
    assert rows[1:] == wanted
    margins = [line for line in lines if line.startswith("# margin of ")]
    assert len(margins) == len(contour.lines)
    less = contour.margins["fillet 1"][0]
    assert f"# margin of fillet 1: {less!r} to none in x1 at the same shift sum" in margins


@pytest.mark.slow
def test_svg_has_the_design_its_free_region_and_margins(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    options = ("--part", "blocking_contour", "--part", "gear1", "--as", "svg", "--out", tmp_path)
    assert gearlink("export", designs / "ring_pair.yaml", *options).status == 0
    assert len(list(tmp_path.iterdir())) == 2
    text = next(tmp_path.glob("*blocking_contour.svg")).read_text()
    ElementTree.fromstring(text)
    for words in ("this design", "permissible region", "fillet 1", "pointed tip 1", "undercut"):
        assert words in text


def test_it_is_no_profile_and_needs_two_gears(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    folder = tmp_path / "out"
    solid = gearlink("export", designs / "ring_pair.yaml", "--part", "blocking_contour", "--out", folder)
    assert (solid.status, "give --as svg or --as csv" in solid.err) == (2, True)
    rack = gearlink("export", designs / "rack_drive.yaml", "--part", "blocking_contour", "--as", "svg", "--out", folder)
    assert (rack.status, "needs two gears, not a rack" in rack.err) == (2, True)
    press = gearlink("export", designs / "ty460.yaml", "--part", "blocking_contour", "--as", "svg", "--out", folder)
    assert (press.status, "no part named 'blocking_contour'" in press.err) == (2, True)
    near = gearlink("export", designs / "ring_pair.yaml", "--part", "blocking-contor", "--as", "svg", "--out", folder)
    assert (near.status, "nearest: blocking_contour" in near.err) == (2, True)
    assert not folder.exists()
