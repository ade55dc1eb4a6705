"""Four-bars with one gear fixed to the coupler, in mesh with a free gear: two-gear four-bar and geared rocker.

The free gear turns about one joint of the coupler's neighbour (the carrier link), with ratio i between carrier and
coupler:

    W = (1 - i) w_carrier + i w_coupler,   i = -z2/z5 (external mesh), +z2/z5 (ring gear 5)

In the two-gear four-bar the carrier is the crank (gear 5 on A, gear 2 at B); in the geared rocker it is the rocker
(gear 5 on D, gear 2 at C). Angles and links as in `core.parts.linkages.fourbar.position`; rates are per crank speed.
"""

from __future__ import annotations

import math
from typing import Literal

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.linkages import standstills
from gearlink.core.parts.linkages.fourbar.loop import rates_of
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.geared_output import GearedOutput, Shares
from gearlink.core.parts.linkages.standstills import Turning


class PlanetLinkage(GearedOutput):
    """The output of a four-bar with a gear on its coupler.

    Parameters
        ratio : float - i = -z2/z5 for an external mesh, +z2/z5 in a ring gear
        carrier : 'crank' or 'rocker' - link that holds the two gears at their distance
    Raises
        NoSolution - for a ratio that is zero or not finite, or not below 1
    Notes
        The mean ratio of a crank-rocker is 1 - i where the crank carries, 0 where the rocker does; of a drag link 1.
    Example
        >>> drive = PlanetLinkage(FourBar(14.0, 30.0, 40.0, 45.0), -16.0 / 12.0, "crank")
        >>> round(drive.speed(math.radians(60.0)), 12)
        2.904665122147
        >>> round(drive.angle(2.0 * math.pi) / (2.0 * math.pi), 12)  # 1 + z2/z5
        2.333333333333

    Source
        thesis 2.2.1, figure 2-2; 2.2.2, figure 2-4
    """

    def __init__(self, linkage: FourBar, ratio: float, carrier: Literal["crank", "rocker"]) -> None:
        if not (math.isfinite(ratio) and ratio != 0.0 and ratio < 1.0):
            raise NoSolution(
                f"gear ratio {ratio:g}: it is -z2/z5 for an external mesh, z2/z5 in a ring gear, which must have "
                "more teeth than the gear in it"
            )
        self.ratio, self.carrier = ratio, carrier
        by_crank, by_rocker = (1.0 - ratio, 0.0) if carrier == "crank" else (0.0, 1.0 - ratio)
        super().__init__(linkage, Shares(by_crank, ratio, by_rocker))

    def coupler_turnings(self) -> list[Turning]:
        """Extremes of the coupler's speed per crank speed; where the crank carries they are those of the output."""
        links = self.linkage.reading
        if self.carrier == "crank":
            return [Turning(place, rates_of(links, place, 1)[0]) for place, _ in self.speed_turnings]
        return standstills.turnings(lambda phi: rates_of(links, phi, 1)[0], lambda phi: rates_of(links, phi, 2)[0])


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
