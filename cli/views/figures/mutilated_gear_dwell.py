"""Scene and sheets of a dwell by a mutilated gear: wheel and four-bar to scale, motion over a cycle; mesh for `gear`.

The scene has as many cycles as bring the driven gear, and the four-bar on it, home.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.gears import Mesh, mesh_figure
from gearlink.cli.views.scenes.gears import gear
from gearlink.cli.views.scenes.of_motion import Frame, Positions
from gearlink.cli.views.scenes.scene import (
    TURN,
    Band,
    Body,
    Chart,
    Curve,
    Mark,
    Points,
    Readout,
    Reals,
    Scene,
    loop,
    pale,
    track,
)
from gearlink.core.base.errors import NoSolution
from gearlink.core.machines.dwell_gears.mutilated_design import MutilatedGearDwell, driven
from gearlink.core.machines.dwell_gears.wheel import end_tooth_radius
from gearlink.core.numerics.arrays import unit_vector
from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, tooth_space
from gearlink.core.parts.linkages.fourbar.mechanism import four_bar_motion

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


def frame(design: MutilatedGearDwell) -> Frame:
    """The scene stands where the motion does, and goes straight through its range."""
    return Frame(lambda fraction: design.moving.input.end * fraction, design.moving)


def build(design: MutilatedGearDwell, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; the wheel turns clockwise, a motion begins at fraction 0."""
    cycles = design.mutilated.cycles_to_repeat
    turns = cycles * design.cycle_turns * fraction
    moved, here = _driven(design, turns), Positions(design.moving, TURN * turns)
    bars, toward = design.linkage, 1.0 if design.linkage is None else 1j
    center = track(-toward * design.mesh.center_distance, fraction)
    marks = (Mark(here.at("crank"), pivot=True),) if bars is None else here.marks
    return Scene(
        parts=(*_gears(design, turns, center, toward), *([] if bars is None else [here.chain])),
        marks=(Mark(center, pivot=True), *marks),
        chart=_chart(design, cycles * design.cycle_turns, turns, moved),
        readouts=(Readout("input turns", "", turns), Readout("driven gear", "°", np.degrees(moved))),
    )


def mesh_scene(design: MutilatedGearDwell) -> Scene:
    """The two gears alone in the middle of a motion, the wheel in the origin."""
    turns, center = np.array([0.5 * design.motion_turns]), np.zeros(1)
    marks = (Mark(center, pivot=True), Mark(center + design.mesh.center_distance, pivot=True))
    teeth = [body for body in _gears(design, turns, center, 1.0) if body.color != _LOCK_COLOR]
    return Scene(parts=tuple(teeth), marks=marks)


def _gears(design: MutilatedGearDwell, turns: Reals, center: Points, toward: complex) -> list[Body]:
    """The wheel, and the driven gear in a direction from it, after turns of the input; what locks them last."""
    # A space of the wheel and a tooth of the driven gear stand on the line of centres where a motion begins.
    line = cmath.phase(toward)
    place = line + math.pi - math.pi / design.mesh.teeth[1] + _driven(design, turns)
    axis, loop_turns = center + toward * design.mesh.center_distance, design.mutilated.cycles_to_repeat
    turn = line - TURN * turns / design.reduction
    return [
        _wheel(design, center, turn),
        *gear(design.mesh, 1, axis, place, loop_turns * design.driven_turn, style.ORANGE, "2", "driven gear"),
        *_lock(design, (center, turn), (axis, line + math.pi + _driven(design, turns))),
    ]


def _lock(design: MutilatedGearDwell, wheel: tuple[Points, Reals], driven: tuple[Points, Reals]) -> Iterator[Body]:
    """The outlines of disc and plate at the places and turns of wheel and gear; a plate's arc lies on its x axis."""
    lock, groups = design.lock, design.spec.gears.groups
    if lock is None:
        return
    pitch, start = TURN / groups, 0.5 * (TURN / groups + design.group_teeth * TURN / design.full_teeth)
    arcs, cuts = np.linspace(-0.5, 0.5, 181) * lock.arc, np.linspace(0.5 * lock.arc, pitch - 0.5 * lock.arc, 61)
    disc = np.concatenate([lock.radius * np.exp(1j * arcs), lock.cut * np.exp(1j * cuts)]) * cmath.rect(1.0, start)
    rim = np.linspace(lock.half_arc, TURN / lock.stops - lock.half_arc, 121)
    arc = lock.distance - lock.hollow * np.exp(1j * np.linspace(lock.reach, -lock.reach, 61))
    plate = np.concatenate([arc, lock.plate * np.exp(1j * rim)])
    for outline, count, (place, turn), name in ((disc, groups, wheel, _LOCK), (plate, lock.stops, driven, "")):
        whole = np.concatenate([outline * cmath.rect(1.0, TURN * k / count) for k in range(count)])
        look: Any = {"repeats": count, "color": _LOCK_COLOR, "name": name}
        yield Body(outline=np.append(whole, whole[0]), place=place, turn=turn, **look)


_LOCK, _LOCK_COLOR = "locking disc and plate", style.GREEN


def _driven(design: MutilatedGearDwell, turns: Reals) -> Reals:
    return driven(design.mutilated, TURN * turns)[0]


def _chart(design: MutilatedGearDwell, whole: float, turns: Reals, now: Reals) -> Chart:
    x = whole * loop(361)
    curve = Curve("driven", style.ORANGE, np.degrees(_driven(design, x)), np.degrees(now))
    cycle, count = design.cycle_turns, design.mutilated.cycles_to_repeat
    dwells = tuple(Band("dwell", k * cycle + design.motion_turns, (k + 1) * cycle) for k in range(count))
    return Chart("input turns", "driven gear [deg]", x, turns, (curve,), dwells)


def _wheel(design: MutilatedGearDwell, center: Points, turn: Reals) -> Body:
    """The wheel's outline, its first group counter-clockwise from the x axis.

    The first and the last tooth of a group are cut down so far that they pass the resting gear.
    """
    gears, mesh = design.spec.gears, design.mesh
    root = mesh.root_radius[0]
    step = TURN / design.full_teeth
    try:
        space = tooth_space(ToothProfile.of(mesh, 0), 0.012 * mesh.module)
    except NoSolution:
        space = mesh.tip_radius[0] * unit_vector(np.linspace(-0.5 * step, 0.5 * step, 5))
    half = space[np.angle(space) >= 0.0]
    tooth = np.concatenate([half, half[::-1].conj() * np.exp(1j * step)])
    reach, end = np.abs(tooth), end_tooth_radius(mesh)
    cut = np.where(reach > end, tooth * (end / reach), tooth)
    # A wheel with one tooth in a group has a single cut tooth.
    teeth = [cut if k in (0, design.group_teeth - 1) else tooth for k in range(design.group_teeth)]
    group = np.concatenate([each * np.exp(1j * step * k) for k, each in enumerate(teeth)])
    gap = np.linspace(design.group_teeth * step, TURN / gears.groups, 180)
    part = np.concatenate([group, root * np.exp(1j * gap)])
    whole = np.concatenate([part * np.exp(1j * TURN * k / gears.groups) for k in range(gears.groups)])
    name = f"wheel, {gears.groups} × {design.group_teeth} of {design.full_teeth} teeth"
    look: Any = {"repeats": gears.groups, "color": style.BLUE, "fill": pale(style.BLUE), "label": "1", "name": name}
    return Body(outline=np.append(whole, whole[0]), place=center, turn=turn, pitch=mesh.working_radius[0], **look)


_WORDS = {
    "cycle_turns": "input revolutions per cycle",
    "motion_turns": "input revolutions in motion",
    "dwell_turns": "input revolutions in the dwell",
    "driven_speed_ratio": "driven speed/input speed",
    "rocker_swing": "swing of the rocker",
    "min_transmission_angle": "minimum transmission angle",
}


def draw(command: str, design: MutilatedGearDwell) -> Figure:
    """The sheet of a command on a mutilated-gear dwell."""
    title = f"{design.spec.name}: {command}"
    if command == "gear":
        return mesh_figure(title, [Mesh(design.mesh, "", ("1, wheel", "2, driven"), mesh_scene(design))])
    charts: list[linkage.Panel] = [
        partial(_both, title="Angles", ylabel="angle [deg]", column="angle", line="default"),
        partial(_both, title="Speeds, per input speed", ylabel="speed ratio", column="speed_ratio", line="steps-post"),
        *([] if design.linkage is None else [_transmission]),
    ]
    return linkage.sheet(title, design, mechanism, _WORDS, charts, columns=1)


def mechanism(axes: Axes, design: MutilatedGearDwell) -> None:
    """The wheel and the driven gear at the start of a motion; lightly, the four-bar in the middle of it."""
    panels.heading(axes, "At the start of a motion")
    cycles, share = design.mutilated.cycles_to_repeat, 0.5 * design.motion_turns / design.cycle_turns
    scene = scene_axes.turned(axes, design, build, 0.0, share / cycles)
    if design.linkage is not None:
        links = replace(scene, parts=tuple(part for part in scene.parts if not isinstance(part, Body)))
        scene_axes.lightly(axes, links, 1, name="four-bar in the middle of the motion")


def _both(axes: Axes, design: MutilatedGearDwell, title: str, ylabel: str, column: str, line: str) -> None:
    """Driven gear and rocker over input turns, the dwell shaded.

    line : how the values of the driven gear are joined, as matplotlib calls it
    """
    table = design.table("motion")
    turns = table["input_angle"] / 360.0
    linkage.chart(axes, title, ylabel, "input turns", turn=False)
    axes.axvspan(design.motion_turns, design.cycle_turns, **linkage.DWELL, label="dwell")
    axes.set_xlim(0.0, design.cycle_turns)
    look: dict[str, Any] = {"linewidth": 1.6, "drawstyle": line}
    axes.plot(turns, table[f"driven_{column}"], color=style.ORANGE, label="driven gear", **look)
    if f"rocker_{column}" in table.columns:
        axes.plot(turns, table[f"rocker_{column}"], color=style.BLUE, linewidth=1.6, label="rocker")
    if column != "angle":
        time_axes.in_time(axes, design.angular_speed, 1, "rad")
    panels.legend_above(axes, 3)


def _transmission(axes: Axes, design: MutilatedGearDwell) -> None:
    """The four-bar over its own turn, which it passes in parts, one a cycle."""
    assert design.linkage is not None, "as for the chart"
    over = "crank angle of the four-bar [deg]"
    linkage.transmission(axes, design, motion=four_bar_motion(design.linkage), xlabel=over)
