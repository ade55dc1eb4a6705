"""The rocker of a wide-swing mechanism in motion: its device, its law, and the drive that times the stroke."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.machines.wide_swing.device import (
    Device,
    DeviceGeometry,
    Gravity,
    Pneumatic,
    Spring,
    least_pivot_ratio_pneumatic,
    least_pivot_ratio_spring,
    least_pivot_ratio_spring_material,
)
from gearlink.core.machines.wide_swing.law import ElasticLaw
from gearlink.core.machines.wide_swing.oscillating_cam import CrankRockerDrive
from gearlink.core.machines.wide_swing.remedies import drive_repair, slider_repair, with_number
from gearlink.core.machines.wide_swing.sizing import free_stretch
from gearlink.core.machines.wide_swing.slider import SliderDrive, SliderLaw, reference_inertia
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.machines.wide_swing.spec import GravityDevice, SwingSlider, WideSwingSpec

MOST_STRETCH = 2.0
"""Stretch over closed length that a spring of steel bears at most."""


class Motion:
    """How the rocker moves, from the design file; every result is computed when it is read."""

    def __init__(self, spec: WideSwingSpec) -> None:
        self.spec = spec

    @cached_property
    def swing(self) -> float:
        """Whole swing gamma [rad]."""
        return math.radians(self.spec.swing)

    # Device

    @cached_property
    def device(self) -> Device:
        """The unloading device, without dimension."""
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            return Gravity()
        with at_key("unloader.pivot_ratio"):
            if unloader.pivot_ratio <= 1.0:
                raise NoSolution(
                    f"pivot ratio {unloader.pivot_ratio:g} is not above 1: the base pin must lie outside the "
                    "circle of the arm",
                    fix=f"make unloader.pivot_ratio at least {safely_above(self.usual_pivot_ratio)}",
                )
            if unloader.type == "pneumatic":
                return Pneumatic(unloader.pivot_ratio)
            return Spring(unloader.pivot_ratio, self.stretch_ratio)

    @cached_property
    def stretch_ratio(self) -> float:
        """eps of a spring, mounting stretch over stroke: as given, or from its free length."""
        unloader = self.spec.unloader
        assert unloader.type == "spring", "a cylinder has no stretch"
        if unloader.free_length is None:
            assert unloader.stretch_ratio is not None, "the file has one of them"
            return unloader.stretch_ratio
        lengths = DeviceGeometry(Pneumatic(unloader.pivot_ratio), self.swing)
        return free_stretch(unloader.free_length, unloader.arm, lengths.shortest, lengths.stroke)

    @property
    def usual_pivot_ratio(self) -> float:
        """Minimum pivot ratio of this device, or of a usual cylinder where the file says too little of a spring."""
        return self.min_pivot_ratio or least_pivot_ratio_pneumatic(self.swing)

    @cached_property
    def min_pivot_ratio(self) -> float | None:
        """Minimum pivot ratio of a device that just fits, (3) or (4) solved, where the file says enough of it."""
        unloader = self.spec.unloader
        if unloader.type == "gravity":
            return None
        with at_key("unloader"):
            if unloader.type == "pneumatic":
                return least_pivot_ratio_pneumatic(self.swing, unloader.extension_ratio)
            fittings, stretch, arm = unloader.end_fittings, self.stretch_ratio, unloader.arm
            if unloader.closed_length is not None:
                return least_pivot_ratio_spring(self.swing, stretch, arm, unloader.closed_length, fittings)
            if unloader.stretch_capacity is not None:
                capacity = unloader.stretch_capacity
                return least_pivot_ratio_spring_material(self.swing, stretch, capacity, fittings / arm)
        return None

    @property
    def least_ratio_of_steel(self) -> float:
        """Minimum pivot ratio between whose pins a spring of steel finds room, whatever its length."""
        unloader = self.spec.unloader
        assert unloader.type == "spring", "a cylinder has a length"
        fittings = unloader.end_fittings / unloader.arm
        with at_key("unloader"):
            return least_pivot_ratio_spring_material(self.swing, self.stretch_ratio, MOST_STRETCH, fittings)

    # Law

    @cached_property
    def plain_law(self) -> ElasticLaw:
        """The law of motion that the device gives a rocker alone."""
        device = self.device
        with at_key("swing"):
            return ElasticLaw(device, self.swing)

    @cached_property
    def slider_drive(self) -> SliderDrive:
        """Rod and slider on the rocker."""
        section = self._slider_section
        with at_key("slider.rod"):
            return SliderDrive(section.crank, section.rod, math.radians(section.middle_angle), section.offset)

    @cached_property
    def slider(self) -> SliderLaw:
        """The law of motion of rocker and slider together; a refusal at a dead centre names the angle to change."""
        return self._slider_with(self.rocker_inertia)

    def _slider_with(self, inertia: float) -> SliderLaw:
        drive = self.slider_drive
        try:
            with at_key("slider.middle_angle"):
                massless = SliderLaw(self.device, self.swing, drive, 1.0)
                return SliderLaw(self.device, self.swing, drive, self._inertia_with(inertia, massless.stroke)[1])
        except NoSolution as error:
            if error.key != "slider.middle_angle":
                raise
            raise with_number(error, slider_repair(drive, self.swing)) from error

    @property
    def _slider_section(self) -> SwingSlider:
        if self.spec.slider is None:
            raise MissingSection("the command needs the section slider: crank, rod, middle_angle, mass", key="slider")
        return self.spec.slider

    def _inertia_with(self, inertia: float, stroke: float) -> tuple[float, float]:
        return reference_inertia(inertia, self._slider_section.mass, stroke, self.swing)

    @property
    def law(self) -> ElasticLaw | SliderLaw:
        """The law of motion of the rocker, with its slider where it has one."""
        return self.plain_law if self.spec.slider is None else self.slider

    @property
    def highest(self) -> int:
        """The highest derivative that the law has."""
        return 3 if self.spec.slider is None else 2

    @property
    def reference_inertia(self) -> float:
        """J_ref of rocker and slider, what stands for J in the energy parameter [kg m^2]."""
        return self._inertia_with(self.rocker_inertia, self.slider.stroke)[0]

    @property
    def inertia(self) -> float:
        """J, or J_ref where there is a slider, that of a pendulum counted [kg m^2]."""
        return self.rocker_inertia if self.spec.slider is None else self.reference_inertia

    @property
    def rocker_inertia(self) -> float:
        """J0 of all that turns with the rocker, that of a pendulum counted [kg m^2]."""
        return self.spec.inertia if self.spec.unloader.type != "gravity" else self._hung(self.hanging_mass)

    # Pendulum

    @property
    def pendulum(self) -> GravityDevice:
        """The section of a device of type gravity."""
        unloader = self.spec.unloader
        assert unloader.type == "gravity", "needed of a pendulum alone"
        return unloader

    def _hung(self, mass: float) -> float:
        """J_0 + m s^2 [kg m^2]."""
        return self.spec.inertia + mass * (1e-3 * self.pendulum.distance) ** 2

    @property
    def pendulum_rate(self) -> float:
        """kappa = N gamma^2/(2 T^2), static moment over inertia that balances a rocker at the design speed [1/s^2]."""
        return self._rate_of(self.plain_law)

    def _rate_of(self, law: ElasticLaw | SliderLaw) -> float:
        return 0.5 * law.energy_parameter * (self.swing / self.stroke_time) ** 2

    def _moment_for(self, mass: float) -> float:
        """kappa J, static moment that balances a rocker with this mass at the design speed, and its slider [N m]."""
        inertia = self._hung(mass)
        if self.spec.slider is None:
            return self.pendulum_rate * inertia
        law = self._slider_with(inertia)
        return self._rate_of(law) * self._inertia_with(inertia, law.stroke)[0]

    @cached_property
    def hanging_mass(self) -> float:
        """Mass of the pendulum, as given or with its reserve [kg]."""
        unloader = self.pendulum
        return self.pendulum_mass(1.0 + unloader.reserve) if unloader.mass is None else unloader.mass

    def pendulum_mass(self, whole: float) -> float:
        """m = w kappa J_0/(g s - w kappa s^2), w the static moment over the one that balances [kg].

        With a slider N and J depend on the mass: m g s = w kappa J, solved. J N is a concave function of m, so that
        there is one root.

        Raises
            NoSolution - where a pendulum so long is too slow
        """
        unloader, need = self.pendulum, whole * self.pendulum_rate
        s = 1e-3 * unloader.distance
        if need * s >= unloader.gravity:
            most = safely_below(1e3 * unloader.gravity / need)
            message = f"a pendulum this long is too slow for {self.spec.speed:g} 1/min: below {most} mm"
            raise NoSolution(message, key="unloader.distance")
        per = need / (s * (unloader.gravity - need * s))
        if self.spec.slider is None:
            return per * self.spec.inertia
        section = self._slider_section
        high = per * (self.spec.inertia + section.mass * (1e-3 * section.crank) ** 2)
        return _only_root(lambda mass: mass * unloader.gravity * s - whole * self._moment_for(mass), high)

    @property
    def most_pendulum_reserve(self) -> float:
        """g/(kappa s) - 1, which a pendulum of this length does not reach with any mass."""
        return self.pendulum.gravity / (self.pendulum_rate * 1e-3 * self.pendulum.distance) - 1.0

    def pendulum_reserve(self, mass: float) -> float:
        """m g s/(kappa J) - 1, J = J_0 + m s^2."""
        unloader = self.pendulum
        return mass * unloader.gravity * 1e-3 * unloader.distance / self._moment_for(mass) - 1.0

    # Drive

    @cached_property
    def drive(self) -> CrankRockerDrive:
        """The crank-rocker that carries the cam; its refusal names the length to change."""
        section = self.spec.drive
        if section is None:
            raise MissingSection("the command needs the section drive: crank, coupler, rocker, frame", key="drive")
        try:
            with at_key("drive"):
                linkage = FourBar(section.crank, section.coupler, section.rocker, section.frame, section.assembly)
                return CrankRockerDrive(linkage, section.stroke == "outward")
        except NoSolution as error:
            raise with_number(error, drive_repair(section)) from error

    @property
    def transmission_angles(self) -> dict[str, float]:
        """Minimum transmission angles [rad] by the key of the part that they are of: `drive`, `slider.rod`."""
        found = {}
        if self.spec.drive is not None:
            found["drive"] = self.drive.linkage.min_transmission_angle()
        if self.spec.slider is not None:
            found["slider.rod"] = self.slider.drive.least_transmission(self.swing)
        return found

    @cached_property
    def cycle_angle(self) -> float:
        """phi_ud, turn of the shaft that runs evenly during the working stroke [rad]."""
        if self.spec.cycle is not None:
            return self.cycle_angles[0]
        given = self.spec.cycle_angle
        return self.drive.crank_span if given is None else math.radians(given)

    @property
    def return_angle(self) -> float:
        """The same of the return stroke [rad]."""
        return self.cycle_angle if self.spec.cycle is None else self.cycle_angles[2]

    @property
    def cycle_angles(self) -> tuple[float, float, float, float]:
        """Working stroke, far dwell, return stroke, near dwell [rad]."""
        if self.spec.cycle is None:
            words = "the command needs the section cycle: working, far_dwell, return, near_dwell"
            raise MissingSection(words, key="cycle")
        working, far, back, near = (math.radians(length) for length in self.spec.cycle.lengths)
        return working, far, back, near

    @property
    def device_angle(self) -> float:
        """Cam angle of the shorter stroke [rad]: one device serves both, and its free swing takes one time."""
        return min(self.cycle_angle, self.return_angle)

    @cached_property
    def stroke_time(self) -> float:
        """Time of the shorter stroke at the design speed [s]; the device is sized by it."""
        return self._time_of(self.device_angle)

    @cached_property
    def working_time(self) -> float:
        """Time of the working stroke at the design speed [s]."""
        return self._time_of(self.cycle_angle)

    def _time_of(self, angle: float) -> float:
        return angle / (self.spec.speed * 2.0 * math.pi / 60.0)


def _only_root(excess: Callable[[float], float], near: float) -> float:
    """Root of a function that is negative below it and positive above."""
    while excess(near) <= 0.0:
        near *= 2.0
    while excess(low := 0.5 * near) > 0.0:
        near = low
    return bracketed_root(excess, low, near)
