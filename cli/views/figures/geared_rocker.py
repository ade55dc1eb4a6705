"""Scene and sheets of a geared rocker, over one revolution of the crank: both ends of the output's swing, the swing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.linkages import Joints, coupler_windings, crank_readout, over_crank, whole_turn
from gearlink.cli.views.scenes.scene import BLACK, BLUE, ORANGE, TURN, Body, Curve, Readout, Reals, Scene, fixed_circle
from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: GearedRocker, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; a hand on the output shows its swing."""
    phi = TURN * fraction
    at, output = Joints.of(design.moving, phi), _turn(design, phi)
    wound = coupler_windings(design.moving)
    reach = design.mesh.tip_radius[1]
    start, whole = _turn(design, np.zeros(1))[0], _turn(design, whole_turn())
    tip = np.array([0.0, 1.7 * reach * 1j])
    hand = Body(outline=tip, place=at.d, turn=output - start, color=ORANGE, width=5.0, name="hand on the output")
    rocker = Joints.of(design.moving, whole_turn()).rocker
    return Scene(
        parts=(
            *gear(design.mesh, 1, at.d, output, wound, ORANGE, "5", "gear 5, output"),
            *gear(design.mesh, 0, at.c, at.coupler, wound, BLUE, "2", "gear 2 on the coupler"),
            hand,
            fixed_circle(0j, design.crank_length),
            at.chain(),
        ),
        marks=at.marks(),
        chart=over_crank(
            phi,
            (
                Curve("output", ORANGE, np.degrees(whole - start), np.degrees(output - start)),
                Curve("rocker", BLACK, np.degrees(rocker - rocker[0]), np.degrees(at.rocker - rocker[0])),
            ),
            "angle from crank angle 0 [deg]",
        ),
        readouts=(crank_readout(phi), Readout("output", "°", np.degrees(output - start))),
    )


def _turn(design: GearedRocker, phi: Reals) -> Reals:
    at, teeth = Joints.of(design.moving, phi), design.mesh.teeth
    return driven_turn((teeth[0], teeth[1]), at.rocker + math.pi, at.coupler)


_WORDS = {
    "crank_length": "crank AB",
    "coupler_length": "coupler BC",
    "rocker_length": "rocker CD",
    "frame_length": "frame AD",
    "rocker_swing": "swing of the rocker",
    "output_swing": "swing of the output",
    "swing_multiple": "output swing/rocker swing",
    "naive_multiple": "1 + z₂/z₅",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: GearedRocker) -> Figure:
    """The sheet of a command on a geared rocker."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.views.figures.gears import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(design.mesh, "", ("2", "5"))])
    return linkage.sheet(title, design, mechanism, _WORDS, [_angles, linkage.over_crank, _speed, _acceleration])


def mechanism(axes: Axes, design: GearedRocker) -> None:
    """Links and gears to scale at one end of the output's swing, lightly at the other."""
    panels.heading(axes, "Mechanism at both ends of the output's swing")
    low, high = sorted(design.extreme_crank_angles, key=design.drive.angle)
    scene = build(design, np.array([high, low]) / (2.0 * math.pi))
    scene_axes.draw(axes, scene, ahead=build(design, np.array([high / (2.0 * math.pi) + scene_axes.AHEAD])))
    scene_axes.lightly(axes, scene, 1, name=f"other end, crank angle {math.degrees(low):.5g}°")


def _angles(axes: Axes, design: GearedRocker) -> None:
    """Output and rocker, each from its place at crank angle 0."""
    linkage.chart(axes, "Angles from crank angle 0", "angle [deg]")
    linkage.standstills(axes, design.extreme_crank_angles)
    axes.plot(*linkage.over_turn(design, "output_angle"), color=style.ORANGE, linewidth=1.6, label="output")
    turns, rocker = linkage.over_turn(design, "rocker_angle")
    axes.plot(turns, rocker - rocker[0], color=style.BLACK, linewidth=1.2, label="rocker")
    panels.legend_above(axes, 2)


def _speed(axes: Axes, design: GearedRocker) -> None:
    linkage.chart(axes, "Output speed", "speed ratio")
    linkage.standstills(axes, design.extreme_crank_angles)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.plot(*linkage.over_turn(design, "speed_ratio"), color=style.ORANGE, linewidth=1.6)
    time_axes.in_time(axes, design.angular_speed, 1, "rad")


def _acceleration(axes: Axes, design: GearedRocker) -> None:
    linkage.chart(axes, "Output acceleration", "acceleration ratio\n[1/rad]")
    linkage.standstills(axes, design.extreme_crank_angles)
    axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    axes.plot(*linkage.over_turn(design, "acceleration_ratio"), color=style.ORANGE, linewidth=1.6)
    time_axes.in_time(axes, design.angular_speed, 2, "rad")
