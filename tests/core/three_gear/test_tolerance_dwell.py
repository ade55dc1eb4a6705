"""Dwell within a tolerance.

Tolerances: lengths and ends 1e-11 rad against the reference (the ends are simple roots where the output still moves;
W there is 0.02..0.5, so a few ulp of the output angle become 1e-13); invariances 1e-9, the condition of ends where the
output almost stands.
"""

import json
import math
from pathlib import Path

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sweeps import examples, mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output, tolerance_from_backlash
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.parts.linkages.fourbar.position import FourBar

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "gear_linkage.json").read_text())["cases"]
}
TURN = 2.0 * math.pi
EX3_TRAIN = GearTrain(20, 20, 60)
EX3 = FourBar(18.0, 50.0, 100.0, 121.4)
EX1 = FourBar(1.0, 2.882356931651141, 2.882356931651141, 3.951703805053557)
EX1_TRAIN = GearTrain(40, 72, 40)
DRAG = FourBar(50.47, 35.785689262214326, 40.265643369620086, 20.88)
DRAG_TRAIN = GearTrain(23.441236459944996, 12.003476037635881, 27.87850422292809)


def spread(linkage, train, start, length, steps=1000):
    values = [Output(linkage, train).angle(start + length * i / steps) for i in range(steps + 1)]
    return min(values), max(values)


def longest_on_a_grid(linkage, train, tolerance, steps=360):
    """Second method: a window that slides over a grid of two revolutions; short by up to two steps."""
    values = [Output(linkage, train).angle(TURN * i / steps) for i in range(2 * steps)]
    best = 0
    for i in range(steps):
        low = high = values[i]
        for j in range(i, 2 * steps):
            low, high = min(low, values[j]), max(high, values[j])
            if high - low > 2.0 * tolerance:
                break
            best = max(best, j - i)
    return TURN * best / steps


@pytest.mark.parametrize("case", ["tol_ex1_half_backoff", "tol_ex3_exact_0.05deg", "tol_ex3_d121.4_1deg"])
def test_published_dwells(case):
    inputs, out = CASES[case]["inputs"], CASES[case]["outputs"]
    linkage = FourBar(inputs["a"], inputs["b"], inputs["c"], inputs["d"])
    train = EX1_TRAIN if "ex1" in case else EX3_TRAIN
    found = Output(linkage, train).within(math.radians(inputs["tol_deg"]))
    # at half the back-step the limit itself turns on the last digit of the tolerance: sqrt of it moves the ends
    slack = 1e-7 if "half" in case else 1e-11
    assert math.degrees(found.start) == pytest.approx(out["start_deg"], abs=slack)
    assert math.degrees(found.crank_angle) == pytest.approx(out["dwell_deg"], abs=slack)


def test_published_creep_over_45_deg():
    """The 45 deg of thesis 4.2.3: the tolerance of the best such window gives it back."""
    out = CASES["ex3_45deg_claim"]["outputs"]
    linkage = FourBar(18.0, 50.0, 100.0, CASES["ex3_exact_d"]["outputs"]["d"])
    tolerance = math.radians(out["tol_pm_deg"])
    found = Output(linkage, EX3_TRAIN).within(tolerance)
    assert math.degrees(found.crank_angle) == pytest.approx(45.0, abs=1e-11)
    assert math.degrees(found.start) == pytest.approx(out["start_deg"], abs=1e-11)
    assert tolerance_from_backlash(out["total_mm_at_r5"], 75.0) == pytest.approx(tolerance, rel=1e-15)


@pytest.mark.quick(2)
@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize(
    ("linkage", "train"),
    [(EX1, EX1_TRAIN), (EX3, EX3_TRAIN), (FourBar(16.0, 50.0, 100.0, 115.0), EX3_TRAIN), (DRAG, DRAG_TRAIN)],
)
@pytest.mark.parametrize("degrees", mostly_slow([0.01, 3.0, 30.0, 0.3, 0.7, 9.0, 11.0, 59.0], 3))
def test_is_the_longest_interval(linkage, train, degrees, assembly):
    linkage = FourBar(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, assembly)
    tolerance = math.radians(degrees)
    found = Output(linkage, train).within(tolerance)
    assert 0.0 <= found.start < TURN
    low, high = spread(linkage, train, found.start, found.crank_angle)
    assert high - low <= 2.0 * tolerance * (1.0 + 1e-9)
    assert high - low >= 2.0 * tolerance * (1.0 - 1e-5)
    assert 0.5 * (low + high) == pytest.approx(found.output_angle, abs=1e-5 * tolerance)
    on_grid = longest_on_a_grid(linkage, train, tolerance)
    assert on_grid <= found.crank_angle + 1e-9
    assert found.crank_angle - on_grid < 2.001 * TURN / 360


@examples(40)
@given(st.floats(0.3, 0.95), st.floats(1.05, 6.0), st.floats(0.02, 0.95), st.booleans())
def test_mirrored_linkage_dwells_as_long(crank, frame, share, mirror):
    linkage = FourBar(25.0 * crank, 50.0, 100.0, 55.0 + 15.0 * frame)
    assume(linkage.kind() == "crank-rocker")
    tolerance = share * math.pi * EX3_TRAIN.ratio
    found = Output(linkage, EX3_TRAIN).within(tolerance)
    scale = -1 if mirror else 1
    other = Output(FourBar(7.0 * linkage.crank, 350.0, 700.0, 7.0 * linkage.frame, scale), EX3_TRAIN).within(tolerance)
    assert other.crank_angle == pytest.approx(found.crank_angle, abs=1e-9)
    expected = (-found.start - found.crank_angle) % TURN if mirror else found.start
    assert math.remainder(other.start - expected, TURN) == pytest.approx(0.0, abs=1e-8)


def test_ends_stand_at_equal_speed():
    found = Output(EX3, EX3_TRAIN).within(math.radians(2.0))
    at_start = Output(EX3, EX3_TRAIN).speed(found.start)
    assert at_start > 0.0
    assert Output(EX3, EX3_TRAIN).speed(found.start + found.crank_angle) == pytest.approx(at_start, abs=1e-13)


def test_narrow_tolerance_takes_one_standstill_only():
    step = Output(EX3, EX3_TRAIN).back_step
    found = Output(EX3, EX3_TRAIN).within(0.1 * step.angle)
    inside = [(phi - found.start) % TURN < found.crank_angle for phi in Output(EX3, EX3_TRAIN).places]
    assert sum(inside) == 1


def test_half_the_back_step_lasts_longer_than_the_dwell_angle():
    step = Output(EX3, EX3_TRAIN).back_step
    found = Output(EX3, EX3_TRAIN).within(0.5 * step.angle * (1.0 + 1e-12))
    assert found.crank_angle == pytest.approx(2.0 * step.crank_angle, rel=0.02)
    assert found.crank_angle > 1.3 * Output(EX3, EX3_TRAIN).dwell_angle


@pytest.mark.parametrize("tolerance", [0.0, -1.0, math.nan, math.radians(60.0)])
def test_refuses_a_tolerance_that_holds_nothing_or_the_whole_turn(tolerance):
    with pytest.raises(NoSolution, match="above 0, below 60"):
        Output(EX3, EX3_TRAIN).within(tolerance)


def test_refuses_a_backlash_that_is_none():
    with pytest.raises(NoSolution, match="must be positive"):
        tolerance_from_backlash(0.0, 75.0)
