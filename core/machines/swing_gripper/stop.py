"""The stop on which the arm rests in the near dwell: its force, where the arm meets and leaves it, how it settles."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.machines.swing_gripper.forces import Masses
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import Closure, GripperCams
    from gearlink.core.machines.swing_gripper.motion import Motion
    from gearlink.core.machines.swing_gripper.spec import ArmStop, SwingGripperSpec

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
        assert self.spec.stop is not None, "needed only where the file has it"
        return self.spec.stop

    @cached_property
    def _ratios(self) -> tuple[float, float]:
        """Speeds of cam rocker and coupler over that of the arm at the pick-up position, signed."""
        state = self.motion.linkage.ratios(np.zeros(1))
        return float(state.crank_velocity[0]), float(state.coupler_velocity[0])

    @cached_property
    def force(self) -> float:
        """Force of the spring on the stop, F_s = T_s kappa_1/R_s [N]."""
        first = self._ratios[0]
        if self.closure.lift_sense * self.spec.swing_sense * first < 0.0:
            raise NoSolution(
                "the spring turns the arm away from a stop in the near dwell: the cam lifts its roller on the "
                "return stroke",
                key="stop",
                fix="leave out stop, or put the main roller on the other side of its cam",
            )
        return self.closure.closing_torque * abs(first) / (_M * self.section.radius)

    @cached_property
    def angle(self) -> float:
        """Swing at which the arm rests, beta_s = g/(l cos(alpha) kappa_1), of first order in the clearance [rad]."""
        alpha = float(self.cams.main_cam.pressure_angle(np.zeros(1))[0])
        return self.section.clearance / (self.cams.section.roller.arm * math.cos(alpha) * abs(self._ratios[0]))

    @property
    def tip_offset(self) -> float:
        """Way of the tip from the pick-up position as computed to where it rests [mm]."""
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
        return float(self.motion.law.evaluate(degrees, 0)[0][0]) - self.angle

    def _require_before_the_handover(self) -> None:
        reached = float(self.motion.law.evaluate(self.motion.law.starts[1], 0)[0][0])
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
        center = linkage.input * first * np.exp(1j * bite.input_angle[0])
        center += 0.5 * linkage.coupler * third * np.exp(1j * bite.coupler_angle[0])
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
