"""Frame ratio and links of the symmetric three-gear four-bar (I = 1).

Tolerances: 4 ulp (1e-15 relative) for closed forms of sums, 1e-14 where a reference of 16 digits is the limit;
phi12 from a frame ratio 1e-14 times its condition number d_lim/(d_lim - d).
"""

import json
import math
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.symmetric import back_step_crank_angle, momentary_frame_ratio
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.symmetric import (
    crank_angle_for_dwell,
    frame_ratio_for_back_step,
    frame_ratio_for_speed_band,
    peak_acceleration_ratio,
    speed_ratio_limits,
    symmetric_linkage,
)
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap

REFERENCE = Path(__file__).parents[2] / "reference"
CASES = {case["id"]: case for case in json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]}

ratios = st.floats(-12.0, -0.04)


def test_published_frame_ratios_at_constant_back_step():
    case = CASES["chart_d_i3_phi12"]
    for phi12, row in zip(case["inputs"]["phi12_deg"], case["outputs"]["table"], strict=True):
        for i3, exact in zip(case["inputs"]["i3"], row, strict=True):
            assert frame_ratio_for_back_step(float(i3), math.radians(phi12)) == pytest.approx(exact, rel=1e-15)
            if phi12 == 0:
                assert momentary_frame_ratio(float(i3)) == pytest.approx(exact, rel=1e-15)


def test_published_frame_ratios_at_constant_speed_spread():
    case = CASES["fig4_6"]
    for delta, row in zip(case["inputs"]["delta"], case["outputs"]["table"], strict=True):
        low, high = 1.0 - float(delta) / 2.0, 1.0 + float(delta) / 2.0
        for i3, exact in zip(case["inputs"]["i3"], row, strict=True):
            assert frame_ratio_for_speed_band(float(i3), low, high) == pytest.approx(exact, rel=2e-15)


def test_published_chart_of_the_speed_spread():
    """Figure 4-4, y = d/(d^2 + 1): the spread is 4 (1 - i3) y."""
    case = CASES["fig4_4"]
    for d, y in zip(case["inputs"]["d"][1:], case["outputs"]["y"][1:], strict=True):
        greatest, least = speed_ratio_limits(-1.0, d)
        assert (greatest - least) / 8.0 == pytest.approx(y, rel=1e-15)


def test_published_example_1():
    out = CASES["ex1"]["outputs"]
    d = frame_ratio_for_back_step(-1.8, math.radians(90.0))
    linkage, train = symmetric_linkage(d, 112.0), GearTrain(40, 72, 40)
    assert d == pytest.approx(out["d_ratio"], rel=1e-15)
    assert linkage.crank == pytest.approx(out["l1"], rel=1e-15)
    assert linkage.frame == pytest.approx(out["l4"], rel=1e-15)
    assert speed_ratio_limits(-1.8, d) == pytest.approx((out["W_max"], out["W_min"]), abs=1e-15)
    assert gear_gap(linkage, train, 2.0) == pytest.approx(out["gap15"], abs=1e-13)
    assert math.degrees(linkage.min_transmission_angle()) == pytest.approx(out["gamma_min_deg"], rel=1e-15)
    assert peak_acceleration_ratio(-1.8, d) == pytest.approx(CASES["I1_peak_accel"]["outputs"]["e5max"], rel=1e-15)


def test_published_example_2():
    out = CASES["ex2"]["outputs"]
    d = frame_ratio_for_speed_band(-1.05, 100.0, 300.0)
    linkage = symmetric_linkage(d, 41.0)
    assert d == pytest.approx(out["d_ratio"], rel=1e-15)
    assert (linkage.crank, linkage.frame) == pytest.approx((out["l1"], out["l4"]), rel=1e-15)
    assert speed_ratio_limits(-1.05, d) == pytest.approx((1.5, 0.5), abs=1e-15)


def test_published_designs_of_the_symmetric_family():
    """The examples of the command line, to their 1e-11 and well below."""
    for case in json.loads((REFERENCE / "contract" / "synth.json").read_text()):
        spec, out = case["spec"], case["quantities"]
        if "momentary" in spec:
            continue
        m, z1, z3 = spec["gears"]["module"], spec["gears"]["crank"], out.get("idler_teeth", 21)
        i3 = -z3 / z1
        if "speed" in spec:
            d = frame_ratio_for_speed_band(i3, spec["speed"]["min"], spec["speed"]["max"])
        elif "dwell" in spec:
            phi12 = crank_angle_for_dwell(i3, math.radians(spec["dwell"]["angle"]))
            assert math.degrees(phi12) == pytest.approx(out["back_step_crank_angle"], rel=1e-14)
            d = frame_ratio_for_back_step(i3, phi12)
        else:
            d = frame_ratio_for_back_step(i3, math.radians(spec["back_step"]["crank_angle"]))
        linkage = symmetric_linkage(d, m * (z1 + z3) / 2.0)
        assert d == pytest.approx(out["frame_ratio"], rel=1e-14)
        assert linkage.crank == pytest.approx(out["crank_length"], rel=1e-14)
        assert linkage.frame == pytest.approx(out["frame_length"], rel=1e-14)
        assert speed_ratio_limits(i3, d) == pytest.approx((out["speed_ratio_max"], out["speed_ratio_min"]), abs=1e-14)
        assert math.degrees(linkage.min_transmission_angle()) == pytest.approx(out["min_transmission_angle"], rel=1e-14)


@examples(100)
@given(ratios, st.floats(1e-3, 3.1))
def test_frame_ratio_and_crank_angle_are_inverse(i3, phi12):
    d = frame_ratio_for_back_step(i3, phi12)
    limit = momentary_frame_ratio(i3)
    assert 1.0 < d < limit
    condition = limit / (limit - d) + d / (d - 1.0)
    assert back_step_crank_angle(i3, d) == pytest.approx(phi12, rel=4e-15 * condition)


@examples(40)
@given(ratios, st.floats(1.02, 30.0), st.sampled_from((1, -1)))
def test_closed_limits_agree_with_the_general_linkage(i3, d, assembly):
    linkage, train = symmetric_linkage(d, 100.0, assembly), GearTrain(1.0, -i3, 1.0)
    assert linkage.kind() == "crank-rocker"
    # k = 2d/(1 + d^2) is the cosine of the minimum transmission angle; rates lose 1/sin^2
    slack = 2e-14 * (1.0 - i3) * ((d + 1.0) / (d - 1.0)) ** 2
    found = Output(linkage, train)
    assert (found.speed_ratio_max, found.speed_ratio_min) == pytest.approx(speed_ratio_limits(i3, d), abs=slack)
    assert found.acceleration_ratio_max == pytest.approx(
        peak_acceleration_ratio(i3, d), abs=slack * (d + 1.0) / (d - 1.0)
    )


@examples(50)
@given(ratios, st.floats(0.0, 100.0), st.floats(0.1, 100.0))
def test_speed_band_is_met(i3, low, width):
    d = frame_ratio_for_speed_band(i3, low, low + width)
    mean = low + width / 2.0
    greatest, least = speed_ratio_limits(i3, d)
    assert (greatest * mean, least * mean) == pytest.approx((low + width, low), abs=1e-14 * (low + width))


@examples(50)
@given(ratios)
def test_band_from_standstill_is_the_momentary_dwell(i3):
    assert frame_ratio_for_speed_band(i3, 0.0, 200.0) == pytest.approx(momentary_frame_ratio(i3), rel=1e-15)


@pytest.mark.parametrize("i3", [0.0, 0.5, math.nan, -math.inf])
def test_refuses_a_ratio_that_is_no_external_mesh(i3):
    with pytest.raises(NoSolution, match=r"i3: \S+ \(limit < 0: "):
        frame_ratio_for_back_step(i3, 1.0)


def test_refuses_what_is_out_of_range():
    with pytest.raises(NoSolution, match=r"180 deg \(from 0"):
        frame_ratio_for_back_step(-1.0, math.pi)
    with pytest.raises(NoSolution, match="back-step: -1 deg"):
        frame_ratio_for_back_step(-1.0, math.radians(-1.0))
    with pytest.raises(NoSolution, match=r"frame over crank: 1 \(limit > 1, "):
        symmetric_linkage(1.0, 100.0)
    with pytest.raises(NoSolution, match=r"speed: -1 to 100 1/min .0 <= min < max") as refusal:
        frame_ratio_for_speed_band(-1.0, -1.0, 100.0)
    assert refusal.value.fix.startswith("set speed.min to 0 or more")
    with pytest.raises(NoSolution, match=r"speed: 100 to 100 1/min .0 <= min < max") as refusal:
        frame_ratio_for_speed_band(-1.0, 100.0, 100.0)
    assert refusal.value.fix == "set speed.max above speed.min"
