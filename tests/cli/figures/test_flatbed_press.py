"""The figures of a flatbed press: what is plotted is what the tables and the chains say.

Tolerances: plotted values are the very numbers of the tables, so they are compared exactly; drawn lengths come back
from coordinates of some 500 mm within 1e-9 mm; the SVG files of two runs are compared byte by byte.
"""

from __future__ import annotations

import io
import math
from typing import Any

import numpy as np
import pytest
from factory import worked
from sheets import Sheet, labels, lines, odd_sheets, panel, panel_named, placed_sheet, points, scaled, sheet
from sweeps import mostly_slow

LENGTHS = {"module", "horizontal_distance", "radius", "crank", "coupler", "rocker", "frame", "stroke", "rod", "offset"}
LENGTHS |= {"length", "print_length", "base_radius", "roller_radius"}


@pytest.fixture(scope="module")
def press() -> Sheet:
    return sheet("ty460", "press")


@pytest.fixture(scope="module")
def cam() -> Sheet:
    return sheet("ty460", "cam")


# press


@pytest.mark.parametrize("what", ["displacement", "velocity"])
@pytest.mark.parametrize("part", ["bed", "cylinder"])
def test_curves_are_the_table_of_positions(press: Sheet, what: str, part: str) -> None:
    axes = panel(press.figure, "Travel" if what == "displacement" else "Speed")
    line = lines(axes)[part]
    table = press.design.table("positions")
    column = table.data[table.columns.index(f"{part}_{what}")]
    np.testing.assert_allclose(line.get_xdata()[::60], table.data[0], rtol=0.0, atol=1e-12)
    np.testing.assert_allclose(line.get_ydata()[::60], column, rtol=1e-12, atol=1e-9)
    dots = next(each for each in axes.get_lines() if each.get_marker() == "o" and each.get_color() == line.get_color())
    np.testing.assert_array_equal(dots.get_ydata(), column)


@pytest.mark.slow
@pytest.mark.parametrize("what", ["displacement", "velocity"])
def test_the_bed_with_its_cam_is_drawn_besides(press: Sheet, what: str) -> None:
    line = lines(panel(press.figure, "Travel" if what == "displacement" else "Speed"))["bed with its cam"]
    np.testing.assert_array_equal(line.get_ydata()[::60], press.design.table("positions")[f"compensated_{what}"])
    assert "bed with its cam" not in lines(panel(sheet("ty460", "press", cam=None).figure, "Speed"))


def test_equal_speeds_stand_on_both_curves(press: Sheet) -> None:
    axes = panel(press.figure, "Speed")
    dots = next(line for line in axes.get_lines() if line.get_marker() == "D")
    assert dots.get_label() == "equal: 34.0°, 55.2°, 78.4°, 179.2°"
    assert dots.get_xdata()[0] == pytest.approx(math.degrees(press.design.sync_start), abs=1e-9)
    for part in ("bed", "cylinder"):
        curve = lines(axes)[part]
        at_dots = np.interp(dots.get_xdata(), curve.get_xdata(), curve.get_ydata())
        np.testing.assert_allclose(dots.get_ydata(), at_dots, rtol=1e-4)


def test_the_synchronous_zone_is_shaded_in_both_curves(press: Sheet) -> None:
    made, figure = press
    for title in ("Travel", "Speed"):
        box = panel(figure, title).patches[0].get_bbox()
        assert math.degrees(made.sync_start) == pytest.approx(box.x0, rel=1e-12)
        assert math.degrees(made.sync_end) == pytest.approx(box.x1, rel=1e-12)


def test_twelve_positions_of_the_bed_chain_keep_their_links(press: Sheet) -> None:
    chains = [line for line in panel(press.figure, "Bed drive").get_lines() if line.get_linewidth() == 0.6]
    assert len(chains) == 12
    made = press.design
    for chain in chains:
        joints = points(chain)
        links = np.abs(np.diff(joints))
        np.testing.assert_allclose(links, [116.0, 100.0, 100.0, made.crank_length, 520.0], rtol=0.0, atol=1e-9)


def test_bed_arrows_are_its_speeds_to_one_scale(press: Sheet) -> None:
    axes = panel(press.figure, "Bed drive")
    (quiver,) = [each for each in axes.collections if hasattr(each, "U")]
    table = press.design.table("positions")
    speed = np.asarray(table.data[table.columns.index("bed_velocity")])
    # Printing runs to the right in the figure.
    scale = quiver.U[4] / speed[4]
    np.testing.assert_allclose(quiver.U, scale * speed, rtol=1e-12, atol=1e-12)
    assert not np.any(quiver.V)
    assert quiver.scale == 1.0
    key = next(each for each in axes.artists if hasattr(each, "text"))
    assert key.text.get_text() == "bed: 2000 mm/s"
    assert pytest.approx(2000.0 * scale, rel=1e-12) == key.U


def test_cylinder_arrows_are_the_velocity_of_m(press: Sheet) -> None:
    axes = panel(press.figure, "Cylinder drive")
    (quiver,) = [each for each in axes.collections if hasattr(each, "U")]
    table = press.design.table("positions")
    surface = np.asarray(table.data[table.columns.index("cylinder_velocity")])
    length = np.hypot(quiver.U, quiver.V)
    np.testing.assert_allclose(length / length[0], surface / surface[0], rtol=1e-12)
    arm = (quiver.X + 1j * quiver.Y) - 40.0j
    np.testing.assert_allclose(np.abs(arm), 95.0, rtol=0.0, atol=1e-9)
    np.testing.assert_allclose(np.real(np.conj(arm) * (quiver.U + 1j * quiver.V)), 0.0, rtol=0.0, atol=1e-9)


@pytest.mark.parametrize(("title", "value"), [("Bed drive", "46.532°"), ("Cylinder drive", "35.724°")])
def test_least_transmission_angle_is_drawn_and_named(press: Sheet, title: str, value: str) -> None:
    axes = panel(press.figure, title)
    (name,) = [label for label in labels(axes) if label.startswith("minimum transmission angle")]
    assert value in name
    line = lines(axes)[name]
    joints = points(line)
    before, after = joints[1] - joints[2], joints[3] - joints[2]
    angle = abs(np.angle(after / before, deg=True))
    assert min(angle, 180.0 - angle) == pytest.approx(float(value[:-1]), abs=5e-4)


# cam


@pytest.mark.slow
@pytest.mark.parametrize(
    ("column", "ylabel"), [(1, "lift [mm]"), (2, "velocity [mm/rad]"), (3, "acceleration [mm/rad²]")]
)
def test_follower_curves_are_the_table(cam: Sheet, column: int, ylabel: str) -> None:
    line = panel_named(cam.figure, ylabel).get_lines()[0]
    table = cam.design.table("follower")
    np.testing.assert_array_equal(line.get_xdata()[::4], table.data[0])
    np.testing.assert_allclose(line.get_ydata()[::4], table.data[column], rtol=1e-12, atol=1e-12)


def test_phases_are_shaded_and_named(cam: Sheet) -> None:
    axes = panel_named(cam.figure, "lift [mm]")
    (names,) = axes.child_axes
    named = [label.get_text() for label in names.get_xticklabels()]
    assert named == ["lead-in", "sync", "transition", "return", "dwell"]
    bounds = [patch.get_bbox().x0 for patch in axes.patches]
    follower = cam.design.follower
    starts = [math.degrees(segment.start) for segment in follower.segments]
    assert bounds == pytest.approx([*starts, 0.0], rel=1e-12)
    # The dwell runs through the end of the turn.
    assert axes.patches[-1].get_bbox().x1 == pytest.approx(starts[0], rel=1e-12)


@pytest.mark.parametrize("name", ["main cam", "return cam"])
def test_cam_outlines_are_the_tables(cam: Sheet, name: str) -> None:
    axes = panel(cam.figure, "Main and return cam")
    table = cam.design.table(name.replace(" ", "_"))
    profile = lines(axes)[f"{name}, profile"]
    for drawn_at, column in ((profile.get_xdata(), "x"), (profile.get_ydata(), "y")):
        values = table.data[table.columns.index(column)]
        np.testing.assert_allclose(drawn_at[:-1:2], values, rtol=1e-12, atol=1e-9)
        assert drawn_at[-1] == pytest.approx(drawn_at[0], abs=1e-9)
    (pitch,) = [
        line
        for line in axes.get_lines()
        if line.get_label() == "pitch curve" and line.get_color() == profile.get_color()
    ]
    np.testing.assert_allclose(
        pitch.get_xdata()[:-1:2], table.data[table.columns.index("pitch_x")], rtol=0.0, atol=1e-9
    )


def test_rollers_touch_their_cams_on_the_line(cam: Sheet) -> None:
    axes = panel(cam.figure, "Main and return cam")
    rollers = [patch for patch in axes.patches if getattr(patch, "radius", 0.0) == 25.0]
    assert [roller.center[1] for roller in rollers] == pytest.approx([0.0, 0.0], abs=1e-12)
    right, left = (roller.center[0] for roller in rollers)
    assert right - left == pytest.approx(cam.design.roller_center_distance, rel=1e-12)
    for roller, name in zip(rollers, ("main cam", "return cam"), strict=True):
        line = lines(axes)[f"{name}, profile"]
        reach = np.hypot(line.get_xdata() - roller.center[0], line.get_ydata() - roller.center[1]).min()
        assert reach == pytest.approx(25.0, abs=1e-9)


def test_pressure_angle_and_curvature_are_the_tables(cam: Sheet) -> None:
    made, figure = cam
    for name in ("main_cam", "return_cam"):
        table = made.table(name)
        color = "#0072B2" if name == "main_cam" else "#D55E00"
        for title, values in (
            ("Pressure angle", np.asarray(table.data[5])),
            ("Curvature", 1.0 / np.asarray(table.data[6])),
        ):
            axes = panel(figure, title)
            line = next(each for each in axes.get_lines() if each.get_color() == color)
            np.testing.assert_allclose(line.get_ydata()[:-1:2], values, rtol=1e-12, atol=1e-12)


def test_limits_are_drawn(cam: Sheet) -> None:
    assert labels(panel(cam.figure, "Pressure angle"))[-1] == "limit ±30°"
    limit = lines(panel(cam.figure, "Curvature"))["undercut: 1/roller radius 25 mm"]
    assert limit.get_ydata()[0] == 1.0 / 25.0


def test_compensation_is_the_gap_of_the_two_travels(cam: Sheet) -> None:
    axes = panel(cam.figure, "Compensation")
    line = axes.get_lines()[0]
    assert line.get_xdata()[[0, -1]] == pytest.approx(
        np.degrees([cam.design.sync_start, cam.design.sync_end]), rel=1e-12
    )
    assert line.get_ydata()[[0, -1]] == pytest.approx([0.0, cam.design.compensation], abs=1e-9)


# Every command, odd designs, files

ODD: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "arc without lead-in": ({"cam__lead_in": 0, "cam__transition": "arc"}, ("cam",)),
    "zone from the start": ({"sync": {"start": 0, "length": 300}, "cam__lead_in": 30}, ("press", "cam")),
    "no cam, no gears": ({"cam": None, "input_gears": None}, ("press", "analyze")),
    "other offset": ({"bed__offset": -120, "bed__crank_offset_angle": -90}, ("press",)),
    "bed chain mirrored": ({"bed__double_crank__assembly": -1}, ("press",)),
    "tiny": (scaled(worked("ty460"), 1e-6, LENGTHS), ("press", "cam", "crank")),
    "huge": (scaled(worked("ty460"), 1e6, LENGTHS), ("press", "cam", "crank")),
}


@pytest.mark.slow
@pytest.mark.parametrize("command", mostly_slow(["crank", "press", "cam", "analyze", "gear"], 1))
def test_every_command_draws(command: str) -> None:
    figure = placed_sheet("ty460", command).figure
    figure.savefig(io.BytesIO(), format="png", dpi=40)
    assert f"TY-460: {command}" in figure.get_suptitle()


@pytest.mark.slow
@pytest.mark.parametrize(("name", "drawn"), odd_sheets(ODD))
def test_odd_designs_draw_without_warnings(name: str, drawn: Any) -> None:
    keys, commands = ODD[name]
    for command in commands:
        drawn("ty460", command, **keys)


@pytest.mark.slow
def test_a_name_of_mathematics_is_placed_as_text() -> None:
    placed_sheet("ty460", "crank", name=r"$\frac$ " * 20)


@pytest.mark.slow
@pytest.mark.parametrize("command", mostly_slow(["press", "cam"], 1))
def test_no_legend_lies_on_curves(command: str) -> None:
    """Legends of curve panels stand above their axes."""
    for axes in placed_sheet("ty460", command).figure.axes:
        if axes.get_legend() and axes.axison and axes.get_ylabel():
            assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1 - 1.0


@pytest.mark.slow
def test_the_shaft_is_drawn_where_the_file_gives_one() -> None:
    axes = panel(sheet("ty460", "cam", cam__shaft_radius=35.0).figure, "Main and return cam")
    (shaft,) = [patch for patch in axes.patches if getattr(patch, "radius", 0.0) == 35.0]
    assert shaft.center == (0.0, 0.0)
    assert "shaft, 35 mm" in [line.get_label() for line in axes.get_lines()]


def test_without_cams_the_lower_rack_is_fixed() -> None:
    """It was "moved by the cams" that the press does not have."""
    _, figure = sheet("ty460", "press", cam=None)
    texts = [text.get_text() for axes in figure.axes for text in axes.texts]
    assert "fixed rack" in texts
    assert "rack moved by the cams" not in texts
