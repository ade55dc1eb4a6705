"""Pictures of cams and of mechanisms of any kind: what stands still, what turns and what fails is drawn so."""

from __future__ import annotations

import cmath
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from factory import changed, design
from sheets import lines, meetings, panel, panel_named, points, sheet, tagged

from gearlink.cli import opening
from gearlink.cli.views.figures import cams, of_motion
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.sheets import motion_sheet, true_size
from gearlink.cli.views.figures.write import draw
from gearlink.cli.views.scenes.scene import Body, Chain
from gearlink.core.mechanism import vectors

MOTION = [
    {"to": 120, "lift": 15, "law": "modified-sine"},
    {"to": 180},
    {"to": 300, "lift": 0, "law": "polynomial-4567"},
    {"to": 360},
]
FLAT: dict[str, Any] = {
    "kind": "disc-cam",
    "motion": MOTION,
    "follower": {"type": "translating-flat", "direction": 70},
    "cam": {"base_radius": 25, "sense": -1},
}
ROCKER = {**FLAT, "follower": {"type": "oscillating-flat", "center_distance": 120, "face_offset": 5}}
STEEP: dict[str, Any] = {
    **FLAT,
    "motion": [{"to": 60, "lift": 30, "law": "modified-sine"}, {"to": 150}, {"to": 240, "lift": 0}, {"to": 360}],
    "follower": {"type": "translating-roller", "roller_radius": 22},
    "cam": {"prime_radius": 38, "sense": -1},
    "limits": {"pressure_angle": [35, 25]},
}
SHARES = np.linspace(0.0, 1.0, 9)


def _chains(data: dict[str, Any]) -> list[Chain]:
    return [part for part in cams.build(design(data), SHARES).parts if isinstance(part, Chain)]


def test_the_rod_of_a_flat_face_stays_on_its_line_of_travel() -> None:
    """It ran along the face with the contact."""
    face, rod = _chains(FLAT)
    travel = cmath.exp(1j * math.radians(70.0))
    for end in rod.joints:
        assert np.abs((end / travel).imag).max() < 1e-12
    assert np.abs(((face.joints[1] - face.joints[0]) / travel).real).max() < 1e-12, "the face lies across"
    touch = design(FLAT).cams.flat.touch(2.0 * math.pi * SHARES).point
    for k, place in enumerate(touch):
        ends = [complex(joint[k]) for joint in face.joints]
        assert abs(ends[0] - place) + abs(ends[1] - place) == pytest.approx(abs(ends[1] - ends[0]), rel=1e-12)


def test_the_face_of_a_rocker_hangs_on_its_pivot() -> None:
    """It floated, with no link to A."""
    (arm,) = _chains(ROCKER)
    made = design(ROCKER)
    pivot, foot, end = arm.joints
    assert np.abs(pivot - made.cams.pivot).max() < 1e-12
    assert np.abs(foot - pivot) == pytest.approx(5.0, rel=1e-12)
    touch = made.cams.flat.touch(2.0 * math.pi * SHARES)
    assert np.abs(((end - foot) * touch.normal.conjugate()).real).max() < 1e-9, "along the tangent of the cam"
    assert np.abs(((touch.point - foot) * touch.normal.conjugate()).real).max() < 1e-9


@pytest.mark.parametrize("kind", ["translating-flat", "translating-knife-edge"])
def test_the_block_of_a_slide_is_off_the_cam(kind: str) -> None:
    """It lay on the face, half in the cam."""
    made = design({**FLAT, "follower": {"type": kind, "direction": 70}})
    blocks = [part for part in cams.build(made, SHARES).parts if isinstance(part, Body) and len(part.outline) == 5]
    (block,) = blocks
    along = (block.place * cmath.exp(-1j * math.radians(70.0))).real
    assert (along - np.abs(block.outline).max() > 25.0 + made.cams.motion.evaluate(2.0 * math.pi * SHARES, 0)[0]).all()


@pytest.mark.parametrize("sense", [1, -1])
@pytest.mark.parametrize("side", [1, -1])
def test_a_knife_edge_stands_with_its_tip_on_the_profile_outside_the_cam(sense: int, side: int) -> None:
    parts = {"arm": 100, "center_distance": 120, "side": side, "pivot_direction": 30}
    for follower in (
        {"type": "oscillating-knife-edge", **parts},
        {"type": "translating-knife-edge", "offset": 5.0 * side},
    ):
        made = design({**FLAT, "follower": follower, "cam": {"base_radius": 50, "sense": sense}})
        cam, *_, edge = [part for part in cams.build(made, SHARES).parts if isinstance(part, Body)]
        assert edge.outline[0] == 0.0
        turned = np.exp(-1j * cam.turn)
        assert np.abs(turned * edge.place - made.cams.main.points(2.0 * math.pi * SHARES)[1]).max() < 1e-9
        for share in (0.2, 1.0):
            corners = edge.place + share * np.exp(1j * edge.turn) * edge.outline[1:3, None]
            radius = made.cams.main.radius(2.0 * math.pi * SHARES)
            assert (np.abs(corners) > radius).all()


def test_the_drawing_of_a_knife_edge_says_so() -> None:
    made = design({**FLAT, "follower": {"type": "translating-knife-edge"}})
    words = " ".join(true_size.notes(made, made.cams.main))
    assert true_size.workshop_drawing(made, 0).axes
    for each in ("Knife-edge follower", "radius of the profile", "the path of the edge", "edge at cam angle 0"):
        assert each in words


def test_both_rollers_of_a_conjugate_cam_hang_on_their_follower() -> None:
    """That of the return cam floated."""
    data = {**FLAT, "closure": "conjugate", "cam": {"prime_radius": 75},
            "follower": {"type": "oscillating-roller", "roller_radius": 12, "arm": 90, "center_distance": 130},
            "return_roller": {"angle": 70, "radius": 12, "arm": 80}}  # fmt: skip
    made = design(data)
    found = _chains(data)
    phi = 2.0 * math.pi * SHARES
    for cam, arm in ((made.cams.main, 90.0), (made.cams.back, 80.0)):
        (bar,) = [each for each in found if np.abs(each.joints[-1] - cam.path(phi, 1).position).max() < 1e-9
                  or np.abs(each.joints[0] - cam.path(phi, 1).position).max() < 1e-9]  # fmt: skip
        assert np.abs(bar.joints[-1] - bar.joints[0]) == pytest.approx(arm, rel=1e-9)


def test_the_inner_wall_of_a_groove_lies_on_the_outer_one() -> None:
    """It was under it, and not to be seen."""
    data = {**FLAT, "follower": {"type": "translating-roller", "roller_radius": 10}, "cam": {"prime_radius": 60}}
    bodies = [
        part for part in cams.build(design({**data, "closure": "groove"}), SHARES).parts if isinstance(part, Body)
    ]
    outer, inner = (float(np.abs(body.outline).max()) for body in bodies[:2])
    assert outer == pytest.approx(inner + 20.0, abs=0.5)


@pytest.mark.slow
def test_a_steep_cam_is_red_where_its_pressure_angle_passes_the_limit_of_its_stroke() -> None:
    made, figure = sheet(STEEP, "cam")
    axes = panel(figure, "Pressure angle")
    found = lines(axes)
    (curve,) = (line for name, line in found.items() if name.startswith("main cam"))
    degrees = np.asarray(curve.get_xdata())
    angle = np.degrees(made.cams.main.pressure_angle(np.radians(degrees)))
    assert np.array_equal(curve.get_ydata(), angle)
    red = {round(float(x), 6) for line in tagged(figure, "fails") if line.axes is axes
           for x, y in zip(line.get_xdata(), line.get_ydata(), strict=True) if np.isfinite(y)}  # fmt: skip
    inside = (degrees > 1.0) & (degrees < 359.0)
    for low, high, limit in ((0.0, 60.0, 35.0), (150.0, 240.0, 25.0)):
        over = inside & (degrees > low) & (degrees < high) & (np.abs(angle) > limit)
        assert over.any()
        assert set(degrees[over].round(6).tolist()) <= red
    assert len(red) <= sum(
        ((degrees >= low) & (degrees <= high) & (np.abs(angle) > limit)).sum() + 4
        for low, high, limit in ((0.0, 60.0, 35.0), (150.0, 240.0, 25.0))
    )


@pytest.mark.slow
def test_a_face_is_red_on_the_cam_where_it_undercuts() -> None:
    data = changed(ROCKER, cam={"base_radius": 35, "sense": 1})
    made, figure = sheet(data, "cam")
    (red,) = tagged(figure, "fails")
    radius = made.cams.flat.touch(np.linspace(0.0, 2.0 * math.pi, 721)).radius
    assert red.get_color() == style.WRONG
    assert np.isfinite(red.get_ydata()).sum() == pytest.approx((radius < 0.0).sum(), abs=2)
    assert (radius < 0.0).any()


@pytest.mark.slow
@pytest.mark.parametrize("name", ["planar_cam", "crank_rocker_links", "lift_cam"])
def test_the_arrow_stands_about_the_axis_of_the_input(name: str) -> None:
    """In the picture of a cam that moves a lever it stood at the lever."""
    made, figure = sheet(name)
    (arc,) = tagged(figure, "sense")
    z = points(arc)  # the axis is the origin
    assert np.ptp(np.abs(z)) < 1e-9 * np.abs(z).max()
    sense = made.spec.cam.sense if name == "lift_cam" else 1
    assert sense * float(np.angle(z[-1] / z[0])) > 0.0


@pytest.mark.slow
def test_a_high_mechanism_stands_beside_its_curves() -> None:
    """It was a dot in a panel as wide as the page."""
    figure = sheet("planar_bed_chain").figure
    drawing, *curves = figure.axes
    assert drawing.get_subplotspec().rowspan.stop == 3
    assert {axes.get_subplotspec().colspan.start for axes in curves[:3]} == {1}
    assert sheet("crank_rocker_links").figure.axes[0].get_subplotspec().colspan.stop == 1


@pytest.mark.slow
def test_curves_over_the_input_have_its_time_where_the_speed_is_known() -> None:
    for name, label, turn in (("planar_cam", "acceleration", 500.0), ("lift_cam", "pressure", 300.0)):
        axes = panel_named(sheet(name).figure, label)
        (row,) = (each for each in axes.child_axes if each.get_gid() == "time")
        assert row._functions[0](np.array([360.0])) == pytest.approx(turn, rel=1e-12)
    assert not panel_named(sheet("crank_rocker_links", loads=None).figure, "acceleration").child_axes


@pytest.mark.slow
def test_instants_that_fail_are_red_on_the_curves_over_the_input() -> None:
    """The picture of a crank-rocker said that its transmission angle fails, and not where."""
    made = design("crank_rocker_links", limits__transmission_angle=60.0)
    figure = draw("analyze", made, made.check("transmission-angle"))
    red = [line for line in tagged(figure, "fails") if hasattr(line, "get_xdata")]
    assert len(red) == 3
    table = made.table("motion", samples=720)
    low = np.interp(red[0].get_xdata(), table["crank_angle"], table["transmission_angle"], period=360.0) < 60.0
    shown = np.isfinite(np.asarray(red[0].get_ydata(), dtype=float))
    assert (shown != low).sum() <= 6  # a step at either end of the two stretches, and their neighbours
    assert low.any()
    assert not tagged(draw("analyze", design("crank_rocker_links")), "fails")


@pytest.mark.slow
def test_instants_that_fail_are_red_on_sheets_of_motion(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    made = design("lift_cam", limits__pressure_angle=20.0)
    figure = motion_sheet.draw(made)
    of_motion.instants(figure, made, made.check("pressure-angle"))
    red = tagged(figure, "fails")
    assert len(red) == 4
    degrees = np.asarray(red[1].get_xdata())
    over = np.abs(np.degrees(made.cams.main.pressure_angle(np.radians(degrees)))) > 20.0
    assert (np.isfinite(np.asarray(red[1].get_ydata(), dtype=float)) != over).sum() <= 8
    assert meetings(settled(figure)) == []
    line = (
        "sheet",
        designs / "swing_gripper.yaml",
        "motion",
        "--set",
        "limits.pressure_angle=20",
        "--plot-format",
        "svg",
    )
    assert gearlink(*line, "--out", tmp_path).status == 0
    assert 'id="fails' in (tmp_path / "swing-gripper-motion.svg").read_text()


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "limit", "least"),
    [
        ("hypocycloid_slider", 75.0, "F"),
        ("five_bar_positions", 60.0, "D"),
        ("wide_swing_slider", 80.0, "F"),
        ("ty460", 40.0, "M"),
        ("swing_gripper", 72.0, "D"),
    ],
)
def test_stretches_of_a_small_transmission_angle_are_red_on_every_sheet_of_motion(
    name: str, limit: float, least: str
) -> None:
    """Of these kinds, whose tables do not have the angle, no instant was red."""
    made = design(name, limits__transmission_angle=limit)
    figure = motion_sheet.draw(made)
    of_motion.instants(figure, made, made.check("transmission-angle"))
    red = tagged(figure, "fails")
    assert len(red) == sum(len(column) for column in vars(figure)["over_input"])
    x = np.asarray(red[0].get_xdata())
    angle = vectors.transmission_angles(made.moving.at(np.radians(x), 1), (least,))[least]
    low, shown = np.degrees(angle) < limit, np.isfinite(np.asarray(red[0].get_ydata(), dtype=float))
    assert low.any()
    assert not low.all()
    assert (shown != low).sum() <= 12  # a step at either end of each stretch, and their neighbours


def test_the_picture_of_a_four_bar_has_the_path_of_its_coupler_point() -> None:
    """P at the crank angles of its table, within the chord of a degree."""
    made, figure = sheet("crank_rocker_links")
    table = made.table("path")
    lines = [line.get_xydata() @ [1.0, 1j] for line in figure.axes[0].lines if len(line.get_xdata()) == 361]
    at = np.asarray(table["x"]) + 1j * np.asarray(table["y"])
    assert any(max(np.abs(line - each).min() for each in at.tolist()) < 0.5 for line in lines)
    assert any("path of P" in text.get_text() for text in figure.axes[0].texts)
    (axes, *_) = sheet("crank_rocker").figure.axes
    assert not any(len(line.get_xdata()) == 361 for line in axes.lines)


def test_a_cylindrical_cam_shows_where_its_pressure_angle_is_too_large() -> None:
    """tan(alpha) = s'/x with the peak 1.7596 h/beta of modified sine, at the bottom and at the outside of the track."""
    motion = [{"to": 100, "lift": 40, "law": "modified-sine"}, {"to": 180}, {"to": 320, "lift": 0, "law": "cycloidal"},
              {"to": 360}]  # fmt: skip
    follower = {"type": "translating-roller", "roller_radius": 8}
    made = opening.design(kind="cylindrical-cam", motion=motion, follower=follower, cam={"radius": 62, "depth": 12})
    axes = opening.figure(made, "cam").axes
    shown = next(each for each in axes if each.get_ylabel().startswith("pressure"))
    curves = {str(line.get_label()).partition(",")[0]: line for line in shown.lines}
    for name, x in (("bottom", 50.0), ("outside", 62.0)):
        steepest = math.degrees(math.atan(1.7596 * 40.0 / math.radians(100.0) / x))
        assert float(np.max(curves[name].get_ydata())) == pytest.approx(steepest, rel=2e-5)  # of the constant's digits
    over = np.abs(np.asarray(curves["bottom"].get_ydata())) > 30.0
    red = np.isfinite(np.asarray(curves["above the limit"].get_ydata(), dtype=float))
    assert over.any()
    assert (red != over).sum() <= 8  # a step at either end of the two stretches
