"""Standard terms are read instead of the names of keys and quantities. No tolerances: the specs are the same."""

from __future__ import annotations

import copy
import json
from functools import cache
from pathlib import Path
from typing import Any

import jsonschema
import pytest
import yaml
from factory import DESIGNS

from gearlink.cli.evaluate import read_spec
from gearlink.cli.glossary import meaning_in
from gearlink.cli.reading.design_file import parse, validate, with_overrides
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.texts.schema import kind_schema, spec_keys, worked_design
from gearlink.core.base.kinds import FILES, STUDY
from gearlink.core.base.nomenclature import ALIASES, TERMS, fixed_name

ALL = [(kind.name, key.path, term) for kind in FILES.values() for key in spec_keys(kind) for term in key.also]
VALUES = {"tip_shortening": "none", "run_out": 0.01, "handover_place": 0.02}
"""Of keys that the examples leave out."""


@cache
def worked(kind: str) -> dict[str, Any]:
    found: dict[str, Any] = yaml.safe_load(worked_design(FILES[kind]))
    return found


def can_be_written(kind: str, path: str) -> bool:
    """Whether the example has the section of a key, or the section needs no other key."""
    section, dot, _ = path.rpartition(".")
    inner: Any = worked(kind)
    for step in section.split(".") if section else ():
        inner = inner.get(step, {})
    needed = [key.path for key in spec_keys(FILES[kind]) if key.path.startswith(section + dot) and key.required]
    return bool(inner) or not needed


CASES = [case for case in ALL if can_be_written(*case[:2])]


def written(kind: str, path: str, *names: str) -> dict[str, Any]:
    """The example with a key under other names; each gets its value."""
    data = copy.deepcopy(worked(kind))
    *sections, last = path.split(".")
    inner = data
    for step in sections:
        inner = inner.setdefault(step, {})
    value = inner.pop(last, VALUES.get(last))
    inner.update(dict.fromkeys(names, value))
    return data


def read(data: dict[str, Any], *settings: str) -> Any:
    loaded = parse(json.dumps(data).encode(), "a.yaml", overrides=settings)
    return validate(loaded, FILES[data["kind"]].spec_model()), loaded


def refused(data: dict[str, Any], *settings: str) -> list[tuple[str, str]]:
    with pytest.raises(DesignFileError) as caught:
        read(data, *settings)
    return [(each.code, each.key) for each in caught.value.diagnostics]


def test_the_keys_with_aliases() -> None:
    assert {(path.rpartition(".")[2], term) for _, path, term in ALL} == {
        ("base_radius", "prime_radius"),
        ("unloader", "balancing_device"),
        ("tip_shortening", "tip_alteration"),
        ("handover_place", "handover_position"),
        ("run_out", "runout"),
        ("action_angle", "angle_of_action"),
    }
    assert {term for *_, term in CASES} == {term for *_, term in ALL} - {"angle_of_action"}


def test_the_alias_of_a_section_that_no_example_has() -> None:
    body = {"base_radius": 30, "lift": 17.5, "type": "tangent"}
    data = {"kind": "disc-cam", "follower": {"type": "translating-roller", "roller_radius": 15}}
    spec, _ = read(data | {"profile": {**body, "angle_of_action": 150}})
    assert spec.profile.action_angle == 150.0
    assert refused(data | {"profile": {**body, "angle_of_action": 150, "action_angle": 150}})


@pytest.mark.quick(1)
@pytest.mark.parametrize(("kind", "path", "term"), CASES)
def test_a_file_is_read_with_a_standard_term(kind: str, path: str, term: str) -> None:
    section, _, name = path.rpartition(".")
    plain, _ = read(written(kind, path, name))
    spec, loaded = read(written(kind, path, term))
    assert spec == plain
    assert term not in json.dumps(loaded.data)
    schema = kind_schema(FILES[kind])
    jsonschema.validate(written(kind, path, term), schema)
    assert term not in {key.path.rpartition(".")[2] for key in spec_keys(FILES[kind]) if key.path != path}
    assert meaning_in(term, kind, tuple(section.split("."))) is None


@pytest.mark.parametrize(("kind", "path", "term"), CASES)
def test_both_names_for_one_key_are_refused(kind: str, path: str, term: str) -> None:
    section, dot, name = path.rpartition(".")
    assert refused(written(kind, path, name, term)) == [("GL111", f"{section}{dot}{term}")]


def test_set_takes_either_name_and_goes_over_the_file() -> None:
    for name in ("base_radius", "prime_radius"):
        data = written("flatbed-press", "cam.base_radius", name)
        for given in ("base_radius", "prime_radius"):
            spec, loaded = read(data, f"cam.{given}=81")
            assert spec.cam.base_radius == 81.0
            spec = validate(with_overrides(loaded, ["cam.prime_radius=82"]), type(spec))
            assert spec.cam.base_radius == 82.0
    both = ("cam.base_radius=80", "cam.prime_radius=81")
    assert refused(worked("flatbed-press"), *both) == [("GL111", "cam.prime_radius")]
    section = json.dumps(written("flatbed-press", "cam.base_radius", "prime_radius")["cam"] | {"prime_radius": 83})
    assert read(worked("flatbed-press"), f"cam={section}")[0].cam.base_radius == 83.0


def test_errors_stand_at_the_term_of_the_file() -> None:
    data = written("flatbed-press", "cam.base_radius", "prime_radius")
    data["cam"]["prime_radius"] = -1
    with pytest.raises(DesignFileError) as caught:
        read(data)
    (wrong,) = caught.value.diagnostics
    text = json.dumps(data)
    assert wrong.code == "GL108"
    assert wrong.column == text.index('"prime_radius"') + 1


def test_units_are_read_under_either_name() -> None:
    data = written("flatbed-press", "cam.base_radius", "prime_radius")
    data["cam"]["prime_radius"] = "3 in"
    assert read(data)[0].cam.base_radius == 76.2
    data["cam"]["base_radius"] = 70
    assert refused(data) == [("GL111", "cam.prime_radius")]


def test_a_source_has_a_distribution() -> None:
    data = copy.deepcopy(worked("slider-crank"))
    data["tolerance"] = {"sources": {"rod": {"plus_minus": 0.05, "distribution": "uniform"}}}
    assert read(data)[0].tolerance.sources["rod"].law == "uniform"
    data["tolerance"]["sources"]["rod"]["law"] = "normal"
    assert refused(data) == [("GL111", "tolerance.sources.rod.distribution")]


def test_sources_and_variables_are_paths_of_keys() -> None:
    """A source of the tolerances, what is correlated with it, and a variable of a study."""
    data = copy.deepcopy(worked("flatbed-press"))
    names = ["cam.prime_radius", "cam.roller_radius"]
    data["tolerance"] = {
        "sources": {name: {"plus_minus": 0.05} for name in names},
        "correlated": [{"sources": names, "rho": 0.5}],
    }
    read_tolerance = read(data)[0].tolerance
    assert list(read_tolerance.sources) == ["cam.base_radius", "cam.roller_radius"]
    assert read_tolerance.correlated[0].sources == ["cam.base_radius", "cam.roller_radius"]
    data["tolerance"]["correlated"][0] |= {"sources": names[::-1], "rho": 2.0}
    assert refused(data) == [("GL176", "tolerance.correlated[0].rho")]
    variables = {"cam.prime_radius": {"values": [65, 70]}, "cam.roller_radius": {"values": [20]}}
    study = {"kind": "study", "design": worked("flatbed-press"), "variables": variables}
    loaded = parse(json.dumps(study | {"minimize": {"max_radius": 1}}).encode(), "a.yaml")
    assert list(read_spec(loaded, STUDY, "a.yaml").variables) == ["cam.base_radius", "cam.roller_radius"]


def test_a_drive_may_return() -> None:
    data = yaml.safe_load((DESIGNS / "wide_swing_oscillating_cam.yaml").read_text())
    found = {}
    for stroke in ("homeward", "return"):
        data["drive"]["stroke"] = stroke
        found[stroke] = read(data)[0]
    assert found["return"] == found["homeward"]


# Quantities


def test_aliases_of_quantities_name_quantities_and_hide_none() -> None:
    assert set(ALIASES.values()) <= set(TERMS)
    for kind in FILES.values():
        for command in kind.commands:
            names = {name.rpartition(".")[2] for name in kind.design_class(command).quantity_names()}
            assert [alias for alias, name in ALIASES.items() if {alias, name} <= names] == []
    assert fixed_name("crank_idler.dimension_over_balls", ("crank_idler.measure_over_balls",)) == (
        "crank_idler.measure_over_balls"
    )
    assert fixed_name("no_such", ("crank_length",)) == "no_such"


@pytest.mark.parametrize(
    ("command", "name", "alias", "fixed"),
    [
        ("cam", "ty460", "prime_radius", "cam_base_radius"),
        ("gear", "gear_pair", "dimension_over_balls", "measure_over_balls"),
        ("gear", "candy_feed", "crank_idler.base_tangent_length", "crank_idler.span_measurement"),
        ("gripper", "swing_gripper", "output_speed_max", "output_velocity_max"),
    ],
)
def test_quantity_takes_either_name(
    gearlink: Any, designs: Path, command: str, name: str, alias: str, fixed: str
) -> None:
    path = designs / f"{name}.yaml"
    by_alias, by_name = (gearlink(command, path, "--quantity", each) for each in (alias, fixed))
    assert (by_alias.status, by_alias.out, by_alias.err) == (0, by_name.out, by_name.err)
    assert list(gearlink(command, path, "--quantity", alias, "-f", "json").json["quantities"]) == [fixed]


def test_explain_lists_the_aliases(gearlink: Any) -> None:
    topics = gearlink("explain", "prime_radius", "--format", "json").json["topics"]
    assert {(topic["about"], topic["name"]) for topic in topics} == {
        ("term", "prime circle"), ("quantity", "prime_radius"), ("quantity", "cam_base_radius"),
        ("key", "cam.base_radius"), ("key", "cam.prime_radius"), ("word", "prime_radius"),
    }  # fmt: skip
    assert {topic["alias"] for topic in topics if "alias" in topic} == {"prime_radius"}
    assert gearlink("explain", "tip_alteration").status == 0
