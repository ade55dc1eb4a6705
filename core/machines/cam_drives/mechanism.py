"""The mechanisms of gears or links with cams: links and joints over the input angle."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.mechanism.closures import dyad
from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.dual import Shift, longer
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn, fixed, mixed, standing, steady
from gearlink.core.studies.movable import Movable
from gearlink.core.studies.tolerance.sources import CAM_PROFILE

DEGREE = math.pi / 180.0

if TYPE_CHECKING:
    from gearlink.core.machines.cam_drives.grooved import CamGear, CamLinkage, Grooved
    from gearlink.core.machines.cam_drives.linked import LinkedCams
    from gearlink.core.numerics.arrays import Reals


def _groove(design: Grooved, phi: Reals, on: str) -> Contact:
    """The roller in the groove of the frame: a force of either sense along the normal."""
    path = design.path(phi)
    normal = 1j * path.first / np.abs(path.first)
    bend = (np.conj(path.first) * path.second).imag / np.abs(path.first) ** 3
    return Contact("groove", FRAME, on, path.place, np.asarray(normal), None, np.asarray(-bend))


def _inner(joints: tuple[float, ...]) -> tuple[float, ...]:
    return tuple(joint for joint in joints if joint > 0.0)


def cam_gear(design: CamGear) -> Motion:
    """Carrier on +x at input angle 0, both gears' axis and the input's at 0."""
    design.require_closed()
    pair, length, arm = design.gear_data.pair, design.carrier_length, design.spec.lever.length
    one, other = pair.working_radius
    tangent = math.tan(pair.working_pressure_angle)

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        axis = fixed(0j, phi, order=order)
        carrier = Link(axis, steady(phi, order=order), {"A": 0.0, "B": length})
        lever = Turn(*design.lever(phi, order, side))
        planet = Link(carrier.at("B"), mixed((1.0, carrier.turn), (1.0, lever)), {"B": 0.0, "P": arm})
        links = {"carrier": carrier, "planet": planet,
                 "sun": Link(axis, Turn(*design.output_motion.evaluate(phi, order, side=side)))}  # fmt: skip
        joints: list[Connection] = [
            Pin("A", FRAME, "carrier", axis.value),
            Pin("B", "carrier", "planet", planet.origin.value),
            Pin("D", FRAME, "sun", axis.value),
            Mesh("mesh", "sun", "planet", axis.value, carrier.unit, one, other, tangent, False, "carrier"),
            _groove(design, phi, "planet"),
        ]
        return Mechanism(links, joints, "carrier")

    joints = _inner(design.output_motion.joints)
    return Motion(make, Input(joints=joints), (Output("Sun", turned("sun")),))


def cam_gear_errors(design: CamGear, mechanism: Mechanism) -> Movable:
    """Lever, centre distance and the groove; the error is measured at the sun's pitch circle."""
    ends = {"centers.gears": ("carrier", design.carrier_length)}
    outwards = (Shift(FRAME, ("groove",), 1.0, "normal"),)
    return Movable(
        longer(mechanism, ends) | {"lever.length": (Shift("planet", ("groove",)),), CAM_PROFILE: outwards},
        {"gears": design.carrier_length},
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("planet", ("groove",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=design.gear_data.pair.working_radius[0],
    )


def five_bar(design: CamLinkage, phi: Reals, order: int, side: int) -> dict[str, Link]:
    """Input, coupler, follower and output; A at 0, E on +x."""
    given = design.spec.links
    value, *rates = design.output_motion.evaluate(phi, order, side=side)
    angle = Turn(value + design.spec.phase * DEGREE, *rates)
    first = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": given.input})
    last = Link(fixed(given.frame, phi, order=order), angle, {"E": 0.0, "D": given.output})
    coupler, follower = dyad(first.at("B"), last.at("D"), given.coupler, given.follower, design.spec.assembly)
    return {
        "input": first,
        "coupler": Link(first.at("B"), coupler, {"B": 0.0, "C": given.coupler}),
        "follower": Link(last.at("D"), follower, {"D": 0.0, "C": given.follower}),
        "output": last,
    }


def cam_linkage(design: CamLinkage) -> Motion:
    """Links and joints over the input angle, AB on +x at 0."""
    design.require_closed()

    def make(phi: Reals, order: int, side: int) -> Mechanism:
        links = five_bar(design, phi, order, side)
        joints: list[Connection] = [
            Pin("A", FRAME, "input", links["input"].origin.value),
            Pin("B", "input", "coupler", links["coupler"].origin.value),
            Pin("C", "coupler", "follower", links["coupler"].at("C").value),
            Pin("D", "output", "follower", links["follower"].origin.value),
            Pin("E", FRAME, "output", links["output"].origin.value),
            _groove(design, phi, "coupler"),
        ]
        return Mechanism(links, joints, "input")

    start = math.radians(design.spec.phase)
    output = Output("Output link ED", turned("output").less(start) if start else turned("output"))
    return Motion(make, Input(joints=_inner(design.output_motion.joints)), (output,))


def cam_linkage_errors(design: CamLinkage, mechanism: Mechanism) -> Movable:
    """The links, the groove, and the roller's pin."""
    given = design.spec.links
    ends = {f"links.{name}": (name, getattr(given, name)) for name in ("input", "follower", "output")}
    sizes = longer(mechanism, ends)
    sizes["links.coupler"] = (Shift("coupler", ("C", "groove")),)
    return Movable(
        sizes | {CAM_PROFILE: (Shift(FRAME, ("groove",), 1.0, "normal"),)},
        others={CAM_PROFILE: 0.0},
        pins={"roller": (Shift("coupler", ("groove",), 1.0, "frame"),)},
        rollers=("roller",),
        radius=given.output,
    )


def linked_cams(design: LinkedCams) -> Motion:
    """Shaft at 0 with both cams, a slide along x, a slide along y, and the table that both move."""
    cams = design.cams

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        x, y = (design.coordinate(axis, phi, order) for axis in (0, 1))
        level = standing(0.0, phi, order=order)
        links = {
            "cam": Link(fixed(0j, phi, order=order), steady(phi, order=order)),
            "slide_x": Link(_along(x, 1.0, design.spec.cams.x.base_radius - design.lowest[0]), level),
            "slide_y": Link(_along(y, 1j, design.spec.cams.y.base_radius - design.lowest[1]), level),
            "table": Link(Point(*(one + 1j * other for one, other in zip(x, y, strict=True))), level),
        }
        place = links["table"].origin.value
        joints: list[Connection] = [
            Pin("O", FRAME, "cam", links["cam"].origin.value),
            Guide("guide_x", FRAME, "slide_x", links["slide_x"].origin.value, 1.0 + 0j),
            Guide("guide_y", FRAME, "slide_y", links["slide_y"].origin.value, 1j),
            Guide("cross", "slide_x", "table", place, 1j),
            Contact("push_y", "slide_y", "table", place, np.full_like(place, 1j)),
        ]
        for cam, name in zip(cams, ("x", "y"), strict=True):
            at = links[f"slide_{name}"].origin.value
            joints.append(Contact(f"roller_{name}", "cam", f"slide_{name}", at, cam.normals(phi)))
        travel = {"slide_x": 1.0 + 0j, "slide_y": 1j}
        return Mechanism(links, joints, "cam", travel=travel)

    outputs = (Output("x", coordinate("table")), Output("y", coordinate("table", along=1j)))
    return Motion(make, Input(joints=_inner(design.joints)), outputs)


def _along(rates: list[Reals], way: complex, start: float) -> Point:
    """A slide that moves along a direction; its place is its roller's."""
    value, *others = rates
    return Point(np.asarray(way * (value + start)), *(np.asarray(way * each) for each in others))


def linked_errors(_design: LinkedCams, _mechanism: Mechanism) -> Movable:
    """Rollers and profiles: what an error of the radius of one, or of the size of its cam, does to the path."""
    outwards = {name: (Shift("cam", (f"roller_{name}",), 1.0, "normal"),) for name in ("x", "y")}
    profiles = {f"cams.{name}.profile": shifts for name, shifts in outwards.items()}
    rollers = {f"cams.{name}.roller_radius": shifts for name, shifts in outwards.items()}
    return Movable(rollers | profiles, others=dict.fromkeys(profiles, 0.0))
