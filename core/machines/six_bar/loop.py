"""What trains tie, positions of the geared six-bar A B C D E F and their derivatives over the input angle.

a e^(i phi) + sum l_j e^(i t_j) = d,   t_j = t_j0 + p_j phi + N_j u,   j = 2 to 5,   u in R^2

The trains leave two directions u free (link j leads from pin to pin on the way from A to F); the loop fixes them.
Where the trains tie two directions to the input alone, the other two links close the loop as a dyad, in closed form.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Reals, product, turned
from gearlink.core.parts.linkages.dyad import close_dyad, require_lengths

LINKS = 6
Row: TypeAlias = tuple[Fraction, ...]
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
    return tuple(_ONE if j == link % LINKS else _ZERO for j in range(LINKS))


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
    for column in range(2, LINKS):
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
        "both trains tie the same links in the same ratio, the second takes no freedom away",
        key="trains",
        fix="put it on other pins",
    )


FREE = range(2, LINKS)
NAMES = ("frame", "input", "coupler_1", "coupler_2", "coupler_3", "output")
_ROUNDS = 60
_BLOCK = 4096  # of places, so that they stay in the cache
_REST = 1e-18  # rad, a step so short is none
_NEAR = 1e-5  # rad, steps converge by the square from there on


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
        require_lengths(**dict(zip(NAMES, self.lengths, strict=True)))
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
            ways = f"{NAMES[one]} and {NAMES[other]}"
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

    def _projections(self, angles: Reals) -> tuple[Reals, Reals]:
        """Links 2 to 5 along x and y [mm], two (4, N) arrays."""
        cos, sin = turned(angles)
        return self.numbers[0][:, None] * cos, self.numbers[0][:, None] * sin

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
        length, first, slopes, shares = self.numbers
        rows = [j - 2 for j in self.free]
        angles: Reals = first[:, None] + slopes[:, None] * phi + _weighted(shares, near)
        moved = angles[rows].copy()
        angles[rows] = 0.0
        tied = [j for j in range(4) if j not in rows]
        chord = self.lengths[0] - self.lengths[1] * np.exp(1j * phi)
        chord = chord - (length[tied, None] * np.exp(1j * angles[tied])).sum(axis=0)
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
        for start in range(0, phi.size, _BLOCK):
            part = slice(start, start + _BLOCK)
            angles[:, part] = self._block_by_newton(phi[part], near[:, part])
        return angles

    def _block_by_newton(self, phi: Reals, near: Reals) -> Reals:
        """Each place rests by itself: no bit of it depends on the others."""
        _, first, slopes, shares = self.numbers
        base = first[:, None] + slopes[:, None] * phi
        cos, sin = turned(phi)
        chord = self.lengths[1] * cos - self.lengths[0], self.lengths[1] * sin
        u, finest = near.copy(), np.full(phi.shape, np.inf)
        found, rows = u.copy(), np.arange(phi.size)
        for _ in range(_ROUNDS):
            cos, sin = self._projections(base + _weighted(shares, u))
            ends = _weighted(shares.T, cos), _weighted(shares.T, sin)
            step = _closing(*ends, chord[0] + cos.sum(axis=0), chord[1] + sin.sum(axis=0))
            size = np.abs(step).max(axis=0)
            if not np.isfinite(size).all():
                break
            taken = size < finest  # steps shrink until rounding is reached
            u = u + np.where(taken, step, 0.0)
            found[:, rows] = u
            # the next one would be as much shorter again, squared: s_(k+1) = s_k (s_k/s_(k-1))^2
            going = taken & (size**3 >= _REST * np.minimum(finest, _NEAR) ** 2)
            if not going.any():
                return first[:, None] + slopes[:, None] * phi + _weighted(shares, found)
            if not going.all():
                u, base, rows, size = u[:, going], base[:, going], rows[going], size[going]
                chord = chord[0][going], chord[1][going]
            finest = size
        raise NoSolution("the six-bar does not close there")

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
            self._block_rates(phi[start : start + _BLOCK], angles[:, start : start + _BLOCK], order)
            for start in range(0, max(1, phi.size), _BLOCK)
        ]
        return parts[0] if len(parts) == 1 else tuple(np.hstack(each) for each in zip(*parts, strict=True))

    def _block_rates(self, phi: Reals, angles: Reals, order: int) -> tuple[Reals, ...]:
        if order == 0:
            return ()
        _, _, slopes, shares = self.numbers
        cos, sin = self._projections(angles)
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
        for start in range(0, found.size, _BLOCK):
            part = slice(start, start + _BLOCK)
            x, y = (_weighted(self.numbers[3].T, each) for each in self._projections(angles[:, part]))
            found[part] = np.arctan2(np.abs(x[0] * y[1] - y[0] * x[1]), np.abs(x[0] * x[1] + y[0] * y[1]))
        return found


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
