"""Drawings for the workshop of the parts that a design exports: gears with their table, cams of wide swings.

The view is the outline that `export` writes, at cam angle 0 or with a tooth space on the horizontal axis.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterator
from contextlib import suppress
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export.contour import Contour, Part, contour
from gearlink.cli.export.options import CurveForm, is_cut
from gearlink.cli.export.parts import makers
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.gears import gear_text, ruled
from gearlink.cli.views.figures.sheets import cam_sheets, paper, true_size
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.kinds import KINDS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.numerics.arrays import Points

_LINES: dict[str, dict[str, Any]] = {
    "PROFILE": {"width": 0.35, "gid": "profile"},
    "PITCH_CURVE": {"width": 0.18, "linestyle": style.CHAIN, "gid": "pitch curve"},
    "DATUM_LINE": {"width": 0.18, "linestyle": style.CHAIN},
    "PITCH_LINE": {"width": 0.13, "linestyle": style.DASHED},
}
_CIRCLES: dict[str, dict[str, Any]] = {
    "REFERENCE_CIRCLE": {"width": 0.18, "linestyle": style.CHAIN, "gid": "reference circle"},
    "ROLLER_AT_MID_SWING": {"width": 0.25, "linestyle": style.DASHED},
    "RIM": {"width": 0.5},
}
_ERROR = 0.01
"""Of the outline on the paper [mm]."""
_GAP, _SIDE = 14.0, 12.0
"""Between the views, and for the dimension beside the second one [mm of paper]."""
_LETTER = 1.45
"""Width of a letter [mm of paper]."""
_TURN = 2.0 * math.pi
_DENSE = 20001
_A4_ROWS = 240
"""Rows of three numbers that an A4 holds in eight columns."""


def drawn(design: Any) -> dict[str, Callable[[], Figure]]:
    """What draws each part, by its name; closed disc cams have drawings with their followers instead."""
    if not KINDS[design.kind].cut:
        return {}
    parts = {}
    with suppress(MissingSection):
        parts = makers(design)
    kind, cams = KINDS[design.kind], getattr(design.spec, "cams", None) or ()
    chosen = [name for name in parts if is_cut(kind, name, cams)]
    return {name: partial(draw, design, parts[name], f"{k} / {len(chosen)}") for k, name in enumerate(chosen, start=1)}


def draw(design: Any, make: Callable[[], Part], number: str) -> Figure:
    """One part: outline, circles and dimensions, what is to be cut and measured, title block."""
    part = make()
    rough = contour(part, 0.1, CurveForm.POLYLINE)
    low, high = _reach(rough)
    rows = [] if part.lines is not None else _cam_rows(part)
    pages = paper.PAGES[1:] if len(rows) > _A4_ROWS else paper.PAGES
    width, size = (part.width or 0.0) * (part.lines is not None and part.teeth > 0), high - low
    page, scale = paper.fitted(size + width, (_GAP + _SIDE) * (width > 0.0), pages)
    made, axes = paper.sheet(page)
    shape = contour(part, _ERROR / scale, CurveForm.POLYLINE)
    left = page.view.middle - scale * 0.5 * (low + high) - 0.5 * (scale * width + (_GAP + _SIDE) * (width > 0.0))
    _view(axes, shape, left, scale, rows)
    _dimensions(axes, page.view, shape, left, scale)
    if width:
        _side(axes, part, left + scale * high.real + _GAP, scale)
    if part.lines is not None:
        _gear_table(made, page, part)
    elif rows:
        heads = ("°", "R", "φ")
        cells = [(f"{degree:g}", f"{abs(at):.3f}", f"{math.degrees(np.angle(at)) % 360.0:.3f}") for degree, at in rows]
        paper.columns(axes, page, heads, cells, math.ceil(len(cells) / (60 if page.name == "A3" else 30)))
    paper.notes(axes, page, _notes(part, rows))
    document = "gear, workshop drawing" if part.lines is not None else "cam, workshop drawing"
    material = "" if part.lines is not None else true_size.material_of(design)
    paper.block(axes, page, f"{design.spec.name}: {part.title}", document, scale, number, material)
    return made


def _is_rack(part: Part) -> bool:
    return part.lines is not None and not part.teeth


def _reach(shape: Contour) -> tuple[complex, complex]:
    """Lower left and upper right corner of what is drawn [mm], the axis with it."""
    points = [line.nodes for line in shape.lines] + [np.zeros(1, dtype=complex)] * (not _is_rack(shape.part))
    points += [each.center + each.radius * np.array([1, -1, 1j, -1j]) for each in _circles(shape.part)]
    every = np.concatenate(points)
    return complex(every.real.min(), every.imag.min()), complex(every.real.max(), every.imag.max())


def _circles(part: Part) -> Iterator[Any]:
    """Circles that are edges of the part, or that a workshop wants to see."""
    hidden = ("BASE_CIRCLE", "WORKING_CIRCLE", "TIP_CIRCLE", "ROOT_CIRCLE")
    return (each for each in part.circles if each.layer not in hidden)


def _view(axes: Axes, shape: Contour, axis: complex, scale: float, rows: list[tuple[float, complex]]) -> None:
    """The part about its axis, visible edges wide, circles without edges and centre lines thin chains."""
    part = shape.part
    way = rows[0][1] / abs(rows[0][1]) if rows else 1.0 + 0j
    for each in shape.lines:
        look = dict(_LINES.get(each.layer, {"width": 0.35}))
        paper.line(axes, axis + scale * each.nodes, look.pop("width"), **look)
    for circle in _circles(part):
        outline = circle.center + circle.radius * np.exp(1j * np.linspace(0.0, _TURN, 361))
        look = dict(_CIRCLES.get(circle.layer, {"width": 0.35}))
        if circle.layer == "SHAFT" and rows:
            outline, look = cam_sheets.bore(circle.radius, way), {"width": 0.5, "gid": "bore"}
        paper.line(axes, axis + scale * outline, look.pop("width"), **look)
    if _is_rack(part):
        return
    low, high = _reach(shape)
    past = paper.PAST * np.array([-1.0, 1.0])
    for turn, ends in ((1.0, np.array([low.real, high.real])), (1j, np.array([low.imag, high.imag]))):
        paper.line(axes, axis + turn * (scale * ends + past), 0.18, linestyle=style.CHAIN, gid="axis")
    if rows:
        edge = scale * abs(rows[0][1])
        paper.line(axes, axis + edge * np.array([0.94, 1.06]) * way, 0.9, color=style.WRONG, gid="start mark")


def _dimensions(axes: Axes, view: paper.Box, shape: Contour, axis: complex, scale: float) -> None:
    """Diameters of a gear, length and height of a rack, radii of a cam, bore and keyway."""
    part = shape.part
    profile: Points = np.concatenate([line.nodes for line in shape.lines if line.layer == "PROFILE"])
    if _is_rack(part):
        _of_rack(axes, profile, axis, scale)
        return
    for circle in part.circles:
        at = axis + scale * circle.center, scale * circle.radius
        if circle.layer == "ROLLER_AT_MID_SWING":
            _leader(axes, view, at, f"⌀{2.0 * circle.radius:g}", 0.8)
        elif circle.layer == "SHAFT":
            slot = cam_sheets.keyway(2.0 * circle.radius)
            key = f"\nkeyway {slot[0]:g} P9, {2.0 * circle.radius + slot[1]:g} over bore" if slot else ""
            _leader(axes, view, at, f"⌀{2.0 * circle.radius:g} H7{key}", -1.1)
        elif circle.layer == "RIM" or (circle.layer == "TIP_CIRCLE" and not part.width):
            _leader(
                axes, view, at, f"⌀{2.0 * circle.radius:.3f}", 0.8 if circle.layer == "RIM" or not part.rim else -0.8
            )
    if part.lines is None:
        size = np.abs(profile)
        for k in dict.fromkeys((int(size.argmin()), int(size.argmax()))):
            end = axis + scale * complex(profile[k])
            paper.arrow(axes, axis, end)
            place = axis + 0.66 * scale * complex(profile[k])
            paper.text(axes, place, f"R{size[k]:.3f}", ha="center", path_effects=style.outlined())


def _leader(axes: Axes, view: paper.Box, circle: tuple[complex, float], words: str, way: float) -> None:
    """Words beside a circle, with an arrow to it, on the right where the view has room."""
    (center, radius), long = circle, _LETTER * max(map(len, words.split("\n")))
    unit = complex(math.cos(way), math.sin(way))
    right = center.real + (radius + 8.0) * unit.real + 0.8 + long < view.right
    unit = unit if right else -unit.conjugate()
    foot = center + (radius + 8.0) * unit
    paper.arrow(axes, foot, center + radius * unit)
    paper.text(
        axes, foot + (0.8 if right else -0.8), words, ha="left" if right else "right", path_effects=style.outlined()
    )


def _of_rack(axes: Axes, profile: Points, axis: complex, scale: float) -> None:
    left, right = float(profile.real.min()), float(profile.real.max())
    low, high = float(profile.imag.min()), float(profile.imag.max())
    below, beside = axis.imag + scale * low - 7.0, axis.real + scale * right + 5.0
    ends = complex(axis.real + scale * left, below), complex(axis.real + scale * right, below)
    paper.arrow(axes, *ends, "<|-|>")
    paper.text(axes, 0.5 * (ends[0] + ends[1]) - 3j, f"{right - left:.3f}", ha="center")
    tall = complex(beside, axis.imag + scale * low), complex(beside, axis.imag + scale * high)
    paper.arrow(axes, *tall, "<|-|>")
    paper.text(axes, 0.5 * (tall[0] + tall[1]) + 1.0, f"{high - low:.3f}")


def _side(axes: Axes, part: Part, left: complex, scale: float) -> None:
    """The face of a gear from the side: tip cylinder, reference line, width and tip diameter."""
    radii = {circle.layer: circle.radius for circle in part.circles}
    outer, wide = radii.get("RIM", radii["TIP_CIRCLE"]), scale * (part.width or 0.0)
    tall, middle = scale * outer, complex(left.real, left.imag)
    corners = [middle - 1j * tall, middle + wide - 1j * tall, middle + wide + 1j * tall, middle + 1j * tall]
    paper.line(axes, [*corners, corners[0]], 0.5)
    for side in (-1.0, 1.0):
        place = middle + 1j * side * scale * radii["REFERENCE_CIRCLE"]
        paper.line(axes, [place - 2.0, place + wide + 2.0], 0.18, linestyle=style.CHAIN)
    paper.line(axes, [middle - 3.0, middle + wide + 3.0], 0.18, linestyle=style.CHAIN)
    above, beside = middle + 1j * (tall + 4.0), middle + wide + 5.0
    paper.arrow(axes, above, above + wide, "<|-|>")
    paper.text(axes, above + 0.5 * wide + 2.5j, f"{part.width:g}", ha="center")
    paper.arrow(axes, beside - 1j * tall, beside + 1j * tall, "<|-|>")
    words = f"⌀{2.0 * outer:.3f}"
    paper.text(axes, beside + 1.2 + 0.5j * tall, words, rotation=90, ha="left", path_effects=style.outlined())


def _gear_table(made: Figure, page: paper.Page, part: Part) -> None:
    """The lines of the gear's table."""
    assert part.lines is not None, "asked for only of gears"
    box = page.table
    rows = [[item, symbol, unit.replace("um", "µm"), gear_text(value)] for item, symbol, value, unit in part.lines()]
    count = 2 if page.name == "A4" else 1
    most = max(-(-len(rows) // count), 32 // count)
    wide, tall = (box.right - box.left) / count, box.high - box.low - 2.0
    size = min(7.0, 0.62 * tall / (most + 1.0) * 72.0 / 25.4)
    for k in range(-(-len(rows) // most)):
        left = box.left + k * wide + 2.0
        place: Any = (left / page.width, (box.low + 1.0) / page.height, (wide - 4.0) / page.width, tall / page.height)
        head = ["gear table" if k == 0 else "", "", "unit", ""]
        ruled(made.add_axes(place), head, rows[k * most : (k + 1) * most], size=size, rows_of=most, at=(0.52, 0.66))
    paper.frame(made.axes[0], box, 0.25)


def _notes(part: Part, rows: list[tuple[float, complex]]) -> list[str]:
    """What the outline does not say."""
    if part.lines is None:
        table = "Table: centre of the roller, R [mm] and φ [deg] counter-clockwise, over the cam angle [deg]."
        return [
            _begun(note) for note in (*part.notes, *([table + " Start mark (red): its first row."] if rows else []))
        ]
    limits = any("maximum" in item for item, *_ in part.lines())
    measured = "Span and measure over balls within the limits of the table." if limits else (
        "The file has no allowances: span and measures are nominal, without backlash.")  # fmt: skip
    frame = next((note for note in part.notes if note.startswith("frame:")), "")
    root = [note for note in part.notes if note.startswith("root")]
    return [
        measured,
        *root,
        frame,
        "Bore, hub and tolerances of the blank are not in the file. Lines of the table: DIN 3966.",
    ]


def _begun(words: str) -> str:
    return words[:1].upper() + words[1:]


def _cam_rows(part: Part) -> list[tuple[float, complex]]:
    """Centre of the roller at each degree of the cam angle, where the part has that column."""
    names = [name for name in part.extra_columns if name.startswith("cam_angle")]
    if not names:
        return []
    found: dict[float, complex] = {}
    column = part.extra_columns.index(names[0])
    for stretch in part.stretches:
        if "PITCH_CURVE" not in stretch.layers or stretch.extra is None:
            continue
        share = np.linspace(stretch.low, stretch.high, _DENSE)
        angle = stretch.extra(share)[column]
        degrees = np.arange(math.ceil(float(angle.min()) - 1e-9), math.floor(float(angle.max()) + 1e-9) + 1.0)
        order = np.argsort(angle)
        at = stretch.points(np.interp(degrees, angle[order], share[order]))[stretch.layers.index("PITCH_CURVE")]
        found.update(zip(degrees.tolist(), at.tolist(), strict=True))
    return [(degree, complex(found[degree])) for degree in sorted(found) if degree < 360.0]
