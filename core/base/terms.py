"""The words of parts and machines: symbol, unit, meaning and source of their quantities."""

from __future__ import annotations

from typing import NamedTuple


class Term(NamedTuple):
    """Symbol, unit, meaning and source of a quantity."""

    symbol: str
    unit: str
    words: str
    source: str = ""


GENEVA = {
    "crank_radius": Term("r", "mm", "radius of the pin's circle", "thesis 4.2.1; own derivation: a sin(pi/n)"),
    "wheel_radius": Term("R", "mm", "radius of the wheel to its slots' mouths", "own derivation: a cos(pi/n)"),
    "slot_bottom_radius": Term("", "mm", "wheel axis to the bottoms of the slots"),
    "lip_thickness": Term(
        "", "mm", "metal between locking arc and slot", "own derivation: r - b/2 - h, h radius of the arc"
    ),
    "motion_angle": Term("2 f_0", "deg", "input angle of a step", "own derivation: 180 deg - s 360 deg/n"),
    "wheel_backlash": Term("", "deg", "maximum angle that the wheel can turn about the pin in its slot"),
    "locking_play": Term("", "deg", "angle that the wheel can turn in the middle of the dwell, held by the disc"),
    "locking_angle": Term("", "deg", "input angle between two steps, in which the wheel dwells"),
    "entry_acceleration_ratio": Term("tan(pi/n)", "1", "jump of the acceleration ratio at entry and exit"),
    "steps_per_minute": Term("", "1/min", "steps of the wheel in a minute: input speed times pins", "thesis 4.2.1"),
    "contact_force_max_at": Term("", "deg", "input angle of the maximum contact force"),
}
REDUCER = {
    "ratio": Term("i", "1", "input speed over output speed, signed", "thesis 2.2.2 II"),
    "lobes": Term("z", "1", "lobes of the disc, one less than pins", "thesis 2.2.2 II"),
    "shortening": Term("K", "1", "shortening coefficient e Z/R", "own derivation"),
    "pressure_angle_min": Term("", "deg", "minimum pressure angle at the pins that push, eccentric at 0"),
    "pressure_angle_mean": Term("", "deg", "mean pressure angle at the pins that push, eccentric at 0"),
    "pressure_angle_max": Term("", "deg", "maximum pressure angle at the pins that push, eccentric at 0"),
    "pin_force_max": Term("F_P,max", "N", "maximum force of a ring pin, pins of equal stiffness", "own derivation"),
    "output_pin_force_max": Term("Q_max", "N", "maximum force of an output pin", "own derivation"),
    "efficiency": Term(
        "eta",
        "1",
        "estimate from forces without loss; no churning, no seals; the force on the eccentric's bearing "
        "is taken as ring pins plus output pins pushing the same way, more than it is",
        "own derivation",
    ),
    "backlash": Term("", "deg", "turn of the disc between both flanks of the pins", "own derivation"),
    "output_hole_radius": Term("r_w + e", "mm", "radius of the holes for the output pins"),
}
RACKS = {
    "stroke_ratio": Term("1 +- z_m/z_f", "1", "stroke of the rack over the rod end's, signed", "thesis 2.2.2 III"),
    "output_stroke": Term("S_R", "mm", "stroke of the moving rack", "thesis 2.2.2 III"),
    "pinion_turns": Term("", "1", "turns of the pinion in a stroke"),
    "fixed_rack_travel": Term("", "mm", "distance that the pinion rolls on the fixed rack"),
    "moving_rack_travel": Term("", "mm", "distance that the pinion rolls on the moving rack"),
    "fixed_rack_length": Term("", "mm", "minimum length of the fixed rack: travel and path of contact"),
    "moving_rack_length": Term("", "mm", "minimum length of the moving rack: travel and path of contact"),
}
STEP_TRAIN = {"steps": Term("", "1", "steps of the output per revolution of the carrier", "thesis 2.2.2")}
CAM_DRIVE = {
    "lever_swing": Term("", "deg", "range of the lever's angle against the carrier", "thesis 1.3.4; own derivation"),
    "path_speed_max": Term("", "mm/s", "maximum speed along the path"),
    "path_speed_min": Term("", "mm/s", "minimum speed along the path"),
}
GUIDANCE = {
    "pose_error_max": Term("", "mm", "maximum distance of the guided body's point from a pose", "thesis 2.2.2 VI"),
    "pose_error_rms": Term("", "mm", "root of the mean square of these distances"),
    "pose_angle_error_max": Term("", "deg", "maximum angle by which the guided body misses a pose"),
    "body_angle": Term("", "deg", "direction of the coupler BC less the body's angle"),
    "frame_place": Term("", "mm", "position of A in the coordinates of the poses, where the frame is free"),
    "frame_direction": Term("", "deg", "direction from A to E there"),
}
PRESS_TEETH = {
    "pinion_radius": Term("r_8", "mm", "radius with which the pinion rolls on both racks", "TY-460 report 2.4"),
    "rack_teeth": Term("", "1", "teeth of the lower and the upper rack, given or as many as the travel takes"),
    "rack_travel": Term("", "mm", "distance of the pinion along the lower and the upper rack"),
}
STEPPING = {**PRESS_TEETH, **GUIDANCE, **GENEVA, **REDUCER, **RACKS, **STEP_TRAIN, **CAM_DRIVE}


MACHINE = {
    "least_margin": Term("", "deg", "minimum margin of the relations between events", "own derivation"),
    "limiting_relations": Term("", "1", "relations that leave the free phases no greater margin"),
    "cycle_turns": Term("", "1", "turns of the main shaft after which everything repeats"),
    "phase": Term("", "deg", "machine angle at which the member's input angle is 0, as found", "own derivation"),
    "phase_room": Term("", "deg", "width of the interval in which the phase was taken", "own derivation"),
    "natural_frequencies": Term("f", "Hz", "natural frequencies of the main shaft", "Thomson, 12.4"),
    "critical_speeds": Term("n_c", "1/min", "speeds at which the main shaft turns once a period of its own", "60 f"),
    "machine_speed_limit": Term("", "1/min", "speed of the main shaft at which the first member reaches its limit"),
    "speed_limit_member": Term("", "1", "the member that limits the machine's speed"),
    "speed_limit_check": Term("", "1", "the check by which it does"),
    "members_without_loads": Term("", "1", "members that add nothing, since they have no section loads"),
    "wind_up_max_at": Term("", "deg", "machine angle of the maximum wind-up"),
    "wind_up_disc": Term("", "1", "the disc that is wound up most"),
    "wind_up_max": Term("", "deg", "maximum wind-up of a disc of the main shaft against the first one", "modes"),
    "wind_up_at_print": Term("", "mm", "shift of the register by the twist of the main shaft, alike in every machine"),
    "machine_yield": Term("", "1", "share of the machines that keep the allowed register", "normal law"),
}


PLANAR: dict[str, Term] = {
    "degrees_of_freedom": Term(
        "F", "1", "degrees of freedom, 3 n - 2 (pins + slides) - slots - meshes - cams", "Gruebler"
    ),
    "grashof": Term("", "1", "class of the four-bars of the driven link by Grashof's rule", "VDI 2145"),
    "free_range": Term("", "deg", "inputs from dead centre to dead centre, between which the range lies"),
    "closure_error": Term("", "mm", "maximum gap of a joint over the rows"),
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


GEAR_LINKAGE: dict[str, Term] = {
    "i3": Term("i3", "1", "ratio of idler and output gear, -z3/z5", "thesis 4.1"),
    "crank_teeth": Term("z1", "1", "teeth of the gear fixed to the crank"),
    "idler_teeth": Term("z3", "1", "teeth of gear 3, on the pin of coupler and rocker"),
    "output_teeth": Term("z5", "1", "teeth of the output gear"),
    "frame_ratio": Term("d", "1", "frame length over crank length", "thesis (4-18), (4-20)"),
    "crank_length": Term("l1", "mm", "distance from the crank's fixed pivot to its pin"),
    "coupler_length": Term("l2", "mm", "coupler (three gears: centre distance of 1 and 3; six-bar: BC, CD, DE)"),
    "rocker_length": Term("l3", "mm", "rocker; with three gears the centre distance of gears 3 and 5"),
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
        "phi13", "deg", "crank angle until the output is back at its starting position", "own derivation"
    ),
    "dwell_angle_approximate": Term("1.5 phi12", "deg", "the thesis's approximation of phi13", "thesis (4-17)"),
    "min_transmission_angle": Term("mu_min", "deg", "minimum transmission angle over the turn", "VDI 2142"),
    "gear_gap": Term("s15", "mm", "tips of the crank (input) and the output gear at the closest", "own derivation"),
    "nonuniformity": Term("delta", "1", "(max - min)/mean of the speed ratio", "thesis (4-20)"),
    "tolerance_dwell_angle": Term("phi_tol", "deg", "longest crank angle with the output within +- the tolerance"),
    "dwell_tolerance": Term("tau", "deg", "half of what the output covers in the dwell, +- about its middle"),
    "window_limit": Term("phi_lim", "deg", "longest dwell that these gears reach within the tolerance"),
    "frame_ratio_interval": Term("d_min, d_max", "1", "frame over crank between which window and tolerance are met"),
    "frame_length_interval": Term("AD_min, AD_max", "mm", "frame between which this crank meets window and tolerance"),
    "input_speed": Term("n1", "1/min", "revolutions of the input shaft in a minute"),
    "quartic_k": Term("K", "mm^6", "coefficient of cos^4(beta) for a momentary dwell", "thesis (4-27)"),
    "quartic_l": Term("L", "mm^6", "coefficient of cos^2(beta) for a momentary dwell", "thesis (4-27)"),
    "quartic_m": Term("M", "mm^6", "constant term for a momentary dwell", "thesis (4-27)"),
    "base_angle": Term("beta", "deg", "base angle of the triangle CFE in the standstill", "thesis (4-26)"),
    "pole_angle": Term("alpha", "deg", "angle of the crank to the line of poles in the standstill", "thesis (4-28)"),
    "segment_af": Term("AF", "mm", "input axis to the pole of crank gear and idler", "thesis (4-29)"),
    "segment_fe": Term("FE", "mm", "distance of the two poles", "thesis (4-30)"),
    "segment_eg": Term("EG", "mm", "pole of idler and output gear to the foot of D", "thesis (4-31)"),
    "segment_gd": Term("GD", "mm", "output axis to the line of the poles", "thesis (4-32)"),
    "tolerance_dwell_start": Term("phi_L", "deg", "crank angle at which the longest dwell within the tolerance starts"),
    "acceleration_ratio_max": Term("(e5/w1^2)max", "1", "maximum output acceleration", "thesis (4-25)"),
    "acceleration_ratio_max_at": Term("", "deg", "crank angle of the maximum output acceleration"),
    "acceleration_ratio_min": Term("(e5/w1^2)min", "1", "minimum output acceleration", "thesis (4-25)"),
    "acceleration_ratio_min_at": Term("", "deg", "crank angle of the minimum output acceleration"),
}

REAL_SPEED: dict[str, Term] = {
    "feed_radius": Term("r_F", "mm", "radius at which the output's angle becomes travel of chain, web or belt"),
    "feed_ratio": Term("", "1", "speed of the feed's shaft over that of the output, for a step", "thesis 3.3.2"),
    "feed_teeth": Term("z_F", "1", "teeth of the sprocket that come nearest to a step", "thesis 3.3.2"),
    "uniform_angle": Term("", "deg", "longest crank angle at a nearly even speed", "thesis 4.2.1; own derivation"),
    "uniform_start": Term("", "deg", "crank angle where the even stretch starts"),
    "uniform_ratio": Term("", "1", "level of the speed ratio in that stretch"),
    "lay_speed": Term("v_L", "mm/s", "maximum speed of the sheet on the last way before the lay", "thesis 3.3.2"),
    "lay_angle": Term("", "deg", "crank angle at which the sheet arrives at the lay"),
    "lay_time": Term("", "ms", "time of the last way before the lay"),
    "arrival_speed": Term("", "mm/s", "speed of the sheet when it arrives at the lay"),
    "dwell_pole_line_error": Term("", "mm", "distance of A from the line of P13, P35 in standstills; 0", "thesis 4-9"),
    "feed_per_turn": Term("s_F", "mm", "net travel of what is fed per revolution of the input", "thesis 3.3.2"),
    "feed_back_step": Term("s_12", "mm", "travel back of web, chain or belt in the back-step"),
    "chain_ripple": Term("1-cos(pi/z)", "1", "share by which a chain's speed falls between two teeth"),
    "feed_velocity_max": Term("v_F,max", "mm/s", "maximum velocity of what is fed"),
    "feed_velocity_min": Term("v_F,min", "mm/s", "minimum velocity of what is fed"),
    "feed_velocity_mean": Term("v_F,m", "mm/s", "mean velocity of what is fed"),
    "feed_acceleration_max": Term("a_F,max", "mm/s^2", "maximum acceleration of what is fed"),
    "feed_acceleration_min": Term("a_F,min", "mm/s^2", "minimum acceleration of what is fed"),
    "turn_time": Term("T", "ms", "time of an input turn"),
    "output_speed_max": Term("w5_max", "rad/s", "maximum speed of the output at this input speed"),
    "output_speed_min": Term("w5_min", "rad/s", "minimum speed of the output at this input speed"),
    "output_acceleration_max": Term("e5_max", "rad/s^2", "maximum acceleration of the output at this input speed"),
    "output_acceleration_min": Term("e5_min", "rad/s^2", "minimum acceleration of the output at this input speed"),
    "back_step_time": Term("t12", "ms", "time during which the output turns back"),
    "dwell_time": Term("t_d", "ms", "time during which the output dwells"),
    "tolerance_dwell_time": Term("t_tol", "ms", "time of the longest dwell within the tolerance"),
    "motion_time": Term("t_m", "ms", "time of a motion between two dwells"),
    "driven_speed": Term("w_F", "rad/s", "speed of the driven gear during a motion"),
    "rocker_speed_at_start": Term("w_R0", "rad/s", "speed of the rocker right after the hardest start"),
    "slider_velocity_max": Term("v_max", "mm/s", "maximum velocity of the slider at this input speed"),
    "slider_velocity_min": Term("v_min", "mm/s", "minimum velocity of the slider at this input speed"),
    "slider_acceleration_max": Term("a_max", "mm/s^2", "maximum acceleration of the slider at this input speed"),
    "slider_acceleration_min": Term("a_min", "mm/s^2", "minimum acceleration of the slider at this input speed"),
    "forward_time": Term("t_f", "ms", "time of the slider's stroke away from the crank's axis"),
    "return_time": Term("t_r", "ms", "time of the slider's stroke towards the crank's axis"),
}

SLIDER: dict[str, Term] = {
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
    "return_angle": Term("theta_R", "deg", "input angle of the slider's stroke towards the crank's axis"),
}

CRANK_ROCKER: dict[str, Term] = {
    "outer_dead_center": Term("phi_o", "deg", "crank angle with crank and coupler stretched", "VDI 2130"),
    "inner_dead_center": Term("phi_i", "deg", "crank angle with crank and coupler folded over each other", "VDI 2130"),
    "crank_offset": Term("phi_0", "deg", "angle added to the given crank angles, 0 or 180", "own derivation"),
    "rocker_offset": Term("psi_0", "deg", "angle added to the given rocker angles, 0 or 180", "own derivation"),
    "rocker_speed_max": Term("w3_max", "rad/s", "maximum speed of the rocker at this input speed"),
    "rocker_speed_min": Term("w3_min", "rad/s", "minimum speed of the rocker at this input speed"),
    "rocker_acceleration_max": Term("e3_max", "rad/s^2", "maximum acceleration of the rocker at this input speed"),
    "rocker_acceleration_min": Term("e3_min", "rad/s^2", "minimum acceleration of the rocker at this input speed"),
}


GEAR_PAIR = {
    "working_pressure_angle": Term(
        "alpha_wt", "deg", "angle between line of action and common tangent of the pitch circles", "ISO 21771"
    ),
    "center_distance": Term("a_w", "mm", "distance between the axes of both gears as they run", "ISO 21771"),
    "reference_center_distance": Term("a", "mm", "reference centre distance m(z1+z2)/2", "ISO 21771"),
    "shift_sum": Term("x1+x2", "1", "sum of the profile shift coefficients", "ISO 21771"),
    "center_distance_modification": Term("y", "1", "(a_w - a)/m", "ISO 21771"),
    "tip_shortening": Term("dy", "1", "tip shortening coefficient, shift sum - y", "ISO 21771"),
    "contact_ratio": Term("eps_alpha", "1", "transverse contact ratio (nominal)", "ISO 21771"),
    "profile_shift": Term("x", "1", "profile shift coefficient", "ISO 21771"),
    "reference_radius": Term("r", "mm", "reference radius m z/2", "ISO 21771"),
    "base_radius": Term(
        "r_b",
        "mm",
        "radius of the base circle, of involutes or of a flat-faced cam",
        "ISO 21771",
    ),
    "working_radius": Term("r_w", "mm", "working pitch radius r_b/cos(alpha_wt)", "ISO 21771"),
    "tip_radius": Term("r_a", "mm", "radius of the circle that bounds the teeth at their tips", "ISO 21771"),
    "root_radius": Term("r_f", "mm", "radius of the circle through the bottoms of the tooth spaces", "ISO 21771"),
    "tooth_thickness": Term("s", "mm", "tooth thickness on the reference circle (normal section)", "ISO 21771"),
    "tip_pressure_angle": Term("alpha_a", "deg", "angle between flank and radius at the tip circle", "ISO 21771"),
    "tip_thickness": Term("s_a", "mm", "tooth thickness at the tip", "ISO 21771"),
    "min_shift_no_undercut": Term("x_min", "1", "minimum shift without undercut (rack tool)", "ISO 21771"),
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
    "usable_contact_ratio": Term("eps_use", "1", "transverse contact ratio over what the tools leave of the involutes"),
    "path_of_contact": Term("g_alpha", "mm", "length of the path of contact", "ISO 21771"),
    "form_radius": Term("r_Ff", "mm", "root form radius, where the flank ends", "ISO 21771"),
    "used_root_radius": Term("r_Nf", "mm", "radius at which contact reaches the root (nominal)", "ISO 21771"),
    "tip_clearance": Term("c", "mm", "clearance between the gear's tip and the mating gear's root", "ISO 21771"),
    "specific_sliding_tip": Term("zeta_a", "1", "sliding over rolling velocity of the flank at the tip", "ISO 21771"),
    "sliding_factor": Term("K_g", "1", "sliding over pitch line speed, at A and at E", "ISO 21771"),
    "pin_diameter": Term("D_M", "mm", "measuring ball or pin", "DIN 21773"),
    "measure_over_balls": Term("M_dK", "mm", "measure over two balls, of a ring between them", "DIN 21773"),
    "measure_over_pins": Term("M_dR", "mm", "measure over two pins, of a ring between them", "DIN 21773"),
    "chordal_thickness": Term("s_c", "mm", "chordal tooth thickness on the reference circle", "DIN 21773"),
    "chordal_height": Term("h_c", "mm", "height of the chord of the tooth thickness below the tip", "DIN 21773"),
    "generating_shift": Term("x_E", "1", "generating shift of each gear, minimum and maximum", "DIN 3960"),
    "span_measurement_limits": Term("W_k min, max", "mm", "span measurement of each gear, minimum and maximum"),
    "measure_limits": Term("M_dK min, max", "mm", "measure over balls of each gear, minimum and maximum"),
    "backlash_circumferential": Term("j_wt", "mm", "backlash on the working circles, minimum and maximum", "DIN 3967"),
    "backlash_normal": Term("j_bn", "mm", "backlash between the flanks, minimum and maximum", "DIN 3967"),
    "backlash_angle": Term("j_phi", "deg", "free turn of each gear, minimum and maximum"),
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
        "sigma_H", "N/mm^2", "contact stress; K factors computed with rating, else 1 unless given", "ISO 6336-2"
    ),
    "safety_pitting": Term(
        "S_H", "1", "safety against pitting; factors computed with rating, else 1 unless given", "ISO 6336-2"
    ),
    "root_chord": Term("s_Fn", "mm", "thickness of the root section", "ISO 6336-3"),
    "bending_moment_arm": Term("h_Fe", "mm", "lever of the load above the root section", "ISO 6336-3"),
    "root_fillet_radius": Term("rho_F", "mm", "radius of the fillet at the root section", "ISO 6336-3"),
    "form_factor": Term("Y_F", "1", "influence of the tooth's shape on the nominal root stress", "ISO 6336-3"),
    "stress_correction_factor": Term(
        "Y_S", "1", "influence of the root fillet as a notch on the root stress", "ISO 6336-3"
    ),
    "helix_angle_factor_bending": Term("Y_beta", "1", "helix angle factor of the root", "ISO 6336-3"),
    "rim_factor": Term("Y_B", "1", "rim thickness factor", "ISO 6336-3, IACS UR M56"),
    "deep_tooth_factor": Term("Y_DT", "1", "deep tooth factor of accurate gears", "ISO 6336-3, IACS UR M56"),
    "load_reversal_factor": Term("Y_d", "1", "factor of teeth that are bent both ways, an idler's", "IACS UR M56.3.9"),
    "tip_form_factor": Term("Y_Fa", "1", "form factor for load at the tip (method C)", "ISO 6336-3:1996"),
    "tip_stress_correction_factor": Term(
        "Y_Sa", "1", "stress correction factor for load at the tip (method C)", "ISO 6336-3:1996"
    ),
    "contact_ratio_factor_bending": Term(
        "Y_eps", "1", "contact ratio factor of method C, with Y_Fa and Y_Sa alone", "ISO 6336-3:1996"
    ),
    "nominal_root_stress": Term("sigma_F0", "N/mm^2", "root stress without K factors", "ISO 6336-3"),
    "root_stress": Term(
        "sigma_F", "N/mm^2", "root stress; K factors computed with rating, else 1 unless given", "ISO 6336-3"
    ),
    "safety_bending": Term(
        "S_F",
        "1",
        "safety against breaking at the root; factors computed with rating, else 1 unless given",
        "ISO 6336-3",
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
        "U_H", "1", "damage of the flanks in the required life, at the required safety", "ISO 6336-6"
    ),
    "damage_bending": Term(
        "U_F", "1", "damage of the roots in the required life, at the required safety", "ISO 6336-6"
    ),
    "pitting_life": Term(
        "L_H", "h", "life of the flanks at the required safety; none where nothing damages", "ISO 6336-6"
    ),
    "bending_life": Term(
        "L_F", "h", "life of the roots at the required safety; none where nothing damages", "ISO 6336-6"
    ),
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
    "involute_margin": Term("rho_A1", "mm", "clearance of the ring's tip before the pinion's base tangent point"),
    "radial_assembly_margin": Term(
        "s_rad", "mm", "clearance of a pinion on its way into the ring along the line of centres"
    ),
}
