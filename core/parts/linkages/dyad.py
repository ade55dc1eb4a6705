"""Two links joined by a pin between two points that are given: where the pin lies, and when they reach."""

from __future__ import annotations

import math

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.base.wording import short, unlike

Extremes = tuple[tuple[float, float], tuple[float, float]]
"""Minimum and maximum distance of two moving pins, each as (input angle [rad], distance [mm])."""


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


def worst_transmission(extremes: Extremes, first: float, second: float) -> tuple[float, float]:
    """Minimum angle between two links over what they span, an obtuse one counted from the other side.

    Parameters
        extremes : Extremes - of the distance of their ends
        first, second : float [mm]
    Returns
        angle, place : float, float [rad] - and the input angle at which it occurs
    """
    return min((acute(transmission_angle(distance, first, second)), place) for place, distance in extremes)


def require_span(
    ends: str, links: dict[str, float], extremes: Extremes, ways: tuple[str, str], *, aside: str = ""
) -> None:
    """Refuse a five-bar whose last two links do not reach from pin to pin at every input angle.

    |b - c| < n < b + c

    Parameters
        ends : str - the pins
        links : name and length [mm] of both links
        extremes : Extremes - of n
        ways : str - what helps besides against too long, and against too short a distance
        aside : str - about the input angle
    Raises
        NoSolution - naming the worst input angle, the distance there, the limit, and by how much to change it
    """
    (low, least), (high, greatest) = extremes
    (first, b), (second, c) = links.items()
    if greatest >= b + c:
        place, distance, limit, law, way = high, greatest, b + c, f"{first} + {second}", ways[0]
        side, change, both = "<=", f"lengthen {first} and {second}", " together"
    elif least <= abs(b - c):
        place, distance, limit, law, way = low, least, abs(b - c), f"{first} - {second}", ways[1]
        side, change, both = ">=", f"reduce the difference of {first} and {second}", ""
    else:
        return
    raise NoSolution(
        f"the five-bar cannot be assembled: distance {ends} {unlike(distance, limit)} mm (limit {side} "
        f"{unlike(limit, distance)} mm, {law}) at input angle {short(math.degrees(place))} deg{aside}",
        fix=f"{change} by more than {safely_above(abs(distance - limit), 4)} mm{both}{way}",
    )
