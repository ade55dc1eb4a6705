"""The motion of the bed itself: its chain's travel less the lift of the lower rack, where the press has its cam."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.flatbed_press.chains import Travel
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.design import FlatbedPress
    from gearlink.core.mechanism.motion import Course
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi


class BedMotion:
    """Travel of the bed over arrays of the input angle."""

    def __init__(self, design: FlatbedPress) -> None:
        self.design = design

    @cached_property
    def _course(self) -> Course:
        from gearlink.core.flatbed_press.mechanism import bed

        return bed(self.design)

    def travel(self, input_angle: Reals) -> Travel:
        """Travel of the bed [mm] and its first two derivatives by the input angle."""
        return Travel(*self._course.rates(self.design.moving, input_angle, 2))

    def jerk(self, input_angle: Reals) -> Reals:
        """Third derivative of the bed's travel by the input angle [mm/rad^3]."""
        return self._course.rates(self.design.moving, input_angle, 3)[3]

    @property
    def joints(self) -> tuple[float, ...]:
        """Input angles in [0, 2 pi) at which the law of the lift changes [rad]."""
        return self.design.moving.input.joints

    @cached_property
    def extremes(self) -> dict[str, float]:
        """Extremes of velocity and acceleration of the bed [mm/s, mm/s^2] and their places [rad].

        Notes
            Where the lift's acceleration jumps both sides count.
        """
        from gearlink.core.motion_extremes import extremes

        speed = self.design.input_speed
        curves = {
            "bed_velocity": lambda phi: self.travel(phi).first * speed,
            "bed_acceleration": lambda phi: self.travel(phi).second * speed**2,
        }
        return extremes(curves, 0.0, _TURN, joints=self.joints)
