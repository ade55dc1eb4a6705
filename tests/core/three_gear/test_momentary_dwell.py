"""Closed forms of the momentary dwell.

Tolerances: 1e-15 relative for lengths (sums of positive terms), 1e-14 rad for crank angles; speed and acceleration at
the standstill 1e-13 times 1/sin^2(gamma), which is what they cost in the general linkage.
"""

import json
import math
import re
from pathlib import Path

import mpmath
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st
from oracles.symmetric import momentary_frame_ratio
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.momentary import (
    eccentricity_range,
    least_eccentricity,
    momentary_crank_angle,
    momentary_frame_length,
    momentary_linkage,
    tangency,
    tangency_range,
    wrap,
)
from gearlink.core.machines.three_gear.symmetric import symmetric_linkage
from gearlink.core.machines.three_gear.train import GearTrain, gear_gap

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "gear_linkage.json").read_text())["cases"]
}
EX3 = (25.0, 25.0, 75.0)
radii = st.floats(5.0, 100.0)


def test_published_example_3():
    out = CASES["ex3_exact_d"]["outputs"]
    found = tangency(*EX3, 18.0)
    assert momentary_frame_length(*EX3, 18.0) == pytest.approx(out["d"], rel=1e-15)
    assert found.cos_beta**2 == pytest.approx(out["cos2beta"], rel=1e-15)
    assert math.degrees(momentary_crank_angle(*EX3, 18.0)) == pytest.approx(out["phi_dwell_deg"], rel=1e-15)
    linkage = momentary_linkage(*EX3, 18.0)
    assert gear_gap(linkage, GearTrain(20, 20, 60), 2.5) == pytest.approx(out["gap15"], abs=1e-13)
    extremes = [math.degrees(gamma) for gamma in linkage.transmission_extremes()]
    assert extremes == pytest.approx(out["gamma_ext_deg"][:2], rel=1e-15)


def test_published_example_3_repaired():
    out = CASES["ex3_e16"]["outputs"]
    linkage = momentary_linkage(*EX3, 16.0)
    assert linkage.frame == pytest.approx(out["d"], rel=1e-15)
    assert math.degrees(momentary_crank_angle(*EX3, 16.0)) == pytest.approx(out["phi_dwell_deg"], rel=1e-15)
    assert least_eccentricity(*EX3) == pytest.approx(out["e_lo"], rel=1e-15)
    assert momentary_frame_length(*EX3, out["e_for_d_121_4"]) == pytest.approx(121.4, rel=1e-15)
    assert math.degrees(linkage.min_transmission_angle()) == pytest.approx(out["gamma_ext_deg"][2], rel=1e-15)
    assert Output(linkage, GearTrain(20, 20, 60)).speed_ratio_max == pytest.approx(out["W_max"], abs=1e-14)


def test_published_check_against_the_symmetric_family():
    case = CASES["dstar_I1_check"]
    found = tangency(40.0, 40.0, 40.0, case["inputs"]["e"])
    assert found.frame == pytest.approx(case["outputs"]["d"], rel=1e-15)
    assert found.cos_beta**2 == pytest.approx(0.5, rel=1e-15)
    assert momentary_crank_angle(40.0, 40.0, 40.0, case["inputs"]["e"]) == pytest.approx(1.5 * math.pi, rel=1e-15)


@examples(50)
@given(radii, radii)
def test_agrees_with_the_symmetric_family(r1, r3):
    """I = 1: the frame of thesis (4-18) at phi12 = 0."""
    linkage = symmetric_linkage(momentary_frame_ratio(-r3 / r1), r1 + r3)
    assert momentary_frame_length(r1, r3, r1, linkage.crank) == pytest.approx(linkage.frame, rel=2e-15)
    assert momentary_crank_angle(r1, r3, r1, linkage.crank) == pytest.approx(1.5 * math.pi, abs=3e-14)


def crank_at(r1, r3, r5, share):
    """Crank at a share of its range, or none where the gears have none."""
    try:
        low, high = eccentricity_range(r1, r3, r5)
    except NoSolution:
        assume(False)
    return low + share * (high - low)


@examples(200)
@given(radii, radii, radii, st.floats(0.001, 0.999), st.sampled_from((1, -1)))
def test_speed_and_acceleration_vanish(r1, r3, r5, share, assembly):
    e = crank_at(r1, r3, r5, share)
    linkage, train = momentary_linkage(r1, r3, r5, e, assembly), GearTrain(r1, r3, r5)
    assert linkage.kind() == "crank-rocker"
    phi = momentary_crank_angle(r1, r3, r5, e, assembly)
    sine = min(math.sin(gamma) for gamma in linkage.transmission_extremes())
    slack = 1e-14 * (train.rocker_share + train.ratio) / sine**2
    assert abs(Output(linkage, train).speed(phi)) < slack
    assert abs(Output(linkage, train).acceleration(phi)) < 10 * slack / sine


@examples(100)
@given(radii, radii, radii)
def test_range_ends_where_the_linkage_folds_or_stretches(r1, r3, r5):
    low, high = tangency_range(r1, r3, r5)[0], crank_at(r1, r3, r5, 1.0)
    b, c = r1 + r3, r3 + r5
    assert tangency(r1, r3, r5, math.nextafter(low, r1)).frame + low == pytest.approx(b + c, rel=1e-14)
    below = math.nextafter(high, 0.0)
    assert tangency(r1, r3, r5, below).frame - below == pytest.approx(abs(b - c), abs=1e-13 * (b + c))


@examples(100)
@given(radii, radii, radii, st.floats(1e-12, 1.0 - 1e-12))
def test_frame_agrees_with_the_direct_formula_at_60_digits(r1, r3, r5, share):
    """Both ends of the range included: e within 1e-12 of it."""
    low, _ = tangency_range(r1, r3, r5)
    e = low + share * (r1 - low)
    assume(low < e < r1)
    with mpmath.workdps(60):
        x1, x3, x5, xe = (mpmath.mpf(v) for v in (r1, r3, r5, e))
        b, c = x1 + x3, x3 + x5
        factor = (mpmath.sqrt(x3 * c) + mpmath.sqrt(b * (b + x5))) / x1
        exact = mpmath.sqrt(x5**2 + (x1**2 - xe**2) * (factor**2 - 1))
        h, p = xe**2 - x1**2, (x1 + 2 * x3 + x5) ** 2 + x1**2 - x5**2
        q = 16 * x3 * (x3 + x5) * (x1 + x3) * (x1 + x3 + x5)
        cos2 = -h / (2 * x1**2) * (1 + p / mpmath.sqrt(q))
        sin2 = 1 - cos2
    found = tangency(r1, r3, r5, e)
    assert abs(found.frame - exact) < 1e-15 * exact
    assert abs(found.cos_beta**2 - cos2) < 2e-15 * cos2
    # e - e_lo is as exact as e_lo, which is rounded
    assert abs(found.sin_beta**2 - sin2) < 2e-15 * (sin2 + 4.0 * e**2 / (r1**2 - low**2))


def test_double_root_by_search_at_30_digits():
    """Second method: the frame for which the minimum speed, found by its derivative, is zero."""
    a, b, c = 18, 50, 100

    def speed(phi, d):
        reach = d - a * mpmath.expj(phi)
        t2 = mpmath.arg(reach) + mpmath.acos((b * b - c * c + abs(reach) ** 2) / (2 * b * abs(reach)))
        t3 = mpmath.arg(a * mpmath.expj(phi) + b * mpmath.expj(t2) - d)
        w2 = a * mpmath.sin(phi - t3) / (b * mpmath.sin(t3 - t2))
        w3 = a * mpmath.sin(phi - t2) / (c * mpmath.sin(t3 - t2))
        return mpmath.mpf(1) / 3 - w2 * 2 / 3 + w3 * 4 / 3

    def place(d):
        return mpmath.findroot(lambda phi: mpmath.diff(lambda x: speed(x, d), phi), (4.9, 5.0))

    with mpmath.workdps(30):
        frame = mpmath.findroot(lambda d: speed(place(d), d), (115.5, 115.6), tol=1e-40)
        phi = place(frame)
    assert momentary_frame_length(*EX3, 18.0) == pytest.approx(float(frame), rel=1e-15)
    assert momentary_crank_angle(*EX3, 18.0) == pytest.approx(float(phi), rel=1e-15)


@examples(50)
@given(radii, radii, radii, st.floats(0.05, 0.95), st.floats(1e-3, 1e3))
def test_scale_and_mirror(r1, r3, r5, share, scale):
    e = crank_at(r1, r3, r5, share)
    larger = [scale * x for x in (r1, r3, r5, e)]
    assert momentary_frame_length(*larger) == pytest.approx(scale * momentary_frame_length(r1, r3, r5, e), rel=1e-14)
    phi = momentary_crank_angle(r1, r3, r5, e)
    assert momentary_crank_angle(r1, r3, r5, e, -1) == pytest.approx(wrap(-phi), abs=2e-15)


def test_ends_of_the_range():
    """Stretched straight at e_lo (d + e = b + c), d = r5 at r1."""
    low, high = tangency_range(*EX3)
    assert momentary_frame_length(*EX3, math.nextafter(low, 25.0)) + low == pytest.approx(150.0, rel=1e-15)
    assert momentary_frame_length(*EX3, math.nextafter(25.0, 0.0)) == pytest.approx(75.0, rel=1e-13)
    assert low * high == pytest.approx(625.0, rel=1e-15)


@pytest.mark.parametrize(("e", "words"), [(25.0, "step back"), (26.0, "step back"), (5.0, "never stops")])
def test_refuses_a_crank_outside_the_range(e, words):
    with pytest.raises(NoSolution, match=rf"{words}.*5\.629 to 24\.99 mm"):
        momentary_frame_length(*EX3, e)
    with pytest.raises(NoSolution, match=r"5\.629 to 24\.99 mm"):
        momentary_crank_angle(*EX3, e)


def test_the_printed_range_of_cranks_holds_as_printed():
    """Modules 2, gears 79/36/33: the lower limit 35.324567 was printed as 35.32, with which the crank is refused."""
    radii = 79.0, 36.0, 33.0
    low, high = eccentricity_range(*radii)
    with pytest.raises(NoSolution, match=r"35\.33 to 61\.\d+ mm") as refused:
        momentary_linkage(*radii, 29.41)
    assert low == pytest.approx(35.3246, abs=1e-4)
    for crank in map(float, re.findall(r"\d+\.\d+", refused.value.fix)):
        assert low < crank < high
        assert momentary_linkage(*radii, crank).kind() == "crank-rocker"


def test_refuses_a_crank_that_would_not_turn():
    with pytest.raises(NoSolution, match=r"9\.5 mm, which cannot turn with the frame of its momentar"):
        momentary_linkage(13.0, 5.0, 5.0, 9.5)
    assert momentary_linkage(13.0, 5.0, 5.0, 9.4).kind() == "crank-rocker"


def test_refuses_gears_without_any_crank():
    with pytest.raises(NoSolution, match="use a larger idler or an output gear not smaller"):
        momentary_linkage(50.0, 1.0, 10.0, 30.0)


def test_refuses_radii_and_cranks_that_are_no_lengths():
    with pytest.raises(NoSolution, match="r3 is 0 mm"):
        momentary_frame_length(25.0, 0.0, 75.0, 16.0)
    with pytest.raises(NoSolution, match="never stops"):
        momentary_frame_length(*EX3, math.nan)
    with pytest.raises(NoSolution, match=r"crank: 112 mm \(for the output to stop 5\.629 to"):
        tangency(*EX3, 112.0)
