"""The motion of a planar mechanism from its start on, at any input and of any order, without changing its assembly."""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.planar.dyads import Dyad, dyads
from gearlink.core.machines.planar.start import Start
from gearlink.core.machines.planar.structure import Structure
from gearlink.core.machines.planar.system import Jets, System, joined, split
from gearlink.core.mechanism.follow import JAM, MOST_TURNS, Place, Walk
from gearlink.core.numerics.arrays import Reals

_TURN = 2.0 * math.pi
_ROUNDS = 60
_FINE = 1e-10  # of a turn or of size, after a step so short another one would be some 1e-20
_SINGULAR = 1e-12
_HOME = 1e-7, 1e-6  # rad, and shares of size
_MOST = 4_000_000  # numbers of the matrices that are looked at together
_FAR = 100.0  # of size, as far as a slide is followed for the range that is free of dead centres
_FAR_TURNS = 4


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
        sizes = np.linalg.svd(self.system.matrix(jets)[0], compute_uv=False)
        if sizes[-1] < _SINGULAR * sizes[0]:
            return None
        jets = self.system.onward(jets, np.array([q]), 1)
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
    found, rows, finest = near.copy(), np.arange(q.size), np.full(q.size, math.inf)
    for _ in range(_ROUNDS):
        jets = Jets.of(found[rows])
        try:
            step = system.step(jets, q[rows])
        except np.linalg.LinAlgError:
            break
        size = np.abs(step).max(axis=1)
        if not np.isfinite(size).all():
            break
        taken = size < finest
        found[rows[taken]] += step[taken]
        going = taken & (size >= _FINE)
        if not going.any():
            return found
        rows, finest = rows[going], size[going]
    raise NoSolution("the mechanism does not close there")


@dataclass(frozen=True)
class _Refusals:
    course: Course

    def starts_dead(self) -> NoSolution:
        return NoSolution(
            "the mechanism starts in a dead centre, where its motion is not certain: change start", key="start"
        )

    def jams(self, q: float, back: float | None, *, ranged: bool) -> NoSolution:
        unit, shown = self.course.unit, self.course.shown
        here = shown(self.course.dead_centre(q))
        if back is None:
            free = f"{'above' if q < 0.0 else 'below'} {here:.6g} {unit}"
        else:
            low, high = sorted((here, shown(self.course.dead_centre(back))))
            free = f"between {low:.6g} and {high:.6g} {unit}"
        ways = "keep range: {start, end}" if ranged else "let the input swing"
        return NoSolution(
            f"the mechanism meets a dead centre at input {here:.6g} {unit}, where it jams: {ways} {free}"
            f"{'' if ranged else ' (range: {start, end})'}, or change the lengths",
            key="range",
        )

    def never_home(self) -> NoSolution:
        key = "drive.with" if self.course.structure.spec.drive.others else "meshes"
        return NoSolution(
            f"the mechanism does not come home within {MOST_TURNS} turns of the input: take ratios and teeth with "
            "common factors, or give range: {start, end}",
            key=key,
        )


@dataclass(frozen=True)
class Course:
    """The motion over a period, or over the range of the file.

    Parameters
        structure : Structure
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
        turned, moved = np.abs(apart - _TURN * np.round(apart / _TURN)).max(), np.abs(x[0] - x0).max()
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
        return _TURN * (self.turns or 1) if self.ends is None else self.ends[1]

    @cached_property
    def gains(self) -> Reals:
        """What the directions gain in a period [rad]; (bodies,), whole turns."""
        rows, count = self.walk.rows, self.system.unknowns
        _, t = split(rows[[0, -1], 1 : 1 + count])
        return np.asarray(_TURN * np.round((t[1] - t[0]) / _TURN))

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
        far = _FAR if self.by_slide else _TURN * _FAR_TURNS
        for way in (-1.0, 1.0):
            places = [self.walk.origin]
            end = way * max(far, *(2.0 * abs(each * self._scale) for each in self.ends or (0.0,)))
            jams = not self.walk.follow(places, end)
            ends.append(self.dead_centre(places[-1].q) / self._scale if jams else None)
        return None if ends == [None, None] else (ends[0], ends[1])

    # At inputs

    def jets(self, q: Reals, order: int) -> Jets:
        """Taylor coefficients at inputs, lengths in units of size, by the input of the walk."""
        parts = [self._jets(rows, order) for rows in self._parts(self.walked(q))]
        if len(parts) == 1:
            return parts[0]
        joined_up = [[np.concatenate(each) for each in zip(*(getattr(part, name) for part in parts), strict=True)]
                     for name in ("x", "t", "e")]  # fmt: skip
        return Jets(*joined_up)

    def walked(self, q: Reals) -> Reals:
        """Inputs as the equations have them, lengths in units of size."""
        return np.asarray(q * self._scale)

    def _parts(self, q: Reals) -> Iterator[Reals]:
        block = max(16, min(4096, _MOST // self.system.unknowns**2))
        yield from (q[start : start + block] for start in range(0, max(1, q.size), block))

    def _jets(self, q: Reals, order: int) -> Jets:
        gained, inside = np.zeros(q.size), q
        if self.ends is None:
            gained = np.floor(q / self.end)
            inside = q - gained * self.end
        y = settled(self.system, inside, self.walk.tangents(inside))
        x, t = split(y)
        jets = self.system.onward(Jets([x], [t]), inside, order)
        jets.t[0] = jets.t[0] + gained[:, None] * self.gains if self.ends is None else jets.t[0]
        return jets

    def floor(self, unit: str, order: int) -> float:
        """What a derivative of a motion over 1 rad, or over the size of the mechanism, is about [rad, mm]."""
        return (1.0 if unit == "rad" else self.structure.size) * self._scale**order

    def derivatives(self, of: Callable[[Jets, int], Reals], jets: Jets, order: int) -> list[Reals]:
        """Value and derivatives by the input [rad or mm] of a number, given its Taylor coefficients."""
        return [of(jets, k) * (math.factorial(k) * self._scale**k) for k in range(order + 1)]

    @cached_property
    def grid(self) -> Reals:
        """Inputs next to which functions of the motion are smooth: dense where dead centres are near."""
        places = self.walk.rows[:, 0] / self._scale
        inside = places[(places >= self.start) & (places <= self.end)]
        ends = np.array([self.start, self.end])
        return np.unique(np.concatenate([ends, np.linspace(self.start, self.end, self.samples + 1), inside]))

    @property
    def samples(self) -> int:
        """Points of an even grid on which the motion is smooth."""
        count = self.system.unknowns
        rates = self.walk.rows[:, 1 + count :]
        fastest = max(1.0, float(np.median(np.abs(rates[:, 2::3]).max(axis=1)))) if not self.by_slide else 1.0
        turns = (self.end - self.start) / _TURN if not self.by_slide else 1.0
        return max(72, math.ceil(360.0 * min(fastest, 20.0) * turns))

    @cached_property
    def dyads(self) -> list[Dyad]:
        """The dyads."""
        return dyads(self.structure, self.system)
