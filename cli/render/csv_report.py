"""Reports as CSV at full precision: one block per part, blocks separated by an empty line."""

from __future__ import annotations

import csv
from collections.abc import Iterable, Iterator, Sequence
from itertools import chain, takewhile
from typing import IO

from gearlink.cli import process
from gearlink.cli.printable import cell
from gearlink.core.base.report import Report, Table


def write_csv(report: Report, stream: IO[str]) -> None:
    """Write the report as CSV to standard output, row by row: quantities, checks and tables, each with its own header
    row; no more of them than somebody reads."""
    for number, block in enumerate(_blocks(report)):
        if number:
            stream.write("\n")
        write_rows(takewhile(lambda _: process.output_is_read, block), stream)


def write_rows(rows: Iterable[Iterable[object]], stream: IO[str]) -> None:
    """Write rows as CSV; text in them is shown as `cell` shows it, numbers stand as they are."""
    writer = csv.writer(stream, lineterminator="\n")
    writer.writerows([_shown(item) for item in row] for row in rows)


def _shown(item: object) -> object:
    """Text made visible, truth values as design files write them."""
    return cell(item) if type(item) is str else str(item).lower() if item is True or item is False else item


def _blocks(report: Report) -> Iterator[Iterable[Iterable[object]]]:
    if report.quantities:
        yield [
            ("quantity", "symbol", "unit", "value"),
            *(
                (q.name, q.symbol, q.unit, *(q.value if isinstance(q.value, list) else [q.value]))
                for q in report.quantities
            ),
        ]
    if report.checks:
        yield [
            ("code", "check", "status", "value", "limit", "unit", "message", "fix", "note"),
            *(
                (c.code, c.name, c.status, c.value, c.limit, c.unit, c.message, c.fix or "", "; ".join(c.note))
                for c in report.checks
            ),
        ]
    for table in report.tables:
        yield table_rows(table)


def table_rows(table: Table) -> Iterator[Sequence[object]]:
    """A table's header row, `column [unit]`, and its rows."""
    heads = [
        f"{column} [{unit}]" if unit not in ("", "1") else column
        for column, unit in zip(table.columns, table.units, strict=True)
    ]
    return chain([heads], table.each_row())
