"""The swing of a four-bar's rocker."""

from __future__ import annotations

from gearlink.core.parts.linkages.fourbar.nearest_passes import joint_to_crank_pivot
from gearlink.core.parts.linkages.fourbar.position import FourBar, solve


def rocker_swing(linkage: FourBar) -> float | None:
    """Angle between the rocker's dead centres; None for a drag link, whose rocker goes all the way round.

    psi = |t3(stretched) - t3(folded)|

    Parameters
        linkage : FourBar - crank-rocker or drag link
    Returns
        swing : float [rad]
    Raises
        NoSolution - within rounding of a change point
    Example
        >>> import math
        >>> round(math.degrees(rocker_swing(FourBar(18.0, 50.0, 100.0, 121.4))), 6)
        21.667477

    Source
        VDI 2142
    """
    if linkage.kind() != "crank-rocker":
        return None
    ends = joint_to_crank_pivot(linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, linkage.assembly)
    folded, stretched = (solve(linkage, end.crank_angle).rocker_angle for end in ends)
    return abs(folded - stretched)
