"""What the errors of a planar mechanism move: points of links and frame, the lines of slides and slots."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.planar.outputs import point_output
from gearlink.core.machines.planar.structure import GearJoint
from gearlink.core.mechanism.dual import Shift, elements_at
from gearlink.core.mechanism.links import FRAME
from gearlink.core.mechanism.motion import Course
from gearlink.core.studies.register.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.planar.design import PlanarMechanism
    from gearlink.core.machines.planar.structure import Structure
    from gearlink.core.mechanism.links import Mechanism

_AXES = (1.0 + 0j, 1j)


def errors(design: PlanarMechanism, mechanism: Mechanism) -> Movable:
    """Numbers of frame, links, lines of slides and slots; rollers and profiles of cams; gears; the output's point."""
    structure = design.structure
    sizes = {
        key: (Shift(body, _elements(structure, mechanism, body, point), way),)
        for key, body, point, way in _sizes(structure)
    }
    sizes = {key: shifts for key, shifts in sizes.items() if shifts[0].joints}
    for group in (structure.slides, structure.slots):
        for name, joint in group.items():
            kind, body = "slides" if group is structure.slides else "slots", structure.names[joint.line.body]
            sizes |= {f"{kind}.{name}.through[{k}]": (Shift(body, (name,), way),) for k, way in enumerate(_AXES)}
    profiles = {f"cams.{name}.profile": 0.0 for name in structure.cams}
    for name, cam in structure.cams.items():
        outwards = (Shift(structure.names[cam.cam], (name,), 1.0, "normal"),)
        sizes[f"cams.{name}.profile"] = outwards
        if cam.given.face is None:
            sizes[f"cams.{name}.roller_radius"] = outwards
    gears = {name: gear for mesh in structure.spec.meshes for name, gear in _gears(structure, mesh)}
    return Movable(sizes, others=profiles, gears=gears, own=_own(design))


def _sizes(structure: Structure) -> Iterator[tuple[str, str, str, complex]]:
    """Key, body, point, and the way it goes in the body's coordinates."""
    for body, points in structure.bodies.items():
        given = None if body == FRAME else structure.spec.links[body]
        if isinstance(given, list):
            yield f"links.{body}[2]", body, str(given[1]), 1.0 + 0j
            continue
        group = FRAME if body == FRAME else f"links.{body}"
        for point in points:
            yield from ((f"{group}.{point}[{k}]", body, point, way) for k, way in enumerate(_AXES))


def _elements(structure: Structure, mechanism: Mechanism, body: str, point: str) -> tuple[str, ...]:
    """Joints whose element on a body stands at a point of it."""
    place, number = structure.bodies[body][point], structure.numbers[body]
    lines = [
        name
        for group in (structure.slides, structure.slots)
        for name, joint in group.items()
        if joint.line.other == number and abs(joint.line.point - place) <= 1e-9 * structure.size
    ]
    cams = (name for name, cam in structure.cams.items() if (cam.follower, cam.point) == (number, place))
    return (*elements_at(mechanism, body, place), *lines, *cams)


def _gears(structure: Structure, name: str) -> Iterator[tuple[str, Turned]]:
    mesh, alpha = structure.meshes[name], math.radians(structure.spec.meshes[name].pressure_angle)
    if isinstance(mesh, GearJoint):
        for body, z in zip((mesh.first, mesh.second), mesh.teeth, strict=True):
            teeth = GearOfSource(mesh.module, mesh.module * abs(z), alpha)
            yield f"{name}_{structure.names[body]}", Turned(structure.names[body], teeth)


def _own(design: PlanarMechanism) -> dict[str, Course]:
    """What an error of the output's own point adds to it, along its direction."""
    structure, section = design.structure, design.spec.register_
    name = (section.output if section is not None else None) or structure.spec.shown[0]
    if name not in {point for body, points in structure.bodies.items() if body != FRAME for point in points}:
        return {}
    direction = math.radians((section.direction if section is not None else None) or 0.0)
    holder = structure.names[point_output(structure, name)[0].body]
    return {
        key: _along(body, way, direction)
        for key, body, point, way in _sizes(structure)
        if (body, point) == (holder, name)
    }


def _along(body: str, way: complex, direction: float) -> Course:
    line = cmath.exp(-1j * direction)
    return Course("1", lambda mechanism: [np.asarray((mechanism.links[body].unit * way * line).real)])
