"""A mechanism whose parts have errors, closed at one input: by Newton with the matrix of its forces, transposed.

Every joint says how far its two elements miss each other where the links stand; teeth do so by the involutes of their
base circles on one flank, a roller by the parabola of its cam's pitch curve. The steps take the matrix of the mechanism
without errors, so that each leaves the share error/length of the last.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Iterator, Mapping
from functools import cached_property
from typing import Any

import numpy as np

from gearlink.core.mechanism.blocks import blocks
from gearlink.core.mechanism.dual import Shift, Value, joints_of, on_flanks, origin_of, unit_of
from gearlink.core.mechanism.dynamics import System
from gearlink.core.mechanism.joints import (
    NEWTON_METER,
    Connection,
    Contact,
    Coupling,
    Flank,
    Guide,
    Mesh,
    Pin,
    SharedContact,
)
from gearlink.core.mechanism.links import FRAME, Link, Mechanism
from gearlink.core.mechanism.rates import Point, Turn, dot
from gearlink.core.numerics.arrays import Points, Reals

Errors = Iterable[tuple[Shift, "Reals | Points"]]
"""Shifts with their errors, floats or (N,) arrays; complex ones where a shift is a vector."""
_STEPS = 12
_REST = 1e-14
"""Of the size of the machine: a step that ends the search."""


class Chain:
    """A mechanism at one input.

    Parameters
        mechanism : Mechanism - of one row
        sides : by mesh the sign of its tangential force, (1,) arrays - `Dual.sides`
    Source
        own derivation: the closure of every joint, displaced
    """

    def __init__(self, mechanism: Mechanism, sides: Mapping[str, Reals]) -> None:
        self.mechanism = on_flanks(mechanism, sides)
        self._system = System(self.mechanism, {})

    @cached_property
    def _size(self) -> float:
        """Greatest distance in the machine [mm]."""
        return float(max(np.abs(link.origin.value).max() for link in self.mechanism.links.values())) + 1.0

    def output(self, value: Value, errors: Errors) -> Reals:
        """By how much errors change a value.

        Parameters
            value : function of the links - what is looked at
            errors : shifts with their errors
        Returns
            change : (N,) array - NaN where the machine does not close
        """
        moved = _Moved(self.mechanism, list(errors))
        with np.errstate(invalid="ignore", over="ignore"):
            for _ in range(_STEPS):
                step = self._step(self._gaps(moved))
                moved.by(step)
                if not self._far(step):
                    break
            else:
                moved.refuse(np.abs(step).max(axis=0) > math.sqrt(_REST) * self._size)
            found = np.asarray(value(moved.mechanism())[0]) - np.asarray(value(self.mechanism)[0])
        return np.asarray(found + np.zeros(moved.count))

    def _far(self, step: Reals) -> bool:
        largest = np.abs(step)
        return bool((largest > _REST * self._size).any()) and bool(np.isfinite(largest).any())

    def _gaps(self, moved: _Moved) -> list[Any]:
        """How far the elements of every joint miss each other, by unknown; of the drive how far it stands ahead."""
        found = [gap for joint in self.mechanism.connections for gap in moved.gaps(joint)]
        if self.mechanism.gain is None:
            found.append(NEWTON_METER * self.mechanism.sense * moved.turn[self.mechanism.drive])
        return found

    def _step(self, gaps: list[Any]) -> Reals:
        """Displacements that close the gaps, three a link, (unknowns, N)."""
        left, found = list(gaps), np.zeros((self._system.size, max(np.size(gap) for gap in gaps)))
        for rows, columns, matrix in self._blocks:
            solved = -matrix @ np.stack([np.broadcast_to(left[column], found.shape[1:]) for column in columns])
            found[list(rows)] = solved
            for row, displacement in zip(rows, solved, strict=True):
                for column, factor in self._others[row]:
                    if column not in columns:
                        left[column] = left[column] + factor * displacement
        return found

    @cached_property
    def _entries(self) -> list[dict[int, float]]:
        """By unknown force its factors in the equations: what a displacement does to the gap."""
        return [
            {row: float(np.asarray(factor).reshape(-1)[0]) for row, factor in entries.items()}
            for entries in self._system.entries
        ]

    @cached_property
    def _others(self) -> list[list[tuple[int, float]]]:
        """By displacement the gaps that it changes, with the factor."""
        found: list[list[tuple[int, float]]] = [[] for _ in range(self._system.size)]
        for column, entries in enumerate(self._entries):
            for row, factor in entries.items():
                if factor:
                    found[row].append((column, factor))
        return found

    @cached_property
    def _blocks(self) -> list[tuple[tuple[int, ...], tuple[int, ...], Reals]]:
        """Displacements that are found together, the gaps that give them, and the inverse of what joins them."""
        found = []
        for rows, columns in reversed(blocks(tuple(tuple(entries) for entries in self._entries))):
            matrix = np.array([[self._entries[column].get(row, 0.0) for row in rows] for column in columns])
            found.append((rows, columns, np.linalg.inv(matrix)))
        return found


class _Moved:
    """Where the links of a mechanism stand: displacements of their origins and turns, and errors of their elements."""

    def __init__(self, mechanism: Mechanism, errors: list[tuple[Shift, Any]]) -> None:
        self.nominal = mechanism
        self.count = max((np.size(error) for _, error in errors), default=1)
        self.place = {name: np.zeros(self.count, dtype=np.complex128) for name in (FRAME, *mechanism.links)}
        self.turn = {name: np.zeros(self.count) for name in (FRAME, *mechanism.links)}
        self.spun: dict[str, Any] = dict.fromkeys((FRAME, *mechanism.links), 0j)
        self._shifts: dict[tuple[str, str], list[tuple[Shift, Any]]] = {}
        for shift, error in errors:
            for joint in joints_of(mechanism, shift.link, shift.joints):
                self._shifts.setdefault((shift.link, joint.name), []).append((shift, error))

    def by(self, step: Reals) -> None:
        """Move the links on, three displacements each."""
        for k, name in enumerate(self.nominal.links):
            self.place[name] = self.place[name] + step[3 * k] + 1j * step[3 * k + 1]
            self.turn[name] = self.turn[name] + step[3 * k + 2]
            self.spun[name] = _spin(self.turn[name])

    def refuse(self, rows: Any) -> None:
        """Take out what does not come to rest."""
        for name in self.turn:
            self.turn[name] = np.where(rows, math.nan, self.turn[name])
            self.place[name] = np.where(rows, math.nan, self.place[name])

    def mechanism(self) -> Mechanism:
        """The links where they stand."""
        links = {
            name: Link(Point(link.origin.value + self.place[name]), Turn(link.turn.value + self.turn[name]))
            for name, link in self.nominal.links.items()
        }
        return Mechanism(links, (), self.nominal.drive)

    def of(self, link: str, joint: str, at: Points | complex) -> Any:
        """By how much the element that a joint has on a link at a place stands elsewhere [mm]."""
        body = self.nominal.link(link)
        arm, spun = at - origin_of(body), self.spun[link]
        found = self.place[link] + arm * spun
        for shift, error in self._shifts.get((link, joint), ()):
            if shift.turned:
                off = arm * _spin(complex(shift.way).real * error) * (1.0 + spun)
            else:
                off = shift.way * error * (unit_of(body) * (1.0 + spun) if shift.frame == "link" else 1.0)
            found = found + off
        return found

    def turned(self, link: str, joint: str) -> Any:
        """By how much the element has turned too far [rad]."""
        found: Any = self.turn[link]
        for shift, error in self._shifts.get((link, joint), ()):
            if shift.turned:
                found = found + complex(shift.way).real * error
        return found

    def gaps(self, joint: Connection) -> Iterator[Any]:
        """How far the second element misses the first one, by unknown of the joint and in its unit."""
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
        missed = missed * np.conj(1.0 + self.spun[cam])  # as the cam sees it
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
    """e^(i t) - 1, exact for small turns."""
    half = np.sin(0.5 * turn)
    return -2.0 * half * half + 1j * np.sin(turn)
