"""A designer's first hour, played: from the list of kinds to the drawing, no number copied by hand.

The analysis of what a synthesis saved is that synthesis's result to 1e-9, the rounding of its closed forms.
"""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest

from gearlink.cli.exit_codes import ExitCode


@pytest.mark.slow
@pytest.mark.usefixtures("small_pictures")
def test_first_hour(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("COLUMNS", "80")
    assert "gearlink new KIND" in gearlink("new").out

    # a feed that dwells, with three numbers of one's own
    begun = gearlink("new", "three-gear-four-bar", "--out", "feed.yaml")
    assert "try: gearlink synth dwell feed.yaml" in begun.err
    text = Path("feed.yaml").read_text()
    assert "name: feed" in text
    for key, value in (("crank", "44"), ("output", "44"), ("window", "60")):
        text, count = re.subn(rf"(?m)^(  {key}): [\d.]+", rf"\1: {value}", text, count=1)
        assert count == 1, key
    Path("feed.yaml").write_text(text.replace("# input_speed:", "input_speed: 90 #", 1))

    # what can be had, what it is, and the whole of it in a file
    table = gearlink("synth", "dwell", "feed.yaml", "--candidates")
    assert table.status == 0
    assert re.search(r"(?m)^ *[\d.]+ +\d+ +pass ", table.out)  # module, idler, findings; lengths follow
    sized = gearlink("synth", "dwell", "feed.yaml", "--save", "full.yaml", "--format", "json")
    assert sized.status == 0
    assert "try: gearlink analyze full.yaml" in sized.err
    assert "found by synth dwell" in Path("full.yaml").read_text()

    # its analysis, without a number copied by hand
    found = gearlink("analyze", "full.yaml", "--format", "json")
    assert found.status == 0
    for name in ("frame_length", "tolerance_dwell_angle", "output_acceleration_max", "tolerance_dwell_time"):
        before, after = (each.json["quantities"][name] for each in (sized, found))
        assert after["value"] == pytest.approx(before["value"], rel=1e-9), name
        assert after["unit"] == before["unit"]
    assert [c["status"] for c in found.json["checks"] if c["name"] == "dwell-window"] == ["pass"]
    assert gearlink("explain", "phi_tol").out.startswith("phi_tol: tolerance_dwell_angle")

    # the page, the profiles, and all of it in one run
    assert gearlink("report", "full.yaml", "--out", "out", "--quiet").status == 0
    assert gearlink("export", "full.yaml", "--out", "out", "--quiet").status == 0
    written = sorted(path.suffix for path in Path("out").iterdir())
    assert ".html" in written
    assert ".dxf" in written
    assert gearlink("batch", ".").status == 0


def test_a_design_that_fails_is_repaired_and_saved(gearlink: Any, tmp_path: Path, designs: Path) -> None:
    failing, path = designs / "thesis_example_3_as_printed.yaml", tmp_path / "repaired.yaml"
    assert gearlink("analyze", failing).status == 1
    assert gearlink("analyze", failing, "--suggest", "--save", path).status == 0
    assert gearlink("check", path).status == 0


def test_a_dwell_that_steps_back_says_so_and_the_tolerance_is_honoured(gearlink: Any, tmp_path: Path) -> None:
    """Within 120 deg of the crank this output steps back 13.54 deg; within +-1 deg it stands 35.88 deg."""
    path = tmp_path / "feed.yaml"
    path.write_text(
        "kind: three-gear-four-bar\ngears: {module: 2, crank: 40, idler: 72, output: 40}\ndwell: {angle: 120}\n"
    )
    ended = gearlink("check", path)
    assert ended.status == 0
    assert "warn GL315 back-step" in ended.out
    assert "half of the back-step of the output during the dwell: 6.77 deg" in ended.out
    assert "give dwell.window and dwell.tolerance instead of dwell.angle" in ended.out
    ended = gearlink("synth", "dwell", path, "--set", "dwell_tolerance=1", "--quantity", "tolerance_dwell_angle")
    assert float(ended.out.split()[0]) == pytest.approx(35.87924612, abs=1e-8)
    found = gearlink("synth", "dwell", path, "--set", "dwell_tolerance=1", "--format", "json").out
    assert json.loads(found)["quantities"]["dwell_tolerance"]["value"] == pytest.approx(6.76914, abs=1e-5)


def test_a_section_that_a_result_needs_is_shown_where_the_error_says(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "swing.yaml"
    path.write_text(
        "kind: wide-swing-cam\nlayout: twin-cam\nswing: 120\ncycle_angle: 120\nspeed: 100\ninertia: 0.5\n"
        "unloader: {type: pneumatic, pivot_ratio: 2.5, arm: 120}\n"
    )
    ended = gearlink("swing", path, "--table", "contact")
    assert (ended.status, "GL113: the command needs the section cam: center_distance, roller_radius" in ended.err) == (
        2,
        True,
    )
    assert "help: `gearlink new wide-swing-cam` shows the keys of cam, with units" in ended.err
    assert "\ncam:" in gearlink("new", "wide-swing-cam").out
    assert (
        gearlink("swing", path, "--table", "contact", "--set", "cam={center_distance: 200, roller_radius: 8}").status
        < 2
    )


def test_a_name_beside_the_right_one_is_recognised(
    gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "designs").mkdir()
    (tmp_path / "press_pair.yaml").write_text("Kind: gear-pair\nmodule: 4\n")
    assert "did you mean designs?" in gearlink("batch", "desings/").err
    assert "did you mean press_pair.yaml?" in gearlink("gear", "press_pari.yaml").err
    assert "did you mean" not in gearlink("gear", "desings.yaml").err  # a folder is no design
    assert "this is a folder; watch shows one design file" in gearlink("watch", "designs").err
    for command in ("check", "batch"):
        empty = gearlink(command, "")
        assert (empty.status, "the name is empty" in empty.err) == (2, True)
    wrong = gearlink("gear", "press_pair.yaml").err
    assert wrong.startswith("press_pair.yaml:1:1: error GL106: the key 'kind' is missing")
    assert "write kind instead of 'Kind'" in wrong


def test_help_names_every_exit_status(gearlink: Any) -> None:
    words = " ".join(gearlink("--help").out.split())
    listed = words[words.index("Exit status:") : words.index("Options:")]
    assert [int(number) for number in re.findall(r"[:,] (\d+) ", listed)] == [int(code) for code in ExitCode]
