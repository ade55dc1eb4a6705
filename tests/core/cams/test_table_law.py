"""Laws through the points of a table.

Tolerances: the spline solves a well scaled system of blocks; each derivative costs a factor 1/h, here at most 1/0.02.
"""

from __future__ import annotations

from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.shaped import Phase, TableSpline

GRID = np.linspace(0.0, 1.0, 501)


def table(points: Any, *, to_speed: bool = False) -> Any:
    return law({"type": "table", "points": [list(point) for point in points]}, Phase(to_speed=to_speed))


@settings(max_examples=25)
@given(
    steps=st.lists(st.floats(0.2, 1.0), min_size=5, max_size=20),
    rises=st.lists(st.floats(0.0, 1.0), min_size=20, max_size=20),
    speed=st.sampled_from([0.0, 1.0]),
)
def test_it_is_the_collocated_b_spline(steps: list[float], rises: list[float], speed: float) -> None:
    from scipy.interpolate import make_interp_spline

    x = np.append(0.0, np.cumsum(steps) / np.sum(steps))
    x[-1] = 1.0
    s = np.append(0.0, np.cumsum(rises[: len(steps)]))
    ours = TableSpline(x, s, speed).derivatives(GRID, 0, 4)
    ends = ([(1, 0.0), (2, 0.0)], [(1, speed), (2, 0.0)])
    other = make_interp_spline(x, s, k=5, bc_type=ends)
    for order, values in enumerate(ours):
        expected = other(GRID, order)
        size = 1.0 + float(np.abs(expected).max())
        np.testing.assert_allclose(values, expected, rtol=0.0, atol=1e-9 * size)


def test_a_polynomial_of_degree_five_is_given_back() -> None:
    x = np.linspace(0.0, 1.0, 9)
    named = law("polynomial-345")
    made = table(zip(x.tolist(), named.evaluate(x, 0)[0].tolist(), strict=True))
    for ours, theirs in zip(made.evaluate(GRID, 3), named.evaluate(GRID, 3), strict=True):
        np.testing.assert_allclose(ours, theirs, rtol=0.0, atol=1e-11)
    assert made.kind == "rest-to-rest"
    assert (made.peak_velocity, made.peak_acceleration) == pytest.approx(
        (named.peak_velocity, named.peak_acceleration), rel=1e-10
    )


def test_rest_to_speed_takes_its_last_rise_from_the_table() -> None:
    x = np.linspace(0.0, 1.0, 21)
    named = law("velocity-345")
    made = table(zip(x.tolist(), named.evaluate(x, 0)[0].tolist(), strict=True), to_speed=True)
    assert made.kind == "rest-to-speed"
    assert made.kappa == pytest.approx(0.5, rel=1e-14)
    np.testing.assert_allclose(made.evaluate(GRID, 1), named.evaluate(GRID, 1), rtol=0.0, atol=1e-5)


@pytest.mark.parametrize(
    ("points", "words"),
    [
        ([[0, 0], [0.5, 0.5], [1, 1]], "at least 6"),
        ([[0, 0], [0.2, 0], [0.1, 0.1], [0.5, 0.5], [0.8, 0.9], [1, 1]], "ascends"),
        ([[0.1, 0], [0.2, 0], [0.3, 0.1], [0.5, 0.5], [0.8, 0.9], [1, 1]], "from 0 to 1"),
        ([[0, 0.1], [0.2, 0.1], [0.3, 0.1], [0.5, 0.5], [0.8, 0.9], [1, 1]], "first s"),
        ([[0, 0], [0.2, 0.1], [0.3, 0.1], [0.5, 0.5], [0.8, 0.9], [1, 0.9]], "last s"),
    ],
)
def test_points_that_are_no_law_are_refused(points: Any, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as refused:
        table(points)
    assert refused.value.key.startswith("points")


@pytest.mark.parametrize(("dent", "status"), [(0.5, "pass"), (-0.2, "warn")])
def test_a_law_that_turns_back_is_warned_of(dent: float, status: str) -> None:
    x = np.linspace(0.0, 1.0, 9)
    rise = law("polynomial-345").evaluate(x, 0)[0]
    rise[3] = rise[2] + dent * (rise[4] - rise[2])
    points = [list(point) for point in zip(x.tolist(), rise.tolist(), strict=True)]
    design = factory.design("swing_gripper", laws__return={"type": "table", "points": points})
    (found,) = design.check("law-ripple")
    least = float(design.law.return_.evaluate(np.linspace(0.0, 1.0, 20_001), 1)[1].min())
    assert (found.code, found.status) == ("GL422", status)
    assert found.value == pytest.approx(least, abs=1e-5)
