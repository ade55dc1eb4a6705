"""Strokes for pictures that are drawn large and reduced: Pillow's, with whole bars, discs and dashes."""

from __future__ import annotations

from importlib.util import find_spec
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import ImageFont

from gearlink.cli.views.scenes.scene import Points

if TYPE_CHECKING:
    from PIL.ImageDraw import ImageDraw

FINER = 2
"""The large picture has so many pixels for one of the reduced."""


def flat(points: Points) -> list[float]:
    """x, y, x, y ... as Pillow takes them."""
    flat: list[float] = np.column_stack([points.real, points.imag]).ravel().tolist()
    return flat


def bar(draw: ImageDraw, start: complex, end: complex, width: float, color: str) -> None:
    """A straight bar; Pillow's own wide lines round their corners to whole pixels and seem to bend."""
    if start == end:
        return
    side = 0.5j * width * (end - start) / abs(end - start)
    draw.polygon(flat(np.array([start + side, end + side, end - side, start - side])), fill=color)


def arrow(draw: ImageDraw, start: complex, end: complex, width: float, color: str) -> None:
    """An arrow from point to point, its head shorter where the arrow is short."""
    if start == end:
        return
    way = (end - start) / abs(end - start)
    head = min(5.0 * width, 0.6 * abs(end - start))
    bar(draw, start, end - 0.8 * head * way, width, color)
    corners = end + head * way * np.array([0.0, -1.0 + 0.36j, -1.0 - 0.36j])
    draw.polygon(flat(corners), fill=color)


def disc(draw: ImageDraw, at: complex, radius: float, fill: str, edge: str, width: int) -> None:
    """A disc with an edge."""
    box = [at.real - radius, at.imag - radius, at.real + radius, at.imag + radius]
    draw.ellipse(box, fill=fill, outline=edge, width=width)


def dashes(points: Points, length: float) -> list[Points]:
    """The dashes of a polyline, each as long as the gap behind it."""
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    edges = np.arange(0.0, along[-1], length)
    made = []
    for start in edges[::2]:
        at = np.linspace(start, min(start + length, along[-1]), 5)
        made.append(np.interp(at, along, points.real) + 1j * np.interp(at, along, points.imag))
    return made


def thinned(points: Points, tolerance: float) -> Points:
    """The points of a polyline that keep it within so much of what it was (Douglas and Peucker).

    Example
        >>> thinned(np.array([0, 1 + 0.01j, 2, 2 + 1j]), 0.1).tolist()
        [0j, (2+0j), (2+1j)]
    """
    kept = np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    open_ends = [(0, len(points) - 1)]
    while open_ends:
        first, last = open_ends.pop()
        if last - first < 2:
            continue
        chord, beside = points[last] - points[first], points[first + 1 : last] - points[first]
        # A closed line has no chord between its ends: the farthest point splits it.
        off = np.abs((beside * np.conj(chord)).imag) / abs(chord) if chord else np.abs(beside)
        worst = int(off.argmax())
        if off[worst] > tolerance:
            middle = first + 1 + worst
            kept[middle] = True
            open_ends += [(first, middle), (middle, last)]
    return points[kept]


def font_file(name: str) -> str:
    """A font that has the letters of a name, where one is installed; else the one that comes with matplotlib."""
    from gearlink.cli.views.figures.write import families

    *_, last = families(name)
    if last != "sans-serif":
        from matplotlib.font_manager import findfont

        return str(findfont(last))
    found = find_spec("matplotlib")  # where it is; to import it for that takes longer than ten pictures
    assert found is not None, "this program needs it"
    assert found.origin is not None, "it is a package with files"
    return str(Path(found.origin).parent / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf")


def font(size: float, name: str = "") -> Any:
    """A font of so many pixels, with the letters of a name."""
    return ImageFont.truetype(font_file(name), max(8, round(size)))
