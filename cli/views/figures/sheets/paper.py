"""Paper of drawings for the workshop: frame, title block, notes and tables about a view at a standard scale.

Lengths on the paper are in mm from its lower left corner.
"""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import style
from gearlink.core.version import VERSION

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SCALES = (50.0, 20.0, 10.0, 5.0, 2.0, 1.0, 0.5, 0.2, 0.1, 0.05, 0.02, 0.01, 0.005, 0.002, 0.001)
"""Of ISO 5455, and so much of the part on the paper."""
_FACE: dict[str, Any] = {"color": style.BLACK, "solid_capstyle": "butt"}
_FRAME_EDGE, _MARGIN = 10.0, 20.0
"""Of the frame from the edges of the paper, on the left for filing [mm]; ISO 5457."""
PAST = 4.0
"""From what is drawn to the ends of the centre lines [mm]."""
SMALL, TEXT = 5.2, 7.0


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

    def is_within(self, room: Box) -> bool:
        """Whether it lies in another."""
        return room.left <= self.left and self.right <= room.right and room.low <= self.low and self.high <= room.high

    def meets(self, other: Box) -> bool:
        """Whether it shares something with another."""
        across = self.left < other.right and other.left < self.right
        return across and self.low < other.high and other.low < self.high


@dataclass(frozen=True)
class Page:
    """A sheet of paper with its parts.

    columns : of a table of a radius at each degree
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


def fitted(size: complex, beside: complex = 0.0, pages: Sequence[Page] = PAGES) -> tuple[Page, float]:
    """The paper, and the largest standard scale at which a part fits on it: A3 where A4 needs less than 1:1.

    Parameters
        size : complex [mm] - width and height of the part
        beside : complex [mm] - room of the paper that something else takes in width and height
    Raises
        ValueError - of a part that no scale brings on the paper
    """
    found = []
    for page in pages:
        wide = page.view.right - page.view.left - 16.0 - beside.real
        tall = page.view.high - page.view.low - 12.0 - beside.imag
        scales = [s for s in SCALES if s * size.real <= wide and s * size.imag <= tall]
        if scales:
            found.append((page, scales[0]))
    if not found:
        raise ValueError("no standard scale is small enough")
    small, *large = found
    return large[0] if large and small[1] < min(1.0, large[0][1]) else small


def ratio(scale: float) -> str:
    """A scale as a title block has it.

    Example
        >>> ratio(2.0), ratio(0.5)
        ('2:1', '1:2')
    """
    return f"{scale:g}:1" if scale >= 1.0 else f"1:{1.0 / scale:g}"


def sheet(page: Page) -> tuple[Figure, Any]:
    """A figure in the size of the paper with its frame; its axes are the paper."""
    from matplotlib.figure import Figure

    made = Figure(figsize=(page.width / 25.4, page.height / 25.4), facecolor="white")
    axes: Any = made.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set_axis_off()
    axes.set_xlim(0.0, page.width)
    axes.set_ylim(0.0, page.height)
    frame(axes, Box(_MARGIN, _FRAME_EDGE, page.width - _FRAME_EDGE, page.height - _FRAME_EDGE), 0.7)
    view = page.view
    vars(made)["view"] = (view.left / page.width, view.low / page.height,
                          view.right / page.width, view.high / page.height)  # fmt: skip
    return made, axes


def line(axes: Axes, points: Any, width: float, **look: Any) -> None:
    """A line through points of the paper, so many mm wide."""
    z = np.asarray(points, dtype=complex)
    axes.plot(z.real, z.imag, **{**_FACE, "linewidth": width * 72.0 / 25.4, **look})


def frame(axes: Axes, box: Box, width: float) -> None:
    """The four sides of a box."""
    corners = [complex(box.left, box.low), complex(box.right, box.low), complex(box.right, box.high),
               complex(box.left, box.high), complex(box.left, box.low)]  # fmt: skip
    line(axes, corners, width)


def text(axes: Axes, at: complex, words: str, size: float = TEXT, **look: Any) -> None:
    """Words at a place of the paper, in front of lines."""
    axes.text(at.real, at.imag, words.replace("$", r"\$"), fontsize=size, **{"va": "center", "zorder": 8, **look})


def value(axes: Axes, at: complex, words: str, **look: Any) -> None:
    """A size or a label: lines are interrupted behind it, so that a decimal point does not read as a colon."""
    text(axes, at, words, **{"bbox": {"facecolor": "white", "edgecolor": "none", "pad": 0.9}, **look})


def centre_lines(axes: Axes, axis: complex, scale: float, low: complex, high: complex) -> None:
    """Thin chains through the axis of a part, past the corners of what is drawn of it [mm of the part]."""
    for turn, ends in ((1.0, (low.real, high.real)), (1j, (low.imag, high.imag))):
        centre = axis + turn * (scale * np.array(ends) + PAST * np.array([-1.0, 1.0]))
        line(axes, centre, 0.18, linestyle=style.CHAIN, gid="axis")


def arrow(axes: Axes, start: complex, end: complex, style_: str = "-|>") -> None:
    """A thin arrow, of a dimension or a sense of turning."""
    shape = {"arrowstyle": style_, "color": style.BLACK, "linewidth": 0.7, "shrinkA": 0, "shrinkB": 0,
             "mutation_scale": 8}  # fmt: skip
    axes.annotate("", (end.real, end.imag), (start.real, start.imag), arrowprops=shape, zorder=6)


def notes(axes: Axes, page: Page, lines: Iterable[str]) -> None:
    """Remarks, one below the other, long ones in several lines."""
    wide, box = int((page.notes.right - page.notes.left) / 1.3), page.notes
    rows = [row for words in lines for row in wrap(words, wide)]
    step = min(4.2, (box.high - box.low - 2.0) / len(rows))
    size = min(6.2, 0.85 * step * 72.0 / 25.4)
    for row, words in enumerate(rows):
        text(axes, complex(box.left + 2.0, box.high - 0.75 * step - step * row), words, size)


def columns(axes: Axes, page: Page, heads: Sequence[str], rows: Sequence[Sequence[str]], count: int) -> None:
    """A table of numbers that runs on in so many columns, the first number of a row narrower than the others."""
    tall = -(-len(rows) // count)
    wide = (page.table.right - page.table.left) / count
    step = (page.table.high - page.table.low) / (max(tall, 30) + 1.5)
    ends = np.linspace(0.36, 0.94, len(heads)) if len(heads) == 2 else np.linspace(0.2, 0.96, len(heads))
    for column in range(count):
        left = page.table.left + column * wide
        for head, end in zip(heads, ends.tolist(), strict=True):
            text(axes, complex(left + (end - 0.01) * wide, page.table.high - 0.7 * step), head, SMALL, ha="right")
        for row, cells in enumerate(rows[column * tall : (column + 1) * tall]):
            y = page.table.high - step * (row + 1.7)
            for words, end in zip(cells, ends.tolist(), strict=True):
                text(axes, complex(left + end * wide, y), words, SMALL, ha="right")
        line(axes, [complex(left, page.table.low), complex(left, page.table.high)], 0.13)
    frame(axes, page.table, 0.25)


def block(axes: Axes, page: Page, title: str, document: str, scale: float, number: str, material: str = "") -> None:
    """The title block, with the fields of ISO 7200; what the file does not know is left to be filled in."""
    box = page.block
    rows = (
        (("Title", title, 0.62), ("Scale", ratio(scale), 0.19), ("Format", page.name, 0.19)),
        (("Document", document, 0.38), ("Number", "", 0.24), ("Sheet", number, 0.19), ("Rev.", "", 0.19)),
        (("Material", material, 0.38), ("Drawn", f"gearlink {VERSION}", 0.24),
         ("Approved", "", 0.19), ("Date", "", 0.19)),
    )  # fmt: skip
    tall, wide = (box.high - box.low) / len(rows), box.right - box.left
    frame(axes, box, 0.7)
    for k, row in enumerate(rows):
        high, left = box.high - k * tall, box.left
        if k:
            line(axes, [complex(box.left, high), complex(box.right, high)], 0.25)
        for name, words, share in row:
            if left > box.left:
                line(axes, [complex(left, high), complex(left, high - tall)], 0.25)
            text(axes, complex(left + 1.2, high - 2.2), name, 4.8, color=style.GREY)
            size = 9.5 if name == "Title" else 8.0
            room = (share * wide - 3.0) * 72.0 / 25.4 / (0.56 * max(len(words), 1))
            text(axes, complex(left + 2.0, high - 0.62 * tall), words, min(size, room))
            left += share * wide
