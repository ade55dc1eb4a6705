"""Numbers as a reader wants them: few digits, and no rounding noise instead of a zero."""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from gearlink.core.base.report import Report, Table, without_noise

_NOISE = 1e-12  # of the scale: what a root is left with, in a table of seven digits
_ROUNDING = 1e-13  # of the largest of a column
_HALF_WIDTH = "_pm"
_UNBOUNDED = "curvature_radius"
"""A length that grows without limit where a curve becomes straight: beside it no other is small."""
_MOST_DIGITS = 7  # behind the point: an interval that is narrower is not shown


def number(value: object, digits: int = 7) -> str:
    """A value to a few digits, as an engineer reads it; the members of a list side by side.

    Example
        >>> number(38.85708906143053), number(40), number(None), number([1.0, 2.5])
        ('38.85709', '40', '-', '1 2.5')
    """
    if isinstance(value, bool):
        return str(value).lower()
    if value is None:
        return "-"
    if isinstance(value, list):
        return _between(value).join(number(item, digits) for item in value)
    if isinstance(value, float):
        return f"{value:.{digits}g}"
    return str(value)


def _between(values: list[Any]) -> str:
    """What separates the entries of a list: texts have blanks of their own."""
    return "; " if any(isinstance(each, str) and " " in each for each in values) else " "


_DRAWN = {"mm": 3, "deg": 2}
"""Digits behind the point that a drawing has."""
_SIGNIFICANT = 4
_WHOLE = 1e7
"""Below it what has more than four digits before the point is written out, as 16790."""


def drawn(value: object, unit: str, digits: int | str | None = None) -> str:
    """A value as a drawing has it: 0.001 mm, 0.01 deg, else four significant digits; never fewer than two that count.

    Parameters
        digits : significant digits instead of these; "full": all
    Example
        >>> drawn(30.3455567, "mm"), drawn(84.0, "mm"), drawn(0.00004, "deg"), drawn(16791.9, "W"), drawn(44, "1")
        ('30.346', '84.000', '4e-05', '16790', '44')
        >>> drawn([1.0 / 3.0, None], "1", 3), drawn(1.0 / 3.0, "mm", "full")
        ('0.333 -', '0.3333333333333333')
    """
    if isinstance(value, list):
        return _between(value).join(drawn(item, unit, digits) for item in value)
    if not isinstance(value, float):
        return number(value)
    if digits is not None:
        return repr(value) if isinstance(digits, str) else f"{value:.{digits}g}"
    places = _DRAWN.get(unit)
    if places is not None and (value == 0.0 or abs(value) >= 9.5 * 10.0**-places):
        return f"{value:.{places}f}"
    if places is not None:
        return f"{value:.2g}"
    text = f"{value:.{_SIGNIFICANT}g}"
    return f"{float(text):.0f}" if "e+" in text and abs(value) < _WHOLE else text


def scales(report: Report) -> dict[str, float]:
    """The largest number of each unit in a report: what is below its rounding error is noise beside it.

    Ratios and shares are judged beside 1 at least, the size of what they are quotients of.
    """
    found = {"1": 1.0}
    for unit, values in _values(report):
        found[unit] = max(found.get(unit, 0.0), _largest(values))
    return found


def _values(report: Report) -> Iterator[tuple[str, Any]]:
    for q in report.quantities:
        if not q.name.endswith(_UNBOUNDED):
            yield q.unit, q.value if isinstance(q.value, list) else [q.value]
    yield from ((check.unit, (check.value, check.limit)) for check in report.checks)
    for table in report.tables:
        columns = zip(table.columns, table.units, table.data, strict=True)
        yield from ((unit, data) for name, unit, data in columns if not name.endswith(_UNBOUNDED))


def quiet(value: object, scale: float) -> object:
    """A number, or a list of them, with 0 for what is rounding beside `scale`.

    Example
        >>> quiet([2.2e-16, 1.5], 1.5), quiet(40, 1.0), quiet(None, 1.0)
        ([0.0, 1.5], 40, None)
    """
    if isinstance(value, list):
        return [quiet(item, scale) for item in value]
    if not isinstance(value, float) or abs(value) < _NOISE * scale:
        return 0.0 if isinstance(value, float) else value
    return without_noise(value, scale)


def thinning(step: int, table: Table) -> str:
    """Which rows of a table are shown, in words.

    Example
        >>> table = Table("t", ("x",), ("1",), (range(360),))
        >>> thinning(2, table), thinning(15, table)
        ('every 2nd of 360 rows', 'every 15th of 360 rows')
    """
    ending = "th" if step % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(step % 10, "th")
    return f"every {step}{ending} of {table.length} rows"


def readable_rows(
    table: Table, step: int = 1, scale: Mapping[str, float] = MappingProxyType({}), digits: int | str | None = 6
) -> list[list[str]]:
    """Every `step`-th row as text; values that are rounding beside their column's largest are shown as 0, and a column
    that is rounding as a whole beside what its unit has elsewhere, `scale`. `digits` as in `drawn`."""
    noise = [
        _noise(0.0 if name.endswith(_UNBOUNDED) else _largest(column), scale.get(unit, 0.0))
        for name, unit, column in zip(table.columns, table.units, table.data, strict=True)
    ]
    rows = table.thinned(step).each_row()
    cells = [[_quiet(x, level) for x, level in zip(row, noise, strict=True)] for row in rows]
    by_column = list(zip(*cells, strict=True)) or [()] * len(table.units)
    columns = [_of_column(column, unit, digits) for column, unit in zip(by_column, table.units, strict=True)]
    if digits is None and "unit" in table.columns:
        units = by_column[table.columns.index("unit")]
        columns = [
            _of_lines(column, units) if unit == "1" else kept
            for column, unit, kept in zip(by_column, table.units, columns, strict=True)
        ]
    return [list(row) for row in zip(*columns, strict=True)]


def _of_column(values: Sequence[object], unit: str, digits: int | str | None) -> list[str]:
    """The cells of a column; whole numbers of a drawing, such as input angles, without digits behind the point."""
    whole = digits is None and all(not isinstance(x, float) or x.is_integer() for x in values)
    return [drawn(x, "1" if whole else unit, 7 if whole else digits) for x in values]


def _of_lines(values: Sequence[object], units: Sequence[object]) -> list[str]:
    """The cells of a column whose lines have a unit each; what is round in the digits of a drawing without zeros."""
    pairs = list(zip(values, map(str, units), strict=True))
    round_ = [isinstance(x, float) and x == round(x, _DRAWN.get(unit, 0)) for x, unit in pairs]
    return [number(x) if short else drawn(x, unit) for (x, unit), short in zip(pairs, round_, strict=True)]


def _noise(largest: float, scale: float) -> float:
    return _ROUNDING * (scale if largest < _ROUNDING * scale else largest)


def _largest(column: Any) -> float:
    items: Iterable[object] = column.tolist() if hasattr(column, "tolist") else column
    return max((abs(x) for x in items if isinstance(x, float) and math.isfinite(x)), default=0.0)


def _quiet(value: object, level: float) -> object:
    return 0.0 if isinstance(value, float) and abs(value) < level else value


def with_intervals(table: Table, cells: list[list[str]]) -> tuple[Table, list[list[str]]]:
    """Estimates with their half-width X_pm in one column, short; columns that say nothing left out.

    A table without half-widths stays as it is.
    """
    at = {name: i for i, name in enumerate(table.columns)}
    if not cells or not any(name.endswith(_HALF_WIDTH) for name in table.columns):
        return table, cells
    shown = [
        i
        for i, name in enumerate(table.columns)
        if name.removesuffix(_HALF_WIDTH) == name and any(value is not None for value in table.data[i])
    ]
    rows = []
    for k, row in enumerate(cells):
        halves = {i: table.data[at[name + _HALF_WIDTH]][k] for name, i in at.items() if name + _HALF_WIDTH in at}
        rows.append([_interval(row[i], table.data[i][k], halves.get(i)) for i in shown])
    units, data = tuple(table.units[i] for i in shown), tuple(table.data[i] for i in shown)
    return Table(table.name, tuple(table.columns[i] for i in shown), units, data), rows


def _interval(cell: str, value: Any, half: float | None) -> str:
    """A value to the digits that its interval leaves it, as 20.3107 +-0.0005; its cell has six, often fewer."""
    if half is None or not math.isfinite(half) or half <= 0.0 or not isinstance(value, float):
        return cell
    digits = max(0, -math.floor(math.log10(half)))
    if digits > _MOST_DIGITS:
        return cell
    return f"{value:.{digits}f} +-{half:.{digits}f}"
