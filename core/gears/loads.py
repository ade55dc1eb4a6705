"""The loads of a gear pair: tooth force and bearings of two gears on the frame; gear 1 is the input, at 0.

Forces are those in the plane of the gears: of helical teeth the axial force is left out.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.gears.design import GearPairDesign
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.gears.pair import GearPair
    from gearlink.core.gears.spec import GearPairSpec
    from gearlink.core.loads.mechanism import Mechanism
    from gearlink.core.numerics.arrays import Reals

_MM = 1e-3


class GearPairLoads(LoadsDesign):
    """Gear 1 at 0, gear 2 on +x, or about gear 1 where it is a ring."""

    kind = "gear-pair"
    spec: GearPairSpec
    links = ("gear1", "gear2")
    pins, meshes = ("gear1", "gear2"), ("mesh_12",)
    output = "gear2"
    outlines = loads_outline(pins, meshes)

    @cached_property
    def pair(self) -> GearPair:
        """The geometry."""
        return GearPairDesign(self.spec).gear_pair

    @property
    def turns(self) -> int:
        """Turns of gear 1 until both gears are back at their place."""
        return abs(self.pair.teeth[1]) // math.gcd(*self.pair.teeth)

    def kinematics(self, phi: Reals) -> Mechanism:
        """Both gears at angles of gear 1."""
        from gearlink.core.loads.kinematics import fixed, steady
        from gearlink.core.loads.mechanism import FRAME, Link, Mechanism, Mesh, Pin

        pair = self.pair
        r1, r2 = (radius * _MM for radius in pair.working_radius)
        links = {
            "gear1": Link(fixed(0j, phi), steady(phi)),
            "gear2": Link(fixed(complex(abs(pair.center_distance) * _MM), phi), steady(phi, -r1 / r2)),
        }
        a, b = links["gear1"].origin.value, links["gear2"].origin.value
        tangent = math.tan(pair.working_pressure_angle)
        if r2 < 0.0:
            mesh = Mesh("mesh_12", "gear2", "gear1", b, -1.0 + 0j, -r2, r1, tangent, True)
        else:
            mesh = Mesh("mesh_12", "gear1", "gear2", a, 1.0 + 0j, r1, r2, tangent)
        pins = [Pin("gear1", FRAME, "gear1", a), Pin("gear2", FRAME, "gear2", b)]
        return Mechanism(links, [*pins, mesh], "gear1")
