"""Courses: scalar outputs over the input with their derivatives, and the tables that show them.

A course reads the links of a `Mechanism` by name: the angle of a link, a coordinate of one of its points, the angle
between two links. Tables, curves, extremes, tolerance bands and the dwell of an output are computed from courses; a
dwell is the longest range of the input in which the output stays within a tolerance.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np

from gearlink.core.base.real_speed import OF_TIME
from gearlink.core.base.report import Table
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.mechanism.motion import Course, Motion
from gearlink.core.numerics.arrays import Points, Reals, turn_degrees

_RATES = ("speed", "acceleration", "jerk")


def turned(link: str, against: str = FRAME, sense: float = 1.0) -> Course:
    """The angle of a link, against another one where one is named."""

    def of(mechanism: Mechanism) -> Sequence[Reals]:
        rates: Sequence[Reals] = mechanism.links[link].turn
        if against != FRAME:
            rates = [one - other for one, other in zip(rates, mechanism.links[against].turn, strict=True)]
        return rates if sense == 1.0 else [sense * rate for rate in rates]

    return Course("rad", of)


def coordinate(link: str, point: complex | str = 0j, along: complex = 1.0) -> Course:
    """The coordinate of a point of a link along a direction of the frame [mm].

    Parameters
        point : complex [mm] or str - in coordinates of the link, or by its name there
        along : complex - unit vector; 1: x, 1j: y
    """

    def of(mechanism: Mechanism) -> Sequence[Reals]:
        return [_along(rate, along) for rate in mechanism.links[link].at(point)]

    return Course("mm", of)


def _along(vector: Points, along: complex) -> Reals:
    if along == 1.0:
        return np.asarray(vector.real)
    return np.asarray(vector.imag if along == 1j else (vector * along.conjugate()).real)


def between(one: str, other: str) -> Course:
    """The acute angle between the x axes of two links, at most 90 deg: the transmission angle."""

    def of(mechanism: Mechanism) -> Sequence[Reals]:
        apart = mechanism.links[one].turn.value - mechanism.links[other].turn.value
        return [np.abs(np.remainder(apart + 0.5 * math.pi, math.pi) - 0.5 * math.pi)]

    return Course("rad", of)


class Shown(NamedTuple):
    """A column of a table of the motion.

    Fields
        column : str - its name
        order : int - 0: the value, 1 to 3: that derivative by the input
        timed : str - the name of the column in real time, where the speed of the input is known
    """

    column: str
    course: Course
    order: int = 0
    timed: str = ""


def of_output(course: Course, angle: str = "output_angle", speed: str = "output") -> list[Shown]:
    """Angle, speed and acceleration of a course, as the output of the mechanism."""
    return [
        Shown(angle, course),
        Shown("speed_ratio", course, 1, f"{speed}_speed"),
        Shown("acceleration_ratio", course, 2, f"{speed}_acceleration"),
    ]


def all_rates(names: Mapping[str, Course]) -> list[Shown]:
    """Angle, speed, acceleration and jerk of every course, as columns `NAME_angle`, `NAME_speed_ratio` and so on."""
    found: list[Shown] = []
    for name, course in names.items():
        found.append(Shown(f"{name}_angle", course))
        found += (
            Shown(f"{name}_{rate}_ratio", course, order, f"{name}_{rate}") for order, rate in enumerate(_RATES, 1)
        )
    return found


def columns_of(
    motion: Motion, q: Reals, shown: Iterable[Shown], speed: float | None = None
) -> dict[str, tuple[Any, str]]:
    """Columns of a table: angles in deg, lengths in mm, derivatives per rad or mm of the input, or by time where the
    speed of the input [rad/s] is given.
    """
    found: dict[str, tuple[Any, str]] = {}
    known: dict[Course, list[Reals]] = {}
    wanted = list(shown)
    highest = max((each.order for each in wanted), default=0)
    for each in wanted:
        if each.course not in known:
            known[each.course] = each.course.rates(motion, q, highest)
        rate = known[each.course][each.order]
        if speed is not None and each.order:
            found[each.column] = rate * speed**each.order, each.course.unit + OF_TIME[each.order]
        elif each.course.unit == "rad" and each.order == 0:
            found[each.column] = np.degrees(rate), "deg"
        else:
            found[each.column] = rate, unit_of(each.course.unit, each.order, motion.input.unit)
    return found


def unit_of(unit: str, order: int, per: str = "rad") -> str:
    """Unit of a derivative of what is in rad, mm or 1, by an input in rad or mm.

    Example
        >>> unit_of("rad", 2), unit_of("mm", 2), unit_of("rad", 2, "mm"), unit_of("mm", 2, "mm")
        ('1', 'mm/rad^2', 'rad/mm^2', '1/mm')
    """
    if per == "rad":
        return "1" if unit in ("rad", "1") else unit + ("", "/rad", "/rad^2", "/rad^3")[order]
    power = order - 1 if unit == "mm" else order
    top = "1" if unit in ("mm", "1") else unit
    if order == 0:
        return unit
    return top if power == 0 else f"{top}/mm{'' if power == 1 else f'^{power}'}"


def motion_table(
    name: str,
    design: Any,
    shown: Sequence[Shown],
    samples: int | None,
    *,
    degrees: Reals | None = None,
    beside: Mapping[str, tuple[Any, str]] | None = None,
) -> Table:
    """A table of the motion of a design, in real time too where the speed of its input is known.

    Parameters
        design : the design, whose `moving` is its motion and whose `timed` puts the speed in
        shown : the columns
        samples : int - rows of a revolution, 360 where none are given
        degrees : (N,) array [deg] - the inputs, where they are others than equal steps of the period
        beside : further columns
    Raises
        NoSolution - where the mechanism does not close
    """
    motion: Motion = design.moving
    first = motion.input.column
    if degrees is None:
        degrees = turn_degrees(samples, motion.input.turns or 1)
    columns = {first: (degrees, "deg"), **columns_of(motion, np.radians(degrees), shown), **(beside or {})}
    rates = {each.timed: (each.column, each.order) for each in shown if each.timed}
    return Table.of(name, design.timed(columns, first, rates) if hasattr(design, "timed") else columns)


# Dwells

_DWELL_SAMPLES = 7200
_USUAL_DWELL = 0.005
"""Of the range of an output: how far it may move in a dwell of which nothing is said."""
_LEAST_DWELL = math.radians(2.0)


class Dwell(NamedTuple):
    """The longest range of the input in which an output stays within a tolerance.

    Fields
        start, width : float [rad] - of the input
        middle, tolerance : float [rad, mm] - the output stays within middle +- tolerance
    """

    start: float
    width: float
    middle: float
    tolerance: float


def longest(q: Reals, y: Reals, tolerance: float, gain: float | None = None) -> Dwell:
    """The longest range in which a course stays within +- tolerance of some value.

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


def longest_dwell(motion: Motion, tolerance: float | None = None, *, dwells: bool = False) -> Dwell | None:
    """The dwell of the first output; None if it never stops, or if the input does not make a revolution.

    Parameters
        tolerance : float or None [rad, mm] - how far it may move to each side; None: a share of its range, of two
            digits in deg or mm
        dwells : bool - whether it is known to dwell; else one that only turns back does not
    """
    given = motion.input
    if given.unit != "rad" or not motion.outputs or given.turns not in (1, None):
        return None
    course = motion.outputs[0].course
    q = np.linspace(given.start, given.end, _DWELL_SAMPLES, endpoint=given.turns is None)
    y, rate = (np.asarray(each) for each in course.rates(motion, q, 1))
    standing = float(np.mean(np.abs(rate) < 1e-6 * np.abs(rate).max())) * (given.end - given.start)
    if tolerance is None and standing < _LEAST_DWELL and not dwells:
        return None
    shown = math.degrees(1.0) if course.unit == "rad" else 1.0
    usual = float(f"{_USUAL_DWELL * float(np.ptp(y)) * shown:.2g}") / shown
    found = longest(q, y, tolerance or usual, gain_of(motion))
    return found if found.width >= _LEAST_DWELL else None


def gain_of(motion: Motion) -> float | None:
    """The net displacement of the first output per period; None for a motion over a range."""
    if motion.input.turns is None:
        return None
    ends = motion.outputs[0].course.rates(motion, np.array([motion.input.start, motion.input.end]), 0)[0]
    return float(ends[1] - ends[0])
