"""Names of the quantities of a wide-swing design, and where each stands on it."""

from __future__ import annotations

from gearlink.core.numerics.motion_extremes import names as extreme_names

LAW = {
    "energy_parameter": "motion.law.energy_parameter",
    "velocity_peak": "motion.law.velocity_peak",
    "acceleration_peak": "motion.law.acceleration_peak",
    "min_pivot_ratio": "motion.min_pivot_ratio",
    "force": "unloading.force",
    "spring_rate": "unloading.spring_rate",
}
TORQUE = {"power_peak": "unloading.power_peak", "drive_torque_peak": "unloading.drive_torque_peak"}
SHAFT = {
    "dynamic_coefficient": "unloading.dynamic_coefficient",
    "drive_balancing_ratio": "unloading.drive_balancing_ratio",
}
SLIDER = {
    "slider_stroke": "motion.slider.stroke",
    "reference_inertia": "motion.reference_inertia",
    "rocker_share": "motion.slider.rocker_share",
    "middle_place": "motion.slider.middle_place",
    "slider_velocity_peak": "motion.slider.slider_velocity_peak",
    "slider_acceleration_peak": "motion.slider.slider_acceleration_peak",
}
DRIVE = {
    "crank_span": "motion.drive.crank_span",
    "cam_swing": "motion.drive.swing",
    "middle_pressure_angle": "oscillating_cam.middle_pressure_angle",
}
OF_REST = ("dwell_force",)
OF_SLIDER_CAM = {"line_of_centers_place": "slider_cam.middle", "roller_arm_offset": "slider_cam.arm_offset"}
OF_EVEN_CAM = ("profile_correction", "largest_profile_correction", "phase_angle", "start_curvature_radius")
PROFILE = {
    "rocker_radius": "cam.rocker_radius",
    "min_radius": "cam.min_radius",
    "max_radius": "cam.max_radius",
    **{name: f"even_cam.{name}" for name in OF_EVEN_CAM},
    "start_radius_estimate": "start_radius_estimate",
    "middle_radius_estimate": "middle_radius_estimate",
    "transition_zone": "cam.transition_zone",
    "contact_end": "contact_end",
    "max_pressure_angle": "cam.max_pressure_angle",
    "lift_off_speed": "unloading.lift_off_speed",
    "contact_force": "contact_force",
    "dwell_force": "dwell_force",
}
CYCLE = {
    "sectors_external": "cycle.sectors_external",
    "sectors_internal": "cycle.sectors_internal",
    "sectors_return": "cycle.sectors_return",
    "longer_stroke_reserve": "cycle.longer_stroke_reserve",
}
ITERATION = {
    "iteration_energy_parameter": "unloading.iteration.energy_parameter",
    "iteration_passes": "unloading.iteration.passes",
    "iteration_error": "unloading.iteration_error",
}
MOTION = {name: f"extremes.{name}" for name in extreme_names("rocker_speed", "rocker_acceleration")}
PLACES = {"max_pressure_angle_at": "pressure_place", "min_curvature_radius_at": "curvature_place"}
CURVATURE = {"min_curvature_radius": "cam.min_curvature_radius"}
PATHS = (
    MOTION | PLACES | LAW | TORQUE | SHAFT | SLIDER | DRIVE | PROFILE | OF_SLIDER_CAM | CURVATURE | CYCLE | ITERATION
)
NEED_PROFILE = ("start_radius_estimate", "middle_radius_estimate")
NEED_ZONE = (*PLACES, "transition_zone", "max_pressure_angle", "min_curvature_radius", "contact_end", "contact_force")
