"""What came of the samples: yields, moments, quantiles and capabilities, each with the interval of its replications."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.tolerance.sampling import Estimate, estimate, share_estimate, student
from gearlink.core.studies.tolerance_study.problem import Problem
from gearlink.core.studies.tolerance_study.samples import judged_replication, replicated, replication_size

QUANTILES = (0.00135, 0.5, 0.99865)
_KEPT = 16_384  # values of a quantity that pictures show, of the first replications


@dataclass(frozen=True)
class Yield:
    """Share of good designs with its 95 % interval."""

    value: float
    low: float
    high: float


@dataclass(frozen=True)
class Spread:
    """A quantity over the samples: mean, standard deviation, and the quantiles of 0.135, 50 and 99.865 %."""

    mean: Estimate
    sigma: Estimate
    places: tuple[Quantile, Quantile, Quantile]

    @property
    def quantiles(self) -> tuple[Estimate, Estimate, Estimate]:
        """The quantiles with their intervals."""
        low, middle, high = (place.estimate for place in self.places)
        return low, middle, high


@dataclass(frozen=True)
class Numbers:
    """Mean, deviation and the values about the quantiles of one replication; None where a quantity does not apply."""

    mean: float
    sigma: float
    windows: tuple[Window, ...]


@dataclass(frozen=True)
class Result:
    """All of a study.

    Fields
        good : Yield - of everything together
        missing : float - share of designs that do not exist
        passes : Yield by code and by requirement
        spreads : Spread by quantity
        values : (M,) arrays by quantity - of the first replications, for pictures
    """

    samples: int
    good: Yield
    missing: float
    passes: Mapping[str, Yield]
    spreads: Mapping[str, Spread]
    values: Mapping[str, Reals]


@dataclass(frozen=True)
class Counted:
    """What is kept of a replication.

    Fields
        good, missing : float - shares
        passes : share by code and by requirement
        numbers : Numbers by quantity, None where it does not apply
        values : (N,) arrays by quantity - of the first replications
    """

    count: int
    good: float
    missing: float
    passes: Mapping[str, float]
    numbers: Mapping[str, Numbers | None]
    values: Mapping[str, Reals]


def counted(made: Problem, number: int) -> Counted:
    """Compute a replication, and keep what the study needs of it."""
    one = judged_replication(made, number)
    real = {name: value for name, value in one.quantities.items() if value.dtype.kind == "f"}
    return Counted(
        one.good.size,
        float(one.good.mean()),
        float(1.0 - one.exists.mean()),
        {name: float(mask.mean()) for name, mask in one.passes.items()},
        {name: _numbers(value) for name, value in real.items()},
        real if number * one.exists.size < _KEPT else {},
    )


def result(made: Problem) -> Result:
    """Compute a study, and sum up its replications."""
    rows = list(replicated(made, counted, replication_size(made)))
    count = sum(one.count for one in rows)
    names = list(dict.fromkeys(name for one in rows for name in one.passes))
    kept = [one.values for one in rows if one.values]
    return Result(
        count,
        _yield([one.good for one in rows], count),
        float(np.mean([one.missing for one in rows])),
        # A replication on whose designs a check says nothing: all that exist pass it.
        {name: _yield([one.passes.get(name, 1.0 - one.missing) for one in rows], count) for name in names},
        {name: _spread([one.numbers[name] for one in rows]) for name in rows[0].numbers},
        {name: np.concatenate([values[name] for values in kept]) for name in rows[0].numbers},
    )


def _yield(shares: list[float], count: int) -> Yield:
    return Yield(*share_estimate(np.array(shares), count))


def _numbers(values: Reals) -> Numbers | None:
    """What is kept of a quantity, without the designs that it does not apply to."""
    there = np.sort(values[~np.isnan(values)])
    if there.size < 2:
        return None
    # About the first value: a mean of nearly equal numbers then loses nothing.
    off = there - there[0]
    # Not over N - 1: the mean of scrambled points hardly scatters.
    windows = tuple(window(there, share) for share in QUANTILES)
    return Numbers(float(there[0] + off.mean()), float(off.std()), windows)


def _spread(rows: list[Numbers | None]) -> Spread:
    """The replications together, without those where the quantity does not apply."""
    there = [one for one in rows if one is not None]
    if len(there) < 2:
        nothing = Estimate(math.nan, math.nan)
        no_place = Quantile(math.nan, np.full(2, math.nan))
        return Spread(nothing, nothing, (no_place, no_place, no_place))
    mean, sigma = (estimate(np.array(column)) for column in zip(*((one.mean, one.sigma) for one in there), strict=True))
    low, middle, high = (quantile([one.windows[i] for one in there], share) for i, share in enumerate(QUANTILES))
    return Spread(mean, sigma, (low, middle, high))


def capabilities(rows: Spread, lower: float | None, upper: float | None) -> tuple[Estimate | None, Estimate | None]:
    """C_p and C_pk of a quantity against its limits.

    C_p = (U - L)/(q99.865 - q0.135),   C_pk = min((U - q50)/(q99.865 - q50), (q50 - L)/(q50 - q0.135))

    Parameters
        lower, upper : float or None - limits; C_p needs both, C_pk one
    Returns
        cp, cpk : Estimate or None - None without limits, or where nothing varies
    Notes
        Equal to the usual indices for a normal quantity. Intervals by the replications: the quantiles of one move
        together.
    Source
        ISO 22514-2, percentile method
    """
    low, middle, high = rows.places
    width = high.value - low.value
    if not width > 0.0 or (lower is None and upper is None):
        return None, None
    cp = None
    if lower is not None and upper is not None:
        value = (upper - lower) / width
        cp = Quantile(value, -value / width * (high.off - low.off)).estimate
    sides = []
    if upper is not None:
        sides.append(_side(upper - middle.value, high.value - middle.value, -middle.off, high.off - middle.off))
    if lower is not None:
        sides.append(_side(middle.value - lower, middle.value - low.value, middle.off, middle.off - low.off))
    there = [side for side in sides if side is not None]
    return cp, min(there, key=lambda side: side.value) if there else None


def _side(room: float, spread: float, room_off: Reals, spread_off: Reals) -> Estimate | None:
    """Room over spread; both differ from replication to replication."""
    if not spread > 0.0:
        return None
    value = room / spread
    return Quantile(value, (room_off - value * spread_off) / spread).estimate


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
