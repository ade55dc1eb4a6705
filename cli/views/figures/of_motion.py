"""The picture of any mechanism: its links in two positions, and the motion of its output."""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import failing, panels, scene_axes, style, time_axes
from gearlink.cli.views.scenes import shown
from gearlink.cli.views.scenes.linkages import builder
from gearlink.cli.views.scenes.of_motion import inputs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.base.report import Check
    from gearlink.core.mechanism.motion import Motion

_LABELS = ("position", "velocity", "acceleration")
_SHOWN = 0.125
"""Share of the loop: where it begins links often lie in line."""
_HIGH = 1.8
"""Height of a mechanism over its width from which it stands beside the curves."""
_ABOVE = "Mechanism after an eighth of the cycle, pale half a cycle later"
_COLORS = (style.BLUE, style.GREEN, style.PURPLE)
_PLACES = 360
"""Of the loop, at which is looked for what fails."""


def draw(command: str, design: Any) -> Figure:
    """The picture of a command; beside the curves where the mechanism is high, else above them."""
    motion = design.moving
    made = panels.page(f"{design.spec.name}: {command}")
    paths = [shown.Wish("path", point) for point in design.traced]
    scene = shown.build(design, np.array([_SHOWN, _SHOWN + 0.5]), paths)
    wide, high = scene_axes.sides(scene)
    beside = high > _HIGH * wide
    grid: Any = made.add_gridspec(3, 2) if beside else made.add_gridspec(4, 1, height_ratios=(2.2, 1.0, 1.0, 1.0))
    mechanism = made.add_subplot(grid[:, 0] if beside else grid[0])
    words = "After an eighth of the cycle, pale half later" if beside else _ABOVE
    panels.drawing(mechanism, words)
    ahead = shown.build(design, np.array([_SHOWN + scene_axes.AHEAD]), paths)
    scene_axes.draw(mechanism, scene, ahead=ahead, driven=_driven(motion))
    scene_axes.lightly(mechanism, scene, 1)
    rows = [made.add_subplot(grid[order, 1] if beside else grid[order + 1]) for order in range(3)]
    for order, axes in enumerate(rows):
        _curve(axes, motion, order, narrow=beside)
    panels.heading(rows[0], motion.outputs[0].name.replace("_", " "))
    vars(made)["over_input"] = [rows]
    time_axes.over_input(rows[-1], time_axes.turn_time(design))
    return made


def instants(made: Figure, design: Any, checks: Sequence[Check]) -> None:
    """Curves over the input again in red where a check fails, on sheets that name their panels as `over_input`."""
    columns: list[list[Axes]] = vars(made).get("over_input", [])
    if not columns:
        return
    given, shares = design.moving.input, np.arange(_PLACES + 1) / _PLACES
    faults = [fault for fault in shown.build(design, shares, (), checks).faults if fault.placed]
    if not faults:
        return
    frame = shown.frame_of(design, builder(design.kind))
    q = inputs(given, shares) if frame is None else frame.inputs(shares)
    place, period = (np.degrees(q), math.degrees(given.end - given.start)) if given.unit == "rad" else (q, None)
    order, period = np.argsort(place), period if given.turns else None
    for rows in columns:
        for fault, axes in ((fault, axes) for fault in faults for axes in rows):
            curve = max(axes.lines, key=lambda line: len(np.asarray(line.get_xdata())))
            x, y = (np.asarray(data, dtype=float) for data in curve.get_data())
            bad = np.interp(x, place[order], fault.at[order], period=period) > 0.5
            failing.past(axes, x, y, bad, " ".join(fault.words.split()[:2]))  # code and name
        if rows[0].get_legend_handles_labels()[1] and not rows[0].child_axes:  # above it are names of phases
            if len(columns) > 1:  # a panel of half the page has no room beside its heading
                panels.legend_under_heading(rows[0], str(rows[0].get_title(loc="left")), 1)
            else:
                panels.legend_above(rows[0], 3)


def _driven(motion: Motion) -> tuple[complex, float] | None:
    """Axis of the link that the input turns and how far it turns until the position ahead; None of other inputs."""
    first, later = (inputs(motion.input, np.array([share])) for share in (_SHOWN, _SHOWN + scene_axes.AHEAD))
    now, then = motion.at(first, 0), motion.at(later, 0)
    link, moved = now.links.get(now.drive), then.links.get(then.drive)
    if link is None or moved is None or abs(complex(moved.origin.value[0] - link.origin.value[0])) > 1e-9:
        return None
    return complex(link.origin.value[0]), float(moved.turn.value[0] - link.turn.value[0])


def _curve(axes: Axes, motion: Motion, order: int, *, narrow: bool) -> None:
    """The output or one of its derivatives over the input."""
    given, output = motion.input, motion.outputs[0]
    turning, angle = given.unit == "rad", output.course.unit == "rad"
    q = np.linspace(given.start, given.end, 721)
    rate = output.course.rates(motion, q, order)[order]
    unit = panels.per_input(output.course.unit, order, given.unit)
    x_label = f"{given.column.replace('_', ' ')} [{'deg' if turning else 'mm'}]" if order == 2 else ""
    panels.turn_panel(axes, f"{_LABELS[order]} [{unit}]", x_label)
    if given.turns != 1:
        panels.few_ticks(axes.xaxis, 5 if narrow else 9)
    elif narrow:
        style.full_turn(axes)
    axes.set_xlim(*(math.degrees(end) if turning else end for end in (given.start, given.end)))
    x, y = np.degrees(q) if turning else q, np.degrees(rate) if angle and order == 0 else rate
    axes.plot(x, y, color=_COLORS[order], linewidth=1.6)
