"""The cam pair of a swing gripper, mixed into its design class."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.errors import MissingSection, NoSolution, at_key
from gearlink.core.report import Check, Status, Table, safely_below
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.base import GripperBase

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.cams.profile import RollerPath
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.swing_gripper.size import RollerArm
    from gearlink.core.swing_gripper.spec import GripperCam, Roller

# A hub of 1.5 times the shaft is the usual least.
_HUB = 1.5


class GripperCams(GripperBase):
    """The cams of the design: their centre, given or chosen, results, tables and checks."""

    @cached_property
    def _cam(self) -> GripperCam:
        cam: GripperCam = self._require("cam", "center, sense, roller")
        return cam

    @cached_property
    def cam_center(self) -> complex:
        """The cam axis in the machine's frame [mm], given or chosen by `size`."""
        if self._cam.center is not None:
            return complex(*self._cam.center)
        if self.spec.size is None:
            raise MissingSection("give cam.center, or size: {pressure_angle: 25} to have it chosen", key="size")
        return self._center_for(self.spec.size.pressure_angle)

    def _center_for(self, degrees: float, *, refined: bool = True) -> complex:
        """Cam centre of the smallest cams that keep a pressure angle [deg]."""
        from gearlink.core.swing_gripper.size import smallest_cam_center

        with at_key("size.pressure_angle"):
            limit, sense = math.radians(degrees), self._cam.sense
            return smallest_cam_center(self.linkage, self._arms, sense, limit, refined=refined).center

    @property
    def _arms(self) -> list[RollerArm]:
        """The rollers on their arms, with the side on which the cam lies."""
        from gearlink.core.swing_gripper.size import RollerArm

        cam, back = self._cam, self._cam.return_roller
        side = self.spec.size.side if self.spec.size is not None else None
        if side is None and cam.center is not None:
            side = 1 if (self._from_pivot / self._main_arm).imag > 0.0 else -1
        if side is None and back is not None:
            side = 1 if math.remainder(back.angle, 360.0) > 0.0 else -1
        if side is None:
            raise NoSolution("one roller alone does not fix where the cam is: give size.side, 1 or -1", key="size")
        arms = [RollerArm(cam.roller.arm, math.radians(cam.roller.angle), side)]
        if back is not None:
            arms.append(RollerArm(back.arm, math.radians(cam.roller.angle + back.angle), -side))
        return arms

    @property
    def _from_pivot(self) -> complex:
        return self.cam_center - self.linkage.input_pivot

    @property
    def _main_arm(self) -> complex:
        """Direction of the main roller's arm at the bite."""
        import cmath

        import numpy as np

        angle = float(self.linkage.motion(np.array([0.0]), 0).input_angle[0])
        return cmath.rect(1.0, angle + math.radians(self._cam.roller.angle))

    @cached_property
    def main_cam(self) -> DiscCam:
        """The cam of the main roller."""
        return self._disc_cam("main cam", self._cam.roller, self._cam.roller.angle)

    @cached_property
    def return_cam(self) -> DiscCam | None:
        """The cam of the return roller, at a fixed angle from the main roller's arm; None without one."""
        roller = self._cam.return_roller
        return None if roller is None else self._disc_cam("return cam", roller, self._cam.roller.angle + roller.angle)

    @property
    def cams(self) -> tuple[DiscCam, ...]:
        """Main cam, and the return cam where there is one."""
        return (self.main_cam,) if self.return_cam is None else (self.main_cam, self.return_cam)

    def _disc_cam(self, name: str, roller: Roller, from_input: float) -> DiscCam:
        import numpy as np

        from gearlink.core.cams.disc_cam import DiscCam
        from gearlink.core.cams.profile import oscillating

        pivot, shift = -self._from_pivot, math.radians(from_input)

        def path(theta: Reals, order: int) -> RollerPath:
            motion = self.linkage.motion(np.degrees(theta), order)
            second = motion.input_acceleration if order > 1 else 0.0
            return oscillating(pivot, roller.arm, motion.input_angle + shift, motion.input_velocity, second)

        joints = tuple(math.radians(start) for start in self.law.starts[:-1])
        return DiscCam(name, path, self._cam.sense, roller.radius, joints)

    @property
    def max_pressure_angle(self) -> tuple[float, ...]:
        """Greatest pressure angle of each cam [rad]."""
        return tuple(cam.max_pressure_angle.value for cam in self.cams)

    @property
    def min_curvature_radius(self) -> tuple[float, ...]:
        """Least convex radius of each pitch curve [mm]."""
        return tuple(cam.min_curvature_radius.value for cam in self.cams)

    @property
    def max_radius(self) -> tuple[float, ...]:
        """Largest radius of each profile [mm]."""
        return tuple(cam.max_radius for cam in self.cams)

    @property
    def min_radius(self) -> tuple[float, ...]:
        """Smallest radius of each profile [mm]."""
        return tuple(cam.min_radius for cam in self.cams)

    def table_main_cam(self, samples: int | None = None) -> Table:
        """The main cam, point for point."""
        return self.main_cam.table("main_cam", samples)

    def table_return_cam(self, samples: int | None = None) -> Table:
        """The return cam, point for point."""
        if self.return_cam is None:
            raise MissingSection("the table needs cam.return_roller: arm, angle, radius", key="cam.return_roller")
        return self.return_cam.table("return_cam", samples)

    # Checks

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 for both cams over the turn, and a warning for the phase accelerate."""
        from gearlink.core.cams.checks import pressure_angle_checks

        limit = self.spec.limits.pressure_angle
        over = max(self.max_pressure_angle) > math.radians(limit) > 0.0
        yield from pressure_angle_checks(self.cams, limit, self._center_remedy(limit) if over else "")
        yield from self._accelerating(self.spec.limits.accelerate_pressure_angle)

    def _accelerating(self, limit: float) -> Iterator[Check]:
        from gearlink.core.numerics.extremes import largest_magnitude

        for cam in self.cams:
            end = math.radians(self.law.starts[1])
            worst = largest_magnitude(cam.pressure_angle, 0.0, end, samples=128)
            value = math.degrees(abs(worst.value))
            status: Status = "warn" if value > limit else "pass"
            text = (
                f"the pressure angle of the {cam.name} reaches {value:.6g} deg while it accelerates the gripper, at "
                f"cam angle {math.degrees(worst.place):.5g} deg"
            )
            if status == "warn":
                text += f", above {limit:g} deg: {self._center_remedy(limit)}"
            yield Check("GL401", "pressure-angle", status, text, value, limit, "deg")

    def _center_remedy(self, limit: float) -> str:
        """Where the smallest cams stand that keep a pressure angle [deg] over the turn, to a tenth of a millimetre."""
        longer = "lengthen the phase in which it occurs"
        try:
            center = self._center_for(0.99 * limit)
        except NoSolution:
            return f"no cam.center keeps it, the least for both rollers is {self._least_limit:.3g} deg: {longer}"
        return f"set cam.center to [{center.real:.1f}, {center.imag:.1f}], or {longer}"

    @cached_property
    def _least_limit(self) -> float:
        """Least pressure angle [deg] that some cam centre keeps for every roller, to a tenth."""
        low, high = 0.0, 89.9
        while high - low > 0.1:
            middle = 0.5 * (low + high)
            try:
                self._center_for(middle, refined=False)
            except NoSolution:
                low = middle
            else:
                high = middle
        return high

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 for both cams."""
        from gearlink.core.cams.checks import undercut_checks

        yield from undercut_checks(self.cams)

    def check_shaft_clearance(self) -> Iterator[Check]:
        """GL302: the profiles against the cam shaft."""
        shaft = self._cam.shaft_radius
        for cam in self.cams if shaft > 0.0 else ():
            room = cam.min_radius - shaft
            status: Status = "fail" if room <= 0.0 else "warn" if cam.min_radius < _HUB * shaft else "pass"
            text = f"the {cam.name} leaves {room:.4g} mm round its shaft (radius {shaft:g} mm)"
            if status == "fail":
                text = f"the {cam.name} comes {-room:.4g} mm into its shaft (radius {shaft:g} mm)"
            if status != "pass":
                text += (
                    f": take a shaft_radius of at most {safely_below(cam.min_radius / _HUB)} mm (hub of {_HUB:g} times "
                    f"the shaft), or cam.center {_HUB * shaft - cam.min_radius:.4g} mm farther from the roller"
                )
            yield Check("GL302", "shaft-clearance", status, text, room, 0.0, "mm")
