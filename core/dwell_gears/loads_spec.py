"""The section `loads` of a hypocycloid dwell and of a mutilated-gear dwell."""

from __future__ import annotations

from pydantic import Field

from gearlink.core.loads.spec import Body, Loads
from gearlink.core.spec import Spec


class HypocycloidMasses(Spec):
    """Masses of the links."""

    carrier: Body | None = Field(None, description="carrier, from O to the planet's axis")
    planet: Body | None = Field(None, description="planet, from its axis; the point M lies at -r on its x")
    rod: Body | None = Field(None, description="rod, from M to F")
    slider: Body | None = Field(None, description="slider at F")


class HypocycloidLoads(Loads):
    """Masses, forces and drive of a hypocycloid dwell."""

    links: HypocycloidMasses = Field(HypocycloidMasses(), description="masses of the links; what is left out has none")


class MutilatedMasses(Spec):
    """Masses of the links."""

    wheel: Body | None = Field(None, description="mutilated wheel on W")
    crank: Body | None = Field(None, description="crank with the driven gear, from A to B")
    coupler: Body | None = Field(None, description="coupler, from B to C")
    rocker: Body | None = Field(None, description="rocker, from D to C")


class MutilatedLoads(Loads):
    """Masses, forces and drive of a mutilated-gear dwell."""

    links: MutilatedMasses = Field(MutilatedMasses(), description="masses of the links; what is left out has none")
