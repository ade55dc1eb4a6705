"""The functions that formulas of gears are made of: the elementary ones and involutes, for one number."""

from __future__ import annotations

from dataclasses import dataclass

from gearlink.core.numerics.elementary import Elementary, One, Two
from gearlink.core.parts.gears.tooth.involute import involute, involute_rise, rise_of_involute


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class GearFunctions(Elementary):
    """Functions of numbers, or of arrays element by element; involutes as in `core.parts.gears.tooth.involute`."""

    involute: One = involute
    involute_rise: Two = involute_rise
    rise_of_involute: Two = rise_of_involute


SCALARS = GearFunctions()
