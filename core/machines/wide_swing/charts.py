"""Design charts of the unloading law of a cylinder over the swing: peaks and energy parameter, over arrays."""

from __future__ import annotations

import math
from functools import partial
from typing import Literal

import numpy as np
from numpy.typing import ArrayLike

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.wide_swing.law.device import Pneumatic
from gearlink.core.machines.wide_swing.law.elastic_law import ElasticLaw
from gearlink.core.numerics.arrays import Reals


def peaks(
    name: Literal["velocity_peak", "acceleration_peak", "energy_parameter"], swing: ArrayLike, pivot_ratio: float
) -> Reals:
    """B, C or N of the law over the swing at constant pivot ratio.

    Parameters
        name : which one
        swing : array [rad] - above 0, at most 340 deg
        pivot_ratio : float - lambda, above 1
    Returns
        peak : array [1] - not a number where there is no law
    Example
        >>> velocity_peak(np.radians([120.0]), 2.5).round(9).tolist()
        [1.687523657]
        >>> energy_parameter(np.radians([120.0]), 2.5).round(9).tolist()
        [4.191240425]

    Source
        wide-swing dissertation, chapter 2, (8), (10), (9)
    """

    def value(gamma: float) -> float:
        try:
            return float(getattr(ElasticLaw(Pneumatic(pivot_ratio), gamma), name))
        except NoSolution:
            return math.nan

    return np.array([value(float(gamma)) for gamma in np.atleast_1d(np.asarray(swing, dtype=float))])


velocity_peak = partial(peaks, "velocity_peak")
acceleration_peak = partial(peaks, "acceleration_peak")
energy_parameter = partial(peaks, "energy_parameter")
