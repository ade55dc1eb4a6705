"""A gear on a rack: both to scale, and the mesh zone with true teeth and the path of contact."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.gears.mesh import COLORS, Mesh, gear_zone
from gearlink.cli.views.figures.gears.path_of_contact import contact_path, zone_frame, zone_size
from gearlink.cli.views.scenes.rack import rack_body, rack_scene
from gearlink.core.parts.gears.rack.geometry import RackGeometry

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.parts.gears.rack.mesh import RackMesh


def rack_and_gear(axes: Axes, design: GearPairDesign) -> None:
    """Gear and rack to scale, and the distance of the axis from the datum line."""
    rack = design.rack
    assert rack is not None, "chosen by the figure"
    style.drawing(axes)
    panels.heading(axes, f"Gear 1, z = {rack.pair.teeth[0]}; rack, z = {design.rack_teeth}")
    scene_axes.draw(axes, rack_scene(rack, design.rack_teeth, design.rack_back, np.zeros(1)))
    drop, distance = -1.12 * rack.pair.tip_radius[0], rack.center_distance
    ends = complex(0.0, drop), complex(distance, drop)
    style.dimension(axes, *ends, f"a = {distance:.6g} mm", shift=(-26, -4), from_points=(0j, complex(distance)))
    axes.margins(0.08)
    axes.autoscale_view()


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
