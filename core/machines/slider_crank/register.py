"""What the errors of a slider-crank move."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.links import FRAME
from gearlink.core.studies.register.movable import Movable

if TYPE_CHECKING:
    from gearlink.core.machines.slider_crank.design import SliderCrankDesign
    from gearlink.core.mechanism.links import Mechanism


def errors(design: SliderCrankDesign, mechanism: Mechanism) -> Movable:
    """Crank or stroke, rod and offset."""
    part = design.slider_crank
    ends = {"crank": ("crank", part.crank_length), "rod": ("rod", part.rod)}
    sizes = longer(mechanism, ends) | {"offset": (Shift(FRAME, ("guide",), -1.0),)}
    sizes["stroke"] = tuple(shift.scaled(part.crank_per_stroke) for shift in sizes["crank"])
    return Movable(sizes)
