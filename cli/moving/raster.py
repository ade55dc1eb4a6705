"""Pictures of a scene in pixels, drawn large with Pillow and reduced: smooth edges in a few milliseconds."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from gearlink.cli.moving.stage import ChartScale, Stage
from gearlink.cli.scenes.scene import Body, Chain, Line, Mark, Points

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_FINER = 2
_WHITE, _BLACK, _GREY, _LIGHT = "#ffffff", "#222222", "#777777", "#dddddd"


@dataclass(frozen=True)
class Raster:
    """The pictures of a stage."""

    stage: Stage

    def picture(self, i: int) -> Picture:
        """The i-th picture."""
        large = self._background.copy()
        draw = ImageDraw.Draw(large)
        for part in self.stage.scene.parts:
            if isinstance(part, Body):
                self._body(draw, part, i)
            elif isinstance(part, Chain):
                self._chain(draw, part, i)
        for mark in self.stage.scene.marks:
            if mark.pivot:
                self._pivot(draw, mark.point[i : i + 1])
        self._now(draw, i)
        made = large.reduce(_FINER)
        self._words(ImageDraw.Draw(made), i)
        return made

    # Parts, on the large picture

    def _fine(self, points: Points) -> Points:
        return _FINER * self.stage.pixels(points)

    @cached_property
    def _background(self) -> Picture:
        made = Image.new("RGB", (_FINER * self.stage.width, _FINER * self.stage.height), _WHITE)
        draw = ImageDraw.Draw(made)
        for part in self.stage.scene.parts:
            if isinstance(part, Line):
                self._line(draw, part)
        if self.stage.scene.chart is not None:
            self._chart(draw, ChartScale(self.stage.scene.chart, self.stage.chart_room))
        return made

    def _line(self, draw: ImageDraw.ImageDraw, line: Line) -> None:
        points = self._fine(line.points)
        if line.fill:
            draw.polygon(_flat(points), fill=line.fill)
        width = max(1, round(line.width * _FINER))
        for stretch in _dashes(points, 7.0 * _FINER) if line.dashed else [points]:
            draw.line(_flat(stretch), fill=line.color, width=width)

    def _body(self, draw: ImageDraw.ImageDraw, body: Body, i: int) -> None:
        points = _flat(self._fine(body.place[i] + body.outline * np.exp(1j * body.turn[i])))
        if body.fill:
            draw.polygon(points, fill=body.fill)
        draw.line(points, fill=body.color, width=max(1, round(body.width * _FINER)))

    def _chain(self, draw: ImageDraw.ImageDraw, chain: Chain, i: int) -> None:
        joints = self._fine(np.array([joint[i] for joint in chain.joints]))
        width = max(1, round(chain.width * _FINER))
        for start, end in pairwise(joints):
            _bar(draw, start, end, width, chain.color)
        for joint in joints:
            _disc(draw, joint, 0.5 * width, chain.color, chain.color, 1)
            if chain.marked:
                _disc(draw, joint, 1.7 * _FINER + 0.5 * width, _WHITE, chain.color, round(1.4 * _FINER))

    def _pivot(self, draw: ImageDraw.ImageDraw, point: Points) -> None:
        size = 0.55 * self.stage.text_size * _FINER
        at = complex(self._fine(point)[0])
        foot = [at, at - size + 1.5j * size, at + size + 1.5j * size]
        draw.polygon(_flat(np.array(foot)), fill=_BLACK)
        _disc(draw, at, 0.55 * size, _WHITE, _BLACK, round(1.2 * _FINER))

    def _chart(self, draw: ImageDraw.ImageDraw, scale: ChartScale) -> None:
        room = scale.room
        for x, _ in scale.x_ticks():
            draw.line([_FINER * x, _FINER * room.top, _FINER * x, _FINER * room.bottom], fill=_LIGHT, width=_FINER)
        for y, _ in scale.y_ticks():
            draw.line([_FINER * room.left, _FINER * y, _FINER * room.right, _FINER * y], fill=_LIGHT, width=_FINER)
        corners = [room.left, room.top, room.left, room.bottom, room.right, room.bottom]
        draw.line([_FINER * corner for corner in corners], fill=_GREY, width=_FINER)
        for curve in scale.chart.curves:
            points = _FINER * scale.points(scale.chart.x, curve.y)
            draw.line(_flat(points), fill=curve.color, width=2 * _FINER, joint="curve")

    def _now(self, draw: ImageDraw.ImageDraw, i: int) -> None:
        chart = self.stage.scene.chart
        if chart is None:
            return
        scale = ChartScale(chart, self.stage.chart_room)
        for curve in chart.curves:
            at = _FINER * complex(scale.points(chart.now[i], curve.now[i]))
            _disc(draw, at, 4.5 * _FINER, curve.color, _WHITE, _FINER)

    # Words, on the reduced picture

    def _font(self, share: float = 1.0, name: str = "") -> Any:
        return ImageFont.truetype(_font_file(name), max(8, round(share * self.stage.text_size)))

    @cached_property
    def _fonts(self) -> tuple[Any, Any, Any]:
        return self._font(1.25, self.stage.title), self._font(), self._font(0.85)

    @cached_property
    def _texts(self) -> list[list[str]]:
        return self.stage.texts()

    def _words(self, draw: ImageDraw.ImageDraw, i: int) -> None:
        large, plain, small = self._fonts
        size = self.stage.text_size
        draw.text((0.9 * size, 0.6 * size), self.stage.title, font=large, fill=_BLACK)
        for k, texts in enumerate(self._texts):
            place = (0.9 * size + k * 0.24 * self.stage.width, 2.5 * size)
            draw.text(place, texts[i], font=plain, fill=_BLACK)
        for part in self.stage.scene.parts:
            if isinstance(part, Body) and part.label:
                self._label(draw, part, i)
        for mark in self.stage.scene.marks:
            self._letter(draw, mark, i)
        if self.stage.scene.chart is not None:
            self._chart_words(draw, ChartScale(self.stage.scene.chart, self.stage.chart_room), small)

    def _label(self, draw: ImageDraw.ImageDraw, body: Body, i: int) -> None:
        at = complex(self.stage.pixels(body.place[i : i + 1])[0]) + label_shift(
            body, self.stage.scale, self.stage.text_size
        )
        draw.text(
            (at.real, at.imag),
            body.label,
            font=self._fonts[1],
            fill=body.color,
            anchor="mm",
            stroke_width=2,
            stroke_fill=body.fill or _WHITE,
        )

    def _letter(self, draw: ImageDraw.ImageDraw, mark: Mark, i: int) -> None:
        if not mark.text:
            return
        at = complex(self.stage.pixels(mark.point[i : i + 1])[0]) + 0.65 * self.stage.text_size * (1 - 1j)
        draw.text(
            (at.real, at.imag),
            mark.text,
            font=self._fonts[1],
            fill=_BLACK,
            anchor="ls",
            stroke_width=2,
            stroke_fill=_WHITE,
        )

    def _chart_words(self, draw: ImageDraw.ImageDraw, scale: ChartScale, font: Any) -> None:
        room, size = scale.room, self.stage.text_size
        for x, words in scale.x_ticks():
            draw.text((x, room.bottom + 0.3 * size), words, font=font, fill=_GREY, anchor="ma")
        for y, words in scale.y_ticks():
            draw.text((room.left - 0.4 * size, y), words, font=font, fill=_GREY, anchor="rm")
        middle = 0.5 * (room.left + room.right)
        draw.text((middle, room.bottom + 1.5 * size), scale.chart.xlabel, font=font, fill=_BLACK, anchor="ma")
        draw.text((room.left, room.top - 0.35 * size), scale.chart.ylabel, font=font, fill=_BLACK, anchor="ls")
        if len(scale.chart.curves) > 1:
            self._key(draw, scale, font)

    def _key(self, draw: ImageDraw.ImageDraw, scale: ChartScale, font: Any) -> None:
        """The names of the curves in their colours, above the right end of the chart."""
        right = scale.room.right
        for curve in reversed(scale.chart.curves):
            draw.text(
                (right, scale.room.top - 0.35 * self.stage.text_size),
                curve.label,
                font=font,
                fill=curve.color,
                anchor="rs",
            )
            right -= draw.textlength(curve.label, font=font) + 1.2 * self.stage.text_size


def label_shift(body: Body, scale: float, text_size: float) -> complex:
    """From a body's axis to its label, in pixels: inside the holes of a gear, away from letters and pivots."""
    if body.repeats == 1:
        return 0j
    reach = max(0.3 * scale * float(np.abs(body.outline).max()), 1.5 * text_size)
    return complex(reach * np.exp(2.5j))


def _font_file(name: str) -> str:
    """A font that has the letters of a name, where one is installed; else the one that comes with matplotlib."""
    import matplotlib

    from gearlink.cli.plots.write import families

    *_, last = families(name)
    if last != "sans-serif":
        from matplotlib.font_manager import findfont

        return str(findfont(last))
    return str(Path(matplotlib.get_data_path()) / "fonts" / "ttf" / "DejaVuSans.ttf")


def _flat(points: Points) -> list[float]:
    flat: list[float] = np.column_stack([points.real, points.imag]).ravel().tolist()
    return flat


def _bar(draw: ImageDraw.ImageDraw, start: complex, end: complex, width: float, color: str) -> None:
    """A straight bar; Pillow's own wide lines round their corners to whole pixels and seem to bend."""
    if start == end:
        return
    side = 0.5j * width * (end - start) / abs(end - start)
    draw.polygon(_flat(np.array([start + side, end + side, end - side, start - side])), fill=color)


def _disc(draw: ImageDraw.ImageDraw, at: complex, radius: float, fill: str, edge: str, width: int) -> None:
    box = [at.real - radius, at.imag - radius, at.real + radius, at.imag + radius]
    draw.ellipse(box, fill=fill, outline=edge, width=width)


def _dashes(points: Points, length: float) -> list[Points]:
    """The dashes of a polyline, each as long as the gap behind it."""
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    edges = np.arange(0.0, along[-1], length)
    made = []
    for start in edges[::2]:
        at = np.linspace(start, min(start + length, along[-1]), 5)
        made.append(np.interp(at, along, points.real) + 1j * np.interp(at, along, points.imag))
    return made
