"""Dwell within a tolerance: the longest crank angle over which the output stays within +- tol of some place."""

from __future__ import annotations

import math

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.three_gear.dwell.dwells import back_step, dwell_positions
from gearlink.core.machines.three_gear.motion import (
    GearTrain,
    forward,
    mean_ratio,
    output_angles,
    output_speed,
    speed_extremes,
)
from gearlink.core.parts.linkages.band_dwell import ToleranceDwell, Valley, longest_in_band
from gearlink.core.parts.linkages.fourbar.position import FourBar

_TURN = 2.0 * math.pi


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

    Parameters
        linkage : FourBar - crank-rocker or drag link
        train : GearTrain
        tolerance : float [rad] - 0 < tol < pi times the magnitude of the mean ratio
    Returns
        dwell : ToleranceDwell [rad]
    Raises
        NoSolution - for a tolerance that is not positive, or so wide that the whole turn lies within it
    Notes
        See `gearlink.core.parts.linkages.band_dwell`.
    Example
        >>> found = tolerance_dwell(FourBar(18.0, 50.0, 100.0, 121.4), GearTrain(20, 20, 60), math.radians(1.0))
        >>> round(math.degrees(found.start), 9), round(math.degrees(found.crank_angle), 9)
        (217.998931749, 123.008371818)

    Source
        own derivation; thesis 4.2.1 speaks of a dwell "within usual deviations"
    """
    ahead = forward(linkage, train)
    found = longest_in_band(valley(linkage, ahead), tolerance)
    return found._replace(output_angle=train.sense * ahead.sense * found.output_angle)


def valley(linkage: FourBar, train: GearTrain) -> Valley:
    """The part of the turn around the least speed, of a train whose output gains angle over a turn."""
    extremes = speed_extremes(linkage, train)
    first = second = extremes.least_angle
    if len(dwell_positions(linkage, train)) == 2:
        step = back_step(linkage, train)
        first, second = step.start, step.start + step.crank_angle
    after = first + (extremes.greatest_angle - first) % _TURN
    return Valley(
        output_angles(linkage, train),
        lambda phi: output_speed(linkage, train, phi),
        first,
        second,
        after - _TURN,
        after,
        mean_ratio(linkage, train),
    )
