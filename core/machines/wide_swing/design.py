"""The wide-swing cam mechanism with unloading device as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable
from dataclasses import replace
from operator import attrgetter
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Design, Outline
from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.wide_swing import bodies, checks, cycle_checks, names, places, remedies, tables
from gearlink.core.machines.wide_swing.motion import Motion

if TYPE_CHECKING:
    from gearlink.core.base.report import Quantity
    from gearlink.core.machines.wide_swing.cams.cam import Layout, WideSwingCam
    from gearlink.core.machines.wide_swing.cams.oscillating_cam import OscillatingCam
    from gearlink.core.machines.wide_swing.cams.outline import AnyCam
    from gearlink.core.machines.wide_swing.cams.slider_cam import SliderCam
    from gearlink.core.machines.wide_swing.cycle import WholeCycle
    from gearlink.core.machines.wide_swing.law.iteration import LegacyLaw
    from gearlink.core.machines.wide_swing.motion import Motion
    from gearlink.core.machines.wide_swing.places import Places
    from gearlink.core.machines.wide_swing.spec import SwingCam, SwingShaft, WideSwingSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.numerics.extremes import Extreme


# What the unloading device of a wide-swing mechanism must bear, and what it leaves to the drive


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
        from gearlink.core.machines.wide_swing.law.device import force

        return self._whole * force(*self._sizing) if self.spec.unloader.type == "pneumatic" else None

    @cached_property
    def spring_rate(self) -> float | None:
        """Rate of a spring, with its reserve [N/mm]."""
        from gearlink.core.machines.wide_swing.law.device import spring_rate

        return self._whole * spring_rate(*self._sizing) if self.spec.unloader.type == "spring" else None

    @cached_property
    def iteration(self) -> LegacyLaw:
        """The source's own iteration, for comparison."""
        from gearlink.core.machines.wide_swing.law.iteration import legacy_law

        return legacy_law(self.motion.device, self.motion.swing, steps=self.spec.iteration_steps)

    @property
    def iteration_error(self) -> float:
        """Relative error of the iteration's N."""
        return float(self.iteration.energy_parameter) / self.motion.plain_law.energy_parameter - 1.0

    # Torque and drive

    @cached_property
    def power_peak(self) -> float:
        """max(b c)."""
        from gearlink.core.machines.wide_swing.law.balancing import power_peak

        return power_peak(self.motion.rocker_alone("power_peak"))

    @cached_property
    def drive_torque_peak(self) -> float:
        """Torque of the cam shaft without the device and without `linkage_share` at the design speed [N m]."""
        from gearlink.core.machines.wide_swing.law.balancing import drive_torque_peak

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
        from gearlink.core.machines.wide_swing.torsion import acceleration_series, dynamic_coefficient

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

        from gearlink.core.machines.wide_swing.cams.outline import middle_of

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


_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_LAW_CHECKS = ("unloader-turnability", "force-closure", "cycle-angles", "balancing", "transmission-angle")
_CYCLE_CHECKS = ("acceleration-step", "closed-contour", "profile-planes")
_CAM_CHECKS = (
    "profile-exists",
    "pressure-angle",
    "cam-undercut",
    "transition-zone",
    "shaft-clearance",
    "body-clearance",
)


class WideSwingDesign(Design):
    """A twin-cam or twin-rocker mechanism, from its design file to every quantity that is asked for."""

    kind = "wide-swing-cam"
    spec: WideSwingSpec
    outlines = {
        "swing": Outline(tuple(names.LAW), _LAW_CHECKS, ("law", "balance")),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*names.LAW, *names.MOTION), _LAW_CHECKS, ("law", "balance")),
    }
    extra_tables = ("iteration", "slider", "contact", "contour", "joints")

    # Parts

    @cached_property
    def motion(self) -> Motion:
        """Device, law of motion and drive."""
        return Motion(self.spec)

    @cached_property
    def unloading(self) -> Unloading:
        """Size of the device and torques."""
        return Unloading(self.spec, self.motion, None if self.spec.drive is None else self._way_back)

    def _way_back(self) -> Extreme:
        from gearlink.core.machines.wide_swing.way_back import need

        return need(self.oscillating_cam)

    @property
    def section(self) -> SwingCam:
        """The section `cam` of the design file."""
        if self.spec.cam is None:
            raise MissingSection("this needs the section cam: center_distance, roller_radius", key="cam")
        return self.spec.cam

    @cached_property
    def cam(self) -> AnyCam:
        """The cam of the working stroke."""
        if self.spec.slider is not None:
            return self.slider_cam
        return self.even_cam if self.spec.drive is None else self.oscillating_cam

    @cached_property
    def even_cam(self) -> WideSwingCam:
        """The cam of the working stroke, turning evenly."""
        if self.spec.drive is not None:
            raise NoSolution("this is a result of a cam that turns evenly: leave out drive", key="drive")
        if self.spec.slider is not None:
            raise NoSolution("this is a result of a cam of a rocker alone: leave out slider", key="slider")
        return self._even(self.spec.layout, self.motion.cycle_angle, self.section.rocker_radius, "working")

    @cached_property
    def return_cam(self) -> WideSwingCam | None:
        """A return cam of another shape: the external profile of the twin-rocker, or one of another cam angle."""
        if self.spec.slider is not None:
            return None
        if self.spec.layout == "twin-cam" and self.motion.return_angle == self.motion.cycle_angle:
            return None
        return self._even("twin-cam", self.motion.return_angle, None, "return")

    def _even(self, layout: Layout, angle: float, rocker_radius: float | None, phase: str) -> WideSwingCam:
        from gearlink.core.machines.wide_swing.cams.cam import WideSwingCam

        section, law = self.section, self.motion.plain_law
        lengths = section.center_distance, section.roller_radius, rocker_radius
        if self.spec.cycle is None:
            with at_key("cycle_angle"):
                return WideSwingCam(layout, law, angle, *lengths)
        with at_key("cycle"):
            return WideSwingCam(layout, law, angle, *lengths, angle_words=f"cycle.{phase}")

    @cached_property
    def cycle(self) -> WholeCycle:
        """Both cams as closed contours over a whole turn."""
        from gearlink.core.machines.wide_swing.cycle import WholeCycle

        return WholeCycle(self)

    @cached_property
    def oscillating_cam(self) -> OscillatingCam:
        """The cam on the rocker of a crank-rocker."""
        from gearlink.core.machines.wide_swing.cams.oscillating_cam import OscillatingCam

        section, law, drive = self.section, self.motion.plain_law, self.motion.drive
        with at_key("drive"):
            return OscillatingCam(drive, law, section.center_distance, section.roller_radius)

    @cached_property
    def slider_cam(self) -> SliderCam:
        """The cam of a rocker that drives a slider."""
        from gearlink.core.machines.wide_swing.cams.slider_cam import SliderCam

        section, law, angle = self.section, self.motion.slider, self.motion.cycle_angle
        with at_key("cycle_angle"):
            return SliderCam(law, angle, section.center_distance, section.roller_radius)

    @property
    def cams(self) -> dict[str, AnyCam]:
        """The cams that are checked, by the words that a message calls them."""
        if self.return_cam is None:
            return {"cam": self.cam}
        if self.spec.layout == "twin-cam":
            return {"cam": self.cam, "return cam": self.return_cam}
        return {"internal profile": self.cam, "external profile": self.return_cam}

    @cached_property
    def refusal(self) -> NoSolution | None:
        """Why there is no such cam of the working stroke, not even one with a loop; None where there is.

        Raises
            NoSolution - where the stroke itself is refused
        """
        _ = self.section, self.motion.plain_law, self.motion.cycle_angle
        try:
            _ = self.cam
        except NoSolution as error:
            return error
        return None

    # Where a profile stands

    @cached_property
    def has_profile(self) -> bool:
        """Whether the pitch curve of the working stroke is free of loops."""
        try:
            self.cam.require_profile()
        except NoSolution:
            return False
        return True

    def has_zone(self, cam: AnyCam) -> bool:
        """Whether a cam has a profile outside the transition zone, so that it can be judged there."""
        return (cam is not self.cam or self.has_profile) and cam.transition_zone < 0.5

    @cached_property
    def start_radius_estimate(self) -> float:
        """R of (23) [mm]."""
        from gearlink.core.machines.wide_swing.cams.contact import start_radius_estimate

        with self._profile_key:
            return start_radius_estimate(self.even_cam)

    @cached_property
    def middle_radius_estimate(self) -> float:
        """R of (27) [mm]."""
        from gearlink.core.machines.wide_swing.cams.contact import middle_radius_estimate

        with self._profile_key:
            return middle_radius_estimate(self.even_cam)

    @property
    def contact_end(self) -> float:
        """k at which the roller leaves the profile."""
        return self.slot_of(self.cam)[0]

    def slot_of(self, cam: AnyCam) -> tuple[float, float]:
        """Fractions of the stroke between which a cam's profile is cut away."""
        (_, start), (end, _) = self.contact_of(cam)
        return start, end

    def contact_of(self, cam: AnyCam) -> tuple[tuple[float, float], tuple[float, float]]:
        """Parts of the stroke in which the roller touches a cam's profile."""
        with self._profile_key:
            cam.require_profile()
        with at_key("cam.roller_radius"):
            return cam.contact

    def touches(self, cam: AnyCam, k: Reals) -> Any:
        """Whether the roller touches a cam's profile at fractions of the stroke."""
        (first, start), (end, last) = self.contact_of(cam)
        return ((k >= first) & (k <= start)) | ((k >= end) & (k <= last))

    @cached_property
    def contact_force(self) -> float:
        """Greatest force of the roller on any of the cams over the stroke, and home, at the design speed [N]."""
        from gearlink.core.numerics.extremes import maximum_over

        found = [
            maximum_over(lambda k, cam=cam: self.unloading.contact_force(cam, k), *part, samples=128).value  # type: ignore[misc]
            for cam in self.cams.values()
            if cam is self.cam or self.has_zone(cam)
            for part in self.contact_of(cam)
        ]
        if self.spec.drive is not None:
            found += [maximum_over(self._force_home, *part, samples=128).value for part in self.contact_of(self.cam)]
        return max(found)

    def _force_home(self, k: Reals) -> Reals:
        """The same on the way home, where an oscillating cam stands as at k."""
        from gearlink.core.machines.wide_swing.way_back import ratio

        cam = self.oscillating_cam
        return self.unloading.contact_force(cam, k, need=ratio(cam, k))

    @cached_property
    def extremes(self) -> Places:
        """Extremes of the rocker's speed and acceleration over the working stroke, at the design speed."""
        return places.of_motion(self)

    @cached_property
    def pressure_place(self) -> float:
        """Cam angle of the greatest pressure angle where the roller touches the profile [rad]."""
        return places.of_pressure(self)

    @cached_property
    def curvature_place(self) -> float | None:
        """Cam angle of the least radius of a bulging pitch curve where the roller touches it [rad]."""
        return places.of_curvature(self)

    @cached_property
    def dwell_force(self) -> float:
        """Greatest force of a roller on its cam during the rests [N]."""
        return self.unloading.dwell_force(self.cams.values())

    @property
    def _profile_key(self) -> Any:
        """What a refused profile is refused with: the key to change."""
        if self.spec.drive is not None:
            return at_key("drive")
        if self.spec.cycle is not None and self.section.rocker_radius is None:
            return at_key("cycle.working")
        return at_key("cycle_angle" if self.section.rocker_radius is None else "cam.rocker_radius")

    # Results

    def quantity(self, name: str) -> Quantity | None:
        """As for every design; the speed of lift-off is the cam's."""
        found = super().quantity(name)
        return replace(found, unit="1/min") if found is not None and name == "lift_off_speed" else found

    def raw(self, name: str) -> Any:
        """A quantity by its place among the parts; one of a profile that does not exist says which key to change."""
        if name in names.NEED_ZONE:
            with self._profile_key:
                self.cam.require_profile()
        value_of = attrgetter(names.PATHS[name])
        if "cam." not in names.PATHS[name]:
            return value_of(self)
        with at_key("cam.roller_radius"):
            value = value_of(self)
        return None if math.isinf(value) else value

    table_law, table_slider, table_balance = tables.law, tables.slider, tables.balance
    table_iteration, table_contact = tables.iteration, tables.contact
    table_contour, table_joints = tables.contour, tables.joints
    table_main_cam, table_return_cam = tables.main_cam, tables.return_cam

    check_unloader_turnability, check_force_closure = checks.unloader_turnability, checks.force_closure
    check_cycle_angles, check_balancing = checks.cycle_angles, checks.balancing
    check_profile_exists, check_pressure_angle = checks.profile_exists, checks.pressure_angle
    check_cam_undercut, check_transition_zone = checks.cam_undercut, checks.transition_zone
    check_shaft_clearance, check_force_reserve = checks.shaft_clearance, checks.force_reserve
    check_side_change, check_transmission_angle = checks.side_change, checks.transmission_angle
    check_acceleration_step, check_closed_contour = cycle_checks.acceleration_step, cycle_checks.closed_contour
    check_profile_planes, check_body_clearance = cycle_checks.profile_planes, bodies.body_clearance

    ways = remedies.WAYS
    requirements = Design.requirements | {"swing", "operating_speed_min"}

    @property
    def cost(self) -> float:
        """A slider's cam takes a tenth of a second to judge, a contour of a whole turn half of it, others less."""
        return 25.0 if self.spec.slider is not None else 7.0 if self.spec.cycle is not None else 3.5

    candidates, varied = remedies.candidates, remedies.varied

    # Outlines

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """With a cam `swing` judges the profile, the device, and a cycle or a slider."""
        more: tuple[str, ...] = ()
        if spec.cam is not None and command != "cam":
            more = (*_CAM_CHECKS, "force-reserve", *(("side-change",) if spec.slider is not None else ()))
        more += _CYCLE_CHECKS if spec.cycle is not None and spec.cam is not None else ()
        return tuple(dict.fromkeys((*super().judged(command, spec), *more)))

    def outline(self, command: str) -> Outline:
        """What the sections of the file allow; a profile with a loop leaves its quantities out of `swing`."""
        base, spec = self.outlines[command], self.spec
        cams = ("main_cam", "return_cam") if spec.drive is None and spec.slider is None else ("main_cam",)
        turn = ("joints",) if spec.cycle is not None else ()
        of_turn = _CYCLE_CHECKS if spec.cycle is not None else ()
        if command == "cam":
            sectors = tuple(names.CYCLE) if spec.cycle is not None else ()
            return Outline((*base.quantities, *sectors), (*base.checks, *of_turn), (*cams, *turn))
        quantities = [*base.quantities, *(names.SLIDER if spec.slider is not None else names.TORQUE)]
        checks, tables = [*base.checks], [*base.tables]
        if spec.shaft is not None:
            quantities += names.SHAFT
        if spec.slider is not None:
            tables.append("slider")
            checks += ("side-change",) if spec.cam is not None and not self._is_refused else ()
        if spec.cam is not None:
            quantities += self._profile_quantities(command)
            checks += (*(("profile-exists",) if self._is_refused else (*_CAM_CHECKS, *of_turn)), "force-reserve")
        if spec.method == "iteration":
            quantities += names.ITERATION
            tables.append("iteration")
        if command == "analyze" and spec.cam is not None and self._profile_exists:
            tables += (*cams, *turn)
        return Outline(tuple(quantities), tuple(checks), tuple(tables))

    def _profile_quantities(self, command: str) -> list[str]:
        shown = [*names.PROFILE, *((*names.CURVATURE, *names.PLACES) if command == "analyze" else ())]
        if self._is_refused:
            return ["lift_off_speed"]
        if self.spec.drive is not None:
            shown = [
                *names.DRIVE,
                *(name for name in shown if name not in (*names.OF_EVEN_CAM, *names.OF_REST, *names.NEED_PROFILE)),
            ]
        if self.spec.slider is not None:
            shown = [
                *names.OF_SLIDER_CAM,
                *(name for name in shown if name not in (*names.OF_EVEN_CAM, *names.NEED_PROFILE)),
            ]
        if self.spec.cycle is not None and self._profile_exists:
            shown += names.CYCLE
        if not self._profile_exists:
            shown = [name for name in shown if name not in (*names.NEED_PROFILE, *names.NEED_ZONE)]
        elif not self.has_zone(self.cam):
            shown = [name for name in shown if name == "transition_zone" or name not in names.NEED_ZONE]
        return shown

    @property
    def _is_refused(self) -> bool:
        """Whether the cam alone is impossible; a stroke that is refused says so itself."""
        try:
            return self.refusal is not None
        except NoSolution:
            return False

    @property
    def _profile_exists(self) -> bool:
        """Whether the cam has a profile; where the stroke is refused the quantities say so, each with its key."""
        try:
            return self.refusal is None and self.has_profile
        except NoSolution:
            return True

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those of an optional section included."""
        return tuple(names.PATHS)
