"""The loads of a Geneva drive: crank and wheel, the pin in its slots, the lock in the dwell."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from pydantic import Field

from gearlink.core.base.design import geometry
from gearlink.core.base.results import cached_property
from gearlink.core.base.spec import Spec
from gearlink.core.machines.geneva.design import GenevaDrive
from gearlink.core.mechanism.motion import TURN
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, is_directed, loads_outline
from gearlink.core.studies.loads.spec import Body, Loads

if TYPE_CHECKING:
    from gearlink.core.machines.geneva.spec import GenevaDriveSpec


class GenevaMasses(Spec):
    """Masses of crank and wheel."""

    crank: Body | None = Field(None, description="crank, from its axis A to a pin")
    wheel: Body | None = Field(None, description="wheel with all that turns with it, about its axis D")


class GenevaSection(Loads):
    """Masses, forces and drive of a Geneva drive."""

    links: GenevaMasses = Field(
        GenevaMasses.model_construct(), description="masses; a part without an entry has no mass"
    )


class GenevaLoads(LoadsDesign):
    """Input angle: the crank's, from a pin on the line of centres; in the dwell the locking disc holds the wheel."""

    kind = "geneva-drive"
    spec: GenevaDriveSpec
    section: GenevaSection
    links, output = ("crank", "wheel"), "wheel"
    pins, meshes = ("A", "D"), ()
    stands = True
    outlines = loads_outline(pins, meshes)
    design: cached_property[GenevaDrive] = geometry(GenevaDrive)

    @property
    def turns(self) -> int:
        """Crank turns until the wheel is home, where its direction matters."""
        if not is_directed(self.section, "wheel"):
            return 1
        turns = self.spec.slots // math.gcd(self.spec.slots, self.spec.pins)
        return homecoming(turns, "the wheel is back in its initial position", "slots", "balance the wheel")

    @property
    def motion_turns(self) -> int:
        """The steps repeat with every turn of the crank."""
        return 1

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell after each step."""
        design, pitch = self.design, TURN / self.spec.pins
        if design.locking_angle <= 0.0:
            return []
        return [
            (0.5 * design.motion_angle + step * pitch, design.locking_angle)
            for step in range(self.spec.pins * self.turns)
        ]
