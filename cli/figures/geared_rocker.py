"""Figures of a geared rocker: the mechanism at both ends of the output's swing, and the swing over a turn."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import linkage, panels, style
from gearlink.core.linkages.fourbar import solve
from gearlink.core.planet_linkages.rocker_design import GearedRocker

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FACTS = ("crank_length", "rocker_swing", "output_swing", "swing_multiple", "naive_multiple", "min_transmission_angle")
_TURN = 360.0


def draw(command: str, design: GearedRocker) -> Figure:
    """The figure of a command on a geared rocker."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    figure = panels.page(title, 0.75)
    top, bottom = linkage.two_parts(figure, 1.1)
    mechanism(top.add_subplot(), design)
    angles, speed = bottom.subplots(1, 2)
    _angles(angles, design)
    _speed(speed, design)
    return figure


def mechanism(axes: Axes, design: GearedRocker) -> None:
    """Links and gears to scale at one end of the output's swing, lightly at the other."""
    style.drawing(axes)
    panels.heading(axes, "Mechanism at both ends of the output's swing")
    style.circle(axes, 0j, design.crank_length, color=style.GREY, linewidth=0.9, linestyle=linkage.DOTTED)
    low, high = sorted(design.extreme_crank_angles, key=design.drive.angle)
    pitch, tip = design.mesh.reference_radius, design.mesh.tip_radius
    d = complex(design.frame_length)
    linkage.gear(axes, d, pitch[1], tip[1], style.ORANGE, f"gear 5, output, z = {design.output_teeth}")
    for phi, color, width in ((low, style.GREY, 1.0), (high, style.BLACK, 2.2)):
        pin = cmath.rect(design.crank_length, phi)
        joint = d + cmath.rect(design.rocker_length, solve(design.linkage, phi).rocker_angle)
        style.link(axes, [0j, pin, joint, d], color=color, width=width)
        hand = d + cmath.rect(0.9 * pitch[1], math.pi / 2.0 + design.drive.angle(phi))
        style.link(axes, [d, hand], color=style.ORANGE, width=width)
    words = f"gear 2 on the coupler, z = {design.coupler_gear_teeth}"
    linkage.gear(axes, joint, pitch[0], tip[0], style.BLUE, words)
    style.pivot(axes, 0j)
    style.pivot(axes, d)
    linkage.letters(axes, {"A": (0j, (pin, d)), "B": (pin, (0j, joint)), "C": (joint, (pin, d)), "D": (d, (joint, 0j))})
    linkage.facts(axes, design, _FACTS)


def _marks(axes: Axes, design: GearedRocker) -> None:
    for place in design.extreme_crank_angles:
        axes.axvline(math.degrees(place), color=style.GREY, linewidth=0.8, linestyle=linkage.DASHED, zorder=1)


def _angles(axes: Axes, design: GearedRocker) -> None:
    """Output and rocker, each from its place at crank angle 0."""
    data = linkage.columns(design, "motion")
    turns = linkage.closed(data["crank_angle"], _TURN)
    linkage.chart(axes, "Angles from crank angle 0", "angle [deg]")
    _marks(axes, design)
    output = linkage.closed(data["output_angle"])
    axes.plot(turns, output, color=style.ORANGE, linewidth=1.6, label="output")
    rocker = linkage.closed(data["rocker_angle"])
    axes.plot(turns, rocker - rocker[0], color=style.BLACK, linewidth=1.2, label="rocker")
    panels.legend_above(axes, 2)


def _speed(axes: Axes, design: GearedRocker) -> None:
    data = linkage.columns(design, "motion")
    linkage.chart(axes, "Output speed", "speed ratio")
    _marks(axes, design)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    turns, speed = linkage.closed(data["crank_angle"], _TURN), linkage.closed(data["speed_ratio"])
    axes.plot(turns, speed, color=style.ORANGE, linewidth=1.6)
