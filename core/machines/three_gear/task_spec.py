"""Sections of a three-gear four-bar that few of its files have: what the other syntheses are asked for, shafts."""

from typing import Annotated, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Length, SignedLength, Spec, only_one, refused, unit
from gearlink.core.machines.three_gear.dwell_spec import Placing


class BackStep(Placing):
    """Specification for `synth back-step`."""

    angle: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(None, description="back-step of the output")
    crank_angle: Annotated[float, unit("deg", ge=0, lt=180)] | None = Field(
        None, description="crank angle phi12 of the back-step"
    )

    @model_validator(mode="after")
    def _something(self) -> Self:
        if self.angle is None and self.crank_angle is None:
            raise refused("give angle, crank_angle or both", "angle", "GL106")
        return self


class Speed(Placing):
    """Specification for `synth variable-speed`; the input turns at the mean of the two."""

    min: Annotated[float, unit("1/min")] | None = Field(None, description="minimum output speed")
    max: Annotated[float, unit("1/min", gt=0)] | None = Field(None, description="maximum output speed")
    uniform_angle: Annotated[float, unit("deg", gt=0, lt=360)] | None = Field(
        None, description="instead of min and max: crank angle over which the output runs at nearly uniform speed"
    )
    uniform_tolerance: Annotated[float, unit("1", gt=0, lt=1)] | None = Field(
        None, description="permitted relative deviation of that speed from its level"
    )

    @model_validator(mode="after")
    def _one_wish(self) -> Self:
        band = [name for name in ("min", "max") if getattr(self, name) is not None]
        even = [name for name in ("uniform_angle", "uniform_tolerance") if getattr(self, name) is not None]
        if band and even:
            message = "uniform_angle and uniform_tolerance replace min and max\nomit min and max, or the other two"
            raise refused(message, even[0])
        pair = ("uniform_angle", "uniform_tolerance") if even else ("min", "max")
        missing = [name for name in pair if getattr(self, name) is None]
        if missing:
            raise refused(f"{missing[0]} is missing", missing[0], "GL106")
        return self


class Momentary(Spec):
    """Specification for `synth momentary-dwell`: one of the four."""

    eccentricity: Length | None = Field(None, description="crank length e; the frame is found")
    frame: Length | None = Field(None, description="frame AD, instead of eccentricity; the crank is found")
    gap: SignedLength | None = Field(
        None, description="gap between the tips of gears 1 and 5 at the closest, instead of eccentricity"
    )
    balanced: Literal[True] | None = Field(
        None,
        description="true, instead of eccentricity: equal deviation of the transmission angle from 90 deg at both ends",
    )

    @model_validator(mode="after")
    def _one_length(self) -> Self:
        needed = "give eccentricity, frame, gap or balanced"
        only_one(self, "eccentricity", "frame", "gap", "balanced", needed=needed)
        return self


class Shafts(Spec):
    """Shafts that pass through the plane of the gears."""

    input_radius: Length | None = Field(None, description="radius of the input shaft at A")
    output_radius: Length | None = Field(None, description="radius of the output shaft at D")
