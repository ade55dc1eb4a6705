"""Types of the arrays that kernels take and give, and the angles of a table's rows."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import ArrayLike, NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.rows import row_numbers

# The intermediate arrays of a block stay in the cache; above 8192 complex numbers the C library maps and clears new
# pages for each of them, which doubles the time.
BLOCK = 8000
"""How many positions are computed together."""

Reals: TypeAlias = NDArray[np.float64]
Points: TypeAlias = NDArray[np.complex128]
"""Points or vectors of the plane, x + i y."""
Mask: TypeAlias = NDArray[np.bool_]


def largest(values: NDArray[Any]) -> Any:
    """The largest value, as Python's own; of rows an array of that of each.

    Example
        >>> largest(np.array([1.0, 3.0])), largest(np.array([[1.0, 3.0], [4.0, 2.0]])).tolist()
        (3.0, [3.0, 4.0])
    """
    found = values.max(axis=-1)
    return found if found.ndim else found.item()


def number_of(values: ArrayLike) -> Any:
    """The number of an array that has but one; another array as it is.

    Example
        >>> number_of(np.ones(1)), number_of(np.ones((2, 1))).shape
        (1.0, (2, 1))
    """
    found = np.asarray(values)
    return found.item() if found.size == 1 else found


def where_it_exists(function: Callable[[float], float], values: ArrayLike) -> Reals:
    """A function at each of some places, not a number where it refuses one."""

    def value(x: float) -> float:
        try:
            return function(x)
        except NoSolution:
            return math.nan

    return np.array([value(float(x)) for x in np.atleast_1d(np.asarray(values, dtype=float))])


def distinct(values: ArrayLike) -> NDArray[Any]:
    """Each value once, ascending.

    Example
        >>> distinct([2.0, 1.0, 2.0]).tolist()
        [1.0, 2.0]
    """
    found: NDArray[Any] = np.sort(np.asarray(values), axis=None)  # np.unique imports numpy.ma
    first = np.ones(found.size, dtype=bool)
    np.not_equal(found[1:], found[:-1], out=first[1:])
    return found[first]


def median(values: Reals) -> float:
    """The middle value, of an even number the mean of both.

    Example
        >>> median(np.array([3.0, 1.0, 2.0])), median(np.array([1.0, 4.0]))
        (2.0, 2.5)
    """
    found = np.sort(values)  # np.median imports numpy.ma
    return 0.5 * float(found[(found.size - 1) // 2] + found[found.size // 2])


def turn_degrees(samples: int | None = None, turns: int = 1) -> Reals:
    """Angles that divide turns into equal steps, from 0.

    Parameters
        samples : int - angles of a revolution, 360 where none are given; `Rows`: a part of all angles
    Returns
        angles : (samples * turns,) array [deg], or the part
    Example
        >>> turn_degrees(3).tolist()
        [0.0, 120.0, 240.0]
    """
    count = (samples or 360) * turns
    rows = row_numbers(samples, count)
    angles: Reals = np.arange(rows.start, rows.stop, dtype=np.float64) * (360.0 * turns / count)
    return angles


def range_rows(start: float, end: float, samples: int | None) -> Reals:
    """Places that divide a range into equal steps, both ends among them.

    Parameters
        samples : int - steps, 180 where none are given; `Rows`: a part of all places
    Example
        >>> range_rows(0.0, 1.0, 2).tolist()
        [0.0, 0.5, 1.0]
    """
    count = samples or 180
    rows = row_numbers(samples, count + 1)
    return np.asarray(start + (end - start) * (np.arange(rows.start, rows.stop) / count))


def product(one: Points | complex, other: Points) -> Points:
    """one other, complex, whose bits do not depend on how many there are.

    Where `other` is a temporary array of 256 KiB or more, numpy computes one * other instead as other * one,
    whose imaginary part is rounded otherwise.
    """
    found: Points = np.multiply(one, other)
    return found


def unit_vector(angles: Reals) -> Points:
    """e^(i angle) as exact as numpy has it, for what an extreme or a tie hangs on; `units` costs an eighth of it."""
    found: Points = np.exp(1j * angles)
    return found


def turned(angles: Reals) -> tuple[Reals, Reals]:
    """Cosine and sine, to some ulp of 1, by one tangent of half the angle: it costs an eighth of e^(i angle).

    Example
        >>> [round(float(each), 15) for each in turned(np.array(np.pi / 3.0))]
        [0.5, 0.866025403784439]
    """
    half = np.tan(0.5 * angles)
    square = half * half
    share = 1.0 / (1.0 + square)
    return np.asarray((1.0 - square) * share), np.asarray((half + half) * share)


def units(angles: Reals) -> Points:
    """e^(i angle) by `turned`.

    Example
        >>> units(np.array([0.0, -0.5 * np.pi])).round(15).tolist()
        [(1+0j), -1j]
    """
    found = np.empty(angles.shape, dtype=np.complex128)
    found.real, found.imag = turned(angles)
    return found
