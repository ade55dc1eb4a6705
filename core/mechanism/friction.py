"""Friction in pins, guides and meshes, as a fixed point of the reactions; joint forces and friction losses.

Pins: a couple mu r |F| against the relative rotation; guides: mu |N| against the motion; faces and edges on cams: mu N
against the sliding, at the contact; meshes: a couple (1 - eta) |F_t| r on the driven gear against its rolling, its
rotation relative to the link that carries both axes, and the opposite couple on that link. Thus in the frame of the
carrier the driven gear gives eta of the power that the driving gear puts in. Which gear is driven follows from the
signs of tooth force and rolling, row by row.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.mechanism.dynamics import Applied, Masses, Reactions, System
from gearlink.core.mechanism.joints import (
    NEWTON_METER,
    Act,
    Connection,
    Contact,
    Guide,
    Mesh,
    Pin,
    Rack,
    Shared,
    ToothDrive,
    Toothed,
    meshes_of,
)
from gearlink.core.mechanism.links import FRAME, Mechanism, rates
from gearlink.core.mechanism.rates import dot, sense_of
from gearlink.core.numerics.arrays import Mask, Points, Reals

_PASSES, _PLAIN, _KEPT = 60, 4, 5
_SETTLED, _NEARLY, _BEYOND = 1e-14, 1e-11, 1e6
LOCKS = 0.9
"""A mechanism of which a pass leaves more of a change counts as self-locking."""
LOCKED = (
    "with this friction the mechanism is self-locking: the forces grow from pass to pass\nreduce friction, or the "
    "radii of the pins"
)


class SelfLocking(NoSolution):
    """The mechanism is self-locking with its friction: no forces exist with which it moves."""


@dataclass(frozen=True)
class Rubbing:
    """The effect of friction and separating forces: each is proportional to the force of a joint and acts by a
    response.

    x = x_0 + sum f_j S_j,  f_j = mu_j |F_j(x)|, or mu_j max(s_j F_j(x), 0) of one side

    Fields
        free : (n, N) array - x_0, the unknowns without them
        responses : (m, n, N) array - S_j, the unknowns that a unit makes
        shares : (m,) array - mu_j: mu r, mu, (1 - eta) r, and 1 of a mesh's separating force
        places : (m, 2) array of int - unknowns whose magnitude F_j is; the same twice where it is one
        sides : (m, N) array - s_j, +-1 where the size is that of the force on one side, 0 where of either
    """

    free: Reals
    responses: Reals
    shares: Reals
    places: Any
    sides: Reals | float = 0.0

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
        """Parts of the joint forces at sizes (N, m), as (N, m, 2), 0 on the other side than a size is of.

        Of one unknown the second part is 0.
        """
        base, response = self._read
        count = len(self.shares)
        flat = response.reshape(len(sizes), 2 * count, count)  # none where friction vanishes in rounding
        found = base + (flat @ sizes[..., None]).reshape(base.shape)
        found[:, self._single, 1] = 0.0
        return np.asarray(np.where((np.asarray(self.sides).T * found[..., 0] < 0.0)[..., None], 0.0, found))

    def rates(self, forces: Reals) -> Reals:
        """Change of the sizes by the sizes, (N, m, m)."""
        response = self._read[1]
        length = _length(forces)
        along = np.divide(forces, length[..., None], out=np.zeros_like(forces), where=length[..., None] > 0.0)
        return np.asarray(self.shares[:, None] * np.einsum("nmk,nmkj->nmj", along, response))

    def sizes(self, forces: Reals) -> Reals:
        """f_j of joint forces, (N, m)."""
        return np.asarray(self.shares * _length(forces))

    def unknowns(self, sizes: Reals) -> Reals:
        """All unknowns at sizes, (n, N)."""
        return np.asarray(self.free + np.einsum("jin,nj->in", self.responses, sizes))

    def settled(self) -> Reals:
        """The sizes at the fixed point, (N, m).

        Raises
            SelfLocking - where no sizes do
        Notes
            A few passes first, which suffice where the friction is small; then Newton's steps, whose matrix is kept for
            five, since near locking each pass takes off hardly anything. Relative to the maximum force: 1e-14.
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
        """The convergence ratio of the iteration at each row, (N,).

        The spectral radius of the rates: no unit that sizes are in changes it, torques of pins beside forces of teeth.
        """
        return np.asarray(np.abs(np.linalg.eigvals(self.rates(self.forces(sizes)))).max(axis=1, initial=0.0))


def _length(forces: Reals) -> Reals:
    """Magnitudes, at a quarter of the time of np.hypot: no force is near the limits of the numbers."""
    return np.asarray(np.sqrt(forces[..., 0] ** 2 + forces[..., 1] ** 2))


_TEETH = ("mesh", "rack")
_RIGID = 1e-9


@dataclass(frozen=True)
class Coefficients:
    """Friction of every joint.

    Fields
        pins, guides : float - coefficients; meshes : float - efficiency
        pin_radius : float [mm]
        joints : by name, instead of these
        contacts : float - coefficient of what slides on a cam
    """

    pins: float
    guides: float
    meshes: float
    pin_radius: float
    joints: Mapping[str, float]
    contacts: float = 0.0

    def scaled(self, share: float) -> Coefficients:
        """A share of all friction; what a mesh loses counts, not its efficiency."""

        def of(value: float, *, lost: bool) -> float:
            return 1.0 - share * (1.0 - value) if lost else share * value

        joints = {name: of(value, lost=name.startswith(_TEETH)) for name, value in self.joints.items()}
        return replace(
            self,
            pins=share * self.pins,
            guides=share * self.guides,
            meshes=of(self.meshes, lost=True),
            joints=joints,
            contacts=share * self.contacts,
        )

    def of(self, connection: Connection) -> float:
        """Couple or force per force: mu r of a pin [mm], mu of a guide, (1 - eta) of a mesh."""
        own = self.joints.get(connection.name)
        if isinstance(connection, Pin):
            return self.pin_radius * (self.pins if own is None else own)
        if isinstance(connection, Guide):
            return self.guides if own is None else own
        if isinstance(connection, Toothed):
            return 1.0 - (self.meshes if own is None else own)
        if isinstance(connection, Contact) and connection.slides:
            return self.contacts if own is None else own
        return 0.0

    def rubbing(self, mechanism: Mechanism) -> list[str]:
        """Names of the connections that have friction."""
        return [each.name for each in mechanism.connections if self.of(each)]

    def units(self, mechanism: Mechanism, speed: float) -> Iterator[Unit]:
        """The friction of every joint that has some; of a mesh two, of which one is 0: each gear as the driven one."""
        for each in mechanism.connections:
            share = self.of(each)
            if not share or (isinstance(each, Pin) and _stands(mechanism, each)):
                continue
            direction = np.sign(speed) * sense_of(relative(mechanism, each), relative(mechanism, each, 2))
            if isinstance(each, Guide):
                at = mechanism.links[each.second].origin.value if each.first == FRAME else each.at
                acts = [Act(each.second, -direction * each.along, at, 0.0)]
                if each.first != FRAME:
                    acts.append(Act(each.first, direction * each.along, at, 0.0))
                yield Unit(each.name, acts, share)
            elif isinstance(each, Contact):
                along = -direction * 1j * each.normal
                acts = [Act(each.second, along, each.at, 0.0), Act(each.first, -along, each.at, 0.0)]
                yield Unit(each.name, acts, share, np.ones(mechanism.rows))
            elif isinstance(each, Pin):
                yield Unit(each.name, _against(each.second, each.first, direction), share)
            elif isinstance(each, Rack):
                turned = direction * dot(each.along, -1j * each.normal)  # the way of the pitch point along the rack
                yield Unit(each.name, _against(each.second, each.first, direction), share * each.mate_radius, turned)
                along, couple = turned * each.along, each.mate_radius * direction
                acts = [Act(each.first, -along, each.pitch_point, couple), Act(each.second, along, each.center, 0.0)]
                yield Unit(each.name, acts, share, -turned)
            elif isinstance(each, ToothDrive):  # where its gear drives the wheel, the loss is on the wheel: `_driven`
                turned = np.where(each.moves, direction, 0.0)
                yield Unit(each.name, _against(each.second, FRAME, turned), share * each.mate_radius, direction)
            else:
                assert isinstance(each, Mesh), "no other joint has a coefficient"
                mate = direction if each.internal else -direction
                yield Unit(each.name, _against(each.second, each.carrier, mate), share * each.mate_radius, direction)
                yield Unit(each.name, _against(each.first, each.carrier, direction), share * each.radius, -direction)

    def rate(self, mechanism: Mechanism, name: str) -> Reals:
        """Relative speed of a connection, per input angle, whose sign its friction has."""
        connection = next(each for each in mechanism.connections if each.name == name)
        return relative(mechanism, connection)


def _stands(mechanism: Mechanism, pin: Pin) -> bool:
    """Whether a pin holds two links that do not turn against each other, as those of a triangle of bars.

    At a reversal they turn just after it: the second derivative tells.
    """
    own = [[rates(mechanism, FRAME, link, order) for link in (pin.first, pin.second)] for order in (1, 2)]
    apart = np.abs([relative(mechanism, pin, order) for order in (1, 2)])
    return bool(np.max(apart) <= _RIGID * np.max(np.abs(own)))


def relative(mechanism: Mechanism, connection: Connection, order: int = 1) -> Reals:
    """Relative turning of a pin, travel of a guide [mm], rolling of a mesh, sliding on a cam [mm]; per input angle, or
    its derivative, of the sliding 0: what slides on a cam that turns never rests there but for an instant."""
    if isinstance(connection, Guide):
        return _travel(mechanism, connection, order)
    if isinstance(connection, Contact):
        if order > 1:
            return np.zeros(mechanism.rows)
        (sliding, _), (held, _) = (_rate(mechanism, on, connection.at) for on in (connection.second, connection.first))
        return dot(1j * connection.normal, sliding - held)
    if isinstance(connection, Mesh):
        return rates(mechanism, connection.carrier, connection.first, order)
    return rates(mechanism, connection.first, connection.second, order)


def _travel(mechanism: Mechanism, guide: Guide, order: int) -> Reals:
    """Travel of a guide per input angle, or its derivative, seen from the link that has the line.

    s' = u . (d' - i t' d),  s'' = u . (d'' - 2 i t' d' - (i t'' + t'^2) d),  t of that link

    Notes
        The link that slides does not turn against the other one, so that any point of it serves: d leads from the one
        origin to the other.
    """
    sliding, held = mechanism.links[guide.second], mechanism.link(guide.first)
    if held is None:
        return dot(guide.along, sliding.origin.derivative(order))
    turn, apart = held.turn, [there - here for there, here in zip(sliding.origin, held.origin, strict=True)]
    if order == 1:
        return dot(guide.along, apart[1] - 1j * turn.first * apart[0])
    bent = apart[2] - 2j * turn.first * apart[1] - (1j * turn.second + turn.first**2) * apart[0]
    return dot(guide.along, bent)


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
        the first one's: x_c' = x_c/y_c, x' = x - y x_c', A y = the new column; the new columns of the pairs that
        follow are exchanged like all others.
    """
    system = System(mechanism, masses)
    meshes = meshes_of(mechanism)
    backs = [each for each in mechanism.connections if isinstance(each, (Contact, Shared)) and each.back]
    rubbing = [] if friction is None else list(friction.units(mechanism, speed))
    sides = [system.right_side(applied, gravity, speed, 0.0), *system.radials()]
    sides += [system.side(unit.acts) for unit in rubbing]
    for each in backs:
        column = each.backward(system.columns[system.place(each.name)][1])
        sides.append(system.factors(column))  # a column of the matrix as a right side
    solved = system.solve(sides)
    places = [(system.place(mesh.name),) * 2 for mesh in meshes] + [unit.places(system) for unit in rubbing]
    shares = np.array([1.0] * len(meshes) + [unit.share for unit in rubbing])
    count, used = 1 + len(shares), {}
    for k, each in enumerate(backs, count):
        place = system.place(each.name)
        free = _with_separation(solved, places[: len(meshes)], place) < 0.0
        used[each.name] = free if pulled is None else pulled[each.name]
        _exchange(solved, k, place, used[each.name])
    of_side = np.zeros((len(shares), mechanism.rows))
    for k, unit in enumerate(rubbing, len(meshes)):
        of_side[k] = 0.0 if unit.side is None else unit.side
    found = Rubbing(solved[0], solved[1:count], shares, np.array(places, dtype=np.intp).reshape(-1, 2), of_side)
    return Solution(mechanism, system, found, used)


def settled(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: float,
    friction: Coefficients | None,
) -> tuple[Solution, Reals]:
    """The solution with the rollers that are loaded with friction, and the sizes at the fixed point.

    Raises
        NoSolution - where the system is singular
        SelfLocking - where the mechanism locks itself
    Notes
        Where the friction outweighs what a pair of rollers bears, the other roller carries than without it; and the
        rollers of one pair may decide which of another carries. In each row the first pair whose roller does not push
        is changed: that ends (Murty's rule) where sizes and signs are unique. Where a choice comes back, what is left
        are rows at which either roller would have it the other way: both are idle there.
    """
    found = solution_of(mechanism, masses, applied, gravity, speed, friction)
    if friction is None and len(found.pulled) < 2:  # alone it keeps the sign that it was chosen by
        return found, _sizes(found, friction)
    seen = {_choice(found.pulled)}
    while True:
        sizes = _sizes(found, friction)
        unknowns = found.rubbing.unknowns(sizes) if found.pulled else found.rubbing.free
        pulled = _first_changed(found, unknowns)
        if pulled is None or (choice := _choice(pulled)) in seen:
            return found, sizes
        seen.add(choice)
        found = solution_of(mechanism, masses, applied, gravity, speed, friction, pulled)


def _choice(pulled: Pulled) -> bytes:
    """Which roller of each pair carries in each row, to be told from another choice."""
    return b"".join(each.tobytes() for each in pulled.values())


def _sizes(found: Solution, friction: Coefficients | None) -> Reals:
    """The sizes that make themselves; without friction the separating forces alone."""
    if friction is None:
        return np.asarray(np.abs(found.rubbing.free[found.rubbing.places[:, 0]]).T)
    return found.rubbing.settled()


def _first_changed(found: Solution, unknowns: Reals) -> Pulled | None:
    """The rollers that carry, in each row the first pair changed whose roller pulls; None: there is none."""
    pulled, done = {}, np.zeros(found.mechanism.rows, dtype=bool)
    for name, used in found.pulled.items():
        changed = ((unknowns[found.system.place(name)] < 0.0) != used) & ~done
        pulled[name], done = used ^ changed, done | changed
    return pulled if done.any() else None


def _with_separation(solved: Reals, places: Sequence[tuple[int, int]], at: int) -> Reals:
    """An unknown with the separating forces of all teeth."""
    return np.asarray(
        solved[0, at] + sum(np.abs(solved[0, place]) * solved[k, at] for k, (place, _) in enumerate(places, 1))
    )


def _exchange(solved: Reals, new: int, place: int, pulled: Mask) -> None:
    """Put another column instead of one, at the rows where its roller carries."""
    if pulled.any():
        y = solved[new]
        for k in range(len(solved)):
            if k == new or not solved[k, place].any():
                continue
            share = np.divide(solved[k, place], y[place], out=np.zeros_like(y[place]), where=pulled)
            solved[k] -= y * share
            solved[k, place] = np.where(pulled, share, solved[k, place])


def with_friction(found: Solution, sizes: Reals, friction: Coefficients | None, speed: float) -> Reactions:
    """All joint and tooth forces and the input torque, by Newton and Euler; with friction where there is any.

    sum F = m (a - g),  sum (P - G) x F + sum T = J al    for every link

    Parameters
        found, sizes : what `settled` gives
    Notes
        The separating force of a mesh acts along the link that joins its axes (or into a guide), so it changes no
        tangential force. Relative error of the largest force about eps/sin(transmission angle).
    Source
        Newton and Euler
    """
    return _driven(_sided(found.system.reactions(found.rubbing.unknowns(sizes))), friction, speed)


def _sided(found: Reactions) -> Reactions:
    """The same, with the rollers that carry."""
    connections = [
        each.sided(found.unknowns[each.name][0]) if isinstance(each, (Contact, Shared)) else each
        for each in found.mechanism.connections
    ]
    return replace(found, mechanism=replace(found.mechanism, connections=connections))


def _driven(found: Reactions, friction: Coefficients | None, speed: float) -> Reactions:
    """The same, with what the wheel of a drive by teeth loses where it is driven."""
    mechanism = found.mechanism
    if friction is None or mechanism.gain is None:
        return found
    lost = next(friction.of(each) for each in mechanism.connections if each.name == mechanism.drive)
    return replace(found, torque=np.where(found.torque * speed < 0.0, (1.0 - lost) * found.torque, found.torque))


class Unit(NamedTuple):
    """The friction of a joint for a unit of its size: where it acts, its coefficient, and the joint it is read from.

    Its size is that of the joint's force; with `side`, (N,) array of +-1, of the force on that side alone, else 0.
    """

    name: str
    acts: list[Act]
    share: float
    side: Reals | None = None

    def places(self, system: System) -> tuple[int, int]:
        """The unknowns whose magnitude its size is."""
        first = system.place(self.name)
        names = [name for name, _ in system.columns[first : first + 2]]
        is_pin = any(each.name == self.name and isinstance(each, Pin) for each in system.mechanism.connections)
        return (first, first + 1) if is_pin and names[-1] == self.name else (first, first)

    def size(self, values: Reals) -> Reals:
        """Its size at the unknowns of its joint, (N,)."""
        if self.side is not None:
            return np.asarray(self.share * np.maximum(self.side * values[0], 0.0))
        return np.asarray(self.share * np.linalg.norm(values, axis=0))


def _against(gear: str, carrier: str, direction: Reals) -> list[Act]:
    """A unit couple on a link against its turning, and the opposite on the link that it turns on."""
    nowhere = np.zeros(len(direction), dtype=np.complex128)
    return [Act(gear, 0j, nowhere, -direction), Act(carrier, 0j, nowhere, direction)]


def losses(found: Reactions, friction: Coefficients, speed: float) -> Reals:
    """Power that friction turns into heat [W], never negative.

    Notes
        That of a mesh is (1 - eta) of the power that its driving gear puts in, and that is counted from all that the
        mesh does to this gear: where the friction lies on the wrong gear, the power does not balance.
    """
    mechanism = found.mechanism
    total = np.zeros(mechanism.rows)
    joints = {each.name: each for each in mechanism.connections}
    taken: dict[str, dict[str, Reals]] = {}
    for unit in friction.units(mechanism, speed):
        joint = joints[unit.name]
        values = found.unknowns[unit.name][: 2 if isinstance(joint, Pin) else 1]
        size, is_mesh = unit.size(values), isinstance(joint, Toothed)
        if is_mesh and unit.name not in taken:
            (column,) = joint.columns()
            force = values[0] * column.force
            pairs = ((column.second, force), (column.first, -force))
            taken[unit.name] = {on: _power(joint, mechanism, Act(on, f, column.at, 0.0)) for on, f in pairs}
            if isinstance(joint, ToothDrive):
                taken[unit.name][FRAME] = -found.torque * NEWTON_METER  # of the wheel
        for act in unit.acts:
            power = size * _power(joint, mechanism, act)
            if not is_mesh:
                total -= speed * power
            elif act.on in taken[unit.name]:
                taken[unit.name][act.on] = taken[unit.name][act.on] + power
    for name, powers in taken.items():
        put_in = -np.minimum(*(speed * power for power in powers.values()))
        total += friction.of(joints[name]) * put_in
    return total / NEWTON_METER


def _power(joint: Connection, mechanism: Mechanism, act: Act) -> Reals:
    """Power of a force and a couple on a link per input angle; of teeth as seen from where the axes rest.

    Of two gears that is their carrier; of a rack what keeps its direction and goes with the pinion's centre.
    """
    moved, turned = _rate(mechanism, act.on, act.at)
    if isinstance(joint, Mesh):
        back, turn = _rate(mechanism, joint.carrier, act.at)
        moved, turned = moved - back, turned - turn
    elif isinstance(joint, Rack):
        center, _ = _rate(mechanism, joint.second, joint.center)
        turn = _rate(mechanism, joint.first, act.at)[1]
        moved, turned = moved - center - 1j * turn * (act.at - joint.center), turned - turn
    return np.asarray(dot(act.force, moved) + act.couple * turned)


def _rate(mechanism: Mechanism, name: str, at: Points) -> tuple[Points, Reals]:
    """Velocity of a point that goes with a link [mm], and the turning of the link; per input angle."""
    if (link := mechanism.link(name)) is None:
        return np.zeros(mechanism.rows, dtype=np.complex128), np.zeros(mechanism.rows)
    return link.origin.first + 1j * link.turn.first * (at - link.origin.value), link.turn.first
