"""Device, law of motion, sizing and balancing of a wide-swing mechanism, from its design file."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design
from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.report import Table, safely_above
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.wide_swing.device import Device
    from gearlink.core.wide_swing.elastic_law import ElasticLaw
    from gearlink.core.wide_swing.iteration import LegacyLaw
    from gearlink.core.wide_swing.oscillating_cam import CrankRockerDrive
    from gearlink.core.wide_swing.slider import SliderLaw
    from gearlink.core.wide_swing.spec import SwingShaft, WideSwingSpec


class WideSwingLaw(Design):
    """The rocker and its unloading device; the cams come with the classes that build on this one."""

    spec: WideSwingSpec

    @cached_property
    def swing(self) -> float:
        """Whole swing gamma [rad]."""
        return math.radians(self.spec.swing)

    @cached_property
    def device(self) -> Device:
        """The unloading device, without dimension."""
        from gearlink.core.wide_swing.device import Pneumatic, Spring

        unloader = self.spec.unloader
        with at_key("unloader.pivot_ratio"):
            if unloader.pivot_ratio <= 1.0:
                raise NoSolution(self._pivot_inside())
            if unloader.type == "pneumatic":
                return Pneumatic(unloader.pivot_ratio)
            return Spring(unloader.pivot_ratio, unloader.stretch_ratio)

    def _pivot_inside(self) -> str:
        return (
            f"pivot ratio {self.spec.unloader.pivot_ratio:g} is not above 1: the base pin must lie outside the circle "
            f"of the arm; make unloader.pivot_ratio at least {safely_above(self.usual_pivot_ratio)}"
        )

    @property
    def usual_pivot_ratio(self) -> float:
        """Least pivot ratio of this device, or of a usual cylinder where the file says too little of a spring."""
        from gearlink.core.wide_swing.device import least_pivot_ratio_pneumatic

        return self.fitting_pivot_ratio or least_pivot_ratio_pneumatic(self.swing)

    @cached_property
    def plain_law(self) -> ElasticLaw:
        """The law of motion that the device gives a rocker alone."""
        from gearlink.core.wide_swing.elastic_law import ElasticLaw

        device = self.device
        with at_key("swing"):
            return ElasticLaw(device, self.swing)

    @cached_property
    def slider_law(self) -> SliderLaw:
        """The law of motion of rocker and slider together."""
        from gearlink.core.wide_swing.slider import SliderDrive, SliderLaw

        section = self.spec.slider
        if section is None:
            raise MissingSection("this needs the section slider: crank, rod, middle_angle, mass", key="slider")
        with at_key("slider.rod"):
            drive = SliderDrive(section.crank, section.rod, math.radians(section.middle_angle), section.offset)
        with at_key("slider.middle_angle"):
            massless = SliderLaw(self.device, self.swing, drive, 1.0)
            return SliderLaw(self.device, self.swing, drive, self._inertia_with(massless.stroke)[1])

    def _inertia_with(self, stroke: float) -> tuple[float, float]:
        from gearlink.core.wide_swing.slider import reference_inertia

        section = self.spec.slider
        mass = 0.0 if section is None else section.mass
        return reference_inertia(self.spec.inertia, mass, stroke, self.swing)

    @property
    def law(self) -> ElasticLaw | SliderLaw:
        """The law of motion of the rocker, with its slider where it has one."""
        return self.plain_law if self.spec.slider is None else self.slider_law

    @property
    def energy_parameter(self) -> float:
        """N."""
        return self.law.energy_parameter

    @property
    def velocity_peak(self) -> float:
        """B."""
        return self.law.velocity_peak

    @property
    def acceleration_peak(self) -> float:
        """C."""
        return self.law.acceleration_peak

    # Slider

    @property
    def slider_stroke(self) -> float:
        """H [mm]."""
        return self.slider_law.stroke

    @property
    def reference_inertia(self) -> float:
        """J_ref, what stands for J in the energy parameter [kg m^2]."""
        return self._inertia_with(self.slider_law.stroke)[0]

    @property
    def rocker_share(self) -> float:
        """j0, the rocker's own share in it."""
        return self.slider_law.rocker_share

    @property
    def middle_place(self) -> float:
        """k at which the rocker passes mid-swing."""
        return self.slider_law.middle_place

    @property
    def slider_velocity_peak(self) -> float:
        """Largest |b_s|."""
        return self.slider_law.slider_velocity_peak

    @property
    def slider_acceleration_peak(self) -> float:
        """Largest |c_s|."""
        return self.slider_law.slider_acceleration_peak

    # Sizing

    @cached_property
    def drive(self) -> CrankRockerDrive:
        """The crank-rocker that carries the cam."""
        from gearlink.core.linkages.fourbar import FourBar
        from gearlink.core.wide_swing.oscillating_cam import CrankRockerDrive

        section = self.spec.drive
        if section is None:
            raise MissingSection("this needs the section drive: crank, coupler, rocker, frame", key="drive")
        with at_key("drive"):
            linkage = FourBar(section.crank, section.coupler, section.rocker, section.frame, section.assembly)
            return CrankRockerDrive(linkage, section.stroke == "outward")

    @cached_property
    def cycle_angle(self) -> float:
        """phi_ud, turn of the shaft that runs evenly during one stroke [rad]."""
        given = self.spec.cycle_angle
        return self.drive.crank_span if given is None else math.radians(given)

    @cached_property
    def stroke_time(self) -> float:
        """Time of one stroke at the design speed [s]."""
        from gearlink.core.wide_swing.balancing import stroke_time

        return stroke_time(self.cycle_angle, self.spec.speed * 2.0 * math.pi / 60.0)

    @property
    def _inertia(self) -> float:
        return self.spec.inertia if self.spec.slider is None else self.reference_inertia

    @property
    def _sizing(self) -> tuple[float, float, float, float, float]:
        return self.energy_parameter, self._inertia, self.swing, self.spec.unloader.arm, self.stroke_time

    @cached_property
    def force(self) -> float | None:
        """Force of a pneumatic device at the design speed [N]."""
        from gearlink.core.wide_swing.device import force

        return force(*self._sizing) if self.spec.unloader.type == "pneumatic" else None

    @cached_property
    def spring_rate(self) -> float | None:
        """Rate of a spring at the design speed [N/mm]."""
        from gearlink.core.wide_swing.device import spring_rate

        return spring_rate(*self._sizing) if self.spec.unloader.type == "spring" else None

    @cached_property
    def min_pivot_ratio(self) -> float | None:
        """Pivot ratio that the device must have, (3) or (4), where the file says enough of it.

        Notes
            (4) holds the spring's mounting stretch, which is taken at the file's own pivot ratio. It falls as
            that ratio grows, so the ratio asked for is met by a design that takes it; `fitting_pivot_ratio` is
            the one that just meets its own.
        """
        unloader = self.spec.unloader
        if unloader.type == "pneumatic" or unloader.closed_length is None:
            return self.fitting_pivot_ratio
        from gearlink.core.wide_swing.device import DeviceGeometry

        stroke = DeviceGeometry(self.device, self.swing).stroke
        dead = (unloader.closed_length + unloader.end_fittings) / unloader.arm
        return 1.0 + dead + unloader.stretch_ratio * stroke

    @cached_property
    def fitting_pivot_ratio(self) -> float | None:
        """Least pivot ratio of a device that just fits, where the file says enough of it."""
        from gearlink.core.wide_swing import device as device

        unloader = self.spec.unloader
        with at_key("unloader"):
            if unloader.type == "pneumatic":
                return device.least_pivot_ratio_pneumatic(self.swing, unloader.extension_ratio)
            fittings, stretch = unloader.end_fittings, unloader.stretch_ratio
            if unloader.closed_length is not None:
                return device.least_pivot_ratio_spring(
                    self.swing, stretch, unloader.arm, unloader.closed_length, fittings
                )
            if unloader.stretch_capacity is not None:
                return device.least_pivot_ratio_spring_material(
                    self.swing, stretch, unloader.stretch_capacity, fittings / unloader.arm
                )
        return None

    # The source's own iteration, for comparison

    @cached_property
    def _iteration(self) -> LegacyLaw:
        from gearlink.core.wide_swing.iteration import legacy_law

        return legacy_law(self.device, self.swing, steps=self.spec.iteration_steps)

    @property
    def iteration_energy_parameter(self) -> float:
        """N as the dissertation's iteration gives it."""
        return float(self._iteration.energy_parameter)

    @property
    def iteration_passes(self) -> int:
        """Marches that the iteration needed."""
        return int(self._iteration.passes)

    @property
    def iteration_error(self) -> float:
        """Relative error of that N."""
        return self.iteration_energy_parameter / self.plain_law.energy_parameter - 1.0

    # Torque and drive

    @cached_property
    def power_peak(self) -> float:
        """max(b c)."""
        from gearlink.core.wide_swing.balancing import power_peak

        return power_peak(self._law_of_rocker_alone("power_peak"))

    @cached_property
    def drive_torque_peak(self) -> float:
        """Torque of the cam shaft without the device at the design speed [N m]."""
        from gearlink.core.wide_swing.balancing import drive_torque_peak

        law = self._law_of_rocker_alone("drive_torque_peak")
        return drive_torque_peak(self.spec.inertia, law, self.stroke_time, self.cycle_angle)

    @property
    def drive_balancing_ratio(self) -> float | None:
        """K_y2 at the design speed; None where no link's torque is left."""
        share = self._shaft.linkage_share
        return (1.0 + share) / share if share > 0.0 else None

    @cached_property
    def dynamic_coefficient(self) -> float:
        """K_d, torque with the drive's elasticity over the calculated torque."""
        from gearlink.core.wide_swing.torsion import acceleration_series, dynamic_coefficient

        shaft, law = self._shaft, self.plain_law
        series = acceleration_series(lambda k: law.invariants(k, 2)[2])
        stiffness = 2.0 * math.pi * shaft.natural_frequency * self.stroke_time
        with at_key("shaft"):
            return dynamic_coefficient(series, stiffness, shaft.damping)[0]

    @property
    def _shaft(self) -> SwingShaft:
        if self.spec.shaft is None:
            raise MissingSection("this needs the section shaft: natural_frequency, damping", key="shaft")
        return self.spec.shaft

    def _law_of_rocker_alone(self, name: str) -> ElasticLaw:
        if self.spec.slider is not None:
            raise NoSolution(f"{name} is that of a rocker without a slider: leave out slider", key="slider")
        return self.plain_law

    @property
    def even_inertia(self) -> float:
        """Inertia of a rocker alone that would need the same device [kg m^2]."""
        if self.spec.slider is None:
            return self.spec.inertia
        return self.reference_inertia * self.energy_parameter / self.plain_law.energy_parameter

    @property
    def harmful_speed(self) -> float:
        """Speed up to which the device raises the torque, n0 sqrt((1 + f)/2) [rev/min]."""
        return self.spec.speed * math.sqrt(0.5 * (1.0 + self.spec.unloader.residual))

    # Tables

    @staticmethod
    def _k(samples: int | None) -> Any:
        import numpy as np

        count = samples or 100
        return np.arange(count + 1) / count

    def table_law(self, samples: int | None = None) -> Table:
        """The invariants of the law over the stroke."""
        k = self._k(samples)
        a, b, c = self.law.invariants(k, 2)
        return Table.of(
            "law", {"k": (k, "1"), "displacement": (a, "1"), "velocity": (b, "1"), "acceleration": (c, "1")}
        )

    def table_slider(self, samples: int | None = None) -> Table:
        """The slider's invariants over the stroke, its travel and its speed at the design speed."""
        k, law = self._k(samples), self.slider_law
        a, b, c = law.slider_invariants(k)
        columns = {
            "k": (k, "1"),
            "displacement": (a, "1"),
            "velocity": (b, "1"),
            "acceleration": (c, "1"),
            "travel": (law.stroke * a, "mm"),
            "speed": (law.stroke / self.stroke_time * b, "mm/s"),
        }
        return Table.of("slider", columns)

    def table_balance(self, _samples: int | None = None) -> Table:
        """Torque on the rocker axis with and without the device, over the speed."""
        import numpy as np

        from gearlink.core.wide_swing.balancing import drive_balancing_ratio, speed_sweep

        share = np.arange(10, 135, 5) / 100.0
        residual = self.spec.unloader.residual
        sweep = speed_sweep(self.even_inertia, self.plain_law, self.stroke_time, share, residual)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = sweep.torque_without / sweep.torque_with
        columns = {
            "speed": (share * self.spec.speed, "1/min"),
            "torque_without": (sweep.torque_without, "N m"),
            "torque_with": (sweep.torque_with, "N m"),
            "ratio": (ratio, "1"),
        }
        if self.spec.shaft is not None:
            columns["drive_ratio"] = (drive_balancing_ratio(share, self.spec.shaft.linkage_share), "1")
        return Table.of("balance", columns)

    def table_iteration(self, _samples: int | None = None) -> Table:
        """Steps of the iteration against its error (run time against error of the source's own method)."""
        from gearlink.core.wide_swing.iteration import legacy_law

        steps = (5, 10, 20, 50, 100, 200)
        laws = [legacy_law(self.device, self.swing, steps=n) for n in steps]
        columns = {
            "steps": (steps, "1"),
            "passes": ([law.passes for law in laws], "1"),
            "energy_parameter": ([law.energy_parameter for law in laws], "1"),
            "relative_error": ([law.energy_parameter / self.plain_law.energy_parameter - 1.0 for law in laws], "1"),
        }
        return Table.of("iteration", columns)
