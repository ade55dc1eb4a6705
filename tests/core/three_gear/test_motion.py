"""Output motion of the three-gear four-bar.

Tolerances: 1e-14 absolute for ratios and angles of order one (a few ulp; the reference has 16 digits and the links are
far from a dead centre); extremes' places 1e-14 rad for the same reason, being simple roots; random linkages 1e-12
times the condition number 1/sin^2(gamma) of the rates.
"""

import json
import math
from pathlib import Path

import mpmath
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap
from gearlink.core.parts.linkages.checks import check_linkage
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "gear_linkage.json").read_text())["cases"]
}
EX3 = FourBar(18.0, 50.0, 100.0, 121.4)
EX3_TRAIN = GearTrain(20, 20, 60)
DRAG = FourBar(120.0, 60.0, 105.0, 30.0)
DRAG_TRAIN = GearTrain(20, 20, 50)


def family(d):
    b = math.sqrt((1.0 + d * d) / 2.0)
    return FourBar(1.0, b, b, d)


positive = st.floats(0.1, 10.0)
angles = st.floats(-7.0, 7.0)


@st.composite
def drives(draw):
    """Crank-rockers and drag links whose coupler and rocker are the centre distances of their gears."""
    z1, z3, z5 = (draw(st.floats(10.0, 100.0)) for _ in range(3))
    b, c = z1 + z3, z3 + z5
    low, high = abs(b - c), b + c
    # |d - a| and d + a within the reach of coupler and rocker, both with 2 % to spare: the crank turns fully
    inner, outer = (low + draw(st.floats(0.02, 0.98)) * (high - low) for _ in range(2))
    inner, outer = sorted((inner, outer))
    assume(outer - inner > 0.01 * high)
    a, d = (outer - inner) / 2.0, (outer + inner) / 2.0
    if draw(st.booleans()):
        a, d = d, a
    return FourBar(a, b, c, d, draw(st.sampled_from((1, -1)))), GearTrain(z1, z3, z5)


def test_published_kinematics_of_example_3():
    for phi, *_angles, _w2, _w3, _e2, _e3, speed, acceleration in CASES["ex3_kinematics"]["outputs"]["rows"]:
        at = math.radians(phi)
        assert Output(EX3, EX3_TRAIN).speed(at) == pytest.approx(speed, abs=1e-14)
        assert Output(EX3, EX3_TRAIN).acceleration(at) == pytest.approx(acceleration, abs=1e-14)


def test_published_extremes_of_example_3():
    out, found = CASES["ex3_source_d"]["outputs"], Output(EX3, EX3_TRAIN)
    assert found.speed_ratio_max == pytest.approx(out["W_max"], abs=1e-14)
    assert found.speed_ratio_min == pytest.approx(out["W_min"], abs=1e-14)
    assert found.speed_ratio_max_at == pytest.approx(math.radians(out["phi_Wmax_deg"]), abs=1e-14)
    assert found.speed_ratio_min_at == pytest.approx(math.radians(out["phi_Wmin_deg"]), abs=1e-14)
    assert Output(EX3, EX3_TRAIN).speed(0.0) == pytest.approx(out["W_at_0"], abs=1e-15)


@pytest.mark.parametrize(("case", "train"), [("ex1", GearTrain(40, 72, 40)), ("ex2", GearTrain(20, 21, 20))])
def test_published_extremes_of_the_symmetric_examples(case, train):
    out = CASES[case]["outputs"]
    linkage = FourBar(out["l1"], out["l1"] * out["b_ratio"], out["l1"] * out["b_ratio"], out["l4"])
    found = Output(linkage, train)
    assert (found.speed_ratio_max, found.speed_ratio_min) == pytest.approx((out["W_max"], out["W_min"]), abs=1e-14)
    assert (found.speed_ratio_max_at, found.speed_ratio_min_at) == pytest.approx(
        (math.pi / 2, 1.5 * math.pi), abs=1e-14
    )
    assert math.degrees(linkage.min_transmission_angle()) == pytest.approx(out["gamma_min_deg"], rel=1e-14)
    assert gear_gap(linkage, train, 2.0) == pytest.approx(out["gap15"], abs=1e-12)
    assert (found.speed_ratio_max - found.speed_ratio_min) / abs(Output(linkage, train).mean_ratio) == pytest.approx(
        out["W_max"] - out["W_min"], abs=1e-14
    )


def test_published_gaps_count_from_the_moving_gear():
    assert gear_gap(EX3, EX3_TRAIN, 2.5) == pytest.approx(CASES["ex3_source_d"]["outputs"]["gap15"], abs=1e-13)
    out = CASES["ex3_e16"]["outputs"]
    assert gear_gap(FourBar(16.0, 50.0, 100.0, out["d"]), EX3_TRAIN, 2.5) == pytest.approx(out["gap15"], abs=1e-13)
    assert gear_gap(DRAG, GearTrain(2, 2, 5), 1.0) == 90.0 - 3.5 - 2.0


def test_published_peak_acceleration():
    case = CASES["I1_peak_accel"]
    found = Output(family(case["inputs"]["d"]), GearTrain(1.0, 1.8, 1.0))
    assert found.acceleration_ratio_max == pytest.approx(case["outputs"]["e5max"], rel=1e-14)
    assert found.acceleration_ratio_min == pytest.approx(-case["outputs"]["e5max"], rel=1e-14)
    assert math.sin(found.acceleration_ratio_max_at) == pytest.approx(0.0, abs=1e-14)


@pytest.mark.slow
@examples(150)
@given(drives(), angles)
def test_speed_agrees_with_the_instant_centre(drive, phi):
    """w5/w1 = AP15/DP15 with P15 where the line of the poles F, E meets the frame (thesis 4.2.1)."""
    linkage, train = drive
    state, a, d = solve(linkage, phi), linkage.crank, linkage.frame
    r1 = linkage.coupler * train.crank / (train.crank + train.idler)
    r5 = linkage.rocker * train.output / (train.idler + train.output)
    t2, t3 = state.coupler_angle, state.rocker_angle
    fx, fy = a * math.cos(phi) + r1 * math.cos(t2), a * math.sin(phi) + r1 * math.sin(t2)
    ex, ey = d + r5 * math.cos(t3), r5 * math.sin(t3)
    # x of P15 is u/v; W = x/(x - d) = u/(u - d v) holds too where P15 lies at infinity
    u, v = fx * (ey - fy) - fy * (ex - fx), ey - fy
    condition = (a + d + linkage.rocker) ** 2 / (abs(u - d * v) * math.sin(state.transmission_angle) ** 2)
    speed = Output(linkage, train).speed(phi)
    assert speed == pytest.approx(u / (u - d * v), abs=1e-13 * (1.0 + abs(speed)) * condition)


@examples(100)
@given(drives(), angles)
def test_mirrored_linkage_runs_backwards(drive, phi):
    linkage, train = drive
    mirror = FourBar(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, -linkage.assembly)
    scale = 1e-14 / math.sin(solve(linkage, phi).transmission_angle) ** 3 * (train.rocker_share + train.ratio)
    assert Output(mirror, train).angle(phi) == pytest.approx(-Output(linkage, train).angle(-phi), abs=30 * scale)
    assert Output(mirror, train).speed(phi) == pytest.approx(Output(linkage, train).speed(-phi), abs=30 * scale)
    assert Output(mirror, train).acceleration(phi) == pytest.approx(
        -Output(linkage, train).acceleration(-phi), abs=1000 * scale
    )


@examples(100)
@given(drives(), angles, st.floats(1e-3, 1e3))
def test_speed_does_not_depend_on_the_scale(drive, phi, scale):
    linkage, train = drive
    larger = FourBar(*(scale * x for x in (linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)))
    same = FourBar(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame)
    sine = min(math.sin(gamma) for gamma in same.transmission_extremes())
    condition = (train.rocker_share + train.ratio) * 10 / sine**2
    assert Output(larger, train).speed(phi) == pytest.approx(Output(same, train).speed(phi), abs=1e-14 * condition)


@examples(100)
@given(drives(), angles)
def test_output_gains_the_mean_ratio_in_a_turn(drive, phi):
    linkage, train = drive
    gain = Output(linkage, train).angle(phi + 2.0 * math.pi) - Output(linkage, train).angle(phi)
    expected = 2.0 * math.pi * (train.ratio if linkage.crank < linkage.frame else 1.0)
    assert Output(linkage, train).mean_ratio * 2.0 * math.pi == expected
    assert gain == pytest.approx(expected, abs=1e-12 * train.rocker_share * 10)


@pytest.mark.parametrize(("linkage", "train"), [(EX3, EX3_TRAIN), (DRAG, DRAG_TRAIN)])
def test_rates_are_the_derivatives_of_the_angle(linkage, train):
    """mpmath differentiates the output angle, built from the loop with complex numbers, at 40 digits."""
    a, b, c, d = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame

    def output(phi):
        reach = d - a * mpmath.expj(phi)
        t2 = mpmath.arg(reach) + mpmath.acos((b * b - c * c + abs(reach) ** 2) / (2 * b * abs(reach)))
        t3 = mpmath.arg(a * mpmath.expj(phi) + b * mpmath.expj(t2) - d)
        return train.ratio * phi + train.coupler_share * t2 + train.rocker_share * t3

    with mpmath.workdps(40):
        for degrees in (20, 100, 300):  # away from the jumps of arg
            phi = mpmath.mpf(math.radians(degrees))
            made = Output(linkage, train)
            rates = (made.speed, made.acceleration, made.jerk)
            for order, rate in enumerate(rates, start=1):
                exact = float(mpmath.diff(output, phi, order))
                assert rate(float(phi)) == pytest.approx(exact, rel=1e-12, abs=1e-13)


@examples(25)
@given(drives())
def test_no_place_is_beyond_the_extremes(drive):
    linkage, train = drive
    found = Output(linkage, train)
    values = [Output(linkage, train).speed(math.radians(i)) for i in range(0, 360, 3)]
    slack = 1e-11 * max(map(abs, values))
    assert found.speed_ratio_min - slack <= min(values)
    assert max(values) <= found.speed_ratio_max + slack


def test_narrow_peaks_next_to_a_change_point_are_found():
    """Folded at the crank angle 0 with 1e-6 of the frame to spare: the speed jumps within 0.1 deg."""
    linkage = FourBar(20.0, 90.0, 40.0, 70.0 * (1.0 + 1e-6))
    found = Output(linkage, GearTrain(60, 30, 10))
    fine = [Output(linkage, GearTrain(60, 30, 10)).speed(math.radians(0.001 * i)) for i in range(-300, 301)]
    assert found.speed_ratio_max >= max(fine)
    assert found.speed_ratio_min <= min(fine)
    assert found.speed_ratio_max > Output(linkage, GearTrain(60, 30, 10)).speed(math.radians(2.0)) + 1e-4
    assert found.speed_ratio_max_at < math.radians(0.2)


@pytest.mark.parametrize(
    ("links", "words"),
    [
        ((50.0, 40.0, 30.0, 100.0), "double-rocker"),
        ((40.0, 90.0, 40.0, 90.0), "the linkage is at its change point, not a crank-rocker or drag link"),
        ((100.0, 50.0, 18.0, 121.4), "rocker-crank"),
        ((10.0, 10.0, 10.0, 100.0), "the four links cannot be assembled, not a crank-rocker or drag link"),
    ],
)
def test_refuses_a_crank_that_does_not_turn(links, words):
    with pytest.raises(NoSolution, match=words):
        check_linkage(FourBar(*links))
    with pytest.raises(NoSolution, match="not a crank-rocker or drag link"):
        _ = Output(FourBar(*links), EX3_TRAIN).speed_turnings


@pytest.mark.parametrize(
    ("links", "closing", "shortest"),
    [
        ((103.0, 45.06, 79.77, 149.26), True, True),
        ((20.0, 30.0, 40.0, 80.0), True, False),
        ((60, 30, 50, 70), False, True),
    ],
)
def test_the_remedy_of_a_linkage_is_a_whole_one(links, closing, shortest):
    """Links that Grashof's rule holds for after the longest is shorter may still have the wrong one shortest."""
    with pytest.raises(NoSolution) as caught:
        check_linkage(FourBar(*links))
    remedy = str(caught.value).rpartition("; ")[2]
    assert ("shorten the longest link" in remedy, "make crank or frame the shortest" in remedy) == (closing, shortest)
    crank, coupler, rocker, frame = links
    if closing:
        frame -= float(remedy.partition("more than ")[2].split()[0]) + 1e-6
    if shortest:
        crank, coupler = coupler, crank
    assert check_linkage(FourBar(crank, coupler, rocker, frame)) == "crank-rocker"


@pytest.mark.parametrize("teeth", [(0, 20, 20), (20, -1, 20), (20, 20, math.nan), (math.inf, 20, 20)])
def test_refuses_gears_without_teeth(teeth):
    with pytest.raises(NoSolution, match="teeth; the number must be positive"):
        GearTrain(*teeth)
