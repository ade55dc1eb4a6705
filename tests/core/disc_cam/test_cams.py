"""Cams of followers against envelopes, differences and searches that share nothing with the closed forms."""

from __future__ import annotations

import json
import math
from typing import Any

import factory
import numpy as np
import pytest

from gearlink.cli.export.parts import follower_cam
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams import size
from gearlink.core.parts.cams.follower_motion import motion_of
from gearlink.core.parts.cams.motion_spec import Segment

MOTION = [
    {"to": 80, "lift": 30, "law": "modified-sine"},
    {"to": 150},
    {"to": 240, "lift": 0, "law": "polynomial-4567"},
    {"to": 360},
]
SWING = [
    {"to": 100, "lift": 25, "law": "modified-sine"},
    {"to": 160},
    {"to": 280, "lift": 0, "law": "cycloidal"},
    {"to": 360},
]
ROLLER = {"type": "translating-roller", "roller_radius": 12}
ROCKER = {"type": "oscillating-roller", "roller_radius": 15, "arm": 100, "center_distance": 140}
CLOSE = np.linspace(0.0, 2.0 * math.pi, 20_001)


def cam(motion: Any, follower: dict[str, Any], body: dict[str, Any], **more: Any) -> Any:
    data = {"kind": "disc-cam", "name": "cam", "motion": motion, "follower": follower, "cam": body, **more}
    return factory.design(data, command="cam")


def radius_by_differences(points: Any, phi: np.ndarray, h: float = 1e-4) -> np.ndarray:
    """Curvature radius of a curve over its parameter."""
    low, mid, high = points(phi - h), points(phi), points(phi + h)
    d1, d2 = (high - low) / (2.0 * h), (high - 2.0 * mid + low) / h**2
    return np.abs(d1) ** 3 / (np.conj(d1) * d2).imag


@pytest.mark.quick(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
@pytest.mark.parametrize("rocks", [False, True])
def test_a_flat_face_touches_its_cam_and_cuts_it_nowhere(sense: int, side: int, rocks: bool) -> None:
    follower = {
        "type": "oscillating-flat",
        "center_distance": 120,
        "side": side,
        "face_offset": 6,
        "pivot_direction": 20,
    }
    swing = [{**each, "lift": 0.4 * each["lift"]} if "lift" in each else each for each in SWING]
    design = cam(swing, follower, {"base_radius": 60, "sense": sense})
    if not rocks:
        design = cam(MOTION, {"type": "translating-flat", "direction": 70}, {"base_radius": 80, "sense": sense})
    flat = design.cams.flat
    phi = np.linspace(0.01, 6.27, 400)
    points, normals = flat.points(phi)
    # the face is a tangent: the contact moves along it
    slope = (flat.points(phi + 1e-6)[0] - flat.points(phi - 1e-6)[0]) / 2e-6
    assert np.abs((slope * np.conj(normals)).real).max() < 1e-6 * np.abs(slope).max()
    # no point of the cam lies beyond any face
    beyond = ((flat.points(CLOSE[::20])[0][:, None] - points[None, :]) * np.conj(normals)[None, :]).real
    assert beyond.max() < 1e-9
    measured = -sense * radius_by_differences(lambda each: flat.points(each)[0], phi)
    assert flat.touch(phi).radius == pytest.approx(measured, rel=2e-4, abs=1e-3)
    assert flat.min_curvature_radius.value == pytest.approx(flat.touch(CLOSE).radius.min(), rel=1e-5)


STEPS = {
    "down": [{"to": 120, "lift": 20, "law": "constant-velocity"}, {"to": 150}, {"to": 300, "lift": 0}, {"to": 360}],
    "up": [{"to": 120, "lift": 20}, {"to": 150}, {"to": 300, "lift": 0, "law": "constant-velocity"}, {"to": 360}],
    "none": [{"to": 120, "lift": 20}, {"to": 150}, {"to": 300, "lift": 0}, {"to": 360}],
}


@pytest.mark.quick(3)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("rocks", [False, True])
@pytest.mark.parametrize("course", STEPS)
def test_a_face_is_undercut_where_its_velocity_steps_down(course: str, rocks: bool, sense: int) -> None:
    """Against the half-planes of all faces: a body that each touches has its contact in every other.

    A rise at constant velocity begins with a step up and ends with one down, a return begins with one down; of two
    laws from rest to rest none is.
    """
    follower = {"type": "translating-flat"}
    if rocks:
        follower = {"type": "oscillating-flat", "center_distance": 120, "face_offset": 6}
    motion = [{**each, "lift": 0.5 * each["lift"]} if "lift" in each else each for each in STEPS[course]]
    design = cam(motion, follower, {"base_radius": 60, "sense": sense})
    phi = np.linspace(0.0, 2.0 * math.pi, 1_441)
    points, normals = design.cams.flat.points(phi)
    beyond = np.real(np.conj(normals)[None, :] * (points[:, None] - points[None, :])).max()
    (check,) = design.check("cam-undercut")
    assert (check.status, beyond > 1e-3) == (("pass", False) if course == "none" else ("fail", True))
    if course != "none":
        place = {"down": 120, "up": 150}[course]
        assert check.fix == f"remove the step of the lift's velocity at cam angle {place} deg"
        assert design.quantity("min_curvature_radius").value == 0.0


@pytest.mark.quick(1)
@pytest.mark.parametrize("radius", [50.0, 300.0, 2000.0])
def test_a_roller_cuts_where_its_velocity_steps_down_however_large_the_cam(radius: float) -> None:
    """Where the pitch curve turns by d, the roller behind cuts r (1 - cos d) off the profile before; straight branches,
    which those of a large cam are nearly: their bend changes it by r/R."""
    roller = 8.0
    design = cam(STEPS["down"], {"type": "translating-roller", "roller_radius": roller}, {"prime_radius": radius})
    (check,) = design.check("cam-undercut")
    assert (check.status, check.fix) == ("fail", "remove the step of the lift's velocity at cam angle 120 deg")
    turn = math.atan(20.0 / math.radians(120.0) / (radius + 20.0))
    assert design.cams.main.undercut.depth == pytest.approx(roller * (1.0 - math.cos(turn)), rel=1.5 * roller / radius)


def test_published_flat_cam() -> None:
    """A lift of one inch in 90 deg by the cycloidal law, minimum radius a quarter inch: base circle 1.893 in."""
    motion = [{"to": 90}, {"to": 180, "lift": 25.4, "law": "cycloidal"}, {"to": 270}]
    motion.append({"to": 360, "lift": 0, "law": "cycloidal"})
    design = cam(motion, {"type": "translating-flat"}, {"size": {"curvature_radius": 6.35}})
    assert design.base_radius == pytest.approx(48.0822, abs=0.0127)
    assert design.face_length == pytest.approx(64.77, abs=0.127)
    assert design.min_curvature_radius == pytest.approx(6.35, rel=1e-12)
    assert design.max_pressure_angle == 0.0


@pytest.mark.quick(3)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("limits", [30, [25, 45], [50, 20]])
@pytest.mark.parametrize("offset", [0, 7.5, "best"])
def test_a_sized_cam_lies_on_its_limit_and_no_smaller_one_keeps_it(sense: int, limits: Any, offset: Any) -> None:
    size = {"pressure_angle": limits, "curvature_radius": 1}
    design = cam(MOTION, {**ROLLER, "roller_radius": 1, "offset": offset}, {"size": size, "sense": sense})
    e, r = design.offset, design.prime_radius
    rise, back = limits if isinstance(limits, list) else (limits, limits)

    def excess(offset: float, radius: float) -> float:
        at = CLOSE[::2]  # off by 1e-5 deg at most from the extremes between its places
        s, s1 = design.cams.motion.evaluate(at, 1)
        alpha = np.degrees(np.abs(np.arctan2(sense * s1 - offset, math.sqrt(radius**2 - offset**2) + s)))
        limit = np.where(s1 > 1e-9, rise, np.where(s1 < -1e-9, back, max(rise, back)))
        return float(np.max(alpha - limit))

    assert excess(e, r) == pytest.approx(0.0, abs=1e-4)
    assert all(check.status == "pass" for check in design.check("pressure-angle"))
    assert excess(e, 0.999 * r) > 0.0
    if offset == "best":
        rng = np.random.default_rng(2)
        for _ in range(40):
            smaller = r * rng.uniform(0.9, 0.9995)
            assert excess(smaller * math.sin(rng.uniform(-1.4, 1.4)), smaller) > 0.0


@pytest.mark.quick(1)
@pytest.mark.parametrize("offset", [0.0, 6.0])
def test_the_curvature_of_a_sized_cam_is_its_limit(offset: float) -> None:
    size = {"pressure_angle": 60, "curvature_radius": 40}
    design = cam(MOTION, {**ROLLER, "offset": offset}, {"size": size})
    assert design.min_curvature_radius == pytest.approx(40.0, rel=1e-9)
    for share in (1.001, 1.1, 1.5):
        larger = cam(MOTION, {**ROLLER, "offset": offset}, {"prime_radius": share * design.prime_radius})
        assert larger.min_curvature_radius > 40.0


def test_the_cutter_of_a_flat_cam_touches_it_and_is_exported() -> None:
    """The table cutter was there, no file."""
    body = {"base_radius": 80, "cutter_radius": 30}
    design = cam(MOTION, {"type": "translating-flat"}, body)
    profile = design.cams.flat.points(CLOSE)[0]
    centers = design.making.cutter_points(CLOSE[::500])
    nearest = np.abs(profile[:, None] - centers[None, :]).min(axis=0)
    assert nearest == pytest.approx(np.full(nearest.size, 30.0), rel=1e-6)
    parts = follower_cam(design)
    assert list(parts) == ["main_cam", "cutter"]
    (first, *_) = parts["cutter"]().stretches
    theta = np.linspace(first.low, first.high, 9)
    assert first.points(theta)[0] == pytest.approx(design.making.cutter_points(theta), abs=1e-6)
    assert list(follower_cam(cam(MOTION, {"type": "translating-flat"}, {"base_radius": 80}))) == ["main_cam"]


@pytest.mark.quick(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_the_least_cam_of_a_rocker_by_a_search(sense: int, side: int) -> None:
    follower = {**ROCKER, "side": side}
    size = {"pressure_angle": 40, "curvature_radius": 1}
    design = cam(SWING, follower, {"sense": sense, "size": size})
    assert math.degrees(design.max_pressure_angle) == pytest.approx(40.0, abs=1e-9)
    smaller = cam(SWING, follower, {"sense": sense, "prime_radius": 0.999 * design.prime_radius})
    assert math.degrees(smaller.max_pressure_angle) > 40.0


@pytest.mark.slow
@pytest.mark.parametrize("sense", [1, -1])
def test_a_found_pivot_needs_the_smallest_cam(sense: int) -> None:
    free = {key: value for key, value in ROCKER.items() if key != "center_distance"}
    design = cam(SWING, free, {"sense": sense, "size": {"pressure_angle": 40, "curvature_radius": 1}})
    assert math.degrees(design.max_pressure_angle) == pytest.approx(40.0, abs=1e-8)
    for step in (-4.0, -0.5, 0.5, 4.0):
        there = {**free, "center_distance": design.center_distance + step}
        try:
            other = cam(SWING, there, {"sense": sense, "size": {"pressure_angle": 40, "curvature_radius": 1}})
            radius = other.prime_radius
        except NoSolution:
            continue
        assert math.degrees(other.max_pressure_angle) < 40.0 + 1e-9
        assert radius > design.prime_radius


@pytest.mark.slow
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("rise", "back"), [(35.0, 45.0), (45.0, 35.0), (25.0, 70.0)])
def test_a_found_pivot_keeps_a_limit_of_each_stroke(sense: int, rise: float, back: float) -> None:
    """By the law of cosines at every cam angle: no pivot with a smaller prime radius keeps both limits."""
    free = {key: value for key, value in ROCKER.items() if key != "center_distance"}
    design = cam(SWING, free, {"sense": sense, "size": {"pressure_angle": [rise, back], "curvature_radius": 1}})
    radius, arm = design.prime_radius, free["arm"]
    lift, rate = (value[::10] for value in design.cams.motion.evaluate(CLOSE, 1))
    limit = np.radians(np.where(rate > 1e-9, rise, np.where(rate < -1e-9, back, max(rise, back))))

    def excess(prime: float, distance: float) -> float:
        start = math.acos((arm**2 + distance**2 - prime**2) / (2.0 * arm * distance))
        across = distance * np.cos(start + lift) - arm * (1.0 + sense * rate)
        return float(np.max(np.abs(np.arctan2(across, distance * np.sin(start + lift))) - limit))

    assert excess(radius, design.center_distance) == pytest.approx(0.0, abs=1e-5)
    assert math.degrees(design.pressure_angle_rise) <= rise + 1e-9
    assert math.degrees(design.pressure_angle_return) <= back + 1e-9
    assert all(check.status == "pass" for check in design.check("pressure-angle"))
    for share in (0.5, 0.9, 0.999):
        for distance in np.linspace(arm - share * radius + 0.1, arm + share * radius - 0.1, 60):
            assert excess(share * radius, distance) > 0.0
    both = cam(SWING, free, {"sense": sense, "size": {"pressure_angle": min(rise, back), "curvature_radius": 1}})
    assert radius < 0.99 * both.prime_radius


def test_groove_and_cutter_stand_off_the_pitch_curve() -> None:
    design = cam(MOTION, ROLLER, {"prime_radius": 60, "cutter_radius": 30}, closure="groove")
    phi = CLOSE[::50]
    pitch, inner = design.cams.main.points(phi)
    outer, cutter = design.cams.outer_wall.points(phi)[1], design.making.cutter_points(phi)
    assert np.abs(outer - pitch) == pytest.approx(12.0, rel=1e-12)
    assert outer - pitch == pytest.approx(pitch - inner, abs=1e-12)
    assert np.abs(cutter - inner) == pytest.approx(30.0, rel=1e-12)
    assert design.max_radius == pytest.approx([78.0, 102.0], rel=1e-12)
    assert design.min_radius == pytest.approx([48.0, 72.0], rel=1e-12)
    # the minimum concave radius, where the profile bends inwards
    measured = radius_by_differences(lambda each: design.cams.main.points(each)[1], np.linspace(0.02, 6.26, 20_001))
    assert design.min_concave_radius == pytest.approx(measured[measured > 0.0].min(), rel=1e-3)


def test_radii_over_the_polar_angle_lie_on_the_profile() -> None:
    design = cam(MOTION, ROLLER, {"prime_radius": 60, "sense": -1})
    table = design.table("radius")
    rows = {name: np.array([row[k] for row in table.rows()]) for k, name in enumerate(table.columns)}
    points = design.cams.main.points(np.radians(rows["cam_angle"]))[1]
    assert np.abs(points) == pytest.approx(rows["radius"], rel=1e-12)
    assert np.mod(np.degrees(np.angle(points)) - rows["polar_angle"] + 180.0, 360.0) == pytest.approx(180.0, abs=1e-9)


def test_errors_of_the_profile_by_a_cam_made_so() -> None:
    """The roller of another radius on the same cam lifts by delta/cos alpha to first order."""
    errors = {"profile": 0.01, "run_out": 0.02, "key": 0.03, "roller_radius": 0.005, "waves": 40}
    design = cam(MOTION, ROLLER, {"prime_radius": 60}, errors=errors, speed=300)
    alpha = design.cams.main.pressure_angle(CLOSE)
    slope = design.cams.motion.evaluate(CLOSE, 1)[1]
    worst = 0.025 / np.cos(alpha) + np.abs(slope) * math.radians(0.03)
    assert design.lift_error_worst == pytest.approx(worst.max(), rel=1e-6)
    assert design.acceleration_error == pytest.approx((40 * 10.0 * math.pi) ** 2 * 0.01 / np.cos(alpha).min(), rel=1e-6)


@pytest.mark.parametrize(
    ("key", "follower", "body"),
    [
        ("cam.prime_radius", ROCKER, {"prime_radius": 300}),
        ("cam.size", ROCKER, {"size": {"pressure_angle": 3}}),
    ],
)
def test_cams_that_cannot_be_say_at_which_key(key: str, follower: dict[str, Any], body: dict[str, Any]) -> None:
    with pytest.raises(NoSolution) as refused:
        _ = cam(SWING, follower, body).prime_radius
    assert refused.value.key == key


@pytest.mark.slow
@pytest.mark.parametrize("swing", [170.0, 40.0])
def test_start_angles_of_a_rocker_by_trying_all(swing: float) -> None:
    """A fast stroke towards the cam's motion asks for more than any start angle gives: c cos(alpha) < -f."""
    segments = [Segment(to=60.0, lift=swing), Segment(to=360.0, lift=0.0)]
    motion, limit = motion_of(segments, unit=math.radians(1.0)), math.radians(40.0)
    rocker = size.Rocking(motion, 60.0, 70.0, 1, -1)
    phi, start = np.linspace(0.0, 2.0 * math.pi, 1441), np.linspace(0.005, math.pi - 0.005, 2001)
    s, s1 = motion.evaluate(phi, 1)
    psi = start[:, None] + s
    across = 70.0 * np.cos(psi) - 60.0 * (1.0 - s1)
    kept = (np.abs(across) <= math.tan(limit) * 70.0 * np.sin(psi)).all(axis=1) & (np.sin(psi) > 0.0).all(axis=1)
    if kept.any():
        low, high = rocker.start_angles((limit, limit, limit))
        assert (low, high) == pytest.approx((start[kept].min(), start[kept].max()), abs=4e-3)
    else:
        with pytest.raises(NoSolution):
            rocker.start_angles((limit, limit, limit))


@pytest.mark.parametrize(
    ("body", "key"), [({"prime_radius": 8}, "cam.prime_radius"), ({"size": {"pressure_angle": 85}}, "cam.size")]
)
def test_a_roller_that_reaches_over_the_axis_is_refused(body: dict[str, Any], key: str) -> None:
    small = {"type": "translating-roller", "roller_radius": 8}
    slow = [{"to": 180, "lift": 0.1}, {"to": 360, "lift": 0}]
    if "size" in body:
        body = {"size": {**body["size"], "curvature_radius": 0.1}}
    with pytest.raises(NoSolution, match="limit > 8 mm; roller_radius") as refused:
        _ = cam(slow, small, body).prime_radius
    assert refused.value.key == key


CONJUGATE = {
    "slide": ({"type": "translating-roller", "roller_radius": 15, "offset": 5}, {"radius": 25}),
    "best offset": ({"type": "translating-roller", "roller_radius": 15, "offset": "best"}, {"radius": 8}),
    "rocker": (
        {"type": "oscillating-roller", "roller_radius": 15, "arm": 100, "center_distance": 140},
        {"arm": 70, "angle": 100, "radius": 22},
    ),
    "rocker that its return roller decides": (
        {"type": "oscillating-roller", "roller_radius": 9, "arm": 100, "center_distance": 140, "side": -1},
        {"arm": 95, "angle": -75, "radius": 36},
    ),
    "pivot": ({"type": "oscillating-roller", "roller_radius": 15, "arm": 100}, {"arm": 70, "angle": 100, "radius": 22}),
}


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", list(CONJUGATE))
def test_a_conjugate_pair_is_sized_by_both_rollers(name: str) -> None:
    """Each cam keeps the pressure angle and 0.8 of its own curvature radius; one of them stands at a limit."""
    follower, back = CONJUGATE[name]
    motion = [{"to": 100, "lift": 16}, {"to": 180}, {"to": 280, "lift": 0, "law": "polynomial-345"}, {"to": 360}]
    body = {"size": {"pressure_angle": 32}}
    design = cam(motion, follower, body, closure="conjugate", return_roller=back)
    shares = []
    for one, radius in zip(design.profiles, (follower["roller_radius"], back["radius"]), strict=True):
        phi = np.linspace(0.0, 2.0 * math.pi, 4001)
        shares.append(math.degrees(float(np.abs(one.pressure_angle(phi)).max())) / 32.0)
        bend = float(one.curvature(phi).max())
        shares.append(radius * bend / 0.8)
    assert max(shares) <= 1.0 + 1e-6
    assert max(shares) >= 1.0 - 1e-3


def test_a_return_roller_a_turn_further_is_the_same() -> None:
    """285 deg are -75 deg."""
    follower, back = CONJUGATE["rocker that its return roller decides"]
    motion = [{"to": 100, "lift": 16}, {"to": 180}, {"to": 280, "lift": 0, "law": "polynomial-345"}, {"to": 360}]
    one, other = (
        cam(
            motion, follower, {"size": {"pressure_angle": 32}}, closure="conjugate", return_roller=back | turn
        ).cams.place
        for turn in ({}, {"angle": back["angle"] + 360.0})
    )
    assert other.radius == pytest.approx(one.radius, rel=1e-12)


def test_loads_know_where_segments_join() -> None:
    """The ends of the segments of the file: 0 and a whole turn are one place, at which a search begins anyway."""
    found = np.degrees(cam(SWING, ROLLER, {"prime_radius": 80}).moving.input.joints)
    assert (np.diff(found) > 0.0).all()
    for end in (12.5, 87.5, 100.0, 160.0, 280.0):  # two within the modified sine
        assert np.abs(found - end).min() < 1e-10


@pytest.mark.slow
@pytest.mark.parametrize(
    ("cam", "code", "key"),
    [
        ({"prime_radius": 25}, "GL401", "cam.prime_radius"),
        ({"prime_radius": 60, "shaft_radius": 52}, "GL302", "cam.prime_radius"),
    ],
)
def test_a_failing_cam_is_told_a_value_that_was_tried(cam: dict[str, float], code: str, key: str) -> None:
    motion = [{"to": 90, "lift": 18}, {"to": 170}, {"to": 270, "lift": 0}, {"to": 360}]
    follower = {"type": "translating-roller", "roller_radius": 9}
    data = {"kind": "disc-cam", "name": "x", "motion": motion, "follower": follower, "cam": cam}
    (check,) = [one for one in factory.design(data, command="cam").report("cam").checks if one.status == "fail"]
    assert (check.code, check.remedy[0][0]) == (code, key)
    changed = data | {"cam": cam | {key.removeprefix("cam."): check.remedy[0][1]}}
    assert all(one.status == "pass" for one in factory.design(changed, command="cam").report("cam").checks)


def test_segments_have_the_peaks_of_their_own_laws() -> None:
    """Closed forms: pi h/2b, pi^2 h/2b^2; 2h/b, 4h/b^2; 2h/b, 2 pi h/b^2. The other side of a joint is not counted."""
    parabola = {"scca": [0.0, 1.0, 0.0, 0.0]}
    motion = [
        {"to": 120, "lift": 50, "law": "simple-harmonic"},
        {"to": 150},
        {"to": 210, "lift": 20, "law": parabola},
        {"to": 300, "lift": 0, "law": "cycloidal"},
        {"to": 360},
    ]
    table = cam(motion, ROLLER, {"prime_radius": 100}, speed=100).table("segments")
    rows = [dict(zip(table.columns, row, strict=True)) for row in table.rows()]
    width = [math.radians(row["end"] - row["start"]) for row in rows]
    assert [row["lift"] for row in rows] == [50, 50, 20, 0, 0]
    expected = {
        "velocity_max": [math.pi * 25 / width[0], 0, 0, 0, 0],
        "velocity_min": [0, 0, -60 / width[2], -40 / width[3], 0],
        "acceleration_max": [math.pi**2 * 25 / width[0] ** 2, 0, 120 / width[2] ** 2, 40 * math.pi / width[3] ** 2, 0],
    }
    omega = 100 * math.pi / 30
    for name, values in expected.items():
        order = 1 if name.startswith("velocity") else 2
        assert [row[name] for row in rows] == pytest.approx(values, rel=1e-12, abs=1e-12)
        assert [row[f"follower_{name}"] for row in rows] == pytest.approx(
            [value * omega**order for value in values], rel=1e-12, abs=1e-10
        )


@pytest.mark.parametrize(("follower", "body"), [(ROLLER, {"prime_radius": 60}), (ROCKER, {"prime_radius": 70})])
def test_segments_together_have_the_extremes_of_the_turn(follower: dict[str, Any], body: dict[str, Any]) -> None:
    design = cam(SWING, follower, body)
    table = design.table("segments")
    rows = [dict(zip(table.columns, row, strict=True)) for row in table.rows()]
    assert "follower_velocity_max" not in table.columns
    for name, pick in (("velocity_max", max), ("velocity_min", min), ("acceleration_max", max)):
        assert pick(row[name] for row in rows) == pytest.approx(design.motion_extremes[name], rel=1e-12)


def test_a_table_of_points_has_no_segments() -> None:
    points = [[float(a), 10.0 * (1.0 - math.cos(math.radians(a)))] for a in range(0, 361, 10)]
    with pytest.raises(NoSolution, match="the table segments needs motion by segments"):
        cam({"table": points}, ROLLER, {"prime_radius": 60}).table("segments")


def test_a_rocking_face_as_fast_as_its_cam_is_refused() -> None:
    """10 deg in 20 deg of the cycloidal law: 1 + s' was 1e-17 and the contact 1e17 mm away, the largest radius 0."""
    motion = [{"to": 180, "lift": 10}, {"to": 280}, {"to": 300, "lift": 0, "law": "cycloidal"}, {"to": 360}]
    made = cam(motion, {"type": "oscillating-flat", "center_distance": 140}, {"base_radius": 60})
    with pytest.raises(NoSolution, match="the follower moves as fast as the cam, or faster") as refused:
        _ = made.raw("max_radius")
    assert refused.value.key == "motion"


# What a finding says is done, and it passes


def test_the_preload_of_the_advice_holds_the_follower_also_where_its_spring_would_lose_its_force() -> None:
    """Rate times lift at the lowest place: at exactly this preload the force is 0, and it lifts off at any speed."""
    motion = [{"to": 180, "lift": -5.7, "law": "cycloidal"}, {"to": 360, "lift": 0, "law": "cycloidal"}]
    follower = {"type": "translating-roller", "roller_radius": 8.8, "mass": 1.5}
    data = {"kind": "disc-cam", "speed": 95, "motion": motion, "follower": follower, "cam": {"prime_radius": 80}}

    def found(preload: float) -> Any:
        spring = {"preload": preload, "rate": 7.7}
        return next(iter(factory.design({**data, "spring": spring}, command="cam").check("lift-off")))

    advised = found(37.8).fix.split()
    assert advised[:3] == ["increase", "spring.preload", "to"]
    assert found(float(advised[3])).status == "pass"
    assert float(advised[3]) < 43.95


def test_a_face_that_ends_too_early_on_both_sides_is_lengthened_on_both() -> None:
    motion = [{"to": 90, "lift": 20, "law": "cycloidal"}, {"to": 270, "lift": 0, "law": "cycloidal"}, {"to": 360}]
    data = {"kind": "disc-cam", "motion": motion, "cam": {"base_radius": 60}}
    for follower in (
        {"type": "translating-flat", "face": [5, 5]},
        {"type": "oscillating-flat", "center_distance": 120, "face": [90, 95]},
    ):

        def check(face: Any, follower: Any = follower) -> Any:
            given = {**data, "follower": {**follower, "face": face}}
            if follower["type"] == "oscillating-flat":
                given["motion"] = [{**one, **({"lift": one["lift"] / 4} if "lift" in one else {})} for one in motion]
            return next(iter(factory.design(given, command="cam").check("face-length")))

        one = check(follower["face"])
        assert one.status == "fail"
        assert one.fix.startswith("set follower.face to [")
        assert check(json.loads(one.fix.removeprefix("set follower.face to "))).status == "pass"


def test_no_base_radius_beyond_the_centre_distance_of_a_rocking_face_is_advised() -> None:
    follower = {"type": "oscillating-flat", "center_distance": 140}
    motion = [{"to": 20, "lift": 8, "law": "mcv-20"}, {"to": 360, "lift": 0, "law": "mcv-20"}]
    data = {"kind": "disc-cam", "motion": motion, "follower": follower}
    (one,) = factory.design({**data, "cam": {"base_radius": 30}}, command="cam").check("cam-undercut")
    assert (one.status, one.fix) == ("fail", "give the motion more cam angle, or less lift")
    with pytest.raises(NoSolution, match=r"base_radius: 150 mm \(limit > 0 mm and < 140 mm") as refused:
        _ = factory.design({**data, "cam": {"base_radius": 150}}, command="cam").base_radius
    assert refused.value.fix == "set cam.base_radius between 0 mm and 140 mm"
