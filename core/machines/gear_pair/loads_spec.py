"""The section `loads` of a gear pair."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Body, Loads


class PairMasses(Spec):
    """Masses of the gears with their shafts."""

    gear1: Body | None = Field(None, description="gear 1 with its shaft, the input")
    gear2: Body | None = Field(None, description="gear 2 with its shaft")


class PairLoads(Loads):
    """Masses, forces and drive of a gear pair."""

    links: PairMasses = Field(
        PairMasses.model_construct(), description="masses of the gears; a part without an entry has no mass"
    )
