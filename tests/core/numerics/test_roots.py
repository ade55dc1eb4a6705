"""Bracketed roots, sign changes and the maximum of scalar functions.

Tolerances: 2 ulp of the root, the stated reach of `bracketed_root`, wherever the function's sign is right to the last
bit; where the function itself is rounded, the width over which its values are noise (given at each test). Values of
smooth maxima: 1e-15 relative; places: 2e-8, the square root of the rounding unit; kinks: 1e-9 of the scale.
"""

import math

import mpmath as mp
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.roots import bracketed_root, maximum, newton_root, sign_changes


class Counter:
    def __init__(self, f):
        self.f, self.calls = f, 0

    def __call__(self, x):
        self.calls += 1
        return self.f(x)


KNOWN = [
    (math.cos, 0.0, 3.0, mp.pi / 2),
    (lambda x: math.exp(x) - 3.0, -5.0, 5.0, mp.log(3)),
    (lambda x: math.tan(x) - 10.0, 0.0, 1.57, mp.atan(10)),
    (lambda x: x * math.exp(x) - 1.0, 0.0, 1.0, mp.lambertw(1)),
    (lambda x: x**5 - 0.2, -1.0, 1.0, mp.mpf(0.2) ** mp.mpf("0.2")),
    (lambda x: math.atan(1e8 * (x - 1 / 3)), -1.0, 1.0, mp.mpf(1 / 3)),  # steep: a step for any interpolation
    (lambda x: 1.0 / (x - 0.3) if x != 0.3 else math.inf, 0.0, 1.0, mp.mpf(0.3)),  # a pole changes sign too
    (lambda x: abs(x - 0.2) + 2.0 * (x - 0.2), -1.0, 1.0, mp.mpf(0.2)),  # a kink at the root
    (lambda x: -1.0 if x < 0.7 else 1.0, 0.0, 1.0, mp.mpf(0.7)),
]


@pytest.mark.parametrize(("f", "low", "high", "root"), KNOWN)
def test_known_roots_from_both_ends(f, low, high, root):
    for a, b in ((low, high), (high, low)):
        counted = Counter(f)
        x = bracketed_root(counted, a, b)
        assert abs(x - float(root)) <= 4.0 * math.ulp(float(root))
        assert counted.calls <= 3 * 60  # never worse than three times bisection


def test_smooth_functions_take_few_calls():
    counted = Counter(lambda x: math.cos(x) - x)
    assert bracketed_root(counted, 0.0, 1.0) == pytest.approx(0.7390851332151607, abs=2e-16)
    assert counted.calls <= 11


@pytest.mark.parametrize("power", [3, 9, 15])
def test_flat_function(power):
    # (x - 1)^n is exact in sign, however flat, so that even a multiple root is found to the last bits
    assert abs(bracketed_root(lambda x: (x - 1.0) ** power, -3.0, 2.5) - 1.0) <= 4.5e-16


def test_flat_function_that_underflows_returns_a_point_of_value_zero():
    x = bracketed_root(lambda x: (x - 0.5) ** 301, -0.3, 1.7)
    assert (x - 0.5) ** 301 == 0.0


def test_multiple_root_at_zero():
    assert abs(bracketed_root(lambda x: x**3, -1.0, 2.0)) <= 1e-50


def test_tiny_and_huge_values_do_not_hide_the_sign():
    assert bracketed_root(lambda x: 1e-200 * (x - 0.25), 0.0, 1.0) == pytest.approx(0.25, rel=5e-16, abs=0.0)
    assert bracketed_root(lambda x: 1e300 * (x - 0.25), 0.0, 1.0) == pytest.approx(0.25, rel=5e-16, abs=0.0)


def test_root_at_an_end_is_taken_at_once():
    counted = Counter(lambda x: x - 2.0)
    assert bracketed_root(counted, 2.0, 5.0) == 2.0
    assert bracketed_root(counted, 0.0, 2.0) == 2.0
    assert counted.calls <= 4


def test_tolerance_ends_early():
    fine, coarse = Counter(lambda x: x**3 - 2.0), Counter(lambda x: x**3 - 2.0)
    assert bracketed_root(fine, 0.0, 2.0) == pytest.approx(math.cbrt(2.0), rel=5e-16, abs=0.0)
    assert abs(bracketed_root(coarse, 0.0, 2.0, tolerance=1e-3) - math.cbrt(2.0)) <= 1e-3
    assert coarse.calls < fine.calls


@examples(200)
@given(st.floats(-1e3, 1e3), st.floats(1e-3, 1e3), st.floats(1e-3, 1e3), st.sampled_from([1, 3, 5]))
def test_any_odd_power_in_any_bracket(root, left, right, power):
    low, high = root - left, root + right
    found = bracketed_root(lambda x: (x - root) ** power, low, high)
    assert found == root or (found - root) ** power == 0.0 or abs(found - root) <= 2.0 * math.ulp(root) + 1e-40


@pytest.mark.parametrize("f", [lambda x: x * x + 1.0, lambda _: -1.0, lambda _: math.nan])
def test_no_sign_change_is_refused(f):
    with pytest.raises(NoSolution, match="no sign change"):
        bracketed_root(f, -1.0, 1.0)


def test_no_number_inside_is_refused():
    with pytest.raises(NoSolution, match="no number"):
        bracketed_root(lambda x: x if abs(x) > 0.9 else math.nan, -1.0, 1.0)


def test_sign_changes():
    assert sign_changes([1.0, -1.0, -2.0, 3.0]) == [0, 2]
    assert sign_changes([1.0, 0.0, -1.0]) == [1]
    assert sign_changes([0.0, 1.0, 2.0]) == [0]
    assert sign_changes([1.0, 2.0, 0.0]) == []  # the last point belongs to the next interval
    assert sign_changes([1e-200, -1e-200]) == [0]  # their product underflows
    assert sign_changes([math.inf, -math.inf, -1.0]) == [0]
    assert sign_changes([]) == sign_changes([1.0]) == []


def test_smooth_maximum():
    x, value = maximum(lambda x: math.sin(x), 0.0, 3.0)
    assert value == pytest.approx(1.0, rel=1e-15, abs=0.0)
    assert x == pytest.approx(math.pi / 2, abs=2e-8)


def test_maximum_with_a_kink():
    x, value = maximum(lambda x: 1.0 - abs(x - 0.3), -2.0, 2.0)
    assert x == pytest.approx(0.3, abs=4e-9)
    assert value == pytest.approx(1.0, abs=4e-9)


def test_maximum_at_an_end():
    assert maximum(math.exp, -1.0, 2.0) == (2.0, math.exp(2.0))
    assert maximum(lambda x: -math.exp(x), -1.0, 2.0) == (-1.0, -math.exp(-1.0))


# Newton's steps inside a bracket


@pytest.mark.quick(4)
@pytest.mark.parametrize("start", [1e-9, 0.3, 2.9])
@pytest.mark.parametrize(
    ("f", "root"),
    [
        (lambda x: (x * x * x - 2.0, 3.0 * x * x), 2.0 ** (1.0 / 3.0)),
        (lambda x: (math.atan(50.0 * (x - 1.0)), 50.0 / (1.0 + 2500.0 * (x - 1.0) ** 2)), 1.0),  # overshoots by far
        (lambda x: (math.sinh(x) - 1e-3, math.cosh(x)), math.asinh(1e-3)),
        (lambda x: (x - 2.0 if x < 2.0 else 9.0 * (x - 2.0), 0.0), 2.0),  # no slope to go by: halved
    ],
)
def test_newton_in_a_bracket(f, root, start):
    assert newton_root(f, 0.0, 3.0, start) == pytest.approx(root, rel=1e-15, abs=4e-16)


def test_newton_takes_few_calls_and_ends_in_noise():
    calls = []

    def noisy(x):
        calls.append(x)
        return (1e3 + x) ** 2 - 1e6 - 2000.25 * 0.125, 2.0 * (1e3 + x)  # cancels to 1e-10

    found = newton_root(noisy, 0.0, 1.0, 0.9)
    assert found == pytest.approx(math.sqrt(1e6 + 2000.25 * 0.125) - 1e3, abs=1e-12)
    assert len(calls) < 10


def test_known_ends_are_not_computed_again():
    calls = []

    def f(x):
        calls.append(x)
        return x * x - 2.0

    assert bracketed_root(f, 0.0, 2.0, ends=(-2.0, 2.0)) == bracketed_root(lambda x: x * x - 2.0, 0.0, 2.0)
    assert not {0.0, 2.0} & set(calls)
