"""Starts of the search for a geared five-bar: scattered about a given one, closing, their coupler points settled."""

from __future__ import annotations

import math

import numpy as np

from gearlink.core.machines.five_bar.family import UNKNOWNS, FiveBarFamily, nearest
from gearlink.core.numerics.arrays import Mask, Points, Reals
from gearlink.core.numerics.quasi_random import halton

# So many starts, fewer where starts times targets times places would pass the work of a round.
_TRIED, _ROUND = 600, 3_000_000
_ROUNDS = 5
# Lengths stay within this of the first's, by their logarithms.
_WIDEST = 2.5
# Scatter of the logarithms of the lengths; the coupler point lies within so many couplers.
_SCATTER, _REACH = 0.7, 1.5
# Starts close with this much to spare [rad], with couplers that differ by one of these shares of what was scattered.
_MARGIN = math.radians(0.5)
_SHARES = (1.0, 0.5, 0.25, 0.0)


def bounds(first: Reals) -> tuple[Reals, Reals]:
    """Minimum and maximum unknowns of a search: lengths from e^-2.5 to e^2.5 times those of the start."""
    reach = np.where(np.arange(UNKNOWNS) < 4, _WIDEST, math.inf)
    return first - reach, first + reach


def scattered_starts(
    family: FiveBarFamily, first: Reals, targets: Points, transmission_angle: float, number: int = 0
) -> Reals:
    """Five-bars that close, at fixed places about a given one (no random numbers), the most promising first.

    Parameters
        family : FiveBarFamily
        first : (7,) array - unknowns of the given one
        targets : (N,) complex array
        transmission_angle : float [rad] - the minimum that is allowed
        number : int - of the round; each has places of its own
    Returns
        x : (K, 7) array - up to 600 rows, by the mean square of the targets' distances from their paths
    Notes
        Couplers that do not reach, or not with this transmission angle, are made as long as the spans need.
    """
    count, begin = min(_TRIED, _ROUND // (targets.size * family.count)), number * _TRIED
    share = np.array([halton(begin + i, UNKNOWNS) for i in range(1, count + 1)])
    x = np.tile(first, (len(share), 1))
    x[:, :4] += _SCATTER * (2.0 * share[:, :4] - 1.0)
    x[:, 4] += 2.0 * math.pi * share[:, 4]
    x, closed = _closing(family, x, first, min(transmission_angle + _MARGIN, 0.5 * math.pi))
    x[:, 5:] = 0.5 * first[5:] + _REACH * np.exp(x[:, 1:2]) * (2.0 * share[:, 5:] - 1.0)
    return _settled(family, x[closed], targets)


def _closing(family: FiveBarFamily, x: Reals, first: Reals, least: float) -> tuple[Reals, Mask]:
    """The same with couplers as long as the spans need, and which rows such couplers exist for."""
    low, high = bounds(first)
    short, long = family.spans(x)
    middle, unlike = 0.5 * (x[:, 1] + x[:, 2]), x[:, 2] - x[:, 1]
    x, closed = x.copy(), np.zeros(len(x), dtype=bool)
    for differ in (share * unlike for share in _SHARES):
        least_b, most_b = _coupler_bounds(differ, short, long, math.cos(least))
        least_b = np.maximum(least_b, np.maximum(low[1], low[2] - differ))
        most_b = np.minimum(most_b, np.minimum(high[1], high[2] - differ))
        new = (least_b < most_b) & ~closed
        coupler = np.clip(middle - 0.5 * differ, least_b, most_b)
        x[new, 1], x[new, 2] = coupler[new], (coupler + differ)[new]
        closed |= new
    return x, closed


def _coupler_bounds(differ: Reals, short: Reals, long: Reals, cosine: float) -> tuple[Reals, Reals]:
    """Bounds of ln b at a given ln(c/b), so that the transmission angle keeps its limit at both spans.

    long^2/(1 + r^2 + 2 r cos) <= b^2 <= short^2/(1 + r^2 - 2 r cos),   r = c/b
    """
    r = np.exp(differ)
    low = np.log(long) - 0.5 * np.log(1.0 + r * r + 2.0 * r * cosine)
    high = np.log(short) - 0.5 * np.log(1.0 + r * r - 2.0 * r * cosine)
    return low, high


def _settled(family: FiveBarFamily, x: Reals, targets: Points) -> Reals:
    """The same with the coupler points that suit the targets best, sorted by the mean square of the distances.

    With the nearest places known, the best u + i v is a mean: the path is linear in it. Both steps take turns.
    """
    start, unit = family.grid_path(x)
    offset = x[:, 5:6] + 1j * x[:, 6:7]
    for _ in range(_ROUNDS):
        places = nearest(start + offset * unit, targets)
        turned, gap = np.take_along_axis(unit, places, axis=1), targets - np.take_along_axis(start, places, axis=1)
        offset = np.mean(np.conj(turned) * gap, axis=1, keepdims=True)
    square = np.mean(np.abs(gap - offset * turned) ** 2, axis=1)
    order = np.argsort(np.where(np.isfinite(square), square, math.inf), kind="stable")
    return np.concatenate((x[:, :5], offset.real, offset.imag), axis=1)[order]
