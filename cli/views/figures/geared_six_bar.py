"""Sheets of a geared six-bar: links and gears to scale, the output's angle, speed and acceleration, what closes it."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.geared_six_bar import build
from gearlink.core.machines.six_bar.design import GearedSixBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

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
        from gearlink.cli.views.figures.gears.mesh import Mesh, mesh_figure

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
