"""The functions of `gearlink.core.parts.gears.tooth.functions` for arrays; what one number refuses is NaN here."""

from __future__ import annotations

import math
from typing import Any

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.elementary_sweep import FUNCTIONS
from gearlink.core.parts.gears.tooth import involute_sweep
from gearlink.core.parts.gears.tooth.functions import GearFunctions


def _involute(alpha: Any) -> Any:
    angles = np.asarray(alpha, dtype=float)
    good = np.abs(angles) < 0.5 * math.pi
    if good.all():
        return involute_sweep.involute(angles)
    return np.where(good, involute_sweep.involute(np.where(good, angles, 0.0)), np.nan)


def _inverse_involute(v: Reals) -> Reals:
    good = (v >= 0.0) & (v < math.inf)
    if good.all():
        return involute_sweep.inverse_involute(v)
    return np.where(good, involute_sweep.inverse_involute(np.where(good, v, 0.0)), np.nan)


def _involute_rise(alpha: Any, rise: Any) -> Any:
    return _involute(rise) + np.tan(rise) * np.tan(alpha) * np.tan(alpha + rise)


def _rise_of_involute(alpha: Any, difference: Any) -> Any:
    rise = _inverse_involute(np.asarray(_involute(alpha) + difference)) - alpha
    finer = rise
    for _ in range(2):
        finer = finer - (_involute_rise(alpha, finer) - difference) / np.tan(alpha + finer) ** 2
    return np.where(np.abs(rise) > 0.5 * alpha, rise, finer)


ARRAYS = GearFunctions(
    **FUNCTIONS, involute=_involute, involute_rise=_involute_rise, rise_of_involute=_rise_of_involute
)
