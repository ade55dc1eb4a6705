"""Sums of powers, of which lead-in and transition of a follower are made, with their derivatives."""

from __future__ import annotations

from typing import Any, TypeAlias

from gearlink.core.flatbed_press.chains import Travel

Terms: TypeAlias = tuple[tuple[int, float], ...]
"""Powers with their coefficients."""


def third(u: Any, terms: Terms) -> Any:
    """Third derivative of the sum of c u^n."""
    return sum((n * (n - 1) * (n - 2) * c * u ** (n - 3) for n, c in terms if n > 2), 0.0 * u)


def powers(u: Any, order: int, terms: Terms) -> Travel:
    """Sum of c u^n and its derivatives."""
    value = sum(c * u**n for n, c in terms)
    if order == 0:
        return Travel(value)
    first = sum(n * c * u ** (n - 1) for n, c in terms if n)
    if order == 1:
        return Travel(value, first)
    return Travel(value, first, sum(n * (n - 1) * c * u ** (n - 2) for n, c in terms if n > 1))
