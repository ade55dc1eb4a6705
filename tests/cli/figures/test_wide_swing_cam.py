"""The figures of a wide-swing mechanism: what is plotted is what tables and cams say.

Tolerances: plotted values are the numbers of the tables, compared exactly; lengths come back from coordinates of a few
hundred mm within 1e-9 mm; the files of two runs are compared byte by byte.
"""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design
from sheets import Sheet, lines, odd_sheets, panel, placed_sheet, sheet
from sweeps import ALL, mostly_slow

from gearlink.core.base.errors import NoSolution


def drawn(name: str, command: str, **keys: Any) -> Sheet:
    return sheet(f"wide_swing_{name}", command, **keys)


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", mostly_slow(["twin_cam", "slider", "twin_rocker", "oscillating_cam"], 2))
def test_law_is_the_table_s(name: str) -> None:
    made, figure = drawn(name, "swing")
    data = made.table("law").data
    for i, title in enumerate(("Displacement", "Velocity", "Acceleration"), 1):
        curves = lines(panel(figure, title))
        np.testing.assert_array_equal(curves["unloaded law"].get_xdata(), data[0])
        np.testing.assert_array_equal(curves["unloaded law"].get_ydata(), data[i])
        assert {"harmonic", "cycloidal"} <= set(curves)
    harmonic = lines(panel(figure, "Velocity"))["harmonic"].get_ydata()
    np.testing.assert_allclose(harmonic, 0.5 * math.pi * np.sin(math.pi * data[0]), rtol=0.0, atol=1e-14)


@pytest.mark.slow
def test_the_dynamic_coefficient_lies_within_its_panel() -> None:
    """It hardly changes, and lay on the upper edge."""
    made, figure = drawn("twin_cam", "swing")
    axes = panel(figure, "Elastic over rigid torque")
    values = made.table("balance")["dynamic_coefficient"]
    assert np.array_equal(axes.lines[0].get_ydata(), values)
    assert axes.get_ylim()[1] > 1.1 * values.max()


def test_balance_is_the_table_s() -> None:
    made, figure = drawn("twin_cam", "swing")
    axes, data = panel(figure, "Torque on the rocker axis"), made.table("balance").data
    for label, column in (("without device", 1), ("with device", 2)):
        speed, torque = lines(axes)[label].get_data()
        rows = np.searchsorted(speed, data[0])
        np.testing.assert_array_equal(np.asarray(speed)[rows], data[0])
        np.testing.assert_allclose(np.asarray(torque)[rows], data[column], rtol=1e-13)
    verticals = {float(line.get_xdata()[0]) for line in axes.get_lines() if len(set(line.get_xdata())) == 1}
    assert {100.0, 100.0 / math.sqrt(2.0), 80.0} <= verticals
    assert {text.get_text() for text in axes.texts} >= {"n₀/√2", "n₀"}


@pytest.mark.slow
def test_slider_is_the_table_s() -> None:
    made, figure = drawn("slider", "swing")
    table, curves = made.table("slider"), lines(panel(figure, "Slider"))
    for name in ("displacement", "velocity", "acceleration"):
        np.testing.assert_array_equal(curves[name].get_ydata(), table.data[table.columns.index(name)])


def test_a_mechanism_without_a_cam_is_drawn_in_three_positions() -> None:
    """Rod and arms keep their length in each; the slider's places are its stroke apart."""
    made, figure = drawn("slider", "swing")
    axes, section = panel(figure, "Mechanism at mid-swing [mm]"), made.spec.slider
    drawn_links = [line for line in axes.get_lines() if line.get_linestyle() == "-" and len(line.get_xdata()) == 3]
    chains = [line.get_xydata() for line in drawn_links]
    assert len(chains) == 3
    for chain in chains:
        assert np.hypot(*np.diff(chain, axis=0).T) == pytest.approx([section.crank, section.rod], abs=1e-9)
    at = [chain[-1, 1] for chain in chains]
    assert max(at) - min(at) == pytest.approx(made.quantity("slider_stroke").value, abs=1e-9)
    assert "stroke 259.808 mm" in {text.get_text() for text in axes.texts}


@pytest.mark.quick(1)
@pytest.mark.parametrize("keys", [{"slider": None}, {"slider__offset": -30.0, "unloader__pivot_ratio": 3.0}])
def test_other_mechanisms_without_a_cam_draw(keys: dict[str, Any]) -> None:
    assert panel(drawn("slider", "swing", **keys).figure, "Mechanism at mid-swing [mm]").get_lines()


@pytest.mark.quick(1)
@pytest.mark.parametrize(
    ("name", "titles"),
    [
        ("twin_cam", ("Cam of the working stroke", "Cam of the return stroke")),
        ("twin_rocker", ("Internal profile", "External profile")),
        ("oscillating_cam", ("Oscillating cam",)),
    ],
)
@pytest.mark.parametrize("command", ["cam", pytest.param("swing", marks=pytest.mark.slow)])
def test_cams_are_drawn_to_scale(name: str, titles: tuple[str, ...], command: str) -> None:
    made, figure = drawn(name, command)
    cams = [made.cam, made.return_cam or made.cam]
    tables = [made.table("main_cam"), *(() if made.spec.drive else (made.table("return_cam"),))]
    for title, cam, table in zip(titles, cams, tables, strict=False):
        axes = panel(figure, title)
        assert axes.get_aspect() == 1.0
        curves = lines(axes)
        for place in ("start", "mid-swing", "end"):
            x, y = curves[f"rocker, {place}"].get_data()
            assert math.hypot(x[1] - x[0], y[1] - y[0]) == pytest.approx(cam.rocker_radius, abs=1e-9)
            assert math.hypot(x[0], y[0]) == pytest.approx(cam.center_distance, abs=1e-9)
        columns = dict(zip(table.columns, table.data, strict=True))
        pitch = curves["pitch curve"].get_xydata()
        np.testing.assert_allclose(pitch[[0, -1], 0], columns["pitch_x"][[0, -1]], rtol=0.0, atol=1e-9)
        np.testing.assert_allclose(pitch[[0, -1], 1], columns["pitch_y"][[0, -1]], rtol=0.0, atol=1e-9)
        start = curves["profile"].get_xydata()[0]
        first = cam.points(np.array([cam.contact[0][0]])).profile[0]
        mirror = -1.0 if title.startswith("Cam of the return") else 1.0
        np.testing.assert_allclose(start, [first.real, mirror * first.imag], rtol=0.0, atol=1e-9)
        slot = curves["slot, in which the roller changes flank"].get_xydata()
        x, y = curves["rocker, mid-swing"].get_data()
        np.testing.assert_allclose(
            np.hypot(slot[:, 0] - x[1], slot[:, 1] - y[1]), cam.roller_radius, rtol=0.0, atol=1e-9
        )


def test_contour_has_no_gap_and_no_corner_at_the_dwells() -> None:
    from gearlink.core.machines.wide_swing.strokes import contour, dwell_arc

    for name in ("twin_cam", "twin_rocker"):
        made = design(f"wide_swing_{name}", command="cam")
        cam = made.cam
        run_up, slot, run_out = contour(cam)
        rest = dwell_arc(cam)
        closed = ((run_up, slot), (slot, run_out), (run_out, rest), (rest, run_up))
        for one, other in closed:
            assert abs(one[-1] - other[0]) < 1e-9
        # the rocker stands still at the end, so the profile runs into a circle about the cam axis
        np.testing.assert_allclose(np.abs(rest), abs(run_up[0]), rtol=1e-12)
        assert cam.points(np.array([1.0])).profile[0] == pytest.approx(run_out[-1], abs=1e-12)


@pytest.mark.slow
def test_closed_contours_are_the_table_s() -> None:
    for keys in ({}, {"layout": "twin-cam"}) if ALL else ({},):
        made, figure = drawn("cycle", "cam", **keys)
        cycle = made.cycle
        titles = ("Both profiles",) * 2 if not keys else ("Cam of the working", "Cam of the return")
        for title, cam, frame in zip(titles, (cycle.main, cycle.back), (cycle.of_main, cycle.of_back), strict=True):
            found = [np.asarray(line.get_xydata()) @ [1, 1j] for line in panel(figure, title).get_lines()]
            for _, points in cam.outline():
                want = frame(points)
                assert any(line.shape == want.shape and np.abs(line - want).max() < 1e-9 for line in found)
        curve = lines(panel(figure, "Cycle"))["rocker"]
        table = made.table("contour", samples=720)
        np.testing.assert_array_equal(np.asarray(curve.get_ydata())[:-1], table["rocker_angle"])
        words = {text.get_text() for text in panel(figure, "Cycle").texts}
        assert words == {
            "working stroke\n80°",
            "far dwell\n70°",
            "return stroke\n100°",
            "near dwell\n110°",
            "[ms]",
        }


def test_pressure_angle_and_curvature() -> None:
    made, figure = drawn("twin_rocker", "cam")
    axes = panel(figure, "Pressure angle")
    inner = next(line for label, line in lines(axes).items() if label.startswith("internal profile"))
    points = made.cam.points(np.asarray(inner.get_xdata()))
    np.testing.assert_array_equal(inner.get_ydata(), np.degrees(points.pressure_angle))
    assert f"limit ±{made.spec.limits.pressure_angle:g}°" in lines(axes)
    curvature = lines(panel(figure, "Curvature radius"))
    assert curvature["roller radius 4 mm"].get_ydata()[0] == 4.0
    outer = next(line for label, line in curvature.items() if label.startswith("external profile"))
    found = made.return_cam.points(np.asarray(outer.get_xdata())).curvature_radius
    drawn_radius = np.asarray(outer.get_ydata())
    shown = ~np.isnan(drawn_radius)
    np.testing.assert_array_equal(drawn_radius[shown], found[shown])
    # the curve is drawn where the roller touches, down to the radius that the legend names
    assert outer.get_label().endswith(f"≥ {made.return_cam.min_curvature_radius:.4g} mm")
    assert drawn_radius[shown].min() >= made.return_cam.min_curvature_radius * (1 - 1e-12)


ODD = [
    ("twin_rocker", {"cycle_angle": 140}),
    ("oscillating_cam", {"drive__stroke": "homeward", "drive__assembly": -1}),
    ("twin_cam", {"swing": 300, "unloader__pivot_ratio": 5.3}),
    ("twin_cam", {"swing": 20, "cam__roller_radius": 2}),
    ("twin_cam", {"cam__rocker_radius": 60}),
    ("twin_cam", {"cam__rocker_radius": 74.5}),
    ("twin_cam", {"cam__center_distance": 2e-4, "cam__roller_radius": 8e-6, "cam__shaft_radius": 0}),
    ("twin_cam", {"cam__center_distance": 2e8, "cam__roller_radius": 8e6, "cam__shaft_radius": 2.5e7}),
    ("twin_rocker", {"swing": 260, "unloader__pivot_ratio": 6}),
]


@pytest.mark.slow
@pytest.mark.parametrize(("name", "keys", "place"), odd_sheets(ODD))
@pytest.mark.parametrize("command", ["swing", pytest.param("cam", marks=pytest.mark.slow)])
def test_odd_designs_draw(name: str, keys: dict[str, Any], command: str, place: Any) -> None:
    place(f"wide_swing_{name}", command, **keys)


@pytest.mark.slow  # what is drawn stands in the sheets of the other tests; placing is the same for all kinds
@pytest.mark.parametrize("command", ["swing", "cam"])
def test_every_command_draws(command: str) -> None:
    assert f"wide-swing-twin-cam: {command}" in placed_sheet("wide_swing_twin_cam", command).figure.get_suptitle()


@pytest.mark.slow
def test_design_without_cam_or_profile() -> None:
    looped = {"swing": 160, "cycle_angle": 150, "unloader__stretch_ratio": 0.05, "unloader__pivot_ratio": 4}
    for name, keys in (("slider", {}), ("twin_rocker", looped), ("twin_cam", {"cam__roller_radius": 100})):
        figure = drawn(name, "swing", **keys).figure
        assert not [axes for axes in figure.axes if axes.get_title(loc="left").startswith("Cam of")]
    with pytest.raises(NoSolution, match="loop"):
        drawn("twin_rocker", "cam", **looped)
