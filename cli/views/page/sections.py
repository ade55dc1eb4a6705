"""The sections of a page as HTML: verdict, film, for each command its sheet, results, findings, tables; input."""

from __future__ import annotations

import base64
import hashlib
import io
import math
import re
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from html import escape
from importlib import resources
from typing import TYPE_CHECKING, Any

from gearlink.cli.render.numbers import drawn, number, quiet, readable_rows, scales, thinning, with_intervals
from gearlink.cli.views.figures import write
from gearlink.cli.views.figures.drawing import placing
from gearlink.cli.views.films.page import as_script
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

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
    head = f"{head}{_policy(script)}<title>{escape(title)}</title><style>{style}</style></head>\n<body>"
    end = f"<script>{script}</script>\n</body></html>\n"
    return "\n".join(['<!DOCTYPE html>\n<html lang="en"><head>', head, *body, end])


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
    verdict = f"{_verdict(reports)}{''.join(_key_results(reports))}"
    return f'<h1>{escape(spec.name)}</h1>\n<p class="kind">{kind}</p>\n{verdict}'


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
            yield f'\n<div class="results">{table(heads, rows, numeric=(1,))}</div>'
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


def results(report: Report) -> str:
    """Quantities, findings and tables of a command."""
    made, scale = [], scales(report)
    if report.quantities:
        rows = (
            (
                q.name.replace("_", " "),
                q.symbol,
                _below_each_other(quiet(q.value, scale.get(q.unit, 0.0))),
                "" if q.unit == "1" else q.unit,
                q.words,
                term(q.name, report.kind).source,
            )
            for q in report.quantities
        )
        heads = ("quantity", "symbol", "value", "unit", "meaning", "source")
        made.append("<h3>Results</h3>" + table(heads, rows, numeric=(2,)))
    if report.checks:
        order = ("fail", "warn", "pass")
        found = sorted(report.checks, key=lambda check: order.index(check.status))
        findings = ((c.status, f"{c.code} {c.name}", "\n".join(c.lines)) for c in found)
        made.append("<h3>Checks</h3>" + table(("status", "check", "finding"), findings, numeric=(), marked=True))
    return "\n".join([*made, *(_data(each, scale) for each in report.tables)])


def _below_each_other(value: Any) -> str:
    """Limits of several gears on lines of their own, many numbers in threes: in one line they leave the words beside
    them no room."""
    several = isinstance(value, list) and value != [] and all(isinstance(each, list) for each in value)
    if isinstance(value, list) and len(value) > _IN_A_LINE and all(isinstance(each, float) for each in value):
        value, several = [value[i : i + _IN_A_LINE] for i in range(0, len(value), _IN_A_LINE)], True
    return "\n".join(number(each, 9) for each in value) if several else number(value, 9)


_IN_A_LINE = 3


def shown_rows(given: Table) -> int:
    """Every how many rows of a table a report shows; of words all, for every row says something else."""
    count = len(given.data[0])
    step = 1 if count > 0 and isinstance(given.data[0][0], str) else max(1, math.ceil(count / _MOST_ROWS))
    return next((each for each in (1, 2, 5, 10, 20, 30) if each >= step), step)


def headings(given: Table) -> list[str]:
    """The columns of a table in words, with their units."""
    return [
        f"{name.replace('_', ' ')} [{unit}]" if unit not in ("", "1") else name.replace("_", " ")
        for name, unit in zip(given.columns, given.units, strict=True)
    ]


def _data(given: Table, scale: Mapping[str, float]) -> str:
    step = shown_rows(given)
    cells = readable_rows(given, step, scale)
    if step == 1:
        given, cells = with_intervals(given, cells)
    heads = headings(given)
    note = f'<p class="note">{thinning(step, given)}</p>' if step > 1 else ""
    title = escape(given.name.replace("_", " "))
    return f"<h3>{title}</h3>{note}" + table(heads, cells, numeric=range(len(heads)))


def table(heads: Sequence[str], rows: Iterable[Sequence[str]], *, numeric: Iterable[int], marked: bool = False) -> str:
    """An HTML table that scrolls within itself; with `marked` the first cell of a row is its style."""
    right = set(numeric)

    def cells(tag: str, row: Sequence[str]) -> str:
        told = [(cell, " class=n" if i in right and not _SENTENCE.search(cell) else "") for i, cell in enumerate(row)]
        return "".join(f"<{tag}{look}>{escape(cell)}</{tag}>".replace("\n", "<br>") for cell, look in told)

    lines = [f"<tr{f' class={row[0]}' if marked else ''}>{cells('td', row)}</tr>" for row in rows]
    body, many = "\n".join(lines), " class=many" if len(heads) > _WIDE else ""
    head = f"<thead><tr>{cells('th', heads)}</tr></thead>"
    return f'<div class="scroll"><table{many}>{head}<tbody>\n{body}</tbody></table></div>'


_SENTENCE = re.compile(r"[a-z]{2,}[^a-z]+[a-z]{2,}.{12}")
"""Words in a column of numbers that need several lines."""
_LEAST, _MOST_POINTS = 25, 361
"""A line of fewer points is no curve; a curve is given by at most so many."""
_HEAD = re.compile(r"^.*?(?=<svg )", re.DOTALL)
_SIZE = re.compile(r'<svg ([^>]*?)width="([\d.]+)pt"|height="([\d.]+)pt" ')


def sheet(command: str, design: Design, checks: Sequence[Check] = ()) -> str:
    """The sheet of a command as SVG in an HTML figure, and as JSON what a cursor reads there.

    Raises
        NoSolution - where the sheet shows something that the design does not have
    """
    return _as_html(command, design.spec.name, lambda: write.draw(command, design, checks))[0]


class Remembered:
    """Sheets of a page that is made again and again. Placing the panels takes half the time of a sheet, and they seldom
    move: so each is drawn at once where its panels stood the time before, and again where they have moved."""

    def __init__(self) -> None:
        self._places: dict[str, placing.Places] = {}

    @property
    def known(self) -> frozenset[str]:
        """The commands whose sheets were drawn before."""
        return frozenset(self._places)

    def at_once(self, command: str, design: Design, checks: Sequence[Check]) -> str:
        """The sheet with its panels where they were, placed if there was none before."""
        known = self._places.get(command)
        html, made = _as_html(command, design.spec.name, lambda: write.draw(command, design, checks, known))
        self._places[command] = placing.places(made)
        return html

    def moved(self, command: str, design: Design, checks: Sequence[Check]) -> str:
        """The sheet with its panels placed anew; empty where they stand as they do."""
        with write.fonts_of(design.spec.name):
            now = placing.places(write.draw(command, design, checks))
        if now == self._places.get(command):
            return ""
        self._places[command] = now
        return self.at_once(command, design, checks)


def _as_html(command: str, name: str, draw: Callable[[], Figure]) -> tuple[str, Figure]:
    """A sheet inside a page, and its figure."""
    drawn: list[Figure] = []

    def make() -> Figure:
        """Drawn where the fonts of the name are set, and kept for its curves."""
        drawn.append(draw())
        return drawn[0]

    stream = io.BytesIO()
    write.save(make, name, stream, "svg")
    svg = _HEAD.sub("", stream.getvalue().decode(), count=1)
    words = escape(f"{command} of {name}", quote=True)
    svg = svg.replace("<svg ", f'<svg role="img" aria-label="{words}" ', 1)
    named = getattr(drawn[0], "names_of_rows", {})  # designs of a study, which name themselves under the pointer
    data = as_data(charts(drawn[0]), "charts") + (as_data(named, "names") if named else "")
    html = f'<div class="sheet"><div class="wide">{svg}</div>{data}</div>'
    return html, drawn[0]


def as_data(value: Any, name: str) -> str:
    """Plain data for a script of the page, which no text in it can end."""
    return f'<script type="application/json" class="{name}">{as_script(value)}</script>'


def charts(made: Figure) -> list[dict[str, Any]]:
    """Panels with curves: box in the units of the SVG, ranges, curves, and over what they are, which cursors share."""
    height = 72.0 * made.get_figheight()
    width = 72.0 * made.get_figwidth()
    panels = [axes for axes in made.axes if axes.get_aspect() == "auto"]
    found = []
    for axes in panels:
        curves = [_curve(axes, line) for line in axes.get_lines() if _is_curve(line)]
        if not curves or axes.get_xscale() != "linear" or not axes.axison:
            continue
        box = axes.get_position()
        sides = [width * box.x0, height * (1.0 - box.y1), width * box.x1, height * (1.0 - box.y0)]
        low, high = axes.get_ylim()
        x_range = [float(value) for value in axes.get_xlim()]
        shown = {"box": [round(side, 2) for side in sides], "x": x_range, "y": [float(low), float(high)]}
        names = {"over": _over(axes, panels), "log": axes.get_yscale() == "log", "unit": _unit(axes.get_ylabel())}
        found.append({**shown, **names, **_times(axes), "curves": [] if _has_rows(axes) else curves})
    return found


def _has_rows(axes: Axes) -> bool:
    """Whether the y axis names rows, in which curves are drawn to no scale."""
    return any(re.search(r"[a-z]{2}", label.get_text()) for label in axes.get_yticklabels())


def _times(axes: Axes) -> dict[str, Any]:
    """Both ends of the x axis in ms, where it is in time as well and runs evenly."""
    from gearlink.cli.views.figures.drawing.time_axes import ROW

    rows: list[Any] = [child for child in axes.child_axes if child.get_gid() == ROW]
    return {"ms": [float(end) for end in rows[0].get_xlim()]} if rows else {}


def _is_curve(line: Line2D) -> bool:
    import numpy as np

    x = np.asarray(line.get_xdata(), dtype=float)
    return len(x) >= _LEAST and bool((np.diff(x) >= 0.0).all()) and line.get_linestyle() not in ("None", "", " ")


def _curve(axes: Axes, line: Line2D) -> dict[str, Any]:
    import numpy as np

    x, y = (np.asarray(data, dtype=float) for data in line.get_data())
    step = max(1, -(-len(x) // _MOST_POINTS))
    x, y = np.append(x[::step], x[-1:]), np.append(y[::step], y[-1:])
    label = str(line.get_label())
    words = "" if label.startswith("_") else label.split(",")[0]
    if not words:
        axis = re.sub(r"\s*\[.*", "", str(axes.get_ylabel()))
        words = axis.replace("-\n", "").replace("/\n", "/").replace("\n", " ")
    values = [float(f"{value:.6g}") if np.isfinite(value) else None for value in y.tolist()]
    return {"label": words, "color": str(line.get_color()), "x": [float(f"{v:.6g}") for v in x.tolist()], "y": values}


def _over(axes: Axes, panels: Sequence[Axes]) -> str:
    """The words of the x axis, of a panel above others those of the lowest below it."""
    if axes.get_xlabel():
        return str(axes.get_xlabel())
    alike = (other for other in panels if other.get_xlabel() and other.get_xlim() == axes.get_xlim())
    below = (str(other.get_xlabel()) for other in alike if other.get_position().y0 < axes.get_position().y0)
    return next(below, "x")


def _unit(label: str) -> str:
    found = re.search(r"\[([^\]]*)\]", label)
    return "" if found is None or found[1] == "1" else found[1].replace("deg", "°")
