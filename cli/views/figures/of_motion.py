"""The picture of any mechanism: its links in two positions, and the motion of its output."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes.linkages import builder

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_LABELS = ("position", "velocity", "acceleration")
_SHOWN = 0.125
"""Share of the loop: where it begins links often lie in line."""
_COLORS = (style.BLUE, style.GREEN, style.PURPLE)


def draw(command: str, design: Any) -> Figure:
    """The picture of a command."""
    motion = design.moving
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.2, 1.0, 1.0, 1.0))
    build, mechanism = builder(design.kind), made.add_subplot(grid[0])
    panels.drawing(mechanism, "Mechanism after an eighth of the cycle, pale half a cycle later")
    scene = build(design, np.array([_SHOWN, _SHOWN + 0.5]))
    scene_axes.draw(mechanism, scene, ahead=build(design, np.array([_SHOWN + scene_axes.AHEAD])))
    scene_axes.lightly(mechanism, scene, 1)
    given, output = motion.input, motion.outputs[0]
    turning = given.unit == "rad"
    q = np.linspace(given.start, given.end, 721)
    for order, rate in enumerate(output.course.rates(motion, q, 2)):
        axes = made.add_subplot(grid[order + 1])
        angle = output.course.unit == "rad"
        unit = (
            ("deg" if angle else output.course.unit) if order == 0 else _per_input(output.course.unit, order, turning)
        )
        x_label = f"{given.column.replace('_', ' ')} [{'deg' if turning else 'mm'}]" if order == 2 else ""
        panels.turn_panel(axes, f"{_LABELS[order]} [{unit}]", x_label)
        if given.turns != 1:
            panels.few_ticks(axes.xaxis, 9)
        axes.set_xlim(*(math.degrees(end) if turning else end for end in (given.start, given.end)))
        axes.plot(np.degrees(q) if turning else q, np.degrees(rate) if angle and order == 0 else rate,
                  color=_COLORS[order], linewidth=1.6, label=output.name)  # fmt: skip
        if order == 0:
            panels.heading(axes, output.name.replace("_", " "))
    return made


def _per_input(unit: str, order: int, turning: bool) -> str:
    power = "" if order == 1 else "²"
    if not turning:
        return f"{unit}/mm{power}"
    return (
        "1" if unit == "rad" and order == 1 else f"{'1' if unit == 'rad' else unit}/rad{'' if unit == 'rad' else power}"
    )
