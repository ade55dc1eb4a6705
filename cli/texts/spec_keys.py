"""Every key that a kind of design file may have: path, unit, range, default and meaning, read from its schema."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Any

from gearlink.cli.texts.schema import kind_schema

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind

Node = dict[str, Any]
_LOWER, _UPPER = (
    (("exclusiveMinimum", "above"), ("minimum", "from")),
    (("exclusiveMaximum", "below"), ("maximum", "to")),
)
"""Of two bounds that are one number the exclusive one is narrower, and comes first."""


_MOST_CHOICES = 8


@dataclass(frozen=True, slots=True)
class SpecKey:
    """A key of a design file.

    Fields
        path : str - dotted, 'gears.module'
        unit, words : str - unit ('1': none), meaning
        range : str - 'above 0, below 45', 'arc or parabola'; empty where anything goes
        default : the value when the key is left out; None where there is none
        required : bool - its section needs it
        section : bool - it holds keys of its own
        also : the standard terms that are accepted for its last word
    """

    path: str
    unit: str
    words: str
    range: str
    default: Any
    required: bool
    section: bool
    also: tuple[str, ...] = ()


def spec_keys(kind: Kind) -> list[SpecKey]:
    """The keys of a kind in the order of its model, sections before what they hold, each once."""
    schema = kind_schema(kind)
    found: dict[str, SpecKey] = {}
    for key in _keys(schema, schema["definitions"], ""):
        before = found.setdefault(key.path, key)
        if key.range != before.range:  # `type` of a section that has several
            either = [*before.range.split(" or "), *key.range.split(" or ")] if before.range and key.range else []
            found[key.path] = replace(before, range=" or ".join(dict.fromkeys(either)))
    return list(found.values())


def _keys(section: Node, definitions: Node, before: str) -> Iterator[SpecKey]:
    required = {*section.get("required", ()), *_either(section)}
    for name, node in section.get("properties", {}).items():
        if "aliasOf" in node:
            continue
        path = before + name
        inner = list(_sections(node, definitions))
        yield SpecKey(
            path,
            node.get("unit", ""),
            node.get("description", "").removesuffix(f" [{node.get('unit')}]"),
            _range(node),
            node.get("default"),
            name in required,
            bool(inner),
            tuple(node.get("also", ())),
        )
        for part in inner:
            yield from _keys(part, definitions, path + ".")


def _either(section: Node) -> Iterator[str]:
    """The keys that a section needs under one of their names, the fixed one."""
    for part in section.get("allOf", ()):
        yield from (choice["required"][0] for choice in part.get("anyOf", ())[:1] if "required" in choice)


def _sections(node: Node, definitions: Node) -> Iterator[Node]:
    """Sections that may stand at a node: itself, an alternative of it, but not elements of a list."""
    if "$ref" in node:
        yield definitions[str(node["$ref"]).rpartition("/")[2]]
    elif "properties" in node and "description" in node:  # of a law by its numbers nothing is said
        yield node
    for combination in ("allOf", "anyOf", "oneOf"):
        for part in node.get(combination, ()):
            yield from _sections(part, definitions)


def _range(node: Node) -> str:
    """Bounds or choices of a node; of its alternatives or of its elements where it has none itself."""
    choices = [node["const"]] if "const" in node else node.get("enum", ())
    if choices:
        words = [str(choice).lower() if isinstance(choice, bool) else str(choice) for choice in choices]
        return "" if len(words) > _MOST_CHOICES else " or ".join(words)
    bounds = [*_narrowest(node, _LOWER, 1.0), *_narrowest(node, _UPPER, -1.0)]
    if bounds:
        return ", ".join(bounds)
    inner = [*node.get("anyOf", ()), *([node["items"]] if isinstance(node.get("items"), dict) else [])]
    return " or ".join(dict.fromkeys(words for words in map(_range, inner) if words))


def _narrowest(node: Node, bounds: tuple[tuple[str, str], ...], sign: float) -> list[str]:
    """The bound of one side in words, the narrower where a node has two."""
    found = [(sign * node[bound], word) for bound, word in bounds if bound in node]
    return [f"{word} {sign * value:.15g}" for value, word in found if value == max(found)[0]][:1]


@cache
def known_keys() -> list[tuple[SpecKey, list[str]]]:
    """Each key of files with the kinds that have it in the same words and range."""
    from gearlink.core.base.kinds import FILES

    found: dict[tuple[str, str, str], tuple[SpecKey, list[str]]] = {}
    for kind in FILES.values():
        for key in spec_keys(kind):
            if key.path != "kind":
                found.setdefault((key.path, key.words, key.range), (key, []))[1].append(kind.name)
    return list(found.values())
