"""The look of every figure: sizes, colours, and the drawing of links, pivots, gears and dimensions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Colours that stay apart for colour-blind readers and in grey print (Okabe and Ito).
BLUE, ORANGE, GREEN, RED, PURPLE, SKY, BLACK = (
    "#0072B2",
    "#E69F00",
    "#009E73",
    "#D55E00",
    "#CC79A7",
    "#56B4E9",
    "#222222",
)
GREY, LIGHT = "#777777", "#DDDDDD"


def figure(width: float, height: float, title: str) -> Figure:
    """An empty figure in inches with a title; needs no display and no pyplot."""
    from matplotlib.figure import Figure

    made = Figure(figsize=(width, height), dpi=130, layout="constrained")
    made.suptitle(title, fontsize=12, fontweight="bold")
    return made


def curves(axes: Axes, xlabel: str, ylabel: str) -> None:
    """A coordinate system for curves: grid, labels, light frame."""
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    axes.grid(True, color=LIGHT, linewidth=0.6)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def full_turn(axes: Axes, step: int = 60) -> None:
    """The x axis as one turn in degrees."""
    axes.set_xlim(0, 360)
    axes.set_xticks(range(0, 361, step))


def drawing(axes: Axes, title: str = "") -> None:
    """A coordinate system for a drawing to scale, in mm."""
    axes.set_aspect("equal", adjustable="datalim")
    axes.set_title(title, fontsize=10)
    axes.tick_params(labelsize=7, colors=GREY)
    axes.set_xlabel("mm", fontsize=7, color=GREY)
    for axis in (axes.xaxis, axes.yaxis):
        axis.get_offset_text().set(size=7, color=GREY)
    for spine in axes.spines.values():
        spine.set_color(LIGHT)


def circle(axes: Axes, center: complex, radius: float, **style: Any) -> None:
    """A circle; styles are those of a line."""
    from matplotlib.patches import Circle

    axes.add_patch(Circle((center.real, center.imag), radius, fill=False, **style))


def link(axes: Axes, points: Sequence[complex], color: str = BLACK, width: float = 2.2, **style: Any) -> None:
    """A chain of links with its joints."""
    x, y = [p.real for p in points], [p.imag for p in points]
    axes.plot(x, y, color=color, linewidth=width, solid_capstyle="round", zorder=4, **style)
    axes.plot(x, y, "o", color="white", markeredgecolor=color, markersize=4.5, zorder=5)


def pivot(axes: Axes, point: complex, name: str = "", size: float = 7.0) -> None:
    """A fixed pivot with its letter."""
    axes.plot([point.real], [point.imag], "^", color=BLACK, markersize=size, zorder=6)
    letter(axes, point, name)


def letter(axes: Axes, point: complex, name: str, shift: tuple[float, float] = (5, 5)) -> None:
    """The letter of a point."""
    if name:
        axes.annotate(name, (point.real, point.imag), shift, textcoords="offset points", fontsize=9, zorder=7)


def arrow(axes: Axes, start: complex, vector: complex, color: str = RED) -> None:
    """A vector in drawing units."""
    end = start + vector
    if abs(vector) > 0.0 and math.isfinite(abs(vector)):
        axes.annotate(
            "",
            (end.real, end.imag),
            (start.real, start.imag),
            arrowprops={"arrowstyle": "-|>", "color": color, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0},
            zorder=6,
        )


def dimension(
    axes: Axes,
    start: complex,
    end: complex,
    words: str,
    *,
    from_points: Sequence[complex] = (),
    shift: tuple[float, float] = (0, 3),
    color: str = BLACK,
) -> None:
    """A dimension line with arrows at both ends, its words beside the middle, and extension lines from the points."""
    for point, foot in zip(from_points, (start, end), strict=False):
        axes.plot([point.real, foot.real], [point.imag, foot.imag], color=GREY, linewidth=0.6, zorder=1)
    shape = {"arrowstyle": "<|-|>", "color": color, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 9}
    axes.annotate("", (end.real, end.imag), (start.real, start.imag), arrowprops=shape, zorder=6)
    axes.update_datalim([(start.real, start.imag), (end.real, end.imag)])
    middle = (start + end) / 2.0
    axes.annotate(
        words,
        (middle.real, middle.imag),
        shift,
        textcoords="offset points",
        ha="center",
        va="bottom" if shift[1] >= 0 else "top",
        fontsize=8,
        color=color,
        zorder=7,
    )
