"""What the spec models share: strictness, and number types that carry their unit into the JSON Schema."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import BaseModel, ConfigDict, Field
from pydantic_core import PydanticCustomError


class Spec(BaseModel):
    """A section of a design file: strict, frozen, no unknown keys, finite numbers only."""

    model_config = ConfigDict(strict=True, frozen=True, extra="forbid", allow_inf_nan=False)


class DesignSpec(Spec):
    """The keys that every kind of design file has."""

    name: str = Field("design", description="what the design is called; default: the file's stem")


Length = Annotated[float, Field(gt=0, json_schema_extra={"unit": "mm"})]
SignedLength = Annotated[float, Field(json_schema_extra={"unit": "mm"})]
Distance = Annotated[float, Field(ge=0, json_schema_extra={"unit": "mm"})]
Angle = Annotated[float, Field(ge=-360, le=360, json_schema_extra={"unit": "deg"})]
PressureAngle = Annotated[float, Field(gt=0, lt=45, json_schema_extra={"unit": "deg"})]
AcuteAngle = Annotated[float, Field(ge=0, lt=90, json_schema_extra={"unit": "deg"})]
Teeth = Annotated[int, Field(ge=1, le=10_000, json_schema_extra={"unit": "teeth"})]
Coefficient = Annotated[float, Field(gt=0, le=3, json_schema_extra={"unit": "1"})]
Assembly = Literal[1, -1]


class GearLimits(Spec):
    """Limits of the gear checks."""

    undercut: Annotated[float, Field(ge=0)] = Field(0.05, description="profile shift below x_min that is let pass")
    tip_thickness: Annotated[float, Field(ge=0)] = Field(0.25, description="least tip thickness over the module")
    contact_ratio: Annotated[float, Field(gt=0)] = Field(1.1, description="least transverse contact ratio")


def require_offset_below_rod(rod: float, offset: float, key: str) -> None:
    """Refuse a slide line that the connecting rod cannot reach."""
    if abs(offset) >= rod:
        raise PydanticCustomError(
            "GL111",
            "offset {offset} mm is not below the rod's {rod} mm: lengthen the rod or bring the slide line nearer",
            {"key": key, "offset": f"{offset:g}", "rod": f"{rod:g}"},
        )
