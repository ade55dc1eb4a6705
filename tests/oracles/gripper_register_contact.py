"""The main roller on its cam when parts have errors: by how much the cam rocker AC stands too far round."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import GripperCams
    from gearlink.core.machines.swing_gripper.linkage import GripperMotion

ROLLER = {"cam.roller.arm": "arm", "cam.roller.radius": "radius", "cam.roller.angle": "angle"}
_STEPS = 4


@dataclass(frozen=True)
class RollerContact:
    """Contact of the main roller at some cylinder angles, in the machine's frame; (N,) arrays.

    The cam keeps its profile and its axis, and the roller rests on it. An error at the contact then turns the rocker by

    d psi = (dr - Re(n* (a - o)) - dl Re(n* u))/(l Re(n* i u))

    with dr of the roller's radius or of the profile outwards, a and o of the pivot A and of the cam's axis, dl of the
    roller's arm.

    Fields
        arm : float [mm] - l, from A to the roller's centre
        along : complex - u, direction of that arm
        normal : complex - n, from the contact to the roller's centre
        curvature : [1/mm] - of the pitch curve, convex positive
    Source
        own derivation: the contact differentiated along the common normal
    """

    arm: float
    along: Points
    normal: Points
    curvature: Reals

    @property
    def _across(self) -> Reals:
        """Cosine of the pressure angle, with the sign of the turn that lifts the roller."""
        lifts: Reals = (np.conj(self.normal) * 1j * self.along).real
        return lifts

    @property
    def radius(self) -> Reals:
        """Turn of the rocker per mm of the roller's radius, or of the profile outwards [rad/mm]."""
        return 1.0 / (self.arm * self._across)

    @property
    def length(self) -> Reals:
        """Turn of the rocker per mm of the roller's arm [rad/mm]."""
        return -(np.conj(self.normal) * self.along).real * self.radius

    @property
    def pivot(self) -> Points:
        """Turn per mm of an error vector v of the pivot A, Re(v pivot) [rad/mm]; of the cam's axis the opposite."""
        turn: Points = -self.normal.conj() * self.radius
        return turn

    def turned(self, off: Mapping[str, Any]) -> Any:
        """By how much the rocker stands too far round, exactly but for the third order of the profile [rad].

        Parameters
            off : errors by arm, radius [mm], angle [deg], A, center (vectors [mm]); they broadcast against (N, 1)
        Notes
            The roller's centre is sought along the pitch curve, which is replaced by a parabola: errors of 0.1 mm on a
            cam of 100 mm leave some 1e-7 mm.
        """
        normal, along, bend = (part[:, None] for part in (self.normal, self.along, self.curvature))
        tangent, start = 1j * normal, off["center"] - off["A"] + self.arm * along + off["radius"] * normal
        length, x = self.arm + off["arm"], 0.0
        for _ in range(_STEPS):
            from_pivot = start + x * tangent - 0.5 * bend * x * x * normal
            way = tangent - bend * x * normal
            excess = np.abs(from_pivot) - length
            x = x - excess * np.abs(from_pivot) / (np.conj(from_pivot) * way).real
        from_pivot = start + x * tangent - 0.5 * bend * x * x * normal
        return np.angle(from_pivot * np.conj(along)) - np.radians(off["angle"])


def roller_contact(cams: GripperCams, motion: GripperMotion, input_angle: Reals) -> RollerContact:
    """The main roller's contact at cylinder angles [rad], parts without errors."""
    cam, roller = cams.main_cam, cams.section.roller
    along: Points = np.exp(1j * (motion.input.value + math.radians(roller.angle)))
    return RollerContact(roller.arm, along, cam.normals(input_angle), cam.curvature(input_angle))
