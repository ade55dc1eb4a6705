"""The figure of a gear pair: both gears, the mesh zone, values and the drawing's table, contour, values on the path."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from functools import partial
from textwrap import wrap
from typing import TYPE_CHECKING, Any

from gearlink.cli.views.figures.drawing import panels
from gearlink.cli.views.figures.gears.mesh import Mesh, mesh_zone, values, whole_gears
from gearlink.cli.views.figures.gears.path_of_contact import zone_legend
from gearlink.cli.views.figures.gears.values import gear_text, headed, ruled, value_rows
from gearlink.core.base.errors import NoSolution

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.gear_pair.design import GearPairDesign

Panel = Callable[["Axes"], None]
Rows = tuple[list[str], list[list[str]]]

_ROW = 0.0115
"""Share of a page's height that a row of a table takes."""
_REMARK = 60
"""Letters of a remark in a row of the values, which has the width of its table to itself."""
_RATED = ("contact_stress", "safety_pitting", "root_stress", "safety_bending")


def draw(command: str, design: GearPairDesign) -> Figure:
    """The figure of `gear` or `analyze` on a gear pair."""
    title = f"{design.spec.name}: {command}"
    if design.rack is not None:
        from gearlink.cli.views.figures.gears.contour import path_plot
        from gearlink.cli.views.figures.gears.rack import rack_and_gear, rack_zone

        rack = design.rack
        teeth = [gear_text(rack.pair.teeth[0]), "rack"]
        head = ["", "", "unit", "gear 1", "rack"]
        drawing = head, _drawing(design)[1]
        rows = value_rows(teeth, [f"{rack.pair.module:g}"] * 2, [rack.quantity]) + _rating(design)
        drawings = (partial(rack_and_gear, design=design), partial(rack_zone, rack=rack))
        return _sheet(title, drawings, (head, rows), drawing, [partial(path_plot, data=design.data)])
    from gearlink.cli.views.figures.gears.contour import contour_plot, path_plot

    mesh, data = Mesh(design.gear_pair), design.data
    plots = [partial(contour_plot, contour=design.contour), partial(path_plot, data=data)]
    head, rows = values([mesh])
    drawings = (partial(whole_gears, mesh=mesh), partial(mesh_zone, mesh=mesh))
    return _sheet(title, drawings, (head, rows + _rating(design)), _drawing(design), plots)


def _sheet(
    title: str,
    drawings: tuple[Panel, Panel],
    shown: Rows,
    drawing: Rows,
    plots: Sequence[Callable[[Axes, Axes], None]],
) -> Figure:
    """The mesh, both tables side by side, then the plots and their keys; a lone plot takes the width."""
    most = max(len(shown[1]), len(drawing[1]))
    lines = _ROW * (most + 3)
    shares = [0.28, lines, 0.3, 0.06]
    figure = panels.page(title, 0.1 + sum(shares))
    grid = figure.add_gridspec(4, 2, height_ratios=shares, width_ratios=(1.3, 1.0))
    first, zone = figure.add_subplot(grid[0, 0]), figure.add_subplot(grid[0, 1])
    drawings[0](first)
    drawings[1](zone)
    zone_legend(zone)
    tables = grid[1, :].subgridspec(1, 2, wspace=0.06)
    for column, (words, (head, rows)) in enumerate((("Values", shown), ("Gear table of the drawing", drawing))):
        axes = figure.add_subplot(tables[0, column])
        panels.heading(axes, words)
        ruled(axes, head, rows, size=6.2, rows_of=most, at=(0.48, 0.56))
    for column, plot in enumerate(plots):
        across = column if len(plots) > 1 else slice(None)
        plot(figure.add_subplot(grid[2, across]), figure.add_subplot(grid[3, across]))
    return figure


def _drawing(design: GearPairDesign) -> Rows:
    """The lines of the table `drawing`; none where the teeth have no such table."""
    try:
        table = design.table("drawing")
    except NoSolution:
        return ["", "", "unit", "", ""], []
    columns: Any = table.data
    rows = [
        [item, symbol, unit, gear_text(one), gear_text(other)]
        for item, symbol, one, other, unit in zip(*columns, strict=True)
    ]
    return ["", "", "unit", "gear 1", "gear 2"], rows


def _rating(design: GearPairDesign) -> list[list[str]]:
    """Stresses and safeties where the file has a load, and what they rest on."""
    rows = []
    for name in _RATED:
        found: Any = design.quantity(name)
        if found is not None:
            rows.append([*headed(name), *(gear_text(value) or "–" for value in found.value)])
    if rows:
        remarks = (wrap(design.rests_on(name), _REMARK) for name in ("contact_stress", "root_stress"))
        rows += [[line, "", "", "", ""] for lines in remarks for line in lines]
    return rows
