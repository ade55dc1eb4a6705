"""Bracketed roots and extrema of scalar functions, with `math` alone (importing scipy.optimize costs 300 ms)."""

from __future__ import annotations

import itertools
import math
from collections.abc import Callable, Sequence

from gearlink.core.base.errors import NoSolution

_ROUNDING = 2.0**-40  # of x: steps so small that do not shrink are rounding
_GOLDEN = (math.sqrt(5.0) - 1.0) / 2.0


def bracketed_root(
    f: Callable[[float], float],
    low: float,
    high: float,
    *,
    tolerance: float = 0.0,
    ends: tuple[float, float] | None = None,
) -> float:
    """Root of a continuous function between two points where its signs differ (Chandrupatla's method).

    Parameters
        f : the function
        low, high : float - the bracket; f(low) and f(high) must have opposite signs or one be zero
        tolerance : float - absolute tolerance in x besides two ulp of x; the default stops at the last bit
        ends : (float, float) - f(low) and f(high) where the caller has them already
    Returns
        x : float - the end of the final bracket where |f| is smaller
    Raises
        NoSolution - when the signs do not differ, or the function gives NaN
    Notes
        Inverse quadratic interpolation where it is safe, bisection where it is not: never worse than about
        three times bisection, 6 to 10 calls for a smooth function. Two hundred steps at most: a multiple root
        at exactly 0, which has no last bit, is then known to about 1e-40 of the bracket.
    Example
        >>> bracketed_root(lambda x: x * x - 2, 0.0, 2.0)
        1.414213562373095

    Source
        T. R. Chandrupatla, Adv. Eng. Softw. 28 (1997) 145-149
    """
    a, b = high, low
    fa, fb = (f(a), f(b)) if ends is None else (ends[1], ends[0])
    if fa == 0.0:
        return a
    if fb == 0.0:
        return b
    if not fa * fb < 0.0 and not (math.copysign(1.0, fa) != math.copysign(1.0, fb) and fa == fa and fb == fb):
        raise NoSolution(f"no sign change between {low!r} and {high!r}: f = {fb!r} and {fa!r}")
    c, fc = a, fa
    t = 0.5
    for _ in range(200):
        x = a + t * (b - a)
        fx = f(x)
        if fx != fx:
            raise NoSolution(f"the function is no number at {x!r}, between {low!r} and {high!r}")
        if (fx > 0.0) == (fa > 0.0):
            c, fc = a, fa
        else:
            c, b, fc, fb = b, a, fb, fa
        a, fa = x, fx
        best, f_best = (a, fa) if abs(fa) < abs(fb) else (b, fb)
        reach = 2.0 * math.ulp(best) + tolerance
        if f_best == 0.0 or abs(b - a) <= reach:
            return best
        share = min(0.5, reach / abs(b - a))  # a bracket just wider than that is halved, or the steps would vanish
        xi, phi = (a - b) / (c - b), (fa - fb) / (fc - fb)
        if phi * phi < xi and (1.0 - phi) * (1.0 - phi) < 1.0 - xi:
            t = fa / (fb - fa) * fc / (fb - fc) + (c - a) / (b - a) * fa / (fc - fa) * fb / (fc - fb)
        else:
            t = 0.5
        t = min(1.0 - share, max(share, t))
    return best


def newton_root(f: Callable[..., tuple[float, float]], low: float, high: float, start: float, *given: float) -> float:
    """Root of a rising function whose derivative is known, by Newton's steps held inside a bracket that shrinks.

    Parameters
        f : the function and its derivative
        low, high : float - f(low) < 0 < f(high)
        start : float - between them
        given : numbers that the function takes as well
    Returns
        x : float - to a few ulp, or where the steps are rounding of f
    Example
        >>> newton_root(lambda x: (x * x - 2.0, 2.0 * x), 0.0, 2.0, 1.0)
        1.414213562373095

    """
    x, last = start, math.inf
    for _ in range(200):
        value, slope = f(x, *given)
        low, high = (x, high) if value < 0.0 else (low, x)
        step = value / slope if slope > 0.0 else math.inf
        if abs(step) <= 2.0 * math.ulp(x) or 0.5 * last <= abs(step) <= _ROUNDING * abs(x):
            return x - step if low < x - step < high else x
        last = abs(step)
        x = x - step if low < x - step < high else 0.5 * (low + high)
    return x


def sign_changes(values: Sequence[float]) -> list[int]:
    """Indices i where values[i] and values[i+1] differ in sign, or values[i] is zero.

    Example
        >>> sign_changes([1.0, -1.0, -2.0, 3.0])
        [0, 2]
    """
    pairs = enumerate(itertools.pairwise(values))  # not by their product, which may underflow to zero
    return [i for i, (p, q) in pairs if p == 0.0 or p < 0.0 < q or p > 0.0 > q]


def roots_on(f: Callable[[float], float], grid: Sequence[float]) -> list[float]:
    """Roots of a function where its sign changes between neighbours of a grid, to the last bit.

    Notes
        Two roots within one step are missed.
    Example
        >>> roots_on(lambda x: x * x - 2.0, [-2.0, 0.0, 2.0])
        [-1.414213562373095, 1.414213562373095]
    """
    values = [f(x) for x in grid]
    return [bracketed_root(f, grid[i], grid[i + 1], ends=(values[i], values[i + 1])) for i in sign_changes(values)]


def maximum(f: Callable[[float], float], low: float, high: float) -> tuple[float, float]:
    """Place and value of the maximum of a function that has one hump between two points (golden section).

    Parameters
        f : the function; smooth or with a kink
        low, high : float - the interval
    Returns
        x, value : float, float - the ends of the interval are candidates too
    Notes
        At a smooth maximum the value is exact to rounding, the place to about sqrt(eps) of the scale of x;
        take the root of the derivative where the place itself is wanted.
    Example
        >>> x, value = maximum(lambda x: 1.0 - (x - 0.25) ** 2, 0.0, 1.0)
        >>> round(x, 6), value
        (0.25, 1.0)

    Source
        J. Kiefer, Proc. Amer. Math. Soc. 4 (1953) 502-506
    """
    left, right = low, high
    p, q = right - _GOLDEN * (right - left), left + _GOLDEN * (right - left)
    fp, fq = f(p), f(q)
    best = max((fp, p), (fq, q), (f(low), low), (f(high), high))
    while abs(right - left) > 1e-9 * max(abs(left), abs(right), abs(high - low)):
        if fp >= fq:
            right, q, fq = q, p, fp
            p = right - _GOLDEN * (right - left)
            fp = f(p)
            best = max(best, (fp, p))
        else:
            left, p, fp = p, q, fq
            q = left + _GOLDEN * (right - left)
            fq = f(q)
            best = max(best, (fq, q))
    return best[1], best[0]
