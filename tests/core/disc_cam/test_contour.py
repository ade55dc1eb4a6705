"""Cams of arcs against outlines on which a follower is let down, formulas of textbooks, and roots with 30 digits."""

from __future__ import annotations

import itertools
import math
import random
import re
from typing import Any

import factory
import mpmath
import numpy as np
import pytest
from pydantic import TypeAdapter, ValidationError

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.contour import Contour, Rocker, contour, contour_motion
from gearlink.core.parts.cams.contour_spec import CamProfile

TANGENT = {"type": "tangent", "base_radius": 30, "lift": 17.5, "action_angle": 150}
ARCS = {"type": "circular-arc", "base_radius": 30, "nose_radius": 5, "lift": 20, "action_angle": 150}
HOLLOW = {"type": "circular-arc", "base_radius": 30, "nose_radius": 10, "lift": 15, "flank_radius": -150}
DISC = {"type": "eccentric", "radius": 37.5, "eccentricity": 25}
STANDING = {**ARCS, "dwell_angle": 30}
ROLLER = {"type": "translating-roller", "roller_radius": 17.5}
READ: Any = TypeAdapter(CamProfile)


def cam(profile: dict[str, Any], follower: dict[str, Any], command: str = "cam", **keys: Any) -> Any:
    data = {"kind": "disc-cam", "name": "arcs", "speed": 600, "profile": profile, "follower": follower}
    return factory.design({**data, **keys}, command=command)


def sizes(**given: Any) -> Contour:
    return contour(READ.validate_python(given))


def outline(found: Contour, count: int = 40_000) -> np.ndarray:
    """The profile by the centres of its arcs, its middle on +x: where its rays meet them, the farthest of all."""
    all_rays = np.exp(1j * np.linspace(-math.pi, math.pi, count, endpoint=False))
    if found.flank is None:
        along = all_rays.real * found.distance
        return all_rays * (along + np.sqrt(found.nose**2 - found.distance**2 + along**2))
    outer = np.abs(np.angle(all_rays)) <= 0.5 * found.dwell
    reach = np.where(outer, found.distance + found.nose, found.base)
    for side in (1.0, -1.0):
        ray = all_rays * np.exp(-0.5j * side * found.dwell)
        lobe = one_side(found, ray, side)
        reach = np.where(side * np.angle(ray) >= 0.0, np.maximum(reach, lobe), reach)
    return all_rays * reach


def one_side(found: Contour, ray: np.ndarray, side: float) -> np.ndarray:
    """Radii of nose and flank of one side, the nose on +x."""

    def leaving(center: complex, radius: float) -> np.ndarray:
        along = (ray * np.conj(center)).real
        square = radius**2 - abs(center) ** 2 + along**2
        return np.where(square > 0.0, along + np.sqrt(np.maximum(square, 0.0)), -np.inf)

    assert found.flank is not None
    reach = np.maximum(found.base, leaving(complex(found.distance), found.nose))
    start = np.exp(1j * side * found.ascent)  # where this flank leaves the base circle
    center = -(found.flank - found.base) * start
    if math.isinf(found.flank):
        ends = found.base * start, complex(found.distance) + found.nose * start
        normal = start
        reach_of = found.base / np.where((ray * np.conj(normal)).real > 0.0, (ray * np.conj(normal)).real, np.nan)
    else:
        way = (found.distance - center) * math.copysign(1.0, found.flank)
        ends = found.base * start, complex(found.distance) + found.nose * way / abs(way)
        along = (ray * np.conj(center)).real
        square = np.maximum(found.flank**2 - abs(center) ** 2 + along**2, 0.0)
        reach_of = along + math.copysign(1.0, found.flank) * np.sqrt(square)
    low, high = sorted(np.angle(end) for end in ends)
    inside = (np.angle(ray) >= low) & (np.angle(ray) <= high)
    return np.where(inside, reach_of, reach)


def ahead_of(found: Contour, follower: dict[str, Any]) -> float:
    """Angle at the cam axis from the pivot to the centre of a rocker's roller at lift 0, by the cosine rule [rad]."""
    a, b, prime = follower["arm"], follower["center_distance"], found.base + follower.get("roller_radius", 0.0)
    return math.acos((b * b + prime * prime - a * a) / (2.0 * b * prime))


def rocked(points: np.ndarray, phi: float, sense: int, found: Contour, follower: dict[str, Any]) -> float:
    """Angle of an arm, its pivot on +x, that is let down on the outline at a cam angle [rad]."""
    a, b, side = follower["arm"], follower["center_distance"], follower["side"]
    reach = follower.get("roller_radius", 0.0)
    first = side * ahead_of(found, follower) - sense * 0.5 * found.whole
    z = points * np.exp(1j * (first + sense * phi))
    away, turned = np.abs(b - z), side * np.angle((b - z) / b)
    if not reach:  # an edge stands where the outline crosses the circle of the arm
        turned = -turned
        ahead = np.roll(np.arange(z.size), -1)
        cut = (away <= a) != (away[ahead] <= a)
        share = (a - away[cut]) / (away[ahead][cut] - away[cut])
        return float(np.max(turned[cut] + share * (turned[ahead][cut] - turned[cut])))
    near = np.abs(away - a) < reach
    cosine = (a * a + away[near] ** 2 - reach * reach) / (2.0 * a * away[near])
    return float(np.max(np.arccos(cosine) - turned[near]))


def let_down(points: np.ndarray, phi: float, sense: int, found: Contour, follower: dict[str, Any]) -> float:
    """Height of a follower that travels along +y, or angle of a rocker, that stands on the outline at a cam angle."""
    if "arm" in follower:
        return rocked(points, phi, sense, found, follower)
    e = sense * follower.get("offset", 0.0)
    if follower["type"].endswith("flat"):
        lead = 0.0
    else:
        prime = found.base + follower.get("roller_radius", 0.0)
        lead = math.asin(e / prime)
    # at cam angle 0 the flank begins below the follower; a cam that turns clockwise is the mirror image
    z = points * np.exp(-1j * (0.5 * found.whole + lead - phi)) * 1j
    if follower["type"].endswith("flat"):
        return float(z.imag.max())
    z = z - e
    if follower["type"].endswith("edge"):
        ahead = np.roll(z, -1)
        cut = (z.real <= 0.0) != (ahead.real <= 0.0)
        share = z.real[cut] / (z.real[cut] - ahead.real[cut])
        return float((z.imag[cut] + share * (ahead.imag[cut] - z.imag[cut])).max())
    near = z[np.abs(z.real) < follower["roller_radius"]]
    return float((near.imag + np.sqrt(follower["roller_radius"] ** 2 - near.real**2)).max())


EDGE = {"type": "translating-knife-edge", "offset": 4.0}
FLAT = {"type": "translating-flat"}
ROCKER = {"type": "oscillating-roller", "roller_radius": 17.5, "arm": 95.0, "center_distance": 120.0, "side": 1}
ROCKING_EDGE = {"type": "oscillating-knife-edge", "arm": 90.0, "center_distance": 110.0, "side": 1}
PAIRS = [
    (TANGENT, {**ROLLER, "offset": 5.0}),
    (ARCS, FLAT),
    (ARCS, {**ROLLER, "offset": -6.0}),
    (HOLLOW, ROLLER),
    (DISC, FLAT),
    (DISC, {**ROLLER, "offset": 3.0}),
    (TANGENT, EDGE),
    (HOLLOW, {**EDGE, "offset": -3.0}),
    (STANDING, {**ROLLER, "offset": 4.0}),
    (STANDING, FLAT),
    ({**HOLLOW, "dwell_angle": 40}, EDGE),
    (TANGENT, ROCKER),
    (ARCS, {**ROCKER, "side": -1}),
    (HOLLOW, {**ROCKER, "arm": 140.0, "center_distance": 110.0}),
    (DISC, ROCKER),
    (STANDING, {**ROCKER, "side": -1}),
    ({**TANGENT, "dwell_angle": 25}, {**ROCKING_EDGE, "side": -1}),
    (HOLLOW, ROCKING_EDGE),
]


@pytest.mark.quick(2)
@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize(("profile", "follower"), PAIRS)
def test_the_lift_is_that_of_a_follower_that_is_let_down_on_the_outline(
    profile: dict[str, Any], follower: dict[str, Any], sense: int
) -> None:
    """The chords of 40,000 points are 75 mm (2 pi/40,000)^2/8 = 2e-7 mm off a curve, more at the ends of the arcs."""
    design = cam(profile, follower, cam={"sense": sense})
    found, points = design.contour, outline(design.contour)
    start = let_down(points, 0.0, sense, found, follower)
    for degrees in (*range(3, 360, 12), 359):
        phi = math.radians(degrees)
        lift = float(design.cams.motion.evaluate(np.array([phi]), 0)[0][0])
        assert lift == pytest.approx(let_down(points, phi, sense, found, follower) - start, abs=1e-5), degrees


@pytest.mark.quick(6)
@pytest.mark.parametrize(("profile", "follower"), PAIRS)
def test_the_profile_of_the_motion_is_the_outline(profile: dict[str, Any], follower: dict[str, Any]) -> None:
    design = cam(profile, follower)
    table, found = design.table("main_cam", samples=3600), design.contour
    z = table["x"] + 1j * table["y"]
    flat = follower["type"].endswith("flat")
    prime = found.base + follower.get("roller_radius", 0.0)
    lead = 0.0 if flat else math.asin(follower.get("offset", 0.0) / prime)
    start = follower["side"] * ahead_of(found, follower) if "arm" in follower else 0.5 * math.pi - lead
    nose = np.exp(1j * (start - 0.5 * found.whole))
    wanted = outline(found)
    radius = np.interp(np.angle(z / nose), np.angle(wanted), np.abs(wanted), period=2.0 * math.pi)
    assert np.abs(z) == pytest.approx(radius, abs=1e-5)


class Place:
    """Height of a follower on an arc about a centre, or on a line with a normal, by the root of its distance."""

    def __init__(self, follower: dict[str, Any], arc: tuple[Any, Any, Any], near: float, start: Any) -> None:
        self.flat, self.near = follower["type"].endswith("flat"), near
        self.reach, self.e = follower.get("roller_radius", 0.0), follower.get("offset", 0.0)
        self.normal, self.center, self.radius = arc
        self.follower, self.start = follower, start

    def __call__(self, phi: Any) -> Any:
        if "arm" in self.follower:  # the cam turns counter-clockwise: its mirror image has the other side
            a, b, side = self.follower["arm"], self.follower["center_distance"], -self.follower["side"]
            pivot = mpmath.expj(phi - side * self.start)
            return mpmath.findroot(lambda psi: self.off(pivot * (b - a * mpmath.expj(-side * psi))), self.near)
        if self.flat:
            return mpmath.re(self.center * mpmath.expj(-phi)) + self.radius
        return mpmath.findroot(lambda y: self.off(mpmath.expj(phi) * (y + 1j * self.e)), self.near)

    def off(self, z: Any) -> Any:
        if self.center is None:
            return mpmath.re(z / self.normal) - self.radius - self.reach
        return abs(z - self.center) - abs(self.radius + self.reach)


def arc_of(found: Contour, lead: Any, name: str, behind: bool) -> tuple[Any, Any, Any]:
    """Normal and distance of a straight flank, or centre and radius."""
    if name == "nose" or found.flank is None:
        turned = found.dwell if behind else 0
        return None, found.distance * mpmath.expj(found.ascent + lead + turned), found.nose
    normal = mpmath.expj(lead + (found.whole if behind else 0))
    if math.isinf(found.flank):
        return normal, None, found.base
    return None, (found.base - found.flank) * normal, found.flank


@pytest.mark.quick(1)
@pytest.mark.parametrize(("profile", "follower"), PAIRS)
def test_derivatives_are_those_of_the_place_by_30_digits(profile: dict[str, Any], follower: dict[str, Any]) -> None:
    """The place is the root of a distance from the centre of the arc, or from the line, found for each cam angle."""
    design = cam(profile, follower)
    motion, found = design.cams.motion, design.contour
    flat = follower["type"].endswith("flat")
    rocks = "arm" in follower
    start = found.base if flat else design.cams.place.start if rocks else design.cams.start_height
    with mpmath.workdps(30):
        prime = found.base + follower.get("roller_radius", 0.0)
        ahead = _ahead(prime, follower) if rocks else 0
        lead = 0 if flat or rocks else mpmath.asin(mpmath.mpf(follower.get("offset", 0.0)) / prime)
        for piece in motion.pieces:
            if piece.name == "dwell":
                continue
            arc = arc_of(found, lead, piece.name, 0.5 * (piece.start + piece.end) > 0.5 * found.whole)
            for share in (0.1, 0.6, 0.93):
                phi = piece.start + share * piece.width
                values = [float(each[0]) for each in motion.evaluate(np.array([phi]), 3)]
                place = Place(follower, arc, values[0] + start, ahead)
                assert float(place(mpmath.mpf(phi))) == pytest.approx(values[0] + start, rel=1e-12)
                for order in (1, 2, 3):
                    wanted = float(mpmath.diff(place, mpmath.mpf(phi), order))
                    assert values[order] == pytest.approx(wanted, rel=1e-9, abs=1e-9), (piece.name, order)


def _ahead(prime: float, follower: dict[str, Any]) -> Any:
    """As `ahead_of`, with 30 digits."""
    a, b = mpmath.mpf(follower["arm"]), mpmath.mpf(follower["center_distance"])
    return mpmath.acos((b * b + prime * prime - a * a) / (2 * b * prime))


def test_a_tangent_cam_has_the_formulas_of_the_textbook() -> None:
    """Khurmi and Gupta: x, v and a on the flank, the nose as a slider-crank with l = r_3 + r_2 and r = OQ."""
    design = cam(TANGENT, ROLLER)
    motion, found = design.cams.motion, design.contour
    whole, phi = 47.5, np.radians(np.array([0.5, 10.0, 25.0]))
    x, v, a = motion.evaluate(phi, 2)
    assert x == pytest.approx(whole * (1.0 - np.cos(phi)) / np.cos(phi), rel=1e-11)
    assert v == pytest.approx(whole * np.sin(phi) / np.cos(phi) ** 2, rel=1e-12)
    assert a == pytest.approx(whole * (2.0 - np.cos(phi) ** 2) / np.cos(phi) ** 3, rel=1e-12)
    r, rod = found.distance, found.nose + 17.5
    angle = np.radians(np.array([27.0, 50.0, 75.0, 110.0])) - found.ascent
    x, _, a = motion.evaluate(angle + found.ascent, 2)
    n = rod / r
    root = n**2 - np.sin(angle) ** 2
    assert x == pytest.approx(r * np.cos(angle) + r * np.sqrt(root) - whole, rel=1e-11)
    bend = (np.cos(2.0 * angle) * n**2 + np.sin(angle) ** 4) / root**1.5
    assert -a == pytest.approx(r * (np.cos(angle) + bend), rel=1e-11)


def test_velocity_and_acceleration_stand_on_both_sides_of_each_change_of_contact() -> None:
    design = cam(TANGENT, ROLLER)
    table = design.table("arcs")
    assert list(table["arc"]) == ["flank", "nose", "nose", "flank", "base circle"]
    speed = 20.0 * math.pi
    cosine = math.cos(math.atan2(design.contour.distance * math.sin(design.contour.ascent), 47.5))
    joint = 47.5 * (2.0 - cosine**2) / cosine**3 * speed**2
    apex = -design.contour.distance * (1.0 + design.contour.distance / (design.contour.nose + 17.5)) * speed**2
    assert table["follower_acceleration_start"][0] == pytest.approx(47.5 * speed**2, rel=1e-12)
    assert table["follower_acceleration_end"][0] == pytest.approx(joint, rel=1e-12)
    assert table["follower_acceleration_end"][1] == pytest.approx(apex, rel=1e-12)
    for name in ("velocity", "acceleration"):
        mirrored = table[f"{name}_end"][3] * (-1.0 if name == "velocity" else 1.0)
        assert mirrored == pytest.approx(table[f"{name}_start"][0], abs=1e-12)
    steps = dict(design.cams.motion.steps(2))
    assert max(steps.values()) == pytest.approx(table["acceleration_start"][3] - table["acceleration_end"][2], rel=1e-9)
    assert design.raw("follower_acceleration_max") == pytest.approx(joint, rel=1e-12)
    assert design.raw("follower_acceleration_min") == pytest.approx(apex, rel=1e-12)
    (step,) = design.check("acceleration-step")
    assert (step.status, "profile" in step.advice) == ("warn", True)
    assert "velocity_start" not in cam(TANGENT, ROLLER, speed=None).table("arcs").columns[9:]


def drawn(seed: int) -> tuple[float, dict[str, float]]:
    """A random lobe with concave, straight or convex flanks by its triangle: base radius, all its other sizes."""
    dice = random.Random(seed)
    base, kind = dice.uniform(20.0, 40.0), seed % 3
    nose, distance = base * dice.uniform(0.2, 0.9), base * dice.uniform(0.9, 1.6)
    found = {"nose_radius": nose, "nose_distance": distance, "lift": distance + nose - base}
    straight = math.degrees(math.acos((base - nose) / distance))
    if kind == 0:
        return base, {**found, "action_angle": 2.0 * straight}
    flank = dice.uniform(2.0, 6.0) * base if kind == 1 else -dice.uniform(3.0, 8.0) * base
    # law of cosines with the signed sides
    p, q = flank - base, flank - nose
    ascent = math.degrees(math.acos((q * q - p * p - distance**2) / (2.0 * p * distance)))
    found |= {"flank_radius": flank, "action_angle": 2.0 * ascent}
    if kind == 1:
        found["flank_angle"] = math.degrees(math.acos((p * p + q * q - distance**2) / (2.0 * p * q)))
    return base, found


@pytest.mark.quick(9)
@pytest.mark.parametrize("seed", range(60))
def test_the_sizes_follow_from_any_of_them_that_are_enough(seed: int) -> None:
    base, every = drawn(seed)
    count, name = (2, "tangent") if seed % 3 == 0 else (3, "circular-arc")
    tried = 0
    for chosen in itertools.combinations(every, count):
        if {"nose_radius", "nose_distance", "lift"} <= set(chosen):
            continue  # they say the same twice
        if "flank_angle" in chosen and "action_angle" not in chosen:
            continue
        given = {"type": name, "base_radius": base, **{each: every[each] for each in chosen}}
        if seed % 3 == 2 and set(chosen) == {"nose_radius", "flank_radius", "action_angle"}:
            with pytest.raises(NoSolution, match="two noses"):
                sizes(**given)
            continue
        found = sizes(**given)
        wanted = every["nose_radius"], every["nose_distance"], math.radians(0.5 * every["action_angle"])
        assert (found.nose, found.distance, found.ascent) == pytest.approx(wanted, rel=1e-8), chosen
        assert found.flank == pytest.approx(every.get("flank_radius", math.inf), rel=1e-7), chosen
        tried += 1
    assert tried >= {2: 5, 3: 8}[count]


def test_flanks_touch_base_circle_and_nose() -> None:
    for profile in (ARCS, HOLLOW):
        found = contour(READ.validate_python(profile))
        assert found.flank is not None
        side = math.copysign(1.0, found.flank)
        assert side * abs(found.flank_center) == pytest.approx(found.flank - found.base, rel=1e-12)
        assert side * abs(found.nose_center - found.flank_center) == pytest.approx(found.flank - found.nose, rel=1e-12)


def test_a_disc_lifts_its_follower_off_at_the_speed_of_the_equilibrium() -> None:
    """At the highest place the spring and the weight of 2.3 kg give (45 + 3.5 50 + 2.3 9.81) N = m e w^2."""
    follower = {**FLAT, "mass": 2.3}
    design = cam(DISC, follower, spring={"preload": 45, "rate": 3.5}, loads={"gravity": [0, -9.81]})
    force = 45.0 + 3.5 * 50.0 + 2.3 * 9.81
    assert design.lift_off_speed == pytest.approx(math.sqrt(force / (2.3 * 0.025)) * 30.0 / math.pi, rel=1e-12)
    phi = np.radians(np.arange(0.0, 360.0, 17.0))
    assert design.cams.motion.evaluate(phi, 0)[0] == pytest.approx(25.0 * (1.0 - np.cos(phi)), abs=1e-13)


def test_everything_of_a_cam_follows_from_its_arcs() -> None:
    body = {"shaft_radius": 12, "cutter_radius": 40}
    design = cam(HOLLOW, {**ROLLER, "mass": 0.5}, cam=body, spring={"least_force": 20, "rate": 12}, servo={"rows": 73})
    assert design.min_concave_radius == pytest.approx(150.0, rel=1e-9)
    assert (design.base_radius, design.prime_radius) == (30.0, 47.5)
    assert design.min_curvature_radius == pytest.approx(27.5, rel=1e-9)  # that of the nose and the roller
    assert design.max_radius == pytest.approx(45.0, rel=1e-12)
    assert design.flank_radius == -150.0
    for name in ("arcs", "segments", "main_cam", "cutter", "radius", "servo"):
        assert design.table(name).length > 0
    radii = design.table("main_cam", samples=720)["curvature_radius"]
    for wanted in (27.5, -132.5, 47.5):
        assert (np.abs(radii / wanted - 1.0) < 1e-9).sum() > 10
    for name in design.outline("cam").checks:
        assert {check.status for check in design.check(name)} <= {"pass", "warn", "fail"}, name


@pytest.mark.parametrize(
    ("profile", "follower", "words"),
    [
        (TANGENT, FLAT, "a flat face needs convex flanks, these are straight"),
        (HOLLOW, FLAT, r"concave \(-150 mm\)"),
        ({**HOLLOW, "flank_radius": -17}, ROLLER, r"roller_radius: 17.5 mm \(limit < 17 mm"),
        ({**TANGENT, "lift": 200}, ROLLER, r"nose_radius of the profile: -39.\d+ mm \(limit > 0 mm\)"),
        ({"type": "tangent", "base_radius": 30, "nose_radius": 45, "lift": 10}, ROLLER, "no straight flank joins"),
        ({"type": "tangent", "base_radius": 30, "nose_radius": 10, "action_angle": 190}, ROLLER, "no straight flank"),
        ({**ARCS, "lift": 20, "flank_radius": 31, "action_angle": None}, FLAT, "no flank of 31 mm joins"),
    ],
)
def test_what_cannot_be_is_refused(profile: dict[str, Any], follower: dict[str, Any], words: str) -> None:
    with pytest.raises(NoSolution, match=words):
        _ = cam(profile, follower).cams.motion


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"profile": {**TANGENT, "nose_radius": 20}}, r"3 of nose_radius, nose_distance, lift and action_angle"),
        ({"profile": {**ARCS, "lift": None}}, r"\(required 3\)\ngive three of them"),
        (
            {"profile": {"type": "circular-arc", "base_radius": 20, "nose_radius": 8, "nose_distance": 24, "lift": 12}},
            r"not determine the flanks: two of them give the third\ngive action_angle or flank_radius instead of lift",
        ),
        ({"profile": {**ARCS, "lift": None, "flank_angle": 80}}, r"flank_angle: 80 deg \(limit < 75 deg"),
        ({"profile": {**DISC, "eccentricity": 40}}, r"eccentricity: 40 mm \(limit < 37.5 mm"),
        ({"motion": [{"to": 360}]}, "profile determines the motion"),
        ({"initial_lift": 2}, "begins at lift 0"),
        ({"cam": {"prime_radius": 50}}, "profile determines the radius of the cam"),
        ({"cam": {"size": {"pressure_angle": 30}}}, "omit cam.size"),
        (
            {"follower": {"type": "oscillating-roller", "roller_radius": 10, "arm": 60}},
            "position of the pivot is not sought",
        ),
        ({"follower": {"type": "oscillating-flat", "center_distance": 90}}, "not apply to a flat face that rocks"),
        ({"profile": {**TANGENT, "dwell_angle": 150}}, r"dwell_angle: 150 deg \(limit < 150 deg, action_angle"),
        ({"profile": None}, "the key 'motion' is missing"),
        ({"follower": {**ROLLER, "offset": 48}}, r"limit < 47.5 mm, profile.base_radius"),
        ({"follower": {**ROLLER, "offset": "best"}}, "offset: best applies only with cam.size"),
    ],
)
def test_keys_that_do_not_go_together_are_refused(keys: dict[str, Any], words: str) -> None:
    data = {"kind": "disc-cam", "name": "arcs", "profile": TANGENT, "follower": ROLLER}
    with pytest.raises(ValidationError, match=words):
        factory.design({**data, **keys})


def test_a_follower_jams_where_its_pressure_angle_reaches_90_deg() -> None:
    """On a concave flank alone: the tangents of a convex cam are no nearer to its axis than the base circle."""
    concave = sizes(type="circular-arc", base_radius=30.0, nose_radius=5.0, lift=40.0, flank_radius=-60.0)
    beyond = sizes(type="circular-arc", base_radius=30.0, nose_radius=5.0, lift=40.0, flank_radius=-40.0)
    for found, offset in ((concave, -20.0), (concave, 20.0), (beyond, 0.0)):
        with pytest.raises(NoSolution, match="reaches 90 deg on a concave flank"):
            contour_motion(found, 3.0, offset)
    straight = sizes(type="tangent", base_radius=30.0, nose_radius=3.0, lift=60.0)
    for found, offset in ((concave, 0.0), (straight, -32.9), (straight, 32.9)):
        motion = contour_motion(found, 3.0, offset)
        assert np.isfinite(motion.evaluate(np.linspace(0.0, 6.28, 500), 3)).all()


@pytest.mark.parametrize(
    ("found", "reach", "rocker"),
    [
        (sizes(type="tangent", base_radius=34.0, nose_radius=10.0, nose_distance=44.0), 12.0, Rocker(155.0, 111.0, -1)),
        (sizes(**HOLLOW), 8.0, Rocker(80.0, 45.0, -1)),
    ],
)
def test_a_rocker_that_jams_is_refused(found: Contour, reach: float, rocker: Rocker) -> None:
    """With the pivot close to the cam, of an arm that reaches across it: its normal passes the pivot. At the distance
    that the fix names it does not, at the one a hundredth nearer it still does."""
    with pytest.raises(
        NoSolution, match=r"reaches 90 deg between the cam angles [0-9.]+ and [0-9.]+ deg: the follower jams"
    ) as told:
        contour_motion(found, reach, rocker)
    named = re.fullmatch(r"set follower\.center_distance to ([0-9.]+) mm", str(told.value.fix))
    assert named is not None
    distance = float(named[1])
    contour_motion(found, reach, rocker._replace(distance=distance))
    back = 0.012 * rocker.distance * (1.0 if distance < rocker.distance else -1.0)
    with pytest.raises(NoSolution):
        contour_motion(found, reach, rocker._replace(distance=distance + back))


def test_a_rocker_that_does_not_reach_the_cam_is_refused() -> None:
    """The distances that the fix names are reached, at both ends; an arm too short for any names the least."""
    found = sizes(**ARCS)
    with pytest.raises(NoSolution, match=r"40 to 60 mm \(limit 70 to 130 mm, which an arm of 30 mm reaches") as told:
        contour_motion(found, 10.0, Rocker(30.0, 100.0, 1))
    low, high = (float(word) for word in str(told.value.fix).split() if word[0].isdigit())
    assert (low, high) == (30.0, 70.0)
    for distance in (low + 0.01, high - 0.01):
        Rocker(30.0, distance, 1).require_reach(40.0, 60.0)
    with pytest.raises(NoSolution) as told:
        Rocker(8.0, 50.0, 1).require_reach(40.0, 60.0)
    assert told.value.fix == "set follower.arm above 10 mm"


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(60))
def test_random_rockers_are_let_down_on_their_cams(seed: int) -> None:
    """As above, in any place: near a jam the error of the outline grows with the slope of the lift, here below 20."""
    dice = random.Random(seed)
    base, every = drawn(seed)
    kind = ("tangent", "circular-arc", "circular-arc")[seed % 3]
    names = ("nose_radius", "nose_distance") if kind == "tangent" else ("nose_radius", "nose_distance", "flank_radius")
    dwell = dice.choice([0.0, 20.0, 45.0])
    found = sizes(type=kind, base_radius=base, dwell_angle=dwell, **{name: every[name] for name in names})
    reach, sense = dice.uniform(3.0, 0.4 * base), dice.choice([1, -1])
    follower = {"type": "oscillating-roller", "roller_radius": reach, "side": dice.choice([1, -1]),
                "arm": dice.uniform(40.0, 180.0), "center_distance": dice.uniform(60.0, 200.0)}  # fmt: skip
    try:
        motion = contour_motion(
            found, reach, Rocker(follower["arm"], follower["center_distance"], -sense * follower["side"])
        )
    except NoSolution:
        return
    points = outline(found)
    start = rocked(points, 0.0, sense, found, follower)
    for phi in np.linspace(0.05, 2.0 * math.pi, 40):
        lift, slope = (float(each[0]) for each in motion.evaluate(np.array([phi]), 1))
        if abs(slope) < 20.0:
            assert lift == pytest.approx(rocked(points, phi, sense, found, follower) - start, abs=1e-5), phi


def test_rise_dwell_and_return_fit_into_a_revolution() -> None:
    with pytest.raises(NoSolution, match=r"\(limit <= 360 deg\)") as told:
        sizes(type="tangent", base_radius=30.0, nose_radius=12.5, lift=17.5, dwell_angle=250.0)
    limit = float(str(told.value.fix).split()[-2])
    found = sizes(type="tangent", base_radius=30.0, nose_radius=12.5, lift=17.5, dwell_angle=limit)
    assert math.radians(359.8) < found.whole < 2.0 * math.pi


def test_a_dwell_at_the_top_is_one() -> None:
    """Heights, and the arcs on both sides, are those of the lobe without it, the return later by the dwell."""
    dwell = math.radians(30.0)
    for profile, follower in ((STANDING, ROCKER), (STANDING, FLAT), ({**TANGENT, "dwell_angle": 30.0}, ROLLER)):
        shorter = {**profile, "dwell_angle": 0.0, "action_angle": profile["action_angle"] - 30.0}
        one, other = (cam(each, follower).cams.motion for each in (profile, shorter))
        top = float(one.pieces[2].start)
        phi = np.linspace(0.0, 2.0 * math.pi - dwell, 500)
        moved = np.where(phi > top, phi + dwell, phi)
        for a, b in zip(one.evaluate(moved, 1), other.evaluate(phi, 1), strict=True):
            np.testing.assert_allclose(a, b, rtol=0.0, atol=1e-12 * max(np.abs(b).max(), 1.0))
        lift = one.evaluate(top + dwell * np.array([0.1, 0.5, 0.9]), 1)
        assert (lift[0] == pytest.approx(one.pieces[2].low, abs=1e-12), np.abs(lift[1]).max() < 1e-12) == (True, True)


def test_two_noses_that_touch_one_flank_are_told() -> None:
    base, every = drawn(23)
    given = {name: every[name] for name in ("nose_radius", "flank_radius", "action_angle")}
    with pytest.raises(NoSolution, match=r"two noses of 33.26 mm touch this flank, 58.7 and 29.87 mm"):
        sizes(type="circular-arc", base_radius=base, **given)
