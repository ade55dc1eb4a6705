"""The sheet of a study: what is drawn is what was found; a page links the marks of one design."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from sweeps import ALL

from gearlink.cli.views.figures.study import draw
from gearlink.core.studies.explore.exploration import Exploration
from gearlink.core.studies.study.spec import StudySpec

KEYS: dict[str, Any] = {
    "kind": "study",
    "name": "idlers",
    "design": {
        "kind": "three-gear-four-bar",
        "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40},
        "dwell": {"angle": 135},
    },
    "variables": {"gears.idler": {"from": 60, "to": 90}, "gears.module": {"values": [2, 3]}},
    "minimize": {"frame_length": "20 mm", "back_step_angle": 0.05},
    "maximize": {"min_transmission_angle": "2 deg"},
}


@pytest.fixture(scope="module")
def study() -> Exploration:
    return Exploration(StudySpec.model_validate_json(json.dumps(KEYS)))


def test_marks_and_lines_are_the_kept_designs(study: Exploration) -> None:
    figure = draw("explore", study)
    *scatter, parallel = [axes for axes in figure.axes if axes.axison]
    rows = study.found.rows
    assert len(scatter) == 3
    marks = {line.get_gid(): line for axes in scatter for line in axes.get_lines()}
    for row in rows:
        (x,), (y,) = marks[f"row-{row.index}-0-1"].get_data()
        assert (x, y) == row.figures[:2]
    lines = {line.get_gid(): line for line in parallel.get_lines()}
    assert sum((name or "").startswith("row-") for name in lines) == len(rows)
    heights = lines[f"row-{rows[0].index}-line"].get_ydata()
    assert heights[2] == 1.0  # the best of the first objective is up
    assert scatter[0].get_xlabel() == "frame length [mm]"


def test_axes_of_variables_have_their_searched_ends_and_lines_the_numbers_of_their_designs(study: Exploration) -> None:
    """That a kept design stands at an end of a range (GL162) was not to be seen, nor which one to ask for."""
    parallel = draw("explore", study).axes[-1]
    found = {text.get_gid() or text.get_position(): text.get_text() for text in parallel.texts}
    assert [found[x, y] for x in (0, 1) for y in (-0.04, 1.04)] == ["60", "90", "2", "3"]
    heights = {line.get_gid(): line.get_ydata() for line in parallel.get_lines()}
    for row in study.found.rows:
        assert found[f"row-{row.index}-name"] == str(row.index)
        idler, module = (float(value) for _, value in row.variables)
        assert heights[f"row-{row.index}-line"][:2] == pytest.approx([(idler - 60.0) / 30.0, module - 2.0], abs=1e-12)


def test_keys_of_a_section_for_one_command_have_their_units(study: Exploration) -> None:
    """The axis and the JSON of a study over `dwell.angle` had the unit 1."""
    assert study.problem.base.units["dwell.angle"] == "deg"


def test_marks_are_explained_and_numbers_stand_free_of_their_axes() -> None:
    keys = KEYS | {"minimize": {"frame_length": "20 mm"}}
    figure = draw("explore", Exploration(StudySpec.model_validate_json(json.dumps(keys))))
    scatter, parallel = figure.axes
    words = [text.get_text() for text in scatter.get_legend().get_texts()]
    assert words[:2] == ["satisfies everything", "kept: one design per box of the front"]
    upright = [line for line in parallel.get_lines() if len(set(line.get_xdata())) == 1]
    ends = {text.get_position() for text in parallel.texts}
    assert len(upright) == 4
    for line in upright:
        assert {(x, y) for x, y in ends if x == line.get_xdata()[0]} == {
            (line.get_xdata()[0], y) for y in (-0.04, 1.04)
        }
        assert -0.04 < min(line.get_ydata()) < max(line.get_ydata()) < 1.04


@pytest.mark.slow
def test_picture_and_page(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "study.yaml"
    path.write_text(json.dumps(KEYS))
    assert gearlink("explore", path, "--plot", "--plot-format", "svg", "--out", tmp_path, "-q").status == 0
    first = (tmp_path / "idlers-explore.svg").read_bytes()
    assert b'id="row-' in first
    if ALL:
        gearlink("explore", path, "--plot", "--plot-format", "svg", "--out", tmp_path, "-q")
        assert (tmp_path / "idlers-explore.svg").read_bytes() == first
    assert gearlink("report", path, "--out", tmp_path).status == 0
    page = (tmp_path / "idlers.html").read_text()
    assert 'id="row-' in page
    assert "linkRows" in page
    (names,) = re.findall(r'<script type="application/json" class="names">(.*?)</script>', page)
    named = json.loads(names)
    assert set(named) == set(re.findall(r'id="row-(\d+)-', page))
    assert all(words.startswith(f"design {index}: ") and "," in words for index, words in named.items())


@pytest.mark.quick(1)
@pytest.mark.parametrize("objectives", [["frame_length"], ["frame_length", "back_step_angle", "gear_gap"]])
def test_of_an_empty_front_there_is_nothing_to_draw(gearlink: Any, tmp_path: Path, objectives: list[str]) -> None:
    data = {**KEYS, "minimize": dict.fromkeys(objectives, 1), "maximize": {}, "where": ["frame_length <= 20 mm"]}
    path = tmp_path / "study.yaml"
    path.write_text(json.dumps(data))
    ended = gearlink("explore", path, "--plot", "--plot-format", "svg", "--out", tmp_path)
    assert ended.status == 1
    assert "0 satisfy everything" in ended.out
    assert "nothing to draw: none of 62 designs" in (tmp_path / "idlers-explore.svg").read_text()
