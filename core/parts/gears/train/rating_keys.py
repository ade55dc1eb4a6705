"""The section `rating` of a train: that of a pair, with an entry for each gear where it has lists."""

from typing import Any

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
from gearlink.core.parts.gears.keys.types import AccuracyGrade, Many, OneOrMany, Stress
from gearlink.core.parts.gears.train.key_sections import entries


class TrainRoughness(RoughnessSpec):
    """Roughness of flank and root: each one number, or one for each gear."""

    flank: OneOrMany[Roughness] = Field(4.8, description="Rz of the flanks")
    root: OneOrMany[Roughness] = Field(20.0, description="Rz of the root fillets")
    ra: OneOrMany[Roughness] | None = Field(None, description="Ra of the flanks; default: Rz/8")


class TrainRating(RatingSpec):
    """Life, material, accuracy, surface and oil; what stands for each gear is one value, or a list with all of them."""

    material: OneOrMany[MaterialName] | None = Field(
        None, description="steel or class of ISO 6336-5; optional if the material gives both limits"
    )
    hardness: Hardness | Many[Hardness | None] | None = Field(
        None, description="HV, of cast iron and normalized steel HBW; default: usual for the steel"
    )
    brinell: Hardness | Many[Hardness | None] | None = Field(
        None, description="HBW of the flank, for the work hardening; default: hardness"
    )
    yield_strength: Stress | Many[Stress | None] | None = Field(
        None, description="yield point, for the notch sensitivity; default: that of the steel"
    )
    grade: OneOrMany[AccuracyGrade] | None = Field(
        None, description="accuracy grade of ISO 1328-1; default: accuracy_grade"
    )
    roughness: TrainRoughness = TrainRoughness.model_construct()
    bore: OneOrMany[Bore] = Field(0.0, description="diameter of the bore; of a ring the outside diameter")
    contacts: OneOrMany[Contacts] = Field(1.0, description="load contacts of a tooth per revolution")
    mean_stress: OneOrMany[MeanStress] | None = Field(
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
