"""Pictures of a scene in pixels, and loops of them as GIF or, by the ffmpeg that the machine has, as mp4.

What moves is drawn large with Pillow, with whole bars, discs and dashes, reduced, and put on the backdrop. A GIF has
one palette for all of its pictures, and times that add up to the length of the loop.
"""

from __future__ import annotations

import errno
import re
import shutil
import subprocess
import sys
import tempfile
from collections import deque
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from functools import cached_property
from importlib.util import find_spec
from itertools import islice, pairwise
from pathlib import Path
from typing import IO, TYPE_CHECKING, Any

import numpy as np
from PIL import Image, ImageDraw, ImageFont

from gearlink.cli.files import CannotWrite, unfinished
from gearlink.cli.process import processors
from gearlink.cli.views.films.stage import FAULT_ROW, VALUES_ROOM, ChartScale, Stage
from gearlink.cli.views.scenes.scene import (
    BLACK,
    GREY,
    LIGHT,
    WHITE,
    WRONG,
    Arrow,
    Body,
    Chain,
    Line,
    Part,
    Points,
    placed,
)

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from PIL.Image import Image as Picture


FINER = 2
"""The large picture has so many pixels for one of the reduced."""


def flat(points: Points) -> list[float]:
    """x, y, x, y ... as Pillow takes them."""
    return np.column_stack([points.real, points.imag]).ravel().tolist()


def bar(draw: ImageDraw.ImageDraw, start: complex, end: complex, width: float, color: str) -> None:
    """A straight bar; Pillow's own wide lines round their corners to whole pixels and seem to bend."""
    if start == end:
        return
    side = 0.5j * width * (end - start) / abs(end - start)
    draw.polygon(flat(np.array([start + side, end + side, end - side, start - side])), fill=color)


def arrow(draw: ImageDraw.ImageDraw, start: complex, end: complex, width: float, color: str) -> None:
    """An arrow from point to point, its head shorter where the arrow is short."""
    if start == end:
        return
    way = (end - start) / abs(end - start)
    head = min(5.0 * width, 0.6 * abs(end - start))
    bar(draw, start, end - 0.8 * head * way, width, color)
    corners = end + head * way * np.array([0.0, -1.0 + 0.36j, -1.0 - 0.36j])
    draw.polygon(flat(corners), fill=color)


def disc(draw: ImageDraw.ImageDraw, at: complex, radius: float, fill: str, edge: str, width: int) -> None:
    """A disc with an edge."""
    box = [at.real - radius, at.imag - radius, at.real + radius, at.imag + radius]
    draw.ellipse(box, fill=fill, outline=edge, width=width)


def dashes(points: Points, length: float) -> list[Points]:
    """The dashes of a polyline, each as long as the gap behind it."""
    along = np.concatenate([[0.0], np.cumsum(np.abs(np.diff(points)))])
    edges = np.arange(0.0, along[-1], length)
    made = []
    for start in edges[::2]:
        at = np.linspace(start, min(start + length, along[-1]), 5)
        made.append(np.interp(at, along, points.real) + 1j * np.interp(at, along, points.imag))
    return made


def thinned(points: Points, tolerance: float) -> Points:
    """The points of a polyline that keep it within so much of what it was (Douglas and Peucker).

    Example
        >>> thinned(np.array([0, 1 + 0.01j, 2, 2 + 1j]), 0.1).tolist()
        [0j, (2+0j), (2+1j)]
    """
    kept = np.zeros(len(points), dtype=bool)
    kept[[0, -1]] = True
    open_ends = [(0, len(points) - 1)]
    while open_ends:
        first, last = open_ends.pop()
        if last - first < 2:
            continue
        chord, beside = points[last] - points[first], points[first + 1 : last] - points[first]
        # A closed line has no chord between its ends: the farthest point splits it.
        off = np.abs((beside * np.conj(chord)).imag) / abs(chord) if chord else np.abs(beside)
        worst = int(off.argmax())
        if off[worst] > tolerance:
            middle = first + 1 + worst
            kept[middle] = True
            open_ends += [(first, middle), (middle, last)]
    return points[kept]


def font_file(name: str) -> str:
    """A font that has the letters of a name, where one is installed; else the one that comes with matplotlib."""
    from gearlink.cli.views.figures.write import families

    *_, last = families(name)
    if last != "sans-serif":
        from matplotlib.font_manager import findfont

        return str(findfont(last))
    found = find_spec("matplotlib")  # where it is; to import it for that takes longer than ten pictures
    assert found is not None, "this program needs it"
    assert found.origin is not None, "it is a package with files"
    return str(Path(found.origin).parent / "mpl-data" / "fonts" / "ttf" / "DejaVuSans.ttf")


def font(size: float, name: str = "") -> Any:
    """A font of so many pixels, with the letters of a name."""
    return ImageFont.truetype(font_file(name), max(8, round(size)))


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
            elif isinstance(part, Arrow):
                ends = part.start[i] + np.array([0.0, part.vector[i]])
                if np.isfinite(ends).all():
                    start, end = self._fine(ends).tolist()
                    arrow(draw, start, end, round(1.8 * FINER), part.color)
        for mark in self.stage.scene.marks:
            if mark.pivot:
                self._pivot(draw, mark.point[i : i + 1])

    def _body(self, draw: ImageDraw.ImageDraw, body: Body, i: int) -> None:
        if not np.isfinite(body.place[i]):
            return
        points = flat(self._fine(placed(body, i)))
        if body.fill:
            draw.polygon(points, fill=body.fill)
        draw.line(points, fill=body.color, width=max(1, round(body.width * FINER)))

    def _chain(self, draw: ImageDraw.ImageDraw, chain: Chain, i: int) -> None:
        joints = self._fine(np.array([joint[i] for joint in chain.joints]))
        if not np.isfinite(joints).all():
            return
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
            if mark.text and np.isfinite(mark.point[i]):
                self._haloed(made, self._pixel(mark.point, i) + shift, mark.text, BLACK, WHITE)
        self._fails(made, draw, i)

    def _fails(self, made: Picture, draw: ImageDraw.ImageDraw, i: int) -> None:
        """A red frame and what fails, at the pictures at which something does."""
        size, words = self.stage.text_size, self.stage.failing(i)
        if self.stage.framed(i):
            width = max(3, size // 4)
            draw.rectangle([0, 0, made.width - 1, made.height - 1], outline=WRONG, width=width)
        for row, line in enumerate(words):
            place = 0.9 * size, (VALUES_ROOM + 0.1 + FAULT_ROW * row) * size
            draw.text(place, _MINUS.sub("−", line), font=self._font, fill=WRONG)

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
        look: dict[str, Any] = {"font": self._font, "anchor": "mm", "stroke_width": 2}
        box = ImageDraw.Draw(Image.new("L", (1, 1))).textbbox((0, 0), words, **look)
        half = [int(max(abs(box[i]), abs(box[i + 2]))) + 2 for i in (0, 1)]
        stamp = Image.new("RGBA", (2 * half[0], 2 * half[1]), halo + "00" if len(halo) == 7 else halo)
        place = half[0] + 0.25 * right, half[1] + 0.25 * down
        ImageDraw.Draw(stamp).text(place, words, fill=color, stroke_fill=halo, **look)
        return stamp


_FINEST, _EDGE = 4, 4
"""How many times as large as the large picture its curves are drawn, and what is left about them [large pixel]."""


def backdrop(stage: Stage) -> Picture:
    """The large picture that all others are drawn on."""
    made = Image.new("RGB", (FINER * stage.width, FINER * stage.height), WHITE)
    draw = ImageDraw.Draw(made)
    for part in stage.scene.parts:
        if isinstance(part, Line):
            _line(draw, part, stage)
    size = FINER * stage.text_size
    letters, room = font(1.25 * size, stage.title), made.width - 1.8 * size
    title = stage.title
    while len(title) > 1 and draw.textlength(title, font=letters) > room:
        title = title.rstrip("…")[:-1] + "…"
    draw.text((0.9 * size, 0.6 * size), title, font=letters, fill=BLACK)
    _keys(draw, stage)
    if stage.scene.chart is not None:
        scale = ChartScale(stage.scene.chart, stage.chart_room)
        _chart(draw, scale)
        _curves(made, scale)
        _chart_words(draw, scale, size)
    return made


def _keys(draw: ImageDraw.ImageDraw, stage: Stage) -> None:
    """The scales of the arrows, in the lower left corner of the mechanism's room."""
    letters = font(0.85 * FINER * stage.text_size)
    for start, length, words, color in stage.scales():
        at = FINER * start
        if length > 0.0:
            arrow(draw, at, at + FINER * length, round(1.8 * FINER), color)
        draw.text((at.real + FINER * (length + 0.5 * stage.text_size), at.imag), words, font=letters, fill=color,
                  anchor="lm")  # fmt: skip


def _line(draw: ImageDraw.ImageDraw, line: Line, stage: Stage) -> None:
    points = FINER * stage.pixels(line.points)
    width = max(1, round(line.width * FINER))
    for stretch in dashes(points, 7.0 * FINER) if line.dashed else [points]:
        draw.line(flat(stretch), fill=line.color, width=width)


def _chart(draw: ImageDraw.ImageDraw, scale: ChartScale) -> None:
    room = scale.room
    for band in scale.chart.bands:
        at = scale.points(np.array([band.start, band.end]), np.zeros(2)).real
        box = [FINER * at[0], FINER * room.top, FINER * at[1], FINER * room.bottom]
        draw.rectangle([float(side) for side in box], fill=band.color)
    for x, _ in scale.x_ticks():
        draw.line([FINER * x, FINER * room.top, FINER * x, FINER * room.bottom], fill=LIGHT, width=FINER)
    for y, _ in scale.y_ticks():
        draw.line([FINER * room.left, FINER * y, FINER * room.right, FINER * y], fill=LIGHT, width=FINER)
    corners = [room.left, room.top, room.left, room.bottom, room.right, room.bottom]
    draw.line([FINER * corner for corner in corners], fill=GREY, width=FINER)


def _curves(made: Picture, scale: ChartScale) -> None:
    """The curves, drawn larger still: one that rises slowly shows where Pillow rounds its points to whole pixels."""
    left, top, right, bottom = (FINER * round(side) for side in scale.room.sides)
    left, top, right, bottom = left - _EDGE, top - _EDGE, right + _EDGE, bottom + _EDGE
    part = made.crop((left, top, right, bottom)).resize((_FINEST * (right - left), _FINEST * (bottom - top)), 0)
    draw = ImageDraw.Draw(part)
    for curve in scale.chart.curves:
        points = _FINEST * (FINER * scale.points(scale.chart.x, curve.y) - complex(left, top))
        draw.line(flat(points), fill=curve.color, width=2 * FINER * _FINEST, joint="curve")
    made.paste(part.reduce(_FINEST), (left, top))


def _chart_words(draw: ImageDraw.ImageDraw, scale: ChartScale, size: float) -> None:
    """Numbers and names of the axes; several curves are named in their colours, above the right end of the chart."""
    small = font(0.85 * size)
    left, top, right, bottom = (FINER * side for side in scale.room.sides)
    for x, words in scale.x_ticks():
        draw.text((FINER * x, bottom + 0.3 * size), words, font=small, fill=GREY, anchor="ma")
    for y, words in scale.y_ticks():
        draw.text((left - 0.4 * size, FINER * y), words, font=small, fill=GREY, anchor="rm")
    for k, band in enumerate(scale.chart.bands):
        row = sum(other.start < band.end and band.start < other.end for other in scale.chart.bands[:k] if other.name)
        start, end = (FINER * float(x) for x in scale.points(np.array([band.start, band.end]), np.zeros(2)).real)
        if small.getlength(band.name) < end - start:
            draw.text((0.5 * (start + end), top + (0.2 + row) * size), band.name, font=small, fill=GREY, anchor="ma")
    draw.text((0.5 * (left + right), bottom + 1.5 * size), scale.chart.xlabel, font=small, fill=BLACK, anchor="ma")
    draw.text((left, top - 0.35 * size), scale.chart.ylabel, font=small, fill=BLACK, anchor="ls")
    for curve in reversed(scale.chart.curves if len(scale.chart.curves) > 1 else ()):
        draw.text((right, top - 0.35 * size), curve.label, font=small, fill=curve.color, anchor="rs")
        right -= draw.textlength(curve.label, font=small) + 1.2 * size


_COLORS = 64
_WORTH_PROCESSES, _SHARE = 48, 6
"""Pictures from which on several processes pay, and how many of them one draws at a time."""


def write_gif(stream: IO[bytes], raster: Raster, count: int, fps: int, counted: Iterable[int]) -> None:
    """Write the pictures; `counted` counts them and may show how far the work is."""
    palette = _with_white(_with_failure(raster).quantize(_COLORS, method=Image.Quantize.MEDIANCUT))
    made = _frames(raster, palette, counted, count)
    first = next(made)
    first.save(stream, "GIF", save_all=True, append_images=made, duration=durations(count, fps), loop=0, optimize=False)


def _with_failure(raster: Raster) -> Picture:
    """The first picture, and beside it the first in which a check fails, whose red it may not have."""
    first, stage = raster.picture(0), raster.stage
    fails = next((i for i in range(1, stage.count) if stage.framed(i)), 0)
    if not fails or stage.framed(0):
        return first
    made = Image.new("RGB", (2 * first.width, first.height))
    made.paste(first, (0, 0))
    made.paste(raster.picture(fails), (first.width, 0))
    return made


def _with_white(picture: Picture) -> Picture:
    """The picture with a palette in which white is white: paper has no tint.

    Pillow takes for a colour what is nearest to it by the upper six bits of each part, not what is equal to it.
    """
    paper, colors = Image.new("RGB", (1, 1), "white"), list(picture.getpalette() or [])
    while True:
        at = paper.quantize(palette=picture, dither=Image.Dither.NONE).tobytes()[0]
        if colors[3 * at : 3 * at + 3] == [255, 255, 255]:
            return picture
        colors[3 * at : 3 * at + 3] = [255, 255, 255]
        picture.putpalette(colors)


def _frames(raster: Raster, palette: Picture, counted: Iterable[int], count: int) -> Iterator[Picture]:
    """The pictures in the colours of the palette, drawn in several processes where there are processors for them."""
    jobs = processors() if sys.platform == "linux" else 1  # elsewhere a process does not begin with what this one has
    if jobs < 2 or count < _WORTH_PROCESSES:
        yield from (_quantized(raster, palette, i) for i in counted)
        return
    from gearlink.cli.parallel.workers import workers

    global _drawn_from
    _drawn_from = raster, palette  # forked processes have it without its being sent
    blank = _quantized(raster, palette, 0)
    try:
        with workers(jobs) as pool:
            for _, pixels in zip(counted, _in_order(pool, count, jobs), strict=True):
                made = blank.copy()
                made.frombytes(pixels)
                yield made
    finally:
        _drawn_from = None


_drawn_from: tuple[Raster, Picture] | None = None


def _in_order(pool: Executor, count: int, jobs: int) -> Iterator[bytes]:
    """Pixels of every picture; few of them wait to be written."""
    shares = (range(start, min(start + _SHARE, count)) for start in range(0, count, _SHARE))
    begun = deque(pool.submit(_pixels, share) for share in islice(shares, 2 * jobs))
    while begun:
        yield from begun.popleft().result()
        begun.extend(pool.submit(_pixels, share) for share in islice(shares, 1))


def _pixels(numbers: range) -> list[bytes]:
    assert _drawn_from is not None, "set before this process was forked"
    return [_quantized(*_drawn_from, i).tobytes() for i in numbers]


def _quantized(raster: Raster, palette: Picture, i: int) -> Picture:
    return raster.picture(i).quantize(palette=palette, dither=Image.Dither.NONE)


def durations(count: int, fps: int) -> list[int]:
    """Times of the pictures [ms] in the hundredths of a second that a GIF knows, without drifting from the rate.

    Example
        >>> durations(4, 30), durations(3, 25)
        ([30, 40, 30, 30], [40, 40, 40])
    """
    ends = [round(100.0 * i / fps) for i in range(count + 1)]
    return [10 * (end - start) for start, end in pairwise(ends)]


_BITEXACT = ("-fflags", "+bitexact", "-flags:v", "+bitexact", "-threads", "1")


def ffmpeg() -> str:
    """Where ffmpeg is.

    Raises
        CannotWrite - where the machine has none
    """
    found = shutil.which("ffmpeg")
    if found is None:
        raise CannotWrite("mp4 needs the program ffmpeg, which is not on the PATH: install it, or use --format gif")
    return found


def write_mp4(stream: IO[bytes], raster: Raster, fps: int, counted: Iterable[int]) -> None:
    """Write the pictures as H.264.

    Raises
        CannotWrite - where there is no ffmpeg, or it fails
    """
    program, stage = ffmpeg(), raster.stage
    with tempfile.TemporaryDirectory(prefix="gearlink-") as folder, unfinished(folder):
        path = Path(folder) / "motion.mp4"
        raw = ("-f", "rawvideo", "-pix_fmt", "rgb24", "-s", f"{stage.width}x{stage.height}", "-r", str(fps), "-i", "-")
        coded = ("-c:v", "libx264", "-pix_fmt", "yuv420p", "-crf", "18", "-movflags", "+faststart", *_BITEXACT)
        command = [program, "-v", "error", "-y", *raw, "-an", *coded, str(path)]
        with tempfile.TemporaryFile() as said:
            running = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.DEVNULL, stderr=said)
            _feed(running, raster, counted)
            if running.wait() != 0 or not path.is_file():
                said.seek(0)
                words = said.read().decode(errors="replace").strip().splitlines() or ["no word of why"]
                raise CannotWrite(f"ffmpeg failed: {words[-1][:300]}")
        with path.open("rb") as made:
            shutil.copyfileobj(made, stream)


def _feed(running: subprocess.Popen[bytes], raster: Raster, counted: Iterable[int]) -> None:
    assert running.stdin is not None, "opened as a pipe"
    try:
        for i in counted:
            running.stdin.write(raster.picture(i).tobytes())
    except BaseException as error:
        if not _no_reader(error):  # else ffmpeg has ended early; its status and last words say why
            running.kill()
            raise
    finally:
        try:
            running.stdin.close()
        except OSError as error:
            if not _no_reader(error):
                raise


def _no_reader(error: BaseException) -> bool:
    """Whether nobody reads a pipe any more, which Windows says in another way than others."""
    return isinstance(error, BrokenPipeError) or (isinstance(error, OSError) and error.errno == errno.EINVAL)
