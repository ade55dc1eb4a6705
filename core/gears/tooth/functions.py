"""The functions that formulas of gears are made of: the elementary ones and involutes, for one number."""

from __future__ import annotations

from dataclasses import dataclass

from gearlink.core.gears.tooth.involute import involute, involute_rise, rise_of_involute
from gearlink.core.numerics.elementary import Elementary, One, Two


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class GearFunctions(Elementary):
    """Functions of numbers, or of arrays element by element; involutes as in `gearlink.core.gears.tooth.involute`."""

    involute: One = involute
    involute_rise: Two = involute_rise
    rise_of_involute: Two = rise_of_involute


SCALARS = GearFunctions()
