"""Numbers, words and materials of design files that describe gears, with their bounds and units."""

from typing import Annotated, Literal, TypeAlias, TypeVar

from pydantic import Field

from gearlink.core.base.spec import Coefficient, Length, Spec, unit

T = TypeVar("T")
Two = Annotated[list[T], Field(min_length=2, max_length=2)]
OneOrTwo: TypeAlias = T | Two[T]
Many = Annotated[list[T], Field(min_length=2, max_length=4)]
OneOrMany: TypeAlias = T | Many[T]
"""One for all gears of a pair or a train, or a list with one for each."""

Shift = Annotated[float, unit("1", ge=-5, le=5)]
HelixAngle = Annotated[float, unit("deg", ge=0, le=45)]
Alteration = Annotated[float, unit("1", ge=-3, le=3)]
FaceWidth = Annotated[float, unit("mm", ge=1e-3, le=1e6)]
Rim = Annotated[float, unit("mm", ge=1e-3, le=1e6)]
SpanTeeth = Annotated[int, unit("teeth", ge=1, le=10_000)]
Factor = Annotated[float, unit("1", gt=0, le=100)]
Hand = Literal["right", "left"]
AccuracyGrade = Annotated[int, unit("1", ge=0, le=12)]

TwoShifts = Two[Shift]
TwoLengths = Two[Length]
TwoHands = Two[Hand]
TwoSpans = Two[SpanTeeth]
WidthOrTwo = OneOrTwo[FaceWidth]
RimOrTwo = Rim | Two[Rim | None]
LengthOrTwo = OneOrTwo[Length]
TipShortening = Literal["full", "none"] | Two[Alteration]
SignedTeeth = Annotated[int, Field(ge=-10_000, le=10_000, json_schema_extra={"unit": "teeth", "not": {"const": 0}})]


class ToothKeys(Spec):
    """The keys that a pair and a train share."""

    helix_angle: HelixAngle = Field(0.0, description="helix angle on the reference circle, its magnitude")
    addendum: Coefficient = Field(1.0, description="addendum coefficient")
    clearance: Annotated[float, unit("1", ge=0, le=1)] = Field(0.25, description="clearance coefficient")
    load_share: Literal["third", "half"] = Field(
        "third", description="load share of a tooth pair in double contact: third (1/3 to 2/3) or half"
    )
    accuracy_grade: AccuracyGrade | None = Field(
        None, description="accuracy grade of ISO 1328: 4 or better lowers the root stress of deep teeth (Y_DT)"
    )
    edition: Literal[2006, 2019] = Field(2006, description="of ISO 6336; 2019 is not verified")


Stress = Annotated[float, unit("N/mm^2", ge=1e-3, le=1e7)]
Poisson = Annotated[float, unit("1", ge=0, le=0.5)]


class MaterialSpec(Spec):
    """The materials; each key one number, or one for each gear."""

    elastic_modulus: OneOrTwo[Stress] = Field(206000.0, description="modulus of elasticity")
    poisson: OneOrTwo[Poisson] = Field(0.3, description="Poisson's ratio")
    contact_limit: OneOrTwo[Stress] | None = Field(None, description="sigma_Hlim; default: no safety against pitting")
    bending_limit: OneOrTwo[Stress] | None = Field(
        None, description="sigma_Flim; default: no safety against tooth breakage"
    )
    contact_factors: OneOrTwo[Factor] = Field(1.0, description="Z_N Z_L Z_v Z_R Z_W Z_X as one product, given")
    bending_factors: OneOrTwo[Factor] = Field(1.0, description="Y_N Y_drelT Y_RrelT Y_X as one product, given")
