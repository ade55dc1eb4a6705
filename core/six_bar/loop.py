"""Positions of the geared six-bar A B C D E F and their derivatives over the input angle.

a e^(i phi) + sum l_j e^(i t_j) = d,   t_j = t_j0 + p_j phi + N_j u,   j = 2 to 5,   u in R^2

The trains leave two directions u free (link j leads from pin to pin on the way from A to F); the loop fixes them.
Where the trains tie two directions to the input alone, the other two links close the loop as a dyad, in closed form.
"""

from __future__ import annotations

import cmath
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction

import numpy as np
from numpy.typing import NDArray

from gearlink.core.errors import NoSolution
from gearlink.core.linkages.dyad import close_dyad, require_lengths
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.results import cached_property
from gearlink.core.six_bar.relations import LINKS, Row, reduced

FREE = range(2, LINKS)
NAMES = ("frame", "input", "coupler_1", "coupler_2", "coupler_3", "output")
_ROUNDS = 60


@dataclass(frozen=True)
class SixBar:
    """A loop of six links with two trains.

    Parameters
        lengths : six float [mm] - FA, AB, BC, CD, DE, EF
        relations : two rows of `train_relation`
        start : mapping - directions at input angle 0 of two of the links 2 to 5 [rad], on the way from A to F
        assembly : +1 or -1 - +1: of the other two links the first points to the left of the second at the start
    Raises
        NoSolution - for a length that is not positive and finite, trains that tie the same, a start that does not close
    Example
        Both trains on the input's side: t2 = 2 phi + 60 deg, the output EF turns against the input.

        >>> import math
        >>> from gearlink.core.six_bar.relations import train_relation
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
        """p_j: turns of links 2 to 5 per turn of the input while the free directions rest."""
        rows, pivots = self.tied
        return tuple(-rows[pivots.index(j)][1] if j in pivots else Fraction(0) for j in FREE)

    @cached_property
    def shares(self) -> tuple[tuple[Fraction, ...], ...]:
        """N_j: turns of links 2 to 5 per turn of each free direction."""
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
            raise NoSolution(message) from None
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

    def links(self, angles: Reals) -> Points:
        """Links 2 to 5 as vectors [mm]; angles : (4, N) array [rad]."""
        return np.asarray(self.numbers[0][:, None] * np.exp(1j * angles))

    def columns(self, links: Points) -> tuple[Points, Points]:
        """Velocities of the loop's end by the two free directions [mm/rad]; links : (4, N) array [mm]."""
        one, other = self.numbers[3].T @ (1j * links)
        return one, other

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
        angles: Reals = first[:, None] + slopes[:, None] * phi + shares @ near
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
            angles[row] = close + np.angle(vector * np.exp(-1j * close))
        if not np.isfinite(angles).all():
            raise NoSolution("the six-bar does not close there")
        return angles

    def _by_newton(self, phi: Reals, near: Reals) -> Reals:
        """Newton's steps on the two free directions until they are rounding."""
        _, first, slopes, shares = self.numbers
        u = near.copy()
        base = first[:, None] + slopes[:, None] * phi
        finest = np.full(phi.shape, np.inf)
        crank = self.lengths[1] * np.exp(1j * phi)
        for _ in range(_ROUNDS):
            angles: Reals = base + shares @ u
            links = self.links(angles)
            gap = crank + links.sum(axis=0) - self.lengths[0]
            step = solve_pair(*self.columns(links), -gap)
            size = np.abs(step).max(axis=0)
            going = size < finest  # steps shrink until rounding is reached
            if not np.isfinite(size).all():
                break
            if not going.any():
                return angles
            u = u + np.where(going, step, 0.0)
            finest = np.where(going, size, 0.0)
        raise NoSolution("the six-bar does not close there")

    def rates(self, phi: Reals, angles: Reals) -> tuple[Reals, Reals, Reals]:
        """First three derivatives of the directions of links 2 to 5 by the input angle.

        i sum l_j t_j' e_j = -i a e_1,   i sum l_j t_j'' e_j = sum l_j t_j'^2 e_j + a e_1,
        i sum l_j t_j''' e_j = sum l_j (3 t_j' t_j'' + i t_j'^3) e_j + i a e_1

        Parameters
            phi : (N,) array [rad]
            angles : (4, N) array [rad]
        Returns
            first, second, third : (4, N) arrays [1, 1/rad, 1/rad^2]
        Notes
            The condition is 1/sin of `transmission`, infinite in a dead centre.
        """
        _, _, slopes, shares = self.numbers
        links, crank = self.links(angles), self.lengths[1] * np.exp(1j * phi)
        ends = self.columns(links)
        pushed = -1j * crank - 1j * (slopes[:, None] * links).sum(axis=0)
        first = slopes[:, None] + shares @ solve_pair(*ends, pushed)
        second = shares @ solve_pair(*ends, (first * first * links).sum(axis=0) + crank)
        third = shares @ solve_pair(*ends, ((3.0 * first * second + 1j * first**3) * links).sum(axis=0) + 1j * crank)
        return first, second, third

    def transmission(self, angles: Reals) -> Reals:
        """Angle between the velocities by which the two free directions close the loop, 0 to 90 deg [rad].

        Notes
            In a closed form it is the transmission angle of the dyad. It vanishes in the dead centres alone.
        Source
            VDI 2142 for the dyad; own derivation
        """
        one, other = self.columns(self.links(angles))
        product = np.conj(one) * other
        return np.asarray(np.arctan2(np.abs(product.imag), np.abs(product.real)))


def solve_pair(one: Points, other: Points, right: Points) -> Reals:
    """Real x, y with x one + y other = right; (2, N) array.

    Example
        >>> solve_pair(np.array([1 + 0j]), np.array([1j]), np.array([3 + 4j])).ravel().tolist()
        [3.0, 4.0]
    """
    determinant = (np.conj(one) * other).imag
    with np.errstate(divide="ignore", invalid="ignore"):
        return np.array([(np.conj(right) * other).imag, (np.conj(one) * right).imag]) / determinant


def pins(bar: SixBar, phi: Reals, angles: Reals) -> Points:
    """The pins A to F; (6, N) array [mm]."""
    links = np.vstack([bar.lengths[1] * np.exp(1j * phi), bar.numbers[0][:3, None] * np.exp(1j * angles[:3])])
    walked = np.cumsum(links, axis=0)
    ends = np.zeros((1, phi.size)), np.full((1, phi.size), bar.lengths[0])
    return np.vstack([ends[0], walked, ends[1]]).astype(np.complex128)
