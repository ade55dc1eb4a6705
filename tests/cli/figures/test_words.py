"""Words and numbers on sheets: they name what is drawn as other sheets do, agree with the analysis, and have room."""

from __future__ import annotations

import math
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from sheets import curve, labels, panel, sheet, words

from gearlink.cli.commands.chart import draw
from gearlink.cli.views.figures import three_gear_four_bar, write
from gearlink.cli.views.figures.chart_list import CHARTS
from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.figures.geared_five_bar import _gears, build
from gearlink.cli.views.figures.sheets import cam_sheets, motion_sheet, timing_sheet
from gearlink.cli.views.figures.write import fonts_of
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS


def test_extremes_of_a_slider_are_those_of_the_analysis() -> None:
    """The maximum of curve points half a degree apart would stand at 190.5 in place of 190.66 deg."""
    made, figure = sheet("ty460_slider_crank", "crank")
    for side in ("max", "min"):
        value, place = (made.quantity(f"velocity_{side}{at}").value for at in ("", "_at"))
        assert f"{style.number(value, 5)} mm/rad at {place:.5g}°" in words(figure)


FIVE_BARS: list[tuple[str, dict[str, Any]]] = [
    ("five_bar_path", {}),
    ("five_bar_path", {"gears": {"module": 2.5, "input": 20, "idler": 24, "output": 20}, "links__frame": 50.0}),
    ("five_bar_path", {"gears": {"module": 2.5, "input": 60, "output": 20, "mesh": "internal"}}),
    ("five_bar_path", {"gears": {"module": 2.5, "input": 20, "output": 60, "mesh": "internal"}}),
    ("five_bar_positions", {}),
]


@pytest.mark.parametrize(("name", "keys"), FIVE_BARS)
def test_gears_of_a_five_bar_have_the_names_of_the_mechanism(name: str, keys: dict[str, Any]) -> None:
    """Those that mesh are 1 and 4, or 2 and 5, on the mechanism as on the sheet of `gear`."""
    made = design(name, **keys)
    keyed = {"1": "input", "4": "output", "idler": "idler", "2": "planet", "5": "sun"}
    for mesh, names in zip(made.meshes.values(), _gears(made), strict=True):
        for gear, teeth in zip(names, mesh.teeth, strict=True):
            assert abs(teeth) == getattr(made.spec.gears, keyed[gear])


@pytest.mark.slow
def test_the_letter_of_a_coupler_point_on_a_joint_is_shown() -> None:
    assert "C, M" in [mark.text for mark in build(design(worked("five_bar_path")), np.zeros(1)).marks]
    assert {"C", "M"} <= {mark.text for mark in build(design(worked("five_bar_points")), np.zeros(1)).marks}


def test_a_cam_on_a_rocker_moves_over_the_angle_of_its_crank() -> None:
    for name, over in (("wide_swing_oscillating_cam", "crank angle [deg]"), ("wide_swing_twin_cam", "cam angle [deg]")):
        assert {course.over for course in motion_sheet.courses(design(worked(name)))} == {over}


def test_every_stretch_of_a_timing_diagram_has_its_name() -> None:
    for name, narrow in (("ty460", ("lead-in", "transition")), ("swing_gripper", ("constant", "far-dwell"))):
        made = design(worked(name))
        figure = timing_sheet.draw(made)
        (axes,) = figure.axes
        for stretch in narrow:
            assert any(label.startswith(f"{stretch}, ") for label in labels(axes))
        named = [*words(figure), *labels(axes)]
        for ring in load(KINDS[made.kind].sheets["timing"])(made)[0]:
            for phase in ring.stretches:
                assert any(text.startswith(phase.name) for text in named)


def test_the_zone_of_a_press_is_not_called_its_print() -> None:
    """The print may be shorter: sync.print_length."""
    _, marks, _ = timing_sheet.press(design(worked("ty460")))
    assert [name for name, _ in marks] == ["zone begins", "zone ends"]


def test_the_width_of_a_line_is_explained() -> None:
    figure = cam_sheets.pressure(design(worked("swing_gripper")))
    assert panel(figure, "Profiles, line width by pressure angle") is not None


def _legend(texts: list[str]) -> Any:
    axes = panels.page("legend").add_subplot()
    for text in texts:
        axes.plot([0.0, 1.0], [0.0, 1.0], label=text)
    panels.legend_above(axes, 5)
    return axes


@pytest.mark.slow
def test_a_legend_takes_the_rows_that_it_needs() -> None:
    """In one row, that of a gripper's torques would begin left of the page's margin."""
    long = ["inertia", "main roller, ≥ 112.4 N m", "return roller, ≥ 387.8 N m", "spring 400 N m", "least wanted 0 N m"]
    for texts in (long, ["A", "B", "C", "D", "E"]):
        axes = _legend(texts)
        figure = axes.figure
        figure.draw_without_rendering()
        box = axes.get_legend().get_window_extent()
        assert box.x0 >= style.MARGIN * figure.dpi
        assert box.x1 <= (figure.get_figwidth() - style.MARGIN) * figure.dpi
    assert axes.get_legend()._ncols == 5


@pytest.mark.parametrize(
    "name", ["印刷机间歇送纸机构设计第三版本" * 8, "X" * 180, "candy-feed", "150° of a swing, and some more words"]
)
def test_a_title_stays_on_the_page(name: str) -> None:
    """Seventy letters of a line are twice as wide in some scripts: half of a Chinese name would lie beside the page."""
    figure = panels.page(f"{name}: analyze")
    with fonts_of(name):
        style.place_title(figure)
        box = figure._suptitle.get_window_extent()  # type: ignore[attr-defined]
    assert box.x0 >= 0.99 * style.MARGIN * figure.dpi
    assert 7.0 <= figure._suptitle.get_fontsize() <= 12.0  # type: ignore[attr-defined]
    assert ("\n" in figure._suptitle.get_text()) == (len(name) > 70)  # type: ignore[attr-defined]


def test_letters_that_no_font_has_are_told_of_once(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    monkeypatch.setattr(write, "_ASIAN_FONTS", ("No Such Font", "Nor This"))
    for name in ("feed", "Vorschub für 5 °", "停歇 A 停", "停歇 A 停"):
        write.tell_of_boxes(name)
    assert capsys.readouterr().err == (
        "note: no installed font has 停歇: boxes in the figure; with Chinese: No Such Font or Nor This\n"
    )


@pytest.mark.slow
def test_curvature_is_shown_as_far_as_it_goes() -> None:
    """The panel goes no farther: not up to 100 centre distances, 200 times the maximum radius."""
    _, figure = sheet("wide_swing_slider_cam", "cam")
    axes = panel(figure, "Curvature radius")
    radius = next(line for line in axes.lines if line.get_label().startswith("cam, ≥")).get_ydata()
    low, high = axes.get_ylim()
    greatest = float(np.nanmax(radius))
    assert greatest < high < 10.0 * greatest
    assert low < float(np.nanmin(radius))


@pytest.mark.slow
def test_stresses_along_the_path_are_of_the_nominal_load() -> None:
    """Those of the table beside them count the factors of the load."""
    made, figure = sheet("gear_pair", "gear")
    (right,) = [axes for axes in figure.axes if axes.get_ylabel() == "stress under the nominal load [N/mm²]"]
    shown = max(float(np.nanmax(line.get_ydata())) for line in right.lines)
    assert shown < max(made.quantity("contact_stress").value)
    assert math.isfinite(shown)


@pytest.mark.slow
def test_numbers_below_small_drawings_do_not_meet() -> None:
    _, figure = sheet("loaded_gripper", "loads")
    for cam in ("main", "return"):
        assert len(panel(figure, f"{cam} cam: pressure").xaxis.get_majorticklocs()) <= 5
    _, figure = sheet("mutilated_gear_press", "gear")
    assert len(panel(figure, "Mesh zone").xaxis.get_majorticklocs()) <= 6


def test_a_legend_in_two_rows_leaves_the_heading_free() -> None:
    """Its last column is not the longest: with the width of full columns the heading would lie under a row."""
    texts = ["main cam, ρ ≥ 27.739 mm", "undercut", "return cam, ρ ≥ 48.698 mm", "undercut: 1/roller radius 60 mm"]
    axes = panels.page("legend").add_subplot()
    panels.heading(axes, "Curvature")
    for text in texts:
        axes.plot([0.0, 1.0], [0.0, 1.0], label=text)
    panels.legend_above(axes, 3)
    axes.figure.draw_without_rendering()
    heading, legend = axes._left_title.get_window_extent(), axes.get_legend().get_window_extent()  # type: ignore[attr-defined]
    assert not heading.overlaps(legend)


@pytest.mark.slow
def test_a_long_label_of_a_gear_is_no_disc_over_the_mechanism() -> None:
    """Gears of many teeth are drawn by their tip circle, and say so in their label."""
    gears = {"module": 2, "crank": 400, "idler": 700, "output": 400}
    _, figure = sheet("candy_feed", "analyze", gears=gears)
    boxes = [t.get_bbox_patch() for t in figure.axes[0].texts if t.get_text() == "3 (tip circle)"]
    assert [type(box.get_boxstyle()).__name__ for box in boxes] == ["Round"]


def test_a_negative_offset_has_a_true_minus_sign() -> None:
    _, figure = sheet("ty460_slider_crank", "crank", offset=-50.0)
    assert "offset −50 mm" in words(figure)


@pytest.mark.parametrize(("name", "command"), [("candy_feed", "synth dwell"), ("standing_feed", "synth dwell")])
def test_the_film_calls_the_same_stretch_a_dwell_as_the_sheet(name: str, command: str) -> None:
    """Asked for by its angle, a dwell is not that within a tolerance that nobody asked for, which is longer."""
    made = design(worked(name), command=command)
    chart = three_gear_four_bar.build(made, np.zeros(1)).chart
    (band,) = [band for band in chart.bands if band.name == "dwell"]
    if made.spec.dwell.angle is not None:
        start, width = made.back_step.start, made.dwell_angle
    else:
        start, width = made.tolerance_dwell.start, made.tolerance_dwell.crank_angle
    assert (band.start, band.end) == pytest.approx((math.degrees(start) % 360.0, math.degrees(start + width)), abs=1e-9)


@pytest.mark.slow
def test_least_contact_torques_have_a_true_minus_sign() -> None:
    _, figure = sheet("swing_gripper", "gripper", speed=60000)
    assert not [text for text in labels(panel(figure, "Torques")) if "-" in text]


@pytest.mark.slow
def test_a_pointed_chart_reaches_its_point() -> None:
    """Drawn by the rows of its table alone, the longest dwell of these gears would be 3 deg too short."""
    chart, curves = CHARTS["dwell-frame"], (-2.4, -1.8)
    figure = draw(chart, chart.table(*chart.range, curves, 91), curves, None)
    for i, (parameter, near) in enumerate(zip(curves, ((6.355, 6.365), (5.175, 5.185)), strict=True)):
        _, drawn = curve(figure, f"curve-{i}")
        longest = float(np.nanmax(chart.values(np.linspace(*near, 41), parameter)))
        assert float(np.nanmax(drawn)) == pytest.approx(longest, abs=0.2)
