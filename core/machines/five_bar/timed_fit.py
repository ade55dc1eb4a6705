"""A geared five-bar whose coupler point is at given points at given input angles, by least squares."""

from __future__ import annotations

import math
import time
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.five_bar.family import FiveBarFamily
from gearlink.core.machines.five_bar.fit import Fit, bounds, closes, family_of, row_as_bar, scattered_starts
from gearlink.core.machines.five_bar.function_fit import Round
from gearlink.core.machines.five_bar.path import points
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import Points, Reals
from gearlink.core.numerics.lm import State, damped, descend

_PLACES = 48  # of the first point over the period, for each start
_FOLLOWED, _STEPS, _BEST = 48, 120, 6
_WEIGHT = 10.0
_MARGIN = math.radians(0.05)


@dataclass(frozen=True, slots=True)
class TimedFit:
    """A five-bar with its misses, the input angle of the first point [rad], and how the search came to it."""

    fit: Fit
    first_angle: float
    rounds: tuple[Round, ...]


def fit_timed(
    start: PathFiveBar,
    offset: complex,
    targets: Points,
    angles: Reals,
    transmission_angle: float,
    seconds: float | None = None,
) -> TimedFit:
    """Links, phase, coupler point and start with which the point is nearest to where it shall be at each time.

    sum |M(phi_0 + theta_j) - P_j|^2 -> min over a, b, c, e, delta, u, v, phi_0

    Parameters
        start : PathFiveBar - a start; frame, gear ratio and assembly are kept
        offset : complex [mm] - u + i v to start with
        targets : (N,) complex array [mm] - N >= 3
        angles : (N,) array [rad] - theta_j, input angles from the first point's
        transmission_angle : float [rad] - the minimum that is allowed
        seconds : float or None - budget of time: rounds are begun until it is spent; without one there is one round,
            and the same points give the same fit
    Returns
        fit : TimedFit - the distances are those from the points at their own times
    Raises
        NoSolution - for points that are all the same, or where no start closes
    Notes
        Each round: up to 600 scattered starts that close, the 48 whose paths come nearest tried at 48 places of the
        first point, 120 steps of Levenberg and Marquardt; the transmission angle is a penalty.
    """
    scale = float(np.max(np.abs(targets[:, None] - targets[None, :])))
    if not scale > 0.0:
        raise NoSolution("all points are the same: a path needs at least two different ones")
    begun, best, rounds, tried = time.monotonic(), None, [], 0
    for number in range(1 if seconds is None else 1_000_000):
        with np.errstate(all="ignore"):  # rows that open are NaN and drop out
            count, rows = _searched(start, offset / scale, targets / scale, angles, transmission_angle, scale, number)
        tried += count
        for found in _judged(start, rows, targets, angles, transmission_angle, scale):
            best = found if best is None or found.fit.rms < best.fit.rms else best
        rounds.append(Round(tried, math.nan if best is None else best.fit.rms))
        if seconds is not None and time.monotonic() - begun >= seconds:
            break
    if best is None:
        raise NoSolution(
            ("none of the starts closes over a whole revolution with the required transmission angle"),
            fix=("start from links that do (longer coupler and follower), or lower limits.transmission_angle"),
        )
    return TimedFit(best.fit, best.first_angle, tuple(rounds))


def _judged(
    start: PathFiveBar, rows: Reals, targets: Points, angles: Reals, least: float, scale: float
) -> Iterator[TimedFit]:
    """The best rows that close, measured on their own motion."""
    for row in rows[np.all(np.isfinite(rows), axis=1)][:_BEST]:
        bar, offset = row_as_bar(start, row[:7], scale)
        if closes(bar, least):
            distance = np.abs(points(bar, row[7] + angles, offset) - targets)
            yield TimedFit(Fit(bar, offset, distance), float(row[7]) % bar.period, ())


def _searched(
    start: PathFiveBar, offset: complex, targets: Points, angles: Reals, least: float, scale: float, number: int
) -> tuple[int, Reals]:
    """Number of starts, and rows of the seven unknowns and phi_0 at the ends of the search, the best first."""
    family = family_of(start, scale)
    lengths = np.log((start.input, start.coupler, start.follower, start.output)) - math.log(scale)
    first = np.array([*lengths, start.phase, offset.real, offset.imag])
    x = scattered_starts(family, first, targets, least, number)
    count = len(x) + (number == 0)
    x = np.concatenate((first[None, :], x[:_FOLLOWED])) if number == 0 else x[:_FOLLOWED]
    if not len(x):
        return count, np.empty((0, 8))
    z = _placed(family, x, targets, angles)
    low, high = bounds(first)
    return count, _descended(family, z, targets, angles, math.cos(least + _MARGIN), (low, high))


def _placed(family: FiveBarFamily, x: Reals, targets: Points, angles: Reals) -> Reals:
    """Each row with the place of the first point, and the coupler point, that suit the points best."""
    best, square = np.concatenate((x, np.zeros((len(x), 1))), axis=1), np.full(len(x), np.inf)
    for first in family.period * np.arange(_PLACES) / _PLACES:
        phi = np.broadcast_to(first + angles, (len(x), angles.size))
        at = family.path_slopes(x, phi)
        unit = at.slopes[..., 5]
        base = at.point - (x[:, 5:6] + 1j * x[:, 6:7]) * unit
        offset = np.mean(np.conj(unit) * (targets - base), axis=1, keepdims=True)
        miss = np.mean(np.abs(base + offset * unit - targets) ** 2, axis=1)
        nearer = miss < square
        square[nearer] = miss[nearer]
        best[nearer, 5], best[nearer, 6], best[nearer, 7] = offset[nearer, 0].real, offset[nearer, 0].imag, first
    return best


def _descended(
    family: FiveBarFamily, z: Reals, targets: Points, angles: Reals, cosine: float, limits: tuple[Reals, Reals]
) -> Reals:
    """Rows after Levenberg's and Marquardt's steps, the best first."""

    def step(z: Reals, state: State, damping: Reals) -> Reals:
        _, value, slopes = state
        moved = damped(np.nan_to_num(slopes), np.nan_to_num(value), damping)
        new = z + np.clip(moved, -0.4, 0.4)
        new[:, :7] = np.clip(new[:, :7], *limits)
        return new

    z, (cost, *_), _, _ = descend(lambda z: _state(family, z, targets, angles, cosine), step, z, _STEPS)
    return np.asarray(z[np.argsort(cost, kind="stable")])


def _state(family: FiveBarFamily, z: Reals, targets: Points, angles: Reals, cosine: float) -> State:
    """Squares, misses and excess of the cosine with their derivatives for every row; infinite where it opens."""
    x = z[:, :7]
    at = family.path_slopes(x, z[:, 7:8] + angles)
    miss = at.point - targets
    slopes = np.concatenate((at.slopes, at.velocity[..., None]), axis=2)
    limit, limit_slopes = family.cosines(x)
    excess = _WEIGHT * np.maximum(0.0, limit - cosine)
    over = np.where((excess > 0.0)[..., None], _WEIGHT * limit_slopes, 0.0)
    over = np.concatenate((over, np.zeros((*over.shape[:2], 1))), axis=2)
    value = np.concatenate((miss.real, miss.imag, excess), axis=1)
    cost = np.sum(value**2, axis=1)
    return np.where(np.isfinite(cost), cost, np.inf), value, np.concatenate((slopes.real, slopes.imag, over), axis=1)
