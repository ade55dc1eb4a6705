"""Dwell within a tolerance: the longest crank angle over which the output stays within +- tol of some place."""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.fourbar import FourBar
from gearlink.core.numerics.roots import bracketed_root
from gearlink.core.three_gear.dwells import back_step, dwell_positions
from gearlink.core.three_gear.momentary_dwell import wrap
from gearlink.core.three_gear.motion import GearTrain, mean_ratio, output_angle, output_speed, speed_extremes

_TURN = 2.0 * math.pi
_FIT = 1e-13


@dataclass(frozen=True, slots=True)
class ToleranceDwell:
    """A dwell within a tolerance.

    start : float [rad] - crank angle of its start, in [0, 2 pi)
    crank_angle : float [rad] - its length
    output_angle : float [rad] - the middle of the output's range there, counted as `output_angle` does from the crank
        angle 0 with the start as it stands
    """

    start: float
    crank_angle: float
    output_angle: float


@dataclass(frozen=True, slots=True)
class _Valley:
    """Part of the turn around the least speed: output angle, its rate, and the crank angles that bound the parts.

    first, second : phi(1), phi(2), or the least speed's place twice; low, high : the greatest speed's before and after
    """

    angle: Callable[[float], float]
    speed: Callable[[float], float]
    first: float
    second: float
    low: float
    high: float

    def reach(self, level: float, left: float, right: float) -> float:
        """Crank angle between two others where the output passes a level."""
        f_left, f_right = self.angle(left) - level, self.angle(right) - level
        if f_left * f_right >= 0.0:
            return left if abs(f_left) < abs(f_right) else right
        return bracketed_root(lambda phi: self.angle(phi) - level, left, right)


def tolerance_from_backlash(backlash: float, output_radius: float) -> float:
    """Tolerance of the output angle that a backlash at the output gear's circle takes up.

    tol = j/(2 r5)

    Parameters
        backlash : float [mm] - j, whole play at the circle r5
        output_radius : float [mm] - r5
    Returns
        tolerance : float [rad] - to either side
    Raises
        NoSolution - for a backlash or a radius that is not positive
    Example
        >>> round(math.degrees(tolerance_from_backlash(0.3419089045018483, 75.0)), 9)
        0.130599581
    """
    if not (backlash > 0.0 and output_radius > 0.0):
        raise NoSolution(
            f"backlash {backlash:g} mm at radius {output_radius:g} mm gives no tolerance; both must be positive"
        )
    return backlash / (2.0 * output_radius)


def tolerance_dwell(linkage: FourBar, train: GearTrain, tolerance: float) -> ToleranceDwell:
    """Longest crank interval over which the output stays within +- tol of a place that is free to choose.

    phi5(R) - phi5(L) = 2 tol  and  W(L) = W(R) >= 0,   both standstills between L and R;
    with a back-step D > 2 tol instead  phi5(L) = phi5(R) = phi5(1) - 2 tol  or  phi5(2) + 2 tol, the longer

    Parameters
        linkage : FourBar - crank-rocker or drag link
        train : GearTrain
        tolerance : float [rad] - 0 < tol < pi times the mean ratio
    Returns
        dwell : ToleranceDwell [rad]
    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole turn lies within it
    Notes
        Bracketed roots inside a bracketed root, all monotone between the greatest speeds before and after the
        least one. Where W(L) = W(R) cannot hold with both standstills inside, the end that binds is taken. At
        tol = D/2 and small back-steps the dwell is one third longer than phi13, which uses one side of the band.
    Example
        >>> found = tolerance_dwell(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), math.radians(1.0))
        >>> round(math.degrees(found.start), 9), round(math.degrees(found.crank_angle), 9)
        (217.998931749, 123.008371818)

    Source
        own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
    """
    limit = math.pi * mean_ratio(linkage, train)
    if not 0.0 < tolerance < limit:
        raise NoSolution(
            f"the tolerance of the dwell is {math.degrees(tolerance):.9g} deg; it must be positive and below "
            f"{math.degrees(limit):.9g} deg, half of what the output gains in a turn of the crank"
        )
    valley = _valley(linkage, train)
    drop = max(0.0, valley.angle(valley.first) - valley.angle(valley.second))
    # The longest interval jumps where the back-step just fits: a tolerance meant to fit it must not miss it by an ulp.
    if drop > 2.0 * tolerance * (1.0 + _FIT) + _FIT * limit:
        left, right, middle = _around_one_extreme(valley, tolerance)
    else:
        left, right, middle = _around_both(valley, tolerance, drop)
    start = wrap(left)
    return ToleranceDwell(start, right - left, middle - mean_ratio(linkage, train) * (left - start))


def _valley(linkage: FourBar, train: GearTrain) -> _Valley:
    extremes = speed_extremes(linkage, train)
    first = second = extremes.least_angle
    if len(dwell_positions(linkage, train)) == 2:
        step = back_step(linkage, train)
        first, second = step.start, step.start + step.crank_angle
    after = first + (extremes.greatest_angle - first) % _TURN
    return _Valley(
        lambda phi: output_angle(linkage, train, phi),
        lambda phi: output_speed(linkage, train, phi),
        first,
        second,
        after - _TURN,
        after,
    )


def _around_both(valley: _Valley, tolerance: float, drop: float) -> tuple[float, float, float]:
    """Interval that holds both standstills; p is what the output rises from L to its place at phi(2)."""
    bottom = valley.angle(valley.second)
    spare = max(0.0, 2.0 * tolerance - drop)
    top = bottom + drop
    most_left = bottom - valley.angle(valley.low)
    most_right = valley.angle(valley.high) - top

    def ends(p: float) -> tuple[float, float]:
        left = valley.reach(bottom - p, valley.low, valley.first)
        return left, valley.reach(top + spare - p, valley.second, valley.high)

    def gain(p: float) -> float:
        left, right = ends(p)
        return valley.speed(right) - valley.speed(left)

    low, high = max(0.0, spare - most_right), min(spare, most_left)
    if gain(low) <= 0.0:
        p = low
    elif gain(high) >= 0.0:
        p = high
    else:
        p = bracketed_root(gain, low, high)
    left, right = ends(p)
    return left, right, bottom - p + tolerance


def _around_one_extreme(valley: _Valley, tolerance: float) -> tuple[float, float, float]:
    """The longer of the intervals around the place of phi(1) and that of phi(2), for a back-step above 2 tol."""
    top, bottom = valley.angle(valley.first), valley.angle(valley.second)
    floor, ceiling = top - 2.0 * tolerance, bottom + 2.0 * tolerance
    before = (
        valley.reach(floor, valley.second - _TURN, valley.first),
        valley.reach(floor, valley.first, valley.second),
    )
    after = (
        valley.reach(ceiling, valley.first, valley.second),
        valley.reach(ceiling, valley.second, valley.first + _TURN),
    )
    if before[1] - before[0] >= after[1] - after[0]:
        return *before, floor + tolerance
    return *after, ceiling - tolerance
