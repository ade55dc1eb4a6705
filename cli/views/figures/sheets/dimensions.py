"""Dimensions on a drawing of a part: radii, diameters with a leader, widths in rows beside the view.

What lies alike at several places about the axis is shown at the clearest of them.
"""

from __future__ import annotations

import cmath
import math
from collections.abc import Iterator, Sequence
from itertools import groupby
from typing import TYPE_CHECKING, NamedTuple, TypeVar

import numpy as np

from gearlink.cli.export.contour import Circle, Contour, Dimension, Part
from gearlink.cli.export.sizes import size
from gearlink.cli.views.figures.sheets import cam_sheets, paper
from gearlink.core.numerics.extremes import extremes_over

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.cli.export.sampling import Stretch
    from gearlink.core.numerics.arrays import Reals

_LETTER, _SHORT = 1.6, 5.0
"""Width of a letter, and length of a line that has no room for its arrows [mm of paper]."""
_ROW = 9.0
"""From the view to the first row of dimensions, and from row to row [mm of paper]."""
_OFF, _NEAR = 6.0, 8.0
"""Ends of leaders from the outline, and from a circle within it [mm of paper]."""
_WAYS = 24
_TURN = 2.0 * math.pi
_T = TypeVar("_T")
_DIAGONALS = (0.8, -0.8, math.pi - 0.8, math.pi + 0.8)
"""Directions of the leader of a circle beside the axis, from its own [rad]."""


class View(NamedTuple):
    """A view of a part on the paper.

    Fields
        room : Box - within which words beside it stand
        axis : complex [mm of paper]
        low, high : complex [mm] - corners of what is drawn, about the axis
        start : complex or None [mm] - place of the start mark
    """

    axes: Axes
    room: paper.Box
    shape: Contour
    axis: complex
    low: complex
    high: complex
    scale: float
    start: complex | None = None

    @property
    def keyway(self) -> complex:
        """Direction of the keyway: that of the start mark, of a crank without one away from its pin."""
        return -1.0 + 0j if self.start is None else self.start / abs(self.start)

    def at(self, place: complex) -> complex:
        """A place of the part on the paper."""
        return self.axis + self.scale * place


def of_rows(part: Part) -> complex:
    """Room that rows of dimensions take beside the view and below it [mm of paper]."""
    rows = [each for each in part.dimensions if each.row]
    lying = [_ROW * each.row for each in rows if not _is_upright(each)]
    upright = [_ROW * each.row + _LETTER * len(each.words) for each in rows if _is_upright(each)]
    return complex(max(upright, default=0.0), max(lying, default=0.0))


def draw(view: View, shown: Sequence[Dimension]) -> None:
    """The dimensions of the part, and a diameter for all circles that are alike."""
    groups = [[*group] for _, group in groupby(view.shape.part.circles, lambda each: (each.layer, each.radius))]
    groups = [group for group in groups if _is_measured(group[0], view.shape.part)]
    holes = [cmath.phase(each.center) for group in groups for each in group if each.center]
    taken, words = [0.0, 0.5 * math.pi, math.pi, -0.5 * math.pi], list[paper.Box]()
    alike = [cmath.phase(view.keyway)] if any(group[0].layer == "SHAFT" for group in groups) else []
    for each in shown:
        words += _in_row(view, each) if each.row else ()
    for each in shown:
        if not each.row:
            places = [*_places(each)]
            free = _free(view, places, [_box_of(view, place) for place in places], words)
            best = free[_clearest([_way(place) for place in free], taken + holes)]
            taken.append(_way(best))
            alike += [_way(place) for place in places]
            words.append(_along(view, best))
    for group in groups:
        others = [cmath.phase(each.center) for other in groups if other is not group for each in other if each.center]
        way, box = _diameter(view, group, (taken + others, alike), words)
        taken.append(way)
        words.append(box)


def _places(each: Dimension) -> Iterator[Dimension]:
    """The same at each of its places about the axis."""
    for k in range(each.places):
        turn = cmath.rect(1.0, _TURN * k / each.places)
        yield each._replace(start=turn * each.start, end=turn * each.end)


def _way(each: Dimension) -> float:
    """Direction from the axis."""
    return cmath.phase(each.end or each.start)


def _free(view: View, places: Sequence[_T], boxes: Sequence[paper.Box], words: Sequence[paper.Box]) -> list[_T]:
    """Places whose words lie within the view and on no others; else those within the view, else all."""
    within = [box.is_within(view.room) for box in boxes]
    clear = [inside and not any(map(box.meets, words)) for inside, box in zip(within, boxes, strict=True)]
    for kept in (clear, within):
        if any(kept):
            return [place for place, keep in zip(places, kept, strict=True) if keep]
    return [*places]


def extremes(part: Part) -> tuple[Dimension, ...]:
    """Minimum and maximum radius of the profile."""
    found = []
    for stretch in part.stretches:
        if "PROFILE" not in stretch.layers:
            continue
        row = stretch.layers.index("PROFILE")

        def radius(parameter: Reals, stretch: Stretch = stretch, row: int = row) -> Reals:
            return np.asarray(np.abs(stretch.points(parameter)[row]))

        for each in extremes_over([(radius, False), (radius, True)], stretch.low, stretch.high, samples=256):
            found.append((each.value, complex(stretch.points(np.array([each.place]))[row, 0])))
    ends = (min(found, key=lambda each: each[0]), max(found, key=lambda each: each[0])) if found else ()
    return tuple(Dimension(f"R{value:.3f}", 0j, place) for value, place in ends)


def _is_measured(circle: Circle, part: Part) -> bool:
    """Edges of the part; the tips of a gear with two views stand beside the second."""
    beside = ("TIP_CIRCLE",) if part.width else ()
    return circle.layer not in ("REFERENCE_CIRCLE", "BASE_CIRCLE", "WORKING_CIRCLE", "ROOT_CIRCLE", *beside)


def _clearest(ways: Sequence[float], taken: Sequence[float], edges: Sequence[float] = ()) -> int:
    """Which of some directions is the farthest from all that are taken, and a third as far from edges of the part."""

    def room(k: int) -> tuple[float, float]:
        apart = [abs(math.remainder(ways[k] - other, _TURN)) for other in taken]
        beside = (3.0 * abs(math.remainder(ways[k] - other, _TURN)) for other in edges)
        return round(min(*apart, *beside), 6), sum(apart)

    return max(range(len(ways)), key=room)


def _is_upright(each: Dimension) -> bool:
    way = each.end - each.start
    return abs(way.imag) > abs(way.real)


def _text_of(view: View, each: Dimension) -> complex:
    """Middle of the words of a size that is shown where it lies; of a short one behind its centre."""
    start, end = view.at(each.start), view.at(each.end)
    long = _LETTER * len(each.words)
    if each.start and abs(end - start) < long + _SHORT:
        return start - (0.5 * long + 2.0) * (end - start) / abs(end - start)
    return start + (0.66 if each.end and not each.start else 0.5) * (end - start)


def _box_of(view: View, each: Dimension) -> paper.Box:
    return _box(_text_of(view, each), complex(_LETTER * len(each.words), 3.2))


def _along(view: View, each: Dimension) -> paper.Box:
    """An arrow where the size lies, two-headed between an axis and a centre; what its words take."""
    start, end = view.at(each.start), view.at(each.end)
    if each.start:
        for arm in (2.0, 2j):
            paper.line(view.axes, [start - arm, start + arm], 0.18)
    paper.arrow(view.axes, start, end, "-|>" if each.end else "<|-|>")
    paper.value(view.axes, _text_of(view, each), each.words, ha="center")
    return _box_of(view, each)


def _in_row(view: View, each: Dimension) -> tuple[paper.Box, paper.Box]:
    """A line below or beside the view, with lines from it to what it measures; what its words and the line take."""
    upright, far = _is_upright(each), _ROW * each.row
    ends = []
    for place in (each.start, each.end):
        at, corner = view.at(place), view.at(view.high if upright else view.low)
        end = complex(corner.real + far, at.imag) if upright else complex(at.real, corner.imag - far)
        paper.line(view.axes, [at, end + 1.5 * (end - at) / abs(end - at)], 0.13, gid="extension line")
        ends.append(end)
    between, long = ends[1] - ends[0], _LETTER * len(each.words)
    if abs(between) < _SHORT:
        for end, way in zip(ends, (-_SHORT, _SHORT), strict=True):
            paper.arrow(view.axes, end + way * between / abs(between), end)
    else:
        paper.arrow(view.axes, ends[0], ends[1], "<|-|>")
    middle = 0.5 * (ends[0] + ends[1]) + (1.5 + 0.5 * long if upright else 1.8j)
    paper.value(view.axes, middle, each.words, ha="center")
    line = complex(abs(between.real) + 2.0, abs(between.imag) + 2.0)
    return _box(middle, complex(long, 3.2)), _box(0.5 * (ends[0] + ends[1]), line)


def _words(view: View, group: Sequence[Circle]) -> str:
    """The diameter of circles that are alike, and that of the circle on which several lie."""
    circle, across = group[0], 2.0 * group[0].radius
    if circle.layer == "SHAFT" and not view.shape.has_bore(circle):
        return f"⌀{size(across)} shaft"
    if circle.layer == "SHAFT":
        return cam_sheets.bore_words(across)
    if circle.layer in ("RIM", "TIP_CIRCLE"):
        return f"⌀{across:.3f}"
    if len(group) == 1:
        return f"⌀{size(across)}"
    return f"{len(group)} × ⌀{size(across)} on ⌀{size(2.0 * abs(circle.center))}"


def _diameter(
    view: View, group: Sequence[Circle], taken: tuple[list[float], list[float]], others: Sequence[paper.Box]
) -> tuple[float, paper.Box]:
    """The diameter of one of the circles with an arrow to it: the direction of that, and what the words take."""
    words, every = _words(view, group), [*_leaders(view, group)]
    free = _free(view, every, [each.box for each in every], others)
    free = [each for each in free if each.outside] or free
    best = free[_clearest([each.way for each in free], *taken)]
    unit = cmath.rect(1.0, best.way)
    paper.arrow(view.axes, best.foot, view.at(best.center) + view.scale * group[0].radius * unit)
    align, aside = ("left", 0.8) if unit.real >= 0.0 else ("right", -0.8)
    paper.value(view.axes, best.foot + aside, words, ha=align)
    return best.way, best.box


class _Leader(NamedTuple):
    """An arrow to a circle.

    Fields
        center : complex [mm] - of the circle
        foot : complex [mm of paper] - where the arrow begins
        way : float [rad] - from the circle to its words
        outside : bool - of all that is drawn
        box : Box - what the words take
    """

    center: complex
    foot: complex
    way: float
    outside: bool
    box: paper.Box


def _leaders(view: View, group: Sequence[Circle]) -> Iterator[_Leader]:
    """What leads to one of the circles that are alike, from outside of all that is drawn or from beside it."""
    circle = group[0]
    every = [float(np.abs(line.nodes).max()) for line in view.shape.lines]
    every += [abs(each.center) + each.radius for each in view.shape.part.circles]
    far, near = view.scale * max(every) + _OFF, view.scale * circle.radius + _NEAR
    around = [(0j, _TURN * (k + 0.5) / _WAYS) for k in range(_WAYS)]
    from_far, from_near = around if circle.layer != "SHAFT" else [], around
    if circle.center:
        from_far = [(each.center, cmath.phase(each.center)) for each in group] if len(group) > 1 else []
        from_near = [(each.center, cmath.phase(each.center) + way) for each in group for way in _DIAGONALS]
    rows = _words(view, group).split("\n")
    size = complex(_LETTER * max(map(len, rows)), 3.2 * len(rows))
    for outside, places in ((True, from_far), (False, from_near)):
        for center, way in places:
            foot = view.axis + cmath.rect(far, way) if outside else view.at(center) + cmath.rect(near, way)
            middle = foot + math.copysign(0.8 + 0.5 * size.real, math.cos(way))
            yield _Leader(center, foot, way, outside, _box(middle, size))


def _box(middle: complex, size: complex) -> paper.Box:
    """A box by its middle, width and height [mm of paper]."""
    low, high = middle - 0.5 * size, middle + 0.5 * size
    return paper.Box(low.real, low.imag, high.real, high.imag)
