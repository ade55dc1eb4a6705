"""The section `rating` of a train: that of a pair, with an entry for each gear where it has lists."""

from typing import Annotated, Any

from pydantic import Field

from gearlink.core.parts.gears.keys.rating import (
    Bore,
    Contacts,
    Hardness,
    MaterialName,
    MeanStress,
    RatingSpec,
    Roughness,
    RoughnessSpec,
)
from gearlink.core.parts.gears.keys.types import AccuracyGrade, Stress
from gearlink.core.parts.gears.train.key_sections import entries

_MANY = Field(min_length=2, max_length=4)
_Roughnesses = Annotated[list[Roughness], _MANY]


class TrainRoughness(RoughnessSpec):
    """Roughness of flank and root: each one number, or one for each gear."""

    flank: Roughness | _Roughnesses = Field(4.8, description="Rz of the flanks")
    root: Roughness | _Roughnesses = Field(20.0, description="Rz of the root fillets")
    ra: Roughness | _Roughnesses | None = Field(None, description="Ra of the flanks; default: Rz/8")


class TrainRating(RatingSpec):
    """Life, material, accuracy, surface and oil; what stands for each gear is one value, or a list with all of them."""

    material: MaterialName | Annotated[list[MaterialName], _MANY] | None = Field(
        None, description="steel or class of ISO 6336-5; optional if the material gives both limits"
    )
    hardness: Hardness | Annotated[list[Hardness | None], _MANY] | None = Field(
        None, description="HV, of cast iron and normalized steel HBW; default: usual for the steel"
    )
    brinell: Hardness | Annotated[list[Hardness | None], _MANY] | None = Field(
        None, description="HBW of the flank, for the work hardening; default: hardness"
    )
    yield_strength: Stress | Annotated[list[Stress | None], _MANY] | None = Field(
        None, description="yield point, for the notch sensitivity; default: that of the steel"
    )
    grade: AccuracyGrade | Annotated[list[AccuracyGrade], _MANY] | None = Field(
        None, description="accuracy grade of ISO 1328-1; default: accuracy_grade"
    )
    roughness: TrainRoughness = TrainRoughness.model_construct()
    bore: Bore | Annotated[list[Bore], _MANY] = Field(
        0.0, description="diameter of the bore; of a ring the outside diameter"
    )
    contacts: Contacts | Annotated[list[Contacts], _MANY] = Field(
        1.0, description="load contacts of a tooth per revolution"
    )
    mean_stress: MeanStress | Annotated[list[MeanStress], _MANY] | None = Field(
        None, description="mean stress influence factor Y_M; default: 1, of an idler or planet 0.7"
    )

    def of(self, places: Any) -> RatingSpec:
        """The rating of two gears by their places."""
        given = {name: getattr(self, name) for name in self.model_fields_set}
        if "roughness" in given:
            rough = {name: getattr(self.roughness, name) for name in self.roughness.model_fields_set}
            given["roughness"] = RoughnessSpec(**entries(rough, places))
        shared = {name: given.pop(name) for name in ("web", "spectrum") if name in given}
        return RatingSpec(**entries(given, places), **shared)
