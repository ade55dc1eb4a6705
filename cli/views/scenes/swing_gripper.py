"""The swing gripper: one revolution of the cylinder shaft, a sheet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, NamedTuple

import numpy as np

from gearlink.cli.views.scenes.cams import disc_cam
from gearlink.cli.views.scenes.colors import BLACK, BLUE, GREY, ORANGE, PHASE_TINTS, RED, pale
from gearlink.cli.views.scenes.scene import (
    TURN,
    Band,
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
    bands,
    circle,
    letters,
    loop,
    track,
    wheel,
)
from gearlink.core.machines.swing_gripper.mechanism import without_cams

if TYPE_CHECKING:
    from gearlink.core.machines.swing_gripper.design import SwingGripper

_CAM_COLORS = (BLUE, RED)


def build(design: SwingGripper, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    degrees = 360.0 * fraction
    at = _positions(design, degrees)
    a, e = at.a, at.e
    path = _positions(design, np.linspace(0.0, design.law.starts[3], 121)).f
    arms = at.d - at.e
    turn, plate = np.unwrap(np.angle(arms)), np.array([0.0, 1.0, (at.f[0] - e[0]) / arms[0], 0.0]) * abs(arms[0])
    parts: list[Part] = [
        Line(points=path, color=ORANGE, width=2.0, name="path of the sheet's edge"),
        *_drum(design, fraction),
        *_cams(design, fraction),
        Body(outline=plate, place=e, turn=turn, color=BLACK, fill=pale(BLACK, 0.12), width=0.5),
        Chain(joints=(a, at.c, at.d, e), color=BLUE),
        Chain(joints=(at.d, e, at.f)),
    ]
    return Scene(
        parts=tuple(parts),
        marks=(
            *letters("AE", A=a, C=at.c, D=at.d, E=e, F=at.f),
            Mark(track(drum_center(design), fraction), pivot=True),
        ),
        chart=_chart(design, degrees),
        readouts=_readouts(design, degrees),
    )


class _Positions(NamedTuple):
    """Joints of linkage and arm [mm]."""

    a: Points
    c: Points
    d: Points
    e: Points
    f: Points


def _positions(design: SwingGripper, degrees: Reals) -> _Positions:
    links = without_cams(design).at(np.radians(degrees), 0).links
    pins = (("input", "A"), ("input", "C"), ("output", "D"), ("output", "E"), ("output", "F"))
    return _Positions(*(links[link].at(pin).value for link, pin in pins))


def drum_center(design: SwingGripper) -> complex:
    """Axis of the drum: as the file has it, or where the handover wants it."""
    given = design.spec.cylinder.center
    return complex(*given) if given else design.handover_center


def _drum(design: SwingGripper, fraction: Reals) -> list[Part]:
    """The drum that takes the sheet over, with its grippers where the tip meets them at the handover."""
    spec = design.spec
    center = drum_center(design)
    meeting = complex(_positions(design, np.array([design.motion.handover])).f[0])
    radius = spec.cylinder.radius
    way = (meeting - center) / abs(meeting - center)
    turn = -spec.swing_sense * (TURN * fraction - math.radians(design.motion.handover))
    pad = radius * way * np.array([0.86, 1.0])
    shared = {"place": track(center, fraction), "turn": turn, "color": GREY}
    return [
        Body(
            outline=circle(radius, 144),
            repeats=0,
            fill=pale(GREY, 0.1),
            label="drum",
            name=f"drum, radius {radius:g} mm",
            **shared,  # type: ignore[arg-type]
        ),
        Body(outline=pad, width=5.0, **{**shared, "color": RED}),  # type: ignore[arg-type]
    ]


def _cams(design: SwingGripper, fraction: Reals) -> list[Part]:
    """Cams on the shaft, rollers on the rocker; none where the cams cannot be."""
    spec = design.spec.cam
    if spec is None or not design.cams.stand:
        return []
    axis, pivot = track(design.cam_center, fraction), design.linkage.input_pivot
    rocker = design.linkage.motion(360.0 * fraction, 0).input_angle
    rollers = [(spec.roller, spec.roller.angle)]
    if spec.return_roller is not None:
        rollers.append((spec.return_roller, spec.roller.angle + spec.return_roller.angle))
    parts: list[Part] = []
    for cam, color in zip(design.cams.discs, _CAM_COLORS, strict=False):
        parts.append(disc_cam(cam, axis, spec.sense * TURN * fraction, color))
    for (roller, angle), color in zip(rollers, _CAM_COLORS, strict=False):
        center = pivot + roller.arm * np.exp(1j * (rocker + math.radians(angle)))
        parts.append(Chain(joints=(track(pivot, fraction), center), color=BLUE, marked=False))
        parts.append(wheel(center, roller.radius, fraction, color=color, fill=pale(color, 0.3)))
    parts.append(wheel(axis, max(spec.shaft_radius, 1e-3), fraction, color=BLACK, fill="#ffffff"))
    return parts


def _swing(design: SwingGripper, degrees: Reals) -> Reals:
    return np.asarray(np.degrees(design.law.evaluate(degrees, 0)[0]))


def _chart(design: SwingGripper, degrees: Reals) -> Chart:
    curve = Curve("gripper", BLUE, _swing(design, 360.0 * loop()), _swing(design, degrees))
    return Chart(
        "cylinder angle [deg]", "swing of the gripper [deg]", 360.0 * loop(), degrees, (curve,), _phases(design)
    )


def _phases(design: SwingGripper) -> tuple[Band, ...]:
    from gearlink.core.machines.swing_gripper.law import PHASES

    starts = design.law.starts
    named = zip(PHASES, starts, starts[1:], strict=False)
    return bands((name, start, end, PHASE_TINTS[name]) for name, start, end in named)


def _readouts(design: SwingGripper, degrees: Reals) -> tuple[Readout, ...]:
    speed = design.law.evaluate(degrees, 1)[1] * design.shaft_speed * design.spec.arm.length
    return (
        Readout("cylinder", "°", degrees),
        Readout("swing", "°", _swing(design, degrees)),
        Readout("speed of the tip", " mm/s", speed),
    )
