"""What is 0 by the definition of a machine is 0 in its results, not rounding: equality, no tolerance."""

from __future__ import annotations

import math

import numpy as np
import pytest
from factory import design

from gearlink.core.numerics.extremes import extremes_over, share_of

SWINGS = (
    "wide_swing_cycle",
    "wide_swing_oscillating_cam",
    "wide_swing_slider",
    "wide_swing_slider_cam",
    "wide_swing_twin_cam",
    "wide_swing_twin_rocker",
)


@pytest.mark.quick(3)
@pytest.mark.parametrize("name", SWINGS)
def test_a_rocker_stands_still_at_the_ends_of_its_swing(name: str) -> None:
    motion = design(name)
    assert motion.quantity("rocker_speed_min").value == 0.0
    assert motion.quantity("rocker_speed_min_at").value == 0.0
    assert motion.quantity("rocker_speed_max").value > 1.0


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["loaded_swing_slider", "loaded_wide_swing", "loaded_swing_cycle"])
def test_a_rocker_that_stands_still_has_no_inertia_for_its_cam(name: str) -> None:
    assert design(name, command="loads").quantity("reflected_inertia_min").value == 0.0


@pytest.mark.parametrize("name", ["ty460", "ty460_register"])
def test_a_press_starts_at_a_dead_centre(name: str) -> None:
    found = design(name, command="press").table("positions")
    for column in ("cam_angle", "bed_displacement", "bed_velocity"):
        assert found[column][0] == 0.0
        assert np.count_nonzero(found[column]) == found.length - 1


@pytest.mark.parametrize("width", [0.1, 1.0, 2.0943951023931953, 6.0, 2.0 * math.pi])
def test_the_ends_of_a_search_are_the_ends(width: float) -> None:
    def share(x: np.ndarray) -> np.ndarray:
        return share_of(x, width)

    low, high = extremes_over([(share, False), (share, True)], 0.0, width, samples=64)
    assert (low.value, high.value) == (0.0, 1.0)
