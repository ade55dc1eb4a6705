"""The design file of a slider-crank."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator

from gearlink.core.spec import (
    AcuteAngle,
    Deferred,
    DrivenSpec,
    Length,
    LoadLimits,
    SignedLength,
    require_offset_below_rod,
)


class SliderLimits(LoadLimits):
    """Limits of the checks."""

    transmission_angle: AcuteAngle = Field(40.0, description="least transmission angle, 90 deg less the rod's lean")


class SliderCrankSpec(DrivenSpec):
    """An offset slider-crank given by its stroke."""

    kind: Literal["slider-crank"]
    stroke: Length = Field(description="stroke of the slider")
    rod: Length = Field(description="connecting rod")
    offset: SignedLength = Field(0.0, description="offset of the slide line from the crank's axis")
    limits: SliderLimits = SliderLimits()

    loads: Annotated[Any, Deferred("linkages.slider_crank_loads_spec:SliderCrankLoads")] | None = Field(
        None, description="masses, forces and drive, for the command loads"
    )

    @model_validator(mode="after")
    def _reachable(self) -> SliderCrankSpec:
        require_offset_below_rod(self.rod, self.offset, "offset")
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for: the crank, the motion with a speed or a limit, the loads with theirs."""
        motion = ("analyze",) if {"input_speed", "limits"} & self.model_fields_set else ()
        return ("crank", *motion, *(("loads",) if self.loads is not None else ()))
