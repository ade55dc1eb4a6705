"""A geared five-bar whose coupler point runs through given points, by least squares."""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.core.arrays import Points
from gearlink.core.errors import NoSolution
from gearlink.core.five_bar import GearedFiveBar
from gearlink.core.five_bar_path import distances, points
from gearlink.core.halton import halton

_TRIED = 600
_KEPT = 12
_SCATTER = 0.7
_SETTLING = 8
_POLISHINGS = 8
# A penalty gives way a little; the search aims this much higher than the limit [rad].
_MARGIN = math.radians(0.5)


@dataclass(frozen=True, slots=True)
class Fit:
    """A five-bar, its coupler point u + i v [mm], and the distance of each point from its path [mm]."""

    bar: GearedFiveBar
    offset: complex
    distance: NDArray[np.float64]

    @property
    def rms(self) -> float:
        """Root of the mean square of the distances [mm]."""
        return float(np.sqrt(np.mean(self.distance**2)))


def judge(bar: GearedFiveBar, offset: complex, targets: Points) -> Fit:
    """A five-bar with the distances of the points from its real path.

    Raises
        NoSolution - where the five-bar opens
    Source
        own derivation
    """
    return Fit(bar, offset, distances(bar, offset, targets)[0])


def fit_path(start: GearedFiveBar, offset: complex, targets: Points, transmission_angle: float) -> Fit:
    """Links, phase and coupler point with which the path comes nearest to given points.

    sum |M(phi_j) - P_j|^2 -> min over a, b, c, e, delta, u, v and every phi_j

    Parameters
        start : GearedFiveBar - a start; frame, gear ratio and assembly are kept
        offset : complex [mm] - u + i v to start with
        targets : (N,) complex array [mm] - in the frame of the five-bar, any order, N >= 3
        transmission_angle : float [rad] - the least that is allowed, between coupler and follower
    Returns
        fit : Fit - the distances are those from the path of the five-bar that is given, over its whole period
    Raises
        NoSolution - for fewer than three points, or where no start closes
    Notes
        The 12 best of 600 fixed scattered starts (no random numbers) are refined; the given one is always among them.
        Closing and transmission angle enter as penalties of the search; the result is judged by its real path alone.
    Source
        thesis 2.2.1, figure 2-1; own derivation
    """
    if targets.size < 3:
        raise NoSolution(f"{targets.size} points: give at least three for a path")
    scale = float(np.max(np.abs(targets[:, None] - targets[None, :])))
    if not scale > 0.0:
        raise NoSolution("all points are the same: a path needs at least two different ones")
    ranked = _ranked_starts(start, offset, targets, transmission_angle)
    fits = [fit for bar, m in ranked for fit in _refined(bar, m, targets, transmission_angle, scale)]
    fits += [judge(bar, m, targets) for bar, m in ranked]
    if not fits:
        raise NoSolution(
            "none of the starts closes over a whole turn with the transmission angle that is asked for: start from "
            "links that do (longer coupler and follower), or lower limits.transmission_angle"
        )
    return _polished(min(fits, key=lambda fit: fit.rms), targets, transmission_angle, scale)


def _polished(fit: Fit, targets: Points, least: float, scale: float) -> Fit:
    """The best fit refined again, with its points matched anew, as long as that brings it nearer."""
    for _ in range(_POLISHINGS):
        better = next(_refined(fit.bar, fit.offset, targets, least, scale), fit)
        if not better.rms < 0.999 * fit.rms:
            break
        fit = better
    return fit


def _starts(start: GearedFiveBar, offset: complex) -> Iterator[tuple[GearedFiveBar, complex]]:
    """The given start, and others about it at fixed scattered places."""
    yield start, offset
    names = ("input", "coupler", "follower", "output")
    for i in range(1, _TRIED + 1):
        *shares, turn, along, across = halton(i, 7)
        lengths = {
            name: getattr(start, name) * math.exp(_SCATTER * (2.0 * share - 1.0))
            for name, share in zip(names, shares, strict=True)
        }
        reach = 1.5 * lengths["coupler"]
        moved = complex(reach * (2.0 * along - 1.0), reach * (2.0 * across - 1.0)) + 0.5 * offset
        yield replace(start, **lengths, phase=start.phase + 2.0 * math.pi * turn), moved


def _ranked_starts(
    start: GearedFiveBar, offset: complex, targets: Points, least: float
) -> list[tuple[GearedFiveBar, complex]]:
    """The starts that close, nearest to the points first, the given one before all."""
    scored: list[tuple[float, int, GearedFiveBar, complex]] = []
    for i, (bar, m) in enumerate(_starts(start, offset)):
        if not _closes(bar, least if i else 0.0):
            continue
        settled, square = _settled(bar, m, targets)
        scored.append((square if i else -1.0, i, bar, settled if i else m))
    scored.sort(key=lambda entry: entry[:2])
    return [(bar, m) for _, _, bar, m in scored[:_KEPT]]


def _settled(bar: GearedFiveBar, offset: complex, targets: Points) -> tuple[complex, float]:
    """The coupler point that suits the points best, and the mean square of the distances from its path.

    With the nearest places known, the best u + i v is a mean: the path is linear in it. Both steps take turns.
    """
    count = 120 * bar.period_turns
    phi = bar.period * np.arange(count) / count
    start, unit = points(bar, phi, 0j), points(bar, phi, 1.0 + 0j) - points(bar, phi, 0j)
    square = math.inf
    for _ in range(_SETTLING):
        away = np.abs((start + offset * unit)[None, :] - targets[:, None])
        nearest = np.argmin(away, axis=1)
        square = float(np.mean(np.min(away, axis=1) ** 2))
        offset = complex(np.mean(np.conj(unit[nearest]) * (targets - start[nearest])))
    return offset, square


def _closes(bar: GearedFiveBar, least: float) -> bool:
    try:
        return bar.min_transmission_angle()[0] >= least
    except NoSolution:
        return False


def _refined(bar: GearedFiveBar, offset: complex, targets: Points, least: float, scale: float) -> Iterator[Fit]:
    """The start after least squares, if it still closes with the transmission angle, sought a little higher if not."""
    for margin in (0.0, _MARGIN):
        changed, m = _least_squares(bar, offset, targets, least + margin, scale)
        if _closes(changed, least):
            yield judge(replace(changed, phase=math.remainder(changed.phase, 2.0 * math.pi)), m, targets)
            return


def _least_squares(
    bar: GearedFiveBar, offset: complex, targets: Points, least: float, scale: float
) -> tuple[GearedFiveBar, complex]:
    """The five-bar and coupler point at the minimum next to the start; it may open."""
    from scipy.optimize import least_squares

    _, phi = distances(bar, offset, targets)
    lengths = [math.log(x) for x in (bar.input, bar.coupler, bar.follower, bar.output)]
    x = np.array([*lengths, bar.phase, offset.real / scale, offset.imag / scale, *phi])

    def made(x: Any) -> tuple[GearedFiveBar, complex]:
        a, b, c, e = (float(v) for v in np.exp(x[:4]))
        changed = replace(bar, input=a, coupler=b, follower=c, output=e, phase=float(x[4]))
        return changed, scale * complex(x[5], x[6])

    def miss(x: Any) -> Any:
        changed, m = made(x)
        away = (points(changed, x[7:], m) - targets) / scale
        away = np.where(np.isfinite(away), away, 1.0 + 0j)  # open there: the penalties lead back
        return np.concatenate((away.real, away.imag, _penalties(changed, least)))

    free = [math.inf] * (3 + phi.size)
    bounds = [*(v - 2.5 for v in lengths), *(-v for v in free)], [*(v + 2.5 for v in lengths), *free]
    found = least_squares(miss, x, bounds=bounds, xtol=1e-12, ftol=1e-12, gtol=1e-12, max_nfev=150)
    return made(found.x)


def _penalties(bar: GearedFiveBar, least: float) -> NDArray[np.float64]:
    """How far the cosine of the transmission angle passes its limit at the nearest and the farthest |BD|."""
    phi = bar.period * np.arange(90 * bar.period_turns) / (90 * bar.period_turns)
    square = np.full(phi.size, bar.span_squared.constant)
    for amplitude, frequency, start in bar.span_squared.terms:
        square += amplitude * np.cos(frequency * phi + start)
    b, c = bar.coupler, bar.follower
    cosine = (b * b + c * c - np.array([square.min(), square.max()])) / (2.0 * b * c)
    limit = math.cos(least)
    return 3.0 * np.maximum(0.0, np.array([cosine[0], -cosine[1]]) - limit)
