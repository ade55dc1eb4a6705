"""Panels of rollers on cams under load: forces, pressures, the profile coloured by pressure, residual over speed."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, style, time_axes

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_TURN = 360.0


def forces(axes: Axes, design: Any) -> None:
    """Force between each roller and its cam."""
    x, columns = _contact(axes, design, "Contact forces", "force [N]")
    for name, color, line in zip(design.own_rollers, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        axes.plot(x, columns[f"{name}_force"], color=color, linestyle=line, linewidth=1.4, label=f"{name} roller")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    panels.legend_above(axes, 2)


def pressures(axes: Axes, design: Any) -> None:
    """Hertzian pressure of each roller, and what is allowed."""
    x, columns = _contact(axes, design, "Hertzian pressure", "p [N/mm²]")
    for name, color, line in zip(design.own_rollers, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        axes.plot(x, columns[f"{name}_pressure"], color=color, linestyle=line, linewidth=1.4, label=f"{name} roller")
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

    phi = np.linspace(0.0, design.machine.period, 361)
    roller = design.roller_on_cam(name, phi)
    turned = np.radians(design.cam_degrees(phi))
    contact = roller.position - roller.radius * roller.normal
    points = np.exp(-1j * roller.sense * turned) * contact
    _colored(axes, points, design.contact(name, phi).pressure, f"{name} cam: pressure [N/mm²]")
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=8)


def _colored(axes: Axes, points: Any, values: Any, title: str) -> None:
    import numpy as np
    from matplotlib.collections import LineCollection

    panels.drawing(axes, title)
    panels.few_ticks(axes.xaxis, 4)
    axes.set_title(title, loc="left", fontsize=9, fontweight="bold")
    xy = np.column_stack((points.real, points.imag))
    pieces, level = np.stack((xy[:-1], xy[1:]), axis=1), 0.5 * (values[:-1] + values[1:])
    whole = np.isfinite(pieces).all(axis=(1, 2))
    known = whole & np.isfinite(level)
    lines = LineCollection(pieces[known].tolist(), cmap="viridis", linewidths=2.6)
    lines.set_array(level[known])
    axes.add_collection(lines)
    undercut = whole & ~known
    if undercut.any():
        red = LineCollection(pieces[undercut].tolist(), colors=style.RED, linewidths=2.6, label="undercut")
        axes.add_collection(red)
        panels.legend_above(axes, 1)
    axes.autoscale_view()
    # A panel of its own would count twice in the layout of matplotlib before 3.11.
    scale = axes.inset_axes((1.03, 0.1, 0.05, 0.8))
    axes.figure.colorbar(lines, cax=scale)
    scale.tick_params(labelsize=7)


def stroke_sheet(design: Any) -> Figure:
    """The sheet of a wide-swing stroke: force, pressure, torque of the cam, residual vibration, and the cam."""
    has = {"pressure": design.section.roller is not None, "residual": design.section.vibration is not None}
    count = 2 + sum(has.values())
    made = panels.page(f"{design.spec.name}: loads", 0.21 * count + 0.3 * has["pressure"])
    rows = made.add_gridspec(count + has["pressure"], 1, height_ratios=[1.0] * count + [1.5] * has["pressure"])
    grid = iter(made.add_subplot(rows[row, 0]) for row in range(count + has["pressure"]))
    stroke_forces(next(grid), design)
    if has["pressure"]:
        stroke_pressures(next(grid), design)
    axes = next(grid)
    title = "Torque on the cam" if design.spec.drive is None else "Torque on the crank"
    _stroke(axes, design, title, "torque [N m]", "input_torque")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)
    time_axes.once(made.axes, 2e3 * math.pi / design.speed)
    if has["residual"]:
        residual(next(grid), design)
    if has["pressure"]:
        stroke_profile(next(grid), design.strokes[0])
    return made


def stroke_forces(axes: Axes, design: Any) -> None:
    """Force of the roller on the cam of each stroke; empty where it touches nothing."""
    _stroke(axes, design, "Force of the roller on its cam", "force [N]", "{}_force", lambda rest: rest.force)
    axes.axhline(0.0, color=style.BLACK, linewidth=0.8)


def stroke_pressures(axes: Axes, design: Any) -> None:
    """Hertzian pressure over each stroke, and what is allowed."""
    _stroke(axes, design, "Hertzian pressure", "p [N/mm²]", "{}_pressure", lambda rest: rest.pressure)
    _allowed(axes, design)
    axes.set_ylim(bottom=0.0)
    panels.legend_above(axes, 4)


def stroke_profile(axes: Axes, stroke: Any) -> None:
    """The cam of a stroke, its profile coloured by the pressure; open where the roller stands in its slot."""
    import numpy as np

    parts = [np.linspace(low, high, 121) for low, high in stroke.parts]
    gap = 0.5 * (parts[0][-1] + parts[1][0])
    k = np.concatenate([parts[0], [gap], parts[1]])
    points, pressure = stroke.cam.points(stroke.at.profile(k)[0]).profile, stroke.contact(k).pressure
    points[len(parts[0])] = complex(np.nan, np.nan)
    _colored(axes, points, pressure, f"{stroke.cam_words}: pressure [N/mm²]")
    axes.plot([0.0], [0.0], "+", color=style.BLACK, markersize=8)


def _stroke(axes: Axes, design: Any, title: str, ylabel: str, column: str, in_rest: Any = None) -> None:
    """A column of each stroke over the cam angle, and a function of the rests, in which the rollers press as well."""
    import numpy as np

    table = design.table("contact_stroke", samples=400)
    style.curves(axes, f"{'cam' if design.spec.drive is None else 'crank'} angle [deg]", ylabel)
    panels.small_ticks(axes)
    panels.heading(axes, title)
    for stroke, color, line in zip(design.strokes, panels.CAM_COLORS, panels.CAM_LINES, strict=False):
        later = "" if stroke.name == "main" else "return_"
        values = table[column.format(stroke.name) if "{}" in column else f"{later}{column}"].astype(float)
        x = table[f"{later}cam_angle"]
        axes.plot(x, values, color=color, linewidth=1.5, linestyle=line, label=stroke.words)
    rests = design.pressing.rests if in_rest is not None else ()
    for number, rest in enumerate(rests):
        phi = np.linspace(rest.start, rest.start + rest.width, 61)
        label = None if number else "rests"
        axes.plot(
            np.degrees(phi), in_rest(rest)(phi), color=style.GREEN, linewidth=1.5, linestyle=style.CHAIN, label=label
        )
    axes.set_xlim(0.0, _TURN if design.whole else math.degrees(design.cam.cycle_angle))
    if design.whole:
        style.numbers_at(axes, [30.0 * i for i in range(13)])
    if len(design.strokes) > 1:
        panels.legend_above(axes, 3)
