"""A machine of files on the command line: errors at their places, keys of members, studies, pictures, drives."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest

FEED = """kind: disc-cam
motion:
  - {to: 90, lift: "2 in", law: modified-sine}
  - {to: 170}
  - {to: 290, lift: 0, law: modified-sine}
  - {to: 360}
follower: {type: translating-roller, roller_radius: 15}
cam: {prime_radius: 120}
"""
MACHINE = """kind: machine
speed: 8000 sheets/h
members:
  feed: {of: parts/feed.yaml, phase: 20 deg}
  arm: {of: parts/feed.yaml, ratio: 2, phase: free}
require:
  - feed.rise_end before arm.rise_start by 2
  - arm.dwell[4]_end before feed.return_end
"""


@pytest.fixture
def files(tmp_path: Path) -> Path:
    (tmp_path / "parts").mkdir()
    (tmp_path / "parts" / "feed.yaml").write_text(FEED)
    (tmp_path / "machine.yaml").write_text(MACHINE)
    return tmp_path


def errors(ended: Any) -> list[dict[str, Any]]:
    found: list[dict[str, Any]] = json.loads(ended.out)["errors"]
    return found


def test_members_are_read_from_their_files_with_their_units(gearlink: Any, files: Path) -> None:
    ended = gearlink("analyze", str(files / "machine.yaml"), "--format", "json")
    assert ended.status == 0
    found = json.loads(ended.out)
    assert found["quantities"]["least_margin"]["value"] == pytest.approx(99.0, abs=1e-9)
    assert found["quantities"]["arm.phase"]["value"] == pytest.approx(211.0, abs=1e-9)
    rows = {tuple(row[:2]): row[-1] for row in found["tables"]["timing"]["rows"]}
    assert rows["feed", "rise"] == pytest.approx(50.8, abs=1e-12)


def test_errors_stand_in_the_file_of_the_member(gearlink: Any, files: Path) -> None:
    (files / "parts" / "feed.yaml").write_text(FEED.replace("prime_radius", "prime_radus"))
    (files / "machine.yaml").write_text(MACHINE.replace("arm: {of: parts/feed.yaml", "arm: {of: parts/fed.yaml"))
    found = errors(gearlink("analyze", str(files / "machine.yaml"), "--format", "json"))
    first, second = sorted(found, key=lambda each: str(Path(each["file"]).name))
    assert (Path(first["file"]).name, first["line"], first["column"]) == ("feed.yaml", 8, 7)
    assert "prime_radus" in first["message"]
    assert (second["line"], second["key"], second["code"]) == (5, "members.arm.of", "GL101")


@pytest.mark.parametrize(
    ("text", "key", "code"),
    [
        ("{of: parts/feed.yaml, design: {kind: disc-cam}}", "members.feed.design", "GL111"),
        ("{phase: 3}", "members.feed.of", "GL106"),
        ("{design: {kind: gear-train-mobility}}", "members.feed.design", ""),
        ("{design: 7}", "members.feed.design", ""),
        ("{of: parts/feed.yaml, ratio: 0}", "members.feed.ratio", "GL108"),
        ("{of: parts/feed.yaml, phase: soon}", "members.feed.phase", "GL107"),
        ("{of: parts/feed.txt}", "members.feed.of", "GL101"),
        ("{of: machine.yaml}", "members.feed.design", "GL109"),
        ("{of: parts/other.yaml}", "members.feed.design", "GL109"),
    ],
)
def test_what_is_wrong_with_a_member(gearlink: Any, files: Path, text: str, key: str, code: str) -> None:
    (files / "machine.yaml").write_text(MACHINE.replace("{of: parts/feed.yaml, phase: 20 deg}", text))
    (files / "parts" / "other.yaml").write_text(MACHINE.replace("parts/feed.yaml", "../machine.yaml"))
    found = errors(gearlink("analyze", str(files / "machine.yaml"), "--format", "json"))
    assert any(each["key"].startswith(key) and each["code"].startswith(code) for each in found), found


def test_set_reaches_keys_of_a_member_in_its_file(gearlink: Any, files: Path) -> None:
    radius = "members.feed.design.cam.prime_radius"
    asked = ("analyze", str(files / "machine.yaml"), "--quantity", "feed.max_radius")
    whole, less = (float(gearlink(*asked, *more).out.split()[0]) for more in ((), ("--set", f"{radius}=90")))
    assert whole - less == pytest.approx(30.0, abs=1e-9)
    wrong = gearlink("analyze", str(files / "machine.yaml"), "--set", f"{radius}=3")
    assert wrong.status == 2
    assert "<--set>" in wrong.err


@pytest.mark.slow
def test_a_study_explores_ratios_and_keys_of_members(gearlink: Any, files: Path) -> None:
    (files / "study.yaml").write_text(
        "kind: study\nof: machine.yaml\nvariables:\n  members.feed.phase: {from: 0, to: 40, step: 20}\n"
        "  members.feed.design.cam.prime_radius: {values: [90.0, 110.0]}\n"
        "minimize: {feed.max_radius: 1 mm}\nmaximize: {least_margin: 0.1 deg}\n"
    )
    ended = gearlink("explore", str(files / "study.yaml"), "--format", "json")
    assert ended.status == 0
    front = json.loads(ended.out)["tables"]["front"]
    radius = front["columns"].index("feed.max_radius")
    assert min(row[radius] for row in front["rows"]) == pytest.approx(90.0 + 50.8 - 15.0, abs=1e-6)


@pytest.mark.slow
def test_sheets_film_page_and_table_of_a_drive(gearlink: Any, files: Path) -> None:
    machine, out = str(files / "machine.yaml"), ("--out", str(files))
    assert gearlink("sheet", machine, "timing", "--plot-format", "svg", *out).status == 0
    assert {"machine-timing-line.svg", "machine-timing-circle.svg"} <= {path.name for path in files.iterdir()}
    assert gearlink("export", machine, "--cam-table", "--set", "servo={member: feed, rows: 37}", *out).status == 0
    assert (files / "machine-cam-table.csv").read_text().startswith("master_position [deg],slave_position [")
    missing = gearlink("export", machine, "--cam-table", "--format", "json", *out)
    assert missing.status == 2


@pytest.mark.parametrize(
    ("old", "new", "line", "message", "help"),
    [
        ("  feed:", "  feed table:", 4, "'feed table' is not a valid name", "write feed_table"),
        (
            "arm.dwell[4]_end before feed.return_end",
            "arm.rise_end within feed.dwell",
            8,
            "'arm.rise_end' is an event, not a run",
            "write arm.rise within RUN, or arm.rise_end before EVENT",
        ),
    ],
)
def test_names_and_relations_are_refused_at_their_lines(
    gearlink: Any, files: Path, old: str, new: str, line: int, message: str, help: str
) -> None:
    """A wrong name stood at line 1; the other was "no run 'rise': did you mean rise?"."""
    (files / "machine.yaml").write_text(MACHINE.replace(old, new))
    (wrong,) = errors(gearlink("analyze", str(files / "machine.yaml"), "--format", "json"))
    assert wrong["line"] == line
    assert wrong["message"].startswith(message)
    assert wrong["help"] == help
