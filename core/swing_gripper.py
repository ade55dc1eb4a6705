"""The swing gripper as a design: law, linkage, handover, cams, force closure."""

from __future__ import annotations

import math
from collections.abc import Iterator
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline
from gearlink.core.errors import MissingSection, at_key
from gearlink.core.gripper_cams import GripperCams
from gearlink.core.report import Check, Status, Table, below

if TYPE_CHECKING:
    from gearlink.core.gripper_linkage import GripperLinkage, GripperMotion
    from gearlink.core.six_phase_law import SixPhaseLaw
    from gearlink.core.specs.swing_gripper import SwingGripperSpec

_CAM = ("max_pressure_angle", "min_curvature_radius", "max_radius", "min_radius")
_LAW = ("handover_speed", "handover_mismatch", "total_swing", "min_transmission_angle")
_LAW_CHECKS = ("transmission-angle", "handover", "velocity-step", "acceleration-step")
_CAM_CHECKS = ("pressure-angle", "cam-undercut")


class SwingGripper(GripperCams, Design):
    """A swing gripper, from its design file to every quantity that is asked for."""

    kind = "swing-gripper"
    spec: SwingGripperSpec
    outlines = {
        "gripper": Outline(_LAW, _LAW_CHECKS, ("motion",)),
        "cam": Outline(_CAM, _CAM_CHECKS, ("main_cam", "return_cam")),
        "analyze": Outline(_LAW, _LAW_CHECKS, ("motion",)),
    }
    extra_tables = ("forces", "newton", "handover_window")

    def outline(self, command: str) -> Outline:
        """`gripper` and `analyze` add what the optional sections of the file make possible."""
        outline = self.outlines[command]
        spec = self.spec
        if command == "cam":
            return outline if spec.cam is None or spec.cam.return_roller else Outline(_CAM, _CAM_CHECKS, ("main_cam",))
        quantities, checks, tables = list(outline.quantities), list(outline.checks), list(outline.tables)
        if spec.cam is not None:
            quantities += ["max_pressure_angle", "min_curvature_radius"]
            checks += _CAM_CHECKS
            if command == "analyze":
                quantities += ["max_radius", "min_radius"]
                tables += self.outline("cam").tables
            if spec.inertia is not None and spec.spring is not None:
                quantities.append("lift_off_speed")
                checks.append("lift-off")
        return Outline(tuple(quantities), tuple(checks), tuple(tables))

    def quantity_names(self) -> tuple[str, ...]:
        """Every quantity, those that need an optional section included: asking for one says what is missing."""
        return (
            *_LAW,
            *_CAM,
            "lift_off_speed",
            "newton_iterations",
            "newton_agreement",
            "condition_number",
            "spring_torque",
        )

    # Law and linkage

    @cached_property
    def shaft_speed(self) -> float:
        """Angular velocity of the cylinder shaft [rad/s]: one turn a sheet."""
        return self.spec.speed / 3600.0 * 2.0 * math.pi

    @cached_property
    def law(self) -> SixPhaseLaw:
        """The six-phase law; its constant speed is R/l_EF."""
        from gearlink.core.motion_laws import law
        from gearlink.core.six_phase_law import SixPhaseLaw

        spec, laws = self.spec, []
        for key in ("accelerate", "decelerate", "return"):
            with at_key(f"laws.{key}"):
                laws.append(law(getattr(spec.laws, key if key != "return" else "return_")))
        return SixPhaseLaw(spec.phases.lengths(), spec.cylinder.radius / spec.arm.length, *laws)

    @cached_property
    def linkage(self) -> GripperLinkage:
        """The four-bar A-C-D-E driven by the law at ED."""
        from gearlink.core.gripper_linkage import GripperLinkage

        spec = self.spec
        return GripperLinkage(
            law=self.law,
            input_pivot=complex(*spec.pivots.input),
            output_pivot=complex(*spec.pivots.output),
            input=spec.links.input,
            coupler=spec.links.coupler,
            output=spec.links.output,
            output_direction=math.radians(spec.output_direction),
            swing_sense=spec.swing_sense,
            assembly=spec.assembly,
        )

    @cached_property
    def total_swing(self) -> float:
        """Swing of the gripper arm from the bite to the far dwell [rad]."""
        return self.law.total_swing

    @cached_property
    def min_transmission_angle(self) -> tuple[float, float]:
        """Least transmission angles at D and at C over the swing [rad]."""
        return self.linkage.min_transmission_angles

    @cached_property
    def handover_speed(self) -> float:
        """Speed of the gripper tip at the handover [mm/s]."""
        import numpy as np

        rate = float(self.law.evaluate(np.array([self.spec.handover]), 1)[1][0])
        return self.spec.arm.length * rate * self.shaft_speed

    @cached_property
    def handover_mismatch(self) -> float:
        """Speed of the tip less that of the cylinder's surface [mm/s]."""
        return self.handover_speed - self.spec.cylinder.radius * self.shaft_speed

    @cached_property
    def rows(self) -> tuple[Any, GripperMotion]:
        """Cylinder angles in degrees and the motion there, for the tables."""
        import numpy as np

        count = self.samples or 360
        degrees = np.arange(count) * (360.0 / count)
        return degrees, self.linkage.motion(degrees, 2)

    def table_motion(self) -> Table:
        """Angles, velocities and accelerations of both rockers over the turn."""
        import numpy as np

        degrees, motion = self.rows
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
        data, units = zip(*columns.values(), strict=True)
        return Table("motion", tuple(columns), units, data)

    # Checks of law and linkage

    def check_transmission_angle(self) -> Iterator[Check]:
        """GL303 at D and at C."""
        limit = self.spec.limits.transmission_angle
        for place, angle in zip(
            ("D (coupler, output)", "C (input, coupler)"), self.min_transmission_angle, strict=True
        ):
            remedy = "move the pivot E or change the links so that the swing centres on a right angle there"
            subject = f"the least transmission angle at {place}"
            yield below("GL303", "transmission-angle", math.degrees(angle), limit, limit + 5.0, "deg", subject, remedy)

    def check_handover(self) -> Check:
        """GL503: equal speeds, and the tip on the line of centres, at the handover."""
        mismatch, speed = self.handover_mismatch, self.spec.cylinder.radius * self.shaft_speed
        share, limit = abs(mismatch) / speed, 1e-9
        status: Status = "fail" if share > limit else "pass"
        text = f"gripper and cylinder run at {speed:.6g} mm/s at the handover, mismatch {mismatch:.2g} mm/s"
        if status == "fail":
            text += ": set handover within the constant phase"
        return Check("GL503", "handover", status, text, share, limit)

    def check_velocity_step(self) -> Check:
        """GL403 at the six joints of the law."""
        return self._steps("GL403", "velocity-step", 1, "fail")

    def check_acceleration_step(self) -> Check:
        """GL404 at the six joints of the law."""
        return self._steps("GL404", "acceleration-step", 2, "warn")

    def _steps(self, code: str, name: str, order: int, bad: Status) -> Check:
        import numpy as np

        from gearlink.core.cam_checks import step_check
        from gearlink.core.six_phase_law import PHASES

        jumps = self.law.joints()[:, order]
        peak = float(np.abs(self.law.evaluate(np.arange(0.0, 360.0, 0.5), order)[order]).max())
        steps = [(f"start of {phase}", float(jump)) for phase, jump in zip(PHASES, jumps, strict=True)]
        unit = "rad/rad" if order == 1 else "rad/rad^2"
        return step_check(code, name, steps, peak, unit, bad, "take laws without end acceleration in laws")

    def _require(self, section: str, words: str) -> Any:
        value = getattr(self.spec, section)
        if value is None:
            raise MissingSection(f"this needs the section {section}: {words}", key=section)
        return value
