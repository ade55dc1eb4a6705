"""Rows of the tables of standards, whose ranges end at sizes of the preferred series."""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Sequence

_ROUNDING = 1e-12
"""Relative: a computed size this near to the end of a range is the end itself."""


def row_of(ends: Sequence[float], size: float) -> int:
    """Number of the range that holds a size; the end of a range belongs to it.

    Parameters
        ends : ascending floats - the upper ends of the ranges
        size : float - in their unit
    Returns
        row : int - the number of ends where the size lies beyond all
    Notes
        The diameter 50.000000000000007 of a gear is one of 50: its rounding must not take it to the next range.
    Example
        >>> row_of((10, 50, 125), 50.0), row_of((10, 50, 125), 50.000000000000007), row_of((10, 50, 125), 50.001)
        (1, 1, 2)
    """
    return bisect_left(ends, size * (1.0 - _ROUNDING))
