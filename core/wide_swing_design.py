"""The wide-swing cam mechanism with unloading device as a design."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline
from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.report import Check, Status, Table, safely_above, safely_below

if TYPE_CHECKING:
    from gearlink.core.specs.wide_swing import SwingCam, WideSwingSpec
    from gearlink.core.unloading import ElasticLaw
    from gearlink.core.unloading_device import Device
    from gearlink.core.wide_swing import WideSwingCam

_LAW = ("energy_parameter", "velocity_peak", "acceleration_peak", "min_pivot_ratio", "force", "spring_rate")
_PROFILE = (
    "rocker_radius",
    "min_radius",
    "max_radius",
    "profile_correction",
    "phase_angle",
    "start_curvature_radius",
    "transition_zone",
    "max_pressure_angle",
)
_ITERATION = ("iteration_energy_parameter", "iteration_passes", "iteration_error")
_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_CAM_CHECKS = ("profile-exists", "pressure-angle", "cam-undercut", "transition-zone", "shaft-clearance")


class WideSwingDesign(Design):
    """A twin-cam or twin-rocker mechanism, from its design file to every quantity that is asked for."""

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    outlines = {
        "swing": Outline(_LAW, ("unloader-turnability", "balancing"), ("law", "balance")),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline(_LAW, ("unloader-turnability", "balancing"), ("law", "balance")),
    }
    extra_tables = ("iteration",)

    def outline(self, command: str) -> Outline:
        """`swing` and `analyze` add the profile where the file has a cam, and the iteration where it asks for it."""
        outline = self.outlines[command]
        if command == "cam":
            return outline
        quantities, checks, tables = outline.quantities, outline.checks, outline.tables
        if self.spec.cam is not None:
            quantities, checks = (*quantities, *_PROFILE), (*checks, *_CAM_CHECKS)
        if self.spec.method == "iteration":
            quantities, tables = (*quantities, *_ITERATION), (*tables, "iteration")
        if command == "analyze" and self.spec.cam is not None:
            quantities, tables = (*quantities, "min_curvature_radius"), (*tables, "main_cam", "return_cam")
        return Outline(quantities, checks, tables)

    def quantity_names(self) -> tuple[str, ...]:
        """Every quantity, those of an optional section included."""
        return tuple(dict.fromkeys((*_LAW, *_PROFILE, *_CAM, *_ITERATION)))

    # Device and law of motion

    @cached_property
    def swing(self) -> float:
        """Whole swing gamma [rad]."""
        return math.radians(self.spec.swing)

    @cached_property
    def device(self) -> Device:
        """The unloading device, without dimension."""
        from gearlink.core.unloading_device import Pneumatic, Spring

        unloader = self.spec.unloader
        with at_key("unloader.pivot_ratio"):
            if unloader.type == "pneumatic":
                return Pneumatic(unloader.pivot_ratio)
            return Spring(unloader.pivot_ratio, unloader.stretch_ratio)

    @cached_property
    def law(self) -> ElasticLaw:
        """The law of motion that the device gives the rocker."""
        from gearlink.core.unloading import ElasticLaw

        device = self.device
        with at_key("swing"):
            return ElasticLaw(device, self.swing)

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

    @cached_property
    def stroke_time(self) -> float:
        """Time of one stroke at the design speed [s]."""
        from gearlink.core.balancing import stroke_time

        return stroke_time(math.radians(self.spec.cycle_angle), self.spec.speed * 2.0 * math.pi / 60.0)

    @property
    def _sizing(self) -> tuple[float, float, float, float, float]:
        return self.energy_parameter, self.spec.inertia, self.swing, self.spec.unloader.arm, self.stroke_time

    @cached_property
    def force(self) -> float | None:
        """Force of a pneumatic device at the design speed [N]."""
        from gearlink.core.unloading_device import force

        return force(*self._sizing) if self.spec.unloader.type == "pneumatic" else None

    @cached_property
    def spring_rate(self) -> float | None:
        """Rate of a spring at the design speed [N/mm]."""
        from gearlink.core.unloading_device import spring_rate

        return spring_rate(*self._sizing) if self.spec.unloader.type == "spring" else None

    @cached_property
    def min_pivot_ratio(self) -> float | None:
        """Least pivot ratio, where the file says enough of the device."""
        from gearlink.core import unloading_device

        unloader = self.spec.unloader
        with at_key("unloader"):
            if unloader.type == "pneumatic":
                return unloading_device.least_pivot_ratio_pneumatic(self.swing, unloader.extension_ratio)
            if unloader.closed_length is None:
                return None
            return unloading_device.least_pivot_ratio_spring(
                self.swing, unloader.stretch_ratio, unloader.arm, unloader.closed_length, unloader.end_fittings
            )

    # The source's own iteration, for comparison

    @cached_property
    def _iteration(self) -> Any:
        from gearlink.core.unloading_iteration import legacy_law

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
        return self.iteration_energy_parameter / self.energy_parameter - 1.0

    def table_iteration(self) -> Table:
        """Steps of the iteration against its error (run time against error of the source's own method)."""
        from gearlink.core.unloading_iteration import legacy_law

        steps = (5, 10, 20, 50, 100, 200)
        laws = [legacy_law(self.device, self.swing, steps=n) for n in steps]
        errors = [law.energy_parameter / self.energy_parameter - 1.0 for law in laws]
        return Table(
            "iteration",
            ("steps", "passes", "energy_parameter", "relative_error"),
            ("1", "1", "1", "1"),
            (steps, [law.passes for law in laws], [law.energy_parameter for law in laws], errors),
        )

    # Profile

    @cached_property
    def cam(self) -> WideSwingCam:
        """The cam of the working stroke."""
        return self._cam(self.spec.layout)

    def _cam(self, layout: str) -> WideSwingCam:
        from gearlink.core.wide_swing import WideSwingCam

        section = self._section
        with at_key("cycle_angle"):
            return WideSwingCam(
                layout,  # type: ignore[arg-type]
                self.law,
                math.radians(self.spec.cycle_angle),
                section.center_distance,
                section.roller_radius,
                section.rocker_radius,
            )

    @property
    def _section(self) -> SwingCam:
        if self.spec.cam is None:
            raise MissingSection("this needs the section cam: center_distance, roller_radius", key="cam")
        return self.spec.cam

    def raw(self, name: str) -> Any:
        """Profile quantities are the cam's; those in the zone of the cusp say so with the key of the roller."""
        if name not in _PROFILE and name not in _CAM:
            return getattr(self, name)
        with at_key("cam.roller_radius"):
            value = getattr(self.cam, name)
        return None if isinstance(value, float) and math.isinf(value) else value

    # Tables

    def table_law(self) -> Table:
        """The invariants of the law over the stroke."""
        k = self._k
        a, b, c = self.law.invariants(k, 2)
        names = ("k", "displacement", "velocity", "acceleration")
        return Table("law", names, ("1",) * 4, (k, a, b, c))

    @property
    def _k(self) -> Any:
        import numpy as np

        count = self.samples or 100
        return np.arange(count + 1) / count

    def table_balance(self) -> Table:
        """Torque on the rocker axis with and without the device, over the speed."""
        import numpy as np

        from gearlink.core.balancing import speed_sweep

        share = np.arange(10, 135, 5) / 100.0 if self.samples is None else np.linspace(0.0, 1.3, self.samples + 1)
        sweep = speed_sweep(self.spec.inertia, self.law, self.stroke_time, share, self.spec.unloader.residual)
        with np.errstate(divide="ignore", invalid="ignore"):
            ratio = sweep.torque_without / sweep.torque_with
        return Table(
            "balance",
            ("speed", "torque_without", "torque_with", "ratio"),
            ("1/min", "N m", "N m", "1"),
            (share * self.spec.speed, sweep.torque_without, sweep.torque_with, ratio),
        )

    def table_main_cam(self) -> Table:
        """The cam of the working stroke; where the slot at mid-swing cuts the profile away, x and y are empty."""
        return self._cam_table("main_cam", self.cam, 1.0)

    def table_return_cam(self) -> Table:
        """The cam of the return stroke: the mirror image (twin-cam), or the external profile of the twin-rocker."""
        if self.spec.layout == "twin-cam":
            return self._cam_table("return_cam", self.cam, -1.0)
        return self._cam_table("return_cam", self._cam("twin-cam"), 1.0)

    def _cam_table(self, name: str, cam: WideSwingCam, mirror: float) -> Table:
        import numpy as np

        from gearlink.core.wide_swing_contact import contact_end

        with at_key("cam"):
            points = cam.points(self._k)
            gone = np.abs(points.k - 0.5) < 0.5 - contact_end(cam)
        profile = np.where(gone, np.nan, points.profile)
        columns = {
            "k": (points.k, "1"),
            "cam_angle": (np.degrees(points.cam_angle), "deg"),
            "pitch_x": (points.pitch.real, "mm"),
            "pitch_y": (mirror * points.pitch.imag, "mm"),
            "x": (profile.real, "mm"),
            "y": (np.where(gone, np.nan, mirror * profile.imag), "mm"),
            "pressure_angle": (np.degrees(points.pressure_angle), "deg"),
            "curvature_radius": (points.curvature_radius, "mm"),
        }
        data, units = zip(*columns.values(), strict=True)
        return Table(name, tuple(columns), units, data)

    # Checks

    def check_unloader_turnability(self) -> Iterator[Check]:
        """GL504: the device can follow the whole swing."""
        least, ratio = self.min_pivot_ratio, self.spec.unloader.pivot_ratio
        if least is None:
            return
        status: Status = "fail" if ratio < least else "pass"
        text = f"pivot ratio {ratio:g}, at least {least:.6g} is needed over a swing of {self.spec.swing:g} deg"
        if status == "fail":
            text += f": increase unloader.pivot_ratio to at least {safely_above(least)}, or reduce the swing"
        yield Check("GL504", "unloader-turnability", status, text, ratio, least)

    def check_balancing(self) -> Iterator[Check]:
        """GL508: speeds at which the device does harm."""
        harm = self.spec.speed / math.sqrt(2.0)
        text = f"the device lowers the torque above {harm:.5g} rev/min and raises it below"
        lowest = self.spec.operating_speed_min
        if lowest is None:
            return
        status: Status = "warn" if lowest < harm else "pass"
        if status == "warn":
            share = (lowest / self.spec.speed) ** 2
            text += (
                f"; at {lowest:g} rev/min lower its force or rate to {share:.3g} of the design value, or take it off"
            )
        yield Check("GL508", "balancing", status, text, lowest, harm, "1/min")

    def check_profile_exists(self) -> Check:
        """GL505: no loop, and a phase angle above zero."""
        try:
            self.cam.require_profile()
        except NoSolution as error:
            return Check("GL505", "profile-exists", "fail", error.message, self.cam.loop_margin, 0.0)
        text = f"the pitch curve has no loop; the run-up takes {math.degrees(self.cam.phase_angle):.6g} deg of the cam"
        return Check("GL505", "profile-exists", "pass", text, self.cam.loop_margin, 0.0)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 outside the transition zone."""
        if self.cam.transition_zone >= 0.5:
            return
        value, limit = math.degrees(self.cam.max_pressure_angle), self.spec.limits.pressure_angle
        text = f"the pressure angle reaches {value:.6g} deg outside the transition zone"
        if value > limit:
            text += f", above the limit {limit:g} deg: {self._pressure_remedy()}"
        yield Check("GL401", "pressure-angle", "fail" if value > limit else "pass", text, value, limit, "deg")

    def _pressure_remedy(self) -> str:
        if self.spec.layout == "twin-rocker":
            return "a twin-rocker wants a swing above 100 deg and a smaller cycle_angle"
        best = 2.0 * math.degrees(math.acos(min(1.0, self.cam.rocker_radius / self.cam.center_distance)))
        return f"move the swing towards {best:.4g} deg, or change cycle_angle"

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402: roller against the curvature outside the transition zone."""
        if self.cam.transition_zone >= 0.5:
            return
        least, roller = self.cam.min_curvature_radius, self._section.roller_radius
        share = roller / least
        status: Status = "fail" if share >= 1.0 else "warn" if share > 0.8 else "pass"
        text = (
            f"roller radius {roller:g} mm against the least curvature radius {least:.6g} mm outside the transition zone"
        )
        if status != "pass":
            text += f": take a roller of at most {safely_below(0.8 * least)} mm or a larger cam.center_distance"
        yield Check("GL402", "cam-undercut", status, text, share, 1.0)

    def check_transition_zone(self) -> Check:
        """GL507: the contact changes sides within a small part of the stroke."""
        zone, limit = self.cam.transition_zone, self.spec.limits.transition_zone
        text = f"the roller changes sides over {zone:.4g} of the stroke each side of mid-swing"
        if zone > limit:
            text += (
                f", above the limit {limit:g}: take a roller of at most "
                f"{safely_below(self._section.roller_radius * limit / zone)} mm or a larger cam.center_distance"
            )
        return Check("GL507", "transition-zone", "fail" if zone > limit else "pass", text, zone, limit)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: roller against the cam shaft."""
        section = self._section
        if section.shaft_radius == 0.0:
            return
        room = self.cam.min_radius - section.roller_radius - section.shaft_radius
        text = f"the roller keeps {room:.4g} mm from the cam shaft (radius {section.shaft_radius:g} mm)"
        if room <= 0.0:
            needed = section.center_distance * (section.shaft_radius + section.roller_radius) / self.cam.min_radius
            text = (
                f"the roller comes {-room:.4g} mm into the cam shaft (radius {section.shaft_radius:g} mm): make "
                f"cam.center_distance more than {safely_above(needed)} mm, or the roller smaller"
            )
        yield Check("GL302", "shaft-clearance", "fail" if room <= 0.0 else "pass", text, room, 0.0, "mm")
