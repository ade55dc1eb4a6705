"""Positions of a scene on the axes of a sheet: the bodies of the mechanism, to which the sheet adds its dimensions."""

from __future__ import annotations

from dataclasses import replace
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.figures import style
from gearlink.cli.scenes.lettering import on_disc, shifts
from gearlink.cli.scenes.scene import Body, Chain, Line, Part, Points, Scene, placed

if TYPE_CHECKING:
    from matplotlib.axes import Axes

_POINTS = 0.68
"""Width of a line in points for a pixel of its width in a film."""
_REACH, _REACH_POINTS = 0.042, 11.5
"""Distance of letters from their points, in sizes of the drawing and in points."""


def draw(axes: Axes, scene: Scene, i: int = 0) -> None:
    """A position of a scene with its letters; what only a film needs is left out."""
    shown = _position(scene, i)
    for k, part in enumerate(shown.parts):
        if isinstance(part, Chain):
            style.link(axes, [complex(joint[0]) for joint in part.joints], part.color, _POINTS * part.width)
        else:
            _outline(axes, part, 2.0 + k / len(shown.parts))
    for mark in shown.marks:
        if mark.pivot:
            style.pivot(axes, complex(mark.point[0]))
    _words(axes, shown)


def lightly(axes: Axes, scene: Scene, i: int, color: str = style.GREY, name: str = "_", shown: int = 0) -> None:
    """Another position of a scene: its links, its sliders, and the pitch circles of gears whose axes have moved."""
    for part in _position(scene, i).parts:
        if isinstance(part, Chain) and part.marked:
            joints = [complex(joint[0]) for joint in part.joints]
            style.link(axes, joints, color, 0.5 * _POINTS * part.width, label=name, zorder=3.6)
            name = "_"
    for body in scene.parts:
        if not isinstance(body, Body) or body.shows_turn or np.array_equal(placed(body, i), placed(body, shown)):
            continue
        if body.pitch and body.place[i] != body.place[shown]:
            look = {"color": color, "linewidth": 0.8, "alpha": 0.7, "linestyle": style.DASHED}
            style.circle(axes, complex(body.place[i]), body.pitch, **look, zorder=3.4)
        elif body.repeats == 1 and not body.pitch:
            points = placed(body, i)
            axes.plot(points.real, points.imag, color=color, linewidth=0.9, zorder=3.5)


def _position(scene: Scene, i: int) -> Scene:
    """One position of a scene, without what shows the turning."""
    here = slice(i, i + 1)
    parts: list[Part] = []
    for part in scene.parts:
        if isinstance(part, Line):
            parts.append(part)
        elif isinstance(part, Chain):
            parts.append(replace(part, joints=tuple(joint[here] for joint in part.joints)))
        elif not part.shows_turn:
            parts.append(replace(part, place=part.place[here], turn=part.turn[here]))
    return Scene(parts=tuple(parts), marks=tuple(replace(mark, point=mark.point[here]) for mark in scene.marks))


def _outline(axes: Axes, part: Body | Line, order: float) -> None:
    """A body filled, a line as it is; the pitch circle of a gear with it."""
    points = placed(part, 0) if isinstance(part, Body) else part.points
    look: dict[str, Any] = {"linewidth": _POINTS * part.width, "label": part.name or "_", "zorder": order}
    if isinstance(part, Line):
        dashes = style.DASHED if part.dashed else "-"
        axes.plot(points.real, points.imag, color=part.color, **{**look, "zorder": 3.2}, linestyle=dashes)
    elif part.fill:
        gid = f"body-{part.label}" if part.label else None
        axes.fill(points.real, points.imag, facecolor=part.fill, edgecolor=part.color, gid=gid, **look)
    elif not part.pitch:
        axes.plot(points.real, points.imag, color=part.color, **look)
    if isinstance(part, Body) and part.pitch:
        center, dashes = complex(part.place[0]), {"linestyle": style.CHAIN, "zorder": 3.1}
        style.circle(axes, center, part.pitch, color=part.color, linewidth=0.9, gid=f"pitch-{part.label}", **dashes)


def _words(axes: Axes, shown: Scene) -> None:
    """The letters of the joints, and the words on bodies: on a gear in a ring on its pitch circle."""
    reach = _REACH * _size(shown)
    beside, on = shifts(shown, reach, lambda body: body.pitch or on_disc(body))
    for mark, shift in zip(shown.marks, beside, strict=True):
        away = _REACH_POINTS * shift / reach
        style.letter(axes, complex(mark.point[0]), mark.text, (away.real, away.imag))
    labelled = [part for part in shown.parts if isinstance(part, Body) and part.label]
    for body, shift in zip(labelled, on, strict=True):
        at = complex(body.place[0]) + shift
        box = {"boxstyle": "circle,pad=0.2", "facecolor": "white", "edgecolor": body.color, "linewidth": 1.2}
        look: dict[str, Any] = {"fontsize": 8, "ha": "center", "va": "center", "zorder": 6}
        axes.text(at.real, at.imag, body.label, bbox=box if body.pitch else None, **look)


def _size(shown: Scene) -> float:
    """The greater side of the drawing [mm]."""
    reached: list[Points] = [placed(part, 0) for part in shown.parts if isinstance(part, Body)]
    reached += [joint for part in shown.parts if isinstance(part, Chain) for joint in part.joints]
    reached += [part.points for part in shown.parts if isinstance(part, Line)]
    sides = [[part for p in reached for part in (side(p).min(), side(p).max())] for side in (np.real, np.imag)]
    return float(max(max(side) - min(side) for side in sides))
