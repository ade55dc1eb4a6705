"""What the unloading device of a wide-swing mechanism must bear, and what it leaves to the drive."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from typing import TYPE_CHECKING

from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.wide_swing.cams.outline import AnyCam
    from gearlink.core.wide_swing.law.iteration import LegacyLaw
    from gearlink.core.wide_swing.motion import Motion
    from gearlink.core.wide_swing.spec import SwingShaft, WideSwingSpec


class Unloading:
    """Size of the device and torques of the shafts, from the design file and the rocker's motion."""

    def __init__(self, spec: WideSwingSpec, motion: Motion, way_back: Callable[[], Extreme] | None = None) -> None:
        self.spec, self.motion, self._way_back = spec, motion, way_back

    # Size

    @property
    def _sizing(self) -> tuple[float, float, float, float, float]:
        motion = self.motion
        parameter = motion.law.energy_parameter
        return parameter, motion.inertia, motion.swing, self.spec.unloader.arm, motion.stroke_time

    @property
    def _whole(self) -> float:
        """1 + rho, force of the device over the one that balances the inertia at the design speed."""
        return 1.0 + self.spec.unloader.reserve

    @cached_property
    def force(self) -> float | None:
        """Force of a pneumatic device, with its reserve [N]."""
        from gearlink.core.wide_swing.law.device import force

        return self._whole * force(*self._sizing) if self.spec.unloader.type == "pneumatic" else None

    @cached_property
    def spring_rate(self) -> float | None:
        """Rate of a spring, with its reserve [N/mm]."""
        from gearlink.core.wide_swing.law.device import spring_rate

        return self._whole * spring_rate(*self._sizing) if self.spec.unloader.type == "spring" else None

    @cached_property
    def iteration(self) -> LegacyLaw:
        """The source's own iteration, for comparison."""
        from gearlink.core.wide_swing.law.iteration import legacy_law

        return legacy_law(self.motion.device, self.motion.swing, steps=self.spec.iteration_steps)

    @property
    def iteration_error(self) -> float:
        """Relative error of the iteration's N."""
        return float(self.iteration.energy_parameter) / self.motion.plain_law.energy_parameter - 1.0

    # Torque and drive

    @cached_property
    def power_peak(self) -> float:
        """max(b c)."""
        from gearlink.core.wide_swing.law.balancing import power_peak

        return power_peak(self.motion.rocker_alone("power_peak"))

    @cached_property
    def drive_torque_peak(self) -> float:
        """Torque of the cam shaft without the device and without `linkage_share` at the design speed [N m]."""
        from gearlink.core.wide_swing.law.balancing import drive_torque_peak

        motion, law = self.motion, self.motion.rocker_alone("drive_torque_peak")
        return drive_torque_peak(self.spec.inertia, law, motion.stroke_time, motion.device_angle)

    @property
    def drive_balancing_ratio(self) -> float | None:
        """K_y2 at the design speed; None where no torque is left."""
        share, unloader = self._shaft.linkage_share, self.spec.unloader
        left = unloader.reserve + unloader.residual + share
        return (1.0 + share) / left if left > 0.0 else None

    @cached_property
    def dynamic_coefficient(self) -> float:
        """K_d, torque with the drive's elasticity over the calculated torque."""
        from gearlink.core.wide_swing.torsion import acceleration_series, dynamic_coefficient

        shaft, law = self._shaft, self.motion.plain_law
        stiffness = 2.0 * math.pi * shaft.natural_frequency * self.motion.stroke_time
        with at_key("shaft"):
            series = acceleration_series(lambda k: law.invariants(k, 2)[2])
            return dynamic_coefficient(series, stiffness, shaft.damping)[0]

    @property
    def _shaft(self) -> SwingShaft:
        if self.spec.shaft is None:
            raise MissingSection("this needs the section shaft: natural_frequency, damping", key="shaft")
        return self.spec.shaft

    @property
    def even_inertia(self) -> float:
        """Inertia of a rocker alone that would need the same device [kg m^2]."""
        motion = self.motion
        if self.spec.slider is None:
            return self.spec.inertia
        return motion.reference_inertia * motion.slider.energy_parameter / motion.plain_law.energy_parameter

    @property
    def harmful_speed(self) -> float:
        """Speed up to which the device raises the torque, n0 sqrt((1 + rho + f)/2) [rev/min]."""
        return self.spec.speed * math.sqrt(0.5 * (self._whole + self.spec.unloader.residual))

    # Force closure

    @cached_property
    def way_back(self) -> Extreme | None:
        """The place where an oscillating cam that swings home asks most of the device; None with no such way back."""
        try:
            return None if self._way_back is None else self._way_back()
        except NoSolution:  # of a cam that cannot be, which fails in checks of its own
            return None

    @property
    def need(self) -> float:
        """k_b, greatest acceleration of the rocker on its way back over that of the stroke; 1 where they are alike."""
        return 1.0 if self.way_back is None else self.way_back.value

    @property
    def lift_off_speed(self) -> float:
        """Speed above which the roller leaves its cam, n0 sqrt((1 + rho - f)/k_b) [rev/min]."""
        return self.spec.speed * math.sqrt((self._whole - self.spec.unloader.residual) / self.need)

    def contact_force(
        self, cam: AnyCam, k: Reals, speed_ratio: float | Reals = 1.0, need: float | Reals = 1.0
    ) -> Reals:
        """Force of the roller on a cam, along their normal.

        F = J gamma |c| ((1 + rho) - k_b (n T0/(n0 T))^2)/(T0^2 r cos delta), with a slider +-(N/2) E_a in place of |c|

        Parameters
            cam : WideSwingCam or OscillatingCam
            k : (N,) array - fractions of the stroke, mid-swing left out
            speed_ratio : float or (N,) array - n/n0
            need : float or (N,) array - k_b, the rocker's acceleration over that of the stroke
        Returns
            force : (N,) array [N] - positive where the profile is pressed, in run-up and run-out; negative where the
                roller leaves it
        Notes
            Friction is left out. In run-up the device is stronger than the inertia and the cam holds the rocker back;
            in run-out the inertia is weaker than the device and the cam pushes. T0 is the time of the shorter of two
            strokes, T that of the cam's own. With a slider the device changes sides at mid-swing, the roller where the
            rocker is fastest: between the two the force is negative.
        """
        import numpy as np

        from gearlink.core.wide_swing.cams.outline import middle_of

        motion = self.motion
        speed_ratio = speed_ratio * (motion.device_angle / cam.cycle_angle)
        scale = 1e3 * motion.inertia * motion.swing / (motion.stroke_time**2 * cam.rocker_radius)
        torque = motion.torque(k) * np.where(k < middle_of(cam), 1.0, -1.0)
        excess = self.spec.unloader.reserve - (speed_ratio - 1.0) * (speed_ratio + 1.0) * need - (need - 1.0)
        force: Reals = scale * excess * torque / np.cos(cam.pressure_angle(k))
        return force

    def dwell_force(self, cams: Iterable[AnyCam]) -> float:
        """Greatest force of a roller on its cam during the rests, when the cam bears the whole device [N].

        F = (1 + rho) J gamma c(0)/(T0^2 r cos delta0)

        Parameters
            cams : of both strokes
        Returns
            force : float [N] - it also acts at the ends of the strokes of a machine that barely turns
        """
        import numpy as np

        return max(float(self.contact_force(cam, np.array([0.0, 1.0]), 0.0).max()) for cam in cams)
