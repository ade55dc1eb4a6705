"""Scene and sheets of a geared six-bar: links and gears to scale, the output's angle, speed and acceleration.

The scene is its period, or its range there and back; a sheet says what closes it.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Positions, Seen
from gearlink.cli.views.scenes.scene import Body, Reals, Scene
from gearlink.core.machines.six_bar.design import GearedSixBar
from gearlink.core.machines.six_bar.mechanism import output
from gearlink.core.machines.six_bar.spec import LINKS, gear_bodies
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


_COLORS = ((style.BLUE, style.ORANGE, style.PURPLE), (style.GREEN, style.RED, style.PURPLE))
_FIXED_TO = {"frame": "frame", "input": "AB", "coupler_1": "BC", "coupler_2": "CD", "coupler_3": "DE", "output": "EF"}


def build(design: GearedSixBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop: straight through a period, a range there and back."""
    here = Positions.of(design, fraction)
    seen = {"output": Seen(output(design), style.BLUE)}
    return here.scene((*_gears(design, here), here.chain), seen, "output angle [deg]")


def _gears(design: GearedSixBar, here: Positions) -> list[Body]:
    """The gears of both trains, rings first."""
    found: list[tuple[bool, list[Body]]] = []
    for number, given in enumerate(design.spec.trains):
        gears = []
        for k, (link, pin) in enumerate(zip(gear_bodies(given, number + 1), given.pins, strict=True)):
            words = f"gear on {pin}" + (f", fixed to {_FIXED_TO[link]}" if link in LINKS else "")
            color, ring = _COLORS[number][k % 3], given.gears[k] < 0
            gears.append(Toothed(link, _axis(design, link, pin), color, "", words, ring, given.rim))
        bodies = train(here, design.train_meshes[number], gears)
        found += zip((each.ring for each in gears), bodies, strict=True)
    return [body for _, bodies in sorted(found, key=lambda pair: not pair[0]) for body in bodies]


def _axis(design: GearedSixBar, link: str, pin: str) -> complex | str:
    """Where a link has a gear: at a pin; at its origin, where it is that gear alone."""
    if link == FRAME:
        return complex(design.lengths[0]) if pin == "F" else 0j
    return pin if link in LINKS else 0j


_MANY = 24
"""Standstills of a curve that needs a thin line."""
_WORDS = {
    "input_length": "input AB",
    "coupler_length": "BC, CD, DE",
    "output_length": "output EF",
    "frame_length": "frame AF",
    "period_turns": "input revolutions until the motion repeats",
    "mean_ratio": "net output revolutions per input revolution",
    "output_swing": "swing of the output",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: GearedSixBar) -> Figure:
    """The sheet of a command on a geared six-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        return mesh_figure(title, [Mesh(mesh, pins, (pins[0], pins[1])) for pins, mesh in design.meshes.items()])
    charts: list[linkage.Panel] = [
        partial(_curve, name="output_angle", ylabel="output angle [deg]", order=0),
        partial(_curve, name="speed_ratio", ylabel="speed ratio", order=1),
        partial(_curve, name="acceleration_ratio", ylabel="acceleration ratio\n[1/rad]", order=2),
        _transmission,
    ]
    return linkage.sheet(title, design, partial(scene_axes.two_positions, build=build), _WORDS, charts)


def _curve(axes: Axes, design: GearedSixBar, name: str, ylabel: str, order: int) -> None:
    linkage.chart(axes, f"Output {('angle', 'speed', 'acceleration')[order]}", ylabel, "input angle [deg]", turn=False)
    linkage.standstills(axes, design.dwell_crank_angles, "output stands" if order == 0 else None)
    if order:
        axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    x, y = _closed(design, name)
    axes.plot(x, y, color=style.BLUE, linewidth=1.6 if len(design.dwell_crank_angles) < _MANY else 0.9)
    style.degrees(axes, float(x[0]), float(x[-1]))
    if order:
        time_axes.in_time(axes, design.angular_speed, order, "rad")
    elif design.dwell_crank_angles:
        panels.legend_above(axes, 1)


def _closed(design: GearedSixBar, name: str) -> tuple[Any, Any]:
    """A column over the input angle, closed where the table is that of a period."""
    table = design.table("motion")
    if design.period_turns is None:
        return table["input_angle"], table[name]
    whole = 360.0 * design.period_turns
    gain = whole * (design.mean_ratio or 0.0) if name == "output_angle" else 0.0
    return linkage.closed(table["input_angle"], whole), linkage.closed(table[name], gain)


def _transmission(axes: Axes, design: GearedSixBar) -> None:
    linkage.transmission(axes, design, xlabel="input angle [deg]", turn=False)
    style.degrees(axes, math.degrees(design.course.start), math.degrees(design.course.end))
