"""The figure of `laws`: rise, velocity, acceleration and jerk of motion laws over x, a column for each kind."""

from __future__ import annotations

from collections import Counter
from collections.abc import Mapping, Sequence
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.parts.cams.law_tables import MotionLaws, acceleration_jumps
from gearlink.core.parts.cams.laws import Law
from gearlink.core.parts.cams.laws import law as law_of

if TYPE_CHECKING:
    from pathlib import Path

    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.options import Options
    from gearlink.core.machines.motion_law import MotionLawDesign
    from gearlink.core.parts.cams.shaped_design import Vibration

_HEADINGS = {
    "rest_to_rest": "From rest to rest, over x = 0 to 1",
    "rest_to_speed": "From rest to speed, over x = 0 to 1",
}
_AXES = ("rise s", "velocity v", "acceleration a", "jerk j")
_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, style.BLACK)
_DASHES: Any = ("-", style.LONG, style.DOTTED, style.CHAIN, style.DASHED)
# Of all rest-to-speed laws these are drawn where none is named: the others hardly differ from one of them.
_SHOWN = (
    "half-cycloidal",
    "half-modified-trapezoid",
    "half-modified-sine",
    "half-polynomial-345",
    "velocity-polynomial-345",
    "velocity-polynomial-4567",
    "velocity-modified-sine",
)
_POINTS = 2001


def draw(design: MotionLaws) -> Figure:
    """Four panels below each other for every kind of law."""
    groups = design.groups
    if not design.spec.laws:
        groups["rest_to_speed"] = [law for law in groups["rest_to_speed"] if law.name in _SHOWN]
    figure = panels.page("Motion laws")
    grid = figure.subplots(len(_AXES), len(groups), sharex=True, squeeze=False)
    for column, (name, laws) in enumerate(groups.items()):
        _column([row[column] for row in grid], _HEADINGS[name], laws)
    return figure


def draw_design(command: str, design: MotionLawDesign) -> Figure:
    """Rise and derivatives of the law of a file, and the vibration that it leaves beside that of usual laws."""
    from gearlink.core.parts.cams.shaped import residuals
    from gearlink.core.parts.cams.shaped_design import BESIDE

    figure = panels.page(f"{design.spec.name}: {command}")
    law, vibrates = design.law, design.band is not None
    grid = figure.subplots(len(_AXES) + vibrates, 1, squeeze=False, height_ratios=[1.0] * 4 + [1.7] * vibrates)
    for axes in grid[1:4, 0]:
        axes.sharex(grid[0, 0])
    _column([row[0] for row in grid[: len(_AXES)]], _HEADINGS.get(law.kind.replace("-", "_"), "Over x = 0 to 1"), [law])
    if vibrates:
        periods = np.asarray(design.table("residual", samples=600)["periods"], dtype=np.float64)
        beside = {name: law_of(name) for name in BESIDE}
        left = {name: residuals(each, periods, design.damping) for name, each in {law.name: law, **beside}.items()}
        residual_panel(grid[-1, 0], "Residual vibration over the rise", periods, left)
        grid[-1, 0].set_xlabel("natural periods per phase (faster to the left)")
    return figure


def residual_panel(axes: Axes, heading: str, x: Any, left: Mapping[str, Any]) -> None:
    """Vibration left over x by the names of laws, on a logarithmic axis."""
    panels.heading(axes, heading)
    least = _FAINTEST * max(float(values.max()) for values in left.values())
    for k, (name, values, look) in enumerate(zip(left, left.values(), _looks(len(left)), strict=True)):
        axes.semilogy(x, np.maximum(values, least), linewidth=1.0 if k else 1.6, label=name, **look)
    style.curves(axes, "", "residual R")
    axes.set_xlim(float(np.min(x)), float(np.max(x)))
    panels.legend_below(axes, 2, labelled=True)


def write_residuals(name: str, found: Sequence[Vibration], options: Options) -> Path:
    """Draw what the laws of a design leave over the speed, and write NAME-residual-chart.FORMAT.

    Raises
        CannotWrite - where the folder or the disk does not take the file
    """
    from gearlink.cli.views.figures.drawing.placing import settled
    from gearlink.cli.views.figures.write import write_figure

    def make() -> Figure:
        figure = panels.page(f"{name}: residual vibration of its laws, over the rise")
        grid = figure.subplots(len(found), 1, squeeze=False)
        for axes, each in zip(grid[:, 0], found, strict=True):
            residual_panel(axes, f"{each.path}: {next(iter(each.residuals))}", each.speed, each.residuals)
            unit = "share of the design's speed" if each.unit == "1" else f"speed [{each.unit}]"
            axes.set_xlabel(unit)
        return settled(figure)

    return write_figure(make, name, "residual-chart", options)


_FAINTEST = 1e-5  # of the maximum


def _column(axes: Sequence[Axes], heading: str, laws: Sequence[Law]) -> None:
    x = np.linspace(0.0, 1.0, _POINTS)
    panels.heading(axes[0], heading)
    infinite: Counter[tuple[float, bool]] = Counter()
    for law, look in zip(laws, _looks(len(laws)), strict=True):
        for each, values in zip(axes, law.evaluate(x, 3), strict=True):
            each.plot(x, values, linewidth=1.2, label=law.name, **look)
        _mark_infinite(axes[-1], law, look["color"], infinite)
    for each, label in zip(axes, _AXES, strict=True):
        style.curves(each, "", label)
        each.set_xlim(0.0, 1.0)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
    if infinite:
        axes[-1].plot([], [], marker="^", linestyle="", color=style.GREY, label="infinite: the acceleration jumps")
    axes[-1].set_xlabel("x, fraction of the time")
    panels.legend_below(axes[-1], 2, labelled=True)


def _mark_infinite(axes: Axes, law: Law, color: str, taken: Counter[tuple[float, bool]]) -> None:
    """A triangle at the edge of the panel wherever the jerk of a law is infinite, below those of other laws there."""
    for x, jump in acceleration_jumps(law):
        up = jump > 0.0
        below = _NEXT * taken[x, up]
        at, marker = (1.0 - below, "^") if up else (below, "v")
        taken[x, up] += 1
        axes.plot([x], [at], marker=marker, color=color, markersize=7, linestyle="", clip_on=False, zorder=5,
                  transform=axes.get_xaxis_transform(), label="_infinite")  # fmt: skip


_NEXT = 0.05
"""Of the height of the panel, from one triangle to the next."""


def _looks(count: int) -> list[dict[str, Any]]:
    """Colours and dashes that tell 35 curves apart: there are 7 colours and 5 dashes, without a common divisor."""
    return [{"color": c, "linestyle": d} for c, d in islice(zip(cycle(_COLORS), cycle(_DASHES), strict=False), count)]
