"""The lift of the lower rack for a register: what the cam on D takes back where CD has turned too far.

In the synchronous zone the lift is the difference of the travels of bed and cylinder; before and after it the follower
has its lead-in, transition, return and dwell.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.machines.flatbed_press.chains import difference

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi


class RackLift:
    """Lift of the rack along input angles, by the cams as designed.

    Parameters
        design : FlatbedPress - without the section `cam` nothing is known outside the zone
    """

    def __init__(self, design: FlatbedPress) -> None:
        self.design, self.motion = design, design.motion

    def in_zone(self, input_angle: Any) -> NDArray[np.bool_]:
        """Whether input angles [rad] lie in the synchronous zone of a sheet."""
        start, end = self.motion.sync_start, self.motion.sync_end
        inside: NDArray[np.bool_] = np.mod(np.asarray(input_angle) - start, _TURN) <= end - start
        return inside

    def known(self, input_angle: Any) -> NDArray[np.bool_]:
        """Whether the lift at input angles [rad] is known."""
        inside = self.in_zone(input_angle)
        return inside if self.design.spec.cam is None else np.ones_like(inside)

    def _outside(self, input_angle: Any) -> NDArray[np.bool_]:
        return self.known(input_angle) & ~self.in_zone(input_angle)

    def slope(self, input_angle: Reals) -> Reals:
        """What the cam takes back per turn of CD [mm/rad].

        s' = (p' - q')/cam' in the zone, outside it the slope of the follower's own stretch
        """
        gap = difference(self.motion.bed, self.motion.cylinder, input_angle, 1)
        cam = self.motion.bed.cam_angle(input_angle, 1)
        slope: Reals = gap.first / cam.first
        outside = self._outside(input_angle)
        if outside.any():
            slope[outside] = self.design.cams.follower.lift(cam.value[outside], 1).first
        return slope

    def bed_acceleration(self, input_angle: Reals) -> Reals:
        """Second derivative of the bed's travel by the input angle [mm/rad^2]: in the zone that of the cylinder."""
        found: Reals = self.motion.cylinder.travel(input_angle, 2).second
        outside = self._outside(input_angle)
        if outside.any():
            found[outside] = self.design.bed_motion.travel(input_angle[outside]).second
        return found

    def gained(self, input_angle: Reals, turned: Any) -> Any:
        """By how much the rack is too far on [mm] where CD has turned too far by `turned` [rad].

        Notes
            An angle of the zone keeps to the zone's own law, of which an error makes it see a little more.
        """
        bed, cylinder = self.motion.bed, self.motion.cylinder
        cam = bed.cam_angle(input_angle).value
        there = bed.input_angle(cam + turned)
        found = difference(bed, cylinder, there).value - difference(bed, cylinder, input_angle).value
        outside = self._outside(input_angle)
        if outside.any():
            found = np.where(outside, self._lift(cam + turned) - self._lift(cam), found)
        return found

    def _lift(self, cam_angle: Any) -> Any:
        """Lift of the follower [mm] over an array of any shape; NaN where the angle is."""
        angles = np.asarray(cam_angle)
        finite = np.isfinite(angles)
        found = np.full(angles.shape, math.nan)
        found[finite] = self.design.cams.follower.lift(angles[finite], 0).value
        return found
