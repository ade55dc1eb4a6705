"""The handover of a swing gripper: where its tip meets the cylinder, how fast, and how it leaves the pitch circle."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.handover_geometry import TipPath
    from gearlink.core.swing_gripper.motion import Motion
    from gearlink.core.swing_gripper.spec import SwingGripperSpec


class Handover:
    """Speed and place of the tip at the handover."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

    @cached_property
    def speed(self) -> float:
        """Speed of the gripper tip at the handover [mm/s]."""
        return self.spec.arm.length * self.state[1] * self.motion.shaft_speed

    @cached_property
    def mismatch(self) -> float:
        """Speed of the tip less that of the cylinder's surface [mm/s]."""
        return self.speed - self.spec.cylinder.radius * self.motion.shaft_speed

    @cached_property
    def state(self) -> tuple[float, float]:
        """Swing angle [rad] and its rate by the cylinder angle at the handover."""
        import numpy as np

        beta, rate = self.motion.law.evaluate(np.array([self.spec.handover]), 1)
        return float(beta[0]), float(rate[0])

    @cached_property
    def tip(self) -> complex:
        """The gripper tip at the handover [mm]."""
        arm = self.spec.arm
        direction = math.radians(arm.direction) + self.spec.swing_sense * self.state[0]
        return complex(*self.spec.pivots.output) + cmath.rect(arm.length, direction)

    @cached_property
    def center(self) -> complex:
        """Axis of a cylinder whose pitch circle the tip meets on the line of centres at the handover [mm]."""
        from gearlink.core.swing_gripper.handover_geometry import drum_center

        return drum_center(complex(*self.spec.pivots.output), self.tip, self.spec.cylinder.radius)

    def path(self, degrees: Any) -> tuple[Any, Any, TipPath]:
        """Lead of the arm on the line of centres [rad], tip speed [mm/s] and path of the tip at cylinder angles."""
        import numpy as np

        from gearlink.core.swing_gripper.handover_geometry import tip_path

        arm, radius = self.spec.arm.length, self.spec.cylinder.radius
        distance, lead_0 = arm + radius, 0.0
        if self.spec.cylinder.center is not None:
            pivot = complex(*self.spec.pivots.output)
            line = complex(*self.spec.cylinder.center) - pivot
            distance = abs(line)
            lead_0 = self.spec.swing_sense * cmath.phase((self.tip - pivot) / line)
        beta, rate = self.motion.law.evaluate(np.fmod(degrees + 360.0, 360.0), 1)
        lead = lead_0 + beta - self.state[0]
        turned = np.radians(degrees - self.spec.handover)
        return lead, arm * rate * self.motion.shaft_speed, tip_path(arm, radius, distance, lead, turned, lead_0)
