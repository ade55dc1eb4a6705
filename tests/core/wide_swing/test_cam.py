"""Twin-cam and twin-rocker profiles.

Tolerances
    POINT = 1e-14 centre distances: references are 20-digit numbers, the chain has some ten roundings. Seen: 4e-16.
    ANGLE = 1e-14 rad. Seen: 4e-16.
    BEND = 1e-13 relative for curvature radii: products free of cancellation, also close to the cusp.
    EDGE = 1e-13 for extremes that lie at an end of the stroke: the search steps a few ulp inside it.
"""

from __future__ import annotations

import json
import math
from dataclasses import replace
from pathlib import Path
from typing import Any

import mpmath as mp
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from oracles.unloading_limits import pendulum_stretch_ratio
from sweeps import examples

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.machines.wide_swing.cam import Layout, WideSwingCam
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw, MiddleView

POINT, ANGLE, BEND, EDGE = 1e-14, 1e-14, 1e-13, 1e-13
CASES = {
    case["id"]: case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
}
LAW = ElasticLaw(Pneumatic(2.5), math.radians(120.0))
LAYOUTS: list[Layout] = ["twin-cam", "twin-rocker"]


def cam(layout: Layout, scale: float = 1.0) -> WideSwingCam:
    """The cams of D13 and D15."""
    cycle, roller = (120.0, 0.04) if layout == "twin-cam" else (80.0, 0.02)
    return WideSwingCam(layout, LAW, math.radians(cycle), scale, roller * scale)


class Harmonic:
    """The harmonic law as a second kind of law: a = sin^2(pi k/2)."""

    place, offset, acceleration, symmetric = 0.5, 0.0, 0.0, True

    def __init__(self, swing: float) -> None:
        self.swing = swing
        self.velocity_peak = 0.5 * math.pi
        self.middle_jerk = -0.5 * math.pi**3
        self.turns = (-0.5, 0.5)

    def view_at(self, turn: np.ndarray) -> MiddleView:
        return self.middle_view(0.5 + turn)

    def share_from_middle(self, turn: np.ndarray) -> np.ndarray:
        return turn

    def turn_at(self, share: float) -> float:
        return share

    turn_near = turn_at

    def middle_view(self, k: np.ndarray) -> MiddleView:
        from_middle = math.pi * (k - 0.5)
        return MiddleView(
            0.5 * self.swing * np.sin(from_middle),
            self.velocity_peak * np.cos(from_middle),
            2.0 * self.velocity_peak * np.sin(0.5 * from_middle) ** 2,
            -0.5 * math.pi**2 * np.sin(from_middle),
        )


@pytest.mark.parametrize(("case", "layout"), [("D13", "twin-cam"), ("D15", "twin-rocker")])
def test_reference_profiles(case: str, layout: Layout) -> None:
    expected, mechanism = CASES[case], cam(layout)
    named = {
        "lam_c": mechanism.rocker_radius,
        "rho_mid": mechanism.middle_radius,
        "rho_ext": mechanism.end_radius,
        "xi_ext": mechanism.profile_correction,
        "xi_max": mechanism.largest_profile_correction,
        "phase": mechanism.phase_angle,
        "cusp_p": mechanism.cusp[0],
        "cusp_q": mechanism.cusp[1],
    }
    assert named == pytest.approx({key: expected[key] for key in named}, abs=POINT)
    assert mechanism.start_curvature_radius == pytest.approx(expected["R0_closed"], rel=BEND)
    points = mechanism.points(np.array([0.0, 0.1, 0.25, 0.4, 0.45]))
    for i, k in enumerate(("0", "0.1", "0.25", "0.4", "0.45")):
        assert abs(points.pitch[i]) == pytest.approx(expected[f"rho({k})"], abs=POINT)
        assert points.polar_angle[i] == pytest.approx(expected[f"Theta({k})"], abs=ANGLE)
        assert points.curvature_radius[i] == pytest.approx(expected[f"R({k})"], rel=BEND)
        assert points.pressure_angle[i] == pytest.approx(math.radians(expected[f"delta_deg({k})"]), abs=ANGLE)
    assert points.pitch[2] == pytest.approx(complex(expected["pitch_x(0.25)"], expected["pitch_y(0.25)"]), abs=POINT)
    assert points.profile[2] == pytest.approx(complex(expected["prof_x(0.25)"], expected["prof_y(0.25)"]), abs=POINT)


def test_millimetres_of_the_acceptance_cases() -> None:
    external, internal = cam("twin-cam", 200.0), cam("twin-rocker", 200.0)
    assert (external.rocker_radius, external.min_radius, external.max_radius) == pytest.approx(
        (74.41794957797039, 125.58205042202961, 175.0840978038704), rel=1e-15
    )
    assert math.degrees(external.profile_correction) == pytest.approx(21.598268226307255, rel=1e-14)
    assert external.start_curvature_radius == pytest.approx(93.36079828327266, rel=BEND)
    assert (internal.rocker_radius, internal.min_radius, internal.max_radius) == pytest.approx(
        (130.60921812679936, 288.41049128811824, 330.60921812679936), rel=1e-15
    )
    assert math.degrees(internal.phase_angle) == pytest.approx(16.909338463807764, rel=1e-14)
    assert internal.start_curvature_radius == pytest.approx(-1053.0230828037634, rel=BEND)


def pendulum_curve(layout: Layout, swing: float, cycle: float) -> tuple[Any, Any]:
    """The pitch curve z(k) over a = 1 and the rocker angle phi(k) of the pendulum law, in mpmath, analytic in k."""
    g, turn = mp.mpf(swing), mp.mpf(cycle)
    m = mp.sin(g / 4)
    quarter = mp.ellipk(m * m)
    peak = 4 * quarter * m / g * g / turn
    ratio = 1 / (peak + 1) if layout == "twin-cam" else 1 / (peak - 1)

    def phi(k: Any) -> Any:
        return -2 * mp.asin(m * mp.ellipfun("sn", quarter * (1 - 2 * k), m=m * m))

    def curve(k: Any) -> Any:
        if layout == "twin-cam":
            return mp.expj((k - 0.5) * turn) * (-1 + ratio * mp.expj(phi(k)))
        return mp.expj(-(k - 0.5) * turn) * (1 + ratio * mp.expj(phi(k)))

    return curve, phi


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("layout", "swing", "cycle"),
    [("twin-cam", 120, 120), ("twin-cam", 290, 100), ("twin-rocker", 160, 70), ("twin-rocker", 240, 150)],
)
def test_curvature_and_normal_by_differentiating_the_curve(layout: Layout, swing: int, cycle: int) -> None:
    """Up to 2^-20 of a stroke from the cusp, where formulas with differences have lost twelve digits."""
    gamma, turn = math.radians(swing), math.radians(cycle)
    law = ElasticLaw(Spring(3.0, pendulum_stretch_ratio(3.0, gamma)), gamma)
    mechanism = WideSwingCam(layout, law, turn, 1.0, 0.01)
    k = np.array([0.05, 0.2, 0.35, 0.5 - 2.0**-7, 0.5 - 2.0**-20, 0.5 + 2.0**-20, 0.7, 0.99])
    points = mechanism.points(k)
    with mp.workdps(50):
        curve, _ = pendulum_curve(layout, gamma, turn)
        for i, place in enumerate(k.tolist()):
            z, first, second = (mp.diff(curve, mp.mpf(place), n) for n in range(3))
            # left normal of the direction of motion, turned inward
            side = 1 if mp.im(mp.conj(z) * first) > 0 else -1
            radius = abs(first) ** 3 / (side * mp.im(mp.conj(first) * second))
            assert points.curvature_radius[i] == pytest.approx(float(radius), rel=BEND)
            outward = 1 if layout == "twin-rocker" else -1
            profile = complex(z - outward * 0.01 * side * 1j * first / abs(first))
            assert points.profile[i] == pytest.approx(profile, abs=2 * POINT)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_pressure_angle_between_normal_and_roller_velocity(layout: Layout) -> None:
    mechanism = cam(layout)
    k = np.array([0.05, 0.3, 0.45, 0.8])
    points, view = mechanism.points(k), LAW.middle_view(k)
    # in the machine: undo the cam's turn, the roller moves across its arm
    turn = np.exp((-1j if layout == "twin-cam" else 1j) * points.cam_angle)
    normal = (points.profile - points.pitch) / mechanism.roller_radius * turn
    across = 1j * np.exp(1j * view.angle)
    cosine = np.abs((normal * np.conj(across)).real)
    np.testing.assert_allclose(np.cos(points.pressure_angle), cosine, rtol=0.0, atol=1e-14)


@pytest.mark.parametrize("layout", LAYOUTS)
def test_cusp_law_about_mid_swing(layout: Layout) -> None:
    mechanism = cam(layout)
    p, q = mechanism.cusp
    points = mechanism.points(np.array([0.5 - 2.0**-16, 0.5]))
    t = 2.0**-16 * mechanism.cycle_angle
    # next terms are t^2 relative: 1e-9
    drop = abs(abs(points.pitch[0]) - mechanism.middle_radius)
    assert drop == pytest.approx(p * t * t, rel=1e-6)
    assert abs(points.polar_angle[0]) * mechanism.middle_radius == pytest.approx(q * t**3, rel=1e-5)
    assert abs(points.curvature_radius[0]) == pytest.approx(4.0 * p * p / (3.0 * q) * t, rel=1e-8)
    assert points.curvature_radius[1] == 0.0
    assert points.pressure_angle[1] == 0.0


@pytest.mark.parametrize("layout", LAYOUTS)
def test_run_out_mirrors_the_run_up(layout: Layout) -> None:
    k = np.array([0.0, 0.125, 0.25, 0.46875])
    up, out = cam(layout).points(k), cam(layout).points(1.0 - k)
    np.testing.assert_allclose(out.pitch, np.conj(up.pitch), rtol=0, atol=1e-15)
    np.testing.assert_allclose(out.profile, np.conj(up.profile), rtol=0, atol=1e-15)
    np.testing.assert_allclose(out.pressure_angle, -up.pressure_angle, rtol=0.0, atol=1e-15)
    np.testing.assert_allclose(out.curvature_radius, up.curvature_radius, rtol=1e-14)


@pytest.mark.slow
@given(scale=st.floats(1e-3, 1e4))
@examples(20)
def test_lengths_scale(scale: float) -> None:
    one, other = cam("twin-cam"), cam("twin-cam", scale)
    k = np.array([0.1, 0.4])
    np.testing.assert_allclose(other.points(k).profile, scale * one.points(k).profile, rtol=1e-14)
    assert other.transition_zone == pytest.approx(one.transition_zone, rel=1e-14)
    assert other.min_curvature_radius == pytest.approx(scale * one.min_curvature_radius, rel=1e-12)


def test_other_laws_serve() -> None:
    mechanism = WideSwingCam("twin-cam", Harmonic(2.0), 1.5, 100.0, 3.0)
    assert mechanism.rocker_radius == pytest.approx(100.0 / (1.0 + math.pi / 1.5), rel=1e-15)
    points = mechanism.points(np.linspace(0.0, 1.0, 11))
    np.testing.assert_allclose(np.abs(points.profile - points.pitch), 3.0, rtol=1e-13)


@given(
    ratio=st.floats(1.3, 20.0),
    swing=st.floats(0.1, math.radians(300.0)),
    cycle=st.floats(0.2, math.pi),
    layout=st.sampled_from(LAYOUTS),
)
@examples(60)
def test_profile_exists_where_the_arm_is_short(ratio: float, swing: float, cycle: float, layout: Layout) -> None:
    """A twin-cam always exists; a twin-rocker does at least where its arm does not exceed the centre distance."""
    law = ElasticLaw(Pneumatic(ratio), swing)
    if layout == "twin-rocker":
        cycle = min(cycle, 0.5 * law.velocity_peak * swing)
    mechanism = WideSwingCam(layout, law, cycle, 100.0, 1.0)
    assert mechanism.loop_margin > 0.0
    assert mechanism.phase_angle > 0.0
    mechanism.require_profile()
    k = np.linspace(0.0, 1.0, 101)
    points = mechanism.points(k)
    assert np.all(np.diff(points.polar_angle) > -1e-15)
    radii = np.abs(points.pitch)
    assert mechanism.min_radius * (1 - 1e-14) <= radii.min()
    assert radii.max() <= mechanism.max_radius * (1 + 1e-14)
    assert np.abs(points.cam_angle - points.polar_angle).max() <= mechanism.largest_profile_correction * (1 + 1e-14)


def test_loop_of_a_soft_centred_law() -> None:
    """Swing 160, cycle 150, spring 4: with stretch 0.05 the phase angle is positive and yet there is a loop."""
    soft, firm = (
        WideSwingCam("twin-rocker", ElasticLaw(Spring(4.0, eps), math.radians(160.0)), math.radians(150.0), 100.0, 2.0)
        for eps in (0.05, 0.2)
    )
    assert math.degrees(soft.phase_angle) == pytest.approx(19.7, abs=0.05)
    assert soft.cusp[1] / 100.0 == pytest.approx(-0.05, abs=0.005)
    assert firm.cusp[1] / 100.0 == pytest.approx(0.11, abs=0.005)
    assert soft.loop_margin < 0.0 < firm.loop_margin
    with pytest.raises(NoSolution, match="the pitch curve has a loop at mid-swing"):
        soft.points(np.array([0.1]))
    with pytest.raises(NoSolution, match="loop"):
        _ = soft.transition_zone
    # the remedy works
    replace(soft, cycle_angle=math.radians(113.2)).require_profile()
    # the polar angle of the firm one rises everywhere, the soft one's does not
    k = np.linspace(0.3, 0.5, 401)
    for mechanism, rises in ((firm, True), (soft, False)):
        state = mechanism.state(k)
        theta = state.theta - state.correction
        assert bool(np.all(np.diff(theta) > 0.0)) is rises


def test_loop_beside_mid_swing_with_a_rocker_radius_given() -> None:
    """A shorter rocker straightens the cusp; what is left of a loop the signs of sampled polar angles show."""
    law = ElasticLaw(Spring(4.0, 0.05), math.radians(160.0))
    nominal = WideSwingCam("twin-rocker", law, math.radians(150.0), 100.0, 2.0)
    k = np.linspace(0.0, 0.5, 2001)
    for share, exists in ((0.9999, False), (0.999, False), (0.995, True), (0.5, True)):
        shorter = replace(nominal, given_rocker_radius=share * nominal.rocker_radius)
        phi = (shorter.law.invariants(k, 0)[0] - 0.5) * law.swing
        arm = -1.0 + shorter.ratio * np.exp(-1j * phi)
        polar = np.unwrap(np.angle(-arm)) + (k - 0.5) * shorter.cycle_angle
        assert bool(np.all(np.diff(polar) > 0.0)) is exists
        # (dTheta/dtheta) rho^2/(1 - cos phi), by central differences over 2.5e-4 of the stroke: their squares are left
        middle = 0.5 * (phi[1:] + phi[:-1])
        rate = np.diff(polar) / (np.diff(k) * shorter.cycle_angle)
        size = np.abs(-1.0 + shorter.ratio * np.exp(-1j * middle)) ** 2
        far = np.abs(middle) > 0.02
        measured = float(np.min((rate * size / (1.0 - np.cos(middle)))[far]))
        assert shorter.loop_margin == pytest.approx(measured, abs=1e-5)
        if not exists:
            with pytest.raises(NoSolution, match="loop at mid-swing") as refusal:
                shorter.require_profile()
            assert refusal.value.fix == "omit the rocker radius, and reduce the cycle angle to 113.1 deg or less"


def test_given_rocker_radius() -> None:
    nominal = cam("twin-cam", 200.0)
    shorter = replace(nominal, given_rocker_radius=0.99 * nominal.rocker_radius)
    shorter.require_profile()
    # one per cent is enough for 45 deg close to mid-swing, 90 deg at it
    angles = np.abs(shorter.points(np.array([0.49, 0.499, 0.5])).pressure_angle)
    assert angles[1] > math.radians(45.0) > angles[0]
    assert angles[2] == pytest.approx(0.5 * math.pi, rel=1e-12)
    longer = replace(nominal, given_rocker_radius=1.01 * nominal.rocker_radius)
    with pytest.raises(NoSolution, match="rocker radius"):
        longer.require_profile()


@pytest.mark.parametrize("layout", LAYOUTS)
def test_extremes_against_a_fine_sweep(layout: Layout) -> None:
    mechanism = cam(layout)
    k = np.linspace(0.0, mechanism.contact[0][1], 4001)
    points = mechanism.points(k)
    largest = float(np.abs(points.pressure_angle).max())
    assert mechanism.max_pressure_angle == pytest.approx(largest, rel=1e-6)
    assert mechanism.max_pressure_angle >= largest * (1 - EDGE)
    # both references have their largest angle at the start
    assert mechanism.max_pressure_angle == pytest.approx(abs(points.pressure_angle[0]), rel=EDGE)
    bulging = mechanism.sense / points.curvature_radius
    assert mechanism.min_curvature_radius == pytest.approx(1.0 / float(bulging.max()), rel=1e-6)


def test_twin_rocker_needs_a_fast_rocker() -> None:
    limit = math.degrees(LAW.velocity_peak * LAW.swing)
    with pytest.raises(NoSolution, match=rf"limit > 1 .*with up to {safely_below(limit)} deg the rocker is longer"):
        WideSwingCam("twin-rocker", LAW, math.radians(limit + 0.1), 200.0, 4.0)
    assert WideSwingCam("twin-rocker", LAW, math.radians(limit - 0.1), 200.0, 4.0).rocker_radius > 1e4


def test_refusals_name_value_and_remedy() -> None:
    with pytest.raises(NoSolution, match=r"cam angle of the stroke: 0 deg.*360 deg"):
        WideSwingCam("twin-cam", LAW, 0.0, 200.0, 8.0)
    with pytest.raises(NoSolution, match="centre distance: -1 mm"):
        WideSwingCam("twin-cam", LAW, 2.0, -1.0, 8.0)
    with pytest.raises(NoSolution, match="roller radius: nan mm"):
        WideSwingCam("twin-cam", LAW, 2.0, 200.0, math.nan)
    with pytest.raises(NoSolution, match="rocker radius: 0 mm"):
        WideSwingCam("twin-cam", LAW, 2.0, 200.0, 8.0, 0.0)


def test_transition_zone_that_fills_the_stroke() -> None:
    wide = replace(cam("twin-cam", 200.0), roller_radius=200.0)
    with pytest.raises(NoSolution, match=r"set cam.roller_radius below") as refusal:
        _ = wide.max_pressure_angle
    limit = float(str(refusal.value).split("below ")[1].split(" mm")[0])
    assert replace(wide, roller_radius=0.999 * limit).transition_zone < 0.5
    assert replace(wide, roller_radius=1.001 * limit).transition_zone == 0.5
