"""The JSON Schema of the design files: valid draft-07, agrees with what the program accepts. No tolerances."""

from __future__ import annotations

import copy
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any

import pytest
from factory import design, each_kind
from jsonschema import Draft7Validator
from pydantic import ValidationError

from gearlink.cli.reading.design_file import load, parse, validate
from gearlink.cli.reading.diagnostics import DesignFileError
from gearlink.cli.texts.schema import all_kinds_schema, for_editors, kind_schema, spec_keys
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.kinds import FILES as KINDS

DESIGNS = sorted((Path(__file__).parents[3] / "designs").glob("*.yaml"))
ALL = all_kinds_schema(list(KINDS.values()))


def nodes(schema: Any) -> Iterator[dict[str, Any]]:
    """Every schema inside a schema, itself included."""
    if isinstance(schema, dict):
        yield schema
        for key, value in schema.items():
            inner = value.values() if key in ("properties", "definitions") else [value]
            for part in inner:
                yield from nodes(part)
    elif isinstance(schema, list):
        for part in schema:
            yield from nodes(part)


@cache
def schema_of(kind: str) -> dict[str, Any]:
    return kind_schema(KINDS[kind])


def errors(data: Any, schema: dict[str, Any]) -> list[str]:
    validator = _VALIDATORS.setdefault(id(schema), Draft7Validator(schema))
    return [error.message for error in validator.iter_errors(data)]


_VALIDATORS: dict[int, Draft7Validator] = {}  # each keeps its schema, so that no other one gets its id


@pytest.mark.quick(1)
@pytest.mark.parametrize("kind", KINDS)
def test_schema_is_draft_07(gearlink: Any, kind: str) -> None:
    schema = gearlink("schema", kind).json
    assert schema["$schema"] == "http://json-schema.org/draft-07/schema#"
    Draft7Validator.check_schema(schema)
    words = {key for node in nodes(schema) for key in node}
    assert not words & {"$defs", "prefixItems", "discriminator", "unevaluatedProperties"}
    references = [node["$ref"] for node in nodes(schema) if "$ref" in node]
    assert {reference.removeprefix("#/definitions/") for reference in references} <= set(schema["definitions"])


def test_schema_of_all_kinds_is_that_of_the_models(gearlink: Any) -> None:
    schema = gearlink("schema").json
    assert schema == for_editors(ALL)
    assert schema["properties"]["kind"]["enum"] == list(KINDS)


@pytest.mark.slow
def test_the_schema_of_all_kinds_itself_is_draft_07() -> None:
    Draft7Validator.check_schema(for_editors(ALL))


def test_nothing_stands_beside_a_reference() -> None:
    """Draft-07 ignores it."""
    assert all(list(node) == ["$ref"] for node in nodes(ALL) if "$ref" in node)


@pytest.mark.quick(20)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_every_design_is_valid(path: Path) -> None:
    data = load(str(path)).data
    assert errors(data, ALL) == []
    assert errors(data, schema_of(data["kind"])) == []


@pytest.mark.quick(4)
@pytest.mark.parametrize("path", DESIGNS, ids=lambda path: path.stem)
def test_an_unknown_key_anywhere_is_found(path: Path) -> None:
    data = load(str(path)).data
    for section in list(sections(data)):
        broken = copy.deepcopy(data)
        at(broken, section)["nonsense"] = 1
        if section == ("register", "backlash"):  # by the names of meshes, which the design knows and no schema does
            with pytest.raises(NoSolution, match="no mesh 'nonsense': there are"):
                _ = design(broken, command="register").backlash
        elif section == ("start",) and data["kind"] == "planar-mechanism":  # by the names of its own links
            with pytest.raises(ValidationError, match="no link or slide is called 'nonsense'"):
                KINDS["planar-mechanism"].spec_model().model_validate(broken)
        elif section == ("shafts",) and data["kind"] == "planar-mechanism":  # by the names of points of its frame
            with pytest.raises(ValidationError, match="nonsense"):
                KINDS["planar-mechanism"].spec_model().model_validate(broken)
        elif section[:1] == ("compare",) and data["kind"] == "geneva-drive":  # the keys of another kind
            with pytest.raises(ValidationError, match="nonsense"):
                KINDS["geneva-drive"].spec_model().model_validate(broken)
        elif data["kind"] == "machine" and (section[2:3] == ("design",) or section == ("register", "chain")):
            with pytest.raises(ValidationError, match=r"design\n|no member 'nonsense'"):  # of any kind, or of its own
                KINDS["machine"].spec_model().model_validate(broken)
        else:
            assert errors(broken, ALL), section


def sections(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if isinstance(data, dict):
        yield path
        for key, value in data.items():
            yield from sections(value, (*path, key))


def at(data: Any, path: tuple[Any, ...]) -> Any:
    for step in path:
        data = data[step]
    return data


@pytest.mark.quick(1)
@pytest.mark.parametrize("path", each_kind(DESIGNS), ids=lambda path: path.stem)
def test_schema_and_program_agree_on_wrong_values(path: Path) -> None:
    """Each value in turn made text, negative, huge, true or a section: what the schema refuses the program refuses.

    Laws of motion are left out: their names are judged when the design is built.
    """
    data = load(str(path)).data
    model = KINDS[data["kind"]].spec_model()
    schema = schema_of(data["kind"])
    for place in list(leaves(data)):
        if "law" in str(place):
            continue
        for wrong in ("many", -7.5, 1e9, True, {}):
            broken = copy.deepcopy(data)
            at(broken, place[:-1])[place[-1]] = wrong
            if errors(broken, schema):
                assert not accepted(broken, model), (place, wrong)


def leaves(data: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    if isinstance(data, dict):
        for key, value in data.items():
            yield from leaves(value, (*path, key))
    else:
        yield path


def accepted(data: dict[str, Any], model: Any) -> bool:
    import json

    try:
        validate(parse(json.dumps(data).encode(), "test.yaml"), model)
    except DesignFileError:
        return False
    return True


@pytest.mark.parametrize(
    ("kind", "key", "wrong"),
    [
        ("gear-pair", "module", 0),
        ("gear-pair", "module", "4"),
        ("gear-pair", "teeth", [72]),
        ("gear-pair", "teeth", [72, 72.5]),
        ("gear-pair", "pressure_angle", 45),
        ("gear-pair", "shift_split", "evenly"),
        ("flatbed-press", "speed", None),
        ("flatbed-press", "cam", {"base_radius": 90}),
        ("three-gear-four-bar", "assembly", 2),
    ],
)
def test_ranges_types_and_choices_are_in_the_schema(kind: str, key: str, wrong: Any) -> None:
    path = next(path for path in DESIGNS if load(str(path)).data["kind"] == kind)
    data = load(str(path)).data
    assert errors({**data, key: wrong}, ALL)
    assert not errors(data, ALL)


def test_a_misspelt_law_is_found() -> None:
    data = load(str(next(path for path in DESIGNS if path.stem == "ty460"))).data
    for law, fine in (("cycloidal", True), ("mcv-25", True), ({"scca": [0.25, 0, 0.75, 0]}, True), ("cycloid", False)):
        assert (not errors({**data, "cam": {**data["cam"], "return_law": law}}, ALL)) is fine, law


def test_an_unknown_kind_is_found() -> None:
    assert errors({"kind": "gear-piar"}, ALL)
    assert errors({}, ALL)


@pytest.mark.parametrize("kind", KINDS)
def test_every_key_has_words_and_every_number_a_unit(kind: str) -> None:
    for key in spec_keys(KINDS[kind]):
        assert key.words, key.path
    properties = [node for node in nodes(schema_of(kind)) if "type" in node]
    numbers = [node for node in properties if node["type"] in ("number", "integer") and "enum" not in node]
    law_numbers = {"scca", "half-scca", "velocity-scca", "quintic", "septic"}
    in_laws = [id(part) for n in properties if set(n.get("properties", ())) & law_numbers for part in nodes(n)]
    assert [node for node in numbers if "unit" not in node and id(node) not in in_laws] == []


def test_editors_take_values_with_units(gearlink: Any) -> None:
    schema = gearlink("schema", "slider-crank").json
    reads = Draft7Validator(schema).is_valid
    assert reads({"kind": "slider-crank", "stroke": "4.5 in", "rod": 520, "limits": {"transmission_angle": "0.5 rad"}})
    assert not reads({"kind": "slider-crank", "stroke": "4.5", "rod": 520})
    assert not reads({"kind": "slider-crank", "stroke": "in", "rod": 520})
    assert not reads({"kind": "slider-crank", "stroke": -4.5, "rod": 520})
    gears = Draft7Validator(gearlink("schema", "gear-pair").json).is_valid
    assert not gears({"kind": "gear-pair", "module": "12 DP", "teeth": ["24 in", 36]})
    assert gears({"kind": "gear-pair", "module": "12 DP", "teeth": [24, 36]})


def test_unit_ends_the_description() -> None:
    key = schema_of("slider-crank")["properties"]["rod"]
    assert key["unit"] == "mm"
    assert key["description"] == "connecting rod [mm]"


@pytest.mark.parametrize("kind", KINDS)
def test_defaults_obey_the_schema(kind: str) -> None:
    schema = schema_of(kind)
    for node in nodes(schema):
        if "default" in node:
            assert node["default"] is not None
            inner = {**node, "definitions": schema["definitions"]}
            assert errors(node["default"], inner) == [], node


def test_unknown_kind_names_the_nearest(gearlink: Any) -> None:
    ended = gearlink("schema", "gear-piar")
    assert ended.status == 2
    assert re.search(r"GL109.*gear-piar", ended.err)
    assert "nearest: gear-pair" in ended.err
    assert ended.out == ""


@pytest.mark.parametrize(("name", "kind"), [("plate-cam", "disc-cam"), ("Geneva drive", "geneva-drive")])
def test_a_kind_is_found_by_its_name_in_the_field(gearlink: Any, tmp_path: Any, name: str, kind: str) -> None:
    assert f"help: nearest: {kind}" in gearlink("new", name).err
    file = tmp_path / "x.yaml"
    file.write_text(f"kind: {name}\n")
    assert f"help: did you mean {kind}? the kinds are" in gearlink("check", file).out


def test_help_has_an_example(gearlink: Any) -> None:
    assert "Example: gearlink schema" in gearlink("schema", "--help").out
