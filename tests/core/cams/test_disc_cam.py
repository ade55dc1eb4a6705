"""A closed disc cam: extremes, undercut and checks against circles and closed forms.

Tolerances
* eccentric circle: 1e-13 of its radius for radii, 1e-12 rad for angles: some ten operations on numbers of that size.
  Largest values are flat: they are exact to rounding, their places to sqrt(eps).
* two lobes rho = R + D cos(2 t): extremes of curvature and the neck in closed form, 1e-13; the depth of a far cut
  is sought to 1e-10 of the angle, which at a flat minimum leaves 1e-13 mm.
"""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from gearlink.core.parts.cams.checks import hub_checks, pressure_angle_checks, step_check, undercut_checks
from gearlink.core.parts.cams.codes import VELOCITY_STEP
from gearlink.core.parts.cams.disc_cam import DiscCam
from gearlink.core.parts.cams.profile import translating
from gearlink.core.parts.linkages.codes import SHAFT_CLEARANCE

ANGLES = np.radians(np.arange(0.0, 360.0, 1.0))


def eccentric(radius: float, offset: float, roller: float, sense: int = 1) -> DiscCam:
    """In-line follower on a circle of pitch radius R whose centre stands e off the axis: rho = e cos t + sqrt(...)."""

    def path(t, order):
        root = np.sqrt(radius**2 - (offset * np.sin(t)) ** 2)
        bend = offset**2 * np.sin(t) * np.cos(t)
        first = -offset * np.sin(t) - bend / root
        second = -offset * np.cos(t) - offset**2 * np.cos(2.0 * t) / root - bend**2 / root**3
        return translating(offset * np.cos(t) + root, first, second if order > 1 else 0.0)

    return DiscCam("circle", path, sense, roller)


def lobes(size: float, depth: float, roller: float) -> DiscCam:
    """Two lobes: rho = R + D cos(2 t), with a neck of half-width R - D."""

    def path(t, order):
        second = -4.0 * depth * np.cos(2.0 * t)
        return translating(size + depth * np.cos(2.0 * t), -2.0 * depth * np.sin(2.0 * t), second if order > 1 else 0.0)

    return DiscCam("two lobes", path, 1, roller)


@pytest.mark.quick(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("radius", "offset", "roller"), [(60.0, 20.0, 15.0), (100.0, 5.0, 80.0), (0.05, 0.01, 0.02)])
def test_eccentric_circle(radius, offset, roller, sense):
    cam = eccentric(radius, offset, roller, sense)
    pitch, profile = cam.points(ANGLES)
    np.testing.assert_allclose(np.abs(pitch - offset), radius, rtol=1e-13)
    np.testing.assert_allclose(np.abs(profile - offset), radius - roller, rtol=1e-12)
    np.testing.assert_allclose(cam.curvature(ANGLES), 1.0 / radius, rtol=1e-12)
    # the normal passes through the circle's centre: sin(alpha) = e sin(t)/R
    sine = np.abs(offset * np.sin(ANGLES)) / radius
    np.testing.assert_allclose(np.abs(cam.pressure_angle(ANGLES)), np.arcsin(sine), rtol=0.0, atol=1e-12)
    assert cam.max_pressure_angle.value == pytest.approx(math.asin(offset / radius), abs=1e-13)
    assert math.cos(cam.max_pressure_angle.place) == pytest.approx(0.0, abs=1e-6)
    assert cam.min_curvature_radius.value == pytest.approx(radius, rel=1e-12)
    assert cam.max_radius == pytest.approx(radius - roller + offset, rel=1e-13)
    assert cam.min_radius == pytest.approx(radius - roller - offset, rel=1e-13)
    assert cam.undercut.depth <= 1e-12 * radius


def test_sense_of_rotation_mirrors_cam_and_pressure_angle():
    left, right = eccentric(60.0, 20.0, 15.0, 1), eccentric(60.0, 20.0, 15.0, -1)
    np.testing.assert_allclose(left.points(ANGLES)[1], np.conj(right.points(ANGLES)[1]), rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(left.pressure_angle(ANGLES), -right.pressure_angle(ANGLES), rtol=0.0, atol=1e-15)


def test_axis_outside_the_profile_is_no_undercut():
    cam = eccentric(60.0, 50.0, 20.0)  # the axis stands 10 mm outside the profile, which is a plain circle
    assert not cam.star_shaped
    assert cam.undercut.depth <= 1e-10
    assert [check.status for check in undercut_checks([cam])] == ["pass"]


@pytest.mark.parametrize(("size", "depth"), [(100.0, 20.0), (100.0, 60.0), (0.1, 0.06)])
def test_least_convex_radius_of_two_lobes(size, depth):
    # at the tip rho = R + D, rho'' = -4 D: rho^2/(rho - rho'')
    tip = (size + depth) ** 2 / (size + 5.0 * depth)
    cam = lobes(size, depth, 0.1 * size)
    assert cam.min_curvature_radius.value == pytest.approx(tip, rel=1e-13)
    assert (cam.max_radius, cam.min_radius) == pytest.approx((0.9 * size + depth, 0.9 * size - depth), rel=1e-13)


def test_radii_of_a_profile_that_loops_hold_the_body():
    """Against the body itself: along each ray from the axis it reaches to the first roller."""
    cam = lobes(100.0, 10.0, 87.0)  # minimum radius of curvature 80.7 mm
    pitch, _profile = cam.points(np.linspace(0.0, 2.0 * math.pi, 1441))
    along = pitch * np.exp(-1j * np.linspace(0.0, math.pi, 181))[:, None]
    inside = 87.0**2 - along.imag**2
    reach = np.where(inside > 0.0, along.real - np.sqrt(np.abs(inside)), np.inf).min(
        axis=1, where=along.real > 0.0, initial=np.inf
    )
    assert (cam.max_radius, cam.min_radius) == pytest.approx((23.0, 3.0), abs=1e-12)
    assert reach.min() == pytest.approx(cam.min_radius, abs=1e-9)
    assert reach.max() < cam.max_radius, "the roller cuts the tip off"


@pytest.mark.quick(2)
@pytest.mark.parametrize("roller", [44.8, 50.0, 60.0])
def test_roller_that_cuts_through_the_neck_from_the_other_side(roller):
    # No cusp: the minimum convex radius is 64 mm. But the neck is 2 x 40 mm wide, and the roller takes its radius
    # from both sides.
    cam = lobes(100.0, 60.0, roller)
    assert cam.min_curvature_radius.value == pytest.approx(64.0, rel=1e-13)
    assert cam.undercut.depth == pytest.approx(2.0 * (roller - 40.0), rel=1e-12)
    (check,) = undercut_checks([cam])
    assert (check.code, check.name, check.status) == ("GL402", "cam-undercut", "fail" if roller < 0.8 * 64 else "warn")
    if roller < 0.8 * 64.0:
        assert "cut of the roller of the two lobes into its own profile" in check.message


def test_star_shaped_profile_needs_no_search_and_agrees_with_it():
    from gearlink.core.parts.cams.undercut import undercut

    cam = lobes(100.0, 20.0, 50.0)
    assert cam.star_shaped
    assert cam.undercut.depth == 0.0
    assert undercut(cam.points, cam.roller_radius).depth <= 1e-11


def cornered(size: float, depth: float, roller: float) -> DiscCam:
    """rho = R + D |sin(t/2)|, whose slope steps by D at t = 0: a ridge for D < 0, a valley for D > 0."""

    def path(t, order):
        half = 0.5 * np.mod(t, 2.0 * np.pi)
        second = -0.25 * depth * np.sin(half)
        return translating(size + depth * np.sin(half), 0.5 * depth * np.cos(half), second if order > 1 else 0.0)

    return DiscCam("cornered", path, 1, roller, (0.0,))


@pytest.mark.quick(2)
@pytest.mark.parametrize("depth", [-20.0, -0.5, 0.5, 20.0])
def test_a_roller_cuts_a_ridge_of_its_pitch_curve_and_no_valley(depth):
    """Against all distances of fine grids beside the corner, which miss the depth by less than their step's square."""
    cam = cornered(100.0, depth, 20.0)
    assert cam.least_support > cam.roller_radius
    assert cam.roller_radius < cam.min_curvature_radius.value
    assert cam.star_shaped == (depth > 0.0)
    angles = np.concatenate([2.0 * math.pi - np.geomspace(1e-9, 0.3, 700)[::-1], np.geomspace(1e-9, 0.3, 700)])
    pitch, profile = cam.points(angles)
    cut = cam.roller_radius - float(np.abs(profile[:, None] - pitch).min())
    assert cam.undercut.depth == pytest.approx(cut if depth < 0.0 else 0.0, abs=1e-4 * abs(depth))
    assert (cut > 1e-5) == (depth < 0.0)


@pytest.mark.parametrize(
    ("share", "status"), [(0.5, "pass"), (0.799, "pass"), (0.801, "warn"), (1.0, "fail"), (2, "fail")]
)
def test_roller_against_the_least_convex_radius(share, status):
    cam = eccentric(64.0, 2.0, 64.0 * share)  # a power of two: the curvature radius is exact
    (check,) = undercut_checks([cam])
    assert check.status == status
    assert check.value == pytest.approx(share, rel=1e-12)
    if status != "pass":
        assert "at most 51." in check.fix
        assert [c.status for c in undercut_checks([eccentric(64.0, 2.0, 51.199)])] == ["pass"]


@pytest.mark.parametrize(("limit", "status"), [(19.4, "fail"), (19.5, "pass")])
def test_pressure_angle_against_its_limit(limit, status):
    # asin(1/3) = 19.4712 deg
    (check,) = pressure_angle_checks([eccentric(60.0, 20.0, 15.0)], limit, "enlarge the base circle")
    assert (check.code, check.status, check.unit) == ("GL401", status, "deg")
    assert check.value == pytest.approx(math.degrees(math.asin(1.0 / 3.0)), rel=1e-13)
    assert "pressure angle of the circle" in check.message
    assert bool(check.fix) == (status == "fail")


def test_steps_below_a_share_of_the_peak_are_rounding():
    steps = [("a/b at 1 deg", 1e-4), ("b/a at 2 deg", -2e-3)]
    quiet = step_check(VELOCITY_STEP, steps, 201.0, "mm/rad", "fail", "repair it")
    assert (quiet.status, quiet.value, quiet.limit) == ("pass", 2e-3, pytest.approx(2.01e-3, rel=1e-12))
    loud = step_check(VELOCITY_STEP, steps, 199.0, "mm/rad", "fail", "repair it")
    assert (loud.status, loud.value) == ("fail", 2e-3)
    assert "step of the lift's velocity" in loud.message
    assert "a/b" not in loud.message


def test_table_has_the_columns_of_every_cam():
    cam = eccentric(60.0, 20.0, 15.0)
    table = cam.table("main_cam", 7)
    angles = 2.0 * np.pi / 7 * np.arange(7)
    assert table.columns == ("cam_angle", "pitch_x", "pitch_y", "x", "y", "pressure_angle", "curvature_radius")
    assert table.units == ("deg", "mm", "mm", "mm", "mm", "deg", "mm")
    rows = np.array(table.rows())
    np.testing.assert_allclose(rows[:, 3] + 1j * rows[:, 4], cam.points(angles)[1], rtol=0.0, atol=1e-13)
    np.testing.assert_allclose(rows[:, 5], np.degrees(cam.pressure_angle(angles)), rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(rows[:, 6], 60.0, rtol=1e-12)


def test_a_cam_that_touches_its_shaft_says_so_without_noise() -> None:
    cam = SimpleNamespace(name="main cam", min_radius=40.0 - 1.421e-14)
    (check,) = hub_checks(SHAFT_CLEARANCE, [cam], 40.0, lambda missing: f"{missing:g} mm")
    assert (check.status, check.value) == ("fail", 0.0)
    assert check.message.startswith("distance of the main cam from its shaft")
