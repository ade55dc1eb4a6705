"""The track of a cylindrical cam for a roller whose axis is radial: pressure angle, curvature, walls, exact in space.

x is a place along the roller's axis, from the cam's axis on; ' is by the cam angle.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.cams.follower_motion import FollowerMotion


@dataclass(frozen=True)
class Drum:
    """A track on a drum.

    Parameters
        motion : FollowerMotion - along the axis [mm]
        outside, bottom : float [mm] - radii of the drum and of the track's ground
        roller_radius : float [mm] - r_g
        sense : +1 or -1 - eps
    Source
        own derivation: the relative velocity of the roller's section at x is (-eps x, s')
    """

    motion: FollowerMotion
    outside: float
    bottom: float
    roller_radius: float
    sense: int

    def pressure_angle(self, x: float, phi: Reals) -> Reals:
        """Signed pressure angle at a radius [rad]: tan alpha = s'/x."""
        return np.arctan(self.motion.evaluate(phi, 1)[1] / x)

    def curvature(self, x: float, phi: Reals) -> Reals:
        """Curvature of the developed pitch curve [1/mm]: kappa = x s''/(x^2 + s'^2)^(3/2)."""
        _, s1, s2 = self.motion.evaluate(phi, 2)
        return np.asarray(x * s2 / (x * x + s1 * s1) ** 1.5)

    def wall_factor(self, x: float, side: int, phi: Reals) -> Reals:
        """1 - side r_g kappa - r_g^2 s'^2/h^4, h^2 = x^2 + s'^2: a wall is regular where it is positive.

        The last term is from the turning of the contact along x, which twists the walls; the development misses it.
        """
        _, s1, s2 = self.motion.evaluate(phi, 2)
        square, roller = x * x + s1 * s1, self.roller_radius
        return np.asarray(1.0 - side * roller * x * s2 / square**1.5 - (roller * s1 / square) ** 2)

    def wall(self, x: float, side: int, phi: Reals) -> tuple[Reals, Reals, Reals]:
        """A wall in the cam's frame, the cam's axis along the third coordinate [mm].

        (x, side r_g s'/h, s + side r_g eps x/h) turned by -eps phi, h = sqrt(x^2 + s'^2)
        """
        s, s1 = self.motion.evaluate(phi, 1)
        h = np.sqrt(x * x + s1 * s1)
        across, along = side * self.roller_radius * s1 / h, s + side * self.roller_radius * self.sense * x / h
        turned = (x + 1j * across) * np.exp(-1j * self.sense * phi)
        return turned.real, turned.imag, along

    def developed(self, x: float, side: int, phi: Reals) -> tuple[Reals, Reals]:
        """A wall (side +1 or -1) or the pitch line (0) on the development of a radius: arc and place along the axis."""
        s, s1 = self.motion.evaluate(phi, 1)
        h = np.sqrt(x * x + s1 * s1)
        return x * phi - side * self.roller_radius * s1 / h, s + side * self.roller_radius * x / h
