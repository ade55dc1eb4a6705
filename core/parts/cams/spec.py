"""The motion law as a key of design files."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, Any

from pydantic_core import core_schema

if TYPE_CHECKING:
    from pydantic import BaseModel


class _LawNames:
    """Reads laws that numbers shape, and gives editors the names of all; `laws.law` judges what else is written."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> core_schema.CoreSchema:
        written = core_schema.wrap_serializer_function_ser_schema(
            _written, info_arg=True, schema=core_schema.any_schema()
        )
        return core_schema.no_info_wrap_validator_function(_validated, handler(source), serialization=written)

    def model_of(self, value: Any) -> type[BaseModel] | None:
        """The model that a mapping with a type is read by."""
        from gearlink.core.parts.cams.shaped_spec import MODELS

        return MODELS.get(str(value.get("type"))) if isinstance(value, dict) else None

    def __get_pydantic_json_schema__(self, core_schema: Any, handler: Any) -> dict[str, Any]:
        from pydantic import TypeAdapter

        from gearlink.core.parts.cams.laws import REST_TO_REST, REST_TO_SPEED
        from gearlink.core.parts.cams.shaped_spec import MODELS

        short = ("half-345", "half-4567", "velocity-345", "velocity-4567")
        four = {"type": "array", "items": {"type": "number"}, "minItems": 4, "maxItems": 4}
        numbers = {name: four | {"description": words} for name, words in _OF_SHARES.items()}
        numbers |= {name: {"type": "number", "description": words} for name, words in _OF_KAPPA.items()}
        return {
            "anyOf": [
                *(handler(TypeAdapter(model).core_schema) for model in MODELS.values()),
                {"enum": [*REST_TO_REST, *REST_TO_SPEED, *short]},
                {"type": "string", "pattern": r"^(half-|velocity-)?mcv-[0-9.]+$"},
                {"type": "object", "properties": numbers, "additionalProperties": False, "minProperties": 1},
            ]
        }


_SHARES = "shares of the rise with sine, constant, cosine and no acceleration, sum 1; the second half mirrors the first"
_OF_SHARES = {
    "scca": f"{_SHARES}; [0, 1, 0, 0]: parabolic motion",
    "half-scca": "rest to speed: the first half of the law with these shares, see scca",
    "velocity-scca": "rest to speed: the velocity has the shape of the law with these shares, see scca",
}
_OF_KAPPA = {
    "quintic": "rest to speed by a polynomial of degree 5: its rise over end speed times time, 0.4 to 0.6",
    "septic": "rest to speed by a polynomial of degree 7: its rise over end speed times time, 3/7 to 4/7",
}


def _validated(value: Any, handler: Any) -> Any:
    """The model of a mapping with a type of `shaped_spec`; a model that a spec brings is valid already."""
    if isinstance(value, dict) and "type" in value:
        from gearlink.core.parts.cams.shaped_spec import shaped

        found = shaped(value)
        return handler(value) if isinstance(found, dict) else found
    return value if hasattr(type(value), "model_fields") else handler(value)


def _written(value: BaseModel | str | dict[str, Any], handler: Any, info: Any) -> Any:
    if isinstance(value, str | dict):
        return handler(value)
    return value.model_dump(mode=info.mode, exclude_unset=info.exclude_unset, by_alias=True)


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
