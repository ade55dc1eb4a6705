"""The mechanism of a geared six-bar: five links, the free gears inside the trains, all meshes on their carriers."""

from __future__ import annotations

import math
from functools import partial
from itertools import pairwise
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.machines.six_bar.spec import HOLDING, LINKS, PINS, SixTrain, gear_bodies
from gearlink.core.mechanism.courses import turned
from gearlink.core.mechanism.joints import Connection, Mesh, Pin
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course, Input, Motion, Output
from gearlink.core.mechanism.rates import Point, Turn, fixed, from_start, mixed, standing, steady

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.design import GearedSixBar
    from gearlink.core.numerics.arrays import Points, Reals
    from gearlink.core.studies.movable import Movable


def errors(design: GearedSixBar, mechanism: Mechanism) -> Movable:
    """Links, where they carry a mesh its centre distance, and the runout of free gears; measured at the pin E."""
    from gearlink.core.mechanism.dual import longer
    from gearlink.core.studies.movable import Movable, Turned

    ends = {f"links.{name}": (name, length) for name, length in zip(LINKS[1:], design.lengths[1:], strict=True)}
    sizes = longer(mechanism, ends | {"links.frame": (FRAME, design.lengths[0])})
    centers = {name: design.lengths[LINKS.index(name)] for name in LINKS if getattr(design.spec.links, name) is None}
    sizes |= {f"centers.{name}": sizes[f"links.{name}"] for name in centers}
    gears = {}
    for number, train in enumerate(design.spec.trains, start=1):
        for name, z in list(zip(gear_bodies(train, number), train.gears, strict=True))[1:-1]:
            gears[name] = Turned.of(name, train, z)
    return Movable(sizes, centers, gears=gears, radius=design.lengths[5])


def motion(design: GearedSixBar) -> Motion:
    """Links and joints over the input angle, A at 0 and F on +x, over the period or the range of the file.

    Raises
        NoSolution - where a dead centre is met on the way
    """
    course = design.course
    given = Input(start=course.start, end=course.end, turns=course.period_turns)
    outputs = (Output("Output link EF", output(design)),)
    return Motion(partial(_at, design), given, outputs, transmission=transmission(design))


def output(design: GearedSixBar) -> Course:
    """Direction F->E, in (-180, 180] deg at input angle 0."""
    return turned("output").less(math.pi - (design.start_directions[3] - design.bar.start_angles[3]))


def transmission(design: GearedSixBar) -> Course:
    """Angle between the velocities by which the two free directions close the loop."""

    def of(mechanism: Mechanism) -> list[Reals]:
        directions = [mechanism.links[name].turn.value for name in LINKS[2:]]
        return [design.bar.transmission(np.vstack([*directions[:3], directions[3] - math.pi]))]

    return Course("rad", of)


def pins(design: GearedSixBar, phi: Reals) -> list[Points]:
    """The pins A to F at input angles [mm]."""
    links = design.moving.at(phi, 0).links
    return [links[name].origin.value for name in LINKS[1:5]] + [links["output"].at(place).value for place in "EF"]


def _at(design: GearedSixBar, phi: Reals, order: int, _side: int) -> Mechanism:
    """All links and joints at input angles."""
    links, places, turns = _loop(design, phi, order)
    joints: list[Connection] = [
        Pin(pin, first, second, place.value)
        for pin, first, second, place in zip(PINS, HOLDING, (*LINKS[1:], "output"), places, strict=True)
    ]
    for number, train in enumerate(design.spec.trains, start=1):
        links |= _free_gears(train, number, places, turns)
        joints += _gears(train, number, links, places)
    return Mechanism(links, joints, "input")


def _loop(design: GearedSixBar, phi: Reals, order: int) -> tuple[dict[str, Link], list[Point], list[Turn]]:
    """The five links, the six pins, and what all six links have turned since the start, the frame first."""
    directions, lengths = zip(*design.course.rates(phi, order), strict=True), design.lengths
    turns = [steady(phi, order=order), *(Turn(*rows) for rows in directions)]
    links, places = {}, [fixed(0j, phi, order=order)]
    for name, turn, length, ends in zip(LINKS[1:5], turns[:4], lengths[1:5], pairwise(PINS[:5]), strict=True):
        links[name] = Link(places[-1], turn, dict(zip(ends, (0.0, length), strict=True)))
        places.append(links[name].at(length))
    places.append(fixed(lengths[0], phi, order=order))
    # The loop runs from E to F, the x axis of the output from its pivot F to E.
    links["output"] = Link(places[-1], from_start(turns[4], -math.pi), {"F": 0.0, "E": lengths[5]})
    starts = (0.0, *design.bar.start_angles)
    since = [from_start(turn, start) for turn, start in zip(turns, starts, strict=True)]
    return links, places, [standing(0.0, phi, order=order), *since]


def _free_gears(train: SixTrain, number: int, places: list[Point], turns: list[Turn]) -> dict[str, Link]:
    """The gears between the ends of a train, by Willis's equation from its first one on; x along the frame at 0."""
    links, gear = {}, turns[train.first_pin]
    for k, name in enumerate(gear_bodies(train, number)[1:-1], start=1):
        at = (train.first_pin + k) % 6
        ratio = train.gears[k - 1] / train.gears[k]
        gear = mixed((1.0 + ratio, turns[at]), (-ratio, gear))
        links[name] = Link(places[at], gear)
    return links


def _gears(train: SixTrain, number: int, links: dict[str, Link], places: list[Point]) -> list[Connection]:
    """The pins of a train's free gears, and its meshes, which join the links."""
    bodies = gear_bodies(train, number)
    pins: list[Connection] = []
    for pin, body in list(zip(train.pins, bodies, strict=True))[1:-1]:
        at = PINS.index(pin)
        pins.append(Pin(body, HOLDING[at], body, places[at].value))
    return [*pins, *(_mesh(train, number, k, links, places) for k in range(len(bodies) - 1))]


def _mesh(train: SixTrain, number: int, k: int, links: dict[str, Link], places: list[Point]) -> Mesh:
    """The mesh of gears k and k + 1 of a train on the link between their pins, a ring first."""
    one, other = (PINS.index(pin) for pin in train.pins[k : k + 2])
    first, second = gear_bodies(train, number)[k : k + 2]
    carrier = LINKS[other]
    toward: Points | complex = -1.0 + 0j if carrier == FRAME else links[carrier].unit
    toward = -toward if carrier == "output" else toward
    teeth = train.gears[k : k + 2]
    r1, r2 = (0.5 * train.module * abs(z) for z in teeth)  # gears without shift roll on their pitch circles
    tangent, name = math.tan(math.radians(train.pressure_angle)), f"mesh_{number}{PINS[one]}{PINS[other]}"
    if teeth[1] < 0:
        return Mesh(name, second, first, places[other].value, -toward, r2, r1, tangent, True, carrier)
    return Mesh(name, first, second, places[one].value, toward, r1, r2, tangent, teeth[0] < 0, carrier)
