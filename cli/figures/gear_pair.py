"""The figure of a gear pair: both gears, the mesh zone, a table, the blocking contour, values along the path."""

from __future__ import annotations

from functools import partial
from typing import TYPE_CHECKING

from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.gears.design import GearPairDesign


def draw(command: str, design: GearPairDesign) -> Figure:
    """The figure of `gear` or `analyze` on a gear pair."""
    design.require_two_gears("the picture")
    from gearlink.cli.figures.gear_contour import contour_plot, path_plot

    plots = (partial(contour_plot, data=design.data), partial(path_plot, data=design.data))
    return mesh_figure(f"{design.spec.name}: {command}", [Mesh(design.gear_pair)], plots)
