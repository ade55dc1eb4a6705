"""Remedies of a gear pair, put into the design as they are given. No tolerances: whole teeth and hundredths of x."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import Any

import pytest
from factory import design

from gearlink.core.base.report import Check
from gearlink.core.base.spec import GearLimits
from gearlink.core.base.spec_paths import changed
from gearlink.core.parts.gears.checks import gear_check
from gearlink.core.parts.gears.mesh.contact import PathOfContact
from gearlink.core.parts.gears.mesh.pair import GearPair

SHIFTED = {"kind": "gear-pair", "module": 4, "teeth": [12, 40], "profile_shift": [0.9, -0.2]}


def failing(*statuses: str, **keys: Any) -> list[Check]:
    made = design(SHIFTED, command="gear", **keys)
    return [check for check in made.report("gear").checks if check.status in (statuses or ("fail",))]


def test_a_pointed_tip_gives_its_mate_what_it_has_too_much_of() -> None:
    (check,) = failing()
    assert check.name == "tip-thickness"
    assert [key for key, _ in check.remedy] == ["profile_shift[0]", "profile_shift[1]"]
    (_, first), (_, second) = check.remedy
    assert first == round(first, 2)
    assert first + second == pytest.approx(0.7, abs=1e-15)
    assert failing("fail", "warn", profile_shift=[first, second]) == []
    assert failing("fail", "warn", profile_shift=[first + 0.01, second - 0.01]) != []
    assert check.fix == "set profile_shift[0] to 0.47 and profile_shift[1] to 0.23"


@pytest.mark.slow
def test_interference_is_repaired() -> None:
    for teeth in ([12, 80], [14, 60], [10, 24]):
        for check in failing(teeth=teeth, profile_shift=[0, 0]):
            if check.name != "involute-interference":
                continue
            changes = dict(check.remedy)
            shifts = [changes.get(f"profile_shift[{gear}]", 0) for gear in (0, 1)]
            taken = [changes.get(f"teeth[{gear}]", teeth[gear]) for gear in (0, 1)]
            assert changes
            again = failing(teeth=taken, profile_shift=shifts)
            assert all(other.name != "involute-interference" for other in again)


def test_a_design_without_the_key_hears_nothing_of_shifts() -> None:
    for name in ("undercut", "tip-thickness", "contact-ratio", "involute-interference", "tooth-form", "sliding"):
        for pair in (GearPair.from_shift(4.0, (12, 40), (0.9, -0.2)), GearPair.from_shift(2.0, (6, 80))):
            assert not any("shift" in (check.fix or "") for check in gear_check(name, pair, GearLimits()))


def test_the_file_takes_what_is_named(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "pair.yaml"
    path.write_text("kind: gear-pair\nmodule: 4\nteeth: [12, 40]\ncenter_distance: 106.5\nshift_split: 0.9\n")
    ended = gearlink("gear", path, "--format", "json")
    assert ended.status == 1
    (remedy,) = (check["remedy"] for check in ended.json["checks"] if check["status"] == "fail")
    assert [change["key"] for change in remedy] == ["shift_split"]
    overrides = [f"--set={change['key']}={change['value']}" for change in remedy]
    assert gearlink("gear", path, *overrides).status == 0


LOADED = {
    "kind": "gear-pair",
    "module": 3,
    "teeth": [21, 67],
    "profile_shift": [0.3, -0.1],
    "face_width": 20,
    "allowances": {"upper": [0.02, 0.01], "lower": [-0.03, -0.03]},
    "load": {"torque": 300},
    "material": {"contact_limit": 1100, "bending_limit": 250},
}
INSIDE = {key: value for key, value in LOADED.items() if key not in ("kind", "module", "teeth")} | {
    "profile_shift": [0.3, 0.3],
    "load": {"torque": 2000},
}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("data", "keys"),
    [
        (LOADED, {}),
        (LOADED, {"face_width": [20, 22]}),
        (LOADED, {"allowances": None, "center_distance": 132.5}),
        (LOADED, {"teeth": [21, -67]}),
        ("ty460", {f"input_gears__{key}": value for key, value in INSIDE.items()}),
    ],
)
def test_width_and_thickness_repair_strength_and_backlash(data: Any, keys: Any) -> None:
    found = [
        check
        for check in design(data, command="gear", **keys).report("gear").checks
        if check.status == "fail" and check.name in ("backlash", "pitting", "bending")
    ]
    assert {check.name for check in found} >= {"bending"}
    for check in found:
        assert check.remedy, check.message
        made = design(data, command="gear", **keys)
        again = type(made)(changed(made.spec, check.remedy)).check(check.name)
        gear = [other for other in again if other.message.split()[:5] == check.fix.split()[:5]]
        assert all(other.status != "fail" for other in gear), check.message


def statuses_of(made: Any) -> dict[str, str]:
    """Of the last finding of each check, with no remedy sought."""
    return {check.name: check.status for name in made.outline("gear").checks for check in made.check(name)}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("keys", "path"),
    [
        ({"teeth": [11, 30], "profile_shift": None, "center_distance": 82.0}, ["shift_split"]),
        ({"teeth": [12, 40], "profile_shift": [0.0, 0.4]}, ["profile_shift[0]", "profile_shift[1]"]),
    ],
)
def test_a_shift_moves_into_the_contour_rounded_to_the_safe_side(keys: Any, path: list[str]) -> None:
    before = statuses_of(design(SHIFTED, command="gear", **keys))
    (check, *_) = failing(**keys)
    assert check.name == "undercut"
    assert [key for key, _ in check.remedy] == path
    first = check.remedy[0][1]
    made = design(SHIFTED, command="gear", **keys)
    least = made.gear_pair.min_shift_no_undercut[0]
    assert least <= first < least + 0.01
    assert first == round(first, 2)
    again = type(made)(changed(made.spec, check.remedy))
    after = statuses_of(again)
    rank = {"pass": 0, "warn": 1, "fail": 2}
    assert after["undercut"] == "pass"
    assert all(rank[after[name]] <= rank[before[name]] for name in before)


def test_an_uneven_load_is_mended_by_crowning_and_no_width_is_more_than_doubled() -> None:
    rating = {
        "life": 15000,
        "material": ["18CrNiMo7-6", "42CrMo4"],
        "grade": 7,
        "lubricant": {"vg": 150},
        "spectrum": [{"torque": 1.2, "share": 0.1}, {"torque": 0.7, "share": 0.9}],
        "face": {"shaft": {"position": "b", "span": 120, "offset": 20, "diameter": 45}},
    }
    given = {"kind": "gear-pair", "module": 3, "helix_angle": 12, "teeth": [23, 61], "profile_shift": [0.25, 0.1]}
    given |= {"face_width": 32, "rating": rating}
    fixes = {}
    for power in (5.0, 12.0):
        checks = design(given | {"load": {"power": power, "speed": 1450}}, command="gear").report("gear").checks
        fixes[power] = [each.remedy for each in checks if each.code == "GL210" and each.status == "fail"]
    assert fixes[5.0] == [(("rating.face.modification", "crowning"),)]
    assert fixes[12.0] == [(("module", 5.0),)]


@pytest.mark.parametrize(
    ("teeth", "width"), [([25, -80], {"center_distance": 110.32}), ([20, -60], {}), ([18, -90], {})]
)
def test_tips_of_a_standard_ring_clear_the_fillet_and_keep_ratio_and_tool(teeth: list[int], width: Any) -> None:
    """Both findings name it; it was other teeth, or a tool of 26 deg."""
    keys = {"teeth": teeth, "profile_shift": None if width else [0, 0], **width}
    checks = failing(**keys)
    assert {check.name for check in checks} <= {"involute-interference", "fillet-interference"}
    (remedy,) = {check.remedy for check in checks}
    ((key, tips),) = remedy
    assert (key, tips[0]) == ("tip_shortening", 0.0)
    assert checks[0].fix == f"set tip_shortening to [0, {tips[1]:g}]"
    assert failing(**keys, tip_shortening=list(tips)) == []
    assert failing(**keys, tip_shortening=[0.0, tips[1] / 2.0]) != []


@pytest.mark.parametrize("teeth", [(20, -60), (18, -90), (200, 14), (14, 200)])
def test_shortened_tips_begin_contact_where_the_flank_of_the_mate_ends(teeth: tuple[int, int]) -> None:
    """The other way round: the pair with these tips, whose contact reaches the form circle. A few ulp of the radii,
    divided by the small radius of curvature there: 1e-12."""
    pair = GearPair.from_shift(2.0, teeth)
    path = PathOfContact(pair)
    tips = [path.shortened(gear) for gear in (0, 1)]
    assert any(k is not None for k in tips)
    for gear, k in enumerate(tips):
        if k is None:
            form, used = pair.form_radius[1 - gear], path.used_root_radius[1 - gear]
            assert form is None or used >= form
            continue
        both = tuple(k if each == gear else own for each, own in enumerate(pair.tip_alteration))
        found = PathOfContact(replace(pair, tip=both)).used_root_radius[1 - gear]  # type: ignore[arg-type]
        assert found == pytest.approx(pair.form_radius[1 - gear], rel=1e-12)
