"""The section `loads` of a geared six-bar."""

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Body, Loads, masses


class SixBarMasses(Spec):
    """Masses of the links; the end gears of a train belong to the links that they are fixed to."""

    input: Body | None = Field(None, description="input link, from A to B")
    coupler_1: Body | None = Field(None, description="coupler, from B to C")
    coupler_2: Body | None = Field(None, description="coupler, from C to D")
    coupler_3: Body | None = Field(None, description="coupler, from D to E")
    output: Body | None = Field(None, description="output link, from F to E")
    gear_1A: Body | None = Field(None, description="first train: the gear that turns freely on A")
    gear_1B: Body | None = Field(None, description="first train: the gear that turns freely on B")
    gear_1C: Body | None = Field(None, description="first train: the gear that turns freely on C")
    gear_1D: Body | None = Field(None, description="first train: the gear that turns freely on D")
    gear_1E: Body | None = Field(None, description="first train: the gear that turns freely on E")
    gear_1F: Body | None = Field(None, description="first train: the gear that turns freely on F")
    gear_2A: Body | None = Field(None, description="second train: the gear that turns freely on A")
    gear_2B: Body | None = Field(None, description="second train: the gear that turns freely on B")
    gear_2C: Body | None = Field(None, description="second train: the gear that turns freely on C")
    gear_2D: Body | None = Field(None, description="second train: the gear that turns freely on D")
    gear_2E: Body | None = Field(None, description="second train: the gear that turns freely on E")
    gear_2F: Body | None = Field(None, description="second train: the gear that turns freely on F")


class SixBarLoads(Loads):
    """Masses, forces and drive of a geared six-bar."""

    links: SixBarMasses = masses(SixBarMasses)
