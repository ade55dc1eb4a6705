"""The materials of gears in a design file."""

from __future__ import annotations

from typing import Annotated

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.parts.gears.keys.types import Factor

Stress = Annotated[float, Field(ge=1e-3, le=1e7, json_schema_extra={"unit": "N/mm^2"})]
Poisson = Annotated[float, Field(ge=0, le=0.5, json_schema_extra={"unit": "1"})]


class MaterialSpec(Spec):
    """The materials; each key one number, or one for each gear."""

    elastic_modulus: Stress | Annotated[list[Stress], Field(min_length=2, max_length=2)] = Field(
        206000.0, description="modulus of elasticity"
    )
    poisson: Poisson | Annotated[list[Poisson], Field(min_length=2, max_length=2)] = Field(
        0.3, description="Poisson's ratio"
    )
    contact_limit: Stress | Annotated[list[Stress], Field(min_length=2, max_length=2)] | None = Field(
        None, description="sigma_Hlim; default: no safety against pitting"
    )
    bending_limit: Stress | Annotated[list[Stress], Field(min_length=2, max_length=2)] | None = Field(
        None, description="sigma_Flim; default: no safety against breaking"
    )
    contact_factors: Factor | Annotated[list[Factor], Field(min_length=2, max_length=2)] = Field(
        1.0, description="Z_N Z_L Z_v Z_R Z_W Z_X as one product, given"
    )
    bending_factors: Factor | Annotated[list[Factor], Field(min_length=2, max_length=2)] = Field(
        1.0, description="Y_N Y_drelT Y_RrelT Y_X as one product, given"
    )
