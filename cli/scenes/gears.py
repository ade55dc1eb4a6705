"""Gears of moving pictures: true teeth, and holes that show how far a gear has turned."""

from __future__ import annotations

import math

import numpy as np

from gearlink.cli.scenes.scene import TURN, Body, Points, Reals, circle, pale
from gearlink.core.errors import NoSolution
from gearlink.core.gears.internal_mesh import InternalMesh
from gearlink.core.gears.mesh_phase import ring_outline
from gearlink.core.gears.pair import GearPair

_HOLES = (5, 4, 6, 3, 7, 8, 9, 10, 11, 12)
_WHITE = "#ffffff"


def gear(
    pair: GearPair | InternalMesh, number: int, place: Points, turn: Reals, loop_turns: float, color: str, label: str
) -> list[Body]:
    """Gear 0 or 1 of a pair with its holes; a tool that leaves no such teeth leaves the tip circle.

    Parameters
        pair : GearPair, or InternalMesh (whose gear 1, the ring, is drawn as the line of its teeth and its rim)
        place, turn : tracks [mm, rad] - axis, and direction of the middle of a tooth space
        loop_turns : float - turns of the gear over the loop; the holes are so many that they come to meet themselves
    """
    teeth, tip = pair.teeth[number], pair.tip_radius[number]
    if isinstance(pair, InternalMesh):
        if number == 1:
            return _ring(pair, place, turn, color, label)
        pair = GearPair.from_shift(pair.module, (teeth, teeth), (0.0, 0.0), pressure_angle=pair.pressure_angle)
        number = 0
    try:
        outline, repeats = _teeth(pair, number), teeth
    except NoSolution:
        outline, repeats, label = circle(tip), 0, f"{label} (tip circle)"
    body = Body(
        outline=outline, place=place, turn=turn, repeats=repeats, color=color, fill=pale(color), width=1.0, label=label
    )
    return [body, *_holes(place, turn, pair.root_radius[number], loop_turns, color)]


def _teeth(pair: GearPair, number: int) -> Points:
    from gearlink.core.gears.tooth_profile import ToothProfile, outline

    return outline(ToothProfile.of(pair, number), 0.012 * pair.module)


def _ring(mesh: InternalMesh, place: Points, turn: Reals, color: str, label: str) -> list[Body]:
    rim = circle(mesh.rim_radius, 144)
    shared = {"place": place, "turn": turn, "color": color, "width": 1.0}
    return [
        Body(outline=rim, fill=pale(color), repeats=0, **shared, label=label),  # type: ignore[arg-type]
        Body(outline=ring_outline(mesh), fill=_WHITE, repeats=mesh.teeth[1], **shared),  # type: ignore[arg-type]
    ]


def holes_for(loop_turns: float) -> int:
    """So many holes that a gear looks the same after the loop; 0 where no few of them do.

    Example
        >>> holes_for(1.0), holes_for(-40 / 72), holes_for(7 / 31)
        (5, 9, 0)
    """
    return next((n for n in _HOLES if abs(n * loop_turns - round(n * loop_turns)) < 1e-9), 0)


def _holes(place: Points, turn: Reals, root: float, loop_turns: float, color: str) -> list[Body]:
    count = holes_for(loop_turns)
    if count == 0 or root <= 0.0:
        return []
    ring = 0.62 * root
    radius = min(0.2 * root, 0.6 * ring * math.sin(math.pi / count))
    holes = []
    for k in range(count):
        outline = ring * np.exp(1j * TURN * k / count) + circle(radius, 24)
        holes.append(Body(outline=outline, place=place, turn=turn, repeats=count, color=color, fill=_WHITE, width=0.8))
    return holes
