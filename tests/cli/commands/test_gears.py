"""`gearlink gears`: whole teeth by brute force, the window of shifts, and what a wrong line says.

Tolerances: none; teeth are whole, and a shift sum is compared with its own window.
"""

from __future__ import annotations

import math
from typing import Any

import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.shifts import search
from gearlink.core.parts.gears.shifts.search import (
    Carried,
    PairTask,
    candidates,
    carrying,
    least_width,
    pairs_of_teeth,
    teeth_sums,
)


@pytest.mark.parametrize(
    ("internal", "helix", "module"), [(False, 0.0, 3.0), (False, 20.0, 2.5), (True, 0.0, 2.0), (True, 15.0, 1.5)]
)
def test_sums_of_teeth_by_brute_force(internal: bool, helix: float, module: float) -> None:
    window = (-0.4, 0.7)
    task = PairTask(
        ratio=3.0,
        distance=90.0,
        shift_sum=window,
        internal=internal,
        helix_angle=math.radians(helix),
        modules=(module,),
    )
    found = set(teeth_sums(task, module))
    for total in range(20, 130):
        teeth = (20, -20 - total) if internal else (10, total - 10)
        try:
            pair = GearPair(module=module, teeth=teeth, given_distance=90.0, helix_angle=math.radians(helix))
            inside = window[0] <= pair.shift_sum <= window[1]
        except NoSolution:
            inside = False
        assert inside == (total in found), total


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("internal", "ratio", "tolerance"), [(False, 3.2, 0.1), (False, 0.6, 0.02), (True, 5.5, 0.02), (True, 1.3, 0.3)]
)
def test_no_pair_within_the_tolerance_is_left_out(internal: bool, ratio: float, tolerance: float) -> None:
    """All teeth counted: with a wide tolerance many first gears go with one sum."""
    task = PairTask(ratio=ratio, distance=150.0, modules=(1.0,), tolerance=tolerance, internal=internal, least_teeth=12)
    sums = teeth_sums(task, 1.0)
    seconds = {z1: [z1 + one if internal else one - z1 for one in sums] for z1 in range(12, 2001)}
    every = {
        (z1, -z2 if internal else z2)
        for z1, some in seconds.items()
        for z2 in some
        if z2 > 0 and abs(z2 / z1 / ratio - 1.0) <= tolerance
    }
    found = list(pairs_of_teeth(task, 1.0))
    assert len(found) > 3 * len(sums) or tolerance == 0.02
    assert (len(found), set(found)) == (len(every), every)


def test_most_pairs_are_the_nearest_to_the_ratio(monkeypatch: pytest.MonkeyPatch) -> None:
    task = PairTask(ratio=3.2, distance=120.0, modules=(2.0, 3.0), tolerance=0.05)
    every = sorted(abs(one.ratio_error) for one in candidates(task))
    monkeypatch.setattr(search, "MOST_PAIRS", 4)
    assert sorted(abs(one.ratio_error) for one in candidates(task)) == every[:4]


def test_every_candidate_meets_the_task() -> None:
    task = PairTask(ratio=3.2, distance=120.0, modules=(2.0, 2.5, 3.0), tolerance=0.03)
    found = candidates(task)
    assert found
    for each in found:
        assert abs(each.ratio / 3.2 - 1.0) <= 0.03
        assert -0.5 <= each.pair.shift_sum <= 1.0
        assert each.pair.center_distance == 120.0
    assert [each.margin < 0.0 for each in found] == sorted(each.margin < 0.0 for each in found)


def test_pairs_that_carry_are_the_candidates_with_a_width(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of those that carry nothing no margin is computed, which takes most of the time."""
    task, taken = PairTask(ratio=3.0, distance=120.0, modules=(1.0, 3.0, 5.0)), []
    load = Carried(torque=200.0, speed=480.0, life=20000.0, materials=("16MnCr5", "16MnCr5"))
    every = [(each, least_width(each.pair, load)) for each in candidates(task)]
    sought = [(each, *width) for each, width in every if width is not None]
    sought.sort(key=lambda one: (one[0].margin < 0.0, one[1], abs(one[0].ratio_error)))
    margin = search._margin
    monkeypatch.setattr(search, "_margin", lambda data: taken.append(data) or margin(data))
    assert carrying(task, load) == sought
    assert 0 < len(taken) == len(sought) < len(every)


def test_json_of_a_search(gearlink: Any) -> None:
    ended = gearlink("gears", "--ratio", 3.2, "--center-distance", 120, "--modules", "3", "--format", "json")
    assert (ended.status, ended.json["kind"]) == (0, "gear-search")
    columns = ended.json["tables"]["candidates"]["columns"]
    assert columns[:8] == [
        "teeth1", "teeth2", "module", "ratio", "ratio_error", "shift_sum", "contact_ratio", "margin",
    ]  # fmt: skip


def test_a_ring_has_negative_teeth(gearlink: Any) -> None:
    ended = gearlink("gears", "--ratio", 3.2, "--center-distance", 60, "--internal", "--modules", 2, "--format", "json")
    rows = ended.json["tables"]["candidates"]["rows"]
    assert ended.status == 0
    assert all(row[1] < -row[0] for row in rows)


@pytest.mark.slow
def test_pairs_beyond_a_limit_come_last_and_are_said_to_be_alone(gearlink: Any) -> None:
    """Rings want a negative sum of shifts: with full teeth their tips meet the roots of pinions otherwise."""
    task = ("gears", "--ratio", 2.4, "--center-distance", 90, "--internal")
    assert gearlink(*task).err == ""
    ended = gearlink(*task, "--shift-sum", "-0.5:0.5")
    assert (ended.status, ended.err) == (0, "no pair is within all limits (margin < 0): widen --shift-sum\n")


def test_nothing_found_is_a_finding(gearlink: Any) -> None:
    ended = gearlink("gears", "--ratio", 3.2, "--center-distance", 1)
    assert ended.status == 1
    assert ended.out.endswith("\ncandidates: no rows\n")  # no heads of columns in parts, with nothing below
    assert "widen --shift-sum" in ended.err


@pytest.mark.parametrize(
    "wrong",
    [
        ("--shift-sum", "a:b"),
        ("--shift-sum", "1:-1"),
        ("--modules", "2,x"),
        ("--modules", "-1"),
        ("--modules", "nan"),
        ("--internal", "--ratio", "0.5"),
        ("--helix", "60"),
    ],
)
def test_wrong_lines(gearlink: Any, wrong: tuple[str, ...]) -> None:
    ended = gearlink("gears", "--ratio", "3", "--center-distance", "100", *wrong)
    assert ended.status == 2
    assert "Traceback" not in ended.err


def test_a_ratio_beyond_all_pairs_is_told(gearlink: Any) -> None:
    """17 teeth at 500 to 1 are 8517 together; 3 at 500 to 1 are 1503, which a module of 0.16 mm brings to 120 mm."""
    ended = gearlink("gears", "--ratio", "500", "--center-distance", "120")
    assert ended.status == 1
    assert "takes a sum of 8517, but pairs are searched only up to 2000: reduce --least-teeth or --ratio" in ended.err
    words = ("--least-teeth", "3", "--modules", "0.16")
    assert "pairs are searched" not in gearlink("gears", "--ratio", "500", "--center-distance", "120", *words).err
