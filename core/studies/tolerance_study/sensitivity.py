"""Which source contributes what: slopes at the nominal design, and Sobol' indices over the whole scatter."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import partial

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.tolerance.correlation import groups
from gearlink.core.studies.tolerance.sampling import Estimate, estimate, replication, rounded_up
from gearlink.core.studies.tolerance.sources import Scatter
from gearlink.core.studies.tolerance_study.problem import Problem
from gearlink.core.studies.tolerance_study.samples import evaluated, judged, replication_size
from gearlink.core.studies.tolerance_study.shares import replicated

_KINK = 0.1  # of the whole scatter: sides that differ by more belong to no line


@dataclass(frozen=True)
class Slope:
    """Slope of a quantity in one source [unit of the quantity per unit of the source]; of a pin in both directions.

    `sigma` is what the source adds to the quantity's standard deviation by that slope, `bend` what it adds by the
    difference of the slopes to either side. `kink`: that is so much of the whole that no linear share applies.
    """

    gain: tuple[float, ...]
    sigma: float
    bend: float
    kink: bool = False


def slopes(made: Problem, names: Sequence[str]) -> dict[str, list[Slope]]:
    """Slopes of quantities in every source, at the nominal design.

    (4 D(h/2) - D(h))/3 with the central differences D over h, half of the tolerance or 1e-5 of the size

    Returns
        slopes : by quantity, one for each source
    Notes
        One-sided slopes that differ tell of a kink, a place where one of several extremes takes over, or of a bend: a
        drive that is best as it is has slope 0.
    Source
        L. F. Richardson, Phil. Trans. R. Soc. A 210 (1911) 307
    """
    steps = [(source, axis, _step(source)) for source in made.sources for axis in _axes(source)]
    shifts: list[Mapping[str, complex]] = [{}]
    for source, axis, h in steps:
        shifts += [{source.key: share * h * axis} for share in (1.0, -1.0, 0.5, -0.5)]
    found = evaluated(made, made.offsets(shifts)).quantities
    result: dict[str, list[Slope]] = {}
    for name in names:
        values = found[name]
        per_axis = [_slope(values[0], values[1 + 4 * i : 5 + 4 * i], h) for i, (_, _, h) in enumerate(steps)]
        rows = iter(per_axis)
        found_slopes = [_of_source(source, [next(rows) for _ in _axes(source)]) for source in made.sources]
        whole = math.hypot(*(row.sigma for row in found_slopes), *(row.bend for row in found_slopes))
        result[name] = [replace(row, kink=not row.bend <= _KINK * whole) for row in found_slopes]
    return result


def _axes(source: Scatter) -> tuple[complex, ...]:
    return (1.0, 1j) if source.kind == "pin" else (1.0,)


def _step(source: Scatter) -> float:
    """Half of the width of the scatter, or a small part of the size."""
    width = abs(source.law.upper - source.law.lower) if source.kind != "pin" else source.limit
    return max(0.25 * width, 1e-5 * abs(source.nominal), 1e-9)


def _slope(middle: float, values: Reals, h: float) -> tuple[float, float]:
    """Slope, and by how much those to either side differ."""
    up, down, half_up, half_down = values.tolist()
    wide, narrow = (up - down) / (2.0 * h), (half_up - half_down) / h
    return (4.0 * narrow - wide) / 3.0, abs(half_up - 2.0 * middle + half_down) / (0.5 * h)


def _of_source(source: Scatter, rows: list[tuple[float, float]]) -> Slope:
    gain, sigma = tuple(row[0] for row in rows), component_sigma(source)
    return Slope(gain, math.hypot(*gain) * sigma, math.hypot(*(row[1] for row in rows)) * sigma)


def component_sigma(source: Scatter) -> float:
    """Standard deviation of a source; of a pin that of one component of its offset."""
    mean, sigma = source.law.moments()
    if source.kind != "pin":
        return sigma
    if source.entry.play == "floating":
        return 0.25 * mean
    return 0.5 * math.sqrt(0.5 * (mean * mean + sigma * sigma))


def linear_shares(
    rows: Sequence[Slope], sources: Sequence[Scatter], correlations: Mapping[tuple[str, str], float]
) -> list[float | None]:
    """Shares of the variance by the slopes; None for all where one of them has a kink, or nothing varies.

    A source's share is its covariance with the whole: with correlations it may be negative, and all still add up to 1.
    """
    signed = [math.copysign(row.sigma, row.gain[0]) for row in rows]
    parts = [
        one
        * sum(correlations.get((a.key, b.key), float(a is b)) * other for b, other in zip(sources, signed, strict=True))
        for a, one in zip(sources, signed, strict=True)
    ]
    whole = sum(parts)
    if whole <= 0.0 or not math.isfinite(whole) or any(row.kink for row in rows):
        return [None] * len(rows)
    return [part / whole for part in parts]


@dataclass(frozen=True)
class Indices:
    """First and total Sobol' index of a source, none negative, the first not above the total."""

    first: Estimate
    total: Estimate


def indices(made: Problem, names: Sequence[str]) -> dict[str, list[Indices]]:
    """Sobol' indices of quantities in every source.

    S_i = [mean(f_B f_C) - f0^2]/V (Janon),   T_i = mean((f_A - f_C)^2)/(2 V) (Jansen)

    Notes
        C is A with the source's columns of B; sources that vary together have one index, that of their group.
        Each replication by itself, with the mean and variance of its own; the
        interval is that of the replications.
    Source
        I. M. Sobol', Math. Comput. Simul. 55 (2001) 271; A. Janon et al., ESAIM P&S 18 (2014) 342; M. J. W. Jansen,
        Comput. Phys. Comm. 117 (1999) 35
    """
    work = replication_size(made) * (2 + len(made.sources))
    rows = list(replicated(made, partial(_indices_of, names=tuple(names)), work))
    return {
        name: [_estimated(np.array([row[name][i] for row in rows])) for i in range(len(made.sources))] for name in names
    }


def _indices_of(made: Problem, number: int, names: Sequence[str]) -> Mapping[str, list[tuple[float, float]]]:
    """First and total index of every source, by quantity, of one replication."""
    width = made.coordinates
    points = replication(2 * width, rounded_up(made.samples), made.section.seed, number)
    a, b = points[:, :width], points[:, width:]
    one, other = (judged(made, part).quantities for part in (a, b))
    mixed = [judged(made, _swapped(a, b, group)).quantities for group in _columns(made)]
    return {name: [_indices(one[name], other[name], each[name]) for each in mixed] for name in names}


def _columns(made: Problem) -> list[list[int]]:
    """Which random numbers are a source's, and those of the sources that scatter with it."""
    own, at = [], 0
    for source in made.sources:
        own.append(range(at, at + source.coordinates))
        at += source.coordinates
    group = groups(made.section, made.sources)
    return [[i for j, columns in enumerate(own) if group[j] == number for i in columns] for number in group]


def _swapped(a: Reals, b: Reals, group: list[int]) -> Reals:
    mixed = a.copy()
    mixed[:, group] = b[:, group]
    return mixed


def _indices(a: Reals, b: Reals, mixed: Reals) -> tuple[float, float]:
    """First and total index of one replication."""
    there = ~(np.isnan(a) | np.isnan(b) | np.isnan(mixed))
    a, b, mixed = a[there], b[there], mixed[there]
    if a.size < 2:
        return math.nan, math.nan
    middle = b[0]
    a, b, mixed = a - middle, b - middle, mixed - middle
    mean = 0.5 * float(np.mean(b + mixed))
    variance = 0.5 * float(np.mean(b * b + mixed * mixed)) - mean * mean
    if variance <= 0.0:
        return math.nan, math.nan
    return (float(np.mean(b * mixed)) - mean * mean) / variance, float(np.mean((a - mixed) ** 2)) / (2.0 * variance)


def _estimated(rows: Reals) -> Indices:
    """Indices with their intervals; where chance puts the first above the total, the less certain gives way."""
    first, total = (_not_negative(estimate(rows[:, i])) for i in (0, 1))
    if first.value > total.value:
        if first.half_width <= total.half_width:
            total = _moved(total, first)
        else:
            first = _moved(first, total)
    return Indices(first, total)


def _not_negative(one: Estimate) -> Estimate:
    return Estimate(max(0.0, one.value), one.half_width)


def _moved(one: Estimate, to: Estimate) -> Estimate:
    """An estimate at the value of a more certain one; the far end of its interval stays, or is that of the other."""
    return Estimate(to.value, max(to.half_width, one.half_width - abs(one.value - to.value)))
