"""The rules that the checks of cams judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

LARGER = "enlarge the base circle"
"""What a refusal of a cam recommends; a kind without a base radius in its file says which key does it."""
PRESSURE_ANGLE = Rule(
    "GL401",
    "pressure angle too large",
    "The angle between the follower's motion and the common normal at the contact exceeds limits.pressure_angle, or "
    "no cam can make the motion (then no value is given).",
    "The cam pushes the follower sideways instead of along its path: high side forces, wear and finally jamming.",
    "Enlarge the base circle, give the motion more cam angle, or move the cam centre; for a translating follower 30 "
    "deg is usual, for an oscillating one 45 deg.",
    "tan(alpha) = Im(q/u)/Re(q/u), q = i B' + eps B (B roller centre, u its direction of motion); wide-swing: "
    "tan(delta) = (lambda A - cos phi)/sin phi",
    "VDI 2142; wide-swing dissertation, chapter 3",
    ("pressure-angle",),
    ("limits.pressure_angle", "cam", "cams", "lever", "motion"),
    side="<=",
)
CAM_UNDERCUT = Rule(
    "GL402",
    "roller undercuts the cam",
    "The roller is as large as the minimum convex curvature radius of the pitch curve, or cuts into the profile "
    "elsewhere. The profile for a flat face is undercut where its curvature radius is not positive or the velocity "
    "of the lift steps down; that for a knife edge never is. For both, a radius below limits.curvature_radius is a "
    "warning.",
    "The cutter removes part of the profile, and the follower does not make the required motion. The tables show the "
    "envelope with its loop; the profile that is cut lies between the smallest and the largest radius.",
    "Use a roller radius below 0.8 of the minimum curvature radius, or enlarge the base circle. Where the velocity of "
    "the lift jumps no size helps: remove the jump (GL403).",
    "r_g/rho_min < 1 (warns above 0.8), and |C(phi) - P(t)| >= r_g for all profile points P and roller centres C",
    "VDI 2142; own derivation of the cut elsewhere",
    ("cam-undercut",),
    ("cam.roller_radius", "cam.roller", "cam", "roller_radius", "cams", "limits.curvature_radius"),
    side="<=",
)
VELOCITY_STEP = Rule(
    "GL403",
    "velocity of the lift jumps",
    "At a joint of the law the first derivative of the lift has a step.",
    "The acceleration would be infinite there: an impact at any speed.",
    "Choose laws whose end velocities agree; in a press start the zone where bed and cylinder have the same speed.",
    "|s'(t+) - s'(t-)| <= 1e-5 of the largest |s'|",
    "VDI 2143",
    ("velocity-step",),
    ("sync.start", "laws", "motion", "cam"),
    side="<=",
)
ACCELERATION_STEP = Rule(
    "GL404",
    "acceleration of the lift jumps",
    "At a joint of the law the second derivative of the lift has a step (a warning).",
    "The force on the follower jumps: vibration and noise at high speed, and the roller may lift off.",
    "Choose laws with zero acceleration at the ends; in a press set lead_in, transition: quartic and return_law: "
    "cycloidal.",
    "|s''(t+) - s''(t-)| <= 1e-5 of the largest |s''|",
    "VDI 2143",
    ("acceleration-step",),
    ("cam.lead_in", "laws", "motion", "profile", "cam"),
    side="<=",
)
JERK_STEP = Rule(
    "GL407",
    "jerk of the lift jumps",
    "At a joint of the law the third derivative of the motion has a step larger than limits.jerk_step (a warning; "
    "without that key it is only reported).",
    "A step of the jerk excites vibration at high speed, though far less than a step of the acceleration.",
    "Choose laws with zero jerk at the ends: polynomial-4567, velocity-4567 or {septic: 0.5}.",
    "|s'''(t+) - s'''(t-)| <= limits.jerk_step",
    "VDI 2143",
    ("jerk-step",),
    ("limits.jerk_step", "laws", "motion"),
    side="<=",
)
CONSTANT_SUM = Rule(
    "GL405",
    "distance of the rollers of the cam pair not constant",
    "The pitch radii of main and return cam at opposite rollers do not add up to the distance of the rollers.",
    "The rigid follower would jam or have play.",
    "Increase cam.base_radius so that each roller stays on its own side of the cam axis.",
    "r1(t) + r2(t) = L_s1s2 within 1e-9 of it, at every degree of cam angle",
    "TY-460 report 3.6",
    ("constant-sum",),
    ("cam.base_radius", "cam"),
    side="<=",
)
LIFT_OFF = Rule(
    "GL406",
    "lift-off of the roller",
    "At the design speed the inertia force of the follower exceeds the spring force, or the speed margin is below 10 "
    "%. No value is given where nothing presses both rollers of a pair to their cams: both lie on one side of the "
    "cam, or the spring pushes them off. A pair without `spring` is a warning: each roller has a rocker of its own, "
    "and only a spring between the rockers presses both.",
    "A roller that has left its cam falls back on it: wear, noise and a wrong motion.",
    "Increase spring.torque to the value in the message, or reduce the masses or the speed; turn "
    "cam.return_roller.angle past the cam axis.",
    "n* = n sqrt(T_s/max(T_inertia)) must exceed n; warns below 1.1 n",
    "own derivation: virtual work of links and coupler",
    ("lift-off",),
    ("spring.torque", "spring", "cam.return_roller", "cam", "speed"),
)
LAW_GAP = Rule(
    "GL517",
    "optimal law not proved to be the minimum",
    "The law that was found is far above the lower bound that holds for every law of its degree.",
    "The bound shows how much a better law could gain; a wide gap means that the linear programme was solved "
    "inaccurately.",
    "Reduce the degree, or relax a limit that can hardly be met.",
    "value/lower_bound - 1 <= 1e-3",
    "weak duality of linear programmes",
    ("law-gap",),
    ("law.degree", "law", "laws", "motion", "cam.return_law"),
    side="<=",
)
LAW_RIPPLE = Rule(
    "GL422",
    "law of a table reverses",
    "The curve through the points of a table from rest to rest runs backwards somewhere (a warning).",
    "Measured or rounded points ripple; each reversal is an impact in the play of the drive.",
    "Give more digits, smooth the points, or omit some: the spline passes through every point.",
    "minimum velocity of the law >= 0",
    "own derivation",
    ("law-ripple",),
    ("laws", "law", "motion", "cam.return_law"),
)
POLYDYNE_RANGE = Rule(
    "GL518",
    "a polydyne law of less than one natural period",
    "The phase is shorter than one natural period of the driven system.",
    "The peak acceleration of a polydyne law grows as 1/lambda^2, and the law is hardly useful away from its design "
    "speed.",
    "Give the phase more time, stiffen the vibrating part, or use an optimal law over a band of speeds.",
    "lambda = f T >= 1",
    "own derivation",
    ("polydyne-range",),
    ("law.periods", "law", "laws", "motion", "cam.return_law"),
)


FACE_LENGTH = Rule(
    "GL408",
    "contact leaves the flat face",
    "The contact of cam and flat face runs beyond the reach of the face (follower.face).",
    "An edge of the face would touch the cam: it digs in, and the follower no longer makes its motion.",
    "Lengthen the face on that side, or give the motion more cam angle: the contact moves along the face by s'.",
    "eps s' within [-left, right] of the line of travel; oscillating: f cos Psi/(1 + sigma s') within [from, to]",
    "own derivation: the normal passes the relative pole",
    ("face-length",),
    ("follower.face", "follower"),
    side="<=",
)
OUTER_WALL = Rule(
    "GL409",
    "roller undercuts the outer wall of the groove",
    "The roller is as large as the minimum concave radius of the pitch curve: the outer wall of the groove is "
    "cut away.",
    "There the roller is not guided, and strikes the wall.",
    "Use a smaller roller, or enlarge the cam.",
    "r_g < 1/max(-kappa), kappa of the pitch curve",
    "VDI 2142",
    ("outer-wall",),
    ("follower.roller_radius", "cam"),
    side="<=",
)
CUTTER_RADIUS = Rule(
    "GL410",
    "cutter too large for a concave flank",
    "The cutter (cam.cutter_radius) is as large as the minimum concave radius of the profile.",
    "It cannot reach into the concave part: it leaves material, and the follower is lifted there.",
    "Use a smaller cutter or grinding wheel, or enlarge the cam.",
    "r_c < 1/max(-kappa) + r_g, kappa of the pitch curve; r_c < r_g at its concave corner, where the velocity jumps",
    "VDI 2142",
    ("cutter-radius",),
    ("cam.cutter_radius", "cam"),
    side="<=",
)
