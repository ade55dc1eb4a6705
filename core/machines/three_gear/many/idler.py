"""Choice of the idler over arrays of designs: `idler_choice.smallest_idler` for many at once.

In the symmetric family the idlers that keep the limits are all from some number of teeth on, so they are halved; for
other tasks they are tried from 17 up. In both, designs whose idler is found drop out.

The family's frame ratio d rises with n = 1 - i3: d = sc + sqrt(sc^2 + 1), sc = sqrt(n^2 - 1) cos(h), where h stands or
falls with n (a speed band gives d = q + sqrt(q^2 - 1) with q in proportion to n). The least transmission angle follows
d alone, (d - 1)/sqrt(2 (1 + d^2)) = sin(gamma/2), and rises; so does frame less crank, b sqrt(2) (d - 1)/sqrt(1 + d^2).
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.machines.three_gear.idler_choice import GREATEST_IDLER, LEAST_IDLER
from gearlink.core.numerics.arrays import Mask, Reals


class Tried(NamedTuple):
    """Designs with idlers that are tried.

    good : whether they keep transmission angle and gear gap
    clear : whether no gear reaches a shaft that the file names
    close : whether rounding might change either
    """

    good: Mask
    clear: Mask
    close: Mask


Trial = Callable[[Reals, Any], Tried]
"""Tries idlers, a number of teeth each, on the designs of some places."""


class Idlers(NamedTuple):
    """Smallest idlers: teeth, NaN where no idler keeps the limits, and designs that the class shall compute."""

    teeth: Reals
    doubtful: Mask


def smallest_idlers(trial: Trial, count: int, *, rising: bool, shafts: bool) -> Idlers:
    """The smallest idler of each design that keeps the limits and clears the shafts; or the limits alone, if none does.

    Parameters
        trial : Trial
        count : int - of the designs
        rising : bool - whether all idlers above one that keeps the limits keep them
        shafts : bool - whether there are shafts to clear
    """
    doubtful = np.zeros(count, dtype=bool)
    first = (_halved if rising else _from_below)(trial, count, doubtful)
    if not shafts:
        return Idlers(first, doubtful)
    return Idlers(_clear(trial, first, doubtful), doubtful)


def _halved(trial: Trial, count: int, doubtful: Mask) -> Reals:
    """Bisection: the least of an upper range."""
    low, high = np.full(count, LEAST_IDLER - 1.0), np.full(count, float(GREATEST_IDLER))
    every = np.arange(count)
    at_most = trial(high, every)
    doubtful |= at_most.close
    live = np.flatnonzero(at_most.good)
    while live.size:
        middle = np.floor(0.5 * (low[live] + high[live]))
        found = trial(middle, live)
        doubtful[live] |= found.close
        high[live] = np.where(found.good, middle, high[live])
        low[live] = np.where(found.good, low[live], middle)
        live = live[high[live] - low[live] > 1.0]
    return np.where(at_most.good, high, np.nan)


def _from_below(trial: Trial, count: int, doubtful: Mask) -> Reals:
    return _first(trial, np.full(count, float(LEAST_IDLER)), doubtful, lambda found: found.good)


def _clear(trial: Trial, first: Reals, doubtful: Mask) -> Reals:
    """The first idler from those that keep the limits on that clears the shafts too; where none does, those."""
    found = _first(trial, first, doubtful, lambda tried: tried.good & tried.clear)
    return np.where(np.isnan(found), first, found)


def _first(trial: Trial, start: Reals, doubtful: Mask, holds: Callable[[Tried], Mask]) -> Reals:
    """The first idler from `start` on for which something holds; NaN where there is none, or no start."""
    found = np.full(start.shape, np.nan)
    live, teeth = np.flatnonzero(~np.isnan(start)), start[~np.isnan(start)]
    while live.size:
        tried = trial(teeth, live)
        doubtful[live] |= tried.close
        good = holds(tried)
        found[live[good]] = teeth[good]
        going = ~good & (teeth < GREATEST_IDLER)
        live, teeth = live[going], teeth[going] + 1.0
    return found
