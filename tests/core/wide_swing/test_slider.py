"""Slider driven by a wide-swing rocker.

Tolerances: 1e-14 relative against 20-digit references (one integral, one Newton inversion); 1e-11 for an ODE route,
whose own step control is set to 1e-13; 1e-12 for Gauss integrals of the invariants.
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
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.slider import SliderDrive, SliderLaw, reference_inertia

EXPECTED = next(
    case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
    if case["id"] == "D17"
)
SWING = math.radians(120.0)
DRIVE = SliderDrive(crank=1.0, rod=3.0, middle_angle=0.5 * math.pi)


def test_reference() -> None:
    law = SliderLaw(Pneumatic(2.5), SWING, DRIVE)
    assert law.energy_parameter == pytest.approx(EXPECTED["N"], rel=1e-14)
    assert law.middle_place == pytest.approx(EXPECTED["k_mid"], rel=1e-14)
    assert law.stroke == pytest.approx(EXPECTED["H_over_R"], rel=1e-15)
    k = np.array([0.0, law.middle_place])
    a, b = law.invariants(k, 1)
    assert a[1] == pytest.approx(0.5, abs=1e-14)
    assert b.tolist() == pytest.approx([EXPECTED["b_start"], EXPECTED["b_mid"]], rel=1e-14)
    _, slider_velocity, slider_acceleration = law.slider_invariants(k)
    assert slider_velocity[1] == pytest.approx(EXPECTED["bs_mid"], rel=1e-14)
    # at rest c_s = b_kp c
    assert slider_acceleration[0] / law.invariants(k)[2][0] == pytest.approx(EXPECTED["ukp_start"], rel=1e-14)


def test_rocker_alone_is_the_plain_law() -> None:
    law = SliderLaw(Spring(4.0, 0.5), SWING, DRIVE, rocker_share=1.0)
    plain = ElasticLaw(Spring(4.0, 0.5), SWING)
    assert law.energy_parameter == pytest.approx(plain.energy_parameter, rel=2e-15)
    k = np.linspace(0.0, 1.0, 17)
    for mine, theirs in zip(law.invariants(k), plain.invariants(k), strict=True):
        np.testing.assert_allclose(mine, theirs, rtol=0, atol=2e-14)


@pytest.mark.slow
@given(
    ratio=st.floats(1.3, 10.0),
    swing=st.floats(0.2, 2.2),
    rod=st.floats(1.6, 10.0),
    offset=st.floats(-0.4, 0.4),
    share=st.floats(0.02, 1.0),
)
@examples(40)
def test_invariants_are_each_other_s_integrals(
    ratio: float, swing: float, rod: float, offset: float, share: float
) -> None:
    law = SliderLaw(Pneumatic(ratio), swing, SliderDrive(1.0, rod, 0.5 * math.pi, offset), share)
    x, w = np.polynomial.legendre.leggauss(24)
    k = np.concatenate([(i + 0.5 * (x + 1.0)) / 24.0 for i in range(24)])
    weights = np.tile(w / 48.0, 24)
    _, b, c = law.invariants(k)
    _, slider_velocity, slider_acceleration = law.slider_invariants(k)
    largest = float(np.abs(c).max() + np.abs(slider_acceleration).max())
    assert float(weights @ b) == pytest.approx(1.0, abs=1e-12)
    assert float(weights @ c) == pytest.approx(0.0, abs=1e-12 * largest)
    assert abs(float(weights @ slider_velocity)) == pytest.approx(1.0, abs=1e-12)
    assert float(weights @ slider_acceleration) == pytest.approx(0.0, abs=1e-12 * largest)


def test_energy_balance_of_slider_and_device() -> None:
    """b_s of the slider alone is sqrt(N E): the kinetic energy of its mass is the device's."""
    law = SliderLaw(Pneumatic(2.5), SWING, DRIVE)
    k = np.linspace(0.0, 1.0, 9)
    a = law.invariants(k, 0)[0]
    lengths = np.sqrt(1.0 + 2.5**2 - 5.0 * np.cos((0.5 - a) * SWING))
    energy = law.geometry.longest - lengths
    np.testing.assert_allclose(law.slider_invariants(k)[1] ** 2, law.energy_parameter * energy, rtol=0.0, atol=1e-13)


def test_motion_by_integrating_the_differential_equation() -> None:
    """a'' = c(a, a') with j a'' + j_a a'^2/2 = (N/2) E_a, from k = 0.1 on, by DOP853."""
    from scipy.integrate import solve_ivp

    law = SliderLaw(Pneumatic(2.5), SWING, DRIVE, rocker_share=0.3)

    def rates(_: float, state: np.ndarray) -> list[float]:
        phi = np.array([(state[0] - 0.5) * SWING])
        _, first, second = DRIVE.depth(phi, 2)
        rate, change = float(first[0]) * SWING / law.stroke, float(second[0]) * SWING**2 / law.stroke
        inertia, inertia_change = 0.3 + 0.7 * rate**2, 1.4 * rate * change
        push = 2.5 * SWING * math.sin(-float(phi[0])) / math.sqrt(1.0 + 6.25 - 5.0 * math.cos(float(phi[0])))
        return [state[1], 0.5 * (law.energy_parameter * push - inertia_change * state[1] ** 2) / inertia]

    start = [float(x[0]) for x in law.invariants(np.array([0.1]), 1)]
    run = solve_ivp(rates, (0.1, 0.95), start, method="DOP853", rtol=1e-13, atol=1e-14, t_eval=[0.3, 0.6, 0.95])
    a, b = law.invariants(run.t, 1)
    np.testing.assert_allclose(run.y[0], a, rtol=1e-11)
    np.testing.assert_allclose(run.y[1], b, rtol=1e-11)


def test_small_times_at_both_ends() -> None:
    law = SliderLaw(Pneumatic(2.5), SWING, DRIVE)
    k = np.array([1e-9])
    start = float(law.invariants(np.zeros(1))[2][0])
    assert float(law.invariants(k, 0)[0][0]) == pytest.approx(0.5e-18 * start, rel=1e-13)
    assert [float(x[0]) for x in law.invariants(np.ones(1), 1)] == [1.0, 0.0]


def test_reference_inertia() -> None:
    total, share = reference_inertia(0.02, 4.0, 200.0, 2.0)
    assert (total, share) == pytest.approx((0.02 + 4.0 * 0.01, 1.0 / 3.0), rel=1e-15)
    with pytest.raises(NoSolution, match="one must be above 0"):
        reference_inertia(0.0, 0.0, 200.0, 2.0)


def test_refusals() -> None:
    with pytest.raises(NoSolution, match=r"rod: 1\.2 mm .limit > 1\.5 mm, crank . offset"):
        SliderDrive(1.0, 1.2, 1.5, -0.5)
    toward_dead_center = SliderDrive(1.0, 3.0, math.radians(50.0))
    with pytest.raises(NoSolution, match=r"dead centre lies -50 deg from mid-swing, inside the half swing of 60 deg"):
        SliderLaw(Pneumatic(2.5), SWING, toward_dead_center)
    # with the rocker's own inertia the speed stays bounded
    assert SliderLaw(Pneumatic(2.5), SWING, toward_dead_center, 0.2).energy_parameter > 0.0
    with pytest.raises(NoSolution, match="ends where it began"):
        SliderLaw(Pneumatic(2.5), SWING, SliderDrive(1.0, 3.0, 0.0), 0.5)
    with pytest.raises(NoSolution, match=r"share of the rocker in the inertia: 1\.5"):
        SliderLaw(Pneumatic(2.5), SWING, DRIVE, 1.5)
    with pytest.raises(NoSolution, match="between 0 and 1"):
        SliderLaw(Pneumatic(2.5), SWING, DRIVE).invariants(np.array([1.1]))
    # a rocker share of 1e-9 beside a dead centre leaves an integrand that no rule of 8192 nodes resolves
    with pytest.raises(NoSolution, match="too sharply within the stroke"):
        _ = SliderLaw(Pneumatic(2.5), SWING, toward_dead_center, 1e-9).energy_parameter


def test_dead_centers_with_offset() -> None:
    drive = SliderDrive(1.0, 3.0, 0.3, 0.4)
    for angle in drive.dead_centers():
        assert float(drive.depth(np.array([angle]), 1)[1][0]) == pytest.approx(0.0, abs=1e-15)
