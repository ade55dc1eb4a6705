"""Templates of `gearlink new`: they run as they stand, tell what they leave out, overwrite nothing. No tolerances."""

from __future__ import annotations

import json
import re
from pathlib import Path
from typing import Any

import pytest
import yaml
from jsonschema import Draft7Validator

from gearlink.cli.reading.design_file import load, validate
from gearlink.cli.texts.schema import kind_schema, spec_keys, worked_design
from gearlink.core.base.kinds import FILES as KINDS

SEARCHED = ("geared-five-bar", [*KINDS][-1])
"""Kinds whose template is sought for a second, or studied."""


def each_template() -> list[Any]:
    return [pytest.param(kind, marks=pytest.mark.slow) if kind in SEARCHED else kind for kind in KINDS]


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", each_template())
def test_template_runs_as_it_stands(gearlink: Any, tmp_path: Path, kind: str) -> None:
    """Every command that the file asks for ends with status 0."""
    path = tmp_path / "new.yaml"
    ended = gearlink("new", kind, "--out", path)
    assert (ended.status, ended.out) == (0, "")
    loaded = load(str(path))
    assert loaded.data["kind"] == kind
    spec = validate(loaded, KINDS[kind].spec_model())
    for command in spec.commands():
        ended = gearlink(*command.split(), path, "--format", "json")
        assert ended.status == 0, ended.out[:500]
    found = json.loads(gearlink("check", path, "--format", "json").out)
    warned = {check["code"] for check in found["checks"] if check["status"] != "pass"}
    remarks = [line for line in path.read_text().splitlines() if " warn" in line and line.startswith("# GL")]
    assert warned == set(re.findall(r"GL\d{3}", " ".join(line.partition(":")[0] for line in remarks)))
    assert Draft7Validator(kind_schema(KINDS[kind])).is_valid(loaded.data)


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", KINDS)
def test_template_opens_with_the_line_that_editors_read(gearlink: Any, kind: str) -> None:
    first, second, *_ = gearlink("new", kind).out.splitlines()
    assert first == f"# yaml-language-server: $schema={kind}.schema.json"
    assert f"gearlink schema {kind} > {kind}.schema.json" in second


def test_a_section_that_may_be_one_word_has_a_heading_of_its_own(gearlink: Any) -> None:
    """The keys of a law stand under the law, not under what comes before them."""
    lines = gearlink("new", "swing-gripper").out.splitlines()
    for law, word in (("accelerate", "velocity-345"), ("decelerate", "half-cycloidal"), ("return", "modified-sine")):
        place = next(n for n, line in enumerate(lines) if line.startswith(f"# laws.{law}:"))
        assert lines[place].endswith(f"# a section instead of {word}")
        assert lines[place + 1].startswith("#     type:")


@pytest.mark.quick(2)
@pytest.mark.parametrize("kind", KINDS)
def test_template_shows_every_key(gearlink: Any, kind: str) -> None:
    """Each key stands in the design or in the comments below it."""
    text = gearlink("new", kind).out
    for key in spec_keys(KINDS[kind], entries=True):
        name = key.path.rpartition(".")[2]
        assert re.search(rf"\b{name}:", text), key.path


@pytest.mark.parametrize("kind", ["flatbed-press", "gear-pair"])
def test_remarks_are_alike_those_of_sections_too(gearlink: Any, kind: str) -> None:
    """Sections that are left out are told as those that are there: no capital, no full stop."""
    printed = gearlink("new", kind).out
    remarks = re.findall(r"^# +[\w.]+:.* # (.*)$", printed, re.MULTILINE)
    assert "coefficients of friction; a joint of its own has its own key" in remarks
    assert [words for words in remarks if words.endswith(".") or re.match("(A|The|What|How) ", words)] == []


def test_printed_and_written_are_the_same(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "folder" / "pair.yaml"
    printed = gearlink("new", "gear-pair").out
    ended = gearlink("new", "gear-pair", "--out", path)
    assert [line for line in path.read_text().splitlines() if line.strip() != "name: pair"] == [
        line for line in printed.splitlines() if not line.startswith("# name: ")
    ]
    assert f"wrote {path}" in ended.err
    assert gearlink("new", "gear-pair", "--out", tmp_path / "other.yaml", "--quiet").err == ""


def test_keys_in_sections_of_the_file_are_dotted(gearlink: Any) -> None:
    text = gearlink("new", "three-gear-four-bar").out
    assert re.search(r"^# gears\.pressure_angle: 20 +# deg: .*\(above 0, below 45\)$", text, re.MULTILINE)
    assert re.search(r"^# links: +# ", text, re.MULTILINE)
    assert re.search(r"^#   crank: +# mm: crank AB \(above 0\); required$", text, re.MULTILINE)


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", KINDS)
def test_sections_lists_and_named_entries_are_yaml_without_their_marks(gearlink: Any, kind: str) -> None:
    _, _, left_out = gearlink("new", kind).out.partition("# Keys that this file omits")
    lines = [line[2:] for line in left_out.splitlines()[1:]]
    read = yaml.safe_load("\n".join(lines)) if lines else {}
    if kind == "three-gear-four-bar":
        assert read["loads"]["forces"][0]["torque"]["zones"] == [{"from": None, "to": None, "value": None}]
        assert read["loads"]["bearings"]["NAME"]["reliability"] == 90
        assert read["tolerance"]["correlated"] == [{"sources": None, "rho": None}]


def test_an_existing_file_is_kept_without_force(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "mine.yaml"
    path.write_text("my work")
    ended = gearlink("new", "gear-pair", "--out", path)
    assert ended.status == 2
    assert "GL116" in ended.err
    assert "--force" in ended.err
    assert path.read_text() == "my work"
    assert gearlink("new", "gear-pair", "--out", path, "--force").status == 0
    assert "kind: gear-pair" in path.read_text()


def test_a_folder_is_no_file(gearlink: Any, tmp_path: Path) -> None:
    ended = gearlink("new", "gear-pair", "--out", tmp_path, "--force")
    assert ended.status == 2
    assert "GL116" in ended.err


@pytest.mark.parametrize(("wrong", "near"), [("gear-piar", "gear-pair"), ("Slider_Crank", "slider-crank")])
def test_unknown_kind_names_the_nearest(gearlink: Any, wrong: str, near: str) -> None:
    ended = gearlink("new", wrong)
    assert ended.status == 2
    assert ended.out == ""
    assert f"nearest: {near}" in ended.err


def test_unknown_kind_names_all_kinds(gearlink: Any) -> None:
    ended = gearlink("new", "xyzzy")
    assert ended.status == 2
    assert all(kind in ended.err for kind in KINDS)


def test_help_has_an_example(gearlink: Any) -> None:
    assert "Example: gearlink new" in gearlink("new", "--help").out


def test_without_a_kind_the_kinds_are_listed(gearlink: Any) -> None:
    ended = gearlink("new")
    assert ended.status == 0
    for kind in KINDS:
        assert re.search(rf"^{kind} +\S+", ended.out, re.MULTILINE), kind
        assert kind in gearlink("new", "--help").out.replace("-\n  ", "-"), kind


def test_a_design_is_named_after_its_file(gearlink: Any, tmp_path: Path) -> None:
    for name in ("one", "two"):
        gearlink("new", "gear-pair", "--out", tmp_path / f"{name}.yaml", "--quiet")
        assert load(str(tmp_path / f"{name}.yaml")).data["name"] == name
    assert "name" not in yaml.safe_load(gearlink("new", "gear-pair").out)


@pytest.mark.quick(3)
@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"gear-train-mobility", "study"}))
def test_every_key_that_is_there_says_unit_meaning_and_whose_choice_it_is(gearlink: Any, kind: str) -> None:
    keys = {key.path: key for key in spec_keys(KINDS[kind])}
    text, path = gearlink("new", kind).out, []
    for line in text.partition("# Keys that this file omits")[0].splitlines():
        if not (found := re.fullmatch(r"( *)(\w+):( [^#]*?)? +# (.+)", line)):
            names = path[:1] and not any(known.startswith(f"{path[0]}.") for known in keys)  # of the user's choice
            assert not line or line.lstrip().startswith(("#", "- ")) or (names and line.startswith("  ")), line
            continue
        path = [*path[: len(found[1]) // 2], found[2]]
        key = keys[".".join(path)]
        if key.path == "kind":
            continue
        unit = "" if key.unit in ("", "1", "teeth") else f"{key.unit}: "
        assert found[4].startswith(unit), line
        assert key.words.rstrip(".")[1:] in found[4], line
        assert key.section or found[4].endswith(("; required", "; optional")) or "; default " in found[4]


def test_the_first_wide_swing_is_the_plain_one(gearlink: Any) -> None:
    data = yaml.safe_load(gearlink("new", "wide-swing-cam").out)
    assert not {"drive", "slider", "cycle"} & set(data)


@pytest.mark.parametrize("kind", sorted(set(KINDS) - {"study"}))
def test_templates_begin_with_the_machine_alone(kind: str) -> None:
    """Tolerances, loads and registers are a second step; a file of the same name elsewhere hides no design."""
    data = yaml.safe_load(worked_design(KINDS[kind]))
    assert data["kind"] == kind
    assert not {"tolerance", "loads", "register"} & set(data)


def test_the_first_gear_pair_has_two_gears() -> None:
    assert all(isinstance(z, int) and z > 0 for z in yaml.safe_load(worked_design(KINDS["gear-pair"]))["teeth"])


def test_the_first_slider_crank_asks_for_its_crank() -> None:
    assert "stroke" in yaml.safe_load(worked_design(KINDS["slider-crank"]))


@pytest.mark.parametrize("kind", KINDS)
def test_a_range_names_one_bound_on_a_side_and_no_alternative_twice(kind: str) -> None:
    for key in spec_keys(KINDS[kind], entries=True):
        alternatives = [part.split(", ") for part in key.range.split(" or ")]
        assert len(set(map(tuple, alternatives))) == len(alternatives), key
        for bounds in alternatives:
            sides = ["lower" if each.startswith(("above ", "from ")) else each for each in bounds]
            assert sides.count("lower") <= 1, key


def test_the_narrower_bound_of_a_side_is_named() -> None:
    ranges = {key.path: key.range for kind in KINDS.values() for key in spec_keys(kind)}
    assert (ranges["cycle.working"], ranges["dwell_backlash"]) == ("above 0, below 360", "from 1e-09")


@pytest.mark.parametrize("kind", ["wide-swing-cam", "three-gear-four-bar", "swing-gripper"])
def test_units_stand_behind_the_keys_and_not_in_the_head_line(gearlink: Any, kind: str) -> None:
    """It had listed sheets/h, which the speeds of most kinds refuse: 1/min is theirs."""
    head, _, keys = gearlink("new", kind).out.partition("\n\n")
    assert "in the unit named after it; another unit may be written with the number" in head
    assert not re.search(r"\b(mm|deg|min|sheets|kg)\b", head)
    speed = next(line for line in keys.splitlines() if re.match(r"#? ?(input_)?speed: ", line))
    assert ("# sheets/h: " if kind == "swing-gripper" else "# 1/min: ") in speed
    assert "rev/min" not in keys
