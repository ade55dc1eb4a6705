"""Gears in mesh: scene, both gears to scale, the mesh zone magnified, a table of values; the blocking contour.

The mesh zone has the line of action with A, C and E, contact points, and the frame about them; the table has words,
symbols, units and values of both gears. The scene of a pair turns by so many pitches that the teeth, and where it goes
the holes, come to meet themselves. The contour comes with sliding, pressure and root stress along the path of contact.

The sheet of a pair has these, the rating and the drawing's table; a rack stands in place of gear 2.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from functools import partial
from io import BytesIO
from textwrap import wrap
from typing import TYPE_CHECKING, Any, TypeAlias

import numpy as np

from gearlink.cli.views.figures.drawing import panels, scene_axes, style
from gearlink.cli.views.scenes.gears import gear as gear_body
from gearlink.cli.views.scenes.gears import holes_for, rack_body, rack_scene
from gearlink.cli.views.scenes.of_motion import Frame
from gearlink.cli.views.scenes.scene import TURN, Body, Mark, Readout, Reals, Scene, placed, track
from gearlink.core.base.errors import NoSolution
from gearlink.core.base.nomenclature import term
from gearlink.core.parts.gears.checks import gear_quantity
from gearlink.core.parts.gears.mesh.pair import GearPair
from gearlink.core.parts.gears.outline.mesh_geometry import MeshGeometry, driven_turn
from gearlink.core.parts.gears.outline.rack_profile import RackGeometry
from gearlink.core.parts.gears.outline.ring_profile import RingProfile

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.lines import Line2D

    from gearlink.core.machines.gear_pair.design import GearPairDesign
    from gearlink.core.parts.gears.along_path import AlongPath, Place
    from gearlink.core.parts.gears.data import GearData
    from gearlink.core.parts.gears.rack import RackMesh
    from gearlink.core.parts.gears.shifts.contour import BlockingContour


_MOST_PITCHES = 36


def build(design: GearPairDesign, fraction: Reals) -> Scene:
    """Positions over fractions of the loop; gear 1 drives counter-clockwise."""
    if design.rack is not None:
        return rack_scene(design.rack, design.rack_teeth, design.rack_back, fraction)
    return pair_scene(design.gear_pair, ("1", "2"), fraction)


def frame(design: GearPairDesign) -> Frame:
    """The scene stands where the motion does, and goes on as its first gear turns."""

    def inputs(fraction: Reals) -> Reals:
        turned = build(design, np.append(0.0, fraction)).readouts[0].values
        return np.asarray(np.radians(turned[1:] - turned[0]))

    return Frame(inputs, design.moving)


def pair_scene(pair: GearPair, labels: tuple[str, str], fraction: Reals) -> Scene:
    """Both gears over a loop of whole pitches; at its start two flanks touch at the pitch point."""
    pitches = loop_pitches(pair.teeth)
    turns = pitches / pair.teeth[0], -pitches / pair.teeth[1]
    start = MeshGeometry(pair).first_space
    first = TURN * turns[0] * fraction + start[0]
    if pair.internal:
        second = TURN * turns[1] * fraction + start[1]
    else:
        second = driven_turn(pair.teeth, np.zeros_like(fraction), first)
    one, two = track(0.0, fraction), track(pair.center_distance, fraction)
    bodies = (
        gear_body(pair, 0, one, first, turns[0], style.BLUE, labels[0], f"gear {labels[0]}"),
        gear_body(pair, 1, two, second, turns[1], style.ORANGE, labels[1], f"gear {labels[1]}"),
    )
    behind, before = bodies[::-1] if pair.internal else bodies
    readouts = tuple(
        Readout(f"gear {label}", "°", np.degrees(turn - turn.flat[0]))
        for label, turn in zip(labels, (first, second), strict=True)
    )
    return Scene(parts=(*behind, *before), marks=(Mark(one, pivot=True), Mark(two, pivot=True)), readouts=readouts)


def loop_pitches(teeth: tuple[int, int]) -> int:
    """Pitches that pass in the loop: a revolution of a small gear 1, else as many as let both gears keep their holes.

    Example
        >>> loop_pitches((20, 40)), loop_pitches((72, 72)), loop_pitches((101, 103))
        (20, 36, 36)
    """
    z1, z2 = teeth[0], abs(teeth[1])
    if z1 <= _MOST_PITCHES and holes_for(z1 / z2):
        return z1
    return max(range(1, _MOST_PITCHES + 1), key=lambda k: (bool(holes_for(k / z1)) + bool(holes_for(k / z2)), k))


Quantity = Callable[[str], Any]
"""A quantity of a mesh by name, of two gears a pair; None where it has none."""

_OF_MESH = ("center_distance", "working_pressure_angle", "contact_ratio", "shift_sum", "tip_shortening")
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
    "center_distance": "centre distance",
    "working_pressure_angle": "working pressure angle",
    "base_radius": "base radius",
    "tip_radius": "tip radius",
    "root_radius": "root radius",
    "reference_radius": "reference radius",
    "tooth_thickness": "thickness, reference circle",
    "working_radius": "working pitch radius",
    "specific_sliding": "specific sliding, foot of flank",
    "shift_sum": "shift sum without backlash",
    "tip_shortening": "tip shortening coefficient",
    "contact_stress": "contact stress",
    "safety_pitting": "safety against pitting",
    "root_stress": "root stress",
    "safety_bending": "safety against tooth breakage",
}
_SYMBOL = 1
"""The column of the symbols, as the nomenclature writes them."""
_SIGNS = {"alpha": "α", "beta": "β", "eps": "ε", "gamma": "γ", "rho": "ρ", "sigma": "σ", "zeta": "ζ", "Sigma": "Σ"}


def ruled(
    axes: Axes,
    head: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    size: float = 7.5,
    rows_of: int = 0,
    at: tuple[float, float] = (0.38, 0.46),
) -> None:
    """Rows of text with light rules: words, symbol and unit on the left, numbers on the right.

    Parameters
        at : (float, float) - places of symbol and unit in the width
        rows_of : int - so many rows fill the height; 0: those that there are
    """
    axes.set_axis_off()
    extra = 1.0 if "\n" in head[-1] else 0.0  # a head of two lines
    axes.set_xlim(0.0, 1.0)
    axes.set_ylim((rows_of or len(rows)) + 1.0 + extra, 0.0)
    numbers = len(head) - 3
    edges = [at[1] + 0.06 + (0.94 - at[1]) * (i + 1) / numbers - 0.01 for i in range(numbers)]
    places = [(0.0, "left"), *((place, "left") for place in at), *((edge, "right") for edge in edges)]
    for row, line in enumerate([head, *rows]):
        middle = row + 0.5 + (extra if row else 0.5 * extra)
        for column, ((x, side), text) in enumerate(zip(places, line, strict=True)):
            if row and column == _SYMBOL and text:
                _set_symbol(axes, (x, middle), text, size)
                continue
            weight = "normal" if row else "bold"
            # To measure each cell for the layout takes longer than to draw it; a remark alone in its row may need room.
            alone = not any(line[1:])
            axes.text(x, middle, text, fontsize=size, ha=side, va="center", fontweight=weight, in_layout=alone)
        axes.axhline(row + 1.0 + extra, color=style.LIGHT if row else style.GREY, linewidth=0.6)


def headed(name: str) -> tuple[str, str, str]:
    """Words, symbol and unit of a quantity."""
    entry = term(name)
    words = _WORDS.get(name, entry.words)
    return words, entry.symbol, "" if entry.unit == "1" else entry.unit.replace("^2", "²")


def value_rows(teeth: list[str], modules: list[str], quantities: Sequence[Quantity]) -> list[list[str]]:
    """Rows of words, symbol, unit and values: two columns for each mesh, its own values in the first of them."""
    rows = [["teeth", "z", "", *teeth], ["module", "m", "mm", *modules]]
    for name in _OF_GEAR:
        rows.append([*headed(name), *(_text(quantity, name, gear) for quantity in quantities for gear in (0, 1))])
    for name in _OF_MESH:
        rows.append([*headed(name), *(text for quantity in quantities for text in (_text(quantity, name), ""))])
    return rows


def _text(quantity: Quantity, name: str, gear: int | None = None) -> str:
    """A value to six digits; what the pair does not have is a dash."""
    try:
        found = quantity(name)
    except NoSolution:
        found = None
    value = found[gear or 0] if isinstance(found, tuple) else found
    if value is None:
        return "–"
    return style.number(math.degrees(value) if term(name).unit == "deg" else value)


def gear_text(value: Any, unit: str = "") -> str:
    """A cell of a gear table: six digits, lengths at least to a micrometre, nothing for what a gear does not have."""
    if value is None:
        return ""
    if isinstance(value, str):
        return value
    return style.number(value, max(6, len(f"{abs(value):.0f}") + 3) if unit == "mm" else 6)


def _set_symbol(axes: Axes, place: tuple[float, float], symbol: str, size: float) -> None:
    """A symbol of the nomenclature: its letter, and smaller texts beside it.

    matplotlib's own formulas take ten times as long as text, for it reads them by a grammar.
    """
    (letter, *_), *beside = _parted(symbol)
    stem: Any = axes.text(*place, letter, fontsize=size, fontstyle="italic", va="center", in_layout=False)
    before = stem
    for words, height, align, share in beside:
        look: dict[str, Any] = {"fontsize": share * size, "fontstyle": "italic", "va": align, "in_layout": False}
        of: Any = (before, stem)  # whatever stands before it, it is as high as the first letter says
        before = axes.annotate(words, (1.0, height), (0.3, 0.0), xycoords=of, textcoords="offset points", **look)


def _parted(symbol: str) -> list[tuple[str, float, str, float]]:
    """Letters, indices and star of a symbol, each with its place on the height of a letter, and its share of its size.

    Example
        >>> [words for words, *_ in _parted("alpha_wt")], [words for words, *_ in _parted("x_Sigma")]
        (['α', 'wt'], ['x', 'Σ'])
        >>> _parted("h_fP*")
        [('h', 0.0, 'bottom', 1.0), ('fP', 0.0, 'bottom', 0.7), ('*', 1.0, 'top', 0.9)]
    """
    plain = symbol.removesuffix("*")
    letter, _, index = plain.partition("_")
    words = [_SIGNS[letter]] if letter in _SIGNS else re.findall(r"\d+|\D+", letter)
    found = [(each, 0.0, "bottom", 0.7 if each.isdigit() else 1.0) for each in words]
    if index:
        found.append((_SIGNS.get(index, index), 0.0, "bottom", 0.7))
    return [*found, ("*", 1.0, "top", 0.9)] if plain != symbol else found


Contact: TypeAlias = MeshGeometry | RackGeometry
"""What a mesh zone shows of a mesh; points in mm."""


def zone_size(geometry: Contact, module: float) -> tuple[float, float]:
    """Half the width and half the height that show the path of contact and some teeth [mm]."""
    pitch, ends = geometry.pitch_point, (geometry.contact_start, geometry.contact_end)
    high = max(2.6 * module, *(1.3 * abs((end - pitch).imag) for end in ends))
    return max(2.7 * module, *(1.3 * abs((end - pitch).real) for end in ends), 0.95 * high), high


def zone_frame(axes: Axes, pitch: complex, wide: float, high: float, names: tuple[str, str]) -> None:
    """The limits of a mesh zone, to scale, and the names of both bodies in its lower corners."""
    axes.set_xlim(pitch.real - wide, pitch.real + wide)
    axes.set_ylim(-high, high)
    axes.set_aspect("equal", adjustable="box")
    panels.few_ticks(axes.xaxis, 5)
    for name, side, align in zip(names, (-0.94, 0.94), ("left", "right"), strict=True):
        axes.text(pitch.real + side * wide, -0.93 * high, name, color=style.BLACK, fontsize=8, ha=align)


def contact_path(axes: Axes, geometry: Contact, length: float) -> None:
    """Line of action, path of contact from A to E, and where flanks touch now."""
    pitch, ends = geometry.pitch_point, (geometry.contact_start, geometry.contact_end)
    action = pitch + length * geometry.direction * np.array([-1.0, 1.0])
    path, touching = np.array(ends), np.array(geometry.contacts)
    marked: dict[str, Any] = {"color": style.RED, "linewidth": 2.4, "marker": "|", "markersize": 11, "zorder": 5}
    dots: dict[str, Any] = {"color": "white", "markeredgecolor": style.RED, "markersize": 5.5, "zorder": 6}
    axes.plot(action.real, action.imag, color=style.BLACK, linewidth=0.8, label="line of action")
    axes.plot(path.real, path.imag, **marked, label="path of contact A–E")
    axes.plot(touching.real, touching.imag, "o", **dots, label="contact points")
    for name, point, shift in (("A", ends[0], (8, -4)), ("C", pitch, (8, -4)), ("E", ends[1], (8, -2))):
        place, box = (point.real, point.imag), {"boxstyle": "round,pad=0.15", "facecolor": "white", "edgecolor": "none"}
        look: dict[str, Any] = {"fontsize": 9, "bbox": box | {"alpha": 0.8}, "zorder": 7}
        axes.annotate(name, place, shift, textcoords="offset points", **look)


def zone_legend(axes: Axes) -> None:
    handles, labels = axes.get_legend_handles_labels()
    unique = dict(zip(labels, handles, strict=True))
    look: dict[str, Any] = {"frameon": False, "fontsize": 7.5, "handlelength": 2.4, "columnspacing": 1.2}
    axes.legend(unique.values(), unique.keys(), loc="upper center", bbox_to_anchor=(0.5, -0.11), ncols=3, **look)


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
    _small_alone(axes, scene, mesh)
    axes.margins(0.08)
    axes.autoscale_view()


_SMALL = 1.0 / 15.0
"""Of the width of a pair: a smaller gear is drawn a second time, magnified."""


def _small_alone(axes: Axes, scene: Scene, mesh: Mesh) -> None:
    """A gear that is a dot beside its mate, magnified in the free corner above it."""
    pair, tips = mesh.pair, mesh.pair.tip_radius
    small = 0 if abs(tips[0]) < abs(tips[1]) else 1
    if pair.center_distance < 0.0 or 2.0 * tips[small] > _SMALL * (sum(tips) + pair.center_distance):
        return
    reach, x = 1.3 * tips[small], small * pair.center_distance
    box = 0.73 * small + 0.01, 0.6, 0.25, 0.3
    detail = scene_axes.magnified(axes, box, scene, complex(x), reach, "magnified")
    detail.set_xticks([])
    for text in detail.texts:
        text.set_visible(abs(getattr(text, "xy", text.get_position())[0] - x) < reach)


def _axis_distance(axes: Axes, pair: GearPair) -> None:
    """The centre distance, below the gears."""
    drop, far = -1.12 * max(abs(radius) for radius in (*pair.tip_radius, pair.root_radius[1])), pair.center_distance
    ends = complex(0.0, drop), complex(far, drop)
    words = f"centre distance {abs(far):.6g} mm"
    style.dimension(axes, *ends, words, shift=(0, -4), from_points=(0j, complex(far)))
    axes.update_datalim([(0.0, 1.18 * drop)])  # room for the words


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
    if mesh.pair.teeth[gear] < 0:
        _zone_ring(axes, mesh)
    else:
        _zone_teeth(axes, mesh, gear, high)
    _zone_circles(axes, mesh, gear, high, wide)


def _zone_teeth(axes: Axes, mesh: Mesh, gear: int, high: float) -> None:
    from gearlink.core.parts.gears.outline.tooth_profile import ToothProfile, outline

    pair, geometry = mesh.pair, mesh.geometry
    pitch_angle = 2.0 * math.pi / pair.teeth[gear]
    beside = math.ceil(1.3 * high / (pair.root_radius[gear] * pitch_angle)) + 1 if pair.root_radius[gear] > 0 else 99
    count = min(pair.teeth[gear], 2 * beside + 1)
    first = geometry.first_space[gear] - pitch_angle * (count // 2)
    center = geometry.axes[gear]
    try:
        teeth = outline(ToothProfile.of(pair, gear), 1e-3 * pair.module, count, first) + center
    except NoSolution:
        words = f"gear {mesh.gears[gear]}: the tool cannot cut these teeth"
        place, box = (0.5, 0.93 - 0.08 * gear), {"facecolor": "white", "edgecolor": style.RED, "linewidth": 0.6}
        axes.text(*place, words, transform=axes.transAxes, ha="center", color=style.RED, fontsize=8, bbox=box, zorder=8)
        return
    _zone_body(axes, gear, teeth, [*teeth, center])


def _zone_body(axes: Axes, gear: int, teeth: Any, body: Any) -> None:
    """The line of the teeth of one gear, and what lies behind it tinted."""
    style.area(axes, body, facecolor=COLORS[gear], alpha=0.16, linewidth=0)
    axes.plot(teeth.real, teeth.imag, color=COLORS[gear], linewidth=1.5, zorder=3, gid=f"zone-{gear + 1}")


def _zone_ring(axes: Axes, mesh: Mesh) -> None:
    """The teeth of a ring, and its body out to the rim."""
    pair, geometry = mesh.pair, mesh.geometry
    center = geometry.axes[1]
    teeth = RingProfile(pair).outline(48) * np.exp(1j * geometry.first_space[1]) + center
    rim = center - 2.0 * pair.root_radius[1] * np.exp(-2j * math.pi * np.linspace(0.0, 1.0, 181))
    _zone_body(axes, 1, teeth, np.concatenate([teeth, rim]))


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


_LOOKS = (
    ("undercut", style.RED, "-", "undercut"),
    ("pointed tip", style.BLACK, "-", "pointed tip"),
    ("tip fouling", style.RED, style.DASHED, "tip fouling"),
    ("radial assembly", style.GREY, style.DASHED, "radial assembly"),
    ("tip", style.BLACK, style.DOTTED, "tip thickness 0.2, 0.4 m"),
    ("fillet", style.ORANGE, "-", "contact at the root fillet"),
    ("base circle", style.ORANGE, style.DASHED, "contact at the base circle"),
    ("contact ratio", style.BLUE, "-", "contact ratio 1, 1.1, 1.2"),
    ("equal sliding", style.GREEN, "-", "equal sliding"),
    ("equal root stress", style.GREEN, style.DASHED, "equal root stress"),
)
_FOOT = ("data", "axes fraction")
_SLIDING = -6.0, 1.5
"""What is shown of the specific sliding, which is at most 1 where flanks touch."""

_SHARE = 0.7
"""Of a page's height."""


def contour_svg(design: Any) -> bytes:
    """The blocking contour of a pair alone, as an svg file."""
    from gearlink.cli.views.figures.drawing.placing import settled
    from gearlink.cli.views.figures.write import save

    def made() -> Figure:
        figure = panels.page(design.spec.name, _SHARE)
        grid = figure.add_gridspec(2, 1, height_ratios=(1.0, 0.12))
        contour_plot(figure.add_subplot(grid[0]), figure.add_subplot(grid[1]), design.contour)
        return settled(figure)

    stream = BytesIO()
    save(made, design.spec.name, stream, "svg")
    return stream.getvalue()


def contour_plot(axes: Axes, key: Axes, contour: BlockingContour) -> None:
    """Every line of the contour in the plane of both shifts, the shifts that are free, and the design."""
    panels.heading(axes, "Blocking contour")
    _free(axes, contour)
    axes.plot([], [], color=style.GREEN, alpha=0.25, linewidth=6, label="permissible region")
    named: set[str] = set()
    for name, branches in contour.branches.items():
        _, color, dashes, words = next(look for look in _LOOKS if name.startswith(look[0]))
        for branch in branches:
            label = words if words not in named else "_"
            named.add(words)
            xs, ys = zip(*branch, strict=True)
            axes.plot(xs, ys, color=color, linestyle=dashes, linewidth=1.1, label=label)
    _margins(axes, contour)
    x1, x2 = contour.data.pair.profile_shift
    axes.plot([x1], [x2], "o", color="white", markeredgecolor=style.BLACK, markersize=6, label="this design", zorder=6)
    axes.set_xlim(*contour.window[0])
    axes.set_ylim(*contour.window[1])
    _named(axes, "x₁", "x₂")
    _key(key, axes.get_legend_handles_labels()[0], 3, -0.14)


def _free(axes: Axes, contour: BlockingContour) -> None:
    """The shifts that are free, as one patch: strips of their own would show their seams."""
    from matplotlib.patches import PathPatch
    from matplotlib.path import Path

    strips = [Path([*band, band[0]], closed=True) for band in contour.free]
    if strips:
        look: dict[str, Any] = {"facecolor": style.GREEN, "alpha": 0.12, "linewidth": 0}
        style.cornered(axes, PathPatch(Path.make_compound_path(*strips), **look))


def _margins(axes: Axes, contour: BlockingContour) -> None:
    """The way along the diagonal to the nearest limit on either side, with its length in x_1."""
    x1, x2 = contour.pair.profile_shift
    for side, end in enumerate(contour.nearest_limits):
        if end is None:
            continue
        name, way = end
        axes.plot([x1, x1 + way], [x2, x2 - way], color=style.BLACK, linewidth=0.8, marker="|", markersize=5, zorder=5)
        text = f"{style.number(way, 3)} {name}"
        low, high = contour.window[0]
        share = (x1 + way - low) / (high - low)
        outward = share > 0.35 if side == 0 else share < 0.65  # within the plot wherever the limit lies
        shift, align = ((-4, 3), "right") if (side == 0) == outward else ((4, -3), "left")
        level = "center"
        if not outward:  # back beside the way, clear of it and of the design's mark
            shift, level = ((shift[0], 4), "bottom") if side == 0 else ((shift[0], -4), "top")
        box = {"facecolor": "white", "alpha": 0.75, "edgecolor": "none", "pad": 0.4}
        look: dict[str, Any] = {"fontsize": 6, "zorder": 7, "bbox": box, "annotation_clip": True}
        place = (x1 + way, x2 - way)
        axes.annotate(text, place, shift, textcoords="offset points", ha=align, va=level, **look)


def _named(axes: Axes, across: str, up: str) -> None:
    axes.tick_params(labelsize=7)
    axes.set_xlabel(across, fontsize=8)
    axes.set_ylabel(up, fontsize=8)


def _key(axes: Axes, handles: Sequence[Any], columns: int, left: float = 0.0) -> None:
    """The legend in axes of its own, from so far beside its left end."""
    axes.set_axis_off()
    labels = [str(handle.get_label()) for handle in handles]
    look: dict[str, Any] = {"fontsize": 6.5, "frameon": False, "handlelength": 1.8, "columnspacing": 0.7}
    place: Any = {"loc": "upper left", "bbox_to_anchor": (left, 1.0), "borderaxespad": 0.0}
    legend = axes.legend(handles, labels, ncols=columns, **place, **look)
    legend.set_in_layout(False)


def path_plot(axes: Axes, key: Axes, data: GearData) -> None:
    """Specific sliding of both gears from A to E; with a load the pressure and root stresses as well."""
    from gearlink.core.parts.gears.along_path import AlongPath

    along = AlongPath(data)
    try:
        places = along.places(120)
    except NoSolution:
        axes.set_axis_off()
        key.set_axis_off()
        return
    panels.heading(axes, "Along the path of contact")
    rho = [place.rho for place in places]
    for gear, color in ((0, style.BLUE), (1, style.ORANGE)):
        sliding = [data.path.sliding(place.rho)[gear] for place in places]
        axes.plot(rho, sliding, color=color, linewidth=1.2, label=f"sliding, {data.called(gear)}")
    _sliding_axes(axes)
    handles = list(axes.get_lines()[:2])
    if data.load is not None and data.face_width is not None and along.single is not None:
        handles += _stresses(axes, along, places)
    for name, at in (("A", data.path.start), ("C", data.path.pitch), ("E", data.path.end)):
        axes.annotate(name, (at, 0.0), (1, 3), xycoords=_FOOT, textcoords="offset points", fontsize=7)
    _key(key, handles, 2)


def _sliding_axes(axes: Axes) -> None:
    """Names and the line of no sliding; beside a base circle, where it has no bounds, the curve leaves the panel."""
    axes.axhline(0.0, color=style.GREY, linewidth=0.6)
    _named(axes, "ρ₁ in mm", "specific sliding ζ")
    low, high = axes.get_ylim()
    axes.set_ylim(max(low, _SLIDING[0]), min(high, _SLIDING[1]))
    if low < _SLIDING[0]:
        drawn: list[Any] = [line.get_ydata() for line in axes.get_lines()[:2]]
        least = min(float(min(values)) for values in drawn)
        words = f"down to ζ = {style.number(least, 4)}"
        axes.text(0.5, 0.08, words, transform=axes.transAxes, fontsize=7, ha="center", color=style.GREY)


def _stresses(axes: Axes, along: AlongPath, places: list[Place]) -> list[Line2D]:
    """Pressure and root stresses on an axis of their own."""
    other = axes.twinx()
    _named(other, "", "stress under the nominal load [N/mm²]")
    rho = [place.rho for place in places]
    found: list[Line2D] = []

    def drawn(values: list[float | None], words: str, color: str, dashes: Any) -> None:
        heights = [math.nan if value is None or math.isinf(value) else value for value in values]
        found.extend(other.plot(rho, heights, color=color, linestyle=dashes, linewidth=1.1, label=words))

    drawn([along.pressure(place) for place in places], "pressure", style.RED, "-")
    for gear, color in ((0, style.BLUE), (1, style.ORANGE)):
        stresses = [along.root_stress(place, gear) for place in places]
        drawn(stresses, f"root stress, {along.data.called(gear)}", color, style.DASHED)
    other.set_ylim(bottom=0.0)
    return found


# The sheet of a pair

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
    place = right + 0.4 * wide, float(points.imag.max())
    axes.annotate(words, place, (4, -10), textcoords="offset points", fontsize=7)


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
    _zone_body(axes, 1, outline, outline)
