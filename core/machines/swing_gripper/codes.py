"""The rules that the checks of the swing gripper judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

FARTHER = "set cam.center farther from the roller"
"""What enlarges the base circle of a gripper's cam."""
CONDITIONING = Rule(
    "GL312",
    "linkage near a dead centre",
    "Over the swing the loop comes so near to a dead centre that the closed form and Newton-Raphson lose digits, or "
    "the assembly is not determined in line with the frame (a warning).",
    "A little play then turns the driven link by a large angle.",
    "Change pivots or links so that coupler and driven link are at a right angle in the middle of the swing.",
    "condition number 1/sin(mu) <= limits.condition_number",
    "swing-gripper paper (7)",
    ("conditioning",),
    ("limits.condition_number", "links", "pivots"),
    side="<=",
)
PHASE_ALLOTMENT = Rule(
    "GL420",
    "return phase too short compared with the phase accelerate",
    "The peak acceleration of the return is more than limits.return_acceleration times that of the phase accelerate; "
    "checked only with that limit.",
    "A short return lifts rollers off their cams and shakes the machine, although the motion with the sheet is smooth.",
    "Lengthen phases.return at the cost of accelerate or near_dwell; or omit accelerate, decelerate and return and "
    "set phases.balance, the ratio itself.",
    "max|beta''| of the return / max|beta''| of accelerate <= limits.return_acceleration",
    "own derivation; swing-gripper paper 1 names the allotment",
    ("phase-allotment",),
    ("phases", "limits.return_acceleration"),
    side="<=",
)
STOP_SETTLING = Rule(
    "GL421",
    "arm not at rest on its stop before the pick-up",
    "The return and the rebounds on the stop end after the end of the revolution; or less than a quarter of the near "
    "dwell remains (a warning).",
    "Grippers that still move when they close grip the sheet askew.",
    "Reduce stop.restitution (a damped stop) or stop.clearance, use a return law with a soft end, or increase the "
    "spring torque.",
    "360 - impact angle - settling angle >= 0; warns below a quarter of the near dwell",
    "own derivation; swing-gripper paper 2 names the stop",
    ("stop-settling",),
    ("stop.restitution", "stop.clearance", "spring"),
)
FINGER_RELEASE = Rule(
    "GL423",
    "fingers hold the sheet beyond the handover",
    "At the end of the release window the fingers are open by less than half of fingers.open_angle.",
    "Both grippers then hold the sheet while their speeds differ: it tears, or slips out of register.",
    "Let the fingers open earlier (fingers.open.from) or faster (fingers.open.over).",
    "eta(handover + release.window) >= fingers.open_angle/2",
    "own derivation",
    ("finger-release",),
    ("fingers.open.from", "fingers.open.over"),
)
HANDOVER = Rule(
    "GL503",
    "handover at unequal speeds",
    "Gripper and cylinder surface differ in speed or direction at the handover: the shaft of cylinder and cam turns "
    "with cam.sense, which must be opposite to the gripper's swing. Or the distance of the tip from its position on "
    "the line of centres exceeds limits.handover_place (fails) or 1 mm (warns).",
    "The sheet is torn, or loses its register.",
    "Set handover within the constant-speed phase; reverse cam.sense where the cam turns the cylinder; turn "
    "arm.direction or move cylinder.center until the tip is on the line of centres.",
    "|l_EF beta'(handover) w - R w| <= 1e-9 R w; cam.sense = -swing_sense where cam and cylinder have one "
    "axis; distance of the tip from its position <= limits.handover_place",
    "swing-gripper paper 2",
    ("handover",),
    ("handover", "cam.sense"),
    side="<=",
)
