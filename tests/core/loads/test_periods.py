"""Loads of gears that are out of balance: they come home with their own turns, not with the input's."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from factory import design, worked

FIVE_BAR = {
    "kind": "geared-five-bar",
    "gears": {"module": 2, "input": 30, "idler": 40, "output": 30},
    "phase": 0,
    "coupler_point": {"along": 0, "across": 0},
    "links": {"input": 20, "coupler": 70, "follower": 70, "output": 20, "frame": 120},
}
TWO_GEARS = {
    "kind": "two-gear-four-bar",
    "gears": {"module": 2, "planet": 48, "ring": 80},
    "links": {"coupler": 64, "rocker": 80, "frame": 83.7},
}
SPEED = {"input_speed": 60}
LOADED: dict[str, tuple[dict[str, Any], str, int]] = {
    "three-gear, 40/72": (worked("loaded_feed"), "idler", 9),
    "two-gear, 1 - 48/80": (TWO_GEARS | SPEED, "output", 5),
    "five-bar, 30/40": (FIVE_BAR | SPEED, "idler", 4),
}


def loaded(name: str, center: list[float]) -> Any:
    """Its gear of 2 kg with its centre of mass there."""
    data, gear, _ = LOADED[name]
    links = data.get("loads", {}).get("links", {}) | {gear: {"mass": 2.0, "center": center}}
    return design(data | {"loads": data.get("loads", {}) | {"links": links, "gravity": [0.0, -9.81]}}, command="loads")


@pytest.mark.parametrize("name", LOADED)
def test_a_gear_out_of_balance_comes_home_after_its_own_turns(name: str) -> None:
    """1e-12 of the maximum torque."""
    loads = loaded(name, [20.0, 0.0])
    assert loads.turns == LOADED[name][2]
    phi = np.linspace(0.0, 6.0, 40)
    here, turn, period = (loads.machine.torque(phi + at) for at in (0.0, 2.0 * np.pi, loads.machine.period))
    size = np.abs(here).max()
    assert np.abs(period - here).max() < 1e-12 * size
    assert np.abs(turn - here).max() > 1e-3 * size
    assert loads.input_torque_mean == pytest.approx(loaded(name, [0.0, 0.0]).input_torque_mean, abs=1e-9 * size)


@pytest.mark.parametrize("name", LOADED)
def test_a_balanced_gear_leaves_the_period_of_the_links(name: str) -> None:
    assert loaded(name, [0.0, 0.0]).turns == 1


def test_a_range_does_not_narrow_what_loads_looks_at() -> None:
    """Forces are those of the whole period, and so is the transmission angle: against rows of the links' directions."""
    bar = {
        "kind": "geared-five-bar",
        "form": "function",
        "gears": {"module": 2.0, "planet": 20, "sun": 40},
        "links": {"coupler": 40, "follower": 150, "output": 140, "frame": 160},
        "phase": 30,
        "range": {"start": 0, "end": 40},
        "loads": {"speed": 60, "links": {"output": {"inertia": 0.01}}},
    }
    loads = design(bar, command="loads")
    links = loads.machine.at(np.linspace(0.0, loads.machine.period, 3601)).links
    sine = np.sin(links["follower"].turn.value - links["output"].turn.value)
    assert loads.transmission_angle == pytest.approx(float(np.arcsin(np.abs(sine).min())), abs=1e-5)
    assert loads.transmission_angle < loads.design.min_transmission_angle - 0.05
