"""Limits and inputs that allow more than physics does are told of, and remedies name the keys of the file."""

from __future__ import annotations

from typing import Any

import factory
import pytest
from pydantic import ValidationError


def found(design: Any, name: str) -> list[tuple[str, str]]:
    return [(check.status, "; ".join(check.lines)) for check in design.check(name)]


def test_a_zone_that_only_its_limit_allows_warns() -> None:
    changes = {"limits": {"transition_zone": 0.49}, "cam__roller_radius": 40}
    ((status, message),) = found(factory.design("wide_swing_twin_cam", **changes), "transition-zone")
    assert status == "warn"
    assert "the balancing device alone guides the rocker" in message
    small = factory.design("wide_swing_twin_cam", limits={"transition_zone": 0.49})
    assert [status for status, _ in found(small, "transition-zone")] == ["pass"]


@pytest.mark.parametrize(("ratio", "allowed"), [(1.99, True), (2.0, False), (50, False), (1.0, False)])
def test_a_cylinder_does_not_extend_to_twice_its_length(ratio: float, allowed: bool) -> None:
    if allowed:
        factory.design("wide_swing_twin_cam", unloader__extension_ratio=ratio)
    else:
        with pytest.raises(ValidationError, match="extension_ratio"):
            factory.design("wide_swing_twin_cam", unloader__extension_ratio=ratio)


SPRING = {"type": "spring", "pivot_ratio": 1.4, "arm": 120, "stretch_ratio": 0.3}


def test_a_spring_stretched_beyond_steel_warns() -> None:
    """Of what steel bears, 2, the pivots must be 1.73 arms apart; a capacity of 80 had asked for 1.28."""
    made = [factory.design("wide_swing_twin_cam", unloader=SPRING | {"stretch_capacity": c}) for c in (80.0, 2.0)]
    (one, warning), (failing,) = (found(each, "unloader-turnability") for each in made)
    assert (one[0], warning[0], failing[0]) == ("pass", "warn", "fail")
    assert "a smaller unloader.stretch_capacity" in warning[1]
    least = made[0].motion.least_ratio_of_steel
    roomy = factory.design(
        "wide_swing_twin_cam", unloader=SPRING | {"stretch_capacity": 80.0, "pivot_ratio": 1.001 * least}
    )
    assert [status for status, _ in found(roomy, "unloader-turnability")] == ["pass"]


@pytest.mark.parametrize(
    ("cycle", "key"),
    [
        (
            {"cycle": {"working": 300, "far_dwell": 10, "return": 40, "near_dwell": 10}, "cycle_angle": None},
            "cycle.working",
        ),
        ({"cycle_angle": 300}, "the cycle angle"),
    ],
)
def test_a_stroke_that_is_too_slow_names_the_key_of_the_file(cycle: dict[str, Any], key: str) -> None:
    ((status, message),) = found(factory.design("wide_swing_twin_rocker", **cycle), "profile-exists")
    assert status == "fail"
    assert f"reduce {key} " in message


@pytest.mark.slow
def test_a_roller_too_large_for_shaft_and_profile_has_one_remedy() -> None:
    design = factory.design("wide_swing_twin_cam", cam__roller_radius=300, command="swing")
    report = design.report("swing")
    remedies = {check.name: check.remedy for check in report.checks if check.status == "fail"}
    assert set(remedies) == {"cam-undercut", "transition-zone", "shaft-clearance"}
    assert set(remedies.values()) == {(("cam.roller_radius", 10.6),)}
