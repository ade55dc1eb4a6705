"""The gripper's loop both ways: closed form against Newton-Raphson, and the closed form against 40 digits."""

from __future__ import annotations

import math
from dataclasses import dataclass
from decimal import Decimal, localcontext

import numpy as np
from numpy.typing import NDArray

from gearlink.core.machines.swing_gripper.linkage import GripperLinkage, GripperMotion
from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.linkages.fourbar import newton as fourbar_newton
from gearlink.core.parts.linkages.fourbar.position import FourBar


@dataclass(frozen=True, slots=True)
class TwoWays:
    """Closed form and Newton-Raphson at the same positions.

    Attributes
        deviation : (N,) array [rad] - larger difference of the two in the angles of cam rocker and coupler
        iterations : (N,) array of whole numbers - Newton-Raphson steps
        residual : (N,) array [mm] - opening of the loop that Newton-Raphson left
    """

    deviation: Reals
    iterations: NDArray[np.int64]
    residual: Reals


def two_ways(linkage: GripperLinkage, motion: GripperMotion) -> TwoWays:
    """Check the closed form of the linkage by Newton-Raphson on the vector loop.

    Parameters
        linkage : GripperLinkage
        motion : GripperMotion - of any order
    Returns
        ways : TwoWays
    Raises
        NoSolution - where Newton-Raphson finds no position of the assembly
    Notes
        Both lose 8 eps/mu_C near a dead centre, mu_C the angle of cam rocker and coupler; `closed_form_error` tells how
        much of it is the closed form's.
    Source
        swing-gripper paper (4), there called Newton-Simpson; loop in the inverse reading: own derivation
    """
    driving, coupler, rocker = _inverse_angles(linkage, motion)
    bite = linkage.output_direction + linkage.output_shift - linkage.frame_direction + math.pi
    swing = (bite, bite + linkage.swing_sense * linkage.law.total_swing)
    newton = fourbar_newton.solve(linkage.four_bar.inverse(), driving, swing)
    return TwoWays(
        deviation=np.maximum(_apart(newton.coupler_angle, coupler), _apart(newton.rocker_angle, rocker)),
        iterations=newton.iterations,
        residual=newton.residual,
    )


def closed_form_error(linkage: GripperLinkage, motion: GripperMotion) -> Reals:
    """Errors of the closed form in the angles of cam rocker and coupler, the larger of both [rad].

    The Newton-Raphson step from the closed form's position, whose residual is computed with 40 digits

    Parameters
        linkage : GripperLinkage
        motion : GripperMotion - of any order
    Returns
        error : (N,) array [rad]
    """
    inverse, angles = linkage.four_bar.inverse(), _inverse_angles(linkage, motion)
    r = np.array([_opening(inverse, *row) for row in zip(*(x.tolist() for x in angles), strict=True)])
    _, coupler, rocker = angles
    sine = np.abs(np.sin(coupler - rocker))
    of_coupler = np.abs((r * np.exp(-1j * rocker)).real) / (inverse.coupler * sine)
    of_rocker = np.abs((r * np.exp(-1j * coupler)).real) / (inverse.rocker * sine)
    return np.asarray(np.maximum(of_coupler, of_rocker))


def _inverse_angles(linkage: GripperLinkage, motion: GripperMotion) -> tuple[Reals, Reals, Reals]:
    """Angles of driving link, coupler and driven link of the linkage read from E to A."""
    turned = linkage.frame_direction
    return motion.output_angle - turned + math.pi, motion.coupler_angle - turned, motion.input_angle - turned - math.pi


def _opening(links: FourBar, phi: float, coupler: float, rocker: float) -> complex:
    """a e(phi) + b e(theta_b) - c e(theta_c) - d, rounded once."""
    with localcontext() as context:
        context.prec = 40
        x, y = -Decimal(links.frame), Decimal(0)
        for length, angle in ((links.crank, phi), (links.coupler, coupler), (-links.rocker, rocker)):
            cosine, sine = _cos_sin(Decimal(angle))
            x, y = x + Decimal(length) * cosine, y + Decimal(length) * sine
        return complex(x, y)


def _cos_sin(angle: Decimal) -> tuple[Decimal, Decimal]:
    """By their series."""
    sums, term, n = [Decimal(0), Decimal(0)], Decimal(1), 0
    while abs(term) > Decimal("1e-40"):
        sums[n % 2] += term if n % 4 < 2 else -term
        n += 1
        term *= angle / n
    return sums[0], sums[1]


def _apart(one: Reals, other: Reals) -> Reals:
    difference = one - other
    turns: Reals = np.abs(difference - 2.0 * math.pi * np.rint(difference / (2.0 * math.pi)))
    return turns
