"""The rules that the checks of the flatbed press judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

SYNC_SPEED = Rule(
    "GL501",
    "bed and cylinder differ in speed at the start of the zone",
    "At the start of the synchronous zone the speeds of bed and cylinder differ; or the file has no cam, and their "
    "travels over the zone differ.",
    "The compensation cam compensates for a difference of travel, but a difference of speed is an impact at its "
    "start. Without a cam the difference of travel smears the print.",
    "Omit sync.start: then the zone starts where the speeds are equal; or compensate for the difference before the "
    "zone by cam.lead_in. Without a cam, add the section cam: its follower compensates for the difference of travel.",
    "|p'(phi_s) - q'(phi_s)| <= 1e-3 |q'(phi_s)|, p travel of the bed, q of the cylinder; with a lead-in the jump of "
    "the rack's own speed there instead of p' - q'; without a cam p - q at the end of the zone as at its start",
    "TY-460 report 3.2",
    ("sync-speed",),
    ("sync.start", "cam.lead_in", "cam", "sync", "cylinder"),
    side="<=",
)
SYNC_LENGTH = Rule(
    "GL502",
    "synchronous zone shorter than the print",
    "The travel of the cylinder's surface in the synchronous zone, or its circumference, is shorter than the print; "
    "or the bed reverses within the zone.",
    "The rest of the print would be smeared; a print longer than the circumference would overlap its own beginning.",
    "Set sync.length to the print length plus a margin; enlarge cylinder.radius.",
    "R i (theta_MN(phi_s) - theta_MN(phi_e)) >= sync.print_length, 2 pi R >= sync.print_length",
    "TY-460 report 3.2; the circumference: own derivation",
    ("sync-length",),
    ("sync.length", "sync.end", "sync", "cylinder"),
)
REGISTER = Rule(
    "GL506",
    "cylinder does not make a whole number of revolutions",
    "The cylinder does not make a whole number of revolutions per sheet; or its print passes the forme again while "
    "the bed returns (a warning).",
    "The next sheet would meet another part of the cylinder; a cylinder that makes several revolutions must be lifted.",
    "Set cylinder.gear_ratio to a whole number.",
    "cylinder.gear_ratio = 1, 2, 3 ... within 1e-9; of 2 and more q - q_s in [j C, j C + L] with p - p_s in [0, L] "
    "warns",
    "TY-460 report 1",
    ("register",),
    ("cylinder.gear_ratio", "cylinder"),
    side="<=",
)
PLACE = Rule(
    "GL516",
    "position of cylinder or gear 1 differs from the machine",
    "With loads.cylinder_direction the cylinder is where it cannot print: on the side of the bed on which the "
    "surfaces move in opposite directions, across the pitch line of the bed's rack, or over the slide line or an "
    "axis (A, D, G, N). Or loads.gear_1_direction does not match the distances of the axes. A warning: torque and "
    "linkages do not depend on it.",
    "The bearing forces of gears and cylinder are those of a machine that cannot be built, or that does not print.",
    "With loads.bed_side -1 and gravity [9.81, 0] the machine is as drawn: then give the direction in which the "
    "cylinder lies on the bed. Compute gear_1_direction from the positions of the axes.",
    "x_bed - (x_cylinder + R) >= 0, |cylinder - axis| >= R; tan = w/(AD - e), from +x to A->G, within 1 deg",
    "own derivation: a pair of rolling forces does no work where bed and cylinder run the same way; TY-460 report 1.1",
    ("cylinder-place", "gear-direction"),
    ("loads.cylinder_direction", "loads.gear_1_direction", "loads"),
)
RACK_LENGTH = Rule(
    "GL346",
    "rack too short",
    "A rack of the bed has fewer teeth (bed.rack_teeth) than the travel of its pinion takes.",
    "The pinion runs off the rack at the end of the stroke.",
    "Increase bed.rack_teeth, or omit it.",
    "teeth >= (travel + path of contact + pitch)/pitch; travel: stroke of F, of the lower rack with the follower's",
    "own derivation",
    ("rack-length",),
    ("bed.rack_teeth", "bed.pinion"),
)
