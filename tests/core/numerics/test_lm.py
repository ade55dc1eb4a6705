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


def test_a_row_that_is_stuck_at_the_most_damping_is_asked_no_more() -> None:
    asked, bent = [], []

    def state(x: Reals, wanted: Reals) -> State:
        asked.append(len(x))
        return np.abs(x[:, 0] - wanted), x.copy()

    def slopes(x: Reals, known: State) -> State:
        bent.append(len(x))
        assert np.array_equal(x, known[1])
        return (2.0 * x[:, 0],)

    def step(x: Reals, state: State, _damping: Reals) -> Reals:
        assert np.array_equal(state[2], 2.0 * x[:, 0])
        return x + np.where(x < 10.0, 1.0, -0.1)  # the first goes the wrong way at any damping, the second gains

    starts = np.array([[5.0], [19.0]])
    found, (cost, place), damping, taken = descend(
        state, step, starts, 40, slopes=slopes, given=(np.array([1.0, 2.0]),), damping=1.0, most=16.0
    )
    assert taken == 40
    assert found[:, 0] == pytest.approx([5.0, 15.0], rel=1e-12)
    assert cost == pytest.approx([4.0, 13.0], rel=1e-12)
    assert np.array_equal(place, found)
    assert damping[0] == 16.0
    assert asked == [2] * 4 + [1] * 37
    assert bent == [2] + [1] * 40
    assert starts[1, 0] == 19.0


def test_a_descent_of_stuck_rows_alone_ends_as_one_without_gains_does() -> None:
    found, _, _, taken = descend(lambda x: (x[:, 0], x), lambda x, *_: x + 1.0, np.zeros((2, 1)), 50, damping=1e8)
    assert np.array_equal(found, np.zeros((2, 1)))
    assert taken == 6
