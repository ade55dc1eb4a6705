"""Involute function and inverse, scalar and array.

Tolerances: 2 ulp for the scalar functions and the array inverse (their stated accuracy; 1.9 and 1.7 were measured),
2.2 ulp for the array involute (2.1 measured: between 0.9 and 0.97 rad one rounding of tan(a) is 2 ulp of the
result). The difference form is held to 4 ulp times 1 + a/(a+d), the condition of tan(a + d) in its arguments.
"""

import math
import random

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import ALL, examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh import pair_sweep
from gearlink.core.parts.gears.tooth.involute import inverse_involute, involute, involute_rise, rise_of_involute

ANGLES = [(1e-8, 1e-4), (1e-4, 0.1), (0.1, 0.5), (0.5, 0.9), (0.9, 1.14), (1.14, 1.55)]
DECADES = [(-12.0, -6.0), (-6.0, -2.0), (-2.0, 0.0), (0.0, 0.31), (0.31, 1.5), (1.5, 12.0)]


@pytest.fixture(autouse=True)
def _digits():
    with mp.workdps(60):
        yield


def exact(alpha: float) -> mp.mpf:
    return mp.tan(mp.mpf(alpha)) - mp.mpf(alpha)


def exact_inverse(v: float) -> mp.mpf:
    """Bisection in 60 digits: it shares nothing with the program."""
    low, high = mp.mpf(0), mp.pi / 2
    for _ in range(110):
        middle = (low + high) / 2
        low, high = (low, middle) if exact(middle) > v else (middle, high)
    return (low + high) / 2


def ulps(value: float, true: mp.mpf) -> float:
    return float(abs(mp.mpf(value) - true) / mp.mpf(math.ulp(float(true))))


@pytest.mark.quick(1)
@pytest.mark.parametrize(("low", "high"), ANGLES)
def test_involute_against_many_digits(low, high):
    rng = random.Random(1)
    angles = [rng.uniform(low, high) for _ in range(600)]
    assert max(ulps(involute(a), exact(a)) for a in angles) <= 2.0
    values = pair_sweep.involute(np.array(angles))
    assert max(ulps(float(v), exact(a)) for a, v in zip(angles, values, strict=True)) <= 2.2


@pytest.mark.quick(1)
@pytest.mark.parametrize(("low", "high"), DECADES)
def test_inverse_against_many_digits(low, high):
    rng = random.Random(2)
    values = [10.0 ** rng.uniform(low, high) for _ in range(40 if ALL else 15)]
    truth = [exact_inverse(v) for v in values]
    assert max(ulps(inverse_involute(v), t) for v, t in zip(values, truth, strict=True)) <= 2.0
    sweep = pair_sweep.inverse_involute(np.array(values))
    assert max(ulps(float(a), t) for a, t in zip(sweep, truth, strict=True)) <= 2.0


def test_published_value():
    assert involute(math.radians(20.0)) == pytest.approx(0.014904, abs=5e-7)  # the gear tables' inv 20 deg


@pytest.mark.parametrize("invert", [inverse_involute, pair_sweep.inverse_involute])
def test_zero_and_the_ends_of_the_range(invert):
    assert float(invert(0.0)) == 0.0
    # the cube of such an angle has no digits left to repair the rational start, good to 3e-9, of the sweep
    assert float(invert(5e-324)) == pytest.approx(float(mp.cbrt(3 * mp.mpf(5e-324))), rel=3e-9, abs=0.0)
    assert float(invert(1e-300)) == pytest.approx(float(mp.cbrt(mp.mpf(3e-300))), rel=1e-15, abs=0.0)
    assert float(invert(1e300)) == math.pi / 2
    for seam in (1.0, 2.0):  # where the methods meet
        beyond = math.nextafter(seam, 3.0)
        assert 0.0 <= float(invert(beyond)) - float(invert(seam)) <= 4.5e-16


def test_arrays_keep_shape_and_need_no_company():
    values = np.geomspace(1e-12, 50.0, 20_000).reshape(100, 200)
    angles = pair_sweep.inverse_involute(values)
    assert angles.shape == values.shape
    assert angles[37, 11] == pair_sweep.inverse_involute(values[37, 11])
    assert pair_sweep.inverse_involute(values.T[::3])[5, 7] == angles.T[::3][5, 7]
    assert pair_sweep.involute(angles).shape == values.shape
    assert pair_sweep.inverse_involute(np.empty((0, 3))).shape == (0, 3)
    assert pair_sweep.involute([]).shape == (0,)


def test_sweep_and_scalar_agree():
    values = np.geomspace(1e-12, 100.0, 3000)
    scalar = np.array([inverse_involute(float(v)) for v in values])
    assert np.max(np.abs(pair_sweep.inverse_involute(values) - scalar) / np.spacing(scalar)) <= 3.0
    angles = np.linspace(-1.55, 1.55, 3001)
    scalar = np.array([involute(float(a)) for a in angles])
    assert np.all(np.abs(pair_sweep.involute(angles) - scalar) <= 3.0 * np.spacing(np.abs(scalar)))


@examples(200)
@given(st.floats(1e-6, 1.5))
def test_round_trip_and_oddness(alpha):
    # one ulp of v moves the angle by v/(a tan^2 a) <= 1/3 relative ulp; 2 ulp of each function remain
    assert abs(inverse_involute(involute(alpha)) - alpha) <= 3.0 * math.ulp(alpha)
    assert involute(-alpha) == -involute(alpha)


@examples(200)
@given(st.floats(0.05, 0.8), st.floats(-14.0, -0.2), st.sampled_from([-1.0, 1.0]))
def test_rise_keeps_relative_precision(alpha, exponent, sign):
    rise = sign * 10.0**exponent
    if not 0.01 < alpha + rise < 1.4:
        return
    a, d = mp.mpf(alpha), mp.mpf(rise)
    true = mp.tan(a + d) - mp.tan(a) - d
    slope = 1.0 + alpha / (alpha + rise)
    assert ulps(involute_rise(alpha, rise), true) <= 4.0 * slope
    # back: d(rise)/d(difference) = 1/tan^2(alpha + rise)
    condition = max(1.0, abs(float(true)) / (abs(rise) * math.tan(alpha + rise) ** 2))
    back = rise_of_involute(alpha, involute_rise(alpha, rise))
    inherent = abs(rise) if abs(rise) < alpha / 2 else alpha + abs(rise)
    inherent += involute(alpha) / math.tan(alpha + rise) ** 2 if abs(rise) >= alpha / 2 else 0.0
    assert abs(back - rise) <= 8.0 * 2.3e-16 * slope * condition * inherent


def test_rise_of_nothing_is_nothing():
    assert involute_rise(0.35, 0.0) == 0.0
    assert rise_of_involute(0.35, 0.0) == 0.0
    assert rise_of_involute(0.35, -involute(0.35)) == -0.35


@pytest.mark.parametrize("bad", [-1e-30, -1.0, math.nan, math.inf])
def test_inverse_refuses(bad):
    with pytest.raises(NoSolution, match=r"involute of the pressure angle: \S+ \(limit >= 0\)"):
        inverse_involute(bad)
    with pytest.raises(NoSolution, match=r"involute of the pressure angle: \S+ \(limit >= 0\)"):
        pair_sweep.inverse_involute([0.1, bad, 0.2])


@pytest.mark.parametrize("bad", [math.pi / 2, -1.6, 3.0, math.nan])
def test_involute_refuses(bad):
    with pytest.raises(NoSolution, match="within -90 and 90 deg"):
        involute(bad)
    with pytest.raises(NoSolution, match="within -90 and 90 deg"):
        pair_sweep.involute([0.1, bad])
