"""Path of the coupler point of a geared five-bar over arrays of input angles, and its distance from given points."""

from __future__ import annotations

import math

import numpy as np

from gearlink.core.machines.five_bar.family import near_places
from gearlink.core.machines.five_bar.path_motion import PathFiveBar
from gearlink.core.numerics.arrays import Points, Reals, product, unit_vector
from gearlink.core.numerics.extremes import Extreme, extremes_over
from gearlink.core.numerics.together import kept_last

_PER_TURN, _FEW_TURNS, _PER_WAVE = 720, 4, 48
# So many branches of a path that crosses itself are tried for each point.
_BRANCHES = 3
# Distances that are held at a time.
_AT_ONCE = 1_000_000


def rates(bar: PathFiveBar, phi: Reals, offset: complex) -> tuple[Points, Points]:
    """Velocity [mm/rad] and acceleration [mm/rad^2] of the coupler point; closure is not checked."""
    return _rates(bar, *_position(bar, phi), offset)


def points(bar: PathFiveBar, phi: Reals, offset: complex) -> Points:
    """The coupler point alone [mm]; closure is not checked (NaN where the five-bar opens)."""
    start, _, u2, _ = _position(bar, phi)
    return np.asarray(start + offset * u2)


def _position(bar: PathFiveBar, phi: Reals) -> tuple[Points, Points, Points, Points]:
    """B, D, unit vectors of coupler (B->C) and follower (D->C)."""
    b, c = bar.coupler, bar.follower
    start = bar.input * unit_vector(phi)
    end = bar.frame + bar.output * unit_vector(bar.phase + float(bar.ratio) * phi)
    way = end - start
    n = np.abs(way)
    with np.errstate(invalid="ignore", divide="ignore"):
        near, far = (n - b + c) * (n + b - c), (b + c - n) * (b + c + n)
        height = 0.5 * np.sqrt(near * far) / n
        along = 0.5 * (n + (b - c) * (b + c) / n)
        joint = start + way / n * (along + 1j * bar.assembly * height)
    return start, end, (joint - start) / b, (joint - end) / c


def _rates(
    bar: PathFiveBar, start: Points, end: Points, u2: Points, u3: Points, offset: complex
) -> tuple[Points, Points]:
    """Velocity and acceleration of the coupler point, of what `_position` gives."""
    k, b, c = float(bar.ratio), bar.coupler, bar.follower
    sine, apart = product(u2, np.conj(u3)).imag, 1j * (start - k * (end - bar.frame))
    w2, w3 = (product(apart, np.conj(u)).real / (length * sine) for u, length in ((u3, b), (u2, c)))
    pull = -start + k * k * (end - bar.frame) - w2 * w2 * b * u2 + w3 * w3 * c * u3
    a2 = product(pull, np.conj(u3)).real / (b * sine)
    return 1j * start + 1j * w2 * offset * u2, -start + (1j * a2 - w2 * w2) * offset * u2


def coupler_angles(bar: PathFiveBar, phi: Reals) -> Reals:
    """Coupler angle over ascending input angles [rad] without jumps, however near the dead centres it comes.

    The coupler stands within half a revolution of BD, always on the same side: it winds as BD does.
    """
    start, end, u2, _ = _position(bar, phi)
    angle, way = np.angle(u2), end - start
    wound = np.concatenate(([0.0], np.cumsum(_windings(bar, phi[:-1], phi[1:]))))
    turned = np.angle(way[:1]) + wound + np.angle(product(u2, np.conj(way)))
    turns = np.round((turned - angle) / (2.0 * math.pi))
    return np.asarray(angle + 2.0 * math.pi * (turns - turns[:1]))


def _windings(bar: PathFiveBar, left: Reals, right: Reals) -> Reals:
    """Angles by which BD turns between pairs of input angles.

    |D' - B'| <= a + |k| e: while BD moves by less than its length it turns by less than a right angle. Elsewhere the
    step is halved.
    """
    fastest = bar.input + abs(float(bar.ratio)) * bar.output
    first, last = _way(bar, left), _way(bar, right)
    middle = 0.5 * (left + right)
    split = (fastest * (right - left) >= np.abs(first)) & (left < middle) & (middle < right)
    turned = np.angle(product(last, np.conj(first)))
    if np.any(split):
        low, middle, high = left[split], middle[split], right[split]
        halves = _windings(bar, np.concatenate((low, middle)), np.concatenate((middle, high)))
        turned[split] = halves[: low.size] + halves[low.size :]
    return np.asarray(turned)


def _way(bar: PathFiveBar, phi: Reals) -> Points:
    """The vector BD."""
    end = bar.frame + bar.output * unit_vector(bar.phase + float(bar.ratio) * phi)
    return end - bar.input * unit_vector(phi)


def spread(bar: PathFiveBar, offset: complex) -> tuple[Extreme, Extreme, Extreme, Extreme]:
    """Minimum and maximum x, minimum and maximum y of the path, refined, with their input angles.

    Parameters
        bar : PathFiveBar - it closes; of one whose numbers are columns the extremes of each are found
        offset : complex [mm] - u + i v
    """
    place = kept_last(lambda phi: points(bar, phi, offset))
    x, y = (lambda phi: place(phi).real), (lambda phi: place(phi).imag)
    left, right, low, high = extremes_over(
        [(x, False), (x, True), (y, False), (y, True)], 0.0, bar.period, samples=_places(bar)
    )
    return left, right, low, high


def distances(bar: PathFiveBar, offset: complex, targets: Points) -> tuple[Reals, Reals]:
    """Distance of each point from the path, and the input angle of the path's nearest place.

    Parameters
        offset : complex [mm] - u + i v
        targets : (N,) complex array [mm]
    Returns
        distance, phi : (N,) arrays [mm], [rad] in [0, period)
    Raises
        NoSolution - where the five-bar opens
    Notes
        The three nearest branches of the path on a grid of 720 places a turn (48 a wave of the fastest part after four
        turns), then golden section between the neighbours of each: the distance to rounding.
    """
    bar.closure()
    step, middle = _near(bar, offset, targets)
    low, high, aims = middle - step, middle + step, targets[:, None]
    share = (math.sqrt(5.0) - 1.0) / 2.0
    for _ in range(60):
        p, q = high - share * (high - low), low + share * (high - low)
        closer = np.abs(points(bar, p, offset) - aims) <= np.abs(points(bar, q, offset) - aims)
        low, high = np.where(closer, low, p), np.where(closer, q, high)
    phi = 0.5 * (low + high)
    away = np.abs(points(bar, phi, offset) - aims)
    rows, best = np.arange(targets.size), np.argmin(away, axis=1)
    return away[rows, best], phi[rows, best] % bar.period


def _near(bar: PathFiveBar, offset: complex, targets: Points) -> tuple[float, Reals]:
    """Step of a grid over the period, and its input angles (N, 3) at which the path passes the points nearest."""
    count = _places(bar)
    step, at_once = bar.period / count, max(1, _AT_ONCE // count)
    grid = np.asarray(step * np.arange(count), dtype=np.float64)
    start, end, u2, u3 = _position(bar, grid)
    path, (velocity, _) = start + offset * u2, _rates(bar, start, end, u2, u3, offset)
    blocks = [targets[i : i + at_once] for i in range(0, targets.size, at_once)]
    places = [near_places(path[None, :], velocity[None, :], step, block, _BRANCHES)[0] for block in blocks]
    return step, grid[np.concatenate(places)]


def _places(bar: PathFiveBar) -> int:
    """Places of a grid over the period on which no branch of the path is missed."""
    k = float(bar.ratio)
    waves = bar.period_turns * max(1.0, abs(k), abs(1.0 - k))
    return max(_PER_TURN * min(bar.period_turns, _FEW_TURNS), math.ceil(_PER_WAVE * waves))
