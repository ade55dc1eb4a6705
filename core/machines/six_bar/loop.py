"""The loop of a geared six-bar A B C D E F: what its trains tie, its links, and its motion in certain steps.

a e^(i phi) + sum l_j e^(i t_j) = d,   t_j = t_j0 + p_j phi + N_j u,   j = 2 to 5,   u in R^2

The trains leave two directions u free (link j leads from pin to pin on the way from A to F); the loop fixes them.
Where the trains tie two directions to the input alone, the other two links close the loop as a dyad, in closed form.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import chain, combinations
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_above, safely_below
from gearlink.core.base.results import cached_property
from gearlink.core.base.wording import short
from gearlink.core.machines.six_bar.spec import LINKS, PINS, SixTrain
from gearlink.core.mechanism.follow import MOST_TURNS, TURN, Place, Walk
from gearlink.core.numerics.arrays import Reals, distinct, product, turned
from gearlink.core.numerics.roots_sweep import newton_closed
from gearlink.core.parts.linkages.dyad import close_dyad, require_lengths

Row: TypeAlias = tuple[Fraction, ...]
_COUNT = len(LINKS)
_ZERO, _ONE = Fraction(0), Fraction(1)


def train_relation(first_pin: int, teeth: Sequence[int]) -> Row:
    """Coefficients of the directions of the six links in the relation that a train ties.

    z_k (g_k - t_c) + z_(k+1) (g_(k+1) - t_c) = const on each carrier c;   sum r_j t_j = const over the train

    Parameters
        first_pin : int - of the first gear, 0 to 5; link j leads from pin j - 1 to pin j, link 0 is the frame
        teeth : two to five int - of the gears on this pin and those after it, negative for a ring
    Returns
        r : six Fraction - their sum is 0, since a revolution of the whole changes nothing
    Notes
        The first gear is fixed to the link before its pin, the last one to the link after it, so that each train takes
        one degree of freedom away.
    Example
        A gear on A fixed to the frame, one on B fixed to the coupler BC: t2 = (1 + z_A/z_B) t1 + const.

        >>> [str(r) for r in train_relation(0, (20, 40))]
        ['-1/2', '3/2', '-1', '0', '0', '0']

    Source
        thesis 2.1, rule (3); Willis's equation
    """
    gear = _unit(first_pin)
    for k in range(1, len(teeth)):
        carrier, ratio = _unit(first_pin + k), Fraction(teeth[k - 1], teeth[k])
        gear = tuple((1 + ratio) * c - ratio * g for g, c in zip(gear, carrier, strict=True))
    held = _unit(first_pin + len(teeth))
    return tuple(g - h for g, h in zip(gear, held, strict=True))


def _unit(link: int) -> Row:
    return tuple(_ONE if j == link % _COUNT else _ZERO for j in range(_COUNT))


def reduced(rows: Sequence[Row]) -> tuple[list[Row], list[int]]:
    """The relations solved for as many of the links 2 to 5 (Gauss and Jordan, exactly).

    Parameters
        rows : two rows from `train_relation`
    Returns
        rows, pivots : the k-th row has 1 at link pivots[k], where the other has 0
    Raises
        NoSolution - where the two trains tie the same
    Example
        >>> rows, pivots = reduced([train_relation(0, (20, 20)), train_relation(4, (16, 24))])
        >>> pivots, [str(r) for r in rows[0]], [str(r) for r in rows[1]]
        ([2, 4], ['1', '-2', '1', '0', '0', '0'], ['3/2', '0', '0', '0', '1', '-5/2'])
    """
    left: list[list[Fraction]] = [list(row) for row in rows]
    pivots: list[int] = []
    for column in range(2, _COUNT):
        k = len(pivots)
        found = next((i for i in range(k, len(left)) if left[i][column]), None)
        if found is None:
            continue
        left[k], left[found] = left[found], left[k]
        left[k] = [value / left[k][column] for value in left[k]]
        for i in range(len(left)):
            if i != k:
                left[i] = [a - left[i][column] * b for a, b in zip(left[i], left[k], strict=True)]
        pivots.append(column)
        if len(pivots) == len(left):
            return [tuple(row) for row in left], pivots
    raise NoSolution(
        "both trains couple the same links in the same ratio: the second removes no degree of freedom",
        key="trains",
        fix="put it on other pins",
    )


FREE = range(2, _COUNT)

BLOCK = 4096  # of places, so that they stay in the cache


@dataclass(frozen=True)
class SixBar:
    """A loop of six links with two trains.

    Parameters
        lengths : six float [mm] - FA, AB, BC, CD, DE, EF
        relations : two rows of `train_relation`
        start : mapping - directions at input angle 0 of two of the links 2 to 5 [rad], on the way from A to F
        assembly : +1 or -1 - +1: of the other two links, on the way from A to F, the first points to the left of the
            second at the start
    Raises
        NoSolution - for a length that is not positive and finite, trains that tie the same, a start that does not close
    Example
        Both trains on the input's side: t2 = 2 phi + 60 deg, the output EF turns against the input.

        >>> import math
        >>> from gearlink.core.machines.six_bar.loop import train_relation
        >>> rows = train_relation(0, (20, 20)), train_relation(5, (30, 30))
        >>> bar = SixBar((60.0, 40.0, 20.0, 60.0, 60.0, 20.0), rows, {2: math.radians(60.0), 5: math.radians(-90.0)})
        >>> bar.is_closed_form, [round(math.degrees(t), 6) for t in bar.start_angles]
        (True, [60.0, 100.050768, -70.050768, -90.0])

    Source
        thesis 2.1, rule (3); formulas: own derivation
    """

    lengths: tuple[float, ...]
    relations: tuple[Row, Row]
    start: Mapping[int, float]
    assembly: int = 1

    def __post_init__(self) -> None:
        require_lengths(**dict(zip(LINKS, self.lengths, strict=True)))
        _ = self.tied, self.start_angles

    @cached_property
    def tied(self) -> tuple[list[Row], list[int]]:
        """The relations solved for two of the links, and which."""
        return reduced(self.relations)

    @cached_property
    def free(self) -> tuple[int, int]:
        """The links whose directions the trains leave free, or tie the other two to."""
        one, other = (j for j in FREE if j not in self.tied[1])
        return one, other

    @cached_property
    def slopes(self) -> tuple[Fraction, ...]:
        """p_j: turns of links 2 to 5 per revolution of the input while the free directions rest."""
        rows, pivots = self.tied
        return tuple(-rows[pivots.index(j)][1] if j in pivots else Fraction(0) for j in FREE)

    @cached_property
    def shares(self) -> tuple[tuple[Fraction, ...], ...]:
        """N_j: turns of links 2 to 5 per revolution of each free direction."""
        (rows, pivots), free = self.tied, self.free
        return tuple(
            tuple(-rows[pivots.index(j)][f] for f in free)
            if j in pivots
            else tuple(Fraction(int(j == f)) for f in free)
            for j in FREE
        )

    @property
    def is_closed_form(self) -> bool:
        """Whether the trains tie two directions to the input alone."""
        return not any(any(share) for j, share in zip(FREE, self.shares, strict=True) if j not in self.free)

    @cached_property
    def start_angles(self) -> tuple[float, ...]:
        """Directions of links 2 to 5 at input angle 0 [rad], given or closed by a dyad."""
        one, other = (j for j in FREE if j not in self.start)
        known = sum(cmath.rect(self.lengths[j], angle) for j, angle in self.start.items())
        gap = self.lengths[0] - self.lengths[1] - known
        try:
            pin = close_dyad(0j, gap, self.lengths[one], self.lengths[other], self.assembly)
        except NoSolution as error:
            ways = f"{LINKS[one]} and {LINKS[other]}"
            message = f"the six-bar does not close at the start: the ends of {ways} are {error.message}"
            raise NoSolution(message, fix=error.fix) from None
        found = {**self.start, one: cmath.phase(pin), other: cmath.phase(gap - pin)}
        return tuple(found[j] for j in FREE)

    @cached_property
    def numbers(self) -> tuple[Reals, Reals, Reals, NDArray[np.float64]]:
        """Lengths of links 2 to 5, t_j0, p_j and N_j as arrays."""
        return (
            np.array(self.lengths[2:]),
            np.array(self.start_angles),
            np.array([float(p) for p in self.slopes]),
            np.array([[float(n) for n in share] for share in self.shares]),
        )

    @cached_property
    def columns(self) -> tuple[Reals, Reals]:
        """Lengths of links 2 to 5 and t_j0 as (4, 1) arrays; as (4, N) arrays where each of N places has its own."""
        length, first = (numbers.reshape(4, -1) for numbers in self.numbers[:2])
        return length, first

    def closed(self, phi: Reals, near: Reals) -> Reals:
        """Directions of links 2 to 5, continued from approximate ones.

        Parameters
            phi : (N,) array [rad]
            near : (2, N) array [rad] - free directions less those at the start, next to those of the loop
        Returns
            angles : (4, N) array [rad]
        Raises
            NoSolution - where the loop does not close
        """
        return self._by_dyad(phi, near) if self.is_closed_form else self._by_newton(phi, near)

    def _by_dyad(self, phi: Reals, near: Reals) -> Reals:
        """The dyad of the free links; `near` tells its side and its turns."""
        (length, first), (slopes, shares) = self.columns, self.numbers[2:]
        rows = [j - 2 for j in self.free]
        angles: Reals = first + slopes[:, None] * phi + _weighted(shares, near)
        moved = angles[rows].copy()
        angles[rows] = 0.0
        tied = [j for j in range(4) if j not in rows]
        chord = self.lengths[0] - self.lengths[1] * np.exp(1j * phi)
        chord = chord - (length[tied] * np.exp(1j * angles[tied])).sum(axis=0)
        b, c = length[rows]
        n, side = np.abs(chord), np.sign(np.sin(moved[0] - moved[1]))
        with np.errstate(invalid="ignore", divide="ignore"):
            height = 0.5 * np.sqrt((b + c - n) * (b + c + n) * (n - b + c) * (n + b - c)) / n
            pin = chord / n * (0.5 * (n + (b - c) * (b + c) / n) + 1j * side * height)
        for row, vector, close in zip(rows, (pin, chord - pin), moved, strict=True):
            angles[row] = close + np.angle(product(vector, np.exp(-1j * close)))
        if not np.isfinite(angles).all():
            raise NoSolution("the six-bar does not close there")
        return angles

    def _by_newton(self, phi: Reals, near: Reals) -> Reals:
        """Newton's steps on the two free directions until they are rounding, block by block."""
        angles = np.empty((4, phi.size))
        for start in range(0, phi.size, BLOCK):
            part = slice(start, start + BLOCK)
            angles[:, part] = self._block_by_newton(phi[part], near[:, part])
        return angles

    def _block_by_newton(self, phi: Reals, near: Reals) -> Reals:
        (length, first), (slopes, shares) = self.columns, self.numbers[2:]
        base = first + slopes[:, None] * phi
        lengths = np.broadcast_to(length, base.shape)
        cos, sin = turned(phi)
        chord = np.array([self.lengths[1] * cos - self.lengths[0], self.lengths[1] * sin])

        def step(u: Reals, rows: Any) -> Reals:
            if rows.size < phi.size:  # to look at few of all takes as long as to copy them
                return self._closing_step(lengths[:, rows], base[:, rows], chord[:, rows], u.T).T
            return self._closing_step(length, base, chord, u.T).T

        found = newton_closed(step, near.T)
        if found is None:
            raise NoSolution("the six-bar does not close there")
        return base + _weighted(shares, found.T)

    def _closing_step(self, length: Reals, base: Reals, chord: Reals, u: Reals) -> Reals:
        cos, sin = _projections(length, base + _weighted(self.numbers[3], u))
        shares = self.numbers[3].T
        opened = chord[0] + cos.sum(axis=0), chord[1] + sin.sum(axis=0)
        return _closing(_weighted(shares, cos), _weighted(shares, sin), *opened)

    def rates(self, phi: Reals, angles: Reals, order: int = 3) -> tuple[Reals, ...]:
        """First derivatives of the directions of links 2 to 5 by the input angle, up to three.

        i sum l_j t_j' e_j = -i a e_1,   i sum l_j t_j'' e_j = sum l_j t_j'^2 e_j + a e_1,
        i sum l_j t_j''' e_j = sum l_j (3 t_j' t_j'' + i t_j'^3) e_j + i a e_1

        Parameters
            phi : (N,) array [rad]
            angles : (4, N) array [rad]
            order : 0..3
        Returns
            first, second, third : (4, N) arrays [1, 1/rad, 1/rad^2] - as many as asked for
        Notes
            The condition is 1/sin of `transmission`, infinite in a dead centre.
        """
        parts = [
            self._block_rates(phi[start : start + BLOCK], angles[:, start : start + BLOCK], order)
            for start in range(0, max(1, phi.size), BLOCK)
        ]
        return parts[0] if len(parts) == 1 else tuple(np.hstack(each) for each in zip(*parts, strict=True))

    def _block_rates(self, phi: Reals, angles: Reals, order: int) -> tuple[Reals, ...]:
        if order == 0:
            return ()
        _, _, slopes, shares = self.numbers
        cos, sin = _projections(self.columns[0], angles)
        crank_x, crank_y = (self.lengths[1] * each for each in turned(phi))
        ends = _weighted(shares.T, cos), _weighted(shares.T, sin)
        driven_x, driven_y = (_weighted(slopes[None], links)[0] for links in (cos, sin))
        first = slopes[:, None] + _weighted(shares, _closing(*ends, -(crank_y + driven_y), crank_x + driven_x))
        if order == 1:
            return (first,)
        square = first * first
        pulled = [-(part + (square * links).sum(axis=0)) for part, links in ((crank_x, cos), (crank_y, sin))]
        second = _weighted(shares, _closing(*ends, pulled[0], pulled[1]))
        if order == 2:
            return first, second
        along, across = 3.0 * first * second, first * square
        x = crank_y - (along * cos - across * sin).sum(axis=0)
        y = -crank_x - (along * sin + across * cos).sum(axis=0)
        return first, second, _weighted(shares, _closing(*ends, x, y))

    def transmission(self, angles: Reals) -> Reals:
        """Angle between the velocities by which the two free directions close the loop, 0 to 90 deg [rad].

        Notes
            In a closed form it is the transmission angle of the dyad. It vanishes in the dead centres alone.
        Source
            VDI 2142 for the dyad; own derivation
        """
        found = np.empty(angles.shape[1:])
        for start in range(0, found.size, BLOCK):
            part = slice(start, start + BLOCK)
            x, y = (_weighted(self.numbers[3].T, each) for each in _projections(self.columns[0], angles[:, part]))
            found[part] = np.arctan2(np.abs(x[0] * y[1] - y[0] * x[1]), np.abs(x[0] * x[1] + y[0] * y[1]))
        return found


def _projections(length: Reals, angles: Reals) -> tuple[Reals, Reals]:
    """Links 2 to 5 along x and y [mm], two (4, N) arrays."""
    cos, sin = turned(angles)
    return length * cos, length * sin


def _weighted(weights: Reals, rows: Reals) -> Reals:
    """The product of (M, K) and (K, N); unlike BLAS, no bit of a column depends on where it stands."""
    total: Reals = weights[:, :1] * rows[0]
    for k in range(1, len(rows)):
        total += weights[:, k, None] * rows[k]
    return total


def _closing(cos: Reals, sin: Reals, x: Reals, y: Reals) -> Reals:
    """Newton's step of the free directions, (2, N), where the loop is open by x, y and its links run so."""
    determinant = sin[0] * cos[1] - sin[1] * cos[0]
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.asarray(np.array([x * cos[1] + y * sin[1], -(x * cos[0] + y * sin[0])]) / determinant)


_ROUNDS = 60
_FINE = 1e-10  # rad, after a step so short another one would be some 1e-20
_SINGULAR = 1e-15
_HOME = 1e-7  # rad, play of a return: directions repeat exactly or are apart by a share of a revolution


@dataclass(frozen=True)
class Follower:
    """The certain steps of a six-bar: unknown are its free directions less those at the start [rad].

    Example
        >>> from gearlink.core.mechanism.follow import onwards
        >>> from gearlink.core.machines.six_bar.loop import train_relation
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
        return NoSolution("the six-bar starts in a dead centre", key="start", fix="change start")

    def jams(self, q: float, back: float | None, *, ranged: bool) -> NoSolution:
        """With the range that is free of dead centres."""
        if back is None:
            here = math.degrees(q)
            free = f"above {safely_above(here, 6)} deg" if q < 0.0 else f"below {safely_below(here, 6)} deg"
            fix = f"let the input oscillate {free} (range: {{start, end}})"
        else:
            low, high = sorted((math.degrees(q), math.degrees(back)))
            fix = f"set range.start to {safely_above(low, 6)} and range.end to {safely_below(high, 6)} deg"
        return NoSolution(
            f"the six-bar reaches a dead centre at input angle {short(math.degrees(q))} deg, where it jams",
            key="range" if ranged else "links",
            fix=f"{fix}, lengthen the couplers, or shorten input and output",
        )

    def never_home(self) -> NoSolution:
        return NoSolution(
            f"the six-bar does not return to its start position within {MOST_TURNS} turns of the input",
            key="trains",
            fix="use teeth with common factors, or give range: {start, end}",
        )

    def too_fast(self, q: float, steps: int) -> NoSolution:
        return NoSolution(
            f"the motion changes too fast to be computed: {steps} steps lead to input angle {short(math.degrees(q))} "
            "deg",
            key="links",
            fix="check lengths and teeth: some sizes are hundreds of times larger than others",
        )


@dataclass(frozen=True)
class Course:
    """The motion of a six-bar over a period, or over a range of the input.

    Parameters
        range : (start, end) [rad] or None - a range that holds 0, or as many revolutions as bring the linkage home
    Raises
        NoSolution - where a dead centre is met: with the range of the input that is free of them
    Example
        >>> from gearlink.core.machines.six_bar.loop import train_relation
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
        return distinct(np.concatenate([ends, np.linspace(self.start, self.end, self.samples + 1), inside]))

    @property
    def samples(self) -> int:
        """Points of an even grid on which the motion is smooth."""
        fastest = max(1.0, *(abs(float(p)) for p in self.bar.slopes))
        return math.ceil(360.0 * fastest * (self.end - self.start) / TURN)

    def angles(self, phi: Reals) -> Reals:
        """Directions of links 2 to 5, continuous over the course and beyond its period; (4, N) array [rad]."""
        if self.range is not None:
            return self.within(phi)
        periods = np.floor(phi / self.end)
        return self.within(phi - periods * self.end) + periods * self.gain

    @cached_property
    def gain(self) -> Reals:
        """What the directions gain in a period; (4, 1) array [rad]."""
        ends = self.within(np.array([0.0, self.end]))
        return np.asarray(ends[:, 1:] - ends[:, :1])

    def within(self, phi: Reals) -> Reals:
        """The same from the start to the end of the period or range."""
        return self.bar.closed(phi, self.walk.tangents(phi).T)

    def rates(self, phi: Reals, order: int = 3) -> tuple[Reals, ...]:
        """Directions of links 2 to 5 and their first derivatives by the input angle, up to three; (4, N) arrays."""
        return self.on_grid if phi is self.grid and order == 3 else self.rates_at(phi, order)

    @cached_property
    def on_grid(self) -> tuple[Reals, ...]:
        """On the grid all extremes are looked for among the same rates."""
        return self.rates_at(self.grid, 3)

    def rates_at(self, phi: Reals, order: int) -> tuple[Reals, ...]:
        """The same of any places."""
        angles = self.angles(phi)
        return angles, *self.bar.rates(phi, angles, order)


def _home_turns(bar: SixBar) -> int:
    """Input turns after which the links that the input alone ties are home."""
    if not bar.is_closed_form:
        return 1
    return math.lcm(*(Fraction(p).denominator for p in bar.slopes))


def joined_by(trains: Iterable[SixTrain]) -> Iterator[tuple[str, int]]:
    """Every two of the pins with gears, and of A and F, with the link that joins them, the frame 0; -1 without one."""
    axes = sorted({*chain(*(train.pins for train in trains)), "A", "F"})
    for one, other in combinations(axes, 2):
        i, j = PINS.index(one), PINS.index(other)
        yield one + other, j if j - i == 1 else 0 if j - i == 5 else -1
