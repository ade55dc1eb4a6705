"""The rules that the checks of the three-gear four-bar judge by."""

from __future__ import annotations

from gearlink.core.report import Rule

ACHIEVED = Rule(
    "GL304",
    "achieved value differs from the one asked for",
    "Whole numbers of teeth change the ratio that was asked for, or the back-step of the given teeth is not the "
    "one asked for (a warning).",
    "All results belong to the teeth that can be made, not to the wish.",
    "Accept it, ask for a ratio of whole teeth, or leave idler or crank_angle out so that they are chosen to fit.",
    "i3 = -z3/z5; back-step 2 n atan(tan(h)/n) - 2 h with n = 1 - i3, h = phi12/2; warns beyond 0.5 deg",
    "thesis (4-19)",
    ("back-step-target", "rounded-ratio"),
    ("gears.i3", "back_step.angle", "back_step", "gears"),
)
