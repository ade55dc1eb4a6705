"""Extremes and standstills of a motion over one revolution of the crank, from its speed and its acceleration ratio.

Quantities are the maximum and minimum speed and acceleration ratio of an output with their places.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from itertools import pairwise
from typing import Any, NamedTuple

from gearlink.core.base.design import placed
from gearlink.core.numerics.gauss import integral
from gearlink.core.numerics.roots import bracketed_root, roots_on


class OutputRates:
    """The extremes of the output's ratios; a design gives all turnings of both over its period."""

    @property
    def speed_turnings(self) -> list[Turning]:
        """Extremes of the output's speed ratio."""
        raise NotImplementedError

    @property
    def acceleration_turnings(self) -> list[Turning]:
        """Extremes of its acceleration ratio."""
        raise NotImplementedError

    fastest = property(lambda self: max(self.speed_turnings, key=lambda t: t.value))
    slowest = property(lambda self: min(self.speed_turnings, key=lambda t: t.value))
    hardest = property(lambda self: max(self.acceleration_turnings, key=lambda t: t.value))
    hardest_back = property(lambda self: min(self.acceleration_turnings, key=lambda t: t.value))
    speed_ratio_max: float = placed("fastest.value")
    speed_ratio_max_at: float = placed("fastest.place")
    speed_ratio_min: float = placed("slowest.value")
    speed_ratio_min_at: float = placed("slowest.place")
    acceleration_ratio_max: float = placed("hardest.value")
    acceleration_ratio_max_at: float = placed("hardest.place")
    acceleration_ratio_min: float = placed("hardest_back.value")
    acceleration_ratio_min_at: float = placed("hardest_back.place")


Function = Callable[[float], float]

TURN = 2.0 * math.pi

# Every 2 deg, and halving steps towards 0 and 180 deg: near a change point the rates peak there, as narrowly as the
# coupler and the rocker come near to one line.
_HALVINGS = [math.radians(2.0) * 0.5**j for j in range(1, 15)]


def _grid(*places: float) -> list[float]:
    """It starts and ends where no linkage has its dead centres: a zero just at an end would be missed."""
    near = {math.radians(place) + side * step for place in places for side in (1, -1) for step in _HALVINGS}
    return sorted({math.radians(2.0 * i) for i in range(-54, 127)} | near)


GRID = _grid(0.0, 180.0)
SLIDER_GRID = _grid(-90.0, 90.0)
"""Of a slider-crank, whose slide line is at 90 deg: near rod = 4 cranks two extremes of its acceleration part there."""


class Turning(NamedTuple):
    """An extreme of a ratio: crank angle [rad] and value."""

    place: float
    value: float


class BackStep(NamedTuple):
    """A back-step, a stretch of negative speed.

    start, end : crank angles phi(1) and phi(2) [rad] - the output speed turns negative at the start, positive again at
        the end; either may be taken less a revolution
    crank_angle : phi12 [rad] - from start to end, 0 < phi12 < 2 pi
    angle : how far the output turns back [rad], as a magnitude
    """

    start: float
    end: float
    crank_angle: float
    angle: float


def zeros_over_turn(f: Function, grid: list[float] = GRID) -> list[float]:
    """Zeros of a periodic function at which its sign changes.

    Parameters
        f : function of the crank angle [rad]
        grid : list of float [rad] - places between which signs are compared
    Returns
        zeros : list of float [rad] - ascending in [0, 2 pi)
    Notes
        Signs on a grid of 2 deg, refined towards 0 and 180 deg, then bracketed roots; two zeros within one step of
        the grid are missed.
    Example
        >>> [round(x, 12) for x in zeros_over_turn(math.cos)]
        [1.570796326795, 4.712388980385]
    """
    # twice: a tiny negative angle is rounded up to a whole revolution by the first
    return sorted(dict.fromkeys(root % TURN % TURN for root in roots_on(f, grid)))


def turnings(speed: Function, acceleration: Function, grid: list[float] = GRID) -> list[Turning]:
    """Extremes of the speed ratio over the revolution, by the zeros of its derivative.

    Parameters
        speed, acceleration : functions of the crank angle [rad], the second the derivative of the first
        grid : list of float [rad] - as of `zeros_over_turn`
    Returns
        turnings : list of Turning - in the order of the crank angle
    Example
        >>> [round(t.value, 12) for t in turnings(lambda x: 1 + 2 * math.sin(x), lambda x: 2 * math.cos(x))]
        [3.0, -1.0]
    """
    return [Turning(place, speed(place)) for place in zeros_over_turn(acceleration, grid)]


def bracketed(f: Function, lows: Sequence[float], highs: Sequence[float], ends: Any) -> list[float]:
    """Roots of a function between places, where its values are known."""
    pairs = zip(lows, highs, zip(*ends, strict=True), strict=True)
    return [bracketed_root(f, low, high, ends=values) for low, high, values in pairs]


def crossings(
    extremes: Sequence[Turning], tolerance: float, period: float | None = TURN
) -> list[tuple[Turning, Turning]]:
    """The extremes of a speed before and after each of its zeros; parameters as of `standstills`."""
    around = extremes
    if period is not None and extremes:
        around = [*extremes, Turning(extremes[0].place + period, extremes[0].value)]
    return [
        (one, other)
        for one, other in pairwise(around)
        if min(abs(one.value), abs(other.value)) > tolerance and one.value * other.value < 0.0
    ]


def standstills(
    speed: Any,
    extremes: Sequence[Turning],
    tolerance: float,
    period: float | None = TURN,
    roots: Callable[..., list[float]] = bracketed,
) -> list[float]:
    """Crank angles at which the speed ratio is zero, touching zeros among them.

    Parameters
        speed : function of the crank angle [rad]
        extremes : list of Turning - of that speed; between two of them it runs one way, so no zero is missed
        tolerance : float - an extreme within it of zero is one momentary standstill
        period : float [rad] - after which the speed repeats; None over a range, whose ends are among the extremes
        roots : as `bracketed`
    Returns
        places : list of float [rad] - ascending, within a period from 0
    Example
        >>> f, slope = (lambda x: 1 + 2 * math.sin(x)), (lambda x: 2 * math.cos(x))
        >>> [round(math.degrees(x), 9) for x in standstills(f, turnings(f, slope), 1e-9)]
        [210.0, 330.0]
    """
    between = crossings(extremes, tolerance, period)
    places = [turning.place for turning in extremes if abs(turning.value) <= tolerance]
    if between:  # values as they were compared: a revolution later the speed is rounded otherwise
        (lows, first), (highs, last) = (zip(*side, strict=True) for side in zip(*between, strict=True))
        places += roots(speed, lows, highs, (first, last))
    return sorted(place if period is None else place % period for place in places)


def gain(course: Any, start: float, end: float) -> float:
    """Output angle gained between crank angles [rad], without cancellation where they are near.

    The speed is analytic in a strip around the real crank angles: gamma reaches 0 or pi, or B reaches D, no nearer to
    the axis than the minimum transmission angle and |ln(d/a)| (ad < bc in a linkage that turns).

    Parameters
        course : the output of a four-bar, with linkage, angle(phi) and speed(phi)
    """
    links, way = course.linkage, 2.0 * abs(end - start)
    if way < 0.5 * math.pi and way < min(links.min_transmission_angle(), abs(math.log(links.frame / links.crank))):
        return integral(course.speed, start, end)
    return float(course.angle(end) - course.angle(start))


def regained(course: Any, step: BackStep, *, backwards: bool = False) -> float:
    """Crank angle from the start of a back-step until the output is back at its place, or from its end backwards [rad].

    The output of `course`, as of `gain`, rises outside of the back-step all the way: a bracketed root.
    """
    start, end = step.start, step.start + step.crank_angle

    def gained(x: float) -> float:
        return gain(course, end - x, end) if backwards else gain(course, start, start + x)

    return bracketed_root(gained, step.crank_angle, TURN, ends=(min(-step.angle, 0.0), gained(TURN)))


def backward(speed: Function, places: list[float]) -> list[tuple[float, float]]:
    """The stretches between neighbouring standstills, of `standstills`, in which the speed ratio is negative [rad]."""
    if len(places) < 2:
        return []
    return [(a, b) for a, b in pairwise([*places, places[0] + TURN]) if speed(0.5 * (a + b)) < 0.0]


def back_steps(speed: Function, angle: Function, places: list[float]) -> list[BackStep]:
    """The stretches between neighbouring standstills in which the speed ratio is negative.

    Parameters
        speed, angle : functions of the crank angle [rad] - of the output, the first the derivative of the second
        places : list of float [rad] - from `standstills`
    Returns
        steps : list of BackStep - a momentary standstill makes none
    Example
        >>> speed, angle = (lambda x: 1 + 2 * math.sin(x)), (lambda x: x - 2 * math.cos(x))
        >>> [(round(s.crank_angle, 12), round(s.angle, 12)) for s in back_steps(speed, angle, [3.66, 5.76])]
        [(2.1, 1.369683001218)]
    """
    return [BackStep(a, b, b - a, angle(a) - angle(b)) for a, b in backward(speed, places)]
