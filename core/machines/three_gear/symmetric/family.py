"""Synthesis of the three-gear four-bar with I = 1: frame ratio and links of the symmetric family.

Crank and output gear have equal teeth and b = c. With the crank as unit the family has the frame ratio d > 1 and
coupler and rocker b = c = sqrt((1 + d^2)/2); the angle between them then swings symmetrically about 90 deg,
cos(gamma) = k cos(phi) with k = 2d/(1 + d^2), and the speed ratio of the output is

    W = 1 + 2 d (1 - i3) sin(phi)/sqrt((d^2 - 1)^2 + (2 d sin(phi))^2)

Angles of back-step and dwell stand in `gearlink.core.machines.three_gear.symmetric.back_step`, other teeth in
`gearlink.core.machines.three_gear.dwell.momentary_dwell`.
"""

from __future__ import annotations

import math
from typing import Any, NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.elementary import SCALARS, Elementary
from gearlink.core.parts.linkages.fourbar.position import FourBar


class SpeedLimits(NamedTuple):
    """Greatest and least output speed per input speed."""

    greatest: Any
    least: Any


def frame_ratio_for_back_step(i3: float, back_step_crank_angle: float) -> float:
    """Frame ratio d that gives a wanted crank angle of the back-step.

    d = s cos(h) + sqrt(s^2 cos^2(h) + 1),   s = sqrt(i3 (i3 - 2)),   h = phi12/2

    Parameters
        i3 : float - ratio of idler and output gear, -z3/z5, negative
        back_step_crank_angle : float [rad] - phi12, crank angle between the two standstills, 0 <= phi12 < pi;
            0 is the momentary dwell
    Returns
        frame_ratio : float - frame over crank, above 1
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Example
        >>> round(frame_ratio_for_back_step(-1.8, math.radians(90.0)), 13)
        3.9517038050536

    Source
        thesis (4-18)
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    found: float = frame_ratio(i3, 0.5 * back_step_crank_angle)
    return found


def frame_ratio(i3: Any, h: Any, fn: Elementary = SCALARS) -> Any:
    """d of a back-step over 2 h, as `frame_ratio_for_back_step`, of numbers or of arrays."""
    sc = fn.sqrt(i3 * (i3 - 2.0)) * fn.cos(h)
    return sc + fn.hypot(sc, 1.0)


def frame_ratio_for_speed_band(i3: float, lowest_speed: float, highest_speed: float) -> float:
    """Frame ratio d that makes the output run between two speeds, the input turning at their mean.

    d = q + sqrt(q^2 - 1),   q = 2 (1 - i3)/delta,   delta = 2 (n_max - n_min)/(n_max + n_min)

    Parameters
        i3 : float - negative
        lowest_speed, highest_speed : float [any unit of speed] - 0 <= n_min < n_max; 0 is the momentary dwell
    Returns
        frame_ratio : float - above 1
    Raises
        NoSolution - for i3 >= 0, n_min < 0 or n_max <= n_min
    Example
        >>> round(frame_ratio_for_speed_band(-1.05, 100.0, 300.0), 14)
        8.07617907041421

    Source
        thesis (4-20)
    """
    check_ratio(i3)
    low, high = lowest_speed, highest_speed
    if not (0.0 <= low < high < math.inf):
        raise NoSolution(
            f"no speed band from {low:.9g} to {high:.9g} rev/min: the output of this synthesis turns one way, so the "
            "lower speed must not be below 0 and the upper one must be above it"
        )
    found: float = frame_ratio_between(i3, low, high)
    return found


def frame_ratio_between(i3: Any, low: Any, high: Any, fn: Elementary = SCALARS) -> Any:
    """d of a speed band, as `frame_ratio_for_speed_band`, of numbers or of arrays."""
    q = (1.0 - i3) * ((high + low) / (high - low))
    return q + fn.sqrt((q - 1.0) * (q + 1.0))


def speed_ratio_limits(i3: Any, frame_ratio: Any) -> SpeedLimits:
    """Greatest and least speed ratio of the output, taken at the crank angles 90 and 270 deg.

    W_max, W_min = 1 +- 2 (1 - i3) d/(d^2 + 1)

    Parameters
        i3, frame_ratio : float or array - i3 < 0, d > 1
    Returns
        W_max, W_min : SpeedLimits
    Example
        >>> [round(w, 12) for w in speed_ratio_limits(-1.05, 8.07617907041421)]
        [1.5, 0.5]

    Source
        thesis (4-13)
    """
    swing = 2.0 * (1.0 - i3) * frame_ratio / (frame_ratio * frame_ratio + 1.0)
    return SpeedLimits(1.0 + swing, 1.0 - swing)


def peak_acceleration_ratio(i3: float, frame_ratio: float) -> float:
    """Greatest acceleration ratio of the output, taken at the crank angles 0 and 180 deg.

    |e5|max/w1^2 = 2 (1 - i3) d/(d^2 - 1)

    Raises
        NoSolution - for i3 >= 0 or d <= 1
    Example
        >>> round(peak_acceleration_ratio(-1.8, 3.951703805053557), 12)
        1.51406659722

    Source
        thesis (4-13), differentiated
    """
    check_ratio(i3)
    _check_frame_ratio(frame_ratio)
    return 2.0 * (1.0 - i3) * frame_ratio / ((frame_ratio - 1.0) * (frame_ratio + 1.0))


def symmetric_linkage(frame_ratio: float, center_distance: float, assembly: int = 1) -> FourBar:
    """Four-bar of the family from its frame ratio and the gears' centre distance.

    b = c = m (z1 + z3)/2,   a = b/sqrt((1 + d^2)/2),   frame = d a

    Parameters
        frame_ratio : float - d > 1
        center_distance : float [mm] - of gears 1 and 3, which is that of 3 and 5
        assembly : +1 or -1
    Returns
        linkage : FourBar [mm] - a crank-rocker for every d > 1
    Raises
        NoSolution - for d <= 1
    Example
        >>> linkage = symmetric_linkage(3.951703805053557, 112.0)
        >>> round(linkage.crank, 9), round(linkage.frame, 9)
        (38.857089061, 153.551706697)

    Source
        thesis (4-10)
    """
    _check_frame_ratio(frame_ratio)
    crank = crank_length(frame_ratio, center_distance)
    return FourBar(crank, center_distance, center_distance, frame_ratio * crank, assembly)


def crank_length(d: Any, center_distance: Any, fn: Elementary = SCALARS) -> Any:
    """a of `symmetric_linkage`, of numbers or of arrays."""
    return center_distance / fn.sqrt(0.5 * (1.0 + d * d))


def check_ratio(i3: float) -> None:
    """Refuse a ratio of idler and output gear that is not an external mesh's."""
    if not -math.inf < i3 < 0.0:
        raise NoSolution(f"i3 is {i3:.9g}; idler and output gear mesh externally, so i3 = -z3/z5 must be negative")


def check_back_step_crank_angle(phi12: float) -> None:
    """Refuse a crank angle of the back-step outside [0, pi)."""
    if not 0.0 <= phi12 < math.pi:
        raise NoSolution(
            f"the crank angle of the back-step is {math.degrees(phi12):.9g} deg; it must lie from 0 (momentary "
            "dwell) to below 180 deg"
        )


def _check_frame_ratio(d: float) -> None:
    if not 1.0 < d < math.inf:
        raise NoSolution(f"the frame ratio is {d:.9g}; frame/crank must be above 1 (at 1 the linkage folds flat)")
