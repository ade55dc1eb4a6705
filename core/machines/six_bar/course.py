"""The motion of a geared six-bar followed from its start, without ever changing over to another of its closings."""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass
from fractions import Fraction
from itertools import islice
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution, anew
from gearlink.core.base.results import cached_property
from gearlink.core.machines.six_bar.loop import SixBar
from gearlink.core.numerics.arrays import Reals

# One place after another of a six-bar's motion, each certain to lie on the branch of the one before

JAM = 1e-9  # rad, a certified step so short is a dead centre, known to about as much
_ROUNDS = 60
_FINE = 1e-10  # rad, after a step so short another one would be some 1e-20
_SINGULAR = 1e-15


@dataclass(frozen=True, slots=True)
class Place:
    """A place of the motion.

    Parameters
        phi : float - input angle [rad]
        u : two float - free directions less those at the start [rad]
        rates : two float - their derivatives by the input angle
        reach : float - how far the tangent certainly leads to the next place [rad]
    """

    phi: float
    u: tuple[float, float]
    rates: tuple[float, float]
    reach: float

    @property
    def row(self) -> tuple[float, ...]:
        """Input angle, free directions and their rates."""
        return (self.phi, *self.u, *self.rates)


@dataclass(frozen=True)
class Follower:
    """The motion of a six-bar in certain steps.

    Parameters
        bar : SixBar
    Example
        >>> from gearlink.core.machines.six_bar.relations import train_relation
        >>> rows = train_relation(0, (20, 20)), train_relation(4, (16, 24))
        >>> start = {2: math.radians(300.0), 5: math.radians(-60.0)}
        >>> follower = Follower(SixBar((190.0, 30.0, 30.0, 150.0, 60.0, 75.0), rows, start))
        >>> origin = follower.place(0.0, (0.0, 0.0))
        >>> round(list(follower.onwards(origin, 0.5))[-1].phi, 12)
        0.5

    Source
        own derivation; L. V. Kantorovich's theorem for the steps
    """

    bar: SixBar

    @cached_property
    def _links(self) -> tuple[tuple[float, ...], ...]:
        """Of links 2 to 5: length, direction at the start, p_j, N_j."""
        length, first, slopes, shares = (numbers.tolist() for numbers in self.bar.numbers)
        return tuple((*each, *share) for *each, share in zip(length, first, slopes, shares, strict=True))

    @cached_property
    def _sizes(self) -> tuple[float, ...]:
        """l_j |N_j|."""
        return tuple(length * math.hypot(n, m) for length, _, _, n, m in self._links)

    @cached_property
    def _curvature(self) -> float:
        """K."""
        return sum(size * math.hypot(n, m) for size, (*_, n, m) in zip(self._sizes, self._links, strict=True))

    def onwards(self, place: Place, end: float) -> Iterator[Place]:
        """The places after one, up to an input angle; fewer where a dead centre is met before."""
        way = math.copysign(1.0, end - place.phi)
        while place.phi != end and place.reach >= JAM:
            phi = end if place.reach >= abs(end - place.phi) else place.phi + way * place.reach
            on = phi - place.phi
            found = self.place(
                phi, self.closed(phi, (place.u[0] + place.rates[0] * on, place.u[1] + place.rates[1] * on))
            )
            if found is None:
                return
            place = found
            yield place

    def closed(self, phi: float, near: tuple[float, float]) -> tuple[float, float]:
        """Free directions less those at the start, from approximate ones, by Newton's steps.

        Parameters
            phi : float - input angle [rad]
            near : two float [rad] - next to those of the loop
        Raises
            NoSolution - where the loop does not close
        """
        u, w, finest = *near, math.inf
        frame, crank = self.bar.lengths[:2]
        for _ in range(_ROUNDS):
            gap, one, other = cmath.rect(crank, phi) - frame, 0j, 0j
            for length, first, slope, n, m in self._links:
                link = cmath.rect(length, first + slope * phi + n * u + m * w)
                gap, one, other = gap + link, one + n * link, other + m * link
            step = _solve_pair(1j * one, 1j * other, -gap)
            size = max(map(abs, step))
            if not size < math.inf:
                break
            if size >= finest:  # steps shrink until rounding is reached
                return u, w
            u, w, finest = u + step[0], w + step[1], size
            if size < _FINE:
                return u, w
        raise NoSolution("the six-bar does not close there")

    def place(self, phi: float, u: tuple[float, float]) -> Place | None:
        """The place at an input angle; None in a dead centre.

        Parameters
            phi : float - input angle [rad]
            u : two float - free directions less those at the start [rad]
        """
        crank, one, other = cmath.rect(self.bar.lengths[1], phi), 0j, 0j
        pushed = crank
        for length, first, slope, n, m in self._links:
            link = cmath.rect(length, first + slope * phi + n * u[0] + m * u[1])
            pushed, one, other = pushed + slope * link, one + n * link, other + m * link
        product, a, b = one.conjugate() * other, abs(one) ** 2, abs(other) ** 2
        determinant = product.imag
        if abs(determinant) < _SINGULAR * (a + b):
            return None
        rates = _solve_pair(one, other, -pushed)
        beta = math.sqrt(0.5 * (a + b + math.hypot(a - b, 2.0 * product.real))) / abs(determinant)
        turned = [slope + n * rates[0] + m * rates[1] for _, _, slope, n, m in self._links]
        k_rate = sum(size * abs(rate) for size, rate in zip(self._sizes, turned, strict=True))
        m_all = sum(each[0] * rate**2 for each, rate in zip(self._links, turned, strict=True)) + self.bar.lengths[1]
        return Place(phi, u, rates, 1.0 / (beta * (math.sqrt(self._curvature * m_all) + k_rate)))


def _solve_pair(one: complex, other: complex, right: complex) -> tuple[float, float]:
    """Real x, y with x one + y other = right; infinite where there are none."""
    determinant = (one.conjugate() * other).imag
    if determinant == 0.0:
        return math.inf, math.inf
    return (right.conjugate() * other).imag / determinant, (one.conjugate() * right).imag / determinant


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
        >>> from gearlink.core.machines.six_bar.relations import train_relation
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
