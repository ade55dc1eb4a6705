"""The loads of a two-gear four-bar and of a geared rocker: a four-bar, a free gear, a mesh on the carrier link."""

from __future__ import annotations

import math
from fractions import Fraction
from typing import Any

from gearlink.core.base.design import geometry
from gearlink.core.base.kinds import KINDS
from gearlink.core.base.results import cached_property
from gearlink.core.machines.planet_linkages.rocker_design import GearedRocker
from gearlink.core.machines.planet_linkages.two_gear_design import TwoGearFourBar
from gearlink.core.parts.linkages.fourbar.mechanism import full_balance
from gearlink.core.parts.linkages.fourbar.position import FourBar
from gearlink.core.studies.loads.design import LoadsDesign, homecoming, is_directed, loads_outline
from gearlink.core.studies.loads.names import BALANCE

_MESHES = ("mesh_25",)
_MOST_TEETH = 10_000


class PlanetLinkageLoads(LoadsDesign):
    """What both have: crank, coupler with a gear, rocker, and a free gear on the pivot of the carrier link."""

    links = ("crank", "coupler", "rocker", "output")
    meshes = _MESHES
    design: Any

    @cached_property
    def linkage(self) -> FourBar:
        """The four-bar."""
        found: FourBar = self.design.linkage
        return found

    def counterweights(self) -> dict[str, complex]:
        """Those of the full force balance."""
        return full_balance(self.linkage, self.masses)


class TwoGearLoads(PlanetLinkageLoads):
    """Planet on the coupler at B, output gear or ring on A."""

    kind = "two-gear-four-bar"
    pins = ("A", "B", "C", "D", "A_output")
    outlines = loads_outline(pins, _MESHES, BALANCE)

    def __init__(self, spec: Any) -> None:
        super().__init__(KINDS[self.kind].completed(spec))

    design: cached_property[TwoGearFourBar] = geometry(TwoGearFourBar)

    @cached_property
    def turns(self) -> int:
        """Crank turns until the output is home, where its direction matters."""
        if not is_directed(self.section, "output"):
            return 1
        mean = Fraction(self.design.mean_ratio).limit_denominator(_MOST_TEETH)
        return homecoming(mean.denominator, "the output is back in its initial position", "gears")

    @property
    def motion_turns(self) -> int:
        """The links are home after every revolution."""
        return 1

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell: within the tolerance of the file, else within the band that the back-step fills."""
        step = self.design.back_step
        tolerance = None if step is None else 0.5 * step.angle
        if self.design.output_tolerance is not None:
            tolerance = self.design.output_tolerance
        if tolerance is None:
            return []
        dwell = self.design.drive.within(tolerance)
        return [(dwell.start + 2.0 * math.pi * turn, dwell.crank_angle) for turn in range(self.turns)]


class GearedRockerLoads(PlanetLinkageLoads):
    """Gear on the coupler at C, output gear on D."""

    kind = "geared-rocker"
    pins = ("A", "B", "C", "D", "D_output")
    outlines = loads_outline(pins, _MESHES, BALANCE)
    design: cached_property[GearedRocker] = geometry(GearedRocker)
