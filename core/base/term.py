"""An entry of the nomenclature."""

from __future__ import annotations

from typing import NamedTuple


class Term(NamedTuple):
    """Symbol, unit, meaning and source of a quantity."""

    symbol: str
    unit: str
    words: str
    source: str = ""
