"""The section `loads` of a slider-crank."""

from typing import Annotated, Literal

from pydantic import Field

from gearlink.core.base.spec import Spec, unit
from gearlink.core.studies.loads.spec import Body, Loads, masses


class SliderCrankMasses(Spec):
    """Masses of the links."""

    crank: Body | None = Field(None, description="crank, from D to E")
    rod: Body | None = Field(None, description="connecting rod, from E to F")
    slider: Body | None = Field(None, description="slider at F")
    pinion: Body | None = Field(None, description="pinion at F between the racks")
    rack: Body | None = Field(None, description="moving rack with all that it moves")


class SliderCrankBalance(Spec):
    """A counterweight on the crank."""

    reciprocating_share: Annotated[float, unit("1", ge=0, le=1)] | Literal["best"] = Field(
        0.5, description="share of the reciprocating mass that it balances; best: smallest maximum shaking force"
    )


class SliderCrankLoads(Loads):
    """Masses, forces and drive of a slider-crank."""

    links: SliderCrankMasses = masses(SliderCrankMasses)
    balance: SliderCrankBalance | None = None
