"""Extremes of a few cosines.

The value at a root of the derivative is exact to rounding of the sum: 4 ulp of its largest term. The second way is a
grid of 200 places a wave with a parabola through the three best, which is off by (2 pi/200)^4/8 of an amplitude.
"""

from __future__ import annotations

import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.numerics.harmonic_sum import HarmonicSum

terms = st.lists(
    st.tuples(st.floats(0.1, 10.0), st.sampled_from([0.5, 1.0, 1.5, -2.0, 3.0]), st.floats(-4.0, 4.0)),
    min_size=1,
    max_size=3,
)


def dense(total: HarmonicSum, end: float) -> tuple[float, float]:
    fastest = max(abs(f) for _, f, _ in total.terms)
    x = np.linspace(0.0, end, math.ceil(200.0 * fastest * end / math.tau), endpoint=False)
    v = np.full(x.size, total.constant)
    for a, f, p in total.terms:
        v += a * np.cos(f * x + p)

    def top(v: np.ndarray) -> float:
        before, after = np.roll(v, 1), np.roll(v, -1)  # the interval is a whole number of periods
        bend = before - 2.0 * v + after
        vertex = v - np.divide((after - before) ** 2, 8.0 * bend, out=np.zeros_like(bend), where=bend < 0.0)
        return float(vertex[(v >= before) & (v >= after)].max())

    return -top(-v), top(v)


@examples(40)
@given(terms, st.sampled_from([1, 7, 400]))
def test_extremes_against_a_dense_grid(parts: list[tuple[float, float, float]], turns: int) -> None:
    total = HarmonicSum(3.0, tuple(parts))
    size = sum(a for a, _, _ in parts)
    (low, least), (high, greatest) = total.extremes(0.0, turns * 2.0 * math.tau)
    assert least == pytest.approx(dense(total, turns * 2.0 * math.tau)[0], abs=1e-6 * size)
    assert greatest == pytest.approx(dense(total, turns * 2.0 * math.tau)[1], abs=1e-6 * size)
    for place, value in ((low, least), (high, greatest)):
        assert total.value(place) == value
        inside = 0.0 < place < turns * 2.0 * math.tau
        # the derivative is rounded like its argument, f x
        assert not inside or abs(total.slope(place)) <= 1e-13 * max(1.0, place) * sum(a * f * f for a, f, _ in parts)


def test_long_and_short_ways_agree_to_the_last_bit(monkeypatch: pytest.MonkeyPatch) -> None:
    from gearlink.core.numerics import harmonic_sum

    total = HarmonicSum(5.0, ((2.0, 1.0, 0.3), (1.5, 201 / 199, 0.1), (0.7, -2 / 199, 0.0)))
    fast = total.extremes(0.0, 199 * math.tau)
    harmonic_sum._extremes.cache_clear()
    monkeypatch.setattr(harmonic_sum, "_MANY", math.inf)
    assert total.extremes(0.0, 199 * math.tau) == fast


def test_a_slope_that_rounds_to_zero_at_a_place_of_the_grid() -> None:
    """In arrays and in exact sums it has another sign there: the extreme is found whichever of them compares."""
    total = HarmonicSum(3.0, ((0.5599376245269254, -3.0, -0.5 * math.pi), (0.5, 3.0, 0.0), (0.5, -3.0, math.pi)))
    (_, least), (_, greatest) = total.extremes(0.0, 100.0 * math.pi)
    assert (least, greatest) == pytest.approx((3.0 - 0.5599376245269254, 3.0 + 0.5599376245269254), abs=1e-14)


@pytest.mark.parametrize("last", [1.0, -1.0])
@pytest.mark.parametrize("phase", [-0.7, 0.1, 0.3, 1.1])
def test_of_places_that_are_alike_the_first_is_given(
    phase: float, last: float, monkeypatch: pytest.MonkeyPatch
) -> None:
    """cos 2x has two tops and two bottoms a turn; here the later ones are rounded up, or down, by two ulp more."""
    exact = HarmonicSum.value
    monkeypatch.setattr(HarmonicSum, "value", lambda total, x: exact(total, x) + last * 2.0**-50 * (x > math.pi))
    (low, least), (high, greatest) = HarmonicSum(4.0 + last, ((2.0, 2.0, phase),)).extremes(0.0, math.tau)
    assert (least, greatest) == (pytest.approx(2.0 + last, abs=4e-15), pytest.approx(6.0 + last, abs=4e-15))
    assert high == pytest.approx(-phase / 2.0 % math.pi, abs=1e-12)
    assert low == pytest.approx((math.pi - phase) / 2.0 % math.pi, abs=1e-12)
