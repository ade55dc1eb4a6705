"""`gearlink export --cam-table`: rows that a drive reads, and who has none."""

from __future__ import annotations

import csv
from pathlib import Path
from typing import Any

import numpy as np
import pytest

from gearlink.core.parts.cams.follower_motion import HERMITE
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


def test_a_press_has_none(gearlink: Any, tmp_path: Path) -> None:
    done = gearlink("export", str(DESIGNS / "ty460.yaml"), "--cam-table", "--out", str(tmp_path))
    assert done.status == 2
    assert "no cam" in done.err
