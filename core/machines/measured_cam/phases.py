"""The motion that a measured follower seems to be made of: dwells, and strokes with the named law that fits best."""

from __future__ import annotations

import math
from itertools import pairwise
from typing import NamedTuple

import numpy as np

from gearlink.core.numerics.arrays import Reals
from gearlink.core.parts.cams.laws import REST_TO_REST, law

TURN = 2.0 * math.pi
ROWS = 1440
"""Places in a revolution at which the motion is looked at."""
_SHORTEST_DWELL = math.radians(10.0)
_SHORTEST_STROKE = math.radians(3.0)
_STEPS = 30


class MeasuredPhase(NamedTuple):
    """A stretch of the cam angle [rad]; of a stroke the law that comes nearest, and by how much it misses.

    Fields
        start, end : float [rad] - the last phase may end beyond a revolution
        motion : str - dwell, rise, fall
        law : str or None - None of a dwell
        deviation : float [rad or mm] - maximum; of a dwell half of its range
    """

    start: float
    end: float
    motion: str
    law: str | None
    deviation: float


def phases_of(value: Reals, tolerance: float) -> list[MeasuredPhase]:
    """Dwells and strokes of a motion over a revolution.

    Parameters
        value : (ROWS,) array [rad or mm] - the follower at equal steps of the cam angle
        tolerance : float - range of it within a dwell
    Notes
        A dwell is at least 10 deg long. A stroke between dwells is taken from one level to the other and its ends are
        fitted, for within the tolerance the eye cannot tell where it begins.
    Source
        own derivation
    """
    count, dwells = value.size, _dwells(value, tolerance)
    if not dwells:
        turns = _turning(value, 0, count)
        cuts = [*turns, turns[0] + count] if turns else []
        return sorted(_stroke(value, a, b, *value[[a % count, b % count]].tolist()) for a, b in pairwise(cuts))
    inside = [value[np.arange(start, start + length) % count] for start, length in dwells]
    levels = [float(np.median(each)) for each in inside]
    found: list[list[MeasuredPhase]] = []
    for k, (start, length) in enumerate(dwells):
        after = (k + 1) % len(dwells)
        first, last = start + length - 1, dwells[after][0] + (count if after <= k else 0)
        cuts = [first, *_turning(value, first, last), last]
        heights = [levels[k], *(float(value[i % count]) for i in cuts[1:-1]), levels[after]]
        pairs = zip(pairwise(cuts), pairwise(heights), strict=True)
        found.append([_stroke(value, *ends, *rise) for ends, rise in pairs if ends[1] - ends[0] > 1])
    strokes = [each for between in found for each in between]
    for k, each in enumerate(inside):
        start, length = dwells[k]
        begin = found[k - 1][-1].end if found[k - 1] else start * TURN / count
        end = found[k][0].start if found[k] else (start + length) * TURN / count
        half = 0.5 * float(each.max() - each.min())
        strokes.append(_within(MeasuredPhase(begin, begin + (end - begin) % TURN or TURN, "dwell", None, half)))
    return sorted(map(_within, strokes))


def _within(phase: MeasuredPhase) -> MeasuredPhase:
    """The phase with its start in the first turn."""
    turns = TURN * math.floor(phase.start / TURN)
    return phase._replace(start=phase.start - turns, end=phase.end - turns)


def _dwells(value: Reals, tolerance: float) -> list[tuple[int, int]]:
    """First place and number of places of the dwells, in their order; the longest are taken first."""
    count = value.size
    twice = np.concatenate([value, value])
    lengths = np.zeros(count, dtype=int)
    high = np.array(twice[:count])
    low = np.array(twice[:count])
    open_ = np.ones(count, dtype=bool)
    for step in range(1, count + 1):
        lengths[open_] = step
        if step == count:
            break
        now = twice[step : step + count]
        high, low = np.maximum(high, now), np.minimum(low, now)
        open_ &= high - low <= tolerance
        if not open_.any():
            break
    free, found = np.ones(count, dtype=bool), []
    for start in np.argsort(-lengths, kind="stable").tolist():
        length = int(lengths[start])
        if length * TURN / count < _SHORTEST_DWELL:
            break
        inside = np.arange(start, start + length) % count
        if free[inside].all():
            free[inside] = False
            found.append((start, length))
    return sorted(found)


def _turning(value: Reals, first: int, last: int) -> list[int]:
    """Places between two others, or in a revolution, at which the motion turns round."""
    count, found = value.size, []
    size = float(value.max() - value.min())
    for k in range(first + 1, last):
        before, now, after = (float(value[i % count]) for i in (k - 1, k, k + 1))
        if (now - before) * (after - now) < 0.0 or (now - before != 0.0 and after == now):
            near = value[np.arange(k - 12, k + 13) % count]  # 3 deg to either side: no ripple of the points
            if now in (near.max(), near.min()) and size > 0.0:
                found.append(k)
    return found


def _stroke(value: Reals, first: int, last: int, low: float, high: float) -> MeasuredPhase:
    """The stroke between two places and levels, by the law that comes nearest."""
    count = value.size
    x = np.arange(first, last + 1)
    s, step = value[x % count], TURN / count
    motion, height = "rise" if high > low else "fall", high - low
    best = MeasuredPhase(first * step, last * step, motion, None, math.inf)
    share = (s - low) / height if height else np.zeros_like(s)
    for name in REST_TO_REST:
        start, end, off = _fitted(name, np.asarray(x * step, dtype=np.float64), share)
        if abs(height) * off < best.deviation:
            best = MeasuredPhase(start, end, motion, name, abs(height) * off)
    return best


def _fitted(name: str, phi: Reals, share: Reals) -> tuple[float, float, float]:
    """Ends of a law that bring it nearest to a stroke, by Gauss's and Newton's steps, and its maximum deviation."""
    named = law(name)

    def off(ends: Reals) -> tuple[Reals, Reals]:
        x = (phi - ends[0]) / (ends[1] - ends[0])
        moves = (x > 0.0) & (x < 1.0)
        s, v = named.evaluate(np.where(moves, x, 0.5), 1)
        at = np.where(moves, s, np.where(x >= 1.0, 1.0, 0.0))
        rate = np.where(moves, v, 0.0) / (ends[1] - ends[0])
        return at - share, np.array([-rate * (1.0 - x), -rate * x]).T

    ends = np.array([phi[0], phi[-1]])
    residual, slopes = off(ends)
    for _ in range(_STEPS):
        change = np.linalg.lstsq(slopes, -residual, rcond=None)[0]
        tried = ends + change
        if not (tried[1] - tried[0] > _SHORTEST_STROKE and np.abs(change).max() < 0.5 * (phi[-1] - phi[0])):
            break
        after, slopes_there = off(tried)
        if not (after @ after) < (residual @ residual) * (1.0 - 1e-12):
            break
        ends, residual, slopes = tried, after, slopes_there
    return float(ends[0]), float(ends[1]), float(np.abs(residual).max())
