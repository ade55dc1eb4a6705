"""Loads against numbers of textbooks, and the vibration of wide swings against an ODE solver.

R. Norton, Design of Machinery, problem 11-3 row a: accelerations in its published solution, five digits. Harmonics of a
piston's acceleration at r/L = 1/4 as engine books print them, four decimals. Equivalent loads: P = 0.75 F for a force
that varies as |sin|, a rule of bearing catalogues that is good to 0.002, and P = (F_min + 2 F_max)/3 for one that rises
and falls evenly, which lies up to a tenth above; and closed forms beside them.
"""

from __future__ import annotations

import math
from typing import Any

import factory
import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.interpolate import CubicSpline
from scipy.special import ellipe

from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.dynamics import Mass, System, Torque, reduced, shaking
from gearlink.core.mechanism.joints import Guide, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import fixed, standing, steady


def _norton() -> tuple[Mechanism, dict[str, Mass]]:
    """Crank 4 in, rod 12 in, at 45 deg; inches, blobs and pounds stand for mm, t and N."""
    phi = np.array([0.25 * math.pi])
    crank = Link(fixed(0j, phi), steady(phi))
    pin = crank.at(4.0)
    turn, end = slider(pin, 12.0, 0j, 1.0 + 0j)
    links = {"2": crank, "3": Link(pin, turn), "4": Link(end, standing(0.0, phi))}
    joints = [Pin("O2", FRAME, "2", crank.origin.value), Pin("A", "2", "3", pin.value), Pin("B", "3", "4", end.value),
              Guide("slide", FRAME, "4", end.value, 1.0 + 0j)]  # fmt: skip
    return Mechanism(links, joints, "2"), {"2": Mass(2.0, 1e-4, 2.0), "3": Mass(20.0, 2e-4, 5.0), "4": Mass(60.0)}


def test_shaking_force_of_the_published_accelerations() -> None:
    """10 rad/s and 20 rad/s^2; the torque on the rod, 20 lbf in, is held by both ways alike."""
    mechanism, masses = _norton()
    speed, acceleration = 10.0, 20.0
    published = {"2": (203.96, 213.69), "3": (371.08, 200.84), "4": (357.17, 180.0)}
    force = 0j
    for name, (size, degrees) in published.items():
        center = mechanism.links[name].at(masses[name].center)
        found = complex(center.second[0] * speed**2 + center.first[0] * acceleration)
        assert abs(found) == pytest.approx(size, abs=0.005)
        assert math.degrees(np.angle(found)) % 360.0 == pytest.approx(degrees, abs=0.005)
        force -= masses[name].tonnes * size * np.exp(1j * math.radians(degrees))
    assert complex(shaking(mechanism, masses, speed, acceleration)[0][0]) == pytest.approx(force, abs=1e-3)
    torque = [Torque("3", np.array([20.0]))]
    system = System(mechanism, masses)
    (solved,) = system.solve([system.right_side(torque, 0j, speed, acceleration)])
    found_torque = system.reactions(solved).torque
    assert found_torque == pytest.approx(reduced(mechanism, masses, torque, 0j).torque(speed, acceleration), rel=1e-13)


def _piston(**loads: Any) -> Any:
    data = {"kind": "slider-crank", "stroke": 100.0, "rod": 200.0, "input_speed": 600.0}
    return factory.design(data | {"loads": loads}, command="loads")


def test_harmonics_of_a_piston() -> None:
    """a/(r w^2) = cos t + 0.2540 cos 2t - 0.0041 cos 4t + 0.0001 cos 6t, its maximum 1 + r/L."""
    design = _piston(links={"slider": {"mass": 2.0}})
    unit = 2.0 * 0.05 * (20.0 * math.pi) ** 2
    table = design.table("frame")
    waves = np.fft.rfft(np.array(table["force_y"])) * 2.0 / 360.0 / unit
    size = np.abs(waves)
    assert size[1] == pytest.approx(1.0, abs=1e-12)
    assert size[[2, 4, 6]] == pytest.approx([0.2540, 0.0041, 0.0001], abs=5e-5)
    assert size[[3, 5, 7]] == pytest.approx(0.0, abs=1e-12)
    assert design.raw("shaking_force_max") == pytest.approx(1.25 * unit, rel=1e-12)


def test_equivalent_load_of_the_crank_s_bearing_has_a_closed_form() -> None:
    """Under a constant force D bears F/cos(psi): P^3 = F^3 (2/pi) E(m)/(1 - m), m = (r/L)^2, over even turning."""
    design = _piston(forces=[{"on": "slider", "force": -1000.0}])
    m = 1.0 / 16.0
    wanted = 1000.0 * (2.0 / math.pi * ellipe(m) / (1.0 - m)) ** (1.0 / 3.0)
    assert design.raw("pin_D.equivalent") == pytest.approx(wanted, rel=1e-12)
    assert design.raw("pin_D.peak") == pytest.approx(1000.0 / math.sqrt(1.0 - m), rel=1e-12)
    assert design.raw("pin_D.travel") == pytest.approx(1.0, rel=1e-12)
    # the gudgeon pin swings by asin(r/L) to either side, twice a revolution
    assert design.raw("pin_F.travel") == pytest.approx(4.0 * math.asin(0.25) / (2.0 * math.pi), rel=1e-12)


def _bearing(torque: Any) -> tuple[float, float]:
    loads = {"speed": 600, "forces": [{"on": "gear2", "torque": torque}]}
    design = factory.design("gear_pair", command="loads", loads=loads)
    return design.raw("pin_gear1.equivalent"), design.raw("pin_gear1.peak")


@pytest.mark.slow
def test_rules_of_bearing_catalogues() -> None:
    table = [[x, 50.0 * math.sin(math.radians(x))] for x in range(0, 361, 6)]
    table[-1][1] = table[0][1]
    equivalent, peak = _bearing({"table": table, "interpolation": "cubic"})
    assert equivalent / peak == pytest.approx(0.75, abs=2e-3)
    assert equivalent / peak == pytest.approx((4.0 / (3.0 * math.pi)) ** (1.0 / 3.0), rel=1e-6)
    equivalent, peak = _bearing({"table": [[0, 20], [180, 50]]})
    assert 0.9 * (0.4 + 2.0) / 3.0 < equivalent / peak < (0.4 + 2.0) / 3.0
    assert equivalent / peak == pytest.approx(((1.0 - 0.4**4) / (4.0 * 0.6)) ** (1.0 / 3.0), rel=1e-12)
    steps = {"zones": [{"from": 0, "to": 90, "value": 50}, {"from": 90, "to": 360, "value": 20}]}
    equivalent, peak = _bearing(steps)
    assert equivalent / peak == pytest.approx((0.25 + 0.75 * 0.4**3) ** (1.0 / 3.0), rel=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize("damping", [0.0, 0.05])
@pytest.mark.parametrize(
    ("base", "frequency"),
    [("wide_swing_twin_cam", 25.0), ("wide_swing_slider_cam", 12.0)],
)
def test_vibration_after_a_wide_swing_by_an_ode_solver(base: str, frequency: float, damping: float) -> None:
    """z'' + 2 zeta w z' + w^2 z = -x'' from rest over the stroke; the amplitude is |z + (z' + zeta w z)/(i w_d)|."""
    design = factory.design(base, command="loads", loads={"vibration": {"frequency": frequency, "damping": damping}})
    law, swing = design.design.motion.law, design.spec.swing
    time, w = design.cam.cycle_angle / design.speed, 2.0 * math.pi * frequency

    k = np.linspace(0.0, 1.0, 2001)
    bend = CubicSpline(k, law.invariants(k, 2)[2])

    def rate(t: float, y: Any) -> list[float]:
        return [y[1], -float(bend(t / time)) * swing / time**2 - 2.0 * damping * w * y[1] - w * w * y[0]]

    solved = solve_ivp(rate, (0.0, time), [0.0, 0.0], method="DOP853", rtol=1e-10, atol=1e-13)
    z, v = solved.y[:, -1]
    natural = w * math.sqrt(1.0 - damping**2)
    amplitude = math.hypot(z, (v + damping * w * z) / natural)
    assert math.degrees(design.raw("residual_amplitude")) == pytest.approx(amplitude, rel=1e-7)


@pytest.mark.slow
@pytest.mark.parametrize("frequency", [9.0, 2.6])
def test_vibration_of_a_rocker_that_never_rests_by_an_ode_solver(frequency: float) -> None:
    """Of a cam on a crank-rocker, over the crank's turn: z'' + 2 zeta w z' + w^2 z = -x'' in the periodic state."""
    damping = 0.05
    vibration = {"vibration": {"frequency": frequency, "damping": damping}}
    design = factory.design("wide_swing_oscillating_cam", command="loads", loads=vibration)
    speed, w, period = design.speed, 2.0 * math.pi * frequency, 2.0 * math.pi
    assert design.raw("residual_amplitude") is None
    phi = np.linspace(0.0, period, 4001)
    bend = CubicSpline(phi, design.vibrating.bend(np.mod(phi, period)))

    def rate(t: float, y: Any) -> list[float]:
        return [y[1], -float(bend(t * speed)) * speed**2 - 2.0 * damping * w * y[1] - w * w * y[0]]

    def turn(state: list[float], **given: Any) -> Any:
        return solve_ivp(rate, (0.0, period / speed), state, method="DOP853", rtol=1e-10, atol=1e-13, **given)

    # The state after a revolution is linear in that before it: what comes back to itself.
    free, one, two = (turn(state).y[:, -1] for state in ([0.0, 0.0], [1.0, 0.0], [0.0, 1.0]))
    start = np.linalg.solve(np.eye(2) - np.column_stack((one - free, two - free)), free)
    places = np.array([0.4, 2.1, 3.3, 5.0])
    solved = turn(list(start), t_eval=places / speed).y[0]
    assert design.vibrating.deflection(places) == pytest.approx(solved, rel=1e-6, abs=1e-8)
