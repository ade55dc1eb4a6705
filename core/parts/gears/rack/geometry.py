"""Where gear and rack stand in mesh: line of action, path of contact, places of both.

Frame: the axis of the gear is the origin, the datum line of the rack stands upright at the distance a; the rack moves
up. Points are complex numbers x + i y.
"""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass

from gearlink.core.base.results import cached_property
from gearlink.core.parts.gears.outline.mesh_geometry import contact_points
from gearlink.core.parts.gears.rack.mesh import RackMesh


@dataclass(frozen=True)
class RackGeometry:
    """A gear on a rack at the moment when two flanks touch at the pitch point; the gear drives counter-clockwise.

    Parameters
        rack : RackMesh
    Returns
        Properties: points in mm, angles in rad.
    Example
        >>> from gearlink.core.parts.gears.rack.mesh import RackData
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> mesh = RackGeometry(RackMesh(RackData(pair=GearPair.from_shift(2.0, (20, 10_000)))))
        >>> round(abs(mesh.contact_end - mesh.contact_start) / mesh.base_pitch - mesh.rack.contact_ratio, 12)
        0.0

    Source
        own derivation; ISO 21771 for the names
    """

    rack: RackMesh

    @property
    def axis(self) -> complex:
        """Axis of the gear [mm]."""
        return 0j

    @cached_property
    def pitch_point(self) -> complex:
        """Where the reference circle rolls on the pitch line [mm]."""
        return complex(self.rack.pair.reference_radius[0])

    @cached_property
    def direction(self) -> complex:
        """Unit vector of the line of action, the way the contact moves."""
        return 1j * cmath.exp(-1j * self.rack.working_pressure_angle)

    def _at(self, rho: float) -> complex:
        return self.pitch_point + (rho - self.rack.path.pitch) * self.direction

    @property
    def contact_start(self) -> complex:
        """A, on the tip line of the rack [mm]."""
        return self._at(self.rack.path.start)

    @property
    def contact_end(self) -> complex:
        """E, on the tip circle of the gear [mm]."""
        return self._at(self.rack.path.end)

    @property
    def base_pitch(self) -> float:
        """p_et [mm], from one contact point to the next."""
        return self.rack.pair.base_pitch

    @cached_property
    def contacts(self) -> list[complex]:
        """All points where flanks touch at this moment [mm]."""
        return contact_points(self.pitch_point, self.base_pitch * self.direction, self.contact_start, self.contact_end)

    @cached_property
    def first_space(self) -> tuple[float, float]:
        """Middle of a tooth space: of the gear its polar angle [rad], of the rack its height y [mm].

        eta = (pi/2 - 2 x tan(alpha_n))/z above the line of centres, r (pi/z - eta) below it
        """
        pair = self.rack.pair
        half = (math.pi / 2.0 - 2.0 * pair.profile_shift[0] * math.tan(pair.pressure_angle)) / pair.teeth[0]
        return half, -pair.reference_radius[0] * (math.pi / pair.teeth[0] - half)
