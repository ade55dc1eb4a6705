"""What each code means and how to repair the design."""

from __future__ import annotations

from functools import cache

from gearlink.cli.texts.files import FILES
from gearlink.cli.texts.studies import STUDIES
from gearlink.cli.texts.tolerances import TOLERANCES
from gearlink.core.codes import rules
from gearlink.core.report import Rule


@cache
def explanations() -> dict[str, Rule]:
    """Every code with its texts, in the order of the codes: those of files and command lines, then the checks'."""
    return {rule.code: rule for rule in (*FILES, *STUDIES, *TOLERANCES)} | rules()
