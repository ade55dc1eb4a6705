"""The section `loads` of a two-gear four-bar and of a geared rocker."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Balance, Body, Loads, masses


class PlanetMasses(Spec):
    """Masses of the links; the gear on the coupler belongs to it."""

    crank: Body | None = Field(None, description="crank, from A to B")
    coupler: Body | None = Field(None, description="coupler with its gear, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C")
    output: Body | None = Field(None, description="output gear with all that turns with it")


class PlanetLoads(Loads):
    """Masses, forces and drive of a four-bar with a gear on its coupler."""

    links: PlanetMasses = masses(PlanetMasses)
    balance: Balance | None = None
