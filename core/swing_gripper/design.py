"""The swing gripper as a design: law, linkage, both ways of its loop; handover, cams and force closure are mixed in."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline, placed
from gearlink.core.errors import NoSolution
from gearlink.core.linkages.checks import transmission_check
from gearlink.core.report import Check, Report, Status, Table
from gearlink.core.results import cached_property
from gearlink.core.swing_gripper.closure import GripperClosure
from gearlink.core.swing_gripper.handover import GripperHandover

if TYPE_CHECKING:
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.swing_gripper.loop import TwoWays
    from gearlink.core.swing_gripper.spec import SwingGripperSpec

_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_LAW = ("handover_speed", "handover_mismatch", "handover_center", "total_swing", "min_transmission_angle")
_LOOP = ("newton_agreement", "newton_iterations", "condition_number")
_CLOSURE = ("closing_torque", "lift_off_speed")
_LAW_CHECKS = ("transmission-angle", "conditioning", "handover", "velocity-step", "acceleration-step", "jerk-step")
_CAM_CHECKS = ("pressure-angle", "cam-undercut", "shaft-clearance")
# Closed form and Newton-Raphson each lose 8 eps times the condition number.
_AGREEMENT = 64.0 * 2.0**-52


class SwingGripper(GripperHandover, GripperClosure, Design):
    """A swing gripper, from its design file to every quantity that is asked for."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    outlines = {
        "gripper": Outline((*_LAW, *_LOOP), _LAW_CHECKS, ("motion",)),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline((*_LAW, *_LOOP), _LAW_CHECKS, ("motion",)),
    }
    extra_tables = ("forces", "newton", "handover_window")

    def outline(self, command: str) -> Outline:
        """`gripper` and `analyze` add what the optional sections of the file make possible."""
        outline, spec = self.outlines[command], self.spec
        chosen = ("cam_center",) if spec.cam is not None and spec.cam.center is None else ()
        if command == "cam":
            shown = outline.tables if spec.cam is None or spec.cam.return_roller else ("main_cam",)
            return Outline((*chosen, *_CAM), _CAM_CHECKS, shown)
        quantities, checks, tables = list(outline.quantities), list(outline.checks), list(outline.tables)
        if spec.cam is not None:
            quantities += [*chosen, "max_pressure_angle", "min_curvature_radius"]
            checks += _CAM_CHECKS
            if command == "analyze":
                quantities += ["max_radius", "min_radius"]
                tables += self.outline("cam").tables
            if spec.inertia is not None and spec.spring is not None:
                quantities += _CLOSURE if spec.spring.torque is None else ("lift_off_speed",)
                checks.append("lift-off")
        return Outline(tuple(quantities), tuple(checks), tuple(tables))

    @classmethod
    def quantity_names(cls) -> tuple[str, ...]:
        """Every quantity, those that need an optional section included: asking for one says what is missing."""
        return (*_LAW, *_LOOP, "cam_center", *_CAM, *_CLOSURE, "spring_torque")

    def raw(self, name: str) -> Any:
        """The value of a quantity; a point as its two coordinates."""
        value = super().raw(name)
        return (value.real, value.imag) if isinstance(value, complex) else value

    def report(self, command: str, **asked: Any) -> Report:
        """The report of a command; where a cam cannot be, the refusal says where it can."""
        try:
            return super().report(command, **asked)
        except NoSolution as error:
            if error.key:
                raise
            limit = self.spec.limits.pressure_angle
            message = f"{error.message}; for {limit:g} deg: {self._center_remedy(limit)}"
            raise NoSolution(message, key="cam.center") from error

    # Law and linkage

    total_swing: float = placed("law.total_swing")

    @cached_property
    def min_transmission_angle(self) -> tuple[float, float]:
        """Least transmission angles at D and at C over the swing [rad]."""
        at_d, at_c = self.linkage.least_transmission
        return at_d.value, at_c.value

    def table_motion(self, samples: int | None = None) -> Table:
        """Angles, velocities and accelerations of both rockers over the turn."""
        import numpy as np

        degrees, motion = self.rows(samples)
        speed, square = self.shaft_speed, self.shaft_speed**2
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
        }
        return Table.of("motion", columns)

    # The loop both ways

    @cached_property
    def loop(self) -> TwoWays:
        """Closed form against Newton-Raphson at every degree of the turn."""
        return self._loop_at()[1]

    def _loop_at(self, samples: int | None = None) -> tuple[Reals, TwoWays]:
        from gearlink.core.swing_gripper.loop import two_ways

        degrees, motion = self.rows(samples)
        return degrees, two_ways(self.linkage, motion)

    @property
    def newton_agreement(self) -> float:
        """Largest difference of closed form and Newton-Raphson over the turn [rad]."""
        return float(self.loop.deviation.max())

    @property
    def newton_iterations(self) -> int:
        """Most Newton-Raphson steps at a position."""
        return int(self.loop.iterations.max())

    @property
    def condition_number(self) -> float:
        """Largest condition number of the loop over the swing, 1/sin(mu), mu the lesser of the angles at C and D."""
        return 1.0 / math.sin(min(self.min_transmission_angle))

    def table_newton(self, samples: int | None = None) -> Table:
        """Both ways side by side: deviation of the angles, steps, opening of the loop, error of the closed form."""
        import numpy as np

        degrees, loop = self._loop_at(samples and int(samples))  # never in parts: the steps are those of the whole turn
        columns = {
            "theta": (degrees, "deg"),
            "deviation": (np.degrees(loop.deviation), "deg"),
            "iterations": (loop.iterations, "1"),
            "residual": (loop.residual, "mm"),
            "error": (np.degrees(loop.error), "deg"),
        }
        return Table.of("newton", columns)

    # Checks of law and linkage

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303 at D and at C."""
        from gearlink.core.swing_gripper.swing import turn_remedy

        limit = self.spec.limits.transmission_angle
        for place, angle in zip(
            ("D (coupler, output)", "C (input, coupler)"), self.min_transmission_angle, strict=True
        ):
            aim = limit if math.degrees(angle) < limit else limit + 5.0
            remedy = turn_remedy(self.linkage, math.radians(aim)) if math.degrees(angle) < limit + 5.0 else ""
            subject = f"the least transmission angle at {place}"
            yield transmission_check(angle, limit, remedy, subject)

    def check_conditioning(self) -> Check:
        """GL312: digits that the loop keeps near a dead point, and the agreement of the two ways."""
        from gearlink.core.swing_gripper.swing import turn_remedy

        number, limit, agreement = self.condition_number, self.spec.limits.condition_number, self.newton_agreement
        at_d, at_c = self.min_transmission_angle
        loss = 8.0 * 2.0**-52 / math.sin(at_c)
        status: Status = "warn" if number > limit else "pass"
        text = f"closed form and Newton-Raphson agree within {agreement:.2g} rad at condition number {number:.4g}"
        if status == "warn":
            loose, length = ("cam rocker", self.linkage.input) if at_c < at_d else ("gripper", self.linkage.output)
            text += (
                f", above the limit {limit:g}: computed angles keep {loss:.1g} rad, accelerations "
                f"{4.0 * loss / math.sin(at_c):.1g} of their size, and 0.01 mm of play turns the {loose} by "
                f"{math.degrees(0.01 * number / length):.2g} deg; "
                f"{turn_remedy(self.linkage, math.radians(self.spec.limits.transmission_angle))}"
            )
        elif self.linkage.four_bar.kind() == "change-point":
            status = "warn"
            text += (
                "; shortest and longest link add up to the other two, so in line with the frame the assembly is not "
                f"determined: the swing keeps {math.degrees(min(self.min_transmission_angle)):.4g} deg from there"
            )
        if agreement > _AGREEMENT * number:
            status = "fail"
            text += ": they should agree better; report the design file"
        return Check("GL312", "conditioning", status, text, number, limit)

    def check_velocity_step(self) -> Check:
        """GL403 at the six joints of the law."""
        return self._steps("GL403", "velocity-step", 1, "fail")

    def check_acceleration_step(self) -> Iterator[Check]:
        """GL404 at the six joints of the law, and within a law."""
        yield self._steps("GL404", "acceleration-step", 2, "warn")
        for phase in self.law.inner_steps:
            text = f"the acceleration jumps within phase {phase}: take a law like modified-sine in laws.{phase}"
            yield Check("GL404", "acceleration-step", "warn", text)

    def _steps(self, code: str, name: str, order: int, bad: Status) -> Check:
        import numpy as np

        from gearlink.core.cams.checks import step_check

        peak = float(np.abs(self.law.evaluate(np.arange(0.0, 360.0, 0.5), order)[order]).max())
        unit = "rad/rad" if order == 1 else "rad/rad^2"
        return step_check(code, name, self._jumps(order), peak, unit, bad, "take laws without end acceleration in laws")

    def _jumps(self, order: int) -> list[tuple[str, float]]:
        from gearlink.core.swing_gripper.law import PHASES

        jumps = self.law.joints()[:, order]
        return [(f"start of {phase}", float(jump)) for phase, jump in zip(PHASES, jumps, strict=True)]

    def check_jerk_step(self) -> Check:
        """GL407: the largest jump of the third derivative at a joint; a limit only where the file gives one."""
        limit = self.spec.limits.jerk_step
        where, jump = max(self._jumps(3), key=lambda item: abs(item[1]))
        text = f"the swing's jerk jumps by {jump:+.4g} rad/rad^3 at the {where}"
        status: Status = "warn" if limit is not None and abs(jump) > limit else "pass"
        if status == "warn":
            text += (
                f", above limits.jerk_step {limit:g}: polynomial-4567, velocity-4567 and {{septic: 0.5}} end without"
            )
        return Check("GL407", "jerk-step", status, text, abs(jump), limit)
