"""Sheets of tolerance and register: what they draw is what the tables say."""

from __future__ import annotations

import json
import math
from typing import Any

import numpy as np
import pytest
from factory import design, worked
from matplotlib.figure import Figure
from sheets import fits_a_page, meetings, panel, placed_sheet, sheet, tagged

from gearlink.cli.views.figures import tolerance
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.write import panels
from gearlink.core.studies.tolerance_study.samples import Course

SMALL = {"tolerance__samples": 128}


@pytest.mark.slow
def test_histogram_is_of_the_samples_with_nominal_value_and_limit() -> None:
    design, figure = sheet("candy_feed_tolerances", "tolerance", **SMALL)
    axes = next(axes for axes in figure.axes if axes.get_xlabel().startswith("back step angle"))
    (outline,) = [patch for patch in axes.patches if patch.get_gid() == "density"]
    x, y = outline.get_xy().T
    assert 0.5 * abs(float(np.dot(x[:-1], y[1:]) - np.dot(x[1:], y[:-1]))) == pytest.approx(1.0, rel=1e-9)
    verticals = [float(line.get_xdata()[0]) for line in axes.lines]
    assert 20.4 in [pytest.approx(place, rel=1e-12) for place in verticals]
    assert design.nominal["back_step_angle"] in verticals
    assert design.result.values["back_step_angle"].size == 128  # every sample, where there are few


@pytest.mark.slow
def test_bars_are_the_linear_shares() -> None:
    design, figure = sheet("candy_feed_tolerances", "tolerance", **SMALL)
    axes = next(axes for axes in figure.axes if axes.get_title(loc="left") == "Contributions")
    table = design.table_contributions()
    rows = [dict(zip(table.columns, row, strict=True)) for row in zip(*table.data, strict=True)]
    wanted = sorted(row["linear"] for row in rows if row["quantity"] == "back_step_angle")
    assert [bar.get_width() for bar in axes.patches] == pytest.approx(wanted, rel=1e-12)
    assert math.fsum(wanted) == pytest.approx(1.0, rel=1e-12)


def test_percentiles_over_the_cycle_are_those_of_the_table() -> None:
    design, figure = sheet("candy_feed_tolerances", "tolerance", **SMALL)
    axes = next(axes for axes in figure.axes if "over the cycle" in axes.get_title(loc="left"))
    table = design.table_band()
    middle = next(line for line in axes.lines if line.get_label() == "50 %")
    assert np.asarray(middle.get_xdata()) == pytest.approx(np.append(table["input"], 360.0), rel=1e-12)
    assert np.asarray(middle.get_ydata()) == pytest.approx(np.append(table["q50"], table["q50"][0]), rel=1e-12)
    begins = next(line for line in axes.lines if line.get_label() == "the dwell begins")
    assert begins.get_xdata()[0] == pytest.approx(224.849, abs=0.01)


LONG = "x" * 90
"""A file may name its links so."""
WATT: dict[str, Any] = {
    "name": "watt",
    "tolerance": {"sources": {f"links.{LONG}[2]": {"plus_minus": 0.02}, "links.arm[2]": {"plus_minus": 0.02}}},
    "register": {"radius": 50},
}


def _watt() -> dict[str, Any]:
    """The Watt six-bar with tolerances, its output link with a long name."""
    return json.loads(json.dumps(worked("planar_watt") | WATT).replace('"output"', f'"{LONG}"'))


@pytest.mark.slow
@pytest.mark.filterwarnings("error")
@pytest.mark.parametrize("drawn", ["register", "tornado"])
def test_long_names_leave_the_panels_their_width(drawn: str) -> None:
    """Their panels had no width: names beside bars, in legends and headings took all of the page."""
    figure = panels("register", design(_watt(), command="register")) if drawn == "register" else (
        tolerance.draw_tornado(design(_watt()))
    )  # fmt: skip
    settled(figure)
    assert min(axes.get_position().width for axes in figure.axes) > 0.2
    assert not [each for each in meetings(figure) if "beside the page" in each]


@pytest.mark.slow
def test_a_tornado_leaves_out_what_the_samples_do_not_have() -> None:
    """The quick-return ratio of an output, which is not computed for many designs at once, was a fault."""
    made = design(_watt(), command="tolerance")
    assert f"{LONG}.quick_return_ratio" in made.problem.names
    assert tolerance.draw_tornado(design(_watt())).axes


@pytest.mark.parametrize(
    ("places", "end"), [(np.arange(120) * 18.0, 2160.0), (np.arange(121) * 0.5, 60.0)], ids=["six turns", "a stretch"]
)
def test_course_reaches_to_the_end_of_its_cycle(places: np.ndarray, end: float) -> None:
    rows = np.linspace(-2.0, 2.0, 5)[:, None] * (1.0 + 0.5 * np.cos(places / 40.0))
    course = Course("rocker_angle", "input_angle", ("deg", "deg"), places, 0.0 * places, rows, None)
    axes: Any = Figure().add_subplot()
    tolerance._course(axes, course)
    assert axes.get_xlim() == (0.0, end)
    assert axes.lines[0].get_xdata()[-1] == end


@pytest.mark.slow
@pytest.mark.parametrize("name", ["candy_feed_tolerances", "ty460_register", "swing_gripper_register"])
def test_register_sheet_shows_every_source(name: str) -> None:
    design, figure = sheet(name, "register")
    axes = next(axes for axes in figure.axes if axes.get_title(loc="left") == "By source")
    assert {label.get_text() for label in axes.get_yticklabels()} == {row.source for row in design.budgets[0].rows}


def test_band_over_the_dwell_is_that_of_the_budget() -> None:
    design, figure = sheet("candy_feed_tolerances", "register")
    axes: Any = figure.axes[0]
    line = next(line for line in axes.lines if line.get_label() == "99.73 % torque +1")
    assert np.asarray(line.get_ydata()) == pytest.approx(design.budgets[0].band, rel=1e-12)


@pytest.mark.slow
def test_lines_along_the_zone_are_the_sources_at_their_limits() -> None:
    design, figure = sheet("ty460_register", "register")
    axes = next(axes for axes in figure.axes if axes.get_title(loc="left").startswith("By source, each"))
    gains = {one.source: one for one in design.contributions(design.input_angles, 1)}
    named = [line for line in axes.lines if line.get_label() in gains]
    assert len(named) == 6
    for line in named:
        one = gains[line.get_label()]
        assert np.asarray(line.get_ydata()) == pytest.approx(one.limit * np.abs(one.gain - one.gain[0]), rel=1e-12)


@pytest.mark.slow
@pytest.mark.parametrize("name", ["ty460_register", "candy_feed_tolerances"])
def test_a_register_sheet_is_a_page_on_which_every_source_can_be_read(name: str) -> None:
    """That of a press was 390 mm long."""
    figure = placed_sheet(name, "register").figure
    assert fits_a_page(figure)
    assert figure.get_figwidth() == 8.27
    assert meetings(figure) == []


@pytest.mark.slow
def test_a_register_sheet_says_each_thing_once_and_what_it_leaves_out() -> None:
    _, figure = sheet("candy_feed_tolerances", "register")
    titles = [axes.get_title(loc="left") for axes in figure.axes]
    assert "By source, each at its limit, the 6 largest of 7; dashed: torque −1" in titles
    _, figure = sheet("ring_feed_tolerances", "register")
    named = [text.get_text() for axes in figure.axes if axes.get_legend() for text in axes.get_legend().get_texts()]
    assert named.count("torque turns") == 1
    assert "By source, each at its limit" in [axes.get_title(loc="left") for axes in figure.axes]
    (marks,) = tagged(sheet("loaded_measured_cam", "register").figure, "standstills")
    assert len(marks.get_xdata()) > 12, "of many turns of a torque near 0 a mark each, no thicket of lines"
    for axes in figure.axes[:3]:
        assert axes.get_ylim()[1] > 1.04 * max(float(np.max(line.get_ydata())) for line in axes.lines[:2])


def test_a_spread_has_its_unit() -> None:
    _, figure = sheet("candy_feed_tolerances", "tolerance", **SMALL)
    assert any(" deg" in axes.get_title(loc="left") for axes in figure.axes)


@pytest.mark.slow
def test_numbers_below_histograms_have_room() -> None:
    """At 8 pt an axis of 2.8 in takes some 40 letters, two of them between neighbours; few samples have few bins."""
    design, figure = sheet("ty460_register", "tolerance", **SMALL)
    found = [axes for axes in figure.axes if axes.get_ylabel() == "density"]
    assert len(found) == 4
    bins = math.ceil(2.0 * math.cbrt(len(next(iter(design.result.values.values())))))
    assert bins < 14
    for axes in found:
        low, high = axes.get_xlim()
        ticks = [tick for tick in axes.get_xticks() if low <= tick <= high]
        assert len(ticks) >= 2
        assert sum(len(word) + 2 for word in axes.xaxis.get_major_formatter().format_ticks(ticks)) <= 42
        assert len(np.unique(axes.patches[0].get_xy()[:, 0])) == bins + 1


def test_an_output_that_a_law_prescribes_has_no_band() -> None:
    places, still = np.arange(4) * 90.0, np.zeros((5, 4))
    course = Course("output_angle", "theta", ("deg", "deg"), places, 10.0 * np.sin(places), still, None)
    assert not tolerance._scatters(course)
    still[1] = -1e-9
    still[0] = np.nan
    assert tolerance._scatters(course)


@pytest.mark.slow
def test_a_register_over_a_range_fills_its_panel() -> None:
    """A function is known over its range alone: its curve had filled a sixth of a revolution."""
    made, figure = sheet("five_bar_function_tolerances", "register")
    axes = panel(figure, "Over the cycle")
    table = np.asarray(made.table_cycle()["input_angle"])
    assert axes.get_xlim() == pytest.approx((table.min(), table.max()), rel=1e-12)
    assert panel(sheet("slider_crank_tolerances", "register").figure, "Over the cycle").get_xlim() == (0.0, 360.0)


@pytest.mark.slow
def test_a_tornado_has_no_panel_of_rounding() -> None:
    """The agreement of two ways of a gripper, 0 to 1e-16 rad, had the largest bars."""
    titles = [axes.get_title(loc="left") for axes in tolerance.draw_tornado(design("swing_gripper_register")).axes]
    assert titles
    assert not any("agreement" in title for title in titles)


def test_sheets_say_that_no_tolerance_changes_a_result() -> None:
    """A face width, of which no result of the tolerances depends, left an empty tornado."""
    made = design(
        "gear_pair",
        face_width=20.0,
        tolerance={"sources": {"face_width": {"plus_minus": 0.1}}, "require": ["contact_ratio >= 1"], "samples": 128},
    )
    words = "no tolerance of this file changes a result"
    assert [text.get_text() for text in tolerance.draw_tornado(made).axes[0].texts] == [words]
    assert [text.get_text() for text in tolerance.draw(made.of_command("tolerance")).axes[0].texts] == [words]


def test_two_limits_have_one_name_in_the_legend_of_a_tornado() -> None:
    (axes,) = tolerance.draw_tornado(design("slider_crank_tolerances")).axes
    words = axes.get_legend_handles_labels()[1]
    assert words.count("limit") == 1
    assert sum(line.get_color() == style.RED for line in axes.lines) == 2


@pytest.mark.slow
def test_four_quantities_of_one_source_have_room_below_a_stamp() -> None:
    """Panels for one bar were lower than their words: the layout gave up with a warning, all lay on each other."""
    one = {"roller_radius": {"plus_minus": 0.01}}
    figure = tolerance.draw_tornado(design("loaded_measured_cam", tolerance__sources=one))
    assert len(figure.axes) == 4
    style.stamp(figure, "fails: one of its checks")
    settled(figure)
    bars = [axes.get_window_extent().height / figure.dpi for axes in figure.axes]
    assert min(bars) > 0.2  # in


def test_sizes_that_are_toleranced_themselves_come_last() -> None:
    """Three of four rows of a crank-rocker were its given links, each by itself alone."""
    keys = {
        "swing": None,
        "links": {"crank": 22, "coupler": 95, "rocker": 60, "frame": 105},
        "tolerance": {"sources": {f"links.{name}": {"plus_minus": 0.02} for name in ("crank", "coupler", "rocker")}},
        "tolerance__samples": 64,
    }
    made = design("crank_rocker", **keys)
    for figure in (tolerance.draw(tolerance.study_of(made)), tolerance.draw_tornado(made)):
        titles = [axes.get_title(loc="left") for axes in figure.axes]
        assert titles[0].startswith("rocker swing")
        assert not any(title.startswith(("crank length", "coupler length")) for title in titles)
