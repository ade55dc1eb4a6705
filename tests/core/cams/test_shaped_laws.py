"""Laws shaped by numbers: end values, polydyne, optimal, solved.

Tolerances
    Peaks are upper bounds that lie at most 1.5e-14 of the largest coefficient too high; samples lie below by
    (step/2)^2/2 of the next-but-one derivative. Residuals: quadrature against a simulation of 30 digits, 1e-12 of the
    maximum |s''|, whose coefficients are rounded. What is minimized is proved to 1e-6 and less of itself, so bounds
    are met to 2e-6.
"""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

import factory
import mpmath as mp
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from oracles import follower
from scipy.optimize import linprog

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics import bernstein
from gearlink.core.parts.cams.laws import Law, law
from gearlink.core.parts.cams.optimal import Optimum, Wish, bound_of_all_laws, greatest_residual, least_torque, optimum
from gearlink.core.parts.cams.shaped import ASSUMED_DAMPING, Drive, Phase, polydyne, residuals, shaped_law
from gearlink.core.studies.loads import vibration

X = np.linspace(0.0, 1.0, 4001)
SMALL = st.floats(-5.0, 5.0, allow_subnormal=False)
OPTIMAL = {"type": "optimal", "minimize": "residual", "band": [2.0, 4.0], "acceleration": 7.0, "jerk": 120.0}
WISHES = [  # the last four numbers: value and lower bound of a reference of its own, coarser in its places
    (Wish("acceleration", 15, jerk=60.0), 4.92317, 4.92277),
    (Wish("acceleration", 21, jerk=60.0), 4.87019, 4.86986),
    (Wish("acceleration", 15, jerk=80.0, velocity=1.8), 4.97857, 4.97819),
    (Wish("velocity", 17, acceleration=6.0, jerk=80.0), 1.50490, 1.50481),
    (Wish("jerk", 15, acceleration=6.0), 39.2331, 39.2272),
    (Wish("residual", 15, acceleration=7.0, jerk=120.0, band=(2.0, 4.0)), 0.0060557, 0.0060535),
    (Wish("residual", 13, acceleration=7.0, jerk=120.0, band=(3.0, 5.0)), 0.0014184, 0.0014180),
]


def refused(definition: Any, phase: Phase | None = None) -> str:
    with pytest.raises(NoSolution) as caught:
        law(definition, phase)
    return caught.value.key


# End values


@given(st.lists(SMALL, min_size=8, max_size=8), st.sampled_from(["polynomial", "septic", "harmonic"]))
@settings(max_examples=12, deadline=None)
def test_end_values_are_met(values: list[float], form: str) -> None:
    count = 4 if form == "septic" else 3
    start, end = values[:count], values[4 : 4 + count]
    found = shaped_law({"type": "harmonic" if form == "harmonic" else "polynomial", "start": start, "end": end})
    size = 1.0 + max(map(abs, values))  # conditions of the bases: 92 and less
    assert found.derivatives(0.0, 0, count - 1) == pytest.approx(start, abs=1e-12 * size)
    assert found.derivatives(1.0, 0, count - 1) == pytest.approx(end, abs=1e-11 * size)


@pytest.mark.slow
@given(st.lists(SMALL, min_size=6, max_size=6), st.sampled_from(["polynomial", "harmonic"]))
@settings(max_examples=8, deadline=None)
def test_derivatives_integrate_and_peaks_bound(values: list[float], form: str) -> None:
    found = shaped_law({"type": form, "start": values[:3], "end": values[3:]})
    s, v, a, j = found.derivatives(X, 0, 3)
    h = X[1]
    for f, rate in ((s, v), (v, a), (a, j)):  # Simpson, h^4/180 of the fifth derivative
        integral = f[0] + np.append(0.0, np.cumsum(h / 3.0 * (rate[:-2:2] + 4.0 * rate[1:-1:2] + rate[2::2])))
        assert integral == pytest.approx(f[::2], abs=1e-9 * (1.0 + np.abs(rate).max()))
    for values_, peak in ((v, found.peak_velocity), (a, found.peak_acceleration), (j, found.interior_jerk)):
        greatest = float(np.abs(values_).max())
        assert greatest <= peak * (1.0 + 1e-12)
        assert peak <= greatest + 1e-5 * (1.0 + greatest)
    assert float(np.abs(v * a).max()) == pytest.approx(found.peak_power, abs=1e-5 * (1.0 + found.peak_power))


@pytest.mark.slow
def test_known_laws_are_members() -> None:
    quintic = law({"type": "polynomial"})
    septic = law({"type": "polynomial", "start": [0, 0, 0, 0], "end": [1, 0, 0, 0]})
    solved = law({"type": "bernstein", "acceleration": [0.0, 20.0, -20.0, 0.0]})
    cycloid = law({"type": "harmonic", "start": [0, 0, 0], "end": [1, 0, 0]})
    pairs = (
        (quintic, "polynomial-345"),
        (septic, "polynomial-4567"),
        (solved, "polynomial-345"),
        (cycloid, "cycloidal"),
    )
    for found, name in pairs:
        usual = law(name)
        assert found.kind == "rest-to-rest"
        for one, other, peak in zip(found.evaluate(X), usual.evaluate(X), (1.0, 2.5, 10.0, 60.0), strict=True):
            assert one == pytest.approx(other, abs=1e-14 * peak)
        for peak in ("peak_velocity", "peak_acceleration", "peak_jerk", "peak_power"):
            assert getattr(found, peak) == pytest.approx(getattr(usual, peak), rel=1e-12)


def test_harmonic_basis_has_the_stated_determinant() -> None:
    pi = math.pi
    rows = []
    for x in (0.0, 1.0):
        for order in range(3):
            row = [float(order == 0), x if order == 0 else float(order == 1)]
            for k in (1, 2):
                turn = k * pi * x + order * pi / 2.0
                row += [(k * pi) ** order * math.cos(turn), (k * pi) ** order * math.sin(turn)]
            rows.append(row)
    assert abs(np.linalg.det(np.array(rows))) == pytest.approx(30764.0, abs=1.0)


# Polydyne


@pytest.mark.parametrize(
    ("periods", "damping", "peaks", "beside"),
    [
        (1.5, 0.0, (1.574377, 6.017812, 170.2196), (0.0707, 0.0577)),
        (2.5, 0.0, (2.141776, 6.915881, 61.27905), (0.0075, 0.0021)),
        (2.5, 0.03, (2.142587, 6.949957, 61.27905), (0.0062, 0.0018)),
        (4.0, 0.05, (2.336968, 8.419028, 69.82495), (0.0003, 0.0002)),
    ],
)
def test_polydyne_leaves_nothing(periods: float, damping: float, peaks: Any, beside: Any) -> None:
    found = polydyne(periods, damping)
    assert (found.peak_velocity, found.peak_acceleration, found.peak_jerk) == pytest.approx(peaks, rel=4e-7)
    left = residuals(found, periods / np.array([1.0, 1.1, 0.9]), damping)
    assert left[0] < 1e-15 * found.peak_acceleration
    assert left[1:] == pytest.approx(beside, abs=6e-5)


def test_polydyne_leaves_nothing_at_30_digits() -> None:
    """The law with its coefficients in 40 digits, simulated: rest after the phase to the last of 30 digits."""
    for periods, damping in ((1.5, 0.0), (2.5, 0.03)):
        with mp.workdps(40):
            w, y = 2 * mp.pi * mp.mpf(periods), [0, 0, 0, 0, 0, 126, -420, 540, -315, 70]
            first = [*(k * c for k, c in enumerate(y) if k), 0]
            second = [*(k * c for k, c in enumerate(first) if k), 0]
            s = [a + 2 * mp.mpf(damping) / w * b + c / w**2 for a, b, c in zip(y, first, second, strict=True)]
            acceleration = [k * (k - 1) * c for k, c in enumerate(s)][2:]
            assert follower.left(follower.of_powers(acceleration), periods, damping) < mp.mpf(10) ** -29


# Vibration


def taylor_of(found: Law) -> follower.Taylor:
    assert found.shaping is not None
    assert found.shaping.acceleration
    return follower.of_powers(follower.of_bernstein(found.shaping.acceleration))


SIMULATED: list[tuple[Any, float, float]] = [
    ({"type": "polynomial"}, 1.3, 0.0),
    ({"type": "polynomial", "start": [0, 0, 0, 0], "end": [1, 0.4, 2, 0]}, 2.7, 0.1),
    ({"type": "polydyne", "periods": 1.5}, 1.9, 0.02),
    (OPTIMAL, 2.6, 0.0),
    ({"type": "optimal", "minimize": "acceleration", "jerk": 60.0}, 3.3, 0.05),
    ({"type": "optimal", "minimize": "velocity", "acceleration": 6.0}, 1.1, 0.0),
    ({"type": "optimal", "minimize": "jerk", "degree": 9}, 0.7, 0.0),
    (OPTIMAL | {"symmetric": False, "degree": 11}, 3.1, 0.0),
    (OPTIMAL | {"damping": 0.05, "degree": 11}, 3.1, 0.05),
    ({"type": "bernstein", "acceleration": [0.0, 20.0, -20.0, 0.0]}, 5.2, 0.0),
]


@pytest.mark.quick(3)
@pytest.mark.parametrize(("definition", "periods", "damping"), SIMULATED, ids=lambda each: str(each)[:40])
def test_residuals_are_those_of_a_simulated_follower(definition: Any, periods: float, damping: float) -> None:
    found = law(definition)
    simulated = float(follower.left(taylor_of(found), periods, damping))
    left = float(residuals(found, np.array([periods]), damping)[0])
    assert left == pytest.approx(simulated, rel=1e-9, abs=1e-12 * found.peak_acceleration)


def test_more_natural_periods_than_are_computed_are_refused_at_their_key() -> None:
    """A phase of 1e9 ms took 41 GB, and a fault ended the command."""
    asked = {"kind": "motion-law", "law": "cycloidal", "frequency": 220.0}
    assert factory.design(asked, time=20_000.0).residual_at_design < 1e-6
    for found in (factory.design(asked, time=1e9).table, lambda _: factory.design(asked, time=1e9).residual_at_design):
        with pytest.raises(NoSolution, match="natural periods per phase") as refused:
            found("residual")
        assert refused.value.key == "frequency"


@pytest.mark.slow
@pytest.mark.parametrize("minimize", ["torque", "acceleration", "jerk", "velocity", "residual"])
@pytest.mark.parametrize("to_speed", [False, True])
@pytest.mark.parametrize("symmetric", [False, True])
def test_every_optimal_law_simulated(minimize: str, *, to_speed: bool, symmetric: bool) -> None:
    """The law shipped, at 12 places of the band or of the usual range; the bound on its residual holds there."""
    limits = {"acceleration": 2.0, "jerk": 20.0} if to_speed else {"acceleration": 7.0, "jerk": 120.0}
    limits.pop(minimize, None)
    definition = {"type": "optimal", "minimize": minimize, "degree": 13, "symmetric": symmetric, **limits}
    definition |= {"band": [1.5, 3.0]} if minimize == "residual" else {}
    found = law(definition, Phase(to_speed=to_speed))
    assert found.kind == ("rest-to-speed" if to_speed else "rest-to-rest")
    taylor, periods = taylor_of(found), np.linspace(1.5, 3.0, 12)
    simulated = [float(follower.left(taylor, each)) for each in periods]
    assert residuals(found, periods) == pytest.approx(simulated, rel=1e-8, abs=1e-12 * found.peak_acceleration)
    if minimize == "residual":
        assert max(simulated) <= found.shaping.optimum.value  # type: ignore[union-attr]


@pytest.mark.slow
def test_waves_simulated() -> None:
    with mp.workdps(40):
        cycloid = follower.of_waves([(2 * mp.pi, 2 * mp.pi, mp.mpf(0))])
        simulated = [float(follower.left(cycloid, each, 0.04)) for each in (0.6, 1.0, 2.5)]
    for definition in ("cycloidal", {"type": "harmonic"}):
        left = residuals(law(definition), np.array([0.6, 1.0, 2.5]), 0.04)
        assert left == pytest.approx(simulated, rel=1e-12)
    assert float(residuals(law("cycloidal"), np.ones(1))[0]) == pytest.approx(0.5, rel=1e-13)


def test_residuals_are_those_of_the_loads() -> None:
    assert ASSUMED_DAMPING == vibration.ASSUMED_DAMPING
    for definition in ("modified-trapezoid", "modified-sine", OPTIMAL):
        found = law(definition)
        bend = lambda u, found=found: np.asarray(found.derivatives(u, 2, 2)[0])  # noqa: E731
        panels = vibration.Panelled.of(bend, 0.0, 1.0, found.joints, 20.0)
        for periods, damping in ((1.3, 0.03), (2.9, 0.0)):
            oscillator = vibration.Oscillator(2.0 * math.pi * periods, damping)
            left = float(residuals(found, np.array([periods]), damping)[0])
            assert left == pytest.approx(panels.residual(oscillator, 1.0), abs=1e-14)


# Optimal laws


@pytest.mark.quick(2)
@pytest.mark.parametrize(("wish", "value", "lower"), WISHES, ids=lambda each: str(each)[:60])
def test_optimal_laws_against_a_programme_of_fixed_places(wish: Wish, value: float, lower: float) -> None:
    found = optimum(wish)
    assert lower * (1.0 - 1e-5) <= found.lower_bound <= found.value <= value * (1.0 + 1e-5)
    assert found.gap < 2e-5
    for key, limit in (("velocity", wish.velocity), ("acceleration", wish.acceleration), ("jerk", wish.jerk)):
        c = np.array(found.coefficients)
        curve = {"velocity": bernstein.integral(c), "acceleration": c, "jerk": bernstein.derivative(c)}[key]
        greatest = float(np.abs(bernstein.evaluate(curve, X)).max())
        if limit is not None:
            assert greatest <= limit
        if key == wish.minimize:
            assert greatest <= found.value
            assert found.value <= greatest * (1.0 + 2e-5)


def programme_of_scipy(wish: Wish, places: int = 401) -> float:
    """The same programme with fixed places, in powers of sin and another solver's interface: its optimum."""
    n, u = wish.degree, 0.5 * (1.0 - np.cos(np.linspace(0.0, math.pi, places)))
    # s'' = x (1 - x) p(x), p by Legendre polynomials: what vanishes at both ends
    degrees = range(n - 1)
    bend = [
        np.polynomial.Polynomial([0, 1, -1])
        * np.polynomial.Legendre.basis(k, domain=[0, 1]).convert(kind=np.polynomial.Polynomial)
        for k in degrees
    ]
    speed = [p.integ() for p in bend]
    curves = {"velocity": speed, "acceleration": bend, "jerk": [p.deriv() for p in bend]}
    rows, right = [], []
    for key, limit in (("velocity", wish.velocity), ("acceleration", wish.acceleration), ("jerk", wish.jerk)):
        matrix = np.array([p(u) for p in curves[key]]).T
        for sign in (1.0, -1.0):
            if key == wish.minimize:
                rows.append(np.column_stack([sign * matrix, np.full(places, -1.0)]))
                right.append(np.zeros(places))
            elif limit is not None:
                rows.append(np.column_stack([sign * matrix, np.zeros(places)]))
                right.append(np.full(places, limit))
    equal = np.array([[*(p(1.0) for p in speed), 0.0], [*(p.integ()(1.0) for p in speed), 0.0]])
    done = linprog(
        [*np.zeros(n - 1), 1.0], np.concatenate(rows), np.concatenate(right), equal, [0.0, 1.0], bounds=(None, None)
    )
    assert done.status == 0
    return float(done.fun)


@pytest.mark.slow
@pytest.mark.parametrize("wish", [wish for wish, *_ in WISHES if wish.minimize != "residual"], ids=str)
def test_optimal_laws_against_another_programme(wish: Wish) -> None:
    found = optimum(wish)
    assert programme_of_scipy(wish) == pytest.approx(found.value, rel=2e-3)  # places that are fixed miss so much
    assert programme_of_scipy(wish) <= found.value * (1.0 + 1e-6)


@pytest.mark.slow
def test_nothing_is_gained_by_asymmetry() -> None:
    for wish in (WISHES[0][0], WISHES[3][0]._replace(degree=11), WISHES[5][0]._replace(degree=11)):
        both = optimum(wish._replace(symmetric=False)), optimum(wish)
        assert both[0].value == pytest.approx(both[1].value, rel=2e-5)


@pytest.mark.slow
@given(st.floats(40.0, 200.0), st.sampled_from([9, 12, 15, 20]))
@settings(max_examples=4, deadline=None)
def test_bounds_hold_for_known_laws_and_all_laws(jerk: float, degree: int) -> None:
    found = optimum(Wish("acceleration", degree, jerk=jerk))
    assert found.lower_bound_all_laws is not None
    assert found.lower_bound_all_laws <= found.lower_bound <= found.value
    for name in ("polynomial-345", "polynomial-4567"):  # of degree 3 and 5: members of the class
        usual = law(name)
        if usual.peak_jerk <= jerk:
            assert found.lower_bound <= usual.peak_acceleration


@pytest.mark.parametrize("jerk", [33.0, 60.0, 200.0])
def test_closed_form_of_acceleration_is_attained(jerk: float) -> None:
    """The law with jerk +-J and a plateau at A has rise 1: by its three parabolas."""
    top = bound_of_all_laws(Wish("acceleration", jerk=jerk))
    assert top is not None
    ramp, half = top / jerk, 0.5
    # a over half the phase: up, plateau, down to 0 at 1/2
    v_mid = top * (half - ramp)
    # the velocity is symmetric, and over each half about its middle: its mean is v_mid/2
    assert 0.5 * v_mid == pytest.approx(1.0, rel=1e-12)


def test_limits_that_no_law_keeps() -> None:
    optimal = {"type": "optimal", "minimize": "velocity"}
    assert refused(optimal | {"jerk": 31.9}) == "jerk"
    assert refused(optimal | {"acceleration": 4.0}) == "acceleration"
    assert refused(optimal | {"minimize": "jerk", "velocity": 1.0}) == "velocity"
    assert refused(optimal | {"minimize": "jerk", "acceleration": 4.2}) == ""  # at the law itself
    assert refused({"type": "polydyne", "periods": 0.49}) == "periods"
    assert refused({"type": "optimal", "minimize": "residual", "band": [2, 4]}) == "acceleration"
    assert refused({"type": "bernstein", "acceleration": [0.0, 1.0, 0.0]}) == "acceleration"
    assert refused({"type": "polydyne", "frequency": 50.0}) == "frequency"
    assert refused({"type": "nothing"}) == ""


@pytest.mark.parametrize(
    ("wish", "least"),
    [
        (Wish("torque", 9, acceleration=8.0), 2.4804),
        pytest.param(Wish("torque", 21, acceleration=8.0, jerk=200.0), 2.4804, marks=pytest.mark.slow),
        pytest.param(Wish("torque", 15, acceleration=6.0, jerk=80.0), 2.7632, marks=pytest.mark.slow),
        pytest.param(Wish("torque", 15, jerk=20.0, to_speed=True), 0.5, marks=pytest.mark.slow),
    ],
)
def test_least_torque(wish: Wish, least: float) -> None:
    found = least_torque(wish)
    c = np.array(found.coefficients)
    torque = bernstein.evaluate(bernstein.integral(c), X) * bernstein.evaluate(c, X)
    assert float(np.abs(torque).max()) == pytest.approx(found.value, rel=1e-4)
    assert found.lower_bound == pytest.approx(least, abs=1e-4)
    assert found.lower_bound_all_laws == (0.5 if wish.to_speed else 2.25)
    assert found.value > found.lower_bound
    if wish.degree == 21:
        assert found.value <= 3.0216 * (1.0 + 1e-5)
        assert found.value < law("simple-harmonic").peak_power


@given(st.lists(st.floats(-50.0, 50.0), min_size=2, max_size=20))
@settings(max_examples=16, deadline=None)
def test_peaks_bound_what_they_claim(coefficients: list[float]) -> None:
    c = np.array(coefficients)
    greatest = float(np.abs(bernstein.evaluate(c, np.linspace(0.0, 1.0, 20001))).max())
    size = float(np.abs(c).max())
    assert greatest <= bernstein.peak(c) * (1.0 + 1e-14)
    # between samples: half a step, squared, of the second derivative
    assert bernstein.peak(c) <= greatest + size * (1e-10 + 0.5 * (2.5e-5 * len(c)) ** 2 * 4.0)


def test_bernstein_forms() -> None:
    series = np.array([0.1, 0.2, -0.3, 0.4, 0.5, 0.7])
    found = bernstein.from_chebyshev(series)
    assert bernstein.evaluate(found, X) == pytest.approx(
        np.polynomial.chebyshev.chebval(2.0 * X - 1.0, series), abs=1e-14
    )
    other = bernstein.from_powers([Fraction(1), Fraction(-2), Fraction(3)])
    both = bernstein.product(found, other)
    assert bernstein.evaluate(both, X) == pytest.approx(
        bernstein.evaluate(found, X) * bernstein.evaluate(other, X), abs=1e-13
    )
    assert bernstein.derivative(bernstein.integral(found)) == pytest.approx(found, abs=1e-14)
    assert bernstein.peak(np.zeros(3)) == 0.0


def test_greatest_residual_bounds_the_samples() -> None:
    found = optimum(WISHES[5][0])
    bound = greatest_residual(found.coefficients, (2.0, 4.0), 0.0)
    periods = np.linspace(2.0, 4.0, 3001)
    greatest = float(residuals(law({"type": "bernstein", "acceleration": list(found.coefficients)}), periods).max())
    assert greatest <= bound <= greatest * (1.0 + 2e-6)


# What a design says


def test_speeds_and_units_of_a_design() -> None:
    phase = Drive(300.0, frequency=60.0).phase(math.radians(80.0), 30.0)
    time = 80.0 / 360.0 / 5.0
    assert phase.time == pytest.approx(time, rel=1e-15)
    periods = 60.0 * time
    same = law({"type": "polydyne", "frequency": 60.0}, phase), law({"type": "polydyne", "periods": periods})
    assert same[0].peak_acceleration == pytest.approx(same[1].peak_acceleration, rel=1e-12)
    slower = law({"type": "polydyne", "frequency": 60.0, "speed": 150.0}, phase)
    assert slower.shaping.periods == pytest.approx(2.0 * periods, rel=1e-12)  # type: ignore[union-attr]
    band = {"type": "optimal", "minimize": "residual", "degree": 9, "band": [250.0, 350.0]}
    found = law(band | {"limit": {"acceleration": 7.0 * 30.0 / time**2, "jerk": 120.0 * 30.0 / time**3}}, phase)
    wish = found.shaping.wish  # type: ignore[union-attr]
    low, high = (periods * 300.0 / speed for speed in (350.0, 250.0))
    assert wish.band == pytest.approx((low, high), rel=1e-12)  # type: ignore[union-attr]
    assert (wish.acceleration, wish.jerk) == pytest.approx((7.0, 120.0), rel=1e-12)  # type: ignore[union-attr]
    assert refused(band | {"band": [2.0, 4.0], "jerk": 120.0}, phase) == "band"
    assert refused(band | {"limit": {"jerk": 1000.0}}, phase) == "limit.jerk"
    assert refused(band | {"limit": {"jerk": 1e6}}) == "limit"
    with pytest.raises(NoSolution, match=r"natural periods per phase of the band: 800 \(limit <= 200\)") as caught:
        law(band | {"band": [300.0 * periods / 800.0, 350.0], "jerk": 120.0}, phase)
    assert caught.value.fix == "start the band at 4.001 1/min"
    assert refused(band | {"band": [2.0, 200.1], "unit": "periods", "jerk": 120.0}, phase) == "band"


def test_a_solved_law_is_read_again() -> None:
    found = law(OPTIMAL)
    again = law({"type": "bernstein", "acceleration": list(found.shaping.acceleration)})  # type: ignore[union-attr]
    assert [np.array_equal(a, b) for a, b in zip(found.evaluate(X), again.evaluate(X), strict=True)] == [True] * 4
    s, v = again.evaluate(1.0, 1)
    assert (s, v) == pytest.approx((1.0, 0.0), abs=1e-15)


def test_gap_says_what_a_better_law_could_gain() -> None:
    assert Optimum((), 1.01, 1.0, None).gap == pytest.approx(0.01, rel=1e-12)


def test_a_gripper_reaches_its_speed_by_laws_of_its_own() -> None:
    shaped = {"type": "optimal", "minimize": "acceleration", "jerk": 8.0, "degree": 11}
    made = factory.design(
        "swing_gripper", laws__accelerate=shaped, laws__return={"type": "polydyne", "frequency": 50.0}
    )
    usual, law_ = factory.design("swing_gripper").motion.law, made.motion.law
    assert law_.accelerate.kappa == pytest.approx(0.5, rel=1e-12)
    assert law_.accelerate.peak_acceleration < usual.accelerate.peak_acceleration
    assert law_.joints[:, :3] == pytest.approx(np.zeros((6, 3)), abs=1e-10)
    # one revolution a sheet, 12000 an hour: the return takes 120/360 of 0.3 s
    assert law_.return_.shaping.periods == pytest.approx(50.0 * 0.1, rel=1e-12)
    assert [check.status for name in ("law-gap", "polydyne-range") for check in made.check(name)] == ["pass", "pass"]
    (found,) = made.completion()
    assert (found.path, found.value["type"]) == ("laws.accelerate", "bernstein")
    again = factory.design("swing_gripper", laws__accelerate=found.value)
    assert again.total_swing == pytest.approx(made.total_swing, rel=1e-13)


def test_a_press_returns_by_a_law_in_its_units() -> None:
    shaped = {"type": "optimal", "minimize": "jerk", "limit": {"acceleration": 2e5}, "degree": 11}
    made = factory.design("ty460", cam__return_law=shaped)
    found, follower_ = made.cams.follower.return_law, made.cams.follower
    time = made.spec.cam.return_angle / 360.0 * 3600.0 / made.spec.speed
    wish = found.shaping.wish
    assert wish.acceleration == pytest.approx(2e5 * time**2 / follower_.top, rel=1e-12)
    assert found.peak_acceleration <= wish.acceleration
    with pytest.raises(NoSolution) as caught:
        _ = factory.design("ty460", cam__return_law=shaped | {"limit": {"acceleration": 1e3}}).cams.follower
    assert caught.value.key == "cam.return_law.limit.acceleration"
