"""The offset slider-crank as a design: crank length from stroke."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.design import Design, Outline, placed
from gearlink.core.errors import at_key
from gearlink.core.linkages.slider_crank import SliderCrank
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.linkages.slider_crank_spec import SliderCrankSpec

SLIDER_QUANTITIES = ("quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke")


class SliderCrankQuantities:
    """Quantities of a design that has a `slider_crank`."""

    crank_length: float = placed("slider_crank.crank_length")
    quick_return_ratio: float = placed("slider_crank.quick_return_ratio")
    dead_center_extended: float = placed("slider_crank.dead_center_extended")
    dead_center_folded: float = placed("slider_crank.dead_center_folded")
    max_stroke: float = placed("slider_crank.max_stroke")


class SliderCrankDesign(SliderCrankQuantities, Design):
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
