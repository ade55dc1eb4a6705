"""A fix that names a value holds when it is applied; one that was not found by trial names none where it might not.

No tolerances: the value is put into the data of the file as it is printed.
"""

from __future__ import annotations

import re
from typing import Any

import factory
import pytest

from gearlink.core.base.report import Check

SWING_SLIDER: dict[str, Any] = {"slider__crank": 300, "cycle_angle": 146, "cam__roller_radius": 9}
WARNED: dict[str, Any] = {"loads__vibration__allowed_residual": 0.1165}
NEAR_SHAFT: dict[str, Any] = {"cam__center_distance": 66.25, "slider__mass": 7.17}
NEARER_MIDDLE: dict[str, Any] = {"swing": 150.77, "slider__crank": 158.36}
"""A smaller roller touches its cam nearer to mid-swing, where the cam bends more."""
TANGENT: dict[str, Any] = {
    "follower__roller_radius": 26.34,
    "profile__base_radius": 15.61,
    "profile__lift": 31.62,
}


def found(base: Any, command: str, name: str, **keys: Any) -> Check:
    """The finding of a check that is worst."""
    checks = factory.design(base, command=command, **keys).findings(command, name)
    return min(checks, key=lambda each: ("fail", "warn", "pass").index(each.status))


@pytest.mark.parametrize(
    ("base", "command", "name", "keys", "key"),
    [
        pytest.param("loaded_wide_swing", "loads", "residual-vibration", WARNED, "speed", marks=pytest.mark.slow),
        pytest.param(
            "wide_swing_slider_cam",
            "swing",
            "shaft-clearance",
            NEAR_SHAFT,
            "cam__center_distance",
            marks=pytest.mark.slow,
        ),
        ("tangent_cam", "cam", "cam-undercut", TANGENT, "follower__roller_radius"),
        ("wide_swing_slider_cam", "cam", "cam-undercut", NEARER_MIDDLE, "cam__roller_radius"),
        ("tangent_cam", "cam", "cam-undercut", TANGENT | {"follower__roller_radius": 21.0}, "follower__roller_radius"),
    ],
)
def test_what_warns_passes_with_the_value_of_its_fix(
    base: str, command: str, name: str, keys: dict[str, Any], key: str
) -> None:
    """They named the speed that leaves all that is allowed, and a roller that moves the pitch curve, or no shaft."""
    check = found(base, command, name, **keys)
    (value,) = re.findall(r"at (?:most|least) (\d+\.?\d*)", str(check.fix))
    assert check.status == "warn"
    assert found(base, command, name, **(keys | {key: float(value)})).status == "pass"


@pytest.mark.slow
def test_an_arm_that_was_tried_in_vain_is_not_named() -> None:
    """They named the arm at which the slider is fastest at mid-swing, with which the roller leaves its cam as well."""
    data = factory.changed(factory.worked("loaded_swing_slider"), **SWING_SLIDER)
    del data["unloader"]["reserve"]
    check = found(data, "loads", "contact-loss")
    assert (check.status, check.remedy) == ("fail", ())
    assert not re.search(r"\d", str(check.fix))


def test_a_ratio_that_gears_make_is_not_set() -> None:
    """The key is refused beside the teeth."""
    teeth = factory.worked("ty460_gears")["cylinder"]["gears"]["teeth"]
    keys = {"bed__stroke": 632.8, "cylinder__gears__teeth": [teeth[0], 66]}
    assert teeth[0] == 68
    check = found("ty460_gears", "press", "register", **keys)
    assert check.fix == "give gear 3 as many teeth as gear 4 (cylinder.gears.teeth)"
    assert found("ty460_gears", "press", "register").status == "pass"
    assert found("ty460", "press", "register", cylinder__gear_ratio=1.01).fix == "set cylinder.gear_ratio to 1"


def test_a_roller_that_moves_the_end_of_its_profile_is_not_named() -> None:
    """Outside of the transition zone the minimum curvature radius is another one with each roller."""
    keys = {"swing": 171.9, "drive__rocker": 136.6, "shaft__natural_frequency": 64.04}
    check = found("wide_swing_slider_drive", "swing", "cam-undercut", **keys)
    assert (check.status, check.fix) == ("warn", "use a smaller roller")


@pytest.mark.slow
@pytest.mark.parametrize(("rated", "ratio"), [(1300, True), (1100, True), (585.5, False)])
def test_a_motor_of_much_slip_is_given_the_ratio_of_its_speed_under_load(rated: float, ratio: bool) -> None:
    """The ratio was that of the speed without the slip that it changes: a motor of 585.5 1/min ran slower with it."""
    keys = {"loads__motor__rated_speed": rated, "loads__motor__ratio": 14}
    check = found("loaded_six_bar", "loads", "motor-speed", **keys)
    assert check.status == "fail"
    values = re.findall(r"loads.motor.ratio (?:near|to) (\d+\.?\d*)", str(check.fix))
    assert bool(values) is ratio
    for value in values:
        keys["loads__motor__ratio"] = float(value)
        assert found("loaded_six_bar", "loads", "motor-speed", **keys).status == "pass"
