"""Numbers as a reader wants them: few digits, and no rounding noise in place of a zero."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import Any

from gearlink.core.report import Table


def number(value: object, digits: int = 7) -> str:
    """A value to a few digits, as an engineer reads it; the members of a list side by side.

    Example
        >>> number(38.85708906143053), number(40), number(None), number([1.0, 2.5])
        ('38.85709', '40', '-', '1 2.5')
    """
    if value is None:
        return "-"
    if isinstance(value, list):
        return " ".join(number(item, digits) for item in value)
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    return str(value)


def thinning(step: int, table: Table) -> str:
    """Which rows of a table are shown, in words.

    Example
        >>> table = Table("t", ("x",), ("1",), (range(360),))
        >>> thinning(2, table), thinning(15, table)
        ('every 2nd of 360 rows', 'every 15th of 360 rows')
    """
    ending = "th" if step % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(step % 10, "th")
    return f"every {step}{ending} of {table.length} rows"


def readable_rows(table: Table, step: int = 1, digits: int = 6) -> list[list[str]]:
    """Every `step`-th row as text; values that are rounding beside their column's largest are shown as 0."""
    noise = [_noise(column) for column in table.data]
    rows = table.thinned(step).each_row()
    return [[number(_quiet(x, level), digits) for x, level in zip(row, noise, strict=True)] for row in rows]


def _noise(column: Any) -> float:
    items: Iterable[object] = column.tolist() if hasattr(column, "tolist") else column
    return 1e-13 * max((abs(x) for x in items if isinstance(x, float) and math.isfinite(x)), default=0.0)


def _quiet(value: object, level: float) -> object:
    return 0.0 if isinstance(value, float) and abs(value) < level else value
