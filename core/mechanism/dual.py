"""What an error of a part costs at an output: the forces under a unit load there, times how far an element stands off.

The matrix of the forces is the transpose of that of the displacements, so one solution serves every source. An error
moves the element that a joint has on a link; meshes touch on the flank that carries.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Literal, TypeAlias

import numpy as np

from gearlink.core.mechanism.dynamics import System
from gearlink.core.mechanism.joints import Act, Column, Connection, Flank, Mesh, Pin, SharedContact, Toothed, meshes_of
from gearlink.core.mechanism.links import Link, Mechanism
from gearlink.core.mechanism.rates import Point, Turn, cross
from gearlink.core.numerics.arrays import Points, Reals

Value: TypeAlias = Callable[[Mechanism], Sequence[Reals]]
"""What is looked at, out of the places and angles of links, and its derivative."""

_SAME_PLACE = 1e-9
"""Of its distance from the origin, by which a computed place may be off."""


@dataclass(frozen=True)
class Shift:
    """An error of a part: the elements that some joints have on one link stand elsewhere on it.

    Fields
        link : str - a link, or the frame
        joints : names of joints that the link has
        way : complex - by how much they move per unit of the error; of a turned one its real part [rad]
        frame : "link", in whose coordinates that is and which carries it along, "frame", "normal": along that of a
            roller on its cam, away from the cam, or "arm": along the arm of that roller, away from the origin of its
            link
        turned : bool - they turn about the origin of the link, counter-clockwise
    """

    link: str
    joints: tuple[str, ...]
    way: complex = 1.0
    frame: Literal["link", "frame", "normal", "arm"] = "link"
    turned: bool = False

    def scaled(self, factor: float) -> Shift:
        """The same per another unit of the error."""
        return replace(self, way=self.way * factor)


class Dual:
    """Gains of all errors at one output, over the inputs of a mechanism.

    Parameters
        mechanism : Mechanism
        value : function of the links - the output [mm], with its first derivative at least
        torque_sign : +1 or -1 - sign of what the machine puts on the output
    Notes
        dy = sum F . displacement, F the force on the link whose element is displaced, under a unit load along y, with
        the separating part of teeth.
    Raises
        NoSolution - where two links stand in line
    Example
        >>> from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
        >>> bar = FourBar(18.0, 50.0, 100.0, 121.4)
        >>> links = four_bar(bar, np.array([1.0]))
        >>> made = Mechanism(links, four_bar_pins(links), "crank")
        >>> dual = Dual(made, lambda made: made.links["rocker"].turn)
        >>> longer = solve(replace(bar, coupler=50.0 + 1e-6), 1.0).rocker_angle - solve(bar, 1.0).rocker_angle
        >>> bool(abs(dual.gain(Shift("coupler", ("C",)))[0] - longer / 1e-6) < 1e-8)
        True

    Source
        virtual work: the transpose of Newton and Euler's equations without masses
    """

    def __init__(self, mechanism: Mechanism, value: Value, torque_sign: int = 1) -> None:
        self.mechanism, self.value, self.torque_sign = mechanism, value, torque_sign
        self._load = gradient(mechanism, value)

    @cached_property
    def sides(self) -> dict[str, Reals]:
        """By mesh the sign of the tangential force on its second gear."""
        if not meshes_of(self.mechanism):
            return {}
        forces = self._solved(self.mechanism)
        signs = {mesh.name: -self.torque_sign * forces[mesh.name][0] for mesh in meshes_of(self.mechanism)}
        return {name: np.where(sign < 0.0, -1.0, 1.0) for name, sign in signs.items()}

    @cached_property
    def touching(self) -> Mechanism:
        """The mechanism whose meshes touch on the flanks that carry."""
        return on_flanks(self.mechanism, self.sides)

    @cached_property
    def forces(self) -> Mapping[str, Reals]:
        """By joint its unknowns under the unit load, (unknowns, N)."""
        return self._solved(self.touching)

    def _solved(self, mechanism: Mechanism) -> dict[str, Reals]:
        system = System(mechanism, {})
        found: dict[str, list[Reals]] = {}
        for (name, _), unknown in zip(system.columns, system.solve([system.side(self._load)])[0], strict=True):
            found.setdefault(name, []).append(unknown)
        return {name: np.array(unknowns) for name, unknowns in found.items()}

    def force(self, link: str, joints: Sequence[str]) -> tuple[Points, Reals]:
        """Force on a link at some of its joints, and its moment about the origin of the link [mm]."""
        origin = origin_of(self.mechanism.link(link))
        force, moment = np.zeros(self.mechanism.rows, dtype=np.complex128), np.zeros(self.mechanism.rows)
        for joint in joints_of(self.touching, link, joints):
            for unknown, column in zip(self.forces[joint.name], joint.columns(), strict=True):
                for act in acts_of(column):
                    if act.on == link:
                        force = force + unknown * act.force
                        moment = moment + unknown * (cross(act.at - origin, act.force) + act.couple)
        return force, moment

    def gain(self, shift: Shift) -> Reals:
        """Error of the output per unit of an error of one direction."""
        if shift.turned:
            return np.asarray(self.force(shift.link, shift.joints)[1] * complex(shift.way).real)
        if shift.frame == "normal":
            pressed = sum(self.forces[name][0] for name in shift.joints)
            on_roller = all(each.second == shift.link for each in joints_of(self.touching, shift.link, shift.joints))
            return np.asarray(pressed * complex(shift.way).real * (1.0 if on_roller else -1.0))
        return self.vector_gain(shift).real

    def vector_gain(self, shift: Shift) -> Points:
        """Complex gain g of a vector v: the output moves by Re(v g)."""
        force, _ = self.force(shift.link, shift.joints)
        turned: Points | complex = 1.0
        if shift.frame == "link":
            turned = unit_of(self.mechanism.link(shift.link))
        elif shift.frame == "arm":
            (roller,) = (each for each in self.mechanism.connections if each.name in shift.joints)
            assert isinstance(roller, SharedContact), "rollers stand on arms"
            away = roller.at - origin_of(self.mechanism.link(roller.second))
            turned = away / np.abs(away)
        return np.asarray(np.conj(force) * shift.way * turned)

    def play(self, mesh: str) -> Reals:
        """Error of the output per mm by which the teeth of a mesh are thinner along the pitch circle.

        Notes
            The driven gear lags, against the force on it.
        """
        return np.asarray(-self.torque_sign * np.abs(self.forces[mesh][0]))


def on_flanks(mechanism: Mechanism, sides: Mapping[str, Reals]) -> Mechanism:
    """The machine whose meshes touch on one flank each, by the sign of the tangential force on the second gear."""
    joints = [Flank(each, sides[each.name]) if isinstance(each, Toothed) else each for each in mechanism.connections]
    return replace(mechanism, connections=joints)


def acts_of(column: Column) -> list[Act]:
    """All that the unit of an unknown puts on links."""
    return [
        Act(column.second, column.force, column.at, column.couple),
        *column.also,
        Act(column.first, -column.force, column.at, -column.couple),
    ]


def joints_of(mechanism: Mechanism, link: str, names: Sequence[str]) -> Iterator[Connection]:
    """Joints of a link by name.

    Raises
        AssertionError - where one is none of its joints
    """
    for name in names:
        found = [each for each in mechanism.connections if each.name == name]
        if not any(act.on == link for joint in found for column in joint.columns() for act in acts_of(column)):
            raise AssertionError(f"{name} is no joint of {link}")
        yield found[0]


def elements_at(mechanism: Mechanism, link: str, place: complex) -> tuple[str, ...]:
    """Names of the pins and meshes whose element on a link stands at a place of it [mm]: what an error there moves."""
    body = mechanism.link(link)
    at = place if body is None else body.at(place).value
    found = []
    for joint in mechanism.connections:
        if isinstance(joint, Pin):
            centers: dict[str, Points] = {joint.first: joint.at, joint.second: joint.at}
        elif isinstance(joint, Mesh):
            apart = joint.radius - joint.mate_radius if joint.internal else joint.radius + joint.mate_radius
            centers = {joint.first: joint.center, joint.second: joint.center + joint.toward * apart}
        else:
            continue
        if link in centers and np.all(np.abs(centers[link] - at) <= _SAME_PLACE * (1.0 + np.abs(at))):
            found.append(joint.name)
    return tuple(found)


def longer(mechanism: Mechanism, ends: Mapping[str, tuple[str, complex]]) -> dict[str, tuple[Shift, ...]]:
    """By size, what moves where a link is too long: all that stands at its end, away from its origin.

    Parameters
        ends : by size, a link or the frame and the end of it that the size places, from its origin [mm]
    Raises
        AssertionError - where no pin and no mesh stands there, so that the size would seem to move nothing
    """
    found: dict[str, tuple[Shift, ...]] = {}
    for size, (link, end) in ends.items():
        names = elements_at(mechanism, link, end)
        if not names:
            raise AssertionError(f"nothing stands at the end of {link} that {size} moves")
        found[size] = (Shift(link, names, end / abs(end)),)
    return found


def origin_of(link: Link | None) -> Points | complex:
    """Where the coordinates of a link begin; those of the frame at 0."""
    return 0j if link is None else link.origin.value


def unit_of(link: Link | None) -> Points | complex:
    """Direction of the x axis of a link."""
    return 1.0 + 0j if link is None else link.unit


def gradient(mechanism: Mechanism, value: Value) -> list[Act]:
    """The load whose work is the change of a value: forces at the origins of links and couples on them.

    dy = sum (F . dP + M dt),  P the origin of a link and t its angle

    Notes
        One coordinate of one link is in motion at a time, and the derivative of the value is taken.
    """
    asked = _Asked(mechanism.links)
    value(replace(mechanism, links=asked))
    return [_act(mechanism, value, name) for name in mechanism.links if name in asked.names]


class _Asked(dict[str, Link]):
    """Links that know which of them were asked for."""

    def __init__(self, links: Mapping[str, Link]) -> None:
        super().__init__(links)
        self.names: set[str] = set()

    def __getitem__(self, name: str) -> Link:
        self.names.add(name)
        return super().__getitem__(name)


def _act(mechanism: Mechanism, value: Value, name: str) -> Act:
    still = {other: _moving(link, 0j, 0.0) for other, link in mechanism.links.items()}

    def rate(origin: complex, turn: float) -> Reals:
        moving = still | {name: _moving(mechanism.links[name], origin, turn)}
        return np.asarray(value(replace(mechanism, links=moving))[1] + np.zeros(mechanism.rows))

    force = rate(1.0 + 0j, 0.0) + 1j * rate(1j, 0.0)
    return Act(name, force, mechanism.links[name].origin.value, rate(0j, 1.0))


def _moving(link: Link, origin: complex, turn: float) -> Link:
    at, angle = link.origin.value, link.turn.value
    return Link(Point(at, np.full(at.shape, origin)), Turn(angle, np.full(angle.shape, turn)), link.points)
