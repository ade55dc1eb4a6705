"""A motion followed from its start in proven steps, so that it never changes to another assembly.

Kantorovich's theorem gives the step length with which Newton's steps from the tangent stay on the same branch:
1/(beta (sqrt(K M) + K')), beta = 1/sigma_min of the matrix of the equations. At a dead centre this length is 0.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from functools import cached_property
from itertools import islice
from typing import NamedTuple, Protocol

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution, anew
from gearlink.core.numerics.arrays import Reals

JAM = 1e-9  # of the input's unit, a certified step so short is a dead centre, known to about as much
TURN = 2.0 * math.pi
MOST_TURNS = 100
_MOST_STEPS = 5_000
"""A revolution; mechanisms whose sizes are of one order take some hundred."""


@dataclass(frozen=True, slots=True)
class Place:
    """A place of a motion.

    Parameters
        q : float - input [rad, or the unit of length]
        u : floats - unknowns
        rates : floats - their derivatives by the input
        reach : float - how far the tangent certainly leads to the next place
    """

    q: float
    u: tuple[float, ...]
    rates: tuple[float, ...]
    reach: float

    @property
    def row(self) -> tuple[float, ...]:
        """Input, unknowns and their rates."""
        return (self.q, *self.u, *self.rates)


class Follower(Protocol):
    """The equations whose solution is followed."""

    def closed(self, q: float, near: tuple[float, ...]) -> tuple[float, ...]:
        """The unknowns at an input, from approximate ones.

        Raises
            NoSolution - where the mechanism does not close
        """

    def place(self, q: float, u: tuple[float, ...]) -> Place | None:
        """The place at an input; None in a dead centre."""


def onwards(follower: Follower, place: Place, end: float) -> Iterator[Place]:
    """The places after one, up to an input; fewer if there is a dead centre before it."""
    way = math.copysign(1.0, end - place.q)
    while place.q != end and place.reach >= JAM:
        q = end if place.reach >= abs(end - place.q) else place.q + way * place.reach
        on = q - place.q
        near = tuple(value + rate * on for value, rate in zip(place.u, place.rates, strict=True))
        found = follower.place(q, follower.closed(q, near))
        if found is None:
            return
        place = found
        yield place


class Refusals(Protocol):
    """In words, why a motion cannot be followed."""

    def starts_dead(self) -> NoSolution:
        """The motion starts in a dead centre."""

    def jams(self, q: float, back: float | None, *, ranged: bool) -> NoSolution:
        """The motion reaches a dead centre at q; in the opposite direction one at `back`, or none."""

    def never_home(self) -> NoSolution:
        """The motion does not repeat within `MOST_TURNS` revolutions."""

    def too_fast(self, q: float, steps: int) -> NoSolution:
        """The maximum number of proven steps leads only to q."""


class _Ways(NamedTuple):
    places: list[Place]
    turns: int | None
    error: NoSolution | None


@dataclass(frozen=True)
class Walk:
    """A motion over its period, or over a range of its input.

    Parameters
        start : floats - unknowns at input 0
        range : (start, end) or None - a range, or as many revolutions as bring the mechanism home
        least : int - turns of the input after which it may be home
        is_home : function of a place and of the turns that lead there
    """

    follower: Follower
    start: tuple[float, ...]
    range: tuple[float, float] | None
    least: int
    is_home: Callable[[Place, int], bool]
    refusals: Refusals

    @property
    def turns(self) -> int | None:
        """Input revolutions until the motion repeats; None over a range.

        Raises
            NoSolution - where a dead centre is met, or the motion does not repeat
        """
        return self._sure.turns

    @cached_property
    def rows(self) -> Reals:
        """Certified places: rows of input, unknowns, their rates."""
        return np.array([place.row for place in self._sure.places])

    @property
    def followed(self) -> int:
        """How many places were followed so far."""
        return len(self._ways.places) if "_ways" in self.__dict__ else 0

    @property
    def _sure(self) -> _Ways:
        if self._ways.error is not None:
            raise anew(self._ways.error)
        return self._ways

    @cached_property
    def _ways(self) -> _Ways:
        """What was followed; kept also where it ends too early."""
        places: list[Place] = []
        try:
            return _Ways(places, self._walked(places), None)
        except NoSolution as error:
            return _Ways(places, None, anew(error))

    def _walked(self, places: list[Place]) -> int | None:
        """Follow the motion over its period or range; the turns of the period."""
        if self.range is not None:
            places += self._leg(min(self.range[0], 0.0))[:0:-1]
            places += self._leg(max(self.range[1], 0.0))
            return None
        places.append(self.origin)
        for turns in range(self.least, MOST_TURNS + 1, self.least):
            if not self.follow(places, TURN * turns):
                raise self._jam(places[-1].q)
            if self.is_home(places[-1], turns):
                return turns
        raise self.refusals.never_home()

    @cached_property
    def origin(self) -> Place:
        """The place at input 0."""
        place = self.follower.place(0.0, self.start)
        if place is None:
            raise self.refusals.starts_dead()
        return place

    def _leg(self, end: float) -> list[Place]:
        places = [self.origin]
        if not self.follow(places, end):
            raise self._jam(places[-1].q)
        return places

    def follow(self, places: list[Place], end: float) -> bool:
        """Go on from the last place to an input; False where a dead centre is met before.

        Raises
            NoSolution - where more steps would be needed than it is worth to wait for
        """
        most = _MOST_STEPS * max(1, math.ceil(abs(end - places[-1].q) / TURN))
        new = list(islice(onwards(self.follower, places[-1], end), most))
        places += new
        if len(new) == most and places[-1].q != end:
            raise self.refusals.too_fast(places[-1].q, most)
        return places[-1].q == end

    def _jam(self, q: float) -> NoSolution:
        back, free = [self.origin], False
        with suppress(NoSolution):
            free = self.follow(back, -math.copysign(TURN, q))
        return self.refusals.jams(q, None if free else back[-1].q, ranged=self.range is not None)

    def tangents(self, q: Reals) -> Reals:
        """Unknowns along the tangents of the certified places before inputs; (N, unknowns)."""
        at = self.rows[self.before(q)]
        count = len(self.start)
        return np.asarray(at[:, 1 : 1 + count] + at[:, 1 + count :] * (q - at[:, 0])[:, None])

    def before(self, q: Reals) -> NDArray[np.intp]:
        """Numbers of the certified places before inputs, outwards from 0."""
        places = self.rows
        k = np.searchsorted(places[1:, 0], q, side="right")
        return np.where(q < 0.0, np.minimum(k + 1, len(places) - 1), k)
