"""How near the coupler joint of a four-bar passes its crank pivot, and how far it goes, over a revolution of the crank.

Frame: crank pivot A, rocker pivot D, crank pin B, coupler joint C; links crank = AB, coupler = BC, rocker = CD,
frame = AD. Crank angles count from A->D, counter-clockwise.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.parts.linkages.checks import check_linkage
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
    folded, stretched = (solve(linkage, end.crank_angle).rocker_angle for end in joint_to_crank_pivot(linkage))
    return abs(folded - stretched)


class Approach(NamedTuple):
    """A distance [mm] between two axes and the crank angle [rad] in [0, 2 pi) at which it occurs."""

    distance: float
    crank_angle: float


def joint_to_crank_pivot(linkage: FourBar) -> tuple[Approach, Approach]:
    """Minimum and maximum distance of the coupler joint C from the crank pivot A over a revolution of the crank.

    AC = max(b - a, c - d) ... min(a + b, c + d)

    Parameters
        linkage : FourBar [mm] - a, b, c, d of one whose crank turns fully
    Returns
        nearest, farthest : Approach
    Raises
        NoSolution - when the crank cannot make a full revolution or the linkage has a change point
    Notes
        The triangles ABC and ACD share the side AC, so that no other distances close; each bound is reached. In a
        crank-rocker the bounds are the dead centres, b - a and a + b; in a drag link C passes the line AD
        twice, at c - d and c + d. The crank angle there comes from the half-angle tangent.
    Example
        >>> near, far = joint_to_crank_pivot(FourBar(38.85708906, 112.0, 112.0, 153.5517067))
        >>> round(near.distance, 3), round(far.distance, 3)
        (73.143, 150.857)
    """
    check_linkage(linkage)
    a, b, c, d, assembly = linkage.crank, linkage.coupler, linkage.rocker, linkage.frame, linkage.assembly
    if b - a > abs(c - d):
        nearest = _approach(b - a, math.pi, assembly * _angle(b - a, d, c))
    else:
        nearest = _approach(c - d, math.pi, assembly * _angle(c - d, a, b))
    if a + b < c + d:
        return nearest, _approach(a + b, 0.0, assembly * _angle(a + b, d, c))
    return nearest, _approach(c + d, 0.0, assembly * _angle(c + d, a, b))


def _approach(distance: float, flat: float, angle: float) -> Approach:
    """Where AC reaches a bound one of the triangles ABC, ACD is flat (0 or pi at A), the other has its angle."""
    return Approach(distance, (flat + angle) % (2.0 * math.pi))


def _angle(p: float, q: float, opposite: float) -> float:
    """Angle between the sides p and q of a triangle: tan^2(angle/2) = (o-p+q)(o+p-q)/((p+q-o)(p+q+o))."""
    near = (opposite - p + q) * (opposite + p - q)
    far = (p + q - opposite) * (p + q + opposite)
    if near < 0.0 or far < 0.0:
        raise NoSolution(
            f"the linkage is within rounding of a change point (sides {short(p)}, {short(q)} and "
            f"{short(opposite)} mm are collinear)",
            fix="shorten the crank",
        )
    return 2.0 * math.atan2(math.sqrt(near), math.sqrt(far))
