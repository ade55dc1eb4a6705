"""The charts of the dwell within a tolerance and of the unloading law: their curves against the designs themselves.

Tolerances: a design of whole teeth agrees with its point of the curve to the roots' last digits, 1e-9; a dwell found by
brute force on 3600 crank angles falls short by up to 0.2 deg.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.cli.views.figures.chart_list import CHARTS
from gearlink.core.machines.three_gear.symmetric import symmetric_linkage
from gearlink.core.machines.three_gear.train import GearTrain
from tests.oracles.three_gear_output import output_motion

NEW = ("dwell-ratio", "dwell-tolerance", "dwell-frame", "velocity-peak", "acceleration-peak", "energy-parameter")


def test_window_over_the_ratio_is_that_of_the_design() -> None:
    chart = CHARTS["dwell-ratio"]
    for idler, tolerance in ((72, 0.5), (80, 1.0), (44, 2.0)):
        gears = {"module": 2, "crank": 40, "idler": idler, "output": 40}
        request = {"tolerance": tolerance, "margin": 0}
        made = design(
            {"kind": "three-gear-four-bar", "name": "x", "gears": gears, "dwell": request}, command="synth dwell"
        )
        (window,) = chart.values(np.array([-idler / 40.0]), tolerance)
        assert window == pytest.approx(made.quantity("tolerance_dwell_angle").value, rel=1e-9)
        (same,) = CHARTS["dwell-tolerance"].values(np.array([tolerance]), -idler / 40.0)
        assert same == pytest.approx(window, rel=1e-14)


def test_window_over_the_frame_against_brute_force() -> None:
    phi = np.linspace(0.0, 4.0 * math.pi, 7201)
    for ratio in (4.4, 5.1784, 5.5, 6.3):
        (window,) = CHARTS["dwell-frame"].values(np.array([ratio]), -1.8)
        angle = output_motion(symmetric_linkage(ratio, 1.0), GearTrain(1.0, 1.8, 1.0), phi).output_angle
        best = 0
        for start in range(0, 3600, 8):
            spread = np.maximum.accumulate(angle[start:]) - np.minimum.accumulate(angle[start:])
            best = max(best, int(np.searchsorted(spread, math.radians(1.0), side="right")) - 1)
        assert best * 0.1 <= window + 1e-9
        assert window - best * 0.1 < 1.0  # starts 0.8 deg apart


def test_law_over_the_swing_is_that_of_the_design() -> None:
    for swing, ratio in ((120.0, 2.6), (200.0, 4.0)):
        made = design("wide_swing_twin_cam", swing=swing, unloader__pivot_ratio=ratio, command="swing")
        for name in ("velocity-peak", "acceleration-peak", "energy-parameter"):
            (value,) = CHARTS[name].values(np.array([swing]), ratio)
            assert value == pytest.approx(made.quantity(name.replace("-", "_")).value, rel=1e-13)


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", NEW)
def test_tables_and_gaps(gearlink: Any, name: str) -> None:
    chart = CHARTS[name]
    ended = gearlink("chart", name, "--samples", 3, "--format", "json")
    assert ended.status == 0
    table = ended.json["tables"][name]
    assert len(table["columns"]) == 1 + len(chart.curves)
    assert all(value is None or value > 0.0 for row in table["rows"] for value in row[1:])
    refused = gearlink("chart", name, "--range", "1000:2000", "--curves", "1000" if "dwell" in name else "0.5")
    assert refused.status == 2
    assert "no values there\n  help: widen the range" in refused.err


@pytest.mark.slow
def test_designs_are_marked(gearlink: Any, designs: Path) -> None:
    ended = gearlink("chart", "energy-parameter", "--design", designs / "wide_swing_twin_cam.yaml", "--format", "json")
    made = design("wide_swing_twin_cam", command="swing")
    assert ended.json["quantities"]["energy_parameter"]["value"] == made.quantity("energy_parameter").value
    spring = gearlink("chart", "energy-parameter", "--design", designs / "wide_swing_twin_rocker.yaml")
    assert (spring.status, "applies to a cylinder" in spring.err) == (2, True)
    other = gearlink("chart", "dwell-ratio", "--design", designs / "wide_swing_twin_cam.yaml", "--format", "json")
    assert (other.status, json.loads(other.out)["errors"][0]["key"]) == (2, "kind")
    bare = gearlink("chart", "dwell-ratio", "--design", designs / "thesis_example_1.yaml")
    assert bare.status in (0, 2)
