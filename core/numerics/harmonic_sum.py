"""A constant and a few cosines: squared distances of points that turn evenly about fixed centres."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import lru_cache

from gearlink.core.numerics.roots import bracketed_root, roots_on

_STEPS_PER_WAVE = 40
_MANY = 200  # places from which arrays are faster, numpy's import left aside


@dataclass(frozen=True)
class HarmonicSum:
    """constant + sum of amplitude cos(frequency x + phase).

    Parameters
        terms : tuple of (amplitude, frequency, phase)
    Example
        >>> HarmonicSum(1.0, ((2.0, 3.0, 0.0),)).value(0.0)
        3.0
    """

    constant: float
    terms: tuple[tuple[float, float, float], ...]

    def value(self, x: float) -> float:
        """The sum at x."""
        return math.fsum((self.constant, *(a * math.cos(f * x + p) for a, f, p in self.terms)))

    def slope(self, x: float) -> float:
        """Its derivative at x."""
        return math.fsum(-a * f * math.sin(f * x + p) for a, f, p in self.terms)

    def extremes(self, start: float, end: float) -> tuple[tuple[float, float], tuple[float, float]]:
        """Minimum and maximum value over an interval, each as (place, value); the ends count.

        Parameters
            start, end : float - the interval
        Returns
            minimum, maximum : (float, float)
        Notes
            Signs of the derivative at 40 places a wave of the highest frequency, then bracketed roots; on a long
            interval only of those next to which an end's value may be the minimum or the greatest. Of several places
            with the same value but for rounding it is the first, whatever the processor's cosines.
        Example
            >>> HarmonicSum(5.0, ((2.0, 1.0, 0.0),)).extremes(-1.0, 1.0)[1]
            (0.0, 7.0)
        """
        return _extremes(self, start, end)

    def rounding(self, farthest: float) -> float:
        """By how much two values that are the same may differ for |x| <= farthest: by an ulp or two of each term, and
        by what the rounded angles f x + p move it."""
        terms = math.fsum(abs(a) * (4.0 + abs(f) * farthest + abs(p)) for a, f, p in self.terms)
        return 2.0**-52 * (abs(self.constant) + terms)

    def few_roots(self, start: float, end: float, count: int) -> list[float]:
        """Roots of the derivative, looked for in `count` steps, that may be the minimum or the maximum of an interval.

        Within a step the sum passes the nearer end's value by no more than h^2/8 max |f''|.
        """
        import numpy as np

        x = start + (end - start) * np.arange(count + 1) / count
        slopes, values = np.zeros(x.size), np.zeros(x.size)
        for a, f, p in self.terms:
            angle = f * x + p
            slopes -= a * f * np.sin(angle)
            values += a * np.cos(angle)
        bend = sum(abs(a) * f * f for a, f, _ in self.terms)
        slack = bend * (x[1] - x[0]) ** 2 / 8.0 + 1e-12 * sum(abs(a) for a, _, _ in self.terms)
        low, high = np.minimum(values[:-1], values[1:]), np.maximum(values[:-1], values[1:])
        extreme = (low - slack <= low.min()) | (high + slack >= high.max())
        turning = (np.sign(slopes[:-1]) != np.sign(slopes[1:])) | (slopes[:-1] == 0.0)
        chosen = np.flatnonzero(extreme & turning)
        # with the slopes that were compared: `slope` rounds otherwise, and may have no change of sign in the step
        steps = zip(*(row[at].tolist() for row in (x, slopes) for at in (chosen, chosen + 1)), strict=True)
        return [bracketed_root(self.slope, low, high, ends=(first, last)) for low, high, first, last in steps]


@lru_cache(maxsize=4)  # a closure, a transmission angle and a motion ask for the same
def _extremes(total: HarmonicSum, start: float, end: float) -> tuple[tuple[float, float], tuple[float, float]]:
    fastest = max((abs(f) for _, f, _ in total.terms), default=0.0)
    count = max(8, math.ceil(_STEPS_PER_WAVE * fastest * (end - start) / (2.0 * math.pi)))
    if count > _MANY:
        places = total.few_roots(start, end, count)
    else:
        places = roots_on(total.slope, [start + (end - start) * i / count for i in range(count + 1)])
    found = [(x, total.value(x)) for x in (start, end, *places)]
    values, rounding = [value for _, value in found], total.rounding(max(abs(start), abs(end)))
    least, greatest = min(values), max(values)
    return (
        min((x, value) for x, value in found if value <= least + rounding),
        min((x, value) for x, value in found if value >= greatest - rounding),
    )
