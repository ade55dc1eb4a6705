"""Paths of planar mechanisms as files: points on the path, rates beside them, and what has no path."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from typer.testing import CliRunner

from gearlink.cli.app import app
from gearlink.cli.export import parts
from gearlink.cli.opening import load

DESIGNS = Path(__file__).parents[3] / "designs"


def run(*words: str) -> Any:
    return CliRunner().invoke(app, words)


def test_rows_of_a_path_are_those_of_the_motion(tmp_path: Path) -> None:
    """Each row against the mechanism at its input; the last row is the first again."""
    done = run("export", str(DESIGNS / "planar_five_bar.yaml"), "--as", "csv", "--as", "svg", "--out", str(tmp_path))
    assert done.exit_code == 0, done.output
    names = {path.name for path in tmp_path.iterdir()}
    assert {"geared-five-bar-PATH-M.csv", "geared-five-bar-PATH-M.svg", "geared-five-bar-mesh_14_crank.csv"} <= names
    lines = [line for line in (tmp_path / "geared-five-bar-PATH-M.csv").read_text().splitlines() if line[0] != "#"]
    head, *rows = csv.reader(lines)
    assert head[:4] == ["input_angle [deg]", "x [mm]", "y [mm]", "x_velocity_ratio [mm/rad]"]
    data = np.array(rows, dtype=float)
    design = load(DESIGNS / "planar_five_bar.yaml")
    point = design.moving.at(np.radians(data[:, 0]), 2).links["coupler"].at("M")
    for column, wanted in zip(
        range(1, 7),
        (part for rate in point[:3] for part in (rate.real, rate.imag)),
        strict=True,
    ):
        assert data[:, column] == pytest.approx(wanted, abs=1e-10)
    assert data[-1, 1:3] == pytest.approx(data[0, 1:3], abs=1e-12)


def test_a_mechanism_without_an_output_point_has_none(tmp_path: Path) -> None:
    done = run("export", str(DESIGNS / "planar_quick_return.yaml"), "--out", str(tmp_path))
    assert done.exit_code == 2
    assert not [*tmp_path.iterdir()]


def test_pinions_of_racks_are_parts() -> None:
    made = parts.makers(load(DESIGNS / "planar_bed_chain.yaml"))
    assert list(made) == ["rack_lower_pinion", "rack_upper_pinion"]
    assert made["rack_lower_pinion"]().teeth == 50


def test_the_path_of_a_coupler_point_is_that_of_its_table(tmp_path: Path) -> None:
    done = run("export", str(DESIGNS / "crank_rocker_links.yaml"), "--as", "csv", "--out", str(tmp_path))
    assert done.exit_code == 0, done.output
    (file,) = tmp_path.iterdir()
    assert file.name == "crank-rocker-links-PATH-P.csv"
    head, *rows = csv.reader(line for line in file.read_text().splitlines() if line[0] != "#")
    assert head[:3] == ["crank_angle [deg]", "x [mm]", "y [mm]"]
    design = load(DESIGNS / "crank_rocker_links.yaml")
    table = design.table("path", samples=8)
    point = design.moving.at(np.radians([float(row[0]) for row in rows]), 0).links["coupler"].at("P").value
    assert [float(row[1]) for row in rows] == pytest.approx(point.real, abs=1e-10)
    near = [np.abs(point - complex(x, y)).min() for x, y in zip(table["x"], table["y"], strict=True)]
    assert max(near) < 2.0, "places of the table lie on the path, between its points"


def test_the_path_of_any_point_of_a_link_can_be_asked_for(tmp_path: Path) -> None:
    words = ("export", str(DESIGNS / "candy_feed.yaml"), "--out", str(tmp_path), "--as", "csv", "--tolerance", "0.1")
    done = run(*words, "--part", "PATH-C", "--part", "PATH-coupler@40/20")
    assert done.exit_code == 0, done.output
    assert sorted(path.name for path in tmp_path.iterdir()) == [
        "candy-feed-PATH-C.csv", "candy-feed-PATH-coupler@40_20.csv"
    ]  # fmt: skip
    refused = run(*words, "--part", "PATH-Q")
    assert refused.exit_code == 2
    assert "no point 'Q'; it has B, C" in refused.output


def test_a_four_bar_without_coupler_point_says_what_to_write(tmp_path: Path) -> None:
    done = run("export", str(DESIGNS / "crank_rocker.yaml"), "--out", str(tmp_path))
    assert done.exit_code == 2
    assert "give coupler_point: [x, y], or --part PATH-B" in done.output


@pytest.mark.slow
def test_a_path_is_no_body(tmp_path: Path) -> None:
    done = run("export", str(DESIGNS / "planar_watt.yaml"), "--as", "step", "--out", str(tmp_path))
    assert done.exit_code == 2
    assert "a path is not a solid" in done.output
