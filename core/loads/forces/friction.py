"""Friction in pins, guides and meshes, as a fixed point on the reactions.

Pins: a couple mu r |F| against the relative turning; guides: mu |N| against the motion; meshes: a couple
(1 - eta) |F_t| r against the rolling, that is the turning against the link that carries the axes, which takes the
opposite.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.loads.forces.dynamics import Applied, Masses, Reactions, System
from gearlink.core.loads.forces.kinematics import dot, sense_of
from gearlink.core.loads.forces.mechanism import (
    FRAME,
    Act,
    Connection,
    Contact,
    Guide,
    Mechanism,
    Mesh,
    Pin,
    Rack,
    Toothed,
    rates,
)
from gearlink.core.loads.forces.rubbing import Rubbing
from gearlink.core.numerics.arrays import Mask, Reals

if TYPE_CHECKING:
    from gearlink.core.loads.spec import Friction

_TEETH = ("mesh", "rack")
_CHANGES = 3


@dataclass(frozen=True)
class Coefficients:
    """Friction of every joint.

    Fields
        pins, guides : float - coefficients; meshes : float - efficiency
        pin_radius : float [m]
        joints : by name, in place of these
    """

    pins: float
    guides: float
    meshes: float
    pin_radius: float
    joints: Mapping[str, float]

    def scaled(self, share: float) -> Coefficients:
        """A share of all friction; what a mesh loses counts, not its efficiency."""

        def of(value: float, *, lost: bool) -> float:
            return 1.0 - share * (1.0 - value) if lost else share * value

        joints = {name: of(value, lost=name.startswith(_TEETH)) for name, value in self.joints.items()}
        return replace(
            self, pins=share * self.pins, guides=share * self.guides, meshes=of(self.meshes, lost=True), joints=joints
        )

    def of(self, connection: Connection) -> float:
        """Couple or force per force: mu r of a pin [m], mu of a guide, (1 - eta) of a mesh."""
        own = self.joints.get(connection.name)
        if isinstance(connection, Pin):
            return self.pin_radius * (self.pins if own is None else own)
        if isinstance(connection, Guide):
            return self.guides if own is None else own
        if isinstance(connection, (Mesh, Rack)):
            return 1.0 - (self.meshes if own is None else own)
        return 0.0

    def rubbing(self, mechanism: Mechanism) -> list[str]:
        """Names of the connections that have friction."""
        return [each.name for each in mechanism.connections if self.of(each)]

    def units(self, mechanism: Mechanism, speed: float) -> Iterator[Unit]:
        """The friction of every joint that has some."""
        for each in mechanism.connections:
            share = self.of(each)
            if not share:
                continue
            direction = np.sign(speed) * sense_of(relative(mechanism, each), relative(mechanism, each, 2))
            if isinstance(each, Guide):
                at = mechanism.links[each.second].origin.value
                yield Unit(each.name, [Act(each.second, -direction * each.along, at, 0.0)], share)
                continue
            if isinstance(each, Pin):
                pairs = ((each.second, -1.0), (each.first, 1.0))
            else:
                assert isinstance(each, (Mesh, Rack)), "no other joint has a coefficient"
                gear = each.second if isinstance(each, Rack) else each.first
                share *= each.mate_radius if isinstance(each, Rack) else each.radius
                pairs = ((gear, -1.0), (each.carrier, 1.0))
            nowhere = np.zeros(mechanism.rows, dtype=np.complex128)
            yield Unit(
                each.name, [Act(name, 0j, nowhere, sign * direction) for name, sign in pairs if name != FRAME], share
            )

    def rate(self, mechanism: Mechanism, name: str) -> Reals:
        """Relative speed of a connection, per input angle, whose sign its friction has."""
        connection = next(each for each in mechanism.connections if each.name == name)
        return relative(mechanism, connection)


def relative(mechanism: Mechanism, connection: Connection, order: int = 1) -> Reals:
    """Relative turning of a pin, travel of a guide [m], rolling of a mesh; per input angle, or its derivative."""
    if isinstance(connection, Guide):
        return dot(connection.along, mechanism.links[connection.second].origin[order])
    if isinstance(connection, Rack):
        return rates(mechanism, connection.carrier, connection.second, order)
    if isinstance(connection, Mesh):
        return rates(mechanism, connection.carrier, connection.first, order)
    return rates(mechanism, connection.first, connection.second, order)


Pulled = Mapping[str, Mask]
"""Rows at which the second roller of a contact carries, by the contact's name."""


class Solution(NamedTuple):
    """A mechanism with the rollers that carry, its equations, and what friction adds to their solution."""

    mechanism: Mechanism
    system: System
    rubbing: Rubbing
    pulled: Pulled


def solution_of(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: float,
    friction: Coefficients | None,
    pulled: Pulled | None = None,
) -> Solution:
    """The solution without friction, and the responses to it and to the separating forces of the teeth.

    Parameters
        pulled : Pulled - left out: where the force without friction is negative

    Notes
        A system a row, solved once with all right sides. Where a second roller carries, its column takes the place of
        the first one's: x_c' = x_c/y_c, x' = x - y x_c', A y = the new column.
    """
    system = System(mechanism, masses)
    meshes = mechanism.meshes
    backs = [(each.name, each.back) for each in mechanism.connections if isinstance(each, Contact) and each.back]
    rubbing = [] if friction is None else list(friction.units(mechanism, speed))
    sides = [system.right_side(applied, gravity, speed, 0.0), *system.radials()]
    sides += [system.side(unit.acts) for unit in rubbing]
    for name, (at, normal) in backs:
        place = system.place(name)
        column = system.columns[place][1]._replace(at=at, force=normal)
        sides.append(system.factors(column))  # a column of the matrix as a right side
    solved = system.solve(sides)
    places = [(system.place(mesh.name),) * 2 for mesh in meshes] + [unit.places(system) for unit in rubbing]
    shares = np.array([1.0] * len(meshes) + [unit.share for unit in rubbing])
    count, used = 1 + len(shares), {}
    for k, (name, _) in enumerate(backs, count):
        place = system.place(name)
        free = _with_separation(solved, places[: len(meshes)], place) < 0.0
        used[name] = free if pulled is None else pulled[name]
        _exchange(solved, k, place, used[name])
    found = Rubbing(solved[0], solved[1:count], shares, np.array(places, dtype=np.intp).reshape(-1, 2))
    return Solution(mechanism, system, found, used)


def _rubbing_solution(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, speed: float, friction: Coefficients
) -> tuple[Solution, Reals]:
    """The solution with the rollers that carry once there is friction, and the sizes that make themselves.

    Notes
        Where the friction outweighs what a pair of rollers bears, the other roller carries than without it.
    """
    found = solution_of(mechanism, masses, applied, gravity, speed, friction)
    for _ in range(_CHANGES):
        sizes = found.rubbing.settled()
        unknowns = found.rubbing.unknowns(sizes) if found.pulled else found.rubbing.free
        pulled = {name: unknowns[found.system.place(name)] < 0.0 for name in found.pulled}
        if all(np.array_equal(pulled[name], used) for name, used in found.pulled.items()):
            break
        found = solution_of(mechanism, masses, applied, gravity, speed, friction, pulled)
    else:
        sizes = found.rubbing.settled()  # rows at which either roller would have it the other way: both are idle there
    return found, sizes


def _with_separation(solved: Reals, places: Sequence[tuple[int, int]], at: int) -> Reals:
    """An unknown with the separating forces of all teeth."""
    return np.asarray(
        solved[0, at] + sum(np.abs(solved[0, place]) * solved[k, at] for k, (place, _) in enumerate(places, 1))
    )


def _exchange(solved: Reals, new: int, place: int, pulled: Mask) -> None:
    """Put another column in the place of one, at the rows where its roller carries."""
    if pulled.any():
        y = solved[new]
        for k in range(new):
            if not solved[k, place].any():
                continue
            share = np.divide(solved[k, place], y[place], out=np.zeros_like(y[place]), where=pulled)
            solved[k] -= y * share
            solved[k, place] = np.where(pulled, share, solved[k, place])


def require_coefficients(given: Friction, connections: Sequence[Connection]) -> None:
    """Refuse coefficients that a joint cannot have, and those of pins that have no radius, which would have no effect.

    Raises
        NoSolution - with its key
    """
    for each in connections:
        of_teeth = isinstance(each, Toothed)
        if given.joints.get(each.name) == (0.0 if of_teeth else 1.0):
            allowed = "the efficiency of a mesh lies above 0" if of_teeth else "a coefficient of friction lies below 1"
            raise NoSolution(f"{given.joints[each.name]:g}: {allowed}", key=f"loads.friction.joints.{each.name}")
    pins = (given.joints.get(each.name, given.pins) for each in connections if isinstance(each, Pin))
    if given.pin_radius == 0.0 and any(pins):
        words = "friction of pins acts at their radius: give loads.friction.pin_radius (mm)"
        raise MissingSection(words, key="loads.friction")


def with_friction(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: float,
    friction: Coefficients | None,
) -> Reactions:
    """All joint and tooth forces and the input torque, by Newton and Euler; with friction where there is any.

    sum F = m (a - g),  sum (P - G) x F + sum T = J al    for every link

    Raises
        NoSolution - where the system is singular
        SelfLocking - where the mechanism locks itself
    Notes
        The separating force of a mesh acts along the link that joins its axes (or into a guide), so it changes no
        tangential force. Relative error of the largest force about eps/sin(transmission angle).
    Source
        Newton and Euler
    """
    if friction is None:
        found = solution_of(mechanism, masses, applied, gravity, speed, None)
        sizes = np.abs(found.rubbing.free[found.rubbing.places[:, 0]]).T
    else:
        found, sizes = _rubbing_solution(mechanism, masses, applied, gravity, speed, friction)
    return _sided(found.system.reactions(found.rubbing.unknowns(sizes)))


def _sided(found: Reactions) -> Reactions:
    """The same, with the rollers that carry."""
    connections = [
        each.sided(found.unknowns[each.name][0]) if isinstance(each, Contact) and each.back is not None else each
        for each in found.mechanism.connections
    ]
    return replace(found, mechanism=replace(found.mechanism, connections=connections))


def passes_ratio(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, speed: float, friction: Coefficients
) -> Reals:
    """How near the mechanism is to locking itself, at each row: what a pass of the friction leaves of a change.

    Raises
        SelfLocking
    """
    found, sizes = _rubbing_solution(mechanism, masses, applied, gravity, speed, friction)
    return found.rubbing.ratio(sizes)


class Unit(NamedTuple):
    """The friction of a joint for a unit of its size: where it acts, its coefficient, and the joint it is read from."""

    name: str
    acts: list[Act]
    share: float

    def places(self, system: System) -> tuple[int, int]:
        """The unknowns whose magnitude its size is."""
        first = system.place(self.name)
        names = [name for name, _ in system.columns[first : first + 2]]
        is_pin = any(each.name == self.name and isinstance(each, Pin) for each in system.mechanism.connections)
        return (first, first + 1) if is_pin and names[-1] == self.name else (first, first)


def losses(found: Reactions, friction: Coefficients, speed: float) -> Reals:
    """Power that friction turns into heat [W], never negative."""
    mechanism = found.mechanism
    total = np.zeros(mechanism.rows)
    for unit in friction.units(mechanism, speed):
        size = unit.share * np.hypot(*_parts(found, unit.name))
        for act in unit.acts:
            link = mechanism.links[act.on]
            rate = dot(act.force, link.origin.first) + act.couple * link.turn.first
            total -= speed * size * rate
    return total


def _parts(found: Reactions, name: str) -> tuple[Reals, Reals]:
    values = found.unknowns[name]
    is_pin = any(each.name == name and isinstance(each, Pin) for each in found.mechanism.connections)
    return values[0], values[1] if is_pin else np.zeros_like(values[0])
