"""The motion of a geared six-bar followed from its start, without ever changing over to another of its closings."""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import NamedTuple

import numpy as np

from gearlink.core.errors import NoSolution, anew
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.six_bar.following import Follower, Place
from gearlink.core.six_bar.loop import SixBar

_TURN = 2.0 * math.pi
_MOST_TURNS = 100
_HOME = 1e-7  # rad, play of a return: directions repeat exactly or are apart by a share of a turn
_MOST_STEPS = 100_000


class _Walk(NamedTuple):
    """Places one after the other, the turns of the period, and why there are no more."""

    places: list[Place]
    turns: int | None
    error: NoSolution | None


@dataclass(frozen=True)
class Course:
    """The motion of a six-bar over a period, or over a range of the input.

    Parameters
        bar : SixBar
        range : (start, end) [rad] or None - a range that holds 0, or as many turns as bring the linkage home
    Raises
        NoSolution - where a dead centre is met: with the range of the input that is free of them
    Example
        >>> from gearlink.core.six_bar.relations import train_relation
        >>> rows = train_relation(0, (20, 20)), train_relation(4, (16, 24))
        >>> start = {2: math.radians(300.0), 5: math.radians(-60.0)}
        >>> course = Course(SixBar((190.0, 30.0, 30.0, 150.0, 60.0, 75.0), rows, start), None)
        >>> course.period_turns
        1

    Source
        own derivation; L. V. Kantorovich's theorem for the steps
    """

    bar: SixBar
    range: tuple[float, float] | None

    @property
    def start(self) -> float:
        """First input angle [rad]."""
        return 0.0 if self.range is None else self.range[0]

    @property
    def end(self) -> float:
        """Last input angle [rad]."""
        return _TURN * (self.period_turns or 1) if self.range is None else self.range[1]

    @property
    def period_turns(self) -> int | None:
        """Input turns until everything repeats; None over a range."""
        return self._followed[1]

    @property
    def followed(self) -> int:
        """How many places were followed so far."""
        return len(self._walk.places) if "_walk" in self.__dict__ else 0

    @cached_property
    def _followed(self) -> tuple[Reals, int | None]:
        """Certified places: rows of input angle, free directions, their rates; and the turns of the period."""
        if self._walk.error is not None:
            raise anew(self._walk.error)
        return np.array([place.row for place in self._walk.places]), self._walk.turns

    @cached_property
    def _walk(self) -> _Walk:
        """What was followed; kept also where it ends too early."""
        places: list[Place] = []
        try:
            return _Walk(places, self._walked(places), None)
        except NoSolution as error:
            return _Walk(places, None, anew(error))

    def _walked(self, places: list[Place]) -> int | None:
        """Follow the motion over its period or range; the turns of the period."""
        if self.range is not None:
            places += self._leg(min(self.range[0], 0.0))[:0:-1]
            places += self._leg(max(self.range[1], 0.0))
            return None
        places.append(self._origin)
        least = _home_turns(self.bar)
        for turns in range(least, _MOST_TURNS + 1, least):
            if not self._follow(places, _TURN * turns):
                raise NoSolution(self._jam(places[-1].phi), key="links")
            if self._is_home(places[-1], turns):
                return turns
        raise NoSolution(
            f"the six-bar does not come home within {_MOST_TURNS} turns of the input: take teeth with common factors, "
            "or give range: {start, end}",
            key="trains",
        )

    @cached_property
    def _follower(self) -> Follower:
        return Follower(self.bar)

    @cached_property
    def _origin(self) -> Place:
        place = self._follower.place(0.0, (0.0, 0.0))
        if place is None:
            raise NoSolution("the six-bar starts in a dead centre: change start", key="start")
        return place

    def _leg(self, end: float) -> list[Place]:
        places = [self._origin]
        if not self._follow(places, end):
            raise NoSolution(self._jam(places[-1].phi), key="range")
        return places

    def _follow(self, places: list[Place], end: float) -> bool:
        """Go on from the last place to an input angle; False where a dead centre is met before."""
        places.extend(islice(self._follower.onwards(places[-1], end), _MOST_STEPS - len(places)))
        return places[-1].phi == end

    def _is_home(self, place: Place, turns: int) -> bool:
        _, _, slopes, shares = self.bar.numbers
        moved = slopes * _TURN * turns + shares @ np.array(place.u)
        return bool(np.abs(np.remainder(moved + math.pi, _TURN) - math.pi).max() < _HOME)

    def _jam(self, phi: float) -> str:
        """What is wrong at a dead centre, with the range that is free of them."""
        back = [self._origin]
        if self._follow(back, -math.copysign(_TURN, phi)):
            free = f"{'above' if phi < 0.0 else 'below'} {math.degrees(phi):.6g} deg"
        else:
            low, high = sorted((math.degrees(phi), math.degrees(back[-1].phi)))
            free = f"between {low:.6g} and {high:.6g} deg"
        return (
            f"the six-bar meets a dead centre at input angle {math.degrees(phi):.6g} deg, where it jams: let the input "
            f"swing {free} (range: {{start, end}}), lengthen the couplers, or shorten input and output"
        )

    # Positions

    @cached_property
    def grid(self) -> Reals:
        """Input angles [rad] next to which functions of the motion are smooth: dense where dead centres are near."""
        places = self._followed[0][:, 0]
        inside = places[(places >= self.start) & (places <= self.end)]
        ends = np.array([self.start, self.end])
        return np.unique(np.concatenate([ends, np.linspace(self.start, self.end, self.samples + 1), inside]))

    @property
    def samples(self) -> int:
        """Points of an even grid on which the motion is smooth."""
        fastest = max(1.0, *(abs(float(p)) for p in self.bar.slopes))
        return math.ceil(360.0 * fastest * (self.end - self.start) / _TURN)

    def angles(self, phi: Reals) -> Reals:
        """Directions of links 2 to 5, continuous over the course and beyond its period; (4, N) array [rad]."""
        if self.range is not None:
            return self._angles(phi)
        periods = np.floor(phi / self.end)
        return self._angles(phi - periods * self.end) + periods * self._gain

    @cached_property
    def _gain(self) -> Reals:
        """What the directions gain in a period; (4, 1) array [rad]."""
        ends = self._angles(np.array([0.0, self.end]))
        return np.asarray(ends[:, 1:] - ends[:, :1])

    def _angles(self, phi: Reals) -> Reals:
        places = self._followed[0]
        k = np.searchsorted(places[1:, 0], phi, side="right")
        nearest = np.where(phi < 0.0, np.minimum(k + 1, len(places) - 1), k)  # certified outwards from 0
        at = places[nearest]
        return self.bar.closed(phi, (at[:, 1:3] + at[:, 3:] * (phi - at[:, 0])[:, None]).T)

    def rates(self, phi: Reals, order: int = 3) -> tuple[Reals, ...]:
        """Directions of links 2 to 5 and their first derivatives by the input angle, up to three; (4, N) arrays."""
        return self._on_grid if phi is self.grid and order == 3 else self._rates_at(phi, order)

    @cached_property
    def _on_grid(self) -> tuple[Reals, ...]:
        """On the grid all extremes are looked for among the same rates."""
        return self._rates_at(self.grid, 3)

    def _rates_at(self, phi: Reals, order: int) -> tuple[Reals, ...]:
        angles = self.angles(phi)
        return angles, *self.bar.rates(phi, angles, order)


def _home_turns(bar: SixBar) -> int:
    """Input turns after which the links that the input alone ties are home."""
    if not bar.is_closed_form:
        return 1
    return math.lcm(*(Fraction(p).denominator for p in bar.slopes))
