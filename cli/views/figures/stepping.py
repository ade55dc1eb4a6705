"""Scenes and figures of stepping drives, reducers and drives with cams: what pins bear, pressure angles."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.scene import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    TURN,
    Body,
    Chain,
    Part,
    Points,
    Reals,
    Scene,
    circle,
    pale,
)

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
    scene = of_motion.build(design, fraction)
    links = design.moving.at(of_motion.inputs(design.moving.input, fraction), 0).links
    drive, pin = design.drive, design.spec.pin_radius
    center, turn = links["wheel"].origin.value, links["wheel"].turn.value
    parts: list[Part] = []
    fill = pale(ORANGE, 0.25)
    if drive.sign < 0.0:
        rim = circle(drive.distance + drive.crank + _RIM * pin, 144)
        parts.append(Body(outline=rim, place=center, turn=turn, color=ORANGE, fill=fill, repeats=0))
        fill = "#FFFFFF"
    parts.append(Body(outline=_slotted(design), place=center, turn=turn, color=ORANGE, fill=fill,
                      repeats=drive.slots, width=1.6, name="wheel"))  # fmt: skip
    crank, angle = links["crank"].origin.value, links["crank"].turn.value
    if drive.pins * drive.half < math.pi:
        parts.append(
            Body(
                outline=_traced(_outlines(design).driver()), place=crank, turn=angle, color=BLUE, fill=pale(BLUE, 0.25)
            )
        )
    pins = [
        Body(outline=circle(pin, 36), place=crank + drive.crank * np.exp(1j * (angle + k * TURN / drive.pins)),
             turn=np.zeros_like(angle), color=GREEN, fill=pale(GREEN, 0.4), repeats=0)
        for k in range(drive.pins)
    ]  # fmt: skip
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
    scene = of_motion.build(design, fraction)
    links = design.moving.at(of_motion.inputs(design.moving.input, fraction), 0).links
    spec, disc = design.spec, design.disc
    still, axis = np.zeros_like(fraction), links["eccentric"].origin.value
    output = links["output"].turn.value
    held = spec.fixed == "output"
    ring, flange = (output, still) if held else (still, output)
    parts: list[Part] = []
    outline = disc.ground(*design.changes).profile(np.linspace(0.0, TURN, 48 * disc.pins + 1))[0]
    for k, color in zip(range(spec.discs, 0, -1), (ORANGE, BLUE, GREEN)[: spec.discs][::-1], strict=True):
        link = links[f"disc_{k}"]
        parts.append(Body(outline=outline, place=link.origin.value, turn=link.turn.value, color=color,
                          fill=pale(color, 0.25), name=f"disc {k}"))  # fmt: skip
        hole = design.output_hole_radius
        if hole is not None and spec.output_pins is not None and k == 1:
            parts += _round(link.origin.value, flange, spec.output_pins.circle_radius, hole,
                            spec.output_pins.count, color)  # fmt: skip
    parts += _round(axis, ring, disc.circle, disc.pin, disc.pins, GREY)
    if (given := spec.output_pins) is not None:
        parts += _round(axis, flange, given.circle_radius, given.radius, given.count, GREEN)
    return replace(scene, parts=(*parts, *(each for each in scene.parts if isinstance(each, Chain))))


def _round(center: Points, turn: Reals, circle_radius: float, radius: float, count: int, color: str) -> list[Part]:
    """Equal circles on a circle that turns."""
    around = circle(radius, 24)
    return [
        Body(outline=around, place=center + circle_radius * np.exp(1j * (turn + TURN * k / count)),
             turn=np.zeros_like(turn), color=color, fill=pale(color, 0.4), repeats=0)
        for k in range(count)
    ]  # fmt: skip


def build_grooved(design: Grooved, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution of the input: the links, the roller, and both walls of its groove."""
    scene = of_motion.build(design, fraction)
    theta, groove = TURN * fraction, design.groove
    still, axis = np.zeros_like(fraction), np.zeros(fraction.shape, dtype=np.complex128)
    whole = np.linspace(0.0, TURN, 721)
    inner, outer = groove.walls(whole)
    walls = [
        Body(outline=outer, place=axis, turn=still, color=GREY, fill=pale(GREY, 0.18), name="groove"),
        Body(outline=inner, place=axis, turn=still, color=GREY, fill="#FFFFFF"),
    ]
    roller = Body(outline=circle(groove.roller_radius, 36), place=groove.path(theta).place, turn=still, color=GREEN,
                  fill=pale(GREEN, 0.4), repeats=0, name="roller")  # fmt: skip
    kept = tuple(each for each in scene.parts if getattr(each, "name", "") != "groove" and not _is_block(each))
    return replace(scene, parts=(*walls, *kept, roller))


def _is_block(part: Part) -> bool:
    """The block that the generic scene draws about the pin of a slot."""
    return isinstance(part, Body) and not part.name and len(part.outline) == 5


def build_linked_cams(design: LinkedCams, fraction: Reals) -> Scene:
    """Positions over fractions of a revolution: both cams, their rollers, and the table on its path."""
    scene = of_motion.build(design, fraction)
    theta = TURN * fraction
    links = design.moving.at(theta, 0).links
    axis, still = links["cam"].origin.value, np.zeros_like(fraction)
    whole = np.linspace(0.0, TURN, 721)
    parts: list[Part] = []
    for cam, color, name, way in zip(design.cams, (BLUE, ORANGE), ("x", "y"), (1.0, 1j), strict=True):
        outline = cam.points(whole)[1]
        parts.append(
            Body(outline=outline, place=axis, turn=theta, color=color, fill=pale(color, 0.2), name=f"{name} cam")
        )
        at = links[f"slide_{name}"].origin.value
        parts.append(Body(outline=circle(cam.roller_radius, 36), place=at, turn=still, color=color,
                          fill=pale(color, 0.5), repeats=0))  # fmt: skip
        parts.append(Chain(joints=(at, at + 4.0 * way * cam.roller_radius), color=color, marked=False))
    path = design.moving.at(whole, 0).links["table"].origin.value
    parts.append(Body(outline=path, place=np.zeros_like(axis), turn=still, color=GREEN, name="path", width=1.6))
    parts.append(Body(outline=circle(0.5 * design.cams[0].roller_radius, 24), place=links["table"].origin.value,
                      turn=still, color=GREEN, fill=pale(GREEN, 0.5), repeats=0, name="table"))  # fmt: skip
    return replace(scene, parts=tuple(parts))


def cycloidal(command: str, design: CycloidalReducer) -> Figure:
    """The reducer with its eccentric at 0, the levers, forces and gaps of its pins, and the profile's curvature."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.4, 1.0, 1.0, 1.0))
    drawing = made.add_subplot(grid[0])
    panels.drawing(drawing, "Discs and pins, eccentric at 0")
    scene_axes.draw(drawing, build_cycloidal(design, np.array([0.0])))
    table, disc = design.table("pins"), design.disc
    u = np.linspace(0.0, 360.0, 721)
    levers = np.abs(disc.lever(np.radians(u)))
    _pins(made.add_subplot(grid[1]), "Levers of the pins about the disc's centre", "lever [mm]", u, levers,
          table["angle"], table["lever"])  # fmt: skip
    if "force" in table.columns:
        _pins(made.add_subplot(grid[2]), "Forces of the ring pins, of the disc that carries most", "force [N]", u, None,
              table["angle"], table["force"])  # fmt: skip
    else:
        gaps = 1000.0 * disc.gap(np.radians(u), *design.changes)
        _pins(made.add_subplot(grid[2]), "Gaps at the pins", "gap [µm]", u, gaps, table["angle"], 1000.0 * table["gap"])
    axes = made.add_subplot(grid[3])
    panels.turn_panel(axes, "curvature [1/mm]", "angle from the eccentricity to the pin [deg]")
    panels.heading(axes, "Curvature of the pitch curve, and that of a pin")
    axes.plot(u, disc.curvature(np.radians(u)), color=style.GREEN, linewidth=1.5)
    axes.axhline(1.0 / disc.pin, color=style.BLACK, linewidth=0.9, linestyle=(0, (5, 3)))
    return made


def _pins(axes: Axes, title: str, label: str, u: Any, curve: Any, at: Any, values: Any) -> None:
    panels.turn_panel(axes, label)
    panels.heading(axes, title)
    if curve is not None:
        axes.plot(u, curve, color=style.BLUE, linewidth=1.2)
    axes.vlines(at, 0.0, values, color=style.BLUE, linewidth=1.0)
    axes.plot(at, values, "o", color=style.BLUE, markersize=4.5)


def grooved(command: str, design: Grooved) -> Figure:
    """The drive at a few degrees, output and speed over the input, pressure angle and curvature in the groove."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(5, 1, height_ratios=(2.6, 1.0, 1.0, 1.0, 1.0))
    drawing = made.add_subplot(grid[0])
    at = np.array([1.0 / 12.0])
    panels.drawing(drawing, "Mechanism at input angle 30°, and the groove")
    scene_axes.draw(drawing, build_grooved(design, at), ahead=build_grooved(design, at + scene_axes.AHEAD))
    degrees = np.linspace(0.0, 360.0, 721)
    theta = np.radians(degrees)
    output, speed, _ = design.output_motion.evaluate(theta, 2)
    groove, limit = design.groove, design.spec.limits.pressure_angle
    shown = (
        ("output [deg]", np.degrees(output), style.BLUE, "Output"),
        ("speed ratio [1]", speed, style.GREEN, "Speed of the output over the input's"),
        ("pressure\nangle [deg]", np.degrees(groove.pressure_angle(theta)), style.RED, "Pressure angle in the groove"),
        (
            "curvature [1/mm]",
            groove.curvature(theta),
            style.PURPLE,
            "Curvature of path and roller",
        ),
    )
    for row, (label, values, color, title) in enumerate(shown, 1):
        axes = made.add_subplot(grid[row])
        panels.turn_panel(axes, label, "input angle [deg]" if row == len(shown) else "")
        panels.heading(axes, title)
        axes.plot(degrees, values, color=color, linewidth=1.5)
        lines = {3: (limit, -limit), 4: (1.0 / groove.roller_radius, -1.0 / groove.roller_radius)}.get(row, ())
        for line in lines:
            axes.axhline(line, color=style.BLACK, linewidth=0.9, linestyle=(0, (5, 3)))
    return made


def linked_cams(command: str, design: LinkedCams) -> Figure:
    """Cams, rollers and path, the lifts, and the pressure angles of both cams."""
    made = panels.page(f"{design.spec.name}: {command}")
    grid = made.add_gridspec(4, 1, height_ratios=(2.6, 1.0, 1.2, 1.2))
    drawing = made.add_subplot(grid[0])
    panels.drawing(drawing, "Cams and path at input angle 30°")
    scene_axes.draw(drawing, build_linked_cams(design, np.array([1.0 / 12.0])))
    degrees = np.linspace(0.0, 360.0, 721)
    axes = made.add_subplot(grid[1])
    panels.turn_panel(axes, "position [mm]")
    panels.heading(axes, "Coordinates of the path")
    for axis, (name, color) in enumerate((("x", style.BLUE), ("y", style.ORANGE))):
        values = design.coordinate(axis, np.radians(degrees), 0)[0]
        axes.plot(degrees, values, color=color, linewidth=1.5, label=name)
    panels.legend_above(axes)
    panels.pressure_angles(made.add_subplot(grid[2]), design.cams, design.spec.limits.pressure_angle, "")
    panels.curvatures(made.add_subplot(grid[3]), design.cams, "input angle [deg]")
    return made
