"""Sections of a train's keys, with an entry for each gear where they are lists: tools, allowances, load, material."""

from typing import Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Length, Spec, refused
from gearlink.core.parts.gears.keys.sections import Allowance, AllowanceSpec, LoadSpec, Series, ToolSpec
from gearlink.core.parts.gears.keys.types import (
    Alteration,
    FaceWidth,
    Factor,
    Hand,
    Many,
    MaterialSpec,
    OneOrMany,
    Poisson,
    Rim,
    Shift,
    SpanTeeth,
    Stress,
)

Shifts = Many[Shift]
Hands = Many[Hand]
TipShortenings = Literal["full", "none"] | Many[Alteration]
FaceWidths = OneOrMany[FaceWidth]
Rims = Rim | Many[Rim | None]
Spans = Many[SpanTeeth]
Pins = OneOrMany[Length]
Tools = ToolSpec | Many[ToolSpec | None]


def entries(values: dict[str, Any], places: Any) -> dict[str, Any]:
    """Values of two gears, of the lists that have an entry for each."""
    return {
        name: [value[place] for place in places] if isinstance(value, list) else value for name, value in values.items()
    }


class TrainAllowances(Spec):
    """Allowances of the tooth thickness of every gear: a series of DIN 3967, or limits in mm."""

    series: OneOrMany[Series] | None = Field(None, description="of DIN 3967, such as 25cd; one, or one for each gear")
    upper: Many[Allowance] | None = Field(
        None, description="upper allowances E_sns of every gear, usually negative [mm]"
    )
    lower: Many[Allowance] | None = Field(None, description="lower allowances E_sni of every gear [mm]")

    @model_validator(mode="after")
    def _one_way(self) -> Self:
        pairs = [range(2)] if self.upper is None or self.lower is None else _both(len(self.upper), len(self.lower))
        for places in pairs:
            self.of(places)  # the rules of a pair
        return self

    def of(self, places: Any) -> AllowanceSpec:
        """The allowances of two gears by their places."""
        return AllowanceSpec(**entries(dict(self), places))


def _both(one: int, other: int) -> list[range]:
    if one != other:
        message = "upper and lower need an entry for each gear"
        raise refused(message, "lower", "GL107")
    return [range(first, first + 2) for first in range(one - 1)]


class TrainLoad(LoadSpec):
    """What the teeth carry: torque, power with speed, or tangential force, at one gear; its mates have it by teeth."""

    gear: str | None = Field(
        None, description="the gear whose torque, speed and tangential force these are; default: the first"
    )


class TrainMaterial(Spec):
    """The materials; each key one number, or one for each gear."""

    elastic_modulus: OneOrMany[Stress] = Field(206000.0, description="modulus of elasticity")
    poisson: OneOrMany[Poisson] = Field(0.3, description="Poisson's ratio")
    contact_limit: OneOrMany[Stress] | None = Field(None, description="sigma_Hlim; default: no safety against pitting")
    bending_limit: OneOrMany[Stress] | None = Field(
        None, description="sigma_Flim; default: no safety against tooth breakage"
    )
    contact_factors: OneOrMany[Factor] = Field(1.0, description="Z_N Z_L Z_v Z_R Z_W Z_X as one product, given")
    bending_factors: OneOrMany[Factor] = Field(
        1.0, description="Y_N Y_drelT Y_RrelT Y_X as one product, given; Y_d of an idler is applied in addition"
    )

    def of(self, places: Any) -> MaterialSpec:
        """The materials of two gears by their places."""
        return MaterialSpec(**entries(dict(self), places))
