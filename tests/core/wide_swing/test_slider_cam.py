"""The cam of a wide-swing rocker that drives a slider: geometry in the world, contact, and the torque of the device.

Tolerances: places 1e-12 of the centre distance; directions against differences over 1e-5 of the stroke 1e-6; torque of
the device against the energy of rocker and slider by differences 1e-6; without a slider's mass the cam is that of the
rocker alone within 1e-9, since the law is then computed another way.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.cam import WideSwingCam
from gearlink.core.machines.wide_swing.design import WideSwingDesign
from gearlink.core.machines.wide_swing.device import Pneumatic
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.oscillating_cam import crank_angle, way_home
from gearlink.core.machines.wide_swing.oscillating_cam import need_home as way_home_ratio
from gearlink.core.machines.wide_swing.slider import AimedLaw, SliderDrive, SliderLaw, fastest_place
from gearlink.core.machines.wide_swing.spec import WideSwingSpec

GAMMA, ANGLE, A, R = math.radians(120.0), math.radians(150.0), 200.0, 8.0
DRIVE = SliderDrive(150.0, 450.0, math.radians(90.0))


def law(share: float = 0.3) -> SliderLaw:
    return SliderLaw(Pneumatic(2.6), GAMMA, DRIVE, share)


def cam(share: float = 0.3) -> WideSwingCam:
    return WideSwingCam("twin-cam", AimedLaw(law(share), fastest_place(law(share))), ANGLE, A, R)


def path(made: WideSwingCam, k: Any) -> Any:
    """The roller's centre in the turning cam, from the rocker's angle."""
    phi = GAMMA * (law().invariants(np.asarray(k), 0)[0] - 0.5) - made.arm_offset
    theta = made.cycle_angle * (np.asarray(k) - made.middle)
    return np.exp(1j * theta) * (made.rocker_radius * np.exp(1j * phi) - A)


def test_pitch_curve_is_the_rollers_path() -> None:
    made, k = cam(), np.linspace(0.0, 1.0, 401)
    np.testing.assert_allclose(made.points(k).pitch, path(made, k), rtol=0.0, atol=1e-10)


def test_roller_is_fastest_on_the_line_of_centres() -> None:
    made = cam()
    b = law().invariants(np.linspace(0.0, 1.0, 20001), 1)[1]
    assert made.middle == pytest.approx(float(np.argmax(b)) / 20000, abs=1e-4)
    assert made.rocker_radius == pytest.approx(A / (1.0 + float(b.max()) * GAMMA / ANGLE), rel=1e-8)


def test_rates_of_the_view_are_those_of_its_angle() -> None:
    """On both sides of k*, by differences over h."""
    aimed, h = cam().law, 1e-5
    for k in (0.2, 0.45, 0.55, 0.68, 0.72, 0.8):
        low, at, high = (aimed.middle_view(np.array([k + side * h])) for side in (-1, 0, 1))
        assert (high.angle - low.angle) / (2.0 * h) == pytest.approx(aimed.swing * at.velocity, rel=1e-7)
        assert (high.velocity - low.velocity) / (2.0 * h) == pytest.approx(at.acceleration, rel=1e-6, abs=1e-6)
        assert at.velocity + at.deficit == pytest.approx(aimed.velocity_peak, rel=1e-13)
    assert aimed.middle_view(np.array([aimed.place])).angle[0] == 0.0


def test_profile_stands_on_the_normal_and_the_pressure_angle_on_the_arm() -> None:
    made, h = cam(), 1e-5
    for k in (0.05, 0.3, 0.55, 0.8, 0.95):
        z = path(made, [k - h, k + h])
        along = (z[1] - z[0]) / abs(z[1] - z[0])
        at = made.points(np.array([k]))
        normal = complex(at.profile[0] - at.pitch[0]) / R
        assert abs((normal * along.conjugate()).real) < 1e-6
        assert abs(normal) == pytest.approx(1.0, rel=1e-12)
        assert (normal * complex(at.pitch[0]).conjugate()).real < 0.0  # the body lies inside
        pivot = -A * np.exp(1j * made.cycle_angle * (k - made.middle))
        motion = 1j * (complex(at.pitch[0]) - pivot)
        angle = math.acos(abs((normal * motion.conjugate()).real) / abs(motion))
        assert abs(float(at.pressure_angle[0])) == pytest.approx(angle, abs=1e-6)


@pytest.mark.slow
def test_roller_nowhere_enters_the_profile() -> None:
    made = cam()
    (first, start), (end, last) = made.contact
    k = np.concatenate([np.linspace(first, start, 1500), np.linspace(end, last, 1500)])
    profile = made.points(k).profile
    centre = made.points(np.linspace(0.0, 1.0, 1201)).pitch
    room = np.abs(profile[None, :] - centre[:, None]).min(axis=1)
    assert room.min() > R * (1.0 - 1e-9)


@pytest.mark.slow
def test_without_the_sliders_mass_it_is_the_rockers_own_cam() -> None:
    made = cam(share=1.0)
    plain = WideSwingCam("twin-cam", ElasticLaw(Pneumatic(2.6), GAMMA), ANGLE, A, R)
    assert made.middle == pytest.approx(0.5, abs=1e-12)
    for name in ("rocker_radius", "min_radius", "max_radius", "max_pressure_angle", "min_curvature_radius"):
        assert getattr(made, name) == pytest.approx(getattr(plain, name), rel=1e-9), name
    assert made.transition_zone == pytest.approx(plain.transition_zone, rel=1e-9)
    assert made.loop_margin == pytest.approx(plain.loop_margin, rel=1e-6)
    k = np.array([0.0, 0.1, 0.3, 0.45, 0.6, 0.9, 1.0])
    one, other = made.points(k), plain.points(k)
    np.testing.assert_allclose(one.profile, other.profile, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(one.pressure_angle, other.pressure_angle, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(one.curvature_radius, other.curvature_radius, rtol=1e-7)


def test_deficit_is_the_peak_less_the_velocity() -> None:
    aimed = cam().law
    view = aimed.middle_view(np.array([0.1, 0.3, 0.64, 0.65, 0.73, 0.75, 1.0]))
    np.testing.assert_allclose(view.deficit, aimed.velocity_peak - view.velocity, rtol=0.0, atol=1e-12)


def test_torque_of_the_device_is_the_change_of_the_energy() -> None:
    moved = law()
    k, h = np.array([0.1, 0.35, 0.6, 0.9]), 1e-5

    def energy(at: Any) -> Any:
        """b^2 j/2, of rocker and slider together."""
        b = moved.invariants(at, 1)[1]
        slider = moved.slider_invariants(at)[1]
        return 0.5 * (moved.rocker_share * b * b + (1.0 - moved.rocker_share) * slider * slider)

    gained = energy(k + h) - energy(k - h)
    turned = moved.invariants(k + h, 0)[0] - moved.invariants(k - h, 0)[0]
    np.testing.assert_allclose(moved.device_torque(k), gained / turned, rtol=1e-6)


@pytest.mark.slow
def test_design() -> None:
    made = design("wide_swing_slider_cam")
    report = made.report("analyze")
    assert {check.status for check in report.checks} <= {"pass", "warn"}
    names = {quantity.name for quantity in report.quantities}
    assert {"line_of_centers_place", "roller_arm_offset", "contact_force", "dwell_force", "slider_stroke"} <= names
    assert made.quantity("line_of_centers_place").value == made.cam.middle
    force = made.unloading.contact_force(made.cam, np.array([0.0, 0.2, 0.9]))
    assert (force > 0.0).all()
    assert made.dwell_force == pytest.approx(
        float(made.unloading.contact_force(made.cam, np.array([0.0, 1.0]), 0.0).max()), rel=1e-14
    )
    with pytest.raises(NoSolution, match="omit slider"):
        _ = made.even_cam


@pytest.mark.slow
def test_film_turns_the_cam_under_the_roller() -> None:
    """In the scene the roller touches the drawn profile in working and return stroke.

    The nearest of points h apart stands up to t = h/2 beside the touch, and so t^2/(2 r_p) rho/(rho - r_p) farther
    from the roller's centre, rho that of the pitch curve.
    """
    from gearlink.cli.views.figures.wide_swing_cam import Cycle, build
    from gearlink.cli.views.scenes.scene import Body

    made = design("wide_swing_slider_cam")
    fraction = np.array([0.05, 0.12, 0.3, 0.38, 0.55, 0.62, 0.8, 0.88])
    scene, cycle = build(made, fraction), Cycle(made, fraction)
    centre = made.cam.rocker_radius * np.exp(1j * (cycle.swing - made.cam.arm_offset))
    roller, rho = made.cam.roller_radius, np.abs(made.cam.points(cycle.stroke).curvature_radius)
    bodies = [part for part in scene.parts if isinstance(part, Body) and len(part.outline) > 150]
    working, returning = bodies[1], bodies[0]
    for part, rows in ((working, slice(0, 4)), (returning, slice(4, 8))):
        outline = part.place[rows, None] + np.exp(1j * part.turn[rows, None]) * part.outline[None, :]
        beyond = np.abs(outline - centre[rows, None]).min(axis=1) - roller
        aside = 0.5 * np.abs(np.diff(part.outline)).max()
        assert np.all(beyond > -1e-9)
        assert np.all(beyond < aside**2 / (2.0 * roller) * rho[rows] / (rho[rows] - roller))


@pytest.mark.slow
def test_a_heavy_slider_is_judged() -> None:
    made = design("wide_swing_slider_cam", command="cam", slider__mass=1e6)
    assert "fail" in {check.status for name in made.outline("cam").checks for check in made.check(name)}


def test_a_long_stroke_without_symmetry_is_judged() -> None:
    """Run-up and run-out are each less than a revolution; twice the longer one, 458 deg, is not."""
    made = design("wide_swing_slider_cam", command="swing", cycle_angle=340.0, slider__middle_angle=90.0)
    assert 2.0 * made.cam.middle * 340.0 == pytest.approx(458.3, abs=0.1)
    assert made.check("profile-exists")[0].status == "pass"


def test_a_roller_that_covers_the_profile_is_refused() -> None:
    with pytest.raises(NoSolution, match="covers the whole profile"):
        _ = design("wide_swing_slider_cam", cam__roller_radius=1e4).cam.contact


def test_a_cam_of_a_rocker_alone_has_none_of_its_places() -> None:
    """They are asked for as every quantity is: the refusal names the section that is missing."""
    for name in ("line_of_centers_place", "roller_arm_offset"):
        for worked in ("loaded_wide_swing", "loaded_oscillating_cam", "wide_swing_cycle"):
            with pytest.raises(NoSolution, match="section slider") as caught:
                design(worked).quantity(name)
            assert caught.value.key == "slider"


CRANK_ROCKER = {"crank": 40.0, "coupler": 400.0, "rocker": 96.0, "frame": 409.0}


def driven(middle_angle: float) -> WideSwingDesign:
    """A rocker with a slider on a cam that swings on a crank-rocker."""
    data = {
        "kind": "wide-swing-cam",
        "layout": "twin-cam",
        "drive": CRANK_ROCKER,
        "swing": 120.0,
        "speed": 60.0,
        "inertia": 0.05,
    }
    device = {"type": "pneumatic", "pivot_ratio": 2.6, "arm": 100.0, "reserve": 0.3}
    slider = {"crank": 150.0, "rod": 450.0, "middle_angle": middle_angle, "mass": 6.0}
    cam = {"center_distance": 200.0, "roller_radius": 8.0, "shaft_radius": 25.0}
    return WideSwingDesign(
        WideSwingSpec.model_validate(data | {"inertia": 0.05, "unloader": device, "slider": slider, "cam": cam})
    )


def test_cam_that_swings_is_met_where_the_ratio_of_speeds_has_its_extremum() -> None:
    cam = driven(73.18).oscillating_cam
    k = np.linspace(0.47, 0.5, 3001)
    ratio = cam.law.swing * cam.law.middle_view(k).velocity / cam.drive.motion(k)[1]
    place = int(np.argmax(ratio) if ratio.max() > max(ratio[0], ratio[-1]) else np.argmin(ratio))
    assert k[place] == pytest.approx(cam.middle, abs=2e-5)  # twice the step of the grid
    assert cam.rocker_radius == pytest.approx(200.0 / (1.0 + ratio[place]), rel=1e-8)
    assert cam.middle_pressure_angle == pytest.approx(0.0, abs=1e-10)


@pytest.mark.parametrize("middle_angle", [73.18, 80.0])
def test_pressure_angle_of_the_cam_that_swings_is_that_of_its_curve(middle_angle: float) -> None:
    cam, step = driven(middle_angle).oscillating_cam, 1e-6
    k = np.array([0.1, 0.3, 0.42, 0.7, 0.9])
    before, here, after = (cam.points(k + shift) for shift in (-step, 0.0, step))
    way = after.pitch - before.pitch
    arm = here.pitch + 200.0 * np.exp(1j * here.cam_angle)  # from the rocker's axis to the roller
    slope = np.abs((way * np.conj(arm)).real / (np.abs(way) * np.abs(arm)))
    # the normal of the curve against the way of the roller, square to its arm; differences over 2e-6 of the stroke
    np.testing.assert_allclose(np.abs(np.sin(here.pressure_angle)), np.sqrt(1.0 - slope**2), rtol=0, atol=1e-6)


def test_way_home_of_rocker_and_slider() -> None:
    design = driven(73.18)
    cam, motion, step = design.oscillating_cam, design.motion, 1e-5
    k = np.array([0.1, 0.3, 0.7, 0.9])
    turned = crank_angle(cam, k)

    def energy(angle: Any) -> Any:
        at = way_home(cam, angle)
        return 0.5 * motion.law.kinetic(at.value) * at.first**2

    def share(angle: Any) -> Any:
        return motion.law.invariants(way_home(cam, angle).value, 0)[0]

    # torque is the slope of the energy of motion over the rocker's angle
    work = (energy(turned + step) - energy(turned - step)) / (share(turned + step) - share(turned - step))
    expected = work / motion.law.device_torque(k) * cam.drive.crank_span**2 / motion.swing * motion.swing
    np.testing.assert_allclose(way_home_ratio(cam, k), expected, rtol=1e-6)


def test_the_angle_of_the_law_gives_the_motion_that_the_time_gives() -> None:
    """Times and deficits beside k* are integrals; the others, differences of places, keep 1e-11 at 0.01 of the way."""
    aimed = cam().law
    shares = np.array([-0.69, -0.4, -0.1, -0.03, -0.01, 0.004, 0.01, 0.1, 0.2, 0.3])
    k = aimed.place + shares
    turns = np.array([aimed.turn_at(share) for share in shares.tolist()])
    for side in (shares < 0.0, shares > 0.0, shares != 0.0):
        np.testing.assert_allclose(aimed.share_from_middle(turns[side]), shares[side], rtol=1e-11)
    seen, expected = aimed.view_at(turns), aimed.middle_view(k)
    for name in ("angle", "velocity", "deficit", "acceleration"):
        np.testing.assert_allclose(getattr(seen, name), getattr(expected, name), rtol=1e-10, atol=1e-13)
    assert aimed.share_from_middle(np.array(aimed.turns)) == pytest.approx([-aimed.place, 1.0 - aimed.place], rel=1e-13)
    assert aimed.turn_near(1e-6) == pytest.approx(aimed.turn_at(1e-6), rel=1e-4)
