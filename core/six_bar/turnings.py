"""Extremes of the output of a geared six-bar over its course."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.standstills import Turning
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots import sign_changes
from gearlink.core.numerics.roots_sweep import bracketed_roots

Function = Callable[[Reals], Reals]


def scalar(f: Function) -> Callable[[float], float]:
    """A function of arrays as one of numbers."""
    return lambda x: float(f(np.array([x]))[0])


def zeros(f: Function, grid: Reals) -> list[float]:
    """Zeros of a function of arrays at which its sign changes on a grid; two within one step are missed.

    Raises
        NoSolution - where the function is no number
    Example
        >>> [round(x, 12) for x in zeros(np.cos, np.linspace(0.0, 6.0, 100))]
        [1.570796326795, 4.712388980385]
    """
    places = np.array(sign_changes(f(grid).tolist()), dtype=int)
    if not places.size:
        return []
    found = bracketed_roots(f, grid[places], grid[places + 1])
    if np.isnan(found).any():
        at = float(grid[places[np.isnan(found)][0]])
        raise NoSolution(f"the function is no number next to {at!r}")
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
