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
    "A little play then turns the driven link far.",
    "Change pivots or links so that the swing centres on a right angle between coupler and driven link.",
    "condition number 1/sin(mu) <= limits.condition_number",
    "swing-gripper paper (7)",
    ("conditioning",),
    ("limits.condition_number", "links", "pivots"),
    side="<=",
)
PHASE_ALLOTMENT = Rule(
    "GL420",
    "return phase too short for the phase accelerate",
    "The peak acceleration of the return is more than limits.return_acceleration times that of the phase accelerate; "
    "checked only with that limit.",
    "The short return lifts rollers and shakes the machine while the sheet's own way is gentle.",
    "Lengthen phases.return at the cost of accelerate or near_dwell; or leave out accelerate, decelerate, return and "
    "give phases.balance, the ratio itself.",
    "max|beta''| of the return / max|beta''| of accelerate <= limits.return_acceleration",
    "own derivation; swing-gripper paper 1 names the allotment",
    ("phase-allotment",),
    ("phases", "limits.return_acceleration"),
    side="<=",
)
STOP_SETTLING = Rule(
    "GL421",
    "arm not at rest on its stop before the pick-up",
    "The return and the rebounds on the stop end after the turn is over; or less than a quarter of the near dwell is "
    "left (a warning).",
    "Grippers that still move when they close take the sheet askew.",
    "Lower the restitution (a damped stop) or the clearance, make the return end softly, or raise the spring's torque.",
    "360 - impact angle - settling angle >= 0; warns below a quarter of the near dwell",
    "own derivation; swing-gripper paper 2 names the stop",
    ("stop-settling",),
    ("stop.restitution", "stop.clearance", "spring"),
)
FINGER_RELEASE = Rule(
    "GL423",
    "fingers hold the sheet beyond the handover",
    "Where the release window ends the fingers are open by less than half of their angle.",
    "Both grippers then hold the sheet while their speeds part: it tears, or slips out of register.",
    "Let the fingers open earlier (fingers.open.from) or faster (fingers.open.over).",
    "eta(handover + release.window) >= fingers.open_angle/2",
    "own derivation",
    ("finger-release",),
    ("fingers.open.from", "fingers.open.over"),
)
HANDOVER = Rule(
    "GL503",
    "handover at unequal speeds",
    "Gripper and cylinder surface do not run equally fast at the handover, or not the same way: a cam on the "
    "cylinder's own shaft turns it with cam.sense, which must be against the gripper's swing. Or the tip "
    "is farther from its position on the line of centres than limits.handover_place, or than 1 mm where that allows "
    "more (a warning).",
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
