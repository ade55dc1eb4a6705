"""The figure of `laws`: rise, velocity, acceleration and jerk of motion laws over x, a column for each kind."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import cycle, islice
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.parts.cams.law_tables import MotionLaws

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.base.report import Table
    from gearlink.core.machines.motion_law.design import MotionLawDesign
    from gearlink.core.parts.cams.laws import Law

_HEADINGS = {
    "rest_to_rest": "From rest to rest, over x = 0 to 1",
    "rest_to_speed": "From rest to speed, over x = 0 to 1",
}
_AXES = ("rise s", "velocity v", "acceleration a", "jerk j")
_COLORS = (style.BLUE, style.ORANGE, style.GREEN, style.RED, style.PURPLE, style.SKY, style.BLACK)
_DASHES: Any = ("-", style.LONG, style.DOTTED, style.CHAIN, style.DASHED, "-", style.LONG, style.DOTTED)
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
    figure = panels.page(f"{design.spec.name}: {command}")
    law, vibrates = design.law, design.band is not None
    grid = figure.subplots(len(_AXES) + vibrates, 1, squeeze=False, height_ratios=[1.0] * 4 + [1.7] * vibrates)
    for axes in grid[1:4, 0]:
        axes.sharex(grid[0, 0])
    _column([row[0] for row in grid[: len(_AXES)]], _HEADINGS.get(law.kind.replace("-", "_"), "Over x = 0 to 1"), [law])
    if vibrates:
        residual_panel(grid[-1, 0], [(law.name, design.law, design.damping)], design.table("residual", samples=600))
    return figure


def residual_panel(axes: Axes, laws: Sequence[tuple[str, Law, float]], table: Table) -> None:
    """Vibration left over the natural periods per phase, of some laws and of the usual ones, on a logarithmic axis."""
    import numpy as np

    from gearlink.core.parts.cams.laws import law as law_of
    from gearlink.core.parts.cams.shaped import residuals

    periods = np.asarray(table["periods"], dtype=np.float64)
    damping = laws[0][2]
    curves = [*laws, *((name, law_of(name), damping) for name in BESIDE)]
    panels.heading(axes, "Vibration left, over the rise")
    found = [residuals(each, periods, ratio) for _, each, ratio in curves]
    least = _FAINTEST * max(float(values.max()) for values in found)
    for (name, *_), values, look in zip(curves, found, _looks(len(curves)), strict=True):
        axes.semilogy(periods, np.maximum(values, least), linewidth=1.0 if name in BESIDE else 1.4, label=name, **look)
    style.curves(axes, "", "residual R")
    axes.set_xlim(float(periods.min()), float(periods.max()))
    axes.set_xlabel("natural periods per phase (faster to the left)")
    panels.legend_below(axes, 2, labelled=True)


BESIDE = ("cycloidal", "modified-sine", "polynomial-4567")
_FAINTEST = 1e-5  # of the greatest


def _column(axes: Sequence[Axes], heading: str, laws: Sequence[Law]) -> None:
    import numpy as np

    x = np.linspace(0.0, 1.0, _POINTS)
    panels.heading(axes[0], heading)
    for law, look in zip(laws, _looks(len(laws)), strict=True):
        for each, values in zip(axes, law.evaluate(x, 3), strict=True):
            each.plot(x, values, linewidth=1.2, label=law.name, **look)
    for each, label in zip(axes, _AXES, strict=True):
        style.curves(each, "", label)
        each.set_xlim(0.0, 1.0)
        each.axhline(0.0, color=style.GREY, linewidth=0.6)
    axes[-1].set_xlabel("x, fraction of the time")
    panels.legend_below(axes[-1], 2, labelled=True)


def _looks(count: int) -> list[dict[str, Any]]:
    """Colours and dashes that tell the curves apart."""
    colors = islice(cycle(_COLORS), count)
    return [
        {"color": color, "linestyle": _DASHES[(i + i // len(_COLORS)) % len(_DASHES)]} for i, color in enumerate(colors)
    ]
