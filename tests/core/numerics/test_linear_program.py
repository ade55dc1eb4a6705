"""The linear program against scipy's, which is another build of the same solver with other settings, and by hand."""

from __future__ import annotations

import subprocess
import sys

import numpy as np
import pytest
from scipy.optimize import linprog

from gearlink.core.numerics.linear_program import least


@pytest.mark.quick(8)
@pytest.mark.parametrize("seed", range(20))
def test_a_least_is_that_of_the_interior_point_method(seed: int) -> None:
    rng = np.random.default_rng(seed)
    rows = rng.normal(size=(60, 6)) * (rng.random((60, 6)) < 0.7)
    cost, limits = rng.normal(size=6), rng.random(60) + 0.1  # x = 0 is within all limits
    lower, upper = np.full(6, -1.0), np.array([1.0, 1.0, 1.0, 1.0, np.inf, 0.5])
    other = linprog(cost, rows, limits, bounds=list(zip(lower, upper, strict=True)), method="highs-ipm")
    found = least(cost, rows, limits, lower, upper)
    if not other.success:  # unbounded in the fifth direction
        assert found is None
        return
    assert found is not None
    again = least(cost, rows, limits, lower, upper, found)
    moved = least(cost, rows, limits + 0.1 * rng.random(60), lower, upper)
    nearby = least(cost, rows, limits, lower, upper, moved)  # from the basis of a like program
    for each in (found, again, nearby):
        assert each is not None
        assert cost @ each.x == pytest.approx(other.fun, abs=1e-7)
        assert np.all(rows @ each.x <= limits + 1e-7)
        assert np.all((each.x >= lower - 1e-7) & (each.x <= upper + 1e-7))


def test_of_two_sides_the_nearer_holds() -> None:
    found = least(
        np.array([-1.0, 1.0]), np.array([[1.0, 1.0], [1.0, 0.0]]), np.array([4.0, 3.0]), np.zeros(2), np.full(2, np.inf)
    )
    assert found is not None
    assert found.x.tolist() == [3.0, 0.0]
    fewer = least(np.array([-1.0, 1.0]), np.ones((1, 2)), np.array([4.0]), np.zeros(2), np.full(2, np.inf), found)
    assert fewer is not None
    assert fewer.x.tolist() == [4.0, 0.0]


@pytest.mark.parametrize(("limits", "lower"), [([-1.0, 0.5], 0.0), ([1.0, 1.0], -np.inf)])
def test_where_there_is_none_is_none(limits: list[float], lower: float) -> None:
    assert least(np.ones(1), np.array([[1.0], [0.5]]), np.array(limits), np.array([lower]), np.array([np.inf])) is None


@pytest.mark.slow
def test_another_user_of_the_solver_may_have_set_its_threads() -> None:
    code = (
        "import highspy, numpy as np\n"
        "from gearlink.core.numerics.linear_program import least\n"
        "other = highspy.Highs(); other.setOptionValue('output_flag', False)\n"
        "other.setOptionValue('threads', 3); other.addVar(0, 1); other.run()\n"
        "print(least(np.ones(1), np.ones((1, 1)), np.ones(1), np.full(1, 0.25), np.ones(1)).x)\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert done.stdout.endswith("[0.25]\n")  # the other solver may have named itself


def test_the_solver_prints_nothing() -> None:
    """Results go to standard output: with the solver's name among them they were no JSON."""
    code = (
        "import numpy as np\n"
        "from gearlink.core.numerics.linear_program import least\n"
        "least(np.ones(1), np.ones((1, 1)), np.ones(1), np.full(1, 0.25), np.ones(1))\n"
    )
    done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True)
    assert (done.stdout, done.stderr) == ("", "")
