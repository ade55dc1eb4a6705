"""The rules that the checks of gears judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule


def _within(*keys: str) -> tuple[str, ...]:
    """Keys as they stand in the section of gears of a machine."""
    return tuple(f"{section}.{key}" for section in ("gears", "input_gears", "racks") for key in keys)


_TEETH = ("profile_shift", "teeth", "gears", "input_gears", "racks", "pin_radius")

AT_LIMITS = tuple(f"{name}-at-limits" for name in ("contact-ratio", "interference", "root-clearance", "tip-fouling"))
"""Names of the checks that look at the limits of the centre distance."""

UNDERCUT = Rule(
    "GL201",
    "tooth root undercut",
    "The profile shift is below the minimum with which a rack cutter leaves the involute complete; fails if it is "
    "lower by more than limits.undercut.",
    "The cutter takes away part of the flank at the root: the tooth is weaker and contact ratio is lost.",
    "Increase the profile shift of that gear to x_min, or use more teeth or a larger pressure angle.",
    "x >= x_min = h - z sin^2(alpha_t)/(2 cos(beta)), h = h_a* or to where the tool's straight flank ends; fails "
    "below x_min - limits.undercut (0.05), warns below x_min",
    "own derivation: the cutter's tip line passes the base tangent point; quantities of ISO 21771",
    ("undercut",),
    _TEETH,
)
TIP_THICKNESS = Rule(
    "GL202",
    "tooth tip too thin",
    "The tooth is thinner at its tip than limits.tip_thickness times the module.",
    "A pointed tip is weak; if it is hardened through, it breaks.",
    "Reduce the gear's profile shift or its addendum.",
    "s_a = r_a (s/r - 2 (inv(alpha_a) - inv(alpha))); fails below 0.25 m, warns below 0.4 m",
    "ISO 21771; the limit is usual practice",
    ("tip-thickness",),
    _TEETH,
)
CONTACT_RATIO = Rule(
    "GL203",
    "contact ratio too small",
    "On average too few tooth pairs are in contact.",
    "Below 1 the drive is interrupted; a little above 1 it runs roughly with worn or inaccurate teeth.",
    "Use more teeth of a smaller module, a smaller pressure angle, or less profile shift.",
    "eps = (z1 (tan alpha_a1 - tan alpha_wt) + z2 (tan alpha_a2 - tan alpha_wt))/(2 pi); fails below "
    "limits.contact_ratio (1.1), warns up to 0.1 above, and below 1 whatever the limit; of helical gears with "
    "face_width eps_gamma is checked; fails below 1 with the gears as far out of mesh as center_distance_allowance "
    "lets them",
    "ISO 21771; the limit is usual practice",
    ("contact-ratio", AT_LIMITS[0]),
    _TEETH,
)
INTERFERENCE = Rule(
    "GL204",
    "tip beyond the involute of the mating gear",
    "A tip circle passes the point where the line of action touches the mating gear's base circle, or that of the "
    "pinion cutter that shapes a ring.",
    "There the mating gear has no involute: the tip digs into its root or jams. A pinion cutter likewise leaves no "
    "involute at the tip of the ring.",
    "Increase the mating gear's profile shift, reduce the addendum of the gear whose tip is too high, or use a cutter "
    "with more teeth.",
    "a_w sin(alpha_wt) - sqrt(r_a^2 - r_b^2) >= 0 for both gears",
    "ISO 21771; own derivation of the margin",
    ("involute-interference", AT_LIMITS[1]),
    _TEETH,
)
ROOT_CLEARANCE = Rule(
    "GL205",
    "root clearance too small",
    "The tip of a gear comes too near to the root of its mating gear.",
    "Dirt, wear or a bent shaft then make tip and root touch.",
    "Increase the clearance coefficient, or shorten the mating gear's tips.",
    "c = a_w - r_a(mate) - r_f; fails below 0.05 m, warns below 0.15 m; fails at 0 with the gears as deep in mesh as "
    "center_distance_allowance lets them, with the root that the upper thickness allowance gives",
    "ISO 21771; the limits are usual practice",
    ("root-clearance", AT_LIMITS[2]),
    ("clearance", *_within("clearance"), *_TEETH),
)
SLIDING = Rule(
    "GL209",
    "specific sliding too large",
    "The sliding speed at the root end of an active flank is many times the rolling speed there (a warning).",
    "Such flanks wear and score: contact is close to the base circle, where the rolling speed is zero.",
    "Increase the gear's profile shift, use more teeth, or reduce the mating gear's addendum.",
    "|zeta| = |1 - (w_mate rho_mate)/(w rho)| <= limits.sliding; without that key only |zeta| > 8 is reported",
    "ISO 21771; the limit is usual practice",
    ("sliding",),
    ("limits.sliding", *_TEETH),
    side="<=",
)
TOOTH_FORM = Rule(
    "GL212",
    "tooth cannot be cut",
    "The tip circle lies inside the root circle, the flanks meet below the tip, or tooth or space has no width on the "
    "reference circle.",
    "The numbers describe a tooth that does not exist.",
    "Bring the profile shift nearer to 0, or use more teeth.",
    "r_a > r_f > 0, s_a > 0, 0 < s = m (pi/2 + 2 x tan(alpha)) < pi m",
    "ISO 21771; the range of x: own derivation, a rack then leaves both tooth and space",
    ("tooth-form",),
    _TEETH,
)
TIP_FOULING = Rule(
    "GL206",
    "tip interference in an internal mesh",
    "The tips of planet and ring gear cut into each other where their tip circles cross, outside the contact; or the "
    "planet cannot be put into its ring along the line of centres (radial-assembly: a warning, a failure with "
    "assembly: radial).",
    "The gears cannot turn, or cannot be put together.",
    "Give the ring gear more teeth or the planet fewer: at 20 deg about 8 teeth of difference are needed; or shorten "
    "the tips.",
    "z1 (inv alpha_a1 + delta_1) - z2 (inv alpha_a2 + delta_2) + (z2 - z1) inv alpha_wt >= 0, delta the angles from "
    "the line of centres to where the tip circles cross; radial-assembly: t_1 + inv alpha_a1 - inv alpha_wt >= z2/z1 "
    "(t_2 + inv alpha_a2 - inv alpha_wt) at the position of the minimum clearance",
    "own derivation",
    ("tip-fouling", "radial-assembly", AT_LIMITS[3]),
    ("gears", "teeth"),
)
FILLET = Rule(
    "GL207",
    "the mating gear's tip meets the root fillet",
    "Contact reaches deeper than the involute that the tool leaves, r_Nf < r_Ff; or the corner of the mating gear's "
    "tip cuts into the fillet outside the path of contact.",
    "The tip of the mating gear runs on the fillet, which is no involute: noise, scoring, jamming.",
    "Increase the profile shift, shorten the mating gear's tips (tip_shortening), or use a tool with a smaller "
    "rounding or a larger addendum. Tips of a ring of full height always reach into the fillet of a standard tool.",
    "r_Nf >= r_Ff - 1e-4 m, and the corner's minimum gap along its circle >= -1e-4 m; fails where the file names "
    "a tool "
    "or cutter, for rings and helical gears, else warns, as for rings of machines whose file says nothing of the teeth",
    "ISO 21771; form radius: own derivation, compared with a rolled tool",
    ("fillet-interference", "ring-tips"),
    ("tool", "cutter", "gears.tool", "gears.cutter", "input_gears.tool", *_TEETH),
)
BACKLASH = Rule(
    "GL208",
    "backlash too small",
    "The minimum backlash that thickness allowances and centre distance leave is negative (or below limits.backlash).",
    "Without backlash the teeth jam, heat up and wear.",
    "Increase the thickness allowances, or change the centre distance: a larger one gives more backlash, but less of "
    "a ring and its pinion.",
    "j_bn at the upper allowances and the tighter centre distance >= 0; fails below -1e-6 m, warns below "
    "limits.backlash (0). Theoretical: temperature, bearings and deviations of the teeth are not included",
    "DIN 3967; the form exact in the centre distance: own derivation",
    ("backlash",),
    ("allowances", "center_distance_allowance", "center_distance", *_within("allowances"), *_TEETH),
)
INSPECTION = Rule(
    "GL213",
    "inspection dimension cannot be measured",
    "A ball or pin that the file names does not lie between the flanks: it falls through the space, touches beyond the "
    "tips, on the fillet or on the root circle, or lies below the tips where no anvil reaches it. Or the planes of the "
    "span measurement touch a helical gear beyond its face.",
    "The measured value then differs from that of the drawing: a good gear is rejected or a bad one accepted.",
    "Use the preferred size that the finding names, or omit pin_diameter; span fewer teeth, or use balls.",
    "form circle <= d_M <= tip circle, root circle clear, M beyond the tip circle; tan(alpha_M) = tan(alpha_K) - "
    "D cos(beta_b)/d_b; b >= W_k sin(beta_b) + 1.2 mm cos(beta_b)",
    "DIN 21773",
    ("inspection",),
    ("pin_diameter", "span_teeth", "gears.span_teeth", *_within("pin_diameter")),
)
PITTING = Rule(
    "GL210",
    "safety against pitting too small",
    "The contact stress is too close to the permissible stress of the material. With `rating` K factors and life "
    "factors are computed; otherwise they are inputs, 1 by default.",
    "Small pits break out of the flanks, and the flanks wear away.",
    "Widen the gears, or use a larger module or centre distance or a better material.",
    "S_H = sigma_Hlim Z_N (Z_L Z_v Z_R Z_W Z_X)/(Z_B,D sigma_H0 sqrt(K_A K_v K_Hb K_Ha)) >= limits.safety_pitting (1); "
    "warns below 1 whatever the limit",
    "ISO 6336-2:2006, method B; K and life factors by `rating`, else 1 unless given",
    ("pitting",),
    ("load", "material", "face_width", *_within("load", "material", "face_width")),
)
BENDING = Rule(
    "GL211",
    "safety against tooth breakage too small",
    "The root stress is too close to the permissible stress of the material, or a formula for the root is used "
    "outside its range (a warning).",
    "Teeth break at the root.",
    "Use a larger module, wider gears, a larger rounding of the tool, or a better material.",
    "S_F = sigma_Flim Y_ST Y_d Y_N (Y_drelT Y_RrelT Y_X)/(F_t/(b m) Y_F Y_S Y_beta Y_B Y_DT K_A K_v K_Fb K_Fa) >= "
    "limits.safety_bending (1.4), warns below 1 whatever the limit; Y_ST = 2, Y_d = 0.7 for a gear with two mating "
    "gears, whose teeth are bent both ways, else 1",
    "ISO 6336-3:2006, method B; K and life factors by `rating`, else 1 unless given; no published example of rings "
    "and racks; a rack is taken as a gear of infinite radius",
    ("bending",),
    ("load", "material", "tool", "face_width", *_within("load", "material", "face_width")),
)
RATING_RANGE = Rule(
    "GL214",
    "factor outside its range, or without a published check value",
    "A formula of the rating is used outside its range, a hardness is outside its class, or the result depends on a "
    "formula that no published number confirms (a warning).",
    "The safety may then be wrong, and nothing else in the result shows it.",
    "Compare these lines of the table factors (--table factors) with the standard, or give the factor or limit in the "
    "file.",
    "range of each formula; confirmed: a report or worked example prints a number that the formula meets",
    "ISO 6336-1, -2, -3 and -5",
    ("rating-range",),
    ("rating", "load.factors", "material", *_within("rating")),
)
RESONANCE = Rule(
    "GL215",
    "near the main resonance",
    "Gear 1 runs near the speed at which the teeth vibrate most (a warning).",
    "The dynamic load may be several times the nominal one, and K_v is most uncertain there.",
    "Change the speed or the numbers of teeth; a better grade and a tip relief reduce the excitation.",
    "N = n_1/n_E1 outside 0.85 to 1.15, n_E1 = 30000/(pi z_1) sqrt(c_gamma,alpha/m_red)",
    "ISO 6336-1:2006, method B",
    ("resonance",),
    ("load.speed", "teeth", "rating.grade", "rating.tip_relief", *_within("rating")),
)
SCUFFING = Rule(
    "GL216",
    "safety against scuffing too small",
    "The mean (integral) temperature of the flanks is too close to that at which the oil fails in the test.",
    "The oil film breaks down, flanks weld and tear.",
    "Use an oil of a higher load stage or viscosity, a tip relief, smoother flanks, or a lower oil temperature.",
    "S_intS = theta_intS/theta_int >= limits.safety_scuffing (1.8)",
    "ISO/TR 13989-2, ISO/TS 6336-21",
    ("scuffing",),
    ("rating.lubricant", "rating.tip_relief", "rating.roughness", *_within("rating")),
)
DAMAGE = Rule(
    "GL217",
    "damage sum above 1",
    "Over the required life the load spectrum gives a flank or a root a damage sum above 1 at the required safety, or "
    "its maximum load exceeds the static limit.",
    "The gear fails before its life ends.",
    "Widen the gears, use a larger module or a better material, or specify a shorter life.",
    "U = sum n_k/N(S sigma_k) <= 1, S the required safety; static: sigma_HG, sigma_FG at the static knee",
    "ISO 6336-6",
    ("damage",),
    ("rating.spectrum", "rating.life", "load", "face_width", *_within("rating", "load")),
    side="<=",
)
FACE_LOAD = Rule(
    "GL218",
    "load concentrated at one end of the face width",
    "The face load factor is above 2: less than half of the face width carries the load effectively (a warning).",
    "The teeth break or pit at one end; wider gears then carry hardly more.",
    "Reduce the face width, use a better grade or a stiffer shaft, or modify the helix (rating.face.modification).",
    "K_Hbeta <= 2",
    "ISO 6336-1:2006, method C; the limit is usual practice",
    ("face-load",),
    ("rating.face", "rating.grade", "face_width", *_within("rating")),
    side="<=",
)
TRUE_FILLET = Rule(
    "GL219",
    "root stress of the generated fillet differs from ISO 6336-3",
    "The root stress on the generated fillet, by a boundary integral, differs from Y_F Y_S by more than a quarter "
    "(a warning); checked only with --table root.",
    "The critical section of the standard does not describe this root well.",
    "Check the root by other means, or use a tool with a larger rounding.",
    "|Y_gen/(Y_F Y_S) - 1| <= 0.25",
    "own derivation: Sherman-Lauricella equation of one tooth with its rim, within 4 %",
    ("true-fillet",),
    ("tool", "cutter", "profile_shift", *_within("tool")),
    side="<=",
)
OF_RATING = (RATING_RANGE, RESONANCE, SCUFFING, DAMAGE, FACE_LOAD)
"""What is judged of a file with `rating`."""


DISC_INTERFERENCE = Rule(
    "GL342",
    "interference of disc and pins",
    "With the modification of the profile, disc and pins overlap somewhere on the flank.",
    "The disc cannot be put into the ring, or jams in it.",
    "Increase modification.offset, or reduce modification.pin_circle.",
    "gap = dr - dR (1 - K cos u)/Q >= 0 for 0 < u < 180 deg, Q = sqrt(1 + K^2 - 2 K cos u)",
    "own derivation",
    ("interference",),
    ("modification.offset", "modification"),
)
SHORTENING = Rule(
    "GL343",
    "shortening coefficient out of the usual range",
    "The eccentricity is small or large for this pin circle (a warning).",
    "Below 0.4 the pressure angles are large and so are pin and bearing forces; above 0.8 the flanks are sharply "
    "curved and close to undercut.",
    "Choose the eccentricity so that K = e Z/R lies between 0.4 and 0.8.",
    "K = e Z/R, 0.4 <= K <= 0.8",
    "usual practice of pin-gear drives",
    ("shortening",),
    ("eccentricity", "pin_circle_radius", "pins"),
    side="",
)


START_SHOCK = Rule(
    "GL310",
    "impact at start and stop of the driven gear",
    "A mutilated gear takes its mating gear to full speed at once (always a warning).",
    "The model ends at the pitch circles: the cut tips of the first and last tooth and the locking arcs shift the "
    "exact start and end of motion. The impact limits the speed.",
    "Start at a dead centre of the crank (omit start_angle), keep the speed low, or add entry cams.",
    "speed ratio in motion Z_M/(Z_F i_r)",
    "own derivation; thesis figure 2-6 gives no formula",
    ("start-shock",),
    ("start_angle", "reduction", "gears"),
    side="<=",
)
GAP = Rule(
    "GL316",
    "gap of the driving gear too short",
    "In the gap between two groups of teeth a tooth stays in contact, or nearly so.",
    "The locking arc can hold the driven gear only while no tooth drives it; otherwise arc and teeth jam.",
    "Use fewer teeth in a group or more full teeth.",
    "Z_M/g - n + 1 - eps pitches without contact; fails below 0, warns below 1",
    "own derivation: each tooth is in contact for eps pitches, the teeth next to a gap are Z_M/g - n + 1 apart",
    ("gap",),
    ("gears.group_teeth", "gears"),
)
DWELL_QUALITY = Rule(
    "GL311",
    "dwell shorter than required",
    "The slider leaves the band of +- dwell.tolerance before the carrier has turned through the dwell.",
    "The slider is out of position: the arc of the path deviates too much from a circle with the rod as radius.",
    "Allow a larger tolerance, specify a smaller dwell.angle, or let `target` find the length of the rod.",
    "widest carrier angle about mid-dwell with max s - min s <= 2 tolerance",
    "own derivation; thesis 2.2.2, figure 2-5",
    ("dwell-quality",),
    ("dwell.tolerance", "dwell.angle", "rod", "target"),
)
