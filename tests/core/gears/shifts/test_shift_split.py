"""Shares of the shift sum, pressures and root stress along the path, the table of a drawing.

Tolerances: reference cases at their own; equalities of a bracketed root at 1e-11 relative, a few ulp times the slopes.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import pytest
from factory import design
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.along_path import AlongPath
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.shifts.candidates import strength_of
from gearlink.core.parts.gears.shifts.shift_split import Diagonal

CASES = json.loads((Path(__file__).parents[3] / "reference" / "gears.json").read_text())["cases"]
SHARES = [case for case in CASES if case["name"].startswith("equal-")]
HOB = {"addendum": 1.25, "rounding": 0.25}


def spec(teeth: Any, shift: list[float], **keys: Any) -> dict[str, Any]:
    return {"kind": "gear-pair", "module": 1, "teeth": teeth, "profile_shift": shift, **keys}


@pytest.mark.quick(2)
@pytest.mark.parametrize("case", SHARES, ids=lambda case: case["name"])
def test_shares_in_forty_digits(case: dict[str, Any]) -> None:
    known = case["input"]
    keys = {"tool": known["tool"]} if "tool" in known else {}
    if "tip_shortening" in known:
        keys["tip_shortening"] = "full" if known["tip_shortening"] else "none"
    data = design(spec(known["teeth"], [known["shift_sum"], 0.0], **keys)).data
    diagonal = Diagonal(data.pair)
    name = "sliding" if "sliding" in case["name"] else "root"
    found = diagonal.split(name, strength_of(data)).first
    wanted = case["expected"]["profile_shift_1"]
    assert found == pytest.approx(wanted["value"], abs=wanted["tolerance"])
    if "zeta_root" in case["expected"]:
        zeta = case["expected"]["zeta_root"]
        assert diagonal.at(found).specific_sliding == pytest.approx(zeta["value"], abs=zeta["tolerance"])


@examples(60)
@given(
    z1=st.integers(17, 40),
    more=st.integers(0, 60),
    total=st.floats(0.0, 1.0),
    beta=st.sampled_from([0.0, 12.0, 25.0]),
    ring=st.booleans(),
)
def test_equal_sliding_is_the_zero_of_a_rising_difference(
    z1: int, more: int, total: float, beta: float, ring: bool
) -> None:
    z2 = -(z1 + 35 + more) if ring else z1 + more
    total = 0.0 if ring else total
    pair = GearPair(module=1.0, teeth=(z1, z2), helix_angle=math.radians(beta), given_shift=(total / 2, total / 2))
    diagonal = Diagonal(pair)
    try:
        first = diagonal.equal_sliding().first
    except NoSolution:
        low, high = diagonal.domain
        grid = [low + (high - low) * k / 20 for k in range(1, 20)]
        signs = {one > other for one, other in (diagonal.at(x).specific_sliding for x in grid if diagonal.at(x).slides)}
        assert len(signs) <= 1
        return
    one, other = diagonal.at(first).specific_sliding
    assert one == pytest.approx(other, rel=1e-10)
    before, after = (diagonal.at(first + off).specific_sliding for off in (-1e-3, 1e-3))
    assert before[0] - before[1] < 0.0 < after[0] - after[1]


@pytest.mark.parametrize("split", ["sliding", "tip", "root", "undercut"])
def test_split_of_a_centre_distance(split: str) -> None:
    keys = {"tool": HOB, "center_distance": 36.0, "shift_split": split}
    pair = design({"kind": "gear-pair", "module": 1, "teeth": [19, 52], **keys})
    first, second = pair.quantity("profile_shift").value
    assert first + second == pytest.approx(pair.quantity("shift_sum").value, rel=1e-14)
    if split == "tip":
        one, other = pair.quantity("tip_thickness").value
        assert one == pytest.approx(other, rel=1e-11)
    if split == "root":
        strength = strength_of(pair.data)(pair.gear_pair)
        assert strength[0] == pytest.approx(strength[1], rel=1e-11)


def test_a_criterion_without_a_share_names_the_key() -> None:
    too_little = {"kind": "gear-pair", "module": 1, "teeth": [9, 10], "center_distance": 9.5, "shift_split": "undercut"}
    with pytest.raises(
        NoSolution, match=r"sum of the profile shifts: -?\d\S* \(limit >= 0\.\d+ for no undercut"
    ) as refusal:
        design(too_little).report("gear")
    assert refusal.value.key == "shift_split"


def test_candidates_stand_side_by_side() -> None:
    table = design(spec([17, 53], [0.3, 0.3], tool=HOB)).table("candidates")
    assert table.data[0] == ["given", "equal", "sliding", "tip", "root", "undercut"]
    assert all(math.isclose(a + b, 0.6, rel_tol=1e-14) for a, b in zip(table.data[1], table.data[2], strict=True))
    for row, (first, second) in enumerate(zip(table["x1"], table["x2"], strict=True)):
        one = design(spec([17, 53], [float(first), float(second)], tool=HOB))
        bent = [each.form_factor * each.stress_correction_factor for each in one.data.root.sections]
        wanted = {
            "sliding": one.raw("specific_sliding"),
            "tip_thickness": one.raw("tip_thickness"),
            "root_factor": bent,
            "undercut_margin": [float(first) - one.raw("min_shift_no_undercut")[0]],
        }
        for name, values in wanted.items():
            for gear, value in enumerate(values, 1):
                assert table[f"{name}_{gear}"][row] == pytest.approx(value, rel=1e-12)


def test_no_candidate_for_equal_roots_has_a_pointed_tooth() -> None:
    ring = {"module": 2, "face_width": 20, "tool": [{"addendum": 1.25, "rounding": 0.25}, None]}
    cutter = {"teeth": 25, "shift": 0.1, "addendum": 1.25, "rounding": 0.25}
    data = design(spec([21, -67], [0.3, -0.3], **ring, cutter=cutter)).data
    diagonal, strength = Diagonal(data.pair), strength_of(data)
    best = diagonal.equal_roots(strength).first
    assert min(diagonal.at(best).tip_thickness) > 0.0
    low = diagonal.without_undercut[0]
    shares = [diagonal.at(low + 0.02 * k) for k in range(80)]
    whole = [max(found) for pair in shares if min(pair.tip_thickness) > 0.0 and (found := strength(pair))]
    assert len(whole) < len(shares)  # the scan reaches pointed teeth
    assert max(strength(diagonal.at(best))) <= min(whole) * (1.0 + 1e-9)


def test_pressures_along_the_path() -> None:
    case = next(case for case in CASES if case["name"].startswith("hertz-along-path"))
    known = case["input"]
    pair = design(
        spec(known["teeth"], known["profile_shift"], face_width=known["face_width"])
        | {"module": known["module"], "load": {"tangential_force": known["F_t"]}}
    )
    along = AlongPath(pair.data)
    found = {place.name: along.pressure(place) for place in along.places() if place.name}
    for name, wanted in case["expected"].items():
        assert found[name.removeprefix("pressure_")] == pytest.approx(wanted["value"], abs=wanted["tolerance"]), name


@pytest.mark.parametrize("teeth", [[22, 47], [21, -67]])
def test_method_b_takes_the_worst_place_of_the_path(teeth: list[int]) -> None:
    load = {"face_width": 40, "load": {"tangential_force": 8000}, "tool": HOB}
    pair = design(spec(teeth, [0.3, 0.1 if teeth[1] > 0 else -0.3], **load))
    along = AlongPath(pair.data)
    for gear, nominal in enumerate(pair.quantity("nominal_root_stress").value):
        stresses = [along.root_stress(place, gear) for place in along.places()]
        greatest = max(each for each in stresses if each is not None)  # none where contact lies below the section
        assert greatest == pytest.approx(nominal, rel=1e-12)


def test_pressure_at_the_pitch_point_is_that_of_the_zone_factor() -> None:
    load = {"face_width": 40, "load": {"tangential_force": 8000}, "helix_angle": 13}
    pair = design(spec([22, 47], [0.3, 0.1], **load))
    along, flank = AlongPath(pair.data), pair.data.flank
    at_pitch = next(along.pressure(place) for place in along.places() if place.name == "C")
    u = pair.gear_pair.gear_ratio
    line = 8000.0 / (2.0 * pair.gear_pair.reference_radius[0] * 40.0) * (u + 1.0) / u
    assert at_pitch == pytest.approx(flank.zone_factor * flank.elasticity_factor * math.sqrt(line), rel=1e-13)


def test_the_drawing_names_what_a_workshop_needs() -> None:
    keys = {"allowances": {"series": "25cd"}, "center_distance_allowance": "js7", "face_width": 20}
    table = design(spec([24, 55], [0.2, 0.1], **keys)).table("drawing")
    rows = {row[0]: row[2:4] for row in table.rows()}
    assert rows["number of teeth"] == [24, 55]
    assert rows["span measurement, maximum"][0] > rows["span measurement, minimum"][0]
    assert rows["theoretical backlash, minimum"][0] > 0.0
