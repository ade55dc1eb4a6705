"""Quantiles of samples in replications: of all samples together, with the interval that the replications give.

The quantile of each replication alone is biased, above all far out; so the samples are put together, and what the
replications say is which share of each lies below the quantile.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.tolerance.sampling import Estimate, student

_SIGMAS, _SPARE = 6.0, 8  # of the rank of a quantile in one replication
_LEAST_BEYOND = 1.0


@dataclass(frozen=True, slots=True)
class Window:
    """The ordered values of a replication about a share of them.

    first : int - rank of the first of `values`, from 0; count : int - of all values
    """

    first: int
    count: int
    values: Reals

    def share_below(self, value: float) -> float:
        """Share of the replication that is not above a value."""
        return (self.first + int(np.searchsorted(self.values, value, side="right"))) / self.count


@dataclass(frozen=True, slots=True)
class Quantile:
    """A quantile, and by how much each replication would have it higher or lower; (R,) array."""

    value: float
    off: Reals

    @property
    def estimate(self) -> Estimate:
        """With the half-width of its 95 % interval; not a number where too few samples lie beyond."""
        count = len(self.off)
        return Estimate(self.value, student(count) * float(np.std(self.off, ddof=1)) / count**0.5)


def window(ordered: Reals, share: float) -> Window:
    """What a replication keeps for a quantile.

    Parameters
        ordered : (N,) array - its values, ascending
        share : float - of the quantile
    Example
        >>> window(np.arange(10_000.0), 0.5).values.size
        617

    Source
        own choice: six standard deviations of a rank to either side
    """
    count = ordered.size
    middle, reach = int(share * count), math.ceil(_SIGMAS * math.sqrt(count * share * (1.0 - share))) + _SPARE
    first, last = max(0, middle - reach), min(count, middle + reach + 1)
    return Window(first, count, ordered[first:last])


def quantile(windows: Sequence[Window], share: float) -> Quantile:
    """The quantile of all replications together.

    q at the rank N p - 1/2,   q_r = q + (p - F_r(q)) dq/dp

    Parameters
        windows : of the replications, as `window` gives them
        share : float - p
    Notes
        The slope is that between the ends of the interval of F(q), so that far out it follows the samples.
    Example
        >>> rows = [window(np.sort(np.random.default_rng(i).random(4096)), 0.5) for i in range(16)]
        >>> found = quantile(rows, 0.5)
        >>> round(found.value, 2), found.estimate.half_width < 0.005
        (0.5, True)

    Source
        R. R. Bahadur, Ann. Math. Statist. 37 (1966) 577, with the replications of A. B. Owen
    """
    total, before = sum(one.count for one in windows), sum(one.first for one in windows)
    values = np.sort(np.concatenate([one.values for one in windows]))

    def at(below: float) -> float:
        return _interpolated(values, below * total - 0.5 - before)

    value = at(share)
    below = np.array([one.share_below(value) for one in windows])
    if total * min(share, 1.0 - share) < _LEAST_BEYOND:
        return Quantile(value, np.full(len(windows), math.nan))
    half = max(student(len(windows)) * float(below.std(ddof=1)) / len(windows) ** 0.5, 1.0 / total)
    slope = (at(share + half) - at(share - half)) / (2.0 * half)
    off: Reals = (below.mean() - below) * slope
    return Quantile(value, off)


def _interpolated(ordered: Reals, rank: float) -> float:
    """Value at a rank between two, at the ends the last."""
    rank = min(max(rank, 0.0), ordered.size - 1.0)
    low = int(rank)
    if low + 1 >= ordered.size:
        return float(ordered[low])
    return float(ordered[low] + (rank - low) * (ordered[low + 1] - ordered[low]))
