"""Keys of a design file that describe gears beyond their teeth: tools, tips, widths."""

from __future__ import annotations

from typing import Annotated, Any, Literal

from pydantic import Field
from pydantic_core import PydanticCustomError

from gearlink.core.spec import Coefficient, Length, Spec

Shift = Annotated[float, Field(ge=-5, le=5, json_schema_extra={"unit": "1"})]
HelixAngle = Annotated[float, Field(ge=0, le=45, json_schema_extra={"unit": "deg"})]
Alteration = Annotated[float, Field(ge=-3, le=3, json_schema_extra={"unit": "1"})]
Protuberance = Annotated[float, Field(ge=0, le=1, json_schema_extra={"unit": "1"})]
Rounding = Annotated[float, Field(ge=0, le=3, json_schema_extra={"unit": "1"})]
TwoShifts = Annotated[list[Shift], Field(min_length=2, max_length=2)]
TwoLengths = Annotated[list[Length], Field(min_length=2, max_length=2)]
TwoAlterations = Annotated[list[Alteration], Field(min_length=2, max_length=2)]
TipShortening = Literal["full", "none"] | TwoAlterations
SignedTeeth = Annotated[int, Field(ge=-10_000, le=10_000, json_schema_extra={"unit": "teeth"})]
SpanTeeth = Annotated[int, Field(ge=1, le=10_000, json_schema_extra={"unit": "teeth"})]
Hand = Literal["right", "left"]


class ToolSpec(Spec):
    """A rack tool (hob, rack cutter), in modules of the normal section."""

    addendum: Coefficient = Field(1.25, description="tip of the tool below its datum line")
    rounding: Rounding | None = Field(
        None, description="radius of the tool's tip; left out: 0.38, or less where clearance or full round ask for it"
    )
    residual_undercut: Protuberance = Field(0.0, description="protuberance less the machining allowance")


class CutterSpec(Spec):
    """The pinion cutter that shapes a ring, in modules of the normal section."""

    teeth: Annotated[int, Field(ge=3, le=10_000, json_schema_extra={"unit": "teeth"})] = Field(
        description="teeth of the cutter"
    )
    shift: Shift = Field(0.0, description="profile shift of the cutter as it is ground")
    addendum: Coefficient = Field(1.25, description="addendum coefficient of the cutter")
    rounding: Rounding = Field(0.25, description="radius of the cutter's tip corner")


TwoTools = Annotated[list[ToolSpec | None], Field(min_length=2, max_length=2)]


def exclude_each_other(spec: Any, first: str, second: str) -> None:
    """Refuse a file that gives both of two keys."""
    if getattr(spec, first) is not None and getattr(spec, second) is not None:
        message = f"{first} and {second} exclude each other: give one"
        raise PydanticCustomError("GL111", message, {"key": second})


def require_teeth(teeth: list[Any]) -> None:
    """Refuse teeth that no pair has: gear 1 is external, gear 2 external, a ring (negative), or a rack."""
    first, second = teeth
    if first == "rack":
        message = "teeth[0] must be a number: gear 1 is external, a rack is teeth: [z, rack]"
        raise PydanticCustomError("GL108", message, {"key": "teeth[0]"})
    for place, z in enumerate((first, second)):
        if z == 0 or (place == 0 and z < 0):
            help_ = "a ring is gear 2: teeth: [21, -67]" if z < 0 else "allowed: from 1 to 10000"
            message = "{key} must be at least 1, not {value}"
            raise PydanticCustomError("GL108", message, {"key": f"teeth[{place}]", "value": z, "help": help_})
    if second != "rack" and second < 0 and -second <= first:
        message = "a ring of {ring} teeth does not take a gear of {first}: it needs more teeth"
        raise PydanticCustomError("GL111", message, {"key": "teeth[1]", "ring": -second, "first": first})
