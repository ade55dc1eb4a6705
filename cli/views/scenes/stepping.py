"""Scenes of stepping drives and reducers: the generic one of the links, with their bodies."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes import of_motion
from gearlink.cli.views.scenes.colors import BLUE, GREEN, GREY, ORANGE, pale
from gearlink.cli.views.scenes.scene import TURN, Body, Chain, Part, Points, Reals, Scene, circle

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.grooved import Grooved
    from gearlink.core.machines.cam_drives.linked import LinkedCams
    from gearlink.core.machines.cycloidal.design import CycloidalReducer
    from gearlink.core.machines.geneva.bodies import Outlines, Piece
    from gearlink.core.machines.geneva.design import GenevaDrive

_RIM = 2.5
"""Pin radii from the bottoms of an internal wheel's slots to its rim."""


def geneva(design: GenevaDrive, fraction: Reals) -> Scene:
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


def cycloidal(design: CycloidalReducer, fraction: Reals) -> Scene:
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


def grooved(design: Grooved, fraction: Reals) -> Scene:
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


def linked_cams(design: LinkedCams, fraction: Reals) -> Scene:
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
