"""What the teeth of a machine are rated for, and what they push along their axes, beside its loads in the plane."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from gearlink.core.loads.design import LoadsDesign
    from gearlink.core.loads.joints import MeshLoad

_MEAN_STRESS = 0.4
"""M of tempered steel."""


def rated_forces(design: LoadsDesign) -> dict[str, float]:
    """Tangential forces at the pitch circles for which the file has the teeth rated [N], K_A counted, by mesh.

    F_t K_A r/r_w
    """
    machine, keys = _with_gears(design)
    if getattr(keys, "load", None) is None:
        return {}
    names = [name for name in design.meshes if design.has(name)]
    found = {}
    for name, data in zip(names, machine.mesh_data.values(), strict=True):
        force, pair = data.flank.tangential_force, data.pair
        found[name] = force * data.load.factors.application * pair.reference_radius[0] / pair.working_radius[0]
    return found


def bending_force(mesh: MeshLoad) -> float:
    """Force on one flank that bends teeth of tempered steel as those on both do, F + (1 - M)/(1 + M) F_back [N].

    Notes
        The mean stress influence of a load from -F_back to F, Y_M = 1/(1 + (1 - M)/(1 + M) F_back/F) with M = 0.4: of
        F_back = F the 0.7 with which idlers are rated.
    Source
        ISO 6336-3, annex B
    """
    return mesh.tooth_force_max + (1.0 - _MEAN_STRESS) / (1.0 + _MEAN_STRESS) * mesh.tooth_force_back


def drawn_play(design: LoadsDesign) -> dict[str, float]:
    """Greatest circumferential backlash that the gears as drawn leave [mm], by mesh; empty without allowances."""
    machine, keys = _with_gears(design)
    if getattr(keys, "allowances", None) is None:
        return {}
    names = [name for name in design.meshes if design.has(name)]
    plays = {name: data.backlash for name, data in zip(names, machine.mesh_data.values(), strict=True)}
    return {name: play.circumferential[1] for name, play in plays.items() if play is not None}


def thrust(design: LoadsDesign) -> float:
    """Greatest axial force of helical teeth [N], which forces in the plane do not show; 0 of spur gears.

    F_a = F_t tan(beta_w),   tan(beta_w) = tan(beta) r_w/r
    """
    machine, keys = _with_gears(design)
    if not getattr(keys, "helix_angle", 0.0):
        return 0.0
    pairs = [data.pair for data in machine.mesh_data.values()]
    shares = [math.tan(pair.helix_angle) * pair.working_radius[0] / pair.reference_radius[0] for pair in pairs]
    return float(max(shares) * max(mesh.tooth_force_max for mesh in design.meshes_found.values()))


def _with_gears(design: Any) -> tuple[Any, Any]:
    """The part of a machine that knows its meshes, and the section with their keys."""
    machine = getattr(design, "design", design)
    return machine, getattr(machine.spec, "gears", machine.spec)
