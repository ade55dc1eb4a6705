"""Reports as Markdown at full precision."""

from __future__ import annotations

from collections.abc import Iterable, Sequence

from gearlink.cli.printable import visible
from gearlink.core.base.report import Report


def as_markdown(report: Report) -> str:
    """The report as Markdown: a heading, then quantities, checks and tables."""
    parts = [f"# {inline(' '.join(report.name.split()))}: {report.command}"]
    if report.quantities:
        rows = [
            (f"`{q.name}`", q.symbol, text_of(q.value), q.unit, q.words) for q in report.quantities if q.value != []
        ]
        parts.append(markdown_table(("quantity", "symbol", "value", "unit", "meaning"), rows))
    if report.checks:
        checks = [(c.status, c.code, c.name, "\n".join(c.lines)) for c in report.checks]
        parts.append(markdown_table(("status", "code", "check", "finding"), checks))
    for table in report.tables:
        heads = [
            column if unit in ("", "1") else f"{column} [{unit}]"
            for column, unit in zip(table.columns, table.units, strict=True)
        ]
        parts.append(
            f"## {table.name}\n\n" + markdown_table(heads, ([text_of(item) for item in row] for row in table.rows()))
        )
    return "\n\n".join(parts)


def inline(text: str) -> str:
    """Text as Markdown takes it: no line breaks, no tag, entity, link or picture, which a comment would load."""
    return visible(text).replace("&", "&amp;").replace("<", "&lt;").replace("](", "]\\(")


def text_of(value: object) -> str:
    """A value at full precision; the members of a list side by side, one that does not exist as `-`."""
    if isinstance(value, list):
        return " ".join("-" if item is None else text_of(item) for item in value)
    if isinstance(value, bool):
        return str(value).lower()
    return "" if value is None else repr(value) if isinstance(value, float) else str(value)


def markdown_table(heads: Sequence[str], rows: Iterable[Sequence[str]]) -> str:
    """A Markdown table."""
    lines = [_line(heads), "|" + " --- |" * len(heads), *map(_line, rows)]
    return "\n".join(lines)


def _line(cells: Sequence[str]) -> str:
    return "| " + " | ".join(_cell(cell) for cell in cells) + " |"


def _cell(text: str) -> str:
    """Text of a table's cell, whose lines stand below each other."""
    return "<br>".join(inline(line).replace("|", "\\|") for line in text.split("\n"))
