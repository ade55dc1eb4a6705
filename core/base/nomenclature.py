"""The nomenclature of gearlink: symbol, unit, meaning and source of every quantity, for code, tables and documents.

Units are those of the design files; inside the engine an angle is in radians. Names follow ISO 21771 (gears) and
VDI 2142/2143 (laws of motion, cams).
"""

from __future__ import annotations

from collections.abc import Collection, Iterator
from typing import NamedTuple

from gearlink.core.base.errors import GearlinkError


class Term(NamedTuple):
    """Symbol, unit, meaning and source of a quantity."""

    symbol: str
    unit: str
    words: str
    source: str = ""


GENEVA = {
    "crank_radius": Term("r", "mm", "radius of the pin's circle", "thesis 4.2.1; own derivation: a sin(pi/n)"),
    "wheel_radius": Term("R", "mm", "radius of the wheel to the mouths of its slots", "own derivation: a cos(pi/n)"),
    "slot_bottom_radius": Term("", "mm", "distance from the wheel axis to the bottoms of the slots"),
    "lip_thickness": Term(
        "", "mm", "metal between locking arc and slot", "own derivation: r - b/2 - h, h radius of the arc"
    ),
    "motion_angle": Term("2 f_0", "deg", "input angle of a step", "own derivation: 180 deg - s 360 deg/n"),
    "wheel_backlash": Term("", "deg", "maximum free rotation of the wheel with the pin in its slot"),
    "locking_play": Term("", "deg", "free rotation of the driven wheel or gear in its dwell, locked by the disc"),
    "locking_angle": Term("", "deg", "input angle between two steps, during which the wheel dwells"),
    "entry_acceleration_ratio": Term("tan(pi/n)", "1", "jump of the acceleration ratio at entry and exit"),
    "steps_per_minute": Term("", "1/min", "steps of the wheel per minute: input speed times pins", "thesis 4.2.1"),
    "contact_force_max_at": Term("", "deg", "input angle of the maximum contact force"),
}
REDUCER = {
    "ratio": Term("i", "1", "input speed over output speed, signed", "thesis 2.2.2 II"),
    "lobes": Term("z", "1", "lobes of the disc, one less than pins", "thesis 2.2.2 II"),
    "shortening": Term("K", "1", "shortening coefficient e Z/R", "own derivation"),
    "pressure_angle_min": Term("", "deg", "minimum pressure angle at the loaded pins, eccentric at 0"),
    "pressure_angle_mean": Term("", "deg", "mean pressure angle at the loaded pins, eccentric at 0"),
    "pressure_angle_max": Term("", "deg", "maximum pressure angle at the loaded pins, eccentric at 0"),
    "pin_force_max": Term("F_P,max", "N", "maximum force of a ring pin, pins of equal stiffness", "own derivation"),
    "output_pin_force_max": Term("Q_max", "N", "maximum force of an output pin", "own derivation"),
    "efficiency": Term(
        "eta",
        "1",
        "estimate from the forces without losses, without churning and seals; the force on the eccentric's bearing is "
        "the sum of ring pin and output pin forces, an upper bound",
        "own derivation",
    ),
    "backlash": Term("", "deg", "free rotation of the disc between both flanks of the pins", "own derivation"),
    "output_hole_radius": Term("r_w + e", "mm", "radius of the holes for the output pins"),
}
RACKS = {
    "stroke_ratio": Term(
        "1 +- z_m/z_f", "1", "stroke of the rack over that of the rod end, signed", "thesis 2.2.2 III"
    ),
    "output_stroke": Term("S_R", "mm", "stroke of the moving rack", "thesis 2.2.2 III"),
    "pinion_turns": Term("", "1", "revolutions of the pinion in a stroke"),
    "fixed_rack_travel": Term("", "mm", "distance that the pinion rolls on the fixed rack"),
    "moving_rack_travel": Term("", "mm", "distance that the pinion rolls on the moving rack"),
    "fixed_rack_length": Term("", "mm", "minimum length of the fixed rack: travel and path of contact"),
    "moving_rack_length": Term("", "mm", "minimum length of the moving rack: travel and path of contact"),
}
STEP_TRAIN = {"steps": Term("", "1", "steps of the output per revolution of the carrier", "thesis 2.2.2")}
CAM_DRIVE = {
    "lever_swing": Term("", "deg", "range of the angle between lever and carrier", "thesis 1.3.4; own derivation"),
    "path_speed_max": Term("", "mm/s", "maximum speed along the path"),
    "path_speed_min": Term("", "mm/s", "minimum speed along the path"),
}
GUIDANCE = {
    "pose_error_max": Term("", "mm", "maximum distance of the guided body's point from a pose", "thesis 2.2.2 VI"),
    "pose_error_rms": Term("", "mm", "root mean square of these distances"),
    "pose_angle_error_max": Term("", "deg", "maximum angular deviation of the guided body from a pose"),
    "body_angle": Term("", "deg", "direction of the coupler BC less the angle of the guided body"),
    "frame_place": Term("", "mm", "position of A in the coordinates of the poses, with a free frame"),
    "frame_direction": Term("", "deg", "direction from A to E in the coordinates of the poses"),
}
PRESS_TEETH = {
    "pinion_radius": Term("r_8", "mm", "pitch radius of the pinion on both racks", "TY-460 report 2.4"),
    "input_gear_teeth": Term(
        "z1", "1", "teeth of each input gear, given or the number that fits without profile shift", "TY-460 report 1.1"
    ),
    "rack_teeth": Term("", "1", "teeth of the lower and the upper rack, given or the number that the travel needs"),
    "rack_travel": Term("", "mm", "distance of the pinion along the lower and the upper rack"),
}
STEPPING = {**PRESS_TEETH, **GUIDANCE, **GENEVA, **REDUCER, **RACKS, **STEP_TRAIN, **CAM_DRIVE}


MACHINE = {
    "least_margin": Term("", "deg", "minimum margin of the relations between events", "own derivation"),
    "limiting_relations": Term("", "1", "relations that limit the margin of the free phases"),
    "phase_room": Term("", "deg", "width of the interval in which the phase was taken", "own derivation"),
    "natural_frequencies": Term("f", "Hz", "natural frequencies of the main shaft", "Thomson, 12.4"),
    "critical_speeds": Term(
        "n_c", "1/min", "speeds at which one revolution takes one natural period of the main shaft", "60 f"
    ),
    "machine_speed_limit": Term("", "1/min", "speed of the main shaft at which a member reaches its limit first"),
    "speed_limit_member": Term("", "1", "member that limits the machine speed"),
    "speed_limit_check": Term("", "1", "check that limits the machine speed"),
    "members_without_loads": Term("", "1", "members without a section loads, whose loads are not included"),
    "wind_up_max_at": Term("", "deg", "machine angle of the maximum twist"),
    "wind_up_disc": Term("", "1", "disc of the maximum twist"),
    "wind_up_max": Term("", "deg", "maximum twist of the main shaft between a disc and the first one", "modes"),
    "wind_up_at_print": Term("", "mm", "register error due to the twist of the main shaft, the same in every machine"),
    "machine_yield": Term("", "1", "share of machines within the allowed register error", "normal law"),
}


PLANAR: dict[str, Term] = {
    "degrees_of_freedom": Term(
        "F", "1", "degrees of freedom, 3 n - 2 (pins + slides) - slots - meshes - cams", "Gruebler"
    ),
    "grashof": Term("", "1", "class of the four-bars of the driven link by Grashof's rule", "VDI 2145"),
    "free_range": Term("", "deg", "input range between the two dead centres that contain the range"),
    "closure_error": Term("", "mm", "maximum gap of a joint over all positions computed"),
    "swing": Term("", "deg", "maximum less minimum direction of the link"),
    "turns": Term("", "1", "net turns of the link over the period"),
    "path_length": Term("", "mm", "length of the path of the point over the period or range"),
    "angle_max": Term("", "deg", "maximum direction of the link"),
    "angle_min": Term("", "deg", "minimum direction of the link"),
    "position_max": Term("", "mm", "maximum position along the slide or slot"),
    "position_min": Term("", "mm", "minimum position along the slide or slot"),
    "velocity_ratio_max": Term("", "mm/rad", "maximum velocity along the slide or slot per input speed"),
    "velocity_ratio_min": Term("", "mm/rad", "minimum velocity along the slide or slot per input speed"),
    "jerk_ratio_max": Term("", "1", "maximum jerk per cube of the input speed"),
    "jerk_ratio_min": Term("", "1", "minimum jerk per cube of the input speed"),
    "x_max": Term("", "mm", "maximum x of the point"),
    "x_min": Term("", "mm", "minimum x of the point"),
    "y_max": Term("", "mm", "maximum y of the point"),
    "y_min": Term("", "mm", "minimum y of the point"),
    "angle_max_at": Term("", "deg", "input of the maximum direction of the link"),
    "angle_min_at": Term("", "deg", "input of the minimum direction of the link"),
    "position_max_at": Term("", "deg", "input of the maximum position along the slide or slot"),
    "position_min_at": Term("", "deg", "input of the minimum position along the slide or slot"),
    "velocity_ratio_max_at": Term("", "deg", "input of the maximum velocity along the slide or slot per input speed"),
    "velocity_ratio_min_at": Term("", "deg", "input of the minimum velocity along the slide or slot per input speed"),
    "jerk_ratio_max_at": Term("", "deg", "input of the maximum jerk per cube of the input speed"),
    "jerk_ratio_min_at": Term("", "deg", "input of the minimum jerk per cube of the input speed"),
    "x_max_at": Term("", "deg", "input of the maximum x of the point"),
    "x_min_at": Term("", "deg", "input of the minimum x of the point"),
    "y_max_at": Term("", "deg", "input of the maximum y of the point"),
    "y_min_at": Term("", "deg", "input of the minimum y of the point"),
}


MOTION_EXTREMES = {
    "point_speed_max": Term("", "mm/s", "maximum speed of the coupler point at this input speed"),
    "point_speed_min": Term("", "mm/s", "minimum speed of the coupler point at this input speed"),
    "point_acceleration_max": Term("", "mm/s^2", "maximum acceleration of the coupler point at this input speed"),
    "bed_stroke": Term("", "mm", "stroke of the bed, twice that of the slider"),
    "bed_velocity_max": Term("", "mm/s", "maximum velocity of the bed, less that of the lift of its cam"),
    "bed_velocity_max_at": Term("", "deg", "angle of the maximum velocity of the bed"),
    "bed_velocity_min": Term("", "mm/s", "minimum velocity of the bed, less that of the lift of its cam"),
    "bed_velocity_min_at": Term("", "deg", "angle of the minimum velocity of the bed"),
    "bed_acceleration_max": Term("", "mm/s^2", "maximum acceleration of the bed, less that of the lift of its cam"),
    "bed_acceleration_max_at": Term("", "deg", "angle of the maximum acceleration of the bed"),
    "bed_acceleration_min": Term("", "mm/s^2", "minimum acceleration of the bed, less that of the lift of its cam"),
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
    "min_transmission_angle_bed_at": Term("", "deg", "input angle at the minimum transmission angle of the bed drive"),
    "min_transmission_angle_cylinder_at": Term(
        "", "deg", "input angle at the minimum transmission angle of the cylinder drive"
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
    "kappa": Term("kappa", "1", "rise at the end of the phase; from rest to speed: divided by end speed times time"),
    "degree": Term("n", "1", "degree of the acceleration of a law by Bernstein polynomials"),
    "periods": Term("lambda", "1", "natural periods of the driven system per phase"),
    "residual": Term("R", "1", "maximum residual vibration over a band of speeds, divided by the rise"),
    "residual_at_design": Term("R_d", "1", "residual vibration at the design speed, divided by the rise"),
    "lower_bound": Term(
        "", "1", "lower bound for all laws of this degree within the limits, by the dual of the linear programme"
    ),
    "lower_bound_all_laws": Term("", "1", "lower bound for all laws within the limits, in closed form"),
    "gap": Term("", "1", "relative excess of the minimized value over its lower bound"),
}


GEAR_LINKAGE: dict[str, Term] = {
    "i3": Term("i3", "1", "ratio of idler and output gear, -z3/z5", "thesis 4.1"),
    "crank_teeth": Term("z1", "1", "teeth of the gear fixed to the crank"),
    "idler_teeth": Term("z3", "1", "teeth of gear 3, on the pin of coupler and rocker"),
    "output_teeth": Term("z5", "1", "teeth of the output gear"),
    "frame_ratio": Term("d", "1", "frame length over crank length", "thesis (4-18), (4-20)"),
    "crank_length": Term("l1", "mm", "distance from the crank's fixed pivot to its pin"),
    "coupler_length": Term("l2", "mm", "coupler (three gears: centre distance of 1 and 3; six-bar: BC, CD, DE)"),
    "rocker_length": Term("l3", "mm", "rocker (three gears: centre distance of 3 and 5)"),
    "frame_length": Term(
        "l4", "mm", "distance between the two fixed pivots", "own closed form instead of thesis (4-26)..(4-33)"
    ),
    "mean_ratio": Term("I", "1", "net output revolutions per input revolution", "thesis (4-1)"),
    "speed_ratio_max": Term("(w5/w1)max", "1", "maximum output speed per input speed", "thesis (4-13)"),
    "speed_ratio_min": Term("(w5/w1)min", "1", "minimum output speed per input speed", "thesis (4-13)"),
    "motion": Term("", "1", "kind of output motion", "thesis 4.2.1"),
    "dwell_crank_angles": Term("phi(1), phi(2)", "deg", "crank angles of zero output speed", "thesis (4-14)"),
    "back_step_angle": Term("phi5(1)-phi5(2)", "deg", "back-step of the output", "thesis (4-16), (4-19)"),
    "back_step_crank_angle": Term("phi12", "deg", "crank angle during which the output turns back", "thesis (4-15)"),
    "dwell_angle": Term(
        "phi13",
        "deg",
        "crank angle from the start of the back-step until the output is back at that position",
        "own derivation",
    ),
    "dwell_angle_approximate": Term("1.5 phi12", "deg", "approximation of phi13 in the thesis", "thesis (4-17)"),
    "min_transmission_angle": Term("mu_min", "deg", "minimum transmission angle over the revolution", "VDI 2142"),
    "gear_gap": Term(
        "s15", "mm", "minimum gap between the tips of the crank (input) gear and the output gear", "own derivation"
    ),
    "nonuniformity": Term("delta", "1", "(max - min)/mean of the speed ratio", "thesis (4-20)"),
    "tolerance_dwell_angle": Term("phi_tol", "deg", "longest crank angle with the output within +- the tolerance"),
    "dwell_tolerance": Term("tau", "deg", "half of the output's range in the dwell, +- about its middle"),
    "window_limit": Term("phi_lim", "deg", "longest dwell possible with these gears within the tolerance"),
    "frame_ratio_interval": Term(
        "d_min, d_max", "1", "interval of frame over crank in which window and tolerance are met"
    ),
    "frame_length_interval": Term(
        "AD_min, AD_max", "mm", "interval of the frame in which window and tolerance are met with this crank"
    ),
    "input_speed": Term("n1", "1/min", "revolutions of the input shaft per minute"),
    "quartic_k": Term("K", "mm^6", "coefficient of cos^4(beta) for a momentary dwell", "thesis (4-27)"),
    "quartic_l": Term("L", "mm^6", "coefficient of cos^2(beta) for a momentary dwell", "thesis (4-27)"),
    "quartic_m": Term("M", "mm^6", "constant term for a momentary dwell", "thesis (4-27)"),
    "base_angle": Term("beta", "deg", "base angle of the triangle CFE at the standstill", "thesis (4-26)"),
    "pole_angle": Term(
        "alpha", "deg", "angle between the crank and the line of poles at the standstill", "thesis (4-28)"
    ),
    "segment_af": Term("AF", "mm", "input axis to the pole of crank gear and idler", "thesis (4-29)"),
    "segment_fe": Term("FE", "mm", "distance between the two poles", "thesis (4-30)"),
    "segment_eg": Term("EG", "mm", "pole of idler and output gear to the foot of D", "thesis (4-31)"),
    "segment_gd": Term("GD", "mm", "output axis to the line of the poles", "thesis (4-32)"),
    "tolerance_dwell_start": Term("phi_L", "deg", "crank angle at which the longest dwell within the tolerance starts"),
    "acceleration_ratio_max": Term("(e5/w1^2)max", "1", "maximum output acceleration", "thesis (4-25)"),
    "acceleration_ratio_max_at": Term("", "deg", "crank angle of the maximum output acceleration"),
    "acceleration_ratio_min": Term("(e5/w1^2)min", "1", "minimum output acceleration", "thesis (4-25)"),
    "acceleration_ratio_min_at": Term("", "deg", "crank angle of the minimum output acceleration"),
}

REAL_SPEED: dict[str, Term] = {
    "feed_radius": Term("r_F", "mm", "pitch radius of the roller, pulley or sprocket of the feed"),
    "feed_ratio": Term(
        "", "1", "speed of the feed shaft over that of the output, for the required step", "thesis 3.3.2"
    ),
    "feed_teeth": Term("z_F", "1", "number of sprocket teeth nearest to the required step", "thesis 3.3.2"),
    "uniform_angle": Term("", "deg", "longest crank angle of nearly uniform speed", "thesis 4.2.1; own derivation"),
    "uniform_start": Term("", "deg", "crank angle at the start of the nearly uniform speed"),
    "uniform_ratio": Term("", "1", "speed ratio over that crank angle"),
    "lay_speed": Term(
        "v_L", "mm/s", "maximum speed of the sheet over feed.lay.distance before the lay", "thesis 3.3.2"
    ),
    "lay_angle": Term("", "deg", "crank angle at which the sheet arrives at the lay"),
    "lay_time": Term("", "ms", "time over feed.lay.distance before the lay"),
    "arrival_speed": Term("", "mm/s", "speed of the sheet when it arrives at the lay"),
    "dwell_pole_line_error": Term(
        "", "mm", "distance of A from the line through P13 and P35 at standstills; exactly 0", "thesis 4-9"
    ),
    "feed_per_turn": Term("s_F", "mm", "net travel of web, chain or belt per revolution of the input", "thesis 3.3.2"),
    "feed_back_step": Term("s_12", "mm", "backward travel of web, chain or belt in the back-step"),
    "chain_ripple": Term("1-cos(pi/z)", "1", "relative drop of the chain speed between two teeth"),
    "feed_velocity_max": Term("v_F,max", "mm/s", "maximum velocity of web, chain or belt"),
    "feed_velocity_min": Term("v_F,min", "mm/s", "minimum velocity of web, chain or belt"),
    "feed_velocity_mean": Term("v_F,m", "mm/s", "mean velocity of web, chain or belt"),
    "feed_acceleration_max": Term("a_F,max", "mm/s^2", "maximum acceleration of web, chain or belt"),
    "feed_acceleration_min": Term("a_F,min", "mm/s^2", "minimum acceleration of web, chain or belt"),
    "turn_time": Term("T", "ms", "time of one input revolution"),
    "output_speed_max": Term("w5_max", "rad/s", "maximum speed of the output at this input speed"),
    "output_speed_min": Term("w5_min", "rad/s", "minimum speed of the output at this input speed"),
    "output_acceleration_max": Term("e5_max", "rad/s^2", "maximum acceleration of the output at this input speed"),
    "output_acceleration_min": Term("e5_min", "rad/s^2", "minimum acceleration of the output at this input speed"),
    "back_step_time": Term("t12", "ms", "time during which the output turns back"),
    "dwell_time": Term("t_d", "ms", "time during which the output dwells"),
    "tolerance_dwell_time": Term("t_tol", "ms", "time of the longest dwell within the tolerance"),
    "motion_time": Term("t_m", "ms", "time of one motion between two dwells"),
    "driven_speed": Term("w_F", "rad/s", "speed of the driven gear during a motion"),
    "rocker_speed_at_start": Term("w_R0", "rad/s", "speed of the rocker right after the start with the largest impact"),
    "slider_velocity_max": Term("v_max", "mm/s", "maximum velocity of the slider at this input speed"),
    "slider_velocity_min": Term("v_min", "mm/s", "minimum velocity of the slider at this input speed"),
    "slider_acceleration_max": Term("a_max", "mm/s^2", "maximum acceleration of the slider at this input speed"),
    "slider_acceleration_min": Term("a_min", "mm/s^2", "minimum acceleration of the slider at this input speed"),
    "forward_time": Term("t_f", "ms", "time of the slider's stroke away from the crank's axis"),
    "return_time": Term("t_r", "ms", "time of the slider's stroke towards the crank's axis"),
}

SLIDER: dict[str, Term] = {
    "return_angle": Term("", "deg", "input angle of the return stroke"),
    "velocity_max": Term("v'_max", "mm/rad", "maximum velocity of slider (outwards) or point per input speed"),
    "velocity_max_at": Term("", "deg", "input angle of the maximum velocity"),
    "velocity_min": Term("v'_min", "mm/rad", "minimum velocity per input speed; of a slider the maximum inwards"),
    "velocity_min_at": Term("", "deg", "input angle of the minimum velocity"),
    "acceleration_max": Term(
        "a'_max", "mm/rad^2", "maximum acceleration of slider or point per square of the input speed"
    ),
    "acceleration_max_at": Term("", "deg", "input angle of the maximum acceleration"),
    "acceleration_min": Term(
        "a'_min", "mm/rad^2", "minimum acceleration of slider or point per square of the input speed"
    ),
    "acceleration_min_at": Term("", "deg", "input angle of the minimum acceleration"),
    "forward_angle": Term("theta_F", "deg", "input angle of the slider's stroke away from the crank's axis"),
}

CRANK_ROCKER: dict[str, Term] = {
    "outer_dead_center": Term("phi_o", "deg", "crank angle with crank and coupler stretched", "VDI 2130"),
    "inner_dead_center": Term("phi_i", "deg", "crank angle with crank and coupler folded over each other", "VDI 2130"),
    "crank_offset": Term("phi_0", "deg", "angle added to the given crank angles, 0 or 180", "own derivation"),
    "rocker_offset": Term("psi_0", "deg", "angle added to the given rocker angles, 0 or 180", "own derivation"),
}


GEAR_PAIR = {
    "working_pressure_angle": Term(
        "alpha_wt", "deg", "angle between line of action and common tangent of the pitch circles", "ISO 21771"
    ),
    "center_distance": Term(
        "a_w",
        "mm",
        "working distance between the axes of both gears; of a cam between its axis and the pivot",
        "ISO 21771",
    ),
    "reference_center_distance": Term("a", "mm", "reference centre distance m(z1+z2)/2", "ISO 21771"),
    "shift_sum": Term(
        "x_Sigma", "1", "sum of the profile shift coefficients for zero backlash at the centre distance", "ISO 21771"
    ),
    "center_distance_modification": Term("y", "1", "(a_w - a)/m", "ISO 21771"),
    "tip_shortening": Term("dy", "1", "tip shortening coefficient, shift sum - y", "ISO 21771"),
    "contact_ratio": Term("eps_alpha", "1", "transverse contact ratio (nominal)", "ISO 21771"),
    "profile_shift": Term("x", "1", "profile shift coefficient", "ISO 21771"),
    "reference_radius": Term("r", "mm", "reference radius m z/2", "ISO 21771"),
    "base_radius": Term("r_b", "mm", "radius of the base circle, of involutes or of a cam", "ISO 21771"),
    "working_radius": Term("r_w", "mm", "working pitch radius r_b/cos(alpha_wt)", "ISO 21771"),
    "tip_radius": Term("r_a", "mm", "radius of the circle that bounds the teeth at their tips", "ISO 21771"),
    "root_radius": Term("r_f", "mm", "radius of the circle through the bottoms of the tooth spaces", "ISO 21771"),
    "tooth_thickness": Term("s", "mm", "tooth thickness on the reference circle (normal section)", "ISO 21771"),
    "tip_pressure_angle": Term("alpha_a", "deg", "angle between flank and radius at the tip circle", "ISO 21771"),
    "tip_thickness": Term("s_a", "mm", "tooth thickness at the tip", "ISO 21771"),
    "min_shift_no_undercut": Term("x_min", "1", "minimum shift without undercut (rack tool)", "ISO 21771"),
    "min_teeth_no_undercut": Term(
        "z_min", "1", "minimum number of teeth without undercut at the gear's profile shift (rack tool)", "ISO 21771"
    ),
    "span_measurement": Term("W_k", "mm", "span measurement over k teeth", "ISO 21771"),
    "span_teeth": Term("k", "1", "teeth spanned", "ISO 21771"),
    "specific_sliding": Term("zeta", "1", "specific sliding at the root end of the active flank", "ISO 21771"),
    "transverse_pressure_angle": Term(
        "alpha_t",
        "deg",
        "angle between flank and radius on the reference circle, in the plane of rotation",
        "ISO 21771",
    ),
    "base_helix_angle": Term("beta_b", "deg", "helix angle on the base circle", "ISO 21771"),
    "overlap_ratio": Term("eps_beta", "1", "face width over the axial pitch of helical teeth", "ISO 21771"),
    "total_contact_ratio": Term("eps_gamma", "1", "transverse contact ratio plus overlap ratio", "ISO 21771"),
    "usable_contact_ratio": Term(
        "eps_use", "1", "transverse contact ratio over the part of the involutes that the tools leave"
    ),
    "path_of_contact": Term("g_alpha", "mm", "length of the path of contact", "ISO 21771"),
    "form_radius": Term("r_Ff", "mm", "root form radius, where the flank ends", "ISO 21771"),
    "used_root_radius": Term(
        "r_Nf", "mm", "radius at the start of the active profile at the root (nominal)", "ISO 21771"
    ),
    "tip_clearance": Term(
        "c", "mm", "clearance between the tip of the gear and the root of the mating gear", "ISO 21771"
    ),
    "specific_sliding_tip": Term("zeta_a", "1", "sliding over rolling velocity of the flank at the tip", "ISO 21771"),
    "sliding_factor": Term("K_g", "1", "sliding speed over pitch line speed, at A and at E", "ISO 21771"),
    "tooth_loss_factor": Term(
        "H_v",
        "1",
        "tooth loss factor: the efficiency is 1 - mu H_v, mu the mean coefficient of friction",
        "ISO/TR 14179-2",
    ),
    "pin_diameter": Term("D_M", "mm", "diameter of the measuring ball or pin", "DIN 21773"),
    "measure_over_balls": Term("M_dK", "mm", "measure over two balls, of a ring between them", "DIN 21773"),
    "measure_over_pins": Term("M_dR", "mm", "measure over two pins, of a ring between them", "DIN 21773"),
    "chordal_thickness": Term("s_c", "mm", "chordal tooth thickness on the reference circle", "DIN 21773"),
    "chordal_height": Term("h_c", "mm", "height of the chord of the tooth thickness below the tip", "DIN 21773"),
    "generating_shift": Term("x_E min, max", "1", "generating shift of each gear, minimum and maximum", "DIN 3960"),
    "span_measurement_limits": Term("W_k min, max", "mm", "span measurement of each gear, minimum and maximum"),
    "measure_limits": Term(
        "M_dK min, max", "mm", "measure over balls of each gear, of a ring between them, minimum and maximum"
    ),
    "backlash_circumferential": Term(
        "j_wt min, max", "mm", "backlash on the working circles, minimum and maximum", "DIN 3967"
    ),
    "backlash_normal": Term("j_bn min, max", "mm", "backlash between the flanks, minimum and maximum", "DIN 3967"),
    "backlash_angle": Term(
        "j_phi min, max", "deg", "free rotation of each gear with the other held, minimum and maximum"
    ),
    "output_play": Term(
        "j_out", "deg", "free rotation of the output gear with the input held, over all teeth; minimum and maximum"
    ),
    "tangential_force": Term("F_t", "N", "force on the reference circle", "ISO 6336-1"),
    "zone_factor": Term(
        "Z_H", "1", "influence of the flanks' curvature at the pitch point on the contact stress", "ISO 6336-2"
    ),
    "elasticity_factor": Term("Z_E", "1", "elasticity factor, in sqrt(N/mm^2)", "ISO 6336-2"),
    "contact_ratio_factor": Term(
        "Z_eps", "1", "influence of contact and overlap ratio on the contact stress", "ISO 6336-2"
    ),
    "helix_angle_factor_contact": Term(
        "Z_beta", "1", "helix angle factor of the flank, 1/sqrt(cos beta)", "ISO 6336-2"
    ),
    "single_contact_factor": Term("Z_B, Z_D", "1", "single pair tooth contact factors", "ISO 6336-2"),
    "nominal_contact_stress": Term("sigma_H0", "N/mm^2", "nominal contact stress at the pitch point", "ISO 6336-2"),
    "contact_stress": Term(
        "sigma_H", "N/mm^2", "contact stress; K factors computed with rating, else given or 1", "ISO 6336-2"
    ),
    "safety_pitting": Term(
        "S_H", "1", "safety against pitting; factors computed with rating, else given or 1", "ISO 6336-2"
    ),
    "root_chord": Term("s_Fn", "mm", "thickness of the root section", "ISO 6336-3"),
    "bending_moment_arm": Term("h_Fe", "mm", "moment arm of the load above the root section", "ISO 6336-3"),
    "root_fillet_radius": Term("rho_F", "mm", "radius of the fillet at the root section", "ISO 6336-3"),
    "form_factor": Term("Y_F", "1", "influence of the tooth's shape on the nominal root stress", "ISO 6336-3"),
    "stress_correction_factor": Term(
        "Y_S", "1", "influence of the root fillet as a notch on the root stress", "ISO 6336-3"
    ),
    "helix_angle_factor_bending": Term("Y_beta", "1", "helix angle factor of the root", "ISO 6336-3"),
    "rim_factor": Term("Y_B", "1", "rim thickness factor", "ISO 6336-3, IACS UR M56"),
    "deep_tooth_factor": Term("Y_DT", "1", "deep tooth factor of accurate gears", "ISO 6336-3, IACS UR M56"),
    "load_reversal_factor": Term("Y_d", "1", "factor for teeth bent both ways, as of an idler", "IACS UR M56.3.9"),
    "tip_form_factor": Term("Y_Fa", "1", "form factor for load at the tip (method C)", "ISO 6336-3:1996"),
    "tip_stress_correction_factor": Term(
        "Y_Sa", "1", "stress correction factor for load at the tip (method C)", "ISO 6336-3:1996"
    ),
    "contact_ratio_factor_bending": Term(
        "Y_eps", "1", "contact ratio factor of method C, with Y_Fa and Y_Sa alone", "ISO 6336-3:1996"
    ),
    "nominal_root_stress": Term("sigma_F0", "N/mm^2", "root stress without K factors", "ISO 6336-3"),
    "root_stress": Term(
        "sigma_F", "N/mm^2", "root stress; K factors computed with rating, else given or 1", "ISO 6336-3"
    ),
    "safety_bending": Term(
        "S_F", "1", "safety against tooth breakage; factors computed with rating, else given or 1", "ISO 6336-3"
    ),
    "dynamic_factor": Term("K_v", "1", "dynamic factor (method B)", "ISO 6336-1"),
    "resonance_ratio": Term("N_E", "1", "speed over the resonance speed", "ISO 6336-1"),
    "resonance_speed": Term("n_E1", "1/min", "resonance speed of gear 1", "ISO 6336-1"),
    "reduced_mass": Term(
        "m_red", "kg/mm", "mass of both gears, reduced to the line of action, per width", "ISO 6336-1"
    ),
    "single_stiffness": Term("c'", "N/(mm um)", "maximum stiffness of a pair of teeth", "ISO 6336-1"),
    "mesh_stiffness": Term("c_gamma,alpha", "N/(mm um)", "mean stiffness of the mesh", "ISO 6336-1"),
    "mesh_stiffness_face": Term(
        "c_gamma,beta", "N/(mm um)", "mean stiffness for the load across the face", "ISO 6336-1"
    ),
    "face_load_factor_contact": Term("K_Hbeta", "1", "face load factor of the flank (method C)", "ISO 6336-1"),
    "face_load_factor_bending": Term("K_Fbeta", "1", "face load factor of the root", "ISO 6336-1"),
    "transverse_load_factor_contact": Term("K_Halpha", "1", "transverse load factor of the flank", "ISO 6336-1"),
    "transverse_load_factor_bending": Term("K_Falpha", "1", "transverse load factor of the root", "ISO 6336-1"),
    "load_cycles": Term("N_L", "1", "load cycles of the required life", "ISO 6336-1"),
    "contact_limit": Term(
        "sigma_Hlim", "N/mm^2", "allowable contact stress number, given or of the material", "ISO 6336-5"
    ),
    "bending_limit": Term(
        "sigma_Flim", "N/mm^2", "nominal bending stress number, given or of the material", "ISO 6336-5"
    ),
    "lubricant_factor": Term("Z_L", "1", "influence of the oil's viscosity on the pitting limit", "ISO 6336-2"),
    "velocity_factor": Term("Z_V", "1", "influence of the pitch line speed on the pitting limit", "ISO 6336-2"),
    "roughness_factor": Term("Z_R", "1", "influence of the flanks' roughness on the pitting limit", "ISO 6336-2"),
    "work_hardening_factor": Term("Z_W", "1", "influence of a harder mating gear on the pitting limit", "ISO 6336-2"),
    "size_factor_contact": Term("Z_X", "1", "size factor of the flank", "ISO 6336-2"),
    "life_factor_contact": Term("Z_NT", "1", "life factor of the flank at N_L", "ISO 6336-2"),
    "pitting_limit_stress": Term("sigma_HG", "N/mm^2", "pitting stress limit at N_L", "ISO 6336-2"),
    "notch_sensitivity_factor": Term("Y_delta,relT", "1", "relative notch sensitivity factor", "ISO 6336-3"),
    "surface_factor": Term("Y_R,relT", "1", "relative surface factor of the root", "ISO 6336-3"),
    "size_factor_bending": Term("Y_X", "1", "size factor of the root", "ISO 6336-3"),
    "life_factor_bending": Term("Y_NT", "1", "life factor of the root at N_L", "ISO 6336-3"),
    "mean_stress_factor": Term("Y_M", "1", "mean stress influence factor", "ISO 6336-3"),
    "root_limit_stress": Term("sigma_FG", "N/mm^2", "tooth root stress limit at N_L", "ISO 6336-3"),
    "single_pitch_deviation": Term("f_pt", "um", "allowed single pitch deviation", "ISO 1328-1"),
    "base_pitch_deviation": Term("f_pb", "um", "allowed base pitch deviation", "ISO 1328-1"),
    "profile_form_deviation": Term("f_f,alpha", "um", "allowed profile form deviation", "ISO 1328-1"),
    "helix_slope_deviation": Term("f_H,beta", "um", "allowed helix slope deviation", "ISO 1328-1"),
    "damage_pitting": Term(
        "U_H", "1", "damage sum of the flanks over the required life, at the required safety", "ISO 6336-6"
    ),
    "damage_bending": Term(
        "U_F", "1", "damage sum of the roots over the required life, at the required safety", "ISO 6336-6"
    ),
    "pitting_life": Term("L_H", "h", "life of the flanks at the required safety; none without damage", "ISO 6336-6"),
    "bending_life": Term("L_F", "h", "life of the roots at the required safety; none without damage", "ISO 6336-6"),
    "integral_temperature": Term("theta_int", "deg C", "integral temperature of the flanks", "ISO/TR 13989-2"),
    "scuffing_temperature": Term(
        "theta_intS", "deg C", "integral temperature at which the oil fails", "ISO/TR 13989-2"
    ),
    "safety_scuffing": Term("S_intS", "1", "safety against scuffing, by temperatures", "ISO/TR 13989-2"),
    "generated_root_factor": Term(
        "Y_gen", "1", "root stress on the generated fillet over F_t/(b m), by boundary integral", "own derivation"
    ),
    "generated_root_stress": Term(
        "sigma_gen", "N/mm^2", "root stress on the generated fillet, with all load factors", "own derivation"
    ),
    "involute_margin": Term("rho_A1", "mm", "distance of the ring's tip from the pinion's base tangent point"),
    "radial_assembly_margin": Term("s_rad", "mm", "clearance of the pinion in radial assembly into the ring"),
}


_SLIDER_CRANK = {
    "quick_return_ratio": Term(
        "K",
        "1",
        "time of the forward over the return stroke; of crank-rocker and planar-mechanism of the slow over the fast "
        "stroke",
        "VDI 2142",
    ),
    "dead_center_extended": Term("theta_e", "deg", "crank direction from the slide line, stretched: asin(e/(L+r))"),
    "dead_center_folded": Term("theta_f", "deg", "crank direction from the slide line, folded: asin(e/(L-r))"),
    "dead_center_extended_at": Term("270 deg - theta_e", "deg", "input angle of the stretched dead centre"),
    "dead_center_folded_at": Term("90 deg - theta_f", "deg", "input angle of the folded dead centre"),
    "offset": Term(
        "e",
        "mm",
        "distance of the line of travel from the axis of crank or cam; of a cam positive where it passes on the right",
        "VDI 2142",
    ),
    "max_stroke": Term("S_max", "mm", "largest stroke of this rod and offset, 2 sqrt(L(L-|e|))", "own derivation"),
}

_PRESS = {
    "initial_crank_angle": Term("phi_AB0", "deg", "direction of AB at the start position", "TY-460 report 2.2"),
    "sync_start": Term("phi_s", "deg", "input angle at which the synchronous zone starts", "TY-460 report 3.2"),
    "sync_end": Term("phi_e", "deg", "input angle at which the synchronous zone ends", "TY-460 report 3.2"),
    "cam_sync_start": Term("theta_s", "deg", "cam angle at the start of the zone", "TY-460 report 3.2"),
    "cam_sync_end": Term("theta_e", "deg", "cam angle at the end of the zone", "TY-460 report 3.2"),
    "compensation": Term("h0", "mm", "bed displacement that the cam compensates in the zone", "TY-460 report 3.3"),
    "min_transmission_angle_bed": Term("mu_ABCD", "deg", "minimum transmission angle of the bed drive", "VDI 2142"),
    "min_transmission_angle_cylinder": Term("mu_GHMN", "deg", "minimum transmission angle of the cylinder drive"),
    "cam_base_radius": Term(
        "r_b", "mm", "distance from cam axis to roller centre at zero lift, given or found by size"
    ),
    "end_slope": Term("k1", "mm/rad", "slope of the lift at the end of the zone", "TY-460 report 3.3, repaired"),
    "transition_rise": Term("dx", "mm", "rise over the transition", "TY-460 report 3.3"),
    "follower_stroke": Term("h", "mm", "maximum less minimum lift over a revolution", "TY-460 report 3.3"),
    "return_end": Term("theta_r", "deg", "cam angle at which the return ends"),
    "roller_center_distance": Term("L_s1s2", "mm", "distance of the two roller centres", "TY-460 report 3.6"),
}

_CAM = {
    "max_pressure_angle": Term(
        "alpha_max", "deg", "maximum pressure angle of the main cam (a list: main, return cam)", "VDI 2142"
    ),
    "min_curvature_radius": Term(
        "rho_min",
        "mm",
        "minimum convex radius of the main cam's pitch curve, for a flat face or knife edge of its profile (a list: "
        "main, return cam)",
        "VDI 2142",
    ),
    "max_radius": Term("r_max", "mm", "largest radius of the main cam (a list: main, return cam)"),
    "min_radius": Term("r_min", "mm", "smallest radius of the main cam (a list: main, return cam)"),
    "return_max_pressure_angle": Term("alpha_max2", "deg", "maximum pressure angle of the return cam", "VDI 2142"),
    "return_min_curvature_radius": Term(
        "rho_min2", "mm", "minimum convex curvature radius of the return cam's pitch curve", "VDI 2142"
    ),
    "return_max_radius": Term("r_max2", "mm", "largest radius of the return cam"),
    "return_min_radius": Term("r_min2", "mm", "smallest radius of the return cam"),
}

_DISC_CAM = {
    "prime_radius": Term(
        "r_p", "mm", "distance from cam axis to roller centre at zero lift, given or the minimum", "VDI 2142"
    ),
    "start_angle": Term("Psi_0", "deg", "angle of the follower from the line pivot to cam axis at zero lift"),
    "nose_radius": Term("r_2", "mm", "radius of the nose of a cam that is made of arcs"),
    "nose_distance": Term("d", "mm", "distance from the cam axis to the centre of the nose"),
    "flank_radius": Term("R", "mm", "radius of the flanks of a cam that is made of arcs, negative where concave"),
    "action_angle": Term("2 alpha", "deg", "cam angle from the start of the rise to the end of the return"),
    "lift_max": Term("s_max", "mm", "maximum lift (oscillating: deg)", "VDI 2143"),
    "lift_max_at": Term("", "deg", "cam angle of the maximum lift"),
    "jerk_max": Term("j'_max", "mm/rad^3", "maximum third derivative of the lift (oscillating: 1/rad^2)", "VDI 2143"),
    "jerk_max_at": Term("", "deg", "cam angle of the maximum jerk"),
    "jerk_min": Term("j'_min", "mm/rad^3", "minimum third derivative of the lift (oscillating: 1/rad^2)", "VDI 2143"),
    "jerk_min_at": Term("", "deg", "cam angle of the minimum jerk"),
    "follower_velocity_max": Term("v_max", "mm/s", "maximum velocity of the follower (oscillating: rad/s)"),
    "follower_velocity_min": Term("v_min", "mm/s", "minimum velocity of the follower (oscillating: rad/s)"),
    "follower_acceleration_max": Term("a_max", "mm/s^2", "maximum acceleration (oscillating: rad/s^2)"),
    "follower_acceleration_min": Term("a_min", "mm/s^2", "minimum acceleration (oscillating: rad/s^2)"),
    "pressure_angle_rise": Term("alpha_r", "deg", "maximum pressure angle of the rises", "VDI 2142"),
    "pressure_angle_return": Term("alpha_f", "deg", "maximum pressure angle of the returns", "VDI 2142"),
    "pressure_angle_outside": Term("alpha_a", "deg", "maximum pressure angle at the outside diameter of a drum"),
    "least_wall_factor": Term("", "1", "minimum wall factor of a drum's track; not undercut above 0", "own derivation"),
    "min_concave_radius": Term("rho_c", "mm", "minimum radius of the concave flanks of the profile", "VDI 2142"),
    "contact_place_max": Term("t_max", "mm", "maximum position of the contact along a flat face", "own derivation"),
    "contact_place_min": Term("t_min", "mm", "minimum position of the contact along a flat face", "own derivation"),
    "face_length": Term(
        "t_max - t_min", "mm", "length of the flat face over which the contact moves", "own derivation"
    ),
    "spring_preload": Term("F_0", "N", "spring force at zero lift, given or the minimum (oscillating: N m)"),
    "lift_error_worst": Term("", "mm", "maximum sum of the lift's errors (oscillating: deg)", "own derivation"),
    "lift_error_rss": Term(
        "", "mm", "maximum root sum of squares of the lift's errors (oscillating: deg)", "own derivation"
    ),
    "acceleration_error": Term("", "mm/s^2", "acceleration due to the waviness of the profile", "own derivation"),
    "face_width_needed": Term("b", "mm", "minimum width for the allowed contact pressure", "Hertz, line contact"),
    "servo_rows": Term("", "1", "rows of the table of a servo drive, both ends included"),
    "servo_error": Term("", "mm", "maximum position error between the rows (oscillating: deg)", "own derivation"),
}

_GRIPPER = {
    "handover_speed": Term("v_F", "mm/s", "gripper speed at the handover", "swing-gripper paper 2"),
    "handover_mismatch": Term("dv", "mm/s", "gripper speed less the cylinder's surface speed"),
    "accelerate_angle": Term("D_a", "deg", "cylinder angle of the phase accelerate", "swing-gripper paper 2"),
    "constant_angle": Term("D_c", "deg", "cylinder angle of the phase at constant speed", "swing-gripper paper 2"),
    "decelerate_angle": Term("D_d", "deg", "cylinder angle of the phase decelerate", "swing-gripper paper 2"),
    "working_angle": Term(
        "", "deg", "cam angle of the working stroke of a wide swing", "wide-swing dissertation, ch. 1"
    ),
    "far_dwell_angle": Term("", "deg", "angle of the input in the far dwell", "swing-gripper paper 2"),
    "near_dwell_angle": Term("", "deg", "angle of the input in the near dwell", "swing-gripper paper 2"),
    "handover_angle": Term("theta_A", "deg", "cylinder angle of the handover", "swing-gripper paper 2"),
    "finger_lift": Term("", "mm", "travel of the finger tips at the end of the release window"),
    "fit_harmonics": Term("H", "1", "number of harmonics of the series through a measured profile"),
    "fit_rms": Term("", "mm", "root mean square deviation of a measured profile from its series"),
    "fit_max": Term("", "mm", "maximum deviation of a measured profile from its series"),
    "stop_force": Term("F_st", "N", "force of the spring on the stop in the near dwell"),
    "stop_force_max": Term("", "N", "maximum force on the stop in the impact of the return"),
    "stop_angle": Term("beta_s", "deg", "swing of the arm at rest on the stop"),
    "stop_tip_offset": Term(
        "", "mm", "distance of the gripper tip at rest on the stop from the pick-up position of the law"
    ),
    "stop_impact_angle": Term("theta_s", "deg", "cylinder angle at which the arm meets the stop in the return"),
    "stop_impact_speed": Term("", "mm/s", "speed with which the arm meets the stop"),
    "take_off_angle": Term("theta_t", "deg", "cylinder angle at which the cam lifts the arm off the stop"),
    "take_off_speed": Term("", "mm/s", "speed at the radius of the stop when the cam lifts the arm off it"),
    "stop_mass": Term("m_s", "kg", "cam rocker, coupler and gripper as a mass reduced to the stop"),
    "settling_time": Term("", "ms", "time of the rebounds on the stop"),
    "settling_angle": Term("", "deg", "cylinder angle of the rebounds on the stop"),
    "total_swing": Term("beta_T", "deg", "total swing of the gripper arm", "swing-gripper paper 2"),
    "spring_torque": Term("T_s,min", "N m", "minimum spring torque that keeps both rollers on their cams"),
    "newton_iterations": Term("", "1", "maximum number of Newton-Raphson steps at any position"),
    "newton_agreement": Term("", "deg", "maximum difference between closed form and Newton-Raphson", "own derivation"),
    "condition_number": Term("1/sin(mu)", "1", "largest condition number of the loop over the swing"),
    "handover_center": Term(
        "O_t", "mm", "cylinder axis for which the tip meets the pitch circle on the line of centres"
    ),
    "cam_center": Term("O", "mm", "cam axis in the machine's frame"),
    "closing_torque": Term("T_s", "N m", "torque of the closing spring on each rocker", "own derivation"),
    "lift_off_speed": Term("n*", "sheets/h", "speed at which a follower leaves its cam", "own derivation"),
}

_SWING = {
    "energy_parameter": Term("N", "1", "energy parameter of the unloader", "wide-swing dissertation (6), (11)"),
    "velocity_peak": Term("B", "1", "peak of the velocity invariant", "wide-swing dissertation (8), (13)"),
    "acceleration_peak": Term("C", "1", "peak of the acceleration invariant", "wide-swing dissertation (10), (15)"),
    "min_pivot_ratio": Term(
        "lambda_min", "1", "minimum pivot ratio with which the device can follow the swing", "dissertation (3), (4)"
    ),
    "force": Term("P", "N", "force of the pneumatic device, including the reserve", "wide-swing dissertation (6)"),
    "spring_rate": Term("c_s", "N/mm", "rate of the spring, including the reserve", "wide-swing dissertation (11)"),
    "base_distance": Term(
        "a_d", "mm", "distance from the rocker's axis to the base pin of the device", "wide-swing dissertation (3)"
    ),
    "device_length_min": Term("l_min", "mm", "length of the device between its pins at mid-swing", "own derivation"),
    "device_length_max": Term("l_max", "mm", "length of the device at the ends of the swing", "own derivation"),
    "device_stroke": Term("S", "mm", "stroke of the device, from mid-swing to an end", "wide-swing dissertation (2)"),
    "force_max": Term("F_d,max", "N", "maximum force of the device", "own derivation"),
    "force_min": Term("F_d,min", "N", "force of the spring at mid-swing", "own derivation"),
    "stored_energy": Term("E", "J", "energy stored in the device from mid-swing to an end", "dissertation (2)"),
    "balanced_speed": Term(
        "n_bal", "1/min", "speed at which the device balances the inertia", "dissertation (6), (11)"
    ),
    "reserve": Term("rho", "1", "force of the device over the balancing force, less 1", "own derivation"),
    "bore": Term("d", "mm", "bore of the cylinder required for the force at the given pressure", "own derivation"),
    "standard_bore": Term("d_s", "mm", "next standard bore", "ISO 6432, ISO 15552"),
    "set_pressure": Term("p_s", "N/mm^2", "gauge pressure that gives the force with the chosen bore"),
    "force_variation": Term("", "1", "rise of the cylinder's force over its stroke, closed volume", "isentropic, 1.4"),
    "mounting_stretch": Term("S_0", "mm", "stretch of the spring at mid-swing", "wide-swing dissertation (11)"),
    "stretch_max": Term("S_0 + S", "mm", "stretch of the spring at the ends of the swing", "own derivation"),
    "free_length": Term("l_f", "mm", "distance between the pins of the spring at zero force", "own derivation"),
    "mass": Term("m", "kg", "mass of the pendulum that balances the rocker", "own derivation"),
    "max_distance": Term("s_max", "mm", "distance of the mass above which a pendulum is too slow", "own derivation"),
    "rocker_radius": Term("r", "mm", "rocker radius to the roller", "wide-swing dissertation (18), (24)"),
    "profile_correction": Term("xi", "deg", "angular correction of the profile at the end", "dissertation (19), (25)"),
    "phase_angle": Term("Phi", "deg", "phase angle of the run-up on the cam", "dissertation (21), (22), (25)"),
    "start_curvature_radius": Term(
        "R0", "mm", "radius of curvature of the pitch curve at the start", "dissertation (23), exact"
    ),
    "iteration_energy_parameter": Term("N_it", "1", "N by the iteration of the source", "dissertation fig. 4"),
    "iteration_passes": Term("", "1", "passes of the iteration of the source"),
    "iteration_error": Term("N_it/N - 1", "1", "relative error of the energy parameter by the iteration of the source"),
    "transition_zone": Term("dk", "1", "half-width of the contact change at mid-swing", "own derivation"),
    "return_transition_zone": Term("dk2", "1", "half-width of the contact change of the return cam", "own derivation"),
    "zero_end_swing": Term("", "deg", "swing with zero pressure angle at its ends, 2 acos(r/a)", "dissertation ch. 3"),
    "largest_profile_correction": Term("xi_max", "deg", "largest angular correction of the stroke", "own derivation"),
    "start_radius_estimate": Term("R0*", "mm", "estimate of R0 by the source", "dissertation (23)"),
    "middle_radius_estimate": Term(
        "Rm*", "mm", "estimate of the radius at mid-swing by the source", "dissertation (27)"
    ),
    "contact_end": Term("k_c", "1", "fraction of the stroke at which the roller leaves the profile", "own derivation"),
    "contact_force": Term("F", "N", "maximum force of a roller on its cam at the design speed", "own derivation"),
    "line_of_centers_place": Term("k*", "1", "fraction of the stroke at which the roller passes the line of centres"),
    "roller_arm_offset": Term(
        "phi*", "deg", "rocker angle from mid-swing at which the roller passes the line of centres", "own derivation"
    ),
    "impact_speed": Term("v_i", "mm/s", "speed of the roller's impact on the other flank", "own derivation"),
    "impact_place": Term("k_i", "1", "fraction of the stroke at the impact on the other flank", "own derivation"),
    "impact_energy": Term("E_i", "J", "energy of the impact on the other flank", "own derivation"),
    "impact_force": Term("F_i", "N", "maximum force of the impact on the other flank", "own derivation"),
    "end_position_gain": Term(
        "G_e", "1", "displacement at the output radius in the dwells, per mm of profile error", "own derivation"
    ),
    "shaft_distance": Term("O1O2", "mm", "distance of two parallel cam shafts", "dissertation figure 2"),
    "roller_arm_angle": Term("psi", "deg", "angle between the arms of the two rollers", "dissertation figure 2"),
    "cam_gap": Term("", "mm", "clearance between the circles of two cams on parallel shafts", "own derivation"),
    "cam_shaft_gap": Term("", "mm", "minimum clearance between a cam and the shaft of the other", "own derivation"),
    "dwell_force": Term("F_d", "N", "maximum force of a roller on its cam during the dwells", "own derivation"),
    "sectors_external": Term(
        "", "deg", "external profile: driven, arc, free, arc from its stroke on", "own derivation"
    ),
    "sectors_internal": Term(
        "", "deg", "internal profile: driven, arc, free, arc from its stroke on", "own derivation"
    ),
    "sectors_return": Term("", "deg", "return cam: driven, arc, free, arc from its stroke on", "own derivation"),
    "longer_stroke_reserve": Term(
        "",
        "1",
        "force reserve of the device in the longer stroke over the balancing force there: (1 + rho)(longer/shorter)^2 "
        "- 1",
        "own derivation",
    ),
    "structural_error": Term("", "deg", "maximum error of the function over its interval", "own derivation"),
    "structural_error_at": Term("", "deg", "input angles of the maximum error of the function"),
    "error_extremes": Term(
        "",
        "1",
        "number of alternating extremes of the structural error, all of equal magnitude; the best five-bars have eight",
    ),
    "function_start": Term("phi0", "deg", "input angle at which the function starts", "own derivation"),
    "output_zero": Term("psi0", "deg", "output angle at which the function starts", "own derivation"),
    "starts_tried": Term("", "1", "number of starts that the search tried"),
    "first_point_angle": Term("phi_1", "deg", "input angle of the first of the timed points", "own derivation"),
    "power_peak": Term("max(b c)", "1", "peak of the power invariant", "own derivation"),
    "drive_torque_peak": Term(
        "M_dr", "N m", "maximum torque of the cam shaft without device and without linkage_share", "chapter 5"
    ),
    "dynamic_coefficient": Term(
        "K_d", "1", "torque with the elasticity of the drive over the torque of a rigid drive", "chapter 5"
    ),
    "drive_balancing_ratio": Term(
        "K_y2", "1", "torque of the cam shaft without the device over that with it", "chapter 5"
    ),
    "slider_stroke": Term("H", "mm", "travel of the slider over the swing", "dissertation (16), (17)"),
    "reference_inertia": Term("J_ref", "kg m^2", "inertia of the energy parameter, J + m H^2/gamma^2"),
    "rocker_share": Term("j0", "1", "share of the rocker in J_ref", "own derivation"),
    "middle_place": Term("k_mid", "1", "fraction of the stroke at which the rocker passes mid-swing", "own derivation"),
    "slider_velocity_peak": Term("B_s", "1", "peak of the slider's velocity invariant", "dissertation (16), (17)"),
    "slider_acceleration_peak": Term("C_s", "1", "peak of the slider's acceleration invariant", "own derivation"),
    "crank_span": Term(
        "phi_k", "deg", "crank angle between the dead centres of the crank-rocker that drives the cam", "own derivation"
    ),
    "cam_swing": Term("chi", "deg", "swing of an oscillating cam", "dissertation, chapter 4"),
    "middle_pressure_angle": Term(
        "alpha_m", "deg", "pressure angle of an oscillating cam at mid-swing, with the sign of the table of the cam"
    ),
}

_MOBILITY = {
    "link_count": Term("n", "1", "number of links, including the frame"),
    "linkage_mobility": Term("F0", "1", "degrees of freedom of the linkage alone", "thesis 2.1"),
    "train_count": Term("", "1", "gear trains"),
    "fixed_ends": Term("R", "1", "end gears fixed to a link, per train", "thesis 2.1"),
    "mobility_changes": Term("dF", "1", "degrees of freedom added by each train, 1 - R", "thesis 2.1"),
    "mobility": Term("F", "1", "degrees of freedom of linkage and trains", "thesis 2.1"),
}

_MUTILATED = {
    "reduction": Term("i_r", "1", "input revolutions per revolution of the mutilated wheel"),
    "full_teeth": Term("Z_M", "1", "maximum number of teeth on the intermittent gear"),
    "group_teeth": Term("n", "1", "neighbouring teeth of the mutilated wheel between two gaps"),
    "driven_teeth": Term("Z_F", "1", "teeth of the driven gear"),
    "stops": Term("", "1", "locking arcs on the driven gear"),
    "cycle_turns": Term("i_r/g", "1", "input revolutions per output cycle", "own derivation"),
    "motion_turns": Term("", "1", "input revolutions during which the driven gear turns", "own derivation"),
    "dwell_turns": Term("", "1", "input revolutions during which the driven gear dwells", "own derivation"),
    "motion_share": Term("t_m/T", "1", "share of the cycle in motion", "own derivation"),
    "dwell_share": Term("1 - n g/Z_M", "1", "share of the cycle at rest", "own derivation"),
    "driven_turn": Term("n/Z_F", "1", "revolutions of the driven gear per group of teeth", "own derivation"),
    "driven_speed_ratio": Term("Z_M/(Z_F i_r)", "1", "driven speed over input speed in motion", "own derivation"),
    "cycles_to_repeat": Term("", "1", "cycles until the driven gear is in the same position again"),
    "end_tooth_radius": Term(
        "", "mm", "radius of the first and the last tooth of a group, cut to pass the gear at rest"
    ),
    "locking_radius": Term("R", "mm", "radius of the locking disc's arcs, given or the pitch radius of the wheel"),
    "locking_arc": Term("", "deg", "angle of an arc of the locking disc about the axis of the wheel", "own derivation"),
    "held_turns": Term("", "1", "input revolutions during which the locking disc holds the gear against both senses"),
    "locking_arm": Term("", "mm", "distance of the locking force from the axis of the driven gear", "own derivation"),
    "start_crank_angle": Term("phi_0", "deg", "crank angle of the dwell"),
    "rocker_swing": Term("", "deg", "angle between the limit positions of the rocker"),
    "rocker_start_speed": Term("", "1", "rocker speed over input speed right after the start with the largest impact"),
    "tip_fouling_margin": Term("", "mm", "clearance between the tips of planet and ring gear", "own derivation"),
}

_PLANET_LINKAGE = {
    "planet_teeth": Term("z2", "1", "teeth of the gear that rolls on the central gear"),
    "coupler_gear_teeth": Term("z2", "1", "teeth of the gear fixed to the coupler"),
    "gear_ratio": Term("i", "1", "-z2/z5 for an external mesh, z2/z5 in a ring gear", "thesis 2.2.1"),
    "linkage_kind": Term("", "1", "class of the linkage by Grashof's rule"),
    "speed_ratio_max_at": Term("", "deg", "crank angle of the maximum output speed"),
    "speed_ratio_min_at": Term("", "deg", "crank angle of the minimum output speed"),
    "coupler_ratio_max": Term("(w2/w1)max", "1", "maximum coupler speed per crank speed", "thesis 2.2.1"),
    "coupler_ratio_min": Term("(w2/w1)min", "1", "minimum coupler speed per crank speed", "thesis 2.2.1"),
    "standstill_coupler_ratio": Term("1 - 1/i", "1", "w2/w1 at zero output velocity", "thesis 2.2.1"),
    "dwell_teeth_ratio": Term("(z5/z2)max", "1", "maximum z5/z2 with which the output stops with these links"),
    "output_swing": Term("", "deg", "swing of the output between its extreme positions", "own derivation"),
    "swing_multiple": Term("", "1", "output swing over rocker swing", "thesis figure 2-4"),
    "naive_multiple": Term("1 + z2/z5", "1", "output swing over rocker swing if the coupler did not rotate"),
    "extreme_crank_angles": Term("", "deg", "crank angles at which the output reverses", "own derivation"),
    "swing_residual": Term("", "deg", "achieved swing less required swing"),
}

_HYPOCYCLOID = {
    "cusps": Term("n", "1", "cusps of the curve, ring teeth over planet teeth", "thesis figure 2-5"),
    "ring_teeth": Term("z_r", "1", "teeth of the ring gear"),
    "carrier_length": Term("", "mm", "carrier length, the centre distance of planet and ring gear"),
    "point_radius": Term("r", "mm", "pitch radius of the planet, on which the point lies"),
    "rod_length": Term("L", "mm", "rod to the slider"),
    "tangent_circle_length": Term(
        "", "mm", "rod length by the circle through ends and middle of the dwell", "own derivation"
    ),
    "osculating_length": Term("4 r (n-1)/(n-2)", "mm", "rod length by the circle of curvature at mid-dwell"),
    "dwell_carrier_angle": Term("", "deg", "required carrier angle of the dwell"),
    "dwell_ripple": Term("", "mm", "range of the slider's position in the dwell", "own derivation"),
    "dwell_deviation_min": Term("", "mm", "minimum deviation from the position in mid-dwell, inwards positive"),
    "dwell_deviation_max": Term("", "mm", "maximum deviation from the position in mid-dwell, inwards positive"),
    "tolerance_carrier_angle": Term(
        "", "deg", "widest carrier angle about mid-dwell with the slider within +- the tolerance"
    ),
    "stroke": Term("S", "mm", "stroke of the slider"),
    "ripple_share": Term("", "1", "ripple over stroke"),
}

_FIVE_BAR = {
    "form": Term("", "1", "path of a coupler point, or output as a function of the input"),
    "five_bar_ratio": Term("k", "1", "output over input speed of the gears", "thesis figure 2-1"),
    "coupler_ratio": Term("m", "1", "coupler over input speed, 1 + z5/z2 or 1 - z5/z2", "thesis figure 2-7, a reading"),
    "period_turns": Term("q", "1", "input revolutions until the motion repeats", "own derivation"),
    "input_length": Term("a", "mm", "input link AB"),
    "follower_length": Term("c", "mm", "follower CD"),
    "output_length": Term("e", "mm", "output link, from the last coupler to its pivot"),
    "start_directions": Term("", "deg", "directions of BC, CD, DE and FE of a six-bar at input angle 0"),
    "phase": Term(
        "delta", "deg", "direction of the output link at input angle 0; of the coupler where a function is generated"
    ),
    "assembly": Term("", "1", "assembly, +1 or -1"),
    "point_along": Term("u", "mm", "coupler point, along B->C"),
    "point_across": Term("v", "mm", "coupler point, to the left of B->C"),
    "span_min": Term("", "mm", "minimum span of the dyad", "own derivation"),
    "span_min_at": Term("", "deg", "input angle of the minimum span"),
    "span_max": Term("", "mm", "maximum span of the dyad", "own derivation"),
    "span_max_at": Term("", "deg", "input angle of the maximum span"),
    "min_transmission_angle_at": Term("", "deg", "input angle of the minimum transmission angle"),
    "path_width": Term("", "mm", "extent of the path along the frame"),
    "path_height": Term("", "mm", "extent of the path across the frame"),
    "phase_step": Term("360/z4", "deg", "change of the phase by one tooth"),
    "path_deviation_rms": Term("", "mm", "root mean square of the distances in the table deviations"),
    "path_deviation_max": Term("", "mm", "maximum distance in the table deviations"),
    "position_errors": Term("", "deg", "achieved less required output angle, at each position"),
}

_STUDY = {
    "designs": Term("N", "1", "designs of a study that were computed"),
    "refused": Term("", "1", "designs of a study without a mechanism, or without one of the objectives"),
    "feasible": Term("", "1", "designs of a study that satisfy all checks and conditions"),
    "front_size": Term("", "1", "designs that no other design dominates, including all equal ones"),
    "kept": Term("", "1", "designs kept of the front, one for each box of the resolution"),
    "shown": Term("", "1", "kept designs shown in the terminal, at most 50"),
    "exhaustive": Term("", "1", "true if all designs were computed, so that the front is exact"),
    "knee": Term("", "1", "index of the kept design with the minimum sum of the objectives, each scaled from 0 to 1"),
}

_TOLERANCE = {
    "yield": Term("Y", "1", "share of the designs as manufactured that pass all checks and requirements"),
    "yield_low": Term("", "1", "lower end of the yield's 95 % interval"),
    "yield_high": Term("", "1", "upper end of the yield's 95 % interval"),
    "samples": Term("N", "1", "designs as manufactured that were computed"),
    "seed": Term("", "1", "seed of the samples: the same seed gives the same samples"),
    "no_mechanism": Term("", "1", "share of the designs as manufactured that do not exist"),
    "dwell_swing": Term("", "deg", "half the range of the output over the nominal dwell, +-"),
}

_REGISTER = {
    "worst": Term(
        "", "mm", "register error with all sources added, each at its larger limit, for torque sign +1 and -1"
    ),
    "rss": Term("", "mm", "standard deviation of the register error, for torque sign +1 and -1"),
    "band": Term(
        "",
        "mm",
        "register error +- that 99.73 % of the machines keep (by register.method worst all), for torque sign +1 and -1",
    ),
    "dead_band": Term("", "mm", "jump of the output where its torque reverses, due to the backlash of the meshes"),
    "flips": Term("", "deg", "input angles at which the torque on the output reverses"),
}

_LOADS = {
    "input_torque_mean": Term("M_m", "N m", "mean input torque over the period"),
    "input_torque_rms": Term("M_rms", "N m", "root mean square of the input torque"),
    "input_torque_max": Term("M_max", "N m", "maximum input torque", "virtual power"),
    "input_torque_max_at": Term("phi_max", "deg", "input angle of the maximum input torque"),
    "input_torque_min": Term("M_min", "N m", "minimum input torque", "virtual power"),
    "input_torque_min_at": Term("phi_min", "deg", "input angle of the minimum input torque"),
    "input_power_mean": Term("P_m", "W", "input power averaged over the period"),
    "input_power_peak": Term("P_max", "W", "maximum input power"),
    "reflected_inertia_min": Term("J_min", "kg m^2", "minimum inertia of all links, reduced to the input"),
    "reflected_inertia_max": Term("J_max", "kg m^2", "maximum inertia of all links, reduced to the input"),
    "reflected_inertia_mean": Term("J_m", "kg m^2", "mean over the input angle of the inertia reduced to the input"),
    "torque_reversals": Term("", "1", "number of sign changes of the input torque over the period"),
    "energy_fluctuation": Term(
        "dW", "J", "energy fluctuation at constant drive torque, without the kinetic energy of the masses"
    ),
    "flywheel_inertia": Term("J_F", "kg m^2", "flywheel inertia at the input for the allowed speed fluctuation"),
    "speed_min": Term("n_min", "1/min", "minimum speed of the input with its flywheel or motor"),
    "speed_max": Term("n_max", "1/min", "maximum speed of the input with its flywheel or motor"),
    "speed_fluctuation": Term("delta", "1", "(maximum - minimum)/mean speed of the input, the mean half their sum"),
    "motor_torque_rms": Term("M_mot", "N m", "root mean square over the time of the motor's torque"),
    "motor_torque_peak": Term("M_mot,max", "N m", "maximum torque of the motor; negative where the load drives it"),
    "shaking_force_max": Term("F_s", "N", "maximum force of the moving masses on the frame"),
    "shaking_moment_max": Term("M_s", "N m", "maximum moment of the moving masses about the input's pivot"),
    "peak": Term("F_max", "N", "maximum force of a pin over the period"),
    "equivalent": Term(
        "P", "N", "equivalent bearing load of a pin over its relative rotation, exponent 3 or 10/3", "ISO 281"
    ),
    "travel": Term("", "1", "relative revolutions of a pin per input revolution, both senses added"),
    "life": Term("L_10", "h", "rating life of a pin's bearing, at its reliability", "ISO 281"),
    "bearing_pressure": Term("p", "N/mm^2", "maximum pressure of a pin's plain bearing, F/(b d)"),
    "counterweight_crank": Term("U_1", "kg mm", "mass moment of the counterweight on the crank"),
    "counterweight_crank_direction": Term(
        "arg U_1", "deg", "direction of the crank's counterweight in the crank's coordinates"
    ),
    "counterweight_rocker": Term("U_3", "kg mm", "mass moment of the counterweight on the rocker"),
    "counterweight_rocker_direction": Term(
        "arg U_3", "deg", "direction of the rocker's counterweight in the rocker's coordinates"
    ),
    "balanced_force_max": Term("F_s,bal", "N", "maximum shaking force with the counterweights"),
    "contact_force_max": Term("N_max", "N", "maximum force between roller and cam, or pin and slot"),
    "contact_force_min": Term("N_min", "N", "minimum force between roller and cam"),
    "hertz_pressure_max": Term("p_H", "N/mm^2", "maximum Hertzian pressure of roller and cam", "Hertz, line contact"),
    "shear_depth": Term("z_tau", "mm", "depth of the maximum shear stress below the cam's surface", "Hertz"),
    "roller_speed_max": Term("n_r", "1/min", "maximum speed of the roller about its own axis"),
    "roller_acceleration_max": Term("a_r", "rad/s^2", "maximum angular acceleration of the roller"),
    "traction_needed": Term("mu_r", "1", "maximum ratio of the friction that drives the roller to the contact force"),
    "entrainment_speed_max": Term(
        "u", "mm/s", "maximum entrainment speed of both surfaces in the contact of roller and cam"
    ),
    "cam_torque_max": Term("M_cam", "N m", "maximum torque on the cams about their axis, counter-clockwise"),
    "cam_torque_min": Term("M_cam,min", "N m", "minimum torque on the cams about their axis, counter-clockwise"),
    "cam_torque_rms": Term("M_cam,rms", "N m", "root mean square of the torque on the cams"),
    "preload_needed": Term("P_min", "N", "minimum preload that keeps both rollers of a positive drive on their cams"),
    "natural_frequency": Term("f_n", "Hz", "natural frequency of the output with its elastic drive"),
    "frequency_ratio": Term("f_n/f", "1", "natural frequency of the output over the frequency of the input"),
    "rise_periods": Term("n_T", "1", "natural periods in the shortest motion between two dwells", "T_1 f_n"),
    "residual_amplitude": Term("A", "deg", "amplitude of the residual vibration in the dwell after a motion"),
    "residual_speed_limit": Term(
        "n_A", "1/min", "lowest speed at which the residual vibration exceeds the allowed one"
    ),
    "dwell_twist": Term("z_max", "deg", "maximum deflection of the output in its dwells, steady state"),
    "twisted_ripple": Term("D_z", "deg", "range of the output in a dwell, including its deflection"),
    "tooth_force_max": Term("F_t", "N", "maximum tangential force of a mesh"),
    "reversals": Term("", "1", "number of flank changes of a mesh over the period"),
    "axial_force_max": Term("F_a", "N", "maximum axial force of helical teeth, F_t tan(beta_w)"),
    "tilting_moment_max": Term("M_t", "N m", "maximum moment F_a r_w of the axial force on gear 1 and gear 2"),
    "engagement_energy": Term("E", "J", "energy lost in the start with the largest impact of a mutilated gear"),
    "massless": Term("", "1", "links for which the file gives no mass, computed without mass"),
    "power_identity": Term("", "1", "difference of the input torques by virtual power and by the joint forces"),
}

TERMS: dict[str, Term] = {
    **STEPPING,
    **GEAR_LINKAGE,
    **REAL_SPEED,
    **SLIDER,
    **CRANK_ROCKER,
    **GEAR_PAIR,
    **_SLIDER_CRANK,
    **_PRESS,
    **_CAM,
    **_DISC_CAM,
    **_GRIPPER,
    **_SWING,
    **_MOBILITY,
    **_MUTILATED,
    **_PLANET_LINKAGE,
    **_HYPOCYCLOID,
    **_FIVE_BAR,
    **MOTION_EXTREMES,
    **SHAPED_LAWS,
    **PLANAR,
    **MACHINE,
    **_STUDY,
    **_TOLERANCE,
    **_REGISTER,
    **_LOADS,
}


def entries() -> Iterator[tuple[str, str, Term]]:
    """Every quantity with its entry; where a kind has its own, once more with the name of the kind."""
    from gearlink.core.base.kinds import KINDS

    yield from ((name, "", entry) for name, entry in TERMS.items())
    yield from ((name, kind.name, Term(*own)) for kind in KINDS.values() for name, own in kind.terms.items())


ALIASES = {
    "prime_radius": "cam_base_radius",
    "dimension_over_balls": "measure_over_balls",
    "dimension_over_pins": "measure_over_pins",
    "dimension_limits": "measure_limits",
    "base_tangent_length": "span_measurement",
    "base_tangent_length_limits": "span_measurement_limits",
    "dwell_half_range": "dwell_tolerance",
    "middle_position": "middle_place",
    "line_of_centers_position": "line_of_centers_place",
    "contact_position_max": "contact_place_max",
    "contact_position_min": "contact_place_min",
    "output_speed_max": "output_velocity_max",
    "output_speed_max_at": "output_velocity_max_at",
    "output_speed_min": "output_velocity_min",
    "output_speed_min_at": "output_velocity_min_at",
    "input_speed_max": "input_velocity_max",
    "input_speed_max_at": "input_velocity_max_at",
    "input_speed_min": "input_velocity_min",
    "input_speed_min_at": "input_velocity_min_at",
    "register_worst_case": "worst",
    "register_standard_deviation": "rss",
    "register_band": "band",
    "torque_reversal_angles": "flips",
    "retained_designs": "kept",
    "bearing_life": "life",
    "equivalent_load": "equivalent",
    "joint_force_max": "peak",
    "joint_travel": "travel",
}
"""The standard terms that are accepted for names of quantities; some are quantities of other kinds by themselves."""


def fixed_name(name: str, known: Collection[str]) -> str:
    """The name of a quantity of which a standard term is given; what is no such term stays as it is.

    Parameters
        known : the quantities of a design; one of them that bears the term itself is meant by it
    Example
        >>> fixed_name("prime_radius", ("cam_base_radius",)), fixed_name("prime_radius", ("prime_radius",))
        ('cam_base_radius', 'prime_radius')
    """
    if not isinstance(name, str):  # of a program of a user's own, whose names are refused elsewhere
        return name
    head, dot, last = name.rpartition(".")
    fixed = f"{head}{dot}{ALIASES.get(last, last)}"
    return fixed if name not in known and fixed in known else name


def term(name: str, kind: str = "") -> Term:
    """The entry of a quantity, of a kind where it has its own; of `crank_idler.contact_ratio` the last part counts.

    Raises
        GearlinkError - for a name without an entry
    """
    from gearlink.core.base.kinds import KINDS

    last = name.rpartition(".")[2]
    own = KINDS[kind].terms if kind in KINDS else {}
    try:
        return Term(*own[last]) if last in own else TERMS[last]
    except KeyError:
        raise GearlinkError(f"no nomenclature entry for {name!r}") from None
