"""The scene of a machine: all members side by side on one machine angle, each as large as its place allows."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.scenes.colors import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, RED, SKY
from gearlink.cli.views.scenes.loops import builder
from gearlink.cli.views.scenes.scene import (
    Arrow,
    Body,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Part,
    Points,
    Readout,
    Reals,
    Scene,
    loop,
    track,
)

if TYPE_CHECKING:
    from gearlink.core.machines.machine.design import Machine
    from gearlink.core.machines.machine.series import OnShaft

_COLORS = (BLUE, ORANGE, GREEN, PURPLE, RED, SKY, GREY, BLACK)
_CELL = 100.0
"""Width of the place of a member, and its height; what it shows is scaled into nine tenths of it."""
_WIDE = 1.7
"""Places beside each other over those one above the other."""


def build(design: Machine, fraction: Reals) -> Scene:
    """Positions over fractions of the cycle of the machine."""
    names = list(design.spec.members)
    columns = max(1, math.ceil(math.sqrt(_WIDE * len(names))))
    parts: list[Part] = []
    marks: list[Mark] = []
    for i, name in enumerate(names):
        corner = _CELL * complex(i % columns, -(i // columns))
        own = _own(design, name, fraction)
        parts += [_moved(part, *_fit(own, corner)) for part in own.parts]
        scale, shift = _fit(own, corner)
        marks += [Mark(track(scale * mark.point + shift, fraction), "", pivot=True) for mark in own.marks if mark.pivot]
        marks.append(Mark(track(corner + complex(0.5, 0.96) * _CELL, fraction), name))
    now = {name: _shown(design, name, 360.0 * design.cycle_turns * fraction) for name in names}
    degrees = 360.0 * design.cycle_turns * fraction
    readouts = [Readout("machine", "°", degrees), *(Readout(name, unit, y) for name, (y, unit) in now.items())]
    return Scene(parts=tuple(parts), marks=tuple(marks), chart=_chart(design, degrees), readouts=tuple(readouts))


def _own(design: Machine, name: str, fraction: Reals) -> Scene:
    """The scene of a member where its own input stands."""
    member = design.members[name]
    angle = 2.0 * math.pi * design.cycle_turns * fraction - math.radians(design.phases[design.spec.root(name)])
    return builder(member.design.kind)(member.design, _fraction(member, angle))


def _fraction(member: OnShaft, angle: Reals) -> Reals:
    """Fractions of the loop of a member: over a range it goes forth and back as a cosine."""
    given = member.motion.input
    share = (member.reduced(member.input(angle, 0)[0])[0] - given.start) / (given.end - given.start)
    if member.period is not None:
        return np.asarray(share)
    return np.asarray(np.arccos(1.0 - 2.0 * share) / (2.0 * math.pi))


def _fit(own: Scene, corner: complex) -> tuple[float, complex]:
    """Scale and shift that bring a scene into its place."""
    ends = np.concatenate([_ends(part) for part in own.parts])
    low = complex(ends.real.min(), ends.imag.min())
    size = complex(ends.real.max(), ends.imag.max()) - low
    scale = 0.88 * _CELL / max(size.real, size.imag)
    return scale, corner + 0.5 * complex(_CELL, 0.94 * _CELL) - scale * (low + 0.5 * size)


def _ends(part: Part) -> Points:
    """Points as far out as a part ever reaches."""
    if isinstance(part, Line):
        return part.points
    if isinstance(part, Chain):
        return np.concatenate([np.asarray(joint) for joint in part.joints])
    if isinstance(part, Arrow):
        return np.concatenate([part.start, part.start + part.vector])
    outline = np.asarray(part.outline)
    if part.repeats == 0 or np.ptp(part.turn) > math.pi:
        reach = float(np.abs(outline).max()) if outline.size else 0.0
        return np.concatenate([part.place + reach * corner for corner in (1.0, -1.0, 1j, -1j)])
    placed = np.asarray(part.place)[:, None] + outline[None, :] * np.exp(1j * np.asarray(part.turn))[:, None]
    return np.asarray(placed.ravel())


def _moved(part: Part, scale: float, shift: complex) -> Part:
    if isinstance(part, Line):
        return replace(part, points=scale * part.points + shift, name="")
    if isinstance(part, Chain):
        return replace(part, joints=tuple(scale * joint + shift for joint in part.joints), width=0.7 * part.width)
    if isinstance(part, Arrow):
        return replace(part, start=scale * part.start + shift, vector=scale * part.vector)
    body: Body = replace(part, outline=scale * part.outline, place=scale * part.place + shift, pitch=scale * part.pitch)
    return replace(body, label="", name="")


def _shown(design: Machine, name: str, degrees: Reals) -> tuple[Reals, str]:
    """The output of a member at machine angles, in mm or deg."""
    member: Any = design.members[name]
    value = member.rates(np.radians(degrees - design.phases[design.spec.root(name)]), 0)[0]
    return (np.degrees(value), "°") if member.course.unit == "rad" else (value, " mm")


def _chart(design: Machine, degrees: Reals) -> Chart:
    """The output of every member as a share of its own range."""
    whole = 360.0 * design.cycle_turns * loop(361)
    curves = []
    for i, name in enumerate(design.spec.members):
        y, now = _shown(design, name, whole)[0], _shown(design, name, degrees)[0]
        low, span = float(y.min()), float(np.ptp(y)) or 1.0
        curves.append(Curve(name, _COLORS[i % len(_COLORS)], (y - low) / span, (now - low) / span))
    return Chart("machine angle [deg]", "share of the range [1]", whole, degrees, tuple(curves))
