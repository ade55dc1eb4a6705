"""Force closure of the swing gripper: inertia torque on the cam rocker, contact torques, lift-off speed.

Rocker 1 (cam rocker with the linkage) and rocker 2 (return rocker) turn about A; a spring pulls them together
with the torque T_s on each. All rates are in time (rad/s, rad/s^2); lengths in mm, inertia in kg m^2, torque in
N m.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage, GripperMotion
from gearlink.core.numerics.arrays import Reals

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.spec import Inertia

_M2 = 1e-6  # mm^2 in m^2


@dataclass(frozen=True, slots=True)
class Masses:
    """Moments of inertia [kg m^2] and the coupler's mass [kg], its centre at mid-length."""

    input: float
    output: float
    coupler: float
    coupler_mass: float
    return_rocker: float

    @classmethod
    def of(cls, inertia: Inertia) -> Masses:
        """From the section of a design file."""
        return cls(inertia.input, inertia.output, inertia.coupler, inertia.coupler_mass, inertia.return_rocker)


def inertia_torque(linkage: GripperLinkage, motion: GripperMotion, masses: Masses, shaft_speed: float) -> Reals:
    """Torque that moves cam rocker and linkage, about A.

    T_in = J_A a_1 + J_E a_4 k_4 + J_CD a_3 k_3 + m Re(conj(v_G/w_1) a_G),  k_i = w_i/w_1

    Parameters
        linkage : GripperLinkage
        motion : GripperMotion - of order 2, derivatives by theta
        masses : Masses
        shaft_speed : float [rad/s] - Omega of the cylinder shaft
    Returns
        torque : (N,) array [N m] - positive in the sense of a growing rocker angle
    Notes
        The ratios k_i come from the geometry, so they exist in the dwells as well.
    Source
        own derivation: principle of virtual work
    """
    ratios = linkage.ratios(motion.beta)
    k4 = 1.0 / ratios.crank_velocity
    k3 = ratios.coupler_velocity / ratios.crank_velocity
    square = shaft_speed * shaft_speed
    e1, e3 = np.exp(1j * motion.input_angle), np.exp(1j * motion.coupler_angle)
    arm, half = linkage.input, 0.5 * linkage.coupler
    per_rocker = 1j * (arm * e1 + half * k3 * e3)
    acceleration = arm * (1j * motion.input_acceleration - motion.input_velocity**2) * e1
    acceleration += half * (1j * motion.coupler_acceleration - motion.coupler_velocity**2) * e3
    translation = masses.coupler_mass * _M2 * np.real(np.conj(per_rocker) * acceleration)
    turning = (
        masses.input * motion.input_acceleration
        + masses.output * motion.output_acceleration * k4
        + masses.coupler * motion.coupler_acceleration * k3
    )
    torque: Reals = square * (turning + translation)
    return torque


def contact_torques(spring: float, inertia: Reals, return_inertia: Reals, lift_sense: int) -> tuple[Reals, Reals]:
    """Torques that press the main and the return roller to their cams [N m].

    T_1 = T_s + s_c T_in,  T_2 = T_s - s_c J_2 psi_2''

    Parameters
        spring : float [N m] - T_s
        inertia : (N,) array [N m] - T_in of rocker 1
        return_inertia : (N,) array [N m] - J_2 psi_2'' of rocker 2
        lift_sense : +1 or -1 - sign of the rocker's turn that lifts roller 1
    """
    return spring + lift_sense * inertia, spring - lift_sense * return_inertia


def lift_off_speed(speed: float, spring: float, worst: float) -> float:
    """Speed at which the first roller leaves its cam.

    n* = n sqrt(T_s/max(-s_c T_in)): inertia grows with n^2, the spring's torque does not

    Parameters
        speed : float - n, any unit
        spring : float [N m] - T_s
        worst : float [N m] - largest inertia torque that unloads a roller at n
    Returns
        speed : float - in the unit of n; inf where nothing unloads a roller
    Example
        >>> round(lift_off_speed(12000.0, 400.0, 287.6326512))
        14151
    """
    return speed * math.sqrt(spring / worst) if worst > 0.0 else math.inf


@dataclass(frozen=True)
class LeverSpring:
    """A pull spring between two arms about A.

    Parameters
        first_arm, second_arm : float [mm] - p, q: from A to the spring's ends
        angle : float [rad] - delta between the arms, in (0, pi)
        preload : float [N] - F_0, pull at the reference length
        rate : float [N/mm] - k; 0: the pull is the preload at any length
        reference_length : float [mm] - L_0
    Raises
        NoSolution - the spring would have to push
    Example
        >>> spring = LeverSpring(120.0, 110.0, math.radians(88.0), 300.0, 25.0, 90.0)
        >>> round(spring.length, 6), round(spring.torque, 6)
        (159.933278, 168.954899)

    Source
        own derivation: the torque is dU/d delta of the spring's energy
    """

    first_arm: float
    second_arm: float
    angle: float
    preload: float
    rate: float = 0.0
    reference_length: float = 0.0

    def __post_init__(self) -> None:
        if self.pull <= 0.0:
            if self.rate <= 0.0:
                raise NoSolution("the spring pulls with 0 N", fix="give it a preload")
            most = safely_below(self.reference_length + self.pull / self.rate)
            raise NoSolution(
                f"the spring, {short(self.length)} mm long, is slack: no force closes the cam pair",
                fix=f"set its length at preload below {most} mm",
            )

    @property
    def length(self) -> float:
        """L = sqrt((p - q)^2 + 4 p q sin^2(delta/2)) [mm]."""
        p, q = self.first_arm, self.second_arm
        return math.hypot(p - q, 2.0 * math.sqrt(p * q) * math.sin(0.5 * self.angle))

    @property
    def pull(self) -> float:
        """F = F_0 + k (L - L_0) [N]."""
        return self.preload + self.rate * (self.length - self.reference_length if self.rate else 0.0)

    @property
    def lever(self) -> float:
        """Torque per pull, p q sin(delta)/L [N m/N]."""
        return 1e-3 * self.first_arm * self.second_arm * math.sin(self.angle) / self.length

    @property
    def torque(self) -> float:
        """T_s = F p q sin(delta)/L [N m]."""
        return self.pull * self.lever
