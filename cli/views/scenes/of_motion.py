"""The scene of any mechanism: its links between their joints, slides and gears, and its first output over the input."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.scenes.scene import (
    BLUE,
    GREEN,
    GREY,
    ORANGE,
    PURPLE,
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
)
from gearlink.core.mechanism.joints import Contact, Guide, Mesh, Pin, Rack
from gearlink.core.mechanism.links import FRAME, Mechanism

if TYPE_CHECKING:
    from gearlink.core.mechanism.motion import Course, Input

_COLORS = (BLUE, GREEN, PURPLE, ORANGE)
_SLIDER = 0.07
"""Of the size of the mechanism: half the width of a slider."""


def build(design: Any, fraction: Reals) -> Scene:
    """Positions over fractions of the loop: straight through a period, there and back over a range."""
    motion = design.moving
    q = inputs(motion.input, fraction)
    now = motion.at(q, 0)
    output = motion.outputs[0]
    whole = np.linspace(motion.input.start, motion.input.end, 361)
    y, here = (_shown(output.course, output.course.rates(motion, each, 0)[0]) for each in (whole, q))
    words = motion.input.column.replace("_", " ")
    unit = " [deg]" if motion.input.unit == "rad" else " [mm]"
    degree = np.degrees if motion.input.unit == "rad" else np.asarray
    measure = "deg" if output.course.unit == "rad" else output.course.unit
    return Scene(
        parts=(*_cams(now), *_gears(now), *_lines(now, motion.at(whole, 0)), *_links(now), *_sliders(now)),
        marks=_marks(now),
        chart=Chart(
            words + unit,
            f"{output.name} [{measure}]",
            degree(whole),
            degree(q),
            (Curve(output.name, BLUE, y, here),),
        ),
        readouts=(
            Readout(words.split()[0], "°" if motion.input.unit == "rad" else " mm", degree(q)),
            Readout(output.name, "°" if measure == "deg" else f" {measure}", here),
        ),
    )


def inputs(given: Input, fraction: Reals) -> Reals:
    """Inputs over fractions of the loop [rad or mm]."""
    if given.turns is not None:
        return np.asarray(given.start + (given.end - given.start) * fraction)
    return np.asarray(given.start + 0.5 * (given.end - given.start) * (1.0 - np.cos(2.0 * math.pi * fraction)))


def _shown(course: Course, values: Reals) -> Reals:
    return np.degrees(values) if course.unit == "rad" else np.asarray(values)


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
    places = np.array([each.at[0] for each in _pins(mechanism)] + [link.origin.value[0] for link in
                                                                     mechanism.links.values()])  # fmt: skip
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


def _marks(mechanism: Mechanism) -> tuple[Mark, ...]:
    """The pins by name; of several on one axis the first."""
    found: dict[complex, Mark] = {}
    for each in _pins(mechanism):
        found.setdefault(complex(each.at[0]), Mark(each.at, each.name, FRAME in (each.first, each.second)))
    return tuple(found.values())
