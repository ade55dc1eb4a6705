"""The gears of a planar mechanism with their tip circles, and the shafts at points of its frame."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.core.machines.planar.structure import GearJoint, RackJoint
from gearlink.core.machines.planar.wiring import FRAME
from gearlink.core.studies.clearance.bodies import FULL_HEIGHT, Gear, Layout, Shaft, least_shaft
from gearlink.core.studies.clearance.reach import reaches

if TYPE_CHECKING:
    from gearlink.core.machines.planar.design import PlanarMechanism

_RIM = 2.0
"""Modules outside the root circle of a ring."""
_FIRST = 0x100
"""Axes are letters to the clearance: beyond those that a file may name."""


def layout(design: PlanarMechanism) -> Layout | None:
    """The gears, taken to lie in one plane, and the shafts; None where there are none.

    Notes
        Gears have standard teeth without shift, tips at z m/2 + m. A gear passes its shaft where its link turns on it.
    """
    structure = design.structure
    axes: dict[tuple[str, complex], str] = {}

    def axis(body: str, place: complex) -> str:
        """The letter of a place; one that a pin joins to another body is that body's."""
        point = next((name for name, at in structure.bodies[body].items() if at == place), None)
        holder = next(name for name, points in structure.bodies.items() if point in points) if point else body
        at = structure.bodies[holder][point] if point else place
        return axes.setdefault((holder, at), chr(_FIRST + len(axes)))

    found: dict[tuple[str, str], Gear] = {}
    for name, mesh in structure.meshes.items():
        if isinstance(mesh, RackJoint):
            _add(
                found,
                _pinion(
                    structure.names[mesh.line.other], axis(structure.names[mesh.line.other], mesh.line.point), mesh
                ),
            )
            continue
        carrier = structure.names[mesh.carrier]
        letters = [axis(carrier, place) for place in mesh.at]
        for k, gear in enumerate((mesh.first, mesh.second)):
            _add(found, _gear(mesh, k, structure.names[gear] if gear else name, letters))
    if not found and not design.spec.shafts:
        return None
    gears = [gear._replace(turns_with=_shafts_of(design, body, axes)) for (body, _), gear in found.items()]
    shafts = [
        Shaft(
            f"shaft at {point}",
            axis(FRAME, complex(*place)),
            design.spec.shafts.get(f"{point}_radius"),
            f"shafts.{point}_radius",
        )
        for point, place in design.spec.frame.items()
        if f"{point}_radius" in design.spec.shafts
        or any(gear.axis == axes.get((FRAME, complex(*place))) for gear in gears)
    ]
    placed = {letter: key for key, letter in axes.items()}
    pairs = {"".join(sorted(one + other)) for one in placed for other in placed if one < other}
    return Layout(
        tuple(gears),
        tuple(shafts),
        reaches(design.moving, placed, sorted(pairs), samples=design.course.samples),
        least_shaft(design.spec.limits, max((mesh.module for mesh in structure.meshes.values()), default=0.0)),
    )


def _add(found: dict[tuple[str, str], Gear], made: tuple[str, Gear]) -> None:
    """A gear, or more mates of one that is there."""
    body, gear = made
    known = found.get((body, gear.axis))
    found[body, gear.axis] = (
        gear if known is None else known._replace(mates=known.mates + gear.mates, outer=max(known.outer, gear.outer))
    )


def _pinion(body: str, axis: str, mesh: RackJoint) -> tuple[str, Gear]:
    tip = mesh.radius + mesh.module
    return body, Gear(f"the pinion {body}", axis, tip, root=tip - FULL_HEIGHT * mesh.module)


def _gear(mesh: GearJoint, k: int, body: str, letters: list[str]) -> tuple[str, Gear]:
    teeth, mate = mesh.teeth[k], letters[1 - k]
    pitch = 0.5 * mesh.module * abs(teeth)
    if teeth < 0:
        outer = pitch + (0.5 * FULL_HEIGHT + 0.125 + _RIM) * mesh.module
        return body, Gear(f"the ring {body}", letters[k], outer, pitch - mesh.module, mate)
    tip = pitch + mesh.module
    return body, Gear(f"the gear {body}", letters[k], tip, mates=mate, root=tip - FULL_HEIGHT * mesh.module)


def _shafts_of(design: PlanarMechanism, body: str, axes: dict[tuple[str, complex], str]) -> str:
    """Letters of the axes of the frame that the gear's own link turns on."""
    points = design.structure.bodies.get(body, {})
    frame = design.structure.bodies[FRAME]
    return "".join(axes.get((FRAME, frame[point]), "") for point in points if point in frame)
