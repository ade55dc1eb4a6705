"""Sheets of a geared five-bar: links, gears and path to scale; the function that it generates; what closes it."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.geared_five_bar import build
from gearlink.core.machines.five_bar.design import GearedFiveBar
from gearlink.core.machines.five_bar.path_motion import PathFiveBar

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_WORDS = {
    "input_length": "input AB",
    "coupler_length": "coupler BC",
    "follower_length": "link CD",
    "output_length": "output DE",
    "frame_length": "frame AE",
    "phase": "output's direction at input angle 0",
    "five_bar_ratio": "output speed/input speed",
    "coupler_ratio": "coupler speed/input speed",
    "min_transmission_angle": "minimum transmission angle",
    "path_width": "path along the frame",
    "path_height": "path across the frame",
    "path_deviation_rms": "distance from the points, rms",
    "structural_error": "maximum error of the function",
    "error_extremes": "alternating extremes of that size",
}


def draw(command: str, design: GearedFiveBar) -> Figure:
    """The sheet of a command on a geared five-bar."""
    title = f"{design.spec.name}: {command}"
    meshes = list(design.meshes.items())
    if command == "gear":
        from gearlink.cli.views.figures.gears.mesh import Mesh, mesh_figure

        named = zip(meshes, _gears(design), strict=True)
        return mesh_figure(title, [Mesh(mesh, name.replace("_", "-"), two) for (name, mesh), two in named])
    if design.is_path:
        return linkage.sheet(title, design, path_mechanism, _WORDS, [_coordinates, _velocity, _transmission, _span])
    error = [_structural_error] if design.wanted is not None else []
    return linkage.sheet(title, design, function_mechanism, _WORDS, [_function, *error, _span])


def _gears(design: GearedFiveBar) -> list[tuple[str, str]]:
    """The names of both gears of each mesh, as on the mechanism; a ring is the second."""
    if not design.is_path:
        return [("2", "5" if design.spec.gears.ring is None else "ring")]
    if design.spec.gears.idler is not None:
        return [("1", "idler"), ("idler", "4")]
    return [("4", "1") if design.signed_teeth[0] < 0 else ("1", "4")]


def path_mechanism(axes: Axes, design: GearedFiveBar) -> None:
    """Links and gears at input angle 0, the path of M, and the points that it shall meet."""
    panels.heading(axes, "Mechanism at input angle 0° and the path of M")
    scene_axes.draw(axes, build(design, np.zeros(1)), ahead=build(design, np.array([scene_axes.AHEAD])))
    target = design.spec.target
    if target is not None and target.points is not None:
        look: Any = {"color": style.RED, "markersize": 7, "zorder": 6}
        axes.plot(*zip(*target.points, strict=True), "x", **look, label="required points")


def function_mechanism(axes: Axes, design: GearedFiveBar) -> None:
    """Links at the first input angle, lightly at the last; the planet and the fixed gear."""
    scene_axes.two_positions(axes, design, build)


def _coordinates(axes: Axes, design: GearedFiveBar) -> None:
    data = linkage.columns(design, "path")
    linkage.chart(axes, "Coupler point", "x, y [mm]", "input angle [deg]", turn=False)
    angle = linkage.closed(data["input_angle"], 360.0 * design.period_turns)
    for name, color in (("x", style.BLUE), ("y", style.ORANGE)):
        line: Any = "-" if name == "x" else style.LONG
        axes.plot(angle, linkage.closed(data[name]), color=color, linewidth=1.6, linestyle=line, label=name)
    _period(axes, design)
    panels.legend_above(axes, 2)


def _period(axes: Axes, design: GearedFiveBar) -> None:
    """The x axis over as many revolutions as bring the linkage home."""
    style.degrees(axes, 0.0, 360.0 * design.period_turns)


def _velocity(axes: Axes, design: GearedFiveBar) -> None:
    data = linkage.columns(design, "path")
    linkage.chart(axes, "Velocity of M", "x′, y′ [mm/rad]", "input angle [deg]", turn=False)
    angle = linkage.closed(data["input_angle"], 360.0 * design.period_turns)
    looks = (("x", style.BLUE, "-"), ("y", style.ORANGE, style.LONG))
    for name, color, line in looks:
        values = linkage.closed(data[f"{name}_velocity"])
        axes.plot(angle, values, color=color, linewidth=1.6, linestyle=line, label=f"{name}′")
    axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    _period(axes, design)
    time_axes.in_time(axes, design.angular_speed, 1, "mm")
    panels.legend_above(axes, 2)


def _transmission(axes: Axes, design: GearedFiveBar) -> None:
    data = linkage.columns(design, "path")
    angle = linkage.closed(data["input_angle"], 360.0 * design.period_turns)
    values = linkage.closed(data["transmission_angle"])
    linkage.transmission(axes, design, angle, values, "input angle [deg]", turn=False)
    _period(axes, design)


def _function(axes: Axes, design: GearedFiveBar) -> None:
    """Output over input, and the positions that are asked for."""
    data = linkage.columns(design, "function")
    linkage.chart(axes, "Function", "output angle [deg]", "input angle [deg]", turn=False)
    output = data["output_angle"]
    if design.positions is not None:
        asked = [(math.degrees(phi), math.degrees(psi)) for phi, psi in design.positions]
        inside = min(range(len(output)), key=lambda i: abs(data["input_angle"][i] - asked[0][0]))
        turns = 360.0 * round((output[inside] - asked[0][1]) / 360.0)
        output = [value - turns for value in output]
        axes.plot(*zip(*asked, strict=True), "x", color=style.RED, markersize=7, label="required", zorder=5)
    if design.wanted is not None:
        table = linkage.columns(design, "structural_error")
        turns = 360.0 * round((output[0] - table["wanted_angle"][0]) / 360.0)
        output = [value - turns for value in output]
        look: Any = {"color": style.RED, "markersize": 4, "markevery": 5, "zorder": 5}
        axes.plot(table["input_angle"], table["wanted_angle"], "x", **look, label="required")
    axes.plot(data["input_angle"], output, color=style.BLUE, linewidth=1.6, label="output")
    panels.legend_above(axes, 2)


def _structural_error(axes: Axes, design: GearedFiveBar) -> None:
    """Error of the function over its interval, magnified; its maximum values and the tolerance."""
    table, greatest = design.table("structural_error", samples=240), math.degrees(design.structural_error or 0.0)
    linkage.chart(axes, "Structural error", "error [deg]", "input angle [deg]", turn=False)
    axes.plot(table["input_angle"], table["error"], color=style.BLUE, linewidth=1.6, label="error")
    for side in (1.0, -1.0):
        words = f"±{greatest:.3g}°" if side > 0.0 else None
        axes.axhline(side * greatest, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label=words)
    for i, place in enumerate(design.structural_error_at or ()):
        look: Any = {"color": style.GREY, "linewidth": 0.6, "linestyle": style.DOTTED}
        axes.axvline(math.degrees(place), **look, label=None if i else "maximum")
    panels.legend_above(axes, 3)


def _span(axes: Axes, design: GearedFiveBar) -> None:
    """Distance that the dyad spans, and the limits beyond which the five-bar opens."""
    bar = design.bar
    path = isinstance(bar, PathFiveBar)
    ends = (0.0, bar.period) if isinstance(bar, PathFiveBar) else design.input_range
    square = bar.span_squared if isinstance(bar, PathFiveBar) else bar.reach_squared
    links = (bar.coupler, bar.follower) if path else (bar.follower, bar.output)
    linkage.chart(axes, "Span of the two links", "BD [mm]" if path else "CE [mm]", "input angle [deg]", turn=False)
    angles = [ends[0] + (ends[1] - ends[0]) * i / 720.0 for i in range(721)]
    spans = [math.sqrt(max(square.value(x), 0.0)) for x in angles]
    axes.plot([math.degrees(x) for x in angles], spans, color=style.BLUE, linewidth=1.6)
    for limit, words in ((sum(links), "limits: collinear links"), (abs(links[0] - links[1]), None)):
        axes.axhline(limit, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label=words)
    axes.set_ylim(bottom=0.0)
    if path:
        _period(axes, design)
    panels.legend_above(axes, 1)
