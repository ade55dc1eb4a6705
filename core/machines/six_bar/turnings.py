"""Extremes of the output of a geared six-bar over its course."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots import sign_changes
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.parts.linkages.standstills import Turning, standing

Function = Callable[[Reals], Reals]


def zeros(f: Function, grid: Reals) -> list[float]:
    """Zeros of a function of arrays at which its sign changes on a grid; two within one step are missed.

    Raises
        NoSolution - where the function is no number, as in a dead centre
    Example
        >>> [round(x, 12) for x in zeros(np.cos, np.linspace(0.0, 6.0, 100))]
        [1.570796326795, 4.712388980385]
    """
    values = f(grid)
    places = np.array(sign_changes(values.tolist()), dtype=int)
    if not places.size:
        return []
    return _between(f, grid[places], grid[places + 1], (values[places], values[places + 1]))


def standstills(f: Function, extremes: list[Turning], tolerance: float, period: float | None) -> list[float]:
    """Input angles at which a speed ratio is zero, touching zeros among them, ascending.

    Parameters
        f : function of arrays of input angles [rad]
        extremes, tolerance, period : as of `standing`
    Example
        >>> f, grid = (lambda x: 1.0 + 2.0 * np.sin(x)), np.linspace(0.0, 2.0 * np.pi, 100)
        >>> found = standstills(f, turnings(f, np.cos, grid, False), 1e-9, 2.0 * np.pi)
        >>> np.degrees(found).round(9).tolist()
        [210.0, 330.0]
    """
    places, between = standing(extremes, tolerance, period)
    if between:
        (low, high), ends = np.array(between).transpose(2, 1, 0)
        places += _between(f, low, high, (ends[0], ends[1]))
    return sorted(place if period is None else place % period for place in places)


def _between(f: Function, low: Reals, high: Reals, ends: tuple[Reals, Reals]) -> list[float]:
    found = bracketed_roots(f, low, high, ends=ends)
    if np.isnan(found).any():
        at = float(np.degrees(low[np.isnan(found)][0]))
        raise NoSolution(
            f"the six-bar has no rates next to the input angle {at:.6g} deg: it stands in a dead centre there"
        )
    return [float(x) for x in found]


def turnings(f: Function, slope: Function, grid: Reals, ends: bool) -> list[Turning]:
    """Extremes of a function by the zeros of its derivative, and its values at both ends where they count.

    Example
        >>> [round(t.value, 12) for t in turnings(np.sin, np.cos, np.linspace(0.0, 6.0, 100), False)]
        [1.0, -1.0]
    """
    places = zeros(slope, grid)
    places = sorted({*places, float(grid[0]), float(grid[-1])}) if ends or not places else places
    return [Turning(place, value) for place, value in zip(places, f(np.array(places)).tolist(), strict=True)]
