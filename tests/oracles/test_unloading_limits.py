"""Closed forms of the limiting laws against mpmath.

Tolerances: 4 ulp relative for the peaks (one elliptic integral of 2 ulp, squared); displacement 2e-15 absolute.
How the quadrature meets these limits is tested with it.
"""

from __future__ import annotations

import math

import mpmath as mp
import numpy as np
import pytest
from oracles.unloading_limits import (
    pendulum_displacement,
    pendulum_peaks,
    pendulum_stretch_ratio,
    small_swing_peaks,
    touching_pins_energy_parameter,
)

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring

ROUNDING = 1e-15


@pytest.mark.parametrize("swing", [0.01, 1.0, 3.0, 4.0, math.radians(300.0)])
def test_pendulum(swing: float) -> None:
    with mp.workdps(30):
        g = mp.mpf(swing)
        m = mp.sin(g / 4)
        quarter = mp.ellipk(m * m)
        velocity, start = float(4 * quarter * m / g), float(4 * quarter**2 * mp.sin(g / 2) / g)
        k = np.array([0.0, 0.1, 0.37, 0.5, 0.9])
        exact = [
            float(0.5 - 2 / g * mp.asin(m * mp.ellipfun("sn", quarter * (1 - 2 * mp.mpf(x)), m=m * m)))
            for x in k.tolist()
        ]
    assert pendulum_peaks(swing)[:2] == pytest.approx((velocity, start), rel=4 * ROUNDING)
    np.testing.assert_allclose(pendulum_displacement(k, swing), exact, rtol=0, atol=2 * ROUNDING)


def test_pendulum_peak_leaves_the_start_at_half_a_turn() -> None:
    _, start, peak = pendulum_peaks(math.pi)
    assert peak == start
    _, start, peak = pendulum_peaks(4.0)
    assert peak == pytest.approx(start / math.sin(2.0), rel=ROUNDING)


def test_zero_free_length() -> None:
    # the stretch at mid-swing, epsilon D, is the whole length lambda - 1
    longest = math.sqrt(1.0 + 9.0 - 6.0 * math.cos(1.0))
    assert pendulum_stretch_ratio(3.0, 2.0) * (longest - 2.0) == pytest.approx(2.0, rel=8 * ROUNDING)


@pytest.mark.quick(2)
@pytest.mark.parametrize("swing", [0.01, 1.0, 3.0, math.radians(300.0)])
def test_touching_pins(swing: float) -> None:
    """N at lambda = 1 by adaptive quadrature: l = 2 sin(phi/2), E = 2 [sin(gamma/4) - sin(phi/2)]."""
    with mp.workdps(30):
        g = mp.mpf(swing)

        def time(v: mp.mpf) -> mp.mpf:
            phi = g / 2 - v * v
            rest = 4 * mp.sin(v * v / 4) * mp.cos(g / 4 - v * v / 4)
            return 2 * v / mp.sqrt(rest) if v else 2 / mp.sqrt(mp.cos(g / 4)) + 0 * phi

        exact = float((2 / g * mp.quad(time, [0, mp.sqrt(g / 2)])) ** 2)
    assert touching_pins_energy_parameter(swing) == pytest.approx(exact, rel=20 * ROUNDING)


@pytest.mark.parametrize("stretch", [0.0, 0.5, 10.0, 1e6])
def test_duffing(stretch: float) -> None:
    with mp.workdps(30):
        mu = 1 / (2 + 2 * mp.mpf(stretch))
        exact = float(mp.sqrt((1 + 2 * mp.mpf(stretch)) * mu) * mp.ellipk(mu)), float(2 * mp.ellipk(mu) ** 2)
    assert small_swing_peaks(Spring(3.0, stretch)) == pytest.approx(exact, rel=4 * ROUNDING)
    assert small_swing_peaks(Spring(3.0, 1e9)) == pytest.approx(small_swing_peaks(Pneumatic(3.0)), rel=1e-9)


def test_swing_outside_its_range() -> None:
    for function in (pendulum_peaks, touching_pins_energy_parameter):
        with pytest.raises(NoSolution, match="at most 340 deg"):
            function(6.0)
    with pytest.raises(NoSolution, match="at most 340 deg"):
        pendulum_displacement(np.array([0.5]), -1.0)
