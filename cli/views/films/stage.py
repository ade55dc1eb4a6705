"""Where a scene stands on its pictures: from mm to pixels, the room of mechanism and chart, the texts."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from gearlink.cli.views.scenes import shown
from gearlink.cli.views.scenes.scene import Arrow, Body, Chain, Chart, Line, Part, Points, Readout, Reals, Scene

_FAULTS = 3
VALUES_ROOM, FAULT_ROW = 3.9, 1.2
"""Height of title and values, and of a line of what fails, by that of the text."""
_ROW = 1.15
"""Height of a row of keys, by that of the text."""


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle in pixels, y downwards."""

    left: float
    top: float
    right: float
    bottom: float

    @property
    def width(self) -> float:
        """Its width."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """Its height."""
        return self.bottom - self.top

    @property
    def sides(self) -> tuple[float, float, float, float]:
        """Left, top, right, bottom."""
        return self.left, self.top, self.right, self.bottom


@dataclass(frozen=True)
class Stage:
    """A scene on a picture of width x height pixels."""

    scene: Scene
    title: str
    width: int
    height: int
    bare: bool = False
    """Without room for a title and values."""
    reach: tuple[float, float, float, float] | None = None
    """Of what is to have room, x from, x to, y from, y to [mm]; None: of the scene itself."""

    @property
    def count(self) -> int:
        """How many pictures the loop has."""
        return len(self.scene.marks[0].point)

    @property
    def text_size(self) -> int:
        """Height of the letters in pixels."""
        return max(9, round(min(self.height / 45.0, self.width / 55.0)))

    @cached_property
    def head(self) -> float:
        """Height of title, values and what fails at any picture."""
        most = max((len(self.failing(i)) for i in range(self.count)), default=0) if self.scene.faults else 0
        return 0.0 if self.bare else (VALUES_ROOM + FAULT_ROW * most) * self.text_size

    @property
    def _edge(self) -> float:
        """About the mechanism: without a head letters that stand above it need more."""
        return (1.7 if self.bare else 0.9) * self.text_size

    @property
    def _foot(self) -> float:
        """Below the keys of arrows."""
        if self.scene.chart is None:
            return self.height - 0.9 * self.text_size
        return self.chart_room.top - 1.6 * self.text_size

    @property
    def room(self) -> Box:
        """The room of the mechanism, above the keys of arrows."""
        edge = self._edge
        return Box(edge, self.head + edge, self.width - edge, self._foot - _ROW * self.text_size * len(self.scene.keys))

    @property
    def chart_room(self) -> Box:
        """The room of the chart between its axes."""
        size = self.text_size
        return Box(5.2 * size, 0.77 * self.height, self.width - 1.6 * size, self.height - 3.1 * size)

    @cached_property
    def own_reach(self) -> tuple[float, float, float, float]:
        """What parts and marks reach over all pictures: x from, x to, y from, y to [mm]."""
        reaches = [reach for part in self.scene.parts for reach in _reaches(part)]
        reaches += [(mark.point, 0.0) for mark in self.scene.marks]
        reaches = [(p[np.isfinite(p)], r) for p, r in reaches if np.isfinite(p).any()]
        x = [(float(p.real.min()) - r, float(p.real.max()) + r) for p, r in reaches]
        y = [(float(p.imag.min()) - r, float(p.imag.max()) + r) for p, r in reaches]
        return min(a for a, _ in x), max(b for _, b in x), min(a for a, _ in y), max(b for _, b in y)

    @property
    def _extent(self) -> tuple[float, float, float, float]:
        return self.reach or self.own_reach

    @property
    def needed_height(self) -> int:
        """Height of a picture of this width that the mechanism fills, from a third of the width on [pixels]."""
        left, right, low, high = self._extent
        edge = 2.0 * self._edge
        return round(max((high - low) * (self.width - edge) / (right - left) + edge + self.head, self.width / 3.0))

    @cached_property
    def scale(self) -> float:
        """Pixels per mm."""
        left, right, low, high = self._extent
        return min(self.room.width / (right - left), self.room.height / (high - low))

    @cached_property
    def _origin(self) -> complex:
        left, right, low, high = self._extent
        room = self.room
        x = 0.5 * (room.left + room.right) - self.scale * 0.5 * (left + right)
        return complex(x, 0.5 * (room.top + room.bottom) + self.scale * 0.5 * (low + high))

    @property
    def extent(self) -> Box:
        """What parts and marks reach over all pictures [pixels]."""
        left, right, low, high = self._extent
        corners = self.pixels(np.array([complex(left, high), complex(right, low)]))
        return Box(float(corners[0].real), float(corners[0].imag), float(corners[1].real), float(corners[1].imag))

    def pixels(self, points: Points) -> Points:
        """Points of the machine on the picture, y downwards."""
        return self._origin + self.scale * np.conj(points)

    def place(self, pixel: complex) -> complex:
        """The point of the machine [mm] at a place of the picture."""
        return (pixel - self._origin).conjugate() / self.scale

    @cached_property
    def shifts(self) -> tuple[list[complex], list[complex]]:
        """From points to letters, and from axes to the labels of bodies, in pixels: the same in all pictures."""

        def reach(body: Body) -> float:
            # Inside the holes of a gear, and on the pitch circle of a ring.
            if body.repeats == 0 and body.pitch:
                return body.pitch
            holes = max(0.3 * body.pitch, 1.5 * self.text_size / self.scale)
            return holes if body.pitch else shown.on_disc(body)

        found = shown.shifts(self.scene, 1.05 * self.text_size / self.scale, reach)
        letters, labels = ([self.scale * shift.conjugate() for shift in each] for each in found)
        return letters, labels

    def scales(self) -> list[tuple[complex, float, str, str]]:
        """Where the key of each arrow stands, its length [pixels], its words and colour: rows from the lower left."""
        size, keys = self.text_size, self.scene.keys
        rows = [complex(self.room.left, self._foot - _ROW * size * (len(keys) - k - 0.5)) for k in range(len(keys))]
        return [(at, self.scale * key.length, key.words, key.color) for at, key in zip(rows, keys, strict=True)]

    def framed(self, i: int) -> bool:
        """Whether something is known to fail at a picture."""
        return any(fault.placed and fault.at[i] for fault in self.scene.faults)

    def failing(self, i: int) -> list[str]:
        """What fails at a picture, at most three lines of it."""
        words = [fault.words for fault in self.scene.faults if fault.at[i]]
        return words if len(words) <= _FAULTS else [*words[: _FAULTS - 1], f"and {len(words) - _FAULTS + 1} more"]

    def texts(self) -> list[list[str]]:
        """The values beside each picture, one list per value."""
        return [readings(readout) for readout in self.scene.readouts]


def readings(readout: Readout) -> list[str]:
    """A value at each picture with so many decimals that four digits of the largest are seen.

    Example
        >>> readings(Readout("crank", "°", np.array([0.0, 180.0])))
        ['crank 0.0°', 'crank 180.0°']
    """
    largest = float(np.abs(readout.values).max())
    places = 3 if largest <= 0.0 else max(0, min(6, 3 - math.floor(math.log10(largest) + 1e-9)))
    if readout.unit == "°":
        places = 1
    # What rounds to zero is shown without a sign.
    return [
        f"{readout.label} {round(value, places) + 0.0:.{places}f}{readout.unit}" for value in readout.values.tolist()
    ]


def _reaches(part: Part) -> list[tuple[Points, float]]:
    """Points that a part passes, with the distance that it reaches about them."""
    if isinstance(part, Line):
        return [(part.points, 0.0)]
    if isinstance(part, Chain):
        return [(joint, 0.0) for joint in part.joints]
    if isinstance(part, Arrow):
        return [(part.start + part.vector, 0.0)]
    if part.repeats != 1:
        return [(part.place, float(np.abs(part.outline).max()))]
    few = part.outline[:: max(1, len(part.outline) // 90)]
    passed = part.place[:, None] + few[None, :] * np.exp(1j * part.turn)[:, None]
    return [(passed.ravel(), 0.0)]


@dataclass(frozen=True)
class ChartScale:
    """A chart in its room: from its values to pixels, and round numbers along its axes."""

    chart: Chart
    room: Box

    @cached_property
    def y_range(self) -> tuple[float, float]:
        """What the y axis shows."""
        low = min(float(curve.y.min()) for curve in self.chart.curves)
        high = max(float(curve.y.max()) for curve in self.chart.curves)
        pad = 0.06 * (high - low) or 1.0
        return low - pad, high + pad

    def points(self, x: Reals, y: Reals) -> Points:
        """Points of the chart in pixels."""
        (left, right), (low, high) = (float(self.chart.x[0]), float(self.chart.x[-1])), self.y_range
        across = self.room.left + self.room.width * (x - left) / (right - left)
        return np.asarray(across + 1j * (self.room.bottom - self.room.height * (y - low) / (high - low)))

    def x_values(self) -> Sequence[float]:
        """Round numbers along the x axis."""
        return ticks(float(self.chart.x[0]), float(self.chart.x[-1]), 8)

    def y_values(self) -> Sequence[float]:
        """Round numbers along the y axis."""
        return ticks(*self.y_range, 5)

    def x_ticks(self) -> list[tuple[float, str]]:
        """Places in pixels and numbers of the x axis."""
        return [(float(self.points(np.array(v), np.array(0.0)).real), _signed(v)) for v in self.x_values()]

    def y_ticks(self) -> list[tuple[float, str]]:
        """Places in pixels and numbers of the y axis."""
        return [(float(self.points(np.array(0.0), np.array(v)).imag), _signed(v)) for v in self.y_values()]


def _signed(value: float) -> str:
    return f"{value:g}".replace("-", "−")


def ticks(low: float, high: float, most: int) -> Sequence[float]:
    """Round numbers from low to high, at most so many.

    Example
        >>> ticks(0.0, 360.0, 8), ticks(-1.2, 3.4, 4)
        ([0.0, 60.0, 120.0, 180.0, 240.0, 300.0, 360.0], [0.0, 2.0])
    """
    span = high - low
    power = 10.0 ** math.floor(math.log10(span))
    steps = [factor * power * scale for scale in (0.1, 1.0) for factor in (1.0, 2.0, 5.0)]
    if abs(span / 60.0 - round(span / 60.0)) < 1e-9 and span >= 180.0:
        steps = [60.0, 90.0, 180.0, 360.0, *steps]
    step = next((s for s in steps if span / s <= most - 1 + 1e-9), power * 10.0)
    first = math.ceil(low / step - 1e-9)
    return [k * step + 0.0 for k in range(first, math.floor(high / step + 1e-9) + 1)]
