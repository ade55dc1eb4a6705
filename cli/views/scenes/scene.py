"""What a picture of a mechanism is made of: bodies, chains of links, fixed lines, over the positions of a loop.

A sheet draws one position or a few of it, a film all of them. Tracks are arrays over the positions; points are complex
numbers in mm.

The colours of all pictures stay apart for colour-blind readers and in grey print (Okabe and Ito).
"""

from __future__ import annotations

import math
from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any, TypeAlias

import numpy as np
from numpy.typing import NDArray

BLUE, ORANGE, GREEN, RED = "#0072B2", "#E69F00", "#009E73", "#D55E00"
PURPLE, SKY, BLACK = "#CC79A7", "#56B4E9", "#222222"
DWELL, STEP = "#CFE8F7", "#F9D9A8"
"""Bands of a dwell and of a back-step."""
PHASE_TINTS = {
    "lead-in": "#FBE3C8",
    "accelerate": "#FBE3C8",
    "rise": "#FBE3C8",
    "sync": "#CFE8F7",
    "constant": "#CFE8F7",
    "transition": "#FDF3C0",
    "decelerate": "#FDF3C0",
    "return": "#E6D9EE",
    "forward": "#CFE8F7",
    "back": "#E6D9EE",
    "contact": "#CFE8F7",
    "free": "#F2F2F2",
    "fall": "#E6D9EE",
    "far-dwell": "#E4E4E4",
    "dwell": "#F2F2F2",
    "near-dwell": "#F2F2F2",
}
"""Phases of a motion."""
GREY, LIGHT, WHITE = "#777777", "#DDDDDD", "#ffffff"
WRONG = "#D00000"
"""What fails."""


def pale(color: str, share: float = 0.18) -> str:
    """A colour mixed with white: fills are opaque, so that parts in front hide those behind.

    Example
        >>> pale("#000000", 0.2)
        '#cccccc'
    """
    parts = (int(color[i : i + 2], 16) for i in (1, 3, 5))
    return "#" + "".join(f"{round(255 - share * (255 - part)):02x}" for part in parts)


Reals: TypeAlias = NDArray[np.float64]
# Complex, or real where all lies on the x axis.
Points: TypeAlias = NDArray[np.inexact[Any]]

TURN = 2.0 * np.pi


def drawn(words: str) -> str:
    """Words of a message as a picture has them.

    Example
        >>> drawn("acceleration 12 rad/s^2 (limit <= 9)")
        'acceleration 12 rad/s² (limit ≤ 9)'
    """
    return words.replace("^2", "²").replace("<=", "≤").replace(">=", "≥")


@dataclass(frozen=True, slots=True, kw_only=True)
class Body:
    """An outline that moves as one piece.

    outline : (M,) points in the body's own frame
    place, turn : (N,) tracks of its origin and of the direction of its x axis [rad]
    repeats : after a revolution by 2 pi/repeats the outline looks the same; 1 without such a symmetry, 0 for a circle
    label, name : words on the body, and in a legend
    pitch : radius of the pitch circle of a gear [mm]
    shows_turn : there to show how far something has turned; left out where nothing moves
    """

    outline: Points
    place: Points
    turn: Reals
    repeats: int = 1
    color: str
    fill: str = ""
    width: float = 1.2
    label: str = ""
    name: str = ""
    pitch: float = 0.0
    shows_turn: bool = False


@dataclass(frozen=True, slots=True, kw_only=True)
class Chain:
    """Links from joint to joint, each joint a track; drawn with a circle at every joint."""

    joints: tuple[Points, ...]
    color: str = BLACK
    width: float = 3.5
    marked: bool = True


@dataclass(frozen=True, slots=True, kw_only=True)
class Line:
    """A line that stands still."""

    points: Points
    color: str = GREY
    width: float = 1.0
    dashed: bool = False
    name: str = ""


@dataclass(frozen=True, slots=True)
class Mark:
    """Letters at a point that may move, or a fixed pivot."""

    point: Points
    text: str = ""
    pivot: bool = False


@dataclass(frozen=True, slots=True)
class Curve:
    """A curve of the chart: its values over the loop, and at each position."""

    label: str
    color: str
    y: Reals
    now: Reals


@dataclass(frozen=True, slots=True)
class Band:
    """A stretch of the chart that has a name: a dwell, a phase."""

    name: str
    start: float
    end: float
    color: str = "#CFE8F7"


@dataclass(frozen=True, slots=True)
class Chart:
    """A chart below the mechanism with a point that runs along."""

    xlabel: str
    ylabel: str
    x: Reals
    now: Reals
    curves: tuple[Curve, ...]
    bands: tuple[Band, ...] = ()


@dataclass(frozen=True, slots=True)
class Readout:
    """A value that is shown with every position."""

    label: str
    unit: str
    values: Reals


@dataclass(frozen=True, slots=True, kw_only=True)
class Arrow:
    """A vector at a point; where either is NaN there is none.

    start, vector : (N,) tracks [mm of the drawing]
    name : what it is, in the legend
    """

    start: Points
    vector: Points
    color: str
    name: str = ""


@dataclass(frozen=True, slots=True)
class Key:
    """An arrow of known length that tells the scale of others.

    length : float [mm of the drawing]; 0: words alone
    """

    words: str
    color: str
    length: float


@dataclass(frozen=True, slots=True)
class Fault:
    """What fails, in words, and at which positions; where no place of the loop is known to fail it is said at all."""

    words: str
    at: NDArray[np.bool_]
    placed: bool = True


Part: TypeAlias = Body | Chain | Line | Arrow


@dataclass(frozen=True, slots=True, kw_only=True)
class Scene:
    """All of a picture; parts are drawn in their order."""

    parts: tuple[Part, ...]
    marks: tuple[Mark, ...] = ()
    chart: Chart | None = None
    readouts: tuple[Readout, ...] = ()
    keys: tuple[Key, ...] = ()
    faults: tuple[Fault, ...] = ()
    own: tuple[int, int, int] | None = None
    """First part of the mechanism, the one after its last, its number of marks; None: all belong to it."""


def round_below(value: float) -> float:
    """The greatest of 1, 2, 5 times a power of ten that is no more than a number.

    Example
        >>> round_below(370.0), round_below(1.0)
        (200.0, 1.0)
    """
    power = 10.0 ** math.floor(math.log10(value))
    return max((step * power for step in (1.0, 2.0, 5.0) if step * power <= value * (1.0 + 1e-12)), default=power)


def track(value: Any, fraction: Reals) -> Points:
    """A point, standing or moving, as a track."""
    return np.broadcast_to(np.asarray(value, dtype=np.complex128), fraction.shape)


def letters(pivots: str, **points: Points) -> tuple[Mark, ...]:
    """Marks of joints by their letters; those named first are pivots of the frame."""
    return tuple(Mark(point, name, name in pivots) for name, point in points.items())


def placed(body: Body, i: int) -> Points:
    """The outline of a body in a position."""
    return np.asarray(body.place[i] + body.outline * np.exp(1j * body.turn[i]))


def points_of(parts: Iterable[Part]) -> Points:
    """All points that parts have in any position; what is not there has none."""
    found: list[Points] = [np.zeros(0, dtype=np.complex128)]
    for part in parts:
        if isinstance(part, Body):
            found += [placed(part, i) for i in range(len(part.place))]
        elif isinstance(part, Chain):
            found += part.joints
        else:
            found.append(part.points if isinstance(part, Line) else part.start + part.vector)
    whole = np.concatenate(found)
    return np.asarray(whole[np.isfinite(whole)])


def circle(radius: float, count: int = 72) -> Points:
    """A closed circle about the origin."""
    return np.asarray(radius * np.exp(1j * TURN * np.arange(count + 1) / count))


def fixed_circle(radius: float, name: str = "") -> Line:
    """A dashed circle about the origin that stands still."""
    return Line(points=circle(radius, 120), dashed=True, name=name)


def bands(stretches: Iterable[tuple[str, float, float, str]]) -> tuple[Band, ...]:
    """Stretches of a loop, name, start, end and colour each.

    One that passes the end of the loop is two bands, the longer one with the name.

    Example
        >>> [(band.name, band.start, band.end) for band in bands([("dwell", 300.0, 400.0, "#cccccc")])]
        [('dwell', 300.0, 360.0), ('', 0.0, 40.0)]
        >>> [(band.name, band.start, band.end) for band in bands([("dwell", 345.0, 445.0, "#cccccc")])]
        [('', 345.0, 360.0), ('dwell', 0.0, 85.0)]
    """
    found = []
    for name, start, end, color in stretches:
        first = start % 360.0
        last = first + end - start
        over = max(0.0, last - 360.0)
        first_is_longer = 360.0 - first >= over
        found.append(Band(name if first_is_longer else "", first, min(last, 360.0), color))
        if over:
            found.append(Band("" if first_is_longer else name, 0.0, over, color))
    return tuple(found)


def wheel(place: Any, radius: float, fraction: Reals, *, color: str, fill: str, name: str = "") -> Body:
    """A plain disc, such as a roller: it looks the same at every revolution."""
    at, level = track(place, fraction), np.zeros_like(fraction)
    return Body(outline=circle(radius), place=at, turn=level, color=color, fill=fill, repeats=0, name=name)


def block(place: Points, width: float, height: float, color: str, label: str = "", *, fill: str = "") -> Body:
    """A rectangle about a moving point."""
    corners = 0.5 * (np.array([-1.0, 1.0, 1.0, -1.0, -1.0]) * width + 1j * np.array([-1, -1, 1, 1, -1]) * height)
    level = np.zeros(len(place))
    return Body(outline=corners, place=place, turn=level, color=color, fill=fill or pale(color), label=label)


def loop(samples: int = 181) -> Reals:
    """Fractions of the loop for a chart, both ends included."""
    return np.linspace(0.0, 1.0, samples)
