"""The rules that the checks of a disc cam judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

FACE_LENGTH = Rule(
    "GL408",
    "contact leaves the flat face",
    "The contact of cam and flat face runs beyond the reach of the face (follower.face).",
    "An edge of the face would touch the cam: it digs in, and the follower no longer makes its motion.",
    "Make the face longer to that side, or give the motion more cam angle: the contact stands off by s'.",
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
    "The roller has no guidance there, and strikes.",
    "Take a smaller roller, or enlarge the cam.",
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
    "Take a smaller cutter or grinding wheel, or enlarge the cam.",
    "r_c < 1/max(-kappa) + r_g, kappa of the pitch curve",
    "VDI 2142",
    ("cutter-radius",),
    ("cam.cutter_radius", "cam"),
    side="<=",
)
