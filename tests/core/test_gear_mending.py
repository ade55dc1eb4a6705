"""Profile shifts that a failing check recommends, put into the pair as printed."""

from __future__ import annotations

import math
import re

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlink.core.gear_checks import gear_check
from gearlink.core.gear_mending import shared_anew
from gearlink.core.gear_pair import GearPair
from gearlink.core.specs.common import GearLimits

SHIFTS = re.compile(r"x1 = (\S+), x2 = (\S+) keep")


def failing(pair: GearPair, *names: str) -> list[str]:
    return [check.message for name in names for check in gear_check(name, pair, GearLimits()) if check.status == "fail"]


@given(st.integers(8, 30), st.integers(20, 90), st.floats(0.5, 1.4), st.floats(-0.6, 0.3))
def test_recommended_shifts_mend_tips_and_interference(z1: int, z2: int, x1: float, x2: float) -> None:
    pair = GearPair.from_shift(2.5, (z1, z2), (x1, x2))
    for message in failing(pair, "tip-thickness", "involute-interference"):
        if found := SHIFTS.search(message):
            mended = GearPair.from_shift(2.5, (z1, z2), (float(found[1]), float(found[2])))
            assert mended.center_distance == pytest.approx(pair.center_distance, abs=1e-8, rel=0.0)
            assert not failing(mended, "tip-thickness", "involute-interference", "undercut")


def test_a_pointed_tip_is_mended() -> None:
    (message,) = failing(GearPair.from_shift(4.0, (12, 40), (0.9, -0.2)), "tip-thickness")
    assert "x1 = 0.473, x2 = 0.227 keep the centre distance" in message


def test_where_no_shift_helps_no_number_is_given() -> None:
    (message,) = failing(GearPair.from_shift(4.0, (12, 12), (0.45, 0.45), addendum=1.6), "tip-thickness")[:1]
    assert message.endswith("lower its profile shift or its addendum")


@pytest.mark.parametrize("gear", [0, 1])
def test_sharing_anew_keeps_the_centre_distance(gear: int) -> None:
    pair = GearPair.from_center_distance(4.0, (30, 72), 206.0)
    again = shared_anew(pair, gear, 0.11)
    assert again.profile_shift[gear] == 0.11
    assert again.center_distance == pytest.approx(206.0, rel=1e-14, abs=0.0)


def test_a_warning_that_no_shift_ends_names_none() -> None:
    (message,) = [
        check.message
        for check in gear_check("tip-thickness", GearPair.from_shift(2.0, (10, 24), (0.56, 0.05)), GearLimits())
        if check.status == "warn"
    ]
    assert message.endswith("lower its profile shift or its addendum")


def test_the_contact_ratio_stays() -> None:
    pair = GearPair.from_shift(22.472, (6, 43), (-0.7029351494, 0.0266140915), math.radians(25.0), addendum=0.8)
    for message in failing(pair, "involute-interference"):
        found = SHIFTS.search(message)
        assert not found or not failing(shared_anew(pair, 0, float(found[1])), "contact-ratio")
