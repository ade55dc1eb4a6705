"""The swing gripper as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import GearlinkError, NoSolution, at_key
from gearlink.core.base.report import safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.machines.swing_gripper import checks, remedies, tables
from gearlink.core.machines.swing_gripper.cams import GripperCams
from gearlink.core.machines.swing_gripper.motion import Motion, require
from gearlink.core.numerics.motion_extremes import WithExtremes, names
from gearlink.core.parts.cams.machine import OnDiscCams

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.cams import GripperCams
    from gearlink.core.machines.swing_gripper.forces import LeverSpring
    from gearlink.core.machines.swing_gripper.handover_geometry import TipPath
    from gearlink.core.machines.swing_gripper.law import SixPhaseLaw
    from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
    from gearlink.core.machines.swing_gripper.motion import Motion
    from gearlink.core.machines.swing_gripper.spec import ClosingSpring, SwingGripperSpec
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.parts.cams.disc_cam import DiscCam


# The force closure of a swing gripper's cam pair: spring, inertia torques, lift-off

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
        from gearlink.core.machines.swing_gripper.forces import LeverSpring

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
        from gearlink.core.machines.swing_gripper.forces import Masses, inertia_torque

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
        from gearlink.core.machines.swing_gripper.forces import lift_off_speed

        worst = max(extreme.value for extreme in self.worst_unloading)
        speed = lift_off_speed(self.spec.speed, self.closing_torque, worst)
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Least spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(0.0, *(extreme.value for extreme in self.worst_unloading)) + reserve


class Handover:
    """Speed and place of the tip at the handover."""

    def __init__(self, spec: SwingGripperSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

    @cached_property
    def speed(self) -> float:
        """Speed of the gripper tip at the handover [mm/s]."""
        return self.spec.arm.length * self.state[1] * self.motion.shaft_speed

    @cached_property
    def mismatch(self) -> float:
        """Speed of the tip less that of the cylinder's surface [mm/s]."""
        return self.speed - self.spec.cylinder.radius * self.motion.shaft_speed

    @cached_property
    def state(self) -> tuple[float, float]:
        """Swing angle [rad] and its rate by the cylinder angle at the handover."""
        import numpy as np

        beta, rate = self.motion.law.evaluate(np.array([self.spec.handover]), 1)
        return float(beta[0]), float(rate[0])

    @cached_property
    def tip(self) -> complex:
        """The gripper tip at the handover [mm]."""
        arm = self.spec.arm
        direction = math.radians(arm.direction) + self.spec.swing_sense * self.state[0]
        return complex(*self.spec.pivots.output) + cmath.rect(arm.length, direction)

    @cached_property
    def center(self) -> complex:
        """Axis of a cylinder whose pitch circle the tip meets on the line of centres at the handover [mm]."""
        from gearlink.core.machines.swing_gripper.handover_geometry import drum_center

        return drum_center(complex(*self.spec.pivots.output), self.tip, self.spec.cylinder.radius)

    def path(self, degrees: Any) -> tuple[Any, Any, TipPath]:
        """Lead of the arm on the line of centres [rad], tip speed [mm/s] and path of the tip at cylinder angles."""
        import numpy as np

        from gearlink.core.machines.swing_gripper.handover_geometry import tip_path

        arm, radius = self.spec.arm.length, self.spec.cylinder.radius
        distance, lead_0 = arm + radius, 0.0
        if self.spec.cylinder.center is not None:
            pivot = complex(*self.spec.pivots.output)
            line = complex(*self.spec.cylinder.center) - pivot
            distance = abs(line)
            lead_0 = self.spec.swing_sense * cmath.phase((self.tip - pivot) / line)
        beta, rate = self.motion.law.evaluate(np.fmod(degrees + 360.0, 360.0), 1)
        lead = lead_0 + beta - self.state[0]
        turned = np.radians(degrees - self.spec.handover)
        return lead, arm * rate * self.motion.shaft_speed, tip_path(arm, radius, distance, lead, turned, lead_0)


_CAM_PLACES = ("max_pressure_angle_at", "min_curvature_radius_at")
_CAM = ("max_pressure_angle", "min_curvature_radius", *_CAM_PLACES, "max_radius", "min_radius")
_LAW = ("handover_speed", "handover_mismatch", "handover_center", "total_swing", "min_transmission_angle")
_LOOP = ("newton_agreement", "newton_iterations", "condition_number")
_CLOSURE = ("closing_torque", "lift_off_speed")
_LAW_CHECKS = ("transmission-angle", "conditioning", "handover", "velocity-step", "acceleration-step", "jerk-step")
_CAM_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance")


_EXTREMES = (
    "min_transmission_angle_at",
    *names("input_velocity", "input_acceleration", "output_velocity", "output_acceleration"),
)


_NOT_OF_MOTION = {"name", "cam", "size"}
_OF_CAMS = {"max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius"}


class SwingGripper(WithExtremes, OnDiscCams):
    """A swing gripper, from its design file to every quantity that is asked for."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    outlines = {
        "gripper": Outline((*_LAW, *_LOOP), _LAW_CHECKS, ("motion",)),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*_LAW, *_LOOP, *_EXTREMES), _LAW_CHECKS, ("motion",)),
    }
    extra_tables = ("forces", "newton", "handover_window", "tip")

    extreme_names = _EXTREMES
    motion_extremes: dict[str, Any] = placed("motion.extremes")
    cost = 7.0
    candidates, ways_of = remedies.candidates, remedies.ways_of

    # Parts

    @cached_property
    def motion(self) -> Motion:
        """Law and linkage."""
        return Motion(self.spec)

    @cached_property
    def handover(self) -> Handover:
        """Where the tip meets the cylinder."""
        return Handover(self.spec, self.motion)

    @cached_property
    def cams(self) -> GripperCams:
        """Main and return cam."""
        return GripperCams(self.spec, self.motion, advise=self.advises)

    @cached_property
    def closure(self) -> Closure:
        """What keeps the rollers on their cams."""
        return Closure(self.spec, self.motion, self.cams)

    law: SixPhaseLaw = placed("motion.law")
    linkage: GripperLinkage = placed("motion.linkage")
    shaft_speed: float = placed("motion.shaft_speed")
    turn_time: float = placed("motion.turn_time")
    main_cam: DiscCam = placed("cams.main_cam")
    return_cam: DiscCam | None = placed("cams.return_cam")

    def completion(self) -> Iterator[Found]:
        """The cam's axis in place of the rule that chose it; one that no rule finds stays asked for."""
        if self.spec.size is not None and self.spec.cam is not None and self.spec.cam.center is None:
            with suppress(NoSolution):
                center = self.cam_center
                yield Found("cam.center", [center.real, center.imag], "found for size")
                yield Found("size", None)

    # Quantities

    total_swing: float = placed("motion.law.total_swing")
    min_transmission_angle: tuple[float, float] = placed("motion.min_transmission_angle")
    newton_agreement: float = placed("motion.newton_agreement")
    newton_iterations: int = placed("motion.newton_iterations")
    condition_number: float = placed("motion.condition_number")
    handover_speed: float = placed("handover.speed")
    handover_mismatch: float = placed("handover.mismatch")
    handover_center: complex = placed("handover.center")
    cam_center: complex = placed("cams.center")
    max_pressure_angle: tuple[float, ...] = placed("cams.max_pressure_angle")
    min_curvature_radius: tuple[float, ...] = placed("cams.min_curvature_radius")
    max_pressure_angle_at: tuple[float, ...] = placed("cams.max_pressure_angle_at")
    min_curvature_radius_at: tuple[float, ...] = placed("cams.min_curvature_radius_at")
    max_radius: tuple[float, ...] = placed("cams.max_radius")
    min_radius: tuple[float, ...] = placed("cams.min_radius")
    closing_torque: float = placed("closure.closing_torque")
    lift_off_speed: float | None = placed("closure.lift_off_speed")
    spring_torque: float = placed("closure.spring_torque")

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those that need an optional section included: asking for one says what is missing."""
        return (*_LAW, *_LOOP, *_EXTREMES, "cam_center", *_CAM, *_CLOSURE, "spring_torque")

    def varied(self, spec: SwingGripperSpec) -> SwingGripper:
        """The design of another file; law and linkage are kept where it differs in the cams alone."""
        made = type(self)(spec)
        if all(name in _NOT_OF_MOTION or value == getattr(self.spec, name) for name, value in spec):
            made.motion = self.motion
        return made

    def prepare(self, quantities: Iterable[str]) -> None:
        """Seek the extremes of the cams together, where several are asked for."""
        if len({*quantities} & _OF_CAMS) > 1:
            with suppress(GearlinkError):  # it is said where the quantity is asked for
                self.cams.seek()

    def raw(self, name: str) -> Any:
        """The value of a quantity; a point as its two coordinates."""
        value = super().raw(name)
        return (value.real, value.imag) if isinstance(value, complex) else value

    # Tables and checks

    table_motion, table_newton, table_forces = tables.motion, tables.newton, tables.forces
    table_main_cam, table_return_cam = tables.main_cam, tables.return_cam
    table_handover_window, table_tip = tables.handover_window, tables.tip

    check_transmission_angle, check_conditioning = checks.transmission_angle, checks.conditioning
    check_velocity_step, check_acceleration_step = checks.velocity_step, checks.acceleration_step
    check_jerk_step, check_handover = checks.jerk_step, checks.handover
    check_pressure_angle, check_cam_undercut = checks.pressure_angle, checks.cam_undercut
    check_shaft_clearance, check_lift_off = checks.shaft_clearance, checks.lift_off

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """With cams each command judges them, and whether a spring keeps the rollers on."""
        of_cams = () if spec.cam is None else (*cls.outlines["cam"].checks, "lift-off")
        return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams)))

    def outline(self, command: str) -> Outline:
        """`gripper` and `analyze` add what the optional sections of the file make possible."""
        outline, spec = self.outlines[command], self.spec
        if command == "cam":
            return self._of_cams(outline)
        if spec.cam is None:
            return outline
        if self.cams.is_refused:
            return Outline(outline.quantities, (*outline.checks, "pressure-angle"), outline.tables)
        cams = self._of_cams(self.outlines["cam"])
        quantities, tables = [*outline.quantities, *cams.quantities[:-2]], outline.tables
        if command == "analyze":
            quantities, tables = [*outline.quantities, *cams.quantities], (*outline.tables, *cams.tables)
        checks = dict.fromkeys((*outline.checks, *cams.checks))
        if self.closure.stands:
            quantities += _CLOSURE if spec.spring is not None and spec.spring.torque is None else ("lift_off_speed",)
            checks |= {"lift-off": None}
        return Outline(tuple(quantities), tuple(checks), tables)

    def _of_cams(self, outline: Outline) -> Outline:
        """`cam`, with the centre where it is chosen, and what is wrong where nothing presses the rollers on them."""
        cam = self.spec.cam
        if cam is None or self.cams.is_refused:
            return outline
        chosen = ("cam_center",) if cam.center is None else ()
        closing = ("lift-off",) if self.spec.spring is None or self.closure.refusal is not None else ()
        tables = outline.tables if cam.return_roller is not None else outline.tables[:1]
        return Outline((*chosen, *outline.quantities), (*outline.checks, *closing), tables)
