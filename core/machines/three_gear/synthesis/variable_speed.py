"""`synth variable-speed`: links from the least and the greatest speed of the output."""

from __future__ import annotations

from collections.abc import Iterator
from typing import TYPE_CHECKING

from gearlink.core.base.design import Found, Outline
from gearlink.core.base.errors import NoSolution, at_key, section_of
from gearlink.core.base.real_speed import other_speed
from gearlink.core.base.results import cached_property
from gearlink.core.machines.three_gear.dwell import dwells
from gearlink.core.machines.three_gear.motion import GearTrain
from gearlink.core.machines.three_gear.names import CHECKS, QUANTITIES
from gearlink.core.machines.three_gear.symmetric import family
from gearlink.core.machines.three_gear.synthesis.base import SymmetricSynthesis, with_analysis
from gearlink.core.parts.linkages.fourbar.position import FourBar

if TYPE_CHECKING:
    from gearlink.core.machines.three_gear.families.external import Family


class VariableSpeedSynthesis(SymmetricSynthesis):
    """`synth variable-speed`: the output speed swings between two values, the input turns at their mean."""

    task = "speed"
    outlines = with_analysis("synth variable-speed", Outline(QUANTITIES, CHECKS))

    def in_family(self, family: Family, train: GearTrain) -> FourBar:
        """W_min/W_max = min/max, met by the root of the one unknown."""
        from gearlink.core.machines.three_gear.families.external import with_speed_quotient

        speed = section_of(self.spec, "speed", "min, max (rev/min)")
        with at_key("speed.max" if speed.max <= speed.min else "speed.min"):
            if speed.max <= speed.min:
                raise NoSolution(f"max ({speed.max:g}) must be greater than min ({speed.min:g})")
            return with_speed_quotient(family, train, speed.min / speed.max)

    @property
    def input_speed(self) -> float:
        """Input speed [1/min] at which the output swings between the two: their mean where I = 1."""
        speed = section_of(self.spec, "speed", "min, max (rev/min)")
        greatest = self.speed_ratio_max if self.mean_ratio > 0.0 else -self.speed_ratio_min
        found = float(speed.max) / greatest if self.general else 0.5 * (speed.min + speed.max)
        if wrong := other_speed(self.spec.input_speed, found):
            raise NoSolution(wrong, key="input_speed")
        return found

    def frame_ratio_for(self, i3: float) -> float:
        """Thesis (4-20)."""
        speed = section_of(self.spec, "speed", "min, max (rev/min)")
        with at_key("speed.max" if speed.max <= speed.min else "speed.min"):
            return family.frame_ratio_for_speed_band(i3, speed.min, speed.max)

    def completion(self) -> Iterator[Found]:
        """The input speed besides the links."""
        yield from super().completion()
        yield Found("input_speed", self.input_speed, "found by synth variable-speed")

    def depends_on_idler(self, _refusal: NoSolution) -> bool:
        """A wrong band is wrong with every idler."""
        return False

    @cached_property
    def dwell_crank_angles(self) -> list[float]:
        """None, or the one at 270 deg where the least speed is zero."""
        if self.general:
            return dwells.dwell_positions(self.linkage, self.train)
        self.linkage  # noqa: B018 - a band without a mechanism is refused here as well
        return [self._middle] if section_of(self.spec, "speed", "min, max").min == 0.0 else []
