"""The keys of the design files as JSON Schema draft-07, the dialect that editors read."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.cli.texts.known import schema_parts

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

Node = dict[str, Any]
DRAFT = "http://json-schema.org/draft-07/schema#"


def kind_schema(kind: Kind) -> Node:
    """The draft-07 schema of one kind of design file."""
    body, definitions = schema_parts(kind, "")
    return {"$schema": DRAFT, "title": f"gearlink {kind.name}", **body, "definitions": definitions}


def all_kinds_schema(kinds: list[Kind]) -> Node:
    """One draft-07 schema for every kind of design file: the key `kind` chooses."""
    definitions: Node = {}
    branches = []
    for kind in kinds:
        body, own = schema_parts(kind, f"{kind.name}.")
        definitions |= {kind.name: body, **own}
        chosen = {"properties": {"kind": {"const": kind.name}}, "required": ["kind"]}
        branches.append({"if": chosen, "then": {"$ref": f"#/definitions/{kind.name}"}})
    words = {"description": "kind of design; it decides the other keys", "enum": [kind.name for kind in kinds]}
    return {
        "$schema": DRAFT,
        "title": "gearlink design file",
        "type": "object",
        "properties": {"kind": words},
        "required": ["kind"],
        "allOf": branches,
        "definitions": definitions,
    }


def for_editors(node: Any) -> Any:
    """A schema in which numbers with a unit may be written as NUMBER UNIT, too.

    Example
        >>> for_editors({"type": "number", "unit": "mm"})["type"]
        ['number', 'string']
    """
    if isinstance(node, list):
        return [for_editors(item) for item in node]
    if not isinstance(node, dict):
        return node
    found = {key: for_editors(value) for key, value in node.items()}
    unit = node.get("unit", "")
    if node.get("type") == "number" and isinstance(unit, str) and unit and not unit.startswith("the "):
        found |= {"type": ["number", "string"], "pattern": _NUMBER_UNIT}
    return found


_NUMBER_UNIT = r"^\s*[-+]?([0-9]+\.?[0-9]*|\.[0-9]+)([eE][-+]?[0-9]+)?\s*[^\s0-9.,+-]"
