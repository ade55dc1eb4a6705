"""The interferences of a pinion in a ring: involute, tip fouling, radial assembly.

Each margin is a length at the ring's tip circle, negative where the teeth cut into each other.
"""

from __future__ import annotations

import math
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.mesh.pair import GearPair


@dataclass(frozen=True)
class InternalInterference:
    """What may keep a pinion and a ring from turning, or from being put together.

    Parameters
        pair : GearPair - with a ring as gear 2
    Notes
        Tip fouling is exact: 320 pairs followed through a whole revolution agreed in sign. Radial assembly covers every
        phase of the teeth: 80 pairs pushed in at 12 phases agreed.
    Example
        >>> close = InternalInterference(GearPair(module=1.0, teeth=(43, -50), given_shift=(0.0, -0.06)))
        >>> round(close.tip_fouling_angle, 7), round(close.radial_assembly_angle, 5)
        (0.0004113, -0.02215)

    Source
        own derivation; SDP/SI D785 table 5-4 for published pairs
    """

    pair: GearPair

    @property
    def involute_margin(self) -> float:
        """rho_A1: how far contact at the ring's tip stays from the pinion's base tangent point [mm]."""
        return self.pair.interference_margin[1]

    @cached_property
    def _tips(self) -> tuple[float, float]:
        """r_a1, |r_a2| [mm]."""
        return self.pair.tip_radius[0], -self.pair.tip_radius[1]

    def _gain(self, gear: int) -> float:
        """inv(alpha_a) - inv(alpha_wt) [rad]."""
        working = self.pair.working_pressure_angle
        return self.pair.fn.involute_rise(working, self.pair.tip_pressure_angle[gear] - working)

    @property
    def tip_circles_apart(self) -> float:
        """|a_w| - (r_a1 - |r_a2|) [mm]; negative where the pinion's tip circle encloses the ring's."""
        return -self.pair.center_distance - (self._tips[0] - self._tips[1])

    @cached_property
    def _heron(self) -> float:
        """16 squared areas of the triangle of both axes and the crossing of the tip circles; negative: none."""
        (tip1, tip2), a = self._tips, -self.pair.center_distance
        return (tip1 + tip2 + a) * (tip1 + tip2 - a) * (a + tip1 - tip2) * self.tip_circles_apart

    @cached_property
    def tip_fouling_angle(self) -> float | None:
        """F [rad] at the ring's axis; None where the tip circles do not cross, so that nothing can foul.

        F = z_1/|z_2| (d_1 + inv(alpha_a1) - inv(alpha_wt)) + inv(alpha_wt) - inv(alpha_a2) - d_2,
        d_1, d_2 the angles from the line of centres to where the tip circles cross
        """
        return None if self._heron < 0.0 else self._fouling_angle

    @property
    def _fouling_angle(self) -> float:
        (tip1, tip2), a, fn = self._tips, -self.pair.center_distance, self.pair.fn
        # Four areas (Heron): an arctangent stands a touch of the circles.
        area, squares = fn.sqrt(self._heron), (tip2 - tip1) * (tip2 + tip1)
        d1, d2 = fn.atan2(area, squares - a * a), fn.atan2(area, squares + a * a)
        z1, z2 = self.pair.teeth
        return z1 / -z2 * (d1 + self._gain(0)) - self._gain(1) - d2

    @property
    def tip_fouling_margin(self) -> float | None:
        """F |r_a2| [mm]."""
        angle = self.tip_fouling_angle
        return None if angle is None else angle * self._tips[1]

    @property
    def _opening(self) -> float:
        """Q = |r_a2|/r_a1."""
        return self._tips[1] / self._tips[0]

    @property
    def _is_too_large(self) -> bool:
        return self._opening <= 1.0

    @property
    def _always_opens(self) -> bool:
        return self.pair.teeth[0] * self._opening >= -self.pair.teeth[1]

    @cached_property
    def radial_assembly_angle(self) -> float | None:
        """G [rad] at the pinion's axis, -inf where the pinion is larger than the opening; None where it always fits.

        G = t_1 + inv(alpha_a1) - inv(alpha_wt) - |z_2|/z_1 (t_2 + inv(alpha_a2) - inv(alpha_wt)),
        sin(t_1) = sqrt((1 - (z_1 Q/z_2)^2)/(1 - (z_1/z_2)^2)), sin(t_2) = sin(t_1)/Q, Q = |r_a2|/r_a1; for every phase
        of the teeth, which helical gears as wide as an axial pitch have all at once
        """
        if self._is_too_large:
            return -math.inf
        return None if self._always_opens else self._assembly_angle

    @property
    def _assembly_angle(self) -> float:
        q, fn = self._opening, self.pair.fn
        z1, z2 = self.pair.teeth[0], -self.pair.teeth[1]
        ratio = z1 / z2
        # Both cosines are sqrt(q^2 - 1) times a number: nothing has to be held below 1.
        sine, cosine = fn.sqrt((1.0 - ratio * q) * (1.0 + ratio * q)), fn.sqrt((q - 1.0) * (q + 1.0))
        t1, t2 = fn.atan2(sine, ratio * cosine), fn.atan2(sine, cosine)
        return t1 + self._gain(0) - z2 / z1 * (t2 + self._gain(1))

    @property
    def radial_assembly_margin(self) -> float | None:
        """G z_1/|z_2| |r_a2| [mm]."""
        angle = self.radial_assembly_angle
        if angle is None:
            return None
        return angle * self.pair.teeth[0] / -self.pair.teeth[1] * self._tips[1]
