"""What the sheets of the gear-linkages share: their layout, numbers beside the drawing, charts over a motion table."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, style, time_axes
from gearlink.cli.views.scenes.linkages import builder, moves

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.mechanism.motion import Motion

    Panel = Callable[[Axes, Any], None]
    Marks = Callable[..., None]

DWELL: Any = {"facecolor": "#CFE8F7", "linewidth": 0, "zorder": 0}
BACKWARD: Any = {"facecolor": "none", "edgecolor": "#F3B562", "hatch": "///", "linewidth": 0, "zorder": 0.5}
"""A dwell is tinted and a back-step hatched, so that both are seen where they overlap."""
TURN = 360.0
_FOUR_BAR = "crank AB", "coupler BC", "rocker CD", "frame AD"
FOUR_BAR = {f"{words.partition(' ')[0]}_length": words for words in _FOUR_BAR}
"""Links of a four-bar in short words."""
_MOST_LINES = 12
_ACROSS = 40.0
"""Letters that a row of numbers has room for."""
_APART, _LEGEND = 0.062, 0.048
"""Shares of the panel's height, which is much the same on every sheet: rows of numbers, where there is room for them,
and an entry of the legend above them."""


def sheet(
    title: str, design: Any, mechanism: Panel, words: Mapping[str, str], charts: Sequence[Panel], columns: int = 2
) -> Figure:
    """The mechanism and its numbers over the charts; a last one alone in its row is as wide as the page."""
    rows = math.ceil(len(charts) / columns)
    figure = panels.page(title, min(0.42 + 0.19 * rows, 1.0))
    halves = figure.add_gridspec(2 if charts else 1, 1, height_ratios=[2.0, rows] if charts else None)
    head = halves[0].subgridspec(1, 2, width_ratios=[1.75, 1.0])
    drawing = figure.add_subplot(head[0])
    style.drawing(drawing)
    mechanism(drawing, design)
    if (scene := scene_of(design)) is not None:
        failing.bodies(drawing, design, scene, getattr(design, "period_turns", None) or 1)
    drawing.margins(0.05)
    drawing.autoscale_view()
    numbers(figure.add_subplot(head[1]), drawing, design, words)
    grid: Any = halves[1].subgridspec(rows, columns) if charts else None
    for i, chart in enumerate(charts):
        last_alone = i == len(charts) - 1 and i % columns == 0
        axes = figure.add_subplot(grid[i // columns, :] if last_alone else grid[i // columns, i % columns])
        chart(axes, design)
        time_axes.over_input(axes, time_axes.turn_time(design))
    return figure


def scene_of(design: Any) -> Any:
    """The builder of a design's scene; None where the kind has none, or draws what clashes itself."""
    return builder(design.kind) if moves(design.kind) and design.kind != "three-gear-four-bar" else None


def numbers(axes: Axes, drawing: Axes, design: Any, words: Mapping[str, str]) -> None:
    """The legend of a drawing, and under it quantities by short words; those that the design has not are left out."""
    panels.legend_beside(axes, drawing)
    entries = len(drawing.get_legend_handles_labels()[1])
    found = [(short, design.quantity(name)) for name, short in words.items()]
    shown = [(short, f"{_text(q.value, q.unit)} {q.unit}".removesuffix(" 1")) for short, q in found if q is not None]
    apart = min(_APART, (1.0 - _LEGEND * (entries + 1)) / max(len(shown), 1))
    look: dict[str, Any] = {"transform": axes.transAxes, "va": "bottom", "fontsize": 8, "in_layout": False}
    for i, (short, value) in enumerate(reversed(shown)):
        look["fontsize"] = 8.0 * min(1.0, _ACROSS / (len(short) + len(value)))
        axes.text(0.0, apart * i, short, **look)
        axes.text(1.0, apart * i, value, ha="right", **look)


def _text(value: object, unit: str) -> str:
    if isinstance(value, list):
        return ", ".join(_text(item, unit) for item in value) or "none"
    if isinstance(value, float):
        return style.number(value, scale=0.0 if unit == "mm" else 1.0)
    return str(value).replace("-", "−") if isinstance(value, int) else str(value)


def chart(axes: Axes, title: str, ylabel: str, xlabel: str = "crank angle [deg]", turn: bool = True) -> None:
    """An empty chart over the crank angle."""
    panels.curves(axes, xlabel, ylabel, title)
    if turn:
        style.full_turn(axes)


def over_turn(design: Any, name: str, gain: float = 0.0) -> tuple[Any, Any]:
    """A column of the motion table over the crank angle, closed at 360 deg by its first value and what a turn adds."""
    table = design.table("motion")
    return closed(table["crank_angle"], TURN), closed(table[name], gain)


def output(axes: Axes, design: Any, mark: Marks, **look: Any) -> None:
    """The angle of the output over the crank angle, and what it would be without nonuniformity."""
    chart(axes, "Output angle", "output angle [deg]")
    mark(axes, design, label=True)
    gained = TURN * design.mean_ratio
    axes.plot(*over_turn(design, "output_angle", gained), color=style.BLUE, linewidth=1.6, **look)
    mean: dict[str, Any] = {"color": style.GREY, "linewidth": 0.9, "linestyle": style.DOTTED}
    axes.plot([0.0, TURN], [0.0, gained], **mean, label="mean")
    panels.legend_above(axes, 2)


def rate(
    axes: Axes,
    design: Any,
    title: str,
    ylabel: str,
    name: str,
    order: int,
    *,
    mark: Marks,
    color: str = style.BLUE,
    zero: str = style.GREY,
    gid: str = "",
) -> None:
    """A speed or an acceleration of the motion table over the crank angle, in time where the speed is known."""
    chart(axes, title, ylabel)
    mark(axes, design)
    axes.axhline(0.0, color=zero, linewidth=0.8)
    axes.plot(*over_turn(design, name), color=color, linewidth=1.6, gid=gid or None)
    time_axes.in_time(axes, design.angular_speed, order, "rad")


def closed(values: Any, gain: float = 0.0) -> Any:
    """A column with its first value, and what a revolution adds, put at the end."""
    data = np.asarray(values, dtype=float)
    return np.append(data, data[0] + gain)


def transmission(
    axes: Axes,
    design: Any,
    degrees: Any = None,
    xlabel: str = "crank angle [deg]",
    turn: bool = True,
    motion: Motion | None = None,
) -> None:
    """Transmission angle over the input with its limit; red below it.

    Parameters
        degrees : (N,) array [deg] - inputs; None: all
        motion : of which it is; None: of the design
    """
    motion, limit = motion or design.moving, design.spec.limits.transmission_angle
    assert motion.transmission is not None, "asked for only where there is one"
    start, end = math.degrees(motion.input.start), math.degrees(motion.input.end)
    x = np.linspace(start, end, 721) if degrees is None else degrees
    y = np.degrees(motion.transmission.rates(motion, np.radians(x), 0)[0])
    chart(axes, "Transmission angle", "transmission\nangle [deg]", xlabel, turn=turn)
    axes.plot(x, y, color=style.GREEN, linewidth=1.6, gid="transmission-angle")
    axes.axhline(limit, color=style.RED, linewidth=1.1, linestyle=style.DASHED, label=f"limit {limit:g}°")
    failing.past(axes, x, y, y < limit, "below the limit")
    axes.set_ylim(0.0, 92.0)
    axes.set_yticks(range(0, 91, 30))
    panels.legend_above(axes, 2)


def shade(axes: Axes, look: Any, start: float, width: float, label: str | None = None) -> None:
    """A stretch of the turn [deg], as a DWELL or as BACKWARD."""
    for left, right in panels.Phase("dwell", start, start + width).within_turn():
        axes.axvspan(left, right, label=label, **look)
        label = None


def standstills(axes: Axes, places: Sequence[float], label: str | None = None) -> None:
    """Lines at crank angles [rad]; of many a mark each at the foot of the panel, for lines would hide the curves."""
    if len(places) > _MOST_LINES:
        rug: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "clip_on": False, "linestyle": "none"}
        at = [math.degrees(place) for place in places]
        axes.plot(at, [0.0] * len(at), "|", color=style.GREY, markersize=7.0, label=label, gid="standstills", **rug)
        return
    for place in places:
        look: dict[str, Any] = {"color": style.GREY, "linewidth": 0.8, "linestyle": style.DASHED, "zorder": 1}
        axes.axvline(math.degrees(place), label=label, **look)
        label = None
