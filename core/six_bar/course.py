"""The motion of a geared six-bar followed from its start, without ever changing over to another of its closings.

With J = dF/du, beta = 1/sigma_min(J), K = sum l_j |N_j|^2, K' = sum l_j |N_j| |t_j'|, M = sum l_j t_j'^2 (and a), the
tangent from a solution fulfils the condition of Kantorovich all along

    x = 1/(beta (sqrt(K M) + K'))

so that one solution near it exists and is unique there, and Newton's steps from the tangent find it.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from fractions import Fraction

import numpy as np

from gearlink.core.errors import NoSolution
from gearlink.core.numerics.arrays import Reals
from gearlink.core.results import cached_property
from gearlink.core.six_bar.loop import SixBar

_TURN = 2.0 * math.pi
_MOST_TURNS = 100
_JAM = 1e-9  # rad, a certified step so short is a dead centre, known to about as much
_HOME = 1e-7  # rad, play of a return: directions repeat exactly or are apart by a share of a turn
_MOST_STEPS = 100_000


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

    @cached_property
    def _followed(self) -> tuple[Reals, int | None]:
        """Certified places: rows of input angle, free directions, their rates; and the turns of the period."""
        if self.range is not None:
            legs = [self._leg(min(self.range[0], 0.0)), self._leg(max(self.range[1], 0.0))]
            return np.array(legs[0][:0:-1] + legs[1]), None
        places, least = [self._origin], _home_turns(self.bar)
        for turns in range(least, _MOST_TURNS + 1, least):
            if not self._follow(places, _TURN * turns):
                raise NoSolution(self._jam(places[-1][0]), key="links")
            if self._is_home(places[-1], turns):
                return np.array(places), turns
        raise NoSolution(
            f"the six-bar does not come home within {_MOST_TURNS} turns of the input: take teeth with common factors, "
            "or give range: {start, end}",
            key="trains",
        )

    @cached_property
    def _origin(self) -> tuple[float, ...]:
        rates = self._rates(0.0, np.zeros(2))
        if rates is None:
            raise NoSolution("the six-bar starts in a dead centre: change start", key="start")
        return (0.0, 0.0, 0.0, *rates[0])

    def _leg(self, end: float) -> list[tuple[float, ...]]:
        places = [self._origin]
        if not self._follow(places, end):
            raise NoSolution(self._jam(places[-1][0]), key="range")
        return places

    def _follow(self, places: list[tuple[float, ...]], end: float) -> bool:
        """Go on from the last place to an input angle; False where a dead centre is met before."""
        way = math.copysign(1.0, end - places[-1][0])
        while places[-1][0] != end:
            phi, *rest = places[-1]
            u, rate = np.array(rest[:2]), np.array(rest[2:])
            found = self._rates(phi, u)
            if found is None or found[1] < _JAM or len(places) > _MOST_STEPS:
                return False
            onwards = end if found[1] >= abs(end - phi) else phi + way * found[1]
            u = self._solved(onwards, u + rate * (onwards - phi))
            rates = self._rates(onwards, u)
            if rates is None:
                return False
            places.append((onwards, *u, *rates[0]))
        return True

    def _solved(self, phi: float, near: Reals) -> Reals:
        angles = self.bar.closed(np.array([phi]), near[:, None])[:, 0]
        rows = [j - 2 for j in self.bar.free]
        return np.asarray(angles[rows] - self.bar.numbers[1][rows])

    def _rates(self, phi: float, u: Reals) -> tuple[Reals, float] | None:
        """Rates of the free directions, and the step that is certain; None in a dead centre."""
        bar = self.bar
        length, first, slopes, shares = bar.numbers
        angles = (first + slopes * phi + shares @ u)[:, None]
        one, other = (complex(c[0]) for c in bar.columns(bar.links(angles)))
        determinant, total = (one.conjugate() * other).imag, abs(one) ** 2 + abs(other) ** 2
        if abs(determinant) < 1e-15 * total:
            return None
        turned = bar.rates(np.array([phi]), angles)[0][:, 0]
        beta = math.sqrt(0.5 * (total + math.sqrt(max(total * total - 4.0 * determinant**2, 0.0)))) / abs(determinant)
        size = np.hypot(shares[:, 0], shares[:, 1])
        k, k_rate = float(length @ size**2), float(length @ (size * np.abs(turned)))
        m = float(length @ turned**2) + bar.lengths[1]
        return turned[[j - 2 for j in bar.free]], 1.0 / (beta * (math.sqrt(k * m) + k_rate))

    def _is_home(self, place: tuple[float, ...], turns: int) -> bool:
        _, _, slopes, shares = self.bar.numbers
        moved = slopes * _TURN * turns + shares @ np.array(place[1:3])
        return bool(np.abs(np.remainder(moved + math.pi, _TURN) - math.pi).max() < _HOME)

    def _jam(self, phi: float) -> str:
        """What is wrong at a dead centre, with the range that is free of them."""
        back = [self._origin]
        if self._follow(back, -math.copysign(_TURN, phi)):
            free = f"{'above' if phi < 0.0 else 'below'} {math.degrees(phi):.6g} deg"
        else:
            low, high = sorted((math.degrees(phi), math.degrees(back[-1][0])))
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

    def rates(self, phi: Reals) -> tuple[Reals, Reals, Reals, Reals]:
        """Directions of links 2 to 5 and their first three derivatives by the input angle; (4, N) arrays."""
        return self._on_grid if phi is self.grid else self._rates_at(phi)

    @cached_property
    def _on_grid(self) -> tuple[Reals, Reals, Reals, Reals]:
        """On the grid all extremes are looked for among the same rates."""
        return self._rates_at(self.grid)

    def _rates_at(self, phi: Reals) -> tuple[Reals, Reals, Reals, Reals]:
        angles = self.angles(phi)
        return angles, *self.bar.rates(phi, angles)


def _home_turns(bar: SixBar) -> int:
    """Input turns after which the links that the input alone ties are home."""
    if not bar.is_closed_form:
        return 1
    return math.lcm(*(Fraction(p).denominator for p in bar.slopes))
