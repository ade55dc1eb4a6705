"""The two meshes of a three-gear drive."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.errors import at_key
from gearlink.core.gears.pair import GearPair
from gearlink.core.three_gear.names import MESHES

if TYPE_CHECKING:
    from gearlink.core.gears.internal_mesh import InternalMesh
    from gearlink.core.three_gear.spec import Gears


def meshes(gears: Gears, idler: int) -> dict[str, GearPair | InternalMesh]:
    """The meshes by name; an internal one is a pair of idler and ring, of standard teeth.

    Parameters
        gears : Gears - the section of the file
        idler : int - teeth of the idler
    """
    if gears.own_teeth:
        from gearlink.core.three_gear.mesh_data import pairs

        return dict(zip(MESHES, pairs(gears, idler), strict=True))
    return {MESHES[0]: _standard(gears, gears.crank, idler), MESHES[1]: _standard(gears, idler, gears.output)}


def _standard(gears: Gears, one: int, other: int) -> GearPair | InternalMesh:
    alpha = math.radians(gears.pressure_angle)
    if min(one, other) > 0:
        return GearPair.from_shift(gears.module, (one, other), (0.0, 0.0), pressure_angle=alpha)
    from gearlink.core.gears.internal_mesh import InternalMesh

    rim = gears.rim if other < 0 else None
    with at_key("gears"):
        return InternalMesh(gears.module, (max(one, other), -min(one, other)), alpha, rim=rim)
