"""The figures of a swing gripper: what is plotted is what the law, the tables and the cams say.

Tolerances: plotted values are the very numbers of the tables, so they are compared to rounding; drawn lengths come
back from coordinates of some 500 mm within 1e-9 mm; the files of two runs are compared byte by byte.
"""

from __future__ import annotations

import io
import json
import math
from pathlib import Path
from typing import Any

import factory
import numpy as np
import pytest
from sheets import Sheet, lines, named, odd_sheets, panel, panel_named, placed_sheet, points, scaled, sheet

from gearlink.cli.views.figures.swing_gripper import build
from gearlink.cli.views.scenes.scene import Body

LENGTHS = {"radius", "length", "input", "coupler", "output", "center", "arm", "shaft_radius"}
CASES = json.loads((Path(__file__).parents[2] / "reference" / "contract" / "gripper.json").read_text())
PAPER = next(case["spec"] for case in CASES if case["id"] == "paper-mechanism") | {"name": "paper"}
"""The machine of the swing-gripper paper, from the reference cases."""


@pytest.fixture(scope="module")
def gripper() -> Sheet:
    return sheet(PAPER, "gripper")


@pytest.fixture(scope="module")
def cam() -> Sheet:
    return sheet(PAPER, "cam")


# gripper


@pytest.mark.parametrize(("order", "ylabel"), [(0, "β ["), (1, "β′"), (2, "β″")])
def test_law_is_that_of_the_motion_table(gripper: Sheet, order: int, ylabel: str) -> None:
    made, figure = gripper
    line = panel_named(figure, ylabel).get_lines()[0]
    table = made.table("motion")
    column = np.asarray(table.data[table.columns.index(("beta", "output_velocity", "output_acceleration")[order])])
    expected = column if order == 0 else made.spec.swing_sense * column / made.shaft_speed**order
    np.testing.assert_array_equal(line.get_xdata()[::4], table.data[0])
    np.testing.assert_allclose(line.get_ydata()[::4], expected, rtol=1e-12, atol=1e-12)


@pytest.mark.slow
def test_axes_on_the_right_are_the_rates_in_time() -> None:
    made, figure = placed_sheet(PAPER, "gripper")
    figure.canvas.draw()
    for ylabel, factor in (("β′", made.shaft_speed), ("β″", made.shaft_speed**2)):
        axes = panel_named(figure, ylabel)
        right = next(child for child in axes.child_axes if child.get_ylabel())
        np.testing.assert_allclose(right.get_ylim(), np.asarray(axes.get_ylim()) * factor, rtol=1e-12)


def test_phases_are_shaded_and_named(gripper: Sheet) -> None:
    made, figure = gripper
    axes = panel_named(figure, "β [")
    names = next(child for child in axes.child_axes if child.get_xticklabels())
    wanted = ["accelerate", "constant", "decelerate", "far-dwell", "return", "near-dwell"]
    assert [label.get_text() for label in names.get_xticklabels()] == wanted
    assert [patch.get_bbox().x0 for patch in axes.patches] == pytest.approx(list(made.law.starts[:-1]), rel=1e-12)


def test_handover_is_marked_on_the_curves(gripper: Sheet) -> None:
    made, figure = gripper
    assert "106°, 2827.43 mm/s" in panel_named(figure, "β [").get_title(loc="left")
    for ylabel in ("β [", "β′", "β″"):
        axes = panel_named(figure, ylabel)
        curve = axes.get_lines()[0]
        dot = next(line for line in axes.get_lines() if line.get_marker() == "o")
        at_handover = np.interp(made.spec.handover, curve.get_xdata(), curve.get_ydata())
        assert (dot.get_xdata()[0], dot.get_ydata()[0]) == pytest.approx((106.0, at_handover), rel=1e-12)


@pytest.mark.parametrize(("label", "degrees"), [("pick-up, 0°", 0), ("handover, 106°", 106), ("far dwell, 162°", 162)])
def test_positions_close_and_agree_with_the_table(gripper: Sheet, label: str, degrees: int) -> None:
    made, figure = gripper
    a, c, d, e = points(lines(panel(figure, "Mechanism"))[label])
    assert (a, e) == (230.0 + 0.0j, 498.0 + 55.0j)
    assert [abs(c - a), abs(d - c), abs(e - d)] == pytest.approx([150.0, 260.0, 100.0], abs=1e-9)
    table = made.table("motion")
    for vector, column in ((c - a, "input_angle"), (d - e, "output_angle")):
        angle = table.data[table.columns.index(column)][degrees]
        assert np.angle(vector, deg=True) == pytest.approx(angle, abs=1e-9)


def test_drum_touches_the_tip_on_the_line_of_centres(gripper: Sheet) -> None:
    _, figure = gripper
    axes = panel(figure, "Mechanism")
    center = 498.0 + 55.0j + 435.0 * np.exp(1j * math.radians(99.8))
    drum, tip_path = (points(named(axes)[name]) for name in ("feed drum, radius 135 mm", "path of the sheet's edge"))
    np.testing.assert_allclose(np.abs(drum - center), 135.0, rtol=1e-12)
    # The path is sampled, and leaves the drum with the square of the angle: 0.03 mm a degree.
    assert np.abs(tip_path - center).min() == pytest.approx(135.0, abs=0.1)
    assert np.abs(tip_path - (498.0 + 55.0j)) == pytest.approx(np.full(tip_path.shape, 300.0), abs=1e-9)


@pytest.mark.slow
def test_given_axis_of_the_cylinder_is_drawn() -> None:
    figure = sheet(PAPER, "gripper", cylinder__center=[430.0, 480.0]).figure
    drum = points(named(panel(figure, "Mechanism"))["feed drum, radius 135 mm"])
    np.testing.assert_allclose(np.abs(drum - (430.0 + 480.0j)), 135.0, rtol=1e-12)


def test_torques_are_the_table_of_forces(gripper: Sheet) -> None:
    made, figure = gripper
    axes = panel(figure, "Torques")
    assert "lifts off at 14151" in axes.get_title(loc="left")
    table = made.table("forces")
    column = dict(zip(table.columns, table.data, strict=True))
    drawn_lines = {label.split(",")[0]: line for label, line in lines(axes).items()}
    for label, name in (
        ("inertia", "inertia_torque"),
        ("main roller", "contact_torque_main"),
        ("return roller", "contact_torque_return"),
    ):
        np.testing.assert_allclose(drawn_lines[label].get_ydata()[::4], column[name], rtol=1e-12, atol=1e-9)
    assert drawn_lines["spring 400 N m"].get_ydata()[0] == 400.0


# Stop and fingers


def test_finger_roller_touches_its_cam_through_the_turn() -> None:
    """The outline has a point each half degree, 1.3 mm apart: from its chords a circle of 8 mm is 0.05 mm off at most.

    The cam turns with the cylinder, the roller with the arm: neither is placed by the other.
    """
    fraction = np.linspace(0.0, 1.0, 37)
    made = factory.design("swing_gripper_stop")
    outlines = [part for part in build(made, fraction).parts if isinstance(part, Body)]
    at = [part.name for part in outlines].index("finger cam")
    cam, roller = outlines[at : at + 2]
    contour = cam.place + cam.outline[:, None] * np.exp(1j * cam.turn)
    assert np.unwrap(cam.turn)[-1] - cam.turn[0] == pytest.approx(2.0 * math.pi, rel=1e-12)
    np.testing.assert_allclose(np.abs(contour - roller.place).min(axis=0), 8.0, rtol=0.0, atol=0.06)


@pytest.mark.parametrize("sense", [1, -1])
def test_stop_touches_the_arm_at_the_pick_up_position_behind_it(sense: int) -> None:
    made = factory.design("swing_gripper_stop", swing_sense=sense)
    scene = build(made, np.array([0.0, 0.1]))
    block = next(part for part in scene.parts if getattr(part, "name", "") == "stop")
    corners = (block.place[0] + block.outline - complex(*made.spec.pivots.output)) * np.exp(-1j * math.radians(125.0))
    assert corners.real.min() < 280.0 < corners.real.max()
    assert sorted({round(y, 9) for y in corners.imag}) == sorted([0.0, -sense * 18.0])


# cam


@pytest.mark.parametrize("name", ["main cam", "return cam"])
def test_cam_outlines_are_the_tables(cam: Sheet, name: str) -> None:
    made, figure = cam
    table = made.table(name.replace(" ", "_"))
    profile = lines(panel(figure, "Cams"))[f"{name}, profile"]
    for values, column in ((profile.get_xdata(), "x"), (profile.get_ydata(), "y")):
        np.testing.assert_allclose(values[:-1:2], table.data[table.columns.index(column)], rtol=1e-12, atol=1e-9)


def test_rollers_touch_their_cams(cam: Sheet) -> None:
    axes = panel(cam.figure, "Cams")
    rollers = [patch for patch in axes.patches if getattr(patch, "radius", 0.0) == 30.0]
    for roller, name in zip(rollers, ("main cam", "return cam"), strict=True):
        line = lines(axes)[f"{name}, profile"]
        reach = np.abs(points(line) - complex(*roller.center)).min()
        assert reach == pytest.approx(30.0, abs=1e-6)
        assert abs(complex(*roller.center) - 230.0) == pytest.approx(160.0, abs=1e-9)


def test_pressure_angle_and_curvature_are_the_tables(cam: Sheet) -> None:
    made, figure = cam
    for name, color in (("main_cam", "#0072B2"), ("return_cam", "#D55E00")):
        table = made.table(name)
        for title, values in (
            ("Pressure angle", np.asarray(table.data[5])),
            ("Curvature", 1.0 / np.asarray(table.data[6])),
        ):
            line = next(each for each in panel(figure, title).get_lines() if each.get_color() == color)
            np.testing.assert_allclose(line.get_ydata()[:-1:2], values, rtol=1e-9, atol=1e-12)


def test_extremes_and_limits_are_named(cam: Sheet) -> None:
    made, figure = cam
    named = list(lines(panel(figure, "Pressure angle")))
    for cam_name, worst in zip(("main cam", "return cam"), made.max_pressure_angle, strict=True):
        assert any(label.startswith(f"{cam_name}, ≤ {math.degrees(worst):.4g}°") for label in named)
    assert "limit ±45°" in named
    limit = lines(panel(figure, "Curvature"))["undercut: 1/roller radius 30 mm"]
    assert limit.get_ydata()[0] == 1.0 / 30.0


# Every command, odd designs, files

BARE = {"cam": None, "inertia": None, "spring": None}
NARROW = {"accelerate": 102, "constant": 8, "decelerate": 50, "far_dwell": 2, "return": 196, "near_dwell": 2}
ODD: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "law and linkage alone": (BARE, ("gripper", "analyze")),
    "cam without forces": ({"inertia": None}, ("gripper", "cam")),
    "one roller": ({"cam__return_roller": None, "cam__shaft_radius": 40}, ("gripper", "cam")),
    "reserve": ({"spring__reserve": 50}, ("gripper",)),
    "narrow phases": ({"phases": NARROW}, ("gripper", "cam")),
    "tiny": (scaled(PAPER, 1e-6, LENGTHS), ("gripper", "cam")),
    "huge": (scaled(PAPER, 1e6, LENGTHS), ("gripper", "cam")),
    "mathematics in its name": ({"name": r"$\frac$ " * 20}, ("gripper",)),
}


@pytest.mark.slow  # what is drawn stands in the sheets of the other tests; placing is the same for all kinds
@pytest.mark.parametrize("command", ["gripper", "cam", "analyze"])
def test_every_command_draws(command: str) -> None:
    figure = placed_sheet(PAPER, command).figure
    figure.savefig(io.BytesIO(), format="png", dpi=40)
    assert f"paper: {command}" in figure.get_suptitle()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "drawn"), odd_sheets(ODD))
def test_odd_designs_draw_without_warnings(name: str, drawn: Any) -> None:
    keys, commands = ODD[name]
    for command in commands:
        drawn(PAPER, command, **keys)


def test_torques_are_left_out_where_the_file_has_none() -> None:
    figure = sheet(PAPER, "gripper", **BARE).figure
    assert not any(axes.get_title(loc="left").startswith("Torques") for axes in figure.axes)


@pytest.mark.slow
@pytest.mark.parametrize("command", ["gripper", "analyze"])
@pytest.mark.parametrize(
    "keys",
    [
        {"output_direction": 38.0, "limits__transmission_angle": 1.0},
        {"cam__center": None, "size__pressure_angle": 5.0},
    ],
    ids=["relative pole", "size"],
)
def test_the_motion_is_drawn_though_the_cam_is_impossible(command: str, keys: dict[str, Any]) -> None:
    figure = sheet("swing_gripper", command, **keys).figure
    assert panel(figure, "Mechanism at the pick-up position")
    assert not [axes for axes in figure.axes if axes.get_title(loc="left").startswith("Torques")]
