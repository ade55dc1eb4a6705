"""Back-step and dwell angle of the symmetric family.

Tolerances: 4e-15 relative where the series or the product forms hold (some ulp at every crank angle, which is what
they are for), 1e-14 for the roots. The reference at every crank angle is mpmath at 60 digits with the plain formulas.
"""

import json
import math
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.symmetric import (
    back_step_angle,
    crank_angle_for_back_step,
    crank_angle_for_dwell,
    crank_angle_for_window,
    dwell_angle,
    dwell_angle_limit,
    i3_for_back_step,
    regained,
    window_limit,
)
from gearlink.core.numerics.elementary_sweep import ARRAYS

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "gear_linkage.json").read_text())["cases"]
}
ratios = st.floats(-12.0, -0.04)
crank_angles = st.floats(1e-4, 3.1)


def exact_back_step(i3, phi12):
    with mpmath.workdps(60):
        n, h = 1 - mpmath.mpf(i3), mpmath.mpf(phi12) / 2
        return 2 * n * mpmath.atan(mpmath.tan(h) / n) - 2 * h


def place_lost(i3, phi12, phi13):
    """Left side less right side of n [asin(k sin y) + asin(k sin h)] = h + y, and its slope in y."""
    with mpmath.workdps(60):
        n, h = 1 - mpmath.mpf(i3), mpmath.mpf(phi12) / 2
        y = mpmath.mpf(phi13) - h
        k = 1 / mpmath.sqrt((n * mpmath.cos(h)) ** 2 + mpmath.sin(h) ** 2)
        rest = n * (mpmath.asin(k * mpmath.sin(y)) + mpmath.asin(k * mpmath.sin(h))) - h - y
        return rest, n * k * mpmath.cos(y) / mpmath.sqrt(1 - (k * mpmath.sin(y)) ** 2) - 1


def test_published_back_steps():
    case = CASES["fig4_5"]
    for phi12, row in zip(case["inputs"]["phi12_deg"], case["outputs"]["table"], strict=True):
        for i3, exact in zip(case["inputs"]["i3"], row, strict=True):
            assert math.degrees(back_step_angle(float(i3), math.radians(phi12))) == pytest.approx(exact, rel=4e-15)


def test_published_ratio_for_a_back_step_of_20_deg():
    out = CASES["ex1_inverse_i3"]["outputs"]
    assert i3_for_back_step(math.radians(20.0), math.radians(90.0)) == pytest.approx(out["i3"], rel=1e-14)


@pytest.mark.parametrize("case", ["phi13_i3_-1", "phi13_i3_-2", "phi13_i3_-3"])
def test_published_dwell_angles(case):
    exact = CASES[case]["outputs"]["phi13_exact_deg"]
    i3 = CASES[case]["inputs"]["i3"]
    assert math.degrees(dwell_angle(i3, math.radians(90.0))) == pytest.approx(exact, rel=1e-15)
    assert math.degrees(crank_angle_for_dwell(i3, math.radians(exact))) == pytest.approx(90.0, rel=1e-15)
    error = (135.0 - exact) / 135.0 * 100.0
    assert error == pytest.approx(CASES[case]["outputs"]["err_over_approx_pct"], abs=1e-12)


def test_published_dwell_angle_of_example_1():
    out = CASES["ex1"]["outputs"]
    assert math.degrees(dwell_angle(-1.8, math.radians(90.0))) == pytest.approx(out["phi13_exact_deg"], rel=1e-15)
    assert math.degrees(back_step_angle(-1.8, math.radians(90.0))) == pytest.approx(out["backoff_deg"], rel=1e-15)


@examples(200)
@given(ratios, st.floats(1e-6, 3.1415))
def test_back_step_keeps_its_digits(i3, phi12):
    exact = exact_back_step(i3, phi12)
    # near 180 deg tan(h) itself has the condition h/cos(h)
    condition = 1.0 + 2.0 / math.cos(phi12 / 2.0)
    assert abs(back_step_angle(i3, phi12) - exact) < 2e-15 * condition * exact


@examples(200)
@given(ratios, crank_angles)
def test_dwell_angle_satisfies_its_equation(i3, phi12):
    phi13 = dwell_angle(i3, phi12)
    assert phi12 < phi13 < min(2.0 * phi12, dwell_angle_limit(i3))
    rest, slope = place_lost(i3, phi12, phi13)
    assert abs(rest / slope) < 1e-13 * phi13


@examples(100)
@given(st.floats(1e-4, 3.1))
def test_three_halves_is_exact_for_i3_of_minus_2(phi12):
    assert dwell_angle(-2.0, phi12) == pytest.approx(1.5 * phi12, rel=3e-14)


@examples(60)
@given(ratios)
def test_three_halves_is_the_limit_of_small_angles(i3):
    assert dwell_angle(i3, 1e-7) == pytest.approx(1.5e-7, rel=1e-13)


@examples(150)
@given(ratios, st.floats(1e-4, 0.9999))
def test_crank_angle_for_dwell_is_the_inverse(i3, share):
    phi13 = share * dwell_angle_limit(i3)
    assert dwell_angle(i3, crank_angle_for_dwell(i3, phi13)) == pytest.approx(phi13, rel=1e-12)


@examples(100)
@given(ratios, st.floats(1e-6, 0.9999))
def test_crank_angle_for_back_step_is_the_inverse(i3, share):
    angle = share * -i3 * math.pi
    assert back_step_angle(i3, crank_angle_for_back_step(i3, angle)) == pytest.approx(angle, rel=2e-14)


@examples(100)
@given(st.floats(1e-6, 0.999), st.floats(1e-3, 3.1))
def test_ratio_for_back_step_is_the_inverse(share, phi12):
    angle = share * (2.0 * math.tan(phi12 / 2.0) - phi12)
    i3 = i3_for_back_step(angle, phi12)
    assert i3 < 0.0
    slack = 1e-14 + 1e-15 / math.cos(phi12 / 2.0)  # the asked-for angle itself has the cancellation of tan(h) - h
    assert abs(exact_back_step(i3, phi12) - angle) < slack * angle * 10.0


def test_limits_of_the_dwell_angle_are_approached():
    for i3 in (-0.5, -1.0, -5.0):
        assert dwell_angle(i3, math.pi - 1e-9) == pytest.approx(dwell_angle_limit(i3), abs=1e-7)
    assert dwell_angle(-1.8, 0.0) == 0.0
    assert back_step_angle(-1.8, 0.0) == 0.0


def test_refuses_a_dwell_angle_out_of_reach():
    with pytest.raises(NoSolution, match=r"below 360 \(1 - i3\)/\(2 - i3\) = 240 deg.*use -i3 above 4"):
        crank_angle_for_dwell(-1.0, math.radians(300.0))
    with pytest.raises(NoSolution, match=r"reduce dwell.angle$"):
        crank_angle_for_dwell(-1.0, math.radians(400.0))
    for angle in (0.0, -1.0, math.nan):
        with pytest.raises(NoSolution, match="above 0, below 360"):
            crank_angle_for_dwell(-1.0, angle)


def test_remedy_of_a_dwell_angle_works():
    crank_angle_for_dwell(-4.0 - 1e-9, math.radians(300.0))


def test_refuses_a_back_step_out_of_reach():
    with pytest.raises(NoSolution, match="back-step within 90 deg of the crank: 25 deg"):
        i3_for_back_step(math.radians(25.0), math.radians(90.0))
    with pytest.raises(NoSolution, match=r"-i3 . 180 = 180 deg.*; set back_step\.angle below 180 deg"):
        crank_angle_for_back_step(-1.0, math.radians(180.0))
    with pytest.raises(NoSolution, match="back-step: 180 deg"):
        i3_for_back_step(0.1, math.pi)
    with pytest.raises(NoSolution, match=r"i3: 1 \(limit < 0: "):
        dwell_angle(1.0, 1.0)


@pytest.mark.parametrize(("i3", "phi12"), [(-0.04, 3.141), (-0.0156949174, 3.0441540192), (-1e-3, 3.1), (-0.19, 3.0)])
def test_many_at_once_never_take_the_root_at_the_back_step_s_own_end(i3: float, phi12: float) -> None:
    # y = h solves the equation too; a start near 2 h may fall to it
    found = 0.5 * phi12 + regained(np.array([1.0 - i3]), np.array([0.5 * phi12]), ARRAYS)[0]
    assert float(found) == pytest.approx(dwell_angle(i3, phi12), rel=4e-15 / -i3, abs=0.0)


def test_an_idler_that_hardly_turns_the_output() -> None:
    # the polishing step has nothing to divide by there and is left out
    phi12 = crank_angle_for_dwell(-5.8713855e-12, 0.7702330021354994)
    assert 0.7702330021354994 / 2.0 <= phi12 <= 0.7702330021354994
    assert 0.55 <= dwell_angle(-1.2210616767893468e-15, 0.5505694513324071) <= 1.2


def regained_at_fifty_digits(i3: float, phi12: float, start: float) -> mpmath.mpf:
    """phi13 from the textbook angles, set equal."""
    n, h = 1 - mpmath.mpf(i3), mpmath.mpf(phi12) / 2
    rest = (n * n - 1) * mpmath.cos(h) ** 2
    at_h = mpmath.atan(mpmath.tan(h) / n)

    def fallen(y: mpmath.mpf) -> mpmath.mpf:
        return n * (mpmath.atan2(mpmath.sin(y), mpmath.sqrt(rest + mpmath.cos(y) ** 2)) + at_h) - h - y

    return h + mpmath.findroot(fallen, mpmath.mpf(start) - h)


@examples(300)
@given(st.floats(-2.0, 2.0), st.floats(-2.0, 0.0), st.floats(0.0, 1.0))
def test_dwell_angle_at_fifty_digits(many: float, few: float, share: float) -> None:
    """6 ulp; above i3 = -0.1 both sides of the equation agree to 1/|i3|, and 16 times that is lost."""
    phi12 = 0.01 + 3.09 * share
    for i3, limit in ((-(10.0 ** max(many, -1.0)), 6.0), (-0.1 * 10.0**few, 16.0 / (0.1 * 10.0**few))):
        found = dwell_angle(i3, phi12)
        with mpmath.workdps(50):
            error = abs(regained_at_fifty_digits(i3, phi12, found) - mpmath.mpf(found))
        assert float(error) <= limit * math.ulp(found)


@pytest.mark.parametrize("i3", [-0.006, -0.44, -1.3065693430656935, -2.0, -121.50731428549985, -689.523196581334])
def test_the_last_number_below_each_limit_is_solved(i3: float) -> None:
    """At a limit the equation is zero at an end of its range, to rounding of either sign."""
    almost = math.nextafter(math.pi, 0.0)
    assert crank_angle_for_back_step(i3, math.nextafter(-i3 * math.pi, 0.0)) == pytest.approx(math.pi, rel=1e-6)
    assert crank_angle_for_dwell(i3, math.nextafter(dwell_angle_limit(i3), 0.0)) == pytest.approx(math.pi, rel=1e-6)
    assert crank_angle_for_window(i3, math.nextafter(window_limit(i3), 0.0)) == pytest.approx(math.pi, rel=1e-6)
    assert dwell_angle(i3, almost) == pytest.approx(dwell_angle_limit(i3), rel=1e-6)


def test_a_back_step_at_its_limit_asks_for_an_endless_idler() -> None:
    for crank_angle in (3.14159265, math.nextafter(math.pi, 0.0)):
        limit = back_step_angle(-1e300, crank_angle)
        with pytest.raises(NoSolution, match=r"set back_step\.angle below \S+ deg, or increase back_step\.crank_angle"):
            i3_for_back_step(math.nextafter(limit, 0.0), crank_angle)
