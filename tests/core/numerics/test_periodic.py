"""The equal-weight rule and its cosine series on a function whose integral is known.

Tolerances: 4 ulp for integrals of functions of size 1; below that only summation and the function round.
"""

from __future__ import annotations

import math

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.periodic import CosineSeries, cosine_series, midpoint_mean

ULP = 2.0**-52


def bell(z: np.ndarray) -> np.ndarray:
    """1/(5/4 + cos z): mean 4/3, coefficients (8/3) (-1/2)^j."""
    return 1.0 / (1.25 + np.cos(z))


def test_geometric_convergence_of_the_midpoint_rule() -> None:
    # error of n nodes on half the period: (8/3) 2^(-2n) to first order
    for nodes in (4, 6, 8, 10):
        error = midpoint_mean(bell, math.pi, nodes) - 4.0 / 3.0
        assert abs(error) == pytest.approx(8.0 / 3.0 * 4.0**-nodes, rel=1.1 * 4.0**-nodes + 1e-8)


def test_series_and_integral() -> None:
    series = cosine_series(bell, math.pi, "too sharp")
    assert series.difference <= 8 * ULP
    exact = [4.0 / 3.0] + [8.0 / 3.0 * (-0.5) ** j for j in range(1, len(series.coefficients))]
    np.testing.assert_allclose(series.coefficients, exact, rtol=0, atol=4 * ULP)
    z = np.array([0.0, 1e-8, 1.0, 3.0, math.pi])
    # antiderivative: (8/3) atan(tan(z/2)/3); at small z the terms add up to f(0), a ninth of their magnitudes
    np.testing.assert_allclose(
        series.integral(z), 8.0 / 3.0 * np.arctan2(np.sin(z / 2), 3 * np.cos(z / 2)), rtol=18 * ULP
    )


def test_far_end_counts_backwards() -> None:
    series = cosine_series(bell, math.pi, "too sharp")
    z = np.linspace(0.0, math.pi, 2050)
    back = series.from_far_end().integral(math.pi - z)
    np.testing.assert_allclose(back, series.total - series.integral(z), rtol=0, atol=16 * ULP)


def test_function_that_does_not_settle() -> None:
    with pytest.raises(NoSolution, match="too sharp: specify less"):
        cosine_series(lambda z: np.sqrt(z), math.pi, "too sharp: specify less")


def test_series_of_many_are_those_of_each() -> None:
    one = cosine_series(bell, math.pi, "too sharp")
    other = cosine_series(lambda z: 1.0 / (2.0 + np.cos(0.5 * z)), 2.0 * math.pi, "too sharp")
    z = np.array([[1e-9, 0.1, 1.0, 3.0], [1e-7, 0.2, 2.0, 6.0]])
    found = CosineSeries.of_many([one, other]).integral(z)
    for row, series, places in zip(found, (one, other), z, strict=True):
        np.testing.assert_allclose(row, series.integral(places), rtol=8 * ULP)  # terms are added in another order
    np.testing.assert_array_equal(one.integral(z), [one.integral(row) for row in z])
