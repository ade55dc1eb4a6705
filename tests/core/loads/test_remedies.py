"""Remedies of the checks of `loads`: what is named makes the check pass, and nothing else worse."""

from __future__ import annotations

from typing import Any

import factory
import pytest
from pydantic import ValidationError
from sweeps import mostly_slow

from gearlink.core.base.spec_paths import changed
from gearlink.core.studies.loads.spec import Course

FEED = "loaded_feed"
CASES: list[tuple[str, str, dict[str, Any]]] = [
    ("GL603", FEED, {"loads__motor__max_torque": 1.0}),
    ("GL604", FEED, {"loads__motor": None, "loads__flywheel": {"inertia": 0.05}}),
    ("GL610", FEED, {"loads__vibration__allowed_residual": 0.05}),
    ("GL602", FEED, {"loads__forces": [{"on": "output", "torque": -1.0}]}),
    ("GL603", FEED, {"loads__motor__rated_torque": 1.2}),
    ("GL603", FEED, {"loads__motor__ratio": 10}),
    ("GL604", FEED, {"loads__flywheel": {"inertia": 2.0, "fluctuation": 0.03}}),
    ("GL604", FEED, {"loads__motor": None, "loads__flywheel": {"inertia": 2.0, "fluctuation": 0.03}}),
    ("GL606", FEED, {"loads__bearings__C__dynamic_rating": 900}),
    ("GL607", "loaded_wide_swing", {"loads__material__allowed_pressure": 200}),
    ("GL607", "loaded_gripper", {"loads__material__allowed_pressure": 300}),
    ("GL608", "loaded_gripper", {"spring__torque": 150}),
    ("GL608", "loaded_swing_cycle", {"loads__forces": [{"on": "rocker", "torque": -6.0}]}),
    ("GL610", "loaded_wide_swing", {"loads__vibration__allowed_residual": 0.05}),
    ("GL611", FEED, {"loads__vibration": {"frequency": 26, "damping": 0, "allowed_residual": 2}}),
    ("GL615", FEED, {"loads__friction": {"pins": 0.9, "pin_radius": 60}}),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("code", "base", "keys"), mostly_slow(CASES, 3))
def test_remedy_makes_the_check_pass(code: str, base: str, keys: dict[str, Any]) -> None:
    design = factory.design(base, command="loads", **keys)
    names = [name for name in design.outline("loads").checks for check in design.check(name) if check.code == code]
    failing = [
        check for name in dict.fromkeys(names) for check in design.findings("loads", name) if check.status == "fail"
    ]
    assert failing
    for check in failing:
        assert check.remedy, check.message
        after = type(design)(changed(design.spec, check.remedy))
        assert all(found.status == "pass" for found in after.check(check.name))
        assert not [found for found in after.report("loads", findings_only=True).checks if found.status == "fail"]


@pytest.mark.parametrize(
    ("data", "words"),
    [
        ({"zones": [{"from": 10, "to": 10, "value": 5}]}, "empty"),
        ({"table": [[0, 1], [90, 3], [360, 2]]}, "ends with the value"),
        ({"table": [[0, 1], [90, 3], [80, 2]]}, "ascend"),
        ({"table": [[0, 1], [400, 2]]}, "one revolution"),
    ],
)
def test_courses_that_say_nothing_or_two_things(data: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        Course.model_validate(data)
