"""Stretches of a revolution in which the output runs at a nearly even speed.

They are windows of the crank angle whose ends stand on one level of the speed ratio W, an extreme of W between them.
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
_FIRST, _GROWTH, _MOST = 1e-9, 1.02, 1e6
Speed = Callable[[float], float]


class Uniform(NamedTuple):
    """The longest stretch: crank angle, start [rad], and level of the speed ratio."""

    angle: float
    start: float
    level: float


def uniform(speed: Speed, extremes: Sequence[Turning], share: float) -> Uniform | None:
    """The longest crank angle in which the speed ratio stays within a share of a level above 0.

    max W/min W <= rho = (1 + p)/(1 - p):  about a maximum down to W_max/rho, about a minimum above 0 up to W_min rho

    Parameters
        speed : function of the crank angle [rad] - W
        extremes : all turnings of W over a revolution
        share : float - p
    Returns
        uniform : Uniform - None where the output never runs forwards
    Source
        thesis 4.2.1; own derivation
    """
    rho = (1.0 + share) / (1.0 - share)
    values = [each.value for each in extremes]
    top, low = max(values), min(values)
    if top <= 0.0:
        return None
    if top <= rho * low:
        return Uniform(TURN, 0.0, 0.5 * (top + low))
    best: Uniform | None = None
    for place, value in extremes:
        if value <= 0.0:
            continue
        for bottom, ceiling in ((value / rho, value), (value, value * rho)):
            ends = [_leaves(speed, place, way, bottom, ceiling) for way in (-1.0, 1.0)]
            angle = ends[1] - ends[0]
            if best is None or angle > best.angle * (1.0 + 1e-12):
                best = Uniform(angle, ends[0] % TURN, 0.5 * (bottom + ceiling))
    return best


def _leaves(speed: Speed, place: float, way: float, bottom: float, ceiling: float) -> float:
    """Where the speed leaves a band, going one way from a place within it [rad]."""
    step, inside, slack = TURN / _STEPS, place, 1e-12 * ceiling
    for k in range(1, _STEPS + 1):
        there = place + way * k * step
        value = speed(there)
        if value < bottom - slack or value > ceiling + slack:
            edge = bottom if value < bottom else ceiling
            if abs(speed(inside) - edge) <= slack:
                return inside
            return bracketed_root(lambda x, edge=edge: speed(x) - edge, *sorted((inside, there)))  # type: ignore[misc]
        inside = there
    return place + way * TURN


def window_of_family(d: float, n: float, share: float) -> float:
    """Window about the maximum speed of equal gears [rad].

    W = 1 + n G,  G up to k = 2 d/(1 + d^2):  sin phi_1 = (d^2 - 1) G/(2 d sqrt(1 - G^2)) at G = ((1 + n k)/rho - 1)/n,
    window 180 deg - 2 phi_1

    Parameters
        d, n : float - frame over crank, 1 - i3
        share : float - p
    Source
        thesis (4-7); own derivation
    """
    rho, k = (1.0 + share) / (1.0 - share), 2.0 * d / (1.0 + d * d)
    g = ((1.0 + n * k) / rho - 1.0) / n
    if g <= -k:
        return TURN
    return math.pi - 2.0 * math.asin((d * d - 1.0) * g / (2.0 * d * math.sqrt(1.0 - g * g)))


def frame_ratio_for_window(angle: float, share: float, n: float, transmission: float) -> float:
    """Minimum frame over crank of equal gears without back-step that has a window [rad] about its maximum speed.

    d >= max(tan(45 deg + mu/2), n + sqrt(n^2 - 1))

    Parameters
        transmission : float [rad] - mu, minimum transmission angle
    Raises
        NoSolution - where no frame that could be built has it
    """
    d = max(math.tan(0.25 * math.pi + 0.5 * transmission), n + math.sqrt(n * n - 1.0))
    if window_of_family(d, n, share) >= angle:
        return d
    before, step = d, _FIRST
    while window_of_family(d, n, share) < angle:
        before, step = d, max(step * 2.0, d * (_GROWTH - 1.0)) if step < d * (_GROWTH - 1.0) else d * (_GROWTH - 1.0)
        d = before + step
        if d > _MOST:
            raise NoSolution(
                f"frame over crank for {short(math.degrees(angle))} deg within +-{100.0 * share:g} %: above {_MOST:g} "
                "(not computed)",
                fix="reduce the uniform angle, or raise uniform_tolerance",
            )
    return bracketed_root(lambda x: window_of_family(x, n, share) - angle, before, d)
