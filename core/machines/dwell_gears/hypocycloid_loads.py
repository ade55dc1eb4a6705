"""The loads of a hypocycloid dwell: carrier, planet in a fixed ring, rod, slider."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.base.results import cached_property
from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_spec import HypocycloidDwellSpec


class HypocycloidDwellLoads(LoadsDesign):
    """Input angle: the carrier's from the middle of the dwell's arc; the slider moves on +x."""

    kind = "hypocycloid-dwell"
    spec: HypocycloidDwellSpec
    links, sliding = ("carrier", "planet", "rod", "slider"), ("slider",)
    pins, meshes = ("O", "planet", "M", "F"), ("mesh_ring",)
    output = "slider"
    outlines = loads_outline(pins, meshes)

    @cached_property
    def design(self) -> HypocycloidDwell:
        """The geometry."""
        return HypocycloidDwell(self.spec)

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell, about the middle of the arc."""
        angle = self.design.dwell_carrier_angle
        return [(-0.5 * angle, angle)]
