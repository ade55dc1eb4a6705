"""Friction in pins, guides and meshes, as a fixed point on the reactions.

Pins: a couple mu r |F| against the relative turning; guides: mu |N| against the motion; meshes: a couple
(1 - eta) |F_t| r against the rolling, that is the turning against the link that carries the axes, which takes the
opposite.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.core.errors import MissingSection, NoSolution
from gearlink.core.loads.dynamics import Applied, Masses, Reactions, System
from gearlink.core.loads.kinematics import dot, sense_of
from gearlink.core.loads.mechanism import (
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
from gearlink.core.numerics.arrays import Reals

if TYPE_CHECKING:
    from gearlink.core.loads.spec import Friction

_PASSES, _PLAIN, _KEPT, _POWERS = 60, 4, 5, 20
_SETTLED, _NEARLY, _BEYOND = 1e-14, 1e-11, 1e6
_TEETH = ("mesh", "rack")
LOCKS = 0.9
"""A mechanism of which a pass leaves more of a change counts as self-locking."""
LOCKED = (
    "with this friction the mechanism locks itself: the forces grow from pass to pass; make pins thinner, or friction "
    "smaller"
)


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


class SelfLocking(NoSolution):
    """With its friction the mechanism locks itself: there are no forces with which it moves."""


@dataclass(frozen=True)
class Rubbing:
    """What friction and separating forces do: each has the size of a joint's force, and acts by a response.

    x = x_0 + sum f_j S_j,  f_j = mu_j |F_j(x)|

    Fields
        free : (n, N) array - x_0, the unknowns without them
        responses : (m, n, N) array - S_j, the unknowns that a unit makes
        shares : (m,) array - mu_j: mu r, mu, (1 - eta) r, and 1 of a mesh's separating force
        places : (m, 2) array of int - unknowns whose magnitude F_j is; the same twice where it is one
    """

    free: Reals
    responses: Reals
    shares: Reals
    places: Any

    @cached_property
    def _read(self) -> tuple[Reals, Reals]:
        """The unknowns that sizes are read from, (N, m, 2), and what units make of them, (N, m, 2, m)."""
        base = self.free[self.places].transpose(2, 0, 1)
        response = self.responses[:, self.places, :].transpose(3, 1, 2, 0)
        return base, np.ascontiguousarray(response)

    @cached_property
    def _single(self) -> Any:
        return self.places[:, 0] == self.places[:, 1]

    def forces(self, sizes: Reals) -> Reals:
        """Parts of the joint forces at sizes (N, m), as (N, m, 2); of one unknown the second part is 0."""
        base, response = self._read
        count = len(self.shares)
        flat = response.reshape(len(sizes), 2 * count, count)  # none where friction vanishes in rounding
        found = base + (flat @ sizes[..., None]).reshape(base.shape)
        found[:, self._single, 1] = 0.0
        return np.asarray(found)

    def rates(self, forces: Reals) -> Reals:
        """Change of the sizes by the sizes, (N, m, m)."""
        response = self._read[1]
        length = np.hypot(forces[..., 0], forces[..., 1])
        along = np.divide(forces, length[..., None], out=np.zeros_like(forces), where=length[..., None] > 0.0)
        return np.asarray(self.shares[:, None] * np.einsum("nmk,nmkj->nmj", along, response))

    def sizes(self, forces: Reals) -> Reals:
        """f_j of joint forces, (N, m)."""
        return np.asarray(self.shares * np.hypot(forces[..., 0], forces[..., 1]))

    def unknowns(self, sizes: Reals) -> Reals:
        """All unknowns at sizes, (n, N)."""
        return np.asarray(self.free + np.einsum("jin,nj->in", self.responses, sizes))

    def settled(self) -> Reals:
        """The sizes that make themselves, (N, m).

        Raises
            SelfLocking - where no sizes do
        Notes
            A few passes first, which suffice where the friction is small; then Newton's steps, whose matrix is kept for
            five, since near locking each pass takes off hardly anything. Relative to the greatest force: 1e-14.
        """
        found = np.zeros((self.free.shape[-1], len(self.shares)))
        inverse = np.eye(len(self.shares))
        scale = np.max(np.abs(self._read[0]), initial=0.0) * (self.shares + 1e-300)
        for step in range(_PASSES):
            forces = self.forces(found)
            change = self.sizes(forces) - found
            worst = float(np.max(np.abs(change) / scale, initial=0.0)) if scale.any() else 0.0
            if worst <= _SETTLED:
                return found
            if not worst < _BEYOND:
                break
            if step >= _PLAIN:
                if (step - _PLAIN) % _KEPT == 0:
                    try:
                        inverse = np.asarray(np.linalg.inv(np.eye(len(self.shares)) - self.rates(forces)))
                    except np.linalg.LinAlgError:
                        break
                change = (inverse @ change[..., None])[..., 0]
            found = found + change
        else:
            if worst <= _NEARLY:
                return found
        raise SelfLocking(LOCKED, key="loads.friction")

    def ratio(self, sizes: Reals) -> Reals:
        """What a pass leaves of a disturbance, at each row: the limit of the changes of two passes, (N,)."""
        rates = self.rates(self.forces(sizes))
        way, growth = np.ones(sizes.shape), np.zeros(len(sizes))
        for step in range(2 * _POWERS):
            way = np.einsum("nmj,nj->nm", rates, way)
            length = np.max(np.abs(way), axis=1, initial=0.0)
            growth += np.log(np.where(length > 0.0, length, 1e-300)) if step >= _POWERS else 0.0
            way = way / np.where(length > 0.0, length, 1.0)[:, None]
        return np.asarray(np.exp(growth / _POWERS))


class Solution(NamedTuple):
    """A mechanism with the rollers that carry, its equations, and what friction adds to their solution."""

    mechanism: Mechanism
    system: System
    rubbing: Rubbing


def solution_of(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: float,
    friction: Coefficients | None,
) -> Solution:
    """The solution without friction, and the responses to it and to the separating forces of the teeth.

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
    count = 1 + len(shares)
    for k, (name, _) in enumerate(backs, count):
        place = system.place(name)
        _exchange(solved, k, place, _with_separation(solved, places[: len(meshes)], place))
    found = Rubbing(solved[0], solved[1:count], shares, np.array(places, dtype=np.intp).reshape(-1, 2))
    return Solution(mechanism, system, found)


def _with_separation(solved: Reals, places: Sequence[tuple[int, int]], at: int) -> Reals:
    """An unknown with the separating forces of all teeth."""
    return np.asarray(
        solved[0, at] + sum(np.abs(solved[0, place]) * solved[k, at] for k, (place, _) in enumerate(places, 1))
    )


def _exchange(solved: Reals, new: int, place: int, whole: Reals) -> None:
    """Put another column in the place of one, where its unknown, `whole`, is negative."""
    pulled = whole < 0.0
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
    _, system, rubbing = solution_of(mechanism, masses, applied, gravity, speed, friction)
    sizes = np.abs(rubbing.free[rubbing.places[:, 0]]).T if friction is None else rubbing.settled()
    return _sided(system.reactions(rubbing.unknowns(sizes)))


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
    rubbing = solution_of(mechanism, masses, applied, gravity, speed, friction).rubbing
    return rubbing.ratio(rubbing.settled())


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
