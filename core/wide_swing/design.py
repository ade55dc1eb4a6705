"""The wide-swing cam mechanism with unloading device as a design: what each command shows of it."""

from __future__ import annotations

from gearlink.core.design import Outline
from gearlink.core.errors import NoSolution
from gearlink.core.wide_swing.design_checks import WideSwingChecks
from gearlink.core.wide_swing.design_profile import NEED_PROFILE, NEED_ZONE, OF_EVEN_CAM

_LAW = ("energy_parameter", "velocity_peak", "acceleration_peak", "min_pivot_ratio", "force", "spring_rate")
_TORQUE = ("power_peak", "drive_torque_peak")
_SHAFT = ("dynamic_coefficient", "drive_balancing_ratio")
_SLIDER = (
    "slider_stroke",
    "reference_inertia",
    "rocker_share",
    "middle_place",
    "slider_velocity_peak",
    "slider_acceleration_peak",
)
_DRIVE = ("crank_span", "cam_swing", "middle_pressure_angle")
_PROFILE = (
    "rocker_radius",
    "min_radius",
    "max_radius",
    *OF_EVEN_CAM,
    "start_radius_estimate",
    "middle_radius_estimate",
    "transition_zone",
    "contact_end",
    "max_pressure_angle",
)
_ITERATION = ("iteration_energy_parameter", "iteration_passes", "iteration_error")
_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_LAW_CHECKS = ("unloader-turnability", "force-closure", "cycle-angles", "balancing")
_CAM_CHECKS = ("profile-exists", "pressure-angle", "cam-undercut", "transition-zone", "shaft-clearance")


class WideSwingDesign(WideSwingChecks):
    """A twin-cam or twin-rocker mechanism, from its design file to every quantity that is asked for."""

    kind = "wide-swing-cam"
    outlines = {
        "swing": Outline(_LAW, _LAW_CHECKS, ("law", "balance")),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline(_LAW, _LAW_CHECKS, ("law", "balance")),
    }
    extra_tables = ("iteration", "slider")

    def outline(self, command: str) -> Outline:
        """What the sections of the file allow; a profile with a loop leaves its quantities out of `swing`."""
        base, spec = self.outlines[command], self.spec
        cams = ("main_cam", "return_cam") if spec.drive is None else ("main_cam",)
        if command == "cam":
            return Outline(base.quantities, base.checks, cams)
        quantities = [*base.quantities, *(_SLIDER if spec.slider is not None else _TORQUE)]
        checks, tables = [*base.checks], [*base.tables]
        if spec.shaft is not None:
            quantities += _SHAFT
        if spec.slider is not None:
            tables.append("slider")
        if spec.cam is not None:
            quantities += self._profile_quantities(command)
            checks += _CAM_CHECKS
        if spec.method == "iteration":
            quantities += _ITERATION
            tables.append("iteration")
        if command == "analyze" and spec.cam is not None and self._profile_exists():
            tables += cams
        return Outline(tuple(quantities), tuple(checks), tuple(tables))

    def _profile_quantities(self, command: str) -> list[str]:
        names = [*_PROFILE, *(("min_curvature_radius",) if command == "analyze" else ())]
        if self.spec.drive is not None:
            even = (*OF_EVEN_CAM, *NEED_PROFILE)
            names = [*_DRIVE, *(name for name in names if name not in even)]
        if not self._profile_exists():
            names = [name for name in names if name not in (*NEED_PROFILE, *NEED_ZONE)]
        elif not self._zone_leaves_room():
            names = [name for name in names if name in ("transition_zone", *NEED_PROFILE) or name not in NEED_ZONE]
        return names

    def _profile_exists(self) -> bool:
        try:
            return self.has_profile
        except NoSolution:
            # refused altogether: the quantities say so, each with its key
            return True

    def _zone_leaves_room(self) -> bool:
        try:
            return self.has_zone(self.cam) and self.slot_of(self.cam)[0] > 0.0
        except NoSolution as error:
            return error.key != "cam.roller_radius"

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those of an optional section included."""
        groups = (_LAW, _TORQUE, _SHAFT, _SLIDER, _DRIVE, _PROFILE, _CAM, _ITERATION)
        return tuple(dict.fromkeys(name for group in groups for name in group))
