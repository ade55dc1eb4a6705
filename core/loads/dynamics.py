"""Torque by virtual power and all reactions by Newton and Euler, over arrays of input angles.

Both start from the same links; they agree to rounding at every row, which is the check of either. SI units.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import NamedTuple, TypeAlias

import numpy as np
import numpy.typing as npt

from gearlink.core.errors import NoSolution
from gearlink.core.loads.kinematics import Point, cross, dot
from gearlink.core.loads.mechanism import FRAME, Column, Mechanism
from gearlink.core.numerics.arrays import Points, Reals


@dataclass(frozen=True, slots=True)
class Mass:
    """Mass [kg], inertia about the centre of mass [kg m^2] and that centre in link coordinates [m]."""

    mass: float = 0.0
    inertia: float = 0.0
    center: complex = 0j


class Force(NamedTuple):
    """A force [N] on a link at a point of it."""

    on: str
    force: Points
    at: Point


class Torque(NamedTuple):
    """A torque [N m] on a link, counter-clockwise positive."""

    on: str
    torque: Reals


Rows: TypeAlias = npt.NDArray[np.intp]
_ALL = slice(None)
_BLOCK = 2048

Applied = Sequence[Force | Torque]
Masses = Mapping[str, Mass]


@dataclass(frozen=True, slots=True)
class Reduced:
    """What the input feels.

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
        """The part of it that accelerates the masses."""
        return np.asarray(self.inertia * acceleration + 0.5 * self.slope * (speed * np.asarray(speed)))

    @property
    def static(self) -> Reals:
        """The part of it that holds the load, -Q [N m]."""
        return np.asarray(-(self.weight + self.applied))


def reduced(
    mechanism: Mechanism, masses: Masses, applied: Applied, gravity: complex, shaft_inertia: float = 0.0
) -> Reduced:
    """Inertia and load as the input feels them.

    J = sum(m |G'|^2 + J t'^2),  J' = 2 sum(m G'.G'' + J t' t''),  Q = sum m g.G' + sum F.P' + sum T t'

    Parameters
        mechanism : Mechanism
        masses : by link; a link that is left out has none
        applied : forces and torques, springs among them
        gravity : complex [m/s^2]
        shaft_inertia : float [kg m^2] - of what turns evenly with the input, reduced to it
    Source
        virtual power; no differences are taken
    """
    inertia, slope, weight, load = (np.zeros(mechanism.rows) for _ in range(4))
    for name, mass in masses.items():
        link = mechanism.links[name]
        center, turn = link.at(mass.center), link.turn
        inertia += mass.mass * dot(center.first, center.first) + mass.inertia * turn.first**2
        slope += 2.0 * (mass.mass * dot(center.first, center.second) + mass.inertia * turn.first * turn.second)
        weight += mass.mass * dot(gravity, center.first)
    for each in applied:
        if isinstance(each, Force):
            load += dot(each.force, each.at.first)
        else:
            load += each.torque * mechanism.links[each.on].turn.first
    return Reduced(inertia + shaft_inertia, slope, weight, load)


@dataclass(frozen=True, slots=True)
class Reactions:
    """Everything that the links exchange.

    Fields
        unknowns : by connection - (unknowns, N) array: X and Y of a pin, N and couple of a guide, F_t, N
        torque : (N,) array [N m] - of the drive, in the sense of the input
        mechanism : Mechanism
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
        mesh = next(each for each in self.mechanism.meshes if each.name == name)
        return np.asarray(np.abs(self.unknowns[name][0]) * mesh.radial().force)


class System:
    """The equations of Newton and Euler of a mechanism, three a link, and their solution."""

    def __init__(self, mechanism: Mechanism, masses: Masses) -> None:
        self.mechanism = mechanism
        self.index = {name: i for i, name in enumerate(mechanism.links)}
        self.centers = {name: link.at(masses.get(name, Mass()).center) for name, link in mechanism.links.items()}
        self.masses = masses
        self.columns = [(each.name, column) for each in mechanism.connections for column in each.columns()]
        if mechanism.gain is None:
            place = np.zeros(mechanism.rows, dtype=np.complex128)
            self.columns.append(("drive", Column(FRAME, mechanism.drive, 0j, place, mechanism.sense)))
        size = 3 * len(self.index)
        if len(self.columns) != size:
            raise AssertionError(f"{len(self.columns)} unknowns for {size} equations")
        self.size = size
        self.inverse: Reals | None = None

    def matrix(self, rows: Rows) -> Reals:
        """The equations of some of the input angles, (rows, n, n)."""
        found = np.zeros((self.size, self.size, len(rows)))  # input angles last: each entry is a row in the memory
        for k, (_, column) in enumerate(self.columns):
            self._put(found[k], column.first, column.second, column.force, column.at, column.couple, rows)
            for act in column.also:
                self._put(found[k], FRAME, act.on, act.force, act.at, act.couple, rows)
        return found.transpose(2, 1, 0)

    def _put(
        self,
        entries: Reals,
        first: str,
        second: str,
        force: Points | complex,
        at: Points,
        couple: Reals | float,
        rows: Rows | slice = _ALL,
    ) -> None:
        """Add a force and a couple on the second link, and their opposites on the first, to (n, rows) equations."""
        at = at[rows]
        force = force[rows] if isinstance(force, np.ndarray) else force
        couple = couple[rows] if isinstance(couple, np.ndarray) else couple
        for name, sign in ((second, 1.0), (first, -1.0)):
            if name != FRAME:
                k = 3 * self.index[name]
                entries[k] += sign * force.real
                entries[k + 1] += sign * force.imag
                entries[k + 2] += sign * (cross(at - self.centers[name].value[rows], force) + couple)

    def right_side(
        self, applied: Applied, gravity: complex, speed: Reals | float, acceleration: Reals | float
    ) -> Reals:
        """Inertia less what is applied, (n, N)."""
        side = np.zeros((self.size, self.mechanism.rows))
        square = np.asarray(speed) ** 2
        for name, mass in self.masses.items():
            k, center, turn = 3 * self.index[name], self.centers[name], self.mechanism.links[name].turn
            force = mass.mass * (center.second * square + center.first * acceleration - gravity)
            side[k] += force.real
            side[k + 1] += force.imag
            side[k + 2] += mass.inertia * (turn.second * square + turn.first * acceleration)
        for each in applied:
            if isinstance(each, Force):
                self._put(side, each.on, FRAME, each.force, each.at.value, 0.0)
            else:
                side[3 * self.index[each.on] + 2] -= each.torque
        return side

    def solve(self, side: Reals, rows: Rows | None = None) -> Reals:
        """The unknowns, (n, N), the radial forces of the teeth included; of some rows where they are given.

        Notes
            The radial force of a mesh acts along the link that joins its axes (or into a guide), so it changes no
            tangential force. The answer to a unit of each is found with the same factors and added once.
        """
        meshes = self.mechanism.meshes
        rows = np.arange(self.mechanism.rows) if rows is None else rows
        sides = np.zeros((1 + len(meshes), self.size, len(rows)))
        sides[0] = side[:, rows]
        for k, mesh in enumerate(meshes, 1):
            radial = mesh.radial()
            self._put(sides[k], mesh.second, mesh.first, radial.force, radial.at, 0.0, rows)
        found = self._solved(sides, rows)
        result = found[0].copy()
        for k, mesh in enumerate(meshes, 1):
            place = next(i for i, (name, _) in enumerate(self.columns) if name == mesh.name)
            result += np.abs(found[0, place]) * found[k]
        return np.asarray(result)

    def invert(self) -> None:
        """Keep the inverse, for many solutions of few rows.

        Notes
            Relative error about eps times the condition, as of a solution; the power identity holds it.
        """
        if self.mechanism.rows <= _BLOCK:
            self.inverse = np.asarray(np.linalg.inv(self.matrix(np.arange(self.mechanism.rows))))

    def _solved(self, sides: Reals, rows: Rows) -> Reals:
        """The unknowns to some right sides, (sides, n, N); a block of rows at a time, for the memory's sake."""
        found = np.empty_like(sides)
        try:
            for start in range(0, len(rows), _BLOCK):
                part = slice(start, start + _BLOCK)
                right = sides[:, :, part].transpose(2, 1, 0)
                if self.inverse is not None and len(rows) == len(self.inverse):
                    block: Reals = np.asarray(self.inverse @ right)
                else:
                    block = np.asarray(np.linalg.solve(self.matrix(rows[part]), right))
                found[:, :, part] = block.transpose(2, 1, 0)
        except np.linalg.LinAlgError:
            raise NoSolution("the joint forces are not finite: two links of the mechanism stand in line") from None
        return found

    def reactions(self, solution: Reals) -> Reactions:
        """The unknowns by connection."""
        rows: dict[str, list[Reals]] = {}
        for k, (name, _) in enumerate(self.columns):
            rows.setdefault(name, []).append(solution[k])
        gain = self.mechanism.gain
        torque = rows.pop("drive")[0] if gain is None else gain * rows[self.mechanism.drive][0]
        return Reactions({name: np.array(values) for name, values in rows.items()}, torque, self.mechanism)


def reactions(
    mechanism: Mechanism,
    masses: Masses,
    applied: Applied,
    gravity: complex,
    speed: Reals | float,
    acceleration: Reals | float = 0.0,
) -> Reactions:
    """All joint and tooth forces and the input torque, by Newton and Euler.

    sum F = m (a - g),  sum (P - G) x F + sum T = J al    for every link

    Parameters
        mechanism : Mechanism - with as many unknowns as three a link
        masses, applied, gravity : as of `reduced`
        speed, acceleration : float or (N,) array [rad/s, rad/s^2] - of the input
    Raises
        NoSolution - where the system is singular
    Notes
        One dense system a row. Relative error of the largest force about eps/sin(transmission angle).
    Source
        Newton and Euler
    """
    system = System(mechanism, masses)
    return system.reactions(system.solve(system.right_side(applied, gravity, speed, acceleration)))


def shaking(mechanism: Mechanism, masses: Masses, speed: Reals | float, acceleration: Reals | float = 0.0) -> tuple[
    Points, Reals
]:  # fmt: skip
    """Force [N] and moment about the pivot [N m] that the masses put on the frame.

    F = -sum m a,  M = -sum [(G - A) x m a + J al]
    """
    force, moment = np.zeros(mechanism.rows, dtype=np.complex128), np.zeros(mechanism.rows)
    square = np.asarray(speed) ** 2
    for name, mass in masses.items():
        link = mechanism.links[name]
        center, turn = link.at(mass.center), link.turn
        inertial = mass.mass * (center.second * square + center.first * acceleration)
        force -= inertial
        moment -= cross(center.value - mechanism.pivot, inertial)
        moment -= mass.inertia * (turn.second * square + turn.first * acceleration)
    return force, moment
