"""A budget of errors: what each source adds to one error over a stretch of the cycle, at worst and at random."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from gearlink.core.numerics.arrays import Reals


@dataclass(frozen=True, slots=True)
class Contribution:
    """A source along the stretch.

    Fields
        source : str
        gain : (N,) array, real or complex - error per mm of the source; complex for a vector of any direction
        limit : float [mm] - greatest deviation of the source
        sigma : float [mm] - its standard deviation; of a vector that of one component
        relative : bool - the error at the start has the same cause as that later on, which an uneven profile's has not
    """

    source: str
    gain: NDArray[Any]
    limit: float
    sigma: float
    relative: bool = True


@dataclass(frozen=True, slots=True)
class Row:
    """A source where the whole is worst."""

    source: str
    gain: float
    limit: float
    worst: float
    sigma: float
    share: float


@dataclass(frozen=True, slots=True)
class Budget:
    """All sources together.

    worst, rss : (N,) arrays [mm] - sum of magnitudes, root of the sum of squares; at : int - where `rss` is greatest
    """

    worst: Reals
    rss: Reals
    at: int
    rows: tuple[Row, ...]


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
        The gain's difference is taken before its magnitude: both ends of a stretch have the same cause.
    Example
        >>> frame = Contribution("frame", np.array([1.0, -2.0]), 0.01, 0.003)
        >>> found = budget([frame, Contribution("pin", np.array([1j, 1.0]), 0.02, 0.01)], None)
        >>> found.worst.round(9).tolist(), [round(row.share, 3) for row in found.rows]
        ([0.03, 0.04], [0.265, 0.735])

    Source
        ISO/IEC Guide 98-3, 5.1.2; own derivation of the gains
    """
    counted = [_counted(one, start) for one in contributions]
    limits = np.array([one.limit for one in contributions])
    sigmas = np.array([one.sigma for one in contributions])
    magnitudes = np.abs(np.array(counted))
    worst, squares = limits @ magnitudes, (sigmas[:, None] * magnitudes) ** 2
    names = [one.source for one in contributions]
    for (one, other), rho in (correlations or {}).items():
        if one in names and other in names:
            i, j = names.index(one), names.index(other)
            squares[i] += rho * sigmas[i] * sigmas[j] * np.real(counted[i] * np.conj(counted[j]))
    rss = np.sqrt(np.maximum(squares.sum(axis=0), 0.0))
    at = int(np.argmax(rss))
    whole = float(squares[:, at].sum())
    rows = tuple(
        Row(
            one.source,
            float(magnitude[at]),
            one.limit,
            float(magnitude[at] * one.limit),
            float(magnitude[at] * one.sigma),
            float(square[at]) / whole if whole > 0.0 else 0.0,
        )
        for one, magnitude, square in zip(contributions, magnitudes, squares, strict=True)
    )
    return Budget(worst, rss, at, rows)


def _counted(one: Contribution, start: int | None) -> NDArray[Any]:
    """The gain that counts: relative to the start, where the cause is the same there."""
    if start is None:
        return one.gain
    return one.gain - one.gain[start] if one.relative else one.gain * math.sqrt(2.0)
