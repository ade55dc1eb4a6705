"""What a pydantic model has against a design file, in a designer's words and at the file's own keys."""

from __future__ import annotations

import json
import math
import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass, replace
from difflib import get_close_matches
from itertools import islice
from typing import TYPE_CHECKING, Any
from unicodedata import normalize

from gearlink.cli.reading.diagnostics import Diagnostic
from gearlink.cli.reading.loaded_file import KeyPath, LoadedFile, parse_path
from gearlink.cli.reading.model_shapes import (
    allowed_range,
    fields_at,
    list_at,
    meaning_at,
    members_at,
    takes_truth_value,
    unit_at,
)
from gearlink.cli.reading.yaml_reader import format_path, plain_value
from gearlink.cli.reading.yaml_remedies import ODD, odd_character, odd_remedy
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from pydantic import BaseModel, ValidationError

    from gearlink.cli.glossary import Meaning

    Unions = tuple[tuple[KeyPath, str], ...]


# Words for values that a design file gives and for those that it should give

NO_UNIT = "a unit is not allowed here"
CONVERT = "convert the number to the unit of this key"
"""Where the unit of a key goes with another key: the bare number would be another size."""


def without_unit(number: str, written: str, unit: str) -> str:
    """What to write instead of a number with a unit, where the key takes none.

    Parameters
        number, written : str - as they stand in the file
        unit : str - of the key; empty where it is not known
    Example
        >>> without_unit("40", "teeth", "teeth"), without_unit("5", "deg", "teeth")
        ('a unit is not allowed here: write 40', 'a unit is not allowed here, this key is in teeth')
    """
    if unit in ("", written):
        return f"{NO_UNIT}: write {number}"
    return f"{NO_UNIT}, this key is in {unit}"


WANTED = {
    "int_type": "a whole number",
    "int_parsing": "a whole number",
    "int_from_float": "a whole number",
    "float_type": "a number",
    "float_parsing": "a number",
    "decimal_type": "a number",
    "string_type": "text",
    "bool_type": "true or false",
    "bool_parsing": "true or false",
    "list_type": "a list such as [1, 2]",
    "tuple_type": "a list such as [1, 2]",
    "set_type": "a list such as [1, 2]",
    "dict_type": "a section of keys",
    "mapping_type": "a section of keys",
    "model_type": "a section of keys",
    "model_attributes_type": "a section of keys",
    "none_required": "empty",
}
_BOUNDS = {
    "greater_than": ("gt", "greater than {}"),
    "greater_than_equal": ("ge", "at least {}"),
    "less_than": ("lt", "less than {}"),
    "less_than_equal": ("le", "at most {}"),
    "multiple_of": ("multiple_of", "a multiple of {}"),
}
_NUMBER = r"[-+]?(?:[0-9]+\.?[0-9]*|\.[0-9]+)(?:[eE][-+]?[0-9]+)?"
_SEXAGESIMAL = re.compile(r"(\d+)\s*°\s*(\d+(?:\.\d+)?)\s*['′](?:\s*(\d+(?:\.\d+)?)\s*(?:\"|''|″))?", re.ASCII)
_WITH_UNIT = re.compile(rf"({_NUMBER})\s*((?:1?/)?[a-zA-Zµ°%'\"][\w/^°%² -]*)", re.ASCII)
DASHES = ("\u2212", "\u2013", "\u2014")
_LOOKALIKES = str.maketrans("OolI", "0011")
_SHOWN_CHARACTERS = 40
_LONG = 1e6
_INCH = 25.4


def shown(value: Any) -> str:
    """A value as a message names it."""
    if value is None:
        return "empty"
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return repr(value if len(value) <= _SHOWN_CHARACTERS else value[: _SHOWN_CHARACTERS - 3] + "...")
    if isinstance(value, list):
        return "a list"
    if isinstance(value, float) and abs(value) >= _LONG and float(f"{value:g}") == value:
        return f"{value:g}"  # 1e+11, as it was written
    return "a section" if isinstance(value, dict) else repr(value)


def bound(kind: str, context: dict[str, Any]) -> str:
    """The limit that a number broke, or nothing where the error is another one."""
    if kind not in _BOUNDS:
        return ""
    name, words = _BOUNDS[kind]
    limit = context.get(name)
    return words.format(f"{limit:.15g}" if isinstance(limit, float) else limit)


def choices(context: dict[str, Any]) -> list[str]:
    """The values of a literal, as a design file writes them.

    Example
        >>> choices({"expected": "'arc', 'parabola' or 'quartic'"}), choices({"expected": "True"})
        (["'arc'", "'parabola'", "'quartic'"], ['true'])
    """
    words = re.findall(r"'[^']*'|[^\s,']+", str(context.get("expected", "")))
    return [{"True": "true", "False": "false"}.get(word, word) for word in words if word != "or"]


def whole_number_remedy(value: float) -> str:
    """What to write instead of a float where teeth or the like are counted."""
    if not math.isfinite(value) or abs(value) >= 2.0**53:
        return ""
    if value == int(value) or 0.0 < value < 1.0:  # of most that are counted there is at least one
        return f"write {math.ceil(value)}"
    return f"write {math.floor(value)} or {math.ceil(value)}"


def number_remedy(text: str, unit: str = "") -> str:
    """What to write instead of a text that was meant as a number; nothing where that is not plain.

    Parameters
        unit : str - of the key, where it has one
    Example
        >>> number_remedy("38,8"), number_remedy("5 teeth")
        ('write a decimal point: 38.8', 'a unit is not allowed here: write 5')
        >>> number_remedy("25.4/12", "mm"), number_remedy("DP12", "mm")
        ('write 2.116666667', 'a diametral pitch is teeth per inch of diameter: write 2.116666667 (mm)')
    """
    text = text[:200].strip(" ")
    if isinstance(plain_value(text), (int, float)):
        return "omit the quotation marks"
    if re.fullmatch(r"[-+]?[1-9][0-9]{0,2},[0-9]{3}", text):
        return f"write {text.replace(',', '.')}, or {text.replace(',', '')} if the comma separates thousands"
    if re.fullmatch(r"[-+]?[0-9]+,[0-9]+", text):
        return f"write a decimal point: {text.replace(',', '.')}"
    if re.fullmatch(r"[-+]?[0-9.]+(:[-+]?[0-9.]+){2}", text):
        return "one value at a time: several values of a key are a study, `gearlink new study` shows one"
    if re.fullmatch(r"[-+]?[0-9]+(:[0-5]?[0-9])+(\.[0-9]*)?", text):
        return "write decimals, not minutes and seconds"
    if re.fullmatch(r"[-+]?[0-9]{1,3}([_ '][0-9]{3})+(\.[0-9]+)?", text):
        return f"write {re.sub('[_ ]', '', text.replace(chr(39), ''))}"
    if odd := ODD.search(text):
        plain = ODD.sub("", normalize("NFKC", text).replace("\u2212", "-")).strip()
        if re.fullmatch(_NUMBER, plain):
            return f"it holds {odd_character(odd[0])}: write {plain}"
        return f"it holds {odd_character(odd[0])}: {odd_remedy(odd[0])}"
    if text[:1] in DASHES:
        return f"it holds {odd_character(text[0])}: write -"
    if re.fullmatch(rf"{_NUMBER}((\s+|\s*;\s*){_NUMBER})+", text):
        return f"separate the elements of a list by commas: {', '.join(text.replace(';', ' ').split())}"
    if re.fullmatch(rf"{_NUMBER}[,;]", text):
        return f"write {text[:-1]}"
    if unit == "deg" and (parts := _SEXAGESIMAL.fullmatch(text)):
        degrees, minutes, seconds = (float(part or 0) for part in parts.groups())
        return f"write {degrees + minutes / 60 + seconds / 3600:.10g}"
    digits = text.translate(_LOOKALIKES)
    if re.fullmatch(_NUMBER, digits):
        return f"a letter instead of a digit: write {digits}"
    if re.fullmatch(r"[-+]?0[xXbBoO]\w*", text, re.ASCII):
        return "write it in decimals"
    if re.fullmatch(r"[-+]?[0-9.]+[eE][-+]?[0-9_]*", text):
        return "write the exponent as in 1e3"
    if quotient := re.fullmatch(rf"({_NUMBER})\s*/\s*({_NUMBER})", text):
        return _quotient(float(quotient[1]), float(quotient[2]))
    if unit == "mm" and (pitch := re.fullmatch(rf"DP\s*({_NUMBER})|({_NUMBER})\s*DP", text, re.IGNORECASE)):
        return f"a diametral pitch is teeth per inch of diameter: {_quotient(_INCH, float(pitch[1] or pitch[2]))} (mm)"
    found = _WITH_UNIT.fullmatch(text)
    return without_unit(found[1], found[2], unit) if found else ""


def _quotient(value: float, divisor: float) -> str:
    """A quotient in decimals; nothing where there is none."""
    return f"write {value / divisor:.10g}" if divisor and math.isfinite(value / divisor) else "write it in decimals"


def list_remedy(text: str) -> str:
    """How numbers in a row are written as a list; nothing for other text.

    Example
        >>> list_remedy("20, 30"), list_remedy("0,25; 0,1"), list_remedy("x")
        ('write it in brackets: [20, 30]', 'write it in brackets: [0.25, 0.1]', '')
    """
    text = text[:200].strip()
    if ";" in text:  # as a spreadsheet parts numbers with decimal commas
        text = text.replace(",", ".").replace(";", ",")
    numbers = re.split(r"\s*,\s*|\s+", text)
    if len(numbers) < 2 or not all(re.fullmatch(_NUMBER, number) for number in numbers):
        return ""
    return f"write it in brackets: [{', '.join(numbers)}]"


def text_remedy(value: Any) -> str:
    """How a number or a truth value is written where text is wanted."""
    if value is None or isinstance(value, (list, dict)):
        return ""
    return f'put it in quotes: "{shown(value)}"'


def truth_remedy(text: str) -> str:
    """What to write for the yes and no of YAML 1.1."""
    word = {"yes": "true", "on": "true", "no": "false", "off": "false"}.get(text.lower())
    return f"write {word}" if word else ""


_MOST_ERRORS = 500
_MOST_READINGS = 64
_SLIP = 0.85  # likeness of a misspelled key, before a key of that very name in a section is offered
_LISTED_KEYS = 24
_NAMED = 3
_ASIDE = {"loads", "tolerance", "register", "rating"}
_LONGEST_WORD = 40


@dataclass(frozen=True, slots=True)
class _Finding:
    """One error of pydantic at a key path; `unions` are the places where a member of a union was tried, and which."""

    kind: str
    path: KeyPath
    unions: Unions
    value: Any
    context: dict[str, Any]
    text: str


def diagnose(loaded: LoadedFile, model: type[BaseModel], error: ValidationError) -> tuple[list[Diagnostic], int]:
    """Every error of a validation as a diagnostic, and how many were left aside beyond the first few hundred."""
    raw = error.errors(include_url=False)
    findings = [_finding(dict(item), loaded.data) for item in raw[:_MOST_ERRORS]]
    more = [other for finding in findings for other in _whatever_the_tag(finding, model, loaded.data)]
    wording = _Wording(loaded, model)
    explained = wording.explained([*findings, *more])
    told = [wording.diagnostic(group) for group in _without_other_members([*findings, *more])]
    told = [each for each in told if each.code != "GL106" or each.key not in explained]
    return told, len(raw) - len(findings)


def _whatever_the_tag(finding: _Finding, model: type[BaseModel], data: Any) -> Iterator[_Finding]:
    """What else is wrong with a section whose tag is wrong or missing: what is so whichever of its members is meant."""
    from pydantic import ValidationError

    if finding.kind not in ("union_tag_invalid", "union_tag_not_found") or not isinstance(finding.value, dict):
        return
    tag = finding.context["discriminator"].strip("'")
    of_members: list[dict[KeyPath, list[_Finding]]] = []
    for member, words in members_at(model, finding.path, data, tag):
        section = {**finding.value, tag: words[0]}
        found: dict[KeyPath, list[_Finding]] = {}
        try:
            member.model_validate_json(json.dumps(section))
        except ValidationError as error:
            for item in error.errors(include_url=False)[:_MOST_ERRORS]:
                one = _finding(dict(item), section)
                unions = tuple(((*finding.path, *place), name) for place, name in one.unions)
                one = replace(one, path=(*finding.path, *one.path), unions=unions)
                found.setdefault(one.path, []).append(one)
        except NoSolution:
            pass  # two keys that do not agree are known once the member is
        of_members.append(found)
    for path in of_members[0] if of_members else ():
        if all(path in found for found in of_members):
            of_path = [found[path] for found in of_members]
            yield from min(of_path, key=lambda each: each[0].kind == "extra_forbidden")


def diagnose_truth_values(loaded: LoadedFile, model: type[BaseModel], paths: Sequence[KeyPath]) -> Iterator[Diagnostic]:
    """The places where true or false stands for a number: pydantic takes true for the 1 of a Literal."""
    for path in paths:
        if not takes_truth_value(model, path, loaded.data):
            message = f"{format_path(path)} must be a number, not true or false"
            yield loaded.report("GL107", message, path)


def _finding(item: dict[str, Any], data: Any) -> _Finding:
    loc, kind, value = tuple(item["loc"]), item["type"], item.get("input")
    tail = loc[-1:] if kind == "missing" else ()
    readings = list(islice(_readings(loc[: len(loc) - len(tail)], data, (), ()), _MOST_READINGS))
    path, _, unions = next((r for r in readings if r[1] == value), readings[0])
    return _Finding(kind, path + tail, unions, value, item.get("ctx") or {}, item["msg"])


def _readings(
    loc: tuple[str | int, ...], node: Any, path: KeyPath, unions: Unions
) -> Iterator[tuple[KeyPath, Any, Unions]]:
    """The key paths that a pydantic location can mean: it holds the names of union members among the keys."""
    if not loc:
        yield path, node, unions
        return
    step, rest = loc[0], loc[1:]
    if isinstance(node, dict) and step in node:
        yield from _readings(rest, node[step], (*path, step), unions)
    if isinstance(node, list) and isinstance(step, int) and step < len(node):
        yield from _readings(rest, node[step], (*path, step), unions)
    yield from _readings(rest, node, path, (*unions, (path, str(step))))


def _without_other_members(findings: Sequence[_Finding], level: int = 0) -> Iterator[list[_Finding]]:
    """Single findings; where no member of a union fits, the nearest member's, or all members' as one group."""
    places: dict[KeyPath, dict[str, list[_Finding]]] = {}
    for finding in findings:
        if len(finding.unions) <= level:
            yield [finding]
        else:
            at, member = finding.unions[level]
            places.setdefault(at, {}).setdefault(member, []).append(finding)
    for at, members in places.items():
        fitting = [group for group in members.values() if not any(_mismatch(f) and f.path == at for f in group)]
        if len(members) == 1 or fitting:
            yield from _without_other_members(min(fitting or members.values(), key=len), level + 1)
        else:
            yield [f for group in members.values() for f in group if _mismatch(f) and f.path == at]


def _mismatch(finding: _Finding) -> bool:
    return finding.kind in WANTED or finding.kind in ("literal_error", "enum")


_OF_A_RING = ("ring", "mesh")
"""Keys by which sections name an internal gear whose teeth are not negative."""


def _spelled(key: str) -> str:
    return re.sub(r"[\s-]+", "_", key[:100].strip().lower())


def _meant(key: str, allowed: Sequence[str], missing: Sequence[str]) -> str:
    """The key that another spelling stands for: of those that are missing, then of all; "" where none is near.

    Example
        >>> _meant("tx", ["law", "lift", "to"], ["to"]), _meant("liftt", ["law", "lift", "to"], ["to"])
        ('to', 'lift')
    """
    plain = _spelled(key)
    for names, cutoff in ((missing, 0.6), (allowed, 0.6), (missing if len(missing) == 1 else (), 0.45)):
        by_letters = {name.lower(): name for name in names}
        if near := get_close_matches(plain, by_letters, n=1, cutoff=cutoff):
            return by_letters[near[0]]
    return ""


class _Wording:
    """Turns findings into diagnostics."""

    def __init__(self, loaded: LoadedFile, model: type[BaseModel]) -> None:
        self.loaded = loaded
        self.model = model
        self.missing: dict[KeyPath, list[str]] = {}

    def diagnostic(self, group: list[_Finding]) -> Diagnostic:
        finding = group[0]
        if len(group) > 1 or _mismatch(finding):
            return self._wrong_value(group)
        if finding.kind.startswith("GL"):
            return self._own(finding)
        special = {
            "missing": self._missing,
            "extra_forbidden": self._unknown,
            "union_tag_invalid": self._wrong_tag,
            "union_tag_not_found": self._no_tag,
            "too_short": self._wrong_length,
            "too_long": self._wrong_length,
            "finite_number": self._not_finite,
        }
        if finding.kind in special:
            return special[finding.kind](finding)
        if limit := bound(finding.kind, finding.context):
            return self._out_of_range(finding, limit)
        return self._other(finding)

    def _say(
        self, code: str, finding: _Finding, message: str, help: str = "", *, of_several: bool = False
    ) -> Diagnostic:
        return self.loaded.report(code, message, finding.path, help=help, of_several=of_several)

    def _wrong_value(self, group: list[_Finding]) -> Diagnostic:
        first = group[0]
        words = [choices(f.context) if f.kind in ("literal_error", "enum") else [self._wanted(f)] for f in group]
        wanted = list(dict.fromkeys(word for some in words for word in some))
        listed = wanted[0] if len(wanted) == 1 else f"{', '.join(wanted[:-1])} or {wanted[-1]}"
        only_choice = len(group) == 1 and first.kind in ("literal_error", "enum")
        name = format_path(first.path) or "the file"
        message = f"{name} must be {listed}, not {shown(first.value)}"
        if first.value is None:
            message = f"{name} is empty: it must be {listed}"
        code = "GL108" if only_choice and isinstance(first.value, (str, int, float)) else "GL107"
        about = "" if only_choice else meaning_at(self.model, first.path, self.loaded.data)
        return self._say(code, first, message, self._value_remedy(group, wanted) or about)

    def _wanted(self, finding: _Finding) -> str:
        """What a value of another type is to be; a list with its entries where they are known."""
        _, names, example = list_at(self.model, finding.path, self.loaded.data)
        if not names or finding.kind not in ("list_type", "tuple_type"):
            return WANTED[finding.kind]
        return f"a list {names}" + (f", such as {example}" if example else "")

    def _value_remedy(self, group: list[_Finding], wanted: list[str]) -> str:
        kinds, value = {f.kind for f in group}, group[0].value
        if kinds & {"int_type", "int_from_float"} and isinstance(value, float):
            return whole_number_remedy(value)
        if isinstance(value, str):
            known = {word.strip("'").lower(): word for word in wanted if word.startswith("'")}
            if near := get_close_matches(value[:100].strip().lower(), known, n=1):
                return f"did you mean {known[near[0]]}?"
            if kinds & {"int_type", "float_type"}:
                unit = unit_at(self.model, group[0].path, self.loaded.data)
                remedy = number_remedy(value, unit)
                whole = "int_type" in kinds
                return remedy if unit or whole or not remedy.startswith(NO_UNIT) else f"{NO_UNIT}: {CONVERT}"
            if kinds & {"list_type", "tuple_type"}:
                return list_remedy(value)
            return truth_remedy(value) if "bool_type" in kinds else ""
        return text_remedy(value) if kinds == {"string_type"} else ""

    def _own(self, finding: _Finding) -> Diagnostic:
        """An error that a model raised with a code of ours, with its help on a line of its own; its context may name a
        key below the model's own."""
        below = parse_path(str(finding.context.get("key", ""))) or ()
        path = finding.path + below
        text, _, help = finding.text.partition("\n")
        help = str(finding.context.get("help", help))
        if finding.path and below and re.match(rf"set {re.escape(format_path(below))}(?![\w])", help):
            help = f"set {format_path(finding.path)}.{help.removeprefix('set ')}"
        return self.loaded.report(finding.kind, text, path, help=help, of_several=True)

    def _missing(self, finding: _Finding) -> Diagnostic:
        *parent, last = finding.path
        if isinstance(last, int):
            return self._say("GL106", finding, f"{format_path(finding.path)} is missing: the list is too short")
        where = f" in '{format_path(tuple(parent))}'" if parent else ""
        message = f"the key '{last}' is missing{where}"
        return self._say("GL106", finding, message, meaning_at(self.model, finding.path, self.loaded.data))

    def _unknown(self, finding: _Finding) -> Diagnostic:
        *parent, last = finding.path
        key = str(last)
        allowed = sorted(fields_at(self.model, tuple(parent), self.loaded.data))
        where = f" in '{format_path(tuple(parent))}'" if parent else ""
        message = f"unknown key {shown(key)}{where}"
        return self._say("GL105", finding, message, self._unknown_remedy(key, tuple(parent), finding.value, allowed))

    def _unknown_remedy(self, key: str, parent: KeyPath, value: Any, allowed: list[str]) -> str:
        name, colon, rest = key.partition(":")
        if colon and name in allowed:
            return f"a space is required after the colon: '{name}: {rest[:40].strip()}'"
        if value is None and re.fullmatch(r"[0-9]+", key):
            return "commas separate entries: write decimals with a point"
        if parent[:2] == ("tolerance", "sources") and len(parent) == 3 and isinstance(value, dict):
            source = f"{parent[2]}.{key}"
            return f'a source is named by the full path of its key: {source}, with --set "{source}" in quotation marks'
        if (meaning := self._meaning(key, parent, allowed)) is not None:
            from gearlink.cli.glossary import hint

            return hint(meaning, key, value, parent, self.loaded.data)
        if translation := self._translation(key, allowed):
            term, names = translation
            return f"{key} is the {term}: write {' or '.join(f'`{name}`' for name in names)}"
        if nested := self._nested(key, parent, value, allowed):
            return nested
        few = allowed[:_LISTED_KEYS]
        listed = f"allowed here: {', '.join(few)}{', ...' if len(few) < len(allowed) else ''}" if few else ""
        plain, by_letters = _spelled(key), {name.lower(): name for name in allowed}  # A_radius beside W_radius
        if plain not in by_letters and (elsewhere := self._elsewhere(key)):
            return f"{elsewhere}; {listed}"
        near = get_close_matches(plain, by_letters, n=1, cutoff=_SLIP)
        if (
            not near
            and isinstance(value, dict)
            and 2 * len(higher := [each for each in value if each in allowed]) > len(value)
        ):
            level = f"the level of '{format_path(parent)}'" if parent else "the top level"
            return f"its keys belong to {level} of this kind: {', '.join(higher[:_LISTED_KEYS])}"
        if not near and not parent and (deeper := self._deeper(plain)):
            return f"it belongs to {deeper}; {listed}"
        if meant := _meant(key, allowed, self.missing.get(parent, ())):
            return f"did you mean '{meant}'? {listed}".rstrip()
        own = {path: [name.lower() for name in self._keys(path)] for path in self._sections() if path != parent}
        sections = [path for path, names in own.items() if plain in names]
        if not sections:
            return listed
        place = f"to '{format_path(sections[0])}'" if sections[0] else "to the top level of the file"
        return f"it belongs {place}; {listed}"

    def _nested(self, key: str, parent: KeyPath, value: Any, allowed: Iterable[str]) -> str:
        """What to write instead of sections and a key in one word, as spring.rate or spring_rate."""
        for section in allowed:
            below, name = (*parent, section), key.removeprefix(section)[1:]
            if name and key.startswith((f"{section}.", f"{section}_")):
                inside = fields_at(self.model, below, self.loaded.data)
                if name not in inside:
                    return self._nested(name, below, value, inside)
                from gearlink.cli.glossary import instead

                return instead(format_path((*below, name)), value)
        return ""

    def _deeper(self, key: str) -> str:
        """The sections of this kind of file that have a key, where no allowed section has it.

        A word of the field that means a size of other mechanisms is none of the loads, tolerances and ratings.
        """
        from gearlink.cli.glossary import meanings_of
        from gearlink.cli.texts.schema import known_keys

        kind = str(self.loaded.data.get("kind", ""))
        of_kind = (path for path, kinds in known_keys() if kind in kinds)
        paths = [path.path for path in of_kind if key in (path.path.rpartition(".")[2], *path.also)]
        if meanings_of(key):
            paths = [path for path in paths if _ASIDE.isdisjoint(path.split("."))]
        sections = dict.fromkeys(path.rpartition(".")[0] for path in paths if "." in path)
        return " or ".join(f"'{section}'" for section in list(sections)[:3])

    def _elsewhere(self, key: str) -> str:
        """Which kinds have what a word of the field means, where this kind has no such thing."""
        from gearlink.cli.glossary import meanings_of

        kind = str(self.loaded.data.get("kind", ""))
        having: dict[str, str] = {}
        for each in meanings_of(key):
            for name in each.kinds if each.keys else ():
                having.setdefault(name, each.keys[0])
        if not having or kind in having or self._deeper(key):
            return ""
        nearest = sorted(having.items(), key=lambda item: item[1].rpartition(".")[2] != key)
        few = [f"{name} (`{path}`)" for name, path in nearest[:_NAMED]]
        others = ", ..." if len(having) > len(few) else ""
        return f"{kind} has no {key[:_LONGEST_WORD]}: kinds that have it: {', '.join(few)}{others}"

    def _meaning(self, key: str, parent: KeyPath, allowed: Sequence[str]) -> Meaning | None:
        """What an unknown key means by the words of the field; nothing for another spelling of an allowed one."""
        from gearlink.cli.glossary import folded, meaning_in

        if len(key) > _LONGEST_WORD or folded(key) in map(folded, allowed):
            return None
        return meaning_in(key, str(self.loaded.data.get("kind", "")), parent)

    def _translation(self, key: str, allowed: Sequence[str]) -> tuple[str, Sequence[str]] | None:
        """The term that a German or Chinese word stands for, and its keys, that of this section alone if it has one."""
        from gearlink.cli.glossary import translated

        found = translated(key, str(self.loaded.data.get("kind", ""))) if len(key) <= _LONGEST_WORD else None
        if found is None or _spelled(key) in allowed:
            return None
        term, paths = found
        here = [name for path in paths if (name := path.rpartition(".")[2]) in allowed]
        return term, here[:1] or paths[:_NAMED]

    def explained(self, findings: Sequence[_Finding]) -> set[str]:
        """The keys that words instead of them stand for, and their sections: that they are missing is said already."""
        found: set[str] = set()
        for finding in findings:
            if finding.kind == "missing":
                self.missing.setdefault(finding.path[:-1], []).append(str(finding.path[-1]))
        for finding in findings:
            if finding.kind == "extra_forbidden":
                *parent, last = finding.path
                allowed = list(fields_at(self.model, tuple(parent), self.loaded.data))
                lacking = self.missing.get(tuple(parent), ())
                if meant := _meant(str(last), allowed, lacking):
                    found |= {format_path((*parent, meant))} if meant in lacking else self._asked_for(findings, parent)
                meaning = self._meaning(str(last), tuple(parent), allowed)
                if translation := self._translation(str(last), allowed):
                    found.update(format_path((*parent, name)) for name in translation[1] if name in allowed)
                for key in meaning.keys if meaning else ():
                    steps = key.split(".")
                    found.update(".".join(steps[:depth]) for depth in range(1, len(steps) + 1))
        return found

    def _asked_for(self, findings: Sequence[_Finding], section: Sequence[str | int]) -> set[str]:
        """The keys that a section must have instead of others, of which one may be misspelled."""
        paths = (each.path + (parse_path(str(each.context.get("key", ""))) or ()) for each in findings
                 if each.kind == "GL106")  # fmt: skip
        return {format_path(path) for path in paths if [*path[:-1]] == [*section]}

    def _sections(self) -> list[KeyPath]:
        return [(), *((name,) for name in self._keys(()))]

    def _keys(self, path: KeyPath) -> list[str]:
        return list(fields_at(self.model, path, self.loaded.data))

    def _wrong_tag(self, finding: _Finding) -> Diagnostic:
        tag = finding.context.get("discriminator", "").strip("'")
        expected = re.findall(r"'([^']*)'", finding.context.get("expected_tags", ""))
        path = (*finding.path, tag)
        given = str(finding.context.get("tag", ""))
        plain = given[:100].strip().lower()
        near = [word for word in expected if plain and word.startswith(plain)] or get_close_matches(
            plain, expected, n=1
        )
        message = f"{format_path(path)} must be {' or '.join(expected)}, not {shown(given)}"
        return self.loaded.report("GL108", message, path, help=f"did you mean {' or '.join(near)}?" if near else "")

    def _no_tag(self, finding: _Finding) -> Diagnostic:
        path = (*finding.path, finding.context.get("discriminator", "").strip("'"))
        where = f" in '{format_path(finding.path)}'" if finding.path else ""
        about = meaning_at(self.model, path, self.loaded.data)
        return self.loaded.report("GL106", f"the key '{path[-1]}' is missing{where}", path, help=about)

    def _wrong_length(self, finding: _Finding) -> Diagnostic:
        context = finding.context
        least, most = context.get("min_length"), context.get("max_length")
        limit = least if most is None else most
        length, names, _ = list_at(self.model, finding.path, self.loaded.data)
        wanted = f"at {'least' if most is None else 'most'} {amount(int(limit or 0), 'entry', 'entries')}"
        if length:
            wanted = f"exactly {amount(length, 'entry', 'entries')}{f', {names}' if names else ''}"
        count = context.get("actual_length") or len(finding.value)  # of a mapping pydantic does not say it
        message = f"{format_path(finding.path)} must have {wanted}, not {count}"
        return self._say("GL107", finding, message, meaning_at(self.model, finding.path, self.loaded.data))

    def _not_finite(self, finding: _Finding) -> Diagnostic:
        return self._say(
            "GL108", finding, f"{format_path(finding.path)} is not a finite number", "give a finite number"
        )

    def _out_of_range(self, finding: _Finding, limit: str) -> Diagnostic:
        message = f"{format_path(finding.path)} must be {limit}, not {shown(finding.value)}"
        whole = allowed_range(self.model, finding.path, self.loaded.data)
        help = self._of_a_ring(finding) or (f"allowed: {whole}" if whole else "")
        return self._say("GL108", finding, message, help)

    def _of_a_ring(self, finding: _Finding) -> str:
        """The keys of an internal gear, where negative teeth mean one that the section writes otherwise."""
        *parent, last = finding.path
        negative = isinstance(finding.value, int) and finding.value < 0
        if not negative or unit_at(self.model, finding.path, self.loaded.data) != "teeth":
            return ""
        known = fields_at(self.model, tuple(parent), self.loaded.data)
        keys = [f"`{key}` ({known[key].description})" for key in _OF_A_RING if key in known and key != last]
        return f"an internal gear is written by {' or '.join(keys)}" if keys else ""

    def _other(self, finding: _Finding) -> Diagnostic:
        """What a validator says in its own words: of a section it is a contradiction, of a value a wrong value."""
        raised = finding.context.get("error")
        message = str(raised) if isinstance(raised, Exception) and str(raised) else finding.text
        section = isinstance(finding.value, dict)
        return self._say("GL111" if section else "GL108", finding, message, of_several=section)
