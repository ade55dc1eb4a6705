"""Pictures of a scene in pixels: what moves is drawn large with Pillow, reduced, and put on the backdrop."""

from __future__ import annotations

import re
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from typing import TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw

from gearlink.cli.views.films.backdrop import backdrop
from gearlink.cli.views.films.brush import FINER, bar, disc, flat, font, thinned
from gearlink.cli.views.films.stage import ChartScale, Stage
from gearlink.cli.views.scenes.colors import BLACK, WHITE
from gearlink.cli.views.scenes.scene import Body, Chain, Part, Points, placed

if TYPE_CHECKING:
    from PIL.Image import Image as Picture

_MINUS = re.compile(r"-(?=\d)")  # not the hyphen of a word
_SEEN = 0.1
"""Outlines that differ by less are drawn alike [pixel]."""
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
        self._words(made, i)
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

    @cached_property
    def _parts(self) -> list[Part]:
        """The parts, with the points of outlines alone that are seen: every point is drawn in every picture."""
        seen = _SEEN / self.stage.scale
        return [
            replace(part, outline=thinned(part.outline, seen)) if isinstance(part, Body) and len(part.outline) else part
            for part in self.stage.scene.parts
        ]

    def _move(self, draw: ImageDraw.ImageDraw, i: int) -> None:
        for part in self._parts:
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
        """A pin on its hatched ground."""
        size, line = 0.5 * self.stage.text_size * FINER, round(1.3 * FINER)
        at = complex(self._fine(point)[0])
        foot = at + 1.7j * size
        draw.polygon(flat(np.array([at, foot - size, foot + size])), fill=WHITE)
        draw.line(flat(np.array([at, foot - size, foot + size, at])), fill=BLACK, width=line)
        draw.line(flat(foot + size * np.array([-1.7, 1.7 + 0j])), fill=BLACK, width=line)
        for k in (-1, 0, 1, 2):
            draw.line(flat(foot + size * np.array([0.8 * k + 0j, 0.8 * k - 0.6 + 0.7j])), fill=BLACK, width=line)
        disc(draw, at, 0.4 * size, WHITE, BLACK, round(1.2 * FINER))

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

    @cached_property
    def _readouts(self) -> tuple[Any, list[float]]:
        """Font and places of the values: smaller letters where they would run into each other."""
        size, room = self.stage.text_size, self.stage.width - 1.8 * self.stage.text_size
        longest = [max(self._font.getlength(text) for text in (max(texts, key=len), texts[0])) for texts in self._texts]
        step = [max(wide + 1.5 * size, 0.24 * self.stage.width) for wide in longest]
        share = min(1.0, room / (sum(longest) + 1.5 * size * max(0, len(longest) - 1) or 1.0))
        if share < 1.0 or sum(step) > room:
            step = [share * (wide + 1.5 * size) for wide in longest]
        places = [0.9 * size + sum(step[:k]) for k in range(len(step))]
        return (font(share * size) if share < 1.0 else self._font), places

    def _words(self, made: Picture, i: int) -> None:
        draw, size = ImageDraw.Draw(made), self.stage.text_size
        letters_of_values, places = self._readouts
        for x, texts in zip(places, self._texts, strict=True):
            draw.text((x, 2.5 * size), _MINUS.sub("−", texts[i]), font=letters_of_values, fill=BLACK)
        letters, labels = self.stage.shifts
        labelled = [part for part in self.stage.scene.parts if isinstance(part, Body) and part.label]
        for body, shift in zip(labelled, labels, strict=True):
            self._haloed(made, self._pixel(body.place, i) + shift, body.label, body.color, body.fill or WHITE)
        for mark, shift in zip(self.stage.scene.marks, letters, strict=True):
            if mark.text:
                self._haloed(made, self._pixel(mark.point, i) + shift, mark.text, BLACK, WHITE)

    def _pixel(self, points: Points, i: int) -> complex:
        return complex(self.stage.pixels(points[i : i + 1])[0])

    def _haloed(self, made: Picture, at: complex, words: str, color: str, halo: str) -> None:
        """Words that stand out from what they lie on, to a quarter of a pixel; each such stamp is drawn once."""
        quarters = round(4.0 * at.real), round(4.0 * at.imag)
        key = (words, color, halo, quarters[0] % 4, quarters[1] % 4)
        if key not in self._stamps:
            self._stamps[key] = self._stamp(*key)
        stamp = self._stamps[key]
        left, top = quarters[0] // 4 - stamp.width // 2, quarters[1] // 4 - stamp.height // 2
        made.paste(stamp, (left, top), stamp)

    @cached_property
    def _stamps(self) -> dict[tuple[str, str, str, int, int], Picture]:
        return {}

    def _stamp(self, words: str, color: str, halo: str, right: int, down: int) -> Picture:
        """A picture of the words, transparent about them, so many quarters of a pixel beside its middle."""
        look: dict[str, Any] = {"font": self._font, "anchor": "mm", "stroke_width": 2, "stroke_fill": halo}
        box = ImageDraw.Draw(Image.new("L", (1, 1))).textbbox(
            (0, 0), words, font=self._font, anchor="mm", stroke_width=2
        )
        half = [int(max(abs(box[i]), abs(box[i + 2]))) + 2 for i in (0, 1)]
        stamp = Image.new("RGBA", (2 * half[0], 2 * half[1]), halo + "00" if len(halo) == 7 else halo)
        draw = ImageDraw.Draw(stamp)
        draw.text((half[0] + 0.25 * right, half[1] + 0.25 * down), words, fill=color, **look)
        return stamp
