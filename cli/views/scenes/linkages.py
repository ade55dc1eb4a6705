"""What the scenes of the smaller geared linkages share: the four joints, and a chart over the crank angle."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.scenes.scene import (
    TURN,
    Band,
    Chain,
    Chart,
    Curve,
    Mark,
    Points,
    Readout,
    Reals,
    letters,
    loop,
)

if TYPE_CHECKING:
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
