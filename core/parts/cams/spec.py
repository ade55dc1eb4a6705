"""The motion law as a key of design files."""

from __future__ import annotations

from typing import Annotated, Any


class _LawNames:
    """Gives editors the names of the motion laws; `gearlink.core.parts.cams.laws.law` is what judges them."""

    def __get_pydantic_json_schema__(self, core_schema: Any, handler: Any) -> dict[str, Any]:
        from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED

        short = ("half-345", "half-4567", "velocity-345", "velocity-4567")
        four = {"type": "array", "items": {"type": "number"}, "minItems": 4, "maxItems": 4}
        numbers = {"scca": four, "half-scca": four, "velocity-scca": four}
        numbers |= {"quintic": {"type": "number"}, "septic": {"type": "number"}}
        return {
            "anyOf": [
                {"enum": [*REST_TO_REST, *REST_TO_SPEED, *short]},
                {"type": "string", "pattern": r"^(half-|velocity-)?mcv-[0-9.]+$"},
                {"type": "object", "properties": numbers, "additionalProperties": False, "minProperties": 1},
            ]
        }


MotionLaw = Annotated[str | dict[str, Any], _LawNames()]


class _SegmentLaws(_LawNames):
    """The same for a segment of a follower's motion, which has laws of its own as well."""

    def __get_pydantic_json_schema__(self, core_schema: Any, handler: Any) -> dict[str, Any]:
        found = super().__get_pydantic_json_schema__(core_schema, handler)
        blend = {"type": {"const": "blend"}, "laws": {"type": "array"}, "share": {"type": "number", "unit": "1"}}
        shifted = {
            "type": {"const": "shifted"},
            "law": {"type": "string"},
            "inflection": {"type": "number", "unit": "1"},
        }
        own = [
            {"enum": ["constant-velocity", "polynomial"]},
            *(
                {"type": "object", "properties": each, "additionalProperties": False, "required": [*each]}
                for each in (blend, shifted)
            ),
        ]
        return {"anyOf": [*own, *found["anyOf"]]}


SegmentLaw = Annotated[str | dict[str, Any], _SegmentLaws()]
