"""Scene and sheets of a geared five-bar: links, gears and path to scale; its function; what closes it.

The scene of a path is its whole period, that of a function its range, there and back.
"""

from __future__ import annotations

import math
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.gears import Toothed, train
from gearlink.cli.views.scenes.of_motion import Frame, Positions, Seen
from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Mark, Points, Reals, Scene, letters
from gearlink.core.machines.five_bar.design import GearedFiveBar
from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def build(design: GearedFiveBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    return _path_scene(design, fraction) if design.is_path else _function_scene(design, fraction)


def _path_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    bar, offset, here = design.path_bar, design.offset, Positions.of(design, fraction)
    m, (a, b, c, d, e) = here.at("coupler", "M"), (mark.point for mark in here.marks[:5])  # an idler has a pin too
    apart = bool(abs(offset - bar.coupler) > 1e-9)
    pins = {"A": a, "B": b, "C" if apart else "C, M": c, "D": d, "E": e}
    outline = np.array([0.0, bar.coupler, offset, 0.0])
    plate = here.body("coupler", outline, style.BLACK, width=0.5)
    path = here.body(FRAME, _path(design), style.GREEN, 0.0, width=1.5, name="path of M")
    return here.scene(
        (*_path_gears(design, here), path, plate, Chain(joints=(a, b, c, d, e)), Chain(joints=(m,), color=style.GREEN)),
        {
            "x": Seen(coordinate("coupler", "M"), style.BLUE, "mm"),
            "y": Seen(coordinate("coupler", "M", 1j), style.ORANGE, "mm"),
        },
        "coupler point M [mm]",
        marks=(*letters("AE", **pins), *([Mark(m, "M")] * apart)),
    )


def _path(design: GearedFiveBar) -> Points:
    """The path of M as its table has it, closed where the table has the whole of it."""
    table = design.table("path")
    path: Points = np.asarray(table["x"]) + 1j * np.asarray(table["y"])
    return np.append(path, path[0]) if design.shown_turns == design.period_turns else path


def _path_gears(design: GearedFiveBar, here: Positions) -> list[Body]:
    """Gears on A and E, and an idler above the frame; a ring gear is drawn first."""
    ring, rim = [z < 0 for z in design.signed_teeth], design.outer_rim(design.mesh_names[0])
    gears = [
        Toothed("input", "A", style.BLUE, "1", "input gear", ring[0], rim),
        Toothed("output", "E", style.ORANGE, "4", "output gear", ring[-1], rim),
    ]
    if len(ring) > 2:
        gears.insert(1, Toothed("idler", 0j, style.PURPLE, "idler", "idler"))
    first, *between, last = train(here, list(design.meshes.values()), gears)
    ends = [*last, *first] if ring[-1] else [*first, *last]
    return [*ends, *(body for bodies in between for body in bodies)]


def frame(design: GearedFiveBar) -> Frame:
    """The scene stands where the motion does; a function whose range closes in itself goes straight through it."""
    if not design.is_path:
        start, end = design.input_range
        ways = ((end - start) / TURN * ratio for ratio in (1.0, float(design.ratio)))
        if all(abs(turns - round(turns)) < 1e-9 for turns in ways):
            return Frame(lambda fraction: start + (end - start) * fraction, design.moving)
    return of_motion.frame(design)


def _function_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    here, ring = Positions(design.moving, frame(design).inputs(fraction)), design.spec.gears.ring is not None
    words, rim = "ring gear, fixed" if ring else "sun, fixed", design.outer_rim(design.mesh_names[0])
    gears = (
        Toothed("coupler", "B", style.BLUE, "2", "planet on the coupler"),
        Toothed(FRAME, 0j, style.ORANGE, "" if ring else "5", words, ring, rim),
    )
    planet, fixed = train(here, list(design.meshes.values()), gears)
    seen = {"output": Seen(turned("output"), style.BLUE)}
    return here.scene((*fixed, *planet, here.chain), seen, "output angle [deg]")


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
        named = zip(meshes, _gears(design), strict=True)
        return mesh_figure(title, [Mesh(mesh, name.replace("_", "-"), two) for (name, mesh), two in named])
    if design.is_path:
        charts: list[linkage.Panel] = [
            partial(_coordinates, title="Coupler point", ylabel="x, y [mm]"),
            partial(_coordinates, title="Velocity of M", ylabel="x′, y′ [mm/rad]", rates=True),
            _transmission,
            _span,
        ]
        return linkage.sheet(title, design, path_mechanism, _WORDS, charts)
    error = [_structural_error] if design.wanted is not None else []
    mechanism = partial(scene_axes.two_positions, build=build)
    return linkage.sheet(title, design, mechanism, _WORDS, [_function, *error, _span])


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
    scene_axes.turned(axes, design, build, 0.0)
    target = design.spec.target
    if target is not None and target.points is not None:
        look: Any = {"color": style.RED, "markersize": 7, "zorder": 6}
        axes.plot(*zip(*target.points, strict=True), "x", **look, label="required points")


def _coordinates(axes: Axes, design: GearedFiveBar, title: str, ylabel: str, *, rates: bool = False) -> None:
    """Both coordinates of the point M over the input angle, or their rates."""
    linkage.chart(axes, title, ylabel, "input angle [deg]", turn=False)
    table = design.table("path")
    turns = linkage.closed(table["input_angle"], 360.0 * design.period_turns)
    for name, color, line in (("x", style.BLUE, "-"), ("y", style.ORANGE, style.LONG)):
        column, words = (f"{name}_velocity", f"{name}′") if rates else (name, name)
        axes.plot(turns, linkage.closed(table[column]), color=color, linewidth=1.6, linestyle=line, label=words)
    if rates:
        axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    _period(axes, design)
    if rates:
        time_axes.in_time(axes, design.angular_speed, 1, "mm")
    panels.legend_above(axes, 2)


def _period(axes: Axes, design: GearedFiveBar) -> None:
    """The x axis over as many revolutions as bring the linkage home."""
    style.degrees(axes, 0.0, 360.0 * design.period_turns)


def _transmission(axes: Axes, design: GearedFiveBar) -> None:
    linkage.transmission(axes, design, xlabel="input angle [deg]", turn=False)
    _period(axes, design)


def _function(axes: Axes, design: GearedFiveBar) -> None:
    """Output over input, and the positions that are asked for."""
    table = design.table("function")
    linkage.chart(axes, "Function", "output angle [deg]", "input angle [deg]", turn=False)
    phi, output = table["input_angle"], table["output_angle"]
    if design.positions is not None:
        asked = [(math.degrees(phi), math.degrees(psi)) for phi, psi in design.positions]
        inside = int(np.abs(phi - asked[0][0]).argmin())
        output = output - 360.0 * round((output[inside] - asked[0][1]) / 360.0)
        axes.plot(*zip(*asked, strict=True), "x", color=style.RED, markersize=7, label="required", zorder=5)
    if design.wanted is not None:
        wanted = design.table("structural_error")
        output = output - 360.0 * round((output[0] - wanted["wanted_angle"][0]) / 360.0)
        look: Any = {"color": style.RED, "markersize": 4, "markevery": 5, "zorder": 5}
        axes.plot(wanted["input_angle"], wanted["wanted_angle"], "x", **look, label="required")
    axes.plot(phi, output, color=style.BLUE, linewidth=1.6, label="output")
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
    path, bar = design.is_path, design.bar
    (one, start), (other, end) = (("input", "B"), ("output", "D")) if path else (("coupler", "C"), ("output", "E"))
    links = (design.path_bar.coupler, bar.follower) if path else (bar.follower, bar.output)
    linkage.chart(axes, "Span of the two links", f"{start}{end} [mm]", "input angle [deg]", turn=False)
    given = design.moving.input
    here = Positions(design.moving, np.linspace(given.start, given.end, 721))
    spans = np.abs(here.at(one, start) - here.at(other, end))
    axes.plot(np.degrees(here.inputs), spans, color=style.BLUE, linewidth=1.6)
    for limit, words in ((sum(links), "limits: collinear links"), (abs(links[0] - links[1]), None)):
        axes.axhline(limit, color=style.RED, linewidth=0.9, linestyle=style.DASHED, label=words)
    axes.set_ylim(bottom=0.0)
    if path:
        _period(axes, design)
    panels.legend_above(axes, 1)
