"""What `synth dwell` is asked for, and what fixes crank and frame besides."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Length, Spec, only_one, refused, unit
from gearlink.core.parts.linkages.dwell_band_spec import DwellBand


class Placing(Spec):
    """What fixes crank and frame of unequal gears besides the task, which fixes only one of them."""

    crank: Length | None = Field(None, description="crank AB, for gears of any size; the frame is found")
    frame: Length | None = Field(None, description="frame AD, instead of crank; the crank is found")
    balanced: Literal[True] | None = Field(
        None, description="true, instead of crank: equal deviation of the transmission angle from 90 deg at both ends"
    )

    @model_validator(mode="after")
    def _one_placing(self) -> Self:
        only_one(self, "crank", "frame", "balanced")
        return self


class Dwell(DwellBand, Placing):
    """Specification for `synth dwell`: crank angle until the output is back (angle) or within a tolerance (window)."""

    angle: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None,
        description="crank angle phi13 from the start of the back-step until the output is back at its starting "
        "position",
    )

    @model_validator(mode="after")
    def _one_request(self) -> Self:
        if self.angle is None and self.window is None and self.tolerance is None:
            raise refused("give angle, window or tolerance", "angle", "GL106")
        if self.angle is not None and (self.window is not None or self.tolerance is not None):
            message = "angle excludes window and tolerance: it defines the dwell differently"
            raise refused(message, "window" if self.window is not None else "tolerance")
        if self.margin is not None and (self.window is not None or self.tolerance is None):
            message = "margin applies only with tolerance alone\nomit it"
            raise refused(message, "margin")
        return self
