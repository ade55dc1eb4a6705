"""The loads of a hypocycloid dwell: carrier, planet in a fixed ring, rod, slider."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.design import geometry
from gearlink.core.base.results import cached_property
from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_spec import HypocycloidDwellSpec


class HypocycloidDwellLoads(LoadsDesign):
    """Input angle: the carrier's from the middle of the dwell's arc; the slider moves on +x."""

    kind = "hypocycloid-dwell"
    spec: HypocycloidDwellSpec
    links, sliding = ("carrier", "planet", "rod", "slider", "arm"), ("slider",)
    pins, meshes = ("O", "planet", "M", "F", "D"), ("mesh_ring",)
    outlines = loads_outline(pins, meshes)
    design: cached_property[HypocycloidDwell] = geometry(HypocycloidDwell)

    @property
    def own_links(self) -> tuple[str, ...]:
        """Rod and slider, or the arm."""
        return ("carrier", "planet", "arm") if self.spec.is_arm else self.links[:4]

    @property
    def output(self) -> str:  # type: ignore[override]
        """The slider, or the arm."""
        return "arm" if self.spec.is_arm else "slider"

    @property
    def turns(self) -> int:
        """Turns of the carrier after which the planet comes home."""
        return self.moving.input.turns or 1

    @property
    def transmission_angle(self) -> float | None:
        """Of the rod; None of an arm, in whose slot the point pushes across."""
        return None if self.spec.is_arm else self.design.min_transmission_angle

    @property
    def quiet_zones(self) -> list[tuple[float, float]]:
        """The dwell, about the middle of the arc; of an arm those within the tolerance, about the cusps."""
        if self.spec.is_arm:
            angle, start = self.design.tolerance_dwell_angle, self.design.tolerance_dwell_start
            if angle is None or start is None:
                return []
            return [(start + k * 2.0 * math.pi / self.design.arm.teeth, angle) for k in range(self.design.steps or 1)]
        angle = self.design.dwell_carrier_angle
        return [(-0.5 * angle, angle)]
