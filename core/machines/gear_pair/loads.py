"""The loads of a gear pair: tooth force and bearings of two gears on the frame; gear 1 is the input, at 0.

Pin forces are those in the plane of the gears. Helical teeth push besides along the axis with F_a = F_t tan(beta_w),
which tilts each gear with F_a r_w; what that puts on its two bearings depends on their distance.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.base.design import geometry
from gearlink.core.base.report import Table
from gearlink.core.base.results import cached_property
from gearlink.core.machines.gear_pair.design import GearPairDesign
from gearlink.core.mechanism.joints import NEWTON_METER
from gearlink.core.studies.loads import tables
from gearlink.core.studies.loads.design import LoadsDesign, loads_outline

if TYPE_CHECKING:
    from gearlink.core.machines.gear_pair.spec import GearPairSpec
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.mesh.pair import GearPair


class GearPairLoads(LoadsDesign):
    """Gear 1 at 0, gear 2 on +x, or about gear 1 where it is a ring."""

    kind = "gear-pair"
    spec: GearPairSpec
    links = ("gear1", "gear2")
    pins, meshes = ("gear1", "gear2"), ("mesh_12",)
    output = "gear2"
    outlines = loads_outline(pins, meshes, ("axial_force_max", "tilting_moment_max"))
    design: cached_property[GearPairDesign] = geometry(GearPairDesign)

    @property
    def pair(self) -> GearPair:
        """The two gears."""
        return self.design.gear_pair

    @property
    def mesh_data(self) -> dict[str, GearData]:
        """The pair with what its rating needs."""
        return {"": self.design.data}

    @property
    def turns(self) -> int:
        """Turns of gear 1 until both gears are back at their place."""
        turns = self.moving.input.turns
        assert turns is not None, "both gears are back in their initial positions"
        return turns

    @property
    def axial_share(self) -> float:
        """F_a over F_t: tan(beta_w), tan(beta_w) = tan(beta) r_w/r."""
        pair = self.pair
        return math.tan(abs(pair.helix_angle)) * pair.working_radius[0] / pair.reference_radius[0]

    @property
    def axial_force_max(self) -> float | None:
        """Maximum axial force of helical teeth [N]; None of spur gears."""
        return self.axial_share * self.mesh("mesh_12").tooth_force_max if self.pair.helix_angle else None

    @property
    def tilting_moment_max(self) -> list[float] | None:
        """Maximum moment F_a r_w that tilts gear 1 and gear 2 [N m]; None of spur gears."""
        force = self.axial_force_max
        return None if force is None else [force * abs(radius) / NEWTON_METER for radius in self.pair.working_radius]

    def table_teeth(self, samples: int | None = None) -> Table:
        """Tangential and radial tooth force; of helical teeth the axial one, a magnitude."""
        found = tables.teeth(self, samples)
        if not self.pair.helix_angle:
            return found
        columns = dict(zip(found.columns, zip(found.data, found.units, strict=True), strict=True))
        columns["mesh_12_axial"] = (self.axial_share * abs(found["mesh_12"]), "N")
        return Table.of("teeth", columns)
