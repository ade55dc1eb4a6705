"""`gearlink explore` on the command line: pages, exit status, errors at their line and column."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import pytest
import yaml
from sweeps import spread

STUDY: dict[str, Any] = {
    "kind": "study",
    "design": {
        "kind": "three-gear-four-bar",
        "gears": {"module": 2, "crank": 40, "idler": 72, "output": 40},
        "dwell": {"angle": 135},
    },
    "variables": {"gears.idler": {"from": 60, "to": 90}},
    "minimize": {"frame_length": "20 mm"},
    "maximize": {"min_transmission_angle": "2 deg"},
}


@pytest.fixture
def written(tmp_path: Path) -> Any:
    def write(name: str = "study.yaml", **keys: Any) -> Path:
        path = tmp_path / name
        path.write_text(yaml.safe_dump({**STUDY, **keys}, sort_keys=False))
        return path

    return write


def test_json(gearlink: Any, written: Any) -> None:
    ended = gearlink("explore", written(), "--format", "json")
    found = ended.json
    assert (ended.status, found["kind"], found["command"], found["name"], found["ok"]) == (
        0,
        "study",
        "explore",
        "study",
        True,
    )
    assert {name: q["value"] for name, q in found["quantities"].items()}["designs"] == 31
    assert found["quantities"]["exhaustive"]["value"] is True
    assert found["tables"]["front"]["columns"] == ["index", "gears.idler", "frame_length", "min_transmission_angle"]
    assert found["tables"]["front"]["units"] == ["1", "1", "mm", "deg"]
    assert found["tables"]["why"]["columns"][:4] == ["name", "code", "fails", "alone_removes"]


def test_a_file_in_the_place_of_a_folder_is_told_before_the_study_is_computed(
    gearlink: Any, written: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("gearlink.cli.exploring.run._computed", pytest.fail)
    taken = written("taken")
    for line in (("--plot", "--out", taken), ("--write", taken / "below")):
        ended = gearlink("explore", written(), *line)
        assert ended.status == 2
        assert f"{taken} is not a folder" in ended.err


@pytest.mark.parametrize("other", [("--plot",), ("--write", "kept")])
def test_one_design_is_printed_or_all_are_written(gearlink: Any, written: Any, other: tuple[str, ...]) -> None:
    ended = gearlink("explore", written(), "--show", "3", *other)
    assert (ended.status, ended.out) == (2, "")
    assert f"omit {other[0]}" in ended.err


@pytest.mark.slow
def test_designs_of_an_earlier_run_are_told_of(gearlink: Any, written: Any, tmp_path: Path) -> None:
    folder = tmp_path / "kept"
    first = gearlink("explore", written(), "--write", folder)
    assert first.err == f"wrote {len(list(folder.iterdir()))} designs to {folder}\n"
    count = len(list(folder.iterdir()))
    assert count > 1
    ended = gearlink("explore", written(variables={"gears.idler": {"values": [60]}}), "--write", folder)
    there = len(list(folder.iterdir()))  # its design 0 is one of the others, or stands beside them all
    assert ended.err == f"wrote 1 design to {folder}, next to {there - 1} of an earlier run\n"
    assert there in (count, count + 1)


@pytest.mark.slow
def test_none_feasible_is_exit_1_and_a_warning_is_with_strict(gearlink: Any, written: Any) -> None:
    ended = gearlink("explore", written(where=["frame_length <= 2 mm"]), "--format", "json")
    assert (ended.status, ended.json["ok"]) == (1, False)
    assert "frame_length <= 2 mm alone excludes 31" in ended.json["checks"][0]["message"]
    study = written(variables={"gears.idler": {"from": 60, "to": 61}})
    assert [gearlink("explore", study, *more).status for more in ((), ("--strict",))] == [0, 1]


def test_strict_counts_the_warnings_of_the_designs(gearlink: Any, designs: Path) -> None:
    """Within 5 deg of the limit of the transmission angle a design warns."""
    variables = "variables={dwell.window: {from: 60, to: 70, step: 5}, limits.transmission_angle: {values: [50, 58]}}"
    line = ("explore", designs / "studies" / "dwell_window.yaml", "--quiet", "--set", variables)
    for more, count in spread([((), 6), (("--strict",), 3), (("--set", "checks.warn_counts=true"), 3)], 2):
        assert f"{count} satisfy everything" in gearlink(*line, *more).out


def test_the_base_may_be_a_file(gearlink: Any, written: Any, designs: Path) -> None:
    study = written(design=None, of=str(designs / "candy_feed.yaml"))
    study.write_text(study.read_text().replace("design: null\n", ""))
    assert gearlink("explore", study).status == 0
    ended = gearlink("explore", study, "--set", "of=nosuch.yaml", "--format", "json")
    assert [(e["code"], e["key"]) for e in ended.json["errors"]] == [("GL101", "of")]


@pytest.mark.quick(6)
@pytest.mark.parametrize(
    ("keys", "code", "key"),
    [
        ({"variables": {"gears.cranc": {"from": 1, "to": 2}}}, "GL151", "variables.gears.cranc"),
        ({"variables": {"gears.idler": {"from": 3, "to": 2}}}, "GL111", "variables.gears.idler.to"),
        (
            {"variables": {"gears.module": {"from": 1, "to": 4, "step": 1, "log": True}}},
            "GL111",
            "variables.gears.module.log",
        ),
        ({"variables": {"gears.module": {"values": [1, 4], "log": True}}}, "GL111", "variables.gears.module.log"),
        ({"variables": {"gears.idler": {"from": 3}}}, "GL106", "variables.gears.idler.to"),
        ({"variables": {"gears.idler": {"values": []}}}, "GL107", "variables.gears.idler.values"),
        ({"variables": {"gears.idler": {"from": 1, "too": 2}}}, "GL105", "variables.gears.idler.too"),
        ({"variables": {}}, "GL107", "variables"),
        ({"variables": 7}, "GL107", "variables"),
        ({"minimize": {"frame_length": []}}, "GL107", "minimize.frame_length"),
        ({"of": "x.yaml"}, "GL150", "of"),
        ({"where": ["frame_lenght > 2"]}, "GL152", "where[0]"),
        ({"design": {"kind": "study"}}, "GL156", "design.kind"),
        ({"design": {"of": "feed.yaml"}}, "GL156", "design.of"),
        ({"design": {**STUDY["design"], "dwel": 3}}, "GL156", "design.dwel"),
        ({"command": "gripper"}, "GL113", "command"),
        ({"sampling": {"budget": 1e300}}, "GL108", "sampling.budget"),
    ],
)
def test_errors_are_located(gearlink: Any, written: Any, keys: dict[str, Any], code: str, key: str) -> None:
    study = written(**keys)
    ended = gearlink("explore", study, "--format", "json")
    found = {(error["code"], error["key"]): error for error in ended.json["errors"]}
    assert ended.status == 2
    assert (code, key) in found
    error = found[code, key]
    line = study.read_text().splitlines()[error["line"] - 1]
    assert key.split(".")[-1].partition("[")[0] in line[error["column"] - 1 :] or "[" in key or code == "GL106"
    text = gearlink("explore", study)
    assert "Traceback" not in text.err
    assert f"{error['line']}:{error['column']}: error {code}" in text.err


def test_a_study_is_no_design_and_a_design_no_study(gearlink: Any, written: Any, designs: Path) -> None:
    ended = gearlink("analyze", written(), "--format", "json")
    assert (ended.status, ended.json["errors"][0]["code"]) == (2, "GL113")
    ended = gearlink("explore", designs / "candy_feed.yaml", "--format", "json")
    assert (ended.status, ended.json["errors"][0]["code"]) == (2, "GL113")


def test_batch_and_check_take_studies(gearlink: Any, written: Any) -> None:
    study = written()
    ended = gearlink("batch", study, "--format", "json")
    assert [(d["command"], d["result"]) for d in json.loads(ended.out)["designs"]] == [("explore", "pass")]
    assert gearlink("check", study).status == 0


def test_check_makes_a_study_ready_and_does_not_search(
    gearlink: Any, written: Any, monkeypatch: pytest.MonkeyPatch
) -> None:
    from gearlink.core.studies.explore import exploration

    def searched(*_: object) -> None:
        raise AssertionError("a chunk was computed")

    monkeypatch.setattr(exploration, "chunk_of", searched)
    ended = gearlink("check", written())
    assert (ended.status, ended.out) == (0, "1 design: no checks\n")
    # nor is what the order of the designs refuses left to `explore`
    sampling = {"method": "grid", "budget": 5}
    ended = gearlink("check", written(sampling=sampling), "--format", "json")
    assert (ended.status, [each["code"] for each in ended.json["findings"]]) == (2, ["GL155"])


@pytest.mark.quick(4)
@pytest.mark.parametrize("command", ["check", "diff", "batch"])
@pytest.mark.parametrize(
    ("keys", "code"),
    [
        ({"where": ["frame_lenght > 2"]}, "GL152"),
        ({"minimize": {"frame_length": "5e-324 mm"}}, "GL154"),
        ({"variables": {"gears.cranc": {"from": 1, "to": 2}}}, "GL151"),
    ],
)
def test_every_command_says_where_a_study_is_wrong(
    gearlink: Any, written: Any, command: str, keys: dict[str, Any], code: str
) -> None:
    study = written(**keys)
    ended = gearlink(command, *((study, study) if command == "diff" else (study,)))
    assert ended.status == 2
    assert f"{code}: " in ended.out + ended.err


def test_differences_of_studies_whose_base_is_a_file(gearlink: Any, written: Any, designs: Path) -> None:
    data = {name: value for name, value in STUDY.items() if name != "design"} | {"of": str(designs / "candy_feed.yaml")}
    study, other = written(design=None), written("other.yaml", design=None)
    study.write_text(yaml.safe_dump(data))
    other.write_text(yaml.safe_dump(data | {"variables": {"gears.idler": {"from": 61, "to": 90}}}))
    assert gearlink("diff", study, study).status == 0
    ended = gearlink("diff", study, other, "--format", "json")
    assert ended.status == 1
    assert "designs" in ended.out
