"""Rounding is shown as 0, at its scale; what is small but real stays, and JSON keeps every digit."""

from __future__ import annotations

import math
import re
from typing import Any

import pytest

from gearlink.cli.render.numbers import quiet, readable_rows, scales
from gearlink.core.base.report import Check, Quantity, Report, Table, without_noise

NOISE = re.compile(r"\d[\d.]*e-1[2-9]")


@pytest.mark.parametrize("scale", [1.0, 0.3, 1000.0, 2970.0, 1e-9, 1e12])
def test_eight_ulp_of_the_scale(scale: float) -> None:
    assert without_noise(8.0 * math.ulp(scale), scale) == 0.0
    assert without_noise(-8.0 * math.ulp(scale), scale) == 0.0
    for real in (8.5 * math.ulp(scale), -1e-14 * scale, 1e-9 * scale, scale):
        assert without_noise(real, scale) == real


def test_nothing_is_noise_beside_nothing() -> None:
    assert without_noise(1e-300, 0.0) == 1e-300
    assert quiet([None, "a", 3, 1e-17], 0.0) == [None, "a", 3, 1e-17]


def test_a_column_that_is_noise_as_a_whole_is_judged_beside_its_unit() -> None:
    table = Table("t", ("noise", "small", "mixed"), ("deg",) * 3, ([2.4e-14, 0.0], [1e-10, 2e-10], [2.4e-14, 1e-9]))
    assert readable_rows(table) == [["2.4e-14", "1e-10", "2.4e-14"], ["0", "2e-10", "1e-09"]]
    assert readable_rows(table, scale={"deg": 360.0}) == [["0", "1e-10", "2.4e-14"], ["0", "2e-10", "1e-09"]]


def test_each_unit_has_its_own_scale() -> None:
    report = Report(
        "k",
        "n",
        "c",
        (
            Quantity("a", [1e-14, -200.0], "mm", "", ""),
            Quantity("b", 1e-14, "1", "", ""),
            Quantity("n", 7, "1", "", ""),
        ),
        (Check("GL301", "x", "pass", "", 1e-12, 3.0, "mm/s"),),
        (Table("t", ("v", "w"), ("mm/s", "-"), ([5000.0, None], ["a", math.inf])),),
    )
    assert scales(report) == {"mm": 200.0, "1": 1.0, "mm/s": 5000.0, "-": 0.0}


def test_nothing_is_small_beside_the_radius_of_a_nearly_straight_curve() -> None:
    table = Table("cam", ("curvature_radius", "x"), ("mm", "mm"), ([1e18, 25.0], [28.0, 2.5]))
    found = Quantity("min_curvature_radius", 1e18, "mm", "", "")
    report = Report("k", "n", "c", (Quantity("lift_max", 12.0, "mm", "", ""), found), (), (table,))
    assert scales(report)["mm"] == 28.0
    assert readable_rows(table, 1, scales(report)) == [["1e+18", "28"], ["25", "2.5"]]


def test_all_results_of_a_cam_with_straight_flanks_are_shown(gearlink: Any, designs: Any) -> None:
    page = gearlink("cam", designs / "tangent_cam.yaml", "--all").out
    assert re.search(r"^lift_max .* 17\.500 +mm", page, re.MULTILINE)
    shown = gearlink("cam", designs / "tangent_cam.yaml", "--table", "main_cam", "--format", "csv").out
    assert {row.rsplit(",", 1)[1] for row in shown.splitlines()[2:20]} == {""}


@pytest.mark.quick(2)
@pytest.mark.parametrize(
    ("command", "design"),
    [
        ("synth momentary-dwell", "thesis_example_3_mended"),
        ("press", "ty460"),
        ("cam", "ty460"),
        ("gripper", "swing_gripper"),
        ("analyze", "five_bar_positions"),
        ("cam", "wide_swing_cycle"),
    ],
)
def test_no_noise_among_the_results(gearlink: Any, designs: Any, command: str, design: str) -> None:
    path = designs / f"{design}.yaml"
    assert not NOISE.search(gearlink(*command.split(), path).out)


def test_json_keeps_full_precision(gearlink: Any, designs: Any) -> None:
    """The minimum speed of a momentary dwell is 0 but for rounding: the table says 0, JSON what was computed."""
    line = ("synth", "momentary-dwell", designs / "thesis_example_3_mended.yaml")
    assert re.search(r"speed_ratio_min .* 0 *$", gearlink(*line, "--all").out, re.MULTILINE)
    value = gearlink(*line, "--format", "json").json["quantities"]["speed_ratio_min"]["value"]
    assert value == pytest.approx(0.0, abs=1e-15)


def test_lines_with_a_unit_each_have_the_digits_of_a_drawing() -> None:
    """Limits of a measure over balls, 237.441 and 237.235 mm, were 237.4 and 237.2 in the gear table."""
    item, gear = (
        ("measure, maximum", "measure, minimum", "teeth", "module", "angle"),
        (237.4412, 237.2349, 64, 3.5, 21.6081),
    )
    unit = ("mm", "mm", "", "mm", "deg")
    table = Table("drawing", ("item", "gear 2", "unit"), ("1", "1", "1"), (item, gear, unit))
    assert [row[1] for row in readable_rows(table, digits=None)] == ["237.441", "237.235", "64", "3.5", "21.61"]
    assert [row[1] for row in readable_rows(table, digits=4)] == ["237.4", "237.2", "64", "3.5", "21.61"]
