"""The parts of a machine: moving links and their connections.

Lengths in mm, angles in rad; `FRAME` denotes the frame.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, Any, TypeVar

import numpy as np

from gearlink.core.mechanism.rates import Point, Turn, carried
from gearlink.core.numerics.arrays import Points, Reals, units

if TYPE_CHECKING:
    from gearlink.core.mechanism.joints import Connection

FRAME = "frame"
T = TypeVar("T")


@dataclass(frozen=True)
class Link:
    """A link in motion: its origin, which is its first joint, the direction of its x axis, and named points [mm]."""

    origin: Point
    turn: Turn
    points: Mapping[str, complex] = field(default_factory=dict)

    @cached_property
    def unit(self) -> Points:
        """e^(i t)."""
        return units(self.turn.value)

    def at(self, place: complex | str) -> Point:
        """A point given by its name or in link coordinates [mm], computed once."""
        arm: Any = self.points[place] if isinstance(place, str) else place
        if isinstance(arm, np.ndarray):  # of many designs
            return carried(self.origin, self.turn, arm, self.unit)
        if arm not in self._points:
            self._points[arm] = carried(self.origin, self.turn, arm, self.unit)
        return self._points[arm]

    @cached_property
    def _points(self) -> dict[complex, Point]:
        return {}


class Later(Sequence[T]):
    """Joints that are made when first looked at: tables, animations and sheets need the links alone."""

    def __init__(self, make: Callable[[], Sequence[T]]) -> None:
        self._make = make

    @cached_property
    def _made(self) -> Sequence[T]:
        return self._make()

    def __getitem__(self, index: Any) -> Any:
        return self._made[index]

    def __len__(self) -> int:
        return len(self._made)


@dataclass(frozen=True)
class Mechanism:
    """A machine at an array of input angles.

    Fields
        links : by name, in the order of the machine
        connections : what joins them, in many machines made when first looked at
        drive : str - link that the input torque acts on, or the connection that drives (`gain` then says how)
        sense : float - +1 where that link turns with the input, -1 where against it
        pivot : complex [mm] - about which the frame's moment is taken
        travel : direction in which a link slides, for a force given as a number
        gain : (N,) array [mm] - input torque by the force of the connection `drive`; None for a couple
    """

    links: Mapping[str, Link]
    connections: Sequence[Connection]
    drive: str
    sense: float = 1.0
    pivot: complex = 0j
    travel: Mapping[str, complex] = field(default_factory=dict)
    gain: Reals | None = None

    @cached_property
    def rows(self) -> int:
        """How many input angles."""
        return len(next(iter(self.links.values())).turn.value)

    @cached_property
    def _worked_out(self) -> dict[str, Any]:
        return {}

    def once(self, what: str, make: Callable[[], T]) -> T:
        """A result computed from these links once and stored with them by its name."""
        if what not in self._worked_out:
            self._worked_out[what] = make()
        found: T = self._worked_out[what]
        return found

    def link(self, name: str) -> Link | None:
        """A link by name, None for the frame."""
        return None if name == FRAME else self.links[name]


def rates(mechanism: Mechanism, first: str, second: str, order: int = 1) -> Reals:
    """Turning of the second link against the first, per input angle: t_j' - t_i', or its derivative (order 2)."""

    def rate(name: str) -> Reals | float:
        link = mechanism.link(name)
        return 0.0 if link is None else link.turn.derivative(order)

    return np.asarray(rate(second) - rate(first) + np.zeros(mechanism.rows))
