"""Which names may have been meant by a word that nothing bears: those that hold it, and those that it misspells."""

from __future__ import annotations

import re
from collections.abc import Iterable

_LETTERS_FOR_A_SLIP = 4


def near_names(word: str, names: Iterable[str], most: int = 3) -> list[str]:
    """The names that are near a word; none where it is a word of its own, however alike some letters are.

    A name is near that has the word, or all words of it, among its own, or whose spelling, or that of one of its
    words, is off by a slip for every four letters: a letter too many, too few or wrong, or two exchanged.

    Example
        >>> known = ["path_height", "two-gear-four-bar", "sliding", "crank_length", "place"]
        >>> near_names("height", known), near_names("four-bar", known), near_names("crank_lenght", known)
        (['path_height'], ['two-gear-four-bar'], ['crank_length'])
        >>> near_names("indexing", known), near_names("space", known)
        ([], [])
    """
    asked = word.lower()
    ranked = sorted(
        (rank, len(name), name) for name in dict.fromkeys(names) if (rank := _off(asked, name.lower())) >= 0
    )
    return [name for _, _, name in ranked[:most]]


def _off(asked: str, name: str) -> int:
    """By how many slips a name is off, 0 for one that has the words that are asked for; -1 where it is not near."""
    most = max(1, len(asked) // _LETTERS_FOR_A_SLIP)
    whole = slips(asked, name, most)
    if whole >= 0:
        return whole
    words, given = _words(name), _words(asked)
    if all(part in words for part in given):
        return 0
    off = [found for part in words if len(part) >= _LETTERS_FOR_A_SLIP and (found := slips(asked, part, most)) >= 0]
    return min(off, default=-1)


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
