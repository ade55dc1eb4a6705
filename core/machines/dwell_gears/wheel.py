"""The teeth of a mutilated wheel: how far the first and the last tooth of a group are cut down."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.pair import GearPair

_CHORD = 1e-4  # of the module


def free_radius(mesh: GearPair) -> float:
    """Radius about the wheel's axis up to which the resting gear leaves room, but for the tooth in the gap [mm].

    min |a - p| over the points p of the driven gear outside the tooth that stands on the line of centres

    Parameters
        mesh : GearPair - wheel and driven gear
    Returns
        radius : float [mm] - that of the reference circle where the driven gear has no such teeth
    Notes
        To 1e-4 of the module, on the safe side.
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> mesh = GearPair.from_shift(3.0, (80, 20))
        >>> mesh.root_radius[0] < free_radius(mesh) < mesh.tip_radius[0]
        True
    """
    half_pitch = math.pi / mesh.teeth[1]
    try:
        teeth = outline(ToothProfile.of(mesh, 1), _CHORD * mesh.module)
    except NoSolution:
        return mesh.reference_radius[0]
    from_tooth = teeth * np.exp(-1j * half_pitch)
    others = from_tooth[np.abs(np.angle(from_tooth)) > half_pitch]
    return float(np.abs(mesh.center_distance - others).min()) - _CHORD * mesh.module


def end_tooth_radius(mesh: GearPair) -> float:
    """Radius to which the first and the last tooth of a group are cut down, about the wheel's axis [mm].

    The free radius; the tip radius where that leaves the tooth whole, the root radius where it leaves none.

    Parameters
        mesh : GearPair - wheel and driven gear
    Example
        >>> from gearlink.core.parts.gears.mesh.pair import GearPair
        >>> mesh = GearPair.from_shift(3.0, (80, 20))
        >>> end_tooth_radius(mesh) == free_radius(mesh)
        True
    """
    return max(mesh.root_radius[0], min(free_radius(mesh), mesh.tip_radius[0]))
