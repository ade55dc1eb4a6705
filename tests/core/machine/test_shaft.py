"""The main shaft: natural frequencies by mpmath, published ones, and the swing against integration over time."""

from __future__ import annotations

import itertools
import math
from typing import Any

import mpmath
import numpy as np
import pytest
from machines import FEED, ROCKER, cam, machine, of
from pydantic import ValidationError
from scipy.integrate import solve_ivp

from gearlink.core.base.spec_paths import changed
from gearlink.core.base.wording import amount
from gearlink.core.machines.machine.loads import MachineLoads
from gearlink.core.machines.machine.shaft import Chain, Swing, stiffened
from gearlink.core.machines.machine.spec import MainShaft

CHAINS = [
    ([5.0, 11.0, 22.0], [1e5, 2e5]),
    ([0.8, 0.05, 0.31, 4.0], [9e3, 1.5e4, 3e2]),
    ([1e-3, 30.0, 2.0, 1e-2, 5.0], [1e2, 1e9, 4e5, 1e3]),
]


@pytest.mark.parametrize(("inertias", "stiffnesses"), CHAINS)
@pytest.mark.parametrize("fixed", [False, True])
def test_frequencies_and_shapes_against_forty_digits(
    inertias: list[float], stiffnesses: list[float], *, fixed: bool
) -> None:
    chain = Chain(np.array(inertias), np.array(stiffnesses), fixed)
    n = len(inertias)
    with mpmath.workdps(40):
        stiff = mpmath.zeros(n, n)
        for i, c in enumerate(stiffnesses):
            for a, b, sign in ((i, i, 1), (i + 1, i + 1, 1), (i, i + 1, -1), (i + 1, i, -1)):
                stiff[a, b] += sign * mpmath.mpf(c)
        first = 1 if fixed else 0
        root = [mpmath.sqrt(mpmath.mpf(each)) for each in inertias[first:]]
        scaled = mpmath.matrix(n - first, n - first)
        for a, b in itertools.product(range(n - first), repeat=2):
            scaled[a, b] = stiff[a + first, b + first] / root[a] / root[b]
        squares, vectors = mpmath.eigsy(scaled)
        modes = range(0 if fixed else 1, n - first)
        want = [float(mpmath.sqrt(squares[k])) for k in modes]
        last = n - first - 1
        shapes = [
            [float(vectors[i, k] / root[i] * root[last] / vectors[last, k]) for k in modes] for i in range(last + 1)
        ]
    # singular values are good to the last bits of the largest: stiffnesses lie up to 1e7 apart, their roots 3e3
    np.testing.assert_allclose(chain.natural, want, rtol=1e-11, atol=0.0)
    found = chain.shapes[first:]
    np.testing.assert_allclose(found, shapes, rtol=1e-6, atol=1e-9 * np.abs(shapes).max())


def test_holzers_torque_of_a_published_chain() -> None:
    """W. T. Thomson, Theory of Vibration, table 12.4-1: 14.66e3 at 20 rad/s, 52.32e3 at 40 rad/s."""
    for speed, printed in ((20.0, 14.66e3), (40.0, 52.32e3)):
        angle, torque = 1.0, 0.0
        for inertia, stiffness in zip((5.0, 11.0, 22.0), (1e5, 2e5, math.inf), strict=True):
            torque += inertia * speed**2 * angle
            angle -= torque / stiffness
        assert torque == pytest.approx(printed, rel=5e-4)  # four digits are printed
    natural = Chain(np.array([5.0, 11.0, 22.0]), np.array([1e5, 2e5])).natural
    assert natural == pytest.approx([123.6658, 202.6583], rel=5e-7)


def test_ratios_reduce_discs_and_shafts_to_the_main_shaft() -> None:
    shaft = {"inertias": [2, 0.5, 0.25], "stiffnesses": [8000, 3000], "ratios": [1, 2, 2]}
    plain = {"inertias": [2, 2, 1], "stiffnesses": [8000, 12000]}
    found = [machine({"m": of(cam(FEED))}, shaft=each).natural_frequencies for each in (shaft, plain)]
    assert found[0] == pytest.approx(found[1], rel=1e-12)


@pytest.mark.parametrize(("key", "given"), [("members", ["arm"]), ("ratios", [1, 2])])
def test_every_disc_has_its_entry(key: str, given: list[Any]) -> None:
    with pytest.raises(ValidationError, match=f"{key}: {amount(len(given), 'entry', 'entries')} for 3 discs"):
        MainShaft.model_validate({"inertias": [1, 1, 1], "stiffnesses": [5000, 5000], key: given})


def test_several_members_stand_on_one_disc() -> None:
    """Both work against a steady torque behind the same spring: the twist is that of their sum."""
    pulled = ROCKER | {"loads": {"links": {}, "forces": [{"on": "crank", "torque": -8.0}]}}
    shaft = {"inertias": [1, 1], "stiffnesses": [5000], "members": ["motor", ["one", "two"]]}
    made = machine({"one": of(pulled), "two": of(pulled, phase=90)}, shaft=shaft, speed=60)
    table = MachineLoads(made.spec).table("wind_up")
    assert table["disc"].tolist() == ["one", "one"]
    assert table["mean"].tolist() == pytest.approx([math.degrees(-16.0 / 5000.0)] * 2, rel=1e-12)


@pytest.mark.slow
def test_the_swing_is_that_of_an_integration_over_time() -> None:
    """A chain with damping in every mode runs until nothing is left of its start, then over one more period."""
    chain = Chain(np.array([2.0, 0.4, 0.7]), np.array([900.0, 500.0]), damping=0.15)
    speed, count = 9.0, 64
    grid = np.arange(count) * (2.0 * math.pi / count)
    torques = np.stack([
        np.zeros(count),
        -3.0 - 2.0 * np.cos(grid) + 1.5 * np.sin(3.0 * grid),
        1.0 + 4.0 * np.sin(2.0 * grid),
    ])  # fmt: skip
    swing = Swing(chain, torques, 1, speed)
    inertia = np.diag(chain.inertias)
    stiff = np.array([[900.0, -900.0, 0.0], [-900.0, 1400.0, -500.0], [0.0, -500.0, 500.0]])
    omega, shapes = chain._modes
    pushed = inertia @ shapes
    damp = pushed @ np.diag(2.0 * chain.damping * omega) @ pushed.T
    mean = torques.mean(axis=1)

    def forces(t: float) -> np.ndarray:
        x = speed * t
        own = np.array([
            0.0,
            -3.0 - 2.0 * math.cos(x) + 1.5 * math.sin(3.0 * x),
            1.0 + 4.0 * math.sin(2.0 * x),
        ])  # fmt: skip
        own[0] -= mean.sum()
        return own

    def rates(t: float, state: np.ndarray) -> np.ndarray:
        angle, rate = state[:3], state[3:]
        return np.concatenate([rate, np.linalg.solve(inertia, forces(t) - damp @ rate - stiff @ angle)])

    period = 2.0 * math.pi / speed
    end = 12 * period
    start = np.zeros(6)
    found = solve_ivp(rates, (0.0, end), start, rtol=1e-9, atol=1e-12, dense_output=True, method="DOP853")
    times = end - period + grid / speed
    angles = found.sol(times)[:3]
    twist = angles - angles[0]
    # what is left of the start: e^(-0.15 28 8.4) = 1e-15; the integration keeps 1e-8
    np.testing.assert_allclose(swing.twist, twist, rtol=0.0, atol=1e-7 * float(np.abs(twist).max()))


def test_slow_torques_wind_the_shaft_up_as_a_spring() -> None:
    chain = Chain(np.array([1.0, 1.0, 1.0]), np.array([100.0, 50.0]))
    assert chain.wind_up(np.array([0.0, 0.0, 5.0])) == pytest.approx([0.0, 0.05, 0.15], rel=1e-14)
    assert chain.wind_up(np.array([0.0, 4.0, 0.0])) == pytest.approx([0.0, 0.04, 0.04], rel=1e-14)


STIFF = [9000.0, 15000.0]
PIECES = [
    {"diameter": 40.0, "length": 300.0},
    [{"diameter": 50.0, "length": 200.0, "bore": 20.0}, {"diameter": 35.0, "length": 150.0}],
]


@pytest.mark.quick(3)
@pytest.mark.parametrize("stiffnesses", [STIFF, PIECES, [STIFF[0], PIECES[1]]])
@pytest.mark.parametrize("mode", [0, 1])
def test_a_shaft_that_is_stiffened_as_the_fix_says_is_off_its_critical_speeds(
    stiffnesses: list[Any], mode: int
) -> None:
    """The nearest stiffness from which on each natural frequency is a tenth away: a hundredth less is not enough."""
    shaft = {"inertias": [0.8, 0.05, 0.31], "stiffnesses": stiffnesses}
    natural = Chain.of(MainShaft.model_validate(shaft)).natural
    made = machine({"m": of(cam(FEED))}, shaft=shaft, speed=float(natural[mode]) * 30.0 / math.pi * 1.02)
    warned = [check for check in made.findings("analyze", "critical-speed") if check.status == "warn"]
    assert len(warned) == 1
    after = type(made)(changed(made.spec, warned[0].remedy))
    assert {check.status for check in after.check("critical-speed")} == {"pass"}
    speeds = np.array(after.critical_speeds) / made.spec.speed - 1.0
    assert np.abs(speeds).min() == pytest.approx(1.0 / 0.9 - 1.0, abs=2e-3)


def test_harmonics_of_the_torque_are_kept_off_all_modes_together() -> None:
    """The natural frequencies by the matrices of the chain, on a comb of orders that leaves few gaps."""
    shaft = MainShaft.model_validate({"inertias": [0.8, 0.05, 0.31], "stiffnesses": STIFF})
    orders = 40.0 * np.array([1.0, 2.0, 3.0, 5.0, 8.0, 11.0, 19.0])
    found = list(stiffened(shaft, orders))
    assert len(found) > 1
    for ((key, values),) in found:
        assert key == "shaft.stiffnesses"
        inertia, (one, other) = np.diag([0.8, 0.05, 0.31]), values
        stiff = np.array([[one, -one, 0.0], [-one, one + other, -other], [0.0, -other, other]])
        natural = np.sqrt(np.sort(np.linalg.eigvals(np.linalg.solve(inertia, stiff)).real)[1:])
        off = np.abs(orders[:, None] / natural - 1.0)
        assert off.min() >= 0.1 - 1e-9
        assert one / other == pytest.approx(STIFF[0] / STIFF[1], rel=2e-3)
    assert [values[0] for ((_, values),) in found] == sorted(values[0] for ((_, values),) in found)
