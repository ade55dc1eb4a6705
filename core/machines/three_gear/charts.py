"""Design charts of the symmetric family (I = 1).

The formulas, and what each quantity means, stand in `gearlink.core.machines.three_gear.symmetric`. Arguments broadcast;
where a design does not exist, the curve of a dwell has a gap: not a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short, unlike
from gearlink.core.machines.three_gear import symmetric
from gearlink.core.machines.three_gear.dwell import Output
from gearlink.core.machines.three_gear.train import GearTrain
from gearlink.core.numerics.arrays import Reals, where_it_exists
from gearlink.core.numerics.elementary_sweep import ARRAYS

_SERIES_BELOW = 0.25  # tan h; a chart does with fewer terms than `symmetric`
FRAME_TOLERANCE = math.radians(0.5)
"""Tolerance of the chart over the frame."""


def frame_ratio_at_crank_angle(i3: ArrayLike, back_step_crank_angle: ArrayLike) -> Reals:
    """Frame ratio d over i3 at constant crank angle of the back-step.

    d = s cos(h) + sqrt(s^2 cos^2(h) + 1),   s = sqrt(i3 (i3 - 2)),   h = phi12/2

    Parameters
        i3 : array [1] - negative
        back_step_crank_angle : array [rad] - phi12, 0 <= phi12 < pi
    Returns
        frame_ratio : array [1] - above 1
    Raises
        NoSolution - for a value outside its range
    Example
        >>> frame_ratio_at_crank_angle([-1.0, -2.0], np.radians(90.0)).round(6).tolist()
        [2.805884, 4.236068]

    Source
        thesis (4-18)
    """
    ratio, h = _ratios(i3), _half_angles(back_step_crank_angle)
    return np.asarray(symmetric.frame_ratio(ratio, h, ARRAYS))


def back_step_at_crank_angle(i3: ArrayLike, back_step_crank_angle: ArrayLike) -> Reals:
    """Back-step of the output over i3 at constant crank angle of the back-step, as a magnitude.

    |phi5(2) - phi5(1)| = 2 n atan(tan(h)/n) - 2 h,   n = 1 - i3,   h = phi12/2

    Parameters
        i3 : array [1] - negative
        back_step_crank_angle : array [rad] - phi12, 0 <= phi12 < pi
    Returns
        angle : array [rad]
    Raises
        NoSolution - for a value outside its range
    Example
        >>> np.degrees(back_step_at_crank_angle([-1.0, -2.0], np.radians(120.0))).round(6).tolist()
        [43.573579, 60.0]

    Source
        thesis (4-19), figure 4-5
    """
    ratio, h = np.broadcast_arrays(_ratios(i3), _half_angles(back_step_crank_angle))
    v, t = ratio / (ratio - 1.0), np.tan(h)
    x = 1.0 - v
    large = np.maximum(t, _SERIES_BELOW)
    plain = v * np.arctan(large * x) / x - np.arctan(v / (1.0 / large + x * large))
    return np.where(t < _SERIES_BELOW, _series(v, np.minimum(t, _SERIES_BELOW)), 2.0 * plain)


def _series(v: Reals, t: Reals) -> Reals:
    log_x = np.log1p(-v)
    total = np.zeros_like(t)
    for j in range(14, 0, -1):
        total += (-1.0) ** j * t ** (2 * j + 1) / (2 * j + 1) * np.expm1(2 * j * log_x)
    return 2.0 * total


def speed_swing_share(frame_ratio: ArrayLike) -> Reals:
    """The share y of the frame ratio in the swing of the speed: W_max, W_min = 1 +- 2 (1 - i3) y.

    y = d/(d^2 + 1)

    Parameters
        frame_ratio : array [1] - d, at least 1 (there the linkage folds flat and y = 1/2)
    Returns
        share : array [1] - at most 1/2; the output stops where it is 1/(2 (1 - i3)) or more
    Raises
        NoSolution - for d < 1
    Example
        >>> speed_swing_share([1.0, 2.0, 3.0]).tolist()
        [0.5, 0.4, 0.3]

    Source
        thesis (4-13), figure 4-4
    """
    d = np.asarray(frame_ratio, dtype=float)
    wrong = ~((d >= 1.0) & (d < np.inf))
    if np.any(wrong):
        raise NoSolution(
            f"frame over crank: {unlike(float(d[wrong].flat[0]), 1.0)} (limit >= 1, where the linkage folds flat)",
            fix="begin the range at 1",
        )
    return np.asarray(1.0 / (d + 1.0 / d))


def frame_ratio_at_nonuniformity(i3: ArrayLike, nonuniformity: ArrayLike) -> Reals:
    """Frame ratio d over i3 at constant nonuniformity of the output speed.

    d = q + sqrt(q^2 - 1),   q = 2 (1 - i3)/delta,   delta = 2 (W_max - W_min)/(W_max + W_min)

    Parameters
        i3 : array [1] - negative
        nonuniformity : array [1] - 0 < delta < 2 (1 - i3); at 2 the output just stops, above it steps back
    Returns
        frame_ratio : array [1] - above 1; not a number where this i3 does not reach the nonuniformity
    Raises
        NoSolution - for a nonuniformity that is not positive, and where no i3 reaches it
    Example
        >>> frame_ratio_at_nonuniformity(-1.0, [1.0, 2.0]).round(6).tolist()
        [7.872983, 3.732051]

    Source
        thesis (4-20), figure 4-6
    """
    ratio, delta = np.broadcast_arrays(_ratios(i3), np.asarray(nonuniformity, dtype=float))
    wrong = ~((delta > 0.0) & (delta < 2.0 * (1.0 - ratio)))
    if np.any(~(delta > 0.0)) or np.all(wrong):
        at, value = float(ratio[wrong].flat[0]), float(delta[wrong].flat[0])
        raise NoSolution(
            f"nonuniformity: {unlike(value, 2.0 * (1.0 - at))} (above 0, below 2 (1 - i3) = "
            f"{unlike(2.0 * (1.0 - at), value)}; i3 {short(at)})",
            fix="reduce the nonuniformity, or use an idler of more teeth",
        )
    q = np.where(wrong, np.nan, 2.0 * (1.0 - ratio) / delta)
    return np.asarray(q + np.sqrt((q - 1.0) * (q + 1.0)))


def _ratios(i3: ArrayLike) -> Reals:
    return _checked(i3, symmetric.check_ratio)


def _half_angles(back_step_crank_angle: ArrayLike) -> Reals:
    return 0.5 * _checked(back_step_crank_angle, symmetric.check_back_step_crank_angle)


def _checked(values: ArrayLike, check: Callable[[float], None]) -> Reals:
    found = np.asarray(values, dtype=float)
    for value in found.flat:
        check(float(value))
    return found


def window_over_ratio(i3: ArrayLike, tolerance: float) -> Reals:
    """Longest window over i3 at constant tolerance.

    Parameters
        i3 : array [1] - negative
        tolerance : float [rad]
    Returns
        window : array [rad]
    Example
        >>> np.degrees(window_over_ratio([-1.8, -2.0], math.radians(1.0))).round(6).tolist()
        [88.177957, 87.702903]
    """
    return where_it_exists(lambda ratio: symmetric.longest_window(ratio, tolerance), i3)


def window_over_tolerance(tolerance: ArrayLike, i3: float) -> Reals:
    """Longest window over the tolerance at constant i3.

    Parameters
        tolerance : array [rad]
        i3 : float [1] - negative
    Returns
        window : array [rad]
    Example
        >>> np.degrees(window_over_tolerance(np.radians([0.5, 1.0]), -1.8)).round(6).tolist()
        [70.436492, 88.177957]
    """
    return where_it_exists(lambda band: symmetric.longest_window(i3, band), tolerance)


def window_over_frame(frame_ratio: ArrayLike, i3: float) -> Reals:
    """Window within +-0.5 deg over the frame ratio at constant i3: it rises to its longest, and falls at once.

    Parameters
        frame_ratio : array [1] - d, above 1
        i3 : float [1] - negative
    Returns
        window : array [rad]
    Notes
        The longest window is that of the frame whose back-step fills the band; a little shorter a frame, and the
        back-step exceeds it.
    Example
        >>> np.degrees(window_over_frame([5.178349, 5.1783], -1.8)).round(3).tolist()
        [70.436, 52.478]
    """

    def window(ratio: float) -> float:
        linkage, train = symmetric.symmetric_linkage(ratio, 1.0), GearTrain(1.0, -i3, 1.0)
        return Output(linkage, train).within(FRAME_TOLERANCE).crank_angle

    return where_it_exists(window, frame_ratio)
