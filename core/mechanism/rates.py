"""Points and angles of moving links with two exact derivatives with respect to the input angle.

Everything that a machine needs is built from three pieces: a point carried by a link, and those of `closures`, a pin
that closes two links and a rod to a slider. Lengths in m.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals

TURNING_BACK = 1e-12
"""Input angle [rad] within which a rate passes through zero at a row: far above rounding, far below any step."""


class Point(NamedTuple):
    """A point of the plane [m] and its two derivatives with respect to the input angle; arrays of one shape."""

    value: Points
    first: Points
    second: Points


class Turn(NamedTuple):
    """An angle [rad], continuous over the rows, and its two derivatives with respect to the input angle."""

    value: Reals
    first: Reals
    second: Reals


def cross(a: Points | complex, b: Points | complex) -> Reals:
    """a x b of plane vectors, Im(conj(a) b)."""
    return np.asarray((np.conj(a) * b).imag)


def dot(a: Points | complex, b: Points | complex) -> Reals:
    """a . b of plane vectors, Re(conj(a) b)."""
    return np.asarray((np.conj(a) * b).real)


def sense_of(first: Reals, second: Reals) -> Reals:
    """Sign of a rate; where it turns back, which is between two roundings of the angle, the sign just after."""
    back = np.abs(first) <= TURNING_BACK * np.abs(second)
    return np.asarray(np.sign(np.where(back, second, first)))


def fixed(place: complex, like: Reals) -> Point:
    """A point of the frame, as many rows as `like` has."""
    still = np.zeros(like.shape, dtype=np.complex128)
    return Point(still + place, still, still)


def steady(phi: Reals, rate: float = 1.0, start: float = 0.0) -> Turn:
    """An angle that runs with a constant ratio to the input: start + rate phi."""
    return Turn(start + rate * phi, np.full_like(phi, rate), np.zeros_like(phi))


def standing(angle: float, like: Reals) -> Turn:
    """An angle that does not change."""
    return steady(np.zeros_like(like), 0.0, angle)


def mixed(*parts: tuple[float, Turn]) -> Turn:
    """A sum of angles with constant shares, as gears make it.

    Example
        >>> phi = np.array([0.0, 1.0])
        >>> mixed((2.0, steady(phi)), (-1.0, standing(0.5, phi))).value.tolist()
        [-0.5, 1.5]
    """
    value, first, second = (sum(share * turn[i] for share, turn in parts) for i in range(3))
    return Turn(np.asarray(value), np.asarray(first), np.asarray(second))


def from_start(turn: Turn, start: float) -> Turn:
    """The angle less its value at the start."""
    return Turn(turn.value - start, turn.first, turn.second)


def carried(origin: Point, turn: Turn, arm: complex, unit: Points | None = None) -> Point:
    """A point that a link carries.

    P + s e,  P' + i t' s e,  P'' + (i t'' - t'^2) s e,  e = e^(i t)

    Parameters
        origin : Point - of the link
        turn : Turn - of the link
        arm : complex [m] - s, in link coordinates
        unit : (N,) array - e^(i t), where the caller has it
    Example
        >>> phi = np.array([0.0])
        >>> p = carried(fixed(1.0, phi), steady(phi, 2.0), 3.0)
        >>> p.value[0], p.first[0], p.second[0]
        (np.complex128(4+0j), np.complex128(6j), np.complex128(-12+0j))
    """
    if arm == 0.0:
        return origin
    along = arm * (np.exp(1j * turn.value) if unit is None else unit)
    first = 1j * turn.first * along
    return Point(origin.value + along, origin.first + first, origin.second + 1j * turn.second * along
                 + 1j * turn.first * first)  # fmt: skip
