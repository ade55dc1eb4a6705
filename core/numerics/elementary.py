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
