"""The motion of a swing gripper: six-phase law, mechanism in three positions, torques of the force closure."""

from __future__ import annotations

import math
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

from gearlink.cli.figures import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.swing_gripper.design import SwingGripper

_ROWS = 1440
_HANDOVER = style.RED


@dataclass(frozen=True, slots=True)
class _Station:
    """A position of the mechanism that is drawn: its name, cylinder angle [deg] and colour."""

    name: str
    degrees: float
    color: str


def draw(command: str, design: SwingGripper) -> Figure:
    """Swing, its derivatives and the mechanism; torques where the file has cam, inertia and spring."""
    forces = None not in (design.spec.cam, design.spec.inertia, design.spec.spring)
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
    below: Any = rows[len(heights) - 1].subgridspec(1, 2, width_ratios=(3.2, 1.0))
    drawing = made.add_subplot(below[0])
    mechanism(drawing, design)
    panels.legend_beside(made.add_subplot(below[1]), drawing)
    made.align_ylabels(curves)
    return made


def phases(design: SwingGripper) -> list[panels.Phase]:
    """The six phases of the law."""
    from gearlink.core.swing_gripper.law import PHASES

    starts = design.law.starts
    return [panels.Phase(name, start, end) for name, start, end in zip(PHASES, starts, starts[1:], strict=False)]


def _law(axes: list[Axes], design: SwingGripper) -> None:
    """beta, beta', beta'' over the cylinder angle, the handover marked; the derivatives in time on the right."""
    import numpy as np

    degrees = np.arange(_ROWS) * (360.0 / _ROWS)
    values = list(design.law.evaluate(degrees, 2))
    at_handover = [float(v[0]) for v in design.law.evaluate(np.array([design.spec.handover]), 2)]
    values[0], at_handover[0] = np.degrees(values[0]), math.degrees(at_handover[0])
    labels = ("β [deg]", "β′ = dβ/dθ [1]", "β″ = d²β/dθ² [1]")
    for each, curve, mark, label in zip(axes, values, at_handover, labels, strict=True):
        panels.turn_panel(each, label)
        each.plot(degrees, curve, color=style.BLUE, linewidth=1.6)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
        each.axvline(design.spec.handover, color=_HANDOVER, linewidth=0.9, linestyle="--")
        each.plot([design.spec.handover], [mark], "o", color=_HANDOVER, markersize=4.5)
    _in_time(axes[1], design.shaft_speed, "[rad/s]")
    _in_time(axes[2], design.shaft_speed**2, "[rad/s²]")
    handover = f"handover (dashed) at {design.spec.handover:g}°, {design.handover_speed:.6g} mm/s"
    panels.heading(axes[0], f"Swing β of the gripper arm; {handover}")


def _in_time(axes: Axes, factor: float, unit: str) -> None:
    """The same curve in time, on the right."""

    def faster(value: Any) -> Any:
        return value * factor

    def slower(value: Any) -> Any:
        return value / factor

    right = axes.secondary_yaxis("right", functions=(faster, slower))
    right.set_ylabel(unit, fontsize=8.5)
    right.tick_params(labelsize=8)


def _torques(axes: Axes, design: SwingGripper) -> None:
    """Contact torques of both rollers: spring and inertia; what is left above zero keeps them on their cams."""
    import numpy as np

    table = design.table("forces", samples=_ROWS)
    column = dict(zip(table.columns, table.data, strict=True))
    panels.turn_panel(axes, "torque [N m]")
    axes.plot(column["theta"], column["inertia_torque"], color=style.GREEN, linewidth=1.2, label="inertia")
    for name, color in zip(("main", "return"), panels.CAM_COLORS, strict=True):
        if f"contact_torque_{name}" not in column:
            continue
        values = np.asarray(column[f"contact_torque_{name}"])
        least = int(values.argmin())
        axes.plot(column["theta"], values, color=color, linewidth=1.6, label=f"{name} roller, ≥ {values[least]:.4g}")
        axes.plot([column["theta"][least]], [values[least]], "o", color=color, markersize=4.5)
    spring = design.spec.spring
    assert spring is not None, "drawn only where the file has a spring"
    closing = design.closing_torque
    axes.axhline(closing, color=style.BLACK, linewidth=0.9, linestyle="--", label=f"spring {closing:.5g}")
    least_label = f"least wanted {spring.reserve:g}"
    axes.axhline(spring.reserve, color=_HANDOVER, linewidth=1.0, linestyle=":", label=least_label)
    axes.axhspan(min(0.0, axes.get_ylim()[0]), spring.reserve, color=_HANDOVER, alpha=0.07, linewidth=0)
    speed = design.lift_off_speed
    lifted = "never lifts off" if speed is None else f"lifts off at {speed:.6g} sheets/h"
    panels.heading(axes, f"Torques on the cam rockers; a roller {lifted}")
    panels.legend_above(axes)


def mechanism(axes: Axes, design: SwingGripper) -> None:
    """Linkage and gripper at bite, handover and far dwell, the drum, the path of the tip, the cams at the bite."""
    import numpy as np

    from gearlink.core.swing_gripper.positions import positions

    panels.drawing(axes, "Mechanism to scale")
    spec, law = design.spec, design.law
    arm = spec.arm.length, math.radians(spec.arm.direction)
    stations = (
        _Station("bite", 0.0, style.BLUE),
        _Station("handover", spec.handover, _HANDOVER),
        _Station("far dwell", law.starts[3], style.GREEN),
    )
    at = positions(design.linkage, *arm, np.array([station.degrees for station in stations]))
    path = positions(design.linkage, *arm, np.linspace(0.0, law.starts[3], 121)).f
    for i, station in enumerate(stations):
        joints = [complex(points[i]) for points in (at.c, at.d, at.f)]
        _linkage(axes, at.a, at.e, joints, station)
    axes.plot(path.real, path.imag, color=style.ORANGE, linewidth=1.4, zorder=3, label="path of the sheet's edge")
    _letters(axes, at.a, at.e, [complex(points[0]) for points in (at.c, at.d, at.f)])
    given = spec.cylinder.center
    center = complex(*given) if given else design.handover_center
    style.circle(axes, center, spec.cylinder.radius, color=style.GREY, linewidth=1.2)
    axes.plot([], [], color=style.GREY, linewidth=1.2, label=f"drum, radius {spec.cylinder.radius:g} mm")
    style.pivot(axes, center, "", 6.0)
    axes.plot([at.e.real, center.real], [at.e.imag, center.imag], color=style.GREY, linewidth=0.7, linestyle="-.")
    if spec.cam is not None:
        _cams(axes, design, at.a)
    for point in (at.a, at.e):
        style.pivot(axes, point, "", 7.0)


def _linkage(axes: Axes, a: complex, e: complex, joints: list[complex], station: _Station) -> None:
    """A-C-D-E with the gripper arm, rigid with ED, and the tip."""
    c, d, f = joints
    strong = station.degrees == 0.0
    style.link(axes, [a, c, d, e], station.color, 2.2 if strong else 1.3, label=f"{station.name}, {station.degrees:g}°")
    axes.fill([e.real, d.real, f.real], [e.imag, d.imag, f.imag], color=station.color, alpha=0.10, linewidth=0)
    width = 2.6 if strong else 1.6
    axes.plot([e.real, f.real], [e.imag, f.imag], color=station.color, linewidth=width, zorder=4)
    axes.plot([f.real], [f.imag], "D", color=station.color, markersize=5, zorder=6)


def _letters(axes: Axes, a: complex, e: complex, joints: list[complex]) -> None:
    c, d, f = joints
    panels.letters(axes, [a, c, d, e], "ACDE")
    panels.letters(axes, [e, f], " F")


def _cams(axes: Axes, design: SwingGripper, a: complex) -> None:
    """The cams at cylinder angle 0, where the rocker stands at the bite."""
    spec = design.spec.cam
    assert spec is not None, "drawn only where the file has a cam"
    for cam, color in zip(design.cams, ("#888888", "#B0A090"), strict=False):
        roller = panels.cam_outline(axes, cam, color, design.cam_center, pitch_curve=False)
        style.link(axes, [a, roller], style.BLUE, 1.4)
    panels.cam_axis(axes, design.cam_center, design.cams, spec.sense, spec.shaft_radius)
