"""What the columns of tables mean; a column that bears the name of a quantity is that quantity, place by place."""

from __future__ import annotations

import re

COLUMNS = {
    "acceleration": "second derivative of the displacement, per radian squared of the input (a law: without dimension)",
    "acceleration_ratio": "output acceleration per square of the input speed, d(speed_ratio)/d(input angle)",
    "arm_lead": "angle by which the gripper arm is ahead of the line of centres",
    "bed_acceleration": "acceleration of the bed at the speed of the file",
    "bed_displacement": "place of the bed, 0 at the start position",
    "bed_velocity": "velocity of the bed at the speed of the file",
    "beta": "swing of the gripper arm from the bite",
    "cam": "which cam of the pair",
    "cam_angle": "angle of the cam, 0 at the start",
    "carrier_angle": "angle of the carrier from the middle of the dwell",
    "change": "degrees of freedom that the train adds, 1 less the ends that are fixed",
    "contact_torque_main": "torque of the main cam's contact force on the input rocker",
    "contact_torque_return": "torque of the return cam's contact force on its rocker",
    "coupler_acceleration": "angular acceleration of the coupler at this input speed",
    "coupler_acceleration_ratio": "coupler acceleration per square of the input speed",
    "coupler_angle": "direction of the coupler",
    "coupler_jerk_ratio": "coupler jerk per cube of the input speed",
    "coupler_speed": "angular speed of the coupler at this input speed",
    "coupler_speed_ratio": "coupler speed per input speed",
    "crank_angle": "angle of the crank from the line A->D",
    "curvature_radius": "radius of curvature of the pitch curve, positive where it is convex",
    "curvature_radius_after": "radius of curvature of the pitch curve just behind the joint",
    "curvature_radius_before": "radius of curvature of the pitch curve just before the joint",
    "cylinder_acceleration": "acceleration of the cylinder's surface at the speed of the file",
    "cylinder_displacement": "travel of the cylinder's surface, 0 at the start position",
    "cylinder_velocity": "velocity of the cylinder's surface at the speed of the file",
    "deviation": "distance from the place in mid-dwell or from the exact solution",
    "displacement": "place of what is moved, from the start of its stroke",
    "distance": "distance of a wanted point from the path",
    "drive_ratio": "torque of the cam shaft without over that with the device",
    "driven_angle": "angle of the driven gear",
    "driven_speed": "angular speed of the driven gear at this input speed",
    "error": "difference from the closed form",
    "feed_acceleration": "acceleration of the web, chain or belt that the output drives",
    "feed_travel": "travel of the web, chain or belt that the output drives, 0 at input angle 0",
    "feed_velocity": "velocity of the web, chain or belt that the output drives",
    "gap": "distance of the gripper's tip from the pitch circle",
    "gears": "gears of the train in the order of the meshes",
    "idler_acceleration": "angular acceleration of the idler at this input speed",
    "idler_acceleration_ratio": "idler acceleration per square of the input speed",
    "idler_angle": "angle of the idler, 0 at crank angle 0",
    "idler_jerk_ratio": "idler jerk per cube of the input speed",
    "idler_speed": "angular speed of the idler at this input speed",
    "idler_speed_ratio": "idler speed per input speed",
    "inertia_torque": "torque that the moving masses take at the input rocker",
    "input_acceleration": "angular acceleration of the input link",
    "input_angle": "angle of the input; of a press 0 at the start position",
    "input_velocity": "angular speed of the input link",
    "iterations": "Newton-Raphson steps at that position",
    "jerk_ratio": "output jerk per cube of the input speed",
    "k": "fraction of the stroke's cam angle",
    "lift": "lift of the follower",
    "normal_force_main": "contact force on the main cam",
    "normal_force_return": "contact force on the return cam",
    "output_acceleration": "angular acceleration of the output at this input speed",
    "output_angle": "angle of the output, 0 at input angle 0 where it is a gear",
    "output_jerk_ratio": "output jerk per cube of the input speed",
    "output_speed": "angular speed of the output at this input speed",
    "output_velocity": "angular speed of the output link",
    "passes": "passes of the source's iteration",
    "pitch_x": "x of the roller's centre in the cam's own frame",
    "pitch_y": "y of the roller's centre in the cam's own frame",
    "point_x_acceleration": "acceleration of the coupler point along x at this input speed",
    "point_x_velocity": "velocity of the coupler point along x at this input speed",
    "point_y_acceleration": "acceleration of the coupler point along y at this input speed",
    "point_y_velocity": "velocity of the coupler point along y at this input speed",
    "pole_x": "x of the instant centre P15 of crank gear and output gear",
    "pole_y": "y of the instant centre P15 of crank gear and output gear",
    "pressure_angle": "angle between the contact force and the follower's motion, signed",
    "radius": "radius of the pitch curve at the joint",
    "ratio": "one over the other: torque without over with the device",
    "relative_error": "relative error of the source's iteration",
    "residual": "what is left of the loop's closure",
    "return_force": "contact force on the return cam",
    "return_pitch_x": "x of the return roller's centre in the cam's own frame",
    "return_pitch_y": "y of the return roller's centre in the cam's own frame",
    "return_x": "x of the return profile in the cam's own frame",
    "return_y": "y of the return profile in the cam's own frame",
    "rocker_acceleration": "angular acceleration of the rocker at this input speed",
    "rocker_acceleration_ratio": "rocker acceleration per square of the input speed",
    "rocker_angle": "direction of the rocker",
    "rocker_jerk_ratio": "rocker jerk per cube of the input speed",
    "rocker_speed": "angular speed of the rocker at this input speed",
    "rocker_speed_ratio": "rocker speed per input speed",
    "rod_angle": "angle of the connecting rod to the slide line",
    "slider_acceleration": "acceleration of the slider at this input speed",
    "slider_velocity": "velocity of the slider at this input speed",
    "slip": "relative travel of the gripper's tip on the sheet",
    "speed": "speed at which the row is computed, or of what the table shows",
    "speed_difference": "speed of the gripper's tip less that of the cylinder's surface",
    "speed_ratio": "output speed per input speed",
    "speed_share": "speed over the design speed at which the row is computed",
    "start_of": "the part of the cycle that begins at the joint",
    "steps": "steps per half stroke of the source's iteration",
    "tangent_step": "angle between the tangents at the joint",
    "theta": "angle of the drum's shaft from the bite",
    "time": "time since input angle 0",
    "tip_speed": "speed of the gripper's tip",
    "tip_x": "x of the gripper's tip",
    "tip_y": "y of the gripper's tip",
    "torque_with": "torque on the cam shaft with the device",
    "torque_without": "torque on the cam shaft without the device",
    "train": "number of the train in the file",
    "transmission_angle": "angle between the two links of the driven dyad, folded to at most 90 deg",
    "transmission_angle_bed": "transmission angle of the bed chain",
    "transmission_angle_cylinder": "transmission angle of the cylinder chain",
    "velocity": "derivative of the displacement, per radian of the input (a law: without dimension)",
    "x": "x of the point or of the profile",
    "x_acceleration": "second derivative of x after the input angle",
    "x_velocity": "derivative of x after the input angle",
    "y": "y of the point or of the profile",
    "y_acceleration": "second derivative of y after the input angle",
    "y_velocity": "derivative of y after the input angle",
}

CONSTANTS = {
    "Cv": "peak velocity of a law of motion: stroke/time times this",
    "Ca": "peak acceleration of a law of motion: stroke/time^2 times this",
    "Cj": "peak jerk of a law of motion: stroke/time^3 times this",
    "Cm": "peak of velocity times acceleration of a law of motion: with the mass, the greatest power",
    "kappa": "share of (end speed) x (time) that a rest-to-speed law travels; 1 for a law from rest to rest",
    "jumps": "whether the acceleration of a law jumps at its ends: such a law must not join a dwell",
}
"""Words of `gearlink laws`."""

_FORCE = re.compile(r"(?P<pin>[A-Z]|[A-Z]_\w+|planet|guide)_(?P<part>x|y)|mesh_\w+")


def column_words(name: str) -> str:
    """What a column means; empty where nothing is said of it.

    Example
        >>> column_words("mesh_13")
        'tangential force in that mesh, signed; of a column ..._radial the radial one'
    """
    if name in COLUMNS:
        return COLUMNS[name]
    if found := _FORCE.fullmatch(name):
        if not found["pin"]:
            return "tangential force in that mesh, signed; of a column ..._radial the radial one"
        return f"{found['part']} component of the force at the pin {found['pin']} on the second body named there"
    return ""
