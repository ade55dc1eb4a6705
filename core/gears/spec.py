"""The design file of a gear pair."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.spec import Coefficient, DesignSpec, GearLimits, Length, PressureAngle, Teeth

Shift = Annotated[float, Field(ge=-5, le=5, json_schema_extra={"unit": "1"})]


class GearPairSpec(DesignSpec):
    """External spur gears with profile shift, given by centre distance or by shifts."""

    kind: Literal["gear-pair"]
    module: Length = Field(description="normal module")
    teeth: Annotated[list[Teeth], Field(min_length=2, max_length=2)] = Field(description="teeth of gear 1 and 2")
    center_distance: Length | None = Field(None, description="working centre distance")
    profile_shift: Annotated[list[Shift], Field(min_length=2, max_length=2)] | None = Field(
        None, description="profile shift coefficients of gear 1 and 2"
    )
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    addendum: Coefficient = Field(1.0, description="addendum coefficient")
    clearance: Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})] = Field(
        0.25, description="clearance coefficient"
    )
    shift_split: Literal["equal"] | Shift = Field(
        "equal", description="how the shift sum is shared when center_distance is given: equal, or x1"
    )
    limits: GearLimits = GearLimits()

    @model_validator(mode="after")
    def _placed(self) -> GearPairSpec:
        if self.center_distance is None and self.profile_shift is None:
            raise PydanticCustomError(
                "GL106", "either center_distance or profile_shift is needed", {"key": "center_distance"}
            )
        return self

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("gear",)
