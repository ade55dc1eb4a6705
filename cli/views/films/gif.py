"""A loop of pictures as GIF: one palette for all of them, and times that add up to the length asked for."""

from __future__ import annotations

import sys
from collections import deque
from collections.abc import Iterable, Iterator
from itertools import islice, pairwise
from typing import IO, TYPE_CHECKING

from PIL import Image

from gearlink.cli.parallel.processors import processors
from gearlink.cli.views.films.raster import Raster

if TYPE_CHECKING:
    from concurrent.futures import Executor

    from PIL.Image import Image as Picture

_COLORS = 64
_WORTH_PROCESSES, _SHARE = 48, 6
"""Pictures from which on several processes pay, and how many of them one draws at a time."""


def write_gif(stream: IO[bytes], raster: Raster, count: int, fps: int, counted: Iterable[int]) -> None:
    """Write the pictures; `counted` counts them and may show how far the work is."""
    palette = _with_white(raster.picture(0).quantize(_COLORS, method=Image.Quantize.MEDIANCUT))
    made = _frames(raster, palette, counted, count)
    first = next(made)
    first.save(stream, "GIF", save_all=True, append_images=made, duration=durations(count, fps), loop=0, optimize=False)


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
