"""The design file of a slider-crank."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.base.errors import at_key
from gearlink.core.base.spec import (
    AcuteAngle,
    Deferred,
    DrivenSpec,
    Length,
    LoadLimits,
    SignedLength,
    require_offset_below_rod,
)
from gearlink.core.parts.linkages.slider_crank.position import SliderCrank


class SliderLimits(LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="least transmission angle, 90 deg less the rod's lean")


class SliderCrankSpec(DrivenSpec):
    """An offset slider-crank given by its stroke or its crank."""

    kind: Literal["slider-crank"]
    stroke: Length | None = Field(None, description="stroke of the slider")
    crank: Length | None = Field(None, description="crank, in place of stroke")
    rod: Length = Field(description="connecting rod")
    offset: SignedLength = Field(0.0, description="offset of the slide line from the crank's axis")
    limits: SliderLimits = SliderLimits.model_construct()

    loads: Annotated[Any, Deferred("machines.slider_crank.loads_spec:SliderCrankLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _one_size(self) -> SliderCrankSpec:
        if (self.stroke is None) == (self.crank is None):
            if self.stroke is None:
                raise PydanticCustomError("GL106", "give stroke, or crank in its place", {"key": "stroke"})
            raise PydanticCustomError("GL111", "stroke and crank exclude each other: give one", {"key": "crank"})
        return self

    def slider_crank(self) -> SliderCrank:
        """The mechanism."""
        with at_key("stroke" if self.crank is None else "crank"):
            if self.crank is not None:
                return SliderCrank.of_crank(self.crank, self.rod, self.offset)
            assert self.stroke is not None
            return SliderCrank(self.stroke, self.rod, self.offset)

    @model_validator(mode="after")
    def _reachable(self) -> SliderCrankSpec:
        require_offset_below_rod(self.rod, self.offset, "offset")
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for: the crank, the motion with a speed or a limit, the loads with theirs."""
        moving = self.input_speed is not None or "limits" in self.model_fields_set
        motion = ("analyze",) if moving else ()
        return ("crank", *motion, *(("loads",) if self.loads is not None else ()))
