"""Roots of many functions at once: to a few ulp, each by itself."""

from __future__ import annotations

from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.roots_sweep import bracketed_roots, newton_places, root_between

RNG = np.random.default_rng(3)


@pytest.mark.parametrize("power", [1, 3, 9])
def test_roots_are_those_of_one_at_a_time(power: int) -> None:
    at = RNG.uniform(0.2, 0.9, 300)
    found = bracketed_roots(lambda x: np.sin(x - at) * (1.0 + x**power), np.zeros(300), np.ones(300))
    alone = [bracketed_root(lambda x, a=a: float(np.sin(x - a) * (1.0 + x**power)), 0.0, 1.0) for a in at]
    assert np.abs(found - alone).max() < 4e-16
    assert np.abs(found - at).max() < 4e-16


def test_a_root_does_not_depend_on_the_others() -> None:
    at = RNG.uniform(-2.0, 2.0, 200)
    whole = bracketed_roots(
        lambda x: np.tanh(5.0 * (x - at)) + 0.1 * (x - at) ** 3, np.full(200, -3.0), np.full(200, 3.0)
    )
    for k in range(0, 200, 17):
        one = at[k : k + 1]
        found = bracketed_roots(
            lambda x, a=one: np.tanh(5.0 * (x - a)) + 0.1 * (x - a) ** 3, np.full(1, -3.0), np.full(1, 3.0)
        )
        assert found[0] == whole[k]


def test_ends_that_are_roots_and_brackets_that_are_none() -> None:
    low, high = np.array([0.0, -1.0, 0.0, 1.0, -1.0]), np.array([1.0, 0.0, np.nan, 2.0, np.nan])
    found = bracketed_roots(lambda x: x, low, high)
    assert found[:3].tolist() == [0.0, 0.0, 0.0]
    assert np.isnan(found[3:]).all()


def test_a_jump_across_zero_is_found_and_no_number_is_no_root() -> None:
    """A regula falsi creeps towards a jump between values of one size, and cannot step from one without bound."""
    at = np.array([0.3, 0.7, 1e-9])
    found = bracketed_roots(lambda x: np.where(x < at, -1.0 - x, 0.9 + x), np.zeros(3), np.ones(3))
    assert np.abs(found - at).max() < 4e-16
    unbounded = bracketed_roots(lambda x: np.where(x < at, -np.inf, 1.0 + x), np.zeros(3), np.ones(3))
    assert np.abs(unbounded - at).max() < 4e-16
    ends = bracketed_roots(lambda x: np.where(np.abs(x - 0.5) < 0.2, np.nan, x - 0.5), np.zeros(1), np.ones(1))
    assert np.isnan(ends).all()


def test_values_at_the_ends_need_not_be_computed_again() -> None:
    asked: list[float] = []

    def f(x: np.ndarray) -> np.ndarray:
        asked.extend(x.tolist())
        return x * x - 2.0

    found = bracketed_roots(f, np.zeros(1), np.full(1, 2.0), ends=(np.full(1, -2.0), np.full(1, 2.0)))
    assert found.tolist() == [bracketed_root(lambda x: x * x - 2.0, 0.0, 2.0)]
    assert not {0.0, 2.0} & set(asked)


SHAPES = {
    "smooth": lambda x: np.exp(x) - 1.0,
    "steep": lambda x: np.tanh(40.0 * x),
    "flat": lambda x: x**3 + 0.001 * x,
    "a jump": lambda x: np.where(x > 0.0, 1.0, -2.0),
}


@pytest.mark.parametrize("shape", SHAPES)
def test_a_root_between_two_places_is_found_in_a_few_calls(shape: str) -> None:
    """It is 0.3, moved there, wherever the bracket ends; a jump takes as many calls as there are sixteenths to the last
    bit, others on average not three quarters of that: where rounding has the sign, as of the smooth one, the count
    depends on the processor's exponential function."""
    draw = np.random.default_rng(5)
    counts = []
    for low, high in zip(-draw.random(50), draw.random(50), strict=True):
        calls = []

        def moved(x: Any, calls: list[int] = calls) -> Any:
            calls.append(1)
            return SHAPES[shape](x - 0.3)

        found = root_between(moved, 0.3 + low, 0.3 + high)
        assert abs(found - 0.3) <= 4.0 * np.spacing(0.3)
        counts.append(len(calls))
    assert np.mean(counts) <= (14 if shape == "a jump" else 10)
    assert max(counts) <= 20


def test_a_root_between_places_of_one_sign_is_refused() -> None:
    with pytest.raises(NoSolution, match="no sign change between"):
        root_between(lambda x: x * x + 1.0, -1.0, 1.0)


def test_a_last_newton_step_below_a_billionth_is_not_confirmed() -> None:
    wanted, asked = np.array([2.0, 9.0, 0.0]), []

    def excess(x: Reals, rows: NDArray[np.intp]) -> tuple[Reals, Reals]:
        asked.append(rows.size)
        return x * x - wanted[rows], 2.0 * x + 1e-300

    start = np.sqrt(wanted) * (1.0 + 0.9e-9 * np.array([1.0, 0.0, 0.0]))
    found = newton_places(excess, start, 5.0)
    assert found is not None
    assert found == pytest.approx(np.sqrt(wanted), rel=4e-16, abs=0.0)
    assert asked == [3]
    asked.clear()
    start[0] *= 1.0 + 1e-6
    assert newton_places(excess, start, 5.0) == pytest.approx(np.sqrt(wanted), rel=4e-16, abs=0.0)
    assert asked == [3, 1]


def test_places_in_rows_rest_each_by_itself() -> None:
    wanted, asked = np.array([[2.0, 9.0, 0.25], [3.0, 16.0, 4.0]]), []

    def excess(x: Reals, columns: NDArray[np.intp]) -> tuple[Reals, Reals]:
        asked.append(columns.tolist())
        return x * x - wanted[:, columns], 2.0 * x

    start = np.sqrt(wanted) * np.array([[1.0, 1.0, 1.0], [1.0, 1.1, 1.0]])
    found = newton_places(excess, start, 5.0)
    assert found == pytest.approx(np.sqrt(wanted), rel=4e-16, abs=0.0)
    assert asked[0] == [0, 1, 2]
    assert set(map(tuple, asked[1:])) == {(1,)}
