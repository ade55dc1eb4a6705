"""What is drawn is what is computed: data of pictures that once showed something else, or could not be read."""

from __future__ import annotations

import math
import re
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from matplotlib.backends.backend_agg import FigureCanvasAgg
from sheets import curve, labels, panel, sheet, tagged, words
from sweeps import mostly_slow

from gearlink.cli.views.figures import motion_laws
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.flatbed_press import cylinder_positions
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, timing_sheet, true_size
from gearlink.cli.views.figures.write import failures
from gearlink.core.parts.cams import law_tables

SIX_BAR: list[tuple[list[int], float]] = [([20, 30], 3.0), ([20, 21], 21.0), ([20, 20], 1.0)]


@pytest.mark.slow
@pytest.mark.parametrize(("gears", "turns"), mostly_slow(SIX_BAR, 1))
def test_numbers_along_many_turns_reach_from_end_to_end(gears: list[int], turns: float) -> None:
    """They had stood over the first turn alone."""
    data = worked("geared_six_bar")
    data["trains"][0]["gears"] = gears
    figure = motion_sheet.draw(design(data))
    for axes in figure.axes:
        numbers = axes.xaxis.get_majorticklocs()
        assert axes.get_xlim() == (0.0, 360.0 * turns)
        assert (numbers[0], len(numbers) <= 9) == (0.0, True)
        assert 360.0 * turns - numbers[-1] < numbers[1]


@pytest.mark.slow
def test_many_standstills_leave_the_curve_to_be_seen() -> None:
    """Of 21 turns there were 82 lines over the whole height of each panel."""
    data = worked("geared_six_bar")
    data["trains"][0]["gears"] = [20, 21]
    made, figure = sheet(data)
    marks = tagged(figure, "standstills")
    assert len(marks) == 3
    for mark in marks:
        assert np.allclose(np.radians(mark.get_xdata()), made.dwell_crank_angles, rtol=1e-12, atol=1e-12)
        assert not np.any(mark.get_ydata())
    assert max(len(axes.lines) for axes in figure.axes[2:]) < 6


@pytest.mark.parametrize("name", ["lift_cam", "geneva_drive", "hypocycloid_slider", "crank_rocker"])
def test_every_panel_of_a_sheet_has_something_in_it(name: str) -> None:
    """Of kinds whose sheets no other quick test draws: a title or a label of its own, and a curve or a body."""
    panels = [axes for axes in sheet(name).figure.axes if axes.axison]
    named = [(axes.get_title(loc="left"), axes.get_ylabel()) for axes in panels]
    assert len(panels) == len(set(named)) > 1
    assert all(map(any, named))
    assert all(axes.patches or any(len(line.get_xdata()) > 1 for line in axes.lines) for axes in panels)


def test_a_bed_is_not_said_to_dwell_where_its_cam_does() -> None:
    """Bands of the cam's phases had covered the fastest motion of the bed as a dwell."""
    bed, cylinder = motion_sheet.courses(design(worked("ty460")))
    assert [band.name for band in bed.bands] == ["sync", "back"]
    back = bed.bands[1]
    inside = (bed.x > back.start + 0.01) & (bed.x < back.end - 0.01)
    zone = cylinder.bands[0]
    assert bed.rates[1][inside].max() < 0.0
    assert bed.rates[1][(bed.x > 0.1) & (bed.x < back.start - 0.01)].min() > 0.0
    together = (bed.x > zone.start) & (bed.x < zone.end)
    assert np.allclose(bed.rates[1][together], cylinder.rates[1][together], rtol=0.0, atol=1e-6)


def test_a_stretch_up_to_the_end_of_a_turn_ends_at_360() -> None:
    named = words(timing_sheet.draw(design(worked("ty460")))) + words(
        timing_sheet.draw(design(worked("swing_gripper")))
    )
    assert not any("–0°" in text for text in named)
    assert any(text.endswith("–360°") for text in named)


@pytest.mark.parametrize("count", [2, 9, 35])
def test_no_two_laws_look_alike(count: int) -> None:
    looks = [(look["color"], str(look["linestyle"])) for look in motion_laws._looks(count)]
    assert all(one != other for one, other in combinations(looks, 2))


def test_infinite_jerk_is_marked_where_the_acceleration_jumps() -> None:
    from gearlink.core.parts.cams.laws import law

    constant = {"scca": [0, 1, 0, 0]}  # two halves of constant acceleration, +4 and -4
    found = np.array(law_tables.acceleration_jumps(law(constant)))
    assert found == pytest.approx(np.array([(0.0, 4.0), (0.5, -8.0), (1.0, 4.0)]), rel=1e-12)
    assert law_tables.acceleration_jumps(law("modified-sine")) == []
    figure, axes = style.figure(4.0, 4.0, "laws"), []
    for k in range(4):
        axes.append(figure.add_subplot(4, 1, k + 1))
    motion_laws._column(axes, "", [law("simple-harmonic"), law("cycloidal"), law(constant)])
    marks = [
        (float(line.get_xdata()[0]), float(line.get_ydata()[0]), line.get_marker())
        for line in axes[-1].lines
        if line.get_label() == "_infinite"
    ]
    first, second = 1.0, 1.0 - motion_laws._NEXT
    assert marks == [
        (0.0, first, "^"), (1.0, first, "^"), (0.0, second, "^"), (0.5, 0.0, "v"), (1.0, second, "^"),
    ]  # fmt: skip


@pytest.mark.slow
def test_arrows_of_a_press_are_as_thick_in_every_resolution() -> None:
    """In dots they were 1.8 times as thick in a PDF, and a third in a picture of 400 dots an inch."""
    widths = []
    for dpi in (72.0, 400.0):
        figure = style.figure(4.0, 4.0, "press")
        figure.set_dpi(dpi)
        axes: Any = figure.add_subplot()
        cylinder_positions(axes, design(worked("ty460")))
        figure.draw_without_rendering()
        (arrows,) = [each for each in axes.collections if type(each).__name__ == "Quiver"]
        widths.append(float(arrows.width * arrows._trans_scale / dpi))
    assert widths[0] == pytest.approx(widths[1], rel=1e-9)
    assert widths[0] == pytest.approx(2.0 / 130.0, rel=1e-6, abs=0.0)


def test_the_pressure_angle_lies_in_the_direction_of_its_point_on_the_cam() -> None:
    """Round panels of the cam angle and of the cam had run in opposite senses."""
    made = design(worked("ty460"))
    figure = cam_sheets.pressure(made)
    polar, outline = figure.axes
    assert polar.get_theta_direction() == 1
    for cam in cam_sheets.discs(made):
        way, shown = curve(figure, f"pressure-{cam.name}")
        worst = cam.max_pressure_angle
        place = complex(cam.points(np.array([worst.place]))[0][0])
        at = int(np.argmax(shown))
        assert math.remainder(way[at] - np.angle(place), 2.0 * math.pi) == pytest.approx(0.0, abs=0.01)
        assert shown[at] == pytest.approx(math.degrees(worst.value), abs=1e-3)
    assert {"0°", "15°", "30°"} <= set(labels(outline))


@pytest.mark.slow
def test_the_least_torque_with_a_device_is_drawn() -> None:
    """Between rows 5 1/min apart it had been drawn three times as large, at another speed."""
    made, figure = sheet("wide_swing_twin_cam", "swing")
    speed, torque = curve(figure, "with-device")
    fine = np.linspace(110.0, 113.0, 3001)
    peaks = made.unloading.torque_peaks(fine / made.spec.speed)[1]
    assert speed[np.argmin(torque)] == pytest.approx(fine[np.argmin(peaks)], abs=2e-3)
    assert torque.min() == pytest.approx(peaks.min(), abs=5e-3)
    table = made.table("balance")
    assert np.allclose(np.interp(table.data[0], speed, torque), table.data[2], rtol=0.0, atol=0.05)


@pytest.mark.slow
def test_a_two_gear_dwell_is_shown_within_its_tolerance() -> None:
    made, figure = sheet("two_gear_standing", "synth dwell")
    x, y = curve(figure, "magnified")
    start, width = (made.quantity(f"tolerance_dwell_{part}").value for part in ("start", "angle"))
    inside = (x >= start) & (x <= start + width)
    assert np.abs(y[inside]).max() == pytest.approx(0.5, abs=0.01)
    beyond = (x < start - 1.0) | (x > start + width + 1.0)
    assert np.abs(y[beyond]).min() > 0.5
    axes = panel(figure, "Dwell, magnified")
    assert any(label.endswith(f"over {width:.5g}°") for label in labels(axes))
    (asked,) = tagged(figure, "asked")
    assert np.ptp(asked.get_xdata()) == pytest.approx(60.0, rel=1e-6, abs=0.0)


def test_a_window_that_is_too_short_is_red() -> None:
    _, figure = sheet("two_gear_standing", "analyze", links={"coupler": 64, "rocker": 80, "frame": 83.7},
                      dwell=None, dwell_tolerance=0.5, dwell_window=70.0)  # fmt: skip
    (asked,) = [
        each for each in tagged(figure, "fails") if np.ptp(each.get_xdata()) == pytest.approx(70.0, rel=1e-6, abs=0.0)
    ]
    assert asked.get_color() == style.WRONG


@pytest.mark.slow
def test_an_undercut_cam_is_drawn_not_for_manufacture() -> None:
    made = design(worked("ty460"), cam__base_radius=35.0)
    words_of_stamp = failures(check for name in made.outline("cam").checks for check in made.check(name))
    assert "GL402 cam-undercut" in words_of_stamp
    assert "GL402 cam-undercut 25 mm (limit ≤ 11.27 mm)" in words_of_stamp  # as the message says it
    texts = words(true_size.workshop_drawing(made, 0))
    assert not any(text.startswith(f"R {cam_sheets.discs(made)[0].max_radius:.5g}") for text in texts)
    assert any("undercut" in text for text in texts)


def test_sizes_of_a_cam_interrupt_their_lines_and_are_as_wide_as_planned() -> None:
    """Dimension lines ran through the numbers, whose decimal points read as colons; words reached over an edge."""
    figure = true_size.workshop_drawing(design("lift_cam"), 0)
    renderer = FigureCanvasAgg(figure).get_renderer()
    sizes = [each for each in figure.axes[0].texts if re.match(r"[R\u2300]\d", each.get_text())]
    assert [each.get_text()[0] for each in sizes] == ["R", "R", "\u2300", "\u2300"]
    assert all(each.get_bbox_patch().get_facecolor()[:3] == (1.0, 1.0, 1.0) for each in sizes)
    (note,) = [each for each in sizes if "over bore" in each.get_text()]
    wide = note.get_window_extent(renderer).width / figure.dpi * 25.4
    assert wide <= true_size._LETTER * max(map(len, note.get_text().split("\n")))


@pytest.mark.quick(1)
@pytest.mark.parametrize("prime", [60.0, 75.0])
def test_the_arrow_of_rotation_is_clear_of_the_sizes(prime: float) -> None:
    """It stood at a fixed place, where a radius may be."""
    motion = [{"to": 60, "lift": 22, "law": "cycloidal"}, {"to": 100}, {"to": 300, "lift": 0, "law": "cycloidal"}]
    made = design(
        {
            "kind": "disc-cam",
            "motion": [*motion, {"to": 360}],
            "follower": {"type": "oscillating-roller", "arm": 70, "center_distance": 110, "pivot_direction": 120,
                         "side": -1, "roller_radius": 9},
            "cam": {"prime_radius": prime, "shaft_radius": 20},
        }
    )  # fmt: skip
    figure = true_size.workshop_drawing(made, 0)
    axis = np.mean(np.column_stack(curve(figure, "bore")), axis=0) @ np.array([1.0, 1j])
    arc = np.column_stack(curve(figure, "sense of rotation")) @ np.array([1.0, 1j]) - axis
    assert np.all(np.diff(np.unwrap(np.angle(arc))) > 0.0)  # counter-clockwise
    for text in (each for each in figure.axes[0].texts if re.match(r"[R\u2300]\d", each.get_text())):
        place = complex(*text.get_position()) - axis
        assert np.abs(np.angle(arc / place)).min() > 0.1


@pytest.mark.parametrize("sheet_of", ["workshop", "true to size"])
def test_a_groove_is_drawn_with_both_walls(sheet_of: str) -> None:
    """Its outer wall had been left out: the drawing was that of an open cam."""
    made = design(worked("lift_cam"), closure="groove", spring=None)
    workshop = sheet_of == "workshop"
    figure = true_size.workshop_drawing(made, 0) if workshop else true_size.drawing(made, 0, true_size.Scale())
    inner, outer = (curve(figure, name) for name in ("profile", "outer wall"))
    scale = 25.4 * figure.get_size_inches()[0] / np.ptp(figure.axes[0].get_xlim())
    apart = np.hypot(inner[0] - outer[0], inner[1] - outer[1]) * scale
    printed = 1.0 if "1:1" in " ".join(words(figure)) else 0.5
    assert apart == pytest.approx(
        np.full_like(apart, 24.0 * printed), rel=1e-6
    )  # at the same angle the roller's diameter
    if workshop:
        low, high = made.max_radius[1], made.min_radius[1]
        assert any(f"outer wall R{high:.3f} to {low:.3f}" in text for text in words(figure))


def test_what_fails_is_named_once_with_its_value() -> None:
    checks = design(worked("drawn_feed"), links__frame=100.0).check("gear-collision")
    text = failures([*checks, *checks])
    assert text.startswith("GL301 gear-collision")
    assert text.count("GL301") == 1
    assert "mm" in text


@pytest.mark.slow
def test_joint_forces_are_few_in_a_panel_and_named_in_words() -> None:
    """Thirteen like curves had stood in one panel, with the names of the program."""
    made, figure = sheet("loaded_press", "loads")
    table = made.table("joints")
    drawn = {}
    for axes in figure.axes:
        if axes.get_title(loc="left").startswith("Joint forces"):
            curves = [line for line in axes.lines if "≤" in line.get_label()]
            assert len(curves) <= 5
            drawn |= {line.get_label().partition(",")[0]: np.asarray(line.get_ydata()) for line in curves}
    assert "F pinion" in drawn
    assert set(drawn) == {name.replace("_", " ") for name in made.pins if name in table.columns}
    for name in made.pins:
        assert np.array_equal(drawn[name.replace("_", " ")][:-1], table[name])
    assert {"mesh 12", "rack lower"} <= set(labels(panel(figure, "Tooth forces")))


@pytest.mark.slow
def test_joints_with_the_same_force_are_drawn_once() -> None:
    _, figure = sheet("loaded_gripper", "loads")
    named = [line.get_label() for axes in figure.axes for line in axes.lines]
    assert any(label.startswith("D, E, ≤") for label in named)
    assert not any(label.startswith("E, ≤") for label in named)


@pytest.mark.slow
def test_a_jump_of_a_force_is_no_curve() -> None:
    made, figure = sheet("loaded_press", "loads")
    axes = panel(figure, "Pin H")
    force = np.asarray(made.table("joints")["H_x"]) + 1j * np.asarray(made.table("joints")["H_y"])
    (_, *others) = axes.lines
    jumps = [line for line in others if line.get_gid() == "jump"]
    assert jumps
    (solid,) = [line for line in axes.lines if len(line.get_xdata()) > 100]
    x, y = solid.get_data()
    steps = np.abs(np.diff(np.asarray(x) + 1j * np.asarray(y)))
    assert np.nanmax(steps) < 0.08 * np.abs(force).max()
    marks = [line for line in others if line.get_gid() == "angle-mark"]
    assert len(marks) == 12
    assert marks[3].get_xdata()[0] == pytest.approx(force[90].real, rel=1e-6, abs=0.0)


@pytest.mark.slow
def test_a_pressure_above_what_is_allowed_is_red_on_curve_and_cam() -> None:
    made, figure = sheet("loaded_wide_swing", "loads", speed=400)
    (curve_above,) = [each for each in tagged(figure, "fails") if each.axes is panel(figure, "Hertzian pressure")]
    shown = np.asarray(curve_above.get_ydata(), dtype=float)
    assert np.nanmax(shown) == pytest.approx(made.hertz_pressure_max, rel=1e-9)
    assert np.nanmin(shown) > 1190.0
    cam = panel(figure, "cam: pressure")
    (above,) = [each for each in cam.collections if each.get_gid() == "fails"]
    by_pressure = next(each for each in cam.collections if each.get_gid() != "fails")
    assert by_pressure.get_clim() == (0.0, 1200.0)
    assert 0 < len(above.get_segments()) < len(by_pressure.get_segments())
    (dot,) = [each for each in tagged(figure, "fails") if each.axes is panel(figure, "Residual")]
    assert dot.get_xdata()[0] == pytest.approx(400.0, rel=1e-6, abs=0.0)
    assert dot.get_ydata()[0] > made.section.vibration.allowed_residual


@pytest.mark.slow
def test_a_roller_that_lifts_off_is_red() -> None:
    made, figure = sheet("swing_gripper", "gripper", speed=18000)
    (lost,) = tagged(figure, "fails")
    x, y = (np.asarray(each, dtype=float) for each in lost.get_data())
    seen = np.isfinite(y)
    table = made.table("forces", samples=len(x))
    torque = np.asarray(table["contact_torque_main"], dtype=float)
    assert np.all(seen[torque < made.spec.spring.reserve])
    assert seen.sum() <= (torque < made.spec.spring.reserve).sum() + 8
    assert not tagged(sheet("swing_gripper", "gripper").figure, "fails")


@pytest.mark.slow
def test_yield_and_capability_stand_on_the_picture() -> None:
    require = ["back_step_angle <= 20.30 deg"]
    made, figure = sheet("candy_feed_tolerances", "tolerance", tolerance__samples=128, tolerance__require=require)
    assert f"yield {100.0 * made.result.good.value:.4g} %" in figure.get_suptitle()
    axes = panel(figure, "back step angle")
    table = made.table("quantities")
    cpk = dict(zip(table["quantity"], table["cpk"], strict=True))["back_step_angle"]
    assert axes.get_title(loc="left").endswith(f"Cpk {style.number(cpk, 3)}")
    (rejected,) = [patch for patch in axes.patches if patch.get_gid() == "beyond"]
    assert rejected.get_x() == pytest.approx(20.3, rel=1e-6, abs=0.0)


@pytest.mark.slow
@pytest.mark.parametrize("teeth", [200, 201])
def test_a_gear_is_seen_beside_a_long_rack(teeth: int) -> None:
    """Of a rack of 200 teeth the middle is drawn, and says so; the flanks touch where they did."""
    made, figure = sheet("rack_drive", "gear", rack_teeth=teeth)
    axes = figure.axes[0]
    assert len(tagged(figure, "break")) == 2
    assert any(text.endswith(f"of {teeth} teeth shown") for text in words(figure))
    rack = next(patch for patch in axes.patches if patch.get_label() == f"rack, z = {teeth}")
    high = np.ptp(rack.get_xy()[:, 1])
    assert high < 6.5 * made.rack.pair.tip_radius[0]
    whole = next(patch for patch in sheet("rack_drive", "gear", rack_teeth=21 + teeth % 2).figure.axes[0].patches
                 if patch.get_label().startswith("rack"))  # fmt: skip
    one, other = (np.unique(np.round(body.get_xy()[:, 1] % made.rack.pitch_on_line, 6)) for body in (rack, whole))
    assert np.isin(one, other).mean() > 0.8


def test_a_short_crank_is_drawn_magnified() -> None:
    _, figure = sheet("ty460_slider_crank", "crank", rod=9000.0, offset=-100.0)
    (detail,) = figure.axes[0].child_axes
    low, high = detail.get_xlim()
    assert high - low < 4.0 * 160.0
    assert not sheet("ty460_slider_crank", "crank").figure.axes[0].child_axes


def test_a_frame_stands_on_hatched_ground_whatever_more_it_is_called() -> None:
    pins = {"frame of the machine": "AD", "crank": "AB", "coupler": "BC", "rocker": "CD"}
    links = {name: {"pins": list(ends), "length": 1.0} for name, ends in pins.items()}
    data = {"kind": "gear-train-mobility", "name": "chain", "links": links}
    _, figure = sheet(data)
    grounds = [line for line in figure.axes[0].lines if line.get_markersize() == 19.0]
    assert len(grounds) == 2
    for text in figure.axes[0].texts:
        if text.get_text() in links:
            assert abs(complex(*text.get_position())) > 0.75
