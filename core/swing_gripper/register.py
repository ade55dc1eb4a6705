"""The register of a swing gripper: by how much the tip misses its place along the cylinder at the handover."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.loop_gains import LoopGains, loop_gains
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.design import SwingGripper
from gearlink.core.tolerance.budget import Contribution
from gearlink.core.tolerance.register_design import RegisterDesign, contribution, no_such_place
from gearlink.core.tolerance.sources import Parts, Scatter

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.linkage import GripperMotion
    from gearlink.core.swing_gripper.spec import SwingGripperSpec

_LINKS = {"links.input": "crank", "links.coupler": "coupler", "links.output": "rocker"}
_PINS = ("A", "C", "D", "E")
_PIVOTS = {"pivots.input[0]": 1.0, "pivots.input[1]": 1j, "pivots.output[0]": -1.0, "pivots.output[1]": -1j}


class GripperRegister(RegisterDesign):
    """Place of the gripper tip along the cylinder."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    default_at = "handover"

    @cached_property
    def design(self) -> SwingGripper:
        """The gripper."""
        return SwingGripper(self.spec)

    @property
    def parts(self) -> Parts:
        """Pins of the linkage."""
        return Parts({}, _PINS)

    def stretch(self, at: str) -> tuple[float, float]:
        """The handover, one angle."""
        if at != "handover":
            raise no_such_place(at, ("handover",))
        angle = math.radians(self.spec.handover)
        return angle, angle

    def contributions(self, input_angle: Reals, _torque_sign: int) -> list[Contribution]:
        """Every source of the file, and the cam's own error."""
        motion = self.design.linkage.motion(np.degrees(input_angle), 0)
        gains = self._loop(motion)
        arm = self.spec.arm.length
        found = [contribution(source, arm * self._turn(source, gains)) for source in self.sources]
        if self.section.cam_error is not None:
            found.append(self._cam(motion, input_angle))
        return found

    def _loop(self, motion: GripperMotion) -> LoopGains:
        """Turn of the gripper per error of its loop; directions from +x, as the file's pivots are."""
        return loop_gains(motion.input_angle, motion.coupler_angle, motion.output_angle, self.spec.links.output)

    def _turn(self, source: Scatter, gains: LoopGains) -> Any:
        name = source.key.partition(".")[2]
        if source.kind == "pin":
            return -gains.pin if name == "E" else gains.pin
        if source.key in _LINKS:
            return getattr(gains, _LINKS[source.key])
        if source.key in _PIVOTS:
            return (gains.pin * _PIVOTS[source.key]).real
        message = f"{source.key} does not move the tip along the cylinder: leave it out of a register"
        raise NoSolution(message, key="tolerance.sources")

    def _cam(self, motion: GripperMotion, input_angle: Reals) -> Contribution:
        """Profile error of the main cam: it turns the cam rocker, and that the gripper."""
        cams, error = self.design.cams, self.section.cam_error
        assert error is not None
        lean = cams.main_cam.pressure_angle(input_angle)
        roller = cams.section.roller.arm
        mu_c, mu_d = motion.input_angle - motion.coupler_angle, motion.output_angle - motion.coupler_angle
        ratio = self.spec.links.input * np.sin(mu_c) / (self.spec.links.output * np.sin(mu_d))
        gain = self.spec.arm.length * ratio / (roller * np.cos(lean))
        return Contribution("cam profile", gain, error, error / 3.0, relative=False)
