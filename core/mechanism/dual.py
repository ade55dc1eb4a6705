"""Effect of errors of the parts on a mechanism: error at an output by unit loads, and the exact closure with errors.

The error at an output is the joint force under a unit load there times the displacement of the joint element. The
matrix of the forces is the transpose of that of the displacements, so that one solution serves every source. An error
moves the element of a joint on its link; meshes touch on the loaded flank.

With errors the mechanism is closed by Newton's method. For every joint the residual is the distance of its two elements
at the current positions of the links; teeth use the involutes of their base circles on one flank, a roller the parabola
of its cam's pitch curve. The steps use the transposed matrix of the forces of the mechanism without errors, so that
each step reduces the residual to the share error/length of the last.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, fields, is_dataclass, replace
from functools import cached_property
from typing import Any, Literal, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.mechanism.blocks import blocks
from gearlink.core.mechanism.dynamics import System
from gearlink.core.mechanism.joints import (
    NEWTON_METER,
    Act,
    Column,
    Connection,
    Contact,
    Coupling,
    Flank,
    Guide,
    Mesh,
    Pin,
    Shared,
    SharedContact,
    Toothed,
    meshes_of,
)
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import Point, Rates, Turn, cross, dot
from gearlink.core.numerics.arrays import Points, Reals

Value: TypeAlias = Callable[[Mechanism], Sequence[Reals]]
"""What is looked at, out of the places and angles of links, and its derivative."""

_SAME_PLACE = 1e-9
"""Of its distance from the origin, by which a computed place may be off."""


@dataclass(frozen=True)
class Shift:
    """An error of a part: the elements of some joints on one link are displaced on it.

    Fields
        link : str - a link, or the frame
        joints : names of joints that the link has
        way : complex - by how much they move per unit of the error; of a turned one its real part [rad]
        frame : "link", in whose coordinates that is and which carries it along, "frame", "normal": along that of a
            roller on its cam, away from the cam, or "arm": along the arm of that roller, away from the origin of its
            link
        turned : bool - they turn about the origin of the link, counter-clockwise
        about : complex or None [mm] - another point of the link about which they turn, in its coordinates
    """

    link: str
    joints: tuple[str, ...]
    way: complex = 1.0
    frame: Literal["link", "frame", "normal", "arm"] = "link"
    turned: bool = False
    about: complex | None = None

    def scaled(self, factor: float) -> Shift:
        """The same shift per another unit of the error."""
        return replace(self, way=self.way * factor)


class Dual:
    """Gains of all errors at one output, over the inputs of a mechanism.

    Parameters
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
        """The mechanism whose meshes touch on the loaded flanks."""
        return on_flanks(self.mechanism, self.sides)

    @cached_property
    def forces(self) -> Mapping[str, Reals]:
        """By joint: its unknowns under the unit load, (unknowns, N)."""
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
            force, moment = self.force(shift.link, shift.joints)
            if shift.about is not None:
                moment = moment - cross(shift.about * unit_of(self.mechanism.link(shift.link)), force)
            return np.asarray(moment * complex(shift.way).real)
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
    """All forces on links by the unit of an unknown."""
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
    """Names of the pins and meshes whose element on a link is at a point of it [mm], where an error moves them."""
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
    """By size: the elements moved by an error of a link's length, all those at its end opposite to its origin.

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
    """The origin of the coordinates of a link; 0 for the frame."""
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


Errors = Sequence[tuple[Shift, "Reals | Points | float"]]
"""Shifts with their errors, of one machine or of N; complex where a shift is a vector."""
_STEPS = 12
_REST = 1e-14
"""A step that need not be made, in rad or of the size of the machine."""


class Chain:
    """A mechanism at some inputs.

    Parameters
        mechanism : Mechanism - of R rows
        sides : by mesh the sign of its tangential force, (R,) arrays - `Dual.sides`
    Example
        >>> from gearlink.core.parts.linkages.fourbar.mechanism import four_bar, four_bar_pins
        >>> from gearlink.core.parts.linkages.fourbar.position import FourBar, solve
        >>> bar, longer = FourBar(18.0, 50.0, 100.0, 121.4), FourBar(18.0, 51.0, 100.0, 121.4)
        >>> links = four_bar(bar, np.array([1.0]))
        >>> chain = Chain(Mechanism(links, four_bar_pins(links), "crank"), {})
        >>> turned = chain.output(lambda made: made.links["rocker"].turn, [(Shift("coupler", ("C",)), 1.0)])
        >>> bool(abs(turned[0, 0] - (solve(longer, 1.0).rocker_angle - solve(bar, 1.0).rocker_angle)) < 1e-14)
        True

    Source
        own derivation: the closure of every joint, displaced
    """

    def __init__(self, mechanism: Mechanism, sides: Mapping[str, Reals]) -> None:
        flanked = on_flanks(mechanism, sides)
        self._system = System(flanked, {})
        self.mechanism: Mechanism = _upright(flanked, {})

    @cached_property
    def _sizes(self) -> tuple[float, float, float]:
        """What displacements of a link are measured by: the maximum distance in the machine [mm], and 1 rad."""
        size = 1.0 + max(float(np.abs(link.origin.value).max()) for link in self.mechanism.links.values())
        return size, size, 1.0

    def output(self, value: Value, errors: Errors, before: Value | None = None) -> Reals:
        """The change of a value by the errors.

        Parameters
            value : function of the links, whose arrays are (R, N) - what is looked at
            errors : shifts with their errors
            before : what it is without errors, where it depends on them itself
        Returns
            change : (R, N) array - NaN where a machine does not close
        """
        moved = _Moved(self.mechanism, errors)
        with np.errstate(invalid="ignore", over="ignore"):
            last = 0.0
            for _ in range(_STEPS):
                step = self._step(self._gaps(moved), moved.shape)
                moved.by(step)
                far = max(
                    float(np.nanmax(np.abs(part), initial=0.0)) / self._sizes[k % 3] for k, part in enumerate(step)
                )
                if far * (min(1.0, far / last) if last else 1.0) <= _REST:  # the next, as steps shrink
                    break
                last = far
            else:
                moved.refuse(sum(np.abs(part) / self._sizes[k % 3] for k, part in enumerate(step)) > math.sqrt(_REST))
            found = np.asarray(value(moved.mechanism())[0]) - np.asarray((before or value)(self.mechanism)[0])
        return np.asarray(found + np.zeros(moved.shape))

    def _gaps(self, moved: _Moved) -> list[Any]:
        """How far the elements of every joint miss each other, by unknown; of the drive how far it stands ahead."""
        found = [gap for joint in self.mechanism.connections for gap in moved.gaps(joint)]
        if self.mechanism.gain is None:
            found.append(NEWTON_METER * self.mechanism.sense * moved.turn[self.mechanism.drive])
        return found

    def _step(self, gaps: list[Any], shape: tuple[int, int]) -> list[Reals]:
        """Displacements that close the gaps, three a link."""
        left, found = list(gaps), [np.zeros(0)] * self._system.size
        for rows, columns, matrix in self._blocks:
            if len(rows) == 1:
                solved = [-matrix[:, 0] * left[columns[0]]]
            else:
                missed = np.stack([np.broadcast_to(left[column], shape) for column in columns], axis=1)
                solved = list(np.moveaxis(-matrix @ missed, 1, 0))
            for row, displacement in zip(rows, solved, strict=True):
                found[row] = displacement
                for column, factor in self._others[row]:
                    if column not in columns:
                        left[column] = left[column] + factor * displacement
        return found

    @cached_property
    def _others(self) -> list[list[tuple[int, Any]]]:
        """By displacement the gaps that it changes, with the factor."""
        found: list[list[tuple[int, Any]]] = [[] for _ in range(self._system.size)]
        for column, entries in enumerate(self._system.entries):
            for row, factor in entries.items():
                if np.any(factor):
                    found[row].append((column, factor[:, None] if isinstance(factor, np.ndarray) else factor))
        return found

    @cached_property
    def _blocks(self) -> list[tuple[tuple[int, ...], tuple[int, ...], Reals]]:
        """Displacements that are found together, the gaps that give them, and the inverse of what joins them."""
        found = []
        entries = self._system.entries
        for rows, columns in reversed(blocks(tuple(tuple(each) for each in entries))):
            matrix = np.zeros((self._system.mechanism.rows, len(columns), len(rows)))
            for i, column in enumerate(columns):
                for j, row in enumerate(rows):
                    matrix[:, i, j] = entries[column].get(row, 0.0)
            found.append((rows, columns, _inverse(matrix)))
        return found


def _inverse(matrix: Reals) -> Reals:
    try:
        return np.asarray(np.linalg.inv(matrix), dtype=np.float64)
    except np.linalg.LinAlgError:
        raise NoSolution("the errors have no end: two links of the mechanism are collinear") from None


def _upright(part: Any, done: dict[int, Reals]) -> Any:
    """A mechanism or a part of it with its rows one below the other, so that machines stand side by side.

    Parameters
        done : by identity of an array, what became of it: what is one array stays one
    """
    if isinstance(part, np.ndarray):
        return done.setdefault(id(part), part[:, None])
    if isinstance(part, Rates):
        return type(part)(*(_upright(each, done) for each in part))
    if isinstance(part, Mapping):
        return {name: _upright(each, done) for name, each in part.items()}
    if isinstance(part, Act):
        return Act(*(_upright(each, done) for each in part))
    if isinstance(part, (list, tuple)):
        return [_upright(each, done) for each in part]
    if is_dataclass(part) and not isinstance(part, type):
        parts = {each.name: _upright(getattr(part, each.name), done) for each in fields(part) if each.init}
        return replace(part, **parts)
    return part


class _Moved:
    """Where the links of a mechanism stand: displacements of their origins and turns, and errors of their elements."""

    def __init__(self, mechanism: Mechanism, errors: Errors) -> None:
        self.nominal = mechanism
        self.shape = mechanism.rows, max((np.size(error) for _, error in errors), default=1)
        self.place: dict[str, Any] = dict.fromkeys((FRAME, *mechanism.links), 0j)
        self.turn: dict[str, Any] = dict.fromkeys((FRAME, *mechanism.links), 0.0)
        self.spun: dict[str, Any] = dict.fromkeys((FRAME, *mechanism.links), 0j)
        self._shifts: dict[tuple[str, str], list[tuple[Shift, Any]]] = {}
        for shift, error in errors:
            for joint in joints_of(mechanism, shift.link, shift.joints):
                self._shifts.setdefault((shift.link, joint.name), []).append((shift, error))

    def by(self, step: Sequence[Reals]) -> None:
        """Move the links by three displacements each."""
        for k, name in enumerate(self.nominal.links):
            way = np.empty(self.shape, dtype=np.complex128)
            way.real, way.imag = step[3 * k], step[3 * k + 1]
            self.place[name] = self.place[name] + way
            self.turn[name] = self.turn[name] + step[3 * k + 2]
            self.spun[name] = _spin(self.turn[name])

    def refuse(self, rows: Any) -> None:
        """Remove the samples that do not converge."""
        for name in self.nominal.links:
            self.turn[name] = np.where(rows, math.nan, self.turn[name])
            self.place[name] = np.where(rows, math.nan, self.place[name])

    def mechanism(self) -> Mechanism:
        """The links at their current positions."""
        links = {
            name: Link(
                Point(link.origin.value + self.place[name]), Turn(link.turn.value + self.turn[name]), link.points
            )
            for name, link in self.nominal.links.items()
        }
        return Mechanism(links, (), self.nominal.drive)

    def of(self, link: str, joint: str, at: Points | complex) -> Any:
        """The displacement of the element of a joint on a link [mm]."""
        body, shifts = self.nominal.link(link), self._shifts.get((link, joint))
        if shifts is None and (link == FRAME or at is origin_of(body)):
            return self.place[link]
        arm, spun = at - origin_of(body), self.spun[link]
        if shifts is None:
            return self.place[link] + arm * spun
        # on the link the element is turned first, about its origin, and then moved as it lies
        turns = [(shift.about, complex(shift.way).real * error) for shift, error in shifts if shift.turned]
        askew = _spin(sum(turn for about, turn in turns if about is None))
        moved: Any = arm * askew
        for about, turn in turns:
            moved = moved if about is None else moved + (arm - about * unit_of(body)) * _spin(turn)
        beside: Any = 0.0
        for shift, error in (each for each in shifts if not each[0].turned):
            if shift.frame == "link":
                moved = moved + shift.way * error * unit_of(body) * (1.0 + askew)
            else:
                beside = beside + shift.way * error * (self._normals[joint] if shift.frame == "normal" else 1.0)
        return self.place[link] + arm * spun + moved * (1.0 + spun) + beside

    @cached_property
    def _normals(self) -> dict[str, Points]:
        """By roller, the normal of its cam where neither has errors."""
        return {
            each.name: each.normal for each in self.nominal.connections if isinstance(each, (Contact, SharedContact))
        }

    def turned(self, link: str, joint: str) -> Any:
        """The rotation error of the element [rad]."""
        found: Any = self.turn[link]
        for shift, error in self._shifts.get((link, joint), ()):
            if shift.turned:
                found = found + complex(shift.way).real * error
        return found

    def gaps(self, joint: Connection) -> Iterator[Any]:
        """The residual of the second element against the first, by unknown of the joint and in its unit."""
        if isinstance(joint, Flank):
            yield self._flank(joint)
        elif isinstance(joint, Coupling):
            yield NEWTON_METER * (
                self.turned(joint.second, joint.name) - joint.ratio * self.turned(joint.first, joint.name)
            )
        elif isinstance(joint, SharedContact):
            yield sum(share * self._contact(joint, cam) for cam, share in joint.shares.items())
        elif isinstance(joint, Contact):
            yield self._contact(joint, joint.first)
        elif isinstance(joint, Shared):
            yield sum(
                dot(act.force, self.of(act.on, joint.name, act.at)) + act.couple * self.turned(act.on, joint.name)
                for act in joint.acts
            )
        else:
            assert isinstance(joint, (Pin, Guide)), "meshes touch on flanks"
            missed = self.of(joint.second, joint.name, joint.at) - self.of(joint.first, joint.name, joint.at)
            if isinstance(joint, Pin):
                yield missed.real
                yield missed.imag
            else:
                turned = self.turned(joint.first, joint.name)
                yield dot(1j * joint.along * (1.0 + _spin(turned)), missed)
                yield NEWTON_METER * (self.turned(joint.second, joint.name) - turned)

    def _contact(self, joint: Contact | SharedContact, cam: str) -> Any:
        """A roller off the pitch curve of a cam, along its normal."""
        missed = self.of(joint.second, joint.name, joint.at) - self.of(cam, joint.name, joint.at)
        missed = missed * np.conj(1.0 + _spin(self.turned(cam, joint.name)))  # as the cam sees it
        along = dot(1j * joint.normal, missed)
        return dot(joint.normal, missed) + 0.5 * joint.curvature * along * along

    def _flank(self, joint: Flank) -> Any:
        teeth = joint.teeth
        if isinstance(teeth, Mesh):
            return self._mesh(teeth, joint.side)
        missed = self.of(joint.second, joint.name, teeth.center) - self.of(joint.first, joint.name, teeth.center)
        (column,), radial = teeth.columns(), teeth.radial()
        rolled = dot(column.force, 1j * (teeth.pitch_point - teeth.center)) * self.turned(joint.second, joint.name)
        turned = np.asarray(column.couple) * self.turned(joint.second, joint.name)
        return dot(column.force + joint.side * radial.force, missed) + rolled + turned

    def _mesh(self, mesh: Mesh, side: Reals) -> Any:
        """Two involutes on one flank: a crossed belt over the base circles.

        [r1 (t1 - beta) + r2 (t2 - beta)] cos alpha + s (r1 + r2) cos alpha (inv alpha' - inv alpha), less its value
        without errors; beta the direction of the line of centres, cos alpha' = (r1 + r2) cos alpha/its length
        """
        r1, r2 = mesh.radius, -mesh.mate_radius if mesh.internal else mesh.mate_radius
        centers = r1 + r2
        other = mesh.center + centers * mesh.toward
        missed = self.of(mesh.second, mesh.name, other) - self.of(mesh.first, mesh.name, mesh.center)
        line = 1.0 + missed * np.conj(mesh.toward) / centers
        swung = np.arctan2(line.imag, line.real)
        tangent = np.sqrt((1.0 + mesh.tangent**2) * (line.real**2 + line.imag**2) - 1.0)  # of the working angle
        rolled = centers * swung - r1 * self.turned(mesh.first, mesh.name) - r2 * self.turned(mesh.second, mesh.name)
        radial = -side if mesh.internal else side
        return rolled + radial * centers * (tangent - mesh.tangent - np.arctan(tangent) + math.atan(mesh.tangent))


def _spin(turn: Any) -> Any:
    """e^(i t) - 1, exact for small turns and right for those of less than half a revolution."""
    if not np.any(turn):
        return 0j
    half = np.sin(0.5 * turn)
    square = half * half
    return -2.0 * square + 2j * (half * np.sqrt(1.0 - square))
