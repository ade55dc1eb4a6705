"""Where the frames of a press's bodies lie."""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest

PRESS = "loaded_press"
SLOW = 0.001
"""Sheets an hour: what is left of the forces of motion is below 1e-12 N."""


def _press(**keys: Any) -> Any:
    return factory.design(PRESS, command="loads", **keys)


# Frames


def test_bodies_that_turn_freely_lie_along_x_at_the_start() -> None:
    for side in (1, -1):
        links = _press(loads__bed_side=side).machine.at(np.zeros(1)).links
        assert abs(links["pinion"].turn.value[0]) <= 1e-15
        assert abs(links["cylinder"].turn.value[0]) <= 1e-15


@pytest.mark.parametrize("gravity", [[9.81, 0], [0, 9.81]])
def test_a_pinion_out_of_balance_hangs_along_x_at_the_start(gravity: list[float]) -> None:
    """Held still, its weight along its arm turns it nowhere; across, it loads the lower rack with m g z/r8.

    The bed is free and takes nothing of it. The lower rack lies on +x of the pinion, a positive force is along -y.
    """
    keys = {"speed": SLOW, "loads__gravity": gravity, "loads__forces": [{"on": "cylinder", "torque": 1e-9}]}
    even, odd = (
        _press(**keys, loads__links__pinion={"mass": 16, "inertia": 0.08, "center": center})
        for center in ([0, 0], [20, 0])
    )
    start = np.zeros(1)
    extra = [
        odd.machine.reactions(start).unknowns[name][0][0] - even.machine.reactions(start).unknowns[name][0][0]
        for name in ("rack_lower", "rack_upper")
    ]
    turning = 16.0 * 0.02 * gravity[1]
    assert extra == pytest.approx([turning / odd.pinion_radius, 0.0], abs=1e-9)
