"""Figures of a two-gear four-bar: the mechanism where the output stands, and its output over a turn."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import linkage, panels, style
from gearlink.core.gears.pair import GearPair
from gearlink.core.linkages.fourbar import solve
from gearlink.core.planet_linkages.two_gear_design import TwoGearFourBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_FACTS = (
    "crank_length",
    "frame_length",
    "gear_ratio",
    "standstill_coupler_ratio",
    "dwell_teeth_ratio",
    "dwell_crank_angles",
    "back_step_angle",
    "min_transmission_angle",
)
_TURN = 360.0


def draw(command: str, design: TwoGearFourBar) -> Figure:
    """The figure of a command on a two-gear four-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear" and isinstance(design.mesh, GearPair):
        from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    figure = panels.page(title, 0.85)
    top, bottom = linkage.two_parts(figure, 1.1)
    mechanism(top.add_subplot(), design)
    (upper, speed), (lower, coupler) = bottom.subplots(2, 2)
    _output(upper, design)
    _curve(speed, design, "Output speed", "speed ratio", "speed_ratio")
    _curve(lower, design, "Output acceleration", "acceleration ratio\n[1/rad]", "acceleration_ratio")
    _curve(coupler, design, "Coupler speed", "w2/w1", "coupler_ratio")
    coupler.axhline(design.standstill_coupler_ratio, color=style.RED, linewidth=0.9, linestyle=linkage.DASHED)
    return figure


def mechanism(axes: Axes, design: TwoGearFourBar) -> None:
    """Links and gears to scale where the output stands, or is slowest; the pitch point lies on the line CD there."""
    places = design.dwell_crank_angles
    phi = places[0] if places else design.speed_ratio_min_at
    words = "standstill" if places else "least output speed"
    style.drawing(axes)
    panels.heading(axes, f"Mechanism at the {words}, crank angle {math.degrees(phi):.5g}°")
    state = solve(design.linkage, phi)
    pin = cmath.rect(design.crank_length, phi)
    d = complex(design.frame_length)
    joint = d + cmath.rect(design.rocker_length, state.rocker_angle)
    pitch, tip = design.mesh.reference_radius, design.mesh.tip_radius
    name = "ring gear" if design.internal else "sun"
    linkage.gear(axes, 0j, pitch[1], tip[1], style.ORANGE, f"gear 5, {name}, z = {design.output_teeth}")
    linkage.gear(axes, pin, pitch[0], tip[0], style.BLUE, f"gear 2, planet on BC, z = {design.planet_teeth}")
    pole = cmath.rect(pitch[1], phi)
    axes.plot([pole.real], [pole.imag], "D", color=style.RED, markersize=5, zorder=7, label="pitch point of the gears")
    far = d + 1.15 * (pole - d)
    axes.plot([joint.real, far.real], [joint.imag, far.imag], color=style.RED, linewidth=0.8, linestyle=linkage.DASHED)
    style.link(axes, [0j, pin, joint, d])
    style.pivot(axes, 0j)
    style.pivot(axes, d)
    linkage.letters(axes, {"A": (0j, (pin, d)), "B": (pin, (0j, joint)), "C": (joint, (pin, d)), "D": (d, (joint, 0j))})
    linkage.facts(axes, design, _FACTS)


def _curve(axes: Axes, design: TwoGearFourBar, title: str, ylabel: str, name: str) -> None:
    data = linkage.columns(design, "motion")
    linkage.chart(axes, title, ylabel)
    _marks(axes, design)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.plot(linkage.closed(data["crank_angle"], _TURN), linkage.closed(data[name]), color=style.BLUE, linewidth=1.6)


def _output(axes: Axes, design: TwoGearFourBar) -> None:
    data = linkage.columns(design, "motion")
    linkage.chart(axes, "Output angle", "output angle [deg]")
    _marks(axes, design)
    turns = linkage.closed(data["crank_angle"], _TURN)
    output = linkage.closed(data["output_angle"], _TURN * design.mean_ratio)
    axes.plot(turns, output, color=style.BLUE, linewidth=1.6, label="output")
    ends = [0.0, _TURN * design.mean_ratio]
    axes.plot([0.0, _TURN], ends, color=style.GREY, linewidth=0.9, linestyle=linkage.DOTTED, label="mean")
    panels.legend_above(axes, 2)


def _marks(axes: Axes, design: TwoGearFourBar) -> None:
    """Back-steps shaded, standstills as lines."""
    for step in design.back_steps:
        phase = panels.Phase("dwell", math.degrees(step.start), math.degrees(step.end))
        for start, end in phase.within_turn():
            axes.axvspan(start, end, color=linkage.BACKWARD, linewidth=0, zorder=0)
    for place in design.dwell_crank_angles:
        axes.axvline(math.degrees(place), color=style.GREY, linewidth=0.8, linestyle=linkage.DASHED, zorder=1)
