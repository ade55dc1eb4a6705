"""A gear pair: so many pitches that the teeth, and where it goes the holes, come to meet themselves."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.colors import BLUE, ORANGE
from gearlink.cli.views.scenes.gears import gear, holes_for
from gearlink.cli.views.scenes.scene import TURN, Mark, Readout, Reals, Scene, track
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry, driven_turn

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.parts.gears.mesh.pair import GearPair

_MOST_PITCHES = 36


def build(design: GearPairDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; gear 1 drives counter-clockwise."""
    if design.rack is not None:
        from gearlink.cli.views.scenes.rack import rack_scene

        return rack_scene(design.rack, design.rack_teeth, design.rack_back, fraction)
    return pair_scene(design.gear_pair, ("1", "2"), fraction)


def pair_scene(pair: GearPair, labels: tuple[str, str], fraction: Reals) -> Scene:
    """Both gears over a loop of whole pitches; at its start two flanks touch at the pitch point."""
    pitches = loop_pitches(pair.teeth)
    turns = pitches / pair.teeth[0], -pitches / pair.teeth[1]
    start = MeshGeometry(pair).first_space
    first = TURN * turns[0] * fraction + start[0]
    if pair.internal:
        second = TURN * turns[1] * fraction + start[1]
    else:
        second = driven_turn(pair.teeth, np.zeros_like(fraction), first)
    one, two = track(0.0, fraction), track(pair.center_distance, fraction)
    bodies = (
        gear(pair, 0, one, first, turns[0], BLUE, labels[0], f"gear {labels[0]}"),
        gear(pair, 1, two, second, turns[1], ORANGE, labels[1], f"gear {labels[1]}"),
    )
    behind, before = bodies[::-1] if pair.internal else bodies
    readouts = tuple(
        Readout(f"gear {label}", "°", np.degrees(turn - turn.flat[0]))
        for label, turn in zip(labels, (first, second), strict=True)
    )
    return Scene(parts=(*behind, *before), marks=(Mark(one, pivot=True), Mark(two, pivot=True)), readouts=readouts)


def loop_pitches(teeth: tuple[int, int]) -> int:
    """Pitches that pass in the loop: a revolution of a small gear 1, else as many as let both gears keep their holes.

    Example
        >>> loop_pitches((20, 40)), loop_pitches((72, 72)), loop_pitches((101, 103))
        (20, 36, 36)
    """
    z1, z2 = teeth[0], abs(teeth[1])
    if z1 <= _MOST_PITCHES and holes_for(z1 / z2):
        return z1
    return max(range(1, _MOST_PITCHES + 1), key=lambda k: (bool(holes_for(k / z1)) + bool(holes_for(k / z2)), k))
