"""The design charts as figures: curves, their parameters at their ends, a design marked."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING, Any

from gearlink.cli.files import safe_stem, write_atomically
from gearlink.cli.options import Options
from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.figures.drawing.placing import settled
from gearlink.cli.views.figures.write import save

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.figures.chart_list import Axis, DesignChart, Marked
    from gearlink.core.base.report import Table

_COLORS = (style.BLUE, style.RED, style.GREEN, style.ORANGE, style.PURPLE, style.SKY, style.BLACK)
_BESIDE_A_POINT = 25
"""Places between two rows beside the greatest of a pointed curve."""
_DASHES: tuple[Any, ...] = ("-", (0, (6, 2)), (0, (6, 2, 1.5, 2)))
"""Neighbours differ in their lines as well, for grey print; each of 21 curves has its own look."""


def draw(chart: DesignChart, table: Table, curves: tuple[float, ...], marked: Marked | None) -> Figure:
    """A chart: each curve with its parameter in the legend, in the order of their ends."""
    made = panels.page(chart.title, 0.45)
    axes = made.add_subplot()
    style.curves(axes, _label(chart.x), _label(chart.y))
    for i, values in enumerate(table.data[1:]):
        x, y = table.data[0], values
        if chart.peaked:
            x, y = _pointed(chart, table.data[0], values, curves[i])
        dashes = _DASHES[i % len(_DASHES)]
        label = _curve_label(chart, curves[i]) if chart.parameter is not None else None
        axes.plot(
            x,
            y,
            color=_COLORS[i % len(_COLORS)],
            linewidth=1.6,
            linestyle=dashes,
            label=label,
            gid=f"curve-{i}",
        )
    axes.set_xlim(table.data[0][0], table.data[0][-1])
    if marked is not None:
        _mark(axes, marked)
    if chart.parameter is not None or marked is not None:
        _legend(axes, chart)
    return made


def _pointed(chart: DesignChart, x: Any, y: Any, parameter: float) -> tuple[Any, Any]:
    """A curve with more places about its greatest row, from the row before it to that after it."""
    import numpy as np

    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    for _ in range(2):
        top = int(np.argmax(np.nan_to_num(y, nan=-np.inf)))
        if not 0 < top < len(x) - 1:
            break
        between = np.linspace(x[top - 1], x[top + 1], _BESIDE_A_POINT)
        around = chart.values(between, parameter)
        x, y = (np.concatenate((a[: top - 1], b, a[top + 2 :])) for a, b in ((x, between), (y, around)))
    return x, y


def write_chart(
    chart: DesignChart, table: Table, curves: tuple[float, ...], marked: Marked | None, options: Options
) -> Path:
    """Draw a chart and write NAME-chart.FORMAT, or DESIGN-NAME-chart.FORMAT, into the folder of the options.

    Raises
        CannotWrite - where the folder or the disk does not take the file
    """
    name, ending = "" if marked is None else marked.name, options.plot_format.value
    stem = chart.name if marked is None else f"{safe_stem(name)}-{chart.name}"
    path = options.out / f"{stem}-chart.{ending}"

    def make() -> Figure:
        return settled(draw(chart, table, curves, marked))

    write_atomically(path, lambda stream: save(make, name, stream, ending, options.dpi))
    return path


def _label(axis: Axis) -> str:
    unit = "" if axis.unit == "1" else f" [{axis.unit}]"
    return f"{axis.words} {axis.symbol}{unit}"


def _curve_label(chart: DesignChart, value: float) -> str:
    assert chart.parameter is not None, "asked for curves alone"
    unit = "°" if chart.parameter.unit == "deg" else ""
    return f"{chart.parameter.symbol} = {style.number(value)}{unit}"


def _mark(axes: Axes, marked: Marked) -> None:
    """The design's point with lines to both axes."""
    x, y = marked.place
    low, high = axes.get_xlim()
    axes.set_xlim(min(low, x), max(high, x))
    label = f"{marked.name}\n({x:.5g}, {y:.5g})".replace("$", r"\$")
    axes.plot([x], [y], "D", color=style.BLACK, markersize=7, zorder=6, label=label, gid="design")
    axes.relim()
    axes.autoscale_view(scalex=False)
    left, bottom = axes.get_xlim()[0], axes.get_ylim()[0]
    axes.plot([left, x, x], [y, y, bottom], color=style.BLACK, linewidth=0.8, linestyle=(0, (4, 3)), zorder=5)
    axes.set_ylim(bottom=bottom)


def _legend(axes: Axes, chart: DesignChart) -> None:
    title = "" if chart.parameter is None else chart.parameter.words
    axes.legend(
        loc="upper left", bbox_to_anchor=(1.01, 1.0), frameon=False, fontsize=8.5, title=title, borderaxespad=0.0
    )
