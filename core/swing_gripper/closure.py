"""The force closure of a swing gripper's cam pair: spring, inertia torques, lift-off."""

from __future__ import annotations

import cmath
import math
from typing import TYPE_CHECKING, Any

from gearlink.core.errors import NoSolution, at_key
from gearlink.core.report import safely_above
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.motion import require

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.swing_gripper.cams import GripperCams
    from gearlink.core.swing_gripper.forces import LeverSpring
    from gearlink.core.swing_gripper.motion import Motion
    from gearlink.core.swing_gripper.spec import ClosingSpring, SwingGripperSpec

_SPRING = "torque, or arms, angle and preload"


class Closure:
    """What keeps the rollers on their cams."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion, cams: GripperCams) -> None:
        self.spec, self.motion, self.cams = spec, motion, cams

    @cached_property
    def refusal(self) -> NoSolution | None:
        """Why nothing keeps both rollers on their cams at any speed; None where something may. The cams must stand."""
        try:
            _ = self.lift_sense
            if self.spec.spring is not None:
                _ = self.closing_torque
        except NoSolution as error:
            return error
        return None

    @property
    def stands(self) -> bool:
        """Whether the file gives masses and spring of cams that can be, and the spring presses both rollers."""
        given = None not in (self.spec.inertia, self.spec.spring)
        return given and self.cams.stand and self.refusal is None

    @cached_property
    def spring(self) -> ClosingSpring:
        """The section `spring` of the design file."""
        spring: ClosingSpring = require(self.spec, "spring", _SPRING)
        return spring

    @cached_property
    def closing_torque(self) -> float:
        """Torque of the spring on each rocker [N m]: as given, or that of its levers, the same at every cam angle."""
        spring = self.spring
        if spring.torque is not None:
            return spring.torque
        with at_key("spring.length" if spring.rate else "spring.preload"):
            return self._levers.torque

    @cached_property
    def _levers(self) -> LeverSpring:
        from gearlink.core.swing_gripper.forces import LeverSpring

        spring = self.spring
        (p, q), angle = spring.arms or (0.0, 0.0), math.radians(spring.angle or 0.0)
        return LeverSpring(p, q, angle, spring.preload or 0.0, spring.rate or 0.0, spring.length or 0.0)

    def preload_for(self, torque: float) -> float:
        """Preload that gives the spring a torque [N]."""
        return (self.spring.preload or 0.0) + (torque - self.closing_torque) / self._levers.lever

    def spring_remedy(self, torque: float, *, tells: bool) -> str:
        """What gives the spring a torque [N m], rounded up; where it `tells`, by its value."""
        if self.spring.torque is not None:
            return f"raise spring.torque{f' to {safely_above(torque, 4)} N m' if tells else ''}"
        return f"raise spring.preload{f' to {safely_above(self.preload_for(torque), 4)} N' if tells else ''}"

    @cached_property
    def lift_sense(self) -> int:
        """Sign of the cam rocker's turn by which the main cam lifts its roller."""
        sense = self._lift_sense(self.cams.main_cam)
        if self.cams.return_cam is not None and self._lift_sense(self.cams.return_cam) == sense:
            arm = math.degrees(math.remainder(cmath.phase(self.cams.from_pivot / self.cams.main_arm), 2.0 * math.pi))
            way = "less" if arm > 0.0 else "more"
            raise NoSolution(
                "both rollers lie on the same side of the cam, so a spring that closes one lifts the other: "
                f"cam.return_roller.angle is {way} than {arm:.4g} deg, at which its arm passes the cam axis",
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

        masses = Masses.of(require(self.spec, "inertia", "input, output, coupler, coupler_mass, return_rocker"))
        motion = self.motion.linkage.motion(degrees, 2)
        main = inertia_torque(self.motion.linkage, motion, masses, self.motion.shaft_speed)
        return main, masses.return_rocker * motion.input_acceleration * self.motion.shaft_speed**2

    @cached_property
    def worst_unloading(self) -> tuple[Extreme, ...]:
        """Largest torque that lifts each roller [N m], and the cylinder angle [deg] of it."""
        from gearlink.core.numerics.extremes import maximum_over

        signs = (-self.lift_sense, self.lift_sense)[: len(self.cams.discs)]
        return tuple(
            maximum_over(
                lambda theta, roller=roller, sign=sign: sign * self.inertia_torques(theta)[roller],  # type: ignore[misc]
                start=0.0,
                end=360.0,
                joints=self.motion.law.starts[1:-1],
                samples=720,
            )
            for roller, sign in enumerate(signs)
        )

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam [sheets/h]; None where nothing ever lifts one."""
        from gearlink.core.swing_gripper.forces import lift_off_speed

        worst = max(extreme.value for extreme in self.worst_unloading)
        speed = lift_off_speed(self.spec.speed, self.closing_torque, worst)
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Least spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(0.0, *(extreme.value for extreme in self.worst_unloading)) + reserve
