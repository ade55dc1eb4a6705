"""The symmetric three-gear four-bar the other way round: from its frame to the crank angle of its back-step."""

from __future__ import annotations

import math


def momentary_frame_ratio(i3: float) -> float:
    """Frame ratio at which the output just stops: d_lim = 1 - i3 + s, s = sqrt(i3 (i3 - 2)) (thesis (4-18))."""
    return 1.0 - i3 + math.sqrt(i3 * (i3 - 2.0))


def back_step_crank_angle(i3: float, frame_ratio: float) -> float:
    """phi12 [rad] by cos(phi12/2) = (d^2 - 1)/(2 d s) (thesis (4-15)).

    The sine comes from the product (d_lim - d)(d + 1/d_lim): no digit is lost near the momentary dwell.
    """
    s, d, limit = math.sqrt(i3 * (i3 - 2.0)), frame_ratio, momentary_frame_ratio(i3)
    rest = 2.0 * d * s + (d - 1.0) * (d + 1.0)
    sine = math.sqrt((limit - d) * (d + 1.0 / limit) * rest)
    return 2.0 * math.atan2(sine, (d - 1.0) * (d + 1.0))
