"""Scene and sheets of a geared five-bar: links, gears and path to scale; its function; what closes it.

The scene of a path is its whole period, that of a function its range, there and back.
"""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.scene import (
    BLACK,
    BLUE,
    GREEN,
    ORANGE,
    PURPLE,
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    letters,
    loop,
    pale,
    standing,
    track,
)
from gearlink.core.machines.five_bar.design import GearedFiveBar
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn
from gearlink.core.parts.linkages.dyad import close_dyad

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.parts.gears.mesh.pair import GearPair


_PINS = (("input", "A"), ("coupler", "B"), ("coupler", "C"), ("output", "D"), ("output", "E"))


def build(design: GearedFiveBar, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    return _path_scene(design, fraction) if design.is_path else _function_scene(design, fraction)


def _path_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    bar, offset = design.path_bar, design.offset
    phi, whole = bar.period * fraction, bar.period * loop(361)
    links = design.moving.at(phi, 0).links
    coupler = links["coupler"]
    a, b, c, d, e = (links[link].at(pin).value for link, pin in _PINS)
    m, path = coupler.at("M").value, design.moving.at(whole, 0).links["coupler"].at("M").value
    apart = bool(abs(offset - bar.coupler) > 1e-9)
    plate = Body(
        outline=np.array([0.0, bar.coupler, offset, 0.0]),
        place=b,
        turn=coupler.turn.value,
        color=BLACK,
        width=0.5,
        fill=pale(BLACK, 0.25),
    )
    return Scene(
        parts=(
            *_path_gears(design, phi, fraction),
            standing(_path(design), fraction, GREEN, "path of M"),
            plate,
            Chain(joints=(a, b, c, d, e)),
            Chain(joints=(m,), color=GREEN),
        ),
        marks=(
            *letters("AE", **{"A": a, "B": b, "C" if apart else "C, M": c, "D": d, "E": e}),
            *([Mark(m, "M")] * apart),
        ),
        chart=Chart(
            "input angle [deg]",
            "coupler point M [mm]",
            np.degrees(whole),
            np.degrees(phi),
            (Curve("x", BLUE, path.real, m.real), Curve("y", ORANGE, path.imag, m.imag)),
        ),
        readouts=(Readout("input", "°", np.degrees(phi)), Readout("x", " mm", m.real), Readout("y", " mm", m.imag)),
    )


def _path(design: GearedFiveBar) -> Points:
    """The path of M as its table has it, closed where the table has the whole of it."""
    table = design.table("path")
    x, y = (np.asarray(table.data[table.columns.index(name)]) for name in ("x", "y"))
    path: Points = x + 1j * y
    return np.append(path, path[0]) if design.shown_turns == design.period_turns else path


def _path_gears(design: GearedFiveBar, phi: Reals, fraction: Reals) -> list[Part]:
    """Gears on A and E, and an idler above the frame; a ring gear is drawn first."""
    bar, period = design.path_bar, design.path_bar.period_turns
    a, e = track(0.0, fraction), track(bar.frame, fraction)
    first, *more = design.meshes.values()
    level, turned = np.zeros_like(phi), period * float(bar.ratio)

    def on_input(mesh: GearPair, number: int) -> list[Body]:
        return gear(mesh, number, a, phi, period, BLUE, "1", "input gear", design.outer_rim(design.mesh_names[0]))

    def on_output(mesh: GearPair, number: int, turn: Reals) -> list[Body]:
        return gear(mesh, number, e, turn, turned, ORANGE, "4", "output gear", design.outer_rim(design.mesh_names[0]))

    if first.internal:
        pinion, ring = (abs(z) for z in first.teeth)
        if design.signed_teeth[0] < 0:
            return [*on_input(first, 1), *on_output(first, 0, ring_turn((ring, pinion), level, phi))]
        return [*on_output(first, 1, ring_turn((pinion, ring), level + math.pi, phi)), *on_input(first, 0)]
    if not more:
        return [*on_input(first, 0), *on_output(first, 1, driven_turn(first.teeth, level, phi))]
    (second,), (near, far) = more, design.center_distance
    idler = close_dyad(0j, complex(bar.frame), near, far, design.spec.gears.idler_side)
    middle = driven_turn(first.teeth, level + cmath.phase(idler), phi)
    turn = driven_turn((second.teeth[0], second.teeth[1]), level + cmath.phase(bar.frame - idler), middle)
    idler_turns, place = -period * first.teeth[0] / first.teeth[1], track(idler, fraction)
    between = gear(first, 1, place, middle, idler_turns, PURPLE, "idler", "idler")
    return [*on_input(first, 0), *on_output(second, 1, turn), *between]


def _input_angles(design: GearedFiveBar, fraction: Reals) -> Reals:
    """Input angles of a function: straight through where its range closes in itself, else there and back."""
    start, end = design.input_range
    turns = (end - start) / TURN
    wound = turns * float(design.ratio)
    if max(abs(turns - round(turns)), abs(wound - round(wound))) < 1e-9:
        return start + (end - start) * fraction
    return np.asarray(start + (end - start) * 0.5 * (1.0 - np.cos(TURN * fraction)))


def _function_scene(design: GearedFiveBar, fraction: Reals) -> Scene:
    phi = _input_angles(design, fraction)
    links = design.moving.at(phi, 0).links
    a, b, c, d, e = (links[link].at(pin).value for link, pin in _PINS)
    whole = np.linspace(*design.input_range, 361)
    output = np.array(design.function_bar.output_angles(whole.tolist()))
    # The curve tells the turn, the mechanism the angle itself.
    raw = np.angle(d - e)
    now = raw + TURN * np.round((np.interp(phi, whole, output) - raw) / TURN)
    return Scene(
        parts=(*_function_gears(design, phi, a, b), Chain(joints=(a, b, c, d, e))),
        marks=letters("AE", A=a, B=b, C=c, D=d, E=e),
        chart=Chart(
            "input angle [deg]",
            "output angle [deg]",
            np.degrees(whole),
            np.degrees(phi),
            (Curve("output", BLUE, np.degrees(output), np.degrees(now)),),
        ),
        readouts=(Readout("input", "°", np.degrees(phi)), Readout("output", "°", np.degrees(now))),
    )


def _function_gears(design: GearedFiveBar, phi: Reals, a: Points, b: Points) -> list[Part]:
    """The gear that is fixed to the frame, and the planet that rolls on it, or in it."""
    (mesh,) = design.meshes.values()
    planet, fixed = (abs(z) for z in mesh.teeth)
    still, internal = np.zeros_like(phi), mesh.internal
    turn = ring_turn((fixed, planet), phi, still) if internal else driven_turn((fixed, planet), phi, still)
    there_and_back = float(abs(_input_angles(design, np.ones(1))[0] - _input_angles(design, np.zeros(1))[0]))
    turns = there_and_back / TURN * float(design.ratio)
    return [
        *gear(
            mesh,
            1,
            a,
            still,
            0.0,
            ORANGE,
            "" if internal else "5",
            "ring gear, fixed" if internal else "sun, fixed",
            design.outer_rim(design.mesh_names[0]),
        ),
        *gear(mesh, 0, b, turn, turns, BLUE, "2", "planet on the coupler"),
    ]


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
        from gearlink.cli.views.figures.gears import Mesh, mesh_figure

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
