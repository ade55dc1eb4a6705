"""Points and angles of moving links with two exact derivatives with respect to the input angle.

Everything that a machine's loads need is built from three pieces: a point carried by a link, a pin that closes two
links, and a rod to a slider. Lengths in m.
"""

from __future__ import annotations

from typing import NamedTuple

import numpy as np

from gearlink.core.errors import NoSolution
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


def dyad(start: Point, end: Point, first: float, second: float, side: int) -> tuple[Turn, Turn]:
    """Directions of two links joined by a pin, the first from `start`, the second from `end`.

    t2' = (e3 . D1)/(b s),  t3' = (e2 . D1)/(c s),  D1 = Q' - P',  s = sin(t3 - t2)
    t2'' = (e3 . D2)/(b s), t3'' = (e2 . D2)/(c s), D2 = Q'' - P'' + b t2'^2 e2 - c t3'^2 e3

    Parameters
        start, end : Point [m] - P and Q, both may move
        first, second : float [m] - b, c
        side : +1 or -1 - +1: the pin lies left of the vector from start to end
    Returns
        t2, t3 : Turn - P->pin and Q->pin, in (-pi, pi] at every row (not unwrapped)
    Raises
        NoSolution - where the links do not reach or stand in line
    Notes
        Condition 1/sin of the transmission angle for the first, its square for the second derivative.
    Example
        >>> phi = np.array([0.0])
        >>> t2, t3 = dyad(carried(fixed(0.0, phi), steady(phi), 1.0), fixed(4.0, phi), 3.0, 3.0, 1)
        >>> round(float(t2.value[0]), 12), round(float(t2.first[0]), 12)
        (1.047197551197, -0.333333333333)
    """
    way = end.value - start.value
    n = np.abs(way)
    near, far = (n - first + second) * (n + first - second), (first + second - n) * (first + second + n)
    if not np.all((near > 0.0) & (far > 0.0)):
        row = int(np.argmin(np.minimum(near, far)))
        raise NoSolution(f"two links of {1e3 * first:.6g} and {1e3 * second:.6g} mm do not close over "
                         f"{1e3 * n[row]:.6g} mm")  # fmt: skip
    along = 0.5 * (n + (first - second) * (first + second) / n)
    pin = way / n * (along + 0.5j * side * np.sqrt(near * far) / n)
    e2, e3 = pin / first, (pin - way) / second
    s = cross(e2, e3)
    d1 = end.first - start.first
    v2, v3 = dot(e3, d1) / (first * s), dot(e2, d1) / (second * s)
    d2 = end.second - start.second + first * v2 * v2 * e2 - second * v3 * v3 * e3
    a2, a3 = dot(e3, d2) / (first * s), dot(e2, d2) / (second * s)
    return Turn(np.angle(e2), v2, a2), Turn(np.angle(e3), v3, a3)


def slider(pin: Point, rod: float, place: complex, along: complex) -> tuple[Turn, Point]:
    """Direction of a rod from a moving pin to a slider on a line, and the slider.

    psi = arg u + g,  sin g = -Im(conj(u)(E - Q))/L,  g' = -Im(conj(u) E')/(L cos g)
    x' = Re(conj(u) E') - L g' sin g,  x'' = Re(conj(u) E'') - L g'' sin g - L g'^2 cos g

    Parameters
        pin : Point [m] - E
        rod : float [m] - L, the slider lies from the pin in the sense of u
        place, along : complex [m, 1] - Q and the unit vector u of the line Q + x u
    Returns
        psi, F : Turn, Point - direction of the rod from the pin, and the slider's place
    Raises
        NoSolution - where the rod does not reach the line
    """
    local = np.conj(along) * (pin.value - place)
    sine = -local.imag / rod
    if not np.all(np.abs(sine) < 1.0):
        raise NoSolution(f"a rod of {1e3 * rod:.6g} mm does not reach the slide line")
    cosine = np.sqrt((1.0 - sine) * (1.0 + sine))
    velocity, acceleration = np.conj(along) * pin.first, np.conj(along) * pin.second
    first = -velocity.imag / (rod * cosine)
    second = (-acceleration.imag + rod * first * first * sine) / (rod * cosine)
    x = local.real + rod * cosine
    x1 = velocity.real - rod * first * sine
    x2 = acceleration.real - rod * second * sine - rod * first * first * cosine
    psi = Turn(np.angle(along) + np.arcsin(sine), first, second)
    return psi, Point(place + x * along, x1 * along, x2 * along)
