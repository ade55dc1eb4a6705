"""Gears and links with cams: the roller's place by geometry, derivatives by differences, pressure angle by forces.

Tolerances: differences of a step of 1e-4 rad are good to 1e-6 of the third derivative.
"""

from __future__ import annotations

import cmath
import math
from typing import Any

import numpy as np
import pytest
from factory import design
from scipy.special import ellipe

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.cam_drives.grooved import Groove, Path
from gearlink.core.parts.cams.output_motion import OutputMotion

GEAR: dict[str, Any] = {
    "kind": "cam-gear",
    "gears": {"module": 2.0, "sun": 20, "planet": 50},
    "lever": {"length": 40.0, "angle": 85.0},
    "roller_radius": 6.0,
    "motion": [{"to": 120.0}, {"to": 360.0, "output": 360.0, "law": "modified-sine"}],
}
LINKAGE: dict[str, Any] = {
    "kind": "cam-linkage",
    "links": {"input": 60.0, "coupler": 60.0, "follower": 80.0, "output": 50.0, "frame": 12.0},
    "phase": 150.0,
    "roller_radius": 8.0,
    "motion": [{"to": 60.0}, {"to": 360.0, "output": 360.0, "law": "polynomial-4567"}],
}
CAMS: dict[str, Any] = {
    "kind": "linked-cams",
    "path": {"harmonics": {"x": [[1, 20.0, 5.0], [3, 0.0, 2.0]], "y": [[2, 0.0, 12.0]]}},
    "cams": {"x": {"base_radius": 60.0, "roller_radius": 10.0}, "y": {"base_radius": 55.0, "roller_radius": 12.0}},
}
INSIDE = np.radians([7.0, 55.0, 130.0, 171.0, 222.0, 300.0, 349.0])


def roller_of_gears(found: Any, theta: float) -> complex:
    """By rolling: the planet turns against the carrier by what the sun lags behind, in the ratio of the teeth."""
    output = float(found.output_motion.evaluate(np.array([theta]), 0)[0][0])
    axis = cmath.rect(70.0, theta)
    turned = theta + (theta - output) * 20.0 / 50.0
    return axis + cmath.rect(40.0, math.radians(85.0) + turned)


def roller_of_links(found: Any, theta: float) -> complex:
    """By a cut of two circles, left of B to D."""
    output = float(found.output_motion.evaluate(np.array([theta]), 0)[0][0])
    b, d = cmath.rect(60.0, theta), 12.0 + cmath.rect(50.0, math.radians(150.0) + output)
    n = abs(d - b)
    along = (60.0**2 - 80.0**2 + n * n) / (2.0 * n)
    return b + (d - b) / n * complex(along, math.sqrt(60.0**2 - along**2))


@pytest.mark.parametrize(("data", "roller"), [(GEAR, roller_of_gears), (LINKAGE, roller_of_links)])
def test_path_and_its_derivatives(data: dict[str, Any], roller: Any) -> None:
    found, h = design(data), 1e-4
    path = found.path(INSIDE)
    assert path.place == pytest.approx(np.array([roller(found, t) for t in INSIDE]), abs=1e-10)
    there, back = found.path(INSIDE + h), found.path(INSIDE - h)
    assert (there.place - back.place) / (2.0 * h) == pytest.approx(path.first, abs=1e-4)
    assert (there.first - back.first) / (2.0 * h) == pytest.approx(path.second, abs=1e-3)
    bend = found.groove.curvature(INSIDE)
    a, b, c = back.place, path.place, there.place
    circle = 2.0 * ((b - a).conj() * (c - b)).imag / (np.abs(b - a) * np.abs(c - b) * np.abs(c - a))
    assert bend == pytest.approx(circle, abs=1e-6)
    contact = found.moving.at(INSIDE, 2).connections[-1]
    assert np.abs(contact.at - path.place).max() < 1e-12
    # the ground curve as the loads see it: off its tangent by half its curvature times the square of the way along
    way = there.place - path.place
    off = (np.conj(contact.normal) * way).real
    along = (np.conj(1j * contact.normal) * way).real
    assert off == pytest.approx(-0.5 * contact.curvature * along**2, rel=1e-2, abs=1e-8)


@pytest.mark.parametrize(("data", "on", "arm"), [(GEAR, "sun", 40.0), (LINKAGE, "output", 60.0)])
def test_pressure_angle_by_the_force_in_the_groove(data: dict[str, Any], on: str, arm: float) -> None:
    """The moment of the groove's force about the lever's axis is that force times cos(alpha) times the lever."""
    loads = design(data, command="loads", loads={"speed": 60.0, "forces": [{"on": on, "torque": -10.0}]})
    reactions = loads.machine.reactions(INSIDE)
    found = loads.design
    assert reactions.torque == pytest.approx(10.0 * found.output_motion.evaluate(INSIDE, 1)[1], abs=1e-9)
    links = loads.moving.at(INSIDE, 1).links
    link = links["planet" if on == "sun" else "coupler"]
    lever = found.path(INSIDE).place - link.origin.value
    moment = (np.conj(lever) * reactions.force("groove")).imag
    size = np.abs(reactions.unknowns["groove"][0])
    assert np.abs(moment) == pytest.approx(size * arm * np.cos(found.groove.pressure_angle(INSIDE)), rel=1e-9)
    if on == "sun":
        assert np.abs(moment) == pytest.approx(np.full(INSIDE.size, 10_000.0 * 50.0 / 20.0), rel=1e-9)
        x, first = (each for each in found.lever(INSIDE, 1))
        tangent = (70.0 * np.cos(x) + 40.0 * (1.0 + first)) / (70.0 * np.sin(x))
        assert np.tan(found.groove.pressure_angle(INSIDE)) == pytest.approx(tangent, rel=1e-10)


@pytest.mark.parametrize("turns", [1.0, -1.0])
def test_a_groove_has_its_inside_whichever_way_it_is_run(turns: float) -> None:
    """An ellipse: the walls enclose less and more than the path, and the curvature is positive where it is convex."""

    def path(theta: Any) -> Path:
        wave = [
            np.array([30.0, 20.0j])[:, None] * np.array([np.cos(turns * theta + k), np.sin(turns * theta + k)])
            for k in (0.0, 0.5 * math.pi, math.pi)
        ]
        place, first, second = (each.sum(axis=0) for each in wave)
        return Path(place, turns * first, second, np.ones_like(place))

    def enclosed(place: Any) -> float:
        return abs(float(np.sum((np.conj(place) * np.roll(place, -1)).imag))) / 2.0

    groove, theta = Groove(path, 4.0), np.linspace(0.0, 2.0 * math.pi, 4000, endpoint=False)
    inner, outer = map(enclosed, groove.walls(theta))
    middle, around = math.pi * 600.0, 8.0 * 30.0 * float(ellipe(1.0 - (20.0 / 30.0) ** 2)) / 2.0
    assert inner == pytest.approx(middle - 4.0 * around + 16.0 * math.pi, rel=1e-5)
    assert outer == pytest.approx(middle + 4.0 * around + 16.0 * math.pi, rel=1e-5)
    assert groove.curvature(np.zeros(1))[0] == pytest.approx(30.0 / 20.0**2, rel=1e-12)


def test_extremes_are_those_of_fine_rows() -> None:
    found = design(GEAR)
    theta = np.radians(np.linspace(0.0, 360.0, 36_001))[:-1]
    radius = found.groove.radius(theta)
    assert found.max_pressure_angle == pytest.approx(np.abs(found.groove.pressure_angle(theta)).max(), rel=1e-6)
    assert [found.min_radius, found.max_radius] == pytest.approx([radius.min(), radius.max()], rel=1e-7)
    assert found.min_curvature_radius == pytest.approx(1.0 / found.groove.curvature(theta).max(), rel=1e-5)
    assert found.lever_swing == pytest.approx(np.ptp(found.lever(theta, 0)[0]), rel=1e-7)
    inner, outer = found.groove.walls(theta)
    np.testing.assert_allclose(np.abs(inner - outer), 12.0, rtol=1e-12, atol=0.0)
    assert np.all(np.abs(inner) < np.abs(outer))
    table = found.table("main_cam", samples=36)
    assert table["pitch_x"] + 1j * table["pitch_y"] == pytest.approx(
        0.5 * (table["inner_x"] + table["outer_x"] + 1j * (table["inner_y"] + table["outer_y"])), abs=1e-10
    )


def test_output_through_points_runs_on_evenly_but_for_its_correction() -> None:
    rows = [[float(a), a + 3.0 * math.sin(math.radians(2.0 * a))] for a in range(0, 361, 15)]
    motion = OutputMotion(design(GEAR, motion={"table": rows}).spec.motion)
    theta = np.radians(np.linspace(0.0, 720.0, 97))
    value, speed, _ = motion.evaluate(theta, 2)
    wanted = theta + math.radians(3.0) * np.sin(2.0 * theta)
    assert value == pytest.approx(wanted, abs=1e-6)
    assert speed == pytest.approx(1.0 + math.radians(6.0) * np.cos(2.0 * theta), abs=1e-5)
    back = OutputMotion(design(GEAR, motion=[{"to": 180.0, "output": 20.0}, {"to": 360.0, "output": 0.0}]).spec.motion)
    assert back.gained == pytest.approx(0.0, abs=1e-15)


def test_cross_slide_follows_its_path() -> None:
    """Each cam's contour touches its roller; tan(alpha) = s'/(r_0 + s); the springless loads keep the power."""
    found = design(CAMS)
    theta = np.linspace(0.0, 6.2, 40)
    for axis, cam in enumerate(found.cams):
        place, first, _ = found.coordinate(axis, theta, 2)
        height = cam.path(theta, 1).position / (1.0, 1j)[axis]
        assert height.real == pytest.approx((60.0, 55.0)[axis] + place - found.lowest[axis], rel=1e-13)
        assert np.abs(np.tan(cam.pressure_angle(theta))) == pytest.approx(np.abs(first / height.real), abs=1e-12)
    assert found.stroke[1] == pytest.approx(24.0, rel=1e-12)
    fine = np.linspace(0.0, 6.3, 20_001)
    assert found.lowest[0] == pytest.approx(found.coordinate(0, fine, 0)[0].min(), abs=1e-6)
    loads = design(CAMS, command="loads", loads={"speed": 60.0, "links": {"table": {"mass": 2.0}}})
    assert loads.power_identity < 1e-9
    points = [[float(a), *(float(c[0]) for c in (found.coordinate(k, np.radians([a % 360.0]), 0)[0] for k in (0, 1)))]
              for a in range(0, 361, 10)]  # fmt: skip
    splined = design(CAMS, path={"points": points})
    assert splined.max_pressure_angle == pytest.approx(found.max_pressure_angle, abs=1e-4)


def test_checks_on_both_sides_of_their_limits() -> None:
    assert {each.status for each in design(GEAR).report("analyze").checks} == {"pass"}
    for data, keys, name, status in (
        (GEAR, {"limits": {"pressure_angle": 43.0}}, "pressure-angle", "fail"),
        (GEAR, {"roller_radius": 49.0}, "cam-undercut", "fail"),
        (GEAR, {"roller_radius": 40.0}, "cam-undercut", "warn"),
        (LINKAGE, {"limits": {"pressure_angle": 20.0}}, "pressure-angle", "fail"),
        (CAMS, {"limits": {"pressure_angle": 20.0}}, "pressure-angle", "fail"),
        (CAMS, {"cams__y__roller_radius": 50.0}, "cam-undercut", "fail"),
    ):
        made = design(data, **keys)
        made.advises = False  # the verdict is asked for, not what would help
        assert status in [each.status for each in made.check(name)], (name, keys)


def test_refusals() -> None:
    for data, keys, key in (
        (GEAR, {"lever": {"length": 40.0, "angle": 130.0}}, "lever.angle"),
        (GEAR, {"gears": {"module": 2.0, "sun": 60, "planet": 20}}, "lever.angle"),
        (LINKAGE, {"links__coupler": 20.0}, "links"),
        (LINKAGE, {"phase": 90.0, "links__frame": 0.0, "links__follower": 120.0}, "links"),
    ):
        with pytest.raises(NoSolution) as refused:
            design(data, **keys).report("analyze")
        assert refused.value.key == key
    for data, keys, words in (
        (GEAR, {"motion": [{"to": 360.0, "output": 90.0}]}, "whole revolutions"),
        (GEAR, {"motion": [{"to": 300.0, "output": 360.0}]}, "required 360 deg"),
        (GEAR, {"motion": [{"to": 200.0}, {"to": 100.0}, {"to": 360.0, "output": 360.0}]}, "ascend"),
        (CAMS, {"path": {}}, "harmonics"),
        (CAMS, {"path": {"harmonics": {"x": [[0.5, 1.0, 0.0]], "y": [[1, 1.0, 0.0]]}}}, "whole number"),
    ):
        with pytest.raises(ValueError, match=words):
            design(data, **keys)


@pytest.mark.parametrize(
    ("links", "phase", "law"),
    [
        ({"input": 60.0, "coupler": 62.0, "follower": 45.0, "output": 21.0, "frame": 0.0}, 230.0, "modified-sine"),
        ({"input": 60.0, "coupler": 60.0, "follower": 80.0, "output": 50.0, "frame": 12.0}, 150.0, "cycloidal"),
    ],
)
def test_transmission_angle_of_follower_and_output(links: dict[str, float], phase: float, law: str) -> None:
    """The angle of the triangle C-D-E by its sides, C by a cut of two circles; 0 where the sides come into line."""
    motion = [{"to": 20.0}, {"to": 360.0, "output": 360.0, "law": law}]
    found = design(LINKAGE, links=links, phase=phase, motion=motion)
    theta = np.radians(np.linspace(0.0, 360.0, 20_001))
    output = found.output_motion.evaluate(theta, 0)[0]
    b = links["input"] * np.exp(1j * theta)
    d = links["frame"] + links["output"] * np.exp(1j * (math.radians(phase) + output))
    n = np.abs(d - b)
    along = (links["coupler"] ** 2 - links["follower"] ** 2 + n * n) / (2.0 * n)
    c = b + (d - b) / n * (along + 1j * np.sqrt(links["coupler"] ** 2 - along**2))
    sides = np.abs(c - links["frame"]), links["follower"], links["output"]
    cosine = (sides[1] ** 2 + sides[2] ** 2 - sides[0] ** 2) / (2.0 * sides[1] * sides[2])
    wanted = math.acos(np.max(np.abs(cosine)))
    assert found.min_transmission_angle == pytest.approx(wanted, rel=0.0, abs=2e-3 if wanted < 0.1 else 1e-6)
    (check,) = found.check("transmission-angle")
    assert check.status == ("pass" if wanted > math.radians(35.0) else "fail")
    assert (found.min_transmission_angle == 0.0) == (wanted < 0.01)
