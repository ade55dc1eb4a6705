"""The keys of a kind of design file as JSON Schema draft-07, made from its model.

pydantic writes the 2020-12 dialect. The differences that matter here: `$defs` is `definitions`, keys beside `$ref`
are ignored, a list with a schema per place is an `items` list, and `discriminator` belongs to OpenAPI.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.kind import Kind

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
    return result


def _keyword(key: str, value: Any, sections: Node) -> Node:
    if key == "properties":
        return {key: {name: _converted(inner, sections) for name, inner in value.items()}}
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
