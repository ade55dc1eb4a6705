"""Curves of the plane over a parameter."""

from __future__ import annotations

from collections.abc import Callable
from typing import TypeAlias

from gearlink.core.numerics.arrays import Points, Reals, unit_vector

Curve: TypeAlias = Callable[[Reals], Points]


def straight(start: complex, end: complex) -> Curve:
    """A straight line over 0 to 1, whose ends are these points to the bit."""

    def points(share: Reals) -> Points:
        between: Points = (1.0 - share) * start + share * end
        return between

    return points


def arc(radius: float, center: complex = 0.0) -> Curve:
    """A circle over the direction from its centre [rad]; against it with a negative radius."""

    def points(angle: Reals) -> Points:
        return center + radius * unit_vector(angle)

    return points
