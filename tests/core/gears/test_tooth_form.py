"""Teeth that no tool can cut, flanks that slide much, and internal meshes that do not go together.

Tolerances: none; each side of a limit. The limits stand in closed form beside the designs.
"""

from __future__ import annotations

import math
from typing import Any

import pytest
from factory import design

from gearlink.core.base.spec import GearLimits
from gearlink.core.parts.gears.checks import gear_check
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference

ANGLE = math.radians(20.0)
WIDEST = math.pi / (4.0 * math.tan(ANGLE))


def checks(name: str, pair: GearPair, limits: GearLimits | None = None) -> list[Any]:
    return list(gear_check(name, pair, limits or GearLimits(), shifts=True))


@pytest.mark.parametrize(("beyond", "status"), [(-1e-9, "pass"), (1e-9, "fail")])
@pytest.mark.parametrize("side", [1.0, -1.0])
def test_shift_beyond_any_tool(beyond: float, status: str, side: float) -> None:
    """Many teeth, so that tip and root are whole: only the tooth or its space vanishes on the reference circle."""
    shift = side * (WIDEST + beyond)
    pair = GearPair.from_shift(2.0, (9000, 9000), (shift, -shift), addendum=0.1)
    for check in checks("tooth-form", pair):
        assert (check.code, check.status) == ("GL212", status)


def test_tip_inside_the_root() -> None:
    pair = GearPair.from_shift(2.0, (12, 12), (2.0, 2.0), addendum=0.6, clearance=0.1)
    (check, _) = checks("tooth-form", pair)
    assert pair.tip_radius[0] < pair.root_radius[0]
    assert check.status == "fail"
    assert check.value <= pair.tip_radius[0] - pair.root_radius[0] + 1e-12


def test_pointed_below_the_tip() -> None:
    pair = GearPair.from_shift(2.0, (12, 60), (1.2, 0.0))
    assert pair.tip_thickness[0] < 0.0
    assert [check.status for check in checks("tooth-form", pair)] == ["fail", "pass"]


def test_root_that_reaches_the_axis() -> None:
    assert checks("tooth-form", GearPair.from_shift(2.0, (2, 80)))[0].status == "fail"


@pytest.mark.parametrize(("limit", "statuses"), [(None, []), (4.0, ["warn", "pass"]), (5.0, ["pass", "pass"])])
def test_sliding_is_judged_where_the_file_asks(limit: float | None, statuses: list[str]) -> None:
    pair = GearPair.from_shift(2.0, (20, 40))
    sizes = [abs(value) for value in pair.specific_sliding]
    assert sizes[1] < 4.0 < sizes[0] < 5.0
    assert [check.status for check in checks("sliding", pair, GearLimits(sliding=limit))] == statuses


def test_sliding_without_measure_is_never_passed_in_silence() -> None:
    data = {"kind": "gear-pair", "module": 2, "teeth": [17, 91], "profile_shift": [0, 0]}
    found = design(data, command="gear").check("sliding")
    assert [(check.code, check.status) for check in found] == [("GL209", "warn")]
    assert found[0].value > 8.0


# Internal meshes


@pytest.mark.parametrize("pinion", [34, 62, 200])
def test_one_tooth_of_difference_is_a_finding(pinion: int) -> None:
    internal = InternalInterference(GearPair.from_shift(1.0, (pinion, -pinion - 1)))
    assert internal.tip_circles_apart == -1.0
    assert internal.tip_fouling_margin is None
    gears = {"module": 1, "planet": pinion, "ring": pinion + 1}
    links = {"coupler": 1.2, "rocker": 1.5, "frame": 1.6}
    made = design({"kind": "two-gear-four-bar", "gears": gears, "links": links})
    (check,) = made.check("tip-fouling")
    assert (check.code, check.status, check.value) == ("GL206", "fail", -1.0)
    assert "tip_fouling_margin" in made.quantity_names()
    assert made.quantity("tip_fouling_margin") is None
    assert made.report("analyze").quantities


@pytest.mark.parametrize("module", [0.3, 0.7, 1.0, 1.1, 7.0])
@pytest.mark.parametrize("pinion", range(34, 60, 5))
def test_two_teeth_of_difference_touch(module: float, pinion: int) -> None:
    """The tip circles touch: rounding decides on which side, and neither is a crash.

    Where they touch, both crossing angles are half a turn; a margin of rounding opens them by its root, 1e-6 at most.
    """
    mesh = InternalInterference(GearPair.from_shift(module, (pinion, -pinion - 2)))
    assert mesh.tip_circles_apart == pytest.approx(0.0, abs=1e-15 * module * pinion)
    if mesh.tip_circles_apart < 0.0:
        assert mesh.tip_fouling_margin is None
        return
    z_1, z_2, base = pinion, pinion + 2, math.cos(ANGLE)
    inv_1, inv_2, inv = (math.tan(a) - a for a in (math.acos(z_1 * base / z_2), math.acos(z_2 * base / z_1), ANGLE))
    room = z_1 * (inv_1 + math.pi) - z_2 * (inv_2 + math.pi) + 2.0 * inv
    assert mesh.tip_fouling_margin == pytest.approx(module * 0.5 * z_1 * room / z_2, rel=1e-6)
    assert room < 0.0


@pytest.mark.quick(1)
@pytest.mark.parametrize(("ring", "angle", "words"), [(33, 20.0, "at least 34 teeth"), (75, 1e-7, "larger pressure")])
def test_ring_without_an_involute_keeps_the_kinematics(ring: int, angle: float, words: str) -> None:
    gears = {"module": 2, "planet": 23, "ring": ring, "pressure_angle": angle}
    links = {"coupler": 130, "rocker": 135, "frame": 132}
    made = design({"kind": "two-gear-four-bar", "gears": gears, "links": links})
    (check,) = made.check("involute-interference")
    assert (check.status, words in check.fix) == ("fail", True)
    report = made.report("analyze")
    names = [quantity.name for quantity in report.quantities]
    assert "speed_ratio_max" in names
    assert "contact_ratio" not in names


@pytest.mark.parametrize("angle", [1e-300, 1e-12, 1e-7, 8e-7])
def test_no_pressure_angle_divides_by_nothing(angle: float) -> None:
    gears = {"module": 1.6, "planet": 25, "ring": 75, "pressure_angle": math.degrees(math.radians(angle))}
    links = {"coupler": 130, "rocker": 135, "frame": 132}
    made = design({"kind": "two-gear-four-bar", "gears": gears, "links": links})
    (check,) = made.check("involute-interference")
    assert (check.status, "use a larger pressure angle" in check.fix) == ("fail", True)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"teeth": [3, -63], "profile_shift": [-0.685, 0.37]}, "increase its profile shift or use more teeth"),
        ({"teeth": [12, 60], "profile_shift": [1.2, 0]}, "reduce its profile shift or its addendum"),
        (
            {"teeth": [12, 12], "profile_shift": [2, 2], "addendum": 0.3, "clearance": 0.1},
            "reduce the sum of the profile shifts",
        ),
        ({"teeth": [900, 900], "profile_shift": [-2.2, 2.2], "addendum": 0.1}, "nearer to 0"),
    ],
)
def test_what_is_wrong_with_a_tooth_decides_what_mends_it(keys: dict[str, Any], words: str) -> None:
    """Bringing a shift of -0.7 below 1.36 would not give a root circle back."""
    angle = {} if "addendum" in keys or keys["teeth"][1] == 60 else {"pressure_angle": 30, "addendum": 0.8}
    made = design({"kind": "gear-pair", "module": 2} | angle | {"clearance": 0.4} | keys)
    assert words in made.check("tooth-form")[0].fix


def test_a_root_circle_that_is_none_is_shown_negative_in_a_ring_too() -> None:
    keys = {"kind": "gear-pair", "module": 2, "addendum": 0.8, "clearance": 0.4, "profile_shift": [-0.685, 0.37]}
    for second in (63, -63):
        pinion, wheel = design(keys | {"teeth": [3, second]}).quantity("root_radius").value
        assert pinion == pytest.approx(3.0 - 2.0 * (1.2 + 0.685), rel=1e-12)
        assert wheel > 0.0


@pytest.mark.parametrize("name", ["gear_pair", "ring_pair", "rack_drive", "candy_feed"])
def test_each_code_says_what_it_judges(name: str) -> None:
    """GL212 had said nothing but a tip thickness, as if it were GL202: a tool can cut the tooth, whatever is least."""
    made = design(name, command="gear")
    found = [each for check in made.outline("gear").checks for each in made.check(check)]
    formed = [each.message for each in found if each.code == "GL212"]
    assert formed
    assert all("minimum of height, thickness and space width" in message for message in formed)
    said = {(each.code, each.what) for each in found}
    assert len({subject for _, subject in said}) == len(said), "no two codes begin alike"
