"""The swing gripper in motion: one turn of the cylinder shaft, a sheet."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.cams import disc_cam
from gearlink.cli.scenes.scene import (
    TURN,
    Body,
    Chain,
    Chart,
    Curve,
    Line,
    Mark,
    Part,
    Readout,
    Reals,
    Scene,
    circle,
    loop,
    pale,
    track,
    wheel,
)
from gearlink.core.swing_gripper.positions import GripperPositions, positions

if TYPE_CHECKING:
    from gearlink.core.swing_gripper.design import SwingGripper

_CAM_COLORS = ("#666666", "#A08060")


def build(design: SwingGripper, fraction: Reals) -> Scene:
    """Positions over fractions of the loop."""
    degrees = 360.0 * fraction
    at = _positions(design, degrees)
    a, e = track(at.a, fraction), track(at.e, fraction)
    path = _positions(design, np.linspace(0.0, design.law.starts[3], 121)).f
    parts: list[Part] = [
        Line(points=path, color=style.ORANGE, width=2.0),
        *_drum(design, fraction),
        *_cams(design, fraction),
        Chain(joints=(a, at.c, at.d, e), color=style.BLUE),
        Chain(joints=(at.d, e, at.f), color=style.BLACK),
    ]
    named = (("A", a, True), ("C", at.c, False), ("D", at.d, False), ("E", e, True), ("F", at.f, False))
    return Scene(
        parts=tuple(parts),
        marks=tuple(Mark(point=point, text=name, pivot=pivot) for name, point, pivot in named),
        chart=_chart(design, degrees),
        readouts=_readouts(design, degrees),
    )


def _positions(design: SwingGripper, degrees: Reals) -> GripperPositions:
    arm = design.spec.arm
    return positions(design.linkage, arm.length, math.radians(arm.direction), degrees)


def _drum(design: SwingGripper, fraction: Reals) -> list[Part]:
    """The drum that takes the sheet over, with its grippers where the tip meets them at the handover."""
    spec = design.spec
    center = complex(*spec.cylinder.center) if spec.cylinder.center else design.handover_center
    meeting = complex(_positions(design, np.array([spec.handover])).f[0])
    radius = spec.cylinder.radius
    way = (meeting - center) / abs(meeting - center)
    turn = -spec.swing_sense * (TURN * fraction - math.radians(spec.handover))
    pad = radius * way * np.array([0.86, 1.0])
    shared = {"place": track(center, fraction), "turn": turn, "color": style.GREY}
    return [
        Body(outline=circle(radius, 144), repeats=0, fill=pale(style.GREY, 0.1), **shared, label="drum"),  # type: ignore[arg-type]
        Body(outline=pad, width=5.0, closed=False, **{**shared, "color": style.RED}),  # type: ignore[arg-type]
    ]


def _cams(design: SwingGripper, fraction: Reals) -> list[Part]:
    """Cams on the shaft, rollers on the rocker."""
    spec = design.spec.cam
    if spec is None:
        return []
    axis, pivot = track(design.cam_center, fraction), design.linkage.input_pivot
    rocker = design.linkage.motion(360.0 * fraction, 0).input_angle
    rollers = [(spec.roller, spec.roller.angle)]
    if spec.return_roller is not None:
        rollers.append((spec.return_roller, spec.roller.angle + spec.return_roller.angle))
    parts: list[Part] = []
    for cam, color in zip(design.cams, _CAM_COLORS, strict=False):
        parts.append(disc_cam(cam, axis, spec.sense * TURN * fraction, color))
    for (roller, angle), color in zip(rollers, _CAM_COLORS, strict=False):
        center = pivot + roller.arm * np.exp(1j * (rocker + math.radians(angle)))
        parts.append(Chain(joints=(track(pivot, fraction), center), color=style.BLUE, marked=False))
        parts.append(wheel(center, roller.radius, fraction, color=color, fill=pale(color, 0.3)))
    parts.append(wheel(axis, max(spec.shaft_radius, 1e-3), fraction, color=style.BLACK, fill="#ffffff"))
    return parts


def _swing(design: SwingGripper, degrees: Reals) -> Reals:
    return np.asarray(np.degrees(design.law.evaluate(degrees, 0)[0]))


def _chart(design: SwingGripper, degrees: Reals) -> Chart:
    curve = Curve(label="gripper", color=style.BLUE, y=_swing(design, 360.0 * loop()), now=_swing(design, degrees))
    return Chart(
        xlabel="cylinder angle [deg]",
        ylabel="swing of the gripper [deg]",
        x=360.0 * loop(),
        now=degrees,
        curves=(curve,),
    )


def _readouts(design: SwingGripper, degrees: Reals) -> tuple[Readout, ...]:
    speed = design.law.evaluate(degrees, 1)[1] * design.shaft_speed * design.spec.arm.length
    return (
        Readout(label="cylinder", unit="°", values=degrees),
        Readout(label="swing", unit="°", values=_swing(design, degrees)),
        Readout(label="speed of the tip", unit=" mm/s", values=speed),
    )
