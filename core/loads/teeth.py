"""What the teeth of a machine are rated for, and what they push along their axes, beside its loads in the plane."""

from __future__ import annotations

import itertools
import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.core.mechanism.joints import Pin
from gearlink.core.mechanism.links import FRAME

if TYPE_CHECKING:
    from gearlink.core.loads.design import LoadsDesign
    from gearlink.core.loads.joints import MeshLoad
    from gearlink.core.mechanism.joints import Connection

_MEAN_STRESS = 0.4
"""M of tempered steel."""


def rated_forces(design: LoadsDesign) -> dict[str, float]:
    """Tangential forces at the pitch circles for which the file has the teeth rated [N], K_A counted, by mesh.

    F_t K_A r/r_w
    """
    machine, keys = _with_gears(design)
    if getattr(keys, "load", None) is None:
        return {}
    found = {}
    for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False):
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
    plays = {name: data.backlash for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False)}
    return {name: play.circumferential[1] for name, play in plays.items() if play is not None}


def thrust(design: LoadsDesign, pin: str) -> float:
    """Greatest axial force of the helical teeth that a pin holds [N], which forces in the plane do not show; or 0.

    F_a = F_t tan(beta_w),   tan(beta_w) = tan(beta) r_w/r

    Parameters
        pin : str - of a gear, or of the link that a gear is fixed to
    """
    machine, keys = _with_gears(design)
    if not getattr(keys, "helix_angle", 0.0):
        return 0.0
    connections = {each.name: each for each in design.machine.at(np.zeros(1)).connections}
    pins = [_links_of(each) for each in connections.values() if isinstance(each, Pin)]
    held = _links_of(connections[pin])
    found = [0.0]
    for name, data in zip(_drawn(design), machine.mesh_data.values(), strict=False):
        gears = _links_of(connections[name])
        on_one_pin = [links for gear in gears if len(links := [each for each in pins if gear in each]) == 1]
        if held & gears.union(*itertools.chain(*on_one_pin)):  # a gear on one pin pushes the link that carries it
            share = math.tan(data.pair.helix_angle) * data.pair.working_radius[0] / data.pair.reference_radius[0]
            found.append(abs(share) * design.meshes_found[name].tooth_force_max)
    return max(found)


def _links_of(connection: Connection) -> set[str]:
    """The moving links that it joins."""
    return {getattr(connection, "first", FRAME), connection.second} - {FRAME}


def _drawn(design: LoadsDesign) -> list[str]:
    """The meshes that a design has; those whose gears the file draws come first."""
    return [name for name in design.meshes if design.has(name)]


def _with_gears(design: Any) -> tuple[Any, Any]:
    """The part of a machine that knows its meshes, and the section with their keys."""
    machine = design if hasattr(type(design), "mesh_data") else design.design
    spec = machine.spec
    return machine, getattr(spec, "gears", None) or getattr(spec, "input_gears", None) or spec
