"""The mechanism of a planar mechanism's file at any input, and what the errors of its parts move."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from typing import TYPE_CHECKING, Literal

import numpy as np

from gearlink.core.machines.planar.outputs import moved, point_output, transmission
from gearlink.core.machines.planar.structure import Driven, GearJoint, Line, LineJoint, PinJoint, RackJoint, Structure
from gearlink.core.mechanism.dual import Shift
from gearlink.core.mechanism.joints import Connection, Contact, Coupling, Feed, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME, Later, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn
from gearlink.core.studies.movable import Movable, Turned
from gearlink.core.studies.tolerance.sources import GearOfSource

if TYPE_CHECKING:
    from gearlink.core.machines.planar.cams import CamJoint, Lift
    from gearlink.core.machines.planar.course import Course as Followed
    from gearlink.core.machines.planar.design import PlanarMechanism
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
    least = transmission(structure, course.dyads) if course.dyads else None
    return Motion(make, given, tuple(outputs), transmission=least)


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

    def _on_line(self, line: Line) -> tuple[str, str, Points]:
        """Names of the body of a line and of the one that it guides, and the point of that."""
        return self.names[line.body], self.names[line.other], self._at(line.other, line.point)

    def _along(self, line: Line) -> Points | complex:
        return self._unit(line.body, line.direction) if line.body else cmath.exp(1j * line.direction)

    def guide(self, slide: LineJoint) -> Guide:
        return Guide(slide.name, *self._on_line(slide.line), self._along(slide.line))

    def slot(self, slot: LineJoint) -> Contact:
        line = slot.line
        return Contact(slot.name, *self._on_line(line), 1j * self._unit(line.body, line.direction))

    def cam(self, cam: CamJoint, lift: Lift) -> Contact:
        """The contact of a cam; of a face where it touches."""
        touch, normal, curvature = cam.contact(lift.angle(self.jets, 0))
        phase = lift.phase
        at = self._at(cam.follower, cam.point)
        if touch is not None:
            at = self.jets.x[0][:, cam.carrier] * self.structure.size + touch * self.jets.e[0][:, cam.carrier]
        turned = np.asarray(normal * self.jets.e[0][:, cam.carrier])
        return Contact(cam.name, self.names[cam.cam], self.names[cam.follower], at, turned, None, curvature,
                       lambda: cam.shapes(phase), slides=touch is not None)  # fmt: skip

    def train(self, driven: Driven, first: Driven) -> Coupling | Feed:
        """What moves a further drive with the first one."""
        shaft, name = self._moved(first), f"drive_{driven.name}"
        at = self.jets.x[0][:, driven.body] * self.structure.size
        if driven.slide is None:
            return Coupling(name, shaft, self.names[driven.body], at, driven.ratio)
        line = driven.slide.line
        return Feed(name, *self._on_line(line), self._unit(line.body, line.direction), shaft, driven.ratio)

    def _moved(self, driven: Driven) -> str:
        return self.names[driven.body if driven.slide is None else driven.slide.line.other]

    def teeth(self, mesh: GearJoint | RackJoint) -> Mesh | Rack:
        if isinstance(mesh, RackJoint):
            along, side = self._along(mesh.line), mesh.side
            return Rack(mesh.name, *self._on_line(mesh.line), along, 1j * side * along, mesh.radius, mesh.tangent)
        one, other = (self._at(mesh.carrier, place) for place in mesh.at)
        (r1, r2), (first, second) = mesh.radii, (mesh.first, mesh.second)
        if mesh.internal and mesh.teeth[1] < 0:  # the ring counts as first
            one, other, r1, r2, first, second = other, one, r2, r1, second, first
        toward = (other - one) / abs(mesh.at[1] - mesh.at[0])
        return Mesh(mesh.name, self.names[first], self.names[second], one, toward, abs(r1), abs(r2), mesh.tangent,
                    mesh.internal, self.names[mesh.carrier])  # fmt: skip


_AXES = (1.0 + 0j, 1j)


def errors(design: PlanarMechanism, _mechanism: Mechanism) -> Movable:
    """Numbers of frame, links, lines of slides and slots; rollers and profiles of cams; gears; the output's point."""
    structure = design.structure
    sizes = {key: (Shift(body, _elements(structure, body, point), way),) for key, body, point, way in _sizes(structure)}
    sizes = {key: shifts for key, shifts in sizes.items() if shifts[0].joints}
    for group in (structure.slides, structure.slots):
        for name, joint in group.items():
            kind, body = "slides" if group is structure.slides else "slots", structure.names[joint.line.body]
            sizes |= {f"{kind}.{name}.through[{k}]": (Shift(body, (name,), way),) for k, way in enumerate(_AXES)}
            sizes[f"{kind}.{name}.direction"] = (_turned(body, name, 1, joint.line.through),)
            if joint.lean is not None:
                on_line = structure.names[joint.line.other]
                sizes[f"{kind}.{name}.angle"] = (_turned(on_line, name, -1, joint.line.point),)
    profiles = {f"cams.{name}.profile": 0.0 for name in structure.cams}
    for name, cam in structure.cams.items():
        link = structure.names[cam.cam]
        outwards = (Shift(link, (name,), 1.0, "normal"),)
        sizes[f"cams.{name}.profile"] = outwards
        sizes[f"cams.{name}.phase"] = (_turned(link, name, cam.sense, cam.bore),)
        if cam.given.face is None:
            sizes[f"cams.{name}.roller_radius"] = outwards
        else:
            sizes[f"cams.{name}.face"] = (_turned(structure.names[cam.follower], name, 1, cam.point),)
    gears = {name: gear for mesh in structure.spec.meshes for name, gear in _gears(structure, mesh)}
    return Movable(sizes, others=profiles, gears=gears, own=_own(design))


def _turned(body: str, joint: str, sense: int, about: complex) -> Shift:
    """The element of a joint on a body, turned about a point of it by each degree of a key."""
    return Shift(body, (joint,), sense * math.radians(1.0), turned=True, about=about)


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


def _elements(structure: Structure, body: str, point: str) -> tuple[str, ...]:
    """Joints whose element on a body stands at a point of it, by its name: another point may lie at the same place."""
    spec = structure.spec
    pins = [name for name, bodies in structure.pins_at(point).items() if body in bodies]
    gears = [
        name
        for name, mesh in spec.meshes.items()
        if mesh.gears is not None and (body, point) in zip(mesh.gears, mesh.at, strict=True)
    ]
    slides = [
        name
        for name, slide in spec.slides.items()
        if slide.link == body and (slide.point or next(iter(structure.bodies[body]))) == point
    ]
    slots = [
        name
        for name, slot in spec.slots.items()
        if slot.point == point and structure.names[structure.slots[name].line.other] == body
    ]
    cams = [name for name, cam in spec.cams.items() if (cam.follower, cam.point) == (body, point)]
    return (*pins, *gears, *slides, *slots, *cams)


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
