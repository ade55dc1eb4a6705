"""Steps of least squares against scipy's, and rows that do not see each other."""

from __future__ import annotations

import numpy as np
import pytest
from scipy.optimize import least_squares

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.lm import State, damped, descend

T = np.linspace(0.0, 2.0, 9)
WANTED = 1.7 * np.exp(-0.6 * T) + 0.02 * np.cos(7.0 * T)


def curve(x: Reals) -> State:
    miss = x[:, :1] * np.exp(x[:, 1:] * T) - WANTED
    slopes = np.stack((np.exp(x[:, 1:] * T), x[:, :1] * T * np.exp(x[:, 1:] * T)), axis=2)
    return np.sum(miss**2, axis=1), miss, slopes


def step(x: Reals, state: State, damping: Reals) -> Reals:
    return x + damped(state[2], state[1], damping)


def test_every_start_comes_to_the_least_squares_of_scipy() -> None:
    starts = np.random.default_rng(1).uniform((0.3, -2.0), (4.0, 0.5), (20, 2))
    found, (cost, *_), _, taken = descend(curve, step, starts, 200)
    other = least_squares(lambda x: curve(x[None, :])[1][0], [1.0, 0.0], xtol=1e-15, ftol=1e-15, gtol=1e-15)
    assert found == pytest.approx(np.tile(other.x, (20, 1)), abs=1e-7)
    assert cost == pytest.approx(np.full(20, 2.0 * other.cost), rel=1e-12)
    assert taken < 60


def test_a_row_does_not_see_its_neighbours_and_one_that_opens_stays() -> None:
    starts = np.array([[0.3, -2.0], [4.0, 0.5], [np.nan, 0.0]])
    together = descend(curve, step, starts, 12)[0]
    for row, start in zip(together, starts, strict=True):
        alone = descend(curve, step, start[None, :], 12)[0][0]
        assert row == pytest.approx(alone, rel=1e-9, nan_ok=True)


@pytest.mark.parametrize("scaled", [True, False])
def test_a_step_is_that_of_the_normal_equations(scaled: bool) -> None:
    rng = np.random.default_rng(2)
    slopes, value, damping = rng.normal(size=(3, 8, 4)), rng.normal(size=(3, 8)), np.array([1e-3, 0.1, 10.0])
    free = np.ones((3, 4), dtype=bool)
    free[1, 2] = False
    found = damped(slopes, value, damping, free=free, scaled=scaled)
    for row, j, v, d, f in zip(found, slopes, value, damping, free, strict=True):
        square, slope = j.T[f] @ j[:, f], j.T[f] @ v
        size = np.diag(square)
        square = square + d * np.diag(size + 1e-3 * size.max() if scaled else np.ones_like(size))
        assert row[f] == pytest.approx(-np.linalg.solve(square, slope), rel=1e-9)
        assert np.all(row[~f] == 0.0)
