"""Makes what `known` keeps: the index from the design classes of every kind, the schemas from the models."""

from __future__ import annotations

import json
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from typing import TYPE_CHECKING, Any

from gearlink.cli.texts.known import Index
from gearlink.cli.texts.worked_designs import worked_design
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import FILES

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind


# The keys of a kind of design file as JSON Schema draft-07, made from its model

Node = dict[str, Any]
_LISTS = ("anyOf", "oneOf", "allOf")
_DROPPED = ("title", "discriminator", "$defs", "description", "unit")


def made_parts(kind: Kind) -> tuple[Node, Node]:
    """The schema of a kind and its definitions."""
    raw = kind.spec_model().model_json_schema()
    sections = raw.get("$defs", {})
    body = _converted(raw, sections)
    body["properties"]["kind"]["description"] = "kind of design"
    return body, {name: _converted(section, sections) for name, section in sections.items()}


def _converted(node: Node, sections: Node) -> Node:
    """A schema in draft-07 words; its description ends with the unit."""
    result: Node = {}
    if words := description_of(node, sections):
        result["description"] = words
    if unit := unit_of(node):
        result["unit"] = unit
    if "$ref" in node:
        result["allOf"] = [_reference(node)]
    for key, value in node.items():
        # Editors would offer a default of null as the value to write.
        if key not in (*_DROPPED, "$ref") and not (key == "default" and value is None):
            result |= _keyword(key, value, sections)
    return _with_either(result)


def _alias(name: str, node: Node) -> Node:
    """A key under its standard term."""
    return {**node, "description": f"standard term for {name}", "aliasOf": name}


def _with_either(node: Node) -> Node:
    """A section that needs a key takes it under its standard term as well."""
    terms = {name: node["properties"][name].get("also", []) for name in node.get("required", ())}
    if not any(terms.values()):
        return node
    either = [{"anyOf": [{"required": [each]} for each in (name, *more)]} for name, more in terms.items() if more]
    return {**node, "required": [name for name, more in terms.items() if not more], "allOf": either}


def _keyword(key: str, value: Any, sections: Node) -> Node:
    if key == "properties":
        keys = {name: _converted(inner, sections) for name, inner in value.items()}
        return {key: keys | {term: _alias(name, keys[name]) for name in keys for term in keys[name].get("also", ())}}
    if key in _LISTS:
        return {key: [_reference(i) if [*i] == ["$ref"] else _converted(i, sections) for i in value]}
    if key == "prefixItems":
        return {"items": [_converted(inner, sections) for inner in value], "additionalItems": False}
    if key in ("items", "additionalProperties") and isinstance(value, dict):
        return {key: _converted(value, sections)}
    return {key: value}


def _reference(node: Node) -> Node:
    return {"$ref": f"#/definitions/{_target(node)}"}


def description_of(node: Node, sections: Node) -> str:
    """What a key means, with its unit; a section without words of its own has those of its model."""
    words = node.get("description", "")
    if not words:
        targets = [sections[_target(part)] for part in (node, *node.get("anyOf", ())) if "$ref" in part]
        words = next((target["description"] for target in targets if "description" in target), "")
    unit = unit_of(node)
    return f"{words} [{unit}]" if words and unit and unit != "1" else words


def unit_of(node: Node) -> str:
    """The unit of a number, of an optional number, or of the numbers of a list."""
    inner = [*node.get("anyOf", ()), *([node["items"]] if isinstance(node.get("items"), dict) else [])]
    units = [str(node["unit"])] if "unit" in node else [unit_of(part) for part in inner]
    return next((unit for unit in units if unit), "")


def _target(node: Node) -> str:
    return str(node["$ref"]).rpartition("/")[2]


def index_text() -> str:
    """What belongs in its file."""
    parts = [f'"{name}": {_in_lines(value)}' for name, value in asdict(made()).items()]
    return "{" + ",\n".join(parts) + "}\n"


def _in_lines(value: dict[str, Any] | list[str]) -> str:
    if isinstance(value, list):
        return json.dumps(value)
    lines = [f"{json.dumps(key)}: {json.dumps(each, ensure_ascii=False)}" for key, each in value.items()]
    return "{\n" + ",\n".join(lines) + "\n}"


def schemas_text() -> str:
    """What belongs in the file of the schemas: each definition once, whatever kinds have it."""
    definitions: dict[str, str] = {}
    kinds = {}
    for kind in FILES.values():
        body, own = made_parts(kind)
        kinds[kind.name] = [body, [_kept(definitions, name, json.dumps(node)) for name, node in own.items()]]
    rows = ",\n".join(f"{json.dumps(name)}: {text}" for name, text in definitions.items())
    return f'{{"definitions": {{\n{rows}\n}},\n"kinds": {_in_lines(kinds)}}}\n'


def _kept(definitions: dict[str, str], name: str, text: str) -> str:
    """The name under which a definition is kept: NAME#2 where another kind's of the same name differs."""
    number, key = 1, name
    while definitions.setdefault(key, text) != text:
        number += 1
        key = f"{name}#{number}"
    return key


def made() -> Index:
    """The index of all kinds."""
    from gearlink.cli.texts.codes import explanations
    from gearlink.core.base.nomenclature import TERMS
    from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED

    shown = _shown()
    checks = dict.fromkeys(check for text in explanations().values() for check in text.checks)
    return Index(
        {check: [kind.name for kind in FILES.values() if _makes(kind, check)] for check in checks},
        {name: list(_givers(name, shown)) for name in TERMS},
        [*REST_TO_REST, *REST_TO_SPEED, "half-345", "half-4567", "velocity-345", "velocity-4567"],
        {kind.name: _first_command(kind, worked_design(kind)) for kind in FILES.values()},
    )


def _makes(kind: Kind, check: str) -> bool:
    """Whether a class of the kind makes a check: a command always shows it, or a section calls for it."""
    classes = {kind.design_class(command) for command in kind.commands}
    shown = {name for cls in classes for outline in cls.outlines.values() for name in outline.checks}
    return check in shown or any(hasattr(cls, "check_" + check.replace("-", "_")) for cls in classes)


def _shown() -> dict[str, tuple[dict[str, set[str]], set[str]]]:
    """Of each kind the quantities that each command always shows, and all that it has."""
    found = {}
    for kind in FILES.values():
        classes = {command: kind.design_class(command) for command in kind.commands}
        always = {command: _ends(cls.outlines[command].quantities) for command, cls in classes.items()}
        known = {name for cls in set(classes.values()) for name in _ends(cls.quantity_names())}
        found[kind.name] = always, known
    return found


def _ends(paths: Iterable[str]) -> set[str]:
    return {path.rpartition(".")[2] for path in paths}


def _givers(name: str, shown: dict[str, tuple[dict[str, set[str]], set[str]]]) -> Iterator[str]:
    """Kinds that have the quantity and the commands that show it."""
    for kind, (by_command, known) in shown.items():
        always = [command for command, names in by_command.items() if name in names]
        if always:
            yield f"{kind} ({', '.join(always)})"
        elif name in known:
            yield f"{kind} (where the file has the sections for it)"


def _first_command(kind: Kind, text: str) -> str:
    from gearlink.cli.reading.design_file import parse, validate

    return str(validate(parse(text.encode(), "template"), kind.spec_model()).commands()[0])
