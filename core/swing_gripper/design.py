"""The swing gripper as a design: its parts, and what each command shows of it."""

from __future__ import annotations

from collections.abc import Iterable, Iterator
from contextlib import suppress
from typing import TYPE_CHECKING, Any

from gearlink.core.cams.machine import OnDiscCams
from gearlink.core.design import Found, Outline, placed
from gearlink.core.errors import GearlinkError, NoSolution
from gearlink.core.motion_extremes import WithExtremes, names
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper import checks, remedies, tables
from gearlink.core.swing_gripper.cams import GripperCams
from gearlink.core.swing_gripper.closure import Closure
from gearlink.core.swing_gripper.handover import Handover
from gearlink.core.swing_gripper.motion import Motion

if TYPE_CHECKING:
    from gearlink.core.cams.disc_cam import DiscCam
    from gearlink.core.swing_gripper.law import SixPhaseLaw
    from gearlink.core.swing_gripper.linkage import GripperLinkage
    from gearlink.core.swing_gripper.spec import SwingGripperSpec

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
