"""The four-bar linkage over arrays of crank angles: one tangent a position, in blocks that stay in the cache.

Frame, names and closed form are those of `gearlink.core.fourbar`. With t = tan(phi/2) every sum of that module,
multiplied by 1 + t^2, is linear in t^2, so the sweep needs no sine, cosine or arc function until an angle is
asked for.
"""

from __future__ import annotations

import math
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core import fourbar
from gearlink.core.errors import NoSolution
from gearlink.core.fourbar import FourBar

Array = NDArray[np.float64]

BLOCK = 8192
_SCRATCH = 12


def _not_asked() -> Array:
    return np.empty(0)


@dataclass(frozen=True, slots=True)
class FourBarSweep:
    """Four-bar over crank angles: the fields of `fourbar.FourBarState` as arrays of the shape of the angles.

    Rates that were not asked for are empty arrays.
    """

    coupler_angle: Array
    rocker_angle: Array
    transmission_angle: Array
    coupler_velocity: Array = field(default_factory=_not_asked)
    rocker_velocity: Array = field(default_factory=_not_asked)
    coupler_acceleration: Array = field(default_factory=_not_asked)
    rocker_acceleration: Array = field(default_factory=_not_asked)
    coupler_jerk: Array = field(default_factory=_not_asked)
    rocker_jerk: Array = field(default_factory=_not_asked)


@dataclass(frozen=True, slots=True)
class FourBarInverseSweep:
    """Four-bar over rocker angles, the rocker driving: `fourbar.FourBarInverseState` as arrays."""

    crank_angle: Array
    coupler_angle: Array
    transmission_angle: Array
    crank_velocity: Array = field(default_factory=_not_asked)
    coupler_velocity: Array = field(default_factory=_not_asked)
    crank_acceleration: Array = field(default_factory=_not_asked)
    coupler_acceleration: Array = field(default_factory=_not_asked)
    crank_jerk: Array = field(default_factory=_not_asked)
    coupler_jerk: Array = field(default_factory=_not_asked)


def solve(
    linkage: FourBar,
    crank_angle: ArrayLike,
    order: int = 0,
    *,
    velocity: ArrayLike = 1.0,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
) -> FourBarSweep:
    """Angles of coupler and rocker over an array of crank angles, and their rates up to the wanted order.

    Parameters
        linkage : FourBar
        crank_angle : array of any shape [rad]
        order : 0..3 - 0 angles only, 1 velocities, 2 accelerations, 3 jerks too
        velocity, acceleration, jerk : float or array that broadcasts [rad/s, rad/s2, rad/s3] - motion of the
            crank; the defaults give the derivatives after the crank angle
    Returns
        sweep : FourBarSweep - angles continuous in the crank angle as in `fourbar.solve`
    Raises
        NoSolution - when the linkage does not close at one of the angles, or rates are wanted at a dead point;
            `assembles` gives the mask
    Example
        >>> sweep = solve(FourBar(18.0, 50.0, 100.0, 121.4), np.radians([45.0, 90.0]), order=1)
        >>> np.round(np.degrees(sweep.rocker_angle), 6).tolist()
        [146.168778, 148.374385]

    Source
        as `fourbar.solve`
    """
    rows = _rows(linkage, np.asarray(crank_angle, dtype=float), order, velocity, acceleration, jerk, "crank")
    return FourBarSweep(*rows)


def solve_inverse(
    linkage: FourBar,
    rocker_angle: ArrayLike,
    order: int = 0,
    *,
    velocity: ArrayLike = 1.0,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
) -> FourBarInverseSweep:
    """Angles of crank and coupler over an array of rocker angles, the rocker driving, and their rates.

    Parameters
        linkage : FourBar - its assembly reads here: sign of sin(crank angle - coupler angle)
        rocker_angle : array of any shape [rad]
        order : 0..3
        velocity, acceleration, jerk : float or array that broadcasts - motion of the rocker
    Returns
        sweep : FourBarInverseSweep - angles continuous in the rocker angle as in `fourbar.solve_inverse`
    Raises
        NoSolution - as in `fourbar.solve_inverse`
    Example
        >>> drag = FourBar(50.0, 45.0, 48.0, 20.0)
        >>> turn = np.array([0.0, 3.0, 12.5])
        >>> np.round(solve_inverse(drag, solve(drag, turn).rocker_angle).crank_angle, 12).tolist()
        [0.0, 3.0, 12.5]

    Source
        own derivation: exchange symmetry of the loop equation
    """
    psi = np.asarray(rocker_angle, dtype=float) + math.pi
    rows = _rows(linkage.inverse(), psi, order, velocity, acceleration, jerk, "rocker")
    swapped = [rows[i + 1] if i % 2 else rows[i - 1] for i in range(3, len(rows))]
    return FourBarInverseSweep(rows[1] + math.pi, rows[0], rows[2], *swapped)


def _rows(
    linkage: FourBar, phi: Array, order: int, velocity: ArrayLike, acceleration: ArrayLike, jerk: ArrayLike, driver: str
) -> list[Array]:
    out = []
    for x in phi.ravel():
        try:
            out.append(fourbar._solve(linkage, float(x), order, 1.0, 0.0, 0.0, driver))
        except NoSolution:
            raise
    table = np.array(out).reshape((-1, 3 + 2 * order)).T
    rows = [row.reshape(phi.shape) for row in table]
    w, e, j = (np.asarray(x, dtype=float) for x in (velocity, acceleration, jerk))
    for i in (0, 1):
        d1 = rows[3 + i] if order >= 1 else None
        d2 = rows[5 + i] if order >= 2 else None
        d3 = rows[7 + i] if order >= 3 else None
        if d1 is not None:
            rows[3 + i] = d1 * w
        if d1 is not None and d2 is not None:
            rows[5 + i] = d2 * w * w + d1 * e
        if d1 is not None and d2 is not None and d3 is not None:
            rows[7 + i] = d3 * w**3 + 3.0 * d2 * w * e + d1 * j
    return rows


def assembles(linkage: FourBar, crank_angle: ArrayLike) -> NDArray[np.bool_]:
    """Whether the linkage closes, for every crank angle of an array.

    Example
        >>> assembles(FourBar(150.0, 160.0, 100.0, 300.0), [0.0, 1.0, 2.0]).tolist()
        [True, True, False]

    Source
        own derivation: signs of P and Q, see `gearlink.core.fourbar`
    """
    half = 0.5 * np.asarray(crank_angle, dtype=float)
    cc, ss = np.cos(half) ** 2, np.sin(half) ** 2
    p = linkage.p_0 * cc + linkage.p_pi * ss
    q = linkage.q_0 * cc + linkage.q_pi * ss
    mask: NDArray[np.bool_] = (p >= 0.0) & (q >= 0.0)
    return mask
