"""The slider-crank of a stroke and a time ratio, with a given rod or crank, or the best transmission angle.

Crank pivot D, crank r, rod L, offset e, stroke S, K slow over fast stroke, p = 90 deg (K - 1)/(K + 1). D and both dead
centres of the slider make a triangle of the sides L + r, L - r and S, 2 p at D and e its height:

    (S/2)^2 = r^2 cos^2 p + L^2 sin^2 p,   e = (L^2 - r^2) sin(2 p)/S

The angle at the inner dead centre is obtuse where S/2 < L < (S/2) cot p, that is (S/2) tan p < r < S/2: else the slider
would pass below D, and its strokes would be others.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below


class QuickReturn(NamedTuple):
    """Crank, rod and offset [mm]."""

    crank: float
    rod: float
    offset: float


def quick_return(stroke: float, ratio: float, rod: float | None = None, crank: float | None = None) -> QuickReturn:
    """The slider-crank of a stroke and a time ratio.

    Parameters
        stroke : float [mm]
        ratio : float - K, 1 or more
        rod, crank : float [mm] - at most one of them; without either, the transmission angle is the best there is
    Raises
        NoSolution - with the key, where no slider-crank has this stroke and ratio
    Example
        >>> found = quick_return(310.0, 1.1, rod=520.0)
        >>> round(found.crank, 9), round(found.offset, 9)
        (150.470496796, 119.117766514)

    Source
        own derivation, from the triangle of the dead centres
    """
    p, half = 0.5 * math.pi * (ratio - 1.0) / (ratio + 1.0), 0.5 * stroke
    if p == 0.0 and rod is None:
        message = "strokes of equal time have the crank stroke/2 and no offset, whatever the rod"
        raise NoSolution(message, key="quick_return_ratio", fix="give rod")
    sine, cosine = math.sin(p), math.cos(p)
    if rod is not None:
        _require_within("rod", rod, half, half * cosine / sine if p else math.inf, ratio)
        found = math.sqrt((half - rod * sine) * (half + rod * sine)) / cosine
        return QuickReturn(found, rod, _offset(found, rod, p, stroke))
    if crank is not None:
        _require_within("crank", crank, half * sine / cosine, half, ratio)
        found = math.sqrt((half - crank * cosine) * (half + crank * cosine)) / sine
        return QuickReturn(crank, found, _offset(crank, found, p, stroke))
    return _best(half, p, ratio)


def _best(half: float, p: float, ratio: float) -> QuickReturn:
    """The minimum (r + e)/L, which is the cosine of the minimum transmission angle.

    (S/(2 L))^2 = g = (r/L)^2 cos^2 p + sin^2 p,   g^2 - g sin^2 p - sin^2 p = 0

    Source
        own derivation: the derivative of (r + e)/L by r/L is 0 where g^3 = sin^2 p (g - sin^2 p)(g + 1)^2, of which
        g = tan^2 p belongs to the flat triangle
    """
    if ratio >= 3.0:
        raise NoSolution(
            f"no slider-crank has a time ratio of {ratio:g}", key="quick_return_ratio", fix="specify less than 3"
        )
    sine, cosine = math.sin(p), math.cos(p)
    g = 0.5 * sine * (sine + math.hypot(sine, 2.0))
    rod = half / math.sqrt(g)
    crank = rod * math.sqrt(0.5 * sine * (math.hypot(sine, 2.0) - sine)) / cosine
    return QuickReturn(crank, rod, _offset(crank, rod, p, 2.0 * half))


def _offset(crank: float, rod: float, p: float, stroke: float) -> float:
    return (rod - crank) * (rod + crank) * math.sin(2.0 * p) / stroke


def _require_within(key: str, length: float, low: float, high: float, ratio: float) -> None:
    """Refuse a rod or a crank outside its limits."""
    if low < length < high:
        return
    if not low < high:
        text, fix = f"no {key} gives a time ratio of {ratio:g}, a slider-crank reaches less than 3", "specify less"
    elif length >= high:
        text, fix = f"{key} {length:g} mm is too long for this stroke and ratio", f"stay below {safely_below(high)} mm"
    else:
        text, fix = f"{key} {length:g} mm is too short for this stroke and ratio", f"go above {safely_above(low)} mm"
    raise NoSolution(text, key=key, fix=fix)
