"""The sheet of a study: every two objectives against each other, and each kept design as a line across all axes.

Marks and lines of one design bear its index in their id, `row-36-...`, so that a page can link them.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.core.base.wording import amount

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from gearlink.core.base.design import Design
    from gearlink.core.studies.explore.exploration import Exploration
    from gearlink.core.studies.explore.order import Variable

_FEASIBLE, _FEASIBLE_SCALAR = 5000, 150
_MOST_LINES = 200
_GREY = "#BBBBBB"
_RING: dict[str, Any] = {"markerfacecolor": "none", "markeredgecolor": style.RED, "markersize": 10}
_LEGEND: dict[str, Any] = {"fontsize": 8, "frameon": False}
_LOW, _HIGH = "#8FBBE3", "#0B3C6F"
_NAMED = 16
"""Kept designs at most whose numbers stand at their lines."""


def draw(_command: str, design: Design) -> Figure:
    """Scatter matrix of the objectives above, parallel coordinates below."""
    study = cast("Exploration", design)
    if not study.kept:
        return _empty(study)
    requirements = study.problem.objectives
    count = len(requirements)
    pairs = [(i, j) for i in range(1, count) for j in range(i)]
    across = max(1, count - 1)
    made = panels.page(f"{study.spec.name}: {study.kept} kept designs", 0.25 * across + 0.31)
    grid = made.add_gridspec(across + 1, across, height_ratios=[1.0] * across + [1.25])
    figures = np.array([row.figures[:count] for row in study.found.rows], dtype=float)
    most = _FEASIBLE_SCALAR if study.problem.axis is None else _FEASIBLE
    grey = study.found.sample(most)[:, :count]  # a share of all designs that satisfy everything
    for i, j in pairs or [(0, 0)]:
        axes = made.add_subplot(grid[max(0, i - 1), j])
        _scatter(axes, study, figures, grey, (j, i))
    if count > 2:
        corner = made.add_subplot(grid[0, across - 1])  # empty in the matrix
        corner.axis("off")
        corner.legend(handles=_marks(study), loc="center", **_LEGEND)
    elif count == 2:
        axes.legend(handles=_marks(study), loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=3, **_LEGEND)
    _parallel(made.add_subplot(grid[across, :]), study, figures)
    vars(made)["names_of_rows"] = row_names(study)
    return made


def row_names(study: Exploration) -> dict[str, str]:
    """What a kept design is called under the pointer, by its index: variables and objectives with their values."""
    units, objectives = study.problem.base.units, study.problem.objectives
    found: dict[str, str] = {}
    for row in study.found.rows:
        parts = [(path, value, units.get(path, "1")) for path, value in row.variables]
        parts += [(one.name, float(value), one.unit) for one, value in zip(objectives, row.figures, strict=False)]
        shown = (
            f"{name} {style.number(value, 5) if isinstance(value, float) else value} {unit}".removesuffix(" 1")
            for name, value, unit in parts
        )
        found[str(row.index)] = f"design {row.index}: {', '.join(shown)}"
    return found


def _empty(study: Exploration) -> Figure:
    """That there is nothing to draw."""
    made = panels.page(f"{study.spec.name}: no kept designs", 0.2)
    words = f"nothing to draw: none of {amount(study.designs, 'design', spec=',')} satisfies {study.problem.asked}"
    panels.message(made.add_subplot(), words, 9)
    return made


def _label(study: Exploration, i: int) -> str:
    requirement = study.problem.objectives[i]
    return f"{requirement.name.replace('_', ' ')}{'' if requirement.unit == '1' else f' [{requirement.unit}]'}"


def _scatter(axes: Axes, study: Exploration, figures: Any, grey: Any, places: tuple[int, int]) -> None:
    """One objective over another; of a single one its values in their order."""
    x, y = places
    single = x == y
    across = np.arange(1, len(figures) + 1) if single else figures[:, x]
    style.curves(axes, "rank" if single else _label(study, x), _label(study, y))
    axes.xaxis.label.set_fontsize(8)
    axes.yaxis.label.set_fontsize(8)
    axes.tick_params(labelsize=7)
    if not single:
        axes.plot(grey[:, x], grey[:, y], ".", color=_GREY, markersize=2, gid="feasible", rasterized=True)
    for row, place, figure in zip(study.found.rows, across, figures, strict=True):
        gid = f"row-{row.index}-{x}-{y}"
        axes.plot([place], [figure[y]], "o", color=style.BLUE, markersize=4, gid=gid)
        if row.index == study.knee:
            axes.plot([place], [figure[y]], "o", **_RING, gid="knee")


def _marks(study: Exploration) -> list[Line2D]:
    """A mark of each kind with its words."""
    from matplotlib.lines import Line2D

    of_all: Any = {"linestyle": "none"}
    kept = "kept: one design per box of the front"
    found = [
        Line2D([], [], marker=".", color=_GREY, markersize=5, label="satisfies everything", **of_all),
        Line2D([], [], marker="o", color=style.BLUE, markersize=4, label=kept, **of_all),
    ]
    if study.knee is not None:
        found.append(Line2D([], [], marker="o", **_RING, label=f"knee, design {study.knee}", **of_all))
    return found


def _parallel(axes: Axes, study: Exploration, figures: Any) -> None:
    """A line a design across variables and objectives; of an objective better is up, colours are of the first one."""
    from matplotlib.colors import LinearSegmentedColormap

    heads, columns, ranges, signs = _axes_of(study, figures)
    shades = LinearSegmentedColormap.from_list("front", [_HIGH, _LOW])
    rows = study.found.rows[:_MOST_LINES]
    for place, row in enumerate(rows):
        heights = [_height(c[place], r, s) for c, r, s in zip(columns, ranges, signs, strict=True)]
        share = place / max(1, len(rows) - 1)
        look: Any = {"color": shades(share)}
        if row.index == study.knee:
            look = {"color": style.RED, "linewidth": 2.0, "zorder": 3}
        axes.plot(range(len(heights)), heights, gid=f"row-{row.index}-line", **look)
        if len(rows) <= _NAMED:
            where: Any = {"textcoords": "offset points", "va": "center", "fontsize": 7, "gid": f"row-{row.index}-name"}
            axes.annotate(str(row.index), (len(heights) - 1, heights[-1]), (5, 0), color=look["color"], **where)
    for i, ((low, high), sign) in enumerate(zip(ranges, signs, strict=True)):
        axes.plot([i, i], [0.0, 1.0], color=style.GREY, linewidth=0.8, zorder=0)
        ends = (low, high) if sign > 0.0 else (high, low)
        for value, at, align in ((ends[0], -0.04, "top"), (ends[1], 1.04, "bottom")):
            axes.text(i, at, style.number(value, 4), ha="center", va=align, fontsize=7)
    axes.set_xticks(range(len(heads)), heads, fontsize=7)
    axes.tick_params(axis="x", pad=14, length=0)
    axes.set(ylim=(-0.12, 1.14), yticks=[])
    numbers = ", with their numbers" if len(rows) <= _NAMED else ""
    more = "variables as searched, objectives (better is up); dark: best in the first objective"
    axes.set_title(f"kept designs{numbers}: {more}", fontsize=8)
    for spine in axes.spines.values():
        spine.set_visible(False)


def _axes_of(
    study: Exploration, figures: Any
) -> tuple[list[str], list[list[float]], list[tuple[float, float]], list[float]]:
    """Headings, values of the kept designs, ends and the way up of each axis; variables of words are left out."""
    heads, columns, ranges, signs = [], [], [], []
    units = study.problem.base.units
    for i, variable in enumerate(study.problem.variables):
        values = [row.variables[i][1] for row in study.found.rows]
        if all(isinstance(value, (int, float)) for value in values):
            unit = units.get(variable.path, "1")
            heads.append(_folded(variable.path.replace(".", " "), unit))
            columns.append([float(value) for value in values])
            ranges.append(_searched(variable, columns[-1]))
            signs.append(1.0)
    for i, requirement in enumerate(study.problem.objectives):
        heads.append(_folded(requirement.name, requirement.unit))
        columns.append(figures[:, i].tolist())
        ranges.append((min(columns[-1]), max(columns[-1])))
        signs.append(-requirement.sign)
    return heads, columns, ranges, signs


def _searched(variable: Variable, kept: list[float]) -> tuple[float, float]:
    """Ends of a variable's range, which show whether kept designs stand at one; of a multiple of another that of the
    kept ones."""
    if variable.times:
        return min(kept), max(kept)
    given = [float(value) for value in variable.values] or [variable.low, variable.high]
    return min(given), max(given)


def _folded(name: str, unit: str) -> str:
    return name.replace("_", "\n").replace(" ", "\n") + ("" if unit == "1" else f"\n[{unit}]")


def _height(value: float, ends: tuple[float, float], sign: float) -> float:
    low, high = ends
    share = (value - low) / (high - low) if high > low else 0.5
    return share if sign > 0.0 else 1.0 - share
