"""The mechanism of a hypocycloid dwell: carrier, planet in a fixed ring, rod, slider."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

from gearlink.core.mechanism.closures import slider
from gearlink.core.mechanism.courses import coordinate, turned
from gearlink.core.mechanism.joints import Connection, Contact, Guide, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import fixed, standing, steady

if TYPE_CHECKING:
    from gearlink.core.machines.dwell_gears.hypocycloid_design import HypocycloidDwell
    from gearlink.core.numerics.arrays import Reals
    from gearlink.core.studies.movable import Movable


def errors(design: HypocycloidDwell, mechanism: Mechanism) -> Movable:
    """The rod, the carrier, which is the centre distance of planet and ring, and the planet's teeth."""
    from gearlink.core.mechanism.dual import longer
    from gearlink.core.studies.movable import Movable, Turned
    from gearlink.core.studies.tolerance.sources import GearOfSource

    gears, arm = design.spec.gears, design.carrier_length
    ends = {"centers.planet_ring": ("carrier", arm)}
    if not design.spec.is_arm:
        ends["rod.length"] = ("rod", design.slider.rod)
    sizes = longer(mechanism, ends)
    alpha = math.radians(gears.pressure_angle)
    teeth = {name: GearOfSource(gears.module, gears.module * z, alpha) for name, z in
             (("planet", gears.planet), ("ring", gears.ring))}  # fmt: skip
    links = {"planet": "planet", "ring": FRAME}
    return Movable(
        sizes,
        {"planet_ring": arm},
        gears={name: Turned(links[name], each) for name, each in teeth.items()},
        radius=arm if design.spec.is_arm else 0.0,
    )


def motion(design: HypocycloidDwell) -> Motion:
    """Links and joints over the carrier angle from the middle of the dwell's arc; ring's centre at 0, slider on +x."""
    if design.spec.is_arm:
        return _arm_motion(design)
    geometry = design.slider
    r, n, rod = geometry.planet_radius, geometry.cusps, geometry.rod
    tangent = math.tan(design.mesh.working_pressure_angle)

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        carrier = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": (n - 1) * r})
        planet = Link(carrier.at("B"), steady(phi, -(n - 1.0), order=order), {"B": 0.0, "M": -geometry.ratio * r})
        turn, end = slider(planet.at("M"), rod, 0j, 1.0 + 0j)
        links = {
            "carrier": carrier,
            "planet": planet,
            "rod": Link(planet.at("M"), turn, {"M": 0.0, "F": rod}),
            "slider": Link(end, standing(0.0, phi, order=order), {"F": 0.0}),
        }
        center = carrier.origin.value
        connections: list[Connection] = [
            Pin("O", FRAME, "carrier", center),
            Pin("planet", "carrier", "planet", planet.origin.value),
            Pin("M", "planet", "rod", planet.at("M").value),
            Pin("F", "rod", "slider", end.value),
            Guide("guide", FRAME, "slider", end.value, 1.0 + 0j),
            Mesh("mesh_ring", FRAME, "planet", center, carrier.unit, n * r, r, tangent, True, "carrier"),
        ]
        return Mechanism(links, connections, "carrier", travel={"slider": 1.0 + 0j})

    return Motion(make, Input("carrier_angle"), (Output("Slider F, outwards", outwards(design)),))


def _arm_motion(design: HypocycloidDwell) -> Motion:
    """With an arm about the ring's centre, the point in its slot."""
    r, n, arm = design.point_radius, design.arm.teeth, design.arm
    tangent = math.tan(design.mesh.working_pressure_angle)

    def make(phi: Reals, order: int, _side: int) -> Mechanism:
        carrier = Link(fixed(0j, phi, order=order), steady(phi, order=order), {"A": 0.0, "B": (n - 1.0) * r})
        planet = Link(carrier.at("B"), steady(phi, -(n - 1.0), order=order), {"B": 0.0, "M": -arm.ratio * r})
        links = {"carrier": carrier, "planet": planet, "arm": Link(carrier.origin, arm.turn(phi, order))}
        center = carrier.origin.value
        connections: list[Connection] = [
            Pin("O", FRAME, "carrier", center),
            Pin("planet", "carrier", "planet", planet.origin.value),
            Pin("D", FRAME, "arm", center),
            Contact("slot", "arm", "planet", planet.at("M").value, 1j * links["arm"].unit),
            Mesh("mesh_ring", FRAME, "planet", center, carrier.unit, n * r, r, tangent, True, "carrier"),
        ]
        return Mechanism(links, connections, "carrier")

    turns = design.planet_teeth // math.gcd(design.planet_teeth, design.ring_teeth)
    course = turned("arm")
    return Motion(make, Input("carrier_angle", end=2.0 * math.pi * turns, turns=turns), (Output("Arm", course),))


def outwards(design: HypocycloidDwell) -> Course:
    """The way of the slider outwards from the middle of the dwell [mm]."""
    return coordinate("slider").less(design.slider.point(0.0).real + design.slider.rod)
