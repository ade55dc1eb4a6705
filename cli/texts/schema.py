"""The keys of the design files as JSON Schema draft-07, the dialect that editors read; path, unit, range, default.

What is known of every kind of file is kept in two files, for reading all models and design classes takes a second.
`make docs` writes them; a test compares them with models and classes.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink import designs

if TYPE_CHECKING:
    from gearlink.core.base.kind import Kind


_KIND = re.compile(r"^kind:\s*([\w-]+)", re.MULTILINE)


def worked_design(kind: Kind) -> str:
    """The text of the kind's example: the file that bears its name, else the first by name."""
    folder = Path(str(designs.__file__)).parent
    files = [(file.stem, file.read_text(encoding="utf-8")) for file in folder.rglob("*.yaml")]
    own = {stem: text for stem, text in files if (found := _KIND.search(text)) and found[1] == kind.name}
    if not own:
        raise LookupError(f"no example of kind {kind.name} in gearlink.designs")
    return own.get(kind.worked or kind.name.replace("-", "_"), own[min(own)])


Node = dict[str, Any]
SCHEMAS = Path(__file__).parent / "schemas.json"
INDEX = Path(__file__).parent / "index.json"


@dataclass(frozen=True, slots=True)
class Index:
    """Who gives what.

    Fields
        checks : check -> kinds that make it
        quantities : quantity -> kinds with the commands that show it
        units : quantity -> units of designs of some kinds that are not those of the nomenclature -> these kinds
        laws : names of motion laws
        first_commands : kind -> the first command that its example asks for
        tables : table -> what it holds, the kinds of which that is said, and a command that gives it
    """

    checks: dict[str, list[str]]
    quantities: dict[str, list[str]]
    units: dict[str, dict[str, list[str]]]
    laws: list[str]
    first_commands: dict[str, str]
    tables: dict[str, list[tuple[str, list[str], str]]]


@cache
def index() -> Index:
    """The index, as the file has it."""
    return Index(**json.loads(INDEX.read_text(encoding="utf-8")))


def schema_parts(kind: Kind, prefix: str) -> tuple[Node, Node]:
    """The schema of a kind and its definitions, whose names get a prefix."""
    body, found = _stored(kind.name)
    if prefix:
        text = json.dumps([body, found]).replace('"#/definitions/', f'"#/definitions/{prefix}')
        body, found = json.loads(text)
    return body, {prefix + name: node for name, node in found.items()}


def _stored(kind: str) -> tuple[Node, Node]:
    """The schema of a kind and its definitions, as the file has them."""
    stored = _schemas()
    body, names = stored["kinds"][kind]
    return body, {name.partition("#")[0]: stored["definitions"][name] for name in names}


@cache
def _schemas() -> Node:
    found: Node = json.loads(SCHEMAS.read_text(encoding="utf-8"))
    return found


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


def spec_keys(kind: Kind, last: str = "", *, entries: bool = False) -> list[SpecKey]:
    """The keys of a kind in the order of its model, sections before what they hold, each once.

    Parameters
        last : str - the last word of those that are wanted, or a standard term of theirs; all where it is empty
        entries : bool - also those of elements of lists, `forces[].on`, and of entries with names, `bearings.NAME.kind`
    """
    found: dict[str, SpecKey] = {}
    for path, node, required, section in _keys_of(kind.name, 2 if entries else 0):
        if last and last != path.rpartition(".")[2] and last not in node.get("also", ()):
            continue
        key = SpecKey(
            path,
            node.get("unit", ""),
            node.get("description", "").removesuffix(f" [{node.get('unit')}]"),
            _range(node),
            node.get("default"),
            required,
            section,
            tuple(node.get("also", ())),
        )
        before = found.setdefault(path, key)
        if key.range != before.range:  # `type` of a section that has several
            either = [*before.range.split(" or "), *key.range.split(" or ")] if before.range and key.range else []
            found[path] = replace(before, range=" or ".join(dict.fromkeys(either)))
    return list(found.values())


_Found = tuple[str, Node, bool, bool]


@cache
def _keys_of(kind: str, deep: int) -> tuple[_Found, ...]:
    """Path and node of each key of a kind, whether its section needs it, whether it holds keys itself."""
    return tuple(_keys(*_stored(kind), "", deep))


def _keys(section: Node, definitions: Node, before: str, deep: int) -> Iterator[_Found]:
    """Those of a section and of the sections in it, through so many lists and names."""
    required = {*section.get("required", ()), *_either(section)}
    for name, node in section.get("properties", {}).items():
        if "aliasOf" in node:
            continue
        path = before + name
        inner = list(_sections(node, definitions))
        yield path, node, name in required, bool(inner)
        for part in inner:
            yield from _keys(part, definitions, path + ".", deep)
        for sign, part in _entries(node, definitions) if deep else ():
            yield from _keys(part, definitions, f"{path}{sign}.", deep - 1)


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


def _entries(node: Node, definitions: Node) -> Iterator[tuple[str, Node]]:
    """Sections that are elements of a list, or entries with names."""
    for item in _elements(node):
        yield from (("[]", part) for part in _sections(item, definitions))
    if isinstance(named := node.get("additionalProperties"), dict):
        yield from ((".NAME", part) for part in _sections(named, definitions))
    for combination in ("allOf", "anyOf", "oneOf"):
        for part in node.get(combination, ()):
            yield from _entries(part, definitions)


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
def known_keys(last: str = "") -> list[tuple[SpecKey, list[str]]]:
    """Each key of files, or each with a last word, with the kinds that have it in the same words and range."""
    from gearlink.core.base.kinds import FILES

    found: dict[tuple[str, str, str], tuple[SpecKey, list[str]]] = {}
    for kind in FILES.values():
        for key in spec_keys(kind, last):
            if key.path != "kind":
                found.setdefault((key.path, key.words, key.range), (key, []))[1].append(kind.name)
    return list(found.values())


@dataclass(frozen=True, slots=True)
class InnerKey:
    """A key of a design file, also of elements of lists, `motion[].law`, and of entries with names, `sources.NAME.fit`.

    Fields
        words : str - meaning; empty where nothing is said
        unit : str - empty: none
        choices : the words that it takes
        kinds : those that have it
    """

    path: str
    words: str
    unit: str
    choices: tuple[str, ...]
    kinds: tuple[str, ...]


@cache
def inner_keys() -> tuple[InnerKey, ...]:
    """Every key of every kind, each once."""
    from gearlink.core.base.kinds import FILES

    found: dict[tuple[str, str], tuple[Node, dict[str, None], dict[str, None]]] = {}
    for kind in FILES.values():
        schema = kind_schema(kind)
        for path, node in _deep(schema, schema["definitions"], "", frozenset()):
            _, choices, kinds = found.setdefault((path, node.get("description", "")), (node, {}, {}))
            choices |= dict.fromkeys(_choices(node))
            kinds[kind.name] = None
    return tuple(
        InnerKey(path, words.removesuffix(f" [{node.get('unit')}]"), str(node.get("unit", "")).strip("1"),
                 tuple(choices), tuple(kinds))
        for (path, words), (node, choices, kinds) in found.items()
    )  # fmt: skip


def _deep(node: Node, definitions: Node, path: str, above: frozenset[str]) -> Iterator[tuple[str, Node]]:
    """Paths and nodes of all keys below a node; a definition within itself is left out."""
    if "$ref" in node:
        name = str(node["$ref"]).rpartition("/")[2]
        if name not in above:
            yield from _deep(definitions[name], definitions, path, above | {name})
    for key, inner in node.get("properties", {}).items():
        if "aliasOf" not in inner:
            own = f"{path}.{key}".lstrip(".")
            yield own, inner
            yield from _deep(inner, definitions, own, above)
    for inner in _elements(node):
        yield from _deep(inner, definitions, f"{path}[]", above)
    named = node.get("additionalProperties")
    if isinstance(named, dict):
        yield from _deep(named, definitions, f"{path}.NAME", above)
    for combination in ("allOf", "anyOf", "oneOf"):
        for part in node.get(combination, ()):
            yield from _deep(part, definitions, path, above)


def _elements(node: Node) -> list[Node]:
    items = node.get("items", ())
    return [items] if isinstance(items, dict) else list(items) + list(node.get("prefixItems", ()))


def _choices(node: Node) -> Iterator[str]:
    """The words that a node takes, or its alternatives, or elements."""
    values = [node["const"]] if "const" in node else node.get("enum", ())
    yield from (value for value in values if isinstance(value, str))
    for part in (*node.get("anyOf", ()), *node.get("oneOf", ()), *_elements(node)):
        yield from _choices(part)
