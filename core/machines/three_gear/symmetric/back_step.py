"""Back-step and dwell of the symmetric three-gear four-bar (I = 1), exactly and in both directions.

All of it follows from two numbers, n = 1 - i3 > 1 and h = phi12/2, half the crank angle of the back-step: around
the crank angle 270 deg (90 deg in the mirrored assembly)

    W(270 deg + y) = 1 - n k cos(y)/sqrt(1 - k^2 sin^2(y)),    1/k = sqrt(n^2 cos^2(h) + sin^2(h))

Differences that vanish like h^3 (back-step, regained place) are formed from series or integrals, not from the
angles themselves, so a design next to the momentary dwell keeps all its digits.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above
from gearlink.core.machines.three_gear.symmetric.family import check_back_step_crank_angle, check_ratio
from gearlink.core.numerics.gauss import GAUSS_NODES, GAUSS_WEIGHTS
from gearlink.core.numerics.roots import bracketed_root

# tan h: the closed form then loses no more than 12 ulp, and the 29th term is below 1e-17 of the first.
_SERIES_BELOW = 0.5
_INTEGRAL_BELOW = 0.2  # h [rad]; ten Gauss points over 4 h are then exact to rounding
_POLISHED_BELOW = 0.75  # h [rad]; the closed form loses some ulp / h^2, which a step with the integral gives back
_POLISHED_I3 = -0.1
_ROUNDING = 1e-9  # [rad]; at the limits 6e-13 of the wrong sign were seen, at i3 = -100
_PART = 0.6  # longest stretch [rad] of that integral for ten Gauss points
_NODES = tuple((s * x, w) for x, w in zip(GAUSS_NODES, GAUSS_WEIGHTS, strict=True) for s in (-1.0, 1.0))


def back_step_angle(i3: float, back_step_crank_angle: float) -> float:
    """Angle by which the output turns back, as a magnitude.

    |phi5(2) - phi5(1)| = 2 n atan(tan(h)/n) - 2 h,   n = 1 - i3,   h = phi12/2

    Parameters
        i3 : float - negative
        back_step_crank_angle : float [rad] - phi12, 0 <= phi12 < pi
    Returns
        angle : float [rad] - 0 at phi12 = 0, below 2 tan(h) - 2 h and below -i3 pi
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Notes
        A series in tan(h) for small h and an addition theorem for larger: some ulp everywhere, where the plain
        formula keeps 1 ulp / h^2.
    Example
        >>> round(math.degrees(back_step_angle(-2.0, math.radians(120.0))), 12)
        60.0

    Source
        thesis (4-19)
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    return _back_step(i3 / (i3 - 1.0), 0.5 * back_step_crank_angle)


def i3_for_back_step(back_step_angle: float, back_step_crank_angle: float) -> float:
    """Gear ratio i3 that turns the output back by a wanted angle within a wanted crank angle.

    2 n atan(tan(h)/n) - 2 h = angle   solved for   n = 1 - i3

    Parameters
        back_step_angle : float [rad] - magnitude, 0 < angle < 2 tan(h) - 2 h
        back_step_crank_angle : float [rad] - phi12 = 2 h, 0 < phi12 < pi
    Returns
        i3 : float - negative
    Raises
        NoSolution - for an angle outside the range: i3 -> 0 and i3 -> -infinity are its ends
    Notes
        Bracketed root in (n - 1)/n, monotone; the condition number grows at the upper limit, where i3 -> -infinity.
    Example
        >>> round(i3_for_back_step(math.radians(20.0), math.radians(90.0)), 12)
        -1.779808035671

    Source
        thesis (4-19), inverted; thesis figure 4-5
    """
    check_back_step_crank_angle(back_step_crank_angle)
    h = 0.5 * back_step_crank_angle
    limit = _back_step(1.0, h)
    if not 0.0 < back_step_angle < limit:
        raise NoSolution(
            f"no gear ratio gives a back-step of {_deg(back_step_angle)} deg within {_deg(2.0 * h)} deg of the "
            f"crank: the back-step must lie between 0 and {_deg(limit)} deg; reduce it or enlarge the crank angle"
        )
    v = bracketed_root(lambda v: _back_step(v, h) - back_step_angle, 0.0, 1.0)
    if v == 1.0:
        raise NoSolution(
            f"a back-step of {_deg(back_step_angle)} deg within {_deg(2.0 * h)} deg of the crank is the limit, "
            f"{_deg(limit)} deg, to rounding, and takes an endless idler: reduce it or enlarge the crank angle"
        )
    return -v / (1.0 - v)


def crank_angle_for_back_step(i3: float, back_step_angle: float) -> float:
    """Crank angle phi12 for which the output of given gears turns back by a wanted angle.

    Parameters
        i3 : float - negative
        back_step_angle : float [rad] - magnitude, 0 < angle < -i3 pi
    Returns
        phi12 : float [rad] - 0 < phi12 < pi
    Raises
        NoSolution - for an angle outside the range
    Notes
        Bracketed root of `back_step_angle`, which rises monotonically from 0 to -i3 pi.
    Example
        >>> round(math.degrees(crank_angle_for_back_step(-2.0, math.radians(60.0))), 9)
        120.0

    Source
        thesis (4-19), inverted
    """
    check_ratio(i3)
    limit = -i3 * math.pi
    if not 0.0 < back_step_angle < limit:
        raise NoSolution(
            f"no frame length gives a back-step of {_deg(back_step_angle)} deg with i3 = {i3:.9g}: it must lie "
            f"between 0 and -i3 * 180 = {_deg(limit)} deg; reduce it or take an idler of more teeth"
        )
    v = i3 / (i3 - 1.0)
    return 2.0 * _rising_root(lambda h: _back_step(v, h) - back_step_angle, 0.0, 0.5 * math.pi)


def dwell_angle(i3: float, back_step_crank_angle: float) -> float:
    """Crank angle phi13 from the start of the back-step to where the output regains its place, exactly.

    n [asin(k sin(y)) + asin(k sin(h))] = h + y,   phi13 = y + h,   h = phi12/2

    Parameters
        i3 : float - negative
        back_step_crank_angle : float [rad] - phi12, 0 <= phi12 < pi
    Returns
        phi13 : float [rad] - between phi12 and 2 phi12; 1.5 phi12 exactly for i3 = -2 and for phi12 -> 0
    Raises
        NoSolution - for i3 >= 0 or phi12 outside [0, pi)
    Notes
        Bracketed root of a function that falls monotonically from y = h on; within 6 ulp for i3 <= -0.1. The thesis
        takes 1.5 phi12 (4-17), which is within 3 % for phi12 <= 90 deg and i3 <= -1.
    Example
        >>> round(math.degrees(dwell_angle(-1.0, math.radians(90.0))), 10)
        131.4096221093

    Source
        own derivation: thesis (4-16) set to zero; thesis (4-17) is its approximation
    """
    check_ratio(i3)
    check_back_step_crank_angle(back_step_crank_angle)
    h = 0.5 * back_step_crank_angle
    if h == 0.0:
        return 0.0
    y = _rising_root(lambda y: -_fallen(i3, h, y), h, min(3.0 * h, dwell_angle_limit(i3) - h))
    if _polished(i3, h):
        y -= _fallen_by_integral(i3, h, y) / _reverse(i3, h, y)
    return h + y


def dwell_angle_limit(i3: Any) -> Any:
    """Upper limit of the dwell angle phi13, approached as phi12 -> pi and the frame ratio -> 1; of one i3 < 0 or many.

    phi13 < 2 pi (1 - i3)/(2 - i3)

    Example
        >>> round(math.degrees(dwell_angle_limit(-1.0)), 9)
        240.0
    """
    return 2.0 * math.pi * (1.0 - i3) / (2.0 - i3)


def crank_angle_for_dwell(i3: float, dwell_angle: float) -> float:
    """Crank angle of the back-step phi12 for which the dwell angle phi13 is met exactly.

    Parameters
        i3 : float - negative
        dwell_angle : float [rad] - phi13, 0 < phi13 < 2 pi (1 - i3)/(2 - i3)
    Returns
        phi12 : float [rad] - between phi13/2 and phi13; about phi13/1.5
    Raises
        NoSolution - for a dwell angle outside the range
    Notes
        Bracketed root in h of the equation of `dwell_angle` with y = phi13 - h.
    Example
        >>> round(math.degrees(crank_angle_for_dwell(-1.8, math.radians(135.0))), 9)
        90.30114714

    Source
        own derivation: thesis (4-16) set to zero
    """
    check_ratio(i3)
    limit: float = dwell_angle_limit(i3)
    if not 0.0 < dwell_angle < limit:
        raise NoSolution(
            f"the dwell angle {_deg(dwell_angle)} deg is out of reach with i3 = {i3:.9g}: it must lie above 0 and "
            f"below 360 (1 - i3)/(2 - i3) = {_deg(limit)} deg; reduce it{_ratio_remedy(dwell_angle)}"
        )
    high = min(0.5 * dwell_angle, 0.5 * math.pi)
    h = _rising_root(lambda h: _fallen(i3, h, dwell_angle - h), 0.25 * dwell_angle, high)
    if _polished(i3, h):
        near = 1e-4 * h
        slope = (_fallen(i3, h + near, dwell_angle - h - near) - _fallen(i3, h - near, dwell_angle - h + near)) / near
        h -= 2.0 * _fallen_by_integral(i3, h, dwell_angle - h) / slope
    return 2.0 * h


def window_limit(i3: Any) -> Any:
    """Upper limit of the crank angle of an equal-ripple dwell, whatever the tolerance; of one i3 or many.

    Phi < 4 pi n/(n + 1) - pi,   n = 1 - i3

    Example
        >>> round(math.degrees(window_limit(-1.8)), 9)
        350.526315789
    """
    return math.pi * (3.0 * (1.0 - i3) - 1.0) / (2.0 - i3)


def crank_angle_for_window(i3: float, window: float) -> float:
    """Crank angle phi12 of the back-step whose whole band the output touches twice over a window: the flattest.

    n [asin(k sin(Y)) + asin(k sin(h))] = Y + h,   Y = window/2,   h = phi12/2

    Parameters
        i3 : float - negative
        window : float [rad] - Phi, 0 < Phi < `window_limit`
    Returns
        phi12 : float [rad] - between Phi/3 and Phi; Phi/2 exactly for i3 = -2 and for Phi -> 0
    Raises
        NoSolution - for a window outside the range
    Notes
        Bracketed root in h of the equation of `dwell_angle` with y = Phi/2, polished as there.
    Example
        >>> round(math.degrees(crank_angle_for_window(-1.8, math.radians(90.0))), 9)
        45.052599378

    Source
        own derivation: by the oddness of the motion about 270 deg the output spans the band from phi(2) on one side
        to phi(1) on the other
    """
    check_ratio(i3)
    limit: float = window_limit(i3)
    if not 0.0 < window < limit:
        raise NoSolution(
            f"a window of {_deg(window)} deg is out of reach with i3 = {i3:.9g}: it must lie above 0 and below "
            f"{_deg(limit)} deg, whatever the tolerance that a back-step fills; reduce it"
        )
    y = 0.5 * window
    h = _rising_root(lambda h: _fallen(i3, h, y), y / 3.0, min(y, 0.5 * math.pi))
    if _polished(i3, h):
        near = 1e-4 * h
        slope = (_fallen(i3, h + near, y) - _fallen(i3, h - near, y)) / near
        h -= 2.0 * _fallen_by_integral(i3, h, y) / slope
    return 2.0 * h


def _rising_root(f: Callable[[float], float], low: float, high: float) -> float:
    """Root of a function that is negative at the low end and positive at the high one, or at a limit zero there.

    At a limit rounding may leave either sign, and that end is the root.
    """
    first, last = f(low), f(high)
    if 0.0 <= first < _ROUNDING:
        return low
    return high if -_ROUNDING < last <= 0.0 else bracketed_root(f, low, high, ends=(first, last))


def _back_step(v: float, h: float) -> float:
    """Equation (4-19) in v = (n - 1)/n, 0 <= v <= 1 (1: i3 = -infinity), and h."""
    t, x = math.tan(h), 1.0 - v
    if t < _SERIES_BELOW:
        log_x = math.log1p(-v) if v < 1.0 else -math.inf
        terms = ((-1.0) ** j * t ** (2 * j + 1) / (2 * j + 1) * math.expm1(2 * j * log_x) for j in range(28, 0, -1))
        return 2.0 * sum(terms)
    # n atan(t/n) - atan(t) with the part (n - 1) drawn out of both terms
    first = v * math.atan(t * x) / x if x > 0.0 else t
    return 2.0 * (first - math.atan(v / (1.0 / t + x * t)))


def _fallen(i3: float, h: float, y: float) -> float:
    """How far the output at 270 deg + y stands below its place at 270 deg - h; zero at y = phi13 - h."""
    n, rest = 1.0 - i3, i3 * (i3 - 2.0) * math.cos(h) ** 2
    if h < _INTEGRAL_BELOW:
        return _fallen_by_integral(i3, h, y)
    at_y = math.atan2(math.sin(y), math.sqrt(rest + math.cos(y) ** 2))
    return n * (at_y + math.atan(math.tan(h) / n)) - h - y


def _polished(i3: float, h: float) -> bool:
    """Whether a last step with the integral gives digits back: ten Gauss points need a singularity far enough away."""
    return i3 <= _POLISHED_I3 and _INTEGRAL_BELOW <= h < _POLISHED_BELOW


def _fallen_by_integral(i3: float, h: float, y: float) -> float:
    """The same as the integral of `_reverse` from -h to y: no cancellation."""
    n, rest = 1.0 - i3, i3 * (i3 - 2.0)
    square, constant = math.sin(h) ** 2, rest * math.cos(h) ** 2
    count = math.ceil((h + y) / _PART)
    half = 0.5 * (h + y) / count
    total = 0.0
    for part in range(count):
        mean = (2 * part + 1) * half - h
        for x, w in _NODES:
            place = mean + x * half
            cosine = math.cos(place)
            root = math.sqrt(constant + cosine * cosine)
            if cosine < 0.0:
                total += w * (n * cosine / root - 1.0) / rest
            else:
                total += w * (square - math.sin(place) ** 2) / (root * (root + n * cosine))
    return rest * half * total


def _reverse(i3: float, h: float, y: float) -> float:
    """Backward speed ratio -W at 270 deg + y, as a product that vanishes exactly at y = +-h."""
    n, rest = 1.0 - i3, i3 * (i3 - 2.0)
    root = math.sqrt(rest * math.cos(h) ** 2 + math.cos(y) ** 2)
    if math.cos(y) < 0.0:
        return n * math.cos(y) / root - 1.0
    return rest * math.sin(h - y) * math.sin(h + y) / (root * (root + n * math.cos(y)))


def _deg(angle: float) -> str:
    return f"{math.degrees(angle):.9g}"


def _ratio_remedy(phi13: float) -> str:
    """The i3 from which on a dwell angle is within reach, where there is one."""
    if not 0.0 < phi13 < 2.0 * math.pi:
        return ""
    least = 2.0 * (phi13 - math.pi) / (2.0 * math.pi - phi13)
    return f" or take -i3 above {safely_above(least, 9)} (an idler of more teeth)"
