"""Placing the panels of a figure for good, and the words along their axes: what a drawing needs is measured once."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Mapping, Sequence
from functools import partial
from typing import TYPE_CHECKING, Any, NamedTuple, TypeAlias

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

Box: TypeAlias = tuple[float, float, float, float]


class Places(NamedTuple):
    """What tells like figures, the boxes of their panels, and how far from these the words along their axes stand."""

    likeness: str
    boxes: tuple[Box, ...]
    distances: tuple[float, ...]


def settled(made: Figure, known: Places | None = None) -> Figure:
    """The figure with its panels placed for good, to the hundredth of a millimetre; where they are known to stand, if
    the lines of its title and the numbers of its panels and labels are those of that time.

    The solver of the constrained layout leaves last digits to chance; an SVG names its clips after them, and a
    drawing to scale widens its limits by them. So the limits are those from before the layout.
    """
    from gearlink.cli.views.figures.drawing import style
    from gearlink.cli.views.figures.drawing.labels import clear

    if made.get_layout_engine() is None:  # true to size: its panels stand where they are
        clear(made)
        return made
    limits = [(axes.get_xlim(), axes.get_ylim()) for axes in made.axes]
    labels = _labels(made)
    if known is not None and known.likeness == _likeness(made):
        boxes, distances = known.boxes, known.distances
    else:
        distances = _laid_out(made, labels)
        boxes = _boxes(made)
    made.set_layout_engine(None)  # "none" would have savefig draw the panels a time more, for a layout
    style.place_title(made)
    for label, distance in zip(labels, distances, strict=True):
        label.keep(distance)
    for axes, (x, y), box in zip(made.axes, limits, boxes, strict=True):
        axes.set_position(box)
        axes.set_xlim(x, auto=None)
        axes.set_ylim(y, auto=None)
    clear(made)
    return made


def places(made: Figure) -> Places:
    """Where the panels of a settled figure stand."""
    return Places(_likeness(made), _boxes(made), tuple(label.distance for label in _labels(made)))


def _likeness(made: Figure) -> str:
    title = made.get_suptitle()
    rows = 1 + title.count("\n") if title else 0  # its words move nothing
    return f"{len(made.axes)} panels with {len(_labels(made))} labels below {rows} lines"


def _boxes(made: Figure) -> tuple[Box, ...]:
    found: Any = (axes.get_position(original=True).bounds for axes in made.axes)
    return tuple(tuple(round(side, 5) for side in box) for box in found)


def _laid_out(made: Figure, labels: Sequence[_Label]) -> tuple[float, ...]:
    """Place the panels, and say how far from them their words stand."""
    layout: Any = made.get_layout_engine()
    if layout is None:
        return tuple(label.distance for label in labels)
    from gearlink.cli.views.figures.drawing.own import Panel

    panels = {axes: [label for label in labels if label.of(axes)] for axes in made.axes if isinstance(axes, Panel)}
    far: dict[_Label, float] = {}
    for axes, own in panels.items():
        axes.on_measuring = partial(_note, far, own)
        for each in (axes, *axes.child_axes):
            for axis in (each.xaxis, each.yaxis):
                if not axis.get_label_text():
                    axis.set_label_coords(0.0, 0.0)  # else the numbers beside it are measured for its place
    layout.execute(made)
    distances = _in_line(labels, far)
    out = {label: distance - far.get(label, distance) for label, distance in zip(labels, distances, strict=True)}
    moved = [
        axes.widen(made.dpi * max(out[label] for label in left))
        for axes, own in panels.items()
        if (left := [label for label in own if label.side == "left" and out[label] > 0.0])
    ]
    if any(moved):
        layout.execute(made)
    for axes in panels:
        axes.on_measuring = None
    return distances


def _note(far: dict[_Label, float], labels: Sequence[_Label]) -> None:
    """Keep how far from its panel each label stands where the layout has put it."""
    far.update({label: label.distance for label in labels})


def _in_line(labels: Sequence[_Label], far: Mapping[_Label, float]) -> tuple[float, ...]:
    """The distances of words, those to the left of panels one above another in a line."""
    columns: dict[float, float] = defaultdict(float)
    for label in labels:
        if label.side == "left":
            columns[label.column] = max(columns[label.column], far.get(label, 0.0))
    return tuple(columns[label.column] if label.side == "left" else far.get(label, 0.0) for label in labels)


def _labels(made: Figure) -> list[_Label]:
    """The words along the axes of all panels."""
    every = [axis for axes in made.axes for each in (axes, *axes.child_axes) for axis in (each.xaxis, each.yaxis)]
    return [_Label(axis) for axis in every if axis.get_label_text() and axis.axes.axison]


class _Label:
    """The words along an axis: to place them anew, each drawing would measure all numbers of the axis."""

    def __init__(self, axis: Axis) -> None:
        self._axis, self.side = axis, str(axis.get_label_position())

    def of(self, axes: Axes) -> bool:
        """Whether they stand beside a panel, or an axis more that it has."""
        return self._axis.axes in (axes, *axes.child_axes)

    @property
    def column(self) -> float:
        """Where the panel begins, as a share of the figure."""
        return round(float(self._axis.axes.get_position(original=True).x0), 3)

    @property
    def distance(self) -> float:
        """How far from the panel they stand, outwards [inch]."""
        box, dpi = self._axis.axes.bbox, self._axis.axes.figure.dpi
        x, y = self._axis.label.get_transform().transform(self._axis.label.get_position())
        ways = {"left": box.x0 - x, "right": x - box.x1, "bottom": box.y0 - y, "top": y - box.y1}
        return round(float(ways[self.side]) / dpi, 4)

    def keep(self, distance: float) -> None:
        """Let them stand there."""
        from matplotlib.transforms import ScaledTranslation

        axes, far, upright = self._axis.axes, self.side in ("right", "top"), self.side in ("left", "right")
        out = distance if far else -distance
        shift = ScaledTranslation(*((out, 0.0) if upright else (0.0, out)), axes.figure.dpi_scale_trans)
        x, y = self._axis.label.get_position()
        place = (float(far), y) if upright else (x, float(far))
        self._axis.set_label_coords(*place, axes.transAxes + shift)
