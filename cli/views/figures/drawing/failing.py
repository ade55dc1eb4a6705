"""Places where a check fails, in red: stretches of a curve past its limit, angles, bodies that come too near."""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.scenes.shown import clashes

if TYPE_CHECKING:
    from matplotlib.axes import Axes

    from gearlink.cli.views.scenes.scene import Reals, Scene

_THICK: Any = {"color": style.WRONG, "linewidth": 3.2, "zorder": 7, "solid_capstyle": "round"}


def past(axes: Axes, x: Any, y: Any, bad: Any, words: str = "fails") -> None:
    """A curve again in red where a mask says that it fails, with the points next to those."""
    bad = np.asarray(bad, dtype=bool)
    if not bad.any():
        return
    wide = bad.copy()
    wide[1:] |= bad[:-1]
    wide[:-1] |= bad[1:]
    known = axes.get_legend_handles_labels()[1]
    axes.plot(np.asarray(x), np.where(wide, y, np.nan), **_THICK, label="_" if words in known else words, gid="fails")


def at(axes: Axes, degrees: float, words: str) -> None:
    """A line at an angle [deg] at which something fails."""
    look: dict[str, Any] = {"color": style.WRONG, "linewidth": 1.6, "linestyle": style.DASHED, "zorder": 6}
    axes.axvline(degrees, **look, label=words, gid="fails")


def bodies(axes: Axes, design: Any, build: Callable[[Any, Reals], Scene], turns: float = 1.0) -> None:
    """The outlines of bodies that clash, where they are nearest, red on the mechanism.

    build : the scene of the design over fractions of its loop, whose marks are the joints by their letters
    turns : input turns of the loop
    """
    for pair in list(clashes(design))[:3]:
        angle = pair.angle or 0.0
        scene = build(design, np.array([(angle / (2.0 * math.pi * turns)) % 1.0]))
        places = {mark.text: complex(mark.point[0]) for mark in scene.marks}
        if pair.one.axis not in places or pair.other.axis not in places:
            continue
        where = "" if pair.angle is None else f" at {math.degrees(angle):.4g}°"
        words: str | None = f"too near: {pair.one.name}, {pair.other.name}{where}"
        for body in (pair.one, pair.other):
            for radius in {body.outer, max(body.inner, 0.0)} - {0.0}:
                look: dict[str, Any] = {"color": style.WRONG, "linewidth": 2.0, "zorder": 8}
                style.circle(axes, places[body.axis], radius, **look, label=words, gid="fails")
                words = None
