"""The functions that formulas are made of, for one number; `elementary_sweep` has the same for arrays.

A formula that serves one design and many stands once, in the class of one; the class of many exchanges these functions
for the others.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.numerics.roots import newton_root

One = Callable[[float], float]
Two = Callable[[float, float], float]


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Elementary:
    """Functions of numbers, or of arrays element by element.

    Parameters
        sin, cos, tan, asin, acos, atan, sqrt, cbrt, hypot, atan2, copysign, floor : as in `math`
        turn : exp(i angle); phase : direction of a complex number
        round : to so many decimals
        least, greatest : of two; where : the second where the first holds, else the third
        root : of a rising function with its slope, in a bracket from a start on, as `roots.newton_root`
    """

    sin: One = math.sin
    cos: One = math.cos
    tan: One = math.tan
    asin: One = math.asin
    acos: One = math.acos
    atan: One = math.atan
    sqrt: One = math.sqrt
    cbrt: One = math.cbrt
    hypot: Two = math.hypot
    atan2: Two = math.atan2
    copysign: Two = math.copysign
    floor: Callable[[float], int] = math.floor
    round: Callable[[float, int], float] = round
    turn: Callable[[float], complex] = lambda angle: cmath.exp(1j * angle)
    phase: Callable[[complex], float] = cmath.phase
    least: Two = min
    greatest: Two = max
    where: Callable[[bool, float, float], float] = lambda holds, one, other: one if holds else other
    root: Callable[..., float] = newton_root


SCALARS = Elementary()


def triangle_angle(one: float, other: float, opposite: float) -> float:
    """Angle of a triangle between two of its sides.

    4 x y sin^2(angle/2) = z^2 - (x - y)^2, which keeps its digits where the triangle is flat

    Parameters
        one, other, opposite : float - x, y, and the side z opposite to the angle; of any unit
    Returns
        angle : float [rad] - from 0 to pi
    Raises
        ValueError - where no triangle has these sides
    Example
        >>> round(triangle_angle(3.0, 4.0, 5.0), 15)
        1.570796326794897
    """
    aside = one - other
    return 2.0 * math.asin(math.sqrt((opposite - aside) * (opposite + aside) / (4.0 * one * other)))
