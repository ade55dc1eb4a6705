"""Bracketed roots of many functions at once."""

from __future__ import annotations

from collections.abc import Callable

import numpy as np

from gearlink.core.numerics.arrays import Reals

_STEPS = 100
_REST = 4.0 * np.finfo(float).eps


def bracketed_roots(f: Callable[[Reals], Reals], low: Reals, high: Reals) -> Reals:
    """Roots between two arrays of places where a function has opposite signs.

    c = b - f(b) (b - a)/(f(b) - f(a)); where f keeps its sign from b to c, f(a) shrinks by 1 - f(c)/f(b), or by half

    Parameters
        f : function of an (N,) array, element by element
        low, high : (N,) arrays
    Returns
        roots : (N,) array - NaN where the signs are equal, or no rest is found in 100 steps
    Notes
        Each element rests by itself: no bit of its root depends on the others. Order 1.7 for simple roots.
    Example
        >>> bracketed_roots(lambda x: x * x - np.array([2.0, 9.0]), np.zeros(2), np.full(2, 5.0)).round(9).tolist()
        [1.414213562, 3.0]

    Source
        N. Anderson, A. Bjoerck, A new high order method of regula falsi type, BIT 13 (1973)
    """
    a, b = np.array(low, dtype=float), np.array(high, dtype=float)
    with np.errstate(all="ignore"):
        at_a, at_b = f(a), f(b)
        b = np.where(at_a == 0.0, a, b)
        found = (at_a == 0.0) | (at_b == 0.0)
        valid = found | (np.sign(at_a) == -np.sign(at_b))
        rests = found | ~valid
        for _ in range(_STEPS):
            if rests.all():
                break
            c = np.where(rests, b, b - at_b * (b - a) / (at_b - at_a))
            at_c = f(c)
            crosses = np.sign(at_c) != np.sign(at_b)
            shrunk = 1.0 - at_c / at_b
            at_a = np.where(crosses, at_b, at_a * np.where(shrunk > 0.0, shrunk, 0.5))
            a = np.where(crosses, b, a)
            near = np.abs(c - b) <= _REST * np.maximum(np.abs(b), np.abs(c))
            b, at_b = c, at_c
            rests |= near | (at_c == 0.0)
    return np.where(valid & rests, b, np.nan)
