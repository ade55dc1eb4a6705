"""The rules that the checks of the three-gear four-bar judge by, and their judgements of numbers or of arrays."""

from __future__ import annotations

from typing import Any

from gearlink.core.base.judged import Judged
from gearlink.core.base.report import Rule

ACHIEVED = Rule(
    "GL304",
    "achieved value differs from the required value",
    "Whole numbers of teeth do not give exactly the required ratio, or the given teeth do not give the required "
    "back-step (a warning).",
    "All results are those of the whole numbers of teeth, not of the required ratio.",
    "Accept the difference, specify a ratio of whole numbers of teeth, or omit idler or crank_angle so that it is "
    "found.",
    "i3 = -z3/z5; back-step 2 n atan(tan(h)/n) - 2 h with n = 1 - i3, h = phi12/2; warns beyond 0.5 deg",
    "thesis (4-19)",
    ("back-step-target", "rounded-ratio"),
    ("gears.i3", "back_step.angle", "back_step", "gears"),
    side="",
)

BACK_STEP = Rule(
    "GL315",
    "output moves during the dwell angle",
    "dwell.angle is the crank angle until the output is back at its starting position; meanwhile it steps back "
    "and returns.",
    "Half of that back-step is more than dwell_tolerance (1 deg by default): the output does not dwell.",
    "Specify dwell: {window, tolerance} instead of angle, or set dwell_tolerance to what the machine allows.",
    "D/2 <= dwell_tolerance",
    "thesis (4-16), (4-19)",
    ("back-step",),
    ("dwell.angle", "dwell"),
    side="<=",
)
DWELL_TOLERANCE = Rule(
    "GL317",
    "dwell tolerance too large",
    "The band of the tolerance, or of the play, is as wide as the net rotation of the output per revolution of the "
    "crank.",
    "The output would never leave the tolerance band: this is no dwell.",
    "Reduce dwell_tolerance, dwell.tolerance or dwell_backlash.",
    "tol < pi mean_ratio; for a play j at the output gear tol = j/(2 r5)",
    "own derivation",
    ("dwell-tolerance",),
    ("dwell_tolerance", "dwell.tolerance", "dwell_backlash"),
    side="<=",
)


_SAME_RATIO = 1e-12
_MISSED = 0.5
"""By so much a back-step may miss the required one [deg]."""


def tolerance_judged(given: Any, limit: Any) -> Judged:
    """GL317 of tolerances [deg]."""
    return Judged(DWELL_TOLERANCE, given, limit, given >= limit, False, "deg")


def back_step_judged(half: Any, limit: Any) -> Judged:
    """GL315 of halves of back-steps [deg]."""
    return Judged(BACK_STEP, half, limit, False, half > limit, "deg")


def ratio_judged(value: Any, asked: Any) -> Judged:
    """GL304 of ratios i3."""
    return Judged(ACHIEVED, value, asked, False, abs(value - asked) > _SAME_RATIO * abs(asked), "1")


def target_judged(value: Any, asked: Any) -> Judged:
    """GL304 of back-steps [deg]."""
    return Judged(ACHIEVED, value, asked, False, abs(value - asked) > _MISSED, "deg")
