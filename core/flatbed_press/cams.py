"""The compensation cam pair of a flatbed press: its follower, its size, main and return cam.

Two rollers of the rack frame stand on a line through the cam axis, 180 deg apart, at a fixed distance; roller 1
(main cam) on +x, roller 2 (return cam) on -x. The cam turns counter-clockwise with CD.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.cams.disc_cams import DiscCams
from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.flatbed_press.compensation import Compensation
from gearlink.core.flatbed_press.refusals import turns_back
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.cams.profile import RollerPath
    from gearlink.core.flatbed_press.chains import Travel
    from gearlink.core.flatbed_press.motion import PressMotion
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec, PressCam
    from gearlink.core.numerics.arrays import Reals

# By so much of its limits a chosen radius keeps to the safe side: its cams are checked in other roundings.
_HAIR = 1e-9
_KEPT = 8192
_OF_SIZE = ("cam.base_radius", "cam")
"""Keys that say how large the cams are: the radius, or the section where `size` chooses it."""


class PressCams(DiscCams):
    """The follower of the rack and the two cams that drive it both ways."""

    def __init__(self, spec: FlatbedPressSpec, motion: PressMotion) -> None:
        self.spec, self.motion = spec, motion

    @property
    def section(self) -> PressCam:
        """The section `cam` of the design file."""
        if self.spec.cam is None:
            raise MissingSection("`cam` needs the section cam: base_radius, roller_radius, ...", key="cam")
        return self.spec.cam

    @cached_property
    def follower(self) -> Compensation:
        """The lift of the compensation cam's follower."""
        from gearlink.core.cams.laws import law

        cam, motion = self.section, self.motion
        with at_key("cam.return_law"):
            return_law = law(cam.return_law)
            if return_law.kind != "rest-to-rest":
                raise NoSolution(f"the return needs a rest-to-rest law; {return_law.name} goes from rest to speed")
        return Compensation(
            motion.bed,
            motion.cylinder,
            motion.sync_start,
            motion.sync_end,
            cam.transition,
            math.radians(cam.lead_in),
            self.transition_end,
            math.radians(cam.return_angle),
            return_law,
            self.spec.sync.end is not None,
        )

    @property
    def transition_end(self) -> float:
        """Cam angle at which the lift is greatest [rad]: given, or counted from the end of the zone."""
        cam = self.section
        if cam.transition_angle is not None:
            return self.motion.cam_sync_end + math.radians(cam.transition_angle)
        return math.radians(cam.transition_end or 0.0)

    @property
    def follower_stroke(self) -> float:
        """Greatest less least lift [mm]."""
        low, high = self.follower.lift_range
        return high - low

    # Size

    @property
    def is_sized(self) -> bool:
        """Whether the file gives the base radius, or says how it is chosen."""
        return self.spec.cam is not None and (self.spec.cam.base_radius is not None or self.spec.size is not None)

    @cached_property
    def base_radius(self) -> float:
        """Cam axis to roller centre at zero lift [mm], given or the least with which both cams pass their checks."""
        if self.section.base_radius is not None:
            return self.section.base_radius
        if self.spec.size is None:
            text = "give cam.base_radius, or size: {pressure_angle: 25} to have it chosen"
            raise MissingSection(text, key="cam.base_radius")
        return self.base_radius_for(math.radians(self.spec.size.pressure_angle))

    def base_radius_for(self, pressure_angle: float) -> float:
        """Least base radius [mm] for a pressure angle [rad] that leaves roller and shaft their room as well."""
        from gearlink.core.cams.checks import HUB

        hub = HUB * self.section.shaft_radius * (1.0 + _HAIR) + self.section.roller_radius - self.follower.lift_range[0]
        return self.base_radius_for_roller(max(self.base_radius_for_pressure(pressure_angle), hub))

    def base_radius_for_pressure(self, pressure_angle: float) -> float:
        """Least base radius [mm] with which both cams keep a pressure angle [rad].

        r_b + s >= |s'|/tan(alpha)  and  r_b + s_max + s_min - s >= |s'|/tan(alpha)
        """
        import numpy as np

        from gearlink.core.numerics.extremes import maximum_over

        both = sum(self.follower.lift_range)

        def needed(theta: Reals) -> Reals:
            lift = self.follower.lift(theta, 1)
            nearer: Reals = np.minimum(lift.value, both - lift.value)
            radius: Reals = np.abs(lift.first) / math.tan(pressure_angle * (1.0 - 1e-3 * _HAIR)) - nearer
            return radius

        joints = tuple(segment.start % (2.0 * math.pi) for segment in self.follower.segments)
        return maximum_over(needed, joints=joints, samples=512).value

    def base_radius_for_roller(self, least: float) -> float:
        """Base radius [mm], from `least` on, whose pitch curves bend no sharper than the roller allows.

        rho_min(r_b) = r_g/0.8 of the sharper cam

        Raises
            NoSolution - where no cam of a thousand rollers' size is large enough
        Notes
            Within a step of doubling the curvature is taken to grow with the radius; the radius that is found is
            checked by its own cams.
        """
        from gearlink.core.cams.checks import ROLLER_SHARE
        from gearlink.core.numerics.roots import bracketed_root

        roller = self.section.roller_radius
        wanted = roller / ROLLER_SHARE * (1.0 + _HAIR)

        def room(radius: float) -> float:
            return min(cam.min_curvature_radius.value for cam in self._pair(radius)) - wanted

        low = high = max(least, roller)
        while room(high) < 0.0:
            low, high = high, 2.0 * high
            if high > 1000.0 * (roller + self.follower_stroke):
                raise NoSolution(
                    f"no base radius up to {low:.6g} mm bends its cams less than the roller of {roller:g} mm: raise "
                    "cam.return_angle, or take a smaller roller",
                    key="cam.roller_radius",
                )
        return high if high == low else bracketed_root(room, low, high)

    @cached_property
    def roller_center_distance(self) -> float:
        """Distance of the two rollers [mm] that gives both cams the same largest radius."""
        return self._distance(self.base_radius)

    def _distance(self, base_radius: float) -> float:
        """L = 2 r_b + s_max + s_min; with s_min = 0 it is the report's 2 r_b + h

        Source
            TY-460 report 3.6
        """
        low, high = self.follower.lift_range
        return 2.0 * base_radius + high + low

    # The cams

    @property
    def max_radius(self) -> float:
        """Largest radius of either profile [mm]: where the lift is greatest, the normal is radial."""
        return self.base_radius - self.section.roller_radius + self.follower.lift_range[1]

    @property
    def min_radius(self) -> float:
        """Smallest radius of either profile [mm]."""
        return self.base_radius - self.section.roller_radius + self.follower.lift_range[0]

    @property
    def main_cam(self) -> DiscCam:
        """The cam of roller 1: pitch radius r_b + s."""
        return self.discs[0]

    @property
    def return_cam(self) -> DiscCam:
        """The cam of roller 2: its centre stands at r_b + s - L on the same line."""
        return self.discs[1]

    @cached_property
    def discs(self) -> tuple[DiscCam, DiscCam]:
        """Main and return cam."""
        return self._pair(self.base_radius)

    def _pair(self, base_radius: float) -> tuple[DiscCam, DiscCam]:
        back = base_radius - self._distance(base_radius)
        return self._disc_cam("main cam", base_radius), self._disc_cam("return cam", back)

    def _disc_cam(self, name: str, at_zero_lift: float) -> DiscCam:
        from gearlink.core.cams.disc_cam import DiscCam
        from gearlink.core.cams.profile import translating

        def path(theta: Reals, order: int) -> RollerPath:
            lift = self._lift(theta, order)
            return translating(at_zero_lift + lift.value, lift.first, lift.second if order > 1 else 0.0)

        joints = tuple(segment.start for segment in self.follower.segments)
        key = _OF_SIZE[self.section.base_radius is None]
        return DiscCam(name, path, 1, self.section.roller_radius, joints, key)

    def _lift(self, theta: Reals, order: int) -> Travel:
        """The follower's lift; that of the last angles is kept, for both cams are looked at in the same places."""
        if theta.size > _KEPT:  # for the memory's sake
            return self.follower.lift(theta, order)
        places = theta.tobytes()
        if self._last.get(order, (b"",))[0] != places:
            self._last[order] = places, self.follower.lift(theta, order)
        return self._last[order][1]

    @cached_property
    def _last(self) -> dict[int, tuple[bytes, Travel]]:
        return {}

    def explained(self, refusal: NoSolution) -> NoSolution:
        """Where the bed turns back within the zone no size of the cams helps."""
        turned = turns_back(self.follower) if refusal.key in ("", *_OF_SIZE) and self.follows else None
        return turned or refusal

    def require_motion(self) -> None:
        """Compute chains and zone."""
        _ = self.motion.cam_sync_end

    @property
    def follows(self) -> bool:
        """Whether the follower's lift exists over the turn."""
        try:
            return bool(self.follower.segments)
        except NoSolution:
            return False
