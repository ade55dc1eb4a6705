"""Figure of the cams of a wide-swing mechanism: profiles to scale, the slot at mid-swing, curvature."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, style, time_axes
from gearlink.cli.views.figures.wide_swing_cam.motion import legend_row
from gearlink.cli.views.figures.wide_swing_cam.parts import (
    cam_panel,
    cams_of,
    curvature_panel,
    kind_words,
    pressure_panel,
    zone_words,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.wide_swing.cycle import ClosedCam, WholeCycle
    from gearlink.core.machines.wide_swing.design import WideSwingDesign
    from gearlink.core.machines.wide_swing.strokes import AnyCam

_SHADES = (style.BLUE, style.LIGHT, style.GREEN, style.LIGHT)
_PARTS: dict[str, tuple[str, float]] = {
    "arc": (style.GREY, 1.4),
    "free": (style.PURPLE, 1.4),
    "slot": (style.ORANGE, 3),
}
_WORDS = {"profile": "guides", "slot": "slot", "arc": "rest", "free": "free, the other cam guides"}
_SLOT_VIEW = 3.2
"""Half the width of the enlarged view about mid-swing, in roller radii."""


def draw(command: str, design: WideSwingDesign) -> Figure:
    """The cams and an enlarged view of each slot, pressure angle and curvature.

    Raises
        NoSolution - for a profile that does not exist
    """
    whole = design.spec.cycle is not None
    title = f"{design.spec.name}: {command} ({kind_words(design)})"
    made = panels.page(title, 1.6 if whole else 1.0)
    drawn = cams_of(design)
    rows = made.add_gridspec(3, 1, height_ratios=[2.3, 0.9, 4.2]) if whole else None
    if rows is not None:
        contours_panel(made, rows[0], design)
        cycle_panel(made.add_subplot(rows[1]), design)
    heights = [1.75, 1.2, 0.2, 1.05]
    place = made.add_gridspec(1, 1)[0] if rows is None else rows[2]
    grid = place.subgridspec(4, 1, height_ratios=heights)
    large, close, below = (grid[i].subgridspec(1, n) for i, n in ((0, len(drawn)), (1, len(drawn)), (3, 2)))
    for i, (title, cam, mirror) in enumerate(drawn):
        axes = made.add_subplot(large[0, i])
        cam_panel(axes, design, title, cam, mirror)
        zone_words(axes, cam)
        _slot_panel(made.add_subplot(close[0, i]), design, cam, mirror)
    legend_row(made.add_subplot(grid[2]), axes)
    pressure_panel(made.add_subplot(below[0, 0]), design)
    curvature_panel(made.add_subplot(below[0, 1]), design)
    return made


def _slot_panel(axes: Axes, design: WideSwingDesign, cam: AnyCam, mirror: float) -> None:
    """The slot that the roller needs at mid-swing, enlarged."""
    import numpy as np

    from gearlink.core.machines.wide_swing.strokes import middle_of

    start, end = design.slot_of(cam)
    cam_panel(axes, design, "Slot at mid-swing", cam, mirror)
    words = f"contact until k = {start:.4f}\nand from k = {end:.4f}"
    axes.text(0.97, 0.05, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=7.5, zorder=8)
    middle = complex(cam.points(np.array([middle_of(cam)])).pitch[0])
    half: Any = _SLOT_VIEW * cam.roller_radius
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlim(middle.real - 1.6 * half, middle.real + 1.6 * half)
    axes.set_ylim(mirror * middle.imag - half, mirror * middle.imag + half)


# The whole cycle


def contours_panel(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """The closed contours to scale: of a twin-rocker on one body, of a twin-cam side by side."""
    cycle = design.cycle
    if not cycle.external_working:
        columns = place.subgridspec(1, 2, width_ratios=[1.5, 1.0])
        axes = made.add_subplot(columns[0, 0])
        panels.drawing(axes, "Both profiles on one body")
        for cam, frame, color in ((cycle.main, cycle.of_main, style.BLUE), (cycle.back, cycle.of_back, style.GREEN)):
            _contour(axes, cam, frame, color)
        _between(axes, cycle)
        _finish(axes, design)
        _legend(made.add_subplot(columns[0, 1]), axes)
        return
    columns = place.subgridspec(2, 2, height_ratios=[1.0, 0.08])
    for i, (title, cam, frame) in enumerate(
        (
            ("Cam of the working stroke", cycle.main, cycle.of_main),
            ("Cam of the return stroke", cycle.back, cycle.of_back),
        )
    ):
        axes = made.add_subplot(columns[0, i])
        panels.drawing(axes, title)
        _contour(axes, cam, frame, (style.BLUE, style.GREEN)[i])
        style.area(axes, _whole(cam, frame), color=style.BLUE, alpha=0.10, linewidth=0, zorder=1)
        _finish(axes, design)
        _legend(made.add_subplot(columns[1, i]), axes, 2)


def _whole(cam: ClosedCam, frame: Any) -> Any:
    import numpy as np

    return frame(np.concatenate([points for _, points in cam.outline()]))


def _xy(points: Any) -> tuple[Any, Any]:
    return points.real, points.imag


def _contour(axes: Axes, cam: ClosedCam, frame: Any, color: str) -> None:
    """A contour in its sectors, each in its own colour, the joints marked, and the path of the roller's centre."""
    import numpy as np

    named = "internal" if cam.cam.sense < 0 else "external"
    for i, (name, points) in enumerate(cam.outline()):
        shade, width = _PARTS.get(name, (color, 2.4))
        label = f"{named}: {_WORDS[name]}" if name == "profile" else _WORDS[name]
        first = i not in (2, 5)
        axes.plot(*_xy(frame(points)), color=shade, linewidth=width, zorder=4, label=label if first else None)
    joints = frame(cam.contour(np.array(cam.starts[:4])))
    axes.plot(*_xy(joints), "o", color=style.BLACK, markersize=3.5, zorder=6, label="joint")
    path = frame(cam.pitch(np.linspace(0.0, 2.0 * math.pi, 1441)))
    axes.plot(*_xy(path), color=style.GREY, linewidth=0.7, linestyle=(0, (5, 3)), zorder=3, label="roller centre")


def _between(axes: Axes, cycle: WholeCycle) -> None:
    """The body of both profiles: metal inside the external and outside the internal one, as far as a rim."""
    import numpy as np
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    inside, hollow = _whole(cycle.back, cycle.of_back), _whole(cycle.main, cycle.of_main)
    rim = 1.08 * float(np.abs(hollow).max())
    style.area(axes, inside, color=style.GREEN, alpha=0.12, linewidth=0, zorder=1)
    turn = rim * np.exp(2j * math.pi * np.linspace(0.0, 1.0, 361))
    paths = [Path(np.stack(_xy(z), axis=1), closed=True) for z in (turn, hollow)]
    look = {"facecolor": style.BLUE, "alpha": 0.10, "linewidth": 0, "zorder": 1}
    style.cornered(axes, PathPatch(Path.make_compound_path(*paths), **look))
    axes.plot(*_xy(turn), color=style.BLUE, linewidth=0.8, zorder=2)


def _finish(axes: Axes, design: WideSwingDesign) -> None:
    shaft = design.section.shaft_radius
    if shaft > 0.0:
        style.circle(axes, 0j, shaft, color=style.BLACK, linewidth=1.2, hatch="////", zorder=4)
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=10, zorder=6, label="cam axis")


def _legend(axes: Axes, drawing: Axes, columns: int = 1) -> None:
    axes.set_axis_off()
    found = dict(zip(*reversed(drawing.get_legend_handles_labels()), strict=True))
    axes.legend(found.values(), found.keys(), loc="center left", ncols=columns, frameon=False, fontsize=8)


def cycle_panel(axes: Axes, design: WideSwingDesign) -> None:
    """The rocker's angle over a revolution of the cam, the strokes and rests shaded and named."""
    import numpy as np

    cycle = design.cycle
    style.curves(axes, "cam angle from the start of the working stroke [deg]", "rocker from mid-swing [deg]")
    panels.small_ticks(axes)
    table = cycle.table(720)
    x, y = np.append(table["cam_angle"], 360.0), np.append(table["rocker_angle"], table["rocker_angle"][0])
    axes.plot(x, y, color=style.BLUE, linewidth=1.8, label="rocker")
    starts = np.degrees(np.cumsum((0.0, *cycle.angles)))
    half = 0.5 * design.spec.swing
    for i, words in enumerate(("working stroke", "far dwell", "return stroke", "near dwell")):
        axes.axvspan(starts[i], starts[i + 1], color=_SHADES[i], alpha=0.14, linewidth=0, zorder=0)
        if starts[i + 1] > starts[i]:
            text = f"{words}\n{starts[i + 1] - starts[i]:g}°"
            axes.text(0.5 * (starts[i] + starts[i + 1]), 1.08 * half, text, ha="center", va="bottom", fontsize=8)
    axes.set_xlim(0.0, 360.0)
    axes.set_ylim(-1.15 * half, 1.55 * half)
    time_axes.in_ms(axes, 6e4 / (360.0 * design.spec.speed))
    panels.heading(axes, "Cycle")
