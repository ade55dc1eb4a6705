"""Words of the sizes and places of extremes of a motion; places are input angles, of cams cam angles."""

from __future__ import annotations

from gearlink.core.base.term import Term

MOTION_EXTREMES = {
    "point_speed_max": Term("", "mm/s", "greatest speed of the coupler point at this input speed"),
    "point_speed_min": Term("", "mm/s", "least speed of the coupler point at this input speed"),
    "point_acceleration_max": Term("", "mm/s^2", "greatest acceleration of the coupler point at this input speed"),
    "bed_velocity_max": Term("", "mm/s", "greatest velocity of the bed, the lift of its cam taken off"),
    "bed_velocity_max_at": Term("", "deg", "angle of the greatest velocity of the bed"),
    "bed_velocity_min": Term("", "mm/s", "least velocity of the bed, the lift of its cam taken off"),
    "bed_velocity_min_at": Term("", "deg", "angle of the least velocity of the bed"),
    "bed_acceleration_max": Term("", "mm/s^2", "greatest acceleration of the bed, the lift of its cam taken off"),
    "bed_acceleration_max_at": Term("", "deg", "angle of the greatest acceleration of the bed"),
    "bed_acceleration_min": Term("", "mm/s^2", "least acceleration of the bed, the lift of its cam taken off"),
    "bed_acceleration_min_at": Term("", "deg", "angle of the least acceleration of the bed"),
    "cylinder_velocity_max": Term("", "mm/s", "greatest velocity of the cylinder's surface"),
    "cylinder_velocity_max_at": Term("", "deg", "angle of the greatest velocity of the cylinder's surface"),
    "cylinder_velocity_min": Term("", "mm/s", "least velocity of the cylinder's surface"),
    "cylinder_velocity_min_at": Term("", "deg", "angle of the least velocity of the cylinder's surface"),
    "cylinder_acceleration_max": Term("", "mm/s^2", "greatest acceleration of the cylinder's surface"),
    "cylinder_acceleration_max_at": Term("", "deg", "angle of the greatest acceleration of the cylinder's surface"),
    "cylinder_acceleration_min": Term("", "mm/s^2", "least acceleration of the cylinder's surface"),
    "cylinder_acceleration_min_at": Term("", "deg", "angle of the least acceleration of the cylinder's surface"),
    "input_velocity_max": Term("", "rad/s", "greatest speed of the input rocker"),
    "input_velocity_max_at": Term("", "deg", "angle of the greatest speed of the input rocker"),
    "input_velocity_min": Term("", "rad/s", "least speed of the input rocker"),
    "input_velocity_min_at": Term("", "deg", "angle of the least speed of the input rocker"),
    "input_acceleration_max": Term("", "rad/s^2", "greatest acceleration of the input rocker"),
    "input_acceleration_max_at": Term("", "deg", "angle of the greatest acceleration of the input rocker"),
    "input_acceleration_min": Term("", "rad/s^2", "least acceleration of the input rocker"),
    "input_acceleration_min_at": Term("", "deg", "angle of the least acceleration of the input rocker"),
    "output_velocity_max": Term("", "rad/s", "greatest speed of the output rocker"),
    "output_velocity_max_at": Term("", "deg", "angle of the greatest speed of the output rocker"),
    "output_velocity_min": Term("", "rad/s", "least speed of the output rocker"),
    "output_velocity_min_at": Term("", "deg", "angle of the least speed of the output rocker"),
    "output_acceleration_max_at": Term("", "deg", "angle of the greatest acceleration of the output"),
    "output_acceleration_min_at": Term("", "deg", "angle of the least acceleration of the output"),
    "rocker_speed_max": Term("", "rad/s", "greatest speed of the rocker"),
    "rocker_speed_max_at": Term("", "deg", "angle of the greatest speed of the rocker"),
    "rocker_speed_min": Term("", "rad/s", "least speed of the rocker"),
    "rocker_speed_min_at": Term("", "deg", "angle of the least speed of the rocker"),
    "rocker_acceleration_max": Term("", "rad/s^2", "greatest acceleration of the rocker"),
    "rocker_acceleration_max_at": Term("", "deg", "angle of the greatest acceleration of the rocker"),
    "rocker_acceleration_min": Term("", "rad/s^2", "least acceleration of the rocker"),
    "rocker_acceleration_min_at": Term("", "deg", "angle of the least acceleration of the rocker"),
    "min_transmission_angle_bed_at": Term("", "deg", "input angle of the bed chain's least transmission angle"),
    "min_transmission_angle_cylinder_at": Term(
        "", "deg", "input angle of the cylinder chain's least transmission angle"
    ),
    "max_pressure_angle_at": Term("", "deg", "cam angle of the greatest pressure angle (press: of the main cam)"),
    "min_curvature_radius_at": Term("", "deg", "cam angle of the least radius of curvature (press: of the main cam)"),
    "return_max_pressure_angle_at": Term("", "deg", "cam angle of the return cam's greatest pressure angle"),
    "return_min_curvature_radius_at": Term("", "deg", "cam angle of the return cam's least radius of curvature"),
}

SHAPED_LAWS = {
    "peak_velocity": Term("Cv", "1", "greatest velocity of a law, rise 1 over x from 0 to 1", "VDI 2143"),
    "peak_acceleration": Term("Ca", "1", "greatest acceleration of a law, rise 1 over x from 0 to 1", "VDI 2143"),
    "peak_jerk": Term("Cj", "1", "greatest jerk of a law beside jumps of its acceleration", "VDI 2143"),
    "peak_power": Term("Cm", "1", "greatest product of velocity and acceleration: the inertia torque", "VDI 2143"),
    "kappa": Term("kappa", "1", "rise at the end of the phase; from rest to speed over end speed and time"),
    "degree": Term("n", "1", "degree of the acceleration of a law by Bernstein polynomials"),
    "periods": Term("lambda", "1", "natural periods of what a law moves per phase"),
    "residual": Term("R", "1", "greatest vibration that a phase leaves over a band of speeds, over the rise"),
    "residual_at_design": Term("R_d", "1", "vibration that a phase leaves at the design's speed, over the rise"),
    "lower_bound": Term(
        "", "1", "no law of the degree that keeps the limits lies below: duals of the linear programme"
    ),
    "lower_bound_all_laws": Term("", "1", "no law of any form that keeps the limits lies below: closed form"),
    "gap": Term("", "1", "relative excess of the minimized value over its lower bound"),
}
