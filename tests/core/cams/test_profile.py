"""Disc cams: pitch curve, profile, pressure angle, curvature.

Tolerances
    POINT = 1e-13 of the largest length: some ten rounded operations of 2e-16.
    ANGLE = 2e-15 rad and BEND = 1e-14/mm, the same count on values of order one and 0.01/mm.
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
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.profile import (
    CamProfile,
    RollerPath,
    curvature,
    oscillating,
    pitch_points,
    pressure_angle,
    profile,
    profile_points,
    translating,
)

POINT = 1e-13 * 230.0
ANGLE = 2e-15
BEND = 1e-14
TURN = 2.0 * math.pi

CASES = {
    case["id"]: case
    for case in json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())["cases"]
}


def expected(case: str) -> dict[str, float]:
    return {key: float(value) for key, value in CASES[case]["expected"].items()}


def assert_matches(cam: CamProfile, numbers: dict[str, float]) -> None:
    assert complex(cam.pitch) == pytest.approx(complex(numbers["px"], numbers["py"]), abs=POINT)
    assert complex(cam.profile) == pytest.approx(complex(numbers["cx"], numbers["cy"]), abs=POINT)
    assert float(cam.pressure_angle) == pytest.approx(numbers["alpha"], abs=ANGLE)
    assert float(cam.curvature) == pytest.approx(numbers["kappa_p"], abs=BEND)


# Published and reference numbers


@pytest.mark.parametrize(("cam", "linkage"), [("CAM-01", "INV-01"), ("CAM-03", "INV-03")])
def test_swing_gripper(cam: str, linkage: str) -> None:
    # roller on an arm of 160 mm, 49 deg ahead of the input link, about (230, 0); clockwise cam, roller 30 mm
    motion = expected(linkage)
    phi = math.radians(CASES[cam]["inputs"]["theta_deg"])
    path = oscillating(230.0, 160.0, motion["th1"] + math.radians(49.0), motion["w1"], motion["a1"])
    found = profile(phi, path, sense=-1, roller_radius=30.0)
    assert_matches(found, expected(cam))
    assert abs(complex(found.profile)) == pytest.approx(expected(cam)["r_c"], abs=POINT)


def test_swing_gripper_at_the_bite() -> None:
    path = oscillating(230.0, 160.0, math.radians(100.05882957 + 49.0), 0.0, 0.0)
    cam = profile(0.0, path, sense=-1, roller_radius=30.0)
    assert complex(cam.profile) == pytest.approx(70.3229 + 62.3609j, abs=2e-4)
    assert math.degrees(float(cam.pressure_angle)) == pytest.approx(-17.4929, abs=5e-5)


def test_flatbed_press() -> None:
    path = translating(90.0 + 0.4330841947010919, -3.06464256758174)
    cam = profile(math.radians(60.0), path, sense=1, roller_radius=25.0)
    assert complex(cam.pitch) == pytest.approx(45.21654209735055 - 78.31734825518815j, abs=POINT)
    assert complex(cam.profile) == pytest.approx(33.45700045722996 - 56.25577123961036j, abs=POINT)


def test_eccentric_circle_oscillating() -> None:
    numbers = expected("ECC-01")
    path = oscillating(220.0, 160.0, numbers["psi"], numbers["psi1"], numbers["psi2"])
    assert_matches(profile(0.75, path, sense=1, roller_radius=20.0), numbers)


def test_eccentric_circle_translating() -> None:
    numbers = expected("ECT-01")
    path = translating(numbers["y"], numbers["y1"], numbers["y2"], direction=1j, offset=15.0)
    assert_matches(profile(0.875, path, sense=1, roller_radius=10.0), numbers)


def test_cycloidal_slide() -> None:
    rise = math.pi / 2.0
    s, v, a = law("cycloidal").evaluate(0.375, 2)
    y = 60.0 + 30.0 * s
    path = translating(y, 30.0 * v / rise, 30.0 * a / rise**2, direction=1j)
    assert_matches(profile(0.375 * rise, path, sense=1, roller_radius=15.0), expected("TRA-01"))


# A second method: circles all around, and the theory's formulas for the pressure angle


def rocker_on_circle(phi: np.ndarray, sense: int, side: int) -> RollerPath:
    """Arm of 160 about (220, 0) whose roller rides at 100 from a centre that turns at 25 from the axis."""
    pivot, arm, reach = 220.0, 160.0, 100.0
    z = 25.0 * np.exp(1j * (0.5 + sense * phi))
    z1, z2 = 1j * sense * z, -z
    n = np.abs(z - pivot)
    psi = np.angle(z - pivot) + side * np.arccos((n * n + arm * arm - reach * reach) / (2.0 * n * arm))
    e = np.exp(1j * psi)
    w = pivot + arm * e - z
    psi1 = (np.conj(w) * z1).real / (np.conj(w) * 1j * arm * e).real
    w1 = 1j * arm * psi1 * e - z1
    rest = np.abs(w1) ** 2 + (np.conj(w) * (-arm * psi1**2 * e - z2)).real
    return oscillating(pivot, arm, psi, psi1, -rest / (np.conj(w) * 1j * arm * e).real)


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_eccentric_circle_all_around(sense: int, side: int) -> None:
    phi = np.linspace(0.0, TURN, 97)
    path = rocker_on_circle(phi, sense, side)
    cam = profile(phi, path, sense=sense, roller_radius=20.0)
    center = 25.0 * np.exp(0.5j)
    np.testing.assert_allclose(np.abs(cam.pitch - center), 100.0, rtol=0.0, atol=POINT)
    np.testing.assert_allclose(np.abs(cam.profile - center), 80.0, rtol=0.0, atol=POINT)
    np.testing.assert_allclose(cam.curvature, 0.01, rtol=0.0, atol=BEND)
    np.testing.assert_allclose(cam.curvature_radius, 100.0, rtol=1e-12)
    # the common normal is the line of centres, world frame
    normal = path.position - 25.0 * np.exp(1j * (0.5 + sense * phi))
    line = normal / path.direction
    np.testing.assert_allclose(np.tan(cam.pressure_angle), line.imag / line.real, rtol=0.0, atol=1e-13)


@given(
    y=st.floats(40.0, 150.0),
    y1=st.floats(-60.0, 60.0),
    e=st.floats(-35.0, 35.0),
    turn=st.floats(-3.2, 3.2),
    sense=st.sampled_from([1, -1]),
)
@examples(100)
def test_pressure_angle_of_a_slide(y: float, y1: float, e: float, turn: float, sense: int) -> None:
    direction = complex(math.cos(turn), math.sin(turn))
    alpha = pressure_angle(0.3, translating(y, y1, direction=direction, offset=e), sense=sense)
    assert float(alpha) == pytest.approx(math.atan((sense * y1 - e) / y), abs=ANGLE)


@given(psi=st.floats(1.7, 2.9), rate=st.floats(-0.5, 0.5), sense=st.sampled_from([1, -1]))
@examples(100)
def test_pressure_angle_of_a_rocker(psi: float, rate: float, sense: int) -> None:
    f, arm = 230.0, 160.0
    path = oscillating(f, arm, psi, rate)
    alpha = float(pressure_angle(0.3, path, sense=sense))
    inner = math.pi - psi
    formula = (arm * (1.0 - sense * rate) - f * math.cos(inner)) / (f * math.sin(inner))
    assert math.tan(alpha) == pytest.approx(formula, rel=1e-13, abs=1e-14)
    # the normal at the contact passes through the relative pole on the line of centres
    roller = complex(path.position)
    contact = complex(profile_points(0.3, path, sense=sense, roller_radius=30.0)) * np.exp(0.3j * sense)
    pole = -rate * f / (sense - rate)
    assert ((roller - contact) * complex(pole - roller).conjugate()).imag == pytest.approx(0.0, abs=30.0 * POINT)


def modified_sine_cam(phi: np.ndarray) -> CamProfile:
    """Rise and return of 0.3 rad over half a revolution each, clockwise cam."""
    s, v, a = law("modified-sine").evaluate(np.where(phi < math.pi, phi, TURN - phi) / math.pi, 2)
    up = np.where(phi < math.pi, 1.0, -1.0)
    path = oscillating(200.0 + 30.0j, 150.0, 2.4 - 0.3 * s, -0.3 * up * v / math.pi, -0.3 * a / math.pi**2)
    return profile(phi, path, sense=-1, roller_radius=25.0)


def test_profile_is_the_envelope_of_the_rollers() -> None:
    phi = np.linspace(0.0, TURN, 721)
    cam = modified_sine_cam(phi)
    gaps = np.abs(cam.profile[:, None] - cam.pitch[None, :])
    np.testing.assert_allclose(np.diag(gaps), 25.0, rtol=0.0, atol=POINT)
    assert gaps.min() >= 25.0 - POINT


def test_curvature_against_the_turning_of_the_pitch_curve() -> None:
    # arc through three neighbours: relative error of second order in the step, 1e-6 rad^2 here
    phi = np.linspace(0.1, 3.0, 50)
    h = 1e-3
    before, here, after = (modified_sine_cam(phi + step).pitch for step in (-h, 0.0, h))
    a, b = here - before, after - here
    arc = 2.0 * (np.conj(a) * b).imag / (np.abs(a) * np.abs(b) * np.abs(after - before))
    # a clockwise cam draws its pitch curve counter-clockwise
    error = np.abs(arc - modified_sine_cam(phi).curvature)
    assert np.median(error) < 1e-8
    assert error.max() < 1e-5


# Invariance


@given(turn=st.floats(-3.0, 3.0), psi=st.floats(1.7, 2.9), rate=st.floats(-0.5, 0.5), bend=st.floats(-1.0, 1.0))
@examples(50)
def test_turning_the_machine_turns_the_cam(turn: float, psi: float, rate: float, bend: float) -> None:
    e = complex(math.cos(turn), math.sin(turn))
    here = profile(1.1, oscillating(230.0, 160.0, psi, rate, bend), sense=1, roller_radius=30.0)
    there = profile(1.1, oscillating(230.0 * e, 160.0, psi + turn, rate, bend), sense=1, roller_radius=30.0)
    assert complex(there.profile) == pytest.approx(complex(here.profile) * e, abs=POINT)
    assert float(there.pressure_angle) == pytest.approx(float(here.pressure_angle), abs=4 * ANGLE)
    assert float(there.curvature) == pytest.approx(float(here.curvature), rel=1e-11, abs=BEND)


@given(psi=st.floats(1.7, 2.9), rate=st.floats(-0.5, 0.5), bend=st.floats(-1.0, 1.0), scale=st.floats(0.01, 100.0))
@examples(50)
def test_mirror_and_scale(psi: float, rate: float, bend: float, scale: float) -> None:
    here = profile(1.1, oscillating(230.0, 160.0, psi, rate, bend), sense=1, roller_radius=30.0)
    mirrored = profile(1.1, oscillating(230.0, 160.0, -psi, -rate, -bend), sense=-1, roller_radius=30.0)
    assert complex(mirrored.profile) == pytest.approx(complex(here.profile).conjugate(), abs=POINT)
    assert float(mirrored.pressure_angle) == pytest.approx(-float(here.pressure_angle), abs=ANGLE)
    assert float(mirrored.curvature) == pytest.approx(float(here.curvature), rel=1e-13, abs=BEND)
    large = profile(
        1.1, oscillating(230.0 * scale, 160.0 * scale, psi, rate, bend), sense=1, roller_radius=30.0 * scale
    )
    assert complex(large.profile) == pytest.approx(complex(here.profile) * scale, abs=POINT * scale)
    assert float(large.curvature) * scale == pytest.approx(float(here.curvature), rel=1e-12, abs=BEND)


def test_opposite_rollers_of_a_press_mirror_each_other() -> None:
    # a roller on -x that moves like one on +x half a revolution later
    lift, rate = 3.0, -2.0
    right = profile(0.4, translating(90.0 + lift, rate), sense=1, roller_radius=25.0)
    left = profile(0.4 - math.pi, translating(90.0 + lift, rate, direction=-1.0), sense=1, roller_radius=25.0)
    assert complex(left.profile) == pytest.approx(complex(right.profile), abs=POINT)
    assert float(left.pressure_angle) == pytest.approx(float(right.pressure_angle), abs=ANGLE)


def test_single_results_equal_the_whole_over_several_blocks() -> None:
    phi = np.linspace(0.0, TURN, 20011)
    path = rocker_on_circle(phi, 1, -1)
    cam = profile(phi, path, sense=1, roller_radius=20.0)
    np.testing.assert_allclose(cam.pitch, pitch_points(phi, path, sense=1), rtol=0.0, atol=POINT)
    points = profile_points(phi, path, sense=1, roller_radius=20.0)
    np.testing.assert_allclose(cam.profile, points, rtol=0.0, atol=POINT)
    alone = pressure_angle(phi, path, sense=1)
    np.testing.assert_allclose(cam.pressure_angle, alone, rtol=0.0, atol=ANGLE)
    np.testing.assert_allclose(cam.curvature, curvature(phi, path, sense=1), rtol=0.0, atol=BEND)


def test_shapes_broadcast() -> None:
    phi = np.linspace(0.0, 1.0, 6).reshape(2, 3)
    cam = profile(phi, translating(90.0, 0.0), sense=1, roller_radius=25.0)
    assert cam.profile.shape == (2, 3)
    np.testing.assert_allclose(np.abs(cam.profile), 65.0, rtol=1e-15)


def test_straight_pitch_curve_has_infinite_radius() -> None:
    # y = 1/cos(phi) about phi = 0 draws a straight line: y'' = y at y' = 0
    cam = profile(0.0, translating(90.0, 0.0, 90.0), sense=1, roller_radius=25.0)
    assert float(cam.curvature) == 0.0
    assert float(cam.curvature_radius) == math.inf


# Failures


def test_refuses_the_relative_pole() -> None:
    # the centre line of the arm passes the cam axis: Re(q/u) changes sign
    with pytest.raises(NoSolution, match=r"at cam angle [\d.]+ deg, .* relative pole; enlarge the base circle"):
        pressure_angle([0.0, 1.0], oscillating(100.0, 80.0, [3.0, 3.3], [0.0, 0.0]), sense=1)


def test_refuses_a_standing_pitch_curve() -> None:
    with pytest.raises(NoSolution, match="cusp at cam angle 57"):
        profile(1.0, oscillating(0.0, 80.0, 1.0, 1.0), sense=1, roller_radius=10.0)


def test_refuses_a_direction_that_is_no_unit_vector() -> None:
    with pytest.raises(NoSolution, match="unit vector"):
        translating(90.0, 0.0, direction=1 + 1j)
