"""Sheet of a register budget: the error along the stretch for both torque signs, and its sources."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import linkage, panels, style, time_axes
from gearlink.core.studies.tolerance.budget import Budget, Row, at_worst

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.studies.register import RegisterDesign

_LINES = ("-", style.DASHED)
_BAR = 0.025
"""Height of the bar of a source, that of a page being 1."""
_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.BLACK, style.SKY)


def draw(design: RegisterDesign) -> Figure:
    """The sheet: along the stretch, as a whole and by source, over the cycle, and what is greatest."""
    along = design.input_angles.size > 1
    panels_of = (_stretch, _along, _cycle, _sources) if along else (_cycle, _sources)
    bars = max(0.3, _BAR * len(_signs(design)[0][1].rows))
    share = 0.3 * (len(panels_of) - 1) + bars + 0.1
    heights = [*[0.3] * (len(panels_of) - 1), bars]
    made, rows = panels.stack(f"{design.spec.name}: register", heights, share, large=share > 1.5)
    for axes, draw_one in zip(rows, panels_of, strict=True):
        draw_one(axes, design)
    return made


def _signs(design: RegisterDesign) -> list[tuple[str, Budget]]:
    """The budgets to draw, each with its name: one where the flank does not matter."""
    from gearlink.core.studies.register import are_alike

    one, other = design.budgets
    return [("", one)] if are_alike(one, other) else [(" torque +1", one), (" torque −1", other)]


def _stretch(axes: Axes, design: RegisterDesign) -> None:
    """Band and worst case relative to the start of the stretch."""
    degrees = np.degrees(design.input_angles)
    panels.curves(axes, "input angle [deg]", "error [mm]")
    for (name, found), line in zip(_signs(design), _LINES, strict=False):
        axes.plot(degrees, found.band, color=style.BLUE, linestyle=line, linewidth=1.6, label=f"99.73 %{name}")
        axes.plot(degrees, found.worst, color=style.ORANGE, linestyle=line, linewidth=1.1, label=f"worst{name}")
    if (limit := design.section.tolerance) is not None:
        axes.axhline(limit, color=style.RED, linewidth=1.2, linestyle=style.CHAIN, label="allowed")
    places = (math.degrees(flip) for flip in design.flips or ())
    shown = (place + 360.0 * math.ceil((degrees[0] - place) / 360.0) for place in places)
    linkage.standstills(axes, [math.radians(place) for place in shown if place <= degrees[-1]], "torque turns")
    axes.set_xlim(degrees[0], degrees[-1])
    _finish(axes, design, f"Over the {design.place}, relative to its start", 4)


def _along(axes: Axes, design: RegisterDesign) -> None:
    """The maximum sources along the stretch, each at its limit, relative to its start."""
    degrees = np.degrees(design.input_angles)
    panels.curves(axes, "input angle [deg]", "error [mm]")
    both = [design.contributions(design.input_angles, sign) for sign in (1, -1)][: len(_signs(design))]
    costs = [{one.source: one.limit * at_worst(one, 0) for one in found} for found in both]
    order = sorted(costs[0], key=lambda name: -max(float(cost[name].max()) for cost in costs))
    for name, color in zip(order, _COLORS, strict=False):
        for cost, line in zip(costs, _LINES, strict=False):
            label = panels.abridged(name) if line == "-" else None
            axes.plot(degrees, cost[name], color=color, linestyle=line, label=label)
    axes.set_xlim(degrees[0], degrees[-1])
    shown = f", the {len(_COLORS)} largest of {len(order)}" if len(order) > len(_COLORS) else ""
    dashed = "; dashed: torque −1" if len(costs) > 1 else ""
    _finish(axes, design, f"By source, each at its limit{shown}{dashed}", 3)


_SHORTEST_TURN = 350.0
"""From the first to the last row of a revolution at least [deg]; what is shorter is a range."""


def _cycle(axes: Axes, design: RegisterDesign) -> None:
    """Absolute error over the whole cycle."""
    table = design.table_cycle()
    signs, degrees, band = (np.asarray(table[name]) for name in ("torque_sign", "input_angle", "band"))
    panels.curves(axes, "input angle [deg]", "error [mm]")
    names = _signs(design)
    for sign, (name, _), line in zip((1, -1), names, _LINES, strict=False):
        here = signs == sign
        axes.plot(degrees[here], band[here], color=style.BLUE, linestyle=line, label=f"99.73 %{name}")
    if degrees[-1] - degrees[0] < _SHORTEST_TURN:
        style.degrees(axes, float(degrees[0]), float(degrees[-1]))
    else:
        style.full_turn(axes)
    known = "" if np.isfinite(band).all() else "; without a cam not defined outside the zone"
    _finish(axes, design, f"Over the cycle, absolute{known}", 4)


def _finish(axes: Axes, design: Any, title: str, columns: int) -> None:
    """The input angle in time, at the speed of the design that is budgeted; errors from 0 to a little above all."""
    time_axes.over_input(axes, time_axes.turn_time(design.design))
    axes.set_ylim(0.0, 1.05 * axes.dataLim.y1 or None)
    panels.legend_under_heading(axes, title, columns)


def _sources(axes: Axes, design: RegisterDesign) -> None:
    """Three sigma of every source, and its mean, where the whole is greatest."""
    panels.curves(axes, "3 sigma and mean at the maximum of the total [mm]", "")
    found = _signs(design)
    order = sorted(found[0][1].rows, key=_width)
    height = 0.8 / len(found)
    for i, (name, one) in enumerate(found):
        width = {row.source: _width(row) for row in one.rows}
        places = [j + (i - 0.5 * (len(found) - 1)) * height for j in range(len(order))]
        color = (style.BLUE, style.SKY)[i]
        label = name.strip() or None
        axes.barh(places, [width[row.source] for row in order], height=height, color=color, label=label)
    panels.bars_named(axes, [row.source for row in order], 7)
    if len(found) > 1:
        panels.legend_under_heading(axes, "By source", 2)
    else:
        panels.heading(axes, "By source")


def _width(row: Row) -> float:
    return 3.0 * row.sigma + abs(row.mean)
