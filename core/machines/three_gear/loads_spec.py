"""The section `loads` of a three-gear four-bar."""

from typing import Literal

from pydantic import Field

from gearlink.core.base.spec import Spec
from gearlink.core.studies.loads.spec import Balance, Body, Loads, masses


class ThreeGearMasses(Spec):
    """Masses of the links; a gear that is fixed to a link belongs to it."""

    crank: Body | None = Field(None, description="crank with gear 1, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C")
    idler: Body | None = Field(None, description="idler on C")
    output: Body | None = Field(None, description="output gear with all that turns with it, on D")


class ThreeGearLoads(Loads):
    """Masses, forces and drive of a three-gear four-bar."""

    links: ThreeGearMasses = masses(ThreeGearMasses)
    idler_pin: Literal["coupler", "rocker"] = Field("coupler", description="link that the pin of the idler is fixed to")
    balance: Balance | None = None
