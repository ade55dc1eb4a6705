"""The motion of a geared six-bar followed from its start, without ever changing over to another of its closings."""

from __future__ import annotations

import cmath
import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.machines.six_bar.loop import SixBar
from gearlink.core.mechanism.follow import MOST_TURNS, TURN, Place, Walk
from gearlink.core.numerics.arrays import Reals

_ROUNDS = 60
_FINE = 1e-10  # rad, after a step so short another one would be some 1e-20
_SINGULAR = 1e-15
_HOME = 1e-7  # rad, play of a return: directions repeat exactly or are apart by a share of a turn


@dataclass(frozen=True)
class Follower:
    """The certain steps of a six-bar: unknown are its free directions less those at the start [rad].

    Parameters
        bar : SixBar
    Example
        >>> from gearlink.core.mechanism.follow import onwards
        >>> from gearlink.core.machines.six_bar.relations import train_relation
        >>> rows = train_relation(0, (20, 20)), train_relation(4, (16, 24))
        >>> start = {2: math.radians(300.0), 5: math.radians(-60.0)}
        >>> follower = Follower(SixBar((190.0, 30.0, 30.0, 150.0, 60.0, 75.0), rows, start))
        >>> origin = follower.place(0.0, (0.0, 0.0))
        >>> round(list(onwards(follower, origin, 0.5))[-1].q, 12)
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

    def closed(self, q: float, near: tuple[float, ...]) -> tuple[float, ...]:
        """Free directions from approximate ones, by Newton's steps.

        Parameters
            q : float - input angle [rad]
            near : two float [rad] - next to those of the loop
        Raises
            NoSolution - where the loop does not close
        """
        (u, w), phi, finest = near, q, math.inf
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

    def place(self, q: float, u: tuple[float, ...]) -> Place | None:
        """The place at an input angle; None in a dead centre.

        Parameters
            q : float - input angle [rad]
            u : two float - free directions [rad]
        """
        phi = q
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


@dataclass(frozen=True)
class _Refusals:
    """Why a six-bar cannot be followed."""

    def starts_dead(self) -> NoSolution:
        return NoSolution("the six-bar starts in a dead centre: change start", key="start")

    def jams(self, q: float, back: float | None, *, ranged: bool) -> NoSolution:
        """With the range that is free of dead centres."""
        if back is None:
            free = f"{'above' if q < 0.0 else 'below'} {math.degrees(q):.6g} deg"
        else:
            low, high = sorted((math.degrees(q), math.degrees(back)))
            free = f"between {low:.6g} and {high:.6g} deg"
        return NoSolution(
            f"the six-bar meets a dead centre at input angle {math.degrees(q):.6g} deg, where it jams: let the input "
            f"swing {free} (range: {{start, end}}), lengthen the couplers, or shorten input and output",
            key="range" if ranged else "links",
        )

    def never_home(self) -> NoSolution:
        return NoSolution(
            f"the six-bar does not come home within {MOST_TURNS} turns of the input: take teeth with common factors, "
            "or give range: {start, end}",
            key="trains",
        )


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
        return TURN * (self.period_turns or 1) if self.range is None else self.range[1]

    @property
    def period_turns(self) -> int | None:
        """Input turns until everything repeats; None over a range."""
        return self.walk.turns

    @property
    def followed(self) -> int:
        """How many places were followed so far."""
        return self.walk.followed

    @cached_property
    def walk(self) -> Walk:
        """The certified places."""
        return Walk(Follower(self.bar), (0.0, 0.0), self.range, _home_turns(self.bar), self._is_home, _Refusals())

    def _is_home(self, place: Place, turns: int) -> bool:
        _, _, slopes, shares = self.bar.numbers
        moved = slopes * TURN * turns + shares @ np.array(place.u)
        return bool(np.abs(np.remainder(moved + math.pi, TURN) - math.pi).max() < _HOME)

    # Positions

    @cached_property
    def grid(self) -> Reals:
        """Input angles [rad] next to which functions of the motion are smooth: dense where dead centres are near."""
        places = self.walk.rows[:, 0]
        inside = places[(places >= self.start) & (places <= self.end)]
        ends = np.array([self.start, self.end])
        return np.unique(np.concatenate([ends, np.linspace(self.start, self.end, self.samples + 1), inside]))

    @property
    def samples(self) -> int:
        """Points of an even grid on which the motion is smooth."""
        fastest = max(1.0, *(abs(float(p)) for p in self.bar.slopes))
        return math.ceil(360.0 * fastest * (self.end - self.start) / TURN)

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
        return self.bar.closed(phi, self.walk.tangents(phi).T)

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
