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
        ({"table": [[0, 1], [90, 3], [360, 2]]}, "must end with its first value"),
        ({"table": [[0, 1], [90, 3], [80, 2]]}, "ascend"),
        ({"table": [[0, 1], [400, 2]]}, "one revolution"),
    ],
)
def test_courses_that_say_nothing_or_two_things(data: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        Course.model_validate(data)


LESS = ("loads.roller.inertia", "loads.roller.bearing_moment")
SKIDS: list[tuple[str, dict[str, Any], str]] = [
    ("loaded_cam", {"spring__preload": 1, "loads__roller": {"width": 20, "inertia": 0.001}}, "spring.preload"),
    ("loaded_cam", {"loads__roller": {"width": 20, "bearing_moment": 3.0}}, "loads.roller.bearing_moment"),
    ("loaded_gripper", {"loads__roller__inertia": 0.012}, "loads.roller.inertia"),
    ("loaded_press", {"loads__roller__preload": 0.0, "loads__roller__inertia": 0.001}, "loads.roller.preload"),
]


@pytest.mark.quick(2)
@pytest.mark.parametrize(("base", "keys", "key"), SKIDS)
def test_a_roller_that_skids_is_driven_with_what_its_fix_names(base: str, keys: dict[str, Any], key: str) -> None:
    """And with a third less of it, or more where less is needed, it still skids."""
    design = factory.design(base, command="loads", **keys)
    warned = [check for check in design.findings("loads", "roller-skid") if check.status == "warn"]
    assert warned
    for check in warned:
        ((named, value),) = check.remedy
        assert named == key
        assert check.fix == f"set {key} to {value:g}"
        for share, status in ((1.0, "pass"), (1.3 if key in LESS else 0.7, "warn")):
            after = type(design)(changed(design.spec, ((key, share * value),)))
            assert status in {found.status for found in after.check("roller-skid")}
            assert (status == "pass") == all(found.status == "pass" for found in after.check("roller-skid"))
