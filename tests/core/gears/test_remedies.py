"""Profile shifts that a failing check recommends, put into the pair as printed."""

from __future__ import annotations

import math
import re
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st

from gearlink.core.gears.checks import gear_check
from gearlink.core.gears.pair import GearPair
from gearlink.core.gears.remedies import shared_anew
from gearlink.core.spec import GearLimits

SHIFTS = re.compile(r"profile_shift \[(\S+), (\S+)\] does it")


def failing(pair: GearPair, *names: str) -> list[str]:
    return [
        check.message
        for name in names
        for check in gear_check(name, pair, GearLimits(), shift_key="profile_shift")
        if check.status == "fail"
    ]


@given(st.integers(8, 30), st.integers(20, 90), st.floats(0.5, 1.4), st.floats(-0.6, 0.3))
def test_recommended_shifts_repair_tips_and_interference(z1: int, z2: int, x1: float, x2: float) -> None:
    pair = GearPair.from_shift(2.5, (z1, z2), (x1, x2))
    for message in failing(pair, "tip-thickness", "involute-interference"):
        if found := SHIFTS.search(message):
            repaired = GearPair.from_shift(2.5, (z1, z2), (float(found[1]), float(found[2])))
            assert repaired.center_distance == pytest.approx(pair.center_distance, abs=1e-8, rel=0.0)
            assert not failing(repaired, "tip-thickness", "involute-interference", "undercut")


def test_a_pointed_tip_is_repaired() -> None:
    (message,) = failing(GearPair.from_shift(4.0, (12, 40), (0.9, -0.2)), "tip-thickness")
    assert message.endswith("; profile_shift [0.473, 0.227] does it at the same centre distance")


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
        for check in gear_check(
            "tip-thickness", GearPair.from_shift(2.0, (10, 24), (0.56, 0.05)), GearLimits(), shift_key="profile_shift"
        )
        if check.status == "warn"
    ]
    assert message.endswith("lower its profile shift or its addendum")


def test_the_contact_ratio_stays() -> None:
    # the shifts that were once named here, 0.3179 and -0.9942, end the interference and break the contact
    pair = GearPair.from_shift(22.472, (6, 43), (-0.7029351494, 0.0266140915), math.radians(25.0), addendum=0.8)
    messages = failing(pair, "involute-interference")
    assert messages
    assert not failing(pair, "contact-ratio")
    assert failing(shared_anew(pair, 0, 0.317878942), "contact-ratio")
    for found in filter(None, map(SHIFTS.search, messages)):
        assert not failing(shared_anew(pair, 0, float(found[1])), "contact-ratio")


def test_interference_is_repaired() -> None:
    pair = GearPair.from_shift(2.0, (12, 80))
    (message,) = failing(pair, "involute-interference")
    found = SHIFTS.search(message)
    assert found
    assert not failing(shared_anew(pair, 0, float(found[1])), "involute-interference", "undercut", "tip-thickness")


def test_a_design_without_the_key_gets_no_numbers() -> None:
    checks = gear_check("tip-thickness", GearPair.from_shift(4.0, (12, 40), (0.9, -0.2)), GearLimits(), "crank_idler")
    assert not any("profile_shift" in check.message for check in checks)


def test_the_file_takes_what_is_named(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "pair.yaml"
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [12, 40]\ncenter_distance: 106.5\nshift_split: 0.9\n")
    ended = gearlink("gear", path, "--format", "json")
    assert ended.status == 1
    found = SHIFTS.search(next(c["message"] for c in ended.json["checks"] if c["status"] == "fail"))
    assert found
    repaired = f"profile_shift=[{found[1]}, {found[2]}]"
    assert gearlink("gear", path, "--set", repaired, "--set", "shift_split=equal", "--strict").status == 0
