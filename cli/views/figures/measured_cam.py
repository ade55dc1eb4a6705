"""Picture of a measured cam: profile and pitch curve; its follower over the turn, with the phases that were found."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.disc_cam.measured import MeasuredCamDesign


def draw(command: str, design: MeasuredCamDesign) -> Figure:
    """The picture of a command."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.6, 1.0, 1.0, 1.0))
    t = np.linspace(0.0, 2.0 * math.pi, 1441)
    shape = made.add_subplot(grid[0])
    panels.drawing(shape, f"Profile through {len(design.residuals)} points, missed by {design.fit_max:.3g} mm at most")
    pitch = design.cam.contact(t).center
    radius = design.cam.series.at(t, 0)[0]
    angle, measured = design.points
    shape.plot(radius * np.cos(t), radius * np.sin(t), color=style.BLUE, linewidth=1.6, label="profile")
    shape.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.9, linestyle=style.CHAIN, label="pitch curve")
    points = measured * np.exp(1j * angle)
    shape.plot(points.real, points.imag, ".", color=style.ORANGE, markersize=3.0, label="points")
    style.pivot(shape, 0j)
    panels.legend_below(shape, 3)
    table = design.table("law", samples=1440)
    units = dict(zip(table.columns, table.units, strict=True))
    named = (table.columns[1], "velocity", "acceleration")
    rows = [made.add_subplot(grid[1 + k]) for k in range(3)]
    for k, (axes, name, color) in enumerate(zip(rows, named, (style.BLUE, style.GREEN, style.ORANGE), strict=True)):
        label = f"{name.replace('_', ' ')} [{units[name].replace('^2', '²')}]"
        panels.turn_panel(axes, label, "cam angle [deg]" if k == 2 else "")
        axes.plot(table["cam_angle"], table[name], color=color, linewidth=1.6)
    _shade(rows, design)
    return made


def _shade(rows: list[Axes], design: MeasuredCamDesign) -> None:
    """Shade the phases behind the motion, those that run over the end of the turn in two parts."""
    found = []
    for each in design.phases:
        start, end = math.degrees(each.start), math.degrees(each.end)
        name = each.motion
        found += [panels.Phase(name, max(start + off, 0.0), min(end + off, 360.0)) for off in (-360.0, 0.0, 360.0)]
    panels.shade(rows, [phase for phase in found if phase.end > phase.start])
