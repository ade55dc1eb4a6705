"""The cam pair of a swing gripper: its centre, given or chosen, and the cam of each roller."""

from __future__ import annotations

import math
from functools import cache
from typing import TYPE_CHECKING

from gearlink.core.base.errors import MissingSection, NoSolution, at_key
from gearlink.core.base.results import cached_property
from gearlink.core.machines.swing_gripper.codes import FARTHER
from gearlink.core.machines.swing_gripper.motion import require
from gearlink.core.parts.cams.codes import LARGER
from gearlink.core.parts.cams.disc_cams import DiscCams

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.machines.swing_gripper.motion import Motion
    from gearlink.core.machines.swing_gripper.spec import GripperCam, Roller, SwingGripperSpec
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.parts.cams.disc_cam import DiscCam
    from gearlink.core.parts.cams.profile import RollerPath
    from gearlink.core.parts.cams.size import RockingRoller


class GripperCams(DiscCams):
    """The cams that drive the gripper and bring it back; those that advise say where else they could be."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion, *, advise: bool) -> None:
        self.spec, self.motion, self.advise = spec, motion, advise

    @cached_property
    def section(self) -> GripperCam:
        """The section `cam` of the design file."""
        cam: GripperCam = require(self.spec, "cam", "center, sense, roller")
        return cam

    @cached_property
    def center(self) -> complex:
        """The cam axis in the machine's frame [mm], given or chosen by `size`."""
        if self.section.center is not None:
            return complex(*self.section.center)
        if self.spec.size is None:
            raise MissingSection("give cam.center, or size: {pressure_angle: 25} to have it chosen", key="size")
        return self.center_for(self.spec.size.pressure_angle)

    def center_for(self, degrees: float, *, refined: bool = True) -> complex:
        """Cam centre of the smallest cams that keep a pressure angle [deg]."""
        from gearlink.core.parts.cams.size import smallest_cam_of_rollers

        with at_key("size.pressure_angle"):
            return smallest_cam_of_rollers(
                self._rollers,
                math.radians(degrees),
                sense=self.section.sense,
                joints=tuple(math.radians(start) for start in self.motion.law.starts[1:-1]),
                refined=refined,
            )

    @property
    def _rollers(self) -> list[RockingRoller]:
        """The rollers on their arms, with the side on which the cam lies."""
        cam, back = self.section, self.section.return_roller
        side = self.spec.size.side if self.spec.size is not None else None
        if side is None and cam.center is not None:
            side = 1 if (self.from_pivot / self.main_arm).imag > 0.0 else -1
        if side is None and back is not None:
            side = 1 if math.remainder(back.angle, 360.0) > 0.0 else -1
        if side is None:
            raise NoSolution("one roller alone does not fix where the cam is: give size.side, 1 or -1", key="size")
        rollers = [self._rocking(cam.roller, cam.roller.angle, side)]
        if back is not None:
            rollers.append(self._rocking(back, cam.roller.angle + back.angle, -side))
        return rollers

    def _rocking(self, roller: Roller, from_input: float, side: int) -> RockingRoller:
        import numpy as np

        from gearlink.core.parts.cams.size import RockingRoller

        linkage, ahead = self.motion.linkage, math.radians(from_input)

        def law(cam_angle: Reals) -> tuple[Reals, Reals]:
            motion = linkage.motion(np.degrees(cam_angle), 1)
            return motion.input_angle + ahead, motion.input_velocity

        return RockingRoller(law, linkage.input_pivot, roller.arm, side)

    @property
    def from_pivot(self) -> complex:
        """Cam axis from the pivot of the cam rocker [mm]."""
        return self.center - self.motion.linkage.input_pivot

    @property
    def main_arm(self) -> complex:
        """Direction of the main roller's arm at the bite."""
        import cmath

        import numpy as np

        angle = float(self.motion.linkage.motion(np.array([0.0]), 0).input_angle[0])
        return cmath.rect(1.0, angle + math.radians(self.section.roller.angle))

    @cached_property
    def main_cam(self) -> DiscCam:
        """The cam of the main roller."""
        return self._disc_cam("main cam", self.section.roller, self.section.roller.angle)

    @cached_property
    def return_cam(self) -> DiscCam | None:
        """The cam of the return roller, at a fixed angle from the main roller's arm; None without one."""
        roller = self.section.return_roller
        return (
            None if roller is None else self._disc_cam("return cam", roller, self.section.roller.angle + roller.angle)
        )

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        """Main cam, and the return cam where there is one."""
        return (self.main_cam,) if self.return_cam is None else (self.main_cam, self.return_cam)

    def _disc_cam(self, name: str, roller: Roller, from_input: float) -> DiscCam:

        from gearlink.core.parts.cams.disc_cam import DiscCam
        from gearlink.core.parts.cams.profile import oscillating

        pivot, shift = -self.from_pivot, math.radians(from_input)

        def path(theta: Reals, order: int) -> RollerPath:
            motion = self.motion.linkage.kept_motion(theta, order)
            second = motion.input_acceleration if order > 1 else 0.0
            return oscillating(pivot, roller.arm, motion.input_angle + shift, motion.input_velocity, second)

        joints = tuple(math.radians(start) for start in self.motion.law.starts[:-1])
        return DiscCam(name, path, self.section.sense, roller.radius, joints)

    @property
    def max_pressure_angle(self) -> tuple[float, ...]:
        """Greatest pressure angle of each cam [rad]."""
        return tuple(cam.max_pressure_angle.value for cam in self.discs)

    @property
    def min_curvature_radius(self) -> tuple[float, ...]:
        """Least convex radius of each pitch curve [mm]."""
        return tuple(cam.min_curvature_radius.value for cam in self.discs)

    @property
    def max_pressure_angle_at(self) -> tuple[float, ...]:
        """Cam angles of the largest pressure angles [rad]."""
        return tuple(cam.max_pressure_angle.place for cam in self.discs)

    @property
    def min_curvature_radius_at(self) -> tuple[float, ...]:
        """Cam angles of the least convex radii of curvature [rad]."""
        return tuple(cam.min_curvature_radius.place for cam in self.discs)

    @property
    def max_radius(self) -> tuple[float, ...]:
        """Largest radius of each profile [mm]."""
        return tuple(cam.max_radius for cam in self.discs)

    @property
    def min_radius(self) -> tuple[float, ...]:
        """Smallest radius of each profile [mm]."""
        return tuple(cam.min_radius for cam in self.discs)

    @cached_property
    def center_remedy(self) -> Callable[[float], str]:
        """In words, whether cams can stand anywhere that keep a pressure angle [deg] over the turn.

        Sought once for each limit, however many checks tell of it.
        """
        return cache(self._center_remedy)

    def _center_remedy(self, limit: float) -> str:
        longer = "lengthen the phase in which it occurs"
        try:
            self.center_for(0.99 * limit, refined=False)
        except NoSolution:
            return f"no cam.center keeps it, the least for both rollers is {self._least_limit:.3g} deg: {longer}"
        return f"move cam.center, or {longer}"

    @cached_property
    def _least_limit(self) -> float:
        """Least pressure angle [deg] that some cam centre keeps for every roller, to a tenth."""
        low, high = 0.0, 89.9
        while high - low > 0.1:
            middle = 0.5 * (low + high)
            try:
                self.center_for(middle, refined=False)
            except NoSolution:
                low = middle
            else:
                high = middle
        return high

    def require_motion(self) -> None:
        """Compute law and linkage."""
        _ = self.motion.linkage

    @property
    def stand(self) -> bool:
        """Whether the file has cams and they can be."""
        return self.spec.cam is not None and not self.is_refused

    def explained(self, refusal: NoSolution) -> NoSolution:
        """The refusal of a cam in the keys of this kind, with the centre at which there is one."""
        if refusal.key:
            return refusal
        message = refusal.message.replace(LARGER, FARTHER)
        limit = self.spec.limits.pressure_angle
        advice = f"; for {limit:g} deg: {self.center_remedy(limit)}" if self.advise else ""
        return NoSolution(message + advice, key="cam.center")
