"""Places where a check fails, in red: stretches of a curve past its limit, angles, bodies that come too near."""

from __future__ import annotations

import math
from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import style
from gearlink.cli.views.scenes import linkages
from gearlink.cli.views.scenes.shown import build, clashes, frame_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

    from gearlink.cli.views.scenes.scene import Reals, Scene
    from gearlink.core.base.report import Check

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


def instants(made: Figure, design: Any, checks: Sequence[Check]) -> None:
    """Curves over the input again in red where a check fails, on sheets that name their panels as `over_input`."""
    from gearlink.cli.views.figures.drawing import panels

    columns: list[list[Axes]] = vars(made).get("over_input", [])
    given = design.moving.input if columns else None
    if given is None or given.turns is None:
        return
    low, high = math.degrees(given.start), math.degrees(given.end)
    shares = np.arange(360) / 360.0
    faults = [fault for fault in build(design, shares, (), checks).faults if fault.placed]
    frame = frame_of(design, linkages.builder(design.kind)) if faults else None
    place = (np.degrees(frame.inputs(shares)) - low if frame else (high - low) * shares) % (high - low)
    order = np.argsort(place)
    for rows in columns:
        for fault, axes in ((fault, axes) for fault in faults for axes in rows):
            curve = max(axes.lines, key=lambda line: len(np.asarray(line.get_xdata())))
            x, y = (np.asarray(data, dtype=float) for data in curve.get_data())
            bad = np.interp(x - low, place[order], fault.at[order], period=high - low) > 0.5
            past(axes, x, y, bad, " ".join(fault.words.split()[:2]))  # code and name
        if rows[0].get_legend_handles_labels()[1] and not rows[0].child_axes:  # above it are names of phases
            panels.legend_above(rows[0], 3)


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
