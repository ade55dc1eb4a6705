"""Checks that several geared linkages share."""

from __future__ import annotations

import math

import pytest

from gearlink.core.parts.linkages.checks import transmission_check


@pytest.mark.parametrize(("degrees", "status"), [(39.9, "fail"), (40.1, "warn"), (45.1, "pass")])
def test_transmission_angle_against_its_limit(degrees: float, status: str) -> None:
    check = transmission_check(math.radians(degrees), 40.0, "shorten the crank")
    assert check.status == status
    assert not check.note


@pytest.mark.parametrize(
    ("angle", "shown"), [(1e-3, "up to 1000 times"), (0.0, "without bound"), (math.radians(1.5), "up to 38.2 times")]
)
def test_near_a_dead_point_the_condition_number_is_named(angle: float, shown: str) -> None:
    check = transmission_check(angle, 40.0, "shorten the crank")
    assert "minimum transmission angle" in check.message
    assert [f"magnified {shown} there (condition number)" in each for each in check.note] == [True]
