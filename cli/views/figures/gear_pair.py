"""The figure of a gear pair: both gears, the mesh zone, values and the drawing's table, contour, values on the path."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from functools import partial
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.gears import (
    COLORS,
    Mesh,
    contact_path,
    contour_plot,
    gear_text,
    gear_zone,
    headed,
    mesh_zone,
    path_plot,
    ruled,
    value_rows,
    values,
    whole_gears,
    zone_frame,
    zone_legend,
    zone_size,
)
from gearlink.cli.views.scenes.gears import rack_body, rack_scene
from gearlink.cli.views.scenes.scene import Body, Scene, placed
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.parts.gears.rack import RackMesh


Panel = Callable[["Axes"], None]
Rows = tuple[list[str], list[list[str]]]

_ROW = 0.0125
"""Share of a page's height that a row of a table takes."""
_REMARK = 60
"""Letters of a remark in a row of the values, which has the width of its table to itself."""
_LONG = 6.0
"""Tip radii of the gear that a rack is drawn long."""
_RATED = ("contact_stress", "safety_pitting", "root_stress", "safety_bending")


def draw(command: str, design: GearPairDesign) -> Figure:
    """The figure of `gear` or `analyze` on a gear pair."""
    title = f"{design.spec.name}: {command}"
    if design.rack is not None:
        rack = design.rack
        teeth = [gear_text(rack.pair.teeth[0]), "rack"]
        head = ["", "", "unit", "gear 1", "rack"]
        drawing = head, _drawing(design)[1]
        rows = value_rows(teeth, [f"{rack.pair.module:g}"] * 2, [rack.quantity]) + _rating(design)
        drawings = (partial(rack_and_gear, design=design), partial(rack_zone, rack=rack))
        return _sheet(title, drawings, (head, rows), drawing, [partial(path_plot, data=design.data)])
    mesh, data = Mesh(design.gear_pair), design.data
    plots = [partial(contour_plot, contour=design.contour), partial(path_plot, data=data)]
    head, rows = values([mesh])
    drawings = (partial(whole_gears, mesh=mesh), partial(mesh_zone, mesh=mesh))
    return _sheet(title, drawings, (head, rows + _rating(design)), _drawing(design), plots)


def _sheet(
    title: str, drawings: tuple[Panel, Panel], shown: Rows, drawing: Rows, plots: Sequence[Callable[[Axes, Axes], None]]
) -> Figure:
    """The mesh, both tables side by side, then the plots and their keys; a lone plot takes the width."""
    most = max(len(shown[1]), len(drawing[1]))
    lines = _ROW * (most + 3)
    shares = [0.28, lines, 0.3, 0.06]
    figure = panels.page(title, 0.1 + sum(shares), large=False)
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
        [item, symbol, unit.replace("um", "µm"), gear_text(one, unit), gear_text(other, unit)]
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


def rack_and_gear(axes: Axes, design: GearPairDesign) -> None:
    """Gear and rack to scale, and the distance of the axis from the datum line."""
    rack = design.rack
    assert rack is not None, "chosen by the figure"
    style.drawing(axes)
    panels.heading(axes, f"Gear 1, z = {rack.pair.teeth[0]}; rack, z = {design.rack_teeth}")
    radius, drawn = rack.pair.tip_radius[0], design.rack_teeth
    if drawn * rack.pitch_on_line > _LONG * radius:  # the gear would be a dot beside it
        drawn -= 2 * math.ceil(0.5 * (drawn - _LONG * radius / rack.pitch_on_line))
    scene = rack_scene(rack, design.rack_teeth, design.rack_back, np.zeros(1), drawn)
    scene_axes.draw(axes, scene)
    if drawn < design.rack_teeth:
        _break_lines(axes, scene, f"{drawn} of {design.rack_teeth} teeth shown")
    drop, distance = -1.12 * radius, rack.center_distance
    ends = complex(0.0, drop), complex(distance, drop)
    style.dimension(axes, *ends, f"a = {distance:.6g} mm", shift=(-26, -4), from_points=(0j, complex(distance)))
    axes.margins(0.08)
    axes.autoscale_view()


def _break_lines(axes: Axes, scene: Scene, words: str) -> None:
    """A zigzag at either end of a rack that goes on, and how much of it is shown."""
    body = next(part for part in scene.parts if isinstance(part, Body) and part.name.startswith("rack"))
    points = placed(body, 0)
    left, right = float(points.real.min()), float(points.real.max())
    wide = right - left
    for end in (float(points.imag.min()), float(points.imag.max())):
        x = left + wide * np.array([-0.4, 0.35, 0.45, 0.55, 0.65, 1.4])
        y = end + wide * np.array([0.0, 0.0, 0.3, -0.3, 0.0, 0.0])
        axes.plot(x, y, color=style.BLACK, linewidth=0.9, zorder=6, gid="break")
    axes.annotate(
        words, (right + 0.4 * wide, float(points.imag.max())), (4, -10), textcoords="offset points", fontsize=7
    )


def rack_zone(axes: Axes, rack: RackMesh) -> None:
    """The teeth in mesh, with line of action, path of contact, contact points, circles and lines."""
    geometry = RackGeometry(rack)
    pitch, (wide, high) = geometry.pitch_point, zone_size(geometry, rack.pair.module)
    style.drawing(axes)
    panels.heading(axes, "Mesh zone, gear 1 driving")
    gear_zone(axes, Mesh(rack.pair), 0, wide, high)
    _rack_teeth(axes, rack, geometry, high)
    for name, x, dashes, color in (
        ("datum line", rack.center_distance, style.LONG, style.GREY),
        ("tip line", rack.center_distance - rack.path.height * rack.pair.module, style.DASHED, COLORS[1]),
    ):
        axes.axvline(x, color=color, linewidth=0.9, linestyle=dashes, label=name, zorder=2)
    contact_path(axes, geometry, 3.0 * (high + wide))
    zone_frame(axes, pitch, wide, high, ("gear 1", "rack"))


def _rack_teeth(axes: Axes, rack: RackMesh, geometry: RackGeometry, high: float) -> None:
    count = 2 * math.ceil(1.3 * high / rack.pitch_on_line) + 3
    place = np.array([rack.center_distance + 1j * geometry.first_space[1]])
    body = rack_body(rack, count, 9.0 * high, place)
    outline = place + 1j * body.outline
    style.area(axes, outline, facecolor=COLORS[1], alpha=0.16, linewidth=0)
    axes.plot(outline.real, outline.imag, color=COLORS[1], linewidth=1.5, zorder=3, gid="zone-2")
