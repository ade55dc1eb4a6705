"""The sections of a page as HTML: verdict, film, for each command its sheet, results, findings, tables; input."""

from __future__ import annotations

import base64
import hashlib
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from html import escape
from importlib import resources
from typing import TYPE_CHECKING, Any

from gearlink.cli.render.numbers import drawn, number, quiet, readable_rows, scales, thinning, with_intervals
from gearlink.cli.views.page.sheets import as_data
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Check, Report, Table


# The animation of a design inside a page: its positions as data for the player

_FPS, _MOST = 25, 150
"""A page takes no more pictures; faster teeth than these show are no loss beside the numbers."""


def film_data(design: Design, pictures: int = 0, show: str = "", checks: Sequence[Check] = ()) -> dict[str, Any] | None:
    """What the player draws; None where the design has no animation, or cannot make its loop.

    Parameters
        pictures : int - how many; 0 leaves it to the teeth
        show : str - what is drawn on the mechanism besides its links
        checks : findings, of which those that fail are red
    """
    import numpy as np

    from gearlink.cli.views.films.page import player_data
    from gearlink.cli.views.scenes import linkages, shown

    if design.kind not in linkages.moving_kinds():
        return None
    try:
        count = pictures or min(_MOST, linkages.pictures_for(linkages.build(design, np.arange(96) / 96), _FPS))
        scene = shown.build(design, np.arange(count) / count, shown.wishes(show), checks)
    except NoSolution:
        return None
    return player_data(scene, design.spec.name, _FPS)


_MOST_ROWS, _WIDE = 37, 8
"""Rows of a table on the page; of more columns it is printed in small letters."""


def whole_page(title: str, body: Iterable[str], more: str = "") -> str:
    """A page that needs nothing else: sections with style and scripts, and `more` script after them."""
    from gearlink.cli.views.films.page import part

    head = '<meta charset="utf-8"><meta name="viewport" content="width=device-width, initial-scale=1">'
    style = part("player.css") + _file("page.css")
    script = "\n" + "\n".join([part("player.js"), _file("page.js"), more])
    return "\n".join(
        [
            '<!DOCTYPE html>\n<html lang="en"><head>',
            f"{head}{_policy(script)}<title>{escape(title)}</title><style>{style}</style></head>\n<body>",
            *body,
            f"<script>{script}</script>\n</body></html>\n",
        ]
    )


def _policy(script: str) -> str:
    """What a browser lets the page do: run its own script, draw, and ask the place that it came from for news."""
    own = base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()
    rules = (
        "default-src 'none'",
        f"script-src 'sha256-{own}'",
        "style-src 'unsafe-inline'",  # matplotlib's pictures are full of it
        "img-src 'self' data:",
        "connect-src 'self'",
        "base-uri 'none'",
        "form-action 'none'",
    )
    return f'<meta http-equiv="Content-Security-Policy" content="{"; ".join(rules)}">'


def watch_script() -> str:
    """What lets a page take new pieces."""
    return _file("watch.js")


def _file(name: str) -> str:
    return (resources.files("gearlink.cli.views.page") / name).read_text(encoding="utf-8")


def head(spec: Any, reports: Sequence[Report]) -> str:
    """Name, kind, verdict, the key results of each command and the checks that do not pass."""
    kind = f"{escape(spec.kind)}, computed with gearlink {VERSION}"
    return (
        f'<h1>{escape(spec.name)}</h1>\n<p class="kind">{kind}</p>\n{_verdict(reports)}{"".join(_key_results(reports))}'
    )


def anchor(command: str) -> str:
    """The place of a command on the page."""
    return command.replace(" ", "-")


def contents(commands: Sequence[str], *, changed: bool) -> str:
    """Links to the parts of the page."""
    places = [("changes", "changes")] * changed + [("animation", "animation")]
    places += [(anchor(command), command) for command in commands] + [("input", "input")]
    return '<nav class="contents">' + " ".join(f'<a href="#{at}">{escape(name)}</a>' for at, name in places) + "</nav>"


def changes(verdict: str, parts: Iterable[tuple[str, Sequence[Sequence[str]]]]) -> str:
    """What has changed since another design: in words, then inputs, results and checks, with the change in per cent."""
    made = [f'<section id="changes"><h2 class="first">Changes</h2>\n<p>{escape(verdict)}</p>']
    for part, rows in parts:
        heads = (part, "old", "new", "unit", "change", "command")
        made.append(f"<h3>{part}</h3>{table(heads, rows, numeric=(1, 2))}")
    return "\n".join([*made, "</section>"])


def film(design: Design, pictures: int = 0, *, show: str = "", checks: Sequence[Check] = ()) -> str:
    """The animation of a design with what is asked for and what fails on it; empty where it has none."""
    data = film_data(design, pictures, show, checks)
    if data is None:
        return ""
    words = '<section id="animation"><h2 class="first">Animation</h2>'
    return f'{words}\n<div class="film">{as_data(data, "data")}</div></section>'


def given(text: str, spec: Any) -> str:
    """The text of the file, and the keys in force."""
    keys = table(("key", "value"), _keys(spec.model_dump(by_alias=True)), numeric=())
    return (
        f'<section id="input"><h2 class="input">Input</h2>\n<pre>{escape(text.rstrip())}</pre>\n'
        f'<h3>Keys in force, defaults included</h3>\n<div class="keys">{keys}</div></section>'
    )


def results(report: Report) -> str:
    """Quantities, findings and tables of a command."""
    return "\n".join(_results(report))


def _verdict(reports: Sequence[Report]) -> str:
    checks = [check for report in reports for check in report.checks]
    words = []
    for status, word in (("fail", "failed"), ("warn", "warning"), ("pass", "passed")):
        count = sum(check.status == status for check in checks)
        if count:
            many = "s" if status == "warn" and count > 1 else ""
            words.append(f'<span class="{status}">{count} {word}{many}</span>')
    return f"<p>Checks: {', '.join(words) or 'none'}</p>"


def _key_results(reports: Sequence[Report]) -> Iterator[str]:
    """What was required and what was reached, by command, and the findings of checks that do not pass."""
    for report in reports:
        scale = scales(report)
        rows = (
            (
                each.title.replace("_", " "),
                drawn(quiet(each.quantity.value, scale.get(each.quantity.unit, 0.0)), each.quantity.unit),
                "" if each.quantity.unit == "1" else each.quantity.unit,
                "" if each.asked is None else f"{each.how} {number(each.asked, 6)}",
                each.quantity.name,
            )
            for each in report.key
        )
        if report.key:
            heads = (f"key results of {report.command}", "value", "unit", "required", "name")
            yield "\n" + table(heads, rows, numeric=(1,))
    found = [(c.status, f"{c.code} {c.name}", "\n".join(c.lines)) for r in reports for c in r.checks]
    found = sorted((row for row in found if row[0] != "pass"), key=lambda row: row[0])
    if found:
        yield "\n" + table(("status", "check", "finding"), found, numeric=(), marked=True)


def _keys(node: Any, path: str = "") -> Iterator[tuple[str, str]]:
    """Dotted keys and values of a spec, those left out without a default not shown."""
    if isinstance(node, dict):
        for key, value in node.items():
            yield from _keys(value, f"{path}.{key}" if path else str(key))
    elif isinstance(node, list) and node and isinstance(node[0], dict):
        for i, item in enumerate(node):
            yield from _keys(item, f"{path}[{i}]")
    elif node is not None and node != []:
        yield path, _as_written(node)


def _as_written(value: Any) -> str:
    """A value as a design file has it.

    Example
        >>> _as_written(["right", "left"]), _as_written(True), _as_written(20.0)
        ('[right, left]', 'true', '20.0')
    """
    if isinstance(value, list | tuple):
        return f"[{', '.join(map(_as_written, value))}]"
    return str(value).lower() if isinstance(value, bool) else str(value)


def _results(report: Report) -> Iterator[str]:
    if report.quantities:
        scale = scales(report)
        rows = (
            (
                q.name.replace("_", " "),
                q.symbol,
                number(quiet(q.value, scale.get(q.unit, 0.0)), 9),
                "" if q.unit == "1" else q.unit,
                q.words,
                term(q.name).source,
            )
            for q in report.quantities
        )
        yield "<h3>Results</h3>" + table(
            ("quantity", "symbol", "value", "unit", "meaning", "source"), rows, numeric=(2,)
        )
    if report.checks:
        order = ("fail", "warn", "pass")
        found = sorted(report.checks, key=lambda check: order.index(check.status))
        findings = ((c.status, f"{c.code} {c.name}", "\n".join(c.lines)) for c in found)
        yield "<h3>Checks</h3>" + table(("status", "check", "finding"), findings, numeric=(), marked=True)
    for each in report.tables:
        yield _data(each, scales(report))


def _data(given: Table, scale: Mapping[str, float]) -> str:
    count = len(given.data[0])
    in_words = count > 0 and isinstance(given.data[0][0], str)  # every row of such a table says something else
    step = 1 if in_words else max(1, math.ceil(count / _MOST_ROWS))
    step = next((s for s in (1, 2, 5, 10, 20, 30) if s >= step), step)
    cells = readable_rows(given, step, scale)
    if step == 1:
        given, cells = with_intervals(given, cells)
    heads = [
        f"{c.replace('_', ' ')} [{u}]" if u not in ("", "1") else c.replace("_", " ")
        for c, u in zip(given.columns, given.units, strict=True)
    ]
    note = f'<p class="note">{thinning(step, given)}</p>' if step > 1 else ""
    title = escape(given.name.replace("_", " "))
    return f"<h3>{title}</h3>{note}" + table(heads, cells, numeric=range(len(heads)))


def _broken(text: str) -> str:
    """Text of a cell, whose lines stand below each other."""
    return escape(text).replace("\n", "<br>")


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, numeric: Iterable[int], marked: bool = False) -> str:
    """An HTML table that scrolls within itself; with `marked` the first cell of a row is its style."""
    right = set(numeric)

    def cells(tag: str, row: Sequence[str]) -> str:
        return "".join(
            f"<{tag}{' class=n' if i in right else ''}>{_broken(cell)}</{tag}>" for i, cell in enumerate(row)
        )

    lines = [f"<tr{f' class={row[0]}' if marked else ''}>{cells('td', row)}</tr>" for row in rows]
    body, many = "\n".join(lines), " class=many" if len(heads) > _WIDE else ""
    head = f"<thead><tr>{cells('th', heads)}</tr></thead>"
    return f'<div class="scroll"><table{many}>{head}<tbody>\n{body}</tbody></table></div>'
