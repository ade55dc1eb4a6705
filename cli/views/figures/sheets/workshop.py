"""Drawing of a disc cam for the workshop: A4 or A3 with frame and title block, at a standard scale, with its radii.

Lengths on the paper in mm from its lower left corner.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.sheets import cam_sheets
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.core.parts.cams.disc_cam import DiscCam

SCALES = (10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
"""Of ISO 5455, and so much of the cam on the paper."""
_TURN = 2.0 * math.pi
_FACE: dict[str, Any] = {"color": style.BLACK, "solid_capstyle": "butt"}
_EDGE, _MARGIN = 10.0, 20.0
"""Of the frame from the edges of the paper, on the left for filing [mm]; ISO 5457."""
_PAST = 4.0
"""From what is drawn to the ends of the centre lines [mm]."""
_SMALL, _TEXT = 5.2, 7.0


@dataclass(frozen=True)
class Box:
    """A rectangle of the paper [mm]."""

    left: float
    low: float
    right: float
    high: float

    @property
    def middle(self) -> complex:
        """Its centre."""
        return complex(0.5 * (self.left + self.right), 0.5 * (self.low + self.high))


@dataclass(frozen=True)
class Page:
    """A sheet of paper with its parts.

    columns : of the table of radii
    """

    name: str
    width: float
    height: float
    view: Box
    table: Box
    block: Box
    notes: Box
    columns: int


PAGES = (
    Page("A4", 210.0, 297.0, Box(20.0, 162.0, 200.0, 287.0), Box(20.0, 48.0, 200.0, 142.0),
         Box(20.0, 10.0, 200.0, 46.0), Box(20.0, 143.0, 200.0, 161.0), 12),
    Page("A3", 420.0, 297.0, Box(20.0, 34.0, 258.0, 287.0), Box(262.0, 50.0, 410.0, 287.0),
         Box(230.0, 10.0, 410.0, 46.0), Box(20.0, 12.0, 228.0, 32.0), 6),
)  # fmt: skip


def drawing(design: Any, index: int) -> Figure:
    """One cam: outline, roller and axes, bore and keyway, start mark, radii of each degree, title block."""
    from matplotlib.figure import Figure

    cams = cam_sheets.discs(design)
    cam = cams[index]
    page, scale = fitted(cam)
    made = Figure(figsize=(page.width / 25.4, page.height / 25.4), facecolor="white")
    axes: Any = made.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, page.width)
    axes.set_ylim(0.0, page.height)
    _frame(axes, Box(_MARGIN, _EDGE, page.width - _EDGE, page.height - _EDGE), 0.7)
    _view(axes, page, cam, scale, shaft_of(design))
    _notes(axes, page, design, cam)
    _radii(axes, page, cam)
    _block(axes, page, design, cam, scale, f"{index + 1} / {len(cams)}")
    return made


def shaft_of(design: Any) -> float:
    """Radius of the shaft [mm]; 0 where the file does not name it."""
    section = getattr(getattr(design, "cams", None), "section", None) or getattr(design.spec, "cam", None)
    return float(getattr(section, "shaft_radius", None) or 0.0)


def fitted(cam: DiscCam) -> tuple[Page, float]:
    """The paper, and the largest standard scale at which cam and roller fit on it: A3 where A4 needs less than 1:1.

    Raises
        ValueError - of a cam that no scale brings on the paper
    """
    low, high = _reach(cam)
    found = []
    for page in PAGES:
        wide, tall = page.view.right - page.view.left - 16.0, page.view.high - page.view.low - 12.0
        scales = [s for s in SCALES if s * (high - low).real <= wide and s * (high - low).imag <= tall]
        if scales:
            found.append((page, scales[0]))
    if not found:
        raise ValueError("no standard scale is small enough")
    small, *large = found
    return large[0] if large and small[1] < min(1.0, large[0][1]) else small


def _reach(cam: DiscCam) -> tuple[complex, complex]:
    """Lower left and upper right corner of what is drawn [mm]."""
    pitch, profile = cam.points(np.linspace(0.0, _TURN, 721))
    roller, radius = complex(pitch[0]), cam.roller_radius
    every = np.concatenate([pitch, profile, roller + radius * np.array([1, -1, 1j, -1j])])
    return complex(every.real.min(), every.imag.min()), complex(every.real.max(), every.imag.max())


def _line(axes: Axes, points: Any, width: float, **look: Any) -> None:
    """A line through points of the paper, so many mm wide."""
    z = np.asarray(points, dtype=complex)
    axes.plot(z.real, z.imag, **{**_FACE, "linewidth": width * 72.0 / 25.4, **look})


def _frame(axes: Axes, box: Box, width: float) -> None:
    corners = [complex(box.left, box.low), complex(box.right, box.low), complex(box.right, box.high),
               complex(box.left, box.high), complex(box.left, box.low)]  # fmt: skip
    _line(axes, corners, width)


def _text(axes: Axes, at: complex, words: str, size: float = _TEXT, **look: Any) -> None:
    axes.text(at.real, at.imag, words.replace("$", r"\$"), fontsize=size, **{"va": "center", **look})


def _view(axes: Axes, page: Page, cam: DiscCam, scale: float, shaft: float) -> None:
    """The cam at cam angle 0 about its axis, visible edges wide, pitch curve and centre lines thin chains."""
    low, high = _reach(cam)
    axis = page.view.middle - scale * 0.5 * (low + high)
    theta = np.linspace(0.0, _TURN, 7201)
    pitch, profile = cam.points(theta)
    _line(axes, axis + scale * profile, 0.5, gid="profile")
    _line(axes, axis + scale * pitch, 0.25, linestyle=style.CHAIN, gid="pitch curve")
    roller = complex(pitch[0])
    _line(axes, axis + scale * (roller + cam.roller_radius * np.exp(1j * theta[::20])), 0.25, linestyle=style.DASHED)
    for way, ends in ((1.0, np.array([low.real, high.real])), (1j, np.array([low.imag, high.imag]))):
        _line(
            axes, axis + way * (scale * ends + _PAST * np.array([-1.0, 1.0])), 0.18, linestyle=style.CHAIN, gid="axis"
        )
    _line(axes, axis + scale * np.array([0.0, 1.05 * roller]), 0.18, linestyle=style.CHAIN)
    way = roller / abs(roller)
    edge = float(np.abs(profile[int(np.argmin(np.abs(np.angle(profile / way))))]))
    _line(axes, axis + scale * edge * np.array([0.9, 1.0]) * way, 0.9, color=style.WRONG, gid="start mark")
    if shaft > 0.0:
        _line(axes, axis + scale * cam_sheets.bore(shaft, way), 0.5, gid="bore")
    _dimensions(axes, cam, axis, scale, shaft)
    turning = axis + scale * 0.5 * (cam.min_radius + shaft) * np.exp(1j * cam.sense * np.linspace(1.9, 2.5, 30))
    _line(axes, turning, 0.25)
    _arrow(axes, complex(turning[-2]), complex(turning[-1]))


def _arrow(axes: Axes, start: complex, end: complex) -> None:
    shape = {"arrowstyle": "-|>", "color": style.BLACK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0,
             "mutation_scale": 8}  # fmt: skip
    axes.annotate("", (end.real, end.imag), (start.real, start.imag), arrowprops=shape, zorder=6)


def is_cut(cam: DiscCam) -> bool:
    """Whether the roller cuts into the profile somewhere."""
    return bool(cam.min_curvature_radius.value <= cam.roller_radius)


def _dimensions(axes: Axes, cam: DiscCam, axis: complex, scale: float, shaft: float) -> None:
    """Radii to the extreme points of the profile and the roller's diameter; bore and keyway."""
    theta = np.linspace(0.0, _TURN, 7201)
    _, profile = cam.points(theta)
    size = np.abs(profile)
    ends = [(int(size.argmin()), cam.min_radius)] + [(int(size.argmax()), cam.max_radius)] * (not is_cut(cam))
    for k, radius in ends:
        way = complex(profile[k]) / float(size[k])
        end = axis + scale * radius * way
        _arrow(axes, axis, end)
        at = axis + 0.66 * scale * radius * way
        _text(axes, at, f"R{radius:.3f}", ha="center", path_effects=style.outlined())
    roller = complex(cam.points(np.zeros(1))[0][0])
    at = axis + scale * roller
    _text(axes, at, f"⌀{2.0 * cam.roller_radius:g}", ha="center", path_effects=style.outlined())
    if shaft > 0.0:
        slot = cam_sheets.keyway(2.0 * shaft)
        key = f"\nkeyway {slot[0]:g} P9, {2.0 * shaft + slot[1]:g} over bore" if slot else ""
        words = f"⌀{2.0 * shaft:g} H7{key}"
        taken = [complex(profile[k]) for k, _ in ends] + [roller]
        ways = np.exp(1j * _TURN * (np.arange(24) + 0.5) / 24)
        free = [min(abs(complex(way) - each / abs(each)) for each in taken) for way in ways.tolist()]
        way = complex(ways[int(np.argmax(free))])
        foot = axis + scale * 0.8 * cam.min_radius * way
        _line(axes, [axis + scale * shaft * way, foot], 0.18)
        _text(axes, foot, words, ha="center", va="top" if way.imag < 0.0 else "bottom", path_effects=style.outlined())


def notes(design: Any, cam: DiscCam) -> list[str]:
    """What the outline does not say: sense of rotation, roller, what of the file is a tolerance."""
    sized = [str(line) for line in _tolerances(design)]
    return [
        f"Cam turns {'counter-' if cam.sense > 0 else ''}clockwise. Roller ⌀{2.0 * cam.roller_radius:g} mm. "
        "Start mark (red): roller at cam angle 0.",
        f"Smallest convex radius of the pitch curve {_number(cam.min_curvature_radius.value)} mm; the profile is the "
        f"envelope of the roller{', undercut' if is_cut(cam) else ''}.",
        "Tolerances of the file: " + "; ".join(sized) if sized else
        "The file has no tolerances of the cam: profile tolerance and roughness as agreed.",
        "Table: radius of the roller's centre [mm] over the angle on the cam [deg], counter-clockwise from the mark.",
    ]  # fmt: skip


def _number(value: float) -> str:
    return f"{value:.5g}" if math.isfinite(value) else "infinite"


def _tolerances(design: Any) -> Iterator[str]:
    """Limits of the sizes of cam and follower in the file's section `tolerance`."""
    section = getattr(design.spec, "tolerance", None)
    for key, source in (getattr(section, "sources", None) or {}).items():
        limits = getattr(source, "limits", None)
        if limits is not None and ("cam" in key or "roller" in key):
            words = f"±{limits:g}" if isinstance(limits, float) else " / ".join(f"{each:+g}" for each in limits)
            yield f"{key} {words}"


def _notes(axes: Axes, page: Page, design: Any, cam: DiscCam) -> None:
    for row, words in enumerate(notes(design, cam)):
        _text(axes, complex(page.notes.left + 2.0, page.notes.high - 3.0 - 4.2 * row), words, 6.2)


def _radii(axes: Axes, page: Page, cam: DiscCam) -> None:
    """The table of radii, a row for each degree of a column."""
    rows = 360 // page.columns
    wide = (page.table.right - page.table.left) / page.columns
    step = (page.table.high - page.table.low) / (rows + 1.5)
    radii = [f"{value:.3f}" for value in cam_sheets.pitch_radii(cam).tolist()]
    for column in range(page.columns):
        left = page.table.left + column * wide
        _text(axes, complex(left + 0.25 * wide, page.table.high - 0.7 * step), "°", _SMALL, ha="center")
        _text(axes, complex(left + 0.72 * wide, page.table.high - 0.7 * step), "R", _SMALL, ha="center")
        for row in range(rows):
            degree, y = column * rows + row, page.table.high - step * (row + 1.7)
            _text(axes, complex(left + 0.36 * wide, y), f"{degree}", _SMALL, ha="right")
            _text(axes, complex(left + 0.94 * wide, y), radii[degree], _SMALL, ha="right")
        _line(axes, [complex(left, page.table.low), complex(left, page.table.high)], 0.13)
    _frame(axes, page.table, 0.25)


def _block(axes: Axes, page: Page, design: Any, cam: DiscCam, scale: float, sheet: str) -> None:
    """The title block, with the fields of ISO 7200; what the file does not know is left to be filled in."""
    box = page.block
    ratio = f"{scale:g}:1" if scale >= 1.0 else f"1:{1.0 / scale:g}"
    material = getattr(getattr(design.spec, "loads", None), "material", None)
    made_of = "" if material is None else f"E {material.modulus:g} N/mm²"
    rows = (
        (("Title", f"{design.spec.name}: {cam.name}", 0.62), ("Scale", ratio, 0.19), ("Format", page.name, 0.19)),
        (("Document", "cam, workshop drawing", 0.38), ("Number", "", 0.24), ("Sheet", sheet, 0.19), ("Rev.", "", 0.19)),
        (("Material", made_of, 0.38), ("Drawn", f"gearlink {VERSION}", 0.24),
         ("Approved", "", 0.19), ("Date", "", 0.19)),
    )  # fmt: skip
    tall, wide = (box.high - box.low) / len(rows), box.right - box.left
    _frame(axes, box, 0.7)
    for k, row in enumerate(rows):
        high, left = box.high - k * tall, box.left
        if k:
            _line(axes, [complex(box.left, high), complex(box.right, high)], 0.25)
        for name, words, share in row:
            if left > box.left:
                _line(axes, [complex(left, high), complex(left, high - tall)], 0.25)
            _text(axes, complex(left + 1.2, high - 2.2), name, 4.8, color=style.GREY)
            _text(axes, complex(left + 2.0, high - 0.62 * tall), words, 9.5 if name == "Title" else 8.0)
            left += share * wide
