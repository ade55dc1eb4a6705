"""The mutilated gear in motion: as many cycles as bring the driven gear, and the four-bar on it, home."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.gears import gear
from gearlink.cli.scenes.linkages import Joints
from gearlink.cli.scenes.scene import TURN, Body, Chart, Curve, Mark, Points, Readout, Reals, Scene, loop, pale, track
from gearlink.core.errors import NoSolution

if TYPE_CHECKING:
    from gearlink.core.dwell_gears.mutilated_design import MutilatedGearDwell


def build(design: MutilatedGearDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; the wheel turns clockwise, a motion begins at fraction 0."""
    cycles = design.mutilated.cycles_to_repeat
    turns = cycles * design.cycle_turns * fraction
    driven = _driven(design, turns)
    bars = design.linkage is not None
    center = track((-1j if bars else -1.0) * design.mesh.center_distance, fraction)
    toward = 0.5 * math.pi if bars else 0.0
    # A space of the wheel and a tooth of the driven gear stand on the line of centres where a motion begins.
    wheel = toward - TURN * turns / design.spec.reduction
    place = toward + math.pi - math.pi / design.mesh.teeth[1] + driven
    loop_turns = cycles * design.driven_turn
    at = None if design.linkage is None else Joints.of(design.linkage, driven + (design.start_crank_angle or 0.0))
    return Scene(
        parts=(
            _wheel(design, center, wheel),
            *gear(design.mesh, 1, track(0.0, fraction), place, loop_turns, style.ORANGE, "2"),
            *([] if at is None else [at.chain()]),
        ),
        marks=(
            Mark(point=center, pivot=True),
            *((Mark(point=track(0.0, fraction), pivot=True),) if at is None else at.marks()),
        ),
        chart=_chart(design, cycles * design.cycle_turns, turns, driven),
        readouts=(
            Readout(label="input turns", unit="", values=turns),
            Readout(label="driven gear", unit="°", values=np.degrees(driven)),
        ),
    )


def _driven(design: MutilatedGearDwell, turns: Reals) -> Reals:
    return np.array([design.mutilated.driven_angle(TURN * value) for value in turns.tolist()])


def _chart(design: MutilatedGearDwell, whole: float, turns: Reals, driven: Reals) -> Chart:
    x = whole * loop(361)
    curve = Curve(label="driven", color=style.ORANGE, y=np.degrees(_driven(design, x)), now=np.degrees(driven))
    return Chart(xlabel="input turns", ylabel="driven gear [deg]", x=x, now=turns, curves=(curve,))


def _wheel(design: MutilatedGearDwell, center: Points, turn: Reals) -> Body:
    """The wheel's outline, its first group counter-clockwise from the x axis.

    The first and the last tooth of a group are cut down so far that they pass the resting gear; the model says no
    more of them, nor of the locking arcs.
    """
    from gearlink.core.gears.tooth_profile import ToothProfile, tooth_space

    gears, mesh = design.spec.gears, design.mesh
    root = mesh.root_radius[0]
    step = TURN / gears.full_teeth
    try:
        space = tooth_space(ToothProfile.of(mesh, 0), 0.012 * mesh.module)
    except NoSolution:
        space = mesh.tip_radius[0] * np.exp(1j * np.linspace(-0.5 * step, 0.5 * step, 5))
    half = space[np.angle(space) >= 0.0]
    tooth = np.concatenate([half, half[::-1].conj() * np.exp(1j * step)])
    cut = tooth * np.minimum(1.0, max(root, _free_radius(design)) / np.abs(tooth))
    # A wheel with one tooth in a group has a single cut tooth.
    teeth = [cut if k in (0, gears.group_teeth - 1) else tooth for k in range(gears.group_teeth)]
    group = np.concatenate([each * np.exp(1j * step * k) for k, each in enumerate(teeth)])
    gap = np.linspace(gears.group_teeth * step, TURN / gears.groups, 180)
    part = np.concatenate([group, root * np.exp(1j * gap)])
    whole = np.concatenate([part * np.exp(1j * TURN * k / gears.groups) for k in range(gears.groups)])
    return Body(
        outline=np.append(whole, whole[0]),
        place=center,
        turn=turn,
        repeats=gears.groups,
        color=style.BLUE,
        fill=pale(style.BLUE),
        label="1" if gears.groups > 1 else "",
    )


def _free_radius(design: MutilatedGearDwell) -> float:
    """How far from the wheel's axis the resting gear leaves room, but for the tooth that stands in the gap [mm]."""
    from gearlink.core.gears.tooth_profile import ToothProfile, outline

    mesh, half_pitch = design.mesh, math.pi / design.mesh.teeth[1]
    try:
        teeth = outline(ToothProfile.of(mesh, 1), 0.012 * mesh.module)
    except NoSolution:
        return mesh.reference_radius[0]
    from_tooth = teeth * np.exp(-1j * half_pitch)
    others = from_tooth[np.abs(np.angle(from_tooth)) > half_pitch]
    return float(np.abs(mesh.center_distance - others).min())
