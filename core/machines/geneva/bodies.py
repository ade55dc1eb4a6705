"""Outlines of a Geneva drive: the slotted wheel, and the locking disc of the crank with a cut-out for each pin."""

from __future__ import annotations

import cmath
import math
from collections.abc import Callable
from dataclasses import dataclass
from functools import cached_property, partial
from typing import NamedTuple

import numpy as np

from gearlink.core.base.errors import NoSolution
from gearlink.core.base.report import safely_below
from gearlink.core.base.wording import short
from gearlink.core.machines.geneva.mechanism import Geneva
from gearlink.core.mechanism.motion import TURN
from gearlink.core.numerics.arrays import Points, Reals, units

_INSTANTS, _PLACES = 721, 33
_INSIDE = 1e-9
"""Share of the locking radius by which a point of the wheel has to lie inside the disc to count."""


class Piece(NamedTuple):
    """A smooth piece of an outline: its name, points over a parameter, and the range of that."""

    name: str
    curve: Callable[[Reals], Points]
    low: float
    high: float


@dataclass(frozen=True)
class Outlines:
    """Wheel and driver of a drive.

    Fields
        drive : Geneva
        slot : float [mm] - half the width of a slot
        locking, hollow : float [mm] - radii of the locking disc, and of the wheel's locking arcs
    Source
        own derivation: the wheel's arc and the disc are circles about the crank's axis in the dwell
    """

    drive: Geneva
    slot: float
    locking: float
    hollow: float

    @property
    def tip(self) -> float:
        """Wheel axis to the corners of a slot's mouth [mm]."""
        return math.hypot(self.drive.wheel, self.slot)

    @property
    def depth(self) -> float:
        """How deep the locking disc reaches into the circle through the corners [mm]; at 0 it holds nothing."""
        return self.locking - abs(self.drive.distance - self.tip)

    @property
    def edge(self) -> complex:
        """Where a locking arc of the driver ends, the pin on the x axis [mm]."""
        return cmath.rect(self.locking, self.drive.half)

    @property
    def _arc_half(self) -> float:
        """Half of the wheel's angle that its locking arc takes of the circle through the corners [rad].

        Raises
            NoSolution - where the disc covers the whole wheel
        """
        distance, tip = self.drive.distance, self.tip
        if self.hollow <= abs(distance - tip):
            return 0.0
        if self.hollow >= distance + tip:  # the disc holds the whole circle
            return math.pi
        return _seen(distance, tip, self.hollow)

    @property
    def play(self) -> float | None:
        """Angle that the wheel can turn in the middle of the dwell, from one side of the disc to the other [rad].

        The corner of its arc, or the edge of the disc if that is nearer to the line of centres, stands at d from the
        wheel's axis: 2 (acos((a^2 + d^2 - h^2)/(2 a d)) - acos((a^2 + d^2 - l^2)/(2 a d))), h and l the radii of arc
        and disc; to first order 2 (h - l)/(a sin t), t from the line of centres at the crank's axis. None where the
        disc holds nothing.
        """
        drive, a, radius = self.drive, self.drive.distance, self.locking
        end = 0.5 * TURN / drive.pins - drive.half
        if self.depth <= 0.0 or end <= _INSIDE or self.hollow >= a + self.tip:
            return None
        away = math.sqrt(a * a + radius * radius - 2.0 * drive.sign * a * radius * math.cos(end))
        if drive.sign > 0.0 and _seen(a, self.hollow, self.tip) < end:
            away = self.tip
        if self.hollow >= a + away:  # the edge of the disc comes to no side of the arc
            return None
        return 2.0 * (_seen(a, away, self.hollow) - _seen(a, away, radius))

    def wheel_half(self) -> list[Piece]:
        """From the bottom of a slot on the x axis to the middle between two slots.

        Raises
            NoSolution - where slots run into each other, or the locking arcs reach their bottoms
        """
        drive, s, wide = self.drive, self.drive.sign, self.slot
        bottom, mouth, middle = drive.distance - s * drive.crank, drive.wheel, math.pi / drive.slots
        axis, corner = cmath.rect(drive.distance, middle), math.asin(wide / self.tip)
        if corner >= middle:
            widest = drive.wheel * math.tan(middle)
            message = f"slots {short(2.0 * wide)} mm wide run into each other at their mouths"
            raise NoSolution(message, key="pin_radius", fix=f"choose pin_radius below {safely_below(widest)} mm")
        arc_from = middle - self._arc_half
        if arc_from < corner:  # no lip: the arc cuts the wall of the slot
            mouth -= s * math.sqrt(self.hollow**2 - (drive.crank - wide) ** 2)
            if s * (mouth - bottom) <= 0.0:
                most = math.hypot(drive.crank - wide, drive.wheel - bottom)
                message = f"the locking arc of radius {short(self.hollow)} mm reaches the bottoms of the slots"
                fix = f"choose locking_radius below {safely_below(most)} mm"
                raise NoSolution(message, key="locking_radius", fix=fix)
        pieces = [
            Piece("bottom", lambda t: complex(bottom) - complex(s * wide) * units(-s * t), 0.0, 0.5 * math.pi),
            Piece("slot", partial(_straight, complex(bottom, wide), complex(mouth, wide)), 0.0, 1.0),
        ]
        start = complex(mouth, wide)
        if arc_from >= corner:
            pieces.append(Piece("tip circle", lambda t: self.tip * units(t), corner, arc_from))
            start = cmath.rect(self.tip, arc_from)
        if self._arc_half > 0.0:
            inward = -s * cmath.rect(1.0, middle)
            turn = cmath.phase((start - axis) / inward)
            arc = Piece("locking arc", lambda t: axis + self.hollow * inward * units(turn * (1.0 - t)), 0.0, 1.0)
            pieces.append(arc)
        return pieces

    def driver(self) -> list[Piece]:
        """The locking disc, counter-clockwise from the cut-out of the pin on the x axis."""
        drive, half, pitch = self.drive, self.drive.half, TURN / self.drive.pins
        cut, pieces = self._cut(), []
        for k in range(drive.pins):
            pieces.append(Piece("cut-out", partial(_turned, cut, cmath.rect(1.0, k * pitch)), 0.0, 1.0))
            if pitch - 2.0 * half > _INSIDE:
                pieces.append(
                    Piece("locking arc", lambda t: self.locking * units(t), k * pitch + half, (k + 1) * pitch - half)
                )
        return pieces

    def _cut(self) -> Callable[[Reals], Points]:
        """The cut-out, an arc from edge to edge through its vertex."""
        end, vertex = self.edge, self.cut_vertex
        half = math.pi - 2.0 * cmath.phase(end - vertex)  # at the arc's centre, by the chord from vertex to edge
        if abs(half) < _INSIDE:
            return partial(_straight, end.conjugate(), end)
        radius = end.imag / math.sin(half)
        return lambda t: complex(vertex + radius) - complex(radius) * units(-half * (2.0 * t - 1.0))

    @property
    def cut_vertex(self) -> float:
        """Where the cut-out crosses the pin's radius, from the crank's axis [mm].

        The textbook's arc (a - wheel) locking/r of an external drive, the chord of an internal one, unless the wheel
        comes nearer on its way: then the arc that just lets it pass.
        """
        drive, end = self.drive, self.edge
        usual = (drive.distance - drive.wheel) * self.locking / drive.crank if drive.sign > 0.0 else end.real
        near = self._passing
        near = near[np.abs(near) < self.locking * (1.0 - _INSIDE)]
        if drive.sign > 0.0:  # what lies beyond the edges is the overlap
            near = near[np.abs(np.angle(near)) < drive.half - _INSIDE]
        if near.size == 0:
            return usual
        # arcs over a chord are the places of equal angle at which it is seen
        seen = np.angle((end - near) / (end.conjugate() - near)) % TURN
        return min(usual, float(np.min(end.real - end.imag / np.tan(0.5 * seen))))

    @property
    def overlap(self) -> float:
        """How far a lip beside a slot reaches, on its way, into the disc at the edges of its arc [mm]; 0: not at all.

        The lips of an internal wheel pass far from the edges.
        """
        if self.drive.sign < 0.0:
            return 0.0
        near = self._passing
        into = self.locking * (1.0 - _INSIDE) - np.abs(near)
        beyond = np.abs(near) * (np.abs(np.angle(near)) - self.drive.half)
        return float(np.max(np.minimum(into, beyond), initial=0.0))

    @cached_property
    def _passing(self) -> Points:
        """Points of the lips beside a slot while its pin drives them, seen from the crank, the pin on the x axis."""
        drive, s = self.drive, self.drive.sign
        f = np.linspace(-drive.half, drive.half, _INSTANTS)[:, None]
        lip = np.linspace(math.asin(self.slot / self.tip), math.pi / drive.slots - self._arc_half, _PLACES)
        lips = self.tip * units(np.concatenate([lip, -lip]))
        turn = (math.pi if s > 0.0 else 0.0) - s * drive.rates(f, 0)[0]
        return np.asarray(((s * drive.distance + lips * units(turn)) * units(-f)).ravel())


def _seen(one: float, other: float, opposite: float) -> float:
    """Angle of a triangle between two sides [rad]."""
    return math.acos((one * one + other * other - opposite * opposite) / (2.0 * one * other))


def _turned(curve: Callable[[Reals], Points], unit: complex, parameter: Reals) -> Points:
    return unit * curve(parameter)


def _straight(start: complex, end: complex, parameter: Reals) -> Points:
    return np.asarray(start + parameter * (end - start), dtype=np.complex128)
