"""The rules that the checks of Geneva drives alone judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

LOCKING = Rule(
    "GL344",
    "locking disc and slots leave too little metal",
    "The lip of the wheel between the locking arc and the end of a slot has no thickness, two slots run into each "
    "other at their bottoms, or the locking disc is so small that it does not reach the wheel or that the lips hit its "
    "edge on their way past.",
    "The lip takes the shock of the entering pin. In the dwell no pin is in a slot: the arc alone holds the wheel, and "
    "where the disc does not reach it the wheel turns freely, so that the pin meets no slot at its next entry.",
    "Take a smaller locking disc (locking_radius) or a thinner pin where metal lacks, a larger disc where it does not "
    "hold; a larger center_distance leaves more of both. If a brake or a detent holds the wheel, omit locking_radius: "
    "then nothing of the disc is checked.",
    "r - b/2 - locking_radius - locking_clearance > 0, b = 2 r_pin + slot_clearance; locking_radius > a - tip_radius; "
    "between the bottoms of two slots (a - r) sin(pi/n) > b/2 (external)",
    "thesis 4.2.1; own derivation",
    ("locking",),
    ("locking_radius", "pin_radius", "center_distance"),
)
STEP_RATE = Rule(
    "GL345",
    "step rate too high for a Geneva drive",
    "The drive makes more steps in a minute than limits.steps_per_minute (a warning).",
    "The acceleration jumps at both ends of every step, and its peak is high: above 100 to 200 steps in a minute such "
    "drives are loud and wear.",
    "Run slower, take more slots, or a drive without the jump: `compare` compares it with a geared linkage and a cam.",
    "input_speed x pins",
    "thesis 4.2.1: 100 to 200 steps in a minute",
    ("step-rate",),
    ("input_speed", "pins", "limits.steps_per_minute"),
    side="<=",
)
PIN_ENTRY = Rule(
    "GL347",
    "the play of the locked wheel is larger than that of the pin in its slot",
    "When the pin comes to its slot, the wheel may stand off by half of locking_play; at the mouth of the slot that is "
    "more than half of slot_clearance (a warning).",
    "The pin then strikes the corner of the slot and does not run in: noise, wear, and a step that starts with a blow.",
    "Take a smaller locking_clearance or a larger slot_clearance, or chamfer the mouths of the slots by more than the "
    "difference.",
    "wheel_radius sin(locking_play/2) <= slot_clearance/2",
    "own derivation",
    ("pin-entry",),
    ("locking_clearance", "slot_clearance"),
    side="<=",
)
