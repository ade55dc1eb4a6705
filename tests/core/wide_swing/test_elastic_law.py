"""The law of motion of a rocker swung by its unloading device.

Tolerances
    LAW = 1e-14 of an invariant's peak: a Newton step on a sum of some 30 terms of 2e-16 each, against 40-digit
    references. Seen: 4 ulp.
    PEAK = 1e-15 relative for N, B, C: one sum of positive terms. Seen: 2 ulp.
    NEAR_ONE = 1e-12 for pivot ratios down to 1 + 1e-6, where the comparison itself is the harder part.
"""

from __future__ import annotations

import json
import math
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.unloading_limits import (
    energy_parameter,
    invariants,
    pendulum_displacement,
    pendulum_peaks,
    pendulum_stretch_ratio,
    small_swing_peaks,
    touching_pins_energy_parameter,
)
from sweeps import examples, mostly_slow

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Device, Pneumatic, Spring, least_pivot_ratio_pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.numerics.extremes import maximum_over

LAW, PEAK, NEAR_ONE = 1e-14, 1e-15, 1e-12
CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}

devices = st.one_of(
    st.builds(Pneumatic, st.floats(1.2, 20.0)), st.builds(Spring, st.floats(1.2, 20.0), st.floats(0.0, 3.0))
)
swings = st.floats(1e-3, math.radians(300.0))


def published() -> list[Any]:
    return [
        pytest.param("D01", Pneumatic(2.0), 60.0, id="D01"),
        pytest.param("D02", Pneumatic(2.5), 120.0, id="D02"),
        pytest.param("D03", Pneumatic(least_pivot_ratio_pneumatic(math.pi)), 180.0, id="D03"),
        pytest.param("D06", Spring(3.0, 3.0971675407097270603), 120.0, id="D06"),
        pytest.param("D08", Spring(4.0, 0.5), 180.0, id="D08"),
    ]


@pytest.mark.parametrize(("case", "device", "swing"), published())
def test_reference_laws(case: str, device: Device, swing: float) -> None:
    law, expected = ElasticLaw(device, math.radians(swing)), CASES[case]
    assert law.energy_parameter == pytest.approx(expected["N"], rel=2 * PEAK)
    assert law.velocity_peak == pytest.approx(expected["B"], rel=PEAK)
    assert law.acceleration_peak == pytest.approx(expected["C_peak"], rel=2 * PEAK)
    assert invariants(law, expected["k_peak"])[2] == pytest.approx(law.acceleration_peak, rel=2 * PEAK)
    for k, name in ((0.0, "0"), (0.1, "0.1"), (0.25, "0.25"), (0.4, "0.4"), (0.5, "0.5")):
        a, b, c = invariants(law, k)
        assert a == pytest.approx(expected[f"a({name})"], abs=LAW)
        assert b == pytest.approx(expected[f"b({name})"], abs=2 * LAW)
        assert c == pytest.approx(expected[f"c({name})"], abs=5 * LAW)


def test_pins_that_nearly_meet_follow_the_elliptic_limit() -> None:
    # D05 is the limit lambda = 1, which is no device; one ulp above it the law is the same away from mid-swing
    law, expected = ElasticLaw(Pneumatic(1.0 + 2.0**-52), math.radians(120.0)), CASES["D05"]
    assert law.energy_parameter == pytest.approx(expected["N"], rel=LAW)
    assert law.velocity_peak == pytest.approx(expected["B"], rel=LAW)
    for k in (0.1, 0.25, 0.4):
        np.testing.assert_allclose(invariants(law, k), [expected[f"{x}({k})"] for x in "abc"], rtol=LAW)
    assert touching_pins_energy_parameter(math.radians(120.0)) == pytest.approx(expected["N_elliptic"], rel=LAW)


def test_small_swings_follow_the_harmonic_and_the_duffing_law() -> None:
    expected = CASES["D10"]
    cylinder, spring = ElasticLaw(Pneumatic(3.0), 1e-8), ElasticLaw(Spring(3.0, 0.5), 1e-8)
    assert (cylinder.velocity_peak, cylinder.acceleration_peak) == pytest.approx(
        (expected["B_pneu"], expected["C_pneu"]), rel=2 * PEAK
    )
    assert (spring.velocity_peak, spring.acceleration_peak) == pytest.approx(
        (expected["B_spring"], expected["C_spring"]), rel=2 * PEAK
    )
    for device in (Pneumatic(3.0), Spring(3.0, 0.0), Spring(1.2, 0.5), Spring(50.0, 40.0)):
        law = ElasticLaw(device, 1e-8)
        assert (law.velocity_peak, law.acceleration_peak) == pytest.approx(small_swing_peaks(device), rel=4 * PEAK)
    k = np.linspace(0.0, 1.0, 11)
    np.testing.assert_allclose(cylinder.invariants(k)[0], np.sin(0.5 * math.pi * k) ** 2, rtol=LAW)


@pytest.mark.quick(2)
@pytest.mark.parametrize("swing", [60, 120, 180, 240, 300])
def test_long_cylinder_and_weightless_spring_are_pendulums(swing: int) -> None:
    expected, gamma = CASES["D11"], math.radians(swing)
    b, start, peak = pendulum_peaks(gamma)
    assert b == pytest.approx(expected[f"B_{swing}"], rel=2 * PEAK)
    assert peak == pytest.approx(expected[f"Cpk_{swing}"], rel=4 * PEAK)
    law = ElasticLaw(Spring(3.0, pendulum_stretch_ratio(3.0, gamma)), gamma)
    assert law.velocity_peak == pytest.approx(expected[f"B_{swing}"], rel=2 * PEAK)
    assert law.acceleration_peak == pytest.approx(expected[f"Cpk_{swing}"], rel=4 * PEAK)
    # 4 K^2 sin(gamma/2): the sine of an angle near pi has the condition gamma/2 |cot(gamma/2)|
    assert invariants(law, 0.0)[2] == pytest.approx(start, rel=10 * PEAK)
    # a cylinder differs from its limit by O(1/lambda)
    assert ElasticLaw(Pneumatic(1e8), gamma).velocity_peak == pytest.approx(b, rel=1e-7)
    k = np.linspace(0.0, 1.0, 21)
    np.testing.assert_allclose(law.invariants(k, 0)[0], pendulum_displacement(k, gamma), rtol=0, atol=LAW)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("device", "swing"),
    mostly_slow(
        [
            (Pneumatic(2.5), 120.0),
            (Spring(4.0, 0.5), 180.0),
            (Spring(1.5, 0.0), 300.0),
            (Pneumatic(1.05), 300.0),
            (Pneumatic(1.001), 120.0),
            (Spring(1.001, 0.1), 300.0),
            (Pneumatic(1.0 + 1e-6), 300.0),
        ],
        4,
    ),
)
def test_time_by_gauss_legendre_in_another_variable(device: Device, swing: float) -> None:
    """phi = th0 - v^2 removes the end singularity in its own way; adaptive panels resolve mid-swing."""
    law = ElasticLaw(device, math.radians(swing))
    with mp.workdps(30):
        gamma, lam = mp.mpf(law.swing), mp.mpf(device.pivot_ratio)
        th0 = gamma / 2
        longest, shortest = mp.sqrt(1 + lam**2 - 2 * lam * mp.cos(th0)), lam - 1

        def time(v: Any) -> Any:
            phi = th0 - v * v
            length = mp.sqrt(shortest**2 + 4 * lam * mp.sin(phi / 2) ** 2)
            x = 4 * lam * mp.sin(v * v / 2) * mp.sin(th0 - v * v / 2) / (longest + length)
            w = 1
            if isinstance(device, Spring):
                w = (1 + mp.mpf(device.stretch_ratio)) * (longest - shortest) - x / 2
            return 2 * v / mp.sqrt(w * x) if v else 2 / mp.sqrt(w * 2 * lam * mp.sin(th0) / longest / 2)

        def up_to(a: float) -> Any:
            near = [th0 * mp.mpf(4) ** -j for j in range(1, 13)]
            ends = [mp.sqrt(th0 - phi) for phi in [th0, *near] if phi > th0 - gamma * a]
            return mp.quad(time, [*ends, mp.sqrt(gamma * a)])

        half = up_to(0.5)
        energy_parameter = float((2 * half / gamma) ** 2)
        places = {a: float(up_to(a) / half / 2) for a in (1e-6, 0.02, 0.2, 0.45)}
    assert law.energy_parameter == pytest.approx(energy_parameter, rel=1e-14 if device.pivot_ratio > 1.01 else NEAR_ONE)
    for a, k in places.items():
        assert invariants(law, k)[0] == pytest.approx(a, rel=1e-14 if device.pivot_ratio > 1.01 else NEAR_ONE)


@given(device=devices, swing=swings)
@examples(60)
def test_invariants_are_each_other_s_integrals(device: Device, swing: float) -> None:
    """24 Gauss points on each of 8 panels of half a stroke: the integrand's own rounding remains."""
    law = ElasticLaw(device, swing)
    x, w = np.polynomial.legendre.leggauss(24)
    k = np.concatenate([(i + 0.5 * (x + 1.0)) / 16.0 for i in range(8)])
    weights = np.tile(w / 32.0, 8)
    _, b, c, jerk = law.invariants(k, 3)
    assert float(weights @ b) == pytest.approx(0.5, abs=1e-13)
    assert float(weights @ c) == pytest.approx(law.velocity_peak, rel=1e-13)
    assert float(weights @ jerk) == pytest.approx(-invariants(law, 0.0)[2], abs=1e-12 * law.acceleration_peak)


@pytest.mark.slow
@given(device=devices, swing=swings, k=st.floats(0.0, 1.0))
@examples(150)
def test_symmetry_about_mid_swing_and_energy(device: Device, swing: float, k: float) -> None:
    law = ElasticLaw(device, swing)
    a, b, c, jerk = invariants(law, k, 3)
    mirror = invariants(law, 1.0 - k, 3)
    # 1 - k rounds: the condition of each invariant in k is the next one
    slack = 2.0**-52
    assert mirror[0] == pytest.approx(1.0 - a, abs=4 * slack)
    assert mirror[1] == pytest.approx(b, abs=slack * (4 + law.acceleration_peak))
    assert mirror[2] == pytest.approx(-c, abs=slack * (16 * law.acceleration_peak + abs(law.middle_jerk)))
    assert abs(c) <= law.acceleration_peak * (1 + 8 * slack)
    assert 0.0 <= b <= law.velocity_peak * (1 + 4 * slack)
    peak = maximum_over(lambda x: law.invariants(x)[2], 0.0, 0.5, samples=64)
    assert peak.value == pytest.approx(law.acceleration_peak, rel=1e-13)
    assert jerk <= 0.0 or abs(k - 0.5) > 0.5 - peak.place - 1e-7
    view = law.middle_view(np.array([k]))
    assert float(view.deficit[0]) == pytest.approx(law.velocity_peak - b, abs=8 * slack * law.velocity_peak)
    assert float(view.angle[0]) == pytest.approx((a - 0.5) * swing, abs=4 * slack * swing)


@given(device=devices, swing=swings)
@examples(60)
def test_acceleration_peak_is_the_largest_of_a_fine_sweep(device: Device, swing: float) -> None:
    law = ElasticLaw(device, swing)
    sweep = float(np.max(law.invariants(np.linspace(0.0, 0.5, 401))[2]))
    # samples miss a smooth top by at most |c''| h^2/8; |c''| stays below 1e3 C down to pivot ratio 1.2
    assert sweep * (1 - 1e-14) <= law.acceleration_peak <= sweep * (1 + 1e3 / 8 / 800**2)


def test_exact_places_and_small_times() -> None:
    for k in (5e-324, 2.3e-313, 1e-300):  # subnormal numbers and their neighbours
        assert invariants(ElasticLaw(Pneumatic(1.5), 2.0), k)[0] == pytest.approx(0.0, abs=1e-300)
    law = ElasticLaw(Spring(1.3, 0.2), math.radians(250.0))
    start = invariants(law, 0.0)[2]
    assert invariants(law, 0.0, 3) == (0.0, 0.0, start, 0.0)
    assert invariants(law, 0.5)[0] == 0.5
    assert invariants(law, 0.5, 3)[1:] == (pytest.approx(law.velocity_peak, rel=2e-16), 0.0, law.middle_jerk)
    assert invariants(law, 1.0)[:2] == (1.0, 0.0)
    # a = c(0) k^2/2 near the start, to full relative accuracy
    assert invariants(law, 1e-9)[0] == pytest.approx(0.5e-18 * start, rel=1e-14)
    k = np.array([[0.1, 0.2], [0.6, 1.0]])
    assert law.invariants(k, 3)[3].shape == (2, 2)
    assert len(invariants(law, 0.3, 0)) == 1


def test_law_is_frozen_and_lazy() -> None:
    law = ElasticLaw(Pneumatic(2.5), 2.0)
    assert "clock" not in vars(law)
    assert invariants(law, 0.5)[0] == 0.5
    assert "clock" in vars(law)
    with pytest.raises(AttributeError):
        law.swing = 1.0  # type: ignore[misc]


# pivot ratio, swing, and the error of N with 4, 8, 16, 32, 64, 128 nodes: it falls geometrically down to rounding
CONVERGENCE = [
    (4.0, 60.0, (7.1e-13, 0, 0, 0, 0, 0)),
    (2.5, 120.0, (3.3e-7, 5.7e-14, 0, 0, 0, 0)),
    (2.5, 300.0, (5.8e-2, 2.4e-3, 5.1e-6, 3.3e-11, 0, 0)),
    (1.05, 120.0, (7.3e-3, 1.2e-5, 5.6e-11, 0, 0, 0)),
    (1.001, 120.0, (1.6e-1, 4.9e-3, 5.7e-6, 1.2e-11, 0, 0)),
    (1.0 + 1e-6, 120.0, (6.3e-1, 1.2e-1, 2.6e-3, 1.7e-6, 1.1e-12, 0)),
]


@pytest.mark.parametrize(("ratio", "swing", "table"), CONVERGENCE)
def test_convergence_of_the_quadrature(ratio: float, swing: float, table: tuple[float, ...]) -> None:
    law = ElasticLaw(Pneumatic(ratio), math.radians(swing))
    for nodes, expected in zip((4, 8, 16, 32, 64, 128), table, strict=True):
        error = abs(energy_parameter(law, nodes) / law.energy_parameter - 1.0)
        # the entries are rounded to two digits; rounding of N itself is 2e-15
        assert error == pytest.approx(expected, rel=0.06, abs=2e-15)


def test_elliptic_substitution_beats_the_pendulum_angle_alone() -> None:
    law = ElasticLaw(Pneumatic(1.001), math.radians(120.0))

    def pendulum_rule(nodes: int) -> float:
        u = (np.arange(nodes) + 0.5) * (0.5 * math.pi / nodes)
        return float((math.pi / law.swing * np.mean(law.slowness(np.sin(u), np.cos(u)))) ** 2)

    assert abs(pendulum_rule(64) / law.energy_parameter - 1.0) > 1e-6
    assert abs(energy_parameter(law, 64) / law.energy_parameter - 1.0) < 2e-15


@pytest.mark.quick(1)
@pytest.mark.parametrize("ratio", [1.0 + 1e-15, 1.0 + 1e-6, 1.001, 1.5, 1e12])
@pytest.mark.parametrize("swing", [1e-8, 1.0, math.radians(300.0)])
def test_every_device_settles_to_rounding(ratio: float, swing: float) -> None:
    for device in (Pneumatic(ratio), Spring(ratio, 0.0), Spring(ratio, 0.5)):
        law = ElasticLaw(device, swing)
        assert law.clock.difference <= 8 * 2.0**-52
        assert law.clock.nodes <= 4096
        a = law.invariants(np.linspace(0.0, 1.0, 41), 0)[0]
        assert np.all(np.diff(a) > 0.0)


@pytest.mark.parametrize(
    ("swing", "shown"), [(0.0, "0 deg"), (-1.0, "-57"), (math.radians(341.0), "341 deg"), (math.nan, "nan")]
)
def test_swing_outside_its_range(swing: float, shown: str) -> None:
    with pytest.raises(NoSolution, match=rf"swing: {shown}.*at most 340 deg.*gear stage"):
        ElasticLaw(Pneumatic(2.5), swing)


@pytest.mark.parametrize("k", [-1e-12, 1.0000001, math.nan])
def test_place_outside_the_stroke(k: float) -> None:
    with pytest.raises(NoSolution, match="between 0 and 1"):
        invariants(ElasticLaw(Pneumatic(2.5), 1.0), k)


@pytest.mark.parametrize("ratio", [1.01, 1.3, 2.5])
def test_a_place_takes_little_more_than_one_step(monkeypatch: pytest.MonkeyPatch, ratio: float) -> None:
    law, k, asked = ElasticLaw(Pneumatic(ratio), math.radians(120.0)), np.linspace(0.0, 1.0, 2001), []
    law.invariants(k)
    of_angle = ElasticLaw.slowness
    monkeypatch.setattr(
        ElasticLaw, "slowness", lambda self, sine, cosine: asked.append(sine.size) or of_angle(self, sine, cosine)
    )
    law.invariants(k[1:-1])
    assert sum(asked) < 1.1 * k.size


@given(device=devices, swing=swings, k=st.floats(1e-6, 0.4999))
@examples(40)
def test_the_pendulum_angle_gives_the_motion_that_the_time_gives(device: Device, swing: float, k: float) -> None:
    law = ElasticLaw(device, swing)
    for share in (k - 0.5, 0.5 - k):
        turn = np.array([law.turn_at(share)])
        assert float(law.share_from_middle(turn)[0]) == pytest.approx(share, rel=1e-13)
        seen, expected = law.view_at(turn), law.middle_view(np.array([0.5 + share]))
        assert float(seen.angle[0]) == pytest.approx(float(expected.angle[0]), rel=1e-12)
        assert float(seen.velocity[0]) == pytest.approx(float(expected.velocity[0]), rel=1e-9, abs=1e-12)
        assert float(seen.deficit[0]) == pytest.approx(float(expected.deficit[0]), rel=1e-9)
        assert float(seen.acceleration[0]) == pytest.approx(float(expected.acceleration[0]), rel=1e-8, abs=1e-12)
    assert law.turn_near(1e-7) == pytest.approx(law.turn_at(1e-7), rel=1e-5)
    assert law.share_from_middle(np.array(law.turns)) == pytest.approx([-0.5, 0.5], rel=1e-14)
