"""Sheets inside a page: SVG whose text stays text, with the numbers of its curves for the cursor."""

from __future__ import annotations

import io
import json
import re
from collections.abc import Callable, Sequence
from html import escape
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures import write
from gearlink.cli.views.figures.drawing import placing

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from gearlink.core.base.design import Design
    from gearlink.core.base.report import Check

_LEAST, _MOST = 25, 361
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


def as_script(value: Any) -> str:
    """Plain data as a script reads it, without what could end that."""
    text = json.dumps(value, ensure_ascii=False, separators=(",", ":"), allow_nan=False)
    return text.replace("<", "\\u003c").replace("\u2028", "\\u2028").replace("\u2029", "\\u2029")


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
        found.append({**shown, **names, **_times(axes), "curves": curves})
    return found


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
    step = max(1, -(-len(x) // _MOST))
    x, y = np.append(x[::step], x[-1:]), np.append(y[::step], y[-1:])
    label = str(line.get_label())
    own = "" if label.startswith("_") else label.split(",")[0]
    values = [float(f"{value:.6g}") if np.isfinite(value) else None for value in y.tolist()]
    words = own or re.sub(r"\s*\[.*", "", str(axes.get_ylabel())).replace("-\n", "").replace("/\n", "/").replace(
        "\n", " "
    )
    return {"label": words, "color": str(line.get_color()), "x": [float(f"{v:.6g}") for v in x.tolist()], "y": values}


def _over(axes: Axes, panels: Sequence[Axes]) -> str:
    """The words of the x axis, of a panel above others those of the lowest below it."""
    if axes.get_xlabel():
        return str(axes.get_xlabel())
    below = [
        other
        for other in panels
        if other.get_xlabel()
        and other.get_xlim() == axes.get_xlim()
        and other.get_position().y0 < axes.get_position().y0
    ]
    return str(below[0].get_xlabel()) if below else "x"


def _unit(label: str) -> str:
    found = re.search(r"\[([^\]]*)\]", label)
    return "" if found is None or found[1] == "1" else found[1].replace("deg", "°")
