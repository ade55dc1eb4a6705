"""First halves of the polynomial laws, with closed forms of their peaks."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from gearlink.core.cams.first_half import FirstHalf, Piece


def _polynomial(*parts: Callable[[Any], Any]) -> Piece:
    """A piece from the integral, the rise and its derivatives, each a function of x."""

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        return tuple(part(x) for part in parts[low + 1 : high + 2])

    return piece


def _polynomial_half(piece: Piece, velocity: float, acceleration: float, jerk: float, power: float) -> FirstHalf:
    return FirstHalf(((0.5, piece),), velocity, acceleration, jerk, power)


# The parts are factored in w = x(1 - x) where that saves cancellation; the sixth is the fourth derivative, which
# only the peak jerk of the free laws asks for.
POLYNOMIAL_123 = _polynomial_half(
    _polynomial(
        lambda x: x**3 * (1.0 - 0.5 * x),
        lambda x: x * x * (3.0 - 2.0 * x),
        lambda x: 6.0 * x * (1.0 - x),
        lambda x: 6.0 * (1.0 - 2.0 * x),
        lambda x: -12.0 + 0.0 * x,
        lambda x: 0.0 * x,
    ),
    velocity=1.5,
    acceleration=6.0,
    jerk=12.0,
    power=2.0 * math.sqrt(3.0),
)
POLYNOMIAL_345 = _polynomial_half(
    _polynomial(
        lambda x: x**4 * (2.5 - x * (3.0 - x)),
        lambda x: x**3 * (10.0 - x * (15.0 - 6.0 * x)),
        lambda x: 30.0 * (x * (1.0 - x)) ** 2,
        lambda x: 60.0 * x * (1.0 - x) * (1.0 - 2.0 * x),
        lambda x: 60.0 * (1.0 - 6.0 * x * (1.0 - x)),
        lambda x: -360.0 * (1.0 - 2.0 * x),
    ),
    velocity=15.0 / 8.0,
    acceleration=10.0 / math.sqrt(3.0),
    jerk=60.0,
    power=1800.0 / 64.0 * (6.0 / 7.0) ** 3 / math.sqrt(7.0),
)
POLYNOMIAL_4567 = _polynomial_half(
    _polynomial(
        lambda x: x**5 * (7.0 - x * (14.0 - x * (10.0 - 2.5 * x))),
        lambda x: x**4 * (35.0 - x * (84.0 - x * (70.0 - 20.0 * x))),
        lambda x: 140.0 * (x * (1.0 - x)) ** 3,
        lambda x: 420.0 * (x * (1.0 - x)) ** 2 * (1.0 - 2.0 * x),
        lambda x: 840.0 * x * (1.0 - x) * (1.0 - 5.0 * x * (1.0 - x)),
        lambda x: 840.0 * (1.0 - 2.0 * x) * (1.0 - 10.0 * x * (1.0 - x)),
    ),
    velocity=35.0 / 16.0,
    acceleration=84.0 * math.sqrt(5.0) / 25.0,
    jerk=52.5,
    power=58800.0 / 1024.0 * (10.0 / 11.0) ** 5 / math.sqrt(11.0),
)
