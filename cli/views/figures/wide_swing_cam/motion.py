"""Figure of a wide-swing mechanism: its law of motion, cams, pressure angle and balancing."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.wide_swing_cam.parts import (
    cam_panel,
    cams_of,
    has_slots,
    kind_words,
    pressure_panel,
    stroke_axis,
    zone_words,
)
from gearlink.cli.views.scenes.scene import Chain
from gearlink.cli.views.scenes.wide_swing_cam import Cycle, build

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.wide_swing.design import WideSwingDesign

_DASHED: Any = (0, (5, 3))
_DOTTED: Any = (0, (1, 2))
_NAMES = (("displacement", "a"), ("velocity", "b"), ("acceleration", "c"))


def draw(command: str, design: WideSwingDesign) -> Figure:
    """Unit diagrams over the stroke, cams to scale where the profile exists, balance over the speed; torques."""
    cams, moves = design.spec.cam is not None and has_slots(design), design.spec.cam is None
    title = f"{design.spec.name}: {command} ({kind_words(design)})"
    heights = [1.0, 1.75, 1.0] if cams else [1.0, 1.0 + 1.4 * moves]
    share = 0.95 if cams or moves else 0.62
    if design.spec.shaft is not None:
        share *= 1.0 + 1.0 / sum(heights)
        heights.append(1.0)
    made = panels.page(title, share)
    grid = made.add_gridspec(len(heights), 1, height_ratios=heights)
    _law_panels(made, grid[0], design)
    if design.spec.shaft is not None:
        _history_panels(made, grid[len(heights) - 1], design)
    if cams:
        _cam_panels(made, grid[1], design)
    if moves:
        _moving_panels(made, grid[1], design)
        return made
    below = grid[2 if cams else 1].subgridspec(1, 2)
    balance = made.add_subplot(below[0, 1] if cams or design.spec.slider is not None else below[0, :])
    if cams:
        pressure_panel(made.add_subplot(below[0, 0]), design)
    elif design.spec.slider is not None:
        _slider_panel(made.add_subplot(below[0, 0]), design)
    _balance_panel(balance, design)
    return made


def _history_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """Torques of both shafts over the stroke and the rest after it, and the dynamic coefficient over the speed."""
    history, balance = design.table("history"), design.table("balance")
    columns = place.subgridspec(1, 3)
    curves = (
        ("", style.RED, "rigid, without device"),
        ("_balanced", style.BLUE, "rigid, with device"),
        ("_elastic", style.GREEN, "elastic, with device"),
    )
    for i, (shaft, words) in enumerate((("rocker", "Rocker shaft"), ("drive", "Main shaft"))):
        axes = made.add_subplot(columns[0, i])
        style.curves(axes, "time [ms]", "torque [N m]")
        panels.small_ticks(axes)
        for end, color, label in curves:
            axes.plot(history["time"], history[f"{shaft}_torque{end}"], color=color, linewidth=1.3, label=label)
        axes.set_xlim(0.0, float(history["time"][-1]))
        panels.legend_under_heading(axes, words, 1)
    axes = made.add_subplot(columns[0, 2])
    style.curves(axes, "speed [rev/min]", "dynamic coefficient [1]")
    panels.small_ticks(axes)
    axes.plot(balance["speed"], balance["dynamic_coefficient"], color=style.BLUE, linewidth=1.6)
    axes.axvline(design.spec.speed, color=style.GREY, linewidth=0.9, linestyle=_DASHED, label="design speed")
    axes.set_xlim(0.0, float(balance["speed"][-1]))
    axes.set_ylim(bottom=0.0)
    panels.legend_under_heading(axes, "Elastic over rigid torque", 1)


def _moving_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    """A mechanism that has no cam yet, and beside it what the slider does and the balance."""
    slider = design.spec.slider is not None
    panes = place.subgridspec(2 if slider else 1, 2, width_ratios=[1.0, 1.0])
    _mechanism_panel(made.add_subplot(panes[:, 0]), design)
    if slider:
        _slider_panel(made.add_subplot(panes[0, 1]), design)
    _balance_panel(made.add_subplot(panes[-1, 1]), design)


def _mechanism_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Rocker, device and slider to scale at mid-swing; lightly at both ends of the stroke."""
    import numpy as np

    panels.drawing(axes, "Mechanism at mid-swing")
    section = design.spec.slider
    middle = 0.5 if section is None else design.motion.slider.middle_place
    scene = build(design, Cycle(design, np.zeros(1)).share * np.array([middle, 0.0, 1.0]))
    scene_axes.draw(axes, scene)
    device = scene.parts[0]
    assert isinstance(device, Chain), "from its pivot on the frame to its pin on the rocker"
    style.pivot(axes, complex(device.joints[0][0]))
    for i, color, words in ((1, style.ORANGE, "start of the stroke"), (2, style.BLUE, "end of the stroke")):
        scene_axes.lightly(axes, scene, i, color, words)
    axes.plot([], [], color=style.GREEN, linewidth=4.0, label="unloading device")
    if section is not None:
        links = scene.parts[-1]
        assert isinstance(links, Chain), "rocker and rod, to the slider"
        near, far = (complex(links.joints[-1][i]) for i in (1, 2))
        aside = section.crank + 0.3 * section.rod
        start, end = (complex(-aside, point.imag) for point in (near, far))
        words = f"stroke {style.number(abs(far - near))} mm"
        style.dimension(axes, start, end, words, from_points=(near, far), upright=True)
    axes.margins(0.06)
    axes.autoscale_view()
    panels.legend_below(axes)


def _law_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    from gearlink.core.parts.cams.laws import law

    table = design.table("law")
    k: Any = table.data[0]
    others = (("harmonic", law("simple-harmonic"), _DASHED), ("cycloidal", law("cycloidal"), _DOTTED))
    columns = place.subgridspec(1, 3)
    for i, (name, symbol) in enumerate(_NAMES):
        axes = made.add_subplot(columns[0, i])
        panels.heading(axes, name.capitalize())
        stroke_axis(axes, design, f"{symbol} [1]")
        for words, other, dashes in others:
            curve = other.evaluate(k, 2)[i]
            axes.plot(k, curve, color=style.GREY, linewidth=0.9, linestyle=dashes, label=words)
        axes.plot(k, table.data[1 + i], color=style.BLUE, linewidth=1.8, label="unloaded law")
        if i == 0:
            axes.legend(loc="upper left", frameon=False, fontsize=7.5, handlelength=1.8)
        peak = (None, design.motion.law.velocity_peak, design.motion.law.acceleration_peak)[i]
        if peak is not None:
            axes.set_title(f"peak {peak:.5g}", loc="right", fontsize=8)


def _cam_panels(made: Figure, place: Any, design: WideSwingDesign) -> None:
    drawn = cams_of(design)
    rows = place.subgridspec(2, len(drawn), height_ratios=[1.0, 0.09])
    for i, (title, cam, mirror) in enumerate(drawn):
        axes = made.add_subplot(rows[0, i])
        cam_panel(axes, design, title, cam, mirror)
        zone_words(axes, cam)
    legend_row(made.add_subplot(rows[1, :]), axes)


def legend_row(axes: Axes, drawing: Axes) -> None:
    """The legend of drawings in a panel of its own below them."""
    axes.set_axis_off()
    handles, labels = drawing.get_legend_handles_labels()
    axes.legend(handles, labels, loc="center", ncols=4, frameon=False, fontsize=7.5, columnspacing=1.4)


def _balance_panel(axes: Axes, design: WideSwingDesign) -> None:
    """Torque peaks on the rocker axis over the speed; where it is shaded the device does harm."""
    import numpy as np

    from gearlink.core.machines.wide_swing.design import torque_peaks
    from gearlink.core.numerics.extremes import minimum_over

    rows: Any = design.table("balance").data[0]
    least = minimum_over(lambda n: torque_peaks(design, n / design.spec.speed)[1], float(rows[0]), float(rows[-1]))
    speed = np.unique(np.concatenate([rows, np.linspace(rows[0], rows[-1], 241), [least.place]]))
    without, with_device = torque_peaks(design, speed / design.spec.speed)
    style.curves(axes, "speed [rev/min]", "torque peak [N m]")
    panels.small_ticks(axes)
    axes.plot(speed, without, color=style.RED, linewidth=1.6, label="without device")
    axes.plot(speed, with_device, color=style.BLUE, linewidth=1.6, label="with device", gid="with-device")
    usual = design.spec.speed / math.sqrt(2.0)
    axes.axvspan(0.0, design.unloading.harmful_speed, color=style.LIGHT, alpha=0.45, linewidth=0, zorder=0)
    axes.axvline(usual, color=style.GREY, linewidth=0.9, linestyle=_DASHED)
    axes.axvline(design.spec.speed, color=style.GREY, linewidth=0.9, linestyle=_DASHED)
    for place, words in ((usual, "n₀/√2"), (design.spec.speed, "n₀")):
        where: dict[str, Any] = {
            "xycoords": ("data", "axes fraction"),
            "textcoords": "offset points",
            "ha": "right",
            "va": "top",
        }
        axes.annotate(words, (place, 1.0), (-3, -2), fontsize=8.5, **where)
    axes.set_xlim(0.0, float(speed[-1]))
    axes.set_ylim(bottom=0.0)
    lowest = design.spec.operating_speed_min
    if lowest is not None:
        axes.axvline(lowest, color=style.GREEN, linewidth=1.0, linestyle=_DOTTED, label="minimum working speed")
    axes.axvspan(-2.0, -1.0, color=style.LIGHT, alpha=0.45, label="harmful")
    panels.extreme(axes, least.place, least.value, above=True, unit=" N m", at=" rev/min")
    panels.legend_under_heading(axes, "Torque on the rocker axis", 2)


def _slider_panel(axes: Axes, design: WideSwingDesign) -> None:
    """The slider's travel, speed and acceleration as invariants."""
    table = design.table("slider")
    stroke_axis(axes, design, "invariants of the slider")
    for column, color in (("displacement", style.GREEN), ("velocity", style.BLUE), ("acceleration", style.RED)):
        values = table.data[table.columns.index(column)]
        axes.plot(table.data[0], values, color=color, linewidth=1.6, label=column)
    axes.axvline(
        design.motion.slider.middle_place, color=style.GREY, linewidth=0.9, linestyle=_DASHED, label="mid-swing"
    )
    panels.legend_under_heading(axes, "Slider", 2)
