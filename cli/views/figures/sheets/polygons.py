"""The velocity polygons of a press at twelve positions, on an A4 page true to a scale that is printed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_CHAINS = (("B", "C", style.BLUE), ("E", "F", style.GREEN), ("H", "M", style.ORANGE))
_PAPER = (210.0, 297.0)
_COLUMNS, _ROWS = 3, 4
_BOX, _EDGE, _TOP, _STEP = 60.0, 12.0, 24.0, 66.0
"""Of the paper [mm]: each polygon's box, the margin, the title's height, and the pitch of the rows."""
_ROOM = 56.0
_BAR = 10.0


def draw(design: FlatbedPress) -> Figure:
    """Twelve polygons with their pole p: v_B + v_CB = v_C, v_E + v_FE = v_F, v_H + v_MH = v_M."""
    from matplotlib.figure import Figure

    table = design.table("polygons")
    ends = {
        name: table[name] * np.exp(1j * np.radians(table[f"{name}_direction"]))
        for start, end, _ in _CHAINS
        for name in (f"v_{start}", f"v_{end}")
    }
    boxes = [_box([complex(each[row]) for each in ends.values()]) for row in range(table.length)]
    scale = next_scale(max(size for _, size in boxes) / _ROOM)
    made = Figure(figsize=(_PAPER[0] / 25.4, _PAPER[1] / 25.4), facecolor="white")
    words = f"{design.spec.name}: velocity polygons, 1 mm on A4 is μv = {scale:g} mm/s"
    made.suptitle(words, fontsize=12, fontweight="bold", y=1.0 - 10.0 / _PAPER[1])
    for row, (middle, _) in enumerate(boxes):
        axes = _axes(made, row)
        half = 0.5 * _BOX * scale
        axes.set_xlim(middle.real - half, middle.real + half)
        axes.set_ylim(middle.imag - half, middle.imag + half)
        axes.set_title(f"{row + 1}: {table['input_angle'][row]:g}°", loc="left", fontsize=8, fontweight="bold", pad=2)
        _polygon(axes, {name: complex(each[row]) for name, each in ends.items()})
        corner = middle - half * (0.95 + 0.95j)
        axes.plot([corner.real, corner.real + _BAR * scale], [corner.imag] * 2, color=style.BLACK, linewidth=1.5)
        axes.annotate(
            f"{_BAR * scale:g} mm/s", (corner.real, corner.imag), (0, 2), textcoords="offset points", fontsize=6
        )
    return made


def next_scale(least: float) -> float:
    """The next of 1, 2, 5 times a power of ten.

    Example
        >>> next_scale(37.0), next_scale(5.1), next_scale(1.0)
        (50.0, 10.0, 1.0)
    """
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= least * (1.0 - 1e-12))


def _box(points: list[complex]) -> tuple[complex, float]:
    """Middle and size of what a position takes, the pole with it."""
    x, y = [0.0, *(each.real for each in points)], [0.0, *(each.imag for each in points)]
    middle = complex(0.5 * (min(x) + max(x)), 0.5 * (min(y) + max(y)))
    return middle, max(max(x) - min(x), max(y) - min(y))


def _axes(made: Figure, row: int) -> Axes:
    left, top = _EDGE + (row % _COLUMNS) * (_BOX + 3.0), _TOP + (row // _COLUMNS) * _STEP
    width, height = _PAPER
    place: Any = (left / width, 1.0 - (top + _BOX) / height, _BOX / width, _BOX / height)
    axes = made.add_axes(place)
    axes.set_xticks([])
    axes.set_yticks([])
    for edge in axes.spines.values():
        edge.set(color=style.GREY, linewidth=0.5)
    return axes


def _polygon(axes: Axes, ends: dict[str, complex]) -> None:
    """Both rays from the pole, and the side that joins their ends."""
    for start, end, color in _CHAINS:
        one, other = ends[f"v_{start}"], ends[f"v_{end}"]
        for a, b in ((0j, one), (one, other), (0j, other)):
            shape: Any = {"arrowstyle": "-|>", "color": color, "linewidth": 0.9, "shrinkA": 0.0, "shrinkB": 0.0}
            axes.annotate("", (b.real, b.imag), (a.real, a.imag), arrowprops=shape)
        for name, place in ((start.lower(), one), (end.lower(), other)):
            away = place / abs(place) if place else 1.0
            shift = (6.0 * away.real, 6.0 * away.imag)
            axes.annotate(name, (place.real, place.imag), shift, textcoords="offset points", fontsize=7, color=color,
                          ha="center", va="center")  # fmt: skip
    axes.plot([0.0], [0.0], "o", color=style.BLACK, markersize=2.5)
    axes.annotate("p", (0.0, 0.0), (-6, -6), textcoords="offset points", fontsize=7)
