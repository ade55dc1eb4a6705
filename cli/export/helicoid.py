"""The flanks of helical gears as tensor products: the cubics of a section times a spline that turns it along the axis.

S(u, v) = c(u) q(v) at the height z(v), with q close to exp(i angle s) at the height s times the width: the section's
own splines stay as they are, and what q is off the circle, times the radius, is all that the flanks are off.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.cli.export.sampling import Points, Reals
from gearlink.core.base.errors import GearlinkError

_FIRST_STEP = 0.5
_MOST_SPANS = 500
_PROBES = 16


class TooLong(GearlinkError):
    """The gear turns so often over its width that its file would be too large."""


@dataclass(frozen=True)
class Turning:
    """A turn along the axis as a cubic B-spline over 0 to 1.

    Attributes
        knots : with four at each end
        control : complex - control points of the turned unit vector; the first is 1, the last lies on the circle
        heights : share of the width at each control point
        error : float - greatest distance from the circle's point at the same height, of radius 1
    """

    knots: Reals
    control: Points
    heights: Reals
    error: float


def turning(angle: float, tolerance: float) -> Turning:
    """The turn by an angle [rad], refined until it is within a tolerance of the exact one.

    Parameters
        angle : float [rad]
        tolerance : float - greatest distance at radius 1
    Raises
        TooLong - where that takes more spans than a file should hold
    Notes
        Cubic interpolation with the slopes at both ends: 1/384 of the fourth power of the turn in a span.
    Example
        >>> made = turning(0.6, 1e-7)
        >>> made.error < 1e-7, round(float(made.control[-1].real - math.cos(0.6)), 15)
        (True, 0.0)
    """
    from scipy.interpolate import make_interp_spline

    spans = max(1, math.ceil(abs(angle) / _FIRST_STEP))
    while spans <= _MOST_SPANS:
        places = np.linspace(0.0, 1.0, spans + 1)
        exact = np.exp(1j * angle * places)
        slopes = 1j * angle * exact[[0, -1]]
        first, last = ([(1, [slope.real, slope.imag])] for slope in slopes.tolist())
        spline = make_interp_spline(places, np.column_stack([exact.real, exact.imag]), 3, bc_type=(first, last))
        probes = np.linspace(0.0, 1.0, _PROBES * spans + 1)
        off = spline(probes) @ np.array([1.0, 1j]) - np.exp(1j * angle * probes)
        if float(np.abs(off).max()) <= tolerance:
            knots, control = spline.t, spline.c @ np.array([1.0, 1j])
            control[[0, -1]] = exact[[0, -1]]
            heights = np.array([knots[i + 1 : i + 4].mean() for i in range(control.size)])
            return Turning(knots, control, heights, float(np.abs(off).max()))
        spans *= 2
    raise TooLong(
        f"a helical gear that turns by {math.degrees(abs(angle)):.4g} deg over its width is too long for a file: "
        "give a smaller --width, or a coarser --tolerance"
    )
