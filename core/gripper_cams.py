"""The cam pair and the force closure of a swing gripper, mixed into its design class."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core.report import Check, Status, Table

if TYPE_CHECKING:
    from gearlink.core.cam_profile import Reals, RollerPath
    from gearlink.core.disc_cam import DiscCam
    from gearlink.core.gripper_linkage import GripperLinkage
    from gearlink.core.six_phase_law import SixPhaseLaw
    from gearlink.core.specs.swing_gripper import Roller, SwingGripperSpec


class GripperCams:
    """Reads `law`, `linkage` and `shaft_speed` of the design."""

    spec: SwingGripperSpec
    samples: int | None
    law: SixPhaseLaw
    linkage: GripperLinkage
    shaft_speed: float

    def _require(self, section: str, words: str) -> Any:
        raise NotImplementedError

    @cached_property
    def cam_center(self) -> complex:
        """The cam axis in the machine's frame [mm], given or chosen by `size`."""
        cam = self._require("cam", "center, sense, roller")
        if cam.center is not None:
            return complex(*cam.center)
        from gearlink.core.gripper_size import smallest_cam_center

        size = self._require("size", "pressure_angle, or give cam.center")
        return smallest_cam_center(self.linkage, cam, math.radians(size.pressure_angle))

    @cached_property
    def main_cam(self) -> DiscCam:
        """The cam of the main roller."""
        cam = self._require("cam", "center, sense, roller")
        return self._disc_cam("main cam", cam.roller, cam.roller.angle)

    @cached_property
    def return_cam(self) -> DiscCam | None:
        """The cam of the return roller, at a fixed angle from the main roller's arm; None without one."""
        cam = self._require("cam", "center, sense, roller")
        roller = cam.return_roller
        return None if roller is None else self._disc_cam("return cam", roller, cam.roller.angle + roller.angle)

    @property
    def cams(self) -> tuple[DiscCam, ...]:
        """Main cam, and the return cam where there is one."""
        return (self.main_cam,) if self.return_cam is None else (self.main_cam, self.return_cam)

    def _disc_cam(self, name: str, roller: Roller, from_input: float) -> DiscCam:
        import numpy as np

        from gearlink.core.cam_profile import oscillating
        from gearlink.core.disc_cam import DiscCam

        pivot, shift = self.linkage.input_pivot - self.cam_center, math.radians(from_input)

        def path(theta: Reals, order: int) -> RollerPath:
            motion = self.linkage.motion(np.degrees(theta), order)
            second = motion.input_acceleration if order > 1 else 0.0
            return oscillating(pivot, roller.arm, motion.input_angle + shift, motion.input_velocity, second)

        joints = tuple(math.radians(start) for start in self.law.starts[:-1])
        return DiscCam(name, path, self.spec.cam.sense, roller.radius, joints)  # type: ignore[union-attr]

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

    @property
    def _cam_degrees(self) -> Any:
        import numpy as np

        count = self.samples or 360
        return np.arange(count) * (360.0 / count)

    def table_main_cam(self) -> Table:
        """The main cam, point for point."""
        return self.main_cam.table("main_cam", self._cam_degrees)

    def table_return_cam(self) -> Table:
        """The return cam, point for point."""
        cam = self.return_cam
        if cam is None:
            from gearlink.core.errors import MissingSection

            raise MissingSection("the table needs cam.return_roller: arm, angle, radius", key="cam.return_roller")
        return cam.table("return_cam", self._cam_degrees)

    def check_pressure_angle(self) -> Iterator[Check]:
        """GL401 for both cams."""
        from gearlink.core.cam_checks import pressure_angle_checks

        remedy = "move cam.center away from the rocker, or lengthen the phase in which it occurs"
        yield from pressure_angle_checks(self.cams, self.spec.limits.pressure_angle, remedy)

    def check_cam_undercut(self) -> Iterator[Check]:
        """GL402 for both cams."""
        from gearlink.core.cam_checks import undercut_checks

        yield from undercut_checks(self.cams)

    # Force closure

    @cached_property
    def lift_sense(self) -> int:
        """Sign of the cam rocker's turn that lifts the main roller off its cam."""
        import numpy as np

        theta = np.array([0.0])
        path = self.main_cam.path(theta, 1)
        tangent = path.first - 1j * self.main_cam.sense * path.position
        outward = 1j * self.main_cam.sense * tangent
        return 1 if float(np.real(np.conj(outward) * path.direction)[0]) > 0.0 else -1

    def inertia_torques(self, degrees: Any) -> tuple[Any, Any]:
        """Inertia torques of the cam rocker with linkage and of the return rocker [N m] at cylinder angles [deg]."""
        from gearlink.core.gripper_forces import Masses, inertia_torque

        masses = Masses.of(self._require("inertia", "input, output, coupler, coupler_mass, return_rocker"))
        motion = self.linkage.motion(degrees, 2)
        main = inertia_torque(self.linkage, motion, masses, self.shaft_speed)
        return main, masses.return_rocker * motion.input_acceleration * self.shaft_speed**2

    @cached_property
    def _worst_unloading(self) -> tuple[Any, Any]:
        """Largest torque that lifts each roller, and its place."""
        from gearlink.core.extremes import maximum_over

        sense = self.lift_sense
        bounds = {"start": 0.0, "end": 360.0, "joints": self.law.starts[1:-1], "samples": 720}
        return (
            maximum_over(lambda theta: -sense * self.inertia_torques(theta)[0], **bounds),  # type: ignore[arg-type]
            maximum_over(lambda theta: sense * self.inertia_torques(theta)[1], **bounds),  # type: ignore[arg-type]
        )

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam [sheets/h]; None where nothing ever lifts one."""
        from gearlink.core.gripper_forces import lift_off_speed

        spring = self._require("spring", "torque")
        worst = [extreme.value for extreme in self._worst_unloading]
        speed = lift_off_speed(self.spec.speed, spring.torque, worst[0], worst[1])
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Least spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(extreme.value for extreme in self._worst_unloading) + reserve

    def check_lift_off(self) -> Check:
        """GL406: contact at the design speed, with a tenth of speed in reserve."""
        spring, speed = self._require("spring", "torque"), self.lift_off_speed
        if speed is None:
            return Check("GL406", "lift-off", "pass", "no inertia ever unloads a roller", None, None, "sheets/h")
        roller, worst = max(zip(("main", "return"), self._worst_unloading, strict=True), key=lambda item: item[1].value)
        left = spring.torque - worst.value
        status: Status = "fail" if left <= spring.reserve else "warn" if speed < 1.1 * self.spec.speed else "pass"
        text = (
            f"the {roller} roller keeps {left:.4g} N m of the spring's {spring.torque:g} N m at cylinder angle "
            f"{worst.place:.4g} deg; it lifts off at {speed:.6g} sheets/h"
        )
        if status != "pass":
            needed = 1.21 * worst.value + spring.reserve
            text += f": raise spring.torque to {needed:.4g} N m for a tenth of speed in reserve"
        return Check("GL406", "lift-off", status, text, speed, self.spec.speed, "sheets/h")

    def table_forces(self) -> Table:
        """Inertia and contact torques and normal forces over the turn."""
        import numpy as np

        from gearlink.core.gripper_forces import contact_torques

        spring = self._require("spring", "torque")
        degrees = self._cam_degrees
        main, back = self.inertia_torques(degrees)
        torques = contact_torques(spring.torque, main, back, self.lift_sense)
        columns: dict[str, tuple[Any, str]] = {
            "theta": (degrees, "deg"),
            "inertia_torque": (main, "N m"),
            "contact_torque_main": (torques[0], "N m"),
            "contact_torque_return": (torques[1], "N m"),
        }
        rollers = (self.spec.cam.roller, self.spec.cam.return_roller)  # type: ignore[union-attr]
        for name, torque, cam, roller in zip(("main", "return"), torques, self.cams, rollers, strict=False):
            lever = roller.arm * 1e-3 * np.cos(cam.pressure_angle(np.radians(degrees)))  # type: ignore[union-attr]
            columns[f"normal_force_{name}"] = (torque / lever, "N")
        data, units = zip(*columns.values(), strict=True)
        return Table("forces", tuple(columns), units, data)
