"""What acts on a machine from outside, from the section `loads` of its file: forces, torques, resistances, springs."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING

import numpy as np

from gearlink.core.base.errors import MissingSection, NoSolution
from gearlink.core.mechanism.dynamics import Force, Mass, Torque
from gearlink.core.mechanism.friction import Coefficients
from gearlink.core.mechanism.joints import NEWTON_METER, Connection, Pin, Toothed
from gearlink.core.mechanism.links import FRAME, Mechanism
from gearlink.core.mechanism.rates import Point, dot, fixed, sense_of
from gearlink.core.numerics.arrays import Reals
from gearlink.core.studies.loads import courses

if TYPE_CHECKING:
    from gearlink.core.studies.loads.spec import Body, CommonLoads, Friction, Load, Spring


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
            allowed = "the efficiency of a mesh lies above 0" if of_teeth else "a coefficient of friction lies below 1"
            raise NoSolution(f"{given.joints[each.name]:g}: {allowed}", key=f"loads.friction.joints.{each.name}")
    pins = (given.joints.get(each.name, given.pins) for each in connections if isinstance(each, Pin))
    if given.pin_radius == 0.0 and any(pins):
        words = "friction of pins acts at their radius"
        raise MissingSection(words, key="loads.friction", fix="give loads.friction.pin_radius (mm)")
    return Coefficients(given.pins, given.guides, given.meshes, given.pin_radius, dict(given.joints))


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
                    found.update(courses.breaks(course))
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
            size = courses.values(load.force, phi)
        else:
            size = (
                -(load.resistance or 0.0)
                * sense
                * sense_of(dot(travel, link.origin.first), dot(travel, link.origin.second))
            )
        return Force(load.on, (size * travel).astype(np.complex128), link.origin)
    if load.torque is not None:
        torque = courses.values(load.torque, phi)
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
            "this spring has no length somewhere in the turn", key=f"{key}.points", fix="move one of its points"
        )
    pull = (spring.preload + spring.rate * (length - spring.free_length)) * way / length
    for name, end, sign in zip(spring.between, ends, (1.0, -1.0), strict=True):
        if name != FRAME:
            yield Force(name, sign * pull, end)


def _end(name: str, place: list[float], mechanism: Mechanism, phi: Reals) -> Point:
    return fixed(vector(place), phi) if name == FRAME else mechanism.links[name].at(vector(place))
