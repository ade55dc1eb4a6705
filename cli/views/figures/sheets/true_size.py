"""Sheets to a scale that is printed: cams true to size, drawings of cams for the workshop, velocity polygons on A4.

A cam that is to be laid on the workpiece has its outline, roller path and axes, and a bar that checks the print. A
drawing for the workshop is on A4 or A3 with frame and title block, at a standard scale, with its radii; lengths on the
paper are in mm from its lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.sheets import cam_sheets, paper
from gearlink.cli.views.figures.sheets.cam_sheets import discs

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.machines.flatbed_press.design import FlatbedPress
    from gearlink.core.parts.cams.contour import Contour
    from gearlink.core.parts.cams.disc_cam import DiscCam


MARGIN = 10.0
"""About the drawing [mm]."""
_HEAD, _FOOT, _BAR = 9.0, 12.0, 100.0
"""Height of the title and of the bar below the cam, and the bar's length [mm of paper]."""
PAPERS = {"A4": (210.0, 297.0), "A3": (297.0, 420.0), "A2": (420.0, 594.0), "A1": (594.0, 841.0), "A0": (841.0, 1189.0)}
_POINTS = 7200


class Scale(NamedTuple):
    """1:N, and the paper that it is to fit on; none: a page as large as the drawing and its margin."""

    reduction: float = 1.0
    paper: str = ""

    @property
    def words(self) -> str:
        """1:N."""
        return f"1:{self.reduction:g}"


def drawing(design: Any, index: int, scale: Scale) -> Figure:
    """One cam, a mm of it being 1/N mm of paper.

    Raises
        DesignFileError - where the paper is too small; it names the minimum that is large enough
    """
    from matplotlib.figure import Figure

    cam = discs(design)[index]
    theta = np.linspace(0.0, 2.0 * math.pi, _POINTS + 1)
    pitch, profile = cam.points(theta)
    wall = cam_sheets.outer_wall(design)
    reach = (cam if wall is None else wall).max_radius + 5.0 * scale.reduction
    low = complex(min(pitch.real.min(), -reach), min(pitch.imag.min(), -reach))
    high = complex(max(pitch.real.max(), reach), max(pitch.imag.max(), reach))
    size = (high - low) / scale.reduction
    needed = max(size.real, _BAR), size.imag + _HEAD + _FOOT
    width, height = _page(needed, scale)
    made = Figure(figsize=(width / 25.4, height / 25.4), facecolor="white")
    axes: Any = made.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    middle = 0.5 * (low + high)
    bottom = middle.imag - scale.reduction * (0.5 * size.imag + _FOOT + 0.5 * (height - needed[1]))
    left = middle.real - 0.5 * width * scale.reduction
    axes.set_xlim(left, left + width * scale.reduction)
    axes.set_ylim(bottom, bottom + height * scale.reduction)
    axes.plot(profile.real, profile.imag, color=style.BLACK, linewidth=0.7, gid="profile")
    if wall is not None:
        outside = wall.points(theta)[1]
        axes.plot(outside.real, outside.imag, color=style.BLACK, linewidth=0.7, gid="outer wall")
    if cam.roller_radius:
        axes.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.35, linestyle=style.DASHED, gid="pitch curve")
    for curve in axes.lines:
        curve.get_path().should_simplify = False  # which would leave out points within a tenth of a point
    for way in (1.0, 1j):
        line = np.array([-reach, reach]) * way
        axes.plot(line.real, line.imag, color=style.GREY, linewidth=0.35, linestyle="-.")
    shaft = shaft_of(design, index)
    if shaft > 0.0:
        bore = shaft * np.exp(1j * theta)
        axes.plot(bore.real, bore.imag, color=style.BLACK, linewidth=0.7)
    mark = np.array([0.9, 1.0]) * profile[0]
    axes.plot(mark.real, mark.imag, color=style.RED, linewidth=1.0)
    start = complex(middle.real - 0.5 * _BAR * scale.reduction, low.imag - 7.0 * scale.reduction)
    ends = [start.real, start.real + _BAR * scale.reduction]
    axes.plot(ends, [start.imag] * 2, color=style.BLACK, linewidth=1.0, gid="bar")
    what = _WORDS[cam_sheets.touching(cam)].mark
    words = f"this bar is 100 mm long on paper; start mark: {what} here at cam angle 0"
    axes.text(start.real, start.imag - 1.5 * scale.reduction, words, fontsize=6, va="top")
    title = f"{design.spec.name}: {cam.name}, scale {scale.words}"
    axes.text(middle.real, high.imag + 2.0 * scale.reduction, title, fontsize=9, fontweight="bold", ha="center")
    return made


def _page(needed: tuple[float, float], scale: Scale) -> tuple[float, float]:
    """Width and height of the page [mm]."""
    width, height = needed[0] + 2.0 * MARGIN, needed[1] + 2.0 * MARGIN
    if not scale.paper:
        return width, height
    short, long = PAPERS[scale.paper]
    for page in ((short, long), (long, short)):
        if width <= page[0] and height <= page[1]:
            return page
    fits = [name for name, (a, b) in PAPERS.items() if min(width, height) <= a and max(width, height) <= b]
    remedy = f"use {fits[0]}" if fits else "reduce the scale: not even A0 holds it"
    text = f"at {scale.words} the drawing takes {width:.0f} x {height:.0f} mm with its margin, more than {scale.paper}"
    raise DesignFileError([Diagnostic("GL115", f"{text}: {remedy}", "<command line>", key="--paper")])


_CHAINS = (("B", "C", style.BLUE), ("E", "F", style.GREEN), ("H", "M", style.ORANGE))
_PAPER = (210.0, 297.0)
_COLUMNS, _ROWS = 3, 4
_BOX, _EDGE, _TOP, _STEP = 60.0, 12.0, 24.0, 66.0
"""Of the paper [mm]: each polygon's box, the margin, the title's height, and the pitch of the rows."""
_ROOM = 56.0
_POLYGON_BAR = 10.0


def polygons(design: FlatbedPress) -> Figure:
    """Twelve polygons with their pole p: v_B + v_CB = v_C, v_E + v_FE = v_F, v_H + v_MH = v_M."""
    from matplotlib.figure import Figure

    table = design.table("polygons")
    ends = {
        name: table[name] * np.exp(1j * np.radians(table[f"{name}_direction"]))
        for start, end, _ in _CHAINS
        for name in (f"v_{start}", f"v_{end}")
    }
    boxes = [_box([complex(each[row]) for each in ends.values()]) for row in range(table.length)]
    scale = next_scale(max(size for _, size in boxes) / _ROOM)
    made = Figure(figsize=(_PAPER[0] / 25.4, _PAPER[1] / 25.4), facecolor="white")
    words = f"{design.spec.name}: velocity polygons, 1 mm on A4 is μv = {scale:g} mm/s"
    made.suptitle(words, fontsize=12, fontweight="bold", y=1.0 - 10.0 / _PAPER[1])
    for row, (middle, _) in enumerate(boxes):
        axes = _axes(made, row)
        half = 0.5 * _BOX * scale
        axes.set_xlim(middle.real - half, middle.real + half)
        axes.set_ylim(middle.imag - half, middle.imag + half)
        axes.set_title(f"{row + 1}: {table['input_angle'][row]:g}°", loc="left", fontsize=8, fontweight="bold", pad=2)
        _polygon(axes, {name: complex(each[row]) for name, each in ends.items()})
        corner = middle - half * (0.95 + 0.95j)
        start, long = (corner.real, corner.imag), _POLYGON_BAR * scale
        axes.plot([corner.real, corner.real + long], [corner.imag] * 2, color=style.BLACK, linewidth=1.5)
        axes.annotate(f"{long:g} mm/s", start, (0, 2), textcoords="offset points", fontsize=6)
    return made


def next_scale(least: float) -> float:
    """The next of 1, 2, 5 times a power of ten.

    Example
        >>> next_scale(37.0), next_scale(5.1), next_scale(1.0)
        (50.0, 10.0, 1.0)
    """
    power = 10.0 ** math.floor(math.log10(least))
    return next(step * power for step in (1.0, 2.0, 5.0, 10.0) if step * power >= least * (1.0 - 1e-12))


def _box(points: list[complex]) -> tuple[complex, float]:
    """Middle and size of what a position takes, the pole with it."""
    x, y = [0.0, *(each.real for each in points)], [0.0, *(each.imag for each in points)]
    middle = complex(0.5 * (min(x) + max(x)), 0.5 * (min(y) + max(y)))
    return middle, max(max(x) - min(x), max(y) - min(y))


def _axes(made: Figure, row: int) -> Axes:
    left, top = _EDGE + (row % _COLUMNS) * (_BOX + 3.0), _TOP + (row // _COLUMNS) * _STEP
    width, height = _PAPER
    place: Any = (left / width, 1.0 - (top + _BOX) / height, _BOX / width, _BOX / height)
    axes = made.add_axes(place)
    axes.set_xticks([])
    axes.set_yticks([])
    for edge in axes.spines.values():
        edge.set(color=style.GREY, linewidth=0.5)
    return axes


def _polygon(axes: Axes, ends: dict[str, complex]) -> None:
    """Both rays from the pole, and the side that joins their ends."""
    for start, end, color in _CHAINS:
        one, other = ends[f"v_{start}"], ends[f"v_{end}"]
        for a, b in ((0j, one), (one, other), (0j, other)):
            shape: Any = {"arrowstyle": "-|>", "color": color, "linewidth": 0.9, "shrinkA": 0.0, "shrinkB": 0.0}
            axes.annotate("", (b.real, b.imag), (a.real, a.imag), arrowprops=shape)
        for name, place in ((start.lower(), one), (end.lower(), other)):
            away = place / abs(place) if place else 1.0
            shift = (6.0 * away.real, 6.0 * away.imag)
            axes.annotate(name, (place.real, place.imag), shift, textcoords="offset points", fontsize=7, color=color,
                          ha="center", va="center")  # fmt: skip
    axes.plot([0.0], [0.0], "o", color=style.BLACK, markersize=2.5)
    axes.annotate("p", (0.0, 0.0), (-6, -6), textcoords="offset points", fontsize=7)


_TURN = 2.0 * math.pi


def workshop_drawing(design: Any, index: int) -> Figure:
    """One cam: outline, roller and axes, bore and keyway, start mark, radii of each degree, title block."""
    cams = cam_sheets.discs(design)
    cam = cams[index]
    wall = cam_sheets.outer_wall(design)
    low, high = _reach(cam, wall)
    page, scale = paper.fitted(high - low)
    made, axes = paper.sheet(page)
    _view(axes, page, (cam, wall), scale, shaft_of(design, index))
    paper.notes(axes, page, notes(design, cam))
    radii = enumerate(cam_sheets.pitch_radii(cam).tolist())
    paper.columns(axes, page, ("°", "R"), [(f"{degree}", f"{radius:.3f}") for degree, radius in radii], page.columns)
    title, number = f"{design.spec.name}: {cam.name}", f"{index + 1} / {len(cams)}"
    paper.block(axes, page, title, "cam, workshop drawing", scale, number, material_of(design))
    return made


def shaft_of(design: Any, index: int) -> float:
    """Radius of the shaft of a cam [mm]; 0 where the file does not name it."""
    if (structure := getattr(design, "structure", None)) is not None:
        return float([*structure.cams.values()][index].shaft)
    section = getattr(getattr(design, "cams", None), "section", None) or getattr(design.spec, "cam", None)
    return float(getattr(section, "shaft_radius", None) or 0.0)


def material_of(design: Any) -> str:
    """What the file says of the material of cams and discs."""
    material = getattr(getattr(design.spec, "loads", None), "material", None)
    if material is not None:
        return f"E {material.modulus:g} N/mm²"
    given = "material" in design.spec.model_fields_set
    return f"E {design.spec.material.elastic_modulus:g} N/mm²" if given else ""


def _reach(cam: Any, wall: Any) -> tuple[complex, complex]:
    """Lower left and upper right corner of what is drawn [mm]."""
    pitch, profile = cam.points(np.linspace(0.0, _TURN, 721))
    if wall is not None:
        profile = wall.points(np.linspace(0.0, _TURN, 721))[1]
    roller, radius = complex(pitch[0]), cam.roller_radius
    beside = roller + radius * np.array([1, -1, 1j, -1j]) if radius else _follower(cam)
    every = np.concatenate([pitch, profile, beside])
    return complex(every.real.min(), every.imag.min()), complex(every.real.max(), every.imag.max())


def _view(axes: Axes, page: paper.Page, walls: tuple[DiscCam, Any], scale: float, shaft: float) -> None:
    """The cam at cam angle 0 about its axis, visible edges wide, pitch curve and centre lines thin chains."""
    cam, wall = walls
    low, high = _reach(cam, wall)
    axis = page.view.middle - scale * 0.5 * (low + high)
    theta = np.linspace(0.0, _TURN, 7201)
    pitch, profile = cam.points(theta)
    paper.line(axes, axis + scale * profile, 0.5, gid="profile")
    if wall is not None:
        paper.line(axes, axis + scale * wall.points(theta)[1], 0.5, gid="outer wall")
    roller, touching = complex(pitch[0]), _follower(cam)
    if cam.roller_radius:
        paper.line(axes, axis + scale * pitch, 0.25, linestyle=style.CHAIN, gid="pitch curve")
    paper.line(axes, axis + scale * touching, 0.25, linestyle=style.DASHED)
    paper.centre_lines(axes, axis, scale, low, high)
    paper.line(axes, axis + scale * np.array([0.0, 1.05 * roller]), 0.18, linestyle=style.CHAIN)
    way = roller / abs(roller)
    edge = float(np.abs(profile[int(np.argmin(np.abs(np.angle(profile / way))))]))
    paper.line(axes, axis + scale * edge * np.array([0.9, 1.0]) * way, 0.9, color=style.WRONG, gid="start mark")
    if shaft > 0.0:
        paper.line(axes, axis + scale * cam_sheets.bore(shaft, way), 0.5, gid="bore")
    taken = np.array(_dimensions(axes, cam, axis, scale, shaft))
    free = max(_AROUND.tolist(), key=lambda angle: float(np.abs(np.angle(taken * np.exp(-1j * angle))).min()))
    bend = np.exp(1j * (free + 0.3 * cam.sense * np.linspace(-1.0, 1.0, 30)))
    turning = axis + scale * 0.5 * (cam.min_radius + shaft) * bend
    paper.line(axes, turning, 0.25, gid="sense of rotation")
    paper.arrow(axes, complex(turning[-2]), complex(turning[-1]))


def _follower(cam: Any) -> Any:
    """The roller, the face or the edge at cam angle 0 [mm]."""
    touching, start = cam_sheets.touching(cam), np.zeros(1)
    if touching == "face":
        return cam.face()
    at = complex(cam.points(start)[0][0])
    if touching == "edge":
        return at + cam_sheets.edge_outline(cam) * complex(cam_sheets.away(cam, start)[0])
    return at + cam.roller_radius * np.exp(1j * np.linspace(0.0, _TURN, 361))


def is_cut(cam: DiscCam) -> bool:
    """Whether the roller cuts into the profile somewhere, or the profile under a face is undercut."""
    return bool(cam.min_curvature_radius.value <= cam.roller_radius)


def _dimensions(axes: Axes, cam: DiscCam, axis: complex, scale: float, shaft: float) -> list[complex]:
    """Radii to the extreme points of the profile and the roller's diameter; bore and keyway.

    Returns
        taken : directions from the axis in which something stands
    """
    profile = cam.points(np.linspace(0.0, _TURN, 7201))[1]
    size = np.abs(profile)
    ends = [(int(size.argmin()), cam.min_radius)] + [(int(size.argmax()), cam.max_radius)] * (not is_cut(cam))
    for k, radius in ends:
        way = complex(profile[k]) / float(size[k])
        paper.arrow(axes, axis, axis + scale * radius * way)
        paper.value(axes, axis + 0.66 * scale * radius * way, f"R{radius:.3f}", ha="center")
    roller = complex(cam.points(np.zeros(1))[0][0])
    if cam.roller_radius:
        paper.value(axes, axis + scale * roller, f"⌀{2.0 * cam.roller_radius:g}", ha="center")
    taken = [way / abs(way) for way in [complex(profile[k]) for k, _ in ends] + [roller]]
    return [*taken, _bore_note(axes, cam, axis, scale, shaft, taken)] if shaft > 0.0 else taken


_AROUND = _TURN * (np.arange(24) + 0.5) / 24
"""Directions that are tried for words and for the arrow of the sense of rotation."""
_LETTER, _LINE = 1.36, 3.4
"""Width of a letter in the mean, height of a line [mm of paper]."""


def _bore_note(axes: Axes, cam: DiscCam, axis: complex, scale: float, shaft: float, taken: list[complex]) -> complex:
    """Size of bore and keyway: in the cam where its outlines leave room for the words, else beside it.

    Of several directions that which is the farthest from those of other dimensions, of which the last is the keyway's,
    is given back.
    """
    words = cam_sheets.bore_words(2.0 * shaft)
    rows = words.split("\n")
    half = 0.5 * complex(_LETTER * max(map(len, rows)), _LINE * len(rows))
    outlines = *cam.points(np.linspace(0.0, _TURN, 1441)), cam_sheets.bore(shaft, taken[-1])
    drawn = axis + scale * np.concatenate(outlines)
    places: list[tuple[bool, bool, float, complex]] = []
    for way in np.exp(1j * _AROUND).tolist():
        seen = (drawn - axis) * way.conjugate()
        far = float(np.abs(seen[np.abs(np.angle(seen)) < 0.3]).max()) + 6.0
        for outside, radius in ((False, 0.8 * scale * cam.min_radius), (True, far)):
            foot = axis + radius * way
            middle = foot + 1j * math.copysign(half.imag, way.imag)
            beside = np.abs((drawn - middle).real) > half.real
            clear = bool(np.all(beside | (np.abs((drawn - middle).imag) > half.imag)))
            places.append((clear, not outside, min(abs(way - each) for each in taken), foot))
    foot = max(places, key=lambda each: each[:3])[3]
    way = (foot - axis) / abs(foot - axis)
    paper.line(axes, [axis + scale * shaft * way, foot], 0.18)
    paper.value(axes, foot, words, ha="center", va="top" if way.imag < 0.0 else "bottom")
    return complex(way)


class _Words(NamedTuple):
    """What notes say of a follower: its name, what stands at the start mark, how the profile comes about."""

    follower: str
    mark: str
    made: str
    curve: str = "profile"
    radius: str = "profile"


_WORDS = {
    "roller": _Words("Roller ⌀{:g} mm", "roller", "the envelope of the roller", "pitch curve", "centre of the roller"),
    "face": _Words("Flat-faced follower", "contact", "the envelope of the face"),
    "edge": _Words("Knife-edge follower", "edge", "the path of the edge"),
}


def notes(design: Any, cam: DiscCam) -> list[str]:
    """What the outline does not say: sense of rotation, follower, what of the file is a tolerance."""
    sized = [str(line) for line in _tolerances(design)]
    words = _WORDS[cam_sheets.touching(cam)]
    wall = cam_sheets.outer_wall(design)
    made = f"the profile is {words.made}"
    if getattr(design.spec, "arcs", None) is not None:
        made = f"the profile is made of arcs: {_arcs(design.contour)}"
    if wall is not None:
        radii = f"R{wall.min_radius:.3f} to {wall.max_radius:.3f}"
        made = f"groove between two envelopes of the roller, the outer wall {radii}"
    return [
        f"Cam turns {'counter-' if cam.sense > 0 else ''}clockwise. {words.follower.format(2.0 * cam.roller_radius)}. "
        f"Start mark (red): {words.mark} at cam angle 0.",
        f"Smallest convex radius of the {words.curve} {_number(cam.min_curvature_radius.value)} mm; "
        f"{made}{', undercut' if is_cut(cam) else ''}.",
        _toleranced(sized, [*_errors(design)]),
        f"Table: radius of the {words.radius} [mm] over the angle on the cam [deg], counter-clockwise from the mark.",
    ]  # fmt: skip


def _arcs(contour: Contour) -> str:
    """The arcs of a profile that the file gives by them."""
    if contour.flank is None:
        return f"R{contour.nose:g}, its centre {contour.distance:.4f} mm from the axis"
    flank = "straight flanks" if math.isinf(contour.flank) else f"flanks R{contour.flank:.4f}"
    nose = f"nose R{contour.nose:.4f}, its centre {contour.distance:.4f} mm from the axis"
    outer = f"R{contour.distance + contour.nose:.4f} over {math.degrees(contour.dwell):g} deg, "
    action = f"{outer if contour.dwell else ''}action {math.degrees(contour.whole):.4f} deg"
    return f"base circle R{contour.base:g}, {flank}, {nose}, {action}"


def _toleranced(sized: Sequence[str], errors: Sequence[str]) -> str:
    """What the file limits, and which key would say what it does not."""
    if not (sized or errors):
        return "No tolerance in the file (errors.profile, tolerance.sources): profile and roughness as agreed."
    given = [f"{name}: " + "; ".join(words) for name, words in (("Tolerances", sized), ("Errors", errors)) if words]
    missing = "" if sized else " Sizes without limits (tolerance.sources): as agreed."
    return f"{'. '.join(given)}.{missing} Roughness as agreed."


def _errors(design: Any) -> Iterator[str]:
    """What the section `errors` allows of the cam as manufactured."""
    section = getattr(design.spec, "errors", None)
    allowed = (("profile", "profile ±{:g} mm"), ("run_out", "run-out {:g} mm"), ("key", "key ±{:g} deg"),
               ("roller_radius", "roller radius ±{:g} mm"))  # fmt: skip
    yield from (words.format(value) for key, words in allowed if (value := getattr(section, key, 0.0)))


def _number(value: float) -> str:
    return f"{value:.5g}" if math.isfinite(value) else "infinite"


def limits_of(design: Any) -> str:
    """The limits of all sizes in the file's section `tolerance`."""
    found = "; ".join(_tolerances(design, ("",)))
    return f"Tolerances: {found}. Roughness as agreed." if found else (
        "No tolerance in the file (tolerance.sources): sizes, profile and roughness as agreed.")  # fmt: skip


def _tolerances(design: Any, parts: Sequence[str] = ("cam", "roller")) -> Iterator[str]:
    """Limits of sizes in the file's section `tolerance`, those of cam and follower."""
    section = getattr(design.spec, "tolerance", None)
    for key, source in (getattr(section, "sources", None) or {}).items():
        limits = getattr(source, "limits", None)
        if limits is not None and any(part in key for part in parts):
            words = f"±{limits:g}" if isinstance(limits, float) else " / ".join(f"{each:+g}" for each in limits)
            yield f"{key} {words}"
