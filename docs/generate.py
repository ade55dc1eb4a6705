"""Writes docs/nomenclature.md, docs/glossary.md, docs/validation.md and what `explain`, `schema` and `new` read.

Run by `make docs`, checked by the tests.
"""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

from gearlink.cli import glossary
from gearlink.cli.texts import indexing, known
from gearlink.cli.texts.spec_keys import known_keys
from gearlink.cli.verification import page
from gearlink.core.base.kinds import FILES
from gearlink.core.base.nomenclature import ALIASES, TERMS

TARGET = Path(__file__).parent / "nomenclature.md"
GLOSSARY = Path(__file__).parent / "glossary.md"
VALIDATION = Path(__file__).parent / "validation.md"
_HEAD = """# Nomenclature

A quantity has one name, the same in design files, results, code and messages. Gears follow ISO 21771,
laws of motion and cams VDI 2142 and VDI 2143. Units are those of design files and results; inside the engine an
angle is in radians. This page is written by `make docs` from `core/base/nomenclature.py`.

| name | symbol | unit | meaning | source | kinds |
| --- | --- | --- | --- | --- | --- |
"""


def text() -> str:
    """The page."""
    kinds = _kinds_by_quantity()
    rows = [
        f"| `{name}` | {term.symbol} | {term.unit} | {term.words} | {term.source} | {', '.join(kinds.get(name, []))} |"
        for name, term in sorted(TERMS.items())
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
    known.SCHEMAS.write_text(indexing.schemas_text(), encoding="utf-8")  # the other pages read these two
    known.INDEX.write_text(indexing.index_text(), encoding="utf-8")
    TARGET.write_text(text(), encoding="utf-8")
    GLOSSARY.write_text(glossary_text(), encoding="utf-8")
    VALIDATION.write_text(page.text(), encoding="utf-8")
