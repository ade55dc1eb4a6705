"""Digits of a four-bar's position near a dead point: its condition, and refinement with a double-double residual."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.fourbar.position import FourBar
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.double_double import Pair, add, cos_sin, two_product


def dead_point_distance(transmission_angle: ArrayLike) -> Reals:
    """Distance of the transmission angle from a dead point.

    dev = min(gamma, pi - gamma)

    Parameters
        transmission_angle : array [rad]
    Returns
        dev : array [rad]
    Example
        >>> dead_point_distance(np.radians([30.0, 170.0])).round(6).tolist()
        [0.523599, 0.174533]
    """
    gamma = np.asarray(transmission_angle, dtype=np.float64)
    return np.minimum(gamma, np.pi - gamma)


def loop_residual(
    linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike
) -> tuple[Reals, Reals]:
    """Opening of the vector loop, x and y, computed with 106 bits and rounded once.

    r = a e(phi) + b e(theta_b) - d - c e(theta_c)

    Parameters
        linkage : FourBar
        crank_angle, coupler_angle, rocker_angle : arrays that broadcast [rad]
    Returns
        x, y : arrays [mm]
    Example
        >>> x, y = loop_residual(FourBar(3.0, 4.0, 3.0, 4.0), 0.5, 0.0, 0.5)
        >>> float(x), float(y)
        (0.0, 0.0)
    """
    phi, b, c = np.broadcast_arrays(
        *(np.asarray(x, dtype=np.float64) for x in (crank_angle, coupler_angle, rocker_angle))
    )
    zero = np.zeros(phi.shape)
    x, y = Pair(zero - linkage.frame, zero), Pair(zero, zero)
    for length, angle in ((linkage.crank, phi), (linkage.coupler, b), (-linkage.rocker, c)):
        cosine, sine = cos_sin(angle)
        x, y = add(x, _scaled(length, cosine)), add(y, _scaled(length, sine))
    return x.high, y.high


def _scaled(length: float, x: Pair) -> Pair:
    factor = np.full_like(x.high, length)
    return add(two_product(factor, x.high), Pair(factor * x.low, np.zeros_like(factor)))


def refine(
    linkage: FourBar, crank_angle: ArrayLike, coupler_angle: ArrayLike, rocker_angle: ArrayLike, steps: int = 2
) -> tuple[Reals, Reals]:
    """Coupler and rocker angle, refined by Newton steps whose residual carries 106 bits.

    Parameters
        linkage : FourBar
        crank_angle, coupler_angle, rocker_angle : arrays that broadcast [rad] - a position from `position.solve`
        steps : int - one suffices for a transmission angle 1e-4 rad and more off a dead point, two for 1e-6
    Returns
        coupler_angle, rocker_angle : arrays [rad] - within two eps (one unit in the last place of pi/2 to pi)
    Raises
        NoSolution - where coupler and rocker align exactly: no step exists
    Notes
        The lengths and the crank angle are taken as exact. Only the residual needs the long numbers: it is what
        cancels. The plain formulas lose eps/dev, dev = min(gamma, pi - gamma).
    Example
        >>> from gearlink.core.linkages.fourbar.position import solve
        >>> linkage = FourBar(150.0, 160.0, 100.0, 300.0)
        >>> at = solve(linkage, 1.04848)
        >>> coupler, rocker = refine(linkage, 1.04848, at.coupler_angle, at.rocker_angle)
        >>> x, y = loop_residual(linkage, 1.04848, coupler, rocker)
        >>> bool(np.hypot(x, y) < 1e-13)
        True
    """
    phi, b, c = (np.array(x, dtype=np.float64) for x in (crank_angle, coupler_angle, rocker_angle))
    for _ in range(steps):
        x, y = loop_residual(linkage, phi, b, c)
        sine = np.sin(b - c)
        if not np.all(sine):
            raise NoSolution("coupler and rocker align exactly: the position at a dead point cannot be refined")
        step_b = (x * np.cos(c) + y * np.sin(c)) / (linkage.coupler * sine)
        step_c = (x * np.cos(b) + y * np.sin(b)) / (linkage.rocker * sine)
        b, c = b + step_b, c + step_c
    return b, c
