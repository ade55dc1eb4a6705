"""Gears of a scene: true teeth, and holes that show how far a gear has turned."""

from __future__ import annotations

import math
from dataclasses import replace

import numpy as np

from gearlink.cli.views.scenes.colors import WHITE, pale
from gearlink.cli.views.scenes.scene import TURN, Body, Points, Reals, circle
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.tooth.teeth import rim_radius

_HOLES = (5, 4, 6, 3, 7, 8, 9, 10, 11, 12)
_MOST_TEETH = 600
"""Finer teeth would be a grey band at page width."""


def gear(
    pair: GearPair,
    number: int,
    place: Points,
    turn: Reals,
    loop_turns: float,
    color: str,
    label: str,
    name: str = "",
    rim: float | None = None,
) -> list[Body]:
    """Gear 0 or 1 of a pair with its holes; a tool that leaves no such teeth leaves the tip circle.

    Parameters
        pair : GearPair - whose gear 1, where it is a ring, is drawn as the line of its teeth and its rim
        place, turn : tracks [mm, rad] - axis, and direction of the middle of a tooth space
        loop_turns : float - turns of the gear over the loop; the holes are so many that they come to meet themselves
        label, name : words on the gear, and in a legend, where the number of teeth is added
        rim : float or None [mm] - outer radius of a ring, where the file gives it
    """
    teeth, tip = abs(pair.teeth[number]), pair.tip_radius[number]
    look = Body(outline=np.zeros(1), place=place, turn=turn, color=color, fill=pale(color), width=1.0, label=label)
    look = replace(
        look,
        name=f"{name}, z = {teeth if 'ring gear' in name else pair.teeth[number]}".removeprefix(", ").replace("-", "−"),
        pitch=abs(pair.working_radius[number]),
    )
    if pair.teeth[number] < 0:
        outer = rim_radius(pair.root_radius[1], pair.module, rim)
        points = 12 if any(pair.profile_shift) else 6  # on a flank: teeth with shifts are looked at more closely
        return _ring(look, teeth, RingProfile.of(pair).outline(points), outer)
    outline = _teeth(pair, number)
    if outline is None:
        body = replace(look, outline=circle(tip), repeats=0, label=f"{label} (tip circle)".lstrip())
    else:
        body = replace(look, outline=outline, repeats=teeth)
    return [body, *_holes(look, pair.root_radius[number], loop_turns)]


def _teeth(pair: GearPair, number: int) -> Points | None:
    """All teeth of a gear; None where they are too fine, or the tool leaves none."""
    from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

    if pair.teeth[number] > _MOST_TEETH:
        return None
    try:
        return outline(ToothProfile.of(pair, number), 0.012 * pair.module)
    except NoSolution:
        return None


def _ring(look: Body, count: int, inside: Points, rim_radius: float) -> list[Body]:
    rim = replace(look, outline=circle(rim_radius, 144), repeats=0)
    teeth = replace(look, outline=inside, repeats=count, fill=WHITE, label="", name="", pitch=0.0)
    return [rim, teeth]


def holes_for(loop_turns: float) -> int:
    """So many holes that a gear looks the same after the loop; 0 where no few of them do.

    Example
        >>> holes_for(1.0), holes_for(-40 / 72), holes_for(7 / 31)
        (5, 9, 0)
    """
    return next((n for n in _HOLES if abs(n * loop_turns - round(n * loop_turns)) < 1e-9), 0)


def _holes(gear: Body, root: float, loop_turns: float) -> list[Body]:
    count = holes_for(loop_turns)
    if count == 0 or root <= 0.0:
        return []
    ring = 0.62 * root
    radius = min(0.2 * root, 0.6 * ring * math.sin(math.pi / count))
    hole = replace(gear, repeats=count, fill=WHITE, width=0.8, label="", name="", pitch=0.0, shows_turn=True)
    return [replace(hole, outline=ring * np.exp(1j * TURN * k / count) + circle(radius, 24)) for k in range(count)]
