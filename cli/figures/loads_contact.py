"""Panels of rollers on cams under load: forces, pressures, the profile coloured by pressure, residual over speed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.figures import panels, style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_TURN = 360.0


def forces(axes: Axes, design: Any) -> None:
    """Force between each roller and its cam."""
    x, columns = _contact(axes, design, "Contact forces", "force [N]")
    for name, color in zip(design.own_rollers, panels.CAM_COLORS, strict=False):
        axes.plot(x, columns[f"{name}_force"], color=color, linewidth=1.4, label=f"{name} roller")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    panels.legend_above(axes, 2)


def pressures(axes: Axes, design: Any) -> None:
    """Hertzian pressure of each roller, and what is allowed."""
    x, columns = _contact(axes, design, "Hertzian pressure", "p [N/mm²]")
    for name, color in zip(design.own_rollers, panels.CAM_COLORS, strict=False):
        axes.plot(x, columns[f"{name}_pressure"], color=color, linewidth=1.4, label=f"{name} roller")
    _allowed(axes, design)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 3)


def _allowed(axes: Axes, design: Any) -> None:
    material = design.section.material
    if material is not None and material.allowed_pressure is not None:
        limit = material.allowed_pressure
        axes.axhline(limit, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=f"allowed {limit:g}")


def _contact(axes: Axes, design: Any, title: str, ylabel: str) -> tuple[Any, dict[str, Any]]:
    import numpy as np

    table = design.table("contact", samples=720)
    panels.turn_panel(axes, ylabel, "input angle [deg]")
    panels.heading(axes, title)
    x = np.arange(table.length) * (_TURN * design.turns / table.length)
    return x, {name: np.asarray(data) for name, data in zip(table.columns, table.data, strict=True)}


def residual(axes: Axes, design: Any) -> None:
    """Vibration that is left in the dwell, over the speed, with the working speed and what is allowed."""
    table = design.table("spectrum")
    speed, amplitude = table["speed"], table["residual"]
    unit = table.units[table.columns.index("residual")]
    words = table.units[table.columns.index("speed")].replace("1/min", "rev/min")
    style.curves(axes, f"speed [{words}]", f"residual [{unit}]")
    panels.small_ticks(axes)
    panels.heading(axes, "Residual vibration over the speed")
    axes.plot(speed, amplitude, color=style.PURPLE, linewidth=1.4)
    at = float(speed[-1]) / 1.3
    axes.axvline(at, color=style.GREY, linewidth=0.9, linestyle=style.DASHED, label=f"speed {at:.5g}")
    allowed = design.section.vibration.allowed_residual
    if allowed is not None:
        axes.axhline(allowed, color=style.RED, linewidth=1.0, linestyle=style.DASHED, label=f"allowed {allowed:g}")
    axes.set_xlim(float(speed[0]), float(speed[-1]))
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 2)


def profile(axes: Axes, design: Any, name: str) -> None:
    """A cam, its profile coloured by the pressure."""
    import numpy as np

    phi = np.linspace(0.0, design.machine.period, 721)
    roller = design.roller_on_cam(name, phi)
    turned = np.radians(design.cam_degrees(phi))
    contact = roller.position - roller.radius * roller.normal
    points = 1e3 * np.exp(-1j * roller.sense * turned) * contact
    _colored(axes, points, design.contact(name, phi).pressure, f"{name} cam: pressure [N/mm²]")
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=8)


def _colored(axes: Axes, points: Any, values: Any, title: str) -> None:
    import numpy as np
    from matplotlib.collections import LineCollection

    panels.drawing(axes, title)
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    xy = np.column_stack((points.real, points.imag))
    lines = LineCollection(np.stack((xy[:-1], xy[1:]), axis=1).tolist(), cmap="viridis", linewidths=2.6)
    lines.set_array(np.nan_to_num(0.5 * (values[:-1] + values[1:])))
    axes.add_collection(lines)
    axes.autoscale_view()
    bar = axes.figure.colorbar(lines, ax=axes, shrink=0.8, pad=0.02)
    bar.ax.tick_params(labelsize=7)


def stroke_sheet(design: Any) -> Figure:
    """The sheet of a wide-swing stroke: force, pressure, torque of the cam and residual vibration."""
    has = {"pressure": design.section.roller is not None, "residual": design.oscillator is not None}
    count = 2 + sum(has.values())
    made = panels.page(f"{design.spec.name}: loads", 0.21 * count)
    grid = iter(made.subplots(count, 1).ravel())
    _stroke(next(grid), design, "Force of the roller on its cam", "force [N]", "main_force", style.BLUE)
    if has["pressure"]:
        axes = next(grid)
        _stroke(axes, design, "Hertzian pressure", "p [N/mm²]", "main_pressure", style.RED)
        _allowed(axes, design)
        panels.legend_above(axes, 1)
    _stroke(next(grid), design, "Torque on the cam", "torque [N m]", "input_torque", style.GREEN)
    if has["residual"]:
        residual(next(grid), design)
    return made


def _stroke(axes: Axes, design: Any, title: str, ylabel: str, column: str, color: str) -> None:
    table = design.table("contact_stroke", samples=400)
    style.curves(axes, "cam angle [deg]", ylabel)
    panels.small_ticks(axes)
    panels.heading(axes, title)
    axes.plot(table["cam_angle"], table[column].astype(float), color=color, linewidth=1.5)
    axes.set_xlim(0.0, math.degrees(design.cam.cycle_angle))
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
