"""The scene of any mechanism: its links between their joints, slides and gears, and its first output over the input."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property, partial
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.cli.views.scenes.scene import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
    Band,
    Body,
    Chain,
    Chart,
    Curve,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    circle,
    pale,
    track,
)
from gearlink.core.mechanism.joints import Contact, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME, Mechanism

if TYPE_CHECKING:
    from gearlink.core.mechanism.motion import Course, Input, Motion

_COLORS = (BLUE, GREEN, PURPLE, ORANGE)
_SLIDER = 0.07
"""Of the size of the mechanism: half the width of a slider."""


class Seen(NamedTuple):
    """What moves in the end, as a chart and the values beside a picture show it."""

    course: Course
    color: str
    unit: str = "deg"

    def at(self, motion: Motion, q: Reals) -> Reals:
        """Values at inputs [deg or mm]."""
        values = self.course.rates(motion, q, 0)[0]
        return np.degrees(values) if self.unit == "deg" else np.asarray(values)


@dataclass(frozen=True)
class Positions:
    """The links of a motion where a scene shows them.

    Fields
        inputs : (N,) array [rad or mm]
    """

    motion: Motion
    inputs: Reals

    @classmethod
    def of(cls, design: Any, fraction: Reals) -> Positions:
        """Over fractions of the loop: straight through a period, there and back over a range."""
        return cls(design.moving, inputs(design.moving.input, fraction))

    @cached_property
    def now(self) -> Mechanism:
        """The links at the positions."""
        return self.motion.at(self.inputs, 0)

    def at(self, link: str, point: complex | str = 0j) -> Points:
        """The track of a point of a link, or of the frame [mm]."""
        return track(point, self.inputs) if link == FRAME else self.now.links[link].at(point).value

    def turn(self, link: str) -> Reals:
        """Angles of a link, 0 of the frame [rad]."""
        return np.zeros(self.inputs.shape) if link == FRAME else self.now.links[link].turn.value

    @cached_property
    def whole(self) -> Positions:
        """From the start of the loop to its end, as charts and paths show it."""
        given = self.motion.input
        return Positions(self.motion, np.linspace(given.start, given.end, 361))

    def body(self, link: str, outline: Points, color: str, share: float = 0.25, **look: Any) -> Body:
        """An outline on a link, filled with a share of its colour."""
        fill = pale(color, share) if share else ""
        return Body(outline=outline, place=self.at(link), turn=self.turn(link), color=color, **{"fill": fill} | look)

    @cached_property
    def marks(self) -> tuple[Mark, ...]:
        """The pins by name; of several on one axis the first."""
        found: dict[complex, Mark] = {}
        for each in _pins(self.now):
            found.setdefault(complex(each.at[0]), Mark(each.at, each.name, FRAME in (each.first, each.second)))
        return tuple(found.values())

    @property
    def chain(self) -> Chain:
        """The links of a mechanism whose pins follow each other."""
        return Chain(joints=tuple(mark.point for mark in self.marks))

    def scene(
        self,
        parts: Sequence[Part],
        seen: Mapping[str, Seen],
        ylabel: str,
        *,
        over: str = "",
        marked: tuple[Band, ...] = (),
        marks: tuple[Mark, ...] | None = None,
        values: Mapping[str, tuple[str, Reals]] | None = None,
    ) -> Scene:
        """The scene with these parts, and its chart over the input.

        Parameters
            seen : what the chart shows, by the words of each curve
            over : words of the input, where they are not those of its column
            marked : stretches of the chart
            marks : letters, where they are not those of the pins
            values : units and values beside the picture by their words, where they are not those of the curves
        """
        given = self.motion.input
        words = over or given.column.replace("_", " ")
        unit, sign = ("deg", "°") if given.unit == "rad" else ("mm", " mm")
        degree = np.degrees if given.unit == "rad" else np.asarray
        whole = self.whole.inputs
        curves = tuple(
            Curve(name, each.color, each.at(self.motion, whole), each.at(self.motion, self.inputs))
            for name, each in seen.items()
        )
        if values is None:
            units = ("°" if each.unit == "deg" else f" {each.unit}" for each in seen.values())
            values = {curve.label: (each, curve.now) for curve, each in zip(curves, units, strict=True)}
        chart = Chart(f"{words} [{unit}]", ylabel, degree(whole), degree(self.inputs), curves, marked)
        told = {words.split()[0]: (sign, degree(self.inputs)), **values}
        return Scene(
            parts=tuple(parts),
            marks=self.marks if marks is None else marks,
            chart=chart,
            readouts=tuple(Readout(name, each, track) for name, (each, track) in told.items()),
        )


@dataclass(frozen=True)
class Frame:
    """Where a scene has what a motion has: z -> turn z + shift.

    Fields
        inputs : function of fractions of the loop - inputs of the motion
        motion : that of the design, or the one of which its scene is drawn where the file leaves places free
    """

    inputs: Callable[[Reals], Reals]
    motion: Motion
    turn: complex = 1.0
    shift: complex = 0.0

    def at(self, points: Points) -> Points:
        """Points of the motion in the scene."""
        return np.asarray(self.along(points) + self.shift)

    def back(self, shift: complex) -> complex:
        """A direction of the scene in the motion."""
        return shift / self.turn

    def along(self, vector: Points) -> Points:
        """Directions of the motion in the scene."""
        return np.asarray(self.turn * vector)


def frame(design: Any) -> Frame:
    """Where scenes stand that show their motion as it is."""
    return Frame(partial(inputs, design.moving.input), design.moving)


def build(design: Any, fraction: Reals) -> Scene:
    """The scene of a motion: cams, gears, slots, links and slides, and its first output over the input."""
    here = Positions.of(design, fraction)
    now, whole = here.now, here.whole.now
    name, course, _ = here.motion.outputs[0]
    measure = "deg" if course.unit == "rad" else course.unit
    parts = (*_cams(now), *_gears(now), *_lines(now, whole), *_links(now), *_sliders(now))
    return here.scene(parts, {name: Seen(course, BLUE, measure)}, f"{name} [{measure}]")


def inputs(given: Input, fraction: Reals) -> Reals:
    """Inputs over fractions of the loop [rad or mm]."""
    if given.turns is not None:
        return np.asarray(given.start + (given.end - given.start) * fraction)
    return np.asarray(given.start + 0.5 * (given.end - given.start) * (1.0 - np.cos(2.0 * math.pi * fraction)))


def _pins(mechanism: Mechanism) -> list[Pin]:
    return [each for each in mechanism.connections if isinstance(each, Pin)]


def _links(mechanism: Mechanism) -> list[Part]:
    """Each link between its pins: a bar, or a plate where there are three and more."""
    found: list[Part] = []
    for number, (name, link) in enumerate(mechanism.links.items()):
        places = [each.at for each in _pins(mechanism) if name in (each.first, each.second)]
        places += [link.at(point).value for point in link.points]
        distinct: list[Points] = []
        for place in places:
            if all(abs(complex(place[0] - other[0])) > 1e-9 for other in distinct):
                distinct.append(place)
        if len(distinct) == 2:
            found.append(Chain(joints=tuple(distinct)))
        elif len(distinct) > 2:
            color = _COLORS[number % len(_COLORS)]
            arms = [(place[0] - link.origin.value[0]) / link.unit[0] for place in distinct]
            outline = np.array([*arms, arms[0]])
            found.append(Body(outline=outline, place=link.origin.value, turn=link.turn.value, color=color,
                              fill=pale(color, 0.2), width=2.0))  # fmt: skip
    return found


def _cams(mechanism: Mechanism) -> list[Part]:
    """Cams with the roller or face that each moves."""
    found: list[Part] = []
    for each in mechanism.connections:
        if isinstance(each, Contact) and each.shapes is not None:
            for name, outline, title in zip((each.first, each.second), each.shapes(), (each.name, ""), strict=True):
                link = mechanism.links[name]
                color = GREEN if title else BLUE
                found.append(Body(outline=outline, place=link.origin.value, turn=link.turn.value, color=color,
                                  fill=pale(color, 0.15), width=1.6, name=title))  # fmt: skip
    return found


def _size(mechanism: Mechanism) -> float:
    """Of all that stands at the first position [mm]."""
    origins = [link.origin.value[0] for link in mechanism.links.values()]
    places = np.array([each.at[0] for each in _pins(mechanism)] + origins)
    return float(max(np.ptp(places.real), np.ptp(places.imag), 1e-9))


def _sliders(mechanism: Mechanism) -> list[Part]:
    half = _SLIDER * _size(mechanism)
    found: list[Part] = []
    for each in mechanism.connections:
        if isinstance(each, Guide):
            turn = np.broadcast_to(np.angle(each.along), each.at.shape).astype(np.float64)
            corners = half * np.array([1.5 + 1j, -1.5 + 1j, -1.5 - 1j, 1.5 - 1j, 1.5 + 1j])
            found.append(Body(outline=corners, place=each.at, turn=turn, color=BLUE, fill=pale(BLUE, 0.3), width=1.5))
    return found


def _lines(mechanism: Mechanism, whole: Mechanism) -> list[Part]:
    """Slots and pitch lines of racks, as far as they are used over all inputs; a slot from its link's own origin on."""
    found: list[Part] = []
    for each, over in zip(mechanism.connections, whole.connections, strict=True):
        if isinstance(over, Contact) and isinstance(each, Contact) and over.shapes is None:
            places, along, color = over.at, -1j * over.normal, ORANGE
        elif isinstance(over, Rack):
            places, along, color = over.pitch_point, np.broadcast_to(over.along, over.center.shape), GREY
        else:
            continue
        link, run = mechanism.link(each.first), whole.link(each.first)
        seen = places if run is None else (places - run.origin.value) / run.unit
        way = along[0] if run is None else along[0] / run.unit[0]
        order = np.argsort((np.conj(way) * seen).real)
        ends = seen[order[[0, -1]]]
        if isinstance(over, Rack):
            outline = ends + over.mate_radius * way * np.array([-1.0, 1.0])
        elif run is None:
            outline = ends
        else:
            outline = np.array([0j, ends[np.argmin(np.abs(ends))], ends[np.argmax(np.abs(ends))]])
        still = np.zeros(mechanism.rows)
        origin, turn = (still + 0j, still) if link is None else (link.origin.value, link.turn.value)
        found.append(Body(outline=outline, place=origin, turn=turn, color=color, width=2.5, name=each.name))
        if isinstance(each, Contact):
            found.append(_block(each, _SLIDER * _size(mechanism)))
    return found


def _block(slot: Contact, half: float) -> Part:
    """The block about the pin of a slot."""
    square = 0.5 * half * np.array([1 + 1j, -1 + 1j, -1 - 1j, 1 - 1j, 1 + 1j])
    turn = np.asarray(np.angle(-1j * slot.normal), dtype=np.float64)
    return Body(outline=square, place=slot.at, turn=turn, color=BLUE, fill=pale(BLUE, 0.3), width=1.2, name=slot.name)


def _gears(mechanism: Mechanism) -> list[Part]:
    """Pitch circles, each with a spoke that shows how far it has turned."""
    found: dict[str, Part] = {}
    for each in mechanism.connections:
        if isinstance(each, Mesh):
            sign = -1.0 if each.internal else 1.0
            far = each.center + (each.radius + sign * each.mate_radius) * each.toward
            for name, center, radius in ((each.first, each.center, each.radius), (each.second, far, each.mate_radius)):
                found.setdefault(name, _disc(mechanism, name, center, radius))
        elif isinstance(each, Rack):
            found.setdefault(each.second, _disc(mechanism, each.second, each.center, each.mate_radius))
    return list(found.values())


def _disc(mechanism: Mechanism, name: str, center: Points, radius: float) -> Body:
    link = mechanism.link(name)
    turn = np.zeros(center.shape) if link is None else link.turn.value
    outline = np.concatenate([[0.0], circle(radius)])
    color = GREY if link is None else ORANGE
    return Body(outline=outline, place=np.asarray(center), turn=turn, color=color, fill=pale(color, 0.25), name=name)
