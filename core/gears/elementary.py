"""The functions that formulas of gears are made of, for one number; `elementary_sweep` has the same for arrays.

A formula stands once, in the class of one pair; the class of many pairs exchanges these functions for the others.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.gears.involute import involute, involute_rise, rise_of_involute

One = Callable[[float], float]
Two = Callable[[float, float], float]


@dataclass(frozen=True, slots=True)
class Elementary:
    """Functions of numbers, or of arrays element by element.

    Parameters
        sin, cos, tan, asin, atan, sqrt, hypot, atan2, copysign, floor : as in `math`
        turn : exp(i angle); phase : direction of a complex number
        least, greatest : of two; where : the second where the first holds, else the third
        involute, involute_rise, rise_of_involute : as in `gearlink.core.gears.involute`
    """

    sin: One
    cos: One
    tan: One
    asin: One
    atan: One
    sqrt: One
    hypot: Two
    atan2: Two
    copysign: Two
    floor: Callable[[float], int]
    turn: Callable[[float], complex]
    phase: Callable[[complex], float]
    least: Two
    greatest: Two
    where: Callable[[bool, float, float], float]
    involute: One
    involute_rise: Two
    rise_of_involute: Two


SCALARS = Elementary(
    sin=math.sin,
    cos=math.cos,
    tan=math.tan,
    asin=math.asin,
    atan=math.atan,
    sqrt=math.sqrt,
    hypot=math.hypot,
    atan2=math.atan2,
    copysign=math.copysign,
    floor=math.floor,
    turn=lambda angle: cmath.exp(1j * angle),
    phase=cmath.phase,
    least=min,
    greatest=max,
    where=lambda holds, one, other: one if holds else other,
    involute=involute,
    involute_rise=involute_rise,
    rise_of_involute=rise_of_involute,
)
