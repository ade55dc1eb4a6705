"""The swing gripper as a design: its parts, and what each command shows of it."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping
from contextlib import suppress
from functools import cache, partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.base.design import Found, Outline, placed
from gearlink.core.base.errors import GearlinkError, MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.report import Table, safely_above
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.swing_gripper import checks
from gearlink.core.machines.swing_gripper.codes import FARTHER
from gearlink.core.machines.swing_gripper.motion import Motion, require
from gearlink.core.numerics.arrays import Reals, product, turn_degrees
from gearlink.core.numerics.motion_extremes import WithExtremes, names
from gearlink.core.parts.cams.codes import LARGER
from gearlink.core.parts.cams.disc_cam import DiscCam
from gearlink.core.parts.cams.disc_cams import DiscCams, OnDiscCams
from gearlink.core.parts.cams.laws import Law, law
from gearlink.core.parts.cams.profile import RollerPath, oscillating
from gearlink.core.parts.cams.shaped_design import LAW_CHECKS, LAW_TABLE, WithShapedLaws

if TYPE_CHECKING:
    from collections.abc import Callable

    from gearlink.core.machines.swing_gripper.forces import LeverSpring, Stop
    from gearlink.core.machines.swing_gripper.handover_geometry import TipPath
    from gearlink.core.machines.swing_gripper.law import SixPhaseLaw
    from gearlink.core.machines.swing_gripper.linkage import GripperLinkage
    from gearlink.core.machines.swing_gripper.spec import (
        ClosingSpring,
        FingerSection,
        GripperCam,
        Roller,
        SwingGripperSpec,
    )
    from gearlink.core.numerics.extremes import Extreme
    from gearlink.core.parts.cams.shaped import Phase
    from gearlink.core.parts.cams.size import RockingRoller


_WINDOW = 6.0
_ROWS = 41


def motion_table(design: SwingGripper, samples: int | None = None) -> Table:
    """Angles, velocities and accelerations of both rockers over the turn."""
    degrees, motion = design.motion.rows(samples, 3)
    speed, square = design.motion.shaft_speed, design.motion.shaft_speed**2
    columns = {
        "theta": (degrees, "deg"),
        "beta": (np.degrees(motion.beta), "deg"),
        "input_angle": (np.degrees(motion.input_angle), "deg"),
        "coupler_angle": (np.degrees(motion.coupler_angle), "deg"),
        "output_angle": (np.degrees(motion.output_angle), "deg"),
        "input_velocity": (motion.input_velocity * speed, "rad/s"),
        "output_velocity": (motion.output_velocity * speed, "rad/s"),
        "input_acceleration": (motion.input_acceleration * square, "rad/s^2"),
        "output_acceleration": (motion.output_acceleration * square, "rad/s^2"),
        "coupler_velocity": (motion.coupler_velocity * speed, "rad/s"),
        "coupler_acceleration": (motion.coupler_acceleration * square, "rad/s^2"),
        "input_jerk": (motion.input_jerk * speed**3, "rad/s^3"),
    }
    return Table.of("motion", columns)


def tip_table(design: SwingGripper, samples: int | None = None) -> Table:
    """Path of the gripper's tip in the machine's frame, its speed and acceleration, and the jerk of the arm."""
    degrees, spec, speed = turn_degrees(samples), design.spec, design.motion.shaft_speed
    beta = design.motion.law.evaluate(degrees, 3)
    arm = np.exp(1j * spec.swing_sense * beta[0])
    arm = product(spec.arm.length * cmath.exp(1j * math.radians(spec.arm.direction)), arm)
    velocity, acceleration = beta[1] * speed, beta[2] * speed**2
    place = complex(*spec.pivots.output) + arm
    columns = {
        "theta": (degrees, "deg"),
        "time": (degrees / 360.0 * 3.6e6 / spec.speed, "ms"),
        "tip_x": (place.real, "mm"),
        "tip_y": (place.imag, "mm"),
        "tip_speed": (spec.arm.length * np.abs(velocity), "mm/s"),
        "tip_acceleration": (spec.arm.length * np.hypot(acceleration, velocity**2), "mm/s^2"),
        "output_jerk": (spec.swing_sense * beta[3] * speed**3 + 0.0, "rad/s^3"),
    }
    return Table.of("tip", columns)


def newton_table(design: SwingGripper, samples: int | None = None) -> Table:
    """Both ways side by side: deviation of the angles, steps, opening of the loop, error of the closed form."""
    from gearlink.core.machines.swing_gripper.linkage import closed_form_error

    degrees, loop = design.motion.loop_at(samples)
    _, motion = design.motion.rows(samples)
    columns = {
        "theta": (degrees, "deg"),
        "deviation": (np.degrees(loop.deviation), "deg"),
        "iterations": (loop.iterations, "1"),
        "residual": (loop.residual, "mm"),
        "error": (np.degrees(closed_form_error(design.linkage, motion)), "deg"),
    }
    return Table.of("newton", columns)


def main_cam_table(design: SwingGripper, samples: int | None = None) -> Table:
    """The main cam, point for point."""
    return design.cams.main_cam.table("main_cam", samples)


def return_cam_table(design: SwingGripper, samples: int | None = None) -> Table:
    """The return cam, point for point."""
    if design.cams.return_cam is None:
        raise MissingSection("the table needs cam.return_roller: arm, angle, radius", key="cam.return_roller")
    return design.cams.return_cam.table("return_cam", samples)


def finger_cam_table(design: SwingGripper, samples: int | None = None) -> Table:
    """The cam of the fingers, point for point, over its turn seen from the arm."""
    if design.spec.fingers is None:
        raise MissingSection("the table needs the section fingers", key="fingers")
    return design.fingers.cam.table("finger_cam", samples)


def forces_table(design: SwingGripper, samples: int | None = None) -> Table:
    """Inertia and contact torques and normal forces over the turn."""
    from gearlink.core.machines.swing_gripper.forces import contact_torques

    degrees, spring = turn_degrees(samples), design.closure.closing_torque
    main, back = design.closure.inertia_torques(degrees)
    torques = contact_torques(spring, main, back, design.closure.lift_sense)
    columns: dict[str, tuple[Any, str]] = {"theta": (degrees, "deg"), "inertia_torque": (main, "N m")}
    rollers = (design.cams.section.roller, design.cams.section.return_roller)
    contacts = list(zip(("main", "return"), torques, design.cams.discs, rollers, strict=False))
    for name, torque, _, _ in contacts:
        columns[f"contact_torque_{name}"] = (torque, "N m")
    for name, torque, cam, roller in contacts:
        lever = roller.arm * 1e-3 * np.cos(cam.pressure_angle(np.radians(degrees)))  # type: ignore[union-attr]
        columns[f"normal_force_{name}"] = (torque / lever, "N")
    return Table.of("forces", columns)


def handover_window_table(design: SwingGripper, _samples: int | None = None) -> Table:
    """Gap of the tip to the pitch circle, slip and speed difference round the handover."""
    from gearlink.core.machines.swing_gripper.handover_geometry import speed_difference

    half = design.spec.release.window if design.spec.release is not None else _WINDOW
    degrees = design.motion.handover + half * np.linspace(-1.0, 1.0, _ROWS)
    lead, speed, path = design.handover.path(degrees)
    difference = speed_difference(path, lead, speed, design.motion.shaft_speed, design.spec.cylinder.radius)
    columns = {
        "theta": (degrees, "deg"),
        "arm_lead": (np.degrees(lead), "deg"),
        "gap": (path.gap, "mm"),
        "slip": (path.slip, "mm"),
        "speed_difference": (difference, "mm/s"),
    }
    return Table.of("handover_window", columns)


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
            raise NoSolution(
                "one roller alone does not fix where the cam is", key="size", fix="give size.side, 1 or -1"
            )
        rollers = [self._rocking(cam.roller, cam.roller.angle, side)]
        if back is not None:
            rollers.append(self._rocking(back, cam.roller.angle + back.angle, -side))
        return rollers

    def _rocking(self, roller: Roller, from_input: float, side: int) -> RockingRoller:
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
        """Direction of the main roller's arm at the pick-up position."""
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

        pivot, shift = -self.from_pivot, math.radians(from_input)

        def path(theta: Reals, order: int) -> RollerPath:
            motion = self.motion.linkage.kept_motion(theta, order)
            second = motion.input_acceleration if order > 1 else 0.0
            return oscillating(pivot, roller.arm, motion.input_angle + shift, motion.input_velocity, second)

        joints = tuple(math.radians(start) for start in self.motion.law.starts[:-1])
        return DiscCam(name, path, self.section.sense, roller.radius, joints)

    @property
    def max_pressure_angle(self) -> tuple[float, ...]:
        """Maximum pressure angle of each cam [rad]."""
        return tuple(cam.max_pressure_angle.value for cam in self.discs)

    @property
    def min_curvature_radius(self) -> tuple[float, ...]:
        """Minimum convex radius of each pitch curve [mm]."""
        return tuple(cam.min_curvature_radius.value for cam in self.discs)

    @property
    def max_pressure_angle_at(self) -> tuple[float, ...]:
        """Cam angles of the largest pressure angles [rad]."""
        return tuple(cam.max_pressure_angle.place for cam in self.discs)

    @property
    def min_curvature_radius_at(self) -> tuple[float, ...]:
        """Cam angles of the minimum convex radii of curvature [rad]."""
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
            return f"{longer} (no cam centre meets the limit, best {short(self._least_limit, 3)} deg)"
        return f"move cam.center, or {longer}"

    @cached_property
    def _least_limit(self) -> float:
        """Minimum pressure angle [deg] that some cam centre keeps for every roller, to a tenth."""
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
        message, fix = (text.replace(LARGER, FARTHER) for text in (refusal.message, refusal.fix))
        if self.advise:
            fix = self.center_remedy(self.spec.limits.pressure_angle)
        return NoSolution(message, key="cam.center", fix=fix)


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
                "both rollers lie on the same side of the cam: a spring that closes one lifts the other",
                key="cam.return_roller.angle",
                fix=f"set cam.return_roller.angle {'below' if way == 'more' else 'above'} {short(arm)} deg",
            )
        return sense

    def _lift_sense(self, cam: DiscCam) -> int:
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
        from gearlink.core.numerics.extremes import extremes_over
        from gearlink.core.numerics.together import kept_last

        torques, sense = kept_last(self.inertia_torques), self.lift_sense

        def lifting(roller: int, theta: Reals) -> Reals:
            return np.asarray((sense if roller else -sense) * torques(theta)[roller])

        wanted = [(partial(lifting, roller), True) for roller in range(len(self.cams.discs))]
        return tuple(extremes_over(wanted, 0.0, 360.0, joints=self.motion.law.starts[1:-1], samples=720))

    @cached_property
    def lift_off_speed(self) -> float | None:
        """Speed at which a roller leaves its cam [sheets/h]; None where nothing ever lifts one."""
        from gearlink.core.machines.swing_gripper.forces import lift_off_speed

        worst = max(extreme.value for extreme in self.worst_unloading)
        speed = lift_off_speed(self.spec.speed, self.closing_torque, worst)
        return speed if math.isfinite(speed) else None

    @cached_property
    def spring_torque(self) -> float:
        """Minimum spring torque that keeps both rollers on their cams at the design speed [N m]."""
        reserve = self.spec.spring.reserve if self.spec.spring else 0.0
        return max(0.0, *(extreme.value for extreme in self.worst_unloading)) + reserve


_STOP = {
    "stop_force": "force",
    "stop_force_max": "force_max",
    "stop_angle": "angle",
    "stop_tip_offset": "tip_offset",
    "stop_impact_angle": "impact_angle",
    "stop_impact_speed": "impact_speed",
    "take_off_angle": "take_off_angle",
    "take_off_speed": "take_off_speed",
    "stop_mass": "mass",
    "settling_time": "settling_time",
    "settling_angle": "settling_angle",
}
"""Quantities of the stop, and what they are called there."""


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
        beta, rate = self.motion.law.evaluate(np.array([self.motion.handover]), 1)
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
        turned = np.radians(degrees - self.motion.handover)
        return lead, arm * rate * self.motion.shaft_speed, tip_path(arm, radius, distance, lead, turned, lead_0)


_CAM_PLACES = ("max_pressure_angle_at", "min_curvature_radius_at")
_CAM = ("max_pressure_angle", "min_curvature_radius", *_CAM_PLACES, "max_radius", "min_radius")
_LAW = ("handover_speed", "handover_mismatch", "handover_center", "total_swing", "min_transmission_angle")
_PHASES = (
    "accelerate_angle",
    "constant_angle",
    "decelerate_angle",
    "far_dwell_angle",
    "return_angle",
    "near_dwell_angle",
    "handover_angle",
)
_LOOP = ("newton_agreement", "newton_iterations", "condition_number")
_CLOSURE = ("closing_torque", "lift_off_speed")
_LAW_CHECKS = (
    "transmission-angle",
    "conditioning",
    "handover",
    "velocity-step",
    "acceleration-step",
    "jerk-step",
    *LAW_CHECKS,
)
_CAM_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance")


_EXTREMES = (
    "min_transmission_angle_at",
    *names("input_velocity", "input_acceleration", "output_velocity", "output_acceleration"),
)


_NOT_OF_MOTION = {"name", "cam", "size"}
_OF_CAMS = {"max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius"}


_OF_FINGERS = ("finger-release", "pressure-angle", "cam-undercut")


class SwingGripper(WithExtremes, WithShapedLaws, OnDiscCams):
    """A swing gripper, from its design file to every quantity that is asked for."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    keys = {
        "gripper": (
            "handover_speed",
            "handover_mismatch",
            ("total_swing", "total_swing"),
            ("min_transmission_angle", ">limits.transmission_angle"),
            "cam_center",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "min_curvature_radius",
            ("lift_off_speed", ">speed"),
            "closing_torque",
            "handover_center",
        ),
        "analyze": (
            "handover_speed",
            "handover_mismatch",
            ("total_swing", "total_swing"),
            ("min_transmission_angle", ">limits.transmission_angle"),
            "output_velocity_max",
            "output_acceleration_max",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "min_curvature_radius",
            ("lift_off_speed", ">speed"),
            "closing_torque",
            "max_radius",
        ),
        "cam": (
            "cam_center",
            ("max_pressure_angle", "<limits.pressure_angle"),
            "min_curvature_radius",
            "max_radius",
            "min_radius",
        ),
    }
    outlines = {
        "gripper": Outline((*_LAW, *_PHASES, *_LOOP), _LAW_CHECKS, ("motion",)),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*_LAW, *_PHASES, *_LOOP, *_EXTREMES), _LAW_CHECKS, ("motion",)),
    }
    extra_tables = ("finger_cam", "forces", "newton", "handover_window", "tip", LAW_TABLE)

    extreme_names = _EXTREMES
    motion_extremes: dict[str, Any] = placed("motion.extremes")
    cost = 7.0
    candidates, ways_of = checks.candidates, checks.ways_of

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

    @cached_property
    def fingers(self) -> FingerCam:
        """What opens the fingers."""

        return FingerCam(self.spec, self.motion)

    @property
    def discs(self) -> tuple[DiscCam, ...]:
        """The cams that the file gives, that of the fingers the last."""
        cams = () if self.spec.cam is None else tuple(self.cams.discs)
        return cams if self.spec.fingers is None else (*cams, self.fingers.cam)

    @property
    def finger_lift(self) -> float | None:
        """Way of the finger tips at the end of the release window [mm]; None without fingers."""
        return None if self.spec.fingers is None else self.fingers.lift

    @cached_property
    def stop(self) -> Stop:
        """Where the arm rests in the near dwell."""
        from gearlink.core.machines.swing_gripper.forces import Stop

        return Stop(self.spec, self.motion, self.cams, self.closure)

    law: SixPhaseLaw = placed("motion.law")
    linkage: GripperLinkage = placed("motion.linkage")
    shaft_speed: float = placed("motion.shaft_speed")
    angular_speed: float = placed("motion.shaft_speed")
    turn_time: float = placed("motion.turn_time")
    main_cam: DiscCam = placed("cams.main_cam")
    return_cam: DiscCam | None = placed("cams.return_cam")

    def completion(self) -> Iterator[Found]:
        """The cam's axis instead of the rule that chose it; one that no rule finds stays asked for."""
        if self.spec.size is not None and self.spec.cam is not None and self.spec.cam.center is None:
            with suppress(NoSolution):
                center = self.cam_center
                yield Found("cam.center", [center.real, center.imag], "found for size")
                yield Found("size", None)
        yield from self.solved_laws()

    @property
    def law_definitions(self) -> Mapping[str, Any]:
        """The laws of the three moving phases."""
        laws = self.spec.laws
        return {"laws.accelerate": laws.accelerate, "laws.decelerate": laws.decelerate, "laws.return": laws.return_}

    def law_at(self, path: str, /) -> Law:
        """The law of a phase."""
        found: Law = getattr(self.motion.law, {"return": "return_"}.get(phase := path.removeprefix("laws."), phase))
        return found

    def law_phase(self, path: str, /) -> Phase:
        """The phase of a law."""
        return self.motion.phase(path.removeprefix("laws."))

    # Quantities

    total_swing: float = placed("motion.law.total_swing")
    accelerate_angle: float = placed("motion.phase_angles.accelerate")
    constant_angle: float = placed("motion.phase_angles.constant")
    decelerate_angle: float = placed("motion.phase_angles.decelerate")
    far_dwell_angle: float = placed("motion.phase_angles.far_dwell")
    return_angle: float = placed("motion.phase_angles.return_")
    near_dwell_angle: float = placed("motion.phase_angles.near_dwell")
    handover_angle: float = placed("motion.handover_angle")
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
        return (
            *_LAW,
            *_PHASES,
            *_LOOP,
            *_EXTREMES,
            "cam_center",
            *_CAM,
            *_CLOSURE,
            "spring_torque",
            *_STOP,
            "finger_lift",
        )

    def varied(self, spec: SwingGripperSpec) -> SwingGripper:
        """The design of another file; law and linkage are kept where it differs in the cams alone, else the law."""
        made = type(self)(spec)
        same = all(name in _NOT_OF_MOTION or value == getattr(self.spec, name) for name, value in spec)
        made.motion = self.motion if same else self.motion.varied(spec)
        return made

    def prepare(self, quantities: Iterable[str]) -> None:
        """Seek the extremes of the cams together, where several are asked for."""
        if len({*quantities} & _OF_CAMS) > 1:
            with suppress(GearlinkError):  # it is said where the quantity is asked for
                self.cams.seek()

    def raw(self, name: str) -> Any:
        """The value of a quantity; a point as its two coordinates; None of a stop that the file has not."""
        if name in _STOP:
            return None if self.spec.stop is None else getattr(self.stop, _STOP[name])
        value = super().raw(name)
        return (value.real, value.imag) if isinstance(value, complex) else value

    # Tables and checks

    table_motion, table_newton, table_forces = motion_table, newton_table, forces_table
    table_main_cam, table_return_cam = main_cam_table, return_cam_table
    table_finger_cam = finger_cam_table
    table_handover_window, table_tip = handover_window_table, tip_table

    check_transmission_angle, check_conditioning = checks.transmission_angle, checks.conditioning
    check_velocity_step, check_acceleration_step = checks.velocity_step, checks.acceleration_step
    check_finger_release = checks.finger_release
    check_stop_settling = checks.stop_settling
    check_phase_allotment = checks.phase_allotment
    check_jerk_step, check_handover = checks.jerk_step, checks.handover
    check_pressure_angle, check_cam_undercut = checks.pressure_angle, checks.cam_undercut
    check_shaft_clearance, check_lift_off = checks.shaft_clearance, checks.lift_off

    @classmethod
    def judged(cls, command: str, spec: Any, /) -> tuple[str, ...]:
        """Those of the optional sections too: cams with their spring, fingers, a balanced law, a stop."""
        of_cams = () if spec.cam is None else (*cls.outlines["cam"].checks, "lift-off")
        if command == "cam":
            return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams)))
        of_fingers = () if spec.fingers is None else _OF_FINGERS
        of_law = () if spec.limits.return_acceleration is None else ("phase-allotment",)
        of_stop = () if spec.cam is None or spec.stop is None else ("stop-settling",)
        return tuple(dict.fromkeys((*super().judged(command, spec), *of_cams, *of_fingers, *of_law, *of_stop)))

    def outline(self, command: str) -> Outline:
        """`gripper` and `analyze` add what the optional sections of the file make possible."""
        outline, spec = self.outlines[command], self.spec
        if command == "cam":
            return self._of_cams(outline)
        if spec.fingers is not None:
            outline = outline._replace(
                quantities=(*outline.quantities, "finger_lift"), checks=(*outline.checks, *_OF_FINGERS)
            )
        if spec.limits.return_acceleration is not None:
            outline = outline._replace(checks=(*outline.checks, "phase-allotment"))
        if spec.cam is None:
            return outline
        if self.cams.is_refused:
            checks = dict.fromkeys((*outline.checks, "pressure-angle"))
            return Outline(outline.quantities, tuple(checks), outline.tables)
        cams = self._of_cams(self.outlines["cam"])
        quantities, tables = [*outline.quantities, *cams.quantities[:-2]], outline.tables
        if command == "analyze":
            quantities, tables = [*outline.quantities, *cams.quantities], (*outline.tables, *cams.tables)
        checks = dict.fromkeys((*outline.checks, *cams.checks))
        if self.closure.stands:
            quantities += _CLOSURE if spec.spring is not None and spec.spring.torque is None else ("lift_off_speed",)
            checks |= {"lift-off": None}
        if self.closure.stands and spec.stop is not None:
            quantities += (name for name in _STOP if name != "stop_force_max" or spec.stop.stiffness is not None)
            checks |= {"stop-settling": None}
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


_TURN = 2.0 * math.pi
_STEPS = 60
_GRID = 3600


# The cam that opens the fingers on the arm: coaxial with the gripper's axis, it turns with the cylinder.
#
# Seen from the arm the cam turns by Theta = eps theta - s beta, which runs one way as long as |beta'| < 1: the fingers,
# closed on the way out and open on the return stroke at the same swing, then have one angle at each angle of their cam.


class FingerCam:
    """Fingers at the tip of the arm, a roller lever on the arm, and their cam.

    Parameters
        spec : SwingGripperSpec - with fingers
        motion : Motion
    Source
        swing-gripper paper 1 lets the fingers open at the handover; the cam: own derivation
    """

    def __init__(self, spec: SwingGripperSpec, motion: Motion) -> None:
        self.spec, self.motion = spec, motion

    @property
    def section(self) -> FingerSection:
        """The section `fingers` of the design file."""
        assert self.spec.fingers is not None, "needed only where the file has it"
        return self.spec.fingers

    @cached_property
    def _laws(self) -> tuple[Law, Law]:
        found = []
        for name in ("open", "close"):
            with in_section(f"fingers.{name}.law"):
                found.append(law(getattr(self.section, name).law))
            if found[-1].kind != "rest-to-rest":
                raise NoSolution(
                    f"fingers rest before and after: {found[-1].name} is {found[-1].kind}",
                    key=f"fingers.{name}.law",
                    fix="take cycloidal or modified-sine",
                )
        return found[0], found[1]

    @property
    def _ends(self) -> tuple[float, float, float, float]:
        """Cylinder angles at which opening and closing begin and end [deg]."""
        first, last = self.section.open, self.section.close
        return first.from_, first.from_ + first.over, last.to - last.over, last.to

    def opening(self, degrees: Reals, order: int = 2) -> list[Reals]:
        """Angle eta by which the fingers are open, and its derivatives by theta [rad].

        Parameters
            degrees : (N,) array [deg] - cylinder angle, 0 to 360
        """
        start, opened, closing, closed = self._ends
        whole = math.radians(self.section.open_angle)
        found = [np.zeros_like(degrees) for _ in range(order + 1)]
        found[0][(degrees >= opened) & (degrees <= closing)] = whole
        for begin, end, one, sense in ((start, opened, self._laws[0], 1.0), (closing, closed, self._laws[1], -1.0)):
            inside = (degrees > begin) & (degrees < end)
            shape = one.evaluate((degrees[inside] - begin) / (end - begin), order)
            found[0][inside] = whole * (shape[0] if sense > 0.0 else 1.0 - shape[0])
            for n in range(1, order + 1):
                found[n][inside] = sense * whole * shape[n] / math.radians(end - begin) ** n
        return found

    @property
    def _sense(self) -> int:
        """Sense of the cylinder that takes the sheet over: against the gripper's swing."""
        return -self.spec.swing_sense

    def cam_angle(self, degrees: Reals) -> tuple[Reals, Reals, Reals]:
        """Turn of the cam seen from the arm, theta + beta in the cylinder's sense, and derivatives by theta [rad]."""
        beta, first, second = self.motion.law.evaluate(degrees, 2)
        return np.radians(degrees) + beta, 1.0 + first, second

    @cached_property
    def _grid(self) -> tuple[Reals, Reals]:
        degrees = np.linspace(0.0, 360.0, _GRID, endpoint=False)
        angle, rate, _ = self.cam_angle(degrees)
        if np.min(rate) <= 0.0:
            worst = float(degrees[int(np.argmin(rate))])
            raise NoSolution(
                f"the arm returns as fast as the cam of its fingers turns, at cylinder angle {worst:.4g} deg",
                key="fingers",
                fix="lengthen phases.return",
            )
        return np.append(degrees, 360.0), np.append(angle, _TURN)

    def cylinder_degrees(self, cam_angle: Reals) -> Reals:
        """Cylinder angle [deg] at angles of the cam seen from the arm [rad], by Newton's steps from a grid."""
        grid, angles = self._grid
        wanted = np.mod(cam_angle, _TURN)
        degrees = np.asarray(np.interp(wanted, angles, grid), dtype=np.float64)
        for _ in range(_STEPS):
            angle, rate, _ = self.cam_angle(np.minimum(degrees, np.nextafter(360.0, 0.0)))
            off = angle - wanted
            degrees = np.minimum(np.maximum(degrees - np.degrees(off / rate), 0.0), np.nextafter(360.0, 0.0))
            if np.max(np.abs(off), initial=0.0) <= 1e-14 * _TURN:
                break
        return degrees

    @cached_property
    def cam(self) -> DiscCam:
        """The cam, in the frame of the arm: E the origin, the arm along +x."""
        section = self.section
        pivot, angle = complex(section.pivot, 0.0), math.radians(section.angle)

        def path(phi: Reals, _order: int) -> RollerPath:
            degrees = self.cylinder_degrees(phi)
            eta, first, second = self.opening(degrees)
            _, rate, bend = self.cam_angle(degrees)
            speed = first / rate
            return oscillating(pivot, section.lever, angle + eta, speed, (second - speed * bend) / rate**2)

        joints = np.array(sorted({*self.motion.law.starts[:-1], *(each % 360.0 for each in self._ends)}))
        places = tuple(self.cam_angle(joints)[0].tolist())
        return DiscCam("finger cam", path, self._sense, section.roller_radius, places, "fingers")

    @property
    def release_degrees(self) -> float:
        """Cylinder angle at which the fingers must have let go [deg]: the end of the release window."""
        return self.motion.handover + (self.spec.release.window if self.spec.release is not None else 0.0)

    @cached_property
    def opened(self) -> float:
        """Angle by which the fingers are open at the end of the release window [rad]."""
        return float(self.opening(np.array([self.release_degrees]), 0)[0][0])

    @property
    def lift(self) -> float:
        """Way of the finger tips at the end of the release window [mm]."""
        return self.section.length * self.opened
