"""The motion of a planar mechanism from its start on, at any input and of any order, without changing its assembly."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.planar.dyads import Dyad, dyads, mirrored
from gearlink.core.machines.planar.structure import Line, LineJoint, RackJoint, Structure
from gearlink.core.machines.planar.system import (
    Jets,
    Row,
    System,
    at_rest,
    cam_row,
    drive_rows,
    driven_row,
    joined,
    joint_rows,
    meshes_at_rest,
    scaled,
    split,
)
from gearlink.core.mechanism.blocks import Block
from gearlink.core.mechanism.follow import JAM, MOST_TURNS, TURN, Place, Walk
from gearlink.core.numerics.arrays import Points, Reals, distinct, median
from gearlink.core.numerics.roots_sweep import newton_closed

if TYPE_CHECKING:
    from gearlink.core.machines.planar.cams import CamJoint, Lift

_SINGULAR = 1e-12
_HOME = 1e-7, 1e-6  # rad, and shares of size
_MOST = 4_000_000  # numbers of the matrices that are looked at together
_FAR = 100.0  # of size, as far as a slide is followed for the range that is free of dead centres
_FAR_TURNS = 4
_AT_JOINT = 1e-13  # rad, from where a law changes: rounding


@dataclass(frozen=True)
class _Follower:
    """Certified steps of a system."""

    system: System

    def closed(self, q: float, near: tuple[float, ...]) -> tuple[float, ...]:
        """Unknowns at an input from approximate ones."""
        found: tuple[float, ...] = tuple(settled(self.system, np.array([q]), np.array([near]))[0].tolist())
        return found

    def place(self, q: float, u: tuple[float, ...]) -> Place | None:
        """The place at an input; None in a dead centre."""
        jets = Jets.of(np.array([u]))
        matrix = self.system.matrix(jets)
        sizes = np.linalg.svd(matrix[0], compute_uv=False)
        if sizes[-1] < _SINGULAR * sizes[0]:
            return None
        jets = self.system.onward(jets, np.array([q]), 1, matrix)
        rates = joined(jets.x[1], jets.t[1])[0]
        k, k_rate, m, fastest = self.system.bounds(jets)
        slow = (math.sqrt(k * m) + k_rate) / float(sizes[-1])
        reach = 1.0 / max(slow, 2.0 * fastest) if slow or fastest else math.inf
        return Place(q, u, tuple(rates.tolist()), reach)


def settled(system: System, q: Reals, near: Reals) -> Reals:
    """Unknowns by Newton's steps until they are rounding; each row rests by itself.

    Raises
        NoSolution - where the steps do not close the mechanism
    """
    found = None
    with suppress(np.linalg.LinAlgError):
        found = newton_closed(lambda y, rows: system.step(Jets.of(y), q[rows]), near)
    if found is None:
        raise NoSolution("the mechanism does not close there")
    return found


@dataclass(frozen=True)
class _Refusals:
    course: Course

    def starts_dead(self) -> NoSolution:
        return NoSolution(
            "the mechanism starts in a dead centre, where its motion is not determined",
            key="start",
            fix=f"change {_starts(self.course.structure)}",
        )

    def jams(self, q: float, back: float | None, *, ranged: bool) -> NoSolution:
        unit, shown = self.course.unit, self.course.shown
        here = shown(self.course.dead_centre(q))
        if back is None:
            free = f"above {safely_above(here, 6)} {unit}" if q < 0.0 else f"below {safely_below(here, 6)} {unit}"
            fix = f"let the input oscillate {free} (range: {{start, end}})"
            if ranged:
                fix = f"set range.{'start' if q < 0.0 else 'end'} {free}"
        else:
            low, high = sorted((here, shown(self.course.dead_centre(back))))
            fix = f"set range.start to {safely_above(low, 6)} and range.end to {safely_below(high, 6)} {unit}"
        return NoSolution(f"the mechanism jams in a dead centre at input {short(here)} {unit}", key="range", fix=fix)

    def never_home(self) -> NoSolution:
        key = "drive.with" if self.course.structure.spec.drive.others else "meshes"
        return NoSolution(
            f"the mechanism does not return to its start position within {MOST_TURNS} turns of the input",
            key=key,
            fix="use ratios and teeth with common factors, or give range: {start, end}",
        )

    def too_fast(self, q: float, steps: int) -> NoSolution:
        return NoSolution(
            f"the motion changes too fast to be computed: {steps} steps lead to input {short(self.course.shown(q))} "
            f"{self.course.unit}",
            key="meshes" if self.course.structure.spec.meshes else "links",
            fix="check lengths, modules and teeth: some sizes are hundreds of times larger than others",
        )


@dataclass(frozen=True)
class Course:
    """The motion over a period, or over the range of the file.

    Notes
        Inputs are in rad, those of a slide in mm.
    Raises
        NoSolution - where the mechanism does not close, jams, or does not repeat; with its key
    """

    structure: Structure

    @property
    def by_slide(self) -> bool:
        """Whether a slide drives."""
        return self.structure.drives[0].slide is not None

    @property
    def unit(self) -> str:
        """Of the input as files have it."""
        return "mm" if self.by_slide else "deg"

    def shown(self, q: float) -> float:
        """An input of the walk in that unit."""
        return q * self.structure.size if self.by_slide else math.degrees(q)

    @property
    def _scale(self) -> float:
        """Inputs of the walk per input."""
        return 1.0 / self.structure.size if self.by_slide else 1.0

    @cached_property
    def ends(self) -> tuple[float, float] | None:
        """The range of the file [rad or mm]."""
        given = self.structure.spec.range
        if given is None:
            return None
        return (given.start, given.end) if self.by_slide else (math.radians(given.start), math.radians(given.end))

    @cached_property
    def at_start(self) -> Start:
        """The mechanism at input 0."""
        return Start(self.structure)

    @cached_property
    def system(self) -> System:
        """Its equations."""
        return self.at_start.running

    @cached_property
    def walk(self) -> Walk:
        """The certified places; inputs in rad or shares of size."""
        x, t = self.at_start.closed
        ends = self.ends and (self.ends[0] * self._scale, self.ends[1] * self._scale)
        start = tuple(joined(x[None], t[None])[0].tolist())
        ratios = [Fraction(each.ratio).limit_denominator(10**6) for each in self.structure.drives if each.slide is None]
        least = math.lcm(*(ratio.denominator for ratio in ratios)) if ratios else 1
        made = Walk(_Follower(replace(self.system, whole=True)), start, ends, least, self._is_home, _Refusals(self))
        if made.origin.reach < JAM:
            raise _Refusals(self).starts_dead()
        return made

    def _is_home(self, place: Place, _turns: int) -> bool:
        x, t = split(np.array([place.u]))
        x0, t0 = self.at_start.closed
        apart = t[0] - t0
        turned, moved = np.abs(apart - TURN * np.round(apart / TURN)).max(), np.abs(x[0] - x0).max()
        return bool(turned < _HOME[0] and moved < _HOME[1])

    @property
    def turns(self) -> int | None:
        """Input turns until everything repeats; None over a range."""
        return self.walk.turns

    @property
    def start(self) -> float:
        """First input."""
        return 0.0 if self.ends is None else self.ends[0]

    @property
    def end(self) -> float:
        """Last input."""
        return TURN * (self.turns or 1) if self.ends is None else self.ends[1]

    @cached_property
    def gains(self) -> Reals:
        """What the directions gain in a period [rad]; (bodies,), whole revolutions."""
        rows, count = self.walk.rows, self.system.unknowns
        _, t = split(rows[[0, -1], 1 : 1 + count])
        return np.asarray(TURN * np.round((t[1] - t[0]) / TURN))

    def dead_centre(self, q: float) -> float:
        """A dead centre next to the last certified input: rates grow as 1/sqrt of the way to it.

        d = |y'|/(2 |y''|)
        """
        follower = self.walk.follower
        places = [self.walk.origin]
        self.walk.follow(places, q)
        last = places[-1]
        jets = Jets.of(np.array([last.u]))
        assert follower.place(last.q, last.u) is not None
        jets = self.system.onward(jets, np.array([last.q]), 2)
        first, second = (float(np.abs(joined(jets.x[k], jets.t[k])).max()) for k in (1, 2))
        return last.q + math.copysign(first / (4.0 * second) if second else 0.0, q)

    @cached_property
    def free_range(self) -> tuple[float | None, float | None] | None:
        """Inputs between which there is no dead centre; None for an end that was not met, or for both."""
        ends: list[float | None] = []
        far = _FAR if self.by_slide else TURN * _FAR_TURNS
        for way in (-1.0, 1.0):
            places = [self.walk.origin]
            end = way * max(far, *(2.0 * abs(each * self._scale) for each in self.ends or (0.0,)))
            jams = False
            with suppress(NoSolution):
                jams = not self.walk.follow(places, end)
            ends.append(self.dead_centre(places[-1].q) / self._scale if jams else None)
        return None if ends == [None, None] else (ends[0], ends[1])

    # At inputs

    def jets(self, q: Reals, order: int, side: int = 1) -> Jets:
        """Taylor coefficients at inputs, lengths in units of size, by the input of the walk.

        Parameters
            order : int - with cams up to 3
            side : +1 or -1 - of inputs at which the law of a cam changes
        """
        parts = [self._jets(rows, order, side) for rows in self._parts(self.walked(q))]
        if len(parts) == 1:
            return parts[0]
        x, t, e = ([np.concatenate(each) for each in zip(*(getattr(part, name) for part in parts), strict=True)]
                   for name in ("x", "t", "e"))  # fmt: skip
        return Jets(x, t, e, side)

    def walked(self, q: Reals) -> Reals:
        """Inputs as the equations have them, lengths in units of size."""
        return np.asarray(q * self._scale)

    def unwalked(self, q: Reals) -> Reals:
        """Inputs of the equations in rad or mm."""
        return np.asarray(q / self._scale)

    def _parts(self, q: Reals) -> Iterator[Reals]:
        block = max(16, min(4096, _MOST // self.system.unknowns**2))
        yield from (q[start : start + block] for start in range(0, max(1, q.size), block))

    def _jets(self, q: Reals, order: int, side: int) -> Jets:
        gained, inside = np.zeros(q.size), q
        if self.ends is None:
            gained = np.floor(q / self.end)
            inside = q - gained * self.end
        y = settled(self.system, inside, self.walk.tangents(inside))
        x, t = split(y)
        jets = self.system.onward(Jets([x], [t], side=side), inside, order)
        jets.t[0] = jets.t[0] + gained[:, None] * self.gains if self.ends is None else jets.t[0]
        return jets

    def floor(self, unit: str, order: int) -> float:
        """What a derivative of a motion over 1 rad, or over the size of the mechanism, is about [rad, mm]."""
        return (1.0 if unit == "rad" else self.structure.size) * self._scale**order

    def derivatives(self, of: Callable[[Jets, int], Reals], jets: Jets, order: int) -> list[Reals]:
        """Value and derivatives by the input [rad or mm] of a number, given its Taylor coefficients."""
        return [of(jets, k) * (math.factorial(k) * self._scale**k) for k in range(order + 1)]

    @cached_property
    def joints(self) -> tuple[float, ...]:
        """Inputs between start and end at which the law of a cam changes [rad or mm]."""
        found: list[float] = []
        if self.structure.spec.cams:
            q = self._even
            jets = self.jets(q, 0)
            for name, cam in self.structure.cams.items():
                angles = self.at_start.lifts[name].angle(jets, 0)
                found += _crossings(partial(self._cam_angle, name), q, angles, self.at_start.joints_of_cam(cam))
        return tuple(sorted({each for each in found if self.start < each < self.end}))

    def _cam_angle(self, name: str, q: Reals) -> Reals:
        """Angles of a cam at inputs [rad]."""
        return self.at_start.lifts[name].angle(self.jets(q, 0), 0)

    @cached_property
    def grid(self) -> Reals:
        """Inputs next to which functions of the motion are smooth: dense where dead centres are near."""
        return distinct(np.concatenate([self._even, self.joints]))

    @cached_property
    def _even(self) -> Reals:
        places = self.walk.rows[:, 0] / self._scale
        inside = places[(places >= self.start) & (places <= self.end)]
        ends = np.array([self.start, self.end])
        return distinct(np.concatenate([ends, np.linspace(self.start, self.end, self.samples + 1), inside]))

    @property
    def samples(self) -> int:
        """Points of an even grid on which the motion is smooth."""
        count = self.system.unknowns
        rates = self.walk.rows[:, 1 + count :]
        fastest = max(1.0, median(np.abs(rates[:, 2::3]).max(axis=1))) if not self.by_slide else 1.0
        turns = (self.end - self.start) / TURN if not self.by_slide else 1.0
        return max(72, math.ceil(360.0 * min(fastest, 20.0) * turns))

    @cached_property
    def dyads(self) -> list[Dyad]:
        """The dyads."""
        return dyads(self.structure, self.system)


def _crossings(angle: Callable[[Reals], Reals], q: Reals, phi: Reals, joints: Sequence[float]) -> list[float]:
    """Inputs at which a cam angle passes joints of its law, of any turn; `phi` are its values at inputs."""
    from gearlink.core.numerics.roots import bracketed_root

    found: list[float] = []
    low, high = float(phi.min()), float(phi.max())
    for joint in joints:
        for turn in range(math.ceil((low - joint) / TURN - 1e-9), math.floor((high - joint) / TURN + 1e-9) + 1):
            off = phi - (joint + TURN * turn)
            off = np.where(np.abs(off) <= _AT_JOINT, 0.0, off)
            found += q[off == 0.0].tolist()
            for i in np.flatnonzero(off[:-1] * off[1:] < 0.0):
                beside = float(q[i]), float(q[i + 1])
                found.append(
                    bracketed_root(lambda each: float(angle(np.array([each]))[0]) - (joint + TURN * turn), *beside)  # noqa: B023
                )
    return found


_STEP = 0.3  # rad and shares of size, the longest step from the rough start
_START_ROUNDS = 200
_CLOSED = 1e-11
_TRIES = 24
_SHARE = 1e-6  # of a null vector: joints with less have no part in it
_Meeting: TypeAlias = tuple[tuple[int, complex], tuple[int, complex]]
"""Points of two bodies, by number and place on it, that are one."""


def wrapped(angle: float) -> float:
    """An angle in (-pi, pi]."""
    found = math.remainder(angle, TURN)
    return math.pi if found == -math.pi else found


@dataclass(frozen=True)
class Start:
    """A mechanism at input 0.

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
        """The equations with exact start values instead of meshes; unknowns as many as equations.

        Raises
            NoSolution - key links or drive
        """
        structure = self.structure
        freedoms, drives = structure.freedoms, len(structure.drives)
        if freedoms > drives:
            raise NoSolution(
                f"the mechanism has {freedoms} degrees of freedom and {_count(drives, 'drive')}",
                key="drive",
                fix=_joined(structure)
                or f"join its links by {_count(freedoms - drives, 'more mesh', 'more meshes')} "
                "or slots, or give more drives (drive.with)",
            )
        rows = joint_rows(structure, {}) + drive_rows(structure, self.exact_starts)
        rows += self.mesh_rows() + self._cam_rows()
        system = System.of(structure, rows)
        if freedoms < drives:
            raise self._held(system, freedoms, drives)
        self._require_matching(system)
        return system

    def mesh_rows(self) -> list[Row]:
        """Start values that count, in place of the meshes."""
        structure, found = self.structure, []
        for name, mesh in structure.meshes.items():
            own = structure.tied.get(name)
            if own is None:
                if structure.freedoms < len(structure.drives):  # which says more
                    continue
                raise NoSolution(
                    f"the gears of {name} and their carrier are driven or tied by meshes before",
                    key=f"meshes.{name}",
                    fix="omit the mesh or a drive",
                )
            slide = structure.slides.get(own)
            body = mesh.line.other if isinstance(mesh, RackJoint) else mesh.first
            found.append(driven_row(structure.numbers.get(own, body), slide, structure.size, self._exact(own)))
        return found

    def _cam_rows(self) -> list[Row]:
        structure, found = self.structure, []
        for name, cam in structure.cams.items():
            if name not in structure.tied:
                raise NoSolution(
                    f"the follower of {name} is moved by a cam before", key=f"cams.{name}", fix="omit one of the two"
                )
            at = self._cam_start(name)
            if cam.slide is not None:
                found.append(driven_row(cam.follower, cam.slide, structure.size, at))
            else:
                found.append(cam_row(cam, structure.size, cam.phase, self._exact(structure.tied[name]))._replace(
                    constant=at, lift=None))  # fmt: skip
        return found

    def _cam_start(self, name: str) -> float:
        """Direction of a follower against its carrier, or place of its slide, at input 0 [rad or size]."""
        cam = self.structure.cams[name]
        lift = cam.lift(self.structure.size, cam.phase)
        zero = cam.zero / self.structure.size if cam.slide is not None else cam.zero
        found = zero + lift.share * float(lift.motion.evaluate(np.array([cam.phase]), 0)[0][0])
        return found if cam.slide is not None else wrapped(found)

    def joints_of_cam(self, cam: CamJoint) -> tuple[float, ...]:
        """Joints of the law of a cam as its term counts them [rad]."""
        return cam.motion.joints

    @cached_property
    def lifts(self) -> dict[str, Lift]:
        """By cam the term of its equation, its angle counted from the start position."""
        t, found = self.closed[1], {}
        for name, cam in self.structure.cams.items():
            lift = cam.lift(self.structure.size, cam.phase)
            before = sum(share * float(t[body]) for body, share in lift.turns.items())
            found[name] = lift._replace(phase=cam.phase - before)
        return found

    def _held(self, system: System, freedoms: int, drives: int) -> NoSolution:
        """That joints repeat each other, by the left null vectors of the matrix."""
        y = self.rough
        for _ in range(_START_ROUNDS):
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
            f"the joints {', '.join(joints)} constrain the mechanism {times} more than it can take, "
            f"{_count(freedoms, 'degree of freedom', 'degrees of freedom')} for {_count(drives, 'drive')}",
            key="links",
            fix="omit one link or one joint",
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
            f"the joints {', '.join(self.joints_of(system, rows))} constrain their links more than once, while "
            f"{' and '.join(self.structure.names[body] for body in free)} can still move",
            key="links",
            fix="change the joints between them",
        )

    def joints_of(self, system: System, rows: Iterable[int]) -> list[str]:
        """Names of the joints that some equations are of, each once."""
        structure, pins = self.structure, 2 * len(system.pins)
        names = [pin.name for pin in structure.pins for _ in range(2)]
        names += [name for name in structure.slides for _ in range(2)]
        names += [*structure.slots, *(f"drive of {each.name}" for each in structure.drives), *structure.meshes,
                  *structure.cams]  # fmt: skip
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
                raise NoSolution(f"{' and '.join(names)} slide on each other in a closed chain", key="slides")
            for each in ready:
                t[each.line.other] = wrapped(t[each.line.body] + each.line.direction + (each.lean or 0.0))
                known.add(each.line.other)
                waiting.remove(each)
        for name, cam in structure.cams.items():
            if cam.slide is None:
                t[cam.follower] = wrapped(t[cam.carrier] + self._cam_start(name))
        return joined(self._placed(t)[None], t[None])

    def _placed(self, t: Reals) -> Points:
        """Origins [size] from directions, each by the first joint that leads to a body which is placed."""
        structure, size = self.structure, self.structure.size
        x, e, placed = np.zeros(t.size, dtype=np.complex128), np.exp(1j * t), {0}

        def placed_by(joints: Iterable[_Meeting]) -> bool:
            """Place a body at the first of these joints whose other body is placed."""
            for ends in joints:
                for (one, there), (other, here) in (ends, ends[::-1]):
                    if one in placed and other not in placed:
                        x[other] = x[one] + there * e[one] - here * e[other]
                        placed.add(other)
                        return True
            return False

        def on_line(joint: LineJoint, along: float = 0.0) -> _Meeting:
            line = scaled(joint.line, size)
            there = line.through + along / size * cmath.exp(1j * line.direction)
            return (line.body, there), (line.other, line.point)

        slides = {name: on_line(slide, structure.start_of(name) or 0.0) for name, slide in structure.slides.items()}
        pins = [((pin.first, pin.at_first / size), (pin.second, pin.at_second / size)) for pin in structure.pins]
        given = [ends for name, ends in slides.items() if name in structure.spec.start]
        rest = [ends for name, ends in slides.items() if name not in structure.spec.start]
        while any(map(placed_by, (given, pins, rest, map(on_line, structure.slots.values())))):
            pass
        return x

    # Closing

    @property
    def closed(self) -> tuple[Points, Reals]:
        """Origins [size] and directions in (-pi, pi] at input 0.

        Raises
            NoSolution - where the mechanism does not close, with key start
        """
        if isinstance(self._closed, NoSolution):
            raise self._closed
        return self._closed

    @cached_property
    def _closed(self) -> tuple[Points, Reals] | NoSolution:
        """The closed start, or the refusal, which has taken thousands of steps and is kept."""
        try:
            return self._close_all()
        except NoSolution as refusal:
            return refusal

    def _close_all(self) -> tuple[Points, Reals]:
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
            f"{_listed(links)} {'do' if len(links) > 1 else 'does'} not close at the start ({', '.join(joints)} "
            f"open by {gap:.4g} mm at the rough directions)",
            key="start",
            fix=f"change {_starts(self.structure)}, or the lengths of {_listed(links)}",
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
                total += math.remainder(float(t[body]) - given, TURN) ** 2
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
                found[name] = abs(math.remainder(float(t[body]) - given, TURN))
        return found

    @cached_property
    def slide_turns(self) -> dict[str, float]:
        """Whole revolutions that the directions of links on slides are off the slides' own [rad]."""
        t, turns = self.closed[1], {}
        for name, slide in self.structure.slides.items():
            apart = float(t[slide.line.other] - t[slide.line.body]) - slide.line.direction - (slide.lean or 0.0)
            turns[name] = TURN * round(apart / TURN)
        return turns

    @property
    def exact_starts(self) -> dict[str, float]:
        """Starts of the drives [rad or size]."""
        return {each.name: self._exact(each.name) for each in self.structure.drives}

    @cached_property
    def running(self) -> System:
        """The equations of the motion, with the constants of the start."""
        structure, (x, t) = self.structure, self.closed
        jets = Jets([x[None]], [t[None]])
        rows = [*joint_rows(structure, self.slide_turns), *drive_rows(structure, self.exact_starts)]
        rows += meshes_at_rest(structure, jets)
        for name, cam in structure.cams.items():
            row = cam_row(cam, structure.size, 0.0)._replace(lift=self.lifts[name])
            rows.append(at_rest(row, len(structure.bodies), jets))
        system = System.of(structure, rows)
        self._require_matching(system)
        return system


def contact_row(cam: CamJoint, structure: Structure, nominal: Lift, errors: Mapping[str, Any]) -> Row:
    """The row of a cam as cut, that of the nominal design, under the follower of another structure.

    Parameters
        nominal : Lift - its angle counted from the start of the nominal design
        errors : of profile, roller_radius [mm], phase and face [rad]
    """
    from gearlink.core.machines.planar.cams import Contact, Lift

    size = structure.size
    phase = cam.sense * (nominal.phase + errors.get("phase", 0.0))
    point = structure.bodies[cam.given.follower][cam.given.point] / size
    more = (errors.get("profile", 0.0) + errors.get("roller_radius", 0.0)) / size
    if cam.given.face is None:
        line = Line(cam.cam, cam.bore / size, phase, cam.follower, point)
        return Row(None, constant=more, contact=Contact(cam, nominal, line, size))
    way = cmath.phase(cam.face_normal / cam.ahead) + errors.get("face", 0.0)
    turns = {body: share for body, share in ((cam.follower, 1.0), (cam.cam, -1.0)) if body}
    lift = Lift(cam.support, 1.0 / size, turns, way - phase, cam.round)  # type: ignore[arg-type]
    return Row(Line(cam.follower, point, way, cam.cam, cam.bore / size), factor=-1.0, constant=more, lift=lift)


@dataclass(frozen=True)
class AsMade(Start):
    """A mechanism as manufactured at input 0, whose cams are those of the nominal design.

    Parameters
        structure : Structure - with cams those of the nominal one
        errors : by cam - of what `contact_row` takes
    """

    nominal: Start
    errors: Mapping[str, Mapping[str, Any]]

    @cached_property
    def closed(self) -> tuple[Points, Reals]:
        """Origins [size] and directions at input 0, next to the nominal ones."""
        x, t = self.nominal.closed
        near = joined(x[None] * (self.nominal.structure.size / self.structure.size), t[None])
        try:
            x, t = split(settled(self.running, np.zeros(1), near))
        except NoSolution as error:
            raise NoSolution("as manufactured it does not close at the start", key="start") from error
        return x[0], t[0]

    @cached_property
    def running(self) -> System:
        """The equations of the motion; gears stand as in the nominal design."""
        structure, nominal = self.structure, self.nominal
        rows = [*joint_rows(structure, nominal.slide_turns), *drive_rows(structure, self.exact_starts)]
        every, (x, t) = (structure.count, 1), nominal.closed
        jets = Jets([np.tile(x * (nominal.structure.size / structure.size), every)], [np.tile(t, every)])
        rows += meshes_at_rest(structure, jets)
        for name, cam in nominal.structure.cams.items():
            rows.append(contact_row(cam, structure, nominal.lifts[name], self.errors.get(name, {})))
        return System.of(structure, rows)

    @cached_property
    def lifts(self) -> dict[str, Any]:
        """By cam what tells its angle."""
        rows = dict(
            zip(self.nominal.structure.cams, self.running.rows[-len(self.nominal.structure.cams) :], strict=True)
        )
        return {name: row.contact or row.lift for name, row in rows.items()}

    def joints_of_cam(self, cam: CamJoint) -> tuple[float, ...]:
        """Joints of the law, of a flat face as directions of the face [rad]."""
        if cam.given.face is None:
            return cam.motion.joints
        phi = np.array([*cam.motion.joints])
        return tuple(np.mod(cam.support.faces(phi, 0, 1)[0][0], TURN).tolist())


def _held_back(step: Reals) -> Reals:
    longest = float(np.abs(step).max(initial=0.0))
    return step * min(1.0, _STEP / longest) if longest else step


def _newton(system: System, block: Block, y: Reals) -> bool:
    """Newton's steps on one part in place; whether they close it."""
    rows, columns, still = np.array(block.rows), np.array(block.columns), np.zeros(1)
    before = math.inf
    for _ in range(_START_ROUNDS):
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


def _joined(structure: Structure) -> str:
    """The advice of a link that one pin alone holds; none where all have more than one joint."""
    spec = structure.spec
    others = [*spec.slid, *(slot.on for slot in spec.slots.values()), *(slide.on for slide in spec.slides.values())]
    others += [name for mesh in spec.meshes.values() for name in (*(mesh.gears or ()), mesh.rack, mesh.pinion) if name]
    others += [name for cam in spec.cams.values() for name in (cam.cam, cam.follower)]
    slots = {slot.point for slot in spec.slots.values()}
    for name in spec.links:
        held = [pin for pin in structure.pins if structure.numbers[name] in (pin.first, pin.second)]
        if len(held) == 1 and name not in others and slots.isdisjoint(spec.bodies[name]):
            return f"give {name} a second point that the frame or another link has, or a slide"
    return ""


def _starts(structure: Structure) -> str:
    """The keys of the start that count as they stand, of drives and what a mesh ties to them; the others are rough."""
    exact = dict.fromkeys([*(drive.name for drive in structure.drives), *structure.tied.values()])
    return _listed([f"start.{name}" for name in exact])


def _listed(names: Sequence[str]) -> str:
    return names[0] if len(names) == 1 else f"{', '.join(names[:-1])} and {names[-1]}"
