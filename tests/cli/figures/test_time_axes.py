"""Charts over the input's angle stand in ms as well where the speed is known, each once, and nowhere else.

Tolerance: the ends of both axes are a product apart, two roundings of the drawing's own arithmetic.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from sheets import placed_sheet, sheet
from sweeps import mostly_slow

from gearlink.cli.views.figures.drawing import time_axes
from gearlink.cli.views.page import sections

GIVEN = {"input_speed": 75.0}
CASES: list[tuple[str, str, dict[str, Any]]] = [
    ("candy_feed", "analyze", GIVEN),
    ("ty460", "press", {}),
    ("ty460", "cam", {}),
    ("loaded_feed", "loads", {}),
    ("candy_feed", "synth dwell", GIVEN),
    ("two_gear_drag_link", "analyze", GIVEN),
    ("wide_lever", "analyze", GIVEN),
    ("hypocycloid_slider", "analyze", GIVEN),
    ("mutilated_gear_press", "analyze", GIVEN),
    ("five_bar_path", "analyze", GIVEN),
    ("five_bar_positions", "analyze", GIVEN),
    ("geared_six_bar", "analyze", GIVEN),
    ("ty460_slider_crank", "crank", GIVEN),
    ("swing_gripper", "gripper", {}),
    ("swing_gripper", "cam", {}),
    ("wide_swing_twin_cam", "swing", {}),
    ("wide_swing_cycle", "cam", {}),
]
INPUTS = set(time_axes._UNITS_OF_A_TURN)


def rows(axes: Any) -> list[Any]:
    return [child for child in axes.child_axes if child.get_gid() in (time_axes.ROW, time_axes.UNEVEN)]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "command", "keys"), mostly_slow(CASES, 4))
def test_charts_over_the_input_are_in_time_as_well(name: str, command: str, keys: dict[str, Any]) -> None:
    _, figure = sheet(name, command, **keys)
    over = [axes for axes in figure.axes if axes.get_xlabel() in INPUTS and axes.get_lines()]
    timed = [axes for axes in figure.axes if rows(axes)]
    # The compensation cams of a press have a panel over a part of the input beside the cams.
    assert [axes for axes in over if axes not in timed and "Compensation" not in axes.get_title(loc="left")] == []
    assert timed
    assert all(len(rows(axes)) == 1 for axes in timed)
    if keys:
        assert not any(rows(axes) for axes in sheet(name, command).figure.axes)


@pytest.mark.slow
def test_a_turn_of_the_axis_is_a_turn_in_time() -> None:
    _, figure = placed_sheet("candy_feed", "analyze", **GIVEN)
    charts = [axes for axes in figure.axes if rows(axes)]
    assert len(charts) == 5
    for axes in charts:
        (row,) = rows(axes)
        np.testing.assert_allclose(row.get_xlim(), np.array(axes.get_xlim()) * 60_000.0 / 75.0 / 360.0, rtol=1e-12)
    assert next(chart["ms"] for chart in sections.charts(figure)) == pytest.approx([0.0, 800.0], rel=1e-12)


def test_the_crank_of_a_linkage_that_stands_in_between_has_no_time() -> None:
    """The four-bar behind a mutilated gear turns in parts, one a cycle."""
    _, figure = sheet("mutilated_gear_press", **GIVEN)
    behind = next(axes for axes in figure.axes if "four-bar" in axes.get_xlabel())
    assert not rows(behind)


@pytest.mark.slow
def test_the_cams_of_a_press_turn_unevenly_in_time() -> None:
    made, figure = placed_sheet("ty460", "cam")
    (row,) = [row for axes in figure.axes for row in rows(axes)]
    assert row.get_gid() == time_axes.UNEVEN
    assert row.get_xlim() == pytest.approx((0.0, 800.0), rel=1e-12)
    at = row.get_xaxis().get_transform().transform
    half = (at(400.0) - at(0.0)) / (at(800.0) - at(0.0))
    wanted = float(made.bed.cam_angle(math.pi).value) / (2.0 * math.pi)
    assert half == pytest.approx(wanted, abs=1e-4)  # straight between whole degrees of the cam
    assert abs(half - 0.5) > 0.05
