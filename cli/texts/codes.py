"""What each code means and how to repair the design; the other `explanations_` modules hold the texts."""

from __future__ import annotations

from functools import cache

from gearlink.cli.texts.explanation import Explanation


@cache
def explanations() -> dict[str, Explanation]:
    """Every code with its text, in the order of the codes."""
    from gearlink.cli.texts.checks import CHECKS
    from gearlink.cli.texts.files import FILES
    from gearlink.cli.texts.linkages import LINKAGES

    return dict(sorted({**FILES, **CHECKS, **LINKAGES}.items()))
