"""The section `loads` of a crank-rocker."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Balance, Body, Loads


class CrankRockerMasses(Spec):
    """Masses of the links."""

    crank: Body | None = Field(None, description="crank, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C, with all that swings with it")


class CrankRockerLoads(Loads):
    """Masses, forces and drive of a crank-rocker."""

    links: CrankRockerMasses = Field(
        CrankRockerMasses.model_construct(), description="masses of the links; a part without an entry has no mass"
    )
    balance: Balance | None = None
