"""Suggestions for an unknown word: names that contain it, and names of which it is a misspelling."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from difflib import get_close_matches

_LETTERS_FOR_A_SLIP = 4
_BETWEEN = re.compile(r"[\s_-]+")


def near_names(word: str, names: Iterable[str], most: int = 3) -> list[str]:
    """The names that are near a word; none where it is a word of its own, however alike some letters are.

    A name is near that has the word, or all words of it, among its own, or whose spelling, or that of one of its
    words, is off by a slip for every four letters: a letter too many, too few or wrong, or two exchanged.

    Example
        >>> known = ["path_height", "two-gear-four-bar", "sliding", "crank_length", "place"]
        >>> near_names("height", known), near_names("four-bar", known), near_names("crank_lenght", known)
        (['path_height'], ['two-gear-four-bar'], ['crank_length'])
        >>> near_names("transmision angle", ["min_transmission_angle", "transmission-angle"])
        ['transmission-angle', 'min_transmission_angle']
        >>> near_names("indexing", known), near_names("space", known)
        ([], [])
    """
    asked = word.lower()
    spelled, given = _BETWEEN.sub(" ", asked), _words(asked)  # a hyphen for a blank is no slip
    off = {name: _off(asked, spelled, given, name.lower()) for name in names}
    ranked = sorted((rank, len(name), name) for name, rank in off.items() if rank >= 0)
    return [name for _, _, name in ranked[:most]]


def _off(asked: str, spelled: str, given: Sequence[str], name: str) -> int:
    """By how many slips a name is off, 0 for one that has the words that are asked for; -1 where it is not near."""
    most = max(1, len(asked) // _LETTERS_FOR_A_SLIP)
    whole = slips(spelled, _BETWEEN.sub(" ", name), most)
    if whole >= 0:
        return whole
    words = _words(name)
    if (together := _off_words(given, words)) >= 0:
        return together
    off = [found for part in words if len(part) >= _LETTERS_FOR_A_SLIP and (found := slips(asked, part, most)) >= 0]
    return min(off, default=-1)


def _off_words(parts: Sequence[str], words: Sequence[str]) -> int:
    """By how many slips all of some words are off others; -1 without words, and from the first one that is not near."""
    total = 0 if parts else -1
    for part in parts:
        off = _off_word(part, words)
        if off < 0:
            return -1
        total += off
    return total


def _off_word(part: str, words: Sequence[str]) -> int:
    """By how many slips a word is off the nearest of some, 0 for one of them; -1 where none is near."""
    if part in words:
        return 0
    most = len(part) // _LETTERS_FOR_A_SLIP
    return min((off for word in words if (off := slips(part, word, most)) >= 0), default=-1)


def _words(name: str) -> list[str]:
    return [part for part in re.split(r"[^a-z0-9]+", name) if part]


def slips(one: str, other: str, most: int) -> int:
    """Letters to add, drop, change or exchange with their neighbour, from one word to another; -1 above `most`.

    Example
        >>> slips("dwel", "dwell", 1), slips("phi31", "phi13", 1), slips("space", "place", 1)
        (1, 1, -1)
    """
    if abs(len(one) - len(other)) > most:
        return -1
    before: list[int] = []
    row = list(range(len(other) + 1))
    for i, letter in enumerate(one, 1):
        before, last, row = row, before, [i]
        for j, wanted in enumerate(other, 1):
            cost = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (letter != wanted))
            if i > 1 and j > 1 and letter == other[j - 2] and one[i - 2] == wanted:
                cost = min(cost, last[j - 2] + 1)
            row.append(cost)
        if min(row) > most:
            return -1
    return row[-1] if row[-1] <= most else -1


def near_quantities(word: str, known: Sequence[str]) -> list[str]:
    """The quantities of a design that a word is near to: by symbol, then by name, those of no mesh first.

    Example
        >>> known = ["safety_pitting", "pitting_life", "contact_ratio", "crank_idler.contact_ratio"]
        >>> near_quantities("pitting_safety", known), near_quantities("SH", known)
        (['safety_pitting'], ['safety_pitting'])
        >>> near_quantities("contact", known), near_quantities("eps_alpha", known)
        (['contact_ratio', 'crank_idler.contact_ratio'], ['contact_ratio', 'crank_idler.contact_ratio'])
    """
    from gearlink.core.base.nomenclature import TERMS

    asked = _letters(word)
    terms = ((name, TERMS.get(name.rpartition(".")[2])) for name in known)
    symbols = ((name, _SYMBOLS.split(entry.symbol)) for name, entry in terms if entry is not None)
    of_symbol = [name for name, each in symbols if asked and asked in map(_letters, each)]
    plain = [name for name in known if "." not in name]
    found = [*of_symbol, *near_names(word, plain), *near_names(word, known)]
    found = found or near_names(word.rpartition(".")[2].partition("[")[0], known)  # that of another mesh
    found = found or get_close_matches(word, known, n=3, cutoff=0.6)
    return list(dict.fromkeys(found))[:3]


_SYMBOLS = re.compile(r"[,\s]+")


def _letters(text: str) -> str:
    return re.sub(r"[^a-z0-9]", "", text.lower())
