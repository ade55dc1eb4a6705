"""Undercut of cam profiles.

Tolerances
    NONE = 1e-12 of the cam's size is no cut: rounding of the distances.
    DEPTH = 1e-9 mm: the deepest place is refined to 1e-10 rad, where the depth is flat.
"""

from __future__ import annotations

import json
import math
from pathlib import Path

import numpy as np
import pytest

from gearlink.core.numerics.extremes import convex_radius, maximum_over
from gearlink.core.parts.cams.laws import law
from gearlink.core.parts.cams.profile import CamProfile, profile, translating
from gearlink.core.parts.cams.undercut import nearest, undercut

NONE = 1e-12 * 100.0
DEPTH = 1e-9
TURN = 2.0 * math.pi

REFERENCE = json.loads((Path(__file__).parents[2] / "reference" / "swing_gripper.json").read_text())
CASES = {case["id"]: case for case in REFERENCE["cases"]}


def rise_cam(phi: np.ndarray, roller_radius: float) -> CamProfile:
    """Cycloidal rise of 40 mm over 60 deg on a prime circle of 40 mm, a slide in line."""
    beta = math.radians(60.0)
    s, v, a = law("cycloidal").evaluate(phi / beta, 2)
    path = translating(40.0 + 40.0 * s, 40.0 * v / beta, 40.0 * a / beta**2, direction=1j)
    return profile(phi, path, sense=1, roller_radius=roller_radius)


def rise_points(roller_radius: float):  # type: ignore[no-untyped-def]
    def points(phi: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        cam = rise_cam(phi, roller_radius)
        return cam.pitch, cam.profile

    return points


def test_critical_roller_radius() -> None:
    exact = {key: float(value) for key, value in CASES["UND-01"]["expected"].items()}
    beta = math.radians(60.0)
    top = maximum_over(lambda phi: rise_cam(phi, 0.0).curvature, beta / 2.0, beta)
    least = convex_radius(top)
    assert least.value == pytest.approx(exact["r_g_crit"], rel=1e-13)
    assert least.place / beta == pytest.approx(exact["x_star"], abs=1e-7)
    assert top.value == pytest.approx(exact["kappa_max"], rel=1e-13)


@pytest.mark.slow
def test_swallowtail_begins_at_the_critical_radius() -> None:
    critical = float(CASES["UND-01"]["expected"]["r_g_crit"])
    beta = math.radians(60.0)

    def depth(radius: float) -> float:
        return undercut(rise_points(radius), radius, end=beta, closed=False).depth

    assert depth(0.999 * critical) < NONE
    assert depth(1.02 * critical) > 1e-4
    assert depth(1.2 * critical) > depth(1.1 * critical) > depth(1.02 * critical)


def test_swallowtail_depth_against_a_fine_grid() -> None:
    critical = float(CASES["UND-01"]["expected"]["r_g_crit"])
    radius, beta = 1.15 * critical, math.radians(60.0)
    found = undercut(rise_points(radius), radius, end=beta, closed=False)
    cam = rise_cam(np.linspace(0.6 * beta, beta, 1001), radius)
    grid = radius - np.abs(cam.profile[:, None] - cam.pitch[None, :]).min()
    assert found.depth >= grid - 1e-12
    assert found.depth == pytest.approx(grid, rel=1e-4)
    at = rise_cam(np.array([found.cam_angle]), radius).profile[0]
    by = rise_cam(np.array([found.roller_angle]), radius).pitch[0]
    assert radius - abs(at - by) == pytest.approx(found.depth, abs=1e-12)


def cassini(radius: float, flank: int = 1):  # type: ignore[no-untyped-def]
    """Pitch curve with a neck: Cassini oval of a = 100, b = 102, half neck sqrt(b^2 - a^2) = 20.1 mm."""
    a, ratio = 100.0, (102.0 / 100.0) ** 4

    def points(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        root = np.sqrt(ratio - np.sin(2.0 * t) ** 2)
        r = a * np.sqrt(np.cos(2.0 * t) + root)
        slope = -a * a * (np.sin(2.0 * t) + np.sin(2.0 * t) * np.cos(2.0 * t) / root) / r
        pitch = r * np.exp(1j * t)
        tangent = (slope + 1j * r) * np.exp(1j * t)
        return pitch, pitch + flank * radius * 1j * tangent / np.abs(tangent)

    return points


def test_far_cut_through_a_neck() -> None:
    neck = math.sqrt(102.0**2 - 100.0**2)
    assert undercut(cassini(19.0), 19.0).depth < NONE
    found = undercut(cassini(25.0), 25.0)
    # the profile point of the one side lies 2 neck - r_g from the roller on the other
    assert found.depth == pytest.approx(2.0 * (25.0 - neck), abs=DEPTH)
    assert {round(abs(math.sin(angle)), 6) for angle in (found.cam_angle, found.roller_angle)} == {1.0}
    assert abs(found.cam_angle - found.roller_angle) == pytest.approx(math.pi, abs=1e-4)


def test_the_far_flank_is_cut_where_the_curve_is_concave() -> None:
    # the outer flank of a groove: the neck is concave, so a large roller cuts outside
    assert undercut(cassini(5.0, -1), 5.0).depth < NONE
    assert undercut(cassini(60.0, -1), 60.0).depth > 0.1


def test_seam_of_a_closed_profile() -> None:
    # the neck turned onto the seam at angle 0; nothing is asked beyond the turn
    def points(t: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        assert t.min() >= 0.0
        assert t.max() <= TURN
        return cassini(25.0)(t + math.pi / 2.0 + 1e-4)

    found = undercut(points, 25.0)
    assert found.depth == pytest.approx(2.0 * (25.0 - math.sqrt(404.0)), abs=DEPTH)


@pytest.mark.slow
def test_circle_is_cut_only_past_its_centre() -> None:
    def circle(radius: float):  # type: ignore[no-untyped-def]
        return lambda t: (50.0 * np.exp(-1j * t), (50.0 - radius) * np.exp(-1j * t))

    assert undercut(circle(49.0), 49.0).depth < NONE
    assert undercut(circle(55.0), 55.0).depth == pytest.approx(10.0, abs=DEPTH)


@pytest.mark.quick(1)
@pytest.mark.parametrize("samples", [33, 1440, pytest.param(4097, marks=pytest.mark.slow)])
def test_nearest_places_are_those_of_a_k_d_tree(samples: int) -> None:
    from scipy.spatial import cKDTree

    rng = np.random.default_rng(samples)
    t = np.linspace(0.0, TURN, samples)
    for _ in range(10):
        waves = sum(rng.normal() * 20.0 / k * np.cos(k * t + rng.uniform(0.0, TURN)) for k in range(1, 6))
        pitch = (100.0 + waves) * np.exp(1j * t)
        along = np.gradient(pitch)
        profile = pitch + 1j * along / np.abs(along) * rng.uniform(5.0, 90.0) * (1.0 + 0.2 * (np.sin(3.0 * t) > 0.0))
        tree = cKDTree(np.column_stack((pitch.real, pitch.imag)))
        least = tree.query(np.column_stack((profile.real, profile.imag)))[0].min()
        at, by, found = nearest(pitch, profile)
        assert found == pytest.approx(least, rel=0.0, abs=1e-13)
        assert abs(profile[at] - pitch[by]) == pytest.approx(found, rel=0.0, abs=1e-13)
