"""The efficiency of a mesh: output over input power, whichever gear drives, counted by the balance of each free gear.

Tolerance 1e-11 of the maximum: a fixed point that ends at 1e-14, and forces of linkages of condition below 1e3.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.core.mechanism.friction import Coefficients, Unit

BODY = {"mass": 2.0, "inertia": 0.02}


def _pair(teeth: tuple[int, int], speed: float, torque: float, efficiency: float) -> Any:
    loads = {"speed": speed, "forces": [{"on": "gear2", "torque": torque}], "friction": {"meshes": efficiency}}
    data = {"kind": "gear-pair", "module": 2.0, "teeth": list(teeth), "profile_shift": [0.0, 0.0], "loads": loads}
    return factory.design(data, command="loads")


def _pairs() -> Iterator[tuple[tuple[int, int], float]]:
    """Pairs as different as they come: the small gear first, last, and in a ring; efficiencies down to a half."""
    rng = np.random.default_rng(20_260)
    yield (20, 40), 0.9
    yield (20, -60), 0.9
    for ring in (False, True, False, True):
        one, other = sorted(rng.integers(20, 60, 2).tolist())
        yield (one, -other - 30) if ring else (other, one), float(rng.uniform(0.5, 0.999))


@pytest.mark.quick(3)
@pytest.mark.parametrize(("teeth", "efficiency"), list(_pairs()))
def test_a_pair_gives_that_share_of_what_it_takes_whichever_gear_drives(
    teeth: tuple[int, int], efficiency: float
) -> None:
    """Torques in the ratio of the teeth, and eta P_in = P_out.

    T_1 = T_2 z_1/z_2 without friction, times 1/eta where gear 1 drives, times eta where gear 2 does; with the signs.
    The force of the teeth is that of the driving gear, T_in/r_in, since the loss lies on the other one.
    """
    for speed in (80.0, -80.0):
        for torque in (40.0, -40.0, 4e-9):
            design = _pair(teeth, speed, torque, efficiency)
            free = torque * teeth[0] / teeth[1]
            share = 1.0 / efficiency if free * speed > 0.0 else efficiency
            forces = design.machine.reactions(np.array([0.3]))
            found = float(forces.torque[0])
            assert found == pytest.approx(free * share, rel=1e-12)
            driving = (torque / teeth[1], found / teeth[0])[free * speed > 0.0]
            assert abs(forces.unknowns["mesh_12"][0, 0]) == pytest.approx(abs(driving) * 1e3, rel=1e-12)


def test_a_pair_without_a_load_loses_nothing() -> None:
    """The torque of masses alone, which turn evenly: none; the power goes through 0 without a jump."""
    assert _pair((20, 40), 80.0, 1e-300, 0.9).input_torque_mean == pytest.approx(0.0, abs=1e-250)
    at, below = (_pair((20, 40), 80.0, torque, 0.9).input_torque_mean for torque in (1e-9, -1e-9))
    assert at == pytest.approx(0.5e-9 / 0.9, rel=1e-12)
    assert below == pytest.approx(-0.5e-9 * 0.9, rel=1e-12)


CHAINS: dict[str, tuple[tuple[str, str], ...]] = {
    # free gears from the load to the drive, each with the link that holds its mesh with the next one
    "loaded_feed": (("output", "rocker"), ("idler", "coupler")),
    "ring_feed": (("output", "rocker"), ("idler", "coupler")),
    "two_gear_ring": (("output", "crank"),),
    "two_gear_drag_link": (("output", "crank"),),
    "wide_lever": (("output", "rocker"),),
}
KEYS: dict[str, dict[str, Any]] = {"ring_feed": {"links": {"crank": 23.5, "frame": 53.8}, "dwell": None}}


@pytest.mark.quick(3)
@pytest.mark.parametrize("torque", [-18.0, 25.0])
@pytest.mark.parametrize("speed", [90.0, -90.0])
@pytest.mark.parametrize("name", CHAINS)
def test_a_train_loses_by_its_free_gears(name: str, speed: float, torque: float) -> None:
    """Each free gear's own balance of moments says what its mesh must give it, from the output to the input.

    Rolling power goes in the frame of the link that holds both axes; what all meshes lose is what the input gives more.
    """
    free_gears = {gear: BODY for gear, _ in CHAINS[name]}
    loads = {"speed": speed, "links": free_gears, "forces": [{"on": "output", "torque": torque}]}
    efficiency = 0.93
    free, lossy = (
        factory.design(name, command="loads", loads={**loads, "friction": friction}, **KEYS.get(name, {}))
        for friction in (None, {"meshes": efficiency})
    )
    phi = np.linspace(0.03, lossy.machine.period, 60, endpoint=False)
    links, w = free.machine.at(phi).links, free.machine.speed
    lost, wanted = np.zeros(60), -torque
    for (gear, carrier), following in zip(CHAINS[name], [*(gear for gear, _ in CHAINS[name][1:]), ""], strict=True):
        wanted = wanted + BODY["inertia"] * links[gear].turn.second * w**2
        power = wanted * (links[gear].turn.first - links[carrier].turn.first) * w
        into = np.where(power > 0.0, power / efficiency, power * efficiency)
        lost += into - power
        if following:
            wanted = into / ((links[following].turn.first - links[carrier].turn.first) * w)
    found = lossy.machine.torque(phi) * w
    assert found == pytest.approx(free.machine.torque(phi) * w + lost, abs=1e-11 * np.abs(found).max())
    assert lost.max() > 1e-3 * np.abs(found).max()


def test_two_meshes_in_line_have_the_square_of_one() -> None:
    """A crank that hardly moves the axes: the train of three gears is a fixed one, but for crank/frame = 1e-4."""
    data = {"kind": "three-gear-four-bar", "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40}}
    data |= {"links": {"crank": 0.02, "frame": 200.0}}
    mean = {}
    for efficiency in (1.0, 0.95, 0.9):
        loads = {"speed": 60, "forces": [{"on": "output", "torque": -20}], "friction": {"meshes": efficiency}}
        mean[efficiency] = factory.design(data, command="loads", loads=loads).input_torque_mean
    assert mean[0.95] / mean[1.0] == pytest.approx(0.95**-2, rel=2e-4)
    assert mean[0.9] / mean[1.0] == pytest.approx(0.9**-2, rel=2e-4)


@pytest.mark.quick(1)
@pytest.mark.parametrize("speed", [60.0, -60.0])
@pytest.mark.parametrize("friction", [{"meshes": 0.8}, {"joints": {"mesh_wheel": 0.8}}])
def test_the_teeth_of_a_mutilated_gear_lose_too(speed: float, friction: dict[str, Any]) -> None:
    """One mesh alone: the torque is 1/eta times that without loss, or eta times where the linkage drives the wheel.

    It had no effect there, without a word.
    """
    loads = {"speed": speed, "links": {"coupler": BODY, "rocker": BODY}, "forces": [{"on": "rocker", "torque": -20.0}]}
    free, lossy = (
        factory.design("mutilated_gear_press", command="loads", loads=loads | more)
        for more in ({}, {"friction": friction})
    )
    phi = np.linspace(0.01, lossy.machine.period, 200, endpoint=False)
    smooth, found = (design.machine.torque(phi) * speed for design in (free, lossy))
    assert (smooth > 0.0).any()
    assert (smooth < 0.0).any()
    expected = np.where(smooth > 0.0, smooth / 0.8, smooth * 0.8)
    assert found == pytest.approx(expected, abs=1e-11 * np.abs(smooth).max())
    assert lossy.power_identity <= 1e-12


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["loaded_feed", "loaded_six_bar", "two_gear_ring"])
def test_the_check_of_power_sees_a_loss_on_the_wrong_gear(name: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """GL601: losses on the driving gear are 1/(2 - eta) instead of eta, (1 - eta)^2 of the power too few."""
    section = {"speed": 60, "links": {"output": BODY}, "forces": [{"on": "output", "torque": -20}]}
    keys: dict[str, Any] = {"loads": section} if name == "two_gear_ring" else {}

    def check() -> Any:
        return factory.design(name, command="loads", **keys, loads__friction={"meshes": 0.99}).check("power-identity")

    right = Coefficients.units

    def wrong(self: Coefficients, mechanism: Any, speed: float) -> Iterator[Unit]:
        for unit in right(self, mechanism, speed):
            yield unit if unit.side is None else unit._replace(side=-unit.side)

    assert check()[0].status == "pass"
    monkeypatch.setattr(Coefficients, "units", wrong)
    assert check()[0].status == "fail"
    assert 1e-6 < check()[0].value < math.inf
