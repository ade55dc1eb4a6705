"""What the scenes of the smaller gear-linkages share: the four joints, and a chart over the crank angle."""

from __future__ import annotations

from dataclasses import dataclass

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
    track,
)
from gearlink.core.parts.linkages.fourbar import sweep as fourbar_sweep
from gearlink.core.parts.linkages.fourbar.position import FourBar


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
    def of(cls, linkage: FourBar, crank_angle: Reals) -> Joints:
        """The joints at crank angles [rad]."""
        state = fourbar_sweep.solve(linkage, crank_angle)
        return cls(
            track(0.0, crank_angle),
            linkage.crank * np.exp(1j * crank_angle),
            linkage.frame + linkage.rocker * np.exp(1j * state.rocker_angle),
            track(linkage.frame, crank_angle),
            state.coupler_angle,
            state.rocker_angle,
        )

    def chain(self) -> Chain:
        """The links."""
        return Chain(joints=(self.a, self.b, self.c, self.d))

    def marks(self) -> tuple[Mark, ...]:
        """Letters and pivots."""
        return letters("AD", A=self.a, B=self.b, C=self.c, D=self.d)


def coupler_windings(linkage: FourBar) -> float:
    """Turns of coupler and rocker in a turn of the crank: 1 in a drag link, else 0."""
    coupler = fourbar_sweep.solve(linkage, np.array([0.0, TURN])).coupler_angle
    return float(round((coupler[1] - coupler[0]) / TURN))


def over_crank(phi: Reals, curves: tuple[Curve, ...], ylabel: str, marked: tuple[Band, ...] = ()) -> Chart:
    """A chart over one turn of the crank; its curves have as many points as `loop()`."""
    return Chart("crank angle [deg]", ylabel, 360.0 * loop(), np.degrees(phi), curves, marked)


def crank_readout(phi: Reals) -> Readout:
    """The crank angle."""
    return Readout("crank", "°", np.degrees(phi))


def whole_turn() -> Reals:
    """Crank angles of a chart [rad]."""
    return TURN * loop()
