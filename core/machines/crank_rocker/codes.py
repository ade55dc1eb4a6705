"""The rule that a check of crank-rockers alone judges by."""

from __future__ import annotations

from gearlink.core.base.report import Rule

FULL_TURN = Rule(
    "GL330",
    "crank does not turn fully",
    "The linkage that was found for three pairs of angles goes through them, but its crank cannot make a full "
    "revolution.",
    "A drive that turns on stops or breaks the linkage; one that swings within the range is enough for the pairs.",
    "Drive the crank to and fro within `range`, or specify other pairs: a smaller swing of the rocker, or another "
    "crank angle at one of them.",
    "shortest + longest link below the sum of the other two, crank or frame the shortest",
    "F. Grashof's rule",
    ("full-turn",),
    ("function.pairs", "function", "links"),
    side="",
)
