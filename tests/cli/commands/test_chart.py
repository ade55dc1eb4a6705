"""`gearlink chart` as a user meets it: numbers against the reference tables (1e-12), pictures, refusals."""

from __future__ import annotations

import csv
import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from sweeps import ALL, mostly_slow

from gearlink.cli.commands.chart import draw
from gearlink.cli.views.figures.chart_list import CHARTS, OF_FILES, Marked

ROOT = Path(__file__).resolve().parents[3]
CASES = {
    case["id"]: case for case in json.loads((ROOT / "tests" / "reference" / "gear_linkage.json").read_text())["cases"]
}


def rows(text: str) -> list[list[float]]:
    return [[float(cell) for cell in row] for row in list(csv.reader(text.splitlines()))[1:]]


@pytest.mark.parametrize(
    ("chart", "case", "parameter"),
    [
        ("back-step", "fig4_5", "phi12_deg"),
        ("frame-ratio", "chart_d_i3_phi12", "phi12_deg"),
        ("nonuniformity", "fig4_6", "delta"),
    ],
)
def test_charts_of_the_thesis_as_csv(gearlink: Any, chart: str, case: str, parameter: str) -> None:
    known = CASES[case]
    curves = ",".join(str(value) for value in known["inputs"][parameter])
    ended = gearlink("chart", chart, "--curves", curves, "--range", "-5:-0.5", "--samples", 10, "--format", "csv")
    assert (ended.status, ended.err) == (0, "")
    found = np.array(rows(ended.out))
    np.testing.assert_allclose(found[:, 0], np.linspace(-5.0, -0.5, 10), rtol=1e-15)
    for i3, *column in zip(known["inputs"]["i3"], *known["outputs"]["table"], strict=True):
        row = int(np.flatnonzero(found[:, 0] == float(i3))[0])
        np.testing.assert_allclose(found[row, 1:], column, rtol=1e-12)


def test_the_share_over_the_frame_ratio(gearlink: Any) -> None:
    ended = gearlink("chart", "speed-swing", "--range", "1:4", "--samples", 7, "--format", "json")
    table = ended.json["tables"]["speed-swing"]
    assert table["columns"] == ["frame_ratio", "speed_swing_share"]
    assert [row[1] for row in table["rows"] if row[0] in (1, 1.5, 2, 3, 4)] == pytest.approx(
        CASES["fig4_4"]["outputs"]["y"], rel=1e-12, abs=0.0
    )


@pytest.mark.slow
def test_a_design_is_marked_with_its_numbers(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    spec = designs / "thesis_example_1.yaml"
    ended = gearlink("chart", "back-step", "--design", spec, "--format", "json", "--plot", "--out", tmp_path)
    assert ended.status == 0
    found = {name: quantity["value"] for name, quantity in ended.json["quantities"].items()}
    assert found["frame_ratio"] == pytest.approx(3.951703805053557, rel=1e-12, abs=0.0)
    assert found["back_step_angle"] == pytest.approx(20.061414725098526, rel=1e-12, abs=0.0)
    assert [path.name for path in tmp_path.iterdir()] == ["thesis-example-1-back-step-chart.png"]


def test_the_figure_plots_the_table_and_the_mark() -> None:
    chart = CHARTS["frame-ratio"]
    table = chart.table(-4.0, -1.0, (30.0, 60.0), 31)
    axes = draw(chart, table, (30.0, 60.0), Marked("mine", (-2.0, 5.0), (), 0.0)).axes[0]
    lines = {line.get_gid(): line for line in axes.get_lines()}
    for i in (0, 1):
        np.testing.assert_array_equal(lines[f"curve-{i}"].get_xdata(), table.data[0])
        np.testing.assert_array_equal(lines[f"curve-{i}"].get_ydata(), table.data[1 + i])
    assert (lines["design"].get_xdata()[0], lines["design"].get_ydata()[0]) == (-2.0, 5.0)
    assert "[" not in axes.get_ylabel()


def test_a_mark_outside_the_range_widens_it() -> None:
    chart = CHARTS["frame-ratio"]
    axes = draw(chart, chart.table(-4.0, -1.0, (30.0,), 31), (30.0,), Marked("mine", (-6.0, 5.0), (), 0.0)).axes[0]
    assert axes.get_xlim() == (-6.0, -1.0)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "ending"),
    mostly_slow([("back-step", "png"), ("back-step", "pdf"), *((name, "svg") for name in CHARTS)], 1),
)
def test_every_chart_is_drawn_the_same_every_time(gearlink: Any, tmp_path: Path, name: str, ending: str) -> None:
    folders = ["a", *(["b"] if ALL else [])]
    for folder in folders:
        command = ("chart", name, "--plot", "--plot-format", ending, "--out", tmp_path / folder, "--format", "csv")
        assert gearlink(*command).status == 0
    first, *again = ((tmp_path / folder / f"{name}-chart.{ending}").read_bytes() for folder in folders)
    assert first
    assert all(other == first for other in again)


def test_without_a_name_the_charts_are_listed(gearlink: Any) -> None:
    ended, known = gearlink("chart"), [*CHARTS, *OF_FILES]
    assert ended.status == 0
    assert [line.split()[0] for line in ended.out.splitlines() if not line.startswith(" ")] == known
    assert list(gearlink("chart", "--format", "json").json) == known


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (("backstep",), "nearest: back-step"),
        (("zzz",), "the charts are frame-ratio, back-step"),
        (("back-step", "--range", "1"), "'1' must be LOW:HIGH of i3"),
        (("back-step", "--range=-1:-2"), "must be LOW:HIGH"),
        (("back-step", "--range=-1:nan"), "must be LOW:HIGH"),
        (("back-step", "--range=-1:1"), "i3: 0 (limit < 0"),
        (("back-step", "--curves", "30,x"), "values of back_step_crank_angle [deg]"),
        (("back-step", "--curves", "190"), "below 180 deg"),
        (("nonuniformity", "--curves", "13"), "2 (1 - i3) ="),
        (("speed-swing", "--curves", "3"), "has one curve"),
        (("speed-swing", "--range", "0:3"), "frame over crank: 0 (limit >= 1"),
        (("back-step", "--design", "designs/ty460.yaml"), "a flatbed-press is not in the chart back-step"),
        (("back-step", "--design", "designs/thesis_example_3_mended.yaml"), "set gears.output to 20"),
        (("back-step", "--design", "designs/thesis_example_2.yaml"), "never steps back"),
        (("back-step", "--design", "designs/none.yaml"), "none.yaml"),
        (("back-step", *("--design", "designs/thesis_example_2.yaml") * 2), "a chart marks one design, not 2"),
        (
            ("residual", "designs/lift_cam.yaml", "--design", "designs/barrel_cam.yaml"),
            "a chart marks one design, not 2",
        ),
    ],
)
def test_refusals(gearlink: Any, monkeypatch: pytest.MonkeyPatch, arguments: tuple[str, ...], words: str) -> None:
    monkeypatch.chdir(ROOT)
    ended = gearlink("chart", *arguments)
    assert (ended.status, ended.out) == (2, "")
    assert words in ended.err


def test_links_away_from_the_family_are_told(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "own.yaml"
    path.write_text(
        "kind: three-gear-four-bar\ngears: {module: 2, crank: 40, idler: 72, output: 40}\n"
        "links: {crank: 36, frame: 150}\n"
    )
    ended = gearlink("chart", "frame-ratio", "--design", path, "--format", "csv")
    assert ended.status == 0
    assert "% away from that" in ended.err


def test_nothing_half_written_where_the_folder_refuses(gearlink: Any, tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    ended = gearlink("chart", "back-step", "--plot", "--out", tmp_path / "file")
    assert (ended.status, ended.out) == (2, "")
    assert [path.name for path in tmp_path.iterdir()] == ["file"]


def test_cells_beyond_the_reach_of_a_curve_are_blank(gearlink: Any) -> None:
    ended = gearlink("chart", "nonuniformity", "--curves", "6", "--range=-5:-0.1", "--format", "json")
    rows = ended.json["tables"]["nonuniformity"]["rows"]
    assert all((ratio is None) == (2.0 * (1.0 - i3) <= 6.0) for i3, ratio in rows)
    assert None in (ratio for _, ratio in rows)
