"""The section `loads` of a crank-rocker."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Balance, Body, Loads, masses


class CrankRockerMasses(Spec):
    """Masses of the links."""

    crank: Body | None = Field(None, description="crank, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C, with all that swings with it")


class CrankRockerLoads(Loads):
    """Masses, forces and drive of a crank-rocker."""

    links: CrankRockerMasses = masses(CrankRockerMasses)
    balance: Balance | None = None
