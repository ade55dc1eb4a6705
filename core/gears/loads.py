"""The loads of a gear pair: tooth force and bearings of two gears on the frame; gear 1 is the input, at 0.

Pin forces are those in the plane of the gears. Helical teeth push besides along the axis with F_a = F_t tan(beta_w),
which tilts each gear with F_a r_w; what that puts on its two bearings depends on their distance.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.gears.design import GearPairDesign
from gearlink.core.loads import tables
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.report import Table
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.data import GearData
    from gearlink.core.gears.mesh.pair import GearPair
    from gearlink.core.gears.spec import GearPairSpec
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals


class GearPairLoads(LoadsDesign):
    """Gear 1 at 0, gear 2 on +x, or about gear 1 where it is a ring."""

    kind = "gear-pair"
    spec: GearPairSpec
    links = ("gear1", "gear2")
    pins, meshes = ("gear1", "gear2"), ("mesh_12",)
    output = "gear2"
    outlines = loads_outline(pins, meshes, ("axial_force_max", "tilting_moment_max"))

    @cached_property
    def _geometry(self) -> GearPairDesign:
        return GearPairDesign(self.spec)

    @property
    def pair(self) -> GearPair:
        """The geometry."""
        return self._geometry.gear_pair

    @property
    def mesh_data(self) -> dict[str, GearData]:
        """The pair with what its rating needs."""
        return {"": self._geometry.data}

    @property
    def turns(self) -> int:
        """Turns of gear 1 until both gears are back at their place."""
        return abs(self.pair.teeth[1]) // math.gcd(*self.pair.teeth)

    @property
    def axial_share(self) -> float:
        """F_a over F_t: tan(beta_w), tan(beta_w) = tan(beta) r_w/r."""
        pair = self.pair
        return math.tan(abs(pair.helix_angle)) * pair.working_radius[0] / pair.reference_radius[0]

    @property
    def axial_force_max(self) -> float | None:
        """Greatest axial force of helical teeth [N]; None of spur gears."""
        return self.axial_share * self.mesh("mesh_12").tooth_force_max if self.pair.helix_angle else None

    @property
    def tilting_moment_max(self) -> list[float] | None:
        """Greatest moment F_a r_w that tilts gear 1 and gear 2 [N m]; None of spur gears."""
        from gearlink.core.mechanism.joints import NEWTON_METER

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

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """Both gears at angles of gear 1."""
        from gearlink.core.mechanism.joints import Mesh, Pin
        from gearlink.core.mechanism.links import FRAME, Link, Mechanism
        from gearlink.core.mechanism.rates import fixed, steady

        pair = self.pair
        r1, r2 = pair.working_radius
        links = {
            "gear1": Link(fixed(0j, phi, order=order), steady(phi, order=order)),
            "gear2": Link(
                fixed(complex(abs(pair.center_distance)), phi, order=order), steady(phi, -r1 / r2, order=order)
            ),
        }
        a, b = links["gear1"].origin.value, links["gear2"].origin.value
        tangent = math.tan(pair.working_pressure_angle)
        if r2 < 0.0:
            mesh = Mesh("mesh_12", "gear2", "gear1", b, -1.0 + 0j, -r2, r1, tangent, True)
        else:
            mesh = Mesh("mesh_12", "gear1", "gear2", a, 1.0 + 0j, r1, r2, tangent)
        pins = [Pin("gear1", FRAME, "gear1", a), Pin("gear2", FRAME, "gear2", b)]
        return Mechanism(links, [*pins, mesh], "gear1")
