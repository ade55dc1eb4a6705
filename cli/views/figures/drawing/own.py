"""What derives from classes of matplotlib: the sheet and its panels, and the numbers along their axes.

Nothing else of a figure imports matplotlib before it is drawn: the module of a kind has its scene beside its figure,
and an animation needs that alone.
"""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.axes import Axes
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator
from matplotlib.transforms import Bbox

if TYPE_CHECKING:
    from collections.abc import Callable

    from numpy.typing import NDArray

_STEPS = (1, 2, 2.5, 5, 10)
_ROUNDING = 1e-10
"""Of the axis, by which a number may lie beyond its ends and is drawn."""


class RoundNumbers(MaxNLocator):
    """Round numbers along an axis, at most so many, and none beyond its ends.

    matplotlib's own go a step beyond both; it makes them, their lines and their labels, and then leaves them out.
    """

    def __init__(self, most: int) -> None:
        super().__init__(most, steps=list(_STEPS))

    def __call__(self) -> Any:
        """The numbers; where fewer than two lie within, all of them, for their digits tell from their distance."""
        found = np.asarray(super().__call__())
        axis: Any = self.axis
        low, high = sorted(axis.get_view_interval())
        beyond = _ROUNDING * (high - low)
        within = found[(found >= low - beyond) & (found <= high + beyond)]
        return within if len(within) > 1 else found


class Panel(Axes):
    """A panel of a sheet.

    Fields
        room : (4,) array or None - what its words need beside it [pixel], left and below negative; None before they
            are measured, and where nothing needs room
        on_measuring : what is called when they have been; None: they are measured anew each time
    """

    room: NDArray[Any] | None = None
    on_measuring: Callable[[], None] | None = None

    def get_tightbbox(self, *given: Any, **named: Any) -> Bbox | None:
        """The panel with its words. A layout asks twice, for numbers along an axis may change with its length; those of
        these sheets hardly do, and measuring takes a third of the time of a sheet."""
        if self.on_measuring is None:
            return super().get_tightbbox(*given, **named)
        box = self.get_position(original=True).transformed(self.get_figure().transSubfigure)  # type: ignore[union-attr]
        if self.room is None:
            tight = super().get_tightbbox(*given, **named)
            if tight is None:
                return None
            self.room = np.subtract(tight.extents, box.extents)
            self.on_measuring()
        return Bbox.from_extents(*(box.extents + self.room))

    def widen(self, pixels: float) -> bool:
        """Ask for more room to the left; whether the panel asked for some."""
        if self.room is None:
            return False
        self.room[0] -= pixels
        return True


class Sheet(Figure):
    """A figure of panels."""

    def add_subplot(self, *places: Any, **look: Any) -> Axes:
        """A panel, or axes of the projection that is asked for."""
        if "projection" not in look:
            look["axes_class"] = Panel
        made: Axes = super().add_subplot(*places, **look)
        return made

    def _repr_png_(self) -> bytes:
        """What a notebook shows, without pyplot too."""
        from io import BytesIO

        page = BytesIO()
        self.savefig(page, format="png", dpi=80)
        return page.getvalue()
