"""The checks of a dwell within a tolerance: its window, and whether it has an end."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.base.judged import Judged
from gearlink.core.base.report import Check, safely_below
from gearlink.core.machines.three_gear.codes import ACHIEVED, BACK_STEP, DWELL_TOLERANCE
from gearlink.core.parts.linkages.checks import dwell_window_check, window_judged

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.design import ThreeGearFourBar

_SAME_RATIO = 1e-12
_MISSED = 0.5
"""By so much a back-step may miss the one asked for [deg]."""


def window_check(design: ThreeGearFourBar) -> Iterator[Check]:
    """GL313 where the file asks for a window: an output that never leaves the band has one of a whole turn."""
    given, tolerance = design.spec.dwell_window, design.output_tolerance
    if given is None or tolerance is None:
        return
    asked, dwell, remedy = math.radians(given), design.tolerance_dwell, ""
    reached = 2.0 * math.pi if dwell is None else dwell.crank_angle
    if design.advises and window_judged(math.degrees(reached), given).fails:
        from gearlink.core.machines.three_gear.families.window_lengths import words

        remedy = words(design.window_rooms)
    yield dwell_window_check(reached, asked, tolerance, remedy)


def tolerance_check(design: ThreeGearFourBar) -> Iterator[Check]:
    """GL317 where the file gives a tolerance or a play: whether a dwell within it has an end."""
    if design.output_tolerance is None:
        return
    given, limit = math.degrees(design.output_tolerance), math.degrees(design.endless_tolerance)
    text = f"the tolerance of the dwell is +-{given:.6g} deg, the output gains {2.0 * limit:.6g} deg in a turn"
    yield tolerance_judged(given, limit).check(
        text, f": within it a dwell has no end, give less than {safely_below(limit)} deg"
    )


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
