"""The crank that gives the output of a geared rocker its swing."""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlink.core.errors import NoSolution
from gearlink.core.linkages import standstills
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.planet_linkages.planet import PlanetLinkage
from gearlink.core.report import safely_above

_STEPS = 48
# The swing is sought up to this share of the longest crank; beyond it the transmission angle is below a degree.
_LARGEST = 1.0 - 1e-6
# And from this share on: the swing of a vanishing crank is zero, but its linkage has no extremes to find.
_SMALLEST = 1e-6


def extreme_crank_angles(drive: PlanetLinkage) -> list[float]:
    """Crank angles at which the output of a geared rocker reverses.

    (1 - i) w3 + i w2 = 0: the line AB passes through the pitch point of the gears on CD

    Parameters
        drive : PlanetLinkage - its carrier the rocker
    Returns
        places : list of float [rad] - ascending in [0, 2 pi); not the dead centres of the linkage
    Example
        >>> drive = PlanetLinkage(FourBar(20.0, 70.0, 60.0, 80.0), -1.5, "rocker")
        >>> [round(math.degrees(phi), 9) for phi in extreme_crank_angles(drive)]
        [17.4224633, 194.290488458]

    Source
        own derivation; thesis 2.2.2, figure 2-4 takes the swing for a multiple of the rocker's
    """
    return standstills.zeros_over_turn(drive.speed)


def output_swing(drive: PlanetLinkage) -> float:
    """Swing of the output gear of a geared rocker between its own extremes [rad].

    Parameters
        drive : PlanetLinkage - its carrier the rocker of a crank-rocker
    Returns
        swing : float [rad]
    Example
        >>> round(math.degrees(output_swing(PlanetLinkage(FourBar(20.0, 70.0, 60.0, 80.0), -1.5, "rocker"))), 9)
        101.175579602
    """
    angles = [drive.angle(phi) for phi in extreme_crank_angles(drive)]
    return max(angles) - min(angles)


def longest_crank(coupler: float, rocker: float, frame: float) -> float:
    """Crank at which a crank-rocker of the other three links becomes a change-point linkage [mm].

    a_max = b + c + d - 2 max(b, c, d)

    Raises
        NoSolution - where the longest of the three is not shorter than the other two together
    Example
        >>> longest_crank(70.0, 60.0, 80.0)
        50.0

    Source
        own derivation: Grashof's rule with the crank the shortest
    """
    longest = max(coupler, rocker, frame)
    room = math.fsum((coupler, rocker, frame, -2.0 * longest))
    if room <= 0.0:
        raise NoSolution(
            f"no crank turns with coupler {coupler:g}, rocker {rocker:g} and frame {frame:g} mm: the longest must be "
            f"shorter than the other two together, {coupler + rocker + frame - longest:g} mm"
        )
    return min(room, coupler, rocker, frame)


def crank_for_swing(coupler: float, rocker: float, frame: float, assembly: int, ratio: float, swing: float) -> float:
    """Shortest crank with which the output of a geared rocker swings by a given angle.

    Parameters
        coupler, rocker, frame : float [mm]
        assembly : +1 or -1
        ratio : float - i = -z2/z5
        swing : float [rad] - of the output gear
    Returns
        crank : float [mm]
    Raises
        NoSolution - where no crank-rocker of these links and gears swings so far
    Notes
        The swing is computed on the linkage of each crank that is tried; the shortest crank has the best transmission
        angles.
    Example
        >>> round(crank_for_swing(70.0, 60.0, 80.0, 1, -1.5, math.radians(120.0)), 9)
        23.507018829
    """
    limit = _LARGEST * longest_crank(coupler, rocker, frame)

    def excess(crank: float) -> float:
        return output_swing(PlanetLinkage(FourBar(crank, coupler, rocker, frame, assembly), ratio, "rocker")) - swing

    low, below_low = 0.0, -swing
    greatest = -swing
    for i in range(1, _STEPS + 1):
        crank = limit * i / _STEPS
        value = excess(crank)
        if value >= 0.0:
            start = low if low > 0.0 else _least_crank(excess, limit, swing)
            return bracketed_root(excess, start, crank)
        low, below_low = crank, value
        greatest = max(greatest, below_low)
    reach = math.degrees(greatest + swing)
    raise NoSolution(
        f"no crank gives a swing of {math.degrees(swing):.6g} deg: with these links and gears the output reaches "
        f"{math.floor(reach * 10.0) / 10.0:g} deg at most; ask for less, or take more teeth on the coupler gear (now "
        f"z2/z5 = {abs(ratio):.6g})"
    )


def _least_crank(excess: Callable[[float], float], limit: float, swing: float) -> float:
    """A crank that swings the output less than is asked for.

    Raises
        NoSolution - where even the shortest that is tried swings it farther
    """
    crank = limit * _SMALLEST
    if (over := excess(crank)) >= 0.0:
        raise NoSolution(
            f"a swing of {math.degrees(swing):.6g} deg is next to a standstill: ask for "
            f"{safely_above(math.degrees(over + swing), 3)} deg or more"
        )
    return crank
