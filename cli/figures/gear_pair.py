"""The figure of a gear pair: both gears, the mesh zone and a table."""

from __future__ import annotations

from typing import TYPE_CHECKING

from gearlink.cli.figures.gear_mesh import Mesh, mesh_figure

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from gearlink.core.gears.design import GearPairDesign


def draw(command: str, design: GearPairDesign) -> Figure:
    """The figure of `gear` or `analyze` on a gear pair."""
    return mesh_figure(f"{design.spec.name}: {command}", [Mesh(design.gear_pair)])
