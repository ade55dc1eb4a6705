"""How far a geared five-bar is from a function that it shall generate: the structural error."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.parts.linkages.functions import Wanted

_LEVEL = 0.02
"""Extremes that differ by no more than this share of the maximum count as of one size."""


@dataclass(frozen=True, slots=True)
class StructuralError:
    """How far a five-bar is from a function.

    Fields
        greatest : float [rad] - maximum magnitude, the output gear set on its shaft as is best
        zero : float [rad] - psi0, output angle at which the function starts, so set
        places : tuple of float - shares of the input's swing at which the error is extreme, ends included
        errors : tuple of float [rad] - there
    """

    greatest: float
    zero: float
    places: tuple[float, ...]
    errors: tuple[float, ...]

    @property
    def alternations(self) -> int:
        """Extremes of the maximum size that follow each other with changing sign; 8 where nothing can be gained."""
        count, last = 0, 0.0
        for error in self.errors:
            if abs(error) >= (1.0 - _LEVEL) * self.greatest and error * last <= 0.0:
                count, last = count + 1, error
        return count


def outputs(bar: FunctionFiveBar, phi: Reals) -> Reals:
    """Output angles over ascending input angles, continuous; NaN where the five-bar opens [rad].

    Notes
        The steps must be so small that the output turns by less than half a revolution in each.
    """
    turn: Points = np.exp(1j * phi)
    joint = bar.input * turn + bar.coupler * np.exp(1j * (bar.phase + bar.coupler_ratio * phi))
    way = bar.frame - joint
    n = np.abs(way)
    c, e = bar.follower, bar.output
    with np.errstate(invalid="ignore", divide="ignore"):
        rise = 0.5 * np.sqrt((n - c + e) * (n + c - e) * (c + e - n) * (c + e + n))
        along = 0.5 * (n * n + (c - e) * (c + e))
        end = joint + way * (along + 1j * bar.assembly * rise) / (n * n)
    return np.unwrap(np.angle(end - bar.frame))


def structural_error(bar: FunctionFiveBar, start: float, wanted: Wanted) -> StructuralError:
    """The structural error of a five-bar over the swing that starts at an input angle.

    r(s) = psi(phi0 + dphi s) - psi_wanted(s) - psi0,   psi0 the middle of its maximum and minimum

    Parameters
        bar : FunctionFiveBar
        start : float [rad] - phi0
        wanted : Wanted
    Returns
        error : StructuralError
    Raises
        NoSolution - where the five-bar opens
    Example
        >>> bar = FunctionFiveBar(1.0, 0.110143, 1.18548, 0.320633, 0.503643, 2.0, 0.375818)
        >>> log = Wanted("log", (1.0, 2.0), math.radians(60.0), math.radians(90.0))
        >>> round(math.degrees(structural_error(bar, 1.343624, log).greatest), 6)
        0.005921

    Source
        own derivation; the error that is alike at its extremes: P. L. Chebyshev
    """
    bar.closure(start, start + wanted.input_swing)
    s = np.linspace(0.0, 1.0, 721)
    base = outputs(bar, start + wanted.input_swing * s)

    def error(share: Reals) -> Reals:
        near = np.asarray(np.interp(share, s, base))
        each = np.array([bar.output_angle(start + wanted.input_swing * float(x)) for x in np.atleast_1d(share)])
        psi = near + np.remainder(each - near + math.pi, 2.0 * math.pi) - math.pi
        return np.asarray(psi - wanted.output(share))

    rough = base - wanted.output(s)
    inside = [i for i in range(1, s.size - 1) if (rough[i] - rough[i - 1]) * (rough[i + 1] - rough[i]) < 0.0]
    places = [0.0]
    for i in inside:
        side = 1.0 if rough[i] > rough[i - 1] else -1.0
        top = maximum_over(lambda x, side=side: side * error(x), s[i - 1], s[i + 1], samples=4)  # type: ignore[misc]
        places.append(float(top.place))
    places.append(1.0)
    values = error(np.array(places))
    middle = 0.5 * float(values.max() + values.min())
    return StructuralError(
        0.5 * float(values.max() - values.min()), middle, tuple(places), tuple((values - middle).tolist())
    )
