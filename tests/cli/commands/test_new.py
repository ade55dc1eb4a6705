"""Templates of `gearlink new`: they run as they stand, tell what they leave out, overwrite nothing. No tolerances."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Any

import pytest
from jsonschema import Draft7Validator

from gearlink.cli.reading.design_file import load, validate
from gearlink.cli.texts.schema import kind_schema
from gearlink.cli.texts.spec_keys import spec_keys
from gearlink.core.kinds import FILES as KINDS


@pytest.mark.parametrize("kind", KINDS)
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
    assert Draft7Validator(kind_schema(KINDS[kind])).is_valid(loaded.data)


@pytest.mark.parametrize("kind", KINDS)
def test_template_opens_with_the_line_that_editors_read(gearlink: Any, kind: str) -> None:
    first, second, *_ = gearlink("new", kind).out.splitlines()
    assert first == f"# yaml-language-server: $schema={kind}.schema.json"
    assert f"gearlink schema {kind} > {kind}.schema.json" in second


@pytest.mark.parametrize("kind", KINDS)
def test_template_shows_every_key(gearlink: Any, kind: str) -> None:
    """Each key stands in the design or in the comments below it."""
    text = gearlink("new", kind).out
    for key in spec_keys(KINDS[kind]):
        name = key.path.rpartition(".")[2]
        assert re.search(rf"\b{name}:", text), key.path


def test_printed_and_written_are_the_same(gearlink: Any, tmp_path: Path) -> None:
    path = tmp_path / "folder" / "pair.yaml"
    printed = gearlink("new", "gear-pair").out
    ended = gearlink("new", "gear-pair", "--out", path)
    assert path.read_text() == printed
    assert f"wrote {path}" in ended.err
    assert gearlink("new", "gear-pair", "--out", tmp_path / "other.yaml", "--quiet").err == ""


def test_keys_in_sections_of_the_file_are_dotted(gearlink: Any) -> None:
    text = gearlink("new", "three-gear-four-bar").out
    assert re.search(r"^# gears\.pressure_angle: 20 +# deg: .*\(above 0, below 45\)$", text, re.MULTILINE)
    assert re.search(r"^# links: +# ", text, re.MULTILINE)
    assert re.search(r"^#   crank: +# mm: crank AB \(above 0\)$", text, re.MULTILINE)


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
