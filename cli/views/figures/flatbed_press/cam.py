"""The compensation cams of a flatbed press: lift with its phases, compensation, both cams to scale."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, style, time_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress

_ROWS = 1440


def draw(command: str, design: FlatbedPress) -> Figure:
    """Lift, velocity, acceleration, pressure angle, curvature over the cam angle; compensation; both cams."""
    made = panels.page(f"{design.spec.name}: {command}")
    rows: Any = made.add_gridspec(6, 1, height_ratios=(1.5, 1.05, 1.05, 1.05, 1.05, 4.2))
    curves = [made.add_subplot(rows[i]) for i in range(5)]
    _follower(curves[:3], design)
    cams = (design.main_cam, design.return_cam)
    panels.pressure_angles(curves[3], cams, design.spec.limits.pressure_angle, "")
    panels.curvatures(curves[4], cams, "cam angle [deg]")
    panels.shade(curves, _phases(design))
    _times(curves[4], design)
    below: Any = rows[5].subgridspec(1, 2, width_ratios=(1.55, 1.0))
    drawing = made.add_subplot(below[0])
    _cams(drawing, design)
    right: Any = below[1].subgridspec(2, 1, height_ratios=(1.5, 1.0))
    _compensation(made.add_subplot(right[0]), design)
    panels.legend_beside(made.add_subplot(right[1]), drawing)
    return made


def _times(axes: Axes, design: FlatbedPress) -> None:
    """The cam angle in time: its link turns unevenly."""
    import numpy as np

    degrees = np.arange(0.0, 361.0)
    inputs = np.unwrap(np.asarray(design.bed.input_angle(np.radians(degrees))))
    time_axes.in_uneven_ms(axes, degrees, 1e3 * (inputs - inputs[0]) / design.input_speed)


def _phases(design: FlatbedPress) -> list[panels.Phase]:
    return [
        panels.Phase(segment.phase, math.degrees(segment.start), math.degrees(segment.end))
        for segment in design.follower.segments
    ]


def _follower(axes: list[Axes], design: FlatbedPress) -> None:
    """The table `follower` and the steps that are left at its joints."""
    table = design.table("follower", samples=_ROWS)
    degrees = table.data[0]
    names = (("lift", "lift [mm]"), ("velocity", "velocity\n[mm/rad]"), ("acceleration", "acceleration\n[mm/rad²]"))
    for each, (name, ylabel) in zip(axes, names, strict=True):
        panels.turn_panel(each, ylabel)
        each.plot(degrees, table.data[table.columns.index(name)], color=style.BLUE, linewidth=1.6)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
    panels.heading(axes[0], "Motion of the follower over the cam angle")


def _compensation(axes: Axes, design: FlatbedPress) -> None:
    """Difference of bed and cylinder travel that the cam makes good in the zone, over the input angle."""
    import numpy as np

    from gearlink.core.machines.flatbed_press.chains import difference

    phi = np.linspace(design.sync_start, design.sync_end, 241)
    gap = difference(design.bed, design.cylinder, phi).value
    style.curves(axes, "input angle [deg]", "bed less cylinder travel [mm]")
    panels.small_ticks(axes)
    panels.heading(axes, f"Compensation: {design.compensation:.5g} mm")
    axes.plot(np.degrees(phi), gap - gap[0], color=style.GREEN, linewidth=1.6)
    end = float(np.degrees(phi[-1]))
    axes.plot([end], [design.compensation], "o", color=style.GREEN, markersize=4.5)


def _cams(axes: Axes, design: FlatbedPress) -> None:
    """Both cams on their shaft at cam angle 0, with the line of the rollers."""
    panels.drawing(axes, "Main and return cam at cam angle 0, to scale")
    cams = (design.main_cam, design.return_cam)
    rollers = [
        panels.cam_outline(axes, cam, color, line=line)
        for cam, color, line in zip(cams, panels.CAM_COLORS, panels.CAM_LINES, strict=True)
    ]
    panels.base_circles(axes, cams)
    spec = design.cams.section
    panels.cam_shaft(axes, 0j, spec.shaft_radius)
    panels.cam_axis(axes, 0j, cams, 1, spec.shaft_radius)
    reach = 1.15 * spec.roller_radius
    left, right = rollers[1].real - reach, rollers[0].real + reach
    axes.plot([left, right], [0.0, 0.0], color=style.GREY, linewidth=0.8, linestyle="-.", zorder=2)
    axes.plot(
        [rollers[1].real, rollers[0].real],
        [0.0, 0.0],
        " ",
        label=f"roller distance {design.roller_center_distance:.6g} mm",
    )
