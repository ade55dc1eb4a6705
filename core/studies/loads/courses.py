"""Values over the input angle as a design file gives them: a number, a table, or zones; periodic over a revolution."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.numerics.arrays import Reals

if TYPE_CHECKING:
    from gearlink.core.studies.loads.spec import Course, Zone

_TURN = 2.0 * math.pi


def values(course: float | Course, phi: Reals) -> Reals:
    """The value at input angles [rad].

    Notes
        A zone holds from its start up to its end, where several overlap they add; a zone whose end lies below its start
        passes through 360 deg.
    """
    if isinstance(course, (int, float)):
        return np.full_like(phi, course)
    if course.zones is not None:
        return _from_zones(course.zones, phi)
    return _from_table(course, phi)


def breaks(course: float | Course) -> list[float]:
    """Input angles in [0, 2 pi) where the value or a derivative jumps [rad]."""
    if isinstance(course, (int, float)):
        return []
    if course.zones is not None:
        found = [
            angle for zone in course.zones if _width(zone.start, zone.end) < _TURN for angle in (zone.start, zone.end)
        ]
    else:
        found = [angle for angle, _ in course.table or []]
    return sorted({math.radians(angle) % _TURN for angle in found})


def _width(start: float, end: float) -> float:
    """Angle of a zone [rad]; one whose ends are whole revolutions apart is the whole revolution."""
    width = math.radians(end - start) % _TURN
    return width if width > 0.0 else (_TURN if end != start else 0.0)


def _from_zones(zones: Sequence[Zone], phi: Reals) -> Reals:
    """The sum of the zones: a level between each two of their ends."""
    whole = sum(zone.value for zone in zones if _width(zone.start, zone.end) == _TURN)
    ends = [
        (math.radians(zone.start) % _TURN, math.radians(zone.end) % _TURN, zone.value)
        for zone in zones
        if 0.0 < _width(zone.start, zone.end) < _TURN
    ]
    edges = np.unique([0.0, *(end for start, stop, _ in ends for end in (start, stop))])
    levels = np.full_like(edges, whole)
    for start, stop, value in ends:
        first, last = np.searchsorted(edges, (start, stop))
        levels[first : last if first < last else None] += value
        if first > last:
            levels[:last] += value
    return np.asarray(levels[np.searchsorted(edges, _after(phi, 0.0, edges), side="right") - 1])


def _after(phi: Reals, start: float, edges: Reals | None = None) -> Reals:
    """Angle from a start, in [0, 2 pi); a place that is the start, or an edge, but for rounding is there."""
    after = np.mod(phi - start, _TURN)
    near = 4.0 * np.spacing(np.maximum(np.abs(phi), _TURN))
    after = np.where(_TURN - after <= near, 0.0, after)
    if edges is not None:
        following = np.append(edges, _TURN)[np.searchsorted(edges, after, side="right")]
        after = np.where(following - after <= near, np.mod(following, _TURN), after)
    return np.asarray(after)


def _from_table(course: Course, phi: Reals) -> Reals:
    table = course.table or []
    angles, found = np.radians([pair[0] for pair in table]), np.array([pair[1] for pair in table], dtype=np.float64)
    start = float(angles[0])
    after = _after(phi, start)
    knots = angles - start
    if knots[-1] >= _TURN * (1.0 - 1e-12):  # a table that says its first value again after a revolution
        knots, found = knots[:-1], found[:-1]
    if course.interpolation == "step":
        return np.asarray(found[np.searchsorted(knots, after, side="right") - 1])
    closed, levels = np.append(knots, _TURN), np.append(found, found[0])
    if course.interpolation == "linear" or len(knots) < 2:
        return np.asarray(np.interp(after, closed, levels))
    from scipy.interpolate import CubicSpline

    return np.asarray(CubicSpline(closed, levels, bc_type="periodic")(after))
