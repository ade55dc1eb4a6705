"""A follower's motion as the table of a servo drive that lays polynomials of degree 5 between its rows."""

from __future__ import annotations

import functools
import math
from collections.abc import Sequence
from typing import Protocol

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import Table, safely_above
from gearlink.core.numerics.arrays import Reals
from gearlink.core.numerics.bernstein import HERMITE
from gearlink.core.numerics.extremes import maximum_over
from gearlink.core.parts.cams.follower_motion import TURN


class FollowerMotion(Protocol):
    """What is made by the drive over a revolution of its master: the lift of a cam, or the output of any member."""

    @property
    def joints(self) -> Sequence[float]:
        """Places at which a law changes [rad]."""

    def evaluate(self, phi: Reals, order: int = 3, *, side: int = 1) -> list[Reals]:
        """Position and its derivatives by the master [mm or rad, per rad]."""


STEPS = (15.0, 10.0, 7.5, 6.0, 5.0, 4.0, 3.0, 2.5, 2.0, 1.5, 1.0, 0.75, 0.5, 0.25, 0.1)
"""Steps of the table that a tolerance may take [deg]."""
_BETWEEN = 17
_NAMES = ("position", "velocity", "acceleration", "jerk")


def servo_table(motion: FollowerMotion, rows: int, *, rocks: bool) -> Table:
    """Positions and their derivatives per degree of the master at equal steps, lifts in mm, of a rocker in deg.

    Notes
        Without the jerk where the motion has two derivatives only, as that of measured points.
    """
    degrees, unit = 360.0 * np.arange(rows) / (rows - 1), "deg" if rocks else "mm"
    values = motion.evaluate(np.radians(degrees), 3)  # joints as the segment after them
    columns: dict[str, tuple[Reals, str]] = {"master_position": (degrees, "deg")}
    for order, (name, value) in enumerate(zip(_NAMES, values, strict=False)):
        shown = (np.degrees(value) if rocks else value) * math.radians(1.0) ** order
        columns[f"slave_{name}"] = (shown, unit + ("", "/deg", "/deg^2", "/deg^3")[order])
    return Table.of("servo", columns)


def deviation(motion: FollowerMotion, rows: int, phi: Reals, *, end_side: int = -1) -> Reals:
    """Lift less the polynomial through value, velocity and acceleration of the rows about it [mm or rad].

    Parameters
        end_side : -1 or +1 - of a joint on the row after: the values before it, or those that the row has
    """
    places = np.radians(360.0 * np.arange(rows) / (rows - 1))
    at = np.clip(np.searchsorted(places, phi, side="right") - 1, 0, rows - 2)
    after = motion.evaluate(places[:-1], 2)
    before = motion.evaluate(places[1:], 2, side=end_side)
    b = places[at + 1] - places[at]
    values = np.stack([*(after[n][at] * b**n for n in range(3)), *(before[n][at] * b**n for n in range(3))])
    powers, x, found = HERMITE @ values, (phi - places[at]) / b, np.zeros_like(phi)
    for power in powers[::-1]:
        found = found * x + power
    return motion.evaluate(phi, 0)[0] - found


def greatest_error(motion: FollowerMotion, rows: int, *, end_side: int = -1) -> float:
    """Maximum error of the position between the rows [mm or rad], refined; `end_side` as of `deviation`."""
    apart = sorted({*np.linspace(0.0, TURN, rows)[1:-1].tolist(), *motion.joints})
    joints = [b for a, b in zip([-1.0, *apart], apart, strict=False) if b - a > 1e-9]
    between = functools.partial(deviation, motion, rows, end_side=end_side)
    return maximum_over(lambda phi: np.abs(between(phi)), joints=joints, fewest=_BETWEEN).value


def rows_for(motion: FollowerMotion, tolerance: float, *, rocks: bool, key: str = "servo.tolerance") -> int:
    """Rows of the first step whose error is within a tolerance.

    Parameters
        tolerance : float [mm, of a rocker deg]
        key : str - of the file, or the option that gives it
    Raises
        NoSolution - where no step is fine enough
    """
    within, rows = math.radians(tolerance) if rocks else tolerance, 0
    for step in STEPS:
        rows = round(360.0 / step) + 1
        near = (np.arange(16.0 * (rows - 1)) + 0.5) * (TURN / (16.0 * (rows - 1)))
        if float(np.abs(deviation(motion, rows, near)).max()) <= within and greatest_error(motion, rows) <= within:
            return rows
    error, unit = greatest_error(motion, rows), "deg" if rocks else "mm"
    least = safely_above(math.degrees(error) if rocks else error)
    raise NoSolution(
        f"error of the position between rows {STEPS[-1]:g} deg apart: {least} {unit} (limit <= {tolerance:g} {unit})",
        key="" if key.startswith("-") else key,
        fix=f"set {key} to {least}",
    )
