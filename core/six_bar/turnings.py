"""Standstills and extremes of the output of a geared six-bar over its course."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from itertools import pairwise

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.roots import bracketed_root, sign_changes

Function = Callable[[Reals], Reals]


@dataclass(frozen=True, slots=True)
class Turning:
    """An extreme: input angle [rad] and value."""

    place: float
    value: float


def zeros(f: Function, grid: Reals) -> list[float]:
    """Zeros of a function of arrays at which its sign changes on a grid; two within one step are missed.

    Example
        >>> [round(x, 12) for x in zeros(np.cos, np.linspace(0.0, 6.0, 100))]
        [1.570796326795, 4.712388980385]
    """
    values = f(grid)

    def at(x: float) -> float:
        return float(f(np.array([x]))[0])

    return [bracketed_root(at, float(grid[i]), float(grid[i + 1])) for i in sign_changes(values.tolist())]


def turnings(f: Function, slope: Function, grid: Reals, ends: bool) -> list[Turning]:
    """Extremes of a function by the zeros of its derivative, and its values at both ends where they count.

    Example
        >>> [round(t.value, 12) for t in turnings(np.sin, np.cos, np.linspace(0.0, 6.0, 100), False)]
        [1.0, -1.0]
    """
    places = zeros(slope, grid)
    places = sorted({*places, float(grid[0]), float(grid[-1])}) if ends or not places else places
    return [Turning(place, value) for place, value in zip(places, f(np.array(places)).tolist(), strict=True)]


def standstills(f: Function, extremes: list[Turning], tolerance: float, period: float | None) -> list[float]:
    """Zeros of a speed between its extremes, touching ones among them; ascending from 0 where a period is given.

    Example
        >>> found = turnings(np.sin, np.cos, np.linspace(0.0, 6.0, 100), False)
        >>> [round(x, 12) for x in standstills(np.sin, found, 1e-9, None)]
        [3.14159265359]
    """

    def at(x: float) -> float:
        return float(f(np.array([x]))[0])

    places = [t.place for t in extremes if abs(t.value) <= tolerance]
    around = extremes
    if period is not None and extremes:
        around = [*extremes, Turning(extremes[0].place + period, extremes[0].value)]
    for one, other in pairwise(around):
        if min(abs(one.value), abs(other.value)) > tolerance and one.value * other.value < 0.0:
            places.append(bracketed_root(at, one.place, other.place))
    return sorted(place if period is None else place % period for place in places)
