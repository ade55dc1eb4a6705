"""Extremes of the motion of a geared five-bar: of its coupler point, or of its output."""

from __future__ import annotations

import math

import numpy as np

from gearlink.core.machines.five_bar.function_motion import FunctionFiveBar
from gearlink.core.machines.five_bar.path import rates
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.motion_extremes import extremes

_PER_WAVE, _MOST = 360, 20_000
_TURN = 2.0 * math.pi


def path_extremes(bar: PathFiveBar, offset: complex) -> dict[str, float]:
    """Extremes of |M'| [mm/rad] and |M''| [mm/rad^2] over the period, and their input angles [rad].

    Parameters
        bar : PathFiveBar - it closes over its period
        offset : complex [mm] - u + i v
    Example
        >>> from fractions import Fraction
        >>> bar = PathFiveBar(20.0, 60.0, 60.0, 20.0, 50.0, Fraction(-1), math.radians(90.0))
        >>> round(path_extremes(bar, 60.0 + 0j)["velocity_max"], 6)
        58.52755
    """

    def size(order: int, phi: Reals) -> Reals:
        return np.asarray(np.abs(rates(bar, phi, offset)[order]))

    curves = {"velocity": lambda phi: size(0, phi), "acceleration": lambda phi: size(1, phi)}
    waves = bar.period_turns * max(1.0, abs(float(bar.ratio)))
    return extremes(curves, 0.0, bar.period, samples=min(_MOST, math.ceil(_PER_WAVE * waves)))


def function_extremes(bar: FunctionFiveBar, start: float, end: float) -> dict[str, float]:
    """Extremes of the output's speed and acceleration per input speed over a range, and their input angles [rad].

    Parameters
        bar : FunctionFiveBar
        start, end : float [rad] - it closes between them
    """

    def of(rate: str, phi: Reals) -> Reals:
        function = getattr(bar, rate)
        return np.array([function(angle) for angle in phi.tolist()])

    curves = {
        "speed_ratio": lambda phi: of("output_speed", phi),
        "acceleration_ratio": lambda phi: of("output_acceleration", phi),
    }
    waves = (end - start) / _TURN * max(1.0, abs(bar.coupler_ratio))
    return extremes(curves, start, end, samples=max(64, min(_MOST, math.ceil(_PER_WAVE * waves))))
