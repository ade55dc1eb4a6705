"""How a planar mechanism is put together at input 0: part by part from the rough directions of its file.

A dyad has two closings; the one nearer to the rough directions is taken, wherever Newton's steps went.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.dyads import Dyad, dyads, mirrored
from gearlink.core.machines.planar.structure import RackJoint, Structure
from gearlink.core.machines.planar.system import (
    Jets,
    Row,
    System,
    drive_rows,
    driven_row,
    joined,
    joint_rows,
    mesh_row,
    pins_of,
    scaled,
    split,
)
from gearlink.core.mechanism.blocks import Block
from gearlink.core.numerics.arrays import Points, Reals

_TURN = 2.0 * math.pi
_STEP = 0.3  # rad and shares of size, the longest step from the rough start
_ROUNDS = 200
_CLOSED = 1e-11
_TRIES = 24
_SHARE = 1e-6  # of a null vector: joints with less have no part in it
_DEAD = 1e-5


def wrapped(angle: float) -> float:
    """An angle in (-pi, pi]."""
    found = math.remainder(angle, _TURN)
    return math.pi if found == -math.pi else found


@dataclass(frozen=True)
class Start:
    """A mechanism at input 0.

    Parameters
        structure : Structure
    Raises
        NoSolution - where it has too many or too few freedoms, or does not close
    """

    structure: Structure

    def _exact(self, name: str) -> float:
        """A start value that counts as it stands [rad or size]; 0 where the file has none."""
        given = self.structure.start_of(name) or 0.0
        return given / self.structure.size if name in self.structure.slides else wrapped(given)

    @cached_property
    def system(self) -> System:
        """The equations with exact start values in place of meshes; unknowns as many as equations.

        Raises
            NoSolution - key links or drive
        """
        structure = self.structure
        freedoms, drives = structure.freedoms, len(structure.drives)
        if freedoms > drives:
            raise NoSolution(
                f"the mechanism has {freedoms} degrees of freedom and {_count(drives, 'drive')}: give "
                f"{_count(freedoms - drives, 'more drive')} (drive.with), or join its links by "
                f"{_count(freedoms - drives, 'more mesh', 'more meshes')} or slots",
                key="drive",
            )
        starts = {each.name: self._exact(each.name) for each in structure.drives}
        rows = joint_rows(structure, {}) + drive_rows(structure, starts) + self._mesh_rows()
        system = System(len(structure.bodies), pins_of(structure), tuple(rows))
        if freedoms < drives:
            raise self._held(system, freedoms, drives)
        self._require_matching(system)
        return system

    def _mesh_rows(self) -> list[Row]:
        structure, found = self.structure, []
        for name, mesh in structure.meshes.items():
            own = structure.tied.get(name)
            if own is None:
                if structure.freedoms < len(structure.drives):  # which says more
                    continue
                raise NoSolution(
                    f"the gears of {name} and their carrier are driven or tied by meshes before: leave the mesh or a "
                    "drive out",
                    key=f"meshes.{name}",
                )
            slide = structure.slides.get(own)
            body = mesh.line.other if isinstance(mesh, RackJoint) else mesh.first
            found.append(driven_row(structure.numbers.get(own, body), slide, structure.size, self._exact(own)))
        return found

    def _held(self, system: System, freedoms: int, drives: int) -> NoSolution:
        """That joints repeat each other, by the left null vectors of the matrix."""
        y = self.rough
        for _ in range(_ROUNDS):
            jets = Jets.of(y)
            step = np.linalg.lstsq(system.matrix(jets)[0], -system.values(jets, 0, np.zeros(1))[0], rcond=None)[0]
            y = y + _held_back(step)[None]
            if np.abs(step).max() < _CLOSED:
                break
        left, sizes, _ = np.linalg.svd(system.matrix(Jets.of(y))[0])
        rank = int(np.count_nonzero(sizes > _SHARE * max(1.0, sizes[0])))
        share = np.abs(left[:, rank:]).max(axis=1)
        joints = self.joints_of(system, np.flatnonzero(share > _SHARE).tolist())
        excess = drives - freedoms
        times = "once" if excess == 1 else f"{excess} times"
        return NoSolution(
            f"the joints {', '.join(joints)} hold the mechanism {times} more than it can take, "
            f"{_count(freedoms, 'degree of freedom', 'degrees of freedom')} for {_count(drives, 'drive')}: leave one "
            "link or one joint out",
            key="links",
        )

    def _require_matching(self, system: System) -> None:
        """Refuse what holds one part too often while another one is free, whatever its sizes."""
        weights = np.random.default_rng(2).uniform(0.5, 1.5, system.pattern.shape)
        left, sizes, right = np.linalg.svd(np.where(system.pattern, weights, 0.0))
        rank = int(np.count_nonzero(sizes > 1e-9 * sizes[0]))
        if rank == system.unknowns:
            return
        rows = np.flatnonzero(np.abs(left[:, rank:]).max(axis=1) > _SHARE).tolist()
        free = sorted(set((np.flatnonzero(np.abs(right[rank:]).max(axis=0) > _SHARE) // 3 + 1).tolist()))
        raise NoSolution(
            f"the joints {', '.join(self.joints_of(system, rows))} hold their links more than once, while "
            f"{' and '.join(self.structure.names[body] for body in free)} can still move: change how they are joined",
            key="links",
        )

    def joints_of(self, system: System, rows: Iterable[int]) -> list[str]:
        """Names of the joints that some equations are of, each once."""
        structure, pins = self.structure, 2 * len(system.pins)
        names = [pin.name for pin in structure.pins for _ in range(2)]
        names += [name for name in structure.slides for _ in range(2)]
        names += [*structure.slots, *(f"drive of {each.name}" for each in structure.drives), *structure.meshes]
        return list(dict.fromkeys(names[row] for row in rows if row < len(names) or row < pins))

    # Rough places

    @cached_property
    def rough(self) -> Reals:
        """Unknowns as the file gives them roughly, links placed along their pins; (1, unknowns)."""
        structure = self.structure
        t = np.zeros(len(structure.bodies))
        known = {0}
        for name, body in structure.numbers.items():
            if body and name not in structure.spec.slid:
                t[body] = wrapped(structure.start_of(name) or 0.0)
                known.add(body)
        waiting = list(structure.slides.values())
        while waiting:
            ready = [each for each in waiting if each.line.body in known]
            if not ready:
                names = [structure.names[each.line.other] for each in waiting]
                raise NoSolution(f"{' and '.join(names)} slide on each other in a circle", key="slides")
            for each in ready:
                t[each.line.other] = wrapped(t[each.line.body] + each.line.direction + (each.lean or 0.0))
                known.add(each.line.other)
                waiting.remove(each)
        return joined(self._placed(t)[None], t[None])

    def _placed(self, t: Reals) -> Points:
        """Origins [size] from directions, each by the first joint that leads to a body which is placed."""
        structure, size = self.structure, self.structure.size
        x = np.zeros(t.size, dtype=np.complex128)
        e = np.exp(1j * t)
        placed = {0}

        def place(body: int, point: complex, where: complex) -> None:
            x[body] = where - point * e[body]
            placed.add(body)

        def by_slide(name: str) -> bool:
            line = scaled(structure.slides[name].line, size)
            if (line.body in placed) == (line.other in placed):
                return False
            along = (structure.start_of(name) or 0.0) / size * cmath.exp(1j * line.direction)
            if line.body in placed:
                place(line.other, line.point, x[line.body] + (line.through + along) * e[line.body])
            else:
                place(line.body, line.through + along, x[line.other] + line.point * e[line.other])
            return True

        def by_pin() -> bool:
            for pin in structure.pins:
                ends = (pin.first, pin.at_first / size), (pin.second, pin.at_second / size)
                for (one, there), (other, here) in (ends, ends[::-1]):
                    if one in placed and other not in placed:
                        place(other, here, x[one] + there * e[one])
                        return True
            return False

        given = [name for name in structure.slides if name in structure.spec.start]
        rest = [name for name in structure.slides if name not in given]
        slots = [scaled(slot.line, size) for slot in structure.slots.values()]

        def by_slot() -> bool:
            for line in slots:
                if line.body in placed and line.other not in placed:
                    place(line.other, line.point, x[line.body] + line.through * e[line.body])
                    return True
                if line.other in placed and line.body not in placed:
                    place(line.body, line.through, x[line.other] + line.point * e[line.other])
                    return True
            return False

        while any(map(by_slide, given)) or by_pin() or any(map(by_slide, rest)) or by_slot():
            pass
        return x

    # Closing

    @cached_property
    def closed(self) -> tuple[Points, Reals]:
        """Origins [size] and directions in (-pi, pi] at input 0.

        Raises
            NoSolution - where the mechanism does not close, with key start
        """
        system, y = self.system, self.rough.copy()
        found = {dyad.block: dyad for dyad in dyads(self.structure, system)}
        for block in system.blocks:
            self._close(system, block, y)
            if block in found:
                self._choose(system, block, found[block], y)
        x, t = split(y)
        return x[0], np.array([wrapped(float(angle)) for angle in t[0]])

    def _close(self, system: System, block: Block, y: Reals) -> None:
        """Newton's steps on one part, from the rough start and, where they fail, from starts about it."""
        columns, rng = np.array(block.columns), np.random.default_rng(3)
        first = y[0, columns].copy()
        turns = columns % 3 == 2
        for attempt in range(_TRIES):
            if _newton(system, block, y):
                return
            spread = 0.15 * (attempt + 1)
            y[0, columns] = first + np.where(turns, spread, 0.3 * spread) * rng.uniform(-1.0, 1.0, columns.size)
        y[0, columns] = first
        gap = (
            float(np.abs(system.values(Jets.of(y), 0, np.zeros(1))[0, np.array(block.rows)]).max())
            * self.structure.size
        )
        links = [self.structure.names[body] for body in sorted({int(column) // 3 + 1 for column in columns})]
        joints = self.joints_of(system, block.rows)
        raise NoSolution(
            f"{_listed(links)} {'do' if len(links) > 1 else 'does'} not close at the start ({', '.join(joints)} open "
            f"by {gap:.4g} mm at the rough directions): change start, or the lengths",
            key="start",
        )

    def _choose(self, system: System, block: Block, dyad: Dyad, y: Reals) -> None:
        """Take the other closing of a dyad where it is nearer to the rough directions."""
        other = y.copy()
        x, t = split(other)
        mirrored(dyad, x[0], t[0])
        other[:] = joined(x, t)
        if not _newton(system, block, other):
            return
        away = [self._away(each, dyad.bodies) for each in (y, other)]
        if away[1] < away[0] - 1e-12:
            y[:] = other

    def _away(self, y: Reals, bodies: Sequence[int]) -> float:
        """Squares of what directions and places are off the rough ones."""
        total, structure = 0.0, self.structure
        t = split(y)[1][0]
        for body in bodies:
            name = structure.names[body]
            given = structure.start_of(name) if name not in structure.spec.slid else None
            if given is not None:
                total += math.remainder(float(t[body]) - given, _TURN) ** 2
        if total == 0.0:
            for name, slide in structure.slides.items():
                if slide.line.other in bodies and name in structure.spec.start:
                    place = Jets.of(y).seen(scaled(slide.line, structure.size), 0).real[0]
                    total += (float(place) - (structure.start_of(name) or 0.0) / structure.size) ** 2
        return total

    @cached_property
    def rough_errors(self) -> dict[str, float]:
        """By link with a rough start, what it is off [rad]."""
        structure, (_, t) = self.structure, self.closed
        exact = {each.name for each in structure.drives} | set(structure.tied.values())
        found = {}
        for name, body in structure.numbers.items():
            given = structure.start_of(name)
            if given is not None and name not in exact:
                found[name] = abs(math.remainder(float(t[body]) - given, _TURN))
        return found

    @cached_property
    def running(self) -> System:
        """The equations of the motion, with the constants of the start."""
        structure, (x, t) = self.structure, self.closed
        jets = Jets([x[None]], [t[None]])
        turns = {}
        for name, slide in structure.slides.items():
            apart = float(t[slide.line.other] - t[slide.line.body]) - slide.line.direction - (slide.lean or 0.0)
            turns[name] = _TURN * round(apart / _TURN)
        starts = {each.name: self._exact(each.name) for each in structure.drives}
        rows = [*joint_rows(structure, turns), *drive_rows(structure, starts)]
        for mesh in structure.meshes.values():
            row = mesh_row(mesh, structure.size)
            still = System(len(structure.bodies), (), (row,)).values(jets, 0, np.zeros(1))
            rows.append(row._replace(constant=float(still[0, 0])))
        system = System(len(structure.bodies), pins_of(structure), tuple(rows))
        self._require_matching(system)
        return system


def _held_back(step: Reals) -> Reals:
    longest = float(np.abs(step).max(initial=0.0))
    return step * min(1.0, _STEP / longest) if longest else step


def _newton(system: System, block: Block, y: Reals) -> bool:
    """Newton's steps on one part in place; whether they close it."""
    rows, columns, still = np.array(block.rows), np.array(block.columns), np.zeros(1)
    before = math.inf
    for _ in range(_ROUNDS):
        jets = Jets.of(y)
        gap = system.values(jets, 0, still)[0, rows]
        part = system.matrix(jets)[0][rows[:, None], columns]
        step = _held_back(np.linalg.lstsq(part, -gap, rcond=None)[0])
        size = float(np.abs(step).max())
        if not math.isfinite(size):
            return False
        y[0, columns] += step
        if size == 0.0 or 0.5 * before <= size < _CLOSED:
            break
        before = size
    gap = system.values(Jets.of(y), 0, still)[0, rows]
    return bool(np.abs(gap).max() < _CLOSED)


def _count(number: int, one: str, many: str = "") -> str:
    return f"{number} {one if abs(number) == 1 else many or one + 's'}"


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
