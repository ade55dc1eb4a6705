"""The angles of a whole cycle: one may be left out and is what the others leave of a revolution."""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from pydantic import ValidationError

KEYS = ("working", "far_dwell", "return", "near_dwell")
ANGLES = dict(zip(KEYS, (80.0, 70.0, 100.0, 110.0), strict=True))


def design(**cycle: Any) -> Any:
    return factory.design("wide_swing_cycle", command="swing", cycle=cycle)


@pytest.mark.parametrize("left_out", KEYS)
def test_remainder(left_out: str) -> None:
    given = {key: angle for key, angle in ANGLES.items() if key != left_out}
    assert design(**given).spec.cycle.lengths == pytest.approx(tuple(ANGLES.values()), rel=1e-15)
    found = design(**given).quantity(f"{left_out}_angle")
    assert (found.value, found.unit) == (pytest.approx(ANGLES[left_out], rel=1e-14), "deg")


@pytest.mark.parametrize(
    ("cycle", "words"),
    [
        ({"working": 80.0, "far_dwell": 70.0}, "at most one angle of a cycle may be omitted"),
        ({"working": 80.0, "far_dwell": 180.0, "return": 100.0}, "add up to 360 deg; nothing is left for near_dwell"),
        (ANGLES | {"return": 101.0}, "361 deg .required 360 deg"),
    ],
)
def test_refusals(cycle: dict[str, float], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        design(**cycle)


@pytest.mark.parametrize("swing", [110.0, 140.0])
def test_swing_without_pressure_angle_at_its_ends(swing: float) -> None:
    radius = 200.0 * math.cos(math.radians(0.5 * swing))
    found = factory.design("wide_swing_twin_cam", command="swing", swing=swing, cam__rocker_radius=radius)
    assert math.degrees(found.raw("zero_end_swing")) == pytest.approx(swing, rel=1e-12)
    assert found.even_cam.pressure_angle(np.array([0.0, 1.0])) == pytest.approx([0.0, 0.0], abs=1e-12)
