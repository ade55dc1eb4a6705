"""A follower on a spring, simulated at 30 digits: the second way to every residual vibration.

e'' + 2 zeta w e' + w^2 e = -s'' is solved by its Taylor series, step by step, from rest; what is left after the
phase is the amplitude of the free vibration. s'' is given by its own Taylor coefficients, so no formula of the
program is used.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from fractions import Fraction
from math import comb
from typing import Any

import mpmath as mp

ORDER = 60
Taylor = Callable[[Any, int], list[Any]]
"""(x, n) -> s''(x + h) = sum c_k h^k, k < n."""


def of_powers(powers: Sequence[Any]) -> Taylor:
    """s'' = sum p_k x^k."""

    def taylor(x: Any, n: int) -> list[Any]:
        exact = [mp.mpf(p.numerator) / p.denominator if isinstance(p, Fraction) else mp.mpf(p) for p in powers]
        return [mp.fsum(comb(k, m) * p * x ** (k - m) for k, p in enumerate(exact) if k >= m) for m in range(n)]

    return taylor


def of_bernstein(coefficients: Sequence[float]) -> list[Fraction]:
    """Powers of x from Bernstein coefficients, exact."""
    n, exact = len(coefficients) - 1, [Fraction(c) for c in coefficients]
    return [sum((-1) ** (k - i) * comb(k, i) * exact[i] for i in range(k + 1)) * comb(n, k) for k in range(n + 1)]


def of_waves(waves: Sequence[tuple[Any, Any, Any]]) -> Taylor:
    """s'' = sum a sin(k x + phase) of (a, k, phase)."""

    def taylor(x: Any, n: int) -> list[Any]:
        return [
            mp.fsum(a * k**m * mp.sin(k * x + phase + m * mp.pi / 2) for a, k, phase in waves) / mp.factorial(m)
            for m in range(n)
        ]

    return taylor


def left(taylor: Taylor, periods: float, damping: float = 0.0, *, steps: int = 8, digits: int = 30) -> Any:
    """Amplitude of the vibration after a phase, over the rise."""
    with mp.workdps(digits + 10):
        w, zeta = 2 * mp.pi * mp.mpf(periods), mp.mpf(damping)
        steps = max(steps, int(4 * periods))
        h, e, rate = mp.mpf(1) / steps, mp.mpf(0), mp.mpf(0)
        for i in range(steps):
            pushed = taylor(i * h, ORDER)
            series = [e, rate]
            for k in range(ORDER):
                pull = -pushed[k] - 2 * zeta * w * (k + 1) * series[k + 1] - w * w * series[k]
                series.append(pull / ((k + 1) * (k + 2)))
            e = mp.fsum(c * h**k for k, c in enumerate(series))
            rate = mp.fsum(k * c * h ** (k - 1) for k, c in enumerate(series) if k)
        damped = w * mp.sqrt(1 - zeta**2)
        return mp.hypot(e, (rate + zeta * w * e) / damped)
