"""How a machine runs: at a constant speed, with a flywheel at a constant drive torque, or with a motor."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.errors import MissingSection
from gearlink.core.base.results import cached_property
from gearlink.core.studies.loads.panels import Panels

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.loads.design import LoadsDesign
    from gearlink.core.studies.loads.motor import MotorRun

RPM = 2.0 * math.pi / 60.0


class Running:
    """Flywheel, motor and the speed over the input angle of one design.

    Parameters
        design : LoadsDesign
    """

    def __init__(self, design: LoadsDesign) -> None:
        self.design = design
        self.flywheel, self.motor = design.section.flywheel, design.section.motor

    @cached_property
    def motor_inertia(self) -> float:
        """The motor's inertia at the input [kg m^2]."""
        return 0.0 if self.motor is None else self.motor.inertia * self.motor.ratio**2

    @cached_property
    def needed(self) -> float | None:
        """Flywheel for the fluctuation of the file [kg m^2]; None where it asks for none."""
        if self.flywheel is None or self.flywheel.fluctuation is None:
            return None
        speed = abs(self.design.speed)
        return float(self.design.energy.flywheel_for(self.flywheel.fluctuation, speed, self.motor_inertia))

    @cached_property
    def inertia(self) -> float:
        """All constant inertia on the input: flywheel, given or needed, and motor [kg m^2]."""
        given = None if self.flywheel is None else self.flywheel.inertia
        return (given if given is not None else self.needed or 0.0) + self.motor_inertia

    @cached_property
    def run(self) -> Any:
        """The periodic run; None at constant speed, or where the machine stops."""
        if self.motor is not None:
            return self.motor_run
        if self.flywheel is None:
            return None
        self._require_inertia()
        return self.design.energy.run(self.inertia, abs(self.design.speed))

    def _require_inertia(self) -> None:
        least = self.design.reflected_inertia_min + self.inertia
        if not least > 0.0:
            raise MissingSection(
                "without any inertia on the input its speed is not defined",
                key="loads.flywheel",
                fix="give loads.flywheel: {inertia: kg m^2}, or masses in loads.links",
            )

    @cached_property
    def stops(self) -> bool:
        """Whether the flywheel is too small to come round at a constant drive torque."""
        return self.motor is None and self.flywheel is not None and self.run is None

    @cached_property
    def slope(self) -> float:
        """k at the input [N m s]."""
        motor = self.motor
        assert motor is not None, "needed only with a motor"
        if motor.slope is not None:
            return float(motor.slope * motor.ratio**2)
        slip = (motor.no_load_speed - motor.rated_speed) * RPM
        return float(motor.rated_torque / slip * motor.ratio**2)

    @cached_property
    def motor_run(self) -> MotorRun:
        """The run with the motor, over an angle that rises with time."""
        from gearlink.core.studies.loads.motor import MotorRun

        self._require_inertia()
        machine = self.design.machine
        forward = machine.speed > 0.0
        breaks = machine.breaks if forward else sorted(machine.period - angle for angle in machine.breaks)

        def at(angle: Reals) -> Reals:
            return angle if forward else machine.period - angle

        def load(angle: Reals) -> Reals:
            tau = machine.load_torque(at(angle))
            return tau if forward else -tau

        return MotorRun(
            load,
            lambda angle: machine.reduced(at(angle)).inertia + self.inertia,
            Panels.over(machine.period, breaks),
            self.slope,
            self.motor.no_load_speed / self.motor.ratio * RPM,
            tuple(breaks),
        )

    # Over the input angle

    def _own_angle(self, phi: Reals) -> Reals:
        """The angle of the run at input angles: with a motor it rises with time."""
        machine = self.design.machine
        if self.motor is not None and machine.speed < 0.0:
            return np.mod(machine.period - phi, machine.period)
        return phi

    def speed(self, phi: Reals) -> Reals:
        """Speed of the input [rad/s], signed."""
        if self.run is None:
            return np.full_like(phi, self.design.speed)
        found: Reals = math.copysign(1.0, self.design.speed) * self.run.speed(self._own_angle(phi))
        return found

    @cached_property
    def _paces(self) -> Reals:
        """Time per angle at the nodes of the machine's panels [s]."""
        return np.asarray(1.0 / np.abs(self.speed(self.design.machine.panels.nodes)))

    def time(self, phi: Reals) -> Reals:
        """Time since input angle 0 at input angles of the period [s], the input turning its own way; each stands alone.

        Notes
            An input that turns backwards comes to the maximum angles first.
        """
        panels = self.design.machine.panels
        edges = panels.running(self._paces)
        found = np.asarray(edges[panels.row(phi)] + panels.within(self._paces, phi))
        return np.where(found > 0.0, edges[-1] - found, 0.0) if self.design.speed < 0.0 else found

    @cached_property
    def range(self) -> tuple[float, float]:
        """Minimum and maximum speed, magnitudes [1/min]."""
        if self.run is None:
            speed = abs(self.design.speed) / RPM
            return speed, speed
        low, high = self.run.range
        return low / RPM, high / RPM

    @property
    def fluctuation(self) -> float:
        """(maximum - minimum)/mean of the two."""
        low, high = self.range
        return 2.0 * (high - low) / (high + low)

    @cached_property
    def motor_rms(self) -> float | None:
        """Root mean square of the motor's torque at its own shaft [N m]."""
        return None if self.motor is None else self.motor_run.rms_torque / self.motor.ratio

    @cached_property
    def motor_peak(self) -> float | None:
        """The motor's torque of the maximum magnitude at its own shaft [N m]; negative where the load drives it.

        Notes
            Its torque falls with its speed, so that the maximum is that at the minimum speed or at the maximum.
        """
        if self.motor is None:
            return None
        at_ends = [self.slope * (self.motor_run.no_load - speed) / self.motor.ratio for speed in self.motor_run.range]
        return float(max(at_ends, key=abs))
