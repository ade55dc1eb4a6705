"""The register of a swing gripper: by how much the tip misses its place along the cylinder at the handover."""

from __future__ import annotations

import cmath
import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.design import geometry
from gearlink.core.base.results import cached_property
from gearlink.core.machines.swing_gripper.design import SwingGripper
from gearlink.core.machines.swing_gripper.mechanism import without_cams
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Connection, Contact, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import Turn, carried, fixed, steady
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.register import Off, Output, RegisterDesign, no_such_place
from gearlink.core.studies.tolerance.budget import Contribution
from gearlink.core.studies.tolerance.sources import Parts

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.spec import SwingGripperSpec
    from gearlink.core.mechanism.motion import Motion
    from gearlink.core.studies.movable import Errors

_PINS = ("A", "C", "D", "E")
_PIVOTS = {"pivots.input": "A", "pivots.output": "E", "cam.center": "O"}
_DIRECTION = "arm.direction"
_ROLLING = ("cam.", "pivots.input")
_SIZES = {
    "links.input": (Shift("input", ("C",)),),
    "links.coupler": (Shift("coupler", ("D",)),),
    "links.output": (Shift("output", ("D",)),),
    "cam.roller.radius": (Shift("cam", ("main",), 1.0, "normal"),),
    "cam.roller.angle": (Shift("input", ("main",), math.radians(1.0), turned=True),),
} | {
    f"{key}[{axis}]": (Shift(FRAME, (pin,), way, "frame"),)
    for key, pin in _PIVOTS.items()
    for axis, way in enumerate((1.0, 1j))
}


class GripperRegister(RegisterDesign):
    """Place of the gripper tip along the cylinder."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    default_at = "handover"
    words = "the tip along the cylinder"
    design = geometry(SwingGripper)

    @property
    def parts(self) -> Parts:
        """Pins of the linkage."""
        return Parts({}, _PINS)

    def stretch(self, at: str) -> tuple[float, float]:
        """The handover, one angle."""
        if at != "handover":
            raise no_such_place(at, ("handover",))
        angle = self.design.motion.handover_angle
        return angle, angle

    @property
    def errors(self) -> Errors:
        """By size; the arm of the roller stands at its angle from AC."""
        roller = None if self.spec.cam is None else self.spec.cam.roller
        along = 1.0 if roller is None else cmath.exp(1j * math.radians(roller.angle))
        return _SIZES | {"cam.roller.arm": (Shift("input", ("main",), along),)}

    def own_gain(self, key: str, input_angle: Reals) -> Reals | None:
        """The arm on its link."""
        return np.full(input_angle.shape, math.radians(self.spec.arm.length)) if key == _DIRECTION else None

    def contributions(self, input_angle: Reals, torque_sign: int) -> list[Contribution]:
        """Every source of the file, and the cam's own error."""
        gains = self.gains(input_angle, torque_sign)
        found = self.of_sources(gains, input_angle)
        if self.section.cam_error is not None:
            found.append(gains.profile("main", self.section.cam_error))
        return found

    @cached_property
    def _rolls(self) -> bool:
        """Whether something moves the main roller or its cam.

        Notes
            Without a cam the rocker turns as the law says, wherever its pivot stands.
        """
        moved = any(one.key in ("pins.A", "bearings.A") or one.key.startswith(_ROLLING) for one in self.sources)
        return self.section.cam_error is not None or (moved and self.spec.cam is not None)

    def mechanism(self, input_angle: Reals) -> Mechanism:
        """The linkage in the machine's frame, on its cam where that counts."""
        bare = self._bare.make(input_angle, 1, 1)
        if not self._rolls:
            return bare
        cam, roller = self.design.cams.main_cam, self.design.cams.section.roller
        axis = fixed(self.design.cam_center, input_angle, order=1)
        links = {**bare.links, "cam": Link(axis, steady(input_angle, cam.sense, order=1))}
        at = links["input"].at(cmath.rect(roller.arm, math.radians(roller.angle))).value
        bend = cam.curvature(input_angle)
        joints: list[Connection] = [
            *bare.connections,
            Pin("O", FRAME, "cam", axis.value),
            Contact("main", "cam", "input", at, cam.normals(input_angle), curvature=bend),
        ]
        return Mechanism(links, joints, "cam", float(cam.sense))

    @cached_property
    def _bare(self) -> Motion:
        """The motion of the linkage alone."""
        return without_cams(self.design)

    def output(self, input_angle: Reals) -> Output:
        """The place of the tip along the direction in which it should move."""
        arm = cmath.rect(self.spec.arm.length, math.radians(self.spec.arm.direction - self.spec.output_direction))
        turned = self._bare.at(input_angle.ravel(), 0).links["output"].turn.value.reshape(input_angle.shape)
        along = 1j * np.exp(1j * turned) * arm / abs(arm)

        def output(mechanism: Mechanism, parts: Off = None) -> Sequence[Reals]:
            link, off = mechanism.links["output"], (parts or {}).get(_DIRECTION, 0.0)
            turn = Turn(link.turn.value + np.radians(off), *link.turn[1:])
            return [(along.conj() * rate).real for rate in carried(link.origin, turn, arm)]

        return output
