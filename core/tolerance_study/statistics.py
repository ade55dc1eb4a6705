"""What came of the samples: yields, moments, quantiles and capabilities, each with the interval of its replications."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.tolerance.sampling import Estimate, estimate, share_estimate
from gearlink.core.tolerance_study.problem import Problem
from gearlink.core.tolerance_study.samples import judged_replication
from gearlink.core.tolerance_study.shares import replicated

QUANTILES = (0.00135, 0.5, 0.99865)
_KEPT = 2  # replications whose values pictures show


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
    quantiles: tuple[Estimate, Estimate, Estimate]


@dataclass(frozen=True)
class Result:
    """All of a study.

    Fields
        samples : int
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
        count : int
        good, missing : float - shares
        passes : share by code and by requirement
        numbers : mean, deviation and order statistics by quantity
        values : (N,) arrays by quantity - of the first replications
    """

    count: int
    good: float
    missing: float
    passes: Mapping[str, float]
    numbers: Mapping[str, tuple[float, ...]]
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
        real if number < _KEPT else {},
    )


def result(made: Problem) -> Result:
    """Compute a study, and sum up its replications."""
    rows = list(replicated(made, counted))
    count = sum(one.count for one in rows)
    names = list(dict.fromkeys(name for one in rows for name in one.passes))
    kept = [one.values for one in rows if one.values]
    return Result(
        count,
        _yield([one.good for one in rows], count),
        float(np.mean([one.missing for one in rows])),
        {name: _yield([one.passes[name] for one in rows if name in one.passes], count) for name in names},
        {name: _spread([one.numbers[name] for one in rows]) for name in rows[0].numbers},
        {name: np.concatenate([values[name] for values in kept]) for name in rows[0].numbers},
    )


def _yield(shares: list[float], count: int) -> Yield:
    return Yield(*share_estimate(np.array(shares), count))


def _numbers(values: Reals) -> tuple[float, ...]:
    """Mean, standard deviation and order statistics of one replication, without what does not apply."""
    there = np.sort(values[~np.isnan(values)])
    if there.size < 2:
        return (math.nan,) * 5
    places = [min(there.size - 1, max(0, math.ceil(share * there.size) - 1)) for share in QUANTILES]
    # About the first value: a mean of nearly equal numbers then loses nothing.
    off = there - there[0]
    return (float(there[0] + off.mean()), float(off.std(ddof=1)), *(float(there[place]) for place in places))


def _spread(rows: list[tuple[float, ...]]) -> Spread:
    mean, sigma, low, middle, high = (estimate(np.array(column)) for column in zip(*rows, strict=True))
    return Spread(mean, sigma, (low, middle, high))


def capabilities(rows: Spread, lower: float | None, upper: float | None) -> tuple[Estimate | None, Estimate | None]:
    """C_p and C_pk of a quantity against its limits.

    C_p = (U - L)/(q99.865 - q0.135),   C_pk = min((U - q50)/(q99.865 - q50), (q50 - L)/(q50 - q0.135))

    Parameters
        rows : Spread
        lower, upper : float or None - limits; C_p needs both, C_pk one
    Returns
        cp, cpk : Estimate or None - None without limits, or where nothing scatters
    Notes
        Equal to the usual indices for a normal quantity. Intervals by the ends of the quantiles' own.
    Source
        ISO 22514-2, percentile method
    """
    low, middle, high = rows.quantiles
    width = high.value - low.value
    if width <= 0.0 or (lower is None and upper is None):
        return None, None
    spread_pm = math.hypot(high.half_width, low.half_width)
    cp = None
    if lower is not None and upper is not None:
        value = (upper - lower) / width
        cp = Estimate(value, value * spread_pm / width)
    sides = []
    if upper is not None:
        sides.append(_side(upper - middle.value, high.value - middle.value, middle.half_width, high.half_width))
    if lower is not None:
        sides.append(_side(middle.value - lower, middle.value - low.value, middle.half_width, low.half_width))
    there = [side for side in sides if side is not None]
    return cp, min(there, key=lambda side: side.value) if there else None


def _side(room: float, spread: float, middle_pm: float, end_pm: float) -> Estimate | None:
    if spread <= 0.0:
        return None
    value = room / spread
    return Estimate(value, math.hypot(middle_pm * (1.0 - value), value * end_pm) / spread)
