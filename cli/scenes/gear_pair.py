"""A gear pair in motion: so many pitches that the teeth, and where it goes the holes, come to meet themselves."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear, holes_for
from gearlink.cli.scenes.scene import TURN, Mark, Part, Points, Reals, Scene, fixed_circle, track
from gearlink.core.gears.mesh_phase import driven_turn

if TYPE_CHECKING:
    from gearlink.core.gears.design import GearPairDesign
    from gearlink.core.gears.pair import GearPair

_MOST_PITCHES = 36


def build(design: GearPairDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; gear 1 drives counter-clockwise."""
    pair = design.gear_pair
    axes = track(0.0, fraction), track(pair.center_distance, fraction)
    return Scene(
        parts=pair_parts(pair, (axes[0], axes[1]), fraction),
        marks=tuple(Mark(point=axis, pivot=True) for axis in axes),
    )


def pair_parts(pair: GearPair, axes: tuple[Points, Points], fraction: Reals) -> tuple[Part, ...]:
    """Both gears over a loop of whole pitches, with their working circles."""
    pitches = loop_pitches(pair.teeth)
    turns = pitches / pair.teeth[0], -pitches / pair.teeth[1]
    first = TURN * turns[0] * fraction - math.pi / pair.teeth[0]
    second = driven_turn(pair.teeth, np.zeros_like(fraction), first)
    circles = [
        fixed_circle(complex(axis[0]), radius, style.GREY, dashed=True)
        for axis, radius in zip(axes, pair.working_radius, strict=True)
    ]
    return (
        *gear(pair, 0, axes[0], first, turns[0], style.BLUE, "1"),
        *gear(pair, 1, axes[1], second, turns[1], style.ORANGE, "2"),
        *circles,
    )


def loop_pitches(teeth: tuple[int, int]) -> int:
    """Pitches that pass in the loop: a turn of a small gear 1, else as many as let both gears keep their holes.

    Example
        >>> loop_pitches((20, 40)), loop_pitches((72, 72)), loop_pitches((101, 103))
        (20, 36, 36)
    """
    z1, z2 = teeth
    if z1 <= _MOST_PITCHES and holes_for(z1 / z2):
        return z1
    return max(range(1, _MOST_PITCHES + 1), key=lambda k: (bool(holes_for(k / z1)) + bool(holes_for(k / z2)), k))
