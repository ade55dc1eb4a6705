"""The motion of a swing gripper: its law, its linkage, and the loop both ways."""

from __future__ import annotations

import math
from collections.abc import Mapping
from functools import cache
from typing import TYPE_CHECKING, Any

from gearlink.core.base.design import placed
from gearlink.core.base.errors import MissingSection, NoSolution, at_key, in_section
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import unlike, within
from gearlink.core.machines.swing_gripper.law import SixPhaseLaw, SixPhases, balanced, heights, require_law
from gearlink.core.machines.swing_gripper.linkage import GripperLinkage, TwoWays, require_swing, two_ways
from gearlink.core.numerics.arrays import Reals, largest, turn_degrees
from gearlink.core.parts.cams.laws import Law, law

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.spec import SwingGripperSpec
    from gearlink.core.parts.cams.shaped import Drive, Phase

_STATED = 1e-6
_FEW = 24
_TURN, _RADIAN = 2.0 * math.pi, math.pi / 180.0
_OF_LAW = ("speed", "cylinder", "arm", "phases", "handover", "total_swing", "laws", "loads")
"""Keys of the file that the law knows."""
_OF_LINKAGE = ("links", "pivots", "output_direction", "swing_sense", "assembly", "limits")
"""Those that the linkage knows beside the law's."""


@cache
def _every_degree() -> Reals:
    """One array for all designs: a law that they share is kept for it."""
    degrees = turn_degrees()
    degrees.flags.writeable = False
    return degrees


def require(spec: SwingGripperSpec, section: str, words: str) -> Any:
    """A section of the design file that a result needs."""
    value = getattr(spec, section)
    if value is None:
        raise MissingSection(f"the command needs the section {section}: {words}", key=section)
    return value


class Timing:
    """Phases and law of a design file; designs that differ in other keys share it."""

    def __init__(self, spec: SwingGripperSpec) -> None:
        self.spec = spec

    @cached_property
    def shaft_speed(self) -> float:
        """Angular velocity of the cylinder shaft [rad/s]: one revolution a sheet."""
        return self.spec.speed / 3600.0 * 2.0 * math.pi

    @cached_property
    def phases(self) -> SixPhases:
        """Lengths of the six phases [deg]: as given, with the remainder, or sized by balance."""
        given = self.spec.phases
        lengths = given.lengths()
        if lengths is not None:
            return SixPhases(*lengths)
        fast, slow, back = (self._law_alone(phase) for phase in ("accelerate", "decelerate", "return"))
        rest = (given.constant or 0.0, given.far_dwell or 0.0, given.near_dwell or 0.0)
        found = balanced(rest, given.balance or 1.0, (fast, slow, back))
        start, end = found.accelerate, found.accelerate + found.constant
        if self.spec.handover is not None and not start <= self.spec.handover <= end:
            raise NoSolution(
                f"handover outside the constant-speed phase: {self.spec.handover:g} deg (balanced: "
                f"{within(start, end, 'deg')})",
                key="handover",
                fix="omit it for the middle of the phase",
            )
        return found

    @cached_property
    def phase_angles(self) -> SixPhases:
        """Lengths of the six phases [rad]."""
        return SixPhases(*map(math.radians, self.phases))

    @property
    def handover(self) -> float:
        """Cylinder angle of the handover [deg]."""
        given = self.spec.handover
        return self.phases.accelerate + 0.5 * self.phases.constant if given is None else given

    @cached_property
    def _drive(self) -> Drive:
        from gearlink.core.parts.cams.shaped import Drive

        return Drive.of(self.spec, rate=_TURN / 3600.0, unit="sheets/h")

    def _law_alone(self, phase: str) -> Law:
        """The law of a phase whose length is not known yet."""
        from gearlink.core.parts.cams.shaped import Phase

        known = Phase(damping=self._drive.damping, to_speed=phase != "return")
        definition = getattr(self.spec.laws, phase if phase != "return" else "return_")
        with in_section(f"laws.{phase}"):
            found = law(definition, known)
        require_law(phase, found)
        return found

    @cached_property
    def law(self) -> SixPhaseLaw:
        """The six-phase law; its constant speed is R/l_EF."""
        speed = self.spec.cylinder.radius / self.spec.arm.length
        fast, slow = (self._law_of(phase, speed) for phase in ("accelerate", "decelerate"))
        swing = math.degrees(heights(self.phases, speed, fast, slow)[-1])
        made = SixPhaseLaw(self.phases, speed, fast, slow, self._law_of("return", swing))
        self._require_swing_below_a_turn(made)
        self._require_stated_swing(made)
        return made

    def _law_of(self, phase: str, rise: float) -> Law:
        """The law of a phase.

        Parameters
            rise : float - d beta/d theta at the end of a phase that ends at speed; the swing [deg] of the return
        """
        definition = getattr(self.spec.laws, phase if phase != "return" else "return_")
        with in_section(f"laws.{phase}"):
            return (
                law(definition) if isinstance(definition, str | Mapping) else law(definition, self.phase(phase, rise))
            )

    def phase(self, name: str, rise: float | None = None) -> Phase:
        """What a law is told of its phase; `rise` as of the return in deg, else per deg of the phase."""
        to_speed = name != "return"
        length = getattr(self.phases, name if to_speed else "return_")
        whole = rise * length if to_speed and rise is not None else rise
        return self._drive.phase(math.radians(length), whole, to_speed=to_speed)

    def _require_swing_below_a_turn(self, law: SixPhaseLaw) -> None:
        swing = math.degrees(law.total_swing)
        if swing < 360.0:
            return
        raise NoSolution(
            f"swing of the arm: {unlike(swing, 360.0)} deg (limit < 360 deg; speed of the tip R/l_EF = "
            f"{law.speed:.4g})",
            key="arm.length",
            fix=(
                f"make the arm longer than {safely_above(self.spec.arm.length * swing / 360.0)} mm, the cylinder's "
                f"radius less than {safely_below(self.spec.cylinder.radius * 360.0 / swing)} mm, or the phases shorter"
            ),
        )

    def _require_stated_swing(self, law: SixPhaseLaw) -> None:
        stated, swing = self.spec.total_swing, math.degrees(law.total_swing)
        if stated is None or abs(stated - swing) <= _STATED:
            return
        short = stated - swing
        kappa = law.accelerate.kappa + short / (law.speed * self.phases.accelerate)
        free = f", or laws.accelerate to {{quintic: {kappa:.9g}}}" if 0.4 <= kappa <= 0.6 else ""
        raise NoSolution(
            f"total_swing: {unlike(stated, swing)} deg (laws, phases and R/l_EF give {unlike(swing, stated)} deg)",
            key="total_swing",
            fix=(
                f"set arm.length to {self.spec.arm.length * swing / stated:.6g}, or change phases.constant by "
                f"{short / law.speed:+.9g} deg (and another phase as much the other way){free}"
            ),
        )


def _alike(one: SwingGripperSpec, other: SwingGripperSpec, keys: tuple[str, ...]) -> bool:
    return all(getattr(one, key) == getattr(other, key) for key in keys)


class Motion:
    """Law and linkage of a design file; designs that differ in other keys share it."""

    def __init__(self, spec: SwingGripperSpec, timing: Timing | None = None) -> None:
        self.spec, self.timing = spec, timing or Timing(spec)

    def varied(self, spec: SwingGripperSpec) -> Motion:
        """The motion of another file: the same where law and linkage are, or one with the same law."""
        if not _alike(spec, self.timing.spec, _OF_LAW):
            return Motion(spec)
        return self if _alike(spec, self.spec, _OF_LINKAGE) else Motion(spec, self.timing)

    shaft_speed: float = placed("timing.shaft_speed")
    phases: SixPhases = placed("timing.phases")
    phase_angles: SixPhases = placed("timing.phase_angles")
    handover: float = placed("timing.handover")
    law: SixPhaseLaw = placed("timing.law")

    @property
    def turn_time(self) -> float:
        """Time of a revolution of the cylinder shaft [ms]."""
        return 2e3 * math.pi / self.shaft_speed

    @property
    def handover_angle(self) -> float:
        """The same [rad]."""
        return math.radians(self.handover)

    @cached_property
    def linkage(self) -> GripperLinkage:
        """The four-bar A-C-D-E driven by the law at ED."""
        with at_key("pivots"):
            require_swing(self.unchecked, math.radians(self.spec.limits.transmission_angle))
        return self.unchecked

    @cached_property
    def unchecked(self) -> GripperLinkage:
        """The same, whether it can make its swing or not."""
        spec = self.spec
        self._require_pivots_apart()
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

    def _require_pivots_apart(self) -> None:
        pivots = self.spec.pivots
        if pivots.input == pivots.output:
            raise NoSolution(
                f"pivots.input and pivots.output are one point, ({pivots.input[0]:g}, {pivots.input[1]:g}) mm, and the "
                "frame length is 0 mm: cam rocker and gripper turn about axes of their own, move one of them",
                key="pivots",
            )

    @cached_property
    def extremes(self) -> dict[str, Any]:
        """Extremes of speed and acceleration of both rockers and of the transmission angles, and their places."""
        least = [math.radians(self.law.reaches(each.place)) for each in self.linkage.least_transmission]
        return {**self.rates, "min_transmission_angle_at": least}

    @cached_property
    def rates(self) -> dict[str, float]:
        """Extremes of speed and acceleration of both rockers [rad/s, rad/s^2], and all their places [rad]."""
        from gearlink.core.numerics.motion_extremes import extremes

        joints = [start * _RADIAN for start in self.law.starts]

        def curve(link: str, order: int) -> Any:
            scale = self.shaft_speed**order
            return lambda theta: getattr(self.linkage.kept_motion(theta, 2), link)[order] * scale

        curves = {
            f"{link}_{rate}": curve(link, order)
            for link in ("input", "output")
            for order, rate in enumerate(("velocity", "acceleration"), start=1)
        }
        return extremes(curves, 0.0, _TURN, joints=joints)

    @cached_property
    def min_transmission_angle(self) -> tuple[float, float]:
        """Minimum transmission angles at D and at C over the swing [rad]."""
        at_d, at_c = self.linkage.least_transmission
        return at_d.value, at_c.value

    @cached_property
    def loop(self) -> TwoWays:
        """Closed form against Newton-Raphson at every degree of the turn."""
        return self.loop_at()[1]

    def loop_at(self, samples: int | None = None) -> tuple[Reals, TwoWays]:
        """Cylinder angles in degrees, and closed form against Newton-Raphson there."""
        degrees = turn_degrees(samples) if samples else _every_degree()
        motion = self.linkage.motion(degrees, 0)
        return degrees, two_ways(self.linkage, motion)

    @cached_property
    def newton_agreement(self) -> float:
        """Largest difference of closed form and Newton-Raphson over the revolution [rad]."""
        found: float = largest(self.loop.deviation)
        return found

    @cached_property
    def rough_agreement(self) -> float:
        """The same every 15 deg [rad], of one of many designs that are tried."""
        found: float = largest(self.loop_at(_FEW)[1].deviation)
        return found

    @cached_property
    def newton_iterations(self) -> int:
        """Most Newton-Raphson steps at a position."""
        found: int = largest(self.loop.iterations)
        return found

    @property
    def condition_number(self) -> float:
        """Largest condition number of the loop over the swing, 1/sin(mu), mu the lesser of the angles at C and D."""
        return 1.0 / math.sin(min(self.min_transmission_angle))
