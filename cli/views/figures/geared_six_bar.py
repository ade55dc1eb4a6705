"""Scene and sheets of a geared six-bar: links and gears to scale, the output's angle, speed and acceleration.

The scene is its period, or its range there and back; a sheet says what closes it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    RED,
    TURN,
    Chain,
    Chart,
    Curve,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    letters,
    loop,
)
from gearlink.core.machines.six_bar.design import GearedSixBar
from gearlink.core.machines.six_bar.mechanism import output, pins
from gearlink.core.machines.six_bar.spec import LINKS
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.parts.gears.mesh.pair import GearPair


_COLORS = ((BLUE, ORANGE, PURPLE), (GREEN, RED, PURPLE))
_OWNERS = ("frame", "AB", "BC", "CD", "DE", "EF")


def build(design: GearedSixBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    phi, whole = _input_angles(design, fraction), np.linspace(design.course.start, design.course.end, 361)
    joints = pins(design, phi)
    a, b, c, d, e, f = joints
    curve, now = (np.degrees(output(design).rates(design.moving, angles, 0)[0]) for angles in (whole, phi))
    return Scene(
        parts=(*_gears(design, phi, joints), Chain(joints=(a, b, c, d, e, f))),
        marks=letters("AF", A=a, B=b, C=c, D=d, E=e, F=f),
        chart=Chart(
            "input angle [deg]",
            "output angle [deg]",
            np.degrees(whole),
            np.degrees(phi),
            (Curve("output", BLUE, curve, now),),
        ),
        readouts=(Readout("input", "°", np.degrees(phi)), Readout("output", "°", now)),
    )


def _input_angles(design: GearedSixBar, fraction: Reals) -> Reals:
    """Straight through a period; a range there and back."""
    start, end = design.course.start, design.course.end
    if design.period_turns is not None:
        return np.asarray(end * fraction)
    return np.asarray(start + (end - start) * 0.5 * (1.0 - np.cos(TURN * fraction)))


def _directions(design: GearedSixBar, phi: Reals) -> Reals:
    """Directions of all six links on the way round, the frame's from F to A first; (6, N) array."""
    links = design.moving.at(phi, 0).links
    turns = [links[name].turn.value for name in LINKS[1:]]
    return np.vstack([np.full(phi.shape, math.pi), *turns[:4], turns[4] - math.pi])


def _gears(design: GearedSixBar, phi: Reals, joints: Sequence[Points]) -> list[Part]:
    """The gears of both trains, rings first."""
    ways = _directions(design, phi)
    ends = _directions(design, _input_angles(design, loop(3)[::2]))
    found: list[tuple[bool, list[Part]]] = []
    for number, train in enumerate(design.spec.trains):
        turn, whole = ways[train.first_pin], ends[train.first_pin]
        for k, (pin, teeth) in enumerate(zip(train.pins, train.gears, strict=True)):
            mesh = design.train_meshes[number][max(k - 1, 0)]
            if k:
                carrier = (train.first_pin + k) % 6
                turn = _driven(mesh, train.gears[k - 1], ways[carrier], turn)
                whole = _driven(mesh, train.gears[k - 1], ends[carrier], whole)
            name, place = _name(design, number, k), joints["ABCDEF".index(pin)]
            turns, color = float(whole[-1] - whole[0]) / TURN, _COLORS[number][k % 3]
            index = _number(mesh, teeth, bool(k))
            found.append((teeth < 0, [*gear(mesh, index, place, turn, turns, color, "", name, train.rim)]))
    return [part for _, parts in sorted(found, key=lambda pair: not pair[0]) for part in parts]


def _number(mesh: GearPair, teeth: int, second: bool) -> int:
    """Which gear of its mesh a gear is; of an internal one the ring is the second."""
    return int(teeth < 0) if mesh.internal else int(second)


def _driven(mesh: GearPair, first: int, carrier: Reals, turn: Reals) -> Reals:
    """Place of the next gear on a link from that of the gear before it."""
    one, other = mesh.teeth
    if not mesh.internal:
        return driven_turn((one, other), carrier, turn)
    if first < 0:
        return ring_turn((-other, one), carrier, turn)
    return ring_turn((one, -other), carrier + math.pi, turn)


def _name(design: GearedSixBar, number: int, k: int) -> str:
    """A gear in a legend: its pin, and the link to which it is fixed."""
    train = design.spec.trains[number]
    if 0 < k < len(train.pins) - 1:
        return f"gear on {train.pins[k]}"
    link = train.first_pin if k == 0 else train.first_pin + len(train.pins)
    return f"gear on {train.pins[k]}, fixed to {_OWNERS[link % 6]}"


_MANY = 24
"""Standstills of a curve that needs a thin line."""
_WORDS = {
    "input_length": "input AB",
    "coupler_length": "BC, CD, DE",
    "output_length": "output EF",
    "frame_length": "frame AF",
    "period_turns": "input turns until all repeats",
    "mean_ratio": "net output revolutions per input revolution",
    "output_swing": "swing of the output",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: GearedSixBar) -> Figure:
    """The sheet of a command on a geared six-bar."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        from gearlink.cli.views.figures.gears import Mesh, mesh_figure

        return mesh_figure(title, [Mesh(mesh, pins, (pins[0], pins[1])) for pins, mesh in design.meshes.items()])
    charts: list[linkage.Panel] = [
        partial(_curve, name="output_angle", ylabel="output angle [deg]", order=0),
        partial(_curve, name="speed_ratio", ylabel="speed ratio", order=1),
        partial(_curve, name="acceleration_ratio", ylabel="acceleration ratio\n[1/rad]", order=2),
        _transmission,
    ]
    return linkage.sheet(title, design, mechanism, _WORDS, charts)


def mechanism(axes: Axes, design: GearedSixBar) -> None:
    """Links and gears at the start, lightly half a loop later."""
    scene_axes.two_positions(axes, design, build)


def _curve(axes: Axes, design: GearedSixBar, name: str, ylabel: str, order: int) -> None:
    data = linkage.columns(design, "motion")
    linkage.chart(axes, f"Output {('angle', 'speed', 'acceleration')[order]}", ylabel, "input angle [deg]", turn=False)
    linkage.standstills(axes, design.dwell_crank_angles, "output stands" if order == 0 else None)
    if order:
        axes.axhline(0.0, color=style.GREY, linewidth=0.8)
    x, y = _closed(design, data, name)
    axes.plot(x, y, color=style.BLUE, linewidth=1.6 if len(design.dwell_crank_angles) < _MANY else 0.9)
    style.degrees(axes, float(x[0]), float(x[-1]))
    if order:
        time_axes.in_time(axes, design.angular_speed, order, "rad")
    elif design.dwell_crank_angles:
        panels.legend_above(axes, 1)


def _closed(design: GearedSixBar, data: dict[str, Any], name: str) -> tuple[Any, Any]:
    """A column over the input angle, closed where the table is that of a period."""
    if design.period_turns is None:
        return np.asarray(data["input_angle"]), np.asarray(data[name])
    whole = 360.0 * design.period_turns
    gain = whole * (design.mean_ratio or 0.0) if name == "output_angle" else 0.0
    return linkage.closed(data["input_angle"], whole), linkage.closed(data[name], gain)


def _transmission(axes: Axes, design: GearedSixBar) -> None:
    x, y = _closed(design, linkage.columns(design, "motion"), "transmission_angle")
    linkage.transmission(axes, design, x, y, "input angle [deg]", turn=False)
    style.degrees(axes, float(x[0]), float(x[-1]))
