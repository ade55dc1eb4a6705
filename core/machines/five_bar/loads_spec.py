"""The section `loads` of a geared five-bar."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Body, Loads, masses


class FiveBarMasses(Spec):
    """Masses of the links; a gear that is fixed to a link belongs to it."""

    input: Body | None = Field(None, description="input link with its gear, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C; function: with the planet")
    follower: Body | None = Field(None, description="follower; path: from D to C, function: from C to D")
    output: Body | None = Field(None, description="output link with its gear, from E to D")
    idler: Body | None = Field(None, description="path, with an idler: the idler on O")


class FiveBarLoads(Loads):
    """Masses, forces and drive of a geared five-bar."""

    links: FiveBarMasses = masses(FiveBarMasses)
