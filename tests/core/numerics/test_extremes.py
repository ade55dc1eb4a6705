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

from gearlink.core.numerics.extremes import (
    TURN,
    Extreme,
    extremes_of_parts,
    extremes_over,
    least_convex_radius,
    least_of,
    maximum_over,
    minimum_over,
)

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


@pytest.mark.parametrize("rows", [1, 3])
def test_of_each_interval_those_that_are_wanted_there(rows: int) -> None:
    """As each is found by itself; of functions with rows likewise."""
    shift = np.linspace(0.0, 1.0, rows)[:, None] if rows > 1 else 0.0
    wanted = [(lambda x: np.sin(x + shift), True), (lambda x: np.cos(2.0 * x + shift), False)]
    parts, sought = [(0.0, 3.0), (1.0, 4.0), (2.0, 6.0)], [(0, 1), (1,), (0,)]
    found = extremes_of_parts(wanted, parts, sought=sought)
    for part, numbers, of_part in zip(parts, sought, found, strict=True):
        (alone,) = extremes_of_parts([wanted[k] for k in numbers], [part])
        assert len(of_part) == len(numbers)
        for one, other in zip(of_part, alone, strict=True):
            assert one.value == pytest.approx(other.value, abs=4 * EPS)
            assert one.place == pytest.approx(other.place, abs=PLACE)


@pytest.mark.parametrize(("steep", "size"), [(45.19, 2.81), (35.92, 0.52), (10.49, 1.54), (8.31, 0.25)])
def test_a_search_ends_where_it_meets_a_pole(steep: float, size: float) -> None:
    """Of one random pole in a hundred a sample is the pole itself: no parabola goes through inf, and none is above."""
    with np.errstate(divide="ignore"):
        top = maximum_over(lambda x: size / (1.0 - steep * np.sin(x)), 0.0, 2.0, samples=128)
    assert top.value > 1e9
    assert top.place == pytest.approx(math.asin(1.0 / steep), abs=1e-9 / steep)


def test_no_convex_part_has_no_least_radius() -> None:
    assert least_convex_radius(lambda x: -0.01 + 0.0 * x).value == math.inf
    assert least_convex_radius(lambda x: 0.01 * np.cos(x)).value == pytest.approx(100.0, rel=4 * EPS)


SHIFT = np.array([[0.3], [1.0], [5.9]])


def _wave(x: np.ndarray, shift: Any = SHIFT) -> np.ndarray:
    return np.cos(x - shift) + 0.3 * np.sin(3.0 * x)


def _same(found: Extreme, alone: list[Extreme]) -> None:
    for row, each in enumerate(alone):
        assert np.ravel(found.value)[row] == pytest.approx(each.value, rel=1e-15, abs=1e-15)
        assert np.ravel(found.place)[row] == pytest.approx(each.place, abs=PLACE)


def test_rows_of_several_functions_share_their_rounds() -> None:
    asked: list[np.ndarray] = []

    def shared(x: np.ndarray) -> np.ndarray:
        asked.append(x)
        return _wave(x)

    top, low, plain = extremes_over([(shared, True), (lambda x: 2.0 * _wave(x), False), (np.sin, True)], samples=256)
    _same(top, [maximum_over(lambda x, s=s: _wave(x, s), samples=256) for s in SHIFT.ravel()])  # type: ignore[misc]
    _same(low, [minimum_over(lambda x, s=s: 2.0 * _wave(x, s), samples=256) for s in SHIFT.ravel()])  # type: ignore[misc]
    assert np.ravel(plain.value) == pytest.approx([1.0] * 3, abs=1e-15)
    assert len(asked) == len({id(x) for x in asked})


def test_rows_whose_ends_and_joints_differ() -> None:
    ends, joints = SHIFT + 0.25, [0.4 * SHIFT, 0.7 * SHIFT]

    def stepped(x: np.ndarray, shift: Any = SHIFT) -> np.ndarray:
        return np.where(x < 0.4 * shift, x, np.where(x < 0.7 * shift, 3.0 - x / shift, np.sin(x)))

    for greatest in (True, False):
        (found,) = extremes_over([(stepped, greatest)], 0.0, ends, joints=joints, samples=200)  # type: ignore[arg-type]
        for row, shift in enumerate(SHIFT.ravel()):
            wanted = [(lambda x, shift=shift: stepped(x, shift), greatest)]  # type: ignore[misc]
            own = [0.4 * shift, 0.7 * shift]
            (alone,) = extremes_over(wanted, 0.0, shift + 0.25, joints=own, samples=200)
            assert found.value[row, 0] == pytest.approx(alone.value, abs=1e-14)  # type: ignore[index]
            assert found.place[row, 0] == pytest.approx(alone.place, abs=1e-14)  # type: ignore[index]


def test_rows_over_several_parts() -> None:
    found = extremes_of_parts([(_wave, True)], [(0.0, 2.0), (3.0, 6.0)], samples=128)
    for (top,), part in zip(found, [(0.0, 2.0), (3.0, 6.0)], strict=True):
        _same(top, [maximum_over(lambda x, s=s: _wave(x, s), *part, samples=128) for s in SHIFT.ravel()])  # type: ignore[misc]


def test_a_grid_is_asked_for_as_it_is() -> None:
    """Results that are kept for a grid serve whoever seeks over the same interval next."""
    grids: list[np.ndarray] = []
    for _ in range(2):
        extremes_over([(lambda x: grids.append(x) or np.sin(x), True)], samples=128)  # type: ignore[func-returns-value]
    first = [grid for grid in grids if grid.size > 128]
    assert len(first) == 2
    assert first[0] is first[1]
    assert not first[0].flags.writeable


def test_the_least_of_an_extreme_and_two_ends() -> None:
    ends = np.array([[0.0, 1.0]])
    assert least_of(Extreme(1.0, 0.5), np.array([[2.0, 1.0]]), ends) == Extreme(1.0, 0.5)
    many = least_of(
        Extreme(np.array([[1.0], [3.0]]), np.array([[0.5], [0.6]])), np.array([[0.0, 0.0], [4.0, 2.0]]), ends
    )  # type: ignore[arg-type]
    assert np.ravel(many.value).tolist() == [0.0, 2.0]
    assert np.ravel(many.place).tolist() == [0.0, 1.0]
