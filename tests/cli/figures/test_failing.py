"""Where a check fails its place is red: on curves, at angles, on bodies that clash; nowhere in a design that passes."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from factory import design
from sheets import sheet

from gearlink.cli.views.figures.drawing import failing

CASES = [
    ("analyze", "two_gear_ring", {"limits__transmission_angle": 70.0}, 1),
    ("analyze", "two_gear_ring", {"shafts": {"D_radius": 30.0}}, 3),
    ("analyze", "wide_lever", {"limits__transmission_angle": 60.0}, 1),
    ("analyze", "five_bar_path", {"limits__transmission_angle": 55.0}, 1),
    ("analyze", "six_bar_swing", {"limits__transmission_angle": 62.0}, 1),
    ("analyze", "candy_feed", {"limits__transmission_angle": 70.0}, 1),
    ("crank", "ty460_slider_crank", {"limits__transmission_angle": 75.0}, 1),
    ("analyze", "hypocycloid_slider", {"limits__transmission_angle": 75.0}, 1),
    ("analyze", "mutilated_gear_press", {"limits__transmission_angle": 60.0}, 1),
    ("press", "ty460", {"limits__transmission_angle": 40.0}, 1),
    ("cam", "ty460", {"limits__pressure_angle": 12.0}, 2),
    ("cam", "wide_swing_twin_cam", {"limits__pressure_angle": 5.0}, 1),
]


def red(made: Any) -> list[Any]:
    artists = [artist for axes in made.axes for artist in (*axes.lines, *axes.patches)]
    return [artist for artist in artists if artist.get_gid() == "fails"]


@pytest.mark.quick(3)
@pytest.mark.parametrize(("command", "name", "keys", "count"), CASES)
def test_places_that_fail_are_red(command: str, name: str, keys: dict[str, Any], count: int) -> None:
    made = red(sheet(name, command, **keys).figure)
    assert len(made) >= count


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["ty460_slider_crank", "hypocycloid_slider", "mutilated_gear_press", "wide_lever"])
def test_the_least_transmission_angle_is_the_foot_of_its_curve(name: str) -> None:
    """Curves have a point every degree at least, and their minimum is a smooth minimum: 1e-2 deg."""
    made, figure = sheet(name)
    (line,) = (line for axes in figure.axes for line in axes.lines if line.get_gid() == "transmission-angle")
    least = np.degrees(made.min_transmission_angle)
    assert np.min(line.get_ydata()) == pytest.approx(least, abs=1e-2)


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", ["ty460_slider_crank", "hypocycloid_slider", "mutilated_gear_press", "six_bar_swing"])
def test_a_design_that_passes_has_no_red(name: str) -> None:
    assert red(sheet(name).figure) == []


def test_red_stretches_are_those_below_the_limit() -> None:
    (line,) = red(sheet("wide_lever", limits__transmission_angle=60.0).figure)
    x, y = line.get_data()
    shown = np.isfinite(y)
    table = design("wide_lever").table("motion")
    angle = np.asarray(table.data[table.columns.index("transmission_angle")])
    for at, below in zip(table.data[0], angle < 60.0, strict=True):
        if below:
            assert shown[np.searchsorted(x, at)]
    assert np.asarray(y)[shown].max() < 61.0


def test_pairs_that_clash() -> None:
    assert list(failing.clashes(design("two_gear_ring"))) == []
    found = list(failing.clashes(design("two_gear_ring", shafts={"D_radius": 30.0})))
    assert {pair.other.name for pair in found} == {"shaft at D"}
