"""The figures of a swing gripper: what is plotted is what the law, the tables and the cams say.

Tolerances: plotted values are the very numbers of the tables, so they are compared to rounding; drawn lengths come
back from coordinates of some 500 mm within 1e-9 mm; the files of two runs are compared byte by byte.
"""

from __future__ import annotations

import copy
import io
import json
import math
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from matplotlib.figure import Figure

from gearlink.cli.figures.write import draw
from gearlink.core.kinds import KINDS

KIND = KINDS["swing-gripper"]
LENGTHS = {"radius", "length", "input", "coupler", "output", "center", "arm", "shaft_radius"}


def gripper_file() -> dict[str, Any]:
    """The machine of the swing-gripper paper, from the reference cases."""
    text = (Path(__file__).parents[2] / "reference" / "contract" / "gripper.json").read_text()
    data: dict[str, Any] = next(case["spec"] for case in json.loads(text) if case["id"] == "paper-mechanism")
    return {**copy.deepcopy(data), "name": "paper"}


def changed(changes: dict[str, Any]) -> dict[str, Any]:
    """The gripper with keys changed; None takes a key out."""
    data = gripper_file()
    for path, value in changes.items():
        *parents, key = path.split(".")
        section = data
        for parent in parents:
            section = section[parent]
        section.pop(key) if value is None else section.update({key: value})
    return data


def scaled(data: Any, factor: float, key: str = "") -> Any:
    """The same machine, larger or smaller; torques and inertia are left as they are."""
    if isinstance(data, dict):
        kept = {"inertia", "spring"}
        return {name: value if name in kept else scaled(value, factor, name) for name, value in data.items()}
    if isinstance(data, list):
        return [value * factor for value in data]
    return data * factor if key in LENGTHS else data


def design(data: dict[str, Any], command: str) -> Any:
    return KIND.design(command, KIND.spec_model().model_validate(data))


def drawn(command: str, data: dict[str, Any] | None = None) -> tuple[Any, Figure]:
    made = design(data or gripper_file(), command)
    return made, draw(command, made)


def panel(figure: Figure, title: str) -> Any:
    return next(axes for axes in figure.axes if axes.get_title(loc="left").startswith(title))


def panel_named(figure: Figure, ylabel: str) -> Any:
    return next(axes for axes in figure.axes if axes.get_ylabel().replace("\n", " ").startswith(ylabel))


def lines(axes: Any) -> dict[str, Any]:
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def joints(line: Any) -> Any:
    return line.get_xdata() + 1j * line.get_ydata()


@pytest.fixture(scope="module")
def gripper() -> tuple[Any, Figure]:
    return drawn("gripper")


@pytest.fixture(scope="module")
def cam() -> tuple[Any, Figure]:
    return drawn("cam")


# gripper


@pytest.mark.parametrize(("order", "ylabel"), [(0, "β ["), (1, "β′"), (2, "β″")])
def test_law_is_that_of_the_motion_table(gripper: tuple[Any, Figure], order: int, ylabel: str) -> None:
    made, figure = gripper
    line = panel_named(figure, ylabel).get_lines()[0]
    table = made.table("motion")
    column = np.asarray(table.data[table.columns.index(("beta", "output_velocity", "output_acceleration")[order])])
    expected = column if order == 0 else made.spec.swing_sense * column / made.shaft_speed**order
    np.testing.assert_array_equal(line.get_xdata()[::4], table.data[0])
    np.testing.assert_allclose(line.get_ydata()[::4], expected, rtol=1e-12, atol=1e-12)


def test_axes_on_the_right_are_the_rates_in_time(gripper: tuple[Any, Figure]) -> None:
    made, figure = gripper
    figure.canvas.draw()
    for ylabel, factor in (("β′", made.shaft_speed), ("β″", made.shaft_speed**2)):
        axes = panel_named(figure, ylabel)
        right = next(child for child in axes.child_axes if child.get_ylabel())
        np.testing.assert_allclose(right.get_ylim(), np.asarray(axes.get_ylim()) * factor)


def test_phases_are_shaded_and_named(gripper: tuple[Any, Figure]) -> None:
    made, figure = gripper
    axes = panel_named(figure, "β [")
    names = next(child for child in axes.child_axes if child.get_xticklabels())
    wanted = ["accelerate", "constant", "decelerate", "far-dwell", "return", "near-dwell"]
    assert [label.get_text() for label in names.get_xticklabels()] == wanted
    assert [patch.get_bbox().x0 for patch in axes.patches] == pytest.approx(list(made.law.starts[:-1]))


def test_handover_is_marked_on_the_curves(gripper: tuple[Any, Figure]) -> None:
    made, figure = gripper
    assert "106°, 2827.43 mm/s" in panel_named(figure, "β [").get_title(loc="left")
    for ylabel in ("β [", "β′", "β″"):
        axes = panel_named(figure, ylabel)
        curve = axes.get_lines()[0]
        dot = next(line for line in axes.get_lines() if line.get_marker() == "o")
        at_handover = np.interp(made.spec.handover, curve.get_xdata(), curve.get_ydata())
        assert (dot.get_xdata()[0], dot.get_ydata()[0]) == pytest.approx((106.0, at_handover))


@pytest.mark.parametrize(("label", "degrees"), [("bite, 0°", 0), ("handover, 106°", 106), ("far dwell, 162°", 162)])
def test_positions_close_and_agree_with_the_table(gripper: tuple[Any, Figure], label: str, degrees: int) -> None:
    made, figure = gripper
    a, c, d, e = joints(lines(panel(figure, "Mechanism"))[label])
    assert (a, e) == (230.0 + 0.0j, 498.0 + 55.0j)
    assert [abs(c - a), abs(d - c), abs(e - d)] == pytest.approx([150.0, 260.0, 100.0], abs=1e-9)
    table = made.table("motion")
    for vector, column in ((c - a, "input_angle"), (d - e, "output_angle")):
        angle = table.data[table.columns.index(column)][degrees]
        assert np.angle(vector, deg=True) == pytest.approx(angle, abs=1e-9)


def test_drum_touches_the_tip_on_the_line_of_centres(gripper: tuple[Any, Figure]) -> None:
    _, figure = gripper
    axes = panel(figure, "Mechanism")
    drum = next(patch for patch in axes.patches if getattr(patch, "radius", 0.0) == 135.0)
    center, tip_path = complex(*drum.center), joints(lines(axes)["path of the sheet's edge"])
    expected = 498.0 + 55.0j + 435.0 * np.exp(1j * math.radians(99.8))
    assert center == pytest.approx(expected, abs=1e-9)
    # The path is sampled, and leaves the drum with the square of the angle: 0.03 mm a degree.
    assert np.abs(tip_path - center).min() == pytest.approx(135.0, abs=0.1)
    assert np.abs(tip_path - (498.0 + 55.0j)) == pytest.approx(np.full(tip_path.shape, 300.0), abs=1e-9)


def test_given_axis_of_the_cylinder_is_drawn(gripper: tuple[Any, Figure]) -> None:
    data = changed({"cylinder.center": [430.0, 480.0]})
    _, figure = drawn("gripper", data)
    axes = panel(figure, "Mechanism")
    assert any(getattr(patch, "center", None) == (430.0, 480.0) for patch in axes.patches)


def test_torques_are_the_table_of_forces(gripper: tuple[Any, Figure]) -> None:
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
    assert drawn_lines["spring 400"].get_ydata()[0] == 400.0


# cam


@pytest.mark.parametrize("name", ["main cam", "return cam"])
def test_cam_outlines_are_the_tables(cam: tuple[Any, Figure], name: str) -> None:
    made, figure = cam
    table = made.table(name.replace(" ", "_"))
    profile = lines(panel(figure, "Cams"))[f"{name}, profile"]
    for values, column in ((profile.get_xdata(), "x"), (profile.get_ydata(), "y")):
        np.testing.assert_allclose(values[:-1:2], table.data[table.columns.index(column)], rtol=1e-12, atol=1e-9)


def test_rollers_touch_their_cams(cam: tuple[Any, Figure]) -> None:
    axes = panel(cam[1], "Cams")
    rollers = [patch for patch in axes.patches if getattr(patch, "radius", 0.0) == 30.0]
    for roller, name in zip(rollers, ("main cam", "return cam"), strict=True):
        line = lines(axes)[f"{name}, profile"]
        reach = np.abs(joints(line) - complex(*roller.center)).min()
        assert reach == pytest.approx(30.0, abs=1e-6)
        assert abs(complex(*roller.center) - 230.0) == pytest.approx(160.0, abs=1e-9)


def test_pressure_angle_and_curvature_are_the_tables(cam: tuple[Any, Figure]) -> None:
    made, figure = cam
    for name, color in (("main_cam", "#0072B2"), ("return_cam", "#D55E00")):
        table = made.table(name)
        for title, values in (
            ("Pressure angle", np.asarray(table.data[5])),
            ("Curvature", 1.0 / np.asarray(table.data[6])),
        ):
            line = next(each for each in panel(figure, title).get_lines() if each.get_color() == color)
            np.testing.assert_allclose(line.get_ydata()[:-1:2], values, rtol=1e-9, atol=1e-12)


def test_extremes_and_limits_are_named(cam: tuple[Any, Figure]) -> None:
    made, figure = cam
    named = list(lines(panel(figure, "Pressure angle")))
    for cam_name, worst in zip(("main cam", "return cam"), made.max_pressure_angle, strict=True):
        assert any(label.startswith(f"{cam_name}, ≤ {math.degrees(worst):.4g}°") for label in named)
    assert "limit ±45°" in named
    limit = lines(panel(figure, "Curvature"))["undercut: 1/roller radius 30 mm"]
    assert limit.get_ydata()[0] == 1.0 / 30.0


# Every command, odd designs, files

BARE = {"cam": None, "inertia": None, "spring": None}
ODD: dict[str, tuple[dict[str, Any], tuple[str, ...]]] = {
    "law and linkage alone": (changed(BARE), ("gripper", "analyze")),
    "cam without forces": (changed({"inertia": None}), ("gripper", "cam")),
    "one roller": (changed({"cam.return_roller": None, "cam.shaft_radius": 40}), ("gripper", "cam")),
    "reserve": (changed({"spring.reserve": 50}), ("gripper",)),
    "narrow phases": (
        changed(
            {
                "phases": {
                    "accelerate": 102,
                    "constant": 8,
                    "decelerate": 50,
                    "far_dwell": 2,
                    "return": 196,
                    "near_dwell": 2,
                }
            }
        ),
        ("gripper", "cam"),
    ),
    "tiny": (scaled(gripper_file(), 1e-6), ("gripper", "cam")),
    "huge": (scaled(gripper_file(), 1e6), ("gripper", "cam")),
    "mathematics in its name": (changed({"name": r"$\frac$ " * 20}), ("gripper",)),
}


@pytest.mark.parametrize("command", ["gripper", "cam", "analyze"])
def test_every_command_draws(command: str) -> None:
    _, figure = drawn(command)
    figure.savefig(io.BytesIO(), format="png", dpi=40)
    assert f"paper: {command}" in figure.get_suptitle()


@pytest.mark.parametrize("name", ODD)
def test_odd_designs_draw_without_warnings(name: str) -> None:
    """Laying the figure out draws everything but its pixels."""
    data, commands = ODD[name]
    for command in commands:
        drawn(command, data)


def test_torques_are_left_out_where_the_file_has_none() -> None:
    _, figure = drawn("gripper", changed(BARE))
    assert not any(axes.get_title(loc="left").startswith("Torques") for axes in figure.axes)
