"""Gears in mesh: both gears to scale with their true teeth, the mesh zone magnified, and a table of values."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.figures.gears.path_of_contact import contact_path, zone_frame, zone_legend, zone_size
from gearlink.cli.views.figures.gears.values import gear_text, ruled, value_rows
from gearlink.cli.views.scenes.gear_pair import pair_scene
from gearlink.cli.views.scenes.scene import Body, Points, Scene
from gearlink.core.base.errors import NoSolution
from gearlink.core.parts.gears.checks import gear_quantity
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = (style.BLUE, style.ORANGE)


@dataclass(frozen=True)
class Mesh:
    """A gear pair as it is drawn: its name, the numbers of its two gears, and a scene where they are no whole gears."""

    pair: GearPair
    name: str = ""
    gears: tuple[str, str] = ("1", "2")
    scene: Scene | None = None

    @property
    def geometry(self) -> MeshGeometry:
        """Line of action and places of the teeth."""
        return MeshGeometry(self.pair)


def mesh_figure(title: str, meshes: Sequence[Mesh]) -> Figure:
    """One row per mesh, whole gears and mesh zone, over a table of their values."""
    rows = len(meshes)
    figure = panels.page(title, 0.33 + 0.28 * rows)
    grid = figure.add_gridspec(rows + 1, 2, height_ratios=[*[1.0] * rows, 1.0], width_ratios=(1.3, 1.0))
    for row, mesh in enumerate(meshes):
        whole_gears(figure.add_subplot(grid[row, 0]), mesh)
        zone = figure.add_subplot(grid[row, 1])
        mesh_zone(zone, mesh)
        if row == rows - 1:
            zone_legend(zone)
    # The names of meshes need their room in the head where there are several.
    ruled(figure.add_subplot(grid[rows, :]), *values(meshes), size=7.0, at=(0.38, 0.46) if rows == 1 else (0.33, 0.39))
    return figure


def whole_gears(axes: Axes, mesh: Mesh) -> None:
    """Both gears to scale, in the place that the mesh zone shows."""
    pair = mesh.pair
    style.drawing(axes)
    scene = mesh.scene or pair_scene(pair, mesh.gears, np.zeros(1))
    names = "; ".join(part.name for part in scene.parts if isinstance(part, Body) and part.name)
    panels.heading(axes, f"{mesh.name} mesh: {names}" if mesh.name else names.capitalize())
    scene_axes.draw(axes, scene)
    _axis_distance(axes, pair)
    axes.margins(0.08)
    axes.autoscale_view()


def _axis_distance(axes: Axes, pair: GearPair) -> None:
    """The centre distance, below the gears."""
    drop = -1.12 * max(abs(radius) for radius in (*pair.tip_radius, pair.root_radius[1]))
    words = f"centre distance {abs(pair.center_distance):.6g} mm"
    style.dimension(
        axes,
        complex(0.0, drop),
        complex(pair.center_distance, drop),
        words,
        shift=(0, -4),
        from_points=(0j, complex(pair.center_distance)),
    )
    axes.update_datalim([(0.0, 1.18 * drop)])  # room for the words


def _teeth(mesh: Mesh, gear: int, chord: float, count: int, first: float) -> Points | None:
    from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

    try:
        profile = ToothProfile.of(mesh.pair, gear)
    except NoSolution:
        return None
    return outline(profile, chord, count, first) + mesh.geometry.axes[gear]


def mesh_zone(axes: Axes, mesh: Mesh) -> None:
    """The teeth in mesh, with line of action, path of contact, contact points and circles."""
    geometry = mesh.geometry
    pitch, (wide, high) = geometry.pitch_point, zone_size(geometry, mesh.pair.module)
    style.drawing(axes)
    panels.heading(axes, f"Mesh zone, gear {mesh.gears[0]} driving")
    for gear in (0, 1):
        gear_zone(axes, mesh, gear, wide, high)
    contact_path(axes, geometry, 3.0 * (high + wide))
    zone_frame(axes, pitch, wide, high, (f"gear {mesh.gears[0]}", f"gear {mesh.gears[1]}"))


def gear_zone(axes: Axes, mesh: Mesh, gear: int, wide: float, high: float) -> None:
    """The teeth of one gear and its circles in a mesh zone of that half width and height [mm]."""
    _zone_teeth(axes, mesh, gear, high)
    _zone_circles(axes, mesh, gear, high, wide)


def _zone_teeth(axes: Axes, mesh: Mesh, gear: int, high: float) -> None:
    pair, geometry = mesh.pair, mesh.geometry
    if pair.teeth[gear] < 0:
        _zone_ring(axes, mesh)
        return
    pitch_angle = 2.0 * math.pi / pair.teeth[gear]
    beside = math.ceil(1.3 * high / (pair.root_radius[gear] * pitch_angle)) + 1 if pair.root_radius[gear] > 0 else 99
    count = min(pair.teeth[gear], 2 * beside + 1)
    first = geometry.first_space[gear] - pitch_angle * (count // 2)
    teeth = _teeth(mesh, gear, 1e-3 * pair.module, count, first)
    if teeth is None:
        words = f"gear {mesh.gears[gear]}: its tool leaves no such teeth"
        place, box = (0.5, 0.93 - 0.08 * gear), {"facecolor": "white", "edgecolor": style.RED, "linewidth": 0.6}
        axes.text(*place, words, transform=axes.transAxes, ha="center", color=style.RED, fontsize=8, bbox=box, zorder=8)
        return
    center, color = geometry.axes[gear], COLORS[gear]
    body = [*teeth, center]
    style.area(axes, body, facecolor=color, alpha=0.16, linewidth=0)
    axes.plot(teeth.real, teeth.imag, color=color, linewidth=1.5, zorder=3, gid=f"zone-{gear + 1}")


def _zone_ring(axes: Axes, mesh: Mesh) -> None:
    """The teeth of a ring, and its body out to the rim."""
    from gearlink.core.parts.gears.outline.ring_profile import RingProfile

    pair, geometry = mesh.pair, mesh.geometry
    center = geometry.axes[1]
    teeth = RingProfile.of(pair).outline(48) * np.exp(1j * geometry.first_space[1]) + center
    rim = center - 2.0 * pair.root_radius[1] * np.exp(-2j * math.pi * np.linspace(0.0, 1.0, 181))
    body = np.concatenate([teeth, rim])
    style.area(axes, body, facecolor=COLORS[1], alpha=0.16, linewidth=0)
    axes.plot(teeth.real, teeth.imag, color=COLORS[1], linewidth=1.5, zorder=3, gid="zone-2")


def _zone_circles(axes: Axes, mesh: Mesh, gear: int, high: float, wide: float) -> None:
    """Base, working and tip circle as arcs, those that pass the zone."""
    pair, center = mesh.pair, mesh.geometry.axes[gear]
    kinds = (
        ("tip circle", pair.tip_radius, style.DASHED, COLORS[gear]),
        ("working pitch circle", pair.working_radius, style.CHAIN, style.GREY),
        ("base circle", pair.base_radius, style.DOTTED, style.BLACK),
    )
    inward = 1.0 if gear else -1.0
    for name, radius, dashes, color in kinds:
        if abs(abs(mesh.geometry.pitch_point - center) - abs(radius[gear])) > wide:
            continue
        reach = min(math.pi, 2.0 * high / abs(radius[gear]))
        arc = center + inward * -1.0 * radius[gear] * np.exp(1j * np.linspace(-reach, reach, 181))
        axes.plot(arc.real, arc.imag, color=color, linewidth=0.9, linestyle=dashes, label=name, zorder=2)


def values(meshes: Sequence[Mesh]) -> tuple[list[str], list[list[str]]]:
    """Head and rows of the table: the values of every gear, and of every mesh in the column of its first gear."""
    columns = [f"gear {gear}\n{mesh.name}".strip() for mesh in meshes for gear in mesh.gears]
    pairs = [mesh.pair for mesh in meshes]
    teeth = [gear_text(z) for pair in pairs for z in pair.teeth]
    modules = [f"{pair.module:g}" for pair in pairs for _ in pair.teeth]
    quantities = [partial(gear_quantity, pair) for pair in pairs]
    return ["", "", "unit", *columns], value_rows(teeth, modules, quantities)
