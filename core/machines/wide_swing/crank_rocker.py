"""The crank-rocker whose rocker carries the oscillating cam of a wide-swing mechanism."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.fourbar.sweep import solve


@dataclass(frozen=True)
class CrankRockerDrive:
    """Swing of a cam on the rocker of a crank-rocker, from one dead centre to the other.

    Parameters
        linkage : FourBar - a crank-rocker
        outward : bool - True from the extended to the folded dead centre, False back
    Raises
        NoSolution - for a linkage that is no crank-rocker
    Example
        >>> drive = CrankRockerDrive(FourBar(crank=1.0, coupler=3.0, rocker=2.5, frame=4.0))
        >>> [round(math.degrees(x), 6) for x in (*drive.crank_angles, drive.swing)]
        [36.419914, 210.75352, 47.643195]

    Source
        wide-swing dissertation, chapter 4, combined cam mechanisms; own derivation
    """

    linkage: FourBar
    outward: bool = True

    def __post_init__(self) -> None:
        kind = self.linkage.kind()
        if kind != "crank-rocker":
            bar = self.linkage
            shortest, p, q, longest = sorted((bar.crank, bar.coupler, bar.rocker, bar.frame))
            found = "the four links cannot be assembled" if kind == "impossible" else f"the drive is a {kind}"
            wrong = f"crank {short(bar.crank)} mm is not the shortest link"
            if shortest + longest >= p + q:
                wrong = f"Grashof: {short(shortest)} + {short(longest)} mm against {short(p)} + {short(q)} mm"
            raise NoSolution(f"{found}, not a crank-rocker ({wrong})", fix="change the link lengths")

    @cached_property
    def crank_angles(self) -> tuple[float, float]:
        """Crank angles at the start and the end of the stroke [rad]."""
        bar = self.linkage
        side = float(bar.assembly)
        extended = side * self._base_angle(bar.coupler + bar.crank)
        folded = side * self._base_angle(bar.coupler - bar.crank) + math.pi
        first, last = (extended, folded) if self.outward else (folded, extended)
        return first, first + math.fmod(last - first + 4.0 * math.pi, 2.0 * math.pi)

    def _base_angle(self, reach: float) -> float:
        """Angle at the crank pivot of the triangle reach, frame, rocker."""
        bar = self.linkage
        over = (bar.rocker - bar.frame + reach) * (bar.rocker + bar.frame - reach)
        under = (bar.frame + reach - bar.rocker) * (bar.frame + reach + bar.rocker)
        return 2.0 * math.atan(math.sqrt(over / under))

    @property
    def crank_span(self) -> float:
        """Crank angle of the stroke [rad]; not a half turn in general."""
        return self.crank_angles[1] - self.crank_angles[0]

    @cached_property
    def _middle(self) -> tuple[float, float]:
        """Rocker angle at k = 1/2, and the sign of its velocity."""
        middle = solve(self.linkage, np.array([0.5 * sum(self.crank_angles)]), 1)
        return float(middle.rocker_angle[0]), math.copysign(1.0, float(middle.rocker_velocity[0]))

    @property
    def rising(self) -> float:
        """+1 where the rocker turns counter-clockwise in the stroke, else -1."""
        return self._middle[1]

    def motion(self, k: Reals, order: int = 2) -> tuple[Reals, ...]:
        """Cam angle from k = 1/2, counted in its direction of motion, and its derivatives with respect to k.

        Parameters
            k : (N,) array - fraction of the stroke
            order : int - 0 to 3
        Returns
            rates : tuple of order + 1 (N,) arrays [rad] - chi and its derivatives
        """
        sweep = solve(self.linkage, self.crank_angles[0] + k * self.crank_span, order, velocity=self.crank_span)
        place, sign = self._middle
        rates = (sweep.rocker_velocity, sweep.rocker_acceleration, sweep.rocker_jerk)[:order]
        return (sign * (sweep.rocker_angle - place), *(sign * rate for rate in rates))

    @property
    def swing(self) -> float:
        """Swing of the cam [rad]."""
        ends = self.motion(np.array([0.0, 1.0]))[0]
        return float(ends[1] - ends[0])
