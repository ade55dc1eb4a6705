"""The force closure of a swing gripper's cam pair, mixed into its design class."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import NoSolution, at_key
from gearlink.core.report import Check, Status, Table, safely_above
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.cams import GripperCams

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.swing_gripper.forces import LeverSpring
    from gearlink.core.swing_gripper.spec import ClosingSpring

_SPRING = "torque, or arms, angle and preload"


class GripperClosure(GripperCams):
    """The force closure of the design: spring, contact torques, lift-off."""

    @cached_property
    def _spring(self) -> ClosingSpring:
        spring: ClosingSpring = self._require("spring", _SPRING)
        return spring

    @cached_property
    def closing_torque(self) -> float:
        """Torque of the spring on each rocker [N m]: as given, or that of its levers, the same at every cam angle."""
        spring = self._spring
        if spring.torque is not None:
            return spring.torque
        with at_key("spring.length" if spring.rate else "spring.preload"):
            return self._levers.torque

    @cached_property
    def _levers(self) -> LeverSpring:
        from gearlink.core.swing_gripper.forces import LeverSpring

        spring = self._spring
        (p, q), angle = spring.arms or (0.0, 0.0), math.radians(spring.angle or 0.0)
        return LeverSpring(p, q, angle, spring.preload or 0.0, spring.rate or 0.0, spring.length or 0.0)

    def _spring_remedy(self, torque: float) -> str:
        """What gives the spring a torque [N m], rounded up."""
        if self._spring.torque is not None:
            return f"raise spring.torque to {safely_above(torque, 4)} N m"
        pull = (torque - self.closing_torque) / self._levers.lever
        return f"raise spring.preload to {safely_above((self._spring.preload or 0.0) + pull, 4)} N"

    @cached_property
    def lift_sense(self) -> int:
        """Sign of the cam rocker's turn by which the main cam lifts its roller."""
        sense = self._lift_sense(self.main_cam)
        if self.return_cam is not None and self._lift_sense(self.return_cam) == sense:
            arm = math.degrees(math.remainder(_angle(self._from_pivot / self._main_arm), 2.0 * math.pi))
            way = "above" if arm > 0.0 else "below"
            raise NoSolution(
                "both rollers lie on the same side of the cam, so a spring that closes one lifts the other: set "
                f"cam.return_roller.angle {way} {arm:.4g} deg, where its arm has passed the cam axis",
                key="cam.return_roller.angle",
            )
        return sense

    def _lift_sense(self, cam: DiscCam) -> int:
        import numpy as np

        path = cam.path(np.array([0.0]), 1)
        tangent = path.first - 1j * cam.sense * path.position
        outward = 1j * cam.sense * tangent
        return 1 if float(np.real(np.conj(outward) * path.direction)[0]) > 0.0 else -1

    def inertia_torques(self, degrees: Any) -> tuple[Any, Any]:
        """Inertia torques of the cam rocker with linkage and of the return rocker [N m] at cylinder angles [deg]."""
        from gearlink.core.swing_gripper.forces import Masses, inertia_torque

        masses = Masses.of(self._require("inertia", "input, output, coupler, coupler_mass, return_rocker"))
        motion = self.linkage.motion(degrees, 2)
        main = inertia_torque(self.linkage, motion, masses, self.shaft_speed)
        return main, masses.return_rocker * motion.input_acceleration * self.shaft_speed**2

    @cached_property
    def _worst_unloading(self) -> tuple[Extreme, ...]:
        """Largest torque that lifts each roller [N m], and the cylinder angle [deg] of it."""
        from gearlink.core.numerics.extremes import maximum_over

        signs = (-self.lift_sense, self.lift_sense)[: len(self.cams)]
        return tuple(
            maximum_over(
                lambda theta, roller=roller, sign=sign: sign * self.inertia_torques(theta)[roller],  # type: ignore[misc]
                start=0.0,
                end=360.0,
                joints=self.law.starts[1:-1],
                samples=720,
            )
            for roller, sign in enumerate(signs)
        )

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam [sheets/h]; None where nothing ever lifts one."""
        from gearlink.core.swing_gripper.forces import lift_off_speed

        worst = max(extreme.value for extreme in self._worst_unloading)
        speed = lift_off_speed(self.spec.speed, self.closing_torque, worst)
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Least spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(0.0, *(extreme.value for extreme in self._worst_unloading)) + reserve

    def check_lift_off(self) -> Check:
        """GL406: contact at the design speed, with a tenth of speed in reserve."""
        torque, speed, reserve = self.closing_torque, self.lift_off_speed, self._spring.reserve
        names = [cam.name.removesuffix(" cam") for cam in self.cams]
        roller, worst = max(zip(names, self._worst_unloading, strict=True), key=lambda item: item[1].value)
        if speed is None:
            return Check("GL406", "lift-off", "pass", "no inertia ever unloads a roller", None, None, "sheets/h")
        left = torque - worst.value
        status: Status = "fail" if left <= reserve else "warn" if speed < 1.1 * self.spec.speed else "pass"
        text = (
            f"the {roller} roller keeps {left:.4g} N m of the spring's {torque:.6g} N m at cylinder angle "
            f"{worst.place:.4g} deg; it lifts off at {speed:.6g} sheets/h"
        )
        if left <= reserve and reserve > 0.0:
            text += f", and {reserve:g} N m are to remain"
        if status != "pass":
            remedy = self._spring_remedy(1.21 * worst.value + reserve)
            text += f": {remedy} for a tenth of speed in reserve, or lower the speed"
        return Check("GL406", "lift-off", status, text, speed, self.spec.speed, "sheets/h")

    def table_forces(self, samples: int | None = None) -> Table:
        """Inertia and contact torques and normal forces over the turn."""
        import numpy as np

        from gearlink.core.numerics.arrays import turn_degrees
        from gearlink.core.swing_gripper.forces import contact_torques

        degrees, spring = turn_degrees(samples), self.closing_torque
        main, back = self.inertia_torques(degrees)
        torques = contact_torques(spring, main, back, self.lift_sense)
        columns: dict[str, tuple[Any, str]] = {"theta": (degrees, "deg"), "inertia_torque": (main, "N m")}
        rollers = (self._cam.roller, self._cam.return_roller)
        contacts = list(zip(("main", "return"), torques, self.cams, rollers, strict=False))
        for name, torque, _, _ in contacts:
            columns[f"contact_torque_{name}"] = (torque, "N m")
        for name, torque, cam, roller in contacts:
            lever = roller.arm * 1e-3 * np.cos(cam.pressure_angle(np.radians(degrees)))  # type: ignore[union-attr]
            columns[f"normal_force_{name}"] = (torque / lever, "N")
        return Table.of("forces", columns)


def _angle(z: complex) -> float:
    return math.atan2(z.imag, z.real)
