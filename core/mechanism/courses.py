"""What moves, as one number over the input with its derivatives, and the tables that show it.

A course reads the links of a `Mechanism` by name: the angle of a link, a coordinate of one of its points, the angle
between two links. Tables, curves, extremes and bands of tolerance are made of courses.
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
    """Where a point of a link lies along a direction of the frame [mm].

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
    """The acute angle between the x axes of two links, 90 deg where they stand across: the transmission angle."""

    def of(mechanism: Mechanism) -> Sequence[Reals]:
        apart = mechanism.links[one].turn.value - mechanism.links[other].turn.value
        return [np.abs(np.remainder(apart + 0.5 * math.pi, math.pi) - 0.5 * math.pi)]

    return Course("rad", of)


class Shown(NamedTuple):
    """A column of a table of the motion.

    Fields
        column : str - its name
        course : Course
        order : int - 0: the value, 1 to 3: that derivative by the input
        timed : str - the name of the column in real time, where the speed of the input is known
    """

    column: str
    course: Course
    order: int = 0
    timed: str = ""


def of_output(course: Course, angle: str = "output_angle", speed: str = "output") -> list[Shown]:
    """Angle, speed and acceleration of a course, as what comes out of the mechanism."""
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
