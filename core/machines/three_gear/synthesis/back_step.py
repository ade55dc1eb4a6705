"""`synth back-step`: links from the back-step of the output, the crank angle that it takes, or both."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from functools import cache
from typing import TYPE_CHECKING

from gearlink.core.base.design import Outline
from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.report import Check
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.dwell import dwells
from gearlink.core.machines.three_gear.dwell_checks import target_judged
from gearlink.core.machines.three_gear.idler_choice import idler_for_ratio
from gearlink.core.machines.three_gear.motion import GearTrain
from gearlink.core.machines.three_gear.names import CHECKS, QUANTITIES
from gearlink.core.machines.three_gear.symmetric import back_step as symmetric_back_step
from gearlink.core.machines.three_gear.symmetric import family
from gearlink.core.machines.three_gear.synthesis.base import SymmetricSynthesis, with_analysis
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.parts.linkages.standstills import BackStep

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families.external import Family


class BackStepFamily(SymmetricSynthesis):
    """Syntheses that fix the crank angle phi12 of the back-step."""

    def crank_angle_for(self, i3: float) -> float:
        """phi12 [rad] that meets the task with a ratio i3."""
        raise NotImplementedError

    @cached_property
    def crank_angle_at(self) -> Callable[[float], float]:
        """`crank_angle_for`, solved once for each i3."""
        return cache(self.crank_angle_for)

    def frame_ratio_for(self, i3: float) -> float:
        """Thesis (4-18)."""
        return family.frame_ratio_for_back_step(i3, self.crank_angle_at(i3))

    @property
    def _phi12(self) -> float:
        return self.crank_angle_at(self.i3)

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """270 deg -+ phi12/2 (thesis (4-15)), or its mirror image."""
        if self.general:
            return dwells.dwell_positions(self.linkage, self.train)
        if self._phi12 == 0.0:
            return [self._middle]
        return [self._middle - 0.5 * self._phi12, self._middle + 0.5 * self._phi12]

    @cached_property
    def back_step(self) -> BackStep | None:
        """In closed form (thesis (4-15), (4-19)) for the symmetric family."""
        if self.general:
            return dwells.back_step(self.linkage, self.train) if self.motion == "back-step" else None
        if self._phi12 == 0.0:
            return None
        angle = symmetric_back_step.back_step_angle(self.i3, self._phi12)
        start, end = self.dwell_crank_angles
        return BackStep(start, end, self._phi12, angle)

    @cached_property
    def dwell_angle(self) -> float | None:
        """phi13 from its own equation."""
        if self.general and self.back_step is not None:
            return dwells.dwell_angle(self.linkage, self.train, self.back_step)
        return None if self.back_step is None else symmetric_back_step.dwell_angle(self.i3, self._phi12)


class BackStepSynthesis(BackStepFamily):
    """`synth back-step`: back-step of the output, crank angle phi12, or both are given."""

    task = "back_step"
    outlines = with_analysis("synth back-step", Outline(QUANTITIES, ("back-step-target", *CHECKS)))

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """One of back-step and crank angle, met by the root of the one unknown."""
        from gearlink.core.machines.three_gear.families.external import back_step_crank_angle_of, back_step_of, solved

        task = section_of(self.spec, "back_step", "angle or crank_angle (deg)")
        if task.angle is not None and task.crank_angle is not None:
            raise NoSolution(
                "with crank, frame or balanced one of angle and crank_angle can be met: leave the other out",
                key="back_step.crank_angle",
            )
        if task.angle is not None:
            with at_key("back_step.angle"):
                request = f"a back-step of {task.angle:g} deg"
                return solved(family, back_step_of(train), math.radians(task.angle), request)
        with at_key("back_step.crank_angle"):
            request = f"a back-step over {task.crank_angle:g} deg of the crank"
            return solved(family, back_step_crank_angle_of(train), math.radians(task.crank_angle), request)

    def chosen_idler(self) -> int:
        """From angle and crank angle by thesis (4-19), rounded to teeth; else the smallest that keeps the limits."""
        task = section_of(self.spec, "back_step", "angle, crank_angle (deg)")
        if self.general or task.angle is None or task.crank_angle is None:
            return super().chosen_idler()
        if task.crank_angle == 0.0:
            words = "the output does not step back over a crank angle of 0: leave crank_angle out, or give one above 0"
            raise NoSolution(words, key="back_step.crank_angle")
        with at_key("back_step.angle"):
            i3 = symmetric_back_step.i3_for_back_step(math.radians(task.angle), math.radians(task.crank_angle))
        with at_key("gears.idler"):
            return idler_for_ratio(i3, self.spec.gears.output)

    def crank_angle_for(self, i3: float) -> float:
        """phi12 as given, or from the back-step."""
        task = section_of(self.spec, "back_step", "angle, crank_angle (deg)")
        if task.crank_angle is not None:
            return math.radians(task.crank_angle)
        with at_key("back_step.angle"):
            return symmetric_back_step.crank_angle_for_back_step(i3, math.radians(task.angle))

    def check_back_step_target(self) -> Iterator[Check]:
        """GL304 where the file asks for a back-step besides the crank angle."""
        asked = section_of(self.spec, "back_step", "angle, crank_angle (deg)").angle
        if asked is None:
            return
        got = math.degrees(self.back_step_angle or 0.0)
        text = f"the back-step is {got:.6g} deg, {asked:g} deg were asked for"
        yield target_judged(got, asked).check(text, ": leave idler or crank_angle out, so that it can be chosen to fit")
