"""Figures of a dwell by a mutilated gear: wheel and four-bar to scale, motion over a cycle; the mesh for `gear`."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import linkage, panels, style
from gearlink.core.dwell_gears.mutilated_design import MutilatedGearDwell
from gearlink.core.linkages.fourbar import solve

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FACTS = ("cycle_turns", "motion_turns", "dwell_turns", "driven_speed_ratio", "rocker_swing", "min_transmission_angle")


def draw(command: str, design: MutilatedGearDwell) -> Figure:
    """The figure of a command on a mutilated-gear dwell."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("1, wheel", "2, driven"))])
    figure = panels.page(title, 0.85)
    top, bottom = linkage.two_parts(figure, 1.1)
    mechanism(top.add_subplot(), design)
    upper, lower = bottom.subplots(2, 1)
    _angles(upper, design)
    _speeds(lower, design)
    return figure


def mechanism(axes: Axes, design: MutilatedGearDwell) -> None:
    """The wheel with its groups, the driven gear at the start of a motion, and the four-bar on its shaft."""
    style.drawing(axes)
    panels.heading(axes, "At the start of a motion")
    gears, module = design.spec.gears, design.spec.gears.module
    wheel, driven = design.mesh.reference_radius
    center = -1j * design.mesh.center_distance if design.linkage else complex(-design.mesh.center_distance)
    toward = -center / abs(center)
    style.circle(axes, center, wheel - 1.25 * module, color=style.BLUE, linewidth=1.0)
    for k in range(gears.groups):
        start = cmath.phase(toward) + 2.0 * math.pi * k / gears.groups
        _group(axes, center, start, design)
    words = f"wheel, {gears.groups} x {gears.group_teeth} of {gears.full_teeth} teeth"
    axes.plot([], [], color=style.BLUE, linewidth=3, label=words)
    style.pivot(axes, center)
    linkage.gear(axes, 0j, driven, driven + module, style.ORANGE, f"driven gear, z = {gears.driven}")
    _four_bar(axes, design)
    linkage.facts(axes, design, _FACTS)


def _group(axes: Axes, center: complex, start: float, design: MutilatedGearDwell) -> None:
    """A group of teeth as a band from root to tip, ending where the wheel meets the driven gear next."""
    from matplotlib.patches import Wedge

    gears, module = design.spec.gears, design.spec.gears.module
    tip = design.mesh.reference_radius[0] + module
    width = 360.0 * gears.group_teeth / gears.full_teeth
    first = math.degrees(start)
    band = Wedge(
        (center.real, center.imag), tip, first, first + width, width=2.25 * module, color=style.BLUE, alpha=0.7
    )
    axes.add_patch(band)


def _four_bar(axes: Axes, design: MutilatedGearDwell) -> None:
    """The four-bar in its dwell position and, lightly, with its crank half a turn on."""
    bars, start = design.linkage, design.start_crank_angle
    if bars is None or start is None:
        style.pivot(axes, 0j)
        return
    for angle, color, width in ((start + math.pi, style.GREY, 1.0), (start, style.BLACK, 2.2)):
        pin = cmath.rect(bars.crank, angle)
        joint = bars.frame + cmath.rect(bars.rocker, solve(bars, angle).rocker_angle)
        style.link(axes, [0j, pin, joint, complex(bars.frame)], color=color, width=width)
    linkage.letters(
        axes,
        {"A": (0j, (pin,)), "B": (pin, (0j, joint)), "C": (joint, (pin, bars.frame)), "D": (bars.frame + 0j, (joint,))},
    )
    style.pivot(axes, 0j)
    style.pivot(axes, complex(bars.frame))


def _turns(axes: Axes, design: MutilatedGearDwell, title: str, ylabel: str) -> list[float]:
    """A chart over input turns with the dwell shaded; gives the turns of the table's rows."""
    linkage.chart(axes, title, ylabel, "input turns", turn=False)
    axes.axvspan(design.motion_turns, design.cycle_turns, color=linkage.DWELL, linewidth=0, zorder=0, label="dwell")
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
    panels.legend_above(axes, 3)
