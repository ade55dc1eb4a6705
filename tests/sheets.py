"""Sheets in tests: a design with its figure, drawn once for all tests, and what is read from a figure.

What a panel shows stands in its artists before the panels are placed, and placing them takes ten times as long: a
`sheet` is not placed, a `placed_sheet` is, as a file of it would be.
"""

from __future__ import annotations

import json
from collections.abc import Iterable, Mapping
from functools import lru_cache
from typing import Any, NamedTuple

import numpy as np
from factory import changed, design, worked
from sweeps import mostly_slow

from gearlink.cli.views.figures.write import draw, panels

_kept = lru_cache(maxsize=16)
"""What neighbouring tests draw. A figure with its panels placed takes some 10 MB, and the program itself keeps none;
with 128 of them a process of the slow tests grew to 7 GB, to draw one sheet of a hundred less."""


class Sheet(NamedTuple):
    """A design and the figure of one of its commands."""

    design: Any
    figure: Any


def sheet(given: str | Mapping[str, Any], command: str = "analyze", /, **keys: Any) -> Sheet:
    """The sheet of a command on the data of a design file, or on an example, with changes as in the factory."""
    return _drawn(_as_key(given, keys), command)


def placed_sheet(given: str | Mapping[str, Any], command: str = "analyze", /, **keys: Any) -> Sheet:
    """The same, with its panels placed: everything is drawn but the pixels."""
    return _placed(_as_key(given, keys), command)


def odd_sheets(cases: Iterable[Any], quick: int = 3) -> list[Any]:
    """Cases of designs that must draw, each with what draws it: the first few as a sheet in `make test`, all placed in
    `make check-full`."""
    rows = [case if isinstance(case, tuple) else (case,) for case in cases]
    return mostly_slow([*((*row, sheet) for row in rows[:quick]), *((*row, placed_sheet) for row in rows)], quick)


def _as_key(given: str | Mapping[str, Any], keys: dict[str, Any]) -> str:
    return json.dumps(changed(worked(given) if isinstance(given, str) else given, **keys))


@_kept
def _made(data: str, command: str) -> Any:
    return design(json.loads(data), command=command)


@_kept
def _drawn(data: str, command: str) -> Sheet:
    made = _made(data, command)
    return Sheet(made, panels(command, made))


@_kept
def _placed(data: str, command: str) -> Sheet:
    made = _made(data, command)
    return Sheet(made, draw(command, made))


def scaled(data: Any, factor: float, lengths: set[str], key: str = "") -> Any:
    """The data of the same machine, larger or smaller; its forces and inertia are left as they are."""
    if isinstance(data, dict):
        kept = {"inertia", "spring"}
        return {name: value if name in kept else scaled(value, factor, lengths, name) for name, value in data.items()}
    if isinstance(data, list) and key in lengths:
        return [value * factor for value in data]
    return data * factor if key in lengths else data


def panel(figure: Any, title: str) -> Any:
    """The axes whose heading begins so."""
    return next(axes for axes in figure.axes if axes.get_title(loc="left").startswith(title))


def panel_named(figure: Any, ylabel: str) -> Any:
    """The axes whose label of the y axis begins so."""
    return next(axes for axes in figure.axes if axes.get_ylabel().replace("\n", " ").startswith(ylabel))


def lines(axes: Any) -> dict[str, Any]:
    """Lines by the words of their legend."""
    return {line.get_label(): line for line in axes.get_lines() if not line.get_label().startswith("_")}


def named(axes: Any) -> dict[str, Any]:
    """Lines and bodies by the words of their legend."""
    return {patch.get_label(): patch for patch in axes.patches if not patch.get_label().startswith("_")} | lines(axes)


def tagged(figure: Any, gid: str) -> list[Any]:
    """Lines and patches that carry a name for programs."""
    return [each for axes in figure.axes for each in (*axes.lines, *axes.patches) if each.get_gid() == gid]


def curve(figure: Any, gid: str) -> Any:
    """x and y of the one line that carries a name for programs."""
    (line,) = tagged(figure, gid)
    return np.asarray(line.get_xdata()), np.asarray(line.get_ydata())


def points(drawn: Any) -> Any:
    """The points of a line or of an outline as complex numbers."""
    xy = drawn.get_xy() if hasattr(drawn, "get_xy") else drawn.get_xydata()
    return np.asarray(xy) @ np.array([1.0, 1j])


def words(figure: Any) -> list[str]:
    """All texts inside the axes."""
    return [text.get_text() for axes in figure.axes for text in axes.texts]


def labels(axes: Any) -> list[str]:
    """The words of a legend."""
    return [text.get_text() for text in axes.get_legend().get_texts()]


def fits_a_page(figure: Any) -> bool:
    """Whether a figure is on A4 or A3, upright or lying: printers take it to scale."""
    short, long = sorted(figure.get_size_inches() * 25.4)
    return any(short < width + 0.2 and long < height + 0.2 for width, height in ((210.0, 297.0), (297.0, 420.2)))


def meetings(figure: Any) -> list[str]:
    """Words of a placed figure that lie on other words, on a mark of their panel, or beside the page."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    renderer = FigureCanvasAgg(figure).get_renderer()
    figure.draw_without_rendering()
    texts = _read(figure)
    boxes = np.array([_box(text, renderer) for text in texts]).reshape(-1, 4)
    found = [
        f"{texts[i].get_text()!r} on {texts[k].get_text()!r}"
        for i in range(len(texts))
        for k in np.flatnonzero(_meet(boxes[i], boxes[:i], 1.5))
    ]
    beside = (boxes[:, 0] < -0.5) | (boxes[:, 2] > figure.bbox.x1 + 0.5)
    found += [f"{texts[i].get_text()!r} beside the page" for i in np.flatnonzero(beside)]
    for axes in figure.axes:
        if (marks := [box for line in axes.lines for box in _marks(line, axes)]) and axes.texts:
            own = set(axes.texts)
            met = [text for text, box in zip(texts, boxes, strict=True)
                   if text in own and _meet(box, np.array(marks), 2.5).any()]  # fmt: skip
            found += [f"{text.get_text()!r} on a mark" for text in met]
    return found


def _meet(box: Any, others: Any, least: float) -> Any:
    """Which boxes a box overlaps by more than so many pixels both ways."""
    across = np.minimum(box[2], others[:, 2]) - np.maximum(box[0], others[:, 0])
    up = np.minimum(box[3], others[:, 3]) - np.maximum(box[1], others[:, 1])
    return (across > least) & (up > least)


def _read(figure: Any) -> list[Any]:
    """All words that can be read, but those that are slanted, which do not fill their boxes."""
    from matplotlib.axis import Axis
    from matplotlib.text import Text

    found, numbers = [], set()
    for axis in figure.findobj(Axis):
        low, high = sorted(axis.get_view_interval())
        ticks = [*axis.get_major_ticks(), *axis.get_minor_ticks()]
        own = {label for tick in ticks for label in (tick.label1, tick.label2)}
        numbers |= own - {
            label
            for tick in ticks
            if axis.axes.axison and axis.get_visible() and low - 1e-9 <= tick.get_loc() <= high + 1e-9
            for label in (tick.label1, tick.label2)
        }
        if not axis.axes.axison:
            numbers |= {axis.label, axis.get_offset_text()}
    for text in figure.findobj(Text):
        if text not in numbers and text.get_visible() and text.get_text().strip() and text.get_rotation() % 90.0 == 0.0:
            found.append(text)
    return found


def _box(text: Any, renderer: Any) -> Any:
    """The box of the letters: that of matplotlib has room for ascenders and descenders of a line, whatever it says."""
    left, low, right, high = text.get_window_extent(renderer).extents
    words = text.get_text()
    low += (high - low) * (len(words) - len(words.rstrip("\n"))) / (1 + words.count("\n"))  # a title's empty rows
    room = 0.12 * (high - low)
    return left, low + room, right, high - room


def _marks(line: Any, axes: Any) -> list[Any]:
    """Boxes of the marks of a line in its panel, half as large as their size says."""
    if line.get_marker() in (None, "", " ", "None", "none", "|", "+") or line.get_markersize() < 3.0:
        return []
    xy = line.get_transform().transform(np.column_stack(line.get_data(orig=False)).astype(float))
    half = 0.5 * min(line.get_markersize(), 6.0) * axes.figure.dpi / 72.0
    low, high = axes.bbox.extents[:2], axes.bbox.extents[2:]
    inside = np.isfinite(xy).all(axis=1) & (xy >= low).all(axis=1) & (xy <= high).all(axis=1)
    return [np.concatenate([p - half, p + half]) for p in xy[inside]]
