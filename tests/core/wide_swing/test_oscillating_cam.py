"""Oscillating cam on a crank-rocker.

Tolerances: 1e-14 against 20-digit references; curvature against complex differentiation in mpmath 1e-12 times the
cusp's condition, since both speeds of the parametric formula vanish at its stops.
"""

from __future__ import annotations

import json
import math
import re
from collections.abc import Callable
from pathlib import Path
from typing import Any

import factory
import mpmath as mp
import numpy as np
import pytest
from oracles.unloading_limits import pendulum_stretch_ratio

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.device import Pneumatic, Spring
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.oscillating_cam import CrankRockerDrive, OscillatingCam
from gearlink.core.parts.linkages.fourbar.position import FourBar

EXPECTED = next(
    case["outputs_float"]
    for case in json.loads((Path(__file__).parents[2] / "reference" / "wide_swing.json").read_text())["cases"]
    if case["id"] == "D19"
)
SWING = math.radians(120.0)
BAR = FourBar(crank=1.0, coupler=3.0, rocker=2.5, frame=4.0)
DRIVE = CrankRockerDrive(BAR)
CAM = OscillatingCam(DRIVE, ElasticLaw(Pneumatic(2.5), SWING), 1.0, 0.02)
PENDULUM = OscillatingCam(DRIVE, ElasticLaw(Spring(3.0, pendulum_stretch_ratio(3.0, SWING)), SWING), 1.0, 0.02)
"""With a law in closed form."""


def test_reference() -> None:
    first, last = (math.degrees(x) for x in DRIVE.crank_angles)
    assert (first, last) == pytest.approx((EXPECTED["theta_dead1_deg"], EXPECTED["theta_dead2_deg"]), rel=1e-14)
    assert math.degrees(DRIVE.crank_span) == pytest.approx(EXPECTED["crank_span_deg"], rel=1e-14)
    assert math.degrees(DRIVE.swing) == pytest.approx(EXPECTED["cam_swing_deg"], rel=1e-14)
    _, velocity, acceleration = DRIVE.motion(np.array([0.5]))
    assert velocity[0] == pytest.approx(EXPECTED["dchi_dk_mid"], rel=1e-14)
    assert acceleration[0] == pytest.approx(EXPECTED["d2chi_dk2_mid"], rel=1e-13)
    assert CAM.rocker_radius == pytest.approx(EXPECTED["r_over_a"], rel=1e-14)
    # the reference counts the residual angle against the sense of the twin-cam's pressure angle
    assert math.degrees(CAM.middle_pressure_angle) == pytest.approx(-EXPECTED["delta_mid_deg"], rel=1e-13)


def test_pressure_angle_runs_through_its_special_places() -> None:
    """The limits at both ends and at mid-swing against their neighbourhood, 2^-26 of a stroke away."""
    step = 2.0**-26
    angles = CAM.points(np.array([0.0, step, 0.5 - step, 0.5, 0.5 + step, 1.0 - step, 1.0])).pressure_angle
    assert np.abs(np.diff(angles[[0, 1]])).max() < 1e-6
    assert np.abs(np.diff(angles[[2, 3, 4]])).max() < 1e-6
    assert np.abs(np.diff(angles[[5, 6]])).max() < 1e-6


@pytest.mark.parametrize("outward", [True, False])
def test_dead_centres_stop_the_cam(outward: bool) -> None:
    drive = CrankRockerDrive(BAR, outward)
    chi, velocity, _ = drive.motion(np.array([0.0, 0.5, 1.0]))
    assert np.abs(velocity[[0, 2]]).max() < 1e-14
    assert chi[1] == 0.0
    assert chi[2] > 0.0 > chi[0]
    assert drive.swing == pytest.approx(DRIVE.swing, rel=1e-14)
    assert drive.crank_span + CrankRockerDrive(BAR, not outward).crank_span == pytest.approx(2 * math.pi, rel=1e-15)


def test_mirrored_linkage_swaps_the_strokes() -> None:
    mirror = CrankRockerDrive(FourBar(1.0, 3.0, 2.5, 4.0, -1))
    back = CrankRockerDrive(BAR, outward=False)
    assert mirror.crank_span == pytest.approx(back.crank_span, rel=1e-15)
    assert mirror.swing == pytest.approx(back.swing, rel=1e-14)


def exact_curve() -> Callable[[Any], Any]:
    """Pitch curve of `PENDULUM` over the fraction of the stroke, with the digits that mpmath works with."""
    gamma = mp.mpf(SWING)
    m = mp.sin(gamma / 4)
    quarter = mp.ellipk(m * m)
    first = mp.acos((mp.mpf(16) + 16 - mp.mpf("6.25")) / 32)
    last = mp.pi + mp.acos((mp.mpf(4) + 16 - mp.mpf("6.25")) / 16)

    def rocker(k: Any) -> Any:
        """Angle of the rocker against the frame by the cosine rule."""
        pin = mp.expj(first + k * (last - first)) - 4
        reach = mp.sqrt(mp.re(pin) ** 2 + mp.im(pin) ** 2)
        inner = mp.acos((reach**2 + mp.mpf("6.25") - 9) / (5 * reach))
        return mp.atan2(mp.im(pin), mp.re(pin)) % (2 * mp.pi) - inner

    middle = rocker(mp.mpf("0.5"))
    speed = mp.diff(rocker, mp.mpf("0.5"))
    ratio = 1 / (1 + 4 * quarter * m / speed)

    def curve(k: Any) -> Any:
        phi = -2 * mp.asin(m * mp.ellipfun("sn", quarter * (1 - 2 * k), m=m * m))
        return mp.expj(rocker(k) - middle) * (-1 + ratio * mp.expj(phi))

    return curve


def test_curvature_by_differentiating_the_curve() -> None:
    cam = PENDULUM
    k = np.array([0.02, 0.2, 0.45, 0.5 - 2.0**-7, 0.6, 0.9])
    points = cam.points(k)
    with mp.workdps(40):
        curve = exact_curve()
        for i, place in enumerate(k.tolist()):
            z, d1, d2 = (mp.diff(curve, mp.mpf(place), n) for n in range(3))
            assert points.pitch[i] == pytest.approx(complex(z), abs=1e-14)
            radius = float(abs(d1) ** 3 / mp.im(mp.conj(d1) * d2))
            # the formula's speed is a difference of numbers of order 1
            assert points.curvature_radius[i] == pytest.approx(radius, rel=1e-12 / float(abs(d1)))
            assert points.profile[i] == pytest.approx(complex(z + 0.02j * d1 / abs(d1)), abs=1e-13)


def test_stops_have_no_curvature_radius() -> None:
    points = CAM.points(np.array([0.0, 0.5, 1.0]))
    assert points.curvature_radius.tolist() == [0.0, 0.0, 0.0]
    np.testing.assert_allclose(np.abs(points.profile - points.pitch), 0.02, rtol=1e-13)
    near = CAM.points(np.array([2.0**-20, 0.5 - 2.0**-20, 1.0 - 2.0**-20]))
    np.testing.assert_allclose(points.profile, near.profile, rtol=0.0, atol=1e-6)


def test_loop_margin_is_the_sign_of_the_curvature_at_mid_swing() -> None:
    assert CAM.loop_margin > 0.0
    assert np.all(CAM.points(np.array([0.49, 0.51])).curvature_radius > 0.0)


def test_refusals() -> None:
    with pytest.raises(NoSolution, match="the drive is a double-rocker, not a crank-rocker"):
        CrankRockerDrive(FourBar(3.0, 1.0, 2.5, 4.0))
    with pytest.raises(NoSolution, match="centre distance: 0 mm"):
        OscillatingCam(DRIVE, CAM.law, 0.0, 1.0)
    with pytest.raises(NoSolution, match=r"too small to compute a cam with.*set swing to at least") as refused:
        _ = OscillatingCam(DRIVE, ElasticLaw(Pneumatic(2.5), 1e-14), 1.0, 0.02).ratio
    assert refused.value.key == "swing"


@pytest.mark.parametrize(
    ("crank", "coupler", "rocker", "frame", "repair"),
    [
        (40.0, 400.0, 23.281, 371.17, "drive.rocker"),  # it named a crank of 11.6 mm, with which nothing closes
        (60.0, 310.0, 100.0, 200.0, "drive.coupler"),
        (82.1028, 470.4, 269.6504, 82.1468, "drive.coupler"),
        (120.0, 180.0, 96.0, 192.0, "drive.crank"),
        (200.0, 400.0, 23.0, 100.0, None),  # crank and another length
    ],
)
def test_the_length_of_a_refused_drive_makes_a_crank_rocker(
    crank: float, coupler: float, rocker: float, frame: float, repair: str | None
) -> None:
    links = {"crank": crank, "coupler": coupler, "rocker": rocker, "frame": frame}
    with pytest.raises(NoSolution, match="not a crank-rocker") as refused:
        _ = factory.design("wide_swing_oscillating_cam", drive=links).motion.drive
    found = re.findall(r"set (\S+) to (\S+)", refused.value.fix)
    assert [key for key, _ in found] == ([] if repair is None else [repair])
    for key, value in found:
        links[key.removeprefix("drive.")] = float(value)
        assert FourBar(*links.values()).kind() == "crank-rocker"


def example(roller: float = 8.0, assembly: int = 1) -> OscillatingCam:
    """The example: 60, 180, 96, 192 mm, centre distance 200 mm."""
    drive = CrankRockerDrive(FourBar(60.0, 180.0, 96.0, 192.0, assembly))
    return OscillatingCam(drive, ElasticLaw(Pneumatic(2.6), SWING), 200.0, roller)


@pytest.mark.quick(1)
@pytest.mark.parametrize("cam", [example(), example(assembly=-1), example(roller=2.0)])
def test_roller_touches_the_profile_where_contact_says(cam: OscillatingCam) -> None:
    """By brute force over every place of the roller in the stroke: free where it touches, cut where it does not."""
    rollers = cam.points(np.concatenate([[0.0, 0.5, 1.0], np.linspace(0.0, 1.0, 3001)])).pitch

    def nearest(k: Any) -> Any:
        return np.abs(cam.points(k).profile[:, None] - rollers[None, :]).min(axis=1) / cam.roller_radius

    (first, start), (end, last) = cam.contact
    for low, high in cam.contact:
        assert nearest(np.linspace(low, high, 300)).min() >= 1.0 - 1e-10
    lost = [np.linspace(start, end, 42)[1:-1]]
    if first > 0.0:
        lost.append(np.linspace(0.0, first, 42)[1:-1])
    if last < 1.0:
        lost.append(np.linspace(last, 1.0, 42)[1:-1])
    inside = np.concatenate(lost)
    assert np.all(nearest(inside[inside != 0.5]) < 1.0)


@pytest.mark.slow
def test_contact_begins_where_the_standing_roller_is_left() -> None:
    """The step t from a stop is of its square, its part against the normal of its cube: t^-2 times some roundings."""
    (first, start), (end, last) = PENDULUM.contact
    with mp.workdps(40):
        curve = exact_curve()
        for stop, found in ((0.0, first), (0.5, start), (0.5, end), (1.0, last)):
            t = found - stop
            if t == 0.0:
                continue

            def room(part: Any, stop: float = stop) -> Any:
                way = mp.diff(curve, stop + part)
                return abs(curve(stop + part) + 0.02j * way / abs(way) - curve(mp.mpf(stop))) - mp.mpf("0.02")

            assert t == pytest.approx(float(mp.findroot(room, (t, 1.001 * t))), rel=4e-15 / t**2, abs=0.0)
    assert [first, 0.5 - start, end - 0.5, 1.0 - last] == [
        pytest.approx(t, rel=0.02) for t in (1.58e-3, 1.99e-2, 1.97e-2, 0.0)
    ]


def test_bulging_end_is_covered_and_hollow_end_is_not() -> None:
    """The example starts with a bulge and ends hollow; 0.752 of the minimum radius is 4/3 of a cusp's, to 2 %."""
    cam = example()
    (first, _), (_, last) = cam.contact
    assert 0.002 < first < 0.003
    assert last == 1.0
    start, end = cam.points(np.array([1e-3, 1.0 - 1e-3])).curvature_radius
    assert start > 0.0 > end
    assert cam.roller_radius / float(cam.points(np.array([first])).curvature_radius[0]) == pytest.approx(0.75, rel=0.03)


@pytest.mark.slow
@pytest.mark.parametrize("cam", [example(), example(assembly=-1), example(roller=2.0)])
def test_least_radius_is_that_of_the_points_that_are_touched(cam: OscillatingCam) -> None:
    """What the table prints where it gives a profile is nowhere a smaller bulge than the quantity says."""
    k = np.concatenate([np.linspace(low, high, 20001) for low, high in cam.contact])
    radii = cam.points(k[(k > 0.0) & (k < 1.0)]).curvature_radius
    least = float(radii[radii > 0.0].min())
    assert cam.min_curvature_radius == pytest.approx(least, rel=1e-6)
    assert cam.min_curvature_radius <= least * (1 + 1e-9)


def test_standing_roller_that_covers_all_is_refused_with_a_number() -> None:
    with pytest.raises(NoSolution, match=r"set cam.roller_radius below") as refused:
        _ = example(150.0).contact
    limit = float(str(refused.value).split("below ")[1].split(" mm")[0])
    assert example(150.0).transition_zone == 0.5
    assert example(0.999 * limit).transition_zone < 0.5


def test_next_to_a_standstill_the_pressure_angle_is_that_of_the_stop() -> None:
    """Both speeds vanish there: their ratio is rounding, and what divides by a cosine of it took 2 % more."""
    near = 10.0 ** -np.linspace(8.0, 17.0, 200)
    for cam in (CAM, example()):
        start, end = cam.pressure_angle(np.array([0.0, 1.0]))
        assert cam.pressure_angle(near) == pytest.approx(start, abs=1e-7)
        assert cam.pressure_angle(1.0 - near) == pytest.approx(end, abs=1e-7)


@pytest.mark.slow
def test_greatest_contact_force_is_the_same_in_other_units() -> None:
    """Above its lift-off speed the force is largest at the end of the stroke; all lengths 1.7 times as long."""
    data = factory.worked("wide_swing_oscillating_cam")
    force = factory.design(data, command="swing", unloader__residual=0.34).contact_force
    sizes = [(section, key) for section in ("drive", "cam", "unloader") for key in data[section]]
    larger = {
        f"{section}__{key}": 1.7 * data[section][key]
        for section, key in sizes
        if key not in ("stroke", "type", "pivot_ratio", "reserve")
    }
    made = factory.design(data, command="swing", unloader__residual=0.34, inertia=0.2 * 1.7**2, **larger)
    assert made.contact_force == pytest.approx(1.7 * force, rel=1e-9)
