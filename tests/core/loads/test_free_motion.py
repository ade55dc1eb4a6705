"""IFToMM benchmark A02, N windows of unit parallelograms that swing round freely through their change points.

No design file asks for a motion that is not given, but its parts are those of the loads: variable inertia and weight
by the exact derivatives of the links, and the speed at an energy. The inertia is constant to rounding; energy is held
by construction, so that the benchmark's measure, its drift, is that of the quadrature, 1e-12.

The published history is read off the figure of the OpenSim implementation, which draws the reference of N = 2 over 10 s
(github.com/RehabEngGroup/MBSbenchmarksInOpenSim, A02_kinematics): half its line is 0.02 s, 0.05 m/s and 0.03 m.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.special import ellipk

from gearlink.core.mechanism.dynamics import Mass, System, reduced
from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import fixed, standing, steady
from gearlink.core.studies.loads.flywheel import Energy, SteadyRun
from gearlink.core.studies.loads.panels import Panels

G = -9810j
BAR = Mass(1.0, 1.0 / 12.0, 500.0 + 0j)
START = 0.5 * math.pi
BOTTOM, FASTEST = np.array([0.97, 2.91, 4.86, 6.80, 8.74]), -6.84
LAST = 0.33


def windows(n: int, phi: Any) -> tuple[Mechanism, dict[str, Mass]]:
    """N + 1 bars on the frame, turning together clockwise from upright, and N couplers between their ends."""
    turn = steady(phi, -1.0, START)
    links = {f"bar {i}": Link(fixed(complex(1000.0 * i), phi), turn) for i in range(n + 1)}
    links |= {f"coupler {i}": Link(links[f"bar {i}"].at(1000.0), standing(0.0, phi)) for i in range(n)}
    pins = [Pin(f"A{i}", FRAME, f"bar {i}", links[f"bar {i}"].origin.value) for i in range(n + 1)]
    for i in range(n):
        pins.append(Pin(f"B{i}", f"bar {i}", f"coupler {i}", links[f"bar {i}"].at(1000.0).value))
        pins.append(Pin(f"B{i}'", f"bar {i + 1}", f"coupler {i}", links[f"bar {i + 1}"].at(1000.0).value))
    return Mechanism(links, pins, "bar 0", -1.0), dict.fromkeys(links, BAR)


def free(n: int) -> SteadyRun:
    """The run without any drive, B0 at 1 m/s over the axes."""

    def of(phi: Any) -> Any:
        return reduced(*windows(n, phi), (), G)

    energy = Energy.from_functions(lambda x: of(x).static, lambda x: of(x).inertia, Panels.over(2.0 * math.pi, []))
    return SteadyRun(energy, 0.0, 0.5 * float(of(np.zeros(1)).inertia[0]))


def time(run: SteadyRun) -> tuple[Panels, Any]:
    """Panels of a revolution, and the time to their edges [s]."""
    panels = run.energy.panels
    return panels, panels.running(1.0 / run.speed(panels.nodes))


@pytest.mark.parametrize(("n", "inertia", "speed"), [(2, 3.0, 4.887739763939975), (40, 161.0 / 3.0, 4.808138803920284)])
def test_inertia_and_speed_at_the_change_point(n: int, inertia: float, speed: float) -> None:
    run, phi = free(n), np.linspace(0.1, 6.0, 7)
    assert run.energy.inertia(phi) == pytest.approx(inertia, rel=1e-14)
    assert np.abs(reduced(*windows(n, phi), (), G).slope).max() <= 1e-14 * inertia
    assert abs(run.energy.mean) <= 1e-12 * inertia
    change_points = np.array([0.5 * math.pi, 1.5 * math.pi])
    assert run.speed(change_points) == pytest.approx([speed, speed], rel=1e-12)


@pytest.mark.quick(1)
@pytest.mark.parametrize("n", [2, 40])
def test_energy_does_not_drift_and_a_turn_takes_its_time(n: int) -> None:
    """w^2 = 1 + 4 c sin^2(phi/2), c = (N + (N + 1)/2) g/J: a revolution takes 4 K(-4 c)."""
    run, phi = free(n), np.linspace(0.0, 2.0 * math.pi, 41)
    weight, inertia = (n + 0.5 * (n + 1)) * 9.81, n + (n + 1) / 3.0
    total = 0.5 * inertia * run.speed(phi) ** 2 + weight * np.cos(phi)
    assert total == pytest.approx(0.5 * inertia + weight, rel=1e-12)
    panels, at = time(run)
    assert at[-1] == pytest.approx(4.0 * ellipk(-4.0 * weight / inertia), rel=1e-12)
    assert panels.edges[-1] == pytest.approx(2.0 * math.pi, rel=1e-12)


def test_reactions_need_no_drive_beside_the_change_points() -> None:
    """At the free acceleration Newton and Euler find a drive torque of 0."""
    n, phi = 2, np.array([0.3, 1.2, 2.0, 2.9, 4.0, 5.5])
    mechanism, masses = windows(n, phi)
    parts = reduced(mechanism, masses, (), G)
    run = free(n)
    speed, acceleration = run.speed(phi), -parts.static / parts.inertia
    system = System(mechanism, masses)
    (found,) = system.solve([system.right_side((), G, speed, acceleration)])
    reactions = system.reactions(found)
    largest = max(float(np.abs(reactions.force(each.name)).max()) for each in mechanism.connections)
    assert np.abs(reactions.torque).max() <= 1e-13 * largest / np.abs(np.cos(phi)).min()
    frame = sum(reactions.force(f"A{i}") for i in range(n + 1))
    momentum = sum(1e-3 * masses[name].mass * (link.at(500).second * speed**2 + link.at(500).first * acceleration - G)
                   for name, link in mechanism.links.items())  # fmt: skip
    assert np.abs(frame - momentum).max() <= 1e-12 * largest


def test_history_of_the_published_figure() -> None:
    """B0 over 10 s, five revolutions through ten change points; an ODE solver gives the same to its tolerance."""
    run = free(2)
    panels, at = time(run)
    turn = at[-1]
    bottom = 0.5 * turn + turn * np.arange(5)
    assert bottom == pytest.approx(BOTTOM, abs=0.02)
    assert -float(run.speed(np.array([math.pi]))[0]) == pytest.approx(FASTEST, abs=0.05)

    def rate(_: float, y: Any) -> list[float]:
        return [y[1], 3.5 * 9.81 / 3.0 * math.sin(y[0])]

    solved = solve_ivp(rate, (0.0, 10.0), [0.0, 1.0], method="DOP853", rtol=1e-12, atol=1e-12)
    turned = np.interp(math.fmod(10.0, turn), at, panels.edges)
    assert math.sin(solved.y[0, -1]) == pytest.approx(LAST, abs=0.03)
    assert math.fmod(solved.y[0, -1], 2.0 * math.pi) == pytest.approx(turned, abs=2e-2)
    # the time that the run takes to where the solver stands, to what the solver has lost over 10 s
    there = np.array([math.fmod(solved.y[0, -1], 2.0 * math.pi)])
    late = Panels.over(float(there[0]), [])
    assert 5.0 * turn + late.integral(1.0 / run.speed(late.nodes)) == pytest.approx(10.0, abs=1e-9)
