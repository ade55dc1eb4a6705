"""The rules that the checks of the wide-swing cam mechanism judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

TURNABILITY = Rule(
    "GL504",
    "balancing device cannot follow the swing",
    "The pivot ratio is too small for the length that cylinder or spring needs when it is shortest.",
    "The cylinder would reach its end stop, or the coils of the spring would touch, before mid-swing.",
    "Increase unloader.pivot_ratio to the value in the message, or reduce the swing.",
    "cylinder: lambda_min = p + sqrt(p^2 - 1), p = (q^2 - cos(gamma/2))/(q^2 - 1); spring: lambda_min = 1 + "
    "(l_0 + l_k + S_0)/r_d; of a spring without a length, or with a stretch_capacity above 2, "
    "warns below the ratio of steel, stretched by 2 l_0",
    "wide-swing dissertation (3), (4)",
    ("unloader-turnability",),
    ("unloader.pivot_ratio", "unloader"),
)
PROFILE_EXISTS = Rule(
    "GL505",
    "cam profile does not exist",
    "The pitch curve has a loop, or a twin-rocker does not turn faster than its cam (then no value is given).",
    "A cam with a loop cannot be made.",
    "Change cycle_angle, cycle.working or the swing as the message says; a twin-rocker needs a swing above 100 deg.",
    "(dTheta/dtheta) rho^2/(1 - cos phi) > 0 over the stroke, and with it Phi = phi_ud/2 - xi > 0",
    "wide-swing dissertation (21), (22), (25); the loop: own derivation",
    ("profile-exists",),
    ("cycle_angle", "cycle", "swing"),
)
TRANSITION_ZONE = Rule(
    "GL507",
    "contact changes flank over too much of the stroke",
    "About mid-swing the roller leaves one flank and crosses its slot to the other over more than "
    "limits.transition_zone of the stroke; more than 0.1 to each side is always a warning.",
    "Within this zone only the device guides the rocker; play and wear grow with its length.",
    "Use a smaller roller, or a larger cam.center_distance.",
    "|z(1/2 - Dk) + r_p n - z(1/2)| = r_p; for small rollers Dk = (4/3) t_c/phi_ud, t_c = 3 q r_p/(4 p^2), p and q of "
    "the pitch curve's cusp",
    "own derivation",
    ("transition-zone",),
    ("cam.roller_radius", "cam"),
    side="<=",
)
BALANCING = Rule(
    "GL508",
    "balancing device increases the torque at low speed",
    "The machine works at a speed at which the device raises the torque on the rocker axis (a warning).",
    "The torque of the device is constant, but the inertia torque falls with the square of the speed: below "
    "n0/sqrt(2) more torque is needed with the device than without it.",
    "Reduce the force or rate of the device for slow running, or remove it.",
    "K_y1 = n^2/(|n^2 - (1 + rho) n0^2| + f n0^2) > 1, that is n > n0 sqrt((1 + rho + f)/2)",
    "wide-swing dissertation, chapter 5; own derivation",
    ("balancing",),
    ("operating_speed_min", "unloader"),
)
FORCE_CLOSURE = Rule(
    "GL509",
    "spring slack at mid-swing",
    "The balancing spring is mounted without stretch, so that it is slack at mid-swing (a warning).",
    "There it does not press the roller to its cam, and the roller crosses its play just where it changes flank.",
    "Set unloader.stretch_ratio above 0, such as 0.1.",
    "epsilon = mounting stretch at mid-swing over the stroke of the spring > 0",
    "wide-swing dissertation, chapter 2; own derivation",
    ("force-closure",),
    ("unloader.stretch_ratio", "unloader"),
)
CYCLE_ANGLES = Rule(
    "GL510",
    "two strokes take more than a revolution",
    "Working and return stroke together take more than 360 deg of cam angle; or a dwell of a cycle has no length (a "
    "warning).",
    "The two profiles would overlap; without a dwell between them the concave parts of both strokes meet in an edge.",
    "Reduce cycle_angle to 180 deg or less; give both dwells of a cycle more than 0 deg.",
    "2 phi_ud <= 360 deg; working + far_dwell + return + near_dwell = 360 deg, dwells above 0",
    "own derivation",
    ("cycle-angles",),
    ("cycle_angle", "cycle"),
    side="<=",
)
FORCE_RESERVE = Rule(
    "GL511",
    "lift-off below the design speed",
    "The speed above which the roller leaves its cam is below the design speed (fails), or less than 10 % above it, "
    "as without a reserve (warns).",
    "A device that only balances the inertia does not press the roller to its cam: with play, friction or a little "
    "more speed the roller lifts off.",
    "Increase unloader.reserve to at least the value in the message, or reduce the speed; the remaining torque grows "
    "with the reserve.",
    "n_l = n0 sqrt((1 + rho - f)/k_b), rho unloader.reserve, f unloader.residual, k_b 1, or of an oscillating cam "
    "that swings in the return stroke the maximum acceleration of the rocker over that of the stroke at the same "
    "position; in the stroke F = J gamma |c| (1 + rho - (n/n0)^2)/(T0^2 r cos delta)",
    "own derivation",
    ("force-reserve",),
    ("unloader.reserve", "unloader"),
)
CLOSED_CONTOUR = Rule(
    "GL512",
    "roller cuts into the closed contour",
    "During the revolution a roller would cut into its own cam: next to a joint, in the sector where the other cam "
    "guides the rocker, or where two concave parts are close to each other.",
    "Part of the drawn contour would be cut away, and the rocker would lose its guidance there.",
    "Use a smaller cam.roller_radius or cam.free_clearance, longer dwells, or a larger cam.center_distance.",
    "minimum distance of contour and path of the roller's centre >= r_p",
    "own derivation",
    ("closed-contour",),
    ("cam.roller_radius", "cam.free_clearance", "cycle", "cam"),
)
PROFILE_PLANES = Rule(
    "GL513",
    "profiles of one cam overlap",
    "The internal and the external profile of a twin-rocker's cam overlap as seen along its axis (a warning).",
    "A cam with both profiles in one plane would have no metal between them.",
    "Cut the profiles in two planes side by side, or use smaller rollers.",
    "rho_2 - r_p > rho_1 + r_p during the dwells, rho_1 the external profile's pitch radius, rho_2 the internal one's",
    "own derivation",
    ("profile-planes",),
    ("cam.roller_radius", "cam"),
)
SIDE_CHANGE = Rule(
    "GL514",
    "device pushes the roller off its profile",
    "With a slider the balancing force reverses at mid-swing, but the roller changes flank where the rocker is "
    "fastest; these two positions are farther apart than the slot of the roller reaches.",
    "Between these positions the device pushes the roller off the profile, whatever its reserve, and nothing guides "
    "the rocker.",
    "Set slider.middle_angle to the value in the message, at which the slider is fastest at mid-swing: the reduced "
    "inertia is stationary there, and so is the rocker's speed. If that speed is a minimum, since the slider's mass "
    "slows the rocker, use a lighter slider or a rocker of more inertia.",
    "k_mid within the slot; c(k_mid) = 0 where d2s/dphi2 = 0 at mid-swing",
    "own derivation",
    ("side-change",),
    ("slider.middle_angle", "slider"),
    side="<=",
)
DEVICE_PRESSURE = Rule(
    "GL540",
    "pressure of the device not constant",
    "The volume of air is so small that the cylinder's force rises by more than 5 % from mid-swing to the ends of the "
    "swing (a warning).",
    "The motion law assumes a constant force; the rocker would be faster at mid-swing and pressed harder at the ends.",
    "Increase unloader.reservoir to at least the value in the message, or use a smaller bore with a higher pressure.",
    "(V/(V - A S))^1.4 - 1 <= 0.05, A = pi (d^2 - d_rod^2)/4, S device_stroke; isentropic",
    "own derivation",
    ("device-pressure",),
    ("unloader.reservoir", "unloader"),
    side="<=",
)
SWING_RANGE = Rule(
    "GL543",
    "swing above the range of the source",
    "The swing is above 300 deg (a warning; above 340 deg it is an error).",
    "The device is near its far dead centre, where a small error of the swing changes its force considerably, and an "
    "external profile has pressure angles above 60 deg at the ends.",
    "Reduce swing to 300 deg or less and add a gear stage for the rest; or use an internal profile, or a law without "
    "a cam, for such swings.",
    "lever at the ends lambda sin(gamma/2)/L; d ln N/d gamma; tan(alpha) = (r/a - cos(gamma/2))/sin(gamma/2)",
    "wide-swing dissertation, goal (up to 300 deg) against conclusion 3 (over 300 deg); own derivation",
    ("swing-range",),
    ("swing",),
    side="<=",
)
FLANK_IMPACT = Rule(
    "GL542",
    "impact at the change of flanks",
    "The roller strikes the other flank of its slot faster than limits.impact_speed (a warning; not checked without "
    "the limit).",
    "The impact wears both flanks and excites vibration of the rocker in each stroke.",
    "Reduce cam.roller_clearance, cam.roller_radius (a shorter transition zone) or unloader.reserve.",
    "v = kappa (tau^2 - tau_e^2)/2, (tau - 2 tau_e)(tau + tau_e)^2 = 6 s/kappa, kappa = r rho gamma |dc/dk|/T^3, "
    "tau_e = transition_zone T",
    "own derivation, to leading order",
    ("flank-impact",),
    ("limits.impact_speed", "cam.roller_clearance", "cam"),
    side="<=",
)
CAM_CLEARANCE = Rule(
    "GL541",
    "cams on parallel shafts too near",
    "A cam cuts into the shaft of the other cam; in one plane also into the other cam or its roller.",
    "The bodies would collide.",
    "Use `planes: separate`, turn cam.second.direction away, or increase the centre distances.",
    "|O1 O2| - (rho_max - r_p) - shaft_radius >= limits.cam_gap; in one plane the minimum distance of "
    "both contours over a revolution, and roller against the circle of the other cam",
    "wide-swing dissertation, figure 2; own derivation",
    ("cam-clearance",),
    ("cam.second.direction", "cam.second", "cam"),
)
