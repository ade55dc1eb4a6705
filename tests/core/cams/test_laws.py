"""Motion laws of cams.

Tolerances
    ULPS = 8 ulp of a derivative's peak: half a dozen rounded operations per value.
    Near x = 0 the rise must be relatively accurate: 8 ulp of the value itself.
    Sampled peaks lie below the exact ones by at most (step/2)^2/2 of the next-but-one derivative: 1e-6 relative
    with 20 001 samples.
"""

from __future__ import annotations

import json
import math
from fractions import Fraction
from pathlib import Path

import mpmath
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.forty_digits import COEFFICIENTS as OF_REST_TO_REST
from oracles.forty_digits import SHARES, scca_acceleration
from sweeps import examples, mostly_slow, spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED, Law, law

EPS = 2.0**-52
ULPS = 8 * EPS

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())
CASES = {case["id"]: case for case in REFERENCE["cases"]}
NAMES = {
    "simple_harmonic": "simple-harmonic",
    "cycloidal": "cycloidal",
    "modified_trapezoid": "modified-trapezoid",
    "modified_sine": "modified-sine",
    "poly345": "polynomial-345",
    "poly4567": "polynomial-4567",
    "mcv50": "mcv-50",
    "mcv33": "mcv-33",
    "mcv20": "mcv-20",
}
COEFFICIENTS = OF_REST_TO_REST | {
    "velocity-345": [0, 0, 0, 0, Fraction(5, 2), -3, 1],
    "velocity-4567": [0, 0, 0, 0, 0, 7, -14, 10, Fraction(-5, 2)],
}
FREE = [("quintic", 0.4), ("quintic", 0.45), ("quintic", 0.6), ("septic", 0.43), ("septic", 0.5), ("septic", 0.57)]
ALL = [*(law(name) for name in (*REST_TO_REST, *REST_TO_SPEED)), *(law({key: kappa}) for key, kappa in FREE)]
ALL += [law({"scca": [0.1, 0.3, 0.4, 0.2]}), law({"velocity-scca": [0.1, 0.3, 0.4, 0.2]})]
IN_UNIT = st.floats(0.0, 1.0)


def peaks(rule: Law) -> tuple[float, float, float, float]:
    return max(rule.kappa, 0.1), rule.peak_velocity, rule.peak_acceleration, rule.interior_jerk


def named(rule: Law) -> str:
    return rule.name


# Published and reference numbers


@pytest.mark.parametrize("key", NAMES)
def test_peak_constants(key: str) -> None:
    rule, expected = law(NAMES[key]), REFERENCE["law_constants"][key]
    values = (rule.peak_velocity, rule.peak_acceleration, rule.interior_jerk, rule.peak_power)
    for value, symbol in zip(values, ("Cv", "Ca", "Cj", "Cm"), strict=True):
        assert value == pytest.approx(float(expected[symbol]), rel=ULPS, abs=0.0)


def test_catalogue_constants() -> None:
    # one third and one fifth of constant velocity, as printed in catalogues
    third, fifth = law("mcv-33"), law("mcv-20")
    assert (third.peak_velocity, third.peak_acceleration) == pytest.approx((1.404, 6.616), abs=0.0007)
    assert (fifth.peak_velocity, fifth.peak_acceleration) == pytest.approx((1.528, 5.999), abs=0.0005)


@pytest.mark.parametrize("case", [key for key in CASES if key.startswith("LAW-")])
def test_reference_values(case: str) -> None:
    inputs, expected = CASES[case]["inputs"], CASES[case]["expected"]
    rule = law(NAMES[inputs["law"]])
    arrays = rule.evaluate(np.array(inputs["x"]))
    for index, x in enumerate(inputs["x"]):
        for k, (value, peak) in enumerate(zip(rule.evaluate(x), peaks(rule), strict=True)):
            exact = float(expected[f"{'svaj'[k]}({x})"])
            assert value == pytest.approx(exact, rel=0.0, abs=ULPS * peak)
            assert arrays[k][index] == pytest.approx(exact, rel=0.0, abs=ULPS * peak)


def test_reference_half_laws() -> None:
    inputs, expected = CASES["RUN-01"]["inputs"], CASES["RUN-01"]["expected"]
    for key in inputs["laws"]:
        rule = law(f"half-{NAMES[key]}")
        assert rule.kappa == pytest.approx(float(expected[f"kappa_half_{key}"]), rel=ULPS)
        assert rule.peak_acceleration == pytest.approx(float(expected[f"Ca_half_{key}"]), rel=ULPS)
        for symbol, value, peak in zip("svaj", rule.evaluate(inputs["u"]), peaks(rule), strict=True):
            exact = float(expected[f"half_{key}_{symbol}({inputs['u']})"])
            assert value == pytest.approx(exact, rel=0.0, abs=ULPS * peak)


# A second method: the acceleration integrated numerically, polynomials in exact fractions


def moments(shares: tuple[Fraction, ...], x: float) -> list[mpmath.mpf]:
    """Single, double and triple integrals of the unscaled acceleration from 0 to x."""
    a, b, c, _ = (mpmath.mpf(share.numerator) / share.denominator for share in map(Fraction, shares))
    first = [a / 2, (a + b) / 2, (a + b + c) / 2, mpmath.mpf(0.5)]
    joints = sorted({*first, *(1 - joint for joint in first), mpmath.mpf(0)})
    ends = [joint for joint in joints if joint < x] + [mpmath.mpf(x)]
    return [
        mpmath.quad(lambda t, k=k: (x - t) ** k * scca_acceleration(shares, t), ends) / math.factorial(k)
        for k in range(3)
    ]


@pytest.mark.parametrize("name", mostly_slow(list(SHARES), 1))
def test_integrals_of_the_acceleration(name: str) -> None:
    shares = SHARES[name]
    rule, follower = law(name), law(f"velocity-{name}")
    with mpmath.workdps(25):
        scale = 1 / moments(shares, 1.0)[1]
        assert rule.peak_acceleration == pytest.approx(float(scale), rel=ULPS)
        for x in spread((0.03, 0.21, 0.44, 0.77), 2):
            v, s, area = (float(scale * moment) for moment in moments(shares, x))
            assert rule.evaluate(x, 2) == pytest.approx(
                (s, v, float(scale * scca_acceleration(shares, mpmath.mpf(x)))), abs=ULPS * rule.peak_acceleration
            )
            assert follower.evaluate(x, 1) == pytest.approx((area, s), abs=ULPS)


def differentiated(coefficients: list[Fraction], times: int) -> list[Fraction]:
    for _ in range(times):
        coefficients = [i * c for i, c in enumerate(coefficients)][1:]
    return coefficients


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", COEFFICIENTS)
@given(x=IN_UNIT)
@examples(50)
def test_polynomials_against_fractions(name: str, x: float) -> None:
    rule = law(name)
    for k, (value, peak) in enumerate(zip(rule.evaluate(x), peaks(rule), strict=True)):
        terms = differentiated([Fraction(c) for c in COEFFICIENTS[name]], k)
        exact = sum(c * Fraction(x) ** i for i, c in enumerate(terms))
        assert abs(Fraction(value) - exact) <= ULPS * peak


@pytest.mark.parametrize(("key", "kappa"), FREE)
def test_free_laws_against_fractions(key: str, kappa: float) -> None:
    k = Fraction(kappa)
    coefficients = {
        "quintic": [0, 0, 0, 10 * k - 4, 7 - 15 * k, 6 * k - 3],
        "septic": [0, 0, 0, 0, 35 * k - 15, 39 - 84 * k, 70 * k - 34, 10 - 20 * k],
    }[key]
    rule = law({key: kappa})
    for x in (0.0, 0.125, 0.3, 0.5, 0.8, 1.0):
        for order, (value, peak) in enumerate(zip(rule.evaluate(x), peaks(rule), strict=True)):
            terms = differentiated([Fraction(c) for c in coefficients], order)
            exact = sum(c * Fraction(x) ** i for i, c in enumerate(terms))
            assert abs(Fraction(value) - exact) <= 2 * ULPS * peak


@pytest.mark.parametrize("rule", ALL, ids=named)
def test_peaks_against_samples(rule: Law) -> None:
    _, v, a, j = rule.evaluate(np.linspace(0.0, 1.0, 20001))
    for values, peak in (
        (v, rule.peak_velocity),
        (a, rule.peak_acceleration),
        (j, rule.interior_jerk),
        (v * a, rule.peak_power),
    ):
        largest = np.abs(values).max()
        assert largest <= peak * (1.0 + ULPS)
        # a jerk that is largest at a joint is missed by up to a step
        assert largest >= peak * (1.0 - (2e-3 if values is j else 1e-6))


@pytest.mark.parametrize("rule", ALL, ids=named)
def test_each_derivative_is_the_slope_of_the_one_before(rule: Law) -> None:
    # central difference of step h: error h^2/6 of the third derivative, away from the joints of the jerk
    x, h = np.linspace(0.0137, 0.9873, 101), 1e-5
    values, before, after = rule.evaluate(x), rule.evaluate(x - h), rule.evaluate(x + h)
    for k in range(3):
        slope = (after[k] - before[k]) / (2.0 * h)
        error = np.abs(slope - values[k + 1]) / peaks(rule)[k + 1]
        assert np.median(error) < 1e-7
        assert np.count_nonzero(error > 1e-5) <= 4


# Symmetry, joints, ends


@given(x=st.floats(0.5, 1.0), name=st.sampled_from(REST_TO_REST))
@examples(200)
def test_second_half_mirrors_the_first_exactly(x: float, name: str) -> None:
    s, v, a, j = law(name).evaluate(x)
    first = law(name).evaluate(1.0 - x)
    assert s == 1.0 - first[0]
    assert v == first[1]
    if x > 0.5:
        assert (a, j) == (-first[2], first[3])


@given(x=IN_UNIT, rule=st.sampled_from(ALL))
@examples(200)
def test_float_and_array_agree(x: float, rule: Law) -> None:
    for one, many, peak in zip(rule.evaluate(x), rule.evaluate(np.array([x, 0.25])), peaks(rule), strict=True):
        assert type(one) is float
        assert many[0] == pytest.approx(one, rel=0.0, abs=2 * EPS * peak)


@pytest.mark.quick(3)
@pytest.mark.parametrize("rule", ALL, ids=named)
def test_order_skips_but_does_not_change(rule: Law) -> None:
    full = rule.evaluate(0.3)
    for order in range(4):
        assert rule.evaluate(0.3, order) == full[: order + 1]


@pytest.mark.quick(3)
@pytest.mark.parametrize("rule", ALL, ids=named)
def test_ends(rule: Law) -> None:
    start, end = rule.evaluate(0.0, 2), rule.evaluate(1.0, 2)
    assert start[:2] == (0.0, 0.0)
    assert end[0] == pytest.approx(rule.kappa, rel=EPS)
    assert end[1] == (0.0 if rule.kind == "rest-to-rest" else 1.0)
    assert (start[2] == 0.0 and end[2] == 0.0) == (not rule.end_jumps)


@pytest.mark.parametrize("shares", [(0.2, 0.1, 0.3, 0.4), (0.25, 0.0, 0.75, 0.0), (0.1, 0.6, 0.3, 0.0)])
def test_continuous_at_the_joints(shares: tuple[float, ...]) -> None:
    a, b, c, _ = shares
    rule = law({"velocity-scca": list(shares)})
    firsts = (a / 2, (a + b) / 2, (a + b + c) / 2, 0.5)
    for joint in (*firsts, *(1.0 - first for first in firsts)):
        left, right = rule.evaluate(joint - 1e-15), rule.evaluate(joint + 1e-15)
        for k, (low, high, peak) in enumerate(zip(left, right, peaks(rule), strict=True)):
            # the step of 2e-15 times the next derivative's peak, and rounding
            reach = 2e-15 * (*peaks(rule), 200.0)[k + 1] + ULPS * peak
            assert abs(high - low) <= reach


@given(exponent=st.floats(-12.0, -0.5), name=st.sampled_from(["cycloidal", "modified-sine", "velocity-cycloidal"]))
@examples(100)
def test_relative_accuracy_near_zero(exponent: float, name: str) -> None:
    x = 10.0**exponent
    if name == "modified-sine" and x >= 0.125:
        return
    with mpmath.workdps(60):
        z = mpmath.mpf(x) * mpmath.pi
        exact = {
            "cycloidal": (2 * z - mpmath.sin(2 * z)) / (2 * mpmath.pi),
            "modified-sine": (z - mpmath.sin(4 * z) / 4) / (4 + mpmath.pi),
            "velocity-cycloidal": (2 * z * z - 1 + mpmath.cos(2 * z)) / (2 * mpmath.pi) ** 2,
        }[name]
        assert law(name).evaluate(x, 0)[0] == pytest.approx(float(exact), rel=ULPS, abs=0.0)


def test_velocity_after_the_harmonic_is_half_the_cycloidal() -> None:
    x = np.linspace(0.0, 1.0, 33)
    harmonic, cycloidal = law("velocity-simple-harmonic"), law("half-cycloidal")
    for one, other in zip(harmonic.evaluate(x), cycloidal.evaluate(x), strict=True):
        np.testing.assert_allclose(one, other, rtol=0.0, atol=8 * EPS * 5.0)
    assert harmonic.peak_power == pytest.approx(cycloidal.peak_power, rel=ULPS)


@given(a=st.floats(0.01, 1.0), b=st.floats(0.0, 1.0), c=st.floats(0.01, 1.0), d=st.floats(0.0, 1.0))
@examples(60)
def test_any_scca(a: float, b: float, c: float, d: float) -> None:
    total = math.fsum((a, b, c, d))
    rule = law({"scca": [a / total, b / total, c / total, d / total]})
    s, v, acc = rule.evaluate(np.linspace(0.0, 1.0, 301), 2)
    assert (np.diff(s) >= 0.0).all()
    assert v.max() == pytest.approx(rule.peak_velocity, rel=ULPS)
    assert np.abs(acc).max() <= rule.peak_acceleration * (1.0 + ULPS)
    assert (v * acc).max() <= rule.peak_power * (1.0 + ULPS)


def test_free_law_keeps_its_swing_and_never_reverses() -> None:
    u = np.linspace(0.0, 1.0, 1001)
    for key, low, high in (("quintic", 0.4, 0.6), ("septic", 3.0 / 7.0, 4.0 / 7.0)):
        for kappa in (low, 0.5, high):
            s, v, a = law({key: kappa}).evaluate(u, 2)
            assert s[-1] == pytest.approx(kappa, rel=2 * EPS)
            assert a.min() >= -1e-14
            assert v.max() <= 1.0 + 4 * EPS


def test_jumps_are_told() -> None:
    assert law("simple-harmonic").peak_jerk == math.inf
    assert law("simple-harmonic").end_jumps
    assert law({"scca": [0.5, 0.5, 0.0, 0.0]}).peak_jerk == math.inf
    assert not law({"scca": [0.5, 0.5, 0.0, 0.0]}).end_jumps
    assert law("cycloidal").peak_jerk == pytest.approx(4.0 * math.pi**2, rel=ULPS)


def test_parabolic_law_is_exact() -> None:
    rule = law({"scca": [0, 1, 0, 0]})
    assert rule.evaluate(0.25, 2) == (0.125, 1.0, 4.0)
    assert rule.evaluate(0.5, 1) == (0.5, 2.0)
    assert rule.evaluate(0.75, 2) == (0.875, 1.0, -4.0)
    assert rule.peak_power == 8.0


def test_short_names() -> None:
    assert law("velocity-345").evaluate(0.4) == law("velocity-polynomial-345").evaluate(0.4)
    assert law("half-4567").evaluate(0.4) == law("half-polynomial-4567").evaluate(0.4)
    assert law("mcv-0").evaluate(0.4) == law("modified-sine").evaluate(0.4)
    assert law({"half-scca": [0.25, 0, 0.75, 0]}).kappa == law("half-modified-sine").kappa


def test_rounding_past_the_end_is_no_error() -> None:
    assert law("cycloidal").evaluate(1.0 + 1e-15, 0)[0] == pytest.approx(1.0, abs=EPS)
    assert law("cycloidal").evaluate(np.empty(0), 1)[0].size == 0


# Failures


@pytest.mark.parametrize(
    ("definition", "words"),
    [
        ("cycloid", "did you mean 'cycloidal'"),
        ("3-4-5", "did you mean 'polynomial-345'"),
        ("Constant acceleration", "did you mean {scca: [0, 1, 0, 0]}?"),
        ("parabolic", "{scca: [a, b, c, d]}"),
        ("velocity-354", "did you mean 'velocity-345'"),
        ("half-simple-harmonic", "half-cycloidal"),
        ("half-harmonic", "jumps"),
        ("mcv-100", "0 to 99"),
        ("mcv-often", "percentage"),
        ({"half-scca": [0.5, 0.5, 0.0, 0.0]}, "jumps"),
        ({"quintic": 0.61}, "2/5 to 3/5 (nearest 0.6)"),
        ({"quintic": math.nan}, "not one number"),
        ({"quintic": True}, "not one number"),
        ({"septic": 0.42}, "3/7 to 4/7"),
        ({"scca": [0.5, 0.5]}, "list of 4 numbers"),
        ({"scca": [0.5, 0.5, 0.5, 0.0]}, "change one of them by -0.5"),
        ({"scca": [0.7, -0.2, 0.5, 0.0]}, "negative"),
        ({"scca": [0.0, 0.0, 0.0, 1.0]}, "no time to accelerate"),
        ({"sextic": 0.5}, "scca, quintic and septic"),
        ({}, "one key"),
    ],
)
def test_refused(definition: object, words: str) -> None:
    with pytest.raises(NoSolution) as caught:
        law(definition)  # type: ignore[arg-type]
    assert words in str(caught.value)


@pytest.mark.parametrize("x", [-0.01, 1.01, math.nan, np.array([0.5, 1.5]), np.array([0.5, math.nan])])
def test_refuses_to_extrapolate(x: object) -> None:
    with pytest.raises(NoSolution, match="outside 0 to 1"):
        law("modified-sine").evaluate(x)  # type: ignore[type-var]
