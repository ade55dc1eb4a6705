"""Torque by virtual power and all reactions by Newton and Euler, over arrays of input angles.

Both use the same links and agree to rounding in every row, so that each checks the other. Computed in mm, N and t;
results are in kg m^2, N and N m.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.mechanism.blocks import Block, blocks
from gearlink.core.mechanism.joints import NEWTON_METER, Act, Column, meshes_of
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.mechanism.rates import Point, cross, dot
from gearlink.core.numerics.arrays import Points, Reals


@dataclass(frozen=True, slots=True)
class Mass:
    """Mass [kg], inertia about the centre of mass [kg m^2] and that centre in link coordinates [mm]."""

    mass: float = 0.0
    inertia: float = 0.0
    center: complex = 0j

    @property
    def tonnes(self) -> float:
        """Mass [t]."""
        return self.mass / 1e3

    @property
    def moment(self) -> float:
        """Inertia [t mm^2]."""
        return self.inertia * NEWTON_METER


class Force(NamedTuple):
    """A force [N] on a link at a point of it."""

    on: str
    force: Points
    at: Point


class Torque(NamedTuple):
    """A torque [N mm] on a link, counter-clockwise positive."""

    on: str
    torque: Reals


Applied = Sequence[Force | Torque]
Masses = Mapping[str, Mass]
Factor = Reals | float
Side = dict[int, Factor]
"""A right side by equation; those that are left out are 0, and a number is the same in every row."""
Left = list[dict[int, Factor]]


@dataclass(frozen=True, slots=True)
class Reduced:
    """Inertia and load reduced to the input.

    Fields
        inertia : (N,) array [kg m^2] - J(phi)
        slope : (N,) array [kg m^2/rad] - dJ/dphi
        weight, applied : (N,) arrays [N m] - Q by gravity, and by forces, torques and springs
    """

    inertia: Reals
    slope: Reals
    weight: Reals
    applied: Reals

    def torque(self, speed: Reals | float, acceleration: Reals | float = 0.0) -> Reals:
        """Input torque J al + J' w^2/2 - Q [N m] at a speed [rad/s] and acceleration [rad/s^2] of the input."""
        return np.asarray(self.inertial(speed, acceleration) + self.static)

    def inertial(self, speed: Reals | float, acceleration: Reals | float = 0.0) -> Reals:
        """The part of the input torque that accelerates the masses."""
        return np.asarray(self.inertia * acceleration + 0.5 * self.slope * (speed * np.asarray(speed)))

    @property
    def static(self) -> Reals:
        """The part of the input torque that balances the load, -Q [N m]."""
        return np.asarray(-(self.weight + self.applied))


def reduced(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, shaft_inertia: float = 0.0
) -> Reduced:
    """Inertia and load reduced to the input.

    J = sum(m |G'|^2 + J t'^2),  J' = 2 sum(m G'.G'' + J t' t''),  Q = sum m g.G' + sum F.P' + sum T t'

    Parameters
        masses : by link; a link that is left out has none
        applied : forces and torques, springs among them
        gravity : complex [mm/s^2]
        shaft_inertia : float [kg m^2] - of what turns evenly with the input, reduced to it
    Source
        virtual power; no differences are taken
    """
    inertia, slope, weight, load = (np.zeros(mechanism.rows) for _ in range(4))
    for name, mass in masses.items():
        link = mechanism.links[name]
        center, turn = link.at(mass.center), link.turn
        inertia += mass.tonnes * dot(center.first, center.first) + mass.moment * turn.first**2
        slope += 2.0 * (mass.tonnes * dot(center.first, center.second) + mass.moment * turn.first * turn.second)
        weight += mass.tonnes * dot(gravity, center.first)
    for each in applied:
        if isinstance(each, Force):
            load += dot(each.force, each.at.first)
        else:
            load += each.torque * mechanism.links[each.on].turn.first
    inertia, slope, weight, load = (each / NEWTON_METER for each in (inertia, slope, weight, load))
    return Reduced(inertia + shaft_inertia, slope, weight, load)


def power_parts(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, speed: Reals | float
) -> Reals:
    """Sum of the magnitudes of all terms of the input torque [N m], before any cancellation.

    sum (m |G'| (|G''| w^2 + |g|) + J |t' t''| w^2) + sum |F| |P'| + sum |T t'|

    Parameters
        mechanism, masses, applied, gravity : as in `reduced`
        speed : float or (N,) array [rad/s]
    """
    found, square = np.zeros(mechanism.rows), np.asarray(speed) ** 2
    for name, mass in masses.items():
        link = mechanism.links[name]
        center, turn = link.at(mass.center), link.turn
        found += mass.tonnes * np.abs(center.first) * (np.abs(center.second) * square + abs(gravity))
        found += mass.moment * np.abs(turn.first * turn.second) * square
    for each in applied:
        if isinstance(each, Force):
            found += np.abs(each.force) * np.abs(each.at.first)
        else:
            found += np.abs(each.torque * mechanism.links[each.on].turn.first)
    return found / NEWTON_METER


@dataclass(frozen=True, slots=True)
class Reactions:
    """All forces and couples between the links.

    Fields
        unknowns : by connection - (unknowns, N) array: X and Y of a pin, N and couple of a guide, F_t, N; [N], [N m]
        torque : (N,) array [N m] - of the drive, in the sense of the input
    """

    unknowns: Mapping[str, Reals]
    torque: Reals
    mechanism: Mechanism

    def force(self, name: str) -> Points:
        """Force on the second link [N] as a plane vector; of a mesh the tangential part alone."""
        connection = next(each for each in self.mechanism.connections if each.name == name)
        total = np.zeros(self.mechanism.rows, dtype=np.complex128)
        for value, column in zip(self.unknowns[name], connection.columns(), strict=True):
            total += value * column.force
        return total

    def radial(self, name: str) -> Points:
        """Radial force of a mesh on the second gear [N]."""
        mesh = next(each for each in meshes_of(self.mechanism) if each.name == name)
        return np.asarray(np.abs(self.unknowns[name][0]) * mesh.radial().force)


class System:
    """The equations of Newton and Euler of a mechanism, three a link, and their solution.

    Matrix and right sides are kept by their entries, each an array over the input angles or a number; they are solved
    block by block.
    """

    def __init__(self, mechanism: Mechanism, masses: Masses) -> None:
        self.mechanism = mechanism
        self.index = {name: i for i, name in enumerate(mechanism.links)}
        self.centers = {name: link.at(masses.get(name, Mass()).center) for name, link in mechanism.links.items()}
        self.masses = masses
        self.columns = [(each.name, column) for each in mechanism.connections for column in each.columns()]
        if mechanism.gain is None:
            place = np.zeros(mechanism.rows, dtype=np.complex128)
            self.columns.append(("drive", Column(FRAME, mechanism.drive, 0j, place, mechanism.sense * NEWTON_METER)))
        self.size = 3 * len(self.index)
        if len(self.columns) != self.size:
            raise AssertionError(f"{len(self.columns)} unknowns for {self.size} equations")

    @cached_property
    def entries(self) -> list[dict[int, Factor]]:
        """By unknown: its factor in each equation in which it occurs; a number where it is the same in every row."""
        return [self.factors(column) for _, column in self.columns]

    def factors(self, column: Column) -> dict[int, Factor]:
        """The contribution of a unit of an unknown to each equation."""
        found: dict[int, Factor] = {}
        acts = [
            Act(column.second, column.force, column.at, column.couple),
            *column.also,
            Act(column.first, -column.force, column.at, -column.couple),
        ]
        for act in (act for act in acts if act.on != FRAME):
            for row, value in self._act(act):
                found[row] = found[row] + value if row in found else value
        return found

    def _act(self, act: Act) -> Iterator[tuple[int, Factor]]:
        """What a force and a couple on a link add to its equations; zeros by structure are left out."""
        k, force, couple = 3 * self.index[act.on], act.force, act.couple
        if isinstance(force, np.ndarray):
            yield k, force.real
            yield k + 1, force.imag
        else:
            if force.real:
                yield k, force.real
            if force.imag:
                yield k + 1, force.imag
            if not force:
                if isinstance(couple, np.ndarray) or couple:
                    yield k + 2, couple
                return
        if act.at is not self.centers[act.on].value:
            moment = _moment(self._arm(act.on, act.at), force)
            yield k + 2, moment + couple if isinstance(couple, np.ndarray) or couple else moment
        elif isinstance(couple, np.ndarray) or couple:
            yield k + 2, couple

    def _arm(self, link: str, at: Points) -> Points:
        """From the centre of mass of a link to a place; a joint asks for it once for each of its unknowns."""
        key = link, id(at)
        if key not in self._arms:
            self._arms[key] = at, np.asarray(at - self.centers[link].value)  # `at` is held, so that no other has its id
        return self._arms[key][1]

    @cached_property
    def _arms(self) -> dict[tuple[str, int], tuple[Points, Points]]:
        return {}

    def side(self, acts: Iterable[Act]) -> Side:
        """The right side that forces and couples from outside make."""
        found: Side = {}
        for act in acts:
            if act.on != FRAME:
                for row, value in self._act(act):
                    found[row] = found[row] - value if row in found else -value
        return found

    def right_side(self, applied: Applied, gravity: complex, speed: Reals | float, acceleration: Reals | float) -> Side:
        """Inertia less what is applied."""
        side = self.side(
            Act(each.on, each.force, each.at.value, 0.0) if isinstance(each, Force) else _couple(each)
            for each in applied
        )
        square = np.asarray(speed) ** 2
        for name, mass in self.masses.items():
            k, center, turn = 3 * self.index[name], self.centers[name], self.mechanism.links[name].turn
            force = mass.tonnes * (center.second * square + center.first * acceleration - gravity)
            couple = mass.moment * (turn.second * square + turn.first * acceleration)
            for row, value in ((k, force.real), (k + 1, force.imag), (k + 2, couple)):
                side[row] = side[row] + value if row in side else value
        return side

    def place(self, name: str) -> int:
        """Number of the first unknown of a connection."""
        return next(i for i, (each, _) in enumerate(self.columns) if each == name)

    def radials(self) -> list[Side]:
        """For each mesh the right side of a unit of its radial force."""
        found = []
        for mesh in meshes_of(self.mechanism):
            force, at = mesh.radial()
            found.append(self.side([Act(mesh.second, force, at, 0.0), Act(mesh.first, -force, at, 0.0)]))
        return found

    def solve(self, sides: Sequence[Side]) -> Reals:
        """The unknowns to some right sides, (sides, n, N).

        Raises
            NoSolution - where the system is singular
        """
        # by equation: what is left of each side that has anything in it; most of them reach few equations
        left: Left = [{} for _ in range(self.size)]
        for number, side in enumerate(sides):
            for row, value in side.items():
                if value.any() if isinstance(value, np.ndarray) else value:
                    left[row][number] = value
        found = np.zeros((len(sides), self.size, self.mechanism.rows))
        try:
            for block in blocks(tuple(tuple(entries) for entries in self.entries)):
                self._solve_block(block, left, found)
        except np.linalg.LinAlgError:
            raise NoSolution("the joint forces are not finite: two links of the mechanism are collinear") from None
        return found

    def _solve_block(self, block: Block, left: Left, found: Reals) -> None:
        """Solve for the unknowns of a block, (sides, n, N), and take what they do off the equations that are left."""
        rows, columns = block
        sides = sorted(set().union(*(left[row] for row in rows)))
        if len(rows) == 1:
            factor = self.entries[columns[0]][rows[0]]
            if not (factor.all() if isinstance(factor, np.ndarray) else factor):
                raise np.linalg.LinAlgError
            for side in sides:
                np.divide(left[rows[0]][side], factor, out=found[side, columns[0]])
        else:
            solved = np.linalg.solve(self._matrix(block), self._right(rows, sides, left))
            for i, column in enumerate(columns):
                found[sides, column] = solved[:, i].T
        for column in columns:
            for row, factor in self.entries[column].items():
                if row not in rows:
                    for side in sides:
                        taken, there = factor * found[side, column], left[row]
                        there[side] = there[side] - taken if side in there else -taken

    def _matrix(self, block: Block) -> Reals:
        """The equations of a block in its unknowns, (N, k, k)."""
        place = {row: i for i, row in enumerate(block.rows)}
        found = np.zeros((self.mechanism.rows, len(place), len(place)))
        for j, column in enumerate(block.columns):
            for row, factor in self.entries[column].items():
                if row in place:
                    found[:, place[row], j] = factor
        return found

    def _right(self, rows: Sequence[int], sides: Sequence[int], left: Left) -> Reals:
        """What is left of some sides in some equations, (N, k, sides)."""
        found = np.zeros((self.mechanism.rows, len(rows), len(sides)))
        for i, row in enumerate(rows):
            for j, side in enumerate(sides):
                if side in left[row]:
                    found[:, i, j] = left[row][side]
        return found

    def reactions(self, solution: Reals) -> Reactions:
        """The unknowns by connection."""
        rows: dict[str, list[Reals]] = {}
        for k, (name, _) in enumerate(self.columns):
            rows.setdefault(name, []).append(solution[k])
        gain = self.mechanism.gain
        torque = rows.pop("drive")[0] if gain is None else gain * rows[self.mechanism.drive][0] / NEWTON_METER
        return Reactions({name: np.array(values) for name, values in rows.items()}, torque, self.mechanism)


def _moment(arm: Points, force: Points | complex) -> Reals:
    """arm x force; of a force along an axis the one product that is not zero."""
    if not isinstance(force, np.ndarray):
        if not force.imag:
            return np.asarray(-(arm.imag * force.real))
        if not force.real:
            return np.asarray(arm.real * force.imag)
    return np.asarray(arm.real * force.imag - arm.imag * force.real)


def _couple(torque: Torque) -> Act:
    return Act(torque.on, 0j, np.zeros(0, dtype=np.complex128), torque.torque)


def shaking(mechanism: Mechanism, masses: Masses, speed: Reals | float, acceleration: Reals | float = 0.0) -> tuple[
    Points, Reals
]:  # fmt: skip
    """Shaking force [N] and moment about the pivot [N m] of the masses on the frame.

    F = -sum m a,  M = -sum [(G - A) x m a + J al]
    """
    force, moment = np.zeros(mechanism.rows, dtype=np.complex128), np.zeros(mechanism.rows)
    square = np.asarray(speed) ** 2
    for name, mass in masses.items():
        link = mechanism.links[name]
        center, turn = link.at(mass.center), link.turn
        inertial = mass.tonnes * (center.second * square + center.first * acceleration)
        force -= inertial
        moment -= cross(center.value - mechanism.pivot, inertial)
        moment -= mass.moment * (turn.second * square + turn.first * acceleration)
    return force, moment / NEWTON_METER
