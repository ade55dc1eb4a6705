"""Which kinds move, the loop of a design's scene, and what the scenes of the smaller geared linkages share."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.scene import (
    TURN,
    Band,
    Body,
    Chain,
    Chart,
    Curve,
    Mark,
    Points,
    Readout,
    Reals,
    Scene,
    letters,
    loop,
)
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import FILES, KINDS

if TYPE_CHECKING:
    from gearlink.core.base.design import Design
    from gearlink.core.mechanism.motion import Motion


@dataclass(frozen=True, slots=True)
class Joints:
    """A four-bar over crank angles: joints [mm], and directions of coupler and rocker [rad]."""

    a: Points
    b: Points
    c: Points
    d: Points
    coupler: Reals
    rocker: Reals

    @classmethod
    def of(cls, motion: Motion, q: Reals) -> Joints:
        """The joints of the links crank, coupler and rocker at inputs [rad]."""
        links = motion.at(q, 0).links
        coupler, rocker = links["coupler"], links["rocker"]
        return cls(
            links["crank"].origin.value,
            coupler.origin.value,
            rocker.at("C").value,
            rocker.origin.value,
            coupler.turn.value,
            rocker.turn.value,
        )

    def chain(self) -> Chain:
        """The links."""
        return Chain(joints=(self.a, self.b, self.c, self.d))

    def marks(self) -> tuple[Mark, ...]:
        """Letters and pivots."""
        return letters("AD", A=self.a, B=self.b, C=self.c, D=self.d)


def coupler_windings(motion: Motion) -> float:
    """Revolutions of coupler and rocker in one of the crank: 1 in a drag link, else 0."""
    coupler = motion.at(np.array([0.0, TURN]), 0).links["coupler"].turn.value
    return float(round((coupler[1] - coupler[0]) / TURN))


def over_crank(phi: Reals, curves: tuple[Curve, ...], ylabel: str, marked: tuple[Band, ...] = ()) -> Chart:
    """A chart over one revolution of the crank; its curves have as many points as `loop()`."""
    return Chart("crank angle [deg]", ylabel, 360.0 * loop(), np.degrees(phi), curves, marked)


def crank_readout(phi: Reals) -> Readout:
    """The crank angle."""
    return Readout("crank", "°", np.degrees(phi))


def whole_turn() -> Reals:
    """Crank angles of a chart [rad]."""
    return TURN * loop()


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
