"""Pictures of a scene in pixels: what moves is drawn large with Pillow, reduced, and put on the backdrop."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import ImageDraw

from gearlink.cli.moving.backdrop import backdrop
from gearlink.cli.moving.brush import FINER, bar, disc, flat, font
from gearlink.cli.moving.stage import ChartScale, Stage
from gearlink.cli.scenes.colors import BLACK, WHITE
from gearlink.cli.scenes.scene import Body, Chain, Points, placed

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_DOT = 7
"""Half the side of the square that the point on a curve is drawn in."""


@dataclass(frozen=True)
class Raster:
    """The pictures of a stage."""

    stage: Stage

    def picture(self, i: int) -> Picture:
        """The i-th picture."""
        left, top, _, _ = self._moving_room
        large = self._moving_backdrop.copy()
        self._move(ImageDraw.Draw(large), i)
        made = self._reduced.copy()
        made.paste(large.reduce(FINER), (left, top))
        self._dots(made, i)
        self._words(ImageDraw.Draw(made), i)
        return made

    # Backdrops

    @cached_property
    def _large(self) -> Picture:
        return backdrop(self.stage)

    @cached_property
    def _reduced(self) -> Picture:
        return self._large.reduce(FINER)

    @cached_property
    def _moving_room(self) -> tuple[int, int, int, int]:
        """What the mechanism reaches with its strokes, in whole pixels: smaller pictures are drawn faster."""
        extent, edge = self.stage.extent, 1.5 * self.stage.text_size
        left, top = max(0, int(extent.left - edge)), max(0, int(extent.top - edge))
        right, bottom = int(extent.right + edge) + 1, int(extent.bottom + edge) + 1
        return left, top, min(right, self.stage.width), min(bottom, self.stage.height)

    @cached_property
    def _moving_backdrop(self) -> Picture:
        left, top, right, bottom = (FINER * side for side in self._moving_room)
        return self._large.crop((left, top, right, bottom))

    # Parts, on the large picture

    def _fine(self, points: Points) -> Points:
        left, top, _, _ = self._moving_room
        return np.asarray(FINER * (self.stage.pixels(points) - complex(left, top)))

    def _move(self, draw: ImageDraw.ImageDraw, i: int) -> None:
        for part in self.stage.scene.parts:
            if isinstance(part, Body):
                self._body(draw, part, i)
            elif isinstance(part, Chain):
                self._chain(draw, part, i)
        for mark in self.stage.scene.marks:
            if mark.pivot:
                self._pivot(draw, mark.point[i : i + 1])

    def _body(self, draw: ImageDraw.ImageDraw, body: Body, i: int) -> None:
        points = flat(self._fine(placed(body, i)))
        if body.fill:
            draw.polygon(points, fill=body.fill)
        draw.line(points, fill=body.color, width=max(1, round(body.width * FINER)))

    def _chain(self, draw: ImageDraw.ImageDraw, chain: Chain, i: int) -> None:
        joints = self._fine(np.array([joint[i] for joint in chain.joints]))
        width = max(1, round(chain.width * FINER))
        for start, end in pairwise(joints):
            bar(draw, start, end, width, chain.color)
        for joint in joints:
            disc(draw, joint, 0.5 * width, chain.color, chain.color, 1)
            if chain.marked:
                disc(draw, joint, 1.7 * FINER + 0.5 * width, WHITE, chain.color, round(1.4 * FINER))

    def _pivot(self, draw: ImageDraw.ImageDraw, point: Points) -> None:
        size = 0.55 * self.stage.text_size * FINER
        at = complex(self._fine(point)[0])
        foot = [at, at - size + 1.5j * size, at + size + 1.5j * size]
        draw.polygon(flat(np.array(foot)), fill=BLACK)
        disc(draw, at, 0.55 * size, WHITE, BLACK, round(1.2 * FINER))

    # Points on the curves, and words, on the reduced picture

    def _dots(self, made: Picture, i: int) -> None:
        chart = self.stage.scene.chart
        if chart is None:
            return
        scale = ChartScale(chart, self.stage.chart_room)
        for curve in chart.curves:
            at = complex(scale.points(chart.now[i], curve.now[i]))
            left, top = round(at.real) - _DOT, round(at.imag) - _DOT
            square = made.crop((left, top, left + 2 * _DOT, top + 2 * _DOT))
            large = square.resize((2 * _DOT * FINER, 2 * _DOT * FINER), 0)
            disc(ImageDraw.Draw(large), FINER * (at - complex(left, top)), 4.5 * FINER, curve.color, WHITE, FINER)
            made.paste(large.reduce(FINER), (left, top))

    @cached_property
    def _font(self) -> Any:
        return font(self.stage.text_size)

    @cached_property
    def _texts(self) -> list[list[str]]:
        return self.stage.texts()

    def _words(self, draw: ImageDraw.ImageDraw, i: int) -> None:
        size = self.stage.text_size
        for k, texts in enumerate(self._texts):
            place = (0.9 * size + k * 0.24 * self.stage.width, 2.5 * size)
            draw.text(place, texts[i], font=self._font, fill=BLACK)
        letters, labels = self.stage.shifts
        labelled = [part for part in self.stage.scene.parts if isinstance(part, Body) and part.label]
        for body, shift in zip(labelled, labels, strict=True):
            self._haloed(draw, self._pixel(body.place, i) + shift, body.label, body.color, body.fill or WHITE)
        for mark, shift in zip(self.stage.scene.marks, letters, strict=True):
            if mark.text:
                self._haloed(draw, self._pixel(mark.point, i) + shift, mark.text, BLACK, WHITE)

    def _pixel(self, points: Points, i: int) -> complex:
        return complex(self.stage.pixels(points[i : i + 1])[0])

    def _haloed(self, draw: ImageDraw.ImageDraw, at: complex, words: str, color: str, halo: str) -> None:
        """Words that stand out from what they lie on."""
        look: dict[str, Any] = {"font": self._font, "anchor": "mm", "stroke_width": 2, "stroke_fill": halo}
        draw.text((at.real, at.imag), words, fill=color, **look)
