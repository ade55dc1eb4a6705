"""Smallest cams for a pressure-angle limit, on the swing gripper's machine.

Tolerances
    LENGTH = 1e-11 mm on lengths of 200 mm: the cutting planes stop at 1e-13 of the largest length, and two limits
    that cross at an angle of 0.87 rad pass that on twofold.
    ANGLE = 4e-15 rad for a pressure angle at a refined extreme.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.extremes import least_convex_radius, maximum_over, minimum_over
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.profile import curvature, oscillating, pressure_angle, profile
from gearlink.core.parts.cams.size import RockingRoller, smallest_cam_of_rollers
from gearlink.core.parts.cams.undercut import undercut

LENGTH = 1e-11
ANGLE = 4e-15
TURN = 2.0 * math.pi

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())
CASES = {case["id"]: case for case in REFERENCE["cases"]}

PHASES = np.radians([100.0, 12.0, 50.0, 8.0, 120.0])
JOINTS = np.cumsum(PHASES).tolist()
PIVOT, OUTPUT = 230.0 + 0.0j, 498.0 + 55.0j
MAIN, RETURN = math.radians(49.0), math.radians(137.0)


def swing(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Swing angle of the gripper and its first two derivatives by the shaft angle."""
    up, down, back = law("velocity-345"), law("half-cycloidal"), law("modified-sine")
    a, c, d, _, r = PHASES
    w = 0.45
    far = w * (up.kappa * a + c + down.kappa * d)

    def clip(x: np.ndarray) -> np.ndarray:
        return np.clip(x, 0.0, 1.0)

    starts = np.concatenate(([0.0], JOINTS))
    phase = np.searchsorted(JOINTS, theta, side="right")
    s0, v0, a0 = up.evaluate(clip(theta / a), 2)
    s2, v2, a2 = down.evaluate(clip(1.0 - (theta - starts[2]) / d), 2)
    s4, v4, a4 = back.evaluate(clip((theta - starts[4]) / r), 2)
    zero = 0.0 * theta
    rows = [
        (w * a * s0, w * v0, w / a * a0),
        (w * a * up.kappa + w * (theta - starts[1]), zero + w, zero),
        (far - w * d * s2, w * v2, -w / d * a2),
        (zero + far, zero, zero),
        (far * (1.0 - s4), -far * v4 / r, -far * a4 / r**2),
        (zero, zero, zero),
    ]
    b, b1, b2 = (np.choose(phase, [row[k] for row in rows]) for k in range(3))
    return b, b1, b2


def input_link(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Direction of AC (150, 260, 100 mm) and its first two derivatives."""
    b, b1, b2 = swing(theta)
    link, coupler, rocker = 150.0, 260.0, 100.0
    out = math.radians(110.0) - b
    v = OUTPUT - PIVOT + rocker * np.exp(1j * out)
    n = np.abs(v)
    inner = np.arccos((n * n + link * link - coupler * coupler) / (2.0 * n * link))
    one = np.angle(v) + inner
    joint = link * np.exp(1j * one)
    three = np.angle(v - joint)
    v1 = -1j * b1 * rocker * np.exp(1j * out)
    v2 = (-1j * b2 - b1 * b1) * rocker * np.exp(1j * out)
    e3 = np.exp(1j * three)
    w1 = (v1 / e3).real / (1j * joint / e3).real
    w3 = ((v1 - 1j * w1 * joint) / (1j * coupler * e3)).real
    a1 = ((v2 + w1 * w1 * joint) / e3 + coupler * w3 * w3).real / (1j * joint / e3).real
    return one, w1, a1


def gripper_path(theta: np.ndarray, angle: float, center: complex = 0j):  # type: ignore[no-untyped-def]
    one, w1, a1 = input_link(theta)
    return oscillating(PIVOT - center, 160.0, one + angle, w1, a1)


def rocker_law(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    one, w1, _ = input_link(theta)
    return one + MAIN, w1


def smallest_cam(limit: float) -> complex:
    """The smallest cam of the example's main roller."""
    return smallest_cam_of_rollers([RockingRoller(rocker_law, PIVOT, 160.0, 1)], limit, sense=-1, joints=JOINTS)


def prime_radius(center: complex) -> float:
    """From a cam centre to the roller at the start."""
    (start,) = gripper_path(np.zeros(1), MAIN, center).position
    return float(abs(start))


def expected(case: str) -> dict[str, float]:
    return {key: float(value) for key, value in CASES[case]["expected"].items()}


# The example machine's cams


@pytest.mark.parametrize(("angle", "columns"), [(MAIN, "cam1"), (RETURN, "cam2")])
def test_table_of_the_example(angle: float, columns: str) -> None:
    rows = REFERENCE["example_table"]
    theta = np.radians([float(row["theta_deg"]) for row in rows])
    cam = profile(theta, gripper_path(theta, angle), sense=-1, roller_radius=30.0)
    for row, point, alpha, rho in zip(rows, cam.profile, cam.pressure_angle, cam.curvature_radius, strict=True):
        # near the bite beta is the difference of large angles; the law's own rounding passes through
        assert point.real == pytest.approx(float(row[f"{columns}_x"]), abs=1e-12)
        assert point.imag == pytest.approx(float(row[f"{columns}_y"]), abs=1e-12)
        assert math.degrees(alpha) == pytest.approx(float(row[f"{columns}_alpha_deg"]), abs=1e-12)
        assert rho == pytest.approx(float(row[f"{columns}_rho_pitch"]), rel=1e-11)


def test_return_roller_reference() -> None:
    numbers = expected("CAM-05")
    theta = np.radians([71.5])
    cam = profile(theta, gripper_path(theta, RETURN), sense=-1, roller_radius=30.0)
    assert cam.profile[0] == pytest.approx(complex(numbers["cx"], numbers["cy"]), abs=1e-12)
    assert cam.pressure_angle[0] == pytest.approx(numbers["alpha"], abs=ANGLE)


@pytest.mark.parametrize(("name", "angle"), [("alpha1", MAIN), ("alpha2", RETURN)])
def test_extremes_of_the_pressure_angle(name: str, angle: float) -> None:
    numbers = expected("EXT-01")

    def alpha(theta: np.ndarray) -> np.ndarray:
        return pressure_angle(theta, gripper_path(theta, angle), sense=-1)

    for kind, found in (("min", minimum_over(alpha, joints=JOINTS)), ("max", maximum_over(alpha, joints=JOINTS))):
        assert found.value == pytest.approx(math.radians(numbers[f"{name}_{kind}_deg"]), abs=ANGLE)
        assert math.degrees(found.place) == pytest.approx(numbers[f"at_{name}_{kind}_deg"], abs=1e-5)


@pytest.mark.parametrize(("angle", "least"), [(MAIN, 123.990315658144552), (RETURN, 124.666623423513464)])
def test_no_undercut_in_the_example(angle: float, least: float) -> None:
    def bend(theta: np.ndarray) -> np.ndarray:
        return curvature(theta, gripper_path(theta, angle), sense=-1)

    def points(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        cam = profile(theta, gripper_path(theta, angle), sense=-1, roller_radius=30.0)
        return cam.pitch, cam.profile

    assert least_convex_radius(bend, joints=JOINTS).value == pytest.approx(least, rel=1e-12)
    assert undercut(points, 30.0, samples=1440).depth < 1e-11


# Smallest cams


def test_smallest_cam_of_the_example() -> None:
    numbers = expected("FEAS-01")
    limit = math.radians(25.0)
    center = smallest_cam(limit)
    assert center == pytest.approx(complex(numbers["Ox"], numbers["Oy"]), abs=LENGTH)
    assert prime_radius(center) == pytest.approx(numbers["r_pitch_min"], abs=LENGTH)
    assert abs(center - PIVOT) == pytest.approx(numbers["f"], abs=LENGTH)

    def alpha(theta: np.ndarray) -> np.ndarray:
        return pressure_angle(theta, gripper_path(theta, MAIN, center), sense=-1)

    high, low = maximum_over(alpha, joints=JOINTS), minimum_over(alpha, joints=JOINTS)
    assert (high.value, low.value) == pytest.approx((limit, -limit), abs=1e-13)
    # the reference names the limits after the sign of the half-plane
    places = math.degrees(high.place), math.degrees(low.place)
    assert places == pytest.approx((numbers["theta_minus_deg"], numbers["theta_plus_deg"]), abs=1e-4)


@pytest.mark.slow
def test_mirrored_machine_has_the_mirrored_cam() -> None:
    def mirrored(theta: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        psi, rate = rocker_law(theta)
        return -psi, -rate

    limit = math.radians(25.0)
    one = smallest_cam(limit)
    other = smallest_cam_of_rollers(
        [RockingRoller(mirrored, PIVOT.conjugate(), 160.0, -1)], limit, sense=1, joints=JOINTS
    )
    assert other == pytest.approx(one.conjugate(), abs=LENGTH)


@pytest.mark.slow
def test_a_wider_limit_gives_a_smaller_cam() -> None:
    radii = [prime_radius(smallest_cam(math.radians(limit))) for limit in (20.0, 25.0, 30.0, 40.0)]
    assert radii == sorted(radii, reverse=True)


# Failures


@pytest.mark.parametrize("limit", [0.0, -0.1, 90.0, math.nan])
def test_refuses_a_limit_out_of_range(limit: float) -> None:
    with pytest.raises(NoSolution, match="above 0, below 90 deg"):
        smallest_cam(math.radians(limit))


def test_refuses_a_rocker_that_moves_with_the_cam_too_fast() -> None:
    # an arm that turns right round meets every direction of the centre
    turning = RockingRoller(lambda phi: (phi, 1.0 + 0.0 * phi), 0j, 100.0, 1)
    with pytest.raises(NoSolution, match=r"no cam centre keeps .*; increase the limit of the pressure angle"):
        smallest_cam_of_rollers([turning], math.radians(20.0), sense=-1)


def test_a_table_of_places_comes_near_the_refined_centre() -> None:
    def best(refined: bool) -> complex:
        roller = RockingRoller(rocker_law, PIVOT, 160.0, 1)
        return smallest_cam_of_rollers([roller], math.radians(30.0), sense=-1, joints=JOINTS, refined=refined)

    assert 0.0 < abs(best(False) - best(True)) < 1e-3
