"""Torsional elasticity of the drive.

Tolerances: 1e-13 for the closed response (some 40 terms); the place of a smooth peak is known to the root of that.
An integration by DOP853 at 1e-12 is the second route.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import factory
import numpy as np
import pytest
from sweeps import mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.slider import SliderDrive, SliderLaw
from gearlink.core.machines.wide_swing.torques import TorsionResponse, acceleration_series, dynamic_coefficient, peak_of

EXPECTED = next(
    case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
    if case["id"] == "D21"
)
HARMONIC = acceleration_series(lambda k: 0.5 * math.pi**2 * np.cos(math.pi * k))


@pytest.mark.quick(2)
@pytest.mark.parametrize("stiffness", [10, 20, 40])
def test_reference(stiffness: int) -> None:
    coefficient, place = dynamic_coefficient(HARMONIC, float(stiffness))
    assert coefficient == pytest.approx(EXPECTED[f"Kd(omegaT={stiffness})"], rel=1e-14)
    assert place == pytest.approx(EXPECTED[f"k_at(omegaT={stiffness})"], abs=1e-8)


@pytest.mark.parametrize("law", [ElasticLaw(Pneumatic(2.5), 2.0), ElasticLaw(Spring(1.5, 0.1), 4.5)])
def test_series_is_the_law(law: ElasticLaw) -> None:
    series = acceleration_series(lambda k: law.invariants(k)[2])
    k = np.linspace(0.0, 1.0, 23)
    waves = math.pi * np.arange(len(series.coefficients))
    np.testing.assert_allclose(
        np.cos(np.outer(k, waves)) @ series.coefficients, law.invariants(k)[2], rtol=0.0, atol=1e-13
    )
    # c(1 - k) = -c(k): only odd waves
    assert np.abs(series.coefficients[::2]).max() < 1e-14


def test_peak_of_the_series_is_that_of_the_law() -> None:
    """The sum of all waves over the time against a search over the angle."""
    drive = SliderDrive(1.0, 3.0, 0.5 * math.pi)
    for law in (ElasticLaw(Spring(1.5, 0.1), 4.5), SliderLaw(Pneumatic(2.5), 2.0, drive, 0.3)):
        series = acceleration_series(law.device_torque)
        waves, k = math.pi * np.arange(len(series.coefficients)), np.linspace(0.0, 1.0, 4001)
        assert law.torque_peak == pytest.approx(peak_of(series), rel=1e-13)
        assert law.torque_peak == pytest.approx(
            np.abs(np.cos(np.outer(k, waves)) @ series.coefficients).max(), rel=1e-6
        )


@pytest.mark.parametrize(
    ("stiffness", "damping"), mostly_slow([(5.0, 0.7), (3.0 * math.pi, 0.0), (12.0, 0.0), (25.0, 0.08)], 1)
)
def test_response_by_integrating_the_differential_equation(stiffness: float, damping: float) -> None:
    """The second case is an undamped resonance with the third harmonic."""
    from scipy.integrate import solve_ivp

    law = ElasticLaw(Spring(4.0, 0.5), math.radians(180.0))
    response = TorsionResponse(acceleration_series(lambda k: law.invariants(k)[2]), stiffness, damping)

    def rates(k: float, state: np.ndarray) -> list[float]:
        drive = float(law.invariants(np.array([min(k, 1.0)]))[2][0]) - state[0]
        return [state[1], stiffness**2 * drive - 2.0 * damping * stiffness * state[1]]

    run = solve_ivp(rates, (0.0, 1.0), [0.0, 0.0], method="DOP853", rtol=1e-11, atol=1e-12, t_eval=[0.2, 0.5, 0.9, 1.0])
    np.testing.assert_allclose(response(run.t), run.y[0], rtol=0.0, atol=1e-9)


@pytest.mark.slow
def test_stiff_drive_feels_the_step_at_the_start() -> None:
    for damping in (0.0, 0.05, 0.2):
        step = 1.0 + math.exp(-math.pi * damping / math.sqrt(1.0 - damping**2))
        assert dynamic_coefficient(HARMONIC, 2000.0, damping)[0] == pytest.approx(step, rel=2e-3)


def test_weak_damping_tends_to_none() -> None:
    for stiffness in (7.0, math.pi):
        k = np.linspace(0.0, 1.0, 11)
        bare, damped = TorsionResponse(HARMONIC, stiffness)(k), TorsionResponse(HARMONIC, stiffness, 1e-6)(k)
        np.testing.assert_allclose(damped, bare, rtol=0.0, atol=1e-4)


def test_refusals() -> None:
    with pytest.raises(NoSolution, match="natural frequency times stroke time: 0"):
        dynamic_coefficient(HARMONIC, 0.0)
    with pytest.raises(NoSolution, match=r"damping ratio: 1 .at least 0, below 1"):
        dynamic_coefficient(HARMONIC, 10.0, 1.0)
    with pytest.raises(NoSolution, match=r"omit the section shaft, or make speed 3 times higher"):
        dynamic_coefficient(HARMONIC, 60_000.0)


def test_a_rocker_too_sharp_for_the_sum_is_refused_in_the_design_s_terms() -> None:
    """Beside a pivot ratio of 1 the rocker turns over within a share of the stroke that 8192 terms do not resolve."""
    made = factory.design("wide_swing_twin_cam", command="swing", unloader__pivot_ratio=1.0001)
    with pytest.raises(NoSolution, match=r"increase unloader.pivot_ratio, reduce swing, or omit shaft") as refusal:
        made.raw("dynamic_coefficient")
    assert refusal.value.key == "shaft"
    assert "nodes" not in str(refusal.value)
