"""What each code means and how to mend the design; the other `explanations_` modules hold the texts."""

from __future__ import annotations

from functools import cache
from typing import NamedTuple


class Explanation(NamedTuple):
    """The text of a code.

    Fields
        title : str - a few words
        what, why : str - what was found, and why it matters
        formula, source : str - the quantity that was compared, and where it comes from; empty for file errors
        mend : str - what to change
        checks : names of the checks that report with the code; empty for file errors
        keys : dotted paths of the design file's keys that a finding belongs to, the most telling first
    """

    title: str
    what: str
    why: str
    mend: str
    formula: str = ""
    source: str = ""
    checks: tuple[str, ...] = ()
    keys: tuple[str, ...] = ()


@cache
def explanations() -> dict[str, Explanation]:
    """Every code with its text, in the order of the codes."""
    from gearlink.cli.texts.checks import CHECKS
    from gearlink.cli.texts.files import FILES
    from gearlink.cli.texts.linkages import LINKAGES

    return dict(sorted({**FILES, **CHECKS, **LINKAGES}.items()))
