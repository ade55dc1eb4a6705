"""Torques with and without the unloading device.

Tolerances: 1e-14 relative, products of numbers known to 1e-15; a maximum found by sampling and refining is exact to
rounding where it is smooth.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Pneumatic, force
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.torques import (
    drive_balancing_ratio,
    inertia_torque_peak,
    power_peak,
    speed_sweep,
    stroke_time,
)

ROUNDING = 1e-14
CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
SWING = math.radians(120.0)
LAW = ElasticLaw(Pneumatic(2.5), SWING)
TIME = CASES["D20"]["T0"]


def test_reference() -> None:
    expected = CASES["D20"]
    assert stroke_time(SWING, 2.0 * math.pi * 1.66) == pytest.approx(TIME, rel=1e-15)
    assert inertia_torque_peak(0.5, LAW, TIME) == pytest.approx(expected["M_in_max"], rel=ROUNDING)
    assert power_peak(lambda k: LAW.invariants(k)[1] * LAW.invariants(k)[2]) == pytest.approx(
        expected["bc_max"], rel=ROUNDING
    )
    speeds = np.array([0.5, 1.0, 1.5, 1.8]) / 1.66
    listed = [expected[f"Ky(n={n})"] for n in ("0.5", "1.0", "1.5", "1.8")]
    # near n0 the difference of squares has the condition n^2/|n^2 - n0^2| in the rounded ratio
    np.testing.assert_allclose(drive_balancing_ratio(speeds, 0.0), listed, rtol=2e-15)


def test_device_torque_is_the_inertia_torque_at_the_design_speed() -> None:
    """Largest of P r_d lambda sin(phi)/l, by the law of sines, against J gamma C/T^2."""
    push = force(LAW.energy_parameter, 0.5, SWING, 120.0, TIME)
    phi = np.linspace(0.0, 0.5 * SWING, 2001)
    torque = push * 0.12 * 2.5 * np.sin(phi) / np.sqrt(1.0 + 6.25 - 5.0 * np.cos(phi))
    assert float(torque.max()) == pytest.approx(CASES["D20"]["M_dev_max"], rel=ROUNDING)


def residual_torque(speed_ratio: float, k: np.ndarray) -> np.ndarray:
    """Torque that the device leaves to the drive, J gamma c(k) (1/T^2 - 1/T0^2) with T0/T = n/n0."""
    return 0.5 * LAW.swing / TIME**2 * (speed_ratio - 1.0) * (speed_ratio + 1.0) * LAW.invariants(k, 2)[2]


def test_nothing_is_left_at_the_design_speed() -> None:
    k = np.linspace(0.0, 1.0, 11)
    assert np.all(residual_torque(1.0, k) == 0.0)
    assert drive_balancing_ratio(np.array([1.0]), 0.0)[0] == math.inf
    # standing still the device's own torque is left
    still = residual_torque(0.0, np.array([0.0]))
    assert -still[0] == pytest.approx(CASES["D20"]["M_dev_max"], rel=ROUNDING)


@given(speed=st.floats(0.05, 2.0).filter(lambda n: abs(n - 1.0) > 1e-3))
@examples(50)
def test_sweep_is_the_peak_of_the_residual(speed: float) -> None:
    without, left = speed_sweep(0.5, LAW, TIME, np.array([speed]))
    peak = float(np.abs(residual_torque(speed, np.linspace(0.0, 1.0, 101))).max())
    assert float(left[0]) == pytest.approx(peak, rel=ROUNDING)
    assert float(without[0]) == pytest.approx(inertia_torque_peak(0.5, LAW, TIME / speed), rel=ROUNDING)
    ratio = drive_balancing_ratio(np.array([speed]), 0.0)
    assert float(ratio[0]) == pytest.approx(float(without[0]) / peak, rel=ROUNDING)


def test_the_device_harms_at_low_speed() -> None:
    edge = math.sqrt(0.5)
    below, above = drive_balancing_ratio(np.array([edge - 1e-6, edge + 1e-6]), 0.0)
    assert below < 1.0 < above


def test_residual_fraction_of_the_measurements() -> None:
    for measured in (4.6, 3.4):
        assert drive_balancing_ratio(np.array([1.0]), 0.0, 1.0 / measured)[0] == pytest.approx(measured, rel=1e-15)


def test_friction_never_helps() -> None:
    speeds = np.linspace(0.1, 1.3, 25)
    assert np.all(drive_balancing_ratio(speeds, 0.0, 0.2) < drive_balancing_ratio(speeds, 0.0, 0.1))


def test_power_of_the_harmonic_law() -> None:
    law = ElasticLaw(Pneumatic(3.0), 1e-8)
    assert power_peak(lambda k: law.invariants(k)[1] * law.invariants(k)[2]) == pytest.approx(
        math.pi**3 / 8.0, rel=ROUNDING
    )


def test_refusals() -> None:
    with pytest.raises(NoSolution, match="speed 0 rev/min"):
        stroke_time(1.0, 0.0)
    with pytest.raises(NoSolution, match="must both be above 0"):
        inertia_torque_peak(0.0, LAW, 1.0)
    with pytest.raises(NoSolution, match="0 or more"):
        drive_balancing_ratio(np.array([-1.0]), 0.0)
    with pytest.raises(NoSolution, match="0 or more"):
        drive_balancing_ratio(np.array([1.0]), -0.1)
