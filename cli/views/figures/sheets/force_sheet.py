"""Sheet of forces on one A4: the mechanism with force arrows, the torque, a small panel for each joint and mesh."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.sheets.vector_sheet import fraction_at, frame_of
from gearlink.cli.views.scenes import shown
from gearlink.core.base.kinds import KINDS
from gearlink.core.mechanism import vectors

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.scenes.scene import Reals

_COLUMNS = 4
_SAME = 1e-9
"""Of a force: joints whose forces differ by less share a panel."""


def draws(design: Any) -> bool:
    """Whether a design has forces."""
    loads = shown.loads_design(design)
    return loads is not None and not loads.locked


def draw(design: Any) -> Figure:
    """The mechanism at the largest torque, the torque over the input, and every force on a scale of its own."""
    loads = shown.loads_design(design)
    groups = list(courses(loads).items())
    rows = math.ceil(len(groups) / _COLUMNS)
    made = panels.page(f"{loads.spec.name}: forces", min(1.0, 0.34 + 0.135 * rows))
    grid: Any = made.add_gridspec(rows + 1, _COLUMNS, height_ratios=[2.4] + [1.0] * rows)
    half = _COLUMNS // 2
    mechanism(made.add_subplot(grid[0, :half]), loads)
    _torque(made.add_subplot(grid[0, half:]), loads)
    for k, (names, values) in enumerate(groups):
        _force(made.add_subplot(grid[1 + k // _COLUMNS, k % _COLUMNS]), loads, names, values)
    return made


def _inputs(loads: Any) -> Reals:
    return np.linspace(0.0, loads.machine.period, 361)


def courses(loads: Any) -> dict[str, Reals]:
    """Magnitudes of all forces over the period [N], those that are equal under one name, the largest first."""
    found = vectors.loads_of(loads.machine.reactions(_inputs(loads)), tuple(loads.unknown_joints))
    groups: list[tuple[list[str], Reals]] = []
    for name, load in found.items():
        size = np.abs(load.force)
        for names, other in groups:
            if np.allclose(size, other, rtol=_SAME, atol=_SAME * float(other.max())):
                names.append(name)
                break
        else:
            groups.append(([name], size))
    groups.sort(key=lambda group: -float(group[1].max()))
    return {", ".join(name.replace("_", " ") for name in names): values for names, values in groups}


def largest_torque(loads: Any) -> float:
    """Input at which the torque is largest in magnitude [rad]."""
    place = max(loads.torque_range, key=lambda extreme: abs(extreme.value)).place
    return float(place)


def mechanism(axes: Axes, loads: Any) -> None:
    """The mechanism with the forces on the second link of each joint, at the input of the largest torque."""
    design, q = analysed(loads), largest_torque(loads)
    scene = shown.build(design, np.array([fraction_at(frame_of(design), q % _period(design))]), shown.wishes("force"))
    panels.drawing(axes, f"At the largest torque, input angle {math.degrees(q):.4g}°")
    scene_axes.draw(axes, scene)


def _period(design: Any) -> float:
    given = design.moving.input
    return float(given.end - given.start) if given.turns else math.inf


def analysed(loads: Any) -> Any:
    """The design of the same file that its scene is made of."""
    if not hasattr(type(loads), "unknown_joints"):
        return loads
    commands = loads.spec.commands()
    return KINDS[loads.kind].design("analyze" if "analyze" in commands else commands[0], loads.spec)


def _over_input(axes: Axes, loads: Any) -> Reals:
    x = np.degrees(_inputs(loads))
    style.curves(axes, "", "")
    panels.small_ticks(axes)
    axes.set_xlim(0.0, float(x[-1]))
    style.numbers_at(axes, [float(each) for each in np.linspace(0.0, x[-1], 5)])
    axes.tick_params(labelsize=6.5)
    return x


def _torque(axes: Axes, loads: Any) -> None:
    x = _over_input(axes, loads)
    panels.heading(axes, "Input torque [N m] over the input [deg]")
    axes.axhline(0.0, color=style.BLACK, linewidth=0.7)
    axes.plot(x, loads.machine.torque(_inputs(loads)), color=style.BLUE, linewidth=1.5, gid="torque")
    axes.axvline(math.degrees(largest_torque(loads)), color=style.GREY, linewidth=0.9, linestyle=style.DASHED)
    for extreme, above in zip(loads.torque_range, (False, True), strict=True):
        panels.extreme(axes, math.degrees(extreme.place), extreme.value, above=above, unit=" N m")
    axes.margins(y=0.25)


def _force(axes: Axes, loads: Any, names: str, values: Reals) -> None:
    x = _over_input(axes, loads)
    k = int(np.argmax(values))
    words = names if len(names) < 24 else f"{names[:22]}…"
    axes.set_title(f"{words}: ≤ {float(f'{values[k]:.4g}'):g} N", loc="left", fontsize=7.5, fontweight="bold")
    axes.plot(x, values, color=style.RED, linewidth=1.2, gid=f"force {names}")
    axes.plot(x[k : k + 1], values[k : k + 1], "o", color=style.BLACK, markersize=3)
    panels.few_ticks(axes.yaxis, 4)
    axes.set_ylim(0.0, 1.15 * float(values[k]) or 1.0)
