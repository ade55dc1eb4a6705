"""Gears in mesh: both gears to scale with their true teeth, the mesh zone magnified, and a table of values."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from gearlink.cli.figures import panels, scene_axes, style
from gearlink.cli.scenes.gear_pair import pair_scene
from gearlink.cli.scenes.scene import Body, Points, Scene
from gearlink.core.errors import NoSolution
from gearlink.core.gears.checks import gear_quantity
from gearlink.core.gears.mesh_geometry import MeshGeometry
from gearlink.core.gears.pair import GearPair
from gearlink.core.nomenclature import term

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

COLORS = (style.BLUE, style.ORANGE)

_OF_MESH = (
    "center_distance",
    "working_pressure_angle",
    "contact_ratio",
    "shift_sum",
    "tip_shortening",
)
_OF_GEAR = (
    "profile_shift",
    "reference_radius",
    "base_radius",
    "working_radius",
    "tip_radius",
    "root_radius",
    "tooth_thickness",
    "tip_thickness",
    "specific_sliding",
)
_WORDS = {
    "reference_radius": "reference radius",
    "tooth_thickness": "tooth thickness on the reference circle",
    "working_radius": "working pitch radius",
    "specific_sliding": "specific sliding at the foot of the flank",
    "tip_shortening": "tip shortening coefficient",
}
_PLAIN = {
    "alpha_wt": r"$\alpha_w$",
    "a_w": "$a_w$",
    "eps_alpha": r"$\varepsilon_\alpha$",
    "r_b": "$r_b$",
    "r_w": "$r_w$",
    "r_a": "$r_a$",
    "r_f": "$r_f$",
    "s_a": "$s_a$",
    "x1+x2": "$x_1+x_2$",
    "zeta": r"$\zeta$",
}


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


def mesh_figure(title: str, meshes: Sequence[Mesh], beside: Sequence[Callable[[Axes, Axes], None]] = ()) -> Figure:
    """One row per mesh, whole gears and mesh zone, over a table of their values, then two plots and their keys."""
    rows = len(meshes)
    figure = panels.page(title, 0.27 + 0.28 * rows + (0.38 if beside else 0.0))
    heights = [*[1.0] * rows, 0.78, *([1.0, 0.2] if beside else [])]
    grid = figure.add_gridspec(len(heights), 2, height_ratios=heights, width_ratios=(1.3, 1.0))
    for row, mesh in enumerate(meshes):
        whole_gears(figure.add_subplot(grid[row, 0]), mesh)
        zone = figure.add_subplot(grid[row, 1])
        mesh_zone(zone, mesh)
        if row == rows - 1:
            _legend(zone)
    values(figure.add_subplot(grid[rows, :]), meshes)
    for column, draw in enumerate(beside):
        draw(figure.add_subplot(grid[rows + 1, column]), figure.add_subplot(grid[rows + 2, column]))
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
    words = f"$a_w$ = {abs(pair.center_distance):.6g} mm"
    style.dimension(
        axes,
        complex(0.0, drop),
        complex(pair.center_distance, drop),
        words,
        shift=(0, -4),
        from_points=(0j, complex(pair.center_distance)),
    )


def _teeth(mesh: Mesh, gear: int, chord: float, count: int, first: float) -> Points | None:
    from gearlink.core.gears.tooth_profile import ToothProfile, outline

    try:
        profile = ToothProfile.of(mesh.pair, gear)
    except NoSolution:
        return None
    return outline(profile, chord, count, first) + mesh.geometry.axes[gear]


def mesh_zone(axes: Axes, mesh: Mesh) -> None:
    """The teeth in mesh, with line of action, path of contact, contact points and circles."""
    pair, geometry = mesh.pair, mesh.geometry
    pitch, m = geometry.pitch_point, pair.module
    ends = (geometry.contact_start, geometry.contact_end)
    high = max(2.6 * m, *(1.3 * abs((end - pitch).imag) for end in ends))
    wide = max(2.7 * m, *(1.3 * abs((end - pitch).real) for end in ends), 0.95 * high)
    style.drawing(axes)
    panels.heading(axes, f"Mesh zone, gear {mesh.gears[0]} driving")
    for gear in (0, 1):
        _zone_teeth(axes, mesh, gear, high)
        _zone_circles(axes, mesh, gear, high, wide)
    _contact(axes, geometry, 3.0 * (high + wide))
    axes.set_xlim(pitch.real - wide, pitch.real + wide)
    axes.set_ylim(-high, high)
    axes.set_aspect("equal", adjustable="box")
    for gear, side in ((0, -0.94), (1, 0.94)):
        place = (pitch.real + side * wide, -0.93 * high)
        axes.text(*place, f"gear {mesh.gears[gear]}", color=style.BLACK, fontsize=8, ha="right" if gear else "left")


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
    axes.fill([p.real for p in body], [p.imag for p in body], facecolor=color, alpha=0.16, linewidth=0)
    axes.plot(teeth.real, teeth.imag, color=color, linewidth=1.5, zorder=3, gid=f"zone-{gear + 1}")


def _zone_ring(axes: Axes, mesh: Mesh) -> None:
    """The teeth of a ring, and its body out to the rim."""
    from gearlink.core.gears.mesh_phase import ring_of

    pair, geometry = mesh.pair, mesh.geometry
    center = geometry.axes[1]
    teeth = ring_of(pair, 48) * np.exp(1j * geometry.first_space[1]) + center
    rim = center - 2.0 * pair.root_radius[1] * np.exp(-2j * math.pi * np.linspace(0.0, 1.0, 181))
    body = np.concatenate([teeth, rim])
    axes.fill(body.real, body.imag, facecolor=COLORS[1], alpha=0.16, linewidth=0)
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


def _contact(axes: Axes, geometry: MeshGeometry, length: float) -> None:
    """Line of action, path of contact from A to E, and where flanks touch now."""
    pitch, way = geometry.pitch_point, geometry.direction
    line = [pitch - length * way, pitch + length * way]
    axes.plot([p.real for p in line], [p.imag for p in line], color=style.BLACK, linewidth=0.8, label="line of action")
    ends = [geometry.contact_start, geometry.contact_end]
    axes.plot(
        [p.real for p in ends],
        [p.imag for p in ends],
        color=style.RED,
        linewidth=2.4,
        marker="|",
        markersize=11,
        label="path of contact A–E",
        zorder=5,
    )
    touching = geometry.contacts
    axes.plot(
        [p.real for p in touching],
        [p.imag for p in touching],
        "o",
        color="white",
        markeredgecolor=style.RED,
        markersize=5.5,
        label="contact points",
        zorder=6,
    )
    for name, point, shift in (("A", ends[0], (8, -4)), ("C", pitch, (8, -4)), ("E", ends[1], (8, -2))):
        _boxed(axes, name, point, shift)


def _boxed(axes: Axes, name: str, point: complex, shift: tuple[float, float]) -> None:
    box = {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none", "alpha": 0.8}
    place = (point.real, point.imag)
    axes.annotate(name, place, shift, textcoords="offset points", fontsize=9, bbox=box, zorder=7)


def _legend(axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    axes.legend(
        unique.values(),
        unique.keys(),
        loc="upper center",
        bbox_to_anchor=(0.5, -0.11),
        ncols=3,
        frameon=False,
        fontsize=7.5,
        handlelength=2.4,
        columnspacing=1.2,
    )


def values(axes: Axes, meshes: Sequence[Mesh]) -> None:
    """Table of the values of every gear, and of every mesh in the column of its first gear."""
    axes.set_axis_off()
    columns = [f"gear {gear}\n{mesh.name}".strip() for mesh in meshes for gear in mesh.gears]
    rows = [
        ["teeth", "$z$", "", *_each(meshes, lambda pair, i: f"{pair.teeth[i]}")],
        ["module", "$m$", "mm", *_each(meshes, lambda pair, _: f"{pair.module:g}")],
    ]
    for name in _OF_GEAR:
        rows.append([*_headed(name), *_each(meshes, lambda pair, i, name=name: _text(pair, name, i))])  # type: ignore[misc]
    for name in _OF_MESH:
        rows.append([*_headed(name), *_each(meshes, lambda pair, i, name=name: "" if i else _text(pair, name))])  # type: ignore[misc]
    _ruled(axes, ["", "", "unit", *columns], rows)


def _ruled(axes: Axes, head: Sequence[str], rows: Sequence[Sequence[str]]) -> None:
    """Rows of text with light rules: words, symbol and unit on the left, numbers on the right."""
    extra = 1.0 if "\n" in head[-1] else 0.0  # a head of two lines
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim(len(rows) + 1.0 + extra, 0.0)
    numbers = len(head) - 3
    edges = [0.52 + 0.48 * (i + 1) / numbers - 0.01 for i in range(numbers)]
    places = [(0.0, "left"), (0.38, "left"), (0.46, "left"), *((edge, "right") for edge in edges)]
    for row, line in enumerate([head, *rows]):
        middle = row + 0.5 + (extra if row else 0.5 * extra)
        for (x, side), text in zip(places, line, strict=True):
            weight = "normal" if row else "bold"
            axes.text(x, middle, text, fontsize=7.5, ha=side, va="center", fontweight=weight)
        axes.axhline(row + 1.0 + extra, color=style.LIGHT if row else style.GREY, linewidth=0.6)


def _each(meshes: Sequence[Mesh], text: Callable[[GearPair, int], str]) -> list[str]:
    return [text(mesh.pair, gear) for mesh in meshes for gear in (0, 1)]


def _headed(name: str) -> tuple[str, str, str]:
    """Words, symbol and unit of a quantity."""
    entry = term(name)
    words = _WORDS.get(name, entry.words)
    symbol = _PLAIN.get(entry.symbol, f"${entry.symbol}$")
    return words, symbol, "" if entry.unit == "1" else entry.unit


def _text(pair: GearPair, name: str, gear: int | None = None) -> str:
    """A value to six digits; what the pair does not have is a dash."""
    try:
        found = gear_quantity(pair, name)
    except NoSolution:
        found = None
    if found is None:
        return "–"
    value = found[gear or 0] if isinstance(found, tuple) else found
    return style.number(math.degrees(value) if term(name).unit == "deg" else value)
