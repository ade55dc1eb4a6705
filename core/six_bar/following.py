"""One place after another of a six-bar's motion, each certain to lie on the branch of the one before.

With J = dF/du, beta = 1/sigma_min(J), K = sum l_j |N_j|^2, K' = sum l_j |N_j| |t_j'|, M = sum l_j t_j'^2 (and a), the
tangent from a solution fulfils the condition of Kantorovich all along

    x = 1/(beta (sqrt(K M) + K'))

so that one solution near it exists and is unique there, and Newton's steps from the tangent find it. Each place needs
the one before: Python's own numbers, for arrays of one element cost ten times as much.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import dataclass

from gearlink.core.errors import NoSolution
from gearlink.core.results import cached_property
from gearlink.core.six_bar.loop import SixBar

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
        >>> from gearlink.core.six_bar.relations import train_relation
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
