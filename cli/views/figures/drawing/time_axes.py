"""Second axes in real time: rates per second at the right of a chart, and milliseconds below its input angle."""

from __future__ import annotations

import math
from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import panels, style
from gearlink.cli.views.scenes.shown import speed_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes

ROW, UNEVEN = "time", "uneven-time"
"""Names of the axes in ms, for those who read a figure: of an input that turns evenly, of a link that does not."""
_BELOW = 33.0
"""Points from an x axis to the one in ms: room for its numbers and words."""
_TURNING = ("crank", "input", "carrier", "cylinder", "cam")
_UNITS_OF_A_TURN = {**{f"{name} angle [deg]": 360.0 for name in _TURNING}, "input turns": 1.0}
"""How the x axes over the input are named, and what a revolution is on them."""


def turn_time(design: Any) -> float | None:
    """Time of an input turn of a design [ms]; None where its speed is not known."""
    found: float | None = getattr(design, "turn_time", None)
    if found is None and (speed := speed_of(design)):
        found = 2e3 * math.pi / abs(speed)
    return found


def in_time(axes: Axes, speed: float | None, order: int, measure: str, scale: float = 1.0) -> None:
    """A curve per input angle in real time as well, on an axis at the right; nothing where the speed is not known.

    speed : of the input [rad/s]
    order : 1 for a speed, 2 for an acceleration, 3 for a jerk
    measure : "rad", "mm" or "m"; scale : of it in a unit of the curve
    """
    if speed is None:
        return
    right = axes.secondary_yaxis("right", functions=_times(scale * speed**order))
    right.set_ylabel(f"[{measure}/s{('', '', '²', '³')[order]}]", fontsize=8.5)
    right.tick_params(labelsize=8)
    right.ticklabel_format(scilimits=(-3, 5))
    panels.few_ticks(right.yaxis)
    right.yaxis.get_offset_text().set_horizontalalignment("left")


def in_ms(axes: Axes, each: float | None) -> None:
    """The x axis in time as well, in a row of its own below its words; nothing where the speed is not known.

    each : time of a unit of the x axis [ms]
    """
    if each is not None:
        _time_row(axes, _times(each), ROW)


def _times(factor: float) -> tuple[Any, Any]:
    return lambda values: values * factor, lambda values: values / factor


def in_uneven_ms(axes: Axes, degrees: Any, times: Any) -> None:
    """The x axis in time where what it counts does not turn evenly.

    degrees, times : (N,) arrays [deg], [ms] - both rising
    """
    to_ms, from_ms = partial(np.interp, xp=degrees, fp=times), partial(np.interp, xp=times, fp=degrees)
    _time_row(axes, (to_ms, from_ms), UNEVEN)


def over_input(axes: Axes, turn: float | None) -> None:
    """The x axis in time, where its words say that it is the input's angle.

    turn : time of an input turn [ms]; None where the speed is not known
    """
    units = _UNITS_OF_A_TURN.get(axes.get_xlabel())
    if units is not None and turn is not None:
        in_ms(axes, turn / units)


def once(stacked: Sequence[Axes], turn: float | None) -> None:
    """Panels one below the other, each in time; those over the same angle have its words and numbers once, below.

    turn : time of an input turn [ms]; None where the speed is not known
    """
    labels = [axes.get_xlabel() for axes in stacked]
    for axes, words, below in zip(stacked, labels, [*labels[1:], ""], strict=False):
        if words == below:
            axes.set_xlabel("")
            panels.without_numbers(axes)
        else:
            over_input(axes, turn)


def _time_row(axes: Axes, functions: Any, name: str) -> None:
    """Numbers in ms on a thin line, their unit at the left of it, where the numbers of the y axis leave room."""
    from gearlink.cli.views.figures.drawing.own import RoundNumbers

    labelled = bool(axes.get_xlabel())
    down = _BELOW if labelled else _BELOW - 12.0
    below = axes.secondary_xaxis("bottom", functions=functions)
    below.set_gid(name)
    below.spines["bottom"].set(position=("outward", down), color=style.GREY, linewidth=0.7)
    below.xaxis.set_major_locator(RoundNumbers(6))
    below.tick_params(labelsize=7, length=2.5, width=0.7, pad=1.5, color=style.GREY, labelcolor=style.GREY)
    below.ticklabel_format(scilimits=(-3, 6))
    below.xaxis.get_offset_text().set_fontsize(7)
    look: dict[str, Any] = {"fontsize": 7, "color": style.GREY, "ha": "right", "va": "top"}
    where: dict[str, Any] = {"xycoords": "axes fraction", "textcoords": "offset points"}
    axes.annotate("[ms]", (0.0, 0.0), (-12, -down - 3.5), **where, **look)
