"""Terms of the field, places of the sources and words of other tools: the records of `glossary.json`.

`explain`, completion, the hints at unknown keys and docs/glossary.md read them; nothing else does, and nothing at start-up.
How a name is written does not matter: case, blanks, hyphens, underscores and accents are folded.
"""

from __future__ import annotations

import json
import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from typing import Any, NamedTuple
from unicodedata import normalize

GLOSSARY = Path(__file__).parent / "glossary.json"
_FOLDED = {"ß": "ss", "ä": "ae", "ö": "oe", "ü": "ue"}
_SEPARATORS = re.compile(r"[\s_'’-]+")
_PLACE = re.compile(
    r"(?P<source>[^()]*?)(?:(?<![a-z])(?P<what>figures?|fig\.?|附?图|рис\.?|abb\.?|equations?|eqs?\.?|formula|section|sheet)\s*)?"
    r"(?P<open>\()?(?P<label>\d+(?:[-.]\d+){0,2})\)?",
    re.IGNORECASE,
)
_WHAT = {"fi": "figure", "图": "figure", "ри": "figure", "ab": "figure", "eq": "equation", "fo": "equation"}
_WHAT |= {"se": "section", "sh": "sheet", "附图": "sheet"}


class Word(NamedTuple):
    """A term of the field.

    Fields
        name : str
        definition : str - two sentences
        also, german, chinese : other English names, and the names in German (VDI, DIN) and Chinese, the usual one first
        symbol : str
        keys, quantities, checks, kinds : what of the program is about it
        picture : str - the command that draws it
        see : terms next to it
    """

    name: str
    definition: str
    also: tuple[str, ...] = ()
    german: tuple[str, ...] = ()
    chinese: tuple[str, ...] = ()
    symbol: str = ""
    keys: tuple[str, ...] = ()
    quantities: tuple[str, ...] = ()
    checks: tuple[str, ...] = ()
    kinds: tuple[str, ...] = ()
    picture: str = ""
    see: tuple[str, ...] = ()

    def names(self) -> tuple[str, ...]:
        """Everything that it is called."""
        return (self.name, *self.also, *self.german, *self.chinese)


class Place(NamedTuple):
    """A figure, equation, section or sheet of a source, or a range of them, and what computes it."""

    source: str
    what: str
    first: str
    last: str
    says: str
    kinds: tuple[str, ...]
    commands: tuple[str, ...]

    def holds(self, label: str) -> bool:
        """Whether a label such as 4-26 lies in the range."""
        return _order(self.first) <= _order(label) <= _order(self.last) and len(_order(label)) == len(
            _order(self.first)
        )


class Meaning(NamedTuple):
    """What a word stands for in files of some kinds (no kinds: of every kind), which have another key for it.

    Fields
        words : the word and its variants
        means : str - "the crank length e"
        kinds, section : where it has this meaning
        keys : the keys to write instead; `each`: one for every entry of a list
        quantities : results that carry it
        says : str - how it is written, where no single key holds it
    """

    words: tuple[str, ...]
    means: str
    kinds: tuple[str, ...] = ()
    section: str = ""
    keys: tuple[str, ...] = ()
    quantities: tuple[str, ...] = ()
    says: str = ""
    each: bool = False


@cache
def _records() -> dict[str, Any]:
    found: dict[str, Any] = json.loads(GLOSSARY.read_text(encoding="utf-8"))
    return found


@cache
def glossary() -> dict[str, Word]:
    """The terms by their names, in the order of the subjects."""
    return {name: Word(name=name, **_as_tuples(record)) for name, record in _records()["terms"].items()}


@cache
def places() -> tuple[Place, ...]:
    """What figures and equations of the sources lead to."""
    return tuple(Place(**_as_tuples(record)) for record in _records()["places"])


@cache
def meanings() -> tuple[Meaning, ...]:
    """The words of other tools and sources."""
    return tuple(Meaning(**_as_tuples(record)) for record in _records()["words"])


def _as_tuples(record: dict[str, Any]) -> dict[str, Any]:
    return {key: tuple(value) if isinstance(value, list) else value for key, value in record.items()}


def folded(name: str) -> str:
    """A name as it is compared: no case, blanks, hyphens, underscores, accents.

    Example
        >>> folded("Transmission angle") == folded("transmission_angle"), folded("Übertragungswinkel")
        (True, 'uebertragungswinkel')
    """
    plain = "".join(_FOLDED.get(letter, letter) for letter in normalize("NFKC", name).casefold())
    letters = normalize("NFKD", _SEPARATORS.sub("", plain))
    return "".join(letter for letter in letters if normalize("NFKC", letter) and not "\u0300" <= letter <= "\u036f")


def named_terms(name: str) -> list[Word]:
    """The terms that a name stands for, those that it names first; several where the field uses one word for several."""
    asked = folded(name)
    return sorted(_by_name().get(asked, ()), key=lambda term: folded(term.name) != asked)


@cache
def _by_name() -> dict[str, list[Word]]:
    """The terms by each of their names, folded."""
    found: dict[str, list[Word]] = {}
    for term in glossary().values():
        for name in dict.fromkeys(map(folded, term.names())):
            found.setdefault(name, []).append(term)
    return found


def meanings_of(word: str, kind: str = "") -> list[Meaning]:
    """What a word stands for, in files of a kind first."""
    asked = folded(word)
    found = [meaning for meaning in meanings() if asked in map(folded, meaning.words)]
    return sorted(found, key=lambda meaning: kind not in meaning.kinds)


def named_places(name: str) -> Iterator[tuple[str, Place]]:
    """The places of the sources that a name such as "(4-26)", "figure 2-4" or "dissertation (18)" stands for.

    Example
        >>> [(label, place.what, place.commands) for label, place in named_places("(4-26)")]
        [('4-26', 'equation', ('synth momentary-dwell',))]
    """
    found = _PLACE.fullmatch(name.strip())
    if found is None:
        return
    label = found["label"]
    sources = [word for word in re.findall(r"[a-z0-9]+", found["source"].lower()) if word not in ("of", "the")]
    what = _WHAT.get((found["what"] or "").lower()[:2], "equation" if found["open"] else "")
    if not (what or sources or "-" in label):
        return
    for place in places():
        named = all(word in re.findall(r"[a-z0-9]+", place.source.lower()) for word in sources)
        written = what in ("figure", "equation") or ("-" in label) == ("-" in place.first)
        if named and written and place.holds(label) and what in ("", place.what):
            yield label, place


def _order(label: str) -> tuple[int, ...]:
    return tuple(map(int, re.split(r"[-.]", label)))
