"""Design charts of the dwell within a tolerance, of the symmetric three-gear four-bar (I = 1), over arrays.

Where a design does not exist, the curve has a gap: not a number.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell.tolerance_dwell import tolerance_dwell
from gearlink.core.machines.three_gear.motion import GearTrain
from gearlink.core.machines.three_gear.symmetric.family import symmetric_linkage
from gearlink.core.machines.three_gear.symmetric.window_dwell import longest_window
from gearlink.core.numerics.arrays import Reals

FRAME_TOLERANCE = math.radians(0.5)
"""Tolerance of the chart over the frame."""


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
    return _each(lambda ratio: longest_window(ratio, tolerance), i3)


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
    return _each(lambda band: longest_window(i3, band), tolerance)


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
        linkage, train = symmetric_linkage(ratio, 1.0), GearTrain(1.0, -i3, 1.0)
        return tolerance_dwell(linkage, train, FRAME_TOLERANCE).crank_angle

    return _each(window, frame_ratio)


def _each(function: Callable[[float], float], values: ArrayLike) -> Reals:
    def value(x: float) -> float:
        try:
            return function(x)
        except NoSolution:
            return math.nan

    return np.array([value(float(x)) for x in np.atleast_1d(np.asarray(values, dtype=float))])
