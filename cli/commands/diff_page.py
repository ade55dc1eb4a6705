"""What `gearlink diff` found, as tables on the terminal, JSON or Markdown."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.cli.commands.difference import Change, Difference, same
from gearlink.cli.options import Format, Options
from gearlink.cli.printable import json_text, visible
from gearlink.cli.render.json_report import FORMAT
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from rich.console import Console
    from rich.table import Table as Grid

_PARTS = {"inputs": "input", "quantities": "quantity", "checks": "check", "tables": "table"}
_NO_MEMBERS = "[]"
_PERCENT = len("+1.23e-05 %")
_NAME = 16
_WORD = 18  # columns of the longest words of values, where a table is wider than the terminal
_HEADS = ("old", "new", "unit", "change", "command")


def show_difference(found: Difference, options: Options) -> None:
    """Print the difference."""
    if options.format is Format.JSON:
        print(json_text(_plain(found)))
    elif options.format is Format.MARKDOWN:
        print(_as_markdown(found))
    else:
        _show(found, options)


def _plain(found: Difference) -> dict[str, Any]:
    head = {"gearlink": FORMAT, "command": "diff", "old": found.old, "new": found.new}
    head |= {"tolerance": found.tolerance, "equal": found.equal}
    return head | {part: [_record(change) for change in getattr(found, part)] for part in _PARTS}


def _record(change: Change) -> dict[str, Any]:
    return {
        "name": change.name,
        "command": change.command,
        "old": _plain_value(change.old),
        "new": _plain_value(change.new),
        "unit": change.unit,
        "relative": change.relative,
        "detail": change.detail,
    }


def _plain_value(value: Any) -> Any:
    """A value as JSON knows it; what is not finite, which only a result of other programs holds, as a word."""
    if isinstance(value, list):
        return [_plain_value(item) for item in value]
    return str(value) if isinstance(value, float) and not math.isfinite(value) else value


def _parts(found: Difference, text: Callable[[object], str]) -> Iterator[tuple[str, list[Sequence[str]]]]:
    """Each part that changed, as rows of text: name, old, new, unit, change, command."""
    for part in _PARTS:
        changes: list[Change] = getattr(found, part)
        rows: list[Sequence[str]] = []
        for c in changes:
            percent = "" if c.relative is None else f"{100.0 * c.relative:+.3g} %"
            told = "; ".join(words for words in (percent, c.detail) if words)
            unit = "" if c.unit == "1" else c.unit
            # A check may be here for its limit alone: values that count as equal look equal, some ulp of zero too.
            old = c.new if part == "checks" and same(c.old, c.new, found.tolerance) else c.old
            values = (_NO_MEMBERS if value == [] else text(value) for value in (old, c.new))
            rows.append((c.name, *values, unit, told, c.command))
        if rows:
            yield part, rows


def _verdict(found: Difference) -> str:
    old, new = visible(found.old), visible(found.new)
    if found.equal:
        return f"{old} and {new} are equal (tolerance {found.tolerance:g})"
    counts = ", ".join(amount(n, one, part) for part, one in _PARTS.items() if (n := len(getattr(found, part))))
    return f"changed from {old} to {new}: {counts}"


def _as_markdown(found: Difference) -> str:
    from gearlink.cli.render.markdown_report import inline, markdown_table, text_of

    sections = [f"## {part}\n\n" + markdown_table((part, *_HEADS), rows) for part, rows in _parts(found, text_of)]
    return "\n\n".join([*sections, inline(_verdict(found))])


def _show(found: Difference, options: Options) -> None:
    from gearlink.cli.render.numbers import number
    from gearlink.cli.render.terminal import console_for, room_for_names, show_grid

    console = console_for(options)
    for part, told in _parts(found, partial(number, digits=9)):
        rows = [tuple(map(visible, row)) for row in told]
        grid = _grid(part, rows, console)
        if room_for_names(grid, console) >= max(len(row[0]) for row in rows):
            show_grid(grid, console)
            console.print()
            continue
        # Names and words on several lines, and the command above its rows.
        commands = list(dict.fromkeys(row[-1] for row in rows))
        for command in commands:
            own = [(row[0], *(_broken(text) for text in row[1:3]), *row[3:]) for row in rows if row[-1] == command]
            head = part if len(commands) == 1 else f"{part} of {command}"
            room = max(_NAME, room_for_names(_grid(head, own, console), console))
            show_grid(_grid(head, own, console, room), console)
            console.print()
    print(_verdict(found))


def _broken(text: str) -> str:
    """Words of a value, those that are long broken within."""
    from gearlink.cli.render.terminal import folded

    return " ".join(folded(word, _WORD) for word in text.split())


def _grid(head: str, rows: Sequence[Sequence[str]], console: Console, room: int | None = None) -> Grid:
    """A table of changes, its names folded to some columns."""
    from rich.text import Text

    from gearlink.cli.render.terminal import folded, grid_for

    grid, heads = grid_for(console), (head, *_HEADS)
    # A column that says nothing takes room from the numbers.
    shown = [i for i in range(len(heads)) if heads[i] in (head, "old", "new") or any(row[i] for row in rows)]
    if len({row[-1] for row in rows}) == 1:
        shown = [i for i in shown if heads[i] != "command"]
    for i in shown:
        # Words and members of a list may stand on lines of their own, a number and its per cent sign not.
        whole = heads[i] in (head, "unit") or (heads[i] == "change" and all(len(row[i]) <= _PERCENT for row in rows))
        grid.add_column(
            heads[i], justify="right" if heads[i] in ("old", "new") else "left", no_wrap=whole, overflow="fold"
        )
    for name, *others in ([row[i] for i in shown] for row in rows):
        grid.add_row(Text(name if room is None else folded(name, room)), *map(Text, others))
    return grid
