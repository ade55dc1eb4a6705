"""The design file of a slider-crank."""

from __future__ import annotations

from typing import Literal

from pydantic import Field

from gearlink.core.specs.common import DesignSpec, Length, SignedLength


class SliderCrankSpec(DesignSpec):
    """An offset slider-crank given by its stroke."""

    kind: Literal["slider-crank"]
    stroke: Length = Field(description="stroke of the slider")
    rod: Length = Field(description="connecting rod")
    offset: SignedLength = Field(0.0, description="offset of the slide line from the crank's axis")

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("crank",)
