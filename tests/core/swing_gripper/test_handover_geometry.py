"""The handover: gripper tip and drum.

Tolerances, EPS = 2^-52: gaps 4 EPS of the centre distance - they come from a small square, not from a difference;
slips 4 EPS of the radius, for the turned angle is subtracted; speeds 4 EPS of the surface speed. The places of the
drum: 4 EPS of its distance from the origin. Against mpmath's direct form in 30 digits the same holds.
"""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.gripper import CASES, machine
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.swing_gripper.design import (
    misplacement,
    speed_difference,
    tip_path,
    widest_window,
)

EPS = 2.0**-52


def test_reference_of_gap_slip_and_speed() -> None:
    case = CASES["HAND-01"]
    omega = 200.0 / 60.0 * 2.0 * math.pi
    for degrees in case["inputs"]["dtheta_deg"]:
        turned = np.array([math.radians(degrees)])
        lead = 0.45 * turned
        path = tip_path(300.0, 135.0, 435.0, lead, turned)
        difference = speed_difference(path, lead, np.array([135.0 * omega]), omega, 135.0)
        expected = {key: float(case["expected"][f"{key}({degrees})"]) for key in ("gap", "slip", "dv")}
        assert path.gap[0] == pytest.approx(expected["gap"], rel=0.0, abs=4 * EPS)
        assert path.slip[0] == pytest.approx(expected["slip"], rel=0.0, abs=4 * EPS * 135.0 * turned[0])
        assert difference[0] == pytest.approx(expected["dv"], rel=0.0, abs=4 * EPS * 2830.0)


@given(
    arm=st.floats(50.0, 500.0),
    radius=st.floats(50.0, 500.0),
    off=st.floats(-5.0, 5.0),
    lead=st.floats(-0.5, 0.5),
    lead_0=st.floats(-0.01, 0.01),
)
@examples(80)
def test_path_against_the_direct_form(arm: float, radius: float, off: float, lead: float, lead_0: float) -> None:
    distance = arm + radius + off
    path = tip_path(arm, radius, distance, np.array([lead]), np.array([0.3]), lead_0)
    with mp.workdps(30):
        tip = [distance - arm * mp.expj(mp.mpf(x)) for x in (lead, lead_0)]
        gap = abs(tip[0]) - radius
        slip = radius * (-mp.arg(tip[0]) + mp.arg(tip[1]) - mp.mpf(0.3))
    assert abs(path.gap[0] - gap) <= 4 * EPS * distance
    assert abs(path.slip[0] - slip) <= 16 * EPS * radius


@given(arm=st.floats(50.0, 500.0), radius=st.floats(50.0, 500.0), gap=st.floats(1e-4, 1.0))
@examples(50)
def test_the_widest_window_has_just_the_gap(arm: float, radius: float, gap: float) -> None:
    turn = np.array([widest_window(arm, radius, gap)])
    path = tip_path(arm, radius, arm + radius, turn * radius / arm, turn)
    assert path.gap[0] == pytest.approx(gap, rel=0.0, abs=4 * EPS * (arm + radius))


def test_a_gap_that_no_turn_reaches_is_refused() -> None:
    assert widest_window(300.0, 135.0, 599.999) == pytest.approx(math.pi * 300.0 / 135.0, rel=2e-3)
    with pytest.raises(NoSolution, match="less than 600 mm"):
        widest_window(300.0, 135.0, 600.0)


def test_slip_grows_with_the_third_power() -> None:
    turned = np.array([0.01, 0.02])
    slip = tip_path(300.0, 135.0, 435.0, 0.45 * turned, turned).slip
    # The next term is of the fifth power: 1e-4 of it here.
    assert slip[1] / slip[0] == pytest.approx(8.0, rel=1e-3, abs=0.0)


def test_the_reported_axis_fits() -> None:
    design = machine()
    center = complex(design.handover_center)
    expected = complex(498.0, 55.0) + 435.0 * complex(math.cos(math.radians(99.8)), math.sin(math.radians(99.8)))
    assert abs(center - expected) <= 8 * EPS * 700.0
    placed = machine(cylinder__center=[center.real, center.imag])
    speed, place = placed.check("handover")
    assert (speed.status, place.status) == ("pass", "pass")
    assert place.value <= 1e-12
    report = design.report("gripper", quantities=["handover_center"])
    assert report.quantities[0].value == [center.real, center.imag]


def test_equal_speeds_at_the_handover() -> None:
    design = machine()
    assert design.handover_mismatch == 0.0
    assert design.handover_speed == pytest.approx(float(CASES["SIX-01"]["expected"]["tip_speed_mm_s"]), rel=4 * EPS)


@pytest.mark.parametrize(("turn", "along"), [(0.3, 0.0), (-0.2, 0.0), (0.0, 0.4), (0.1, -0.25)])
def test_a_drum_out_of_place_is_told_what_to_change(turn: float, along: float) -> None:
    center = machine().handover_center
    pivot = complex(498.0, 55.0)
    line = center - pivot
    off = pivot + line * np.exp(1j * math.radians(turn)) * (1.0 + along / abs(line))
    place = machine(cylinder__center=[off.real, off.imag]).check("handover")[1]
    assert place.status == "fail"
    assert place.code == "GL503"
    if turn and not along:
        change = float(place.fix.split("turn arm.direction by ")[1].split()[0])
        assert change == pytest.approx(turn, rel=1e-3, abs=1e-5)
        repaired = machine(cylinder__center=[off.real, off.imag], arm__direction=125.0 + change)
        assert repaired.check("handover")[1].value == pytest.approx(abs(along), rel=0.0, abs=1e-2)
    assert ("set cylinder.center to" in place.fix) == bool(along)


def test_misplacement_keeps_its_parts_apart() -> None:
    off = misplacement(0j, 300.0 + 0j, 435.0 * complex(math.cos(0.001), math.sin(0.001)), 135.0)
    assert off.turn == pytest.approx(0.001, rel=1e-12, abs=0.0)
    assert off.distance == pytest.approx(0.0, abs=1e-12)
    assert off.place == pytest.approx(600.0 * math.sin(0.0005), rel=1e-9, abs=0.0)


def test_window_within_the_gap() -> None:
    passes = machine(release={"window": 1.0, "gap": 0.03}).check("handover")
    assert [check.status for check in passes] == ["pass"] * 3
    assert passes[2].value == pytest.approx(0.02981098524, rel=0.0, abs=1e-11)


@pytest.mark.parametrize("window", [1.01, 3.0, 5.9])
def test_the_window_that_is_recommended_keeps_the_gap(window: float) -> None:
    check = machine(release={"window": window, "gap": 0.03}).check("handover")[2]
    assert check.status == "warn"
    narrower = float(check.fix.split("release.window to at most ")[1].split()[0])
    assert machine(release={"window": narrower, "gap": 0.03}).check("handover")[2].status == "pass"


def test_a_window_beyond_the_constant_speed_warns() -> None:
    check = machine(release={"window": 7.0, "gap": 5.0}).check("handover")[1]
    assert check.status == "warn"
    assert "phases.constant to at least 14 deg" in check.fix
    assert machine(release={"window": 6.0, "gap": 5.0}).check("handover")[1].status == "pass"


def test_a_handover_too_near_the_end_of_the_constant_speed_is_moved() -> None:
    """The phase is long enough: the handover moves, and at both ends of the range the window fits."""
    check = machine(handover=112.0, release={"window": 2.5, "gap": 5.0}).check("handover")[1]
    assert (check.status, check.fix) == ("warn", "set handover from 102.5 to 109.5 deg")
    for place in (102.5, 109.5):
        assert machine(handover=place, release={"window": 2.5, "gap": 5.0}).check("handover")[1].status == "pass"


def test_the_table_is_flat_at_the_handover() -> None:
    table = machine(release={"window": 2.0}).table("handover_window")
    columns = dict(zip(table.columns, table.data, strict=True))
    assert columns["theta"][[0, 20, 40]].tolist() == [104.0, 106.0, 108.0]
    assert [columns[name][20] for name in ("gap", "slip", "speed_difference")] == [0.0, 0.0, 0.0]
    assert np.abs(columns["gap"] - columns["gap"][::-1]).max() <= 1e-12
    assert np.abs(columns["slip"] + columns["slip"][::-1]).max() <= 1e-12


@pytest.mark.parametrize(("off", "limit", "status"), [(0.9, 2.0, "pass"), (1.1, 2.0, "warn"), (1.1, 1.0, "fail")])
def test_no_limit_allows_a_tip_more_than_a_millimetre_off_its_place(off: float, limit: float, status: str) -> None:
    center = complex(machine().handover_center)
    away = center + off * (center - complex(*machine().spec.pivots.output)) / 435.0
    limits = {"handover_place": limit}
    place = machine(cylinder__center=[away.real, away.imag], limits=limits).check("handover")[1]
    assert (place.status, place.value) == (status, pytest.approx(off, rel=1e-9))
    assert place.limit == (1.0 if status == "warn" else limit)
    if status != "pass":
        assert "distance of the gripper tip from the handover point" in place.message
