"""Bodies of a press outside of the print: cranks and axes, and a cylinder of several turns, against rows of a turn."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest


def press(**changes: Any) -> Any:
    return factory.design("ty460", command="press", **changes)


@pytest.mark.parametrize(("distance", "status"), [(290.0, "pass"), (130.0, "pass"), (115.0, "warn")])
def test_a_crank_that_passes_the_axis_of_the_other_gear_is_told(distance: float, status: str) -> None:
    """AB is 116 mm and a shaft as thin as 2 modules takes 6 mm."""
    found = press(input_gears__horizontal_distance=distance, input_gears__module=3).check("body-clearance")
    assert [(check.code, check.status) for check in found] == [("GL302", status), ("GL302", "pass")]
    assert found[0].value == pytest.approx(math.hypot(distance, 13.0) - 116.0 - 6.0, rel=1e-12)


def test_without_input_gears_nothing_is_known_of_their_axes() -> None:
    assert press(input_gears=None).check("body-clearance") == []


@pytest.mark.parametrize(
    ("turns", "length", "meets"), [(1, 320, False), (2, 320, True), (2, 200, False), (3, 290, True)]
)
def test_a_print_that_meets_the_forme_again(turns: int, length: float, meets: bool) -> None:
    """Where a row of the turn has both the print's arc and the forme at the printing line, outside of the zone."""
    radius = 140.0 / turns
    design = press(cylinder__radius=radius, cylinder__gear_ratio=turns, sync__print_length=length)
    motion = design.motion
    phi = np.linspace(motion.sync_start, motion.sync_start + 2.0 * math.pi, 20_001)
    rolled = motion.cylinder.travel(phi).value - motion.cylinder.travel(motion.sync_start).value
    passed = motion.bed.travel(phi).value - motion.bed.travel(motion.sync_start).value
    again = (rolled > length) & (rolled % (2.0 * math.pi * radius) < length) & (passed > 0.0) & (passed < length)
    again &= rolled < 2.0 * math.pi * radius * turns - 1e-6
    assert again.any() == meets
    statuses = [check.status for check in design.check("register")]
    assert statuses == ["pass", "warn"] if meets else statuses == ["pass"]
    if meets:
        words = design.check("register")[1].message
        low, high = (float(part) for part in words.partition("angles ")[2].partition(" deg")[0].split(" to "))
        ends = np.degrees(phi[again])[[0, -1]] % 360.0
        assert (low, high) == pytest.approx(tuple(ends), abs=0.5)
