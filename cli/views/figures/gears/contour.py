"""The blocking contour of a gear pair with the design in it, and sliding, pressure and root stress along its path."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.base.errors import NoSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.lines import Line2D

    from gearlink.core.parts.gears.along_path import AlongPath, Place
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.shifts.contour import BlockingContour

_LOOKS = (
    ("undercut", style.RED, "-", "undercut"),
    ("pointed tip", style.BLACK, "-", "pointed tip"),
    ("tip fouling", style.RED, style.DASHED, "tip fouling"),
    ("radial assembly", style.GREY, style.DASHED, "radial assembly"),
    ("tip", style.BLACK, style.DOTTED, "tip thickness 0.2, 0.4 m"),
    ("fillet", style.ORANGE, "-", "root fillet met"),
    ("base circle", style.ORANGE, style.DASHED, "base circle met"),
    ("contact ratio", style.BLUE, "-", "contact ratio 1, 1.1, 1.2"),
    ("equal sliding", style.GREEN, "-", "equal sliding"),
    ("equal root stress", style.GREEN, style.DASHED, "equal root stress"),
)
_FOOT = ("data", "axes fraction")
_SLIDING = -6.0, 1.5
"""What is shown of the specific sliding, which is at most 1 where flanks touch."""
_STEP = 0.15
"""Points of a line farther apart than this, in both shifts, belong to different branches."""


def contour_plot(axes: Axes, key: Axes, contour: BlockingContour) -> None:
    """Every line of the contour in the plane of both shifts, the shifts that are free, and the design."""
    panels.heading(axes, "Blocking contour")
    _free(axes, contour)
    axes.plot([], [], color=style.GREEN, alpha=0.25, linewidth=6, label="free of all that blocks")
    named: set[str] = set()
    for name, points in contour.points.items():
        _, color, dashes, words = next(look for look in _LOOKS if name.startswith(look[0]))
        for branch in _branches(points):
            label = words if words not in named else "_"
            named.add(words)
            xs, ys = zip(*branch, strict=True)
            axes.plot(xs, ys, color=color, linestyle=dashes, linewidth=1.1, label=label)
    _margins(axes, contour)
    x1, x2 = contour.data.pair.profile_shift
    axes.plot([x1], [x2], "o", color="white", markeredgecolor=style.BLACK, markersize=6, label="this design", zorder=6)
    axes.set_xlim(*contour.window[0])
    axes.set_ylim(*contour.window[1])
    _named(axes, "x₁", "x₂")
    _key(key, axes.get_legend_handles_labels()[0], 3, -0.14)


def _free(axes: Axes, contour: BlockingContour) -> None:
    """The shifts that are free, as one patch: strips of their own would show their seams."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    strips = [Path([*band, band[0]], closed=True) for band in contour.free]
    if strips:
        look: dict[str, Any] = {"facecolor": style.GREEN, "alpha": 0.12, "linewidth": 0}
        style.cornered(axes, PathPatch(Path.make_compound_path(*strips), **look))


def _margins(axes: Axes, contour: BlockingContour) -> None:
    """The way along the diagonal to the nearest limit on either side, with its length in x_1."""
    x1, x2 = contour.pair.profile_shift
    for side, end in enumerate(contour.nearest_limits):
        if end is None:
            continue
        name, way = end
        axes.plot([x1, x1 + way], [x2, x2 - way], color=style.BLACK, linewidth=0.8, marker="|", markersize=5, zorder=5)
        text = f"{style.number(way, 3)} {name}"
        low, high = contour.window[0]
        share = (x1 + way - low) / (high - low)
        outward = share > 0.35 if side == 0 else share < 0.65  # within the plot wherever the limit lies
        shift, align = ((-4, 3), "right") if (side == 0) == outward else ((4, -3), "left")
        level = "center"
        if not outward:  # back beside the way, clear of it and of the design's mark
            shift, level = ((shift[0], 4), "bottom") if side == 0 else ((shift[0], -4), "top")
        box = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.4}
        look: dict[str, Any] = {"fontsize": 6, "zorder": 7, "bbox": box, "annotation_clip": True}
        place = (x1 + way, x2 - way)
        axes.annotate(text, place, shift, textcoords="offset points", ha=align, va=level, **look)


def _named(axes: Axes, across: str, up: str) -> None:
    axes.tick_params(labelsize=7)
    axes.set_xlabel(across, fontsize=8)
    axes.set_ylabel(up, fontsize=8)


def _key(axes: Axes, handles: Sequence[Any], columns: int, left: float = 0.0) -> None:
    """The legend in axes of its own, from so far beside its left end."""
    axes.set_axis_off()
    labels = [str(handle.get_label()) for handle in handles]
    look: dict[str, Any] = {"fontsize": 6.5, "frameon": False, "handlelength": 1.8, "columnspacing": 0.7}
    place: Any = {"loc": "upper left", "bbox_to_anchor": (left, 1.0), "borderaxespad": 0.0}
    legend = axes.legend(handles, labels, ncols=columns, **place, **look)
    legend.set_in_layout(False)


def _branches(points: list[tuple[float, float]]) -> list[list[tuple[float, float]]]:
    """The points of a line in the order of its branches: each goes on at both ends to what is next and near enough."""
    left, branches = list(points), []
    while left:
        branch = [left.pop(0)]
        for _ in range(2):
            while near := [point for point in left if max(_apart(branch[-1], point)) < _STEP]:
                following = min(near, key=lambda point: sum(d * d for d in _apart(branch[-1], point)))
                left.remove(following)
                branch.append(following)
            branch.reverse()
        branches.append(branch)
    return branches


def _apart(one: tuple[float, float], other: tuple[float, float]) -> tuple[float, float]:
    return abs(one[0] - other[0]), abs(one[1] - other[1])


def path_plot(axes: Axes, key: Axes, data: GearData) -> None:
    """Specific sliding of both gears from A to E; with a load the pressure and root stresses as well."""
    from gearlink.core.parts.gears.along_path import AlongPath

    along = AlongPath(data)
    try:
        places = along.places(120)
    except NoSolution:
        axes.set_axis_off()
        key.set_axis_off()
        return
    panels.heading(axes, "Along the path of contact")
    rho = [place.rho for place in places]
    for gear, color in ((0, style.BLUE), (1, style.ORANGE)):
        sliding = [data.path.sliding(place.rho)[gear] for place in places]
        axes.plot(rho, sliding, color=color, linewidth=1.2, label=f"sliding, {data.called(gear)}")
    _sliding_axes(axes)
    handles = list(axes.get_lines()[:2])
    if data.load is not None and data.face_width is not None and along.single is not None:
        handles += _stresses(axes, along, places)
    for name, at in (("A", data.path.start), ("C", data.path.pitch), ("E", data.path.end)):
        axes.annotate(name, (at, 0.0), (1, 3), xycoords=_FOOT, textcoords="offset points", fontsize=7)
    _key(key, handles, 2)


def _sliding_axes(axes: Axes) -> None:
    """Names and the line of no sliding; beside a base circle, where it has no bounds, the curve leaves the panel."""
    axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    _named(axes, "ρ₁ in mm", "specific sliding ζ")
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, _SLIDING[0]), min(high, _SLIDING[1]))
    if low < _SLIDING[0]:
        drawn: list[Any] = [line.get_ydata() for line in axes.get_lines()[:2]]
        least = min(float(min(values)) for values in drawn)
        words = f"down to ζ = {style.number(least, 4)}"
        axes.text(0.5, 0.08, words, transform=axes.transAxes, fontsize=7, ha="center", color=style.GREY)


def _stresses(axes: Axes, along: AlongPath, places: list[Place]) -> list[Line2D]:
    """Pressure and root stresses on an axis of their own."""
    import math

    other = axes.twinx()
    _named(other, "", "stress under the nominal load [N/mm²]")
    rho = [place.rho for place in places]
    found: list[Line2D] = []

    def drawn(values: list[float | None], words: str, color: str, dashes: Any) -> None:
        heights = [math.nan if value is None or math.isinf(value) else value for value in values]
        found.extend(other.plot(rho, heights, color=color, linestyle=dashes, linewidth=1.1, label=words))

    drawn([along.pressure(place) for place in places], "pressure", style.RED, "-")
    for gear, color in ((0, style.BLUE), (1, style.ORANGE)):
        stresses = [along.root_stress(place, gear) for place in places]
        drawn(stresses, f"root stress, {along.data.called(gear)}", color, style.DASHED)
    other.set_ylim(bottom=0.0)
    return found
