"""How near links come to an axis of the frame: arms that turn about a pivot in closed form, other lines by their ends.

Links are lines of no width, since design files give them none.
"""

from __future__ import annotations

import cmath
import math
from typing import NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Points, Reals


class Near(NamedTuple):
    """The minimum distance [mm] of a place from what turns, and how far that has turned there [rad]."""

    distance: float
    turned: float


def beside_turning_arm(place: complex, arm: complex, sweep: float) -> Near:
    """A place from the line pivot-end of an arm over its sweep: 0 where the arm passes over it.

    Parameters
        place : complex [mm] - seen from the pivot
        arm : complex [mm] - from the pivot to the end at the start of the sweep
        sweep : float [rad] - turned in all, its sign the sense; less than a revolution
    Returns
        near : Near - `turned` positive in the sense of the sweep
    Example
        >>> beside_turning_arm(50j, 100 + 0j, math.pi).distance, beside_turning_arm(-5 - 3j, 100 + 0j, 3.0).turned
        (0.0, 3.0)
    """
    seen = _ahead(place, arm, sweep)
    lead, length = cmath.phase(seen) % math.tau, abs(arm)
    if lead <= abs(sweep):
        return Near(max(abs(seen) - length, 0.0), lead)
    ends = ((_beside(seen * cmath.exp(-1j * turned), length), turned) for turned in (0.0, abs(sweep)))
    return Near(*min(ends))


def beside_turning_pin(place: complex, arm: complex, sweep: float) -> Near:
    """A place from the end of an arm over its sweep; parameters and result as of `beside_turning_arm`.

    Example
        >>> beside_turning_pin(50j, 100 + 0j, math.pi).distance
        50.0
    """
    seen = _ahead(place, arm, sweep)
    lead, length = cmath.phase(seen) % math.tau, abs(arm)
    if lead <= abs(sweep):
        return Near(abs(abs(seen) - length), lead)
    return Near(*min((abs(seen * cmath.exp(-1j * turned) - length), turned) for turned in (0.0, abs(sweep))))


def beside_line(place: Points | complex, start: Points, end: Points | complex) -> Reals:
    """Distance of a place from the line between two joints, at every position of them.

    Parameters
        place : complex or (N,) array [mm]
        start, end : (N,) arrays [mm] - which never coincide; an end that stands still may be one place
    Returns
        distance : (N,) array [mm]
    Example
        >>> beside_line(1 + 2j, np.array([0j, 2 + 2j]), np.array([4 + 0j, 4 + 2j])).tolist()
        [2.0, 1.0]
    """
    line, seen = end - start, place - start
    along = (seen.real * line.real + seen.imag * line.imag) / (line.real**2 + line.imag**2)
    return np.abs(np.clip(along, 0.0, 1.0) * line - seen)


def _ahead(place: complex, arm: complex, sweep: float) -> complex:
    """The place seen along the arm at its start, mirrored where the sweep is clockwise."""
    seen = place * arm.conjugate() / abs(arm)
    return seen if sweep >= 0.0 else seen.conjugate()


def _beside(seen: complex, length: float) -> float:
    return abs(seen - min(max(seen.real, 0.0), length))
