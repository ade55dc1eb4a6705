"""The vector loop of a four-bar: its angles in 60 digits, and its rates by the differentiated loop in unit vectors.

r = a e(phi) + b e(theta_b) - d - c e(theta_c),    e(x) = exp(i x)
"""

from __future__ import annotations

from typing import Any

import mpmath as mp
import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar.position import FourBar


def exact_angles(linkage: FourBar, phi: float) -> tuple[mp.mpf, mp.mpf]:
    """Coupler and rocker angle by the law of cosines, 60 digits."""
    with mp.workdps(60):
        a, b, c, d = (mp.mpf(x) for x in (linkage.crank, linkage.coupler, linkage.rocker, linkage.frame))
        pivot = d - a * mp.expj(mp.mpf(phi))
        n, nu = abs(pivot), mp.arg(pivot)
        at_b = mp.acos((n * n + b * b - c * c) / (2 * b * n))
        at_d = mp.acos((n * n + c * c - b * b) / (2 * c * n))
        return nu + linkage.assembly * at_b, nu + linkage.assembly * (mp.pi - at_d)


def loop_rates(
    linkage: FourBar,
    crank_angle: ArrayLike,
    coupler_angle: ArrayLike,
    rocker_angle: ArrayLike,
    order: int = 2,
    *,
    velocity: ArrayLike = 1.0,
    acceleration: ArrayLike = 0.0,
    jerk: ArrayLike = 0.0,
) -> tuple[Reals, ...]:
    """Rates of coupler and rocker from the differentiated vector loop: the paper's matrices, solved.

    w_b = w a sin(phi - theta_c) / (b s),  w_c = w a sin(phi - theta_b) / (c s),  s = sin(theta_c - theta_b)

    Parameters
        linkage, crank_angle, coupler_angle, rocker_angle - a position [rad]
        order : 1..3
        velocity, acceleration, jerk : float or arrays - motion of the crank; the defaults give the derivatives
            with respect to the crank angle
    Returns
        rates : tuple of 2 order arrays - coupler and rocker velocity, acceleration, jerk
    Raises
        NoSolution - where coupler and rocker align exactly
    Notes
        Independent of the rates of `position.solve`, which differentiate the angles of a triangle.
    Example
        >>> linkage = FourBar(18.0, 50.0, 100.0, 121.4)
        >>> from gearlink.core.parts.linkages.fourbar.position import solve
        >>> at = solve(linkage, 0.0)
        >>> [round(float(x), 9) for x in loop_rates(linkage, 0.0, at.coupler_angle, at.rocker_angle, 1)]
        [-0.174081238, -0.174081238]

    Source
        swing-gripper paper (6), (7) with the sign of l3 cos theta3 corrected; thesis (4-24), (4-25); jerk: own
        derivation
    """
    angles = (np.asarray(x, dtype=np.float64) for x in (crank_angle, coupler_angle, rocker_angle))
    e_a, e_b, e_c = (np.exp(1j * x) for x in angles)
    if not np.all((e_c * e_b.conjugate()).imag):
        raise NoSolution("coupler and rocker align: their rates are not determined; move the crank off the dead centre")
    motion = (np.asarray(x, dtype=np.float64) for x in (velocity, acceleration, jerk))
    return tuple(unit_rates(linkage, e_a, e_b, e_c, order, *motion))


def unit_rates(
    linkage: FourBar, e_a: Any, e_b: Any, e_c: Any, order: int, w: Any, acceleration: Any, jerk: Any
) -> list[Any]:
    """`loop_rates` from unit vectors that are complex numbers or arrays of them."""
    a, b, c = linkage.crank, linkage.coupler, linkage.rocker
    with_b, with_c, turn = e_a * e_b.conjugate(), e_a * e_c.conjugate(), e_c * e_b.conjugate()
    b_s, c_s, cos = b * turn.imag, c * turn.imag, turn.real
    w_b, w_c = w * a * with_c.imag / b_s, w * a * with_b.imag / c_s
    if order == 1:
        return [w_b, w_c]
    drive = w * w * 1j * e_a + acceleration * e_a
    drive_b, drive_c = a * (drive * e_c.conjugate()).imag, a * (drive * e_b.conjugate()).imag
    a_b = (drive_b + b * w_b**2 * cos - c * w_c**2) / b_s
    a_c = (drive_c + b * w_b**2 - c * w_c**2 * cos) / c_s
    if order == 2:
        return [w_b, w_c, a_b, a_c]
    drive = 3.0 * w * acceleration * 1j * e_a + (jerk - w * w * w) * e_a
    drive_b, drive_c = a * (drive * e_c.conjugate()).imag, a * (drive * e_b.conjugate()).imag
    j_b = w_b**3 + (drive_b + 3.0 * (b * w_b * a_b * cos - c * w_c * a_c)) / b_s
    j_c = w_c**3 + (drive_c + 3.0 * (b * w_b * a_b - c * w_c * a_c * cos)) / c_s
    return [w_b, w_c, a_b, a_c, j_b, j_c]
