"""The cams of a swing gripper: both with their rollers on the rocker, pressure angle, curvature."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style, time_axes
from gearlink.cli.views.figures.swing_gripper.motion import phases
from gearlink.cli.views.scenes.scene import Chain, Scene, letters
from gearlink.cli.views.scenes.swing_gripper import build

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.swing_gripper.design import SwingGripper


def draw(command: str, design: SwingGripper) -> Figure:
    """Rocker, pressure angle and curvature over the cam angle; below them the cams to scale."""
    cams = design.cams.discs
    made = panels.page(f"{design.spec.name}: {command}")
    rows: Any = made.add_gridspec(4, 1, height_ratios=(1.2, 1.3, 1.3, 5.2))
    curves = [made.add_subplot(rows[i]) for i in range(3)]
    table = design.table("motion", samples=1440)
    panels.turn_panel(curves[0], "rocker\nangle [deg]")
    angle = np.asarray(table.data[table.columns.index("input_angle")])
    curves[0].plot(table.data[0], angle, color=style.BLUE, linewidth=1.6)
    panels.heading(curves[0], "Cam rocker AC over the cam angle")
    panels.pressure_angles(curves[1], cams, design.spec.limits.pressure_angle, "")
    _accelerating(curves[1], design)
    panels.curvatures(curves[2], cams, "cam angle [deg]")
    panels.shade(curves, phases(design))
    time_axes.over_input(curves[2], time_axes.turn_time(design))
    below: Any = rows[3].subgridspec(1, 2, width_ratios=(3.0, 1.0 if design.spec.fingers is None else 1.3))
    drawing = made.add_subplot(below[0])
    _cams(drawing, design)
    if design.spec.fingers is None:
        panels.legend_beside(made.add_subplot(below[1]), drawing)
        return made
    beside: Any = below[1].subgridspec(2, 1)
    _fingers(made.add_subplot(beside[0]), design)
    panels.legend_beside(made.add_subplot(beside[1]), drawing)
    return made


def _fingers(axes: Axes, design: SwingGripper) -> None:
    """The cam of the fingers about E, the arm along +x, its roller on the lever with the fingers closed."""
    cam, section = design.fingers.cam, design.fingers.section
    panels.drawing(axes, "Finger cam")
    panels.cam_outline(axes, cam, style.PURPLE, 0j, "-")
    roller = complex(cam.path(np.zeros(1), 1).position[0])
    style.circle(axes, roller, section.roller_radius, color=style.PURPLE, linewidth=1.2)
    for joints in ((0j, complex(section.pivot)), (complex(section.pivot), roller)):
        axes.plot([each.real for each in joints], [each.imag for each in joints], color=style.GREY, linewidth=1.6)
    style.pivot(axes, 0j)


def _accelerating(axes: Axes, design: SwingGripper) -> None:
    """The lower limit of the phase accelerate, which only warns."""
    limit, end = design.spec.limits.accelerate_pressure_angle, design.law.starts[1]
    for sign, label in ((1.0, f"accelerate ±{limit:g}°"), (-1.0, "_")):
        axes.plot([0.0, end], [sign * limit] * 2, color=style.BLACK, linewidth=0.9, linestyle=":", label=label)
    panels.legend_above(axes)


def _cams(axes: Axes, design: SwingGripper) -> None:
    """The cams about their axis at cam angle 0, the rollers on the rocker, the shaft."""
    spec, linkage = design.spec.cam, design.linkage
    assert spec is not None, "the cams have requested it"
    panels.drawing(axes, "Cams at cam angle 0, to scale")
    axis, pivot = design.cam_center, np.array([linkage.input_pivot])
    for cam, color, line in zip(design.cams.discs, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        panels.cam_outline(axes, cam, color, axis, line)
    scene = build(design, np.zeros(1))
    rocker = [part for part in scene.parts if isinstance(part, Chain) and not part.marked]
    c = next(mark.point for mark in scene.marks if mark.text == "C")
    arm = Chain(joints=(pivot, c), color=style.GREY)
    scene_axes.draw(axes, Scene(parts=(*rocker, arm), marks=letters("A", A=pivot, C=c)))
    panels.base_circles(axes, design.cams.discs, axis)
    panels.cam_shaft(axes, axis, spec.shaft_radius)
    panels.cam_axis(axes, axis, design.cams.discs, spec.sense, spec.shaft_radius)
