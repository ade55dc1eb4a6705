"""Extremes, standstills and back-steps over a revolution.

Tolerances: 1e-14 rad for simple zeros of 1 + k sin(phi + s) (slope of order 1, a few ulp of 2 pi); near the tangency of
1 + sin the place is set by the root of the derivative, again 1e-14.
"""

import math

import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.parts.linkages.standstills import TURN, Turning, back_steps, standstills, turnings, zeros_over_turn


def wave(k, shift):
    return lambda x: 1.0 + k * math.sin(x + shift), lambda x: k * math.cos(x + shift)


@examples(100)
@given(st.floats(1.001, 20.0), st.floats(-3.1, 3.1))
def test_sine(k, shift):
    speed, slope = wave(k, shift)
    places = standstills(speed, turnings(speed, slope), 1e-9)
    half = math.asin(1.0 / k)
    expected = sorted((angle - shift) % TURN for angle in (math.pi + half, -half))
    condition = 1.0 / math.sqrt(1.0 - 1.0 / (k * k))
    assert places == pytest.approx(expected, abs=3e-15 * condition * (1.0 + 1.0 / k))
    (step,) = back_steps(speed, lambda x: x - k * math.cos(x + shift), places)
    assert step.crank_angle == pytest.approx(math.pi - 2.0 * half, abs=1e-14 * condition)
    assert 0.0 <= step.start < TURN
    assert speed(step.start + 0.5 * step.crank_angle) == pytest.approx(1.0 - k, rel=1e-12)
    lost = 2.0 * (math.sqrt(k * k - 1.0) - math.acos(1.0 / k))  # integral of the speed between the standstills
    assert step.angle == pytest.approx(lost, abs=1e-14 * condition * (1.0 + k))


@pytest.mark.parametrize(("k", "count"), [(0.5, 0), (1.0 - 1e-8, 0), (1.0 - 1e-10, 1), (1.0, 1), (1.0 + 1e-10, 1)])
def test_touching_zero_is_one_momentary_standstill(k, count):
    speed, slope = wave(k, 0.3)
    places = standstills(speed, turnings(speed, slope), 1e-9)
    assert places == pytest.approx([1.5 * math.pi - 0.3] * count, abs=1e-14)
    assert back_steps(speed, math.sin, places) == []


def test_two_back_steps():
    speed, slope = (lambda x: 0.5 + math.sin(2 * x)), (lambda x: 2 * math.cos(2 * x))
    places = standstills(speed, turnings(speed, slope), 1e-9)
    assert len(places) == 4
    steps = back_steps(speed, lambda x: 0.5 * x - 0.5 * math.cos(2 * x), places)
    assert [round(math.degrees(s.crank_angle), 9) for s in steps] == [60.0, 60.0]


def test_zero_at_the_seam_counts_once():
    assert zeros_over_turn(math.sin) == pytest.approx([0.0, math.pi], abs=1e-15)


def test_a_least_speed_that_a_turn_later_rounds_to_the_other_side_of_zero():
    """Three extremes of a rounded 1 + sin: the minimum is negative where it was found, not where the turn closes."""
    least = Turning(0.5, -5.6e-17)

    def speed(x):
        return 5.6e-17 if x > TURN else least.value if x == least.place else 1.0 - math.cos(x - least.place)

    first, second = standstills(speed, [least, Turning(0.5 + math.pi, 2.0)], 0.0)
    assert (first, second) == pytest.approx((0.5, 0.5), abs=1e-7)
