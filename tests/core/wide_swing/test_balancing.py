"""Torques with and without the unloading device.

Tolerances: 1e-14 relative, products of numbers known to 1e-15; a maximum found by sampling and refining is exact to
rounding where it is smooth.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from pydantic import ValidationError
from sweeps import examples

from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.torques import Unloading

ROUNDING = 1e-14
CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
SWING = math.radians(120.0)
LAW = ElasticLaw(Pneumatic(2.5), SWING)
TIME = CASES["D20"]["T0"]


def unloading(residual: float = 0.0, linkage: float = 0.0, **changes: Any) -> Unloading:
    """That of D20: a rocker of 0.5 kg m^2 and its cylinder, at 1.66 revolutions a second."""
    device = {"type": "pneumatic", "pivot_ratio": 2.5, "arm": 120.0, "residual": residual}
    shaft = {"natural_frequency": 60.0, "linkage_share": linkage}
    given = {"inertia": 0.5, "speed": 60.0 * 1.66, "unloader": device, "shaft": shaft} | changes
    made: Unloading = factory.design("wide_swing_twin_cam", command="swing", **given).unloading
    return made


def ratios(speeds: Any, residual: float = 0.0) -> Any:
    return unloading(residual).balancing_ratios(np.array(speeds))


def test_reference() -> None:
    expected, own = CASES["D20"], unloading()
    assert own.motion.stroke_time == pytest.approx(TIME, rel=1e-15)
    assert own.torque_peaks(np.ones(1))[0][0] == pytest.approx(expected["M_in_max"], rel=ROUNDING)
    assert own.motion.law.power_peak == pytest.approx(expected["bc_max"], rel=ROUNDING)
    speeds = np.array([0.5, 1.0, 1.5, 1.8]) / 1.66
    listed = [expected[f"Ky(n={n})"] for n in ("0.5", "1.0", "1.5", "1.8")]
    # near n0 the difference of squares has the condition n^2/|n^2 - n0^2| in the rounded ratio
    np.testing.assert_allclose(ratios(speeds), listed, rtol=2e-15)


def test_device_torque_is_the_inertia_torque_at_the_design_speed() -> None:
    """Largest of P r_d lambda sin(phi)/l, by the law of sines, against J gamma C/T^2."""
    push = unloading().force
    assert push is not None
    phi = np.linspace(0.0, 0.5 * SWING, 2001)
    torque = push * 0.12 * 2.5 * np.sin(phi) / np.sqrt(1.0 + 6.25 - 5.0 * np.cos(phi))
    assert float(torque.max()) == pytest.approx(CASES["D20"]["M_dev_max"], rel=ROUNDING)


def residual_torque(speed_ratio: float, k: np.ndarray) -> np.ndarray:
    """Torque that the device leaves to the drive, J gamma c(k) (1/T^2 - 1/T0^2) with T0/T = n/n0."""
    return 0.5 * LAW.swing / TIME**2 * (speed_ratio - 1.0) * (speed_ratio + 1.0) * LAW.invariants(k, 2)[2]


def test_nothing_is_left_at_the_design_speed() -> None:
    k = np.linspace(0.0, 1.0, 11)
    assert np.all(residual_torque(1.0, k) == 0.0)
    assert ratios([1.0])[0] == math.inf
    assert unloading().drive_balancing_ratio is None
    # standing still the device's own torque is left
    still = residual_torque(0.0, np.array([0.0]))
    assert -still[0] == pytest.approx(CASES["D20"]["M_dev_max"], rel=ROUNDING)


@given(speed=st.floats(0.05, 2.0).filter(lambda n: abs(n - 1.0) > 1e-3))
@examples(50)
def test_sweep_is_the_peak_of_the_residual(speed: float) -> None:
    own = unloading()
    without, left = own.torque_peaks(np.array([speed]))
    peak = float(np.abs(residual_torque(speed, np.linspace(0.0, 1.0, 101))).max())
    assert float(left[0]) == pytest.approx(peak, rel=ROUNDING)
    alone = 0.5 * SWING * LAW.acceleration_peak / (TIME / speed) ** 2
    assert float(without[0]) == pytest.approx(alone, rel=ROUNDING)
    assert float(own.balancing_ratios(np.array([speed]))[0]) == pytest.approx(float(without[0]) / peak, rel=ROUNDING)


def test_the_device_harms_at_low_speed() -> None:
    edge = math.sqrt(0.5)
    below, above = ratios([edge - 1e-6, edge + 1e-6])
    assert below < 1.0 < above


def test_residual_fraction_of_the_measurements() -> None:
    for measured in (4.6, 3.4):
        assert ratios([1.0], 1.0 / measured)[0] == pytest.approx(measured, rel=1e-15)


def test_linkage_that_is_not_unloaded() -> None:
    """At the design speed the device takes away all but g of 1 + g."""
    assert unloading(linkage=0.25).balancing_ratios(np.array([1.0])).tolist() == [5.0]
    assert unloading(linkage=0.25).drive_balancing_ratio == 5.0


def test_friction_never_helps() -> None:
    speeds = np.linspace(0.1, 1.3, 25)
    assert np.all(ratios(speeds, 0.2) < ratios(speeds, 0.1))


def test_power_of_the_harmonic_law() -> None:
    own = unloading(swing=1e-6, unloader={"type": "pneumatic", "pivot_ratio": 3.0, "arm": 120.0}, cam=None)
    assert own.motion.law.power_peak == pytest.approx(math.pi**3 / 8.0, rel=ROUNDING)


@pytest.mark.parametrize(
    ("key", "value"),
    [
        ("speed", 0.0),
        ("speed", math.inf),
        ("inertia", 0.0),
        ("cycle_angle", 0.0),
        ("unloader__residual", -0.1),
        ("unloader__reserve", -0.1),
        ("shaft__linkage_share", -0.1),
    ],
)
def test_refusals(key: str, value: float) -> None:
    """What no formula here is made for is refused with the file."""
    with pytest.raises(ValidationError, match=key.rpartition("__")[2]):
        factory.design("wide_swing_twin_cam", command="swing", **{key: value})
