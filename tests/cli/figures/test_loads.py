"""Sheets of `loads`: what the panels show is what the tables say."""

from __future__ import annotations

import itertools
import math
from typing import Any

import numpy as np
import pytest
from factory import DESIGNS
from sheets import placed_sheet, sheet
from sweeps import mostly_slow

LOADS = {"roller": {"width": 20}, "vibration": {"frequency": 80, "damping": 0.03, "allowed_residual": 0.1}}


def _axes(figure: Any, title: str) -> Any:
    return next(axes for axes in figure.axes if title in (axes.get_title(loc="left"), axes.get_title()))


def _line(axes: Any, label: str) -> Any:
    return next(line for line in axes.lines if line.get_label() == label)


def test_feed_shows_torque_polar_loads_and_speed() -> None:
    design, figure = sheet("loaded_feed", "loads")
    torque = design.table("torque")
    line = _line(_axes(figure, "Input torque"), "whole")
    assert np.array_equal(line.get_ydata()[:-1], torque["input_torque"])
    polar = _axes(figure, "Pin C [N]").lines[0]
    joints = design.table("joints")
    assert np.array_equal(polar.get_xdata()[:-1], joints["C_x"])
    assert np.array_equal(polar.get_ydata()[:-1], joints["C_y"])
    speed = _axes(figure, "Speed of the input").lines[0]
    assert np.array_equal(speed.get_ydata()[:-1], design.table("speed")["speed"])


@pytest.mark.slow
def test_gripper_shows_residual_over_speed_and_cams_by_pressure() -> None:
    design, figure = sheet("loaded_gripper", "loads")
    residual = _axes(figure, "Residual vibration over the speed").lines[0]
    assert np.array_equal(residual.get_ydata(), design.table("spectrum")["residual"])
    (profile,) = _axes(figure, "main cam: pressure [N/mm²]").collections
    assert float(profile.get_array().max()) == pytest.approx(design.hertz_pressure_max[0], rel=1e-3)


@pytest.mark.slow
def test_the_mark_of_a_residual_is_that_of_its_finding() -> None:
    """It was read from the curve between two of its points."""
    design, figure = sheet("loaded_wide_swing", "loads", speed=400.0)
    (mark,) = [line for line in _axes(figure, "Residual vibration over the speed").lines if line.get_gid() == "fails"]
    assert mark.get_ydata() == [design.quantity("residual_amplitude").value]


@pytest.mark.slow
def test_an_odd_curve_takes_the_width_of_a_page_of_two_columns() -> None:
    """The last one alone had left half a row empty, and its axis in ms stood a row below that of its neighbour."""
    _, figure = placed_sheet("loaded_press", "loads")
    torque, left, right = (_axes(figure, title) for title in ("Input torque", "Contact forces", "Hertzian pressure"))
    assert torque.get_position().x1 == pytest.approx(right.get_position().x1, abs=1e-3)
    assert left.get_position().y0 == pytest.approx(right.get_position().y0, abs=1e-3)


@pytest.mark.slow
@pytest.mark.parametrize("layout", ["twin-rocker", "twin-cam"])
def test_cycle_of_a_wide_swing_shows_both_strokes(layout: str) -> None:
    design, figure = sheet("wide_swing_cycle", "loads", layout=layout, loads=LOADS)
    axes = _axes(figure, "Force of the roller on its cam")
    table = design.table("contact_stroke", samples=400)
    for name, label in (("main", "working stroke"), ("return", "return stroke")):
        assert np.array_equal(_line(axes, label).get_ydata(), table[f"{name}_force"], equal_nan=True)
    for title in ("cam: pressure [N/mm²]", "return cam: pressure [N/mm²]"):
        (profile,) = _axes(figure, title).collections
        assert 0.0 < float(profile.get_array().max()) <= design.hertz_pressure_max * 1.001


@pytest.mark.slow
def test_stroke_of_a_wide_swing_leaves_out_where_nothing_touches() -> None:
    design, figure = sheet("loaded_wide_swing", "loads")
    line = _axes(figure, "Force of the roller on its cam").lines[0]
    end = np.degrees(design.cam.contact[0][1] * design.cam.cycle_angle)
    inside = (line.get_xdata() > end) & (line.get_xdata() < 120.0 - end)
    assert np.isnan(line.get_ydata()[inside]).all()
    assert not np.isnan(line.get_ydata()[~inside]).any()


@pytest.mark.parametrize("name", ["loaded_feed", "loaded_wide_swing"])
def test_a_locked_machine_has_a_sheet_of_what_is_left(name: str) -> None:
    friction = {"pins": 0.9, "pin_radius": 900}
    _, figure = sheet(name, "loads", loads__friction=friction)
    assert _axes(figure, "Shaking force [N]").lines


@pytest.mark.slow
@pytest.mark.parametrize("title", ["Pins A, D [N]", "Shaking force [N]"])
def test_what_is_rounding_beside_the_joint_forces_is_no_force(title: str) -> None:
    """Two discs opposite each other leave no force on the shaft; what is left is 1e-14 of that on their bearings."""
    _, figure = sheet("loaded_cycloidal", "loads")
    assert [text.get_text() for text in _axes(figure, title).texts] == ["0 N throughout"]


def test_curves_of_a_panel_are_told_apart_in_grey() -> None:
    """No two neighbours have the same line, and no two curves the same line and colour."""
    _, figure = sheet("loaded_feed", "loads")
    for title in ("Input torque", "Joint forces", "Tooth forces, tangential"):
        curves = [line for line in _axes(figure, title).lines if len(line.get_xdata()) > 25]
        dashes = [str(line._unscaled_dash_pattern) for line in curves]
        assert all(one != other for one, other in itertools.pairwise(dashes)), title
        assert len({(dash, line.get_color()) for dash, line in zip(dashes, curves, strict=True)}) == len(curves)


@pytest.mark.slow
def test_the_rests_of_a_cycle_are_drawn_where_the_roller_presses_hardest() -> None:
    design, figure = sheet("loaded_swing_cycle", "loads")
    titles = {
        "Force of the roller on its cam": design.contact_force_max,
        "Hertzian pressure": design.hertz_pressure_max,
    }
    for axes in figure.axes:
        if (greatest := titles.pop(axes.get_title(loc="left"), None)) is not None:
            drawn = [line for line in axes.lines if line.get_label() != "allowed 1200"]
            most = max(float(np.nanmax(np.asarray(line.get_ydata(), dtype=float))) for line in drawn)
            assert most == pytest.approx(greatest, rel=1e-9)
            assert [text.get_text() for text in axes.get_legend().get_texts()].count("rests") == 1
    assert not titles


@pytest.mark.slow
@pytest.mark.parametrize("name", mostly_slow(sorted(path.stem for path in DESIGNS.glob("loaded_*.yaml")), 1))
def test_a_sheet_of_loads_is_a_page_of_a4_or_of_a3(name: str) -> None:
    """That of a press was 475 mm long: no printer takes it to scale. All panels are on it, in rows of several."""
    figure = placed_sheet(name, "loads").figure
    width, height = figure.get_size_inches()
    assert width in (8.27, 11.69)
    assert height <= math.sqrt(2.0) * width * 1.002
    panels = [axes for axes in figure.axes if axes.get_title(loc="left")]
    assert all(axes.get_window_extent().height > 18.0 for axes in panels), "none is squeezed"


@pytest.mark.slow
def test_angles_of_a_pin_stand_apart_and_are_all_told() -> None:
    """Numbers of near marks lay on each other: within 0.13 of the curve they are one text."""
    pins = [axes for axes in sheet("loaded_press", "loads").figure.axes if axes.get_title(loc="left").startswith("Pin")]
    assert len(pins) >= 8
    for axes in pins:
        curve = max(axes.lines, key=lambda line: len(line.get_xdata())).get_xydata()
        words = [text for text in axes.texts if "°" in text.get_text()]
        told = ", ".join(text.get_text() for text in words).split(", ")
        assert sorted(told) == ["0°", "180°", "270°", "90°"]
        near = 0.13 * np.nanmax(np.ptp(curve[np.isfinite(curve).all(axis=1)], axis=0))
        for one, other in itertools.combinations(words, 2):
            assert math.dist(one.xy, other.xy) >= near * (1.0 - 1e-9)
