"""The compensation cam pair of a flatbed press: results, tables and checks of its main and return cam.

Two rollers of the rack frame stand on a line through the cam axis, 180 deg apart, at a fixed distance; roller 1
(main cam) on +x, roller 2 (return cam) on -x. The cam turns counter-clockwise with CD.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.design import placed
from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.flatbed_press.compensation import Compensation, Joint
from gearlink.core.report import Check, Table, safely_above
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.cams.profile import RollerPath
    from gearlink.core.flatbed_press.spec import FlatbedPressSpec, PressCam
    from gearlink.core.numerics.arrays import Reals


class PressCams:
    """Mixed into the press design; reads its `follower`."""

    spec: FlatbedPressSpec

    @property
    def follower(self) -> Compensation:
        """The lift of the follower; the design class gives it."""
        raise NotImplementedError

    @property
    def _cam(self) -> PressCam:
        if self.spec.cam is None:
            raise MissingSection("`cam` needs the section cam: base_radius, roller_radius, ...", key="cam")
        return self.spec.cam

    @cached_property
    def cam_base_radius(self) -> float:
        """Cam axis to roller centre at zero lift [mm], given or the least that keeps the pressure angle of `size`."""
        if self._cam.base_radius is not None:
            return self._cam.base_radius
        if self.spec.size is None:
            text = "give cam.base_radius, or size: {pressure_angle: 25} to have it chosen"
            raise MissingSection(text, key="cam.base_radius")
        radius = self._base_radius_for(math.radians(self.spec.size.pressure_angle))
        if radius > self._cam.roller_radius:
            return radius
        raise NoSolution(
            f"a base radius of {radius:.6g} mm would keep the pressure angle, but the roller alone takes "
            f"{self._cam.roller_radius:g} mm: give cam.base_radius by shaft and roller, or lower size.pressure_angle",
            key="size.pressure_angle",
        )

    end_slope: float = placed("follower.end_slope")
    transition_rise: float = placed("follower.transition_rise")
    return_end: float = placed("follower.return_end")

    @property
    def follower_stroke(self) -> float:
        """Greatest less least lift [mm]."""
        low, high = self.follower.lift_range
        return high - low

    @cached_property
    def roller_center_distance(self) -> float:
        """Distance of the two rollers [mm] that gives both cams the same largest radius.

        L = 2 r_b + s_max + s_min; with s_min = 0 it is the report's 2 r_b + h

        Source
            TY-460 report 3.6
        """
        low, high = self.follower.lift_range
        return 2.0 * self.cam_base_radius + high + low

    @property
    def max_radius(self) -> float:
        """Largest radius of the main cam's profile [mm]: where the lift is greatest, the normal is radial."""
        return self.cam_base_radius - self._cam.roller_radius + self.follower.lift_range[1]

    @property
    def min_radius(self) -> float:
        """Smallest radius of the main cam's profile [mm]."""
        return self.cam_base_radius - self._cam.roller_radius + self.follower.lift_range[0]

    max_pressure_angle: float = placed("main_cam.max_pressure_angle.value")
    min_curvature_radius: float = placed("main_cam.min_curvature_radius.value")

    @cached_property
    def main_cam(self) -> DiscCam:
        """The cam of roller 1: pitch radius r_b + s."""
        return self._disc_cam("main cam", self.cam_base_radius)

    @cached_property
    def return_cam(self) -> DiscCam:
        """The cam of roller 2: its centre stands at r_b + s - L on the same line."""
        return self._disc_cam("return cam", self.cam_base_radius - self.roller_center_distance)

    def _disc_cam(self, name: str, at_zero_lift: float) -> DiscCam:
        from gearlink.core.cams.disc_cam import DiscCam
        from gearlink.core.cams.profile import translating

        def path(theta: Reals, order: int) -> RollerPath:
            lift = self.follower.lift(theta, order)
            return translating(at_zero_lift + lift.value, lift.first, lift.second if order > 1 else 0.0)

        joints = tuple(segment.start for segment in self.follower.segments)
        return DiscCam(name, path, 1, self._cam.roller_radius, joints)

    def table_follower(self, samples: int | None = None) -> Table:
        """Lift of the follower over the cam angle (TY-460 report 3.4)."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees

        degrees = turn_degrees(samples)
        lift, phases = self.follower.evaluate(np.radians(degrees), 2)
        columns = {
            "cam_angle": (degrees, "deg"),
            "lift": (lift.value, "mm"),
            "velocity": (lift.first, "mm/rad"),
            "acceleration": (lift.second, "mm/rad^2"),
            "phase": (phases, "1"),
        }
        return Table.of("follower", columns)

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The main cam, point for point (TY-460 report 3.5)."""
        return self.main_cam.table("main_cam", samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The return cam, point for point (TY-460 report 3.6)."""
        return self.return_cam.table("return_cam", samples)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 for both cams."""
        from gearlink.core.cams.checks import pressure_angle_checks

        cams, limit = (self.main_cam, self.return_cam), self.spec.limits.pressure_angle
        remedy = ""
        if max(cam.max_pressure_angle.value for cam in cams) > math.radians(limit) > 0.0:
            radius = safely_above(self._base_radius_for(math.radians(limit)))
            remedy = f"set cam.base_radius to at least {radius} mm, or raise cam.return_angle"
        yield from pressure_angle_checks(cams, limit, remedy)

    def _base_radius_for(self, pressure_angle: float) -> float:
        """Least base radius [mm] with which both cams keep a pressure angle.

        r_b + s >= |s'|/tan(alpha)  and  r_b + s_max + s_min - s >= |s'|/tan(alpha)
        """
        import numpy as np

        from gearlink.core.numerics.extremes import maximum_over

        both = sum(self.follower.lift_range)

        def needed(theta: Reals) -> Reals:
            lift = self.follower.lift(theta, 1)
            nearer: Reals = np.minimum(lift.value, both - lift.value)
            radius: Reals = np.abs(lift.first) / math.tan(pressure_angle) - nearer
            return radius

        joints = tuple(segment.start % (2.0 * math.pi) for segment in self.follower.segments)
        return maximum_over(needed, joints=joints, samples=512).value

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 for both cams."""
        from gearlink.core.cams.checks import undercut_checks

        yield from undercut_checks((self.main_cam, self.return_cam))

    def check_velocity_step(self) -> Check:
        """GL403 at every joint of the lift."""
        return self._steps("GL403", "velocity-step", "velocity_step", "first", "mm/rad", "fail")

    def check_acceleration_step(self) -> Check:
        """GL404 at every joint of the lift."""
        return self._steps("GL404", "acceleration-step", "acceleration_step", "second", "mm/rad^2", "warn")

    def _steps(self, code: str, name: str, step: str, derivative: str, unit: str, bad: Any) -> Check:
        from gearlink.core.cams.checks import step_check

        joints = self.follower.joints
        peak = max(
            abs(float(getattr(segment.lift(angle, 2), derivative)))
            for segment in self.follower.segments
            for angle in (segment.start, 0.5 * (segment.start + segment.end), segment.end)
        )
        if name == "velocity-step":
            remedy = "let the zone start where bed and cylinder have the same speed (leave sync.start out)"
        else:
            remedy = "a lead_in before the zone, transition quartic and return_law cycloidal take the jumps away"
        return step_check(code, name, [(_joint(j), float(getattr(j, step))) for j in joints], peak, unit, bad, remedy)

    def check_constant_sum(self) -> Check:
        """GL405: the two pitch radii in contact add up to the roller distance at every cam angle."""
        import numpy as np

        theta = np.radians(np.arange(0.0, 360.0, 1.0))
        radii = [np.abs(cam.points(theta)[0]) for cam in (self.main_cam, self.return_cam)]
        off = float(np.abs(radii[0] + radii[1] - self.roller_center_distance).max())
        limit = 1e-9 * self.roller_center_distance
        text = f"the two pitch radii in contact add up to {self.roller_center_distance:.6g} mm within {off:.2g} mm"
        if off > limit:
            text += ": the return cam's roller would pass the cam axis; raise cam.base_radius"
        return Check("GL405", "constant-sum", "fail" if off > limit else "pass", text, off, limit, "mm")


def _joint(joint: Joint) -> str:
    return f"{joint.before}/{joint.after} at {math.degrees(joint.cam_angle):.5g} deg"
