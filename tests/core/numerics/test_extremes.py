"""Refined extremes over a revolution.

Tolerances
    Values at smooth maxima and at kinks: 4 ulp. Places: sqrt(eps) of the turn at a smooth maximum (the function is
    flat there), 1e-14 at a kink.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.numerics.extremes import TURN, Extreme, least_convex_radius, maximum_over, minimum_over

EPS = 2.0**-52
PLACE = 2e-7


@given(peak=st.floats(0.0, TURN), height=st.floats(-5.0, 5.0))
@examples(100)
def test_smooth_maximum(peak: float, height: float) -> None:
    top = maximum_over(lambda x: np.cos(x - peak) + height)
    assert top.value == pytest.approx(1.0 + height, abs=4 * EPS * (1.0 + abs(height)))
    assert abs(math.remainder(top.place - peak, TURN)) < PLACE


@given(kink=st.floats(0.0, TURN), left=st.floats(0.1, 10.0), right=st.floats(0.1, 10.0))
@examples(100)
def test_kink(kink: float, left: float, right: float) -> None:
    bottom = minimum_over(lambda x: np.where(x < kink, left * (kink - x), right * (x - kink)))
    assert bottom.value <= 40.0 * math.ulp(TURN) * max(left, right)
    assert bottom.place == pytest.approx(kink, abs=40.0 * math.ulp(TURN) * max(left, right) / min(left, right))


def test_one_sided_value_at_a_joint() -> None:
    # 1 + x up to the joint, then 0: the limit from the left is never attained
    top = maximum_over(lambda x: np.where(x < 1.0, 1.0 + x, 0.0), 0.0, 2.0, joints=[1.0])
    assert top.value == pytest.approx(2.0, abs=1e-14)
    assert top.place == 1.0
    bottom = minimum_over(lambda x: np.where(x < 1.0, 1.0, x - 2.0), 0.0, 2.0, joints=[1.0])
    assert bottom.value == pytest.approx(-1.0, abs=1e-14)


def test_short_segments_are_sampled_too() -> None:
    # a hump 1e-4 wide between two joints, far narrower than the step
    def hump(x: np.ndarray) -> np.ndarray:
        return np.where(np.abs(x - 2.0) < 5e-5, 1.0 - ((x - 2.0) / 5e-5) ** 2, 0.0)

    assert maximum_over(hump, joints=[2.0 - 5e-5, 2.0 + 5e-5]).value == pytest.approx(1.0, abs=1e-12)


def test_the_higher_of_two_humps_between_samples() -> None:
    # the lower hump stands on a sample, the higher by 1e-9 between two, whose values are 1e-6 lower
    step = TURN / 2048.0

    def humps(x: np.ndarray) -> np.ndarray:
        return np.maximum(np.cos(x - 300.0 * step), np.cos(x - 1300.5 * step) + 1e-9)

    top = maximum_over(humps)
    assert top.value == pytest.approx(1.0 + 1e-9, abs=4 * EPS)
    assert top.place == pytest.approx(1300.5 * step, abs=PLACE)


def test_plateau() -> None:
    top = maximum_over(lambda x: np.minimum(np.sin(x), 0.5))
    assert top.value == 0.5


def _calls(f: Callable[[np.ndarray], np.ndarray], **where: Any) -> tuple[Extreme, int]:
    """The maximum, and how often the function was asked: once on the grid, then once a round."""
    asked: list[int] = []

    def counted(x: np.ndarray) -> np.ndarray:
        asked.append(x.size)
        return f(x)

    return maximum_over(counted, **where), len(asked)


def test_few_rounds_at_a_smooth_maximum() -> None:
    # from 2 deg at once to the 1e-6 that the quartic leaves, and from there to where the samples are alike
    top, calls = _calls(lambda x: np.cos(x - 1.0), samples=360)
    assert top.value == pytest.approx(1.0, abs=EPS)
    assert calls == 4


@given(kink=st.floats(0.5, 6.0), left=st.floats(0.2, 5.0), right=st.floats(0.2, 5.0), bend=st.floats(-1.0, 1.0))
@examples(30)
def test_few_rounds_at_a_kink(kink: float, left: float, right: float, bend: float) -> None:
    def roof(x: np.ndarray) -> np.ndarray:
        away = x - kink
        return np.where(away < 0.0, left * away, -right * away) * (1.0 + 0.1 * bend * away)

    top, calls = _calls(roof, samples=360)
    assert top.value == pytest.approx(0.0, abs=40.0 * math.ulp(TURN) * max(left, right))
    assert calls <= 18


def test_few_rounds_at_a_jump_between_the_samples() -> None:
    # rising up to 2, then 1: the minimum upper bound at the jump, 16-fold a round
    top, calls = _calls(lambda x: np.where(x < 2.0, 3.0 + x, 1.0), samples=360)
    assert top.value == pytest.approx(5.0, abs=8.0 * math.ulp(TURN))
    assert calls <= 16


def test_the_edge_of_what_is_cut_off_is_not_sought() -> None:
    # 0 over half of the turn, which nothing exceeds: where it begins is of no interest
    top, calls = _calls(lambda x: -np.maximum(np.sin(x) - 0.1, 0.0), samples=360)
    assert top.value == 0.0
    assert calls <= 3


def test_what_touches_nothing_is_flat() -> None:
    # x^4 from its zero on: 1e-22 of the largest value is nothing
    top, calls = _calls(lambda x: -(x**4), start=0.0, end=3.0, samples=360)
    assert top.value == pytest.approx(0.0, abs=1e-20)
    assert calls <= 6


def test_ends_count() -> None:
    top = maximum_over(lambda x: x * x, -1.0, 2.0)
    assert (top.value, top.place) == (pytest.approx(4.0, abs=1e-13), 2.0)


def _rounded_up_inside(x: np.ndarray, end: float) -> np.ndarray:
    """1 at the end and a slope of 0.1 towards it; all but the places within 20 ulp of the end are rounded up by 4 ulp.

    Only sums and products of doubles, so that every machine has the same values.
    """
    away = np.abs(x - end)
    return 1.0 - 0.1 * away + np.where(away > 20.0 * math.ulp(end), 8.0 * EPS / 2.0, 0.0)


@pytest.mark.parametrize("end", [0.6832964021557801, 2.0, 5.5])
def test_an_end_that_is_as_good_but_for_rounding_is_the_place(end: float) -> None:
    top = maximum_over(lambda x: _rounded_up_inside(x, end), 0.0, end, samples=180)
    assert top == (pytest.approx(1.0, abs=8 * EPS), end)
    bottom = minimum_over(lambda x: -_rounded_up_inside(x, end), end, end + 1.0, samples=180)
    assert bottom == (pytest.approx(-1.0, abs=8 * EPS), end)
    joint = maximum_over(lambda x: np.where(x < end, _rounded_up_inside(x, end), 0.0), 0.0, 6.0, joints=[end])
    assert joint == (pytest.approx(1.0, abs=8 * EPS), end)


def test_a_place_beside_an_end_that_is_better_by_more_than_rounding_stays() -> None:
    top = maximum_over(lambda x: np.cos(x - 1.9999), 0.0, 2.0, samples=180)
    assert top.place == pytest.approx(1.9999, abs=PLACE)
    kink = 2.0 - 1e-12
    top = maximum_over(lambda x: 1.0 - np.abs(x - kink), 0.0, 2.0, samples=180)
    assert top.place == pytest.approx(kink, abs=4 * EPS)


def test_no_convex_part_has_no_least_radius() -> None:
    assert least_convex_radius(lambda x: -0.01 + 0.0 * x).value == math.inf
    assert least_convex_radius(lambda x: 0.01 * np.cos(x)).value == pytest.approx(100.0, rel=4 * EPS)
