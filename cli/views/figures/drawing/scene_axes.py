"""Positions of a scene on the axes of a sheet: the bodies of the mechanism, to which the sheet adds its dimensions."""

from __future__ import annotations

from dataclasses import replace
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np

from gearlink.cli.views.figures.drawing import labels, panels, style
from gearlink.cli.views.scenes.scene import Arrow, Body, Chain, Line, Part, Scene, placed, points_of
from gearlink.cli.views.scenes.shown import on_disc, shifts

if TYPE_CHECKING:
    from collections.abc import Callable

    from matplotlib.axes import Axes

    from gearlink.core.numerics.arrays import Reals

_POINTS = 0.68
"""Width of a line in points for a pixel of its width in an animation."""
_REACH, _REACH_POINTS = 0.042, 11.5
"""Distance of letters from their points, in sizes of the drawing and in points."""
_ROW = 0.12
"""Height of a row of the keys, in sizes of the drawing."""
_SHORT = 5
"""Letters that go into a circle: of more it would be as large as a gear."""


AHEAD = 1e-5
"""So far ahead in the loop is the position that tells in which sense a gear turns."""
_LEAST_ARC = 0.07
"""Radius of the arc that shows how the input turns, in sizes of the drawing."""


def draw(
    axes: Axes, scene: Scene, i: int = 0, ahead: Scene | None = None, driven: tuple[complex, float] | None = None
) -> None:
    """A position of a scene with its letters; what only an animation needs is left out.

    Parameters
        ahead : Scene or None - the same a moment later: then arrows show in which sense gears and input turn
        driven : axis of the input and how far it turns meanwhile; by default the first link on a fixed pivot
    """
    shown = _position(scene, i)
    for k, part in enumerate(shown.parts):
        if isinstance(part, Chain):
            joints = [complex(joint[0]) for joint in part.joints]
            if np.isfinite(joints).all() and part.marked:
                style.link(axes, joints, part.color, _POINTS * part.width)
            elif np.isfinite(joints).all():
                axes.plot(*_xy(*joints), color=part.color, linewidth=_POINTS * part.width, zorder=3.7)
        elif isinstance(part, Arrow):
            if np.isfinite(part.start[0] + part.vector[0]):
                start, vector = complex(part.start[0]), complex(part.vector[0])
                style.arrow(axes, start, vector, part.color)
                axes.plot(*_xy(start, start + vector), color=part.color, linewidth=0.0, gid=part.name)
        elif not isinstance(part, Body) or np.isfinite(part.place[0]):
            _outline(axes, part, 2.0 + k / len(shown.parts))
    for mark in shown.marks:
        if mark.pivot:
            style.pivot(axes, complex(mark.point[0]))
    if ahead is not None:
        for center, radius, sense, color in turning(shown, _position(ahead, 0), driven):
            _sense(axes, shown, center, radius, sense, color)
    _words(axes, shown)
    _keys(axes, scene)


def _xy(*points: complex) -> tuple[list[float], list[float]]:
    return [point.real for point in points], [point.imag for point in points]


def _keys(axes: Axes, scene: Scene) -> None:
    """The scales of the arrows, in rows below the drawing."""
    if not scene.keys:
        return
    whole = points_of(scene.parts)
    left, low, size = float(whole.real.min()), float(whole.imag.min()), _size(_position(scene, 0))
    for row, key in enumerate(scene.keys):
        at = complex(left, low - _ROW * size * (row + 1.0))
        if key.length:
            style.arrow(axes, at, key.length, key.color)
        axes.plot(*_xy(at, at + key.length), color=key.color, linewidth=0.0)
        look: dict[str, Any] = {"fontsize": 7, "color": key.color, "va": "center", "annotation_clip": False}
        words = axes.annotate(key.words, (at.real + key.length, at.imag), (4, 0), textcoords="offset points", **look)
        words.set_gid(labels.KEY)


def turned(axes: Axes, design: Any, build: Callable[[Any, Reals], Scene], *fractions: float) -> Scene:
    """The first of some positions, with arrows that show in which sense it turns on; the scene of all of them."""
    scene = build(design, np.array(fractions))
    draw(axes, scene, ahead=build(design, np.array([fractions[0] + AHEAD])))
    return scene


def magnified(
    axes: Axes, box: panels.Box, scene: Scene, at: complex, reach: float, title: str, ahead: Scene | None = None
) -> Axes:
    """What stands about a point of a scene, drawn a second time in a corner; to scale, without numbers up its side."""
    detail = axes.inset_axes(box, zorder=9)
    draw(detail, scene, ahead=ahead)
    detail.set_aspect("equal")
    detail.set_xlim(at.real - reach, at.real + reach)
    detail.set_ylim(at.imag - reach, at.imag + reach)
    detail.set_yticks([])
    detail.set_title(title, loc="left", fontsize=7)
    for text in detail.texts:
        text.set_clip_on(True)
    return detail


def two_positions(axes: Axes, design: Any, build: Callable[[Any, Reals], Scene]) -> None:
    """Links and gears at the first input angle of a loop, lightly half a loop later."""
    scene = turned(axes, design, build, 0.0, 0.5)
    first, other = scene.readouts[0].values
    panels.heading(axes, f"Mechanism at input angle {style.number(first, 5)}°")
    lightly(axes, scene, 1, name=f"input angle {style.number(other, 5)}°")


def turning(
    shown: Scene, ahead: Scene, driven: tuple[complex, float] | None = None
) -> list[tuple[complex, float, int, str]]:
    """Axis, radius [mm], sense and colour of what turns in a scene: its gears, and the input, as for `draw`."""
    found = []
    for body, later in zip(shown.parts, ahead.parts, strict=True):
        if isinstance(body, Body) and isinstance(later, Body) and body.pitch:
            # A ring is two bodies: the rim that has its pitch circle, and after it the line of its teeth.
            step = float(later.turn[0] - body.turn[0])
            if abs(step) > 1e-3 * AHEAD:
                ring = body.repeats == 0 and bool(np.abs(body.outline).max() > 1.15 * body.pitch)
                found.append((complex(body.place[0]), (1.0 if ring else 0.78) * body.pitch, step, body.color))
    if driven is not None:
        found.append((driven[0], _free_radius(shown, driven[0]), driven[1], style.BLACK))
    chains = [(a, b) for a, b in zip(shown.parts, ahead.parts, strict=True) if isinstance(a, Chain) and a.marked]
    for chain, later_chain in chains[:1] if driven is None else ():
        assert isinstance(later_chain, Chain), "the same parts a moment later"
        (start, end), (fixed, moved) = chain.joints[:2], later_chain.joints[:2]
        arm = complex(end[0] - start[0])
        if abs(complex(fixed[0] - start[0])) < 1e-9 * abs(arm):
            step = float(np.angle(complex(moved[0] - fixed[0]) / arm))
            found.append((complex(start[0]), 0.5 * abs(arm), step, chain.color))
    return [(center, radius, 1 if step > 0.0 else -1, color) for center, radius, step, color in found if step]


def _free_radius(shown: Scene, axis: complex) -> float:
    """Half of the shortest bar or the smallest disc about an axis; without either a tenth of the drawing.

    Never less than `_LEAST_ARC` of it: about a hollow disc or a small eccentric the head of the arrow hid its arc.
    """
    whole = _size(shown)
    joints = [[complex(joint[0]) for joint in part.joints] for part in shown.parts if isinstance(part, Chain)]
    pairs = [pair for each in joints if len(each) > 1 for pair in (each[:2], each[:-3:-1])]
    found = [0.5 * abs(far - near) for near, far in pairs if abs(near - axis) < 1e-9 * whole]
    for body in shown.parts:
        if isinstance(body, Body) and abs(complex(body.place[0]) - axis) < 1e-9 * whole:
            found.append(0.5 * float(np.abs(body.outline).min()))
    return max(min((radius for radius in found if radius > 1e-6 * whole), default=0.1 * whole), _LEAST_ARC * whole)


def sides(scene: Scene) -> tuple[float, float]:
    """Width and height of what is drawn of all positions of a scene [mm]."""
    points = points_of(part for part in scene.parts if isinstance(part, Body | Chain))
    return float(np.ptp(points.real)), float(np.ptp(points.imag))


def _sense(axes: Axes, shown: Scene, center: complex, radius: float, sense: int, color: str) -> None:
    """An arc with an arrow about an axis, where it keeps clear of links and pivots."""
    half = min(0.5, 0.09 * _size(shown) / radius)
    arc = radius * np.exp(1j * sense * np.linspace(-half, half, 25))
    ways = np.exp(2j * np.pi * np.arange(24) / 24)
    joints = [np.array([joint[0] for joint in part.joints]) for part in shown.parts if isinstance(part, Chain)]
    links = [a + (b - a) * np.linspace(0.0, 1.0, 41) for chain in joints for a, b in pairwise(chain)]
    marks = [np.array([mark.point[0] for mark in shown.marks])]
    taken = np.concatenate([*links, *marks]) if links or shown.marks else np.array([center])
    room = [float(np.abs((center + arc * way)[:, None] - taken[None, :]).min()) for way in ways]
    points = center + arc * ways[int(np.argmax(room))]
    axes.plot(points.real, points.imag, color=color, linewidth=1.1, zorder=3.9, gid="sense")
    style.arrow(axes, complex(points[-2]), complex(points[-1] - points[-2]), color)


def lightly(axes: Axes, scene: Scene, i: int, color: str = style.GREY, name: str = "_", line: Any = "-") -> None:
    """Another position of a scene: its links, its sliders, and the pitch circles of gears whose axes have moved."""
    for part in _position(scene, i).parts:
        if isinstance(part, Chain) and part.marked:
            joints = [complex(joint[0]) for joint in part.joints]
            style.link(axes, joints, color, 0.5 * _POINTS * part.width, label=name, zorder=3.6, linestyle=line)
            name = "_"
    for body in scene.parts:
        if not isinstance(body, Body) or body.shows_turn or np.array_equal(placed(body, i), placed(body, 0)):
            continue
        if body.pitch and body.place[i] != body.place[0]:
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
        elif isinstance(part, Arrow):
            parts.append(replace(part, start=part.start[here], vector=part.vector[here]))
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
        style.area(axes, points, facecolor=part.fill, edgecolor=part.color, gid=gid, **look)
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
        if not np.isfinite(mark.point[0]):
            continue
        away = _REACH_POINTS * shift / reach
        style.letter(axes, complex(mark.point[0]), mark.text, (away.real, away.imag))
    labelled = [part for part in shown.parts if isinstance(part, Body) and part.label]
    for body, shift in zip(labelled, on, strict=True):
        at = complex(body.place[0]) + shift
        shape = "circle,pad=0.2" if len(body.label) <= _SHORT else "round,pad=0.3"
        box = {"boxstyle": shape, "facecolor": "white", "edgecolor": body.color, "linewidth": 1.2}
        look: dict[str, Any] = {"fontsize": 8, "ha": "center", "va": "center", "zorder": 6}
        axes.text(at.real, at.imag, body.label, bbox=box if body.pitch else None, **look)


def _size(shown: Scene) -> float:
    """The greater side of the drawing [mm]."""
    points = points_of(part for part in shown.parts if not isinstance(part, Arrow))
    return float(max(np.ptp(points.real), np.ptp(points.imag)))
