"""Scenes and figures of stepping drives, reducers and drives with cams: what pins bear, pressure angles."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.of_motion import Positions
from gearlink.cli.views.scenes.scene import (
    TURN,
    WHITE,
    Body,
    Chain,
    Part,
    Points,
    Reals,
    Scene,
    circle,
    loop,
    pale,
    wheel,
)
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.cam_drives.grooved import Grooved
    from gearlink.core.machines.cam_drives.linked import LinkedCams
    from gearlink.core.machines.cycloidal.design import CycloidalReducer
    from gearlink.core.machines.geneva.design import GenevaDrive, Outlines, Piece


_RIM = 2.5
"""Pin radii from the bottoms of an internal wheel's slots to its rim."""


def build_geneva(design: GenevaDrive, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution of the crank: wheel with its slots, locking disc, pins."""
    scene, here = of_motion.build(design, fraction), Positions.of(design, fraction)
    drive, pin = design.drive, design.spec.pin_radius
    parts: list[Part] = []
    wheel_look: dict[str, Any] = {"repeats": drive.slots, "width": 1.6, "name": "wheel"}
    if drive.sign < 0.0:
        rim = circle(drive.distance + drive.crank + _RIM * pin, 144)
        parts.append(here.body("wheel", rim, style.ORANGE, repeats=0))
        wheel_look["fill"] = WHITE
    parts.append(here.body("wheel", _slotted(design), style.ORANGE, **wheel_look))
    if drive.pins * drive.half < math.pi:
        parts.append(here.body("crank", _traced(_outlines(design).driver()), style.BLUE))
    pins = _round(here.at("crank"), here.turn("crank"), drive.crank, pin, drive.pins, style.GREEN)
    return replace(scene, parts=(*parts, *scene.parts, *pins))


def _outlines(design: GenevaDrive) -> Outlines:
    """Wheel and disc; a disc that the file does not give, or that is too large to be drawn, leaves some lip."""
    given, most = design.spec.locking_radius, max(design.crank_radius - design.spec.pin_radius, 1e-3)
    return design.outlines_with(min(given or max(most - 0.5 * design.spec.pin_radius, 0.5 * most), most))


def _traced(pieces: list[Piece]) -> Points:
    counts = {"slot": 2, "locking arc": 61}
    return np.concatenate([each.curve(np.linspace(each.low, each.high, counts.get(each.name, 21))) for each in pieces])


def _slotted(design: GenevaDrive) -> Points:
    """The wheel's contour, the first slot along its x axis; of an internal wheel its hollow."""
    half = _traced(_outlines(design).wheel_half())
    sector = np.concatenate([half[::-1].conj(), half])
    whole = np.concatenate([sector * np.exp(1j * TURN * k / design.spec.slots) for k in range(design.spec.slots)])
    return np.asarray([*whole, whole[0]])


def build_cycloidal(design: CycloidalReducer, fraction: Reals) -> Scene:
    """Positions over the turns of the eccentric that bring the output home: ring pins, discs, output pins."""
    scene, here = of_motion.build(design, fraction), Positions.of(design, fraction)
    spec, disc, axis = design.spec, design.disc, here.at("eccentric")
    ring, flange = ("output", FRAME) if spec.fixed == "output" else (FRAME, "output")
    given, hole, parts = spec.output_pins, design.output_hole_radius, list[Part]()
    outline = disc.ground(*design.changes).profile(np.linspace(0.0, TURN, 48 * disc.pins + 1))[0]
    colors = (style.ORANGE, style.BLUE, style.GREEN)[: spec.discs]
    for k, color in zip(range(spec.discs, 0, -1), reversed(colors), strict=True):
        parts.append(here.body(f"disc_{k}", outline, color, name=f"disc {k}"))
        if hole is not None and given is not None and k == 1:
            parts += _round(here.at("disc_1"), here.turn(flange), given.circle_radius, hole, given.count, color)
    parts += _round(axis, here.turn(ring), disc.circle, disc.pin, disc.pins, style.GREY)
    if given is not None:
        parts += _round(axis, here.turn(flange), given.circle_radius, given.radius, given.count, style.GREEN)
    return replace(scene, parts=(*parts, *(each for each in scene.parts if isinstance(each, Chain))))


def _round(center: Points, turn: Reals, circle_radius: float, radius: float, count: int, color: str) -> list[Part]:
    """Equal circles on a circle that turns."""
    around = circle(radius, 36)
    return [
        Body(outline=around, place=center + circle_radius * np.exp(1j * (turn + TURN * k / count)),
             turn=np.zeros_like(turn), color=color, fill=pale(color, 0.4), repeats=0)
        for k in range(count)
    ]  # fmt: skip


def build_grooved(design: Grooved, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution of the input: the links, the roller, and both walls of its groove."""
    scene, here, groove = of_motion.build(design, fraction), Positions.of(design, fraction), design.groove
    inner, outer = groove.walls(np.linspace(0.0, TURN, 721))
    walls = here.body(FRAME, outer, style.GREY, 0.18, name="groove"), here.body(FRAME, inner, style.GREY, fill=WHITE)
    look = {"color": style.GREEN, "fill": pale(style.GREEN, 0.4), "name": "roller"}
    roller = wheel(groove.path(here.inputs).place, groove.roller_radius, fraction, **look)
    kept = tuple(each for each in scene.parts if getattr(each, "name", "") != "groove" and not _is_block(each))
    return replace(scene, parts=(*walls, *kept, roller))


def _is_block(part: Part) -> bool:
    """The block that the generic scene draws about the pin of a slot."""
    return isinstance(part, Body) and not part.name and len(part.outline) == 5


def build_linked_cams(design: LinkedCams, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution: both cams, their rollers, and the table on its path."""
    scene, here = of_motion.build(design, fraction), Positions.of(design, fraction)
    parts: list[Part] = []
    for cam, color, name, way in zip(design.cams, (style.BLUE, style.ORANGE), ("x", "y"), (1.0, 1j), strict=True):
        parts.append(here.body("cam", cam.points(np.linspace(0.0, TURN, 721))[1], color, 0.2, name=f"{name} cam"))
        at = here.at(f"slide_{name}")
        parts.append(wheel(at, cam.roller_radius, fraction, color=color, fill=pale(color, 0.5)))
        parts.append(Chain(joints=(at, at + 4.0 * way * cam.roller_radius), color=color, marked=False))
    path, look = Positions.of(design, loop(721)).at("table"), {"color": style.GREEN, "fill": pale(style.GREEN, 0.5)}
    parts.append(here.body(FRAME, path, style.GREEN, 0.0, name="path", width=1.6))
    parts.append(wheel(here.at("table"), 0.5 * design.cams[0].roller_radius, fraction, **look, name="table"))
    return replace(scene, parts=tuple(parts))


def cycloidal(command: str, design: CycloidalReducer) -> Figure:
    """The reducer with its eccentric at 0, the levers, forces and gaps of its pins, and the profile's curvature."""
    made, (drawing, levers, forces, axes) = panels.stack(f"{design.spec.name}: {command}", (2.4, 1.0, 1.0, 1.0))
    panels.drawing(drawing, "Discs and pins, eccentric at 0")
    scene_axes.draw(drawing, build_cycloidal(design, np.array([0.0])))
    table, disc = design.table("pins"), design.disc
    u = np.linspace(0.0, 360.0, 721)
    lever = np.abs(disc.lever(np.radians(u)))
    at, title = table["angle"], "Lever arms of the pins about the centre of the disc"
    _pins(levers, title, "lever [mm]", u, lever, at, table["lever"])
    if "force" in table.columns:
        title = "Forces of the ring pins on the most loaded disc"
        _pins(forces, title, "force [N]", u, None, at, table["force"])
    else:
        gaps = 1000.0 * disc.gap(np.radians(u), *design.changes)
        _pins(forces, "Gaps at the pins", "gap [µm]", u, gaps, at, 1000.0 * table["gap"])
    title = "Curvature of the pitch curve, and that of a pin"
    panels.turn_panel(axes, "curvature [1/mm]", "angle from the eccentricity to the pin [deg]", title)
    axes.plot(u, disc.curvature(np.radians(u)), color=style.GREEN, linewidth=1.5)
    axes.axhline(1.0 / disc.pin, color=style.BLACK, linewidth=0.9, linestyle=style.DASHED)
    return made


def _pins(axes: Axes, title: str, label: str, u: Any, curve: Any, at: Any, values: Any) -> None:
    panels.turn_panel(axes, label, title=title)
    if curve is not None:
        axes.plot(u, curve, color=style.BLUE, linewidth=1.2)
    axes.vlines(at, 0.0, values, color=style.BLUE, linewidth=1.0)
    axes.plot(at, values, "o", color=style.BLUE, markersize=4.5)


def grooved(command: str, design: Grooved) -> Figure:
    """The drive at a few degrees, output and speed over the input, pressure angle and curvature in the groove."""
    made, (drawing, *rows) = panels.stack(f"{design.spec.name}: {command}", (2.6, 1.0, 1.0, 1.0, 1.0))
    panels.drawing(drawing, "Mechanism at input angle 30°, and the groove")
    scene_axes.turned(drawing, design, build_grooved, 1.0 / 12.0)
    degrees = np.linspace(0.0, 360.0, 721)
    theta = np.radians(degrees)
    output, speed, _ = design.output_motion.evaluate(theta, 2)
    groove, limit = design.groove, design.spec.limits.pressure_angle
    shown = (
        ("output [deg]", np.degrees(output), style.BLUE, "Output"),
        ("speed ratio [1]", speed, style.GREEN, "Output speed over input speed"),
        ("pressure\nangle [deg]", np.degrees(groove.pressure_angle(theta)), style.RED, "Pressure angle in the groove"),
        ("curvature [1/mm]", groove.curvature(theta), style.PURPLE, "Curvature of path and roller"),
    )
    for row, (axes, (label, values, color, title)) in enumerate(zip(rows, shown, strict=True), 1):
        panels.turn_panel(axes, label, "input angle [deg]" if row == len(shown) else "", title=title)
        axes.plot(degrees, values, color=color, linewidth=1.5)
        lines = {3: (limit, -limit), 4: (1.0 / groove.roller_radius, -1.0 / groove.roller_radius)}.get(row, ())
        for line in lines:
            axes.axhline(line, color=style.BLACK, linewidth=0.9, linestyle=style.DASHED)
    return made


def linked_cams(command: str, design: LinkedCams) -> Figure:
    """Cams, rollers and path, the lifts, and the pressure angles of both cams."""
    heights = (2.6, 1.0, 1.2, 1.2)
    made, (drawing, axes, pressure, bends) = panels.stack(f"{design.spec.name}: {command}", heights)
    panels.drawing(drawing, "Cams and path at input angle 30°")
    scene_axes.draw(drawing, build_linked_cams(design, np.array([1.0 / 12.0])))
    degrees = np.linspace(0.0, 360.0, 721)
    panels.turn_panel(axes, "position [mm]", title="Coordinates of the path")
    for axis, (name, color) in enumerate((("x", style.BLUE), ("y", style.ORANGE))):
        values = design.coordinate(axis, np.radians(degrees), 0)[0]
        axes.plot(degrees, values, color=color, linewidth=1.5, label=name)
    panels.legend_above(axes)
    panels.pressure_angles(pressure, design.cams, design.spec.limits.pressure_angle, "")
    panels.curvatures(bends, design.cams, "input angle [deg]")
    return made
