"""The four-bar's vector loop by Newton-Raphson, and its rates.

Tolerances, EPS = 2^-52, dev = min(gamma, pi - gamma):
* Newton against the closed form: both carry 8 EPS/dev, so 16 EPS/dev, and an ulp of angles that wound beyond pi;
* rates from the vector loop against those of the triangle: 16 and 64 EPS/dev^2 of the largest, two errors as well;
* the recorded error history: computed with binary angles and a residual of 106 bits, so an error e is seen to EPS; it
  must match to 4 EPS plus 1e-9 of itself.
"""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.vector_loop import exact_angles, loop_rates
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.loop import closing_range
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import loop_step

EPS = 2.0**-52
REFERENCE = Path(__file__).parents[2] / "reference"
SWING = {case["id"]: case for case in json.loads((REFERENCE / "swing_gripper.json").read_text())["cases"]}
FORWARD = [name for name in SWING if name.startswith(("FB-", "TOG-"))]
CRANK_ROCKER = FourBar(18.0, 50.0, 100.0, 121.4)
DRAG_LINK = FourBar(50.0, 45.0, 48.0, 20.0, -1)
STRETCHING = FourBar(150.0, 160.0, 100.0, 300.0)
FOLDING = FourBar(90.0, 160.0, 100.0, 140.0)


def newton_step(linkage: FourBar, phi: float, b: float, c: float) -> tuple[Any, Any, Any]:
    """What to add to the angles of coupler and rocker, and |r| before."""
    return loop_step(linkage, phi, b, c)[:3]


def case_of(name: str) -> tuple[FourBar, float, dict[str, float], dict[str, float]]:
    given_, expected = SWING[name]["inputs"], {k: float(v) for k, v in SWING[name]["expected"].items()}
    linkage = FourBar(given_["l1"], given_["l3"], given_["l4"], given_["l0"], given_["branch"])
    return linkage, given_["theta1"] - given_["theta0"], given_, expected


# order of convergence


def test_recorded_error_history() -> None:
    """NEW-01: the errors from offsets (+1/16, -1/32), until they vanish below the rounding of the angles."""
    linkage, phi, _, _ = case_of("FB-01")
    record, (true_b, true_c) = SWING["NEW-01"], exact_angles(linkage, phi)
    b, c = float(true_b) + record["inputs"]["offset3"], float(true_c) + record["inputs"]["offset4"]
    for n in range(4):
        for got, true, name in ((b, true_b, "err3"), (c, true_c, "err4")):
            error, want = float(mp.mpf(got) - true), float(record["expected"][f"{name}_{n}"])
            assert error == pytest.approx(want, abs=4 * EPS, rel=1e-9)
        d_b, d_c, _ = newton_step(linkage, phi, b, c)
        b, c = b + float(d_b), c + float(d_c)


@examples(60)
@given(st.floats(0.0, 6.28), st.floats(-1.0, 1.0), st.floats(0.2, 1.0))
def test_error_law_of_one_step(phi: float, x: float, y: float) -> None:
    """|e'|/|e|^2 tends to the constant of the Jacobian's derivative, for both unknowns."""
    linkage, h = CRANK_ROCKER, 1e-3
    true = fourbar.solve(linkage, phi)
    b, c = true.coupler_angle + h * x, true.rocker_angle + h * y
    d_b, d_c, _ = newton_step(linkage, phi, b, c)
    turn = true.coupler_angle - true.rocker_angle
    law_b = (50.0 * math.cos(turn) * x * x - 100.0 * y * y) / (2.0 * 50.0 * math.sin(turn))
    law_c = (100.0 * math.cos(turn) * y * y - 50.0 * x * x) / (-2.0 * 100.0 * math.sin(turn))
    # The next order is some h of this one; gamma stays between 54 and 143 deg here.
    assert (h * x + float(d_b)) / h**2 == pytest.approx(law_b, abs=20 * h)
    assert (h * y + float(d_c)) / h**2 == pytest.approx(law_c, abs=20 * h)


@examples(200)
@given(st.floats(0.05, 0.95), st.floats(0.0, 6.28), st.booleans(), st.sampled_from([1, -1]))
def test_every_safe_start_converges_to_its_own_assembly(
    share: float, way: float, stretching: bool, assembly: int
) -> None:
    base = STRETCHING if stretching else FOLDING
    linkage = FourBar(base.crank, base.coupler, base.rocker, base.frame, assembly)
    low, high = closing_range(linkage.reading)
    phi = low + share * (high - low)
    true = fourbar.solve(linkage, phi)
    g = min(true.transmission_angle, math.pi - true.transmission_angle)
    reach = 1.0  # farther than is safe; then drawn in until it just is
    start = (0.0, 0.0)
    while True:
        start = (true.coupler_angle + reach * math.cos(way), true.rocker_angle + reach * math.sin(way))
        if fourbar_sweep.start_is_safe(linkage, phi, *start):
            break
        reach *= 0.9
    found = fourbar_sweep.polish(linkage, phi, *start)
    assert int(found.iterations) <= 8
    assert abs(float(found.coupler_angle) - true.coupler_angle) <= 16 * EPS / g
    assert abs(float(found.rocker_angle) - true.rocker_angle) <= 16 * EPS / g


def test_exact_dead_point_converges_by_halves_and_stalls_at_root_eps() -> None:
    linkage = FourBar(40.0, 60.0, 30.0, 50.0)  # stretched at phi = pi: 40 + 50 = 60 + 30
    b, c, errors = 0.02, math.pi - 0.03, []
    for _ in range(40):
        d_b, d_c, _ = newton_step(linkage, math.pi, b, c)
        b, c = b + float(d_b), c + float(d_c)
        errors.append(max(abs(b), abs(c - math.pi)))
        if errors[-1] < 2e-8:
            break
    ratios = [after / before for before, after in itertools.pairwise(errors[3:15])]
    assert ratios == pytest.approx([0.5] * len(ratios), abs=0.02)
    assert min(errors) > 1e-9


# agreement with the closed form


@pytest.mark.parametrize("linkage", [CRANK_ROCKER, DRAG_LINK, STRETCHING, FOLDING])
def test_sweeps_agree_with_the_closed_form(linkage: FourBar) -> None:
    low, high = closing_range(linkage.reading)
    phi = np.linspace(-7.0, 7.0, 281) if linkage.turns_fully() else np.linspace(low, high, 203)[1:-1]
    found, closed = fourbar_sweep.solve_by_newton(linkage, phi), fourbar_sweep.solve(linkage, phi)
    dev = np.asarray(fourbar_sweep.dead_point_distance(closed.transmission_angle))
    for name in ("coupler_angle", "rocker_angle"):
        want = getattr(closed, name)
        assert np.all(np.abs(getattr(found, name) - want) <= 16 * EPS / dev + 2 * EPS * np.abs(want))
    assert found.iterations.min() >= 1
    assert found.iterations.mean() <= 4.0
    assert np.all(found.residual <= 16 * EPS * 8.0 * 710.0)


def test_shape_and_order_of_the_angles_are_kept() -> None:
    phi = np.radians([[300.0, 45.0, 0.0], [720.0, -90.0, 1.0]])
    found, closed = fourbar_sweep.solve_by_newton(CRANK_ROCKER, phi), fourbar_sweep.solve(CRANK_ROCKER, phi)
    assert found.rocker_angle == pytest.approx(closed.rocker_angle, abs=32 * EPS)
    assert found.iterations.shape == found.residual.shape == (2, 3)
    assert fourbar_sweep.solve_by_newton(CRANK_ROCKER, []).rocker_angle.shape == (0,)
    assert fourbar_sweep.solve_by_newton(CRANK_ROCKER, 1.0).rocker_angle.shape == ()


@pytest.mark.parametrize("name", FORWARD)
def test_rates_of_the_vector_loop(name: str) -> None:
    linkage, phi, given_, expected = case_of(name)
    state = fourbar.solve(linkage, phi)
    rates = loop_rates(
        linkage,
        phi,
        state.coupler_angle,
        state.rocker_angle,
        3,
        velocity=given_["omega1"],
        acceleration=given_["alpha1"],
        jerk=given_["jerk1"],
    )
    dev = min(expected["gamma"], math.pi - expected["gamma"])
    for i, (symbol, factor) in enumerate((("omega", 8), ("alpha", 32), ("jerk", 32))):
        pair = expected[f"{symbol}3"], expected[f"{symbol}4"]
        limit = factor * EPS / dev**2 * max(abs(x) for x in pair)
        for k in (0, 1):
            assert abs(float(rates[2 * i + k]) - pair[k]) <= limit


@pytest.mark.parametrize("linkage", [CRANK_ROCKER, DRAG_LINK])
def test_rates_of_loop_and_triangle_agree(linkage: FourBar) -> None:
    phi = np.linspace(0.0, 6.28, 157)
    closed = fourbar_sweep.solve(linkage, phi, 3)
    rates = loop_rates(linkage, phi, closed.coupler_angle, closed.rocker_angle, 3)
    dev = np.asarray(fourbar_sweep.dead_point_distance(closed.transmission_angle))
    for i, (kind, factor) in enumerate((("velocity", 16), ("acceleration", 64), ("jerk", 64))):
        pair = [getattr(closed, f"{link}_{kind}") for link in ("coupler", "rocker")]
        limit = factor * EPS / dev**2 * np.maximum(1.0, np.maximum(*np.abs(pair)))
        for k in (0, 1):
            assert np.all(np.abs(rates[2 * i + k] - pair[k]) <= limit)


# failures


def test_start_on_the_wrong_side_is_not_safe_and_its_result_refused() -> None:
    mirror = fourbar.solve(FourBar(18.0, 50.0, 100.0, 121.4, -1), 1.0)
    start = mirror.coupler_angle, mirror.rocker_angle
    assert not fourbar_sweep.start_is_safe(CRANK_ROCKER, 1.0, *start)
    with pytest.raises(NoSolution, match=r"no position of assembly \+1 at crank angle 57"):
        fourbar_sweep.polish(CRANK_ROCKER, 1.0, *start)


def test_no_position_beyond_the_limit() -> None:
    with pytest.raises(NoSolution, match=r"Newton-Raphson found no position of assembly \+1 at crank angle"):
        fourbar_sweep.polish(STRETCHING, 1.3, 0.0, 3.0)
    with pytest.raises(NoSolution, match=r"does not close at crank angle"):
        fourbar_sweep.solve_by_newton(STRETCHING, [0.5, 1.0, 1.2])
    with pytest.raises(NoSolution, match=r"does not close at crank angle"):
        fourbar_sweep.solve_by_newton(FOLDING, np.radians([45.0, 10.0]))


def test_dead_points_are_refused_where_a_step_is_wanted() -> None:
    with pytest.raises(NoSolution, match="coupler and rocker align"):
        loop_rates(FourBar(40.0, 90.0, 40.0, 90.0), 0.0, 0.0, 0.0)
