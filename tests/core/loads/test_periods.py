"""Loads of gears that are out of balance: they come home with their own turns, not with the input's."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from scipy.integrate import solve_ivp

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


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "start", "end"),
    [("loaded_geneva", -60.0, 60.0), ("loaded_cam_gear", 120.0, 360.0)],
    ids=["geneva", "cam-gear"],
)
def test_the_residual_of_a_step_against_an_integration(name: str, start: float, end: float) -> None:
    """The output on its spring from rest over one step, by time; the integrator is asked for 1e-10."""
    made = design(name, command="loads", loads__vibration={"frequency": 12.0, "damping": 0.02})
    speed, damping, frequency = made.speed, 0.02, 2.0 * math.pi * 12.0
    first, last = (math.radians(angle) / speed for angle in (start, end))

    def rates(time: float, state: list[float]) -> list[float]:
        angle = np.mod(np.array([speed * time]), 2.0 * math.pi)
        bend = float(made.machine.at(angle).links[made.output].turn.second[0]) * speed**2
        return [state[1], -bend - 2.0 * damping * frequency * state[1] - frequency**2 * state[0]]

    # the ends themselves belong to the dwells
    inner = 1e-9
    found = solve_ivp(
        rates, (first + inner, last - inner), [0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-14, max_step=2e-3
    )
    place, rate = found.y[:, -1]
    free = (rate + damping * frequency * place) / (frequency * math.sqrt(1.0 - damping**2))
    assert made.residual_amplitude == pytest.approx(math.hypot(place, free), rel=1e-6)
    assert made.rise_periods == pytest.approx(12.0 * (last - first), rel=1e-12)


@pytest.mark.parametrize("pins", [1, 2])
def test_a_wheel_out_of_balance_is_looked_at_until_it_is_home(pins: int) -> None:
    """Its weight gives nothing over the whole period; the dwells are those of every step."""
    body = {"mass": 4.0, "inertia": 0.02, "center": [20.0, 5.0]}
    changes = {"loads__links": {"wheel": body}, "loads__gravity": [0.0, -9.81], "loads__forces": []}
    made = design("loaded_geneva", command="loads", slots=10, pins=pins, locking_radius=None, **changes)
    assert (made.turns, len(made.quiet_zones)) == (10 // math.gcd(10, pins), 10 * pins // math.gcd(10, pins))
    weight = made.machine.mean(lambda phi: made.machine.reduced(phi).weight)
    assert weight == pytest.approx(0.0, abs=1e-12)
    turns = [made.machine.torque(np.radians(np.arange(0.0, 360.0, 0.5) + 360.0 * k)) for k in range(made.turns)]
    assert np.abs(turns[1] - turns[0]).max() > 0.1 * made.input_torque_max
    assert made.input_torque_max >= np.max(turns)
    assert made.input_torque_min <= np.min(turns)


def test_the_teeth_of_a_cam_gear_must_not_change_flanks_in_the_dwell() -> None:
    """A torque that changes its sign in the dwell of the file, 0 to 120 deg."""
    torque = {"zones": [{"from": 60, "to": 240, "value": 8.0}]}
    changes = {"loads__forces": [{"on": "sun", "torque": -4.0}, {"on": "sun", "torque": torque}]}
    made = design("loaded_cam_gear", command="loads", loads__backlash=0.05, **changes)
    assert [check.status for check in made.check("load-reversal")] == ["fail"]
    assert made.is_quiet(math.radians(60.0))
    assert not made.is_quiet(math.radians(240.0))
