"""The section `loads` of a hypocycloid dwell and of a mutilated-gear dwell."""

from typing import Annotated

from pydantic import Field

from gearlink.core.base.spec import Spec, unit
from gearlink.core.studies.loads.spec import Body, Loads, masses


class HypocycloidMasses(Spec):
    """Masses of the links."""

    carrier: Body | None = Field(None, description="carrier, from O to the planet's axis")
    planet: Body | None = Field(None, description="planet, from its axis; the point M lies at -r on its x")
    rod: Body | None = Field(None, description="rod, from M to F")
    slider: Body | None = Field(None, description="slider at F")
    arm: Body | None = Field(None, description="arm with the slot, with all that turns with it, about D")


class HypocycloidLoads(Loads):
    """Masses, forces and drive of a hypocycloid dwell."""

    links: HypocycloidMasses = masses(HypocycloidMasses)


Direction = Annotated[float, unit("deg", ge=-360, le=360)]


class MutilatedMasses(Spec):
    """Masses of the links."""

    wheel: Body | None = Field(None, description="mutilated wheel on W")
    crank: Body | None = Field(None, description="crank with the driven gear, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C")


class MutilatedLoads(Loads):
    """Masses, forces and drive of a mutilated-gear dwell."""

    wheel_direction: Direction | None = Field(
        None, description="direction from A to the wheel's axis W; default: no bearing force at A, no GL302 of W and D"
    )
    links: MutilatedMasses = masses(MutilatedMasses)
