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
