"""Evenly scattered points of the unit cube, the same on every run: starts of a search that must be repeatable."""

from __future__ import annotations

_PRIMES = (2, 3, 5, 7, 11, 13, 17, 19)


def halton(index: int, dimensions: int) -> list[float]:
    """Point of the Halton sequence.

    Parameters
        index : int - 1, 2, ...
        dimensions : int - up to 8
    Returns
        point : list of float - in (0, 1)
    Example
        >>> halton(1, 3), halton(2, 1)
        ([0.5, 0.3333333333333333, 0.2], [0.25])

    Source
        J. H. Halton, Numer. Math. 2 (1960) 84-90
    """
    return [_inverse(index, base) for base in _PRIMES[:dimensions]]


def _inverse(index: int, base: int) -> float:
    """Digits of the index in a base, mirrored at the point."""
    result, share = 0.0, 1.0
    while index:
        index, digit = divmod(index, base)
        share /= base
        result += share * digit
    return result
