"""Closures of two links: a pin that joins them, and a rod to a slider on a line. Lengths in mm."""

from __future__ import annotations

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short, unlike
from gearlink.core.mechanism.rates import Point, Turn, cross, dot


def dyad(start: Point, end: Point, first: float, second: float, side: int) -> tuple[Turn, Turn]:
    """Directions of two links joined by a pin, the first from `start`, the second from `end`.

    t2' = (e3 . D1)/(b s),  t3' = (e2 . D1)/(c s),  D1 = Q' - P',  s = sin(t3 - t2)
    t2'' = (e3 . D2)/(b s), t3'' = (e2 . D2)/(c s), D2 = Q'' - P'' + b t2'^2 e2 - c t3'^2 e3
    t2''' = (e3 . D3)/(b s), t3''' = (e2 . D3)/(c s),
    D3 = Q''' - P''' + b (3 t2' t2'' + i t2'^3) e2 - c (3 t3' t3'' + i t3'^3) e3

    Parameters
        start, end : Point [mm] - P and Q, both may move
        first, second : float [mm] - b, c
        side : +1 or -1 - +1: the pin lies left of the vector from start to end
    Returns
        t2, t3 : Turn - P->pin and Q->pin, in (-pi, pi] at every row (not unwrapped)
    Raises
        NoSolution - where the links do not reach or stand in line
    Notes
        Condition 1/sin of the transmission angle for the first derivative, and so on in powers of it.
    Example
        >>> from gearlink.core.mechanism.rates import carried, fixed, steady
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
        raise NoSolution(
            f"two links of {short(first)} and {short(second)} mm do not close over {unlike(n[row], first + second)} mm"
        )
    along = 0.5 * (n + (first - second) * (first + second) / n)
    pin = way / n * (along + 0.5j * side * np.sqrt(near * far) / n)
    e2, e3 = pin / first, (pin - way) / second
    s = cross(e2, e3)
    t2, t3, order = [np.angle(e2)], [np.angle(e3)], min(start.order, end.order)
    for rank in range(1, order + 1):
        apart = end[rank] - start[rank]
        if rank == 2:
            apart = apart + first * t2[1] * t2[1] * e2 - second * t3[1] * t3[1] * e3
        elif rank == 3:
            apart = apart + first * (3.0 * t2[1] * t2[2] + 1j * t2[1] ** 3) * e2
            apart = apart - second * (3.0 * t3[1] * t3[2] + 1j * t3[1] ** 3) * e3
        t2.append(dot(e3, apart) / (first * s))
        t3.append(dot(e2, apart) / (second * s))
    return Turn(*t2), Turn(*t3)


def slider(pin: Point, rod: float, place: complex, along: complex) -> tuple[Turn, Point]:
    """Direction of a rod from a moving pin to a slider on a line, and the slider.

    psi = arg u + g,  sin g = -Im(conj(u)(E - Q))/L,  g' = -Im(conj(u) E')/(L cos g)
    x' = Re(conj(u) E') - L g' sin g,  x'' = Re(conj(u) E'') - L g'' sin g - L g'^2 cos g
    g''' = (-Im(conj(u) E''')/L + 3 g' g'' sin g + g'^3 cos g)/cos g
    x''' = Re(conj(u) E''') - L (g''' sin g + 3 g' g'' cos g - g'^3 sin g)

    Parameters
        pin : Point [mm] - E
        rod : float [mm] - L, the slider lies from the pin in the sense of u
        place, along : complex [mm, 1] - Q and the unit vector u of the line Q + x u
    Returns
        psi, F : Turn, Point - direction of the rod from the pin, and the slider's position
    Raises
        NoSolution - where the rod does not reach the line
    """
    local = np.conj(along) * (pin.value - place)
    sine = -local.imag / rod
    if not np.all(np.abs(sine) < 1.0):
        raise NoSolution(f"a rod of {short(rod)} mm does not reach the slide line")
    cosine = np.sqrt((1.0 - sine) * (1.0 + sine))
    psi, x = [np.angle(along) + np.arcsin(sine)], [local.real + rod * cosine]
    if pin.order > 0:
        velocity = np.conj(along) * pin.first
        first = -velocity.imag / (rod * cosine)
        psi.append(first)
        x.append(velocity.real - rod * first * sine)
    if pin.order > 1:
        acceleration = np.conj(along) * pin.second
        second = (-acceleration.imag + rod * first * first * sine) / (rod * cosine)
        psi.append(second)
        x.append(acceleration.real - rod * second * sine - rod * first * first * cosine)
    if pin.order > 2:
        jerk, mixed, cube = np.conj(along) * pin.third, 3.0 * first * second, first**3
        third = (-jerk.imag + rod * (mixed * sine + cube * cosine)) / (rod * cosine)
        psi.append(third)
        x.append(jerk.real - rod * (third * sine + mixed * cosine - cube * sine))
    return Turn(*psi), Point(place + x[0] * along, *(each * along for each in x[1:]))
