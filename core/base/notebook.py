"""Reports and tables as HTML, which notebooks show instead of text."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import replace
from html import escape
from itertools import chain, islice
from typing import TYPE_CHECKING, Any

from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from gearlink.core.base.report import Report, Table

_ENDS = 10
"""Rows shown at either end of a long table."""


def report_as_html(report: Report) -> str:
    """Quantities, then checks, then tables of a report."""
    parts = [f"<h4>{escape(report.name)}: {escape(report.command)}</h4>"]
    if report.quantities:
        rows = ((q.name, q.symbol, q.value, "" if q.unit == "1" else q.unit) for q in report.quantities)
        parts.append(_grid(("quantity", "symbol", "value", "unit"), rows))
    if report.checks:
        parts.append(
            _grid(
                ("status", "check", "finding"),
                ((c.status, f"{c.code} {c.name}", "\n".join(c.lines)) for c in report.checks),
            )
        )
    return "\n".join(chain(parts, map(table_as_html, report.tables)))


def table_as_html(table: Table) -> str:
    """The first and last rows of a table; all of them where they are few."""
    heads = [name if unit == "1" else f"{name} [{unit}]" for name, unit in zip(table.columns, table.units, strict=True)]
    rows: Iterable[Sequence[Any]] = table.each_row()
    if table.length > 2 * _ENDS:
        last = replace(table, data=tuple(column[-_ENDS:] for column in table.data))
        rows = chain(islice(rows, _ENDS), [["…"] * len(heads)], last.each_row())
    return f"<p>{escape(table.name)}, {amount(table.length, 'row')}</p>\n" + _grid(heads, rows)


def _grid(heads: Sequence[str], rows: Iterable[Sequence[Any]]) -> str:
    lines = (f"<tr>{''.join(f'<td>{_cell(cell)}</td>' for cell in row)}</tr>" for row in rows)
    head = "".join(f"<th>{escape(name)}</th>" for name in heads)
    return f"<table><thead><tr>{head}</tr></thead><tbody>{''.join(lines)}</tbody></table>"


def _cell(value: Any) -> str:
    if isinstance(value, (list, tuple)):
        return ", ".join(map(_cell, value))
    if isinstance(value, float):
        return f"{value:.9g}"
    return "" if value is None else escape(str(value)).replace("\n", "<br>")
