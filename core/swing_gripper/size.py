"""The smallest cams of a swing gripper: the cam centre that keeps a pressure angle on every roller."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gearlink.core.cams.size import CamCenter, RockingRoller, smallest_cam_of_rollers
from gearlink.core.numerics.arrays import Reals
from gearlink.core.swing_gripper.linkage import GripperLinkage


@dataclass(frozen=True, slots=True)
class RollerArm:
    """A roller on the cam rocker.

    Attributes
        arm : float [mm] - from A to the roller
        from_input : float [rad] - angle of the arm from AC
        side : +1 where the cam lies on the left of the arm (seen from A), -1 on the right
    """

    arm: float
    from_input: float
    side: int


def smallest_cam_center(
    linkage: GripperLinkage, arms: Sequence[RollerArm], sense: int, pressure_angle: float, *, refined: bool = True
) -> CamCenter:
    """Cam centre nearest to the first roller at which no roller exceeds a pressure angle.

    Parameters
        linkage : GripperLinkage
        arms : sequence of RollerArm - all rollers of the cam shaft
        sense : +1 or -1 - of the cam
        pressure_angle : float [rad]
        refined : bool - as of `smallest_cam_of_rollers`
    Returns
        best : CamCenter - in the machine's frame
    Raises
        NoSolution - no centre serves
    """
    rollers = [_rocking_roller(linkage, arm) for arm in arms]
    joints = tuple(math.radians(start) for start in linkage.law.starts[1:-1])
    return smallest_cam_of_rollers(rollers, pressure_angle, sense=sense, joints=joints, refined=refined)


def _rocking_roller(linkage: GripperLinkage, arm: RollerArm) -> RockingRoller:
    def law(cam_angle: Reals) -> tuple[Reals, Reals]:
        motion = linkage.motion(np.degrees(cam_angle), 1)
        return motion.input_angle + arm.from_input, motion.input_velocity

    return RockingRoller(law, linkage.input_pivot, arm.arm, arm.side)
