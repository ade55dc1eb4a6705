"""Pictures of reducers and of drives with cams: the mechanism, what pins bear, pressure angles."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes import stepping as scenes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.cam_drives.grooved import Grooved
    from gearlink.core.machines.cam_drives.linked import LinkedCams
    from gearlink.core.machines.cycloidal.design import CycloidalReducer


def cycloidal(command: str, design: CycloidalReducer) -> Figure:
    """The reducer with its eccentric at 0, the levers, forces and gaps of its pins, and the profile's curvature."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.4, 1.0, 1.0, 1.0))
    drawing = made.add_subplot(grid[0])
    panels.drawing(drawing, "Discs and pins, eccentric at 0")
    scene_axes.draw(drawing, scenes.cycloidal(design, np.array([0.0])))
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


def grooved(command: str, design: Grooved) -> Figure:
    """The drive at a few degrees, output and speed over the input, pressure angle and curvature in the groove."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(5, 1, height_ratios=(2.6, 1.0, 1.0, 1.0, 1.0))
    drawing = made.add_subplot(grid[0])
    at = np.array([1.0 / 12.0])
    panels.drawing(drawing, "Mechanism at input angle 30°, and the groove")
    scene_axes.draw(drawing, scenes.grooved(design, at), ahead=scenes.grooved(design, at + scene_axes.AHEAD))
    degrees = np.linspace(0.0, 360.0, 721)
    theta = np.radians(degrees)
    output, speed, _ = design.output_motion.evaluate(theta, 2)
    groove, limit = design.groove, design.spec.limits.pressure_angle
    shown = (
        ("output [deg]", np.degrees(output), style.BLUE, "Output"),
        ("speed ratio [1]", speed, style.GREEN, "Speed of the output over the input's"),
        ("pressure\nangle [deg]", np.degrees(groove.pressure_angle(theta)), style.RED, "Pressure angle in the groove"),
        (
            "curvature [1/mm]",
            groove.curvature(theta),
            style.PURPLE,
            "Curvature of path and roller",
        ),
    )
    for row, (label, values, color, title) in enumerate(shown, 1):
        axes = made.add_subplot(grid[row])
        panels.turn_panel(axes, label, "input angle [deg]" if row == len(shown) else "")
        panels.heading(axes, title)
        axes.plot(degrees, values, color=color, linewidth=1.5)
        lines = {3: (limit, -limit), 4: (1.0 / groove.roller_radius, -1.0 / groove.roller_radius)}.get(row, ())
        for line in lines:
            axes.axhline(line, color=style.BLACK, linewidth=0.9, linestyle=(0, (5, 3)))
    return made


def linked_cams(command: str, design: LinkedCams) -> Figure:
    """Cams, rollers and path, the lifts, and the pressure angles of both cams."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.6, 1.0, 1.2, 1.2))
    drawing = made.add_subplot(grid[0])
    panels.drawing(drawing, "Cams and path at input angle 30°")
    scene_axes.draw(drawing, scenes.linked_cams(design, np.array([1.0 / 12.0])))
    degrees = np.linspace(0.0, 360.0, 721)
    axes = made.add_subplot(grid[1])
    panels.turn_panel(axes, "position [mm]")
    panels.heading(axes, "Coordinates of the path")
    for axis, (name, color) in enumerate((("x", style.BLUE), ("y", style.ORANGE))):
        values = design.coordinate(axis, np.radians(degrees), 0)[0]
        axes.plot(degrees, values, color=color, linewidth=1.5, label=name)
    panels.legend_above(axes)
    panels.pressure_angles(made.add_subplot(grid[2]), design.cams, design.spec.limits.pressure_angle, "")
    panels.curvatures(made.add_subplot(grid[3]), design.cams, "input angle [deg]")
    return made
