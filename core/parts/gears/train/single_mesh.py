"""Quantities and checks of one mesh of gears, external or internal."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from gearlink.core.base.report import Check, Rule, Status
from gearlink.core.parts.gears.checks import (
    FILLET_NOISE,
    GEAR_CHECKS,
    GEAR_QUANTITIES,
    contact_check,
    gear_check,
    gear_quantity,
)
from gearlink.core.parts.gears.codes import FILLET, INTERFERENCE, TIP_FOULING, TIP_THICKNESS, UNDERCUT
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.tooth.teeth import min_shift_no_undercut

if TYPE_CHECKING:
    from gearlink.core.parts.gears.mesh.internal_mesh import InternalMesh

INTERNAL_QUANTITIES = (
    "center_distance",
    "contact_ratio",
    "reference_radius",
    "base_radius",
    "tip_radius",
    "root_radius",
    "tip_pressure_angle",
    "tip_fouling_margin",
)
MESH_QUANTITIES = (*GEAR_QUANTITIES, "tip_fouling_margin")
_OF_RING_TIPS = ("contact_ratio", "tip_pressure_angle", "tip_fouling_margin")
RING_TIPS = FILLET.checks[1]
MESH_CHECKS = (*GEAR_CHECKS, TIP_FOULING.name, RING_TIPS)


def mesh_quantity(mesh: GearPair | InternalMesh, name: str) -> Any:
    """A quantity of a mesh, or None where this kind of mesh has none, or its teeth have none (a check fails there)."""
    if isinstance(mesh, GearPair):
        return gear_quantity(mesh, name) if name in GEAR_QUANTITIES else None
    if name in _OF_RING_TIPS and mesh.ring_tip_margin < 0.0:
        return None
    if name == "tip_fouling_margin" and mesh.tip_circle_margin < 0.0:
        return None
    return getattr(mesh, name) if name in INTERNAL_QUANTITIES else None


def mesh_checks(
    name: str, mesh: GearPair | InternalMesh, limits: Any, label: str = "", shifts: bool = False
) -> list[Check]:
    """The findings of one of MESH_CHECKS on a mesh, which goes by a label where a design has several.

    Source
        ISO 21771 for the quantities
    """
    if not isinstance(mesh, GearPair):
        found = _internal_check(name, mesh, limits)
        return [
            replace(check, message=f"{label.replace('_', '-')} mesh: {check.message}") if label else check
            for check in found
        ]
    return [] if name in (TIP_FOULING.name, RING_TIPS) else list(gear_check(name, mesh, limits, label, shifts))


def _internal_check(name: str, mesh: InternalMesh, limits: Any) -> Iterator[Check]:
    """The findings of one of MESH_CHECKS on an internal mesh, whose root clearance is the standard's."""
    if name == "undercut":
        least = min_shift_no_undercut(mesh.teeth[0], mesh.pressure_angle, mesh.addendum)
        subject, remedy = "the room of the planet's root before undercut, -x_min,", "take more planet teeth"
        yield UNDERCUT.below(0.0 - least, 0.0 - limits.undercut, 0.0, "1", subject, remedy)
    elif name == "involute-interference":
        what, where = "the tips of the ring gear", "the planet's root inside its base circle"
        remedy = "give both more teeth of a smaller module, or the planet alone more"
        if mesh.ring_tip_margin < 0.0:
            where, remedy = "its base circle, where it has no involute", mesh.least_ring
            yield _margin(INTERFERENCE, mesh.ring_tip_margin, what, where, remedy)
        else:
            yield _margin(INTERFERENCE, mesh.interference_margin, what, where, remedy)
    elif name == "tip-fouling":
        what, remedy = "the tips of planet and ring gear", "give the ring gear more teeth, or the planet fewer"
        if mesh.tip_circle_margin < 0.0:
            yield _margin(TIP_FOULING, mesh.tip_circle_margin, what, "each other all round", remedy)
        elif mesh.ring_tip_margin >= 0.0:
            yield _margin(TIP_FOULING, mesh.tip_fouling_margin, what, "each other", remedy)
    elif name == "contact-ratio" and mesh.ring_tip_margin >= 0.0:
        remedy = "take more teeth of a smaller module"
        yield contact_check(mesh.contact_ratio, limits, "the contact ratio", remedy)
    elif name == TIP_THICKNESS.name and mesh.ring_tip_margin >= 0.0:
        yield from gear_check(name, mesh.signed, limits)
    elif name == RING_TIPS and mesh.ring_tip_margin >= 0.0 and mesh.interference_margin > 0.0:
        yield from _ring_tips_on_fillet(mesh)


def _ring_tips_on_fillet(mesh: InternalMesh) -> Iterator[Check]:
    """GL207: tips of full height of a ring, which is hollow, reach deeper into a root than those of the tool's rack.

    Notes
        A warning: the file says nothing of how the teeth are cut.
    """
    from gearlink.core.parts.gears.mesh.contact import PathOfContact

    used, form = PathOfContact(mesh.signed).used_root_radius[0], mesh.signed.form_radius_of(0)
    if form is None:
        return
    margin, limit = used - form, -FILLET_NOISE * mesh.module
    text = f"the ring gear's tips touch the planet down to {used:.7g} mm; cut by a standard tool its flank ends at"
    text += f" {form:.7g} mm"
    if margin < limit:
        text += ": shorten the tips of the ring gear, or shift the profiles"
    yield FILLET.check("warn" if margin < limit else "pass", text, margin, limit, "mm", name=RING_TIPS)


def _margin(rule: Rule, margin: float, what: str, where: str, remedy: str) -> Check:
    status: Status = "fail" if margin < 0.0 else "pass"
    text = f"{what} keep {margin:.4g} mm from cutting into {where}"
    if status == "fail":
        text = f"{what} cut {-margin:.4g} mm into {where}: {remedy}"
    return rule.check(status, text, margin, 0.0, "mm")
