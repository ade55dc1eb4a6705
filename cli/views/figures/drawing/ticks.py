"""Numbers along an axis, and the lines at them."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Any

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.markers import TICKDOWN
from matplotlib.patches import PathPatch
from matplotlib.path import Path
from matplotlib.ticker import FuncFormatter, MaxNLocator, NullLocator

from gearlink.cli.views.figures.drawing import style

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.axis import Axis

_STEPS = (1, 2, 2.5, 5, 10)
_ROUNDING = 1e-10
"""Of the axis, by which a number may lie beyond its ends and is drawn."""

_RAISED = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


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


def powers_of_ten(axis: Axis) -> None:
    """Numbers along a logarithmic axis as plain text: powers of ten, of an axis of few decades 1, 2 and 5 times those.

    matplotlib's own formatter writes formulas, which take it thirty times as long.
    """

    def few() -> bool:
        low, high = sorted(axis.get_view_interval())
        return bool(high < _FEW * low)

    def between(value: float, _: int) -> str:
        first = f"{value:.0e}"[0]
        return f"{value:g}" if few() and first in "25" else ""

    axis.set_major_formatter(FuncFormatter(lambda value, k: f"{value:g}" if few() else _power(value, k)))
    axis.set_minor_formatter(FuncFormatter(between))
    axis.set_tick_params(which="minor", labelsize=axis.get_tick_params("major").get("labelsize"))


_FEW = 10.0**2.7
"""An axis whose ends are nearer than this ratio would have two or three powers of ten."""


def _power(value: float, _: int) -> str:
    """A power of ten.

    Example
        >>> _power(1000.0, 0), _power(0.01, 0)
        ('10³', '10⁻²')
    """
    return "10" + str(round(math.log10(value))).translate(_RAISED)


def without_numbers(axes: Axes) -> None:
    """The grid and the ticks of an x axis whose numbers stand below another panel, as two lines instead of many."""
    places = np.asarray(axes.xaxis.get_majorticklocs(), dtype=float)
    low, high = sorted(axes.get_xlim())
    places = places[(places >= low) & (places <= high)]
    axes.xaxis.set_major_locator(NullLocator())
    look: dict[str, Any] = {"transform": axes.get_xaxis_transform(), "zorder": axes.xaxis.get_zorder()}
    corners = np.column_stack((np.repeat(places, 2), np.tile([0.0, 1.0], len(places))))
    grid = Path(corners, np.tile([Path.MOVETO, Path.LINETO], len(places)))
    axes.add_artist(PathPatch(grid, fill=False, edgecolor=style.LIGHT, linewidth=style.GRID, **look))
    mark: dict[str, Any] = {"marker": TICKDOWN, "markersize": 3.5, "markeredgewidth": 0.8, "linestyle": "none"}
    axes.add_artist(Line2D(places, np.zeros(len(places)), color="black", clip_on=False, **mark, **look))
