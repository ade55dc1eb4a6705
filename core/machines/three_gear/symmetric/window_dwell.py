"""Dwell of the symmetric three-gear four-bar (I = 1) within a tolerance: the longest, the flattest, and the frames
that meet both.

The output stays within +-tau of a place that is free to choose. The crank angle of that, the window, is longest where
the back-step D equals the whole band 2 tau: the output then touches both edges twice, as a Chebyshev polynomial does.
With n = 1 - i3, half the crank angle h of the back-step and half the window Y,

    D(h) = 2 tau,   phi5(270 deg + Y) - phi5(270 deg - h) = 0,   window = 2 Y = 2 phi13 - phi12

which for tau -> 0 is 4/3 of phi13 and 4^(1/3) = 1.59 times the window of the momentary dwell. A back-step that exceeds
the band by a last bit leaves only phi13 of it: the window jumps there, so no design aims at the limit itself.
"""

from __future__ import annotations

import math
from functools import lru_cache

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.machines.three_gear.symmetric.back_step import (
    back_step_angle,
    crank_angle_for_back_step,
    crank_angle_for_window,
    dwell_angle,
    window_limit,
)
from gearlink.core.machines.three_gear.symmetric.family import check_ratio, frame_ratio_for_back_step
from gearlink.core.numerics.roots import bracketed_root, maximum

_INSIDE = 1e-9
_NEAREST, _FARTHEST = 0.1, 1e3  # -i3 between which the greatest idler is sought


def longest_window(i3: float, tolerance: float) -> float:
    """Longest crank angle over which the output of given gears can stay within +- tolerance.

    window = 2 phi13 - phi12   of the mechanism whose back-step is 2 tau

    Parameters
        i3 : float - negative
        tolerance : float [rad] - tau, 0 < tau < min(pi, -i3 pi/2)
    Returns
        window : float [rad]
    Raises
        NoSolution - for a tolerance outside the range
    Notes
        Rises with the tolerance; falls with -i3 (an idler of more teeth) for narrow bands, see `reaching_ratios`.
    Example
        >>> round(math.degrees(longest_window(-1.8, math.radians(0.5))), 9)
        70.436491503

    Source
        own derivation: phi5 is odd about 270 deg and convex behind it, so no other frame has a longer window
    """
    phi12 = crank_angle_for_tolerance(i3, tolerance)
    return 2.0 * dwell_angle(i3, phi12) - phi12


def crank_angle_for_tolerance(i3: float, tolerance: float) -> float:
    """Crank angle phi12 of the back-step that fills the band: the mechanism of the longest window.

    Parameters
        i3 : float - negative
        tolerance : float [rad] - tau, 0 < tau < min(pi, -i3 pi/2)
    Returns
        phi12 : float [rad]
    Raises
        NoSolution - for a tolerance outside the range
    Example
        >>> round(math.degrees(crank_angle_for_tolerance(-1.8, math.radians(0.5))), 9)
        35.243222439
    """
    check_tolerance(i3, tolerance)
    return crank_angle_for_back_step(i3, 2.0 * tolerance)


def check_tolerance(i3: float, tolerance: float) -> None:
    """Refuse a tolerance that has no longest window.

    Raises
        NoSolution - naming the limit
    """
    check_ratio(i3)
    if not (tolerance > 0.0 and fills(i3, tolerance)):
        limit = min(math.pi, -0.5 * i3 * math.pi)
        raise NoSolution(
            f"a tolerance of {_deg(tolerance)} deg has no longest window with i3 = {i3:.9g}: it must lie above 0 and "
            f"below {_deg(limit)} deg; reduce it"
        )


def least_tolerance(i3: float, window: float) -> float:
    """Least tolerance within which the output of given gears can stay over a window.

    Parameters
        i3 : float - negative
        window : float [rad] - below `window_limit`
    Returns
        tolerance : float [rad] - half the back-step of the flattest mechanism
    Raises
        NoSolution - for a window outside the range
    Example
        >>> round(math.degrees(least_tolerance(-1.8, math.radians(90.0))), 12)
        1.065660185005
    """
    return 0.5 * back_step_angle(i3, crank_angle_for_window(i3, window))


def frame_ratio_interval(i3: float, window: float, tolerance: float) -> tuple[float, float]:
    """Ratios of frame to crank between which the output stays within +- tolerance over a window.

    k_L from the back-step 2 tau,   k_X = sin((Phi/2 - tau)/n)/sin(Phi/2),   d = (1 + sqrt(1 - k^2))/k

    Parameters
        i3 : float - negative
        window : float [rad] - Phi, above 2 tau
        tolerance : float [rad] - tau, at least `least_tolerance`
    Returns
        low, high : float, float - at low the back-step fills the band (1 where none does: there the linkage folds, and
            does not turn), at high both ends of the window lie on its edges
    Raises
        NoSolution - where no frame meets both, or a linkage that turns evenly does
    Notes
        The window jumps at low, never at high: aim between.
    Example
        >>> low, high = frame_ratio_interval(-1.8, math.radians(60.0), math.radians(0.5))
        >>> round(low, 9), round(high, 9)
        (5.178348984, 5.279603809)
    """
    if not window > 2.0 * tolerance:
        raise NoSolution(
            f"an even motion stays within +-{_deg(tolerance)} deg over {_deg(2.0 * tolerance)} deg of the crank: a "
            f"window of {_deg(window)} deg needs no linkage; ask for a longer one"
        )
    check_reach(i3, window, tolerance)
    k = math.sin((0.5 * window - tolerance) / (1.0 - i3)) / math.sin(0.5 * window)
    high = (1.0 + math.sqrt((1.0 - k) * (1.0 + k))) / k
    if not fills(i3, tolerance):
        return 1.0, high
    return min(frame_ratio_for_back_step(i3, crank_angle_for_tolerance(i3, tolerance)), high), high


def reach(i3: float, tolerance: float) -> float:
    """The windows that given gears have a flattest mechanism for within a tolerance lie below this or, where a
    back-step fills the band, are this at most.

    Parameters
        i3 : float - negative
        tolerance : float [rad] - below pi
    Returns
        window : float [rad] - `longest_window`; `window_limit` where every back-step is narrower than the band
    """
    return longest_window(i3, tolerance) if fills(i3, tolerance) else window_limit(i3)


def fills(i3: float, tolerance: float) -> bool:
    """Whether a back-step of given gears fills the band of a tolerance [rad]: below -i3 pi/2, half of the greatest."""
    return tolerance < min(math.pi, -0.5 * i3 * math.pi)


def check_reach(i3: float, window: float, tolerance: float) -> None:
    """Refuse a window that no frame of given gears reaches within a tolerance.

    Raises
        NoSolution - naming the longest window, the least tolerance and the nearest idler ratio
    """
    longest = reach(i3, tolerance)
    if window < longest or (window == longest and fills(i3, tolerance)):
        return
    at_most = "at most over" if fills(i3, tolerance) else "only below"
    words = f"{at_most} {safely_below(math.degrees(longest))} deg"
    if window < window_limit(i3):
        words += f", or within +-{safely_above(math.degrees(least_tolerance(i3, window)))} deg; ask for one of these"
    else:
        words += "; ask for that"
    raise NoSolution(
        f"the output cannot stay within +-{_deg(tolerance)} deg over {_deg(window)} deg with i3 = {i3:.9g}: {words}"
        f"{_other_idler(i3, window, tolerance)}"
    )


def _other_idler(i3: float, window: float, tolerance: float) -> str:
    """The idler that reaches a window which this one does not, in words; empty where none does."""
    ratios = reaching_ratios(window, tolerance)
    if ratios is None:
        return ""
    if -i3 < ratios[0]:
        return f", or take -i3 of at least {safely_above(ratios[0])} (a larger idler)"
    return f", or take -i3 of at most {safely_below(ratios[1])} (a smaller idler)"


@lru_cache
def reaching_ratios(window: float, tolerance: float) -> tuple[float, float] | None:
    """Least and greatest -i3 with which the output can stay within +- tolerance over a window.

    Parameters
        window, tolerance : float [rad]
    Returns
        low, high : float - idler teeth over output teeth, from 0.1 up; infinite where every greater ratio will do
        or None where none from 0.1 to 1000 does
    Notes
        The reach rises with -i3 up to a maximum, which lies at -i3 = 0.15 for a tolerance of 10 deg, at 2 for 30 deg
        and at infinity from 32 deg on, and falls from there. Kept, for where an idler is sought all that are refused
        ask for it.
    Example
        >>> round(reaching_ratios(math.radians(70.0), math.radians(0.5))[1], 6)
        2.020462
        >>> reaching_ratios(math.radians(60.0), math.radians(0.5))
        (0.1, inf)
        >>> [round(ratio, 6) for ratio in reaching_ratios(math.radians(218.0), math.radians(20.0))]
        [0.264135, 1.043444]
    """

    def spare(logarithm: float) -> float:
        return reach(-math.exp(logarithm), tolerance) - window

    nearest, farthest = math.log(_NEAREST), math.log(_FARTHEST)
    best, most = maximum(spare, nearest, farthest)
    if most < 0.0:
        return None
    low, high = _NEAREST, _FARTHEST
    if spare(nearest) < 0.0:
        low = math.exp(bracketed_root(spare, nearest, best)) * (1.0 + _INSIDE)  # where no band is filled it is none yet
    if window <= window_of_large_idler(tolerance):
        high = math.inf
    elif spare(farthest) < 0.0:
        high = math.exp(bracketed_root(spare, best, farthest))
    return low, high


def window_of_large_idler(tolerance: float) -> float:
    """Longest window within a tolerance that remains for i3 -> -infinity.

    tau = tan(h) - h,   Y - sin(Y)/cos(h) = tau,   window = 2 Y

    Parameters
        tolerance : float [rad] - tau > 0
    Returns
        window : float [rad]
    Example
        >>> round(math.degrees(window_of_large_idler(math.radians(1.0))), 2)
        84.75
    """
    h = bracketed_root(lambda x: math.tan(x) - x - tolerance, 0.0, math.atan(4.0 * tolerance + 4.0))
    y = bracketed_root(lambda x: x - math.sin(x) / math.cos(h) - tolerance, h, math.pi + tolerance)
    return 2.0 * y


def _deg(angle: float) -> str:
    return f"{math.degrees(angle):.9g}"
