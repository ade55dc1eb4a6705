"""Picture of a cylindrical cam: the track developed at the bottom; lift, velocity, acceleration, jerk."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.cylindrical_cam.design import CylindricalCamDesign

_LABELS = ("lift [mm]", "velocity [mm/rad]", "acceleration [mm/rad²]", "jerk [mm/rad³]")
_COLORS = (style.BLUE, style.GREEN, style.ORANGE, style.PURPLE)


def draw(command: str, design: CylindricalCamDesign) -> Figure:
    """The picture of a command."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(5, 1, height_ratios=(1.8, 1.0, 1.0, 1.0, 1.0))
    phi, drum = np.linspace(0.0, 2.0 * math.pi * (1.0 - 1e-9), 1441), design.drum
    track = made.add_subplot(grid[0])
    panels.drawing(track, f"Track developed at its bottom, radius {drum.bottom:.6g} mm")
    for side, color, width in ((0, style.GREY, 0.9), (1, style.BLUE, 1.6), (-1, style.BLUE, 1.6)):
        track.plot(*drum.developed(drum.bottom, side, phi), color=color, linewidth=width)
    for order, rate in enumerate(design.follower_motion.evaluate(phi, 3)):
        axes = made.add_subplot(grid[order + 1])
        panels.turn_panel(axes, _LABELS[order], "cam angle [deg]" if order == 3 else "")
        axes.plot(np.degrees(phi), rate, color=_COLORS[order], linewidth=1.6)
    return made
