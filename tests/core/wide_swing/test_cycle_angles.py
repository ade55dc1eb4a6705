"""The angles of a whole cycle: one may be left out and is what the others leave of a revolution."""

from __future__ import annotations

from typing import Any

import factory
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
