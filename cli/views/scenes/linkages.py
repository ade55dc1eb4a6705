"""Which kinds move, and the loop of a design's scene."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.scene import TURN, Body, Reals, Scene
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import FILES, KINDS

if TYPE_CHECKING:
    from gearlink.core.base.design import Design


_USUAL_SECONDS, _MOST_SECONDS = 4.0, 12.0
# A pitch that moves on by more than half of itself from one picture to the next seems to run backwards.
_PITCH_A_PICTURE = 0.35


def moving_kinds() -> tuple[str, ...]:
    """The kinds that have a scene."""
    return tuple(name for name in KINDS if moves(name))


def moves(kind: str) -> bool:
    """Whether a kind has a scene: its own, or that of its motion."""
    return bool(FILES[kind].scene or FILES[kind].motion)


def build(design: Design, fraction: Reals) -> Scene:
    """The scene of a design over fractions of its loop; 0 and 1 look the same."""
    return builder(design.kind)(design, fraction)


def builder(kind: str) -> Callable[[Design, Reals], Scene]:
    """What builds the scenes of a kind."""
    found: Callable[[Design, Reals], Scene] = load(FILES[kind].scene or "cli.views.scenes.of_motion:build")
    return found


def pictures_for(scene: Scene, fps: int) -> int:
    """How many pictures let the teeth be seen to turn the right way, from a scene of evenly spread probes."""
    bodies = [part for part in scene.parts if isinstance(part, Body) and part.repeats > 1]
    steps = [float(np.abs(np.diff(body.turn)).max()) * body.repeats / TURN * len(body.turn) for body in bodies]
    needed = max(steps, default=0.0) / _PITCH_A_PICTURE
    return math.ceil(min(max(_USUAL_SECONDS * fps, needed), _MOST_SECONDS * fps))
