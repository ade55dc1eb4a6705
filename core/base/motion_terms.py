"""Words of the sizes and places of extremes of a motion; places are input angles, of cams cam angles."""

from __future__ import annotations

from gearlink.core.base.term import Term

MOTION_EXTREMES = {
    "point_speed_max": Term("", "mm/s", "maximum speed of the coupler point at this input speed"),
    "point_speed_min": Term("", "mm/s", "minimum speed of the coupler point at this input speed"),
    "point_acceleration_max": Term("", "mm/s^2", "maximum acceleration of the coupler point at this input speed"),
    "bed_velocity_max": Term("", "mm/s", "maximum velocity of the bed, the lift of its cam taken off"),
    "bed_velocity_max_at": Term("", "deg", "angle of the maximum velocity of the bed"),
    "bed_velocity_min": Term("", "mm/s", "minimum velocity of the bed, the lift of its cam taken off"),
    "bed_velocity_min_at": Term("", "deg", "angle of the minimum velocity of the bed"),
    "bed_acceleration_max": Term("", "mm/s^2", "maximum acceleration of the bed, the lift of its cam taken off"),
    "bed_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the bed"),
    "bed_acceleration_min": Term("", "mm/s^2", "minimum acceleration of the bed, the lift of its cam taken off"),
    "bed_acceleration_min_at": Term("", "deg", "angle of the minimum acceleration of the bed"),
    "cylinder_velocity_max": Term("", "mm/s", "maximum velocity of the cylinder's surface"),
    "cylinder_velocity_max_at": Term("", "deg", "angle of the maximum velocity of the cylinder's surface"),
    "cylinder_velocity_min": Term("", "mm/s", "minimum velocity of the cylinder's surface"),
    "cylinder_velocity_min_at": Term("", "deg", "angle of the minimum velocity of the cylinder's surface"),
    "cylinder_acceleration_max": Term("", "mm/s^2", "maximum acceleration of the cylinder's surface"),
    "cylinder_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the cylinder's surface"),
    "cylinder_acceleration_min": Term("", "mm/s^2", "minimum acceleration of the cylinder's surface"),
    "cylinder_acceleration_min_at": Term("", "deg", "angle of the minimum acceleration of the cylinder's surface"),
    "input_velocity_max": Term("", "rad/s", "maximum speed of the input rocker"),
    "input_velocity_max_at": Term("", "deg", "angle of the maximum speed of the input rocker"),
    "input_velocity_min": Term("", "rad/s", "minimum speed of the input rocker"),
    "input_velocity_min_at": Term("", "deg", "angle of the minimum speed of the input rocker"),
    "input_acceleration_max": Term("", "rad/s^2", "maximum acceleration of the input rocker"),
    "input_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the input rocker"),
    "input_acceleration_min": Term("", "rad/s^2", "minimum acceleration of the input rocker"),
    "input_acceleration_min_at": Term("", "deg", "angle of the minimum acceleration of the input rocker"),
    "output_velocity_max": Term("", "rad/s", "maximum speed of the output rocker"),
    "output_velocity_max_at": Term("", "deg", "angle of the maximum speed of the output rocker"),
    "output_velocity_min": Term("", "rad/s", "minimum speed of the output rocker"),
    "output_velocity_min_at": Term("", "deg", "angle of the minimum speed of the output rocker"),
    "output_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the output"),
    "output_acceleration_min_at": Term("", "deg", "angle of the minimum acceleration of the output"),
    "rocker_speed_max": Term("", "rad/s", "maximum speed of the rocker"),
    "rocker_speed_max_at": Term("", "deg", "angle of the maximum speed of the rocker"),
    "rocker_speed_min": Term("", "rad/s", "minimum speed of the rocker"),
    "rocker_speed_min_at": Term("", "deg", "angle of the minimum speed of the rocker"),
    "rocker_acceleration_max": Term("", "rad/s^2", "maximum acceleration of the rocker"),
    "rocker_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the rocker"),
    "rocker_acceleration_min": Term("", "rad/s^2", "minimum acceleration of the rocker"),
    "rocker_acceleration_min_at": Term("", "deg", "angle of the minimum acceleration of the rocker"),
    "min_transmission_angle_bed_at": Term("", "deg", "input angle of the bed chain's minimum transmission angle"),
    "min_transmission_angle_cylinder_at": Term(
        "", "deg", "input angle of the cylinder chain's minimum transmission angle"
    ),
    "max_pressure_angle_at": Term("", "deg", "cam angle of the maximum pressure angle (press: of the main cam)"),
    "min_curvature_radius_at": Term("", "deg", "cam angle of the minimum radius of curvature (press: of the main cam)"),
    "return_max_pressure_angle_at": Term("", "deg", "cam angle of the return cam's maximum pressure angle"),
    "return_min_curvature_radius_at": Term("", "deg", "cam angle of the return cam's minimum radius of curvature"),
}

SHAPED_LAWS = {
    "peak_velocity": Term("Cv", "1", "maximum velocity of a law, rise 1 over x from 0 to 1", "VDI 2143"),
    "peak_acceleration": Term("Ca", "1", "maximum acceleration of a law, rise 1 over x from 0 to 1", "VDI 2143"),
    "peak_jerk": Term("Cj", "1", "maximum jerk of a law in addition to jumps of its acceleration", "VDI 2143"),
    "peak_power": Term("Cm", "1", "maximum product of velocity and acceleration: the inertia torque", "VDI 2143"),
    "kappa": Term("kappa", "1", "rise at the end of the phase; from rest to speed over end speed and time"),
    "degree": Term("n", "1", "degree of the acceleration of a law by Bernstein polynomials"),
    "periods": Term("lambda", "1", "natural periods of what a law moves per phase"),
    "residual": Term("R", "1", "maximum vibration that a phase leaves over a band of speeds, over the rise"),
    "residual_at_design": Term("R_d", "1", "vibration that a phase leaves at the design's speed, over the rise"),
    "lower_bound": Term(
        "", "1", "no law of the degree that keeps the limits lies below: duals of the linear programme"
    ),
    "lower_bound_all_laws": Term("", "1", "no law of any form that keeps the limits lies below: closed form"),
    "gap": Term("", "1", "relative excess of the minimized value over its lower bound"),
}
