"""Four-bars with one gear fixed to the coupler, in mesh with a free gear: two-gear four-bar and geared rocker.

The free gear turns about one joint of the coupler's neighbour (the carrier link), with ratio i between carrier and
coupler:

    W = (1 - i) w_carrier + i w_coupler,   i = -z2/z5 (external mesh), +z2/z5 (ring gear 5)

In the two-gear four-bar the carrier is the crank (gear 5 on A, gear 2 at B); in the geared rocker it is the rocker
(gear 5 on D, gear 2 at C). Angles and links as in `core.parts.linkages.fourbar.position`; rates are per crank speed.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Literal

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.fourbar.loop import rates_of
from gearlink.core.parts.linkages.fourbar.position import FourBar, FourBarState, solve
from gearlink.core.parts.linkages.standstills import Turning

Carrier = Literal["crank", "rocker"]


@dataclass(frozen=True)
class PlanetLinkage:
    """A four-bar and the ratio of the gear on its coupler.

    Parameters
        linkage : FourBar
        ratio : float - i = -z2/z5 for an external mesh, +z2/z5 in a ring gear
        carrier : 'crank' or 'rocker' - link that holds the two gears at their distance
    Raises
        NoSolution - for a ratio that is zero or not finite, or not below 1
    Example
        >>> drive = PlanetLinkage(FourBar(14.0, 30.0, 40.0, 45.0), -16.0 / 12.0, "crank")
        >>> round(drive.speed(math.radians(60.0)), 12)
        2.904665122147

    Source
        thesis 2.2.1, figure 2-2; 2.2.2, figure 2-4
    """

    linkage: FourBar
    ratio: float
    carrier: Carrier

    def __post_init__(self) -> None:
        if not (math.isfinite(self.ratio) and self.ratio != 0.0 and self.ratio < 1.0):
            raise NoSolution(
                f"gear ratio {self.ratio:g}: it is -z2/z5 for an external mesh, z2/z5 in a ring gear, which must have "
                "more teeth than the gear in it"
            )

    @cached_property
    def _start(self) -> FourBarState[float]:
        return solve(self.linkage, 0.0)

    def angle(self, crank_angle: float) -> float:
        """Angle of the output gear, 0 at the crank angle 0, continuous over any number of revolutions.

        phi5 = (1 - i) carrier + i coupler, less its value at the crank angle 0

        Parameters
            crank_angle : float [rad]
        Returns
            phi5 : float [rad]
        Raises
            NoSolution - where the linkage does not close
        Example
            >>> drive = PlanetLinkage(FourBar(14.0, 30.0, 40.0, 45.0), -16.0 / 12.0, "crank")
            >>> round(drive.angle(2.0 * math.pi) / (2.0 * math.pi), 12)  # 1 + z2/z5
            2.333333333333

        Source
            thesis 2.2.1, integrated
        """
        here, start = solve(self.linkage, crank_angle), self._start
        rocker = here.rocker_angle - start.rocker_angle
        carrier = crank_angle if self.carrier == "crank" else rocker
        return (1.0 - self.ratio) * carrier + self.ratio * (here.coupler_angle - start.coupler_angle)

    def speed(self, crank_angle: float) -> float:
        """Speed ratio of the output gear, W = w5/w1.

        Raises
            NoSolution - where the linkage does not close
        Source
            thesis 2.2.1
        """
        return self._rate(crank_angle, 1)

    def acceleration(self, crank_angle: float) -> float:
        """Acceleration ratio of the output gear at constant crank speed, dW/dphi [1/rad].

        Raises
            NoSolution - where the linkage does not close
        """
        return self._rate(crank_angle, 2)

    def jerk(self, crank_angle: float) -> float:
        """Jerk ratio of the output gear at constant crank speed, d2W/dphi2 [1/rad^2].

        Raises
            NoSolution - where the linkage does not close
        """
        return self._rate(crank_angle, 3)

    def rates(self, crank_angle: float, order: int) -> tuple[float, ...]:
        """Angle of the output gear, and its derivatives by the crank angle up to an order."""
        return self.angle(crank_angle), *(self._rate(crank_angle, k) for k in range(1, order + 1))

    def _rate(self, crank_angle: float, order: int) -> float:
        """A derivative of the output's angle, of coupler and carrier weighted by the ratio."""
        coupler, rocker = rates_of(self.linkage.reading, crank_angle, order)
        carrier = float(order == 1) if self.carrier == "crank" else rocker
        return (1.0 - self.ratio) * carrier + self.ratio * coupler

    @cached_property
    def turnings(self) -> tuple[Turning, ...]:
        """Extremes of the output's speed ratio over the turn."""
        return tuple(standstills.turnings(self.speed, self.acceleration))

    def coupler_turnings(self) -> list[Turning]:
        """Extremes of the coupler's speed per crank speed; where the crank carries they are those of the output."""
        links = self.linkage.reading
        if self.carrier == "crank":
            return [Turning(place, rates_of(links, place, 1)[0]) for place, _ in self.turnings]
        return standstills.turnings(lambda phi: rates_of(links, phi, 1)[0], lambda phi: rates_of(links, phi, 2)[0])

    def mean_ratio(self) -> float:
        """Net output revolutions per crank revolution.

        Crank carries: 1 - i in a crank-rocker, 1 in a drag link. Rocker carries: 0 in a crank-rocker, 1 in a drag link.

        Source
            own derivation: what winds up in a revolution
        """
        if self.linkage.kind() == "drag-link":
            return 1.0
        return 1.0 - self.ratio if self.carrier == "crank" else 0.0


def standstill_coupler_ratio(ratio: float) -> float:
    """Coupler speed per crank speed at which the output of a two-gear four-bar stands still.

    w2/w1 = 1 - 1/i = 1 + z5/z2 (external), 1 - z5/z2 (ring gear)

    Parameters
        ratio : float - i
    Returns
        w2/w1 : float
    Notes
        There the line CD passes through the pitch point of the gears on AB. In a crank-rocker w2/w1 stays below 1 (it
        would be 1 where A lies on CD, that is where crank and coupler would turn as one), so that an external mesh
        never stops its output.
    Example
        >>> standstill_coupler_ratio(-2.0), standstill_coupler_ratio(0.5)
        (1.5, -1.0)

    Source
        thesis 2.2.1; the limit for a crank-rocker is an own derivation
    """
    return 1.0 - 1.0 / ratio
