"""The dwell of an output of any motion: the longest stretch of the input in which it stays within a tolerance."""

from __future__ import annotations

import math
from typing import NamedTuple

import numpy as np

from gearlink.core.mechanism.motion import Motion
from gearlink.core.numerics.arrays import Reals

_SAMPLES = 7200
_USUAL = 0.005
"""Of the range of an output: how far it may move in a dwell of which nothing is said."""
_LEAST = math.radians(2.0)


class Dwell(NamedTuple):
    """The longest stretch of the input in which an output stays within a tolerance.

    Fields
        start, width : float [rad] - of the input
        middle, tolerance : float [rad, mm] - the output stays within middle +- tolerance
    """

    start: float
    width: float
    middle: float
    tolerance: float


def longest(q: Reals, y: Reals, tolerance: float, gain: float | None = None) -> Dwell:
    """The longest stretch in which a course stays within +- tolerance of some value.

    Parameters
        q : (N,) array - equal steps, of a course that goes on without the end of the period
        gain : float or None - what a course that goes on as it began adds in a period; None: it ends
    Example
        >>> q = np.arange(8.0)
        >>> found = longest(q, np.array([0.0, 3.0, 5.0, 5.1, 5.0, 3.0, 1.0, 0.5]), 0.06)
        >>> found.start, found.width
        (2.0, 2.0)
    """
    n, step = len(q), float(q[1] - q[0])
    track = y if gain is None else np.concatenate([y, y + gain])
    best, start = (0, 0), 0
    low: list[int] = []
    high: list[int] = []
    for end, value in enumerate(track.tolist()):
        while low and track[low[-1]] >= value:
            low.pop()
        while high and track[high[-1]] <= value:
            high.pop()
        low.append(end)
        high.append(end)
        while track[high[0]] - track[low[0]] > 2.0 * tolerance:
            start += 1
            if low[0] < start:
                low.pop(0)
            if high[0] < start:
                high.pop(0)
        if end - start > best[1] - best[0] and end - start < n:
            best = start, end
    part = track[best[0] : best[1] + 1]
    middle = 0.5 * float(part.min() + part.max())
    return Dwell(float(q[0]) + step * best[0], step * (best[1] - best[0]), middle, tolerance)


def dwell_of(motion: Motion, tolerance: float | None = None, *, dwells: bool = False) -> Dwell | None:
    """The dwell of the first output; None of one that stops nowhere, and where the input does not turn once.

    Parameters
        tolerance : float or None [rad, mm] - how far it may move to each side; None: a share of its range, of two
            digits in deg or mm
        dwells : bool - whether it is known to dwell; else one that only turns back does not
    """
    given = motion.input
    if given.unit != "rad" or not motion.outputs or given.turns not in (1, None):
        return None
    course, q = motion.outputs[0].course, np.linspace(given.start, given.end, _SAMPLES, endpoint=given.turns is None)
    y, rate = (np.asarray(each) for each in course.rates(motion, q, 1))
    standing = float(np.mean(np.abs(rate) < 1e-6 * np.abs(rate).max())) * (given.end - given.start)
    if tolerance is None and standing < _LEAST and not dwells:
        return None
    shown = math.degrees(1.0) if course.unit == "rad" else 1.0
    usual = float(f"{_USUAL * float(np.ptp(y)) * shown:.2g}") / shown
    found = longest(q, y, tolerance or usual, gain_of(motion))
    return found if found.width >= _LEAST else None


def gain_of(motion: Motion) -> float | None:
    """What the first output gains in a period; None of a motion over a range."""
    if motion.input.turns is None:
        return None
    ends = motion.outputs[0].course.rates(motion, np.array([motion.input.start, motion.input.end]), 0)[0]
    return float(ends[1] - ends[0])
