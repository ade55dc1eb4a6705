"""Terms of the field, places of the sources and words of other tools: the records of `texts/glossary.json`.

`explain`, completion, the hints at unknown keys and docs/glossary.md read them; nothing else does, and nothing at
start-up.
How a name is written does not matter: case, blanks, hyphens, underscores and accents are folded.
"""

from __future__ import annotations

import json
import re
import unicodedata
from collections.abc import Collection, Iterator, Sequence
from functools import cache, lru_cache
from pathlib import Path
from typing import Any, NamedTuple
from unicodedata import normalize

GLOSSARY = Path(__file__).parent / "texts" / "glossary.json"
_FOLDED = {"ß": "ss", "ä": "ae", "ö": "oe", "ü": "ue"}
_SEPARATORS = re.compile(r"[\s_'’-]+")
_PLACE = re.compile(
    r"(?P<source>[^()]*?)(?:(?<![a-z])(?P<what>figures?|fig\.?|附?图|рис\.?|abb(?:ildung)?\.?|bild|gl(?:eichung)?\.?|式|equations?|eqs?\.?|formula|section|sheet|examples?|beispiel|例)\s*)?"
    r"(?P<open>\()?(?P<label>\d+(?:[-.]\d+){0,2})\)?",
    re.IGNORECASE,
)
_WHAT = {
    "fi": "figure",
    "图": "figure",
    "ри": "figure",
    "ab": "figure",
    "bi": "figure",
    "gl": "equation",
    "式": "equation",
    "eq": "equation",
    "fo": "equation",
}
_WHAT |= {"se": "section", "sh": "sheet", "附图": "sheet", "ex": "example", "be": "example", "例": "example"}
_NUMERALS = str.maketrans("一二三四五六七八九", "123456789")


class Concept(NamedTuple):
    """A term of the field.

    Fields
        definition : str - two sentences
        also, german, chinese : other English names, and the names in German (VDI, DIN) and Chinese, the usual one first
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
def glossary() -> dict[str, Concept]:
    """The terms by their names, in the order of the subjects."""
    return {name: Concept(name=name, **_as_tuples(record)) for name, record in _records()["terms"].items()}


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


@lru_cache(10_000)
def folded(name: str) -> str:
    """A name as it is compared: no case, blanks, hyphens, underscores, accents.

    Example
        >>> folded("Transmission angle") == folded("transmission_angle"), folded("Übertragungswinkel")
        (True, 'uebertragungswinkel')
    """
    plain = "".join(_FOLDED.get(letter, letter) for letter in normalize("NFKC", name).casefold())
    letters = normalize("NFKD", _SEPARATORS.sub("", plain))
    return "".join(letter for letter in letters if normalize("NFKC", letter) and not "\u0300" <= letter <= "\u036f")


def named_terms(name: str) -> list[Concept]:
    """The terms that a name stands for, those that it names first; several where one word has several meanings.

    A plural counts as its singular where nothing is called by it.
    """
    asked = folded(name)
    found = _by_name().get(asked) or _by_name().get(asked.removesuffix("s"), [])
    return sorted(found, key=lambda term: folded(term.name) != asked)


def terms_by_symbol(symbol: str) -> list[Concept]:
    """The terms with a symbol that is written so.

    Example
        >>> [term.name for term in terms_by_symbol("K_A")]
        ['application factor']
    """
    return [term for term in glossary().values() if term.symbol == symbol]


_GREEK = {"ε": "eps", "ϕ": "phi", "ϑ": "theta", "ϵ": "eps"}
_LETTER = re.compile("[\u0391-\u03a9\u03b1-\u03c9\u03d1\u03d5\u03f5]")


def in_latin_letters(symbol: str) -> str:
    """A symbol with its Greek letters as the nomenclature writes them, subscripts as letters.

    Example
        >>> in_latin_letters("ε_α"), in_latin_letters("K_Hβ"), in_latin_letters("φ₁₃"), in_latin_letters("Ψ_0")
        ('eps_alpha', 'K_Hbeta', 'phi13', 'Psi_0')
    """

    def spelled(found: re.Match[str]) -> str:
        letter = found[0]
        called = unicodedata.name(letter).split()[3].lower().replace("lamda", "lambda")
        return _GREEK.get(letter) or (called.capitalize() if letter.isupper() else called)

    return normalize("NFKC", _LETTER.sub(spelled, symbol))


def terms_within(text: str, most: int = 4) -> list[str]:
    """Names of terms that stand in a text, the longest first and none of them within another; of Chinese by its signs.

    Example
        >>> terms_within("how long is the dwell"), terms_within("预定停歇角")
        (['dwell'], ['停歇角'])
    """
    parts = re.findall(r"[\u4e00-\u9fff]|[^\s_\u4e00-\u9fff-]+", text)
    longest = 1 + max(map(len, _by_name()))  # a plural is longer by one
    named = [here for start in range(len(parts)) for here in _phrases(parts, start, longest) if named_terms(here[1])]
    taken: set[int] = set()
    found: dict[str, None] = {}
    for places, name in sorted(named, key=lambda here: -len(here[0])):
        if taken.isdisjoint(places):
            taken |= {*places}
            found[name] = None
    return list(found)[:most]


def _phrases(parts: Sequence[str], start: int, longest: int) -> Iterator[tuple[range, str]]:
    """The phrases of at most so many letters that begin at a word; a lone letter is none."""
    letters = 0
    for end in range(start + 1, len(parts) + 1):
        letters += len(parts[end - 1])
        if letters > longest:
            return
        if letters > 1:
            words = " ".join(parts[start:end])
            yield range(start, end), re.sub(r"(?<=[\u4e00-\u9fff]) (?=[\u4e00-\u9fff])", "", words)


def translated(word: str, kind: str) -> tuple[str, tuple[str, ...]] | None:
    """The term that a German or Chinese word stands for, and its keys in files of a kind; None where it has none.

    Example
        >>> translated("Zähnezahl", "gear-pair"), translated("机架", "crank-rocker")
        (('number of teeth', ('teeth',)), ('frame', ('links.frame',)))
    """
    from gearlink.cli.texts.schema import known_keys

    terms = [t for t in named_terms(word) if folded(word) in map(folded, (*t.german, *t.chinese)) and t.keys]
    known = {key.path for key, kinds in known_keys() if kind in kinds} if terms else set()
    found = ((term.name, tuple(key for key in term.keys if key in known)) for term in terms)
    return next((each for each in found if each[1]), None)


def kinds_named(name: str, kinds: Collection[str]) -> list[str]:
    """Of some kinds of designs those of the terms that a name stands for.

    Example
        >>> kinds_named("plate-cam", ["gear-pair", "disc-cam"])
        ['disc-cam']
    """
    return list(dict.fromkeys(kind for term in named_terms(name) for kind in term.kinds if kind in kinds))


@cache
def _by_name() -> dict[str, list[Concept]]:
    """The terms by each of their names, folded."""
    found: dict[str, list[Concept]] = {}
    for term in glossary().values():
        for name in dict.fromkeys(map(folded, term.names())):
            found.setdefault(name, []).append(term)
    return found


def meanings_of(word: str, kind: str = "") -> list[Meaning]:
    """What a word stands for, in files of a kind first."""
    return sorted(_by_word().get(folded(word), ()), key=lambda meaning: kind not in meaning.kinds)


@cache
def _by_word() -> dict[str, list[Meaning]]:
    """The meanings by each of their words, folded."""
    found: dict[str, list[Meaning]] = {}
    for meaning in meanings():
        for word in dict.fromkeys(map(folded, meaning.words)):
            found.setdefault(word, []).append(meaning)
    return found


_GEOMETRY = {
    "links",
    "gears",
    "dwell",
    "back_step",
    "speed",
    "momentary",
    "input_gears",
    "cylinder",
    "bed",
    "sync",
    "cam",
}
_GEOMETRY |= {
    "size",
    "follower",
    "phases",
    "arm",
    "cycle",
    "drive",
    "slider",
    "swing",
    "limits",
    "target",
    "rod",
    "feed",
}
_OTHER_SUBJECTS = {"load", "material", "tool", "cutter", "allowances"}
_LONGEST_VALUE = 40


def meaning_in(word: str, kind: str, section: tuple[str | int, ...]) -> Meaning | None:
    """What an unknown key stands for in a section of a file; None where the word says nothing there.

    Masses and loads have letters of their own: m in `loads` is no module.
    """
    top, itself = str(section[0]) if section else "", ".".join(map(str, (*section, word)))
    for meaning in meanings_of(word, kind):
        if itself in meaning.keys:  # of another form of the section
            continue
        if meaning.section and meaning.section == top:
            return meaning
        places = {"", *_GEOMETRY, *(key.partition(".")[0] for key in meaning.keys)}
        if kind in meaning.kinds and top in places and _OTHER_SUBJECTS.isdisjoint(section):
            return meaning
    return None


def hint(meaning: Meaning, word: str, value: Any, section: tuple[str | int, ...], data: dict[str, Any]) -> str:
    """What to write instead of an unknown key, with the value that the file gives.

    Example
        >>> e = meaning_in("e", "three-gear-four-bar", ("links",))
        >>> hint(e, "e", 28, ("links",), {"links": {"e": 28}})
        'e is the crank length here: write `crank: 28` in `links`'
    """
    head = f"{word} is {meaning.means}"
    if meaning.says:
        return f"{head}: {meaning.says}"
    parts = []
    if meaning.keys:
        keys = _nearest(meaning, section, data)
        values = value if meaning.each and isinstance(value, list) and len(value) == len(keys) else [value] * len(keys)
        known = not meaning.each or values is value
        lines = [_line(key, each, known) for key, each in zip(keys, values, strict=True)]
        parts.append(f"write {_in_sections(lines, ', ' if meaning.each else ' or ')}")
    parts += [f"quantity `{name}`" for name in meaning.quantities]
    return f"{head}{' here' if meaning.keys else ''}: {'; or '.join(parts)}"


def instead(key: str, value: Any) -> str:
    """What to write for a value that stands under another key.

    Example
        >>> instead("spring.rate", 4)
        'write `rate: 4` in `spring`'
    """
    return f"write {_in_sections([_line(key, value, True)], '')}"


def _nearest(meaning: Meaning, section: tuple[str | int, ...], data: dict[str, Any]) -> list[str]:
    """Of the keys those of the same section, else those of sections that the file has, else all."""
    here = ".".join(map(str, section))
    ranks = [
        [key for key in meaning.keys if key.rpartition(".")[0] == here],
        [key for key in meaning.keys if key.partition(".")[0] in data],
    ]
    return next((keys for keys in ranks if keys and not meaning.each), list(meaning.keys))


def _line(key: str, value: Any, known: bool) -> tuple[str, str]:
    """Section and `key: value` of a key."""
    section, _, last = key.rpartition(".")
    told = known and value is not None and not (isinstance(value, str) and re.match(r"[-+.]?\d", value))
    text = json.dumps(value, ensure_ascii=False) if told else "..."
    return section, f"`{last}: {text if len(text) <= _LONGEST_VALUE else '...'}`"


def _in_sections(lines: list[tuple[str, str]], joined: str) -> str:
    sections: dict[str, list[str]] = {}
    for section, line in lines:
        sections.setdefault(section, []).append(line)
    place = {section: f"in `{section}`" if section else "at the top level of the file" for section in sections}
    return " or ".join(f"{joined.join(found)} {place[section]}" for section, found in sections.items())


def named_places(name: str) -> Iterator[tuple[str, Place]]:
    """The places of the sources that a name such as "(4-26)", "figure 2-4" or "dissertation (18)" stands for.

    Example
        >>> [(label, place.what, place.commands) for label, place in named_places("(4-26)")]
        [('4-26', 'equation', ('synth momentary-dwell',))]
        >>> [(label, place.what) for label, place in named_places("附图四")]
        [('4', 'sheet')]
    """
    found = _PLACE.fullmatch(name.strip().translate(_NUMERALS))
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
