"""The design file of a motion law by itself."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field, model_validator
from pydantic_core import PydanticCustomError

from gearlink.core.base.spec import DesignSpec, Length, Speed
from gearlink.core.parts.cams.spec import MotionLaw

Millis = Annotated[float, Field(gt=0, le=1e9, json_schema_extra={"unit": "ms"})]
PhaseAngle = Annotated[float, Field(gt=0, le=360, json_schema_extra={"unit": "deg"})]
Hertz = Annotated[float, Field(gt=0, le=1e7, json_schema_extra={"unit": "Hz"})]
Damping = Annotated[float, Field(ge=0, lt=1, json_schema_extra={"unit": "1"})]


class MotionLawSpec(DesignSpec):
    """A motion law, over the share x of a phase."""

    kind: Literal["motion-law"]
    law: MotionLaw = Field(description="the law: a name, or a mapping with its numbers")
    stroke: Length | None = Field(None, description="rise over the phase; with a time real speeds are given")
    time: Millis | None = Field(None, description="time of the phase")
    speed: Speed | None = Field(None, description="speed of the input, instead of time; with angle")
    angle: PhaseAngle | None = Field(None, description="angle of the input over the phase")
    frequency: Hertz | None = Field(None, description="natural frequency of what the law moves")
    damping: Damping | None = Field(None, description="its damping ratio; default: 0")

    @model_validator(mode="after")
    def _one_time(self) -> MotionLawSpec:
        if self.time is not None and self.speed is not None:
            raise _refused("speed", "time and speed say the same\nomit time or speed")
        if (self.speed is None) != (self.angle is None):
            key = "angle" if self.angle is None else "speed"
            raise _refused(key, "speed and angle go together\ngive both, or time")
        return self

    @property
    def seconds(self) -> float | None:
        """Time of the phase [s]."""
        if self.speed is not None and self.angle is not None:
            return self.angle / (6.0 * self.speed)
        return None if self.time is None else 1e-3 * self.time

    def commands(self) -> tuple[str, ...]:
        """What the file asks for."""
        return ("laws",)


def _refused(key: str, message: str) -> Any:
    return PydanticCustomError("GL111", "{message}", {"message": message, "key": key})
