"""Knife edges against polygons, derivatives of their path with 40 digits, and searches that know no formula."""

from __future__ import annotations

import cmath
import math
from typing import Any

import factory
import mpmath
import numpy as np
import pytest
from pydantic import ValidationError
from sweeps import spread

from gearlink.cli.export.contour import JOIN
from gearlink.cli.export.parts import follower_cam

LIFT, RISE, BASE = 25.0, 100.0, 45.0
MOTION: list[dict[str, Any]] = [
    {"to": RISE, "lift": LIFT, "law": "cycloidal"},
    {"to": 150},
    {"to": 230, "lift": 0, "law": "cycloidal"},
    {"to": 360},
]
SWING = [{**each, "lift": 0.8 * each["lift"]} if "lift" in each else each for each in MOTION]
SLIDE = {"type": "translating-knife-edge", "offset": 9.0, "direction": 70.0}
ROCKER = {"type": "oscillating-knife-edge", "arm": 90.0, "center_distance": 110.0, "pivot_direction": 20.0}
EVEN = [{"to": 120, "lift": 20, "law": "constant-velocity"}, {"to": 240, "lift": 0}, {"to": 360}]


def edge(follower: dict[str, Any], motion: Any = None, command: str = "cam", **keys: Any) -> Any:
    own = SWING if follower["type"].startswith("osc") else MOTION
    data = {"kind": "disc-cam", "name": "edge", "motion": own if motion is None else motion, "follower": follower}
    return factory.design({**data, "cam": {"base_radius": BASE}, **keys}, command=command)


def path(follower: dict[str, Any], sense: int, phi: Any, exp: Any = np.exp) -> Any:
    """The edge in the cam's frame during the rise, and its direction of motion in that frame, off the cam."""
    sin, pi = (mpmath.sin, mpmath.pi) if exp is mpmath.exp else (np.sin, math.pi)
    x = phi / (RISE * pi / 180)
    share = x - sin(2 * pi * x) / (2 * pi)
    back = exp(-1j * sense * phi)
    if follower["type"].startswith("translating"):
        u, e = cmath.rect(1.0, math.radians(follower["direction"])), follower["offset"]
        return back * u * (math.sqrt(BASE**2 - e**2) + LIFT * share - 1j * e), back * u
    f, arm, side = follower["center_distance"], follower["arm"], follower["side"]
    start = math.acos((f**2 + arm**2 - BASE**2) / (2.0 * f * arm))
    pivot = cmath.rect(f, math.radians(follower["pivot_direction"]))
    along = exp(1j * (cmath.phase(pivot) + math.pi - side * (start + 0.8 * LIFT * share * pi / 180)))
    return back * (pivot + arm * along), -1j * side * along * back


def inside(polygon: np.ndarray, points: np.ndarray) -> np.ndarray:
    """Whether a polygon winds round points."""
    ahead = np.append(polygon, polygon[0])[:, None] - points[None, :]
    return np.abs(np.angle(ahead[1:] / ahead[:-1]).sum(axis=0)) > math.pi


WAYS = [(follower, sense, side) for follower in (SLIDE, ROCKER) for sense in (1, -1) for side in (1, -1)]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("follower", "sense", "side"), WAYS)
def test_the_edge_touches_its_cam_and_the_follower_behind_it_does_not(
    follower: dict[str, Any], sense: int, side: int
) -> None:
    """The chords of the polygon lie within h^2/8 rho = 7200^-2 of a turn, 1e-5 mm, of the profile."""
    given = {**follower, "offset": side * 9.0} if follower is SLIDE else {**follower, "side": side}
    design = edge(given, cam={"base_radius": BASE, "sense": sense})
    table = design.table("main_cam", samples=7200)
    assert table.columns == ("cam_angle", "x", "y", "pressure_angle", "curvature_radius")
    profile = table["x"] + 1j * table["y"]
    phi = np.radians(np.arange(0.5, RISE, 3.0))
    tip, away = path(given, sense, phi)
    assert np.abs(design.cams.main.points(phi)[1] - tip).max() < 1e-12 * BASE
    for reach in (1e-3, 1.0, 10.0, 40.0):
        assert not inside(profile, tip + reach * away).any(), reach
    assert inside(profile, tip - 1e-3 * away).all()


@pytest.mark.quick(2)
@pytest.mark.parametrize(("follower", "sense", "side"), WAYS)
def test_pressure_angle_and_radius_are_those_of_the_path_by_40_digits(
    follower: dict[str, Any], sense: int, side: int
) -> None:
    given = {**follower, "offset": side * 9.0} if follower is SLIDE else {**follower, "side": side}
    cam = edge(given, cam={"base_radius": BASE, "sense": sense}).cams.main
    for degrees in (3.0, 31.0, 62.0, 97.0):
        phi = math.radians(degrees)
        with mpmath.workdps(40):
            place = mpmath.mpf(phi)
            first, second = (mpmath.diff(lambda p: path(given, sense, p, mpmath.exp)[0], place, n) for n in (1, 2))
            turned = first / path(given, sense, place, mpmath.exp)[1]  # the tangent, from the direction of motion
            alpha = abs(mpmath.atan(mpmath.re(turned) / mpmath.im(turned)))
            kappa = -sense * mpmath.im(mpmath.conj(first) * second) / abs(first) ** 3
        assert abs(float(cam.pressure_angle(np.array([phi]))[0])) == pytest.approx(float(alpha), rel=1e-12, abs=1e-14)
        assert float(cam.curvature(np.array([phi]))[0]) == pytest.approx(float(kappa), rel=1e-10, abs=1e-13)


@pytest.mark.quick(2)
@pytest.mark.parametrize("offset", [0.0, 7.0, "best"])
def test_the_smallest_cam_keeps_the_pressure_angle_and_none_smaller_does(offset: Any) -> None:
    design = edge({**SLIDE, "offset": offset}, cam={"size": {"pressure_angle": 28}})
    radius, found = design.base_radius, design.offset
    assert math.degrees(design.max_pressure_angle) == pytest.approx(28.0, rel=1e-9)
    assert design.prime_radius is None
    beside = [found] if offset != "best" else [found + 0.05 * k for k in range(-40, 41)]
    for e in spread(beside, 9):
        smaller = edge({**SLIDE, "offset": e}, cam={"base_radius": radius - 0.01})
        assert math.degrees(smaller.max_pressure_angle) > 28.0


def test_a_sized_radius_of_curvature_is_kept_and_may_be_omitted() -> None:
    for follower in spread([{**ROCKER, "center_distance": 110.0}, {**ROCKER, "center_distance": None}, SLIDE], 1):
        loose, tight = (
            edge(follower, cam={"size": {"pressure_angle": 50, **more}}) for more in ({}, {"curvature_radius": 60})
        )
        assert loose.min_curvature_radius < 60.0
        assert tight.min_curvature_radius == pytest.approx(60.0, rel=1e-9)
        assert tight.base_radius > loose.base_radius


@pytest.mark.quick(1)
@pytest.mark.parametrize("follower", [SLIDE, {**ROCKER, "side": -1}])
def test_a_jump_of_the_velocity_is_a_corner_of_the_profile(follower: dict[str, Any]) -> None:
    """The turns of the tangent on both sides of it, 1e-6 of a radian by chords of 1e-7."""
    design = edge(follower, EVEN, cam={"base_radius": BASE, "cutter_radius": 3})
    cam = design.cams.main
    turns = []
    for place in (0.0, math.radians(120.0)):
        at = np.mod(place + np.array([-2e-7, -1e-7, 1e-7, 2e-7]), 2.0 * math.pi)
        points = cam.points(at)[1]
        turns.append(-cmath.phase((points[3] - points[2]) / (points[1] - points[0])))
    found = {round(math.degrees(each.place)): each.value for each in cam.corners}
    assert [found[0], found[120]] == pytest.approx(turns, abs=1e-6)
    assert found[0] < 0.0 < found[120]
    assert (design.min_curvature_radius, design.min_concave_radius) == (0.0, 0.0)
    statuses = {check.name: check for check in design.report("cam").checks}
    assert (statuses["cam-undercut"].status, statuses["cutter-radius"].status) == ("pass", "fail")
    assert "120 deg" in statuses["cam-undercut"].message


def test_a_roller_leaves_its_own_radius_in_a_hollow_corner() -> None:
    """No cutter as large as the roller reaches it; the arc of the roller about the corner is in the export."""
    follower = {"type": "translating-roller", "roller_radius": 8}
    design = edge(follower, EVEN, cam={"prime_radius": BASE, "cutter_radius": 8})
    assert design.min_concave_radius == 8.0
    (check,) = design.check("cutter-radius")
    assert (check.status, check.limit) == ("fail", 8.0)
    (wall,) = edge(follower, EVEN, cam={"prime_radius": BASE}, closure="groove").check("outer-wall")
    assert wall.status == "fail"


def test_the_sharpest_convex_place_is_warned_of() -> None:
    (sharp,) = edge(SLIDE).check("cam-undercut")
    for limit, status in ((sharp.value * 0.999, "pass"), (sharp.value * 1.001, "warn")):
        (check,) = edge(SLIDE, limits={"curvature_radius": limit}).check("cam-undercut")
        assert check.status == status


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"closure": "groove"}, "groove applies only to a roller"),
        ({"cam": {"prime_radius": 50}}, "give cam.base_radius instead"),
        ({"errors": {"roller_radius": 0.01}}, "roller_radius applies only to a roller"),
        ({"loads": {"roller": {"width": 10.0}}}, "a knife edge has no contact pressure"),
        ({"loads": {"material": {"allowed_pressure": 900.0}}}, "a knife edge has no contact pressure"),
        ({"cam": {"base_radius": 8.0}}, r"limit < 8 mm, cam.base_radius"),
    ],
)
def test_what_only_a_roller_has_is_refused(keys: dict[str, Any], words: str) -> None:
    with pytest.raises(ValidationError, match=words):
        edge(SLIDE, **keys)


def test_the_contact_of_an_edge_has_forces_and_no_pressure() -> None:
    follower, spring = {**SLIDE, "mass": 1.2}, {"preload": 30, "rate": 4}
    design = edge(follower, command="loads", speed=200, spring=spring, loads={})
    assert design.table_contact(36).columns == ("cam_angle", "main_force")
    phi = np.radians(np.arange(0.0, 360.0, 7.0))
    s, s1, s2 = design.design.cams.motion.evaluate(phi, 2)
    along = 30.0 + 4.0 * s + 1.2e-3 * s2 * (200.0 * math.pi / 30.0) ** 2
    alpha = np.arctan2(s1 - 9.0, math.sqrt(BASE**2 - 81.0) + s)
    assert design.contact_force("main", phi) == pytest.approx(along / np.cos(alpha), rel=1e-11)
    assert design.cam_torque(phi) == pytest.approx(1e-3 * along * s1, abs=1e-12)
    report = design.report("loads")
    shown = {each.name: each.value for each in report.quantities}
    assert not {"hertz_pressure_max", "roller_speed_max", "traction_needed", "face_width_needed"} & set(shown)
    assert shown["contact_force_max"] == pytest.approx((along / np.cos(alpha)).max(), rel=1e-3)
    (lost,) = edge(follower, command="loads", speed=900, spring=spring, loads={}).check("contact-loss")
    assert "the knife edge leaves its cam" in lost.message


def test_profile_and_cutter_path_are_exported() -> None:
    design = edge(SLIDE, EVEN, cam={"base_radius": BASE, "cutter_radius": 6})
    made = {name: make() for name, make in follower_cam(design).items()}
    assert {layer for each in made["main_cam"].stretches for layer in each.layers} == {"PROFILE"}
    assert made["main_cam"].notes[0].startswith("knife edge, ")
    assert made["cutter"].notes[0].startswith("path of a cutter of radius 6 mm; knife edge")
    theta = np.linspace(1.0, 2.0, 50)
    (stretch,) = [each for each in made["cutter"].stretches if each.low < 1.0 and each.high > 2.0]
    path, profile = stretch.points(theta)
    assert np.abs(path - profile) == pytest.approx(6.0, rel=1e-12)
    assert (np.abs(path) > np.abs(profile)).all()


@pytest.mark.parametrize("closure", ["groove", "spring"])
def test_an_arc_about_a_corner_joins_what_lies_outside_the_pitch_curve(closure: str) -> None:
    """It lay on the other side of the corner."""
    follower, body = {"type": "translating-roller", "roller_radius": 8}, {"prime_radius": BASE, "cutter_radius": 20}
    for name, make in follower_cam(edge(follower, EVEN, cam=body, closure=closure)).items():
        stretches = make().stretches
        for before, after in zip(stretches, [*stretches[1:], stretches[0]], strict=True):
            ends = before.points(np.array([before.high])), after.points(np.array([after.low]))
            assert abs(ends[0][0, 0] - ends[1][0, 0]) <= JOIN, (name, after.name)
