"""`gearlink check`: the checks alone, each finding at its line. No tolerances: statuses and places."""

from __future__ import annotations

import csv
import io
import shutil
from pathlib import Path
from typing import Any

import pytest
from factory import DESIGNS, QUICK
from sweeps import ALL

from gearlink.cli.commands import check
from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.reading.places import by_kind
from gearlink.cli.texts.codes import key_of
from gearlink.core.base.design import Design
from gearlink.core.base.report import Check

CRANK = "kind: slider-crank\nstroke: 310\nrod: 520\noffset: 50\n"
PAIR = "kind: gear-pair\nmodule: 4\nteeth: [72, 72]\ncenter_distance: 290.2912330746487\n"
COLLIDING = """kind: three-gear-four-bar
gears: {module: 2.5, crank: 20, idler: 20, output: 60}
limits: {gear_gap: 0.5}
links: {crank: 18, frame: 121.4}
"""
WARNED = """kind: three-gear-four-bar
gears: {module: 2, crank: 40, idler: 72, output: 40}
dwell: {angle: 135}
"""


def write(folder: Path, **texts: str) -> Path:
    for stem, text in texts.items():
        (folder / f"{stem}.yaml").write_text(text)
    return folder


@pytest.mark.quick(1)
@pytest.mark.parametrize("jobs", [1, 2])
def test_processes_find_what_one_finds(
    gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, jobs: int
) -> None:
    """In the order of the files, whoever reads them; one that cannot be read is among them."""
    write(tmp_path, a=WARNED, b=COLLIDING, c="kind: gear-pair\nmodule: x\n", d=PAIR, e=COLLIDING)
    monkeypatch.setattr(check, "_WORTH_SECONDS", 0.0)
    monkeypatch.setattr(check, "processors", lambda: jobs)
    ended = gearlink("check", tmp_path)
    places = [line.partition(".yaml")[0][-1] for line in (ended.out + ended.err).splitlines() if ".yaml:" in line]
    assert ended.status == 2
    assert set(places) == set("abce")
    assert places[: places.index("e")].count("b") == places.count("b") == places.count("e")


def test_a_design_that_passes_is_quiet(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("check", write(tmp_path, pair=PAIR) / "pair.yaml")
    assert ended.status == 0
    assert ended.out == "1 design: 13 pass\n"
    assert ended.err == ""


def test_a_failure_stands_at_the_key_that_its_remedy_changes(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, colliding=COLLIDING) / "colliding.yaml"
    ended = gearlink("check", path)
    assert ended.status == 1
    assert (
        f"{path}:4:9: fail GL301 gear-collision: interference of the crank gear and the output gear: 1.6 mm"
        in ended.out
    )
    assert "\n  links: {crank: 18, frame: 121.4}\n          ^\n" in ended.out
    assert "gearlink explain CODE" in ended.err
    assert gearlink("check", path, "--quiet").err == ""


def test_json(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, colliding=COLLIDING) / "colliding.yaml"
    whole = gearlink("check", path, "--format", "json").json
    assert (whole["gearlink"], whole["command"], whole["ok"]) == (1, "check", False)
    assert whole["summary"]["designs"] == 1
    assert whole["summary"]["fail"] == 1
    (failed,) = [finding for finding in whole["findings"] if finding["status"] == "fail"]
    assert (failed["code"], failed["check"], failed["line"], failed["column"]) == ("GL301", "gear-collision", 4, 9)
    assert failed["key"] == "links.crank"
    assert failed["limit"] == 0.5
    # Passes too, in the form of the other commands' results, so that one reader does for all.
    checks = [{**check, "file": None} for check in whole["checks"]]
    collision = next(check for check in checks if check["name"] == "gear-collision")
    assert (collision["status"], collision["limit"]) == ("fail", 0.5)
    analyzed = gearlink("analyze", path, "--format", "json").json["checks"]
    assert all({**check, "file": None} in checks for check in analyzed)
    assert "errors" not in whole
    assert not [finding for finding in whole["findings"] if finding["status"] == "pass"]


def test_verbose_shows_passes(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, pair=PAIR) / "pair.yaml"
    found = gearlink("check", path, "--verbose", "--format", "json").json["findings"]
    assert len(found) == 13
    assert {finding["status"] for finding in found} == {"pass"}
    assert gearlink("check", path, "--verbose").out.count(": pass GL2") == 13


def test_strict_makes_a_warning_count(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, warned=WARNED) / "warned.yaml"
    assert gearlink("check", path).status == 0
    ended = gearlink("check", path, "--strict")
    assert ended.status == 1
    assert ": warn GL302 shaft-clearance: " in ended.out
    assert gearlink("check", path, "--strict", "--format", "json").json["ok"] is False


def test_errors_of_the_file(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, wrong=CRANK.replace("stroke", "strok").replace("50", "abc")) / "wrong.yaml"
    ended = gearlink("check", path, "--format", "json")
    assert ended.status == 2
    assert {(f["code"], f["line"]) for f in ended.json["findings"]} >= {("GL105", 2), ("GL107", 4)}
    assert {f["status"] for f in ended.json["findings"]} == {"error"}
    # The record of errors is the one that every command prints with status 2.
    assert ended.json["errors"] == gearlink("crank", path, "--format", "json").json["errors"]


def test_a_mechanism_that_does_not_exist_is_no_pass(gearlink: Any, tmp_path: Path) -> None:
    """A slider-crank has no checks of its own, but a stroke beyond the rod's reach is refused all the same."""
    path = write(tmp_path, long=CRANK.replace("310", "1040")) / "long.yaml"
    ended = gearlink("check", path)
    assert ended.status == 2
    assert f"{path}:2:1: error GL112: " in ended.out


def test_worst_of_a_folder(gearlink: Any, tmp_path: Path) -> None:
    write(tmp_path, pair=PAIR, colliding=COLLIDING)
    assert gearlink("check", tmp_path).status == 1
    write(tmp_path, wrong="kind: gear-piar\n")
    ended = gearlink("check", tmp_path)
    assert ended.status == 2
    assert ended.out.splitlines()[-1].startswith("3 designs: ")
    assert "did you mean gear-pair" in ended.out


def test_a_file_named_twice_is_checked_once(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, pair=PAIR) / "pair.yaml"
    assert gearlink("check", path, path, tmp_path).out == "1 design: 13 pass\n"


def test_set_overrides_a_key_and_findings_point_there(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, pair=PAIR) / "pair.yaml"
    ended = gearlink("check", path, "--set", "limits.contact_ratio=2.5", "--format", "json")
    assert ended.status == 1
    assert {f["code"] for f in ended.json["findings"]} == {"GL203"}


def test_standard_input(gearlink: Any, standard_input: Any) -> None:
    standard_input(PAIR.encode())
    assert gearlink("check", "-").out == "1 design: 13 pass\n"


def test_csv_has_a_row_for_each_finding(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, colliding=COLLIDING) / "colliding.yaml"
    rows = list(csv.DictReader(io.StringIO(gearlink("check", path, "--format", "csv").out)))
    failed = next(row for row in rows if row["status"] == "fail")
    assert (failed["file"], failed["line"], failed["column"], failed["code"]) == (str(path), "4", "9", "GL301")
    assert float(failed["value"]) < float(failed["limit"])


def test_markdown(gearlink: Any, tmp_path: Path) -> None:
    path = write(tmp_path, colliding=COLLIDING) / "colliding.yaml"
    out = gearlink("check", path, "--format", "md").out
    assert out.startswith("| place | status | code | check | finding |")
    assert f"| {path}:4:9 | fail | GL301 | gear-collision |" in out


def test_no_such_place(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("check", tmp_path / "nowhere")
    assert ended.status == 2
    assert "GL101" in ended.err


ITS_OWN_CHECKS = {
    "wide_swing_cycle",
    "wide_swing_oscillating_cam",
    "loaded_oscillating_cam",
    "ring_feed_tolerances",
    "thesis_example_3_as_printed",
}
"""Designs with checks that no design of QUICK has."""


@pytest.mark.quick(5)
@pytest.mark.parametrize(
    "path",
    [
        path if path.stem in QUICK | ITS_OWN_CHECKS else pytest.param(path, marks=pytest.mark.slow)
        for path in sorted(DESIGNS.glob("*.yaml"))
    ],
    ids=lambda path: path.stem,
)
def test_every_worked_design_is_checked_without_its_tables_and_findings_stand_in_its_file(
    path: Path, gearlink: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    """All of them pass but the one that is printed wrong in its source."""

    def refuse(self: Design, name: str) -> None:
        raise AssertionError(f"table {name} of {self.kind} was computed")

    monkeypatch.setattr(Design, "table", refuse)
    ended = gearlink("check", path, "--verbose", "--format", "json")
    assert ended.status == (1 if path.stem == "thesis_example_3_as_printed" else 0), ended.out
    lines = path.read_text().splitlines()
    for found in ended.json["findings"]:
        assert (found["file"], found["code"] != "GL199") == (str(path), True), found
        key, element, _ = found["key"].rpartition(".")[2].partition("[")
        assert element or lines[found["line"] - 1][found["column"] - 1 :].startswith(key)


def test_agrees_with_batch_on_every_design(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    """Same exit status and the same failures, file by file."""
    paths = [path for path in sorted(designs.glob("*.yaml")) if ALL or path.stem in QUICK]
    for path in paths[:: 1 if ALL else 4]:
        alone = tmp_path / path.stem
        alone.mkdir()
        shutil.copy(path, alone)
        batch = gearlink("batch", alone, "--format", "json")
        check = gearlink("check", alone, "--format", "json")
        assert check.status == batch.status, path.stem
        reports = [check for design in batch.json["designs"] for check in design.get("checks", ())]
        failed = {(c["code"], c["message"]) for c in reports if c["status"] != "pass"}
        assert {(f["code"], f["message"]) for f in check.json["findings"]} == failed, path.stem


def test_a_fault_ends_only_its_design(gearlink: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fault(self: Design, name: str) -> None:
        raise ZeroDivisionError(name)

    write(tmp_path, pair=PAIR)
    monkeypatch.setattr("gearlink.core.machines.gear_pair.design.GearPairDesign.check", fault)
    ended = gearlink("check", tmp_path)
    assert ended.status == 3
    assert "fault GL199" in ended.out


@pytest.mark.parametrize(
    ("message", "key"),
    [
        ("increase cam.base_radius", "cam.base_radius"),
        ("set limits.pressure_angle", "cam"),
        ("unknown name", "cam"),
        ("AD - AB = 103.4 mm, not 1.5", "cam"),
    ],
)
def test_key_of_a_check(message: str, key: str) -> None:
    data = {"kind": "flatbed-press", "cam": {"base_radius": 90.0, "lead_in": None}}
    assert key_of(data, Check("GL401", "pressure-angle", "fail", message)) == key
    assert key_of({"kind": "x"}, Check("GL401", "pressure-angle", "fail", message)) == "kind"


def test_of_a_section_it_is_the_key_that_the_remedy_changes() -> None:
    """Only where that stands in the section that the finding is about."""
    data = {"links": {"crank": 23.6, "frame": 86.2}, "gears": {"idler": 44}}
    missed = Check("GL313", "dwell-window", "fail", "too short")
    assert key_of(data, missed) == "links"
    assert key_of(data, missed._replace(remedy=(("links.frame", 90.0),))) == "links.frame"
    assert key_of(data, missed._replace(remedy=(("gears.idler", 43),))) == "links"


@pytest.mark.parametrize(
    ("what", "key"),
    [
        ("pinion_rack: clearance at the root of gear 1", "bed.pinion.clearance"),
        ("cylinder_gears: clearance at the root of gear 1", "cylinder.gears"),
        ("clearance at the root of gear 1", "input_gears"),
    ],
)
def test_of_a_mesh_that_is_named_it_lies_in_its_section(what: str, key: str) -> None:
    """Findings of all gears of a press had stood at its input gears."""
    data = {"input_gears": {"module": 4}, "cylinder": {"gears": {"module": 3}}, "bed": {"pinion": {"clearance": 0.1}}}
    assert key_of(data, Check("GL205", "root-clearance", "warn", what)) == key


def test_of_a_machine_it_is_the_key_of_the_member_or_the_relation() -> None:
    data = {
        "speed": 140,
        "members": {"feed": {"design": {"kind": "crank-rocker", "links": {"crank": 30}, "input_speed": 99}}},
        "require": ["feed.rise_end before 80", "feed.rise_end  before 90 by 2"],
    }
    poor = Check("GL303", "transmission-angle", "fail", "feed: minimum transmission angle")
    assert key_of(data, poor) == "members.feed.design.links"
    assert key_of(data, poor._replace(code="GL531", what="feed: input_speed")) == "members.feed.design.input_speed"
    assert (
        key_of(data, Check("GL530", "timing-relation", "fail", "feed.rise_end before 90 by 2, margin")) == "require[1]"
    )


def test_help_has_an_example(gearlink: Any) -> None:
    assert "Example: gearlink check" in gearlink("check", "--help").out


def test_parts_for_processes_hold_every_file_once_and_one_kind_each(tmp_path: Path) -> None:
    """A process imports the kinds of its own files; many files of one kind are shared by all processes."""
    kinds = ["gear-pair", "machine", "gear-pair", "study"] * 10
    for k, kind in enumerate(kinds):
        (tmp_path / f"{k:02d}.yaml").write_text(f"# text\nkind: {kind}   # text\n", encoding="utf-8")
    files = [str(path) for path in sorted(tmp_path.iterdir())]
    parts = by_kind([*files, str(tmp_path / "gone.yaml")], 6)
    assert sorted(k for part in parts for k in part) == list(range(41))
    assert all(len({[*kinds, ""][k] for k in part}) == 1 and len(part) <= 6 for part in parts)


def test_parts_with_most_text_come_first(tmp_path: Path) -> None:
    """Two processes then end at about the same time."""
    for k, length in enumerate((10, 400, 30, 2000)):
        (tmp_path / f"{k}.yaml").write_text(f"kind: k{k}\n" + "# text\n" * length, encoding="utf-8")
    assert by_kind([str(path) for path in sorted(tmp_path.iterdir())], 2) == [[3], [1], [2], [0]]


def test_a_slider_crank_is_checked_without_a_limit_in_its_file(gearlink: Any, tmp_path: Path) -> None:
    """The transmission angle has a default limit, which `analyze` compares too."""
    path = tmp_path / "short_rod.yaml"
    path.write_text("kind: slider-crank\nstroke: 310\nrod: 520\noffset: 300\n")
    for command in ("check", "batch", "analyze"):
        assert gearlink(command, path).status == 1


@pytest.mark.quick(1)
@pytest.mark.parametrize("name", ["standing_feed", "two_gear_standing"])
def test_loads_of_links_that_a_synthesis_finds(gearlink: Any, designs: Path, tmp_path: Path, name: str) -> None:
    """Those of the completed file; `check` runs them, where they were left unread once."""
    path, whole = tmp_path / "feed.yaml", tmp_path / "whole.yaml"
    path.write_text((designs / f"{name}.yaml").read_text() + "loads: {speed: 60, links: {output: {inertia: 0.02}}}\n")
    assert gearlink("synth", "dwell", path, "--save", whole).status == ExitCode.OK
    one, other = (gearlink("loads", each, "--format", "json").json for each in (path, whole))
    assert one["quantities"] == other["quantities"]
    commands = {finding["command"] for finding in gearlink("check", path, "-v", "--format", "json").json["findings"]}
    assert {"synth dwell", "loads"} <= commands


def test_loads_without_the_section_that_they_need_are_an_error(gearlink: Any, designs: Path, tmp_path: Path) -> None:
    text = (designs / "wide_swing_slider.yaml").read_text()
    assert "cam:" not in text
    path = tmp_path / "swing.yaml"
    path.write_text(text + "loads: {friction: {pins: 0.1}}\n")
    found = gearlink("check", path, "--format", "json").json
    assert [finding["code"] for finding in found["findings"] if finding["status"] == "error"] == ["GL113"]
