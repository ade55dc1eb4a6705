"""Register of the gripper: gains of every part against the exact chain, and samples of it.

Differences over h = 1 um: their own error is h^2 and eps/h, 1e-7.
"""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.errors import NoSolution

SOURCES: dict[str, Any] = {
    key: {"plus_minus": 0.01}
    for key in (
        "links.input",
        "links.coupler",
        "links.output",
        "pivots.input[0]",
        "pivots.input[1]",
        "pivots.output[0]",
        "pivots.output[1]",
        "arm.direction",
    )
} | {f"pins.{pin}": {"clearance": [0.0, 0.01]} for pin in "ACDE"}


def gripper(sources: dict[str, Any] = SOURCES, **register: Any) -> Any:
    return factory.design("swing_gripper", command="register", tolerance={"sources": sources}, register=register)


def test_gains_are_the_slopes_of_the_exact_chain() -> None:
    made, phi, h = gripper(), np.radians([60.0, 106.0, 200.0]), 1e-3
    none = dict.fromkeys(SOURCES, 0.0)
    for one in made.contributions(phi, 1):
        for axis in (1.0, 1j) if np.iscomplexobj(one.gain) else (1.0,):
            ends = [made.sampled_errors(phi, 1, none | {one.source: np.array([h * s * axis])})[:, 0] for s in (1, -1)]
            assert (ends[0] - ends[1]) / (2.0 * h) == pytest.approx((one.gain * axis).real, abs=1e-7), one.source


def test_an_axis_and_its_pin_move_the_tip_alike() -> None:
    """E moved by 10 um is a pin that lies 10 um aside: the gripper turns, and its axis takes the tip along."""
    gains = {one.source: one.gain for one in gripper().contributions(np.radians([106.0]), 1)}
    assert gains["pivots.output[0]"] == pytest.approx(gains["pins.E"].real, abs=1e-14)
    assert gains["pivots.output[1]"] == pytest.approx((1j * gains["pins.E"]).real, abs=1e-14)


def test_a_whole_machine_that_is_moved_moves_its_tip_as_much() -> None:
    """A and E moved by one vector: no link turns, the tip goes with it."""
    gains = {one.source: one.gain for one in gripper().contributions(np.radians([60.0, 106.0]), 1)}
    both = gains["pivots.input[0]"] + 1j * gains["pivots.input[1]"]
    both = both + gains["pivots.output[0]"] + 1j * gains["pivots.output[1]"]
    assert np.abs(both) == pytest.approx(1.0, abs=1e-12)


def test_samples_of_the_chain_are_the_budget() -> None:
    sizes = {key: one for key, one in SOURCES.items() if not key.startswith("pins")}
    more = {"cam_error": 0.01}
    assert gripper(sizes, method="mc", **more).band == pytest.approx(gripper(sizes, **more).band, rel=0.03)


def test_what_does_not_move_the_tip_is_refused() -> None:
    with pytest.raises(NoSolution, match="does not move the tip"):
        gripper({"arm.length": {"plus_minus": 0.01}}).report("register")
