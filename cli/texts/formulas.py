"""The formula of each quantity of `gearlink.core.nomenclature`, in its symbols, for `gearlink explain QUANTITY`.

Where a name serves several kinds of design, each has its line. Names without an entry are inputs or counts.
"""

from __future__ import annotations

_GEAR_LINKAGE = {
    "i3": "i3 = -z3/z5",
    "frame_ratio": "d = l4/l1; back-step: d = s cos(h) + sqrt(s^2 cos^2(h) + 1), s = sqrt(i3 (i3 - 2)), h = phi12/2; "
    "speed band: d = q + sqrt(q^2 - 1), q = 2 (1 - i3)/delta",
    "crank_length": "three gears, I = 1: l1 = l2/sqrt((1 + d^2)/2); "
    "slider-crank and press: r = (S/2) sqrt((4 L^2 - 4 e^2 - S^2)/(4 L^2 - S^2)), S slider stroke, L rod, e offset",
    "coupler_length": "l2 = m (z1 + z3)/2",
    "rocker_length": "l3 = m (z3 + z5)/2",
    "frame_length": "I = 1: l4 = d l1; momentary dwell: l4^2 = r5^2 + (r1^2 - e^2) {[(sqrt(r3 c) + sqrt(b (b + r5)))"
    "/r1]^2 - 1}, b = r1 + r3, c = r3 + r5",
    "mean_ratio": "I = z1/z5 for a crank-rocker, 1 for a drag link",
    "speed_ratio_max": "greatest of W = w5/w1 = I + (1 - i2) i3 w2/w1 + (1 - i3) w3/w1; for I = 1 it is "
    "1 + 2 (1 - i3) d/(d^2 + 1)",
    "speed_ratio_min": "least of W = w5/w1 = I + (1 - i2) i3 w2/w1 + (1 - i3) w3/w1; for I = 1 it is "
    "1 - 2 (1 - i3) d/(d^2 + 1)",
    "motion": "no zero of the output speed: unidirectional; one: momentary-dwell; two: back-step",
    "dwell_crank_angles": "W(phi) = 0; for I = 1: phi(1), phi(2) = 270 deg -+ phi12/2",
    "back_step_angle": "|phi5(2) - phi5(1)|; for I = 1: 2 n atan(tan(h)/n) - 2 h, n = 1 - i3, h = phi12/2",
    "back_step_crank_angle": "phi12 = phi(2) - phi(1); for I = 1: cos(phi12/2) = (d^2 - 1)/(2 d sqrt(i3 (i3 - 2)))",
    "dwell_angle": "phi5(phi(1) + phi13) = phi5(phi(1)), solved exactly",
    "dwell_angle_approximate": "1.5 phi12",
    "min_transmission_angle": "mu = min(gamma, 180 deg - gamma), cos(gamma) = (l2^2 + l3^2 - n^2)/(2 l2 l3), n the "
    "diagonal from the crank pin; the least over the turn",
    "gear_gap": "s15 = |l4 - l1| - m (z1 + z5)/2 - 2 m; geared five-bar with an idler: AE - m (z1 + z4)/2 - 2 m",
    "nonuniformity": "delta = (Wmax - Wmin)/I",
    "tolerance_dwell_angle": "phi5(R) - phi5(L) = 2 tol and W(L) = W(R); with a back-step D > 2 tol: phi5(L) = phi5(R)",
    "tolerance_dwell_start": "L of the tolerance dwell",
    "acceleration_ratio_max": "greatest of e5/w1^2 = (1 - i2) i3 e2/w1^2 + (1 - i3) e3/w1^2; for I = 1 it is "
    "2 (1 - i3) d/(d^2 - 1)",
    "acceleration_ratio_min": "least of e5/w1^2 = (1 - i2) i3 e2/w1^2 + (1 - i3) e3/w1^2; for I = 1 it is "
    "-2 (1 - i3) d/(d^2 - 1)",
}

_GEAR_PAIR = {
    "working_pressure_angle": "cos(alpha_wt) = a cos(alpha_t)/a_w, or inv(alpha_wt) = inv(alpha_t) + 2 tan(alpha) "
    "(x1 + x2)/(z1 + z2)",
    "center_distance": "a_w = a + y m = a cos(alpha_t)/cos(alpha_wt)",
    "reference_center_distance": "a = m (z1 + z2)/(2 cos(beta)), z2 < 0 for a ring",
    "shift_sum": "x1 + x2 = (z1 + z2) (inv(alpha_wt) - inv(alpha_t))/(2 tan(alpha))",
    "center_distance_modification": "y = (a_w - a)/m",
    "tip_shortening": "dy = -k; full: x1 + x2 - y",
    "contact_ratio": "eps_alpha = (z1 (tan(alpha_a1) - tan(alpha_wt)) + z2 (tan(alpha_a2) - tan(alpha_wt)))/(2 pi)",
    "profile_shift": "given, or x1 = x2 = (x1 + x2)/2, or as shift_split says",
    "reference_radius": "r = m z/(2 cos(beta))",
    "base_radius": "r_b = r cos(alpha_t)",
    "working_radius": "r_w = a_w z/(z1 + z2) = r_b/cos(alpha_wt)",
    "tip_radius": "r_a = r + (h_a* + x + k) m",
    "root_radius": "r_f = r - (h_fP* - x) m, h_fP* of the tool, else h_a* + c*",
    "tooth_thickness": "s = m (pi/2 + 2 x tan(alpha))",
    "tip_pressure_angle": "cos(alpha_a) = r_b/r_a",
    "tip_thickness": "s_a = r_a (s/(r cos(beta)) - 2 (inv(alpha_a) - inv(alpha_t))) cos(beta_a)",
    "min_shift_no_undercut": "x_min = h - z sin^2(alpha_t)/(2 cos(beta)), h = h_a*, or h_fP* - rho* (1 - sin(alpha)) "
    "of a tool",
    "span_measurement": "W_k = m cos(alpha) (pi (k - 1/2) + z inv(alpha_t)) + 2 x m sin(alpha)",
    "span_teeth": "k for which |sqrt(r_b^2 + (W_k cos(beta_b)/2)^2) - (r + x m)| is least",
    "specific_sliding": "zeta = 1 - (w_mate rho_mate)/(w rho), contact at the mate's tip",
    "transverse_pressure_angle": "tan(alpha_t) = tan(alpha)/cos(beta)",
    "base_helix_angle": "sin(beta_b) = sin(beta) cos(alpha)",
    "overlap_ratio": "eps_beta = b sin(beta)/(pi m), b the lesser width",
    "total_contact_ratio": "eps_gamma = eps_alpha + eps_beta",
    "usable_contact_ratio": "eps_alpha less what lies below the form radii, over p_et",
    "path_of_contact": "g_alpha = rho_E1 - rho_A1 = eps_alpha p_et",
    "form_radius": "r_Ff^2 = r_b^2 + (r sin(alpha_t) - h_Ff m/sin(alpha_t))^2, h_Ff = h_fP* - rho* (1 - sin(alpha)) - "
    "x; with undercut or protuberance: where fillet and involute cross",
    "used_root_radius": "r_Nf1^2 = r_b1^2 + rho_A1^2, rho_A1 = a_w sin(alpha_wt) - sqrt(r_a2^2 - r_b2^2)",
    "tip_clearance": "c_1 = a_w - r_a1 - r_f2, c_2 = a_w - r_f1 - r_a2",
    "specific_sliding_tip": "zeta_E1 = 1 - rho_E2/(u rho_E1), zeta_A2 = 1 - u rho_A1/rho_A2",
    "sliding_factor": "K_gA = (rho_C1 - rho_A1) (1 + 1/u)/r_w1, K_gE = (rho_E1 - rho_C1) (1 + 1/u)/r_w1",
    "pin_diameter": "given, or the preferred size whose contact lies nearest to the circle r + x m",
    "measure_over_balls": "M = 2 r_K + D (odd z: 2 r_K cos(pi/(2 z)) + D; ring: 2 r_K (cos ..) - D), r_K = "
    "r_b/cos(alpha_K), inv(alpha_K) = D/(z m cos(alpha)) - (pi/2 - 2 x tan(alpha))/z + inv(alpha_t)",
    "measure_over_pins": "as over balls; helical with odd z: 2 r_K + D",
    "chordal_thickness": "s_c = d_n sin(s/d_n), d_n = d/cos^2(beta)",
    "chordal_height": "h_c = r_a - r + d_n/2 (1 - cos(s/d_n))",
    "generating_shift": "x_E = x + E_sn/(2 m tan(alpha))",
    "span_measurement_limits": "W_k with the two x_E",
    "measure_limits": "M with the two x_E",
    "backlash_circumferential": "j_wt = 2 r_w1/z1 ((z1 + z2)(inv(alpha_w) - inv(alpha_t)) - 2 (x1 + x2) tan(alpha)) - "
    "(E1 + E2) r_w1/(r_1 cos(beta)), at both limits of the centre distance",
    "backlash_normal": "j_bn = j_wt cos(alpha_w) cos(beta_b)",
    "backlash_angle": "j_wt/r_w",
    "tangential_force": "F_t = 2000 T1/d1",
    "zone_factor": "Z_H = sqrt(2 cos(beta_b) cos(alpha_wt)/(cos^2(alpha_t) sin(alpha_wt)))",
    "elasticity_factor": "Z_E = (pi ((1 - nu1^2)/E1 + (1 - nu2^2)/E2))^(-1/2)",
    "contact_ratio_factor": "Z_eps^2 = (4 - eps_alpha)/3 (1 - eps_beta) + eps_beta/eps_alpha, eps_beta <= 1",
    "helix_angle_factor_contact": "Z_beta = 1/sqrt(cos(beta))",
    "single_contact_factor": "M1^2 = rho_C1 rho_C2/(rho_B1 rho_B2), M2 at D; max(1, M - eps_beta (M - 1))",
    "nominal_contact_stress": "sigma_H0 = Z_H Z_E Z_eps Z_beta sqrt(F_t/(d1 b) (u + 1)/u)",
    "contact_stress": "sigma_H = Z_B,D sigma_H0 sqrt(K_A K_v K_Hb K_Ha)",
    "safety_pitting": "S_H = sigma_Hlim Z_N (Z_L Z_v Z_R Z_W Z_X)/sigma_H",
    "root_chord": "s_Fn/m = z_n sin(60 deg - theta) + sqrt(3) (G/cos(theta) - rho*), G = rho* - h_fP* + x_E; "
    "ring: 30 deg, 1",
    "bending_moment_arm": "2 h_Fe/m = z_n cos(alpha)/cos(alpha_Fen) - z_n cos(60 deg - theta) - (G/cos(theta) - rho*)",
    "root_fillet_radius": "rho_F/m = rho* + 2 G^2/(cos(theta) (z_n cos^2(theta) - 2 G))",
    "form_factor": "Y_F = 6 (h_Fe/m) cos(alpha_Fen)/((s_Fn/m)^2 cos(alpha))",
    "stress_correction_factor": "Y_S = (1.2 + 0.13 L) q_s^(1/(1.21 + 2.3/L)), L = s_Fn/h_Fe, q_s = s_Fn/(2 rho_F)",
    "helix_angle_factor_bending": "Y_beta = 1 - eps_beta beta/120 deg, eps_beta <= 1, beta <= 30 deg",
    "rim_factor": "1 from s_R = 1.2 h_t on, 1.6 ln(2.242 h_t/s_R) above 0.5 h_t; of a ring 1 from 3.5 m on, "
    "1.15 ln(8.324 m/s_R) above 1.75 m; none below",
    "deep_tooth_factor": "grade 4 or better: 2.366 - 0.666 eps_alpha,n from 2.05 to 2.5, 0.7 beyond; else 1",
    "tip_form_factor": "as Y_F, the load at d_an",
    "tip_stress_correction_factor": "as Y_S, the load at d_an",
    "contact_ratio_factor_bending": "Y_eps = 0.25 + 0.75/eps_alpha,n",
    "nominal_root_stress": "sigma_F0 = F_t/(b m) Y_F Y_S Y_beta Y_B Y_DT",
    "root_stress": "sigma_F = sigma_F0 K_A K_v K_Fb K_Fa",
    "safety_bending": "S_F = sigma_Flim Y_ST Y_N (Y_drelT Y_RrelT Y_X)/sigma_F, Y_ST = 2",
    "involute_margin": "rho_A1 = a_w sin(alpha_wt) - sqrt(r_a2^2 - r_b2^2), both signed",
    "radial_assembly_margin": "(t_1 + inv(alpha_a1) - inv(alpha_wt)) z1/z2 - t_2 - inv(alpha_a2) + inv(alpha_wt), "
    "times r_a2",
}

_SLIDER_CRANK = {
    "quick_return_ratio": "K = (180 + t)/(180 - t), t = theta_f - theta_e in deg",
    "dead_center_extended": "theta_e = asin(e/(L + r))",
    "dead_center_folded": "theta_f = asin(e/(L - r))",
    "max_stroke": "S_max = 2 sqrt(L (L - |e|))",
}

_PRESS = {
    "initial_crank_angle": "D, E, F stretched: psi0 = -90 deg - asin(e/(EF + DE)), direction of DC psi0 + CDE; phi_AB0 "
    "closes ABCD",
    "sync_start": "p'(phi_s) = q'(phi_s): bed and cylinder equally fast",
    "sync_end": "q(phi_e) = q(phi_s) + sync.length",
    "cam_sync_start": "theta_s = angle turned by CD at phi_s",
    "cam_sync_end": "theta_e = angle turned by CD at phi_e",
    "compensation": "h0 = [p - q] at phi_e less [p - q] at phi_s, p travel of the bed, q of the cylinder",
    "min_transmission_angle_bed": "least of min(gamma, 180 deg - gamma) over the turn of ABCD",
    "min_transmission_angle_cylinder": "least of min(gamma, 180 deg - gamma) over the turn of GHMN",
    "end_slope": "k1 = d(p - q)/d(theta) at theta_e, theta the cam angle (the report takes the input angle)",
    "transition_rise": "T = transition end - theta_e; arc: T tan(atan(k1)/2) in mm over deg; parabola: k1 T/2; "
    "quartic: k1 T/2 + a1 T^2/12, a1 second derivative of the zone at its end",
    "follower_stroke": "h = s_max - s_min over the turn",
    "return_end": "theta_r = transition end + return_angle, transition end given or theta_e + transition_angle",
    "return_max_pressure_angle": "as max_pressure_angle, of roller 2 at r_b + s - L_s1s2",
    "return_min_curvature_radius": "as min_curvature_radius, of roller 2 at r_b + s - L_s1s2",
    "return_max_radius": "L_s1s2 - r_b - s_min - r_g, the main cam's: r_b + s_max - r_g",
    "return_min_radius": "L_s1s2 - r_b - s_max - r_g, the main cam's: r_b + s_min - r_g",
    "cam_base_radius": "r_b as given, or the least with which both cams keep |s'|/tan(alpha) <= r_b + s and <= L_s1s2 "
    "- r_b - s, rho_min >= r_g/0.8 and r_b + s_min - r_g >= 1.5 shaft_radius",
    "roller_center_distance": "L_s1s2 = 2 r_b + s_max + s_min",
}

_CAM = {
    "max_pressure_angle": "largest |alpha| over the turn, tan(alpha) = Im(q/u)/Re(q/u), q = i B' + eps B; wide-swing: "
    "tan(delta) = (lambda A - cos phi)/sin phi, outside the transition zone",
    "min_curvature_radius": "least 1/kappa where convex, kappa = -eps Im(conj(D1) D2)/|D1|^3 of the pitch curve "
    "P = e^(-i eps phi) B",
    "max_radius": "largest |C|, C = e^(-i eps phi) (B + r_g N) (profile); wide-swing: largest |P| (pitch curve)",
    "min_radius": "least |C|, C = e^(-i eps phi) (B + r_g N) (profile); wide-swing: least |P| (pitch curve)",
}

_GRIPPER = {
    "handover_speed": "v_F = l_EF beta'(handover) w, w speed of the cylinder shaft",
    "handover_mismatch": "dv = v_F - R w",
    "total_swing": "beta_T = (R/l_EF) (kappa_a D_a + D_c + kappa_d D_d), D phase lengths, kappa the laws' shares",
    "spring_torque": "T_s,min = max(-s_c T_in, s_c J_2 psi_2'') + reserve, T_in = J_A a1 + J_E a4 k4 + J_CD a3 k3 + m "
    "Re(conj(v_G/w1) a_G)",
    "newton_agreement": "max |closed form - Newton-Raphson| of coupler and input angle over the turn",
    "condition_number": "1/sin(mu) of the loop's Jacobian, largest over the swing",
    "lift_off_speed": "n* = n sqrt(T_s/max(-s_c T_in)), likewise for the return roller; the lesser; "
    "wide-swing, in 1/min: n* = n0 sqrt(1 + rho - f)",
}

_SWING = {
    "energy_parameter": "N = 2 P r_d T^2/(J gamma^2) (pneumatic), 2 c r_d^2 T^2/(J gamma^2) (spring); sqrt(N) = "
    "(1/gamma) Int d(phi)/sqrt(E) over the swing, E available energy of the device",
    "velocity_peak": "B = b(1/2) = sqrt(N E(mid-swing))",
    "acceleration_peak": "C = max |c|, c = (N/2) lambda gamma X sin(phi)/l, X force and l length of the device",
    "min_pivot_ratio": "cylinder: p + sqrt(p^2 - 1), p = (q^2 - cos(gamma/2))/(q^2 - 1); spring: 1 + (l_0 + l_k + "
    "S_0)/r_d",
    "force": "P = (1 + rho) N J gamma^2/(2 r_d T^2)",
    "spring_rate": "c_s = (1 + rho) N J gamma^2/(2 r_d^2 T^2)",
    "contact_force": "F = max J gamma |c| rho/(T0^2 r cos delta)",
    "drive_torque_peak": "M_dr = J gamma^2 max(b c)/(T^2 phi_ud)",
    "drive_balancing_ratio": "K_y2 = (1 + g)/(rho + f + g), g shaft.linkage_share",
    "rocker_radius": "r = a/(B alpha + 1) (twin-cam), a/(B alpha - 1) (twin-rocker), alpha = gamma/phi_ud",
    "profile_correction": "xi = angle at the cam axis between roller centre and centre line at the end of the stroke",
    "phase_angle": "Phi = phi_ud/2 - xi",
    "start_curvature_radius": "R0 = rho^2/(rho + lambda sin(gamma/2) psi''(0)/rho), in centre distances",
    "iteration_energy_parameter": "a_{i+1} = a_i + (b_i + b_{i+1}) dk/2, N <- N (0.5/a(1/2))^e until a(1/2) = 0.5",
    "iteration_error": "N_it/N - 1",
    "transition_zone": "|z(1/2 - Dk) + r_p n - z(1/2)| = r_p; for small rollers Dk = q r_p/(p^2 phi_ud)",
}

_MOBILITY = {
    "linkage_mobility": "F0 = 3 (n - 1) - 2 g, n links, g joints (a pin of k links counts k - 1)",
    "mobility_changes": "dF = 1 - R for each train, R its end gears that are fixed to a link",
    "mobility": "F = F0 + sum of dF",
}

FORMULAS: dict[str, str] = {
    **_GEAR_LINKAGE,
    **_GEAR_PAIR,
    **_SLIDER_CRANK,
    **_PRESS,
    **_CAM,
    **_GRIPPER,
    **_SWING,
    **_MOBILITY,
}
