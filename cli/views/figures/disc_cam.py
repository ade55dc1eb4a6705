"""Picture of a disc cam: the profile with its pitch curve and follower; lift, velocity, acceleration, jerk."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes.disc_cam import build

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.machines.disc_cam.design import DiscCamDesign

_LABELS = ("lift", "velocity", "acceleration", "jerk")
_COLORS = (style.BLUE, style.GREEN, style.ORANGE, style.PURPLE)
_SHOWN = 0.125


def draw(command: str, design: DiscCamDesign) -> Figure:
    """The picture of a command."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(5, 1, height_ratios=(3.2, 1.0, 1.0, 1.0, 1.0))
    outline = made.add_subplot(grid[0])
    panels.drawing(outline, "Cam and follower an eighth of a revolution after cam angle 0")
    scene = build(design, np.array([_SHOWN]))
    scene_axes.draw(outline, scene, ahead=build(design, np.array([_SHOWN + scene_axes.AHEAD])))
    phi = np.linspace(0.0, 2.0 * math.pi, 1441)
    rates = design.cams.motion.evaluate(phi, 3)
    rates[:] = [np.where(phi == phi[-1], design.cams.motion.evaluate(phi, 3, side=-1)[n], rates[n]) for n in range(4)]
    unit = "rad" if design.spec.oscillates else "mm"
    for order, (label, color) in enumerate(zip(_LABELS, _COLORS, strict=True)):
        axes = made.add_subplot(grid[order + 1])
        power = ("", "/rad", "/rad²", "/rad³")[order]
        shown = "deg" if unit == "rad" and order == 0 else f"{unit}{power}"
        panels.turn_panel(axes, f"{label} [{shown}]", "cam angle [deg]" if order == 3 else "")
        values = np.degrees(rates[order]) if unit == "rad" and order == 0 else rates[order]
        axes.plot(np.degrees(phi), values, color=color, linewidth=1.6)
    return made
