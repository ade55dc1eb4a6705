"""The loads of a hypocycloid dwell: carrier, planet in a fixed ring, rod, slider."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.dwell_gears.hypocycloid_design import HypocycloidDwell
from gearlink.core.gears.outline.mesh_phase import signed_pair
from gearlink.core.loads.design import LoadsDesign, loads_outline
from gearlink.core.results import cached_property

if TYPE_CHECKING:
    from gearlink.core.dwell_gears.hypocycloid_spec import HypocycloidDwellSpec
    from gearlink.core.mechanism.joints import Connection
    from gearlink.core.mechanism.links import Mechanism
    from gearlink.core.numerics.arrays import Reals


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

    def kinematics(self, phi: Reals, order: int = 2) -> Mechanism:
        """The four links at carrier angles, the ring's centre at 0."""
        from gearlink.core.mechanism.closures import slider
        from gearlink.core.mechanism.joints import Guide, Mesh, Pin
        from gearlink.core.mechanism.links import FRAME, Link, Mechanism
        from gearlink.core.mechanism.rates import fixed, standing, steady

        geometry = self.design.slider
        r, n = geometry.planet_radius, geometry.cusps
        carrier = Link(fixed(0j, phi, order=order), steady(phi, order=order))
        planet = Link(carrier.at((n - 1) * r), steady(phi, -(n - 1.0), order=order))
        point = planet.at(-r)
        turn, end = slider(point, geometry.rod, 0j, 1.0 + 0j)
        links = {
            "carrier": carrier,
            "planet": planet,
            "rod": Link(point, turn),
            "slider": Link(end, standing(0.0, phi, order=order)),
        }
        tangent = math.tan(signed_pair(self.design.mesh).working_pressure_angle)
        connections: list[Connection] = [
            Pin("O", FRAME, "carrier", carrier.origin.value),
            Pin("planet", "carrier", "planet", planet.origin.value),
            Pin("M", "planet", "rod", point.value),
            Pin("F", "rod", "slider", end.value),
            Guide("guide", FRAME, "slider", end.value, 1.0 + 0j),
            Mesh("mesh_ring", FRAME, "planet", carrier.origin.value, carrier.unit, n * r, r, tangent, True, "carrier"),
        ]
        return Mechanism(links, connections, "carrier", travel={"slider": 1.0 + 0j})
