"""The rules that the checks of a machine judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

TIMING = Rule(
    "GL530",
    "timing relation not met",
    "A relation of `require` is not met, or its margin is below `limits.timing_margin`.",
    "Members that move at the wrong time collide, lose the sheet or take it too early.",
    "Change the phases; `phase: free` finds those with the largest margin of all relations. If no phases meet all "
    "relations, the message names those that conflict: shorten one of their motions.",
    "machine angle from one event to the other, the shorter way round, less the required angle",
    "own derivation (difference constraints)",
    ("timing-relation",),
    ("require", "members", "limits.timing_margin"),
)
MEMBER_SPEED = Rule(
    "GL531",
    "member at another speed than the machine",
    "The file of a member has a speed that is not that of the main shaft times its ratio.",
    "In the machine the member runs at the machine's speed; its own file is checked at another one.",
    "Set the speed of the member to the value in the message, or omit it.",
    "|n_member/(n |r|) - 1| <= 1e-9",
    "own derivation",
    ("member-speed",),
    ("speed", "members"),
    side="<=",
)
NEAR = 0.1
"""At a frequency nearer to a natural one, as a share of it, the main shaft winds up."""
CRITICAL_SPEED = Rule(
    "GL532",
    "member torque near a natural frequency of the main shaft",
    "A harmonic of the members' torque, above 1 % of the largest harmonic, lies within 10 % of a natural frequency.",
    "The shaft twists many times as much as under a static torque: register is lost and teeth hammer.",
    "Change the speed, stiffen the shaft between the members that vibrate against each other, or use smoother laws.",
    "k n/(60 f)",
    "K. Magnus, K. Popp, Schwingungen; W. T. Thomson, Theory of Vibration, 12.4",
    ("critical-speed",),
    ("shaft", "speed"),
)
MACHINE_SPEED = Rule(
    "GL533",
    "machine speed above the limit of a member",
    "The main shaft turns faster than the speed at which a member lifts off or vibrates more than allowed.",
    "Above this speed the roller of the named member leaves its cam, or its output vibrates in the dwell.",
    "Reduce the speed, or improve the named member: stiffer spring, less mass, smoother law.",
    "minimum over the members of speed limit/|ratio|",
    "own derivation",
    ("machine-speed",),
    ("speed",),
    side="<=",
)
