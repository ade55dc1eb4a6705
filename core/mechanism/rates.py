"""Points and angles of moving links with up to three exact derivatives with respect to the input angle.

Every mechanism is built from three pieces: a point carried by a link, and the two closures of `closures`, a pin that
closes two links and a rod to a slider. Each has as many derivatives as its inputs have. Lengths in mm.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Any, Self, TypeVar

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Points, Reals

_NAMES = ("", "first", "second", "third")
TURNING_BACK = 1e-12
"""Input angle [rad] within which a rate passes through zero at a row: far above rounding, far below any step."""


A = TypeVar("A", bound=NDArray[Any])


class Rates(tuple[A, ...]):
    """A value and its derivatives with respect to the input angle, as many as were requested; arrays of one shape.

    Example
        >>> angle = steady(np.array([0.0, 1.0]), 2.0, order=1)
        >>> angle.order, angle.first.tolist()
        (1, [2.0, 2.0])
        >>> angle.second
        Traceback (most recent call last):
        AssertionError: the second derivative was not requested
    """

    __slots__ = ()

    def __new__(cls, *parts: A) -> Self:
        """Of the value and the derivatives in their order."""
        return super().__new__(cls, parts)

    @property
    def order(self) -> int:
        """How many derivatives there are, 0 to 3."""
        return len(self) - 1

    @property
    def value(self) -> A:
        """The value itself."""
        return self[0]

    @property
    def first(self) -> A:
        """The first derivative."""
        return self.derivative(1)

    @property
    def second(self) -> A:
        """The second derivative."""
        return self.derivative(2)

    @property
    def third(self) -> A:
        """The third derivative."""
        return self.derivative(3)

    def derivative(self, order: int) -> A:
        """A derivative, 1 to 3, or the value, 0.

        Raises
            AssertionError - where it was not requested
        """
        if order >= len(self):
            raise AssertionError(f"the {_NAMES[order]} derivative was not requested")
        return self[order]


class Turn(Rates[Reals]):
    """An angle [rad], continuous over the rows, and its derivatives."""

    __slots__ = ()


class Point(Rates[Points]):
    """A point of the plane [mm] and its derivatives."""

    __slots__ = ()


def cross(a: Points | complex, b: Points | complex) -> Reals:
    """a x b of plane vectors, Im(conj(a) b)."""
    return np.asarray((np.conj(a) * b).imag)


def dot(a: Points | complex, b: Points | complex) -> Reals:
    """a . b of plane vectors, Re(conj(a) b)."""
    return np.asarray((np.conj(a) * b).real)


def sense_of(first: Reals, second: Reals) -> Reals:
    """Sign of a rate; at a reversal, which lies between two rounded angles, the sign just after it."""
    back = np.abs(first) <= TURNING_BACK * np.abs(second)
    return np.asarray(np.sign(np.where(back, second, first)))


def fixed(place: complex, like: Reals, *, order: int = 2) -> Point:
    """A point of the frame, as many rows as `like` has."""
    still = np.zeros(like.shape, dtype=np.complex128)
    return Point(still + place, *[still] * order)


def steady(phi: Reals, rate: float = 1.0, start: float = 0.0, *, order: int = 2) -> Turn:
    """An angle that runs with a constant ratio to the input: start + rate phi."""
    still = np.zeros_like(phi)
    return Turn(*[start + rate * phi, np.full_like(phi, rate), still, still][: order + 1])


def standing(angle: float, like: Reals, *, order: int = 2) -> Turn:
    """An angle that does not change."""
    return steady(np.zeros_like(like), 0.0, angle, order=order)


def mixed(*parts: tuple[float, Turn]) -> Turn:
    """A sum of angles with constant shares, as gears make it.

    Example
        >>> phi = np.array([0.0, 1.0])
        >>> mixed((2.0, steady(phi)), (-1.0, standing(0.5, phi))).value.tolist()
        [-0.5, 1.5]
    """
    order = min(turn.order for _, turn in parts)
    return Turn(*(np.asarray(sum(share * turn[i] for share, turn in parts)) for i in range(order + 1)))


def chained(outer: Sequence[Reals], inner: Sequence[Reals]) -> list[Reals]:
    """Derivatives of g(u(x)) by x, as many as both have.

    y' = g' u',  y'' = g'' u'^2 + g' u'',  y''' = g''' u'^3 + 3 g'' u' u'' + g' u'''

    Parameters
        outer : (N,) arrays - g and its derivatives by u, up to the third
        inner : (N,) arrays - u and its derivatives by x
    Source
        chain rule
    """
    found, most = [np.asarray(outer[0])], min(len(outer), len(inner)) - 1
    if most >= 1:
        found.append(outer[1] * inner[1])
    if most >= 2:
        found.append(outer[2] * inner[1] ** 2 + outer[1] * inner[2])
    if most >= 3:
        found.append(outer[3] * inner[1] ** 3 + 3.0 * outer[2] * inner[1] * inner[2] + outer[1] * inner[3])
    return found


def from_start(turn: Turn, start: float) -> Turn:
    """The angle less its value at the start."""
    return Turn(turn.value - start, *turn[1:])


def carried(origin: Point, turn: Turn, arm: complex | Points, unit: Points | None = None) -> Point:
    """A point that a link carries.

    P + s e,  P' + i t' s e,  P'' + (i t'' - t'^2) s e,  P''' + (i t''' - 3 t' t'' - i t'^3) s e,  e = e^(i t)

    Parameters
        origin : Point - of the link
        turn : Turn - of the link
        arm : complex [mm] - s, in link coordinates
        unit : (N,) array - e^(i t), where the caller has it
    Example
        >>> phi = np.array([0.0])
        >>> p = carried(fixed(1.0, phi), steady(phi, 2.0), 3.0)
        >>> p.value[0], p.first[0], p.second[0]
        (np.complex128(4+0j), np.complex128(6j), np.complex128(-12+0j))
    """
    if not isinstance(arm, np.ndarray) and arm == 0.0:
        return origin
    along, order = arm * (np.exp(1j * turn.value) if unit is None else unit), min(origin.order, turn.order)
    parts = [origin.value + along]
    if order > 0:
        first = 1j * turn.first * along
        parts.append(origin.first + first)
    if order > 1:
        parts.append(origin.second + 1j * turn.second * along + 1j * turn.first * first)
    if order > 2:
        bend = 1j * (turn.third - turn.first**3) - 3.0 * turn.first * turn.second
        parts.append(origin.third + bend * along)
    return Point(*parts)
