"""The rules that the checks of Geneva drives alone judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

LOCKING = Rule(
    "GL344",
    "locking disc and slots leave too little metal",
    "The lip of the wheel between the locking arc and the end of a slot has no thickness, two slots run into each "
    "other at their bottoms, or the locking disc is so small that it does not reach the wheel or that the lips hit its "
    "edge on their way past.",
    "The lip takes the shock of the entering pin, and the arc holds the wheel in the dwell: without metal the wheel "
    "breaks or turns freely.",
    "Take a smaller locking disc (locking_radius) or a thinner pin where metal lacks, a larger disc where it does not "
    "hold; a larger center_distance leaves more of both.",
    "r - r_pin - locking_radius > 0; locking_radius > a - tip_radius; between the "
    "bottoms of two slots (a - r) sin(pi/n) > r_pin (external)",
    "thesis 4.2.1; own derivation",
    ("locking",),
    ("locking_radius", "pin_radius", "center_distance"),
)
STEP_RATE = Rule(
    "GL345",
    "more steps a minute than Geneva drives run with",
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
