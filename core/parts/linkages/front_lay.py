"""The speed with which a sheet arrives at the front lay: windows of the crank angle before the arrival.

The gentlest has both ends on one level of the speed ratio W, a minimum of W between them.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.wording import short
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.parts.linkages.standstills import Turning

TURN = 2.0 * math.pi
_STEPS = 720
Speed = Callable[[float], float]


class Lay(NamedTuple):
    """The way to the front lay: crank angles of its start and of the arrival [rad], maximum speed ratio on it, and
    that at the arrival."""

    start: float
    end: float
    greatest: float
    arrival: float


def way_before(speed: Speed, angle: Speed, extremes: Sequence[Turning], turned: float, end: float) -> Lay:
    """The last stretch before an arrival, in which the output turns by an angle.

    Parameters
        speed, angle : functions of the crank angle [rad] - W, and the output's angle, running on over turns
        turned : float [rad] - of the output in that stretch
        end : float [rad] - crank angle of the arrival
    Raises
        NoSolution - where the output turns back within it, or it is longer than two revolutions
    """
    step, here, goal = TURN / _STEPS, end, angle(end) - turned
    for k in range(1, 2 * _STEPS):
        there = end - k * step
        if angle(there) <= goal:
            start = bracketed_root(lambda x: angle(x) - goal, there, here)
            return _judged(speed, extremes, start, end)
        here = there
    raise NoSolution("the way before the lay is longer than the feed of two revolutions", fix="give a shorter one")


def gentlest(speed: Speed, angle: Speed, extremes: Sequence[Turning], turned: float) -> Lay:
    """The stretch of the smallest maximum speed, wherever in the turn the sheet may arrive.

    About a minimum of W, with equal speeds at both ends; where none has such ends, up to the maximum speed.

    Raises
        NoSolution - where the output turns back within all of them
    """
    best: Lay | None = None
    refused: NoSolution | None = None
    for place, value in extremes:
        tops = [_next_top(extremes, place, way) for way in (-1.0, 1.0)]
        if None in tops or any(top.value < value for top in tops if top is not None):
            continue
        found = _about(speed, angle, place, [top for top in tops if top is not None], turned)
        if found is None:
            continue
        try:
            judged = _judged(speed, extremes, *found)
        except NoSolution as error:
            refused = error
            continue
        if best is None or judged.greatest < best.greatest:
            best = judged
    if best is not None:
        return best
    if refused is not None:
        raise refused
    place = max(extremes, key=lambda each: each.value).place
    return way_before(speed, angle, extremes, turned, place)


def _next_top(extremes: Sequence[Turning], place: float, way: float) -> Turning | None:
    """The next turning one way, its place counted on over the turn."""
    others = [each for each in extremes if each.place != place]
    if not others:
        return None
    found = min(others, key=lambda each: (way * (each.place - place)) % TURN)
    return Turning(place + way * ((way * (found.place - place)) % TURN), found.value)


def _about(speed: Speed, angle: Speed, place: float, tops: list[Turning], turned: float) -> tuple[float, float] | None:
    """Ends at one speed on both sides of a minimum, between which the output turns by an angle."""
    level = min(top.value for top in tops)

    def ends(share: float) -> tuple[float, float]:
        wanted = speed(place) + share * (level - speed(place))
        return (
            bracketed_root(lambda x: speed(x) - wanted, tops[0].place, place),
            bracketed_root(lambda x: speed(x) - wanted, place, tops[1].place),
        )

    def missing(share: float) -> float:
        start, end = ends(share)
        return angle(end) - angle(start) - turned

    most = 1.0 - 1e-12
    if missing(most) < 0.0:
        return None
    return ends(bracketed_root(missing, 1e-15, most))


def _judged(speed: Speed, extremes: Sequence[Turning], start: float, end: float) -> Lay:
    inside = [value for place, value in extremes if (place - start) % TURN <= end - start]
    values = [speed(start), speed(end), *inside]
    if min(values) < 0.0:
        raise NoSolution(
            f"the sheet goes back on the way before the lay, speed ratio {short(min(values))}",
            fix="give a shorter one, or a drive without back-step",
        )
    return Lay(start, end, max(values), speed(end))
