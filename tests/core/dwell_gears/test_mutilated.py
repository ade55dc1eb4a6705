"""The mutilated gear and the four-bar that it turns.

Tolerances: the ratios are single divisions, exact or 2 ulp; angles 1e-13 relative (a few operations). Rocker angles are
compared with `fourbar.solve` at the same crank angle, so only the table's own rounding shows.
"""

import json
import math
from fractions import Fraction
from functools import partial
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGear, driven, teeth_for_times
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}
TURN = 2.0 * math.pi
LINKS = {"crank": 40.0, "coupler": 120.0, "rocker": 100.0, "frame": 140.0}


GEARS = {"module": 3.0, "full_teeth": 80, "group_teeth": 20, "driven": 20}
design = partial(factory.design, {"kind": "mutilated-gear-dwell", "reduction": 6.0, "gears": GEARS})


def test_reference_case():
    given_, out = CASES["mutilated_k6"]["inputs"], CASES["mutilated_k6"]["outputs"]
    gear = MutilatedGear(given_["i_red"], given_["Z_M"], given_["n"], given_["groups"], given_["Z_F"])
    found = {
        "input_turns_per_cycle": gear.cycle_turns,
        "driven_turn_per_group": gear.driven_turn,
        "motion_fraction": gear.motion_share,
        "dwell_fraction": gear.dwell_share,
        "dwell_input_turns": gear.dwell_turns,
        "motion_input_turns": gear.motion_turns,
        "ratio_during_motion": gear.speed_ratio,
    }
    assert found == pytest.approx(out, rel=4e-16, abs=0.0)


@examples(150)
@given(st.integers(10, 200), st.integers(1, 60), st.integers(1, 5), st.integers(8, 80), st.fractions(1, 30))
def test_against_fractions(full, group, groups, driven, reduction):
    if group * groups >= full:
        return
    stops = driven // math.gcd(driven, group)
    gear = MutilatedGear(float(reduction), full, group, groups, driven, stops)
    exact = Fraction(float(reduction))
    assert gear.motion_turns == pytest.approx(float(exact * group / full), rel=1e-15, abs=0.0)
    assert gear.dwell_turns == pytest.approx(float(exact / groups - exact * group / full), rel=1e-15, abs=0.0)
    # the driven gear does in the motion what its speed says
    assert gear.speed_ratio * gear.motion_turns == pytest.approx(gear.driven_turn, rel=1e-15, abs=0.0)
    assert gear.cycles_to_repeat * Fraction(group, driven) == int(gear.cycles_to_repeat * Fraction(group, driven))


def test_driven_angle_runs_stands_and_goes_on():
    gear = MutilatedGear(6.0, 80, 10, 2, 20, stops=2)
    assert gear.cycle_turns == 3.0
    assert gear.cycles_to_repeat == 2
    turns, wanted = np.array([0.375, 0.75, 2.9, 3.375, -0.1, 9.0]), np.array([0.25, 0.5, 0.5, 0.75, 0.0, 1.5])
    assert driven(gear, TURN * turns)[0] == pytest.approx(TURN * wanted, rel=1e-13, abs=1e-13)
    assert driven(gear, TURN * np.array([0.0, 0.7, 0.8, 3.1]))[1].tolist() == [True, True, False, True]
    joints = TURN * np.array([0.0, 0.75, 3.0, 3.75])
    assert driven(gear, joints)[1].tolist() == [True, False, True, False]
    assert driven(gear, joints, -1)[1].tolist() == [False, True, False, True]


@pytest.mark.parametrize(
    ("numbers", "words"),
    [
        ((0.0, 80, 20, 1, 20), "reduction"),
        ((6.0, 80, 20, 4, 20), "at most 19 teeth"),
        ((6.0, 80, 15, 1, 20), "15 teeth advance the driven gear"),
        ((6.0, 80, 0, 1, 20), "group teeth"),
    ],
)
def test_refusals(numbers, words):
    with pytest.raises(NoSolution, match=words):
        MutilatedGear(*numbers)


def test_refusal_names_the_section():
    with pytest.raises(NoSolution) as refused:
        _ = design(gears__group_teeth=15).mutilated
    assert refused.value.key == "gears"


def test_rocker_starts_from_rest_at_its_dead_centre():
    made = design(links=LINKS)
    linkage = FourBar(40.0, 120.0, 100.0, 140.0)
    assert abs(made.rocker_start_speed) < 1e-15
    start = made.start_crank_angle
    swing = [solve(linkage, TURN * i / 20000).rocker_angle for i in range(20000)]
    assert made.rocker_swing == pytest.approx(max(swing) - min(swing), rel=1e-7)  # from samples: error h^2/2
    table = made.table("motion", samples=400)
    data = dict(zip(table.columns, table.data, strict=True))
    assert data["rocker_angle"][0] == pytest.approx(data["rocker_angle"][399], rel=1e-13)
    quarter = data["rocker_angle"][50]  # after 0.75 revolutions of the input the driven gear has made half a revolution
    assert math.radians(quarter) == pytest.approx(solve(linkage, start + math.pi).rocker_angle, rel=1e-14)
    assert data["driven_speed_ratio"][:2].tolist() == [made.driven_speed_ratio] * 2
    assert data["driven_speed_ratio"][100] == 0.0
    (shock,) = made.check("start-shock")
    assert shock.status == "warn"
    assert "starts from rest" in shock.note[0]


def test_rocker_that_starts_with_a_jerk_is_named():
    made = design(links=LINKS, start_angle=120.0)
    linkage = FourBar(40.0, 120.0, 100.0, 140.0)
    expected = made.driven_speed_ratio * solve(linkage, math.radians(120.0), 1).rocker_velocity
    assert made.rocker_start_speed == pytest.approx(expected, rel=1e-15)
    assert "step of the speed ratio at start and stop of the driven gear" in made.check("start-shock")[0].message


def test_without_links_there_is_no_rocker():
    made = design()
    names = [q.name for q in made.report("analyze").quantities]
    assert "rocker_swing" not in names
    assert "min_transmission_angle" not in names
    assert made.table("motion").columns == ("input_angle", "driven_angle", "driven_speed_ratio")


def test_linkage_that_does_not_turn_is_refused():
    with pytest.raises(NoSolution) as refused:
        _ = design(links=LINKS | {"crank": 90.0}).start_crank_angle
    assert refused.value.key == "links"


def test_a_motion_that_begins_between_dead_centres_is_named():
    """Two stops: the first motion begins at the dead centre, the second half a revolution of the driven gear on."""
    made = design(links=LINKS, gears__group_teeth=10, gears__stops=2)
    linkage = FourBar(40.0, 120.0, 100.0, 140.0)
    second = made.start_crank_angle + math.pi
    expected = made.driven_speed_ratio * solve(linkage, second, 1).rocker_velocity
    assert abs(expected) > 0.01
    assert made.rocker_start_speed == pytest.approx(expected, rel=1e-14)
    (shock,) = made.check("start-shock")
    assert "step of the speed ratio at start and stop of the driven gear" in shock.message
    assert "from rest" not in shock.note[0]


def test_the_table_runs_until_everything_repeats():
    made = design(links=LINKS, gears__group_teeth=10, gears__stops=2)
    data = dict(zip(made.table("motion").columns, made.table("motion").data, strict=True))
    assert len(data["input_angle"]) == 2 * 360
    assert data["driven_angle"][0] == 0.0
    assert data["driven_angle"][359] == pytest.approx(180.0, rel=1e-14)
    assert data["driven_angle"][719] == pytest.approx(360.0, rel=1e-14)
    assert data["rocker_angle"][719] == pytest.approx(data["rocker_angle"][0], rel=1e-13)


@pytest.mark.parametrize(("group", "status"), [(59, "warn"), (58, "pass"), (30, "pass")])
def test_gap_against_the_contact_ratio(group, status):
    """One missing tooth of 60: teeth two pitches apart, each 1.78 pitches long in contact."""
    made = design(reduction=1, gears__full_teeth=60, gears__group_teeth=group, gears__driven=group)
    (check,) = made.check("gap")
    assert (check.code, check.status) == ("GL316", status)
    assert check.value == pytest.approx(60 - group + 1 - made.mesh.contact_ratio, rel=1e-14)


# Wanted times


def by_search(share: float, turn: float, groups: int, most: int) -> float:
    """The minimum miss of the share over every number of teeth."""
    misses = [
        abs(n * groups / full - share)
        for z in range(17, 121)
        for n in [round(turn * z)]
        if n >= 1 and abs(n - turn * z) < 1e-9 * z
        for full in range(groups, most + 1, groups)
        if n * groups < full
    ]
    return min(misses)


@pytest.mark.parametrize(
    ("share", "turn", "groups"),
    [(2.0 / 7.0, 1.0, 1), (0.31415, 1.0, 1), (0.2, 0.5, 2), (0.61803, 1.5, 1), (0.9, 0.25, 3)],
)
def test_no_teeth_come_nearer_to_the_wanted_share(share: float, turn: float, groups: int) -> None:
    full, group, driven, stops = teeth_for_times(share, turn, groups, None, 200)
    assert abs(group * groups / full - share) == pytest.approx(by_search(share, turn, groups, 200), abs=1e-11)
    assert full % groups == 0
    assert group == turn * driven
    assert group * stops % driven == 0


def test_wanted_times_are_met() -> None:
    made = factory.design("mutilated_gear_times")
    assert made.quantity("motion_time").value == pytest.approx(1200.0, rel=1e-12)
    assert made.quantity("dwell_time").value == pytest.approx(3000.0, rel=1e-12)
    assert [check.status for check in made.check("target")] == ["pass", "pass"]
    same = factory.design("mutilated_gear_times", target={"motion_turns": 1.2, "dwell_turns": 3})
    assert (same.full_teeth, same.reduction) == (made.full_teeth, made.reduction)


def test_few_teeth_miss_the_times_and_say_so() -> None:
    made = factory.design(
        "mutilated_gear_times", target={"motion_turns": 1, "dwell_turns": 2.1}, gears={"module": 3, "driven": 17}
    )
    cycle = made.motion_turns + made.dwell_turns
    assert cycle == pytest.approx(3.1, rel=1e-14)
    near = factory.design(
        "mutilated_gear_times", gears={"module": 3, "driven": 17},
        target={"motion_turns": 1, "dwell_turns": 2.1, "tolerance": 1e-6},
    )  # fmt: skip
    assert "fail" in [check.status for check in near.check("target")]


HALF = {"motion_turns": 1, "dwell_turns": 2, "driven_turn": 0.5}


def test_wanted_times_that_cannot_be_had() -> None:
    with pytest.raises(NoSolution, match="increase most_teeth"):
        factory.design("mutilated_gear_times", target={"motion_turns": 1, "dwell_turns": 500})
    with pytest.raises(NoSolution, match="another driven_turn"):
        factory.design("mutilated_gear_times", gears={"module": 3, "driven": 19}, target=HALF)


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"input_speed": None}, "needs the input's speed"),
        ({"reduction": 6}, "omit it"),
        ({"target": {"motion_turns": 1}}, "give dwell_turns"),
        ({"target": {"motion_turns": 1, "motion_time": 1, "dwell_turns": 1}}, "exclude each other"),
        ({"target": None}, "the key reduction is missing"),
    ],
)
def test_wrong_requests(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        factory.design("mutilated_gear_times", **keys)


@pytest.mark.quick(2)
@pytest.mark.parametrize("reduction", [1e-6, 1e-4, 0.006])
def test_loads_over_too_many_motions_are_refused(reduction: float) -> None:
    """The wheel turns once in so few input turns: the memory would grow with the motions of a period."""
    data = {
        "kind": "mutilated-gear-dwell",
        "reduction": reduction,
        "gears": {"module": 3, "full_teeth": 80, "group_teeth": 10, "driven": 20, "stops": 2},
        "links": LINKS,
        "loads": {"speed": 60, "forces": [{"on": "rocker", "torque": -12}]},
    }
    with pytest.raises(NoSolution, match="the motion repeats only after more than") as refused:
        factory.design(data, command="loads").report("loads")
    assert refused.value.key == "reduction"
