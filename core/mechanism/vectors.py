"""Quantities drawn on a mechanism in addition to its links: named points with derivatives, instant centres, forces.

Points are complex numbers in mm in the coordinates of the motion; derivatives are with respect to the input.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.base.errors import GearlinkError, named
from gearlink.core.mechanism.joints import Contact, Coupling, Guide, Pin, SharedContact, meshes_of
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.motion import Course

if TYPE_CHECKING:
    from gearlink.core.mechanism.dynamics import Reactions
    from gearlink.core.mechanism.rates import Point
    from gearlink.core.numerics.arrays import Points, Reals

_SAME = 1e-9
"""Of the size of the mechanism: points nearer than that at all inputs are one."""


class Place(NamedTuple):
    """A point of a link, in its coordinates [mm]."""

    link: str
    arm: complex


class UnknownPoint(GearlinkError):
    """A point was asked for that the mechanism does not have."""

    def __init__(self, name: str, known: Mapping[str, Place]) -> None:
        super().__init__(f"this mechanism has no point {named(name)}; it has {', '.join(known)}, and LINK@X/Y in mm")


def moving_points(mechanism: Mechanism) -> dict[str, Place]:
    """The points that move, each once: pins and rollers, then the named points and the origins of the links.

    Parameters
        mechanism : Mechanism - at two or more inputs
    Returns
        points : by name - a pin's; `LINK.POINT` of a named point, `LINK` of an origin
    """
    found: dict[str, Place] = {}
    tracks: list[Points] = []

    def add(name: str, link: str, at: Points) -> None:
        held = mechanism.links[link]
        if np.ptp(at.real) + np.ptp(at.imag) <= _SAME * (1.0 + float(np.abs(at).max())):
            return
        if any(float(np.abs(at - other).max()) <= 1e-6 for other in tracks):
            return
        arms = (at - held.origin.value) / held.unit
        if float(np.abs(arms - arms[0]).max()) <= 1e-6 * (1.0 + float(np.abs(arms).max())):
            tracks.append(at)
            found[name] = Place(link, complex(arms[0]))

    for each in mechanism.connections:
        if isinstance(each, Pin):
            add(each.name, each.second if each.second != FRAME else each.first, each.at)
        elif isinstance(each, (Contact, SharedContact)) and each.second != FRAME:
            add(each.name, each.second, np.asarray(each.at))
    for name, link in mechanism.links.items():
        for point in link.points:
            add(f"{name}.{point}", name, link.at(point).value)
        add(name, name, link.origin.value)
    return found


def place_of(mechanism: Mechanism, name: str) -> Place:
    """The point of a name: one of `moving_points`, the named point of a link alone, or LINK@X/Y on it [mm].

    Raises
        UnknownPoint
    """
    known = moving_points(mechanism)
    if name in known:
        return known[name]
    own = [link for link, held in mechanism.links.items() if name in held.points]
    if len(own) == 1:
        return Place(own[0], mechanism.links[own[0]].points[name])
    link, at, text = name.partition("@")
    if at and link in mechanism.links:
        try:
            x, _, y = text.partition("/")
            arm = complex(float(x), float(y))
        except ValueError:
            arm = complex(math.nan, math.nan)
        if cmath.isfinite(arm):
            return Place(link, arm)
    raise UnknownPoint(name, known)


def rates_of(mechanism: Mechanism, place: Place) -> Point:
    """A point of a link with its derivatives by the input [mm, mm/rad, ...]."""
    return mechanism.links[place.link].at(place.arm)


def centre(mechanism: Mechanism, link: str, against: str = FRAME) -> Points:
    """Instant centre of a link against another one; NaN where neither turns against the other.

    Returns
        centre : (N,) complex [mm]
    Source
        v_1 + i w_1 (P - o_1) = v_2 + i w_2 (P - o_2)
    """

    def motion(name: str) -> tuple[Points | complex, Reals | float]:
        held: Link | None = mechanism.link(name)
        if held is None:
            return 0j, 0.0
        return held.origin.first - 1j * held.turn.first * held.origin.value, held.turn.first

    (at, turning), (other_at, other_turning) = motion(link), motion(against)
    relative = np.asarray(turning - other_turning, dtype=np.float64) + np.zeros(mechanism.rows)
    standing = np.abs(relative) < 1e-12
    pole = 1j * (at - other_at) / np.where(standing, 1.0, relative)
    return np.where(standing, complex(math.nan, math.nan), pole)


class Load(NamedTuple):
    """A force on the second link of a connection.

    Fields
        at : (N,) complex [mm] - where it acts
        force : (N,) complex [N] - of teeth with the radial part
        teeth : bool - whether teeth exchange it
    """

    at: Points
    force: Points
    teeth: bool = False


def loads_of(found: Reactions, unknown: tuple[str, ...] = ()) -> dict[str, Load]:
    """The forces of pins, guides, teeth and rollers by the name of the connection.

    Parameters
        unknown : names of connections whose force no motion tells
    """
    teeth = {each.name: each for each in meshes_of(found.mechanism)}
    made: dict[str, Load] = {}
    for each in found.mechanism.connections:
        if each.name in unknown or isinstance(each, Coupling):
            continue
        if each.name in teeth:
            mesh = teeth[each.name]
            made[each.name] = Load(mesh.pitch_point, found.force(each.name) + found.radial(each.name), True)
        elif isinstance(each, (Contact, SharedContact)):
            first = each.columns()[0]
            made[each.name] = Load(np.asarray(first.at) + np.zeros(found.mechanism.rows), found.force(each.name))
        elif isinstance(each, (Pin, Guide)):
            made[each.name] = Load(each.at, found.force(each.name))
    return made


def pressure_angles(mechanism: Mechanism) -> dict[str, tuple[Points, Reals]]:
    """Contact point [mm] and pressure angle [rad] of every roller on a follower of the frame.

    Notes
        The acute angle between the normal and the direction in which the follower lets the roller's centre move: across
        the arm of a lever, along a guide.
    """
    made: dict[str, tuple[Points, Reals]] = {}
    for each in mechanism.connections:
        if not isinstance(each, (Contact, SharedContact)) or each.second == FRAME:
            continue
        if isinstance(each, Contact) and each.first == FRAME:
            continue
        sides = [(each.name, each.at, each.normal)]
        if isinstance(each, Contact) and each.back is not None:
            sides.append((f"{each.name}, second roller", *each.back))
        for name, at, normal in sides:
            way = _direction(mechanism, each.second, at)
            if way is not None:
                cosine = np.abs((np.conj(normal) * way).real) / np.abs(way)
                sine = np.abs((np.conj(normal) * way).imag) / np.abs(way)
                made[name] = at, np.arctan2(sine, cosine)
    return made


def transmission_angles(mechanism: Mechanism, pins: Sequence[str]) -> dict[str, Reals]:
    """Transmission angle [rad] at each of the pins by which a coupler moves a link of the frame, folded to 0 to pi/2.

    Notes
        Between the line of the coupler's pins and the normal of the direction in which the pin can move.
    """
    joints = {each.name: each for each in mechanism.connections if isinstance(each, Pin)}
    found: dict[str, Reals] = {}
    for each in (joints[name] for name in pins if name in joints):
        ways = {link: _direction(mechanism, link, each.at) for link in (each.first, each.second)}
        (coupler,) = (link for link, way in ways.items() if way is None)
        way = next(way for way in ways.values() if way is not None)
        other = next(pin for pin in joints.values() if pin is not each and coupler in (pin.first, pin.second))
        turned = np.conj(each.at - other.at) * way
        found[each.name] = np.arctan2(np.abs(turned.real), np.abs(turned.imag))
    return found


def least_transmission(*pins: str) -> Course:
    """The minimum transmission angle at pins of a mechanism; pins that it does not have are ignored."""

    def of(mechanism: Mechanism) -> list[Reals]:
        return [np.min([np.full(mechanism.rows, math.inf), *transmission_angles(mechanism, pins).values()], axis=0)]

    return Course("rad", of)


def _direction(mechanism: Mechanism, follower: str, at: Points) -> Points | None:
    """Direction in which a point of a follower can move; None of one that the frame does not guide."""
    for each in mechanism.connections:
        if isinstance(each, Pin) and FRAME in (each.first, each.second) and follower in (each.first, each.second):
            return np.asarray(1j * (at - each.at))
        if isinstance(each, Guide) and FRAME in (each.first, each.second) and follower in (each.first, each.second):
            return np.asarray(each.along + np.zeros(mechanism.rows))
    return None
