"""`gearlink explain`: what a term, code, quantity, check, key, table, column, kind or law of motion means.

Columns of tables, constants and formulas of quantities have the words of `words.json`.

A column that bears the name of a quantity is that quantity, place by place. Formulas are in the symbols of
`gearlink.core.base.nomenclature`; where a name serves several kinds of design, each has its part. Inputs have none.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.exit_codes import ExitCode
from gearlink.cli.options import Format, Options
from gearlink.cli.render.lists import hanging, listed
from gearlink.cli.texts.schema import InnerKey, index, inner_keys, kind_schema, known_keys, spec_keys
from gearlink.core.base.errors import named
from gearlink.core.base.nearest import near_names

if TYPE_CHECKING:
    from gearlink.cli.glossary import Concept, Meaning, Place
    from gearlink.core.base.kind import Kind
    from gearlink.core.base.report import Rule


_WORDS_FILE = Path(__file__).parents[1] / "texts" / "words.json"
_WORDS: dict[str, dict[str, str]] = json.loads(_WORDS_FILE.read_text(encoding="utf-8"))
COLUMNS, CONSTANTS, FORMULAS = (_WORDS[name] for name in ("columns", "constants", "formulas"))
_ROLLER = {
    "force": "force between cam and roller",
    "pressure": "Hertzian pressure between cam and roller",
    "radius": "relative radius of curvature of cam and roller, 1/(1/roller + 1/cam)",
    "roller_speed": COLUMNS["roller_speed"],
    "entrainment": COLUMNS["entrainment"],
    "cam_angle": COLUMNS["cam_angle"],
    "input_torque": COLUMNS["input_torque"],
}
_ROLLERS = {"main": "the main cam", "return": "the return cam"}
_OF_ROLLER = re.compile(rf"(?P<cam>main|return)_(?P<part>{'|'.join(_ROLLER)})")
_PLACE = re.compile(r"(?P<axis>[xy])_(?P<pin>[A-Z])")
_COUPLER = re.compile(r"coupler_(?P<number>[123])_(?P<rest>\w+)")
_FORCE = re.compile(r"(?P<pin>[A-Z]|[A-Z]_[a-z]+|planet|cylinder|guide|guide_[a-z]+?)_(?P<part>x|y)")
_JOINT = re.compile(r"[A-HMNO]|[A-O]_(sum|return|idler|output|pinion)|planet|cylinder|guide(_[a-z]+)?")
_RATE = re.compile(r"(?P<of>\w+)_(?P<what>velocity|speed|acceleration)_ratio")
_POINT_RATE = re.compile(r"(?P<of>[A-Z])_(?P<axis>[xy])_(?P<what>velocity|acceleration)(?P<ratio>_ratio)?")
_MEMBER = re.compile(r"(?P<of>\w+)\.(?P<what>position|velocity|acceleration|torque)")
_MESH = re.compile(r"(mesh_\w+?|rack_lower|rack_upper)(_radial)?")


def _of_output(name: str) -> str:
    """Words of a column of an output that the file names; empty where the name is none of these."""
    if found := _POINT_RATE.fullmatch(name):
        per = " per unit of the input" if found["ratio"] else ""
        return f"{found['axis']} component of the {found['what']} of the point {found['of']}{per}"
    if found := _RATE.fullmatch(name):
        return f"{found['what']} of {found['of']} per unit of the input"
    if found := _MEMBER.fullmatch(name):
        if found["what"] == "torque":
            return f"share of the member {found['of']} in the torque on the main shaft"
        return f"{found['what']} of the output of the member {found['of']}"
    if name.startswith("guide") and name.endswith("_position"):
        return "position of the part that slides in the guide"
    if re.fullmatch(r"lever_(speed|acceleration)", name):
        return f"angular {name.removeprefix('lever_')} of the lever"
    return "amplitude of the disc in that mode, where the last disc has 1" if re.fullmatch(r"mode_\d+", name) else ""


def column_words(name: str) -> str:
    """What a column means; empty where nothing is said of it.

    Example
        >>> column_words("mesh_13")
        'tangential force in that mesh, signed; of a column ..._radial the radial one'
    """
    if name in COLUMNS:
        return COLUMNS[name]
    if name.removesuffix("_pm") in COLUMNS:
        return f"half-width of the 95 % interval of {name.removesuffix('_pm')}"
    if found := _PLACE.fullmatch(name):
        return f"{found['axis']} of the pin {found['pin']}"
    if words := _of_output(name):
        return words
    if found := _COUPLER.fullmatch(name):
        words = COLUMNS.get(f"coupler_{found['rest']}", "")
        return words.replace("coupler", f"coupler {('BC', 'CD', 'DE')[int(found['number']) - 1]} of a six-bar")
    if found := _OF_ROLLER.fullmatch(name):
        return f"{_ROLLER[found['part']]}, of {_ROLLERS[found['cam']]}"
    if found := _FORCE.fullmatch(name):
        if found["pin"].endswith("_sum"):
            return f"{found['part']} component of the forces of the frame on all shafts about {found['pin'][0]}"
        return f"{found['part']} component of the force at the pin {found['pin']} on the second body named there"
    if _MESH.fullmatch(name):
        return "tangential force in that mesh, signed; of a column ..._radial the radial one"
    if name.startswith("guide") and name.endswith("_moment"):
        return "couple of the guide on the part that slides in it"
    return f"magnitude of the force at the joint {name}, in the table joints" if _JOINT.fullmatch(name) else ""


_JSON_NAMES = {"How to repair": "how_to_mend", "Figure": "picture"}  # scripts depend on the names
_LABELS = {"what": "What", "why": "Why", "formula": "Formula", "source": "Source", "remedy": "How to repair"}


@dataclass(frozen=True, slots=True)
class Topic:
    """An explanation: a headline and labelled paragraphs; `about` is term, place, word, code, quantity, check, ..."""

    about: str
    name: str
    title: str
    paragraphs: dict[str, str]


def _topic(about: str, name: str, title: str, told: dict[str, str]) -> Topic:
    """A topic with the paragraphs that have words."""
    return Topic(about, name, title, {label: words for label, words in told.items() if words})


def run_explain(subject: str | None, format: Format) -> int:
    """Print what `subject` means, or the list of codes; give the exit status."""
    topics = find(subject) if subject is not None else []
    if subject is not None and not topics:
        return _unknown(subject, format)
    if subject is None:
        print(_index(format))
    elif format is Format.JSON:
        print(_as_json(topics))
    else:
        page = _as_markdown if format is Format.MARKDOWN else _as_text
        print("\n\n".join(page(topic) for topic in topics))
    return ExitCode.OK


def find(subject: str) -> list[Topic]:
    """Every topic of a name, the terms of the field first; blanks, hyphens, underscores and case do not matter.

    A number in brackets, as in teeth[0], is that of a list's entry.
    """
    subject = re.sub(r"\[\d+\]$", "", " ".join(subject.split()))
    if re.fullmatch(r"(?i)GL\d{3}", subject):  # no term is written so, and no key
        return list(_topics(subject.upper()))
    from gearlink.cli.glossary import in_latin_letters, meanings_of, named_places, named_terms, terms_by_symbol

    found = [*map(_term, named_terms(subject)), *(_place(label, place) for label, place in named_places(subject))]
    found += _program_names(subject)
    found += [_meaning(subject, meaning) for meaning in meanings_of(subject)]
    found = found or [_term(term) for term in terms_by_symbol(subject)]
    if not found and (latin := in_latin_letters(subject)) != subject:
        return find(latin)
    return found or list(_told_of(subject)) or list(_turned_round(subject)) or [*_events(subject), *_inner(subject)]


def _events(subject: str) -> Iterator[Topic]:
    """What the lines of `require` of a machine name: runs, their ends, extremes."""
    from gearlink.core.machines.machine.relations import EXTREMES, RUNS

    name = subject.lower().replace(" ", "_").replace("-", "_")
    run, _, end = name.rpartition("_")
    if run in RUNS and end in ("start", "end"):
        title, more = f"event of a machine: {end} of the {run} of a member", f"{name}[2]: of its second {run}"
    elif name in EXTREMES:
        title, more = f"event of a machine: where a member has its {name.replace('_', ' of ')}", ""
        title = re.sub(r"(velocity|acceleration) of (\w+)", r"\2 \1", title)
    else:
        return
    told = {"Written": f"MEMBER.{name}, in the lines of require: feed.{name} before 180", "Of several": more}
    told |= {"Kinds": "machine", "See also": "`gearlink new machine`"}
    yield _topic("event", name, title, told)


def _inner(subject: str) -> Iterator[Topic]:
    """Keys of elements and of named entries by their last word, and keys that take a word as their value."""

    def spelled(name: str) -> str:
        return re.sub(r"[\s-]", "_", name.lower())

    asked = spelled(subject)
    for key in inner_keys():
        last = key.path.rpartition(".")[2]
        if asked in (spelled(last), spelled(key.path)):
            yield _inner_key(key)
        elif taken := [each for each in key.choices if spelled(each) == asked]:
            title = f"value of the key {key.path}" + (f": {key.words}" if key.words else "")
            yield Topic("value", taken[0], title, _inner_key(key).paragraphs)


def _inner_key(key: InnerKey) -> Topic:
    told = {"Unit": key.unit, "Values": ", ".join(key.choices), "Kinds": ", ".join(key.kinds)}
    title = f"key of a design file: {key.words or 'says what its section is'}"
    return _topic("key", key.path, title, told)


def _of_entries(path: str) -> Iterator[Topic]:
    """Keys of elements and of named entries by a path of a file, loads.bearings.C.kind or motion[1].law."""
    plain = re.sub(r"\[\d*\]", "[]", path)
    for key in inner_keys():
        if re.fullmatch(re.escape(key.path).replace("NAME", ".+"), plain) and key.path != path:
            yield _inner_key(key)


def mentioned(subject: str) -> list[str]:
    """Four names in whose texts all words of a subject stand, the shortest texts first."""
    from gearlink.cli.glossary import glossary
    from gearlink.cli.texts.codes import explanations
    from gearlink.core.base.nomenclature import TERMS

    texts = {name: term.definition for name, term in glossary().items()}
    texts |= {name: entry.words for name, entry in TERMS.items()} | COLUMNS
    texts |= {key.path: key.words for key in inner_keys()}
    texts |= {code: f"{text.title} {text.what}" for code, text in explanations().items()}
    asked = [re.compile(rf"\b{re.escape(word.removesuffix('s'))}s?\b") for word in subject.lower().split()]
    found = [(len(text), name) for name, text in texts.items() if all(word.search(text.lower()) for word in asked)]
    return list(dict.fromkeys(name for _, name in sorted(found)))[:4]


_FILLING = {"of", "the", "a", "an", "in", "for", "at", "on"}
"""Words that may stand between those of a name."""


def _turned_round(subject: str) -> Iterator[Topic]:
    """Quantities and terms whose words are those of a name in another order, as in normal backlash."""
    from gearlink.cli.glossary import folded, glossary
    from gearlink.core.base.nomenclature import TERMS

    asked = sorted({*map(folded, re.split(r"[\s_-]+", subject))} - _FILLING)
    if len(asked) < 2:
        return
    yield from (_term(term) for name, term in glossary().items() if sorted(map(folded, name.split())) == asked)
    yield from (_quantity(name) for name in TERMS if sorted(name.split("_")) == asked)


def _program_names(subject: str) -> list[Topic]:
    """Every topic of a name of the program; another spelling counts where nothing bears it as it stands."""
    if exact := _spelled(subject):
        return exact
    joined = subject.lower().replace(" ", "-")
    spellings = dict.fromkeys((subject.upper(), joined.replace("_", "-"), joined.replace("-", "_")))
    return [topic for spelling in spellings if spelling != subject for topic in _spelled(spelling)]


def _spelled(subject: str) -> list[Topic]:
    """Every topic of a name as it is written."""
    exact, keys = list(_topics(subject)), list(_keys(subject))
    # A key says more than a column; a path is a key's, or that of a quantity of one mesh.
    if "." in subject or all(topic.about == "column" for topic in exact):
        return sorted([*keys, *exact], key=lambda topic: topic.name != subject)
    return [*exact, *keys]


def _told_of(point: str) -> Iterator[Topic]:
    """Columns in whose words a point or pole stands, as P15 does."""
    if re.fullmatch(r"[A-Z]+\d*", point):
        for column, words in COLUMNS.items():
            if re.search(rf"\b{point}\b", words):
                yield Topic("column", column, f"column of a table: {words}", {})


def _topics(name: str) -> Iterator[Topic]:
    from gearlink.cli.texts.codes import explanations
    from gearlink.core.base.kinds import FILES
    from gearlink.core.base.nomenclature import ALIASES, TERMS

    texts = explanations()
    if name in texts:
        yield _code(texts[name])
    for text in texts.values():
        if name in text.checks:
            yield _check(name, text)
    if name in FILES:
        yield _kind(FILES[name])
    last = name.rpartition(".")[2]
    yield from (_quantity(each) for each in dict.fromkeys((last, ALIASES.get(last, ""))) if each in TERMS)
    if name in index().laws:
        yield _law(name)
    yield from _symbols(name)
    if name in CONSTANTS:
        yield Topic("constant", name, CONSTANTS[name], {"See also": "`gearlink laws` gives it for every law"})
    if (name not in TERMS or name in COLUMNS) and column_words(name):
        yield Topic("column", name, f"column of a table: {column_words(name)}", {})
    if name in index().tables:
        yield _table(name)


_MOST_KINDS = 6  # kinds that stand by name before what a table of theirs holds


def _table(name: str) -> Topic:
    """What a table holds; each kind has its part where they differ."""
    from gearlink.cli.texts.written_design import uncapitalised

    texts = index().tables[name]
    words, kinds, command = texts[0]
    see = {"See also": f"`gearlink {command} FILE --table {name}`"}
    if len(texts) == 1:
        return Topic("table", name, f"table of results: {uncapitalised(words)}", {"Kinds": ", ".join(kinds)} | see)
    by_kind = {", ".join(kinds) if len(kinds) <= _MOST_KINDS else "Most kinds": words for words, kinds, _ in texts}
    return Topic("table", name, "table of results", by_kind | see)


_BOTH_ENDS = " min, max"


def _symbols(name: str) -> Iterator[Topic]:
    """The quantities that a symbol stands for in tables and formulas."""
    from gearlink.core.base.nomenclature import entries

    for quantity, _, entry in entries():
        written = (entry.symbol, entry.symbol.removesuffix(_BOTH_ENDS), *entry.symbol.split(", "))
        if name and name in written and name != quantity:
            topic = _quantity(quantity)
            yield Topic("symbol", name, f"{quantity}: {topic.title}", topic.paragraphs)


def symbols() -> Iterator[tuple[str, str]]:
    """Symbols that are one word, each with the quantity that it stands for."""
    from gearlink.core.base.nomenclature import entries

    for quantity, _, entry in entries():
        yield from ((symbol, quantity) for symbol in entry.symbol.split(", ") if symbol and " " not in symbol)


def _keys(name: str) -> Iterator[Topic]:
    """Keys of design files by path, `gears.module`, or by their last word; one topic where several kinds agree."""
    from gearlink.cli.texts.written_design import choice, uncapitalised

    found = False
    for key, kinds in known_keys(name.rpartition(".")[2]):
        section, dot, last = key.path.rpartition(".")
        if name not in (key.path, last, *key.also, *(f"{section}{dot}{term}" for term in key.also)):
            continue
        words = uncapitalised(key.words) if key.section else key.words
        told = {"Unit": key.unit if key.unit not in ("", "1") else "", "Range": key.range, "Choice": choice(key)}
        told |= {"Alias": ", ".join(key.also)}
        told |= {"Kinds": ", ".join(kinds), "See also": f"`gearlink new {kinds[0]}` shows it in the file"}
        title = f"key of a design file: {words or 'a section'}"
        yield _topic("key", key.path, title, told)
        found = True
    if "." in name and not found:
        yield from _of_entries(name)


def names() -> tuple[str, ...]:
    """Everything that can be explained, but for the last words of keys and single symbols, which lead there too."""
    return tuple(dict.fromkeys([*plain_names(), *(key.path for key, _ in known_keys())]))


def term_names() -> Iterator[str]:
    """The terms of the field in all their languages."""
    from gearlink.cli.glossary import glossary

    for term in glossary().values():
        yield from term.names()


def plain_names() -> tuple[str, ...]:
    """Codes, checks, kinds, quantities, laws, columns, tables: what is known beside the keys of files."""
    from gearlink.cli.texts.codes import explanations
    from gearlink.core.base.kinds import FILES
    from gearlink.core.base.nomenclature import TERMS

    texts = explanations()
    checks = [check for text in texts.values() for check in text.checks]
    return tuple(dict.fromkeys([*texts, *checks, *FILES, *TERMS, *index().laws, *COLUMNS, *CONSTANTS, *index().tables]))


# Terms of the field, places of the sources, words of other tools


def _term(term: Concept) -> Topic:
    names = {"Also": term.also, "German": term.german, "Chinese": term.chinese, "Symbol": (term.symbol,)}
    program = {"Keys": term.keys, "Quantities": term.quantities, "Checks": term.checks, "Kinds": term.kinds}
    told = {label: ", ".join(words) for label, words in (names | program).items()}
    told |= {"Figure": f"`{term.picture}`" if term.picture else "", "See also": ", ".join(term.see)}
    return _topic("term", term.name, term.definition, told)


_CITED = {
    "equation": r"\({}\)",
    "example": r"example {}\b",
    "figure": r"fig(?:ure|\.) {}(?![\w-])",
    "section": r"\b{}(?![\w.])",
    "sheet": r"sheet {}\b",
}


def _place(label: str, place: Place) -> Topic:
    from gearlink.core.base.nomenclature import entries

    shown = f"({label})" if place.what == "equation" else f"{place.what} {label}"
    cited = re.compile(_CITED[place.what].format(re.escape(label)))
    source = place.source.split()[-1]  # the source of a quantity may be named by its last word alone
    given = [name for name, _, term in entries() if source in term.source and cited.search(term.source)]
    told = {"Kinds": ", ".join(place.kinds), "Commands": ", ".join(f"gearlink {name}" for name in place.commands)}
    told |= {"Quantities": ", ".join(given)}
    return _topic("place", f"{place.source}, {shown}", place.says, told)


def _meaning(word: str, meaning: Meaning) -> Topic:
    where = ", ".join(meaning.kinds) or f"the section {meaning.section}"
    told = {"Keys": ", ".join(meaning.keys), "Quantities": ", ".join(meaning.quantities), "How": meaning.says}
    return _topic("word", word, f"in {where}: {meaning.means}", told)


# Codes and checks


def _code(text: Rule) -> Topic:
    told = {label: getattr(text, field) for field, label in _LABELS.items()}
    told |= {"Checks": ", ".join(text.checks), "Kinds": _kinds_with_checks(text.checks)}
    return _topic("code", text.code, text.title, told)


def _check(name: str, text: Rule) -> Topic:
    told = {**_code(text).paragraphs, "Checks": name, "Kinds": _kinds_with_checks((name,))}
    return _topic("check", name, f"{text.title} ({text.code})", told)


def _kinds_with_checks(checks: tuple[str, ...]) -> str:
    """Kinds whose design class makes one of the checks, whether a command always shows it or a section calls for it."""
    from gearlink.core.base.kinds import FILES

    makers = {kind for check in checks for kind in index().checks[check]}
    return ", ".join(kind for kind in FILES if kind in makers)


# Quantities


def _quantity(name: str) -> Topic:
    from gearlink.core.base.nomenclature import ALIASES, entries, term

    entry = term(name)
    usual = entry.unit if entry.unit != "1" else "1 (no dimension)"
    own_units = (f"{unit} ({', '.join(kinds)})" for unit, kinds in index().units.get(name, {}).items())
    paragraphs = {
        "Meaning": entry.words,
        "Symbol": entry.symbol,
        "Alias": ", ".join(alias for alias, fixed in ALIASES.items() if fixed == name),
        "Unit": "; ".join([usual, *own_units]),
        "Formula": FORMULAS.get(name, ""),
        "Source": entry.source,
        "Given by": "; ".join(index().quantities[name]),
    }
    for each, kind, own in entries():
        if kind and each == name:
            paragraphs[f"In {kind}"] = f"{own.words}{f' ({own.symbol})' if own.symbol else ''}"
    return _topic("quantity", name, entry.words, paragraphs)


# Kinds and laws


def _kind(kind: Kind) -> Topic:
    keys = [key for key in spec_keys(kind) if "." not in key.path and key.path != "kind"]
    paragraphs = {
        "What": kind_schema(kind)["description"],
        "Commands": ", ".join(f"gearlink {command}" for command in kind.commands),
        "Needs": ", ".join(key.path for key in keys if key.required),
        "Takes": ", ".join(key.path for key in keys if not key.required),
        "See also": f"`gearlink new {kind.name}` prints a design that runs, `gearlink schema {kind.name}` every key.",
    }
    return _topic("kind", kind.name, "kind of design", paragraphs)


def _law(name: str) -> Topic:
    from gearlink.core.parts.cams.laws import law

    found = law(name)
    peaks = [("velocity Cv", found.peak_velocity), ("acceleration Ca", found.peak_acceleration)]
    peaks += [("jerk Cj", found.peak_jerk), ("power Cm", found.peak_power)]
    rest = found.kind == "rest-to-rest"
    goes = "rest: rise 1" if rest else "speed 1"
    smooth = "yes: its acceleration is zero at the ends"
    use = next((prefix for prefix in ("half-", "velocity-") if name.startswith(prefix)), "")
    plain = name.removeprefix(use)
    paragraphs = {
        "What": f"Goes from rest to {goes} over x from 0 to 1.",
        "Formula": (_MCV if plain.startswith("mcv-") else _LAW_FORMULAS[plain]) + _LAW_USE[use],
        "Peaks": ", ".join(f"{words} {value:.6g}" for words, value in peaks),
        "Joins a dwell": "no: its acceleration is not zero at an end" if found.end_jumps else smooth,
        "Source": "VDI 2143; SCCA family: own derivation",
    }
    if not rest:
        paragraphs["Share"] = f"the rise is kappa = {found.kappa:.6g} times (end speed) x (time)"
    return Topic("law", name, f"motion law, {found.kind}", paragraphs)


_LAW_USE = {
    "": "",
    "half-": "; only the first half of this law is used, up to its peak velocity",
    "velocity-": "; the velocity follows this rise",
}
_MCV = "modified sine whose middle runs NN percent of the time at constant velocity (33: one third)"
_LAW_FORMULAS = {
    "simple-harmonic": "s = (1 - cos(pi x))/2",
    "cycloidal": "s = x - sin(2 pi x)/(2 pi)",
    "modified-trapezoid": "acceleration: sine quarter over x = 1/8, constant over 1/4, cosine over 1/8, then mirrored",
    "modified-sine": "acceleration: sine quarter over x = 1/8, cosine over 3/8, then mirrored",
    "polynomial-345": "s = 10 x^3 - 15 x^4 + 6 x^5",
    "polynomial-4567": "s = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7",
    "345": "s = 10 x^3 - 15 x^4 + 6 x^5",
    "4567": "s = 35 x^4 - 84 x^5 + 70 x^6 - 20 x^7",
}


# Pages


def _as_text(topic: Topic) -> str:
    told = [f"{topic.name}: {topic.title}"]
    told += [f"{label}: {words}" for label, words in topic.paragraphs.items() if not _repeats(label, words, topic)]
    return "\n".join(map(hanging, told))


def _repeats(label: str, words: str, topic: Topic) -> bool:
    """Whether the headline says it already."""
    return words in topic.title if label in ("Meaning", "What") else words == topic.title


def _as_markdown(topic: Topic) -> str:
    parts = [f"# {topic.name}: {topic.title}"]
    for label, words in topic.paragraphs.items():
        parts.append(f"**{label}:** " + (f"`{words}`" if label in ("Formula", "Symbol") else words))
    return "\n\n".join(parts)


def _as_json(topics: list[Topic]) -> str:
    from gearlink.cli.render.json_report import FORMAT

    plain: list[dict[str, Any]] = [
        {"about": topic.about, "name": topic.name, "title": topic.title}
        | {_JSON_NAMES.get(label, label.lower().replace(" ", "_")): words for label, words in topic.paragraphs.items()}
        for topic in topics
    ]
    return json.dumps({"gearlink": FORMAT, "command": "explain", "topics": plain}, ensure_ascii=False)


def _index(format: Format) -> str:
    """The list of codes."""
    from gearlink.cli.texts.codes import explanations

    rows = [(code, text.title, ", ".join(text.checks)) for code, text in explanations().items()]
    if format is Format.JSON:
        return _as_json([Topic("code", code, title, {}) for code, title, _ in rows])
    if format is Format.MARKDOWN:
        from gearlink.cli.render.markdown_report import markdown_table

        return markdown_table(("code", "meaning", "check"), rows)
    known = listed((code, title + (f" [{checks}]" if checks else "")) for code, title, checks in rows)
    more = (
        "`gearlink explain NAME` takes a code, a term of the field in English, German or Chinese, a figure or equation "
        "of a source such as (4-26), and the name of a check, quantity, symbol, key, table, column, kind or law."
    )
    return f"{known}\n\n{hanging(more, '')}"


def _unknown(subject: str, format: Format) -> int:
    from gearlink.cli.glossary import folded, terms_within
    from gearlink.cli.reading.diagnostics import Diagnostic
    from gearlink.cli.render.errors import show_errors
    from gearlink.core.base.nomenclature import entries

    everything = [*names(), *(entry.symbol for _, _, entry in entries() if entry.symbol)]
    known = [*(name.rpartition(".")[2] for name in everything), *everything, *term_names()]
    near = near_names(subject, {folded(name): name for name in reversed(known)}.values())
    remedy = "`gearlink explain` lists the codes, `gearlink new` the kinds"
    if near:
        remedy = f"nearest: {', '.join(near)}"
    elif told := mentioned(subject):
        remedy = f"it occurs in the texts of {', '.join(told)}"
    elif held := terms_within(subject):
        remedy = f"terms within it: {', '.join(held)}"
    wrong = Diagnostic("GL115", f"unknown name {named(subject)}", file="<command line>", key=subject, help=remedy)
    show_errors([wrong], Options(format=format))
    return ExitCode.WRONG_INPUT
