"""The four-bar over arrays.

Tolerances, EPS = 2^-52, dev = min(gamma, pi - gamma):
* against the scalar functions, whose sines and cosines are those of another library: 8 EPS/dev in angles, in rates
  twice the 8 EPS/dev^2 and 32 EPS/dev^2 of the largest one that test_fourbar grants each of the two; in jerks of the
  largest of their summands w^3 and 3 w a too;
* directions against mpmath: 4 EPS times the condition 1/dev (at least 1) and the rounding of the angle, rates as above;
* mirror and period: the same multiples.
"""

from __future__ import annotations

import itertools
import json
import math
from pathlib import Path

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.closing import assembles
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages.fourbar import position as fourbar
from gearlink.core.parts.linkages.fourbar import sweep as sweep
from gearlink.core.parts.linkages.fourbar.loop import closing_range
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState

EPS = 2.0**-52
REFERENCE = Path(__file__).parents[2] / "reference"
CRANK_ROCKER = FourBar(18.0, 50.0, 100.0, 121.4)
DRAG_LINK = FourBar(50.0, 45.0, 48.0, 20.0)
DOUBLE_ROCKER = FourBar(150.0, 160.0, 100.0, 300.0)
LINKAGES = [
    CRANK_ROCKER,
    FourBar(18.0, 50.0, 100.0, 121.4, -1),
    DRAG_LINK,
    FourBar(50.0, 45.0, 48.0, 20.0, -1),
    DOUBLE_ROCKER,
]


def angles_of(linkage: FourBar, count: int) -> np.ndarray:
    """Several turns of a full crank, or the inside of the range."""
    _, high = closing_range(linkage.reading)
    if linkage.turns_fully():
        return np.linspace(-10.0, 10.0, count)
    return np.linspace(-high, high, count + 2)[1:-1]


def compare(linkage: FourBar, got: object, states: list[object], angle_names: tuple[str, str]) -> None:
    gamma = got.transmission_angle
    dev = np.minimum(gamma, np.pi - gamma)
    for name in got._fields:
        want = np.array([getattr(state, name) for state in states])
        error = np.abs(getattr(got, name) - want)
        if name in angle_names or name == "transmission_angle":
            assert np.all(error <= 8 * EPS / dev + 2 * EPS * np.abs(want)), name
        else:
            kind = name.split("_")[1]
            factor = 16 if kind == "velocity" else 64
            pair = [np.abs([getattr(s, f"{link.split('_')[0]}_{kind}") for s in states]) for link in angle_names]
            if kind == "jerk":  # a sum of products of lower rates, which may cancel
                for link in angle_names:
                    w, a = (getattr(got, f"{link.split('_')[0]}_{rate}") for rate in ("velocity", "acceleration"))
                    pair += [np.abs(w) ** 3, 3.0 * np.abs(w * a)]
            assert np.all(error <= factor * EPS / dev**2 * np.maximum(1.0, np.max(pair, axis=0))), name


@pytest.mark.parametrize("linkage", LINKAGES)
def test_sweep_and_scalar_agree(linkage: FourBar) -> None:
    phi = angles_of(linkage, 400)
    motion = {"velocity": 1.5 + np.sin(phi), "acceleration": np.cos(phi), "jerk": -0.25}
    got = sweep.solve(linkage, phi, 3, **motion)
    given = zip(phi.tolist(), motion["velocity"].tolist(), motion["acceleration"].tolist(), strict=True)
    states = [fourbar.solve(linkage, x, 3, velocity=v, acceleration=a, jerk=-0.25) for x, v, a in given]
    compare(linkage, got, states, ("coupler_angle", "rocker_angle"))


@pytest.mark.quick(3)
@pytest.mark.parametrize("linkage", LINKAGES)
def test_inverse_sweep_and_scalar_agree(linkage: FourBar) -> None:
    psi = sweep.solve(linkage, angles_of(linkage, 300)).rocker_angle
    psi = psi[np.sin(sweep.solve_inverse(linkage, psi).transmission_angle) > 1e-3]
    got = sweep.solve_inverse(linkage, psi, 3, velocity=2.0, acceleration=-1.0, jerk=np.cos(psi))
    given = zip(psi.tolist(), np.cos(psi).tolist(), strict=True)
    states = [fourbar.solve_inverse(linkage, x, 3, velocity=2.0, acceleration=-1.0, jerk=j) for x, j in given]
    compare(linkage, got, states, ("crank_angle", "coupler_angle"))


@pytest.mark.parametrize("assembly", [1, -1])
def test_inverse_of_a_drag_link_returns_the_crank_with_its_turns(assembly: int) -> None:
    linkage = FourBar(50.0, 45.0, 48.0, 20.0, assembly)
    phi = np.linspace(-30.0, 30.0, 1001)
    there = sweep.solve(linkage, phi, 2)
    back = sweep.solve_inverse(
        linkage, there.rocker_angle, 2, velocity=there.rocker_velocity, acceleration=there.rocker_acceleration
    )
    assert np.max(np.abs(back.crank_angle - phi)) <= 64 * EPS  # angles of 30 rad are rounded to 16 EPS
    assert np.max(np.abs(back.coupler_angle - there.coupler_angle)) <= 64 * EPS
    assert np.max(np.abs(back.crank_velocity - 1.0)) <= 128 * EPS
    assert np.max(np.abs(back.crank_acceleration)) <= 512 * EPS


@pytest.mark.quick(2)
@pytest.mark.parametrize("linkage", LINKAGES)
def test_directions_and_rates_against_mpmath(linkage: FourBar) -> None:
    phi = np.append(angles_of(linkage, 40), [0.0, 1e-8])
    if linkage.turns_fully():
        phi = np.append(phi, [math.pi, -math.pi, 3.0 * math.pi, math.pi - 1e-8, math.pi / 2])
    got = sweep.solve(linkage, phi, 2)
    rows = np.array(
        [
            *(np.cos(got.coupler_angle), np.sin(got.coupler_angle), np.cos(got.rocker_angle), np.sin(got.rocker_angle)),
            *(got.coupler_velocity, got.rocker_velocity, got.coupler_acceleration, got.rocker_acceleration),
        ]
    )
    a, b, c, d, s = (mp.mpf(x) for x in linkage.reading[:5])
    with mp.workdps(40):
        for i, x in enumerate(phi):
            pivot = d - a * mp.expj(mp.mpf(x))
            n2 = abs(pivot) ** 2
            h = (n2 + b * b - c * c) / (2 * n2)
            height = mp.sqrt(b * b / n2 - h * h)
            e_b = pivot * mp.mpc(h, s * height) / b
            e_c = pivot * mp.mpc(h - 1, s * height) / c
            gamma = mp.acos((b * b + c * c - n2) / (2 * b * c))
            e_a, sine = mp.expj(mp.mpf(x)), mp.im(e_c * mp.conj(e_b))
            w_b, w_c = a * mp.im(e_a * mp.conj(e_c)) / (b * sine), a * mp.im(e_a * mp.conj(e_b)) / (c * sine)
            cos = mp.re(e_c * mp.conj(e_b))
            a_b = (a * mp.re(e_a * mp.conj(e_c)) + b * w_b**2 * cos - c * w_c**2) / (b * sine)
            a_c = (a * mp.re(e_a * mp.conj(e_b)) + b * w_b**2 - c * w_c**2 * cos) / (c * sine)
            dev = min(1.0, float(gamma), float(mp.pi - gamma))
            for row, true in enumerate((e_b.real, e_b.imag, e_c.real, e_c.imag)):
                angle = abs((got.coupler_angle, got.rocker_angle)[row // 2][i])  # is rounded itself
                assert abs(rows[row, i] - float(true)) <= 4 * EPS / dev + EPS * angle
            for pair, factor, row in (((w_b, w_c), 8, 4), ((a_b, a_c), 32, 6)):
                limit = factor * EPS / dev**2 * max(1.0, *(abs(float(y)) for y in pair))
                for k in (0, 1):
                    assert abs(rows[row + k, i] - float(pair[k])) <= limit


def test_example_three_of_the_thesis() -> None:
    cases = json.loads((REFERENCE / "gear_linkage.json").read_text())["cases"]
    case = next(c for c in cases if c["id"] == "ex3_kinematics")
    linkage = FourBar(*(float(case["inputs"][k]) for k in "abcd"))
    table = np.array(case["outputs"]["rows"])
    got = sweep.solve(linkage, np.radians(table[:, 0]), 2)
    assert np.degrees(got.rocker_angle) == pytest.approx(table[:, 2], abs=1e-13)
    for name, column in (("coupler_velocity", 3), ("rocker_velocity", 4)):
        assert getattr(got, name) == pytest.approx(table[:, column], abs=4 * EPS)
    for name, column in (("coupler_acceleration", 5), ("rocker_acceleration", 6)):
        assert getattr(got, name) == pytest.approx(table[:, column], abs=8 * EPS)


@pytest.mark.quick(2)
@pytest.mark.parametrize("linkage", LINKAGES[:4])
def test_angles_are_continuous_over_several_turns(linkage: FourBar) -> None:
    phi = np.radians(np.arange(-1080.0, 1081.0))
    got = sweep.solve(linkage, phi, 1)
    winding = 1.0 if linkage.crank > linkage.frame else 0.0
    for name in ("coupler", "rocker"):
        angle, w = getattr(got, f"{name}_angle"), np.abs(getattr(got, f"{name}_velocity"))
        step = 1.1 * np.radians(1.0) * np.maximum(0.05, np.maximum(w[1:], w[:-1]))
        assert np.all(np.abs(np.diff(angle)) <= step)
        assert angle[360:] - angle[:-360] == pytest.approx(np.full(1801, math.tau * winding), abs=64 * EPS)


@examples(60)
@given(st.tuples(*[st.floats(10.0, 200.0)] * 4), st.sampled_from([1, -1]))
def test_the_loop_closes_for_any_linkage_that_does(lengths: tuple[float, ...], assembly: int) -> None:
    linkage = FourBar(*lengths, assembly)
    if linkage.kind() == "impossible":
        assert not assembles(linkage, np.linspace(-4.0, 4.0, 101)).any()
        return
    phi = np.linspace(-4.0, 4.0, 100)  # without 0, where B may fall on D
    phi = phi[assembles(linkage, phi)]
    got = sweep.solve(linkage, phi)
    dev = np.maximum(np.minimum(got.transmission_angle, np.pi - got.transmission_angle), 1e-8)
    b_x, b_y = np.cos(got.coupler_angle), np.sin(got.coupler_angle)
    c_x, c_y = np.cos(got.rocker_angle), np.sin(got.rocker_angle)
    x = linkage.crank * np.cos(phi) + linkage.coupler * b_x - linkage.frame - linkage.rocker * c_x
    y = linkage.crank * np.sin(phi) + linkage.coupler * b_y - linkage.rocker * c_y
    assert np.all(np.hypot(x, y) <= 8 * EPS / dev * sum(lengths))


def test_shapes_and_blocks() -> None:
    phi = np.linspace(0.0, 6.0, 2 * sweep.BLOCK + 77)
    rows = np.array(list(sweep.solve(CRANK_ROCKER, phi, 3)))
    for i in (0, sweep.BLOCK - 1, sweep.BLOCK, 2 * sweep.BLOCK + 76):
        alone = np.array(list(sweep.solve(CRANK_ROCKER, phi[i : i + 1], 3)))[:, 0]
        assert rows[:, i] == pytest.approx(alone, rel=16 * EPS)
    grid = phi[:24].reshape(2, 3, 4)
    got = sweep.solve(CRANK_ROCKER, grid.transpose(), 1)
    assert got.rocker_angle.shape == (4, 3, 2)
    assert np.array_equal(got.rocker_velocity.transpose(), sweep.solve(CRANK_ROCKER, grid, 1).rocker_velocity)
    assert sweep.solve(CRANK_ROCKER, 0.5).rocker_angle.shape == ()
    assert sweep.solve(CRANK_ROCKER, np.empty(0), 2).rocker_acceleration.shape == (0,)
    assert math.isnan(got.rocker_acceleration)
    assert sweep.solve(CRANK_ROCKER, [[1.0], [2.0]], 1, velocity=[1.0, 2.0, 3.0]).rocker_velocity.shape == (2, 3)


def test_the_order_of_the_rates_is_zero_to_three() -> None:
    for order in (-1, 4):
        with pytest.raises(ValueError, match=f"order is {order}"):
            sweep.solve(CRANK_ROCKER, 0.0, order)


def test_refusal_names_the_first_angle_that_does_not_close() -> None:
    phi = np.radians(np.arange(0.0, 91.0))
    assert assembles(DOUBLE_ROCKER, phi).sum() == 61
    with pytest.raises(NoSolution, match="the four-bar does not close at crank angle"):
        sweep.solve(DOUBLE_ROCKER, phi)
    with pytest.raises(NoSolution, match="the four-bar is in a dead centre at crank angle"):
        sweep.solve(FourBar(40.0, 90.0, 40.0, 90.0), phi, 1)
    assert sweep.solve(FourBar(40.0, 90.0, 40.0, 90.0), phi).rocker_angle == pytest.approx(phi, abs=4 * EPS)
    with pytest.raises(NoSolution, match="position is not determined"):
        sweep.solve(FourBar(50.0, 70.0, 70.0, 50.0), phi)
    with pytest.raises(NoSolution, match="the four-bar does not close at rocker angle"):
        sweep.solve_inverse(CRANK_ROCKER, phi)
    for bad in (math.nan, math.inf):
        with pytest.raises(NoSolution, match="must be finite"):
            sweep.solve(CRANK_ROCKER, [0.0, bad])


def test_every_order_gives_the_same_lower_rates() -> None:
    phi = np.linspace(0.0, 6.0, 50)
    names = FourBarState._fields
    full = sweep.solve(DRAG_LINK, phi, 3)
    for order, count in itertools.pairwise((0, 1, 2, 3)):
        part = sweep.solve(DRAG_LINK, phi, order)
        assert all(np.array_equal(getattr(part, n), getattr(full, n)) for n in names[: 3 + 2 * order])
        assert all(math.isnan(getattr(part, n)) for n in names[1 + 2 * count :])


@pytest.mark.parametrize("assembly", [1, -1])
@pytest.mark.parametrize("lengths", [(4.0, 7.0, 1.0, 2.0), (3.0, 5.0, 1.0, 1.0), (8.0, 2.0, 3.0, 3.0)])
def test_a_linkage_that_is_only_stretched_or_folded_lies_on_its_line(lengths: tuple[float, ...], assembly: int) -> None:
    """It closes at one rocker angle alone, with P or Q exactly 0: a product of 0 and a negative factor."""
    linkage = FourBar(*lengths, assembly=assembly)
    a, b, c, d = lengths
    one, many = fourbar.solve_inverse(linkage, 0.0), sweep.solve_inverse(linkage, np.array([0.0]))
    for crank, coupler in ((one.crank_angle, one.coupler_angle), (many.crank_angle[0], many.coupler_angle[0])):
        reach = a * math.cos(crank) + b * math.cos(coupler)
        assert reach == pytest.approx(d + c, abs=16.0 * EPS * (a + b + c + d))
    assert many.crank_angle[0] == pytest.approx(one.crank_angle, abs=8.0 * EPS)
    assert many.coupler_angle[0] == pytest.approx(one.coupler_angle, abs=8.0 * EPS)
