"""Placing the panels of a figure for good, and the words along their axes: what a drawing needs is measured once."""

from __future__ import annotations

from collections import defaultdict
from typing import TYPE_CHECKING, Any, TypeAlias

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis
    from matplotlib.figure import Figure

Box: TypeAlias = tuple[float, float, float, float]
Places: TypeAlias = tuple[str, tuple[Box, ...]]
"""What tells like figures, and the boxes of their panels."""


def settled(made: Figure, known: Places | None = None) -> Figure:
    """The figure with its panels placed for good, to the hundredth of a millimetre; where they are known to stand, if
    its title and the number of its panels are those of that time.

    The solver of the constrained layout leaves last digits to chance; an SVG names its clips after them, and a
    drawing to scale widens its limits by them. So the limits are those from before the layout.
    """
    from gearlink.cli.figures import style

    limits = [(axes.get_xlim(), axes.get_ylim()) for axes in made.axes]
    likeness, boxes = known or ("", ())
    if likeness != _likeness(made):
        boxes = ()
    if not boxes and made.get_layout_engine():
        _lay_out(made)
    else:
        made.align_ylabels()
    made.set_layout_engine(None)  # "none" would have savefig draw the panels a time more, for a layout
    style.place_title(made)
    for axes, (x, y), box in zip(made.axes, limits, boxes or _boxes(made), strict=True):
        axes.set_position(box)
        axes.set_xlim(x, auto=None)
        axes.set_ylim(y, auto=None)
    return made


def places(made: Figure) -> Places:
    """Where the panels of a settled figure stand."""
    return _likeness(made), _boxes(made)


def _likeness(made: Figure) -> str:
    title = made._suptitle  # type: ignore[attr-defined]
    return f"{len(made.axes)} panels of {title.get_text() if title is not None else ''}"


def _boxes(made: Figure) -> tuple[Box, ...]:
    found: Any = (axes.get_position(original=True).bounds for axes in made.axes)
    return tuple(tuple(round(side, 5) for side in box) for box in found)


def _lay_out(made: Figure) -> None:
    """Place the panels; words along axes stay at their distance, those of panels one above another in a line."""
    layout: Any = made.get_layout_engine()
    labels: list[_Label] = []
    for axes in made.axes:
        _measured_once(axes, labels)
    layout.execute(made)
    for axes in made.axes:
        del axes.get_tightbbox  # the method of the class again
    _keep(labels)


def _measured_once(axes: Axes, labels: list[_Label]) -> None:
    """Let the room that a panel's words need beside it be measured once.

    The layout measures all words twice, for numbers along an axis may change with its length; those of these sheets
    hardly do, and measuring takes a third of the time of a sheet.
    """
    from matplotlib.transforms import Bbox

    measure = axes.get_tightbbox
    known: list[Any] = []
    every = [each for panel in (axes, *axes.child_axes) for each in (panel.xaxis, panel.yaxis)]
    for axis in every:
        if not axis.get_label_text():
            axis.set_label_coords(0.0, 0.0)  # else the numbers beside it are measured for its place

    def measured(*given: Any, **named: Any) -> Any:
        box: Any = axes.get_position(original=True).transformed(axes.figure.transSubfigure)
        if not known:
            tight = measure(*given, **named)
            known.append(None if tight is None else tight.extents - box.extents)
            labels.extend(_Label(axis) for axis in every if axis.get_label_text())
        return None if known[0] is None else Bbox.from_extents(*(box.extents + known[0]))

    axes.get_tightbbox = measured  # type: ignore[method-assign]


class _Label:
    """The words along an axis, and how far from their panel they were measured to stand [inch, outwards]."""

    def __init__(self, axis: Axis) -> None:
        self.axis, self.side = axis, axis.get_label_position()
        box, dpi = axis.axes.bbox, axis.axes.figure.dpi
        x, y = axis.label.get_position()  # one in pixels, the other a share of the panel
        ways = {"left": box.x0 - x, "right": x - box.x1, "bottom": box.y0 - y, "top": y - box.y1}
        self.distance = ways[self.side] / dpi
        self.along = y if self.side in ("left", "right") else x

    def keep(self, distance: float) -> None:
        """Let the words stand there: to place them anew, each drawing would measure all numbers of the axis."""
        from matplotlib.transforms import ScaledTranslation

        axes, far = self.axis.axes, self.side in ("right", "top")
        out = distance if far else -distance
        upright = self.side in ("left", "right")
        shift = ScaledTranslation(*((out, 0.0) if upright else (0.0, out)), axes.figure.dpi_scale_trans)
        place = (float(far), self.along) if upright else (self.along, float(far))
        self.axis.set_label_coords(*place, axes.transAxes + shift)


def _keep(labels: list[_Label]) -> None:
    columns: dict[float, list[_Label]] = defaultdict(list)
    for label in labels:
        if label.side == "left":
            columns[round(label.axis.axes.get_position(original=True).x0, 3)].append(label)
        else:
            label.keep(label.distance)
    for column in columns.values():
        farthest = max(label.distance for label in column)
        for label in column:
            label.keep(farthest)
