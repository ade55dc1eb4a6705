"""Force closure of the swing gripper: contact torques, lift-off speed, and the stop in the near dwell.

Rocker 1 (cam rocker with the linkage) and rocker 2 (return rocker) turn about A; a spring pulls them together
with the torque T_s on each. All rates are in time (rad/s, rad/s^2); lengths in mm, inertia in kg m^2, torque in
N m.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage, GripperMotion
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.numerics.together import kept_last

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import Closure, GripperCams
    from gearlink.core.machines.swing_gripper.motion import Motion
    from gearlink.core.machines.swing_gripper.spec import ArmStop, Inertia, SwingGripperSpec
    from gearlink.core.parts.cams.disc_cam import DiscCam


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
        motion : GripperMotion - of order 2, derivatives by theta
        shaft_speed : float [rad/s] - Omega of the cylinder shaft
    Returns
        torque : (N,) array [N m] - positive in the sense of a growing rocker angle
    Notes
        The ratios k_i come from the geometry, so they exist in the dwells as well.
    Source
        own derivation: principle of virtual work
    """
    k4 = 1.0 / motion.input_ratio
    k3 = motion.coupler_ratio / motion.input_ratio
    square = shaft_speed * shaft_speed
    e1, e3 = np.exp(1j * motion.input.value), np.exp(1j * motion.coupler.value)
    arm, half = linkage.input, 0.5 * linkage.coupler
    per_rocker = 1j * (arm * e1 + half * k3 * e3)
    acceleration = arm * (1j * motion.input.second - motion.input.first**2) * e1
    acceleration += half * (1j * motion.coupler.second - motion.coupler.first**2) * e3
    translation = masses.coupler_mass * _M2 * np.real(np.conj(per_rocker) * acceleration)
    turning = (
        masses.input * motion.input.second
        + masses.output * motion.output.second * k4
        + masses.coupler * motion.coupler.second * k3
    )
    torque: Reals = square * (turning + translation)
    return torque


@dataclass(frozen=True)
class RockerInertia:
    """Inertia torques of both rockers over the revolution.

    Parameters
        shaft_speed : float [rad/s]
    """

    linkage: GripperLinkage
    masses: Masses
    shaft_speed: float

    def torques(self, degrees: Any) -> tuple[Any, Any]:
        """Of the cam rocker with linkage and of the return rocker [N m] at cylinder angles [deg]."""
        motion = self.linkage.motion(degrees, 2)
        main = inertia_torque(self.linkage, motion, self.masses, self.shaft_speed)
        return main, self.masses.return_rocker * motion.input.second * self.shaft_speed**2

    def greatest(self, senses: Sequence[float]) -> tuple[Extreme, ...]:
        """Maximum torque of each rocker in a sense [N m], and the cylinder angle [deg] of it."""
        torques = kept_last(self.torques)
        wanted = [(lambda theta, i=i: np.asarray(senses[i] * torques(theta)[i]), True) for i in range(len(senses))]
        return tuple(extremes_over(wanted, 0.0, 360.0, joints=self.linkage.law.starts[1:-1], samples=720))


def outward_of(cam: DiscCam) -> float:
    """How far a roller moves away from its cam at the pick-up position as its rocker turns; many cams, a column."""
    path = cam.path(np.array([0.0]), 1)
    normal = 1j * cam.sense * (path.first - 1j * cam.sense * path.position)
    found = np.real(np.conj(normal) * path.direction)
    return found if found.ndim > 1 else float(found[0])  # type: ignore[return-value]


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


# The stop on which the arm rests in the near dwell: its force, where the arm meets and leaves it, how it settles


_M = 1e-3  # mm in m


class Stop:
    """An arm at rest on a stop, roller 1 clear of its cam: the spring alone presses it there.

    Parameters
        spec : SwingGripperSpec - with stop, cam, spring and inertia
        motion, cams, closure : parts of the design
    Notes
        Roller and stop never share the load, which could not be told apart. Rebounds run under the spring's force; the
        stop itself and the frame are rigid but for its stiffness in the maximum force.
    Source
        swing-gripper paper 2 names the stop; forces and settling: own derivation
    """

    def __init__(self, spec: SwingGripperSpec, motion: Motion, cams: GripperCams, closure: Closure) -> None:
        self.spec, self.motion, self.cams, self.closure = spec, motion, cams, closure

    @property
    def section(self) -> ArmStop:
        """The section `stop` of the design file."""
        assert self.spec.stop is not None, "asked for only where the file has it"
        return self.spec.stop

    @cached_property
    def _ratios(self) -> tuple[float, float]:
        """Speeds of cam rocker and coupler over that of the arm at the bite, signed."""
        bite = self.motion.linkage.motion(np.zeros(1), 1)
        return float(bite.input_ratio[0]), float(bite.coupler_ratio[0])

    @cached_property
    def force(self) -> float:
        """Force of the spring on the stop, F_s = T_s kappa_1/R_s [N]."""
        first = self._ratios[0]
        if self.closure.lift_sense * self.spec.swing_sense * first < 0.0:
            raise NoSolution(
                "the spring turns the arm away from a stop in the near dwell: the cam lifts its roller on the "
                "return stroke",
                key="stop",
                fix="omit stop, or put the main roller on the other side of its cam",
            )
        return self.closure.closing_torque * abs(first) / (_M * self.section.radius)

    @cached_property
    def angle(self) -> float:
        """Swing at which the arm rests, beta_s = g/(l cos(alpha) kappa_1), of first order in the clearance [rad]."""
        alpha = float(self.cams.main_cam.pressure_angle(np.zeros(1))[0])
        return self.section.clearance / (self.cams.section.roller.arm * math.cos(alpha) * abs(self._ratios[0]))

    @property
    def tip_offset(self) -> float:
        """Way of the tip from the bite as computed to where it rests [mm]."""
        return self.spec.arm.length * self.angle

    @cached_property
    def impact_degrees(self) -> float:
        """Cylinder angle at which the return meets the stop [deg]."""
        self._require_before_the_handover()
        law = self.motion.law
        ends = (law.total_swing - self.angle, -self.angle)
        return bracketed_root(self._off, law.starts[4], law.starts[5], ends=ends)

    @cached_property
    def take_off_degrees(self) -> float:
        """Cylinder angle at which the cam takes the arm off the stop [deg]."""
        self._require_before_the_handover()
        return bracketed_root(self._off, 0.0, self.motion.law.starts[1])

    def _off(self, degrees: float) -> float:
        return self.motion.law.swing(degrees) - self.angle

    def _require_before_the_handover(self) -> None:
        reached = self.motion.law.swing(self.motion.law.starts[1])
        if self.angle < reached:
            return
        most = self.section.clearance * reached / self.angle
        raise NoSolution(
            f"swing at which the stop holds the arm: {math.degrees(self.angle):.4g} deg (below "
            f"{math.degrees(reached):.4g} deg, where the constant speed begins)",
            key="stop.clearance",
            fix=f"set stop.clearance below {most:.4g} mm",
        )

    @property
    def impact_angle(self) -> float:
        """Cylinder angle at which the return meets the stop [rad]."""
        return math.radians(self.impact_degrees)

    @property
    def take_off_angle(self) -> float:
        """Cylinder angle at which the cam takes the arm off the stop [rad]."""
        return math.radians(self.take_off_degrees)

    @property
    def impact_speed(self) -> float:
        """Speed at the stop's radius with which the arm meets it [mm/s]."""
        return self._speed(self.impact_degrees)

    @property
    def take_off_speed(self) -> float:
        """The same where the cam takes over [mm/s]."""
        return self._speed(self.take_off_degrees)

    def _speed(self, degrees: float) -> float:
        rate = float(self.motion.law.evaluate(degrees, 1)[1][0])
        return self.section.radius * self.motion.shaft_speed * abs(rate)

    @cached_property
    def mass(self) -> float:
        """Cam rocker, coupler and gripper as a mass at the stop [kg].

        J = J_E + J_A kappa_1^2 + J_CD kappa_3^2 + m |v_G/w_4|^2,  m_s = J/R_s^2
        """
        assert self.spec.inertia is not None, "the file has it"
        masses, linkage = Masses.of(self.spec.inertia), self.motion.linkage
        first, third = self._ratios
        bite = linkage.motion(np.zeros(1), 0)
        center = linkage.input * first * np.exp(1j * bite.input.value[0])
        center += 0.5 * linkage.coupler * third * np.exp(1j * bite.coupler.value[0])
        turning = masses.output + masses.input * first**2 + masses.coupler * third**2
        whole = turning + masses.coupler_mass * (_M * abs(center)) ** 2
        return float(whole / (_M * self.section.radius) ** 2)

    @property
    def settling_time(self) -> float:
        """Time of the rebounds after the impact, (2 v/a) e/(1 - e) with a = F_s/m_s [ms]."""
        e = self.section.restitution
        return 2.0 * self.impact_speed * self.mass / self.force * e / (1.0 - e)

    @property
    def settling_angle(self) -> float:
        """Cylinder angle of the rebounds [rad]."""
        return self.motion.shaft_speed * 1e-3 * self.settling_time

    @property
    def force_max(self) -> float | None:
        """Maximum force of the impact, F_s + sqrt(F_s^2 + k m_s v^2) [N]; None without a stiffness."""
        stiffness = self.section.stiffness
        if stiffness is None:
            return None
        energy = stiffness / _M * self.mass * (_M * self.impact_speed) ** 2
        return self.force + math.sqrt(self.force**2 + energy)

    @property
    def margin(self) -> float:
        """Cylinder angle that is left from rest on the stop to the end of the turn [deg]."""
        return 360.0 - self.impact_degrees - math.degrees(self.settling_angle)
