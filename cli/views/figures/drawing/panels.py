"""Panels that several figures share: named phases over a revolution, legends outside the curves, cams to scale."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from itertools import pairwise
from textwrap import fill
from typing import TYPE_CHECKING, Any, TypeAlias
from unicodedata import east_asian_width

import numpy as np

from gearlink.cli.views.figures.drawing import failing, style
from gearlink.cli.views.scenes.scene import PHASE_TINTS
from gearlink.core.mechanism.courses import unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from numpy.typing import NDArray

    from gearlink.core.mechanism.motion import Output
    from gearlink.core.parts.cams.disc_cam import DiscCam


Box: TypeAlias = tuple[float, float, float, float]
_PAPERS = ((8.27, 11.69), (11.69, 16.54), (16.54, 23.39), (23.39, 33.11), (33.11, 46.81))
"""A4 to A0, upright [in]."""
_A4 = _PAPERS[0]
_DEGREES = 0.5 * np.arange(721)
_SQUEEZED = 1.25
"""Pages of A4 that still are drawn on one."""

CAM_COLORS = (style.BLUE, style.RED)
CAM_LINES: tuple[Any, Any] = ("-", style.LONG)
"""Main and return cam differ in their lines as well, for grey print."""

_LEGEND: dict[str, Any] = {
    "frameon": False,
    "fontsize": 7.5,
    "borderpad": 0.1,
    "borderaxespad": 0.2,
    "handlelength": 2.8,
    "columnspacing": 1.2,
}
_NAME_SIZE = 7.5
_BESIDE = 60.0
"""Points that numbers and words beside a panel take."""
_LETTERS, _WIDE_LETTERS = 70, 45
"""Letters of a title's line, and of one that has Chinese ones."""
_LINE = 112
"""Characters of a legend that fill the width of a page."""


@dataclass(frozen=True, slots=True)
class Phase:
    """A named stretch of a revolution [deg]; it may begin before 0 or end after 360."""

    name: str
    start: float
    end: float

    def within_turn(self) -> list[tuple[float, float]]:
        """The stretch in [0, 360], in two parts where it passes the end of the turn."""
        start = self.start % 360.0
        end = start + (self.end - self.start)
        return [(start, end)] if end <= 360.0 else [(start, 360.0), (0.0, end - 360.0)]


def phases_of(output: Output) -> tuple[Phase, ...]:
    """The stretches of the input in which one law moves an output."""
    return tuple(Phase(name, math.degrees(start), math.degrees(end)) for name, start, end in output.phases)


def page(
    title: str, share: float = 1.0, *, least: float = 0.0, large: bool | None = None, lying: bool = False
) -> Figure:
    """A figure as wide as A4 or A3, and at most as high, so that printers take it to scale.

    share : height that it needs, that of A4 being 1
    least : height below which it cannot be read: where that of A3 is less, the paper is larger, more than A0 at last
    large : whether it is on A3; by default where A4 would squeeze it too much
    lying : the whole paper, on its long side
    """
    on_a3 = share > _SQUEEZED if large is None else large
    papers = [(long, short) if lying else (short, long) for short, long in _PAPERS[1 if on_a3 else 0 :]]
    width, most = next((paper for paper in papers if paper[1] >= least * _A4[1]), papers[-1])
    height = max(most if lying else min(share * _A4[1], most), least * _A4[1])
    letters = _WIDE_LETTERS if any(east_asian_width(letter) in "WF" for letter in title) else _LETTERS
    made = style.figure(width, height, fill(title.replace("$", r"\$"), letters))
    engine: Any = made.get_layout_engine()
    across, up = style.MARGIN / width, style.MARGIN / height
    engine.set(rect=(across, up, 1.0 - 2.0 * across, 1.0 - 2.0 * up), w_pad=0.03, h_pad=0.05)
    return made


def stack(title: str, heights: Sequence[float], share: float = 1.0, **paper: Any) -> tuple[Figure, list[Axes]]:
    """A figure of panels one above the other, and these."""
    made = page(title, share, **paper)
    grid = made.add_gridspec(len(heights), 1, height_ratios=heights)
    return made, [made.add_subplot(grid[row]) for row in range(len(heights))]


def shade(axes: Sequence[Axes], phases: Sequence[Phase]) -> None:
    """Shade the phases in all axes, and name them along the top of the first."""
    names: list[tuple[float, str]] = []
    crowded = False
    for phase in phases:
        parts = phase.within_turn()
        for start, end in parts:
            for each in axes:
                style.stretch(each, start, end, color=PHASE_TINTS[phase.name], linewidth=0, zorder=0)
        start, end = max(parts, key=lambda part: part[1] - part[0])
        names.append((0.5 * (start + end), phase.name))
        crowded |= (len(phase.name) + 1) * 0.6 * _NAME_SIZE / _across(axes[0]) * 360.0 > end - start
    top = axes[0].secondary_xaxis("top")
    top.set_xticks([place for place, _ in names], [name for _, name in names], fontsize=_NAME_SIZE)
    top.tick_params(length=0, pad=2)
    top.spines["top"].set_visible(False)
    if crowded:
        places = sorted(place for place, _ in names)
        apart = min((b - a for a, b in pairwise(places)), default=360.0) / 360.0 * _across(axes[0])
        steep = math.degrees(math.asin(min(1.0, 1.2 * _NAME_SIZE / max(apart, 1e-9))))
        for label in top.get_xticklabels():
            label.set(rotation=min(max(35.0, steep), 85.0), ha="left", va="bottom", rotation_mode="anchor")


def _across(axes: Axes) -> float:
    """Width of a panel [pt], without what stands beside it."""
    share = _share_of_page(axes)
    return 72.0 * (_A4[0] - 1.2) * share - (0.0 if share > 0.9 else _BESIDE)


def heading(axes: Axes, title: str) -> None:
    """The title of a panel, on the left, so that a legend finds room beside it."""
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")


def abridged(name: str, most: int = 32) -> str:
    """A name, or the first and the last letters of a long one, which beside a bar or in a legend would leave a panel
    no width."""
    half = most // 2
    return name if len(name) <= most else f"{name[: half - 1]}…{name[-half:]}"


def bars_named(axes: Axes, names: Sequence[str], size: float | None = None) -> None:
    """Names to the left of bars at 0, 1, 2 ..."""
    axes.set_yticks(range(len(names)), [abridged(name) for name in names], fontsize=size)


def legend_above(axes: Axes, columns: int = 5) -> None:
    """The legend above the right end of the panel, outside the curves; below the heading where they would meet."""
    labels = axes.get_legend_handles_labels()[1]
    title = str(axes.get_title(loc="left"))
    room = _LINE * _share_of_page(axes)
    columns = _columns_within(room, labels, columns)
    rows = max(1, math.ceil(len(labels) / columns))
    if title and 1.4 * len(title) + _width_of_legend(labels, columns) > room:
        axes.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=17.0 + 12.0 * (rows - 1))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=columns, **_LEGEND)


def _width_of_legend(labels: Sequence[str], columns: int) -> int:
    """Characters across a legend in so many columns, the first of them longer by one, its lines and gaps counted."""
    rows, longer = divmod(len(labels), columns)
    ends = [column * rows + min(column, longer) for column in range(columns + 1)]
    return sum(max(len(label) for label in labels[i:j]) + 9 for i, j in pairwise(ends) if i < j)


def _columns_within(room: float, labels: Sequence[str], most: int) -> int:
    """Columns of a legend that fit into so many characters across."""
    return next((n for n in range(most, 1, -1) if _width_of_legend(labels, n) <= room), 1)


def _share_of_page(axes: Axes) -> float:
    """Part of the width of A4 that the panel's columns of the grid have, its margins not counted."""
    place = axes.get_subplotspec()
    if place is None:
        return 1.0
    grid = place.get_gridspec()
    ratios: Any = grid.get_width_ratios() or [1.0] * grid.ncols
    share = float(sum(ratios[place.colspan.start : place.colspan.stop]) / sum(ratios))
    width: float = axes.figure.get_figwidth()  # type: ignore[union-attr]
    return share * width / _A4[0]


def legend_under_heading(axes: Axes, title: str, columns: int = 2) -> None:
    """The heading of a panel, and between it and the curves a legend in as many rows as it needs."""
    columns = _columns_within(_LINE * _share_of_page(axes), axes.get_legend_handles_labels()[1], columns)
    legend = axes.legend(loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, **_LEGEND)
    rows = math.ceil(len(legend.get_texts()) / columns)
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold", pad=7.0 + 12.0 * rows)


def legend_below(axes: Axes, columns: int = 1, *, labelled: bool = False) -> None:
    """The legend of a drawing below its tick labels, and below the label of its axis where it has one."""
    from matplotlib.transforms import ScaledTranslation

    down = ScaledTranslation(0.0, -0.53 if labelled else -0.29, axes.figure.dpi_scale_trans)
    place: dict[str, Any] = {"bbox_to_anchor": (0.5, 0.0), "bbox_transform": axes.transAxes + down}
    axes.legend(loc="upper center", ncols=columns, frameon=False, fontsize=7.5, borderaxespad=0.0, **place)


def drawing(axes: Axes, title: str) -> None:
    """A drawing to scale among other panels; its unit stands in the heading, where no legend crosses it."""
    style.drawing(axes)
    heading(axes, f"{title} [mm]")
    axes.set_xlabel("")
    _few_ticks(axes, 7)


def per_input(unit: str, order: int, per: str = "rad") -> str:
    """Unit of a value, or of its derivative by the input, as panels have it: angles in degrees, their rates per rad.

    Example
        >>> per_input("rad", 0), per_input("rad", 2), per_input("mm", 2), per_input("rad", 1, "mm")
        ('deg', '1/rad', 'mm/rad²', 'rad/mm')
    """
    if order == 0:
        return "deg" if unit == "rad" else unit
    if per == "rad":
        return ("1", "1/rad", "1/rad²")[order - 1] if unit == "rad" else unit + ("/rad", "/rad²", "/rad³")[order - 1]
    return unit_of(unit, order, per).replace("^2", "²").replace("^3", "³")


def extreme(axes: Axes, degrees: float, value: float, *, above: bool, unit: str = "", at: str = "°") -> None:
    """A marked extreme of a curve over its input, with its value; `at` is the unit of places."""
    axes.plot([degrees], [value], "o", color=style.RED, markersize=4.0, zorder=5)
    left, right = axes.get_xlim()
    words = f"{style.number(value, 5, 1e3 * float(np.ptp(axes.get_ylim())))}{unit} at {degrees:.5g}{at}"
    across = 72.0 * (_A4[0] - 1.6) * _share_of_page(axes) - _BESIDE
    share, half = (degrees - left) / (right - left), min(0.5, 0.5 * 0.6 * _NAME_SIZE * len(words) / across)
    side = "right" if share > 1.0 - half else "left" if share < half else "center"
    look: dict[str, Any] = {"ha": side, "va": "bottom" if above else "top", "fontsize": 7.5, "zorder": 6}
    shift = ({"left": 3, "center": 0, "right": -3}[side], 5 if above else -5)
    axes.annotate(words, (degrees, value), shift, textcoords="offset points", path_effects=style.outlined(), **look)


def legend_beside(axes: Axes, drawing: Axes, **look: Any) -> None:
    """The legend of a drawing in an empty panel of its own, its words once for each colour."""
    axes.set_axis_off()
    entries = zip(*drawing.get_legend_handles_labels(), strict=True)
    found = {(words, str(getattr(each, "get_color", lambda: "")())): (each, words) for each, words in entries}
    usual: dict[str, Any] = {"loc": "upper left", "fontsize": 8, "borderaxespad": 0.0, "handlelength": 2.8}
    handles, words = zip(*found.values(), strict=True) if found else ((), ())
    axes.legend(handles, words, frameon=False, **{**usual, **look})


def message(axes: Axes, words: str, size: float = 8) -> None:
    """Words in place of a panel that has nothing to show."""
    axes.axis("off")
    axes.text(0.5, 0.5, words, ha="center", va="center", fontsize=size, transform=axes.transAxes)


def small_ticks(axes: Axes) -> None:
    """Tick labels and axis labels of a panel among several."""
    axes.tick_params(labelsize=8)
    for axis in (axes.xaxis, axes.yaxis):
        axis.label.set_fontsize(8.5)
    _few_ticks(axes, 6)


def _few_ticks(axes: Axes, most: int) -> None:
    axes.ticklabel_format(scilimits=(-3, 5))
    for axis in (axes.xaxis, axes.yaxis):
        few_ticks(axis, most)
    axes.yaxis.get_offset_text().set_horizontalalignment("right")  # beside a legend under the heading
    axes.yaxis.OFFSETTEXTPAD = 5  # points above a number at the end of the axis


def few_ticks(axis: Axis, most: int = 6) -> None:
    """Round numbers along an axis, as many whatever its length, which the layout changes after it has measured them."""
    from gearlink.cli.views.figures.drawing.own import RoundNumbers

    axis.get_offset_text().set_fontsize(7)
    axis.set_major_locator(RoundNumbers(most))


def curves(axes: Axes, xlabel: str, ylabel: str, title: str = "") -> None:
    """A panel of curves among several."""
    style.curves(axes, xlabel, ylabel)
    small_ticks(axes)
    if title:
        heading(axes, title)


def turn_panel(axes: Axes, ylabel: str, xlabel: str = "", title: str = "") -> None:
    """Curves over one revolution; panels above others go without a label of the x axis."""
    curves(axes, xlabel, ylabel, title)
    style.full_turn(axes, 30)
    if not xlabel:
        axes.tick_params(labelbottom=False)


def pressure_angles(axes: Axes, cams: Sequence[DiscCam], limit: float, xlabel: str) -> None:
    """Pressure angle of each cam over the cam angle, its extreme and the limit [deg]."""
    turn_panel(axes, "pressure\nangle [deg]", xlabel, "Pressure angle")
    for cam, color, line in zip(cams, CAM_COLORS, CAM_LINES, strict=False):
        values = np.degrees(cam.pressure_angle(np.radians(_DEGREES)))
        worst = cam.max_pressure_angle
        place = math.degrees(worst.place)
        sign = math.copysign(1.0, float(np.interp(place, _DEGREES, values)))
        label = f"{cam.name}, ≤ {math.degrees(worst.value):.4g}° at {place:.4g}°"
        axes.plot(_DEGREES, values, color=color, linewidth=1.5, linestyle=line, label=label)
        failing.past(axes, _DEGREES, values, np.abs(values) > limit, "above the limit")
        axes.plot([place], [sign * math.degrees(worst.value)], "o", color=color, markersize=4.5)
    for sign in (1.0, -1.0):
        named = f"limit ±{limit:g}°" if sign > 0.0 else None
        axes.axhline(sign * limit, color=style.BLACK, linewidth=0.9, linestyle=style.DASHED, label=named)
    _legend_of_cams(axes)


def curvatures(axes: Axes, cams: Sequence[DiscCam], xlabel: str) -> None:
    """Curvature of each pitch curve over the cam angle, and the curvature of the roller, which undercuts."""
    turn_panel(axes, "curvature of the\npitch curve [1/mm]", xlabel, "Curvature")
    for cam, color, line in zip(cams, CAM_COLORS, CAM_LINES, strict=False):
        least = cam.min_curvature_radius
        values = cam.curvature(np.radians(_DEGREES))
        label = f"{cam.name}, ρ ≥ {least.value:.5g} mm"
        axes.plot(_DEGREES, values, color=color, linewidth=1.5, linestyle=line, label=label)
        failing.past(axes, _DEGREES, values, values * cam.roller_radius >= 1.0, "undercut")
        if math.isfinite(least.value):
            axes.plot([math.degrees(least.place)], [1.0 / least.value], "o", color=color, markersize=4.5)
    for radius in sorted({cam.roller_radius for cam in cams}):
        label = f"undercut: 1/roller radius {radius:g} mm"
        axes.axhline(1.0 / radius, color=style.BLACK, linewidth=0.9, linestyle=style.DASHED, label=label)
    _legend_of_cams(axes)


def _legend_of_cams(axes: Axes) -> None:
    """A row, or two where a cam fails."""
    legend_above(axes, 5 if len(axes.get_legend_handles_labels()[1]) < 4 else 3)


def by_value(
    axes: Axes, points: NDArray[Any], values: NDArray[Any], limit: float | None, width: float, bar: Box
) -> tuple[NDArray[Any], Axes]:
    """A line coloured by the values of its pieces, from 0 to a limit where there is one; the pieces and their scale.

    Parameters
        points, values : (N,) complex, (N - 1,) arrays - what has no value is left out
        bar : where the scale stands, in shares of the panel
    """
    from matplotlib.collections import LineCollection

    corners = np.column_stack((points.real, points.imag))
    pieces = np.stack((corners[:-1], corners[1:]), axis=1)
    known = np.isfinite(pieces).all(axis=(1, 2)) & np.isfinite(values)
    lines = LineCollection(list(pieces[known]), cmap="viridis", linewidths=width, gid="by value")
    lines.set_array(values[known])
    lines.set_clim(0.0, limit)
    axes.add_collection(lines)
    scale = axes.inset_axes(bar)  # a panel of its own would count twice in the layout of matplotlib before 3.11
    axes.figure.colorbar(lines, cax=scale)
    scale.tick_params(labelsize=7)
    return pieces, scale


def again(axes: Axes, pieces: NDArray[Any], color: str, width: float, **look: Any) -> None:
    """Some pieces of a line once more, in one colour."""
    from matplotlib.collections import LineCollection

    axes.add_collection(LineCollection(list(pieces), colors=color, linewidths=width, **look))


def cam_outline(axes: Axes, cam: DiscCam, color: str, axis: complex = 0j, line: Any = "-") -> complex:
    """A cam at cam angle 0, to scale: profile, pitch curve dashed, roller; the roller's centre is returned."""
    pitch, profile = cam.points(np.radians(_DEGREES))
    pitch, profile = pitch + axis, profile + axis
    roller = complex(cam.path(np.array([0.0]), 1).position.flat[0]) + axis
    style.area(axes, profile, color=color, alpha=0.08, linewidth=0)
    words = f"{cam.name}, profile"
    axes.plot(profile.real, profile.imag, color=color, linewidth=1.7, linestyle=line, label=words, zorder=3)
    cut(axes, cam, profile)
    look: dict[str, Any] = {"color": color, "linewidth": 0.9, "linestyle": style.DASHED, "zorder": 3}
    axes.plot(pitch.real, pitch.imag, **look, label="pitch curve")
    style.circle(axes, roller, cam.roller_radius, color=color, linewidth=1.4, zorder=4)
    axes.plot([roller.real], [roller.imag], "+", color=color, markersize=7, zorder=5)
    return roller


def cut(axes: Axes, cam: DiscCam, profile: Any) -> None:
    """In red, where the roller cuts into the profile: the pitch curve is more sharply convex than the roller.

    profile : (721,) array - the profile from cam angle 0 to 360 deg as it is drawn [mm]
    """
    lost = cam.curvature(np.radians(_DEGREES)) * cam.roller_radius >= 1.0
    if lost.any():
        where = np.where(lost | np.roll(lost, 1) | np.roll(lost, -1), profile, np.nan)
        look: Any = {"color": style.WRONG, "linewidth": 3.5, "zorder": 7, "gid": "undercut"}
        axes.plot(where.real, where.imag, **look, label=f"{cam.name}, undercut")


def base_circles(axes: Axes, cams: Sequence[DiscCam], axis: complex = 0j) -> None:
    """The base circle of each cam: the largest that its profile does not cut into."""
    radii = {f"{cam.min_radius:.5g}": cam.min_radius for cam in cams}
    colors = CAM_COLORS if len(radii) > 1 else (style.GREY,)
    for (text, radius), color in zip(radii.items(), colors, strict=True):
        look: dict[str, Any] = {"color": color, "linewidth": 1.0, "linestyle": style.DOTTED}
        style.circle(axes, axis, radius, **look, zorder=2)
        axes.plot([], [], **look, label=f"base circle, {text} mm")


def cam_shaft(axes: Axes, axis: complex, radius: float) -> None:
    """The shaft of the cams, where the file gives its radius [mm]."""
    if radius > 0.0:
        style.circle(axes, axis, radius, color=style.BLACK, linewidth=0.9)
        axes.plot([], [], color=style.BLACK, linewidth=0.9, label=f"shaft, {radius:g} mm")


def cam_axis(axes: Axes, axis: complex, cams: Sequence[DiscCam], sense: int, shaft_radius: float = 0.0) -> None:
    """The cam axis with an arrow in the sense of rotation, clear of the shaft."""
    least, most = min(cam.min_radius for cam in cams), max(cam.max_radius for cam in cams)
    radius = max(0.45 * least, 0.5 * (shaft_radius + least), 0.15 * most)
    axes.plot([axis.real], [axis.imag], "+", color=style.BLACK, markersize=12, zorder=6)
    axes.plot([axis.real], [axis.imag], "o", color="white", markeredgecolor=style.BLACK, markersize=6, zorder=6)
    arc = axis + radius * np.exp(1j * np.radians(90.0 + sense * np.linspace(-70.0, 65.0, 61)))
    axes.plot(arc.real, arc.imag, color=style.BLACK, linewidth=1.2, zorder=6)
    end = complex(arc[-1])
    style.arrow(axes, end, 0.12 * radius * 1j * sense * (end - axis) / radius, style.BLACK)


_FEW = 10.0**2.7
"""An axis whose ends are nearer than this ratio would have two or three powers of ten."""
_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def powers_of_ten(axis: Axis) -> None:
    """Numbers along a logarithmic axis as plain text: powers of ten, of an axis of few decades 1, 2 and 5 times those.

    matplotlib's own formatter writes formulas, which take it thirty times as long.
    """
    from matplotlib.ticker import FuncFormatter

    def few() -> bool:
        low, high = sorted(axis.get_view_interval())
        return bool(high < _FEW * low)

    def between(value: float, _: int) -> str:
        first = f"{value:.0e}"[0]
        return f"{value:g}" if few() and first in "25" else ""

    axis.set_major_formatter(FuncFormatter(lambda value, _: f"{value:g}" if few() else _power(value)))
    axis.set_minor_formatter(FuncFormatter(between))
    axis.set_tick_params(which="minor", labelsize=axis.get_tick_params("major").get("labelsize"))


def _power(value: float) -> str:
    """A power of ten.

    Example
        >>> _power(1000.0), _power(0.01)
        ('10³', '10⁻²')
    """
    return "10" + str(round(math.log10(value))).translate(_RAISED)


def without_numbers(axes: Axes) -> None:
    """The grid and the ticks of an x axis whose numbers stand below another panel, as two lines instead of many."""
    from matplotlib.lines import Line2D
    from matplotlib.markers import TICKDOWN
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path
    from matplotlib.ticker import NullLocator

    places = np.asarray(axes.xaxis.get_majorticklocs(), dtype=float)
    low, high = sorted(axes.get_xlim())
    places = places[(places >= low) & (places <= high)]
    axes.xaxis.set_major_locator(NullLocator())
    look: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "zorder": axes.xaxis.get_zorder()}
    corners = np.column_stack((np.repeat(places, 2), np.tile([0.0, 1.0], len(places))))
    grid = Path(corners, np.tile([Path.MOVETO, Path.LINETO], len(places)))
    axes.add_artist(PathPatch(grid, fill=False, edgecolor=style.LIGHT, linewidth=style.GRID, **look))
    mark: dict[str, Any] = {"marker": TICKDOWN, "markersize": 3.5, "markeredgewidth": 0.8, "linestyle": "none"}
    axes.add_artist(Line2D(places, np.zeros(len(places)), color="black", clip_on=False, **mark, **look))
