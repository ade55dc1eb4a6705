"""Drawings for the workshop of the parts that a design exports: gears, cams of wide swings, grooves, Geneva wheels.

The view is the outline that `export` writes, at cam angle 0 or with a tooth space on the horizontal axis; beside it the
table of a gear or of other sizes, or places of the roller or of the profile in polar coordinates.
"""

from __future__ import annotations

import math
import re
from collections.abc import Callable, Iterator, Sequence
from contextlib import suppress
from dataclasses import replace
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.export.contour import Circle, Contour, Part, contour
from gearlink.cli.export.options import CurveForm, drawing_of
from gearlink.cli.export.parts import makers
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.gears import gear_text, ruled
from gearlink.cli.views.figures.sheets import cam_sheets, dimensions, paper, true_size
from gearlink.core.base.errors import MissingSection
from gearlink.core.base.kinds import KINDS
from gearlink.core.numerics.arrays import Points, Reals

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

_LINES: dict[str, dict[str, Any]] = {
    "PROFILE": {"width": 0.35, "gid": "profile"},
    "PITCH_CURVE": {"width": 0.18, "linestyle": style.CHAIN, "gid": "pitch curve"},
    "PIN_CIRCLE": {"width": 0.18, "linestyle": style.CHAIN, "gid": "pitch circle"},
    "DATUM_LINE": {"width": 0.18, "linestyle": style.CHAIN},
    "PITCH_LINE": {"width": 0.13, "linestyle": style.DASHED},
}
_CIRCLES: dict[str, dict[str, Any]] = {
    "REFERENCE_CIRCLE": {"width": 0.18, "linestyle": style.CHAIN, "gid": "reference circle"},
    "TIP_CIRCLE": {"width": 0.13, "linestyle": style.CHAIN, "gid": "blank"},
    "ROLLER_AT_MID_SWING": {"width": 0.25, "linestyle": style.DASHED},
    "ROLLER": {"width": 0.25, "linestyle": style.DASHED, "gid": "roller"},
    "SHAFT": {"width": 0.25, "linestyle": style.DASHED},
    "RIM": {"width": 0.5},
}
_ERROR = 0.01
"""Of the outline on the paper [mm]."""
_GAP, _SIDE = 14.0, 12.0
"""Between the views, and for the dimension beside the second one [mm of paper]."""
_OF_RACK = 12.0 + 7.0j
"""For the dimensions beside and below a rack [mm of paper]."""
_ABOVE = 6j
"""Height for the width of the second view, half of it above [mm of paper]."""
_TURN = 2.0 * math.pi
_SIDES: Points = np.array([1, -1, 1j, -1j])
_DENSE = 20001
_A4_ROWS = 240
"""Rows of three numbers that an A4 holds in eight columns."""
_A4_LINES, _A3_LINES = 16, 32
"""Lines of a table that fill the height."""
_HALF_LOBE = 31
"""Rows of a table from a valley to a tip of a cycloidal disc."""
_IN_TABLE = ("module ", "tip radius ", "tip line ", "no backlash", "axis of the gear ")
"""How notes of a gear begin that its table or another note says."""
Rows = list[tuple[float, complex]]


def drawn(design: Any) -> dict[str, Callable[[], Figure]]:
    """What draws each part, by its name; closed disc cams have drawings with their followers instead."""
    if not KINDS[design.kind].cut:
        return {}
    parts = {}
    with suppress(MissingSection):
        parts = makers(design)
    kind, cams = KINDS[design.kind], getattr(design.spec, "cams", None) or ()
    chosen: dict[str, list[Callable[[], Part]]] = {}
    for name, make in parts.items():
        if sheet := drawing_of(kind, name, cams):
            chosen.setdefault(sheet, []).append(make)
    numbered = enumerate(chosen.items(), start=1)
    return {name: partial(draw, design, makes, f"{k} / {len(chosen)}") for k, (name, makes) in numbered}


def draw(design: Any, makes: Sequence[Callable[[], Part]], number: str) -> Figure:
    """One part, or both walls of a groove: outline, dimensions, what is to be cut and measured, title block."""
    part = _together([make() for make in makes])
    low, high = _reach(contour(part, 0.1, CurveForm.POLYLINE))
    rows = [] if part.lines is not None else _polar_rows(part)
    pages = paper.PAGES[1:] if len(rows) > _A4_ROWS else paper.PAGES
    width = 0.0 if _is_rack(part) else part.width or 0.0
    beside = _OF_RACK if _is_rack(part) else dimensions.of_rows(part)
    second = (_GAP + _SIDE) * (width > 0.0)
    page, scale = paper.fitted(high - low + width, beside + second + (_ABOVE if width else 0.0), pages)
    made, axes = paper.sheet(page)
    shape = contour(part, _ERROR / scale, CurveForm.POLYLINE)
    axis = page.view.middle - 0.5 * (scale * (low + high + width) + beside.conjugate() + second)
    right = axis + scale * high.real + beside.real + _GAP
    room = replace(page.view, right=right.real - 2.0) if width else page.view
    marked = rows and "PITCH_CURVE" in _layers(part)
    view = dimensions.View(axes, room, shape, axis, low, high, scale, rows[0][1] if marked else None)
    _outline(view)
    if _is_rack(part):
        _of_rack(view)
    else:
        dimensions.draw(view, part.dimensions or (() if part.lines else dimensions.extremes(part)))
    if width:
        _side(view, right)
    if part.lines is not None:
        _table(made, page, part)
    elif rows:
        _polar_table(axes, page, rows)
    paper.notes(axes, page, _notes(design, part, rows))
    sort = "gear" if _is_gear(part) else "cam" if "PITCH_CURVE" in _layers(part) else "part"
    title, document = f"{design.spec.name}: {part.title}", f"{sort}, workshop drawing"
    paper.block(axes, page, title, document, scale, number, _material(design, part))
    return made


def _together(parts: Sequence[Part]) -> Part:
    """Both walls of a groove as one part, with the roller between them where the table begins."""
    first, *others = parts
    if not others:
        return first
    wall, center = (complex(each) for each in first.stretches[0].points(np.array([first.stretches[0].low]))[:, 0])
    every = (each for part in others for each in part.stretches)
    walls = (replace(each, layers=each.layers[:1], points=partial(_first, each.points), extra=None) for each in every)
    roller = Circle("ROLLER", abs(wall - center), center)
    return replace(first, title="groove", stretches=(*first.stretches, *walls), circles=(*first.circles, roller))


def _first(points: Callable[[Reals], Points], parameter: Reals) -> Points:
    return points(parameter)[:1]


def _layers(part: Part) -> set[str]:
    return {layer for stretch in part.stretches for layer in stretch.layers}


def _material(design: Any, part: Part) -> str:
    """That of the table of a gear, where a rating names it; of other parts what the file says of it."""
    if part.lines is None or not _is_gear(part):
        return true_size.material_of(design)
    return next((gear_text(value) for item, _, value, _ in part.lines() if item == "material"), "")


def _is_rack(part: Part) -> bool:
    return "DATUM_LINE" in _layers(part)


def _is_gear(part: Part) -> bool:
    return _is_rack(part) or any(each.layer == "REFERENCE_CIRCLE" for each in part.circles)


def _reach(shape: Contour) -> tuple[complex, complex]:
    """Lower left and upper right corner of what is drawn [mm], the axis with it."""
    points = [line.nodes for line in shape.lines] + [np.zeros(1, dtype=complex)] * (not _is_rack(shape.part))
    points += [each.center + each.radius * _SIDES for each in _circles(shape.part)]
    if len(beside := _beside(shape.part)) > 1:
        points.append(abs(beside[0].center) * _SIDES)
    for each in shape.part.dimensions:  # wherever about the axis it will lie
        turns = np.exp(1j * _TURN * np.arange(each.places) / each.places)
        points += [turns * each.start, turns * each.end]
    every = np.concatenate(points)
    return complex(every.real.min(), every.imag.min()), complex(every.real.max(), every.imag.max())


def _beside(part: Part) -> list[Circle]:
    """Holes or pins about the axis."""
    return [each for each in part.circles if each.center and each.layer in ("PINS", "OUTPUT_HOLES")]


def _circles(part: Part) -> Iterator[Circle]:
    """Circles that are edges of the part, or that a workshop wants to see."""
    hidden = ("BASE_CIRCLE", "WORKING_CIRCLE", "ROOT_CIRCLE", *(("TIP_CIRCLE",) if _is_gear(part) else ()))
    return (each for each in part.circles if each.layer not in hidden)


def _outline(view: dimensions.View) -> None:
    """The part about its axis, visible edges wide, circles without edges and centre lines thin chains."""
    part, axes = view.shape.part, view.axes
    for each in view.shape.lines:
        look = dict(_LINES.get(each.layer, {"width": 0.35}))
        paper.line(axes, view.axis + view.scale * each.nodes, look.pop("width"), **look)
    for circle in _circles(part):
        outline = circle.center + circle.radius * np.exp(1j * np.linspace(0.0, _TURN, 361))
        look = dict(_CIRCLES.get(circle.layer, {"width": 0.35}))
        if view.shape.has_bore(circle):
            outline, look = cam_sheets.bore(circle.radius, view.keyway), {"width": 0.5, "gid": "bore"}
        paper.line(axes, view.axis + view.scale * outline, look.pop("width"), **look)
    if _is_rack(part):
        return
    _centre_lines(view)
    if view.start is not None:
        mark = view.axis + view.scale * np.array([0.94, 1.06]) * view.start
        paper.line(axes, mark, 0.9, color=style.WRONG, gid="start mark")


def _centre_lines(view: dimensions.View) -> None:
    """Thin chains through the axis and through holes or pins about it, with the circle on which several lie."""
    paper.centre_lines(view.axes, view.axis, view.scale, view.low, view.high)
    beside = _beside(view.shape.part)
    for each in beside:
        radial = each.center / abs(each.center)
        across = view.at(each.center) + (view.scale * each.radius + 0.5 * paper.PAST) * np.array([-1.0, 1.0]) * radial
        paper.line(view.axes, across, 0.13)
    if len(beside) > 1 and "PIN_CIRCLE" not in _layers(view.shape.part):
        circle = abs(beside[0].center) * np.exp(1j * np.linspace(0.0, _TURN, 361))
        paper.line(view.axes, view.axis + view.scale * circle, 0.18, linestyle=style.CHAIN, gid="pitch circle")


def _of_rack(view: dimensions.View) -> None:
    """Length and height of a rack."""
    profile: Points = np.concatenate([line.nodes for line in view.shape.lines if line.layer == "PROFILE"])
    left, right = float(profile.real.min()), float(profile.real.max())
    low, high = float(profile.imag.min()), float(profile.imag.max())
    axes, axis, scale = view.axes, view.axis, view.scale
    below, beside = axis.imag + scale * low - 7.0, axis.real + scale * right + 5.0
    ends = complex(axis.real + scale * left, below), complex(axis.real + scale * right, below)
    paper.arrow(axes, *ends, "<|-|>")
    paper.text(axes, 0.5 * (ends[0] + ends[1]) - 3j, f"{right - left:.3f}", ha="center")
    tall = complex(beside, axis.imag + scale * low), complex(beside, axis.imag + scale * high)
    paper.arrow(axes, *tall, "<|-|>")
    paper.text(axes, 0.5 * (tall[0] + tall[1]) + 1.0, f"{high - low:.3f}")


def _side(view: dimensions.View, left: complex) -> None:
    """The face of a part from the side: its outside, of a gear the reference line, width and outside diameter."""
    axes, scale, part = view.axes, view.scale, view.shape.part
    radii = {circle.layer: circle.radius for circle in part.circles}
    farthest = max(float(np.abs(line.nodes).max()) for line in view.shape.lines)
    outer, wide = radii.get("RIM", radii.get("TIP_CIRCLE", farthest)), scale * (part.width or 0.0)
    tall, middle = scale * outer, left
    corners = [middle - 1j * tall, middle + wide - 1j * tall, middle + wide + 1j * tall, middle + 1j * tall]
    paper.line(axes, [*corners, corners[0]], 0.5)
    if "REFERENCE_CIRCLE" in radii:
        for side in (-1.0, 1.0):
            place = middle + 1j * side * scale * radii["REFERENCE_CIRCLE"]
            paper.line(axes, [place - 2.0, place + wide + 2.0], 0.18, linestyle=style.CHAIN)
    paper.line(axes, [middle - 3.0, middle + wide + 3.0], 0.18, linestyle=style.CHAIN)
    above, beside = middle + 1j * (tall + 4.0), middle + wide + 5.0
    paper.arrow(axes, above, above + wide, "<|-|>")
    paper.text(axes, above + 0.5 * wide + 2.5j, f"{part.width:g}", ha="center")
    paper.arrow(axes, beside - 1j * tall, beside + 1j * tall, "<|-|>")
    paper.value(axes, beside + 1.2 + 0.5j * tall, f"⌀{2.0 * outer:.3f}", rotation=90, ha="left")


def _table(made: Figure, page: paper.Page, part: Part) -> None:
    """The lines of the part's table."""
    assert part.lines is not None, "asked for only of parts with such lines"
    box = page.table
    lines = part.lines()
    rows = [[item, symbol, unit.replace("um", "µm"), gear_text(value, unit)] for item, symbol, value, unit in lines]
    count = 2 if page.name == "A4" and len(rows) > _A4_LINES else 1
    most = max(-(-len(rows) // count), _A4_LINES if page.name == "A4" else _A3_LINES)
    wide, tall = (box.right - box.left) / count, box.high - box.low - 2.0
    size = min(7.0, 0.62 * tall / (most + 1.0) * 72.0 / 25.4)
    for k in range(-(-len(rows) // most)):
        left = box.left + k * wide + 2.0
        place: Any = (left / page.width, (box.low + 1.0) / page.height, (wide - 4.0) / page.width, tall / page.height)
        name = "gear table" if _is_gear(part) else "sizes"
        head = [name if k == 0 else "", "", "unit", ""]
        ruled(made.add_axes(place), head, rows[k * most : (k + 1) * most], size=size, rows_of=most, at=(0.52, 0.66))
    paper.frame(made.axes[0], box, 0.25)


def _polar_table(axes: Axes, page: paper.Page, rows: Rows) -> None:
    """Radius and direction of each place."""
    heads = ("°", "R", "φ")
    digits = next((some for some in range(4) if all(math.isclose(at, round(at, some)) for at, _ in rows)), 4)
    angles = np.degrees(np.angle([place for _, place in rows])) % 360.0
    cells = [(f"{at:.{digits}f}", f"{abs(z):.3f}", f"{way:.3f}") for (at, z), way in zip(rows, angles, strict=True)]
    paper.columns(axes, page, heads, cells, math.ceil(len(cells) / (60 if page.name == "A3" else 30)))


def _notes(design: Any, part: Part, rows: Rows) -> list[str]:
    """What outline and table do not say."""
    if not _is_gear(part):
        return [_begun(note) for note in (*part.notes, *_of_table(part, rows), true_size.limits_of(design))]
    assert part.lines is not None, "gears have a table"
    limits = any("maximum" in item for item, *_ in part.lines())
    way = "between" if part.rim else "over"
    lacking = "Hub" if any(circle.layer == "BORE" for circle in part.circles) else "Bore, hub"
    measured = f"Span and measure {way} balls within the limits of the table." if limits else (
        "The file has no allowances: span and measures are nominal, without backlash.")  # fmt: skip
    return [
        measured,
        *(_begun(note) for note in part.notes if not note.startswith(_IN_TABLE)),
        f"{lacking} and tolerances of the blank are not in the file. Lines of the table: DIN 3966.",
    ]


def _of_table(part: Part, rows: Rows) -> Iterator[str]:
    """What the table of places has."""
    if not rows:
        return
    if "PITCH_CURVE" not in _layers(part):
        yield "Table: profile from a valley to a tip, R [mm] and φ [deg] over the parameter of the curve [deg]."
        return
    input_ = "input angle" if part.extra_columns[0].startswith("input") else "cam angle"
    table = f"Table: centre of the roller, R [mm] and φ [deg] counter-clockwise, over the {input_} [deg]."
    yield f"{table} Start mark (red): its first row."


def _begun(words: str) -> str:
    """A note with a capital letter, its numbers to 0.1 um: files for machines have all digits."""
    short = re.sub(r"\d+\.\d{5,}", lambda found: f"{float(found[0]):.4f}", words)
    return short[:1].upper() + short[1:]


def _polar_rows(part: Part) -> Rows:
    """Centre of the roller at each degree of the angle of cam or input; of a lobed disc the profile of half a lobe."""
    names = [name for name in part.extra_columns if name.startswith(("cam_angle", "input_angle", "parameter"))]
    if not names:
        return []
    found: dict[float, complex] = {}
    column, layer = part.extra_columns.index(names[0]), "PITCH_CURVE" if "PITCH_CURVE" in _layers(part) else "PROFILE"
    for stretch in part.stretches if layer == "PITCH_CURVE" else part.stretches[:1]:
        if layer not in stretch.layers or stretch.extra is None:
            continue
        share = np.linspace(stretch.low, stretch.high, _DENSE)
        angle = stretch.extra(share)[column]
        low, high = float(angle.min()), float(angle.max())
        degrees = np.arange(math.ceil(low - 1e-9), math.floor(high + 1e-9) + 1.0)
        if layer == "PROFILE":
            degrees = np.linspace(low, 0.5 * (low + high), _HALF_LOBE)
        order = np.argsort(angle)
        at = stretch.points(np.interp(degrees, angle[order], share[order]))[stretch.layers.index(layer)]
        found.update(zip(degrees.tolist(), at.tolist(), strict=True))
    return [(degree, complex(found[degree])) for degree in sorted(found) if degree < 360.0]
