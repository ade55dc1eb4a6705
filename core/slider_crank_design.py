"""The offset slider-crank as a design: crank length from stroke."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core import slider_crank
from gearlink.core.design import Design, Outline
from gearlink.core.errors import at_key

if TYPE_CHECKING:
    from gearlink.core.specs.slider_crank import SliderCrankSpec

SLIDER_QUANTITIES = ("quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke")


@dataclass(frozen=True)
class SliderCrank:
    """A slider-crank given by stroke, rod and signed offset [mm]; see `gearlink.core.slider_crank`."""

    stroke: float
    rod: float
    offset: float

    @cached_property
    def crank_length(self) -> float:
        """Crank [mm]."""
        return slider_crank.crank_length(self.stroke, self.rod, self.offset)

    @cached_property
    def quick_return_ratio(self) -> float:
        """Time of the forward over the return stroke."""
        return slider_crank.quick_return_ratio(self.crank_length, self.rod, self.offset)

    @cached_property
    def dead_center_extended(self) -> float:
        """Crank direction from the slide line, crank and rod stretched [rad]."""
        return slider_crank.dead_center_extended(self.crank_length, self.rod, self.offset)

    @cached_property
    def dead_center_folded(self) -> float:
        """Crank direction from the slide line, crank and rod folded [rad]."""
        return slider_crank.dead_center_folded(self.crank_length, self.rod, self.offset)

    @cached_property
    def max_stroke(self) -> float:
        """Largest stroke that rod and offset allow [mm]."""
        return slider_crank.max_stroke(self.rod, self.offset)


class SliderCrankDesign(Design):
    """The slider-crank of a design file."""

    kind = "slider-crank"
    spec: SliderCrankSpec
    outlines = {
        "crank": Outline(("crank_length", *SLIDER_QUANTITIES)),
        "analyze": Outline(("crank_length", *SLIDER_QUANTITIES)),
    }

    @cached_property
    def slider_crank(self) -> SliderCrank:
        """The kernel's view of the spec."""
        return SliderCrank(self.spec.stroke, self.spec.rod, self.spec.offset)

    def raw(self, name: str) -> Any:
        """Every quantity is the slider-crank's."""
        with at_key("stroke"):
            return getattr(self.slider_crank, name)
