"""Quantities of a slider-crank that machines with one have."""

from __future__ import annotations

from gearlink.core.base.design import placed

SLIDER_QUANTITIES = ("quick_return_ratio", "dead_center_extended", "dead_center_folded", "max_stroke")


class SliderCrankQuantities:
    """Quantities of a design that has a `slider_crank`."""

    crank_length: float = placed("slider_crank.crank_length")
    quick_return_ratio: float = placed("slider_crank.quick_return_ratio")
    dead_center_extended: float = placed("slider_crank.dead_center_extended")
    dead_center_folded: float = placed("slider_crank.dead_center_folded")
    max_stroke: float = placed("slider_crank.max_stroke")
