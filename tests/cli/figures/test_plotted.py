"""What is drawn is what is computed: data of pictures that once showed something else, or could not be read."""

from __future__ import annotations

import math
from itertools import combinations
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from sheets import curve, labels, panel, sheet, tagged, words
from sweeps import mostly_slow

from gearlink.cli.commands import sheet as sheets
from gearlink.cli.views.figures import motion_laws
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.flatbed_press.motion import cylinder_positions
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, timing_sheet
from gearlink.cli.views.figures.write import failures
from gearlink.core.machines.wide_swing.design import torque_peaks

SIX_BAR: list[tuple[list[int], float]] = [([20, 30], 3.0), ([20, 21], 21.0), ([20, 20], 1.0)]


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
        assert np.allclose(np.radians(mark.get_xdata()), made.dwell_crank_angles)
        assert not np.any(mark.get_ydata())
    assert max(len(axes.lines) for axes in figure.axes[2:]) < 6


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
    assert np.allclose(bed.rates[1][together], cylinder.rates[1][together], atol=1e-6)


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
    assert widths[0] == pytest.approx(2.0 / 130.0)


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
    """Between rows 5 rev/min apart it had been drawn three times as large, at another speed."""
    made, figure = sheet("wide_swing_twin_cam", "swing")
    speed, torque = curve(figure, "with-device")
    fine = np.linspace(110.0, 113.0, 3001)
    peaks = torque_peaks(made, fine / made.spec.speed)[1]
    assert speed[np.argmin(torque)] == pytest.approx(fine[np.argmin(peaks)], abs=2e-3)
    assert torque.min() == pytest.approx(peaks.min(), abs=5e-3)
    table = made.table("balance")
    assert np.allclose(np.interp(table.data[0], speed, torque), table.data[2], atol=0.05)


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
    assert np.ptp(asked.get_xdata()) == pytest.approx(60.0)


def test_a_window_that_is_too_short_is_red() -> None:
    _, figure = sheet("two_gear_standing", "analyze", links={"coupler": 64, "rocker": 80, "frame": 83.7},
                      dwell=None, dwell_tolerance=0.5, dwell_window=70.0)  # fmt: skip
    (asked,) = [each for each in tagged(figure, "fails") if np.ptp(each.get_xdata()) == pytest.approx(70.0)]
    assert asked.get_color() == style.WRONG


def test_an_undercut_cam_is_drawn_not_for_manufacture() -> None:
    made = design(worked("ty460"), cam__base_radius=35.0)
    words_of_stamp = sheets._failures(made)
    assert "GL402 cam-undercut" in words_of_stamp
    assert "(limit 1)" in words_of_stamp
    texts = words(cam_sheets.drawing(made, 0))
    assert not any(text.startswith(f"R {cam_sheets.discs(made)[0].max_radius:.5g}") for text in texts)
    assert any("undercut" in text for text in texts)
    assert sheets._failures(design(worked("ty460"))) == ""


def test_what_fails_is_named_once_with_its_value() -> None:
    checks = design(worked("drawn_feed"), links__frame=100.0).check("gear-collision")
    text = failures([*checks, *checks])
    assert text.startswith("GL301 gear-collision")
    assert text.count("GL301") == 1
    assert "mm" in text
