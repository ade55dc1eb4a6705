"""The motion of the bed itself: its chain's travel less the lift of the lower rack, where the press has its cam."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.flatbed_press.chains import Travel
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.flatbed_press.compensation import Compensation
    from gearlink.core.flatbed_press.motion import PressMotion
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi


class BedMotion:
    """Travel of the bed over arrays of the input angle.

    Parameters
        motion : PressMotion
        follower : Compensation - whose lift is taken off; None: the lower rack stands
    """

    def __init__(self, motion: PressMotion, follower: Compensation | None) -> None:
        self.motion, self.follower = motion, follower

    def travel(self, input_angle: Reals) -> Travel:
        """Travel of the bed [mm] and its first two derivatives by the input angle.

        b = p - s(c),   b' = p' - s' c',   b'' = p'' - s'' c'^2 - s' c'',   c the cam angle

        Source
            own derivation: the chain rule
        """
        cam = self.motion.bed.cam_angle(input_angle, 2)
        p = self.motion.bed.travel(input_angle, 2, cam)
        if self.follower is None:
            return p
        s = self.follower.lift_at(input_angle, cam)
        bend = s.second * cam.first * cam.first + s.first * cam.second
        return Travel(p.value - s.value, p.first - s.first * cam.first, p.second - bend)

    def jerk(self, input_angle: Reals) -> Reals:
        """Third derivative of the bed's travel by the input angle [mm/rad^3].

        b''' = q''' in the zone, elsewhere b''' = p''' - s''' c'^3 - 3 s'' c' c'' - s' c'''

        Source
            own derivation: the chain rule once more
        """
        import numpy as np

        from gearlink.core.linkages.fourbar import sweep as fourbar_sweep

        bed = self.motion.bed
        found: Reals = bed.jerk(input_angle)
        if self.follower is None:
            return found
        state = fourbar_sweep.solve(bed.linkage, bed.initial_crank_angle + input_angle, 3)
        cam = bed.cam_angle(input_angle, 2)
        s, third = self.follower.lift_at(input_angle, cam), self.follower.jerk(cam.value)
        bend = third * cam.first**3 + 3.0 * s.second * cam.first * cam.second + s.first * state.rocker_jerk
        jerk: Reals = np.where(np.isnan(third), self.motion.cylinder.jerk(input_angle), found - bend)
        return jerk

    @cached_property
    def joints(self) -> tuple[float, ...]:
        """Input angles in [0, 2 pi) at which the law of the lift changes [rad]."""
        if self.follower is None:
            return ()
        return tuple(float(self.motion.bed.input_angle(one.start)) % _TURN for one in self.follower.segments)

    @cached_property
    def extremes(self) -> dict[str, float]:
        """Extremes of velocity and acceleration of the bed [mm/s, mm/s^2] and their places [rad].

        Notes
            Where the lift's acceleration jumps both sides count.
        """
        from gearlink.core.motion_extremes import extremes

        speed = self.motion.input_speed
        curves = {
            "bed_velocity": lambda phi: self.travel(phi).first * speed,
            "bed_acceleration": lambda phi: self.travel(phi).second * speed**2,
        }
        return extremes(curves, 0.0, _TURN, joints=self.joints)
