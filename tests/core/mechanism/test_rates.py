"""Derivatives of all links of every kind against differences of the derivative below.

Central differences over h and h/2, extrapolated: their error is of the order h^4 of a smooth motion, and of the
rounding over h. Both lie below 1e-8 of the maximum rate of a link at these places.
"""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest
from loaded import LOADS, loaded

from gearlink.core.mechanism.rates import Point, Rates, Turn, carried, fixed, steady

STEP, ROOM = 4e-4, 1e-8
SPEED = {"speed": 60, "forces": [{"on": "output", "torque": 1}]}
FUNCTION = {
    "kind": "geared-five-bar",
    "form": "function",
    "gears": {"module": 2.0, "planet": 20, "sun": 40},
    "links": {"coupler": 30.0, "follower": 120.0, "output": 120.0, "frame": 70.0},
    "phase": 0.0,
}
MORE: dict[str, tuple[Any, dict[str, Any]]] = {
    "wide swing, cam on a crank-rocker": ("loaded_oscillating_cam", {}),
    "wide swing, slider": ("loaded_swing_slider", {}),
    "wide swing, stroke alone": ("loaded_wide_swing", {}),
    "five-bar, function": (FUNCTION, {"loads": SPEED}),
    "six-bar, whole revolutions": ("loaded_six_bar", {}),
    "drag link": ("two_gear_drag_link", {"loads": SPEED}),
    "mutilated, timed": ("mutilated_gear_times", {"loads": {"speed": 60, "links": {"rocker": {"inertia": 0.01}}}}),
    "press, quartic transition": ("loaded_press", {"cam__transition": "quartic"}),
}
DESIGNS = [*LOADS, *MORE]


def _made(name: str) -> Any:
    if name in LOADS:
        return loaded(name)
    base, keys = MORE[name]
    return factory.design(base, command="loads", **keys)


def _places(design: Any, count: int = 24) -> Any:
    """Input angles over a revolution, or a stroke, away from the joints of the law."""
    width = design.machine.stroke or 2.0 * np.pi
    phi = width * (np.arange(count) + 0.37) / count
    joints = np.array([*design.own_joints, 0.0, width])
    apart = np.abs(np.remainder(phi[:, None] - joints + np.pi, 2.0 * np.pi) - np.pi).min(axis=1)
    return phi[apart > 4.0 * STEP]


def _near(design: Any, phi: Any, order: int, step: float) -> Any:
    """Links at both sides."""
    return [design.moving.at(phi + sign * step, order).links for sign in (1.0, -1.0)]


def _parts(link: Any) -> tuple[Rates[Any], Rates[Any]]:
    return link.origin, link.turn


@pytest.mark.quick(8)
@pytest.mark.parametrize("name", DESIGNS)
def test_each_derivative_is_the_rate_of_the_one_below(name: str) -> None:
    design = _made(name)
    phi, highest = _places(design), design.moving.highest
    assert len(phi) > 12
    here = design.moving.at(phi, highest).links
    wide, narrow = (_near(design, phi, highest, step) for step in (STEP, 0.5 * STEP))
    for link, at in here.items():
        for i, part in enumerate(_parts(at)):
            assert part.order == highest
            for k in range(highest):
                far, close = (
                    (_parts(after[link])[i][k] - _parts(before[link])[i][k]) / (2.0 * step)
                    for (after, before), step in ((wide, STEP), (narrow, 0.5 * STEP))
                )
                off = np.abs((4.0 * close - far) / 3.0 - part[k + 1])
                assert off.max() <= ROOM * max(np.abs(each).max() for each in part[k:]) + 1e-9, (link, i, k)


@pytest.mark.quick(6)
@pytest.mark.parametrize("name", DESIGNS)
def test_lower_orders_give_the_same_and_no_more(name: str) -> None:
    """To the last bit. The press has one derivative at least, for the normals of its rollers."""
    design = _made(name)
    phi = _places(design, 5)
    whole = design.moving.at(phi, design.moving.highest).links
    for order in range(design.moving.highest):
        found = design.moving.make(phi, order, 1).links
        for link, at in found.items():
            for part, of_whole in zip(_parts(at), _parts(whole[link]), strict=True):
                assert part.order == max(order, 1 if design.kind == "flatbed-press" else 0)
                assert all(np.array_equal(a, b) for a, b in zip(part, of_whole, strict=False))


def test_a_law_without_a_third_derivative_says_so() -> None:
    slider = _made("wide swing, slider")
    assert slider.moving.highest == 2
    with pytest.raises(AssertionError, match="third derivative was not requested"):
        _ = slider.moving.at(np.zeros(1), 3).links["rocker"].turn.third


def test_a_derivative_that_was_not_asked_for_is_named() -> None:
    phi = np.zeros(3)
    at = carried(fixed(1.0, phi, order=1), steady(phi, order=3), 2.0)
    assert isinstance(at, Point)
    assert (at.order, steady(phi, order=3).order) == (1, 3)
    with pytest.raises(AssertionError, match="second"):
        _ = at.second
    with pytest.raises(AssertionError, match="first"):
        _ = Turn(phi).first
