"""First half of the SCCA laws: sine, constant and cosine acceleration, then constant velocity."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.cams.first_half import FirstHalf, Piece

_Parts: TypeAlias = tuple[Callable[[], Any], ...]


def scca(a: float, b: float, c: float, d: float) -> FirstHalf:
    """First half of the SCCA law with the shares a (sine), b (constant), c (cosine), d (no acceleration).

    1/A = 2 [(a^2/pi)(1/2 - 1/pi) + a b/(2 pi) + b^2/8 + (a/pi + b/2) c/2 + c^2/pi^2 + ((a + c)/pi + b/2) d/2]

    Parameters
        a, b, c, d : float - shares of the whole rise, >= 0, sum 1 (to 1e-9; they are then divided by their sum)
    Returns
        first_half : FirstHalf - peak_velocity = A ((a + c)/pi + b/2), peak_acceleration = A
    Raises
        NoSolution - a negative share, a sum other than 1, or no acceleration at all (d = 1)
    Notes
        Each piece starts from the end where its rise is flat, so the rise keeps its relative accuracy near 0
        and reaches 1/2 exactly in the middle. Cosine differences are written as squares of half-angle sines.
    Example
        >>> round(scca(0.25, 0.5, 0.25, 0.0).peak_acceleration, 12)
        4.888123762813

    Source
        own derivation: the acceleration integrated piece by piece
    """
    a, b, c, d = _checked_shares(a, b, c, d)
    peak = 0.5 / (
        a * a / math.pi * (0.5 - 1.0 / math.pi)
        + a * b / (2.0 * math.pi)
        + b * b / 8.0
        + (a / math.pi + b / 2.0) * c / 2.0
        + (c / math.pi) ** 2
        + ((a + c) / math.pi + b / 2.0) * d / 2.0
    )
    cruise = peak * ((a + c) / math.pi + b / 2.0)
    before = peak * (a / math.pi + b / 2.0)
    swings = [share for share in (a, c) if share > 0.0]
    return FirstHalf(
        pieces=_pieces(a, b, c, d, peak, cruise),
        peak_velocity=cruise,
        peak_acceleration=peak,
        interior_jerk=peak * math.pi / min(swings) if swings else 0.0,
        peak_power=_peak_power(peak, before, peak * c / math.pi),
        end_jumps=a == 0.0,
        middle_jumps=c == 0.0,
    )


def _checked_shares(a: float, b: float, c: float, d: float) -> tuple[float, float, float, float]:
    shares = (a, b, c, d)
    if not all(share >= 0.0 for share in shares):
        raise NoSolution(f"scca shares {list(shares)} must not be negative", fix="give four shares >= 0 with sum 1")
    total = math.fsum(shares)
    if not abs(total - 1.0) <= 1e-9:
        raise NoSolution(
            f"scca shares {list(shares)} sum to {total:.6g}, not 1", fix=f"change one by {1.0 - total:+.9g}"
        )
    if d >= 1.0:
        raise NoSolution("scca share d = 1 leaves no time to accelerate", fix="keep d below 1 (0.2 to 0.5 is usual)")
    return a / total, b / total, c / total, d / total


def _peak_power(peak: float, before: float, gain: float) -> float:
    # v a grows up to the cosine piece, where v = before + gain sin(z) and a = peak cos(z).
    sine = 2.0 * gain / (before + math.sqrt(before * before + 8.0 * gain * gain))
    return peak * math.sqrt((1.0 - sine) * (1.0 + sine)) * (before + gain * sine)


def _pieces(a: float, b: float, c: float, d: float, peak: float, cruise: float) -> tuple[tuple[float, Piece], ...]:
    end_sine, end_constant, end_cosine = a / 2.0, (a + b) / 2.0, (1.0 - d) / 2.0
    found: list[tuple[float, Piece]] = []
    start = (0.0, 0.0, 0.0)
    if a > 0.0:
        found.append((end_sine, _sine_piece(a, peak)))
        r = a / math.pi
        start = (
            peak * r**3 * (math.pi**2 / 8.0 - 1.0),
            peak * r * r * (math.pi / 2.0 - 1.0),
            peak * r,
        )
    if b > 0.0:
        constant = _parabola(end_sine, (*start, peak))
        found.append((end_constant, constant))
        start = constant(end_constant, -1, 1)
    rise_cosine = 0.5 - cruise * d / 2.0
    area_cosine = start[0]
    if c > 0.0:
        if end_constant == 0.0:
            found.append((c / 4.0, _harmonic_piece(c, peak)))
        w, r = c / 2.0, c / math.pi
        area_cosine += rise_cosine * w - cruise * w * w / 2.0 + peak * r**3 * (math.pi**2 / 8.0 - 1.0)
        found.append((end_cosine, _cosine_piece(c, peak, end_cosine, area_cosine, rise_cosine, cruise)))
    if d > 0.0 or c == 0.0:
        # Measured from the middle, so that the rise is 1/2 there to the last bit.
        area_middle = area_cosine + d / 4.0 - cruise * d * d / 8.0
        found.append((0.5, _parabola(0.5, (area_middle, 0.5, cruise, 0.0 if d > 0.0 else peak))))
    return tuple(found)


def _asked(parts: _Parts, low: int, high: int) -> tuple[Any, ...]:
    return tuple(part() for part in parts[low + 1 : high + 2])


def _sine_piece(a: float, peak: float) -> Piece:
    r = a / math.pi

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        z = x / r
        half = _sin(0.5 * z)
        parts: _Parts = (
            lambda: peak * r**3 * _square_excess(z),
            lambda: peak * r * r * _sine_defect(z),
            lambda: 2.0 * peak * r * half * half,
            lambda: peak * _sin(z),
            lambda: peak / r * (1.0 - 2.0 * half * half),
        )
        return _asked(parts, low, high)

    return piece


def _parabola(origin: float, at_origin: tuple[float, float, float, float]) -> Piece:
    area, rise, velocity, acceleration = at_origin

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        t = x - origin
        parts: _Parts = (
            lambda: area + t * (rise + t * (0.5 * velocity + t * (acceleration / 6.0))),
            lambda: rise + t * (velocity + t * (0.5 * acceleration)),
            lambda: velocity + t * acceleration,
            lambda: acceleration + 0.0 * t,
            lambda: 0.0 * t + 0.0,
        )
        return _asked(parts, low, high)

    return piece


def _harmonic_piece(c: float, peak: float) -> Piece:
    r = c / math.pi

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        z = x / r
        half = _sin(0.5 * z)
        parts: _Parts = (
            lambda: peak * r**3 * _sine_defect(z),
            lambda: 2.0 * peak * r * r * half * half,
            lambda: peak * r * _sin(z),
            lambda: peak * (1.0 - 2.0 * half * half),
            lambda: -peak / r * _sin(z),
        )
        return _asked(parts, low, high)

    return piece


def _cosine_piece(c: float, peak: float, end: float, area: float, rise: float, velocity: float) -> Piece:
    r = c / math.pi

    def piece(x: Any, low: int, high: int) -> tuple[Any, ...]:
        w = end - x
        z = w / r
        half = _sin(0.5 * z)
        parts: _Parts = (
            lambda: area - w * (rise - 0.5 * velocity * w) - peak * r**3 * _square_excess(z),
            lambda: rise - velocity * w + peak * r * r * _sine_defect(z),
            lambda: velocity - 2.0 * peak * r * half * half,
            lambda: peak * _sin(z),
            lambda: -peak / r * (1.0 - 2.0 * half * half),
        )
        return _asked(parts, low, high)

    return piece


def _sin(x: Any) -> Any:
    """Sine of a float (by math) or of an array (by numpy, imported only then)."""
    if isinstance(x, float):
        return math.sin(x)
    import numpy as np

    return np.sin(x)


def _sine_defect(z: Any) -> Any:
    """z - sin z without cancellation."""
    return _near_zero(
        z, 1.0, lambda z: z**3 / 6.0, (20.0, 42.0, 72.0, 110.0, 156.0, 210.0, 272.0), lambda z: z - _sin(z)
    )


def _square_excess(z: Any) -> Any:
    """z^2/2 - 1 + cos z without cancellation."""
    return _near_zero(
        z,
        1.0,
        lambda z: z**4 / 24.0,
        (30.0, 56.0, 90.0, 132.0, 182.0, 240.0, 306.0),
        lambda z: 0.5 * z * z - 2.0 * _sin(0.5 * z) ** 2,
    )


def _near_zero(
    z: Any,
    limit: float,
    leading: Callable[[Any], Any],
    divisors: tuple[float, ...],
    direct: Callable[[Any], Any],
) -> Any:
    def series(z: Any) -> Any:
        y = z * z
        value = 1.0 - y / divisors[-1]
        for divisor in reversed(divisors[:-1]):
            value = 1.0 - y / divisor * value
        return leading(z) * value

    if isinstance(z, float):
        return series(z) if z < limit else direct(z)
    import numpy as np

    near = z < limit
    if not near.any():
        return direct(z)
    return series(z) if near.all() else np.where(near, series(np.minimum(z, limit)), direct(z))
