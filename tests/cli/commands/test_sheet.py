"""`sheet`: curves that are each other's derivatives, timing in angles of the input, drawings with every degree."""

from __future__ import annotations

import math
from itertools import pairwise
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from sweeps import spread

from gearlink.cli.commands.sheet import sheets_of
from gearlink.cli.views.figures.drawing import time_axes
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, paper, timing_sheet, true_size, vector_sheet

SMOOTH = [
    ("candy_feed", "synth dwell"),
    ("two_gear_ring", "analyze"),
    ("wide_lever", "analyze"),
    ("ty460_slider_crank", "analyze"),
    ("ty460", "analyze"),
    ("hypocycloid_slider", "analyze"),
    ("five_bar_path", "analyze"),
]


def _turned(values: Any) -> Any:
    """The derivative of a periodic curve and its winding, by its Fourier series."""
    gain = values[-1] - values[0]
    periodic = values[:-1] - gain * np.arange(len(values) - 1) / (len(values) - 1)
    waves = np.fft.rfft(periodic)
    slope = np.fft.irfft(1j * np.arange(len(waves)) * waves, len(periodic)) + gain / (2.0 * math.pi)
    return np.append(slope, slope[0])


@pytest.mark.parametrize(("name", "command"), SMOOTH)
def test_each_curve_is_the_derivative_of_the_one_above(name: str, command: str) -> None:
    """Fourier's derivative is exact to rounding, which it multiplies by the number of waves, 360."""
    # a cam's law has joints, for which see below
    for course in motion_sheet.courses(design(worked(name), command=command, cam=None)):
        assert len(course.rates) >= 3
        for lower, upper in zip(course.rates, course.rates[1:], strict=False):
            scale = float(np.abs(upper).max()) + float(np.abs(lower).max())
            assert np.abs(_turned(lower) - upper).max() < 360 * 1e-13 * scale


def test_each_curve_of_a_bed_with_its_cam_is_the_derivative_of_the_one_above() -> None:
    """Stretch by stretch, by Gauss's rule on 12 points: exact to rounding on stretches of some 6 deg."""
    made = design(worked("ty460"))
    bed, cylinder = motion_sheet.courses(made)
    assert [phase.name for phase in cylinder.bands] == ["sync"]
    nodes, weights = np.polynomial.legendre.leggauss(12)
    assert len(bed.joints) == len(made.follower.segments)
    for start, end in pairwise([0.0, *bed.joints, 360.0]):
        edges = np.linspace(start + 1e-9, end - 1e-9, 24)
        half = 0.5 * (edges[1:] - edges[:-1])
        inside = bed.at((0.5 * (edges[1:] + edges[:-1])[:, None] + half[:, None] * nodes).ravel())
        at_edges = bed.at(edges)
        for lower, upper in zip(at_edges, inside[1:], strict=False):
            grown = np.radians(half) * (upper.reshape(-1, 12) @ weights)
            scale = float(np.abs(upper).max()) + float(np.abs(lower).max())
            np.testing.assert_allclose(np.diff(lower), grown, rtol=0.0, atol=1e-10 * scale)
    for place in np.degrees(made.bed_motion.joints):  # with what is before a joint and what is at it
        assert place in bed.x
        assert bed.x[bed.x < place].max() > place - 1e-12


def test_a_bed_whose_cam_cannot_be_is_shown_without_it() -> None:
    made = design(worked("ty460"), cam__transition_end=100.0)
    bed, bare = motion_sheet.courses(made)[0], motion_sheet.courses(design(worked("ty460"), cam=None))[0]
    assert (bed.name, bare.name) == ("Bed, without its cam", "Bed")
    assert all(np.array_equal(one, other) for one, other in zip(bed.rates, bare.rates, strict=True))


@pytest.mark.parametrize("number", [0, 1], ids=["arm", "cam rocker"])
def test_jerk_of_the_gripper_joins_its_acceleration(number: int) -> None:
    course = motion_sheet.courses(design(worked("swing_gripper")))[number]
    x = np.radians(course.x)
    for lower, upper in zip(course.rates, course.rates[1:], strict=False):
        middle = 0.5 * (upper[1:] + upper[:-1])
        grown = np.concatenate([[0.0], np.cumsum(middle * np.diff(x))])
        # The trapezium rule on quarters of a degree: a jump costs it half a step of x.
        steps = np.abs(np.diff(upper))
        jumps = 0.5 * float(x[1]) * steps[steps > 0.05 * np.ptp(upper)].sum()
        assert np.abs(grown - (lower - lower[0])).max() < jumps + 1e-4 * np.abs(lower).max()


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["candy_feed", "ring_feed", "drawn_feed"])
def test_marked_extremes_are_those_of_the_analysis(name: str) -> None:
    """A parabola through points half a degree apart would miss their places by up to 0.003 deg."""
    made = design(worked(name))
    course = motion_sheet.courses(made)[0]
    for order, found in ((1, (made.fastest, made.slowest)), (2, (made.hardest, made.hardest_back))):
        for greatest, (place, value) in zip((True, False), found, strict=True):
            at, marked = course.extreme(order, greatest=greatest)
            assert marked == pytest.approx(value, rel=1e-12)
            assert at == pytest.approx(
                math.degrees(place) % 360.0, abs=2e-5
            )  # the root of eps times the curve's height


def test_extremes_of_a_bed_are_its_quantities() -> None:
    made = design(worked("ty460"))
    course = motion_sheet.courses(made)[0]
    for side, greatest in (("max", True), ("min", False)):
        place, value = course.extreme(1, greatest=greatest)
        quantity = made.quantity(f"bed_velocity_{side}")
        assert value * made.input_speed == pytest.approx(quantity.value, rel=1e-10)
        assert place == pytest.approx(made.quantity(f"bed_velocity_{side}_at").value, abs=1e-4)


def test_extremes_at_joints_of_a_law() -> None:
    """A plateau is marked where it begins; a modified sine is steepest an eighth of its rise from each end; a jump
    counts with the value before it."""
    course, _rocker = motion_sheet.courses(design(worked("swing_gripper")))
    assert course.extreme(1, greatest=True)[0] == pytest.approx(100.0, abs=1e-6)
    assert course.extreme(2, greatest=True)[0] == pytest.approx(275.0, abs=1e-5)
    assert course.extreme(2, greatest=False)[0] == pytest.approx(185.0, abs=1e-5)
    place, value = course.extreme(3, greatest=True)
    start = float(course.rates[3][np.searchsorted(course.x, 112.0)])
    assert place == pytest.approx(162.0, abs=1e-9)
    assert value == pytest.approx(-start, rel=1e-9), "half a cycloidal rise ends as it begins"


@pytest.mark.slow
def test_time_is_on_the_right_in_si() -> None:
    made = design(worked("ty460"))
    figure = motion_sheet.draw(made)
    figure.set_layout_engine("none")  # where the panels stand is not asked
    velocity = next(axes for axes in figure.axes if axes.get_ylabel().startswith("velocity"))
    (right,) = velocity.child_axes
    assert right.get_ylabel() == "[m/s]"
    figure.draw_without_rendering()
    assert right.get_ylim()[1] == pytest.approx(velocity.get_ylim()[1] * made.input_speed * 1e-3, rel=1e-12)


def test_timing_is_in_angles_of_the_input() -> None:
    made = design(worked("ty460"))
    rings, marks, over = timing_sheet.press(made)
    assert over == "input"
    names = {ring.name: ring.stretches for ring in rings}
    cams = {phase.name: phase for phase in names["cams"]}
    assert cams["sync"].start == pytest.approx(math.degrees(made.sync_start), abs=1e-9)
    assert cams["sync"].end == pytest.approx(math.degrees(made.sync_end), abs=1e-9)
    assert [place for _, place in marks] == pytest.approx([cams["sync"].start, cams["sync"].end], rel=1e-12)
    turning = names["bed"][0].end
    assert abs(float(made.bed.travel(math.radians(turning), 1).first)) < 1.0  # mm/rad, of 427


def test_radii_of_each_degree_lie_on_the_pitch_curve() -> None:
    for name in spread(("swing_gripper", "ty460"), 1):
        for cam in cam_sheets.discs(design(worked(name))):
            radii = cam_sheets.pitch_radii(cam)
            theta = np.linspace(0.0, 2.0 * math.pi, 50001)
            pitch, _ = cam.points(theta)
            angle = np.mod(np.angle(pitch / pitch[0]), 2.0 * math.pi)
            for degree in range(0, 360, 37):
                nearest = int(np.argmin(np.abs(angle - math.radians(degree))))
                assert radii[degree] == pytest.approx(abs(pitch[nearest]), abs=5e-3)
            assert radii[0] == pytest.approx(abs(pitch[0]), rel=1e-12)


@pytest.mark.parametrize(("bore", "key"), [(12.0, (4, 1.8)), (12.1, (5, 2.3)), (80.0, (22, 5.4)), (131.0, None)])
def test_keyways_begin_above_a_bore(bore: float, key: tuple[float, float] | None) -> None:
    assert cam_sheets.keyway(bore) == key


@pytest.mark.slow
def test_every_sheet_of_a_press(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    ended = gearlink("sheet", designs / "ty460.yaml", "--plot-format", "svg", "--out", tmp_path)
    assert (ended.status, ended.out) == (0, "")
    names = (
        *(
            "contact",
            "drawing-1",
            "drawing-2",
            "drawing-gear1",
            "drawing-gear2",
            "motion",
            "polygons",
            "pressure",
            "timing",
            "vectors",
        ),
        "zone",
    )
    assert sorted(path.name for path in tmp_path.iterdir()) == [f"TY-460-{name}.svg" for name in names]
    text = (tmp_path / "TY-460-drawing-1.svg").read_text()
    assert "359" in text
    assert "Start mark" in text


@pytest.mark.parametrize(
    ("name", "asked", "words"),
    [
        ("ty460_slider_crank", ("timing",), "it has motion"),
        ("six_bar_two_trains", (), "of which this gear-train-mobility has none"),
        ("quiet_law", (), "its sheet is drawn by `gearlink laws "),
        (
            "ty460",
            ("motions",),
            "it has motion, vectors, zone, timing, polygons, pressure, contact",
        ),
    ],
)
def test_what_a_design_has_not_is_refused(
    gearlink: Any, designs: Path, tmp_path: Path, name: str, asked: tuple[str, ...], words: str
) -> None:
    ended = gearlink("sheet", designs / f"{name}.yaml", *asked, "--out", tmp_path / "out")
    assert ended.status == 2
    assert words in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.parametrize(
    ("name", "asked", "words"),
    [
        (
            "cam_gear",
            ("drawing", "--scale", "1"),
            "--scale is for drawings of disc cams, of which this cam-gear has none",
        ),
        ("linked_cams", ("motion", "--scale", "1"), "--scale applies only to drawings of cams"),
        ("linked_cams", ("drawing", "--scale", "2:1"), "--scale 2:1 is not a scale"),
        ("linked_cams", ("drawing", "--paper", "A4"), "--paper without --scale"),
    ],
)
def test_a_scale_that_nothing_has_is_refused(
    gearlink: Any, designs: Path, tmp_path: Path, name: str, asked: tuple[str, ...], words: str
) -> None:
    """Of what has no disc cams, its drawings had been said not to exist."""
    ended = gearlink("sheet", designs / f"{name}.yaml", *asked, "--out", tmp_path / "out")
    assert ended.status == 2
    assert words in ended.err
    assert not (tmp_path / "out").exists()


def test_kinds_with_sheets() -> None:
    assert list(sheets_of(design(worked("swing_gripper")))) == [
        "motion",
        "vectors",
        "dwell",
        "timing",
        "pressure",
        "contact",
        "drawing-1",
        "drawing-2",
    ]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "keys"), [("candy_feed", {"input_speed": 90.0}), ("ty460_slider_crank", {})])
def test_the_lowest_panel_has_the_time_beside_the_angle_where_the_speed_is_known(name: str, keys: Any) -> None:
    made = design(name, **keys)
    figure = motion_sheet.draw(made)
    if keys:
        figure.set_layout_engine("none")  # where the panels stand is not asked
        figure.draw_without_rendering()  # until then the second axis does not know the first
    times = [
        (axes.get_xlim(), child.get_xlim())
        for axes in figure.axes
        for child in axes.child_axes
        if child.get_gid() == time_axes.ROW
    ]
    assert bool(times) == bool(keys)
    for angles, time in times:
        assert angles == (0.0, 360.0)
        assert time == pytest.approx((0.0, made.turn_time), rel=1e-12)


@pytest.mark.slow
def test_extremes_are_named_within_their_panels() -> None:
    """Two columns leave half of a page's width."""
    figure = motion_sheet.draw(design(worked("ty460")))
    figure.draw_without_rendering()
    for axes in figure.axes:
        panel = axes.get_window_extent()
        for words in axes.texts:
            if " at " in words.get_text():
                box = words.get_window_extent()
                assert panel.x0 - 1.0 <= box.x0, words.get_text()
                assert box.x1 <= panel.x1 + 1.0, words.get_text()


@pytest.mark.quick(1)
@pytest.mark.parametrize(("name", "keys"), [("ty460", {}), ("swing_gripper", {"cam__shaft_radius": 40.0})])
def test_a_workshop_drawing_is_true_to_its_standard_scale(name: str, keys: Any) -> None:
    """Read back in mm of paper: all within the frame, the outline as large as the cam times its scale."""
    made = design(name, **keys)
    (cam, *_) = cam_sheets.discs(made)
    low, high = true_size._reach(cam, None)
    page, scale = paper.fitted(high - low)
    figure = true_size.workshop_drawing(made, 0)
    assert figure.get_size_inches() * 25.4 == pytest.approx((page.width, page.height), rel=1e-12, abs=0.0)
    lines = {line.get_gid(): line.get_xydata() for line in figure.axes[0].lines if line.get_gid()}
    profile = lines["profile"] @ [1.0, 1j]
    _, own = cam.points(np.linspace(0.0, 2.0 * math.pi, 7201))
    assert np.ptp(profile.real) == pytest.approx(scale * np.ptp(own.real), rel=1e-12)
    assert 20.0 <= profile.real.min() <= profile.real.max() <= page.width - 10.0
    assert scale in paper.SCALES
    words = {text.get_text() for text in figure.axes[0].texts}
    assert {f"{scale:g}:1" if scale >= 1.0 else f"1:{1.0 / scale:g}", page.name, "1 / 2"} <= words
    assert {f"{value:.3f}" for value in cam_sheets.pitch_radii(cam).tolist()} <= words
    if keys:
        assert any(text.startswith("⌀80 H7") and "keyway 22 P9" in text for text in words)
        hole = lines["bore"] @ [1.0, 1j]
        assert np.ptp(hole.real) == pytest.approx(80.0 * scale, rel=0.1)


def test_a_plateau_is_sought_at_its_ends_alone() -> None:
    """Each of its points had been refined: the rest of a mutilated gear took eight seconds."""
    asked = []

    def at(x: Any) -> tuple[Any, ...]:
        asked.append(len(x))
        place = np.clip(x, 100.0, 300.0)
        return place, np.where((x > 100.0) & (x < 300.0), 2.0, 0.0)

    course = motion_sheet.Course("slide", "angle [deg]", np.linspace(0.0, 360.0, 721), at, "mm")
    place, value = course.extreme(1, greatest=True)
    assert value == 2.0
    assert place == pytest.approx(100.0, abs=0.5)
    assert len(asked) < 20


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("name", "asked", "words"),
    [
        (
            "ty460",
            ("motion", "--show", "path:B"),
            "--show path:B applies only to the sheet vectors; only motion is drawn",
        ),
        (
            "ty460",
            ("motion", "timing", "--at", "30"),
            "--at 30 applies only to the sheet vectors; only motion, timing are drawn",
        ),
        ("ty460", ("--show", "path:Q"), "--show: this mechanism has no point 'Q'; it has B, C"),
        (
            "five_bar_function",
            ("vectors", "--at", "60,300"),
            "--at 300: the input angle runs from 48.89855 to 108.8986",
        ),
    ],
)
def test_what_the_vectors_cannot_show_is_refused_before_a_sheet_is_written(
    gearlink: Any, designs: Path, tmp_path: Path, name: str, asked: tuple[str, ...], words: str
) -> None:
    """It had been passed over, or drawn at an input that the mechanism does not reach."""
    ended = gearlink("sheet", designs / f"{name}.yaml", *asked, "--out", tmp_path / "out")
    assert ended.status == 2
    assert words in ended.err
    assert not (tmp_path / "out").exists()


@pytest.mark.slow
def test_an_input_beyond_a_revolution_is_drawn_within_it() -> None:
    """The mechanism had stood at the end of its loop, beside the polygons of the input."""
    one, other = (vector_sheet.draw(design("crank_rocker"), [place]).axes[0] for place in (400.0, 40.0))
    assert one.get_title(loc="left") == other.get_title(loc="left")
    for a, b in zip(one.lines, other.lines, strict=True):
        np.testing.assert_allclose(a.get_xydata(), b.get_xydata(), rtol=0.0, atol=1e-9)


def test_a_cam_under_a_flat_face_is_drawn_with_its_own_radii() -> None:
    """Of an eccentric of 6 mm, a circle: the radii by the law of cosines, and a face that touches it."""
    turn = {"to": 180, "lift": 12, "law": "simple-harmonic"}
    given = {
        "kind": "disc-cam", "speed": 60, "motion": [turn, {"to": 360, "lift": 0, "law": "simple-harmonic"}],
        "follower": {"type": "translating-flat"}, "cam": {"sense": 1, "base_radius": 40},
    }  # fmt: skip
    made = design(given)
    assert [name for name in sheets_of(made) if name not in ("motion", "vectors", "dwell")] == ["drawing-1"]
    (cam,) = cam_sheets.discs(made)
    away = np.radians(np.arange(360.0))
    # The mark is where the circle is nearest to the axis: 46 mm about a centre 6 mm behind it.
    radii = -6.0 * np.cos(away) + np.sqrt(46.0**2 - (6.0 * np.sin(away)) ** 2)
    assert cam_sheets.pitch_radii(cam) == pytest.approx(radii, abs=1e-6)
    words = " ".join(true_size.notes(made, cam))
    assert "Flat-faced follower" in words
    assert "radius of the profile [mm]" in words
    face, point = cam.face(), complex(cam.points(np.zeros(1))[0][0])
    assert 0.5 * (face[0] + face[1]) == pytest.approx(point, abs=1e-12)
    assert cam.points(np.linspace(0.0, 2.0 * math.pi, 721))[0].imag.max() <= 40.0 + 1e-9  # all below the face


@pytest.mark.parametrize(
    ("errors", "words"),
    [
        (None, "No tolerance in the file (errors.profile, tolerance.sources): profile and roughness as agreed."),
        (
            {"profile": 0.01, "run_out": 0.02},
            "Errors: profile ±0.01 mm; run-out 0.02 mm. Sizes without limits (tolerance.sources): as agreed. "
            "Roughness as agreed.",
        ),
    ],
)
def test_a_drawing_names_the_errors_of_the_file_and_the_keys_it_lacks(errors: Any, words: str) -> None:
    made = design(worked("loaded_cam"), **({} if errors is None else {"errors": errors}))
    (cam,) = cam_sheets.discs(made)
    assert words in true_size.notes(made, cam)
