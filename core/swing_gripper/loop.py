"""The gripper's loop both ways: closed form against Newton-Raphson, and both against a loop of 106 bits."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlink.core.linkages.fourbar import newton as fourbar_newton
from gearlink.core.linkages.fourbar.refine import refine
from gearlink.core.numerics.arrays import Reals
from gearlink.core.swing_gripper.linkage import GripperLinkage, GripperMotion


@dataclass(frozen=True, slots=True)
class TwoWays:
    """Closed form and Newton-Raphson at the same positions.

    Attributes
        deviation : (N,) array [rad] - larger difference of the two in the angles of cam rocker and coupler
        error : (N,) array [rad] - of the closed form, against a loop closed with 106 bits
        iterations : (N,) array of whole numbers - Newton-Raphson steps
        residual : (N,) array [mm] - opening of the loop that Newton-Raphson left
    """

    deviation: Reals
    error: Reals
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
        Both lose 8 eps/mu_C near a dead point, mu_C the angle of cam rocker and coupler; `error` tells how much
        of it is the closed form's.
    Source
        swing-gripper paper (4), there called Newton-Simpson; loop in the inverse reading: own derivation
    """
    inverse = linkage.four_bar.inverse()
    driving = motion.output_angle - linkage.frame_direction + math.pi
    coupler = motion.coupler_angle - linkage.frame_direction
    rocker = motion.input_angle - linkage.frame_direction - math.pi
    bite = linkage.output_direction + linkage.output_shift - linkage.frame_direction + math.pi
    swing = (bite, bite + linkage.swing_sense * linkage.law.total_swing)
    newton = fourbar_newton.solve(inverse, driving, swing)
    exact = refine(inverse, driving, coupler, rocker)
    return TwoWays(
        deviation=np.maximum(_apart(newton.coupler_angle, coupler), _apart(newton.rocker_angle, rocker)),
        error=np.maximum(_apart(exact[0], coupler), _apart(exact[1], rocker)),
        iterations=newton.iterations,
        residual=newton.residual,
    )


def _apart(one: Reals, other: Reals) -> Reals:
    difference = one - other
    turns: Reals = np.abs(difference - 2.0 * math.pi * np.rint(difference / (2.0 * math.pi)))
    return turns
