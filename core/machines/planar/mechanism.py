"""The mechanism of a planar mechanism's file: its links, pins, guides, slots, gears and racks at any input."""

from __future__ import annotations

import cmath
from typing import TYPE_CHECKING, Literal

import numpy as np

from gearlink.core.machines.planar.outputs import moved
from gearlink.core.machines.planar.structure import GearJoint, LineJoint, PinJoint, RackJoint
from gearlink.core.mechanism.joints import Connection, Contact, Coupling, Feed, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn

if TYPE_CHECKING:
    from gearlink.core.machines.planar.cams import CamJoint, Lift
    from gearlink.core.machines.planar.course import Course as Followed
    from gearlink.core.machines.planar.design import PlanarMechanism
    from gearlink.core.machines.planar.structure import Driven, Structure
    from gearlink.core.machines.planar.system import Jets
    from gearlink.core.numerics.arrays import Points, Reals


def motion(design: PlanarMechanism) -> Motion:
    """Links and joints over the input, which counts from the start position, over the period or range of the file.

    Raises
        NoSolution - where the mechanism does not close, jams or does not repeat
    """
    course, structure = design.course, design.structure
    column = "input_position" if course.by_slide else "input_angle"
    unit: Literal["rad", "mm"] = "mm" if course.by_slide else "rad"
    given = Input(column, unit, course.start, course.end, course.turns, course.joints)

    def make(q: Reals, order: int, side: int) -> Mechanism:
        return mechanism(course, q, order, side)

    outputs = []
    for name in structure.spec.shown:
        parts = moved(structure, name)
        outputs += [Output(each.name.replace("_", " ") if len(parts) > 1 else name, each.course(structure.names))
                    for each in parts]  # fmt: skip
    return Motion(make, given, tuple(outputs))


def mechanism(course: Followed, q: Reals, order: int, side: int = 1) -> Mechanism:
    """Links and joints at inputs [rad or mm]."""
    structure = course.structure
    jets, size = course.jets(q, order, side), structure.size
    links = {}
    for body, (name, points) in enumerate(structure.bodies.items()):
        if body:
            place = course.derivatives(lambda jets, k, body=body: jets.x[k][:, body] * size, jets, order)  # type: ignore[misc]
            turn = course.derivatives(lambda jets, k, body=body: jets.t[k][:, body], jets, order)  # type: ignore[misc]
            links[name] = Link(Point(*place), Turn(*turn), points)  # type: ignore[arg-type]
    first = structure.drives[0]
    drive = first.name if first.slide is None else structure.names[first.slide.line.other]
    pivot = next((pin.at_first for pin in structure.pins if (pin.first, pin.second) == (0, first.body)), 0j)
    travel = {
        structure.names[slide.line.other]: cmath.exp(1j * slide.line.direction)
        for slide in structure.slides.values()
        if slide.line.body == 0
    }
    return Mechanism(links, Later(lambda: _joints(course, jets)), drive, pivot=pivot, travel=travel)


def _joints(course: Followed, jets: Jets) -> list[Connection]:
    structure = course.structure
    places = _Places(structure, jets)
    return [
        *(places.pin(pin) for pin in structure.pins),
        *(places.guide(slide) for slide in structure.slides.values()),
        *(places.slot(slot) for slot in structure.slots.values()),
        *(places.teeth(mesh) for mesh in structure.meshes.values()),
        *(places.cam(cam, course.at_start.lifts[name]) for name, cam in structure.cams.items()),
        *(places.train(drive, structure.drives[0]) for drive in structure.drives[1:]),
    ]


class _Places:
    """Where joints are [mm]."""

    def __init__(self, structure: Structure, jets: Jets) -> None:
        self.structure, self.jets = structure, jets
        self.names = (FRAME, *structure.names[1:])

    def _at(self, body: int, place: complex) -> Points:
        size = self.structure.size
        return np.asarray(self.jets.point(body, place / size, 0) * size)

    def _unit(self, body: int, angle: float) -> Points:
        return np.asarray(cmath.exp(1j * angle) * self.jets.e[0][:, body])

    def pin(self, pin: PinJoint) -> Pin:
        return Pin(pin.name, self.names[pin.first], self.names[pin.second], self._at(pin.first, pin.at_first))

    def guide(self, slide: LineJoint) -> Guide:
        line = slide.line
        along = self._unit(line.body, line.direction) if line.body else cmath.exp(1j * line.direction)
        return Guide(slide.name, self.names[line.body], self.names[line.other], self._at(line.other, line.point), along)

    def slot(self, slot: LineJoint) -> Contact:
        line = slot.line
        normal = 1j * self._unit(line.body, line.direction)
        return Contact(
            slot.name, self.names[line.body], self.names[line.other], self._at(line.other, line.point), normal
        )

    def cam(self, cam: CamJoint, lift: Lift) -> Contact:
        """The contact of a cam; of a face where it touches."""
        touch, normal, curvature = cam.contact(lift.angle(self.jets, 0))
        phase = lift.phase
        at = self._at(cam.follower, cam.point)
        if touch is not None:
            at = self.jets.x[0][:, cam.carrier] * self.structure.size + touch * self.jets.e[0][:, cam.carrier]
        turned = np.asarray(normal * self.jets.e[0][:, cam.carrier])
        return Contact(cam.name, self.names[cam.cam], self.names[cam.follower], at, turned, None, curvature,
                       lambda: cam.shapes(phase))  # fmt: skip

    def train(self, driven: Driven, first: Driven) -> Coupling | Feed:
        """What moves a further drive with the first one."""
        shaft, name = self._moved(first), f"drive_{driven.name}"
        at = self.jets.x[0][:, driven.body] * self.structure.size
        if driven.slide is None:
            return Coupling(name, shaft, self.names[driven.body], at, driven.ratio)
        line = driven.slide.line
        along = self._unit(line.body, line.direction)
        place = self._at(line.other, line.point)
        return Feed(name, self.names[line.body], self.names[line.other], place, along, shaft, driven.ratio)

    def _moved(self, driven: Driven) -> str:
        return self.names[driven.body if driven.slide is None else driven.slide.line.other]

    def teeth(self, mesh: GearJoint | RackJoint) -> Mesh | Rack:
        if isinstance(mesh, RackJoint):
            line, side = mesh.line, mesh.side
            along = self._unit(line.body, line.direction) if line.body else cmath.exp(1j * line.direction)
            return Rack(mesh.name, self.names[line.body], self.names[line.other], self._at(line.other, line.point),
                        along, 1j * side * along, mesh.radius, mesh.tangent)  # fmt: skip
        one, other = (self._at(mesh.carrier, place) for place in mesh.at)
        (r1, r2), (first, second) = mesh.radii, (mesh.first, mesh.second)
        if mesh.internal and mesh.teeth[1] < 0:  # the ring counts as first
            one, other, r1, r2, first, second = other, one, r2, r1, second, first
        toward = (other - one) / abs(mesh.at[1] - mesh.at[0])
        return Mesh(mesh.name, self.names[first], self.names[second], one, toward, abs(r1), abs(r2), mesh.tangent,
                    mesh.internal, self.names[mesh.carrier])  # fmt: skip
