"""Circular timing diagram of a press or a gripper: what every part does over a revolution of the machine."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.scenes.scene import PHASE_TINTS
from gearlink.core.base.kind import load
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_INNER, _STEP = 3.0, 1.0


@dataclass(frozen=True, slots=True)
class Ring:
    """What one part does: stretches of the turn [deg] with a name each."""

    name: str
    stretches: tuple[panels.Phase, ...]


Timing: TypeAlias = tuple[list[Ring], list[tuple[str, float]], str]
"""Rings from outside, marks with their angles [deg], whose angle it is."""


def draw(design: Any) -> Figure:
    """Rings about the machine's angle, 0 at the top, clockwise."""
    rings, marks, over = load(KINDS[design.kind].sheets["timing"])(design)
    made = panels.page(f"{design.spec.name}: timing", 0.72)
    axes: Any = made.add_subplot(projection="polar")
    clock(axes, np.radians(np.arange(0, 360, 30)), [f"{d}°" for d in range(0, 360, 30)], linewidth=0.6, fontsize=9)
    narrow = [
        phase for i, ring in enumerate(rings) for phase in _ring(axes, ring, _INNER + _STEP * (len(rings) - 1 - i))
    ]
    top = _INNER + _STEP * len(rings)
    axes.set_ylim(0.0, top)
    for words, degrees in marks:
        angle = math.radians(degrees)
        axes.plot([angle, angle], [_INNER, top], color=style.RED, linewidth=1.4, label=f"{words}, {degrees:.5g}°")
    for phase in narrow:
        look: dict[str, Any] = {"color": PHASE_TINTS[phase.name], "edgecolor": style.GREY, "linewidth": 0.8}
        axes.bar(0.0, 0.0, **look, label=f"{phase.name}, {_limits(phase)}")
    axes.plot([], [], " ", label=f"angle: {over}, clockwise from the top")
    axes.plot([], [], " ", label="rings from outside: " + ", ".join(ring.name for ring in rings))
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.05), frameon=False, fontsize=8)
    return made


def clock(axes: Any, angles: Any, names: Sequence[str], *, linewidth: float, **look: Any) -> None:
    """Axes of an angle that is 0 at the top and runs clockwise, with names at some angles [rad]."""
    axes.set_theta_zero_location("N")
    axes.set_theta_direction(-1)
    axes.set_xticks(angles, names, **look)
    axes.set_yticks([])
    axes.spines["polar"].set_visible(False)
    axes.grid(color=style.LIGHT, linewidth=linewidth)


def along(angle: float) -> float:
    """How words along a ring are turned [deg], so that none stand on their heads."""
    degrees = math.degrees(angle) % 360.0
    return -degrees if degrees <= 90.0 or degrees >= 270.0 else 180.0 - degrees


def _ring(axes: Axes, ring: Ring, bottom: float) -> list[panels.Phase]:
    """The stretches of a ring with their names and limits; those that are too narrow for their names are returned."""
    narrow = []
    for phase in ring.stretches:
        start, width = math.radians(phase.start), math.radians(phase.end - phase.start)
        look: dict[str, Any] = {"color": PHASE_TINTS[phase.name], "edgecolor": style.GREY, "linewidth": 0.8}
        axes.bar(start, 0.92 * _STEP, width, bottom, align="edge", **look)
        if width * (bottom + 0.5 * _STEP) > 0.13 * len(phase.name):
            _name(axes, phase, start + 0.5 * width, bottom + 0.46 * _STEP)
        elif width > 0.0:
            narrow.append(phase)
    _name(axes, panels.Phase(ring.name, 0.0, 0.0), 0.0, bottom + 0.46 * _STEP, strong=True)
    return narrow


def _limits(phase: panels.Phase) -> str:
    """Both ends; a stretch up to the end of the turn ends at 360."""
    return f"{phase.start % 360.0:.4g}–{phase.end % 360.0 or 360.0:.4g}°"


def _name(axes: Axes, phase: panels.Phase, angle: float, radius: float, *, strong: bool = False) -> None:
    """A name along its ring; of a stretch with where it starts and ends."""
    words = phase.name if strong else f"{phase.name}\n{_limits(phase)}"
    look: dict[str, Any] = {"fontsize": 7.0, "ha": "center", "va": "center", "zorder": 7, "rotation_mode": "anchor"}
    if strong:
        look |= {"fontsize": 7.5, "fontweight": "bold", "path_effects": style.outlined()}
    axes.text(angle, radius, words, rotation=along(angle), **look)


def press(design: Any) -> Timing:
    """Bed, printing and cams of a press over its input."""
    from gearlink.core.machines.flatbed_press.zone import forward_stroke_end

    back = math.degrees(forward_stroke_end(design.bed))
    sync = math.degrees(design.sync_start), math.degrees(design.sync_end)
    rings = [
        Ring("bed", (panels.Phase("forward", 0.0, back), panels.Phase("back", back, 360.0))),
        Ring("print", (panels.Phase("sync", *sync),)),
    ]
    if design.spec.cam is not None:
        rings.append(Ring("cams", panels.phases_of(design.moving.outputs[0])))
    return rings, [("zone begins", sync[0]), ("zone ends", sync[1])], "input"


def gripper(design: Any) -> Timing:
    """Arm and sheet of a gripper over its cylinder."""
    from gearlink.core.machines.swing_gripper.mechanism import without_cams

    arm = Ring("arm", panels.phases_of(without_cams(design).outputs[0]))
    handover = design.motion.handover
    held = Ring("sheet", (panels.Phase("contact", 0.0, handover), panels.Phase("free", handover, 360.0)))
    return [arm, held], [("pick-up", 0.0), ("handover", handover)], "cylinder"
