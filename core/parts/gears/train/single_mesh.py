"""Quantities and checks of one mesh of gears, external or internal."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Check, Shown
from gearlink.core.parts.gears.checks import (
    FILLET_NOISE,
    GEAR_CHECKS,
    GEAR_QUANTITIES,
    fouling_check,
    gear_check,
    gear_quantity,
)
from gearlink.core.parts.gears.codes import CONTACT_RATIO, FILLET, INTERFERENCE, TIP_FOULING, TIP_THICKNESS, UNDERCUT
from gearlink.core.parts.gears.drawing_names import GEARS, Roles
from gearlink.core.parts.gears.mesh.pair import GearPair, least_ring

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference

MESH_QUANTITIES = (*GEAR_QUANTITIES, "tip_fouling_margin")
RING_TIPS = FILLET.checks[1]
MESH_CHECKS = (*GEAR_CHECKS, TIP_FOULING.name, RING_TIPS)
_WITHOUT_INVOLUTES = ("center_distance", "reference_radius", "base_radius", "tip_radius", "root_radius")
"""What a ring whose tips lie inside its base circle still has."""
_OF_PLANET: Roles = ("the planet", "the ring gear")


def mesh_quantity(mesh: GearPair, name: str) -> Any:
    """A quantity of standard teeth, or None where this kind of mesh has none, or its teeth have none (a check fails
    there).
    """
    if mesh.internal and mesh.ring_tip_margin < 0.0 and name not in _WITHOUT_INVOLUTES:
        return None
    if name in GEAR_QUANTITIES:
        return gear_quantity(mesh, name)
    return _interference(mesh).tip_fouling_margin if name == "tip_fouling_margin" and mesh.internal else None


def _interference(mesh: GearPair) -> InternalInterference:
    from gearlink.core.parts.gears.mesh.ring_cutter import InternalInterference

    return InternalInterference(mesh)


def mesh_checks(
    name: str, mesh: GearPair, limits: Any, label: str = "", shifts: bool = False, roles: Roles = GEARS
) -> list[Check]:
    """The findings of one of MESH_CHECKS on standard teeth in mesh, which go by a label where a design has several.

    Source
        ISO 21771 for the quantities
    """
    if not mesh.internal:
        return (
            [] if name in (TIP_FOULING.name, RING_TIPS) else list(gear_check(name, mesh, limits, label, shifts, roles))
        )
    before = f"{label.replace('_', '-')} mesh: " if label else ""
    return [replace(check, what=before + check.what) for check in _in_ring(name, mesh, limits)]


def _in_ring(name: str, mesh: GearPair, limits: Any) -> Iterator[Check]:
    """The findings on a planet in its ring, whose root clearance and tooth form are the standard's."""
    involutes, internal = mesh.ring_tip_margin >= 0.0, _interference(mesh)
    if name == TIP_FOULING.name and (involutes or internal.tip_circles_apart < 0.0):
        yield from fouling_check(internal, _OF_PLANET)
    elif name == INTERFERENCE.name and not involutes:
        yield _without_involutes(mesh)
    elif name == INTERFERENCE.name:  # the planet's tips do not come near the ring's base circle
        yield list(gear_check(name, mesh, limits, roles=_OF_PLANET))[1]
    elif name == UNDERCUT.name or (name in (CONTACT_RATIO.name, TIP_THICKNESS.name) and involutes):
        yield from gear_check(name, mesh, limits, roles=_OF_PLANET)
    elif name == RING_TIPS and involutes and internal.involute_margin > 0.0:
        yield from _ring_tips_on_fillet(mesh)


def _without_involutes(mesh: GearPair) -> Check:
    teeth, margin = least_ring(mesh), mesh.ring_tip_margin
    fix = "take a larger pressure angle" if teeth is None else f"give the ring gear at least {teeth} teeth"
    what = "tips of the ring gear within its base circle"
    return INTERFERENCE.check("fail", what, margin, 0.0, "mm", overlap=what, aside="no involute there", fix=fix)


def _ring_tips_on_fillet(mesh: GearPair) -> Iterator[Check]:
    """GL207: tips of full height of a ring, which is hollow, reach deeper into a root than those of the tool's rack.

    Notes
        A warning: the file says nothing of how the teeth are cut.
    """
    from gearlink.core.parts.gears.mesh.contact import PathOfContact

    used, form = PathOfContact(mesh).used_root_radius[0], mesh.form_radius_of(0)
    if form is None:
        return
    margin, limit = used - form, -FILLET_NOISE * mesh.module
    yield FILLET.check(
        "warn" if margin < limit else "pass",
        "start of the ring gear's contact at the root of the planet",
        margin,
        limit,
        "mm",
        name=RING_TIPS,
        shown=Shown(used, form, "mm"),
        aside="form radius by a standard tool",
        fix="shorten the tips of the ring gear",
    )
