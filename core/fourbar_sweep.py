"""The four-bar linkage over arrays of crank angles: one tangent a position, in blocks that stay in the cache."""

from __future__ import annotations

import math
from dataclasses import dataclass, fields

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core import fourbar
from gearlink.core.errors import NoSolution
from gearlink.core.fourbar import FourBar

Array = NDArray[np.float64]

BLOCK = 8192
_NOT_ASKED: Array = np.empty(0)
_NOT_ASKED.flags.writeable = False


@dataclass(frozen=True, slots=True)
class FourBarSweep:
    """Four-bar over crank angles: the fields of `fourbar.FourBarState` as arrays of the shape of the angles.

    Rates that were not asked for are empty arrays.
    """

    coupler_angle: Array
    rocker_angle: Array
    transmission_angle: Array
    coupler_velocity: Array = _NOT_ASKED
    rocker_velocity: Array = _NOT_ASKED
    coupler_acceleration: Array = _NOT_ASKED
    rocker_acceleration: Array = _NOT_ASKED
    coupler_jerk: Array = _NOT_ASKED
    rocker_jerk: Array = _NOT_ASKED


@dataclass(frozen=True, slots=True)
class FourBarInverseSweep:
    """Four-bar over rocker angles, the rocker driving: `fourbar.FourBarInverseState` as arrays."""

    crank_angle: Array
    coupler_angle: Array
    transmission_angle: Array
    crank_velocity: Array = _NOT_ASKED
    coupler_velocity: Array = _NOT_ASKED
    crank_acceleration: Array = _NOT_ASKED
    coupler_acceleration: Array = _NOT_ASKED
    crank_jerk: Array = _NOT_ASKED
    coupler_jerk: Array = _NOT_ASKED


def _solve_each(linkage: FourBar, phi: Array, order: int) -> Array:
    rows = np.empty((3 + 2 * order, phi.size))
    for i, x in enumerate(phi.ravel()):
        state = fourbar.solve(linkage, float(x), order)
        rows[:, i] = [getattr(state, f.name) for f in fields(state)][: 3 + 2 * order]
    return rows
