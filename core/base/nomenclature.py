"""The words of gearlink: every quantity's symbol, unit, meaning and source; law for code, tables and documents.

Units are those of the design files; inside the engine an angle is in radians. Names follow ISO 21771 (gears) and
VDI 2142/2143 (laws of motion, cams).
"""

from __future__ import annotations

from collections.abc import Collection

from gearlink.core.base.errors import GearlinkError
from gearlink.core.base.terms import (
    CRANK_ROCKER,
    GEAR_LINKAGE,
    GEAR_PAIR,
    MACHINE,
    MOTION_EXTREMES,
    PLANAR,
    REAL_SPEED,
    SHAPED_LAWS,
    SLIDER,
    STEPPING,
)
from gearlink.core.base.terms import Term as Term

_SLIDER_CRANK = {
    "quick_return_ratio": Term(
        "K", "1", "time of the forward over the return stroke; of a crank-rocker of the slow over the fast", "VDI 2142"
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
    "compensation": Term("h0", "mm", "bed displacement made good by the cam in the zone", "TY-460 report 3.3"),
    "min_transmission_angle_bed": Term("mu_ABCD", "deg", "minimum transmission angle of the bed chain", "VDI 2142"),
    "min_transmission_angle_cylinder": Term("mu_GHMN", "deg", "minimum transmission angle of the cylinder chain"),
    "cam_base_radius": Term("r_b", "mm", "cam axis to roller centre at zero lift, given or chosen by size"),
    "end_slope": Term("k1", "mm/rad", "slope of the lift at the end of the zone", "TY-460 report 3.3, repaired"),
    "transition_rise": Term("dx", "mm", "rise over the transition", "TY-460 report 3.3"),
    "follower_stroke": Term("h", "mm", "largest less smallest lift over a revolution", "TY-460 report 3.3"),
    "return_end": Term("theta_r", "deg", "cam angle at which the return ends"),
    "roller_center_distance": Term("L_s1s2", "mm", "distance of the two roller centres", "TY-460 report 3.6"),
}

_CAM = {
    "max_pressure_angle": Term(
        "alpha_max", "deg", "maximum pressure angle of the main cam (a list: main, return cam)", "VDI 2142"
    ),
    "min_curvature_radius": Term(
        "rho_min", "mm", "minimum convex radius of the main cam's pitch curve (a list: main, return cam)", "VDI 2142"
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
    "prime_radius": Term("r_p", "mm", "cam axis to roller centre at lift 0, given or the minimum", "VDI 2142"),
    "offset": Term(
        "e",
        "mm",
        "distance of the line of travel from the axis of crank or cam; of a cam positive where it passes on the right",
    ),
    "start_angle": Term("Psi_0", "deg", "angle of the follower from the line pivot to cam axis at lift 0"),
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
    "pressure_angle_outside": Term("alpha_a", "deg", "maximum pressure angle at the outside of a drum"),
    "least_wall_factor": Term(
        "", "1", "minimum factor of the walls of a drum's track, regular above 0", "own derivation"
    ),
    "min_concave_radius": Term("rho_c", "mm", "minimum radius of the concave flanks of the profile", "VDI 2142"),
    "contact_place_max": Term("t_max", "mm", "maximum position of the contact along a flat face", "own derivation"),
    "contact_place_min": Term("t_min", "mm", "minimum position of the contact along a flat face", "own derivation"),
    "face_length": Term("t_max - t_min", "mm", "length of a flat face that the contact takes", "own derivation"),
    "spring_preload": Term("F_0", "N", "force of the spring at lift 0, given or the minimum (oscillating: N m)"),
    "lift_error_worst": Term("", "mm", "maximum sum of the lift's errors (oscillating: deg)", "own derivation"),
    "lift_error_rss": Term("", "mm", "maximum root of the sum of their squares (oscillating: deg)", "own derivation"),
    "acceleration_error": Term("", "mm/s^2", "acceleration that the waves of the profile make", "own derivation"),
    "face_width_needed": Term("b", "mm", "width that keeps the allowed contact pressure", "Hertz, line contact"),
    "servo_rows": Term("", "1", "rows of the table of a servo drive, both ends"),
    "servo_error": Term("", "mm", "maximum error of position between the rows (oscillating: deg)", "own derivation"),
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
    "return_angle": Term("D_r", "deg", "angle of the input in the return", "swing-gripper paper 2"),
    "near_dwell_angle": Term("", "deg", "angle of the input in the near dwell", "swing-gripper paper 2"),
    "handover_angle": Term("theta_A", "deg", "cylinder angle of the handover", "swing-gripper paper 2"),
    "finger_lift": Term("", "mm", "way of the finger tips where the release window ends"),
    "fit_harmonics": Term("H", "1", "harmonics of the series through a measured profile"),
    "fit_rms": Term("", "mm", "root of the mean square by which a measured profile misses its series"),
    "fit_max": Term("", "mm", "maximum distance by which a measured profile misses its series"),
    "stop_force": Term("F_st", "N", "force of the spring on the stop in the near dwell"),
    "stop_force_max": Term("", "N", "maximum force on the stop in the impact of the return"),
    "stop_angle": Term("beta_s", "deg", "swing of the arm where it rests on the stop"),
    "stop_tip_offset": Term(
        "", "mm", "way of the gripper tip from the pick-up position of the law to the rest on the stop"
    ),
    "stop_impact_angle": Term("theta_s", "deg", "cylinder angle at which the return meets the stop"),
    "stop_impact_speed": Term("", "mm/s", "speed with which the arm meets the stop"),
    "take_off_angle": Term("theta_t", "deg", "cylinder angle at which the cam takes the arm off the stop"),
    "take_off_speed": Term("", "mm/s", "speed at the stop's radius where the cam takes the arm off it"),
    "stop_mass": Term("m_s", "kg", "cam rocker, coupler and gripper as a mass at the stop"),
    "settling_time": Term("", "ms", "time of the rebounds on the stop"),
    "settling_angle": Term("", "deg", "cylinder angle of the rebounds on the stop"),
    "total_swing": Term("beta_T", "deg", "total swing of the gripper arm", "swing-gripper paper 2"),
    "spring_torque": Term("T_s,min", "N m", "minimum spring torque that keeps both rollers on their cams"),
    "newton_iterations": Term("", "1", "most Newton-Raphson steps at any position of the turn"),
    "newton_agreement": Term("", "deg", "largest difference of closed form and Newton-Raphson", "own derivation"),
    "condition_number": Term("1/sin(mu)", "1", "largest condition number of the loop over the swing"),
    "handover_center": Term("O_t", "mm", "cylinder axis whose pitch circle the tip meets on the line of centres"),
    "cam_center": Term("O", "mm", "cam axis in the machine's frame"),
    "closing_torque": Term("T_s", "N m", "torque of the closing spring on each rocker", "own derivation"),
    "lift_off_speed": Term("n*", "sheets/h", "speed at which a roller leaves its cam", "own derivation"),
}

_SWING = {
    "energy_parameter": Term("N", "1", "energy parameter of the unloader", "wide-swing dissertation (6), (11)"),
    "velocity_peak": Term("B", "1", "peak of the velocity invariant", "wide-swing dissertation (8), (13)"),
    "acceleration_peak": Term("C", "1", "peak of the acceleration invariant", "wide-swing dissertation (10), (15)"),
    "min_pivot_ratio": Term(
        "lambda_min", "1", "minimum pivot ratio that lets the device turn", "dissertation (3), (4)"
    ),
    "force": Term("P", "N", "force of the pneumatic device, with its reserve", "wide-swing dissertation (6)"),
    "spring_rate": Term("c_s", "N/mm", "rate of the spring, with its reserve", "wide-swing dissertation (11)"),
    "base_distance": Term("a_d", "mm", "base pin of the device from the rocker's axis", "wide-swing dissertation (3)"),
    "device_length_min": Term("l_min", "mm", "length of the device between its pins at mid-swing", "own derivation"),
    "device_length_max": Term("l_max", "mm", "length of the device at the ends of the swing", "own derivation"),
    "device_stroke": Term("S", "mm", "stroke of the device, from mid-swing to an end", "wide-swing dissertation (2)"),
    "force_max": Term("F_d,max", "N", "maximum force of the device", "own derivation"),
    "force_min": Term("F_d,min", "N", "force of the spring at mid-swing", "own derivation"),
    "stored_energy": Term("E", "J", "energy that the device takes up from mid-swing to an end", "dissertation (2)"),
    "balanced_speed": Term(
        "n_bal", "1/min", "speed at which the device balances the inertia", "dissertation (6), (11)"
    ),
    "reserve": Term("rho", "1", "force of the device over the balancing one, less 1", "own derivation"),
    "bore": Term("d", "mm", "bore of the cylinder that the force needs at its pressure", "own derivation"),
    "standard_bore": Term("d_s", "mm", "next standard bore", "ISO 6432, ISO 15552"),
    "set_pressure": Term("p_s", "N/mm^2", "gauge pressure that gives the force in the bore that is built"),
    "force_variation": Term("", "1", "rise of the cylinder's force over its stroke, closed volume", "isentropic, 1.4"),
    "mounting_stretch": Term("S_0", "mm", "stretch of the spring at mid-swing", "wide-swing dissertation (11)"),
    "stretch_max": Term("S_0 + S", "mm", "stretch of the spring at the ends of the swing", "own derivation"),
    "free_length": Term("l_f", "mm", "spring between its pins where its force is zero", "own derivation"),
    "mass": Term("m", "kg", "mass of the pendulum that swings the rocker", "own derivation"),
    "max_distance": Term("s_max", "mm", "distance from which on a pendulum is too slow", "own derivation"),
    "rocker_radius": Term("r", "mm", "rocker radius to the roller", "wide-swing dissertation (18), (24)"),
    "profile_correction": Term("xi", "deg", "angular correction of the profile at the end", "dissertation (19), (25)"),
    "phase_angle": Term("Phi", "deg", "phase angle of the run-up on the cam", "dissertation (21), (22), (25)"),
    "start_curvature_radius": Term("R0", "mm", "pitch curvature radius at the start", "dissertation (23), exact"),
    "iteration_energy_parameter": Term("N_it", "1", "N by the source's own iteration", "dissertation fig. 4"),
    "iteration_passes": Term("", "1", "passes of the source's own iteration"),
    "iteration_error": Term("N_it/N - 1", "1", "relative error of the energy parameter by the source's own iteration"),
    "transition_zone": Term("dk", "1", "half-width of the contact change at mid-swing", "own derivation"),
    "zero_end_swing": Term("", "deg", "swing without pressure angle at its ends, 2 acos(r/a)", "dissertation ch. 3"),
    "largest_profile_correction": Term("xi_max", "deg", "largest angular correction of the stroke", "own derivation"),
    "start_radius_estimate": Term("R0*", "mm", "the source's estimate of R0", "dissertation (23)"),
    "middle_radius_estimate": Term("Rm*", "mm", "the source's estimate of R at mid-swing", "dissertation (27)"),
    "contact_end": Term("k_c", "1", "fraction of the stroke at which the roller leaves the profile", "own derivation"),
    "contact_force": Term("F", "N", "maximum force of a roller on its cam at the design speed", "own derivation"),
    "line_of_centers_place": Term("k*", "1", "fraction of the stroke at which the roller passes the line of centres"),
    "roller_arm_offset": Term(
        "phi*", "deg", "rocker angle from mid-swing at which the roller passes the line of centres", "own derivation"
    ),
    "impact_speed": Term("v_i", "mm/s", "speed of the roller's blow on the other flank", "own derivation"),
    "impact_place": Term("k_i", "1", "fraction of the stroke at the blow on the other flank", "own derivation"),
    "impact_energy": Term("E_i", "J", "energy of the blow on the other flank", "own derivation"),
    "impact_force": Term("F_i", "N", "peak force of the blow on the other flank", "own derivation"),
    "end_position_gain": Term(
        "G_e",
        "1",
        "way at the output radius in the rests, per mm of the profile",
        "own derivation",
    ),
    "shaft_distance": Term("O1O2", "mm", "distance of two parallel cam shafts", "dissertation figure 2"),
    "roller_arm_angle": Term("psi", "deg", "angle between the arms of the two rollers", "dissertation figure 2"),
    "cam_gap": Term("", "mm", "clearance between the circles of two cams on parallel shafts", "own derivation"),
    "cam_shaft_gap": Term("", "mm", "minimum clearance between a cam and the shaft of the other", "own derivation"),
    "dwell_force": Term("F_d", "N", "maximum force of a roller on its cam during the rests", "own derivation"),
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
        "force of the device in reserve in the longer stroke, as a share of what balances it there: "
        "(1 + rho)(longer/shorter)^2 - 1",
        "own derivation",
    ),
    "structural_error": Term("", "deg", "maximum error of the function over its interval", "own derivation"),
    "structural_error_at": Term("", "deg", "input angles at which the error of the function is largest"),
    "error_extremes": Term(
        "", "1", "alternating extremes of the structural error, all of one size; the best five-bars have eight"
    ),
    "function_start": Term("phi0", "deg", "input angle at which the function starts", "own derivation"),
    "output_zero": Term("psi0", "deg", "output angle at which the function starts", "own derivation"),
    "starts_tried": Term("", "1", "starts that the search went through in its budget"),
    "first_point_angle": Term("phi_1", "deg", "input angle of the first of the timed points", "own derivation"),
    "power_peak": Term("max(b c)", "1", "peak of the power invariant", "own derivation"),
    "drive_torque_peak": Term("M_dr", "N m", "torque of the cam shaft without device and linkage_share", "chapter 5"),
    "dynamic_coefficient": Term("K_d", "1", "torque with the drive's elasticity over the calculated one", "chapter 5"),
    "drive_balancing_ratio": Term("K_y2", "1", "torque of the cam shaft without over with the device", "chapter 5"),
    "slider_stroke": Term("H", "mm", "travel of the slider over the swing", "dissertation (16), (17)"),
    "reference_inertia": Term("J_ref", "kg m^2", "inertia in the energy parameter, J + m H^2/gamma^2"),
    "rocker_share": Term("j0", "1", "the rocker's own share in J_ref", "own derivation"),
    "middle_place": Term("k_mid", "1", "fraction of the stroke at which the rocker passes mid-swing", "own derivation"),
    "slider_velocity_peak": Term("B_s", "1", "peak of the slider's velocity invariant", "dissertation (16), (17)"),
    "slider_acceleration_peak": Term("C_s", "1", "peak of the slider's acceleration invariant", "own derivation"),
    "crank_span": Term("phi_k", "deg", "crank angle between the dead centres of the cam's drive", "own derivation"),
    "cam_swing": Term("chi", "deg", "swing of an oscillating cam", "dissertation, chapter 4"),
    "middle_pressure_angle": Term("alpha_m", "deg", "pressure angle that an oscillating cam keeps at mid-swing"),
}

_MOBILITY = {
    "link_count": Term("n", "1", "links, the frame among them"),
    "linkage_mobility": Term("F0", "1", "degrees of freedom of the linkage alone", "thesis 2.1"),
    "train_count": Term("", "1", "gear trains"),
    "fixed_ends": Term("R", "1", "end gears fixed to a link, per train", "thesis 2.1"),
    "mobility_changes": Term("dF", "1", "degrees of freedom added by each train, 1 - R", "thesis 2.1"),
    "mobility": Term("F", "1", "degrees of freedom of the whole", "thesis 2.1"),
}

_MUTILATED = {
    "reduction": Term("i_r", "1", "input revolutions per revolution of the mutilated wheel"),
    "full_teeth": Term("Z_M", "1", "maximum number of teeth on the intermittent gear"),
    "group_teeth": Term("n", "1", "neighbouring teeth of the mutilated wheel between two gaps"),
    "driven_teeth": Term("Z_F", "1", "teeth of the driven gear"),
    "stops": Term("", "1", "locking arcs round the driven gear"),
    "cycle_turns": Term("i_r/g", "1", "input revolutions per output cycle", "own derivation"),
    "motion_turns": Term("", "1", "input turns while the driven gear turns", "own derivation"),
    "dwell_turns": Term("", "1", "input revolutions during which the driven gear dwells", "own derivation"),
    "motion_share": Term("t_m/T", "1", "share of the cycle in motion", "own derivation"),
    "dwell_share": Term("1 - n g/Z_M", "1", "share of the cycle at rest", "own derivation"),
    "driven_turn": Term("n/Z_F", "1", "turns of the driven gear per group of teeth", "own derivation"),
    "driven_speed_ratio": Term("Z_M/(Z_F i_r)", "1", "driven speed over input speed in motion", "own derivation"),
    "cycles_to_repeat": Term("", "1", "cycles until the driven gear is at the same position again"),
    "start_crank_angle": Term("phi_0", "deg", "crank angle of the dwell"),
    "rocker_swing": Term("", "deg", "angle between the limit positions of the rocker"),
    "rocker_start_speed": Term("", "1", "rocker speed over input speed right after the hardest start"),
    "tip_fouling_margin": Term("", "mm", "clearance between the tips of planet and ring gear", "own derivation"),
}

_PLANET_LINKAGE = {
    "planet_teeth": Term("z2", "1", "teeth of the gear that rolls on the central one"),
    "coupler_gear_teeth": Term("z2", "1", "teeth of the gear fixed to the coupler"),
    "gear_ratio": Term("i", "1", "-z2/z5 for an external mesh, z2/z5 in a ring gear", "thesis 2.2.1"),
    "linkage_kind": Term("", "1", "class of the linkage by Grashof's rule"),
    "speed_ratio_max_at": Term("", "deg", "crank angle of the maximum output speed"),
    "speed_ratio_min_at": Term("", "deg", "crank angle of the minimum output speed"),
    "coupler_ratio_max": Term("(w2/w1)max", "1", "maximum coupler speed per crank speed", "thesis 2.2.1"),
    "coupler_ratio_min": Term("(w2/w1)min", "1", "minimum coupler speed per crank speed", "thesis 2.2.1"),
    "standstill_coupler_ratio": Term("1 - 1/i", "1", "w2/w1 at zero output velocity", "thesis 2.2.1"),
    "dwell_teeth_ratio": Term("(z5/z2)max", "1", "maximum z5/z2 with which these links stop the output"),
    "output_swing": Term("", "deg", "swing of the output between its own extremes", "own derivation"),
    "swing_multiple": Term("", "1", "output swing over rocker swing", "thesis figure 2-4"),
    "naive_multiple": Term("1 + z2/z5", "1", "multiple 1 + z2/z5, without the rotation of the coupler"),
    "extreme_crank_angles": Term("", "deg", "crank angles at which the output reverses", "own derivation"),
    "swing_residual": Term("", "deg", "swing reached less required swing"),
}

_HYPOCYCLOID = {
    "cusps": Term("n", "1", "cusps of the curve, ring teeth over planet teeth", "thesis figure 2-5"),
    "ring_teeth": Term("z_r", "1", "teeth of the ring gear"),
    "carrier_length": Term("", "mm", "carrier, the centre distance of planet and ring gear"),
    "point_radius": Term("r", "mm", "pitch radius of the planet, on which the point lies"),
    "rod_length": Term("L", "mm", "rod to the slider"),
    "tangent_circle_length": Term("", "mm", "rod of the circle through ends and middle of the dwell", "own derivation"),
    "osculating_length": Term("4 r (n-1)/(n-2)", "mm", "rod of the circle of curvature in mid-dwell"),
    "dwell_carrier_angle": Term("", "deg", "required carrier angle of the dwell"),
    "dwell_ripple": Term("", "mm", "range of the slider's position in the dwell", "own derivation"),
    "dwell_deviation_min": Term("", "mm", "minimum deviation from the position in mid-dwell, inwards positive"),
    "dwell_deviation_max": Term("", "mm", "maximum deviation from the position in mid-dwell, inwards positive"),
    "tolerance_carrier_angle": Term("", "deg", "widest carrier angle with the slider within +- the tolerance"),
    "stroke": Term("S", "mm", "stroke of the slider"),
    "ripple_share": Term("", "1", "ripple over stroke"),
}

_FIVE_BAR = {
    "form": Term("", "1", "path of a coupler point, or output as a function of the input"),
    "five_bar_ratio": Term("k", "1", "output over input speed of the gears", "thesis figure 2-1"),
    "coupler_ratio": Term("m", "1", "coupler over input speed, 1 + z5/z2 or 1 - z5/z2", "thesis figure 2-7, a reading"),
    "period_turns": Term("q", "1", "input turns until everything repeats", "own derivation"),
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
    "span_min": Term("", "mm", "minimum distance that the dyad spans", "own derivation"),
    "span_min_at": Term("", "deg", "input angle of the minimum span"),
    "span_max": Term("", "mm", "maximum distance that the dyad spans", "own derivation"),
    "span_max_at": Term("", "deg", "input angle of the maximum span"),
    "min_transmission_angle_at": Term("", "deg", "input angle of the minimum transmission angle"),
    "path_width": Term("", "mm", "extent of the path along the frame"),
    "path_height": Term("", "mm", "extent of the path across the frame"),
    "phase_step": Term("360/z4", "deg", "step in which the phase can be set a tooth on"),
    "path_deviation_rms": Term("", "mm", "root mean square of the distances of the table deviations"),
    "path_deviation_max": Term("", "mm", "maximum distance of the table deviations"),
    "position_errors": Term("", "deg", "output angle reached less required output angle, at each position"),
}

_STUDY = {
    "designs": Term("N", "1", "designs of a study that were computed"),
    "refused": Term("", "1", "designs of a study without a mechanism, or without one of the objectives"),
    "feasible": Term("", "1", "designs of a study that satisfy all checks and conditions"),
    "front_size": Term("", "1", "designs that no other one dominates, equal ones all counted"),
    "kept": Term("", "1", "boxes of the resolution that hold the front, one design each"),
    "shown": Term("", "1", "kept designs that a terminal shows, at most 50"),
    "exhaustive": Term("", "1", "true where all designs were computed, so that the front is exact"),
    "knee": Term("", "1", "index of the kept design with the minimum sum of objectives, each scaled from 0 to 1"),
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
        "",
        "mm",
        "register error where all sources add up, each at its greater limit, for torque sign +1 and -1",
    ),
    "rss": Term("", "mm", "standard deviation of the register error, for torque sign +1 and -1"),
    "band": Term("", "mm", "register error to either side that 99.73 % keep, for torque sign +1 and -1"),
    "dead_band": Term("", "mm", "jump of the output where its torque turns: backlash of the meshes"),
    "flips": Term("", "deg", "input angles at which the torque on the output turns"),
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
    "reflected_inertia_min": Term("J_min", "kg m^2", "minimum inertia of all links as the input feels it"),
    "reflected_inertia_max": Term("J_max", "kg m^2", "maximum inertia of all links as the input feels it"),
    "reflected_inertia_mean": Term("J_m", "kg m^2", "mean over the input angle of the reflected inertia"),
    "torque_reversals": Term("", "1", "changes of sign of the input torque over the period"),
    "energy_fluctuation": Term(
        "dW", "J", "maximum less minimum surplus of a constant drive torque over the load, without masses"
    ),
    "flywheel_inertia": Term("J_F", "kg m^2", "flywheel at the input for the allowed fluctuation of its speed"),
    "speed_min": Term("n_min", "1/min", "minimum speed of the input with its flywheel or motor"),
    "speed_max": Term("n_max", "1/min", "maximum speed of the input with its flywheel or motor"),
    "speed_fluctuation": Term("delta", "1", "(maximum - minimum)/mean speed of the input, the mean half their sum"),
    "motor_torque_rms": Term("M_mot", "N m", "root mean square over the time of the motor's torque"),
    "motor_torque_peak": Term("M_mot,max", "N m", "maximum torque of the motor; negative where the load drives it"),
    "shaking_force_max": Term("F_s", "N", "maximum force of the moving masses on the frame"),
    "shaking_moment_max": Term("M_s", "N m", "maximum moment of the moving masses about the input's pivot"),
    "peak": Term("F_max", "N", "maximum force of a pin over the period"),
    "equivalent": Term("P", "N", "equivalent load of a pin over its relative turning, exponent 3 or 10/3", "ISO 281"),
    "travel": Term("", "1", "relative turns of a pin per input turn, both senses counted"),
    "life": Term("L_10", "h", "basic rating life of a pin's bearing", "ISO 281"),
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
    "traction_needed": Term("mu_r", "1", "maximum share of the contact force that drives the roller round"),
    "entrainment_speed_max": Term("u", "mm/s", "maximum speed of both surfaces through the contact of roller and cam"),
    "cam_torque_max": Term("M_cam", "N m", "maximum torque on the cams about their axis, counter-clockwise"),
    "cam_torque_min": Term("M_cam,min", "N m", "minimum torque on the cams about their axis, counter-clockwise"),
    "cam_torque_rms": Term("M_cam,rms", "N m", "root mean square of the torque on the cams"),
    "preload_needed": Term("P_min", "N", "minimum preload that keeps both rollers of a positive drive on their cams"),
    "natural_frequency": Term("f_n", "Hz", "natural frequency of the output on its drive"),
    "frequency_ratio": Term("f_n/f", "1", "natural frequency of the output over the frequency of the input"),
    "rise_periods": Term("n_T", "1", "natural periods in the shortest motion between two dwells", "T_1 f_n"),
    "residual_amplitude": Term("A", "deg", "vibration that a motion leaves in the dwell after it"),
    "residual_speed_limit": Term("n_A", "1/min", "lowest speed at which the residual vibration passes what is allowed"),
    "dwell_twist": Term("z_max", "deg", "maximum deflection of the output in its dwells, steady state"),
    "twisted_ripple": Term("D_z", "deg", "range of the output with its deflection in a dwell"),
    "tooth_force_max": Term("F_t", "N", "maximum tangential force of a mesh"),
    "reversals": Term("", "1", "changes of flank of a mesh over the period"),
    "axial_force_max": Term("F_a", "N", "maximum axial force of helical teeth, F_t tan(beta_w)"),
    "tilting_moment_max": Term("M_t", "N m", "maximum moment F_a r_w of the axial force on gear 1 and gear 2"),
    "engagement_energy": Term("E", "J", "energy that the hardest start of a mutilated gear's motion costs"),
    "massless": Term("", "1", "links without mass and inertia in the file, counted as having none"),
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


def term(name: str) -> Term:
    """The entry of a quantity; in a name that carries its mesh, `crank_idler.contact_ratio`, the last part counts.

    Raises
        GearlinkError - for a name without an entry
    """
    try:
        return TERMS[name.rpartition(".")[2]]
    except KeyError:
        raise GearlinkError(f"no nomenclature entry for {name!r}") from None
