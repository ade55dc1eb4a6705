"""Cams drawn true to size, to be laid on the workpiece: outline, roller path, axes, and a bar that checks the print."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

from gearlink.cli.reading.diagnostics import DesignFileError, Diagnostic
from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.figures.sheets.cam_sheets import discs

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    reach = cam.max_radius + 5.0 * scale.reduction
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
    axes.plot(pitch.real, pitch.imag, color=style.GREY, linewidth=0.35, linestyle=style.DASHED, gid="pitch curve")
    for curve in axes.lines:
        curve.get_path().should_simplify = False  # which would leave out points within a tenth of a point
    for way in (1.0, 1j):
        line = np.array([-reach, reach]) * way
        axes.plot(line.real, line.imag, color=style.GREY, linewidth=0.35, linestyle="-.")
    shaft = float(design.cams.section.shaft_radius) if hasattr(design.cams, "section") else 0.0
    if shaft > 0.0:
        bore = shaft * np.exp(1j * theta)
        axes.plot(bore.real, bore.imag, color=style.BLACK, linewidth=0.7)
    mark = np.array([0.9, 1.0]) * profile[0]
    axes.plot(mark.real, mark.imag, color=style.RED, linewidth=1.0)
    start = complex(middle.real - 0.5 * _BAR * scale.reduction, low.imag - 7.0 * scale.reduction)
    ends = [start.real, start.real + _BAR * scale.reduction]
    axes.plot(ends, [start.imag] * 2, color=style.BLACK, linewidth=1.0, gid="bar")
    words = "this bar is 100 mm long on paper; start mark: roller here at cam angle 0"
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
    remedy = f"take {fits[0]}" if fits else "reduce the scale: not even A0 holds it"
    text = f"at {scale.words} the drawing takes {width:.0f} x {height:.0f} mm with its margin, more than {scale.paper}"
    raise DesignFileError([Diagnostic("GL115", f"{text}: {remedy}", "<command line>", key="--paper")])
