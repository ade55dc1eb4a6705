"""Writes docs/nomenclature.md, docs/glossary.md, docs/validation.md and what `explain`, `schema` and `new` read.

Run by `make docs`, checked by the tests.
"""

from __future__ import annotations

import inspect
import json
from collections.abc import Iterable, Iterator
from dataclasses import asdict
from itertools import groupby
from pathlib import Path
from typing import Any

from gearlink.cli import glossary
from gearlink.cli.commands.verify import Outcome, computed, computed_digits, difference, limit
from gearlink.cli.reading.design_file import load, parse, validate
from gearlink.cli.render.markdown_report import inline, markdown_table
from gearlink.cli.texts import schema
from gearlink.cli.texts.schema import Index, known_keys, worked_design
from gearlink.cli.verification.cases import Case, Source, sources
from gearlink.core.base.kind import Kind
from gearlink.core.base.kinds import FILES
from gearlink.core.base.nomenclature import ALIASES, TERMS, entries

TARGET = Path(__file__).parent / "nomenclature.md"
GLOSSARY = Path(__file__).parent / "glossary.md"
VALIDATION = Path(__file__).parent / "validation.md"
_DESIGNS = Path(__file__).parents[1] / "designs"
_HEAD = """# Nomenclature

A quantity has one name, the same in design files, results, code and messages. Gears follow ISO 21771,
laws of motion and cams VDI 2142 and VDI 2143. Units are those of design files and results; inside the engine an
angle is in radians. This page is written by `make docs` from `core/base/nomenclature.py`.

| name | symbol | unit | meaning | source | kinds |
| --- | --- | --- | --- | --- | --- |
"""


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
        _other_units(),
        [*REST_TO_REST, *REST_TO_SPEED, "half-345", "half-4567", "velocity-345", "velocity-4567"],
        {kind.name: _first_command(kind, worked_design(kind)) for kind in FILES.values()},
        {name: [(words, *who) for words, who in texts.items()] for name, texts in sorted(_tables().items())},
    )


def _tables() -> dict[str, dict[str, tuple[list[str], str]]]:
    """Of each table what the docstrings say of it, with the kinds, and `analyze` or the first command that gives it."""
    found: dict[str, dict[str, tuple[list[str], str]]] = {}
    for kind in FILES.values():
        for command in sorted(kind.commands, key=lambda name: name != "analyze"):
            cls = kind.design_class(command)
            for name in cls.table_names():
                told = inspect.getdoc(getattr(cls, f"table_{name}")) or ""
                kinds, _ = found.setdefault(name, {}).setdefault(told.partition("\n")[0], ([], command))
                if kind.name not in kinds:
                    kinds.append(kind.name)
    return found


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
    for kind, (by_command, others) in shown.items():
        always = [command for command, names in by_command.items() if name in names]
        if always:
            yield f"{kind} ({', '.join(always)})"
        elif name in others:
            yield f"{kind} (where the file has the sections for it)"


def _other_units() -> dict[str, dict[str, list[str]]]:
    """Units of quantities in the designs of this repository, where they are not those of the nomenclature."""
    found: dict[str, dict[str, list[str]]] = {}
    for path in sorted(_DESIGNS.glob("*.yaml")):
        loaded = load(path)
        kind = FILES[loaded.data["kind"]]
        if kind.name == "machine":
            continue  # its quantities are those of its members
        spec = validate(loaded, kind.spec_model())
        for cls in dict.fromkeys(kind.class_for(command, spec) for command in spec.commands()):
            for name in cls.names_for(spec):
                last, unit = name.rpartition(".")[2], cls.unit_for(spec, name)
                if unit != TERMS[last].unit:
                    kinds = found.setdefault(last, {}).setdefault(unit, [])
                    kinds += [kind.name] if kind.name not in kinds else []
    return dict(sorted(found.items()))


def _first_command(kind: Kind, text: str) -> str:
    return str(validate(parse(text.encode(), "template"), kind.spec_model()).commands()[0])


def text() -> str:
    """The page."""
    kinds = _kinds_by_quantity()
    rows = [
        f"| `{name}` | {term.symbol} | {term.unit} | {term.words} | {term.source} | "
        f"{own or ', '.join(each for each in kinds.get(name, []) if name not in FILES[each].terms)} |"
        for name, own, term in sorted(entries())
    ]
    return _HEAD + "\n".join(row.replace("|max", "\\|max") for row in rows) + "\n"


_GLOSSARY_HEAD = """# Glossary

The terms of the field in English, German (VDI 2127, 2142, 2143, ISO 21771) and Chinese, with what gearlink has about
them: `gearlink explain dwell`, `gearlink explain Druckwinkel` and `gearlink explain 传动角` print an entry. Blanks,
hyphens and case do not matter. This page is written by `make docs` from `cli/texts/glossary.json`.

"""
_PLACES_HEAD = """## Figures and equations of the sources

`gearlink explain "(4-26)"` and `gearlink explain "figure 2-4"` lead to these; [errata.md](errata.md) says what is
wrong in them.

| source | position | what | kinds | commands |
| --- | --- | --- | --- | --- |
"""
_WORDS_HEAD = """## Words of other tools and sources

These are explained and not accepted as keys: an unknown key of this list gets the key to write instead.

| word | kind of design | meaning | write |
| --- | --- | --- | --- |
"""


_ALIASES_HEAD = """## Accepted aliases

Where the field has another word for a key or a quantity, both are accepted: in files, by `--set`, `--quantity` and
`explain`. Results have the fixed name; a key that is given under both names is an error.

| alias | name | where |
| --- | --- | --- |
"""


def glossary_text() -> str:
    """The page of the terms."""
    terms = sorted(glossary.glossary().values(), key=lambda term: term.name.casefold())
    places = [
        f"| {place.source} | {place.what} {_range(place)} | {place.says} | {', '.join(place.kinds)} "
        f"| {', '.join(f'`{command}`' for command in place.commands)} |"
        for place in glossary.places()
    ]
    words = [
        f"| {', '.join(each.words)} | {', '.join(each.kinds) or f'section `{each.section}`'} | {each.means} "
        f"| {_write(each)} |"
        for each in glossary.meanings()
    ]
    parts = [_GLOSSARY_HEAD + "\n".join(map(_entry, terms)), _ALIASES_HEAD + "\n".join(_aliases())]
    parts += [_WORDS_HEAD + "\n".join(words)]
    return "\n\n".join([*parts, _PLACES_HEAD + "\n".join(places)]) + "\n"


def _aliases() -> Iterator[str]:
    """A row for every alias of a key or a quantity."""
    keys: dict[tuple[str, str], list[str]] = {}
    for key, kinds in known_keys():
        section, dot, _ = key.path.rpartition(".")
        for alias in key.also:
            keys.setdefault((f"{section}{dot}{alias}", key.path), []).extend(kinds)
    keys["distribution", "law"] = ["a source in `tolerance.sources`"]
    yield from (f"| `{alias}` | `{name}` | key: {', '.join(kinds)} |" for (alias, name), kinds in sorted(keys.items()))
    yield from (f"| `{alias}` | `{name}` | quantity |" for alias, name in sorted(ALIASES.items()))


def _entry(term: glossary.Concept) -> str:
    """A term: its names, definition and what of the program is about it."""
    code = [("Keys", term.keys), ("Quantities", term.quantities), ("Checks", term.checks), ("Kinds", term.kinds)]
    told = [f"{label}: {', '.join(f'`{name}`' for name in names)}" for label, names in code if names]
    told += [f"Figure: `{term.picture}`"] if term.picture else []
    names = f"German: {', '.join(term.german)}. Chinese: {', '.join(term.chinese)}."
    names = f"Also: {', '.join(term.also)}. {names}" if term.also else names
    symbol = f" ({term.symbol})" if term.symbol else ""
    return "\n".join(
        [f"**{term.name}**{symbol}: {term.definition}\n", f"* {names}", *(f"* {line}" for line in told), ""]
    )


def _range(place: glossary.Place) -> str:
    one = place.first == place.last
    bare = place.first if one else f"{place.first} to {place.last}"
    return f"({bare.replace(' to ', ') to (')})" if place.what == "equation" else bare


def _write(meaning: glossary.Meaning) -> str:
    keys = ", ".join(f"`{key}`" for key in meaning.keys)
    results = ", ".join(f"quantity `{name}`" for name in meaning.quantities)
    return "; ".join(part for part in (meaning.says or keys, results) if part)


_VALIDATION = """# Validation

Published numbers, and what gearlink computes for them. `gearlink verify` computes all of them again where it is
installed: {cases} cases with {numbers} numbers, of which {met} are met. This page is written by `make docs` from the
files in cli/verification/sources, which go with the program.

A number is met where the difference is at most half a unit of the last digit that its source prints. Where another
limit is taken, the reason is given below the table. Computed values have a digit more than the published ones.

| source | cases | numbers | met |
| --- | --- | --- | --- |
{sources}

What is not published but was computed a second time, to 30 and 50 digits, is the subject of [accuracy.md](accuracy.md).
"""
_DIFFERS = """## Not met, and why

These numbers are known to differ and are no cases of `gearlink verify`. What is wrong in the four source documents, and
in other published material, is listed in [errata.md](errata.md).
"""
_NUMBERS = ("number", "unit", "published", "computed", "difference", "limit")


def validation_text() -> str:
    """The page "Validation": every published case with its numbers, and what is not met, with the reason."""
    known = list(sources())
    found = {source.name: list(computed(source.cases)) for source in known}
    every = [outcome for outcomes in found.values() for outcome in outcomes]
    rows = [
        f"| {inline(source.source)} | {len(source.cases)} | {len(found[source.name])} | {_met(found[source.name])} |"
        for source in known
    ]
    head = _VALIDATION.format(
        cases=sum(len(source.cases) for source in known), numbers=len(every), met=_met(every), sources="\n".join(rows)
    )
    parts = [head, *(part for source in known for part in _of_source(source, found[source.name]))]
    parts.append(_DIFFERS)
    parts += [part for source in known for part in _case_tables(list(computed(source.differs)), source.source)]
    return "\n".join(parts).rstrip() + "\n"


def _met(outcomes: list[Outcome]) -> int:
    return sum(each.met for each in outcomes)


def _of_source(source: Source, outcomes: list[Outcome]) -> Iterator[str]:
    yield f"## {inline(source.source)}\n\nRead at: {inline(source.read_at)}.\n"
    yield from _case_tables(outcomes)


def _case_tables(outcomes: list[Outcome], source: str = "") -> Iterator[str]:
    for _, group in groupby(outcomes, key=lambda each: each.case.id):
        own = list(group)
        yield f"### {own[0].case.id}\n\n{_where(own[0].case, source)}\n"
        rows = [
            (
                each.number.name,
                "" if each.unit == "1" else each.unit,
                each.number.published,
                computed_digits(each),
                difference(each),
                limit(each),
            )
            for each in own
        ]
        yield markdown_table(_NUMBERS, rows) + "\n"
        yield from _reasons(own)


def _where(case: Case, source: str) -> str:
    words = ". ".join(
        part.strip().rstrip(".") for part in (source, case.place[:1].upper() + case.place[1:], case.note) if part
    )
    return inline(f"{words}.")


def _reasons(outcomes: list[Outcome]) -> Iterator[str]:
    """Why limits are wider, and why numbers are not met."""
    reasons: dict[str, list[str]] = {}
    for each in outcomes:
        if each.number.because:
            names = reasons.setdefault(each.number.because, [])
            name = each.number.name.partition(" (")[0]
            names += [name] if name not in names else []
    whole = len({each.number.because for each in outcomes}) == 1
    for reason, names in reasons.items():
        of = "" if whole else f" of {inline(', '.join(names))}"
        yield f"Limit{of}: {inline(reason)}.\n"
    if why := outcomes[0].case.why:
        yield f"Why: {inline(why.rstrip('.'))}.\n"


def _kinds_by_quantity() -> dict[str, list[str]]:
    """For each quantity, the kinds that give it."""
    found: dict[str, list[str]] = {}
    for kind in FILES.values():
        names: dict[str, None] = {}
        for command in kind.commands:
            names.update(dict.fromkeys(kind.design_class(command).quantity_names()))
        for name in dict.fromkeys(name.rpartition(".")[2] for name in names):
            found.setdefault(name, []).append(kind.name)
    return found


if __name__ == "__main__":
    schema.SCHEMAS.write_text(schemas_text(), encoding="utf-8")  # the other pages read these two
    schema.INDEX.write_text(index_text(), encoding="utf-8")
    TARGET.write_text(text(), encoding="utf-8")
    GLOSSARY.write_text(glossary_text(), encoding="utf-8")
    VALIDATION.write_text(validation_text(), encoding="utf-8")
