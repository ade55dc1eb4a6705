"""Keys of a gear pair at a given centre distance, as inside a machine: what its drawing needs beside the teeth."""

from typing import Annotated, Any, Literal, Self

from pydantic import Field, model_validator

from gearlink.core.base.spec import Deferred, Length, PressureAngle, also
from gearlink.core.parts.gears.keys.types import MaterialSpec, ToothKeys, TwoShifts


def _usual_material() -> Any:
    return MaterialSpec.model_construct()


class PairKeys(ToothKeys):
    """The keys of a `gear-pair` that a pair at a given centre distance takes."""

    module: Length = Field(description="module; of helical gears the normal one")
    pressure_angle: PressureAngle = Field(20.0, description="pressure angle of the reference profile")
    profile_shift: TwoShifts | None = Field(
        None, description="profile shift coefficients of gear 1 and 2; the rest of the centre distance is backlash"
    )
    tip_shortening: Annotated[Any, Deferred("parts.gears.keys.types:TipShortening")] | None = Field(
        None,
        description="full (default), none, or tip alterations k of both gears",
        json_schema_extra=also("tip_alteration"),
    )
    face_width: Annotated[Any, Deferred("parts.gears.keys.types:WidthOrTwo")] | None = Field(
        None, description="face width of both gears, or of each"
    )
    rim_thickness: Annotated[Any, Deferred("parts.gears.keys.types:RimOrTwo")] | None = Field(
        None, description="thickness of the rim under the tooth roots of both gears, or of each, for Y_B"
    )
    tool: Annotated[Any, Deferred("parts.gears.keys.sections:OneOrTwoTools")] | None = Field(
        None, description="rack tool of both gears, or of each; default: straight to the addendum"
    )
    pin_diameter: Annotated[Any, Deferred("parts.gears.keys.types:LengthOrTwo")] | None = Field(
        None, description="measuring balls or pins of both gears, or of each; default: a preferred size"
    )
    allowances: Annotated[Any, Deferred("parts.gears.keys.sections:AllowanceSpec")] | None = Field(
        None,
        description="allowances of the tooth thickness in the normal section: a series of DIN 3967, or limits in mm",
    )
    center_distance_allowance: Literal["js7"] | Length | None = Field(
        None, description="allowance +- of the centre distance: js7, or a number in mm"
    )
    load: Annotated[Any, Deferred("parts.gears.keys.sections:LoadSpec")] | None = Field(
        None, description="load of the rating by ISO 6336 (the section loads computes the forces of a drive)"
    )
    rating: Annotated[Any, Deferred("parts.gears.keys.rating:RatingSpec")] | None = Field(
        None, description="rating by ISO 6336 with all factors computed: life, material, grade, oil"
    )
    material: Annotated[Any, Deferred("parts.gears.keys.types:MaterialSpec")] = Field(
        default_factory=_usual_material, description="the materials; each key one number, or one for each gear"
    )

    @model_validator(mode="after")
    def _rated(self) -> Self:
        if self.rating is not None:
            from gearlink.core.parts.gears.keys.rating import require_rated

            require_rated(self, self.rating)
        return self
