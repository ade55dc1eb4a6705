"""The rules that the checks of a machine judge by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

TIMING = Rule(
    "GL530",
    "relation of the timing does not hold",
    "A line of `require` does not hold on the machine angle, or holds with less than `limits.timing_margin`.",
    "Members that move when they must not meet each other, lose the sheet, or take it too early.",
    "Change the phases; phase: free has them found with the largest margin of all relations. Where none will do, the "
    "relations that limit each other are named: shorten one of their runs.",
    "way from one event to the other by the shorter way round the dial, less the required angle",
    "own derivation (difference constraints)",
    ("timing-relation",),
    ("require", "members", "limits.timing_margin"),
)
MEMBER_SPEED = Rule(
    "GL531",
    "member at another speed than the machine",
    "The file of a member has a speed that is not that of the main shaft times its ratio.",
    "The machine's speed holds here; checked alone, the member is checked at its own.",
    "Give the member the speed that the message says, or omit it.",
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
    "torque of the members near a natural frequency of the main shaft",
    "A harmonic of the members' torque of more than 1 % of the largest lies within 10 % of a natural frequency.",
    "The shaft winds up and down many times as much as at rest: register is lost and teeth hammer.",
    "Run slower or faster, stiffen the shaft between the members that swing against each other, or take smoother laws.",
    "k n/(60 f)",
    "K. Magnus, K. Popp, Schwingungen; W. T. Thomson, Theory of Vibration, 12.4",
    ("critical-speed",),
    ("shaft", "speed"),
)
MACHINE_SPEED = Rule(
    "GL533",
    "machine speed above the limit of a member",
    "The main shaft turns faster than the speed at which a member lifts off or vibrates more than allowed.",
    "The member that limits the machine is named: it loses its cam, or dwells too briefly.",
    "Run slower, or mend the member that is named: stiffer spring, less mass, a smoother law.",
    "minimum over the members of their limit over |ratio|",
    "own derivation",
    ("machine-speed",),
    ("speed",),
    side="<=",
)
