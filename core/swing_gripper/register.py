"""The register of a swing gripper: by how much the tip misses its place along the cylinder at the handover."""

from __future__ import annotations

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.fourbar.loop_gains import LoopGains, closed_pin, loop_gains
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.design import SwingGripper
from gearlink.core.swing_gripper.register_contact import ROLLER, RollerContact, roller_contact
from gearlink.core.tolerance.budget import Contribution
from gearlink.core.tolerance.register_design import RegisterDesign, contribution, no_such_place
from gearlink.core.tolerance.sources import Parts, Scatter

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.linkage import GripperMotion
    from gearlink.core.swing_gripper.spec import SwingGripperSpec

_LINKS = {"links.input": "crank", "links.coupler": "coupler", "links.output": "rocker"}
_PINS = ("A", "C", "D", "E")
_VECTORS = {
    "pivots.input[0]": ("A", 1.0),
    "pivots.input[1]": ("A", 1j),
    "pivots.output[0]": ("E", 1.0),
    "pivots.output[1]": ("E", 1j),
    "cam.center[0]": ("center", 1.0),
    "cam.center[1]": ("center", 1j),
}
_ROLLING = {"pins.A", "bearings.A", *ROLLER, *(key for key, (part, _) in _VECTORS.items() if part != "E")}


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
        gains, contact = self._loop(motion), self._contact(motion, input_angle)
        found = [contribution(source, self._gain(source, gains, motion, contact)) for source in self.sources]
        if (error := self.section.cam_error) is not None:
            profile = self._per_turn(motion) * roller_contact(self.design.cams, motion, input_angle).radius
            found.append(Contribution("cam profile", np.abs(profile), error, error / 3.0, relative=False))
        return found

    def _contact(self, motion: GripperMotion, input_angle: Reals) -> RollerContact | None:
        """The main roller on its cam; None where no source moves one of them, or the file has no cam.

        Notes
            Without a cam the rocker turns as the law says, wherever its pivot stands.
        """
        moved = any(one.key in _ROLLING for one in self.sources)
        return roller_contact(self.design.cams, motion, input_angle) if moved and self.spec.cam is not None else None

    def _per_turn(self, motion: GripperMotion) -> Reals:
        """Way of the tip per turn of the cam rocker [mm/rad]."""
        links = self.spec.links
        mu_c, mu_d = motion.input_angle - motion.coupler_angle, motion.output_angle - motion.coupler_angle
        way: Reals = self.spec.arm.length * links.input * np.sin(mu_c) / (links.output * np.sin(mu_d))
        return way

    def _loop(self, motion: GripperMotion) -> LoopGains:
        """Turn of the gripper per error of its loop; directions from +x, as the file's pivots are."""
        return loop_gains(motion.input_angle, motion.coupler_angle, motion.output_angle, self.spec.links.output)

    def _along(self, motion: GripperMotion) -> Any:
        """Direction in which the tip turns."""
        lead = math.radians(self.spec.arm.direction - self.spec.output_direction)
        return 1j * np.exp(1j * (motion.output_angle + lead))

    def _gain(self, source: Scatter, gains: LoopGains, motion: GripperMotion, contact: RollerContact | None) -> Any:
        """Gain of a source: the gripper turns, and the axis E takes the tip along."""
        arm, name = self.spec.arm.length, source.key.partition(".")[2]
        vectors = self._vectors(gains, motion, contact)
        if source.kind == "pin":
            return vectors[name]
        if source.key in _LINKS:
            return arm * getattr(gains, _LINKS[source.key])
        if source.key in _VECTORS:
            part, way = _VECTORS[source.key]
            return (vectors[part] * way).real
        if source.key in ROLLER and contact is not None:
            turns: dict[str, Any] = {"arm": contact.length, "radius": contact.radius, "angle": -math.radians(1.0)}
            return self._per_turn(motion) * turns[ROLLER[source.key]]
        if source.key == "arm.direction":
            return np.full(np.shape(motion.output_angle), math.radians(arm))
        message = f"{source.key} does not move the tip along the cylinder: leave it out of a register"
        raise NoSolution(message, key="tolerance.sources")

    def _vectors(self, gains: LoopGains, motion: GripperMotion, contact: RollerContact | None) -> dict[str, Any]:
        """Gains of what has a direction, by pin, and of the cam's axis.

        Notes
            A rocker whose pivot A is moved turns as well, since its roller stays on the cam.
        """
        loop = self.spec.arm.length * gains.pin
        found = dict.fromkeys(_PINS, loop) | {"E": np.conj(self._along(motion)) - loop}
        if contact is not None:
            rolled = self._per_turn(motion) * contact.pivot
            found |= {"A": loop + rolled, "center": -rolled}
        return found

    # Samples of the exact chain

    def sampled_errors(self, input_angle: Reals, _torque_sign: int, parts: Mapping[str, Any]) -> Reals:
        """Errors of the tip along the cylinder, the loop closed anew."""
        links, off = self.spec.links, self._by_part(parts)
        motion = self.design.linkage.motion(np.degrees(input_angle), 0)
        contact = self._contact(motion, input_angle)
        first, last = motion.input_angle[:, None], motion.output_angle[:, None]
        a, e = (complex(*pivot) for pivot in (self.spec.pivots.input, self.spec.pivots.output))
        pin, joint = a + links.input * np.exp(1j * first), e + links.output * np.exp(1j * last)
        side = int(np.sign(((joint - pin) / (e - pin)).imag[0, 0]))
        rocker = (links.input + off["links.input"]) * np.exp(1j * (first + (contact.turned(off) if contact else 0.0)))
        start = a + off["A"] + rocker + off["C"] + off["D"]
        coupler, output = links.coupler + off["links.coupler"], links.output + off["links.output"]
        moved = closed_pin(start, e + off["E"], coupler, output, side) - e - off["E"]
        turned = np.angle(moved * np.exp(-1j * last)) + np.radians(off["arm.direction"])
        along = (off["E"] * np.conj(self._along(motion)[:, None])).real
        error: Reals = along + self.spec.arm.length * np.sin(turned)
        return error

    def _by_part(self, parts: Mapping[str, Any]) -> dict[str, Any]:
        """Errors by link and roller, and by pin as vectors, those of its pivot added."""
        off: dict[str, Any] = dict.fromkeys((*_LINKS, *_PINS, *ROLLER.values(), "center", "arm.direction"), 0.0)
        for source in self.sources:
            name, error = ROLLER.get(source.key, source.key), parts[source.key]
            if source.kind == "pin":
                name = source.key.partition(".")[2]
            elif source.key in _VECTORS:
                name, error = _VECTORS[source.key][0], error * _VECTORS[source.key][1]
            off[name] = off[name] + error
        return off
