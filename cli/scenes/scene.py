"""What a moving picture is made of: rigid bodies, chains of links and fixed lines, over the pictures of one loop.

Tracks are arrays over the pictures; points are complex numbers in mm.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

Reals: TypeAlias = NDArray[np.float64]
# Complex, or real where all lies on the x axis.
Points: TypeAlias = NDArray[np.inexact[Any]]

TURN = 2.0 * np.pi


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """An outline that moves as one piece.

    outline : (M,) points in the body's own frame
    place, turn : (N,) tracks of its origin and of the direction of its x axis [rad]
    repeats : after a turn by 2 pi/repeats the outline looks the same; 1 without such a symmetry, 0 for a circle
    """

    outline: Points
    place: Points
    turn: Reals
    repeats: int = 1
    color: str
    fill: str = ""
    width: float = 1.2
    closed: bool = True
    label: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Chain:
    """Links from joint to joint, each joint a track; drawn with a circle at every joint."""

    joints: tuple[Points, ...]
    color: str
    width: float = 3.5
    marked: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A line that stands still."""

    points: Points
    color: str
    width: float = 1.0
    dashed: bool = False
    fill: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Mark:
    """Letters at a point that may move, or a fixed pivot."""

    point: Points
    text: str = ""
    pivot: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Curve:
    """A curve of the chart: its values over the loop, and at each picture."""

    label: str
    color: str
    y: Reals
    now: Reals


@dataclass(frozen=True, slots=True, kw_only=True)
class Chart:
    """A chart below the mechanism with a point that runs along."""

    xlabel: str
    ylabel: str
    x: Reals
    now: Reals
    curves: tuple[Curve, ...]


@dataclass(frozen=True, slots=True, kw_only=True)
class Readout:
    """A value that is shown with every picture."""

    label: str
    unit: str
    values: Reals


Part: TypeAlias = Body | Chain | Line


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """All of a moving picture; parts are drawn in their order."""

    parts: tuple[Part, ...]
    marks: tuple[Mark, ...] = ()
    chart: Chart | None = None
    readouts: tuple[Readout, ...] = ()


def track(value: Any, fraction: Reals) -> Points:
    """A point, standing or moving, as a track."""
    return np.broadcast_to(np.asarray(value, dtype=np.complex128), fraction.shape)


def steady(value: Any, fraction: Reals) -> Reals:
    """A real value as a track."""
    return np.broadcast_to(np.asarray(value, dtype=np.float64), fraction.shape)


def circle(radius: float, count: int = 72) -> Points:
    """A closed circle about the origin."""
    return np.asarray(radius * np.exp(1j * TURN * np.arange(count + 1) / count))


def fixed_circle(center: complex, radius: float, color: str, *, dashed: bool = False, width: float = 1.0) -> Line:
    """A circle that stands still."""
    return Line(points=center + circle(radius, 120), color=color, dashed=dashed, width=width)


def standing(points: Points, fraction: Reals, color: str) -> Body:
    """A line that stands still in front of what is drawn before it."""
    return Body(
        outline=points,
        place=track(0.0, fraction),
        turn=np.zeros_like(fraction),
        color=color,
        width=1.5,
        closed=False,
    )


def wheel(place: Any, radius: float, fraction: Reals, *, color: str, fill: str, label: str = "") -> Body:
    """A plain disc, such as a roller: it looks the same at every turn."""
    return Body(
        outline=circle(radius),
        place=track(place, fraction),
        turn=np.zeros_like(fraction),
        color=color,
        fill=fill,
        repeats=0,
        label=label,
    )


def loop(samples: int = 181) -> Reals:
    """Fractions of the loop for a chart, both ends included."""
    return np.linspace(0.0, 1.0, samples)


def pale(color: str, share: float = 0.18) -> str:
    """A colour mixed with white: fills are opaque, so that parts in front hide those behind.

    Example
        >>> pale("#000000", 0.2)
        '#cccccc'
    """
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - part)):02x}" for part in parts)
