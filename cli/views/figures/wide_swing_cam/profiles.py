"""Figure of the cams of a wide-swing mechanism: profiles to scale, the slot at mid-swing, curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels
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

    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.design import WideSwingDesign

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
        from gearlink.cli.views.figures.wide_swing_cam.cycle import contours_panel, cycle_panel

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

    from gearlink.core.machines.wide_swing.cams.outline import middle_of

    start, end = design.slot_of(cam)
    cam_panel(axes, design, "Slot at mid-swing", cam, mirror)
    words = f"contact until k = {start:.4f}\nand from k = {end:.4f}"
    axes.text(0.97, 0.05, words, transform=axes.transAxes, ha="right", va="bottom", fontsize=7.5, zorder=8)
    middle = complex(cam.points(np.array([middle_of(cam)])).pitch[0])
    half: Any = _SLOT_VIEW * cam.roller_radius
    axes.set_aspect("equal", adjustable="box")
    axes.set_xlim(middle.real - 1.6 * half, middle.real + 1.6 * half)
    axes.set_ylim(mirror * middle.imag - half, mirror * middle.imag + half)
