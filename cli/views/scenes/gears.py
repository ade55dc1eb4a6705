"""Gears of a scene, true teeth and holes that show how far a gear has turned; a gear on a rack, there and back."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.cli.views.scenes.scene import (
    BLUE,
    ORANGE,
    TURN,
    WHITE,
    Body,
    Mark,
    Points,
    Readout,
    Reals,
    Scene,
    circle,
    pale,
    track,
)
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import driven_turn, ring_turn
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry, RackProfile
from gearlink.core.parts.gears.outline.ring_profile import RingProfile
from gearlink.core.parts.gears.tooth.teeth import rim_radius

if TYPE_CHECKING:
    from gearlink.cli.views.scenes.of_motion import Positions
    from gearlink.core.parts.gears.rack import RackMesh


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
        return _ring(look, teeth, RingProfile(pair).outline(points), outer)
    outline = _teeth(pair, number)
    if outline is None:
        body = replace(look, outline=circle(tip), repeats=0, label=f"{label} (tip circle)".lstrip())
    else:
        body = replace(look, outline=outline, repeats=teeth)
    return [body, *_holes(look, pair.root_radius[number], loop_turns)]


class Toothed(NamedTuple):
    """A gear of a train: the link on which it is, its axis there, colour, label and name, and whether it is a ring.

    rim : outer radius of a ring, where the file gives it [mm]
    """

    link: str
    axis: complex | str
    color: str
    label: str
    name: str
    ring: bool = False
    rim: float | None = None


def train(here: Positions, meshes: Sequence[GearPair], gears: Sequence[Toothed]) -> list[list[Body]]:
    """The bodies of gears that mesh one after the other, each pair in one of the meshes.

    A space of the first gear, or a tooth of a ring, lies on the x axis of its link; all others mesh with it.
    """
    found: list[list[Body]] = []
    space, before, whole = 0.0, 0j, here.whole
    there_and_back = here.motion.input.turns is None
    for k, each in enumerate(gears):
        pair, turns = meshes[max(k - 1, 0)], whole.turn(each.link)
        axis = complex(whole.at(each.link, each.axis)[0])
        space = _mated(pair, gears[k - 1].ring, cmath.phase(axis - before), space) if k else float(turns[0])
        number = int(each.ring) if pair.internal else min(k, 1)
        loop_turns = 0.0 if there_and_back else float(turns[-1] - turns[0]) / TURN
        turn = space + here.turn(each.link) - turns[0]
        place, rim = here.at(each.link, each.axis), each.rim
        found.append(gear(pair, number, place, turn, loop_turns, each.color, each.label, each.name, rim))
        before = axis
    return found


def _mated(pair: GearPair, from_ring: bool, line: float, space: float) -> float:
    """Where a gear has a space, or a ring a tooth, by that of the gear before it in the direction of the line."""
    one, other = (abs(z) for z in pair.teeth)
    if not pair.internal:
        return float(driven_turn((one, other), line, space))
    return float(ring_turn((other, one), line, space) if from_ring else ring_turn((one, other), line + math.pi, space))


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


_CHORD = 0.012
_LEAST_STROKE = 1.0
"""Pitches to each side."""


def rack_scene(rack: RackMesh, teeth: int, back: float, fraction: Reals, drawn: int = 0) -> Scene:
    """Gear and rack over a loop; at its start and in its middle two flanks touch at the pitch point.

    Parameters
        teeth : int - of the rack
        back : float [mm] - thickness of its body below the root line
        fraction : of the loop, there and back
        drawn : int - teeth about its middle that are drawn, as odd or even as all of them; 0: all
    """
    pair, geometry = rack.pair, RackGeometry(rack)
    radius = pair.reference_radius[0]
    travel = rack.pitch_on_line * max(_LEAST_STROKE, 0.5 * teeth - 2.0) * np.sin(TURN * fraction)
    turn = geometry.first_space[0] + travel / radius
    driver = gear(pair, 0, track(0.0, fraction), turn, 1.0, BLUE, "1", "gear 1")
    place = rack.center_distance + 1j * (geometry.first_space[1] + travel)
    body = replace(rack_body(rack, drawn or teeth, back, place), name=f"rack, z = {teeth}")
    readouts = (Readout("gear 1", "°", np.degrees(turn - geometry.first_space[0])), Readout("rack", " mm", travel))
    return Scene(parts=(body, *driver), marks=(Mark(track(0.0, fraction), pivot=True),), readouts=readouts)


def rack_body(rack: RackMesh, teeth: int, back: float, place: Points) -> Body:
    """The rack upright, its teeth to the left; a rack that no tool leaves is drawn by its tip and back lines."""
    module, words = rack.pair.module, ""
    try:
        profile: RackProfile = rack.profile
        if teeth > _MOST_TEETH:
            raise NoSolution("finer teeth would be a grey band at page width")
        outline = profile.body(_CHORD * module, teeth, back)
    except NoSolution:
        long, low = 0.5 * teeth * rack.pitch_on_line, -(rack.pair.root_depth(1) * module + back)
        high = rack.path.height * module
        corners = [complex(x, y) for x, y in ((long, high), (-long, high), (-long, low), (long, low), (long, high))]
        outline, words = np.array(corners), "2 (tip line)"
    still = np.full(place.shape, 0.5 * np.pi)
    body = Body(outline=outline, place=place, turn=still, color=ORANGE, fill=pale(ORANGE), width=1.0)
    return replace(body, label=words, name=f"rack, z = {teeth}")
