"""`gearlink export --cam-table`: rows that a drive reads, and who has none."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from scipy.interpolate import BPoly

from gearlink.core.numerics.bernstein import HERMITE
from gearlink.core.parts.cams.laws import law

DESIGNS = Path(__file__).parents[3] / "designs"


def test_the_table_of_a_drive(gearlink: Any, tmp_path: Path) -> None:
    done = gearlink("export", str(DESIGNS / "loaded_cam.yaml"), "--cam-table", "--rows", "37", "--out", str(tmp_path))
    assert done.status == 0
    assert "37 rows" in done.out
    with (tmp_path / "loaded-cam-cam-table.csv").open() as file:
        head, *cells = csv.reader(file)
    assert head == ["master_position [deg]", "slave_position [deg]", "slave_velocity [deg/deg]",
                    "slave_acceleration [deg/deg^2]", "slave_jerk [deg/deg^3]"]  # fmt: skip
    rows = [dict(zip((name.partition(" ")[0] for name in head), row, strict=True)) for row in cells]
    assert [float(row["master_position"]) for row in rows] == pytest.approx(np.linspace(0.0, 360.0, 37), rel=1e-14)
    # the polynomial of degree 5 through two rows meets the law between them
    names = [f"slave_{name}" for name in ("position", "velocity", "acceleration")]
    values = np.array([float(row[name]) for row in rows[5:7] for name in names]) * np.array([1.0, 10.0, 100.0] * 2)
    middle = float(np.polynomial.polynomial.polyval(0.5, HERMITE @ values))
    assert middle == pytest.approx(25.0 * law("modified-sine").evaluate(0.55, 0)[0], abs=1e-3)


def test_the_error_of_rows_that_have_the_values_after_a_step(gearlink: Any, tmp_path: Path) -> None:
    """The drive knows one acceleration a row: before a step of it the polynomial through the file's own numbers."""
    path = tmp_path / "cam.yaml"
    motion = "[{to: 60, lift: 20, law: simple-harmonic}, {to: 360, lift: 0, law: cycloidal}]"
    path.write_text(
        f"kind: disc-cam\nmotion: {motion}\nfollower: {{type: translating-roller, roller_radius: 5}}\n"
        "cam: {prime_radius: 60}\n"
    )
    said = gearlink("export", path, "--cam-table", "--rows", 73, "--out", tmp_path).out
    table = np.loadtxt(tmp_path / "cam-cam-table.csv", delimiter=",", skiprows=1)
    curve = BPoly.from_derivatives(table[:, 0], table[:, 1:4])
    angle = np.linspace(50.0, 60.0, 20_001)
    off = np.abs(curve(angle) - 20.0 * law("simple-harmonic").evaluate(angle / 60.0, 0)[0]).max()
    assert off == pytest.approx(0.01185, rel=1e-3)
    assert f"({off:.3g} mm before rows with a step, which have the values after it)" in said
    smooth = gearlink("export", path, "--cam-table", "--set", "motion[0].law=cycloidal", "--out", tmp_path).out
    assert "step" not in smooth


def test_measured_points_have_a_table_without_jerk(gearlink: Any, tmp_path: Path) -> None:
    """It was a fault of the program."""
    assert gearlink("export", DESIGNS / "measured_cam.yaml", "--cam-table", "--out", tmp_path).status == 0
    head = (tmp_path / "measured-cam-cam-table.csv").read_text(encoding="utf-8").partition("\n")[0].split(",")
    assert [name.partition(" ")[0] for name in head[1:]] == ["slave_position", "slave_velocity", "slave_acceleration"]


def test_a_press_has_none(gearlink: Any, tmp_path: Path) -> None:
    done = gearlink("export", str(DESIGNS / "ty460.yaml"), "--cam-table", "--out", str(tmp_path))
    assert done.status == 2
    assert "no cam" in done.err
