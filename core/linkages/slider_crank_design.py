"""The offset slider-crank as a design: crank length from stroke."""

from __future__ import annotations

from functools import cached_property
from typing import TYPE_CHECKING, Any

from gearlink.core.design import Design, Outline
from gearlink.core.errors import at_key
from gearlink.core.linkages.slider_crank import SliderCrank

if TYPE_CHECKING:
    from gearlink.core.linkages.slider_crank_spec import SliderCrankSpec

SLIDER_QUANTITIES = ("quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke")


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
        with at_key("stroke"):
            return SliderCrank(self.spec.stroke, self.spec.rod, self.spec.offset)

    def raw(self, name: str) -> Any:
        """Every quantity is the slider-crank's."""
        return getattr(self.slider_crank, name)
