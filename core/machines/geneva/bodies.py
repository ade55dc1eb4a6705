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
        pin, locking : float [mm] - radii of pin and locking disc
    Source
        own derivation: the wheel's arc and the disc are the same circle about the crank's axis in the dwell
    """

    drive: Geneva
    pin: float
    locking: float

    @property
    def tip(self) -> float:
        """Wheel axis to the corners of a slot's mouth [mm]."""
        return math.hypot(self.drive.wheel, self.pin)

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
        if self.depth <= 0.0:
            return 0.0
        distance, tip = self.drive.distance, self.tip
        if self.locking >= distance + tip:  # the disc holds the whole circle
            return math.pi
        return math.acos((distance**2 + tip**2 - self.locking**2) / (2.0 * distance * tip))

    def wheel_half(self) -> list[Piece]:
        """From the bottom of a slot on the x axis to the middle between two slots.

        Raises
            NoSolution - where slots run into each other, or the locking arcs reach their bottoms
        """
        drive, s, pin = self.drive, self.drive.sign, self.pin
        bottom, mouth, middle = drive.distance - s * drive.crank, drive.wheel, math.pi / drive.slots
        axis, corner = cmath.rect(drive.distance, middle), math.asin(pin / self.tip)
        if corner >= middle:
            widest = drive.wheel * math.tan(middle)
            message = f"slots for a pin of radius {short(pin)} mm run into each other at their mouths"
            raise NoSolution(message, key="pin_radius", fix=f"choose pin_radius below {safely_below(widest)} mm")
        arc_from = middle - self._arc_half
        if arc_from < corner:  # no lip: the arc cuts the wall of the slot
            mouth -= s * math.sqrt(self.locking**2 - (drive.crank - pin) ** 2)
            if s * (mouth - bottom) <= 0.0:
                most = math.hypot(drive.crank - pin, drive.wheel - bottom)
                message = f"the locking arc of radius {short(self.locking)} mm reaches the bottoms of the slots"
                fix = f"choose locking_radius below {safely_below(most)} mm"
                raise NoSolution(message, key="locking_radius", fix=fix)
        pieces = [
            Piece("bottom", lambda t: complex(bottom) - complex(s * pin) * units(-s * t), 0.0, 0.5 * math.pi),
            Piece("slot", partial(_straight, complex(bottom, pin), complex(mouth, pin)), 0.0, 1.0),
        ]
        start = complex(mouth, pin)
        if arc_from >= corner:
            pieces.append(Piece("tip circle", lambda t: self.tip * units(t), corner, arc_from))
            start = cmath.rect(self.tip, arc_from)
        if self.depth > 0.0:
            inward = -s * cmath.rect(1.0, middle)
            turn = cmath.phase((start - axis) / inward)
            arc = Piece("locking arc", lambda t: axis + self.locking * inward * units(turn * (1.0 - t)), 0.0, 1.0)
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
        lip = np.linspace(math.asin(self.pin / self.tip), math.pi / drive.slots - self._arc_half, _PLACES)
        lips = self.tip * units(np.concatenate([lip, -lip]))
        turn = (math.pi if s > 0.0 else 0.0) - s * drive.rates(f, 0)[0]
        return np.asarray(((s * drive.distance + lips * units(turn)) * units(-f)).ravel())


def _turned(curve: Callable[[Reals], Points], unit: complex, parameter: Reals) -> Points:
    return unit * curve(parameter)


def _straight(start: complex, end: complex, parameter: Reals) -> Points:
    return np.asarray(start + parameter * (end - start), dtype=np.complex128)
