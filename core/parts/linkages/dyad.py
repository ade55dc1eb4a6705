"""Two links joined by a pin between two points that are given: where the pin lies, and when they reach."""

from __future__ import annotations

import math

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.base.wording import unlike


def close_dyad(start: complex, end: complex, first: float, second: float, side: int) -> complex:
    """Pin of two links, the first from `start`, the second from `end`.

    Parameters
        start, end : complex [mm]
        first, second : float [mm] - lengths of the links
        side : +1 or -1 - +1: the pin lies left of the vector from start to end
    Returns
        pin : complex [mm]
    Raises
        NoSolution - where the links do not reach, or are too unequal
    Example
        >>> close_dyad(0j, 6 + 0j, 5.0, 5.0, 1)
        (3+4j)

    Source
        own derivation: the triangle of the links and the distance, its height by Heron's formula
    """
    way = end - start
    n = abs(way)
    require_dyad(n, first, second)
    along = 0.5 * (n + (first - second) * (first + second) / n) if n > 0.0 else 0.0
    product = (first + second - n) * (first + second + n) * (n - first + second) * (n + first - second)
    height = 0.5 * math.sqrt(product) / n
    return start + way / n * complex(along, side * height)


def acute(angle: float) -> float:
    """The angle between two lines, from 0 to pi/2, of an angle between links from 0 to pi [rad].

    min(gamma, pi - gamma)
    """
    return min(angle, math.pi - angle)


def transmission_angle(distance: float, first: float, second: float) -> float:
    """Angle between the two links at their pin [rad].

    gamma = 2 atan2(sqrt((n - b + c)(n + b - c)), sqrt((b + c - n)(b + c + n)))

    Parameters
        distance : float [mm] - n, from start to end
        first, second : float [mm] - b, c
    Raises
        NoSolution - as `close_dyad`
    Example
        >>> round(math.degrees(transmission_angle(5.0, 3.0, 4.0)), 12)
        90.0
    """
    require_dyad(distance, first, second)
    near = (distance - first + second) * (distance + first - second)
    far = (first + second - distance) * (first + second + distance)
    return 2.0 * math.atan2(math.sqrt(near), math.sqrt(far))


def require_lengths(**links: float) -> None:
    """Refuse a link whose length [mm] is not positive and finite.

    Raises
        NoSolution - with the link's name and length
    """
    for name, length in links.items():
        if not 0.0 < length < math.inf:
            raise NoSolution(f"{name} link is {length:g} mm; it must be positive and finite")


def require_dyad(distance: float, first: float, second: float) -> None:
    """Refuse a distance that the two links do not span.

    Raises
        NoSolution - with the limit that is passed
    """
    longest, shortest = first + second, abs(first - second)
    if distance > longest:
        raise NoSolution(
            f"{unlike(distance, longest)} mm apart (limit <= {unlike(longest, distance)} mm, the two links together)",
            fix=f"lengthen the links by {safely_above(distance - longest, 4)} mm",
        )
    if distance < shortest or distance == 0.0:
        raise NoSolution(
            f"{unlike(distance, shortest)} mm apart (limit >= {unlike(shortest, distance)} mm, the difference of the "
            "two links)",
            fix=f"reduce their difference by {safely_above(shortest - distance, 4)} mm",
        )
