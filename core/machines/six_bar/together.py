"""What many six-bars with the same trains seek at once: places of all of them are the columns of one."""

from __future__ import annotations

from collections.abc import Callable, Hashable, Sequence
from contextlib import suppress
from functools import cached_property, partial
from types import SimpleNamespace
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import GearlinkError, NoSolution
from gearlink.core.base.many_designs import hand_on, in_groups, sought
from gearlink.core.base.results import keep
from gearlink.core.machines.six_bar.loop import BLOCK, Course, SixBar, joined_by
from gearlink.core.machines.six_bar.spec import PINS
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.extremes import extremes_over, minimum_over
from gearlink.core.numerics.roots import sign_changes
from gearlink.core.numerics.roots_sweep import bracketed_roots
from gearlink.core.numerics.together import kept_last
from gearlink.core.parts.linkages.standstills import Turning, crossings, standstills
from gearlink.core.studies.clearance import Reach

if TYPE_CHECKING:
    from gearlink.core.machines.six_bar.design import GearedSixBar

Rows = NDArray[np.intp]
_OF_RATES = ("speed_ratio", "acceleration_ratio", "dwell_crank_angles", "output_")
_OF_TRANSMISSION = ("transmission-angle", "min_transmission_angle")
_OF_GEARS = ("gear-collision", "shaft-clearance", "shaft-seat", "gear_gap")


def find_together(designs: Sequence[GearedSixBar], asked: frozenset[str]) -> None:
    """Let designs keep what is found for all of them.

    Parameters
        asked : names of the quantities and checks that will be asked for
    """
    for group in in_groups([design for design in designs if _runs(design)], _alike):
        sought(lambda some: _find(some, asked), group)


def _runs(design: GearedSixBar) -> bool:
    """Whether there is a motion; what is wrong with another it says itself."""
    with suppress(GearlinkError):
        return bool(design.course.walk.rows.size)
    return False


def _alike(design: GearedSixBar) -> Hashable:
    """What no column stands for."""
    return design.bar.relations, design.course.range, design.period_turns


def _find(designs: Sequence[GearedSixBar], asked: frozenset[str]) -> None:
    courses = _Courses([design.course for design in designs])
    if any(name.startswith(_OF_RATES) for name in asked):
        _find_turnings(designs, courses)
        _find_standstills(designs, courses)
    if any(name.startswith(_OF_TRANSMISSION) for name in asked):
        _find_transmission(designs, courses)
    pairs = [pair for pair, link in joined_by(designs[0].spec.trains) if link < 0]
    if pairs and not asked.isdisjoint(_OF_GEARS):
        _find_reaches(designs, courses, pairs)


class _Courses:
    """Motions of six-bars with the same trains, at places each of one of them."""

    def __init__(self, courses: Sequence[Course]) -> None:
        self.each, self.first, self.count = courses, courses[0], len(courses)
        self._bars = [course.bar for course in courses]
        walks = [course.walk.rows for course in courses]
        self._places = np.concatenate(walks)
        self._starts = np.cumsum([0, *(len(each) for each in walks)])[:-1]
        self._apart = 2.0 * (self.first.end - self.first.start) + 1.0
        numbers = np.arange(len(walks))
        # the places after the first of each, one motion behind the other
        self._behind = np.concatenate([walk[1:, 0] + k * self._apart for k, walk in zip(numbers, walks, strict=True)])
        self._lasts = np.array([len(each) - 1 for each in walks])

    @cached_property
    def _lengths(self) -> Reals:
        return np.array([bar.lengths for bar in self._bars]).T

    @cached_property
    def _directions(self) -> Reals:
        return np.array([bar.start_angles for bar in self._bars]).T

    def _tangents(self, q: Reals, of: Rows) -> Reals:
        """As of `Walk`."""
        k = (
            np.searchsorted(self._behind, q + of * self._apart, side="right")
            - (self._starts - np.arange(self.count))[of]
        )
        k = np.where(q < 0.0, np.minimum(k + 1, self._lasts[of]), k)
        at = self._places[self._starts[of] + k]
        return np.asarray(at[:, 1:3] + at[:, 3:] * (q - at[:, 0])[:, None])

    def at(self, of: Rows) -> Course:
        """The motion at as many places, each of the six-bar with its number."""
        made = self._within_period(of)
        if self.first.period_turns is not None:
            keep(made, gain=self._gains[:, of])
        return made

    def _within_period(self, of: Rows) -> Course:
        bar, lengths = object.__new__(SixBar), self._lengths[:, of]
        vars(bar).update(lengths=tuple(lengths), relations=self.first.bar.relations)
        keep(bar, numbers=(lengths[2:], self._directions[:, of], *self.first.bar.numbers[2:]))
        made = Course(bar, self.first.range)
        tangents = partial(self._tangents, of=of)
        keep(made, walk=SimpleNamespace(tangents=tangents, turns=self.first.period_turns))
        return made

    @cached_property
    def _gains(self) -> Reals:
        ends = np.tile([0.0, self.first.end], self.count)
        found = self._within_period(np.repeat(np.arange(self.count), 2)).within(ends)
        return np.asarray(found[:, 1::2] - found[:, ::2])

    def over(self, of: Rows, phi: Reals, what: Callable[[Course, Reals], Any]) -> Any:
        """What a motion gives as arrays along the places, block by block."""
        parts = [slice(start, start + BLOCK) for start in range(0, phi.size, BLOCK)]
        found = [np.asarray(what(self.at(of[part]), phi[part])) for part in parts]
        return found[0] if len(found) == 1 else np.concatenate(found, axis=-1)

    def by_rows(self, phi: Reals, what: Callable[[Course, Reals], Any]) -> Any:
        """The same at places for all, (K,), or at a row for each, (N, K): a row for each."""
        places = np.broadcast_to(phi, (self.count, phi.shape[-1]))
        found = self.over(np.repeat(np.arange(self.count), places.shape[1]), places.ravel(), what)
        return found.reshape(*found.shape[:-1], *places.shape)


def _rate(courses: _Courses, of: Rows, order: Rows) -> Callable[[Reals], Reals]:
    """Derivatives of the outputs at as many places, each of its own order."""

    def at(phi: Reals) -> Reals:
        rates = courses.over(of, phi, lambda course, phi: course.rates_at(phi, int(order.max())))
        return np.asarray(rates[order, 3, np.arange(phi.size)])

    return at


def _roots(rate: Callable[[Reals], Reals], low: Any, high: Any, ends: Any) -> list[float]:
    found = bracketed_roots(rate, *(np.array(each, dtype=float) for each in (low, high)), ends=ends)
    if np.isnan(found).any():
        raise NoSolution("one of the six-bars has no rates there")
    roots: list[float] = found.tolist()
    return roots


def _find_turnings(designs: Sequence[GearedSixBar], courses: _Courses) -> None:
    """Extremes of speeds and accelerations, as `turnings` finds them."""
    sizes = [course.grid.size for course in courses.each]
    phi = np.concatenate([course.grid for course in courses.each])
    rates = courses.over(np.repeat(np.arange(len(sizes)), sizes), phi, lambda course, phi: course.rates_at(phi, 3))
    own = np.split(rates, np.cumsum(sizes)[:-1], axis=-1)
    for course, found in zip(courses.each, own, strict=True):
        keep(course, on_grid=tuple(found))
    starts = np.cumsum([0, *sizes])[:-1].tolist()
    cuts = [(k, order, start + i) for k, (start, found) in enumerate(zip(starts, own, strict=True))
            for order in (1, 2) for i in sign_changes(found[order + 1, 3].tolist())]  # fmt: skip
    of, order, at = np.array(cuts, dtype=np.intp).reshape(-1, 3).T
    ends = rates[order + 1, 3, at], rates[order + 1, 3, at + 1]
    roots = _roots(_rate(courses, of, order + 1), phi[at], phi[at + 1], ends) if cuts else []
    places: dict[tuple[int, int], set[float]] = {(k, order): set() for k in range(len(designs)) for order in (1, 2)}
    for (k, rate, _), root in zip(cuts, roots, strict=True):
        places[k, rate].add(root)
    for (k, _), some in places.items():
        if not some or courses.first.period_turns is None:
            some |= {float(courses.each[k].grid[0]), float(courses.each[k].grid[-1])}
    seats = [(*key, place) for key, some in places.items() for place in sorted(some)]
    of, order = np.array([seat[:2] for seat in seats], dtype=np.intp).T
    values = _rate(courses, of, order)(np.array([seat[2] for seat in seats])).tolist()
    turnings: dict[tuple[int, int], list[Turning]] = {key: [] for key in places}
    for (k, rate, place), value in zip(seats, values, strict=True):
        turnings[k, rate].append(Turning(place, value))
    for k, design in enumerate(designs):
        keep(design, speed_turnings=turnings[k, 1], acceleration_turnings=turnings[k, 2])


def _find_standstills(designs: Sequence[GearedSixBar], courses: _Courses) -> None:
    """Input angles at which the outputs stand."""
    pairs = [(k, *pair) for k, design in enumerate(designs) for pair in crossings(*design.standing)]
    of = np.array([k for k, *_ in pairs], dtype=np.intp)
    low, high, *ends = ([getattr(pair[side], name) for pair in pairs] for name in ("place", "value") for side in (1, 2))
    rate = _rate(courses, of, np.ones_like(of))
    roots = _roots(rate, low, high, tuple(map(np.array, ends))) if pairs else []
    for k, design in enumerate(designs):
        own = [root for number, root in zip(of.tolist(), roots, strict=True) if number == k]
        keep(design, dwell_crank_angles=standstills(None, *design.standing, lambda *_, own=own: own))


def _find_transmission(designs: Sequence[GearedSixBar], courses: _Courses) -> None:
    first = courses.first

    def transmission(phi: Reals) -> Reals:
        found: Reals = courses.by_rows(phi, lambda course, phi: course.bar.transmission(course.angles(phi)))
        return found

    hand_on(designs, _transmission=minimum_over(transmission, first.start, first.end, samples=first.samples))


def _find_reaches(designs: Sequence[GearedSixBar], courses: _Courses, pairs: Sequence[str]) -> None:
    """Distances of pins that no link joins."""
    first = courses.first
    pins = kept_last(lambda phi: courses.by_rows(phi, _pins))

    def distance(one: str, other: str) -> Callable[[Reals], Reals]:
        return lambda phi: np.abs(pins(phi)[PINS.index(one)] - pins(phi)[PINS.index(other)])

    wanted = [(each, greatest) for each in (distance(*pair) for pair in pairs) for greatest in (False, True)]
    found = iter(extremes_over(wanted, first.start, first.end, samples=first.samples))
    ends = {pair: (next(found), next(found)) for pair in pairs}
    reaches = {pair: Reach(near.value, far.value, near.place, far.place) for pair, (near, far) in ends.items()}
    hand_on(designs, moving_reaches=reaches)


def _pins(course: Course, phi: Reals) -> Points:
    """The pins A to F [mm], as the links of the mechanism have them."""
    frame, crank, *couplers, output = course.bar.lengths
    ways = [np.exp(1j * phi), *np.exp(1j * course.angles(phi))]
    found = [np.zeros_like(phi, dtype=np.complex128)]
    for length, way in zip((crank, *couplers[:2]), ways, strict=False):
        found.append(found[-1] + length * way)
    end = np.broadcast_to(frame + 0j, phi.shape)
    return np.array([*found, end - output * ways[-1], end])
