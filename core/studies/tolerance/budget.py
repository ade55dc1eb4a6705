"""A budget of errors: what each source adds to one error over a stretch of the cycle, at worst and at random."""

from __future__ import annotations

import math
from bisect import bisect_left
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.core.base.report import Table
from gearlink.core.numerics.arrays import Reals

_COVERED = 3.0  # 99.73 % of a normal error
_FAR = 40.0  # of the mean in sigmas: the far tail is 0 from some 6 on
_STEPS = 8
_JUST_BELOW = 1.0 - 1e-12  # the sums of tighter tolerances are rounded anew
_FINER = 40
"""Per cent that two IT grades leave of a tolerance, each 1/1.6 of the next."""


@dataclass(frozen=True, slots=True)
class Contribution:
    """A source along the stretch.

    Fields
        gain : (N,) array, real or complex - error per mm of the source; complex for a vector of any direction
        limit : float [mm] - maximum deviation of the source
        sigma : float [mm] - its standard deviation; of a vector that of one component
        mean : float [mm] - by how much all machines differ from nominal, of a real gain
        relative : bool - the error at the start has the same cause as that later on, which an uneven profile's has not
        keeps : bool - its parts lie within `limit`, at least 99.73 % of them
        unit : str - of `limit`, `sigma` and `mean` where that is not mm: "deg" of an angle, whose gain is per degree
    """

    source: str
    gain: NDArray[Any]
    limit: float
    sigma: float
    mean: float = 0.0
    relative: bool = True
    keeps: bool = True
    unit: str = "mm"


@dataclass(frozen=True, slots=True)
class Row:
    """A source where the whole is worst."""

    source: str
    gain: float
    limit: float
    worst: float
    sigma: float
    share: float
    mean: float
    unit: str = "mm"


def budget_table(before: str, rows: Sequence[tuple[float | str, Row]]) -> Table:
    """Sources where the whole is worst, after one column; with units of the limits where some are angles.

    Parameters
        before : str - name of the first column
        rows : its entries, and the sources
    """
    mixed = any(row.unit != "mm" for _, row in rows)
    columns: dict[str, tuple[Any, str]] = {
        before: ([first for first, _ in rows], "1"),
        "source": ([row.source for _, row in rows], "1"),
        "gain": ([row.gain for _, row in rows], "1"),
        "limit": ([row.limit for _, row in rows], "1" if mixed else "mm"),
    }
    if mixed:
        columns["unit"] = [row.unit for _, row in rows], "1"
    for name, unit in (("worst", "mm"), ("sigma", "mm"), ("share", "1"), ("mean", "mm")):
        columns[name] = [getattr(row, name) for _, row in rows], unit
    return Table.of("budget", columns)


@dataclass(frozen=True, slots=True)
class Budget:
    """All sources together.

    worst, rss, mean, band : (N,) arrays [mm] - sum of magnitudes, root of the sum of squares, what all machines have
    alike, and what 99.73 % of them keep by a normal law; most : (N,) array [mm] - what sources within their limits and
    the normal band of the others add up to; at : int - where `band` is largest
    """

    worst: Reals
    rss: Reals
    mean: Reals
    band: Reals
    most: Reals
    at: int
    rows: tuple[Row, ...]

    @property
    def kept(self) -> Reals:
        """What 99.73 % of the machines surely keep: few sources are no normal sum, and end before 3 sigma of it."""
        return np.minimum(self.band, self.most)


def budget(
    contributions: Sequence[Contribution],
    start: int | None,
    correlations: Mapping[tuple[str, str], float] | None = None,
) -> Budget:
    """Add up the sources of an error.

    worst = sum |g - g0| limit,   rss^2 = sum |g - g0|^2 sigma^2 + sum rho_ij (g - g0)_i (g - g0)_j sigma_i sigma_j

    Parameters
        contributions : of one length
        start : int - place that the error is relative to, since what does not change costs nothing; None: absolute
        correlations : by pairs of sources, both ways round - of real gains; a row's share is its covariance with the
            whole, and may be negative
    Notes
        The gain's difference is taken before its magnitude: both ends of a stretch have the same cause. The error of a
        cam's profile has another one at each: there both count, at worst as a sum, at random as a root of squares.
        Few sources are no normal sum: uniform sizes, or a pin that touches its hole, add up to less than 3 sigma of
        them. What they keep is the less of the normal band and of `most`, the worst case where all parts keep their
        limits: |X| <= sum |g - g0| limit of those that do, plus the band of those that do not.
    Example
        >>> frame = Contribution("frame", np.array([1.0, -2.0]), 0.01, 0.003)
        >>> found = budget([frame, Contribution("pin", np.array([1j, 1.0]), 0.02, 0.01)], None)
        >>> found.worst.round(9).tolist(), [round(row.share, 3) for row in found.rows]
        ([0.03, 0.04], [0.265, 0.735])

    Source
        ISO/IEC Guide 98-3, 5.1.2; own derivation of the gains
    """
    gains = [counted(one, start) for one in contributions]
    limits = np.array([one.limit for one in contributions])
    spreads = np.abs(np.array(gains))
    magnitudes = np.array([at_worst(one, start) for one in contributions])
    worst, squares = limits @ magnitudes, _squares(contributions, gains, correlations or {})
    means = np.array([one.mean for one in contributions])[:, None] * np.real(gains)
    mean, rss = means.sum(axis=0), _root(squares)
    most = _most(contributions, limits[:, None] * magnitudes, means, gains, correlations or {})
    band = normal_band(mean, rss)
    at = int(np.argmax(band))
    whole = float(squares[:, at].sum())
    rows = tuple(
        Row(
            one.source,
            float(magnitude[at]),
            one.limit,
            float(magnitude[at] * one.limit),
            float(spread[at] * one.sigma),
            float(square[at]) / whole if whole > 0.0 else 0.0,
            float(mean[at]) + 0.0,  # no -0
            one.unit,
        )
        for one, magnitude, spread, square, mean in zip(contributions, magnitudes, spreads, squares, means, strict=True)
    )
    return Budget(worst, rss, mean, band, most, at, rows)


def _squares(
    contributions: Sequence[Contribution], gains: Sequence[NDArray[Any]], correlations: Mapping[tuple[str, str], float]
) -> Reals:
    """Covariance of each source with the sum of all; (sources, N) array."""
    scatters = [one.sigma * gain for one, gain in zip(contributions, gains, strict=True)]
    squares = np.abs(np.array(scatters)) ** 2
    names = [one.source for one in contributions]
    for (one, other), rho in correlations.items():
        if one in names and other in names:
            i, j = names.index(one), names.index(other)
            squares[i] += rho * np.real(scatters[i] * np.conj(scatters[j]))
    return squares


def _root(squares: Reals) -> Reals:
    found: Reals = np.sqrt(np.maximum(squares.sum(axis=0), 0.0))
    return found


def _most(
    contributions: Sequence[Contribution],
    costs: Reals,
    means: Reals,
    gains: Sequence[NDArray[Any]],
    correlations: Mapping[tuple[str, str], float],
) -> Reals:
    """What sources within their limits add up to at worst, and the normal band of the others."""
    loose = [i for i, one in enumerate(contributions) if not one.keeps]
    if not loose:
        return np.asarray(costs.sum(axis=0))
    squares = _squares([contributions[i] for i in loose], [gains[i] for i in loose], correlations)
    beside = normal_band(means[loose].sum(axis=0), _root(squares))
    return np.asarray(np.delete(costs, loose, axis=0).sum(axis=0) + beside)


def tightened(
    every: Sequence[Sequence[Contribution]],
    start: int | None,
    correlations: Mapping[tuple[str, str], float] | None,
    limit: float,
    *,
    at_worst: bool,
) -> tuple[list[str], float]:
    """The fewest sources, those that help most first, whose tighter tolerances keep a limit, and how tight they are.

    Parameters
        every : contributions as for `budget`, of several budgets that are all to keep it
        limit : float [mm], above 0 - of the worst case or of what most machines keep, which are above it
    Returns
        names, percent : float - of their limits: two IT grades finer at most, unless it takes all sources
    """

    def error(names: Sequence[str], percent: float) -> float:
        share = percent / 100.0
        found = [budget([_scaled(one, share, names) for one in each], start, correlations) for each in every]
        return max(float((one.worst if at_worst else one.kept).max()) for one in found)

    names = list(dict.fromkeys(one.source for each in every for one in each))
    names.sort(key=lambda name: error([name], _FINER))
    for count in range(1, len(names)):
        if error(names[:count], _FINER) <= limit:
            chosen, percents = names[:count], range(_FINER, 100)
            return chosen, percents[bisect_left(percents, True, key=lambda each: error(chosen, each) > limit) - 1]
    return names, _JUST_BELOW * 100.0 * limit / error(names, 100.0)


def _scaled(one: Contribution, share: float, names: Sequence[str]) -> Contribution:
    if one.source not in names:
        return one
    return replace(one, limit=share * one.limit, sigma=share * one.sigma, mean=share * one.mean)


def normal_band(mean: Reals, sigma: Reals) -> Reals:
    """What 99.73 % of normal errors keep, to either side of zero.

    P(|X| <= b) = P(|Z| <= 3),   X normal with mean and sigma, Z standard normal

    Parameters
        mean, sigma : (N,) arrays [mm] - sigma 0 or more
    Returns
        band : (N,) array [mm] - 3 sigma where the mean is 0, |mean| + 2.782 sigma where it is far beyond sigma
    Notes
        Newton steps in b/sigma from the upper of its two bounds; the share of the far tail vanishes from there on.
    Example
        >>> normal_band(np.array([0.0, 0.01, 1.0]), np.array([0.01, 0.01, 0.0])).round(6).tolist()
        [0.03, 0.037823, 1.0]

    Source
        ISO/IEC Guide 98-3, 6.3.3; own derivation of the mean's part
    """
    off = np.abs(mean)
    if not off.any():
        return _COVERED * sigma
    with np.errstate(divide="ignore", invalid="ignore"):
        ratio = np.minimum(off / sigma, _FAR)
    missing = 2.0 * _below(-_COVERED)
    b = ratio + _COVERED
    for _ in range(_STEPS):
        density = np.exp(-0.5 * (b - ratio) ** 2) + np.exp(-0.5 * (b + ratio) ** 2)
        b = b - (missing - _below(ratio - b) - _below(-b - ratio)) * math.sqrt(2.0 * math.pi) / density
    return np.where(sigma > 0.0, off + (b - ratio) * sigma, off)


@np.vectorize(otypes=[float])
def _below(z: float) -> float:
    """Share of a standard normal number below z, from the standard library: to import scipy.special takes longer."""
    return 0.5 * math.erfc(-z / math.sqrt(2.0))


def counted(one: Contribution, start: int | None) -> NDArray[Any]:
    """The gain that counts at random over a stretch, relative to its start.

    g - g0 where the cause is the same at both, else sqrt(g^2 + g0^2)
    """
    if start is None:
        return one.gain
    both: NDArray[Any] = one.gain - one.gain[start] if one.relative else np.hypot(one.gain, one.gain[start])
    return both


def at_worst(one: Contribution, start: int | None) -> Reals:
    """The magnitude that counts at worst over a stretch, relative to its start.

    |g - g0| where the cause is the same at both, else |g| + |g0|
    """
    alike = start is None or one.relative
    found: Reals = np.abs(counted(one, start)) if alike else np.abs(one.gain) + abs(one.gain[start])
    return found
