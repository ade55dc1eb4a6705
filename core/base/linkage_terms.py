"""The words of geared linkages, of motion at real speed and of sliders."""

from __future__ import annotations

from gearlink.core.base.term import Term

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
