"""Numbers and words of design files that describe gears, with their bounds and units."""

from __future__ import annotations

from typing import Annotated, Literal

from pydantic import Field

Shift = Annotated[float, Field(ge=-5, le=5, json_schema_extra={"unit": "1"})]
HelixAngle = Annotated[float, Field(ge=0, le=45, json_schema_extra={"unit": "deg"})]
Alteration = Annotated[float, Field(ge=-3, le=3, json_schema_extra={"unit": "1"})]
FaceWidth = Annotated[float, Field(ge=1e-3, le=1e6, json_schema_extra={"unit": "mm"})]
Rim = Annotated[float, Field(ge=1e-3, le=1e6, json_schema_extra={"unit": "mm"})]
SpanTeeth = Annotated[int, Field(ge=1, le=10_000, json_schema_extra={"unit": "teeth"})]
Hand = Literal["right", "left"]
AccuracyGrade = Annotated[int, Field(ge=0, le=12, json_schema_extra={"unit": "1"})]
