"""Figures of a geared five-bar: links, gears and path to scale; the function that it generates; its closing."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING

from gearlink.cli.figures import linkage, panels, style
from gearlink.core.five_bar.design import GearedFiveBar
from gearlink.core.five_bar.path_motion import PathFiveBar
from gearlink.core.gears.pair import GearPair

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINKS = ("input_length", "coupler_length", "follower_length", "output_length", "frame_length", "phase")
_PATH_FACTS = (*_LINKS, "five_bar_ratio", "min_transmission_angle", "path_width", "path_height", "path_deviation_rms")
_FUNCTION_FACTS = (*_LINKS, "coupler_ratio", "min_transmission_angle")


def draw(command: str, design: GearedFiveBar) -> Figure:
    """The figure of a command on a geared five-bar."""
    title = f"{design.spec.name}: {command}"
    meshes = list(design.meshes.items())
    if command == "gear" and all(isinstance(mesh, GearPair) for _, mesh in meshes):
        from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

        pairs = [(label, mesh) for label, mesh in meshes if isinstance(mesh, GearPair)]
        return mesh_figure(title, [Mesh(mesh, label.replace("_", "-")) for label, mesh in pairs])
    figure = panels.page(title, 0.8)
    top, bottom = linkage.two_parts(figure, 1.3)
    axes = top.add_subplot()
    if design.is_path:
        path_mechanism(axes, design)
        left, right = bottom.subplots(1, 2)
        _coordinates(left, design)
    else:
        function_mechanism(axes, design)
        left, right = bottom.subplots(1, 2)
        _function(left, design)
    _span(right, design)
    return figure


def path_mechanism(axes: Axes, design: GearedFiveBar) -> None:
    """Links and gears at input angle 0, the path of M, and the points that it shall meet."""
    from gearlink.core.linkages.dyad import close_dyad

    bar, offset = design.path_bar, design.offset
    style.drawing(axes)
    panels.heading(axes, "Mechanism at input angle 0° and the path of M")
    start, end = bar.ends(0.0)
    joint = close_dyad(start, end, bar.coupler, bar.follower, bar.assembly)
    frame, m = complex(bar.frame), bar.point(0.0, offset)
    _gears(axes, design, frame)
    data = linkage.columns(design, "path")
    whole = design.shown_turns == design.period_turns
    path = [linkage.closed(data[name]) if whole else data[name] for name in ("x", "y")]
    axes.plot(*path, color=style.GREEN, linewidth=1.8, label="path of M", zorder=3)
    target = design.spec.target
    if target is not None and target.points is not None:
        x, y = zip(*target.points, strict=True)
        axes.plot(x, y, "x", color=style.RED, markersize=7, zorder=6, label="points asked for")
    axes.fill([start.real, joint.real, m.real], [start.imag, joint.imag, m.imag], color=style.GREY, alpha=0.3, zorder=2)
    style.link(axes, [0j, start, joint, end, frame])
    axes.plot([m.real], [m.imag], "o", color=style.GREEN, markersize=6, zorder=6)
    style.pivot(axes, 0j)
    style.pivot(axes, frame)
    joints = {
        "A": (0j, (start, frame)),
        "B": (start, (0j, joint)),
        "C": (joint, (start, end)),
        "D": (end, (joint, frame)),
        "E": (frame, (end, 0j)),
    }
    if abs(m - joint) > 1e-9:
        joints["M"] = (m, (start, joint))
    linkage.letters(axes, joints)
    linkage.facts(axes, design, _PATH_FACTS)


def _gears(axes: Axes, design: GearedFiveBar, frame: complex) -> None:
    """Pitch and tip circles of the gears on A and E, and of an idler above the frame."""
    from gearlink.core.linkages.dyad import close_dyad

    gears, module = design.spec.gears, design.spec.gears.module
    one, other = gears.input or 0, gears.output or 0
    ring = max(one, other) if gears.mesh == "internal" else 0
    places = [(0j, one, style.BLUE, "input gear"), (frame, other, style.ORANGE, "output gear")]
    if gears.idler is not None:
        first, second = design.center_distance
        center = close_dyad(0j, frame, first, second, 1)
        places.append((center, gears.idler, style.PURPLE, "idler"))
    for center, teeth, color, name in places:
        sign = -1.0 if teeth == ring else 1.0
        linkage.gear(axes, center, module * teeth / 2.0, module * (teeth / 2.0 + sign), color, f"{name}, z = {teeth}")


def function_mechanism(axes: Axes, design: GearedFiveBar) -> None:
    """Links at the first input angle, lightly at the last; the planet and the fixed gear."""
    bar, gears, module = design.function_bar, design.spec.gears, design.spec.gears.module
    style.drawing(axes)
    first, last = design.input_range
    panels.heading(axes, f"Mechanism at input angle {math.degrees(first):.5g}° and, grey, {math.degrees(last):.5g}°")
    frame = complex(bar.frame)
    fixed, sign, name = (gears.ring, -1.0, "ring gear") if gears.ring else (gears.sun or 0, 1.0, "sun")
    fixed = fixed or 0
    linkage.gear(
        axes, 0j, module * fixed / 2.0, module * (fixed / 2.0 + sign), style.ORANGE, f"{name}, fixed, z = {fixed}"
    )
    for phi, color, width in ((last, style.GREY, 1.0), (first, style.BLACK, 2.2)):
        start, joint, end = cmath.rect(bar.input, phi), bar.joint(phi), bar.end(phi)
        style.link(axes, [0j, start, joint, end, frame], color=color, width=width)
    planet = gears.planet or 0
    words = f"planet on the coupler, z = {planet}"
    linkage.gear(axes, start, module * planet / 2.0, module * (planet / 2.0 + 1.0), style.BLUE, words)
    style.pivot(axes, 0j)
    style.pivot(axes, frame)
    linkage.letters(
        axes,
        {
            "A": (0j, (start, frame)),
            "B": (start, (0j, joint)),
            "C": (joint, (start, end)),
            "D": (end, (joint, frame)),
            "E": (frame, (end, 0j)),
        },
    )
    linkage.facts(axes, design, _FUNCTION_FACTS)


def _coordinates(axes: Axes, design: GearedFiveBar) -> None:
    data = linkage.columns(design, "path")
    linkage.chart(axes, "Coupler point", "x, y [mm]", "input angle [deg]", turn=False)
    angle = linkage.closed(data["input_angle"], 360.0 * design.period_turns)
    for name, color in (("x", style.BLUE), ("y", style.ORANGE)):
        axes.plot(angle, linkage.closed(data[name]), color=color, linewidth=1.6, label=name)
    panels.legend_above(axes, 2)


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
        axes.plot(*zip(*asked, strict=True), "x", color=style.RED, markersize=7, label="asked for", zorder=5)
    axes.plot(data["input_angle"], output, color=style.BLUE, linewidth=1.6, label="output")
    panels.legend_above(axes, 2)


def _span(axes: Axes, design: GearedFiveBar) -> None:
    """Distance that the dyad spans, and the limits beyond which the five-bar opens."""
    bar = design.bar
    path = isinstance(bar, PathFiveBar)
    ends = (0.0, bar.period) if isinstance(bar, PathFiveBar) else design.input_range
    square = bar.span_squared if isinstance(bar, PathFiveBar) else bar.reach_squared
    links = (bar.coupler, bar.follower) if path else (bar.follower, bar.output)
    linkage.chart(axes, "Closing", "BD [mm]" if path else "CE [mm]", "input angle [deg]", turn=False)
    angles = [ends[0] + (ends[1] - ends[0]) * i / 720.0 for i in range(721)]
    spans = [math.sqrt(max(square.value(x), 0.0)) for x in angles]
    axes.plot([math.degrees(x) for x in angles], spans, color=style.BLUE, linewidth=1.6)
    for limit, words in ((sum(links), "opens beyond"), (abs(links[0] - links[1]), None)):
        axes.axhline(limit, color=style.RED, linewidth=0.9, linestyle=linkage.DASHED, label=words)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 1)
