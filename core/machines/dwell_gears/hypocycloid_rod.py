"""Rod lengths of a hypocycloid dwell that are best in some sense; each is judged on the slider's own motion."""

from __future__ import annotations

import math
from collections.abc import Callable

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.machines.dwell_gears.hypocycloid import HypocycloidSlider, osculating, tangent_circle, widest_offset
from gearlink.core.numerics.roots import maximum

_SCAN = 120


def minimax(planet_radius: float, cusps: int, angle: float) -> float:
    """Rod length with the smallest maximum deviation from the slider's position in mid-dwell.

    max |s(t) - s(0)| over +- angle/2  ->  min

    Parameters
        planet_radius : float [mm]
        cusps : int
        angle : float [rad] - carrier angle of the dwell, up to the whole arc
    Returns
        L : float [mm]
    Raises
        NoSolution - where no circle touches the arc over that angle
    Notes
        Between the tangent circle and the circle of curvature; place exact to about 1e-9 of the length.
    Example
        >>> round(minimax(1.0, 3, math.radians(120.0)), 6)
        7.191266
    """

    def greatest(rod: float) -> float:
        low, high = HypocycloidSlider(planet_radius, cusps, rod).deviation_range(angle)
        return max(high, -low)

    return _best(planet_radius, cusps, lambda rod: -greatest(rod), angle)


def least_ripple(planet_radius: float, cusps: int, angle: float) -> float:
    """Rod length with the smallest range of the slider's position over a carrier angle, the place itself free.

    max s - min s over +- angle/2  ->  min

    Parameters
        planet_radius, cusps, angle : as of `minimax`
    Returns
        L : float [mm]
    Raises
        NoSolution - as `minimax`
    Notes
        The result is the tangent circle through the ends of the dwell, or lies close by it.
    Example
        >>> round(least_ripple(1.0, 3, math.radians(120.0)), 6)
        7.0
    """

    def quality(rod: float) -> float:
        return -HypocycloidSlider(planet_radius, cusps, rod).ripple(angle)

    return _best(planet_radius, cusps, quality, angle)


def widest_dwell(planet_radius: float, cusps: int, tolerance: float) -> float:
    """Rod length with the widest dwell within +- a tolerance.

    Parameters
        planet_radius : float [mm]
        cusps : int
        tolerance : float [mm] - half the range that is allowed
    Returns
        L : float [mm]
    Raises
        NoSolution - for a tolerance that is not positive or not below half the stroke
    Notes
        The width jumps where a hump leaves the band, so that the best rod stands at such an edge: a scan over the
        curvature, then golden section about the best.
    Example
        >>> rod = widest_dwell(1.0, 3, 0.0111)
        >>> HypocycloidSlider(1.0, 3, rod).dwell_angle(0.0111) >= HypocycloidSlider(1.0, 3, 7.0).dwell_angle(0.0111)
        True
    """

    def quality(rod: float) -> float:
        return HypocycloidSlider(planet_radius, cusps, rod).dwell_angle(tolerance)

    return _best(planet_radius, cusps, quality)


def _best(radius: float, cusps: int, quality: Callable[[float], float], angle: float | None = None) -> float:
    """Rod of the maximum quality, sought over its curvature 1/L from well below to well above the named circles."""
    if angle is not None and not 0.0 < angle <= 2.0 * math.pi / cusps * (1.0 + 1e-12):
        raise NoSolution(
            f"the dwell of {math.degrees(angle):.6g} deg is not on one arc",
            fix=(
                f"specify more than 0 and at most {safely_below(360.0 / cusps)} deg of the carrier, or for the "
                "widest dwell of a tolerance"
            ),
        )
    named = (tangent_circle(radius, cusps, angle), osculating(radius, cusps))
    shortest = max(0.7 * min(named), 1.001 * widest_offset(radius, cusps))
    low, high = 1.0 / (2.0 * max(named)), 1.0 / shortest
    curvatures = [low + (high - low) * i / _SCAN for i in range(_SCAN + 1)]
    values = [quality(1.0 / c) for c in curvatures]
    top = max(range(len(values)), key=values.__getitem__)
    step = (high - low) / _SCAN
    best = maximum(lambda c: quality(1.0 / c), max(low, curvatures[top] - step), min(high, curvatures[top] + step))
    return max((1.0 / best[0], *(rod for rod in named if rod > shortest)), key=quality)
