"""Sheets of a dwell by a mutilated gear: wheel and four-bar to scale, motion over a cycle; the mesh for `gear`."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.mutilated_gear_dwell import build, mesh_scene
from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WORDS = {
    "cycle_turns": "input revolutions per cycle",
    "motion_turns": "input turns in motion",
    "dwell_turns": "input turns in the dwell",
    "driven_speed_ratio": "driven speed/input speed",
    "rocker_swing": "swing of the rocker",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: MutilatedGearDwell) -> Figure:
    """The sheet of a command on a mutilated-gear dwell."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.views.figures.gears.mesh import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("1, wheel", "2, driven"), mesh_scene(design))])
    charts = [_angles, _speeds, *([] if design.linkage is None else [_transmission])]
    return linkage.sheet(title, design, mechanism, _WORDS, charts, columns=1)


def mechanism(axes: Axes, design: MutilatedGearDwell) -> None:
    """The wheel and the driven gear at the start of a motion; lightly, the four-bar in the middle of it."""
    panels.heading(axes, "At the start of a motion")
    cycles, share = design.mutilated.cycles_to_repeat, 0.5 * design.motion_turns / design.cycle_turns
    scene = build(design, np.array([0.0, share / cycles]))
    scene_axes.draw(axes, scene, ahead=build(design, np.array([scene_axes.AHEAD])))
    if design.linkage is not None:
        scene_axes.lightly(axes, scene, 1, name="four-bar in the middle of the motion")


def _turns(axes: Axes, design: MutilatedGearDwell, title: str, ylabel: str) -> list[float]:
    """A chart over input turns with the dwell shaded; gives the turns of the table's rows."""
    linkage.chart(axes, title, ylabel, "input turns", turn=False)
    axes.axvspan(design.motion_turns, design.cycle_turns, **linkage.DWELL, label="dwell")
    axes.set_xlim(0.0, design.cycle_turns)
    return [angle / 360.0 for angle in linkage.columns(design, "motion")["input_angle"]]


def _angles(axes: Axes, design: MutilatedGearDwell) -> None:
    turns = _turns(axes, design, "Angles", "angle [deg]")
    data = linkage.columns(design, "motion")
    axes.plot(turns, data["driven_angle"], color=style.ORANGE, linewidth=1.6, label="driven gear")
    if "rocker_angle" in data:
        axes.plot(turns, data["rocker_angle"], color=style.BLUE, linewidth=1.6, label="rocker")
    panels.legend_above(axes, 3)


def _speeds(axes: Axes, design: MutilatedGearDwell) -> None:
    turns = _turns(axes, design, "Speeds, per input speed", "speed ratio")
    data = linkage.columns(design, "motion")
    axes.step(turns, data["driven_speed_ratio"], where="post", color=style.ORANGE, linewidth=1.6, label="driven gear")
    if "rocker_speed_ratio" in data:
        axes.plot(turns, data["rocker_speed_ratio"], color=style.BLUE, linewidth=1.6, label="rocker")
    time_axes.in_time(axes, design.angular_speed, 1, "rad")
    panels.legend_above(axes, 3)


def _transmission(axes: Axes, design: MutilatedGearDwell) -> None:
    """The four-bar over its own turn, which it passes in parts, one a cycle."""
    from gearlink.core.parts.linkages.dyad import acute
    from gearlink.core.parts.linkages.fourbar.position import solve

    assert design.linkage is not None, "as for the chart"
    degrees = np.arange(721) * 0.5
    states = [solve(design.linkage, math.radians(x), 0) for x in degrees.tolist()]
    angles = np.array([math.degrees(acute(state.transmission_angle)) for state in states])
    linkage.transmission(axes, design, degrees, angles, "crank angle of the four-bar [deg]")
