"""Where the joints of a swing gripper stand: linkage, gripper tip, and the drum that the sheet is handed to."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Points
from gearlink.core.swing_gripper.linkage import GripperLinkage


@dataclass(frozen=True, slots=True)
class GripperPositions:
    """Joints [mm] over the cylinder angle in the machine's frame; the pivots A and E stand still."""

    a: complex
    c: Points
    d: Points
    e: complex
    f: Points


def positions(
    linkage: GripperLinkage, arm_length: float, arm_direction: float, degrees: NDArray[np.float64]
) -> GripperPositions:
    """Joints of A-C-D-E and of the gripper tip F at cylinder angles.

    C = A + AC e^(i th1),  D = E + ED e^(i th4),  F = E + EF e^(i (gamma_0 + s beta))

    Parameters
        linkage : GripperLinkage
        arm_length : float [mm] - EF
        arm_direction : float [rad] - gamma_0, direction of EF at the bite
        degrees : (N,) array [deg] - cylinder angles
    Returns
        positions : GripperPositions
    Raises
        NoSolution - where the linkage does not close
    Source
        swing-gripper paper (4), (5)
    """
    motion = linkage.motion(degrees, 0)
    a, e = linkage.input_pivot, linkage.output_pivot
    return GripperPositions(
        a=a,
        c=a + linkage.input * np.exp(1j * motion.input_angle),
        d=e + linkage.output * np.exp(1j * motion.output_angle),
        e=e,
        f=e + arm_length * np.exp(1j * (arm_direction + linkage.swing_sense * motion.beta)),
    )


def drum_center(pivot: complex, tip: complex, radius: float) -> complex:
    """Centre of the drum whose rim the gripper tip touches on the line of centres.

    O_t = E + (l + R) (F - E)/l

    Parameters
        pivot, tip : complex [mm] - E, and F at the handover
        radius : float [mm] - R of the drum
    Example
        >>> drum_center(0j, 30.0 + 40.0j, 10.0)
        (36+48j)

    Source
        swing-gripper paper 2 (handover on the line of centres)
    """
    arm = tip - pivot
    return pivot + arm * (1.0 + radius / abs(arm))
