"""Reports and key results on the terminal: values to seven digits, tables thinned and folded to fit the width."""

from __future__ import annotations

import math
import os
import re
import sys
import textwrap
from collections.abc import Iterator, Mapping, Sequence
from types import MappingProxyType
from typing import Any

from rich import box
from rich.cells import cell_len
from rich.console import Console, JustifyMethod, RenderableType
from rich.table import Column
from rich.table import Table as Grid
from rich.text import Text

from gearlink.cli.options import Options
from gearlink.cli.printable import visible, visible_lines
from gearlink.cli.render.numbers import drawn, number, quiet, readable_rows, scales, thinning, with_intervals
from gearlink.core.base.report import Check, Quantity, Report, Table

_MOST_ROWS = 24
_STYLE = {"pass": "green", "warn": "yellow", "fail": "bold red"}
_WIDE = 110
_NOTHING = 1e-8  # of the limit: rounding, beside what the limit lets pass
_ALONE: Mapping[str, float] = MappingProxyType({})
_WIDTH_UNKNOWN = 80  # where COLUMNS says 0
_SYMBOLS_FROM = 56  # columns of a terminal, below which names stand without their symbols
_LEAST_TEXT = 24  # columns that words keep beside numbers, however narrow the terminal
_BETWEEN = 3  # columns of a terminal between those of a table
_TIGHT = 6


def show(report: Report, options: Options) -> None:
    """Print a report: heading, quantities, tables, checks, verdict."""
    console = console_for(options)
    console.print(Text(f"{visible(' '.join(report.name.split()))}: {report.command} ({report.kind})", style="bold"))
    if report.quantities:
        show_grid(_quantities(report, console, options.digits), console)
        if report.command == "gear":
            for grid in _pairs(report, console, options.digits):
                show_grid(grid, console)
        if console.width < _WIDE and console.is_terminal and not options.quiet:
            print(f"(terminals of {_WIDE} columns show what each quantity means; so does `gearlink explain NAME`)")
    alone = not report.quantities
    most = sys.maxsize if alone and options.all else _MOST_ROWS
    for table in report.tables:
        show_table(table, console, most, scale=scales(report), digits=options.digits, alone=alone)
    show_findings(report, console)


def show_findings(report: Report, console: Console, *, passed: bool = True) -> None:
    """What the checks found, and the verdict; `passed`: those that passed as well."""
    findings = [c for c in report.checks if c.status != "pass"]
    if findings:
        console.print()
        show_grid(_findings(findings, console), console)
    passes = [c for c in report.checks if c.status == "pass"]
    if passes and passed:
        console.print()
        show_grid(_passes(passes, scales(report), console), console)
        for note in dict.fromkeys(each for check in passes for each in check.note):
            console.print(Text(f"note: {visible(note)}"))
    counts = {status: sum(c.status == status for c in report.checks) for status in ("fail", "warn", "pass")}
    if report.checks:
        verdict = ", ".join(f"{n} {status}" for status, n in counts.items() if n)
        style = _STYLE[next(s for s, n in counts.items() if n)]
        console.print(Text(f"{report.counted}: {verdict}", style=style))


def console_for(options: Options) -> Console:
    """A console on standard output that colours nothing unless a terminal shows it."""
    # color_system=None also drops the bold codes, which NO_COLOR alone leaves in.
    plain = not options.color or not sys.stdout.isatty() or "NO_COLOR" in os.environ
    console = Console(
        file=sys.stdout,
        color_system=None if plain else "auto",
        highlight=False,
        markup=False,
        emoji=False,
        soft_wrap=False,
    )
    console.width = console.width or _WIDTH_UNKNOWN
    return console


class VisibleGrid(Grid):
    """A table whose text shows as it is and does nothing."""

    def add_row(self, *cells: RenderableType | None, **how: Any) -> None:
        """As of any table; text that comes as a string is made visible."""
        super().add_row(*(visible(cell) if isinstance(cell, str) else cell for cell in cells), **how)


def grid_for(console: Console) -> Grid:
    """An empty table in the house's form, in ASCII where the console knows no more."""
    ascii_only = not (console.encoding or "").lower().startswith("utf")
    return VisibleGrid(
        box=box.ASCII2 if ascii_only else box.SIMPLE_HEAD, show_edge=False, pad_edge=False, safe_box=ascii_only
    )


def show_grid(grid: Grid, console: Console) -> None:
    """Print a table; on a terminal too narrow for it the lines run on, so that no number is cut, broken or left out."""
    least = [_least_width(column) for column in grid.columns]
    need = sum(least) + _BETWEEN * (len(least) - 1)
    width = console.width
    if need > width - _TIGHT:  # rich would share out what is missing among all columns
        for column, each in zip(grid.columns, least, strict=True):
            column.width = each
        console.width = max(width, need + _TIGHT)  # rich before 14.3 counts a space beside the outer columns, too
    console.print(grid)
    console.width = width


def room_for_names(grid: Grid, console: Console) -> int:
    """Columns of the terminal that the other columns of a table leave to its first one."""
    others = [_least_width(column) for column in grid.columns[1:]]
    return console.width - sum(others) - _BETWEEN * len(others)


def folded(name: str, width: int) -> str:
    """A name on lines of so many columns, broken behind a point, a hyphen or an underscore, within a word only where
    that is longer.

    Example
        >>> folded("tolerance.sources.links.crank.plus_minus", 24).split("\\n")
        ['tolerance.sources.links.', 'crank.plus_minus']
    """
    lines = [""]
    for word in re.findall(r"[^-._]*[-._]+|[^-._]+", name):
        rest = word
        if cell_len(lines[-1]) + cell_len(rest) > width and lines[-1]:
            lines.append("")
        while cell_len(rest) > width:
            lines[-1:] = [rest[:width], ""]
            rest = rest[width:]
        lines[-1] += rest
    return "\n".join(lines)


def _least_width(column: Column) -> int:
    """What a column takes: words in full where they are not to be folded, numbers in full everywhere."""
    cells = [str(cell) for cell in (column.header, *column.cells)]
    parts = [part for cell in cells for part in (cell.split("\n") if column.no_wrap else cell.split())]
    longest = max(map(cell_len, parts), default=0)
    return longest if column.no_wrap or column.justify == "right" else min(longest, _LEAST_TEXT)


def _quantities(report: Report, console: Console, digits: int | str | None) -> Grid:
    grid, scale = grid_for(console), scales(report)
    wide, symbols = console.width >= _WIDE, console.width >= _SYMBOLS_FROM
    for head in ("quantity", *(["symbol"] if symbols else []), "value", "unit", *(["meaning"] if wide else [])):
        side: JustifyMethod = "right" if head == "value" else "left"
        grid.add_column(head, justify=side, overflow="fold", no_wrap=head in ("quantity", "unit"))
    for q in report.quantities:
        if q.value == [] or (report.command == "gear" and _per_gear(q)):  # no standstill has no place
            continue
        unit = "" if q.unit == "1" else q.unit
        value = drawn(quiet(q.value, scale.get(q.unit, 0.0)), q.unit, digits)
        grid.add_row(q.name, *([q.symbol] if symbols else []), value, unit, *([q.words] if wide else []))
    return grid


_OF_MESH = {
    "backlash_circumferential", "backlash_normal", "output_play", "sliding_factor", "center_distance", "contact_ratio",
}  # fmt: skip
"""Two values that are not of two gears: limits, ends of the path of contact, or one for each mesh."""


def _per_gear(quantity: Quantity) -> bool:
    """Whether a quantity of a gear pair has a value for each gear."""
    two = isinstance(quantity.value, list) and len(quantity.value) == 2
    return two and quantity.name.rpartition(".")[2] not in _OF_MESH


def _pairs(report: Report, console: Console, digits: int | str | None) -> Iterator[Grid]:
    """The quantities of gear 1 and gear 2 side by side, those of each mesh under its name."""
    meshes: dict[str, list[Quantity]] = {}
    for q in filter(_per_gear, report.quantities):
        meshes.setdefault(q.name.rpartition(".")[0], []).append(q)
    scale = scales(report)
    for mesh, quantities in meshes.items():
        gears = mesh.split("_") if mesh.count("_") == 1 else ["gear 1", "gear 2"]
        heads = (f"{mesh}." if mesh else "per gear", "symbol", *gears, "unit")
        rows = []
        for q in quantities:
            assert isinstance(q.value, list), "as _per_gear says"
            one, other = (_below_each_other(quiet(value, scale.get(q.unit, 0.0)), q.unit, digits) for value in q.value)
            rows.append((q.name.rpartition(".")[2], q.symbol, one, other, "" if q.unit == "1" else q.unit))
        room = max(_LEAST_TEXT, room_for_names(_pair_grid(heads, rows, console), console))
        yield _pair_grid(heads, rows, console, room)


def _pair_grid(
    heads: Sequence[str], rows: Sequence[tuple[str, str, Text, Text, str]], console: Console, room: int | None = None
) -> Grid:
    """Quantities of two gears, the names folded to some columns."""
    grid = grid_for(console)
    for i, head in enumerate(heads):
        grid.add_column(head, justify="right" if i in (2, 3) else "left", overflow="fold", no_wrap=True)
    for row in rows:
        grid.add_row(Text(row[0] if room is None else folded(row[0], room)), *row[1:])
    return grid


def _below_each_other(value: Any, unit: str, digits: int | str | None) -> Text:
    """A number, or the two limits of one."""
    return Text("\n".join(drawn(each, unit, digits) for each in (value if isinstance(value, list) else [value])))


def _findings(checks: Sequence[Check], console: Console) -> Grid:
    """Failures and warnings, each with its fix and notes, failures first."""
    grid = grid_for(console)
    for head in ("check", "code", "status"):
        grid.add_column(head, no_wrap=True)
    grid.add_column("finding", overflow="fold")
    for c in sorted(checks, key=lambda check: check.status != "fail"):
        grid.add_row(c.name, c.code, Text(c.status, style=_STYLE[c.status]), Text(visible_lines(c.lines)))
    return grid


def _passes(checks: Sequence[Check], scale: Mapping[str, float], console: Console) -> Grid:
    """Passed checks, a line per kind: how often, and the value nearest to its limit."""
    grid = grid_for(console)
    for head in ("passed", "code", "value", "limit", "unit"):
        side: JustifyMethod = "right" if head in ("value", "limit") else "left"
        grid.add_column(head, justify=side, overflow="fold", no_wrap=head != "passed")
    groups: dict[tuple[str, str], list[Check]] = {}
    for c in checks:
        groups.setdefault((c.name, c.code), []).append(c)
    for (name, code), group in groups.items():
        nearest = min(group, key=_room)
        times = f" ({len(group)}x)" if len(group) > 1 else ""
        unit = "" if nearest.unit == "1" else nearest.unit
        value = quiet(nearest.value, scale.get(nearest.unit, 0.0))
        if isinstance(value, float) and nearest.limit is not None and abs(value) < _NOTHING * abs(nearest.limit):
            value = 0.0
        grid.add_row(name + times, code, number(value, 5), _bound(nearest), unit)
    return grid


def _bound(check: Check) -> str:
    """The limit of a check that holds, with the side on which it holds; plain where it is what was asked for."""
    limit = number(check.limit, 5)
    return limit if check.value is None or check.limit is None else f"{check.side} {limit}".lstrip()


def _room(check: Check) -> float:
    if check.value is None or check.limit is None:
        return math.inf
    return abs(check.value - check.limit)


def show_table(
    table: Table,
    console: Console,
    most: int = _MOST_ROWS,
    *,
    scale: Mapping[str, float] = _ALONE,
    digits: int | str | None = 6,
    alone: bool = False,
) -> None:
    """Print a table, thinned to so many rows and folded to the width; one of several meshes in parts.

    `scale` has the largest number of each unit in the report around it; `digits` as in `numbers.drawn`.
    `alone`: in a report of tables, whose rows --all and --format csv show.
    """
    if table.columns[:1] == ("mesh",):
        for part in _by_mesh(table):
            show_table(part, console, most, scale=scale, digits=digits, alone=alone)
        return
    if not table.length:
        console.print(Text.assemble("\n", (table.name, "bold"), ": no rows"))
        return
    # Every row of a table that begins with a word says something else; a list that holds one is read whole.
    words = [isinstance(column[0], str) for column in table.data]
    in_words = words[0] or (any(words) and table.length <= 4 * most)
    step = 1 if in_words else max(1, math.ceil(table.length / most))
    if step > 1:
        step = next((s for s in (2, 5, 10, 15, 30) if s >= step), step)
    cells = readable_rows(table, step, scale, digits)
    every = "--all" if alone else f"--table {table.name} --format csv"
    thinned = f", {thinning(step, table)} (all with {every})" if step > 1 else ""
    console.print(Text(f"\n{table.name}{thinned}", style="bold"))
    if step == 1:
        table, cells = with_intervals(table, cells)
    for columns in _folds(table, cells, console.width):
        lines, wrapped = _wrapped(table, cells, columns, console.width)
        grid = grid_for(console)
        for i in columns:
            unit = "" if table.units[i] in ("", "1") else f"\n{table.units[i]}"
            side: JustifyMethod = "left" if i == wrapped else "right"
            head = table.columns[i].replace("_", "\n") + unit
            grid.add_column(head, justify=side, no_wrap=True, vertical="bottom")
        # A column is one cell of many lines: rich takes as long for a cell as for a hundred lines.
        grid.add_row(*(Text("\n".join(visible(row[k]) for row in lines)) for k in range(len(columns))))
        show_grid(grid, console)


def _wrapped(
    table: Table, cells: Sequence[Sequence[str]], columns: Sequence[int], width: int
) -> tuple[list[list[str]], int | None]:
    """The cells of some columns in lines: of texts that are too wide for the width the widest goes on below.

    Returns
        lines, wrapped : the column that goes on below, None where all fit
    """
    need = _needs(table, cells)
    lines = [[row[i] for i in columns] for row in cells]
    texts = [i for i in columns if any(" " in row[i] or "," in row[i] for row in cells)]
    over = sum(need[i] for i in columns) - width
    if over <= 0 or not texts:
        return lines, None
    widest = max(texts, key=lambda i: need[i])
    place, room = columns.index(widest), max(_LEAST_TEXT, need[widest] - _BETWEEN - over)
    found: list[list[str]] = []
    for row in lines:
        first, *more = textwrap.wrap(row[place], room, break_on_hyphens=False) or [""]
        found.append([*row[:place], first, *row[place + 1 :]])
        found += [[*[""] * place, part, *[""] * (len(row) - place - 1)] for part in more]
    return found, widest


def _needs(table: Table, cells: Sequence[Sequence[str]]) -> list[int]:
    """What each column takes."""
    return [
        max(len(part) for part in [*head.split("_"), unit, *(row[i] for row in cells)]) + _BETWEEN
        for i, (head, unit) in enumerate(zip(table.columns, table.units, strict=True))
    ]


def _by_mesh(table: Table) -> Iterator[Table]:
    """The rows of each mesh as a table of its own."""
    meshes = list(table.data[0])
    for mesh in dict.fromkeys(meshes):
        rows = [i for i, each in enumerate(meshes) if each == mesh]
        data = tuple([column[i] for i in rows] for column in table.data[1:])
        yield Table(f"{table.name} of {mesh}", table.columns[1:], table.units[1:], data)


def _folds(table: Table, cells: Sequence[Sequence[str]], width: int) -> list[list[int]]:
    """Groups of columns that fit the width; the columns that name the rows open each group."""
    need = _needs(table, cells)
    first = list(range(_naming(cells, need, width)))
    opening = sum(need[i] for i in first)
    folds: list[list[int]] = [first[:]]
    used = opening
    for i in range(len(first), len(need)):
        if used + need[i] > width and len(folds[-1]) > len(first):
            folds.append(first[:])
            used = opening
        folds[-1].append(i)
        used += need[i]
    return folds


def _naming(cells: Sequence[Sequence[str]], need: Sequence[int], width: int) -> int:
    """How many leading columns tell each row from every other, within half the width; 1 where that takes more."""
    for count in range(1, len(need)):
        if count > 1 and sum(need[:count]) >= width / 2:
            break
        if len({tuple(row[:count]) for row in cells}) == len(cells):
            return count
    return 1
