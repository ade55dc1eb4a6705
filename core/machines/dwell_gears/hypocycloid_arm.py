"""A slotted arm about the ring's centre that a point of the planet turns: step motion of a hypocycloid train.

Frame and carrier angle t as in `hypocycloid`, from the middle of an arc on: the arm stands at

    beta = t + arg z,   z = (n - 1) - l e^(-i n t),   n ring over planet, l the point's distance over the pitch radius

With l < 1 it runs one way, with 1 it is at rest for a moment in each cusp, above 1 it steps back there.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core.base.errors import NoSolution
from gearlink.core.numerics.roots import bracketed_root

if TYPE_CHECKING:
    from gearlink.core.mechanism.rates import Turn
    from gearlink.core.numerics.arrays import Reals


@dataclass(frozen=True)
class SlottedArm:
    """The output of a train.

    Parameters
        teeth : float - n, ring over planet, above 1
        ratio : float - l, above 0 and below n - 1
    Raises
        NoSolution - for a point that turns the arm against the carrier
    Example
        >>> arm = SlottedArm(3.0, 1.0)
        >>> arm.speed_max, arm.speed_min, round(math.degrees(arm.dwell(math.radians(0.5))[0]), 6)
        (4.0, 0.0, 33.29542)

    Source
        thesis 2.2.2; formulas: own derivation
    """

    teeth: float
    ratio: float

    def __post_init__(self) -> None:
        if not 0.0 < self.ratio < self.teeth - 1.0:
            raise NoSolution(
                (
                    f"the point turns the arm on only between 0 and {self.teeth - 1.0:.6g} planet radii from "
                    f"the planet's axis, not at {self.ratio:g}"
                ),
                fix="choose a position between them",
            )

    @property
    def speed_max(self) -> float:
        """Maximum speed of the arm over the carrier's, in the middle of an arc: (n - 1)(1 + l)/(n - 1 - l)."""
        k = self.teeth - 1.0
        return k * (1.0 + self.ratio) / (k - self.ratio)

    @property
    def speed_min(self) -> float:
        """Minimum speed of the arm over the carrier's, in a cusp: (n - 1)(1 - l)/(n - 1 + l)."""
        k = self.teeth - 1.0
        return k * (1.0 - self.ratio) / (k + self.ratio)

    def angle(self, x: float) -> float:
        """Angle of the arm from the place that it has in a cusp, at a carrier angle from there [rad]."""
        k, n = self.teeth - 1.0, self.teeth
        return x - math.atan2(self.ratio * math.sin(n * x), k + self.ratio * math.cos(n * x))

    @cached_property
    def standstill(self) -> float:
        """Carrier angle from a cusp to the standstill after it [rad]; 0 where the arm never turns back.

        cos n x = ((n - 1) - l^2)/((n - 2) l)
        """
        if self.ratio <= 1.0:
            return 0.0
        n, far = self.teeth, self.ratio
        return math.acos(((n - 1.0) - far * far) / ((n - 2.0) * far)) / n

    @property
    def back_step(self) -> float | None:
        """How far the arm goes back in each step [rad]; None where it never does."""
        return -2.0 * self.angle(self.standstill) if self.ratio > 1.0 else None

    def dwell(self, tolerance: float) -> tuple[float, float]:
        """Longest carrier angle in which the arm stays within +- a tolerance of a place, and where it starts [rad].

        Parameters
            tolerance : float [rad] - half of what the arm may cover, above 0
        Returns
            angle, start : float, float [rad] - of equal ones the first from carrier angle 0 on
        Raises
            NoSolution - for a tolerance that takes in a whole step
        Notes
            About a cusp the angle is odd: where the way back fits in, the window is symmetrical; else it lies about a
            standstill, with both ends on the edge of the band.
        """
        half = math.pi / self.teeth
        if not 0.0 < tolerance < half:
            raise NoSolution(
                f"tolerance is {math.degrees(tolerance):g} deg; it must be positive and below half a step, "
                f"{math.degrees(half):.6g} deg"
            )
        top = -self.angle(self.standstill)  # before the cusp
        if top <= tolerance:
            end = bracketed_root(lambda x: self.angle(x) - tolerance, self.standstill, half)
            return 2.0 * end, half - end
        edge = top - 2.0 * tolerance
        before = bracketed_root(lambda x: self.angle(x) - edge, -half, -self.standstill)
        after = bracketed_root(lambda x: self.angle(x) - edge, -self.standstill, self.standstill)
        return after - before, half + before

    def turn(self, t: Reals, order: int) -> Turn:
        """Angle of the arm [rad] and its derivatives by the carrier angle, over an array.

        beta' = 1 + Im u,  u = z_1/z,  u' = z_2/z - u^2,  u'' = z_3/z - u^3 - 3 u u';  z_k the derivatives of z
        """
        import numpy as np

        from gearlink.core.mechanism.rates import Turn

        n = self.teeth
        around: Any = self.ratio * np.exp(-1j * n * t)
        z = (n - 1.0) - around
        u = 1j * n * around / z
        found = [t + np.angle(z), 1.0 + u.imag]
        if order > 1:
            first = n * n * around / z - u * u
            found.append(first.imag)
            if order > 2:
                found.append((-1j * n**3 * around / z - u**3 - 3.0 * u * first).imag)
        return Turn(*(np.asarray(each) for each in found[: order + 1]))
