"""The motion of a swing gripper: six-phase law, mechanism in three positions, torques of the force closure."""

from __future__ import annotations

import math
from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes.scene import Chain
from gearlink.cli.views.scenes.swing_gripper import build, drum_center

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.swing_gripper.design import SwingGripper

_ROWS = 1440
_HANDOVER = style.RED


def draw(command: str, design: SwingGripper) -> Figure:
    """Swing, its derivatives and the mechanism; torques where there are cams, inertia and spring."""
    forces = design.closure.stands
    heights = [1.3, 1.1, 1.1, 1.7, 5.3] if forces else [1.3, 1.1, 1.1, 5.3]
    made = panels.page(f"{design.spec.name}: {command}", (sum(heights) + 1.6) / 12.1)
    rows: Any = made.add_gridspec(len(heights), 1, height_ratios=heights)
    curves = [made.add_subplot(rows[i]) for i in range(len(heights) - 1)]
    _law(curves[:3], design)
    if forces:
        _torques(curves[3], design)
    panels.shade(curves, phases(design))
    curves[-1].set_xlabel("cylinder angle [deg]", fontsize=8.5)
    curves[-1].tick_params(labelbottom=True)
    time_axes.over_input(curves[-1], time_axes.turn_time(design))
    below: Any = rows[len(heights) - 1].subgridspec(1, 2, width_ratios=(3.2, 1.0))
    drawing = made.add_subplot(below[0])
    mechanism(drawing, design)
    panels.legend_beside(made.add_subplot(below[1]), drawing)
    return made


def phases(design: SwingGripper) -> list[panels.Phase]:
    """The six phases of the law."""
    from gearlink.core.machines.swing_gripper.law import PHASES

    starts = design.law.starts
    return [panels.Phase(name, start, end) for name, start, end in zip(PHASES, starts, starts[1:], strict=False)]


def _law(axes: list[Axes], design: SwingGripper) -> None:
    """beta, beta', beta'' over the cylinder angle, the handover marked; the derivatives in time on the right."""
    degrees = np.arange(_ROWS) * (360.0 / _ROWS)
    values = list(design.law.evaluate(degrees, 2))
    at_handover = [float(v[0]) for v in design.law.evaluate(np.array([design.motion.handover]), 2)]
    values[0], at_handover[0] = np.degrees(values[0]), math.degrees(at_handover[0])
    labels = ("β [deg]", "β′ = dβ/dθ [1]", "β″ = d²β/dθ² [1]")
    for each, curve, mark, label in zip(axes, values, at_handover, labels, strict=True):
        panels.turn_panel(each, label)
        each.plot(degrees, curve, color=style.BLUE, linewidth=1.6)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
        each.axvline(design.motion.handover, color=_HANDOVER, linewidth=0.9, linestyle="--")
        each.plot([design.motion.handover], [mark], "o", color=_HANDOVER, markersize=4.5)
    time_axes.in_time(axes[1], design.shaft_speed, 1, "rad")
    time_axes.in_time(axes[2], design.shaft_speed, 2, "rad")
    handover = f"handover (dashed) at {design.motion.handover:g}°, {design.handover_speed:.6g} mm/s"
    panels.heading(axes[0], f"Swing β of the gripper arm; {handover}")


def _torques(axes: Axes, design: SwingGripper) -> None:
    """Contact torques of both rollers: spring and inertia; what is left above zero keeps them on their cams."""
    table = design.table("forces", samples=_ROWS)
    column = dict(zip(table.columns, table.data, strict=True))
    panels.turn_panel(axes, "torque [N m]")
    axes.plot(column["theta"], column["inertia_torque"], color=style.GREEN, linewidth=1.2, label="inertia")
    for name, color, line in zip(("main", "return"), panels.CAM_COLORS, panels.CAM_LINES, strict=True):
        if f"contact_torque_{name}" not in column:
            continue
        values = np.asarray(column[f"contact_torque_{name}"])
        least = int(values.argmin())
        words = f"{name} roller, ≥ {style.number(values[least], 4)} N m"
        axes.plot(column["theta"], values, color=color, linewidth=1.6, linestyle=line, label=words)
        axes.plot([column["theta"][least]], [values[least]], "o", color=color, markersize=4.5)
        lost = values < (0.0 if design.spec.spring is None else design.spec.spring.reserve)
        failing.past(axes, column["theta"], values, lost, "lifts off")
    spring = design.spec.spring
    assert spring is not None, "drawn only where the file has a spring"
    closing = design.closing_torque
    axes.axhline(closing, color=style.BLACK, linewidth=0.9, linestyle="--", label=f"spring {closing:.5g} N m")
    least_label = f"minimum required {spring.reserve:g} N m"
    axes.axhline(spring.reserve, color=_HANDOVER, linewidth=1.0, linestyle=":", label=least_label)
    axes.axhspan(min(0.0, axes.get_ylim()[0]), spring.reserve, color=_HANDOVER, alpha=0.07, linewidth=0)
    speed = design.lift_off_speed
    lifted = "never lifts off" if speed is None else f"lifts off at {speed:.6g} sheets/h"
    panels.heading(axes, f"Torques on the cam rockers; a roller {lifted}")
    panels.legend_above(axes)


def mechanism(axes: Axes, design: SwingGripper) -> None:
    """Machine at the pick-up position; its linkage and gripper lightly at handover and far dwell, line of centres."""
    panels.drawing(axes, "Mechanism at the pick-up position, to scale")
    far = design.law.starts[3]
    stations = (
        ("bite", 0.0, style.BLUE, "-"),
        ("handover", design.motion.handover, _HANDOVER, style.DASHED),
        ("far dwell", far, style.GREEN, style.DOTTED),
    )
    scene = build(design, np.array([degrees for _, degrees, _, _ in stations]) / 360.0)
    scene_axes.draw(axes, scene)
    linkage = replace(scene, parts=tuple(part for part in scene.parts if isinstance(part, Chain)))
    for i, (name, degrees, color, line) in enumerate(stations):
        scene_axes.lightly(axes, linkage, i, color, f"{name}, {degrees:g}°", line=line)
    e, drum = complex(design.linkage.output_pivot), drum_center(design)
    axes.plot([e.real, drum.real], [e.imag, drum.imag], color=style.GREY, linewidth=0.7, linestyle="-.", zorder=3)
    if design.spec.cam is not None and design.cams.stand:
        panels.cam_axis(axes, design.cam_center, design.cams.discs, design.spec.cam.sense, design.spec.cam.shaft_radius)
