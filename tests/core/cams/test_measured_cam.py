"""A measured cam: an eccentric circle, whose follower is a triangle, and profiles that were cut by known laws.

Tolerances: the coefficients of an eccentric circle fall like (e/2R)^n; with 24 harmonics and e/R = 1/5 the next is
1e-24. Rates by differences of 1e-5 rad: 1e-6. Laws from points rounded to a micrometre: ends to 0.3 deg.
"""

from __future__ import annotations

import math
from itertools import pairwise
from typing import Any

import factory
import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError
from sweeps import spread

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.spec_paths import number_at
from gearlink.core.machines.disc_cam.measured import ROWS, phases_of
from gearlink.core.parts.cams.laws import law
from gearlink.core.studies.explore.base import Base

RADIUS, ECCENTRICITY, ROLLER = 60.0, 12.0, 15.0
PIVOT, ARM = complex(130.0, 0.0), 90.0


def eccentric(count: int = 72, **keys: Any) -> Any:
    """A circle whose centre lies on +x of the cam at cam angle 0."""
    t = np.arange(count) * 2.0 * math.pi / count
    radius = ECCENTRICITY * np.cos(t) + np.sqrt(RADIUS**2 - (ECCENTRICITY * np.sin(t)) ** 2)
    points = [[math.degrees(a), float(r)] for a, r in zip(t, radius, strict=True)]
    data = {
        "kind": "measured-cam",
        "name": "eccentric",
        "follower": {"type": "oscillating", "pivot": [130.0, 0.0], "arm": ARM, "side": -1},
        "roller_radius": ROLLER,
        "harmonics": 24,
        "profile": {"points": points},
    }
    return factory.design(data, **keys)


def of_triangle(phi: Any, sense: int, side: int) -> Any:
    """Direction of the rocker: pivot, centre of the circle, centre of the roller."""
    to_center = ECCENTRICITY * np.exp(1j * sense * phi) - PIVOT
    apart, reach = np.abs(to_center), RADIUS + ROLLER
    opening = np.arccos((apart**2 + ARM**2 - reach**2) / (2.0 * apart * ARM))
    return np.angle(to_center * np.exp(-1j * side * opening))


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_an_eccentric_circle_moves_the_rocker_of_a_triangle(sense: int, side: int) -> None:
    design = eccentric(sense=sense, follower__side=side)
    phi = np.radians(np.arange(0.0, 360.0, 7.0))
    value, speed, acceleration = design.cam.motion(phi)
    expected = of_triangle(phi, sense, side)
    np.testing.assert_allclose(value, expected, rtol=0.0, atol=1e-11)
    step = 1e-5
    around = [of_triangle(phi + k * step, sense, side) for k in (-1, 1)]
    np.testing.assert_allclose(speed, (around[1] - around[0]) / (2.0 * step), rtol=0.0, atol=1e-6)
    rates = [design.cam.motion(phi + k * step)[1] for k in (-1, 1)]
    np.testing.assert_allclose(acceleration, (rates[1] - rates[0]) / (2.0 * step), rtol=0.0, atol=1e-6)
    turn = of_triangle(np.linspace(0.0, 2.0 * math.pi, 20_001), sense, side)
    assert design.raw("swing") == pytest.approx(float(np.ptp(turn)), rel=1e-7)
    assert design.raw("min_curvature_radius") == pytest.approx(RADIUS + ROLLER, rel=1e-9)
    assert design.raw("fit_max") < 1e-12


def test_a_roller_on_a_profile_moves_as_its_differences_say() -> None:
    """R' and R'' by central differences of R and R', good to h^2 of the waves of the profile."""
    cam, t, h = eccentric().cam, np.linspace(0.1, 6.0, 40), 1e-4
    before, here, after = (cam.contact(t + step) for step in (-h, 0.0, h))
    for of, rate in ((0, 1), (1, 2)):
        assert (after[of] - before[of]) / (2.0 * h) == pytest.approx(here[rate], rel=0.0, abs=1e-5)


def test_the_pressure_angle_is_between_the_lines_of_the_triangle() -> None:
    design = eccentric()
    phi = np.linspace(0.0, 2.0 * math.pi, 20_001)
    arm = ARM * np.exp(1j * of_triangle(phi, 1, -1))
    normal = PIVOT + arm - ECCENTRICITY * np.exp(1j * phi)
    alpha = np.abs(0.5 * math.pi - np.abs(np.angle(normal / arm)))
    assert design.raw("max_pressure_angle") == pytest.approx(float(alpha.max()), rel=1e-7)
    worst = phi[int(np.argmax(alpha))]
    assert design.raw("max_pressure_angle_at") == pytest.approx(float(worst), abs=1e-3)


def test_a_slide_on_an_eccentric_is_a_slider_crank() -> None:
    follower = {"type": "translating", "direction": 70.0, "offset": 5.0}
    design = eccentric(follower=follower)
    phi = np.radians(np.arange(0.0, 360.0, 11.0))
    seen = ECCENTRICITY * np.exp(1j * phi) * np.exp(-1j * math.radians(70.0))  # along the travel, left of it
    expected = seen.real + np.sqrt((RADIUS + ROLLER) ** 2 - (seen.imag + 5.0) ** 2)
    np.testing.assert_allclose(design.cam.motion(phi)[0], expected, rtol=0.0, atol=1e-9)


def cut(laws: tuple[str, str], ends: tuple[float, float, float, float], lift: float) -> list[list[float]]:
    """Points of the profile of a roller on a slide over the cam axis, to a micrometre."""
    rise, ready, fall, home = ends
    phi = np.arange(0.0, 360.0, 0.01)
    s, v = np.zeros_like(phi), np.zeros_like(phi)
    for start, end, name, up in ((rise, ready, laws[0], True), (fall, home, laws[1], False)):
        inside = (phi >= start) & (phi <= end)
        part, rate = law(name).evaluate((phi[inside] - start) / (end - start), 1)
        s[inside] = lift * (part if up else 1.0 - part)
        v[inside] = lift * rate / math.radians(end - start) * (1.0 if up else -1.0)
    s[(phi > ready) & (phi < fall)] = lift
    center = 1j * (60.0 + s) * np.exp(-1j * np.radians(phi))
    along = 1j * v * np.exp(-1j * np.radians(phi)) - 1j * center
    profile = center - 10.0 * 1j * along / np.abs(along)
    angle = np.degrees(np.angle(profile)) % 360.0
    order = np.argsort(angle)
    at = np.arange(0.0, 360.0, 2.0)
    radius = np.interp(at, angle[order], np.abs(profile)[order], period=360.0)
    return [[float(a), round(float(r), 3)] for a, r in zip(at, radius, strict=True)]


@pytest.mark.slow
@pytest.mark.parametrize("laws", [("cycloidal", "modified-sine"), ("polynomial-345", "modified-trapezoid")])
@settings(max_examples=4, deadline=None)
@given(
    rise=st.floats(10.0, 50.0), first=st.floats(80.0, 110.0), dwell=st.floats(30.0, 60.0), lift=st.floats(12.0, 25.0)
)
def test_the_laws_of_a_cam_are_found(
    laws: tuple[str, str], rise: float, first: float, dwell: float, lift: float
) -> None:
    ends = (rise, rise + first, rise + first + dwell, rise + first + dwell + 105.0)
    data = {
        "kind": "measured-cam",
        "name": "cut",
        "follower": {"type": "translating"},
        "roller_radius": 10.0,
        "profile": {"points": cut(laws, ends, lift)},
    }
    design = factory.design(data)
    strokes = [each for each in design.phases if each.motion != "dwell"]
    assert [each.law for each in strokes] == list(laws)
    assert [each.motion for each in design.phases].count("dwell") == 2
    found = [math.degrees(place) for each in strokes for place in (each.start, each.end)]
    assert found == pytest.approx(list(ends), abs=0.5)
    assert max(each.deviation for each in strokes) < 0.01
    whole = design.cams.motion.whole  # strokes and dwells meet, all around
    gaps = [math.remainder(after.start - one.end, 2.0 * math.pi) for one, after in pairwise([*whole, whole[0]])]
    assert gaps == pytest.approx([0.0] * 4, rel=0.0, abs=1e-12)


def test_noise_that_turns_the_cam_angle_back_is_refused() -> None:
    t = np.arange(240) * 2.0 * math.pi / 240
    points = [[1.5 * k, 60.0 + 2.0 * math.cos(50.0 * float(angle))] for k, angle in enumerate(t)]
    with pytest.raises(NoSolution, match="turns back at") as refused:
        eccentric(harmonics=59, profile={"points": points}).raw("swing")
    assert refused.value.key == "profile"


@pytest.mark.parametrize(
    ("keys", "key", "words"),
    [
        ({"roller_radius": 15.0, "harmonics": 40}, "harmonics", "at most 35"),
        ({"profile": {"points": [[0, 50], [10, 51], [5, 50], [200, 51], [300, 52]]}}, "points[2]", "ascend"),
        ({"profile": {"file": "p.csv"}}, "file", "read with the design file"),
    ],
)
def test_profiles_that_serve_no_series_are_refused(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(ValidationError, match=words) as refused:
        eccentric(**keys)
    assert refused.value.errors()[0]["ctx"]["key"] == key


@pytest.mark.parametrize(
    ("keys", "key", "words"),
    [
        ({"follower__arm": 20.0}, "follower.arm", "reach of the arm"),
        (
            {"follower": {"type": "translating", "offset": 80.0}},
            "follower.offset",
            "distance of the line of travel from the cam axis",
        ),
    ],
)
def test_a_follower_that_does_not_reach_the_cam_is_refused(keys: dict[str, Any], key: str, words: str) -> None:
    with pytest.raises(NoSolution, match=words) as refused:
        eccentric(**keys).table("law")
    assert refused.value.key == key


@pytest.mark.quick(1)
@pytest.mark.parametrize("side", [1, -1])
def test_as_a_disc_cam_it_has_the_profile_that_was_measured(side: int) -> None:
    """Path, lift, pressure angle and curvature by the motion and inversion, against those of the profile itself."""
    design = eccentric(follower__side=side)
    cams, phi = design.cams, np.radians(np.arange(0.0, 360.0, 30.0))
    t = design.cam.at_cam_angle(phi)
    contact = design.cam.contact(t)
    pitch, profile = cams.main.points(phi)
    np.testing.assert_allclose(pitch, contact.center, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(profile, contact.center - ROLLER * contact.normal, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(np.abs(cams.main.pressure_angle(phi)), design.cam.pressure_angle(t), rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(cams.main.curvature(phi), design.cam.curvature(t), rtol=1e-7)
    assert cams.motion.evaluate(np.linspace(0.0, 6.28, 721), 0)[0].min() == pytest.approx(0.0, abs=1e-4)
    strokes = cams.motion.strokes
    assert sum(each.end - each.start for each in strokes) == pytest.approx(2.0 * math.pi, rel=1e-12)
    middle = np.array([0.5 * (each.start + each.end) for each in strokes])
    assert np.sign(cams.motion.evaluate(middle, 1)[1]).tolist() == [each.sense for each in strokes]
    moved = design.moving.at(phi, 1).links["follower"]
    np.testing.assert_allclose(moved.turn.first, design.cam.motion(phi)[1], rtol=0.0, atol=1e-10)


def test_the_outer_wall_of_a_groove_along_a_measured_cam() -> None:
    """Its profile has no joints, which ended the program; at the hollows of r + a cos 3t r'' = 9a bends the curve."""
    (whole,) = eccentric(closure="groove").check("outer-wall")
    assert (whole.status, whole.value) == ("pass", 0.0)
    points = [[5.0 * i, 60.0 + 8.0 * math.cos(math.radians(15.0 * i))] for i in range(72)]
    follower = {"type": "translating"}
    found = eccentric(closure="groove", profile__points=points, follower=follower)
    (wall,) = found.check("outer-wall")
    assert wall.status == "pass"
    assert wall.limit == pytest.approx(52.0**2 / (9 * 8.0 - 52.0) - ROLLER, rel=1e-9)


def test_loads_of_a_measured_cam_by_virtual_work() -> None:
    """A slide with mass and spring: torque of the cam and force on the roller by the lift's own rates."""
    loads = factory.design("loaded_measured_cam", command="loads", follower__mass=2.0)
    phi, omega = np.radians([75.0, 100.0, 230.0, 280.0]), 4.0 * math.pi
    value, speed, acceleration = loads.design.cam.motion(phi)
    lift = value - loads.design.span[0]
    along = 60.0 + 4.0 * lift + 2e-3 * acceleration * omega**2
    assert loads.machine.torque(phi) == pytest.approx(1e-3 * along * speed, rel=1e-9, abs=1e-12)
    angle = np.abs(loads.design.cams.main.pressure_angle(phi))
    assert loads.contact_force("main", phi) == pytest.approx(along / np.cos(angle), rel=1e-9)


def test_strokes_without_dwell_end_where_the_motion_turns_round() -> None:
    """A cosine with a short half: each stroke ends where the next begins, and at the extremes."""
    phi = np.arange(ROWS) * 2.0 * math.pi / ROWS
    rises = phi < math.radians(150.0)
    share = np.where(rises, phi / math.radians(150.0), (2.0 * math.pi - phi) / math.radians(210.0))
    found = phases_of(10.0 * (0.5 - 0.5 * np.cos(math.pi * share)), 0.001)
    assert [each.motion for each in found] == ["rise", "return"]
    assert [each.law for each in found] == ["simple-harmonic"] * 2
    ends = [math.degrees(end) for each in found for end in each[:2]]
    assert ends == pytest.approx([0.0, 150.0, 150.0, 360.0], rel=0.0, abs=360.0 / ROWS)
    assert max(each.deviation for each in found) < 1e-3


def test_strokes_between_dwells_end_where_their_laws_do() -> None:
    """Steps of the cam angle lie beside all ends: those of the strokes are fitted."""
    degrees, ends = np.arange(ROWS) * 360.0 / ROWS, (30.02, 140.03, 200.04, 330.01)
    rise, back = (np.clip((degrees - a) / (b - a), 0.0, 1.0) for a, b in (ends[:2], ends[2:]))
    lift = rise - np.sin(2.0 * math.pi * rise) / (2.0 * math.pi) - 0.5 * (1.0 - np.cos(math.pi * back))
    found = [each for each in phases_of(10.0 * lift, 1e-3) if each.motion != "dwell"]
    assert [each.law for each in found] == ["cycloidal", "simple-harmonic"]
    fitted = np.degrees([end for each in found for end in (each.start, each.end)])
    assert fitted == pytest.approx(ends, rel=0.0, abs=1e-6)
    assert max(each.deviation for each in found) < 1e-9


SLIDE = {"type": "translating", "direction": 90, "offset": 8, "mass": 1.5}
ROCKER = {"type": "oscillating", "pivot": [90, 20], "arm": 80, "side": -1, "inertia": 0.01}
PUSHED = {"forces": [{"on": "follower", "force": 5}], "gravity": [0, -9.81], "roller": {"width": 12}}


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("follower", "sense", "loads"),
    [(ROCKER, 1, None), (SLIDE, -1, None), (SLIDE, 1, PUSHED), (ROCKER | {"side": 1}, -1, None)],
)
def test_followers_that_stand_elsewhere_are_found_together(follower: Any, sense: int, loads: Any) -> None:
    """Tolerance: 1e-9; places of extremes, which are flat, 1e-7. Of rockers the ends of strokes are the steepest."""
    data = factory.worked("loaded_measured_cam") | {"follower": follower, "sense": sense, "loads": loads}
    base = Base(
        {key: value for key, value in data.items() if value and key not in ("tolerance", "register")}, "analyze"
    )
    moved = ("follower.direction",) if follower is SLIDE else ("follower.pivot[0]", "follower.pivot[1]")
    rows = [[(key, number_at(base.spec(), key) + 0.3 * (i - 3 * k)) for k, key in enumerate(moved)] for i in range(8)]
    alone, many = [base.design(row) for row in rows], [base.design(row) for row in rows]
    type(many[0]).find_together(many, ())
    assert all("steepest" in vars(design) for design in many)
    assert all(("steepest_rise" in vars(design.cams)) == (follower is SLIDE) for design in many)
    for one, other in spread(zip(alone, many, strict=True), 2):
        for name in one.outline("analyze").quantities:
            exact = {"abs": 1e-7} if name.endswith("_at") else {"rel": 1e-9}
            expected = one.raw(name)
            assert other.raw(name) == (expected if expected is None else pytest.approx(expected, **exact)), name
        found = [[(c.code, c.status) for name in ("pressure-angle", "lift-off") for c in d.check(name)]
                 for d in (one, other)]  # fmt: skip
        assert found[0] == found[1]
    assert len({design.max_pressure_angle_at for design in many}) == 8
