"""The words of gear pairs, part of the nomenclature; names follow ISO 21771, ISO 6336, DIN 3967 and DIN 21773."""

from __future__ import annotations

from gearlink.core.base.term import Term

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
