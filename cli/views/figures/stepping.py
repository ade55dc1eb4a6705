"""Pictures of reducers: the mechanism, and what its pins bear."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes.stepping import cycloidal as scene_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.cycloidal.design import CycloidalReducer


def cycloidal(command: str, design: CycloidalReducer) -> Figure:
    """The reducer with its eccentric at 0, the levers, forces and gaps of its pins, and the profile's curvature."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.4, 1.0, 1.0, 1.0))
    drawing = made.add_subplot(grid[0])
    panels.drawing(drawing, "Discs and pins, eccentric at 0")
    scene_axes.draw(drawing, scene_of(design, np.array([0.0])))
    table, disc = design.table("pins"), design.disc
    u = np.linspace(0.0, 360.0, 721)
    levers = np.abs(disc.lever(np.radians(u)))
    _pins(made.add_subplot(grid[1]), "Levers of the pins about the disc's centre", "lever [mm]", u, levers,
          table["angle"], table["lever"])  # fmt: skip
    if "force" in table.columns:
        _pins(made.add_subplot(grid[2]), "Forces of the ring pins, of the disc that carries most", "force [N]", u, None,
              table["angle"], table["force"])  # fmt: skip
    else:
        gaps = 1000.0 * disc.gap(np.radians(u), *design.changes)
        _pins(made.add_subplot(grid[2]), "Gaps at the pins", "gap [µm]", u, gaps, table["angle"], 1000.0 * table["gap"])
    axes = made.add_subplot(grid[3])
    panels.turn_panel(axes, "curvature [1/mm]", "angle from the eccentricity to the pin [deg]")
    panels.heading(axes, "Curvature of the pitch curve, and that of a pin")
    axes.plot(u, disc.curvature(np.radians(u)), color=style.GREEN, linewidth=1.5)
    axes.axhline(1.0 / disc.pin, color=style.BLACK, linewidth=0.9, linestyle=(0, (5, 3)))
    return made


def _pins(axes: Axes, title: str, label: str, u: Any, curve: Any, at: Any, values: Any) -> None:
    panels.turn_panel(axes, label)
    panels.heading(axes, title)
    if curve is not None:
        axes.plot(u, curve, color=style.BLUE, linewidth=1.2)
    axes.vlines(at, 0.0, values, color=style.BLUE, linewidth=1.0)
    axes.plot(at, values, "o", color=style.BLUE, markersize=4.5)
