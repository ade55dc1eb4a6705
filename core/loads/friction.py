"""Friction in pins, guides and meshes, as a fixed point on the reactions.

Pins: a couple mu r |F| against the relative turning; guides: mu |N| against the motion; meshes: a couple
(1 - eta) |F_t| r against the rolling, that is the turning against the link that carries the axes, which takes the
opposite.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.loads.dynamics import Applied, Force, Masses, Reactions, Rows, System, Torque
from gearlink.core.loads.kinematics import dot
from gearlink.core.loads.mechanism import (
    FRAME,
    Connection,
    Contact,
    Coupling,
    Guide,
    Mechanism,
    Mesh,
    Pin,
    Rack,
    SharedContact,
    ToothDrive,
    rates,
)
from gearlink.core.numerics.arrays import Reals

_PASSES = 60
_SETTLED = 1e-14
_LOCKS = 0.9


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

    def rate(self, mechanism: Mechanism, name: str) -> Reals:
        """Relative speed of a connection, per input angle, whose sign its friction has."""
        connection = next(each for each in mechanism.connections if each.name == name)
        return relative(mechanism, connection)


def relative(mechanism: Mechanism, connection: Connection) -> Reals:
    """Relative turning of a pin, travel of a guide [m], rolling of a mesh; per input angle."""
    if isinstance(connection, Guide):
        link = mechanism.links[connection.second]
        return dot(connection.along, link.origin.first)
    if isinstance(connection, Rack):
        return rates(mechanism, connection.carrier, connection.second)
    if isinstance(connection, Mesh):
        return rates(mechanism, connection.carrier, connection.first)
    return rates(mechanism, connection.first, connection.second)


def with_friction(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: float,
    friction: Coefficients | None,
) -> Reactions:
    """All reactions, with friction where there is any.

    Raises
        NoSolution - where the fixed point does not settle: the mechanism locks itself
    Notes
        Converges linearly with a ratio of about mu r over the lever.
    """
    system = System(mechanism, masses)
    side = system.right_side(applied, gravity, speed, 0.0)
    solution = system.solve(side)
    found = system.reactions(solution)
    sided, rows = _sided(mechanism, found)
    if len(rows):
        mechanism, system = sided, System(sided, masses)
        solution[:, rows] = system.solve(side, rows)
        found = system.reactions(solution)
    if friction is None:
        return found
    system.invert()
    before = np.inf
    for _ in range(_PASSES):
        losses = list(resistances(found, friction, speed))
        new = system.reactions(system.solve(_with(system, side, losses)))
        change = _change(found, new)
        found = new
        if change <= _SETTLED or (change <= 1e-11 and change >= before):
            return found
        before = change
    raise NoSolution(
        "with this friction the mechanism locks itself: the forces grow from pass to pass; make pins thinner, or "
        "friction smaller",
        key="loads.friction",
    )


def passes_ratio(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, speed: float, friction: Coefficients
) -> float:
    """Change of the forces by the second pass over that by the first: how near the mechanism is to locking itself."""
    system = System(mechanism, masses)
    side = system.right_side(applied, gravity, speed, 0.0)
    found = [system.reactions(system.solve(side))]
    for _ in range(2):
        losses = list(resistances(found[-1], friction, speed))
        found.append(system.reactions(system.solve(_with(system, side, losses))))
    first, second = _change(found[0], found[1]), _change(found[1], found[2])
    return second / first if first > 0.0 else 0.0


def _sided(mechanism: Mechanism, found: Reactions) -> tuple[Mechanism, Rows]:
    """The mechanism with the rollers that carry, and the rows where that is a second one anywhere."""
    pulled = np.zeros(mechanism.rows, dtype=bool)
    connections: list[Connection] = []
    for each in mechanism.connections:
        if isinstance(each, Contact) and each.back is not None:
            force = found.unknowns[each.name][0]
            pulled |= force < 0.0
            connections.append(each.sided(force))
        else:
            connections.append(each)
    return replace(mechanism, connections=connections), np.flatnonzero(pulled)


def _with(system: System, side: Reals, losses: Applied) -> Reals:
    added: Reals = side + system.right_side(losses, 0j, 0.0, 0.0)
    return added


def _change(old: Reactions, new: Reactions) -> float:
    """Largest change of an unknown, over the largest unknown of the same row."""
    size = max(float(np.max(np.abs(values))) for values in new.unknowns.values())
    return max(float(np.max(np.abs(new.unknowns[name] - old.unknowns[name]))) for name in new.unknowns) / (size or 1.0)


def resistances(found: Reactions, friction: Coefficients, speed: float) -> Iterator[Force | Torque]:
    """The forces and couples of friction that go with reactions."""
    mechanism, sense = found.mechanism, np.sign(speed)
    for each in mechanism.connections:
        share = friction.of(each)
        if not share or isinstance(each, (Contact, SharedContact, Coupling, ToothDrive)):
            continue
        direction = np.sign(sense * relative(mechanism, each))
        if isinstance(each, Guide):
            force = -share * np.abs(found.unknowns[each.name][0]) * direction * each.along
            yield Force(each.second, force, mechanism.links[each.second].origin)
            continue
        if isinstance(each, Pin):
            couple = share * np.abs(found.force(each.name)) * direction
            pairs = ((each.second, -1.0), (each.first, 1.0))
        else:
            gear, radius = (each.second, each.mate_radius) if isinstance(each, Rack) else (each.first, each.radius)
            couple = share * np.abs(found.unknowns[each.name][0]) * radius * direction
            pairs = ((gear, -1.0), (each.carrier, 1.0))
        for name, sign in pairs:
            if name != FRAME:
                yield Torque(name, sign * couple)


def losses(found: Reactions, friction: Coefficients, speed: float) -> Reals:
    """Power that friction turns into heat [W], never negative."""
    mechanism = found.mechanism
    total = np.zeros(mechanism.rows)
    for each in resistances(found, friction, speed):
        if isinstance(each, Force):
            total -= speed * dot(each.force, each.at.first)
        else:
            total -= speed * each.torque * mechanism.links[each.on].turn.first
    return total
