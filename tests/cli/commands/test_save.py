"""`--save`: the design of a command as a complete file. What is written in full is read back bit for bit."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS
from sweeps import mostly_slow

from gearlink.cli.reading.design_file import load, validate
from gearlink.core.base.kinds import KINDS

# what is a complete design as it stands, of every kind
FILES = [DESIGNS / f"{name}.yaml" for name in (
    "five_bar_path", "mutilated_gear_press", "six_bar_two_trains", "swing_gripper", "thesis_example_3_as_printed",
    "ty460", "ty460_input_gears", "ty460_slider_crank", "two_gear_drag_link", "wide_swing_oscillating_cam",
    "wide_swing_slider", "wide_swing_twin_cam", "wide_swing_twin_rocker",
)]  # fmt: skip
SYNTHESES = [
    ("synth dwell", "standing_feed", "frame_length"),
    ("synth dwell", "candy_feed", "dwell_angle"),
    ("synth back-step", "thesis_example_1", "back_step_angle"),
    ("synth variable-speed", "thesis_example_2", "speed_ratio_max"),
    ("synth momentary-dwell", "thesis_example_3_mended", "frame_length"),
    ("synth dwell", "two_gear_standing", "back_step_angle"),
    ("analyze", "wide_lever", "output_swing"),
    ("analyze", "hypocycloid_slider", "stroke"),
    ("analyze", "mutilated_gear_times", "dwell_share"),
    ("analyze", "five_bar_points", "path_width"),
    ("analyze", "five_bar_positions", "span_max"),
]


def spec_of(path: Path) -> Any:
    loaded = load(str(path))
    return validate(loaded, KINDS[loaded.data["kind"]].spec_model())


@pytest.mark.quick(2)
@pytest.mark.parametrize(("command", "name", "quantity"), SYNTHESES)
def test_what_a_synthesis_found_is_analysed_without_copying(
    gearlink: Any, tmp_path: Path, command: str, name: str, quantity: str
) -> None:
    path = tmp_path / "full.yaml"
    sized = gearlink(*command.split(), DESIGNS / f"{name}.yaml", "--save", path, "--format", "json")
    assert sized.status == 0, sized.err
    assert f"wrote {path}; try: gearlink analyze {path}" in sized.err
    found = gearlink("analyze", path, "--format", "json")
    assert found.status == 0, found.out
    before, after = json.loads(sized.out)["quantities"], json.loads(found.out)["quantities"]
    assert after["motion"] == before["motion"] if "motion" in before else True
    assert after[quantity]["value"] == pytest.approx(before[quantity]["value"], rel=1e-9)
    assert not spec_of(path).sized_by("analyze")


@pytest.mark.slow
def test_a_cam_axis_that_was_chosen_is_written_in_place_of_its_rule(gearlink: Any, tmp_path: Path) -> None:
    path, sized = tmp_path / "full.yaml", ("--set", "cam.center=null", "--set", "size={pressure_angle: 28}")
    before = gearlink("cam", DESIGNS / "swing_gripper.yaml", *sized, "--save", path, "--format", "json")
    spec, quantities = spec_of(path), json.loads(before.out)["quantities"]
    assert spec.size is None
    assert spec.cam.center == quantities.pop("cam_center")["value"]
    after = json.loads(gearlink("cam", path, "--format", "json").out)
    assert after["quantities"] == quantities
    assert after["checks"] == json.loads(before.out)["checks"]


@pytest.mark.slow
def test_a_cam_axis_that_no_rule_finds_stays_asked_for(gearlink: Any, tmp_path: Path) -> None:
    path, sized = tmp_path / "full.yaml", ("--set", "cam.center=null", "--set", "size={pressure_angle: 2}")
    ended = gearlink("gripper", DESIGNS / "swing_gripper.yaml", *sized, "--save", path, "--quiet")
    assert ended.status == 1, ended.err
    assert spec_of(path).size.pressure_angle == 2.0


@pytest.mark.quick(2)
@pytest.mark.parametrize("file", mostly_slow(FILES[::3] + FILES, len(FILES[::3])), ids=lambda file: file.stem)
def test_a_design_without_a_task_is_written_as_it_is(gearlink: Any, tmp_path: Path, file: Path) -> None:
    spec, path = spec_of(file), tmp_path / "copy.yaml"
    gearlink(*spec.commands()[0].split(), file, "--save", path, "--quiet")
    assert spec_of(path) == spec


def test_comments_name_unit_meaning_source_and_rounding(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "full.yaml"
    line = ["synth", "dwell", DESIGNS / "standing_feed.yaml", "--set", "limits.transmission_angle=45", "--save", path]
    assert gearlink(*line, "--round", "0.01").status == 0
    text = path.read_text()
    assert text.startswith("# standing-feed: `gearlink synth dwell ")
    assert "# required: dwell: {window: 70, tolerance: 0.5}" in text
    assert "frame: 114.85" in text
    assert "# mm: frame AD; found by synth dwell; 114.8527195 rounded to 0.01 mm" in text
    assert "# mm: module of all three gears; required" in text
    assert "# deg: minimum transmission angle; from --set" in text
    assert spec_of(path).links.frame == 114.85


@pytest.mark.parametrize(
    ("command", "name", "given"),
    [
        (("synth", "swing"), "crank_rocker.yaml", "frame: 120                    # mm: frame AD; given as swing.frame"),
        (("synth", "dwell", "--set", "dwell.crank=30"), "standing_feed.yaml", "# mm: crank AB; given as dwell.crank"),
    ],
)
def test_what_the_file_gives_is_not_called_found(
    gearlink: Any, designs: Path, command: tuple[str, ...], name: str, given: str
) -> None:
    text = gearlink(*command[:2], designs / name, *command[2:], "--save", "-").out
    assert given in text
    assert text.count("found by synth") >= 2


@pytest.mark.slow
def test_a_rounding_that_breaks_a_check_is_said(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "full.yaml"
    ended = gearlink("synth", "dwell", DESIGNS / "standing_feed.yaml", "--save", path, "--round", "1")
    assert ended.status == 1
    assert "rounded to 1 mm it fails GL313 dwell-window: dwell window: 6" in ended.err
    assert gearlink("analyze", path).status == 1


@pytest.mark.slow
def test_what_failed_before_it_was_rounded_seeks_no_remedy_again(
    gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Nor a better place of the cams: the remedies of the design as it is are the ones that are shown."""
    from gearlink.core.base.remedies.trials import Bench
    from gearlink.core.machines.swing_gripper.design import GripperCams

    sought: list[Any] = []
    centers: list[float] = []
    monkeypatch.setattr(Bench, "remedy", lambda *asked: sought.append(asked) or ())
    monkeypatch.setattr(GripperCams, "_center_remedy", lambda _, limit: centers.append(limit) or "move the cams")
    line = ["analyze", DESIGNS / "swing_gripper.yaml", "--set", "limits.pressure_angle=5", "--format", "json"]
    ended = gearlink(*line)
    assert ended.status == 1
    first = len(sought), sorted(centers)
    assert first[0] > 0
    assert centers
    assert len(centers) == len(set(centers))
    gearlink(*line, "--save", tmp_path / "full.yaml", "--round", "0.1")
    assert (len(sought), sorted(centers)) == (2 * first[0], sorted(2 * first[1]))


@pytest.mark.parametrize("step", ["100", "40"])
def test_a_rounding_that_leaves_no_mechanism_writes_nothing(gearlink: Any, tmp_path: Path, step: str) -> None:
    path = tmp_path / "full.yaml"
    ended = gearlink(
        "synth", "dwell", DESIGNS / "candy_feed.yaml", "--save", path, "--round", step, "--set", "gears.module=1"
    )
    assert ended.status == 2
    assert f"rounded to {step} mm the mechanism does not exist" in ended.err
    assert not path.exists()


def test_suggest_saves_the_repaired_design(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "repaired.yaml"
    ended = gearlink("analyze", DESIGNS / "thesis_example_3_as_printed.yaml", "--suggest", "--save", path)
    assert ended.status == 0
    assert re.search(r"; was [\d.]+: --suggest$", path.read_text(), re.MULTILINE)
    assert gearlink("analyze", path, "--quiet").status == 0


def test_an_existing_file_is_kept_without_force(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("my work")
    line = ["crank", DESIGNS / "ty460_slider_crank.yaml", "--save", path]
    for extra in ([], ["--suggest"]):
        ended = gearlink(*line, *extra)
        assert ended.status == 2
        assert "--force" in ended.err
        assert path.read_text() == "my work"
    assert gearlink(*line, "--force").status == 0
    assert "stroke: 310" in path.read_text()


def test_a_design_without_a_name_is_named_after_the_new_file(gearlink: Any, tmp_path: Path) -> None:
    source, path = tmp_path / "a.yaml", tmp_path / "b c.yaml"
    source.write_text("kind: slider-crank\nstroke: 100\nrod: 300\n")
    gearlink("crank", source, "--save", path)
    assert spec_of(path).name == "b c"


@pytest.mark.parametrize("step", ["0", "-1", "1e9", "x"])
def test_a_step_that_rounds_nothing_is_refused(gearlink: Any, tmp_path: Path, step: str) -> None:
    line = ["crank", DESIGNS / "ty460_slider_crank.yaml", "--save", tmp_path / "x.yaml", "--round", step]
    assert gearlink(*line).status == 2


def test_round_without_save_is_refused(gearlink: Any) -> None:
    ended = gearlink("crank", DESIGNS / "ty460_slider_crank.yaml", "--round", "0.01")
    assert ended.status == 2
    assert "--round needs --save" in ended.err


def test_a_refused_design_writes_nothing(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "x.yaml"
    ended = gearlink("crank", DESIGNS / "ty460_slider_crank.yaml", "--set", "stroke=5000", "--save", path)
    assert ended.status == 2
    assert list(tmp_path.iterdir()) == []


@pytest.mark.quick(1)
@pytest.mark.parametrize("line", ["analyze", "gear", "report", "check"])
@pytest.mark.usefixtures("small_pictures")
def test_a_file_that_asks_for_a_synthesis_serves_every_command(gearlink: Any, tmp_path: Path, line: str) -> None:
    extra = ["--out", tmp_path] if line == "report" else []
    assert gearlink(line, DESIGNS / "standing_feed.yaml", *extra, "--quiet").status == 0


def test_two_tasks_in_one_file_leave_the_choice_to_the_user(gearlink: Any) -> None:
    ended = gearlink("analyze", DESIGNS / "candy_feed.yaml", "--set", "back_step.angle=20")
    assert ended.status == 2
    assert "`synth dwell` or `synth back-step` finds it\n" in ended.err
    assert "help: keep one of their sections" in ended.err
