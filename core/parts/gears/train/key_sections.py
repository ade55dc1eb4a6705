"""Sections of a train's keys, with an entry for each gear where they are lists: tools, allowances, load, material."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Length, Spec, refused
from gearlink.core.parts.gears.keys.sections import Allowance, AllowanceSpec, LoadSpec, Series, ToolSpec
from gearlink.core.parts.gears.keys.types import (
    Alteration,
    FaceWidth,
    Factor,
    Hand,
    MaterialSpec,
    Poisson,
    Rim,
    Shift,
    SpanTeeth,
    Stress,
)

_MANY = Field(min_length=2, max_length=4)
_Allowances = Annotated[list[Allowance], _MANY]
_Series = Annotated[list[Series], _MANY]
_Stresses = Annotated[list[Stress], _MANY]
_Poissons = Annotated[list[Poisson], _MANY]
_Factors = Annotated[list[Factor], _MANY]
Shifts = Annotated[list[Shift], _MANY]
Hands = Annotated[list[Hand], _MANY]
TipShortenings = Literal["full", "none"] | Annotated[list[Alteration], _MANY]
FaceWidths = FaceWidth | Annotated[list[FaceWidth], _MANY]
Rims = Rim | Annotated[list[Rim | None], _MANY]
Spans = Annotated[list[SpanTeeth], _MANY]
Pins = Length | Annotated[list[Length], _MANY]
Tools = ToolSpec | Annotated[list[ToolSpec | None], _MANY]


def entries(values: dict[str, Any], places: Any) -> dict[str, Any]:
    """Values of two gears, of the lists that have an entry for each."""
    return {
        name: [value[place] for place in places] if isinstance(value, list) else value for name, value in values.items()
    }


class TrainAllowances(Spec):
    """Allowances of the tooth thickness of every gear: a series of DIN 3967, or limits in mm."""

    series: Series | _Series | None = Field(None, description="of DIN 3967, such as 25cd; one, or one for each gear")
    upper: _Allowances | None = Field(None, description="upper allowances E_sns of every gear, usually negative [mm]")
    lower: _Allowances | None = Field(None, description="lower allowances E_sni of every gear [mm]")

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

    elastic_modulus: Stress | _Stresses = Field(206000.0, description="modulus of elasticity")
    poisson: Poisson | _Poissons = Field(0.3, description="Poisson's ratio")
    contact_limit: Stress | _Stresses | None = Field(None, description="sigma_Hlim; default: no safety against pitting")
    bending_limit: Stress | _Stresses | None = Field(
        None, description="sigma_Flim; default: no safety against tooth breakage"
    )
    contact_factors: Factor | _Factors = Field(1.0, description="Z_N Z_L Z_v Z_R Z_W Z_X as one product, given")
    bending_factors: Factor | _Factors = Field(
        1.0, description="Y_N Y_drelT Y_RrelT Y_X as one product, given; Y_d of an idler is applied in addition"
    )

    def of(self, places: Any) -> MaterialSpec:
        """The materials of two gears by their places."""
        return MaterialSpec(**entries(dict(self), places))
