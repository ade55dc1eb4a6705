"""The rules of the checks that apply to any kind of design: studies, tolerances and register, loads."""

from __future__ import annotations

from gearlink.core.base.report import Rule

FEASIBLE = Rule(
    "GL161",
    "few designs satisfy everything",
    "Less than one in a hundred of a study's designs satisfies all checks and conditions (a warning), or none does (a "
    "failure).",
    "A front of few designs depends more on the conditions than on the objectives.",
    "See the table why: it shows which check or condition alone excludes the most designs, and how close the nearest "
    "one is.",
    "designs that satisfy everything over all designs, 1 %",
    "own choice",
    ("feasible-designs",),
    ("where", "checks", "variables"),
)
RANGE_END = Rule(
    "GL162",
    "best designs at the end of a range",
    "Designs of the front have a variable at an end of its range.",
    "Better designs may lie beyond that end.",
    "Widen the range, unless the machine sets this limit.",
    "the variable equals from or to",
    "own choice",
    ("range-end",),
    ("variables",),
    side="",
)


POWER_IDENTITY = Rule(
    "GL601",
    "input torque differs between two methods",
    "The input torque by virtual power and that by the forces of all joints differ.",
    "Both follow from the same links, and losses of friction are counted from the motion of the joints; where they "
    "differ, none of the forces can be trusted.",
    "Move the mechanism away from a dead centre: near one the forces grow without limit.",
    "|M_NE - M_VP| <= 1e-9 max |M|",
    "virtual power against Newton and Euler",
    checks=("power-identity",),
    keys=("loads",),
    side="<=",
)
LOAD_REVERSAL = Rule(
    "GL602",
    "load reversal",
    "A tooth force, or the force of a roller between two cams, changes its sign.",
    "There the teeth change flanks through the backlash and rattle; meanwhile the second gear of the mesh lags by "
    "backlash/(2 r_w), r_w its working pitch radius. Within a dwell or a synchronous zone that is an error of "
    "position.",
    "Add a constant load or a spring on the output, reduce the speed, the driven masses, or the backlash.",
    "roots of F_t(phi)",
    "own derivation: the flank that touches follows from the sign of F_t",
    checks=("load-reversal",),
    keys=("loads.backlash", "loads"),
    side="<=",
)
MOTOR_TORQUE = Rule(
    "GL603",
    "motor torque",
    "The motor must give more than its maximum torque (peak, driving or braking) or more than its rated torque (root "
    "mean square), or it runs the machine at another speed than that of the file, at which forces, lives and "
    "vibration are computed.",
    "Above its maximum torque it stalls or trips; above its rated torque it overheats. Inertia forces grow with the "
    "square of the speed.",
    "Use a larger motor or ratio, add a flywheel (loads.flywheel.inertia) that reduces the peak, or balance the load "
    "by springs. If the speed differs, set loads.motor.ratio, or set the speed of the file to the one found.",
    "|peak| <= max_torque/margin, rms <= rated_torque/margin (a file with neither warns), |(w_max + w_min)/(2 w) - 1| "
    "<= 0.1",
    "thermal and pull-out limit of an electric motor",
    checks=("motor-torque", "motor-speed"),
    keys=("loads.motor",),
    side="<=",
)
SPEED_FLUCTUATION = Rule(
    "GL604",
    "speed fluctuation",
    "Over a period the input speed varies by more than loads.flywheel.fluctuation, or the machine stops; without that "
    "key a variation above 20 % is a warning, since forces, lives and vibration are computed for a constant speed.",
    "Speed variation is visible in the print, and inertia forces grow with the square of the maximum speed.",
    "Add flywheel inertia: loads.flywheel.fluctuation alone gives the minimum that is needed.",
    "(w_max - w_min)/w_m <= loads.flywheel.fluctuation, default 0.2",
    "own derivation: energy with variable inertia",
    checks=("speed-fluctuation",),
    keys=("loads.flywheel",),
    side="<=",
)
BEARING_LIFE = Rule(
    "GL606",
    "bearing life",
    "The rating life of a pin's bearing is below the required one, or the bearing oscillates too little for rolling "
    "elements, or helical teeth load it axially, which the forces in the plane of the machine do not include.",
    "A bearing that fails stops the machine; a rolling bearing that only oscillates brinells at a few positions.",
    "Use a bearing with a higher rating, or a plain bearing where the oscillation is small; less mass reduces the "
    "load.",
    "L_n = a_1 (C/P)^p 10^6 relative turns, a_1 = 1 at 90 % reliability",
    "ISO 281",
    checks=("bearing-life",),
    keys=("loads.bearings",),
)
FORCE_AMPLIFICATION = Rule(
    "GL612",
    "force amplification",
    "The transmission angle becomes so small that pin forces are five times those at a right angle.",
    "Forces grow as 1/sin of the transmission angle, and with them wear, play and the errors of the results.",
    "Change the links to increase the minimum transmission angle.",
    "1/sin(mu_min) <= 5",
    "VDI 2142",
    checks=("force-amplification",),
    keys=("links", "loads"),
    side="<=",
)
IMPACT = Rule(
    "GL614",
    "impact",
    "The speed of a link jumps.",
    "A jump of speed is an impact: each start and stop loses energy, as heat and in the tooth that strikes.",
    "Cut the first and last tooth, add entry cams, or reduce the driven masses.",
    "E = J_red w_F^2/2 at each start and stop",
    "impulse and energy of a plastic impact",
    checks=("impact",),
    keys=("gears", "loads"),
    side="<=",
)
SELF_LOCKING = Rule(
    "GL615",
    "self-locking",
    "Friction locks the mechanism, or nearly does so.",
    "Friction forces increase the joint forces that cause them; near self-locking a small rise of friction stops the "
    "mechanism.",
    "Use thinner pins, reduce the friction, or increase the transmission angle.",
    "ratio of two passes of the friction < 0.5",
    "own derivation: fixed point of the friction",
    checks=("self-locking",),
    keys=("loads.friction",),
    side="<=",
)
TOOTH_LOAD = Rule(
    "GL616",
    "teeth rated for a smaller load than they carry",
    "The maximum tooth force of the loads exceeds the force of the rating times K_A; a force on the opposite flanks "
    "bends the teeth both ways, and 3/7 of it is added.",
    "The safeties against pitting and tooth breakage (GL210, GL211) are those of a smaller force.",
    "Increase the load of the rating (torque, power or tangential_force), or its application factor.",
    "F_t + 3/7 F_back <= K_A F_t,rated r/r_w, 3/7 = (1 - M)/(1 + M) with M = 0.4 of tempered steel",
    "ISO 6336-6 for a load that varies, ISO 6336-3 annex B for one that turns back; own derivation",
    checks=("tooth-load",),
    keys=("gears.load", "load", "loads"),
    side="<=",
)
CONTACT_PRESSURE = Rule(
    "GL607",
    "contact pressure",
    "The Hertzian pressure of roller and cam exceeds the allowed pressure of their material.",
    "The surface pits; the maximum shear lies below it, where the hardened depth must still reach.",
    "Widen the roller (loads.roller.width), enlarge roller or cam, or reduce speed, mass or spring force.",
    "p_max = sqrt(N E*/(pi b R)),  R = r_g (1 - r_g kappa)",
    "Hertz, line contact",
    checks=("contact-pressure",),
    keys=("loads.material.allowed_pressure", "loads.roller"),
    side="<=",
)
CONTACT_LOSS = Rule(
    "GL608",
    "contact loss",
    "A roller leaves its cam at the speed of the design, or nearly does.",
    "A roller that lifts off falls back with an impact, and the follower deviates from its motion law.",
    "Increase the spring force, reduce the speed, or use a lighter follower.",
    "N > 0",
    "VDI 2142",
    checks=("contact-loss",),
    keys=("loads", "spring"),
)
ROLLER_SKID = Rule(
    "GL609",
    "roller skid",
    "Friction at the cam cannot turn the roller: its inertia and bearing need more torque.",
    "A roller that slides wears itself and the cam.",
    "Use a lighter roller, a bearing with less friction, or a higher contact force.",
    "|J_r dw/dt|/r_g + M_b/r_g <= mu N",
    "own derivation: friction at the contact",
    checks=("roller-skid",),
    keys=("loads.roller",),
    side="<=",
)
PRELOAD = Rule(
    "GL613",
    "preload",
    "The two rollers of a positive drive are not pressed on their cams at every instant.",
    "Where a contact opens, the drive has play and strikes at every reversal of the force.",
    "Increase loads.roller.preload to preload_needed.",
    "P >= max(F k_2/(k_1 + k_2), -F k_1/(k_1 + k_2))",
    "own derivation: two springs against each other",
    checks=("preload",),
    keys=("loads.roller.preload", "loads.roller"),
)

RIGID_MODEL = Rule(
    "GL605",
    "rigid model",
    "The first natural frequency is not far above the frequency of the input, or the motion lasts only a few natural "
    "periods.",
    "All forces are those of rigid links; the nearer the frequencies, the more the output differs from its law.",
    "Stiffen the drive of the output, reduce its mass, or reduce the speed.",
    "f_n >= limits.frequency_ratio f,  n_T = T_1 f_n",
    "VDI 2149",
    checks=("rigid-model",),
    keys=("loads.vibration",),
)
RESIDUAL_VIBRATION = Rule(
    "GL610",
    "residual vibration",
    "The output vibrates in the dwell by more than loads.vibration.allowed_residual.",
    "The sheet moves while it is gripped, printed or fed.",
    "Reduce the speed, stiffen the drive of the output, or use a smoother law (4-5-6-7, cycloidal).",
    "amplitude after the rise <= loads.vibration.allowed_residual",
    "VDI 2149",
    checks=("residual-vibration",),
    keys=("loads.vibration.allowed_residual", "loads.vibration"),
    side="<=",
)
RESONANCE = Rule(
    "GL611",
    "resonance",
    "A harmonic of the motion lies at the natural frequency of the output.",
    "Every period adds to the vibration; without damping it grows without limit.",
    "Change the speed, or the natural frequency, by a tenth.",
    "n_k = 60 f_n/k",
    "linear vibration of one degree of freedom",
    checks=("resonance",),
    keys=("loads.vibration",),
)


NO_MECHANISM = Rule(
    "GL177",
    "some designs as manufactured do not exist",
    "With the sizes of some samples the mechanism does not close, or its crank does not turn (a warning).",
    "Such a design counts as one that fails.",
    "Tighten the tolerances that contribute most, or keep further away from the change point.",
    "share of samples without a mechanism",
    "own choice",
    ("no-mechanism",),
    ("tolerance.sources", "tolerance"),
)
NOT_LINEAR = Rule(
    "GL178",
    "sensitivities do not explain the variation",
    "The variance by the sensitivities at the nominal design is less than 90 % of the sampled one (a warning).",
    "Linear shares then point at the wrong part: the quantity has a kink, or is not linear within the tolerances.",
    "Request Sobol' indices (--sobol), which need no linear response.",
    "sum (sensitivity sigma)^2 >= 0.9 variance of the samples",
    "own choice",
    ("linear-shares",),
    ("tolerance.sources", "tolerance"),
)
TARGET_YIELD = Rule(
    "GL179",
    "yield below its target",
    "The lower end of the yield's 95 % interval lies below tolerance.target_yield.",
    "More machines than allowed would not meet their requirements.",
    "Tighten what contributes most (table contributions), or let --allocate choose the grades.",
    "lower end of the 95 % interval >= target_yield",
    "own choice",
    ("target-yield",),
    ("tolerance.target_yield", "tolerance"),
)
REGISTER_BUDGET = Rule(
    "GL520",
    "register budget exceeded",
    "Over the print or dwell the register error exceeds register.tolerance: the band that 99.73 % of the machines "
    "keep (with register.method worst: all), or only the worst case (a warning).",
    "Colours no longer fall on each other, or the sheet is handed over where the next gripper does not expect it.",
    "Reduce first the error that is listed first in the table budget.",
    "error that 99.73 % of the machines keep (method worst: all) over the stretch, relative to its start, <= "
    "register.tolerance; worst case: a warning",
    "ISO/IEC Guide 98-3, 5.1.2; own derivation of the gains",
    ("register-budget",),
    ("register.tolerance", "register"),
    side="<=",
)
BACKLASH_IN_DWELL = Rule(
    "GL521",
    "torque reverses within the dwell",
    "The torque on the output (of a press the force on racks and cylinder) changes its sign while the output should "
    "dwell or print (a warning).",
    "There the output jumps by the backlash of all meshes that drive it.",
    "Brake the output with a friction torque above its inertia torque, or preload the gears.",
    "sign of J W' w^2 + T_f sign(W) + T_load over the stretch; of a press sign of q''",
    "own derivation",
    ("backlash-in-dwell",),
    ("register.friction", "register"),
    side="<=",
)
