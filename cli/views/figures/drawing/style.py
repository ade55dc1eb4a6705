"""The look of every figure: sizes, colours, and the drawing of links, pivots, gears and dimensions."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import cache
from textwrap import fill
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.options import DPI
from gearlink.cli.views.scenes import scene

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.patches import Patch
    from numpy.typing import NDArray


BLUE, ORANGE, GREEN, RED = scene.BLUE, scene.ORANGE, scene.GREEN, scene.RED
PURPLE, SKY, BLACK, GREY, LIGHT = scene.PURPLE, scene.SKY, scene.BLACK, scene.GREY, scene.LIGHT
MARGIN = 8.0 / 25.4
"""White edge of a page [in], which printers need."""
_PARTS = (1, 2, 5, 10, 15, 30, 60, 180, 360)
"""Steps of the numbers along an axis over angles [deg]."""
GRID = 0.6
"""Width of the lines of a grid."""
_TITLE = 12
_SHORT = 40
"""Characters of a title's line that the page has room for, however wide they are."""
DASHED: Any = (0, (5, 3))
DOTTED: Any = (0, (1, 2))
LONG: Any = (0, (6, 1.8))
"""Long dashes, of the second of two curves that are not limits."""
WRONG = scene.WRONG
"""What fails: no curve has this colour."""
CHAIN: Any = (0, (9, 2.5, 1.5, 2.5))
"""A dash-dotted line, as of axes and pitch circles."""


def figure(width: float, height: float, title: str) -> Figure:
    """An empty figure in inches with a title; needs no display and no pyplot."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    from gearlink.cli.views.figures.drawing.own import Sheet

    made = Sheet(figsize=(width, height), dpi=DPI, layout="constrained")
    FigureCanvasAgg(made)  # the layout's measures of words serve the drawing as well
    made.suptitle(title, fontsize=_TITLE, fontweight="bold")
    return made


def stamp(made: Figure, words: str) -> None:
    """A line in red below the title, before the layout."""
    lines = fill(words, 105, break_on_hyphens=False)
    title = made._suptitle  # type: ignore[attr-defined]  # get_suptitle gives its words alone
    if title is not None:
        title.set_text(title.get_text() + "\n" * (1 + lines.count("\n")))
    top = 1.0 - 0.1 / made.get_figheight()
    made.text(0.5, top, lines, fontsize=9, fontweight="bold", color=WRONG, ha="center", va="top", gid="fails")


def forbid(made: Figure, words: str) -> None:
    """Words in red across the view of a drawing, larger than all else on it: nobody is to make the part by it."""
    left, low, right, high = vars(made).get("view", (0.05, 0.05, 0.95, 0.95))
    lines = fill(words, 36, break_on_hyphens=False)
    look: dict[str, Any] = {"fontsize": 20, "fontweight": "bold", "color": WRONG, "alpha": 0.75, "rotation": 24}
    look |= {"ha": "center", "va": "center", "zorder": 20, "gid": "forbidden", "in_layout": False}
    drawn = made.text(0.5 * (left + right), 0.5 * (low + high), lines, **look)
    across = drawn.get_window_extent().transformed(made.transFigure.inverted())
    drawn.set_fontsize(look["fontsize"] * min(1.0, (right - left) / across.width, (high - low) / across.height))


def place_title(made: Figure) -> None:
    """Title and stamp within the margin of the page, after the layout, which puts the title at the edge."""
    title = made._suptitle  # type: ignore[attr-defined]
    if title is None:
        return
    width, height = made.get_size_inches()
    top = 1.0 - MARGIN / height
    title.set(y=top, va="top")
    if max(len(line) for line in title.get_text().split("\n")) > _SHORT:
        for _ in range(3):  # matplotlib before 3.11 rounds widths of letters: they do not shrink as their size does
            reach = title.get_window_extent().width / made.dpi / (width - 2.0 * MARGIN)
            if reach <= 1.0005:
                break
            title.set_fontsize(title.get_fontsize() / reach)
    rows = title.get_text().rstrip("\n").count("\n") + 1
    for text in made.texts:
        if text.get_gid() == "fails":
            text.set_y(top - rows * 1.25 * _TITLE / 72.0 / height)


def curves(axes: Axes, xlabel: str, ylabel: str) -> None:
    """A coordinate system for curves: grid, labels, light frame."""
    axes.set_xlabel(xlabel)
    axes.set_ylabel(ylabel)
    axes.grid(True, color=LIGHT, linewidth=GRID)
    axes.set_axisbelow(True)
    for side in ("top", "right"):
        axes.spines[side].set_visible(False)


def full_turn(axes: Axes, step: int = 60) -> None:
    """The x axis as one revolution in degrees."""
    axes.set_xlim(0, 360)
    numbers_at(axes, range(0, 361, step))


def degrees(axes: Axes, start: float, end: float) -> None:
    """An x axis over angles [deg] with at most eight parts: of some degrees, half turns, or whole turns."""
    whole = 360 * math.ceil((end - start) / (360.0 * 8) - 1e-9)
    step = next((part for part in _PARTS if (end - start) / part <= 8 + 1e-9), whole)
    axes.set_xlim(start, end)
    numbers_at(axes, [step * i for i in range(math.ceil(start / step - 1e-9), math.floor(end / step + 1e-9) + 1)])


def numbers_at(axes: Axes, places: Sequence[float]) -> None:
    """Numbers along the x axis at some places within it; `set_xticks` would make them before any is drawn."""
    from matplotlib.ticker import FixedLocator

    axes.xaxis.set_major_locator(FixedLocator(places))


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


def area(axes: Axes, points: Sequence[complex] | NDArray[Any], **look: Any) -> None:
    """A filled outline, given by its corners."""
    from matplotlib.patches import Polygon

    corners = np.asarray(points, dtype=complex)
    cornered(axes, Polygon(np.column_stack((corners.real, corners.imag)), closed=True, **look))


def holed(axes: Axes, outside: NDArray[Any], inside: NDArray[Any], **look: Any) -> None:
    """A filled outline with a hole, both given by their corners."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    around, hole = (np.column_stack((z.real, z.imag)) for z in (outside, inside))
    if _area(outside) * _area(inside) > 0.0:
        hole = hole[::-1]
    paths = [Path(around, closed=True), Path(hole, closed=True)]
    cornered(axes, PathPatch(Path.make_compound_path(*paths), **look))


def _area(points: NDArray[Any]) -> float:
    """Area within an outline, negative where it runs clockwise."""
    return 0.5 * float(np.sum((points.conj() * np.roll(points, -1)).imag))


def cornered(axes: Axes, patch: Patch) -> None:
    """A patch of straight sides, which reaches as far as its corners; `add_patch` would seek the extremes of each side,
    which takes longer than to draw them."""
    axes.add_artist(patch)
    axes.update_datalim(patch.get_path().vertices)
    axes.autoscale(None)  # type: ignore[arg-type]  # "bool or None", it says: whatever it was


def stretch(axes: Axes, start: float, end: float, **look: Any) -> None:
    """A stretch of the x axis, over the height of the panel whatever its limits."""
    from matplotlib.patches import Rectangle

    axes.add_artist(Rectangle((start, 0.0), end - start, 1.0, transform=axes.get_xaxis_transform(), **look))
    axes.update_datalim([(start, 0.0), (end, 0.0)], updatey=False)
    axes.autoscale(None)  # type: ignore[arg-type]  # "bool or None", it says: whatever it was


def disc(axes: Axes, center: complex, radius: float, **look: Any) -> None:
    """A disc, or a circle where the look says `fill=False`."""
    from matplotlib.patches import Circle

    axes.add_artist(Circle((center.real, center.imag), radius, **look))
    corner = complex(radius, radius)
    axes.update_datalim([(p.real, p.imag) for p in (center - corner, center + corner)])


def circle(axes: Axes, center: complex, radius: float, **look: Any) -> None:
    """A circle; the look is that of a line."""
    disc(axes, center, radius, fill=False, **look)


def link(
    axes: Axes, points: Sequence[complex], color: str = BLACK, width: float = 2.2, *, zorder: float = 4.0, **look: Any
) -> None:
    """A chain of links with its joints."""
    x, y = [p.real for p in points], [p.imag for p in points]
    axes.plot(x, y, color=color, linewidth=width, solid_capstyle="round", zorder=zorder, **look)
    dots = {"color": "white", "markeredgecolor": color, "markersize": min(2.5 + width, 4.7)}
    axes.plot(x, y, "o", **dots, zorder=zorder + 0.5)  # type: ignore[arg-type]


def pivot(axes: Axes, point: complex) -> None:
    """A fixed pivot: a pin on its hatched ground."""
    x, y = [point.real], [point.imag]
    size = 19.0
    look: Any = {"color": BLACK, "markersize": size, "linestyle": "", "zorder": 5.5, "markeredgewidth": 0.9}
    axes.plot(x, y, marker=_ground(), markerfacecolor="white", **look)
    axes.plot(x, y, "o", color="white", markeredgecolor=BLACK, markersize=0.25 * size, zorder=5.6)


@cache
def _ground() -> Any:
    """A triangle below the pin, the line it stands on, and the strokes below that."""
    from matplotlib.path import Path

    strokes = [((x, -1.6), (x - 0.45, -2.2)) for x in (-0.9, -0.3, 0.3, 0.9, 1.5)]
    lines = [((0.0, 0.0), (-0.9, -1.6), (0.9, -1.6), (0.0, 0.0)), ((-1.5, -1.6), (1.5, -1.6)), *strokes]
    codes = [Path.MOVETO if i == 0 else Path.LINETO for line in lines for i in range(len(line))]
    return Path([point for line in lines for point in line], codes)


def letter(axes: Axes, point: complex, name: str, shift: tuple[float, float]) -> None:
    """The letter of a point, so many points away from it."""
    if name:
        look: dict[str, Any] = {"ha": "center", "va": "center", "fontsize": 9.5, "zorder": 8}
        place, halo = (point.real, point.imag), outlined()
        axes.annotate(name, place, shift, textcoords="offset points", path_effects=halo, **look)


def outlined() -> list[Any]:
    """A thin white outline of letters, which keeps them legible on lines."""
    from matplotlib.patheffects import withStroke

    return [withStroke(linewidth=2.2, foreground="white")]


def number(value: float, digits: int = 6, scale: float = 1.0) -> str:
    """A value in so many digits with a true minus sign; rounding noise of values of that scale is 0.

    Example
        >>> number(-1.25), number(5.6e-17), number(5e-17, scale=0.0)
        ('−1.25', '0', '5e−17')
    """
    return f"{0.0 if abs(value) < 1e-13 * scale else value:.{digits}g}".replace("-", "−")


def arrow(axes: Axes, start: complex, vector: complex, color: str = RED) -> None:
    """A vector in drawing units."""
    end = start + vector
    if abs(vector) > 0.0 and math.isfinite(abs(vector)):
        shape = {"arrowstyle": "-|>", "color": color, "linewidth": 1.2, "shrinkA": 0, "shrinkB": 0}
        axes.annotate("", (end.real, end.imag), (start.real, start.imag), arrowprops=shape, zorder=6)


def dimension(
    axes: Axes,
    start: complex,
    end: complex,
    words: str,
    *,
    from_points: Sequence[complex] = (),
    shift: tuple[float, float] = (0, 3),
    upright: bool = False,
) -> None:
    """A dimension line with arrows at both ends, its words beside the middle, and extension lines from the points."""
    for point, foot in zip(from_points, (start, end), strict=False):
        axes.plot([point.real, foot.real], [point.imag, foot.imag], color=GREY, linewidth=0.6, zorder=1)
    shape = {"arrowstyle": "<|-|>", "color": BLACK, "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0, "mutation_scale": 9}
    axes.annotate("", (end.real, end.imag), (start.real, start.imag), arrowprops=shape, zorder=6)
    axes.update_datalim([(start.real, start.imag), (end.real, end.imag)])
    middle = (start + end) / 2.0
    look: dict[str, Any] = {"ha": "center", "va": "bottom" if shift[1] >= 0 else "top", "fontsize": 8, "zorder": 7}
    if upright:
        look |= {"rotation": 90, "ha": "right", "va": "center"}
        shift = (-3, 0)
    axes.annotate(words, (middle.real, middle.imag), shift, textcoords="offset points", **look)
