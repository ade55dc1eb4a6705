"""What acts on a machine from outside, from the section `loads`: forces, torques, resistances, springs.

A value over the input angle is a number, a table, or zones; it is periodic over a revolution.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.mechanism.dynamics import Force, Mass, Torque
from gearlink.core.mechanism.friction import Coefficients
from gearlink.core.mechanism.joints import NEWTON_METER, Connection, Pin, Toothed
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.mechanism.rates import Point, dot, fixed, sense_of
from gearlink.core.numerics.arrays import Reals, distinct

if TYPE_CHECKING:
    from gearlink.core.studies.loads.spec import Body, CommonLoads, Course, Friction, Load, Spring, Zone


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
    edges = distinct([0.0, *(end for start, stop, _ in ends for end in (start, stop))])
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


def mass_of(body: Body) -> Mass:
    """A link's mass."""
    return Mass(body.mass, body.inertia, vector(body.center or [0.0, 0.0]))


def vector(pair: list[float]) -> complex:
    """[x, y] as a plane vector."""
    return complex(pair[0], pair[1])


def gravity_of(section: CommonLoads) -> complex:
    """Gravity [mm/s^2], which the file gives in m/s^2."""
    return 1e3 * vector(section.gravity)


def coefficients_of(given: Friction, connections: Sequence[Connection]) -> Coefficients:
    """The coefficients of friction of the joints.

    Raises
        NoSolution - for one that a joint cannot have; with its key
        MissingSection - for those of pins that have no radius, which would have no effect
    """
    for each in connections:
        of_teeth = isinstance(each, Toothed)
        if given.joints.get(each.name) == (0.0 if of_teeth else 1.0):
            allowed = (
                "the efficiency of a mesh must be above 0" if of_teeth else "a coefficient of friction must be below 1"
            )
            raise NoSolution(f"{given.joints[each.name]:g}: {allowed}", key=f"loads.friction.joints.{each.name}")
    pins = (given.joints.get(each.name, given.pins) for each in connections if isinstance(each, Pin))
    if given.pin_radius == 0.0 and any(pins):
        words = "friction of pins needs their radius"
        raise MissingSection(words, key="loads.friction", fix="give loads.friction.pin_radius (mm)")
    joints = dict(given.joints)
    return Coefficients(given.pins, given.guides, given.meshes, given.pin_radius, joints, given.contacts)


class Sources:
    """The forces of a design file on its machine.

    Parameters
        section : the section `loads`
        links : str - names of the links that a file may name
        sliding : str - those that slide, on which a force is a number
    Raises
        NoSolution - for a force on a link that the machine does not have, or of the wrong sort; with its key
    """

    def __init__(self, section: CommonLoads, links: tuple[str, ...], sliding: tuple[str, ...]) -> None:
        self.section = section
        for i, load in enumerate(section.forces):
            _require_link(load.on, links, f"loads.forces[{i}].on")
            _require_sort(load, load.on in sliding, f"loads.forces[{i}]")
        for i, spring in enumerate(section.springs):
            for k, name in enumerate(spring.between):
                _require_link(name, (*links, FRAME), f"loads.springs[{i}].between[{k}]")
            if spring.between[0] == spring.between[1]:
                raise NoSolution("a spring needs two links, or a link and frame", key=f"loads.springs[{i}].between")

    @property
    def any(self) -> bool:
        """Whether there is any force at all."""
        return bool(self.section.forces or self.section.springs)

    @property
    def resisted(self) -> tuple[str, ...]:
        """Links with a resistance, whose force jumps where they turn back."""
        return tuple(load.on for load in self.section.forces if load.resistance)

    def breaks(self) -> list[float]:
        """Input angles in [0, 2 pi) where a zone or a table jumps or bends [rad]."""
        found: set[float] = set()
        for load in self.section.forces:
            for course in (load.torque, load.force):
                if course is not None and not isinstance(course, list):
                    found.update(breaks(course))
        return sorted(found)

    def at(self, mechanism: Mechanism, phi: Reals, sense: float) -> list[Force | Torque]:
        """All of them at input angles [rad]; `sense` is the sign of the input's speed."""
        found = [_load(load, mechanism, phi, sense) for load in self.section.forces]
        for i, spring in enumerate(self.section.springs):
            found.extend(_spring(spring, mechanism, phi, f"loads.springs[{i}]"))
        return found


def _require_link(name: str, known: tuple[str, ...], key: str) -> None:
    if name not in known:
        raise NoSolution(f"this machine has no link {name!r}: it has {', '.join(known)}", key=key)


def _require_sort(load: Load, slides: bool, key: str) -> None:
    if slides and load.torque is not None:
        raise NoSolution(f"{load.on} slides", key=f"{key}.torque", fix="give a force instead of a torque")
    if not slides and load.force is not None and not isinstance(load.force, list):
        raise NoSolution(
            f"{load.on} turns", key=f"{key}.force", fix="give a torque, or a point and a force [x, y] that acts there"
        )


def _load(load: Load, mechanism: Mechanism, phi: Reals, sense: float) -> Force | Torque:
    link, travel = mechanism.links[load.on], mechanism.travel.get(load.on)
    if isinstance(load.force, list):
        place = link.at(vector(load.point or [0.0, 0.0]))
        return Force(load.on, vector(load.force) + np.zeros_like(place.value), place)
    if travel is not None:
        if load.force is not None:
            size = values(load.force, phi)
        else:
            size = (
                -(load.resistance or 0.0)
                * sense
                * sense_of(dot(travel, link.origin.first), dot(travel, link.origin.second))
            )
        return Force(load.on, (size * travel).astype(np.complex128), link.origin)
    if load.torque is not None:
        torque = values(load.torque, phi)
    else:
        torque = -(load.resistance or 0.0) * sense * sense_of(link.turn.first, link.turn.second)
    return Torque(load.on, torque * NEWTON_METER)


def _spring(spring: Spring, mechanism: Mechanism, phi: Reals, key: str) -> Iterator[Force]:
    """The pull on both ends, F0 + c (L - L0) along the line between them."""
    ends = [_end(name, place, mechanism, phi) for name, place in zip(spring.between, spring.points, strict=True)]
    way = ends[1].value - ends[0].value
    length = np.abs(way)
    if not np.all(length > 1e-6):
        raise NoSolution(
            "the length of this spring becomes 0 within the revolution",
            key=f"{key}.points",
            fix="move one of its points",
        )
    pull = (spring.preload + spring.rate * (length - spring.free_length)) * way / length
    for name, end, sign in zip(spring.between, ends, (1.0, -1.0), strict=True):
        if name != FRAME:
            yield Force(name, sign * pull, end)


def _end(name: str, place: list[float], mechanism: Mechanism, phi: Reals) -> Point:
    return fixed(vector(place), phi) if name == FRAME else mechanism.links[name].at(vector(place))
