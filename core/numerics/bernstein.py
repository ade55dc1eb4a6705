"""Polynomials on [0, 1] by their Bernstein coefficients: derivatives, integrals, and peaks that are proved."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from functools import lru_cache
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Reals

HERMITE: Reals = np.array(
    [
        [1, 0, 0, 0, 0, 0],
        [0, 1, 0, 0, 0, 0],
        [0, 0, 0.5, 0, 0, 0],
        [-10, -6, -1.5, 10, -4, 0.5],
        [15, 8, 1.5, -15, 7, -1],
        [-6, -3, -0.5, 6, -3, 0.5],
    ]
)
"""Coefficients of degree 0 to 5 by (s0, v0, a0, s1, v1, a1), derivatives by x in [0, 1]."""


_ROUNDING = 64.0 * float(np.finfo(np.float64).eps)
_DEEPEST = 48


def evaluate(coefficients: Reals, x: Any) -> Any:
    """Value of sum c_i B_i,n at x, a float or an array.

    Example
        >>> evaluate(np.array([0.0, 0.0, 1.0]), 0.5)
        0.25
    """
    at = np.asarray(x, dtype=np.float64)
    n = coefficients.size - 1
    powers = np.arange(n + 1)
    basis = _binomials(n) * at[..., None] ** powers * (1.0 - at)[..., None] ** (n - powers)
    # a sum of products, not a matrix product: no value depends on the number of places
    found = (basis * coefficients).sum(axis=-1)
    return float(found) if isinstance(x, float) else found


@lru_cache(maxsize=128)
def _binomials(n: int) -> Reals:
    return np.array([float(math.comb(n, i)) for i in range(n + 1)])


def derivative(coefficients: Reals) -> Reals:
    """Coefficients of the derivative, of a degree less; of a constant, those of 0."""
    n = coefficients.size - 1
    return n * np.diff(coefficients) if n else np.zeros(1)


def integral(coefficients: Reals, start: float = 0.0) -> Reals:
    """Coefficients of the integral that is `start` at 0, of a degree more."""
    return np.append(start, start + np.cumsum(coefficients) / coefficients.size)


def product(first: Reals, second: Reals) -> Reals:
    """Coefficients of a product, of the sum of both degrees."""
    p, q = first.size - 1, second.size - 1
    found = np.convolve(_binomials(p) * first, _binomials(q) * second)
    return np.asarray(found / _binomials(p + q))


def from_powers(powers: Sequence[float | Fraction]) -> Reals:
    """Coefficients of sum p_k x^k, each rounded once.

    Example
        >>> from_powers([0.0, 2.0, -1.0]).tolist()
        [0.0, 1.0, 1.0]
    """
    n, exact = len(powers) - 1, [Fraction(p) for p in powers]
    return np.array(
        [float(sum(exact[k] * math.comb(i, k) / math.comb(n, k) for k in range(i + 1))) for i in range(n + 1)]
    )


def from_chebyshev(series: Reals) -> Reals:
    """Coefficients of sum b_k T_k(2 x - 1), each rounded once."""
    n = series.size - 1
    before, now = [Fraction(1)], [Fraction(-1), Fraction(2)]  # T_0, T_1 by powers of x
    powers = [Fraction(0)] * (n + 1)
    for k, b in enumerate(series.tolist()):
        for i, c in enumerate(before if k == 0 else now):
            powers[i] += Fraction(b) * c
        if k:
            after = [Fraction(0)] * (k + 2)
            for i, c in enumerate(now):
                after[i] -= 2 * c
                after[i + 1] += 4 * c
            for i, c in enumerate(before):
                after[i] -= c
            before, now = now, after
    return from_powers(powers)


def peak(coefficients: Reals) -> float:
    """An upper bound of |f| on [0, 1], or of several by rows, at most 1.5e-14 of the largest coefficient too high.

    Notes
        The largest coefficient of a part bounds |f| there; parts are halved until it is no more than a value of f.
    Example
        >>> 0.25 <= peak(from_powers([0.0, 1.0, -1.0])) < 0.25 + 1e-14
        True
    """
    size = float(np.max(np.abs(coefficients)))
    parts = np.atleast_2d(coefficients)
    reached = 0.0
    for _ in range(_DEEPEST):
        reached = max(reached, float(np.max(np.abs(parts[:, [0, -1]]))))
        bound = reached + _ROUNDING * size
        open_parts = parts[np.max(np.abs(parts), axis=1) > bound]
        if not open_parts.size:
            return bound
        parts = np.concatenate(_halved(open_parts))
    return float(np.max(np.abs(parts))) + _ROUNDING * size


def _halved(parts: Reals) -> tuple[Reals, Reals]:
    """Coefficients on both halves of each part (de Casteljau)."""
    left, right = np.empty_like(parts), np.empty_like(parts)
    row = parts
    for k in range(parts.shape[1]):
        left[:, k], right[:, -1 - k] = row[:, 0], row[:, -1]
        row = 0.5 * (row[:, 1:] + row[:, :-1])
    return left, right
