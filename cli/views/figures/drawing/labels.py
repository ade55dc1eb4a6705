"""Words that keep clear: of a settled figure, those that lie on other words or on marks move to the nearest free place.

Letters of joints, extremes and dimensions stand where their panels put them, which is right at usual proportions; at
others two of them may meet. Only words that belong to a point move; titles, legends, tables and numbers stand.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from typing import TYPE_CHECKING, Any, NamedTuple

import numpy as np

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure
    from matplotlib.text import Text

    from gearlink.core.numerics.arrays import Reals

_WAYS = np.exp(2j * np.pi * np.arange(16) / 16)
_FARTHER = (1.0, 1.3, 1.7, 2.3, 3.0, 4.0, 5.5, 7.5)
"""Distances that are tried, in those at which the words stand."""
_LEAST = 5.0
_BETWEEN, _ABOVE = 2.5, 0.5
"""Room beside words and above them [pt]."""
_LEADER = 13.0
"""Words so far from their point [pt] get a line to it."""
_SMALL, _AROUND = 3.0, 1.5
"""Size of marks that hide nothing [pt]; room about the others [pixel]."""
_ON_WORDS, _ON_MARKS, _OUTSIDE, _ON_CURVES, _AWAY = 60.0, 30.0, 40.0, 1.5, 0.8
"""What a place costs that is wholly taken, against a height of the letters farther away."""
_STEP, _MOST_CURVES = 4.0, 4.0
"""Distance of points of curves [pixel], and widths of letters on curves that count at most."""
_FREE = 0.02
KEY = "key"
"""Words beside the sign that they explain, which stand where they are."""


class _Room(NamedTuple):
    """What is taken in a panel [pixel]: boxes of words and of marks, points of curves, and the panel itself."""

    words: Reals
    marks: Reals
    curves: Reals
    panel: Reals


def clear(made: Figure) -> None:
    """Move the words of points that lie on other words or on marks."""
    from matplotlib.backends.backend_agg import FigureCanvasAgg

    canvas: Any = made.canvas
    renderer = (canvas if hasattr(canvas, "get_renderer") else FigureCanvasAgg(made)).get_renderer()
    for axes in made.axes:
        movable = [text for text in axes.texts if _moves(text, axes)]
        if not movable:
            continue
        axes.apply_aspect()
        marks = np.array(list(_marks(axes))).reshape(-1, 4)
        beside = np.array(list(_beside(axes, renderer))).reshape(-1, 4)
        still = [box_of(text, renderer) for text in axes.texts if text not in movable and is_seen(text)]
        _arrange(axes, movable, np.vstack([beside, np.array(still).reshape(-1, 4)]), marks, renderer)


def _arrange(axes: Axes, movable: list[Text], others: Reals, marks: Reals, renderer: Any) -> None:
    """Each of the words that lies on something to where it lies on least; the later ones give way."""
    boxes = np.array([box_of(text, renderer) for text in movable])
    curves: Reals | None = None
    order = sorted(range(len(movable)), key=lambda i: movable[i].get_bbox_patch() is None)
    for place, i in enumerate(order):
        before = boxes[order[:place]]
        after = boxes[order[place + 1 :]]
        panel = np.array(axes.bbox.extents)
        own = boxes[i : i + 1]
        taken = np.vstack([others, before])
        if _on(own, taken, _room(axes))[0] + _on_marks(own, marks)[0] + _outside(own, panel)[0] <= _FREE:
            continue
        if curves is None:
            curves = _curves(axes)
        room = _Room(np.vstack([taken, after]), marks, curves, panel)
        boxes[i] = _moved(axes, movable[i], boxes[i], room)


def _moved(axes: Axes, text: Text, box: Reals, room: _Room) -> Reals:
    """Put words to the best of the places about their point; their new box."""
    scale = axes.figure.dpi / 72.0
    anchor = _anchor(text)
    half = 0.5 * complex(box[2] - box[0], box[3] - box[1])
    middle = complex(box[0], box[1]) + half
    height = float(text.get_fontsize()) * scale
    near = max(_gap(middle - anchor, half), _LEAST * scale)
    # So far along each way that the box clears its point by the distance.
    ways = [w * (reach(w, half) + near * farther) for farther in _FARTHER for w in _WAYS]
    places = np.array([middle, *(anchor + way for way in ways)])
    boxes = np.column_stack([places.real, places.imag, places.real, places.imag])
    boxes = boxes + np.array([-half.real, -half.imag, half.real, half.imag])
    cost = _ON_WORDS * _on(boxes, room.words, _room(axes)) + _ON_MARKS * _on_marks(boxes, room.marks)
    cost += _OUTSIDE * _outside(boxes, room.panel) + _ON_CURVES * _share_of_points(boxes, room.curves, height)
    cost += _AWAY * np.abs(places - middle) / height
    best = int(np.argmin(cost))
    if best:
        _shift(axes, text, places[best] - middle)
        if _gap(places[best] - anchor, half) > _LEADER * scale:
            _leader(axes, anchor, places[best], half)
    return np.asarray(boxes[best])


def reach(way: complex, half: complex) -> float:
    """From the middle of a box to its edge in a direction."""
    return min(half.real / max(abs(way.real), 1e-9), half.imag / max(abs(way.imag), 1e-9))


def _gap(away: complex, half: complex) -> float:
    """Distance of a point from a box, its middle away from it."""
    return abs(complex(max(abs(away.real) - half.real, 0.0), max(abs(away.imag) - half.imag, 0.0)))


def _room(axes: Axes) -> tuple[float, float]:
    """What words need beside and above them [pixel]."""
    scale = axes.figure.dpi / 72.0
    return _BETWEEN * scale, _ABOVE * scale


def _on(boxes: Reals, taken: Reals, room: tuple[float, float] = (0.0, 0.0)) -> Reals:
    """Share of each box, with room about it, that others take, each of which counts by itself; of what is smaller than
    the box the share that it covers: a letter under a long word is as illegible as the word under a longer one."""
    low, high = boxes[:, None, :2] - room, boxes[:, None, 2:] + room
    both = np.maximum(np.minimum(high, taken[None, :, 2:]) - np.maximum(low, taken[None, :, :2]), 0.0)
    size = np.minimum((high - low).prod(axis=2), (taken[:, 2:] - taken[:, :2]).prod(axis=1))
    return np.asarray((both.prod(axis=2) / np.maximum(size, 1.0)).sum(axis=1))


def _on_marks(boxes: Reals, marks: Reals) -> Reals:
    """What marks take of each box, by the square of its height: a letter of a long word hides a mark no less."""
    sides = boxes[:, 2:] - boxes[:, :2]
    around = np.array([-1.0, -1.0, 1.0, 1.0]) * _AROUND
    return np.asarray(_on(boxes, marks + around) * np.maximum(sides[:, 0] / np.maximum(sides[:, 1], 1.0), 1.0))


def _outside(boxes: Reals, panel: Reals) -> Reals:
    """Share of each box that lies outside a panel."""
    inside = np.maximum(np.minimum(boxes[:, 2], panel[2]) - np.maximum(boxes[:, 0], panel[0]), 0.0)
    inside = inside * np.maximum(np.minimum(boxes[:, 3], panel[3]) - np.maximum(boxes[:, 1], panel[1]), 0.0)
    return np.asarray(1.0 - inside / np.maximum((boxes[:, 2] - boxes[:, 0]) * (boxes[:, 3] - boxes[:, 1]), 1.0))


def _share_of_points(boxes: Reals, points: Reals, height: float) -> Reals:
    """How much of a curve runs through each box, in widths of its height."""
    x, y = points[:, 0], points[:, 1]
    found = [float(np.count_nonzero((x > a) & (x < c) & (y > b) & (y < d))) for a, b, c, d in boxes]
    return np.minimum(np.asarray(found) * _STEP / height, _MOST_CURVES)


def _moves(text: Text, axes: Axes) -> bool:
    """Whether words belong to a point of the panel, and may stand elsewhere beside it."""
    if not is_seen(text) or text.get_rotation() % 90.0 or axes.name != "rectilinear" or text.get_gid() == KEY:
        return False
    if not axes.axison and axes.get_aspect() == "auto":  # a table
        return False
    coordinates = getattr(text, "xycoords", None)
    if coordinates is not None:
        return bool(coordinates == "data" and getattr(text, "anncoords", None) == "offset points")
    return text.get_transform() is axes.transData or text.get_transform() == axes.transData


def is_seen(text: Text) -> bool:
    """Whether there is something to read."""
    return bool(text.get_visible() and text.get_text().strip())


def box_of(text: Text, renderer: Any) -> tuple[float, float, float, float]:
    """The box of words, with the frame that they may have [pixel]."""
    patch = text.get_bbox_patch()
    if patch is not None:
        text.update_bbox_position_size(renderer)
        return tuple(patch.get_window_extent(renderer).extents)  # type: ignore[return-value]
    return tuple(text.get_window_extent(renderer).extents)  # type: ignore[return-value]


def _beside(axes: Axes, renderer: Any) -> Iterator[tuple[float, float, float, float]]:
    """Boxes of titles, legend, and of numbers and words along the axes, those that a panel has besides included."""
    place = axes.bbox.extents
    twins = (other for other in axes.figure.axes if other is not axes and np.allclose(place, other.bbox.extents))
    for each in (axes, *axes.child_axes, *twins):
        legend = each.get_legend()
        written: Sequence[Any] = (each.title, each._left_title, each._right_title)  # type: ignore[attr-defined]
        yield from (box_of(text, renderer) for text in written if is_seen(text))
        if legend is not None:
            yield from (box_of(text, renderer) for text in legend.get_texts())
        if each.axison:
            for axis in (each.xaxis, each.yaxis):
                yield from (box_of(text, renderer) for text in _numbers(axis))


def _numbers(axis: Axis) -> Iterator[Text]:
    """The numbers along an axis that are within its limits, and its words."""
    low, high = sorted(axis.get_view_interval())
    room = 1e-9 * (high - low)
    yield from (
        label
        for label, place in zip(axis.get_majorticklabels(), axis.get_majorticklocs(), strict=False)
        if low - room <= place <= high + room and is_seen(label)
    )
    if is_seen(axis.label):
        yield axis.label


def _marks(axes: Axes) -> Iterator[tuple[float, float, float, float]]:
    """Boxes of the marks of points."""
    from matplotlib.markers import MarkerStyle

    scale = axes.figure.dpi / 72.0
    for line in axes.lines:
        marker: Any = line.get_marker()
        if marker in (None, "", " ", "None", "none") or line.get_markersize() < _SMALL or not line.get_visible():
            continue
        style = MarkerStyle(marker)
        ends = float(line.get_markersize()) * scale * _sides(style.get_path().get_extents(style.get_transform()))
        xy = line.get_transform().transform(np.column_stack(line.get_data(orig=False)).astype(float))
        panel = axes.bbox.extents
        for x, y in xy[np.isfinite(xy).all(axis=1)]:
            if panel[0] <= x <= panel[2] and panel[1] <= y <= panel[3]:
                yield x + ends[0], y + ends[1], x + ends[2], y + ends[3]


def _sides(box: Any) -> Reals:
    """Left, lower, right and upper side of a box."""
    return np.asarray(box.extents, dtype=np.float64)


def _curves(axes: Axes) -> Reals:
    """Points of the lines of a panel, close together."""
    found = [np.empty((0, 2))]
    low, high = _sides(axes.bbox)[:2] - _STEP, _sides(axes.bbox)[2:] + _STEP
    for line in axes.lines:
        if not line.get_visible() or line.get_linestyle() in ("None", "none", " ", ""):
            continue
        xy = line.get_transform().transform(np.column_stack(line.get_data(orig=False)).astype(float))
        xy = np.clip(xy[np.isfinite(xy).all(axis=1)], low, high)
        if len(xy) > 1:
            along = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(xy, axis=0).T))])
            at = np.arange(0.0, along[-1], _STEP)
            found.append(np.column_stack([np.interp(at, along, xy[:, 0]), np.interp(at, along, xy[:, 1])]))
    return np.vstack(found)


def _anchor(text: Text) -> complex:
    """The point that words belong to [pixel]."""
    given: Any = text
    at = given.xy if hasattr(given, "xy") else given.get_position()
    return complex(*text.axes.transData.transform(at))  # type: ignore[union-attr]


def _shift(axes: Axes, text: Text, away: complex) -> None:
    """Move words by so many pixels."""
    given: Any = text
    if hasattr(given, "xyann"):
        points = 72.0 / axes.figure.dpi
        x, y = given.xyann
        given.xyann = (float(x + points * away.real), float(y + points * away.imag))
        return
    at = axes.transData.transform(given.get_position()) + np.array([away.real, away.imag])
    given.set_position(tuple(axes.transData.inverted().transform(at).tolist()))


def _leader(axes: Axes, anchor: complex, middle: complex, half: complex) -> None:
    """A thin line from words to their point, which says to which one they belong."""
    from matplotlib.lines import Line2D

    from gearlink.cli.views.figures.drawing import style

    away = middle - anchor
    foot = middle - away * min(1.0, reach(away / abs(away), half) / abs(away))
    ends = axes.transData.inverted().transform([(anchor.real, anchor.imag), (foot.real, foot.imag)])
    axes.add_artist(Line2D(*ends.T, color=style.GREY, linewidth=0.6, zorder=7, gid="leader"))
