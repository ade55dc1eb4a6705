"""Exported curves against the kernels, and against what they are for: the roller touches, gears mesh.

Tolerances: a curve may be off by the tolerance asked for (T) and no more; what is compared by resampling adds the
chord error of the resampling (AGAIN, measured by halving its step). Nodes lie on the kernel's curve within 1e-9 mm,
because stretches are asked 1e-12 rad inside their joints. Involutes are held to 1e-12 rad.
"""

from __future__ import annotations

import json
import math
from functools import cache
from itertools import pairwise
from pathlib import Path
from typing import Any

import ezdxf
import factory
import numpy as np
import pytest
from numpy.typing import NDArray
from scipy.interpolate import BSpline
from sweeps import mostly_slow

from gearlink.cli.export import parts
from gearlink.cli.export.contour import Contour, contour
from gearlink.cli.export.drawings import bezier
from gearlink.cli.export.options import CurveForm
from gearlink.cli.export.sampling import Stretch, TooFine, sample
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry
from gearlink.core.parts.gears.tooth.involute import involute

ROOT = Path(__file__).resolve().parents[3]
CASES = ROOT / "tests" / "reference" / "contract"
T = 1e-3
AGAIN = 2e-5
FORMS = list(CurveForm)

Points = NDArray[np.complex128]


@cache
def press(**changes: Any) -> Any:
    return factory.design("ty460", **changes)


@cache
def gripper() -> Any:
    return factory.design(json.loads((CASES / "gripper.json").read_text())[0]["spec"])


@cache
def swing(number: int) -> Any:
    return factory.design(json.loads((CASES / "swing.json").read_text())[number]["spec"])


def pair(**more: Any) -> Any:
    return factory.design({"kind": "gear-pair", "module": 3, "teeth": [12, 31], "profile_shift": [0.35, -0.1]}, **more)


@cache
def made(design: Any, part: str, form: CurveForm = CurveForm.POLYLINE, tolerance: float = T) -> Contour:
    return contour(parts.makers(design)[part](), tolerance, form)


def drawn(exported: Contour, layer: str) -> list[Points]:
    """The curves of a layer as they are drawn: chords, or the cubics in small chords."""
    lines = [line for line in exported.lines if line.layer == layer]
    if exported.form is CurveForm.POLYLINE:
        return [line.nodes for line in lines]
    return [flattened(bezier(line)) for line in lines]


def flattened(chain: Points) -> Points:
    """A chain of Bezier cubics in chords."""
    count = min(max(20_000 // (chain.size // 3), 32), 300)
    t = np.arange(count) / count
    corners = [chain[i : len(chain) - 3 + i : 3, None] for i in range(4)]
    shares = [(1 - t) ** 3, 3 * t * (1 - t) ** 2, 3 * t**2 * (1 - t), t**3]
    points = sum(c * s for c, s in zip(corners, shares, strict=True))
    return np.append(np.asarray(points).ravel(), chain[-1])


def distance(points: Points, line: Points) -> NDArray[np.float64]:
    """Distance of each point from a polyline; never too small."""
    from scipy.spatial import cKDTree

    nearest = cKDTree(np.column_stack([line.real, line.imag])).query(np.column_stack([points.real, points.imag]))[1]
    best = np.full(points.shape, math.inf)
    for shift in range(-6, 6):
        start = nearest + shift
        start = np.mod(start, line.size - 1) if line[0] == line[-1] else np.clip(start, 0, line.size - 2)
        chord, way = line[start + 1] - line[start], points - line[start]
        square = np.where(chord == 0.0, 1.0, np.abs(chord) ** 2)
        along = np.clip(np.real(way * chord.conj()) / square, 0.0, 1.0)
        best = np.minimum(best, np.abs(way - along * chord))
    return best


def nearest(points: Points, lines: list[Points]) -> NDArray[np.float64]:
    return np.min([distance(points, line) for line in lines], axis=0)


# Closed cams

DISC_CAMS = [
    pytest.param(press, "main_cam", id="press-main"),
    pytest.param(press, "return_cam", id="press-return"),
    pytest.param(lambda: press(cam__transition="arc", cam__lead_in=0), "main_cam", id="press-arc"),
    pytest.param(gripper, "main_cam", id="gripper-main"),
    pytest.param(gripper, "return_cam", id="gripper-return"),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("build", "name"), DISC_CAMS)
def test_disc_cams_follow_the_kernel(build: Any, name: str, form: CurveForm) -> None:
    design = build()
    exported = made(design, name, form)
    assert 0.0 < exported.error <= T
    cam = getattr(design, name)
    turn = np.linspace(0.0, 2.0 * math.pi, 30_011)
    for layer, points in zip(("PITCH_CURVE", "PROFILE"), cam.points(turn), strict=True):
        (line,) = drawn(exported, layer)
        assert distance(points[::4], line).max() <= exported.error + AGAIN
        (nodes,) = (found.nodes for found in exported.lines if found.layer == layer)
        assert distance(nodes, points).max() <= 2e-6  # chord error of 30,011 points on a cam of 220 mm


@pytest.mark.quick(1)
@pytest.mark.parametrize(("build", "name"), DISC_CAMS)
def test_the_reached_error_is_the_error(build: Any, name: str) -> None:
    """Not only a bound: resampling finds nearly all of it."""
    design = build()
    exported = made(design, name)
    turn = np.linspace(0.0, 2.0 * math.pi, 30_011)
    found = max(
        distance(points, drawn(exported, layer)[0]).max()
        for layer, points in zip(("PITCH_CURVE", "PROFILE"), getattr(design, name).points(turn), strict=True)
    )
    assert 0.98 * exported.error <= found <= exported.error


@pytest.mark.quick(1)
@pytest.mark.parametrize(("build", "name"), DISC_CAMS)
@pytest.mark.parametrize("form", FORMS)
def test_the_roller_touches_the_drawn_profile(build: Any, name: str, form: CurveForm) -> None:
    """Without the kernel: from each point of the pitch curve the profile is a roller radius away."""
    exported = made(build(), name, form)
    (profile,), (pitch,) = drawn(exported, "PROFILE"), drawn(exported, "PITCH_CURVE")
    roller = getattr(build(), name).roller_radius
    off = distance(pitch, profile) - roller
    assert np.abs(off).max() <= 2.0 * T + AGAIN


@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("build", [press, gripper])
def test_closed_to_the_bit(build: Any, form: CurveForm) -> None:
    for line in made(build(), "main_cam", form).lines:
        assert line.closed
        assert line.nodes[0] == line.nodes[-1]
        if form is CurveForm.SPLINE:
            assert line.control[0] == line.control[-1]
            assert line.knots.size == line.control.size + 4
            assert np.all(np.diff(line.knots) >= 0.0)


def test_joints_of_the_law_are_vertices() -> None:
    for build in (press, gripper):
        design = build()
        cam = design.main_cam
        joints = np.mod(np.asarray(cam.joints), 2.0 * math.pi)
        (profile,) = (line.nodes for line in made(design, "main_cam").lines if line.layer == "PROFILE")
        for corner in cam.points(joints)[1]:
            assert np.abs(profile - corner).min() < 1e-9


def test_a_corner_of_the_pitch_curve_is_rounded_by_the_roller() -> None:
    """A zone that starts off the equal-speed point makes the velocity jump; the return cam's corner is hollow."""
    design = press(cam__lead_in=0, sync__start=20)
    exported = made(design, "return_cam")
    joint = design.follower.cam_sync_start
    corner = complex(design.return_cam.points(np.array([joint]))[0][0])
    arc = [piece for piece in exported.pieces if piece.stretch.name == "corner"]
    assert len(arc) == 1
    assert np.abs(np.abs(arc[0].nodes[0] - corner) - design.return_cam.roller_radius).max() < 1e-9
    (profile,) = (line.nodes for line in exported.lines if line.layer == "PROFILE")
    steps = np.abs(np.diff(profile))
    assert steps.min() > 1e-3  # no vertex twice, no sliver
    assert steps.max() < 2.0


def test_circles_touch_the_profile() -> None:
    for build in (press, gripper):
        exported = made(build(), "main_cam")
        (circle,) = exported.part.circles
        (profile,) = drawn(exported, "PROFILE")
        assert np.abs(profile).min() == pytest.approx(circle.radius, rel=0.0, abs=T)
        assert np.abs(profile).min() >= circle.radius - 1e-9


# Accuracy

SMOOTH = [("main_cam", press), ("return_cam", gripper), ("main_cam", lambda: swing(0)), ("gear1", pair)]


@pytest.mark.slow
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("name", "build"), SMOOTH)
def test_a_smaller_tolerance_gives_a_smaller_error(name: str, build: Any, form: CurveForm) -> None:
    design = build()
    exported = [made(design, name, form, tolerance) for tolerance in (4e-3, 2e-3, 1e-3, 5e-4, 2.5e-4)]
    assert all(e.error <= e.tolerance for e in exported)
    assert all(fine.error < coarse.error for coarse, fine in zip(exported, exported[2:], strict=False))
    counts = [e.points for e in exported]
    assert counts == sorted(counts)
    # Halving four times: chords need four times the points (error in h^2), cubics twice (h^4).
    assert counts[-1] / counts[0] < (5.2 if form is CurveForm.POLYLINE else 2.6)


def test_splines_need_fewer_points() -> None:
    chords, cubics = (made(press(), "main_cam", form) for form in (CurveForm.POLYLINE, CurveForm.SPLINE))
    assert cubics.points < chords.points / 8


@pytest.mark.parametrize("form", FORMS)
def test_a_circle_has_the_error_of_its_chords(form: CurveForm) -> None:
    """r (1 - cos(d/2)) in closed form for chords."""
    stretch = Stretch(("PROFILE",), lambda t: 50.0 * np.exp(1j * t)[None, :], 0.0, 2.0 * math.pi)
    found = sample(stretch, 1e-3, form)
    if form is CurveForm.POLYLINE:
        exact = 50.0 * (1.0 - math.cos(math.pi / (found.parameter.size - 1)))
        assert exact <= found.error <= 1.0001 * exact * (1.0 + 1e-9)
    assert found.error <= 1e-3


def test_a_bump_between_the_middles_is_seen() -> None:
    """The middle of a step may lie on its chord by chance: a whole sine wave does."""
    stretch = Stretch(("PROFILE",), lambda t: (t + 1j * np.sin(t))[None, :], 0.0, 2.0 * math.pi, steps=1)
    assert sample(stretch, 0.1, CurveForm.POLYLINE).parameter.size > 4


def test_too_many_points_are_refused() -> None:
    stretch = Stretch(("PROFILE",), lambda t: 50.0 * np.exp(1j * t)[None, :], 0.0, 2.0 * math.pi)
    with pytest.raises(TooFine, match="increase --tolerance"):
        sample(stretch, 1e-5, CurveForm.POLYLINE, most=100)


CURVES: dict[str, Any] = {
    "circle": lambda t: 1e6 * np.exp(1j * t),
    "bump": lambda t: 1e6 * np.exp(1j * t) * (1.0 + 1e-3 * np.exp(-((t - 2.0) ** 2) / 1e-4)),
    "corner": lambda t: 1e6 * (t + 1j * np.abs(t - 1.9)) + 1e5 * np.exp(3j * t),
    "cusp": lambda t: 1e6 * (t + 1j * np.sqrt(np.abs(t - 1.9))) + 1e5 * np.exp(3j * t),
}


@pytest.mark.quick(2)
@pytest.mark.parametrize("name", CURVES)
@pytest.mark.parametrize("form", CurveForm)
def test_no_curve_is_refused_that_has_room(form: CurveForm, name: str) -> None:
    """How many nodes there will be is foretold; halving one by one without that gives the same ones."""
    stretch = Stretch(("PROFILE",), lambda t: CURVES[name](t)[None, :], 0.0, 2.0 * math.pi)
    tolerance = 0.1 if form is CurveForm.POLYLINE else 1e-6
    size = sample(stretch, tolerance, form, 10**6).parameter.size
    assert size > 2000
    assert sample(stretch, tolerance, form, size).parameter.size == size
    with pytest.raises(TooFine):
        sample(stretch, tolerance, form, size - 1)


@pytest.mark.parametrize("form", CurveForm)
def test_no_place_is_farther_off_than_is_said(form: CurveForm) -> None:
    """Where the distance has no parabola's shape: asked at a hundred places of each step."""
    made = parts.makers(factory.design("mutilated_gear_times"))["gear2"]()
    for stretch in made.stretches:
        found = sample(stretch, 0.05, form)
        t = (found.parameter[:-1, None] + np.diff(found.parameter)[:, None] * np.arange(101) / 100).ravel()
        points = stretch.points(t)
        if form is CurveForm.SPLINE:
            cubic = BSpline(found.knots, np.concatenate([found.control.real, found.control.imag]).T, 3)(t).T
            near = cubic[: len(points)] + 1j * cubic[len(points) :]
            off = np.abs(near - points)
        else:
            rows = points.reshape(len(points), -1, 101)
            chord = rows[..., -1:] - rows[..., :1]
            way = (rows - rows[..., :1]) / chord
            off = np.abs(way - np.clip(way.real, 0.0, 1.0)) * np.abs(chord)
        assert off.max() <= found.error


def test_a_curve_far_too_long_is_refused_before_it_has_been_sampled() -> None:
    asked = []

    def points(t: Any) -> Any:
        asked.append(t.size)
        return CURVES["bump"](t)[None, :]

    with pytest.raises(TooFine):
        sample(Stretch(("PROFILE",), points, 0.0, 2.0 * math.pi), 1e-6, CurveForm.POLYLINE)
    assert sum(asked) < 200_000  # of 4 million


def test_what_is_known_of_a_curve_is_not_sought_again() -> None:
    asked: list[float] = []

    def points(t: Any) -> Any:
        asked.extend(t.tolist())
        return (t + 1j * np.sin(3.0 * t) * np.exp(-t))[None, :]

    found = sample(Stretch(("PROFILE",), points, 0.0, 6.0), 1e-4, CurveForm.POLYLINE)
    assert len(set(asked)) == len(asked) == 8 * (found.parameter.size - 1) + 1
    assert set(found.parameter.tolist()) <= set(asked)


@pytest.mark.slow
def test_a_file_holds_so_many_points_whatever_its_curves(monkeypatch: pytest.MonkeyPatch) -> None:
    """Of a cam, profile and roller path count together; what the message says does."""
    part = parts.makers(factory.design("wide_swing_oscillating_cam"))["main_cam"]()
    whole = contour(part, 1e-3, CurveForm.POLYLINE)
    assert {line.layer for line in whole.lines} == {"PITCH_CURVE", "PROFILE"}
    monkeypatch.setattr("gearlink.cli.export.contour.MOST_POINTS", whole.points)
    assert contour(part, 1e-3, CurveForm.POLYLINE).points == whole.points
    monkeypatch.setattr("gearlink.cli.export.contour.MOST_POINTS", whole.points - 20)
    with pytest.raises(TooFine, match=r"increase --tolerance to 0\.002"):
        contour(part, 1e-3, CurveForm.POLYLINE)
    assert contour(part, 2e-3, CurveForm.POLYLINE).points < whole.points - 20
    monkeypatch.setattr("gearlink.cli.export.contour.MOST_POINTS", 20)
    with pytest.raises(TooFine, match="no tolerance up to 10 mm is sufficient"):
        contour(part, 1e-3, CurveForm.POLYLINE)


# Wide-swing cams


def oscillating() -> Any:
    return factory.design("wide_swing_oscillating_cam")


SWING_CAMS = [
    pytest.param(lambda: swing(0), "main_cam", id="twin-cam-main"),
    pytest.param(lambda: swing(0), "return_cam", id="twin-cam-return"),
    pytest.param(lambda: swing(1), "main_cam", id="twin-rocker-main"),
    pytest.param(lambda: swing(1), "return_cam", id="twin-rocker-return"),
    pytest.param(oscillating, "main_cam", id="oscillating"),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize(("build", "name"), SWING_CAMS)
def test_swing_cams_are_open_and_follow_the_table(build: Any, name: str, form: CurveForm) -> None:
    design = build()
    exported = made(design, name, form)
    table = design.table(name, samples=2000)
    column = dict(zip(table.columns, table.data, strict=True))
    profiles = drawn(exported, "PROFILE")
    assert len(profiles) == 2
    assert not any(line.closed for line in exported.lines)
    on = column["x"] + 1j * column["y"]
    assert nearest(on[~np.isnan(on)], profiles).max() <= exported.error + AGAIN
    (pitch,) = drawn(exported, "PITCH_CURVE")
    assert distance(column["pitch_x"] + 1j * column["pitch_y"], pitch).max() <= exported.error + AGAIN


@pytest.mark.quick(2)
@pytest.mark.parametrize("form", mostly_slow(FORMS, 1))
@pytest.mark.parametrize(("build", "name"), SWING_CAMS)
def test_the_roller_nowhere_enters_a_swing_profile(build: Any, name: str, form: CurveForm) -> None:
    exported = made(build(), name, form)
    (pitch,) = drawn(exported, "PITCH_CURVE")
    roller = next(c.radius for c in exported.part.circles if c.layer == "ROLLER_AT_MID_SWING")
    reach = nearest(pitch, drawn(exported, "PROFILE"))
    assert reach.min() >= roller - 2.0 * T - AGAIN
    assert np.median(reach) == pytest.approx(roller, rel=0.0, abs=2.0 * T + AGAIN)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["contour", "return_contour"])
def test_a_cycle_is_one_closed_contour_round_the_roller(name: str) -> None:
    design = factory.design("wide_swing_cycle", command="cam")
    exported = made(design, name)
    assert all(line.closed for line in exported.lines)
    assert len(exported.lines) == 2
    (edge,), (pitch,) = drawn(exported, "PROFILE"), drawn(exported, "PITCH_CURVE")
    table, before = design.table("contour", samples=1000), "return_" if name.startswith("return") else ""
    on = table[f"{before}x"] + 1j * table[f"{before}y"]
    assert distance(on[~np.isnan(on)], edge).max() <= exported.error + AGAIN
    reach = distance(pitch, edge)
    assert reach.min() >= design.section.roller_radius - 2.0 * T - AGAIN
    assert reach.max() <= design.section.roller_radius + design.section.free_clearance + 2.0 * T + AGAIN


@pytest.mark.quick(2)
@pytest.mark.parametrize(("build", "name"), SWING_CAMS)
def test_a_swing_profile_ends_on_the_roller_at_mid_swing(build: Any, name: str) -> None:
    exported = made(build(), name)
    roller = next(circle for circle in exported.part.circles if circle.layer == "ROLLER_AT_MID_SWING")
    first, second = drawn(exported, "PROFILE")
    for end in (first[-1], second[0]):
        assert abs(end - roller.center) == pytest.approx(roller.radius, rel=1e-9)
    for line in (first, second):  # and nowhere enters it
        assert np.abs(line - roller.center).min() >= roller.radius * (1.0 - 1e-9)
    assert any("open profile" in note for note in exported.part.notes)


def test_the_return_cam_of_a_twin_cam_is_the_mirror_image() -> None:
    main, back = (drawn(made(swing(0), name), "PROFILE") for name in ("main_cam", "return_cam"))
    for one, other in zip(main, back, strict=True):
        assert np.array_equal(one.conj(), other)


# Gears

PAIRS = [
    pytest.param({}, id="shifted-12-31"),
    pytest.param({"teeth": [9, 40], "profile_shift": [0.0, 0.0]}, id="undercut"),
    pytest.param({"teeth": [72, 72], "module": 4, "profile_shift": [0.3, 0.3]}, id="press"),
    pytest.param(
        {"teeth": [20, 21], "profile_shift": [-0.2, 0.5], "pressure_angle": 25, "clearance": 0.2}, id="25-deg"
    ),
]


@pytest.mark.parametrize("spec", PAIRS)
@pytest.mark.parametrize("number", [0, 1])
def test_flanks_are_involutes(spec: dict[str, Any], number: int) -> None:
    """Half a space at radius R is pi/z - s/(2 r) - inv(alpha) + inv(alpha_R), cos(alpha_R) = r_b/R."""
    design = pair(**spec)
    gears: GearPair = design.gear_pair
    exported = made(design, f"gear{number + 1}")
    z, alpha = gears.teeth[number], gears.pressure_angle
    tooth = gears.tooth_thickness[number] / (2.0 * gears.reference_radius[number])
    pitch_of_pieces = [piece.nodes[0] for piece in exported.pieces if piece.stretch.name == "involute"]
    flanks = [turn * nodes for turn in exported.turns for nodes in pitch_of_pieces]
    assert len(flanks) == 2 * z
    points = np.concatenate(flanks)
    pitch = 2.0 * math.pi / z
    from_space = np.abs(np.angle(points) - pitch * np.round(np.angle(points) / pitch))
    at = np.arccos(np.minimum(gears.base_radius[number] / np.abs(points), 1.0))
    half_space = math.pi / z - tooth - involute(alpha) + np.tan(at) - at
    assert np.abs(from_space - half_space).max() < 1e-12


@pytest.mark.quick(3)
@pytest.mark.parametrize("form", FORMS)
@pytest.mark.parametrize("spec", PAIRS)
def test_tooth_thickness_on_the_reference_circle(spec: dict[str, Any], form: CurveForm) -> None:
    """Where the drawn outline crosses the reference circle; the flank is tilted, so off by T is 1.2 T of arc a side."""
    design = pair(**spec)
    gears: GearPair = design.gear_pair
    for number in (0, 1):
        (line,) = drawn(made(design, f"gear{number + 1}", form), "PROFILE")
        r, z = gears.reference_radius[number], gears.teeth[number]
        above = np.abs(line) > r
        cross = np.flatnonzero(above[1:] != above[:-1])
        assert cross.size == 2 * z
        low, high = line[cross], line[cross + 1]
        share = (r - np.abs(low)) / (np.abs(high) - np.abs(low))
        angle = np.angle(low + share * (high - low))
        rising = above[cross + 1]
        into = np.sort(np.mod(angle[rising], 2.0 * math.pi))
        out = np.mod(angle[~rising], 2.0 * math.pi)
        width = np.min(np.mod(out[None, :] - into[:, None], 2.0 * math.pi), axis=1)
        assert r * width == pytest.approx(gears.tooth_thickness[number], rel=0.0, abs=2.4 * T + AGAIN)


@pytest.mark.quick(3)
@pytest.mark.parametrize(
    ("spec", "form"), [(p.values[0], CurveForm.POLYLINE) for p in PAIRS] + [({}, CurveForm.SPLINE)]
)
def test_meshing_gears_touch_and_do_not_overlap(spec: dict[str, Any], form: CurveForm) -> None:
    """Over a pitch of rolling: no point of gear 2 lies deeper in gear 1 than both chord errors.

    Also with a pinion whose undercut makes the room that its involute would not.
    """
    from matplotlib.path import Path as Polygon

    design = pair(**spec)
    gears: GearPair = design.gear_pair
    mesh, outlines = MeshGeometry(gears), []
    for number in (0, 1):
        (line,) = drawn(made(design, f"gear{number + 1}", form), "PROFILE")
        outlines.append(line * np.exp(1j * mesh.first_space[number]))
    first = Polygon(np.column_stack([outlines[0].real, outlines[0].imag]))
    for share in np.linspace(0.0, 0.9, 5):
        turn = 2.0 * math.pi / gears.teeth[0] * share
        rolled = outlines[1] * np.exp(-1j * turn * gears.teeth[0] / gears.teeth[1]) + gears.center_distance
        seen = rolled * np.exp(-1j * turn)  # in the frame of gear 1
        near = seen[np.abs(seen) < gears.tip_radius[0] + T]
        inside = first.contains_points(np.column_stack([near.real, near.imag]))
        gap = distance(near, outlines[0])
        assert gap[inside].max(initial=0.0) <= 2.0 * T + AGAIN
        assert gap.min() <= 2.0 * T  # no backlash: flanks do touch


def test_a_gear_is_closed_and_has_no_vertex_twice() -> None:
    for spec in ({}, {"teeth": [20, 20], "profile_shift": [1.2, 0.0]}):  # the second: nearly pointed
        (line,) = made(pair(**spec), "gear1").lines
        assert line.closed
        assert line.nodes[0] == line.nodes[-1]
        assert np.abs(np.diff(line.nodes)).min() > 1e-6


def test_the_planet_of_a_ring_gear() -> None:
    gears, links = {"module": 2, "planet": 48, "ring": 62}, {"coupler": 30, "rocker": 40, "frame": 45}
    exported = made(factory.design({"kind": "two-gear-four-bar", "gears": gears, "links": links}), "gear2")
    assert exported.part.teeth == 48
    radii = np.abs(exported.lines[0].nodes)
    assert (radii.min(), radii.max()) == pytest.approx((45.5, 50.0), rel=1e-12)


def test_three_gears_share_the_idlers_form() -> None:
    spec = {
        "kind": "three-gear-four-bar",
        "gears": {"module": 2, "crank": 20, "idler": 31, "output": 20},
        "dwell": {"angle": 135},
    }
    design = factory.design(spec, command="synth dwell")
    gears = {name: made(design, name) for name in ("gear1", "gear3", "gear5")}
    assert [gears[name].part.teeth for name in gears] == [20, 31, 20]
    assert np.array_equal(gears["gear1"].lines[0].nodes, gears["gear5"].lines[0].nodes)


# DXF read back


def read_back(tmp_path: Path, design: Any, name: str, form: CurveForm) -> tuple[Contour, Any]:
    from gearlink.cli.export.drawings import as_dxf

    exported = made(design, name, form)
    path = tmp_path / "part.dxf"
    path.write_bytes(as_dxf(exported, design.spec))
    document = ezdxf.readfile(path)
    audit = document.audit()
    assert not audit.errors
    assert not audit.fixes
    assert document.units == ezdxf.units.MM
    return exported, document


@pytest.mark.parametrize("form", FORMS)
def test_closed_outlines_run_counter_clockwise(form: CurveForm) -> None:
    """A tool path lies on one side of its contour: cams and gears must agree on which."""
    cases = [(press(), "main_cam"), (gripper(), "main_cam"), (pair(), "gear1")]
    for points in (points for case in cases for points in drawn(made(*case, form), "PROFILE")):
        assert np.sum((points[:-1].conj() * points[1:]).imag) / (2 * math.pi * np.abs(points).min() ** 2) > 1.0


DXF_PARTS = [
    (press, "main_cam"),
    (press, "gear1"),
    (gripper, "return_cam"),
    (lambda: swing(0), "main_cam"),
    (pair, "gear2"),
]


@pytest.mark.quick(1)
@pytest.mark.parametrize(("build", "name"), DXF_PARTS)
def test_dxf_polylines_read_back(tmp_path: Path, build: Any, name: str) -> None:
    exported, document = read_back(tmp_path, build(), name, CurveForm.POLYLINE)
    entities = list(document.modelspace().query("LWPOLYLINE"))
    assert [e.dxf.layer for e in entities] == [line.layer for line in exported.lines]
    for entity, line in zip(entities, exported.lines, strict=True):
        read = np.array([complex(x, y) for x, y in entity.get_points("xy")])
        assert entity.closed == line.closed
        assert np.array_equal(read, line.nodes[:-1] if line.closed else line.nodes)


@pytest.mark.quick(2)
@pytest.mark.parametrize(("build", "name"), DXF_PARTS)
def test_dxf_splines_read_back(tmp_path: Path, build: Any, name: str) -> None:
    """Evaluated by ezdxf in the middles of knot spans, where scipy must give the same points."""

    exported, document = read_back(tmp_path, build(), name, CurveForm.SPLINE)
    entities = list(document.modelspace().query("SPLINE"))
    assert [e.dxf.layer for e in entities] == [line.layer for line in exported.lines]
    for entity, line in zip(entities, exported.lines, strict=True):
        assert entity.dxf.degree == 3
        assert entity.closed == line.closed
        control = [tuple(point) for point in entity.control_points]
        assert (control[0] == control[-1]) == line.closed
        knots = np.unique(entity.knots)
        middles = 0.5 * (knots[:-1] + knots[1:])[:400]
        points = np.array([complex(p.x, p.y) for p in entity.construction_tool().points(middles.tolist())])
        ours = BSpline(line.knots, np.column_stack([line.control.real, line.control.imag]), 3)(middles)
        assert np.abs(points - (ours[:, 0] + 1j * ours[:, 1])).max() < 1e-9


def test_dxf_layers_and_marks(tmp_path: Path) -> None:
    document = read_back(tmp_path, press(), "main_cam", CurveForm.POLYLINE)[1]
    layers = {layer.dxf.name for layer in document.layers}
    assert {"PROFILE", "PITCH_CURVE", "BASE_CIRCLE", "CENTER", "TEXT"} <= layers
    assert document.layers.get("TEXT").dxf.plot == 0
    (circle,) = document.modelspace().query("CIRCLE")
    assert circle.dxf.radius == pytest.approx(press().min_radius, rel=1e-9)
    (point,) = document.modelspace().query("POINT")
    assert tuple(point.dxf.location) == (0.0, 0.0, 0.0)


# CSV


@pytest.mark.quick(1)
@pytest.mark.parametrize("build", [press, gripper])
def test_csv_rows_are_the_kernels(build: Any) -> None:
    import csv

    from gearlink.cli.export.command import as_csv

    design = build()
    lines = as_csv(made(design, "return_cam"), design.spec).decode().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    angle = np.radians([float(row["cam_angle [deg]"]) for row in rows])
    cam = design.return_cam
    expected = cam.at(angle)
    for head, values in (
        ("x [mm]", expected.profile.real),
        ("y [mm]", expected.profile.imag),
        ("pitch_x [mm]", expected.pitch.real),
        ("pitch_y [mm]", expected.pitch.imag),
        ("pressure_angle [deg]", np.degrees(expected.pressure_angle)),
    ):
        assert np.abs(np.array([float(row[head]) for row in rows]) - values).max() < 1e-8
    joints = np.append(np.mod(cam.joints, 2.0 * math.pi), [0.0, 2.0 * math.pi])
    apart = np.abs(angle[:, None] - joints).min(axis=1) > 1e-9  # at a joint the curvature may jump
    bend = [1.0 / float(row["curvature_radius [mm]"] or "inf") for row in rows]
    assert np.abs(np.array(bend) - expected.curvature)[apart].max() < 1e-9


def test_csv_of_a_swing_cam_leaves_the_slot_empty() -> None:
    import csv

    from gearlink.cli.export.command import as_csv

    design = swing(0)
    exported = made(design, "main_cam")
    lines = as_csv(exported, design.spec).decode().splitlines()
    rows = list(csv.DictReader(line for line in lines if not line.startswith("#")))
    k = [float(row["k"]) for row in rows]
    assert (k[0], k[-1]) == (0.0, 1.0)
    assert all(low < high for low, high in pairwise(k))
    touching = [float(row["k"]) for row in rows if row["x [mm]"]]
    end = design.cam.contact[0][1]
    assert max(value for value in touching if value < 0.5) == end
    assert min(value for value in touching if value > 0.5) == 1.0 - end
    assert all(row["pitch_x [mm]"] for row in rows)
