"""Many geared five-bars of one frame, gear ratio and assembly at once, with the derivatives that a search needs.

Rows of unknowns: x = (ln a, ln b, ln c, ln e, delta, u, v), lengths in any one unit. Where a five-bar opens all is NaN.
"""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TypeAlias

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.results import cached_property
from gearlink.core.numerics.arrays import Mask, Points, Reals

Places: TypeAlias = NDArray[np.intp]

UNKNOWNS = 7
# A span over a long period has many humps; so many of the highest and of the lowest are watched, and as many steps
# of Newton take each from the grid to its top.
_HUMPS = 4
_NEWTON = 3
# Stands for a place of the path that does not exist: farther than any that does.
_FAR = 1e6


@dataclass(frozen=True, slots=True)
class PathSlopes:
    """Coupler points M (K, N), dM/dphi (K, N) and dM/dx (K, N, 7)."""

    point: Points
    velocity: Points
    slopes: Points


@dataclass(frozen=True)
class FiveBarFamily:
    """What the five-bars of a search share.

    Parameters
        frame, ratio, assembly : float, float, +1 or -1 - d, k, side of C, as of `GearedFiveBar`
        period : float [rad] - input angle after which everything repeats
        count, span_count : int - grid places over the period for the path and for the span |BD|
    """

    frame: float
    ratio: float
    assembly: int
    period: float
    count: int
    span_count: int

    @property
    def waves(self) -> float:
        """Waves of the fastest part of the span over the period."""
        return self.period / (2.0 * math.pi) * max(1.0, abs(self.ratio), abs(1.0 - self.ratio))

    @property
    def step(self) -> float:
        """Input angle between grid places of the path [rad]."""
        return self.period / self.count

    @cached_property
    def grid(self) -> Reals:
        """Input angles of the grid of the path [rad]."""
        return np.asarray(self.step * np.arange(self.count))

    @cached_property
    def _turns(self) -> tuple[Points, Points]:
        return self._turned(self.grid)

    @cached_property
    def _span_grid(self) -> Reals:
        return np.asarray(self.period / self.span_count * np.arange(self.span_count))

    @cached_property
    def _span_turns(self) -> tuple[Points, Points]:
        return self._turned(self._span_grid)

    def _turned(self, phi: Reals) -> tuple[Points, Points]:
        """Directions of the input link and, without its phase, of the output link."""
        return np.exp(1j * phi), np.exp(1j * self.ratio * phi)

    def _pins(self, x: Reals, turns: tuple[Points, Points]) -> tuple[Points, Points]:
        """Input link AB and output link ED as vectors."""
        turn, spin = turns
        return np.exp(x[:, 0:1]) * turn, np.exp(x[:, 3:4] + 1j * x[:, 4:5]) * spin

    def _couplers(self, x: Reals, input: Points, output: Points) -> tuple[Points, Points]:
        """Unit vectors of coupler (B->C) and follower (D->C)."""
        b, c = np.exp(x[:, 1:2]), np.exp(x[:, 2:3])
        way = self.frame + output - input
        square = _square(way)
        n = np.sqrt(square)
        rise = np.sqrt((n - b + c) * (n + b - c) * (b + c - n) * (b + c + n))
        joint = 0.5 * way * (square + (b - c) * (b + c) + 1j * self.assembly * rise) / square
        return joint / b, (joint - way) / c

    def grid_path(self, x: Reals) -> tuple[Points, Points]:
        """B and the unit vector u2 of the coupler at the grid's places: M = B + (u + i v) u2.

        Returns
            start, unit : (K, count) complex arrays
        """
        start, output = self._pins(x, self._turns)
        return start, self._couplers(x, start, output)[0]

    def path(self, x: Reals, phi: Reals) -> tuple[Points, Points]:
        """Coupler points and their velocities at (K, N) input angles.

        w2 = Im[(k E - B) e^(-i t3)]/(b sin(t2 - t3)),   M = B + m e^(i t2),   M' = i B + i w2 m e^(i t2)
        """
        start, output = self._pins(x, self._turned(phi))
        unit, follower = self._couplers(x, start, output)
        arm = _offset(x) * unit
        across = ((self.ratio * output - start) * np.conj(follower)).imag
        w2 = across / (np.exp(x[:, 1:2]) * (unit * np.conj(follower)).imag)
        return start + arm, 1j * (start + w2 * arm)

    def path_slopes(self, x: Reals, phi: Reals) -> PathSlopes:
        """Coupler points with their derivatives by input angle and by the seven unknowns, in closed form.

        b sin(t2 - t3) dt2 = Re[(dB - dD) e^(-i t3)] + cos(t2 - t3) db - dc,   dM = dB + dm e^(i t2) + i m e^(i t2) dt2

        Source
            own derivation: the loop B + b e^(i t2) = D + c e^(i t3), differentiated and seen along the follower
        """
        start, output = self._pins(x, self._turned(phi))
        unit, follower = self._couplers(x, start, output)
        arm, away = _offset(x) * unit, np.conj(follower)
        b, c = np.exp(x[:, 1:2]), np.exp(x[:, 2:3])
        lever = 1j * arm / (b * (unit * away).imag)
        first, last = start * away, output * away
        slopes = np.empty((*phi.shape, UNKNOWNS), dtype=np.complex128)
        slopes[..., 0] = start + lever * first.real
        slopes[..., 1] = lever * (b * (unit * away).real)
        slopes[..., 2] = -lever * c
        slopes[..., 3] = -lever * last.real
        slopes[..., 4] = lever * last.imag
        slopes[..., 5] = unit
        slopes[..., 6] = 1j * unit
        velocity = 1j * start + lever * (self.ratio * last.imag - first.imag)
        return PathSlopes(start + arm, velocity, slopes)

    def cosines(self, x: Reals) -> tuple[Reals, Reals]:
        """|cos| of the transmission angle at the shortest and the longest spans |BD|, and its derivatives.

        cos(gamma) = (b^2 + c^2 - n^2)/(2 b c)  at the lowest n,   its negative at the highest

        Returns
            cosine : (K, 8) array - four for the lowest spans, four for the highest; -1 where there are fewer
            slopes : (K, 8, 7) array - by the unknowns
        Notes
            Above 1 the five-bar opens. The place of an extreme moves too, but that does not count to first order.
        """
        start, output, there = self._extreme_pins(x)
        way = self.frame + output - start
        bc, quotient = np.exp(x[:, 1:2] + x[:, 2:3]), np.exp(x[:, 1:2] - x[:, 2:3])
        share, unlike = _square(way) / bc, quotient - 1.0 / quotient
        cosine = 0.5 * (quotient + 1.0 / quotient - share)
        slopes = np.zeros((*cosine.shape, UNKNOWNS))
        slopes[..., 0] = (np.conj(way) * start).real / bc
        slopes[..., 1] = 0.5 * (share + unlike)
        slopes[..., 2] = 0.5 * (share - unlike)
        slopes[..., 3] = -(np.conj(way) * output).real / bc
        slopes[..., 4] = (np.conj(way) * output).imag / bc
        sign = np.repeat((1.0, -1.0), _HUMPS)
        return np.where(there, sign * cosine, -1.0), np.where(there[..., None], sign[:, None] * slopes, 0.0)

    def _extreme_pins(self, x: Reals) -> tuple[Points, Points, Mask]:
        """AB and ED where |BD| is minimum and maximum, from the grid's humps by Newton's steps; which of them exist."""
        square = self._square(x, self._span_turns)
        (low, some), (high, others) = _humps(-square, _HUMPS), _humps(square, _HUMPS)
        phi = self._span_grid[np.concatenate((low, high), axis=1)]
        reach = self.period / self.span_count
        for _ in range(_NEWTON):
            start, output = self._pins(x, self._turned(phi))
            back, speed = np.conj(self.frame + output - start), 1j * (self.ratio * output - start)
            bend = _square(speed) + (back * (start - self.ratio**2 * output)).real
            step = -(back * speed).real / bend
            phi = phi + np.clip(np.where(np.isfinite(step), step, 0.0), -reach, reach)
        return *self._pins(x, self._turned(phi)), np.concatenate((some, others), axis=1)

    def _square(self, x: Reals, turns: tuple[Points, Points]) -> Reals:
        """|BD|^2."""
        start, output = self._pins(x, turns)
        return _square(self.frame + output - start)

    def spans(self, x: Reals) -> tuple[Reals, Reals]:
        """Minimum and maximum |BD| at the grid's places, one each for every row; coupler and follower do not count."""
        square = self._square(x, self._turns)
        return np.sqrt(square.min(axis=1)), np.sqrt(square.max(axis=1))


def _square(vector: Points) -> Reals:
    return np.asarray(vector.real**2 + vector.imag**2)


def _offset(x: Reals) -> Points:
    return np.asarray(x[:, 5:6] + 1j * x[:, 6:7])


def _humps(value: Reals, most: int) -> tuple[Places, Mask]:
    """The maximum local maxima along a last axis that closes upon itself, and which of those given are such."""
    closed = np.concatenate((value[..., -1:], value, value[..., :1]), axis=-1)
    top = (value >= closed[..., :-2]) & (value > closed[..., 2:])
    score = np.where(top, value, -np.inf)
    found = np.argpartition(-score, most - 1, axis=-1)[..., :most]
    return found, np.isfinite(np.take_along_axis(score, found, axis=-1))


def _projected(path: Points, direction: Points, targets: Points) -> Reals:
    """(P - M/2).direction of every target and place, (K, N, G): a product of matrices."""
    rows = np.stack((direction.real, direction.imag, -0.5 * (np.conj(direction) * path).real), axis=1)
    columns = np.stack((targets.real, targets.imag, np.ones(targets.shape)), axis=1)
    return np.asarray(columns @ rows)


def nearest(path: Points, targets: Points) -> Places:
    """Index of the place of each path that is nearest to each target.

    |M - P|^2 = |P|^2 - 2 M.(P - M/2)

    Parameters
        path : (K, G) complex array - NaN where there is none
        targets : (N,) complex array
    Returns
        places : (K, N) array
    """
    middle = np.mean(targets)
    known = np.where(np.isfinite(path), path - middle, _FAR)
    return np.asarray(np.argmax(_projected(known, known, targets - middle), axis=2))


def near_places(path: Points, velocity: Points, step: float, targets: Points, most: int) -> Places:
    """Places at which a path passes each target nearest, on different branches; the nearest branch is among them.

    Parameters
        path, velocity : (K, G) complex arrays - closed; NaN where there is none
        step : float - between the places, in the unit of time of the velocity
        targets : (N,) complex array
        most : int - places for each target
    Returns
        places : (K, N, most) array
    Notes
        A place counts by the distance from the stretch of tangent that belongs to it: where a path crosses itself, or
        is dense, the nearest place need not lie on the nearest branch.
    """
    known = np.isfinite(path) & np.isfinite(velocity)
    middle, size = np.mean(targets), max(np.max(np.abs(targets)), np.max(np.abs(path), where=known, initial=0.0))
    path, targets = np.where(known, (path - middle) / size, _FAR), (targets - middle) / size
    velocity = velocity / size
    speed = np.where(known, np.abs(velocity), 0.0)
    tangent = np.where(speed > 0.0, velocity / np.where(speed > 0.0, speed, 1.0), 0.0)
    along = _projected(2.0 * path, tangent, targets)
    beyond = np.maximum(np.abs(along) - 0.5 * step * speed[:, None, :], 0.0)
    return _humps(2.0 * _projected(path, path, targets) + along**2 - beyond**2, most)[0]
