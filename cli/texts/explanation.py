"""The form in which the text of a code is kept."""

from __future__ import annotations

from typing import NamedTuple


class Explanation(NamedTuple):
    """The text of a code.

    Fields
        title : str - a few words
        what, why : str - what was found, and why it matters
        formula, source : str - the quantity that was compared, and where it comes from; empty for file errors
        repair : str - what to change
        checks : names of the checks that report with the code; empty for file errors
        keys : dotted paths of the design file's keys that a finding belongs to, the most telling first
    """

    title: str
    what: str
    why: str
    repair: str
    formula: str = ""
    source: str = ""
    checks: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()
